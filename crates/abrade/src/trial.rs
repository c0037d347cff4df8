//! One trial step: kick, drift, ask every contact.

use nalgebra::Vector3;

use crate::adhesion::Attraction;
use crate::body::{Body, State};
use crate::carried::Grip;
use crate::contact::Contact;
use crate::debt::unpaid;
use crate::encounter::{Loads, Placed};
use crate::flight::top_speed;
use crate::inner_loop::Reaction;
use crate::integrate::Integrator;
use crate::ledger::Ledger;
use crate::node_law::Motion;
use crate::projection::balance_ahead;
use crate::ride::Ride;
use crate::rotation::Dynamics;
use crate::toll::{Push, Toll};

/// Largest predicted change of the speed by columns without springs, as a share of it.
const PREDICTION: f64 = 0.1;

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
    pub springs: Reaction,
    pub toll: Toll,
    pub touching: usize,
    pub evaluations: u64,
    pub overlap_change: f64,
    /// No contact was asked.
    pub flight: bool,
}

/// What columns and dashpots are foreseen to change over half a step, and the share of it that is
/// believed.
#[derive(Clone, Copy, Debug, Default)]
struct Prediction {
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
    share: f64,
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
    /// Force [N] and torque [N m] of all contacts on the body in the last `trial`; of columns, the mean
    /// over the step.
    pub(crate) fn grip(&self, trial: &Trial) -> Grip {
        let (springs, swept, drawn) = (&trial.springs, trial.swept(), &self.attraction.grip);
        Grip {
            force: springs.force + swept.force + drawn.force,
            torque: springs.torque + swept.torque + drawn.torque,
        }
    }

    /// False for a last `trial` in which something is not a number.
    pub(crate) fn is_finite(&self, trial: &Trial) -> bool {
        trial.is_finite()
            && (!self.adheres() || self.attraction.is_finite())
            && (self.surfaces_rest()
                || self.rides.iter().flatten().all(|ride| ride.end.is_finite()))
    }

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
        self.foreseen = [swept.velocity, swept.spin];
        let adheres = self.adheres();
        if adheres {
            let drawn = self.pull.drawn * half;
            state.velocity += self.dynamics.accelerate(&drawn.force);
            state.spin += self.dynamics.turn(&state.rotation, &drawn.torque);
        }
        self.ride(body, surfaces, dt, swept.share);
        let (velocity, predicted) = (state.velocity, state.spin);
        let spin = self.dynamics.drift(&mut state, dt);
        state.velocity = kicked.velocity;
        state.spin += kicked.spin - predicted;
        if !self.surfaces_rest() {
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
        if self.adheres() {
            self.attraction = Attraction::default();
        }
        let reach = (velocity.norm() + spin.norm() * body.shape.bounding_radius()) * dt;
        let keeps_ledger = self.keeps_ledger();
        if keeps_ledger {
            self.booked = Ledger::default();
        }
        for (i, (contact, placed)) in self.contacts.iter_mut().zip(surfaces).enumerate() {
            let ride = self.rides.get(i).and_then(Option::as_ref);
            let pose = ride.map_or(&placed.pose, |ride| &ride.pose);
            let end = state.seen_from(pose);
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
                    trial.springs.add(reaction, pose);
                    if ride.is_some() {
                        self.answers[i].springs = reaction.grip().turned(pose);
                    }
                    if keeps_ledger {
                        self.booked += patch.ledger();
                    }
                }
                Contact::Mutual(mutual) => {
                    let levers = body.shape.bounding_radius();
                    let reaction = mutual.trial(placed, &end, &motion, levers);
                    trial.springs.add(&reaction, pose);
                    if keeps_ledger {
                        self.booked += mutual.ledger();
                    }
                    if ride.is_some() {
                        self.answers[i].springs = reaction.grip().turned(pose);
                    }
                }
                Contact::Columns(columns) => {
                    let start = body.state.seen_from(&placed.pose);
                    let poses = [&start, &end];
                    let toll = columns.trial(placed.surface, &body.shape, poses, &motion);
                    let middle = ride.map(Ride::middle);
                    let pose = middle.as_ref().unwrap_or(pose);
                    trial.toll.add(toll, pose);
                    if ride.is_some() {
                        self.answers[i].flow.add(&toll.flow, pose);
                        self.answers[i].sprung.add(&toll.spring, pose);
                    }
                }
            }
            if let Some(glue) = self.glue.get_mut(i).and_then(Option::as_mut) {
                let drawn = glue.trial(placed.surface, &body.shape, &end, &motion);
                self.attraction.add(drawn, pose);
                if ride.is_some() {
                    self.answers[i].drawn.add(&drawn.push, pose);
                }
            }
        }
        trial.touching = trial.springs.touching + trial.toll.touching + self.attraction.reaching;
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
        let force = pull.force - pull.spring_force - pull.drawn.force;
        let torque = pull.torque - pull.spring_torque - pull.drawn.torque;
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
        if self.adheres() {
            self.apply(&self.attraction.push.scaled(0.5), &mut state);
        }
        let cost = self.owed(toll, unpaid(toll.lost, self.short)) + self.given_over(toll, &state);
        let ahead = self.ahead_of_loads(body, loads, trial.dt);
        balance_ahead(self.change(&toll.spring, &state, |answer| &answer.sprung), cost, ahead).1
    }

    pub(crate) fn has_columns(&self) -> bool {
        self.contacts.iter().any(|contact| matches!(contact, Contact::Columns(_)))
    }

    pub(crate) fn has_sprung_columns(&self) -> bool {
        self.contacts.iter().any(|c| matches!(c, Contact::Columns(_)) && !c.is_rigid())
    }

    pub(crate) fn kick(
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

    pub(crate) fn apply(&self, push: &Push, state: &mut State) {
        state.velocity += self.dynamics.accelerate(&push.impulse);
        state.spin += self.dynamics.turn(&state.rotation, &push.torque);
    }
}
