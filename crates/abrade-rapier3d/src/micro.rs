//! The Micro resolver: one body carried through a whole step by the core, on its own.

use abrade::{Advance, Body, Changes, Encounter, Loads, PhysicsError, Placed, Surface, Until};
use nalgebra::{Isometry3, Vector3};

use crate::changed::Changed;
use crate::gate::{Course, Lie, Way};
use crate::observer::Relay;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::Live;

/// Parts of a step between which a body with something in its way looks where it goes.
const PARTS: u32 = 64;

/// How far a body is carried, and what acts on it.
pub(crate) struct Errand<'a> {
    pub way: Way<'a>,
    pub loads: Loads,
    /// Duration [s].
    pub dt: f64,
    pub until: Until,
    /// Something is in the way: look part by part.
    pub in_parts: bool,
}

/// Volumes displaced, surface by surface [m3].
pub(crate) type Volumes = Vec<(SurfaceId, f64)>;

impl Live {
    /// A running encounter with the given surfaces.
    pub fn new(encounter: Encounter, surfaces: Vec<SurfaceId>) -> Self {
        Self { encounter, surfaces }
    }

    /// Carries `body`, whose state is given in the frame of the first surface. Where changes are
    /// noted, the surfaces are worn by way of leaves, which know theirs.
    pub fn carry(
        &mut self,
        body: &mut Body,
        surfaces: &mut [WornCollider],
        lies: &[Lie],
        errand: &Errand<'_>,
        relay: &mut Relay<'_>,
        changed: &mut Changed,
    ) -> (Result<Advance, PhysicsError>, Volumes) {
        let poses = poses(&self.surfaces, lies, &errand.way.frame);
        let mut go = |placed: &mut [Placed<'_>]| match errand.in_parts {
            true => go_in_parts(&mut self.encounter, body, placed, errand, relay),
            false => go(&mut self.encounter, body, placed, errand, errand.dt, relay),
        };
        if changed.is_noted() {
            let leaf = |id: &SurfaceId| Surface::leaf(&surfaces[id.0].surface);
            let mut leaves: Vec<Surface> = self.surfaces.iter().map(leaf).collect();
            let result = go(&mut placed(leaves.iter_mut(), &poses));
            let changes: Vec<_> = leaves.into_iter().map(Surface::into_changes).collect();
            return (result, apply(&self.surfaces, &changes, surfaces, changed));
        }
        let result = go(&mut place(surfaces, &self.surfaces, &poses));
        let worn = |id: &SurfaceId| (*id, surfaces[id.0].owned().settle().displaced());
        (result, self.surfaces.iter().map(worn).collect())
    }
}

impl Errand<'_> {
    /// What the loads accelerate the body by, in the frame [m/s2].
    pub fn pull(&self, body: &Body) -> Vector3<f64> {
        self.loads.gravity + self.loads.force / body.inertia.mass
    }

    /// The free course of `body` from its present state, in the world.
    fn course(&self, body: &Body) -> Course {
        let frame = &self.way.frame;
        let acceleration = frame * self.pull(body);
        Course::from_state(body.state.placed_by(frame), acceleration, body.shape.bounding_radius())
    }
}

fn go(
    encounter: &mut Encounter,
    body: &mut Body,
    placed: &mut [Placed<'_>],
    errand: &Errand<'_>,
    time: f64,
    relay: &mut Relay<'_>,
) -> Result<Advance, PhysicsError> {
    encounter.advance(body, placed, &errand.loads, time, errand.until, relay)
}

/// Carries a body that something is in the way of: part by part, and it stops short of what it
/// would run into, as under Rapier's own clamp. The rest of the step is lost to it.
fn go_in_parts(
    encounter: &mut Encounter,
    body: &mut Body,
    placed: &mut [Placed<'_>],
    errand: &Errand<'_>,
    relay: &mut Relay<'_>,
) -> Result<Advance, PhysicsError> {
    let part_time = errand.dt / f64::from(PARTS);
    let mut total = Advance::default();
    for number in 1..=PARTS {
        let course = errand.course(body);
        if errand.way.ahead(&course, part_time, total.time, errand.dt).is_some() {
            break;
        }
        relay.began = total.time;
        let time = f64::from(number) * part_time - total.time;
        let part = go(encounter, body, placed, errand, time, relay)?;
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

/// Takes over what leaves have worn; returns the volumes.
pub(crate) fn apply(
    ids: &[SurfaceId],
    changes: &[Changes],
    surfaces: &mut [WornCollider],
    changed: &mut Changed,
) -> Volumes {
    let pairs = ids.iter().zip(changes);
    pairs
        .map(|(id, changes)| {
            let worn = &mut surfaces[id.0];
            worn.owned().apply(changes);
            changed.add(id.0, worn, changes);
            (*id, changes.gain().displaced())
        })
        .collect()
}

/// Where the surfaces `ids` lie in `frame`, the first one exactly at its origin.
pub(crate) fn poses(
    ids: &[SurfaceId],
    lies: &[Lie],
    frame: &Isometry3<f64>,
) -> Vec<Isometry3<f64>> {
    let pose = |(order, id): (usize, &SurfaceId)| match Lie::find(lies, *id) {
        Some(lie) if order > 0 => frame.inv_mul(&lie.pose),
        _ => Isometry3::identity(),
    };
    ids.iter().enumerate().map(pose).collect()
}

/// The surfaces at their poses.
pub(crate) fn placed<'a>(
    surfaces: impl Iterator<Item = &'a mut Surface>,
    poses: &[Isometry3<f64>],
) -> Vec<Placed<'a>> {
    surfaces.zip(poses).map(|(surface, pose)| Placed::at_rest(surface, *pose)).collect()
}

/// The surfaces `ids` themselves at their poses, in that order, to be worn.
pub(crate) fn place<'a>(
    surfaces: &'a mut [WornCollider],
    ids: &[SurfaceId],
    poses: &[Isometry3<f64>],
) -> Vec<Placed<'a>> {
    let mut owned: Vec<(usize, &mut Surface)> = Vec::with_capacity(ids.len());
    for (index, worn) in surfaces.iter_mut().enumerate() {
        if let Some(order) = ids.iter().position(|id| id.0 == index) {
            let surface = worn.owned();
            surface.settle();
            owned.push((order, surface));
        }
    }
    owned.sort_by_key(|(order, _)| *order);
    placed(owned.into_iter().map(|(_, surface)| surface), poses)
}
