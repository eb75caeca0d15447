//! The tables of a scene's TOML file: the scene's own and its cases', and which of their keys nothing reads.

use std::ops::Bound::Excluded;
use std::ops::Range;

use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::de::DeValue;

use super::scene::Walls;
use toron_shared::checked::{Bound, Fraction, Limits, NotNegative, Number, Positive, Whole};
use toron_shared::error::Error;
use toron_shared::spanned::Spanned;
use toron_shared::toml_file::{Source, Unused};
use toron_strikes::layers::CaseTable;

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

pub enum Share {}

impl Bound for Share {
    const ALLOWED: &'static str = "a number > 0 and < 1";
    const LIMITS: Limits = (Excluded(0.0), Excluded(1.0));
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct FibreFile {
    pub diameter: Option<Positive>,
    pub modulus: Option<Positive>,
    pub density: Option<Positive>,
    pub strain_at_failure: Option<Fraction>,
}

/// The scene's table, or a case's.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CaseFile {
    pub name: Option<Spanned<String>>,
    pub fibre: Option<Spanned<FibreFile>>,
    pub half_length: Option<Spanned<Positive>>,
    pub spacing: Option<Spanned<Positive>>,
    pub fibres: Option<Spanned<Whole<1, 100_000>>>,
    pub section: Option<SectionName>,
    pub aspect: Option<Spanned<Positive>>,
    pub width: Option<Spanned<Positive>>,
    pub height: Option<Spanned<Positive>>,
    pub packing: Option<PackingName>,
    pub seed: Option<Spanned<u64>>,
    pub contact: Option<Spanned<Vec<f64>>>,
    pub contact_length: Option<Positive>,
    pub friction: Option<NotNegative>,
    pub striker: Option<StrikerName>,
    pub speed: Option<Spanned<Positive>>,
    pub ramp: Option<Spanned<NotNegative>>,
    pub radius: Option<Spanned<Positive>>,
    pub mass: Option<Spanned<Positive>>,
    pub held: Option<Spanned<bool>>,
    pub projectile_friction: Option<Spanned<NotNegative>>,
    pub projectile_stiffness: Option<Spanned<Positive>>,
    pub end: Option<Positive>,
    pub sample: Option<Spanned<f64>>,
    pub pictures: Option<Spanned<Vec<f64>>>,
    pub step: Option<Spanned<f64>>,
    pub walls: Option<Spanned<Walls>>,
    pub closing: Option<Spanned<Number<Share>>>,
    pub damping: Option<Spanned<NotNegative>>,
    pub pressure: Option<Spanned<Positive>>,
    pub reload: Option<Spanned<bool>>,
    pub preset: Option<Spanned<String>>,
    pub law: Option<Spanned<String>>,
}

impl CaseFile {
    pub fn striker(&self) -> StrikerName {
        self.striker.unwrap_or(StrikerName::Cylinder)
    }

    pub fn is_biaxial(&self) -> bool {
        let walls = self.walls.as_ref().is_some_and(|walls| *walls.get_ref() == Walls::Biaxial);
        self.striker() == StrikerName::Walls && walls
    }

    pub fn section(&self) -> SectionName {
        self.section.unwrap_or(SectionName::Circle)
    }

    pub fn packing(&self) -> PackingName {
        self.packing.unwrap_or(PackingName::Hexagonal)
    }
}

impl CaseTable for CaseFile {
    fn read(source: &Source, table: &toml::Spanned<DeValue>) -> Result<CaseFile, Error> {
        source.read(table)
    }

    fn name(&self) -> Option<&Spanned<String>> {
        self.name.as_ref()
    }

    fn unused(&self, cases: &[&CaseFile]) -> Unused {
        let strikers = |allowed: &[StrikerName]| cases.iter().any(|case| allowed.contains(&case.striker()));
        let strikes = strikers(&[StrikerName::Cylinder]);
        let drives = strikers(&[StrikerName::Driven]);
        let along = strikers(&[StrikerName::Cylinder, StrikerName::Driven]);
        let presses = strikers(&[StrikerName::Walls]);
        let keeps_pressure = cases.iter().any(|case| case.is_biaxial());
        let sections = |allowed: &[SectionName]| cases.iter().any(|case| allowed.contains(&case.section()));
        let is_random = cases.iter().any(|case| case.packing() == PackingName::Random);
        let cylinder = "a cylinder; allowed: with striker = \"cylinder\"";
        let driven = "striker = \"driven\"; allowed: with that";
        let struck = "fibres that are struck along a yarn; allowed: with striker = \"cylinder\" or \"driven\"";
        let walls = "striker = \"walls\"; allowed: with that";
        let biaxial = "walls = \"biaxial\"; allowed: with that";
        let round = "a circle or an ellipse; allowed: with section = \"circle\" or \"ellipse\"";
        let ellipse = "an ellipse; allowed: with section = \"ellipse\"";
        let long = "an ellipse or a box; allowed: with section = \"ellipse\" or \"box\"";
        let random = "a random packing; allowed: with packing = \"random\"";
        let keys = [
            ("mass", place(&self.mass), strikes, cylinder),
            ("radius", place(&self.radius), strikes, cylinder),
            ("held", place(&self.held), strikes, cylinder),
            ("projectile-friction", place(&self.projectile_friction), strikes, cylinder),
            ("projectile-stiffness", place(&self.projectile_stiffness), strikes, cylinder),
            ("law", place(&self.law), strikes, cylinder),
            ("ramp", place(&self.ramp), drives, driven),
            ("half-length", place(&self.half_length), along, struck),
            ("spacing", place(&self.spacing), along, struck),
            ("speed", place(&self.speed), along, struck),
            ("walls", place(&self.walls), presses, walls),
            ("closing", place(&self.closing), presses, walls),
            ("damping", place(&self.damping), presses, walls),
            ("reload", place(&self.reload), presses, walls),
            ("pressure", place(&self.pressure), keeps_pressure, biaxial),
            ("preset", place(&self.preset), presses, walls),
            ("width", place(&self.width), sections(&[SectionName::Circle, SectionName::Ellipse]), round),
            ("height", place(&self.height), sections(&[SectionName::Ellipse]), ellipse),
            ("aspect", place(&self.aspect), sections(&[SectionName::Ellipse, SectionName::Box]), long),
            ("seed", place(&self.seed), is_random, random),
        ];
        let (key, span, _, message) = keys.into_iter().find(|(_, span, is_read, _)| span.is_some() && !is_read)?;
        Some((span?, format!("{key} belongs to {message}")))
    }
}

fn place<T>(value: &Option<Spanned<T>>) -> Option<Range<usize>> {
    value.as_ref().map(Spanned::span)
}
