//! `abrade laws`: lists the closed-form laws, and evaluates one.

use abrade_laws::{Law, Parameter, laws as all};
use anyhow::anyhow;

use crate::arguments::LawsArguments;
use crate::failure::Failure;
use crate::say::say;

/// A parameter's values, as they were given and in SI.
struct Values<'a> {
    parameter: &'static Parameter,
    texts: Vec<&'a str>,
    numbers: Vec<f64>,
}

/// Prints the list of laws, or the value of one.
pub(crate) fn laws(arguments: &LawsArguments) -> Result<(), Failure> {
    match &arguments.name {
        Some(name) if arguments.list => say(&told(find(name)?)),
        Some(name) => evaluate(find(name)?, arguments),
        None => say(&all().map(told).collect::<Vec<_>>().join("\n")),
    }
}

fn find(name: &str) -> Result<&'static Law, Failure> {
    all().find(|law| law.name == name).ok_or_else(|| {
        let names: Vec<_> = all().map(|law| law.name).collect();
        refused(format!("there is no law `{name}`; there are {}", names.join(", ")))
    })
}

fn refused(message: String) -> Failure {
    Failure::Input(anyhow!(message))
}

/// All that is known of a law.
fn told(law: &Law) -> String {
    let memory = law
        .from_memory
        .map_or_else(String::new, |what| format!("; from memory, not found in a source: {what}"));
    let mut text = format!(
        "{}\n  {}\n  {} [{}] = {}\n  status: {}{memory}\n  source: {}\n",
        law.name,
        law.title,
        law.output.name,
        law.output.unit,
        law.formula,
        law.status.word(),
        law.source
    );
    for parameter in law.parameters {
        let Parameter { name, unit, meaning, default, .. } = parameter;
        let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
        let default = default.map_or_else(|| "needed".into(), shown);
        text += &format!("    {:<20} {default:<10} {meaning}\n", format!("{name}{unit}"));
    }
    text
}

/// A constant as it was written down.
fn shown(value: f64) -> String {
    if value.abs() < 1e-3 { format!("{value:e}") } else { format!("{value}") }
}

fn evaluate(law: &Law, arguments: &LawsArguments) -> Result<(), Failure> {
    let given: Vec<_> =
        arguments.given.iter().map(|text| values(law, text)).collect::<Result<_, _>>()?;
    let mut lists = given.iter().filter(|values| values.numbers.len() > 1);
    let list = lists.next();
    if let (Some(first), Some(second)) = (list, lists.next()) {
        let names = format!("`{}` and `{}`", first.parameter.name, second.parameter.name);
        return Err(refused(format!("{names} are lists; one parameter may be")));
    }
    let rows = list.map_or(1, |list| list.numbers.len());
    let value = |row: usize| {
        let at = |values: &Values<'_>| values.numbers[row.min(values.numbers.len() - 1)];
        law.evaluate(given.iter().map(|values| (values.parameter.name, at(values))))
            .map_err(|error| Failure::Input(error.into()))
    };
    let results = (0..rows).map(value).collect::<Result<Vec<_>, _>>()?;
    say(&table(law, list, &results, arguments.csv))
}

fn table(law: &Law, list: Option<&Values<'_>>, results: &[f64], csv: bool) -> String {
    let heading = format!("{} [{}]", law.output.name, law.output.unit);
    match (list, csv) {
        (None, false) => format!("{heading} = {:e}\n", results[0]),
        (None, true) => format!("{heading}\n{:e}\n", results[0]),
        (Some(Values { parameter, numbers, .. }), true) => {
            let rows = numbers.iter().zip(results).map(|(at, value)| format!("{at},{value:e}\n"));
            let name = match parameter.unit {
                "" => parameter.name.to_owned(),
                unit => format!("{} [{unit}]", parameter.name),
            };
            format!("{name},{heading}\n{}", rows.collect::<String>())
        }
        (Some(Values { parameter, texts, .. }), false) => {
            let rows = texts.iter().zip(results).map(|(at, value)| format!("{at:<12} {value:e}\n"));
            format!("{:<12} {heading}\n{}", parameter.name, rows.collect::<String>())
        }
    }
}

/// Reads `NAME=VALUE` or `NAME=VALUE, VALUE, ..`.
fn values<'a>(law: &Law, text: &'a str) -> Result<Values<'a>, Failure> {
    let (name, list) = text
        .split_once('=')
        .ok_or_else(|| refused(format!("`{text}` is no NAME=VALUE, as in angle=\"30 deg\"")))?;
    let at = law.find(name.trim()).map_err(|error| Failure::Input(error.into()))?;
    let parameter = &law.parameters[at];
    let texts: Vec<&str> = list.split(',').map(str::trim).collect();
    let numbers = texts.iter().map(|text| number(parameter, text)).collect::<Result<_, _>>()?;
    Ok(Values { parameter, texts, numbers })
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
