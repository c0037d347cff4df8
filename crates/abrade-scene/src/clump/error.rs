//! What can be wrong with a clump file.

use std::path::PathBuf;

use abrade_report::quantity_text::count;
use thiserror::Error;

/// A clump file that cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ClumpError {
    /// It cannot be read.
    #[error("cannot read `{}`: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
    /// A line is not what its place demands.
    #[error("{}:{line}: {trouble}; the line is `{text}`", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// The line.
        text: String,
        /// What is wrong with it.
        trouble: LineTrouble,
    },
    /// It names no sphere.
    #[error("`{}` has no spheres", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// It ends before something that its format demands.
    #[error("`{}` has no `{what}`", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
        /// The line or section that is missing.
        what: &'static str,
    },
}

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LineTrouble {
    /// A word is not a finite number.
    #[error("`{word}` is not a finite number")]
    NotANumber {
        /// The word.
        word: String,
    },
    /// The wrong number of columns.
    #[error("it has {}, {expected} are expected", count(*found, "column", "columns"))]
    Columns {
        /// Columns of the line.
        found: usize,
        /// Columns that its place demands, in words.
        expected: &'static str,
    },
    /// A radius that is not above zero.
    #[error("the radius {radius} is not above zero")]
    Radius {
        /// The radius.
        radius: f64,
    },
    /// An atom number outside the file's count.
    #[error("there is no atom {atom} among {count}")]
    Atom {
        /// Number of the atom.
        atom: f64,
        /// Number of atoms.
        count: usize,
    },
    /// An atom without coordinates, or without a diameter.
    #[error("atom {atom} has no `{section}`")]
    Incomplete {
        /// Number of the atom.
        atom: usize,
        /// The section that does not name it.
        section: &'static str,
    },
}
