//! Blocks of points of the hyperelastic law.

use libc::size_t;

use crate::law::block::{Pointers, Precision, components, components_mut, raw_block_of};
use crate::law::error::Error;
use crate::law::number::level::Level;
use crate::law::number::real::Scalar;
use crate::law::parameters;
use crate::law::status;

use super::constants::{TORON_LEVEL_AVX2, TORON_LEVEL_AVX512, TORON_LEVEL_BASELINE, TORON_LEVEL_BEST};
use crate::host::border::{entry, properties};

/// A block of points: component-major arrays, component c of point i at `c * leading_dimension + i`.
///
/// Optional arrays may be null: an output whose pointer is null is not computed. The arrays of the old state may be the
/// same as those of the new state; otherwise arrays must not overlap. Energies, invariants and failure may be parts of one
/// component-major state array of 11 components, starting at components 0, 4 and 8.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Block<T> {
    /// Number of points; and the leading dimension: the distance from one component to the next in numbers, at least n.
    pub n: size_t,
    pub leading_dimension: size_t,
    /// In, 9 components: F by columns. Must not be null.
    pub deformation_gradient: *const T,
    /// In, 3 components: the fibre direction of each point, any length; if null, the one in the properties.
    pub fibre: *const T,
    /// In, 4, 4 and 3 components: the old state; if null, all 0.
    pub energies_old: *const T,
    pub invariants_old: *const T,
    pub failure_old: *const T,
    /// In: reference density; used only if wave_speed is not null.
    pub density: T,
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: *mut T,
    /// Out, 4: W_el W_tc W_td W_ld.
    pub energies: *mut T,
    /// Out, 4: I_el I_tc I_td I_ld.
    pub invariants: *mut T,
    /// Out, 3: failure index, failed, alive. If null, no point fails, but a point whose old failure flag is set stays
    /// failed.
    pub failure: *mut T,
    /// Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
    pub modes: *mut T,
    /// Out, 1 component: an upper bound of the wave speed, to be used with current element lengths; never below the speed
    /// along a fibre at rest. It is meant for the stable time step; a bulk viscosity computed with it damps more than with the
    /// exact speed.
    pub wave_speed: *mut T,
    /// Out: a status code for each point.
    pub status: *mut i32,
    /// Out, 1 component: 1, or 0 if the point has failed or cannot be evaluated: what a solver deletes elements by.
    pub active: *mut T,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best available one below it
    /// is used. AVX2 and AVX-512 give identical bits; the baseline differs in the last digits.
    pub level: i32,
}

#[inline(always)]
pub(super) fn level(level: i32) -> Result<Option<Level>, Error> {
    match level {
        TORON_LEVEL_BEST => Ok(None),
        TORON_LEVEL_BASELINE => Ok(Some(Level::Baseline)),
        TORON_LEVEL_AVX2 => Ok(Some(Level::Avx2)),
        TORON_LEVEL_AVX512 => Ok(Some(Level::Avx512)),
        _ => Err(Error::Argument {
            name: "level",
            value: f64::from(level),
            wanted: "0 (the best), 1 (baseline), 2 (AVX2) or 3 (AVX-512)",
        }),
    }
}

impl<T: Scalar> Block<T> {
    #[inline(always)]
    pub(super) fn pointers(&self) -> Result<Pointers<T>, Error> {
        let stride = self.leading_dimension;
        Ok(Pointers {
            deformation_gradient: components(self.deformation_gradient, stride),
            fibre: components(self.fibre, stride),
            energies_old: self.energies_old,
            invariants_old: self.invariants_old,
            failure_old: self.failure_old,
            density: self.density,
            stress: components_mut(self.stress, stride),
            energies: self.energies,
            invariants: self.invariants,
            failure: self.failure,
            modes: self.modes,
            wave_speed: self.wave_speed,
            status: self.status,
            active: self.active,
            level: level(self.level)?,
            ..Pointers::without_arrays(self.n, stride)
        })
    }
}

/// # Safety
/// As for `toron_hyperelastic_block_f64`.
unsafe fn block<T: Precision>(values: *const T, count: size_t, block: *const Block<T>) -> Result<i32, Error> {
    if block.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    // SAFETY: the caller's promise.
    unsafe {
        let properties = properties(values, count, &parameters::HYPERELASTIC)?;
        raw_block_of(properties, &(*block).pointers()?)
    }
}

/// `toron_hyperelastic_block_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_block_f64(values: *const f64, count: size_t, block: *const Block<f64>) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { self::block(values, count, block) })
}

/// `toron_hyperelastic_block_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_block_f32(values: *const f32, count: size_t, block: *const Block<f32>) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { self::block(values, count, block) })
}
