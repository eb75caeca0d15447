//! The calls for blocks: with slices from Rust, or with a host's pointers.

use core::marker::PhantomData;
use core::ptr::{null, null_mut};

use super::copies::{in_copies, linear_in_copies};
use super::dispatch::Precision;
use super::kernel::STAGED;
use super::linear::{LinearPointers, LinearStrides, with_tangents};
use super::pointers::{Pointers, Strides, check_layout, components, components_mut};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::linear_elastic::{LinearElastic, Rotation};
use crate::law::number::level::Level;
use crate::law::number::real::WIDEST;
use crate::law::prepared::PreparedHyperelastic;
use crate::law::status;
use crate::law::tangent::Measure;

/// A block as slices. The state is updated in place: old on entry, new on return. The components of each array are listed in
/// [`block`](super); what is `None` is neither read, computed nor written.
#[derive(Debug, Default)]
pub struct Arrays<'a, T> {
    /// The number of points; and the leading dimension of all arrays, at least `n`.
    pub n: usize,
    pub leading_dimension: usize,
    pub deformation_gradient: &'a [T],
    pub fibre: Option<&'a [T]>,
    /// The true fibre strain at failure, ln(1 + ε_lim), of each point; 0 for that of the properties. Read where `failure` is computed.
    pub limit: Option<&'a [T]>,
    /// The reference density; used only with `wave_speed`.
    pub density: T,
    pub stress: Option<&'a mut [T]>,
    pub energies: Option<&'a mut [T]>,
    pub invariants: Option<&'a mut [T]>,
    pub failure: Option<&'a mut [T]>,
    pub modes: Option<&'a mut [T]>,
    pub wave_speed: Option<&'a mut [T]>,
    pub tangent: Option<&'a mut [T]>,
    /// The measure of `tangent`.
    pub measure: Measure,
    /// A status code for each point.
    pub status: Option<&'a mut [i32]>,
    /// For each point 1, or 0 if it has failed or cannot be evaluated.
    pub active: Option<&'a mut [T]>,
    /// The instructions to use, or the best that the processor has if those are lower; `None` for the best.
    pub level: Option<Level>,
}

/// A block whose arrays have been checked. It can be split into parts, which have no points in common and may be evaluated by
/// different threads.
#[derive(Debug)]
pub struct Block<'a, T> {
    pointers: Pointers<T>,
    arrays: PhantomData<&'a mut T>,
}

// SAFETY: a block has exclusive access to the arrays that it writes. Its parts have different points, and with a leading
// dimension no less than n different points are at different addresses.
unsafe impl<T: Send + Sync> Send for Block<'_, T> {}

impl<'a, T: Precision> Block<'a, T> {
    /// Checks that each array is long enough for the points.
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
            modes_leading_dimension: leading_dimension,
            tangent_leading_dimension: leading_dimension,
            strides: Strides::UNIT,
            deformation_gradient: components(arrays.deformation_gradient.as_ptr(), leading_dimension),
            fibre: components(input("entries of fibre", arrays.fibre, 3)?, leading_dimension),
            limit: input("entries of limit", arrays.limit, 1)?,
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
            active: output("entries of active", arrays.active, 1)?,
            level: arrays.level,
        };
        // If columns overlapped, the parts of a block would overlap too.
        check_layout(n, 9, leading_dimension, 1, ["leading dimension", "stride"])?;
        Ok(Block { pointers, arrays: PhantomData })
    }

    /// The number of points.
    pub fn points(&self) -> usize {
        self.pointers.n
    }

    /// Splits the block into its first `count` points (all, if it has fewer) and the rest.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let count = count.min(self.pointers.n);
        let first = Pointers { n: count, ..self.pointers };
        let rest = self.pointers.from(count);
        [first, rest].map(|pointers| Block { pointers, arrays: PhantomData }).into()
    }
}

/// What a host passes with every block.
#[derive(Clone, Copy)]
pub enum Law<'a, T> {
    Properties(&'a [T]),
    Prepared(&'a PreparedHyperelastic<T>),
}

impl<T: Precision> Hyperelastic<T> {
    /// Evaluates the law at every point of a block. Returns the worst (most negative) of the status codes.
    ///
    /// # Errors
    /// An array that is too short, a leading dimension below n, a density that is not positive if the wave speed is requested.
    pub fn block(&self, arrays: Arrays<'_, T>) -> Result<i32, Error> {
        self.checked_block(Block::new(arrays)?)
    }

    /// As [`block`](Self::block), for a block that has been checked, or a part of one.
    ///
    /// # Errors
    /// A density that is not positive if the wave speed is requested.
    pub fn checked_block(&self, block: Block<'_, T>) -> Result<i32, Error> {
        // SAFETY: the block is valid: `Block::new` has checked the lengths of the arrays, which are slices and do not overlap; only
        // the state is both read and written, through one pointer.
        unsafe { self.raw_block(&block.pointers) }
    }

    /// Evaluates the law at every point of a block of raw arrays. Returns the worst (most negative) of the status codes.
    ///
    /// # Errors
    /// A null deformation gradient, a leading dimension with which entries of an array overlap, a density that is not positive if
    /// the wave speed is requested.
    ///
    /// # Safety
    /// The block is valid, see [`Pointers`].
    pub unsafe fn raw_block(&self, block: &Pointers<T>) -> Result<i32, Error> {
        let request = block.check()?;
        if block.n == 0 {
            return Ok(status::OK);
        }
        let level = block.level();
        if block.strides != Strides::UNIT {
            // SAFETY: the block is valid; `in_copies` passes a valid block of copies, next to each other, and `level`
            // is one that the processor has.
            return Ok(unsafe { in_copies(block, |points| T::dispatch(level, self, points, request)) });
        }
        if block.in_place() {
            // SAFETY: the block is valid, with points next to each other and its state in place; `level` is one that the processor
            // has.
            return Ok(unsafe { T::dispatch(level, self, block, request) });
        }
        // An old state in other arrays is copied part by part, so that the copy is still in the first-level cache when it is
        // read.
        let mut worst = status::OK;
        for first in (0..block.n).step_by(COPIED) {
            let mut points = block.from(first);
            points.n = points.n.min(COPIED);
            // SAFETY: a part of a valid block is valid, and its state is in place once the old one has been copied.
            unsafe {
                points.copy_old_state();
                worst = worst.min(T::dispatch(level, self, &points, request));
            }
        }
        Ok(worst)
    }
}

/// The number of points that are evaluated again at a time to find one at fault.
const SEARCHED: usize = 32;

impl<T: Precision> Hyperelastic<T> {
    /// The first point of a block, which has been evaluated, that has this status code; `None` if that can no longer be told: nothing
    /// is stored, and what depends on the old state or on the size of a result is not seen.
    ///
    /// # Safety
    /// As for [`raw_block`](Self::raw_block), for the same block, after it.
    pub(crate) unsafe fn at_fault(&self, block: &Pointers<T>, code: i32) -> Option<usize> {
        if [status::STATE_NOT_FINITE, status::OVERFLOW].contains(&code) {
            return None;
        }
        if code == status::LIMIT {
            // SAFETY: the block is valid, and some point has an unusable limit, so that there are limits.
            return (0..block.n).find(|&i| unsafe { block.has_wrong_limit(i) });
        }
        for first in (0..block.n).step_by(SEARCHED) {
            let mut codes = [status::OK; SEARCHED];
            let points = block.from(first);
            let points = Pointers {
                n: points.n.min(SEARCHED),
                strides: points.strides,
                deformation_gradient: points.deformation_gradient,
                fibre: points.fibre,
                failure_old: points.failure_old,
                status: codes.as_mut_ptr(),
                level: points.level,
                ..Pointers::without_arrays(0, points.leading_dimension)
            };
            // SAFETY: the points from `first` on of a valid block, with some of its inputs and a code for each of the points.
            if unsafe { self.raw_block(&points) } == Ok(code) {
                return codes.iter().position(|&found| found == code).map(|i| first + i);
            }
        }
        None
    }
}

/// As [`Hyperelastic::raw_block`], for a host that passes the properties, or a law prepared from them, with every block.
///
/// # Errors
/// The first property that is wrong, or an error of `raw_block`; nothing is written.
///
/// # Safety
/// As for [`Hyperelastic::raw_block`].
pub(crate) unsafe fn raw_block_of<T: Precision>(law: Law<'_, T>, block: &Pointers<T>) -> Result<i32, Error> {
    // Errors of the properties are reported before errors of the block.
    let law = match law {
        Law::Properties(properties) => Hyperelastic::new(properties)?,
        Law::Prepared(prepared) => prepared.law(),
    };
    // SAFETY: the block is valid, as `raw_block` requires.
    unsafe { law.raw_block(block) }
}

/// The number of points whose old state is copied at a time: a multiple of the points of a stage in either precision.
const COPIED: usize = 2 * STAGED * WIDEST;

impl<T: Precision> LinearElastic<T> {
    /// The first point of a block, which has been evaluated, that has this status code; `None` if that can no longer be told: nothing
    /// is stored, and what depends on the old state, on axes that have been turned, or on the size of a result is not seen.
    ///
    /// # Safety
    /// As for [`raw_block`](Self::raw_block), for the same block, after it.
    pub(crate) unsafe fn at_fault(&self, block: &LinearPointers<T>, code: i32) -> Option<usize> {
        if block.rotation == Rotation::Spin || [status::STATE_NOT_FINITE, status::OVERFLOW].contains(&code) {
            return None;
        }
        let strides = block.strides;
        let from = |pointer: *const T, stride: usize, first: usize| match pointer.is_null() {
            true => pointer,
            false => pointer.wrapping_add(first * stride),
        };
        for first in (0..block.n).step_by(SEARCHED) {
            let mut codes = [status::OK; SEARCHED];
            let points = LinearPointers {
                n: (block.n - first).min(SEARCHED),
                strides,
                f_old: block.f_old.map(|c| from(c, strides.deformation_gradient, first)),
                f_new: block.f_new.map(|c| from(c, strides.deformation_gradient, first)),
                fibre: block.fibre.map(|c| from(c, strides.fibre, first)),
                second_axis: block.second_axis.map(|c| from(c, strides.fibre, first)),
                limit: from(block.limit, strides.limit, first),
                state_old: from(block.state_old, strides.state, first),
                rotation: block.rotation,
                criterion: block.criterion,
                status: codes.as_mut_ptr(),
                level: block.level,
                ..LinearPointers::without_arrays(0, block.leading_dimension)
            };
            // SAFETY: the points from `first` on of a valid block, with some of its inputs and a code for each of the points.
            if unsafe { self.raw_block(&points) } == Ok(code) {
                return codes.iter().position(|&found| found == code).map(|i| first + i);
            }
        }
        None
    }

    /// Evaluates a step at every point of a block of raw arrays. Returns the worst (most negative) of the status codes.
    ///
    /// # Errors
    /// A null deformation gradient, null axes for [`Rotation::Spin`], a leading dimension with which entries of an array overlap, a
    /// density that is not positive if the wave speed is requested.
    ///
    /// # Safety
    /// The block is valid, see [`LinearPointers`].
    pub unsafe fn raw_block(&self, block: &LinearPointers<T>) -> Result<i32, Error> {
        block.check()?;
        if block.n == 0 {
            return Ok(status::OK);
        }
        // Arrays that the frame does not need are not read.
        let mut block = *block;
        match block.rotation {
            Rotation::Spin => (block.fibre, block.second_axis) = ([null(); 3], [null(); 3]),
            Rotation::Fibre | Rotation::Polar => block.axes = null_mut(),
        }
        if !block.tangent.is_null() {
            // SAFETY: the block is valid, less the arrays that the frame does not need, and has a tangent.
            return Ok(unsafe { with_tangents(self, &block) });
        }
        let level = block.level.unwrap_or_else(Level::best).min(Level::best());
        if block.strides == LinearStrides::UNIT {
            // SAFETY: the block is valid, with points next to each other; `level` is one that the processor has.
            return Ok(unsafe { T::dispatch_linear(level, self, &block) });
        }
        // SAFETY: the block is valid; `linear_in_copies` passes a valid block of copies, next to each other, and
        // `level` is one that the processor has.
        Ok(unsafe { linear_in_copies(&block, |points| T::dispatch_linear(level, self, points)) })
    }
}
