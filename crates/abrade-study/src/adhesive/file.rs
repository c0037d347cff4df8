//! The files (RON): a scene of two asperities, and a map of many collisions.

use abrade::quantity::{self, Quantity};
use abrade_adhesive::{Asperities, Solid};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};

/// The version of both files that this program reads.
pub const VERSION: u32 = 1;

/// One collision of two asperities.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Version of the file's form; this one is 1.
    pub version: u32,
    /// What the scene is called: the title of its results.
    pub name: String,
    /// What both bodies consist of (default: the paper's reference values).
    #[serde(default)]
    pub solid: Solid,
    /// The bodies and their way past each other (default: the paper's, as far as it tells them).
    #[serde(default)]
    pub bodies: Asperities,
    /// File of places along x, rising from 0 to the period, and heights [m], a line each, beside the scene:
    /// the outline in the place of `bodies.profile`. It closes: both ends are of one height.
    #[serde(default)]
    pub outline: Option<String>,
    /// Instants that ParaView files show beside the end (default 20); at most one a step [-].
    #[serde(default = "frames")]
    pub frames: u32,
    /// Rows of the time series beside the end (default 400); at most one a step [-].
    #[serde(default = "rows")]
    pub rows: u32,
}

/// Collisions over a grid of parameters, each from several gaps at the start.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapFile {
    /// Version of the file's form; this one is 1.
    pub version: u32,
    /// What the map is called: the title of its results.
    pub name: String,
    /// What both bodies consist of (default: the paper's reference values); without `adhesion`, which
    /// `adhesion_ratios` give, and without what another list gives.
    #[serde(default)]
    pub solid: Solid,
    /// The bodies and their way past each other (default: the paper's, as far as it tells them); without
    /// `gap`, which `gaps` give.
    #[serde(default)]
    pub bodies: Asperities,
    /// Ratios of strength a (default: that of the solid) [-].
    #[serde(default)]
    pub strength_ratios: Vec<f64>,
    /// Shear strengths sigma_j (default: that of the solid) [Pa].
    #[serde(default, deserialize_with = "pressures")]
    #[schemars(with = "Vec<Quantity>")]
    pub shear_strengths: Vec<f64>,
    /// Adhesion over shear strength, sigma_0 / sigma_j [-]. Points above the tensile strength are left out.
    pub adhesion_ratios: Vec<f64>,
    /// Gaps at the start (default: 1.2, 1.35, 1.5, 1.65, 1.8): the failure of links is chaotic, and one
    /// collision is one draw [diameters].
    #[serde(default = "gaps")]
    pub gaps: Vec<f64>,
}

fn frames() -> u32 {
    20
}

fn rows() -> u32 {
    400
}

fn gaps() -> Vec<f64> {
    vec![1.2, 1.35, 1.5, 1.65, 1.8]
}

fn pressures<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<f64>, D::Error> {
    quantity::PRESSURE.list(d)
}
