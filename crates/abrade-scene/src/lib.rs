//! Scene files (RON): read, checked with every fault at its place, built into the surfaces and
//! bodies of `abrade`, run in Rapier. Also clump files. Prints nothing.
//!
//! `load` -> [`Checked`] -> [`Checked::build`] -> [`Built`]; [`run`] does the rest.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![allow(rustdoc::broken_intra_doc_links, reason = "units stand in brackets")]

mod build;
mod carrier;
mod check;
mod closed;
pub mod clump;
mod coarse;
mod copies;
mod deserialise;
mod document;
mod grain;
mod hardness;
mod impact_law;
mod led_path;
mod load;
mod mesh_file;
mod number_rows;
mod overlap;
mod patched;
mod place;
mod problem;
mod reference;
mod refusal;
mod run;
pub mod scene;
mod set;
mod size;
mod solid;
mod spans;
mod stiffness;
mod stream;
mod unlikely;
mod unread;
mod way;
mod work;

pub use build::{BuildError, Built, BuiltSurface, StandIn};
pub use carrier::BuiltCarrier;
pub use check::Checked;
pub use document::{Document, FileKind, file_text, name_fault};
pub use grain::{Fit, GrainError, GrainSize, MadeGrain};
pub use led_path::LedPath;
pub use load::{load, load_text};
pub use number_rows::{NumberPair, number_pairs};
pub use problem::{Mark, Problem, SceneError, Source, suggestion};
pub use reference::{Field, fields, fields_of, schema};
pub use run::{Outcome, Precision, Progress, RunError, RunOptions, run};
pub use scene::Scene;
pub use size::{Size, SurfaceSize};
pub use solid::Solid;
pub use spans::{field_names, path};
pub use unlikely::{Usual, material_notes};
pub use unread::unread;
