//! Taking a step back.

use rapier::dynamics::{RigidBodyHandle, RigidBodySet};
use rapier::math::{Pose, Vector};

/// Poses and velocities of the moving bodies before a step.
#[derive(Default)]
pub(crate) struct Rewind {
    saved: Vec<(RigidBodyHandle, Pose, Vector, Vector)>,
}

impl Rewind {
    /// Takes note of every dynamic and kinematic body.
    pub fn save(&mut self, bodies: &RigidBodySet) {
        self.saved.clear();
        let moving = bodies.iter().filter(|(_, rb)| !rb.is_fixed());
        self.saved.extend(moving.map(|(h, rb)| (h, *rb.position(), rb.linvel(), rb.angvel())));
    }

    /// Puts every body back where it was.
    pub fn restore(&self, bodies: &mut RigidBodySet) {
        for (handle, pose, linvel, angvel) in &self.saved {
            let Some(rb) = bodies.get_mut(*handle) else { continue };
            rb.set_position(*pose, false);
            rb.set_linvel(*linvel, false);
            rb.set_angvel(*angvel, false);
        }
    }
}
