//! Where the energy is and where it went, per metre of thickness.

/// Energies [J], as sums since the start except for `kinetic` and `elastic`, which are those of now.
///
/// Without flow, failure, viscosity and drag the sum is conserved to the order of the step squared.
/// With flow the residual is the work that the averaged return of a pair does not share with the
/// elements at its ends. The potential of adhesion between parted faces, up to sigma_0 S0 delta a pair,
/// is not told: with a range of 1 nm it is a hundredth of what such a face held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Of motion and spin.
    pub kinetic: f64,
    /// Of linked pairs and elements.
    pub elastic: f64,
    /// Plastic work of elements.
    pub plastic: f64,
    /// Lost to the dashpots of linked pairs.
    pub viscous: f64,
    /// Lost to the drag of the bases, less what that does on bodies that it leads.
    pub drag: f64,
    /// What pairs and the mean stress of their ends held for links that failed, less what was gained
    /// where faces came together.
    pub released: f64,
    /// Work of what is held and led.
    pub drive: f64,
}

impl Ledger {
    /// What is there and what went, less what came in [J]: constant when every energy is told.
    pub fn balance(&self) -> f64 {
        self.kinetic + self.elastic + self.plastic + self.viscous + self.drag + self.released
            - self.drive
    }
}
