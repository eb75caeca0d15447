//! The table of a table's keys, for a page.

use serde_json::Value;
use toron_shared::schema::ORDER;

use crate::schema::resolved;

/// The keys of a table, as Markdown. The table is named as in the file, `weave.warp`; without a name it is the file
/// itself. The page is named from `docs/`.
pub fn table(root: &Value, name: &str, page: &str) -> String {
    let names = name.split('.').filter(|name| !name.is_empty());
    let table = names.fold(root, |table, name| entry(root, &table["properties"][name]));
    let required = |key: &Value| table["required"].as_array().is_some_and(|names| names.contains(key));
    let mut lines = "| key | default | value | |\n|---|---|---|---|\n".to_string();
    for key in table[ORDER].as_array().unwrap_or_else(|| panic!("{name} is no table")) {
        let schema = &table["properties"][key.as_str().expect("a name")];
        let key_text = key.as_str().expect("a name");
        let (meaning, default) = parts(schema["description"].as_str().unwrap_or_default());
        let default = if required(key) { "required" } else { default };
        let cells = [&format!("`{key_text}`"), &linked(default, page), &value(root, schema), &linked(meaning, page)];
        lines += &format!("| {} |\n", cells.map(|cell| cell.replace('|', "\\|")).join(" | "));
    }
    lines
}

/// The table of a key, or each of its list.
fn entry<'s>(root: &'s Value, schema: &'s Value) -> &'s Value {
    let schema = resolved(root, schema);
    schema.get("items").map_or(schema, |items| resolved(root, items))
}

/// A comment's meaning, and the default that it ends with.
fn parts(comment: &str) -> (&str, &str) {
    if let Some(meaning) = comment.strip_suffix("Required.") {
        return (meaning.trim_end(), "required");
    }
    match comment.rsplit_once("Default: ") {
        Some((meaning, default)) => (meaning.trim_end(), default.strip_suffix('.').expect("a sentence")),
        None => (comment, ""),
    }
}

/// What may stand behind a key, in words.
fn value(root: &Value, schema: &Value) -> String {
    let schema = resolved(root, schema);
    if let Some(choices) = schema.get("anyOf").or(schema.get("oneOf")).and_then(Value::as_array) {
        let choices: Vec<String> = choices.iter().map(|choice| value(root, choice)).collect();
        return choices.join(if schema.get("oneOf").is_some() { ", " } else { " or " });
    }
    if let Some(words) = schema.get("enum").and_then(Value::as_array) {
        return words.iter().map(word).collect::<Vec<_>>().join(", ");
    }
    if let Some(only) = schema.get("const") {
        return word(only);
    }
    match schema.get("type").and_then(Value::as_str) {
        Some("number") => format!("number{}", limits(schema)),
        Some("integer") => format!("whole number{}", limits(schema)),
        Some("boolean") => "`true`, `false`".to_string(),
        Some("string") => "text".to_string(),
        Some("object") => "table".to_string(),
        Some("array") => {
            let item = value(root, &schema["items"]);
            let several = |noun: &str| item.replacen(noun, &format!("{noun}s"), 1);
            let item = ["list", "number", "text", "table"]
                .into_iter()
                .find(|noun| item.contains(noun))
                .map_or(item.clone(), several);
            match schema.get("minItems").filter(|least| schema.get("maxItems") == Some(least)) {
                Some(count) => format!("{count} {item}"),
                None => format!("list of {item}"),
            }
        }
        _ => String::new(),
    }
}

fn word(word: &Value) -> String {
    format!("`{}`", word.as_str().expect("a word"))
}

/// The bounds of a number.
fn limits(schema: &Value) -> String {
    let of = |key: &str| schema.get(key).map(Value::to_string).map(|number| number.trim_end_matches(".0").to_string());
    if let (Some(least), Some(most)) = (of("minimum"), of("maximum")) {
        return format!(", {least} to {most}");
    }
    let limits = [("exclusiveMinimum", ">"), ("minimum", "≥"), ("exclusiveMaximum", "<"), ("maximum", "≤")];
    let limits = limits.into_iter().filter_map(|(key, sign)| Some(format!(" {sign} {}", of(key)?)));
    limits.collect::<Vec<_>>().join(",")
}

/// Puts `made(text, target)` in place of each link `[text](target)`.
fn with_links(text: &str, made: impl Fn(&str, &str) -> String) -> String {
    let mut new = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once("](") {
        let (target, behind) = behind.split_once(')').expect("a link ends");
        // A name in brackets may be the text of a link, [`[weave]`](…).
        let mut depth = 0;
        let begin = before.char_indices().rev().find(|(_, letter)| match letter {
            ']' => {
                depth += 1;
                false
            }
            '[' if depth == 0 => true,
            '[' => {
                depth -= 1;
                false
            }
            _ => false,
        });
        let (begin, _) = begin.expect("a link begins");
        new += &before[..begin];
        new += &made(&before[begin + 1..], target);
        rest = behind;
    }
    new + rest
}

/// The text with links as a page has them, which is named from `docs/` as they are.
fn linked(text: &str, page: &str) -> String {
    let (folder, _) = page.split_once('/').expect("a page in a folder");
    with_links(text, |text, target| {
        let (of, heading) = target.split_at(target.find('#').unwrap_or(target.len()));
        let near = of.strip_prefix(folder).and_then(|of| of.strip_prefix('/'));
        match near {
            _ if of == page => format!("[{text}]({heading})"),
            Some(near) => format!("[{text}]({near}{heading})"),
            None => format!("[{text}](../{target})"),
        }
    })
}

/// The text with no more of a link than its text.
pub fn without_links(text: &str) -> String {
    with_links(text, |text, _| text.to_string())
}
