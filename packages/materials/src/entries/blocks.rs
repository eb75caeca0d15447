//! The blocks of an explicit solver, and the calls of the C entries on them.

use std::ffi::c_char;
use std::marker::PhantomData;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use super::hosts::Given;
use super::precision::{BlockPrecision, PrepareEntry};
use toron::law::state::{
    ENERGIES, FAILURE_INDEX, FRICTIONAL_STATE, HYPERELASTIC_STATE, INVARIANTS, LINEAR_ELASTIC_STATE,
};
use toron_c::{Block, FrictionalLaw, HyperelasticLaw, LinearBlock, LinearElasticLaw};

/// The hyperelastic law, prepared through `toron_hyperelastic_prepare_f64` or `_f32`.
///
/// # Errors
/// The properties are wrong: the entry's message.
pub fn prepared<T: BlockPrecision>(properties: &[T]) -> Result<HyperelasticLaw<T>, String> {
    prepare(T::PREPARE, properties)
}

/// The same for the linear elastic law.
///
/// # Errors
/// The properties are wrong: the entry's message.
pub fn prepared_linear<T: BlockPrecision>(properties: &[T]) -> Result<LinearElasticLaw<T>, String> {
    prepare(T::PREPARE_LINEAR, properties)
}

/// The same for the law with friction.
///
/// # Errors
/// The properties are wrong: the entry's message.
pub fn prepared_frictional<T: BlockPrecision>(properties: &[T]) -> Result<FrictionalLaw<T>, String> {
    prepare(T::PREPARE_FRICTIONAL, properties)
}

fn prepare<L: Copy, T>(entry: PrepareEntry<L, T>, properties: &[T]) -> Result<L, String> {
    let (mut law, mut text) = (MaybeUninit::<L>::zeroed(), [0_u8; toron_c::TORON_MESSAGE_CAPACITY]);
    let (values, count, room) = (properties.as_ptr(), properties.len(), text.as_mut_ptr().cast::<c_char>());
    // SAFETY: the arrays have the sizes passed; a prepared law consists of numbers, which may be 0.
    unsafe {
        match entry(law.as_mut_ptr(), size_of::<L>(), values, count, room, text.len()) {
            0 => Ok(law.assume_init()),
            _ => Err(message_in(&text)),
        }
    }
}

/// The text that an entry has written.
pub(super) fn message_in(text: &[u8]) -> String {
    String::from_utf8_lossy(text.split(|&byte| byte == 0).next().unwrap_or_default()).into_owned()
}

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
    /// In, 11: the old state, where it is kept apart from the new one.
    pub state_old: Option<&'a [T]>,
    /// Whether energies and invariants are wanted, and whether points may fail.
    pub energies: bool,
    pub failure: bool,
    /// A failure limit of its own for each point, ln(1 + ε_lim).
    pub limit: Option<&'a [T]>,
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: &'a mut [T],
    /// The reference density, and out, 1: a bound of the wave speed.
    pub wave_speed: Option<(T, &'a mut [T])>,
    /// Out, 36: dS/dE.
    pub tangent: Option<&'a mut [T]>,
    /// Out: a status code for each point.
    pub status: &'a mut [i32],
}

impl<'a, T: BlockPrecision> SolverBlock<'a, T> {
    /// The structure that the C entry takes, which may be passed to it again and again.
    ///
    /// # Panics
    /// An array is shorter than its components need.
    pub fn arrays(self) -> BlockArrays<'a, T> {
        self.of_state(HYPERELASTIC_STATE)
    }

    /// The law with friction over a step at the points through `toron_frictional_block_f64` or `_f32`, with its 15
    /// state variables; returns the entry's code.
    ///
    /// # Panics
    /// As for [`arrays`](Self::arrays).
    pub fn call_frictional(self, law: &FrictionalLaw<T>) -> i32 {
        let BlockArrays { arrays, .. } = self.of_state(FRICTIONAL_STATE);
        // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one exactly, or is
        // elsewhere.
        unsafe { T::FRICTIONAL_BLOCK(law, &arrays, null_mut(), 0) }
    }

    /// The structure for a law with so many state variables: its failure is what is behind energies and invariants.
    fn of_state(self, variables: usize) -> BlockArrays<'a, T> {
        let SolverBlock { n, leading_dimension: stride, deformation_gradient, state, stress, status, tangent, .. } =
            self;
        let holds = |length: usize, components: usize| length >= (components - 1) * stride + n;
        let (density, wave_speed) = self.wave_speed.map_or((T::default(), None), |(density, to)| (density, Some(to)));
        assert!(n <= stride && holds(deformation_gradient.len(), 9) && holds(state.len(), variables));
        assert!(holds(stress.len(), 6) && status.len() >= n && wave_speed.as_ref().is_none_or(|to| to.len() >= n));
        assert!(tangent.as_ref().is_none_or(|to| holds(to.len(), 36)));
        assert!(self.state_old.is_none_or(|old| holds(old.len(), variables)));
        assert!(self.limit.is_none_or(|limit| limit.len() >= n));
        let state = state.as_mut_ptr();
        let old = self.state_old.map_or(state.cast_const(), <[T]>::as_ptr);
        // SAFETY: the array holds all rows, as has just been seen.
        let part = |wanted: bool, row: usize| if wanted { unsafe { state.add(row * stride) } } else { null_mut() };
        // SAFETY: as above.
        let old = |wanted: bool, row: usize| if wanted { unsafe { old.add(row * stride) } } else { null() };
        let (energies, invariants) = (part(self.energies, ENERGIES), part(self.energies, INVARIANTS));
        let failure = part(self.failure, FAILURE_INDEX);
        let mut arrays = Block {
            n,
            leading_dimension: stride,
            measure: toron_c::TORON_TANGENT_MATERIAL,
            energies_old: old(self.energies, ENERGIES),
            invariants_old: old(self.energies, INVARIANTS),
            failure_old: old(self.failure, FAILURE_INDEX),
            density: density.into(),
            energies,
            invariants,
            failure,
            wave_speed: wave_speed.map_or(null_mut(), <[T]>::as_mut_ptr),
            tangent: tangent.map_or(null_mut(), <[T]>::as_mut_ptr),
            status: status.as_mut_ptr(),
            limit: self.limit.map_or(null(), <[T]>::as_ptr),
            ..Block::empty()
        };
        arrays.deformation_gradient[0] = deformation_gradient.as_ptr();
        arrays.stress[0] = stress.as_mut_ptr();
        BlockArrays { arrays, borrowed: PhantomData }
    }
}

/// The structure that the C entry takes for a [`SolverBlock`].
pub struct BlockArrays<'a, T> {
    arrays: Block<T>,
    borrowed: PhantomData<&'a mut [T]>,
}

impl<T: BlockPrecision> BlockArrays<'_, T> {
    /// The hyperelastic law at the points through `toron_hyperelastic_block_f64` or `_f32`, or their namesakes with
    /// properties, as an explicit solver calls it; returns the entry's code.
    #[inline]
    pub fn call(&mut self, law: Given<'_, T>) -> i32 {
        // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one exactly, or is
        // elsewhere.
        unsafe {
            match law {
                Given::Properties(values) => {
                    T::BLOCK_WITH_PROPERTIES(values.as_ptr(), values.len(), &self.arrays, null_mut(), 0)
                }
                Given::Prepared(law) => T::BLOCK(law, &self.arrays, null_mut(), 0),
            }
        }
    }
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
    /// In: the strength of each point, 0 for that of the law.
    pub limit: Option<&'a [T]>,
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: &'a mut [T],
    /// Out: a status code for each point.
    pub status: &'a mut [i32],
}

/// The linear elastic law over a step at a block of points through `toron_linear_elastic_block_f64` or `_f32`; returns
/// the entry's code.
///
/// # Panics
/// An array is shorter than its components need.
pub fn linear_elastic_block<T: BlockPrecision>(
    law: &LinearElasticLaw<T>,
    block: LinearSolverBlock<'_, T>,
    frame: LinearFrame,
    criterion: i32,
) -> i32 {
    let LinearSolverBlock { n, leading_dimension: stride, f_old, f_new, state, limit, stress, status } = block;
    let holds = |length: usize, components: usize| length >= (components - 1) * stride + n;
    assert!(n <= stride && holds(f_old.len(), 9) && holds(f_new.len(), 9));
    assert!(holds(state.len(), LINEAR_ELASTIC_STATE) && holds(stress.len(), 6) && status.len() >= n);
    assert!(limit.is_none_or(|limit| limit.len() >= n));
    let state = state.as_mut_ptr();
    let mut arrays = LinearBlock {
        n,
        leading_dimension: stride,
        rotation: match frame {
            LinearFrame::Fibre => toron_c::TORON_ROTATION_FIBRE,
            LinearFrame::Polar => toron_c::TORON_ROTATION_POLAR,
        },
        criterion,
        state_old: state,
        state_new: state,
        status: status.as_mut_ptr(),
        limit: limit.map_or(null(), <[T]>::as_ptr),
        ..LinearBlock::empty()
    };
    (arrays.f_old[0], arrays.f_new[0]) = (f_old.as_ptr(), f_new.as_ptr());
    arrays.stress[0] = stress.as_mut_ptr();
    // SAFETY: the arrays have the sizes that the structure tells; the new state replaces the old one exactly, and
    // neither frame needs axes.
    unsafe { T::LINEAR_BLOCK(law, &arrays, null_mut(), 0) }
}

/// The frames of the linear elastic law that follow from the deformation gradient alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearFrame {
    Fibre,
    Polar,
}
