//! Whether springs under faces are in balance with their body: what they take on or give back is
//! paid by it, step by step, as far as their impulse can. It cannot where friction would turn a slip
//! back within the step, nor where a face comes upon a whole column at once.

use crate::body::Body;
use crate::encounter::{Loads, Placed};
use crate::error::PhysicsError;
use crate::integrate::Integrator;
use crate::trial::Trial;

/// Share of a contact's energy, times the accuracy, by which a step may bring the springs out of
/// balance while a shorter one is to be had.
const SHORT_STEP: f64 = 0.1;
/// Share of a contact's energy by which they may be out of balance at all.
const UNBALANCED: f64 = 0.05;

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
        let is_led = self.dynamics.is_immovable();
        if is_led || self.is_damped || !self.has_sprung_columns() || !are_at_rest(surfaces) {
            return false;
        }
        let short = self.foreseen_short(body, loads, trial);
        let allowed = SHORT_STEP * self.settings.accuracy * self.contact_energy();
        short.abs() - self.short.abs() > allowed
    }

    /// An error when springs under faces are out of balance.
    pub(crate) fn check_balance(&self, surfaces: &[Placed<'_>]) -> Result<(), PhysicsError> {
        let (short, energy) = (self.short, self.contact_energy());
        // What leads a body pays whatever it takes.
        let is_led = self.dynamics.is_immovable();
        match short.abs() > UNBALANCED * energy && are_at_rest(surfaces) && !is_led {
            true => Err(PhysicsError::Unbalanced { short, energy }),
            false => Ok(()),
        }
    }

    /// Counts what loads exchange with the body over a trial.
    pub(crate) fn supply(&mut self, body: &Body, loads: &Loads, trial: &Trial) {
        self.supplied += loads.pull(&body.inertia).dot(&trial.shift).abs()
            + self.dynamics.work(&loads.torque, &trial.turn).abs();
    }

    /// Energy that the body brought, and that loads have exchanged with it since [J].
    fn contact_energy(&self) -> f64 {
        self.energy_before + self.supplied
    }
}

fn are_at_rest(surfaces: &[Placed<'_>]) -> bool {
    surfaces.iter().all(|placed| placed.carrier.is_none())
}
