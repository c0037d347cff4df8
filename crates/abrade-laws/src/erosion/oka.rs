//! The law of Oka, Okamura & Yoshida (2005).

use super::Impact;

/// Volume per mass of particles, from the hardness of the surface, by constants of the particles.
///
/// Oka, Y. I., Okamura, K. & Yoshida, T. (2005). Practical estimation of erosion damage caused by solid
/// particle impact, parts 1 and 2. Wear 259, 95-109.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oka {
    /// Hv: Vickers hardness of the surface [Pa].
    pub hardness: f64,
    /// Diameter of the particles [m].
    pub diameter: f64,
    /// Constants of the particles.
    pub grit: Grit,
}

/// What particles of a kind are for the law; exponents take the hardness in GPa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grit {
    /// K [mm3/kg].
    pub factor: f64,
    /// k1, of the hardness.
    pub of_hardness: f64,
    /// k2, of the speed: a factor, and a power of the hardness.
    pub of_speed: [f64; 2],
    /// k3, of the diameter.
    pub of_diameter: f64,
    /// n1, of sin alpha: s1 and q1 of s Hv^q.
    pub of_sine: [f64; 2],
    /// n2, of 1 + Hv (1 - sin alpha): s2 and q2.
    pub of_bracket: [f64; 2],
    /// V' [m/s] and D' [m].
    pub reference: [f64; 2],
}

impl Grit {
    /// Quartz sand.
    pub const QUARTZ: Self = Self {
        factor: 65.0,
        of_hardness: -0.12,
        of_speed: [2.3, 0.038],
        of_diameter: 0.19,
        of_sine: [0.71, 0.14],
        of_bracket: [2.4, -0.94],
        reference: [104.0, 326e-6],
    };
    /// Silicon carbide.
    pub const CARBIDE: Self = Self {
        factor: 45.0,
        of_hardness: -0.05,
        of_speed: [3.0, 0.085],
        of_diameter: 0.19,
        of_sine: [0.71, 0.14],
        of_bracket: [2.8, -1.0],
        reference: [99.0, 326e-6],
    };
    /// Glass beads.
    pub const GLASS: Self = Self {
        factor: 27.0,
        of_hardness: -0.16,
        of_speed: [2.1, 0.0],
        of_diameter: 0.19,
        of_sine: [2.8, 0.41],
        of_bracket: [2.6, -1.46],
        reference: [100.0, 200e-6],
    };
}

impl Oka {
    /// Volume over the mass of the particles [m3/kg].
    pub fn volume_per_mass(&self, impact: &Impact) -> f64 {
        let Self { hardness, diameter, grit } = *self;
        let hardness = 1e-9 * hardness;
        let power = |[factor, power]: [f64; 2]| factor * hardness.powf(power);
        let [speed, size] = grit.reference;
        let straight = grit.factor
            * hardness.powf(grit.of_hardness)
            * (impact.speed / speed).powf(power(grit.of_speed))
            * (diameter / size).powf(grit.of_diameter);
        let sine = impact.angle.sin();
        let bracket = 1.0 + hardness * (1.0 - sine);
        1e-9 * straight * sine.powf(power(grit.of_sine)) * bracket.powf(power(grit.of_bracket))
    }
}
