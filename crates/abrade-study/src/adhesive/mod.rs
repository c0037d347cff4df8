//! Asperities that collide: one collision with its files, and maps of many.
//!
//! [`load_scene`] and [`load_map`] read the files; [`run`] makes a collision; a map is a list of cases
//! ([`MapFile::cases`]), each of which lies in a file of its own when it is made ([`make`]), and
//! [`result`] tells what those that are there come to.

mod case;
mod check;
mod file;
mod fit;
mod frames;
mod map;
mod outline;
mod run;
mod series;
mod size;
mod summary;
mod write;

pub use case::{Case, ended_early, gather, is_made, make, others};
pub use check::{load_map, load_map_text, load_scene, load_scene_text};
pub use file::{MapFile, SceneFile, VERSION};
pub use fit::Boundary;
pub use frames::PICTURE;
pub use map::{Map, Point, result};
pub use run::{Ended, run};
pub use size::Size;
pub use write::write;

/// The JSON schema of a scene of two asperities.
pub fn scene_schema() -> serde_json::Value {
    schemars::schema_for!(SceneFile).to_value()
}

/// The JSON schema of a map's file.
pub fn map_schema() -> serde_json::Value {
    schemars::schema_for!(MapFile).to_value()
}
