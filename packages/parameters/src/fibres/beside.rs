//! A history of `toron impact` under the same blow, to be drawn beside that of the fibres.

use std::collections::HashMap;
use std::path::Path;

use toron_shared::error::Error;
use toron_shared::file_names::STRAINS;
use toron_shared::run_directory::{file_error, is_file};

const TIME: &str = "time";
/// The columns that are drawn.
const COLUMNS: [&str; 6] =
    ["speed", "kinetic_energy", "elongation_energy", "compaction_energy", "distortion_energy", "width_1"];

/// The history, column by column.
#[derive(Clone, Debug, PartialEq)]
pub struct Beside {
    times: Vec<f64>,
    columns: HashMap<&'static str, Vec<f64>>,
}

impl Beside {
    /// Reads the file.
    ///
    /// # Errors
    /// It cannot be read, or is no history of `toron impact`.
    pub fn read(file: &Path) -> Result<Beside, Error> {
        let text = std::fs::read_to_string(file).map_err(|error| file_error(file, &error))?;
        Beside::parse(&text).map_err(|message| file_error(file, &message))
    }

    fn parse(text: &str) -> Result<Beside, String> {
        let mut columns = table(text, &[&COLUMNS[..], &[TIME]].concat())?;
        let times = columns.pop().unwrap_or_default();
        Ok(Beside { times, columns: COLUMNS.into_iter().zip(columns).collect() })
    }

    /// The value of one of the columns at a time, between two lines by a straight line; at the ends, the last one there
    /// is.
    pub fn at(&self, name: &str, time: f64) -> f64 {
        self.columns.get(name).map_or(f64::NAN, |values| between(&self.times, values, time))
    }
}

/// A value between two of an ascending abscissa by a straight line; at the ends, the last one there is.
fn between(abscissa: &[f64], values: &[f64], place: f64) -> f64 {
    let after = abscissa.partition_point(|&known| known < place);
    let (Some(before), true) = (after.checked_sub(1), after < values.len()) else {
        return values[after.min(values.len() - 1)];
    };
    let part = (place - abscissa[before]) / (abscissa[after] - abscissa[before]);
    values[before] + part * (values[after] - values[before])
}

/// The law's mean strains in % at these places along the yarn, out of the table of this number beside its history; none
/// where its run was over before.
///
/// # Errors
/// The table cannot be read, or is none of `toron impact`.
pub fn strains(history: &Path, number: usize, places: impl Iterator<Item = f64>) -> Result<Option<Vec<f64>>, Error> {
    let name = history.file_stem().unwrap_or_default().to_string_lossy();
    let file = history.with_file_name(format!("{name}{STRAINS}{number}.csv"));
    if !is_file(&file)? {
        return Ok(None);
    }
    let text = std::fs::read_to_string(&file).map_err(|error| file_error(&file, &error))?;
    let columns = table(&text, &["place", "strain_mean"]).map_err(|message| file_error(&file, &message))?;
    Ok(Some(places.map(|place| 100.0 * between(&columns[0], &columns[1], place)).collect()))
}

/// The columns of these names.
fn table(text: &str, names: &[&str]) -> Result<Vec<Vec<f64>>, String> {
    let mut lines = text.lines();
    let titles: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let place = |name: &&str| {
        let found = titles.iter().position(|title| title == name);
        found.ok_or_else(|| format!("no column {name}; allowed: what toron impact has written"))
    };
    let places = names.iter().map(place).collect::<Result<Vec<_>, String>>()?;
    let mut columns = vec![Vec::new(); names.len()];
    for (number, line) in (2..).zip(lines) {
        let cells: Vec<&str> = line.split(',').collect();
        for (column, &place) in columns.iter_mut().zip(&places) {
            let cell = cells.get(place).copied().unwrap_or_default();
            column.push(cell.parse().map_err(|_| format!("line {number}: \"{cell}\"; allowed: a number"))?);
        }
    }
    if columns.iter().any(Vec::is_empty) { Err("no line".to_string()) } else { Ok(columns) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_history_is_read_between_its_lines() {
        let head = format!("{TIME},{}\n", COLUMNS.join(","));
        let line = |time: f64, value: f64| format!("{time},{}\n", vec![value.to_string(); COLUMNS.len()].join(","));
        let beside = Beside::parse(&(head + &line(0.0, 10.0) + &line(2.0, 20.0))).expect("a history");
        assert_eq!([-1.0, 0.0, 0.5, 2.0, 3.0].map(|time| beside.at("speed", time)), [10.0, 10.0, 12.5, 20.0, 20.0]);
        assert!(Beside::parse("time,speed\n0,1\n").expect_err("columns").contains("no column kinetic_energy"));
    }
}
