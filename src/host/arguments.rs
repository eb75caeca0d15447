//! What a caller passes by a number or leaves out: constants of the interface, and where the entries of an array are.

use libc::size_t;

use super::constants::*;
use crate::law::block::{MOST, check_layout, components, components_mut};
use crate::law::error::{Error, Value};
use crate::law::linear_elastic::{Criterion, Rotation};
use crate::law::number::level::Level;
use crate::law::number::real::Real;
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::wave_speed;

/// Where the entries of an array are: component c of point i at `c * leading_dimension + i * stride`, in numbers. All
/// 0: as the block says.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct Layout {
    /// From one component to the next; 0: that of the block, or 1 if the stride is more than 1 (points in rows). Not
    /// read where every component has a pointer.
    pub leading_dimension: size_t,
    /// From one point to the next; 0: 1. Points next to each other take the least time: others are copied part by part.
    pub stride: size_t,
}

/// Checks the number of points.
#[inline(always)]
pub fn check_points(n: size_t) -> Result<(), Error> {
    if n <= MOST {
        return Ok(());
    }
    let (value, greatest) = (n as i64, MOST as i64); // as the caller wrote it, if it is negative
    Err(Error::Range { code: status::BAD_COUNT, name: "n", value, least: 0, greatest })
}

/// Checks a density that is needed, as it is given and rounded to the precision of the call.
#[inline(always)]
pub fn check_density<T: Real + Into<f64>>(density: f64, needed: bool) -> Result<(), Error> {
    if !needed || wave_speed::check_density(T::splat(density)).is_ok() {
        return Ok(());
    }
    let wanted = "a finite number > 0, not subnormal";
    Err(Error::Argument { name: "density", value: Value::of(density), wanted })
}

impl Layout {
    /// The layout with nothing left out, in a block with this leading dimension.
    #[inline(always)]
    pub(super) fn or(self, leading_dimension: size_t) -> Layout {
        let leading_dimension = match (self.leading_dimension, self.stride) {
            (0, 0 | 1) => leading_dimension,
            (0, _) => 1,
            (given, _) => given,
        };
        Layout { leading_dimension, stride: self.stride.max(1) }
    }

    /// Checks the pointers to the components of an array of `n` points: all are given, or only the first one, or none.
    /// The layout has nothing left out; `component` is the name of one of its components, `distances` those of its
    /// leading dimension and stride.
    ///
    /// # Errors
    /// Some are given, but not all; or entries may overlap, or are before the array's start.
    #[inline(always)]
    pub(super) fn check<P: Copy + PartialEq, const N: usize>(
        self,
        array: &[P; N],
        null: P,
        n: size_t,
        component: &'static str,
        distances: [&'static str; 2],
    ) -> Result<(), Error> {
        let (mut count, mut c) = (0, 1);
        while c < N {
            count += usize::from(array[c] != null);
            c += 1;
        }
        if count > 0 && (count < N - 1 || array[0] == null) {
            return Err(Error::Null { name: component });
        }
        if array[0] == null {
            return Ok(());
        }
        // Components that have pointers of their own are where the caller says.
        let (components, leading_dimension) = if count > 0 { (1, n) } else { (N, self.leading_dimension) };
        check_layout(n, components, leading_dimension, self.stride, distances)
    }

    /// The pointers to the components of an array that [`check`](Self::check) has found right.
    #[inline(always)]
    pub(super) fn components<T, const N: usize>(self, array: &[*const T; N]) -> [*const T; N] {
        if array[1].is_null() { components(array[0], self.leading_dimension) } else { *array }
    }

    /// The same for an array to be written.
    #[inline(always)]
    pub(super) fn components_mut<T, const N: usize>(self, array: &[*mut T; N]) -> [*mut T; N] {
        if array[1].is_null() { components_mut(array[0], self.leading_dimension) } else { *array }
    }
}

/// The leading dimension of a block that leaves it out, or not.
#[inline(always)]
pub fn leading_dimension(given: size_t, n: size_t) -> size_t {
    if given == 0 { n } else { given }
}

/// The instructions that a number of `TORON_LEVEL_...` stands for; `None` for the best.
///
/// # Errors
/// It is none of them.
#[inline(always)]
pub fn level(level: i32) -> Result<Option<Level>, Error> {
    match level {
        TORON_LEVEL_BEST => Ok(None),
        TORON_LEVEL_BASELINE => Ok(Some(Level::Baseline)),
        TORON_LEVEL_AVX2 => Ok(Some(Level::Avx2)),
        TORON_LEVEL_AVX512 => Ok(Some(Level::Avx512)),
        _ => Err(Error::Choice {
            name: "level",
            value: i64::from(level),
            wanted: "0 (the best), 1 (baseline), 2 (AVX2) or 3 (AVX-512)",
        }),
    }
}

/// The measure that a number of `TORON_TANGENT_...` stands for.
///
/// # Errors
/// It is none of them.
pub fn measure(measure: i32) -> Result<Measure, Error> {
    match measure {
        TORON_TANGENT_MATERIAL => Ok(Measure::Material),
        TORON_TANGENT_TRUESDELL => Ok(Measure::Truesdell),
        TORON_TANGENT_JAUMANN => Ok(Measure::Jaumann),
        TORON_TANGENT_NOMINAL => Ok(Measure::Nominal),
        _ => Err(Error::Choice {
            name: "measure",
            value: i64::from(measure),
            wanted: "0 (material), 1 (Truesdell), 2 (Jaumann) or 3 (nominal)",
        }),
    }
}

/// The measure of a tangent, which is read if that is requested.
pub fn measure_of<T>(tangent: *mut T, measure: i32) -> Result<Measure, Error> {
    if tangent.is_null() { Ok(Measure::Jaumann) } else { self::measure(measure) }
}

/// The frame that a number of `TORON_ROTATION_...` stands for.
///
/// # Errors
/// It is none of them.
pub fn rotation(rotation: i32) -> Result<Rotation, Error> {
    match rotation {
        TORON_ROTATION_FIBRE => Ok(Rotation::Fibre),
        TORON_ROTATION_POLAR => Ok(Rotation::Polar),
        TORON_ROTATION_SPIN => Ok(Rotation::Spin),
        _ => Err(Error::Choice {
            name: "rotation",
            value: i64::from(rotation),
            wanted: "0 (fibre), 1 (polar) or 2 (spin)",
        }),
    }
}

/// The criterion that a number of `TORON_CRITERION_...` stands for.
///
/// # Errors
/// It is none of them.
pub fn criterion(criterion: i32) -> Result<Criterion, Error> {
    match criterion {
        TORON_CRITERION_PRINCIPAL => Ok(Criterion::LargestPrincipal),
        TORON_CRITERION_FIBRE => Ok(Criterion::FibreStress),
        _ => Err(Error::Choice {
            name: "criterion",
            value: i64::from(criterion),
            wanted: "0 (largest principal stress) or 1 (fibre stress)",
        }),
    }
}
