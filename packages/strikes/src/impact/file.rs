//! The tables of a scene's TOML file: the scene's own and its cases', and which of their keys nothing reads.

use serde::Deserialize;
use toml::Spanned;

use super::scene::{Abscissa, Outputs};
use crate::struck::keys::{Keys, case_file, with_common_keys};
use crate::struck::shots::ShotsFile;
use toron_materials::material::of_law::LawName;
use toron_shared::toml_file::Unused;

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
    pub shots: Option<ShotsFile>,
    #[serde(default)]
    pub case: Vec<Spanned<CaseFile>>,
}

with_common_keys!(case_file! {
    {
        hyperelastic_length: Spanned<f64>,
        section: SectionName,
        half_length: Spanned<f64>,
        height: Spanned<f64>,
        width: Spanned<f64>,
        layers: Spanned<i64>,
        rows: Spanned<i64>,
        columns: Spanned<i64>,
        striker: StrikerName,
        held: Spanned<bool>,
        outputs: Outputs,
    }
});

impl CaseFile {
    pub fn striker(&self) -> StrikerName {
        self.striker.unwrap_or(StrikerName::Cylinder)
    }

    /// A key of this table that none of these cases reads: its place, and the message.
    pub fn unused(&self, cases: &[&CaseFile]) -> Unused {
        let keys: Vec<&Keys> = cases.iter().map(|case| &case.keys).collect();
        self.keys.unused(&keys).or_else(|| self.unused_length(cases)).or_else(|| self.unused_cylinder(cases))
    }

    fn unused_length(&self, cases: &[&CaseFile]) -> Unused {
        let length = self.hyperelastic_length.as_ref()?;
        let message = format!(
            "hyperelastic-length is {}, which only a yarn of two laws has; allowed: with law = \"hybrid\"",
            length.get_ref()
        );
        cases.iter().all(|case| case.keys.law() != LawName::Hybrid).then(|| (length.span(), message))
    }

    /// A driven section meets nothing.
    fn unused_cylinder(&self, cases: &[&CaseFile]) -> Unused {
        let span = |value: &Option<Spanned<f64>>| value.as_ref().map(Spanned::span);
        let keys = [
            ("mass", span(&self.keys.mass)),
            ("radius", span(&self.keys.radius)),
            ("friction", span(&self.keys.friction)),
            ("contact-stiffness", span(&self.keys.contact_stiffness)),
            ("held", self.held.as_ref().map(Spanned::span)),
        ];
        let (key, span) = keys.into_iter().find_map(|(key, span)| Some((key, span?)))?;
        let message = format!("{key} belongs to a cylinder, and striker is driven; allowed: one of the two");
        cases.iter().all(|case| case.striker() == StrikerName::Driven).then_some((span, message))
    }
}
