//! The model of Maugis and Dugdale, between DMT and JKR.

use std::f64::consts::PI;

use super::tabor::LAMBDA_OVER_TABOR;
use super::{Before, Contact, ContactError, ContactModel, Pair, Parting, finite, maugis_lambda};

mod curve;

use curve::Curve;

/// A constant attraction sigma0 wherever the surfaces are less than w / sigma0 apart, between elastic
/// bodies.
///
/// Maugis, D. (1992). J. Colloid Interface Sci. 150, 243-269: the equations of the contact, in a circle a
/// inside a circle c of attraction, as in the package Adhesion of ContactEngineering. Before the bodies touch, and after, there is attraction without
/// contact: derived in the module of the curve, after Johnson & Greenwood (1997).
///
/// Bodies that come together attract each other from a gap of w / sigma0 on; bodies that do hold each
/// other up to the least displacement of the curve. `Contact::radius` is a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaugisDugdale {
    lambda: f64,
    /// Of displacement [m], force [N] and radius [m].
    scales: [f64; 3],
    curve: Curve,
}

/// What lambda may be: outside of it DMT and JKR are the same to eight digits.
const LAMBDAS: std::ops::RangeInclusive<f64> = 1e-5..=1e4;

impl MaugisDugdale {
    /// The contact of a pair with a work of `adhesion` w [J/m2] and its `strength` sigma0 [Pa].
    ///
    /// # Errors
    /// A work or strength that is not finite or not above zero; a [`maugis_lambda`] out of 1e-5 to 1e4.
    pub fn new(pair: Pair, adhesion: f64, strength: f64) -> Result<Self, ContactError> {
        let lambda = maugis_lambda(&pair, adhesion, strength)?;
        if !LAMBDAS.contains(&lambda) {
            let allowed = "1e-5 to 1e4: below take DMT, above JKR";
            return Err(ContactError::Refused { name: "lambda", value: lambda, allowed });
        }
        let (radius, k) = (pair.radius(), 4.0 / 3.0 * pair.modulus());
        let short = (PI * adhesion / k).powi(2) * radius;
        let wide = PI * adhesion / k * radius * radius;
        let scales = [short.cbrt(), PI * adhesion * radius, wide.cbrt()];
        Ok(Self { lambda, scales, curve: Curve::of(lambda) })
    }

    /// The contact whose Tabor parameter is `tabor` [-]: its strength is that of Lennard-Jones surfaces.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn with_tabor(pair: Pair, adhesion: f64, tabor: f64) -> Result<Self, ContactError> {
        let unit = maugis_lambda(&pair, adhesion, 1.0)?;
        Self::new(pair, adhesion, LAMBDA_OVER_TABOR * tabor / unit)
    }

    /// Maugis' parameter [-].
    pub fn lambda(&self) -> f64 {
        self.lambda
    }
}

impl ContactModel for MaugisDugdale {
    fn at(&self, displacement: f64, before: Before) -> Result<Contact, ContactError> {
        let [short, force, wide] = self.scales;
        let reduced = finite(displacement)? / short;
        let from = match before {
            Before::Apart => self.curve.touches(),
            Before::Touching => self.curve.tears(),
        };
        if reduced < from {
            return Ok(Contact::APART);
        }
        let point = self.curve.at(reduced);
        Contact::touching(displacement, force * point.force, wide * point.contact)
    }

    fn parting(&self) -> Parting {
        let [short, force, _] = self.scales;
        let least = self.curve.least_force();
        Parting {
            pull_off: force * least.force,
            pull_off_at: short * least.displacement,
            rests_at: short * self.curve.rest().displacement,
            touches_at: Some(short * self.curve.touches()),
            tears_at: Some(short * self.curve.tears()),
            work: short * force * self.curve.work_from(self.curve.rest().displacement),
            loss: short * force * self.curve.work_from(self.curve.touches()),
        }
    }
}
