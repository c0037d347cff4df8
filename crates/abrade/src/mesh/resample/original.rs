//! The surface that is resampled: gives the nearest points on its patches and chains.

use nalgebra::Point3;
use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::partitioning::Bvh;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::{Segment, Triangle};

use super::super::crossing::{box_of, tree};
use super::features::Features;
use crate::mesh::TriangleMesh;

pub(super) struct Original {
    facets: Vec<Triangle>,
    patch: Vec<u32>,
    facet_tree: Bvh,
    segments: Vec<Segment>,
    chain: Vec<u32>,
    segment_tree: Bvh,
}

impl Original {
    pub(super) fn of(mesh: &TriangleMesh, features: &Features) -> Self {
        let at = |i: u32| mesh.vertices()[i as usize];
        let facets: Vec<[Point3<f64>; 3]> = mesh.triangles().iter().map(|t| t.map(at)).collect();
        let segments: Vec<[Point3<f64>; 2]> = features.chain.keys().map(|e| e.map(at)).collect();
        let facet_boxes: Vec<_> = facets.iter().map(|f| box_of(f)).collect();
        let segment_boxes: Vec<_> = segments.iter().map(|s| box_of(s)).collect();
        Self {
            facet_tree: tree(&facet_boxes),
            segment_tree: tree(&segment_boxes),
            facets: facets.iter().map(|f| Triangle::from(f.map(to_parry))).collect(),
            segments: segments.iter().map(|s| Segment::from(s.map(to_parry))).collect(),
            patch: features.patch.clone(),
            chain: features.chain.values().copied().collect(),
        }
    }

    /// Nearest point on a patch.
    pub(super) fn on_patch(&self, p: Point3<f64>, patch: u32) -> Point3<f64> {
        nearest(&self.facet_tree, p, |i| {
            (self.patch[i] == patch).then(|| &self.facets[i] as &dyn PointQuery)
        })
    }

    /// Nearest point on a chain.
    pub(super) fn on_chain(&self, p: Point3<f64>, chain: u32) -> Point3<f64> {
        nearest(&self.segment_tree, p, |i| {
            (self.chain[i] == chain).then(|| &self.segments[i] as &dyn PointQuery)
        })
    }
}

/// Nearest point on the leaves that have a `piece`; `p` itself if none has.
fn nearest<'a>(
    tree: &Bvh,
    p: Point3<f64>,
    piece: impl Fn(usize) -> Option<&'a dyn PointQuery>,
) -> Point3<f64> {
    let at = to_parry(p);
    let project = |leaf: u32, _| piece(leaf as usize).map(|s| s.project_local_point(at, false));
    let found = tree.project_point(at, f64::MAX, project);
    found.map_or(p, |(_, (_, hit))| Point3::new(hit.point.x, hit.point.y, hit.point.z))
}

fn to_parry(p: Point3<f64>) -> ParryVector {
    ParryVector::new(p.x, p.y, p.z)
}
