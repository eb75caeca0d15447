//! The linear elastic law: properties, one point, blocks.

use libc::{c_char, size_t};
use nalgebra::Matrix3;

use crate::host::environment::in_default_environment;
use crate::law::block::Precision;
use crate::law::block::linear::LinearPointers;
use crate::law::error::Error;
use crate::law::linear_elastic::{Criterion, LinearElastic, LinearPoint, Rotation};
use crate::law::parameters;
use crate::law::status;
use crate::law::tangent::Measure;

use super::blocks;
use super::constants::{TORON_CRITERION_FIBRE, TORON_CRITERION_PRINCIPAL};
use super::constants::{TORON_ROTATION_FIBRE, TORON_ROTATION_POLAR, TORON_ROTATION_SPIN};
use super::tangents;
use crate::host::border::write_text;
use crate::host::border::{entry, properties, store};

/// The array at `from`, or zeros if that is null.
///
/// # Safety
/// `from` is null or points to N values.
unsafe fn load<const N: usize>(from: *const f64) -> [f64; N] {
    // SAFETY: the caller's promise.
    if from.is_null() { [0.0; N] } else { unsafe { *from.cast() } }
}

/// # Safety
/// As for `toron_linear_elastic_step_f64`.
unsafe fn linear_elastic<T: Precision>(values: *const T, count: size_t) -> Result<LinearElastic<T>, Error> {
    // SAFETY: the caller's promise.
    LinearElastic::new(unsafe { properties(values, count, &parameters::LINEAR_ELASTIC) }?)
}

fn rotation(rotation: i32) -> Result<Rotation, Error> {
    match rotation {
        TORON_ROTATION_FIBRE => Ok(Rotation::Fibre),
        TORON_ROTATION_POLAR => Ok(Rotation::Polar),
        TORON_ROTATION_SPIN => Ok(Rotation::Spin),
        _ => Err(Error::Argument {
            name: "rotation",
            value: f64::from(rotation),
            wanted: "0 (fibre), 1 (polar) or 2 (spin)",
        }),
    }
}

fn criterion(criterion: i32) -> Result<Criterion, Error> {
    match criterion {
        TORON_CRITERION_PRINCIPAL => Ok(Criterion::LargestPrincipal),
        TORON_CRITERION_FIBRE => Ok(Criterion::FibreStress),
        _ => Err(Error::Argument {
            name: "criterion",
            value: f64::from(criterion),
            wanted: "0 (largest principal stress) or 1 (fibre stress)",
        }),
    }
}

/// # Safety
/// As for `toron_linear_elastic_step_f64`.
unsafe fn store_linear(point: &LinearPoint, state_new: *mut f64, stress: *mut f64) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        store(&point.state, state_new);
        store(&point.stress, stress);
    }
    point.status
}

/// `toron_linear_elastic_validate_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_elastic_validate_f64(
    values: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    in_default_environment(move || unsafe {
        let error = linear_elastic(values, count).err();
        store(&[error.map_or(status::OK, |error| error.code())], status);
        write_text(message, capacity, |sink| {
            if let Some(error) = error {
                error.describe(sink);
            }
        })
    })
}

/// `toron_linear_elastic_axes_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_elastic_axes_f64(values: *const f64, count: size_t, axes: *mut f64) -> i32 {
    if axes.is_null() {
        return status::NULL_ARGUMENT;
    }
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        store(linear_elastic(values, count)?.reference_axes().as_slice(), axes);
        Ok(status::OK)
    })
}

/// # Safety
/// As for `toron_linear_elastic_step_f64`.
#[allow(clippy::too_many_arguments)]
unsafe fn linear_step(
    values: *const f64,
    count: size_t,
    f_old: *const f64,
    f_new: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    rotation: i32,
    criterion: i32,
    axes: *mut f64,
    tangent: Option<(i32, *mut f64)>,
) -> Result<i32, Error> {
    // SAFETY: the caller's promise.
    let law = unsafe { linear_elastic(values, count) }?;
    let criterion = self::criterion(criterion)?;
    let rotation = self::rotation(rotation)?;
    let wanted = tangent.map(|(measure, to)| tangents::measure(measure).map(|measure| (measure, to))).transpose()?;
    let spin = rotation == Rotation::Spin;
    if wanted.is_some_and(|(_, to)| to.is_null()) {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    if f_old.is_null() || f_new.is_null() || (spin && axes.is_null()) {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    // SAFETY: the caller's promise; axes are read for the spin frame only.
    unsafe {
        let mut turning = if spin { Matrix3::from_column_slice(&load::<9>(axes)) } else { law.reference_axes() };
        let [f0, f1] = [f_old, f_new].map(|f| Matrix3::from_column_slice(&load::<9>(f)));
        let old = load(state_old);
        let point = match wanted {
            None => law.step(&f0, &f1, &old, rotation, criterion, &mut turning),
            Some((measure, to)) => {
                let (point, tangent) = law.step_with_tangent(&f0, &f1, &old, rotation, criterion, &mut turning);
                match tangent.matrix(measure, &f1, &point.stress) {
                    Some(rows) => store(rows.as_flattened(), to),
                    None if measure == Measure::Nominal => store(&tangent.nominal(&f1, &point.stress), to),
                    None => store(&[0.0; 36], to),
                }
                point
            }
        };
        if spin {
            store(turning.as_slice(), axes);
        }
        Ok(store_linear(&point, state_new, stress))
    }
}

/// `toron_linear_elastic_step_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn linear_elastic_step_f64(
    values: *const f64,
    count: size_t,
    f_old: *const f64,
    f_new: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    rotation: i32,
    criterion: i32,
    axes: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        linear_step(values, count, f_old, f_new, state_old, state_new, stress, rotation, criterion, axes, None)
    })
}

/// `toron_linear_elastic_step_tangent_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn linear_elastic_step_tangent_f64(
    values: *const f64,
    count: size_t,
    f_old: *const f64,
    f_new: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    rotation: i32,
    criterion: i32,
    axes: *mut f64,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    let tangent = Some((measure, tangent));
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        linear_step(values, count, f_old, f_new, state_old, state_new, stress, rotation, criterion, axes, tangent)
    })
}

/// `toron_linear_elastic_increment_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn linear_elastic_increment_f64(
    values: *const f64,
    count: size_t,
    strain: *const f64,
    jacobian: f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    criterion: i32,
) -> i32 {
    if strain.is_null() {
        return status::NULL_ARGUMENT;
    }
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        let law = linear_elastic(values, count)?;
        let point = law.increment(&load(strain), jacobian, &load(state_old), self::criterion(criterion)?);
        Ok(store_linear(&point, state_new, stress))
    })
}

/// A block of points of the linear elastic law: component-major arrays, component c of point i at
/// `c * leading_dimension + i`.
///
/// Optional arrays may be null: an output whose pointer is null is not computed. The array of the old state may be the same
/// as that of the new state.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct LinearBlock<T> {
    /// Number of points; and the leading dimension: the distance from one component to the next in numbers, at least n.
    pub n: size_t,
    pub leading_dimension: size_t,
    /// In, 9 components each: F by columns at both ends of the step. Must not be null.
    pub f_old: *const T,
    pub f_new: *const T,
    /// In and out, 9 components: the current material axes in global coordinates, axis 1, then 2, then 3. Must not be null
    /// for `TORON_ROTATION_SPIN`; not used for the other frames.
    pub axes: *mut T,
    /// In, 10: the old state; null: all 0.
    pub state_old: *const T,
    /// Out, 10: the new state. If null, no point fails, but a point whose old failure flag is set stays failed.
    pub state_new: *mut T,
    /// Out, 6 components: Cauchy stress in global axes, 11 22 33 12 23 31.
    pub stress: *mut T,
    /// Out: a status code for each point.
    pub status: *mut i32,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best available one below it
    /// is used. AVX2 and AVX-512 give identical bits; the baseline differs in the last digits.
    pub level: i32,
}

/// # Safety
/// As for `toron_linear_elastic_block_f64`.
unsafe fn linear_block<T: Precision>(
    values: *const T,
    count: size_t,
    block: *const LinearBlock<T>,
    rotation: i32,
    criterion: i32,
) -> Result<i32, Error> {
    if block.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    // SAFETY: the caller's promise.
    unsafe {
        let law = linear_elastic(values, count)?;
        let LinearBlock { n, leading_dimension, f_old, f_new, axes, state_old, state_new, stress, status, level } =
            *block;
        law.raw_block(&LinearPointers {
            n,
            leading_dimension,
            f_old,
            f_new,
            axes,
            state_old,
            state_new,
            stress,
            status,
            rotation: self::rotation(rotation)?,
            criterion: self::criterion(criterion)?,
            level: blocks::level(level)?,
        })
    }
}

/// `toron_linear_elastic_block_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_elastic_block_f64(
    values: *const f64,
    count: size_t,
    block: *const LinearBlock<f64>,
    rotation: i32,
    criterion: i32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { linear_block(values, count, block, rotation, criterion) })
}

/// `toron_linear_elastic_block_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_elastic_block_f32(
    values: *const f32,
    count: size_t,
    block: *const LinearBlock<f32>,
    rotation: i32,
    criterion: i32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { linear_block(values, count, block, rotation, criterion) })
}
