//! Sizes of the bodies of a stream.

use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

/// How the diameters of bodies are distributed: of each the diameter of the sphere of its volume.
/// All but `Sieves` count bodies by their number.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Sizes {
    /// All the same.
    Fixed {
        /// Diameter [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        diameter: f64,
    },
    /// Evenly between two diameters.
    Uniform {
        /// Smallest diameter [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        from: f64,
        /// Largest diameter [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        to: f64,
    },
    /// A normal distribution; what lies outside of the cut-offs is drawn again.
    Normal {
        /// Mean before the cut-offs [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        mean: f64,
        /// Standard deviation before the cut-offs [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        deviation: f64,
        /// Smallest diameter [m], at most the mean.
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        from: f64,
        /// Largest diameter [m], at least the mean.
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        to: f64,
    },
    /// A normal distribution of the diameter's logarithm; what lies outside of the cut-offs is drawn
    /// again.
    LogNormal {
        /// Median before the cut-offs [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        median: f64,
        /// Standard deviation of the natural logarithm before the cut-offs [-].
        deviation: f64,
        /// Smallest diameter [m], at most the median.
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        from: f64,
        /// Largest diameter [m], at least the median.
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        to: f64,
    },
    /// Fractions of a sieve analysis. Within one the mass is spread evenly over the diameters.
    Sieves {
        /// The fractions.
        fractions: Vec<Sieve>,
    },
}

/// What lies between two sieves.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sieve {
    /// Mesh of the sieve that it stays on [m].
    #[serde(deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub from: f64,
    /// Mesh of the sieve that it passes [m].
    #[serde(deserialize_with = "quantity::length")]
    #[schemars(with = "Quantity")]
    pub to: f64,
    /// Its mass over that of the other fractions, in any unit [-].
    pub mass: f64,
}
