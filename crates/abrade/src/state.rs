//! Surfaces, bodies and running contacts to bytes and back, for binary formats of serde: what
//! outlives a step, so that a run that goes on from it gives the same bits.
//!
//! What is read is checked: whatever the bytes are, they give a fault or a state that a step can
//! be taken from. Types whose fields depend on each other are derived as `remote` and checked
//! here; each has its check beside its fields.

use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{Serialize, Serializer};

use crate::body::{Inertia, State};
use crate::carried::Carried;
use crate::columns::Columns;
use crate::drive::Driven;
use crate::hull::Hull;
use crate::integrate::Integrator;
use crate::patch::Patch;

/// Why bytes are no state.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub(crate) struct Fault(pub &'static str);

/// A fault unless what `what` says holds.
pub(crate) fn require(holds: bool, what: &'static str) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(Fault(what)) }
}

/// True when every number is finite.
pub(crate) fn finite<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> bool {
    numbers.into_iter().all(|x| x.is_finite())
}

/// True for a length or rate [SI] that can be one.
pub(crate) fn not_negative(x: f64) -> bool {
    x.is_finite() && x >= 0.0
}

/// True for a number that can divide.
pub(crate) fn positive(x: f64) -> bool {
    x.is_finite() && x > 0.0
}

macro_rules! checked {
    ($($checked:ty),+) => {
        $(
            impl Serialize for $checked {
                fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                    <$checked>::serialize(self, to)
                }
            }

            impl<'de> Deserialize<'de> for $checked {
                fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                    <$checked>::deserialize(from)?.checked().map_err(D::Error::custom)
                }
            }
        )+
    };
}

checked!(Carried, Columns, Driven, Hull, Inertia, Integrator, Patch, State);
