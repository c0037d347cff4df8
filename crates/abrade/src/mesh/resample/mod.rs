//! The same solid with its vertices at another spacing: long edges are split, short ones collapsed,
//! the others flipped, and vertices moved within the surface until they are evenly spread (Botsch &
//! Kobbelt, Symposium on Geometry Processing 2004, p. 185, section 4). Sharp edges stay.

mod features;
mod guard;
mod original;
mod passes;
mod patchwork;
mod relax;
mod spread;

use super::TriangleMesh;
use super::check::bound_count;
use super::error::MeshError;
use super::solids::check_sizes;
use crate::surface::SOLID_NODE_LIMIT;
use features::Features;
use original::Original;
use patchwork::Patchwork;

/// Rounds of all passes, after which little moves.
const ROUNDS: usize = 7;
/// Rounds that only even out the shapes of facets.
const LAST_ROUNDS: usize = 4;

impl TriangleMesh {
    /// The same solid with vertices about `pitch` [m] apart, on the surface of this one. Edges
    /// whose facets meet at more than 30 degrees stay in place, their vertices only move along
    /// them; vertices where not exactly two such edges meet in line stay where they are. A feature
    /// smaller than the pitch keeps its own spacing.
    ///
    /// # Errors
    /// The pitch is out of range or gives too many vertices; the result would not bound a solid.
    pub fn resampled(&self, pitch: f64) -> Result<Self, MeshError> {
        check_sizes([("pitch", pitch)])?;
        let count = self.area() / (0.75f64.sqrt() * pitch * pitch);
        bound_count("vertices", count, SOLID_NODE_LIMIT)?;
        let features = Features::of(self);
        let original = Original::of(self, &features);
        let mut patchwork = Patchwork::of(self, features);
        for _ in 0..ROUNDS {
            passes::split_long(&mut patchwork, pitch)?;
            passes::collapse_short(&mut patchwork, &original, pitch);
            passes::flip(&mut patchwork, passes::evens_valence);
            relax::relax(&mut patchwork, &original);
        }
        for _ in 0..LAST_ROUNDS {
            passes::flip(&mut patchwork, passes::widens);
            relax::relax(&mut patchwork, &original);
        }
        passes::flip(&mut patchwork, passes::widens);
        let (vertices, triangles) = patchwork.into_parts();
        Self::new(vertices, triangles)
            .map_err(|reason| MeshError::Resample { pitch, reason: Box::new(reason) })
    }
}
