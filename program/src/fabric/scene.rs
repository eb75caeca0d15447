//! A scene: a panel, what strikes it, and the cases that differ from one another.

use std::sync::Arc;

use crate::explicit::contact::Rigid;
use crate::explicit::medium::Control;
use crate::explicit::mutual_contact::Parameters;
use crate::material::model::Material;
use crate::weave::reader::Woven;
use toron::host::units::UnitSystem;

/// The cases of a file.
#[derive(Clone, Debug)]
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub cases: Vec<Case>,
}

/// One run.
#[derive(Clone, Debug)]
pub struct Case {
    pub name: String,
    /// The panel; cases without keys of their own for it have the same one.
    pub woven: Arc<Woven>,
    pub zones: Zones,
    /// The sphere, and the whole of its mass.
    pub sphere: Rigid,
    pub mass: f64,
    pub speed: f64,
    /// Whether the yarns' ends at the panel's outline are fixed.
    pub held: bool,
    /// Of yarns with one another.
    pub mutual: Parameters,
    pub control: Control,
    pub end: f64,
    /// Whether the run goes on when the sphere turns back.
    pub rebounds: bool,
    /// Time between two samples of the history.
    pub sample: f64,
    /// When the panel is drawn.
    pub pictures: Vec<f64>,
    /// How many files ParaView gets after the first.
    pub frames: usize,
    /// How many times the run writes what it takes to go on from there.
    pub checkpoints: usize,
    pub single_precision: bool,
}

/// What the yarns are made of, from the centre outwards.
#[derive(Clone, Debug)]
pub enum Zones {
    One(Box<Material>),
    /// The first material up to this distance from the centre.
    Two(Box<[Material; 2]>, f64),
}

impl Zones {
    /// The material at the centre.
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
