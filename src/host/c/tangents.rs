//! The tangents of the hyperelastic law, at a point and in blocks, and its least stable wave.

use libc::size_t;

use crate::law::block::{Pointers, Precision};
use crate::law::derivative::{NineByNine, SixBySix};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::number::registers::Registers;
use crate::law::parameters;
use crate::law::point::{Call, cells, evaluate_call};
use crate::law::response::Request;
use crate::law::state;
use crate::law::status;
use crate::law::tangent::Measure;

use super::blocks::Block;
use super::constants::{TORON_TANGENT_JAUMANN, TORON_TANGENT_MATERIAL, TORON_TANGENT_NOMINAL, TORON_TANGENT_TRUESDELL};
use super::points::{PointAnswer, PointArguments};
use crate::host::border::{entry, properties, store};

pub(super) fn measure(measure: i32) -> Result<Measure, Error> {
    match measure {
        TORON_TANGENT_MATERIAL => Ok(Measure::Material),
        TORON_TANGENT_TRUESDELL => Ok(Measure::Truesdell),
        TORON_TANGENT_JAUMANN => Ok(Measure::Jaumann),
        TORON_TANGENT_NOMINAL => Ok(Measure::Nominal),
        _ => Err(Error::Argument {
            name: "measure",
            value: f64::from(measure),
            wanted: "0 (material), 1 (Truesdell), 2 (Jaumann) or 3 (nominal)",
        }),
    }
}

/// # Safety
/// As for `toron_hyperelastic_point_tangent_f64`.
#[allow(clippy::too_many_arguments)]
unsafe fn point_tangent<T: Registers>(
    values: *const T,
    count: size_t,
    deformation_gradient: *const T,
    fibre: *const T,
    state_old: *const T,
    state_new: *mut T,
    stress: *mut T,
    measure: i32,
    tangent: *mut T,
) -> Result<i32, Error> {
    let fresh = cells([T::splat(0.0); state::HYPERELASTIC_STATE]);
    // SAFETY: the caller's promise.
    let (properties, PointArguments { f, fibre, state }) = unsafe {
        (
            properties(values, count, &parameters::HYPERELASTIC)?,
            PointArguments::new(deformation_gradient, fibre, state_old, &fresh)?,
        )
    };
    let measure = self::measure(measure)?;
    if tangent.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    let kept = !state_new.is_null();
    let request =
        Request { stress: true, energies: kept, invariants: kept, failure: kept, modes: false, wave_modulus: false };
    let mut status = status::OK;
    let sink = PointAnswer {
        stress,
        state: state_new,
        modes: core::ptr::null_mut(),
        density: T::splat(1.0),
        wave_speed: core::ptr::null_mut(),
        tangent,
        status: &mut status,
    };
    if measure == Measure::Nominal {
        evaluate_call(Call { properties, f, fibre, state, tangent: NineByNine(request), sink })?;
    } else {
        evaluate_call(Call { properties, f, fibre, state, tangent: SixBySix(request, measure), sink })?;
    }
    Ok(status)
}

/// `toron_hyperelastic_point_tangent_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_point_tangent_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        point_tangent(values, count, deformation_gradient, fibre, state_old, state_new, stress, measure, tangent)
    })
}

/// `toron_hyperelastic_point_tangent_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_point_tangent_f32(
    values: *const f32,
    count: size_t,
    deformation_gradient: *const f32,
    fibre: *const f32,
    state_old: *const f32,
    state_new: *mut f32,
    stress: *mut f32,
    measure: i32,
    tangent: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        point_tangent(values, count, deformation_gradient, fibre, state_old, state_new, stress, measure, tangent)
    })
}

/// `toron_hyperelastic_least_acoustic_eigenvalue_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_least_acoustic_eigenvalue_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    least: *mut f64,
    direction: *mut f64,
) -> i32 {
    entry(move || {
        // SAFETY: the caller's promise.
        let law = Hyperelastic::new(unsafe { properties(values, count, &parameters::HYPERELASTIC) }?)?;
        if deformation_gradient.is_null() || least.is_null() {
            return Err(Error::Plain(status::NULL_ARGUMENT));
        }
        // SAFETY: the caller's promise.
        unsafe {
            let fibre = if fibre.is_null() { None } else { Some(*fibre.cast::<[f64; 3]>()) };
            let wave = law.acoustic(&*deformation_gradient.cast(), fibre).map_err(Error::Plain)?.least();
            store(&[wave.modulus], least);
            store(&wave.direction, direction);
        }
        Ok(status::OK)
    })
}

/// # Safety
/// As for `toron_hyperelastic_block_tangent_f64`.
unsafe fn block_tangent<T: Precision>(
    values: *const T,
    count: size_t,
    block: *const Block<T>,
    measure: i32,
    tangent: *mut T,
) -> Result<i32, Error> {
    if block.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    // SAFETY: the caller's promise.
    unsafe {
        let properties = properties(values, count, &parameters::HYPERELASTIC)?;
        let measure = self::measure(measure)?;
        Hyperelastic::new(properties)?.raw_block(&Pointers { tangent, measure, ..(*block).pointers()? })
    }
}

/// `toron_hyperelastic_block_tangent_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_block_tangent_f64(
    values: *const f64,
    count: size_t,
    block: *const Block<f64>,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { block_tangent(values, count, block, measure, tangent) })
}

/// `toron_hyperelastic_block_tangent_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_block_tangent_f32(
    values: *const f32,
    count: size_t,
    block: *const Block<f32>,
    measure: i32,
    tangent: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { block_tangent(values, count, block, measure, tangent) })
}
