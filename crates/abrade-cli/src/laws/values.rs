//! `NAME=VALUE` on the command line of a law.

use abrade_laws::{Law, LawError, Parameter};
use abrade_scene::suggestion;

use super::refused;
use crate::failure::Failure;

/// A parameter's values, as they were given and in SI.
pub(super) struct Values<'a> {
    pub(super) parameter: &'static Parameter,
    pub(super) texts: Vec<&'a str>,
    pub(super) numbers: Vec<f64>,
}

impl Values<'_> {
    /// A unit and the values in it: that in which all were given, or that of SI.
    pub(super) fn column(&self) -> (&str, Vec<String>) {
        let parts = self.texts.iter().map(|text| number_and_unit(text));
        let (numbers, units): (Vec<&str>, Vec<&str>) = parts.unzip();
        match units.first() {
            Some(&unit) if !unit.is_empty() && units.iter().all(|other| *other == unit) => {
                (unit, numbers.into_iter().map(str::to_owned).collect())
            }
            _ => (self.parameter.unit, self.numbers.iter().map(f64::to_string).collect()),
        }
    }
}

/// The two parts of a text that was read: no unit begins like a number goes on.
fn number_and_unit(text: &str) -> (&str, &str) {
    let unit = text.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.eE".contains(c));
    (text[..text.len() - unit.len()].trim(), unit.trim())
}

/// Reads `NAME=VALUE` or `NAME=VALUE, VALUE, ..`.
pub(super) fn values<'a>(law: &Law, text: &'a str) -> Result<Values<'a>, Failure> {
    let (name, list) = named(text)?;
    let at = law.find(name).map_err(|error| unknown(law, name, &error))?;
    of_parameter(&law.parameters[at], list)
}

/// The two sides of `NAME=VALUE`.
pub(super) fn named(text: &str) -> Result<(&str, &str), Failure> {
    let parts = text.split_once('=');
    let (name, list) = parts
        .ok_or_else(|| refused(format!("`{text}` is no NAME=VALUE, as in angle=\"30 deg\"")))?;
    Ok((name.trim(), list))
}

/// Refuses a name that is given twice: the last value would count alone.
pub(super) fn once<'a>(names: impl Iterator<Item = &'a str>) -> Result<(), Failure> {
    let mut seen = Vec::new();
    for name in names {
        if seen.contains(&name) {
            return Err(refused(format!(
                "`{name}` is given twice; several values go into one, as in {name}=\"1, 2\""
            )));
        }
        seen.push(name);
    }
    Ok(())
}

/// Reads the values of a parameter, with commas between them.
pub(super) fn of_parameter<'a>(
    parameter: &'static Parameter,
    list: &'a str,
) -> Result<Values<'a>, Failure> {
    let texts: Vec<&str> = list.split(',').map(str::trim).collect();
    let numbers = texts.iter().map(|text| number(parameter, text)).collect::<Result<_, _>>()?;
    Ok(Values { parameter, texts, numbers })
}

/// The refusal of a name that the law does not have, with the one that was probably meant.
fn unknown(law: &Law, name: &str, error: &LawError) -> Failure {
    let near = suggestion(name, law.parameters.iter().map(|parameter| parameter.name));
    let near = near.map_or_else(String::new, |near| format!("; {near}"));
    refused(format!("{error}{near}"))
}

/// A number in SI, or with its unit.
fn number(parameter: &Parameter, text: &str) -> Result<f64, Failure> {
    if let Ok(number) = text.parse() {
        return Ok(number);
    }
    let number = match parameter.dimension {
        Some(dimension) => dimension.parse(text),
        None => Err(format!("`{text}` is no number")),
    };
    number.map_err(|message| refused(format!("`{}`: {message}", parameter.name)))
}
