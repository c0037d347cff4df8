//! The Micro resolver: one body carried through a whole step by the core, on its own.

use abrade::{Advance, Body, Encounter, Loads, PhysicsError, Placed, Until};
use nalgebra::{Isometry3, Vector3};

use crate::gate::{Course, Lie, Way};
use crate::observer::Relay;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::Live;

/// Parts of a step between which a body with something in reach looks where it goes.
const SLICES: f64 = 64.0;

/// Share of its radius by which a body may lie inside a surface and be lifted out of it.
const LIFT: f64 = 0.2;

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
        Ok(Self { encounter, surfaces: ids.to_vec() })
    }

    /// Lifts a body that an engine left inside the surfaces until it is clear of them.
    pub fn lift(
        &mut self,
        body: &mut Body,
        surfaces: &mut [WornCollider],
        lies: &[Lie],
        frame: &Isometry3<f64>,
    ) {
        let placed = place(surfaces, &self.surfaces, lies, frame);
        let overlap = self.encounter.overlap(body, &placed);
        if overlap < LIFT * body.shape.bounding_radius() {
            body.state.position.z += overlap;
        }
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
pub(crate) fn place<'a>(
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
