//! A scene from its TOML file. The format is described in `docs/guides/fabric.md`.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use toml::Spanned;

use super::file::{CaseFile, Rim, SceneFile, Until};
use super::scene::{Case, Scene, Zones};
use crate::common::error::Error;
use crate::common::toml_file::{self, Source, same_files};
use crate::explicit::contact::{Rigid, Shape};
use crate::explicit::medium::Control;
use crate::explicit::mutual_contact::Parameters;
use crate::impact::scene::Precision;
use crate::material::file::MaterialFile;
use crate::material::model::Material;
use crate::material::of_law::{Choice, HYPERELASTIC, LINEAR_ELASTIC, LawName, own_yarn};
use crate::weave::reader::Woven;
use toron::host::units::UnitSystem;

/// Files for ParaView are numbered by four digits.
const MOST_FILES: i64 = 9999;
/// Samples of a history where the file does not say otherwise.
const SAMPLES: f64 = 400.0;
/// Friction of the sphere and of the yarns, where the file gives none: the thesis's.
const FRICTION: [f64; 2] = [0.23, 0.18];
/// Over a yarn's height: how near nodes are to faces that are looked at in every step, and how deep they may be.
const MARGIN: f64 = 0.8;
const DEEPEST: f64 = 0.5;

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
        let woven = Arc::new(source.woven(&file.weave, &units)?);
        let base = file.scene.get_ref();
        if let Some(weave) = &base.weave {
            return Err(source.error(weave.span(), "weave in [scene]; allowed: [weave], or in a [[case]]"));
        }
        if let Some(name) = &base.name {
            return Err(source.error(name.span(), "name in [scene]; allowed: in a [[case]]"));
        }
        let tables: Vec<CaseFile> = file.case.iter().map(|case| case.get_ref().over(base)).collect();
        let materials = std::iter::once(base).chain(&tables).flat_map(CaseFile::materials);
        let own_yarn = own_yarn(materials);
        let own_yarn = own_yarn.as_deref();
        let mut cases = Vec::new();
        if file.case.is_empty() {
            source.refuse_unused(base.unused(&[base]))?;
            let span = file.scene.span();
            let reader =
                Reader { source: &source, units: &units, woven: woven.clone(), file: base, own: base, own_yarn, span };
            cases.push(reader.case("scene".to_string())?);
        } else {
            source.refuse_unused(base.unused(&tables.iter().collect::<Vec<_>>()))?;
        }
        for (case, table) in file.case.iter().zip(&tables) {
            let (own, span) = (case.get_ref(), case.span());
            let taken = |text: &str| {
                text == "summary" || cases.iter().any(|other: &Case| same_files(&other.name, text, "-panel-"))
            };
            let name = source.name_of_case(own.name.as_ref(), span.clone(), taken)?;
            source.refuse_unused(own.unused(&[table]))?;
            let woven = match &own.weave {
                Some(weave) => Arc::new(source.woven_of_case(weave, file.weave.get_ref(), &units)?),
                None => woven.clone(),
            };
            let reader = Reader { source: &source, units: &units, woven, file: table, own, own_yarn, span };
            cases.push(reader.case(name)?);
        }
        Ok(Scene { title: file.title.unwrap_or_else(|| name.to_string()), units, cases })
    }
}

/// A case's table and what is needed to read it.
struct Reader<'a> {
    source: &'a Source<'a>,
    units: &'a UnitSystem,
    woven: Arc<Woven>,
    file: &'a CaseFile,
    /// The case's own table, without the scene's.
    own: &'a CaseFile,
    /// A yarn that some table of the scene names, other than the default ones.
    own_yarn: Option<&'a str>,
    /// The place that errors name for keys that are missing.
    span: Range<usize>,
}

impl Reader<'_> {
    fn positive(&self, key: &str, value: &Option<Spanned<f64>>) -> Result<f64, Error> {
        match value {
            Some(value) => self.source.positive(key, *value.get_ref(), value.span()),
            None => {
                let message = format!("{key} is missing; allowed: a finite number > 0");
                Err(self.source.error(self.span.clone(), &message))
            }
        }
    }

    fn case(&self, name: String) -> Result<Case, Error> {
        let file = self.file;
        let end = self.positive("end", &file.end)?;
        let sample = if file.sample.is_some() { self.positive("sample", &file.sample)? } else { end / SAMPLES };
        if let Some(given) = file.sample.as_ref().filter(|given| *given.get_ref() > end) {
            let message = format!("sample is {sample}; allowed: a number > 0, up to end = {end}");
            return Err(self.source.error(given.span(), &message));
        }
        let stiffness = self.positive("contact-stiffness", &file.contact_stiffness)?;
        let height = self.woven.geometry.weave.threads.iter().map(|thread| thread.height).fold(0.0, f64::max);
        let [friction, of_yarns] = FRICTION;
        let zones = self.zones()?;
        let speed = self.positive("speed", &file.speed)?;
        let place = file.speed.as_ref().map_or(self.span.clone(), Spanned::span);
        let speed = self.source.strike_speed(speed, place, zones.inner(), self.units)?;
        Ok(Case {
            woven: self.woven.clone(),
            zones,
            sphere: Rigid {
                shape: Shape::Sphere,
                radius: self.positive("radius", &file.radius)?,
                stiffness,
                friction: self.source.zero_or_more("friction", &file.friction, friction)?,
            },
            mass: self.positive("mass", &file.mass)?,
            speed,
            held: file.rim != Some(Rim::Free),
            mutual: Parameters {
                stiffness,
                friction: self.source.zero_or_more("yarn-friction", &file.yarn_friction, of_yarns)?,
                margin: MARGIN * height,
                deepest: DEEPEST * height,
            },
            control: Control { by_direction: true, ..self.source.control(&file.hourglass, &file.viscosity)? },
            end,
            rebounds: file.until == Some(Until::End),
            sample,
            pictures: self.source.pictures(&file.pictures, &name, end)?,
            frames: self.number("frames", &file.frames)?,
            checkpoints: self.number("checkpoints", &file.checkpoints)?,
            single_precision: file.precision == Some(Precision::F32),
            name,
        })
    }

    /// How many files a case writes on its way.
    fn number(&self, name: &str, given: &Option<Spanned<i64>>) -> Result<usize, Error> {
        let Some(given) = given else { return Ok(0) };
        let number = *given.get_ref();
        if !(0..=MOST_FILES).contains(&number) {
            let message = format!("{name} is {number}; allowed: a whole number from 0 to {MOST_FILES}");
            return Err(self.source.error(given.span(), &message));
        }
        Ok(number as usize)
    }

    fn zones(&self) -> Result<Zones, Error> {
        let file = self.file;
        let hyperelastic = || self.material(HYPERELASTIC, &file.hyperelastic);
        let linear = || self.material(LINEAR_ELASTIC, &file.linear_elastic);
        Ok(match file.law() {
            LawName::Hyperelastic => Zones::One(Box::new(hyperelastic()?)),
            LawName::LinearElastic => Zones::One(Box::new(linear()?)),
            LawName::Hybrid => {
                let radius = self.positive("hyperelastic-radius", &file.hyperelastic_radius)?;
                Zones::Two(Box::new([hyperelastic()?, linear()?]), radius)
            }
        })
    }

    /// The material of this law's table.
    fn material(&self, law: &'static str, table: &Option<Spanned<MaterialFile>>) -> Result<Material, Error> {
        let own = if law == HYPERELASTIC { &self.own.hyperelastic } else { &self.own.linear_elastic };
        let place = |name: &str| {
            let given = own.as_ref().and_then(|table| table.get_ref().given(name)).map(Spanned::span);
            given.or(self.own.failure.as_ref().map(Spanned::span))
        };
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
