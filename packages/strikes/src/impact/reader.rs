//! A scene from its TOML file. The format is described in `docs/reference/impact-files.md`.

use std::path::Path;

use super::file::{MOST_ELEMENTS, SceneFile, SectionName, StrikerName, YarnKeys};
use super::scene::{Abscissa, Case, Outputs, Scene, Striker};
use crate::cases;
use crate::scene_keys::keys::{Precision, Reader, Table, read_cases};
use crate::scene_keys::shots::read_shots;
use crate::strength::scatter::Strength;
use toron_explicit_host::contact::{RigidSurface, Shape};
use toron_explicit_host::mesh::{Section, Yarn};
use toron_materials::material::laws::Laws;
use toron_materials::units;
use toron_shared::checked::{Checked, Whole, value};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Source};

/// The files that cases have in common, by their names without the ending.
const COMMON: [&str; 2] = ["summary", "residual-speed"];
/// Lengths closer than this part of themselves are the same.
const ROUNDING: f64 = 1e-9;
/// Samples of a history where the file does not say otherwise.
const SAMPLES: f64 = 600.0;

impl Scene {
    /// Reads the file.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn read(path: &Path) -> Result<Scene, Error> {
        Scene::read_with(Laws::Toron, path)
    }

    /// The same for a program with these laws.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn read_with(laws: Laws, path: &Path) -> Result<Scene, Error> {
        let (name, text) = toml_file::read(path)?;
        Scene::parse_with(laws, &name, &text)
    }

    /// The scene that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<Scene, Error> {
        Scene::parse_with(Laws::Toron, name, text)
    }

    /// The same for a program with these laws.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn parse_with(laws: Laws, name: &str, text: &str) -> Result<Scene, Error> {
        let source = Source { name, text };
        let tables = source.tables()?;
        cases::check::<Table<YarnKeys>>(&source, tables.get_ref())?;
        let file: SceneFile = source.parse()?;
        let units = units::system(&source, &file.units)?;
        let cases = read_cases((&source, laws, &units), tables.get_ref(), &[], &COMMON, |reader, case| {
            reader.yarn_case(&case.table.target, case.name.clone())
        })?;
        let inner = || cases.iter().map(|case| case.zones.inner());
        let shots = file.shots.as_ref().map(|shots| read_shots(&source, shots, &units, inner())).transpose()?;
        let abscissa = file.abscissa.map(|abscissa| abscissa_of(&source, &abscissa, &cases)).transpose()?;
        Ok(Scene { title: file.title.unwrap_or_else(|| name.to_string()), units, cases, shots, abscissa })
    }
}

/// A contact has its stiffness only where there is one.
fn abscissa_of(source: &Source<'_>, abscissa: &Spanned<Abscissa>, cases: &[Case]) -> Result<Abscissa, Error> {
    let driven = cases.iter().find(|case| case.striker == Striker::Driven);
    match (abscissa.get_ref(), driven) {
        (Abscissa::ContactStiffness, Some(case)) => {
            let message =
                format!("abscissa is contact-stiffness, but case \"{}\" is driven; allowed: elements", case.name);
            Err(source.error(abscissa.span(), &message))
        }
        (&abscissa, _) => Ok(abscissa),
    }
}

impl Reader<'_> {
    fn yarn_case(&self, file: &YarnKeys, name: String) -> Result<Case, Error> {
        let plan = self.plan(&name, SAMPLES)?;
        if plan.decides {
            let message = "until is \"decided\", which is for panels; allowed: stopped, end";
            return Err(self.source.error(self.span.clone(), message));
        }
        let yarn = self.yarn(file)?;
        let zones = self.zones(|| self.hyperelastic_length(file, &yarn))?;
        Ok(Case {
            strength: self.yarn_strength(&yarn)?,
            striker: self.striker(file)?,
            speed: self.speed(zones.inner())?,
            plan,
            name,
            control: self.control(),
            zones,
            yarn,
            single_precision: self.keys.precision == Some(Precision::F32),
            outputs: file.outputs.unwrap_or(Outputs::Full),
        })
    }

    fn yarn(&self, file: &YarnKeys) -> Result<Yarn, Error> {
        let section = match file.section {
            None | Some(SectionName::Ellipse) => Section::Ellipse,
            Some(SectionName::Rectangle) => Section::Rectangle,
        };
        let yarn = Yarn {
            section,
            length: self.needed("half-length", &file.half_length)?,
            height: self.needed("height", &file.height)?,
            width: self.needed("width", &file.width)?,
            layers: self.needed("layers", &file.layers)?,
            rows: self.needed("rows", &file.rows)?,
            columns: self.needed("columns", &file.columns)?,
        };
        // They meet between the tips of an ellipse.
        if let Some(one) = file.columns.as_ref().filter(|_| section == Section::Ellipse && yarn.columns == 1) {
            let message = format!("columns is 1; allowed: {}", Whole::<2, MOST_ELEMENTS>::allowed());
            return Err(self.source.error(one.span(), &message));
        }
        let elements = [yarn.layers, yarn.rows, yarn.columns].into_iter().fold(1, usize::saturating_mul);
        if elements > MOST_ELEMENTS {
            let message = format!("layers, rows and columns make {elements} elements; allowed: up to {MOST_ELEMENTS}");
            return Err(self.source.error(self.span.clone(), &message));
        }
        Ok(yarn)
    }

    /// The strength of the whole yarn, which is twice as long as what is modelled.
    fn yarn_strength(&self, yarn: &Yarn) -> Result<Option<Strength>, Error> {
        let Some(table) = self.strength_table() else { return Ok(None) };
        if let Some(family) = table.get_ref().families().into_iter().flatten().next() {
            let message = "warp or weft in the strength of one yarn; allowed: their keys in the table itself";
            return Err(self.source.error(family.span(), message));
        }
        self.strength(table, std::iter::once(2.0 * yarn.length)).map(Some)
    }

    fn striker(&self, file: &YarnKeys) -> Result<Striker, Error> {
        let keys = self.keys;
        if file.striker() == StrikerName::Driven {
            return Ok(Striker::Driven);
        }
        let cylinder = RigidSurface {
            shape: Shape::Cylinder,
            radius: self.needed("radius", &keys.radius)?,
            stiffness: self.needed("contact-stiffness", &keys.contact_stiffness)?,
            friction: value(&keys.friction).unwrap_or(0.0),
            aim: [0.0; 2],
        };
        let held = file.held.as_ref().is_some_and(|held| *held.get_ref());
        let mass = if held && keys.mass.is_none() { 0.0 } else { self.needed("mass", &keys.mass)? };
        Ok(Striker::Cylinder { cylinder, mass, held })
    }

    fn hyperelastic_length(&self, file: &YarnKeys, yarn: &Yarn) -> Result<f64, Error> {
        let (key, value) = ("hyperelastic-length", &file.hyperelastic_length);
        let length = self.needed(key, value)?;
        let layer = yarn.length / yarn.layers as f64;
        if length < layer * (1.0 - ROUNDING) || length > yarn.length * (1.0 + ROUNDING) {
            let span = value.as_ref().map_or(self.span.clone(), Spanned::span);
            let message = format!("{key} is {length}; allowed: from a layer, {layer}, to half-length, {}", yarn.length);
            return Err(self.source.error(span, &message));
        }
        Ok(length)
    }
}
