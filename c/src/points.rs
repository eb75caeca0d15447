//! The hyperelastic law: its properties, one point.

use libc::{c_char, size_t};

/// Checks the properties of the hyperelastic law.
///
/// - `values`, `count`: the properties in the table's order.
/// - `message`, `capacity`: buffer for a message that names the wrong property, its value and the allowed values: at most
///   `capacity` bytes, always null-terminated, empty if there is no error. `message` may be null and `capacity` 0.
/// - `status`: 0, `TORON_NULL_ARGUMENT` or a −2xx code; may be null.
///
/// Returns the length of the full message without the terminating null, 0 if there is no error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_validate_f64(
    values: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::hyperelastic_validate_f64(values, count, message, capacity, status) }
}

/// As `toron_hyperelastic_validate_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_validate_f32(
    values: *const f32,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::hyperelastic_validate_f32(values, count, message, capacity, status) }
}

/// The hyperelastic law at one point.
///
/// - `values`, `count`: the properties in the table's order.
/// - `deformation_gradient`: 9 values by columns. Must not be null.
/// - `fibre`: 3 values, the fibre direction, any length; if null, the one in the properties.
/// - `state_old`: 11 values; if null, all 0. `state_new`: 11 values, out; if null, the new state is not returned and the
///   point cannot fail. They may be the same array.
/// - `stress`: room for 6, Cauchy 11 22 33 12 23 31; `modes`: room for 24, S_el, S_tc, S_td, S_ld (second Piola-Kirchhoff);
///   `wave_speed`: room for 1, an upper bound of the wave speed for the reference density `density`, to be used with
///   current element lengths for the stable time step (a bulk viscosity computed with it damps more than with the exact
///   speed). Each of these three may be null.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (stress and modes are 0, the wave
/// speed is that of a yarn at rest, the state is unchanged but for `alive`, which is 1 - failed).
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_hyperelastic_point_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    modes: *mut f64,
    density: f64,
    wave_speed: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        toron::host::c::hyperelastic_point_f64(
            values,
            count,
            deformation_gradient,
            fibre,
            state_old,
            state_new,
            stress,
            modes,
            density,
            wave_speed,
        )
    }
}

/// As `toron_hyperelastic_point_f64`, in single precision.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_hyperelastic_point_f32(
    values: *const f32,
    count: size_t,
    deformation_gradient: *const f32,
    fibre: *const f32,
    state_old: *const f32,
    state_new: *mut f32,
    stress: *mut f32,
    modes: *mut f32,
    density: f32,
    wave_speed: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        toron::host::c::hyperelastic_point_f32(
            values,
            count,
            deformation_gradient,
            fibre,
            state_old,
            state_new,
            stress,
            modes,
            density,
            wave_speed,
        )
    }
}
