//! A body at the beginning of a step, and how it is to be carried through it.

use abrade::{Body, Encounter, PhysicsError, State, Until};
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::{RigidBody, RigidBodyHandle};

use crate::ahead::Ahead;
use crate::event::Refusal;
use crate::extent::Extent;
use crate::gate::{self, Course, Lie, Way};
use crate::micro::Errand;
use crate::obstacle::Obstacles;
use crate::resolve::Left;
use crate::resolver::Resolve;
use crate::settings::WearSettings;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::{Known, Live, Tracked};
use crate::view::WorldView;
use crate::world::WearWorld;
use crate::{afloat, free, scalar, shadow};

/// Share of its radius by which a body may lie inside a surface and be lifted out of it.
const LIFT: f64 = 0.2;

/// What carrying a body looks at.
pub(crate) struct Scene<'a> {
    pub world: &'a WorldView<'a>,
    pub surfaces: &'a [WornCollider],
    pub lies: &'a [Lie],
    pub obstacles: &'a Obstacles,
    /// Bodies near a surface, and dynamic bodies of surfaces that were carried in this step, with
    /// boxes around wherever they may have got.
    pub candidates: &'a [RigidBodyHandle],
    pub carried: &'a [(RigidBodyHandle, Extent)],
    pub settings: &'a WearSettings,
    /// Length of the step [s].
    pub dt: f64,
    /// Time within which a contact that is to come matters [s].
    pub sight: f64,
}

/// A body at the beginning of a step.
pub(crate) struct Start {
    pub body: RigidBodyHandle,
    /// The surfaces of its encounter; it is carried in the frame of the first.
    pub surfaces: Vec<SurfaceId>,
    /// The surface of its own, which wears as well, and its frame in that of the body.
    pub skin: Option<(SurfaceId, Isometry3<f64>)>,
    pub frame: Isometry3<f64>,
    bounds: Extent,
    /// Its state in that frame.
    pub state: State,
    /// Its course in the world.
    pub course: Course,
    /// An encounter has to begin.
    pub is_new: bool,
    /// A surface moves in the step.
    pub moves: bool,
    /// The dynamic body that its surface is on, and a box around wherever it may get.
    pub free: Option<(RigidBodyHandle, Extent)>,
}

/// How a body is carried through the step.
pub(crate) enum How {
    /// It was, ahead.
    Done(Box<Ahead>),
    /// At once.
    Whole,
    /// In parts: something is in its way.
    Parts,
}

impl WearWorld {
    /// What carrying a body looks at, for those who only look.
    pub(crate) fn scene<'a>(&'a self, world: &'a WorldView<'a>) -> Scene<'a> {
        Scene {
            world,
            surfaces: &self.surfaces,
            lies: &self.lies,
            obstacles: &self.obstacles,
            candidates: &self.candidates,
            carried: &self.current.carried,
            settings: &self.settings,
            dt: self.current.dt,
            sight: self.current.sight,
        }
    }
}

impl Scene<'_> {
    /// Derives the body and reads its state; nothing for one that is gone.
    pub fn start(&self, tracked: &mut Tracked) -> Result<Option<Start>, Left> {
        let body = tracked.handle;
        let Some(rb) = self.world.bodies.get(body) else { return Ok(None) };
        if self.carried.iter().any(|(carried, _)| *carried == body) {
            // With the body that struck it.
            return Ok(None);
        }
        self.admit(rb, tracked)?;
        let skin = self.skin(rb, tracked)?;
        let same_skin = |live: &&Live| live.skin.map(|(id, _)| id) == skin.map(|(id, _)| id);
        let known = tracked.live.as_ref().filter(|_| tracked.knows_surfaces(self.lies));
        let known = known.filter(same_skin);
        let is_new = known.is_none();
        let surfaces = known.map_or(&tracked.near, |live| &live.surfaces).clone();
        let Some(&anchor) = surfaces.first() else { return Ok(None) };
        let Some(lie) = Lie::find(self.lies, anchor) else { return Ok(None) };
        // Led surfaces move away from the frame in which their encounter began.
        let kept = known.and_then(|live| live.frame);
        let moves = surfaces.iter().any(|id| Lie::find(self.lies, *id).is_some_and(Lie::moves));
        let frame = kept.unwrap_or(lie.pose);
        let bounds = match frame == lie.pose {
            true => gate::floor(lie, &self.surfaces[anchor.0]),
            false => Extent::NO_FLOOR,
        };
        let mut course = Course::of(rb, tracked, &scalar::vector(self.world.gravity));
        course.surfaces_speed = gate::top_speed(self.lies, &surfaces);
        let mut state = shadow::read(rb, tracked.shadow.as_ref(), &frame);
        let Known::Ready(known) = &mut tracked.known else { return Ok(None) };
        let can_hold = |id: &SurfaceId| gate::can_hold(self.lies, self.surfaces, *id);
        if is_new && !tracked.is_placed && surfaces.iter().all(can_hold) {
            let lift = self.lift(known, &state, anchor, tracked.radius);
            state.position.z += lift;
            course.state.position += frame * Vector3::z() * lift;
        }
        known.state = state;
        if skin.is_some() && self.meets_others(rb, surfaces[0], &course) {
            return Err(Refusal::Wears.into());
        }
        if let Some(refusal) = self.bound_by_free(rb, body, &surfaces, &course) {
            return Err(refusal.into());
        }
        let free = free::lead(self.lies, &surfaces).and_then(|(lead, free)| {
            let rb = self.world.bodies.get(free.body)?;
            Some((free.body, self.reach_of(rb, &lead, &course)))
        });
        Ok(Some(Start { body, surfaces, skin, frame, bounds, state, course, is_new, moves, free }))
    }

    /// Derives the body; a refusal for one that is not Micro's wherever it goes.
    fn admit(&self, rb: &RigidBody, tracked: &mut Tracked) -> Result<(), Refusal> {
        if let Some(refusal) = gate::bound(self.world, rb, tracked.handle) {
            return Err(refusal);
        }
        tracked.derive(rb, self.world.colliders)?;
        if tracked.is_in_lockstep_blow() {
            return Err(Refusal::Blow);
        }
        match self.settings.resolve {
            Resolve::QuasiStatic | Resolve::Lockstep => Err(Refusal::Asked),
            Resolve::Auto if self.rests(rb, tracked) => Err(Refusal::Resting),
            Resolve::Auto | Resolve::Micro => Ok(()),
        }
    }

    /// Height by which a body that Rapier's contact has let sink into a surface is lifted [m].
    fn lift(&self, body: &Body, state: &State, surface: SurfaceId, radius: f64) -> f64 {
        let depth = afloat::depth(body, state, &self.surfaces[surface.0]);
        if depth < LIFT * radius { depth } else { 0.0 }
    }

    /// The encounter that the body has or begins.
    pub fn encounter(&self, start: &Start, tracked: &Tracked) -> Result<Encounter, PhysicsError> {
        match (&tracked.live, &tracked.known) {
            (Some(live), _) if !start.is_new => Ok(live.encounter.clone()),
            (_, Known::Ready(body)) if start.skin.is_some() => self.encounter_of_two(start, body),
            (_, Known::Ready(body)) => {
                let met = start.surfaces.iter().map(|id| &*self.surfaces[id.0].surface);
                Encounter::new(body, met, self.settings.encounter())
            }
            _ => Err(PhysicsError::Unsupported { what: "a body that was not derived" }),
        }
    }

    /// Begins the encounter of a body that has none, and lays it in the frame of this step.
    pub fn open(&self, start: &Start, tracked: &mut Tracked) -> Result<(), Left> {
        let live = match tracked.live.take() {
            Some(live) => live,
            None => match self.encounter(start, tracked) {
                Ok(encounter) => Live::new(encounter, start.surfaces.clone()),
                // Laws that two surfaces cannot have between them.
                Err(PhysicsError::Unsupported { .. }) if start.skin.is_some() => {
                    return Err(Refusal::Wears.into());
                }
                Err(error) => return Err(error.into()),
            },
        };
        let frame = start.moves.then_some(start.frame).or(live.frame);
        tracked.live = Some(Live { frame, skin: start.skin, ..live });
        Ok(())
    }

    /// What the body is to do.
    pub fn errand<'a>(&self, way: Way<'a>, start: &Start, until: Until) -> Errand<'a> {
        let gravity = scalar::vector(self.world.gravity);
        let loads = gate::loads(way.rb, &gravity, &start.frame);
        Errand { way, loads, dt: self.dt, until, in_parts: false }
    }

    /// How to carry the body. Where it could reach something, it is run as if it were alone. If it
    /// was then where something else is, it has to look where it goes; something that it would run
    /// into before it meets a surface refuses it.
    pub fn how(
        &self,
        ahead: Option<Box<Ahead>>,
        start: &Start,
        tracked: &Tracked,
        errand: &Errand<'_>,
        is_watched: bool,
    ) -> Result<How, Left> {
        let way = &errand.way;
        if start.free.is_some() || start.skin.is_some() {
            return match way.in_reach(&start.course, self.dt) {
                None => Ok(How::Whole),
                Some(refusal) => Err(refusal.into()),
            };
        }
        // Loaded springs may throw the body farther than its speed tells.
        let touches = tracked.live.as_ref().is_some_and(|live| live.encounter.in_contact());
        let is_free = || !touches && way.in_reach(&start.course, self.dt).is_none();
        if ahead.is_none() && is_free() {
            return Ok(How::Whole);
        }
        let run = || {
            let encounter = self.encounter(start, tracked)?;
            Ahead::run(start, encounter, tracked, self, errand).map(Box::new)
        };
        match ahead.map_or_else(run, Ok) {
            Ok(ahead) if way.on_track(&ahead.track).is_none() || is_free() => match is_watched {
                true => Ok(How::Whole),
                false => Ok(How::Done(ahead)),
            },
            _ => match way.on_course(&start.course, self.dt) {
                Some(refusal) => Err(refusal.into()),
                None => Ok(How::Parts),
            },
        }
    }
}

impl Start {
    /// What may lie in the body's way.
    pub fn way<'a>(&self, world: &'a WorldView<'_>, obstacles: &'a Obstacles) -> Option<Way<'a>> {
        let rb = world.bodies.get(self.body)?;
        let (body, colliders) = (self.body, &*world.colliders);
        Some(Way { body, rb, colliders, obstacles, frame: self.frame, bounds: self.bounds })
    }
}
