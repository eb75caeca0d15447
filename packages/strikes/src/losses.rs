//! What friction between the fibres of a section has taken, in reports.

use toron::host::units::UnitSystem;
use toron_materials::units::{ENERGY, unit};
use toron_shared::numbers::number;
use toron_shared::text_table::folded;

/// The line of a report on the cases that have lost energy so, each by its name; empty where none has.
pub fn lost_between_fibres<'a>(
    units: &UnitSystem,
    cases: impl Iterator<Item = (&'a str, f64)>,
    width: usize,
) -> String {
    let lost: Vec<String> = cases
        .filter(|&(_, energy)| energy > 0.0)
        .map(|(case, energy)| format!("{} {} ({case})", number(energy), unit(units, ENERGY)))
        .collect();
    if lost.is_empty() {
        String::new()
    } else {
        folded(&format!("Lost between fibres: {}", lost.join(", ")), width) + "\n"
    }
}
