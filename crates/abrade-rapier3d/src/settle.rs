//! After Rapier's step: what the bodies that it kept in hand bore, and what that wears.

use abrade::PhysicsError;
use rapier::dynamics::RigidBodyHandle;

use crate::booking::Booking;
use crate::event::{Refusal, WearEvent};
use crate::held::{self, Held};
use crate::lockstep::{Lost, Share, gather};
use crate::observer::WearObserver;
use crate::quasi_static::{self, Pressing, Way};
use crate::resolver::{Resolve, Resolver};
use crate::surface::SurfaceId;
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::WearWorld;
use crate::{afloat, scalar, shadow, steer};

/// Growth of the impulse of a contact from one step to the next that is no blow.
const GROWTH: f64 = 1.5;

/// Share of Rapier's geometric slop by which a body may lie in a surface.
const SLACK: f64 = 0.1;
/// Weights above which a load is more than Rapier's contact stands, and the share of its radius
/// that a lighter body may sink.
const HEAVY: f64 = 3.0;
const SUNK: f64 = 0.1;

impl WearWorld {
    /// Resolves every body that Rapier kept in hand.
    pub(crate) fn settle_held(
        &mut self,
        world: &mut WorldView<'_>,
        observer: &mut dyn WearObserver,
    ) {
        let mut held = std::mem::take(&mut self.held);
        for held in &mut held {
            self.measure(held, world);
        }
        let mut done = vec![false; held.len()];
        for at in 0..held.len() {
            if !done[at] && self.wants_lockstep(&held[at]) {
                let members = self.island(at, &held, world);
                held.iter().zip(&mut done).for_each(|(h, d)| *d |= members.contains(&h.body));
            }
        }
        for (held, done) in held.iter().zip(done) {
            if !done {
                self.press(held, world, observer);
            }
        }
        held.clear();
        self.held = held;
    }

    fn wants_lockstep(&self, held: &Held) -> bool {
        match self.settings.resolve {
            Resolve::Lockstep => true,
            Resolve::Auto => held.strikes,
            Resolve::Micro | Resolve::QuasiStatic => false,
        }
    }

    /// Measures what the body's wear contacts bore.
    fn measure(&mut self, held: &mut Held, world: &WorldView<'_>) {
        let Some(rb) = world.bodies.get(held.body) else { return };
        let dt = self.current.dt;
        let tracked = Tracked::slot(&mut self.bodies, held.body);
        let mut borne = Vec::new();
        for &id in &held.surfaces {
            let worn = &self.surfaces[id.0];
            let Some(lie) = self.lies.iter().find(|lie| lie.id == id) else { continue };
            let impulse = held::impulse(rb.colliders(), worn, world.narrow_phase);
            borne.push((id, lie.pose.inverse_transform_vector(&impulse).z.max(0.0) / dt));
        }
        let total: f64 = borne.iter().map(|(_, load)| load).sum();
        let mass = scalar::wide(rb.mass());
        held.strikes |= total * dt > mass * held.rest_speed + GROWTH * held.bore * dt;
        tracked.borne = borne;
    }

    /// Takes the island around a body in lockstep; returns its members, none if it could not.
    fn island(
        &mut self,
        at: usize,
        held: &[Held],
        world: &mut WorldView<'_>,
    ) -> Vec<RigidBodyHandle> {
        let first = &held[at];
        let rest_speed = match self.settings.resolve {
            Resolve::Lockstep => 0.0,
            _ => first.rest_speed,
        };
        let members = gather(first.body, world, &self.neighbours).map_err(Lost::from);
        let result = members.and_then(|members| {
            let bodies = members.bodies.clone();
            self.lockstep(members, held, world, rest_speed).map(|done| (bodies, done))
        });
        match result {
            Ok((bodies, (shares, done))) => {
                self.counters.steps += done.steps;
                for share in shares {
                    let reason = held.iter().find(|h| h.body == share.body).map(|h| h.reason);
                    self.book_share(share, reason);
                }
                bodies
            }
            Err(Lost::Refused(reason)) => {
                self.events.push(WearEvent::NoIsland { body: first.body, reason });
                Vec::new()
            }
            Err(Lost::Failed(body, error)) if self.can_go_on(&error) => {
                let reason = Refusal::Stiff;
                self.events.push(WearEvent::NoIsland { body, reason });
                Vec::new()
            }
            Err(Lost::Failed(body, error)) => {
                let surface = first.surfaces[0];
                self.fail(body, surface, error);
                vec![first.body]
            }
        }
    }

    /// True for an error of an island that another resolver need not share.
    fn can_go_on(&self, error: &PhysicsError) -> bool {
        let stiff = matches!(
            error,
            PhysicsError::StepVanished { .. }
                | PhysicsError::TooManySteps { .. }
                | PhysicsError::StartsInside { .. }
        );
        stiff && self.settings.resolve == Resolve::Auto
    }

    fn book_share(&mut self, share: Share, reason: Option<Refusal>) {
        let Share { body, impulse, contact_time, touches, worn } = share;
        self.counters.lockstep += 1;
        if let Some(reason) = reason {
            *self.reasons.entry((Resolver::Lockstep, reason.name().into())).or_default() += 1;
        }
        let tracked = Tracked::slot(&mut self.bodies, body);
        tracked.let_go(&mut self.surfaces, &mut self.closed);
        tracked.hand_to(Resolver::Lockstep, reason, &mut self.events);
        let booking = Booking { impulse, contact_time, touches };
        tracked.book(&booking, &worn, &mut self.events);
    }

    /// QuasiStatic: presses the nodes under the body by what it bore.
    fn press(&mut self, held: &Held, world: &mut WorldView<'_>, observer: &mut dyn WearObserver) {
        self.counters.quasi_static += 1;
        *self.reasons.entry((Resolver::QuasiStatic, held.reason.name().into())).or_default() += 1;
        let tracked = Tracked::slot(&mut self.bodies, held.body);
        tracked.hand_to(Resolver::QuasiStatic, Some(held.reason), &mut self.events);
        tracked.wearer = None;
        let borne = std::mem::take(&mut tracked.borne);
        for &(surface, load) in &borne {
            if let Err(error) = self.press_on(held, surface, load, world, observer) {
                self.fail(held.body, surface, error);
            }
        }
        Tracked::slot(&mut self.bodies, held.body).borne = borne;
        self.keep_afloat(held, world);
    }

    /// Lifts a body to the surface where Rapier let it sink.
    fn keep_afloat(&mut self, held: &Held, world: &mut WorldView<'_>) {
        let Some(rb) = world.bodies.get(held.body) else { return };
        let tracked = Tracked::slot(&mut self.bodies, held.body);
        let load: f64 = tracked.borne.iter().map(|(_, load)| load).sum();
        let weight = scalar::wide(rb.mass()) * held.rest_speed / self.current.dt;
        // What a body's own weight makes it sink is Rapier's affair: a lift would keep it awake.
        let slack = match load > HEAVY * weight {
            true => SLACK * scalar::wide(world.parameters.allowed_linear_error()),
            false => SUNK * tracked.radius,
        };
        for id in &held.surfaces {
            let tracked = Tracked::slot(&mut self.bodies, held.body);
            let lie = self.lies.iter().find(|lie| lie.id == *id);
            // Asking for it mutably would keep the body awake.
            let (Some(rb), Some(lie)) = (world.bodies.get(held.body), lie) else { continue };
            let Some(body) = tracked.body() else { continue };
            let mut state = shadow::read(rb, tracked.shadow.as_ref(), &lie.pose);
            let depth = afloat::depth(body, &state, &self.surfaces[id.0]);
            let before =
                self.before.of(held.body).map_or(0.0, |b| b.seen_from(&lie.pose).position.z);
            let sunk = (before - state.position.z).max(0.0) + body.shape.bounding_radius();
            if depth > slack
                && depth < sunk
                && let Some(rb) = world.bodies.get_mut(held.body)
            {
                state.position.z += depth;
                tracked.shadow = Some(shadow::write(rb, lie.pose, state));
                steer::carry_colliders(rb, world.colliders);
            }
        }
    }

    fn press_on(
        &mut self,
        held: &Held,
        surface: SurfaceId,
        load: f64,
        world: &WorldView<'_>,
        observer: &mut dyn WearObserver,
    ) -> Result<(), PhysicsError> {
        let dt = self.current.dt;
        let tracked = Tracked::slot(&mut self.bodies, held.body);
        let Some(rb) = world.bodies.get(held.body) else { return Ok(()) };
        let Some(lie) = self.lies.iter().find(|lie| lie.id == surface) else { return Ok(()) };
        let frame = lie.pose;
        let worn = &self.surfaces[surface.0];
        let at = tracked.pressing.iter().position(|p| p.surface == surface);
        if load == 0.0 {
            if let Some(at) = at {
                let mut pressing = tracked.pressing.swap_remove(at);
                self.closed += pressing.end(&mut self.surfaces);
            }
            tracked.book(&Booking::default(), &[], &mut self.events);
            return Ok(());
        }
        let area = worn.surface.nodes().rest_area[0];
        if at.is_none() && quasi_static::holds(worn.surface.laws(), area, load) {
            return Ok(());
        }
        let end = shadow::read(rb, tracked.shadow.as_ref(), &frame);
        let at = match at {
            Some(at) => at,
            None => {
                let (Some(before), Some(body)) = (self.before.of(held.body), tracked.body()) else {
                    return Ok(());
                };
                let start = before.seen_from(&frame);
                let settings = self.settings.encounter();
                let pressing = Pressing::new(body, start, surface, worn, settings)?;
                tracked.pressing.push(pressing);
                tracked.pressing.len() - 1
            }
        };
        let displaced = worn.surface.worn().displaced();
        let pressing = &mut tracked.pressing[at];
        let (surfaces, lies) = (&mut self.surfaces, &self.lies);
        let done =
            pressing.advance(held.body, surfaces, lies, &Way { end: &end, load, dt }, observer)?;
        let Some(done) = done else { return Ok(()) };
        tracked.friction = done.friction;
        self.counters.steps += done.advance.steps;
        self.counters.node_evaluations += done.advance.node_evaluations;
        let gained = self.surfaces[surface.0].surface.worn().displaced() - displaced;
        let impulse = frame * done.advance.impulse;
        let booking = Booking { impulse, contact_time: dt, touches: true };
        tracked.book(&booking, &[(surface, gained)], &mut self.events);
        Ok(())
    }
}
