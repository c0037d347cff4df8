//! Two bodies as their contact sees them: one reduced radius, one modulus.

use super::{ContactError, above_zero};

/// One of the bodies, near the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Radius [m]; infinite for a flat.
    pub radius: f64,
    /// Young's modulus [Pa]; infinite for a rigid body.
    pub young: f64,
    /// Poisson's ratio [-].
    pub poisson: f64,
}

impl Side {
    /// A flat that does not give way.
    pub const RIGID_FLAT: Self = Self { radius: f64::INFINITY, young: f64::INFINITY, poisson: 0.0 };
}

/// A reduced radius and a contact modulus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    radius: f64,
    modulus: f64,
}

impl Pair {
    /// A pair by its reduced `radius` R [m] and its contact `modulus` E* [Pa].
    ///
    /// # Errors
    /// One of them is not finite or not above zero.
    pub fn new(radius: f64, modulus: f64) -> Result<Self, ContactError> {
        Ok(Self { radius: above_zero("radius", radius)?, modulus: above_zero("modulus", modulus)? })
    }

    /// The pair of two bodies: 1/R = 1/R1 + 1/R2, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    ///
    /// Johnson, K. L. (1985). Contact mechanics, section 4.2. A pair must have a sphere and must give way.
    ///
    /// # Errors
    /// A radius or a modulus that is not above zero, a Poisson's ratio out of -1 to 0.5; two flats, two
    /// rigid bodies.
    pub fn of(sides: [Side; 2]) -> Result<Self, ContactError> {
        let [mut curvature, mut compliance] = [0.0; 2];
        for Side { radius, young, poisson } in sides {
            for (name, value) in [("radius", radius), ("young", young)] {
                // Infinite is allowed.
                above_zero(name, value.min(f64::MAX))?;
            }
            if !(-1.0..=0.5).contains(&poisson) {
                let allowed = "a number from -1 to 0.5";
                return Err(ContactError::Refused { name: "poisson", value: poisson, allowed });
            }
            curvature += 1.0 / radius;
            compliance += (1.0 - poisson * poisson) / young;
        }
        Self::new(1.0 / curvature, 1.0 / compliance)
    }

    /// Reduced radius R [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Contact modulus E* [Pa].
    pub fn modulus(&self) -> f64 {
        self.modulus
    }
}
