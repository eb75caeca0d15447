//! A scene: a yarn, what strikes it, and the cases that differ from one another.

use serde::Deserialize;

use crate::scene_keys::shots::Shots;
pub use crate::scene_keys::zones::Zones;
use crate::strength::scatter::Strength;
use toron::host::units::UnitSystem;
use toron_explicit_host::contact::RigidSurface;
use toron_explicit_host::medium::Control;
use toron_explicit_host::mesh::Yarn;
use toron_explicit_host::struck::plan::Plan;

/// What symmetry leaves out.
pub const LEFT_OUT: &str = "the other half of a yarn";

/// The cases of a file, and what they have in common.
#[derive(Clone, Debug)]
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub cases: Vec<Case>,
    /// The series that `toron v50` fires.
    pub shots: Option<Shots>,
    /// The quantity that the cases' residual speeds are plotted over.
    pub abscissa: Option<Abscissa>,
}

/// A quantity in which cases differ.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// Where it scatters, in place of the material's.
    pub strength: Option<Strength>,
    pub striker: Striker,
    /// Speed of the projectile, or of the section that is driven.
    pub speed: f64,
    pub plan: Plan,
    pub control: Control,
    pub single_precision: bool,
    pub outputs: Outputs,
}

/// What sets the yarn in motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Striker {
    /// A rigid cylinder: its whole mass, which has no influence where its speed is held.
    Cylinder { cylinder: RigidSurface, mass: f64, held: bool },
    /// The section at mid-span is driven itself.
    Driven,
}

/// The outputs of the law in every step.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Outputs {
    /// Stress, energies, invariants.
    Full,
    /// Stress; the rest for the samples only.
    Stress,
}
