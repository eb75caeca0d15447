//! The tables of state variables, which a host stores for each point from one call to the next. All are 0 at the start.

use super::parameters::{Dimension, ENERGY_DENSITY, NUMBER, STRESS};

/// One state variable.
#[derive(Debug)]
pub struct StateVariable {
    /// Name, symbol and meaning in tables, and the dimension.
    pub name: &'static str,
    pub symbol: &'static str,
    pub dimension: Dimension,
    pub meaning: &'static str,
}

/// A row of the table.
pub const fn row(
    name: &'static str,
    symbol: &'static str,
    dimension: Dimension,
    meaning: &'static str,
) -> StateVariable {
    StateVariable { name, symbol, dimension, meaning }
}

/// Number of state variables of the hyperelastic law.
pub const HYPERELASTIC_STATE: usize = 11;
/// Indices into the state of the hyperelastic law: the first of four energies, the first of four invariants, the
/// failure index, the latch, and the flag for element deletion.
pub const ENERGIES: usize = 0;
pub const INVARIANTS: usize = 4;
pub const FAILURE_INDEX: usize = 8;
pub const FAILED: usize = 9;
pub const ALIVE: usize = 10;

/// The number of variables in the parts of that state, which may be arrays of their own, and the places of these parts:
/// energies, invariants, and failure with index, latch and flag.
pub const HYPERELASTIC_PARTS: [usize; 3] = [4, 4, 3];
/// The places of the parts.
pub mod part {
    pub const ENERGIES: usize = 0;
    pub const INVARIANTS: usize = 1;
    pub const FAILURE: usize = 2;
}

/// The rows of the latch and of the flag for element deletion, which every law has.
pub const FAILED_ROW: StateVariable =
    row("failed", "failed", NUMBER, "the latch: 1 once the point has failed; 0 at the start");
pub const ALIVE_ROW: StateVariable =
    row("alive", "alive", NUMBER, "1 - failed, written on every call and never read: for element deletion");

/// The energies and invariants of the yarn laws. Energies are per reference volume.
const MODES: [StateVariable; 8] = [
    row("w_el", "W_el", ENERGY_DENSITY, "energy of longitudinal elongation"),
    row("w_tc", "W_tc", ENERGY_DENSITY, "energy of transverse compaction"),
    row("w_td", "W_td", ENERGY_DENSITY, "energy of transverse distortion"),
    row("w_ld", "W_ld", ENERGY_DENSITY, "energy of longitudinal shear"),
    row("i_el", "I_el", NUMBER, "elongation invariant: true strain along the fibre"),
    row("i_tc", "I_tc", NUMBER, "compaction invariant: half the logarithm of the section's area ratio"),
    row("i_td", "I_td", NUMBER, "distortion invariant: half the logarithm of the section's aspect ratio"),
    row("i_ld", "I_ld", NUMBER, "longitudinal-shear invariant: tangent of the fibre-slip angle"),
];
const FAILURE_INDEX_ROW: StateVariable =
    row("failure_index", "index", NUMBER, "1 at the failure limit, 0 where the fibre is not in tension");

/// The state of the hyperelastic law.
pub static HYPERELASTIC: [StateVariable; HYPERELASTIC_STATE] = {
    let [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld] = MODES;
    [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, FAILURE_INDEX_ROW, FAILED_ROW, ALIVE_ROW]
};

/// Number of state variables of the law with friction.
pub const FRICTIONAL_STATE: usize = 15;
/// Indices into the state of the law with friction: the energy lost, and the latch and the flag for element deletion.
pub const FRICTIONAL_LOST: usize = 8;
pub const FRICTIONAL_FAILED: usize = 13;
pub const FRICTIONAL_ALIVE: usize = 14;

/// The number of variables in the parts of that state: energies, invariants, and friction with failure.
pub const FRICTIONAL_PARTS: [usize; 3] = [4, 4, 7];

/// The state of the law with friction.
pub static FRICTIONAL: [StateVariable; FRICTIONAL_STATE] = {
    let [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld] = MODES;
    [
        w_el,
        w_tc,
        w_td,
        w_ld,
        i_el,
        i_tc,
        i_td,
        i_ld,
        row("w_fr", "w_fr", ENERGY_DENSITY, "energy lost by friction between the fibres"),
        row("i_te", "I_te", NUMBER, "the part of the distortion invariant that the fibres hold"),
        row("slip_1", "d1", NUMBER, "slip of the fibres over one another, along the transverse axes"),
        row("slip_2", "d2", NUMBER, "slip of the fibres over one another, between the transverse axes"),
        FAILURE_INDEX_ROW,
        FAILED_ROW,
        ALIVE_ROW,
    ]
};

/// Number of state variables of the linear elastic law.
pub const LINEAR_ELASTIC_STATE: usize = 10;
/// Indices into the state of the linear elastic law: the first of six stress components, the largest principal stress,
/// the work, the latch, and the flag for element deletion.
pub const LINEAR_STRESS: usize = 0;
pub const LINEAR_LARGEST: usize = 6;
pub const LINEAR_WORK: usize = 7;
pub const LINEAR_FAILED: usize = 8;
pub const LINEAR_ALIVE: usize = 9;

/// The state of the linear elastic law.
pub static LINEAR_ELASTIC: [StateVariable; LINEAR_ELASTIC_STATE] = [
    row("s_11", "σ11", STRESS, "Cauchy stress in the material frame"),
    row("s_22", "σ22", STRESS, "Cauchy stress in the material frame"),
    row("s_33", "σ33", STRESS, "Cauchy stress in the material frame"),
    row("s_12", "σ12", STRESS, "Cauchy stress in the material frame"),
    row("s_23", "σ23", STRESS, "Cauchy stress in the material frame"),
    row("s_31", "σ31", STRESS, "Cauchy stress in the material frame"),
    row("s_max", "σ_I", STRESS, "largest signed principal stress"),
    row("work", "w", ENERGY_DENSITY, "work per reference volume"),
    FAILED_ROW,
    ALIVE_ROW,
];
