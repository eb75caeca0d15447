//! LS-DYNA: user materials, scalar (`umat41`) and vectorised (`umat41v`), and their tangents (`utan41`, `utan41v`).
//!
//! | | |
//! |---|---|
//! | properties | cm(1) … cm(11); cm(12), cm(13) hold bulk and shear modulus for IBULK = 12, IG = 13 |
//! | deformation | F by columns in the history after the NHV = 11 state variables: hsv(12) … hsv(20), read only |
//! | arrays, vectorised | leading dimension nlq: variable j of element i at hsvs((i − 1) + (j − 1) nlq) |
//! | stress | Cauchy 11 22 33 12 23 31, global |
//! | card | IHYPER = −1, IORTHO = 1: fibre (1, 0, 0); or IHYPER = 1, IORTHO = 0: fibre in global axes; IFAIL = 1 |
//! | tangent | es(6, 6), dsave(nlq, 6, 6): Truesdell modulus of the Cauchy stress, the stress's order, engineering shears, global |
//! | failure | failel; F inverted or not finite fails the element too |
//!
//! Solids only. The symbols that LS-DYNA looks for are in `fortran-shim/`.

use core::cell::Cell;
use core::ffi::c_int;

use libc::{c_char, size_t};

use crate::law::block::{Pointers, Precision, components};
use crate::law::derivative::SixBySix;
use crate::law::derivative::StressAndState;
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::number::level::Level;
use crate::law::number::real::Scalar;
use crate::law::number::registers::Registers;
use crate::law::number::vector::dot;
use crate::law::parameters;
use crate::law::point::{Call, Point, Sink, evaluate_call};
use crate::law::response::Request;
use crate::law::state::{ALIVE, ENERGIES, FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use crate::law::status;
use crate::law::tangent::Measure;

use super::border::{Message, check_pointers, entry, properties, store};
use super::c::PointAnswer;

/// `count` elements of a vector block from `first` on, counted from 0.
struct Elements<T> {
    stress: [*mut T; 6],
    history: *mut T,
    leading_dimension: usize,
    first: usize,
    count: usize,
    failed: *mut c_int,
}

fn wrong_nhv(nhv: i32) -> Error {
    let what = "number of history variables, NHV";
    Error::Count { code: status::STATE_COUNT, what, found: i64::from(nhv), wanted: HYPERELASTIC_STATE as i64 }
}

/// Checks the elements of a vector block and their leading dimension.
fn check_elements(lft: i32, llt: i32, nlq: i32) -> Result<(), Error> {
    let wrong = |name: &'static str, value: i32, least: i64| {
        let value = i64::from(value);
        Err(Error::Range { code: status::BAD_COUNT, name, value, least, greatest: i64::MAX })
    };
    if lft < 1 {
        return wrong("lft", lft, 1);
    }
    if llt < lft - 1 {
        return wrong("llt (no less than lft - 1)", llt, i64::from(lft) - 1);
    }
    if nlq < llt {
        let (found, wanted) = (i64::from(nlq), i64::from(llt));
        return Err(Error::Count {
            code: status::BAD_LEADING_DIMENSION,
            what: "leading dimension, nlq",
            found,
            wanted,
        });
    }
    Ok(())
}

/// The law with the properties of the card. Refuses a wrong number of history variables.
///
/// # Safety
/// As for `toron_lsdyna_umat_vector_f64`.
unsafe fn law<T: Precision>(cm: *const T, nhv: i32) -> Result<Hyperelastic<T>, Error> {
    if nhv != HYPERELASTIC_STATE as i32 {
        return Err(wrong_nhv(nhv));
    }
    // SAFETY: the caller's promise.
    Hyperelastic::new(unsafe { properties(cm, parameters::HYPERELASTIC_PROPERTIES, &parameters::HYPERELASTIC) }?)
}

/// Whether the history of an element can be that of this law, with F behind the state variables: `history(j)` is hsv(j + 1), j
/// below 20.
///
/// LS-DYNA passes the card's NHV to no routine. With IHYPER = 0 there is no F; if NHV is not 11, F is at another place, behind
/// zeros. Before the first call of an element, F is a rotation or nearly one, which two of its columns show. After a call,
/// `failed` and `alive` show that the state is this law's: each is 0 or 1, and not both are 0. NHV from 14 to 19 is not
/// detected if the first column of F then seems to be zero. Values that are not finite are left to the law.
fn is_plausible<T: Scalar>(history: impl Fn(usize) -> T) -> bool {
    const F: usize = HYPERELASTIC_STATE;
    let h = |j: usize| -> f64 { history(j).into() };
    if (F..F + 9).all(|j| h(j) == 0.0) {
        return false;
    }
    let [failed, alive] = [FAILED, ALIVE].map(h);
    if [failed, alive].iter().all(|flag| [0.0, 1.0].contains(flag)) && failed + alive > 0.0 {
        // Entries of an F at another place may look like such flags; then there are zeros where F is read. No F has a row or
        // column of zeros.
        let zeros = |first: usize, stride: usize| (0..3).all(|i| h(first + i * stride) == 0.0);
        return !(0..3).any(|k| zeros(F + 3 * k, 1) || zeros(F + k, 3));
    }
    let is_at = |start: usize| {
        let [a, b] = [start, start + 3].map(|column| [0, 1, 2].map(|i| h(column + i)));
        [dot(a, a) - 1.0, dot(b, b) - 1.0, dot(a, b)].iter().all(|x| x.abs() < 0.25)
    };
    let leading_zeros = (0..F + 2).take_while(|&j| h(j) == 0.0).count();
    let mut elsewhere = if leading_zeros < F { 0..=leading_zeros } else { F + 1..=leading_zeros };
    !elsewhere.any(is_at)
}

/// Evaluates the law at the elements in place, and marks those as failed that have failed or could not be evaluated.
///
/// # Safety
/// As for `toron_lsdyna_umat_vector_f64`.
unsafe fn evaluate<T: Precision>(law: &Hyperelastic<T>, elements: &Elements<T>) -> Result<i32, Error> {
    const CHUNK: usize = 64;
    let Elements { leading_dimension: stride, .. } = *elements;
    let mut worst = status::OK;
    let mut done = 0;
    while done < elements.count {
        let start = elements.first + done;
        let n = CHUNK.min(elements.count - done);
        let mut codes = [status::OK; CHUNK];
        let row = |variable: usize| elements.history.wrapping_add(variable.wrapping_mul(stride).wrapping_add(start));
        let pointers = Pointers {
            deformation_gradient: components(row(HYPERELASTIC_STATE), stride),
            energies_old: row(ENERGIES),
            invariants_old: row(INVARIANTS),
            failure_old: row(FAILURE_INDEX),
            stress: elements.stress.map(|component| component.wrapping_add(start)),
            energies: row(ENERGIES),
            invariants: row(INVARIANTS),
            failure: row(FAILURE_INDEX),
            status: codes.as_mut_ptr(),
            ..Pointers::without_arrays(n, stride)
        };
        // SAFETY: the caller's promise; the arrays are those of n elements from `start` on.
        worst = worst.min(unsafe { law.raw_block(&pointers) }?);
        for (i, &code) in codes.iter().take(n).enumerate() {
            // SAFETY: the element is one of the block.
            unsafe {
                let failed = row(FAILED).add(i);
                if code != status::OK {
                    *failed = T::splat(1.0);
                    *row(ALIVE).add(i) = T::splat(0.0);
                }
                *elements.failed.add(start + i) = c_int::from(!(*failed).lt(T::splat(0.5)));
            }
        }
        done += n;
    }
    Ok(worst)
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
unsafe fn element<'a, T: Scalar>(cm: *const T, hsv: *const T, nhv: i32) -> Result<ElementArguments<'a, T>, Error> {
    if nhv != HYPERELASTIC_STATE as i32 {
        return Err(wrong_nhv(nhv));
    }
    // SAFETY: the caller's promise.
    unsafe {
        let properties = properties(cm, parameters::HYPERELASTIC_PROPERTIES, &parameters::HYPERELASTIC)?;
        if !is_plausible(|j| *hsv.add(j)) {
            Hyperelastic::new(properties)?;
            return Err(Error::Plain(status::NO_DEFORMATION_GRADIENT));
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
    fn take(self, mut point: Point<T>, _: [T; 0]) {
        *self.status = point.status;
        if point.status != status::OK {
            point.state[FAILED] = T::splat(1.0);
            point.state[ALIVE] = T::splat(0.0);
        }
        // SAFETY: `scalar` makes this from pointers to arrays of these sizes, as its caller promises.
        unsafe {
            *self.sig.cast() = point.stress;
            *self.hsv.cast() = point.state;
            *self.failel = c_int::from(!point.state[FAILED].lt(T::splat(0.5)));
        }
    }
}

/// # Safety
/// As for `toron_lsdyna_umat_f64`.
unsafe fn scalar<T: Registers>(
    cm: *const T,
    sig: *mut T,
    hsv: *mut T,
    nhv: i32,
    failel: *mut c_int,
) -> Result<i32, Error> {
    // Each pointer is looked at only if one of them is null.
    if cm.is_null() | sig.is_null() | hsv.is_null() | failel.is_null() {
        check_pointers(&[(cm, "cm"), (sig, "sig"), (hsv, "hsv")])?;
        check_pointers(&[(failel.cast_const(), "failel")])?;
    }
    // SAFETY: the caller's promise.
    let (source, f, state) = unsafe { element(cm, hsv, nhv) }?;
    let mut status = status::OK;
    let sink = Element { sig, hsv, failel, status: &mut status };
    evaluate_call(Call { source, f, fibre: None, state, tangent: StressAndState, sink }, Level::Avx512)?;
    Ok(status)
}

/// `toron_lsdyna_umat_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn umat_f64(
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

/// `toron_lsdyna_umat_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn umat_f32(
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
/// As for `toron_lsdyna_umat_vector_f64`.
#[allow(clippy::too_many_arguments)]
unsafe fn vector<T: Precision>(
    cm: *const T,
    stress: [*mut T; 6],
    hsvs: *mut T,
    nhv: i32,
    lft: i32,
    llt: i32,
    nlq: i32,
    failels: *mut c_int,
) -> Result<i32, Error> {
    check_pointers(&[(cm, "cm"), (hsvs, "hsvs")])?;
    check_pointers(&[(failels.cast_const(), "failels")])?;
    let [s1, s2, s3, s4, s5, s6] = stress.map(<*mut T>::cast_const);
    check_pointers(&[(s1, "sig1"), (s2, "sig2"), (s3, "sig3"), (s4, "sig4"), (s5, "sig5"), (s6, "sig6")])?;
    check_elements(lft, llt, nlq)?;
    let elements = Elements {
        stress,
        history: hsvs,
        leading_dimension: nlq as usize,
        first: (lft - 1) as usize,
        count: (llt - lft + 1) as usize,
        failed: failels,
    };
    // SAFETY: the caller's promise.
    unsafe {
        let law = law(cm, nhv)?;
        let first = elements.history.wrapping_add(elements.first);
        if elements.count > 0 && !is_plausible(|j| *first.wrapping_add(j * elements.leading_dimension)) {
            return Err(Error::Plain(status::NO_DEFORMATION_GRADIENT));
        }
        evaluate(&law, &elements)
    }
}

/// `toron_lsdyna_umat_vector_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn umat_vector_f64(
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
            vector(cm, [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, lft, llt, nlq, failels)
        })
    }
}

/// `toron_lsdyna_umat_vector_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn umat_vector_f32(
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
            vector(cm, [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, lft, llt, nlq, failels)
        })
    }
}

/// # Safety
/// As for `toron_lsdyna_utan_f64`.
unsafe fn scalar_tangent<T: Registers>(cm: *const T, hsv: *const T, nhv: i32, es: *mut T) -> Result<i32, Error> {
    check_pointers(&[(cm, "cm"), (hsv, "hsv"), (es, "es")])?;
    // SAFETY: the caller's promise.
    let (source, f, state) = unsafe { element(cm, hsv, nhv) }?;
    let none = core::ptr::null_mut;
    let mut status = status::OK;
    let sink = PointAnswer {
        stress: none(),
        state: none(),
        modes: none(),
        density: T::splat(1.0),
        wave_speed: none(),
        tangent: es,
        status: &mut status,
    };
    let tangent = SixBySix(Request::default(), Measure::Truesdell);
    evaluate_call(Call { source, f, fibre: None, state, tangent, sink }, Level::Avx512)?;
    Ok(status)
}

/// `toron_lsdyna_utan_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn utan_f64(
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

/// `toron_lsdyna_utan_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn utan_f32(
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

/// # Safety
/// As for `toron_lsdyna_utan_vector_f64`.
unsafe fn vector_tangent<T: Precision>(
    cm: *const T,
    hsvs: *const T,
    nhv: i32,
    lft: i32,
    llt: i32,
    nlq: i32,
    dsave: *mut T,
) -> Result<i32, Error> {
    check_pointers(&[(cm, "cm"), (hsvs, "hsvs"), (dsave, "dsave")])?;
    check_elements(lft, llt, nlq)?;
    let (start, stride) = ((lft - 1) as usize, nlq as usize);
    let row = |variable: usize| hsvs.wrapping_add(variable.wrapping_mul(stride).wrapping_add(start));
    let pointers = Pointers {
        deformation_gradient: components(row(HYPERELASTIC_STATE), stride),
        failure_old: row(FAILURE_INDEX),
        tangent: dsave.wrapping_add(start),
        measure: Measure::Truesdell,
        ..Pointers::without_arrays((llt - lft + 1) as usize, stride)
    };
    // SAFETY: the caller's promise.
    unsafe {
        let law = law(cm, nhv)?;
        if pointers.n > 0 && !is_plausible(|j| *row(j)) {
            return Err(Error::Plain(status::NO_DEFORMATION_GRADIENT));
        }
        law.raw_block(&pointers)
    }
}

/// `toron_lsdyna_utan_vector_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn utan_vector_f64(
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
    unsafe { entry(Message { text: message, capacity }, move || vector_tangent(cm, hsvs, nhv, lft, llt, nlq, dsave)) }
}

/// `toron_lsdyna_utan_vector_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn utan_vector_f32(
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
    unsafe { entry(Message { text: message, capacity }, move || vector_tangent(cm, hsvs, nhv, lft, llt, nlq, dsave)) }
}

/// `toron_lsdyna_bulk_and_shear_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn bulk_and_shear_f64(
    values: *const f64,
    count: usize,
    bulk: *mut f64,
    shear: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let body = move || {
        check_pointers(&[(bulk.cast_const(), "bulk"), (shear, "shear")])?;
        // SAFETY: the caller's promise.
        let law = Hyperelastic::new(unsafe { properties(values, count, &parameters::HYPERELASTIC) }?)?;
        let [k, g] = law.bulk_and_shear();
        // SAFETY: not null, and the caller's promise.
        unsafe {
            store(&[k], bulk);
            store(&[g], shear);
        }
        Ok(status::OK)
    };
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, body) }
}
