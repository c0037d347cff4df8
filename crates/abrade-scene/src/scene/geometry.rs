//! Shapes of a scene's surfaces. Files are looked for beside the scene.

use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

use super::vectors;

/// Shape and nodes of a surface.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Geometry {
    /// A flat plate of nodes in close-packed rows along y, normal along z. The origin of its frame
    /// is the node nearest its middle. Either `pitch` or `nodes` is given.
    HexStrip {
        /// Extent along x [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        length: f64,
        /// Extent along y [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        width: f64,
        /// Distance of neighbouring nodes [m].
        #[serde(default, deserialize_with = "quantity::optional_length")]
        #[schemars(with = "Option<Quantity>")]
        pitch: Option<f64>,
        /// Number of nodes that sets the pitch; a node stands for length * width / nodes.
        #[serde(default)]
        nodes: Option<u32>,
        /// Area a node stands for [m2] (default sqrt(3)/2 pitch^2, or length * width / nodes).
        #[serde(default, deserialize_with = "quantity::optional_area")]
        #[schemars(with = "Option<Quantity>")]
        rest_area: Option<f64>,
    },
    /// A sphere about the origin of its frame.
    Sphere {
        /// Radius [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        radius: f64,
        /// Distance of neighbouring nodes [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        pitch: f64,
    },
    /// A cylinder along z with flat ends, its middle in the origin of its frame.
    Cylinder {
        /// Radius [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        radius: f64,
        /// Extent along z [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        length: f64,
        /// Distance of neighbouring nodes [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        pitch: f64,
    },
    /// A pipe along z, its middle in the origin of its frame; its bore and its ends wear as well.
    Tube {
        /// Radius of the bore [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        inner: f64,
        /// Radius of the outside [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        outer: f64,
        /// Extent along z [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        length: f64,
        /// Distance of neighbouring nodes [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        pitch: f64,
    },
    /// A pipe that turns a corner. Its axis comes along +z to the origin of its frame, turns towards
    /// +x, and goes on straight.
    Bend {
        /// Radius of the bore [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        inner: f64,
        /// Radius of the outside [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        outer: f64,
        /// Radius of the bent axis [m], above `outer`.
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        radius: f64,
        /// Angle by which the axis turns [rad], at most 180 degrees.
        #[serde(deserialize_with = "quantity::angle")]
        #[schemars(with = "Quantity")]
        angle: f64,
        /// Length of the straight pipe before and behind the bend [m].
        #[serde(default, deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        straight: f64,
        /// Distance of neighbouring nodes on the outside of the turn [m]; they are closer on its
        /// inside.
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        pitch: f64,
    },
    /// Everything within a radius of a line along z, whose middle is the origin of its frame.
    Capsule {
        /// Radius [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        radius: f64,
        /// Length of the line, without the round ends [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        length: f64,
        /// Distance of neighbouring nodes [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        pitch: f64,
    },
    /// A box about the origin of its frame, its faces along the axes.
    Cuboid {
        /// Half of its edges along x, y and z [m].
        #[serde(deserialize_with = "vectors::length3")]
        #[schemars(with = "[Quantity; 3]")]
        half_extents: [f64; 3],
        /// Distance of neighbouring nodes [m]; each face takes the nearest that divides it.
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        pitch: f64,
    },
    /// The ground between a plane and a grid of heights, whose first one stands at x = y = 0. Its
    /// walls and its bottom are coarse.
    HeightField {
        /// CSV file of heights without a header [m, times `scale`]: a line runs along x, lines
        /// follow each other along y. Nodes stand where heights are given.
        file: String,
        /// Distance of neighbouring heights along x and y [m].
        #[serde(deserialize_with = "vectors::length2")]
        #[schemars(with = "[Quantity; 2]")]
        spacing: [f64; 2],
        /// Height of the plane that bounds it from below [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        base: f64,
        /// Factor from the file's heights to metres [-].
        #[serde(default = "one")]
        scale: f64,
    },
    /// The solid that a mesh file bounds. What can be mended without a change of shape is, and
    /// said.
    Mesh {
        /// STL or OBJ file of a closed mesh [m, times `scale`].
        file: String,
        /// Distance of neighbouring nodes [m] (default: nodes at the vertices of the file).
        #[serde(default, deserialize_with = "quantity::optional_length")]
        #[schemars(with = "Option<Quantity>")]
        pitch: Option<f64>,
        /// Factor from the file's lengths to metres [-].
        #[serde(default = "one")]
        scale: f64,
    },
}

impl Geometry {
    /// True for a solid, whose nodes face all ways; false for a plate.
    pub fn is_closed(&self) -> bool {
        !matches!(self, Self::HexStrip { .. })
    }
}

fn one() -> f64 {
    1.0
}
