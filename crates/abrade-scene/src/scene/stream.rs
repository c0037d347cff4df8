//! Streams of a scene: bodies alike, one after the other.

use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Motion, Placement, SceneShape};

/// Bodies alike that follow each other. All are there from the start, in a row behind the first
/// one, and bear the stream's name with a number. Each is turned at random.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stream {
    /// Geometry of every body.
    pub shape: SceneShape,
    /// Density [kg/m3]; needed unless a clump file gives the mass.
    #[serde(default, deserialize_with = "quantity::optional_density")]
    #[schemars(with = "Option<Quantity>")]
    pub density: Option<f64>,
    /// Number of bodies.
    pub count: u32,
    /// Time from one body to the next [s].
    #[serde(deserialize_with = "quantity::time")]
    #[schemars(with = "Quantity")]
    pub every: f64,
    /// Where the first one starts; says in which axes `motion` counts. All are there from the start, the
    /// others behind it along their velocity: leave room there, and mind that gravity pulls them all.
    pub position: Placement,
    /// How they fly: `Free(..)` or `Impact(..)`, at a speed.
    pub motion: Motion,
    /// Radius of the disc square to their velocity over which they are spread evenly [m].
    #[serde(default, deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub spread: f64,
    /// Seed of the generator (PCG32).
    #[serde(default)]
    pub seed: u64,
}
