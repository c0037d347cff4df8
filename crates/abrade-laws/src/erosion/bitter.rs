//! Deformation and cutting added up, after Bitter and after Neilson and Gilchrist: from memory.

use super::Impact;

/// Speed along the normal below which the contact is elastic, after Bitter: from memory [m/s].
///
/// pi^2 / (2 sqrt(10)) y^(5/2) rho^(-1/2) q^2, with the yield pressure y [Pa], the density rho of the
/// particle [kg/m3] and the compliance q = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [1/Pa].
pub fn bitter_threshold(yield_pressure: f64, density: f64, compliance: f64) -> f64 {
    let factor = std::f64::consts::PI.powi(2) / (2.0 * 10f64.sqrt());
    factor * yield_pressure.powf(2.5) / density.sqrt() * compliance * compliance
}

/// After Bitter: from memory, no paper of his was read here. The form of the deformation was seen in a
/// text by others.
///
/// Deformation takes m (U sin a - K)^2 / (2 epsilon). Cutting takes 2 m s (U cos a - s rho_c), with
/// s = C (U sin a - K)^2 / sqrt(U sin a), while the particle still slides as it leaves,
/// U cos a > 2 s rho_c; else m [U^2 cos^2 a - K1 (U sin a - K)^(3/2)] / (2 rho_c).
/// C = 0.288/y (rho/y)^(1/4), K1 = 0.82 y^2 (y/rho)^(1/4) q^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bitter {
    /// epsilon: work of deformation per volume [J/m3].
    pub deformation_energy: f64,
    /// rho_c: work of cutting per volume [J/m3].
    pub cutting_energy: f64,
    /// K: speed along the normal below which nothing wears [m/s]; see [`bitter_threshold`].
    pub threshold: f64,
    /// y: yield pressure of the surface [Pa].
    pub yield_pressure: f64,
    /// rho: density of the particle [kg/m3].
    pub density: f64,
    /// q: compliance of both [1/Pa].
    pub compliance: f64,
}

impl Bitter {
    /// Volume that an impact takes off [m3].
    pub fn volume(&self, impact: &Impact) -> f64 {
        let (sine, cosine) = impact.angle.sin_cos();
        let [down, along] = [sine, cosine].map(|part| part * impact.speed);
        let excess = (down - self.threshold).max(0.0);
        if excess == 0.0 {
            return 0.0;
        }
        impact.mass
            * (excess * excess / (2.0 * self.deformation_energy) + self.cut([down, along], excess))
    }

    /// Cut volume per mass [m3/kg].
    fn cut(&self, [down, along]: [f64; 2], excess: f64) -> f64 {
        let Self { cutting_energy, yield_pressure: y, density, compliance, .. } = *self;
        let depth = 0.288 / y * (density / y).powf(0.25) * excess * excess / down.sqrt();
        if along > 2.0 * depth * cutting_energy {
            return 2.0 * depth * (along - depth * cutting_energy);
        }
        let kept = 0.82 * (y * compliance).powi(2) * (y / density).powf(0.25) * excess.powf(1.5);
        (along * along - kept).max(0.0) / (2.0 * cutting_energy)
    }
}

/// After Neilson and Gilchrist: from memory.
///
/// m (U sin a - K)^2 / (2 epsilon), and m U^2 cos^2 a / (2 phi), times sin(pi a / (2 a0)) below a0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeilsonGilchrist {
    /// epsilon: work of deformation per volume [J/m3].
    pub deformation_energy: f64,
    /// phi: work of cutting per volume [J/m3].
    pub cutting_energy: f64,
    /// K: speed along the normal below which deformation takes nothing [m/s].
    pub threshold: f64,
    /// a0: angle above which the particle has stopped along the surface [rad].
    pub stopping_angle: f64,
}

impl NeilsonGilchrist {
    /// Volume that an impact takes off [m3].
    pub fn volume(&self, impact: &Impact) -> f64 {
        let (sine, cosine) = impact.angle.sin_cos();
        let excess = (impact.speed * sine - self.threshold).max(0.0);
        let along = impact.speed * cosine;
        let share = match impact.angle < self.stopping_angle {
            true => (std::f64::consts::FRAC_PI_2 * impact.angle / self.stopping_angle).sin(),
            false => 1.0,
        };
        let deformed = excess * excess / (2.0 * self.deformation_energy);
        impact.mass * (deformed + share * along * along / (2.0 * self.cutting_energy))
    }
}
