//! Whether a file is as its schema wants it. A validator of all of JSON Schema would be some seventy crates more; the
//! schemas here have few words, and one that is not known here is refused.

use serde_json::Value;

use crate::schema::resolved;

/// What is wrong with a value of a file, the first fault alone, with its place.
///
/// # Errors
/// It is not as its schema wants it.
pub fn check(root: &Value, schema: &Value, value: &toml::Value, place: &str) -> Result<(), String> {
    let fault = |what: &str| Err(format!("{place}: {what}"));
    let words = match schema {
        Value::Bool(true) => return Ok(()),
        Value::Object(words) => words,
        _ => panic!("{place}: no schema: {schema}"),
    };
    for (word, wanted) in words {
        let number = || value.as_float().or(value.as_integer().map(|value| value as f64));
        let bound = |holds: fn(f64, f64) -> bool| match (number(), wanted.as_f64()) {
            (Some(value), Some(bound)) if !holds(value, bound) => fault(&format!("{value} against {word} {bound}")),
            _ => Ok(()),
        };
        let length = value.as_array().map(Vec::len);
        let entries = |wanted: &Value| -> Vec<Result<(), String>> {
            let choices = wanted.as_array().expect("a list of schemas").iter();
            choices.map(|choice| check(root, choice, value, place)).collect()
        };
        match word.as_str() {
            "$schema" | "title" | "description" | "definitions" | "x-order" | "default" => {}
            "$ref" => check(root, resolved(root, schema), value, place)?,
            "allOf" => entries(wanted).into_iter().collect::<Result<(), _>>()?,
            "anyOf" | "oneOf" => {
                let fits = entries(wanted).iter().filter(|choice| choice.is_ok()).count();
                if fits == 0 || word == "oneOf" && fits > 1 {
                    return fault("none of the choices, or several");
                }
            }
            "type" if !is_of(value, wanted.as_str().expect("one type")) => return fault(&format!("no {wanted}")),
            "type" => {}
            "enum" if !wanted.as_array().expect("words").iter().any(|word| word.as_str() == value.as_str()) => {
                return fault(&format!("{value:?} is none of {wanted}"));
            }
            "enum" => {}
            "const" if wanted.as_str() != value.as_str() => return fault(&format!("{value:?} is not {wanted}")),
            "const" => {}
            "minimum" => bound(|value, bound| value >= bound)?,
            "exclusiveMinimum" => bound(|value, bound| value > bound)?,
            "maximum" => bound(|value, bound| value <= bound)?,
            "exclusiveMaximum" => bound(|value, bound| value < bound)?,
            "minItems" if length.is_some_and(|length| (length as u64) < wanted.as_u64().expect("a number")) => {
                return fault("too few entries");
            }
            "maxItems" if length.is_some_and(|length| (length as u64) > wanted.as_u64().expect("a number")) => {
                return fault("too many entries");
            }
            "minItems" | "maxItems" => {}
            "items" => {
                for (number, entry) in value.as_array().into_iter().flatten().enumerate() {
                    check(root, wanted, entry, &format!("{place}[{number}]"))?;
                }
            }
            "required" => {
                let keys = wanted.as_array().expect("names").iter().filter_map(Value::as_str);
                let table = value.as_table();
                if let Some(key) = keys.into_iter().find(|key| table.is_some_and(|table| !table.contains_key(*key))) {
                    return fault(&format!("{key} is missing"));
                }
            }
            "properties" => {}
            "additionalProperties" => {}
            _ => panic!("{place}: {word} is not known"),
        }
    }
    for (key, entry) in value.as_table().into_iter().flatten() {
        let place = format!("{place}.{key}");
        match (schema["properties"].get(key), schema.get("additionalProperties")) {
            (Some(schema), _) | (None, Some(schema @ Value::Object(_))) => check(root, schema, entry, &place)?,
            (None, Some(Value::Bool(false))) => return Err(format!("{place}: an unknown key")),
            (None, _) => {}
        }
    }
    Ok(())
}

fn is_of(value: &toml::Value, name: &str) -> bool {
    match name {
        "number" => value.is_float() || value.is_integer(),
        "integer" => value.is_integer(),
        "boolean" => value.is_bool(),
        "string" => value.is_str(),
        "array" => value.is_array(),
        "object" => value.is_table(),
        _ => panic!("{name} is no type"),
    }
}
