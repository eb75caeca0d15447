//! The linear elastic law as a user material of LS-DYNA.

use core::ffi::c_int;

use libc::{c_char, size_t};

use super::{CHUNK, Elements, LINEAR_ELASTIC, element_range, store_moduli};
use crate::host::border::{Message, check_pointers, entry, from_entry, properties, start_at_rest};
use crate::law::block::linear::LinearPointers;
use crate::law::block::{Precision, components, components_mut};
use crate::law::error::Error;
use crate::law::linear_elastic::LinearElastic;
use crate::law::parameters::{self, LINEAR_ELASTIC_PROPERTIES};
use crate::law::status;
use crate::law::tangent::Measure;

/// Where F of the last step is kept, and where LS-DYNA writes F, in the history from 0.
const F_OLD: usize = LINEAR_ELASTIC.law.state.len();
const F: usize = LINEAR_ELASTIC.law.history();

/// The law with the properties of the card. Refuses a history that cannot be this law's.
///
/// # Safety
/// `cm` has the law's properties, `first(j)` is hsv(j + 1) of the first element, j below 28.
unsafe fn law<T: Precision>(
    cm: *const T,
    nhv: i32,
    count: usize,
    first: impl Fn(usize) -> T,
) -> Result<LinearElastic<T>, Error> {
    LINEAR_ELASTIC.check_number(nhv)?;
    // SAFETY: the caller's promise.
    let law = LinearElastic::new(unsafe { properties(cm, LINEAR_ELASTIC_PROPERTIES, &parameters::LINEAR_ELASTIC) }?)?;
    if count > 0 && !LINEAR_ELASTIC.is_plausible(first) {
        return Err(LINEAR_ELASTIC.no_gradient());
    }
    Ok(law)
}

/// Evaluates the law at the elements in place, and marks those as failed that have failed or could not be evaluated.
///
/// # Safety
/// As for `toron_lsdyna_linear_umat_vector_f64`.
unsafe fn evaluate<T: Precision>(cm: *const T, nhv: i32, elements: &Elements<T>) -> Result<i32, Error> {
    let Elements { leading_dimension: stride, first, count, .. } = *elements;
    // SAFETY: the caller's promise, here and below.
    let law = unsafe { law(cm, nhv, count, |j| *elements.variable(j, first)) }?;
    let (mut worst, mut done) = (status::OK, 0);
    while done < count {
        let (start, n) = (first + done, CHUNK.min(count - done));
        let row = |variable: usize| elements.variable(variable, start);
        let mut codes = [status::OK; CHUNK];
        let f_old = components_mut(row(F_OLD), stride);
        unsafe { start_at_rest(f_old, n) };
        let pointers = LinearPointers {
            f_old: components(row(F_OLD).cast_const(), stride),
            f_new: components(row(F), stride),
            state_old: row(0),
            state_new: row(0),
            stress: from_entry(elements.stress, start),
            status: codes.as_mut_ptr(),
            ..LinearPointers::without_arrays(n, stride)
        };
        worst = worst.min(unsafe { law.raw_block(&pointers) }?);
        for (i, &code) in codes.iter().take(n).enumerate() {
            if code == status::OK {
                for (c, old) in f_old.into_iter().enumerate() {
                    unsafe { *old.add(i) = *row(F + c).add(i) };
                }
            }
        }
        // SAFETY: the elements are those of the block.
        unsafe { elements.mark_failed(LINEAR_ELASTIC.law, start, codes.get(..n).unwrap_or(&codes)) };
        done += n;
    }
    Ok(worst)
}

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
    let law = unsafe { law(cm, nhv, count, |j| *row(j, first)) }?;
    let mut worst = status::OK;
    for i in first..first + count {
        let f = components(row(F, i), stride);
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
    unsafe { evaluate(cm, nhv, &elements) }
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

/// # Safety
/// As for `toron_lsdyna_linear_umat_vector_f64`.
unsafe fn vector<T: Precision>(
    cm: *const T,
    stress: [*mut T; 6],
    hsvs: *mut T,
    nhv: i32,
    range: [i32; 3],
    failels: *mut c_int,
) -> Result<i32, Error> {
    check_pointers(&[(cm, "cm")])?;
    let elements = Elements::new(stress, hsvs, range, failels)?;
    // SAFETY: the caller's promise.
    unsafe { evaluate(cm, nhv, &elements) }
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
            vector(cm, [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, [lft, llt, nlq], failels)
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
            vector(cm, [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, [lft, llt, nlq], failels)
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
    let moduli = move || {
        // SAFETY: the caller's promise, here and below.
        let law = LinearElastic::new(unsafe { properties(values, count, &parameters::LINEAR_ELASTIC) }?)?;
        Ok(law.bulk_and_shear())
    };
    unsafe { entry(Message { text: message, capacity }, move || store_moduli(moduli, bulk, shear)) }
}
