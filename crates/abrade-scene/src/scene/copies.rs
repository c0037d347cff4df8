//! Copies of a scene's surface: bodies alike that wear, each on its own.

use abrade::quantity::Quantity;
use schemars::JsonSchema;
use serde::Deserialize;

use super::vectors;

/// Where the copies of a free surface start. They bear its name with a number, move as it says, and
/// wear each on its own.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Copies {
    /// On a grid along the world's axes, counted along x, then y, then z. `position` is that of the
    /// first; of a rotation `Random(seed: s)` the next one has the seed s + 1.
    Grid {
        /// Number of copies along x, y and z, the first one among them.
        counts: [u32; 3],
        /// Distance of neighbours along x, y and z [m].
        #[serde(deserialize_with = "vectors::length3")]
        #[schemars(with = "[Quantity; 3]")]
        spacing: [f64; 3],
    },
}
