//! Abaqus: UMAT and VUMAT.

use core::ptr::{null, null_mut};

use libc::{c_char, size_t};
use toron::host::abaqus::{ExplicitLaw, StandardLaw, Umat, Vumat};
use toron::law::block::Circumstances;
use toron::{Frictional, Hyperelastic, LinearElastic};

/// The hyperelastic law as a UMAT of Abaqus/Standard.
///
/// The arguments are those of a UMAT with the same names: `stress` (`ntens` = `ndi` + `nshr`, out), `statev` (`nstatv`
/// ≥ 11, in and out), `ddsdde` (`ntens` × `ntens`, out, symmetric, engineering shears; if null, it is not computed),
/// `sse` (out), `pnewdt` (in and out), `dfgrd1` (9, in), `props` (`nprops` = 11, in, or 12: the last one is the number
/// of the state variable that holds the point's own limit, ln(1 + eps_lim), or 0), `ndi` = 3, `nshr` = 3, or 1 for
/// plane strain and axisymmetric solids, whose fibre lies in the plane or normal to it, and `nlgeom`: JSTEP(3) of
/// Abaqus, which is not 0 with NLGEOM=YES; without it there is no F. No pointer other than `ddsdde` may be null.
///
/// DDSDDE is the modulus of the Jaumann rate of the Kirchhoff stress, over J. The call that detects failure returns the
/// intact tangent, later calls return zeros.
///
/// Returns 0; a −1xx code (`TORON_NO_DEFORMATION_GRADIENT` where `nlgeom` is 0, `TORON_BAD_ARGUMENT` for a limit of the
/// point that is negative, NaN or infinite) or a −2xx code (`TORON_FIBRE_OUT_OF_PLANE` among them), and nothing is
/// written; or a −3xx code: stress and tangent are 0, the state is unchanged, `pnewdt` is reduced to at most 0.25.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_abaqus_umat_tangent_f64(
    stress: *mut f64,
    statev: *mut f64,
    ddsdde: *mut f64,
    sse: *mut f64,
    pnewdt: *mut f64,
    dfgrd1: *const f64,
    props: *const f64,
    nprops: i32,
    nstatv: i32,
    ndi: i32,
    nshr: i32,
    nlgeom: i32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat {
        stress,
        statev,
        ddsdde,
        sse,
        pnewdt,
        dfgrd0: null(),
        dfgrd1,
        props,
        nprops,
        nstatv,
        ndi,
        nshr,
        nlgeom,
        circumstances: Circumstances::UNKNOWN,
    };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic>::umat(&call, message, capacity) }
}

/// As `toron_abaqus_umat_tangent_f64` without DDSDDE, for hosts that want none.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_abaqus_umat_f64(
    stress: *mut f64,
    statev: *mut f64,
    sse: *mut f64,
    pnewdt: *mut f64,
    dfgrd1: *const f64,
    props: *const f64,
    nprops: i32,
    nstatv: i32,
    ndi: i32,
    nshr: i32,
    nlgeom: i32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat {
        stress,
        statev,
        ddsdde: null_mut(),
        sse,
        pnewdt,
        dfgrd0: null(),
        dfgrd1,
        props,
        nprops,
        nstatv,
        ndi,
        nshr,
        nlgeom,
        circumstances: Circumstances::UNKNOWN,
    };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic>::umat(&call, message, capacity) }
}

/// The linear elastic law as a UMAT of Abaqus/Standard.
///
/// The arguments are those of `toron_abaqus_umat_tangent_f64`, and `dfgrd0` (9, in), F at the start of the increment;
/// `nstatv` ≥ 10, `nprops` = 10, or 11: the last one is the number of the state variable that holds the point's own
/// strength, or 0. The material axes follow the fibre, and the largest principal stress is compared with σ_lim. DDSDDE
/// is not symmetric: `*USER MATERIAL, UNSYMM`; Abaqus takes its symmetric part otherwise. In plane strain and
/// axisymmetric solids both axes lie in the plane or normal to it.
///
/// Returns as `toron_abaqus_umat_tangent_f64` does, and `TORON_INCREMENT_TOO_LARGE` for a step that cannot be
/// integrated.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_abaqus_linear_umat_f64(
    stress: *mut f64,
    statev: *mut f64,
    ddsdde: *mut f64,
    sse: *mut f64,
    pnewdt: *mut f64,
    dfgrd0: *const f64,
    dfgrd1: *const f64,
    props: *const f64,
    nprops: i32,
    nstatv: i32,
    ndi: i32,
    nshr: i32,
    nlgeom: i32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat {
        stress,
        statev,
        ddsdde,
        sse,
        pnewdt,
        dfgrd0,
        dfgrd1,
        props,
        nprops,
        nstatv,
        ndi,
        nshr,
        nlgeom,
        circumstances: Circumstances::UNKNOWN,
    };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic>::umat(&call, message, capacity) }
}

/// The law with friction as a UMAT of Abaqus/Standard.
///
/// The arguments are those of `toron_abaqus_umat_tangent_f64`, and `spd` (out): the energy lost per current volume;
/// `nstatv` ≥ 15, `nprops` = 13, or 14: the last one is the number of the state variable that holds the point's own
/// limit, or 0. DDSDDE is not symmetric where the fibres slide: `*USER MATERIAL, UNSYMM`; Abaqus takes its symmetric
/// part otherwise.
///
/// Returns as `toron_abaqus_umat_tangent_f64` does.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_abaqus_frictional_umat_f64(
    stress: *mut f64,
    statev: *mut f64,
    ddsdde: *mut f64,
    sse: *mut f64,
    spd: *mut f64,
    pnewdt: *mut f64,
    dfgrd1: *const f64,
    props: *const f64,
    nprops: i32,
    nstatv: i32,
    ndi: i32,
    nshr: i32,
    nlgeom: i32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat {
        stress,
        statev,
        ddsdde,
        sse,
        pnewdt,
        dfgrd0: null(),
        dfgrd1,
        props,
        nprops,
        nstatv,
        ndi,
        nshr,
        nlgeom,
        circumstances: Circumstances::UNKNOWN,
    };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional>::umat_with_losses(&call, spd, message, capacity) }
}

/// The hyperelastic law as a VUMAT of Abaqus/Explicit, for jobs in double precision.
///
/// `block` holds the VUMAT's arguments; their shapes are given in `toron_vumat_f64`. All pointers are the caller's and
/// not null. The law reads U, not F, so that the stress is the corotational one that Abaqus wants. In the data check
/// (`step_time` = `total_time` = 0) the answer is elastic and nothing fails. State variable 11, "alive", deletes the
/// element.
///
/// Returns the worst status: 0; a −1xx or −2xx code (`TORON_BAD_ARGUMENT` among them, in the data check for a limit of
/// a point that is negative, NaN or infinite), and nothing is written; or the most negative −3xx code: a point with
/// such a code has zero stress, keeps its energies and invariants, and is marked as failed and deleted. State variables
/// behind those of the law are copied; `ener_inelas_new` is `ener_inelas_old`, or 0 where that is not finite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_abaqus_vumat_f64(
    block: *const Vumat<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f64>>::vumat(block, message, capacity) }
}

/// As `toron_abaqus_vumat_f64`, for jobs in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_abaqus_vumat_f32(
    block: *const Vumat<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f32>>::vumat(block, message, capacity) }
}

/// The linear elastic law as a VUMAT of Abaqus/Explicit, for jobs in double precision: as `toron_abaqus_vumat_f64`,
/// with 10 properties and 10 state variables or more, of which number 10, "alive", deletes the element. It reads U at
/// both ends of the increment.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_abaqus_linear_vumat_f64(
    block: *const Vumat<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f64>>::vumat(block, message, capacity) }
}

/// As `toron_abaqus_linear_vumat_f64`, for jobs in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_abaqus_linear_vumat_f32(
    block: *const Vumat<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f32>>::vumat(block, message, capacity) }
}

/// The law with friction as a VUMAT of Abaqus/Explicit, for jobs in double precision: as `toron_abaqus_vumat_f64`, with
/// 13 properties and 15 state variables or more, of which number 15, "alive", deletes the element. `ener_inelas_new` is
/// the energy lost per mass.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_abaqus_frictional_vumat_f64(
    block: *const Vumat<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f64>>::vumat(block, message, capacity) }
}

/// As `toron_abaqus_frictional_vumat_f64`, for jobs in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_abaqus_frictional_vumat_f32(
    block: *const Vumat<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f32>>::vumat(block, message, capacity) }
}
