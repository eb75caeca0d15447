//! The quantities that columns of data may hold, for each loading: how they prescribe the deformation, and what the law
//! predicts them from.

use nalgebra::Matrix3;

use super::response::{Measured, Quantity};
use toron::law::parameters::{Dimension, ENERGY_DENSITY, NUMBER, STRESS};
use toron_materials::units::{FORCE, LENGTH};

/// What a specimen undergoes as a whole, its fibre along the first axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simple {
    /// F = diag(λ, 1, 1), λ ≥ 1.
    Elongation,
    /// F = diag(1, λ, λ), λ ≤ 1: the section is pressed from all sides.
    Compaction,
    /// F = diag(1, 1, λ), λ ≤ 1: pressed from two sides, the others held.
    Compression,
}

/// A column over which data are given.
#[derive(Debug)]
pub struct Abscissa {
    pub name: &'static str,
    pub dimension: Dimension,
    /// Its value at rest.
    pub rest: f64,
    /// What is allowed, for messages.
    pub allowed: &'static str,
    /// The stretch λ, given the value and the length of the specimen.
    pub stretch: fn(f64, f64) -> f64,
}

/// A column of what is measured.
#[derive(Debug)]
pub struct Ordinate {
    pub name: &'static str,
    pub dimension: Dimension,
    /// What the law predicts it from, given the area on which a force acts.
    pub measured: fn(f64) -> Measured,
}

const fn abscissa(name: &'static str, rest: f64, allowed: &'static str, stretch: fn(f64, f64) -> f64) -> Abscissa {
    Abscissa { name, dimension: NUMBER, rest, allowed, stretch }
}

static ELONGATION: [Abscissa; 4] = [
    abscissa("strain", 0.0, "a number from 0 to 1: the elongation over the length", |strain, _| 1.0 + strain),
    abscissa("stretch", 1.0, "a number from 1 to 2: the length over that at rest", |stretch, _| stretch),
    abscissa("I_el", 0.0, "a number from 0 to 0.69: the true strain", |i_el, _| i_el.exp()),
    Abscissa {
        dimension: LENGTH,
        ..abscissa(
            "displacement",
            0.0,
            "a length from 0 to that of the specimen: the elongation",
            |elongation, length| 1.0 + elongation / length,
        )
    },
];

static COMPACTION: [Abscissa; 3] = [
    abscissa("I_tc", 0.0, "a number <= 0: half the logarithm of the area ratio", |i_tc, _| i_tc.exp()),
    abscissa("area_ratio", 1.0, "a number > 0 and <= 1: the section's area over that at rest", |ratio, _| ratio.sqrt()),
    abscissa("stretch", 1.0, "a number > 0 and <= 1: a side's length over that at rest", |stretch, _| stretch),
];

static COMPRESSION: [Abscissa; 5] = [
    abscissa("stretch", 1.0, "a number > 0 and <= 1: the height over that at rest", |stretch, _| stretch),
    abscissa("compression", 0.0, "a number >= 0 and < 1: the displacement over the height", |strain, _| 1.0 - strain),
    abscissa("I_td", 0.0, "a number >= 0: half the logarithm of the aspect ratio", |i_td, _| (-2.0 * i_td).exp()),
    abscissa("I_tc", 0.0, "a number <= 0: half the logarithm of the area ratio", |i_tc, _| (2.0 * i_tc).exp()),
    Abscissa {
        dimension: LENGTH,
        ..abscissa("displacement", 0.0, "a length >= 0 and less than the height", |travel, height| {
            1.0 - travel / height
        })
    },
];

fn energy(_: f64) -> Measured {
    Measured { quantity: Quantity::Energy, factor: 1.0 }
}

/// Force on the face that is pressed or pulled over its reference area; `factor` is negative where pressure counts.
fn nominal(axis: usize, factor: f64) -> Measured {
    Measured { quantity: Quantity::Nominal(axis, axis), factor }
}

static PULLED: [Ordinate; 3] = [
    Ordinate { name: "energy", dimension: ENERGY_DENSITY, measured: energy },
    Ordinate { name: "stress", dimension: STRESS, measured: |_| nominal(0, 1.0) },
    Ordinate { name: "force", dimension: FORCE, measured: |area| nominal(0, area) },
];

static PRESSED: [Ordinate; 4] = [
    Ordinate { name: "energy", dimension: ENERGY_DENSITY, measured: energy },
    Ordinate {
        name: "pressure",
        dimension: STRESS,
        measured: |_| Measured { quantity: Quantity::Cauchy(2, 2), factor: -1.0 },
    },
    Ordinate { name: "stress", dimension: STRESS, measured: |_| nominal(2, -1.0) },
    Ordinate { name: "force", dimension: FORCE, measured: |area| nominal(2, -area) },
];

impl Simple {
    pub fn abscissae(self) -> &'static [Abscissa] {
        match self {
            Simple::Elongation => &ELONGATION,
            Simple::Compaction => &COMPACTION,
            Simple::Compression => &COMPRESSION,
        }
    }

    pub fn ordinates(self) -> &'static [Ordinate] {
        match self {
            Simple::Elongation => &PULLED,
            Simple::Compaction | Simple::Compression => &PRESSED,
        }
    }

    /// The deformation gradient of a stretch.
    pub fn gradient(self, stretch: f64) -> Matrix3<f64> {
        let diagonal = match self {
            Simple::Elongation => [stretch, 1.0, 1.0],
            Simple::Compaction => [1.0, stretch, stretch],
            Simple::Compression => [1.0, 1.0, stretch],
        };
        Matrix3::from_diagonal(&diagonal.into())
    }

    /// Whether a stretch is on the side that the law answers to.
    pub fn allows(self, stretch: f64) -> bool {
        match self {
            Simple::Elongation => (1.0..=2.0).contains(&stretch),
            Simple::Compaction | Simple::Compression => stretch > 0.0 && stretch <= 1.0,
        }
    }
}

/// A column of failure points: the elongation, compaction or distortion at which they failed, as an invariant.
#[derive(Debug)]
pub struct Invariant {
    pub name: &'static str,
    pub allowed: &'static str,
    /// The invariant, ⟨−I_tc⟩ for the compaction.
    pub of: fn(f64) -> f64,
}

/// I_el at failure.
pub static FAILED_AT: [Invariant; 3] = [
    Invariant { name: "strain", allowed: "a number > 0, at most 1", of: f64::ln_1p },
    Invariant { name: "stretch", allowed: "a number > 1, at most 2", of: f64::ln },
    Invariant { name: "I_el", allowed: "a number > 0, at most 0.69", of: |i_el| i_el },
];

/// ⟨−I_tc⟩ at failure.
pub static COMPACTED: [Invariant; 2] = [
    Invariant { name: "I_tc", allowed: "a number <= 0", of: |i_tc| 0.0 - i_tc },
    Invariant { name: "area_ratio", allowed: "a number > 0 and <= 1", of: |ratio| 0.0 - 0.5 * ratio.ln() },
];

/// I_td at failure.
pub static DISTORTED: [Invariant; 2] = [
    Invariant { name: "I_td", allowed: "a number >= 0", of: |i_td| i_td },
    Invariant { name: "aspect_ratio", allowed: "a number >= 1, over that at rest", of: |ratio| 0.5 * ratio.ln() },
];
