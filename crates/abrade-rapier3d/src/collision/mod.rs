//! Collisions in a crowd: bodies on closed or moving surfaces that other bodies are among, which
//! Micro cannot carry on their own, wear by the impulses that Rapier's contacts gave them.
//!
//! A contact that bears more than what lies on it is taken for a collision of two: of a body of
//! the mass that the pair has at the place of the contact, at the speed that makes up for its
//! impulse ([`blow`]). The core runs it until the two part; the nodes keep what it did to them,
//! and the motion stays Rapier's. Rapier brakes a body over more than one step: a blow is what its
//! contact has borne until the two no longer approach.

mod blow;
mod clusters;
mod strike;

use std::collections::BTreeMap;

use rapier::dynamics::RigidBody;
use rapier::geometry::{ColliderHandle, ContactPair};

use crate::collision::blow::Blow;
use crate::collision::clusters::Clusters;
use crate::collision::strike::{Outcome, Striker};
use crate::event::Refusal;
use crate::gate;
use crate::resolver::Resolver;
use crate::surface::SurfaceId;
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::WearWorld;
use crate::{booking::Booking, scalar};

/// Growth of the impulse of a contact from one step to the next that is no blow.
const GROWTH: f64 = 1.5;
/// Speeds that gravity gives in a step below which a blow is none.
const REST: f64 = 2.0;
/// Largest ratio of the speed of a blow that is handed on to that of the one that came: a heavy body
/// makes a light one twice as fast.
const HANDED: f64 = 2.0;
/// Relative difference of an impulse from that of the two on their own that Rapier's push out of an
/// overlap makes, and the rest that a contact leaves to the next step.
const DIRECT: f64 = 0.1;
/// Share of the speed of a blow below which two bodies no longer approach.
const STOPPED: f64 = 0.05;

/// Two colliders, in the order of their handles.
pub(crate) type PairKey = [(u32, u32); 2];

/// What a contact bears.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Bore {
    /// Impulse of what lies on it, per step [N s].
    lying: f64,
    /// Impulse of a blow under way [N s], and the fastest approach that gave rise to it [m/s].
    blow: f64,
    speed: f64,
    /// The fastest approach of the two themselves [m/s].
    approach: f64,
}

/// Contacts between the steps.
pub(crate) type Bores = BTreeMap<PairKey, Bore>;

#[cfg(feature = "serde-serialize")]
impl Bore {
    /// True for impulses that a contact can have.
    pub fn is_sound(&self) -> bool {
        [self.lying, self.blow, self.speed, self.approach]
            .iter()
            .all(|x| x.is_finite() && *x >= 0.0)
    }
}

impl WearWorld {
    /// Leaves the contacts of the surfaces `near` to Rapier through the step, to wear by their
    /// impulses after it.
    pub(crate) fn crowd(&mut self, near: impl IntoIterator<Item = SurfaceId>, reason: Refusal) {
        self.current.crowded.extend(near.into_iter().map(|surface| (surface, reason)));
    }

    /// Lets the crowded surfaces wear by what their contacts bore.
    pub(crate) fn collide(&mut self, world: &WorldView<'_>) {
        let mut crowded = std::mem::take(&mut self.current.crowded);
        crowded.sort_by_key(|(surface, _)| *surface);
        crowded.dedup_by_key(|(surface, _)| *surface);
        let mut met = BTreeMap::new();
        for &(surface, reason) in &crowded {
            let proxy = self.surfaces[surface.0].proxy;
            let pairs = world.narrow_phase.contact_pairs_with(proxy);
            for pair in pairs.filter(|pair| moving(pair, world).is_some()) {
                // One of two crowded surfaces is enough.
                if let Some(blow) = Blow::of(pair, world, &self.before) {
                    met.entry(key(pair)).or_insert((pair, blow, reason));
                }
            }
        }
        let clusters = Clusters::of(met.values().map(|(_, blow, _)| blow));
        let mut bores = Bores::new();
        for (key, (pair, blow, reason)) in met {
            let speed = clusters.speed(&blow);
            let mut bore = self.bores.get(&key).copied().unwrap_or_default();
            if let Some(blow) = self.bear(&mut bore, blow, speed, world) {
                self.strike(pair, &blow, reason, world);
            }
            bores.insert(key, bore);
        }
        self.bores = bores;
    }

    /// Books what a contact bore in the step, among bodies of which the fastest came together at
    /// `speed` [m/s]; returns a blow that is over.
    fn bear(
        &self,
        bore: &mut Bore,
        mut blow: Blow,
        speed: f64,
        world: &WorldView<'_>,
    ) -> Option<Blow> {
        let gravity = scalar::vector(world.gravity).norm();
        let rest = REST * gravity * self.current.dt;
        let strikes = speed > rest && blow.impulse > GROWTH * bore.lying + blow.mass * rest;
        if strikes {
            bore.blow += blow.impulse - bore.lying;
            bore.speed = bore.speed.max(speed);
            bore.approach = bore.approach.max(blow.approach);
        } else {
            bore.lying = blow.impulse;
        }
        // A direct blow has the speed of its approach; what is handed on is no faster than twice what
        // came.
        let own = blow.impulse_of(bore.approach);
        let is_direct = (bore.blow - own).abs() < DIRECT * own;
        blow.impulse = match is_direct {
            true => own,
            false => bore.blow.min(blow.impulse_of(HANDED * bore.speed)),
        };
        let is_over = !strikes || blow.closing <= STOPPED * blow.speed();
        if bore.blow == 0.0 || !is_over {
            return None;
        }
        *bore = Bore { lying: bore.lying, ..Bore::default() };
        Some(blow)
    }

    /// Runs the collision and books it.
    fn strike(&mut self, pair: &ContactPair, blow: &Blow, reason: Refusal, world: &WorldView<'_>) {
        let own = [pair.collider1, pair.collider2]
            .map(|own| self.surfaces.iter().position(|worn| worn.proxy == own));
        let is_plate = |at: &Option<usize>| {
            at.is_some_and(|at| gate::can_hold(&self.lies, &self.surfaces, SurfaceId(at)))
        };
        // A plate at rest is worn by what lies on it and strikes it, in the other resolvers.
        if own.iter().any(is_plate) {
            return;
        }
        let Some(striker) = Striker::of(pair, own, blow, &self.surfaces, world) else {
            let other = if own[0].is_some() { pair.collider2 } else { pair.collider1 };
            self.say_unresolved(pair, own, Refusal::Shape { collider: other }, world);
            return;
        };
        let settings = self.settings.encounter();
        let outcome = striker.run(&mut self.surfaces, blow, settings);
        let Outcome { ledger, steps, node_evaluations, contact_time, worn } = match outcome {
            Ok(outcome) => outcome,
            Err(error) => {
                let body = moving(pair, world).map(|(body, _)| body);
                if let (Some(body), Some(at)) = (body, own.into_iter().flatten().next()) {
                    self.fail(body, SurfaceId(at), error);
                }
                return;
            }
        };
        self.closed += ledger;
        self.counters.collision += 1;
        self.counters.steps += steps;
        self.counters.node_evaluations += node_evaluations;
        *self.reasons.entry((Resolver::Collision, reason.name().into())).or_default() += 1;
        let Some((body, is_first)) = moving(pair, world) else { return };
        let impulse = blow.normal * if is_first { -blow.impulse } else { blow.impulse };
        let tracked = Tracked::slot(&mut self.bodies, body);
        tracked.hand_to(Resolver::Collision, Some(reason), &mut self.events);
        let booking = Booking { impulse, contact_time, touches: false };
        tracked.book(&booking, &worn, &mut self.events);
    }

    fn say_unresolved(
        &mut self,
        pair: &ContactPair,
        own: [Option<usize>; 2],
        reason: Refusal,
        world: &WorldView<'_>,
    ) {
        let body = moving(pair, world).map(|(body, _)| body);
        if let (Some(body), Some(at)) = (body, own.into_iter().flatten().next()) {
            self.refuse(body, SurfaceId(at), reason);
        }
    }
}

fn key(pair: &ContactPair) -> PairKey {
    let mut key = [pair.collider1, pair.collider2].map(ColliderHandle::into_raw_parts);
    key.sort_unstable();
    key
}

/// The dynamic body of a pair that is awake, the second if both are, and whether it is the first:
/// sleeping pairs keep the impulses of their last step.
fn moving(
    pair: &ContactPair,
    world: &WorldView<'_>,
) -> Option<(rapier::dynamics::RigidBodyHandle, bool)> {
    let body = |collider: ColliderHandle| {
        let parent = world.colliders.get(collider)?.parent()?;
        let awake = |rb: &&RigidBody| rb.is_dynamic() && !rb.is_sleeping();
        world.bodies.get(parent).filter(awake).map(|_| parent)
    };
    let second = body(pair.collider2).map(|body| (body, false));
    second.or_else(|| body(pair.collider1).map(|body| (body, true)))
}
