//! When a body in contact only rings on its springs.

use nalgebra::Vector3;

use abrade::{Body, Piece, Placed};

/// Periods over which a body must be slow before it rests.
const PERIODS: f64 = 3.0;

/// How long a body has been slow in contact.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Calm {
    slow: f64,
    /// It rests on a contact of Rapier's.
    pub rests: bool,
}

impl Calm {
    /// Looks at the body after a step of `dt` [s] whose contact has the given `period` [s].
    pub fn watch(&mut self, speed: f64, limit: f64, touching: bool, period: f64, dt: f64) {
        if speed >= limit {
            self.slow = 0.0;
        } else if touching {
            self.slow += dt;
            self.rests = self.slow > PERIODS * period;
        }
    }

    /// Back to springs.
    pub fn wake(&mut self) {
        *self = Self::default();
    }
}

/// Bound of the speed at which points of the body move along the surfaces' normals [m/s].
pub(crate) fn normal_speed(body: &Body, surfaces: &[Placed<'_>]) -> f64 {
    let speed = |placed: &Placed<'_>| {
        let up: Vector3<f64> = placed.pose.rotation * Vector3::z();
        let lever = match body.shape.pieces() {
            [Piece::Ball(ball)] => ball.centre.coords.norm(),
            _ => body.shape.bounding_radius(),
        };
        let tilting = body.state.spin - up * up.dot(&body.state.spin);
        body.state.velocity.dot(&up).abs() + tilting.norm() * lever
    };
    surfaces.iter().map(speed).fold(0.0, f64::max)
}
