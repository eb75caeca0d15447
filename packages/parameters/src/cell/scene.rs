//! What a scene of the section is: fibres, how they lie, and how they are loaded.

use serde::Deserialize;
use toron::host::units::UnitSystem;

/// A fibre, in the scene's units; axis 1 is along it.
#[derive(Clone, Debug)]
pub struct Fibre {
    pub diameter: f64,
    pub e_1: f64,
    pub e_2: f64,
    /// Contraction across over extension along, when pulled along.
    pub nu_12: f64,
    pub nu_23: f64,
    pub g_12: f64,
    pub g_23: f64,
    pub density: Option<f64>,
    pub strain_at_failure: Option<f64>,
}

impl Fibre {
    /// The modulus of its contact in plane strain: 1 over the in-plane compliance when it may not get longer,
    /// S22 − S12²/S11 with S22 = 1/E2, S12 = −ν12/E1, S11 = 1/E1.
    pub fn contact_modulus(&self) -> f64 {
        1.0 / (1.0 / self.e_2 - self.nu_12 * self.nu_12 / self.e_1)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    Hexagonal,
    Square,
}

/// A box of whole fibres.
#[derive(Clone, Debug, PartialEq)]
pub enum BoxOf {
    /// Rows; in hexagonal packing every other one has a fibre less.
    Rows { packing: Packing, rows: usize, fibres_in_row: usize },
    /// At random in a square, as dense as they get stuck.
    Random { fibres: usize, seed: u64 },
}

#[derive(Clone, Debug, PartialEq)]
pub enum Arrangement {
    /// What symmetry leaves of the packing.
    Cell(Packing),
    /// Between four rigid walls.
    Box(BoxOf),
}

impl Arrangement {
    /// Whether fibres lie at random: they rearrange, and inertia carries them over what statics cannot follow.
    pub fn is_random(&self) -> bool {
        matches!(self, Arrangement::Box(BoxOf::Random { .. }))
    }
}

/// What the section is taken through; x is along the rows, y across them.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Load {
    /// F = diag(1, λ, λ): I_tc = ln λ.
    Compaction,
    /// F = diag(1, λ, 1): I_tc = ½ ln λ, I_td = ½ |ln λ|.
    AlongRows,
    /// F = diag(1, 1, λ).
    AcrossRows,
}

impl Load {
    pub fn name(self) -> &'static str {
        match self {
            Load::Compaction => "compaction",
            Load::AlongRows => "along-rows",
            Load::AcrossRows => "across-rows",
        }
    }

    /// The stretches along the rows and across them.
    pub fn stretches(self, stretch: f64) -> [f64; 2] {
        match self {
            Load::Compaction => [stretch, stretch],
            Load::AlongRows => [stretch, 1.0],
            Load::AcrossRows => [1.0, stretch],
        }
    }

    /// I_tc and I_td.
    pub fn invariants(self, stretch: f64) -> [f64; 2] {
        match self {
            Load::Compaction => [stretch.ln(), 0.0],
            Load::AlongRows | Load::AcrossRows => [0.5 * stretch.ln(), 0.5 * stretch.ln().abs()],
        }
    }
}

/// The yarn's entries that go on to the fit.
#[derive(Clone, Debug)]
pub struct YarnName {
    pub name: String,
    pub source: Option<String>,
    pub volume_fraction: Option<f64>,
}

#[derive(Clone, Debug)]
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub fibre: Fibre,
    pub arrangement: Arrangement,
    /// Whether the explicit host computes it, and not CalculiX.
    pub explicit: bool,
    /// Between fibres; there is none on walls.
    pub friction: f64,
    /// Along an eighth of a fibre's circumference.
    pub elements: usize,
    /// |I_tc| at the end of a compaction, and I_td at the end of a compression.
    pub largest: f64,
    pub largest_distortion: f64,
    pub increments: usize,
    pub loads: Vec<Load>,
    pub yarn: YarnName,
}

impl Scene {
    /// The stretch at the end of a load.
    pub fn last_stretch(&self, load: Load) -> f64 {
        match load {
            Load::Compaction => (-self.largest).exp(),
            Load::AlongRows | Load::AcrossRows => (-2.0 * self.largest_distortion).exp(),
        }
    }
}
