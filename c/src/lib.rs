//! libtoron: the C interface, as libtoron.so and libtoron.a. Every function here forwards to the one of the crate `toron` that has
//! its name without `toron_`; the header `include/toron.h` is made of these and of the structures there.
//!
//! What a caller promises is said of each argument: a pointer is null only where that is allowed, and has as many values as said;
//! outputs overlap nothing but, exactly, the old state that they replace.

#![allow(clippy::missing_safety_doc)] // said above once, and in the header of each argument

pub mod abaqus;
pub mod about;
pub mod hyperelastic;
pub mod linear_elastic;
pub mod lsdyna;
pub mod openradioss;
pub mod tables;
