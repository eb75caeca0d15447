//! The hyperelastic law: prepared, at one point, at blocks of points.

use libc::{c_char, size_t};
use toron::Error;
use toron::host::blocks::{self, Given};
use toron::host::entry_points::{Message, entry, properties};
use toron::host::point_and_block::Block;
use toron::host::point_and_block::Point;
use toron::host::points;
use toron::host::prepared::{numbers, prepare};
use toron::law::parameters;

use crate::prepared::HyperelasticLaw;

/// The properties that a caller passes.
///
/// # Errors
/// They are null or not as many as the law has.
///
/// # Safety
/// `values` is null or points to `count` values.
unsafe fn read<'a, T>(values: *const T, count: size_t) -> Result<&'a [T], Error> {
    // SAFETY: the same arguments.
    unsafe { properties(values, count, &parameters::HYPERELASTIC) }
}

/// Checks the properties of the hyperelastic law, and prepares the law from them.
///
/// - `law`: out; `size`: `sizeof *law`.
/// - `properties`, `count`: the properties in the table's order.
///
/// Returns 0; or `TORON_NULL_ARGUMENT`, `TORON_BAD_SIZE` or a −2xx code, and nothing is written: the message names the
/// wrong property, its value and the allowed values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_prepare_f64(
    law: *mut HyperelasticLaw<f64>,
    size: size_t,
    properties: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { prepare(law, size, properties, count, Message { text: message, capacity }) }
}

/// As `toron_hyperelastic_prepare_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_prepare_f32(
    law: *mut HyperelasticLaw<f32>,
    size: size_t,
    properties: *const f32,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { prepare(law, size, properties, count, Message { text: message, capacity }) }
}

/// The hyperelastic law at one point, with or without a tangent: see `toron_point_f64`.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (stress, modes and tangent are 0, the wave
/// speed is that of a yarn at rest, the state is unchanged but for `alive`, which is 1 - failed).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_point_f64(
    law: *const HyperelasticLaw<f64>,
    point: *const Point<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || points::hyperelastic_point(numbers(law)?, point)) }
}

/// As `toron_hyperelastic_point_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_point_f32(
    law: *const HyperelasticLaw<f32>,
    point: *const Point<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || points::hyperelastic_point(numbers(law)?, point)) }
}

/// As `toron_hyperelastic_point_f64`, with the properties in the table's order, which are checked in every call, in
/// place of a law that has been prepared. That takes longer; the results may differ in the last digits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_point_with_properties_f64(
    properties: *const f64,
    count: size_t,
    point: *const Point<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || points::hyperelastic_point(read(properties, count)?, point))
    }
}

/// As `toron_hyperelastic_point_with_properties_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_point_with_properties_f32(
    properties: *const f32,
    count: size_t,
    point: *const Point<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || points::hyperelastic_point(read(properties, count)?, point))
    }
}

/// The hyperelastic law at a block of points, with or without a tangent: see `toron_block_f64`.
///
/// Returns 0; or the most negative −3xx code of the points (a point with such a code has zero stress and keeps its
/// state; the other points are not affected), and the message names the first point with that code (without `status`
/// only if its F and fibre still tell it); or a −1xx or −2xx code, and then nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_f64(
    law: *const HyperelasticLaw<f64>,
    block: *const Block<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            blocks::hyperelastic_block(Given::Prepared(numbers(law)?), block)
        })
    }
}

/// As `toron_hyperelastic_block_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_f32(
    law: *const HyperelasticLaw<f32>,
    block: *const Block<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            blocks::hyperelastic_block(Given::Prepared(numbers(law)?), block)
        })
    }
}

/// As `toron_hyperelastic_block_f64`, with the properties in the table's order, which are checked in every call, in
/// place of a law that has been prepared. The results are the same bits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_with_properties_f64(
    properties: *const f64,
    count: size_t,
    block: *const Block<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            blocks::hyperelastic_block(Given::Properties(read(properties, count)?), block)
        })
    }
}

/// As `toron_hyperelastic_block_with_properties_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_with_properties_f32(
    properties: *const f32,
    count: size_t,
    block: *const Block<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            blocks::hyperelastic_block(Given::Properties(read(properties, count)?), block)
        })
    }
}

/// Stability check: the smallest eigenvalue, over all wave directions, of the acoustic tensor times the reference
/// density.
///
/// If it is negative, the material has lost ellipticity: wave speeds are imaginary and results depend on the mesh.
/// Without k_ld it is 0 to rounding in stable states: compare it with −1e-9 k_el.
///
/// - `point`: its `deformation_gradient` and `fibre` are read.
/// - `least`: the eigenvalue, out, in units of stress; `direction`: 3 values, out, the unit normal of that wave in
///   global axes, or null.
///
/// Returns 0; a −1xx or −3xx code, and nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_least_acoustic_eigenvalue_f64(
    law: *const HyperelasticLaw<f64>,
    point: *const Point<f64>,
    least: *mut f64,
    direction: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            points::least_acoustic_eigenvalue(numbers(law)?, point, least, direction)
        })
    }
}
