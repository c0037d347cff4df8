//! One step of the embedder's world: choose, ahead, resolve, steer, engine, settle,
//! collide, renew.

use abrade::Until;
use nalgebra::{Isometry3, Vector3};
use rapier::dynamics::{IntegrationParameters, RigidBody, RigidBodyHandle, RigidBodySet};
use rapier::geometry::ColliderSet;
use rapier::pipeline::{EventHandler, PhysicsHooks, PhysicsWorld};

use crate::error::WearError;
use crate::gate::{self, Course, Lie};
use crate::glance::Span;
use crate::guard::WearGuard;
use crate::observer::WearObserver;
use crate::resolver::Resolve;
use crate::settings::StepReport;
use crate::surface::SurfaceId;
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::wall::Walker;
use crate::world::{Current, WearWorld};
use crate::{derive, free, scalar, steer};

impl WearWorld {
    /// The whole step of `world`: as `world.step_with_events(hooks, events)`, with wear.
    ///
    /// # Errors
    /// A contact left the reach of the model. The step was taken all the same, with that body
    /// left to Rapier, or stopped in its crater, so that an embedder may go on.
    pub fn step(
        &mut self,
        world: &mut PhysicsWorld,
        hooks: &dyn PhysicsHooks,
        events: &dyn EventHandler,
    ) -> Result<StepReport, WearError> {
        self.step_observed(world, hooks, events, &mut ())
    }

    /// As [`WearWorld::step`], showing contact steps to `observer`: see [`WearObserver`].
    ///
    /// # Errors
    /// As [`WearWorld::step`].
    pub fn step_observed(
        &mut self,
        world: &mut PhysicsWorld,
        hooks: &dyn PhysicsHooks,
        events: &dyn EventHandler,
        observer: &mut dyn WearObserver,
    ) -> Result<StepReport, WearError> {
        let asked = world.integration_parameters.dt;
        let guard = self.begin_step_observed(WorldView::of(world), hooks, observer);
        world.integration_parameters.dt = scalar::narrow(guard.dt());
        world.step_with_events(&guard, events);
        world.integration_parameters.dt = asked;
        self.end_step_observed(WorldView::of(world), observer)
    }

    /// Chooses, resolves and steers. The guard goes into Rapier's step, which must be by
    /// [`WearGuard::dt`], and [`WearWorld::end_step`] must follow.
    pub fn begin_step<'a>(
        &'a mut self,
        world: WorldView<'_>,
        hooks: &'a dyn PhysicsHooks,
    ) -> WearGuard<'a> {
        self.begin_step_observed(world, hooks, &mut ())
    }

    /// As [`WearWorld::begin_step`], showing contact steps to `observer`: see [`WearObserver`].
    pub fn begin_step_observed<'a>(
        &'a mut self,
        mut world: WorldView<'_>,
        hooks: &'a dyn PhysicsHooks,
        observer: &mut dyn WearObserver,
    ) -> WearGuard<'a> {
        self.open(world.parameters);
        let gravity = scalar::vector(world.gravity);
        if !self.surfaces.is_empty() && self.current.dt > 0.0 {
            world.join_new_articulations();
            self.choose(&mut world, &gravity);
            self.look_at_tools(&mut world);
            let walkers = self.walkers(&world);
            for Walker { reach, .. } in &walkers {
                let joined = self.current.reach.map_or(*reach, |others| others.joined(reach));
                self.current.reach = Some(joined);
            }
            self.collect_obstacles(&world);
            let single = self.single_registered(world.bodies);
            self.candidates
                .sort_by_key(|&handle| (Some(handle) != single, handle.into_raw_parts()));
            // A first exit makes the step shorter for whoever follows.
            let may_end = single.is_some() && self.settings.until == Until::FirstExit;
            if self.candidates.len() > 1 && !may_end && !observer.watches() {
                self.run_ahead(&world);
            }
            for at in 0..self.candidates.len() {
                let until = match Some(self.candidates[at]) == single {
                    true => self.settings.until,
                    false => Until::Duration,
                };
                self.resolve(self.candidates[at], &world, until, observer);
            }
            self.lead_tools(&world, observer);
            self.strike_walls(&walkers, &world);
            let may_wake = !self.sleepers.is_empty();
            let is_crowded = !self.current.crowded.is_empty();
            if may_wake || is_crowded || !self.held.is_empty() {
                self.before.note(&world, &self.bodies, &self.held, may_wake || is_crowded);
            }
            self.steer(&mut world, &gravity);
            self.drop_driven(world.bodies);
            if !self.driven.is_empty() {
                self.carry_driven(world.bodies, world.colliders, observer);
            }
        }
        let (taken, surfaces) = (&self.taken, &self.surfaces);
        WearGuard { taken, surfaces, user: hooks, dt: self.current.dt }
    }

    /// Sets velocities so that Rapier lands where the integration ended, and takes the pairs.
    fn steer(&mut self, world: &mut WorldView<'_>, gravity: &Vector3<f64>) {
        for integrated in self.integrated.drain(..) {
            let Some(rb) = world.bodies.get_mut(integrated.body) else { continue };
            let dt = self.current.dt;
            self.taken.add_body(integrated.body);
            if rb.is_sleeping() {
                rb.wake_up(true);
            }
            self.steered.push(steer::steer(integrated, rb, gravity, world.parameters, dt));
        }
    }

    /// Restores what steering changed, after Rapier's step, and wears what the bodies that it kept
    /// in hand bore. The view must be of the same world as before.
    ///
    /// # Errors
    /// A contact left the reach of the model in this step; its body was left to Rapier, or stopped
    /// in its crater. The step is over all the same: [`WearWorld::last_step`] tells by how much the world
    /// went on.
    pub fn end_step(&mut self, world: WorldView<'_>) -> Result<StepReport, WearError> {
        self.end_step_observed(world, &mut ())
    }

    /// As [`WearWorld::end_step`], showing contact steps to `observer`: see [`WearObserver`].
    ///
    /// # Errors
    /// As [`WearWorld::end_step`].
    pub fn end_step_observed(
        &mut self,
        mut world: WorldView<'_>,
        observer: &mut dyn WearObserver,
    ) -> Result<StepReport, WearError> {
        for steered in self.steered.drain(..) {
            let body = steered.integrated.body;
            let tracked = Tracked::slot(&mut self.bodies, body);
            let Some(rb) = world.bodies.get_mut(body) else { continue };
            tracked.shadow = steered.settle(rb);
            steer::carry_colliders(rb, world.colliders);
        }
        self.settle_tools(&mut world);
        self.hold_the_woken(&world);
        if !self.held.is_empty() {
            self.settle_held(&mut world, observer);
        }
        self.collide(&world);
        self.renew_solids(&mut world);
        let mut proxies = self.surfaces.iter().map(|worn| worn.proxy);
        let proxy = proxies.find(|&proxy| world.colliders.contains(proxy));
        self.glances.seal(proxy, world.colliders);
        let Current { dt, exited, failure, .. } = std::mem::take(&mut self.current);
        self.last_step = StepReport { dt, exited };
        failure.map_or(Ok(self.last_step), Err)
    }

    fn open(&mut self, parameters: &IntegrationParameters) {
        let dt = scalar::wide(parameters.dt);
        // Rapier brakes a body that its next substep would bring into contact.
        let sight = dt * (1.0 + 1.0 / parameters.num_solver_iterations.max(1) as f64);
        let contacts = scalar::wide(parameters.prediction_distance());
        self.current = Current { dt, sight, contacts, ..Current::default() };
        self.events.clear();
        self.integrated.clear();
        self.steered.clear();
        self.held.clear();
        self.sleepers.clear();
        for handle in self.candidates.drain(..) {
            // Another body may have taken its place since.
            if let Some(Some(tracked)) = self.bodies.get_mut(handle.into_raw_parts().0 as usize) {
                (tracked.course, tracked.ahead) = (None, None);
            }
        }
        self.taken.clear();
        self.obstacles.clear();
        self.neighbours.clear();
        self.changed.clear();
    }

    /// What the bodies near a surface may run into, each other included.
    fn collect_obstacles(&mut self, world: &WorldView<'_>) {
        let Some(reach) = self.current.reach else { return };
        let (surfaces, bodies) = (&self.surfaces, &self.bodies);
        let is_proxy = |collider| surfaces.iter().any(|worn| worn.proxy == collider);
        let course = |body: RigidBodyHandle| {
            let slot = bodies.get(body.into_raw_parts().0 as usize)?.as_ref()?;
            slot.course.as_deref().filter(|_| slot.handle == body)
        };
        self.obstacles.collect(world, self.current.dt, &reach, is_proxy, course);
    }

    /// The one body whose first exit may end a step.
    fn single_registered(&self, bodies: &RigidBodySet) -> Option<RigidBodyHandle> {
        let mut registered = self.registered.iter().filter(|&&handle| bodies.contains(handle));
        match (registered.next(), registered.next()) {
            (Some(&handle), None) => Some(handle),
            _ => None,
        }
    }

    /// Finds the bodies near a surface; ends encounters of those that are not.
    fn choose(&mut self, world: &mut WorldView<'_>, gravity: &Vector3<f64>) {
        self.drop_gone(world.bodies);
        let times = [self.current.dt, self.current.sight];
        gate::lie(&self.surfaces, world, &self.bodies, times, &mut self.lies);
        let mut picked = std::mem::take(&mut self.picked);
        let Current { sight, contacts, .. } = self.current;
        let span = Span { dt: sight, gravity: *gravity, contacts };
        self.glances.pick(world, &self.bodies, &self.lies, span, &mut picked);
        for &handle in &picked {
            let Some(rb) = world.bodies.get(handle) else { continue };
            if gate::may_wake(rb) {
                let struck = self.look_at_sleeper(handle, rb, world.colliders, gravity);
                if let Some(rb) = world.bodies.get_mut(handle).filter(|_| struck) {
                    rb.wake_up(true);
                }
            }
            let Some(rb) = world.bodies.get(handle) else { continue };
            if !gate::takes_part(rb) {
                continue;
            }
            self.counters.looked += 1;
            if Tracked::slot(&mut self.bodies, handle).is_stale(rb, world.colliders)
                && let Some(rb) = world.bodies.get_mut(handle)
            {
                // Colliders and extra masses that are new count from Rapier's next step on.
                rb.recompute_mass_properties_from_colliders(world.colliders);
                let tracked = Tracked::slot(&mut self.bodies, handle);
                tracked.refresh(rb, world.colliders);
                tracked.leave(&mut self.surfaces, &mut self.closed, &mut self.events);
            }
            let Some(rb) = world.bodies.get(handle) else { continue };
            self.look_at(handle, rb, world, gravity);
            self.glances.keep(handle, rb, Tracked::slot(&mut self.bodies, handle));
        }
        self.picked = picked;
    }

    /// Takes note of a body that sleeps on a surface: something may wake it in the step. True for one
    /// that a surface on the move comes near.
    fn look_at_sleeper(
        &mut self,
        handle: RigidBodyHandle,
        rb: &RigidBody,
        colliders: &ColliderSet,
        gravity: &Vector3<f64>,
    ) -> bool {
        let surfaces = &self.surfaces;
        let tracked = Tracked::slot(&mut self.bodies, handle);
        let course = Course::of(rb, tracked, gravity);
        let Current { sight, contacts, .. } = self.current;
        course.near(&self.lies, surfaces, [sight, contacts], &mut tracked.near);
        tracked.near.retain(|id| gate::feels(rb, &surfaces[id.0], colliders));
        let may_hold = self.settings.resolve != Resolve::Micro
            && tracked.near.iter().all(|id| gate::can_hold(&self.lies, surfaces, *id));
        if may_hold && !tracked.near.is_empty() && tracked.derive(rb, colliders).is_ok() {
            self.sleepers.push(handle);
        }
        let lead = |id: &SurfaceId| Lie::find(&self.lies, *id)?.lead;
        tracked.near.iter().filter_map(lead).any(|lead| lead.awake)
    }

    /// Makes a body a candidate if it comes near a surface, else ends its encounter.
    fn look_at(
        &mut self,
        handle: RigidBodyHandle,
        rb: &RigidBody,
        world: &WorldView<'_>,
        gravity: &Vector3<f64>,
    ) {
        let (bodies, colliders) = (&*world.bodies, &*world.colliders);
        let dt = self.current.dt;
        let tracked = Tracked::slot(&mut self.bodies, handle);
        if tracked.drop_lost_shadow(rb) {
            tracked.end(&mut self.surfaces, &mut self.closed, &mut self.events);
        }
        let surfaces = &self.surfaces;
        let mut course = Course::of(rb, tracked, gravity);
        let Current { sight, contacts, .. } = self.current;
        course.near(&self.lies, surfaces, [sight, contacts], &mut tracked.near);
        tracked.near.retain(|id| gate::feels(rb, &surfaces[id.0], colliders));
        course.surfaces_speed = gate::top_speed(&self.lies, &tracked.near);
        let Some(&first) = tracked.near.first() else {
            return tracked.leave(&mut self.surfaces, &mut self.closed, &mut self.events);
        };
        let Some(lie) = Lie::find(&self.lies, first) else { return };
        let track = course.track_before(&lie.pose, &gate::floor(lie, &surfaces[first.0]), dt);
        tracked.course = Some(Box::new(track.placed_by(&lie.pose)));
        let mut reach = course.reach(&Isometry3::identity(), dt);
        if let Some((lead, free)) = free::lead(&self.lies, &tracked.near) {
            let rb = bodies.get(free.body);
            let radius = rb.map_or(0.0, |rb| derive::radius(rb, colliders));
            reach = reach.joined(&free::reach(&lead, radius, &course, dt));
        }
        let reach = self.current.reach.map_or(reach, |others| others.joined(&reach));
        self.current.reach = Some(reach);
        self.candidates.push(handle);
    }
}
