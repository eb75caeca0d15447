//! The table: a line of CSV for every increment of a point.

use std::path::Path;

use nalgebra::Matrix3;

use super::columns::columns;
use super::element::Hexahedron;
use super::newton::COMPONENTS;
use super::path::LoadPath;
use super::run::{History, Increment};
use crate::material::model::{Law, Material};
use toron::law::wave_speed::wave_speed;
use toron_shared::error::Error;

/// The columns that say where on the path the line stands; they are whole numbers.
const PLACE: [&str; 3] = ["step", "cycle", "increment"];

/// The values of an increment, in the order of [`columns`].
pub fn values(increment: &Increment, material: &Material, element: &Hexahedron) -> Vec<f64> {
    let answer = &increment.answer;
    let stress = increment.rotated_stress();
    let components = |matrix: &Matrix3<f64>| COMPONENTS.map(|component| matrix[component]);
    let mut values = vec![increment.time];
    values.extend(components(&increment.rotated_gradient()));
    values.extend(answer.cauchy);
    values.extend(components(&stress));
    if let Law::Hyperelastic { .. } = material.law {
        values.extend(answer.modes.iter().flatten());
    }
    values.extend(&answer.memory.state);
    if let Law::LinearElastic { .. } = material.law {
        values.extend(material.failure_index(&answer.memory));
    }
    if material.has_fibre() {
        values.push(increment.fibre_stress);
    }
    // One face after the other: the columns of the forces.
    values.extend(element.face_forces(&stress).iter());
    values.push(increment.work);
    if material.has_energy() {
        values.push(material.energy(&answer.memory) * element.volume());
    }
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
    let file_error = |error: csv::Error| Error::Input(format!("{}: {error}", file.display()));
    let material = &history.point.material;
    let mut writer = csv::Writer::from_path(file).map_err(file_error)?;
    writer
        .write_record(
            PLACE.map(String::from).into_iter().chain(columns(material).into_iter().map(|column| column.name)),
        )
        .map_err(file_error)?;
    for increment in &history.increments {
        let step = &path.steps[increment.step];
        let place = if increment.number == 0 { [0; 3] } else { [step.number, step.cycle, increment.number] };
        writer.serialize((place, values(increment, material, &path.element))).map_err(file_error)?;
    }
    writer.flush().map_err(|error| file_error(error.into()))
}
