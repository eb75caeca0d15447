//! LS-DYNA: user materials, scalar and vectorised.

use core::ffi::c_int;

use libc::{c_char, size_t};
use toron::host::lsdyna::{Umat, UmatVector, UserRoutines, Utan, UtanVector};
use toron::{Frictional, Hyperelastic, LinearElastic};

/// The hyperelastic law as a scalar user material of LS-DYNA, in double precision.
///
/// `cm`: at least 11 values, the properties; `sig`: 6 values, the Cauchy stress, out; `hsv`: `nhv` = 11 state
/// variables, in and out, followed by the 9 entries of F by columns, in; `failel`: out, 1 where the element has failed
/// or could not be evaluated, else 0. None may be null.
///
/// Returns 0; `TORON_NULL_ARGUMENT`, `TORON_STATE_COUNT`, `TORON_NO_DEFORMATION_GRADIENT` (F = 0 or stored elsewhere:
/// check IHYPER and NHV on the card) or a −2xx code, and nothing is written; or a −3xx code: the stress is 0, energies
/// and invariants are unchanged, and the element is marked as failed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_umat_f64(
    cm: *const f64,
    sig: *mut f64,
    hsv: *mut f64,
    nhv: i32,
    failel: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat { cm, sig, hsv, nhv, failel };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f64>>::umat(&call, message, capacity) }
}

/// As `toron_lsdyna_umat_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_umat_f32(
    cm: *const f32,
    sig: *mut f32,
    hsv: *mut f32,
    nhv: i32,
    failel: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat { cm, sig, hsv, nhv, failel };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f32>>::umat(&call, message, capacity) }
}

/// The hyperelastic law as a vectorised user material of LS-DYNA, in double precision.
///
/// `cm`: 11 properties or more; `sig1` … `sig6`: `nlq` each, out; `hsvs`: (`nlq`, 20), `nhv` = 11 state variables, in
/// and out, then F, in; `failels`: `nlq`, out, 1 where an element has failed or could not be evaluated, else 0.
/// Elements `lft` to `llt`, counted from 1, are evaluated; the others are not touched. No pointer may be null.
///
/// Returns the worst status: 0; `TORON_NULL_ARGUMENT`, `TORON_BAD_COUNT`, `TORON_BAD_LEADING_DIMENSION`,
/// `TORON_STATE_COUNT`, `TORON_NO_DEFORMATION_GRADIENT` (of the first element, as in `toron_lsdyna_umat_f64`) or a −2xx
/// code, and nothing is written; or the most negative −3xx code of the elements: an element with such a code has zero
/// stress, keeps its energies and invariants, and is marked as failed.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_lsdyna_umat_vector_f64(
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
    let call = UmatVector { cm, sig: [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, lft, llt, nlq, failels };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f64>>::umat_vector(&call, message, capacity) }
}

/// As `toron_lsdyna_umat_vector_f64`, in single precision.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_lsdyna_umat_vector_f32(
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
    let call = UmatVector { cm, sig: [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, lft, llt, nlq, failels };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f32>>::umat_vector(&call, message, capacity) }
}

/// The tangent of the hyperelastic law for LS-DYNA's scalar user routine `utan`, in double precision.
///
/// `cm`: 11 properties or more; `hsv`: `nhv` = 11 state variables, then 9 entries of F, in, as written by the material
/// routine; `es`: 6 × 6, out, the Truesdell modulus of the Cauchy stress, 11 22 33 12 23 31, engineering shears,
/// symmetric. None may be null.
///
/// Returns 0; `TORON_NULL_ARGUMENT`, `TORON_STATE_COUNT`, `TORON_NO_DEFORMATION_GRADIENT` or a −2xx code, and nothing
/// is written; or a −3xx code, and then `es` is 0. For a failed element `es` is 0 as well.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_utan_f64(
    cm: *const f64,
    hsv: *const f64,
    nhv: i32,
    es: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Utan { cm, hsv, nhv, es };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f64>>::utan(&call, message, capacity) }
}

/// As `toron_lsdyna_utan_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_utan_f32(
    cm: *const f32,
    hsv: *const f32,
    nhv: i32,
    es: *mut f32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Utan { cm, hsv, nhv, es };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f32>>::utan(&call, message, capacity) }
}

/// The tangent of the hyperelastic law as LS-DYNA's vectorised `utan` wants it, in double precision.
///
/// `cm`, `nhv`, `lft`, `llt`, `nlq` as for `toron_lsdyna_umat_vector_f64`; `hsvs`: (`nlq`, 20), in; `dsave`: (`nlq`, 6,
/// 6), out, as `es` of `toron_lsdyna_utan_f64`. Elements `lft` to `llt`, counted from 1, are evaluated; the others are
/// not touched.
///
/// Returns the worst status, as `toron_lsdyna_umat_vector_f64` does; the tangent is 0 for an element that cannot be
/// evaluated or has failed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_utan_vector_f64(
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
    let call = UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f64>>::utan_vector(&call, message, capacity) }
}

/// As `toron_lsdyna_utan_vector_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_utan_vector_f32(
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
    let call = UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f32>>::utan_vector(&call, message, capacity) }
}

/// Computes the bulk and shear modulus to be entered as cm(12) and cm(13), to which IBULK = 12 and IG = 13 on the card
/// refer.
///
/// LS-DYNA computes its time step from K + 4G/3. With these values it equals k_el, and the wave along a stretched fibre
/// is never faster than √(k_el/ρ). `bulk`, `shear`: one value each, out. Returns 0, `TORON_NULL_ARGUMENT` or a −2xx
/// code.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_bulk_and_shear_f64(
    values: *const f64,
    count: usize,
    bulk: *mut f64,
    shear: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Hyperelastic<f64>>::card_moduli(values, count, bulk, shear, message, capacity) }
}

/// The linear elastic law as a scalar user material of LS-DYNA, in double precision.
///
/// As `toron_lsdyna_umat_f64`, with `cm`: at least 10 values, the properties; `hsv`: `nhv` = 19 variables, the law's 10
/// state variables and the 9 entries of F of the last step by columns, in and out, followed by the 9 entries of F, in.
/// The material axes follow the fibre, and the largest principal stress is compared with σ_lim.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_linear_umat_f64(
    cm: *const f64,
    sig: *mut f64,
    hsv: *mut f64,
    nhv: i32,
    failel: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat { cm, sig, hsv, nhv, failel };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f64>>::umat(&call, message, capacity) }
}

/// As `toron_lsdyna_linear_umat_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_linear_umat_f32(
    cm: *const f32,
    sig: *mut f32,
    hsv: *mut f32,
    nhv: i32,
    failel: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat { cm, sig, hsv, nhv, failel };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f32>>::umat(&call, message, capacity) }
}

/// The linear elastic law as a vectorised user material of LS-DYNA, in double precision: as
/// `toron_lsdyna_umat_vector_f64`, with `hsvs`: (`nlq`, 28), ordered as `hsv` of `toron_lsdyna_linear_umat_f64`.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_lsdyna_linear_umat_vector_f64(
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
    let call = UmatVector { cm, sig: [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, lft, llt, nlq, failels };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f64>>::umat_vector(&call, message, capacity) }
}

/// As `toron_lsdyna_linear_umat_vector_f64`, in single precision.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_lsdyna_linear_umat_vector_f32(
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
    let call = UmatVector { cm, sig: [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, lft, llt, nlq, failels };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f32>>::umat_vector(&call, message, capacity) }
}

/// The tangent of the linear elastic law for LS-DYNA's scalar user routine `utan`, in double precision: as
/// `toron_lsdyna_utan_f64`, with `hsv` of `toron_lsdyna_linear_umat_f64`.
///
/// It is that of a further, infinitesimal step from the state that the material routine has written, its symmetric
/// part.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_linear_utan_f64(
    cm: *const f64,
    hsv: *const f64,
    nhv: i32,
    es: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Utan { cm, hsv, nhv, es };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f64>>::utan(&call, message, capacity) }
}

/// As `toron_lsdyna_linear_utan_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_linear_utan_f32(
    cm: *const f32,
    hsv: *const f32,
    nhv: i32,
    es: *mut f32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Utan { cm, hsv, nhv, es };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f32>>::utan(&call, message, capacity) }
}

/// As `toron_lsdyna_linear_utan_f64`, for LS-DYNA's vectorised `utan`: arguments as of `toron_lsdyna_utan_vector_f64`,
/// with `hsvs`: (`nlq`, 28).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_linear_utan_vector_f64(
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
    let call = UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f64>>::utan_vector(&call, message, capacity) }
}

/// As `toron_lsdyna_linear_utan_vector_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_linear_utan_vector_f32(
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
    let call = UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f32>>::utan_vector(&call, message, capacity) }
}

/// As `toron_lsdyna_bulk_and_shear_f64`, for the linear elastic law: cm(11) and cm(12), IBULK = 11 and IG = 12. K +
/// 4G/3 is the largest of E1, E2 and 2G.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_linear_bulk_and_shear_f64(
    values: *const f64,
    count: usize,
    bulk: *mut f64,
    shear: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <LinearElastic<f64>>::card_moduli(values, count, bulk, shear, message, capacity) }
}

/// The law with friction as a scalar user material of LS-DYNA, in double precision.
///
/// As `toron_lsdyna_umat_f64`, with `cm`: at least 13 values, the properties; `hsv`: `nhv` = 15 state variables, in and
/// out, followed by the 9 entries of F by columns, in.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_frictional_umat_f64(
    cm: *const f64,
    sig: *mut f64,
    hsv: *mut f64,
    nhv: i32,
    failel: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat { cm, sig, hsv, nhv, failel };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f64>>::umat(&call, message, capacity) }
}

/// As `toron_lsdyna_frictional_umat_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_frictional_umat_f32(
    cm: *const f32,
    sig: *mut f32,
    hsv: *mut f32,
    nhv: i32,
    failel: *mut c_int,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Umat { cm, sig, hsv, nhv, failel };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f32>>::umat(&call, message, capacity) }
}

/// The law with friction as a vectorised user material of LS-DYNA, in double precision: as
/// `toron_lsdyna_umat_vector_f64`, with `hsvs`: (`nlq`, 24), ordered as `hsv` of `toron_lsdyna_frictional_umat_f64`.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_lsdyna_frictional_umat_vector_f64(
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
    let call = UmatVector { cm, sig: [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, lft, llt, nlq, failels };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f64>>::umat_vector(&call, message, capacity) }
}

/// As `toron_lsdyna_frictional_umat_vector_f64`, in single precision.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_lsdyna_frictional_umat_vector_f32(
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
    let call = UmatVector { cm, sig: [sig1, sig2, sig3, sig4, sig5, sig6], hsvs, nhv, lft, llt, nlq, failels };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f32>>::umat_vector(&call, message, capacity) }
}

/// The tangent of the law with friction for LS-DYNA's scalar user routine `utan`, in double precision: as
/// `toron_lsdyna_utan_f64`, with `hsv` of `toron_lsdyna_frictional_umat_f64`.
///
/// It is that of a further, infinitesimal step from the state that the material routine has written, where the fibres
/// hold: that of unloading where they have slid in the step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_frictional_utan_f64(
    cm: *const f64,
    hsv: *const f64,
    nhv: i32,
    es: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Utan { cm, hsv, nhv, es };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f64>>::utan(&call, message, capacity) }
}

/// As `toron_lsdyna_frictional_utan_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_frictional_utan_f32(
    cm: *const f32,
    hsv: *const f32,
    nhv: i32,
    es: *mut f32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let call = Utan { cm, hsv, nhv, es };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f32>>::utan(&call, message, capacity) }
}

/// As `toron_lsdyna_frictional_utan_f64`, for LS-DYNA's vectorised `utan`: arguments as of
/// `toron_lsdyna_utan_vector_f64`, with `hsvs`: (`nlq`, 24).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_frictional_utan_vector_f64(
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
    let call = UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f64>>::utan_vector(&call, message, capacity) }
}

/// As `toron_lsdyna_frictional_utan_vector_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_frictional_utan_vector_f32(
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
    let call = UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f32>>::utan_vector(&call, message, capacity) }
}

/// As `toron_lsdyna_bulk_and_shear_f64`, for the law with friction: cm(14) and cm(15), IBULK = 14 and IG = 15.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_lsdyna_frictional_bulk_and_shear_f64(
    values: *const f64,
    count: usize,
    bulk: *mut f64,
    shear: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { <Frictional<f64>>::card_moduli(values, count, bulk, shear, message, capacity) }
}
