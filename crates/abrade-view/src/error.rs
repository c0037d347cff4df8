//! Why a run cannot be shown: which folder or file, what is missing, what to do.

use std::path::PathBuf;

use abrade_report::ReportError;
use thiserror::Error;

/// A run that cannot be shown.
#[derive(Debug, Error)]
pub enum ViewError {
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] ReportError),
    /// The folder is not one of a run.
    #[error(
        "{} is not the folder of a finished run: it holds no summary.json; \
         `abrade run SCENE` prints the folder it writes to",
        folder.display()
    )]
    NoRun {
        /// The folder.
        folder: PathBuf,
    },
    /// The run left no surface.
    #[error(
        "the run in {} wrote no surface: add `Surface(every: \"{every}\"), Bodies` to the \
         `outputs` of the scene, or `Surface(at: End), Bodies` for its end alone, and run it again",
        folder.display()
    )]
    NoSurface {
        /// The folder.
        folder: PathBuf,
        /// A time between instants that suits the run, with its unit.
        every: String,
    },
    /// A list of files names none that belong to an instant of all.
    #[error("the lists of surfaces and bodies in {} have no instant in common", folder.display())]
    NoInstant {
        /// The folder.
        folder: PathBuf,
    },
    /// A file is not of the run that the summary is of, or not like the first of its series.
    #[error(
        "{} has {found} {what}, the run has {expected}: the folder holds files of several runs; \
         run the scene again into an empty folder",
        path.display()
    )]
    Mixed {
        /// The file.
        path: PathBuf,
        /// What was counted.
        what: &'static str,
        /// Number in the file.
        found: usize,
        /// Number in the run.
        expected: usize,
    },
    /// Points that belong together have moved against each other.
    #[error(
        "the points of {} have moved against those of the first instant by {shift:.1e} m: \
         the folder holds files of several runs; run the scene again into an empty folder",
        path.display()
    )]
    Bent {
        /// The file.
        path: PathBuf,
        /// Largest distance from where a rigid motion would have taken a point [m].
        shift: f64,
    },
    /// The page cannot be written as text.
    #[error("the page's data cannot be written as JSON: {source}")]
    Json {
        /// Why.
        #[from]
        source: serde_json::Error,
    },
}
