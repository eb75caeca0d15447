//! Many points at once: the same law over component-major arrays.
//!
//! Component c of point i is at `c * leading_dimension + i`, as LS-DYNA (nlq), Abaqus (nblock) and OpenRadioss (nel)
//! lay their arrays out. Arrays that a caller does not pass are neither read, computed nor written.
//!
//! | array | components |
//! |---|---|
//! | `f_old`, `f_new` | F11 F21 F31 F12 F22 F32 F13 F23 F33 (columns of F) at both ends of the step |
//! | `fibre`, `second_axis` | a fibre direction and a second axis, any length, or those of the properties; not read for [`Rotation::Spin`](crate::law::linear_elastic::Rotation::Spin) |
//! | `limit` | a failure limit, or 0 for that of the properties |
//! | `axes` | the three material axes in space, one after the other, in and out; for `Rotation::Spin` only |
//! | `state_old`, `state_new` | the rows of the law's table of [`state`](crate::law::state); of the hyperelastic law in three parts: energies, invariants, failure |
//! | `stress` | σ11 σ22 σ33 σ12 σ23 σ31 (Cauchy) |
//! | `modes` | S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31 (second Piola–Kirchhoff), of the hyperelastic law |
//! | `wave_speed` | a bound of the wave speed at the end of the step, at the reference density `density` |
//! | `temperature` | the temperature at the end of the step, of the `circumstances`; read by a law that says so |
//! | `tangent` | of the `measure`: 6×6 or 9×9, entry (row, column) at 6 row + column or 9 row + column; all of it, symmetric or not |
//! | `active` | 1, or 0 if the point has failed or cannot be evaluated |
//!
//! [`Points`] has a pointer for each component of F, of the directions and of the stress, and a leading dimension for
//! each other group of arrays; [`Arrays`] has the slices of the hyperelastic law. Points need not be next to each other
//! ([`Strides`]): those of an array with a row for each point, as NumPy keeps them, are copied part by part to
//! component-major arrays, and their results back.

mod arrays;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod baseline;
mod buffers;
mod circumstances;
mod copies;
mod dispatch;
mod instructions;
mod kernel;
mod layout;
mod linear;
#[cfg(target_arch = "x86_64")]
mod one;
mod outputs;
mod points;
mod request;
mod run;

pub use arrays::{Arrays, Block};
pub use circumstances::Circumstances;
pub use dispatch::Precision;
pub(crate) use kernel::least_code;
pub(crate) use layout::{MOST, check_layout, distances, parts};
pub use layout::{components, components_mut};
pub use points::{Has, OnePoint, PARTS, Points, Strides};
pub(crate) use run::{Kernels, at_fault, evaluate_one, evaluate_points};
