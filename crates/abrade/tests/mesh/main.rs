//! Triangle meshes through the crate's public face: what is refused, mended, built, resampled.

mod mending;
mod refusal;
mod resampling;
mod solids;

use abrade::TriangleMesh;
use nalgebra::{Point3, Vector3};

/// Vertices and facets.
type Parts = (Vec<Point3<f64>>, Vec<[u32; 3]>);

/// A cube of 8 vertices and 12 facets about `middle`, all facing outward.
fn cube(middle: [f64; 3], edge: f64) -> Parts {
    let mesh = TriangleMesh::cuboid(Vector3::repeat(edge / 2.0), 2.0 * edge).expect("a cube");
    let vertices = mesh.vertices().iter().map(|p| p + Vector3::from(middle)).collect();
    (vertices, mesh.triangles().to_vec())
}

/// Both as one.
fn joined((mut vertices, mut triangles): Parts, (more, facets): Parts) -> Parts {
    let first = vertices.len() as u32;
    vertices.extend(more);
    triangles.extend(facets.iter().map(|t| t.map(|i| i + first)));
    (vertices, triangles)
}

/// Facing the other way.
fn reversed((vertices, triangles): Parts) -> Parts {
    (vertices, triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect())
}
