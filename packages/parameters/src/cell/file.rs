//! The tables of a section's TOML file.

use serde::Deserialize;
use toml::Spanned;

use super::scene::Load;

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
    pub diameter: Spanned<f64>,
    pub e_1: Spanned<f64>,
    pub e_2: Spanned<f64>,
    pub nu_12: Spanned<f64>,
    pub nu_23: Spanned<f64>,
    pub g_12: Spanned<f64>,
    pub g_23: Option<Spanned<f64>>,
    pub density: Option<Spanned<f64>>,
    pub strain_at_failure: Option<Spanned<f64>>,
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
    pub friction: Option<Spanned<f64>>,
    pub elements: Option<Spanned<i64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    pub rows: Option<Spanned<i64>>,
    pub fibres_in_row: Option<Spanned<i64>>,
    pub fibres: Option<Spanned<i64>>,
    pub seed: Option<Spanned<i64>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadsFile {
    pub largest: Option<Spanned<f64>>,
    pub largest_distortion: Option<Spanned<f64>>,
    pub increments: Option<Spanned<i64>>,
    pub kinds: Option<Spanned<Vec<Load>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct YarnFile {
    pub name: Option<Spanned<String>>,
    pub source: Option<String>,
    pub volume_fraction: Option<Spanned<f64>>,
}
