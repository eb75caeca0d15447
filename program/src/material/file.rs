//! A material as files describe it: a preset, a law, and what is other than they have it. `docs/load-paths.md` has the keys.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::model::{Law, Material};
use crate::common::error::Error;
use crate::common::toml_file::{Numbers, Source};
use toron::host::units::UnitSystem;
use toron::law::parameters::{self, DENSITY, FIBRE, LINEAR_FIBRE, Preset, Property};
use toron::{Criterion, Rotation};

/// A table that describes a material.
#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialFile {
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

impl Source<'_> {
    /// The material of a table; `span` is the place that errors name for keys that are missing.
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

    /// The values of all properties, and for each the place that errors name: preset or default, then fibre, then properties.
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
}
