//! Resolving one body near a wear surface: through the gate and the Micro resolver, or left to
//! Rapier with a reason, until the other resolvers know what it bore.

use abrade::{Advance, PhysicsError, Until};
use nalgebra::Isometry3;
use rapier::dynamics::RigidBodyHandle;

use crate::ahead::Ahead;
use crate::booking::Booking;
use crate::error::WearError;
use crate::event::{Refusal, WearEvent};
use crate::gate;
use crate::micro;
use crate::observer::{Relay, WearObserver};
use crate::resolver::Resolve;
use crate::shadow;
use crate::start::{How, Scene};
use crate::surface::SurfaceId;
use crate::track::Trace;
use crate::tracked::{Known, Live, Tracked};
use crate::view::WorldView;
use crate::world::{Integrated, WearWorld};

/// Why a body was left to Rapier.
pub(crate) enum Left {
    Refused(Refusal),
    Failed(PhysicsError),
}

impl From<Refusal> for Left {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<PhysicsError> for Left {
    fn from(error: PhysicsError) -> Self {
        Self::Failed(error)
    }
}

impl WearWorld {
    /// Carries one body through the step, or leaves it to Rapier and says why.
    pub(crate) fn resolve(
        &mut self,
        handle: RigidBodyHandle,
        world: &WorldView<'_>,
        until: Until,
        observer: &mut dyn WearObserver,
    ) {
        let tracked = Tracked::slot(&mut self.bodies, handle);
        let Some(&surface) = tracked.near.first() else { return };
        let is_placed = tracked.is_placed && tracked.shadow.is_some();
        let carried = self.carry(handle, world, until, observer);
        let tracked = Tracked::slot(&mut self.bodies, handle);
        tracked.is_placed = false;
        let Err(left) = carried else { return };
        self.closed += tracked.end(&mut self.events);
        match left {
            // Rapier's contacts overlap: only a state that the embedder gave exactly is an error.
            Left::Failed(PhysicsError::StartsInside { .. } | PhysicsError::StepVanished { .. })
                if !is_placed =>
            {
                self.leave(handle, surface, Refusal::Inside, world);
            }
            Left::Failed(PhysicsError::TooManySteps { .. })
                if self.settings.resolve == Resolve::Auto =>
            {
                self.leave(handle, surface, Refusal::Stiff, world);
            }
            Left::Refused(reason) => self.leave(handle, surface, reason, world),
            Left::Failed(error) => self.fail(handle, surface, error),
        }
    }

    /// Leaves a body to the other resolvers, if there is one for it.
    fn leave(
        &mut self,
        body: RigidBodyHandle,
        surface: SurfaceId,
        reason: Refusal,
        world: &WorldView<'_>,
    ) {
        let near = &Tracked::slot(&mut self.bodies, body).near;
        let may_hold = near.iter().all(|id| gate::can_hold(&self.lies, &self.surfaces, *id));
        match (self.settings.resolve, may_hold) {
            (Resolve::Auto, false) => {
                let near = near.clone();
                self.crowd(body, near, reason);
            }
            (Resolve::Micro, _) | (_, false) => self.refuse(body, surface, reason),
            _ if reason.is_final() => self.refuse(body, surface, reason),
            _ => self.hold(body, reason, world),
        }
    }

    pub(crate) fn refuse(&mut self, body: RigidBodyHandle, surface: SurfaceId, reason: Refusal) {
        self.counters.refused += 1;
        self.events.push(WearEvent::NotResolved { body, surface, reason });
    }

    pub(crate) fn fail(&mut self, body: RigidBodyHandle, surface: SurfaceId, error: PhysicsError) {
        self.counters.refused += 1;
        let source = error.clone();
        self.events.push(WearEvent::Failed { body, surface, error });
        self.current.failure.get_or_insert(WearError::Physics { body, surface, source });
    }

    /// Gate and Micro.
    fn carry(
        &mut self,
        handle: RigidBodyHandle,
        world: &WorldView<'_>,
        until: Until,
        observer: &mut dyn WearObserver,
    ) -> Result<(), Left> {
        let carried = self.carry_alone(handle, world, until, observer);
        if carried.is_err() {
            self.obstacles.blur(handle);
        }
        carried
    }

    fn carry_alone(
        &mut self,
        handle: RigidBodyHandle,
        world: &WorldView<'_>,
        until: Until,
        observer: &mut dyn WearObserver,
    ) -> Result<(), Left> {
        let dt = self.current.dt;
        let tracked = Tracked::slot(&mut self.bodies, handle);
        let ahead = tracked.ahead.take();
        let scene = Scene {
            world,
            surfaces: &self.surfaces,
            lies: &self.lies,
            obstacles: &self.obstacles,
            candidates: &self.candidates,
            carried: &self.current.carried,
            settings: &self.settings,
            dt,
            sight: self.current.sight,
        };
        let Some(start) = scene.start(tracked)? else { return Ok(()) };
        // An encounter goes on in the frame it began in.
        if start.is_new {
            self.closed += tracked.end(&mut self.events);
        }
        let Some(way) = start.way(world, &self.obstacles) else { return Ok(()) };
        let mut errand = scene.errand(way, &start, until);
        let ahead = ahead.filter(|ahead| ahead.holds(&self.changed, &self.surfaces));
        let how = scene.how(ahead, &start, tracked, &errand, observer.watches())?;
        if tracked.live.is_none() {
            let encounter = match scene.encounter(&start, tracked) {
                // Laws that two surfaces cannot have between them.
                Err(PhysicsError::Unsupported { .. }) if start.skin.is_some() => {
                    return Err(Refusal::Wears.into());
                }
                encounter => encounter?,
            };
            tracked.live = Some(Live::new(encounter, start.surfaces.clone()));
        }
        let (moves, free) = (start.moves, start.free);
        let mut moved = None;
        let Known::Ready(body) = &mut tracked.known else { return Ok(()) };
        let Some(live) = &mut tracked.live else { return Ok(()) };
        let (frame, course) = (start.frame, start.course);
        live.frame = moves.then_some(frame).or(live.frame);
        live.skin = start.skin;
        let (advance, worn, track) = match how {
            How::Done(ahead) => {
                let Ahead { end, encounter, advance, track, changes, .. } = *ahead;
                live.encounter = encounter;
                body.state = end;
                let (surfaces, changed) = (&mut self.surfaces, &mut self.changed);
                (advance, micro::apply(&live.surfaces, &changes, surfaces, changed), track)
            }
            How::Whole | How::Parts => {
                let trace = Trace::new(start.state.position, errand.pull(body), dt);
                let surfaces = &start.surfaces;
                let mut relay =
                    Relay { observer, body: handle, frame, surfaces, began: 0.0, trace };
                errand.in_parts = matches!(how, How::Parts);
                let (surfaces, lies, changed) = (&mut self.surfaces, &self.lies, &mut self.changed);
                let (advance, worn, carrier) =
                    live.carry(body, surfaces, lies, &errand, &mut relay, changed);
                moved = free.zip(carrier);
                let track = relay.trace.finish().map(|extent| extent.grown(course.radius()));
                (advance?, worn, track)
            }
        };
        let end = body.state;
        shadow::check(&end, advance.time)?;
        if let Some((_, end)) = &moved {
            shadow::check(end, advance.time)?;
        }
        self.integrated.push(Integrated { body: handle, end, frame });
        if let Some(((free, extent), end)) = moved {
            self.integrated.push(Integrated { body: free, end, frame });
            self.current.carried.push((free, extent));
        }
        self.obstacles.settle(handle, &track.placed_by(&frame));
        self.book_micro(handle, &advance, &worn, &frame, until);
        Ok(())
    }

    /// Books what Micro did to a body.
    fn book_micro(
        &mut self,
        handle: RigidBodyHandle,
        advance: &Advance,
        worn: &[(SurfaceId, f64)],
        frame: &Isometry3<f64>,
        until: Until,
    ) {
        let tracked = Tracked::slot(&mut self.bodies, handle);
        let touches = tracked.live.as_ref().is_some_and(|live| live.encounter.in_contact());
        let (impulse, contact_time) = (frame * advance.impulse, advance.contact_time);
        tracked.book(&Booking { impulse, contact_time, touches }, worn, &mut self.events);
        self.counters.add(advance);
        if advance.exited && until == Until::FirstExit {
            self.current.dt = advance.time;
            self.current.exited = Some(handle);
            self.obstacles.forget_times();
        }
        // What follows an exit is another encounter, with a first exit of its own.
        if advance.exited && !touches {
            self.closed += tracked.end(&mut self.events);
        }
        tracked.taken_by_micro(&mut self.surfaces, &mut self.closed, &mut self.events);
    }
}
