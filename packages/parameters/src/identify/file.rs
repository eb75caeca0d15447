//! A fit from its TOML file: the yarn, what is known of its fibre, and the data sets. `docs/reference/fit-files.md`
//! has the keys.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::data::{DataSet, Loading};
use super::data_sheet::{DataSheet, DataSheetFile};
use super::equivalence::{Constant, Fibre};
use super::fit::{Fit, Problem};
use super::friction::{self, C, Friction, MU, Sliding};
use super::parameter::{ALL, PARAMETERS, Parameter, Values};
use super::profile;
use super::reader::{Reader, plain_name};
use super::sliding_data;
use super::strength::file::SetFile;
use toron::host::units::UnitSystem;
use toron::law::parameters::HYPERELASTIC;
use toron_materials::material::laws::{LawName, Laws};
use toron_materials::material::of_law::FRICTIONAL;
use toron_materials::material::preset::{LONGEST_NAME, Preset};
use toron_materials::units;
use toron_shared::checked::{Checked, Fraction, Positive, value};
use toron_shared::error::Error;
use toron_shared::nearest;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{self, Numbers, Source};

/// Two densities of a yarn are the same within this, which is more than rounding and less than a slip.
const SAME_DENSITY: f64 = 0.005;

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct FitFile {
    /// Heading of summary and plot. Default: the yarn's name.
    pub title: Option<String>,
    /// Of all numbers in this file and of the preset, such as `mm-tonne-s`; [others](guides/load-paths.md#at-the-top).
    pub units: Spanned<String>,
    /// How [intervals](reference/fit-files.md#intervals) are found; `linearised` is faster. Default: `profile`.
    #[serde(default)]
    intervals: Intervals,
    /// The [yarn](reference/fit-files.md#yarn).
    #[serde(default)]
    yarn: YarnFile,
    /// The [fibre](reference/fit-files.md#fibre), for k_el by energetic equivalence and ε_lim.
    fibre: Option<Spanned<FibreFile>>,
    /// The fibre's [data sheet](reference/fit-files.md#data_sheet), in place of `[fibre]`.
    data_sheet: Option<Spanned<DataSheetFile>>,
    /// [Data](reference/fit-files.md#data).
    #[serde(default)]
    data: Vec<Spanned<DataFile>>,
    /// [Strengths](reference/fit-files.md#strength), in a file of their own with `title` and `units`.
    #[serde(default)]
    pub strength: Vec<Spanned<SetFile>>,
}

impl FitFile {
    /// Whether anything in it is of the law's properties.
    pub fn has_properties(&self) -> bool {
        self.intervals != Intervals::default()
            || self.yarn != YarnFile::default()
            || self.fibre.is_some()
            || self.data_sheet.is_some()
            || !self.data.is_empty()
    }
}

/// How the intervals of the law's properties are found.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Intervals {
    #[default]
    Profile,
    Linearised,
}

/// The yarn: what the preset that comes out says of it, and the values that are known.
#[derive(Default, Deserialize, PartialEq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct YarnFile {
    /// Of the preset and its file. Default: `my-yarn`.
    name: Option<Spanned<String>>,
    /// Where the values come from, kept in the preset. Default: the title.
    source: Option<Spanned<String>>,
    /// Of the yarn; refused beside a data sheet's if it is not the same. Default: the base preset's, or none.
    density: Option<Spanned<Positive>>,
    /// A base preset. Its values are guesses for what neither data nor `properties` tell. One with friction keeps its
    /// law, `mu` and `cohesion`. Default: such properties stay open.
    preset: Option<Spanned<String>>,
    /// Values that are known, by name: they are not fitted.
    #[serde(default)]
    properties: BTreeMap<Spanned<String>, Spanned<f64>>,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
struct FibreFile {
    /// Along the fibre.
    modulus: Positive,
    /// Of fibres in the yarn.
    volume_fraction: Fraction,
    /// Of the fibre.
    strain_at_failure: Fraction,
    /// Standard deviation of the modulus, for the interval of k_el. Default: exact.
    modulus_deviation: Option<Positive>,
    /// Standard deviation of the volume fraction, for the interval of k_el. Default: exact.
    volume_fraction_deviation: Option<Positive>,
    /// Standard deviation of the strain at failure, for the interval of ε_lim. Default: exact.
    strain_at_failure_deviation: Option<Positive>,
}

/// A data set.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub(super) struct DataFile {
    /// Of the set: letters, digits and `- _ .`. Default: `data-1`, ….
    pub name: Option<Spanned<String>>,
    /// A CSV file, relative to this one.
    pub file: Spanned<String>,
    /// See below. Default: `path`.
    pub loading: Option<Spanned<LoadingName>>,
    /// The load path of `toron run` of the data. Default: `loading`.
    pub path: Option<Spanned<String>>,
    /// The quantity, see below. Default: the first known one among the columns.
    pub abscissa: Option<Spanned<String>>,
    /// The quantity, see below. Default: the first known one among the columns.
    pub ordinate: Option<Spanned<String>>,
    /// `{ strain = "Extensometer" }`: the column of a quantity. Default: the quantity's name.
    #[serde(default)]
    pub columns: BTreeMap<Spanned<String>, Spanned<String>>,
    /// Of the specimen at rest along the displacement (its height, where it is pressed); needed for `displacement`
    /// only.
    pub length: Option<Spanned<Positive>>,
    /// On which a force acts, at rest: the section, or the pressed face; needed for `force` only.
    pub area: Option<Spanned<Positive>>,
    /// The abscissa at rest; `range` counts from there. Default: 0; of a tensile test, where it begins beyond its toe.
    pub zero: Option<Spanned<f64>>,
    /// `[from, to]` of the abscissa. Default: all.
    pub range: Option<Spanned<Numbers<2>>>,
    /// Standard deviation of the ordinates: a number or a column's name. Default: estimated from the residuals.
    pub deviation: Option<Spanned<DeviationFile>>,
    /// Multiplies the squares of this set, 10⁻⁶ to 10⁶. Default: 1.
    pub weight: Option<Spanned<f64>>,
    /// The parameters fitted to this set. `["k_tc", "p", "k_td"]` fits compression together with compaction. Default:
    /// [by the loading](guides/identification.md#from-curves).
    pub fits: Option<Vec<Spanned<String>>>,
    /// Why the whole set is left out; the summary repeats it. Default: the set counts.
    excluded: Option<Spanned<String>>,
}

impl DataFile {
    /// The files that it names.
    fn files(&self) -> impl Iterator<Item = &str> {
        [Some(&self.file), self.path.as_ref()].into_iter().flatten().map(|name| name.get_ref().as_str())
    }
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub(super) enum LoadingName {
    Elongation,
    Compaction,
    Compression,
    Failure,
    /// A section that slides: between sides that keep a pressure, or between plates without sides.
    Biaxial,
    Plates,
}

/// A standard deviation of all ordinates, or the column that has one for each.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "expected a number or the name of a column")]
pub(super) enum DeviationFile {
    Number(f64),
    Column(String),
}

/// A fit as a file describes it.
#[derive(Debug)]
pub struct Job {
    pub title: String,
    pub units: UnitSystem,
    /// The preset that comes out, with the values that are known before.
    pub preset: Preset,
    /// The preset from which values come that nothing else gives.
    pub base: Option<Preset>,
    pub fibre: Option<Fibre>,
    pub sheet: Option<DataSheet>,
    pub problem: Problem,
    pub intervals: Intervals,
    /// Of the law with friction, from sections that slide.
    pub friction: Friction,
    pub sliding: Vec<Sliding>,
    /// What there is to say of how the data were read, and what of them is left out.
    pub said: Vec<String>,
    /// The files that were read, none of which is to be overwritten.
    pub inputs: Vec<PathBuf>,
}

impl Job {
    /// The parameters, with the intervals that the file asks for.
    ///
    /// # Errors
    /// The data do not suffice, or the law has no answer to them.
    pub fn fit(&self) -> Result<Fit, Error> {
        let fit = self.problem.fit()?;
        Ok(match self.intervals {
            Intervals::Profile => profile::profiled(&self.problem, fit),
            Intervals::Linearised => fit,
        })
    }

    /// Reads the file and its data.
    ///
    /// # Errors
    /// An input error that names file, line and what is allowed.
    pub fn read(path: &Path) -> Result<Job, Error> {
        let (name, text) = toml_file::read(path)?;
        let source = Source { name: &name, text: &text };
        let mut file: FitFile = source.parse()?;
        let left_out = left_out(&source, &mut file)?;
        let units = units::system(&source, &file.units)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        check_sources(&source, &file)?;
        let sheet = file.data_sheet.as_ref().map(|sheet| DataSheet::read(&source, sheet)).transpose()?;
        let fibre = file.fibre.as_ref().map(|fibre| known_fibre(fibre.get_ref()));
        let fibre = fibre.or_else(|| sheet.as_ref().map(|sheet| sheet.fibre(&units)));
        let base = file.yarn.preset.as_ref().map(|name| base(&source, name, folder)).transpose()?;
        let slides = file.data.iter().any(|data| sliding_data::is_sliding(data.get_ref()));
        let law = match &base {
            _ if slides => frictional(),
            Some(base) => base.law,
            None => LawName::Hyperelastic,
        };
        let mut preset = preset_to_be(&source, &file, law, units)?;
        if let Some(sheet) = &sheet {
            preset.density = Some(sheet_density(&source, &file, sheet.density(&units))?);
        }
        let mut known = [None; PARAMETERS];
        known.copy_from_slice(&preset.values[..PARAMETERS]);
        let reader = Reader { source: &source, units: &units, known: &known, said: RefCell::new(left_out) };
        let sliding = sliding_data::sets(&reader, &file.data)?;
        let untold = base.as_ref().and_then(|base| base.value(C, &units));
        let given = [MU, C].map(|index| preset.values.get(index).copied().flatten());
        let friction = friction::fit(&sliding, given, untold.unwrap_or(0.0))?;
        let sections: Vec<&Spanned<DataFile>> =
            file.data.iter().filter(|data| !sliding_data::is_sliding(data.get_ref())).collect();
        let sets = reader.sets(&sections, fibre.is_some())?;
        let mut said = reader.said.into_inner();
        said.extend(sheet.iter().flat_map(|sheet| sheet.said.clone()));
        check_names(&sliding, &sets)?;
        let known_deviations = fibre.map_or_else(Vec::new, |fibre| add_fibre(&fibre, &mut known, &sets));
        let start = start(&known, base.as_ref(), &units, &sets);
        let of_base = |parameter: Parameter| base.as_ref().and_then(|base| base.value(parameter.index(), &units));
        let density = preset.density.or_else(|| base.as_ref().and_then(|base| base.density_in(&units)));
        let problem = Problem { sets, units, density, known, fallback: ALL.map(of_base), known_deviations, start };
        let title = file.title.unwrap_or_else(|| preset.name.clone());
        let data = file.data.iter().flat_map(|data| data.get_ref().files());
        let inputs = data.chain(file.yarn.preset.as_ref().map(|preset| preset.get_ref().as_str()));
        let inputs = inputs.map(|name| folder.join(name)).chain([path.to_path_buf()]).collect();
        let intervals = file.intervals;
        Ok(Job { title, units, preset, base, fibre, sheet, problem, intervals, friction, sliding, said, inputs })
    }
}

/// Checks that something tells the parameters, and only one thing those of the fibre.
///
/// # Errors
/// An input error that says what is allowed.
fn check_sources(source: &Source<'_>, file: &FitFile) -> Result<(), Error> {
    if file.data.is_empty() && file.fibre.is_none() && file.data_sheet.is_none() {
        let message = "neither [[data]] nor [fibre] nor [data_sheet] nor [[strength]]: nothing tells a parameter";
        return Err(source.error(0..0, message));
    }
    if let (Some(_), Some(sheet)) = (&file.fibre, &file.data_sheet) {
        let message = "[fibre] and [data_sheet] both tell k_el and eps_lim; allowed: one of them";
        return Err(source.error(sheet.span(), message));
    }
    Ok(())
}

/// The yarn's density by the data sheet, which that of `[yarn]` agrees with if there is one.
///
/// # Errors
/// They differ.
fn sheet_density(source: &Source<'_>, file: &FitFile, density: f64) -> Result<f64, Error> {
    let differs = |given: f64| (given / density - 1.0).abs() > SAME_DENSITY;
    let Some(given) = file.yarn.density.as_ref().filter(|given| differs(given.value())) else { return Ok(density) };
    let message = format!(
        "density is {}, and by [data_sheet] {density:.4e}, the fibre's times the volume fraction; allowed: one of them",
        given.value()
    );
    Err(source.error(given.span(), &message))
}

/// Checks that each data set of sliding has a name of its own.
///
/// # Errors
/// The first whose name another set has.
fn check_names(sliding: &[Sliding], sets: &[DataSet]) -> Result<(), Error> {
    let is_twice = |set: &&Sliding| {
        let of_section = sets.iter().any(|other| other.name == set.name);
        of_section || sliding.iter().filter(|other| other.name == set.name).count() > 1
    };
    let Some(set) = sliding.iter().find(is_twice) else { return Ok(()) };
    let (place, name) = (&set.declared, &set.name);
    Err(Error::Input(format!("{place}: data set \"{name}\" is there twice; allowed: a name of its own for each")))
}

/// Adds what the fibre tells to the parameters that are known and not fitted. Returns the deviations of those that it
/// tells.
fn add_fibre(fibre: &Fibre, known: &mut [Option<f64>; PARAMETERS], sets: &[DataSet]) -> Vec<Values> {
    let is_told = |parameter: Parameter, known: &[Option<f64>; PARAMETERS]| {
        let fitted = sets.iter().any(|set| set.fits.contains(&parameter));
        !fitted && known[parameter.index()].is_none()
    };
    let by_fibre = ALL.map(|parameter| is_told(parameter, known));
    for (parameter, value) in [(Parameter::KEl, fibre.k_el()), (Parameter::EpsLim, fibre.strain_at_failure.value)] {
        if by_fibre[parameter.index()] {
            known[parameter.index()] = Some(value);
        }
    }
    let mut deviations = fibre.deviations();
    for parameter in ALL.into_iter().filter(|parameter| !by_fibre[parameter.index()]) {
        deviations.iter_mut().for_each(|values| values[parameter.index()] = 0.0);
    }
    deviations
}

/// Takes the sets out of the file that it says are to be left out, and says so.
fn left_out(source: &Source<'_>, file: &mut FitFile) -> Result<Vec<String>, Error> {
    let mut said = Vec::new();
    for data in &file.data {
        let DataFile { excluded: Some(reason), name, file, .. } = data.get_ref() else { continue };
        if reason.get_ref().trim().is_empty() {
            return Err(source.error(reason.span(), "excluded is empty; allowed: the reason in words"));
        }
        let name = name.as_ref().unwrap_or(file).get_ref();
        said.push(format!("data set {name} is left out: {}", reason.get_ref()));
    }
    file.data.retain(|data| data.get_ref().excluded.is_none());
    Ok(said)
}

/// Where the search starts: what is known, the preset that the file names, the material of a path, else anything: the
/// answer is linear in the stiffnesses, and the exponent is sought from several starts.
fn start(known: &[Option<f64>; PARAMETERS], base: Option<&Preset>, units: &UnitSystem, sets: &[DataSet]) -> Values {
    const ANY: Values = [1.0, 1.0, 2.0, 1.0, 0.0, 0.05, 0.0, 0.0];
    let of_path = sets.iter().find_map(|set| match &set.loading {
        Loading::Path(path) => Some(path.trial()),
        _ => None,
    });
    let value = |parameter: Parameter| {
        let index = parameter.index();
        let of_base = base.and_then(|preset| preset.value(index, units));
        known[index].or(of_base).unwrap_or(of_path.unwrap_or(ANY)[index])
    };
    ALL.map(value)
}

/// The law that has µ and c.
fn frictional() -> LawName {
    let found = Laws::Toron.names().into_iter().find(|law| law.text() == FRICTIONAL);
    found.unwrap_or(LawName::Hyperelastic)
}

fn known_fibre(file: &FibreFile) -> Fibre {
    let constant = |number: f64, deviation| Constant { value: number, deviation: value(deviation).unwrap_or(0.0) };
    Fibre {
        modulus: constant(file.modulus.value(), &file.modulus_deviation),
        volume_fraction: constant(file.volume_fraction.value(), &file.volume_fraction_deviation),
        strain_at_failure: constant(file.strain_at_failure.value(), &file.strain_at_failure_deviation),
    }
}

/// The preset that fills in what nothing else gives.
fn base(source: &Source<'_>, name: &Spanned<String>, folder: &Path) -> Result<Preset, Error> {
    let preset = Preset::find(Laws::Toron, name.get_ref(), folder, |message| source.error(name.span(), message))?;
    // The parameters are the first properties of a yarn law; what one has besides, the friction, is kept.
    if !preset.law.table().starts_with(&HYPERELASTIC) {
        let message =
            format!("preset \"{}\" belongs to the linear elastic law; allowed: one of a yarn law", preset.name);
        return Err(source.error(name.span(), &message));
    }
    Ok(preset)
}

/// The preset that comes out, of this law, with the values that the file gives.
fn preset_to_be(source: &Source<'_>, file: &FitFile, law: LawName, units: UnitSystem) -> Result<Preset, Error> {
    let text = |value: &Option<Spanned<String>>| value.as_ref().map(|text| text.get_ref().clone());
    let name = text(&file.yarn.name).unwrap_or_else(|| "my-yarn".to_string());
    if !plain_name(&name) || name.len() > LONGEST_NAME || toron::preset(&name).is_some() {
        let span = file.yarn.name.as_ref().map_or(0..0, Spanned::span);
        let allowed = "up to 80 letters, digits and - _ ., and no name of the library's presets";
        return Err(source.error(span, &format!("name is \"{name}\"; allowed: {allowed}")));
    }
    let origin = text(&file.yarn.source).or_else(|| file.title.clone());
    let mut preset = Preset::new(&name, &origin.unwrap_or_else(|| name.clone()), law, units);
    preset.density = value(&file.yarn.density);
    for (name, value) in &file.yarn.properties {
        let index = property(source, law, name.get_ref(), name.span())?;
        let (property, number) = (&law.table()[index], *value.get_ref());
        let above = if property.minimum_excluded { number > property.minimum } else { number >= property.minimum };
        if !(above && number <= property.maximum && number.is_finite()) {
            let message = format!("{} is {number}; allowed: {}", property.name, property.allowed);
            return Err(source.error(value.span(), &message));
        }
        preset.values[index] = Some(number);
    }
    Ok(preset)
}

fn property(source: &Source<'_>, law: LawName, name: &str, span: Range<usize>) -> Result<usize, Error> {
    law.table().iter().position(|property| property.name == name).ok_or_else(|| {
        let known: Vec<&str> = law.table().iter().map(|property| property.name).collect();
        let hint = nearest::hint(name, known.iter().copied());
        source.error(span, &format!("property \"{name}\"{hint}; allowed: {}", known.join(" ")))
    })
}

#[cfg(test)]
mod tests;
