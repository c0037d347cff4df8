//! The nodes that the vertices of a mesh are: where, facing which way, standing for which area.

use nalgebra::{Point3, Vector3};

use super::TriangleMesh;
use crate::nodes::Nodes;

/// Half the cross product of two edges: as long as the facet is large [m2], along its normal.
pub(crate) fn area_vector(vertices: &[Point3<f64>], corners: &[u32; 3]) -> Vector3<f64> {
    let [a, b, c] = corners.map(|i| vertices[i as usize]);
    (b - a).cross(&(c - a)) / 2.0
}

/// Sum of the area vectors of the facets at each vertex [m2].
pub(super) fn area_sums(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Vec<Vector3<f64>> {
    let mut sums = vec![Vector3::zeros(); vertices.len()];
    for corners in triangles {
        let area = area_vector(vertices, corners);
        corners.iter().for_each(|&i| sums[i as usize] += area);
    }
    sums
}

impl TriangleMesh {
    /// The vertices as nodes of a surface, unworn. A node's area is a third of its facets' as seen
    /// along its normal, A_i = |sum of A_f n_f| / 3. The volume enclosed by facets is linear in
    /// each vertex with that slope, dV/dx_i = sum of A_f n_f / 3, so that sum of A_i * depth is the
    /// volume worn off to first order, at edges and corners too.
    pub(crate) fn nodes(&self) -> Nodes {
        let sums = area_sums(&self.vertices, &self.triangles);
        Nodes {
            rest_position: self.vertices.clone(),
            normal: sums.iter().map(|sum| sum.normalize()).collect(),
            rest_area: sums.iter().map(|sum| sum.norm() / 3.0).collect(),
            depth: vec![0.0; sums.len()],
        }
    }

    /// Distance of neighbours [m] in a close packing of as many nodes on as large an area.
    pub fn pitch(&self) -> f64 {
        (2.0 / 3f64.sqrt() * self.area() / self.vertices.len() as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for areas that are a third of the facets' whatever way they face, for normals that are
    /// not weighted by area, and for normals that face inward.
    #[test]
    fn sinking_the_nodes_removes_the_sum_of_area_times_depth() {
        let half = Vector3::new(0.03, 0.02, 0.01);
        let mesh = TriangleMesh::cuboid(half, 0.005).expect("a cuboid");
        let mut nodes = mesh.nodes();
        let net: Vector3<f64> =
            nodes.normal.iter().zip(&nodes.rest_area).map(|(n, a)| n * *a).sum();
        assert!(net.norm() < 1e-15 * mesh.area() * 10.0, "{net}");
        let depth = |i: usize| 1e-9 * (1.0 + (i % 7) as f64);
        nodes.depth = (0..nodes.len()).map(depth).collect();
        let worn = (0..nodes.len()).map(|i| nodes.position(i)).collect();
        let after = TriangleMesh { vertices: worn, triangles: mesh.triangles.clone() };
        let lost = mesh.volume() - after.volume();
        assert!((nodes.wear_volume() / lost - 1.0).abs() < 1e-6, "{lost:e}");
    }

    /// Fails for nodes in the middle of a flat face that stand for more or less than their share.
    #[test]
    fn a_node_in_a_flat_face_stands_for_its_cell() {
        let mesh = TriangleMesh::cuboid(Vector3::repeat(0.5), 0.25).expect("a cube");
        let nodes = mesh.nodes();
        let middle =
            |i: &usize| (nodes.rest_position[*i] - Point3::new(0.5, 0.0, 0.0)).norm() == 0.0;
        let i = (0..nodes.len()).find(middle).expect("a node in the middle of a face");
        assert!((nodes.rest_area[i] - 0.0625).abs() < 1e-15);
        assert_eq!(nodes.normal[i], Vector3::x());
        let cells = 6.0 / mesh.vertices().len() as f64;
        assert!((mesh.pitch().powi(2) * 0.75f64.sqrt() / cells - 1.0).abs() < 1e-12);
    }
}
