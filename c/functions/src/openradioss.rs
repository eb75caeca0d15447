//! OpenRadioss: user materials of solids, for the solver's SDK.

use core::ptr::null;

use libc::{c_char, size_t};
use toron::host::openradioss::{Group, ListingLine, MaterialCard, group_f32, group_f64};
use toron::host::openradioss::{read_card_f32, read_card_f64, write_line_f32, write_line_f64};

/// The starter's routine of a user material of OpenRadioss, `LECMUSERnn`, in double precision.
///
/// `number`: nn, 1 for the hyperelastic law, 2 for the linear elastic one and 3 for that with friction; `values`:
/// `count` numbers of the card behind the density, the law's properties and then the options; `uparam`: `maxuparam`
/// values, out; `nuparam`, `nuvar`: out; `parmat`: out, 1 value, the modulus of the fastest wave at rest. None may be
/// null.
///
/// Returns 0, or a code with which the starter is to be stopped, and nothing is written: a −1xx code
/// (`TORON_BAD_ARGUMENT` for a number or an option among them) or a −2xx code.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_openradioss_lecm_f64(
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
    let card = MaterialCard { number, values, count, uparam, maxuparam, nuparam, nuvar, parmat };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { read_card_f64(&card, message, capacity) }
}

/// A line of what the starter's listing says of a material of OpenRadioss: what its elements need, the values of the
/// card, and the names of the user variables.
///
/// `uparam`: `nuparam` values, as `toron_openradioss_lecm_f64` has written them; `line`: counted from 0; `text`: at
/// most `capacity` bytes, out, with the terminating null. Returns 0, `TORON_UNKNOWN_NAME` behind the last line, or
/// another code if `uparam` is not such an array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_openradioss_listing_f64(
    uparam: *const f64,
    nuparam: i32,
    line: i32,
    text: *mut c_char,
    capacity: size_t,
) -> i32 {
    let wanted = ListingLine { uparam, nuparam, line, text, capacity };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { write_line_f64(&wanted) }
}

/// The engine's routine of a user material of OpenRadioss, `LUSERnn`, for solids, in double precision.
///
/// `nel` elements; `uparam`: `nuparam` values; `time`: 0 in the first cycle; `ngl`: `nel` numbers of elements for
/// messages, or null; `rho0`: the reference density, 1 value; `fpsxx` … `fpsxz`: `nel` each, the deformation gradient;
/// `signxx` … `signzx`: `nel` each, out, the Cauchy stress; `sigvxx` … `sigvzx` and `viscmax`: out, 0, or null;
/// `soundsp`: `nel`, out, a bound of the wave speed; `uvar`: (`nel`, `nuvar`), in and out; `off`: `nel`, in and out, 0
/// where a point has failed or cannot be evaluated; `nodes`: (`nel`, 8, 3), what MAT_SOLID_GET_NOD_X gives, or null;
/// read at time 0 if the fibre comes from the nodes.
///
/// A point with `off` below 1 has no stress and keeps its state; `off` never rises. The variable `deleted` says why it
/// is out: 1 failed, 2 by the solver, or the −3xx code of the reason why it could not be evaluated.
///
/// Returns 0, or a code with which the run is to be stopped: a −1xx code (`TORON_NO_DEFORMATION_GRADIENT` where Ismstr
/// is not 10) or a −2xx code, and nothing is written; or `TORON_FIBRE_DIRECTION` or `TORON_LIMIT` of an element.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_openradioss_luser_f64(
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
        time_step: f64::NAN,
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
        nodes, // shims set it in the first cycle alone; without the volume it is not read in others
        volume: null(),
    };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { group_f64(&group, message, capacity) }
}

/// As `toron_openradioss_lecm_f64`, in single precision.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_openradioss_lecm_f32(
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
    let card = MaterialCard { number, values, count, uparam, maxuparam, nuparam, nuvar, parmat };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { read_card_f32(&card, message, capacity) }
}

/// As `toron_openradioss_listing_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_openradioss_listing_f32(
    uparam: *const f32,
    nuparam: i32,
    line: i32,
    text: *mut c_char,
    capacity: size_t,
) -> i32 {
    let wanted = ListingLine { uparam, nuparam, line, text, capacity };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { write_line_f32(&wanted) }
}

/// As `toron_openradioss_luser_f64`, in single precision.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_openradioss_luser_f32(
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
        time_step: f32::NAN,
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
        nodes, // shims set it in the first cycle alone; without the volume it is not read in others
        volume: null(),
    };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { group_f32(&group, message, capacity) }
}
