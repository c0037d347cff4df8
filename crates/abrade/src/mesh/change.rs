//! A mesh after a small change, against what it was: only what has moved is looked at closely.

use nalgebra::Point3;

use super::TriangleMesh;
use super::check;
use super::crossing;
use super::error::MeshError;
use super::links;
use super::nodes::area_vector;
use super::shells::shells;

/// Area of a facet over that of one with equal edges as long as its longest, below which it counts
/// as collapsed.
const COLLAPSED: f64 = 1e-3;

impl TriangleMesh {
    /// A mesh that is taken as it is, by one that answers for it.
    pub(crate) fn trusted(vertices: Vec<Point3<f64>>, triangles: Vec<[u32; 3]>) -> Self {
        Self { vertices, triangles }
    }

    /// The middle of a facet that has turned over or collapsed in the change from `before` [m].
    pub(crate) fn spoilt_since(&self, before: &Self) -> Option<Point3<f64>> {
        let spoilt = |facet: &usize| {
            let (old, new) = (&before.triangles[*facet], &self.triangles[*facet]);
            let now = area_vector(&self.vertices, new);
            let turned = old == new && now.dot(&area_vector(&before.vertices, old)) <= 0.0;
            turned || now.norm() <= COLLAPSED * 0.75f64.sqrt() / 2.0 * self.longest(new)
        };
        let facet = self.changed_since(before).find(spoilt)?;
        let [a, b, c] = self.triangles[facet].map(|i| self.vertices[i as usize]);
        Some(nalgebra::center(&nalgebra::center(&a, &b), &c))
    }

    /// Fails unless the mesh bounds a solid, given that `before` does and that edges were flipped
    /// and vertices moved at most.
    pub(crate) fn check_since(&self, before: &Self) -> Result<(), MeshError> {
        let Self { vertices, triangles } = self;
        check::indices(vertices, triangles)?;
        check::areas(vertices, triangles)?;
        let mut moved = vec![false; triangles.len()];
        self.changed_since(before).for_each(|facet| moved[facet] = true);
        crossing::check_some(vertices, triangles, &moved)?;
        let twins = links::twins(&links::sides(triangles));
        check::orientation(&shells(vertices, triangles, &twins))?;
        check::normals(vertices, triangles)
    }

    /// Facets that are not where they were.
    fn changed_since<'a>(&'a self, before: &'a Self) -> impl Iterator<Item = usize> + 'a {
        let still = |i: &u32| self.vertices[*i as usize] == before.vertices[*i as usize];
        (0..self.triangles.len()).filter(move |&facet| {
            let corners = &self.triangles[facet];
            *corners != before.triangles[facet] || !corners.iter().all(still)
        })
    }

    /// Square of the longest edge of a facet [m2].
    fn longest(&self, corners: &[u32; 3]) -> f64 {
        let [a, b, c] = corners.map(|i| self.vertices[i as usize]);
        [b - a, c - b, a - c].map(|edge| edge.norm_squared()).into_iter().fold(0.0, f64::max)
    }
}
