//! The C interface of the laws, for drivers and solvers of any language: each function of `include/toron.h`, under its
//! name there. Package `toron-c` makes libtoron.so and libtoron.a of it; a program in Rust may call it as it is.
//!
//! | convention | |
//! |---|---|
//! | deformation gradient | 9 values by columns: F11 F21 F31 F12 F22 F32 F13 F23 F33 |
//! | stress | Cauchy, 11 22 33 12 23 31 |
//! | energies | per reference volume |
//! | status | 0 is success, negative an error; outputs are untouched if the call itself is wrong (−1xx, −2xx) |
//! | structures | begin with their size; 0 is what is left out |
//! | message | the last two arguments: a buffer and its size, or null and 0; written only if there is an error |
//! | arrays | the caller's; read and written during the call only, never kept |
//!
//! Every function may be called from any thread at any time.
//!
//! What a caller promises is said of each argument, and in [`toron::host`] of all: a pointer is null only where that is
//! allowed, and else points to as many values as said; outputs overlap nothing but, exactly, the old state that they
//! replace. The functions of `toron` to which these pass their arguments ask for no more.

#![no_std]
#![allow(clippy::missing_safety_doc)] // said above once, and in the header of each argument

mod abaqus;
mod about;
mod constants;
mod frictional;
mod hyperelastic;
mod linear_elastic;
mod lsdyna;
mod openradioss;
mod prepared;
mod tables;

pub use abaqus::*;
pub use about::*;
pub use constants::*;
pub use frictional::*;
pub use hyperelastic::*;
pub use linear_elastic::*;
pub use lsdyna::*;
pub use openradioss::*;
pub use prepared::*;
pub use tables::*;

pub use toron::host::arguments::Layout;
pub use toron::host::constants::*;
pub use toron::host::linear_elastic::{LinearBlock, LinearIncrement, LinearPoint};
pub use toron::host::point_and_block::Block;
pub use toron::host::point_and_block::Point;
pub use toron::host::tables::TableRow;
