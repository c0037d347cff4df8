//! Numbers that may be written with a unit: `6.6e9`, or `"6.6 GPa"` where a pressure is meant.
//!
//! One table of units, one function per dimension for `#[serde(deserialize_with)]`, and tuples of
//! such numbers. A bare number is in SI (angles in radians); a quoted one must carry its unit.
//! Binary formats hold bare numbers.
//! Messages have the form `what is wrong; what was expected`, with `; did you mean ..?` after it
//! where only the case of a unit is wrong.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, SeqAccess, Visitor};

/// Stands for a dimensioned number in JSON schemas: a number in SI units, or a quoted one with a
/// unit.
#[derive(Clone, Copy, Debug)]
pub struct Quantity;

impl JsonSchema for Quantity {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Quantity".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["number", "string"] })
    }
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
            ///
            /// # Errors
            /// Not a number, not finite, no unit, a unit of something else.
            pub fn $function<'de, D: Deserializer<'de>>(d: D) -> Result<f64, D::Error> {
                $constant.deserialize(d)
            }

            #[doc = concat!("Reads ", $name, " for an optional field.")]
            ///
            /// # Errors
            /// Not a number, not finite, no unit, a unit of something else.
            pub fn $optional<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
                if d.is_human_readable() {
                    $constant.deserialize(d).map(Some)
                } else {
                    Option::deserialize(d)
                }
            }
        )+
    };
}

dimensions! {
    LENGTH length optional_length "a length" [("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6), ("nm", 1e-9)]
    AREA area optional_area "an area" [("m2", 1.0), ("cm2", 1e-4), ("mm2", 1e-6), ("um2", 1e-12)]
    PRESSURE pressure optional_pressure "a pressure" [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9)]
    HARDNESS hardness optional_hardness "a hardness" [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9), ("HV", 9.806_65e6)]
    STIFFNESS stiffness optional_stiffness "a stiffness per area" [("Pa/m", 1.0), ("kPa/m", 1e3), ("MPa/m", 1e6), ("GPa/m", 1e9), ("GPa/mm", 1e12)]
    SPEED speed optional_speed "a speed" [("m/s", 1.0), ("cm/s", 1e-2), ("mm/s", 1e-3), ("km/h", 1.0 / 3.6)]
    SPIN spin optional_spin "an angular speed" [("rad/s", 1.0), ("deg/s", std::f64::consts::PI / 180.0), ("rpm", std::f64::consts::PI / 30.0)]
    FREQUENCY frequency optional_frequency "a frequency" [("Hz", 1.0), ("kHz", 1e3), ("rpm", 1.0 / 60.0)]
    AREA_ENERGY area_energy optional_area_energy "an energy per area" [("J/m2", 1.0), ("J/m^2", 1.0), ("mJ/m2", 1e-3), ("mJ/m^2", 1e-3), ("N/m", 1.0), ("mN/m", 1e-3)]
    ANGLE angle optional_angle "an angle" [("rad", 1.0), ("deg", std::f64::consts::PI / 180.0), ("°", std::f64::consts::PI / 180.0)]
    FORCE force optional_force "a force" [("N", 1.0), ("mN", 1e-3), ("kN", 1e3), ("MN", 1e6)]
    MASS mass optional_mass "a mass" [("kg", 1.0), ("g", 1e-3), ("mg", 1e-6), ("ug", 1e-9)]
    MASS_RATE mass_rate optional_mass_rate "a mass per time" [("kg/s", 1.0), ("g/s", 1e-3), ("mg/s", 1e-6), ("g/min", 1e-3 / 60.0), ("kg/h", 1.0 / 3600.0)]
    DENSITY density optional_density "a density" [("kg/m3", 1.0), ("kg/m^3", 1.0), ("g/cm3", 1e3), ("g/cm^3", 1e3)]
    ACCELERATION acceleration optional_acceleration "an acceleration" [("m/s2", 1.0), ("m/s^2", 1.0)]
    TIME time optional_time "a time" [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("ns", 1e-9), ("min", 60.0), ("h", 3600.0)]
}

impl Dimension {
    /// The SI value of `text`, such as `"6.6 GPa"` or `"1/240 s"`.
    ///
    /// # Errors
    /// A message that says what is wrong and what was allowed.
    pub fn parse(self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let (number, unit) = text.split_at(number_end(text));
        let (number, unit) = (number.trim(), unit.trim());
        let value = value_of(number).ok_or_else(|| {
            format!("`{text}` does not start with a finite number; {}", self.expected())
        })?;
        if unit.is_empty() {
            return Err(format!("`{text}` has no unit; {}", self.expected()));
        }
        match self.units.iter().find(|(name, _)| *name == unit) {
            Some((_, factor)) => Ok(value * factor),
            None => Err(self.foreign(unit)),
        }
    }

    /// Reads a tuple of `N` such numbers.
    ///
    /// # Errors
    /// Not a tuple of that length, or a number refused as by a single field.
    pub fn array<'de, const N: usize, D>(self, d: D) -> Result<[f64; N], D::Error>
    where
        D: Deserializer<'de>,
    {
        Row::<N>(self).deserialize(d)
    }

    /// Reads a list of tuples of `N` such numbers.
    ///
    /// # Errors
    /// Not a list, or a tuple refused as by [`Dimension::array`].
    pub fn rows<'de, const N: usize, D>(self, d: D) -> Result<Vec<[f64; N]>, D::Error>
    where
        D: Deserializer<'de>,
    {
        d.deserialize_seq(Rows::<N>(self))
    }

    /// Reads a list of such numbers.
    ///
    /// # Errors
    /// Not a list, or a number refused as by a single field.
    pub fn list<'de, D: Deserializer<'de>>(self, d: D) -> Result<Vec<f64>, D::Error> {
        d.deserialize_seq(List(self))
    }

    /// The message about a unit that does not measure this.
    fn foreign(self, unit: &str) -> String {
        let mut message = format!("`{unit}` does not measure {}; {}", self.name, self.expected());
        if let Some((near, _)) = self.units.iter().find(|(name, _)| name.eq_ignore_ascii_case(unit))
        {
            message += &format!("; did you mean `{near}`?");
        }
        message
    }

    fn expected(self) -> String {
        format!("expected {} in {}", self.name, self.unit_list())
    }

    fn unit_list(self) -> String {
        let units: Vec<_> = self.units.iter().map(|(name, _)| *name).collect();
        match units.split_last() {
            Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
            _ => units.concat(),
        }
    }
}

/// Where the number that `text` starts with ends: digits, `.`, `_`, an exponent, and one division
/// by a further number.
fn number_end(text: &str) -> usize {
    let mut end = 0;
    let mut before = ' ';
    for (at, c) in text.char_indices() {
        let rest = &text[at + c.len_utf8()..];
        let belongs = match c {
            '0'..='9' | '.' | '_' => true,
            '+' | '-' => at == 0 || matches!(before, 'e' | 'E'),
            'e' | 'E' => {
                let exponent = rest.strip_prefix(['+', '-']).unwrap_or(rest);
                at > 0 && exponent.starts_with(|c: char| c.is_ascii_digit())
            }
            '/' => before.is_ascii_digit() && rest.starts_with(|c: char| c.is_ascii_digit()),
            _ => false,
        };
        if !belongs {
            break;
        }
        end = at + c.len_utf8();
        before = c;
    }
    end
}

/// A number or a quotient of two, if it is finite.
fn value_of(number: &str) -> Option<f64> {
    let number = number.replace('_', "");
    let value: f64 = match number.split_once('/') {
        None => number.parse().ok()?,
        Some((above, below)) => above.parse::<f64>().ok()? / below.parse::<f64>().ok()?,
    };
    value.is_finite().then_some(value)
}

impl<'de> DeserializeSeed<'de> for Dimension {
    type Value = f64;

    fn deserialize<D: Deserializer<'de>>(self, d: D) -> Result<f64, D::Error> {
        if d.is_human_readable() { d.deserialize_any(Number(self)) } else { f64::deserialize(d) }
    }
}

struct Number(Dimension);

impl Visitor<'_> for Number {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self(dimension) = self;
        let units = dimension.unit_list();
        write!(f, "{}: a number in SI units, or a quoted one in {units}", dimension.name)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        match value.is_finite() {
            true => Ok(value),
            false => {
                Err(E::custom(format!("`{value}` is not a finite number; {}", self.0.expected())))
            }
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

#[derive(Clone, Copy)]
struct Row<const N: usize>(Dimension);

impl<'de, const N: usize> DeserializeSeed<'de> for Row<N> {
    type Value = [f64; N];

    fn deserialize<D: Deserializer<'de>>(self, d: D) -> Result<Self::Value, D::Error> {
        d.deserialize_tuple(N, self)
    }
}

impl<'de, const N: usize> Visitor<'de> for Row<N> {
    type Value = [f64; N];

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a tuple of {N} numbers, each {}", self.0.name)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut row = [0.0; N];
        for (i, value) in row.iter_mut().enumerate() {
            *value =
                seq.next_element_seed(self.0)?.ok_or_else(|| A::Error::invalid_length(i, &self))?;
        }
        Ok(row)
    }
}

struct Rows<const N: usize>(Dimension);

impl<'de, const N: usize> Visitor<'de> for Rows<N> {
    type Value = Vec<[f64; N]>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a list of tuples of {N} numbers, each {}", self.0.name)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut rows = Vec::new();
        while let Some(row) = seq.next_element_seed(Row::<N>(self.0))? {
            rows.push(row);
        }
        Ok(rows)
    }
}

struct List(Dimension);

impl<'de> Visitor<'de> for List {
    type Value = Vec<f64>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "a list of numbers, each {}", self.0.name)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut numbers = Vec::new();
        while let Some(number) = seq.next_element_seed(self.0)? {
            numbers.push(number);
        }
        Ok(numbers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quoted_number_is_scaled_by_its_unit() {
        assert_eq!(PRESSURE.parse("6.6 GPa"), Ok(6.6e9));
        assert_eq!(LENGTH.parse(" 1_000um "), Ok(1e-3));
        assert_eq!(LENGTH.parse("-1.5e-3 mm"), Ok(-1.5e-3 * 1e-3));
        assert_eq!(TIME.parse("1/240 s"), Ok(1.0 / 240.0));
        assert_eq!(ANGLE.parse("180 deg"), Ok(std::f64::consts::PI));
        assert_eq!(HARDNESS.parse("200 HV"), Ok(200.0 * 9.806_65e6));
    }

    #[test]
    fn a_refusal_says_what_is_wrong_and_what_was_expected() {
        let refusal = |text| PRESSURE.parse(text).unwrap_err();
        let expected = "expected a pressure in Pa, kPa, MPa or GPa";
        assert_eq!(refusal("6.6"), format!("`6.6` has no unit; {expected}"));
        assert_eq!(refusal("6 mm"), format!("`mm` does not measure a pressure; {expected}"));
        assert_eq!(
            refusal("GPa"),
            format!("`GPa` does not start with a finite number; {expected}")
        );
        assert_eq!(
            refusal("1/0 GPa"),
            format!("`1/0 GPa` does not start with a finite number; {expected}")
        );
        assert_eq!(
            refusal("6 Gpa"),
            format!("`Gpa` does not measure a pressure; {expected}; did you mean `GPa`?")
        );
    }
}
