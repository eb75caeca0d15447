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

use libc::{c_char, size_t};

use message::History;

use crate::host::border::{Message, check_pointers, entry, properties, store};
use crate::law::block::Precision;
use crate::law::description::Description;
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::real::Scalar;
use crate::law::number::vector::dot;
use crate::law::status;
use crate::law::user::{User, UserMaterial};

/// A law as a user material of LS-DYNA. Its history is the law's state, the entries of F that are kept for it, and, behind these, F.
/// The routines return the worst status code.
pub trait UserRoutines<T: Precision>: History<T> {
    /// The material routine, with the arguments of `toron_lsdyna_umat_f64` in package `toron-c`.
    ///
    /// # Safety
    /// As documented there, with as many properties and history variables as the law has.
    #[inline(never)]
    unsafe fn umat(
        cm: *const T,
        sig: *mut T,
        hsv: *mut T,
        nhv: i32,
        failel: *mut c_int,
        message: *mut c_char,
        capacity: size_t,
    ) -> i32 {
        // SAFETY: the caller's promise.
        unsafe {
            entry(Message { text: message, capacity }, move || any_law::scalar::<T, Self>(cm, sig, hsv, nhv, failel))
        }
    }

    /// The vectorised one, with the arguments of `toron_lsdyna_umat_vector_f64`: `stress` is `sig1` to `sig6`, `range` `lft`, `llt` and
    /// `nlq`.
    ///
    /// # Safety
    /// As for [`umat`](Self::umat).
    #[allow(clippy::too_many_arguments)]
    #[inline(never)]
    unsafe fn umat_vector(
        cm: *const T,
        stress: [*mut T; 6],
        hsvs: *mut T,
        nhv: i32,
        range: [i32; 3],
        failels: *mut c_int,
        message: *mut c_char,
        capacity: size_t,
    ) -> i32 {
        // SAFETY: the caller's promise.
        unsafe {
            entry(Message { text: message, capacity }, move || {
                any_law::vector::<T, Self>(cm, stress, hsvs, nhv, range, failels)
            })
        }
    }

    /// The tangent, with the arguments of `toron_lsdyna_utan_f64`.
    ///
    /// # Safety
    /// As for [`umat`](Self::umat).
    #[inline(never)]
    unsafe fn utan(cm: *const T, hsv: *const T, nhv: i32, es: *mut T, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: the caller's promise.
        unsafe {
            entry(Message { text: message, capacity }, move || any_law::scalar_tangent::<T, Self>(cm, hsv, nhv, es))
        }
    }

    /// The vectorised one, with the arguments of `toron_lsdyna_utan_vector_f64`: `range` is `lft`, `llt` and `nlq`.
    ///
    /// # Safety
    /// As for [`umat`](Self::umat).
    #[inline(never)]
    unsafe fn utan_vector(
        cm: *const T,
        hsvs: *const T,
        nhv: i32,
        range: [i32; 3],
        dsave: *mut T,
        message: *mut c_char,
        capacity: size_t,
    ) -> i32 {
        // SAFETY: the caller's promise.
        unsafe {
            entry(Message { text: message, capacity }, move || {
                any_law::vector_tangent::<T, Self>(cm, hsvs, nhv, range, dsave)
            })
        }
    }

    /// The moduli that the card asks for, with the arguments of `toron_lsdyna_bulk_and_shear_f64`.
    ///
    /// # Safety
    /// As documented there.
    #[inline(never)]
    unsafe fn card_moduli(
        values: *const T,
        count: size_t,
        bulk: *mut T,
        shear: *mut T,
        message: *mut c_char,
        capacity: size_t,
    ) -> i32 {
        // SAFETY: the caller's promise.
        unsafe { entry(Message { text: message, capacity }, move || moduli::<T, Self>(values, count, bulk, shear)) }
    }
}

impl<M: UserMaterial, T: Precision> UserRoutines<T> for User<M, T> {}

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
    fn new(
        stress: [*mut T; 6],
        history: *mut T,
        [lft, llt, nlq]: [i32; 3],
        failed: *mut c_int,
    ) -> Result<Elements<T>, Error> {
        check_pointers(&[(history, "hsvs")])?;
        check_pointers(&[(failed, "failels")])?;
        let [s1, s2, s3, s4, s5, s6] = stress;
        check_pointers(&[(s1, "sig1"), (s2, "sig2"), (s3, "sig3"), (s4, "sig4"), (s5, "sig5"), (s6, "sig6")])?;
        let [first, count, leading_dimension] = element_range([lft, llt, nlq])?;
        Ok(Elements { stress, history, leading_dimension, first, count, failed })
    }

    /// Variable `j` of element `i`; the next element's is behind it.
    #[inline(always)]
    fn variable(&self, j: usize, i: usize) -> *mut T {
        self.history.wrapping_add(j.wrapping_mul(self.leading_dimension).wrapping_add(i))
    }

    /// Marks those of the elements from `start` on as failed that have failed or whose status says that they could not be evaluated.
    ///
    /// # Safety
    /// `codes` has the status of elements of the block, whose history and `failed` may be written.
    #[inline(always)]
    unsafe fn mark_failed(&self, law: &Description, start: usize, codes: &[i32]) {
        let (failed, alive) = (self.variable(law.failed, start), self.variable(law.alive, start));
        for (i, &code) in codes.iter().enumerate() {
            // SAFETY: the caller's promise.
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
    // SAFETY: the caller's promise, here and below.
    let [k, g] = L::new(unsafe { properties(values, count, L::DESCRIPTION.properties) }?)?.bulk_and_shear();
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

/// The law with the properties of the card. Refuses a history that cannot be this law's: `first(j)` is hsv(j + 1) of the first of
/// `count` elements, j below NHV + 9.
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
    // SAFETY: the caller's promise.
    let law = L::new(unsafe { properties(cm, table.len(), table) }?)?;
    if count > 0 && !is_plausible::<T, L>(first) {
        return Err(no_gradient::<T, L>());
    }
    Ok(law)
}

/// Whether the history of an element can be that of this law, with F behind the state variables: `history(j)` is hsv(j + 1), j
/// below NHV + 9.
///
/// LS-DYNA passes the card's NHV to no routine. With IHYPER = 0 there is no F; if NHV is another one, F is at another place, behind
/// zeros. Before the first call of an element, F is a rotation or nearly one, which its columns show. After a call,
/// `failed` and `alive` show that the state is this law's: each is 0 or 1, and not both are 0; then F may be anything, also with
/// rows or columns of zeros where the element has collapsed, unless a first F is seen elsewhere. Nine zeros are no F: an element
/// that collapses to a point in one step has entries that are rounded. An NHV that is greater by 3 to 8 is not detected if the first
/// column of F then seems to be zero. Values that are not finite are left to the law.
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
        // Entries of a first F at another place may look like such flags; then there are zeros where F is read. Only the F of
        // a collapsed element has a row or column of zeros as well.
        let zeros = |first: usize, stride: usize| (0..3).all(|i| h(first + i * stride) == 0.0);
        return !(0..3).any(|k| zeros(f + 3 * k, 1) || zeros(f + k, 3)) || !is_elsewhere();
    }
    !is_elsewhere()
}

/// The entries of the C interface for a law in one precision.
macro_rules! entries {
    (
        $law:ident, $t:ty, $module:ident::<$($parameter:ty),+>:
        $umat:ident, $umat_vector:ident, $utan:ident, $utan_vector:ident
    ) => {
        impl UserRoutines<$t> for $law<$t> {
            #[inline(always)]
            unsafe fn umat(
                cm: *const $t,
                sig: *mut $t,
                hsv: *mut $t,
                nhv: i32,
                failel: *mut c_int,
                message: *mut c_char,
                capacity: size_t,
            ) -> i32 {
                // SAFETY: the caller's promise.
                unsafe { $umat(cm, sig, hsv, nhv, failel, message, capacity) }
            }

            #[inline(always)]
            unsafe fn umat_vector(
                cm: *const $t,
                [sig1, sig2, sig3, sig4, sig5, sig6]: [*mut $t; 6],
                hsvs: *mut $t,
                nhv: i32,
                [lft, llt, nlq]: [i32; 3],
                failels: *mut c_int,
                message: *mut c_char,
                capacity: size_t,
            ) -> i32 {
                // SAFETY: the caller's promise.
                unsafe {
                    $umat_vector(
                        cm, sig1, sig2, sig3, sig4, sig5, sig6, hsvs, nhv, lft, llt, nlq, failels, message, capacity,
                    )
                }
            }

            #[inline(always)]
            unsafe fn utan(
                cm: *const $t,
                hsv: *const $t,
                nhv: i32,
                es: *mut $t,
                message: *mut c_char,
                capacity: size_t,
            ) -> i32 {
                // SAFETY: the caller's promise.
                unsafe { $utan(cm, hsv, nhv, es, message, capacity) }
            }

            #[inline(always)]
            unsafe fn utan_vector(
                cm: *const $t,
                hsvs: *const $t,
                nhv: i32,
                [lft, llt, nlq]: [i32; 3],
                dsave: *mut $t,
                message: *mut c_char,
                capacity: size_t,
            ) -> i32 {
                // SAFETY: the caller's promise.
                unsafe { $utan_vector(cm, hsvs, nhv, lft, llt, nlq, dsave, message, capacity) }
            }
        }

        /// The entry of the C interface with `toron_lsdyna_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// As documented there.
        #[inline(never)]
        pub unsafe extern "C" fn $umat(
            cm: *const $t,
            sig: *mut $t,
            hsv: *mut $t,
            nhv: i32,
            failel: *mut c_int,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            // SAFETY: the caller's promise.
            unsafe { entry(Message { text: message, capacity }, move || $module::scalar::<$($parameter),+>(cm, sig, hsv, nhv, failel)) }
        }

        /// The entry of the C interface with `toron_lsdyna_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// As documented there.
        #[allow(clippy::too_many_arguments)]
        #[inline(never)]
        pub unsafe extern "C" fn $umat_vector(
            cm: *const $t,
            sig1: *mut $t,
            sig2: *mut $t,
            sig3: *mut $t,
            sig4: *mut $t,
            sig5: *mut $t,
            sig6: *mut $t,
            hsvs: *mut $t,
            nhv: i32,
            lft: i32,
            llt: i32,
            nlq: i32,
            failels: *mut c_int,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            let stress = [sig1, sig2, sig3, sig4, sig5, sig6];
            // SAFETY: the caller's promise.
            unsafe {
                entry(Message { text: message, capacity }, move || {
                    any_law::vector::<$t, $law<$t>>(cm, stress, hsvs, nhv, [lft, llt, nlq], failels)
                })
            }
        }

        /// The entry of the C interface with `toron_lsdyna_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// As documented there.
        #[inline(never)]
        pub unsafe extern "C" fn $utan(
            cm: *const $t,
            hsv: *const $t,
            nhv: i32,
            es: *mut $t,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            // SAFETY: the caller's promise.
            unsafe { entry(Message { text: message, capacity }, move || $module::scalar_tangent::<$($parameter),+>(cm, hsv, nhv, es)) }
        }

        /// The entry of the C interface with `toron_lsdyna_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// As documented there.
        #[allow(clippy::too_many_arguments)]
        #[inline(never)]
        pub unsafe extern "C" fn $utan_vector(
            cm: *const $t,
            hsvs: *const $t,
            nhv: i32,
            lft: i32,
            llt: i32,
            nlq: i32,
            dsave: *mut $t,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            // SAFETY: the caller's promise.
            unsafe {
                entry(Message { text: message, capacity }, move || {
                    $module::vector_tangent::<$($parameter),+>(cm, hsvs, nhv, [lft, llt, nlq], dsave)
                })
            }
        }
    };
}

entries!(Hyperelastic, f64, hyperelastic::<f64>: umat_f64, umat_vector_f64, utan_f64, utan_vector_f64);
entries!(Hyperelastic, f32, hyperelastic::<f32>: umat_f32, umat_vector_f32, utan_f32, utan_vector_f32);
entries!(
    LinearElastic, f64, any_law::<f64, LinearElastic<f64>>:
    linear_umat_f64, linear_umat_vector_f64, linear_utan_f64, linear_utan_vector_f64
);
entries!(
    LinearElastic, f32, any_law::<f32, LinearElastic<f32>>:
    linear_umat_f32, linear_umat_vector_f32, linear_utan_f32, linear_utan_vector_f32
);

/// The entry of the C interface for the moduli of a law.
macro_rules! moduli {
    ($law:ident: $bulk_and_shear:ident) => {
        /// The entry of the C interface with `toron_lsdyna_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// As documented there.
        #[inline(never)]
        pub unsafe extern "C" fn $bulk_and_shear(
            values: *const f64,
            count: usize,
            bulk: *mut f64,
            shear: *mut f64,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            // SAFETY: the caller's promise.
            unsafe { <$law<f64>>::card_moduli(values, count, bulk, shear, message, capacity) }
        }
    };
}

moduli!(Hyperelastic: bulk_and_shear_f64);
moduli!(LinearElastic: linear_bulk_and_shear_f64);
