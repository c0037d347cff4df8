//! From a scene file and its `--set` arguments to a checked scene, or every problem in it.

use std::path::{Path, PathBuf};

use ron::extensions::Extensions;

use crate::check::{self, Checked};
use crate::patched::Patched;
use crate::problem::{Problem, SceneError};
use crate::refusal;
use crate::scene::{Scene, VERSION};
use crate::set;
use crate::spans::{self, Kind, Node, ScenePath};

/// Reads the scene file at `path`, applies the `sets` (`PATH=VALUE`) in order, and checks it.
/// Files that the scene names are looked for beside it.
///
/// # Errors
/// Everything that is wrong with it, as far as it can be seen at once.
pub fn load(path: &Path, sets: &[String]) -> Result<Checked, SceneError> {
    let name = path.display().to_string();
    let read = std::fs::read(path).map_err(|error| error.kind().to_string());
    let text = read.and_then(|bytes| {
        String::from_utf8(bytes).map_err(|_| "it is not a text in UTF-8".to_owned())
    });
    match text {
        Ok(text) => {
            let folder = path.parent().map(Path::to_owned).unwrap_or_default();
            load_text(&name, text, folder, sets)
        }
        Err(reason) => {
            let problem = Problem::unplaced(format!("the scene cannot be read: {reason}"));
            Err(SceneError { path: name, sources: Vec::new(), problems: vec![problem] })
        }
    }
}

/// [`load`] for a scene's text; `name` serves messages, `folder` is where its files lie.
///
/// # Errors
/// Everything that is wrong with it, as far as it can be seen at once.
pub fn load_text(
    name: &str,
    text: String,
    folder: PathBuf,
    sets: &[String],
) -> Result<Checked, SceneError> {
    let mut patched = Patched::new(name.to_owned(), text);
    let scene = read(&mut patched, sets).and_then(|(scene, tree)| {
        let mut problems = twice(&patched, &tree);
        match check::check(scene, folder, &mut patched, &tree) {
            Ok(checked) if problems.is_empty() => Ok(checked),
            Ok(_) => Err(problems),
            Err(found) => {
                problems.extend(found);
                Err(problems)
            }
        }
    });
    scene.map_err(|mut problems| {
        problems.sort_by_key(|problem| {
            problem.marks.first().map(|mark| (mark.source, mark.range.start))
        });
        SceneError { path: name.to_owned(), sources: patched.sources, problems }
    })
}

/// The scene as written and set, and the tree of its text.
fn read(patched: &mut Patched, sets: &[String]) -> Result<(Scene, Node), Vec<Problem>> {
    let mut tree = tree_of(patched).map_err(|problem| vec![problem])?;
    let mut problems = Vec::new();
    for argument in sets {
        match set::apply(patched, &tree, argument) {
            Ok(()) => tree = tree_of(patched).map_err(|problem| vec![problem])?,
            Err(problem) => problems.push(problem),
        }
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    check_version(patched, &tree).map_err(|problem| vec![problem])?;
    let scene = deserialise(patched, &tree).map_err(|problem| vec![problem])?;
    Ok((scene, tree))
}

/// The tree of the text. What is not RON is best said by RON itself.
fn tree_of(patched: &Patched) -> Result<Node, Problem> {
    spans::parse(&patched.text).map_err(|trouble| {
        match options().from_str::<ron::Value>(&patched.text) {
            Err(error) => refusal::syntax(patched, &error),
            Ok(_) => {
                let end = patched.text[trouble.at..].chars().next().map_or(0, char::len_utf8);
                let label = format!("expected {}", trouble.expected);
                Problem {
                    message: "the scene is not RON".into(),
                    marks: vec![patched.mark(trouble.at..trouble.at + end, label)],
                    help: None,
                }
            }
        }
    })
}

/// Looks at the version before anything else: a newer file may hold words of its own.
fn check_version(patched: &Patched, tree: &Node) -> Result<(), Problem> {
    let path = ScenePath::of(["version"]);
    let found = tree.find(&patched.text, &path.0);
    let written = &patched.text[found.node.span.clone()];
    let version = (found.depth == 1).then(|| written.parse::<u32>().ok()).flatten();
    let message = match version {
        Some(version) if version > VERSION => {
            format!("the scene is of version {version}, which is newer than this program")
        }
        Some(version) if version < VERSION => format!("there is no version {version} of scenes"),
        _ => return Ok(()),
    };
    let label = format!("this program reads version {VERSION}");
    let mark = patched.mark(found.node.span.clone(), label);
    Err(Problem { message, marks: vec![mark], help: None })
}

fn deserialise(patched: &Patched, tree: &Node) -> Result<Scene, Problem> {
    let text = &patched.text;
    let mut deserializer = ron::Deserializer::from_str_with_options(text, &options())
        .map_err(|error| refusal::syntax(patched, &error))?;
    let scene = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = refusal::scene_path(error.path());
        let error = deserializer.span_error(error.into_inner());
        match path {
            Some(path) => refusal::refusal(patched, tree, &path, &error),
            None => refusal::syntax(patched, &error),
        }
    })?;
    deserializer
        .end()
        .map_err(|error| refusal::syntax(patched, &deserializer.span_error(error)))?;
    Ok(scene)
}

fn options() -> ron::Options {
    ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME)
}

/// Names that a map gives twice: RON would keep the last one in silence.
fn twice(patched: &Patched, node: &Node) -> Vec<Problem> {
    let mut problems = Vec::new();
    let text = &patched.text;
    if let Kind::Map { entries, .. } = &node.kind {
        for (i, entry) in entries.iter().enumerate() {
            let name = spans::name_of(text, &entry.key);
            if entries[..i].iter().any(|other| spans::name_of(text, &other.key) == name) {
                problems.push(Problem {
                    message: format!("the name `{name}` is given twice"),
                    marks: vec![patched.mark(entry.key.clone(), "given again")],
                    help: None,
                });
            }
        }
    }
    problems.extend(node.children().flat_map(|child| twice(patched, child)));
    problems
}
