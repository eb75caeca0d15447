//! A history of `toron impact` under the same blow, to be drawn beside that of the fibres.

use std::collections::HashMap;
use std::path::Path;

use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;
use toron_materials::data_table::DataTable;
use toron_materials::units::{ENERGY, LENGTH, SPEED, TIME};
use toron_shared::error::Error;
use toron_shared::file_names::STRAINS;
use toron_shared::run_directory::{file_error, is_file};

/// The columns that are drawn.
const COLUMNS: [(&str, Dimension); 6] = [
    ("speed", SPEED),
    ("kinetic_energy", ENERGY),
    ("elongation_energy", ENERGY),
    ("compaction_energy", ENERGY),
    ("distortion_energy", ENERGY),
    ("width_1", LENGTH),
];

/// The history, column by column.
#[derive(Clone, Debug, PartialEq)]
pub struct Beside {
    times: Vec<f64>,
    columns: HashMap<&'static str, Vec<f64>>,
}

impl Beside {
    /// Reads the file, in the scene's units.
    ///
    /// # Errors
    /// It cannot be read, or is no history of `toron impact`.
    pub fn read(file: &Path, units: &UnitSystem) -> Result<Beside, Error> {
        Beside::of(&DataTable::read(file)?, units)
    }

    fn of(table: &DataTable, units: &UnitSystem) -> Result<Beside, Error> {
        let column = |(name, dimension)| Ok((name, table.values(name, dimension, units)?));
        let columns = COLUMNS.into_iter().map(column).collect::<Result<_, Error>>()?;
        Ok(Beside { times: table.values("time", TIME, units)?, columns })
    }

    /// The value of one of the columns at a time, between two lines by a straight line; at the ends, the last one there
    /// is.
    pub fn at(&self, name: &str, time: f64) -> f64 {
        self.columns.get(name).map_or(f64::NAN, |values| between(&self.times, values, time))
    }
}

/// A value between two of an ascending abscissa by a straight line; at the ends, the last one there is.
pub(crate) fn between(abscissa: &[f64], values: &[f64], place: f64) -> f64 {
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
    use toron_explicit_host::struck::history;
    use toron_explicit_host::struck::sample::Sample;
    use toron_strikes::impact::outcome::OfYarn;
    use toron_strikes::impact::summary;

    const MM_G_MS: &str = "mm-g-ms";

    fn system(name: &str) -> UnitSystem {
        UnitSystem::parse(name).expect("units of the library")
    }

    /// As `toron impact` writes it, whatever its units.
    #[test]
    fn a_history_of_impact_is_read_between_its_lines() {
        let columns = history::columns(summary::columns());
        let sample = |time: f64, speed: f64| Sample::<OfYarn> { time, speed, ..Sample::default() };
        let lines = [sample(0.0, 10.0), sample(2.0, 20.0)].map(|sample| history::line(&columns, &sample)).concat();
        let text = history::titles(&columns, &system(MM_G_MS)) + &lines;
        let table = DataTable::parse("law.csv", &text).expect("a table");
        let beside = Beside::of(&table, &system(MM_G_MS)).expect("a history");
        assert_eq!([-1.0, 0.0, 0.5, 2.0, 3.0].map(|time| beside.at("speed", time)), [10.0, 10.0, 12.5, 20.0, 20.0]);
        let seconds = Beside::of(&table, &system("mm-tonne-s")).expect("a history");
        assert!((seconds.at("speed", 0.5e-3) - 12.5e3).abs() < 1e-9, "{}", seconds.at("speed", 0.5e-3));
        let short = DataTable::parse("law.csv", "time (ms),speed (m/s)\n0,1\n").expect("a table");
        let message = Beside::of(&short, &system(MM_G_MS)).expect_err("columns").to_string();
        assert!(message.contains("no column \"kinetic_energy\""), "{message}");
    }
}
