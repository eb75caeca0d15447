//! The entries of the C interface, for the shims of the solver's SDK.

use core::slice;

use libc::{c_char, size_t};

use crate::host::entry_points::{Message, check_pointers, entry};
use crate::law::error::Error;
use crate::law::status;

use super::engine::{Group, Motion, evaluate};
use super::laws::{Laws, MyReal};
use super::starter::{listing, read};

/// The buffer of an argument that the starter passes with its length.
///
/// # Errors
/// It is null or has a negative length.
///
/// # Safety
/// `array` is null or has `count` values.
unsafe fn array<'a, T>(array: *const T, count: i32, name: &'static str) -> Result<&'a [T], Error> {
    check_pointers(&[(array, name)])?;
    let code = status::BAD_COUNT;
    let value = i64::from(count);
    let least = 0;
    let wrong = Error::Range { code, name, value, least, greatest: i64::MAX };
    // SAFETY: the caller's promise.
    usize::try_from(count).map(|count| unsafe { slice::from_raw_parts(array, count) }).map_err(|_| wrong)
}

/// NUPARAM of toron's laws at most.
const MOST_PARAMETERS: usize = <f64 as MyReal>::TORON.most_parameters;

/// # Safety
/// As for `toron_openradioss_lecm_f64`.
#[allow(clippy::too_many_arguments)]
unsafe fn starter<T: MyReal>(
    number: i32,
    values: *const T,
    count: size_t,
    uparam: *mut T,
    maxuparam: i32,
    nuparam: *mut i32,
    nuvar: *mut i32,
    parmat: *mut T,
) -> Result<i32, Error> {
    check_pointers(&[(values, "values"), (uparam, "UPARAM"), (parmat, "PARMAT")])?;
    check_pointers(&[(nuparam.cast_const(), "NUPARAM"), (nuvar, "NUVAR")])?;
    let mut own = [T::splat(0.0); MOST_PARAMETERS];
    let room = usize::try_from(maxuparam).unwrap_or(0).min(MOST_PARAMETERS);
    // SAFETY: the caller's promise, here and below.
    let values = unsafe { slice::from_raw_parts(values, count) };
    let material = read(&T::TORON, number, values, own.get_mut(..room).unwrap_or_default())?;
    unsafe {
        uparam.copy_from_nonoverlapping(own.as_ptr(), material.parameters);
        *nuparam = material.parameters as i32;
        *nuvar = material.variables as i32;
        *parmat = material.modulus;
    }
    Ok(status::OK)
}

/// # Safety
/// As for `toron_openradioss_listing_f64`.
unsafe fn line_of_listing<T: MyReal>(uparam: *const T, nuparam: i32, line: i32, text: Message) -> Result<i32, Error> {
    // SAFETY: the caller's promise, here and below. Where there is no line, the text is empty.
    unsafe { text.write(|_| ()) };
    let uparam = unsafe { array(uparam, nuparam, "UPARAM") }?;
    let line = usize::try_from(line).unwrap_or(usize::MAX);
    let mut found = Ok(false);
    unsafe { text.write(|sink| found = listing(&T::TORON, uparam, line, sink)) };
    if found? { Ok(status::OK) } else { Err(Error::Plain(status::UNKNOWN_NAME)) }
}

/// The entries of the C interface in one precision.
macro_rules! entries {
    ($t:ty: $lecm:ident, $listing:ident, $luser:ident, $group:ident, $group_of:ident) => {
        /// The entry of the C interface with `toron_openradioss_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// As documented there.
        #[allow(clippy::too_many_arguments)]
        #[inline(never)]
        pub unsafe extern "C" fn $lecm(
            number: i32,
            values: *const $t,
            count: size_t,
            uparam: *mut $t,
            maxuparam: i32,
            nuparam: *mut i32,
            nuvar: *mut i32,
            parmat: *mut $t,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            // SAFETY: the caller's promise.
            unsafe {
                entry(Message { text: message, capacity }, move || {
                    starter(number, values, count, uparam, maxuparam, nuparam, nuvar, parmat)
                })
            }
        }

        /// The entry of the C interface with `toron_openradioss_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// As documented there.
        #[inline(never)]
        pub unsafe extern "C" fn $listing(
            uparam: *const $t,
            nuparam: i32,
            line: i32,
            text: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            let message = Message { text, capacity };
            // SAFETY: the caller's promise.
            unsafe {
                entry(Message { text: core::ptr::null_mut(), capacity: 0 }, move || {
                    line_of_listing(uparam, nuparam, line, message)
                })
            }
        }

        /// The entry of the C interface with `toron_openradioss_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// As documented there.
        #[allow(clippy::too_many_arguments)]
        #[inline(never)]
        pub unsafe extern "C" fn $luser(
            nel: i32,
            nuparam: i32,
            nuvar: i32,
            time: $t,
            uparam: *const $t,
            ngl: *const i32,
            rho0: *const $t,
            fpsxx: *const $t,
            fpsyy: *const $t,
            fpszz: *const $t,
            fpsxy: *const $t,
            fpsyz: *const $t,
            fpszx: *const $t,
            fpsyx: *const $t,
            fpszy: *const $t,
            fpsxz: *const $t,
            signxx: *mut $t,
            signyy: *mut $t,
            signzz: *mut $t,
            signxy: *mut $t,
            signyz: *mut $t,
            signzx: *mut $t,
            sigvxx: *mut $t,
            sigvyy: *mut $t,
            sigvzz: *mut $t,
            sigvxy: *mut $t,
            sigvyz: *mut $t,
            sigvzx: *mut $t,
            soundsp: *mut $t,
            viscmax: *mut $t,
            uvar: *mut $t,
            off: *mut $t,
            nodes: *const $t,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            let group = Group {
                elements: nel,
                parameters: nuparam,
                variables: nuvar,
                time,
                uparam,
                numbers: ngl,
                density: rho0,
                deformation_gradient: [fpsxx, fpsyy, fpszz, fpsxy, fpsyz, fpszx, fpsyx, fpszy, fpsxz],
                stress: [signxx, signyy, signzz, signxy, signyz, signzx],
                viscous: [sigvxx, sigvyy, sigvzz, sigvxy, sigvyz, sigvzx],
                sound_speed: soundsp,
                viscosity: viscmax,
                uvar,
                off,
                nodes, // shims set it in the first cycle alone; without what moves it is not read in others
                motion: Motion::unknown(),
            };
            // SAFETY: the caller's promise.
            unsafe { $group(&group, message, capacity) }
        }

        /// The same with the arguments in a structure, for Rust.
        ///
        /// # Safety
        /// As for [`evaluate`]; `message` is null or has `capacity` bytes.
        pub unsafe fn $group(group: &Group<$t>, message: *mut c_char, capacity: size_t) -> i32 {
            // SAFETY: the caller's promise.
            unsafe { $group_of(&<$t as MyReal>::TORON, group, message, capacity) }
        }

        /// The same with the laws of another list.
        ///
        /// # Safety
        /// As for [`evaluate`]; `message` is null or has `capacity` bytes.
        pub unsafe fn $group_of(laws: &Laws<$t>, group: &Group<$t>, message: *mut c_char, capacity: size_t) -> i32 {
            // SAFETY: the caller's promise.
            unsafe { entry(Message { text: message, capacity }, move || evaluate(laws, group).map(|()| status::OK)) }
        }
    };
}

entries!(f64: lecm_f64, listing_f64, luser_f64, group_f64, group_of_f64);
entries!(f32: lecm_f32, listing_f32, luser_f32, group_f32, group_of_f32);
