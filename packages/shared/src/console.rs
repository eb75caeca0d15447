//! The standard output and the standard error: as text, or what is for the standard output as one JSON object at the
//! end.

use std::io::{self, ErrorKind, Write};
use std::sync::{Mutex, OnceLock, PoisonError};

use serde_json::{Value, json};

use super::text_table::{Column, NONE};

/// How a command's output is to look.
#[derive(Clone, Copy, Debug, Default)]
pub struct Format {
    /// One JSON object on the standard output, in place of text.
    pub json: bool,
    /// No notes and no progress on the standard error.
    pub quiet: bool,
}

static FORMAT: OnceLock<Format> = OnceLock::new();
/// What was to be printed, where it goes out as JSON.
static KEPT: Mutex<String> = Mutex::new(String::new());
/// Why something that was to be printed is lost: the first reason.
static LOST: OnceLock<String> = OnceLock::new();
/// What a line begins with that is a table or a row of one as JSON (ASCII's record separator).
const RECORD: char = '\u{1e}';

/// Says how the output of this program is to look, before anything is printed.
pub fn set(format: Format) {
    let _ = FORMAT.set(format); // a program has one
}

fn format() -> Format {
    FORMAT.get().copied().unwrap_or_default()
}

pub fn is_json() -> bool {
    format().json
}

pub fn is_quiet() -> bool {
    format().quiet
}

/// Writes to the standard output. A reader that has gone (`toron params | head`) is no error; another reason, such as a
/// full disk, is [kept](lost), so that a command writes its files all the same.
pub fn print(text: &str) {
    if is_json() {
        KEPT.lock().unwrap_or_else(PoisonError::into_inner).push_str(text);
    } else {
        keep(io::stdout().write_all(text.as_bytes()));
    }
}

/// Ends the output of a command.
pub fn finish(command: &str, version: &str) {
    if is_json() {
        let kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        keep(writeln!(io::stdout(), "{:#}", object(command, version, &kept)));
    }
}

/// A table in a text that is printed as JSON: the two lines of each heading, and rows of numbers, texts, or null where
/// a column does not apply. Columns of words have no numbers, whatever a case is called, and the first of them says
/// what each row is of.
pub fn table_record(columns: &[Column], is_words: impl Fn(&Column) -> bool) -> String {
    let rows = columns.first().map_or(0, |column| column.entries.len());
    let entry = |(place, column): (usize, &Column), i: usize| match column.entries[i].as_str() {
        word if is_words(column) && (place == 0 || word != NONE) => word.into(),
        text => cell(text),
    };
    let row = |i: usize| columns.iter().enumerate().map(|column| entry(column, i)).collect::<Vec<Value>>();
    let headings: Vec<_> = columns.iter().map(|column| &column.heading).collect();
    record(&json!({"columns": headings, "rows": (0..rows).map(row).collect::<Vec<_>>()}))
}

/// A name and its value in a text that is printed as JSON: those that follow one another are a table.
pub fn value_record(name: &str, value: &str) -> String {
    record(&json!([name, cell(value)]))
}

fn record(value: &Value) -> String {
    format!("{RECORD}{value}\n")
}

fn cell(text: &str) -> Value {
    let whole = text.parse::<i64>().ok().map(serde_json::Number::from);
    let number = whole.or_else(|| text.parse().ok().and_then(serde_json::Number::from_f64));
    if text == NONE { Value::Null } else { number.map_or_else(|| text.into(), Value::Number) }
}

/// The tables of a text, and its other lines.
fn object(command: &str, version: &str, printed: &str) -> Value {
    let (mut tables, mut text): (Vec<Value>, Vec<&str>) = (Vec::new(), Vec::new());
    let mut is_list = false;
    for line in printed.lines() {
        let found = line.strip_prefix(RECORD).and_then(|json| serde_json::from_str(json).ok());
        let was_list = std::mem::take(&mut is_list);
        match (found, tables.last_mut()) {
            (Some(Value::Array(row)), last) => {
                is_list = true;
                match last.filter(|_| was_list).and_then(|table| table["rows"].as_array_mut()) {
                    Some(rows) => rows.push(row.into()),
                    None => tables.push(json!({"columns": [["name", ""], ["value", ""]], "rows": [row]})),
                }
            }
            (Some(table), _) => tables.push(table),
            (None, _) if line.trim().is_empty() => {}
            (None, _) => text.push(line.trim()),
        }
    }
    json!({"command": command, "version": version, "tables": tables, "text": text})
}

/// Keeps the reason if writing to the standard output has failed, or what is still in its buffer cannot be written.
pub fn keep(written: io::Result<()>) {
    if let Err(error) = written.and_then(|()| io::stdout().flush())
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _ = LOST.set(error.to_string()); // an earlier reason stays
    }
}

/// Why something that was to be printed is lost.
pub fn lost() -> Option<&'static str> {
    LOST.get().map(String::as_str)
}

/// Writes a message to the standard error, whose reader may have gone as well (`toron run 2>&1 | head`).
pub fn print_error(message: &str) {
    let _ = io::stderr().write_all(message.as_bytes());
}

/// Writes to the standard error what a user may know but need not, unless it is to be quiet.
pub fn print_note(message: &str) {
    if !is_quiet() {
        print_error(message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_and_lists_are_told_from_text() {
        let column = |heading: [&str; 2], entries: [&str; 2]| Column {
            heading: heading.map(str::to_string),
            entries: entries.map(str::to_string).to_vec(),
        };
        let columns = [column(["case", ""], ["a", "b"]), column(["residual", "m/s"], ["12.5", NONE])];
        let table = table_record(&columns, Column::is_words);
        let list = value_record("law", "hyperelastic") + &value_record("index", "1e-3");
        let printed = format!("A title\n\n{table}\n  words\n{list}between\n{}", value_record("last", "inf"));
        assert_eq!(
            object("run", "0.1.0", &printed),
            json!({
                "command": "run",
                "version": "0.1.0",
                "tables": [
                    {"columns": [["case", ""], ["residual", "m/s"]], "rows": [["a", 12.5], ["b", null]]},
                    {"columns": [["name", ""], ["value", ""]], "rows": [["law", "hyperelastic"], ["index", 1e-3]]},
                    {"columns": [["name", ""], ["value", ""]], "rows": [["last", "inf"]]},
                ],
                "text": ["A title", "words", "between"],
            })
        );
    }

    #[test]
    fn names_of_cases_are_no_numbers() {
        let column = |heading: [&str; 2], entries: [&str; 3]| Column {
            heading: heading.map(str::to_string),
            entries: entries.map(str::to_string).to_vec(),
        };
        let columns = [
            column(["case", ""], ["060", "1e3", NONE]),
            column(["verdict", ""], ["7", "sound", NONE]),
            column(["speed", "m/s"], ["060", "1e3", NONE]),
        ];
        let rows = |is_words: fn(&Column) -> bool| {
            object("", "", &table_record(&columns, is_words))["tables"][0]["rows"].take()
        };
        assert_eq!(rows(Column::is_words), json!([["060", "7", 60], ["1e3", "sound", 1e3], [NONE, null, null]]));
        // Tables whose headings have one line have no units, and the program's own names.
        assert_eq!(rows(|_| false), json!([[60, 7, 60], [1e3, "sound", 1e3], [null, null, null]]));
    }
}
