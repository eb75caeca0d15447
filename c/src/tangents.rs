//! The hyperelastic law: tangents, the least stable wave.

use libc::size_t;
use toron::host::c::Block;

/// The hyperelastic law at one point, with a tangent.
///
/// - `values`, `count`, `deformation_gradient`, `fibre`, `state_old`, `state_new`, `stress`: as for
///   `toron_hyperelastic_point_f64`.
/// - `measure`: which tangent, `TORON_TANGENT_MATERIAL`, `_TRUESDELL`, `_JAUMANN` or `_NOMINAL`.
/// - `tangent`: 36 values, out (81 for `_NOMINAL`), a symmetric matrix; must not be null. Rows and columns are in the order
///   11 22 33 12 23 31, with derivatives with respect to engineering shears; for `_NOMINAL` in the order 11 21 31 12 22 32
///   13 23 33.
///
/// The call that detects failure returns the intact tangent, later calls return zeros. At a kink (I_el = 0 or I_tc = 0) the
/// tangent is that of loading.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (stress and tangent are 0, the state is
/// unchanged but for `alive`).
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_hyperelastic_point_tangent_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        toron::host::c::hyperelastic_point_tangent_f64(
            values,
            count,
            deformation_gradient,
            fibre,
            state_old,
            state_new,
            stress,
            measure,
            tangent,
        )
    }
}

/// As `toron_hyperelastic_point_tangent_f64`, in single precision.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_hyperelastic_point_tangent_f32(
    values: *const f32,
    count: size_t,
    deformation_gradient: *const f32,
    fibre: *const f32,
    state_old: *const f32,
    state_new: *mut f32,
    stress: *mut f32,
    measure: i32,
    tangent: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        toron::host::c::hyperelastic_point_tangent_f32(
            values,
            count,
            deformation_gradient,
            fibre,
            state_old,
            state_new,
            stress,
            measure,
            tangent,
        )
    }
}

/// Stability check: the smallest eigenvalue, over all wave directions, of the acoustic tensor times the reference density.
///
/// If it is negative, the material has lost ellipticity: wave speeds are imaginary and results depend on the mesh. Without
/// k_ld it is 0 to rounding in stable states: compare it with −1e-9 k_el.
///
/// - `values`, `count`, `deformation_gradient`, `fibre`: as for `toron_hyperelastic_point_f64`.
/// - `least`: the eigenvalue, out, in units of stress; `direction`: 3 values, out, the unit normal of that wave in global
///   axes, or null.
///
/// Returns 0; a −1xx, −2xx or −3xx code, and nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_least_acoustic_eigenvalue_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    least: *mut f64,
    direction: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        toron::host::c::hyperelastic_least_acoustic_eigenvalue_f64(
            values,
            count,
            deformation_gradient,
            fibre,
            least,
            direction,
        )
    }
}

/// The hyperelastic law at a block of points, with a tangent.
///
/// - `values`, `count`, `block`: as for `toron_hyperelastic_block_f64`.
/// - `measure`: which tangent, as for `toron_hyperelastic_point_tangent_f64`.
/// - `tangent`: 36 components (81 for `TORON_TANGENT_NOMINAL`), component-major with the block's leading dimension: entry
///   (row, column), counted from 0, is component 6 row + column (9 row + column). The full symmetric matrix is written. If
///   null, no tangent is computed.
///
/// Returns the same codes as `toron_hyperelastic_block_f64`; the tangent is 0 for a point that cannot be evaluated or had
/// failed before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_tangent_f64(
    values: *const f64,
    count: size_t,
    block: *const Block<f64>,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::hyperelastic_block_tangent_f64(values, count, block, measure, tangent) }
}

/// As `toron_hyperelastic_block_tangent_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_tangent_f32(
    values: *const f32,
    count: size_t,
    block: *const Block<f32>,
    measure: i32,
    tangent: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::hyperelastic_block_tangent_f32(values, count, block, measure, tangent) }
}
