//! The linear elastic law as a user material of LS-DYNA.

use core::ffi::c_int;

use super::{Elements, element_range, evaluate, law};
use crate::host::border::check_pointers;
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
pub(super) unsafe fn scalar<T: Precision>(
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

/// # Safety
/// As for `toron_lsdyna_linear_utan_f64`.
pub(super) unsafe fn scalar_tangent<T: Precision>(
    cm: *const T,
    hsv: *const T,
    nhv: i32,
    es: *mut T,
) -> Result<i32, Error> {
    check_pointers(&[(cm, "cm"), (hsv, "hsv"), (es, "es")])?;
    // SAFETY: the caller's promise.
    unsafe { tangent(cm, hsv, nhv, [0, 1, 1], es) }
}

/// # Safety
/// As for `toron_lsdyna_linear_utan_vector_f64`.
pub(super) unsafe fn vector_tangent<T: Precision>(
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
