//! The form of a scene file, made from the scene's own types: a JSON schema, and a field reference
//! for reading.

use serde_json::{Map, Value};

use crate::scene::Scene;

/// A field, or a variant, of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Path as `--set` takes it, `<name>` standing for any name and `<i>` for an index; a variant's
    /// own row ends in `= Variant`.
    pub path: String,
    /// Variant that the field belongs to, if any.
    pub variant: String,
    /// Kind of value.
    pub kind: String,
    /// Unit in which a bare number counts; empty without one.
    pub unit: String,
    /// Default value, or `required`.
    pub default: String,
    /// What it is.
    pub meaning: String,
}

/// The JSON schema of a scene.
pub fn schema() -> Value {
    schemars::schema_for!(Scene).to_value()
}

/// Every field of a scene, in the order of the schema.
pub fn fields() -> Vec<Field> {
    fields_of(&schema())
}

/// Every field of a file with the JSON schema `root`, in its order.
pub fn fields_of(root: &Value) -> Vec<Field> {
    let mut walk = Walk { root, fields: Vec::new() };
    walk.struct_fields("", "", root);
    walk.fields
}

struct Walk<'a> {
    root: &'a Value,
    fields: Vec<Field>,
}

impl<'a> Walk<'a> {
    /// Rows for the fields of an object's schema.
    fn struct_fields(&mut self, path: &str, variant: &str, schema: &'a Value) {
        let required: Vec<&str> =
            list(schema, "required").iter().filter_map(Value::as_str).collect();
        for (name, field) in object(schema, "properties") {
            let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
            let target = self.resolved(field);
            let (meaning, unit) = unit_of(&description(field, target));
            let (meaning, stated) = default_of(&meaning);
            let default = match (field.get("default"), required.contains(&name.as_str())) {
                (_, true) => "required".to_owned(),
                (Some(value), _) if !value.is_null() && stated.is_empty() => value.to_string(),
                _ => stated,
            };
            let kind = self.kind(field);
            let variant = variant.to_owned();
            self.fields.push(Field { path: path.clone(), variant, kind, unit, default, meaning });
            self.inside(&path, target);
        }
    }

    /// Rows for what is inside the value that `schema` describes.
    fn inside(&mut self, path: &str, schema: &'a Value) {
        let schema = self.resolved(schema);
        let variants = list(schema, "oneOf");
        if !variants.is_empty() {
            variants.iter().for_each(|variant| self.variant_fields(path, variant));
        } else if let Some(items) = schema.get("items").filter(|_| !is_tuple(schema)) {
            self.inside(&format!("{path}.<i>"), items);
        } else if let Some(values) = schema.get("additionalProperties").filter(|v| v.is_object()) {
            let path = format!("{path}.<name>");
            let target = self.resolved(values);
            self.struct_fields(&path, "", target);
        } else {
            self.struct_fields(path, "", schema);
        }
    }

    fn variant_fields(&mut self, path: &str, variant: &'a Value) {
        let meaning = text(variant, "description");
        let mut row = |name: &str| {
            self.fields.push(Field {
                path: format!("{path} = {name}"),
                variant: String::new(),
                kind: "variant".into(),
                unit: String::new(),
                default: String::new(),
                meaning: meaning.clone(),
            });
        };
        if let Some(name) = variant.get("const").and_then(Value::as_str) {
            row(name);
        }
        list(variant, "enum").iter().filter_map(Value::as_str).for_each(&mut row);
        let named: Vec<_> = object(variant, "properties").collect();
        for (name, fields) in named {
            self.fields.push(Field {
                path: format!("{path} = {name}(..)"),
                variant: String::new(),
                kind: "variant".into(),
                unit: String::new(),
                default: String::new(),
                meaning: meaning.clone(),
            });
            let fields = self.resolved(fields);
            self.struct_fields(path, name, fields);
        }
    }

    /// Kind of value, in words.
    fn kind(&self, field: &'a Value) -> String {
        let schema = self.resolved(field);
        if !list(schema, "oneOf").is_empty() || !list(schema, "enum").is_empty() {
            return "variant".into();
        }
        let kinds: Vec<&str> = match schema.get("type") {
            Some(Value::String(one)) => vec![one],
            Some(Value::Array(all)) => all.iter().filter_map(Value::as_str).collect(),
            _ => Vec::new(),
        };
        let kinds: Vec<&str> = kinds.into_iter().filter(|kind| *kind != "null").collect();
        match kinds[..] {
            ["number", "string"] => "number or \"number unit\"".into(),
            ["integer"] => "whole number".into(),
            ["string"] => "text".into(),
            ["boolean"] => "true or false".into(),
            ["array"] if is_tuple(schema) => {
                let count = schema.get("minItems").and_then(Value::as_u64).unwrap_or(0);
                format!("tuple of {count}")
            }
            ["array"] => "list".into(),
            ["object"] if schema.get("additionalProperties").is_some_and(Value::is_object) => {
                "map by name".into()
            }
            ["object"] => "fields".into(),
            [other] => other.into(),
            _ => String::new(),
        }
    }

    /// The schema itself, references and options followed.
    fn resolved(&self, schema: &'a Value) -> &'a Value {
        if let Some(path) = schema.get("$ref").and_then(Value::as_str) {
            let target = path.strip_prefix('#').and_then(|path| self.root.pointer(path));
            return target.map_or(schema, |target| self.resolved(target));
        }
        let some = |option: &&Value| option.get("type").and_then(Value::as_str) != Some("null");
        match list(schema, "anyOf").iter().find(some) {
            Some(inner) => self.resolved(inner),
            None => schema,
        }
    }
}

fn is_tuple(schema: &Value) -> bool {
    schema.get("minItems").is_some()
}

fn list<'a>(schema: &'a Value, key: &str) -> &'a [Value] {
    schema.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

fn object<'a>(schema: &'a Value, key: &str) -> impl Iterator<Item = (&'a String, &'a Value)> {
    schema.get(key).and_then(Value::as_object).into_iter().flat_map(Map::iter)
}

fn text(schema: &Value, key: &str) -> String {
    let text = schema.get(key).and_then(Value::as_str).unwrap_or_default();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The field's own description, else that of its type.
fn description(field: &Value, target: &Value) -> String {
    let own = text(field, "description");
    if own.is_empty() { text(target, "description") } else { own }
}

/// The meaning without its unit, and the unit that it states in brackets.
fn unit_of(description: &str) -> (String, String) {
    let stated = description.find(" [").and_then(|start| {
        let end = start + description[start..].find(']')?;
        Some((start, end))
    });
    match stated {
        Some((start, end)) => (
            format!("{}{}", &description[..start], &description[end + 1..]),
            description[start + 2..end].to_owned(),
        ),
        None => (description.to_owned(), String::new()),
    }
}

/// The meaning without the default that it states as `(default ..)`, and that default.
fn default_of(meaning: &str) -> (String, String) {
    let Some((before, rest)) = meaning.split_once(" (default") else {
        return (meaning.to_owned(), String::new());
    };
    let mut depth = 1;
    let end = rest.find(|c| {
        depth += match c {
            '(' => 1,
            ')' => -1,
            _ => 0,
        };
        depth == 0
    });
    let (stated, after) = rest.split_at(end.unwrap_or(rest.len()));
    let default = stated.trim_start_matches(':').trim().trim_matches('`');
    (format!("{before}{}", after.strip_prefix(')').unwrap_or(after)), default.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_says_what_it_is_and_every_quantity_its_unit() {
        let fields = fields();
        assert!(fields.len() > 80, "{}", fields.len());
        for field in &fields {
            assert!(!field.meaning.is_empty(), "{field:?}");
            assert!(!field.kind.is_empty(), "{field:?}");
            assert!(!field.kind.contains("unit") || !field.unit.is_empty(), "{field:?}");
        }
    }

    #[test]
    fn a_field_is_found_with_its_unit_and_default() {
        let fields = fields();
        let find = |path: &str| fields.iter().find(|field| field.path == path).cloned().unwrap();
        let speed = find("bodies.<name>.motion.speed");
        assert_eq!((speed.unit.as_str(), speed.default.as_str()), ("m/s", "required"));
        assert_eq!(speed.variant, "Impact");
        assert_eq!(find("run.accuracy").default, "0.001");
        assert_eq!(find("surfaces.<name>.elastic").default, "Foundation()");
        assert_eq!(find("materials.<name>.hardness").unit, "Pa");
        assert_eq!(find("outputs.<i>.every").unit, "s");
        assert_eq!(find("run.stop = Time(..)").meaning, "After a time.");
    }
}
