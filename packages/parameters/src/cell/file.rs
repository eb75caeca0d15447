//! The tables of a section's TOML file.

use std::ops::Bound::{Excluded, Included};

use serde::Deserialize;

use super::scene::Load;
use toron_shared::checked::{Bound, Fraction, Limits, Number, Positive, Whole};
use toron_shared::spanned::Spanned;

pub const MOST_FIBRES: usize = 1000;

/// Fibres pressed further than this have no voids left between them.
pub enum Invariant {}

impl Bound for Invariant {
    const ALLOWED: &'static str = "a number > 0, up to 0.2";
    const LIMITS: Limits = (Excluded(0.0), Included(0.2));
}

pub enum Friction {}

impl Bound for Friction {
    const ALLOWED: &'static str = "a number from 0 to 2";
    const LIMITS: Limits = (Included(0.0), Included(2.0));
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub title: Option<String>,
    pub units: Spanned<String>,
    pub fibre: Spanned<FibreFile>,
    pub cell: Spanned<CellFile>,
    pub loads: Option<LoadsFile>,
    pub yarn: Option<Spanned<YarnFile>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FibreFile {
    pub diameter: Positive,
    pub e_1: Positive,
    pub e_2: Positive,
    pub nu_12: Spanned<f64>,
    pub nu_23: Spanned<f64>,
    pub g_12: Positive,
    pub g_23: Option<Spanned<Positive>>,
    pub density: Option<Positive>,
    pub strain_at_failure: Option<Positive>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum PackingName {
    Hexagonal,
    Square,
    Random,
}

/// What computes the section.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum HostName {
    Calculix,
    Explicit,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellFile {
    pub packing: PackingName,
    pub host: Option<Spanned<HostName>>,
    #[serde(rename = "box")]
    pub walls: Option<Spanned<BoxFile>>,
    pub friction: Option<Number<Friction>>,
    pub elements: Option<Whole<1, 40>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    pub rows: Option<Spanned<Whole<1, MOST_FIBRES>>>,
    pub fibres_in_row: Option<Spanned<Whole<2, MOST_FIBRES>>>,
    pub fibres: Option<Spanned<Whole<1, MOST_FIBRES>>>,
    pub seed: Option<Spanned<u64>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadsFile {
    pub largest: Option<Number<Invariant>>,
    pub largest_distortion: Option<Number<Invariant>>,
    pub increments: Option<Whole<1, 1000>>,
    pub kinds: Option<Spanned<Vec<Load>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct YarnFile {
    pub name: Option<Spanned<String>>,
    pub source: Option<String>,
    pub volume_fraction: Option<Fraction>,
}
