//! The laws by name.

use abrade::quantity::{Dimension, PRESSURE};

use crate::law::{Allowed, Law, Output, Parameter};

mod contact;
mod erosion;
mod remembered;
mod sliding;

/// Every law: erosion, wear along a slide, those from memory, contact.
pub fn laws() -> impl Iterator<Item = &'static Law> + Clone {
    [erosion::LAWS, sliding::LAWS, remembered::LAWS, contact::LAWS].into_iter().flatten()
}

/// A condition, which has to be given.
const fn condition(
    name: &'static str,
    (dimension, unit): (Option<Dimension>, &'static str),
    allowed: Allowed,
    meaning: &'static str,
) -> Parameter {
    Parameter { name, meaning, dimension, unit, default: None, allowed }
}

/// A constant, a pure number.
const fn constant(
    name: &'static str,
    default: f64,
    allowed: Allowed,
    meaning: &'static str,
) -> Parameter {
    Parameter { name, meaning, dimension: None, unit: "", default: Some(default), allowed }
}

const PLAIN: (Option<Dimension>, &str) = (None, "");
const PASCAL: (Option<Dimension>, &str) = (Some(PRESSURE), "Pa");

const VOLUME: Output = Output { name: "volume", unit: "m3" };
