//! Studies: many runs, compared. Prints nothing.
//!
//! [`convergence`] asks how the error of a scene falls with what it costs; [`erosion`] what grains of
//! several forms take off a plate.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![allow(rustdoc::broken_intra_doc_links, reason = "units stand in brackets")]

pub mod convergence;
pub mod erosion;
mod error;
mod sets;

pub use error::StudyError;
