//! The tables of a scene's TOML file: the weave, the scene's own table and its cases'.

use serde::Deserialize;
use toml::Spanned;

use crate::struck::keys::{Keys, case_file, with_common_keys};
use crate::struck::shots::ShotsFile;
use crate::weave::file::{PlyFile, WeaveFile};
use crate::weave::foreign::file::MeshFile;
use toron_materials::material::of_law::LawName;
use toron_shared::toml_file::{Numbers, Unused};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub title: Option<String>,
    pub units: Spanned<String>,
    pub weave: Option<Spanned<WeaveFile>>,
    #[serde(default)]
    pub ply: Vec<Spanned<PlyFile>>,
    pub mesh: Option<Spanned<MeshFile>>,
    pub scene: Spanned<CaseFile>,
    pub shots: Option<ShotsFile>,
    #[serde(default)]
    pub case: Vec<Spanned<CaseFile>>,
}

with_common_keys!(case_file! {
    {
        weave: Spanned<WeaveFile>,
        ply: Vec<Spanned<PlyFile>>,
        mesh: Spanned<MeshFile>,
        shape: ShapeName,
        length: Spanned<f64>,
        aim: Spanned<Numbers<2>>,
        striker_density: Spanned<f64>,
        hyperelastic_radius: Spanned<f64>,
        rim: Rim,
        yarn_friction: Spanned<f64>,
    }
});

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

impl CaseFile {
    pub fn shape(&self) -> ShapeName {
        self.shape.unwrap_or_default()
    }

    /// A material or a radius of this table that none of these cases has a law for, or a length that none has a
    /// cylinder for.
    pub fn unused(&self, cases: &[&CaseFile]) -> Unused {
        let keys: Vec<&Keys> = cases.iter().map(|case| &case.keys).collect();
        let length = self.length.as_ref().filter(|_| cases.iter().all(|case| case.shape() == ShapeName::Sphere));
        let of_sphere = length.map(|length| {
            let message = format!("length is {}; allowed: with shape = \"flat\" or \"hemisphere\"", length.get_ref());
            (length.span(), message)
        });
        self.keys.unused(&keys).or(of_sphere).or_else(|| {
            let radius = self.hyperelastic_radius.as_ref()?;
            let message = format!("hyperelastic-radius is {}; allowed: with law = \"hybrid\"", radius.get_ref());
            keys.iter().all(|keys| keys.law() != LawName::Hybrid).then(|| (radius.span(), message))
        })
    }
}
