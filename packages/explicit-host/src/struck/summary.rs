//! The summary: a line of figures for every case, with the units in the heads of its columns.

use std::fmt::Display;

use super::history::title;
use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;
use toron_shared::numbers::number;
use toron_shared::text_table::or_dash;

/// Titles and entries, as [`write_csv`](toron_shared::text_table::write_csv) takes them.
pub type Cells = Vec<(String, String)>;

/// A line that is being built.
pub struct Row<'a> {
    units: &'a UnitSystem,
    pub cells: Cells,
}

impl Row<'_> {
    pub fn new(units: &UnitSystem) -> Row<'_> {
        Row { units, cells: Vec::new() }
    }

    /// Adds what has no unit.
    pub fn add(&mut self, name: &str, entry: impl Display) {
        self.cells.push((name.to_string(), entry.to_string()));
    }

    /// Adds a quantity, or a dash where there is none.
    pub fn quantity(&mut self, name: &str, dimension: Dimension, value: impl Into<Option<f64>>) {
        self.cells.push((title(name, dimension, self.units), or_dash(value.into(), number)));
    }

    /// Adds a number of so many decimals.
    pub fn decimals(&mut self, name: &str, value: f64, digits: usize) {
        self.add(name, format_args!("{value:.digits$}"));
    }
}
