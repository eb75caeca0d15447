//! A material as files describe it: a preset, a law, and what is other than they have it. `docs/guides/load-paths.md`
//! has the keys.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::Deserialize;

use super::laws::{LawName, LawText, Laws};
use super::model::{Law, Material, Origin};
use super::preset::{Preset, first_property};
use crate::material::laws::law;
use crate::material::preset::property_index;
use crate::units::with_unit;
use toron::host::units::UnitSystem;
use toron::law::parameters::{DENSITY, NUMBER, Property};
use toron::{Criterion, Rotation};
use toron_shared::checked::{Positive, value};
use toron_shared::error::Error;
use toron_shared::layers::Drops;
use toron_shared::numbers::plain;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{Numbers, Source};

/// The tables of a material.
const TABLES: &[&str] = &["material", "hyperelastic", "linear-elastic", "frictional"];

/// What a key of a material drops of the material beneath: one of its own starts afresh.
pub const DROPS: [Drops; 2] = [
    Drops { tables: TABLES, key: "preset", value: None, keys: &[] },
    Drops { tables: TABLES, key: "law", value: None, keys: &[] },
];

/// A table that describes a material.
#[derive(Clone, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct MaterialFile {
    /// A yarn by name (`toron params` lists them), or [a file of your own](guides/load-paths.md#a-preset-of-your-own),
    /// `"my-yarn.toml"`. Default: none; then `law` is needed.
    preset: Option<Spanned<String>>,
    /// `"hyperelastic"`, `"linear-elastic"` or `"frictional"`. Default: the preset's.
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    law: Option<Spanned<LawText>>,
    /// Direction in the reference placement, of any length. Default: `m_1`, `m_2`, `m_3` of the properties.
    fibre: Option<Spanned<Numbers<3>>>,
    /// For the wave speeds. Default: the preset's, or none.
    density: Option<Positive>,
    /// Of the linear elastic law, that rotates with the material. Default: `fibre`.
    frame: Option<Spanned<FrameName>>,
    /// Of the linear elastic law, the stress compared with `sigma_lim`. Default: `largest-principal`.
    criterion: Option<Spanned<CriterionName>>,
    /// Values by name, in the file's units, in place of the preset's. Default: the preset's value, else the property's
    /// default.
    #[serde(default)]
    properties: BTreeMap<Spanned<String>, Spanned<f64>>,
}

#[derive(Clone, Copy, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
enum FrameName {
    Fibre,
    Polar,
    Spin,
}

#[derive(Clone, Copy, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
enum CriterionName {
    LargestPrincipal,
    FibreStress,
}

impl MaterialFile {
    /// A property that the file itself gives.
    pub fn given(&self, name: &str) -> Option<&Spanned<f64>> {
        self.properties.iter().find(|(key, _)| key.get_ref() == name).map(|(_, value)| value)
    }

    /// Whose yarn it is: the preset, or the law where it names one without a preset.
    pub fn yarn(&self) -> Option<&str> {
        let preset = self.preset.as_ref().map(|name| name.get_ref().as_str());
        preset.or(self.law.as_ref().map(|law| law.get_ref().0.as_str()))
    }

    /// Names and values of what the file itself gives. A fibre is a place rather than a yarn's property.
    fn own(&self) -> impl Iterator<Item = (&str, f64)> {
        let density = value(&self.density).map(|value| ("density", value));
        let properties = self.properties.iter().map(|(name, value)| (name.get_ref().as_str(), *value.get_ref()));
        density.into_iter().chain(properties)
    }

    /// What is other than the preset has it, in words.
    fn own_text(&self, table: &[Property], units: &UnitSystem) -> String {
        let values = self.own().map(|(name, value)| {
            let property = table.iter().find(|property| property.name == name);
            let dimension = if name == "density" { DENSITY } else { property.map_or(NUMBER, |row| row.dimension) };
            format!("{name} = {}", with_unit(units, &plain(value), dimension))
        });
        values.collect::<Vec<_>>().join("; ")
    }

    /// Where the values come from that a preset gives.
    fn origin(&self, preset: &Preset) -> Origin {
        let mut guesses = preset.guesses.clone();
        self.own().for_each(|(name, _)| guesses.remove(name));
        Origin { source: preset.source.clone(), guesses }
    }

    /// This table, with this preset where it names neither a preset nor a law.
    pub fn or_preset(mut self, name: &str, span: Range<usize>) -> MaterialFile {
        if self.yarn().is_none() {
            self.preset = Some(Spanned::new(span, name.to_string()));
        }
        self
    }
}

/// The values of all properties of a law, and the places that errors name for them: none where the preset gives the
/// value.
struct Values {
    values: Vec<f64>,
    places: Vec<Option<Range<usize>>>,
}

/// The material of a table, of one of these laws; `span` is the place that errors name for keys that are missing.
pub fn read_material(
    source: &Source<'_>,
    laws: Laws,
    file: &MaterialFile,
    units: &UnitSystem,
    span: Range<usize>,
) -> Result<Material, Error> {
    let named = file.law.as_ref().map(|name| law(source, laws, name)).transpose()?;
    let preset = file.preset.as_ref().map(|name| preset(source, laws, name)).transpose()?;
    let law_name = named.or(preset.as_ref().map(|preset| preset.law)).or(laws.only());
    let law_name = law_name
        .ok_or_else(|| source.error(span.clone(), "the material needs a preset, or a law and its properties"))?;
    let preset = match (preset, &file.law) {
        (Some(preset), Some(law)) => {
            let (name, own) = (preset.name.clone(), preset.law.text());
            let wrong = || source.error(law.span(), &format!("preset \"{name}\" is of the law {own}; allowed: {own}"));
            Some(preset.for_law(law_name).ok_or_else(wrong)?)
        }
        (preset, _) => preset,
    };
    let Values { values, places } = values(source, file, preset.as_ref(), law_name, units, &span)?;
    let (frame, criterion) = options(source, file, law_name)?;
    let law = Law::new(law_name, &values, frame, criterion).map_err(|error| {
        let (message, index) = (error.to_string(), first_property(&error).unwrap_or(0));
        if let Some(place) = &places[index] {
            return source.error(place.clone(), &message);
        }
        let of_preset = preset.as_ref().and_then(|preset| preset.error_at(index, &message));
        of_preset.unwrap_or_else(|| source.error(file.preset.as_ref().map_or(span, Spanned::span), &message))
    })?;
    let density = value(&file.density).or(preset.as_ref().and_then(|preset| preset.density_in(units)));
    let origin = preset.as_ref().map_or(Origin::default(), |preset| file.origin(preset));
    let label = preset.map_or_else(|| law_name.text().to_string(), |preset| preset.name);
    Ok(Material { law, density, label, own: file.own_text(law_name.table(), units), origin, temperature: None })
}

fn preset(source: &Source<'_>, laws: Laws, name: &Spanned<String>) -> Result<Preset, Error> {
    Preset::find(laws, name.get_ref(), source.folder(), |message| source.error(name.span(), message))
}

/// The options of the linear elastic law; no other law has any.
fn options(source: &Source<'_>, file: &MaterialFile, law: LawName) -> Result<(Rotation, Criterion), Error> {
    let place = file.frame.as_ref().map(Spanned::span).or(file.criterion.as_ref().map(Spanned::span));
    if let Some(place) = place.filter(|_| law != LawName::LinearElastic) {
        return Err(source.error(place, "frame and criterion are options of the linear elastic law"));
    }
    let frame = match file.frame.as_ref().map(|name| *name.get_ref()) {
        None | Some(FrameName::Fibre) => Rotation::Fibre,
        Some(FrameName::Polar) => Rotation::Polar,
        Some(FrameName::Spin) => Rotation::Spin,
    };
    let criterion = match file.criterion.as_ref().map(|name| *name.get_ref()) {
        None | Some(CriterionName::LargestPrincipal) => Criterion::LargestPrincipal,
        Some(CriterionName::FibreStress) => Criterion::FibreStress,
    };
    Ok((frame, criterion))
}

/// The values of all properties: preset or default, then fibre, then properties.
fn values(
    source: &Source<'_>,
    file: &MaterialFile,
    preset: Option<&Preset>,
    law: LawName,
    units: &UnitSystem,
    span: &Range<usize>,
) -> Result<Values, Error> {
    let table = law.table();
    let of_preset = |index: usize| preset.and_then(|preset| preset.value(index, units));
    let given = table.iter().enumerate().map(|(index, property)| of_preset(index).or(property.default));
    let mut values: Vec<Option<f64>> = given.collect();
    let mut places = vec![None; table.len()];
    if let Some(fibre) = &file.fibre {
        for (i, &component) in law.description().fibre_components().zip(&fibre.get_ref().0) {
            values[i] = Some(component);
            places[i] = Some(fibre.span());
        }
    }
    for (name, value) in &file.properties {
        let index = property_index(source, table, name)?;
        values[index] = Some(*value.get_ref());
        places[index] = Some(value.span());
    }
    let complete = values.iter().zip(table).map(|(value, property)| {
        value.ok_or_else(|| {
            let Property { name, meaning, allowed, .. } = property;
            let file = preset.and_then(Preset::file).map(|file| format!(", and {file} does not give it"));
            let file = file.unwrap_or_default();
            let message = format!("property {name} ({meaning}) is missing{file}; allowed: {allowed}");
            source.error(span.clone(), &message)
        })
    });
    Ok(Values { values: complete.collect::<Result<_, _>>()?, places })
}
