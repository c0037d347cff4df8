//! One trial step and its settlement: kick, drift, ask every contact, kick, project.

use nalgebra::Vector3;

use crate::body::{Body, State};
use crate::carried::Grip;
use crate::carrier::Ride;
use crate::contact::Contact;
use crate::debt::unpaid;
use crate::encounter::{Loads, Placed};
use crate::flight::top_speed;
use crate::inner_loop::Reaction;
use crate::integrate::Integrator;
use crate::ledger::Ledger;
use crate::node_law::Motion;
use crate::projection::{Payment, balance, pay};
use crate::rotation::Dynamics;
#[cfg(feature = "state")]
use crate::state::finite;
use crate::toll::{Push, Toll};

/// Largest predicted change of the speed by columns without springs, as a share of it.
const PREDICTION: f64 = 0.1;

/// What contacts do to a body at an instant.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Pull {
    /// Force [N] and torque [N m] of all contacts.
    pub force: Vector3<f64>,
    pub torque: Vector3<f64>,
    /// The part of them that springs exert.
    pub spring_force: Vector3<f64>,
    pub spring_torque: Vector3<f64>,
    /// Sum of the nodes' normal loads along their normals [N].
    pub push: Vector3<f64>,
}

/// How a body moves over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course {
    /// Mid-step velocity [m/s] and spin [rad/s].
    pub velocity: Vector3<f64>,
    pub spin: Vector3<f64>,
    /// Length of the step [s].
    pub dt: f64,
}

/// A step that may be rejected.
#[derive(Clone, Debug)]
pub(crate) struct Trial {
    pub state: State,
    pub dt: f64,
    /// Displacement [m] and turn [rad] of the step.
    pub shift: Vector3<f64>,
    pub turn: Vector3<f64>,
    springs: Reaction,
    pub toll: Toll,
    pub touching: usize,
    pub evaluations: u64,
    pub overlap_change: f64,
    /// No contact was asked.
    flight: bool,
}

/// What columns take from a body in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Charge {
    /// Impulse [N s], and its torque about the centre of mass [N m s].
    pub impulse: Vector3<f64>,
    pub torque: Vector3<f64>,
    /// Dissipated by slip under the sweeping faces [J].
    pub flow_friction: f64,
    /// Share of the removal that the body can pay [-].
    pub share: f64,
    /// Energy that the springs were short of [J].
    pub short: f64,
    /// Of what they lost, the part that nobody had paid [J].
    pub forgiven: f64,
}

/// What columns and dashpots are foreseen to change over half a step, and the share of it that is
/// believed.
#[derive(Clone, Copy, Debug, Default)]
struct Prediction {
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
    share: f64,
}

/// The accepted end of a step.
pub(crate) struct Settled {
    pub state: State,
    pub pull: Pull,
    pub impulse: Vector3<f64>,
    /// Torque of the contacts about the centre of mass over the step [N m s].
    pub twist: Vector3<f64>,
    /// Stored energy, and increments of the dissipated ones, if they are kept.
    pub ledger: Option<Ledger>,
}

impl Trial {
    pub(crate) fn is_finite(&self) -> bool {
        let Toll { flow, spring, .. } = &self.toll;
        let forces = [
            self.springs.force,
            self.springs.torque,
            flow.impulse,
            flow.torque,
            spring.impulse,
            spring.torque,
        ];
        self.state.is_finite() && forces.iter().all(|v| v.iter().all(|x| x.is_finite()))
    }

    /// Force of all contacts on the body [N]; of columns, the mean over the step.
    pub(crate) fn force(&self) -> Vector3<f64> {
        self.springs.force + self.swept().force
    }

    /// Torque of all contacts on the body [N m]; of columns, the mean over the step.
    pub(crate) fn torque(&self) -> Vector3<f64> {
        self.springs.torque + self.swept().torque
    }

    /// What columns do to the body, in the mean over the step.
    pub(crate) fn swept(&self) -> Grip {
        let (flow, spring) = (&self.toll.flow, &self.toll.spring);
        let force = (flow.impulse + spring.impulse) / self.dt;
        Grip { force, torque: (flow.torque + spring.torque) / self.dt }
    }

    /// Longest lever of a spring's force on the body [m].
    pub(crate) fn lever(&self) -> f64 {
        self.springs.lever_squared.sqrt()
    }

    /// Highest angular frequency [1/s] of the body on the touching springs, whose other ends give
    /// way by `other` [1/kg].
    pub(crate) fn omega(&self, dynamics: &Dynamics, other: f64) -> f64 {
        let springs = &self.springs;
        let inverse_mass = dynamics.inverse_mass + other;
        let normal = (springs.normal_stiffness + self.toll.stiffness) * inverse_mass;
        let turning = dynamics.agility() * springs.lever_squared;
        let tangential = springs.tangential_stiffness * (inverse_mass + turning);
        normal.max(tangential).sqrt()
    }
}

impl Integrator {
    pub(crate) fn trial(
        &mut self,
        body: &Body,
        surfaces: &[Placed<'_>],
        loads: &Loads,
        dt: f64,
        flight: bool,
    ) -> Trial {
        let half = 0.5 * dt;
        let mut state = body.state;
        self.kick(body, loads, &self.pull.spring_force, &self.pull.spring_torque, half, &mut state);
        let kicked = state;
        let swept = self.swept_prediction(body, surfaces, half);
        state.velocity += swept.velocity;
        state.spin += swept.spin;
        self.ride(body, surfaces, dt, swept.share);
        let (velocity, predicted) = (state.velocity, state.spin);
        let spin = self.dynamics.drift(&mut state, dt);
        state.velocity = kicked.velocity;
        state.spin += kicked.spin - predicted;
        if !self.rides.is_empty() {
            let momentum = |s: &State| self.dynamics.angular_momentum(&s.rotation, &s.spin);
            if !self.dynamics.is_immovable() {
                self.ahead += (velocity * dt).cross(&kicked.velocity) * body.inertia.mass;
            }
            if !body.rotation_locked {
                self.ahead += momentum(&state) - momentum(&kicked);
            }
        }
        // In flight nothing can be touched, so nothing is asked.
        let surfaces = if flight { &[] } else { surfaces };
        let trial = self.ask(body, surfaces, &state, Course { velocity, spin, dt });
        if self.is_damped {
            self.damp(surfaces, &trial);
        }
        trial
    }

    /// Asks every contact about a step that ends at `state`.
    pub(crate) fn ask(
        &mut self,
        body: &Body,
        surfaces: &[Placed<'_>],
        state: &State,
        course: Course,
    ) -> Trial {
        let Course { velocity, spin, dt } = course;
        let mut trial = Trial {
            state: *state,
            dt,
            shift: velocity * dt,
            turn: spin * dt,
            springs: Reaction::default(),
            toll: Toll::default(),
            touching: 0,
            evaluations: 0,
            overlap_change: 0.0,
            flight: surfaces.is_empty(),
        };
        let reach = (velocity.norm() + spin.norm() * body.shape.bounding_radius()) * dt;
        let keeps_ledger = self.keeps_ledger();
        if keeps_ledger {
            self.booked = Ledger::default();
        }
        for (i, (contact, placed)) in self.contacts.iter_mut().zip(surfaces).enumerate() {
            let ride = self.rides.get(i).and_then(Option::as_ref);
            let pose = ride.map_or(placed.pose, |ride| ride.pose);
            let end = state.seen_from(&pose);
            let motion = match ride {
                None => {
                    let local = |v: &Vector3<f64>| placed.pose.inverse_transform_vector(v);
                    Motion { velocity: local(&velocity), spin: local(&spin), drag: None, dt }
                }
                Some(ride) => ride.relative([&body.state, state], course),
            };
            let reach = match ride {
                None => reach,
                Some(_) => {
                    let Motion { velocity, spin, .. } = &motion;
                    (velocity.norm() + spin.norm() * body.shape.bounding_radius()) * dt
                }
            };
            contact.cover(placed, body, &end, reach.min(placed.surface.pitch()));
            match contact {
                Contact::Springs(patch) => {
                    let reaction = patch.trial(placed.surface.laws(), &end, &motion);
                    trial.springs.add(reaction, &pose);
                    if ride.is_some() {
                        self.answers[i].springs = reaction.grip().turned(&pose);
                    }
                    if keeps_ledger {
                        self.booked += patch.ledger();
                    }
                }
                Contact::Mutual(mutual) => {
                    let levers = body.shape.bounding_radius();
                    let reaction = mutual.trial(placed, &end, &motion, levers);
                    trial.springs.add(&reaction, &pose);
                    if keeps_ledger {
                        self.booked += mutual.ledger();
                    }
                    if ride.is_some() {
                        self.answers[i].springs = reaction.grip().turned(&pose);
                    }
                }
                Contact::Columns(columns) => {
                    let start = body.state.seen_from(&placed.pose);
                    let poses = [&start, &end];
                    let toll = columns.trial(placed.surface, &body.shape, poses, &motion);
                    let pose = ride.map_or(pose, Ride::middle);
                    trial.toll.add(toll, &pose);
                    if ride.is_some() {
                        self.answers[i].flow.add(&toll.flow, &pose);
                        self.answers[i].sprung.add(&toll.spring, &pose);
                    }
                }
            }
        }
        trial.touching = trial.springs.touching + trial.toll.touching;
        trial.evaluations = (trial.springs.touching + trial.toll.touching) as u64;
        trial.overlap_change = trial.springs.overlap_change;
        trial
    }

    /// Change of velocity and spin over `half` a step that the last mean force of columns and
    /// dashpots predicts. It places the step's end, nothing else: the balance does not use it. Without springs a
    /// blocked body's last force says nothing, so the prediction stays small; and a body whose
    /// moments differ keeps its spin, whose free turning must keep the energy.
    fn swept_prediction(&self, body: &Body, surfaces: &[Placed<'_>], half: f64) -> Prediction {
        let pull = &self.pull;
        if !self.touching {
            // The last step let go: what springs and dashpots did says nothing of a flight.
            return Prediction::default();
        }
        let force = pull.force - pull.spring_force;
        let torque = pull.torque - pull.spring_torque;
        let velocity = self.dynamics.accelerate(&(force * half));
        let spin = self.dynamics.turn(&body.state.rotation, &(torque * half));
        if self.is_damped || self.has_sprung_columns() {
            return Prediction { velocity, spin, share: 1.0 };
        }
        let spin = if self.dynamics.is_isotropic() { spin } else { Vector3::zeros() };
        let radius = body.shape.bounding_radius();
        let speed =
            surfaces.iter().map(|placed| top_speed(placed, body)).fold(f64::INFINITY, f64::min);
        let change = velocity.norm() + spin.norm() * radius + self.carriers_prediction(half);
        let share = if change > 0.0 { (PREDICTION * speed / change).min(1.0) } else { 0.0 };
        Prediction { velocity: velocity * share, spin: spin * share, share }
    }

    /// What the springs under faces would be out of balance by after the trial [J]; with surfaces at
    /// rest and without dashpots.
    pub(crate) fn foreseen_short(&self, body: &Body, loads: &Loads, trial: &Trial) -> f64 {
        if self.dynamics.is_guided() {
            return 0.0;
        }
        let (springs, toll) = (&trial.springs, &trial.toll);
        let mut state = trial.state;
        self.kick(body, loads, &springs.force, &springs.torque, 0.5 * trial.dt, &mut state);
        let cost = toll.spring.friction + toll.elastic + toll.lost + self.short
            - unpaid(toll.lost, self.short);
        balance(self.change(&toll.spring, &state, |answer| &answer.sprung), cost).1
    }

    pub(crate) fn has_sprung_columns(&self) -> bool {
        self.contacts.iter().any(|c| matches!(c, Contact::Columns(_)) && !c.is_rigid())
    }

    fn kick(
        &self,
        body: &Body,
        loads: &Loads,
        force: &Vector3<f64>,
        torque: &Vector3<f64>,
        time: f64,
        state: &mut State,
    ) {
        let force = force + loads.pull(&body.inertia);
        let torque = torque + loads.torque;
        state.velocity += self.dynamics.accelerate(&(force * time));
        state.spin += self.dynamics.turn(&state.rotation, &(torque * time));
    }

    fn apply(&self, push: &Push, state: &mut State) {
        state.velocity += self.dynamics.accelerate(&push.impulse);
        state.spin += self.dynamics.turn(&state.rotation, &push.torque);
    }

    /// Takes what columns cost from a body in `state` and the carriers, closed by the energy
    /// projection. A guided body is paid for by what leads it: nothing is scaled.
    /// A `gain` [J] of the energy is taken with the wear.
    pub(crate) fn charge(&mut self, toll: &Toll, gain: f64, state: &mut State) -> Charge {
        let has_columns = self.contacts.iter().any(|c| matches!(c, Contact::Columns(_)));
        if !has_columns && gain == 0.0 && self.short == 0.0 {
            return Charge { share: 1.0, ..Charge::default() };
        }
        let guided = self.dynamics.is_guided();
        let flow_cost = toll.wear + toll.flow.friction;
        let (flow_gain, spring_gain) = if flow_cost > 0.0 { (gain, 0.0) } else { (0.0, gain) };
        let forgiven = if guided { 0.0 } else { unpaid(toll.lost, self.short) };
        let owed = self.short - forgiven;
        let cost = toll.spring.friction + toll.elastic + toll.lost + owed + spring_gain;
        let (scale, short) = match guided {
            true => (1.0, 0.0),
            false => balance(self.change(&toll.spring, state, |answer| &answer.sprung), cost),
        };
        let sprung = toll.spring.scaled(scale);
        self.apply(&sprung, state);
        self.react(state, |answer| answer.sprung.scaled(scale));
        let cost = flow_cost + flow_gain;
        let payment = match guided {
            true => Payment { scale: 1.0, share: 1.0 },
            false => pay(self.change(&toll.flow, state, |answer| &answer.flow), cost),
        };
        let flow = toll.flow.scaled(payment.scale);
        self.apply(&flow, state);
        self.react(state, |answer| answer.flow.scaled(payment.scale));
        Charge {
            impulse: sprung.impulse + flow.impulse,
            torque: sprung.torque + flow.torque,
            flow_friction: toll.flow.friction * payment.share,
            share: payment.share,
            short,
            forgiven,
        }
    }

    /// Commits a trial: second kick, projection, nodes.
    pub(crate) fn settle(
        &mut self,
        body: &Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        dt: f64,
        trial: &Trial,
    ) -> Settled {
        let mut state = trial.state;
        let springs = &trial.springs;
        self.kick(body, loads, &springs.force, &springs.torque, 0.5 * dt, &mut state);
        self.kick_carriers(surfaces, &state, 0.5 * dt);
        let gained = self.give_back();
        let toll = &trial.toll;
        // The dashpots in halves around the springs: work at the mean velocity of the step.
        let half = self.is_damped.then(|| self.damping.half());
        if let Some(half) = &half {
            self.apply(half, &mut state);
            self.react(&state, |answer| answer.damping.scaled(0.5));
        }
        let Charge { mut impulse, mut torque, flow_friction, share, short, forgiven } =
            self.charge(toll, gained, &mut state);
        if let Some(half) = &half {
            self.apply(half, &mut state);
            self.react(&state, |answer| answer.damping.scaled(0.5));
            impulse += self.damping.impulse;
            torque += self.damping.torque;
        }
        self.short = short;
        let (elastic, push) = self.commit(surfaces, trial, share);
        let pull = Pull {
            force: springs.force + impulse / dt,
            torque: springs.torque + torque / dt,
            spring_force: springs.force,
            spring_torque: springs.torque,
            push,
        };
        let external_work = self.hold_on(body, surfaces, &state, dt);
        let ledger = self.keeps_ledger().then(|| Ledger {
            elastic,
            friction: self.booked.friction + toll.spring.friction + flow_friction,
            damping: half.map_or(0.0, |_| self.damping.dissipated),
            wear: self.booked.wear + toll.wear * share,
            history: self.booked.history + toll.lost - forgiven,
            external_work,
            ..Ledger::default()
        });
        let mean = (self.pull.spring_force + springs.force) * (0.5 * dt);
        let twist = (self.pull.spring_torque + springs.torque) * (0.5 * dt) + torque;
        Settled { state, pull, impulse: mean + impulse, twist, ledger }
    }

    /// Makes a trial the nodes' state; a blocked body takes a `share` of the swept columns.
    /// Returns the stored energy [J] and the push along the nodes' normals [N].
    fn commit(
        &mut self,
        surfaces: &mut [Placed<'_>],
        trial: &Trial,
        share: f64,
    ) -> (f64, Vector3<f64>) {
        let mut elastic = self.booked.elastic;
        let mut push = trial.springs.push;
        if trial.flight {
            return (elastic, push);
        }
        let stored = self.keeps_ledger();
        let pairs = self.contacts.iter_mut().zip(surfaces.iter_mut());
        for (contact, placed) in pairs {
            match contact {
                Contact::Springs(patch) => patch.commit(placed.surface),
                Contact::Mutual(mutual) => mutual.commit(placed),
                Contact::Columns(columns) => {
                    columns.commit(placed.surface, share, trial.dt);
                    push += placed.pose * columns.impulse() / trial.dt;
                    if stored {
                        elastic += columns.elastic();
                    }
                }
            }
        }
        (elastic, push)
    }

    /// Makes the trial of a body that something else leads the state, with the velocities that
    /// the lead gives it; what leads it pays for everything.
    pub(crate) fn lead(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
        trial: &Trial,
        [velocity, spin]: [Vector3<f64>; 2],
    ) {
        let (elastic, push) = self.commit(surfaces, trial, 1.0);
        let (force, torque) = (trial.force(), trial.torque());
        if self.keeps_ledger() {
            let (force, torque) = (self.pull.force + force, self.pull.torque + torque);
            let turned = self.dynamics.work(&torque, &trial.turn);
            let work = -0.5 * (force.dot(&trial.shift) + turned);
            self.book_lead(elastic, work, &trial.toll);
        }
        body.state = State { velocity, spin, ..trial.state };
        self.pull = Pull {
            force,
            torque,
            spring_force: trial.springs.force,
            spring_torque: trial.springs.torque,
            push,
        };
        self.touching = trial.touching > 0;
        self.next_dt = self.eta / self.omega(trial);
    }
}

#[cfg(feature = "state")]
impl Pull {
    pub(crate) fn is_finite(&self) -> bool {
        let Self { force, torque, spring_force, spring_torque, push } = self;
        let parts = [force, torque, spring_force, spring_torque, push];
        parts.iter().all(|part| finite(part.iter()))
    }
}
