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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// For pictures. Default: the file's name.
    pub title: Option<String>,
    /// Of all values of the file, such as `mm-tonne-s`; [others](guides/load-paths.md#at-the-top).
    pub units: Spanned<String>,
    /// The [fibre](guides/cell.md#fibre).
    pub fibre: Spanned<FibreFile>,
    /// The [packing](guides/cell.md#cell).
    pub cell: Spanned<CellFile>,
    /// The [loads](guides/cell.md#loads).
    pub loads: Option<LoadsFile>,
    /// What goes into [`fit.toml`](guides/cell.md#yarn).
    pub yarn: Option<Spanned<YarnFile>>,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct FibreFile {
    /// Of a fibre.
    pub diameter: Positive,
    /// Modulus along the fibre.
    pub e_1: Positive,
    /// Modulus across the fibre.
    pub e_2: Positive,
    /// Contraction across over extension along, pulled along.
    pub nu_12: Spanned<f64>,
    /// The same in the section.
    pub nu_23: Spanned<f64>,
    /// Shear modulus along the fibre.
    pub g_12: Positive,
    /// Shear modulus in the section, within 2 % of its default. Default: e_2/(2 (1 + nu_23)).
    pub g_23: Option<Spanned<Positive>>,
    /// Goes into `fit.toml`. Default: none.
    pub density: Option<Positive>,
    /// Goes into `fit.toml`. Default: none.
    pub strain_at_failure: Option<Positive>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum PackingName {
    Hexagonal,
    Square,
    Random,
}

/// What computes the section.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum HostName {
    Calculix,
    Explicit,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct CellFile {
    /// How the fibres lie.
    pub packing: PackingName,
    /// What computes the section; a random packing has `explicit`. Default: `calculix`.
    pub host: Option<Spanned<HostName>>,
    /// A [box](guides/cell.md#cellbox) of many fibres. Default: the cell that symmetry leaves.
    #[serde(rename = "box")]
    pub walls: Option<Spanned<BoxFile>>,
    /// Between fibres; none on walls. Default: 0.2.
    pub friction: Option<Number<Friction>>,
    /// Along an eighth of a fibre's circumference: 12 n² in a whole fibre; 3 are the thesis's 108. Default: 8.
    pub elements: Option<Whole<1, 40>>,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    /// Of fibres; not of a random packing.
    pub rows: Option<Spanned<Whole<1, MOST_FIBRES>>>,
    /// Not of a random packing.
    pub fibres_in_row: Option<Spanned<Whole<2, MOST_FIBRES>>>,
    /// Of a random packing, in a square as small as they get stuck in.
    pub fibres: Option<Spanned<Whole<1, MOST_FIBRES>>>,
    /// Of a random packing. Default: 1.
    pub seed: Option<Spanned<u64>>,
}

#[derive(Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct LoadsFile {
    /// |I_tc| at the end of the compaction. Default: 0.12.
    pub largest: Option<Number<Invariant>>,
    /// I_td at the end of a compression. Default: `largest`.
    pub largest_distortion: Option<Number<Invariant>>,
    /// CalculiX takes more where it has to. Default: 24.
    pub increments: Option<Whole<1, 1000>>,
    /// `compaction` is F = diag(1, λ, λ), `along-rows` diag(1, λ, 1), `across-rows` diag(1, 1, λ). Default: all.
    pub kinds: Option<Spanned<Vec<Load>>>,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct YarnFile {
    /// Goes into `fit.toml`. Default: none.
    pub name: Option<Spanned<String>>,
    /// Goes into `fit.toml`. Default: none.
    pub source: Option<String>,
    /// Goes into `fit.toml`. Default: the packing's own.
    pub volume_fraction: Option<Fraction>,
}
