//! What a sweeping face pays for the volume it removes.

use nalgebra::Vector3;

use crate::column_law::Step;
use crate::node_law::STEEP;
use crate::sweep::Entry;

/// Energy per volume that a face pays.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "state", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Price {
    pub hardness: f64,
    /// mu_a H [Pa] for `CapozzaHanley`; None for `NormalPressure`.
    pub shear_hardness: Option<f64>,
    pub friction: f64,
}

impl Price {
    /// Energy per volume [Pa] charged to a face of outward `normal`, and the lateral share of it.
    ///
    /// `NormalPressure`: H. `CapozzaHanley`: its balance is sum f_z ds with f_z = a_s H / c, so a
    /// down face pays H / c for its normal advance; for its lateral advance it pays what the
    /// lateral gate lets through, mu_a H / (m.t + mu c); a vertical or undercut face pays mu_a H.
    #[inline]
    pub(crate) fn of(
        &self,
        entry: &Entry,
        n: &Vector3<f64>,
        step: &Step<'_>,
        arm: &Vector3<f64>,
    ) -> (f64, f64) {
        let Some(shear) = self.shear_hardness else { return (self.hardness, 0.0) };
        let m = entry.normal;
        let cosine = -m.dot(n);
        if cosine <= STEEP {
            return (shear, 1.0);
        }
        let motion = step.motion;
        let split = motion.advance(arm, &m) * motion.dt;
        let down = -split.dot(n) * cosine / entry.displacement;
        let lateral = 1.0 - down.clamp(0.0, 1.0);
        let attack = m.dot(&step.heading).max(0.0);
        let normal_price = self.hardness / cosine;
        let lateral_price = (shear / (attack + self.friction * cosine)).min(normal_price);
        let share = if attack > 0.0 { lateral } else { 0.0 };
        (normal_price + share * (lateral_price - normal_price), share)
    }
}
