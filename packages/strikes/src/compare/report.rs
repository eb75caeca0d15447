//! The table of the histories, for a terminal and as CSV.

use toron::host::units::UnitSystem;

use super::figures::Figures;
use super::history::{Curve, History, QUANTITIES};
use toron_explicit_host::struck::summary::{Cells, Row};
use toron_materials::units::{ENERGY, LENGTH, SPEED, TIME, unit};
use toron_shared::numbers::number;
use toron_shared::text_table::{Column, NONE, or_dash, shortened, table};

/// Columns of a terminal.
const WIDTH: usize = 160;
const LONGEST_NAME: usize = 24;

/// The most important columns first; energies are those at the end.
pub fn report(histories: &[(&History, Figures)], units: &UnitSystem) -> String {
    let column = |above: &str, below: &str, entry: &dyn Fn(&History, &Figures) -> String| Column {
        heading: [above.to_string(), below.to_string()],
        entries: histories.iter().map(|(history, figures)| entry(history, figures)).collect(),
    };
    let [time, length, speed, energy] = [TIME, LENGTH, SPEED, ENERGY].map(|dimension| unit(units, dimension));
    let mut columns = vec![
        column("history", "", &|history, _| shortened(&history.name, LONGEST_NAME)),
        column("host", "", &|history, _| history.host.to_string()),
        column("ends at", &time, &|_, figures| number(figures.end)),
        column("speed", &speed, &|_, figures| or_dash(figures.speed[0], number)),
        column("at end", &speed, &|_, figures| or_dash(figures.speed[1], number)),
        column("residual", &speed, &|_, figures| or_dash(figures.residual, number)),
        column("failed at", &time, &|history, _| or_dash(history.failed, number)),
        column("apart", &speed, &|_, figures| or_dash(figures.apart, |apart| format!("{apart:.2}"))),
        column("deflection", &length, &|_, figures| or_dash(figures.deflection, number)),
    ];
    for row in QUANTITIES.iter().filter(|row| row.dimension == ENERGY) {
        let name = row.name.trim_end_matches("_energy");
        columns.push(column(name, &energy, &|history, _| {
            or_dash(history.curve(row.quantity).and_then(Curve::last), number)
        }));
    }
    table(columns, WIDTH)
}

/// A line of the table's CSV file.
pub fn line(history: &History, figures: &Figures, units: &UnitSystem) -> Cells {
    let mut row = Row::new(units);
    row.add("history", &history.name);
    row.add("host", history.host);
    row.quantity("end", TIME, figures.end);
    row.quantity("speed_at_start", SPEED, figures.speed[0]);
    row.quantity("speed_at_end", SPEED, figures.speed[1]);
    row.quantity("residual_speed", SPEED, figures.residual);
    row.quantity("failed", TIME, history.failed);
    row.quantity("speeds_apart", SPEED, figures.apart);
    row.quantity("deflection", LENGTH, figures.deflection);
    for energy in QUANTITIES.iter().filter(|quantity| quantity.dimension == ENERGY) {
        row.quantity(energy.name, energy.dimension, history.curve(energy.quantity).and_then(Curve::last));
    }
    row.cells
}

/// What is not there of a history, as the report says it.
pub fn missing(history: &History) -> Option<String> {
    let names = QUANTITIES.iter().filter(|row| history.curve(row.quantity).is_none()).map(|row| row.name);
    let names: Vec<&str> = names.collect();
    (!names.is_empty()).then(|| format!("{} has no {} ({NONE})\n", history.name, names.join(", ")))
}
