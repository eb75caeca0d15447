//! Many points at once: the same law over component-major arrays.
//!
//! Component c of point i is at `c * leading_dimension + i`, as LS-DYNA (nlq), Abaqus (nblock) and OpenRadioss (nel) lay their
//! arrays out. Arrays that a caller does not pass are neither read, computed nor written.
//!
//! | array | components |
//! |---|---|
//! | `deformation_gradient` | F11 F21 F31 F12 F22 F32 F13 F23 F33 (columns of F) |
//! | `fibre` | m1 m2 m3, any length |
//! | `stress` | σ11 σ22 σ33 σ12 σ23 σ31 (Cauchy) |
//! | `energies` | W_el W_tc W_td W_ld |
//! | `invariants` | I_el I_tc I_td I_ld |
//! | `failure` | failure index, failed, alive |
//! | `modes` | S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31 (second Piola–Kirchhoff) |
//! | `wave_speed` | a bound of the wave speed, at the reference density `density` |
//! | `tangent` | of the `measure`: 6×6 or 9×9, entry (row, column) at 6 row + column or 9 row + column; all of it, symmetric |
//! | `active` | 1, or 0 if the point has failed or cannot be evaluated |
//!
//! [`Pointers`] has a pointer for each component of F, fibre and stress, and a leading dimension for each other group of arrays.
//! Points need not be next to each other ([`Strides`]): those of an array with a row for each point, as NumPy keeps them, are copied
//! part by part to component-major arrays, and their results back.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod baseline;
mod copies;
mod dispatch;
mod instructions;
mod interface;
mod kernel;
pub mod linear;
mod pointers;

pub use dispatch::Precision;
pub(crate) use interface::raw_block_of;
pub use interface::{Arrays, Block, Law};
pub(crate) use kernel::least_code;
pub(crate) use pointers::{MOST, check_layout, distances};
pub use pointers::{Pointers, Strides, components, components_mut};
