//! The linear elastic law: its properties, one point, blocks.

use libc::{c_char, size_t};
use toron::host::c::LinearBlock;

/// Checks the properties of the linear elastic law; as `toron_hyperelastic_validate_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_validate_f64(
    values: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::linear_elastic_validate_f64(values, count, message, capacity, status) }
}

/// The material axes of the linear elastic law in the undeformed state: the initial value of `axes` for
/// `TORON_ROTATION_SPIN`.
///
/// `axes`: room for 9 values, the three axes one after the other. Returns 0, `TORON_NULL_ARGUMENT` or a −2xx code.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_axes_f64(values: *const f64, count: size_t, axes: *mut f64) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::linear_elastic_axes_f64(values, count, axes) }
}

/// The linear elastic law over a step, from the deformation gradients at both ends.
///
/// - `values`, `count`: the properties in the table's order.
/// - `f_old`, `f_new`: 9 values each, by columns. Must not be null.
/// - `state_old`: 10 values; null: all 0. `state_new`: room for 10, or null. They may be the same array.
/// - `stress`: room for 6, Cauchy stress in space 11 22 33 12 23 31, or null.
/// - `rotation`: the frame that rotates with the material: `TORON_ROTATION_FIBRE` (right for a yarn), `_POLAR` or `_SPIN`.
/// - `criterion`: `TORON_CRITERION_PRINCIPAL` or `_FIBRE`.
/// - `axes`: 9 values, in and out, the current material axes, used only for `TORON_ROTATION_SPIN`; initialise them with
///   `toron_linear_elastic_axes_f64`. May be null for the other frames.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (the stress is 0, the state is unchanged but for `alive`).
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_linear_elastic_step_f64(
    values: *const f64,
    count: size_t,
    f_old: *const f64,
    f_new: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    rotation: i32,
    criterion: i32,
    axes: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        toron::host::c::linear_elastic_step_f64(
            values, count, f_old, f_new, state_old, state_new, stress, rotation, criterion, axes,
        )
    }
}

/// As `toron_linear_elastic_step_f64`, with the tangent consistent with the step.
///
/// - `measure`, `tangent`: as for `toron_hyperelastic_point_tangent_f64`, but the matrix is not symmetric: entry (row,
///   column) is at `6 row + column`, for `TORON_TANGENT_NOMINAL` at `row + 9 column`. `TORON_TANGENT_JAUMANN` gives the
///   entries of Abaqus's DDSDDE, but in the order 11 22 33 12 23 31.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_linear_elastic_step_tangent_f64(
    values: *const f64,
    count: size_t,
    f_old: *const f64,
    f_new: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    rotation: i32,
    criterion: i32,
    axes: *mut f64,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        toron::host::c::linear_elastic_step_tangent_f64(
            values, count, f_old, f_new, state_old, state_new, stress, rotation, criterion, axes, measure, tangent,
        )
    }
}

/// The linear elastic law for a strain increment in material axes that the host updates.
///
/// - `strain`: 6 tensor components 11 22 33 12 23 31 (half the engineering shears) in the material axes. Must not be
///   null.
/// - `jacobian`: the volume ratio J, a factor of the work per reference volume; 1 if it is not known.
/// - `state_old`, `state_new`, `criterion`: as for `toron_linear_elastic_step_f64`; `stress`: in that frame.
///
/// The result is only as good as the axes: if they follow the polar rotation or the spin, the stiff direction drifts away
/// from a sheared fibre. Returns the same codes as `toron_linear_elastic_step_f64`.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_linear_elastic_increment_f64(
    values: *const f64,
    count: size_t,
    strain: *const f64,
    jacobian: f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    criterion: i32,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        toron::host::c::linear_elastic_increment_f64(
            values, count, strain, jacobian, state_old, state_new, stress, criterion,
        )
    }
}

/// The linear elastic law over a step at a block of points.
///
/// - `values`, `count`: the properties in the table's order, the same for all points.
/// - `block`: the arrays, see `toron_linear_block_f64`; the caller owns all of them.
/// - `rotation`, `criterion`: as for `toron_linear_elastic_step_f64`.
///
/// Returns the worst status code of the points: 0, or the most negative −3xx code (that point carries no stress and keeps
/// its state and axes; the others are not affected); or a −1xx or −2xx code, and nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_block_f64(
    values: *const f64,
    count: size_t,
    block: *const LinearBlock<f64>,
    rotation: i32,
    criterion: i32,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::linear_elastic_block_f64(values, count, block, rotation, criterion) }
}

/// As `toron_linear_elastic_block_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_block_f32(
    values: *const f32,
    count: size_t,
    block: *const LinearBlock<f32>,
    rotation: i32,
    criterion: i32,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::linear_elastic_block_f32(values, count, block, rotation, criterion) }
}
