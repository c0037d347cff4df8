//! Hardness by place.

use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

use super::vectors;

/// A part of a surface that is harder or softer than its material.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// H of the nodes in the box [Pa]; their shear hardness is `shear_ratio` times that.
    #[serde(deserialize_with = "quantity::hardness")]
    #[schemars(with = "Quantity")]
    pub hardness: f64,
    /// Where they are.
    #[serde(rename = "box")]
    pub extent: RegionBox,
}

/// A box in a surface's frame, its faces along the axes and part of it.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegionBox {
    /// Corner with the least coordinates [m].
    #[serde(deserialize_with = "vectors::length3")]
    #[schemars(with = "[Quantity; 3]")]
    pub from: [f64; 3],
    /// Corner with the largest coordinates [m].
    #[serde(deserialize_with = "vectors::length3")]
    #[schemars(with = "[Quantity; 3]")]
    pub to: [f64; 3],
}

/// Hardnesses of places. The file is looked for beside the scene.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HardnessMap {
    /// CSV file without a header, of lines x, y, z [m, times `scale`] in the surface's frame and a
    /// hardness [Pa]. A node has that of the nearest line.
    pub file: String,
    /// Factor from the file's lengths to metres [-].
    #[serde(default = "one")]
    pub scale: f64,
}

fn one() -> f64 {
    1.0
}
