//! The tables of a scene's TOML file: the scene's own and its cases', and which of their keys nothing reads.

use serde::Deserialize;
use toml::Spanned;

use super::scene::Walls;
use toron_shared::toml_file::{Unused, over};

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
    pub scene: Spanned<CaseFile>,
    #[serde(default)]
    pub case: Vec<Spanned<CaseFile>>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct FibreFile {
    pub diameter: Option<Spanned<f64>>,
    pub modulus: Option<Spanned<f64>>,
    pub density: Option<Spanned<f64>>,
    pub strain_at_failure: Option<Spanned<f64>>,
}

/// The scene's table, and what a case has otherwise.
#[derive(Clone, Deserialize)]
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

impl FibreFile {
    fn over(&self, base: &FibreFile) -> FibreFile {
        let (own, base) = (self.clone(), base.clone());
        FibreFile {
            diameter: own.diameter.or(base.diameter),
            modulus: own.modulus.or(base.modulus),
            density: own.density.or(base.density),
            strain_at_failure: own.strain_at_failure.or(base.strain_at_failure),
        }
    }
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

    /// A key of this table that none of these cases reads: its place, and the message.
    pub fn unused(&self, cases: &[&CaseFile]) -> Unused {
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

    /// This table, with the keys of `base` where it has none.
    pub fn over(&self, base: &CaseFile) -> CaseFile {
        let (own, base) = (self.clone(), base.clone());
        CaseFile {
            name: own.name,
            fibre: over(&own.fibre, &base.fibre, FibreFile::over),
            half_length: own.half_length.or(base.half_length),
            spacing: own.spacing.or(base.spacing),
            fibres: own.fibres.or(base.fibres),
            section: own.section.or(base.section),
            aspect: own.aspect.or(base.aspect),
            width: own.width.or(base.width),
            height: own.height.or(base.height),
            packing: own.packing.or(base.packing),
            seed: own.seed.or(base.seed),
            contact: own.contact.or(base.contact),
            contact_length: own.contact_length.or(base.contact_length),
            friction: own.friction.or(base.friction),
            striker: own.striker.or(base.striker),
            speed: own.speed.or(base.speed),
            ramp: own.ramp.or(base.ramp),
            radius: own.radius.or(base.radius),
            mass: own.mass.or(base.mass),
            held: own.held.or(base.held),
            projectile_friction: own.projectile_friction.or(base.projectile_friction),
            projectile_stiffness: own.projectile_stiffness.or(base.projectile_stiffness),
            end: own.end.or(base.end),
            sample: own.sample.or(base.sample),
            pictures: own.pictures.or(base.pictures),
            step: own.step.or(base.step),
            walls: own.walls.or(base.walls),
            closing: own.closing.or(base.closing),
            damping: own.damping.or(base.damping),
            preset: own.preset.or(base.preset),
            law: own.law.or(base.law),
        }
    }
}
