//! Any law as a user material of LS-DYNA, by its step.

use super::message::History;
use super::{Elements, Umat, UmatVector, Utan, UtanVector, When, element_range, law};
use crate::host::entry_points::{check_pointers, from_entry, start_at_rest};
use crate::law::block::{Precision, components, components_mut};
use crate::law::error::Error;
use crate::law::interface::Points;
use crate::law::status;
use crate::law::tangent::Measure;

/// The elements that a vectorised routine evaluates at once.
const CHUNK: usize = 64;

/// Evaluates the law at the elements in place, and marks those as failed that have failed or could not be evaluated.
///
/// # Safety
/// `cm` has the law's properties; the history and results of the elements may be written, and F is behind their
/// history.
unsafe fn evaluate_elements<T: Precision, L: History<T>>(
    cm: *const T,
    nhv: i32,
    elements: &Elements<T>,
    when: &When<T>,
) -> Result<i32, Error> {
    let Elements { leading_dimension: stride, first, count, .. } = *elements;
    // SAFETY: `cm` has the properties, and the first of the elements, of which `law` asks only if there is one, NHV + 9
    // variables.
    let law: L = unsafe { law(cm, nhv, count, |j| *elements.variable(j, first)) }?;
    // SAFETY: the elements are those of the arguments.
    let circumstances = unsafe { when.circumstances(first, count, &L::DESCRIPTION.reads) }?;
    let (mut worst, mut done) = (status::OK, 0);
    while done < count {
        let (start, n) = (first + done, CHUNK.min(count - done));
        let row = |variable: usize| elements.variable(variable, start);
        let (f, mut codes) = (row(L::DESCRIPTION.history()), [status::OK; CHUNK]);
        // Of a law that does not depend on F at the start of a step, this is F at its end, which is not written.
        let f_old = components_mut(row(L::DESCRIPTION.state.len()), stride);
        if L::DESCRIPTION.reads.old_gradient {
            // SAFETY: rows of the history, which have the n elements from `start` on.
            unsafe { start_at_rest(f_old, n) };
        }
        let points = Points {
            f_old: components(row(L::DESCRIPTION.state.len()).cast_const(), stride),
            f_new: components(f.cast_const(), stride),
            circumstances: circumstances.from(done),
            state_old: L::parts(row(0), stride),
            state_new: L::parts_mut(row(0), stride),
            stress: from_entry(elements.stress, start),
            status: codes.as_mut_ptr(),
            ..Points::without_arrays(n, stride)
        };
        // SAFETY: rows with the n elements from `start` on; the new state is in the place of the old one, and `codes`
        // has n ≤ CHUNK.
        worst = worst.min(unsafe { law.step(&points) }?);
        let codes = codes.get(..n).unwrap_or(&codes);
        if L::DESCRIPTION.reads.old_gradient {
            for (i, _) in codes.iter().enumerate().filter(|(_, code)| **code == status::OK) {
                for (old, new) in f_old.into_iter().zip(points.f_new) {
                    // SAFETY: as for `step`, and i < n.
                    unsafe { *old.add(i) = *new.add(i) };
                }
            }
        }
        // SAFETY: `codes` has the status of the n elements from `start` on.
        unsafe { elements.mark_failed(&L::DESCRIPTION, start, codes) };
        done += n;
    }
    law.told(worst)
}

/// The vectorised material routine.
///
/// # Safety
/// The arrays are those that [`UmatVector`] promises.
pub(super) unsafe fn vector<T: Precision, L: History<T>>(call: &UmatVector<T>, when: &When<T>) -> Result<i32, Error> {
    check_pointers(&[(call.cm, "cm")])?;
    let elements = Elements::new(call)?;
    // SAFETY: `check_pointers` has refused null; rows of `nlq` elements, of which these are some.
    unsafe { evaluate_elements::<T, L>(call.cm, call.nhv, &elements, when) }
}

/// The material routine of one element.
///
/// # Safety
/// The arrays are those that [`Umat`] promises.
pub(super) unsafe fn scalar<T: Precision, L: History<T>>(call: &Umat<T>, when: &When<T>) -> Result<i32, Error> {
    let Umat { cm, sig, hsv, nhv, failel } = *call;
    check_pointers(&[(cm, "cm"), (sig, "sig"), (hsv, "hsv")])?;
    check_pointers(&[(failel.cast_const(), "failel")])?;
    let stress = components_mut(sig, 1);
    let elements = Elements { stress, history: hsv, leading_dimension: 1, first: 0, count: 1, failed: failel };
    // SAFETY: `check_pointers` has refused null; rows of one element.
    unsafe { evaluate_elements::<T, L>(cm, nhv, &elements, when) }
}

/// The tangents of `count` elements from `first` on: of a step to F from the state that the material routine has
/// written, and where the law depends on F at the start, of a further, infinitesimal step. The symmetric part, which
/// LS-DYNA wants.
///
/// # Safety
/// `cm` has the law's properties, `hsvs` the histories and F of the elements; `dsave` may be written.
unsafe fn tangents<T: Precision, L: History<T>>(
    cm: *const T,
    hsvs: *const T,
    nhv: i32,
    [first, count, stride]: [usize; 3],
    dsave: *mut T,
    when: &When<T>,
) -> Result<i32, Error> {
    let row = |variable: usize, start: usize| hsvs.wrapping_add(variable.wrapping_mul(stride).wrapping_add(start));
    // SAFETY: `cm` has the properties, and the first of the elements, of which `law` asks only if there is one, NHV + 9
    // variables.
    let law: L = unsafe { law(cm, nhv, count, |j| *row(j, first)) }?;
    // SAFETY: the elements are those of the arguments.
    let circumstances = unsafe { when.circumstances(first, count, &L::DESCRIPTION.reads) }?;
    let mut worst = status::OK;
    for i in first..first + count {
        let f = components(row(L::DESCRIPTION.history(), i), stride);
        let (mut state, mut stress, mut entries) = (L::fresh(), [T::splat(0.0); 6], [[T::splat(0.0); 6]; 6]);
        for (j, variable) in state.as_mut().iter_mut().enumerate() {
            // SAFETY: i is one of the elements, and j one of the law's variables.
            *variable = unsafe { *row(j, i) };
        }
        let state = state.as_mut().as_mut_ptr();
        let point = Points {
            f_old: f,
            f_new: f,
            circumstances: circumstances.from(i - first),
            state_old: L::parts(state, 1),
            state_new: L::parts_mut(state, 1),
            stress: components_mut(stress.as_mut_ptr(), 1),
            tangent: entries.as_mut_ptr().cast(),
            measure: Measure::Truesdell,
            ..Points::without_arrays(1, 1)
        };
        // SAFETY: F is behind the history of element i; the other arrays are those of one point here, with one state.
        worst = worst.min(unsafe { law.step(&point) }?);
        for (r, row) in entries.iter().enumerate() {
            for (c, &entry) in row.iter().enumerate() {
                let mirrored = entries.get(c).and_then(|row| row.get(r)).copied().unwrap_or(entry);
                // Halved first: the sum might overflow.
                let mean = entry * T::splat(0.5) + mirrored * T::splat(0.5);
                // SAFETY: r and c are below 6, and i is one of the elements.
                unsafe { *dsave.wrapping_add((6 * c + r).wrapping_mul(stride).wrapping_add(i)) = mean };
            }
        }
    }
    law.told(worst)
}

/// # Safety
/// The arrays are those that [`Utan`] promises.
pub(super) unsafe fn scalar_tangent<T: Precision, L: History<T>>(call: &Utan<T>, when: &When<T>) -> Result<i32, Error> {
    let Utan { cm, hsv, nhv, es } = *call;
    check_pointers(&[(cm, "cm"), (hsv, "hsv"), (es, "es")])?;
    // SAFETY: `check_pointers` has refused null; rows of one element.
    unsafe { tangents::<T, L>(cm, hsv, nhv, [0, 1, 1], es, when) }
}

/// # Safety
/// The arrays are those that [`UtanVector`] promises.
pub(super) unsafe fn vector_tangent<T: Precision, L: History<T>>(
    call: &UtanVector<T>,
    when: &When<T>,
) -> Result<i32, Error> {
    let UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave } = *call;
    check_pointers(&[(cm, "cm"), (hsvs, "hsvs"), (dsave, "dsave")])?;
    // SAFETY: `check_pointers` has refused null; rows of `nlq` elements, of which these are some.
    unsafe { tangents::<T, L>(cm, hsvs, nhv, element_range([lft, llt, nlq])?, dsave, when) }
}
