//! A scene: a yarn, what strikes it, and the cases that differ from one another.

use serde::Deserialize;

use crate::explicit::contact::Rigid;
use crate::explicit::medium::Control;
use crate::explicit::mesh::Yarn;
use crate::material::model::Material;
use toron::host::units::UnitSystem;

/// The cases of a file, and what they have in common.
#[derive(Clone, Debug)]
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub cases: Vec<Case>,
    /// The quantity that the cases' residual speeds are plotted over.
    pub abscissa: Option<Abscissa>,
}

/// A quantity in which cases differ.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Abscissa {
    Elements,
    ContactStiffness,
}

/// One run.
#[derive(Clone, Debug)]
pub struct Case {
    pub name: String,
    pub yarn: Yarn,
    pub zones: Zones,
    pub striker: Striker,
    /// Speed of the projectile, or of the section that is driven.
    pub speed: f64,
    pub end: f64,
    /// Time between two samples of the history.
    pub sample: f64,
    /// When the yarn is drawn, and how many files ParaView gets after the first.
    pub pictures: Vec<f64>,
    pub frames: usize,
    pub control: Control,
    pub precision: Precision,
    pub outputs: Outputs,
}

/// What the yarn is made of, from mid-span outwards.
#[derive(Clone, Debug)]
pub enum Zones {
    One(Box<Material>),
    /// The first material up to this distance from mid-span, in whole layers.
    Two(Box<[Material; 2]>, f64),
}

impl Zones {
    /// The material at mid-span.
    pub fn inner(&self) -> &Material {
        &self.materials()[0]
    }

    pub fn materials(&self) -> &[Material] {
        match self {
            Zones::One(material) => std::slice::from_ref(&**material),
            Zones::Two(materials, _) => &materials[..],
        }
    }
}

/// What sets the yarn in motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Striker {
    /// A rigid cylinder: its whole mass, which has no influence where its speed is held.
    Cylinder { cylinder: Rigid, mass: f64, held: bool },
    /// The section at mid-span is driven itself.
    Driven,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    F64,
    F32,
}

/// The outputs of the law in every step.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Outputs {
    /// Stress, energies, invariants.
    Full,
    /// Stress; the rest for the samples only.
    Stress,
}
