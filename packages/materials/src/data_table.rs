//! Measured data: a CSV file whose header has a name and a unit for each column that is used, `force (N)` or
//! `force [N]`. What a [`Sheet`] is in cells is numbers here.
//!
//! Every error names file, line and column, and every value keeps its place for the errors that come later. A column
//! that is not numbers with a unit is an error where somebody asks for it.

use std::path::Path;

use self::sheet::{Heading, Sheet};
use super::unit_expression::{self, Unit};
use super::units;
use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;
use toron_shared::error::Error;
use toron_shared::toml_error::shortened;

mod lines;
pub mod sheet;

/// A table of measured data. Lines are those of the file, from 1; so are the numbers of columns.
#[derive(Clone, Debug)]
pub struct DataTable {
    /// The file, as messages have it.
    pub name: String,
    /// Those of numbers with a unit.
    pub columns: Vec<Column>,
    /// The line of the header.
    pub header: usize,
    /// The lines of tests that are left out, which [`DataTable::read_tests`] alone does.
    pub excluded: Vec<Excluded>,
    others: Vec<Other>,
}

/// A line that is left out, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Excluded {
    pub line: usize,
    pub reason: String,
}

/// The column that has a reason in the lines of tests that are left out, and what means none.
const EXCLUDED: &str = "excluded";
const KEPT: [&str; 6] = ["", "-", "0", "no", "n", "false"];
/// What is no reason.
const BARE: [&str; 5] = ["1", "x", "yes", "y", "true"];

/// A column that is not of numbers with a unit, and why.
#[derive(Clone, Debug)]
struct Other {
    name: String,
    number: usize,
    error: Error,
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
        DataTable::of(&Sheet::read(path)?)
    }

    /// Reads a file of tests, but for the lines that have a reason in a column `excluded`.
    ///
    /// # Errors
    /// An input error that names file, line and column, what is there and what is allowed.
    pub fn read_tests(path: &Path) -> Result<DataTable, Error> {
        DataTable::of_tests(Sheet::read(path)?)
    }

    fn of_tests(mut sheet: Sheet) -> Result<DataTable, Error> {
        let is_column = |heading: &Heading| heading.name.eq_ignore_ascii_case(EXCLUDED);
        let Some(place) = sheet.headings.iter().position(is_column) else { return DataTable::of(&sheet) };
        let mut excluded = Vec::new();
        for row in &sheet.rows {
            let (reason, word) = (row.cells[place].clone(), row.cells[place].to_lowercase());
            if BARE.contains(&word.as_str()) {
                let message = format!("the cell is \"{reason}\"; allowed: the reason in words, or nothing");
                return Err(sheet.error(row.line, place + 1, &message));
            }
            if !KEPT.contains(&word.as_str()) {
                excluded.push(Excluded { line: row.line, reason });
            }
        }
        sheet.rows.retain(|row| excluded.iter().all(|left_out| left_out.line != row.line));
        if sheet.rows.is_empty() {
            return Err(sheet.error(
                sheet.header,
                place + 1,
                "every line is left out; allowed: one at least that is not",
            ));
        }
        Ok(DataTable { excluded, ..DataTable::of(&sheet)? })
    }

    /// The table that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line and column, what is there and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<DataTable, Error> {
        DataTable::of(&Sheet::parse(name, text)?)
    }

    /// The numbers of a sheet.
    ///
    /// # Errors
    /// Two columns have one name, or no column is of numbers with a unit.
    fn of(sheet: &Sheet) -> Result<DataTable, Error> {
        let mut table = DataTable {
            name: sheet.name.clone(),
            columns: Vec::new(),
            header: sheet.header,
            excluded: Vec::new(),
            others: Vec::new(),
        };
        for (place, heading) in sheet.headings.iter().enumerate() {
            let is_same = |other: &Heading| other.name == heading.name && other.unit.is_some();
            if let Some(other) = sheet.headings[..place].iter().position(is_same).filter(|_| heading.unit.is_some()) {
                let message = format!("the name \"{}\" is that of column {} as well", heading.name, other + 1);
                let message = format!("{message}; allowed: a name for each column");
                return Err(Error::Input(format!("{}:{}:{}: {message}", sheet.name, sheet.header, place + 1)));
            }
            match column(sheet, place, heading) {
                Ok(column) => table.columns.push(column),
                Err(error) => table.others.push(Other { name: heading.name.clone(), number: place + 1, error }),
            }
        }
        match table.others.first() {
            Some(other) if table.columns.is_empty() => Err(other.error.clone()),
            _ => Ok(table),
        }
    }

    /// The names of all columns with their numbers in the file, of those too that are not numbers with a unit.
    pub fn names(&self) -> impl Iterator<Item = (&str, usize)> {
        let others = self.others.iter().map(|other| (other.name.as_str(), other.number));
        self.columns.iter().map(|column| (column.name.as_str(), column.number)).chain(others)
    }

    /// Whether a column has this name, which [`DataTable::column`] may refuse all the same.
    pub fn has(&self, name: &str) -> bool {
        self.names().any(|(known, _)| known == self.own_name(name))
    }

    /// The name as the table has it: the same, or else the only one that differs by capital letters alone.
    pub fn own_name<'a>(&'a self, name: &'a str) -> &'a str {
        let mut alike = self.names().map(|(known, _)| known).filter(|known| known.eq_ignore_ascii_case(name));
        match (self.names().any(|(known, _)| known == name), alike.next(), alike.next()) {
            (false, Some(one), None) => one,
            _ => name,
        }
    }

    /// The column of this name, or of the only one that differs by capital letters alone.
    ///
    /// # Errors
    /// There is none, and the message names those that exist; or it is not of numbers with a unit.
    pub fn column(&self, name: &str) -> Result<&Column, Error> {
        let name = self.own_name(name);
        if let Some(column) = self.columns.iter().find(|column| column.name == name) {
            return Ok(column);
        }
        if let Some(other) = self.others.iter().find(|other| other.name == name) {
            return Err(other.error.clone());
        }
        let known: Vec<&str> = self.columns.iter().map(|column| column.name.as_str()).collect();
        let message = format!("no column \"{name}\"; there are: {}", known.join(", "));
        Err(Error::Input(format!("{}:{}: {message}", self.name, self.header)))
    }

    /// The values of a column, in a system's unit of this dimension.
    ///
    /// # Errors
    /// There is no such column, or its unit is of another dimension.
    pub fn values(&self, name: &str, dimension: Dimension, system: &UnitSystem) -> Result<Vec<f64>, Error> {
        self.converted(self.column(name)?, None, dimension, system)
    }

    /// As [`DataTable::values`], where kg, g and lb are taken for kgf, gf and lbf if nothing else gives the dimension;
    /// what is to be said of that, if it is so.
    ///
    /// # Errors
    /// There is no such column, or its unit is of another dimension.
    pub fn forces(
        &self,
        name: &str,
        dimension: Dimension,
        system: &UnitSystem,
    ) -> Result<(Vec<f64>, Option<String>), Error> {
        let column = self.column(name)?;
        let force = if column.unit.measures(dimension) { None } else { column.unit.as_force() };
        let force = force.filter(|force| force.measures(dimension));
        let said = force
            .as_ref()
            .map(|force| format!("{} of the column {} is taken for {}", column.unit.text, column.name, force.text));
        Ok((self.converted(column, force, dimension, system)?, said))
    }

    /// The values of a column, in this unit or its own.
    fn converted(
        &self,
        column: &Column,
        unit: Option<Unit>,
        dimension: Dimension,
        system: &UnitSystem,
    ) -> Result<Vec<f64>, Error> {
        let unit = unit.as_ref().unwrap_or(&column.unit);
        if !unit.measures(dimension) {
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
        Ok(column.values.iter().map(|cell| unit.convert(cell.value, system)).collect())
    }

    /// An error at a place of the file: `file:line:column: column "force": message`.
    pub fn error(&self, line: usize, column: usize, message: &str) -> Error {
        let found = self.columns.iter().find(|known| known.number == column);
        let named = found.map(|column| format!("column \"{}\": ", column.name)).unwrap_or_default();
        Error::Input(format!("{}:{line}:{column}: {named}{message}", self.name))
    }
}

/// The numbers of a column.
///
/// # Errors
/// Its heading has no unit, or a cell no number.
fn column(sheet: &Sheet, place: usize, heading: &Heading) -> Result<Column, Error> {
    let number = place + 1;
    let error = |message: String| Error::Input(format!("{}:{}:{number}: {message}", sheet.name, sheet.header));
    let text = shortened(&heading.text);
    let unit = match &heading.unit {
        Some(Ok(unit)) => unit.clone(),
        Some(Err(reason)) => {
            return Err(error(format!("the unit of \"{text}\": {reason}; allowed: {}", unit_expression::ALLOWED)));
        }
        None => {
            let allowed = "a name and a unit, as in \"force (N)\", and \"(-)\" for a plain number";
            return Err(error(format!("the heading is \"{text}\"; allowed: {allowed}")));
        }
    };
    let cell = |row| Ok(Cell { value: sheet.number(row, place)?, line: row.line, column: number });
    let values: Result<Vec<Cell>, Error> = sheet.rows.iter().map(cell).collect();
    Ok(Column { name: heading.name.clone(), number, unit, values: values? })
}

#[cfg(test)]
mod tests;
