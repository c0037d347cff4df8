//! Forms of grains: shapes without a size, for grit of which nobody knows every corner.

use abrade::Polyhedron;
use schemars::JsonSchema;
use serde::Deserialize;

/// A shape of which only proportions are said. Lengths count in whatever the form is largest in; the
/// size comes from the grain's diameter.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum Form {
    /// A sphere.
    Sphere,
    /// A regular polyhedron.
    Polyhedron {
        /// Which one.
        kind: Polyhedron,
    },
    /// A superquadric: (|x/a|^m + |y/b|^m)^(n/m) + |z/c|^n = 1 with exponents (n, m) from 2 on, as the
    /// hull of points on it.
    Superquadric {
        /// Half axes a, b, c, in any unit [-].
        half_axes: [f64; 3],
        /// Exponents n and m; (2, 2) is an ellipsoid, large ones a box [-].
        exponents: [f64; 2],
        /// Rings of points from pole to pole, from 4 to 40 (default 8, with 16 points each).
        #[serde(default = "rings")]
        rings: u32,
    },
    /// A cube with rounded edges and corners, as the hull of ten points per corner.
    RoundedCube {
        /// Radius of edges and corners over the edge of the whole, below 0.5 [-].
        radius: f64,
    },
    /// A cube with its corners cut off.
    TruncatedCube {
        /// Part of an edge that a cut takes away at each end, at most 0.5 [-].
        cut: f64,
    },
    /// A broken grain: the hull of points spread evenly at random over an ellipsoid, another one for
    /// each seed.
    Grit {
        /// Points, from 5 to 200 (default 14); fewer make sharper grains.
        #[serde(default = "grit_points")]
        points: u32,
        /// Longest over middle axis of the ellipsoid, evenly at random between two bounds (default 1)
        /// [-].
        #[serde(default = "unit")]
        elongation: [f64; 2],
        /// Middle over shortest axis, evenly at random between two bounds (default 1) [-].
        #[serde(default = "unit")]
        flatness: [f64; 2],
    },
    /// The hull of the vertices of a mesh.
    Mesh {
        /// STL or OBJ file, looked for beside the file that names it.
        file: String,
    },
    /// A union of spheres.
    Clump {
        /// Clump file, as that of a body's shape.
        file: String,
    },
}

/// A form, or what spheres make of it.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grain {
    /// Its form.
    pub form: Form,
    /// Number of spheres, from 1 to 1000, of a clump that stands for a form with faces (default: the
    /// form itself).
    #[serde(default)]
    pub spheres: Option<u32>,
}

fn rings() -> u32 {
    8
}

fn grit_points() -> u32 {
    14
}

fn unit() -> [f64; 2] {
    [1.0; 2]
}
