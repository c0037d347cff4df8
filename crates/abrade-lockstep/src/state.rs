//! A wearing body between two islands to bytes and back, for binary formats of serde.
//!
//! Its handle, its loads, its sums and why it was stopped are those of an island and are not kept:
//! what is read must join the next one by [`Wearer::resumed`].

use abrade::{Body, Carried, Loads};
use rapier::dynamics::RigidBodyHandle;
use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{Serialize, Serializer};

use crate::calm::Calm;
use crate::wearer::Wearer;

impl Serialize for Wearer {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        (&self.body, &self.contact, self.calm, &self.lifts).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Wearer {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let (body, contact, calm, lifts): (Body, Carried, Calm, Vec<f64>) =
            Deserialize::deserialize(from)?;
        if !lifts.iter().all(|lift| lift.is_finite() && *lift >= 0.0) {
            return Err(D::Error::custom("a lift is below zero or not finite"));
        }
        let nowhere = RigidBodyHandle::invalid();
        let mut wearer = Self::of(nowhere, body, Loads::default(), contact, lifts);
        wearer.calm = calm;
        Ok(wearer)
    }
}
