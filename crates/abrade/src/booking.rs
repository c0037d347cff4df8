//! What a contact has cost, kept step by step.

use nalgebra::Vector3;

use crate::adhesion::Glue;
use crate::body::{Body, State};
use crate::carrier::carriers_energy;
use crate::debt::unpaid;
use crate::encounter::{Advance, Loads, Placed};
use crate::integrate::Integrator;
use crate::ledger::Ledger;
use crate::settle::Pull;
use crate::toll::Toll;
use crate::trial::Trial;

impl Integrator {
    pub(crate) fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// The energies, if they are kept.
    pub(crate) fn kept_ledger(&self) -> Option<&Ledger> {
        self.settings.ledger.then_some(&self.ledger)
    }

    pub(crate) fn keeps_ledger(&self) -> bool {
        self.settings.ledger
    }

    /// Settles a trial, and makes it the state.
    pub(crate) fn accept(
        &mut self,
        body: &mut Body,
        surfaces: &mut [Placed<'_>],
        loads: &Loads,
        dt: f64,
        trial: Trial,
        done: &mut Advance,
    ) {
        let before = body.state;
        let carried = self.settings.ledger.then(|| carriers_energy(surfaces));
        let end = self.settle(body, surfaces, loads, dt, &trial);
        let mut state = end.state;
        state.velocity /= 1.0 + dt * loads.linear_damping;
        state.spin /= 1.0 + dt * loads.angular_damping;
        let damped = if self.surfaces_rest() { 0.0 } else { self.arrive(surfaces, dt) };
        if let Some(carried) = carried {
            let spent = self.booked;
            let energy = |state: &State| body.inertia.kinetic_energy(state);
            let weight = loads.pull(&body.inertia);
            let ledger = &mut self.ledger;
            let carried = carriers_energy(surfaces) - carried;
            ledger.kinetic_change += energy(&state) - energy(&before) + carried;
            ledger.damping += energy(&end.state) - energy(&state) + spent.damping + damped;
            ledger.external_work += spent.external_work
                + weight.dot(&trial.shift)
                + self.dynamics.work(&loads.torque, &trial.turn);
            if self.dynamics.is_immovable() {
                // What leads the body holds it against the contact.
                ledger.external_work -=
                    end.impulse.dot(&before.velocity) + end.twist.dot(&before.spin);
            }
            if self.dynamics.is_guided() {
                // What leads the body takes up the force that its velocity does not show.
                let total = end.impulse + weight * dt;
                let shown = (end.state.velocity - before.velocity) / self.dynamics.inverse_mass;
                ledger.external_work += (shown - total).dot(&trial.shift) / dt;
            }
            ledger.elastic = spent.elastic;
            ledger.friction += spent.friction;
            ledger.wear += spent.wear;
            ledger.history += spent.history;
            ledger.adhesion += spent.adhesion;
        }
        self.supply(body, loads, &trial);
        done.impulse += end.impulse;
        done.twist += end.twist;
        done.steps += 1;
        if trial.touching > 0 || self.touching {
            done.contact_time += dt;
        }
        self.touching = trial.touching > 0;
        body.state = state;
    }

    /// Lets go of the surfaces: the energy of the springs is lost.
    pub(crate) fn let_go(&mut self, surfaces: &mut [Placed<'_>]) {
        for (contact, placed) in self.contacts.iter_mut().zip(surfaces) {
            contact.let_go(placed.surface);
        }
        self.pull = Pull::default();
        self.balance = None;
        let held: f64 = self.glue.iter_mut().flatten().map(Glue::let_go).sum();
        if self.settings.ledger {
            self.ledger.adhesion -= held;
            self.ledger.history += held;
        }
        let lost = std::mem::take(&mut self.ledger.elastic);
        self.ledger.history += lost - unpaid(lost, self.short);
        self.short = 0.0;
        (self.touching, self.touched) = (false, false);
    }

    /// Books what dashpots of a led body dissipated [J].
    pub(crate) fn book_damping(&mut self, dissipated: f64) {
        if self.settings.ledger {
            self.ledger.damping += dissipated;
        }
    }

    /// Books what springs of a led body let go unpaid [J].
    pub(crate) fn book_forgiven(&mut self, forgiven: f64) {
        if self.keeps_ledger() {
            self.ledger.history -= forgiven;
        }
    }

    /// Books a step of a led body, in which the lead did `work` and the energy of adhesion changed, in
    /// part by nodes that sank away [J].
    pub(crate) fn book_lead(
        &mut self,
        elastic: f64,
        [adhesion, left]: [f64; 2],
        work: f64,
        toll: &Toll,
    ) {
        let (ledger, springs) = (&mut self.ledger, &self.booked);
        ledger.elastic = elastic;
        ledger.external_work += work;
        ledger.friction += springs.friction + toll.flow.friction + toll.spring.friction;
        ledger.wear += springs.wear + toll.archard + toll.wear;
        ledger.history += springs.history + toll.lost - left;
        ledger.adhesion += adhesion;
    }

    /// Turns an indented body into a sliding one that is free along `vertical` alone; the ledger
    /// begins anew.
    pub(crate) fn restart(&mut self, body: &mut Body, vertical: &Vector3<f64>) {
        body.state.velocity = Vector3::zeros();
        self.dynamics = self.dynamics.guided(*vertical);
        self.touched = true;
        let stored = self.ledger.elastic;
        self.ledger = Ledger { elastic: stored, elastic_start: stored, ..Ledger::default() };
    }
}
