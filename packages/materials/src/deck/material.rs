//! The material of a card: values in the deck's units, and the comments that all cards have.

use std::ops::Range;

use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, Dimension, NUMBER, Property, STRESS};
use toron::law::state::StateVariable;
use toron::{Criterion, Rotation};

use super::interface::Interface;
use crate::material::fibre_wave::FibreWave;
use crate::material::laws::LawName;
use crate::material::model::{self, Law};
use crate::material::preset::{Guesses, Preset};
use crate::units::unit;
use toron_shared::error::Error;

/// The columns of a number in cards that have room enough: twelve digits.
pub const WIDE: usize = 19;

/// A material that its law accepts.
pub struct Material {
    /// Letters, digits and - _ . only.
    pub name: String,
    /// The preset's file, or its name, for messages.
    place: String,
    /// Where the values come from, on one line.
    source: String,
    guesses: Guesses,
    units: UnitSystem,
    pub law: LawName,
    bulk_and_shear: [f64; 2],
    /// In the order of the law's table.
    pub values: Vec<f64>,
    density: Option<f64>,
    /// Of the linear elastic law: what its axes follow, and by what it fails.
    pub frame: Rotation,
    pub criterion: Criterion,
}

impl Material {
    /// # Errors
    /// A property that is missing, or values that the law refuses.
    pub fn new(preset: &Preset, units: &UnitSystem, fibre: Option<[f64; 3]>) -> Result<Material, Error> {
        let mut values = preset.complete(units)?;
        for (i, component) in preset.law.description().fibre_components().zip(fibre.into_iter().flatten()) {
            values[i] = component;
        }
        let law = Law::new(preset.law, &values, Rotation::Fibre, Criterion::LargestPrincipal);
        let prepared = law.map_err(|error| match error {
            toron::Error::Direction { .. } if fibre.is_some() => Error::Input(format!("--fibre: {error}")),
            error => preset.law_error(&error),
        })?;
        let (name, source, guesses) = (preset.name.clone(), preset.source.clone(), preset.guesses.clone());
        let place = preset.file().unwrap_or(&name).to_string();
        let (law, density) = (preset.law, preset.density_in(units));
        let bulk_and_shear = prepared.bulk_and_shear();
        let (frame, criterion) = (Rotation::Fibre, Criterion::LargestPrincipal);
        let units = *units;
        Ok(Material { name, place, source, guesses, units, law, bulk_and_shear, values, density, frame, criterion })
    }

    /// A scene's material, whose values are in the units `from`.
    ///
    /// # Errors
    /// The law refuses the values in the deck's units.
    pub fn of_scene(material: &model::Material, from: &UnitSystem, units: &UnitSystem) -> Result<Material, Error> {
        let convert = |value: f64, dimension| from.scale(dimension).convert(value, &units.scale(dimension));
        let table = material.table();
        let values: Vec<f64> =
            material.values().iter().zip(table).map(|(&value, row)| convert(value, row.dimension)).collect();
        let law = material.law.with(&values).map_err(|error| Error::Input(format!("{}: {error}", material.name())))?;
        let (frame, criterion) = match law {
            Law::LinearElastic { frame, criterion, .. } => (frame, criterion),
            Law::Hyperelastic { .. } | Law::Own(_) => (Rotation::Fibre, Criterion::LargestPrincipal),
        };
        let source = match (material.origin.source.as_str(), material.own.as_str()) {
            ("", _) => material.name(),
            (source, "") => source.to_string(),
            (source, own) => format!("{source}; {own}"),
        };
        Ok(Material {
            name: material.label.clone(),
            place: material.label.clone(),
            source,
            guesses: material.origin.guesses.clone(),
            units: *units,
            law: law.name(),
            bulk_and_shear: law.bulk_and_shear(),
            values,
            density: material.density.map(|density| convert(density, DENSITY)),
            frame,
            criterion,
        })
    }

    pub fn interface(&self) -> Interface {
        Interface::of(self.law)
    }

    pub fn table(&self) -> &'static [Property] {
        self.law.table()
    }

    pub fn state_table(&self) -> &'static [StateVariable] {
        self.law.description().state
    }

    /// The density, which the hosts with a mass of their own need.
    ///
    /// # Errors
    /// The material has none.
    pub fn density(&self) -> Result<f64, Error> {
        let message = "density is missing, which this host needs; allowed: a finite number > 0";
        self.density.ok_or_else(|| Error::Input(format!("{}: {message}", self.place)))
    }

    /// The density, for the hosts that need it in some analyses only.
    pub fn density_if_any(&self) -> Option<f64> {
        self.density
    }

    /// Whether frame and criterion are those of hosts whose cards have no options for them.
    pub fn has_default_options(&self) -> bool {
        self.frame == Rotation::Fibre && self.criterion == Criterion::LargestPrincipal
    }

    /// Bulk and shear modulus whose wave, K + 4G/3, is that along the fibre or a faster one.
    pub fn bulk_and_shear(&self) -> [f64; 2] {
        self.bulk_and_shear
    }

    /// A warning where no fibre has such a wave along it: a density or a stiffness is in other units.
    pub fn unit_warning(&self) -> Option<String> {
        let stiffness = self.values.first().copied()?;
        FibreWave::along(self.law, stiffness, self.density?, &self.units)?.unit_warning(&self.units)
    }

    /// Where the fibre's three components are among the values.
    pub fn fibre(&self) -> Range<usize> {
        self.law.description().fibre_components()
    }

    /// What the card is, where its values come from, which of them are guesses, and their units.
    pub fn comments(&self) -> Vec<String> {
        let stresses = self.table().iter().filter(|property| property.dimension == STRESS);
        let names: Vec<&str> = stresses.map(|property| property.name).collect();
        let [length, mass, time] = self.units.names().map(ascii);
        let (title, stress, density) = (self.law.description().title, self.unit(STRESS), self.unit(DENSITY));
        let guesses =
            self.guesses.text(self.law).map(|guesses| format!("guesses, not measured on this yarn: {guesses}"));
        let source = [format!("{}: {}", self.name, self.source)].into_iter().chain(guesses);
        let of_units = [
            format!("toron, {title}, in {length}, {mass}, {time}"),
            format!("{} in {stress}, density in {density}, all others are numbers", names.join(", ")),
        ];
        source.map(|text| ascii(&text)).chain(of_units).collect()
    }

    /// The unit of a value, in ASCII; empty for a number.
    pub fn unit(&self, dimension: Dimension) -> String {
        if dimension == NUMBER { String::new() } else { ascii(&unit(&self.units, dimension)) }
    }
}

/// Solvers read bytes: units without signs of their own.
fn ascii(unit: &str) -> String {
    unit.replace('²', "^2").replace('³', "^3").replace('µ', "u")
}
