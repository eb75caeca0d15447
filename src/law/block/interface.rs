//! The law at every point of a block: from Rust's slices, or from a host's pointers.

use core::marker::PhantomData;

use super::dispatch::Precision;
#[cfg(target_arch = "x86_64")]
use super::few::FEW;
use super::kernel::{STAGED, WIDEST};
use super::linear::LinearPointers;
use super::pointers::{Pointers, components, components_mut, leading_dimension_below};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::linear_elastic::{LinearElastic, Rotation};
use crate::law::number::level::Level;
use crate::law::status;
use crate::law::tangent::Measure;

/// A block as Rust passes it: the state in place, old on entry and new on return.
#[derive(Debug, Default)]
pub struct Arrays<'a, T> {
    pub n: usize,
    pub leading_dimension: usize,
    pub deformation_gradient: &'a [T],
    pub fibre: Option<&'a [T]>,
    pub density: T,
    pub stress: Option<&'a mut [T]>,
    pub energies: Option<&'a mut [T]>,
    pub invariants: Option<&'a mut [T]>,
    pub failure: Option<&'a mut [T]>,
    pub modes: Option<&'a mut [T]>,
    pub wave_speed: Option<&'a mut [T]>,
    pub tangent: Option<&'a mut [T]>,
    pub measure: Measure,
    pub status: Option<&'a mut [i32]>,
    pub level: Option<Level>,
}

/// A block whose arrays have been checked. It can be cut into parts, which share no point and may go to other threads.
#[derive(Debug)]
pub struct Block<'a, T> {
    pointers: Pointers<T>,
    arrays: PhantomData<&'a mut T>,
}

// SAFETY: a block holds the arrays that it writes exclusively. Its parts hold different points, and with the leading
// dimension no less than n different points stand at different places.
unsafe impl<T: Send + Sync> Send for Block<'_, T> {}

impl<'a, T: Precision> Block<'a, T> {
    /// Checks that the arrays hold the points.
    ///
    /// # Errors
    /// An array that is too short, a leading dimension below n.
    pub fn new(arrays: Arrays<'a, T>) -> Result<Self, Error> {
        let Arrays { n, leading_dimension, .. } = arrays;
        let needed = |components: usize| match components {
            0 => 0,
            _ if n == 0 => 0,
            _ => (components - 1).saturating_mul(leading_dimension).saturating_add(n),
        };
        let check = |name: &'static str, length: usize, components: usize| {
            if length >= needed(components) {
                return Ok(());
            }
            let wanted = i64::try_from(needed(components)).unwrap_or(i64::MAX);
            Err(Error::Count { code: status::BAD_COUNT, what: name, found: length as i64, wanted })
        };
        check("entries of deformation_gradient", arrays.deformation_gradient.len(), 9)?;
        let input = |name, array: Option<&[T]>, components| match array {
            Some(array) => check(name, array.len(), components).map(|()| array.as_ptr()),
            None => Ok(core::ptr::null()),
        };
        let output = |name, array: Option<&mut [T]>, components| match array {
            Some(array) => check(name, array.len(), components).map(|()| array.as_mut_ptr()),
            None => Ok(core::ptr::null_mut()),
        };
        let energies = output("entries of energies", arrays.energies, 4)?;
        let invariants = output("entries of invariants", arrays.invariants, 4)?;
        let failure = output("entries of failure", arrays.failure, 3)?;
        let pointers = Pointers {
            n,
            leading_dimension,
            deformation_gradient: components(arrays.deformation_gradient.as_ptr(), leading_dimension),
            fibre: components(input("entries of fibre", arrays.fibre, 3)?, leading_dimension),
            energies_old: energies,
            invariants_old: invariants,
            failure_old: failure,
            density: arrays.density,
            stress: components_mut(output("entries of stress", arrays.stress, 6)?, leading_dimension),
            energies,
            invariants,
            failure,
            modes: output("entries of modes", arrays.modes, 24)?,
            wave_speed: output("entries of wave_speed", arrays.wave_speed, 1)?,
            tangent: output("entries of tangent", arrays.tangent, arrays.measure.components())?,
            measure: arrays.measure,
            status: match arrays.status {
                Some(array) => check("entries of status", array.len(), 1).map(|()| array.as_mut_ptr())?,
                None => core::ptr::null_mut(),
            },
            level: arrays.level,
        };
        // Parts of columns that overlap would not be disjoint.
        if leading_dimension < n {
            return Err(leading_dimension_below(n, leading_dimension));
        }
        Ok(Block { pointers, arrays: PhantomData })
    }

    /// How many points.
    pub fn points(&self) -> usize {
        self.pointers.n
    }

    /// The first `count` points, all where there are no more, and the rest.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let count = count.min(self.pointers.n);
        let first = Pointers { n: count, ..self.pointers };
        let rest = self.pointers.from(count);
        [first, rest].map(|pointers| Block { pointers, arrays: PhantomData }).into()
    }
}

impl<T: Precision> Hyperelastic<T> {
    /// The law at every point of a block; returns the worst (most negative) of their status codes.
    ///
    /// # Errors
    /// An array that is too short, a leading dimension below n, a density that is not positive where the wave speed is
    /// wanted.
    pub fn block(&self, arrays: Arrays<'_, T>) -> Result<i32, Error> {
        self.checked_block(Block::new(arrays)?)
    }

    /// Likewise, for a block or a part of one.
    ///
    /// # Errors
    /// A density that is not positive where the wave speed is wanted.
    pub fn checked_block(&self, block: Block<'_, T>) -> Result<i32, Error> {
        // SAFETY: every array is as long as the block needs; the state alone is read and written, through one pointer.
        unsafe { self.raw_block(&block.pointers) }
    }

    /// The law at every point of a block of raw arrays; returns the worst (most negative) of their status codes.
    ///
    /// # Errors
    /// A null deformation gradient, a leading dimension below n, a density that is not positive where the wave speed is
    /// wanted.
    ///
    /// # Safety
    /// Every pointer that is not null points to as many values as the block's size and the table above say, valid for
    /// reading or writing; `stress` and `fibre` are null in all their components or in none; outputs overlap nothing but,
    /// exactly, the old state they replace.
    pub unsafe fn raw_block(&self, block: &Pointers<T>) -> Result<i32, Error> {
        let request = block.check()?;
        if block.n == 0 {
            return Ok(status::OK);
        }
        let level = block.level();
        if block.in_place() {
            // SAFETY: the caller answers for the arrays, and the processor has the level's instructions.
            return Ok(unsafe { T::dispatch(level, self, block, request) });
        }
        // An old state elsewhere is copied part by part: what has been copied is then still in the nearest cache.
        let mut worst = status::OK;
        for first in (0..block.n).step_by(COPIED) {
            let mut points = block.from(first);
            points.n = points.n.min(COPIED);
            // SAFETY: as above.
            unsafe {
                points.copy_old_state();
                worst = worst.min(T::dispatch(level, self, &points, request));
            }
        }
        Ok(worst)
    }
}

/// The law of these properties at every point of a block, for a host that hands them over with it; otherwise as
/// [`Hyperelastic::raw_block`].
///
/// # Errors
/// The first property that is wrong, or what `raw_block` says; nothing is written.
///
/// # Safety
/// As for [`Hyperelastic::raw_block`].
pub unsafe fn raw_block_of<T: Precision>(properties: &[T], block: &Pointers<T>) -> Result<i32, Error> {
    #[cfg(target_arch = "x86_64")]
    if (1..=FEW).contains(&block.n)
        && block.tangent.is_null()
        && block.level() > Level::Baseline
        && let Ok(request) = block.check()
    {
        // SAFETY: the caller answers for the arrays, and the processor has the instructions.
        return unsafe { T::one_by_one(properties, block, request) };
    }
    // What is wrong about the properties is reported before what is wrong about the block.
    // SAFETY: the caller answers for the arrays.
    unsafe { Hyperelastic::new(properties)?.raw_block(block) }
}

/// How many points' old state is copied at a time: whole groups of registers in either precision.
const COPIED: usize = 2 * STAGED * WIDEST;

impl<T: Precision> LinearElastic<T> {
    /// The law over a step at every point of a block of raw arrays; returns the worst (most negative) of their status codes.
    ///
    /// # Errors
    /// A null deformation gradient, null axes for the spin, a leading dimension below n.
    ///
    /// # Safety
    /// Every pointer that is not null points to as many values as the block's size and the table above say, valid for
    /// reading or writing; outputs overlap nothing but, exactly, the old state they replace.
    pub unsafe fn raw_block(&self, block: &LinearPointers<T>) -> Result<i32, Error> {
        if block.n == 0 {
            return Ok(status::OK);
        }
        let spin = block.rotation == Rotation::Spin;
        if block.f_old.is_null() || block.f_new.is_null() || (spin && block.axes.is_null()) {
            return Err(Error::Plain(status::NULL_ARGUMENT));
        }
        if block.leading_dimension < block.n {
            return Err(leading_dimension_below(block.n, block.leading_dimension));
        }
        let level = block.level.unwrap_or_else(Level::best).min(Level::best());
        let axes = if spin { block.axes } else { core::ptr::null_mut() };
        // SAFETY: the caller answers for the arrays, and the processor has the level's instructions.
        Ok(unsafe { T::dispatch_linear(level, self, &LinearPointers { axes, ..*block }) })
    }
}
