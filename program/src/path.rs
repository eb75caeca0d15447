//! A load path from its TOML file, with errors that name file, line and what was expected. The format is described in
//! `docs/load-paths.md`.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::path::Path;

use nalgebra::{Unit, Vector3};
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use super::element::Hexahedron;
use super::material::{Law, Material};
use super::newton::COMPONENT_NAMES;
use super::{Error, file_error, table};
use toron::host::units::UnitSystem;
use toron::law::parameters::{self, DENSITY, FIBRE, LINEAR_FIBRE, Preset, Property};
use toron::{Criterion, Rotation};

/// Most increments that a path may have, all cycles counted: a point's history is kept in memory until it is written.
const MOST_INCREMENTS: usize = 1_000_000;

/// What runs: an element, the materials it is tried with, and its steps.
#[derive(Clone, Debug)]
pub struct LoadPath {
    pub title: String,
    pub units: UnitSystem,
    pub element: Hexahedron,
    /// One history each.
    pub points: Vec<Point>,
    /// In the order in which they run, cycles unrolled.
    pub steps: Vec<Step>,
    /// The column of the table that plots are drawn over.
    pub abscissa: String,
}

/// A variant of the path: its own material.
#[derive(Clone, Debug)]
pub struct Point {
    pub name: String,
    pub material: Material,
}

/// A step: targets that are reached by a ramp.
#[derive(Clone, Debug)]
pub struct Step {
    /// Empty where the file gives none.
    pub name: String,
    /// The step's place in the file, and which repetition of its group this is, both from 1.
    pub number: usize,
    pub cycle: usize,
    pub duration: f64,
    pub increments: usize,
    /// In the order of [`COMPONENT_NAMES`]; `None` is controlled as before.
    pub targets: [Option<Target>; 9],
    /// Axis and angle (radians) of the rotation that the step adds on top.
    pub rotation: Option<(Unit<Vector3<f64>>, f64)>,
}

/// Where a component goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Component of F at the end of the step.
    Gradient(f64),
    /// Component of the first Piola–Kirchhoff stress at the end of the step.
    Stress(f64),
    /// The component of F stays as the step finds it.
    Hold,
}

/// A list of so many numbers. The parser would pass over what comes after them.
#[derive(Clone, Copy)]
pub(super) struct Numbers<const N: usize>(pub [f64; N]);

impl<'de, const N: usize> Deserialize<'de> for Numbers<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list = Vec::<f64>::deserialize(deserializer)?;
        let wanted = format!("an array of length {N}");
        let numbers = list.as_slice().try_into().map_err(|_| D::Error::invalid_length(list.len(), &wanted.as_str()))?;
        Ok(Numbers(numbers))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PathFile {
    title: Option<String>,
    units: Spanned<String>,
    element: Option<Spanned<Numbers<3>>>,
    material: Option<Spanned<MaterialFile>>,
    #[serde(default)]
    point: Vec<Spanned<PointFile>>,
    #[serde(default)]
    step: Vec<Spanned<StepFile>>,
    #[serde(default)]
    plot: PlotFile,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlotFile {
    abscissa: Option<Spanned<String>>,
}

/// A table that describes a material.
#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialFile {
    preset: Option<Spanned<String>>,
    law: Option<Spanned<LawName>>,
    fibre: Option<Spanned<Numbers<3>>>,
    density: Option<Spanned<f64>>,
    frame: Option<Spanned<FrameName>>,
    criterion: Option<Spanned<CriterionName>>,
    #[serde(default)]
    properties: BTreeMap<Spanned<String>, Spanned<f64>>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum LawName {
    Hyperelastic,
    LinearElastic,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum FrameName {
    Fibre,
    Polar,
    Spin,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum CriterionName {
    LargestPrincipal,
    FibreStress,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PointFile {
    name: String,
    #[serde(default)]
    material: MaterialFile,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StepFile {
    name: Option<String>,
    increments: Option<Spanned<usize>>,
    duration: Option<Spanned<f64>>,
    #[serde(default, rename = "F")]
    gradient: BTreeMap<Spanned<String>, Spanned<TargetFile>>,
    #[serde(default, rename = "P")]
    stress: BTreeMap<Spanned<String>, Spanned<f64>>,
    rotation: Option<Spanned<RotationFile>>,
    cycles: Option<Spanned<usize>>,
    #[serde(default)]
    step: Vec<Spanned<StepFile>>,
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number or \"hold\"")]
enum TargetFile {
    Number(f64),
    Word(Word),
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Word {
    Hold,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RotationFile {
    axis: Numbers<3>,
    /// Degrees.
    angle: f64,
}

impl LoadPath {
    /// Reads the file.
    ///
    /// # Errors
    /// An input error that names file, line and what was expected.
    pub fn read(path: &Path) -> Result<LoadPath, Error> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| Error::Input(format!("{name}: {error}")))?;
        LoadPath::parse(&name, &text)
    }

    /// The load path that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line and what was expected.
    pub fn parse(name: &str, text: &str) -> Result<LoadPath, Error> {
        let source = Source { name, text };
        let file: PathFile = source.parse()?;
        let units = source.units(&file.units)?;
        let points = source.points(&file, &units)?;
        Ok(LoadPath {
            title: file.title.clone().unwrap_or_else(|| name.to_string()),
            element: source.element(file.element.as_ref())?,
            steps: source.steps(&file.step)?,
            abscissa: source.abscissa(&file.plot, &points)?,
            units,
            points,
        })
    }

    /// Number of increments of all points.
    pub fn increments(&self) -> usize {
        self.points.len() * self.steps.iter().map(|step| step.increments).sum::<usize>()
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "step {}", self.number)?;
        if !self.name.is_empty() {
            write!(f, " ({})", self.name)?;
        }
        if self.cycle > 1 {
            write!(f, ", cycle {}", self.cycle)?;
        }
        Ok(())
    }
}

/// The text and its name, for messages.
pub(super) struct Source<'a> {
    pub name: &'a str,
    pub text: &'a str,
}

impl Source<'_> {
    /// The file's tables.
    pub fn parse<F: DeserializeOwned>(&self) -> Result<F, Error> {
        let fault =
            |error: toml::de::Error| self.error(error.span().unwrap_or(0..0), &file_error::message(self.text, &error));
        toml::from_str(self.text).map_err(fault)
    }

    pub fn units(&self, name: &Spanned<String>) -> Result<UnitSystem, Error> {
        UnitSystem::parse(name.get_ref()).ok_or_else(|| {
            let message = format!("unit system \"{}\"; allowed: {}", name.get_ref(), UnitSystem::ALLOWED);
            self.error(name.span(), &message)
        })
    }

    pub fn error(&self, span: Range<usize>, message: &str) -> Error {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        Error::Input(format!("{}:{line}: {message}", self.name))
    }

    /// The number, where it is finite and above 0.
    pub fn positive(&self, what: &str, value: f64, span: Range<usize>) -> Result<f64, Error> {
        if value.is_finite() && value > 0.0 {
            return Ok(value);
        }
        Err(self.error(span, &format!("{what} is {value}; allowed: a finite number > 0")))
    }

    pub fn finite(&self, what: &str, value: f64, span: Range<usize>) -> Result<f64, Error> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.error(span, &format!("{what} is {value}; allowed: a finite number")))
    }

    fn element(&self, size: Option<&Spanned<Numbers<3>>>) -> Result<Hexahedron, Error> {
        let Some(size) = size else { return Ok(Hexahedron { size: Vector3::repeat(1.0) }) };
        for length in size.get_ref().0 {
            self.positive("an edge of the element", length, size.span())?;
        }
        Ok(Hexahedron { size: Vector3::from(size.get_ref().0) })
    }

    fn abscissa(&self, plot: &PlotFile, points: &[Point]) -> Result<String, Error> {
        let Some(abscissa) = &plot.abscissa else { return Ok("time".to_string()) };
        let name = abscissa.get_ref();
        for point in points {
            let columns: Vec<String> = table::columns(&point.material).into_iter().map(|column| column.name).collect();
            if !columns.contains(name) {
                let message = format!("abscissa \"{name}\"; allowed: a column of the table: {}", columns.join(" "));
                return Err(self.error(abscissa.span(), &message));
            }
        }
        Ok(name.clone())
    }

    fn points(&self, file: &PathFile, units: &UnitSystem) -> Result<Vec<Point>, Error> {
        let (base, span) = match &file.material {
            Some(material) => (material.get_ref().clone(), material.span()),
            None => (MaterialFile::default(), 0..0),
        };
        if file.point.is_empty() {
            let material = self.material(&base, units, span)?;
            return Ok(vec![Point { name: material.label.clone(), material }]);
        }
        let mut points: Vec<Point> = Vec::new();
        for point in &file.point {
            let (name, span) = (&point.get_ref().name, point.span());
            let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
            if name.is_empty() || !name.chars().all(plain) || points.iter().any(|other| other.name == *name) {
                let wanted = "a name of its own out of letters, digits and - _ ., since files are named by it";
                return Err(self.error(span, &format!("point \"{name}\"; allowed: {wanted}")));
            }
            let material = self.material(&point.get_ref().material.over(&base), units, span)?;
            points.push(Point { name: name.clone(), material });
        }
        Ok(points)
    }

    /// The material of a table; `span` is what to blame for what is missing from it.
    pub fn material(&self, file: &MaterialFile, units: &UnitSystem, span: Range<usize>) -> Result<Material, Error> {
        let preset = file.preset.as_ref().map(|name| self.preset(name)).transpose()?;
        let table = self.property_table(file, preset, span.clone())?;
        let (values, spans) = self.values(file, preset, table, units, &span)?;
        let frame = match file.frame.as_ref().map(|name| *name.get_ref()) {
            None | Some(FrameName::Fibre) => Rotation::Fibre,
            Some(FrameName::Polar) => Rotation::Polar,
            Some(FrameName::Spin) => Rotation::Spin,
        };
        let criterion = match file.criterion.as_ref().map(|name| *name.get_ref()) {
            None | Some(CriterionName::LargestPrincipal) => Criterion::LargestPrincipal,
            Some(CriterionName::FibreStress) => Criterion::FibreStress,
        };
        let law = Law::new(table, &values, frame, criterion).map_err(|error| {
            let index = match error {
                toron::Error::Property { index, .. } | toron::Error::Direction { index, .. } => index,
                _ => 0,
            };
            self.error(spans[index].clone(), &error.to_string())
        })?;
        if let (Law::Hyperelastic(_), Some(option)) =
            (&law, file.frame.as_ref().map(Spanned::span).or(file.criterion.as_ref().map(Spanned::span)))
        {
            return Err(self.error(option, "frame and criterion are options of the linear elastic law"));
        }
        let density = match &file.density {
            Some(density) => Some(self.positive("density", *density.get_ref(), density.span())?),
            None => preset.map(|preset| units.from_si(preset.density, DENSITY)),
        };
        let label = preset.map_or(if table.len() == 11 { "hyperelastic" } else { "linear-elastic" }, |p| p.name);
        Ok(Material { law, values, density, label: label.to_string() })
    }

    fn preset(&self, name: &Spanned<String>) -> Result<&'static Preset, Error> {
        parameters::preset(name.get_ref()).ok_or_else(|| {
            let known: Vec<&str> = parameters::PRESETS.iter().map(|preset| preset.name).collect();
            let message = format!("preset \"{}\"; allowed: {}", name.get_ref(), known.join(", "));
            self.error(name.span(), &message)
        })
    }

    /// The table of the law that is named or that the preset belongs to.
    fn property_table(
        &self,
        file: &MaterialFile,
        preset: Option<&Preset>,
        span: Range<usize>,
    ) -> Result<&'static [Property], Error> {
        let named: Option<&'static [Property]> = file.law.as_ref().map(|law| match law.get_ref() {
            LawName::Hyperelastic => &parameters::HYPERELASTIC[..],
            LawName::LinearElastic => &parameters::LINEAR_ELASTIC[..],
        });
        match (named, preset) {
            (Some(table), Some(preset)) if !std::ptr::eq(table, preset.table) => {
                let span = file.law.as_ref().map_or(span, Spanned::span);
                Err(self.error(span, &format!("preset \"{}\" belongs to the other law", preset.name)))
            }
            (Some(table), _) => Ok(table),
            (None, Some(preset)) => Ok(preset.table),
            (None, None) => Err(self.error(span, "the material needs a preset, or a law and its properties")),
        }
    }

    /// The values of all properties, and for each what to blame: preset or default, then fibre, then properties.
    fn values(
        &self,
        file: &MaterialFile,
        preset: Option<&Preset>,
        table: &'static [Property],
        units: &UnitSystem,
        span: &Range<usize>,
    ) -> Result<(Vec<f64>, Vec<Range<usize>>), Error> {
        let mut values: Vec<Option<f64>> = table.iter().map(|property| property.default).collect();
        let mut spans = vec![file.preset.as_ref().map_or(span.clone(), Spanned::span); table.len()];
        if let Some(preset) = preset {
            for (value, (property, &si)) in values.iter_mut().zip(table.iter().zip(preset.values)) {
                *value = Some(units.from_si(si, property.dimension));
            }
        }
        if let Some(fibre) = &file.fibre {
            let first = if std::ptr::eq(table, &parameters::HYPERELASTIC[..]) { FIBRE } else { LINEAR_FIBRE };
            for (i, &component) in fibre.get_ref().0.iter().enumerate() {
                values[first + i] = Some(component);
                spans[first + i] = fibre.span();
            }
        }
        for (name, value) in &file.properties {
            let Some(index) = table.iter().position(|property| property.name == name.get_ref()) else {
                let known: Vec<&str> = table.iter().map(|property| property.name).collect();
                let message = format!("property \"{}\"; allowed: {}", name.get_ref(), known.join(" "));
                return Err(self.error(name.span(), &message));
            };
            values[index] = Some(*value.get_ref());
            spans[index] = value.span();
        }
        let complete = values.iter().zip(table).map(|(value, property)| {
            value.ok_or_else(|| {
                let message = format!(
                    "property {} ({}) is missing; allowed: {}",
                    property.name, property.meaning, property.allowed
                );
                self.error(span.clone(), &message)
            })
        });
        Ok((complete.collect::<Result<_, _>>()?, spans))
    }

    fn steps(&self, file: &[Spanned<StepFile>]) -> Result<Vec<Step>, Error> {
        if file.is_empty() {
            return Err(self.error(0..0, "no [[step]]: a load path needs one at least"));
        }
        let mut increments = 0usize;
        for step in file {
            increments = increments.saturating_add(step.get_ref().increments());
            if increments > MOST_INCREMENTS {
                let message = format!("more than {MOST_INCREMENTS} increments up to here, all cycles counted");
                return Err(self.error(step.span(), &message));
            }
        }
        let (mut steps, mut number) = (Vec::new(), 0);
        self.unroll(file, 1, &mut number, &mut steps)?;
        Ok(steps)
    }

    /// Appends the steps of a list, groups unrolled; every repetition numbers its steps alike.
    fn unroll(
        &self,
        file: &[Spanned<StepFile>],
        cycle: usize,
        number: &mut usize,
        steps: &mut Vec<Step>,
    ) -> Result<(), Error> {
        for step in file {
            let (span, step) = (step.span(), step.get_ref());
            if step.step.is_empty() && step.cycles.is_none() {
                *number += 1;
                steps.push(self.step(step, *number, cycle, span)?);
                continue;
            }
            let cycles = self.cycles(step, span)?;
            let first = *number;
            for cycle in 1..=cycles {
                *number = first;
                self.unroll(&step.step, cycle, number, steps)?;
            }
        }
        Ok(())
    }

    /// How often a group repeats its steps; a group has nothing else of its own.
    fn cycles(&self, group: &StepFile, span: Range<usize>) -> Result<usize, Error> {
        let alone = group.gradient.is_empty()
            && group.stress.is_empty()
            && group.increments.is_none()
            && group.duration.is_none()
            && group.rotation.is_none();
        match &group.cycles {
            Some(cycles) if *cycles.get_ref() > 0 && alone && !group.step.is_empty() => Ok(*cycles.get_ref()),
            cycles => {
                let wanted = "cycles >= 1 and one [[step.step]] at least, and beside them a name";
                let span = cycles.as_ref().map_or(span, Spanned::span);
                Err(self.error(span, &format!("a group of steps is not complete; allowed: {wanted}")))
            }
        }
    }

    fn step(&self, file: &StepFile, number: usize, cycle: usize, span: Range<usize>) -> Result<Step, Error> {
        let increments = match &file.increments {
            None => 1,
            Some(increments) if *increments.get_ref() > 0 => *increments.get_ref(),
            Some(increments) => return Err(self.error(increments.span(), "increments is 0; allowed: 1 or more")),
        };
        let duration = match &file.duration {
            None => 1.0,
            Some(duration) => self.positive("duration", *duration.get_ref(), duration.span())?,
        };
        let mut targets = [None; 9];
        for (name, target) in &file.gradient {
            let k = self.component("F", name)?;
            targets[k] = Some(match target.get_ref() {
                TargetFile::Word(Word::Hold) => Target::Hold,
                TargetFile::Number(value) => {
                    Target::Gradient(self.finite(&format!("F.{}", name.get_ref()), *value, target.span())?)
                }
            });
        }
        for (name, target) in &file.stress {
            let k = self.component("P", name)?;
            if targets[k].is_some() {
                let message = format!("component {} is prescribed both in F and in P; allowed: one", name.get_ref());
                return Err(self.error(name.span(), &message));
            }
            let value = self.finite(&format!("P.{}", name.get_ref()), *target.get_ref(), target.span())?;
            targets[k] = Some(Target::Stress(value));
        }
        let rotation = file.rotation.as_ref().map(|rotation| self.rotation(rotation)).transpose()?;
        if rotation.is_none() && targets.iter().all(Option::is_none) {
            return Err(self.error(span, "the step does nothing; allowed: targets in F or P, or a rotation"));
        }
        let name = file.name.clone().unwrap_or_default();
        Ok(Step { name, number, cycle, duration, increments, targets, rotation })
    }

    fn component(&self, of: &str, name: &Spanned<String>) -> Result<usize, Error> {
        COMPONENT_NAMES.iter().position(|known| known == name.get_ref()).ok_or_else(|| {
            let message = format!("component {of}.{}; allowed: {}", name.get_ref(), COMPONENT_NAMES.join(" "));
            self.error(name.span(), &message)
        })
    }

    fn rotation(&self, file: &Spanned<RotationFile>) -> Result<(Unit<Vector3<f64>>, f64), Error> {
        let RotationFile { axis: Numbers(axis), angle } = file.get_ref();
        let angle = self.finite("the angle of a rotation", *angle, file.span())?;
        // An axis that overflows when it is squared is as useless as none.
        match Unit::try_new(Vector3::from(*axis), f64::MIN_POSITIVE) {
            Some(unit) if unit.iter().all(|x| x.is_finite()) => Ok((unit, angle.to_radians())),
            _ => {
                let message = format!("the axis of a rotation is {axis:?}; allowed: any vector but zero");
                Err(self.error(file.span(), &message))
            }
        }
    }
}

impl StepFile {
    /// Number of increments, all cycles of all groups counted.
    fn increments(&self) -> usize {
        let own = self.increments.as_ref().map_or(1, |increments| *increments.get_ref());
        let inner = self.step.iter().map(|step| step.get_ref().increments()).fold(0, usize::saturating_add);
        let cycles = self.cycles.as_ref().map_or(1, |cycles| *cycles.get_ref());
        if self.step.is_empty() { own } else { inner.saturating_mul(cycles) }
    }
}

impl MaterialFile {
    /// A property that the file itself gives.
    pub fn given(&self, name: &str) -> Option<&Spanned<f64>> {
        self.properties.iter().find(|(key, _)| key.get_ref() == name).map(|(_, value)| value)
    }

    /// The table that names a preset and nothing else.
    pub fn of_preset(name: &str, span: Range<usize>) -> MaterialFile {
        MaterialFile { preset: Some(Spanned::new(span, name.to_string())), ..MaterialFile::default() }
    }

    /// This table completed by `base`; one that names its own preset or law starts afresh.
    pub fn over(&self, base: &MaterialFile) -> MaterialFile {
        if self.preset.is_some() || self.law.is_some() {
            return self.clone();
        }
        let mut merged = base.clone();
        merged.fibre = self.fibre.clone().or(merged.fibre);
        merged.density = self.density.clone().or(merged.density);
        merged.frame = self.frame.clone().or(merged.frame);
        merged.criterion = self.criterion.clone().or(merged.criterion);
        merged.properties.extend(self.properties.clone());
        merged
    }
}
