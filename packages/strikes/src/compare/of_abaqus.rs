//! Abaqus: the histories of an output database as the script beside the deck makes a CSV file of them,
//! `REGION:VARIABLE`.

use std::path::Path;

use super::history::{History, Quantity, direction};
use super::table::Table;
use toron_shared::error::Error;

/// What its first line has.
pub const MARK: &str = ":ALLKE";

/// # Errors
/// A column is missing, or the striker does not move.
pub fn read(path: &Path, text: &str, name: String) -> Result<History, Error> {
    let table = Table::read(path, text)?;
    let ending = |name: &str| table.find(|title| title.ends_with(name));
    let named = |name: &str| ending(name).first().map(|&i| table.curve(i)).ok_or_else(|| table.missing(name));
    // The deck asks for velocities of the striker alone.
    let velocities = [named(":V1")?, named(":V2")?, named(":V3")?];
    let starts = [0, 1, 2].map(|i| velocities[i].values.first().copied().unwrap_or_default());
    let (axis, sign) = direction(starts).ok_or_else(|| table.missing("with a speed of the striker at the start"))?;
    let mut history = History::new("Abaqus", name);
    history.set(Quantity::Speed, velocities[axis].map(|speed| sign * speed));
    // And for displacements of the striker and of one node.
    let region = |column: usize| table.titles[column].rsplit_once(':').map(|(region, _)| region.to_string());
    let striker: Vec<_> = ending(":V1").into_iter().map(region).collect();
    let way = ending(&format!(":U{}", axis + 1)).into_iter().find(|&column| !striker.contains(&region(column)));
    history.set(Quantity::Deflection, way.map(|column| table.curve(column).map(|way| sign * way)));
    let [internal, hourglass, contact] = [named(":ALLIE")?, named(":ALLAE")?, named(":ALLPW")?];
    history.split_kinetic(&named(MARK)?);
    history.set(Quantity::Internal, internal.with(&hourglass, |all, artificial| all - artificial));
    history.set(Quantity::Hourglass, hourglass);
    history.set(Quantity::Contact, contact.map(|work| -work));
    history.set(Quantity::Friction, named(":ALLFD")?);
    history.set(Quantity::Viscosity, named(":ALLVD").ok());
    // The latch of elements that are watched.
    let latches = table.find(|title| title.rsplit(':').next().is_some_and(|name| name.starts_with("SDV")));
    let failed = latches.into_iter().filter_map(|column| table.curve(column).first(|latch| latch >= 1.0));
    history.failed = failed.reduce(f64::min);
    history.set(Quantity::Total, named(":ETOTAL")?);
    Ok(history)
}
