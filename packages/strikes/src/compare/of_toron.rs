//! The history of a case of `toron fabric` or `toron impact`: a CSV file whose titles have the units.

use std::path::Path;

use toron::host::units::UnitSystem;
use toron::law::parameters::{Dimension, NUMBER};

use super::history::{Curve, History, Quantity};
use toron_materials::data_table::DataTable;
use toron_materials::units::{ENERGY, FORCE, LENGTH, SPEED, TIME};
use toron_shared::error::Error;

/// What its first title begins with.
pub const START: &str = "time (";

/// Quantities by the titles of [`columns`](toron_explicit_host::struck::history::columns).
const NAMED: [(Quantity, &str, Dimension); 10] = [
    (Quantity::Speed, "speed", SPEED),
    (Quantity::Force, "force", FORCE),
    (Quantity::Striker, "projectile_energy", ENERGY),
    (Quantity::Kinetic, "kinetic_energy", ENERGY),
    (Quantity::Internal, "internal_energy", ENERGY),
    (Quantity::Hourglass, "hourglass_energy", ENERGY),
    (Quantity::Viscosity, "viscosity_energy", ENERGY),
    (Quantity::Contact, "contact_energy", ENERGY),
    (Quantity::Friction, "friction_energy", ENERGY),
    (Quantity::Total, "total_energy", ENERGY),
];

/// # Errors
/// A column is missing, or what [`DataTable::parse`] refuses.
pub fn read(path: &Path, text: &str, units: &UnitSystem, name: String) -> Result<History, Error> {
    let table = DataTable::parse(&path.display().to_string(), text)?;
    let times = table.values("time", TIME, units)?;
    let curve = |name: &str, dimension| {
        table.values(name, dimension, units).map(|values| Curve { times: times.clone(), values })
    };
    let mut history = History::new("toron", name);
    for (quantity, name, dimension) in NAMED {
        history.set(quantity, curve(name, dimension)?);
    }
    // Of a panel; a yarn's history has none.
    if table.has("deflection") {
        history.set(Quantity::Deflection, curve("deflection", LENGTH)?);
    }
    history.failed = curve("deleted", NUMBER)?.first(|deleted| deleted > 0.0);
    Ok(history)
}
