//! Why a study ends early.

use std::path::PathBuf;

use abrade_report::ReportError;
use abrade_report::quantity_text::count;
use abrade_scene::{GrainError, RunError, SceneError};
use thiserror::Error;

/// A study that cannot be made.
#[derive(Debug, Error)]
pub enum StudyError {
    /// The scene, as the study varies it, is wrong.
    #[error("{}: {}", .0.path, count(.0.problems.len(), "fault", "faults"))]
    Scene(SceneError),
    /// A run could not be made at all.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A grain of an erosion study cannot be made.
    #[error("the grain `{name}`: {source}")]
    Grain {
        /// Its name.
        name: String,
        /// Why not.
        source: GrainError,
    },
    /// A folder that is to be merged has nothing of the study.
    #[error("`{}` holds no case of this study, as it stands", folder.display())]
    NoCases {
        /// The folder.
        folder: PathBuf,
    },
    /// Asperities that cannot collide, or not to the end.
    #[error(transparent)]
    Adhesive(#[from] abrade_adhesive::AdhesiveError),
    /// A file could not be written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// The file that is to serve as the reference cannot be read.
    #[error("the reference `{}` cannot be read: {reason}", path.display())]
    Reference {
        /// The file.
        path: PathBuf,
        /// Why not.
        reason: String,
    },
    /// No run of the study ended.
    #[error("no run of the scene came to its end: {reason}")]
    Nothing {
        /// Why the first one did not.
        reason: String,
    },
    /// The user broke the study off, one of convergence before there was anything to compare.
    #[error("interrupted")]
    Interrupted,
}
