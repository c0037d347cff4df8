//! A pull in proportion to the area of the overlap: what LIGGGHTS calls SJKR.

use std::f64::consts::PI;

use super::{
    Before, Contact, ContactError, ContactModel, Hertz, Pair, Parting, above_zero, finite,
};

/// F = (4/3) E* sqrt(R) d^1.5 - k A, A = factor pi R d.
///
/// `cohesion sjkr` and `cohesion sjkr2` of LIGGGHTS, with the "cohesion energy density" k [J/m3 = Pa].
/// Despite the name nothing of JKR is in it: the pull-off force falls as k^3 and with the square of the
/// modulus, and there is no work of adhesion. With `factor` 2, A is the circle in which two spheres
/// intersect, to first order in the overlap over their radii (sjkr); with 4 it is sjkr2's
/// 2 pi d (2 R). Both push and pull end where the overlap does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CohesionArea {
    hertz: Hertz,
    /// k A / d [N/m].
    pull: f64,
}

impl CohesionArea {
    /// The contact of a pair with a `cohesion` k [Pa] on an area of `factor` pi R d.
    ///
    /// # Errors
    /// A cohesion or factor that is not finite or not above zero.
    pub fn new(pair: Pair, cohesion: f64, factor: f64) -> Result<Self, ContactError> {
        let pull = above_zero("cohesion", cohesion)? * above_zero("area_factor", factor)?;
        Ok(Self { hertz: Hertz::new(pair), pull: PI * pull * pair.radius() })
    }
}

impl ContactModel for CohesionArea {
    /// The radius is Hertz'; the area that pulls is larger.
    fn at(&self, displacement: f64, _: Before) -> Result<Contact, ContactError> {
        if finite(displacement)? <= 0.0 {
            return Ok(Contact::APART);
        }
        let force = self.hertz.force(displacement) - self.pull * displacement;
        Contact::touching(displacement, force, self.hertz.radius(displacement))
    }

    /// With h d^1.5 = pull d at rest, the force is least at four ninths of that d.
    fn parting(&self) -> Parting {
        let rests_at = (self.pull / self.hertz.force(1.0)).powi(2);
        let pull_off_at = 4.0 / 9.0 * rests_at;
        Parting {
            pull_off: self.hertz.force(pull_off_at) - self.pull * pull_off_at,
            pull_off_at,
            rests_at,
            touches_at: Some(0.0),
            tears_at: Some(0.0),
            work: 0.5 * self.pull * rests_at * rests_at - self.hertz.work(rests_at),
            loss: 0.0,
        }
    }
}
