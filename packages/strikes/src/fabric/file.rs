//! The tables of a scene's TOML file: the weave, the scene's own table and its cases'.

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::scene_keys::keys::{Keys, Table, Target};
use crate::scene_keys::shots::ShotsFile;
use crate::weave::file::{PlyFile, WeaveFile};
use crate::weave::foreign::file::MeshFile;
use toron_materials::material::of_law::LawName;
use toron_shared::checked::{Checked, NotNegative, Positive};
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{Numbers, Unused};

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// For the pictures. Default: the file's name.
    pub title: Option<String>,
    /// Of all values of the file, such as `mm-tonne-s`; [others](guides/load-paths.md#at-the-top).
    pub units: Spanned<String>,
    // Parsed here for their errors alone; the values are read by `cases::cases`, a case's table over the scene's.
    /// The [weave](reference/fabric-files.md#weave) and its panel.
    #[serde(rename = "weave")]
    _weave: Option<WeaveFile>,
    /// The [plies](reference/fabric-files.md#plies), from the struck one downwards. Default: `[weave]` is the only one.
    #[serde(rename = "ply")]
    _ply: Option<Vec<PlyFile>>,
    /// A [mesh of your own](reference/fabric-files.md#a-mesh-of-your-own), in place of `[weave]`.
    #[serde(rename = "mesh")]
    _mesh: Option<MeshFile>,
    /// The [strike](reference/fabric-files.md#scene).
    #[cfg_attr(feature = "schema", schemars(
        with = "toron_shared::schema::Both<Keys, PanelKeys>",
        transform = toron_shared::schema::without(&["name", "weave", "ply", "mesh"])
    ))]
    #[serde(rename = "scene")]
    _scene: IgnoredAny,
    /// A [series of shots](reference/v50-files.md#shots), which [`toron v50`](guides/v50.md) alone reads.
    pub shots: Option<ShotsFile>,
    /// A case: its `name`, and the keys of `[scene]`, `[weave]`, `[[ply]]` and `[mesh]` in which it differs. Default:
    /// one, `scene`.
    #[cfg_attr(feature = "schema", schemars(
        with = "Option<Vec<toron_shared::schema::Both<Keys, PanelKeys>>>",
        transform = toron_shared::schema::named
    ))]
    #[serde(rename = "case")]
    _case: Option<Vec<IgnoredAny>>,
}

/// The keys of a panel and of what strikes it.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(rename_all = "kebab-case")]
pub struct PanelKeys {
    /// In `[[case]]` alone: keys of [`[weave]`](reference/fabric-files.md#weave) in which the case differs. With a
    /// `preset` of its own it takes its yarns from there.
    pub weave: Option<Spanned<WeaveFile>>,
    /// In `[[case]]` alone: the case's own [plies](reference/fabric-files.md#plies).
    pub ply: Option<Vec<PlyFile>>,
    /// In `[[case]]` alone: its own [mesh](reference/fabric-files.md#a-mesh-of-your-own).
    pub mesh: Option<Spanned<MeshFile>>,
    /// Of the striker: a sphere, or a cylinder along z whose lower end is `flat` or a `hemisphere`. Default: `sphere`.
    shape: Option<ShapeName>,
    /// Whole length of a cylinder.
    pub length: Option<Spanned<Positive>>,
    /// Where the striker's axis passes the panel, within its outline (of a mesh, its box); the panel must be whole.
    /// Distances from the centre do not move with it. Not in decks. Default: `[0, 0]`.
    pub aim: Option<Spanned<Numbers<2>>>,
    /// Of the striker, in place of `mass`, or within 2 % of it; 100 to 23 000 kg/m³.
    pub striker_density: Option<Spanned<Positive>>,
    /// Of a `hybrid` panel, which needs it: elements nearer to the centre are hyperelastic.
    pub hyperelastic_radius: Option<Spanned<Positive>>,
    /// With `fixed` the yarns' ends at the outline do not move. Default: `fixed`.
    pub rim: Option<Rim>,
    /// Coulomb friction coefficient between yarns. Default: 0.18.
    pub yarn_friction: Option<NotNegative>,
    /// With `until = "decided"`: a decided run goes on until its speed is the residual one. Default: `false`.
    pub residual: Option<Spanned<bool>>,
    /// Part of the yarns' mass, up to 0.001, that [torn ends](design/explicit-host.md#torn-ends) may be lent in all.
    /// Default: 0.
    pub shred_mass: Option<Spanned<NotNegative>>,
}

/// How the yarns' ends at the panel's outline are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Rim {
    Fixed,
    Free,
}

/// What strikes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ShapeName {
    #[default]
    Sphere,
    /// Cylinders along z, by their lower end.
    Flat,
    Hemisphere,
}

impl PanelKeys {
    pub fn shape(&self) -> ShapeName {
        self.shape.unwrap_or_default()
    }
}

impl Target for PanelKeys {
    /// A material or a radius of this table that none of these cases has a law for, or a length that none has a
    /// cylinder for.
    fn unused(table: &Table<PanelKeys>, cases: &[&Table<PanelKeys>]) -> Unused {
        let keys: Vec<&Keys> = cases.iter().map(|case| &case.common).collect();
        let are_spheres = cases.iter().all(|case| case.target.shape() == ShapeName::Sphere);
        let of_sphere = table.target.length.as_ref().filter(|_| are_spheres).map(|length| {
            let message = format!("length is {}; allowed: with shape = \"flat\" or \"hemisphere\"", length.value());
            (length.span(), message)
        });
        table.common.unused(&keys).or(of_sphere).or_else(|| {
            let radius = table.target.hyperelastic_radius.as_ref()?;
            let message = format!("hyperelastic-radius is {}; allowed: with law = \"hybrid\"", radius.value());
            keys.iter().all(|keys| keys.law() != LawName::Hybrid).then(|| (radius.span(), message))
        })
    }
}
