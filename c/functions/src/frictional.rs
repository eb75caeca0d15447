//! The law with friction: prepared, at one point, at blocks of points.

use libc::{c_char, size_t};
use toron::host::entry_points::{Message, entry, properties};
use toron::host::frictional;
use toron::host::point_and_block::Block;
use toron::host::point_and_block::Point;
use toron::host::prepared::{AsNumbers, PreparedLaw, numbers, prepare};
use toron::law::block::Precision;
use toron::law::parameters;
use toron::{Error, Frictional};

use crate::prepared::FrictionalLaw;

/// The law that a caller has prepared.
///
/// # Errors
/// It is null, or has not been prepared as this law.
///
/// # Safety
/// `law` is null or points to a structure of this type.
#[inline(always)]
unsafe fn prepared<T: Precision>(law: *const FrictionalLaw<T>) -> Result<Frictional<T>, Error>
where
    FrictionalLaw<T>: PreparedLaw<T, Law = Frictional<T>>,
{
    // SAFETY: the same argument.
    Ok(Frictional::of(unsafe { numbers(law) }?))
}

/// The law of the properties that a caller passes.
///
/// # Errors
/// They are null, not as many as the law has, or one of them is wrong.
///
/// # Safety
/// `values` is null or points to `count` values.
unsafe fn with<T: Precision>(values: *const T, count: size_t) -> Result<Frictional<T>, Error> {
    // SAFETY: the same arguments.
    Frictional::new(unsafe { properties(values, count, &parameters::FRICTIONAL) }?)
}

/// Checks the properties of the law with friction, and prepares the law from them; as `toron_hyperelastic_prepare_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_prepare_f64(
    law: *mut FrictionalLaw<f64>,
    size: size_t,
    properties: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { prepare(law, size, properties, count, Message { text: message, capacity }) }
}

/// As `toron_frictional_prepare_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_prepare_f32(
    law: *mut FrictionalLaw<f32>,
    size: size_t,
    properties: *const f32,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { prepare(law, size, properties, count, Message { text: message, capacity }) }
}

/// The law with friction over a step at one point, with or without a tangent: see `toron_point_f64`; its arrays of the
/// state have 15 values. The step goes from the slip of the old state to the deformation gradient.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (stress, modes and tangent are 0, the wave speed
/// is that of a yarn at rest, the state is unchanged but for `alive`, which is 1 - failed, and for numbers that are not
/// finite, which become 0: after −304 a slip that was NaN is forgotten).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_point_f64(
    law: *const FrictionalLaw<f64>,
    point: *const Point<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || frictional::point(numbers(law)?, point)) }
}

/// As `toron_frictional_point_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_point_f32(
    law: *const FrictionalLaw<f32>,
    point: *const Point<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || frictional::point(numbers(law)?, point)) }
}

/// As `toron_frictional_point_f64`, with the properties in the table's order in place of a law that has been prepared.
/// The results are the same bits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_point_with_properties_f64(
    properties: *const f64,
    count: size_t,
    point: *const Point<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            frictional::point(&with(properties, count)?.numbers(), point)
        })
    }
}

/// As `toron_frictional_point_with_properties_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_point_with_properties_f32(
    properties: *const f32,
    count: size_t,
    point: *const Point<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            frictional::point(&with(properties, count)?.numbers(), point)
        })
    }
}

/// The law with friction over a step at a block of points, with or without a tangent: see `toron_block_f64`; its arrays
/// of the failure have 7 components.
///
/// Returns the worst status code of the points: 0, or the most negative −3xx code (that point carries no stress and
/// keeps its state; the others are not affected; the message names the first one, without `status` only if its F and
/// fibre still tell it); or a −1xx or −2xx code, and nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_block_f64(
    law: *const FrictionalLaw<f64>,
    block: *const Block<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || frictional::block(&prepared(law)?, block)) }
}

/// As `toron_frictional_block_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_block_f32(
    law: *const FrictionalLaw<f32>,
    block: *const Block<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || frictional::block(&prepared(law)?, block)) }
}

/// As `toron_frictional_block_f64`, with the properties in the table's order in place of a law that has been prepared.
/// The results are the same bits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_block_with_properties_f64(
    properties: *const f64,
    count: size_t,
    block: *const Block<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || frictional::block(&with(properties, count)?, block)) }
}

/// As `toron_frictional_block_with_properties_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_frictional_block_with_properties_f32(
    properties: *const f32,
    count: size_t,
    block: *const Block<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || frictional::block(&with(properties, count)?, block)) }
}
