//! The energy ledger: kept only in runs that ask for it.

/// Energies of one body's contacts [J]. Every wear increment is >= 0, and every friction increment
/// but with `NormalPressure`, where a node that sinks faster than a body goes by drags it along.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub struct Ledger {
    /// Stored in the springs now.
    pub elastic: f64,
    /// Stored in the springs when the ledger was opened.
    pub elastic_start: f64,
    /// Dissipated by slip; with `NormalPressure` what friction took from the body, its work on the
    /// drops included.
    pub friction: f64,
    /// Work of the nodes' forces on their drops (Eqs. 21, 22); with `NormalPressure` that of the
    /// pressure alone: H times the volume, and more where a node gives way late.
    pub wear: f64,
    /// Dissipated by the damping of loads and by the dashpots of surfaces with a restitution.
    pub damping: f64,
    /// Done by gravity, loads and drives.
    pub external_work: f64,
    /// Change that `HertzNodes` makes because its tangential history is not conservative, and
    /// elastic energy of contacts that `swept` lost sideways, or that were let go.
    pub history: f64,
    /// Of adhesion, since the ledger was opened: below zero while bodies adhere, zero once they have
    /// parted.
    pub adhesion: f64,
    /// Change of the kinetic energy since the ledger was opened.
    pub kinetic_change: f64,
}

impl Ledger {
    /// What time integration has added: the run's honest error monitor.
    pub fn numerical(&self) -> f64 {
        self.external_work + self.elastic_start
            - (self.kinetic_change
                + self.elastic
                + self.friction
                + self.wear
                + self.damping
                + self.history
                + self.adhesion)
    }
}

impl std::ops::AddAssign for Ledger {
    fn add_assign(&mut self, other: Self) {
        self.elastic += other.elastic;
        self.elastic_start += other.elastic_start;
        self.friction += other.friction;
        self.wear += other.wear;
        self.damping += other.damping;
        self.external_work += other.external_work;
        self.history += other.history;
        self.adhesion += other.adhesion;
        self.kinetic_change += other.kinetic_change;
    }
}

impl std::ops::SubAssign for Ledger {
    fn sub_assign(&mut self, other: Self) {
        self.elastic -= other.elastic;
        self.elastic_start -= other.elastic_start;
        self.friction -= other.friction;
        self.wear -= other.wear;
        self.damping -= other.damping;
        self.external_work -= other.external_work;
        self.history -= other.history;
        self.adhesion -= other.adhesion;
        self.kinetic_change -= other.kinetic_change;
    }
}
