//! Bradley's rigid spheres, which attract each other over a gap.

use std::f64::consts::PI;

use super::{Before, Contact, ContactError, ContactModel, Parting, above_zero, finite};

/// F = (8 pi w R / 3) [(z/z0)^-8 / 4 - (z/z0)^-2], z being the gap between rigid surfaces.
///
/// Bradley, R. S. (1932). Phil. Mag. 13, 853-862: a Lennard-Jones force between the atoms of two spheres.
/// Texts that print it with an "overlap" delta in the place of z mean the gap: with the overlap of
/// other models it would push the bodies into each other. Here the displacement is z0 - z, zero at the
/// equilibrium distance z0 of flat surfaces, where two spheres pull each other with the most, 2 pi w R.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bradley {
    radius: f64,
    adhesion: f64,
    distance: f64,
}

/// The gap without force over z0: 4^(-1/6).
fn rest_ratio() -> f64 {
    4f64.powf(-1.0 / 6.0)
}

impl Bradley {
    /// Spheres of a reduced `radius` R [m] with a work of `adhesion` w [J/m2] and the equilibrium
    /// `distance` z0 [m] of their surfaces.
    ///
    /// # Errors
    /// One of them is not finite or not above zero.
    pub fn new(radius: f64, adhesion: f64, distance: f64) -> Result<Self, ContactError> {
        Ok(Self {
            radius: above_zero("radius", radius)?,
            adhesion: above_zero("adhesion", adhesion)?,
            distance: above_zero("distance", distance)?,
        })
    }

    /// Force over a `gap` z [m], positive where it pushes apart [N].
    ///
    /// # Errors
    /// A gap that is not finite or not above zero; a force past the range of numbers.
    pub fn force_over(&self, gap: f64) -> Result<f64, ContactError> {
        let ratio = above_zero("gap", gap)? / self.distance;
        let force = self.scale() * (0.25 * ratio.powi(-8) - ratio.powi(-2));
        match force.is_finite() {
            true => Ok(force),
            false => Err(ContactError::NotFinite { displacement: self.distance - gap }),
        }
    }

    fn scale(&self) -> f64 {
        8.0 / 3.0 * PI * self.adhesion * self.radius
    }
}

impl ContactModel for Bradley {
    fn at(&self, displacement: f64, _: Before) -> Result<Contact, ContactError> {
        let gap = self.distance - finite(displacement)?;
        if gap <= 0.0 {
            let allowed = "a number below z0: rigid surfaces keep a gap";
            let name = "displacement";
            return Err(ContactError::Refused { name, value: displacement, allowed });
        }
        Contact::touching(displacement, self.force_over(gap)?, 0.0)
    }

    /// The work is that from rest to where nothing is left of the force:
    /// scale z0 [x^-1 - x^-7 / 28] at the ratio x of rest.
    fn parting(&self) -> Parting {
        let rest = rest_ratio();
        Parting {
            pull_off: -0.75 * self.scale(),
            pull_off_at: 0.0,
            rests_at: self.distance * (1.0 - rest),
            touches_at: None,
            tears_at: None,
            work: self.scale() * self.distance * (1.0 / rest - rest.powi(-7) / 28.0),
            loss: 0.0,
        }
    }

    fn usual_span(&self) -> [f64; 2] {
        [-3.0, 0.24].map(|share| share * self.distance)
    }
}
