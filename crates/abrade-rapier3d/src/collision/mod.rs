//! Collisions in a crowd: bodies on closed or moving surfaces that other bodies are among, which
//! Micro cannot carry on their own, wear by the impulses that Rapier's contacts gave them.
//!
//! A contact that bears more than what lies on it has a blow. It is run by the core as a collision of
//! two: of a body of the mass that the pair has at the place of the contact, and of the energy that
//! its impulse stands for, but no more than what the contacts of the step took from the bodies that
//! hang together there. The nodes keep what it did to them, and the motion stays Rapier's. Rapier
//! brakes a body over more than one step: a blow is what its contact has borne until the two no longer
//! approach.
//!
//! What bears no blow lies there: its load presses the nodes ([`lying`]).

mod blow;
mod clusters;
mod lying;
mod passage;
mod rub;
mod strike;
mod two;

use std::collections::BTreeMap;

use abrade::{Ledger, PhysicsError};
use rapier::dynamics::{RigidBody, RigidBodyHandle};
use rapier::geometry::{Collider, ColliderHandle, ContactPair};

use crate::booking::Contact;
use crate::collision::blow::Blow;
use crate::collision::clusters::Clusters;
use crate::collision::lying::{Bearing, Lying};
use crate::collision::strike::{Outcome, Striker};
use crate::collision::two::Two;
use crate::event::{Refusal, WearEvent};
use crate::gate;
use crate::resolver::Resolver;
use crate::scalar;
use crate::settle::GROWTH;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::WearWorld;

/// Speeds that gravity gives in a step below which a blow is none.
const REST: f64 = 2.0;
/// Part of a pitch by which a body that moves no further in a step stands still.
const STILL: f64 = 1e-4;
/// Steps in which Rapier has braked whatever came.
const SPAN: u32 = 4;
/// Share of the speed of a blow below which two bodies no longer approach.
const STOPPED: f64 = 0.05;

/// Two colliders, in the order of their handles.
pub(crate) type PairKey = [(u32, u32); 2];

/// What a contact bears.
#[derive(Default)]
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Bore {
    /// Impulse of what lies on it, per step [N s].
    lying: f64,
    /// Impulse of a blow under way [N s], and its share of the energy that contacts took [J].
    blow: f64,
    energy: f64,
    /// Steps that it has taken.
    steps: u32,
    /// What has worn by lying there.
    kept: Option<Lying>,
}

/// What a contact did in a step.
enum Bears {
    /// A blow that is under way.
    Blow,
    /// A blow that is over.
    Strikes,
    /// It lies there, and has borne this impulse for two steps [N s].
    Lies(f64),
}

/// Contacts between the steps.
pub(crate) type Bores = BTreeMap<PairKey, Bore>;

#[cfg(feature = "serde-serialize")]
impl Bore {
    /// True for impulses that a contact can have.
    pub fn is_sound(&self, surfaces: &[WornCollider]) -> bool {
        let sizes = [self.lying, self.blow, self.energy];
        let kept = self.kept.as_ref().is_none_or(|kept| kept.is_sound(surfaces));
        kept && sizes.iter().all(|x| x.is_finite() && *x >= 0.0) && self.steps < SPAN
    }
}

impl Bore {
    /// The part of a contact's impulse that is a blow; zero for one that lies, among things that
    /// gravity makes no faster than `rest` [m/s] in a step.
    fn part(&self, blow: &Blow, rest: f64) -> f64 {
        let strikes = blow.impulse > GROWTH * self.lying + blow.mass * rest;
        if strikes { blow.impulse - self.lying } else { 0.0 }
    }

    /// Bears a contact through a step. Where a blow strikes, faster than `rest` [m/s], `blow` is then
    /// all of it.
    fn bear(&mut self, blow: &mut Blow, clusters: &Clusters, rest: f64) -> Bears {
        let (borne, before) = (blow.impulse, self.lying);
        let mut part = self.part(blow, rest);
        let energy = self.energy + clusters.share(blow, part);
        // What grows, and nothing has come, is a load.
        if energy == 0.0 {
            (part, self.blow) = (0.0, 0.0);
        }
        self.steps += 1;
        self.blow += part;
        self.energy = energy;
        (blow.impulse, blow.energy) = (self.blow, blow.energy_of(self.blow).min(self.energy));
        if part > 0.0 && self.steps < SPAN && blow.closing > STOPPED * blow.speed() {
            return Bears::Blow;
        }
        let strikes = self.blow > 0.0 && blow.speed() > rest;
        // What bears as much for so long lies there, and what came no faster than rest.
        let lies = self.steps >= SPAN || !strikes;
        self.lying = if lies { borne } else { before };
        (self.blow, self.energy, self.steps) = (0.0, 0.0, 0);
        if strikes { Bears::Strikes } else { Bears::Lies(borne.min(before)) }
    }
}

/// The contacts that are open in which the body lies.
pub(crate) fn open_contacts(
    bores: &Bores,
    body: RigidBodyHandle,
) -> impl Iterator<Item = &Contact> {
    let lying = bores.values().filter_map(|bore| bore.kept.as_ref());
    lying.filter(move |lying| lying.body() == body).filter_map(Lying::contact)
}

impl WearWorld {
    /// Leaves the contacts of a body with the surfaces `near` it to Rapier through the step, to wear by
    /// their impulses after it, be it by blows or by lying there.
    pub(crate) fn crowd(
        &mut self,
        body: RigidBodyHandle,
        near: impl IntoIterator<Item = SurfaceId>,
        reason: Refusal,
    ) {
        // Several tools may be at the same workpiece.
        let (among, key) = (&mut self.current.among, body.into_raw_parts());
        if let Err(at) = among.binary_search(&key) {
            among.insert(at, key);
            *self.reasons.entry((Resolver::Collision, reason.name().into())).or_default() += 1;
        }
        let tracked = Tracked::slot(&mut self.bodies, body);
        tracked.taken_by_collision(reason, &mut self.surfaces, &mut self.closed, &mut self.events);
        self.current.crowded.extend(near.into_iter().map(|surface| (surface, reason)));
    }

    /// Lets the crowded surfaces wear by what their contacts bore.
    pub(crate) fn collide(&mut self, world: &WorldView<'_>) {
        if self.current.dt == 0.0 {
            return;
        }
        let crowded = std::mem::take(&mut self.current.crowded);
        let mut old = std::mem::take(&mut self.bores);
        if crowded.is_empty() && old.is_empty() {
            return;
        }
        let met = self.met(crowded, world);
        let gravity = scalar::vector(world.gravity).norm();
        let rest = (REST * gravity * self.current.dt).max(self.still());
        let fresh = Bore::default();
        let part = |key: &PairKey, blow: &Blow| old.get(key).unwrap_or(&fresh).part(blow, rest);
        let contacts = met.iter().map(|(key, (_, blow, _))| (blow, part(key, blow)));
        let clusters = Clusters::of(contacts, rest);
        for (key, (pair, mut blow, reason)) in met {
            let mut bore = old.remove(&key).unwrap_or_default();
            if let Some(kept) = &mut bore.kept {
                kept.is_met();
            }
            match bore.bear(&mut blow, &clusters, rest) {
                Bears::Blow => {}
                Bears::Strikes => {
                    // What lies there would not know the nodes that the blow moves.
                    if let Some(kept) = &mut bore.kept {
                        kept.let_go(&mut self.surfaces, &mut self.closed);
                    }
                    self.strike(pair, &blow, reason, world);
                }
                Bears::Lies(impulse) => {
                    self.lie(pair, &blow, impulse, &mut bore.kept, reason, world);
                }
            }
            self.bores.insert(key, bore);
        }
        self.wait(old);
    }

    /// The contacts of `crowded` surfaces with what moves over them, and why they wear by impulses.
    fn met<'w>(
        &self,
        mut crowded: Vec<(SurfaceId, Refusal)>,
        world: &WorldView<'w>,
    ) -> BTreeMap<PairKey, (&'w ContactPair, Blow, Refusal)> {
        crowded.sort_by_key(|(surface, _)| *surface);
        crowded.dedup_by_key(|(surface, _)| *surface);
        let mut met = BTreeMap::new();
        for (surface, reason) in crowded {
            let proxy = self.surfaces[surface.0].proxy;
            let pairs = world.narrow_phase.contact_pairs_with(proxy);
            for pair in pairs.filter(|pair| moving(pair, world).is_some()) {
                // One of two crowded surfaces is enough.
                if let Some(blow) = Blow::of(pair, world, &self.before) {
                    met.entry(key(pair)).or_insert((pair, blow, reason));
                }
            }
        }
        met
    }

    /// Keeps for a while what lies where no contact bore it in the step; ends the others.
    fn wait(&mut self, bores: Bores) {
        for (key, mut bore) in bores {
            let Some(mut kept) = bore.kept.take() else { continue };
            // Somebody else has the body, and wears what it lies on.
            let is_taken = self.taken.has_body(Some(kept.body()));
            match !is_taken && kept.waits(self.current.dt) {
                true => drop(self.bores.insert(key, Bore { kept: Some(kept), ..bore })),
                false => self.leave_lying(kept),
            }
        }
    }

    /// True while a contact that is pressed should go on with the surface as it is.
    pub(crate) fn is_rubbed(&self, surface: SurfaceId) -> bool {
        let rubs = self.bores.values().filter_map(|bore| bore.kept.as_ref()?.rub());
        let mut young = rubs.filter(|rub| rub.is_on(surface) && rub.is_young(&self.surfaces));
        young.next().is_some()
    }

    /// Breaks the contacts that are pressed against a surface; they begin anew where they are.
    pub(crate) fn break_rubs(&mut self, surface: SurfaceId) {
        let kept = self.bores.values_mut().filter_map(|bore| bore.kept.as_mut());
        for kept in kept.filter(|kept| kept.rub().is_some_and(|rub| rub.is_on(surface))) {
            kept.let_go(&mut self.surfaces, &mut self.closed);
        }
    }

    /// Energies of the contacts that are pressed [J].
    pub(crate) fn rub_ledgers(&self) -> impl Iterator<Item = &Ledger> {
        self.bores.values().filter_map(|bore| Some(bore.kept.as_ref()?.rub()?.ledger()))
    }

    /// The places of the surfaces of a pair among all.
    fn own(&self, pair: &ContactPair) -> [Option<usize>; 2] {
        [pair.collider1, pair.collider2]
            .map(|own| self.surfaces.iter().position(|worn| worn.proxy == own))
    }

    /// True when one of the surfaces is a plate at rest: Rapier's contact with it is for the other
    /// resolvers.
    fn has_plate(&self, own: [Option<usize>; 2]) -> bool {
        let holds = |at| gate::can_hold(&self.lies, &self.surfaces, SurfaceId(at));
        own.into_iter().flatten().any(holds)
    }

    /// Presses what has borne an impulse [N s] in the step by lying there.
    fn lie(
        &mut self,
        pair: &ContactPair,
        blow: &Blow,
        impulse: f64,
        kept: &mut Option<Lying>,
        reason: Refusal,
        world: &WorldView<'_>,
    ) {
        let Some((body, is_first)) = moving(pair, world).filter(|_| impulse > 0.0) else { return };
        // A free body that wears would have to sink to what carries it, and Rapier does not know: of
        // two dynamic bodies one is such a body.
        let stands = if is_first { pair.collider2 } else { pair.collider1 };
        if is_dynamic(stands, world) {
            return;
        }
        let own = self.own(pair);
        let [lies, stands] = if is_first { own } else { [own[1], own[0]] };
        if let (None, Some(at), false) = (lies, stands, self.has_plate(own)) {
            let bearing =
                Bearing { pair, surface: SurfaceId(at), blow, impulse, body, is_first, reason };
            self.press_lying(&bearing, kept, world);
        }
    }

    /// Runs the collision and books it.
    fn strike(&mut self, pair: &ContactPair, blow: &Blow, reason: Refusal, world: &WorldView<'_>) {
        let own = self.own(pair);
        let Some((body, is_first)) = moving(pair, world) else { return };
        let Some(at) = own.into_iter().flatten().next().map(SurfaceId) else { return };
        if self.has_plate(own) {
            return self.refuse(body, at, reason);
        }
        let Some(two) = Two::of(pair, own, blow, &self.surfaces, world) else {
            let collider = if own[0].is_some() { pair.collider2 } else { pair.collider1 };
            return self.refuse(body, at, Refusal::Shape { collider });
        };
        let drift = blow.drift(pair, two.roles.first_stands, world, &self.before);
        let striker = Striker::new(two, blow, &drift, &self.surfaces, self.current.dt);
        let settings = self.settings.encounter();
        let (outcome, done) = striker.run(&mut self.surfaces, blow, settings);
        let Outcome { ledger, steps, node_evaluations, contact_time, worn } = outcome;
        self.closed += ledger;
        self.counters.collision += 1;
        self.counters.steps += steps;
        self.counters.node_evaluations += node_evaluations;
        let impulse = blow.normal * if is_first { -blow.impulse } else { blow.impulse };
        for (surface, volume) in worn {
            self.events.push(WearEvent::Started { body, surface });
            self.events.push(WearEvent::Ended { body, surface, impulse, volume, contact_time });
        }
        if let Err(error) = done {
            self.give_up(body, at, error);
        }
    }

    /// Leaves a contact that the core could not take to the end.
    fn give_up(&mut self, body: RigidBodyHandle, surface: SurfaceId, error: PhysicsError) {
        let reason = match &error {
            PhysicsError::LoadNotReached { .. } => Some(Refusal::Inside),
            PhysicsError::Unsupported { .. } => Some(Refusal::Wears),
            error => Refusal::of(error, self.settings.resolve),
        };
        match reason {
            Some(reason) => self.refuse(body, surface, reason),
            None => self.fail(body, surface, error),
        }
    }

    /// Speed at which a body does not move in a step as the finest of the surfaces sees it [m/s].
    fn still(&self) -> f64 {
        let pitch = |worn: &WornCollider| worn.surface.pitch();
        let finest = self.surfaces.iter().map(pitch).fold(f64::INFINITY, f64::min);
        STILL * finest / self.current.dt
    }
}

fn key(pair: &ContactPair) -> PairKey {
    let mut key = [pair.collider1, pair.collider2].map(ColliderHandle::into_raw_parts);
    key.sort_unstable();
    key
}

/// True for a collider of a dynamic body.
fn is_dynamic(collider: ColliderHandle, world: &WorldView<'_>) -> bool {
    let parent = world.colliders.get(collider).and_then(Collider::parent);
    parent.and_then(|body| world.bodies.get(body)).is_some_and(RigidBody::is_dynamic)
}

/// The dynamic body of a pair that is awake, the second if both are, and whether it is the first:
/// sleeping pairs keep the impulses of their last step.
fn moving(pair: &ContactPair, world: &WorldView<'_>) -> Option<(RigidBodyHandle, bool)> {
    let body = |collider: ColliderHandle| {
        let parent = world.colliders.get(collider)?.parent()?;
        let awake = |rb: &&RigidBody| rb.is_dynamic() && !rb.is_sleeping();
        world.bodies.get(parent).filter(awake).map(|_| parent)
    };
    let second = body(pair.collider2).map(|body| (body, false));
    second.or_else(|| body(pair.collider1).map(|body| (body, true)))
}
