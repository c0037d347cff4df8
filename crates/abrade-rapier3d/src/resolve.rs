//! Resolving one body near a wear surface: through the gate and the Micro resolver, or left to
//! Rapier with a reason. Other resolvers take their place here, between the two.

use abrade::{PhysicsError, Until};
use nalgebra::Vector3;
use rapier::dynamics::{RigidBody, RigidBodyHandle};

use crate::approach::strike_speed;
use crate::booking::{Booking, Contact};
use crate::error::WearError;
use crate::event::{Refusal, WearEvent};
use crate::gate::{self, Course, Way};
use crate::guard::Grip;
use crate::held::Held;
use crate::lockstep::gather;
use crate::micro::Errand;
use crate::observer::{Relay, WearObserver};
use crate::path::Extent;
use crate::resolver::Resolve;
use crate::surface::{SurfaceId, WornCollider};
use crate::tracked::{Known, Live, Tracked};
use crate::view::WorldView;
use crate::world::{Integrated, WearWorld};
use crate::{quasi_static, scalar, shadow};

/// A blow comes down faster than rest by this factor.
const STRIKE: f64 = 1.5;

/// Share of the rest speed below which a body does not move along.
const CREEP: f64 = 0.05;

/// Why a body was left to Rapier.
enum Left {
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
        let exact = tracked.shadow.is_some();
        let Err(left) = self.carry(handle, surface, world, until, observer) else { return };
        let tracked = Tracked::slot(&mut self.bodies, handle);
        self.closed += tracked.end(&mut self.events);
        match left {
            // Rapier's contacts overlap: only a state that was given exactly is an error.
            Left::Failed(PhysicsError::StartsInside { .. } | PhysicsError::StepVanished { .. })
                if !exact =>
            {
                self.hold(handle, Refusal::Inside, world);
            }
            Left::Refused(reason)
                if self.settings.resolve == Resolve::Micro || reason.is_final() =>
            {
                self.refuse(handle, surface, reason);
            }
            Left::Refused(reason) => self.hold(handle, reason, world),
            Left::Failed(error) => self.fail(handle, surface, error),
        }
    }

    /// Leaves a body in Rapier's hands until what it bears is known.
    fn hold(&mut self, body: RigidBodyHandle, reason: Refusal, world: &WorldView<'_>) {
        let tracked = Tracked::slot(&mut self.bodies, body);
        let Some(rb) = world.bodies.get(body) else { return };
        if let Err(reason) = tracked.derive(rb, world.colliders) {
            let surface = tracked.near[0];
            return self.refuse(body, surface, reason);
        }
        let gravity = scalar::vector(world.gravity);
        let rest_speed = gravity.norm() * scalar::wide(rb.gravity_scale()).abs() * self.current.dt;
        let surfaces = tracked.near.clone();
        let strike = self.strike(body, rb, &surfaces, &gravity);
        let limit = STRIKE * rest_speed;
        let strikes =
            strike.is_some_and(|speed| speed > limit) || self.is_struck(body, world, limit);
        let tracked = Tracked::slot(&mut self.bodies, body);
        let first = self.surfaces[surfaces[0].0].surface.laws().material.friction;
        let friction = tracked.friction.max(first);
        self.taken.add_held(body, Grip { friction, lies: !strikes });
        let bore = tracked.borne.iter().map(|(_, load)| load).sum();
        self.held.push(Held { body, surfaces, reason, strikes, rest_speed, bore });
    }

    /// True when something comes to meet the body, or what hangs together with it, faster than
    /// `limit` [m/s].
    fn is_struck(&self, body: RigidBodyHandle, world: &WorldView<'_>, limit: f64) -> bool {
        let (obstacles, dt) = (&self.obstacles, self.current.dt);
        match gather(body, world, obstacles) {
            Ok(members) => members.bodies.iter().any(|m| obstacles.blow(*m, world, dt, limit)),
            Err(_) => obstacles.blow(body, world, dt, limit),
        }
    }

    /// Speed with which the body comes down on a surface in this step, if it does [m/s].
    fn strike(
        &self,
        handle: RigidBodyHandle,
        rb: &RigidBody,
        surfaces: &[SurfaceId],
        gravity: &Vector3<f64>,
    ) -> Option<f64> {
        let tracked = Tracked::find(&self.bodies, handle)?;
        let body = tracked.body()?;
        let course = Course::of(rb, tracked, gravity);
        let on = |id: &SurfaceId| {
            let lie = self.lies.iter().find(|lie| lie.id == *id)?;
            let pull = -lie.pose.inverse_transform_vector(&course.acceleration).z;
            let level = self.surfaces[id.0].bounds.high.z;
            strike_speed(body, &course.state, &lie.pose, level, pull.max(0.0), self.current.dt)
        };
        surfaces.iter().filter_map(on).reduce(f64::max)
    }

    fn refuse(&mut self, body: RigidBodyHandle, surface: SurfaceId, reason: Refusal) {
        self.counters.refused += 1;
        self.events.push(WearEvent::NotResolved { body, surface, reason });
    }

    pub(crate) fn fail(&mut self, body: RigidBodyHandle, surface: SurfaceId, error: PhysicsError) {
        self.counters.refused += 1;
        let source = error.clone();
        self.events.push(WearEvent::Failed { body, surface, error });
        self.current.failure.get_or_insert(WearError::Physics { body, surface, source });
    }

    /// True for a body that comes down on its surfaces no faster than what pulls it there makes it
    /// in a step: it would be back on them within the step.
    fn rests(&self, handle: RigidBodyHandle, rb: &RigidBody, gravity: &Vector3<f64>) -> bool {
        let Some(tracked) = Tracked::find(&self.bodies, handle) else { return false };
        if tracked.is_in_blow() {
            return false;
        }
        let course = Course::of(rb, tracked, gravity);
        let pull = |id: &SurfaceId| {
            let lie = self.lies.iter().find(|lie| lie.id == *id)?;
            Some(-lie.pose.inverse_transform_vector(&course.acceleration).z)
        };
        let pull = tracked.near.iter().filter_map(pull).fold(0.0, f64::max);
        let rest_speed = pull * self.current.dt;
        let strike = self.strike(handle, rb, &tracked.near, gravity);
        if strike.is_none_or(|speed| speed >= rest_speed) {
            return false;
        }
        // What moves along and ploughs is braked by it, which Rapier's contact would not do.
        let load = pull * scalar::wide(rb.mass());
        let firm = |id: &SurfaceId| {
            let surface = &self.surfaces[id.0].surface;
            quasi_static::holds(surface.laws(), surface.nodes().rest_area[0], load)
        };
        let speed = course.state.velocity.norm() + course.state.spin.norm() * tracked.radius;
        speed < CREEP * rest_speed || tracked.near.iter().all(firm)
    }

    /// Gate and Micro.
    fn carry(
        &mut self,
        handle: RigidBodyHandle,
        surface: SurfaceId,
        world: &WorldView<'_>,
        until: Until,
        observer: &mut dyn WearObserver,
    ) -> Result<(), Left> {
        let dt = self.current.dt;
        let tracked = Tracked::slot(&mut self.bodies, handle);
        let Some(rb) = world.bodies.get(handle) else { return Ok(()) };
        if let Some(refusal) = gate::bound(world, rb, handle, &tracked.near, &self.surfaces) {
            return Err(refusal.into());
        }
        tracked.derive(rb, world.colliders)?;
        let resolve = self.settings.resolve;
        if matches!(resolve, Resolve::QuasiStatic | Resolve::Lockstep) {
            return Err(Refusal::Asked.into());
        }
        if resolve == Resolve::Auto && self.rests(handle, rb, &scalar::vector(world.gravity)) {
            return Err(Refusal::Resting.into());
        }
        let tracked = Tracked::slot(&mut self.bodies, handle);
        // An encounter goes on in the frame it began in.
        if !tracked.knows_surfaces(&self.lies) {
            self.closed += tracked.end(&mut self.events);
        }
        let anchor = tracked.live.as_ref().map_or(surface, |live| live.surfaces[0]);
        let Some(lie) = self.lies.iter().find(|lie| lie.id == anchor) else { return Ok(()) };
        let (frame, bounds) = (lie.pose, self.surfaces[anchor.0].bounds);
        let (colliders, obstacles) = (&*world.colliders, &self.obstacles);
        let way = Way { body: handle, rb, colliders, obstacles, frame, bounds };
        let gravity = scalar::vector(world.gravity);
        if let Some(refusal) = way.on_course(&Course::of(rb, tracked, &gravity), dt) {
            return Err(refusal.into());
        }
        let state = shadow::read(rb, tracked.shadow.as_ref(), &frame);
        let Known::Ready(body) = &mut tracked.known else { return Ok(()) };
        body.state = state;
        if tracked.live.is_none() {
            let settings = self.settings.encounter();
            let mut live = Live::new(body, &tracked.near, &self.surfaces, settings)?;
            if tracked.shadow.is_none() {
                live.lift(body, &mut self.surfaces, &self.lies, &frame);
            }
            tracked.live = Some(live);
        }
        let Some(live) = &mut tracked.live else { return Ok(()) };
        let seen = Extent { low: state.position, high: state.position };
        let loads = gate::loads(rb, &gravity, &frame);
        let errand = Errand { way, loads, dt, until };
        let met = live.surfaces.clone();
        let mut relay = Relay { observer, body: handle, frame, surfaces: met, began: 0.0, seen };
        let before: Vec<f64> = displaced(live, &self.surfaces).collect();
        let advance = live.carry(body, &mut self.surfaces, &self.lies, &errand, &mut relay)?;
        let after = displaced(live, &self.surfaces);
        let gained = after.zip(before).map(|(after, before)| after - before);
        let worn: Vec<_> = live.surfaces.iter().copied().zip(gained).collect();
        let booking = Booking {
            impulse: frame * advance.impulse,
            contact_time: advance.contact_time,
            touches: live.encounter.in_contact(),
        };
        Contact::book(&mut tracked.contact, handle, &booking, &worn, &mut self.events);
        self.counters.add(&advance);
        self.integrated.push(Integrated { body: handle, end: body.state, frame });
        if advance.exited && until == Until::FirstExit {
            self.current.dt = advance.time;
            self.current.exited = Some(handle);
        }
        let stayed = relay.seen.grown(body.shape.bounding_radius()).placed_by(&frame);
        self.obstacles.settle(handle, stayed);
        // What follows an exit is another encounter, with a first exit of its own.
        if advance.exited && !live.encounter.in_contact() {
            self.closed += tracked.end(&mut self.events);
        }
        tracked.taken_by_micro(&mut self.surfaces, &self.lies, &mut self.closed, &mut self.events);
        Ok(())
    }
}

/// Volume displaced so far on each surface of the encounter [m3].
fn displaced<'a>(live: &'a Live, surfaces: &'a [WornCollider]) -> impl Iterator<Item = f64> + 'a {
    live.surfaces.iter().map(|id| surfaces[id.0].displaced())
}
