//! The tables of properties and state variables, and the presets.

use libc::{c_char, size_t};
use toron::host::c::TableRow;

/// The number of properties of a law (`TORON_HYPERELASTIC`, `TORON_LINEAR_ELASTIC`), or `TORON_UNKNOWN_NAME`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_property_count(law: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::property_count(law, message, capacity) }
}

/// Writes the table row of property `index`, counted from 0, to `row`, whose `size` is set.
///
/// Returns 0, `TORON_UNKNOWN_NAME`, `TORON_NULL_ARGUMENT` or `TORON_BAD_SIZE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_property(
    law: i32,
    index: i32,
    row: *mut TableRow,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::property(law, index, row, message, capacity) }
}

/// The index, counted from 0, of the property with this name, or `TORON_UNKNOWN_NAME` or `TORON_NULL_ARGUMENT`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_property_index(
    law: i32,
    property: *const c_char,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::property_index(law, property, message, capacity) }
}

/// The number of state variables of a law, or `TORON_UNKNOWN_NAME`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_state_count(law: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::state_count(law, message, capacity) }
}

/// Writes the state variable of this index, from 0, to `row`; as `toron_property`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_state_variable(
    law: i32,
    index: i32,
    row: *mut TableRow,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::state_variable(law, index, row, message, capacity) }
}

/// The index, from 0, of the state variable of this name; as `toron_property_index`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_state_index(
    law: i32,
    variable: *const c_char,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::state_index(law, variable, message, capacity) }
}

/// The properties and the reference density of a preset, in the units of the user's model.
///
/// - `preset`: "kevlar-km2-600" or "kevlar-km2-600-linear"; `units`: a unit of length, one of mass and one of time, joined
///   by "-", such as "m-kg-s" (or "si"), "mm-tonne-s", "mm-kg-ms", "cm-g-us".
/// - `properties`: array for the properties; `count` must equal the law's number of properties. `density`: one value, out, or
///   null.
///
/// Returns 0, `TORON_UNKNOWN_NAME`, `TORON_NULL_ARGUMENT` or `TORON_PROPERTY_COUNT`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_preset_f64(
    preset: *const c_char,
    units: *const c_char,
    properties: *mut f64,
    count: size_t,
    density: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::preset_f64(preset, units, properties, count, density, message, capacity) }
}

/// As `toron_preset_f64`, rounded to single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_preset_f32(
    preset: *const c_char,
    units: *const c_char,
    properties: *mut f32,
    count: size_t,
    density: *mut f32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::preset_f32(preset, units, properties, count, density, message, capacity) }
}
