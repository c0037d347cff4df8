//! Contact of two round bodies by closed forms: force against displacement, contact radius, and what it
//! takes to part them again, with and without adhesion.
//!
//! Each model is a struct that is made from a [`Pair`] and its own constants, and a [`ContactModel`].
//! Displacement is how far the undeformed surfaces overlap [m], negative for a gap; force is positive
//! where it pushes apart [N]. `R` is the reduced radius and `E*` the contact modulus of the pair.
//!
//! `w` is the work of adhesion [J/m2]: what it takes to part a unit of area. Texts that print JKR's
//! formulas with a "surface energy gamma" of the pair mean it. For two alike it is twice the surface
//! energy of one.

mod bradley;
mod cohesion_area;
mod curve;
mod dmt;
mod hertz;
mod jkr;
mod maugis;
mod pair;
mod simplified_jkr;
mod tabor;

pub use bradley::Bradley;
pub use cohesion_area::CohesionArea;
pub use curve::{Branches, branches};
pub use dmt::Dmt;
pub use hertz::Hertz;
pub use jkr::Jkr;
pub use maugis::MaugisDugdale;
pub use pair::{Pair, Side};
pub use simplified_jkr::SimplifiedJkr;
pub use tabor::{Advice, LAMBDA_OVER_TABOR, maugis_lambda, tabor};

/// Whether the bodies touched just before: the memory that adhesion has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Before {
    /// They did not: they come together, on the loading branch.
    #[default]
    Apart,
    /// They did: what holds them holds on, on the unloading branch.
    Touching,
}

/// The contact at a displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Force, positive where it pushes apart [N].
    pub force: f64,
    /// Radius of the area in contact [m]; zero where nothing touches, and for rigid spheres.
    pub radius: f64,
    /// What the next displacement has as its `before`.
    pub after: Before,
}

/// What it takes to part the bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parting {
    /// Least force, where a pull that grows parts them [N]; zero without adhesion.
    pub pull_off: f64,
    /// Displacement there [m].
    pub pull_off_at: f64,
    /// Displacement without any force [m].
    pub rests_at: f64,
    /// Displacement at which they come to hold each other as they approach [m]; none where the force
    /// grows out of nothing over any distance.
    pub touches_at: Option<f64>,
    /// Displacement at which they let go where the displacement is led [m]; none where the force fades
    /// over any distance.
    pub tears_at: Option<f64>,
    /// Work that parts them, from rest to where they let go [J].
    pub work: f64,
    /// Work that is lost each time elastic bodies touch and part [J]: what lies between the branches.
    pub loss: f64,
}

/// Force against displacement.
pub trait ContactModel {
    /// The contact at a `displacement` [m], by what was `before`.
    ///
    /// # Errors
    /// A displacement that is no number or that the model does not have; a force past the range of
    /// numbers.
    fn at(&self, displacement: f64, before: Before) -> Result<Contact, ContactError>;

    /// What it takes to part the bodies.
    fn parting(&self) -> Parting;

    /// Displacements, from the least to the largest, between which the curve shows what it is like [m].
    fn usual_span(&self) -> [f64; 2] {
        let Parting { pull_off_at, rests_at, tears_at, .. } = self.parting();
        let low = tears_at.unwrap_or(pull_off_at);
        let size = rests_at - low;
        [low - 0.5 * size, rests_at + size]
    }
}

/// Why a model or a contact was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// A value that the argument cannot have.
    #[error("`{name}` is {value:e}; allowed is {allowed}")]
    Refused {
        /// The argument.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What was allowed.
        allowed: &'static str,
    },
    /// The model has no finite force there.
    #[error("the force at a displacement of {displacement:e} m is past the range of numbers")]
    NotFinite {
        /// The displacement [m].
        displacement: f64,
    },
}

/// `value`, where it is finite and above zero.
fn above_zero(name: &'static str, value: f64) -> Result<f64, ContactError> {
    let allowed = "a finite number above zero";
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(ContactError::Refused { name, value, allowed })
    }
}

/// `displacement`, where it is finite.
fn finite(displacement: f64) -> Result<f64, ContactError> {
    let (name, allowed) = ("displacement", "a finite number");
    if displacement.is_finite() {
        Ok(displacement)
    } else {
        Err(ContactError::Refused { name, value: displacement, allowed })
    }
}

impl Contact {
    /// Nothing touches.
    const APART: Self = Self { force: 0.0, radius: 0.0, after: Before::Apart };

    /// A contact, if its force is a number.
    fn touching(displacement: f64, force: f64, radius: f64) -> Result<Self, ContactError> {
        match force.is_finite() && radius.is_finite() {
            true => Ok(Self { force, radius, after: Before::Touching }),
            false => Err(ContactError::NotFinite { displacement }),
        }
    }
}
