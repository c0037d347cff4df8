//! JKR's force over Hertz' contact radius.

use std::f64::consts::PI;

use super::{
    Before, Contact, ContactError, ContactModel, Hertz, Pair, Parting, above_zero, finite,
};

/// F = (4/3) E* sqrt(R) d^1.5 - sqrt(8 pi w E*) (R d)^0.75, by putting a^2 = R d into JKR's force.
///
/// It pulls with JKR's 1.5 pi w R at most, but at an overlap, and lets go where the surfaces cease to
/// overlap: without memory, and without the neck that JKR's contact keeps. Texts that print it as
/// E* sqrt(R) d^1.5 - sqrt(6 pi w E*) (R d)^0.75 write E* where K = 4 E*/3 is meant; with E* itself that
/// is a quarter too soft. LIGGGHTS calls another force "sjkr": [`super::CohesionArea`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimplifiedJkr {
    hertz: Hertz,
    /// sqrt(8 pi w E*) R^0.75 [N/m^0.75].
    factor: f64,
}

impl SimplifiedJkr {
    /// The contact of a pair with a work of `adhesion` w [J/m2].
    ///
    /// # Errors
    /// A work of adhesion that is not finite or not above zero.
    pub fn new(pair: Pair, adhesion: f64) -> Result<Self, ContactError> {
        let w = above_zero("adhesion", adhesion)?;
        let factor = (8.0 * PI * w * pair.modulus()).sqrt() * pair.radius().powf(0.75);
        Ok(Self { hertz: Hertz::new(pair), factor })
    }

    fn force(&self, displacement: f64) -> f64 {
        self.hertz.force(displacement) - self.factor * displacement.powf(0.75)
    }
}

impl ContactModel for SimplifiedJkr {
    fn at(&self, displacement: f64, _: Before) -> Result<Contact, ContactError> {
        match finite(displacement)? > 0.0 {
            true => Contact::touching(
                displacement,
                self.force(displacement),
                self.hertz.radius(displacement),
            ),
            false => Ok(Contact::APART),
        }
    }

    /// With h d^1.5 = factor d^0.75 at rest, the force is least at half that d^0.75.
    fn parting(&self) -> Parting {
        let rests_at = (self.factor / self.hertz.force(1.0)).powf(4.0 / 3.0);
        let pull_off_at = rests_at * 0.5f64.powf(4.0 / 3.0);
        Parting {
            pull_off: self.force(pull_off_at),
            pull_off_at,
            rests_at,
            touches_at: Some(0.0),
            tears_at: Some(0.0),
            work: self.factor * rests_at.powf(1.75) / 1.75 - self.hertz.work(rests_at),
            loss: 0.0,
        }
    }
}
