//! Laws of powers, whose factors are to be fitted: after Huang and others, and after Evans and others. From
//! memory.

use super::Impact;

/// After Huang and others, in jets: A d^0.5 U^2.375 cos^2 a (sin a)^0.375 + B (U sin a)^2.3.
///
/// From memory: form and exponents; the factors hold what material and particles are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Huang {
    /// A of the cut, with lengths in m and speeds in m/s.
    pub cutting: f64,
    /// B of the deformation, with speeds in m/s.
    pub deformation: f64,
    /// d: diameter of the particles [m].
    pub diameter: f64,
}

impl Huang {
    /// Mass taken off over the mass of the particles [kg/kg].
    pub fn ratio(&self, impact: &Impact) -> f64 {
        let (sine, cosine) = impact.angle.sin_cos();
        let cut =
            self.diameter.sqrt() * impact.speed.powf(2.375) * cosine * cosine * sine.powf(0.375);
        self.cutting * cut + self.deformation * (impact.speed * sine).powf(2.3)
    }
}

/// After Evans and others, brittle surfaces struck along their normal:
/// V = factor U^(19/6) R^(11/3) rho^(19/12) K_c^(-4/3) H^(-1/4). From memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evans {
    /// A pure number, to be fitted.
    pub factor: f64,
    /// R: radius of the particle [m].
    pub radius: f64,
    /// rho: density of the particle [kg/m3].
    pub density: f64,
    /// K_c: fracture toughness of the surface [Pa m^0.5].
    pub toughness: f64,
    /// H: hardness of the surface [Pa].
    pub hardness: f64,
}

impl Evans {
    /// Volume that an impact at a `speed` [m/s] along the normal takes off [m3].
    pub fn volume(&self, speed: f64) -> f64 {
        let Self { factor, radius, density, toughness, hardness } = *self;
        factor
            * speed.powf(19.0 / 6.0)
            * radius.powf(11.0 / 3.0)
            * density.powf(19.0 / 12.0)
            * toughness.powf(-4.0 / 3.0)
            * hardness.powf(-0.25)
    }
}
