//! What a host asks of a law: its description, its preparation from properties, and a step at many points. A host that is written for
//! any [`Law`] names none.

use core::ptr::{null, null_mut};

use super::block::linear::LinearPointers;
use super::block::{Pointers, Precision};
use super::description::{self, Description};
use super::error::Error;
use super::hyperelastic::Hyperelastic;
use super::kinematics::FibreFrame;
use super::linear_elastic::{Criterion, LinearElastic, Rotation};
use super::number::level::Level;
use super::state::{ENERGIES, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS, LINEAR_ELASTIC_STATE};
use super::tangent::Measure;

/// A law, prepared from its properties.
///
/// # Safety
/// `State` is an array of as many numbers as the description has state variables, and [`step`](Self::step) accesses no memory of the
/// points but what [`Points`] says.
pub unsafe trait Law<T: Precision>: Copy {
    const DESCRIPTION: Description;
    /// Whether a point may have a failure limit of its own, [`Points::limit`].
    const HAS_LIMIT: bool = false;
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

    /// Bulk and shear modulus of an isotropic solid in which no wave is slower than the law's fastest one at rest, or that along the
    /// fibre: for hosts that compute their time step and contact stiffness from two elastic constants.
    fn bulk_and_shear(&self) -> [T; 2];

    /// Evaluates a step at every point. Returns the worst (most negative) of the status codes.
    ///
    /// # Errors
    /// A null deformation gradient, a leading dimension below n, a density that is not positive if the wave speed is requested.
    ///
    /// # Safety
    /// The points are valid, see [`Points`].
    unsafe fn step(&self, points: &Points<T>) -> Result<i32, Error>;
}

/// Points of a host in component-major arrays, `n` values next to each other in each component. Arrays that are null
/// are absent: an old state is 0 then, and an output is not computed. F at the end must be there, and F at the start for a law that reads
/// it.
///
/// # Safety
/// Points are **valid** if every pointer that is not null points to as many values as its field, `n` and the leading dimension say, valid
/// for reading or writing; and if outputs overlap nothing but, exactly, the old state that they replace. [`Law::step`] is unsafe, since
/// only its caller can know this; it checks the leading dimension, and that what the law needs is not null.
#[derive(Clone, Copy, Debug)]
pub struct Points<T> {
    pub n: usize,
    /// The distance from one state variable to the next, and from one component of the tangent to the next.
    pub leading_dimension: usize,
    /// F at the start of the step, by columns; read only by a law whose description says so.
    pub f_old: [*const T; 9],
    /// F at its end, by columns.
    pub f_new: [*const T; 9],
    /// The fibre direction of each point, of any length; null for that of the properties.
    pub fibre: [*const T; 3],
    /// A failure limit of each point: the true fibre strain, ln(1 + ε_lim), of the hyperelastic law, or the strength of the linear elastic
    /// one; null or 0 for that of the properties.
    pub limit: *const T,
    /// The law's state variables, old and new.
    pub state_old: *const T,
    pub state_new: *mut T,
    /// The reference density; read only for the wave speed.
    pub density: T,
    /// Cauchy stress 11 22 33 12 23 31.
    pub stress: [*mut T; 6],
    /// A bound of the wave speed.
    pub wave_speed: *mut T,
    /// A status code for each point.
    pub status: *mut i32,
    /// For each point 1, or 0 if it has failed or cannot be evaluated.
    pub active: *mut T,
    /// The tangent of `measure`: entry (row, column) is component 6 row + column, or 9 row + column where the measure is 9×9.
    pub tangent: *mut T,
    pub measure: Measure,
    /// Choices of a law that has them.
    pub rotation: Rotation,
    pub criterion: Criterion,
    /// The instructions to use, or the best that the processor has if those are lower; `None` for the best.
    pub level: Option<Level>,
}

impl<T: Precision> Points<T> {
    /// `n` points without arrays yet: for the fields that a host does not name.
    #[inline(always)]
    pub fn without_arrays(n: usize, leading_dimension: usize) -> Self {
        Points {
            n,
            leading_dimension,
            f_old: [null(); 9],
            f_new: [null(); 9],
            fibre: [null(); 3],
            limit: null(),
            state_old: null(),
            state_new: null_mut(),
            density: T::splat(0.0),
            stress: [null_mut(); 6],
            wave_speed: null_mut(),
            status: null_mut(),
            active: null_mut(),
            tangent: null_mut(),
            measure: Measure::Jaumann,
            rotation: Rotation::Fibre,
            criterion: Criterion::LargestPrincipal,
            level: None,
        }
    }
}

// SAFETY: the state is that of the description, and the block's kernels access what `Pointers` says.
unsafe impl<T: Precision> Law<T> for Hyperelastic<T> {
    const DESCRIPTION: Description = description::HYPERELASTIC;
    const HAS_LIMIT: bool = true;
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

    #[inline(always)]
    unsafe fn step(&self, points: &Points<T>) -> Result<i32, Error> {
        let row = |first: usize| first.wrapping_mul(points.leading_dimension);
        // A state that is absent is so in all its parts.
        let old = |first: usize| match points.state_old.is_null() {
            true => null(),
            false => points.state_old.wrapping_add(row(first)),
        };
        let new = |first: usize| match points.state_new.is_null() {
            true => null_mut(),
            false => points.state_new.wrapping_add(row(first)),
        };
        let pointers = Pointers {
            deformation_gradient: points.f_new,
            fibre: points.fibre,
            limit: points.limit,
            energies_old: old(ENERGIES),
            invariants_old: old(INVARIANTS),
            failure_old: old(FAILURE_INDEX),
            density: points.density,
            stress: points.stress,
            energies: new(ENERGIES),
            invariants: new(INVARIANTS),
            failure: new(FAILURE_INDEX),
            wave_speed: points.wave_speed,
            status: points.status,
            active: points.active,
            tangent: points.tangent,
            measure: points.measure,
            level: points.level,
            ..Pointers::without_arrays(points.n, points.leading_dimension)
        };
        // SAFETY: the arrays are those of valid points; the parts of the state are where the table of its rows has them.
        unsafe { self.raw_block(&pointers) }
    }
}

// SAFETY: the state is that of the description, and the block's kernels access what `LinearPointers` says.
unsafe impl<T: Precision> Law<T> for LinearElastic<T> {
    const DESCRIPTION: Description = description::LINEAR_ELASTIC;
    const HAS_LIMIT: bool = true;
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

    #[inline(always)]
    unsafe fn step(&self, points: &Points<T>) -> Result<i32, Error> {
        let pointers = LinearPointers {
            f_old: points.f_old,
            f_new: points.f_new,
            fibre: points.fibre,
            limit: points.limit,
            state_old: points.state_old,
            state_new: points.state_new,
            density: points.density,
            stress: points.stress,
            wave_speed: points.wave_speed,
            status: points.status,
            active: points.active,
            tangent: points.tangent,
            measure: points.measure,
            rotation: points.rotation,
            criterion: points.criterion,
            level: points.level,
            ..LinearPointers::without_arrays(points.n, points.leading_dimension)
        };
        // SAFETY: the arrays are those of valid points.
        unsafe { self.raw_block(&pointers) }
    }
}
