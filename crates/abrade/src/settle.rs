//! The settlement of a trial: second kick, what acts over the step, projection, nodes.

use nalgebra::Vector3;

use crate::body::{Body, State};
use crate::carried::Grip;
use crate::contact::Contact;
use crate::debt::unpaid;
use crate::encounter::{Loads, Placed};
use crate::integrate::Integrator;
use crate::ledger::Ledger;
use crate::projection::{Paid, balance_ahead, pay};
#[cfg(feature = "state")]
use crate::state::finite;
use crate::toll::Toll;
use crate::trial::Trial;

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
    /// The part of them by which adhesion draws the body.
    pub drawn: Grip,
}

/// What columns take from a body in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Charge {
    /// Impulse [N s], and its torque about the centre of mass [N m s].
    pub impulse: Vector3<f64>,
    pub torque: Vector3<f64>,
    /// Dissipated by slip under the sweeping faces [J].
    pub flow_friction: f64,
    /// What the body pays of the toll.
    pub paid: Paid,
    /// Energy that the springs were short of [J].
    pub short: f64,
    /// Of what they lost, the part that nobody had paid [J].
    pub forgiven: f64,
}

impl Pull {
    /// Adds what adhesion does.
    fn draw(&mut self, drawn: &Grip) {
        self.force += drawn.force;
        self.torque += drawn.torque;
        self.drawn = *drawn;
    }
}

/// The accepted end of a step.
pub(crate) struct Settled {
    pub state: State,
    pub impulse: Vector3<f64>,
    /// Torque of the contacts about the centre of mass over the step [N m s].
    pub twist: Vector3<f64>,
}

impl Integrator {
    /// What the springs under faces cost the body in a step, with their debt less what of it is
    /// `forgiven` [J].
    pub(crate) fn owed(&self, toll: &Toll, forgiven: f64) -> f64 {
        toll.spring.friction + toll.elastic + toll.archard + toll.lost + self.short - forgiven
    }

    /// Takes what columns cost from a body in `state` and the carriers, closed by the energy
    /// projection. A guided body is paid for by what leads it: nothing is scaled.
    /// A `gain` [J] of the energy is taken with the wear, or with what springs take, and what loads
    /// gave `ahead` [J] by the springs.
    pub(crate) fn charge(
        &mut self,
        toll: &Toll,
        [gain, ahead]: [f64; 2],
        state: &mut State,
    ) -> Charge {
        if !self.has_columns() && gain == 0.0 && self.short == 0.0 {
            return Charge::default();
        }
        let guided = self.dynamics.is_guided();
        let flow_cost = toll.wear + toll.flow.friction;
        let (flow_gain, spring_gain) = if flow_cost > 0.0 { (gain, 0.0) } else { (0.0, gain) };
        let forgiven = if guided { 0.0 } else { unpaid(toll.lost, self.short) };
        let cost = self.owed(toll, forgiven) + spring_gain + self.given_over(toll, state);
        let (scale, short) = match guided {
            true => (1.0, 0.0),
            false => {
                let change = self.change(&toll.spring, state, |answer| &answer.sprung);
                balance_ahead(change, cost, ahead)
            }
        };
        let sprung = toll.spring.scaled(scale);
        self.apply(&sprung, state);
        self.react(state, |answer| answer.sprung.scaled(scale));
        let cost = flow_cost + flow_gain;
        let payment = match guided {
            true => Paid::ALL.flow,
            false => pay(self.change(&toll.flow, state, |answer| &answer.flow), cost),
        };
        let flow = toll.flow.scaled(payment.scale);
        self.apply(&flow, state);
        self.react(state, |answer| answer.flow.scaled(payment.scale));
        Charge {
            impulse: sprung.impulse + flow.impulse,
            torque: sprung.torque + flow.torque,
            flow_friction: toll.flow.friction * payment.share,
            paid: Paid { spring: scale, flow: payment },
            short,
            forgiven,
        }
    }

    /// Energy that the kicks of `loads` have given over a trial more than their work on its way [J]:
    /// what columns do places the end of the step, ahead of the balance in which they do it.
    pub(crate) fn ahead_of_loads(&self, body: &Body, loads: &Loads, dt: f64) -> f64 {
        if !self.has_sprung_columns() {
            return 0.0;
        }
        let [velocity, spin] = self.foreseen;
        let work =
            loads.pull(&body.inertia).dot(&velocity) + self.dynamics.work(&loads.torque, &spin);
        -work * dt
    }

    /// Half of what dashpots and adhesion did over the last trial.
    fn apply_halves(&mut self, state: &mut State) {
        if self.is_damped {
            self.apply(&self.damping.half(), state);
            self.react(state, |answer| answer.damping.scaled(0.5));
        }
        if self.adheres() {
            self.apply(&self.attraction.push.scaled(0.5), state);
            self.react(state, |answer| answer.drawn.scaled(0.5));
        }
    }

    /// Commits a trial. What it has cost is booked for the step, if energies are kept.
    pub(crate) fn settle(
        &mut self,
        body: &Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        dt: f64,
        trial: &Trial,
    ) -> Settled {
        let mut state = trial.state;
        let (springs, toll) = (&trial.springs, &trial.toll);
        let moves = !self.surfaces_rest();
        if moves {
            self.begin_hands();
        }
        let kick = |this: &mut Self, state: &mut State| {
            this.kick(body, loads, &springs.force, &springs.torque, 0.5 * dt, state);
            if moves {
                this.kick_carriers(surfaces, state, 0.5 * dt);
            }
        };
        // Adhesion and dashpots work at the mean velocity of the step: between the kicks of springs, and
        // in halves around what faces do. These come after both kicks, so that what they block rests.
        let by_faces = self.has_columns();
        if by_faces {
            kick(self, &mut state);
        }
        let given_back = if moves { self.give_back() } else { 0.0 };
        let gained = [given_back, self.ahead_of_loads(body, loads, dt)];
        self.apply_halves(&mut state);
        let Charge { mut impulse, mut torque, flow_friction, paid, short, forgiven } =
            self.charge(toll, gained, &mut state);
        self.apply_halves(&mut state);
        if !by_faces {
            kick(self, &mut state);
        }
        if self.is_damped {
            impulse += self.damping.impulse;
            torque += self.damping.torque;
        }
        self.short = short;
        let (elastic, push) = self.commit(surfaces, trial, &paid);
        let mut pull = Pull {
            force: springs.force + impulse / dt,
            torque: springs.torque + torque / dt,
            drawn: Grip::default(),
            spring_force: springs.force,
            spring_torque: springs.torque,
            push,
        };
        let [mut adhesion, mut left] = [0.0; 2];
        if self.adheres() {
            [adhesion, left] = self.adhere(body, surfaces);
            pull.draw(&self.attraction.grip);
            impulse += self.attraction.push.impulse;
            torque += self.attraction.push.torque;
        }
        let external_work = if moves { self.hold_on(body, surfaces, &state, dt) } else { 0.0 };
        if self.keeps_ledger() {
            self.booked = Ledger {
                elastic,
                friction: self.booked.friction + toll.spring.friction + flow_friction,
                damping: if self.is_damped { self.damping.dissipated } else { 0.0 },
                wear: self.booked.wear + toll.archard + toll.wear * paid.flow.share,
                history: self.booked.history + toll.lost - forgiven - left,
                adhesion,
                external_work,
                ..Ledger::default()
            };
        }
        impulse += (self.pull.spring_force + springs.force) * (0.5 * dt);
        let twist = (self.pull.spring_torque + springs.torque) * (0.5 * dt) + torque;
        self.pull = pull;
        Settled { state, impulse, twist }
    }

    /// Makes a trial the nodes' state; of the swept columns what the body has `paid`.
    /// Returns the stored energy [J] and the push along the nodes' normals [N].
    fn commit(
        &mut self,
        surfaces: &mut [Placed<'_>],
        trial: &Trial,
        paid: &Paid,
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
                    columns.commit(placed.surface, paid, trial.dt);
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
        let (elastic, push) = self.commit(surfaces, trial, &Paid::ALL);
        let adhesion = self.adhere(body, surfaces);
        let (Grip { force, torque }, drawn) = (self.grip(trial), self.attraction.grip);
        if self.keeps_ledger() {
            // Of adhesion the mean over the step is known.
            let (before, mean) = (self.pull.drawn, self.attraction.mean(trial.dt));
            let twice = |ends: Vector3<f64>, drawn: Vector3<f64>, mean: Vector3<f64>| {
                ends - drawn + mean * 2.0
            };
            let force = twice(self.pull.force + force, before.force + drawn.force, mean.force);
            let torque =
                twice(self.pull.torque + torque, before.torque + drawn.torque, mean.torque);
            let turned = self.dynamics.work(&torque, &trial.turn);
            let work = -0.5 * (force.dot(&trial.shift) + turned);
            self.book_lead(elastic, adhesion, work, &trial.toll);
        }
        body.state = State { velocity, spin, ..trial.state };
        self.pull = Pull {
            force,
            torque,
            spring_force: trial.springs.force,
            spring_torque: trial.springs.torque,
            drawn,
            push,
        };
        self.touching = trial.touching > 0;
        let omega = self.omega(trial);
        self.keep_step(self.eta / omega, omega);
    }
}

#[cfg(feature = "state")]
impl Pull {
    pub(crate) fn is_finite(&self) -> bool {
        let Self { force, torque, spring_force, spring_torque, push, drawn } = self;
        let drawn = [&drawn.force, &drawn.torque];
        let parts = [force, torque, spring_force, spring_torque, push].into_iter().chain(drawn);
        parts.into_iter().all(|part| finite(part.iter()))
    }
}
