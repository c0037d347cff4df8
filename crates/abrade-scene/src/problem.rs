//! What is wrong with a scene: every problem with its place in a text, as data. How it is printed
//! is the command's business.

use std::fmt;
use std::ops::Range;

/// Texts that problems point into.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// File name, or the argument a text came from.
    pub name: String,
    /// Its text, or the lines around the problem.
    pub text: String,
    /// Line number of the text's first line.
    pub first_line: usize,
}

/// A marked part of a [`Source`].
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Index into [`SceneError::sources`].
    pub source: usize,
    /// Bytes of the source's text.
    pub range: Range<usize>,
    /// What was expected there.
    pub label: String,
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// What is wrong.
    pub message: String,
    /// Where; the first mark is the place itself, further ones lead to it.
    pub marks: Vec<Mark>,
    /// What to do about it.
    pub help: Option<String>,
}

/// A scene that cannot be used, with every problem found.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// Path of the scene file, as it was given.
    pub path: String,
    /// The texts that marks point into.
    pub sources: Vec<Source>,
    /// What is wrong, in the order of the file.
    pub problems: Vec<Problem>,
}

impl Problem {
    /// A problem without a place in a text.
    pub(crate) fn unplaced(message: impl Into<String>) -> Self {
        Self { message: message.into(), marks: Vec::new(), help: None }
    }
}

impl Source {
    /// Line and column of a byte of the text, both from 1.
    pub fn line_column(&self, at: usize) -> (usize, usize) {
        let before = &self.text[..at.min(self.text.len())];
        let line = before.matches('\n').count();
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        (self.first_line + line, before[start..].chars().count() + 1)
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, problem) in self.problems.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            match problem.marks.first() {
                None => write!(f, "{}: {}", self.path, problem.message)?,
                Some(mark) => {
                    let source = &self.sources[mark.source];
                    let (line, column) = source.line_column(mark.range.start);
                    write!(f, "{}:{line}:{column}: {}", source.name, problem.message)?;
                    if !mark.label.is_empty() {
                        write!(f, "; {}", mark.label)?;
                    }
                }
            }
            if let Some(help) = &problem.help {
                write!(f, "; {help}")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for SceneError {}

/// The name among `known` that `found` was probably meant to be.
pub(crate) fn nearest<'a>(
    found: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    near(found, known.into_iter().map(|name| (name, name))).first().copied()
}

/// Of `known`, a name with what it stands for each, those like `found`; the likest first.
pub(crate) fn near<'a>(
    found: &str,
    known: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> Vec<&'a str> {
    let likeness = |name: &str| strsim::jaro_winkler(&found.to_lowercase(), &name.to_lowercase());
    let like = known.into_iter().map(|(name, whole)| (likeness(name), whole));
    let mut like: Vec<_> = like.filter(|(likeness, _)| *likeness > 0.7).collect();
    like.sort_by(|a, b| b.0.total_cmp(&a.0));
    like.into_iter().map(|(_, whole)| whole).collect()
}

/// `did you mean ..?`, if a known name is near.
pub fn suggestion<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(found, known).map(|name| format!("did you mean `{name}`?"))
}

/// `a`, `b` or `c`.
pub(crate) fn any_of<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match names.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        Some((last, _)) => last.clone(),
        None => "nothing".into(),
    }
}
