//! The tables of a weave's TOML file.

use std::fmt;

use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use super::panel::{Centre, Part};
use super::section::Section;
use crate::common::toml_file::Numbers;
use crate::material::file::MaterialFile;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub title: Option<String>,
    pub units: Spanned<String>,
    pub weave: Spanned<WeaveFile>,
    pub material: Option<Spanned<MaterialFile>>,
}

/// The table `[weave]`.
#[derive(Deserialize)]
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
    pub panel: Spanned<PanelFile>,
}

#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThreadFile {
    pub pitch: Option<Spanned<f64>>,
    pub section: Option<Section>,
    pub width: Option<Spanned<f64>>,
    pub height: Option<Spanned<f64>>,
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
    pub shape: ShapeName,
    pub radius: Option<Spanned<f64>>,
    pub half: Option<Spanned<Numbers<2>>>,
    pub part: Option<Spanned<Part>>,
    #[serde(default)]
    pub centre: Centre,
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
