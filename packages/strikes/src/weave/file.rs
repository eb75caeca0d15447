//! The tables of a weave's TOML file.

use std::fmt;

use serde::de::{IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use super::foreign::file::MeshFile;
use super::geometry::Family;
use super::panel::{Centre, Part};
use super::section::Section;
use toron_materials::material::file::MaterialFile;
use toron_shared::toml_file::{Numbers, over};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub title: Option<String>,
    pub units: Spanned<String>,
    pub weave: Option<Spanned<WeaveFile>>,
    #[serde(default)]
    pub ply: Vec<Spanned<PlyFile>>,
    pub mesh: Option<Spanned<MeshFile>>,
    pub material: Option<Spanned<MaterialFile>>,
    /// How the panel is struck, which is nothing to its mesh.
    pub scene: Option<IgnoredAny>,
    #[serde(rename = "case")]
    _case: Option<IgnoredAny>,
    #[serde(rename = "shots")]
    _shots: Option<IgnoredAny>,
}

/// The table `[weave]`, and what a case has otherwise.
#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WeaveFile {
    pub preset: Option<Spanned<String>>,
    pub pattern: Option<Spanned<PatternFile>>,
    pub warp: Option<Spanned<ThreadFile>>,
    pub weft: Option<Spanned<ThreadFile>>,
    pub clearance: Option<Spanned<f64>>,
    pub along: Option<Spanned<i64>>,
    pub columns: Option<Spanned<i64>>,
    pub rows: Option<Spanned<i64>>,
    pub panel: Option<Spanned<PanelFile>>,
}

impl WeaveFile {
    /// What the yarns of a family are made of, other than the rest.
    pub fn material(&self, family: Family) -> Option<Spanned<MaterialFile>> {
        let thread = if family == Family::Warp { &self.warp } else { &self.weft };
        thread.as_ref()?.get_ref().material.clone()
    }

    /// This table, with the keys of `base` where it has none. One with a preset of its own has its yarns from there.
    pub fn over(&self, base: &WeaveFile) -> WeaveFile {
        let (own, mut base) = (self.clone(), base.clone());
        if own.preset.is_some() {
            (base.pattern, base.warp, base.weft) = (None, None, None);
        }
        WeaveFile {
            preset: own.preset.or(base.preset),
            pattern: own.pattern.or(base.pattern),
            warp: over(&own.warp, &base.warp, ThreadFile::over),
            weft: over(&own.weft, &base.weft, ThreadFile::over),
            clearance: own.clearance.or(base.clearance),
            along: own.along.or(base.along),
            columns: own.columns.or(base.columns),
            rows: own.rows.or(base.rows),
            panel: over(&own.panel, &base.panel, PanelFile::over),
        }
    }
}

/// A table `[[ply]]`.
#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlyFile {
    /// What it has otherwise than `[weave]`.
    pub weave: Option<Spanned<WeaveFile>>,
    /// By which it is turned, in degrees.
    pub angle: Option<Spanned<f64>>,
    /// From the ply above it.
    pub distance: Option<Spanned<f64>>,
    /// For who strikes the panel: what its yarns are made of, other than the rest.
    pub material: Option<Spanned<MaterialFile>>,
}

impl PlyFile {
    /// The material of a family in this ply, where `weave` is the table `[weave]`: the ply's own key goes before the
    /// weave's.
    pub fn material(&self, weave: &WeaveFile, family: Family) -> Option<Spanned<MaterialFile>> {
        let own = self.weave.as_ref().and_then(|own| own.get_ref().material(family));
        let own = over(&own, &self.material, MaterialFile::over);
        over(&own, &weave.material(family), MaterialFile::over)
    }
}

#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThreadFile {
    pub pitch: Option<Spanned<f64>>,
    pub section: Option<Section>,
    pub width: Option<Spanned<f64>>,
    pub height: Option<Spanned<f64>>,
    /// For who strikes the panel: what these yarns are made of, other than the rest.
    pub material: Option<Spanned<MaterialFile>>,
}

impl ThreadFile {
    fn over(&self, base: &ThreadFile) -> ThreadFile {
        let (own, base) = (self.clone(), base.clone());
        ThreadFile {
            pitch: own.pitch.or(base.pitch),
            section: own.section.or(base.section),
            width: own.width.or(base.width),
            height: own.height.or(base.height),
            material: over(&own.material, &base.material, MaterialFile::over),
        }
    }
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum ShapeName {
    Rectangle,
    Circle,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PanelFile {
    pub shape: Option<ShapeName>,
    pub radius: Option<Spanned<f64>>,
    pub half: Option<Spanned<Numbers<2>>>,
    pub part: Option<Spanned<Part>>,
    pub centre: Option<Centre>,
    #[serde(rename = "coarse-radius")]
    pub coarse_radius: Option<Spanned<f64>>,
    #[serde(rename = "coarse-rows")]
    pub coarse_rows: Option<Spanned<i64>>,
}

impl PanelFile {
    /// A case's own shape has its own size.
    fn over(&self, base: &PanelFile) -> PanelFile {
        let (own, base) = (self.clone(), base.clone());
        let other_shape = own.shape.zip(base.shape).is_some_and(|(own, base)| own != base);
        PanelFile {
            shape: own.shape.or(base.shape),
            radius: if other_shape { own.radius } else { own.radius.or(base.radius) },
            half: if other_shape { own.half } else { own.half.or(base.half) },
            part: own.part.or(base.part),
            centre: own.centre.or(base.centre),
            coarse_radius: own.coarse_radius.or(base.coarse_radius),
            coarse_rows: own.coarse_rows.or(base.coarse_rows),
        }
    }
}

/// A pattern's name, or its rows.
#[derive(Clone)]
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
