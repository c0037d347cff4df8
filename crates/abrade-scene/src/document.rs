//! A RON file whose values know their places: read, changed by `--set` arguments, and refused where
//! it is wrong. Scenes are such, and the files of studies.

use std::path::Path;

use abrade::ParameterError;
use serde::de::DeserializeOwned;

use crate::deserialise::{deserialise, options};
use crate::patched::Patched;
use crate::problem::{Mark, Problem, SceneError};
use crate::refusal;
use crate::set;
use crate::spans::{self, Kind, Node, ScenePath};
use crate::unread::unread;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileKind {
    /// What it is called in messages.
    pub name: &'static str,
    /// The version of its form that this program reads.
    pub version: u32,
}

/// A file that was read, and what is wrong with it so far.
#[derive(Debug)]
pub struct Document<T> {
    /// What it says.
    pub value: T,
    pub(crate) patched: Patched,
    pub(crate) tree: Node,
    problems: Vec<Problem>,
}

impl<T: DeserializeOwned> Document<T> {
    /// Reads the file at `path` and applies the `sets` (`PATH=VALUE`) in order.
    ///
    /// # Errors
    /// It cannot be read, is not RON, or a word or value does not fit its place.
    pub fn load(path: &Path, sets: &[String], kind: FileKind) -> Result<Self, SceneError> {
        Self::read(&path.display().to_string(), file_text(path, kind.name)?, sets, kind)
    }

    /// [`Document::load`] for a text; `name` serves messages.
    ///
    /// # Errors
    /// As [`Document::load`].
    pub fn read(
        name: &str,
        text: String,
        sets: &[String],
        kind: FileKind,
    ) -> Result<Self, SceneError> {
        let mut patched = Patched::new(kind.name, name.to_owned(), text);
        match value_and_tree(&mut patched, sets, kind) {
            Ok((value, tree)) => {
                let problems = twice(&patched, &tree);
                Ok(Self { value, patched, tree, problems })
            }
            Err(problems) => Err(refused(patched, problems)),
        }
    }
}

impl<T> Document<T> {
    /// Whether the file, or a `--set`, gives the value at `path`.
    pub fn gives(&self, path: &[&str]) -> bool {
        let path = ScenePath::of(path.iter().copied());
        self.tree.find(&self.patched.text, &path.0).depth == path.0.len()
    }

    /// Notes that the value at `path`, or the nearest one that is written on the way to it, is
    /// wrong, and what was allowed there.
    pub fn refuse(&mut self, path: &[&str], message: impl Into<String>, label: impl Into<String>) {
        let path = ScenePath::of(path.iter().copied());
        let marks = vec![mark(&self.patched, &self.tree, &path, label)];
        self.problems.push(Problem { message: message.into(), marks, help: None });
    }

    /// Notes that a field directly inside `path` is out of range.
    pub fn out_of_range(&mut self, path: &[&str], error: &ParameterError) {
        let path: Vec<&str> = path.iter().copied().chain([error.field]).collect();
        let message = format!("`{}` is out of range", spans::path(&path));
        self.refuse(&path, message, format!("must be {}", allowed(error)));
    }

    /// True while nothing is noted.
    pub fn is_sound(&self) -> bool {
        self.problems.is_empty()
    }

    /// The value, if nothing is wrong with it.
    ///
    /// # Errors
    /// Everything that was noted, in the order of the file.
    pub fn finish(self) -> Result<T, SceneError> {
        match self.is_sound() {
            true => Ok(self.value),
            false => Err(refused(self.patched, self.problems)),
        }
    }

    /// The parts, for a check that notes its problems elsewhere.
    pub(crate) fn into_parts(self) -> (T, Patched, Node, Vec<Problem>) {
        (self.value, self.patched, self.tree, self.problems)
    }
}

/// The text of the file at `path`, a `kind` in messages.
///
/// # Errors
/// It cannot be read, or is no text.
pub fn file_text(path: &Path, kind: &str) -> Result<String, SceneError> {
    let read = std::fs::read(path).map_err(|error| unread(path, &error));
    let text = read.and_then(|bytes| {
        String::from_utf8(bytes).map_err(|_| "it is not a text in UTF-8".to_owned())
    });
    text.map_err(|reason| {
        let problem = Problem::unplaced(format!("the {kind} cannot be read: {reason}"));
        let path = path.display().to_string();
        SceneError { path, sources: Vec::new(), problems: vec![problem] }
    })
}

/// What is wrong with a `name` that is the title of results.
pub fn name_fault(name: &str) -> Option<&'static str> {
    let fault = name.trim().is_empty() || name.contains(char::is_control);
    fault.then_some("must be a line of text")
}

/// The problems of a text in its order.
pub(crate) fn refused(patched: Patched, mut problems: Vec<Problem>) -> SceneError {
    problems
        .sort_by_key(|problem| problem.marks.first().map(|mark| (mark.source, mark.range.start)));
    SceneError { path: patched.sources[0].name.clone(), sources: patched.sources, problems }
}

/// The mark of the value at `path`, or of the nearest that is written on the way to it.
pub(crate) fn mark(
    patched: &Patched,
    tree: &Node,
    path: &ScenePath,
    label: impl Into<String>,
) -> Mark {
    let found = tree.find(&patched.text, &path.0);
    let range = match (found.depth == path.0.len(), &found.key) {
        (true, _) | (false, None) => found.place(&patched.text),
        (false, Some(key)) => key.clone(),
    };
    patched.mark(range, label)
}

/// What was allowed in the place of a value, with an angle's bound as angles are written.
pub(crate) fn allowed(error: &ParameterError) -> String {
    error.allowed.replace("1.5707963267948966", "90 deg, a bare number is in rad")
}

/// The value as written and set, and the tree of its text.
fn value_and_tree<T: DeserializeOwned>(
    patched: &mut Patched,
    sets: &[String],
    kind: FileKind,
) -> Result<(T, Node), Vec<Problem>> {
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
    check_version(patched, &tree, kind).map_err(|problem| vec![problem])?;
    let value = deserialise(patched, &tree)?;
    Ok((value, tree))
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
                    message: format!("the {} is not RON", patched.kind),
                    marks: vec![patched.mark(trouble.at..trouble.at + end, label)],
                    help: None,
                }
            }
        }
    })
}

/// Looks at the version before anything else: a newer file may hold words of its own.
fn check_version(patched: &Patched, tree: &Node, kind: FileKind) -> Result<(), Problem> {
    let path = ScenePath::of(["version"]);
    let found = tree.find(&patched.text, &path.0);
    let written = &patched.text[found.node.span.clone()];
    let version = (found.depth == 1).then(|| written.parse::<u32>().ok()).flatten();
    let FileKind { name, version: known } = kind;
    let message = match version {
        Some(version) if version > known => {
            format!("the {name} is of version {version}, which is newer than this program")
        }
        Some(version) if version < known => format!("there is no version {version} of a {name}"),
        _ => return Ok(()),
    };
    let label = format!("this program reads version {known}");
    let mark = patched.mark(found.node.span.clone(), label);
    Err(Problem { message, marks: vec![mark], help: None })
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
