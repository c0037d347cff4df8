//! The model of Derjaguin, Muller and Toporov.

use std::f64::consts::PI;

use super::{
    Before, Contact, ContactError, ContactModel, Hertz, Pair, Parting, above_zero, finite,
};

/// Hertz' contact, and a pull of 2 pi w R on top while the bodies touch.
///
/// Derjaguin, B. V., Muller, V. M. & Toporov, Y. P. (1975). J. Colloid Interface Sci. 53, 314-326. For
/// small and stiff bodies ([`super::tabor`] below 0.1). The attraction acts outside of the contact and
/// does not deform it. How far it reaches is no part of the model: here it ends with the contact, and the
/// work that parts the bodies has nothing beyond. Texts that write the pull with the "surface energy" of
/// the pair mean w, as those for JKR do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dmt {
    hertz: Hertz,
    pull: f64,
}

impl Dmt {
    /// The contact of a pair with a work of `adhesion` w [J/m2].
    ///
    /// # Errors
    /// A work of adhesion that is not finite or not above zero.
    pub fn new(pair: Pair, adhesion: f64) -> Result<Self, ContactError> {
        let pull = 2.0 * PI * above_zero("adhesion", adhesion)? * pair.radius();
        Ok(Self { hertz: Hertz::new(pair), pull })
    }

    /// Radius of the area under a load [m]: a^3 = 3 R (F + 2 pi w R) / (4 E*).
    ///
    /// # Errors
    /// A load [N] that is not finite, or pulls harder than the contact holds.
    pub fn radius_under(&self, load: f64) -> Result<f64, ContactError> {
        let allowed = "a finite number, the pull-off force -2 pi w R or above";
        let refused = ContactError::Refused { name: "load", value: load, allowed };
        self.hertz.radius_under(load + self.pull).map_err(|_| refused)
    }
}

impl ContactModel for Dmt {
    fn at(&self, displacement: f64, _: Before) -> Result<Contact, ContactError> {
        if finite(displacement)? < 0.0 {
            return Ok(Contact::APART);
        }
        let force = self.hertz.force(displacement) - self.pull;
        Contact::touching(displacement, force, self.hertz.radius(displacement))
    }

    fn parting(&self) -> Parting {
        let rests_at = self.hertz.displacement(self.pull);
        Parting {
            pull_off: -self.pull,
            pull_off_at: 0.0,
            rests_at,
            touches_at: Some(0.0),
            tears_at: Some(0.0),
            work: self.pull * rests_at - self.hertz.work(rests_at),
            loss: 0.0,
        }
    }
}
