//! The tables of a scene's TOML file: the weave, the scene's own table and its cases'.

use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::Spanned;

use crate::scene_keys::keys::{Keys, Table, Target};
use crate::scene_keys::shots::ShotsFile;
use crate::weave::file::{PlyFile, WeaveFile};
use crate::weave::foreign::file::MeshFile;
use toron_materials::material::of_law::LawName;
use toron_shared::checked::{Checked, NotNegative, Positive};
use toron_shared::toml_file::{Numbers, Unused};

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
    #[serde(rename = "scene")]
    _scene: IgnoredAny,
    pub shots: Option<ShotsFile>,
    #[serde(rename = "case")]
    _case: Option<Vec<IgnoredAny>>,
}

/// The keys of a panel and of what strikes it.
#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct PanelKeys {
    pub weave: Option<Spanned<WeaveFile>>,
    pub ply: Option<Vec<PlyFile>>,
    pub mesh: Option<Spanned<MeshFile>>,
    shape: Option<ShapeName>,
    pub length: Option<Spanned<Positive>>,
    pub aim: Option<Spanned<Numbers<2>>>,
    pub striker_density: Option<Spanned<Positive>>,
    pub hyperelastic_radius: Option<Spanned<Positive>>,
    pub rim: Option<Rim>,
    pub yarn_friction: Option<NotNegative>,
    pub residual: Option<Spanned<bool>>,
    pub shred_mass: Option<Spanned<NotNegative>>,
}

/// How the yarns' ends at the panel's outline are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rim {
    Fixed,
    Free,
}

/// What strikes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
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
