//! The tables of a scene's TOML file: the scene's own and its cases', and which of their keys nothing reads.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::scene::{Abscissa, Outputs, Precision};
use crate::common::toml_file::{Numbers, Unused, over};
use crate::material::file::MaterialFile;
use crate::material::of_law::{FailureName, HYPERELASTIC, LINEAR_ELASTIC, LawName, unused_material};

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum SectionName {
    Ellipse,
    Rectangle,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum StrikerName {
    Cylinder,
    Driven,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub title: Option<String>,
    pub units: Spanned<String>,
    pub abscissa: Option<Spanned<Abscissa>>,
    pub scene: Spanned<CaseFile>,
    #[serde(default)]
    pub case: Vec<Spanned<CaseFile>>,
}

/// The scene's table, and what a case has otherwise.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CaseFile {
    pub name: Option<Spanned<String>>,
    pub law: Option<LawName>,
    pub failure: Option<Spanned<FailureName>>,
    pub hyperelastic: Option<Spanned<MaterialFile>>,
    pub linear_elastic: Option<Spanned<MaterialFile>>,
    pub hyperelastic_length: Option<Spanned<f64>>,
    pub section: Option<SectionName>,
    pub half_length: Option<Spanned<f64>>,
    pub height: Option<Spanned<f64>>,
    pub width: Option<Spanned<f64>>,
    pub layers: Option<Spanned<i64>>,
    pub rows: Option<Spanned<i64>>,
    pub columns: Option<Spanned<i64>>,
    pub striker: Option<StrikerName>,
    pub speed: Option<Spanned<f64>>,
    pub held: Option<Spanned<bool>>,
    pub mass: Option<Spanned<f64>>,
    pub radius: Option<Spanned<f64>>,
    pub friction: Option<Spanned<f64>>,
    pub contact_stiffness: Option<Spanned<f64>>,
    pub hourglass: Option<Spanned<f64>>,
    pub viscosity: Option<Spanned<Numbers<3>>>,
    pub end: Option<Spanned<f64>>,
    pub sample: Option<Spanned<f64>>,
    pub pictures: Option<Spanned<Vec<f64>>>,
    pub frames: Option<Spanned<i64>>,
    pub precision: Option<Precision>,
    pub outputs: Option<Outputs>,
}

impl CaseFile {
    pub fn law(&self) -> LawName {
        self.law.unwrap_or(LawName::Hyperelastic)
    }

    /// The materials' tables, by their law.
    pub fn materials(&self) -> [(&'static str, &Option<Spanned<MaterialFile>>); 2] {
        [(HYPERELASTIC, &self.hyperelastic), (LINEAR_ELASTIC, &self.linear_elastic)]
    }

    pub fn failure(&self) -> FailureName {
        self.failure.as_ref().map_or(FailureName::None, |failure| *failure.get_ref())
    }

    /// The place of a property that this table itself gives to the material of a law.
    pub fn given(&self, law: &str, name: &str) -> Option<Range<usize>> {
        let table = if law == HYPERELASTIC { &self.hyperelastic } else { &self.linear_elastic };
        table.as_ref()?.get_ref().given(name).map(Spanned::span)
    }

    pub fn striker(&self) -> StrikerName {
        self.striker.unwrap_or(StrikerName::Cylinder)
    }

    /// A key of this table that none of these cases reads: its place, and the message.
    pub fn unused(&self, cases: &[&CaseFile]) -> Unused {
        let laws: Vec<LawName> = cases.iter().map(|case| case.law()).collect();
        let material = unused_material(&self.hyperelastic, &self.linear_elastic, &laws);
        material.or_else(|| self.unused_length(cases)).or_else(|| self.unused_cylinder(cases))
    }

    fn unused_length(&self, cases: &[&CaseFile]) -> Unused {
        let length = self.hyperelastic_length.as_ref()?;
        let message = format!(
            "hyperelastic-length is {}, which only a yarn of two laws has; allowed: with law = \"hybrid\"",
            length.get_ref()
        );
        cases.iter().all(|case| case.law() != LawName::Hybrid).then(|| (length.span(), message))
    }

    /// A driven section meets nothing.
    fn unused_cylinder(&self, cases: &[&CaseFile]) -> Unused {
        let span = |value: &Option<Spanned<f64>>| value.as_ref().map(Spanned::span);
        let keys = [
            ("mass", span(&self.mass)),
            ("radius", span(&self.radius)),
            ("friction", span(&self.friction)),
            ("contact-stiffness", span(&self.contact_stiffness)),
            ("held", self.held.as_ref().map(Spanned::span)),
        ];
        let (key, span) = keys.into_iter().find_map(|(key, span)| Some((key, span?)))?;
        let message = format!("{key} belongs to a cylinder, and striker is driven; allowed: one of the two");
        cases.iter().all(|case| case.striker() == StrikerName::Driven).then_some((span, message))
    }

    /// This table, with the keys of `base` where it has none.
    pub fn over(&self, base: &CaseFile) -> CaseFile {
        let material = |own: &_, base: &_| over(own, base, MaterialFile::over);
        let own = self.clone();
        let base = base.clone();
        CaseFile {
            name: own.name,
            law: own.law.or(base.law),
            failure: own.failure.or(base.failure),
            hyperelastic: material(&own.hyperelastic, &base.hyperelastic),
            linear_elastic: material(&own.linear_elastic, &base.linear_elastic),
            hyperelastic_length: own.hyperelastic_length.or(base.hyperelastic_length),
            section: own.section.or(base.section),
            half_length: own.half_length.or(base.half_length),
            height: own.height.or(base.height),
            width: own.width.or(base.width),
            layers: own.layers.or(base.layers),
            rows: own.rows.or(base.rows),
            columns: own.columns.or(base.columns),
            striker: own.striker.or(base.striker),
            speed: own.speed.or(base.speed),
            held: own.held.or(base.held),
            mass: own.mass.or(base.mass),
            radius: own.radius.or(base.radius),
            friction: own.friction.or(base.friction),
            contact_stiffness: own.contact_stiffness.or(base.contact_stiffness),
            hourglass: own.hourglass.or(base.hourglass),
            viscosity: own.viscosity.or(base.viscosity),
            end: own.end.or(base.end),
            sample: own.sample.or(base.sample),
            pictures: own.pictures.or(base.pictures),
            frames: own.frames.or(base.frames),
            precision: own.precision.or(base.precision),
            outputs: own.outputs.or(base.outputs),
        }
    }
}
