//! A table as machines and spreadsheets export it, in cells of text: how the file is encoded, where its header is, how
//! its cells are separated and which decimal sign its numbers have.

use std::path::Path;

use csv::{ReaderBuilder, Trim};
use encoding_rs::{Encoding, UTF_16BE, UTF_16LE, WINDOWS_1252};

use super::lines;
use crate::unit_expression::Unit;
use toron_shared::error::Error;
use toron_shared::toml_error::shortened;

/// A table in cells. Lines are those of the file, from 1; so are the numbers of columns.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// The file, as messages have it.
    pub name: String,
    pub headings: Vec<Heading>,
    /// The line of the header.
    pub header: usize,
    pub rows: Vec<Row>,
    /// Lines behind the header that begin with #, and are no rows.
    pub comments: Vec<usize>,
    /// The decimal sign.
    pub point: char,
}

/// What stands above a column.
#[derive(Clone, Debug)]
pub struct Heading {
    /// As the file has it, a unit of the line below included.
    pub text: String,
    /// Without the unit.
    pub name: String,
    /// The unit, or why it is none; nothing where the heading has none.
    pub unit: Option<Result<Unit, String>>,
}

impl Heading {
    fn new(text: &str) -> Heading {
        let parted = name_and_unit(text);
        let unit = parted.map(|(_, unit)| Unit::parse(unit));
        Heading { text: text.to_string(), name: parted.map_or(text, |(name, _)| name).to_string(), unit }
    }

    fn has_unit(&self) -> bool {
        matches!(self.unit, Some(Ok(_)))
    }
}

/// A line of data: as many cells as there are headings.
#[derive(Clone, Debug)]
pub struct Row {
    pub line: usize,
    pub cells: Vec<String>,
}

impl Sheet {
    /// Reads the file.
    ///
    /// # Errors
    /// An input error that names the file, or file, line and column.
    pub fn read(path: &Path) -> Result<Sheet, Error> {
        Sheet::read_like(path, EXAMPLE)?.filled()
    }

    /// The same, with a header alone if there is no more; where there is none the message has this example of one.
    ///
    /// # Errors
    /// An input error that names the file, or file, line and column.
    pub fn read_like(path: &Path, example: &str) -> Result<Sheet, Error> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|error| Error::Input(format!("{name}: {error}")))?;
        let is_control = |c: char| c.is_control() && !c.is_whitespace();
        let text = decoded(&bytes).filter(|text| !text.contains(is_control)).ok_or_else(|| {
            // How an archive begins, and so the workbooks of spreadsheets.
            let what = if bytes.starts_with(b"PK") { "a workbook of a spreadsheet" } else { "no text" };
            Error::Input(format!("{name}: {what}; allowed: a CSV file in UTF-8, UTF-16 or Latin-1"))
        })?;
        Sheet::parse_like(&name, &text, example)
    }

    /// The table that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line and column: there is no header, or a line has more or fewer cells.
    pub fn parse(name: &str, text: &str) -> Result<Sheet, Error> {
        Sheet::parse_like(name, text, EXAMPLE)?.filled()
    }

    /// The same, with a header alone if there is no more.
    ///
    /// # Errors
    /// As for [`Sheet::parse`].
    pub fn parse_like(name: &str, text: &str, example: &str) -> Result<Sheet, Error> {
        let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace('\r', "\n");
        let whole = lines::whole(&text);
        let numbered = whole.iter().map(|(number, line)| (*number, line.as_ref()));
        let is_blank = |line: &str| line.chars().all(|c| c.is_whitespace() || c == ',' || c == ';');
        type Lines<'a> = Vec<(usize, &'a str)>;
        let (comments, lines): (Lines, Lines) =
            numbered.filter(|(_, line)| !is_blank(line)).partition(|(_, line)| line.starts_with('#'));
        // Excel's line, which says how cells are separated.
        let separator = lines.first().and_then(|(_, line)| line.trim().strip_prefix("sep=")?.bytes().next());
        let lines = &lines[usize::from(separator.is_some())..];
        let header = find_header(lines, separator);
        let Some(&(line, first)) = lines.get(header.as_ref().map_or(0, |(place, _)| *place)) else {
            return Err(Error::Input(format!("{name}:1:1: no header; allowed: columns as in \"{example}\"")));
        };
        let (mut headings, delimiter, data) = match header {
            Some((place, Header { headings, delimiter, lines: used })) => (headings, delimiter, &lines[place + used..]),
            None => {
                let delimiter = delimiters(first, separator).next().unwrap_or(b',');
                (cells(first, delimiter), delimiter, &lines[1..])
            }
        };
        let mut rows: Vec<Row> =
            data.iter().map(|(line, text)| Row { line: *line, cells: cells(text, delimiter) }).collect();
        drop_empty_columns(&mut headings, &mut rows);
        let headings: Vec<Heading> = headings.iter().map(|text| Heading::new(text)).collect();
        let any_unit = headings.iter().any(Heading::has_unit);
        // What stands between words is no decimal sign.
        let numbers = |row: &Row| {
            let mut in_numbers = row.cells.iter().zip(&headings).filter(|(_, heading)| heading.has_unit() || !any_unit);
            in_numbers.any(|(cell, _)| cell.contains(','))
        };
        let point = if delimiter != b',' && rows.iter().any(numbers) { ',' } else { '.' };
        let comments = comments.iter().map(|(line, _)| *line).filter(|comment| *comment > line).collect();
        let sheet = Sheet { name: name.to_string(), headings, header: line, rows, point, comments };
        sheet.check_rows()?;
        Ok(sheet)
    }

    fn filled(self) -> Result<Sheet, Error> {
        if self.rows.is_empty() {
            return Err(self.error(self.header, 1, "no line of data follows the header; allowed: one at least"));
        }
        Ok(self)
    }

    fn check_rows(&self) -> Result<(), Error> {
        let wanted = self.headings.len();
        match self.rows.iter().find(|row| row.cells.len() != wanted) {
            None => Ok(()),
            Some(Row { line, cells }) => {
                let found = cells.len();
                let message = format!("number of cells: {found}; allowed: {wanted}, as in the header");
                Err(self.error(*line, found.min(wanted) + 1, &message))
            }
        }
    }

    /// An error at a place of the file: `file:line:column: column "force": message`.
    pub fn error(&self, line: usize, column: usize, message: &str) -> Error {
        let found = column.checked_sub(1).and_then(|place| self.headings.get(place));
        let named = found.filter(|heading| heading.has_unit() || line != self.header);
        let named = named.map(|heading| format!("column \"{}\": ", heading.name)).unwrap_or_default();
        Error::Input(format!("{}:{line}:{column}: {named}{message}", self.name))
    }

    /// The number in a row's cell, at a place from 0.
    ///
    /// # Errors
    /// It is none: its place, what stands there and what is allowed.
    pub fn number(&self, row: &Row, place: usize) -> Result<f64, Error> {
        let cell = &row.cells[place];
        number(cell, self.point).map_err(|reason| {
            self.error(row.line, place + 1, &format!("the cell is \"{}\"; {reason}", shortened(cell)))
        })
    }
}

/// The text of a file in UTF-8, in UTF-16, or else in Windows' Latin-1; none where it is in none of them.
pub fn decoded(bytes: &[u8]) -> Option<String> {
    let by = |encoding: &'static Encoding| encoding.decode_without_bom_handling_and_without_replacement(bytes);
    let encoding = Encoding::for_bom(bytes).map(|(encoding, _)| encoding).or_else(|| without_mark(bytes));
    match encoding {
        Some(encoding) => by(encoding).map(|text| text.trim_start_matches('\u{feff}').to_string()),
        None => match std::str::from_utf8(bytes) {
            Ok(text) => Some(text.to_string()),
            Err(_) => by(WINDOWS_1252).map(String::from),
        },
    }
}

/// UTF-16 without its mark: every second byte of its first letters is zero.
fn without_mark(bytes: &[u8]) -> Option<&'static Encoding> {
    match bytes {
        [a, 0, b, 0, ..] if *a != 0 && *b != 0 => Some(UTF_16LE),
        [0, a, 0, b, ..] if *a != 0 && *b != 0 => Some(UTF_16BE),
        _ => None,
    }
}

/// How the cells of a line may be separated, that which is most likely first.
fn delimiters(line: &str, told: Option<u8>) -> impl Iterator<Item = u8> {
    let found = [b',', b';', b'\t'].into_iter().filter(|&delimiter| line.contains(char::from(delimiter)));
    let mut all: Vec<u8> = told.map_or_else(|| found.collect(), |told| vec![told]);
    if all.is_empty() {
        all.push(b',');
    }
    all.into_iter()
}

/// Headings with their units, how they are separated, and how many lines they take.
struct Header {
    headings: Vec<String>,
    delimiter: u8,
    lines: usize,
}

/// The header and its place: above it machines write what was tested. Where no line has units in all of its cells it is
/// the first one with a unit above a number, so that columns of words need none.
fn find_header(lines: &[(usize, &str)], separator: Option<u8>) -> Option<(usize, Header)> {
    let texts: Vec<&str> = lines.iter().map(|(_, text)| *text).collect();
    let first = |of: fn(u8, &[&str]) -> Option<Header>| {
        (0..texts.len()).find_map(|i| {
            let mut all = delimiters(texts[i], separator);
            all.find_map(|delimiter| Some((i, of(delimiter, &texts[i..])?)))
        })
    };
    match first(of_units_alone) {
        // A quantity of what is tested has a unit too.
        Some(found) if found.1.headings.len() == 1 => first(of_some_units).or(Some(found)),
        Some(found) => Some(found),
        None => first(of_some_units),
    }
}

/// Names with units, or names above a line of units.
fn of_units_alone(delimiter: u8, lines: &[&str]) -> Option<Header> {
    let headings = cells(lines[0], delimiter);
    let names = filled(&headings);
    if !names.is_empty() && names.iter().all(|name| Heading::new(name).has_unit()) {
        return Some(Header { headings, delimiter, lines: 1 });
    }
    let below = cells(lines.get(1)?, delimiter);
    let units = filled(&below);
    let is_unit = |cell: &String| is_word(cell) && Unit::parse(bare(cell)).is_ok();
    let is_header = names.len() == units.len() && names.iter().all(|name| is_word(name)) && units.iter().all(is_unit);
    (is_header && !names.is_empty()).then(|| Header { headings: with_units(&headings, units), delimiter, lines: 2 })
}

/// Words, two at least, one of which has a unit, in the same line or the next one, and a number below it.
fn of_some_units(delimiter: u8, lines: &[&str]) -> Option<Header> {
    let headings = cells(lines[0], delimiter);
    let words: Vec<&String> = headings.iter().filter(|cell| !cell.is_empty()).collect();
    if words.len() < 2 || !words.iter().all(|cell| is_word(cell)) {
        return None;
    }
    let is_above_number = |headings: &[String], row: Option<&&str>| {
        let below = row.map_or_else(Vec::new, |row| cells(row, delimiter));
        let mut pairs = headings.iter().zip(&below);
        pairs.any(|(name, cell)| Heading::new(name).has_unit() && !is_word(cell) && !cell.is_empty())
    };
    if is_above_number(&headings, lines.get(1)) {
        return Some(Header { headings, delimiter, lines: 1 });
    }
    let below = cells(lines.get(1)?, delimiter);
    let units = filled(&below);
    if units.len() > headings.len() || !units.iter().all(|cell| cell.is_empty() || is_word(cell)) {
        return None;
    }
    let headings = with_units(&headings, units);
    is_above_number(&headings, lines.get(2)).then_some(Header { headings, delimiter, lines: 2 })
}

/// Names with the units of the line below.
fn with_units(names: &[String], units: &[String]) -> Vec<String> {
    let with_unit = |(place, name): (usize, &String)| match units.get(place) {
        Some(unit) if !unit.is_empty() => format!("{name} ({})", bare(unit)),
        _ => name.clone(),
    };
    names.iter().enumerate().map(with_unit).collect()
}

/// Neither empty nor a number, with either decimal sign.
fn is_word(cell: &str) -> bool {
    !cell.is_empty() && plain(cell).replace(',', ".").parse::<f64>().is_err()
}

/// The cells without the empty ones at the end.
fn filled(cells: &[String]) -> &[String] {
    &cells[..cells.iter().rposition(|cell| !cell.is_empty()).map_or(0, |last| last + 1)]
}

/// A unit without the brackets around it.
fn bare(unit: &str) -> &str {
    let within = |open, close| unit.strip_prefix(open)?.strip_suffix(close);
    within('[', ']').or_else(|| within('(', ')')).unwrap_or(unit)
}

/// Machines end lines with a separator: a last column without a heading and without cells is none.
fn drop_empty_columns(headings: &mut Vec<String>, rows: &mut [Row]) {
    let is_empty = |row: &Row, column: usize| row.cells.get(column).is_none_or(String::is_empty);
    while headings.last().is_some_and(String::is_empty) && rows.iter().all(|row| is_empty(row, headings.len() - 1)) {
        headings.pop();
    }
    for row in rows {
        while row.cells.len() > headings.len() && row.cells.last().is_some_and(String::is_empty) {
            row.cells.pop();
        }
    }
}

const EXAMPLE: &str = "displacement (mm), force (N)";

/// The cells of a line, without the blanks around them.
fn cells(line: &str, delimiter: u8) -> Vec<String> {
    let mut builder = ReaderBuilder::new();
    builder.has_headers(false).flexible(true).trim(Trim::All).delimiter(delimiter).buffer_capacity(line.len() + 1);
    let record = builder.from_reader(line.as_bytes()).into_records().next();
    // What was a string is still valid UTF-8, and a line in memory can be read.
    record.and_then(Result::ok).map_or_else(Vec::new, |record| record.iter().map(str::to_string).collect())
}

/// The name and the unit of a heading, `name (unit)`, `name [unit]`, `name / unit`, `name, m/s` or `name m/s`; the unit
/// may have parentheses of its own.
fn name_and_unit(heading: &str) -> Option<(&str, &str)> {
    let (open, close) = match heading.chars().next_back()? {
        ')' => ('(', ')'),
        ']' => ('[', ']'),
        _ => return heading.split_once(" / ").filter(|(name, _)| !name.is_empty()).or_else(|| last_word(heading)),
    };
    let mut depth = 0;
    let start = heading.char_indices().rev().find_map(|(i, character)| {
        depth += i32::from(character == close) - i32::from(character == open);
        (depth == 0).then_some(i)
    })?;
    let name = heading[..start].trim_end();
    (!name.is_empty()).then_some((name, &heading[start + 1..heading.len() - 1]))
}

/// A last word that can be nothing but a quotient of units.
fn last_word(heading: &str) -> Option<(&str, &str)> {
    let (name, unit) = heading.rsplit_once(char::is_whitespace)?;
    let name = name.trim_end_matches(|c: char| c.is_whitespace() || c == ',');
    let is_unit = unit.contains('/') && Unit::parse(unit).is_ok();
    (is_unit && is_word(name)).then_some((name, unit))
}

/// The cell with a hyphen for the sign minus of typesetters.
fn plain(cell: &str) -> String {
    cell.replace('\u{2212}', "-")
}

/// The number in a cell; the decimal sign of the file is a point or a comma.
fn number(cell: &str, point: char) -> Result<f64, String> {
    let cell = &plain(cell);
    let allowed = if point == ',' { "a finite number with a decimal comma, as in the rest" } else { "a finite number" };
    let value = |text: &str| match point {
        // A file with both would have one of them between the thousands.
        ',' if text.contains('.') => None,
        ',' => text.replace(',', ".").parse::<f64>().ok(),
        _ => text.parse::<f64>().ok(),
    };
    if let Some(value) = value(cell).filter(|value| value.is_finite()) {
        return Ok(value);
    }
    if point != ',' && cell.contains(',') && cell.replacen(',', ".", 1).parse::<f64>().is_ok() {
        return Err("allowed: a decimal point; a decimal comma with ; or tabs between the cells".to_string());
    }
    let end = cell.find(|c: char| !(c.is_ascii_digit() || "+-.,".contains(c))).unwrap_or(cell.len());
    let (first, rest) = cell.split_at(end);
    if !rest.is_empty() && value(first).is_some() && Unit::parse(rest).is_ok() {
        return Err("a unit in a cell; units belong in the header".to_string());
    }
    Err(format!("allowed: {allowed}"))
}
