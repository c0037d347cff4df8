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
    /// Those that could meet in the step under way.
    near: Vec<Near>,
}

/// Two colliders that are close.
struct Near {
    /// What is between them [m].
    distance: f64,
    /// Speed at which that becomes less, at most [m/s].
    closing: f64,
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
        Self { list, near: Vec::new() }
    }

    /// The longest step of at most `h` [s] in which Rapier sees every contact coming.
    pub fn limit(&mut self, h: f64, world: &PhysicsWorld) -> f64 {
        let prediction = world.integration_parameters.prediction_distance();
        let sight = 0.5 * prediction;
        let speeds = world.bodies.iter().map(|(_, rb)| rb.linvel().length());
        let top = 2.0 * speeds.fold(0.0, f64::max);
        if self.list.is_empty() || top * h < sight {
            return h;
        }
        self.near.clear();
        for pair in &self.list {
            if let [Some(a), Some(b)] = pair.map(|handle| world.colliders.get(handle)) {
                self.near.extend(near(world, [a, b], sight, h));
            }
        }
        // A blow makes others faster than they are: no pair is taken for slow in its step.
        let strikes = self.near.iter().any(|n| n.distance <= prediction && n.closing > 0.0);
        let limit = |n: &Near| {
            let closing = if strikes { n.closing.max(top) } else { n.closing };
            if closing > 0.0 { n.distance.max(sight) / closing } else { h }
        };
        self.near.iter().map(limit).fold(h, f64::min)
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

/// What two colliders are to each other, unless they stay more than `sight` [m] apart for `h` [s].
fn near(world: &PhysicsWorld, pair: [&Collider; 2], sight: f64, h: f64) -> Option<Near> {
    let [a, b] = pair.map(|c| body(world, c.parent()));
    let velocity = |rb: Option<&RigidBody>| rb.map(RigidBody::linvel).unwrap_or_default();
    let relative = velocity(b) - velocity(a);
    let turning = |(rb, c): (Option<&RigidBody>, &Collider)| {
        rb.map_or(0.0, |rb| rb.angvel().length() * farthest(rb, c))
    };
    let turning = turning((a, pair[0])) + turning((b, pair[1]));
    let top = relative.length() + turning;
    let reach = sight + top * h;
    let boxes = pair.map(Collider::compute_aabb);
    let apart = gap(&boxes[0], &boxes[1]);
    if apart > reach {
        return None;
    }
    let [p, q] = pair.map(|c| (c.position(), c.shape()));
    match closest_points(p.0, p.1, q.0, q.1, reach) {
        Ok(ClosestPoints::Disjoint) => None,
        Ok(ClosestPoints::WithinMargin(on_a, on_b)) => {
            let way = on_a - on_b;
            let distance = way.length();
            // The distance of convex shapes on straight ways stays above its tangent.
            let closing = match p.1.is_convex() && q.1.is_convex() && distance > 0.0 {
                true => relative.dot(way) / distance + turning,
                false => top,
            };
            Some(Near { distance, closing })
        }
        Ok(ClosestPoints::Intersecting) => Some(Near { distance: 0.0, closing: top }),
        Err(_) => Some(Near { distance: apart, closing: top }),
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
