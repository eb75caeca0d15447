//! Blocks of points of a law that is known by its description alone, as an explicit solver holds them.

use std::ptr::null;
use std::sync::Arc;

use super::precision::BlockPrecision;
use toron::Error;
use toron::law::block::Circumstances;
use toron::law::interface::{Law, Points};

/// The arrays of an explicit solver, component-major with one leading dimension; the state is replaced in place.
#[derive(Debug)]
pub struct OwnBlock<'a, T> {
    /// Number of points, and the distance from one component to the next.
    pub n: usize,
    pub leading_dimension: usize,
    /// In, 9 components each: F by columns at both ends of the step.
    pub f_old: &'a [T],
    pub f_new: &'a [T],
    /// The length of the step, and the time at its end.
    pub time_increment: f64,
    pub time: f64,
    /// In and out: the law's state variables.
    pub state: &'a mut [T],
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: &'a mut [T],
    /// The reference density, and out, 1: a bound of the wave speed.
    pub density: T,
    pub wave_speed: &'a mut [T],
    /// Out: a status code for each point.
    pub status: &'a mut [i32],
}

/// A law, prepared, that evaluates blocks: which one is chosen once a block, and all that its points need is compiled
/// for it.
pub trait BlockLaw<T>: Send + Sync {
    /// A step at the points; returns the worst status code, or that of a call that is refused.
    ///
    /// # Panics
    /// An array is shorter than its components need.
    fn evaluate(&self, block: OwnBlock<'_, T>) -> i32;
}

/// From properties to the law.
pub type PrepareBlock<T> = fn(&[T]) -> Result<Arc<dyn BlockLaw<T>>, Error>;

impl<T: BlockPrecision, L: Law<T> + Send + Sync> BlockLaw<T> for L {
    fn evaluate(&self, block: OwnBlock<'_, T>) -> i32 {
        let OwnBlock { n, leading_dimension: stride, f_old, f_new, state, stress, wave_speed, status, .. } = block;
        let holds = |length: usize, components: usize| length >= (components - 1) * stride + n;
        assert!(n <= stride && holds(f_old.len(), 9) && holds(f_new.len(), 9) && holds(stress.len(), 6));
        assert!(holds(state.len(), L::DESCRIPTION.state.len()) && wave_speed.len() >= n && status.len() >= n);
        let state = state.as_mut_ptr();
        let points = Points {
            f_old: std::array::from_fn(|c| f_old[c * stride..].as_ptr()),
            f_new: std::array::from_fn(|c| f_new[c * stride..].as_ptr()),
            circumstances: Circumstances {
                time_increment: block.time_increment,
                time: block.time,
                temperature: null(),
            },
            state_old: L::parts(state, stride),
            state_new: L::parts_mut(state, stride),
            density: block.density,
            stress: std::array::from_fn(|c| stress[c * stride..].as_mut_ptr()),
            wave_speed: wave_speed.as_mut_ptr(),
            status: status.as_mut_ptr(),
            ..Points::without_arrays(n, stride)
        };
        // SAFETY: the arrays have the sizes that have just been checked; the new state replaces the old one exactly,
        // and no other array overlaps another one.
        unsafe { Law::step(self, &points) }.unwrap_or_else(|error| error.code())
    }
}
