//! The hyperelastic law: blocks of points.

use libc::size_t;
use toron::host::c::Block;

/// The hyperelastic law at a block of points.
///
/// - `values`, `count`: the properties in the table's order, the same for all points.
/// - `block`: the arrays, see `toron_block_f64`; the caller owns all of them.
///
/// Returns 0; or the most negative −3xx code of the points (a point with such a code has zero stress and keeps its state;
/// the other points are not affected); or a −1xx or −2xx code, and then nothing is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_f64(
    values: *const f64,
    count: size_t,
    block: *const Block<f64>,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::hyperelastic_block_f64(values, count, block) }
}

/// As `toron_hyperelastic_block_f64`, in single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_f32(
    values: *const f32,
    count: size_t,
    block: *const Block<f32>,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::hyperelastic_block_f32(values, count, block) }
}
