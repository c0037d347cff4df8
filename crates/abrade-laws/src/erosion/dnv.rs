//! The law of the recommended practice DNV RP-O501.

use super::Impact;

/// Mass taken off over the mass of the particles, K U^n F(alpha); ductile surfaces.
///
/// DNV RP-O501, Erosive wear in piping systems.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dnv {
    /// K, with the speed in m/s.
    pub factor: f64,
    /// n.
    pub power: f64,
}

/// A_1 to A_8 of F = sum A_i alpha^i.
const ANGLE: [f64; 8] = [9.370, -42.295, 110.864, -175.804, 170.137, -98.398, 31.211, -4.170];

impl Dnv {
    /// Carbon steel.
    pub const STEEL: Self = Self { factor: 2e-9, power: 2.6 };
    /// Aluminium.
    pub const ALUMINIUM: Self = Self { factor: 5.8e-9, power: 2.3 };

    /// Mass taken off over the mass of the particles [kg/kg].
    pub fn ratio(&self, impact: &Impact) -> f64 {
        let angle = ANGLE.iter().rev().fold(0.0, |sum, a| (sum + a) * impact.angle);
        self.factor * impact.speed.powf(self.power) * angle
    }
}
