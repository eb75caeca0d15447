//! Measured data: a CSV file whose header has a name and a unit for each column, `force (N)` or `force [N]`.
//!
//! Every error names file, line and column, and every value keeps its place for the errors that come later.

use std::path::Path;

use csv::{ReaderBuilder, Trim};

use super::unit_expression::{self, Unit};
use super::units;
use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;
use toron_shared::error::Error;
use toron_shared::toml_error::shortened;

/// A table of measured data. Lines are those of the file, from 1; so are the numbers of columns.
#[derive(Clone, Debug)]
pub struct DataTable {
    /// The file, as messages have it.
    pub name: String,
    pub columns: Vec<Column>,
    /// The line of the header.
    pub header: usize,
}

/// A column, with a value for each line of data.
#[derive(Clone, Debug)]
pub struct Column {
    pub name: String,
    /// The column's number in the file.
    pub number: usize,
    pub unit: Unit,
    pub values: Vec<Cell>,
}

/// A value and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    pub value: f64,
    pub line: usize,
    pub column: usize,
}

impl DataTable {
    /// Reads the file.
    ///
    /// # Errors
    /// An input error that names file, line and column, what is there and what is allowed.
    pub fn read(path: &Path) -> Result<DataTable, Error> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|error| Error::Input(format!("{name}: {error}")))?;
        let is_control = |c: char| c.is_control() && !c.is_whitespace();
        let text = decoded(&bytes)
            .filter(|text| !text.contains(is_control))
            .ok_or_else(|| Error::Input(format!("{name}: no text; allowed: a CSV file in UTF-8, UTF-16 or Latin-1")))?;
        DataTable::parse(&name, &text)
    }

    /// The table that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line and column, what is there and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<DataTable, Error> {
        let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace('\r', "\n");
        let numbered = text.lines().enumerate().map(|(i, line)| (i + 1, line));
        let lines = numbered.filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
        let lines: Vec<(usize, &str)> = lines.collect();
        // Excel's line, which says how cells are separated.
        let separator = lines.first().and_then(|(_, line)| line.trim().strip_prefix("sep=")?.bytes().next());
        let lines = &lines[usize::from(separator.is_some())..];
        // Above the header machines write what was tested.
        let header = (0..lines.len()).find_map(|i| Some((i, header(&lines[i..], separator)?)));
        let Some(&(line, first)) = lines.get(header.as_ref().map_or(0, |(place, _)| *place)) else {
            return Err(Error::Input(format!("{name}:1:1: no header; allowed: columns as in \"{EXAMPLE}\"")));
        };
        let (mut headings, delimiter, data) = match header {
            Some((place, Header { headings, delimiter, lines: used })) => (headings, delimiter, &lines[place + used..]),
            None => {
                let delimiter = delimiters(first, separator).next().unwrap_or(b',');
                (cells(first, delimiter), delimiter, &lines[1..])
            }
        };
        let mut rows: Vec<(usize, Vec<String>)> =
            data.iter().map(|(line, text)| (*line, cells(text, delimiter))).collect();
        drop_empty_columns(&mut headings, &mut rows);
        let mut table = DataTable { name: name.to_string(), columns: Vec::new(), header: line };
        table.read_header(&headings)?;
        if rows.is_empty() {
            return Err(table.error(line, 1, "no line of data follows the header; allowed: one at least"));
        }
        let comma = delimiter != b',' && rows.iter().any(|(_, row)| row.iter().any(|cell| cell.contains(',')));
        for (line, row) in &rows {
            table.read_row(*line, row, if comma { ',' } else { '.' })?;
        }
        Ok(table)
    }

    /// The column of this name.
    ///
    /// # Errors
    /// There is none; the message names those that exist.
    pub fn column(&self, name: &str) -> Result<&Column, Error> {
        self.columns.iter().find(|column| column.name == name).ok_or_else(|| {
            let known: Vec<&str> = self.columns.iter().map(|column| column.name.as_str()).collect();
            Error::Input(format!(
                "{}:{}: no column \"{name}\"; there are: {}",
                self.name,
                self.header,
                known.join(", ")
            ))
        })
    }

    /// The values of a column, in a system's unit of this dimension.
    ///
    /// # Errors
    /// There is no such column, or its unit is of another dimension.
    pub fn values(&self, name: &str, dimension: Dimension, system: &UnitSystem) -> Result<Vec<f64>, Error> {
        let column = self.column(name)?;
        if !column.unit.measures(dimension) {
            let own = units::unit(system, dimension);
            let wanted = match own.as_str() {
                "-" => "- or %".to_string(),
                // A dimension whose unit has no name of its own.
                own if own == dimension.name => format!("a unit of {own}"),
                own => format!("a unit of {}, as {own}", dimension.name),
            };
            let message = format!("the unit is \"{}\"; allowed: {wanted}", column.unit.text);
            return Err(self.error(self.header, column.number, &message));
        }
        Ok(column.values.iter().map(|cell| column.unit.convert(cell.value, system)).collect())
    }

    /// An error at a place of the file: `file:line:column: column "force": message`.
    pub fn error(&self, line: usize, column: usize, message: &str) -> Error {
        let found = self.columns.iter().find(|known| known.number == column);
        let named = found.map(|column| format!("column \"{}\": ", column.name)).unwrap_or_default();
        Error::Input(format!("{}:{line}:{column}: {named}{message}", self.name))
    }

    fn read_header(&mut self, cells: &[String]) -> Result<(), Error> {
        for (number, cell) in (1..).zip(cells) {
            let error = |message: String| self.error(self.header, number, &message);
            let heading = shortened(cell);
            let Some((name, unit)) = name_and_unit(cell) else {
                let allowed = "a name and a unit, as in \"force (N)\", and \"(-)\" for a plain number";
                return Err(error(format!("the heading is \"{heading}\"; allowed: {allowed}")));
            };
            let unit = Unit::parse(unit).map_err(|reason| {
                error(format!("the unit of \"{heading}\": {reason}; allowed: {}", unit_expression::ALLOWED))
            })?;
            if let Some(other) = self.columns.iter().find(|other| other.name == name) {
                let message = format!("the name \"{name}\" is that of column {} as well", other.number);
                return Err(error(format!("{message}; allowed: a name for each column")));
            }
            self.columns.push(Column { name: name.to_string(), number, unit, values: Vec::new() });
        }
        Ok(())
    }

    fn read_row(&mut self, line: usize, row: &[String], point: char) -> Result<(), Error> {
        let (found, wanted) = (row.len(), self.columns.len());
        if found != wanted {
            let message = format!("number of cells: {found}; allowed: {wanted}, as in the header");
            return Err(self.error(line, found.min(wanted) + 1, &message));
        }
        for (i, cell) in row.iter().enumerate() {
            let value = number(cell, point)
                .map_err(|reason| self.error(line, i + 1, &format!("the cell is \"{}\"; {reason}", shortened(cell))))?;
            self.columns[i].values.push(Cell { value, line, column: i + 1 });
        }
        Ok(())
    }
}

/// The text of a file in UTF-8, in UTF-16 with its mark, or else in Latin-1; none where it is in none of them.
fn decoded(bytes: &[u8]) -> Option<String> {
    let utf_16 = |unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|pair| unit([pair[0], pair[1]])).collect();
        String::from_utf16(&units).ok()
    };
    match (bytes, std::str::from_utf8(bytes)) {
        ([0xff, 0xfe, ..], _) => utf_16(u16::from_le_bytes),
        ([0xfe, 0xff, ..], _) => utf_16(u16::from_be_bytes),
        (_, Ok(text)) => Some(text.to_string()),
        (_, Err(_)) => Some(bytes.iter().copied().map(char::from).collect()),
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

/// The header that these lines begin with: names with units, or names above a line of units.
fn header(lines: &[(usize, &str)], separator: Option<u8>) -> Option<Header> {
    let first = lines.first()?.1;
    let below = lines.get(1).map(|(_, text)| *text);
    delimiters(first, separator).find_map(|delimiter| header_by(delimiter, first, below))
}

fn header_by(delimiter: u8, first: &str, below: Option<&str>) -> Option<Header> {
    let headings = cells(first, delimiter);
    let names = filled(&headings);
    let has_unit = |cell: &String| name_and_unit(cell).is_some_and(|(_, unit)| Unit::parse(unit).is_ok());
    if !names.is_empty() && names.iter().all(has_unit) {
        return Some(Header { headings, delimiter, lines: 1 });
    }
    let below = cells(below?, delimiter);
    let units = filled(&below);
    let is_word = |cell: &String| !cell.is_empty() && cell.parse::<f64>().is_err();
    let is_unit = |cell: &String| is_word(cell) && Unit::parse(bare(cell)).is_ok();
    let is_header = names.len() == units.len() && names.iter().all(is_word) && units.iter().all(is_unit);
    let with_unit = |(name, unit): (&String, &String)| format!("{name} ({})", bare(unit));
    let headings = names.iter().zip(units).map(with_unit).chain(headings[names.len()..].iter().cloned());
    (is_header && !names.is_empty()).then(|| Header { headings: headings.collect(), delimiter, lines: 2 })
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
fn drop_empty_columns(headings: &mut Vec<String>, rows: &mut [(usize, Vec<String>)]) {
    let is_empty = |row: &Vec<String>, column: usize| row.get(column).is_none_or(String::is_empty);
    while headings.last().is_some_and(String::is_empty) && rows.iter().all(|(_, row)| is_empty(row, headings.len() - 1))
    {
        headings.pop();
    }
    for (_, row) in rows {
        while row.len() > headings.len() && row.last().is_some_and(String::is_empty) {
            row.pop();
        }
    }
}

const EXAMPLE: &str = "displacement (mm), force (N)";

/// The cells of a line, without the blanks around them. A line has no line break in quotes: its number would be wrong.
fn cells(line: &str, delimiter: u8) -> Vec<String> {
    let mut builder = ReaderBuilder::new();
    builder.has_headers(false).flexible(true).trim(Trim::All).delimiter(delimiter).buffer_capacity(line.len() + 1);
    let record = builder.from_reader(line.as_bytes()).into_records().next();
    // What was a string is still valid UTF-8, and a line in memory can be read.
    record.and_then(Result::ok).map_or_else(Vec::new, |record| record.iter().map(str::to_string).collect())
}

/// The name and the unit of a heading, `name (unit)`, `name [unit]` or `name / unit`; the unit may have parentheses of
/// its own.
fn name_and_unit(heading: &str) -> Option<(&str, &str)> {
    let (open, close) = match heading.chars().next_back()? {
        ')' => ('(', ')'),
        ']' => ('[', ']'),
        _ => return heading.split_once(" / ").filter(|(name, _)| !name.is_empty()),
    };
    let mut depth = 0;
    let start = heading.char_indices().rev().find_map(|(i, character)| {
        depth += i32::from(character == close) - i32::from(character == open);
        (depth == 0).then_some(i)
    })?;
    let name = heading[..start].trim_end();
    (!name.is_empty()).then_some((name, &heading[start + 1..heading.len() - 1]))
}

/// The number in a cell; the decimal sign of the file is a point or a comma.
fn number(cell: &str, point: char) -> Result<f64, String> {
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::units::FORCE;
    use toron::law::parameters::NUMBER;

    #[track_caller]
    fn parse(text: &str) -> DataTable {
        DataTable::parse("data.csv", text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    fn rejected(text: &str) -> String {
        DataTable::parse("data.csv", text).expect_err(text).to_string()
    }

    fn values(table: &DataTable, name: &str) -> Vec<f64> {
        table.column(name).expect("the column exists").values.iter().map(|cell| cell.value).collect()
    }

    #[test]
    fn cells_keep_their_places() {
        let table = parse(
            "\u{feff}# tests of March\r\n\r\n  travel [mm] ,\"force, top (N/(mm s))\"\r\n1,2\r\n#\r\n 3 , -4e1\r\n",
        );
        assert_eq!(table.column("travel").expect("a column").unit.text, "mm");
        let force = table.column("force, top").expect("a column");
        assert_eq!((force.number, force.unit.text.as_str()), (2, "N/(mm s)"));
        assert_eq!(force.values, [Cell { value: 2.0, line: 4, column: 2 }, Cell { value: -40.0, line: 6, column: 2 }]);
        assert_eq!(table.error(6, 2, "odd").to_string(), "data.csv:6:2: column \"force, top\": odd");
    }

    #[test]
    fn semicolons_allow_decimal_commas() {
        let comma = parse("strain (%);force (kN)\n1,5;-2\n0,25;3e2\n");
        assert_eq!((values(&comma, "strain"), values(&comma, "force")), (vec![1.5, 0.25], vec![-2.0, 300.0]));
        assert_eq!(values(&parse("strain (%);force (kN)\n1.5;2.0"), "strain"), [1.5]);
        // A comma that stands between names with units separates them; one in a name does not.
        assert!(rejected("strain (%),a;b (N)\n1,5;2\n").contains("the cell is \"5;2\""));
        let named = parse("strain, top (%);force (kN)\n1,5;-2\n");
        assert_eq!((values(&named, "strain, top"), values(&named, "force")), (vec![1.5], vec![-2.0]));
        let below = parse("strain, top;force\n%;kN\n1,5;-2\n");
        assert_eq!(values(&below, "strain, top"), [1.5]);
        // Between quotes it may stand between thousands.
        let quoted = rejected("strain (%),force (N)\n\"0,250\",\"1,5\"\n");
        let wanted =
            "column \"strain\": the cell is \"0,250\"; allowed: a decimal point; a decimal comma with ; or tabs";
        assert!(quoted.contains(wanted), "{quoted}");
    }

    /// What machines write besides names, units and numbers.
    #[test]
    fn forms_that_machines_export_are_one_table() {
        let rows = "0.2,7.5\n0.4,13.9\n";
        let semicolons = rows.replace(',', ";").replace('.', ",");
        for text in [
            format!("strain (%),force (N)\n{rows}"),
            format!("strain / %,force / N\n{rows}"),
            format!("sep=,\nstrain (%),force (N)\n{rows}"),
            format!("sep=;\nstrain (%);force (N)\n{semicolons}"),
            format!("Zwick testXpert II\nSpecimen: 1\nDate: 2026-11-27\n\nstrain (%),force (N)\n{rows}"),
            format!("strain (%),force (N),\n{}", rows.replace('\n', ",\n")),
            format!("strain (%),force (N)\n{}", rows.replace('\n', ",,\n")),
            format!("strain,force\n%,N\n{rows}"),
            format!("Specimen 1\nstrain;force;\n[%];[N];\n{semicolons}"),
        ] {
            let table = parse(&text);
            assert_eq!(
                (values(&table, "strain"), values(&table, "force")),
                (vec![0.2, 0.4], vec![7.5, 13.9]),
                "{text}"
            );
            assert_eq!(table.column("force").expect("a column").unit.text, "N");
        }
        let text = "strain (%),Prüfkraft (N)\n0.2,7.5\n";
        let utf_16 = |mark: [u8; 2], bytes: fn(u16) -> [u8; 2]| {
            mark.into_iter().chain(text.encode_utf16().flat_map(bytes)).collect::<Vec<u8>>()
        };
        let latin = text.chars().map(|c| c as u8).collect();
        let all = [
            text.as_bytes().to_vec(),
            latin,
            utf_16([0xff, 0xfe], u16::to_le_bytes),
            utf_16([0xfe, 0xff], u16::to_be_bytes),
        ];
        for bytes in all {
            assert_eq!(decoded(&bytes).map(|text| parse(&text).columns[1].name.clone()).as_deref(), Some("Prüfkraft"));
        }
    }

    #[test]
    fn any_line_break_ends_a_line() {
        for text in ["f (N)\n1\n2", "f (N)\r\n1\r\n2\r\n", "f (N)\r1\r2\r", "f (N)\n1\n \n2\n\n"] {
            assert_eq!(values(&parse(text), "f"), [1.0, 2.0]);
        }
    }

    #[test]
    fn values_are_converted() {
        let table = parse("# by hand\nstrain (%),force (kN)\n1.5,0.1\n");
        let units = UnitSystem::parse("mm-tonne-s").expect("a system");
        assert_eq!(table.values("strain", NUMBER, &units), Ok(vec![0.015]));
        assert_eq!(table.values("force", FORCE, &units), Ok(vec![100.0]));
        let error = |name: &str, dimension| table.values(name, dimension, &units).expect_err("wrong").to_string();
        assert_eq!(
            error("strain", FORCE),
            "data.csv:2:1: column \"strain\": the unit is \"%\"; allowed: a unit of force, as N"
        );
        assert_eq!(error("force", NUMBER), "data.csv:2:2: column \"force\": the unit is \"kN\"; allowed: - or %");
        assert_eq!(error("Force", FORCE), "data.csv:2: no column \"Force\"; there are: strain, force");
    }

    #[test]
    fn errors_name_file_line_and_column() {
        let heading = "allowed: a name and a unit, as in \"force (N)\", and \"(-)\" for a plain number";
        let empty = "data.csv:1:1: no header; allowed: columns as in \"displacement (mm), force (N)\"";
        let (one, two) = ("a (mm),b (N)\n", "column \"b\": ");
        let cases = [
            (String::new(), empty.to_string()),
            ("# nothing\n\n".to_string(), empty.to_string()),
            (
                one.to_string(),
                "1:1: column \"a\": no line of data follows the header; allowed: one at least".to_string(),
            ),
            ("#\na (mm),b\n1,2\n".to_string(), format!("2:2: the heading is \"b\"; {heading}")),
            ("a (mm),\n1,2\n".to_string(), format!("1:2: the heading is \"\"; {heading}")),
            ("(mm),b (N)\n1,2\n".to_string(), format!("1:1: the heading is \"(mm)\"; {heading}")),
            ("a mm)\n1\n".to_string(), format!("1:1: the heading is \"a mm)\"; {heading}")),
            (
                "a (mm),b (Mpa)\n1,2\n".to_string(),
                format!("1:2: the unit of \"b (Mpa)\": \"Mpa\" is not known; allowed: {}", unit_expression::ALLOWED),
            ),
            (
                "a (mm),b (N),a (s)\n1,2,3\n".to_string(),
                "1:3: the name \"a\" is that of column 1 as well; allowed: a name for each column".to_string(),
            ),
            (format!("{one}1\n"), format!("2:2: {two}number of cells: 1; allowed: 2, as in the header")),
            (format!("{one}1,2\n\n1,2,3\n"), "4:3: number of cells: 3; allowed: 2, as in the header".to_string()),
            (format!("{one}1,\n"), format!("2:2: {two}the cell is \"\"; allowed: a finite number")),
            (format!("{one}1,x\n"), format!("2:2: {two}the cell is \"x\"; allowed: a finite number")),
            (format!("{one}1,NaN\n"), format!("2:2: {two}the cell is \"NaN\"; allowed: a finite number")),
            (format!("{one}1,-inf\n"), format!("2:2: {two}the cell is \"-inf\"; allowed: a finite number")),
            (format!("{one}1,1e999\n"), format!("2:2: {two}the cell is \"1e999\"; allowed: a finite number")),
            (
                format!("{one}1,12 N\n"),
                format!("2:2: {two}the cell is \"12 N\"; a unit in a cell; units belong in the header"),
            ),
            (
                format!("{one}1,-1.5%\n"),
                format!("2:2: {two}the cell is \"-1.5%\"; a unit in a cell; units belong in the header"),
            ),
            (
                "a (mm);b (N)\n1,5;2\n1;1.234\n".to_string(),
                format!(
                    "3:2: {two}the cell is \"1.234\"; allowed: a finite number with a decimal comma, as in the rest"
                ),
            ),
        ];
        for (text, wanted) in cases {
            let message = rejected(&text);
            assert_eq!(message.trim_start_matches("data.csv:"), wanted.trim_start_matches("data.csv:"), "{text}");
            assert!(message.starts_with("data.csv:"), "{message}");
        }
    }

    #[test]
    fn a_file_that_cannot_be_read_is_named() {
        let folder = std::env::temp_dir().join(format!("toron-data-table-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join("latin.csv");
        std::fs::write(&path, b"a (mm)\nb (\xb5m)\n").expect("a file");
        let latin = DataTable::read(&path).expect_err("no number").to_string();
        std::fs::write(&path, b"PK\x03\x04").expect("a file");
        let binary = DataTable::read(&path).expect_err("no text").to_string();
        let missing = DataTable::read(&folder.join("none.csv")).expect_err("there is none").to_string();
        std::fs::remove_dir_all(&folder).expect("the folder can go");
        assert!(latin.contains("latin.csv:2:1: column \"a\": the cell is \"b (µm)\""), "{latin}");
        assert!(binary.ends_with("latin.csv: no text; allowed: a CSV file in UTF-8, UTF-16 or Latin-1"), "{binary}");
        assert!(missing.contains("none.csv: "), "{missing}");
    }

    proptest! {
        #[test]
        fn no_text_panics(any in "(?s).*", alike in "[a(N)\\[\\],;\"#0-9.eE\r\n \u{feff}µ-]{0,60}") {
            for text in [any.clone(), alike.clone(), format!("a (N);b (%)\n{alike}"), format!("a (N),b [%]\n{any}")] {
                if let Ok(table) = DataTable::parse("data.csv", &text) {
                    prop_assert!(table.columns.iter().all(|column| !column.values.is_empty()));
                }
            }
        }
    }
}
