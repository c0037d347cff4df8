//! Bodies of a scene, where they start and how they are turned.

use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Motion, SceneShape, vectors};

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneBody {
    /// Its geometry.
    pub shape: SceneShape,
    /// Density [kg/m3]; needed unless a clump file or a drive gives the mass, or the body is
    /// fixed.
    #[serde(default, deserialize_with = "quantity::optional_density")]
    #[schemars(with = "Option<Quantity>")]
    pub density: Option<f64>,
    /// Where it starts; says in which axes `rotation` and `motion` count.
    pub position: Placement,
    /// How it is turned at the start (default: not at all).
    #[serde(default)]
    pub rotation: Rotation,
    /// How it moves (default: free, from rest).
    #[serde(default)]
    pub motion: Motion,
    /// Held upright: the contact cannot turn the body.
    #[serde(default)]
    pub rotation_locked: bool,
}

/// Where a body starts.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Placement {
    /// Above a flat surface. The body's `rotation` and `motion` count in the surface's axes.
    OnSurface {
        /// Name of the surface.
        surface: String,
        /// Place under the centre of mass, from the node nearest the surface's middle, in the
        /// surface's axes [m].
        #[serde(default, deserialize_with = "vectors::length2")]
        #[schemars(with = "[Quantity; 2]")]
        at: [f64; 2],
        /// Distance between the body's lowest point and the node surface [m].
        #[serde(default, deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        gap: f64,
    },
    /// With the centre of mass at a point of a surface's frame. The body's `rotation` and `motion`
    /// count in the surface's axes.
    InFrame {
        /// Name of the surface.
        surface: String,
        /// Centre of mass, from the origin of the surface's frame [m].
        #[serde(deserialize_with = "vectors::length3")]
        #[schemars(with = "[Quantity; 3]")]
        point: [f64; 3],
    },
    /// With the centre of mass at a point of the world. The body's `rotation` and `motion` count in
    /// world axes.
    At {
        /// Centre of mass [m].
        #[serde(deserialize_with = "vectors::length3")]
        #[schemars(with = "[Quantity; 3]")]
        point: [f64; 3],
    },
}

impl Placement {
    /// Name of the surface in whose frame the body is placed.
    pub fn surface(&self) -> Option<&String> {
        match self {
            Self::OnSurface { surface, .. } | Self::InFrame { surface, .. } => Some(surface),
            Self::At { .. } => None,
        }
    }
}

/// How a body or a surface is turned.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Rotation {
    /// By an angle about an axis.
    AxisAngle {
        /// Axis, of any length above zero [-].
        axis: [f64; 3],
        /// Angle, right-handed [rad].
        #[serde(deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        angle: f64,
    },
    /// By a quaternion.
    Quaternion {
        /// Components x, y, z, w, of any length above zero [-].
        xyzw: [f64; 4],
    },
    /// Drawn uniformly from all rotations (PCG32).
    Random {
        /// Seed of the generator.
        seed: u64,
    },
}

impl Default for Rotation {
    fn default() -> Self {
        Self::Quaternion { xyzw: [0.0, 0.0, 0.0, 1.0] }
    }
}
