//! What a host asks of a law: its description, its preparation from properties, and a step at many points. A host that
//! is written for any [`Law`] names none.

use super::axes::FibreFrame;
pub use super::block::Points;
use super::block::{Has, PARTS, Precision, evaluate_points, parts};
use super::description::{self, Description};
use super::error::Error;
use super::hyperelastic::Hyperelastic;
use super::linear_elastic::LinearElastic;
use super::resistance::{Resistance, ShearLimit};
use super::state::{HYPERELASTIC_PARTS, HYPERELASTIC_STATE, LINEAR_ELASTIC_STATE};

/// A law, prepared from its properties.
///
/// # Safety
/// `State` is an array of as many numbers as the description has state variables, and [`step`](Self::step) accesses no
/// memory of the points but what [`Points`] says.
pub unsafe trait Law<T: Precision>: Copy {
    /// The law's tables, and what hosts have to know of them.
    const DESCRIPTION: Description;
    /// Which arrays its points may have besides those of every law.
    const HAS: Has = Has::NOTHING_ELSE;
    /// The number of variables in each part of the state that may be an array of its own, 0 for a part that there is
    /// not; the last one has the latch.
    const PARTS: [usize; PARTS] = [Self::DESCRIPTION.state.len(), 0, 0];
    /// The state variables of a point.
    type State: Copy + AsRef<[T]> + AsMut<[T]>;

    /// The state of a point that nothing has happened to.
    fn fresh() -> Self::State;

    /// Checks the properties, in the order of the description, and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    fn new(properties: &[T]) -> Result<Self, Error>;

    /// The material axes in the reference placement: fibre, second axis, third axis.
    fn axes(&self) -> [[f64; 3]; 3];

    /// Bulk and shear modulus of an isotropic solid in which no wave is slower than the law's fastest one at rest, or
    /// that along the fibre: for hosts that compute their time step and contact stiffness from two elastic constants.
    fn bulk_and_shear(&self) -> [T; 2];

    /// What resists the motions of an element, for hosts that take viscosity and hourglass control of it; by default
    /// that of the isotropic solid of [`bulk_and_shear`](Self::bulk_and_shear).
    fn resistance(&self) -> Resistance {
        Resistance::isotropic(self.bulk_and_shear())
    }

    /// The most shear that artificial viscosity and hourglass control may add to that of a section whose fibres slide;
    /// none where nothing slides.
    fn shear_limit(&self) -> Option<ShearLimit> {
        None
    }

    /// The worst status code of a call: as an error where there is more to say than the code does.
    ///
    /// # Errors
    /// The law has refused a point, for a reason of its own; or it cannot be evaluated even at rest.
    fn told(&self, code: i32) -> Result<i32, Error> {
        Self::DESCRIPTION.told(code)
    }

    /// The parts of a state whose variables are the rows of one array; null if that is.
    #[inline(always)]
    fn parts(state: *const T, leading_dimension: usize) -> [*const T; PARTS] {
        parts(state, leading_dimension, Self::PARTS)
    }

    /// The same for a state to be written.
    #[inline(always)]
    fn parts_mut(state: *mut T, leading_dimension: usize) -> [*mut T; PARTS] {
        let [a, b, c] = Self::parts(state, leading_dimension);
        [a.cast_mut(), b.cast_mut(), c.cast_mut()]
    }

    /// Evaluates a step at every point. Returns the worst (most negative) of the status codes.
    ///
    /// # Errors
    /// A null deformation gradient, an array that points of this law do not have, null axes for a frame that is kept
    /// there, a leading dimension with which entries of an array overlap, a density that is not positive if the wave
    /// speed is requested.
    ///
    /// # Safety
    /// The points are valid, see [`Points`].
    unsafe fn step(&self, points: &Points<T>) -> Result<i32, Error>;
}

// SAFETY: the state is that of the description, and the block's kernels access what `Points` says.
unsafe impl<T: Precision> Law<T> for Hyperelastic<T> {
    const DESCRIPTION: Description = description::HYPERELASTIC;
    const HAS: Has = Has::YARN;
    const PARTS: [usize; PARTS] = HYPERELASTIC_PARTS;
    type State = [T; HYPERELASTIC_STATE];

    fn fresh() -> Self::State {
        [T::splat(0.0); HYPERELASTIC_STATE]
    }

    #[inline(always)]
    fn new(properties: &[T]) -> Result<Self, Error> {
        Hyperelastic::new(properties)
    }

    fn axes(&self) -> [[f64; 3]; 3] {
        let FibreFrame { m, t1, t2 } = self.lanes().frame;
        [m, t1, t2]
    }

    #[inline(always)]
    fn bulk_and_shear(&self) -> [T; 2] {
        Hyperelastic::bulk_and_shear(self)
    }

    fn resistance(&self) -> Resistance {
        Hyperelastic::resistance(self)
    }

    #[inline(always)]
    unsafe fn step(&self, points: &Points<T>) -> Result<i32, Error> {
        // SAFETY: the points are valid.
        unsafe { evaluate_points(self, points) }
    }
}

// SAFETY: the state is that of the description, and the block's kernels access what `Points` says.
unsafe impl<T: Precision> Law<T> for LinearElastic<T> {
    const DESCRIPTION: Description = description::LINEAR_ELASTIC;
    const HAS: Has = Has::LINEAR_ELASTIC;
    type State = [T; LINEAR_ELASTIC_STATE];

    fn fresh() -> Self::State {
        [T::splat(0.0); LINEAR_ELASTIC_STATE]
    }

    #[inline(always)]
    fn new(properties: &[T]) -> Result<Self, Error> {
        LinearElastic::new(properties)
    }

    fn axes(&self) -> [[f64; 3]; 3] {
        self.lanes().axes
    }

    #[inline(always)]
    fn bulk_and_shear(&self) -> [T; 2] {
        LinearElastic::bulk_and_shear(self)
    }

    fn resistance(&self) -> Resistance {
        LinearElastic::resistance(self)
    }

    #[inline(always)]
    unsafe fn step(&self, points: &Points<T>) -> Result<i32, Error> {
        // SAFETY: the points are valid, and so they are with fewer arrays.
        unsafe { evaluate_points(self, &LinearElastic::in_frame(points)?) }
    }
}
