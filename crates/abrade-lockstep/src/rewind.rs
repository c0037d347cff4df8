//! Taking a step back.

use rapier::dynamics::{Multibody, MultibodyIndex, MultibodyJointSet, RigidBodyHandle};
use rapier::math::{Pose, Vector};
use rapier::pipeline::PhysicsWorld;

/// Poses and velocities of the moving bodies, and the articulations, before a step.
#[derive(Default)]
pub(crate) struct Rewind {
    saved: Vec<(RigidBodyHandle, Pose, Vector, Vector)>,
    articulations: Vec<(MultibodyIndex, Multibody)>,
}

impl Rewind {
    /// Takes note of every dynamic and kinematic body, and of every articulation.
    pub fn save(&mut self, world: &PhysicsWorld) {
        self.saved.clear();
        let moving = world.bodies.iter().filter(|(_, rb)| !rb.is_fixed());
        self.saved.extend(moving.map(|(h, rb)| (h, *rb.position(), rb.linvel(), rb.angvel())));
        self.articulations.clear();
        let copied = |(index, multibody): (_, &Multibody)| (index, multibody.clone());
        self.articulations.extend(chains(&world.multibody_joints).map(copied));
    }

    /// Puts every body back where it was.
    pub fn restore(&self, world: &mut PhysicsWorld) {
        for (handle, pose, linvel, angvel) in &self.saved {
            let Some(rb) = world.bodies.get_mut(*handle) else { continue };
            rb.set_position(*pose, false);
            rb.set_linvel(*linvel, false);
            rb.set_angvel(*angvel, false);
        }
        for (index, multibody) in &self.articulations {
            if let Some(now) = world.multibody_joints.get_multibody_mut(*index) {
                now.clone_from(multibody);
            }
        }
    }
}

/// The articulations of a world.
pub(crate) fn chains(
    joints: &MultibodyJointSet,
) -> impl Iterator<Item = (MultibodyIndex, &Multibody)> {
    let first = joints.iter().filter(|(_, link, _, _)| link.id == 1);
    first.map(|(_, link, multibody, _)| (link.multibody, multibody))
}
