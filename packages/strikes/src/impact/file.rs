//! The tables of a scene's TOML file: the scene's own and its cases', and which of their keys nothing reads.

use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::Spanned;

use super::scene::{Abscissa, Outputs};
use crate::scene_keys::keys::{Keys, Table, Target};
use crate::scene_keys::shots::ShotsFile;
use toron_materials::material::of_law::LawName;
use toron_shared::checked::{Checked, Positive, Whole};
use toron_shared::toml_file::Unused;

/// An element takes some 700 bytes: more do not fit most memories.
pub const MOST_ELEMENTS: usize = 10_000_000;

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
    // Scene and cases are read in layers.
    #[serde(rename = "scene")]
    _scene: IgnoredAny,
    pub shots: Option<ShotsFile>,
    #[serde(rename = "case")]
    _case: Option<Vec<IgnoredAny>>,
}

/// The keys of a yarn and of what strikes it.
#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct YarnKeys {
    pub hyperelastic_length: Option<Spanned<Positive>>,
    pub section: Option<SectionName>,
    pub half_length: Option<Positive>,
    pub height: Option<Positive>,
    pub width: Option<Positive>,
    pub layers: Option<Whole<1, MOST_ELEMENTS>>,
    pub rows: Option<Whole<1, MOST_ELEMENTS>>,
    pub columns: Option<Spanned<Whole<1, MOST_ELEMENTS>>>,
    striker: Option<StrikerName>,
    pub held: Option<Spanned<bool>>,
    pub outputs: Option<Outputs>,
}

impl YarnKeys {
    pub fn striker(&self) -> StrikerName {
        self.striker.unwrap_or(StrikerName::Cylinder)
    }
}

impl Target for YarnKeys {
    fn unused(table: &Table<YarnKeys>, cases: &[&Table<YarnKeys>]) -> Unused {
        let keys: Vec<&Keys> = cases.iter().map(|case| &case.common).collect();
        table.common.unused(&keys).or_else(|| table.unused_length(&keys)).or_else(|| table.unused_cylinder(cases))
    }
}

impl Table<YarnKeys> {
    fn unused_length(&self, cases: &[&Keys]) -> Unused {
        let length = self.target.hyperelastic_length.as_ref()?;
        let message = format!(
            "hyperelastic-length is {}, which only a yarn of two laws has; allowed: with law = \"hybrid\"",
            length.value()
        );
        cases.iter().all(|case| case.law() != LawName::Hybrid).then(|| (length.span(), message))
    }

    /// A driven section meets nothing.
    fn unused_cylinder(&self, cases: &[&Self]) -> Unused {
        let span = |value: &Option<Spanned<Positive>>| value.as_ref().map(Spanned::span);
        let keys = [
            ("mass", span(&self.common.mass)),
            ("radius", span(&self.common.radius)),
            ("friction", self.common.friction.as_ref().map(Spanned::span)),
            ("contact-stiffness", span(&self.common.contact_stiffness)),
            ("held", self.target.held.as_ref().map(Spanned::span)),
        ];
        let (key, span) = keys.into_iter().find_map(|(key, span)| Some((key, span?)))?;
        let message = format!("{key} belongs to a cylinder, and striker is driven; allowed: one of the two");
        cases.iter().all(|case| case.target.striker() == StrikerName::Driven).then_some((span, message))
    }
}
