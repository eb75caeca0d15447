//! The linear elastic law as a user material of LS-DYNA.

use core::ffi::c_int;

use libc::{c_char, size_t};

use super::{Elements, bulk_and_shear, element_range, evaluate, law, vector};
use crate::host::border::{Message, check_pointers, entry};
use crate::law::block::linear::LinearPointers;
use crate::law::block::{Precision, components};
use crate::law::description::LINEAR_ELASTIC;
use crate::law::error::Error;
use crate::law::linear_elastic::LinearElastic;
use crate::law::status;
use crate::law::tangent::Measure;

/// The tangent of a further, infinitesimal step from the state that the material routine has written: its symmetric part.
///
/// # Safety
/// As for `toron_lsdyna_linear_utan_vector_f64`.
unsafe fn tangent<T: Precision>(
    cm: *const T,
    hsvs: *const T,
    nhv: i32,
    [first, count, stride]: [usize; 3],
    dsave: *mut T,
) -> Result<i32, Error> {
    let row = |variable: usize, start: usize| hsvs.wrapping_add(variable.wrapping_mul(stride).wrapping_add(start));
    // SAFETY: the caller's promise, here and below.
    let law: LinearElastic<T> = unsafe { law(cm, nhv, count, |j| *row(j, first)) }?;
    let mut worst = status::OK;
    for i in first..first + count {
        let f = components(row(LINEAR_ELASTIC.history(), i), stride);
        let mut entries = [[T::splat(0.0); 6]; 6];
        let pointers = LinearPointers {
            f_old: f,
            f_new: f,
            state_old: row(0, i),
            tangent: entries.as_mut_ptr().cast(),
            tangent_leading_dimension: 1,
            measure: Measure::Truesdell,
            ..LinearPointers::without_arrays(1, stride)
        };
        worst = worst.min(unsafe { law.raw_block(&pointers) }?);
        for (r, row) in entries.iter().enumerate() {
            for (c, &entry) in row.iter().enumerate() {
                let mirrored = entries.get(c).and_then(|row| row.get(r)).copied().unwrap_or(entry);
                // Halved first: the sum might overflow.
                let mean = entry * T::splat(0.5) + mirrored * T::splat(0.5);
                unsafe { *dsave.wrapping_add((6 * c + r).wrapping_mul(stride).wrapping_add(i)) = mean };
            }
        }
    }
    Ok(worst)
}

/// # Safety
/// As for `toron_lsdyna_linear_umat_f64`.
unsafe fn scalar<T: Precision>(
    cm: *const T,
    sig: *mut T,
    hsv: *mut T,
    nhv: i32,
    failel: *mut c_int,
) -> Result<i32, Error> {
    check_pointers(&[(cm, "cm"), (sig, "sig"), (hsv, "hsv")])?;
    check_pointers(&[(failel.cast_const(), "failel")])?;
    let stress = [0, 1, 2, 3, 4, 5].map(|c| sig.wrapping_add(c));
    let elements = Elements { stress, history: hsv, leading_dimension: 1, first: 0, count: 1, failed: failel };
    // SAFETY: the caller's promise.
    unsafe { evaluate::<T, LinearElastic<T>>(cm, nhv, &elements) }
}

/// `toron_lsdyna_linear_umat_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_umat_f64(
    cm: *const f64,
    sig: *mut f64,
    hsv: *mut f64,
    nhv: i32,
    failel: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || scalar(cm, sig, hsv, nhv, failel)) }
}

/// `toron_lsdyna_linear_umat_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_umat_f32(
    cm: *const f32,
    sig: *mut f32,
    hsv: *mut f32,
    nhv: i32,
    failel: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || scalar(cm, sig, hsv, nhv, failel)) }
}

/// `toron_lsdyna_linear_umat_vector_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn linear_umat_vector_f64(
    cm: *const f64,
    sig1: *mut f64,
    sig2: *mut f64,
    sig3: *mut f64,
    sig4: *mut f64,
    sig5: *mut f64,
    sig6: *mut f64,
    hsvs: *mut f64,
    nhv: i32,
    lft: i32,
    llt: i32,
    nlq: i32,
    failels: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            vector::<_, LinearElastic<_>>(cm, [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, [lft, llt, nlq], failels)
        })
    }
}

/// `toron_lsdyna_linear_umat_vector_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn linear_umat_vector_f32(
    cm: *const f32,
    sig1: *mut f32,
    sig2: *mut f32,
    sig3: *mut f32,
    sig4: *mut f32,
    sig5: *mut f32,
    sig6: *mut f32,
    hsvs: *mut f32,
    nhv: i32,
    lft: i32,
    llt: i32,
    nlq: i32,
    failels: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            vector::<_, LinearElastic<_>>(cm, [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, [lft, llt, nlq], failels)
        })
    }
}

/// # Safety
/// As for `toron_lsdyna_linear_utan_f64`.
unsafe fn scalar_tangent<T: Precision>(cm: *const T, hsv: *const T, nhv: i32, es: *mut T) -> Result<i32, Error> {
    check_pointers(&[(cm, "cm"), (hsv, "hsv"), (es, "es")])?;
    // SAFETY: the caller's promise.
    unsafe { tangent(cm, hsv, nhv, [0, 1, 1], es) }
}

/// `toron_lsdyna_linear_utan_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_utan_f64(
    cm: *const f64,
    hsv: *const f64,
    nhv: i32,
    es: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || scalar_tangent(cm, hsv, nhv, es)) }
}

/// # Safety
/// As for `toron_lsdyna_linear_utan_vector_f64`.
unsafe fn vector_tangent<T: Precision>(
    cm: *const T,
    hsvs: *const T,
    nhv: i32,
    range: [i32; 3],
    dsave: *mut T,
) -> Result<i32, Error> {
    check_pointers(&[(cm, "cm"), (hsvs, "hsvs"), (dsave, "dsave")])?;
    // SAFETY: the caller's promise.
    unsafe { tangent(cm, hsvs, nhv, element_range(range)?, dsave) }
}

/// `toron_lsdyna_linear_utan_vector_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_utan_vector_f64(
    cm: *const f64,
    hsvs: *const f64,
    nhv: i32,
    lft: i32,
    llt: i32,
    nlq: i32,
    dsave: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || vector_tangent(cm, hsvs, nhv, [lft, llt, nlq], dsave)) }
}

/// `toron_lsdyna_linear_utan_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_utan_f32(
    cm: *const f32,
    hsv: *const f32,
    nhv: i32,
    es: *mut f32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || scalar_tangent(cm, hsv, nhv, es)) }
}

/// `toron_lsdyna_linear_utan_vector_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_utan_vector_f32(
    cm: *const f32,
    hsvs: *const f32,
    nhv: i32,
    lft: i32,
    llt: i32,
    nlq: i32,
    dsave: *mut f32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || vector_tangent(cm, hsvs, nhv, [lft, llt, nlq], dsave)) }
}

/// `toron_lsdyna_linear_bulk_and_shear_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn linear_bulk_and_shear_f64(
    values: *const f64,
    count: usize,
    bulk: *mut f64,
    shear: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            bulk_and_shear::<LinearElastic<f64>>(values, count, bulk, shear)
        })
    }
}
