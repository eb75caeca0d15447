//! The tables of a scene's TOML file: the scene's own and its cases', and which of their keys nothing reads.

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::scene::{Abscissa, Outputs};
use crate::scene_keys::keys::{Keys, Table, Target};
use crate::scene_keys::shots::ShotsFile;
use toron_materials::material::of_law::LawName;
use toron_shared::checked::{Checked, Positive, Whole};
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::Unused;

/// An element takes some 700 bytes: more do not fit most memories.
pub const MOST_ELEMENTS: usize = 10_000_000;

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum SectionName {
    Ellipse,
    Rectangle,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum StrikerName {
    Cylinder,
    Driven,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// For the pictures. Default: the file's name.
    pub title: Option<String>,
    /// Of all values of the file, such as `mm-tonne-s`; [others](guides/load-paths.md#at-the-top).
    pub units: Spanned<String>,
    /// The quantity over which the cases' residual speeds are plotted. Default: no such plot.
    pub abscissa: Option<Spanned<Abscissa>>,
    // Scene and cases are read in layers.
    /// The [strike](reference/impact-files.md#scene).
    #[cfg_attr(feature = "schema", schemars(
        with = "toron_shared::schema::Both<Keys, YarnKeys>",
        transform = toron_shared::schema::without(&["name"])
    ))]
    #[serde(rename = "scene")]
    _scene: IgnoredAny,
    /// A [series of shots](reference/v50-files.md#shots), which [`toron v50`](guides/v50.md) alone reads.
    pub shots: Option<ShotsFile>,
    /// A case: its `name`, and the keys of `[scene]` in which it differs. Default: one, `scene`.
    #[cfg_attr(feature = "schema", schemars(
        with = "Option<Vec<toron_shared::schema::Both<Keys, YarnKeys>>>",
        transform = toron_shared::schema::named
    ))]
    #[serde(rename = "case")]
    _case: Option<Vec<IgnoredAny>>,
}

/// The keys of a yarn and of what strikes it.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(rename_all = "kebab-case")]
pub struct YarnKeys {
    /// Of a `hybrid` yarn, which needs it: it is hyperelastic up to this distance from mid-span, in whole layers.
    pub hyperelastic_length: Option<Spanned<Positive>>,
    /// Of the yarn. Default: `ellipse`.
    pub section: Option<SectionName>,
    /// Half of the yarn between its clamps. Required.
    pub half_length: Option<Positive>,
    /// Of the section, along the blow. Required.
    pub height: Option<Positive>,
    /// Of the section, across the blow. Required.
    pub width: Option<Positive>,
    /// Elements along half the yarn. Required.
    pub layers: Option<Whole<1, MOST_ELEMENTS>>,
    /// Elements over the height. Required.
    pub rows: Option<Whole<1, MOST_ELEMENTS>>,
    /// Elements across the width, two at least of an ellipse. Required.
    pub columns: Option<Spanned<Whole<1, MOST_ELEMENTS>>>,
    /// Of `driven` the section at mid-span is moved at `speed`, and there is no `mass`, `radius`, `held`,
    /// `contact-stiffness` and `friction`. Default: `cylinder`.
    striker: Option<StrikerName>,
    /// `true` keeps the projectile's speed, and then no mass is needed. Default: `false`.
    pub held: Option<Spanned<bool>>,
    /// With `stress`, energies and invariants are computed for the history only. Default: `full`.
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
