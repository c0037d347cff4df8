//! From the text to values. The deserialiser stops at the first fault; fields that it does not know are blanked
//! out and the rest read again, so that all of them are told at once.

use std::ops::Range;

use ron::error::Error;
use ron::extensions::Extensions;
use serde::de::DeserializeOwned;

use crate::patched::Patched;
use crate::problem::Problem;
use crate::refusal;
use crate::spans::{Kind, Node, ScenePath};

/// The value that the text of `patched`, whose tree is `tree`, says; or every field that is not known, and the
/// first fault of another kind.
pub(crate) fn deserialise<T: DeserializeOwned>(
    patched: &Patched,
    tree: &Node,
) -> Result<T, Vec<Problem>> {
    let (mut blanked, mut problems) = (Vec::new(), Vec::new());
    loop {
        let fault = match read::<T>(patched, &blanked, tree) {
            Ok(value) if problems.is_empty() => return Ok(value),
            Ok(_) => return Err(problems),
            Err(fault) => fault,
        };
        match fault {
            // The name that is missing is likely one that was misspelt.
            Fault::Missing(_) if !problems.is_empty() => return Err(problems),
            Fault::Missing(problem) | Fault::Other(problem) => {
                problems.push(problem);
                return Err(problems);
            }
            Fault::Unknown(problem, place) => {
                problems.push(problem);
                let Some(place) = place else { return Err(problems) };
                blanked.push(place);
            }
        }
    }
}

/// How RON is read here.
pub(crate) fn options() -> ron::Options {
    ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME)
}

/// Why a text says no value.
enum Fault {
    /// A field that is not known, and its place, with all up to the next field.
    Unknown(Problem, Option<Range<usize>>),
    /// A field that must be given.
    Missing(Problem),
    /// Anything else.
    Other(Problem),
}

/// The value that the text of `patched` says with some fields `blanked` out.
fn read<T: DeserializeOwned>(
    patched: &Patched,
    blanked: &[Range<usize>],
    tree: &Node,
) -> Result<T, Fault> {
    let text = without(&patched.text, blanked);
    let mut deserializer = ron::Deserializer::from_str_with_options(&text, &options())
        .map_err(|error| Fault::Other(refusal::syntax(patched, &error)))?;
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = refusal::scene_path(error.path());
        let error = deserializer.span_error(error.into_inner());
        let Some(path) = path else { return Fault::Other(refusal::syntax(patched, &error)) };
        let problem = refusal::refusal(patched, tree, &path, &error);
        match error.code {
            Error::NoSuchStructField { .. } => {
                Fault::Unknown(problem, field(&patched.text, blanked, tree, &path))
            }
            Error::MissingStructField { .. } => Fault::Missing(problem),
            _ => Fault::Other(problem),
        }
    })?;
    let end = deserializer.end().map_err(|error| deserializer.span_error(error));
    end.map_err(|error| Fault::Other(refusal::syntax(patched, &error)))?;
    Ok(value)
}

/// `text` with `blanked` out bytes. Lines and characters keep their numbers, by which RON tells places.
fn without(text: &str, blanked: &[Range<usize>]) -> String {
    let is_blanked = |at: usize| blanked.iter().any(|place| place.contains(&at));
    let kept = |(at, c): (usize, char)| if c != '\n' && is_blanked(at) { ' ' } else { c };
    text.char_indices().map(kept).collect()
}

/// The field at `path` that is not `blanked` out, from its name to that of the next one or to the end of what it
/// stands in.
fn field(
    text: &str,
    blanked: &[Range<usize>],
    tree: &Node,
    path: &ScenePath,
) -> Option<Range<usize>> {
    let (last, parents) = path.0.split_last()?;
    let parent = tree.find(text, parents);
    let node = parent.node;
    let named = |entry: &crate::spans::Entry| {
        let is_blanked = blanked.iter().any(|place| place.contains(&entry.key.start));
        !is_blanked && crate::spans::name_of(text, &entry.key) == last.name
    };
    let at = node.entries().iter().position(named).filter(|_| parent.depth == parents.len())?;
    let end = match (&node.kind, node.entries().get(at + 1)) {
        (_, Some(next)) => next.key.start,
        (Kind::Struct { inside, .. } | Kind::Map { inside, .. }, None) => inside.end,
        _ => return None,
    };
    Some(node.entries()[at].key.start..end)
}
