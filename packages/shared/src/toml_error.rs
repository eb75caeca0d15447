//! What is wrong with a file that is TOML but not what is wanted, in the words of its reader: key, value, what is
//! allowed.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::nearest;

/// A value of more characters is cut.
const LONGEST: usize = 40;

/// The message for an error: `layers is "many"; allowed: a whole number`, or the parser's own where no value is wrong.
pub fn message(text: &str, error: &toml::de::Error) -> String {
    explained(text, error).unwrap_or_else(|| with_hint(error.message().trim_end()))
}

/// The message, with what an unknown key may have been meant to be: `unknown field `sped`, did you mean speed? expected
/// one of …`.
fn with_hint(message: &str) -> String {
    let parts = || {
        let (name, expected) = message.strip_prefix("unknown field `")?.split_once("`, ")?;
        let hint = nearest::hint(name, expected.split('`').skip(1).step_by(2));
        (!hint.is_empty()).then(|| format!("unknown field `{name}`{hint} {expected}"))
    };
    parts().unwrap_or_else(|| message.to_string())
}

fn explained(text: &str, error: &toml::de::Error) -> Option<String> {
    let span = error.span()?;
    let tables = DeTable::parse(text).ok()?;
    let key = key_in(tables.get_ref(), &span)?;
    let allowed = allowed(error.message(), &key)?;
    Some(format!("{key} is {}; allowed: {allowed}", shortened(text.get(span)?)))
}

/// The key whose value stands at this place of the file.
fn key_in(table: &DeTable, span: &Range<usize>) -> Option<String> {
    table.iter().find_map(|(key, value)| key_of(key.get_ref(), value, span))
}

/// `key`, where its value or something in it stands at this place.
fn key_of(key: &str, value: &Spanned<DeValue>, span: &Range<usize>) -> Option<String> {
    if value.span() == *span {
        return Some(key.to_string());
    }
    match value.get_ref() {
        DeValue::Table(table) => key_in(table, span),
        DeValue::Array(entries) => {
            let entry = format!("an entry of {key}");
            entries.iter().find_map(|value| key_of(&entry, value, span))
        }
        _ => None,
    }
}

/// The expected value that a message names, in words instead of Rust's types.
fn allowed(message: &str, key: &str) -> Option<String> {
    if message == "wanted string or table" {
        return Some("a word in quotes".to_string());
    }
    let (found, expected) = message.split_once("expected ")?;
    let length = expected.strip_prefix("an array of length ").map(|length| format!("a list of {length} numbers"));
    let words = match expected {
        "i64" => "a whole number",
        "usize" => "a whole number >= 0",
        "f64" => "a number",
        "a boolean" => "true or false",
        "a string" => "text in quotes",
        "a map" => "a table",
        "a sequence" if found.contains("map") => return Some(format!("[[{key}]]")),
        "a sequence" => "a list",
        _ if expected.starts_with("struct ") => "a table",
        _ => return Some(length.unwrap_or_else(|| expected.trim_start_matches("one of ").replace('`', ""))),
    };
    Some(words.to_string())
}

/// A value on one line, cut where it is long.
pub fn shortened(value: &str) -> String {
    let line = value.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.chars().count() <= LONGEST { line } else { line.chars().take(LONGEST).chain(['…']).collect() }
}
