//! A history of `toron impact` under the same blow, to be drawn beside that of the fibres.

use std::collections::HashMap;
use std::path::Path;

use crate::common::error::Error;
use crate::common::run_directory::file_error;

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
        let mut lines = text.lines();
        let titles: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let place = |name: &str| {
            let found = titles.iter().position(|title| *title == name);
            found.ok_or_else(|| format!("no column {name}; allowed: a history of toron impact, its NAME.csv"))
        };
        let time = place(TIME)?;
        let places = COLUMNS.iter().map(|&name| Ok((name, place(name)?))).collect::<Result<Vec<_>, String>>()?;
        let (mut times, mut columns) = (Vec::new(), HashMap::new());
        for (number, line) in (2..).zip(lines) {
            let cells: Vec<&str> = line.split(',').collect();
            let value = |place: usize| {
                let cell = cells.get(place).copied().unwrap_or_default();
                cell.parse::<f64>().map_err(|_| format!("line {number}: \"{cell}\"; allowed: a number"))
            };
            times.push(value(time)?);
            for &(name, place) in &places {
                columns.entry(name).or_insert_with(Vec::new).push(value(place)?);
            }
        }
        if times.is_empty() { Err("no line".to_string()) } else { Ok(Beside { times, columns }) }
    }

    /// The value of one of the columns at a time, between two lines by a straight line; at the ends, the last one there is.
    pub fn at(&self, name: &str, time: f64) -> f64 {
        let Some(values) = self.columns.get(name) else { return f64::NAN };
        let after = self.times.partition_point(|&known| known < time);
        let (Some(before), true) = (after.checked_sub(1), after < values.len()) else {
            return values[after.min(values.len() - 1)];
        };
        let part = (time - self.times[before]) / (self.times[after] - self.times[before]);
        values[before] + part * (values[after] - values[before])
    }
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
