//! A load path from its TOML file, with errors that name file, line and what was expected. The format is described in
//! `docs/guides/load-paths.md`.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use nalgebra::{Unit, Vector3};
use serde::Deserialize;
use toml::de::DeValue;

use super::columns;
use super::element::Hexahedron;
use super::newton::COMPONENT_NAMES;
use super::path::{LoadPath, Point, Step, Target, equal_parts};
use crate::material::file::{self, MaterialFile, read_material};
use crate::material::laws::Laws;
use crate::units;
use toron::host::units::UnitSystem;
use toron_shared::checked::{Checked, Positive, value};
use toron_shared::error::Error;
use toron_shared::layers::{entries, layered};
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Numbers, Source};

/// Most increments that a path may have, all cycles counted: a point's history is kept in memory until it is written.
const MOST_INCREMENTS: usize = 1_000_000;

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct PathFile {
    /// Heading of summary and plot. Default: the file's name.
    title: Option<String>,
    /// Of all input and output: `si`, `mm-tonne-s`, `mm-kg-ms`, `cm-g-us`, `in-slinch-s`, or any length (m cm mm um in
    /// ft), mass (kg g mg t (tonne) slug slinch) and time (s ms us ns), joined by `-`.
    units: Spanned<String>,
    /// Edge lengths. Default: `[1, 1, 1]`.
    element: Option<Numbers<3, Positive>>,
    /// For a law of your own that reads it, and then needs it.
    temperature: Option<Spanned<f64>>,
    /// The [material](guides/load-paths.md#material) of the points.
    #[serde(rename = "material")]
    _material: Option<MaterialFile>,
    /// [Points](guides/load-paths.md#point) that run the path side by side. Default: one.
    #[serde(default)]
    point: Vec<Spanned<PointFile>>,
    /// The [steps](guides/load-paths.md#step) of the path.
    #[serde(default)]
    step: Vec<Spanned<StepFile>>,
    /// What is [plotted](guides/load-paths.md#plot).
    #[serde(default)]
    plot: PlotFile,
}

#[derive(Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct PlotFile {
    /// The column on the horizontal axis. Default: `time`.
    abscissa: Option<Spanned<String>>,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct PointFile {
    /// Of the point and its files.
    name: Spanned<String>,
    /// What completes or overrides `[material]`. A table with its own `preset` or `law` takes nothing from
    /// `[material]`.
    #[serde(rename = "material")]
    _material: Option<MaterialFile>,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct StepFile {
    /// For messages. Default: none.
    name: Option<String>,
    /// Equal parts of the step, each a line of the table. Default: 1.
    increments: Option<Spanned<usize>>,
    /// Time of the step, for a law of your own that reads it. Default: 1.
    duration: Option<Positive>,
    /// Components of F at the end of the step, by `11` … `33`; `"hold"` keeps the value.
    #[serde(default, rename = "F")]
    gradient: BTreeMap<Spanned<String>, Spanned<TargetFile>>,
    /// Components of P at the end of the step.
    #[serde(default, rename = "P")]
    stress: BTreeMap<Spanned<String>, Spanned<f64>>,
    /// Turns the element in space, on top of F, about an axis `[x, y, z]` by an angle in degrees. Default: none.
    rotation: Option<Spanned<RotationFile>>,
    /// Of a group: how often its steps are repeated.
    cycles: Option<Spanned<usize>>,
    /// Of a group: its steps, which may be groups again.
    #[serde(default)]
    step: Vec<Spanned<StepFile>>,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "expected a number or \"hold\"")]
enum TargetFile {
    Number(f64),
    Word(Word),
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
enum Word {
    Hold,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct RotationFile {
    /// Of any length.
    axis: Numbers<3>,
    /// In degrees.
    angle: f64,
}

impl LoadPath {
    /// Reads the file; its materials are of these laws.
    ///
    /// # Errors
    /// An input error that names file, line and what was expected.
    pub fn read(laws: Laws, path: &Path) -> Result<LoadPath, Error> {
        let (name, text) = toml_file::read(path)?;
        LoadPath::parse(laws, &name, &text)
    }

    /// The load path that `text` describes, with materials of these laws; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line and what was expected.
    pub fn parse(laws: Laws, name: &str, text: &str) -> Result<LoadPath, Error> {
        let source = Source { name, text };
        let file: PathFile = source.parse()?;
        let units = units::system(&source, &file.units)?;
        let mut points = points(&source, laws, &file, &units)?;
        set_temperature(&source, &file, &mut points)?;
        Ok(LoadPath {
            title: file.title.clone().unwrap_or_else(|| name.to_string()),
            element: element(&file.element),
            steps: steps(&source, &file.step, points.iter().any(takes_time))?,
            abscissa: abscissa(&source, &file.plot, &points)?,
            units,
            points,
        })
    }
}

/// Gives the points the temperature of the file.
///
/// # Errors
/// There is none, and a law reads it; or there is one that is no number, or that no law reads.
fn set_temperature(source: &Source<'_>, file: &PathFile, points: &mut [Point]) -> Result<(), Error> {
    let reads = |point: &Point| point.material.law.name().description().reads.temperature;
    let Some(temperature) = &file.temperature else {
        let Some(point) = points.iter().find(|point| reads(point)) else { return Ok(()) };
        let message = format!("temperature is missing; the law {} reads it", point.material.law_name());
        return Err(source.error(file.units.span(), &message));
    };
    let value = source.finite("temperature", *temperature.get_ref(), temperature.span())?;
    if !points.iter().any(reads) {
        return Err(source.error(temperature.span(), "temperature is read by none of the laws"));
    }
    for point in points {
        point.material.temperature = Some(value);
    }
    Ok(())
}

fn element(size: &Option<Numbers<3, Positive>>) -> Hexahedron {
    let edges = size.map_or([1.0; 3], |Numbers(edges)| edges.map(|edge| edge.value()));
    Hexahedron { size: Vector3::from(edges) }
}

fn abscissa(source: &Source<'_>, plot: &PlotFile, points: &[Point]) -> Result<String, Error> {
    let Some(abscissa) = &plot.abscissa else { return Ok("time".to_string()) };
    let name = abscissa.get_ref();
    for point in points {
        let columns: Vec<String> = columns::columns(&point.material).into_iter().map(|column| column.name).collect();
        if !columns.contains(name) {
            let message = format!("abscissa \"{name}\"; allowed: a column of the table: {}", columns.join(" "));
            return Err(source.error(abscissa.span(), &message));
        }
    }
    Ok(name.clone())
}

fn points(source: &Source<'_>, laws: Laws, file: &PathFile, units: &UnitSystem) -> Result<Vec<Point>, Error> {
    let tables = source.tables()?;
    let base = tables.get_ref().get("material");
    let read = |table: Option<toml::Spanned<DeValue>>, span| {
        let file = table.map_or(Ok(MaterialFile::default()), |table| source.read(&table))?;
        read_material(source, laws, &file, units, span)
    };
    if file.point.is_empty() {
        let material = read(base.cloned(), base.map_or(0..0, toml::Spanned::span))?;
        return Ok(vec![Point { name: material.label.clone(), material }]);
    }
    let mut points: Vec<Point> = Vec::new();
    for (point, table) in file.point.iter().zip(entries(tables.get_ref().get("point"))) {
        let name = &point.get_ref().name;
        let name = source.name_of("point", Some(name), name.span(), points.iter().map(|other| other.name.as_str()))?;
        let material = read(layered("material", [table.get_ref().get("material"), base], &file::DROPS), point.span())?;
        points.push(Point { name, material });
    }
    Ok(points)
}

/// Whether the law of a point does something while its deformation is held.
fn takes_time(point: &Point) -> bool {
    let reads = point.material.law.name().description().reads;
    reads.time_increment || reads.time
}

fn steps(source: &Source<'_>, file: &[Spanned<StepFile>], takes_time: bool) -> Result<Vec<Step>, Error> {
    if file.is_empty() {
        return Err(source.error(0..0, "no [[step]]: a load path needs one at least"));
    }
    let mut increments = 0usize;
    for step in file {
        increments = increments.saturating_add(step.get_ref().increments());
        if increments > MOST_INCREMENTS {
            let message = format!("more than {MOST_INCREMENTS} increments up to here, all cycles counted");
            return Err(source.error(step.span(), &message));
        }
    }
    let (mut steps, mut number) = (Vec::new(), 0);
    unroll(source, file, takes_time, 1, &mut number, &mut steps)?;
    Ok(steps)
}

/// Appends the steps of a list, groups unrolled; every repetition numbers its steps alike.
fn unroll(
    source: &Source<'_>,
    file: &[Spanned<StepFile>],
    takes_time: bool,
    cycle: usize,
    number: &mut usize,
    steps: &mut Vec<Step>,
) -> Result<(), Error> {
    for step in file {
        let (span, step) = (step.span(), step.get_ref());
        if step.step.is_empty() && step.cycles.is_none() {
            *number += 1;
            steps.push(read_step(source, step, takes_time, *number, cycle, span)?);
            continue;
        }
        let cycles = cycles(source, step, span)?;
        let first = *number;
        for cycle in 1..=cycles {
            *number = first;
            unroll(source, &step.step, takes_time, cycle, number, steps)?;
        }
    }
    Ok(())
}

/// How often a group repeats its steps; a group has nothing else of its own.
fn cycles(source: &Source<'_>, group: &StepFile, span: Range<usize>) -> Result<usize, Error> {
    let nothing_else = group.gradient.is_empty()
        && group.stress.is_empty()
        && group.increments.is_none()
        && group.duration.is_none()
        && group.rotation.is_none();
    match &group.cycles {
        Some(cycles) if *cycles.get_ref() > 0 && nothing_else && !group.step.is_empty() => Ok(*cycles.get_ref()),
        cycles => {
            let wanted = "cycles >= 1 and one [[step.step]] at least, and beside them a name";
            let span = cycles.as_ref().map_or(span, Spanned::span);
            Err(source.error(span, &format!("a group of steps is not complete; allowed: {wanted}")))
        }
    }
}

fn read_step(
    source: &Source<'_>,
    file: &StepFile,
    takes_time: bool,
    number: usize,
    cycle: usize,
    span: Range<usize>,
) -> Result<Step, Error> {
    let increments = match &file.increments {
        None => 1,
        Some(increments) if *increments.get_ref() > 0 => *increments.get_ref(),
        Some(increments) => return Err(source.error(increments.span(), "increments is 0; allowed: 1 or more")),
    };
    let duration = value(&file.duration).unwrap_or(1.0);
    let mut targets = [None; 9];
    for (name, target) in &file.gradient {
        let k = component(source, "F", name)?;
        targets[k] = Some(match target.get_ref() {
            TargetFile::Word(Word::Hold) => Target::Hold,
            TargetFile::Number(value) => {
                Target::Gradient(source.finite(&format!("F.{}", name.get_ref()), *value, target.span())?)
            }
        });
    }
    for (name, target) in &file.stress {
        let k = component(source, "P", name)?;
        if targets[k].is_some() {
            let message = format!("component {} is prescribed both in F and in P; allowed: one", name.get_ref());
            return Err(source.error(name.span(), &message));
        }
        let value = source.finite(&format!("P.{}", name.get_ref()), *target.get_ref(), target.span())?;
        targets[k] = Some(Target::Stress(value));
    }
    let rotation = file.rotation.as_ref().map(|rotation| read_rotation(source, rotation)).transpose()?;
    let holds = takes_time && file.duration.is_some();
    if rotation.is_none() && targets.iter().all(Option::is_none) && !holds {
        return Err(source.error(span, "the step does nothing; allowed: targets in F or P, or a rotation"));
    }
    let name = file.name.clone().unwrap_or_default();
    Ok(Step { name, number, cycle, duration, fractions: equal_parts(increments), targets, rotation })
}

fn component(source: &Source<'_>, of: &str, name: &Spanned<String>) -> Result<usize, Error> {
    COMPONENT_NAMES.iter().position(|known| known == name.get_ref()).ok_or_else(|| {
        let message = format!("component {of}.{}; allowed: {}", name.get_ref(), COMPONENT_NAMES.join(" "));
        source.error(name.span(), &message)
    })
}

fn read_rotation(source: &Source<'_>, file: &Spanned<RotationFile>) -> Result<(Unit<Vector3<f64>>, f64), Error> {
    let RotationFile { axis: Numbers(axis), angle } = file.get_ref();
    let angle = source.finite("the angle of a rotation", *angle, file.span())?;
    // An axis that overflows when it is squared is as useless as none.
    match Unit::try_new(Vector3::from(*axis), f64::MIN_POSITIVE) {
        Some(unit) if unit.iter().all(|x| x.is_finite()) => Ok((unit, angle.to_radians())),
        _ => {
            let message = format!("the axis of a rotation is {axis:?}; allowed: any vector but zero");
            Err(source.error(file.span(), &message))
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
