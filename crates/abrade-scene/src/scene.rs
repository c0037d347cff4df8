//! A scene as its file writes it (RON): named materials, surfaces and bodies, how long to run,
//! what to write. Plain data: units are resolved, nothing is checked or built.
//!
//! The words are fixed: scripts and files outside this repository use them. Every field states its
//! unit in brackets; the JSON schema and the field reference are made from these lines.

mod adhesion;
mod body;
mod copies;
mod geometry;
mod grain;
mod hardness;
mod motion;
mod run;
mod shape;
mod sizes;
mod stream;
mod surface;
mod vectors;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

pub use adhesion::SceneAdhesion;
pub use body::{Placement, Rotation, SceneBody};
pub use copies::Copies;
pub use geometry::Geometry;
pub use grain::{Form, Grain};
pub use hardness::{HardnessMap, Region, RegionBox};
pub use motion::{Motion, Solution};
pub use run::{MeshFormat, Moment, Output, Resolve, Run, Stop};
pub use shape::{ClumpInertia, SceneShape};
pub use sizes::{Sieve, Sizes};
pub use stream::{ShapeShare, Shares, Stream};
pub use surface::{PathPoint, SceneSurface, SurfaceMotion};

use abrade::Material;
use abrade::quantity::Quantity;

/// The version of scene files that this program reads.
pub const VERSION: u32 = 1;

/// A scene: what there is, how it moves, when to stop, what to write.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of the file's form; this one is 1.
    pub version: u32,
    /// What the scene is called: the title of its results.
    pub name: String,
    /// Acceleration of gravity, in world axes [m/s2].
    #[serde(default, deserialize_with = "vectors::acceleration3")]
    #[schemars(with = "[Quantity; 3]")]
    pub gravity: [f64; 3],
    /// Materials that wear, by name.
    pub materials: BTreeMap<String, Material>,
    /// Surfaces that wear, by name.
    pub surfaces: BTreeMap<String, SceneSurface>,
    /// Bodies, by name.
    pub bodies: BTreeMap<String, SceneBody>,
    /// Streams of many bodies, by name.
    #[serde(default)]
    pub streams: BTreeMap<String, Stream>,
    /// When to stop and how closely to compute.
    #[serde(default)]
    pub run: Run,
    /// What is written beside the summary.
    #[serde(default)]
    pub outputs: Vec<Output>,
}
