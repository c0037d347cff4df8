//! The law of the Erosion/Corrosion Research Center, for steels.

use super::{BRINELL_POWER, Impact};

/// Mass taken off over the mass of the particles, C BH^-0.59 F_s U^2.41 F(alpha).
///
/// Zhang, Y., Reuterfors, E. P., McLaury, B. S., Shirazi, S. A. & Rybicki, E. F. (2007). Comparison of
/// computed and measured particle velocities and erosion in water and air flows. Wear 263, 330-338.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ecrc {
    /// C, with the speed in m/s.
    pub factor: f64,
    /// BH: Brinell hardness of the surface [kgf/mm2].
    pub brinell: f64,
    /// F_s: 1 for angular grains, 0.53 for rounded ones, 0.2 for round ones.
    pub sharpness: f64,
}

/// Coefficients of alpha to alpha^5.
const ANGLE: [f64; 5] = [5.4, -10.11, 10.93, -6.33, 1.42];
const SPEED_POWER: f64 = 2.41;

impl Ecrc {
    /// C of steels.
    pub const FACTOR: f64 = 2.17e-7;

    /// Mass taken off over the mass of the particles [kg/kg].
    pub fn ratio(&self, impact: &Impact) -> f64 {
        let angle = ANGLE.iter().rev().fold(0.0, |sum, a| (sum + a) * impact.angle);
        let surface = self.factor * self.brinell.powf(BRINELL_POWER);
        surface * self.sharpness * impact.speed.powf(SPEED_POWER) * angle
    }
}
