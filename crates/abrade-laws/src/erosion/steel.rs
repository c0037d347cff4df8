//! The laws of the Erosion/Corrosion Research Center and of Ahlert and McLaury, for steels.

use super::Impact;

/// Mass taken off over the mass of the particles: factor BH^-0.59 F_s U^n f(alpha), n and f by the
/// curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steel {
    /// Whose power of the speed and curve over the angle.
    pub curve: SteelCurve,
    /// C or A, with the speed in m/s.
    pub factor: f64,
    /// BH: Brinell hardness of the surface [kgf/mm2].
    pub brinell: f64,
    /// F_s: 1 for angular grains, 0.53 for rounded ones, 0.2 for round ones.
    pub sharpness: f64,
}

/// How erosion of steels goes with speed and angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SteelCurve {
    /// U^2.41 and a polynomial of the fifth degree.
    ///
    /// Zhang, Y., Reuterfors, E. P., McLaury, B. S., Shirazi, S. A. & Rybicki, E. F. (2007). Comparison
    /// of computed and measured particle velocities and erosion in water and air flows. Wear 263, 330-338.
    Zhang,
    /// U^1.73; a' alpha^2 + b alpha below 15 degrees and x cos^2 alpha sin(w alpha) + y sin^2 alpha + z
    /// above; the two differ by 0.011 there.
    Ahlert,
}

const BRINELL_POWER: f64 = -0.59;
/// Coefficients of alpha to alpha^5.
const POLYNOMIAL: [f64; 5] = [5.4, -10.11, 10.93, -6.33, 1.42];
/// Angle up to which the parabola holds [rad]: 15 degrees.
const LIMIT: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// a' and b.
const BELOW: [f64; 2] = [-33.4, 17.9];
/// w, x, y, z.
const ABOVE: [f64; 4] = [1.0, 1.239, -1.192, 2.167];

impl SteelCurve {
    /// C or A of the law; that of `Ahlert` is from memory.
    pub const fn factor(self) -> f64 {
        match self {
            Self::Zhang => 2.17e-7,
            Self::Ahlert => 1.559e-6,
        }
    }

    /// n.
    fn power(self) -> f64 {
        match self {
            Self::Zhang => 2.41,
            Self::Ahlert => 1.73,
        }
    }

    /// f at an angle [rad].
    fn of_angle(self, angle: f64) -> f64 {
        match self {
            Self::Zhang => POLYNOMIAL.iter().rev().fold(0.0, |sum, a| (sum + a) * angle),
            Self::Ahlert if angle < LIMIT => (BELOW[0] * angle + BELOW[1]) * angle,
            Self::Ahlert => {
                let [w, x, y, z] = ABOVE;
                let (sine, cosine) = angle.sin_cos();
                x * cosine * cosine * (w * angle).sin() + y * sine * sine + z
            }
        }
    }
}

/// Newtons per kilogram-force over square millimetres per square metre: Brinell's unit of pressure [Pa].
const BRINELL_UNIT: f64 = 9.806_65e6;

impl Steel {
    /// BH [kgf/mm2] of a surface, if its hardness [Pa] is that number's.
    pub fn brinell_of(hardness: f64) -> f64 {
        hardness / BRINELL_UNIT
    }

    /// Mass taken off over the mass of the particles [kg/kg].
    pub fn ratio(&self, impact: &Impact) -> f64 {
        let Self { curve, factor, brinell, sharpness } = *self;
        let surface = factor * brinell.powf(BRINELL_POWER);
        surface * sharpness * impact.speed.powf(curve.power()) * curve.of_angle(impact.angle)
    }
}
