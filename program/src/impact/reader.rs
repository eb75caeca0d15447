//! A scene from its TOML file. The format is described in `docs/guides/impact.md`.

use std::ops::Range;
use std::path::Path;

use toml::Spanned;

use super::file::{CaseFile, SceneFile, SectionName, StrikerName};
use super::scene::{Abscissa, Case, Outputs, Precision, Scene, Striker, Zones};
use crate::common::error::Error;
use crate::common::toml_file::{self, Source, same_files};
use crate::explicit::contact::{Rigid, Shape};
use crate::explicit::mesh::{Section, Yarn};
use crate::material::file::MaterialFile;
use crate::material::model::Material;
use crate::material::of_law::{Choice, HYPERELASTIC, LINEAR_ELASTIC, LawName, own_yarn};
use toron::host::units::UnitSystem;

/// An element takes some 700 bytes: more do not fit most memories.
const MOST_ELEMENTS: usize = 10_000_000;
/// Files for ParaView are numbered by four digits.
const MOST_FRAMES: usize = 9999;
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
        let (name, text) = toml_file::read(path)?;
        Scene::parse(&name, &text)
    }

    /// The scene that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn parse(name: &str, text: &str) -> Result<Scene, Error> {
        let source = Source { name, text };
        let file: SceneFile = source.parse()?;
        let units = source.units(&file.units)?;
        let base = file.scene.get_ref();
        if let Some(name) = &base.name {
            return Err(source.error(name.span(), "name in [scene]; allowed: in a [[case]]"));
        }
        let tables: Vec<CaseFile> = file.case.iter().map(|case| case.get_ref().over(base)).collect();
        let materials = std::iter::once(base).chain(&tables).flat_map(CaseFile::materials);
        let own_yarn = own_yarn(materials);
        let own_yarn = own_yarn.as_deref();
        let mut cases: Vec<Case> = Vec::new();
        if file.case.is_empty() {
            source.refuse_unused(base.unused(&[base]))?;
            let span = file.scene.span();
            let reader = Reader { source: &source, units: &units, file: base, own: base, own_yarn, span };
            cases.push(reader.case("scene".to_string())?);
        } else {
            source.refuse_unused(base.unused(&tables.iter().collect::<Vec<_>>()))?;
        }
        for (case, table) in file.case.iter().zip(&tables) {
            let taken = |text: &str| {
                SUMMARIES.contains(&text) || cases.iter().any(|other| same_files(&other.name, text, "-yarn-"))
            };
            let name = source.name_of_case(case.get_ref().name.as_ref(), case.span(), taken)?;
            source.refuse_unused(case.get_ref().unused(&[table]))?;
            let (own, span) = (case.get_ref(), case.span());
            let reader = Reader { source: &source, units: &units, file: table, own, own_yarn, span };
            cases.push(reader.case(name)?);
        }
        let abscissa = file.abscissa.map(|abscissa| source.abscissa_of(&abscissa, &cases)).transpose()?;
        Ok(Scene { title: file.title.unwrap_or_else(|| name.to_string()), units, cases, abscissa })
    }
}

impl Source<'_> {
    /// A contact has its stiffness only where there is one.
    fn abscissa_of(&self, abscissa: &Spanned<Abscissa>, cases: &[Case]) -> Result<Abscissa, Error> {
        let driven = cases.iter().find(|case| case.striker == Striker::Driven);
        match (abscissa.get_ref(), driven) {
            (Abscissa::ContactStiffness, Some(case)) => {
                let message =
                    format!("abscissa is contact-stiffness, but case \"{}\" is driven; allowed: elements", case.name);
                Err(self.error(abscissa.span(), &message))
            }
            (&abscissa, _) => Ok(abscissa),
        }
    }
}

/// Names of the files that the cases have in common.
const SUMMARIES: [&str; 2] = ["summary", "residual-speed"];

/// A case's table and what is needed to read it.
struct Reader<'a> {
    source: &'a Source<'a>,
    units: &'a UnitSystem,
    file: &'a CaseFile,
    /// The case's own table, without the scene's.
    own: &'a CaseFile,
    /// A yarn that some table of the scene names, other than the default ones.
    own_yarn: Option<&'a str>,
    /// The place that errors name for keys that are missing.
    span: Range<usize>,
}

impl Reader<'_> {
    fn missing(&self, key: &str, allowed: &str) -> Error {
        self.source.error(self.span.clone(), &format!("{key} is missing; allowed: {allowed}"))
    }

    fn positive(&self, key: &str, value: &Option<Spanned<f64>>) -> Result<f64, Error> {
        match value {
            Some(value) => self.source.positive(key, *value.get_ref(), value.span()),
            None => Err(self.missing(key, "a finite number > 0")),
        }
    }

    /// A whole number from `least` to `most`, or the default.
    fn count(
        &self,
        key: &str,
        value: &Option<Spanned<i64>>,
        range: [usize; 2],
        default: Option<usize>,
    ) -> Result<usize, Error> {
        let [least, most] = range;
        let allowed = format!("a whole number from {least} to {most}");
        let Some(count) = value else { return default.ok_or_else(|| self.missing(key, &allowed)) };
        match usize::try_from(*count.get_ref()) {
            Ok(number) if (least..=most).contains(&number) => Ok(number),
            _ => Err(self.source.error(count.span(), &format!("{key} is {}; allowed: {allowed}", count.get_ref()))),
        }
    }

    fn case(&self, name: String) -> Result<Case, Error> {
        let file = self.file;
        let end = self.positive("end", &file.end)?;
        let sample = match &file.sample {
            Some(_) => self.positive("sample", &file.sample)?,
            None => end / SAMPLES,
        };
        if let Some(given) = file.sample.as_ref().filter(|given| *given.get_ref() > end) {
            let message = format!("sample is {sample}; allowed: a number > 0, up to end = {end}");
            return Err(self.source.error(given.span(), &message));
        }
        let yarn = self.yarn()?;
        let zones = self.zones(&yarn)?;
        let speed = self.positive("speed", &file.speed)?;
        let place = file.speed.as_ref().map_or(self.span.clone(), Spanned::span);
        let speed = self.source.strike_speed(speed, place, zones.inner(), self.units)?;
        Ok(Case {
            striker: self.striker()?,
            speed,
            end,
            sample,
            pictures: self.source.pictures(&file.pictures, &name, end)?,
            name,
            frames: self.count("frames", &file.frames, [0, MOST_FRAMES], Some(0))?,
            control: self.source.control(&file.hourglass, &file.viscosity)?,
            zones,
            yarn,
            precision: file.precision.unwrap_or(Precision::F64),
            outputs: file.outputs.unwrap_or(Outputs::Full),
        })
    }

    fn yarn(&self) -> Result<Yarn, Error> {
        let file = self.file;
        let section = match file.section {
            None | Some(SectionName::Ellipse) => Section::Ellipse,
            Some(SectionName::Rectangle) => Section::Rectangle,
        };
        let yarn = Yarn {
            section,
            length: self.positive("half-length", &file.half_length)?,
            height: self.positive("height", &file.height)?,
            width: self.positive("width", &file.width)?,
            layers: self.count("layers", &file.layers, [1, MOST_ELEMENTS], None)?,
            rows: self.count("rows", &file.rows, [1, MOST_ELEMENTS], None)?,
            // An ellipse needs two: they meet between its tips.
            columns: self.count(
                "columns",
                &file.columns,
                [if section == Section::Ellipse { 2 } else { 1 }, MOST_ELEMENTS],
                None,
            )?,
        };
        let elements = [yarn.layers, yarn.rows, yarn.columns].into_iter().fold(1, usize::saturating_mul);
        if elements > MOST_ELEMENTS {
            let message = format!("layers, rows and columns make {elements} elements; allowed: up to {MOST_ELEMENTS}");
            return Err(self.source.error(self.span.clone(), &message));
        }
        Ok(yarn)
    }

    fn striker(&self) -> Result<Striker, Error> {
        let file = self.file;
        if file.striker() == StrikerName::Driven {
            return Ok(Striker::Driven);
        }
        let cylinder = Rigid {
            shape: Shape::Cylinder,
            radius: self.positive("radius", &file.radius)?,
            stiffness: self.positive("contact-stiffness", &file.contact_stiffness)?,
            friction: self.source.zero_or_more("friction", &file.friction, 0.0)?,
        };
        let held = file.held.as_ref().is_some_and(|held| *held.get_ref());
        let mass = if held && file.mass.is_none() { 0.0 } else { self.positive("mass", &file.mass)? };
        Ok(Striker::Cylinder { cylinder, mass, held })
    }

    fn zones(&self, yarn: &Yarn) -> Result<Zones, Error> {
        let file = self.file;
        let hyperelastic = || self.material(HYPERELASTIC, &file.hyperelastic);
        let linear = || self.material(LINEAR_ELASTIC, &file.linear_elastic);
        Ok(match file.law() {
            LawName::Hyperelastic => Zones::One(Box::new(hyperelastic()?)),
            LawName::LinearElastic => Zones::One(Box::new(linear()?)),
            LawName::Hybrid => Zones::Two(Box::new([hyperelastic()?, linear()?]), self.hyperelastic_length(yarn)?),
        })
    }

    fn hyperelastic_length(&self, yarn: &Yarn) -> Result<f64, Error> {
        let (key, value) = ("hyperelastic-length", &self.file.hyperelastic_length);
        let length = self.positive(key, value)?;
        let layer = yarn.length / yarn.layers as f64;
        if length < layer * (1.0 - ROUNDING) || length > yarn.length * (1.0 + ROUNDING) {
            let span = value.as_ref().map_or(self.span.clone(), Spanned::span);
            let message = format!("{key} is {length}; allowed: from a layer, {layer}, to half-length, {}", yarn.length);
            return Err(self.source.error(span, &message));
        }
        Ok(length)
    }

    /// The material of this law's table.
    fn material(&self, law: &'static str, table: &Option<Spanned<MaterialFile>>) -> Result<Material, Error> {
        // A property of the scene is wrong only beside the failure of a case: that is the line to change.
        let place = |name: &str| self.own.given(law, name).or(self.own.failure.as_ref().map(Spanned::span));
        let choice = Choice {
            law,
            failure: self.file.failure(),
            own_yarn: self.own_yarn,
            place: &place,
            span: self.span.clone(),
        };
        self.source.material_of_law(&choice, table, self.units)
    }
}
