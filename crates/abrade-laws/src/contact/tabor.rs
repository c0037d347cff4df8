//! Which model of an adhesive contact holds.

use std::f64::consts::PI;

use super::{ContactError, Pair, above_zero};

/// Lambda over Tabor's parameter, where the strength of the adhesion is the largest attraction of
/// Lennard-Jones surfaces, 16 w / (9 sqrt(3) z0); the digits are Maugis'.
pub const LAMBDA_OVER_TABOR: f64 = 1.157;

/// Tabor's parameter [-]: mu = (R w^2 / (E*^2 z0^3))^(1/3), how far adhesion pulls the bodies out of shape
/// over the `distance` z0 [m] at which they attract each other, with a work of `adhesion` w [J/m2].
///
/// Tabor, D. (1977). J. Colloid Interface Sci. 58, 2-13.
///
/// # Errors
/// An argument that is not finite or not above zero.
pub fn tabor(pair: &Pair, adhesion: f64, distance: f64) -> Result<f64, ContactError> {
    let w = above_zero("adhesion", adhesion)? / pair.modulus();
    let z0 = above_zero("distance", distance)?;
    Ok((pair.radius() * w * w).cbrt() / z0)
}

/// Maugis' parameter [-]: lambda = 2 sigma0 (R / (pi w K^2))^(1/3) with K = 4 E*/3, for a work of `adhesion`
/// w [J/m2] and a `strength` sigma0 of the adhesion [Pa].
///
/// Maugis, D. (1992). J. Colloid Interface Sci. 150, 243-269.
///
/// # Errors
/// An argument that is not finite or not above zero.
pub fn maugis_lambda(pair: &Pair, adhesion: f64, strength: f64) -> Result<f64, ContactError> {
    let w = above_zero("adhesion", adhesion)?;
    let k = 4.0 / 3.0 * pair.modulus();
    let sigma = above_zero("strength", strength)?;
    Ok(2.0 * sigma / k * (pair.radius() * k / (PI * w)).cbrt())
}

/// The model that holds.
///
/// The limits 0.1 and 5 of Tabor's parameter are those in common use, after the map of Johnson, K. L. &
/// Greenwood, J. A. (1997), J. Colloid Interface Sci. 192, 326-333: from memory, the paper was not read
/// here. At them the pull-off force of Maugis and Dugdale is 3 % off DMT's, 0.3 % off JKR's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advice {
    /// Below 0.1: adhesion does not deform the bodies ([`super::Dmt`]; [`super::Bradley`] where nothing
    /// else does either).
    Dmt,
    /// Between: [`super::MaugisDugdale`].
    MaugisDugdale,
    /// Above 5: [`super::Jkr`].
    Jkr,
}

impl Advice {
    /// Largest Tabor parameter for DMT, least one for JKR.
    pub const LIMITS: [f64; 2] = [0.1, 5.0];

    /// The advice for a Tabor parameter.
    pub fn of(tabor: f64) -> Self {
        match tabor {
            mu if mu < Self::LIMITS[0] => Self::Dmt,
            mu if mu > Self::LIMITS[1] => Self::Jkr,
            _ => Self::MaugisDugdale,
        }
    }

    /// Name of the model in the catalogue of laws.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dmt => "dmt",
            Self::MaugisDugdale => "maugis-dugdale",
            Self::Jkr => "jkr",
        }
    }
}
