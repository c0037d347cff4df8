//! Dotted paths such as `bodies.ball.motion.speed`; a name with a dot in it is quoted.

use std::fmt;
use std::ops::Range;

/// A step of a path, and where it stands in the text of the path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Segment {
    pub(crate) name: String,
    pub(crate) span: Range<usize>,
}

/// A path through structs, variants, maps and lists.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ScenePath(pub(crate) Vec<Segment>);

impl ScenePath {
    /// Reads a dotted path; none if a step is empty or a quote is not closed.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut segments = Vec::new();
        let mut at = 0;
        loop {
            let rest = &text[at..];
            let (name, end) = match rest.strip_prefix('"') {
                Some(quoted) => {
                    let length = quoted.find('"')?;
                    (&quoted[..length], at + length + 2)
                }
                None => {
                    let length = rest.find('.').unwrap_or(rest.len());
                    (&rest[..length], at + length)
                }
            };
            if name.trim().is_empty() {
                return None;
            }
            segments.push(Segment { name: name.trim().to_owned(), span: at..end });
            match text[end..].chars().next() {
                None => return Some(Self(segments)),
                Some('.') => at = end + 1,
                Some(_) => return None,
            }
        }
    }

    /// A path of these names.
    pub(crate) fn of<N: Into<String>>(names: impl IntoIterator<Item = N>) -> Self {
        let segment = |name: N| Segment { name: name.into(), span: 0..0 };
        Self(names.into_iter().map(segment).collect())
    }

    /// This path, carried on by `name`.
    pub(crate) fn join(&self, name: impl Into<String>) -> Self {
        let mut path = self.clone();
        path.0.push(Segment { name: name.into(), span: 0..0 });
        path
    }
}

impl fmt::Display for ScenePath {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let names: Vec<_> = self.0.iter().map(|segment| segment.name.as_str()).collect();
        f.write_str(&path(&names))
    }
}

/// The path of these names, as `--set` takes it.
pub fn path(names: &[&str]) -> String {
    let quoted = |name: &&str| match name.contains('.') {
        true => format!("\"{name}\""),
        false => (*name).to_owned(),
    };
    names.iter().map(quoted).collect::<Vec<_>>().join(".")
}
