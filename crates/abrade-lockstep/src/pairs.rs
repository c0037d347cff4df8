//! Colliders of the island that may meet, wear contacts apart: no step may carry one past the
//! other, or so close that Rapier's contacts do not see it coming.

use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Aabb, Collider, ColliderHandle};
use rapier::math::Real;
use rapier::parry::query::{ClosestPoints, closest_points};
use rapier::pipeline::PhysicsWorld;

use crate::filter::Proxy;
use crate::round::is_round;

/// Share of the top speed at which bodies that touch may close without a blow.
const STRIKES: f64 = 1e-3;

/// The pairs of an island, found once.
pub(crate) struct Pairs {
    list: Vec<[ColliderHandle; 2]>,
    /// Distance from its centre of mass within which the spin of a body moves anything [m].
    radii: Vec<(RigidBodyHandle, f64)>,
    /// Those that could meet in the step under way.
    near: Vec<Near>,
    /// Some come together in it.
    pub strikes: bool,
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
        Self { list, radii: radii(world), near: Vec::new(), strikes: false }
    }

    /// The longest step of at most `h` [s] in which Rapier sees every contact coming.
    pub fn limit(&mut self, h: f64, world: &PhysicsWorld) -> f64 {
        self.strikes = false;
        let prediction = world.integration_parameters.prediction_distance();
        let sight = 0.5 * prediction;
        let speed = |(handle, radius): &(RigidBodyHandle, f64)| {
            world.bodies.get(*handle).map_or(0.0, |rb| rb.linvel().length() + turning(rb, *radius))
        };
        let top = 2.0 * self.radii.iter().map(speed).fold(0.0, f64::max);
        if self.list.is_empty() || top * h < sight {
            return h;
        }
        self.near.clear();
        for pair in &self.list {
            if let [Some(a), Some(b)] = pair.map(|handle| world.colliders.get(handle)) {
                self.near.extend(near(world, [a, b], &self.radii, sight, h));
            }
        }
        // A blow makes others faster than they are: no pair is taken for slow in its step.
        self.strikes =
            self.near.iter().any(|n| n.distance <= prediction && n.closing > STRIKES * top);
        let limit = |n: &Near| {
            let closing = if self.strikes { n.closing.max(top) } else { n.closing };
            if closing > 0.0 { n.distance.max(sight) / closing } else { h }
        };
        self.near.iter().map(limit).fold(h, f64::min)
    }
}

/// How far from its centre of mass the spin of each moving body moves anything [m].
fn radii(world: &PhysicsWorld) -> Vec<(RigidBodyHandle, f64)> {
    let moving: Vec<_> = world.bodies.iter().filter(|(_, rb)| !rb.is_fixed()).collect();
    let reach = |rb: &RigidBody| {
        let boxes = rb.colliders().iter().filter_map(|own| world.colliders.get(*own));
        boxes.map(|c| farthest(rb, c)).fold(0.0, f64::max)
    };
    // A half-space reaches as far as there is anything.
    let all = moving.iter().map(|(_, rb)| rb.center_of_mass().length() + reach(rb));
    let all: f64 = all.filter(|reach| *reach < Real::MAX.sqrt()).fold(0.0, f64::max);
    let radius = |rb: &RigidBody| match is_round(rb, &world.colliders) {
        true => 0.0,
        false => reach(rb).min(all + rb.center_of_mass().length()),
    };
    moving.into_iter().map(|(handle, rb)| (handle, radius(rb))).collect()
}

/// Speed at which spin moves the points of a body, at most [m/s].
fn turning(rb: &RigidBody, radius: f64) -> f64 {
    rb.angvel().length() * radius
}

fn body(world: &PhysicsWorld, handle: Option<RigidBodyHandle>) -> Option<&RigidBody> {
    handle.and_then(|handle| world.bodies.get(handle))
}

/// True for bodies that a joint or an articulation keeps from touching each other.
fn linked(
    world: &PhysicsWorld,
    first: Option<RigidBodyHandle>,
    second: Option<RigidBodyHandle>,
) -> bool {
    let (Some(first), Some(second)) = (first, second) else { return false };
    let joints = &world.multibody_joints;
    let [one, other] = [first, second].map(|body| joints.rigid_body_link(body));
    let chain = one.zip(other).filter(|(a, b)| a.multibody == b.multibody);
    let chain = chain.and_then(|(link, _)| joints.get_multibody(link.multibody));
    let mut between = world.impulse_joints.joints_between(first, second);
    between.any(|(_, joint)| !joint.data.contacts_enabled)
        || chain.is_some_and(|chain| !chain.self_contacts_enabled())
        || joints
            .joint_between(first, second)
            .is_some_and(|(_, _, link)| !link.joint().data.contacts_enabled)
}

/// What two colliders are to each other, unless they stay more than `sight` [m] apart for `h` [s].
fn near(
    world: &PhysicsWorld,
    pair: [&Collider; 2],
    radii: &[(RigidBodyHandle, f64)],
    sight: f64,
    h: f64,
) -> Option<Near> {
    let [a, b] = pair.map(|c| body(world, c.parent()));
    let velocity = |rb: Option<&RigidBody>| rb.map(RigidBody::linvel).unwrap_or_default();
    let relative = velocity(b) - velocity(a);
    let spun = pair.map(|c| {
        let known = radii.iter().find(|(handle, _)| Some(*handle) == c.parent());
        known.zip(body(world, c.parent())).map_or(0.0, |((_, radius), rb)| turning(rb, *radius))
    });
    let turning = spun[0] + spun[1];
    let top = relative.length() + turning;
    let skins = pair[0].contact_skin() + pair[1].contact_skin();
    let reach = skins + sight + top * h;
    let boxes = pair.map(Collider::compute_aabb);
    let apart = gap(&boxes[0], &boxes[1]);
    if apart > reach {
        return None;
    }
    let by_boxes = Some(Near { distance: (apart - skins).max(0.0), closing: top });
    let [p, q] = pair.map(|c| (c.position(), c.shape()));
    if p.1.as_composite_shape().is_some() || q.1.as_composite_shape().is_some() {
        return by_boxes;
    }
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
            Some(Near { distance: (distance - skins).max(0.0), closing })
        }
        Ok(ClosestPoints::Intersecting) => Some(Near { distance: 0.0, closing: top }),
        Err(_) => by_boxes,
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
