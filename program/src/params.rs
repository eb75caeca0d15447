//! `toron params`: the tables of properties and state variables, the presets, and the values of one preset.

use std::path::Path;

use crate::common::console::print;
use crate::common::error::Error;
use crate::common::short_number::short;
use crate::common::units::unit;
use crate::material::model::Law;
use crate::material::preset::Preset;
use toron::host::c::TORON_ABI_VERSION;
use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension, HYPERELASTIC, LINEAR_ELASTIC, NUMBER, PRESETS, Property};
use toron::law::state::{self, StateVariable};
use toron::{Criterion, Rotation};

/// The text of `toron --version`.
pub fn version() -> String {
    format!("{} (ABI {TORON_ABI_VERSION})", env!("CARGO_PKG_VERSION"))
}

/// Prints the tables; or, given a preset by name or file, its values.
///
/// # Errors
/// An unknown preset or unit system; a file of a preset that is wrong, or lacks a property.
pub fn print_tables(units: Option<&str>, preset: Option<&str>) -> Result<(), Error> {
    let units = units.map(unit_system).transpose()?;
    let text = match preset {
        None => tables(&units.unwrap_or(UnitSystem::SI))?,
        Some(name) => {
            let preset = Preset::find(name, Path::new(""), |message| Error::Input(format!("--preset: {message}")))?;
            values(&preset, &units.unwrap_or(preset.units))?
        }
    };
    print(&text);
    Ok(())
}

fn unit_system(name: &str) -> Result<UnitSystem, Error> {
    UnitSystem::parse(name).ok_or_else(|| Error::Input(format!("--units {name}; allowed: {}", UnitSystem::ALLOWED)))
}

/// Both laws' properties and state variables, and the presets.
fn tables(units: &UnitSystem) -> Result<String, Error> {
    let mut text = String::new();
    let laws: [(&str, &[Property], &[StateVariable]); 2] = [
        ("Hyperelastic yarn law", &HYPERELASTIC, &state::HYPERELASTIC),
        ("Linear elastic orthotropic law", &LINEAR_ELASTIC, &state::LINEAR_ELASTIC),
    ];
    for (name, properties, variables) in laws {
        text += &format!("{name}: properties\n{}\n", property_table(properties, units));
        text += &format!("{name}: state variables, all 0 at the start\n{}\n", state_table(variables, units));
    }
    for preset in PRESETS.iter().map(Preset::from) {
        text += &format!("{}\n", preset_text(&preset, units)?);
    }
    Ok(text)
}

/// One preset, and what makes a card of it.
fn values(preset: &Preset, units: &UnitSystem) -> Result<String, Error> {
    let values = preset.complete(units)?;
    Law::new(preset.law, &values, Rotation::Fibre, Criterion::LargestPrincipal)
        .map_err(|error| preset.law_error(&error))?;
    let name = preset.file().unwrap_or(&preset.name);
    let deck = format!("toron deck --host HOST --preset {name} --units {}", units.names().join("-"));
    Ok(format!("{}\nAs a card for a solver: {deck}\n", preset_text(preset, units)?))
}

fn preset_text(preset: &Preset, units: &UnitSystem) -> Result<String, Error> {
    let (values, density) = (preset.complete(units)?, preset.density_in(units));
    let table = preset_table(preset.law.table(), &values, density, units);
    Ok(format!("Preset {} ({})\n{}\n{table}", preset.name, preset.law.text(), preset.source))
}

fn property_table(properties: &[Property], units: &UnitSystem) -> String {
    let rows = properties.iter().enumerate().map(|(i, property)| {
        let bound = match (property.minimum.is_finite(), property.minimum_excluded) {
            (false, _) => "any".to_string(),
            (true, true) => format!("> {}, to {:?}", property.minimum, property.maximum),
            (true, false) => format!("{} to {:?}", property.minimum, property.maximum),
        };
        let default = property.default.map_or("-".to_string(), |value| value.to_string());
        let unit = unit(units, property.dimension);
        [(i + 1).to_string(), property.name.to_string(), unit, default, bound, property.meaning.to_string()]
    });
    align(["no", "name", "unit", "default", "allowed", "meaning"], rows)
}

fn state_table(variables: &[StateVariable], units: &UnitSystem) -> String {
    let rows = variables.iter().enumerate().map(|(i, variable)| {
        let unit = unit(units, variable.dimension);
        [(i + 1).to_string(), variable.name.to_string(), unit, variable.meaning.to_string()]
    });
    align(["no", "name", "unit", "meaning"], rows)
}

/// The values and the density, which are in these units.
fn preset_table(table: &[Property], values: &[f64], density: Option<f64>, units: &UnitSystem) -> String {
    let row = |name: &str, value, dimension| [name.to_string(), quantity(units, value, dimension)];
    let rows = table.iter().zip(values).map(|(property, &value)| row(property.name, value, property.dimension));
    align(["name", "value"], rows.chain(density.map(|density| row("density", density, DENSITY))))
}

fn quantity(units: &UnitSystem, value: f64, dimension: Dimension) -> String {
    let value = short(value, 12);
    if dimension == NUMBER { value } else { format!("{value} {}", unit(units, dimension)) }
}

/// Left-aligned columns, two blanks apart.
fn align<const N: usize>(head: [&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    let rows: Vec<[String; N]> = [head.map(str::to_string)].into_iter().chain(rows).collect();
    let widths: [usize; N] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    let mut text = String::new();
    for row in &rows {
        let cells: Vec<String> = row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        text += &format!("  {}\n", cells.join("  ").trim_end());
    }
    text
}
