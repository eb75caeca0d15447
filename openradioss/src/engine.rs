//! The engine's five calls for a group of elements.
//!
//! The routines declare the leading arguments, up to the last one that they use: on the solver's platforms the caller removes the
//! arguments of a C routine, so that it may take fewer than it is given.

use std::cell::Cell;
use std::ffi::c_char;
use std::ptr::{null, null_mut};

#[cfg(feature = "single")]
use toron::host::openradioss::entries::group_f32 as evaluate;
#[cfg(not(feature = "single"))]
use toron::host::openradioss::entries::group_f64 as evaluate;
use toron::host::openradioss::{Group, needs_nodes};

use crate::Real;
use crate::solver::{nodes, stop};

/// What the first calls pass.
#[derive(Clone, Copy)]
struct Remembered {
    group: Group<Real>,
    /// The number of the material in the model, and nn of `/MAT/USERnn`.
    material: i32,
    number: i32,
}

const NOTHING: Remembered = Remembered {
    group: Group {
        elements: 0,
        parameters: 0,
        variables: 0,
        time: 0.0,
        uparam: null(),
        numbers: null(),
        density: null(),
        deformation_gradient: [null(); 9],
        stress: [null_mut(); 6],
        viscous: [null_mut(); 6],
        sound_speed: null_mut(),
        viscosity: null_mut(),
        uvar: null_mut(),
        off: null_mut(),
        nodes: null(),
    },
    material: 0,
    number: 0,
};

thread_local! {
    /// Between the first and the fourth call of a group on this thread.
    static REMEMBERED: Cell<Remembered> = const { Cell::new(NOTHING) };
}

fn remember(change: impl FnOnce(&mut Remembered)) {
    let mut remembered = REMEMBERED.get();
    change(&mut remembered);
    REMEMBERED.set(remembered);
}

/// The first call: the material's number in the model, and the density.
///
/// # Safety
/// The solver's promise: `material` is an integer, and `density` is valid until the fourth call.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn eng_get_law_user_var_(
    _cycle: *const i32,
    material: *const i32,
    _iptr: *const i32,
    _ipts: *const i32,
    _iptt: *const i32,
    _r11: *const Real,
    _r12: *const Real,
    _r13: *const Real,
    _r21: *const Real,
    _r22: *const Real,
    _r23: *const Real,
    _r31: *const Real,
    _r32: *const Real,
    _r33: *const Real,
    _old_stress_xx: *const Real,
    _old_stress_yy: *const Real,
    _old_stress_zz: *const Real,
    _old_stress_xy: *const Real,
    _old_stress_yz: *const Real,
    _old_stress_zx: *const Real,
    _strain_rate_xx: *const Real,
    _strain_rate_yy: *const Real,
    _strain_rate_zz: *const Real,
    _strain_rate_xy: *const Real,
    _strain_rate_yz: *const Real,
    _strain_rate_zx: *const Real,
    _strain_xx: *const Real,
    _strain_yy: *const Real,
    _strain_zz: *const Real,
    _strain_xy: *const Real,
    _strain_yz: *const Real,
    _strain_zx: *const Real,
    _strain_increment_xx: *const Real,
    _strain_increment_yy: *const Real,
    _strain_increment_zz: *const Real,
    _strain_increment_xy: *const Real,
    _strain_increment_yz: *const Real,
    _strain_increment_zx: *const Real,
    density: *const Real,
) {
    // SAFETY: the solver's promise.
    let material = unsafe { *material };
    REMEMBERED.set(Remembered { material, group: Group { density, ..NOTHING.group }, ..NOTHING });
}

/// The second call: the deformation gradient. Each array is followed by its length, which is the solver's vector length.
///
/// # Safety
/// The solver's promise: the arrays are valid until the fourth call.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn eng_get_law_user_var_2_(
    fpsxx: *const Real,
    _size_fpsxx: *const i32,
    fpsyy: *const Real,
    _size_fpsyy: *const i32,
    fpszz: *const Real,
    _size_fpszz: *const i32,
    fpsxy: *const Real,
    _size_fpsxy: *const i32,
    fpsyz: *const Real,
    _size_fpsyz: *const i32,
    fpszx: *const Real,
    _size_fpszx: *const i32,
    fpsyx: *const Real,
    _size_fpsyx: *const i32,
    fpszy: *const Real,
    _size_fpszy: *const i32,
    fpsxz: *const Real,
    _size_fpsxz: *const i32,
) {
    remember(|call| {
        call.group.deformation_gradient = [fpsxx, fpsyy, fpszz, fpsxy, fpsyz, fpszx, fpsyx, fpszy, fpsxz];
    });
}

/// The third call: counts and arrays of the group. The law is not evaluated yet, since the arrays for its stress come with the
/// fourth call.
///
/// # Safety
/// The solver's promise: counts and time are numbers, and the arrays are valid until the fourth call.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn eng_sigeps99_(
    nel: *const i32,
    nuparam: *const i32,
    nuvar: *const i32,
    number: *const i32,
    _nfunc: *const i32,
    _ifunc: *const i32,
    _npf: *const i32,
    _tf: *const Real,
    time: *const Real,
    _time_step: *const Real,
    uparam: *const Real,
    _rho: *const Real,
    _volume: *const Real,
    _eint: *const Real,
    ngl: *const i32,
    soundsp: *mut Real,
    _viscmax: *mut Real,
    uvar: *mut Real,
    off: *mut Real,
) {
    // SAFETY: the solver's promise.
    let (nel, nuparam, nuvar, number, time) = unsafe { (*nel, *nuparam, *nuvar, *number, *time) };
    remember(|call| {
        call.number = number;
        call.group = Group {
            elements: nel,
            parameters: nuparam,
            variables: nuvar,
            time,
            uparam,
            numbers: ngl,
            sound_speed: soundsp,
            uvar,
            off,
            ..call.group
        };
    });
}

/// The fourth call: the arrays for the stress. Evaluates the law. The viscous stress comes behind it; the solver has set that and
/// VISCMAX to 0, as they are to be.
///
/// # Safety
/// The solver's promise: the arrays have the solver's vector length, and those of the calls before are still valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eng_set_law_user_var_(
    signxx: *mut Real,
    signyy: *mut Real,
    signzz: *mut Real,
    signxy: *mut Real,
    signyz: *mut Real,
    signzx: *mut Real,
) {
    let Remembered { group, material, number } = REMEMBERED.replace(NOTHING);
    let elements = usize::try_from(group.elements).unwrap_or(0);
    // SAFETY: the solver's promise.
    let coordinates = if unsafe { needs_nodes(&group) } { nodes(elements) } else { Vec::new() };
    let group = Group {
        stress: [signxx, signyy, signzz, signxy, signyz, signzx],
        nodes: if coordinates.is_empty() { null() } else { coordinates.as_ptr() },
        ..group
    };
    let mut text = [0_u8; toron::host::c::TORON_MESSAGE_CAPACITY];
    // SAFETY: the solver's promise; the text has the size passed.
    let status = unsafe { evaluate(&group, text.as_mut_ptr().cast::<c_char>(), text.len()) };
    if status < 0 {
        let text = text.split(|&byte| byte == 0).next().unwrap_or_default();
        stop(&format!("/MAT/USER{number:02}/{material}: {}", String::from_utf8_lossy(text)));
    }
}

/// The fifth call: nothing else is output.
#[unsafe(no_mangle)]
pub extern "C" fn eng_set_law_user_var_2_() {}
