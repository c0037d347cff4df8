//! The law of Ahlert and McLaury, for steels.

use super::{BRINELL_POWER, Impact};

/// Mass taken off over the mass of the particles, A BH^-0.59 F_s U^1.73 f(alpha), with f =
/// a' alpha^2 + b alpha below a limit and x cos^2 alpha sin(w alpha) + y sin^2 alpha + z above; the two
/// differ by 0.011 there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ahlert {
    /// A, with the speed in m/s. From memory.
    pub factor: f64,
    /// BH: Brinell hardness of the surface [kgf/mm2].
    pub brinell: f64,
    /// F_s: 1 for angular grains, 0.53 for rounded ones, 0.2 for round ones.
    pub sharpness: f64,
}

/// Angle up to which the parabola holds [rad]: 15 degrees.
const LIMIT: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// a' and b.
const BELOW: [f64; 2] = [-33.4, 17.9];
/// w, x, y, z.
const ABOVE: [f64; 4] = [1.0, 1.239, -1.192, 2.167];
const SPEED_POWER: f64 = 1.73;

impl Ahlert {
    /// A. From memory.
    pub const FACTOR: f64 = 1.559e-6;

    /// Mass taken off over the mass of the particles [kg/kg].
    pub fn ratio(&self, impact: &Impact) -> f64 {
        let angle = impact.angle;
        let [square, linear] = BELOW;
        let [w, x, y, z] = ABOVE;
        let of_angle = match angle < LIMIT {
            true => (square * angle + linear) * angle,
            false => {
                let (sine, cosine) = angle.sin_cos();
                x * cosine * cosine * (w * angle).sin() + y * sine * sine + z
            }
        };
        let surface = self.factor * self.brinell.powf(BRINELL_POWER);
        surface * self.sharpness * impact.speed.powf(SPEED_POWER) * of_angle
    }
}
