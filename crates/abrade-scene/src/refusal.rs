//! From the deserialiser's refusal to a problem with a place, what was expected there, and the
//! nearest name.

use ron::error::{Error, Position, SpannedError};
use serde_path_to_error::Segment as SerdeSegment;

use crate::patched::Patched;
use crate::problem::{Problem, any_of, suggestion};
use crate::spans::{Found, Kind, Node, ScenePath};

/// The path that serde knows, in the scene's own words: variants are not steps of it.
pub(crate) fn scene_path(path: &serde_path_to_error::Path) -> Option<ScenePath> {
    let mut names = Vec::new();
    for segment in path {
        match segment {
            SerdeSegment::Seq { index } => names.push(index.to_string()),
            SerdeSegment::Map { key } => names.push(key.clone()),
            SerdeSegment::Enum { .. } => {}
            SerdeSegment::Unknown => return None,
        }
    }
    Some(ScenePath::of(names))
}

/// A text that is not RON.
pub(crate) fn syntax(patched: &Patched, error: &SpannedError) -> Problem {
    let text = &patched.text;
    let at = byte_at(text, &error.span.start);
    let range = match text[at..].trim().is_empty() {
        true => last_char(text),
        false => at..next_char(text, at),
    };
    Problem {
        message: format!("the {} is not RON", patched.kind),
        marks: vec![patched.mark(range, lowered(&error.code.to_string()))],
        help: syntax_help(text, at, &error.code).map(str::to_owned),
    }
}

/// What was probably meant where a comma was expected.
fn syntax_help(text: &str, at: usize, code: &Error) -> Option<&'static str> {
    if *code != Error::ExpectedComma {
        return None;
    }
    let (before, after) = (text[..at].trim_end(), &text[at..]);
    let number = before.ends_with(|c: char| c.is_ascii_digit() || c == '.');
    if number && after.starts_with(char::is_alphabetic) {
        return Some("a number with a unit is quoted, as in \"45 deg\"");
    }
    let inside = after.strip_prefix('(')?.trim_start();
    Some(match inside.starts_with(')') {
        true => "this variant has no fields and is written without parentheses",
        false => "this variant has no fields",
    })
}

/// A value that does not fit its place at `path`.
pub(crate) fn refusal(
    patched: &Patched,
    tree: &Node,
    path: &ScenePath,
    error: &SpannedError,
) -> Problem {
    let text = &patched.text;
    let found = tree.find(text, &path.0);
    let name =
        if path.0.is_empty() { format!("the {}", patched.kind) } else { format!("`{path}`") };
    let place = |label: String, message: String, help: Option<String>| Problem {
        message,
        marks: vec![patched.mark(found.place(text), label)],
        help,
    };
    match &error.code {
        Error::NoSuchStructField { expected, found: field, .. } => {
            let mark = found.key.clone().unwrap_or_else(|| found.place(text));
            Problem {
                message: format!("unknown field `{field}`{}", inside(patched, path)),
                marks: vec![
                    patched.mark(mark, format!("expected {}", any_of(expected.iter().copied()))),
                ],
                help: suggestion(field, expected.iter().copied()),
            }
        }
        Error::NoSuchEnumVariant { expected, found: variant, .. } => place(
            format!("expected {}", any_of(expected.iter().copied())),
            format!("{name} cannot be `{variant}`"),
            suggestion(variant, expected.iter().copied()),
        ),
        Error::MissingStructField { field, .. } => Problem {
            message: format!("{name} has no field `{field}`"),
            marks: vec![patched.mark(owner(&found, text), format!("`{field}` must be given"))],
            help: None,
        },
        Error::DuplicateStructField { field, .. } => Problem {
            message: format!("{name} has the field `{field}` twice"),
            marks: vec![patched.mark(second(&found, text, field), "given again")],
            help: None,
        },
        Error::InvalidValueForType { expected, found } => {
            place(format!("expected {expected}"), format!("{name} cannot be {found}"), None)
        }
        Error::ExpectedDifferentLength { expected, .. } => {
            place(format!("expected {expected}"), format!("{name} has the wrong length"), None)
        }
        Error::Message(message) => {
            let mut parts = message.splitn(3, "; ");
            let what = parts.next().unwrap_or_default();
            let label = parts.next().unwrap_or_default().to_owned();
            place(label, format!("{name}: {what}"), parts.next().map(str::to_owned))
        }
        code => match kind_expected(code) {
            Some(kind) => place(format!("expected {kind}"), format!("{name} is not {kind}"), None),
            None => structure(patched, &found, &name, error),
        },
    }
}

/// Parentheses, commas: what is left when the names and values are fine.
fn structure(patched: &Patched, found: &Found, name: &str, error: &SpannedError) -> Problem {
    let text = &patched.text;
    let label = match (&error.code, &found.node.kind) {
        (Error::ExpectedStructLike | Error::ExpectedNamedStructLike(_), Kind::Word) => {
            format!("expected `{}(..)`", &text[found.node.span.clone()])
        }
        (Error::ExpectedStructLike | Error::ExpectedNamedStructLike(_), _) => {
            "expected values in parentheses, `(..)`".into()
        }
        (Error::ExpectedStructLikeEnd, Kind::List { .. }) => "expected fewer values".into(),
        _ => return syntax(patched, error),
    };
    let word = match found.node.kind {
        Kind::Word => Some(&text[found.node.span.clone()]),
        _ => None,
    };
    Problem {
        message: format!("{name} has the wrong form"),
        marks: vec![patched.mark(found.place(text), label)],
        help: word.map(|word| {
            format!(
                "`{word}()` leaves every field at its default; one without a default must be given"
            )
        }),
    }
}

/// What kind of value was expected, in words.
fn kind_expected(code: &Error) -> Option<&'static str> {
    Some(match code {
        Error::ExpectedFloat => "a number",
        Error::ExpectedInteger => "a whole number",
        Error::IntegerOutOfBounds => "a whole number from zero to the largest that is stored",
        Error::ExpectedBoolean => "`true` or `false`",
        Error::ExpectedString => "a quoted text",
        Error::ExpectedArray => "a list, `[..]`",
        Error::ExpectedMap => "a map, `{..}`",
        Error::ExpectedIdentifier => "a name",
        _ => return None,
    })
}

/// ` in ..`, naming what the last step of `path` stands in.
fn inside(patched: &Patched, path: &ScenePath) -> String {
    match path.0.split_last() {
        Some((_, parent)) if !parent.is_empty() => {
            format!(" in `{}`", ScenePath(parent.to_vec()))
        }
        _ => format!(" in the {}", patched.kind),
    }
}

/// What to mark when something is missing inside a node: its variant's name, else its own name.
fn owner(found: &Found, text: &str) -> std::ops::Range<usize> {
    match (&found.node.kind, &found.key) {
        (Kind::Struct { name: None, .. }, Some(key)) => key.clone(),
        _ => found.node.head(text),
    }
}

fn second(found: &Found, text: &str, field: &str) -> std::ops::Range<usize> {
    let named = |entry: &&crate::spans::Entry| crate::spans::name_of(text, &entry.key) == field;
    let again = found.node.entries().iter().filter(named).nth(1);
    again.map_or_else(|| found.node.head(text), |entry| entry.key.clone())
}

/// Byte offset of a position that counts lines and characters from 1.
fn byte_at(text: &str, position: &Position) -> usize {
    let start: usize =
        text.split_inclusive('\n').take(position.line.saturating_sub(1)).map(str::len).sum();
    let line = &text[start..];
    let column = position.col.saturating_sub(1);
    start + line.char_indices().nth(column).map_or(line.len(), |(at, _)| at)
}

fn next_char(text: &str, at: usize) -> usize {
    at + text[at..].chars().next().map_or(0, char::len_utf8)
}

/// The last character that is not blank.
fn last_char(text: &str) -> std::ops::Range<usize> {
    let text = text.trim_end();
    let start = text.char_indices().next_back().map_or(0, |(at, _)| at);
    start..text.len()
}

/// RON's messages begin with a capital; ours do not.
fn lowered(message: &str) -> String {
    let mut chars = message.chars();
    let first = chars.next().map(|c| c.to_ascii_lowercase());
    first.into_iter().chain(chars).collect()
}
