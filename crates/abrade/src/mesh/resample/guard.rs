//! What a change of the mesh may do to a facet.

use nalgebra::{Point3, Vector3};

use super::patchwork::Patchwork;

/// Cosine of the largest angle by which a facet may turn: 60 degrees.
const LARGEST_TURN: f64 = 0.5;
/// Shape below which no facet may fall, or the worst one get worse.
const LEAST_SHAPE: f64 = 0.4;

pub(super) type Corners = [Point3<f64>; 3];

/// Area vector [m2].
pub(super) fn area([a, b, c]: &Corners) -> Vector3<f64> {
    (b - a).cross(&(c - a)) / 2.0
}

/// Area over squares of the edges, 1 for equal edges and 0 for a line.
pub(super) fn shape(corners: &Corners) -> f64 {
    let [a, b, c] = corners;
    let squares = (b - a).norm_squared() + (c - b).norm_squared() + (a - c).norm_squared();
    4.0 * 3f64.sqrt() * area(corners).norm() / squares
}

/// True if a facet may become another as far as its direction is concerned.
pub(super) fn hardly_turns(old: &Corners, new: &Corners) -> bool {
    let (old, new) = (area(old), area(new));
    new.norm() > 0.0 && old.dot(&new) >= LARGEST_TURN * old.norm() * new.norm()
}

/// True if the vertices in `moved` may all move to `p`: no facet turns far, and the worst shape is
/// good or no worse than it was. Facets with two of them vanish.
pub(super) fn may_move(net: &Patchwork, moved: &[u32], p: Point3<f64>) -> bool {
    let (mut before, mut after) = (f64::INFINITY, f64::INFINITY);
    for t in moved.iter().flat_map(|&i| net.facets_at(i)) {
        let old = t.map(|k| net.points[k as usize]);
        before = before.min(shape(&old));
        if t.iter().filter(|k| moved.contains(k)).count() > 1 {
            continue;
        }
        let new = t.map(|k| if moved.contains(&k) { p } else { net.points[k as usize] });
        if !hardly_turns(&old, &new) {
            return false;
        }
        after = after.min(shape(&new));
    }
    after >= before.min(LEAST_SHAPE)
}
