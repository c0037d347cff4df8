//! What lies, slides or rolls among others: the nodes below it sink until they carry the load that
//! Rapier's contact bore, along the way that the one went over the other.
//!
//! Nothing is done before the one has gone a good part of a pitch, or bears more than it did; the load
//! is then the mean since the nodes last gave way. Rapier's penetration never wears anything.

use abrade::{Advance, Ledger};
use nalgebra::Isometry3;
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::ContactPair;

use crate::booking::{Booking, Contact};
use crate::collision::blow::Blow;
use crate::collision::passage::Passage;
use crate::collision::rub::{Rub, Stretch};
use crate::collision::two::Two;
use crate::event::Refusal;
use crate::micro::Volumes;
use crate::quasi_static::{self, SAMPLES};
use crate::resolver::Resolver;
use crate::surface::{SurfaceId, WornCollider};
use crate::view::WorldView;
use crate::world::WearWorld;

/// Share by which a load must have grown to press what has not moved.
const GROWN: f64 = 1e-3;
/// Steps without an impulse that do not end a contact: on facets Rapier's contact comes and goes.
const ABSENT: u32 = 2;

/// A contact that lasts, between the steps.
#[cfg_attr(feature = "serde-serialize", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Lying {
    body: RigidBodyHandle,
    /// Frame of the second collider in that of the first where the nodes last gave way, and the
    /// load then [N].
    place: Isometry3<f64>,
    load: f64,
    /// Impulse since then [N s], in this time [s].
    impulse: f64,
    time: f64,
    /// The load has become too small to move a node.
    is_firm: bool,
    /// Steps without an impulse.
    absent: u32,
    rub: Option<Rub>,
    contact: Option<Contact>,
}

/// What a pair bears in a step.
pub(crate) struct Bearing<'a> {
    pub pair: &'a ContactPair,
    /// The surface of the one that stands.
    pub surface: SurfaceId,
    pub blow: &'a Blow,
    /// Impulse of what lies [N s].
    pub impulse: f64,
    /// The dynamic body, and whether it is the first.
    pub body: RigidBodyHandle,
    pub is_first: bool,
    pub reason: Refusal,
}

impl Lying {
    fn new(body: RigidBodyHandle, place: Isometry3<f64>) -> Self {
        let (load, impulse, time) = (0.0, 0.0, 0.0);
        let (is_firm, absent, rub, contact) = (false, 0, None, None);
        Self { body, place, load, impulse, time, is_firm, absent, rub, contact }
    }

    /// Goes through a step of `dt` [s] without an impulse; false for a contact that is over.
    pub fn waits(&mut self, dt: f64) -> bool {
        self.absent += 1;
        self.time += dt;
        self.absent <= ABSENT
    }

    /// Has touched in this step, be it in a blow.
    pub fn is_met(&mut self) {
        self.absent = 0;
    }

    /// The body that lies.
    pub fn body(&self) -> RigidBodyHandle {
        self.body
    }

    /// Ends the contact that is pressed; what breaks off is a part of the contact that is open.
    pub fn let_go(&mut self, surfaces: &mut [WornCollider], closed: &mut Ledger) {
        let broken = self.end_rub(surfaces, closed);
        Contact::add_broken(&mut self.contact, &broken);
    }

    /// Ends the contact that is pressed; returns the volumes that broke off, to be booked.
    fn end_rub(&mut self, surfaces: &mut [WornCollider], closed: &mut Ledger) -> Volumes {
        let Some(rub) = self.rub.take() else { return Volumes::new() };
        let (ledger, broken) = rub.end(surfaces);
        *closed += ledger;
        broken
    }

    /// The contact that is open.
    pub fn contact(&self) -> Option<&Contact> {
        self.contact.as_ref()
    }

    /// The contact that is pressed.
    pub fn rub(&self) -> Option<&Rub> {
        self.rub.as_ref()
    }
}

impl WearWorld {
    /// Presses what lies.
    pub(crate) fn press_lying(
        &mut self,
        bearing: &Bearing<'_>,
        kept: &mut Option<Lying>,
        world: &WorldView<'_>,
    ) {
        let dt = self.current.dt;
        let is_firm = self.is_firm(bearing);
        if is_firm && kept.is_none() {
            return;
        }
        let Some(passage) = Passage::of(bearing.pair, world, &self.before) else { return };
        let lying = kept.get_or_insert_with(|| Lying::new(bearing.body, passage.at(0.0)));
        let mut worn = Volumes::new();
        if is_firm {
            (lying.is_firm, lying.time) = (true, lying.time + dt);
            lying.impulse += bearing.impulse;
        } else {
            self.press_on_way(bearing, lying, &passage, &mut worn, world);
        }
        let sign = if bearing.is_first { -1.0 } else { 1.0 };
        let impulse = bearing.blow.normal * (sign * bearing.impulse);
        let booking = Booking { impulse, contact_time: dt, touches: true };
        Contact::book(&mut lying.contact, lying.body, &booking, &worn, &mut self.events);
    }

    /// Presses the two along the way that they have gone since they were pressed, if it is one, or if
    /// the load has grown.
    fn press_on_way(
        &mut self,
        bearing: &Bearing<'_>,
        lying: &mut Lying,
        passage: &Passage,
        worn: &mut Volumes,
        world: &WorldView<'_>,
    ) {
        let (dt, blow) = (self.current.dt, bearing.blow);
        let pitch = self.surfaces[bearing.surface.0].surface.pitch();
        let mut way = passage.way(&lying.place, blow);
        if std::mem::take(&mut lying.is_firm) && way * SAMPLES >= pitch {
            // What it went under no load is no way.
            worn.extend(lying.end_rub(&mut self.surfaces, &mut self.closed));
            (lying.place, lying.load) = (passage.at(0.0), 0.0);
            (lying.impulse, lying.time) = (0.0, 0.0);
            way = passage.way(&lying.place, blow);
        }
        lying.impulse += bearing.impulse;
        lying.time += dt;
        let load = lying.impulse / lying.time;
        let moved = way * SAMPLES >= pitch;
        if !moved && load <= (1.0 + GROWN) * lying.load {
            return;
        }
        let (start, normal) = (lying.place, blow.normal);
        let stretch = Stretch { passage, start, way, normal, load, dt };
        lying.load = if moved { load } else { load.max(lying.load) };
        (lying.impulse, lying.time) = (0.0, 0.0);
        lying.place = passage.at(1.0);
        worn.extend(self.rub(bearing, lying, &stretch, world));
    }

    /// Presses the two along a stretch.
    fn rub(
        &mut self,
        bearing: &Bearing<'_>,
        lying: &mut Lying,
        stretch: &Stretch<'_>,
        world: &WorldView<'_>,
    ) -> Volumes {
        let Bearing { pair, surface, blow, body, is_first, reason, .. } = *bearing;
        let mut worn = Volumes::new();
        if lying.rub.as_ref().is_some_and(|rub| !rub.holds(&lying.place)) {
            worn = lying.end_rub(&mut self.surfaces, &mut self.closed);
        }
        if lying.rub.is_none() {
            let (own, collider) = match is_first {
                true => ([None, Some(surface.0)], pair.collider1),
                false => ([Some(surface.0), None], pair.collider2),
            };
            let two = Two::of(pair, own, blow, &self.surfaces, world);
            let (Some(two), Some(other)) = (two, world.colliders.get(collider)) else {
                self.refuse(body, surface, Refusal::Shape { collider });
                return worn;
            };
            let settings = self.settings.encounter();
            match Rub::new(&two, other, stretch, blow, &self.surfaces, settings) {
                Ok(rub) => lying.rub = Some(rub),
                Err(error) => {
                    self.give_up(body, surface, error);
                    return worn;
                }
            }
        }
        let Some(rub) = &mut lying.rub else { return worn };
        self.counters.quasi_static += 1;
        *self.reasons.entry((Resolver::QuasiStatic, reason.name().into())).or_default() += 1;
        let mut done = Advance::default();
        let (flowed, result) = rub.advance(stretch, &mut self.surfaces, &mut done);
        worn.extend(flowed);
        self.counters.steps += done.steps;
        self.counters.node_evaluations += done.node_evaluations;
        if let Err(error) = result {
            worn.extend(lying.end_rub(&mut self.surfaces, &mut self.closed));
            self.give_up(body, surface, error);
        }
        worn
    }

    /// Ends a contact.
    pub(crate) fn leave_lying(&mut self, mut lying: Lying) {
        lying.let_go(&mut self.surfaces, &mut self.closed);
        let Lying { body, mut contact, .. } = lying;
        Contact::end(&mut contact, body, &mut self.events);
    }

    /// True when no node can flow.
    fn is_firm(&self, bearing: &Bearing<'_>) -> bool {
        let load = bearing.impulse / self.current.dt;
        quasi_static::holds(&self.surfaces[bearing.surface.0].surface, load)
    }
}

#[cfg(feature = "serde-serialize")]
impl Lying {
    /// The surfaces that it names.
    pub fn surfaces(&self) -> impl Iterator<Item = SurfaceId> {
        let worn = self.contact.iter().flat_map(Contact::surfaces);
        worn.chain(self.rub.iter().map(Rub::surface))
    }

    /// True for places, loads and times that can be, with surfaces that are there.
    pub fn is_sound(&self, surfaces: &[WornCollider]) -> bool {
        let sizes = [self.load, self.impulse, self.time];
        sizes.iter().all(|x| x.is_finite() && *x >= 0.0)
            && self.absent <= ABSENT
            && crate::snapshot::is_frame(&self.place)
            && self.surfaces().all(|id| id.0 < surfaces.len())
            && self.rub.as_ref().is_none_or(|rub| rub.is_sound(surfaces))
    }
}
