//! `abrade laws`: lists the closed-form laws, and evaluates one.

use abrade_laws::{Law, Parameter, Status, laws as all};
use abrade_scene::suggestion;
use anyhow::anyhow;

use crate::arguments::{LawsArguments, LawsCommand};
use crate::failure::Failure;
use crate::say::say;

mod contact;
mod limits;
mod sides;
mod values;

use values::{Values, values};

/// Prints the list of laws, or the value of one.
pub(crate) fn laws(arguments: &LawsArguments) -> Result<(), Failure> {
    match (&arguments.command, &arguments.name) {
        (Some(LawsCommand::Contact(arguments)), _) => contact::contact(arguments),
        (None, Some(name)) if arguments.list => say(&told(find("law", name, all())?)),
        (None, Some(name)) => evaluate(find("law", name, all())?, arguments),
        (None, None) if arguments.list => say(&list(all())),
        (None, None) => say(&titles(all())),
    }
}

/// A name and a title a line, and how to learn more.
fn titles(laws: impl Iterator<Item = &'static Law>) -> String {
    let lines: String = laws.map(|law| format!("{:<24} {}\n", law.name, law.title)).collect();
    lines
        + "\nabrade laws NAME --list: formula, constants, status and source; abrade laws NAME NAME=VALUE ..: \
           its value\n"
}

fn list(laws: impl Iterator<Item = &'static Law>) -> String {
    laws.map(told).collect::<Vec<_>>().join("\n")
}

/// The law, or `what` it is called, with the name `name` among `laws`.
fn find(
    what: &str,
    name: &str,
    laws: impl Iterator<Item = &'static Law> + Clone,
) -> Result<&'static Law, Failure> {
    laws.clone().find(|law| law.name == name).ok_or_else(|| {
        let names: Vec<_> = laws.map(|law| law.name).collect();
        let near = suggestion(name, names.iter().copied());
        let there = near.map_or("there".to_owned(), |near| format!("{near} There"));
        refused(format!("there is no {what} `{name}`; {there} are {}", names.join(", ")))
    })
}

fn refused(message: String) -> Failure {
    Failure::Input(anyhow!(message))
}

/// All that is known of a law.
fn told(law: &Law) -> String {
    let memory = match (law.status, law.from_memory) {
        (_, None) => String::new(),
        (Status::Memory, Some(what)) => format!(", not found in a source: {what}"),
        (_, Some(what)) => format!("; from memory, not found in a source: {what}"),
    };
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
    values::once(given.iter().map(|values| values.parameter.name))?;
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

/// `value` as a person reads it; a table with commas has all digits.
fn four_digits(value: f64) -> String {
    let rounded = format!("{value:.3e}").parse().unwrap_or(value);
    format!("{rounded:e}")
}

fn table(law: &Law, list: Option<&Values<'_>>, results: &[f64], csv: bool) -> String {
    let heading = format!("{} [{}]", law.output.name, law.output.unit);
    match (list, csv) {
        (None, false) => format!("{heading} = {}\n", four_digits(results[0])),
        (None, true) => format!("{heading}\n{:e}\n", results[0]),
        (Some(list), true) => {
            let (unit, column) = list.column();
            let rows = column.iter().zip(results).map(|(at, value)| format!("{at},{value:e}\n"));
            let name = match unit {
                "" => list.parameter.name.to_owned(),
                unit => format!("{} [{unit}]", list.parameter.name),
            };
            format!("{name},{heading}\n{}", rows.collect::<String>())
        }
        (Some(Values { parameter, texts, .. }), false) => {
            let rows = texts
                .iter()
                .zip(results)
                .map(|(at, value)| format!("{at:<12} {}\n", four_digits(*value)));
            format!("{:<12} {heading}\n{}", parameter.name, rows.collect::<String>())
        }
    }
}
