//! A law as an entry of the catalogue: told in words, evaluated by the names of its parameters.

use std::ops::Index;

use abrade::quantity::Dimension;

use crate::contact::{Before, ContactError, ContactModel};

/// How the form of a law is known to this project.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Read in the source that is named.
    Seen,
    /// Derived here; the documentation of the function says how.
    Derived,
    /// Written down from memory and found in no source: not to be relied on, nor to be cited as the paper
    /// whose author it is named after.
    Memory,
}

impl Status {
    /// One word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Seen => "seen",
            Self::Derived => "derived",
            Self::Memory => "from memory",
        }
    }
}

/// Values that a parameter may have; all are finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Allowed {
    /// Above zero.
    Positive,
    /// Zero and above.
    NotNegative,
    /// From zero to one.
    Share,
    /// An angle from the surface, from zero to a right one.
    Angle,
    /// Poisson's ratio, from -1 to 0.5.
    Poisson,
    /// Any number.
    Any,
}

impl Allowed {
    /// True for a value that is.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Positive => value > 0.0,
                Self::NotNegative => value >= 0.0,
                Self::Share => (0.0..=1.0).contains(&value),
                Self::Angle => (0.0..=std::f64::consts::FRAC_PI_2).contains(&value),
                Self::Poisson => (-1.0..=0.5).contains(&value),
                Self::Any => true,
            }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Positive => "a finite number above zero",
            Self::NotNegative => "a finite number, zero or above",
            Self::Share => "a number from 0 to 1",
            Self::Angle => "an angle from the surface, from 0 to 90 deg; a bare number is in rad",
            Self::Poisson => "a number from -1 to 0.5",
            Self::Any => "a finite number",
        }
    }
}

/// A condition of a law, or one of its constants.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Name by which it is given.
    pub name: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// Its unit; None for a pure number.
    pub dimension: Option<Dimension>,
    /// Unit in SI; empty for a pure number.
    pub unit: &'static str,
    /// Its value where none is given; None for one that has to be.
    pub default: Option<f64>,
    /// What it may be.
    pub allowed: Allowed,
}

/// A number that a law gives.
#[derive(Clone, Copy, Debug)]
pub struct Output {
    /// What it is.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
}

/// A closed-form law.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    /// Name by which it is asked for.
    pub name: &'static str,
    /// What it is, with author and year.
    pub title: &'static str,
    /// Its formula, by the names of the parameters.
    pub formula: &'static str,
    /// What it gives.
    pub output: Output,
    /// Its conditions and constants.
    pub parameters: &'static [Parameter],
    /// How its form is known, and its constants but for `from_memory`.
    pub status: Status,
    /// Constants that were written down from memory and not found in a source: not to be relied on.
    pub from_memory: Option<&'static str>,
    /// Where it is from, and what to know before using it.
    pub source: &'static str,
    pub(crate) value: Value,
}

/// How a law gives its value.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Value {
    /// By a formula.
    Number(fn(&Given<'_>) -> f64),
    /// As the force of a contact at its parameter [`DISPLACEMENT`], after it was touching.
    Contact(fn(&Given<'_>) -> Result<Box<dyn ContactModel>, ContactError>),
}

/// The parameter of a contact that changes along its curve.
pub(crate) const DISPLACEMENT: &str = "displacement";

/// Why a law was not evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LawError {
    /// A parameter that the law does not have.
    #[error("{law} has no parameter `{name}`; it has {known}")]
    Unknown {
        /// Name of the law.
        law: &'static str,
        /// What was given.
        name: String,
        /// The names of its parameters.
        known: String,
    },
    /// A parameter without default was not given.
    #[error("{law} needs `{name}`: {meaning}")]
    Missing {
        /// Name of the law.
        law: &'static str,
        /// The parameter.
        name: &'static str,
        /// What it is.
        meaning: &'static str,
    },
    /// A value that the parameter cannot have.
    #[error("`{name}` is {value}; allowed is {allowed}")]
    Refused {
        /// The parameter.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What was allowed.
        allowed: &'static str,
    },
    /// A contact cannot be what the values ask for.
    #[error("{law}: {source}")]
    Contact {
        /// Name of the law.
        law: &'static str,
        /// Why not.
        source: ContactError,
    },
    /// A law that is no contact was asked for one.
    #[error("{law} is no model of a contact")]
    NoContact {
        /// Name of the law.
        law: &'static str,
    },
    /// The formula has no finite value there.
    #[error("{law} has no finite value at these conditions")]
    NotFinite {
        /// Name of the law.
        law: &'static str,
    },
}

/// The values of a law's parameters.
pub(crate) struct Given<'a> {
    parameters: &'static [Parameter],
    values: &'a [f64],
}

impl Index<&str> for Given<'_> {
    type Output = f64;

    /// The value of a parameter that the entry lists.
    fn index(&self, name: &str) -> &f64 {
        let at = self.parameters.iter().position(|parameter| parameter.name == name);
        &self.values[at.expect("a parameter of the entry")]
    }
}

impl Law {
    /// The value of the law for parameters `given` by name, in SI; the others have their defaults.
    ///
    /// # Errors
    /// A name that the law does not have, a missing condition, a value out of range, a formula
    /// that has no finite value there.
    pub fn evaluate<'a>(
        &self,
        given: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<f64, LawError> {
        let defaults = self.parameters.iter().map(|p| p.default).collect();
        let values = self.checked(defaults, given)?;
        let given = Given { parameters: self.parameters, values: &values };
        let value = match self.value {
            Value::Number(value) => value(&given),
            Value::Contact(model) => {
                let touching =
                    model(&given).and_then(|model| model.at(given[DISPLACEMENT], Before::Touching));
                touching.map_err(|source| LawError::Contact { law: self.name, source })?.force
            }
        };
        if value.is_finite() { Ok(value) } else { Err(LawError::NotFinite { law: self.name }) }
    }

    /// True for a model of a contact.
    pub fn is_contact(&self) -> bool {
        matches!(self.value, Value::Contact(_))
    }

    /// The contact that the law describes, for parameters `given` by name, in SI; its displacement need not
    /// be among them.
    ///
    /// # Errors
    /// As for [`Self::evaluate`]; a law that is no model of a contact.
    pub fn contact<'a>(
        &self,
        given: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<Box<dyn ContactModel>, LawError> {
        let Value::Contact(model) = self.value else {
            return Err(LawError::NoContact { law: self.name });
        };
        let place = |p: &Parameter| if p.name == DISPLACEMENT { Some(0.0) } else { p.default };
        let values = self.checked(self.parameters.iter().map(place).collect(), given)?;
        let made = model(&Given { parameters: self.parameters, values: &values });
        made.map_err(|source| LawError::Contact { law: self.name, source })
    }

    /// The values of all parameters: those `given` over the `defaults`.
    fn checked<'a>(
        &self,
        mut values: Vec<Option<f64>>,
        given: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<Vec<f64>, LawError> {
        for (name, value) in given {
            values[self.find(name)?] = Some(value);
        }
        let checked = self.parameters.iter().zip(values).map(|(parameter, value)| {
            let Parameter { name, meaning, allowed, .. } = *parameter;
            let value = value.ok_or(LawError::Missing { law: self.name, name, meaning })?;
            match allowed.holds(value) {
                true => Ok(value),
                false => Err(LawError::Refused { name, value, allowed: allowed.words() }),
            }
        });
        checked.collect()
    }

    /// Index of a parameter.
    ///
    /// # Errors
    /// A name that the law does not have.
    pub fn find(&self, name: &str) -> Result<usize, LawError> {
        self.parameters.iter().position(|parameter| parameter.name == name).ok_or_else(|| {
            let known: Vec<_> = self.parameters.iter().map(|p| format!("`{}`", p.name)).collect();
            LawError::Unknown { law: self.name, name: name.into(), known: known.join(", ") }
        })
    }
}
