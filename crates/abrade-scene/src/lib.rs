//! Scene files: read, checked, built.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod scene;
mod spans;
