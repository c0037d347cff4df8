//! Lines of a clump file: numbers separated by blanks, tabs, commas or semicolons; what follows a
//! `#` is a comment.

use std::path::Path;

use abrade::Ball;
use nalgebra::Point3;

use super::{ClumpError, LineTrouble};

/// A line that is not blank.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    path: &'a Path,
    number: usize,
    whole: &'a str,
    /// Without its comment and outer blanks.
    pub(super) text: &'a str,
}

/// The lines of `text` that say something. `comment` starts a comment.
pub(super) fn lines<'a>(
    path: &'a Path,
    text: &'a str,
    comment: &'static str,
) -> impl Iterator<Item = Line<'a>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    text.lines().enumerate().filter_map(move |(i, whole)| {
        let text = whole.split(comment).next().unwrap_or("").trim();
        (!text.is_empty()).then_some(Line { path, number: i + 1, whole, text })
    })
}

impl<'a> Line<'a> {
    /// The error that this line makes.
    pub(super) fn error(&self, trouble: LineTrouble) -> ClumpError {
        ClumpError::Line {
            path: self.path.to_owned(),
            line: self.number,
            text: self.whole.trim_end().to_owned(),
            trouble,
        }
    }

    pub(super) fn words(&self) -> impl Iterator<Item = &'a str> {
        let separator = |c: char| c.is_whitespace() || matches!(c, ',' | ';');
        self.text.split(separator).filter(|word| !word.is_empty())
    }

    /// The words as finite numbers.
    pub(super) fn numbers(&self) -> Result<Vec<f64>, ClumpError> {
        self.words().map(|word| self.number(word)).collect()
    }

    pub(super) fn number(&self, word: &str) -> Result<f64, ClumpError> {
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.error(LineTrouble::NotANumber { word: word.to_owned() })),
        }
    }

    /// The first `N` numbers; `expected` says in words how many there should be.
    pub(super) fn first<const N: usize>(
        &self,
        expected: &'static str,
    ) -> Result<[f64; N], ClumpError> {
        let numbers = self.numbers()?;
        let found = numbers.len();
        match numbers.first_chunk() {
            Some(first) => Ok(*first),
            None => Err(self.error(LineTrouble::Columns { found, expected })),
        }
    }

    pub(super) fn sphere(&self, [x, y, z, radius]: [f64; 4]) -> Result<Ball, ClumpError> {
        match radius > 0.0 {
            true => Ok(Ball { centre: Point3::new(x, y, z), radius }),
            false => Err(self.error(LineTrouble::Radius { radius })),
        }
    }
}
