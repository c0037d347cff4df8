//! Resolving one body near a wear surface: through the gate and the Micro resolver, or left to
//! Rapier with a reason, until the other resolvers know what it bore.

use abrade::{PhysicsError, State, Until};
use nalgebra::Isometry3;
use rapier::dynamics::{RigidBodyHandle, RigidBodySet};

use crate::booking::Booking;
use crate::error::WearError;
use crate::event::{Refusal, WearEvent};
use crate::gate;
use crate::micro::{Carried, Room};
use crate::observer::WearObserver;
use crate::resolver::Resolve;
use crate::shadow;
use crate::start::{How, Start};
use crate::surface::SurfaceId;
use crate::tracked::{Known, Tracked};
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

impl Left {
    /// Why another resolver may have the body; the error, where none may.
    pub(crate) fn reason(self, resolve: Resolve) -> Result<Refusal, PhysicsError> {
        match self {
            Self::Refused(reason) => Ok(reason),
            Self::Failed(error) => match Refusal::of(&error, resolve) {
                Some(reason) => Ok(reason),
                None => Err(error),
            },
        }
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
        tracked.end(&mut self.surfaces, &mut self.closed, &mut self.events);
        let resolve = self.settings.resolve;
        let reason = match left {
            // Rapier's contacts overlap: only a state that the embedder gave exactly is an error.
            Left::Failed(error)
                if is_placed && Refusal::of(&error, resolve) == Some(Refusal::Inside) =>
            {
                Err(error)
            }
            left => left.reason(resolve),
        };
        match reason {
            Ok(reason) => self.leave(handle, surface, reason, world),
            Err(error) => self.fail(handle, surface, error),
        }
    }

    /// Forgets bodies that are gone, and ends their contacts.
    pub(crate) fn drop_gone(&mut self, bodies: &RigidBodySet) {
        self.registered.retain(|handle| bodies.contains(*handle));
        let is_gone = |tracked: &Tracked| tracked.is_open() && !bodies.contains(tracked.handle);
        for slot in &mut self.bodies {
            let Some(mut gone) = slot.take_if(|tracked| is_gone(tracked)) else { continue };
            gone.end_against(&mut self.surfaces, &mut self.closed, &mut self.events);
            gone.leave(&mut self.surfaces, &mut self.closed, &mut self.events);
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
        let index = handle.into_raw_parts().0 as usize;
        // Taken out, and put back.
        let Some(mut tracked) = self.bodies[index].take() else { return Ok(()) };
        let carried = self.carry_alone(&mut tracked, world, until, observer);
        self.bodies[index] = Some(tracked);
        if carried.is_err() {
            self.obstacles.blur(handle);
        }
        carried
    }

    fn carry_alone(
        &mut self,
        tracked: &mut Tracked,
        world: &WorldView<'_>,
        until: Until,
        observer: &mut dyn WearObserver,
    ) -> Result<(), Left> {
        let ahead = tracked.ahead.take();
        let Some(start) = self.scene(world).start(tracked)? else { return Ok(()) };
        // An encounter goes on in the frame it began in.
        if start.is_new {
            tracked.end(&mut self.surfaces, &mut self.closed, &mut self.events);
        }
        let Some(way) = start.way(world, &self.obstacles) else { return Ok(()) };
        let ahead = ahead.filter(|ahead| ahead.holds(&self.changed, &self.surfaces));
        let scene = self.scene(world);
        let mut errand = scene.errand(way, &start, until);
        let how = scene.how(ahead, &start, tracked, &errand, observer.watches())?;
        errand.in_parts = matches!(how, How::Parts);
        scene.open(&start, tracked)?;
        let (Known::Ready(body), Some(live)) = (&mut tracked.known, &mut tracked.live) else {
            return Ok(());
        };
        let room =
            Room { surfaces: &mut self.surfaces, lies: &self.lies, changed: &mut self.changed };
        let carried = match how {
            How::Done(ahead) => Ok(live.take_over(*ahead, body, room)),
            How::Whole | How::Parts => live.carry(body, &start, &errand, room, observer),
        };
        let end = body.state;
        let carried = carried.map_err(|(error, worn)| {
            tracked.book_failed(&worn, &mut self.events);
            error
        })?;
        let landed = self.land(end, &start, &carried);
        landed.inspect_err(|_| tracked.book_failed(&carried.worn, &mut self.events))?;
        self.book_micro(tracked, &carried, &start.frame, until);
        Ok(())
    }

    /// Notes where a body has come to, and the one that its surface is on.
    fn land(&mut self, end: State, start: &Start, carried: &Carried) -> Result<(), PhysicsError> {
        let (body, frame, time) = (start.body, start.frame, carried.advance.time);
        shadow::check(&end, time)?;
        let moved = start.free.zip(carried.carrier);
        if let Some((_, end)) = &moved {
            shadow::check(end, time)?;
        }
        self.integrated.push(Integrated { body, end, frame });
        if let Some(((free, extent), end)) = moved {
            self.integrated.push(Integrated { body: free, end, frame });
            self.current.carried.push((free, extent));
        }
        self.obstacles.settle(body, &carried.track.placed_by(&frame));
        Ok(())
    }

    /// Books what Micro did to a body.
    fn book_micro(
        &mut self,
        tracked: &mut Tracked,
        carried: &Carried,
        frame: &Isometry3<f64>,
        until: Until,
    ) {
        let Carried { advance, worn, .. } = carried;
        let touches = tracked.live.as_ref().is_some_and(|live| live.encounter.in_contact());
        let (impulse, contact_time) = (frame * advance.impulse, advance.contact_time);
        tracked.taken_by_micro(&mut self.surfaces, &mut self.closed, &mut self.events);
        tracked.book(&Booking { impulse, contact_time, touches }, worn, &mut self.events);
        self.counters.add(advance);
        if advance.exited && until == Until::FirstExit {
            self.current.dt = advance.time;
            self.current.exited = Some(tracked.handle);
            self.obstacles.forget_times();
        }
        // What follows an exit is another encounter, with a first exit of its own.
        if advance.exited && !touches {
            tracked.end(&mut self.surfaces, &mut self.closed, &mut self.events);
        }
    }
}
