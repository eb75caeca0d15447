//! A CSV file of a solver: titles without units, and numbers, of which some may be missing.

use std::path::Path;

use super::history::Curve;
use toron_shared::error::Error;

/// The first column is the time.
pub struct Table {
    /// The file, as messages have it.
    name: String,
    pub titles: Vec<String>,
    rows: Vec<Vec<Option<f64>>>,
}

impl Table {
    /// # Errors
    /// A line with other cells than the first one has, a cell that is neither empty nor a number, times that do not
    /// rise.
    pub fn read(path: &Path, text: &str) -> Result<Table, Error> {
        let name = path.display().to_string();
        let error = |line: usize, message: String| Error::Input(format!("{name}:{line}: {message}"));
        let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
        let mut records = reader.records();
        let titles: Vec<String> = match records.next() {
            Some(Ok(record)) => record.iter().map(|title| title.trim().to_string()).collect(),
            _ => return Err(error(1, "no titles; allowed: a title for each column".to_string())),
        };
        let mut rows: Vec<Vec<Option<f64>>> = Vec::new();
        for (line, record) in (2..).zip(records) {
            let record = record.map_err(|reason| error(line, reason.to_string()))?;
            if record.len() != titles.len() {
                let (found, wanted) = (record.len(), titles.len());
                return Err(error(line, format!("number of cells: {found}; allowed: {wanted}, as in the first line")));
            }
            let mut row = Vec::with_capacity(titles.len());
            for (cell, title) in record.iter().zip(&titles) {
                let cell = cell.trim();
                let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
                if number.is_none() && !cell.is_empty() {
                    return Err(error(line, format!("{title} is \"{cell}\"; allowed: a finite number, or nothing")));
                }
                row.push(number);
            }
            let time = row[0].ok_or_else(|| error(line, format!("{} is empty; allowed: a time", titles[0])))?;
            match rows.last().and_then(|last| last[0]) {
                // What a solver writes at the end twice.
                Some(last) if time == last => drop(rows.pop()),
                Some(last) if time < last => {
                    return Err(error(line, format!("the time is {time} behind {last}; allowed: times that rise")));
                }
                _ => {}
            }
            rows.push(row);
        }
        if rows.is_empty() {
            return Err(error(2, "no line of numbers; allowed: one at least".to_string()));
        }
        Ok(Table { name, titles, rows })
    }

    /// The columns whose titles are such.
    pub fn find(&self, of: impl Fn(&str) -> bool) -> Vec<usize> {
        (0..self.titles.len()).filter(|&i| of(&self.titles[i])).collect()
    }

    /// The column of this title.
    ///
    /// # Errors
    /// There is none.
    pub fn column(&self, title: &str) -> Result<Curve, Error> {
        self.find(|other| other == title).first().map(|&i| self.curve(i)).ok_or_else(|| self.missing(title))
    }

    pub fn missing(&self, what: &str) -> Error {
        Error::Input(format!("{}:1: no column {what}; allowed: the histories that a deck of toron asks for", self.name))
    }

    pub fn curve(&self, column: usize) -> Curve {
        Curve::new(self.rows.iter().filter_map(|row| Some((row[0]?, row[column]?))))
    }
}
