//! `toron params`: the tables of properties and state variables, the presets, and the values of one preset.

use std::path::Path;

use clap::Args;

use crate::material::laws::{LawName, Laws};
use crate::material::model::Law;
use crate::material::preset::Preset;
use crate::units::{unit, with_unit};
use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension, Property};
use toron::law::state::StateVariable;
use toron::{Criterion, Rotation};
use toron_c::TORON_ABI_VERSION;
use toron_shared::build;
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::short_number::short;
use toron_shared::text_table::plain_table;

/// The text of `toron --version`.
pub fn version() -> String {
    format!("{} (ABI {TORON_ABI_VERSION}, build {:08x})", env!("CARGO_PKG_VERSION"), build::number())
}

#[derive(Args)]
pub struct Arguments {
    /// Unit system, for instance mm-tonne-s; without it, si, or the units of the preset's file.
    #[arg(long)]
    units: Option<String>,
    /// Print the values of this preset alone: a name, or a file of your own, as my-yarn.toml.
    #[arg(long)]
    preset: Option<String>,
}

/// Prints the tables of these laws; or, given a preset by name or file, its values.
///
/// # Errors
/// An unknown preset or unit system; a file of a preset that is wrong, or lacks a property.
pub fn print_tables(laws: Laws, Arguments { units, preset }: &Arguments) -> Result<(), Error> {
    let units = units.as_deref().map(unit_system).transpose()?;
    let text = match preset {
        None => tables(laws, &units.unwrap_or(UnitSystem::SI))?,
        Some(name) => {
            let preset =
                Preset::find(laws, name, Path::new(""), |message| Error::Input(format!("--preset: {message}")))?;
            values(laws, &preset, &units.unwrap_or(preset.units))?
        }
    };
    print(&text);
    Ok(())
}

fn unit_system(name: &str) -> Result<UnitSystem, Error> {
    UnitSystem::parse(name).ok_or_else(|| Error::Input(format!("--units {name}; allowed: {}", UnitSystem::ALLOWED)))
}

/// The laws' properties and state variables, and the presets.
///
/// # Errors
/// A preset that lacks a property.
pub fn tables(laws: Laws, units: &UnitSystem) -> Result<String, Error> {
    let mut text = String::new();
    for law in laws.names() {
        let (name, description) = (heading(law), law.description());
        text += &format!("{name}: properties\n{}\n", property_table(description.properties, units));
        text += &format!("{name}: state variables, all 0 at the start\n{}\n", state_table(description.state, units));
    }
    for preset in laws.presets().iter().map(Preset::from) {
        text += &format!("{}\n", preset_text(&preset, units)?);
    }
    Ok(text)
}

/// What the tables of a law are headed by: its title, with a capital.
fn heading(law: LawName) -> String {
    if law == LawName::LinearElastic {
        return "Linear elastic orthotropic law".to_string();
    }
    let mut title = law.description().title.chars();
    title.next().into_iter().flat_map(char::to_uppercase).chain(title).collect()
}

/// One preset, and what makes a card of it.
fn values(laws: Laws, preset: &Preset, units: &UnitSystem) -> Result<String, Error> {
    let values = preset.complete(units)?;
    Law::new(preset.law, &values, Rotation::Fibre, Criterion::LargestPrincipal)
        .map_err(|error| preset.law_error(&error))?;
    let name = preset.file().unwrap_or(&preset.name);
    let (program, units_name) = (laws.program(), units.names().join("-"));
    let deck = format!("{program} deck --host HOST --preset {name} --units {units_name}");
    Ok(format!("{}\nAs a card for a solver: {deck}\n", preset_text(preset, units)?))
}

fn preset_text(preset: &Preset, units: &UnitSystem) -> Result<String, Error> {
    let (values, density) = (preset.complete(units)?, preset.density_in(units));
    let table = preset_table(preset.law.table(), &values, density, units);
    let guesses = preset.guesses.text(preset.law).map_or(String::new(), |guesses| format!("Guesses: {guesses}\n"));
    Ok(format!("Preset {} ({})\n{}\n{guesses}{table}", preset.name, preset.law.text(), preset.source))
}

fn property_table(properties: &[Property], units: &UnitSystem) -> String {
    let rows = properties.iter().enumerate().map(|(i, property)| {
        let bound = match (property.minimum.is_finite(), property.minimum_excluded) {
            (false, _) => "any".to_string(),
            (true, true) => format!("> {}, to {:?}", property.minimum, property.maximum),
            // In words where the bound itself is excluded: `0 to below 1`.
            (true, false) => match property.allowed.strip_prefix("a number from ") {
                Some(range) => range.to_string(),
                None => format!("{} to {:?}", property.minimum, property.maximum),
            },
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
    with_unit(units, &short(value, 12), dimension)
}

/// Left-aligned columns, two blanks apart.
fn align<const N: usize>(head: [&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    let rows: Vec<Vec<String>> = rows.map(Vec::from).collect();
    plain_table(&head, &rows, || aligned(&head, &rows))
}

fn aligned<const N: usize>(head: &[&str; N], rows: &[Vec<String>]) -> String {
    let head = head.map(str::to_string).to_vec();
    let rows: Vec<&Vec<String>> = std::iter::once(&head).chain(rows).collect();
    let widths: [usize; N] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    let mut text = String::new();
    for row in rows {
        let cells: Vec<String> = row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        text += &format!("  {}\n", cells.join("  ").trim_end());
    }
    text
}
