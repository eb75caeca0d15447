//! LS-DYNA: user materials, scalar (`umat41`) and vectorised (`umat41v`), and their tangents (`utan41`, `utan41v`).
//!
//! | | hyperelastic law | linear elastic law | a law with n properties and m state variables |
//! |---|---|---|---|
//! | properties | cm(1) … cm(11) | cm(1) … cm(10) | cm(1) … cm(n) |
//! | bulk and shear modulus | cm(12), cm(13): IBULK = 12, IG = 13 | cm(11), cm(12): IBULK = 11, IG = 12 | cm(n + 1), cm(n + 2) |
//! | history, NHV | 11 state variables | 19: 10 state variables, then the 9 entries of F of the last step, by columns | m, or m + 9 with the F of the last step |
//! | F by columns, behind it, read only | hsv(12) … hsv(20) | hsv(20) … hsv(28) | hsv(NHV + 1) … hsv(NHV + 9) |
//! | tangent | of the step | of a further, infinitesimal step; its symmetric part | of the step to F from the state written; its symmetric part |
//!
//! | | |
//! |---|---|
//! | arrays, vectorised | leading dimension nlq: variable j of element i at hsvs((i − 1) + (j − 1) nlq) |
//! | stress | Cauchy 11 22 33 12 23 31, global |
//! | card | IHYPER = −1, IORTHO = 1: fibre (1, 0, 0); or IHYPER = 1, IORTHO = 0: fibre in global axes; IFAIL = 1 |
//! | tangent | es(6, 6), dsave(nlq, 6, 6): Truesdell modulus of the Cauchy stress, the stress's order, engineering shears, global |
//! | failure | failel; F inverted or not finite fails the element too |
//!
//! Solids only. The symbols that LS-DYNA looks for are in `fortran-shim/`.

mod any_law;
mod hyperelastic;
mod message;

use core::ffi::c_int;
use core::ptr::null;

use libc::{c_char, size_t};

use message::History;

use crate::host::ByStep;
use crate::host::entry_points::{Message, check_pointers, entry, properties, stiffness_at_rest, store};
use crate::law::block::{Circumstances, Precision};
use crate::law::description::{Description, Reads};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::real::Scalar;
use crate::law::number::vector::dot;
use crate::law::status;

/// The arguments of a scalar material routine, `umat41`. Who makes these structures promises that every array that is
/// not null has as many values as its field says, valid for what it is used for; behind the history, `nhv` variables,
/// are the 9 entries of F by columns.
#[derive(Clone, Copy, Debug)]
pub struct Umat<T> {
    /// In: the law's properties, or more.
    pub cm: *const T,
    /// Out, 6: Cauchy stress.
    pub sig: *mut T,
    /// In and out, `nhv`; in, 9.
    pub hsv: *mut T,
    pub nhv: i32,
    /// Out, 1: 1 where the element has failed or could not be evaluated, else 0.
    pub failel: *mut c_int,
}

/// The arguments of a vectorised one, `umat41v`: arrays are (`nlq`, components), and elements `lft` to `llt`, counted
/// from 1, are evaluated.
#[derive(Clone, Copy, Debug)]
pub struct UmatVector<T> {
    pub cm: *const T,
    /// Out, `nlq` each: `sig1` to `sig6`.
    pub sig: [*mut T; 6],
    pub hsvs: *mut T,
    pub nhv: i32,
    pub lft: i32,
    pub llt: i32,
    pub nlq: i32,
    pub failels: *mut c_int,
}

/// The arguments of the tangent of an element, `utan41`.
#[derive(Clone, Copy, Debug)]
pub struct Utan<T> {
    pub cm: *const T,
    pub hsv: *const T,
    pub nhv: i32,
    /// Out, 6 × 6.
    pub es: *mut T,
}

/// The arguments of the vectorised one, `utan41v`.
#[derive(Clone, Copy, Debug)]
pub struct UtanVector<T> {
    pub cm: *const T,
    pub hsvs: *const T,
    pub nhv: i32,
    pub lft: i32,
    pub llt: i32,
    pub nlq: i32,
    /// Out, (`nlq`, 6, 6).
    pub dsave: *mut T,
}

/// When a step is, and how warm: `dt1`, `tt` and `temper` of an element; of a block `dt1siz` and `temps`, with a value
/// for each of its `nlq` elements, and `tt`. Null is not known; what a law does not read is not looked at.
#[derive(Clone, Copy, Debug)]
pub struct When<T> {
    pub time_increment: *const T,
    pub time: *const T,
    pub temperature: *const T,
}

impl<T: Scalar> When<T> {
    /// A caller that knows none of them.
    pub const UNKNOWN: Self = When { time_increment: null(), time: null(), temperature: null() };

    /// For `count` elements from `first` on, counted from 0, of a law that reads these.
    ///
    /// # Errors
    /// The elements have steps of different lengths.
    ///
    /// # Safety
    /// What is not null has a value for each of these elements, and `time` has one.
    unsafe fn circumstances(&self, first: usize, count: usize, reads: &Reads) -> Result<Circumstances<T>, Error> {
        let When { time_increment: steps, time, temperature } = *self;
        let mut circumstances = Circumstances { temperature, ..Circumstances::UNKNOWN }.from(first);
        // SAFETY: not null, and the elements are those of the arrays.
        unsafe {
            if reads.time_increment && !steps.is_null() && count > 0 {
                let length = (*steps.add(first)).into();
                // A length that is no number is left to the law, which says that it is not known.
                if !length.is_nan() && (first..first + count).any(|i| (*steps.add(i)).into() != length) {
                    let text =
                        "argument dt1siz differs between the elements of a block; allowed: one length of the step";
                    return Err(Error::Setting { code: status::BAD_ARGUMENT, text });
                }
                circumstances.time_increment = length;
            }
            if reads.time && !time.is_null() {
                circumstances.time = (*time).into();
            }
        }
        Ok(circumstances)
    }
}

/// A law as a user material of LS-DYNA. Its history is the law's state, the entries of F that are kept for it, and,
/// behind these, F. The routines return the worst status code, with a message of at most `capacity` bytes unless
/// `message` is null.
pub trait UserRoutines<T: Precision>: History<T> {
    /// The material routine.
    ///
    /// # Safety
    /// The arrays are those that [`Umat`] promises, and `message` is null or has `capacity` bytes.
    #[inline(never)]
    unsafe fn umat(call: &Umat<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the caller's.
        unsafe { Self::umat_at(call, &When::UNKNOWN, message, capacity) }
    }

    /// The same, for a law that reads time or temperature.
    ///
    /// # Safety
    /// As for [`umat`](Self::umat), and `when` is that of the arguments.
    #[inline(never)]
    unsafe fn umat_at(call: &Umat<T>, when: &When<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the arrays and the message are the caller's.
        unsafe { entry(Message { text: message, capacity }, || any_law::scalar::<T, Self>(call, when)) }
    }

    /// The vectorised one.
    ///
    /// # Safety
    /// As for [`umat`](Self::umat), with the arrays of [`UmatVector`].
    #[inline(never)]
    unsafe fn umat_vector(call: &UmatVector<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the caller's.
        unsafe { Self::umat_vector_at(call, &When::UNKNOWN, message, capacity) }
    }

    /// The same, for a law that reads time or temperature.
    ///
    /// # Safety
    /// As for [`umat_vector`](Self::umat_vector), and `when` is that of the arguments.
    #[inline(never)]
    unsafe fn umat_vector_at(call: &UmatVector<T>, when: &When<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the arrays and the message are the caller's.
        unsafe { entry(Message { text: message, capacity }, || any_law::vector::<T, Self>(call, when)) }
    }

    /// The tangent.
    ///
    /// # Safety
    /// As for [`umat`](Self::umat), with the arrays of [`Utan`].
    #[inline(never)]
    unsafe fn utan(call: &Utan<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the caller's.
        unsafe { Self::utan_at(call, &When::UNKNOWN, message, capacity) }
    }

    /// The same, for a law that reads time or temperature.
    ///
    /// # Safety
    /// As for [`utan`](Self::utan), and `when` is that of the arguments.
    #[inline(never)]
    unsafe fn utan_at(call: &Utan<T>, when: &When<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the arrays and the message are the caller's.
        unsafe { entry(Message { text: message, capacity }, || any_law::scalar_tangent::<T, Self>(call, when)) }
    }

    /// The vectorised one.
    ///
    /// # Safety
    /// As for [`umat`](Self::umat), with the arrays of [`UtanVector`].
    #[inline(never)]
    unsafe fn utan_vector(call: &UtanVector<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the caller's.
        unsafe { Self::utan_vector_at(call, &When::UNKNOWN, message, capacity) }
    }

    /// The same, for a law that reads time or temperature.
    ///
    /// # Safety
    /// As for [`utan_vector`](Self::utan_vector), and `when` is that of the arguments.
    #[inline(never)]
    unsafe fn utan_vector_at(call: &UtanVector<T>, when: &When<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the arrays and the message are the caller's.
        unsafe { entry(Message { text: message, capacity }, || any_law::vector_tangent::<T, Self>(call, when)) }
    }

    /// The moduli that the card asks for, for contact and the time step.
    ///
    /// # Safety
    /// `values` is null or has `count` properties; `bulk` and `shear` are null or can be written; `message` is as for
    /// [`umat`](Self::umat).
    #[inline(never)]
    unsafe fn card_moduli(
        values: *const T,
        count: size_t,
        bulk: *mut T,
        shear: *mut T,
        message: *mut c_char,
        capacity: size_t,
    ) -> i32 {
        // SAFETY: the arrays and the message are the caller's.
        unsafe { entry(Message { text: message, capacity }, || moduli::<T, Self>(values, count, bulk, shear)) }
    }
}

impl<L: ByStep + Law<T>, T: Precision> UserRoutines<T> for L {}

/// `count` elements of a vector block from `first` on, counted from 0.
struct Elements<T> {
    stress: [*mut T; 6],
    history: *mut T,
    leading_dimension: usize,
    first: usize,
    count: usize,
    failed: *mut c_int,
}

impl<T: Scalar> Elements<T> {
    /// The elements that the arguments of a vectorised material routine name. Refuses a null pointer or a wrong range.
    fn new(call: &UmatVector<T>) -> Result<Elements<T>, Error> {
        let UmatVector { sig, hsvs, lft, llt, nlq, failels, .. } = *call;
        check_pointers(&[(hsvs, "hsvs")])?;
        check_pointers(&[(failels, "failels")])?;
        let [s1, s2, s3, s4, s5, s6] = sig;
        check_pointers(&[(s1, "sig1"), (s2, "sig2"), (s3, "sig3"), (s4, "sig4"), (s5, "sig5"), (s6, "sig6")])?;
        let [first, count, leading_dimension] = element_range([lft, llt, nlq])?;
        Ok(Elements { stress: sig, history: hsvs, leading_dimension, first, count, failed: failels })
    }

    /// Variable `j` of element `i`; the next element's is behind it.
    #[inline(always)]
    fn variable(&self, j: usize, i: usize) -> *mut T {
        self.history.wrapping_add(j.wrapping_mul(self.leading_dimension).wrapping_add(i))
    }

    /// Marks those of the elements from `start` on as failed that have failed or whose status says that they could not
    /// be evaluated.
    ///
    /// # Safety
    /// `codes` has the status of elements of the block, whose history and `failed` may be written.
    #[inline(always)]
    unsafe fn mark_failed(&self, law: &Description, start: usize, codes: &[i32]) {
        let (failed, alive) = (self.variable(law.failed, start), self.variable(law.alive, start));
        for (i, &code) in codes.iter().enumerate() {
            // SAFETY: the elements from `start` on have a history and a flag, and `codes` has no more than there are.
            unsafe {
                if code != status::OK {
                    *failed.add(i) = T::splat(1.0);
                    *alive.add(i) = T::splat(0.0);
                }
                *self.failed.add(start + i) = c_int::from(!(*failed.add(i)).lt(T::splat(0.5)));
            }
        }
    }
}

/// The first element of a vector block counted from 0, their number and their leading dimension.
fn element_range([lft, llt, nlq]: [i32; 3]) -> Result<[usize; 3], Error> {
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
    Ok([(lft - 1) as usize, (llt - lft + 1) as usize, nlq as usize])
}

/// Stores the moduli that the card asks for, for contact and the time step.
///
/// # Safety
/// `values` has `count` properties, if it is not null; the other pointers that are not null may be written.
unsafe fn moduli<T: Precision, L: Law<T>>(
    values: *const T,
    count: usize,
    bulk: *mut T,
    shear: *mut T,
) -> Result<i32, Error> {
    check_pointers(&[(bulk, "bulk"), (shear, "shear")])?;
    // SAFETY: `properties` refuses null, and there are `count` values.
    let law = L::new(unsafe { properties(values, count, L::DESCRIPTION.properties) }?)?;
    let [k, g] = stiffness_at_rest(&law)?;
    // SAFETY: not null, as has been checked: one value each.
    unsafe {
        store(&[k], bulk);
        store(&[g], shear);
    }
    Ok(status::OK)
}

/// Refuses a wrong number of history variables.
fn check_number<T: Precision, L: History<T>>(nhv: i32) -> Result<(), Error> {
    let variables = L::DESCRIPTION.history();
    if nhv == variables as i32 {
        return Ok(());
    }
    let (found, wanted) = (i64::from(nhv), variables as i64);
    Err(Error::Count { code: status::STATE_COUNT, what: L::NUMBER, found, wanted })
}

/// The error of a history without F.
fn no_gradient<T: Precision, L: History<T>>() -> Error {
    Error::Setting { code: status::NO_DEFORMATION_GRADIENT, text: L::NO_GRADIENT }
}

/// The law with the properties of the card. Refuses a history that cannot be this law's: `first(j)` is hsv(j + 1) of
/// the first of `count` elements, j below NHV + 9.
///
/// # Safety
/// `cm` has the law's properties.
unsafe fn law<T: Precision, L: History<T>>(
    cm: *const T,
    nhv: i32,
    count: usize,
    first: impl Fn(usize) -> T,
) -> Result<L, Error> {
    check_number::<T, L>(nhv)?;
    let table = L::DESCRIPTION.properties;
    // SAFETY: `cm` has as many properties as the table.
    let law = L::new(unsafe { properties(cm, table.len(), table) }?)?;
    if count > 0 && !is_plausible::<T, L>(first) {
        return Err(no_gradient::<T, L>());
    }
    Ok(law)
}

/// Whether the history of an element can be that of this law, with F behind the state variables: `history(j)` is
/// hsv(j + 1), j below NHV + 9.
///
/// LS-DYNA passes the card's NHV to no routine. With IHYPER = 0 there is no F; if NHV is another one, F is at another
/// place, behind zeros. Before the first call of an element, F is a rotation or nearly one, which its columns show.
/// After a call, `failed` and `alive` show that the state is this law's: each is 0 or 1, and not both are 0; then F may
/// be anything, also with rows or columns of zeros where the element has collapsed, unless a first F is seen elsewhere
/// and not among the variables, where a law has that of the last step: zeros, `alive` and diag(1, 1, 0) are also the
/// numbers of a turned F from the ninth variable on. Nine zeros are no F: an element that collapses to a point in one
/// step has entries that are rounded. An NHV that is greater by 3 to 8 is not detected if the first column of F then
/// seems to be zero. Values that are not finite are left to the law.
fn is_plausible<T: Precision, L: Law<T>>(history: impl Fn(usize) -> T) -> bool {
    let f = L::DESCRIPTION.history();
    let h = |j: usize| -> f64 { history(j).into() };
    let is_at = |start: usize| {
        let column = |k: usize| [0, 1, 2].map(|i| h(start + 3 * k + i));
        let [a, b] = [0, 1].map(column);
        let near = |deviations: [f64; 3]| deviations.iter().all(|x| x.abs() < 0.25);
        // The history has a third column only of an F that starts before its place.
        let third = |c: [f64; 3]| near([dot(c, c) - 1.0, dot(a, c), dot(b, c)]);
        near([dot(a, a) - 1.0, dot(b, b) - 1.0, dot(a, b)]) && (start > f || third(column(2)))
    };
    let is_elsewhere = || {
        let leading_zeros = (0..f + 2).take_while(|&j| h(j) == 0.0).count();
        let mut starts = if leading_zeros < f { 0..=leading_zeros } else { f + 1..=leading_zeros };
        starts.any(is_at)
    };
    if (f..f + 9).all(|j| h(j) == 0.0) {
        return false;
    }
    let [failed, alive] = [L::DESCRIPTION.failed, L::DESCRIPTION.alive].map(h);
    if [failed, alive].iter().all(|flag| [0.0, 1.0].contains(flag)) && failed + alive > 0.0 {
        // Entries of a first F at another place may look like such flags; then there are zeros where F is read. Only
        // the F of a collapsed element has a row or column of zeros as well.
        let zeros = |first: usize, stride: usize| (0..3).all(|i| h(first + i * stride) == 0.0);
        let collapsed = (0..3).any(|k| zeros(f + 3 * k, 1) || zeros(f + k, 3));
        let keeps_one = L::DESCRIPTION.reads.old_gradient && is_at(L::DESCRIPTION.state.len());
        return !collapsed || keeps_one || !is_elsewhere();
    }
    !is_elsewhere()
}

/// The routines of a law, compiled here in one precision, once for whatever package uses them.
macro_rules! compiled {
    ($law:ident, $t:ty, $module:ident::<$($parameter:ty),+>) => {
        impl UserRoutines<$t> for $law<$t> {
            #[inline(never)]
            unsafe fn umat(call: &Umat<$t>, message: *mut c_char, capacity: size_t) -> i32 {
                // SAFETY: as in the trait.
                unsafe { entry(Message { text: message, capacity }, || $module::scalar::<$($parameter),+>(call, &When::UNKNOWN)) }
            }

            #[inline(never)]
            unsafe fn umat_vector(call: &UmatVector<$t>, message: *mut c_char, capacity: size_t) -> i32 {
                // SAFETY: as in the trait.
                unsafe { entry(Message { text: message, capacity }, || any_law::vector::<$t, Self>(call, &When::UNKNOWN)) }
            }

            #[inline(never)]
            unsafe fn utan(call: &Utan<$t>, message: *mut c_char, capacity: size_t) -> i32 {
                // SAFETY: as in the trait.
                unsafe { entry(Message { text: message, capacity }, || $module::scalar_tangent::<$($parameter),+>(call, &When::UNKNOWN)) }
            }

            #[inline(never)]
            unsafe fn utan_vector(call: &UtanVector<$t>, message: *mut c_char, capacity: size_t) -> i32 {
                // SAFETY: as in the trait.
                unsafe { entry(Message { text: message, capacity }, || $module::vector_tangent::<$($parameter),+>(call, &When::UNKNOWN)) }
            }

            #[inline(never)]
            unsafe fn card_moduli(
                values: *const $t,
                count: size_t,
                bulk: *mut $t,
                shear: *mut $t,
                message: *mut c_char,
                capacity: size_t,
            ) -> i32 {
                // SAFETY: as in the trait.
                unsafe { entry(Message { text: message, capacity }, || moduli::<$t, Self>(values, count, bulk, shear)) }
            }
        }
    };
}

compiled!(Hyperelastic, f64, hyperelastic::<f64>);
compiled!(Hyperelastic, f32, hyperelastic::<f32>);
compiled!(LinearElastic, f64, any_law::<f64, LinearElastic<f64>>);
compiled!(LinearElastic, f32, any_law::<f32, LinearElastic<f32>>);
