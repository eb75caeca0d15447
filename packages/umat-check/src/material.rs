//! The material that a law is asked about, and what is declared of it.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use nalgebra::Matrix3;

use super::expect::Expected;
use super::kinematics::Layout;

/// CMNAME, where none is given.
pub const DEFAULT_NAME: &str = "MATERIAL";

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Material {
    /// CMNAME.
    pub name: String,
    /// PROPS.
    pub properties: Vec<f64>,
    /// STATEV at the beginning, of NSTATV entries; SDVINI may change it.
    pub initial: Vec<f64>,
    /// STRESS at the beginning.
    #[serde(default)]
    pub stress: [f64; 6],
    /// NTENS: 6, 4 (plane strain, axisymmetric) or 3 (plane stress).
    pub components: usize,
    /// The largest separation of a cohesive element, over its thickness, by which strains are measured inside: they
    /// go up to [`LARGEST_SEPARATION`].
    #[serde(default)]
    pub separation: Option<f64>,
    /// The range of the principal stretches that are reached.
    pub stretch: [f64; 2],
    /// The norm of the logarithmic strain of one increment.
    pub increment: f64,
    pub temperature: f64,
    /// PREDEF, of the fields that are known.
    #[serde(default)]
    pub fields: Vec<f64>,
    /// DTIME.
    pub time_step: f64,
    pub traits: Traits,
    /// What NTENS = 4 is, where that is known.
    #[serde(default)]
    pub plane: Option<Plane>,
    /// Corotational axes, as with `*ORIENTATION`.
    pub orientation: bool,
    /// Without NLGEOM, on axes that turn: strains add up, and work is per volume that stays.
    #[serde(default)]
    pub small_strain: bool,
    /// Directions in the reference configuration, of length 1.
    pub fibres: Vec<[f64; 3]>,
    /// Of the random states.
    pub seed: u64,
    #[serde(default)]
    pub explicit: Explicit,
    /// The input of Abaqus that it is from, whether its `*USER MATERIAL` has UNSYMM, and what is to be said of it.
    #[serde(default)]
    pub deck: Option<String>,
    #[serde(default)]
    pub unsymmetric: Option<bool>,
    #[serde(default)]
    pub remarks: Vec<String>,
    /// What the subroutine is called in a library, where not UMAT or VUMAT.
    #[serde(default)]
    pub symbol: Option<String>,
    /// Known answers.
    #[serde(default)]
    pub expected: Vec<Expected>,
}

/// What elements have four components.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Plane {
    /// Without a strain across.
    Strain,
    Axisymmetric,
}

/// What Abaqus/Explicit alone has.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Explicit {
    /// Whether a VUMAT is called, not a UMAT.
    pub called: bool,
    /// Of the undeformed material.
    pub density: f64,
    /// DELETE of `*DEPVAR`: the number, from 1, of the state variable that is 0 where the point is deleted.
    pub deletion: Option<usize>,
    /// defgradOld and defgradNew are U, not R U.
    pub stretch_alone: bool,
    /// The library built for single precision, or why it could not be; none where there is no question of one.
    pub single: Option<Result<PathBuf, String>>,
}

/// What its author declares of a law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Traits {
    pub hyperelastic: bool,
    pub dissipative: bool,
    pub isotropic: bool,
}

impl Traits {
    pub const ALLOWED: &str = "hyperelastic, dissipative, isotropic";

    /// Declares a trait; whether there is one of this name.
    pub fn declare(&mut self, name: &str) -> bool {
        match name {
            "hyperelastic" => self.hyperelastic = true,
            "dissipative" => self.dissipative = true,
            "isotropic" => self.isotropic = true,
            _ => return false,
        }
        true
    }
}

/// NDI of so many components.
pub fn direct(components: usize) -> usize {
    match components {
        1 => 1,
        2 | 3 => 2,
        _ => 3,
    }
}

/// So many fields a call passes; those that are not known are 0.
pub const MOST_FIELDS: usize = 8;

/// What the largest separation is inside.
pub const LARGEST_SEPARATION: f64 = 0.1;

impl Material {
    pub fn layout(&self) -> Layout {
        Layout { components: self.components, traction: self.separation.is_some() }
    }

    /// What a strain of 1 inside is to the law.
    pub fn unit_of_strain(&self) -> f64 {
        self.separation.map_or(1.0, |largest| largest / LARGEST_SEPARATION)
    }

    /// Whether nothing shears or turns: trusses, shells of revolution, cohesive elements.
    pub fn is_diagonal(&self) -> bool {
        self.components < 3 || self.separation.is_some()
    }

    /// Whether the work done is known.
    pub fn has_work(&self) -> bool {
        self.components > 3 || self.separation.is_some()
    }

    /// J; of a separation there is none, nor without NLGEOM.
    pub fn volume(&self, f: &Matrix3<f64>) -> f64 {
        if self.separation.is_some() || self.small_strain { 1.0 } else { f.determinant() }
    }

    /// PREDEF and DPRED: fields stay as they are.
    pub fn passed_fields(&self) -> [[f64; MOST_FIELDS]; 2] {
        let mut fields = [[0.0; MOST_FIELDS]; 2];
        for (passed, field) in fields[0].iter_mut().zip(&self.fields) {
            *passed = *field;
        }
        fields
    }

    /// NDI.
    pub fn direct(&self) -> usize {
        if self.separation.is_some() { 1 } else { direct(self.components) }
    }

    /// Whether no strain 33 ever is.
    pub fn is_plane_strain(&self) -> bool {
        self.components == 4 && self.plane == Some(Plane::Strain)
    }
}

/// What a law reads of the deformation, found by changing one argument at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Reads {
    /// DFGRD1 alone: stress follows from the deformation and the state.
    Total,
    /// Strain increments alone.
    Rate,
    /// Both, or DFGRD0 too.
    Mixed,
}

impl Reads {
    pub fn name(self) -> &'static str {
        match self {
            Reads::Total => "total",
            Reads::Rate => "rate",
            Reads::Mixed => "mixed",
        }
    }
}
