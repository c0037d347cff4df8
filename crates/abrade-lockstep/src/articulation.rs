//! Generalised coordinates of an articulation from the states of its bodies: the inverse of
//! Rapier's forward kinematics, link by link.

use abrade::State;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// Angle by which a sum of turns may differ from one turn that does the same [rad].
const ONE_TURN: f64 = 1e-5;

/// The joint between a link and its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkJoint {
    /// Which of the axes x, y, z of the joint are locked, for displacements and for rotations.
    pub locked: [[bool; 3]; 2],
    /// The joint's frame on the parent and on the link.
    pub frames: [Isometry3<f64>; 2],
}

/// Where a joint stands, as Rapier keeps it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates {
    /// Displacements along the axes of the parent's frame [m].
    pub along: Vector3<f64>,
    /// Angles turned about them [rad], full turns included.
    pub about: Vector3<f64>,
    /// The rotation from the parent's frame to the link's.
    pub rotation: UnitQuaternion<f64>,
}

/// A body of the articulation: its state, and its centre of mass in its own frame [m].
pub type Link = (State, Vector3<f64>);

impl Default for Coordinates {
    fn default() -> Self {
        let (along, about) = (Vector3::zeros(), Vector3::zeros());
        Self { along, about, rotation: UnitQuaternion::identity() }
    }
}

impl Coordinates {
    /// True when the angles are those of one turn from the parent's frame, and no sum of several.
    pub fn is_one_turn(&self) -> bool {
        (self.rotation.scaled_axis() - self.about).norm() < ONE_TURN
    }
}

impl LinkJoint {
    /// True for a joint without a locked rotation.
    pub fn turns_freely(&self) -> bool {
        self.locked[1] == [false; 3]
    }

    /// From the bits of Rapier's `JointAxesMask` and the frames.
    pub fn new(locked: u8, frames: [Isometry3<f64>; 2]) -> Self {
        let is_locked = |part: usize, axis: usize| locked >> (3 * part + axis) & 1 == 1;
        let part = |part| std::array::from_fn(|axis| is_locked(part, axis));
        Self { locked: std::array::from_fn(part), frames }
    }

    /// Where the joint stands between two bodies, by full turns nearest to `last`.
    pub fn coordinates(&self, parent: &Link, link: &Link, last: &Coordinates) -> Coordinates {
        let [on_parent, on_link] = self.frames;
        let place = (pose(parent) * on_parent).inv_mul(&(pose(link) * on_link));
        let turn = (place.rotation * last.rotation.inverse()).scaled_axis();
        let (along, rotation) = (place.translation.vector, place.rotation);
        Coordinates { along, about: last.about + turn, rotation }
    }

    /// The way from one place to another, a number for each free axis: displacements [m], then
    /// rotations [rad].
    pub fn way(&self, from: &Coordinates, to: &Coordinates) -> impl Iterator<Item = f64> {
        let turn = match self.locked[1].iter().filter(|locked| !**locked).count() {
            3 => (to.rotation * from.rotation.inverse()).scaled_axis(),
            _ => to.about - from.about,
        };
        self.free([to.along - from.along, turn])
    }

    /// Velocities along and about each free axis [m/s, rad/s].
    pub fn rates(&self, parent: &Link, link: &Link) -> impl Iterator<Item = f64> {
        let [on_parent, on_link] = self.frames;
        let at = pose(link) * nalgebra::Point3::from(on_link.translation.vector);
        let velocity =
            |(state, _): &Link| state.velocity + state.spin.cross(&(at - state.position));
        let axes = (pose(parent).rotation * on_parent.rotation).inverse();
        let along = axes * (velocity(link) - velocity(parent));
        self.free([along, axes * (link.0.spin - parent.0.spin)])
    }

    /// The components along the free axes.
    fn free(&self, parts: [Vector3<f64>; 2]) -> impl Iterator<Item = f64> {
        let locked = self.locked;
        let free = move |(part, axis): &(usize, usize)| !locked[*part][*axis];
        let all = (0..2).flat_map(|part| (0..3).map(move |axis| (part, axis)));
        all.filter(free).map(move |(part, axis)| parts[part][axis])
    }
}

fn pose((state, com): &Link) -> Isometry3<f64> {
    let origin = state.position.coords - state.rotation * com;
    Isometry3::from_parts(Translation3::from(origin), state.rotation)
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitQuaternion, Vector3};
    use rapier::dynamics::{GenericJointBuilder, JointAxesMask, RigidBodyBuilder, RigidBodyHandle};
    use rapier::geometry::ColliderBuilder;
    use rapier::math::Vector;
    use rapier::pipeline::PhysicsWorld;

    use super::{Coordinates, LinkJoint};
    use crate::convert::{from_pose, from_vector, state};

    /// Fails for coordinates or rates that are off in a frame, a sign, a shift to a centre of
    /// mass or a full turn: Rapier's own kinematics must give back the states of the bodies.
    #[test]
    fn coordinates_are_those_that_rapier_integrates() {
        let mut world = PhysicsWorld::default();
        let body = |x: f64| RigidBodyBuilder::dynamic().translation(Vector::new(x, 0.0, 0.0));
        let collider = || ColliderBuilder::cuboid(0.3, 0.1, 0.2).translation(Vector::Y * 0.2);
        let bodies = [0.0, 1.0, 2.0, 3.0].map(|x| world.insert(body(x), collider()).0);
        let anchor = |joint: GenericJointBuilder| {
            let axis = Vector::new(0.3, -0.2, 0.9);
            joint.local_anchor1(axis).local_anchor2(-axis).local_axis1(axis.normalize())
        };
        let ball = JointAxesMask::LIN_AXES;
        let slide = JointAxesMask::LOCKED_PRISMATIC_AXES;
        let hinge = JointAxesMask::LOCKED_REVOLUTE_AXES;
        for (at, locked) in [ball, slide, hinge].into_iter().enumerate() {
            let joint = anchor(GenericJointBuilder::new(locked));
            world.insert_multibody_joint(bodies[at], bodies[at + 1], joint);
        }
        world.gravity = Vector::ZERO;
        world.step();
        let index = world.multibody_joints.rigid_body_link(bodies[0]).unwrap().multibody;
        let PhysicsWorld { multibody_joints, bodies: set, .. } = &mut world;
        let multibody = multibody_joints.get_multibody_mut(index).unwrap();
        let way = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.4, -0.3, 0.2, 0.5, 7.0];
        multibody.apply_displacements(&way);
        let rates = [1.0, -2.0, 3.0, 0.3, 0.1, -0.2, 0.7, 0.4, -0.5, 0.6, 2.0];
        multibody.generalized_velocity_mut().copy_from_slice(&rates);
        multibody.forward_kinematics(set, true);
        multibody.update_rigid_bodies(set, true);
        // Rapier tells the bodies their velocities in a step.
        world.integration_parameters.dt = 1e-13;
        world.step();
        let multibody = world.multibody_joints.get_multibody(index).unwrap();
        let link = |handle: RigidBodyHandle| {
            let rb = &world.bodies[handle];
            (state(rb), from_vector(rb.local_center_of_mass()))
        };
        let mut at = 6;
        for id in 1..4 {
            let own = multibody.link(id).unwrap();
            let data = own.joint().data;
            let frames = [data.local_frame1, data.local_frame2].map(|frame| from_pose(&frame));
            let joint = LinkJoint::new(data.locked_axes.bits(), frames);
            let parent = multibody.link(own.parent_id().unwrap()).unwrap();
            let ends = [parent, own].map(|l| link(l.rigid_body_handle()));
            // Seven radians are more than a turn: the last place says how many.
            let about = Vector3::x() * if id == 3 { 6.5 } else { 0.0 };
            let rotation = UnitQuaternion::from_scaled_axis(about);
            let last = Coordinates { about, rotation, ..Coordinates::default() };
            let to = joint.coordinates(&ends[0], &ends[1], &last);
            let origin = Coordinates::default();
            let ways = joint.way(&origin, &to);
            for (got, rate) in ways.zip(joint.rates(&ends[0], &ends[1])) {
                assert!((got - way[at]).abs() < 1e-12, "coordinate {at}: {got}");
                assert!((rate - rates[at]).abs() < 1e-9, "rate {at}: {rate}");
                at += 1;
            }
        }
        assert_eq!(at, rates.len());
    }
}
