//! A scene: a panel, what strikes it, and the cases that differ from one another.

use std::sync::Arc;

use crate::explicit::contact::Rigid;
use crate::explicit::medium::Control;
use crate::explicit::mutual_contact::Parameters;
use crate::struck::plan::Plan;
pub use crate::struck::zones::Zones;
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
    pub plan: Plan,
    pub single_precision: bool,
}
