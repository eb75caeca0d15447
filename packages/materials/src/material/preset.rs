//! Presets: those of the library and those of a user's own files, which are used alike. `docs/guides/load-paths.md` has
//! the keys.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use serde::Deserialize;

use super::laws::{LawName, LawText, Laws};
use crate::material::laws::law;
use crate::units::{self, with_unit};
use toron::host::units::UnitSystem;
use toron::law::bounds;
use toron::law::parameters::{self, DENSITY, Dimension, Property};
use toron_shared::checked::{Positive, value};
use toron_shared::error::Error;
use toron_shared::nearest;
use toron_shared::numbers::plain;
use toron_shared::spanned::Spanned;
use toron_shared::text_table::grouped;
use toron_shared::toml_error::shortened;
use toron_shared::toml_file::Source;

/// Decks name the material by the preset, and Abaqus takes names of up to 80 characters.
pub const LONGEST_NAME: usize = 80;

/// A yarn's properties, with or without some of them, in units of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Preset {
    /// Letters, digits and - _ . only.
    pub name: String,
    /// Where the values come from, on one line.
    pub source: String,
    pub law: LawName,
    /// The units of `values` and `density`.
    pub units: UnitSystem,
    /// In the order of the law's table; none where the preset leaves a property to its default or to the material.
    pub values: Vec<Option<f64>>,
    pub density: Option<f64>,
    pub guesses: Guesses,
    file: Option<File>,
}

/// Which properties, or the density, nobody has measured on this yarn, and where their values come from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Guesses(BTreeMap<String, String>);

impl Guesses {
    pub fn insert(&mut self, name: &str, origin: &str) {
        self.0.insert(name.to_string(), origin.to_string());
    }

    /// Forgets the guess of what somebody has given.
    pub fn remove(&mut self, name: &str) {
        self.0.remove(name);
    }

    /// Where a guess comes from; none of what is not guessed.
    pub fn origin(&self, name: &str) -> Option<&str> {
        self.0.get(name).map(String::as_str)
    }

    /// The guesses in words, in the order of the law's table: `k_tc, p (of kevlar-km2-600)`. None without any.
    pub fn text(&self, law: LawName) -> Option<String> {
        let groups = grouped(self.in_order(law).map(|(name, origin)| (name, origin.as_str())));
        let texts = groups.into_iter().map(|(origin, names)| format!("{} ({origin})", names.join(", ")));
        (!self.0.is_empty()).then(|| texts.collect::<Vec<_>>().join("; "))
    }

    fn in_order(&self, law: LawName) -> impl Iterator<Item = (&'static str, &String)> {
        let names = law.table().iter().map(|property| property.name).chain(["density"]);
        names.filter_map(|name| Some((name, self.0.get(name)?)))
    }
}

/// The file of a preset: its name, and the line of each property that it has.
#[derive(Clone, Debug, PartialEq)]
struct File {
    name: String,
    lines: Vec<Option<usize>>,
}

/// What one law's properties have, at their places among those of another one.
fn spread<X: Copy>(places: &[usize], from: &[Option<X>], law: LawName) -> Vec<Option<X>> {
    let mut to = vec![None; law.table().len()];
    for (&place, &value) in places.iter().zip(from) {
        to[place] = value;
    }
    to
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct PresetFile {
    /// Up to 80 letters, digits and `-` `_` `.`, and not the name of a built-in preset. Default: the file's name
    /// without `.toml`.
    name: Option<Spanned<String>>,
    /// Where the values come from, in one line; decks have it as a comment. Default: the name.
    source: Option<Spanned<String>>,
    /// Of `density` and `[properties]`, such as `mm-tonne-s`; [others](guides/load-paths.md#at-the-top).
    units: Spanned<String>,
    /// As in [`[material]`](guides/load-paths.md#material). Default: `hyperelastic`.
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    law: Option<Spanned<LawText>>,
    /// Reference density. Default: the material's table may give it.
    density: Option<Positive>,
    /// Values by name. Default: the material's table may give them; else the property's default.
    #[serde(default)]
    properties: BTreeMap<Spanned<String>, Spanned<f64>>,
    /// Values that nobody has measured on this yarn, each with where it comes from, `k_td = "half of Kevlar's"`; cards
    /// and decks name them. Default: none.
    #[serde(default)]
    guesses: BTreeMap<Spanned<String>, Spanned<String>>,
}

impl From<&parameters::Preset> for Preset {
    fn from(preset: &parameters::Preset) -> Preset {
        Preset {
            name: preset.name.to_string(),
            source: preset.source.to_string(),
            law: preset.into(),
            units: UnitSystem::SI,
            values: preset.values.iter().copied().map(Some).collect(),
            density: Some(preset.density),
            guesses: Guesses::default(),
            file: None,
        }
    }
}

impl Preset {
    /// A preset without values, to be filled in and written.
    pub fn new(name: &str, source: &str, law: LawName, units: UnitSystem) -> Preset {
        let values = vec![None; law.table().len()];
        let (name, source, guesses) = (name.to_string(), source.to_string(), Guesses::default());
        Preset { name, source, law, units, values, density: None, guesses, file: None }
    }

    /// The preset for another law, whose properties include all of its own, as those of the law with friction include the
    /// hyperelastic law's; none for any other law.
    pub fn for_law(self, law: LawName) -> Option<Preset> {
        if self.law == law {
            return Some(self);
        }
        let place = |property: &Property| {
            let same = |other: &Property| other.name == property.name && other.dimension == property.dimension;
            law.table().iter().position(same)
        };
        let places: Vec<usize> = self.law.table().iter().map(place).collect::<Option<_>>()?;
        let file = self.file.map(|file| File { lines: spread(&places, &file.lines, law), ..file });
        Some(Preset { values: spread(&places, &self.values, law), law, file, ..self })
    }

    /// The preset of this name among those of the laws, or the file, where the name ends in `.toml`; a relative one is
    /// in `folder`. `error` makes the error at the place that names the preset.
    ///
    /// # Errors
    /// There is no such preset, the file cannot be read, or something is wrong in it.
    pub fn find(laws: Laws, name: &str, folder: &Path, error: impl Fn(&str) -> Error) -> Result<Preset, Error> {
        if let Some(preset) = laws.preset(name) {
            return Ok(preset.into());
        }
        if !name.ends_with(".toml") {
            let known: String = laws.presets().iter().map(|preset| format!("{}, ", preset.name)).collect();
            let or = if known.is_empty() { "" } else { "or " };
            let hint = nearest::hint(name, laws.presets().iter().map(|preset| preset.name));
            return Err(error(&format!("preset \"{name}\"{hint}; allowed: {known}{or}a file NAME.toml")));
        }
        let path = folder.join(name);
        let file = path.display().to_string();
        let text = std::fs::read_to_string(&path)
            .map_err(|reason| error(&format!("preset \"{name}\": {file} cannot be read: {reason}")))?;
        Preset::parse(laws, &file, &text)
    }

    /// The preset that the text of a file describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// An input error that names file, line, value and what is allowed.
    pub fn parse(laws: Laws, name: &str, text: &str) -> Result<Preset, Error> {
        let source = Source { name, text };
        let file: PresetFile = source.parse()?;
        let law = file.law.as_ref().map(|name| law(&source, laws, name)).transpose()?.unwrap_or(laws.first());
        let (values, properties) = preset_values(&source, &file, law.table())?;
        let label = preset_name(&source, &file)?;
        let given = file.source.as_ref().map(|text| one_line(&source, "source", text)).transpose()?;
        Ok(Preset {
            source: given.unwrap_or(&label).to_string(),
            guesses: guesses(&source, &file, law, &values)?,
            name: label,
            law,
            units: units::system(&source, &file.units)?,
            values,
            density: value(&file.density),
            file: Some(properties),
        })
    }

    /// Changes a property, or the density, to a value in these units, and says so where the values come from.
    ///
    /// # Errors
    /// What is wrong with name or value.
    pub fn set(&mut self, name: &str, value: f64, units: &UnitSystem) -> Result<(), String> {
        let table = self.law.table();
        let own = |dimension: Dimension| units.scale(dimension).convert(value, &self.units.scale(dimension));
        if name == "density" {
            if value <= 0.0 {
                return Err(format!("density is {value}; allowed: a finite number > 0"));
            }
            self.density = Some(own(DENSITY));
            self.source += &format!("; {name} = {}", with_unit(units, &plain(value), DENSITY));
        } else {
            let known = || {
                let known: Vec<&str> = table.iter().map(|property| property.name).collect();
                let hint = nearest::hint(name, known.iter().copied().chain(["density"]));
                format!("no property {name}{hint}; allowed: {} density", known.join(" "))
            };
            let index = table.iter().position(|property| property.name == name).ok_or_else(known)?;
            check(table, index, value).map_err(|error| error.to_string())?;
            let dimension = table[index].dimension;
            self.values[index] = Some(own(dimension));
            self.source += &format!("; {name} = {}", with_unit(units, &plain(value), dimension));
        }
        self.guesses.remove(name);
        Ok(())
    }

    /// The property's value in these units: the bits of the preset where they are its own. None if the preset has none.
    pub fn value(&self, index: usize, units: &UnitSystem) -> Option<f64> {
        // A law with more properties asks for those that this one has not.
        let dimension = self.law.table().get(index)?.dimension;
        self.values[index].map(|value| self.convert(value, dimension, units))
    }

    pub fn density_in(&self, units: &UnitSystem) -> Option<f64> {
        self.density.map(|density| self.convert(density, DENSITY, units))
    }

    fn convert(&self, value: f64, dimension: Dimension, units: &UnitSystem) -> f64 {
        self.units.scale(dimension).convert(value, &units.scale(dimension))
    }

    /// All values in these units, defaults where the preset has none.
    ///
    /// # Errors
    /// A property that has neither.
    pub fn complete(&self, units: &UnitSystem) -> Result<Vec<f64>, Error> {
        let value = |(index, property): (usize, &Property)| {
            let value = self.value(index, units).or(property.default);
            value.ok_or_else(|| {
                let Property { name, meaning, allowed, .. } = property;
                self.error(&format!("property {name} ({meaning}) is missing; allowed: {allowed}"))
            })
        };
        self.law.table().iter().enumerate().map(value).collect()
    }

    /// The file that the preset was read from, for messages.
    pub fn file(&self) -> Option<&str> {
        self.file.as_ref().map(|file| file.name.as_str())
    }

    /// An error of the preset as a whole.
    pub fn error(&self, message: &str) -> Error {
        Error::Input(format!("{}: {message}", self.file().unwrap_or(&self.name)))
    }

    /// The error of a law that refuses the preset's values.
    pub fn law_error(&self, error: &toron::Error) -> Error {
        let message = error.to_string();
        first_property(error).and_then(|index| self.error_at(index, &message)).unwrap_or_else(|| self.error(&message))
    }

    /// An error at the line of a property; none if no file gives the property.
    pub fn error_at(&self, index: usize, message: &str) -> Option<Error> {
        let File { name, lines } = self.file.as_ref()?;
        lines[index].map(|line| Error::Input(format!("{name}:{line}: {message}")))
    }

    /// The text of a file that reads back as this preset, bit for bit. `comments` stand behind the properties (or the
    /// density) that they name; a property without a value is left out, and its comment has a line of its own.
    ///
    /// The values must be allowed and the name must be one, as in [`Preset::parse`]: nothing is checked here.
    pub fn to_toml(&self, comments: &BTreeMap<&str, String>) -> String {
        let units = self.units.names().join("-");
        let mut text = format!("name = {}\nsource = {}\n", quoted(&self.name), quoted(&self.source));
        let _ = write!(text, "units = \"{units}\"\nlaw = \"{}\"\n", self.law.text());
        let line = |name: &str, value: Option<f64>| {
            let comment = comments.get(name).map(|comment| words(comment));
            match (value, comment) {
                // The shortest digits that are this number and no other.
                (Some(value), None) => format!("{name} = {value:?}\n"),
                (Some(value), Some(comment)) => format!("{name} = {value:?} # {comment}\n"),
                (None, Some(comment)) => format!("# {name}: {comment}\n"),
                (None, None) => String::new(),
            }
        };
        text += &line("density", self.density);
        text += "\n[properties]\n";
        for (property, &value) in self.law.table().iter().zip(&self.values) {
            text += &line(property.name, value);
        }
        let guesses: String =
            self.guesses.in_order(self.law).map(|(name, origin)| format!("{name} = {}\n", quoted(origin))).collect();
        if guesses.is_empty() { text } else { format!("{text}\n[guesses]\n{guesses}") }
    }
}

/// The values of a preset's properties, and where they are in its file.
fn preset_values(
    source: &Source<'_>,
    file: &PresetFile,
    table: &'static [Property],
) -> Result<(Vec<Option<f64>>, File), Error> {
    let (mut values, mut lines) = (vec![None; table.len()], vec![None; table.len()]);
    for (name, value) in &file.properties {
        let index = property_index(source, table, name)?;
        check(table, index, *value.get_ref()).map_err(|error| source.error(value.span(), &error.to_string()))?;
        values[index] = Some(*value.get_ref());
        lines[index] = Some(source.line(value.span()));
    }
    Ok((values, File { name: source.name.to_string(), lines }))
}

/// Where the table has the property of this name.
pub fn property_index(source: &Source<'_>, table: &[Property], name: &Spanned<String>) -> Result<usize, Error> {
    table.iter().position(|property| property.name == name.get_ref()).ok_or_else(|| {
        let known: Vec<&str> = table.iter().map(|property| property.name).collect();
        let hint = nearest::hint(name.get_ref(), known.iter().copied());
        let message = format!("property \"{}\"{hint}; allowed: {}", name.get_ref(), known.join(" "));
        source.error(name.span(), &message)
    })
}

/// The preset's name, or its file's.
fn preset_name(source: &Source<'_>, file: &PresetFile) -> Result<String, Error> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    let allowed = |name: &str| {
        (1..=LONGEST_NAME).contains(&name.len()) && name.chars().all(plain) && parameters::preset(name).is_none()
    };
    let stem = Path::new(source.name).file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into());
    let (name, span, what) = match &file.name {
        Some(name) => (name.get_ref().clone(), name.span(), "name"),
        None => (stem, 0..0, "without a name, the preset has that of its file,"),
    };
    if allowed(&name) {
        return Ok(name);
    }
    let message = format!(
        "{what} \"{}\"; allowed: up to {LONGEST_NAME} letters, digits and - _ ., since decks have it, and not the name \
         of a built-in preset",
        shortened(&name)
    );
    Err(source.error(span, &message))
}

/// A text that decks have as a comment, which a line break would end.
fn one_line<'a>(source: &Source<'_>, key: &str, text: &'a Spanned<String>) -> Result<&'a str, Error> {
    if text.get_ref().chars().any(char::is_control) {
        let message = format!("{key} has a line break or another control character; allowed: one line of text");
        return Err(source.error(text.span(), &message));
    }
    Ok(text.get_ref())
}

/// Which of the file's values are guesses.
fn guesses(source: &Source<'_>, file: &PresetFile, law: LawName, values: &[Option<f64>]) -> Result<Guesses, Error> {
    let mut guesses = Guesses::default();
    for (name, origin) in &file.guesses {
        let has_value = match name.get_ref().as_str() {
            "density" => file.density.is_some(),
            _ => values[property_index(source, law.table(), name)?].is_some(),
        };
        if !has_value {
            let message =
                format!("a guess of {}, which the file does not give; allowed: a property of it", name.get_ref());
            return Err(source.error(name.span(), &message));
        }
        guesses.insert(name.get_ref(), one_line(source, name.get_ref(), origin)?);
    }
    Ok(guesses)
}

/// The property that a law refuses, the first of a direction's three.
pub fn first_property(error: &toron::Error) -> Option<usize> {
    match *error {
        toron::Error::Property { index, .. } | toron::Error::Direction { index, .. } => Some(index),
        _ => None,
    }
}

/// Checks one value against the table.
fn check(table: &'static [Property], index: usize, value: f64) -> Result<(), toron::Error> {
    bounds::check(&table[index..=index], &[value]).map_err(|error| match error {
        // The check has seen a table of one row.
        toron::Error::Property { code, property, value, .. } => toron::Error::Property { code, index, property, value },
        error => error,
    })
}

/// Text on one line.
fn words(text: &str) -> String {
    text.split(|c: char| c.is_whitespace() || c.is_control())
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

/// A string of TOML; blanks for control characters, which no name and no source has.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace(char::is_control, " ").replace('\\', "\\\\").replace('"', "\\\""))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const YARN: &str = "name = \"my-yarn\"\nunits = \"mm-tonne-s\"\ndensity = 1.3514e-9\n[properties]\nk_el = 82445\n";

    fn parse(text: &str) -> Result<Preset, String> {
        Preset::parse(Laws::Toron, "yarns/my-yarn.toml", text).map_err(|error| error.to_string())
    }

    #[test]
    fn a_file_has_some_of_the_values_in_its_units() {
        let preset = parse(YARN).expect("it is valid");
        let [mm, si] = ["mm-tonne-s", "si"].map(|name| UnitSystem::parse(name).expect("a system"));
        assert_eq!((preset.law, preset.name.as_str()), (LawName::Hyperelastic, "my-yarn"));
        assert_eq!(preset.source, "my-yarn", "what a deck says where there is no source");
        assert_eq!((preset.value(0, &mm), preset.value(0, &si)), (Some(82445.0), Some(82445e6)));
        assert_eq!((preset.value(1, &mm), preset.density_in(&mm)), (None, Some(1.3514e-9)));
        assert_eq!(parse("units = \"si\"\nlaw = \"linear-elastic\"").expect("it is valid").law, LawName::LinearElastic);
    }

    #[test]
    fn built_in_presets_become_the_same_type() {
        for built_in in Laws::Toron.presets() {
            let (preset, mm) = (Preset::from(built_in), UnitSystem::parse("mm-tonne-s").expect("a system"));
            let values = built_in.table().iter().zip(built_in.values);
            let expected: Vec<f64> = values.map(|(row, &value)| mm.from_si(value, row.dimension)).collect();
            assert_eq!(preset.complete(&mm), Ok(expected));
            assert_eq!(preset.density_in(&mm), Some(mm.from_si(built_in.density, DENSITY)));
        }
    }

    #[test]
    fn what_is_missing_takes_its_default_or_is_named() {
        let all = format!("{YARN}k_tc = 1055\np = 2.2\nk_td = 650\n");
        let preset = parse(&all).expect("it is valid");
        let values = preset.complete(&preset.units).expect("the rest have defaults");
        assert_eq!(values, [82445.0, 1055.0, 2.2, 650.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        let preset = parse(YARN).expect("it is valid");
        assert_eq!(
            preset.complete(&preset.units).expect_err("k_tc has no default").to_string(),
            "yarns/my-yarn.toml: property k_tc (transverse compaction stiffness) is missing; allowed: a number from 0 to 1e25"
        );
    }

    #[test]
    fn errors_name_file_line_value_and_what_is_allowed() {
        let name =
            "allowed: up to 80 letters, digits and - _ ., since decks have it, and not the name of a built-in preset";
        let si = "units = \"si\"\n";
        for (text, line, message) in [
            (
                format!("{YARN}k_tc = -3\n"),
                6,
                "property 2 (k_tc, transverse compaction stiffness) is -3.0; allowed: a number from 0 to 1e25",
            ),
            (
                format!("{YARN}p = 1"),
                6,
                "property 3 (p, transverse compaction exponent) is 1.0; allowed: a number > 1, at most 40",
            ),
            (
                format!("{YARN}k_td = nan"),
                6,
                "(k_td, transverse distortion stiffness) is NaN; allowed: a number from 0",
            ),
            (
                format!("{YARN}m_2 = inf"),
                6,
                "(m_2, fibre direction in the reference placement, any length) is infinity; allowed: a finite",
            ),
            (format!("{YARN}k_elast = 3\n"), 6, "property \"k_elast\", did you mean k_el?; allowed: k_el k_tc p k_td"),
            (format!("{YARN}p = \"2\"\n"), 6, "p is \"2\"; allowed: a number"),
            (format!("{YARN}k_el = 3\n"), 6, "duplicate key"),
            ("units = \"si\"\ncolour = 3".to_string(), 2, "unknown field `colour`, expected one of `name`, `source`"),
            ("name = \"a\"".to_string(), 1, "missing field `units`"),
            ("units = \"mm\"".to_string(), 1, "unit system \"mm\"; allowed: length-mass-time"),
            (
                format!("{si}law = \"elastic\""),
                2,
                "law is \"elastic\"; allowed: hyperelastic or linear-elastic or frictional",
            ),
            (
                format!("{si}law = \"linear-elastic\"\nproperties = {{ p = 2 }}"),
                3,
                "property \"p\"; allowed: e_1 e_2 g",
            ),
            (format!("{si}density = 0"), 2, "density is 0; allowed: a finite number > 0"),
            (format!("{si}density = inf"), 2, "density is inf; allowed: a finite number > 0"),
            (format!("{si}name = \"my yarn\""), 2, &format!("name \"my yarn\"; {name}")),
            (format!("{si}name = \"\""), 2, &format!("name \"\"; {name}")),
            (format!("{si}name = \"kevlar-km2-600\""), 2, &format!("name \"kevlar-km2-600\"; {name}")),
            (format!("{si}source = \"\"\"a\nb\"\"\""), 2, "source has a line break or another control character"),
            ("units = \n".to_string(), 1, ""),
        ] {
            let error = parse(&text).expect_err(&text);
            assert!(error.starts_with(&format!("yarns/my-yarn.toml:{line}: ")), "line {line}: {error}\n{text}");
            assert!(error.contains(message), "{message}: {error}\n{text}");
        }
        let unnamed = Preset::parse(Laws::Toron, "my yarn.toml", "units = \"si\"")
            .expect_err("the file's name is none")
            .to_string();
        assert_eq!(
            unnamed,
            format!("my yarn.toml:1: without a name, the preset has that of its file, \"my yarn\"; {name}")
        );
    }

    #[test]
    fn a_written_preset_is_a_file_to_read() {
        let units = UnitSystem::parse("mm-tonne-s").expect("a system");
        let mut preset = Preset::new("my-yarn", "lot \"12\", C:\\tests", LawName::Hyperelastic, units);
        (preset.values[0], preset.values[2], preset.density) = (Some(82445.0), Some(0.1 + 2.0), Some(1.3514e-9));
        let comments = [("k_el", "±  3 %,\nfrom tension"), ("k_tc", "no test shows it"), ("density", "weighed")];
        let comments = comments.into_iter().map(|(name, comment)| (name, comment.to_string())).collect();
        assert_eq!(
            preset.to_toml(&comments),
            "name = \"my-yarn\"\nsource = \"lot \\\"12\\\", C:\\\\tests\"\nunits = \"mm-tonne-s\"\nlaw = \"hyperelastic\"\n\
             density = 1.3514e-9 # weighed\n\n[properties]\nk_el = 82445.0 # ± 3 %, from tension\n# k_tc: no test shows it\n\
             p = 2.1\n"
        );
        let read = parse(&preset.to_toml(&comments)).expect("it is valid");
        assert_eq!(Preset { file: None, ..read }, preset);
    }

    #[test]
    fn the_documentation_s_example_is_a_preset() {
        let document = include_str!("../../../../docs/guides/load-paths.md");
        let (_, section) = document.split_once("## A preset of your own").expect("the section");
        let example = section.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
        let preset = parse(example).expect("it is valid");
        assert!(preset.complete(&preset.units).is_ok() && preset.density.is_some());
    }

    /// Any allowed value of a property, digits and exponents of all sizes.
    fn allowed(property: &'static Property) -> impl Strategy<Value = Option<f64>> {
        let range = property.minimum.max(-1e300).next_up()..property.maximum.min(1e300);
        proptest::option::of(prop_oneof![range, 1.1..1.2_f64, Just(if property.minimum < 0.0 { 5e-324 } else { 1.5 })])
    }

    proptest! {
        #[test]
        fn every_bit_reads_back(
            law in prop_oneof![Just(LawName::Hyperelastic), Just(LawName::LinearElastic)],
            density in proptest::option::of(f64::MIN_POSITIVE..f64::MAX),
            values in parameters::HYPERELASTIC.iter().map(allowed).collect::<Vec<_>>(),
            linear in parameters::LINEAR_ELASTIC.iter().map(allowed).collect::<Vec<_>>(),
            source in "[^\\p{Cc}]*",
            comment in "\\PC*|(?s).*",
        ) {
            let units = UnitSystem::parse("in-slinch-s").expect("a system");
            let values = if law == LawName::Hyperelastic { values } else { linear };
            let preset = Preset { values, density, ..Preset::new("my-yarn", &source, law, units) };
            let comments = law.table().iter().map(|row| (row.name, comment.clone())).collect();
            let read = parse(&preset.to_toml(&comments)).expect("it is valid");
            for (index, value) in preset.values.iter().enumerate() {
                prop_assert_eq!(read.value(index, &units).map(f64::to_bits), value.map(f64::to_bits));
            }
            prop_assert_eq!(Preset { file: None, ..read }, preset);
        }

        #[test]
        fn no_text_panics(any in "(?s).*") {
            let _ = parse(&any);
            let _ = parse(&format!("{YARN}{any}"));
        }
    }
}
