//! Closed triangle meshes: the boundaries of solids, as a file or a constructor gives them. A
//! [`TriangleMesh`] that exists is closed, oriented, manifold and free of self-intersections.

mod bend;
mod boxes;
mod change;
mod check;
mod crossing;
mod error;
mod lathe;
mod links;
pub(crate) mod mass;
mod mend;
mod nodes;
mod predicate;
mod resample;
mod shells;
mod solids;

use nalgebra::{Isometry3, Point3};

pub use bend::Bend;
pub use error::MeshError;
pub use mend::Mended;
pub(crate) use nodes::area_vector;

/// The boundary of a solid, which may have several parts and cavities. Facets run
/// counter-clockwise as seen from outside the material.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    vertices: Vec<Point3<f64>>,
    triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// A mesh of these vertices [m] and facets, which is taken as it is or refused. The cost grows
    /// as n log n with the number of facets, a few microseconds for each; with the square of their
    /// number for facets that share one vertex, 60 nanoseconds for each pair.
    ///
    /// # Errors
    /// Whatever keeps it from being the closed boundary of a solid, with the place.
    pub fn new(vertices: Vec<Point3<f64>>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check::check(&vertices, &triangles)?;
        Ok(Self { vertices, triangles })
    }

    /// A mesh of these vertices [m] and facets after repairs that do not change its shape:
    /// vertices that coincide to 1e-9 of the extent become one, facets that collapse by that and
    /// vertices without facets are dropped, facets are turned to agree with their neighbours, and
    /// shells to face away from the material. A shell inside another one becomes a cavity.
    ///
    /// # Errors
    /// As [`TriangleMesh::new`], for what is not repaired.
    pub fn mend(
        vertices: Vec<Point3<f64>>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<(Self, Mended), MeshError> {
        let (vertices, triangles, mended) = mend::mend(vertices, triangles)?;
        Ok((Self::new(vertices, triangles)?, mended))
    }

    /// Vertices [m].
    pub fn vertices(&self) -> &[Point3<f64>] {
        &self.vertices
    }

    /// Facets as indices of their corners, counter-clockwise as seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Enclosed volume [m3], summed about a vertex, so that it does not lose digits far from the
    /// origin.
    pub fn volume(&self) -> f64 {
        let about = self.vertices[0];
        let cone = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|i| self.vertices[i as usize] - about);
            a.dot(&b.cross(&c)) / 6.0
        };
        self.triangles.iter().map(cone).sum()
    }

    /// Area of the surface [m2].
    pub fn area(&self) -> f64 {
        self.triangles.iter().map(|t| area_vector(&self.vertices, t).norm()).sum()
    }

    /// Corners of the box around the mesh [m].
    pub fn bounds(&self) -> [Point3<f64>; 2] {
        let first = self.vertices[0];
        let around = |[low, high]: [Point3<f64>; 2], p: &Point3<f64>| [low.inf(p), high.sup(p)];
        self.vertices.iter().fold([first, first], around)
    }

    /// The mesh at another place: `pose` maps old positions to new ones. Positions are rounded
    /// anew; nothing is checked again.
    pub fn moved(&self, pose: &Isometry3<f64>) -> Self {
        let vertices = self.vertices.iter().map(|p| pose * p).collect();
        Self { vertices, triangles: self.triangles.clone() }
    }
}
