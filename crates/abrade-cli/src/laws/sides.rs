//! The two bodies of a contact on the command line, in the place of their reduced radius and modulus.

use abrade_laws::contact::{Pair, Side};
use abrade_laws::{Parameter, laws};

use super::refused;
use super::values;
use crate::failure::Failure;

/// What was given of the sides, the first and perhaps the second.
#[derive(Default)]
pub(super) struct Sides {
    young: Vec<f64>,
    poisson: Vec<f64>,
    radii: Vec<f64>,
}

/// A parameter of an entry of the catalogue.
pub(super) fn parameter(law: &str, name: &str) -> &'static Parameter {
    let law = laws().find(|entry| entry.name == law).expect("an entry of the catalogue");
    &law.parameters[law.find(name).expect("a parameter of the entry")]
}

impl Sides {
    /// Takes `NAME=VALUE`, if it is about sides.
    pub(super) fn take(&mut self, text: &str) -> Result<bool, Failure> {
        let (name, list) = values::named(text)?;
        let (taken, of) = match name {
            "young" | "poisson" => (name, parameter("contact-modulus", name)),
            "radius" if list.contains(',') => (name, parameter("tabor", name)),
            _ => return Ok(false),
        };
        let numbers = values::of_parameter(of, list)?.numbers;
        if numbers.len() > 2 {
            let count = numbers.len();
            return Err(refused(format!("`{name}` has {count} values; a contact has two sides")));
        }
        match taken {
            "young" => self.young = numbers,
            "poisson" => self.poisson = numbers,
            _ => self.radii = numbers,
        }
        Ok(true)
    }

    /// Adds the radius and the modulus that the sides make.
    pub(super) fn reduce(self, constants: &mut Vec<(&'static str, f64)>) -> Result<(), Failure> {
        if self.young.len() != self.poisson.len() {
            return Err(refused("`young` and `poisson` are needed of the same sides".to_owned()));
        }
        // What is not asked for is that of a rigid flat, beside any first side.
        let value = |list: &[f64], at: usize, other: f64| list.get(at).copied().unwrap_or(other);
        let side = |at: usize, [radius, young]: [f64; 2]| Side {
            radius: value(&self.radii, at, radius),
            young: value(&self.young, at, young),
            poisson: value(&self.poisson, at, 0.0),
        };
        let sides = [side(0, [1.0; 2]), side(1, [f64::INFINITY; 2])];
        let pair = Pair::of(sides).map_err(|error| Failure::Input(error.into()))?;
        if !self.young.is_empty() {
            constants.push(("modulus", pair.modulus()));
        }
        if !self.radii.is_empty() {
            constants.push(("radius", pair.radius()));
        }
        Ok(())
    }
}
