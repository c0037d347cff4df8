//! Whether springs under faces are in balance with their body: what they take on or give back is
//! paid by it, step by step, as far as their impulse can. It cannot where friction would turn a slip
//! back within the step, nor where a face comes upon a whole column at once.

use crate::body::{Body, State};
use crate::encounter::{Loads, Placed};
use crate::error::PhysicsError;
use crate::integrate::Integrator;
use crate::toll::Toll;
use crate::trial::Trial;

/// Share of a contact's energy, times the accuracy, by which a step may bring the springs out of
/// balance while a shorter one is to be had; it falls as the square of what is left to the end.
const SHORT_STEP: f64 = 0.1;
/// Share of a contact's energy by which they may be out of balance at all.
const UNBALANCED: f64 = 0.05;

/// The part of the energy that springs have `lost` sideways [J] that the body still owed them, of
/// `short` [J]: what nobody has paid for is nobody's loss.
pub(crate) fn unpaid(lost: f64, short: f64) -> f64 {
    lost.min(short.max(0.0))
}

impl Integrator {
    /// True for a trial that brings springs under faces further out of balance than a shorter one
    /// should; on surfaces at rest and without dashpots.
    pub(crate) fn grows_short(
        &self,
        body: &Body,
        surfaces: &[Placed<'_>],
        loads: &Loads,
        trial: &Trial,
    ) -> bool {
        if !self.has_sprung_columns() || !self.pays_alone() {
            return false;
        }
        let short = self.foreseen_short(body, loads, trial);
        let energy = self.contact_energy(body, surfaces);
        let room = (1.0 - self.short.abs() / (UNBALANCED * energy)).max(0.0);
        let allowed = SHORT_STEP * self.settings.accuracy * room * room * energy;
        short.abs() - self.short.abs() > allowed
    }

    /// An error when springs under faces are out of balance.
    pub(crate) fn check_balance(
        &self,
        body: &Body,
        surfaces: &[Placed<'_>],
    ) -> Result<(), PhysicsError> {
        let short = self.short;
        if short == 0.0 || !self.pays_alone() {
            return Ok(());
        }
        let energy = self.contact_energy(body, surfaces);
        match short.abs() > UNBALANCED * energy {
            true => Err(PhysicsError::Unbalanced { short, energy }),
            false => Ok(()),
        }
    }

    /// True where nobody but the body pays: dashpots do, carriers, and what leads a body.
    fn pays_alone(&self) -> bool {
        self.surfaces_rest() && !self.is_damped && !self.dynamics.is_immovable()
    }

    /// Energy that adhesion gives in a step more than its own falls by [J], of a body in `state` half-way
    /// through its push, before what faces do: springs under faces take it back. What flow does to it
    /// meanwhile is left out: it may be all that stops the body. Zero where a surface moves.
    pub(crate) fn given_over(&self, toll: &Toll, state: &State) -> f64 {
        if !self.adheres() || !self.has_sprung_columns() || !self.surfaces_rest() {
            return 0.0;
        }
        let (push, mut middle) = (&self.attraction.push, *state);
        self.apply(&toll.spring.scaled(0.5), &mut middle);
        let work =
            |velocity, spin| push.impulse.dot(velocity) + self.dynamics.work(&push.torque, spin);
        let given = work(&middle.velocity, &middle.spin);
        given + self.attraction.energy
    }

    /// Counts what loads exchange with the body over a trial.
    pub(crate) fn supply(&mut self, body: &Body, loads: &Loads, trial: &Trial) {
        self.supplied += loads.pull(&body.inertia).dot(&trial.shift).abs()
            + self.dynamics.work(&loads.torque, &trial.turn).abs();
    }

    /// Energy that the body brought, or that somebody gave it since, and that loads have exchanged
    /// with it [J].
    fn contact_energy(&self, body: &Body, surfaces: &[Placed<'_>]) -> f64 {
        self.energy_before.max(self.relative_energy(body, surfaces)) + self.supplied
    }
}
