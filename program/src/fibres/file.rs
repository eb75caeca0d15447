//! The tables of a scene's TOML file: the scene's own and its cases', and which of their keys nothing reads.

use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::Spanned;
use toml::de::DeValue;

use super::scene::Walls;
use crate::common::layers::CaseTable;
use toron_shared::error::Error;
use toron_shared::toml_file::{Source, Unused};

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum SectionName {
    Circle,
    Ellipse,
    Box,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum PackingName {
    Hexagonal,
    Random,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum StrikerName {
    Cylinder,
    Driven,
    Walls,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub title: Option<String>,
    pub units: Spanned<String>,
    // Scene and cases are read in layers.
    #[serde(rename = "scene")]
    _scene: IgnoredAny,
    #[serde(rename = "case")]
    _case: Option<Vec<IgnoredAny>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct FibreFile {
    pub diameter: Option<Spanned<f64>>,
    pub modulus: Option<Spanned<f64>>,
    pub density: Option<Spanned<f64>>,
    pub strain_at_failure: Option<Spanned<f64>>,
}

/// The scene's table, or a case's.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CaseFile {
    pub name: Option<Spanned<String>>,
    pub fibre: Option<Spanned<FibreFile>>,
    pub half_length: Option<Spanned<f64>>,
    pub spacing: Option<Spanned<f64>>,
    pub fibres: Option<Spanned<i64>>,
    pub section: Option<SectionName>,
    pub aspect: Option<Spanned<f64>>,
    pub width: Option<Spanned<f64>>,
    pub height: Option<Spanned<f64>>,
    pub packing: Option<PackingName>,
    pub seed: Option<Spanned<i64>>,
    pub contact: Option<Spanned<Vec<f64>>>,
    pub contact_length: Option<Spanned<f64>>,
    pub friction: Option<Spanned<f64>>,
    pub striker: Option<StrikerName>,
    pub speed: Option<Spanned<f64>>,
    pub ramp: Option<Spanned<f64>>,
    pub radius: Option<Spanned<f64>>,
    pub mass: Option<Spanned<f64>>,
    pub held: Option<Spanned<bool>>,
    pub projectile_friction: Option<Spanned<f64>>,
    pub projectile_stiffness: Option<Spanned<f64>>,
    pub end: Option<Spanned<f64>>,
    pub sample: Option<Spanned<f64>>,
    pub pictures: Option<Spanned<Vec<f64>>>,
    pub step: Option<Spanned<f64>>,
    pub walls: Option<Spanned<Walls>>,
    pub closing: Option<Spanned<f64>>,
    pub damping: Option<Spanned<f64>>,
    pub preset: Option<Spanned<String>>,
    pub law: Option<Spanned<String>>,
}

impl CaseFile {
    pub fn striker(&self) -> StrikerName {
        self.striker.unwrap_or(StrikerName::Cylinder)
    }

    pub fn section(&self) -> SectionName {
        self.section.unwrap_or(SectionName::Circle)
    }

    pub fn packing(&self) -> PackingName {
        self.packing.unwrap_or(PackingName::Hexagonal)
    }
}

impl CaseTable for CaseFile {
    fn read(source: &Source, table: &Spanned<DeValue>) -> Result<CaseFile, Error> {
        source.read(table)
    }

    fn name(&self) -> Option<&Spanned<String>> {
        self.name.as_ref()
    }

    fn unused(&self, cases: &[&CaseFile]) -> Unused {
        let number = |value: &Option<Spanned<f64>>| value.as_ref().map(Spanned::span);
        let strikers = |allowed: &[StrikerName]| cases.iter().any(|case| allowed.contains(&case.striker()));
        let strikes = strikers(&[StrikerName::Cylinder]);
        let drives = strikers(&[StrikerName::Driven]);
        let along = strikers(&[StrikerName::Cylinder, StrikerName::Driven]);
        let presses = strikers(&[StrikerName::Walls]);
        let sections = |allowed: &[SectionName]| cases.iter().any(|case| allowed.contains(&case.section()));
        let is_random = cases.iter().any(|case| case.packing() == PackingName::Random);
        let cylinder = "a cylinder; allowed: with striker = \"cylinder\"";
        let driven = "striker = \"driven\"; allowed: with that";
        let struck = "fibres that are struck along a yarn; allowed: with striker = \"cylinder\" or \"driven\"";
        let walls = "striker = \"walls\"; allowed: with that";
        let round = "a circle or an ellipse; allowed: with section = \"circle\" or \"ellipse\"";
        let ellipse = "an ellipse; allowed: with section = \"ellipse\"";
        let long = "an ellipse or a box; allowed: with section = \"ellipse\" or \"box\"";
        let random = "a random packing; allowed: with packing = \"random\"";
        let keys = [
            ("mass", number(&self.mass), strikes, cylinder),
            ("radius", number(&self.radius), strikes, cylinder),
            ("held", self.held.as_ref().map(Spanned::span), strikes, cylinder),
            ("projectile-friction", number(&self.projectile_friction), strikes, cylinder),
            ("projectile-stiffness", number(&self.projectile_stiffness), strikes, cylinder),
            ("law", self.law.as_ref().map(Spanned::span), strikes, cylinder),
            ("ramp", number(&self.ramp), drives, driven),
            ("half-length", number(&self.half_length), along, struck),
            ("spacing", number(&self.spacing), along, struck),
            ("speed", number(&self.speed), along, struck),
            ("walls", self.walls.as_ref().map(Spanned::span), presses, walls),
            ("closing", number(&self.closing), presses, walls),
            ("damping", number(&self.damping), presses, walls),
            ("preset", self.preset.as_ref().map(Spanned::span), presses, walls),
            ("width", number(&self.width), sections(&[SectionName::Circle, SectionName::Ellipse]), round),
            ("height", number(&self.height), sections(&[SectionName::Ellipse]), ellipse),
            ("aspect", number(&self.aspect), sections(&[SectionName::Ellipse, SectionName::Box]), long),
            ("seed", self.seed.as_ref().map(Spanned::span), is_random, random),
        ];
        let (key, span, _, message) = keys.into_iter().find(|(_, span, is_read, _)| span.is_some() && !is_read)?;
        Some((span?, format!("{key} belongs to {message}")))
    }
}
