//! The Micro resolver: one body carried through a whole step by the core, on its own.

use abrade::{
    Advance, Body, Carrier, Changes, Encounter, Ledger, Loads, PhysicsError, Placed, Skin, State,
    Surface, Until,
};
use nalgebra::{Isometry3, Vector3};

use crate::ahead::Ahead;
use crate::changed::Changed;
use crate::gate::{Course, Lead, Lie, Way};
use crate::observer::{Relay, WearObserver};
use crate::start::Start;
use crate::surface::{SurfaceId, WornCollider};
use crate::track::{Trace, Track};
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

/// What carrying a body changes, and where the surfaces lie.
pub(crate) struct Room<'a> {
    pub surfaces: &'a mut [WornCollider],
    pub lies: &'a [Lie],
    pub changed: &'a mut Changed,
}

/// What a step did to a body.
pub(crate) struct Carried {
    pub advance: Advance,
    pub worn: Volumes,
    /// Where it was, in the frame of its first surface.
    pub track: Track,
    /// End of the dynamic body that a surface is on.
    pub carrier: Option<State>,
}

/// Volumes displaced, surface by surface [m3].
pub(crate) type Volumes = Vec<(SurfaceId, f64)>;

impl Live {
    /// A running encounter with the given surfaces.
    pub fn new(encounter: Encounter, surfaces: Vec<SurfaceId>) -> Self {
        Self { encounter, surfaces, skin: None, frame: None }
    }

    /// Takes over what `body` did ahead.
    pub fn take_over(&mut self, ahead: Ahead, body: &mut Body, room: Room<'_>) -> Carried {
        let Ahead { end, encounter, advance, track, changes, .. } = ahead;
        self.encounter = encounter;
        body.state = end;
        let worn = apply(&self.surfaces, &changes, room.surfaces, room.changed);
        Carried { advance, worn, track, carrier: None }
    }

    /// Carries `body` from its `start`. Where it fails, what it has worn until then comes with the error.
    pub fn carry(
        &mut self,
        body: &mut Body,
        start: &Start,
        errand: &Errand<'_>,
        room: Room<'_>,
        observer: &mut dyn WearObserver,
    ) -> Result<Carried, (PhysicsError, Volumes)> {
        let trace = Trace::new(start.state.position, errand.pull(body), errand.dt);
        let (body_of, frame, surfaces) = (start.body, start.frame, &start.surfaces);
        let mut relay = Relay { observer, body: body_of, frame, surfaces, began: 0.0, trace };
        let (advance, worn, carrier) = self.wear(body, errand, room, &mut relay);
        let track = relay.trace.finish().map(|extent| extent.grown(start.course.radius()));
        match advance {
            Ok(advance) => Ok(Carried { advance, worn, track, carrier }),
            Err(error) => Err((error, worn)),
        }
    }

    /// Carries `body`, whose state is given in the frame of the first surface. Where changes are
    /// noted, the surfaces are worn by way of leaves, which know theirs. Returns the volumes too, and
    /// the end of the dynamic body that a surface is on.
    fn wear(
        &mut self,
        body: &mut Body,
        errand: &Errand<'_>,
        room: Room<'_>,
        relay: &mut Relay<'_>,
    ) -> (Result<Advance, PhysicsError>, Volumes, Option<State>) {
        let Room { surfaces, lies, changed } = room;
        let seats = seats(&self.surfaces, lies, &errand.way.frame);
        let (ids, skin) = (self.all(), self.skin.map(|(_, pose)| pose));
        let mut go = |placed: &mut [Placed<'_>]| match errand.in_parts {
            true => go_in_parts(&mut self.encounter, body, placed, errand, relay),
            false => go(&mut self.encounter, body, placed, errand, errand.dt, relay),
        };
        if changed.is_noted() {
            let leaf = |id: &SurfaceId| Surface::leaf(&surfaces[id.0].surface);
            let mut leaves: Vec<Surface> = ids.iter().map(leaf).collect();
            let mut placed = dressed(leaves.iter_mut(), &seats, skin);
            let result = go(&mut placed);
            let carrier = carrier(&placed);
            let changes: Vec<_> = leaves.into_iter().map(Surface::into_changes).collect();
            return (result, apply(&ids, &changes, surfaces, changed), carrier);
        }
        let mut placed = dressed(owned(surfaces, &ids), &seats, skin);
        let result = go(&mut placed);
        let carrier = carrier(&placed);
        let worn = |id: &SurfaceId| (*id, surfaces[id.0].owned().settle().displaced());
        (result, ids.iter().map(worn).collect(), carrier)
    }

    /// Ends the encounter; returns its energies, and the volumes that broke off.
    pub fn end(mut self, surfaces: &mut [WornCollider]) -> (Ledger, Volumes) {
        let skin = self.skin.map(|(_, pose)| pose);
        let broken = end(surfaces, &self.all(), skin, |placed| self.encounter.end(placed));
        (*self.encounter.ledger(), broken)
    }

    /// The surfaces of the encounter, and the body's own.
    pub fn all(&self) -> Vec<SurfaceId> {
        self.surfaces.iter().copied().chain(self.skin.map(|(id, _)| id)).collect()
    }
}

/// The surfaces on their seats; one more than those is the body's own, whose frame is at `skin` in that
/// of the body.
fn dressed<'a>(
    mut surfaces: impl Iterator<Item = &'a mut Surface>,
    seats: &[Seat],
    skin: Option<Isometry3<f64>>,
) -> Vec<Placed<'a>> {
    let mut placed = placed(surfaces.by_ref().take(seats.len()), seats);
    if let (Some(first), Some(pose), Some(surface)) = (placed.first_mut(), skin, surfaces.next()) {
        first.skin = Some(Skin { surface, pose });
    }
    placed
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
        total.twist += part.twist;
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

/// State of the dynamic body that carries one of the surfaces.
pub(crate) fn carrier(placed: &[Placed<'_>]) -> Option<State> {
    let carriers = placed.iter().filter_map(|placed| placed.carrier.as_ref());
    carriers.filter(|carrier| carrier.inertia.is_some()).map(|carrier| carrier.state).next()
}

/// Ends a contact by `end`, wherever the body is: with the surfaces `ids`, of which the last is the
/// body's own if it has a `skin`. Returns the volumes that broke off.
pub(crate) fn end(
    surfaces: &mut [WornCollider],
    ids: &[SurfaceId],
    skin: Option<Isometry3<f64>>,
    end: impl FnOnce(&mut [Placed<'_>]),
) -> Volumes {
    let seats = vec![(Isometry3::identity(), None); ids.len() - usize::from(skin.is_some())];
    let mut placed = dressed(owned(surfaces, ids), &seats, skin);
    end(&mut placed);
    ids.iter().map(|id| (*id, surfaces[id.0].settle_end())).collect()
}

/// Where a surface lies in the frame of an integration, and what carries it.
pub(crate) type Seat = (Isometry3<f64>, Option<Carrier>);

/// Where the surfaces `ids` lie in `frame`.
pub(crate) fn seats(ids: &[SurfaceId], lies: &[Lie], frame: &Isometry3<f64>) -> Vec<Seat> {
    ids.iter().map(|id| seat(*id, lies, frame)).collect()
}

/// Where the surface `id` lies in `frame`; one whose own that is, exactly at its origin.
pub(crate) fn seat(id: SurfaceId, lies: &[Lie], frame: &Isometry3<f64>) -> Seat {
    let Some(lie) = Lie::find(lies, id) else { return (Isometry3::identity(), None) };
    let pose = match lie.pose == *frame {
        true => Isometry3::identity(),
        false => frame.inv_mul(&lie.pose),
    };
    let carrier = |lead: Lead| Carrier {
        state: lead.state.seen_from(frame),
        inertia: lead.free.map(|free| free.inertia),
        loads: turned(&lead.loads, frame),
    };
    (pose, lie.lead.map(carrier))
}

/// Loads in the world, seen from `frame`.
fn turned(loads: &Loads, frame: &Isometry3<f64>) -> Loads {
    let [gravity, force, torque] =
        [loads.gravity, loads.force, loads.torque].map(|v| frame.inverse_transform_vector(&v));
    Loads { gravity, force, torque, ..*loads }
}

/// The surfaces on their seats.
pub(crate) fn placed<'a>(
    surfaces: impl Iterator<Item = &'a mut Surface>,
    seats: &[Seat],
) -> Vec<Placed<'a>> {
    surfaces
        .zip(seats)
        .map(|(surface, &(pose, carrier))| Placed { surface, pose, carrier, skin: None })
        .collect()
}

/// The surface `id` itself on its seat, to be worn.
pub(crate) fn place(
    surfaces: &mut [WornCollider],
    id: SurfaceId,
    (pose, carrier): Seat,
) -> [Placed<'_>; 1] {
    let surface = surfaces[id.0].owned();
    surface.settle();
    [Placed { surface, pose, carrier, skin: None }]
}

/// The surfaces `ids` themselves, in that order, to be worn.
pub(crate) fn owned<'a>(
    surfaces: &'a mut [WornCollider],
    ids: &[SurfaceId],
) -> impl Iterator<Item = &'a mut Surface> {
    let mut owned: Vec<(usize, &mut Surface)> = Vec::with_capacity(ids.len());
    for (index, worn) in surfaces.iter_mut().enumerate() {
        if let Some(order) = ids.iter().position(|id| id.0 == index) {
            let surface = worn.owned();
            surface.settle();
            owned.push((order, surface));
        }
    }
    owned.sort_by_key(|(order, _)| *order);
    owned.into_iter().map(|(_, surface)| surface)
}
