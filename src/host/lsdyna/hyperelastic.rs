//! The hyperelastic law as a user material of LS-DYNA.

use core::cell::Cell;
use core::ffi::c_int;

use super::message::History;
use super::{Umat, Utan, UtanVector, When, check_number, element_range, is_plausible, law, no_gradient};
use crate::host::entry_points::{check_pointers, properties};
use crate::host::point_and_block::PointAnswer;
use crate::law::block::{Points, Precision, components};
use crate::law::derivative::SixBySix;
use crate::law::derivative::Stress;
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::number::level::Level;
use crate::law::number::real::Scalar;
use crate::law::number::registers::Registers;
use crate::law::own::Own;
use crate::law::parameters;
use crate::law::point::{Call, Sink, evaluate_call};
use crate::law::response::{Point, Request};
use crate::law::state::{ALIVE, ENERGIES, FAILED, HYPERELASTIC_STATE};
use crate::law::status;
use crate::law::tangent::Measure;

/// In the words of a library that had this law alone.
impl<T: Precision> History<T> for Hyperelastic<T> {
    const NUMBER: &'static str = "number of history variables, NHV";
    const NO_GRADIENT: &'static str =
        "there is no deformation gradient behind the history: set IHYPER = 1 or -1, and NHV = 11";
}

/// The card's properties, F by columns, and the state of an element.
type ElementArguments<'a, T> = (&'a [T], &'a [[T; 3]; 3], &'a [Cell<T>; HYPERELASTIC_STATE]);

/// The card's properties, and F and the state of an element. Refuses a wrong number of history variables.
///
/// # Errors
/// A wrong number of history variables; a wrong property; −106 if the history cannot hold F.
///
/// # Safety
/// `cm` has the law's properties, `hsv` its state and F.
unsafe fn element<'a, T: Precision>(cm: *const T, hsv: *const T, nhv: i32) -> Result<ElementArguments<'a, T>, Error> {
    check_number::<T, Hyperelastic<T>>(nhv)?;
    // SAFETY: `cm` has the properties, and behind the state, whose number has been checked, is F.
    unsafe {
        let properties = properties(cm, parameters::HYPERELASTIC_PROPERTIES, &parameters::HYPERELASTIC)?;
        if !is_plausible::<T, Hyperelastic<T>>(|j| *hsv.add(j)) {
            Hyperelastic::new(properties)?;
            return Err(no_gradient::<T, Hyperelastic<T>>());
        }
        Ok((properties, &*hsv.add(HYPERELASTIC_STATE).cast(), &*hsv.cast()))
    }
}

/// The sink of the scalar routine.
struct Element<'a, T> {
    sig: *mut T,
    hsv: *mut T,
    failel: *mut c_int,
    status: &'a mut i32,
}

impl<T: Scalar> Sink<T, 0> for Element<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, _: Option<T>, _: [T; 0]) {
        *self.status = point.status;
        // SAFETY: `scalar` makes this from the arrays that `Umat` promises, none of them null.
        unsafe {
            *self.sig.cast() = point.stress;
            *self.hsv.cast() = point.state;
            *self.failel = c_int::from(!point.state[FAILED].lt(T::splat(0.5)));
            if point.status != status::OK {
                *self.hsv.add(FAILED) = T::splat(1.0);
                *self.hsv.add(ALIVE) = T::splat(0.0);
                *self.failel = 1;
            }
        }
    }
}

/// # Safety
/// The arrays are those that [`Umat`] promises.
pub(super) unsafe fn scalar<T: Registers + Precision>(call: &Umat<T>, _: &When<T>) -> Result<i32, Error> {
    let Umat { cm, sig, hsv, nhv, failel } = *call;
    // Each pointer is looked at only if one of them is null.
    if cm.is_null() | sig.is_null() | hsv.is_null() | failel.is_null() {
        check_pointers(&[(cm, "cm"), (sig, "sig"), (hsv, "hsv")])?;
        check_pointers(&[(failel.cast_const(), "failel")])?;
    }
    // SAFETY: `check_pointers` has refused null; the arrays are those that `Umat` promises.
    let (source, f, state) = unsafe { element(cm, hsv, nhv) }?;
    let mut status = status::OK;
    let sink = Element { sig, hsv, failel, status: &mut status };
    evaluate_call(Call { source, f, own: Own::NONE, state, tangent: Stress::<true>, sink }, Level::Avx512)?;
    Ok(status)
}

/// # Safety
/// The arrays are those that [`Utan`] promises.
pub(super) unsafe fn scalar_tangent<T: Registers + Precision>(call: &Utan<T>, _: &When<T>) -> Result<i32, Error> {
    let Utan { cm, hsv, nhv, es } = *call;
    check_pointers(&[(cm, "cm"), (hsv, "hsv"), (es, "es")])?;
    // SAFETY: `check_pointers` has refused null; the arrays are those that `Utan` promises.
    let (source, f, state) = unsafe { element(cm, hsv, nhv) }?;
    let mut status = status::OK;
    let sink = PointAnswer { tangent: es, ..PointAnswer::nothing(&mut status) };
    let tangent = SixBySix(Request::default(), Measure::Truesdell);
    evaluate_call(Call { source, f, own: Own::NONE, state, tangent, sink }, Level::Avx512)?;
    Ok(status)
}

/// # Safety
/// The arrays are those that [`UtanVector`] promises.
pub(super) unsafe fn vector_tangent<T: Precision>(call: &UtanVector<T>, _: &When<T>) -> Result<i32, Error> {
    let UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave } = *call;
    check_pointers(&[(cm, "cm"), (hsvs, "hsvs"), (dsave, "dsave")])?;
    let [start, count, stride] = element_range([lft, llt, nlq])?;
    let row = |variable: usize| hsvs.wrapping_add(variable.wrapping_mul(stride).wrapping_add(start));
    let points = Points {
        f_new: components(row(HYPERELASTIC_STATE), stride),
        state_old: Hyperelastic::parts(row(ENERGIES), stride),
        tangent: dsave.wrapping_add(start),
        measure: Measure::Truesdell,
        ..Points::without_arrays(count, stride)
    };
    // SAFETY: `check_pointers` has refused null; rows of `nlq` elements, of which those from `start` on are evaluated.
    unsafe {
        let law: Hyperelastic<T> = law(cm, nhv, count, |j| *row(j))?;
        law.step(&points)
    }
}
