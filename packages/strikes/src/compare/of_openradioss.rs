//! OpenRadioss: the time history `NAMET01` as `th_to_csv` of OpenRadioss/Tools makes a CSV file of it.
//!
//! Global columns have names. Others have the title of their group, number and name of what they are of, and `var` with
//! a number: the variables of one thing stand side by side, in the order in which the deck asks for them.

use std::path::Path;

use super::history::{Curve, History, Quantity, direction};
use super::table::Table;
use toron_shared::error::Error;

/// What its first line has.
pub const START: &str = "\"time\",\"INTERNAL ENERGY\"";
/// Of a node: DX, DY, DZ, VX, VY, VZ. Of a contact: the impulses FNX, FNY, FNZ, FTX, FTY, FTZ.
const VARIABLES: usize = 6;

/// # Errors
/// A column is missing, or the striker does not move.
pub fn read(path: &Path, text: &str, name: String) -> Result<History, Error> {
    let table = Table::read(path, text)?;
    let of = |group: &str, name: Option<&str>| {
        table.find(|title| {
            let parts = title.rsplit_once(" var ").map(|(thing, _)| thing.trim());
            parts.is_some_and(|thing| {
                let in_group = thing.split("  ").next().is_some_and(|title| title.ends_with(group));
                in_group && name.is_none_or(|name| thing.rsplit(' ').next().is_some_and(|last| last.ends_with(name)))
            })
        })
    };
    let [striker, deflection] = ["striker", "deflection"].map(|name| of("striker", Some(name)));
    if striker.len() != VARIABLES {
        return Err(table.missing("of /TH/NODE with DX to VZ of the node \"striker\""));
    }
    let velocities = [3, 4, 5].map(|i| table.curve(striker[i]));
    let starts = [0, 1, 2].map(|i| velocities[i].values.first().copied().unwrap_or_default());
    let (axis, sign) = direction(starts).ok_or_else(|| table.missing("with a speed of the striker at the start"))?;
    let mut history = History::new("OpenRadioss", name);
    history.set(Quantity::Speed, velocities[axis].map(|speed| sign * speed));
    if deflection.len() == VARIABLES {
        history.set(Quantity::Deflection, table.curve(deflection[axis]).map(|way| sign * way));
    }
    let of_striker = of("contacts", Some("striker"));
    if of_striker.len() == VARIABLES {
        let impulse = table.curve(of_striker[axis]).with(&table.curve(of_striker[axis + 3]), |a, b| a + b);
        let slope = impulse.slope();
        history.set(Quantity::Force, slope.map(f64::abs));
    }
    let [internal, kinetic, hourglass, contact, friction, external] = [
        "INTERNAL ENERGY",
        "KINETIC ENERGY",
        "HOURGLASS ENERGY",
        "CONTACT ENERGY",
        "FRICTIONAL CONTACT ENERGY",
        "EXTERNAL WORK",
    ]
    .map(|title| table.column(title));
    let (internal, kinetic, hourglass, contact, friction, external) =
        (internal?, kinetic?, hourglass?, contact?, friction?, external?);
    history.split_kinetic(&kinetic);
    let sum = |a: &Curve, b: &Curve| a.with(b, |a, b| a + b);
    let total = sum(&sum(&sum(&internal, &kinetic), &hourglass), &contact).with(&external, |all, work| all - work);
    history.set(Quantity::Contact, contact.with(&friction, |all, friction| all - friction));
    history.set(Quantity::Internal, internal);
    history.set(Quantity::Hourglass, hourglass);
    history.set(Quantity::Friction, friction);
    // OFF of elements that are watched; others, at a clamp, take their energy out of the sum.
    let failed = of("watched", None).into_iter().filter_map(|column| table.curve(column).first(|off| off < 1.0));
    history.failed = failed.chain(total.first_fall()).reduce(f64::min);
    history.set(Quantity::Total, total);
    Ok(history)
}
