//! `abrade schema`: the form of a scene file, or of a study's.

use abrade_scene::Field;
use anyhow::Context;

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
    if arguments.fields {
        return say(&fields(what, &abrade_scene::fields_of(&schema)));
    }
    let text = serde_json::to_string_pretty(&schema)
        .context("the schema cannot be printed")
        .map_err(Failure::Run)?;
    say(&(text + "\n"))
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
