//! The undeformed solid below a mesh surface: what lies inside it.

use nalgebra::{Point3, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::{Shape, TriMesh, TriMeshFlags};

use crate::elastic::ball_radius;

/// The rest shape of a mesh surface.
#[derive(Clone, Debug)]
pub(crate) struct Solid {
    shape: TriMesh,
}

fn parry(v: &Vector3<f64>) -> ParryVector {
    ParryVector::new(v.x, v.y, v.z)
}

impl Solid {
    /// None when the facets bound no solid.
    pub(crate) fn new(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Option<Self> {
        let corners: Vec<_> = vertices.iter().map(|p| parry(&p.coords)).collect();
        let shape =
            TriMesh::with_flags(corners, triangles.to_vec(), TriMeshFlags::ORIENTED).ok()?;
        Some(Self { shape })
    }

    /// Diagonal of the box around it [m].
    pub(crate) fn extent(&self) -> f64 {
        self.shape.local_aabb().extents().length()
    }

    /// Radius of a ball of its volume [m].
    pub(crate) fn size(&self) -> f64 {
        let properties = self.shape.mass_properties(1.0);
        ball_radius(properties.mass())
    }

    /// Facets as indices of their corners, counter-clockwise as seen from outside.
    pub(crate) fn triangles(&self) -> &[[u32; 3]] {
        self.shape.indices()
    }

    /// Calls `visit` with the corners of every facet that may meet the box.
    pub(crate) fn visit_facets(
        &self,
        low: &Point3<f64>,
        high: &Point3<f64>,
        mut visit: impl FnMut([u32; 3]),
    ) {
        let [low, high] = [low, high].map(|p| parry(&p.coords));
        let around = Aabb::new(low, high);
        let facets = self.triangles();
        self.shape.bvh().intersect_aabb(&around).for_each(|at| visit(facets[at as usize]));
    }

    /// Depth of a point below the surface [m]; zero outside.
    pub(crate) fn depth(&self, point: &Point3<f64>) -> f64 {
        let point = parry(&point.coords);
        let bounds = self.shape.local_aabb();
        if !bounds.contains_local_point(point) {
            return 0.0;
        }
        let projection = self.shape.project_local_point(point, false);
        if projection.is_inside { (projection.point - point).length() } else { 0.0 }
    }
}
