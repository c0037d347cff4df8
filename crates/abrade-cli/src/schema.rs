//! `abrade schema`: the form of a scene file, or of a study's.

use abrade_scene::Field;
use anyhow::{Context, anyhow};

use crate::arguments::SchemaArguments;
use crate::failure::Failure;
use crate::say::say;

/// Prints the JSON schema, or the field reference.
pub(crate) fn schema(arguments: &SchemaArguments) -> Result<(), Failure> {
    let (what, schema) = match arguments {
        SchemaArguments { study: true, .. } => ("study", abrade_study::erosion::schema()),
        SchemaArguments { adhesive: true, .. } => ("scene", abrade_study::adhesive::scene_schema()),
        SchemaArguments { map: true, .. } => ("map", abrade_study::adhesive::map_schema()),
        _ => ("scene", abrade_scene::schema()),
    };
    match &arguments.fields {
        Some(None) => return say(&fields(what, &abrade_scene::fields_of(&schema))),
        Some(Some(prefix)) => {
            let mut part = abrade_scene::fields_of(&schema);
            part.retain(|field| begins(&field.path, prefix));
            if part.is_empty() {
                let message = format!("no field of a {what} begins with `{prefix}`");
                return Err(Failure::Input(anyhow!(message)));
            }
            return say(&fields(what, &part));
        }
        None => {}
    }
    let text = serde_json::to_string_pretty(&schema)
        .context("the schema cannot be printed")
        .map_err(Failure::Run)?;
    say(&(text + "\n"))
}

/// Whether `path` begins with `prefix`, in which any word may stand for a `<name>` or an `<i>`.
fn begins(path: &str, prefix: &str) -> bool {
    let mut parts = path.split('.');
    let mut wanted = prefix.split('.').peekable();
    while let Some(want) = wanted.next() {
        let Some(part) = parts.next() else { return false };
        let is_any = part.starts_with('<') && !want.is_empty();
        let fits = match wanted.peek() {
            Some(_) => part == want,
            None => part.starts_with(want),
        };
        if !(is_any || fits) {
            return false;
        }
    }
    true
}

fn fields(what: &str, fields: &[Field]) -> String {
    let mut text = format!(
        "Fields of a {what}: path, kind of value, unit of a bare number, default.\n\
         <name> stands for any name, <i> for an index from 0.\n\n",
    );
    for field in fields {
        let unit = bracketed(&field.unit);
        let default = match field.default.as_str() {
            "" => String::new(),
            "required" => ", required".into(),
            default => format!(", default {default}"),
        };
        let of = match field.variant.as_str() {
            "" => String::new(),
            variant => format!(" (of {variant})"),
        };
        text += &match field.kind.as_str() {
            "variant" if field.path.contains(" = ") => format!("{}\n", field.path),
            kind => format!("{}{of}: {kind}{unit}{default}\n", field.path),
        };
        text += &format!("    {}\n", field.meaning);
    }
    text
}

fn bracketed(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" [{unit}]") }
}
