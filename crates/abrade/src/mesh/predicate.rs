//! Exact tests on segments and triangles: signs of determinants without rounding (Shewchuk,
//! Discrete Comput. Geom. 18 (1997) 305), so that touching is told from missing to the last bit.

use std::cmp::Ordering;

use nalgebra::Point3;
use shewchuk::{Coord, Coord3D, orient2d, orient3d};

pub(super) type Corners = [Point3<f64>; 3];

/// Side of the plane of a triangle on which `p` lies; zero in the plane.
pub(super) fn side(triangle: &Corners, p: &Point3<f64>) -> i8 {
    let [a, b, c] = triangle;
    // Facets across an axis are common, and dear for exact arithmetic.
    if (0..3).any(|k| a[k] == p[k] && b[k] == p[k] && c[k] == p[k]) {
        return 0;
    }
    volume(a, b, c, p)
}

/// True if the closed segment has a point in common with the closed triangle. `sides` are those of
/// its ends.
pub(super) fn segment_meets(
    triangle: &Corners,
    segment: [&Point3<f64>; 2],
    sides: [i8; 2],
) -> bool {
    match sides[0] * sides[1] {
        1 => false,
        0 if sides[0] == sides[1] => meets_in_plane(triangle, segment),
        _ => line_meets(triangle, segment),
    }
}

/// True if `p` and `q`, in one plane with the edge from `a` to `b`, lie on the same side of it.
pub(super) fn on_one_side([a, b]: [&Point3<f64>; 2], p: &Point3<f64>, q: &Point3<f64>) -> bool {
    let axis = flat_axis(&[*a, *b, *p]);
    let [a, b, p, q] = [a, b, p, q].map(|v| seen_along(v, axis));
    area(a, b, p) * area(a, b, q) > 0
}

/// A line that is not in the plane of the triangle: it passes all edges on the same side.
fn line_meets([a, b, c]: &Corners, [p, q]: [&Point3<f64>; 2]) -> bool {
    let turns = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
    turns.iter().all(|t| *t >= 0) || turns.iter().all(|t| *t <= 0)
}

fn meets_in_plane(triangle: &Corners, [p, q]: [&Point3<f64>; 2]) -> bool {
    let axis = flat_axis(triangle);
    let corners = triangle.map(|v| seen_along(&v, axis));
    let (p, q) = (seen_along(p, axis), seen_along(q, axis));
    let edge = |k: usize| [corners[k], corners[(k + 1) % 3]];
    let turns = [0, 1, 2].map(|k| area(edge(k)[0], edge(k)[1], p));
    let holds_p = turns.iter().all(|t| *t >= 0) || turns.iter().all(|t| *t <= 0);
    holds_p || (0..3).any(|k| segments_meet([p, q], edge(k)))
}

fn segments_meet([p, q]: [Coord<f64>; 2], [a, b]: [Coord<f64>; 2]) -> bool {
    let (of_a, of_b) = (area(p, q, a), area(p, q, b));
    let (of_p, of_q) = (area(a, b, p), area(a, b, q));
    if [of_a, of_b, of_p, of_q] == [0; 4] {
        let overlap = |p: f64, q: f64, a: f64, b: f64| p.min(q) <= a.max(b) && a.min(b) <= p.max(q);
        return overlap(p.x, q.x, a.x, b.x) && overlap(p.y, q.y, a.y, b.y);
    }
    of_a * of_b <= 0 && of_p * of_q <= 0
}

/// Axis along which a triangle that has an area shows one.
fn flat_axis([a, b, c]: &Corners) -> usize {
    let normal = (b - a).cross(&(c - a));
    let likely = normal.iamax();
    let shows = |axis: usize| {
        let [a, b, c] = [a, b, c].map(|v| seen_along(v, axis));
        area(a, b, c) != 0
    };
    (0..3).map(|k| (likely + k) % 3).find(|axis| shows(*axis)).unwrap_or(likely)
}

fn seen_along(p: &Point3<f64>, axis: usize) -> Coord<f64> {
    Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] }
}

fn area(a: Coord<f64>, b: Coord<f64>, c: Coord<f64>) -> i8 {
    sign(orient2d(a, b, c))
}

fn volume(a: &Point3<f64>, b: &Point3<f64>, c: &Point3<f64>, d: &Point3<f64>) -> i8 {
    let [a, b, c, d] = [a, b, c, d].map(|p| Coord3D { x: p.x, y: p.y, z: p.z });
    sign(orient3d(a, b, c, d))
}

fn sign(x: f64) -> i8 {
    match x.partial_cmp(&0.0) {
        Some(Ordering::Greater) => 1,
        Some(Ordering::Less) => -1,
        _ => 0,
    }
}
