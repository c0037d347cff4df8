//! The exact state of a body whose pose Rapier holds rounded.
//!
//! Valid for as long as Rapier's numbers are bit for bit those that were written with it: an
//! embedder who moves a body, or a step of Rapier's own, makes it void by itself.

use abrade::{PhysicsError, State};
use nalgebra::{Isometry3, Translation3};
use rapier::dynamics::RigidBody;
use rapier::math::{Pose, Vector};

use crate::scalar;
#[cfg(feature = "serde-serialize")]
use crate::snapshot::is_state;

/// An exact state and the rounded one it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Shadow {
    /// Frame that `state` is given in.
    pub frame: Isometry3<f64>,
    /// Exact state of the body's frame (origin at the centre of mass).
    pub state: State,
    pose: Pose,
    linvel: Vector,
    angvel: Vector,
}

impl Shadow {
    /// The exact `state`, given in `frame`, of a body that now holds it rounded.
    pub fn of(body: &RigidBody, frame: Isometry3<f64>, state: State) -> Self {
        let (linvel, angvel) = (body.linvel(), body.angvel());
        Self { frame, state, pose: *body.position(), linvel, angvel }
    }

    /// True while the body's pose is the one that was written.
    pub fn holds(&self, body: &RigidBody) -> bool {
        self.pose == *body.position()
    }

    /// The exact state seen from `frame`, velocities changed since by the embedder included.
    fn seen_from(&self, body: &RigidBody, frame: &Isometry3<f64>) -> State {
        let mut state = match self.frame == *frame {
            true => self.state,
            false => self.state.placed_by(&self.frame).seen_from(frame),
        };
        if body.linvel() != self.linvel {
            let change = scalar::vector(body.linvel()) - scalar::vector(self.linvel);
            state.velocity += frame.inverse_transform_vector(&change);
        }
        if body.angvel() != self.angvel {
            let change = scalar::vector(body.angvel()) - scalar::vector(self.angvel);
            state.spin += frame.inverse_transform_vector(&change);
        }
        state
    }
}

/// State of `body` seen from `frame`: exact where a shadow holds, else Rapier's.
pub(crate) fn read(body: &RigidBody, shadow: Option<&Shadow>, frame: &Isometry3<f64>) -> State {
    match shadow {
        Some(shadow) if shadow.holds(body) => shadow.seen_from(body, frame),
        _ => held(body).seen_from(frame),
    }
}

/// An error for a state, `time` [s] into a step, that Rapier's numbers cannot say.
pub(crate) fn check(state: &State, time: f64) -> Result<(), PhysicsError> {
    let parts = [&state.position.coords, &state.velocity, &state.spin];
    match parts.iter().all(|part| part.iter().all(|x| scalar::holds(*x))) {
        true => Ok(()),
        false => Err(PhysicsError::NotFinite { time }),
    }
}

/// The state that Rapier holds, in the world.
pub(crate) fn held(body: &RigidBody) -> State {
    let pose = scalar::pose(body.position());
    State {
        position: pose * nalgebra::Point3::from(scalar::vector(body.local_center_of_mass())),
        rotation: pose.rotation,
        velocity: scalar::vector(body.linvel()),
        spin: scalar::vector(body.angvel()),
    }
}

/// Writes `state`, given in `frame`, to the body, rounded; the shadow keeps what was lost.
pub(crate) fn write(body: &mut RigidBody, frame: Isometry3<f64>, state: State) -> Shadow {
    let world = state.placed_by(&frame);
    let com = scalar::vector(body.local_center_of_mass());
    let origin = world.position - world.rotation * com;
    let pose = Isometry3::from_parts(Translation3::from(origin), world.rotation);
    body.set_position(scalar::to_pose(&pose), false);
    body.set_linvel(scalar::to_vector(&world.velocity), false);
    body.set_angvel(scalar::to_vector(&world.spin), false);
    Shadow::of(body, frame, state)
}

#[cfg(feature = "serde-serialize")]
impl Shadow {
    /// True when it is a state that Rapier's numbers can say.
    pub fn is_sound(&self) -> bool {
        let seen = [scalar::vector(self.linvel), scalar::vector(self.angvel)];
        let seen = seen.iter().flat_map(|part| part.iter()).all(|x| scalar::holds(*x));
        seen && is_state(&self.state, &self.frame)
    }
}
