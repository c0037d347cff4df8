//! Erosion: what one particle's impact takes off.

mod arabnejad;
mod bitter;
mod dnv;
mod finnie;
mod oka;
mod powers;
mod steel;
mod tabakoff;

pub use arabnejad::Arabnejad;
pub use bitter::{Bitter, NeilsonGilchrist, bitter_threshold};
pub use dnv::Dnv;
pub use finnie::{Finnie1960, Finnie1972};
pub use oka::{Grit, Oka};
pub use powers::{Evans, Huang};
pub use steel::{Steel, SteelCurve};
pub use tabakoff::TabakoffGrant;

/// The impact of one particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Mass of the particle [kg].
    pub mass: f64,
    /// Speed U [m/s].
    pub speed: f64,
    /// Angle alpha from the surface [rad].
    pub angle: f64,
}
