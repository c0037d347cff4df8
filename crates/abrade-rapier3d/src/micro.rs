//! The Micro resolver: one body carried through a whole step by the core, on its own.

use abrade::{Advance, Body, Encounter, Loads, PhysicsError, Placed, Until};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::RigidBodyHandle;

use crate::event::WearEvent;
use crate::gate::{Course, Lie, Way};
use crate::observer::Relay;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::{Contact, Live};

/// Parts of a step between which a body with something in reach looks where it goes.
const SLICES: f64 = 64.0;

/// How far a body is carried, and what acts on it.
pub(crate) struct Errand<'a> {
    pub way: Way<'a>,
    pub loads: Loads,
    /// Duration [s].
    pub dt: f64,
    pub until: Until,
}

impl Live {
    /// An encounter of `body` with the given surfaces.
    pub fn new(
        body: &Body,
        ids: &[SurfaceId],
        surfaces: &[WornCollider],
        settings: abrade::EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let met = ids.iter().map(|id| &surfaces[id.0].surface);
        let encounter = Encounter::new(body, met, settings)?;
        Ok(Self { encounter, surfaces: ids.to_vec(), contact: None })
    }

    /// Carries `body`, whose state is given in the frame of the first surface. Where something
    /// stands within reach, it goes slice by slice and stops short of what it would run into, as
    /// under Rapier's own clamp: the rest of the step is lost to it.
    pub fn carry(
        &mut self,
        body: &mut Body,
        surfaces: &mut [WornCollider],
        lies: &[Lie],
        errand: &Errand<'_>,
        relay: &mut Relay<'_>,
    ) -> Result<Advance, PhysicsError> {
        let frame = errand.way.frame;
        let mut placed = place(surfaces, &self.surfaces, lies, &frame);
        let mut go = |body: &mut Body, time: f64, relay: &mut Relay<'_>| {
            self.encounter.advance(body, &mut placed, &errand.loads, time, errand.until, relay)
        };
        let course = errand.course(body);
        if errand.way.in_reach(&course, errand.dt).is_none() {
            return go(body, errand.dt, relay);
        }
        let slice = errand.dt / SLICES;
        let mut total = Advance::default();
        for number in 1..=SLICES as u32 {
            if errand.way.on_course(&errand.course(body), slice).is_some() {
                break;
            }
            relay.began = total.time;
            let part = go(body, f64::from(number) * slice - total.time, relay)?;
            total.time += part.time;
            total.steps += part.steps;
            total.node_evaluations += part.node_evaluations;
            total.impulse += part.impulse;
            total.contact_time += part.contact_time;
            total.exited = part.exited;
            if total.exited {
                break;
            }
        }
        Ok(total)
    }

    /// Books what an advance did to the open contact; raises events where it began or ended.
    pub fn book(
        &mut self,
        body: RigidBodyHandle,
        advance: &Advance,
        worn: &[(SurfaceId, f64)],
        frame: &Isometry3<f64>,
        events: &mut Vec<WearEvent>,
    ) {
        let touches = self.encounter.in_contact();
        if self.contact.is_none() && !touches && advance.contact_time == 0.0 {
            return;
        }
        let contact = self.contact.get_or_insert_with(Contact::default);
        contact.impulse += frame * advance.impulse;
        contact.time += advance.contact_time;
        // A contact that wears nothing is one with the first surface.
        let elastic = contact.surfaces.is_empty() && worn.iter().all(|(_, volume)| *volume == 0.0);
        for (at, &(surface, volume)) in worn.iter().enumerate() {
            if volume == 0.0 && !(elastic && at == 0) {
                continue;
            }
            match contact.surfaces.iter_mut().find(|(id, _)| *id == surface) {
                Some((_, sum)) => *sum += volume,
                None => {
                    contact.surfaces.push((surface, volume));
                    events.push(WearEvent::Started { body, surface });
                }
            }
        }
        if !touches {
            self.end_contact(body, events);
        }
    }

    /// Ends the open contact, if there is one.
    pub fn end_contact(&mut self, body: RigidBodyHandle, events: &mut Vec<WearEvent>) {
        let Some(contact) = self.contact.take() else { return };
        let Contact { impulse, time: contact_time, surfaces } = contact;
        for (surface, volume) in surfaces {
            events.push(WearEvent::Ended { body, surface, impulse, volume, contact_time });
        }
    }
}

impl Errand<'_> {
    /// The free course of `body` from its present state, in the world.
    fn course(&self, body: &Body) -> Course {
        let frame = &self.way.frame;
        let acceleration: Vector3<f64> =
            frame * (self.loads.gravity + self.loads.force / body.inertia.mass);
        Course::from_state(body.state.placed_by(frame), acceleration, body.shape.bounding_radius())
    }
}

/// The surfaces `ids` where they lie in `frame`, the first one exactly at its origin.
fn place<'a>(
    surfaces: &'a mut [WornCollider],
    ids: &[SurfaceId],
    lies: &[Lie],
    frame: &Isometry3<f64>,
) -> Vec<Placed<'a>> {
    let mut placed: Vec<(usize, Placed<'a>)> = Vec::with_capacity(ids.len());
    for (index, worn) in surfaces.iter_mut().enumerate() {
        let Some(order) = ids.iter().position(|id| id.0 == index) else { continue };
        let lie = lies.iter().find(|lie| lie.id.0 == index);
        let pose = match (order, lie) {
            (0, _) | (_, None) => Isometry3::identity(),
            (_, Some(lie)) => frame.inv_mul(&lie.pose),
        };
        placed.push((order, Placed { surface: &mut worn.surface, pose }));
    }
    placed.sort_by_key(|(order, _)| *order);
    placed.into_iter().map(|(_, placed)| placed).collect()
}
