//! What is wrong with a file that is TOML but not what is wanted, in the words of its reader: key, value, what is
//! allowed.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::nearest;
use super::toml_value::Wrong;

/// A value of more characters is cut.
const LONGEST: usize = 40;

/// The message for an error: `layers is "many"; allowed: a whole number`, or the parser's own where no value is wrong.
pub(crate) fn message(text: &str, wrong: &Wrong) -> String {
    explained(text, wrong).or_else(|| comma(text, wrong)).unwrap_or_else(|| with_hint(&wrong.message))
}

/// Of a line that is no TOML: the number in it whose decimals stand behind a comma.
fn comma(text: &str, wrong: &Wrong) -> Option<String> {
    if DeTable::parse(text).is_ok() {
        return None;
    }
    let (before, behind) = text.split_at_checked(wrong.place.as_ref()?.start)?;
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    let end = before.len() + behind.find('\n').unwrap_or(behind.len());
    // Within brackets commas are between numbers.
    let outside = text[start..end].split(['#', '[', '"', '\'']).next()?;
    let number = outside.split([' ', '\t', '=', '{', '}']).map(|word| word.trim_end_matches(',')).find(|word| {
        let is_whole = |part: &str| part.parse::<f64>().is_ok() && !part.contains(['.', '+']);
        word.split_once(',').is_some_and(|(whole, _)| is_whole(whole))
            && word.replacen(',', ".", 1).parse::<f64>().is_ok()
    })?;
    Some(format!("the number is {number}; allowed: a decimal point, {}", number.replacen(',', ".", 1)))
}

/// How messages about a key begin that is not known.
const UNKNOWN: &str = "unknown field `";

/// The message, with what an unknown key may have been meant to be: `unknown field `sped`, did you mean speed? expected
/// one of …`.
fn with_hint(message: &str) -> String {
    let parts = || {
        let (name, expected) = message.strip_prefix(UNKNOWN)?.split_once("`, ")?;
        let hint = nearest::hint(name, expected.split('`').skip(1).step_by(2));
        (!hint.is_empty()).then(|| format!("unknown field `{name}`{hint} {expected}"))
    };
    parts().unwrap_or_else(|| message.to_string())
}

/// The message for a key that is none of these.
pub fn unknown_key(name: &str, known: &[&str]) -> String {
    let known: Vec<String> = known.iter().map(|known| format!("`{known}`")).collect();
    with_hint(&format!("{UNKNOWN}{name}`, expected one of {}", known.join(", ")))
}

fn explained(text: &str, wrong: &Wrong) -> Option<String> {
    // The name of a table is its value's place too.
    if wrong.message.starts_with(UNKNOWN) {
        return None;
    }
    let span = wrong.place.clone()?;
    let tables = DeTable::parse(text).ok()?;
    let key = key_in(tables.get_ref(), &span)?;
    let allowed = allowed(&wrong.message, &key)?;
    let value = text.get(span)?;
    // Where an entry of a list is not allowed, the place is the list's.
    let each = if value.starts_with('[') && wrong.message.starts_with("invalid value") { "each " } else { "" };
    Some(format!("{key} is {}; allowed: {each}{allowed}", shortened(value)))
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
    let (found, expected) = message.split_once("expected ")?;
    let length = expected.strip_prefix("an array of length ").map(|length| format!("a list of {length} numbers"));
    let words = match expected {
        "i64" => "a whole number",
        "usize" | "u64" => "a whole number >= 0",
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

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use crate::toml_file::Source;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only what is wrong is looked at")]
    struct Tables {
        scene: Option<Keys>,
        title: Option<String>,
    }

    #[derive(Debug, Deserialize)]
    struct Keys {
        speed: Option<f64>,
    }

    #[derive(Debug, Deserialize)]
    struct OtherKeys {
        radius: Option<i64>,
    }

    #[test]
    fn an_unknown_key_is_named_with_what_it_may_have_meant() {
        let parse = |text: &str| {
            let source = Source { name: "x.toml", text };
            source.parse::<Tables>().expect_err("a mistake").to_string()
        };
        let expected = "did you mean scene? expected `scene` or `title`";
        assert_eq!(parse("\n[scne]\nspeed = 1"), format!("x.toml:2: unknown field `scne`, {expected}"));
        assert_eq!(parse("scne = 1"), format!("x.toml:1: unknown field `scne`, {expected}"));
        assert_eq!(parse("[scene]\nspeed = \"fast\""), "x.toml:2: speed is \"fast\"; allowed: a number");
    }

    #[test]
    fn a_decimal_comma_is_told_so() {
        let parse = |text: &str| {
            let source = Source { name: "x.toml", text };
            source.parse::<Tables>().expect_err("a mistake").to_string()
        };
        for (line, number) in [
            ("scene = { speed = 10,5 }", "10,5"),
            ("scene = { speed = -1,05e3, mass = 2.0 }", "-1,05e3"),
            ("scene.speed = 0,25 # m/s", "0,25"),
            ("scene = {speed=1,5}", "1,5"),
        ] {
            let point = number.replace(',', ".");
            let wanted = format!("x.toml:2: the number is {number}; allowed: a decimal point, {point}");
            assert_eq!(parse(&format!("title = \"1,5\"\n{line}\ntitle = 3")), wanted);
        }
        // What is no number, or between brackets or quotes, is none.
        for line in ["scene = [1,5, x]", "title = \"1,5\" 2", "scene = { speed = 1.5,mass = 2 x }", "title = x,5"] {
            assert!(!parse(line).contains("decimal"), "{line}: {}", parse(line));
        }
    }

    #[test]
    fn two_structs_share_a_table_and_no_key_is_of_neither() {
        let read = |text: &str| {
            let source = Source { name: "x.toml", text };
            source.read_both::<Keys, OtherKeys>(&source.tables()?)
        };
        let (keys, other) = read("radius = 3\nspeed = 2.5").expect("keys of both");
        assert_eq!((keys.speed, other.radius), (Some(2.5), Some(3)));
        let error = |text: &str| read(text).map(|_| ()).expect_err("a mistake").to_string();
        let expected = "x.toml:2: unknown field `radus`, did you mean radius? expected one of `speed`, `radius`";
        assert_eq!(error("speed = 1\nradus = 3"), expected);
        assert_eq!(error("speed = 1\nradius = 3.5"), "x.toml:2: radius is 3.5; allowed: a whole number");
    }
}
