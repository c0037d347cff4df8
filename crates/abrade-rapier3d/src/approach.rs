//! How fast a body comes down on a surface.

use abrade::{Body, Piece, State};
use nalgebra::{Isometry3, Point3, Vector3};

/// How a body comes down on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Strike {
    /// Largest speed with which a point of it meets the surface [m/s].
    pub speed: f64,
    /// Least gap between the two now [m].
    pub gap: f64,
}

impl Strike {
    /// Both: the faster, and the nearer.
    pub fn and(self, other: Self) -> Self {
        Self { speed: self.speed.max(other.speed), gap: self.gap.min(other.gap) }
    }
}

/// Largest speed [m/s] with which a point of the body meets the plane of a surface within `dt`
/// [s], in free fall with the downward acceleration `pull` [m/s2]; `None` if none gets there.
/// `body` is in the world, the surface's frame is `frame`, its plane z = `level` [m].
pub(crate) fn strike_speed(
    body: &Body,
    state: &State,
    frame: &Isometry3<f64>,
    level: f64,
    pull: f64,
    dt: f64,
) -> Option<Strike> {
    let local = state.seen_from(frame);
    let pieces = body.shape.pieces().iter();
    let strikes = pieces.filter_map(|piece| match piece {
        Piece::Ball(ball) => {
            let arm = local.rotation * ball.centre.coords;
            strike(&local, arm - Vector3::z() * ball.radius, level, pull, dt)
        }
        Piece::Hull(hull) => hull
            .vertices()
            .iter()
            .filter_map(|v| strike(&local, local.rotation * v.coords, level, pull, dt))
            .reduce(Strike::and),
    });
    strikes.reduce(Strike::and)
}

/// The same for the point at `arm` [m] from the centre of mass.
fn strike(local: &State, arm: Vector3<f64>, level: f64, pull: f64, dt: f64) -> Option<Strike> {
    let point: Point3<f64> = local.position + arm;
    // A ball's lowest point is another one as it turns: its centre's speed counts.
    let speed = -(local.velocity + local.spin.cross(&arm)).z;
    let gap = (point.z - level).max(0.0);
    let reached = speed * dt + 0.5 * pull * dt * dt >= gap;
    let squared = speed * speed.abs() + 2.0 * pull * gap;
    reached.then(|| Strike { speed: squared.max(0.0).sqrt(), gap })
}
