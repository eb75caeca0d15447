//! Blocks of the hyperelastic law as slices, for callers in Rust.

use core::marker::PhantomData;
use core::ptr::{null, null_mut};

use super::dispatch::Precision;
use super::layout::{check_layout, components, components_mut};
use super::points::Points;
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::number::level::Level;
use crate::law::status;
use crate::law::tangent::Measure;

/// A block as slices. The state is updated in place: old on entry, new on return. The components of each array are
/// listed in [`block`](super); what is `None` is neither read, computed nor written.
#[derive(Debug, Default)]
pub struct Arrays<'a, T> {
    /// The number of points.
    pub n: usize,
    /// The leading dimension of all arrays: from one component to the next, at least `n`.
    pub leading_dimension: usize,
    /// 9: F by columns.
    pub deformation_gradient: &'a [T],
    /// 3: the fibre direction of each point, of any length; `None` for that of the properties.
    pub fibre: Option<&'a [T]>,
    /// The true fibre strain at failure, ln(1 + ε_lim), of each point; 0 for that of the properties. Read where
    /// `failure` is computed.
    pub limit: Option<&'a [T]>,
    /// The reference density; used only with `wave_speed`.
    pub density: T,
    /// 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: Option<&'a mut [T]>,
    /// 4: energies of the modes per reference volume, of elongation, compaction, distortion and longitudinal shear.
    pub energies: Option<&'a mut [T]>,
    /// 4: strain invariants of the modes, in the same order.
    pub invariants: Option<&'a mut [T]>,
    /// 3: the failure index, 1 from the call on that finds it at 1 or above, else 0, and "alive", which is 1 less that.
    /// A point that has failed has no stress. `None`: no point fails.
    pub failure: Option<&'a mut [T]>,
    /// 24: second Piola–Kirchhoff stress of each mode, 11 22 33 12 23 31.
    pub modes: Option<&'a mut [T]>,
    /// 1: an upper bound of the wave speed, for current element lengths.
    pub wave_speed: Option<&'a mut [T]>,
    /// 36, entry (row, column) at 6 row + column; or 81 for [`Measure::Nominal`], at 9 row + column.
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

/// A block whose arrays have been checked. It can be split into parts, which have no points in common and may be
/// evaluated by different threads.
#[derive(Debug)]
pub struct Block<'a, T> {
    points: Points<T>,
    arrays: PhantomData<&'a mut T>,
}

// SAFETY: a block has exclusive access to the arrays that it writes. Its parts have different points, and with a
// leading dimension no less than n different points are at different addresses.
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
            None => Ok(null()),
        };
        let output = |name, array: Option<&mut [T]>, components| match array {
            Some(array) => check(name, array.len(), components).map(|()| array.as_mut_ptr()),
            None => Ok(null_mut()),
        };
        let energies = output("entries of energies", arrays.energies, 4)?;
        let invariants = output("entries of invariants", arrays.invariants, 4)?;
        let state = [energies, invariants, output("entries of failure", arrays.failure, 3)?];
        let points = Points {
            f_new: components(arrays.deformation_gradient.as_ptr(), leading_dimension),
            fibre: components(input("entries of fibre", arrays.fibre, 3)?, leading_dimension),
            limit: input("entries of limit", arrays.limit, 1)?,
            state_old: state.map(<*mut T>::cast_const),
            state_new: state,
            density: arrays.density,
            stress: components_mut(output("entries of stress", arrays.stress, 6)?, leading_dimension),
            modes: output("entries of modes", arrays.modes, 24)?,
            wave_speed: output("entries of wave_speed", arrays.wave_speed, 1)?,
            tangent: output("entries of tangent", arrays.tangent, arrays.measure.components())?,
            measure: arrays.measure,
            status: match arrays.status {
                Some(array) => check("entries of status", array.len(), 1).map(|()| array.as_mut_ptr())?,
                None => null_mut(),
            },
            active: output("entries of active", arrays.active, 1)?,
            level: arrays.level,
            ..Points::without_arrays(n, leading_dimension)
        };
        // If columns overlapped, the parts of a block would overlap too.
        check_layout(n, 9, leading_dimension, 1, ["leading dimension", "stride"])?;
        Ok(Block { points, arrays: PhantomData })
    }

    /// The number of points.
    pub fn points(&self) -> usize {
        self.points.n
    }

    /// Splits the block into its first `count` points (all, if it has fewer) and the rest.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let count = count.min(self.points.n);
        let first = Points { n: count, ..self.points };
        let rest = self.points.from(count);
        [first, rest].map(|points| Block { points, arrays: PhantomData }).into()
    }
}

impl<T: Precision> Hyperelastic<T> {
    /// Evaluates the law at every point of a block. Returns the worst (most negative) of the status codes.
    ///
    /// # Errors
    /// An array that is too short, a leading dimension below n, a density that is not positive if the wave speed is
    /// requested.
    pub fn block(&self, arrays: Arrays<'_, T>) -> Result<i32, Error> {
        self.checked_block(Block::new(arrays)?)
    }

    /// As [`block`](Self::block), for a block that has been checked, or a part of one.
    ///
    /// # Errors
    /// A density that is not positive if the wave speed is requested.
    pub fn checked_block(&self, block: Block<'_, T>) -> Result<i32, Error> {
        // SAFETY: the points are valid: `Block::new` has checked the lengths of the arrays, which are slices and do not
        // overlap; only the state is both read and written, through one pointer.
        unsafe { self.step(&block.points) }
    }
}
