//! The columns of a point's table: their names and units.

use super::newton::COMPONENT_NAMES;
use crate::material::model::{Law, Material};
use crate::units::{ENERGY, FORCE, SPEED, TIME};
use toron::law::parameters::{Dimension, NUMBER, STRESS};

/// The order of the six components of a symmetric tensor.
pub const SYMMETRIC_NAMES: [&str; 6] = ["11", "22", "33", "12", "23", "31"];

const MODES: [&str; 4] = ["el", "tc", "td", "ld"];

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
    if let Law::Hyperelastic { .. } = material.law {
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
    if material.has_fibre() {
        group("", &["fibre_stress"], STRESS);
    }
    for face in ["x", "y", "z"] {
        group(&format!("force_{face}_"), &["x", "y", "z"], FORCE);
    }
    group("", &["external_work"], ENERGY);
    if material.has_energy() {
        group("", &["stored_energy"], ENERGY);
    }
    if material.density.is_some() {
        group("", &["wave_speed"], SPEED);
    }
    columns
}
