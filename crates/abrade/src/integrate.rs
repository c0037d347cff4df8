//! Time integration of a contact: velocity Verlet for the body, trial and reject.
//!
//! dt = eta / omega with omega^2 = (sum of the elastic stiffnesses of the trial contacts) / m. A
//! trial whose omega dt exceeds 1.5 eta is rejected: without that a slow impact, whose first step
//! knows nothing of the stiffness to come, gains energy without bound.

use nalgebra::Vector3;

use crate::body::{Body, State};
use crate::encounter::{Advance, EncounterSettings, Instant, Loads, Observer, Placed, Until};
use crate::error::PhysicsError;
use crate::flight::free_time;
use crate::ledger::Ledger;
use crate::node_law::Motion;
use crate::patch::{Patch, Reaction};
use crate::rotation::Dynamics;
use crate::surface::Surface;

/// eta at an accuracy of 3e-3; the error goes as eta^2.
const ETA: f64 = 0.1;
const ETA_ACCURACY: f64 = 3e-3;
/// Hard cap of eta; the linear stability limit is 1.18.
const ETA_LIMIT: f64 = 0.7;
/// A trial is rejected above this multiple of eta.
const REJECT: f64 = 1.5;
/// Largest change of an overlap in a step, in yield overlaps.
const OVERLAP_CHANGE: f64 = 1.0;
/// Share of a step below which the turning point is not worth a step of its own.
const TURN: f64 = 0.05;
/// Growth of the step from one to the next.
const GROWTH: f64 = 2.0;
/// Overlap at the first step, in bounding radii, above which a body counts as started inside.
const INSIDE: f64 = 1e-3;
/// Share of the kinetic energy before contact below which a body counts as stopped.
const STOPPED: f64 = 1e-9;

/// State of a contact between calls.
#[derive(Clone, Debug)]
pub(crate) struct Integrator {
    settings: EncounterSettings,
    dynamics: Dynamics,
    eta: f64,
    patches: Vec<Patch>,
    /// Smallest yield overlap [m].
    yield_overlap: f64,
    /// Step that the last contact asked for [s]; zero when there is none.
    next_dt: f64,
    /// Force [N] and torque [N m] of the contacts at the present instant.
    force: Vector3<f64>,
    torque: Vector3<f64>,
    /// Sum of the nodes' normal loads along their normals [N].
    push: Vector3<f64>,
    touching: bool,
    touched: bool,
    energy_before: f64,
    ledger: Ledger,
}

/// A trial step.
struct Trial {
    state: State,
    spin_half: Vector3<f64>,
    velocity_half: Vector3<f64>,
    reactions: Vec<Reaction>,
    total: Reaction,
}

impl Integrator {
    pub(crate) fn new<'a>(
        body: &Body,
        surfaces: impl IntoIterator<Item = &'a Surface>,
        settings: EncounterSettings,
    ) -> Result<Self, PhysicsError> {
        let dynamics = Dynamics::new(&body.inertia, body.rotation_locked).ok_or(
            PhysicsError::Unsupported { what: "the body's mass or inertia is not positive" },
        )?;
        let mut patches = Vec::new();
        let mut yield_overlap = f64::INFINITY;
        for surface in surfaces {
            let patch = Patch::new(&body.shape, &surface.laws);
            yield_overlap = yield_overlap.min(patch.yield_overlap(surface));
            patches.push(patch);
        }
        Ok(Self {
            settings,
            dynamics,
            eta: (ETA * (settings.accuracy / ETA_ACCURACY).sqrt()).min(ETA_LIMIT),
            patches,
            yield_overlap,
            next_dt: 0.0,
            force: Vector3::zeros(),
            torque: Vector3::zeros(),
            push: Vector3::zeros(),
            touching: false,
            touched: false,
            energy_before: body.inertia.kinetic_energy(&body.state),
            ledger: Ledger::default(),
        })
    }

    pub(crate) fn in_contact(&self) -> bool {
        self.touching
    }

    pub(crate) fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    pub(crate) fn advance(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        duration: f64,
        until: Until,
        observer: &mut dyn Observer,
    ) -> Result<Advance, PhysicsError> {
        let mut done = Advance::default();
        while done.time < duration {
            let remaining = duration - done.time;
            let step = if self.touching {
                self.contact_step(&body.state).min(remaining)
            } else {
                self.free_step(body, surfaces, loads).min(remaining)
            };
            let dt = self.step(body, surfaces, loads, step, &mut done)?;
            // The last step ends on the duration to the bit.
            done.time = if dt == remaining { duration } else { done.time + dt };
            observer.observe(&Instant {
                time: done.time,
                state: &body.state,
                force: self.force,
                surfaces,
                ledger: self.settings.ledger.then_some(&self.ledger),
            });
            if until == Until::FirstExit && self.has_left(body, surfaces) {
                done.exited = true;
                break;
            }
            if done.steps > self.settings.step_limit {
                return Err(PhysicsError::TooManySteps { steps: done.steps });
            }
        }
        Ok(done)
    }

    /// Step of a body in contact. It ends where the body turns, because there the flow ends: a
    /// sampled peak would miss wear in proportion to dt^2.
    fn contact_step(&self, state: &State) -> f64 {
        let direction = self.push / self.push.norm().max(f64::MIN_POSITIVE);
        let approach = -state.velocity.dot(&direction);
        let braking = self.force.dot(&direction) * self.dynamics.inverse_mass;
        let turn = approach / braking;
        if turn > TURN * self.next_dt && turn < self.next_dt { turn } else { self.next_dt }
    }

    /// Step of a body out of contact: to the next instant at which it may touch.
    fn free_step(&mut self, body: &Body, surfaces: &[Placed<'_>], loads: &Loads) -> f64 {
        let speed =
            body.state.velocity.norm() + body.state.spin.norm() * body.shape.bounding_radius();
        let floor = if speed > 0.0 { 0.1 * self.yield_overlap / speed } else { f64::INFINITY };
        self.next_dt = 0.0;
        let mut time = f64::INFINITY;
        for (patch, placed) in self.patches.iter_mut().zip(surfaces) {
            let local = body.state.seen_from(&placed.pose);
            time = time.min(free_time(patch, placed.surface, body, &local, loads));
        }
        time.max(floor)
    }

    /// Takes one step of at most `dt`; returns its length.
    fn step(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        dt: f64,
        done: &mut Advance,
    ) -> Result<f64, PhysicsError> {
        let mut dt = dt;
        loop {
            let trial = self.trial(body, surfaces, loads, dt);
            done.node_evaluations += trial.total.evaluations;
            if !trial.state.is_finite() || !trial.total.force.iter().all(|x| x.is_finite()) {
                return Err(PhysicsError::NotFinite { time: done.contact_time });
            }
            let wanted = self.wanted_step(&trial.total, dt);
            if let Some(smaller) = wanted.reject {
                if dt < f64::MIN_POSITIVE / f64::EPSILON {
                    return Err(PhysicsError::StepVanished { step: dt });
                }
                dt = smaller;
                continue;
            }
            self.accept(body, surfaces, loads, dt, trial, done)?;
            self.next_dt = wanted.next;
            return Ok(dt);
        }
    }

    /// The step that the trial's stiffness allows.
    fn wanted_step(&self, total: &Reaction, dt: f64) -> Wanted {
        if total.touching == 0 {
            return Wanted { reject: None, next: GROWTH * dt };
        }
        let normal = total.normal_stiffness * self.dynamics.inverse_mass;
        let spin = self.dynamics.agility() * total.reach * total.reach;
        let tangential = total.tangential_stiffness * (self.dynamics.inverse_mass + spin);
        let omega = normal.max(tangential).sqrt();
        let allowed = self.eta / omega;
        let change = total.overlap_change / OVERLAP_CHANGE;
        let reject = if omega * dt > REJECT * self.eta {
            Some(allowed.min(0.7 * dt))
        } else if change > 1.0 {
            Some(dt * (0.8 / change).max(0.1))
        } else {
            None
        };
        Wanted { reject, next: allowed.min(GROWTH * dt) }
    }

    fn trial(&mut self, body: &Body, surfaces: &[Placed<'_>], loads: &Loads, dt: f64) -> Trial {
        let half = 0.5 * dt;
        let mut state = body.state;
        let (force, torque) = self.with_loads(body, loads, &self.force, &self.torque);
        state.velocity += force * (self.dynamics.inverse_mass * half);
        state.spin += self.dynamics.turn(&state.rotation, &(torque * half));
        let velocity_half = state.velocity;
        let spin_half = self.dynamics.drift(&mut state, dt);
        let reach = (velocity_half.norm() + spin_half.norm() * body.shape.bounding_radius()) * dt;
        let mut trial = Trial {
            state,
            spin_half,
            velocity_half,
            reactions: Vec::new(),
            total: Reaction::default(),
        };
        for (patch, placed) in self.patches.iter_mut().zip(surfaces) {
            let end = state.seen_from(&placed.pose);
            let margin = (8.0 * reach).max(0.05 * placed.surface.pitch());
            patch.cover(placed.surface, &body.shape, &end, margin);
            let motion = Motion {
                velocity: placed.pose.inverse_transform_vector(&velocity_half),
                spin: placed.pose.inverse_transform_vector(&spin_half),
                dt,
            };
            let reaction = patch.trial(placed.surface, &end, &motion, self.settings.ledger);
            trial.total.add(&reaction, &placed.pose);
            trial.reactions.push(reaction);
        }
        trial
    }

    fn with_loads(
        &self,
        body: &Body,
        loads: &Loads,
        force: &Vector3<f64>,
        torque: &Vector3<f64>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        (force + loads.force + loads.gravity * body.inertia.mass, torque + loads.torque)
    }

    fn accept(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        dt: f64,
        trial: Trial,
        done: &mut Advance,
    ) -> Result<(), PhysicsError> {
        if !self.touched && trial.total.touching > 0 {
            self.begin_contact(body, surfaces)?;
        }
        let before = body.state;
        let half = 0.5 * dt;
        let mut state = trial.state;
        let (force, torque) = self.with_loads(body, loads, &trial.total.force, &trial.total.torque);
        state.velocity += force * (self.dynamics.inverse_mass * half);
        state.spin += self.dynamics.turn(&state.rotation, &(torque * half));
        let undamped = state;
        state.velocity /= 1.0 + dt * loads.linear_damping;
        state.spin /= 1.0 + dt * loads.angular_damping;
        for ((patch, placed), reaction) in
            self.patches.iter_mut().zip(surfaces.iter_mut()).zip(&trial.reactions)
        {
            patch.commit(placed.surface, reaction);
            engulfed(placed, &state)?;
        }
        done.impulse += (self.force + trial.total.force) * half;
        done.steps += 1;
        if trial.total.touching > 0 || self.touching {
            done.contact_time += dt;
        }
        if self.settings.ledger {
            let shift = (trial.velocity_half * dt, trial.spin_half * dt);
            self.keep_books(body, loads, &before, &undamped, &state, shift, &trial.total.ledger);
        }
        self.force = trial.total.force;
        self.torque = trial.total.torque;
        self.push = trial.total.push;
        self.touching = trial.total.touching > 0;
        body.state = state;
        Ok(())
    }

    #[allow(clippy::too_many_arguments, reason = "the states of one step, each of another type")]
    fn keep_books(
        &mut self,
        body: &Body,
        loads: &Loads,
        before: &State,
        undamped: &State,
        after: &State,
        (shift, turn): (Vector3<f64>, Vector3<f64>),
        step: &Ledger,
    ) {
        let energy = |state: &State| body.inertia.kinetic_energy(state);
        let weight = loads.force + loads.gravity * body.inertia.mass;
        let ledger = &mut self.ledger;
        ledger.kinetic_change += energy(after) - energy(before);
        ledger.damping += energy(undamped) - energy(after);
        ledger.external_work += weight.dot(&shift) + loads.torque.dot(&turn);
        ledger.elastic = step.elastic;
        ledger.friction += step.friction;
        ledger.wear += step.wear;
        ledger.history += step.history;
    }

    /// The first touch: the body must not have started inside a surface.
    fn begin_contact(&mut self, body: &Body, surfaces: &[Placed<'_>]) -> Result<(), PhysicsError> {
        for (patch, placed) in self.patches.iter().zip(surfaces) {
            let depth = patch.deepest(&body.state.seen_from(&placed.pose));
            if depth > INSIDE * body.shape.bounding_radius() {
                return Err(PhysicsError::StartsInside { depth });
            }
        }
        self.touched = true;
        self.energy_before = body.inertia.kinetic_energy(&body.state);
        Ok(())
    }

    /// `Until::FirstExit`: out of contact and above, or stopped.
    fn has_left(&self, body: &Body, surfaces: &[Placed<'_>]) -> bool {
        if !self.touched {
            return false;
        }
        let stopped = body.inertia.kinetic_energy(&body.state) < STOPPED * self.energy_before;
        let above = || {
            self.patches.iter().zip(surfaces).all(|(patch, placed)| {
                let local = body.state.seen_from(&placed.pose);
                crate::flight::separation(placed.surface, body, &local, patch.inflation()) >= 0.0
            })
        };
        !self.touching && above()
    }
}

struct Wanted {
    reject: Option<f64>,
    next: f64,
}

/// An error when the centre of mass is below the undeformed surface.
fn engulfed(placed: &Placed<'_>, state: &State) -> Result<(), PhysicsError> {
    let [low, high] = placed.surface.bounds();
    let local = placed.pose.inverse_transform_point(&state.position);
    let over = (0..2).all(|a| local[a] > low[a] && local[a] < high[a]);
    if over && local.z < high.z {
        return Err(PhysicsError::Engulfed { depth: high.z - local.z });
    }
    Ok(())
}
