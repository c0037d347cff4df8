//! Studies: many runs of one scene, compared. Prints nothing.
//!
//! [`convergence`] asks how the error of a scene falls with what it costs.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![allow(rustdoc::broken_intra_doc_links, reason = "units stand in brackets")]

pub mod convergence;
mod error;
mod sets;

pub use error::StudyError;
