//! Colliders of the island that may meet, wear contacts apart: no step may carry one past the
//! other, or so close that Rapier's contacts do not see it coming.

use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Aabb, Collider, ColliderHandle};
use rapier::parry::query::{ClosestPoints, closest_points};
use rapier::pipeline::PhysicsWorld;

use crate::filter::Proxy;

/// The pairs of an island, found once.
pub(crate) struct Pairs {
    list: Vec<[ColliderHandle; 2]>,
}

impl Pairs {
    /// Pairs of colliders of different bodies, of which one moves.
    pub fn of(world: &PhysicsWorld, proxies: &[Proxy]) -> Self {
        let colliders: Vec<(ColliderHandle, &Collider)> = world
            .colliders
            .iter()
            .filter(|(handle, _)| proxies.iter().all(|p| p.collider != *handle))
            .collect();
        let mut list = Vec::new();
        for (at, (first, a)) in colliders.iter().enumerate() {
            for (second, b) in &colliders[at + 1..] {
                let moves = |c: &Collider| body(world, c.parent()).is_some_and(|b| !b.is_fixed());
                let meet = a.collision_groups().test(b.collision_groups())
                    && a.solver_groups().test(b.solver_groups())
                    && a.parent() != b.parent()
                    && (moves(a) || moves(b))
                    && !linked(world, a.parent(), b.parent());
                if meet {
                    list.push([*first, *second]);
                }
            }
        }
        Self { list }
    }

    /// The longest step of at most `h` [s] in which Rapier sees every contact coming.
    pub fn limit(&self, h: f64, world: &PhysicsWorld) -> f64 {
        let sight = 0.5 * world.integration_parameters.prediction_distance();
        let speeds = world.bodies.iter().map(|(_, rb)| rb.linvel().length());
        if self.list.is_empty() || 2.0 * h * speeds.fold(0.0, f64::max) < sight {
            return h;
        }
        let limit = |[first, second]: &[ColliderHandle; 2]| {
            let [a, b] = [first, second].map(|handle| world.colliders.get(*handle));
            let (Some(a), Some(b)) = (a, b) else { return h };
            free_time(world, [a, b], sight, h)
        };
        self.list.iter().map(limit).fold(h, f64::min)
    }
}

fn body(world: &PhysicsWorld, handle: Option<RigidBodyHandle>) -> Option<&RigidBody> {
    handle.and_then(|handle| world.bodies.get(handle))
}

/// True for bodies that a joint keeps from touching each other.
fn linked(
    world: &PhysicsWorld,
    first: Option<RigidBodyHandle>,
    second: Option<RigidBodyHandle>,
) -> bool {
    let (Some(first), Some(second)) = (first, second) else { return false };
    let mut between = world.impulse_joints.joints_between(first, second);
    let link = world.multibody_joints.joint_between(first, second);
    between.any(|(_, joint)| !joint.data.contacts_enabled)
        || link.is_some_and(|(_, _, link)| !link.joint().data.contacts_enabled)
}

/// Time, of at most `h` [s], in which two colliders do not meet, or come no closer than `sight` [m].
fn free_time(world: &PhysicsWorld, pair: [&Collider; 2], sight: f64, h: f64) -> f64 {
    let [a, b] = pair.map(|c| body(world, c.parent()));
    let velocity = |rb: Option<&RigidBody>| rb.map(RigidBody::linvel).unwrap_or_default();
    let relative = velocity(b) - velocity(a);
    let turning = |(rb, c): (Option<&RigidBody>, &Collider)| {
        rb.map_or(0.0, |rb| rb.angvel().length() * farthest(rb, c))
    };
    let turning = turning((a, pair[0])) + turning((b, pair[1]));
    let boxes = pair.map(Collider::compute_aabb);
    let any = relative.length() + turning;
    let far = gap(&boxes[0], &boxes[1]) / any;
    if far >= h {
        return h;
    }
    let [p, q] = pair.map(|c| (c.position(), c.shape()));
    let reach = sight + any * h;
    match closest_points(p.0, p.1, q.0, q.1, reach) {
        Ok(ClosestPoints::Disjoint) => h,
        Ok(ClosestPoints::WithinMargin(on_a, on_b)) => {
            let way = on_a - on_b;
            let distance = way.length();
            // The distance of convex shapes on straight ways stays above its tangent.
            let closing = match p.1.is_convex() && q.1.is_convex() && distance > 0.0 {
                true => relative.dot(way) / distance + turning,
                false => any,
            };
            if closing > 0.0 { (distance.max(sight) / closing).min(h) } else { h }
        }
        Ok(ClosestPoints::Intersecting) => sight / any,
        Err(_) => far.max(sight / any),
    }
}

/// Distance of two boxes [m]; zero if they meet.
fn gap(a: &Aabb, b: &Aabb) -> f64 {
    let apart = (b.mins - a.maxs).max(a.mins - b.maxs);
    apart.max(rapier::math::Vector::ZERO).length()
}

/// Distance within which a collider lies about the centre of mass of its body [m].
fn farthest(rb: &RigidBody, collider: &Collider) -> f64 {
    let own = collider.compute_aabb();
    let (low, high) = (own.mins - rb.center_of_mass(), own.maxs - rb.center_of_mass());
    low.abs().max(high.abs()).length()
}
