//! Tables: for a terminal, whose columns have two lines of heading, or as JSON in their place; and as CSV.

use std::path::Path;

use super::console::{is_json, table_record, value_record};
use super::error::Error;

/// The entry of a column that does not apply to a line.
pub const NONE: &str = "-";
/// The gap between two columns.
const GAP: &str = "  ";
/// Columns that are never left out: what a line is of, and one thing about it.
const FEWEST: usize = 2;

/// A column: two lines of heading, of which the second is a unit, and an entry for each line.
pub struct Column {
    pub heading: [String; 2],
    pub entries: Vec<String>,
}

impl Column {
    fn width(&self) -> usize {
        self.heading.iter().chain(&self.entries).map(|text| text.chars().count()).fold(0, usize::max)
    }

    fn applies(&self) -> bool {
        self.entries.iter().any(|entry| entry != NONE)
    }
}

/// The value as text, or [`NONE`].
pub fn or_dash(value: Option<f64>, text: impl Fn(f64) -> String) -> String {
    value.map_or(NONE.to_string(), text)
}

/// A name of at most so many letters on a terminal, cut if it is longer.
pub fn shortened(name: &str, longest: usize) -> String {
    if is_json() || name.chars().count() <= longest {
        name.to_string()
    } else {
        name.chars().take(longest - 1).chain(['…']).collect()
    }
}

/// The table without columns that apply to nothing and, where it is wider than this, without the last ones. Words stand on the
/// left of their column, numbers on the right.
pub fn table(columns: Vec<Column>, widest: usize) -> String {
    let mut columns: Vec<Column> = columns.into_iter().filter(Column::applies).collect();
    if is_json() {
        return if columns.is_empty() { String::new() } else { table_record(&columns) };
    }
    let width = |columns: &[Column]| columns.iter().map(|column| column.width() + GAP.len()).sum::<usize>() - GAP.len();
    while columns.len() > FEWEST && width(&columns) > widest {
        columns.pop();
    }
    let Some(lines) = columns.first().map(|column| column.entries.len()) else { return String::new() };
    let line = |text: &dyn Fn(&Column) -> String| {
        let cells = columns.iter().map(|column| {
            let (text, width) = (text(column), column.width());
            // Words have no unit.
            if column.heading[1].is_empty() { format!("{text:<width$}") } else { format!("{text:>width$}") }
        });
        format!("{}\n", cells.collect::<Vec<_>>().join(GAP).trim_end())
    };
    let mut text: String = (0..2).map(|i| line(&|column| column.heading[i].clone())).collect();
    text.push_str(&line(&|column| "-".repeat(column.width())));
    text.extend((0..lines).map(|i| line(&|column| column.entries[i].clone())));
    text
}

/// A table of a heading of one line, and rows of cells; `text` lays it out for a terminal.
pub fn plain_table(head: &[&str], rows: &[Vec<String>], text: impl FnOnce() -> String) -> String {
    if !is_json() {
        return text();
    }
    let column = |(place, title): (usize, &&str)| Column {
        heading: [title.to_string(), String::new()],
        entries: rows.iter().map(|row| row.get(place).map_or(NONE.to_string(), String::clone)).collect(),
    };
    table_record(&head.iter().enumerate().map(column).collect::<Vec<_>>())
}

/// A line of names and values below one another, on a terminal after two blanks and a name of so many columns.
pub fn value_line(name: &str, width: usize, value: &str) -> String {
    if is_json() { value_record(name, value) } else { format!("  {name:<width$} {value}\n") }
}

/// The text in lines of at most so many letters, where its words allow it; lines after the first are indented.
pub fn folded(text: &str, widest: usize) -> String {
    let mut lines = String::new();
    let mut width = 0;
    for word in text.split(' ') {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > widest {
            lines.push_str("\n  ");
            width = GAP.len();
        } else if width > 0 {
            lines.push(' ');
            width += 1;
        }
        lines.push_str(word);
        width += length;
    }
    lines
}

/// Texts that several names share: each once, with its names, in their order.
pub fn grouped<'a, 'b>(named: impl IntoIterator<Item = (&'a str, &'b str)>) -> Vec<(&'b str, Vec<&'a str>)> {
    let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
    for (name, text) in named {
        match groups.iter_mut().find(|(known, _)| *known == text) {
            Some((_, names)) => names.push(name),
            None => groups.push((text, vec![name])),
        }
    }
    groups
}

/// The yarns of the cases of these names, which are named where they differ.
pub fn yarns_of_cases(yarns: &[(&str, String)], widest: usize) -> String {
    let groups = grouped(yarns.iter().map(|(case, yarns)| (*case, yarns.as_str())));
    if let [(yarns, _)] = groups[..] {
        return folded(&format!("Yarns: {yarns}"), widest) + "\n";
    }
    let line =
        |(yarns, cases): (&str, Vec<&str>)| folded(&format!("Yarns of {}: {yarns}", cases.join(", ")), widest) + "\n";
    groups.into_iter().map(line).collect()
}

/// Writes lines of titled cells as CSV; a line without a cell that others have gets [`NONE`] there.
///
/// # Errors
/// The file cannot be written.
pub fn write_csv<N: AsRef<str>>(file: &Path, lines: &[Vec<(N, String)>]) -> Result<(), Error> {
    let file_error = |error: csv::Error| Error::Input(format!("{}: {error}", file.display()));
    let mut titles: Vec<&str> = Vec::new();
    for (title, _) in lines.iter().flatten() {
        if !titles.contains(&title.as_ref()) {
            titles.push(title.as_ref());
        }
    }
    let mut writer = csv::Writer::from_path(file).map_err(file_error)?;
    writer.write_record(&titles).map_err(file_error)?;
    for line in lines {
        let entry = |title: &&str| line.iter().find(|cell| cell.0.as_ref() == *title).map_or(NONE, |cell| &cell.1);
        writer.write_record(titles.iter().map(entry)).map_err(file_error)?;
    }
    writer.flush().map_err(|error| file_error(error.into()))
}

/// The names of the files in a directory and what they are; of each, whether it was written.
pub fn files(directory: &Path, files: &[(bool, &str, &str)]) -> String {
    let written = files.iter().filter(|(written, ..)| *written);
    let lines = written.map(|(_, names, meaning)| format!("  {names:<28}{meaning}\n"));
    format!("Files in {}:\n{}", directory.display(), lines.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_folded_at_words() {
        assert_eq!(folded("one two three", 13), "one two three");
        assert_eq!(folded("one two three", 12), "one two\n  three");
        assert_eq!(folded("seventeen letters", 3), "seventeen\n  letters");
    }

    #[test]
    fn cases_are_named_where_their_yarns_differ() {
        let of = |yarns: [&str; 3]| {
            yarns_of_cases(&["a", "b", "c"].into_iter().zip(yarns.map(str::to_string)).collect::<Vec<_>>(), 80)
        };
        assert_eq!(of(["one"; 3]), "Yarns: one\n");
        assert_eq!(of(["one", "two", "one"]), "Yarns of a, c: one\nYarns of b: two\n");
    }
}
