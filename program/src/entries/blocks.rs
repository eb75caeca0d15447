//! The blocks of an explicit solver, and the calls of the C entries on them.

use std::ptr::{null, null_mut};

use super::precision::BlockPrecision;
use toron::host::c::{self, Block, LinearBlock};
use toron::law::state::{ENERGIES, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS, LINEAR_ELASTIC_STATE};

/// The arrays of an explicit solver, component-major with one leading dimension; the history is replaced in place.
#[derive(Debug)]
pub struct SolverBlock<'a, T> {
    /// Number of points, and the distance from one component to the next.
    pub n: usize,
    pub leading_dimension: usize,
    /// In, 9 components: F by columns.
    pub deformation_gradient: &'a [T],
    /// In and out, 11: the state variables; only the groups that are wanted are read and written.
    pub state: &'a mut [T],
    /// Whether energies and invariants are wanted, and whether points may fail.
    pub energies: bool,
    pub failure: bool,
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: &'a mut [T],
    /// The reference density, and out, 1: a bound of the wave speed.
    pub wave_speed: Option<(T, &'a mut [T])>,
    /// Out: a status code for each point.
    pub status: &'a mut [i32],
}

/// The hyperelastic law at a block of points through `toron_hyperelastic_block_f64` or `_f32`, as an explicit solver calls
/// it; returns the entry's code.
///
/// # Panics
/// An array is shorter than its components need.
pub fn hyperelastic_block<T: BlockPrecision>(properties: &[T], block: SolverBlock<'_, T>) -> i32 {
    let SolverBlock { n, leading_dimension: stride, deformation_gradient, state, stress, status, .. } = block;
    let holds = |length: usize, components: usize| length >= (components - 1) * stride + n;
    let (density, wave_speed) = block.wave_speed.map_or((T::default(), None), |(density, to)| (density, Some(to)));
    assert!(n <= stride && holds(deformation_gradient.len(), 9) && holds(state.len(), HYPERELASTIC_STATE));
    assert!(holds(stress.len(), 6) && status.len() >= n && wave_speed.as_ref().is_none_or(|to| to.len() >= n));
    let state = state.as_mut_ptr();
    // SAFETY: the array holds all rows, as has just been seen.
    let part = |wanted: bool, row: usize| if wanted { unsafe { state.add(row * stride) } } else { null_mut() };
    let (energies, invariants) = (part(block.energies, ENERGIES), part(block.energies, INVARIANTS));
    let failure = part(block.failure, FAILURE_INDEX);
    let arrays = Block {
        n,
        leading_dimension: stride,
        deformation_gradient: deformation_gradient.as_ptr(),
        fibre: null(),
        energies_old: energies,
        invariants_old: invariants,
        failure_old: failure,
        density,
        stress: stress.as_mut_ptr(),
        energies,
        invariants,
        failure,
        modes: null_mut(),
        wave_speed: wave_speed.map_or(null_mut(), <[T]>::as_mut_ptr),
        status: status.as_mut_ptr(),
        active: null_mut(),
        level: c::TORON_LEVEL_BEST,
    };
    // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one exactly.
    unsafe { T::ENTRY(properties.as_ptr(), properties.len(), &arrays) }
}

/// The arrays of an explicit solver for the linear elastic law, as those of [`SolverBlock`].
#[derive(Debug)]
pub struct LinearSolverBlock<'a, T> {
    /// Number of points, and the distance from one component to the next.
    pub n: usize,
    pub leading_dimension: usize,
    /// In, 9 components each: F by columns at both ends of the step.
    pub f_old: &'a [T],
    pub f_new: &'a [T],
    /// In and out, 10: the state variables.
    pub state: &'a mut [T],
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: &'a mut [T],
    /// Out: a status code for each point.
    pub status: &'a mut [i32],
}

/// The linear elastic law over a step at a block of points through `toron_linear_elastic_block_f64` or `_f32`; returns the
/// entry's code.
///
/// # Panics
/// An array is shorter than its components need.
pub fn linear_elastic_block<T: BlockPrecision>(
    properties: &[T],
    block: LinearSolverBlock<'_, T>,
    frame: LinearFrame,
    criterion: i32,
) -> i32 {
    let LinearSolverBlock { n, leading_dimension: stride, f_old, f_new, state, stress, status } = block;
    let holds = |length: usize, components: usize| length >= (components - 1) * stride + n;
    assert!(n <= stride && holds(f_old.len(), 9) && holds(f_new.len(), 9));
    assert!(holds(state.len(), LINEAR_ELASTIC_STATE) && holds(stress.len(), 6) && status.len() >= n);
    let state = state.as_mut_ptr();
    let arrays = LinearBlock {
        n,
        leading_dimension: stride,
        f_old: f_old.as_ptr(),
        f_new: f_new.as_ptr(),
        axes: null_mut(),
        state_old: state,
        state_new: state,
        stress: stress.as_mut_ptr(),
        status: status.as_mut_ptr(),
        level: c::TORON_LEVEL_BEST,
    };
    let rotation = match frame {
        LinearFrame::Fibre => c::TORON_ROTATION_FIBRE,
        LinearFrame::Polar => c::TORON_ROTATION_POLAR,
    };
    // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one exactly, and neither frame
    // needs axes.
    unsafe { T::LINEAR_ENTRY(properties.as_ptr(), properties.len(), &arrays, rotation, criterion) }
}

/// The frames of the linear elastic law that follow from the deformation gradient alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearFrame {
    Fibre,
    Polar,
}
