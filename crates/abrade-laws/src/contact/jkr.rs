//! The model of Johnson, Kendall and Roberts, with its memory.

use std::f64::consts::PI;

use super::{Before, Contact, ContactError, ContactModel, Pair, Parting, above_zero, finite};

/// F = 4 E* a^3 / (3 R) - sqrt(8 pi w E* a^3), d = a^2 / R - sqrt(2 pi w a / E*).
///
/// Johnson, K. L., Kendall, K. & Roberts, A. D. (1971). Proc. R. Soc. A 324, 301-313; displacement as in
/// Maugis, Contact, adhesion and rupture of elastic solids (2000). For large and soft bodies
/// ([`super::tabor`] above 5).
///
/// Attraction acts in the contact alone. Bodies that come together hold each other from d = 0 on, at once
/// with a pull of 4/3 pi w R; bodies that touch keep a neck up to a gap of
/// 3/4 (pi^2 w^2 R / E*^2)^(1/3). So between the two the force depends on what was before.
///
/// Texts that print a^3 = (R/E*) [..] for the radius under a load write E* where K = 4 E*/3 is meant; with
/// E* itself the radius is (4/3)^(1/3), a tenth, too large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jkr {
    pair: Pair,
    adhesion: f64,
}

impl Jkr {
    /// The contact of a pair with a work of `adhesion` w [J/m2].
    ///
    /// # Errors
    /// A work of adhesion that is not finite or not above zero.
    pub fn new(pair: Pair, adhesion: f64) -> Result<Self, ContactError> {
        Ok(Self { pair, adhesion: above_zero("adhesion", adhesion)? })
    }

    /// Radius of the area under a load [m], on the branch that lasts:
    /// a^3 = 3 R / (4 E*) [F + 3 pi w R + sqrt(6 pi w R F + (3 pi w R)^2)].
    ///
    /// # Errors
    /// A load [N] that is not finite, or pulls harder than the contact holds.
    pub fn radius_under(&self, load: f64) -> Result<f64, ContactError> {
        let hold = 3.0 * PI * self.adhesion * self.pair.radius();
        if !load.is_finite() || load < -0.5 * hold {
            let allowed = "a finite number, the pull-off force -1.5 pi w R or above";
            return Err(ContactError::Refused { name: "load", value: load, allowed });
        }
        let root = (hold * (2.0 * load + hold)).max(0.0).sqrt();
        Ok((0.75 * self.pair.radius() / self.pair.modulus() * (load + hold + root)).cbrt())
    }

    /// Force with an area of `radius` a [N].
    ///
    /// # Errors
    /// A radius [m] that is negative or not finite.
    pub fn force_with(&self, radius: f64) -> Result<f64, ContactError> {
        Ok(self.force(known(radius)?.sqrt()))
    }

    /// Displacement with an area of `radius` a [m].
    ///
    /// # Errors
    /// A radius [m] that is negative or not finite.
    pub fn displacement_with(&self, radius: f64) -> Result<f64, ContactError> {
        Ok(self.displacement(known(radius)?.sqrt()))
    }

    /// Force by the square root of the contact radius.
    fn force(&self, root: f64) -> f64 {
        let cube = root.powi(3);
        cube * (4.0 / 3.0 * self.pair.modulus() / self.pair.radius() * cube - self.hold())
    }

    fn displacement(&self, root: f64) -> f64 {
        root * (root.powi(3) / self.pair.radius() - self.neck())
    }

    /// sqrt(8 pi w E*).
    fn hold(&self) -> f64 {
        (8.0 * PI * self.adhesion * self.pair.modulus()).sqrt()
    }

    /// q = sqrt(2 pi w / E*).
    fn neck(&self) -> f64 {
        (2.0 * PI * self.adhesion / self.pair.modulus()).sqrt()
    }

    /// Root of the radius at which the displacement is least: s^3 = q R / 4.
    fn torn(&self) -> f64 {
        (0.25 * self.neck() * self.pair.radius()).cbrt()
    }

    /// Root of the radius at which the displacement is none: s^3 = q R.
    fn first(&self) -> f64 {
        (self.neck() * self.pair.radius()).cbrt()
    }

    /// Root s of the radius at a displacement, not below [`Self::torn`]: s^4 / R - q s = d.
    ///
    /// The left side is convex, so Newton's steps from above, where it exceeds d, fall to the root.
    fn root_at(&self, displacement: f64) -> f64 {
        let (radius, neck, least) = (self.pair.radius(), self.neck(), self.torn());
        let start =
            (2.0 * radius * displacement.max(0.0)).powf(0.25) + (2.0 * radius * neck).cbrt();
        let mut root = start.max(least);
        while root > least {
            let slope = 4.0 * root.powi(3) / radius - neck;
            let next = root - (self.displacement(root) - displacement) / slope;
            // Rounding ends the fall; a number that is none ends it, too.
            match next < root {
                true => root = next.max(least),
                false => break,
            }
        }
        root
    }

    /// Integral of -F over the displacement up to a root of the radius [J].
    fn work_up_to(&self, s: f64) -> f64 {
        let (radius, modulus) = (self.pair.radius(), self.pair.modulus());
        let (hold, neck) = (self.hold(), self.neck());
        let pull = hold * (4.0 / 7.0 * s.powi(7) / radius - 0.25 * neck * s.powi(4));
        let push = 4.0 / 3.0 * modulus / radius;
        pull - push * (0.4 * s.powi(10) / radius - neck * s.powi(7) / 7.0)
    }
}

fn known(radius: f64) -> Result<f64, ContactError> {
    let allowed = "a finite number, zero or above";
    match radius.is_finite() && radius >= 0.0 {
        true => Ok(radius),
        false => Err(ContactError::Refused { name: "contact radius", value: radius, allowed }),
    }
}

impl ContactModel for Jkr {
    fn at(&self, displacement: f64, before: Before) -> Result<Contact, ContactError> {
        let holds = match before {
            Before::Apart => finite(displacement)? >= 0.0,
            Before::Touching => finite(displacement)? >= self.displacement(self.torn()),
        };
        if !holds {
            return Ok(Contact::APART);
        }
        let root = self.root_at(displacement);
        Contact::touching(displacement, self.force(root), root * root)
    }

    fn parting(&self) -> Parting {
        let (radius, modulus) = (self.pair.radius(), self.pair.modulus());
        // Cubes of the contact radius: 9 pi w R^2 / 8 E* at the pull-off force, 4 times that at rest.
        let cube = 9.0 / 8.0 * PI * self.adhesion * radius * radius / modulus;
        let [pull, rest] = [cube, 4.0 * cube].map(|cube| cube.powf(1.0 / 6.0));
        Parting {
            pull_off: -1.5 * PI * self.adhesion * radius,
            pull_off_at: self.displacement(pull),
            rests_at: self.displacement(rest),
            touches_at: Some(0.0),
            tears_at: Some(self.displacement(self.torn())),
            work: self.work_up_to(rest) - self.work_up_to(self.torn()),
            loss: self.work_up_to(self.first()) - self.work_up_to(self.torn()),
        }
    }
}
