//! Who belongs to an island: everything that is jointed to a member, or could meet
//! one in the step.

use rapier::dynamics::{Multibody, RigidBody, RigidBodyHandle};
use rapier::geometry::ColliderHandle;

use crate::event::Refusal;
use crate::neighbours::Neighbours;
use crate::view::WorldView;

/// Most bodies of an island: a step of it costs about 2 us and 1 us a body, and a pile that falls
/// together would be stepped finely all the time.
const LIMIT: usize = 12;

/// The bodies and the standing colliders of an island.
pub(crate) struct Members {
    pub bodies: Vec<RigidBodyHandle>,
    /// Colliders of members do not count.
    pub standing: Vec<ColliderHandle>,
}

/// The island around `start`, of bodies that are `is_free` for it. Kinematic bodies belong to it
/// and pass nothing on.
pub(crate) fn gather(
    start: RigidBodyHandle,
    world: &WorldView<'_>,
    near: &Neighbours,
    is_free: impl Fn(RigidBodyHandle) -> bool,
) -> Result<Members, Refusal> {
    let mut members = Members { bodies: vec![start], standing: Vec::new() };
    let mut at = 0;
    while at < members.bodies.len() {
        let body = members.bodies[at];
        at += 1;
        if !world.bodies.get(body).is_some_and(RigidBody::is_dynamic) {
            continue;
        }
        if let Some(link) = world.multibody_joints.rigid_body_link(body) {
            let multibody = world.multibody_joints.get_multibody(link.multibody);
            for link in multibody.into_iter().flat_map(Multibody::links) {
                members.add_body(link.rigid_body_handle(), world, &is_free);
            }
        }
        for (first, second, _, _) in world.impulse_joints.attached_enabled_joints(body) {
            members.add_body(if first == body { second } else { first }, world, &is_free);
        }
        near.show_near(body, world, |collider, other| {
            members.add_met(collider, other, world, &is_free);
        });
        if members.bodies.len() > LIMIT {
            return Err(Refusal::Crowd { limit: LIMIT });
        }
    }
    members.bodies.sort_unstable_by_key(|body| body.into_raw_parts());
    members.standing.sort_unstable_by_key(|collider| collider.into_raw_parts());
    Ok(members)
}

impl Members {
    pub fn holds(&self, body: RigidBodyHandle) -> bool {
        let key = body.into_raw_parts();
        self.bodies.binary_search_by_key(&key, |member| member.into_raw_parts()).is_ok()
    }

    /// Adds a collider that stands.
    pub fn add_standing(&mut self, collider: ColliderHandle) {
        let key = collider.into_raw_parts();
        if let Err(at) = self.standing.binary_search_by_key(&key, |c| c.into_raw_parts()) {
            self.standing.insert(at, collider);
        }
    }

    fn add_body(
        &mut self,
        body: RigidBodyHandle,
        world: &WorldView<'_>,
        is_free: &impl Fn(RigidBodyHandle) -> bool,
    ) {
        let moves = world.bodies.get(body).is_some_and(|rb| rb.is_enabled() && !rb.is_fixed());
        if moves && is_free(body) && !self.bodies.contains(&body) {
            self.bodies.push(body);
        }
    }

    /// Adds what a collider belongs to.
    fn add_met(
        &mut self,
        collider: ColliderHandle,
        body: Option<RigidBodyHandle>,
        world: &WorldView<'_>,
        is_free: &impl Fn(RigidBodyHandle) -> bool,
    ) {
        let fixed = |body: &RigidBodyHandle| {
            world.bodies.get(*body).is_none_or(|rb| rb.is_fixed() || !rb.is_enabled())
        };
        match body.filter(|body| !fixed(body)) {
            Some(body) => self.add_body(body, world, is_free),
            None if !self.standing.contains(&collider) => self.standing.push(collider),
            None => {}
        }
    }
}
