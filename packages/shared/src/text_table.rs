//! Tables: for a terminal, whose columns have two lines of heading, or as JSON in their place; and as CSV.

use std::path::Path;

use super::console::{is_json, table_record, value_record};
use super::error::Error;

/// The entry of a column that does not apply to a line.
pub const NONE: &str = "-";
/// The gap between two columns.
const GAP: &str = "  ";

/// A column: two lines of heading, of which the second is a unit, and an entry for each line.
pub struct Column {
    pub heading: [String; 2],
    pub entries: Vec<String>,
}

impl Column {
    fn width(&self) -> usize {
        self.heading.iter().chain(&self.entries).map(|text| text.chars().count()).fold(0, usize::max)
    }

    /// Words have no unit.
    pub fn is_words(&self) -> bool {
        self.heading[1].is_empty()
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

/// The table without columns that apply to nothing; columns for which a line of this width has no room stand in tables
/// below it, each of which begins with the first column. Words stand on the left of their column, numbers on the right.
pub fn table(columns: Vec<Column>, widest: usize) -> String {
    let columns: Vec<Column> = columns.into_iter().filter(Column::applies).collect();
    if is_json() {
        return if columns.is_empty() { String::new() } else { table_record(&columns, Column::is_words) };
    }
    let Some((first, mut rest)) = columns.split_first() else { return String::new() };
    let mut text = String::new();
    loop {
        let mut width = first.width();
        let fit = rest.iter().take_while(|column| {
            width += GAP.len() + column.width();
            width <= widest
        });
        let (here, below) = rest.split_at(fit.count().max(1).min(rest.len()));
        text.push_str(&lines(&std::iter::once(first).chain(here).collect::<Vec<_>>()));
        if below.is_empty() {
            return text;
        }
        text.push('\n');
        rest = below;
    }
}

/// Heading, rule and entries of some columns.
fn lines(columns: &[&Column]) -> String {
    let line = |text: &dyn Fn(&Column) -> String| {
        let cells = columns.iter().map(|column| {
            let (text, width) = (text(column), column.width());
            if column.is_words() { format!("{text:<width$}") } else { format!("{text:>width$}") }
        });
        format!("{}\n", cells.collect::<Vec<_>>().join(GAP).trim_end())
    };
    let mut text: String = (0..2).map(|i| line(&|column| column.heading[i].clone())).collect();
    text.push_str(&line(&|column| "-".repeat(column.width())));
    let entries = columns.first().map_or(0, |column| column.entries.len());
    text.extend((0..entries).map(|i| line(&|column| column.entries[i].clone())));
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
    // Their names are the program's own.
    table_record(&head.iter().enumerate().map(column).collect::<Vec<_>>(), |_| false)
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

/// What the cases of these names have, `Yarns` or other things; they are named where they differ.
pub fn of_cases(what: &str, cases: &[(&str, String)], widest: usize) -> String {
    let groups = grouped(cases.iter().map(|(case, text)| (*case, text.as_str())));
    if let [(text, _)] = groups[..] {
        return folded(&format!("{what}: {text}"), widest) + "\n";
    }
    let line =
        |(text, cases): (&str, Vec<&str>)| folded(&format!("{what} of {}: {text}", cases.join(", ")), widest) + "\n";
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

    /// None vanishes.
    #[test]
    fn columns_without_room_stand_below() {
        let column = |above: &str, below: &str, entries: [&str; 2]| Column {
            heading: [above, below].map(String::from),
            entries: entries.map(String::from).to_vec(),
        };
        let columns = || {
            vec![
                column("case", "", ["a", "b"]),
                column("speed", "m/s", ["10", "200"]),
                column("none", "-", [NONE, NONE]),
                column("energy", "J", ["1", "2"]),
            ]
        };
        let one =
            "case  speed  energy\n        m/s       J\n----  -----  ------\na        10       1\nb       200       2\n";
        assert_eq!(table(columns(), 19), one);
        let two = "case  speed\n        m/s\n----  -----\na        10\nb       200\n\n\
                   case  energy\n           J\n----  ------\na          1\nb          2\n";
        assert_eq!(table(columns(), 18), two);
        assert_eq!(table(columns(), 3), two);
        assert_eq!(table(columns().into_iter().take(1).collect(), 3), "case\n\n----\na\nb\n");
        assert_eq!(table(Vec::new(), 3), "");
    }

    #[test]
    fn cases_are_named_where_their_yarns_differ() {
        let of = |yarns: [&str; 3]| {
            of_cases("Yarns", &["a", "b", "c"].into_iter().zip(yarns.map(str::to_string)).collect::<Vec<_>>(), 80)
        };
        assert_eq!(of(["one"; 3]), "Yarns: one\n");
        assert_eq!(of(["one", "two", "one"]), "Yarns of a, c: one\nYarns of b: two\n");
    }
}
