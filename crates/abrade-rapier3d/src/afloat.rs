//! Keeping bodies that Rapier holds on the surface: its contacts give way in position under loads
//! that are large for the body's mass, though not in velocity, until the body has sunk through.

use abrade::{Body, Piece, State};
use nalgebra::{Point3, Vector3};

use crate::surface::WornCollider;

/// How deep the body at `local`, in the surface's frame, lies in the worn surface [m]: the deepest
/// of its lowest points over the nodes; zero if none is in it.
pub(crate) fn depth(body: &Body, local: &State, worn: &WornCollider) -> f64 {
    let surface = &worn.surface;
    let (level, pitch) = (worn.bounds.high.z, surface.pitch());
    let of = |piece: &Piece| match piece {
        Piece::Ball(ball) => {
            let centre = local.position + local.rotation * ball.centre.coords;
            let sag = surface.sag_under_ball(&centre, ball.radius);
            inside(worn, &(centre - Vector3::z() * ball.radius), level - sag)
        }
        Piece::Hull(hull) => {
            let corners = hull.vertices().iter();
            let corners = corners.map(|v| local.position + local.rotation * v.coords);
            let below = corners.filter(|corner| corner.z < level);
            below.map(|c| inside(worn, &c, level - surface.sag_at(&c, pitch))).fold(0.0, f64::max)
        }
    };
    body.shape.pieces().iter().map(of).fold(0.0, f64::max)
}

/// Depth of `point` below `floor` [m], where it is over the nodes.
fn inside(worn: &WornCollider, point: &Point3<f64>, floor: f64) -> f64 {
    let over = (0..2).all(|a| worn.bounds.low[a] <= point[a] && point[a] <= worn.bounds.high[a]);
    if over { (floor - point.z).max(0.0) } else { 0.0 }
}
