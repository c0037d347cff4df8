//! Surfaces of a scene.

use abrade::quantity::{self, Quantity};
use abrade::{Archard, ElasticLaw, FlowLaw, Lateral, Material, Removal, SurfaceLaws};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Copies, Geometry, HardnessMap, Region, Rotation, SceneAdhesion, vectors};

/// A surface that wears.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneSurface {
    /// Name of its material.
    pub material: String,
    /// Its shape and its nodes.
    pub geometry: Geometry,
    /// When a node sinks, and by how much (default `CapozzaHanley(lateral: Projected)`).
    #[serde(default = "default_flow")]
    pub flow: FlowLaw,
    /// Elastic part of the contact (default `Foundation()`).
    #[serde(default = "default_elastic")]
    pub elastic: ElasticLaw,
    /// Hardness by place (default: that of the material everywhere).
    #[serde(default)]
    pub hardness_map: Option<HardnessMap>,
    /// Parts of another hardness; a later one overrides those before it, and all of them the map.
    #[serde(default)]
    pub regions: Vec<Region>,
    /// How the surface moves (default `Fixed`).
    #[serde(default)]
    pub motion: SurfaceMotion,
    /// Which part of the displaced volume leaves as debris (default `All`).
    #[serde(default)]
    pub removal: Removal,
    /// Density of what is worn off [kg/m3], for erosion in kg per kg of a stream (default: that of a
    /// free surface, else none).
    #[serde(default, deserialize_with = "quantity::optional_density")]
    #[schemars(with = "Option<Quantity>")]
    pub density: Option<f64>,
    /// Coefficient of restitution of an impact below yield [-], from 0.01 to 1; what a body needs
    /// to come to rest (default 1: no damping).
    #[serde(default = "undamped")]
    pub restitution: f64,
    /// Adhesion to bodies (default: nothing sticks).
    #[serde(default)]
    pub adhesion: Option<SceneAdhesion>,
    /// Wear by what slides over it below its hardness (default: none).
    #[serde(default)]
    pub archard: Option<Archard>,
    /// Where the origin of the surface's frame lies in the world [m].
    #[serde(default, deserialize_with = "vectors::length3")]
    #[schemars(with = "[Quantity; 3]")]
    pub position: [f64; 3],
    /// How the surface's frame is turned in the world (default: not at all).
    #[serde(default)]
    pub rotation: Rotation,
    /// Copies of a free surface (default: none but itself). Files show them together: one ParaView
    /// file, one set of history columns; a picture and a mesh file are of the first one.
    #[serde(default)]
    pub copies: Option<Copies>,
}

impl SceneSurface {
    /// Its laws, on `material`.
    pub(crate) fn laws(&self, material: &Material) -> SurfaceLaws {
        SurfaceLaws {
            material: material.clone(),
            elastic: self.elastic.clone(),
            flow: self.flow.clone(),
            removal: self.removal.clone(),
            restitution: self.restitution,
            adhesion: self.adhesion.as_ref().map(|adhesion| adhesion.on(material)),
            archard: self.archard.clone(),
        }
    }
}

/// How a surface moves. Directions count in world axes.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum SurfaceMotion {
    /// At rest in the world.
    #[default]
    Fixed,
    /// Led: it moves as given, whatever strikes it.
    Kinematic {
        /// Velocity of its frame's origin [m/s].
        #[serde(default, deserialize_with = "vectors::speed3")]
        #[schemars(with = "[Quantity; 3]")]
        velocity: [f64; 3],
        /// Angular velocity [rad/s].
        #[serde(default, deserialize_with = "vectors::spin3")]
        #[schemars(with = "[Quantity; 3]")]
        spin: [f64; 3],
    },
    /// Led to and fro about its `position`, by amplitude * sin(2 pi frequency * time + phase), and
    /// not turned. Within a step of the run it moves at its mean velocity in that step, which is off
    /// by at most pi * frequency * step of the largest, and at the end of every step it is exactly
    /// in its place; 20 steps of `run.step` must fit into a period.
    Reciprocating {
        /// Farthest from its position [m].
        #[serde(deserialize_with = "vectors::length3")]
        #[schemars(with = "[Quantity; 3]")]
        amplitude: [f64; 3],
        /// Periods per time [1/s].
        #[serde(deserialize_with = "quantity::frequency")]
        #[schemars(with = "Quantity")]
        frequency: f64,
        /// Phase at the start [rad].
        #[serde(default, deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        phase: f64,
    },
    /// Led to and fro about its `rotation`, by angle * sin(2 pi frequency * time + phase) about an
    /// axis through the origin of its frame; in steps as `Reciprocating`, with 4 of them per radian
    /// of the angle in a period at least.
    Rocking {
        /// Axis, of any length above zero [-].
        axis: [f64; 3],
        /// Farthest from its rotation, right-handed [rad].
        #[serde(deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        angle: f64,
        /// Periods per time [1/s].
        #[serde(deserialize_with = "quantity::frequency")]
        #[schemars(with = "Quantity")]
        frequency: f64,
        /// Phase at the start [rad].
        #[serde(default, deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        phase: f64,
    },
    /// Led through points, from each to the next at constant velocity and spin, the short way
    /// around; before the first and after the last one it stands still. A step of the run ends at
    /// every point, so that no step cuts a corner. Either `points` or `file` is given.
    Path {
        /// At least two points, in the order of their times.
        #[serde(default)]
        points: Vec<PathPoint>,
        /// CSV file without a header, of lines t [s], x, y, z [m, times `scale`] and, if it turns,
        /// a quaternion qx, qy, qz, qw: times, shifts and rotations as in `points`. It is looked for
        /// beside the scene.
        #[serde(default)]
        file: Option<String>,
        /// Factor from the file's lengths to metres [-].
        #[serde(default = "one")]
        scale: f64,
        /// Begins again at the last point, which must be where the first one is.
        #[serde(default)]
        repeat: bool,
    },
    /// A free body, which what strikes it and gravity move; of solids alone, whose mesh gives the
    /// mass.
    Free {
        /// Density [kg/m3].
        #[serde(deserialize_with = "quantity::density")]
        #[schemars(with = "Quantity")]
        density: f64,
        /// Velocity of the centre of mass [m/s].
        #[serde(default, deserialize_with = "vectors::speed3")]
        #[schemars(with = "[Quantity; 3]")]
        velocity: [f64; 3],
        /// Angular velocity [rad/s].
        #[serde(default, deserialize_with = "vectors::spin3")]
        #[schemars(with = "[Quantity; 3]")]
        spin: [f64; 3],
    },
}

/// A point of the path of a led surface.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathPoint {
    /// When it is there, from the start of the run [s].
    #[serde(deserialize_with = "quantity::time")]
    #[schemars(with = "Quantity")]
    pub time: f64,
    /// Where the origin of its frame is then, from the surface's `position` [m].
    #[serde(default, deserialize_with = "vectors::length3")]
    #[schemars(with = "[Quantity; 3]")]
    pub shift: [f64; 3],
    /// How its frame is turned then, from the surface's `rotation` (default: not at all).
    #[serde(default)]
    pub rotation: Rotation,
}

fn default_flow() -> FlowLaw {
    FlowLaw::CapozzaHanley { lateral: Lateral::Projected }
}

fn one() -> f64 {
    1.0
}

fn undamped() -> f64 {
    1.0
}

fn default_elastic() -> ElasticLaw {
    ElasticLaw::Foundation { stiffness: None }
}
