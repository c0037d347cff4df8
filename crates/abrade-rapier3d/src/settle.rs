//! After Rapier's step: what the bodies that it kept in hand bore, and what that wears.

use abrade::PhysicsError;
use nalgebra::Vector3;
use rapier::dynamics::RigidBodyHandle;

use crate::booking::Booking;
use crate::event::{Refusal, WearEvent};
use crate::gate::Lie;
use crate::held::{self, Held};
use crate::lockstep::{Lost, Share, gather};
use crate::observer::WearObserver;
use crate::pull::mass;
use crate::quasi_static::{self, Move, Pressing};
use crate::resolver::{Resolve, Resolver};
use crate::surface::SurfaceId;
use crate::tracked::Tracked;
use crate::view::WorldView;
use crate::world::WearWorld;
use crate::{afloat, shadow, steer};

/// Growth of the impulse of a contact from one step to the next that is no blow.
pub(crate) const GROWTH: f64 = 1.5;

/// Share of the height of its centre of mass that a body may sink under a load before it is lifted:
/// a lift that follows every little sinking keeps it awake, and rocks what lies on a face.
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
            if done[at] || !self.wants_lockstep(&held[at]) {
                continue;
            }
            let (members, taken) = self.island(at, &held, world);
            for (held, done) in held.iter_mut().zip(&mut done) {
                if members.contains(&held.body) {
                    // An island that came to nothing is not tried again from another member.
                    (*done, held.strikes) = (taken, false);
                }
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
            let Some(lie) = Lie::find(&self.lies, id) else { continue };
            let impulse = held::impulse(rb.colliders(), worn, world.narrow_phase);
            borne.push((id, lie.pose.inverse_transform_vector(&impulse).z.max(0.0) / dt));
        }
        let total: f64 = borne.iter().map(|(_, load)| load).sum();
        let mass = mass(rb, Some(tracked));
        held.strikes |= total * dt > mass * held.rest_speed + GROWTH * held.bore * dt;
        tracked.borne = borne;
    }

    /// Takes the island around a body in lockstep; returns its members, and whether they are
    /// resolved.
    fn island(
        &mut self,
        at: usize,
        held: &[Held],
        world: &mut WorldView<'_>,
    ) -> (Vec<RigidBodyHandle>, bool) {
        self.find_neighbours(world);
        let first = &held[at];
        let mut bodies = vec![first.body];
        let rest_speed = match self.settings.resolve {
            Resolve::Lockstep => 0.0,
            _ => first.rest_speed,
        };
        let members =
            gather(first.body, world, &self.neighbours, |body| !self.taken.has_body(Some(body)))
                .map_err(Lost::from);
        let result = members.and_then(|members| {
            bodies.clone_from(&members.bodies);
            self.lockstep(members, held, world, rest_speed)
        });
        match result {
            Ok((shares, done)) => {
                self.counters.steps += done.steps;
                for share in shares {
                    let held = held.iter().find(|h| h.body == share.body);
                    self.book_share(share, held.map(|h| h.reason));
                    // One on its springs is where it should be.
                    if let Some(held) = held.filter(|held| self.rests_in_island(held.body)) {
                        self.keep_afloat(held, world);
                    }
                }
                (bodies, true)
            }
            Err(Lost::Refused(reason)) => {
                self.events.push(WearEvent::NoIsland { body: first.body, reason });
                (bodies, false)
            }
            Err(Lost::Failed(body, error)) if self.can_go_on(&error) => {
                let reason = Refusal::Stiff;
                self.events.push(WearEvent::NoIsland { body, reason });
                (bodies, false)
            }
            Err(Lost::Failed(body, error)) => {
                let surface = first.surfaces[0];
                let tracked = Tracked::slot(&mut self.bodies, first.body);
                tracked.end_wearer(&mut self.surfaces, &mut self.closed);
                self.fail(body, surface, error);
                (vec![first.body], true)
            }
        }
    }

    /// True for an error of an island that another resolver need not share.
    fn can_go_on(&self, error: &PhysicsError) -> bool {
        let resolve = self.settings.resolve;
        resolve == Resolve::Auto && Refusal::of(error, resolve).is_some()
    }

    fn book_share(&mut self, share: Share, reason: Option<Refusal>) {
        let Share { body, impulse, contact_time, touches, bears, worn, beyond } = share;
        self.counters.lockstep += 1;
        if let Some(reason) = reason {
            *self.reasons.entry((Resolver::Lockstep, reason.name().into())).or_default() += 1;
        }
        let tracked = Tracked::slot(&mut self.bodies, body);
        tracked.let_go_but(&[], &mut self.surfaces, &mut self.closed);
        tracked.borne.truncate(1);
        tracked.borne.iter_mut().for_each(|(_, load)| *load = bears);
        tracked.hand_to(Resolver::Lockstep, reason, &mut self.events);
        let booking = Booking { impulse, contact_time, touches };
        tracked.book(&booking, &worn, &mut self.events);
        if let (Some(error), Some(&(surface, _))) = (beyond, worn.first()) {
            self.fail(body, surface, error);
        }
    }

    /// QuasiStatic: presses the nodes under the body by what it bore.
    fn press(&mut self, held: &Held, world: &mut WorldView<'_>, observer: &mut dyn WearObserver) {
        self.counters.quasi_static += 1;
        *self.reasons.entry((Resolver::QuasiStatic, held.reason.name().into())).or_default() += 1;
        let tracked = Tracked::slot(&mut self.bodies, held.body);
        tracked.hand_to(Resolver::QuasiStatic, Some(held.reason), &mut self.events);
        tracked.end_wearer(&mut self.surfaces, &mut self.closed);
        tracked.let_go_but(&held.surfaces, &mut self.surfaces, &mut self.closed);
        let borne = std::mem::take(&mut tracked.borne);
        let touches = borne.iter().any(|(_, load)| *load > 0.0);
        let contact_time = if touches { self.current.dt } else { 0.0 };
        let mut booking = Booking { contact_time, touches, ..Booking::default() };
        let mut worn = Vec::new();
        for &(surface, load) in &borne {
            match self.press_on(held, surface, load, world, observer) {
                Ok((impulse, gained)) => {
                    booking.impulse += impulse;
                    worn.push((surface, gained));
                }
                Err((error, gained)) => {
                    worn.push((surface, gained));
                    self.fail(held.body, surface, error);
                }
            }
        }
        let tracked = Tracked::slot(&mut self.bodies, held.body);
        tracked.borne = borne;
        tracked.book(&booking, &worn, &mut self.events);
        self.keep_afloat(held, world);
    }

    /// True for a body that its island has left at rest, on a contact of Rapier's.
    fn rests_in_island(&self, body: RigidBodyHandle) -> bool {
        let tracked = Tracked::find(&self.bodies, body);
        tracked.and_then(|t| t.wearer.as_ref()).is_some_and(|(_, wearer)| wearer.rests())
    }

    /// Lifts a body to the surface where Rapier let it sink.
    fn keep_afloat(&mut self, held: &Held, world: &mut WorldView<'_>) {
        // A link is where its joints put it.
        if world.multibody_joints.rigid_body_link(held.body).is_some() {
            return;
        }
        for id in &held.surfaces {
            let tracked = Tracked::slot(&mut self.bodies, held.body);
            let lie = Lie::find(&self.lies, *id);
            // Asking for it mutably would keep the body awake.
            let (Some(rb), Some(lie)) = (world.bodies.get(held.body), lie) else { continue };
            let Some(body) = tracked.body() else { continue };
            let mut state = shadow::read(rb, tracked.shadow.as_ref(), &lie.pose);
            let depth = afloat::depth(body, &state, &self.surfaces[id.0]);
            let before =
                self.before.of(held.body).map_or(0.0, |b| b.seen_from(&lie.pose).position.z);
            let height = -body.shape.lowest(&state.rotation, &Vector3::z());
            let sunk = (before - state.position.z).max(0.0) + body.shape.bounding_radius();
            if depth > SUNK * height
                && depth < sunk
                && let Some(rb) = world.bodies.get_mut(held.body)
            {
                state.position.z += depth;
                tracked.shadow = Some(shadow::write(rb, lie.pose, state));
                steer::carry_colliders(rb, world.colliders);
            }
        }
    }

    /// Presses a body on one surface; returns the impulse on it, in the world [N s], and the volume
    /// displaced [m3].
    fn press_on(
        &mut self,
        held: &Held,
        surface: SurfaceId,
        load: f64,
        world: &WorldView<'_>,
        observer: &mut dyn WearObserver,
    ) -> Result<(Vector3<f64>, f64), (PhysicsError, f64)> {
        let dt = self.current.dt;
        let tracked = Tracked::slot(&mut self.bodies, held.body);
        let (Some(rb), Some(lie)) = (world.bodies.get(held.body), Lie::find(&self.lies, surface))
        else {
            return Ok((Vector3::zeros(), 0.0));
        };
        let frame = lie.pose;
        let held_up = (frame * Vector3::z() * (load * dt), 0.0);
        let worn = &self.surfaces[surface.0];
        let start = self.before.of(held.body).map(|before| before.seen_from(&frame));
        let goes_on = |p: &Pressing| start.is_some_and(|start| p.is_at(&start, worn));
        let known = tracked.pressing.iter().position(|p| p.surface == surface);
        if let Some(at) = known.filter(|&at| load == 0.0 || !goes_on(&tracked.pressing[at])) {
            let pressing = tracked.pressing.swap_remove(at);
            tracked.end_pressing(pressing, &mut self.surfaces, &mut self.closed);
            tracked.friction = 0.0;
        }
        let worn = &self.surfaces[surface.0];
        let known = tracked.pressing.iter().position(|p| p.surface == surface);
        let is_firm = quasi_static::holds(&worn.surface, load);
        if load == 0.0 || known.is_none() && is_firm {
            return Ok(held_up);
        }
        let end = shadow::read(rb, tracked.shadow.as_ref(), &frame);
        let at = match (known, start, tracked.body()) {
            (Some(at), ..) => at,
            (None, Some(start), Some(body)) => {
                let settings = self.settings.encounter();
                let pressing = Pressing::new(body, start, surface, worn, settings);
                let pressing = pressing.map_err(|error| (error, 0.0))?;
                tracked.pressing.push(pressing);
                tracked.pressing.len() - 1
            }
            _ => return Ok(held_up),
        };
        let displaced = worn.surface.worn().displaced();
        let pressing = &mut tracked.pressing[at];
        let (surfaces, lies) = (&mut self.surfaces, &self.lies);
        let way = Move { end: &end, load, dt };
        let done = pressing.advance(held.body, surfaces, lies, &way, observer);
        let gained = self.surfaces[surface.0].surface.worn().displaced() - displaced;
        let Some(done) = done.map_err(|error| (error, gained))? else {
            return Ok(held_up);
        };
        tracked.friction = done.friction;
        self.counters.steps += done.advance.steps;
        self.counters.node_evaluations += done.advance.node_evaluations;
        Ok((frame * done.advance.impulse, gained))
    }
}
