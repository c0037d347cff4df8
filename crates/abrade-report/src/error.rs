//! What can go wrong while a file is made or read back: which file, what was tried, what was found.

use std::error::Error as StdError;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// A file that could not be made or read.
#[derive(Debug, Error)]
pub enum ReportError {
    /// The file system refused.
    #[error("cannot {action} {}: {source}", path.display())]
    File {
        /// What was tried.
        action: FileAction,
        /// The file it was tried on.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A path without a file name, such as a folder's.
    #[error("{} does not end in a file name", path.display())]
    NoFileName {
        /// The path.
        path: PathBuf,
    },
    /// A row of a table does not have the columns that its header promised.
    #[error(
        "a row of {} has {found} {what}, the header has {expected}",
        path.display()
    )]
    Row {
        /// The table.
        path: PathBuf,
        /// What was counted.
        what: &'static str,
        /// Number in the header.
        expected: usize,
        /// Number in the row.
        found: usize,
    },
    /// A triangle names a point that does not exist.
    #[error("triangle {triangle} names point {point}, there are {points} points")]
    Triangle {
        /// Number of the triangle.
        triangle: usize,
        /// The index it holds.
        point: u32,
        /// Number of points.
        points: usize,
    },
    /// The columns of the nodes differ in length.
    #[error("the nodes have {depths} depths, but {found} entries in `{column}`")]
    Columns {
        /// The column that differs.
        column: &'static str,
        /// Its length.
        found: usize,
        /// Length of the depth column.
        depths: usize,
    },
    /// The faces of a hull could not be found.
    #[error("the faces of a hull with {vertices} vertices cannot be found: {source}")]
    Hull {
        /// Number of vertices.
        vertices: usize,
        /// Why.
        source: Box<dyn StdError + Send + Sync>,
    },
    /// A file that is read back is not as this crate writes it.
    #[error("{} is damaged, or was not written by abrade: {missing} is missing or wrong", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What was looked for.
        missing: String,
    },
    /// A value cannot be written as JSON.
    #[error("the summary cannot be written as JSON: {source}")]
    Json {
        /// Why.
        #[from]
        source: serde_json::Error,
    },
    /// The font that is part of this crate cannot be read.
    #[error("the font {name} cannot be read")]
    Font {
        /// Name of the font.
        name: &'static str,
    },
    /// The picture cannot be drawn.
    #[error("the picture cannot be drawn: {source}")]
    Draw {
        /// Why.
        source: Box<dyn StdError + Send + Sync>,
    },
    /// The picture cannot be encoded as PNG.
    #[error("the picture cannot be encoded: {source}")]
    Png {
        /// Why.
        #[from]
        source: png::EncodingError,
    },
}

/// What was tried on a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileAction {
    /// Read it.
    Read,
    /// Create it.
    Create,
    /// Write to it.
    Write,
    /// Give it its final name.
    Rename,
    /// Remove it.
    Remove,
}

impl fmt::Display for FileAction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Read => "read",
            Self::Create => "create",
            Self::Write => "write to",
            Self::Rename => "rename a finished file to",
            Self::Remove => "remove",
        })
    }
}

impl ReportError {
    /// For `map_err` on an operation of the file system.
    pub(crate) fn file(action: FileAction, path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::File { action, path: path.to_owned(), source }
    }

    /// For `map_err` on a drawing operation.
    pub(crate) fn draw<E: StdError + Send + Sync + 'static>(source: E) -> Self {
        Self::Draw { source: Box::new(source) }
    }
}
