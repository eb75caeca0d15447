//! The tables of a weave's TOML file.

use std::fmt;

use serde::de::{IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::de::DeValue;

use super::coarse::ROWS as COARSE_ROWS;
use super::foreign::file::MeshFile;
use super::geometry::Family;
use super::panel::{Centre, Part};
use super::section::Section;
use crate::cases::layered;
use toron_materials::material::file::MaterialFile;
use toron_shared::checked::{Positive, Whole};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{Numbers, Source};

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// For the picture. Default: the file's name.
    pub title: Option<String>,
    /// Of all values of the file, such as `mm-tonne-s`; [others](guides/load-paths.md#at-the-top).
    pub units: Spanned<String>,
    // Parsed here for their errors alone; the values are read by `cases::cases`, a case's table over the scene's.
    /// The [weave](reference/fabric-files.md#weave) and its panel.
    #[serde(rename = "weave")]
    _weave: Option<WeaveFile>,
    /// The [plies](reference/fabric-files.md#plies). Default: `[weave]` is the only one.
    #[serde(rename = "ply")]
    _ply: Option<Vec<PlyFile>>,
    /// A [mesh of your own](reference/fabric-files.md#a-mesh-of-your-own), in place of `[weave]`.
    #[serde(rename = "mesh")]
    _mesh: Option<MeshFile>,
    /// A [material](guides/load-paths.md#material), whose density gives areal and linear densities. Not in a strike,
    /// where the first case's does. Default: none.
    pub material: Option<Spanned<MaterialFile>>,
    /// The [strike](reference/fabric-files.md#scene), which `toron fabric` reads.
    #[cfg_attr(feature = "schema", schemars(with = "Option<toron_shared::schema::Anything>"))]
    pub scene: Option<IgnoredAny>,
    /// Cases of the strike.
    #[cfg_attr(feature = "schema", schemars(with = "Option<toron_shared::schema::Anything>"))]
    #[serde(rename = "case")]
    _case: Option<IgnoredAny>,
    /// A series of shots.
    #[cfg_attr(feature = "schema", schemars(with = "Option<toron_shared::schema::Anything>"))]
    #[serde(rename = "shots")]
    _shots: Option<IgnoredAny>,
}

/// The table `[weave]`.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct WeaveFile {
    /// `kevlar-s706`: plain, 34 by 34 yarns an inch, elliptic sections of 0.5337 by 0.115 mm. Other keys override it.
    /// Default: none; then its keys must be given.
    pub preset: Option<Spanned<String>>,
    /// `"plain"`, or for each warp yarn a row of `o` (over) and `u` (under) at the weft yarns along x. Twill 2/2:
    /// `["oouu", "uoou", "uuoo", "ouuo"]`; basket 2/2: `["oouu", "oouu", "uuoo", "uuoo"]`. Default: the preset's.
    pub pattern: Option<Spanned<PatternFile>>,
    /// The [warp yarns](reference/fabric-files.md#weavewarp), along x. Default: the preset's.
    pub warp: Option<Spanned<ThreadFile>>,
    /// The weft yarns, along y: the same keys. Default: the preset's or the warp's.
    pub weft: Option<Spanned<ThreadFile>>,
    /// Least distance between crossing yarns. Default: 1 µm.
    pub clearance: Option<Positive>,
    /// Elements along a yarn between crossings, an even number. Default: 8.
    pub along: Option<Spanned<Whole<2, 64>>>,
    /// Elements across a section. A panel has up to 10⁷ elements. Default: 6.
    pub columns: Option<Whole<1, 40>>,
    /// Elements through the height of a section. Default: 2.
    pub rows: Option<Whole<1, 20>>,
    /// The [panel](reference/fabric-files.md#weavepanel), whose outline all plies have.
    pub panel: Option<Spanned<PanelFile>>,
}

/// A table `[[ply]]`.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct PlyFile {
    /// Keys that differ from `[weave]`, such as `weave.warp.pitch`; of the panel its `centre` alone. Default: none.
    pub weave: Option<Spanned<WeaveFile>>,
    /// Degrees about z, from x to y. A rectangle's outline does not turn. A quarter needs multiples of 90, which
    /// exchange warp and weft. Default: 0.
    pub angle: Option<Spanned<f64>>,
    /// From the ply above, between the heights of their nearest nodes. Default: the clearance.
    pub distance: Option<Spanned<Positive>>,
    /// As in `[weave.warp]`; the ply's `weave.warp.material` overrides it. Default: the scene's.
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
    weave: &toml::Spanned<DeValue<'t>>,
    plies: &[toml::Spanned<DeValue<'t>>],
) -> Result<Vec<PlyTables>, Error> {
    if plies.is_empty() {
        return Ok(vec![of_ply(source, weave, None)?]);
    }
    plies.iter().map(|ply| of_ply(source, weave, Some(ply))).collect()
}

fn of_ply<'t>(
    source: &Source<'t>,
    weave: &toml::Spanned<DeValue<'t>>,
    ply: Option<&toml::Spanned<DeValue<'t>>>,
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

fn material_of<'a, 't>(
    weave: Option<&'a toml::Spanned<DeValue<'t>>>,
    family: Family,
) -> Option<&'a toml::Spanned<DeValue<'t>>> {
    weave?.get_ref().get(family.name())?.get_ref().get("material")
}

/// All plies have one outline.
fn check_panel_of_ply(source: &Source, weave: Option<&toml::Spanned<DeValue>>) -> Result<(), Error> {
    let Some(panel) = weave.and_then(|weave| weave.get_ref().get("panel")) else { return Ok(()) };
    if panel.get_ref().as_table().is_some_and(|panel| panel.keys().all(|key| key.get_ref() == "centre")) {
        return Ok(());
    }
    let message = "weave.panel of a [[ply]] has other keys than centre; allowed: these in [weave.panel], for all plies";
    Err(source.error(panel.span(), message))
}

#[derive(Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct ThreadFile {
    /// From one yarn of the family to the next. Default: the preset's.
    pub pitch: Option<Positive>,
    /// A `lens` is between two arcs of a circle. Default: `ellipse`.
    pub section: Option<Section>,
    /// Full width of the section. Default: the preset's.
    pub width: Option<Spanned<Positive>>,
    /// Full height of the section. Default: the preset's.
    pub height: Option<Spanned<Positive>>,
    /// In a strike: these yarns' [material](guides/load-paths.md#material), of the case's law; not with `hybrid`.
    /// Default: the scene's.
    pub material: Option<Spanned<MaterialFile>>,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ShapeName {
    Rectangle,
    Circle,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct PanelFile {
    /// `circle` has `radius`, `rectangle` has `half`. Required.
    pub shape: Option<ShapeName>,
    /// Of a circle.
    pub radius: Option<Spanned<Positive>>,
    /// Half sizes of a rectangle along x and y.
    pub half: Option<Spanned<Numbers<2, Positive>>>,
    /// A `quarter` is x ≥ 0 and y ≥ 0. Default: `whole`.
    pub part: Option<Spanned<Part>>,
    /// What lies at the origin: the crossing of the first row's first letter, or the `gap` before it. Default:
    /// `crossing`.
    pub centre: Option<Centre>,
    /// Crossings farther than this from the centre are [meshed
    /// coarsely](design/explicit-host.md#a-coarser-mesh-away-from-the-blow). It is larger than the striker's radius,
    /// with crossings on both sides; not in decks (`--deck`). Default: none.
    pub coarse_radius: Option<Spanned<Positive>>,
    /// Elements through the height of a coarse section. Default: 2.
    pub coarse_rows: Option<Spanned<Whole<1, COARSE_ROWS>>>,
}

/// A pattern's name, or its rows.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(untagged))]
pub enum PatternFile {
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["plain"])))]
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
