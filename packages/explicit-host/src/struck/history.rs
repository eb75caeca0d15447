//! The history of a case as a table: a line for each sample, with the same columns in the same units whatever is
//! struck.

use std::fmt::Write;

use super::sample::Sample;
use toron::host::units::UnitSystem;
use toron::law::parameters::{Dimension, ENERGY_DENSITY, NUMBER};
use toron_materials::units::{ENERGY, FORCE, LENGTH, SPEED, TIME, unit};

/// What a column takes from a sample.
type Quantity<E> = Box<dyn Fn(&Sample<E>) -> f64 + Send + Sync>;

/// A quantity of the history.
pub struct Column<E> {
    pub name: &'static str,
    pub dimension: Dimension,
    of: Quantity<E>,
}

impl<E> Column<E> {
    fn new(name: &'static str, dimension: Dimension, of: impl Fn(&Sample<E>) -> f64 + Send + Sync + 'static) -> Self {
        Column { name, dimension, of: Box::new(of) }
    }
}

impl<E: 'static> Column<E> {
    /// Of what a kind of scene has besides the quantities of all.
    pub fn own(name: &'static str, dimension: Dimension, of: impl Fn(&E) -> f64 + Send + Sync + 'static) -> Self {
        Column::new(name, dimension, move |sample| of(&sample.own))
    }

    pub fn value(&self, sample: &Sample<E>) -> f64 {
        (self.of)(sample)
    }
}

/// The columns that all scenes have, and then a scene's own.
pub fn columns<E>(own: Vec<Column<E>>) -> Vec<Column<E>> {
    const PARTS: [&str; 5] =
        ["elongation_energy", "compaction_energy", "distortion_energy", "shear_energy", "linear_work"];
    const LARGEST: [&str; 5] = ["w_el_max", "w_tc_max", "w_td_max", "w_ld_max", "work_max"];
    let mut columns = vec![
        Column::new("time", TIME, |sample| sample.time),
        Column::new("speed", SPEED, |sample| sample.speed),
        Column::new("travel", LENGTH, |sample| sample.travel),
        Column::new("force", FORCE, |sample| sample.force),
        Column::new("projectile_energy", ENERGY, |sample| sample.energies.striker),
        Column::new("kinetic_energy", ENERGY, |sample| sample.energies.kinetic),
        Column::new("internal_energy", ENERGY, |sample| sample.energies.internal),
        Column::new("hourglass_energy", ENERGY, |sample| sample.energies.hourglass),
        Column::new("viscosity_energy", ENERGY, |sample| sample.energies.viscosity),
        Column::new("friction_energy", ENERGY, |sample| sample.energies.friction),
        Column::new("contact_energy", ENERGY, |sample| sample.energies.contact),
        Column::new("fibre_friction_energy", ENERGY, |sample| sample.energies.fibres),
        Column::new("shred_energy", ENERGY, |sample| sample.energies.shreds),
        Column::new("external_work", ENERGY, |sample| sample.energies.external),
        Column::new("total_energy", ENERGY, |sample| sample.energies.total()),
    ];
    for (mode, name) in PARTS.into_iter().enumerate() {
        columns.push(Column::new(name, ENERGY, move |sample| sample.parts[mode]));
    }
    for (mode, name) in LARGEST.into_iter().enumerate() {
        columns.push(Column::new(name, ENERGY_DENSITY, move |sample| sample.largest[mode]));
    }
    columns.extend([
        Column::new("failure_index_max", NUMBER, |sample: &Sample<E>| sample.index),
        Column::new("deleted", NUMBER, |sample| sample.deleted as f64),
        Column::new("collapsed", NUMBER, |sample| sample.collapsed as f64),
    ]);
    columns.extend(own);
    columns
}

/// A quantity and its unit, as the head of a column.
pub fn title(name: &str, dimension: Dimension, units: &UnitSystem) -> String {
    format!("{name} ({})", unit(units, dimension))
}

/// The first line of the table.
pub fn titles<E>(columns: &[Column<E>], units: &UnitSystem) -> String {
    let titles: Vec<String> = columns.iter().map(|column| title(column.name, column.dimension, units)).collect();
    titles.join(",") + "\n"
}

/// The line of a sample: numbers in as few digits as it takes to read the same bits back.
pub fn line<E>(columns: &[Column<E>], sample: &Sample<E>) -> String {
    let mut text = String::new();
    for (place, column) in columns.iter().enumerate() {
        let value = (column.of)(sample);
        let before = if place == 0 { "" } else { "," };
        let _ = match value.trunc() == value && value.abs() < 1e9 {
            true => write!(text, "{before}{value}"),
            false => write!(text, "{before}{value:?}"),
        };
    }
    text.push('\n');
    text
}
