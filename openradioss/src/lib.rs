//! libtoron_openradioss: both laws as OpenRadioss loads them, `/MAT/USER01` and `/MAT/USER02`, with no other library and no SDK. See
//! `toron::host::openradioss`.
//!
//! A library of its own, since the symbols' names are the solver's choice and clash with those of a library that the SDK makes, and
//! since it reads and writes the starter's scratch files and ends the run where the model is wrong.
//!
//! The engine passes a group of elements in five calls on one thread: two with what is input, one with the arrays of the group, and
//! two that collect what is output. The first three are remembered in a thread-local variable, and the fourth evaluates the law.
//!
//! Routines of the solver are looked up when they are needed: not all of them are in the starter, so that a library which demanded
//! them could not be loaded there.

// The solver's routines are looked up as Unix has it.
#![cfg(unix)]

mod engine;
mod solver;
mod starter;
mod unused;

/// The solver's `my_real`.
#[cfg(not(feature = "single"))]
pub type Real = f64;
#[cfg(feature = "single")]
pub type Real = f32;

/// The version of the interface: from 1301501260 on the engine passes the deformation gradient, from 2102011230 on there are optional
/// routines for the start and the end of a run, of which this library has none.
const INTERFACE: i32 = 2_102_011_230;

/// # Safety
/// The solver's promise: `version` is an integer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn userlib_id(version: *mut i32) {
    // SAFETY: the solver's promise.
    unsafe { *version = INTERFACE };
}
