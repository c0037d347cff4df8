//! The parts of a physics world that choosing and resolving look at.

use rapier::dynamics::{
    ImpulseJointSet, IntegrationParameters, Multibody, MultibodyJointSet, RigidBodyHandle,
    RigidBodySet,
};
use rapier::geometry::{ColliderSet, NarrowPhase};
use rapier::math::Vector;
use rapier::pipeline::PhysicsWorld;

/// Borrowed parts of a physics world, for [`WearWorld::begin_step`](crate::WearWorld::begin_step)
/// and [`WearWorld::end_step`](crate::WearWorld::end_step).
pub struct WorldView<'a> {
    /// Acceleration of gravity [m/s2].
    pub gravity: Vector,
    /// Parameters of the coming step.
    pub parameters: &'a IntegrationParameters,
    /// The bodies; velocities of resolved ones are set.
    pub bodies: &'a mut RigidBodySet,
    /// The colliders; those of bodies that were moved follow.
    pub colliders: &'a mut ColliderSet,
    /// The joints.
    pub impulse_joints: &'a ImpulseJointSet,
    /// The articulations; those of an island are moved.
    pub multibody_joints: &'a mut MultibodyJointSet,
    /// The contacts of the last step.
    pub narrow_phase: &'a NarrowPhase,
}

impl<'a> WorldView<'a> {
    /// The parts of `world`.
    pub fn of(world: &'a mut PhysicsWorld) -> Self {
        Self {
            gravity: world.gravity,
            parameters: &world.integration_parameters,
            bodies: &mut world.bodies,
            colliders: &mut world.colliders,
            impulse_joints: &world.impulse_joints,
            multibody_joints: &mut world.multibody_joints,
            narrow_phase: &world.narrow_phase,
        }
    }

    /// Brings the bodies of articulations that have not been stepped yet to where their joints are,
    /// as Rapier's step does.
    pub(crate) fn join_new_articulations(&mut self) {
        let is_new = |multibody: &Multibody| {
            multibody.body_jacobian(0).ncols() != multibody.generalized_velocity().nrows()
        };
        let firsts = self.multibody_joints.iter().filter(|(_, link, _, _)| link.id == 1);
        let new = firsts.filter(|(_, _, multibody, _)| is_new(multibody));
        let new: Vec<_> = new.map(|(_, link, _, _)| link.multibody).collect();
        for index in new {
            if let Some(multibody) = self.multibody_joints.get_multibody_mut(index) {
                multibody.forward_kinematics(self.bodies, true);
                multibody.update_rigid_bodies(self.bodies, true);
            }
        }
    }

    pub(crate) fn jointed(&self, body: RigidBodyHandle) -> bool {
        self.impulse_joints.attached_enabled_joints(body).next().is_some()
            || self.multibody_joints.rigid_body_link(body).is_some()
    }
}
