//! The lines that LAMMPS writes of a run, in its own units.

use std::path::Path;

use super::input::{COLUMNS, STATION_COLUMNS};
use super::model::{Model, Striking};
use super::pressed;
use toron_shared::error::Error;
use toron_shared::run_directory::file_error;

/// A line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Line {
    pub step: u64,
    pub time: f64,
    /// Of the projectile or of the driven section, against the blow; and how far it has come.
    pub speed: f64,
    pub way: f64,
    /// Since the line before, in the mean: the force on the fibres along the blow, and what friction at the projectile
    /// and the contact there take (or, of what is driven, the power that comes from outside).
    pub force: f64,
    pub power: f64,
    pub kinetic: f64,
    pub trusses: f64,
    pub contact: f64,
    pub pressed: f64,
    /// Trusses that are whole.
    pub left: f64,
    /// The square of the fastest bead's speed, and the length of the longest truss.
    pub fastest: f64,
    pub longest: f64,
    pub stations: [Station; 4],
}

/// The places of a layer's beads across the yarn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Station {
    pub least: f64,
    pub most: f64,
    pub mean: f64,
    pub mean_square: f64,
}

/// Reads the file. A run that went on from a restart file has written some lines again: the later ones count.
///
/// # Errors
/// It cannot be read.
pub fn read(file: &Path, model: &Model) -> Result<Vec<Vec<f64>>, Error> {
    let text = std::fs::read_to_string(file).map_err(|error| file_error(file, &error))?;
    let columns = match model.striker {
        Striking::Walls(_) => pressed::input::COLUMNS,
        _ => COLUMNS + STATION_COLUMNS * model.stations.len(),
    };
    Ok(rows(&text, columns, model.steps as f64))
}

/// The numbers of each line, the first of which is its step. What cannot be read is the end of a line that was being
/// written.
fn rows(text: &str, columns: usize, last: f64) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for line in text.lines() {
        let row: Vec<f64> = line.split_whitespace().map_while(|number| number.parse().ok()).collect();
        if row.len() == columns && (1.0..=last).contains(&row[0]) {
            let kept = rows.iter().take_while(|known| known[0] < row[0]).count();
            rows.truncate(kept);
            rows.push(row);
        }
    }
    rows
}

/// The line that these numbers are, of a yarn.
pub fn line(numbers: &[f64]) -> Option<Line> {
    let (run, stations) = numbers.split_at_checked(COLUMNS)?;
    let [step, time, speed, way, force, power, kinetic, trusses, contact, pressed, left, fastest, longest] = *run
    else {
        return None;
    };
    let mut places = [Station::default(); 4];
    if stations.len() != places.len() * STATION_COLUMNS {
        return None;
    }
    for (place, numbers) in places.iter_mut().zip(stations.chunks_exact(STATION_COLUMNS)) {
        let [least, most, mean, mean_square] = *numbers else { return None };
        *place = Station { least, most, mean, mean_square };
    }
    let step = step as u64;
    let stations = places;
    Some(Line {
        step,
        time,
        speed,
        way,
        force,
        power,
        kinetic,
        trusses,
        contact,
        pressed,
        left,
        fastest,
        longest,
        stations,
    })
}

/// The last step of which a line has been written.
pub fn last_step(file: &Path, model: &Model) -> f64 {
    read(file, model).ok().and_then(|rows| rows.last().map(|row| row[0])).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_were_written_again_count_once() {
        let written =
            |step: u64, time: f64| format!("{step} {time} 1 2 3 4 5 6 7 8 9 10 11 {}\n", "0 1 0.5 0.3 ".repeat(4));
        let text = written(10, 1.0)
            + &written(20, 2.0)
            + &written(30, 3.0)
            + "40 4.0 1 2\n"
            + &written(20, 2.5)
            + &written(30, 3.5)
            + "40 4";
        let read: Vec<Line> =
            rows(&text, COLUMNS + 4 * STATION_COLUMNS, 100.0).iter().filter_map(|row| line(row)).collect();
        assert_eq!(
            read.iter().map(|line| (line.step, line.time)).collect::<Vec<_>>(),
            [(10, 1.0), (20, 2.5), (30, 3.5)]
        );
        assert_eq!(read[0].stations[3], Station { least: 0.0, most: 1.0, mean: 0.5, mean_square: 0.3 });
    }
}
