//! The schema of each kind of file, as draft 7 of JSON Schema: what editors' extensions read.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::{Value, json};
use toron_materials::{load_path, material};
use toron_parameters::{cell, fibres, identify};
use toron_shared::schema::ORDER;
use toron_strikes::{fabric, impact, weave};

use crate::page::without_links;

/// The files' kinds, each with its schema.
pub fn all() -> Vec<(&'static str, Value)> {
    vec![
        ("weave", schema::<weave::file::SceneFile>("A weave, for toron weave")),
        ("fabric", schema::<fabric::file::SceneFile>("A struck panel, for toron fabric, weave and v50")),
        ("impact", schema::<impact::file::SceneFile>("A struck yarn, for toron impact and v50")),
        ("fibres", schema::<fibres::file::SceneFile>("A bundle of fibres, for toron fibres")),
        ("cell", schema::<cell::file::SceneFile>("A section of fibres, for toron cell")),
        ("run", schema::<load_path::file::PathFile>("A load path, for toron run")),
        ("preset", schema::<material::preset::PresetFile>("A yarn of one's own")),
        ("fit", schema::<identify::file::FitFile>("Data of a yarn, for toron fit")),
        ("check", schema::<umat_check::input::File>("The material of a UMAT, for toron check")),
        ("blow", schema::<identify::blow::file::BlowFile>("A fit from a blow, for toron fit")),
    ]
}

fn schema<T: JsonSchema>(title: &str) -> Value {
    let mut schema: Schema = SchemaSettings::draft07().into_generator().into_root_schema_for::<T>();
    schema.remove("description");
    schema.insert("title".to_string(), title.into());
    let mut schema = schema.to_value();
    simplify(&mut schema);
    schema
}

/// Takes out what says nothing of a TOML file: the value null, widths of numbers, lines of comments.
fn simplify(schema: &mut Value) {
    match schema {
        Value::Array(parts) => parts.iter_mut().for_each(simplify),
        Value::Object(parts) => {
            if parts.get("format").is_some_and(Value::is_string) {
                parts.remove("format");
            }
            if let Some(Value::String(text)) = parts.get_mut("description") {
                *text = text.split_whitespace().collect::<Vec<_>>().join(" ");
            }
            if let Some(Value::Array(types)) = parts.get_mut("type") {
                types.retain(|name| name != "null");
                if let [only] = &types[..] {
                    let only = only.clone();
                    parts.insert("type".to_string(), only);
                }
            }
            if let Some(Value::Array(words)) = parts.get_mut("enum") {
                words.retain(|word| !word.is_null());
            }
            if let Some(Value::Array(choices)) = parts.get_mut("anyOf") {
                choices.retain(|choice| *choice != json!({ "type": "null" }));
                if choices.len() == 1 {
                    parts.insert("allOf".to_string(), parts["anyOf"].clone());
                    parts.remove("anyOf");
                }
            }
            parts.values_mut().for_each(simplify);
        }
        _ => {}
    }
}

/// The text of a schema's file.
pub fn text(schema: &Value) -> String {
    let mut schema = schema.clone();
    plain(&mut schema);
    serde_json::to_string_pretty(&schema).expect("JSON") + "\n"
}

/// Takes out what is for the pages alone.
fn plain(schema: &mut Value) {
    match schema {
        Value::Array(parts) => parts.iter_mut().for_each(plain),
        Value::Object(parts) => {
            parts.remove(ORDER);
            if let Some(Value::String(text)) = parts.get_mut("description") {
                *text = without_links(text);
            }
            parts.values_mut().for_each(plain);
        }
        _ => {}
    }
}

/// The schema that one refers to, or itself.
pub fn resolved<'s>(root: &'s Value, schema: &'s Value) -> &'s Value {
    let referred = schema.get("$ref").or_else(|| match schema.get("allOf")?.as_array()?.as_slice() {
        [only] => only.get("$ref"),
        _ => None,
    });
    let Some(place) = referred else { return schema };
    let place = place.as_str().and_then(|place| place.strip_prefix('#')).expect("a place in this file");
    resolved(root, root.pointer(place).expect("a definition"))
}
