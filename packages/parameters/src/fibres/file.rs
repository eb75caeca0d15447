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
use toron_strikes::cases::SceneTable;

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum SectionName {
    Circle,
    Ellipse,
    Box,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum PackingName {
    Hexagonal,
    Random,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum StrikerName {
    Cylinder,
    Driven,
    Walls,
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// For the pictures. Default: the file's name.
    pub title: Option<String>,
    /// Of all values of the file, such as `mm-tonne-s`; [others](guides/load-paths.md#at-the-top).
    pub units: Spanned<String>,
    // Scene and cases are read in layers.
    /// The [scene](reference/fibre-files.md#scene).
    #[cfg_attr(feature = "schema", schemars(with = "CaseFile", transform = toron_shared::schema::without(&["name"])))]
    #[serde(rename = "scene")]
    _scene: IgnoredAny,
    /// A case: its `name`, and the keys of `[scene]` in which it differs. Default: one, `scene`.
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<CaseFile>>", transform = toron_shared::schema::named))]
    #[serde(rename = "case")]
    _case: Option<Vec<IgnoredAny>>,
}

pub enum Share {}

impl Bound for Share {
    const ALLOWED: &'static str = "a number > 0 and < 1";
    const LIMITS: Limits = (Excluded(0.0), Excluded(1.0));
}

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct FibreFile {
    /// Of a fibre. Required.
    pub diameter: Option<Positive>,
    /// Along the fibre. Required.
    pub modulus: Option<Positive>,
    /// Of the fibre, without voids. Required.
    pub density: Option<Positive>,
    /// Without it no fibre breaks. Default: none.
    pub strain_at_failure: Option<Fraction>,
}

/// The scene's table, or a case's.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(inline, transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CaseFile {
    /// In `[[case]]` alone: of the case and its files. Required.
    pub name: Option<Spanned<String>>,
    /// The [fibre](reference/fibre-files.md#scenefibre). Required.
    pub fibre: Option<Spanned<FibreFile>>,
    /// From mid-span to the clamp; not of walls. Required.
    pub half_length: Option<Spanned<Positive>>,
    /// Between the beads of a fibre, rounded so that a whole number makes the half length; not of walls. Required.
    pub spacing: Option<Spanned<Positive>>,
    /// How many. Required.
    pub fibres: Option<Spanned<Whole<1, 100_000>>>,
    /// The fibres touch the walls of a `box`. Default: `circle`.
    pub section: Option<SectionName>,
    /// Width over height of an ellipse or a box. An ellipse grows until the fibres fit, a box of rows comes as near as
    /// whole rows can. Default: 1 of a box.
    pub aspect: Option<Spanned<Positive>>,
    /// In place of `aspect`: the width into which the fibres must go, also of a circle.
    pub width: Option<Spanned<Positive>>,
    /// Beside `width`: the height into which the fibres must go; not of a circle.
    pub height: Option<Spanned<Positive>>,
    /// `random` is as dense as fibres get stuck, cut out of a larger square. Default: `hexagonal`.
    pub packing: Option<PackingName>,
    /// Of a random packing. Default: 1.
    pub seed: Option<Spanned<u64>>,
    /// a₁, a₂, a₃ of the force a₁δ + a₂δ² + a₃δ³ between two fibres over the depth δ. One fibre needs none.
    pub contact: Option<Spanned<Vec<f64>>>,
    /// The length of fibre that this force belongs to. Default: the diameter.
    pub contact_length: Option<Positive>,
    /// Between fibres. Default: 0.
    pub friction: Option<NotNegative>,
    /// With `driven` the middle of the fibres is moved; `walls` press the section. Default: `cylinder`.
    pub striker: Option<StrikerName>,
    /// Not of walls.
    pub speed: Option<Spanned<Positive>>,
    /// Of a driven section: the duration in which the speed comes in, as half a cosine. Default: 64 spacings of the
    /// wave.
    pub ramp: Option<Spanned<NotNegative>>,
    /// Of the cylinder.
    pub radius: Option<Spanned<Positive>>,
    /// Of the whole cylinder.
    pub mass: Option<Spanned<Positive>>,
    /// Whether the cylinder keeps its speed. Default: `false`.
    pub held: Option<Spanned<bool>>,
    /// Between the cylinder and fibres. Default: 0.
    pub projectile_friction: Option<Spanned<NotNegative>>,
    /// Force over depth, on the contact's length of a fibre.
    pub projectile_stiffness: Option<Spanned<Positive>>,
    /// Of the run. Required.
    pub end: Option<Positive>,
    /// Time between two lines of the history. Default: `end`/200.
    pub sample: Option<Spanned<f64>>,
    /// Times at which the fibres are drawn. Default: none.
    pub pictures: Option<Spanned<Vec<f64>>>,
    /// The step, as a part of the largest stable one. Default: 0.4.
    pub step: Option<Spanned<f64>>,
    /// Which walls of the box close: all, or `top-and-bottom` or `sides` between the others that are held; `plates`,
    /// top and bottom without sides; `biaxial`, top and bottom between sides that keep a `pressure`. Default:
    /// `all-sides`.
    pub walls: Option<Spanned<Walls>>,
    /// Of the way between two walls, the part that is gone at the end.
    pub closing: Option<Spanned<Number<Share>>>,
    /// Of the brake between walls: its rate over the frequency √(a₁/m) of a bead on a contact. Default: 0.05.
    pub damping: Option<Spanned<NotNegative>>,
    /// Of a biaxial test's sides.
    pub pressure: Option<Spanned<Positive>>,
    /// Whether the walls open again and close once more, each in a third of the time. Default: `false`.
    pub reload: Option<Spanned<bool>>,
    /// Of walls: a yarn whose law is drawn beside. Default: none.
    pub preset: Option<Spanned<String>>,
    /// The `NAME.csv` of [`toron impact`](guides/impact.md) under the same blow with the same `pictures`, drawn beside;
    /// relative to the scene's folder. Default: none.
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

impl SceneTable for CaseFile {
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
