//! Articulations (Rapier's multibodies) on their way into an island and back: their coordinates
//! follow from the states of their bodies.

use abrade::State;
use abrade_lockstep::rapier as fine;
use abrade_lockstep::{Coordinates, Link, LinkJoint};
use nalgebra::Vector3;
use rapier::dynamics::{
    JointAxesMask, Multibody, MultibodyIndex, MultibodyJoint, MultibodyJointSet, MultibodyLink,
    RigidBodyHandle, RigidBodySet,
};
use rapier::math::DVector;

use crate::lockstep::members::Members;
use crate::{scalar, shadow};

/// Coordinates and velocities that bring an articulation to given states.
pub(crate) struct Motion {
    /// From where its joints are, or from their origin [m, rad].
    displacement: Vec<f64>,
    /// Generalised velocities [m/s, rad/s].
    velocity: Vec<f64>,
}

/// Where the joints of an articulation are displaced from.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Since {
    Now,
    Origin,
}

/// The articulations with a link among the members.
pub(crate) fn articulations(members: &Members, joints: &MultibodyJointSet) -> Vec<MultibodyIndex> {
    let link = |body: &RigidBodyHandle| joints.rigid_body_link(*body);
    let mut all: Vec<_> = members.bodies.iter().filter_map(link).map(|l| l.multibody).collect();
    all.sort_unstable_by_key(|index| index.0.into_raw_parts());
    all.dedup();
    all
}

/// A body of an articulation at a state from elsewhere, or where it stands.
pub(crate) fn link(
    body: RigidBodyHandle,
    bodies: &RigidBodySet,
    state: impl Fn(RigidBodyHandle) -> Option<State>,
) -> Option<Link> {
    let rb = bodies.get(body)?;
    let state = state(body).or_else(|| rb.is_fixed().then(|| shadow::held(rb)))?;
    Some((state, scalar::vector(rb.local_center_of_mass())))
}

/// The motion that brings `multibody` to the states that `link` gives its bodies; nothing if one
/// has none, or if angles that something asks for cannot be counted from their origin.
pub(crate) fn motion(
    multibody: &Multibody,
    from: Since,
    link: impl Fn(RigidBodyHandle) -> Option<Link>,
) -> Option<Motion> {
    let [mut displacement, mut velocity] = [(); 2].map(|()| Vec::with_capacity(multibody.ndofs()));
    for own in multibody.links() {
        let here = link(own.rigid_body_handle())?;
        let Some(parent) = own.parent_id() else {
            // A root that moves goes where its body is.
            let free = own.joint().ndofs();
            displacement.resize(free, 0.0);
            let State { velocity: along, spin, .. } = here.0;
            velocity.extend(along.iter().chain(&spin).take(free));
            continue;
        };
        let parent = link(multibody.link(parent)?.rigid_body_handle())?;
        let joint = read(own.joint());
        let now = coordinates(own.joint());
        let to = joint.coordinates(&parent, &here, &now);
        let start = if from == Since::Now { now } else { Coordinates::default() };
        let counts = joint.turns_freely() && is_told_angles(multibody, own);
        if from == Since::Origin && counts && !to.is_one_turn() {
            return None;
        }
        displacement.extend(joint.way(&start, &to));
        match own.joint().kinematic {
            true => velocity.extend(multibody.joint_velocity(own).iter().map(|v| scalar::wide(*v))),
            false => velocity.extend(joint.rates(&parent, &here)),
        }
    }
    Some(Motion { displacement, velocity })
}

/// Does anything ask a joint for its angles? Those of one that turns freely are sums over its way,
/// which a copy does not know.
fn is_told_angles(multibody: &Multibody, link: &MultibodyLink) -> bool {
    let joint = link.joint();
    let axes = JointAxesMask::ANG_AXES;
    joint.data.limit_axes.intersects(axes)
        || joint.data.motor_axes.intersects(axes)
        || (3..6).any(|axis| joint.spring(axis).0 != 0.0)
        || multibody.couplings().iter().any(|c| [c.link1, c.link2].contains(&link.link_id()))
}

fn read(joint: &MultibodyJoint) -> LinkJoint {
    let frames = [joint.data.local_frame1, joint.data.local_frame2];
    LinkJoint::new(joint.data.locked_axes.bits(), frames.map(|frame| scalar::pose(&frame)))
}

fn coordinates(joint: &MultibodyJoint) -> Coordinates {
    let numbers = joint.coords();
    let part = |first: usize| Vector3::from_fn(|axis, _| scalar::wide(numbers[first + axis]));
    Coordinates { along: part(0), about: part(3), rotation: scalar::rotation(&joint.joint_rot()) }
}

impl Motion {
    /// Moves the embedder's articulation, its bodies with it.
    pub fn apply(&self, multibody: &mut Multibody, bodies: &mut RigidBodySet) {
        let narrow = |numbers: &[f64]| numbers.iter().map(|x| scalar::narrow(*x)).collect();
        let [displacement, velocity]: [Vec<_>; 2] =
            [&self.displacement, &self.velocity].map(|numbers| narrow(numbers));
        multibody.apply_displacements(&displacement);
        multibody.generalized_velocity_mut().copy_from_slice(&velocity);
        multibody.forward_kinematics(bodies, true);
        multibody.update_rigid_bodies(bodies, true);
    }

    /// Moves the articulation of the private world.
    pub fn apply_within(
        &self,
        multibody: &mut fine::dynamics::Multibody,
        bodies: &mut fine::dynamics::RigidBodySet,
    ) {
        multibody.apply_displacements(&self.displacement);
        multibody.generalized_velocity_mut().copy_from_slice(&self.velocity);
        multibody.forward_kinematics(bodies, true);
        multibody.update_rigid_bodies(bodies, true);
    }
}

/// Gives the copy what the descriptions of its joints do not say.
pub(crate) fn dress(multibody: &Multibody, copy: &mut fine::dynamics::Multibody) {
    let n = scalar::wide;
    let widened = |numbers: &DVector| numbers.map(n);
    copy.set_self_contacts_enabled(multibody.self_contacts_enabled());
    copy.damping_mut().copy_from(&widened(multibody.damping()));
    copy.armature_mut().copy_from(&widened(multibody.armature()));
    copy.frictions_mut().copy_from(&widened(multibody.frictions()));
    for (own, copied) in multibody.links().zip(copy.links_mut()) {
        for axis in 0..6 {
            let (stiffness, rest) = own.joint().spring(axis);
            copied.joint.set_spring(axis, n(stiffness), n(rest));
        }
    }
    for c in multibody.couplings() {
        let (coeff, offset) = (n(c.coeff), n(c.offset));
        let (link1, dof1, axis1) = (c.link1, c.dof1, c.axis1);
        let (link2, dof2, axis2) = (c.link2, c.dof2, c.axis2);
        copy.add_dof_coupling(fine::dynamics::MultibodyDofCoupling {
            link1,
            dof1,
            axis1,
            link2,
            dof2,
            axis2,
            coeff,
            offset,
        });
    }
}
