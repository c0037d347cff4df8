//! Collisions in a crowd: bodies on closed or moving surfaces that other bodies are among, which
//! Micro cannot carry on their own, wear by the impulses that Rapier's contacts gave them.
//!
//! A contact that bears more than what lies on it has a blow. It is run by the core as a collision of
//! two: of a body of the mass that the pair has at the place of the contact, and of the energy that
//! its impulse stands for, but no more than what the contacts of the step took from the bodies that
//! hang together there. The nodes keep what it did to them, and the motion stays Rapier's. Rapier
//! brakes a body over more than one step: a blow is what its contact has borne until the two no longer
//! approach.

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
/// Steps in which Rapier has braked whatever came.
const SPAN: u32 = 4;
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
    /// Impulse of a blow under way [N s], and its share of the energy that contacts took [J].
    blow: f64,
    energy: f64,
    /// Steps that it has taken.
    steps: u32,
}

/// Contacts between the steps.
pub(crate) type Bores = BTreeMap<PairKey, Bore>;

#[cfg(feature = "serde-serialize")]
impl Bore {
    /// True for impulses that a contact can have.
    pub fn is_sound(&self) -> bool {
        [self.lying, self.blow, self.energy].iter().all(|x| x.is_finite() && *x >= 0.0)
    }
}

impl Bore {
    /// The part of a contact's impulse that is a blow; zero for one that lies, among things that
    /// gravity makes no faster than `rest` [m/s] in a step.
    fn part(&self, blow: &Blow, rest: f64) -> f64 {
        let strikes = blow.impulse > GROWTH * self.lying + blow.mass * rest;
        if strikes { blow.impulse - self.lying } else { 0.0 }
    }

    /// Bears a contact through a step. True for a blow that is over, and faster than `rest` [m/s];
    /// `blow` is then all of it.
    fn bear(&mut self, blow: &mut Blow, clusters: &Clusters, rest: f64) -> bool {
        let part = self.part(blow, rest);
        let borne = blow.impulse;
        self.steps += 1;
        self.blow += part;
        self.energy += clusters.share(blow, part);
        (blow.impulse, blow.energy) = (self.blow, blow.energy_of(self.blow).min(self.energy));
        if part > 0.0 && self.steps < SPAN && blow.closing > STOPPED * blow.speed() {
            return false;
        }
        // What bears as much for so long lies there.
        let lies = part == 0.0 || self.steps >= SPAN;
        self.lying = if lies { borne } else { self.lying };
        *self = Self { lying: self.lying, ..Self::default() };
        blow.speed() > rest
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
        let old = std::mem::take(&mut self.bores);
        let bore = |key: &PairKey| old.get(key).copied().unwrap_or_default();
        let rest = REST * scalar::vector(world.gravity).norm() * self.current.dt;
        let part = |key: &PairKey, blow: &Blow| bore(key).part(blow, rest);
        let contacts = met.iter().map(|(key, (_, blow, _))| (blow, part(key, blow)));
        let clusters = Clusters::of(contacts, rest);
        for (key, (pair, mut blow, reason)) in met {
            let mut bore = bore(&key);
            if bore.bear(&mut blow, &clusters, rest) {
                self.strike(pair, &blow, reason, world);
            }
            self.bores.insert(key, bore);
        }
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
