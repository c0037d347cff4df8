//! Finnie's laws of a sharp particle that cuts a ductile surface.

use super::Impact;

/// Finnie (1960): the particle does not turn as it cuts. It leaves the surface while it still moves
/// along it below tan alpha = K / 6, and stops in it above.
///
/// Finnie, I. (1960). Erosion of surfaces by solid particles. Wear 3, 87-103.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finnie1960 {
    /// p: plastic flow pressure of the surface [Pa].
    pub flow_pressure: f64,
    /// c: share of the particles that cut.
    pub cutting_share: f64,
    /// psi: length of the contact over the depth of the cut.
    pub depth_ratio: f64,
    /// K: vertical over horizontal force.
    pub force_ratio: f64,
}

impl Finnie1960 {
    /// With all particles cutting, psi = 2 and K = 2.
    pub fn of(flow_pressure: f64) -> Self {
        Self { flow_pressure, cutting_share: 1.0, depth_ratio: 2.0, force_ratio: 2.0 }
    }

    /// Volume that an impact takes off [m3].
    pub fn volume(&self, impact: &Impact) -> f64 {
        let Self { flow_pressure, cutting_share, depth_ratio, force_ratio } = *self;
        let Impact { mass, speed, angle } = *impact;
        let scale =
            cutting_share * mass * speed * speed / (flow_pressure * depth_ratio * force_ratio);
        let (sine, cosine) = angle.sin_cos();
        scale
            * match sine <= force_ratio / 6.0 * cosine {
                true => (2.0 * angle).sin() - 6.0 / force_ratio * sine * sine,
                false => force_ratio * cosine * cosine / 6.0,
            }
    }

    /// Angle at which most is taken off [rad]: tan 2 alpha = K / 3.
    pub fn peak_angle(&self) -> f64 {
        0.5 * (self.force_ratio / 3.0).atan()
    }
}

/// Finnie (1972): the particle turns as it cuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finnie1972 {
    /// p: plastic flow pressure of the surface [Pa].
    pub flow_pressure: f64,
    /// c: share of the particles that cut.
    pub cutting_share: f64,
    /// K: vertical over horizontal force.
    pub force_ratio: f64,
    /// m r^2 / I of the particle; 2.5 for a ball.
    pub inertia_ratio: f64,
}

impl Finnie1972 {
    /// With a tenth of the particles cutting, K = 2, and balls.
    pub fn of(flow_pressure: f64) -> Self {
        Self { flow_pressure, cutting_share: 0.1, force_ratio: 2.0, inertia_ratio: 2.5 }
    }

    /// Volume that an impact takes off [m3].
    pub fn volume(&self, impact: &Impact) -> f64 {
        let Impact { mass, speed, angle } = *impact;
        let turning = 1.0 + self.inertia_ratio;
        let p = self.force_ratio / turning;
        let a = self.cutting_share * mass * speed * speed / (4.0 * self.flow_pressure * turning);
        let (sine, cosine) = angle.sin_cos();
        match sine > 0.5 * p * cosine {
            true => a * cosine * cosine,
            false => 2.0 * a / p * ((2.0 * angle).sin() - 2.0 / p * sine * sine),
        }
    }
}
