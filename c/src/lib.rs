//! libtoron: the C interface, as libtoron.so and libtoron.a. A function here calls that of the crate `toron` which has its name without
//! `toron_`; those for Abaqus and LS-DYNA put their arguments into a structure, with which they call a routine of a law. The header
//! `include/toron.h` is made of these functions and of the structures of `toron`.
//!
//! What a caller promises is said of each argument, and in [`toron::host::c`] of all: a pointer is null only where that is allowed, and
//! else points to as many values as said; outputs overlap nothing but, exactly, the old state that they replace. So the call of each
//! function, which passes its arguments on, is as safe as the call of it.

#![allow(clippy::missing_safety_doc)] // said above once, and in the header of each argument

pub mod abaqus;
pub mod about;
pub mod hyperelastic;
pub mod linear_elastic;
pub mod lsdyna;
pub mod openradioss;
pub mod tables;
