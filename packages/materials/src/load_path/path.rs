//! A load path: an element, the materials that it is tried with, and the steps.

use std::fmt;

use nalgebra::{Unit, Vector3};

use super::element::Hexahedron;
use crate::material::model::Material;
use toron::host::units::UnitSystem;

/// An element, the materials it is run with, and its steps.
#[derive(Clone, Debug)]
pub struct LoadPath {
    pub title: String,
    pub units: UnitSystem,
    pub element: Hexahedron,
    /// One history each.
    pub points: Vec<Point>,
    /// In the order in which they run, cycles unrolled.
    pub steps: Vec<Step>,
    /// The column of the table that plots are drawn over.
    pub abscissa: String,
}

/// A variant of the path: its own material.
#[derive(Clone, Debug)]
pub struct Point {
    pub name: String,
    pub material: Material,
}

/// A step: targets that are reached by a ramp.
#[derive(Clone, Debug)]
pub struct Step {
    /// Empty where the file gives none.
    pub name: String,
    /// The step's place in the file, and which repetition of its group this is, both from 1.
    pub number: usize,
    pub cycle: usize,
    pub duration: f64,
    /// Where the increments end, as fractions of the step: rising, at most 1.
    pub fractions: Vec<f64>,
    /// In the order of [`COMPONENT_NAMES`](super::newton::COMPONENT_NAMES); `None` is controlled as before.
    pub targets: [Option<Target>; 9],
    /// Axis and angle (radians) of the rotation that the step adds on top.
    pub rotation: Option<(Unit<Vector3<f64>>, f64)>,
}

/// The prescribed value of a component at the end of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Component of F at the end of the step.
    Gradient(f64),
    /// Component of the first Piola–Kirchhoff stress at the end of the step.
    Stress(f64),
    /// The component of F stays as the step finds it.
    Hold,
}

impl LoadPath {
    /// Number of increments of all points.
    pub fn increments(&self) -> usize {
        self.points.len() * self.steps.iter().map(|step| step.fractions.len()).sum::<usize>()
    }
}

impl LoadPath {
    /// By component, whether its stress is prescribed in this step: what a step does not name is controlled as before.
    pub fn stress_controlled(&self, step: usize) -> [bool; 9] {
        let mut controlled = [false; 9];
        for target in self.steps[..=step].iter().map(|step| step.targets) {
            for (controlled, target) in controlled.iter_mut().zip(target) {
                match target {
                    Some(Target::Stress(_)) => *controlled = true,
                    Some(Target::Gradient(_) | Target::Hold) => *controlled = false,
                    None => {}
                }
            }
        }
        controlled
    }
}

/// The ends of so many equal increments.
pub fn equal_parts(increments: usize) -> Vec<f64> {
    (1..=increments).map(|number| number as f64 / increments as f64).collect()
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "step {}", self.number)?;
        if !self.name.is_empty() {
            write!(f, " ({})", self.name)?;
        }
        if self.cycle > 1 {
            write!(f, ", cycle {}", self.cycle)?;
        }
        Ok(())
    }
}
