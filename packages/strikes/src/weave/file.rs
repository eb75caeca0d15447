//! The tables of a weave's TOML file.

use std::fmt;

use serde::de::{IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;
use toml::de::DeValue;

use super::coarse::ROWS as COARSE_ROWS;
use super::foreign::file::MeshFile;
use super::geometry::Family;
use super::panel::{Centre, Part};
use super::section::Section;
use crate::layers::layered;
use toron_materials::material::file::MaterialFile;
use toron_shared::checked::{Positive, Whole};
use toron_shared::error::Error;
use toron_shared::toml_file::{Numbers, Source};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub title: Option<String>,
    pub units: Spanned<String>,
    // These are read in layers; here only what is wrong in them is found.
    #[serde(rename = "weave")]
    _weave: Option<WeaveFile>,
    #[serde(rename = "ply")]
    _ply: Option<Vec<PlyFile>>,
    #[serde(rename = "mesh")]
    _mesh: Option<MeshFile>,
    pub material: Option<Spanned<MaterialFile>>,
    /// How the panel is struck, which is nothing to its mesh.
    pub scene: Option<IgnoredAny>,
    #[serde(rename = "case")]
    _case: Option<IgnoredAny>,
    #[serde(rename = "shots")]
    _shots: Option<IgnoredAny>,
}

/// The table `[weave]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WeaveFile {
    pub preset: Option<Spanned<String>>,
    pub pattern: Option<Spanned<PatternFile>>,
    pub warp: Option<Spanned<ThreadFile>>,
    pub weft: Option<Spanned<ThreadFile>>,
    pub clearance: Option<Positive>,
    pub along: Option<Spanned<Whole<2, 64>>>,
    pub columns: Option<Whole<1, 40>>,
    pub rows: Option<Whole<1, 20>>,
    pub panel: Option<Spanned<PanelFile>>,
}

/// A table `[[ply]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlyFile {
    /// What it has otherwise than `[weave]`.
    pub weave: Option<Spanned<WeaveFile>>,
    /// By which it is turned, in degrees.
    pub angle: Option<Spanned<f64>>,
    /// From the ply above it.
    pub distance: Option<Spanned<Positive>>,
    /// For who strikes the panel: what its yarns are made of, other than the rest.
    pub material: Option<Spanned<MaterialFile>>,
}

/// A ply, with all that the tables above it say of its yarns.
pub struct PlyTables {
    /// Its own weave over `[weave]`.
    pub weave: Spanned<WeaveFile>,
    /// Of warp and weft: the ply's own key for the family, over the ply's, over the weave's.
    pub materials: [Option<Spanned<MaterialFile>>; 2],
    /// The table itself; none of the only ply of a weave without.
    pub own: Option<Spanned<PlyFile>>,
}

/// The plies of these tables; `[weave]` alone is one.
///
/// # Errors
/// A panel of a ply's own: all plies have one outline.
pub fn plies<'t>(
    source: &Source<'t>,
    weave: &Spanned<DeValue<'t>>,
    plies: &[Spanned<DeValue<'t>>],
) -> Result<Vec<PlyTables>, Error> {
    if plies.is_empty() {
        return Ok(vec![of_ply(source, weave, None)?]);
    }
    plies.iter().map(|ply| of_ply(source, weave, Some(ply))).collect()
}

fn of_ply<'t>(
    source: &Source<'t>,
    weave: &Spanned<DeValue<'t>>,
    ply: Option<&Spanned<DeValue<'t>>>,
) -> Result<PlyTables, Error> {
    let own = ply.and_then(|ply| ply.get_ref().get("weave"));
    check_panel_of_ply(source, own)?;
    let material = |family: Family| {
        let of_ply = ply.and_then(|ply| ply.get_ref().get("material"));
        let tables = [material_of(own, family), of_ply, material_of(Some(weave), family)];
        layered("material", tables).map(|table| source.read(&table)).transpose()
    };
    let materials = [material(Family::Warp)?, material(Family::Weft)?];
    let weave = layered("weave", [own, Some(weave)]).unwrap_or_else(|| weave.clone());
    Ok(PlyTables { weave: source.read(&weave)?, materials, own: ply.map(|ply| source.read(ply)).transpose()? })
}

fn material_of<'a, 't>(weave: Option<&'a Spanned<DeValue<'t>>>, family: Family) -> Option<&'a Spanned<DeValue<'t>>> {
    weave?.get_ref().get(family.name())?.get_ref().get("material")
}

/// All plies have one outline.
fn check_panel_of_ply(source: &Source, weave: Option<&Spanned<DeValue>>) -> Result<(), Error> {
    let Some(panel) = weave.and_then(|weave| weave.get_ref().get("panel")) else { return Ok(()) };
    if panel.get_ref().as_table().is_some_and(|panel| panel.keys().all(|key| key.get_ref() == "centre")) {
        return Ok(());
    }
    let message = "weave.panel of a [[ply]] has other keys than centre; allowed: these in [weave.panel], for all plies";
    Err(source.error(panel.span(), message))
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThreadFile {
    pub pitch: Option<Positive>,
    pub section: Option<Section>,
    pub width: Option<Spanned<Positive>>,
    pub height: Option<Spanned<Positive>>,
    /// For who strikes the panel: what these yarns are made of, other than the rest.
    pub material: Option<Spanned<MaterialFile>>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum ShapeName {
    Rectangle,
    Circle,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PanelFile {
    pub shape: Option<ShapeName>,
    pub radius: Option<Spanned<Positive>>,
    pub half: Option<Spanned<Numbers<2, Positive>>>,
    pub part: Option<Spanned<Part>>,
    pub centre: Option<Centre>,
    #[serde(rename = "coarse-radius")]
    pub coarse_radius: Option<Spanned<Positive>>,
    #[serde(rename = "coarse-rows")]
    pub coarse_rows: Option<Spanned<Whole<1, COARSE_ROWS>>>,
}

/// A pattern's name, or its rows.
pub enum PatternFile {
    Name(String),
    Rows(Vec<String>),
}

impl<'de> Deserialize<'de> for PatternFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PatternVisitor)
    }
}

struct PatternVisitor;

impl<'de> Visitor<'de> for PatternVisitor {
    type Value = PatternFile;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("\"plain\", or a list of rows such as [\"ou\", \"uo\"]")
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<PatternFile, E> {
        Ok(PatternFile::Name(name.to_string()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<PatternFile, A::Error> {
        let mut rows = Vec::new();
        while let Some(row) = list.next_element()? {
            rows.push(row);
        }
        Ok(PatternFile::Rows(rows))
    }
}
