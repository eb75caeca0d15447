//! The table: a line of CSV for every increment of a point.

use std::path::Path;

use nalgebra::Matrix3;

use super::Error;
use super::element::Hexahedron;
use super::material::{Law, Material};
use super::newton::{COMPONENT_NAMES, COMPONENTS};
use super::path::LoadPath;
use super::run::{History, Increment};
use super::unit_names::{ENERGY, FORCE, SPEED, TIME};
use toron::law::parameters::{Dimension, NUMBER, STRESS};
use toron::law::wave_speed::wave_speed;

/// The order of the six components of a symmetric tensor.
pub const SYMMETRIC_NAMES: [&str; 6] = ["11", "22", "33", "12", "23", "31"];

const MODES: [&str; 4] = ["el", "tc", "td", "ld"];

/// The columns that say where on the path the line stands; they are whole numbers.
const PLACE: [&str; 3] = ["step", "cycle", "increment"];

/// A column: what it holds and in what unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub name: String,
    pub dimension: Dimension,
}

/// The columns, less the three of the place on the path.
pub fn columns(material: &Material) -> Vec<Column> {
    let mut columns = Vec::new();
    let mut group = |prefix: &str, parts: &[&str], dimension: Dimension| {
        columns.extend(parts.iter().map(|part| Column { name: format!("{prefix}{part}"), dimension }));
    };
    group("", &["time"], TIME);
    group("F", &COMPONENT_NAMES, NUMBER);
    group("cauchy_", &SYMMETRIC_NAMES, STRESS);
    group("P", &COMPONENT_NAMES, STRESS);
    if let Law::Hyperelastic(_) = material.law {
        for mode in MODES {
            group(&format!("S_{mode}_"), &SYMMETRIC_NAMES, STRESS);
        }
    }
    for variable in material.state_table() {
        group("", &[variable.name], variable.dimension);
    }
    if let Law::LinearElastic { .. } = material.law {
        group("", &["failure_index"], NUMBER);
    }
    group("", &["fibre_stress"], STRESS);
    for face in ["x", "y", "z"] {
        group(&format!("force_{face}_"), &["x", "y", "z"], FORCE);
    }
    group("", &["external_work", "stored_energy"], ENERGY);
    if material.density.is_some() {
        group("", &["wave_speed"], SPEED);
    }
    columns
}

/// The values of an increment, in the order of [`columns`].
pub fn values(increment: &Increment, material: &Material, element: &Hexahedron) -> Vec<f64> {
    let answer = &increment.answer;
    let stress = increment.rotated_stress();
    let components = |matrix: &Matrix3<f64>| COMPONENTS.map(|component| matrix[component]);
    let mut values = vec![increment.time];
    values.extend(components(&increment.rotated_gradient()));
    values.extend(answer.cauchy);
    values.extend(components(&stress));
    if let Law::Hyperelastic(_) = material.law {
        values.extend(answer.modes.iter().flatten());
    }
    values.extend(&answer.memory.state[..material.state_table().len()]);
    if let Law::LinearElastic { .. } = material.law {
        values.push(material.failure_index(&answer.memory));
    }
    values.push(increment.fibre_stress);
    // One face after the other: the columns of the forces.
    values.extend(element.face_forces(&stress).iter());
    values.extend([increment.work, material.energy(&answer.memory) * element.volume()]);
    if let Some(density) = material.density {
        values.push(wave_speed(answer.wave_modulus, density));
    }
    values
}

/// Writes a point's history.
///
/// # Errors
/// The file cannot be written.
pub fn write(file: &Path, path: &LoadPath, history: &History) -> Result<(), Error> {
    let fault = |error: csv::Error| Error::Input(format!("{}: {error}", file.display()));
    let material = &history.point.material;
    let mut writer = csv::Writer::from_path(file).map_err(fault)?;
    writer
        .write_record(
            PLACE.map(String::from).into_iter().chain(columns(material).into_iter().map(|column| column.name)),
        )
        .map_err(fault)?;
    for increment in &history.increments {
        let step = &path.steps[increment.step];
        let place = if increment.number == 0 { [0; 3] } else { [step.number, step.cycle, increment.number] };
        writer.serialize((place, values(increment, material, &path.element))).map_err(fault)?;
    }
    writer.flush().map_err(|error| fault(error.into()))
}
