//! Numbers that may be written with a unit: `6.6e9`, or `"6.6 GPa"` where a pressure is meant.
//!
//! One table of units, one function per dimension for `#[serde(deserialize_with)]`. A bare
//! number is in SI (angles in radians).

use serde::de::{Deserializer, Error, Visitor};
use std::fmt;

/// A number in SI units, or a quoted number with a unit. Exists for the JSON schema.
#[derive(schemars::JsonSchema)]
#[serde(untagged)]
#[allow(dead_code, reason = "only its schema is used")]
pub enum Quantity {
    /// SI value.
    Si(f64),
    /// Number and unit, such as `"6.6 GPa"`.
    WithUnit(String),
}

/// What a number measures, and the units it can be written in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimension {
    /// Name with its article, for messages.
    pub name: &'static str,
    units: &'static [(&'static str, f64)],
}

macro_rules! dimensions {
    ($($constant:ident $function:ident $optional:ident $name:literal [$(($unit:literal, $factor:expr)),+])+) => {
        $(
            #[doc = concat!("Units of ", $name, ".")]
            pub const $constant: Dimension = Dimension { name: $name, units: &[$(($unit, $factor)),+] };

            #[doc = concat!("Reads ", $name, ", in SI or quoted with a unit.")]
            pub fn $function<'de, D: Deserializer<'de>>(d: D) -> Result<f64, D::Error> {
                d.deserialize_any(Number($constant))
            }

            #[doc = concat!("Reads ", $name, " for an optional field.")]
            pub fn $optional<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
                $function(d).map(Some)
            }
        )+
    };
}

dimensions! {
    LENGTH length optional_length "a length" [("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6), ("nm", 1e-9)]
    AREA area optional_area "an area" [("m2", 1.0), ("cm2", 1e-4), ("mm2", 1e-6), ("um2", 1e-12)]
    PRESSURE pressure optional_pressure "a pressure" [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)]
    STIFFNESS stiffness optional_stiffness "a stiffness per area" [("Pa/m", 1.0), ("kPa/m", 1e3), ("MPa/m", 1e6), ("GPa/m", 1e9), ("GPa/mm", 1e12)]
    SPEED speed optional_speed "a speed" [("m/s", 1.0), ("cm/s", 1e-2), ("mm/s", 1e-3), ("km/h", 1.0 / 3.6)]
    SPIN spin optional_spin "an angular speed" [("rad/s", 1.0), ("deg/s", std::f64::consts::PI / 180.0), ("rpm", std::f64::consts::PI / 30.0)]
    ANGLE angle optional_angle "an angle" [("rad", 1.0), ("deg", std::f64::consts::PI / 180.0)]
    FORCE force optional_force "a force" [("N", 1.0), ("mN", 1e-3), ("kN", 1e3), ("MN", 1e6)]
    MASS mass optional_mass "a mass" [("kg", 1.0), ("g", 1e-3), ("mg", 1e-6), ("ug", 1e-9)]
    DENSITY density optional_density "a density" [("kg/m3", 1.0), ("kg/m^3", 1.0), ("g/cm3", 1e3), ("g/cm^3", 1e3)]
    ACCELERATION acceleration optional_acceleration "an acceleration" [("m/s2", 1.0), ("m/s^2", 1.0)]
    TIME time optional_time "a time" [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("ns", 1e-9), ("min", 60.0), ("h", 3600.0)]
}

impl Dimension {
    /// The SI value of `text`, such as `"6.6 GPa"`; the message says what was allowed.
    pub fn parse(self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let split = text
            .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | '_')))
            .map_or(text.len(), |at| number_end(text, at));
        let (number, unit) = (text[..split].trim(), text[split..].trim());
        let value: f64 = number
            .replace('_', "")
            .parse()
            .map_err(|_| format!("`{text}` does not start with a number; {}", self.allowed()))?;
        if unit.is_empty() {
            return Err(format!("`{text}` has no unit; {}", self.allowed()));
        }
        let factor = self.units.iter().find(|(name, _)| *name == unit);
        let (_, factor) = factor.ok_or_else(|| {
            format!("`{unit}` is not a unit of {}; {}", self.name, self.allowed())
        })?;
        Ok(value * factor)
    }

    fn allowed(self) -> String {
        let units: Vec<_> = self.units.iter().map(|(name, _)| *name).collect();
        format!("{} is written in {}", self.name, units.join(", "))
    }
}

/// End of the number whose digits stop at `at`: an exponent belongs to it.
fn number_end(text: &str, at: usize) -> usize {
    let rest = &text[at..];
    if !rest.starts_with(['e', 'E']) {
        return at;
    }
    let exponent = rest[1..].trim_start_matches(['+', '-']);
    let digits = exponent.len() - exponent.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    if digits == 0 {
        return at;
    }
    at + (rest.len() - exponent.len()) + digits
}

struct Number(Dimension);

impl Visitor<'_> for Number {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a number in SI units, or a quoted number with a unit ({})", self.0.allowed())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        match value.is_finite() {
            true => Ok(value),
            false => Err(E::custom(format!("`{value}` is not a finite number"))),
        }
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
        self.0.parse(text).map_err(E::custom).and_then(|value| self.visit_f64(value))
    }
}
