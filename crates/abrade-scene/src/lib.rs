//! Scene files: read, checked, built.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod clump;
pub mod scene;
mod patched;
mod problem;
mod set;
mod spans;
