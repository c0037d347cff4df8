//! Shapes of a scene's bodies. Files are looked for beside the scene.

use abrade::Polyhedron;
use abrade::quantity::{self, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Form, vectors};

/// Geometry of a body. Whatever the coordinates' origin, the body's frame has its own at the centre
/// of mass.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum SceneShape {
    /// A ball.
    Ball {
        /// Radius [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        radius: f64,
    },
    /// A box with its faces along the axes.
    Cuboid {
        /// Edges along x, y and z [m].
        #[serde(deserialize_with = "vectors::length3")]
        #[schemars(with = "[Quantity; 3]")]
        size: [f64; 3],
    },
    /// A regular polyhedron.
    Polyhedron {
        /// Which one.
        kind: Polyhedron,
        /// Edge [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        edge: f64,
    },
    /// The convex hull of points; either `points` or `file` is given.
    ConvexHull {
        /// Points [m].
        #[serde(default, deserialize_with = "vectors::points")]
        #[schemars(with = "Option<Vec<[Quantity; 3]>>")]
        points: Option<Vec<[f64; 3]>>,
        /// STL or OBJ file whose vertices are the points [m, times `scale`].
        #[serde(default)]
        file: Option<String>,
        /// Factor from the file's lengths to metres [-].
        #[serde(default = "one")]
        scale: f64,
    },
    /// A union of spheres; either `spheres` or `file` is given.
    Clump {
        /// Centre and radius of each sphere, (x, y, z, r) [m].
        #[serde(default, deserialize_with = "vectors::spheres")]
        #[schemars(with = "Option<Vec<[Quantity; 4]>>")]
        spheres: Option<Vec<[f64; 4]>>,
        /// Clump file: `x y z r` lines, MClump folder, Kratos `.clu` or LAMMPS molecule
        /// [m, times `scale`].
        #[serde(default)]
        file: Option<String>,
        /// Factor from the file's lengths to metres [-].
        #[serde(default = "one")]
        scale: f64,
        /// Where mass and inertia come from (default `Union`).
        #[serde(default)]
        inertia: ClumpInertia,
    },
    /// A grain of which a form and a size are known.
    Grain {
        /// Its form.
        form: Form,
        /// Diameter of the sphere of the same volume [m].
        #[serde(deserialize_with = "quantity::length")]
        #[schemars(with = "Quantity")]
        diameter: f64,
        /// Number of spheres, from 1 to 1000, of a clump that stands for a form with faces (default:
        /// the form itself).
        #[serde(default)]
        spheres: Option<u32>,
        /// Chooses among the grains of a form that is random.
        #[serde(default)]
        seed: u64,
    },
}

/// Where a clump's mass, centre and inertia come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum ClumpInertia {
    /// From the union of the spheres: an overlap counts once.
    #[default]
    Union,
    /// From the clump file.
    File,
}

fn one() -> f64 {
    1.0
}
