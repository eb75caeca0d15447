//! The entries of the C interface, for the shims of the solver's SDK.

use core::slice;

use libc::{c_char, size_t};

use crate::host::border::{Message, check_pointers, entry};
use crate::law::block::Precision;
use crate::law::error::Error;
use crate::law::status;

use super::card::MOST_PARAMETERS;
use super::engine::{Group, evaluate};
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

/// # Safety
/// As for `toron_openradioss_lecm_f64`.
#[allow(clippy::too_many_arguments)]
unsafe fn starter<T: Precision>(
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
    let material = read(number, values, own.get_mut(..room).unwrap_or_default())?;
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
unsafe fn line_of_listing<T: Precision>(
    uparam: *const T,
    nuparam: i32,
    line: i32,
    text: Message,
) -> Result<i32, Error> {
    // SAFETY: the caller's promise, here and below. Where there is no line, the text is empty.
    unsafe { text.write(|_| ()) };
    let uparam = unsafe { array(uparam, nuparam, "UPARAM") }?;
    let line = usize::try_from(line).unwrap_or(usize::MAX);
    let mut found = Ok(false);
    unsafe { text.write(|sink| found = listing(uparam, line, sink)) };
    if found? { Ok(status::OK) } else { Err(Error::Plain(status::UNKNOWN_NAME)) }
}

/// `toron_openradioss_lecm_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn lecm_f64(
    number: i32,
    values: *const f64,
    count: size_t,
    uparam: *mut f64,
    maxuparam: i32,
    nuparam: *mut i32,
    nuvar: *mut i32,
    parmat: *mut f64,
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

/// `toron_openradioss_listing_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn listing_f64(
    uparam: *const f64,
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

/// `toron_openradioss_luser_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn luser_f64(
    nel: i32,
    nuparam: i32,
    nuvar: i32,
    time: f64,
    uparam: *const f64,
    ngl: *const i32,
    rho0: *const f64,
    fpsxx: *const f64,
    fpsyy: *const f64,
    fpszz: *const f64,
    fpsxy: *const f64,
    fpsyz: *const f64,
    fpszx: *const f64,
    fpsyx: *const f64,
    fpszy: *const f64,
    fpsxz: *const f64,
    signxx: *mut f64,
    signyy: *mut f64,
    signzz: *mut f64,
    signxy: *mut f64,
    signyz: *mut f64,
    signzx: *mut f64,
    sigvxx: *mut f64,
    sigvyy: *mut f64,
    sigvzz: *mut f64,
    sigvxy: *mut f64,
    sigvyz: *mut f64,
    sigvzx: *mut f64,
    soundsp: *mut f64,
    viscmax: *mut f64,
    uvar: *mut f64,
    off: *mut f64,
    nodes: *const f64,
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
        nodes,
    };
    // SAFETY: the caller's promise.
    unsafe { group_f64(&group, message, capacity) }
}

/// The same with the arguments in a structure, for Rust.
///
/// # Safety
/// As for [`evaluate`]; `message` is null or has `capacity` bytes.
pub unsafe fn group_f64(group: &Group<f64>, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || evaluate(group).map(|()| status::OK)) }
}

/// `toron_openradioss_lecm_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn lecm_f32(
    number: i32,
    values: *const f32,
    count: size_t,
    uparam: *mut f32,
    maxuparam: i32,
    nuparam: *mut i32,
    nuvar: *mut i32,
    parmat: *mut f32,
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

/// `toron_openradioss_listing_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn listing_f32(
    uparam: *const f32,
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

/// `toron_openradioss_luser_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn luser_f32(
    nel: i32,
    nuparam: i32,
    nuvar: i32,
    time: f32,
    uparam: *const f32,
    ngl: *const i32,
    rho0: *const f32,
    fpsxx: *const f32,
    fpsyy: *const f32,
    fpszz: *const f32,
    fpsxy: *const f32,
    fpsyz: *const f32,
    fpszx: *const f32,
    fpsyx: *const f32,
    fpszy: *const f32,
    fpsxz: *const f32,
    signxx: *mut f32,
    signyy: *mut f32,
    signzz: *mut f32,
    signxy: *mut f32,
    signyz: *mut f32,
    signzx: *mut f32,
    sigvxx: *mut f32,
    sigvyy: *mut f32,
    sigvzz: *mut f32,
    sigvxy: *mut f32,
    sigvyz: *mut f32,
    sigvzx: *mut f32,
    soundsp: *mut f32,
    viscmax: *mut f32,
    uvar: *mut f32,
    off: *mut f32,
    nodes: *const f32,
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
        nodes,
    };
    // SAFETY: the caller's promise.
    unsafe { group_f32(&group, message, capacity) }
}

/// The same with the arguments in a structure, for Rust.
///
/// # Safety
/// As for [`evaluate`]; `message` is null or has `capacity` bytes.
pub unsafe fn group_f32(group: &Group<f32>, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || evaluate(group).map(|()| status::OK)) }
}
