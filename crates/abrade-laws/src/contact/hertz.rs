//! Hertz' contact: elastic, without friction and without adhesion.

use super::{Before, Contact, ContactError, ContactModel, Pair, Parting, finite};

/// F = (4/3) E* sqrt(R) d^1.5, a^2 = R d.
///
/// Hertz, H. (1882). J. reine angew. Math. 92, 156-171, as in Johnson, Contact mechanics (1985),
/// section 4.2. For contacts that are small beside the bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hertz {
    pair: Pair,
}

/// Displacement over radius up to which the curve is drawn where nothing else gives a length.
const USUAL_SHARE: f64 = 1e-3;

impl Hertz {
    /// The contact of a pair.
    pub fn new(pair: Pair) -> Self {
        Self { pair }
    }

    /// Radius of the area under a load [m]: a^3 = 3 F R / (4 E*).
    ///
    /// # Errors
    /// A load [N] that is negative or not finite.
    pub fn radius_under(&self, load: f64) -> Result<f64, ContactError> {
        if !(load.is_finite() && load >= 0.0) {
            let allowed = "a finite number, zero or above";
            return Err(ContactError::Refused { name: "load", value: load, allowed });
        }
        Ok((0.75 * load * self.pair.radius() / self.pair.modulus()).cbrt())
    }

    /// Largest pressure, in the middle, under a load [Pa]: 3 F / (2 pi a^2).
    ///
    /// # Errors
    /// A load [N] that is negative or not finite.
    pub fn peak_pressure(&self, load: f64) -> Result<f64, ContactError> {
        let radius = self.radius_under(load)?;
        Ok(2.0 * self.pair.modulus() * radius / (std::f64::consts::PI * self.pair.radius()))
    }

    /// Force at a displacement of zero and above [N].
    pub(super) fn force(&self, displacement: f64) -> f64 {
        4.0 / 3.0 * self.pair.modulus() * self.pair.radius().sqrt() * displacement.powf(1.5)
    }

    /// Radius of the area at a displacement of zero and above [m].
    pub(super) fn radius(&self, displacement: f64) -> f64 {
        (self.pair.radius() * displacement).sqrt()
    }

    /// Work of the force from zero to a displacement [J].
    pub(super) fn work(&self, displacement: f64) -> f64 {
        0.4 * displacement * self.force(displacement)
    }

    /// Displacement with a force of zero and above [m].
    pub(super) fn displacement(&self, force: f64) -> f64 {
        let stiffness = 4.0 / 3.0 * self.pair.modulus() * self.pair.radius().sqrt();
        (force / stiffness).powf(2.0 / 3.0)
    }
}

impl ContactModel for Hertz {
    fn at(&self, displacement: f64, _: Before) -> Result<Contact, ContactError> {
        match finite(displacement)? > 0.0 {
            true => {
                Contact::touching(displacement, self.force(displacement), self.radius(displacement))
            }
            false => Ok(Contact::APART),
        }
    }

    fn parting(&self) -> Parting {
        Parting {
            pull_off: 0.0,
            pull_off_at: 0.0,
            rests_at: 0.0,
            touches_at: Some(0.0),
            tears_at: Some(0.0),
            work: 0.0,
            loss: 0.0,
        }
    }

    fn usual_span(&self) -> [f64; 2] {
        [-0.2, 1.0].map(|share| share * USUAL_SHARE * self.pair.radius())
    }
}
