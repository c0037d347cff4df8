//! `deserialize_with` functions for tuples of numbers that may carry units.

use abrade::quantity::{self, Dimension};
use serde::Deserializer;

macro_rules! tuples {
    ($($function:ident $count:literal $dimension:ident)+) => {
        $(
            pub(super) fn $function<'de, D: Deserializer<'de>>(d: D) -> Result<[f64; $count], D::Error> {
                quantity::$dimension.array(d)
            }
        )+
    };
}

tuples! {
    length2 2 LENGTH
    length3 3 LENGTH
    speed3 3 SPEED
    spin3 3 SPIN
    acceleration3 3 ACCELERATION
}

pub(super) fn points<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Vec<[f64; 3]>>, D::Error> {
    rows(quantity::LENGTH, d)
}

pub(super) fn spheres<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Vec<[f64; 4]>>, D::Error> {
    rows(quantity::LENGTH, d)
}

fn rows<'de, const N: usize, D: Deserializer<'de>>(
    dimension: Dimension,
    d: D,
) -> Result<Option<Vec<[f64; N]>>, D::Error> {
    dimension.rows(d).map(Some)
}
