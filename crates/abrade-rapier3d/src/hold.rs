//! Leaving a body in Rapier's hands through a step, until what it bore is known.

use rapier::dynamics::RigidBodyHandle;

use crate::event::Refusal;
use crate::gate::Course;
use crate::guard::Grip;
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
        self.neighbours.collect(world, dt, |c| self.surfaces.iter().any(|w| w.proxy == c));
        let tracked = Tracked::slot(&mut self.bodies, body);
        let Some(rb) = world.bodies.get(body) else { return };
        if let Err(reason) = tracked.derive(rb, world.colliders) {
            let surface = tracked.near[0];
            return self.refuse(body, surface, reason);
        }
        let gravity = scalar::vector(world.gravity);
        let rest_speed = gravity.norm() * scalar::wide(rb.gravity_scale()).abs() * dt;
        let limit = STRIKE * rest_speed;
        let strikes = tracked.is_in_lockstep_blow()
            || self.comes_down(body, world, limit)
            || self.is_struck(body, world, limit);
        let tracked = Tracked::slot(&mut self.bodies, body);
        let surfaces = tracked.near.clone();
        let first = self.surfaces[surfaces[0].0].surface.laws().material.friction;
        let friction = tracked.friction.max(first);
        self.taken.add_held(body, Grip { friction, lies: !strikes });
        let bore = tracked.borne.iter().map(|(_, load)| load).sum();
        self.held.push(Held { body, surfaces, reason, strikes, rest_speed, bore });
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
    fn is_struck(&self, body: RigidBodyHandle, world: &WorldView<'_>, limit: f64) -> bool {
        let (near, dt) = (&self.neighbours, self.current.dt);
        match gather(body, world, near) {
            Ok(members) => members.bodies.iter().any(|m| near.blow(*m, world, dt, limit)),
            Err(_) => near.blow(body, world, dt, limit),
        }
    }
}
