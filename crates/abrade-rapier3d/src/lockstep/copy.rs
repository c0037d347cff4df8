//! The private world of an island: bodies as they were before the step, colliders, joints.

use std::collections::BTreeMap;

use abrade::State;
use abrade_lockstep::rapier as fine;
use abrade_lockstep::{Link, to_pose, to_vector};
use fine::dynamics::{LockedAxes, MassProperties, RigidBodyBuilder};
use fine::math::Matrix;
use fine::pipeline::PhysicsWorld;
use nalgebra::{Isometry3, Translation3, Vector3};
use rapier::dynamics::{Multibody, RigidBody, RigidBodyHandle};
use rapier::geometry::{Collider, ColliderHandle};
use rapier::math::Pose;

use crate::derive::is_solid;
use crate::event::Refusal;
use crate::held::Before;
use crate::lockstep::articulation::{Since, articulations, dress, link, motion};
use crate::lockstep::members::Members;
use crate::lockstep::widen;
use crate::scalar;
use crate::tracked::Tracked;
use crate::view::WorldView;

/// The private world, and what stands there for what.
pub(crate) struct Twin {
    pub world: PhysicsWorld,
    pub bodies: BTreeMap<(u32, u32), fine::dynamics::RigidBodyHandle>,
    pub standing: BTreeMap<(u32, u32), fine::geometry::ColliderHandle>,
    /// Bodies that stand, with a joint to a member.
    anchors: BTreeMap<(u32, u32), fine::dynamics::RigidBodyHandle>,
}

/// Copies the members as they were before the step.
pub(crate) fn copy(
    members: &Members,
    world: &WorldView<'_>,
    before: &Before,
    tracked: &[Option<Tracked>],
) -> Result<Twin, Refusal> {
    let mut inner = PhysicsWorld {
        gravity: to_vector(&scalar::vector(world.gravity)),
        ..PhysicsWorld::default()
    };
    inner.integration_parameters.length_unit = scalar::wide(world.parameters.length_unit);
    let (bodies, standing, anchors) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
    let mut copy = Twin { world: inner, bodies, standing, anchors };
    for &handle in &members.bodies {
        let (Some(rb), Some(state)) = (world.bodies.get(handle), before.of(handle)) else {
            continue;
        };
        copy.add_body(handle, rb, state, tracked, world)?;
    }
    for &handle in &members.standing {
        let Some(collider) = world.colliders.get(handle) else { continue };
        copy.add_standing(handle, collider, world)?;
    }
    copy.add_joints(world);
    for index in articulations(members, world.multibody_joints) {
        let Some(multibody) = world.multibody_joints.get_multibody(index) else { continue };
        let state = |body| before.of(body).copied();
        copy.add_articulation(multibody, world, |body| link(body, world.bodies, state))?;
    }
    Ok(copy)
}

impl Twin {
    fn add_body(
        &mut self,
        handle: RigidBodyHandle,
        rb: &RigidBody,
        state: &State,
        tracked: &[Option<Tracked>],
        world: &WorldView<'_>,
    ) -> Result<(), Refusal> {
        let n = scalar::wide;
        let com = scalar::vector(rb.local_center_of_mass());
        let origin = Translation3::from(state.position.coords - state.rotation * com);
        let pose = to_pose(&Isometry3::from_parts(origin, state.rotation));
        let builder = match rb.is_dynamic() {
            true => RigidBodyBuilder::dynamic(),
            false => RigidBodyBuilder::kinematic_velocity_based(),
        };
        // A kinematic body goes as it went in the step.
        let (velocity, spin) = match rb.is_dynamic() {
            true => (state.velocity, state.spin),
            false => (scalar::vector(rb.linvel()), scalar::vector(rb.angvel())),
        };
        let locked = LockedAxes::from_bits_truncate(rb.locked_axes().bits());
        let builder = builder
            .pose(pose)
            .linvel(to_vector(&velocity))
            .angvel(to_vector(&spin))
            .gravity_scale(n(rb.gravity_scale()))
            .linear_damping(n(rb.linear_damping()))
            .angular_damping(n(rb.angular_damping()))
            .dominance_group(rb.dominance_group())
            .gyroscopic_forces_enabled(rb.gyroscopic_forces_enabled())
            .locked_axes(locked)
            .additional_mass_properties(mass(rb, &com, Tracked::find(tracked, handle)))
            .allow_fast_rotation(true)
            .can_sleep(false);
        let inner = self.world.insert_body(builder);
        self.bodies.insert(handle.into_raw_parts(), inner);
        for &own in rb.colliders() {
            let Some(collider) = world.colliders.get(own).filter(|c| is_solid(c)) else { continue };
            let place = collider.position_wrt_parent().copied().unwrap_or(Pose::IDENTITY);
            let copied = widen::collider(collider, &place);
            let copied = copied.ok_or(Refusal::Shape { collider: own })?;
            self.world.insert_collider(copied, Some(inner));
        }
        let Some(inner) = self.world.bodies.get_mut(inner) else { return Ok(()) };
        inner.add_force(to_vector(&scalar::vector(rb.user_force())), true);
        inner.add_torque(to_vector(&scalar::vector(rb.user_torque())), true);
        Ok(())
    }

    /// Adds a collider that stands, on its body if it has one: a joint may keep it from touching.
    fn add_standing(
        &mut self,
        handle: ColliderHandle,
        collider: &Collider,
        world: &WorldView<'_>,
    ) -> Result<(), Refusal> {
        let body = collider.parent().zip(collider.position_wrt_parent());
        let place = body.map_or(collider.position(), |(_, place)| place);
        let copied = widen::collider(collider, place);
        let copied = copied.ok_or(Refusal::Shape { collider: handle })?;
        let parent = body.map(|(body, _)| self.find_or_fix(body, world));
        let inner = self.world.insert_collider(copied, parent);
        self.standing.insert(handle.into_raw_parts(), inner);
        Ok(())
    }

    /// Copies the joints of the members, among each other and to what stands.
    fn add_joints(&mut self, world: &WorldView<'_>) {
        for (_, joint) in world.impulse_joints.iter().filter(|(_, j)| j.data.is_enabled()) {
            let ends = [joint.body1(), joint.body2()];
            let is_member =
                |body: &RigidBodyHandle| self.bodies.contains_key(&body.into_raw_parts());
            if !ends.iter().any(is_member) {
                continue;
            }
            let [first, second] = ends.map(|body| self.find_or_fix(body, world));
            self.world.insert_impulse_joint(first, second, widen::joint(&joint.data));
        }
    }

    /// The copy of a body, which stands if it is no member.
    fn find_or_fix(
        &mut self,
        body: RigidBodyHandle,
        world: &WorldView<'_>,
    ) -> fine::dynamics::RigidBodyHandle {
        let key = body.into_raw_parts();
        if let Some(known) = self.bodies.get(&key).or_else(|| self.anchors.get(&key)) {
            return *known;
        }
        let place = world.bodies.get(body).map(|rb| widen::pose(rb.position()));
        let fixed = RigidBodyBuilder::fixed().pose(place.unwrap_or_default());
        let inner = self.world.insert_body(fixed);
        self.anchors.insert(key, inner);
        inner
    }

    /// Copies an articulation, at the states that `link` gives its bodies.
    fn add_articulation(
        &mut self,
        multibody: &Multibody,
        world: &WorldView<'_>,
        link: impl Fn(RigidBodyHandle) -> Option<Link>,
    ) -> Result<(), Refusal> {
        let is_copied = |body: RigidBodyHandle| self.bodies.contains_key(&body.into_raw_parts());
        let mut links = multibody.links().map(|link| link.rigid_body_handle());
        let root = links.next();
        let stands = |body| world.bodies.get(body).is_some_and(RigidBody::is_fixed);
        let moves = |body| world.bodies.get(body).is_some_and(RigidBody::is_dynamic);
        let fits = root.is_some_and(|root| stands(root) || is_copied(root) && moves(root));
        if !fits || !links.all(is_copied) {
            return Err(Refusal::Multibody);
        }
        let motion = motion(multibody, Since::Origin, link).ok_or(Refusal::Multibody)?;
        let inner: Vec<_> = multibody
            .links()
            .map(|link| self.find_or_fix(link.rigid_body_handle(), world))
            .collect();
        let PhysicsWorld { bodies, multibody_joints, .. } = &mut self.world;
        for link in multibody.links() {
            let Some(parent) = link.parent_id() else { continue };
            let (ends, joint) = ([inner[parent], inner[link.link_id()]], link.joint());
            let data = widen::joint(&joint.data);
            match joint.kinematic {
                true => multibody_joints.insert_kinematic(ends[0], ends[1], data, true),
                false => multibody_joints.insert(ends[0], ends[1], data, true),
            };
        }
        let index = multibody_joints.rigid_body_link(inner[0]).map(|link| link.multibody);
        let copied = index.and_then(|index| multibody_joints.get_multibody_mut(index));
        let copied = copied.ok_or(Refusal::Multibody)?;
        // A root that stands has no freedom, once that is known.
        copied.forward_kinematics(bodies, true);
        if copied.ndofs() != multibody.ndofs() || copied.num_links() != multibody.num_links() {
            return Err(Refusal::Multibody);
        }
        dress(multibody, copied);
        motion.apply_within(copied, bodies);
        Ok(())
    }
}

/// Mass properties of a body with the centre of mass `com` in its frame: the embedder's where it
/// registered any, else Rapier's.
fn mass(rb: &RigidBody, com: &Vector3<f64>, tracked: Option<&Tracked>) -> MassProperties {
    let local = &rb.mass_properties().local_mprops;
    let (mass, tensor) = match tracked.filter(|t| t.registered).and_then(Tracked::body) {
        Some(body) => (body.inertia.mass, body.inertia.tensor),
        None => {
            let tensor = scalar::matrix(&local.reconstruct_inertia_matrix());
            (scalar::wide(local.mass()), tensor)
        }
    };
    let mut matrix = Matrix::ZERO;
    for (to, column) in tensor.column_iter().enumerate() {
        *matrix.col_mut(to) = to_vector(&column.into_owned());
    }
    MassProperties::with_inertia_matrix(to_vector(com), mass, matrix)
}
