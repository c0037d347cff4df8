//! Wear along a slide: Archard's law, and grooves whose section a load determines.

use std::f64::consts::PI;

/// Archard (1953): V = K F s / H. Texts differ by 3 in what they call K; this one has no 3.
///
/// Archard, J. F. (1953). Contact and rubbing of flat surfaces. J. Appl. Phys. 24, 981-988.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Archard {
    /// K: 1e-8 to 1e-4 where wear is mild, 1e-3 to 1e-1 where it is abrasive.
    pub coefficient: f64,
    /// H of the softer surface [Pa].
    pub hardness: f64,
}

impl Archard {
    /// Volume that is worn [m3] along a way [m] under a load [N].
    pub fn volume(&self, load: f64, way: f64) -> f64 {
        self.coefficient * load * way / self.hardness
    }

    /// Depth that is worn [m] along a way [m] under a pressure [Pa].
    pub fn depth(&self, pressure: f64, way: f64) -> f64 {
        self.coefficient * pressure * way / self.hardness
    }
}

/// Depth [m] polished off under a pressure [Pa] along a way [m], after Preston: from memory. The `factor`
/// [1/Pa] is what Archard's law has as K / H.
pub fn preston_depth(factor: f64, pressure: f64, way: f64) -> f64 {
    factor * pressure * way
}

/// Half width over radius below which a segment is summed as a series.
const SMALL: f64 = 1e-3;

/// Section [m2] of the groove that a rigid cone under a load [N] ploughs into a hardness [Pa]:
/// 2 F tan(theta) / (pi H), with theta [rad] from the surface to the flank.
///
/// The front half of the contact bears: F = H pi a^2 / 2, and the section of a groove of half width a is
/// a^2 tan theta. The volume is the section times the way (Rabinowicz 1965).
pub fn cone_section(load: f64, hardness: f64, theta: f64) -> f64 {
    2.0 * load * theta.tan() / (PI * hardness)
}

/// Section [m2] of the groove that a rigid ball of a radius [m] ploughs under a load [N] into a
/// hardness [Pa]; that of its full half circle where it would have to sink deeper than its centre.
///
/// The front half of the contact bears: F = H pi a^2 / 2. The section is the segment of the circle
/// below the chord 2 a.
pub fn groove_section(load: f64, hardness: f64, radius: f64) -> f64 {
    let half = (2.0 * load / (PI * hardness)).sqrt().min(radius);
    let sine = half / radius;
    let segment = match sine < SMALL {
        true => sine.powi(3) * (2.0 / 3.0 + sine * sine / 5.0),
        false => sine.asin() - sine * (1.0 - sine * sine).sqrt(),
    };
    radius * radius * segment
}
