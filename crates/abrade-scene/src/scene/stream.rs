//! Streams of a scene: bodies that come one after the other.

use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Motion, Placement, SceneShape, Sizes};

/// Bodies that follow each other, each turned at random. They bear the stream's name with a number.
/// One comes into the world when it is due: a step of the run ends then. One is taken out when it
/// moves away from every surface and is outside of the box around the surfaces and all starts; under
/// gravity, only when it is past the box downwards, for above it turns back.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stream {
    /// Geometry of every body. Either `shape` or `shapes` is given.
    #[serde(default)]
    pub shape: Option<SceneShape>,
    /// Shapes of which each body has one, at random by their shares.
    #[serde(default)]
    pub shapes: Vec<ShapeShare>,
    /// What the shares count (default `Number`).
    #[serde(default)]
    pub shares: Shares,
    /// Sizes to which the shapes are scaled (default: as they are).
    #[serde(default)]
    pub sizes: Option<Sizes>,
    /// Density [kg/m3]; needed unless a clump file gives the mass.
    #[serde(default, deserialize_with = "quantity::optional_density")]
    #[schemars(with = "Option<Quantity>")]
    pub density: Option<f64>,
    /// Number of bodies.
    pub count: u32,
    /// Time from one body to the next [s]. One of `every`, `rate` and `mass_rate` is given.
    #[serde(default, deserialize_with = "quantity::optional_time")]
    #[schemars(with = "Option<Quantity>")]
    pub every: Option<f64>,
    /// Bodies per time [1/s].
    #[serde(default, deserialize_with = "quantity::optional_frequency")]
    #[schemars(with = "Option<Quantity>")]
    pub rate: Option<f64>,
    /// Mass per time [kg/s]: each body takes the time of its mass.
    #[serde(default, deserialize_with = "quantity::optional_mass_rate")]
    #[schemars(with = "Option<Quantity>")]
    pub mass_rate: Option<f64>,
    /// Where they start, at the middle of the disc; says in which axes `motion` counts. The first one
    /// starts at once.
    pub position: Placement,
    /// How they fly: `Free(..)` or `Impact(..)`, at a speed.
    pub motion: Motion,
    /// Radius of the disc square to `motion` over which their starts are spread evenly [m].
    #[serde(default, deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub spread: f64,
    /// Half angle of the cone about `motion` over which their directions are spread evenly [rad],
    /// whatever the start.
    #[serde(default, deserialize_with = "quantity::angle")]
    #[schemars(with = "Quantity")]
    pub divergence: f64,
    /// Seed of the generator (PCG32). Of a random form, such as `Grit`, every body is another one.
    #[serde(default)]
    pub seed: u64,
}

/// A shape and how much of it there is.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShapeShare {
    /// Geometry.
    pub shape: SceneShape,
    /// Its share over those of the other shapes, in any unit [-].
    pub share: f64,
}

/// What shares count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum Shares {
    /// Bodies.
    #[default]
    Number,
    /// Their mass.
    Mass,
}
