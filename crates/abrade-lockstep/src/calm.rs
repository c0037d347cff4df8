//! When a body in contact only rings on its springs.

use nalgebra::Vector3;

use abrade::{Body, Piece, Placed};

/// Periods over which a body must be slow before it rests.
const PERIODS: f64 = 3.0;

/// How long a body has been slow in contact.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Calm {
    slow: f64,
    still: f64,
    /// It only rings on its springs, though it may wear as it slides along.
    pub is_slow: bool,
    /// It rests on a contact of Rapier's.
    pub rests: bool,
}

/// What a step showed of a body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Speed along the surfaces' normals [m/s], and the one below which it is slow.
    pub speed: f64,
    pub limit: f64,
    pub touches: bool,
    /// A node has flowed.
    pub wears: bool,
    /// Period on its springs [s].
    pub period: f64,
    pub dt: f64,
}

impl Calm {
    /// Looks at the body after a step.
    pub fn watch(&mut self, seen: &Seen) {
        if seen.speed >= seen.limit {
            self.slow = 0.0;
        } else if seen.touches {
            self.slow += seen.dt;
        }
        self.still = if seen.wears { 0.0 } else { self.still + seen.dt };
        let long = PERIODS * seen.period;
        self.is_slow = self.slow > long;
        self.rests = self.is_slow && self.still > long;
    }

    /// Back to springs.
    pub fn wake(&mut self) {
        *self = Self::default();
    }
}

/// Bound of the speed at which points of the body move along the surface's normal [m/s].
pub(crate) fn normal_speed(body: &Body, placed: &Placed<'_>) -> f64 {
    let up: Vector3<f64> = placed.pose.rotation * Vector3::z();
    let lever = match body.shape.pieces() {
        [Piece::Ball(ball)] => ball.centre.coords.norm(),
        _ => body.shape.bounding_radius(),
    };
    let tilting = body.state.spin - up * up.dot(&body.state.spin);
    body.state.velocity.dot(&up).abs() + tilting.norm() * lever
}
