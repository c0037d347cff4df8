//! Erosion of turbine blades after Tabakoff and Grant: from memory.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Impact;

/// After Tabakoff and Grant: from memory, no paper of theirs was read here.
///
/// 1e-3 {[1 + k sin(pi a / (2 a0))]^2 (U/V1)^2 cos^2 a [1 - (1 - U sin a/V3)^2] + (U sin a/V2)^4}, with
/// k = k12 up to 2 a0 and none above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TabakoffGrant {
    /// k12.
    pub k12: f64,
    /// V1, V2, V3 [m/s].
    pub speeds: [f64; 3],
    /// a0: angle of the most erosion [rad].
    pub peak_angle: f64,
}

impl TabakoffGrant {
    /// Quartz on aluminium.
    pub const ALUMINIUM: Self =
        Self { k12: 0.585, speeds: [159.11, 194.75, 190.5], peak_angle: 25.0 * PI / 180.0 };
    /// Quartz on steel.
    pub const STEEL: Self =
        Self { k12: 0.293_328, speeds: [123.72, 352.99, 179.29], peak_angle: 30.0 * PI / 180.0 };

    /// Mass taken off over the mass of the particles [kg/kg].
    pub fn ratio(&self, impact: &Impact) -> f64 {
        let Impact { speed, angle, .. } = *impact;
        let [v1, v2, v3] = self.speeds;
        let (sine, cosine) = angle.sin_cos();
        let wave = match angle <= 2.0 * self.peak_angle {
            true => self.k12 * (FRAC_PI_2 * angle / self.peak_angle).sin(),
            false => 0.0,
        };
        let kept = 1.0 - speed * sine / v3;
        let along = ((1.0 + wave) * speed / v1 * cosine).powi(2) * (1.0 - kept * kept);
        // The law gives milligrams per gram.
        1e-3 * (along + (speed * sine / v2).powi(4))
    }
}
