//! Cutting and deformation after Arabnejad and others, for steels: the form as in a program by others, the
//! constants from memory.

use super::Impact;

/// C F_s U^2.41 f(a) + D (U sin a - U0)^2, f = sin a (2 K cos a - sin a) / (2 K^2) up to tan a = K,
/// cos^2 a / 2 above.
///
/// From memory: the constants, and that F_s weighs the cut alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arabnejad {
    /// C, with speeds in m/s.
    pub cutting: f64,
    /// D, with speeds in m/s.
    pub deformation: f64,
    /// K: force along the normal over that along the surface.
    pub force_ratio: f64,
    /// U0: speed along the normal below which deformation takes nothing [m/s].
    pub threshold: f64,
    /// F_s: 1 for angular grains, 0.53 for rounded ones, 0.2 for round ones.
    pub sharpness: f64,
}

const SPEED_POWER: f64 = 2.41;

impl Arabnejad {
    /// Carbon steel 1018 under angular grains.
    pub const CARBON_STEEL: Self = Self {
        cutting: 5.9e-8,
        deformation: 4.25e-8,
        force_ratio: 0.5,
        threshold: 5.5,
        sharpness: 1.0,
    };

    /// Mass taken off over the mass of the particles [kg/kg].
    pub fn ratio(&self, impact: &Impact) -> f64 {
        let (sine, cosine) = impact.angle.sin_cos();
        let k = self.force_ratio;
        let cut = match sine <= k * cosine {
            true => sine * (2.0 * k * cosine - sine) / (2.0 * k * k),
            false => 0.5 * cosine * cosine,
        };
        let excess = (impact.speed * sine - self.threshold).max(0.0);
        self.cutting * self.sharpness * impact.speed.powf(SPEED_POWER) * cut
            + self.deformation * excess * excess
    }
}
