//! Studies: many runs, compared. Prints nothing.
//!
//! [`convergence`] asks how the error of a scene falls with what it costs; [`erosion`] what grains of
//! several forms take off a plate; [`adhesive`] what becomes of asperities that collide.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![allow(rustdoc::broken_intra_doc_links, reason = "units stand in brackets")]

pub mod adhesive;
mod case_files;
pub mod convergence;
pub mod erosion;
mod error;
mod fingerprint;
mod sets;

pub use error::StudyError;
