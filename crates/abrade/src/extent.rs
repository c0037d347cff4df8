//! How far a shape reaches: boxes around it, and how far a point is from it.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use crate::body::State;
use crate::hull::Hull;
use crate::shape::{Piece, Shape};

/// A lower bound of the distance from `x` to the shape at `state` [m].
pub(crate) fn clearance(shape: &Shape, state: &State, x: &Point3<f64>) -> f64 {
    if let [Piece::Ball(ball)] = shape.pieces()
        && ball.centre == Point3::origin()
    {
        return (x - state.position).norm() - ball.radius;
    }
    let local = state.rotation.inverse_transform_vector(&(x - state.position));
    shape.pieces().iter().map(|piece| piece_clearance(piece, &local)).fold(f64::INFINITY, f64::min)
}

/// Where a shape is nearest to a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Below zero inside [m]. Beyond the edges of a hull it is that to the plane of the face that
    /// looks at the point most.
    pub distance: f64,
    /// Unit vector from the shape to the point.
    pub normal: Vector3<f64>,
    /// From the centre of mass to there [m].
    pub arm: Vector3<f64>,
}

/// Where the shape at `state` is nearest to `x`.
pub(crate) fn nearest(shape: &Shape, state: &State, x: &Point3<f64>) -> Nearest {
    let away = x - state.position;
    let local = state.rotation.inverse_transform_vector(&away);
    let of = |piece: &Piece| match piece {
        Piece::Ball(ball) => {
            let apart = local - ball.centre.coords;
            let distance = apart.norm();
            (distance - ball.radius, apart / distance.max(f64::MIN_POSITIVE))
        }
        Piece::Hull(hull) => {
            let planes = hull.planes().iter().map(|p| (p.normal.dot(&local) - p.offset, p.normal));
            let facing = planes.reduce(|best, next| if next.0 > best.0 { next } else { best });
            facing.expect("a hull has faces")
        }
    };
    let pieces = shape.pieces().iter().map(of);
    let least = pieces.reduce(|best, next| if next.0 < best.0 { next } else { best });
    let (distance, normal) = least.expect("a shape has at least one piece");
    let normal = state.rotation * normal;
    Nearest { distance, normal, arm: away - normal * distance }
}

fn piece_clearance(piece: &Piece, local: &Vector3<f64>) -> f64 {
    match piece {
        Piece::Ball(ball) => (local - ball.centre.coords).norm() - ball.radius,
        Piece::Hull(hull) => hull
            .planes()
            .iter()
            .map(|plane| plane.normal.dot(local) - plane.offset)
            .fold(f64::NEG_INFINITY, f64::max),
    }
}

/// Box around the shape at `state`, grown by `margin` [m].
pub(crate) fn bounds(shape: &Shape, state: &State, margin: f64) -> [Point3<f64>; 2] {
    let mut low = Point3::from(Vector3::repeat(f64::INFINITY));
    let mut high = -low;
    for piece in shape.pieces() {
        let [l, h] = piece_bounds(piece, &state.position, &state.rotation);
        low = low.inf(&l);
        high = high.sup(&h);
    }
    [low - Vector3::repeat(margin), high + Vector3::repeat(margin)]
}

/// Box around the part of the shape at `state` where n . x <= `top` [m], grown by `margin` [m].
/// Balls count whole.
pub(crate) fn bounds_below(
    shape: &Shape,
    state: &State,
    n: &Vector3<f64>,
    top: f64,
    margin: f64,
) -> [Point3<f64>; 2] {
    let mut low = Point3::from(Vector3::repeat(f64::INFINITY));
    let mut high = -low;
    for piece in shape.pieces() {
        let [l, h] = match piece {
            Piece::Ball(_) => piece_bounds(piece, &state.position, &state.rotation),
            Piece::Hull(hull) => hull_below(hull, state, n, top),
        };
        low = low.inf(&l);
        high = high.sup(&h);
    }
    [low - Vector3::repeat(margin), high + Vector3::repeat(margin)]
}

/// Box around the vertices below the level and the points where edges cross it.
fn hull_below(hull: &Hull, state: &State, n: &Vector3<f64>, top: f64) -> [Point3<f64>; 2] {
    let mut low = Point3::from(Vector3::repeat(f64::INFINITY));
    let mut high = -low;
    let mut add = |p: Point3<f64>| {
        low = low.inf(&p);
        high = high.sup(&p);
    };
    let place = |i: u32| state.position + state.rotation * hull.vertices()[i as usize].coords;
    for facet in hull.facets() {
        let corners = facet.map(place);
        let above = corners.map(|p| p.coords.dot(n) - top);
        for i in 0..3 {
            let j = (i + 1) % 3;
            if above[i] <= 0.0 {
                add(corners[i]);
            }
            if (above[i] < 0.0) != (above[j] < 0.0) {
                let share = above[i] / (above[i] - above[j]);
                add(corners[i] + (corners[j] - corners[i]) * share);
            }
        }
    }
    [low, high]
}

fn piece_bounds(
    piece: &Piece,
    position: &Point3<f64>,
    rotation: &UnitQuaternion<f64>,
) -> [Point3<f64>; 2] {
    match piece {
        Piece::Ball(ball) => {
            let centre = position + rotation * ball.centre.coords;
            let reach = Vector3::repeat(ball.radius);
            [centre - reach, centre + reach]
        }
        Piece::Hull(hull) => {
            let mut low = Point3::from(Vector3::repeat(f64::INFINITY));
            let mut high = -low;
            for vertex in hull.vertices() {
                let placed = position + rotation * vertex.coords;
                low = low.inf(&placed);
                high = high.sup(&placed);
            }
            [low, high]
        }
    }
}
