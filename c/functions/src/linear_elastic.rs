//! The linear elastic law: prepared, at one point, at blocks of points.

use libc::{c_char, size_t};
use toron::host::entry_points::{Message, entry, properties};
use toron::host::linear_elastic::{self as linear, LinearBlock, LinearIncrement, LinearPoint};
use toron::host::prepared::{AsNumbers, PreparedLaw, numbers, prepare};
use toron::law::block::Precision;
use toron::law::parameters;
use toron::{Error, LinearElastic};

use crate::prepared::LinearElasticLaw;

/// The law that a caller has prepared.
///
/// # Errors
/// It is null, or has not been prepared as this law.
///
/// # Safety
/// `law` is null or points to a structure of this type.
#[inline(always)]
unsafe fn prepared<T: Precision>(law: *const LinearElasticLaw<T>) -> Result<LinearElastic<T>, Error>
where
    LinearElasticLaw<T>: PreparedLaw<T, Law = LinearElastic<T>>,
{
    // SAFETY: the same argument.
    Ok(LinearElastic::of(unsafe { numbers(law) }?))
}

/// The law of the properties that a caller passes.
///
/// # Errors
/// They are null, not as many as the law has, or one of them is wrong.
///
/// # Safety
/// `values` is null or points to `count` values.
unsafe fn with<T: Precision>(values: *const T, count: size_t) -> Result<LinearElastic<T>, Error> {
    // SAFETY: the same arguments.
    LinearElastic::new(unsafe { properties(values, count, &parameters::LINEAR_ELASTIC) }?)
}

/// Checks the properties of the linear elastic law, and prepares the law from them; as
/// `toron_hyperelastic_prepare_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_prepare_f64(
    law: *mut LinearElasticLaw<f64>,
    size: size_t,
    properties: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { prepare(law, size, properties, count, Message { text: message, capacity }) }
}

/// As `toron_linear_elastic_prepare_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_prepare_f32(
    law: *mut LinearElasticLaw<f32>,
    size: size_t,
    properties: *const f32,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { prepare(law, size, properties, count, Message { text: message, capacity }) }
}

/// The material axes of the linear elastic law in the undeformed state: the initial value of `axes` for
/// `TORON_ROTATION_SPIN`.
///
/// - `fibre`, `second_axis`: 3 values each, those of a point, of any length; null: those of the properties. The second
///   axis may be 0 if any will do.
/// - `axes`: 9 values, out, the three axes one after the other.
///
/// Returns 0, `TORON_NULL_ARGUMENT`, `TORON_NOT_PREPARED`, or `TORON_FIBRE_DIRECTION` if there are no such axes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_axes_f64(
    law: *const LinearElasticLaw<f64>,
    fibre: *const f64,
    second_axis: *const f64,
    axes: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || linear::axes(&prepared(law)?, fibre, second_axis, axes))
    }
}

/// As `toron_linear_elastic_axes_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_axes_f32(
    law: *const LinearElasticLaw<f32>,
    fibre: *const f32,
    second_axis: *const f32,
    axes: *mut f32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        entry(Message { text: message, capacity }, move || linear::axes(&prepared(law)?, fibre, second_axis, axes))
    }
}

/// The linear elastic law over a step at one point, from the deformation gradients at both ends: see
/// `toron_linear_point_f64`.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (stress and tangent are 0, the state is
/// unchanged but for `alive`).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_point_f64(
    law: *const LinearElasticLaw<f64>,
    point: *const LinearPoint<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::point(&prepared(law)?, point)) }
}

/// As `toron_linear_elastic_point_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_point_f32(
    law: *const LinearElasticLaw<f32>,
    point: *const LinearPoint<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::point(&prepared(law)?, point)) }
}

/// As `toron_linear_elastic_point_f64`, with the properties in the table's order in place of a law that has been
/// prepared. The results are the same bits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_point_with_properties_f64(
    properties: *const f64,
    count: size_t,
    point: *const LinearPoint<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::point(&with(properties, count)?, point)) }
}

/// As `toron_linear_elastic_point_with_properties_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_point_with_properties_f32(
    properties: *const f32,
    count: size_t,
    point: *const LinearPoint<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::point(&with(properties, count)?, point)) }
}

/// The linear elastic law for a strain increment in material axes that the host updates: see
/// `toron_linear_increment_f64`.
///
/// The result is only as good as the axes: if they follow the polar rotation or the spin, the stiff direction drifts
/// away from a sheared fibre. Returns the same codes as `toron_linear_elastic_point_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_increment_f64(
    law: *const LinearElasticLaw<f64>,
    increment: *const LinearIncrement<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::increment(&prepared(law)?, increment)) }
}

/// As `toron_linear_elastic_increment_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_increment_f32(
    law: *const LinearElasticLaw<f32>,
    increment: *const LinearIncrement<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::increment(&prepared(law)?, increment)) }
}

/// The linear elastic law over a step at a block of points: see `toron_linear_block_f64`.
///
/// Returns the worst status code of the points: 0, or the most negative −3xx code (that point carries no stress and
/// keeps its state and axes; the others are not affected; the message names the first one, without `status` only if its
/// F and directions still tell it); or a −1xx or −2xx code, and nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_block_f64(
    law: *const LinearElasticLaw<f64>,
    block: *const LinearBlock<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::block(&prepared(law)?, block)) }
}

/// As `toron_linear_elastic_block_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_block_f32(
    law: *const LinearElasticLaw<f32>,
    block: *const LinearBlock<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::block(&prepared(law)?, block)) }
}

/// As `toron_linear_elastic_block_f64`, with the properties in the table's order in place of a law that has been
/// prepared. The results are the same bits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_block_with_properties_f64(
    properties: *const f64,
    count: size_t,
    block: *const LinearBlock<f64>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::block(&with(properties, count)?, block)) }
}

/// As `toron_linear_elastic_block_with_properties_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_block_with_properties_f32(
    properties: *const f32,
    count: size_t,
    block: *const LinearBlock<f32>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { entry(Message { text: message, capacity }, move || linear::block(&with(properties, count)?, block)) }
}
