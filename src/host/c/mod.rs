//! The C interface of the laws themselves, for drivers and solvers of any language. Package `c` exports these functions under
//! their C names and says what each of them wants.
//!
//! | convention | |
//! |---|---|
//! | deformation gradient | 9 values by columns: F11 F21 F31 F12 F22 F32 F13 F23 F33 |
//! | stress | Cauchy, 11 22 33 12 23 31 |
//! | energies | per reference volume |
//! | status | 0 is success, negative an error; outputs are untouched where the call itself is wrong (−1xx, −2xx) |
//! | arrays | the caller's; read and written during the call only, never kept |
//!
//! Every function may be called from any thread at any time.

mod about;
mod blocks;
mod linear_elastic;
mod points;
mod tables;
mod tangents;

pub(super) use points::PointAnswer;

pub use about::*;
pub use blocks::*;
pub use linear_elastic::*;
pub use points::*;
pub use tables::*;
pub use tangents::*;

use core::slice;

use libc::size_t;

use crate::law::parameters::{self, Property};
use crate::law::state;
use crate::law::status::{self, Error};

use super::environment::in_default_environment;

/// Number of the interface. It changes when a caller compiled against an older header could no longer run.
pub const TORON_ABI_VERSION: i32 = 1;

/// The hyperelastic yarn law, where a table or a preset is asked for.
pub const TORON_HYPERELASTIC: i32 = 0;
/// The linear elastic orthotropic law.
pub const TORON_LINEAR_ELASTIC: i32 = 1;

/// Number of properties and of state variables of the hyperelastic law.
pub const TORON_HYPERELASTIC_PROPERTIES: usize = 11;
pub const TORON_HYPERELASTIC_STATE: usize = 11;
/// Number of properties and of state variables of the linear elastic law.
pub const TORON_LINEAR_ELASTIC_PROPERTIES: usize = 10;
pub const TORON_LINEAR_ELASTIC_STATE: usize = 10;

/// The frame of the linear elastic law follows the fibre.
pub const TORON_ROTATION_FIBRE: i32 = 0;
/// It follows the polar rotation of F.
pub const TORON_ROTATION_POLAR: i32 = 1;
/// It follows the spin.
pub const TORON_ROTATION_SPIN: i32 = 2;

/// The linear elastic law fails by its largest principal stress.
pub const TORON_CRITERION_PRINCIPAL: i32 = 0;
/// It fails by the stress along the fibre.
pub const TORON_CRITERION_FIBRE: i32 = 1;

/// Tangent: dS/dE, second Piola-Kirchhoff stress by Green-Lagrange strain, reference axes; 6 x 6.
pub const TORON_TANGENT_MATERIAL: i32 = 0;
/// The Truesdell modulus of the Cauchy stress: dS/dE pushed forward, over J; 6 x 6.
pub const TORON_TANGENT_TRUESDELL: i32 = 1;
/// The modulus of the Jaumann rate of the Kirchhoff stress, over J; 6 x 6.
pub const TORON_TANGENT_JAUMANN: i32 = 2;
/// dP/dF, first Piola-Kirchhoff stress by deformation gradient, both 11 21 31 12 22 32 13 23 33; 9 x 9.
pub const TORON_TANGENT_NOMINAL: i32 = 3;

/// Instructions of a block: the best that the processor has.
pub const TORON_LEVEL_BEST: i32 = 0;
/// None that only some processors of the architecture have.
pub const TORON_LEVEL_BASELINE: i32 = 1;
/// At most AVX2 with fused multiply-add.
pub const TORON_LEVEL_AVX2: i32 = 2;
/// At most AVX-512.
pub const TORON_LEVEL_AVX512: i32 = 3;

const _: () = {
    assert!(TORON_HYPERELASTIC_PROPERTIES == parameters::HYPERELASTIC_PROPERTIES);
    assert!(TORON_HYPERELASTIC_STATE == state::HYPERELASTIC_STATE);
    assert!(TORON_LINEAR_ELASTIC_PROPERTIES == parameters::LINEAR_ELASTIC_PROPERTIES);
    assert!(TORON_LINEAR_ELASTIC_STATE == state::LINEAR_ELASTIC_STATE);
};

/// The properties that a caller passes, read only if their number is right.
///
/// # Safety
/// `properties` is null or points to `count` values.
pub(super) unsafe fn properties<'a, T>(
    properties: *const T,
    count: size_t,
    table: &'static [Property],
) -> Result<&'a [T], Error> {
    if properties.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    if count != table.len() {
        let (found, wanted) = (i64::try_from(count).unwrap_or(i64::MAX), table.len() as i64);
        return Err(Error::Count { code: status::PROPERTY_COUNT, what: "number of properties", found, wanted });
    }
    // SAFETY: the caller's promise.
    Ok(unsafe { slice::from_raw_parts(properties, count) })
}

/// The body of an entry, in the default floating-point environment; its error as a code.
#[inline(always)]
pub(super) fn entry(body: impl FnOnce() -> Result<i32, Error>) -> i32 {
    in_default_environment(|| body().unwrap_or_else(|error| error.code()))
}

/// Copies results out, if the caller wants them.
///
/// # Safety
/// `to` is null or has room for as many values.
#[inline(always)]
pub(super) unsafe fn store<T: Copy>(values: &[T], to: *mut T) {
    if !to.is_null() {
        for (i, &value) in values.iter().enumerate() {
            // SAFETY: the caller's promise.
            unsafe { *to.add(i) = value };
        }
    }
}
