//! LS-DYNA: the functions that the shims in `fortran-shim/` call. For a law of name NAME and precision T, f64 or f32,
//! they are `NAME_lsdyna_umat_at_T`, `NAME_lsdyna_umat_vector_at_T`, `NAME_lsdyna_utan_at_T`,
//! `NAME_lsdyna_utan_vector_at_T` and `NAME_lsdyna_bulk_and_shear_T`, with the arguments of the functions of package
//! `toron-c` that have `toron` for NAME and no `at`, and before the message `dt1`, `tt` and `temper`, of a block
//! `dt1siz`, `tt` and `temps`: null where they are not known.

#[doc(hidden)]
#[macro_export]
macro_rules! lsdyna {
    (f64; $($law:ty as $name:literal, user $number:literal;)+) => {
        $($crate::lsdyna! { "_f64", f64, $law as $name })+
    };
    (f32; $($law:ty as $name:literal, user $number:literal;)+) => {
        $($crate::lsdyna! { "_f32", f32, $law as $name })+
    };
    ($suffix:literal, $t:ident, $law:ty as $name:literal) => {
        const _: () = {
            #[unsafe(export_name = concat!($name, "_lsdyna_umat_at", $suffix))]
            #[allow(clippy::too_many_arguments)]
            unsafe extern "C" fn umat_at(
                cm: *const $t,
                sig: *mut $t,
                hsv: *mut $t,
                nhv: i32,
                failel: *mut ::core::ffi::c_int,
                dt1: *const $t,
                tt: *const $t,
                temper: *const $t,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                let call = $crate::toron::host::lsdyna::Umat { cm, sig, hsv, nhv, failel };
                let when = $crate::toron::host::lsdyna::When { time_increment: dt1, time: tt, temperature: temper };
                // SAFETY: the arrays are as long as the structure says, and the message is the caller's.
                unsafe { $crate::lsdyna_routine!($t, $law, umat_at)(&call, &when, message, capacity) }
            }

            #[unsafe(export_name = concat!($name, "_lsdyna_umat_vector_at", $suffix))]
            #[allow(clippy::too_many_arguments)]
            unsafe extern "C" fn umat_vector_at(
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
                failels: *mut ::core::ffi::c_int,
                dt1siz: *const $t,
                tt: *const $t,
                temps: *const $t,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                let sig = [sig1, sig2, sig3, sig4, sig5, sig6];
                let call = $crate::toron::host::lsdyna::UmatVector { cm, sig, hsvs, nhv, lft, llt, nlq, failels };
                let when = $crate::toron::host::lsdyna::When { time_increment: dt1siz, time: tt, temperature: temps };
                // SAFETY: the arrays are as long as the structure says, and the message is the caller's.
                unsafe { $crate::lsdyna_routine!($t, $law, umat_vector_at)(&call, &when, message, capacity) }
            }

            #[unsafe(export_name = concat!($name, "_lsdyna_utan_at", $suffix))]
            #[allow(clippy::too_many_arguments)]
            unsafe extern "C" fn utan_at(
                cm: *const $t,
                hsv: *const $t,
                nhv: i32,
                es: *mut $t,
                dt1: *const $t,
                tt: *const $t,
                temper: *const $t,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                let call = $crate::toron::host::lsdyna::Utan { cm, hsv, nhv, es };
                let when = $crate::toron::host::lsdyna::When { time_increment: dt1, time: tt, temperature: temper };
                // SAFETY: the arrays are as long as the structure says, and the message is the caller's.
                unsafe { $crate::lsdyna_routine!($t, $law, utan_at)(&call, &when, message, capacity) }
            }

            #[unsafe(export_name = concat!($name, "_lsdyna_utan_vector_at", $suffix))]
            #[allow(clippy::too_many_arguments)]
            unsafe extern "C" fn utan_vector_at(
                cm: *const $t,
                hsvs: *const $t,
                nhv: i32,
                lft: i32,
                llt: i32,
                nlq: i32,
                dsave: *mut $t,
                dt1siz: *const $t,
                tt: *const $t,
                temps: *const $t,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                let call = $crate::toron::host::lsdyna::UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave };
                let when = $crate::toron::host::lsdyna::When { time_increment: dt1siz, time: tt, temperature: temps };
                // SAFETY: the arrays are as long as the structure says, and the message is the caller's.
                unsafe { $crate::lsdyna_routine!($t, $law, utan_vector_at)(&call, &when, message, capacity) }
            }

            #[unsafe(export_name = concat!($name, "_lsdyna_bulk_and_shear", $suffix))]
            unsafe extern "C" fn bulk_and_shear(
                values: *const $t,
                count: usize,
                bulk: *mut $t,
                shear: *mut $t,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                // SAFETY: the moduli and the message are the caller's.
                unsafe { $crate::lsdyna_routine!($t, $law, card_moduli)(values, count, bulk, shear, message, capacity) }
            }
        };
    };
}

/// A routine of a law in one precision.
#[doc(hidden)]
#[macro_export]
macro_rules! lsdyna_routine {
    ($t:ident, $law:ty, $routine:ident) => {
        <<$law as $crate::toron::host::Material<$t>>::Law as $crate::toron::host::lsdyna::UserRoutines<$t>>::$routine
    };
}
