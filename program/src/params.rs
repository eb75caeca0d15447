//! `toron params`: the tables of properties and state variables, the presets, and a preset as a deck.

use std::fmt::Write;
use std::path::Path;

use crate::common::console::print;
use crate::common::error::Error;
use crate::common::units::unit;
use crate::material::model::deletion_variable;
use crate::material::preset::{LawName, Preset};
use toron::host::c::TORON_ABI_VERSION;
use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension, HYPERELASTIC, LINEAR_ELASTIC, NUMBER, PRESETS, Property};
use toron::law::state::{self, StateVariable};
use toron::{Hyperelastic, LinearElastic};

/// The text of `toron --version`.
pub fn version() -> String {
    format!("{} (ABI {TORON_ABI_VERSION})", env!("CARGO_PKG_VERSION"))
}

/// Prints the tables; or, given a preset by name or file, its values for the decks of both hosts.
///
/// # Errors
/// An unknown preset or unit system; a file of a preset that is wrong, or not enough for a deck.
pub fn print_tables(units: Option<&str>, preset: Option<&str>) -> Result<(), Error> {
    let units = units.map(unit_system).transpose()?;
    let text = match preset {
        None => tables(&units.unwrap_or(UnitSystem::SI))?,
        Some(name) => {
            let preset = Preset::find(name, Path::new(""), |message| Error::Input(format!("--preset: {message}")))?;
            deck(&preset, &units.unwrap_or(preset.units))?
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
        let (values, density) = (preset.complete(units)?, preset.density_in(units));
        let table = preset_table(preset.law.table(), &values, density, units);
        text += &format!("Preset {}\n{}\n{table}\n", preset.name, preset.source);
    }
    Ok(text)
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

/// A preset as cards of LS-DYNA and lines of Abaqus.
fn deck(preset: &Preset, units: &UnitSystem) -> Result<String, Error> {
    let values = preset.complete(units)?;
    let density = preset.density_in(units);
    let [length, mass, time] = units.names();
    let heading = format!("{}, in {length}, {mass}, {time}", preset.source);
    if preset.law == LawName::LinearElastic {
        // The linear law goes into a host by the C interface, not by a deck: the same card would run the other law.
        LinearElastic::new(&values).map_err(|error| preset.law_error(&error))?;
        return Ok(format!("{heading}\n{}", preset_table(preset.law.table(), &values, density, units)));
    }
    let law = Hyperelastic::new(&values).map_err(|error| preset.law_error(&error))?;
    let density =
        density.ok_or_else(|| preset.error("density is missing, which a deck needs; allowed: a finite number > 0"))?;
    let cards = ls_dyna(&preset.name, &heading, density, &values, law.bulk_and_shear());
    Ok(format!("{cards}\n{}", abaqus(&preset.name, &heading, density, &values)))
}

/// `*MAT_USER_DEFINED_MATERIAL_MODELS`: the properties as P1…, then the bulk and the shear modulus.
fn ls_dyna(name: &str, heading: &str, density: f64, values: &[f64], moduli: [f64; 2]) -> String {
    let constants: Vec<f64> = values.iter().copied().chain(moduli).collect();
    let (count, bulk, shear) = (constants.len(), values.len() + 1, values.len() + 2);
    let history = deletion_variable(&HYPERELASTIC) + 1;
    let field = |text: &dyn std::fmt::Display| format!("{text:>10}");
    let card = |fields: &[String]| fields.iter().map(|text| field(text)).collect::<String>();
    let head = |names: &str| {
        let names: String = names.split(' ').map(|name| field(&name)).collect();
        format!("$#{}", &names[2..])
    };
    let text = |value: usize| value.to_string();
    let mut deck = format!("*MAT_USER_DEFINED_MATERIAL_MODELS_TITLE\n{name}\n$ {heading}\n");
    let first = ["1".to_string(), field_of_ten(density), "41".to_string(), text(count), text(history)];
    let last = ["0".to_string(), text(bulk), text(shear)];
    deck += &format!("{}\n{}\n", head("mid ro mt lmc nhv iortho ibulk ig"), card(&[&first[..], &last[..]].concat()));
    let options = ["0", "1", "0", "1", "0", "0"].map(str::to_string);
    deck += &format!("{}\n{}\n", head("ivect ifail itherm ihyper ieos lmca"), card(&options));
    let names: Vec<&str> = HYPERELASTIC.iter().map(|property| property.name).chain(["bulk", "shear"]).collect();
    for (names, constants) in names.chunks(8).zip(constants.chunks(8)) {
        let fields: Vec<String> = constants.iter().map(|&value| field_of_ten(value)).collect();
        deck += &format!("{}\n{}\n", head(&names.join(" ")), card(&fields));
    }
    deck
}

/// `*MATERIAL` with `*USER MATERIAL` and `*DEPVAR`, the state variables named.
fn abaqus(name: &str, heading: &str, density: f64, values: &[f64]) -> String {
    let mut deck =
        format!("*MATERIAL, NAME={}\n** {heading}\n*DENSITY\n{},\n", name.to_uppercase(), short(density, 20));
    let _ = writeln!(deck, "*USER MATERIAL, CONSTANTS={}", values.len());
    for line in values.chunks(8) {
        let fields: Vec<String> = line.iter().map(|&value| short(value, 20)).collect();
        let _ = writeln!(deck, "{}", fields.join(", "));
    }
    let variables = &state::HYPERELASTIC;
    let _ = writeln!(deck, "*DEPVAR, DELETE={}\n{},", deletion_variable(&HYPERELASTIC) + 1, variables.len());
    for (i, variable) in variables.iter().enumerate() {
        let _ = writeln!(deck, "{}, {}, \"{}\"", i + 1, variable.name.to_uppercase(), variable.meaning);
    }
    deck
}

/// A number for a field of ten columns: with a blank before it where that costs no digit.
fn field_of_ten(value: f64) -> String {
    let spaced = short(value, 9);
    let exact = spaced.parse().is_ok_and(|x: f64| (x - value).abs() <= 1e-12 * value.abs());
    if exact { spaced } else { short(value, 10) }
}

/// The shortest number that says the value to twelve digits; where `width` characters do not hold it, the nearest one that
/// they do.
fn short(value: f64, width: usize) -> String {
    let fixed = (1..17).map(|decimals| format!("{value:.decimals$}"));
    let scientific = (0..17).map(|digits| format!("{value:.digits$e}"));
    let error = |text: &String| text.parse().map_or(f64::INFINITY, |x: f64| (x - value).abs());
    let fits = fixed.chain(scientific).filter(|text| text.len() <= width);
    // Among those that are near enough the shortest counts, fixed before scientific.
    let rank = |text: &String| (error(text).max(1e-12 * value.abs()), text.len());
    let best = fits.min_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal));
    best.unwrap_or_else(|| value.to_string())
}
