//! How far below each node of a closed surface the material is its own: down to the medial axis,
//! where another part of the surface is as near. So no material is worn twice, by columns that
//! cross.
//!
//! The radius of the largest ball inside the nodes that touches the surface at the node, found by
//! shrinking balls (Ma, Bae & Choi 2012): the node that lies deepest in the ball says how small it
//! has to be.

use nalgebra::{Point3, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::PointProjection;

use crate::nodes::Nodes;

/// Most balls per node: each is smaller than the one before.
const BALLS: usize = 60;
/// Share of the radius by which a node must lie inside for the ball to shrink. On a round body all
/// nodes are as near, and a search for the nearest would look at all.
const INSIDE: f64 = 0.05;
/// Cosine of the angle between normals below which two nodes lie on one smooth part: the facets of
/// a curved part must not make its balls small.
const SAME: f64 = 0.866;

fn parry(p: &Point3<f64>) -> ParryVector {
    ParryVector::new(p.x, p.y, p.z)
}

/// Per node, the depth of the medial axis below it [m], at most half of `extent` [m].
pub(crate) fn reaches(nodes: &Nodes, extent: f64) -> Vec<f64> {
    let points = &nodes.rest_position;
    let leaves: Vec<_> = points.iter().map(|p| Aabb::new(parry(p), parry(p))).collect();
    let bvh = Bvh::from_leaves(BvhBuildStrategy::Binned, &leaves);
    let nearest = |centre: &Point3<f64>, n: &Vector3<f64>, within: f64| {
        let place = |leaf: u32, _: f64| {
            let other = nodes.normal[leaf as usize].dot(n) < SAME;
            other.then(|| PointProjection::new(false, parry(&points[leaf as usize])))
        };
        let found = bvh.project_point(parry(centre), within, place);
        found.map(|(leaf, _)| points[leaf as usize])
    };
    let shrink = |(x, n): (&Point3<f64>, &Vector3<f64>)| {
        let mut radius = 0.5 * extent;
        for _ in 0..BALLS {
            let within = radius * (1.0 - INSIDE);
            let Some(q) = nearest(&(x - n * radius), n, within) else { break };
            let chord = x - q;
            radius = chord.norm_squared() / (2.0 * n.dot(&chord));
        }
        radius
    };
    points.iter().zip(&nodes.normal).map(shrink).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::TriangleMesh;

    fn worst(mesh: &TriangleMesh, depth: impl Fn(&Point3<f64>) -> Option<f64>) -> f64 {
        let nodes = mesh.nodes();
        let pairs = nodes.rest_position.iter().zip(reaches(&nodes, 10.0));
        pairs.filter_map(|(x, reach)| Some((reach - depth(x)?).abs())).fold(0.0, f64::max)
    }

    /// Fails for columns that go half-way through instead of to the nearest other side, and for
    /// balls that a curved surface shrinks by its own facets.
    #[test]
    fn a_node_owns_the_material_down_to_the_medial_axis() {
        let sphere = TriangleMesh::sphere(0.5, 0.05).expect("a sphere");
        let round = worst(&sphere, |_| Some(0.5));
        let half = [1.0, 0.8, 0.3];
        let cuboid = TriangleMesh::cuboid(Vector3::from(half), 0.05).expect("a box");
        // Inside a face: as far as to the nearest edge, at most half the thickness.
        let flat = worst(&cuboid, |x| {
            let mut gaps: Vec<f64> = (0..3).map(|a| half[a] - x[a].abs()).collect();
            gaps.sort_by(f64::total_cmp);
            let inside = gaps[0].abs() < 1e-12 && gaps[1] > 0.04;
            let widths = (0..3).filter(|&a| half[a] - x[a].abs() < 1e-12).map(|a| half[a]);
            inside.then(|| gaps[1].min(widths.fold(1.0, f64::min)))
        });
        assert!(round < 0.02 && flat < 0.05, "{round} {flat}");
    }
}
