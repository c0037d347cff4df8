//! Leaving a body in Rapier's hands through a step, until what it bore is known.

use rapier::dynamics::{RigidBody, RigidBodyHandle};

use crate::event::Refusal;
use crate::gate::Course;
use crate::guard::Bearing;
use crate::held::Held;
use crate::lockstep::gather;
use crate::scalar;
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::WearWorld;

/// A blow comes down faster than rest by this factor.
const STRIKE: f64 = 1.5;

impl WearWorld {
    /// Leaves a body in Rapier's hands.
    pub(crate) fn hold(&mut self, body: RigidBodyHandle, reason: Refusal, world: &WorldView<'_>) {
        let dt = self.current.dt;
        let tracked = Tracked::slot(&mut self.bodies, body);
        let Some(rb) = world.bodies.get(body) else { return };
        if let Err(reason) = tracked.derive(rb, world.colliders) {
            let surface = tracked.near[0];
            return self.refuse(body, surface, reason);
        }
        let rest_speed = rest_speed(rb, world, dt);
        let limit = STRIKE * rest_speed;
        let is_alone = reason == Refusal::Resting && self.obstacles.is_alone(body);
        let strikes = tracked.is_in_lockstep_blow()
            || self.comes_down(body, world, limit)
            || !is_alone && self.is_struck(body, world, limit);
        let tracked = Tracked::slot(&mut self.bodies, body);
        let mut surfaces = tracked.near.clone();
        surfaces.sort_unstable();
        let friction = tracked.friction;
        self.taken.add_held(body, Bearing { friction, lies: !strikes });
        let bore = tracked.borne.iter().map(|(_, load)| load).sum();
        self.held.push(Held { body, surfaces, reason, is_alone, strikes, rest_speed, bore });
    }

    /// Collects what could meet what in this step, once.
    pub(crate) fn find_neighbours(&mut self, world: &WorldView<'_>) {
        let surfaces = &self.surfaces;
        let is_proxy = |collider| surfaces.iter().any(|worn| worn.proxy == collider);
        self.neighbours.collect(world, self.current.dt, is_proxy);
    }

    /// Holds the sleepers that Rapier's step has woken: something struck them.
    pub(crate) fn hold_the_woken(&mut self, world: &WorldView<'_>) {
        for &body in &self.sleepers {
            let Some(rb) = world.bodies.get(body).filter(|rb| !rb.is_sleeping()) else { continue };
            let tracked = Tracked::slot(&mut self.bodies, body);
            let mut surfaces = tracked.near.clone();
            surfaces.sort_unstable();
            let bore = tracked.borne.iter().map(|(_, load)| load).sum();
            let rest_speed = rest_speed(rb, world, self.current.dt);
            let (reason, is_alone, strikes) = (Refusal::Resting, false, false);
            self.held.push(Held { body, surfaces, reason, is_alone, strikes, rest_speed, bore });
        }
    }

    /// True when the body comes down on a surface faster than `limit` [m/s].
    fn comes_down(&self, handle: RigidBodyHandle, world: &WorldView<'_>, limit: f64) -> bool {
        let scene = self.scene(world);
        let tracked = Tracked::find(&self.bodies, handle);
        let (Some(tracked), Some(rb)) = (tracked, world.bodies.get(handle)) else { return false };
        let Some(body) = tracked.body() else { return false };
        let course = Course::of(rb, tracked, &scalar::vector(world.gravity));
        scene.strike(body, &course, &tracked.near).is_some_and(|strike| strike.speed > limit)
    }

    /// True when something comes to meet the body, or what hangs together with it, faster than
    /// `limit` [m/s].
    fn is_struck(&mut self, body: RigidBodyHandle, world: &WorldView<'_>, limit: f64) -> bool {
        self.find_neighbours(world);
        let (near, dt) = (&self.neighbours, self.current.dt);
        match gather(body, world, near, |_| true) {
            Ok(members) => members.bodies.iter().any(|m| near.blow(*m, world, dt, limit)),
            Err(_) => near.blow(body, world, dt, limit),
        }
    }
}

/// Speed that gravity gives a body in a step: below it an approach is rest [m/s].
fn rest_speed(rb: &RigidBody, world: &WorldView<'_>, dt: f64) -> f64 {
    scalar::vector(world.gravity).norm() * scalar::wide(rb.gravity_scale()).abs() * dt
}
