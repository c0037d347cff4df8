//! `--set PATH=VALUE`: a patch of the scene's text.
//!
//! A written value is replaced; a field that the scene leaves out is inserted, and whether it
//! exists is for the deserialiser to say.

use crate::patched::{Patched, Piece};
use crate::problem::{Problem, Source, any_of, suggestion};
use crate::spans::{self, Kind, Node, ScenePath, Segment};

/// What an enum field that a scene leaves out stands for, so that a field of its default variant
/// can be set.
const DEFAULT_VARIANTS: [(&str, &str); 4] = [
    ("flow", "CapozzaHanley"),
    ("elastic", "Foundation"),
    ("solution", "Dynamic"),
    ("profile", "Trapezoid"),
];

/// Applies an argument `PATH=VALUE` to the text whose tree is `tree`.
pub(crate) fn apply(patched: &mut Patched, tree: &Node, argument: &str) -> Result<(), Problem> {
    let source = Source { name: "--set".into(), text: argument.to_owned(), first_line: 1 };
    let source = patched.add_source(source);
    let refuse = |message: String, range: std::ops::Range<usize>, label: &str| Problem {
        message,
        marks: vec![crate::problem::Mark { source, range, label: label.to_owned() }],
        help: None,
    };
    let Some((path_text, value_text)) = argument.split_once('=') else {
        let message = "`--set` takes PATH=VALUE".to_owned();
        return Err(refuse(message, 0..argument.len(), "expected a `=`"));
    };
    let Some(path) = ScenePath::parse(path_text) else {
        let message = "`--set` takes a dotted path such as `bodies.ball.motion.speed`".to_owned();
        return Err(refuse(message, 0..path_text.len(), "expected names between the dots"));
    };
    let value = value_piece(value_text, path_text.len() + 1).map_err(|range| {
        let message = format!("the value that `--set` gives for `{path}` is not RON");
        refuse(message, range, "expected a value, such as 1.5, \"2 mm\" or (1.0, 0.0, 0.0)")
    })?;

    let found = tree.find(&patched.text, &path.0);
    let rest = &path.0[found.depth..];
    let Some(missing) = rest.first() else {
        let range = found.node.span.clone();
        patched.replace(range, source, vec![value]);
        return Ok(());
    };
    match insertion(&patched.text, found.node, rest, value) {
        Some((at, pieces)) => {
            patched.replace(at..at, source, pieces);
            Ok(())
        }
        None => {
            let text = &patched.text;
            let parent = ScenePath::of(path.0[..found.depth].iter().map(|s| s.name.clone()));
            Err(Problem {
                help: suggestion(&missing.name, found.node.names(text)),
                ..refuse(
                    format!("the path `{path}` leads nowhere: no `{}` in `{parent}`", missing.name),
                    missing.span.clone(),
                    &contents(text, found.node),
                )
            })
        }
    }
}

/// What is inside a node that a path went wrong in.
fn contents(text: &str, node: &Node) -> String {
    match &node.kind {
        Kind::List { items, .. } => {
            format!("expected an index below {}", items.len())
        }
        Kind::Scalar => format!("`{}` has nothing inside", &text[node.span.clone()]),
        _ => format!("expected {}", any_of(node.names(text))),
    }
}

/// Where and what to insert so that the path `rest` exists below `node`, if it can.
fn insertion(
    text: &str,
    node: &Node,
    rest: &[Segment],
    value: Piece,
) -> Option<(usize, Vec<Piece>)> {
    let (first, deeper) = rest.split_first()?;
    let glue = |text: &str| Piece { text: text.to_owned(), origin: first.span.clone() };
    let key = |name: String| Piece { text: name, origin: first.span.clone() };
    let named = |name: String| {
        let mut pieces = vec![key(name), glue(": ")];
        pieces.extend(nested(&first.name, deeper, value));
        pieces
    };
    match &node.kind {
        Kind::Struct { inside, entries, .. } if is_word(&first.name) => {
            Some(after_last(inside.start, entries, named(first.name.clone()), glue))
        }
        Kind::Map { inside, entries } if deeper.is_empty() => {
            let name = format!("{:?}", first.name);
            Some(after_last(inside.start, entries, named(name), glue))
        }
        Kind::Word if is_word(&first.name) && &text[node.span.clone()] != "None" => {
            let mut pieces = vec![glue("(")];
            pieces.extend(named(first.name.clone()));
            pieces.push(glue(")"));
            Some((node.span.end, pieces))
        }
        _ => None,
    }
}

/// `pieces` behind the last entry, or at `start` if there is none.
fn after_last(
    start: usize,
    entries: &[spans::Entry],
    mut pieces: Vec<Piece>,
    glue: impl Fn(&str) -> Piece,
) -> (usize, Vec<Piece>) {
    match entries.last() {
        None => (start, pieces),
        Some(last) => {
            pieces.insert(0, glue(", "));
            (last.value.span.end, pieces)
        }
    }
}

/// The value below `rest`, wrapped in the structs that lead to it.
fn nested(parent: &str, rest: &[Segment], value: Piece) -> Vec<Piece> {
    let Some((first, deeper)) = rest.split_first() else { return vec![value] };
    let variant = DEFAULT_VARIANTS.iter().find(|(field, _)| *field == parent);
    let opening = format!("{}(", variant.map_or("", |(_, variant)| variant));
    let glue = |text: String| Piece { text, origin: first.span.clone() };
    let mut pieces = vec![glue(opening), glue(first.name.clone()), glue(": ".into())];
    pieces.extend(nested(&first.name, deeper, value));
    pieces.push(glue(")".into()));
    pieces
}

fn is_word(name: &str) -> bool {
    let first = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
    first && name.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// The value as RON: as it stands, or quoted if it is a bare number with a unit. `Err` holds the
/// place of the trouble in the argument.
fn value_piece(text: &str, offset: usize) -> Result<Piece, std::ops::Range<usize>> {
    let start = text.len() - text.trim_start().len();
    let value = text.trim();
    let origin = offset + start..offset + start + value.len();
    let quoted = |value: &str| Piece { text: format!("\"{value}\""), origin: origin.clone() };
    if is_bare_quantity(value) {
        return Ok(quoted(value));
    }
    match spans::parse(value) {
        Ok(_) => Ok(Piece { text: value.to_owned(), origin }),
        Err(_) => Err(origin),
    }
}

/// True for `30 deg`, `2.5 GPa`, `1/240 s`: it starts like a number and ends in a unit.
fn is_bare_quantity(value: &str) -> bool {
    let digits = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
    let radix = ["0x", "0b", "0o"].iter().any(|prefix| value.starts_with(prefix));
    let plain = value.replace('_', "").parse::<f64>().is_ok();
    value.starts_with(digits) && !radix && !plain && !value.contains(['"', '(', ',', '\\'])
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r#"(
    surfaces: { "plate": (flow: CapozzaHanley(), elastic: Rigid, cap: CapozzaHanley(lateral: Projected)) },
    bodies: { "ball": (motion: Impact(speed: "35 m/s", angle: 1.0,), at: (0, 1)) }, // end
)"#;

    fn set(argument: &str) -> Result<String, Problem> {
        let mut patched = Patched::new("scene", "scene".into(), SCENE.into());
        let tree = spans::parse(SCENE).unwrap();
        apply(&mut patched, &tree, argument).map(|()| patched.text)
    }

    fn changed(argument: &str, old: &str, new: &str) {
        assert_eq!(set(argument).unwrap(), SCENE.replacen(old, new, 1), "{argument}");
    }

    #[test]
    fn a_written_value_is_replaced() {
        changed("bodies.ball.motion.speed=30 m/s", "35 m/s", "30 m/s");
        changed("bodies.ball.motion.speed=\"30 m/s\"", "35 m/s", "30 m/s");
        changed("bodies.ball.motion.angle = -1e-3", "1.0", "-1e-3");
        changed("bodies.ball.motion.angle=1_0.5e-3", "1.0", "1_0.5e-3");
        changed("bodies.ball.at.1=(2, \"3 mm\")", "(0, 1)", "(0, (2, \"3 mm\"))");
        changed("surfaces.plate.cap.lateral=Eq5", "Projected", "Eq5");
        changed("surfaces.plate.elastic=Foundation()", "Rigid", "Foundation()");
    }

    #[test]
    fn a_field_that_is_not_written_is_inserted() {
        changed("surfaces.plate.flow.lateral=Eq5", "Hanley()", "Hanley(lateral: Eq5)");
        changed("bodies.ball.motion.azimuth=3 deg", "1.0,", "1.0, azimuth: \"3 deg\",");
        changed("surfaces.plate.elastic.stiffness=1", "Rigid", "Rigid(stiffness: 1)");
        changed("bodies.cube=(x: 1)", "1)) }", "1)), \"cube\": (x: 1) }");
        changed("run.accuracy=1e-4", "1)) },", "1)) }, run: (accuracy: 1e-4),");
        changed(
            "run.profile.side=45 deg",
            "1)) },",
            "1)) }, run: (profile: Trapezoid(side: \"45 deg\")),",
        );
        changed(
            "surfaces.plate.cap.elastic.stiffness=1",
            "Projected",
            "Projected, elastic: Foundation(stiffness: 1)",
        );
    }

    #[test]
    fn a_path_that_leads_nowhere_is_refused() {
        let refusal = |argument| {
            let problem = set(argument).unwrap_err();
            (problem.message, problem.marks[0].label.clone(), problem.help)
        };
        assert_eq!(
            refusal("bodies.bal.motion.speed=1"),
            (
                "the path `bodies.bal.motion.speed` leads nowhere: no `bal` in `bodies`".into(),
                "expected `ball`".into(),
                Some("did you mean `ball`?".into())
            )
        );
        assert_eq!(refusal("bodies.ball.at.2=1").1, "expected an index below 2");
        assert_eq!(refusal("bodies.ball.motion.angle.deg=1").1, "`1.0` has nothing inside");
        assert_eq!(refusal("bodies.ball").0, "`--set` takes PATH=VALUE");
        assert_eq!(refusal("bodies.ball.at=(1").1.split(',').next(), Some("expected a value"));
    }
}
