//! Erosion: what one particle's impact takes off.

mod ahlert;
mod dnv;
mod ecrc;
mod finnie;
mod oka;

pub use ahlert::Ahlert;
pub use dnv::Dnv;
pub use ecrc::Ecrc;
pub use finnie::{Finnie1960, Finnie1972};
pub use oka::{Grit, Oka};

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

/// Brinell hardness to the power that both laws of the Erosion/Corrosion Research Center give it.
const BRINELL_POWER: f64 = -0.59;
