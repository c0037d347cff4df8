//! What is where over a step, for bodies that Rapier keeps in hand: who could meet whom.
//! Collected only when there is such a body.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{Collider, ColliderHandle};

use crate::extent::Extent;
use crate::lockstep::meeting;
use crate::obstacle::{Sweep, extent, interact};
use crate::query_collider::is_of_queries;
use crate::scalar;
use crate::view::WorldView;

/// A collider, and the box within which it stays over the step.
struct Neighbour {
    collider: ColliderHandle,
    body: Option<RigidBodyHandle>,
    extent: Extent,
    moves: bool,
}

/// The solid colliders of a step, wear surfaces apart, sorted along x.
#[derive(Default)]
pub(crate) struct Neighbours {
    list: Vec<Neighbour>,
    of_body: BTreeMap<(u32, u32), Vec<usize>>,
    /// Largest extent along x [m].
    widest: f64,
    is_full: bool,
}

impl Neighbours {
    /// Forgets the last step's.
    pub fn clear(&mut self) {
        self.list.clear();
        self.of_body.clear();
        self.widest = 0.0;
        self.is_full = false;
    }

    /// Collects the colliders of a step of `dt` [s], once.
    pub fn collect(
        &mut self,
        world: &WorldView<'_>,
        dt: f64,
        is_proxy: impl Fn(ColliderHandle) -> bool,
    ) {
        if std::mem::replace(&mut self.is_full, true) {
            return;
        }
        for (handle, collider) in world.colliders.iter_enabled() {
            if collider.is_sensor() || is_of_queries(collider) || is_proxy(handle) {
                continue;
            }
            let body = collider.parent();
            let standing = extent(&collider.compute_aabb());
            let parent = body.and_then(|body| world.bodies.get(body));
            let sweep = parent.and_then(|rb| Sweep::of(rb, standing, world, dt));
            let moves = sweep.is_some();
            let extent = sweep.map_or(standing, |sweep| sweep.part([0.0, dt]));
            self.list.push(Neighbour { collider: handle, body, extent, moves });
        }
        self.list.sort_by(|a, b| a.extent.low.x.total_cmp(&b.extent.low.x));
        for (place, neighbour) in self.list.iter().enumerate() {
            let width = neighbour.extent.high.x - neighbour.extent.low.x;
            // A half-space is everywhere: it is asked by all.
            self.widest = self.widest.max(width);
            if let Some(body) = neighbour.body {
                self.of_body.entry(body.into_raw_parts()).or_default().push(place);
            }
        }
    }

    /// True when another moving body comes to meet `body` in this step, faster than `limit` [m/s].
    pub fn blow(&self, body: RigidBodyHandle, world: &WorldView<'_>, dt: f64, limit: f64) -> bool {
        self.pairs(body).any(|(own, other)| {
            let [mine, theirs] = [own, other].map(|n| world.colliders.get(n.collider));
            let (Some(mine), Some(theirs)) = (mine, theirs) else { return false };
            other.moves && interact(mine, theirs) && closes([mine, theirs], world, dt, limit)
        })
    }

    /// Shows everything but `body` itself that could meet one of its colliders in this step: the
    /// colliders, and the bodies they are on.
    pub fn show_near(
        &self,
        body: RigidBodyHandle,
        world: &WorldView<'_>,
        mut show: impl FnMut(ColliderHandle, Option<RigidBodyHandle>),
    ) {
        for (own, other) in self.pairs(body) {
            let [mine, theirs] = [own, other].map(|n| world.colliders.get(n.collider));
            if mine.zip(theirs).is_some_and(|(mine, theirs)| interact(mine, theirs)) {
                show(other.collider, other.body);
            }
        }
    }

    /// Every collider of `body` with every other one whose box meets its own.
    fn pairs(&self, body: RigidBodyHandle) -> impl Iterator<Item = (&Neighbour, &Neighbour)> {
        let places = self.of_body.get(&body.into_raw_parts()).map_or(&[][..], Vec::as_slice);
        places.iter().flat_map(move |&place| {
            let own = &self.list[place];
            let from = own.extent.low.x - self.widest;
            let first = self.list.partition_point(|n| n.extent.low.x < from);
            let close = self.list[first..].iter();
            close
                .take_while(|other| other.extent.low.x <= own.extent.high.x)
                .filter(move |other| other.body != Some(body) && other.extent.meets(&own.extent))
                .map(move |other| (own, other))
        })
    }
}

/// Do two colliders that are apart meet within `dt` [s], as their bodies move now, faster than
/// `limit` [m/s]?
fn closes(pair: [&Collider; 2], world: &WorldView<'_>, dt: f64, limit: f64) -> bool {
    let velocity = |collider: &Collider| {
        let body = collider.parent().and_then(|handle| world.bodies.get(handle));
        body.map_or_else(Vector3::zeros, |rb| scalar::vector(rb.linvel()))
    };
    let velocities = pair.map(velocity);
    let relative = velocities[0] - velocities[1];
    relative.norm() > limit
        && meeting(pair, velocities, dt).is_some_and(|normal| relative.dot(&normal) > limit)
}
