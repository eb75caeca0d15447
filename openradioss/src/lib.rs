//! libtoron_openradioss: toron's own laws as OpenRadioss loads them, `/MAT/USER01` and `/MAT/USER02`, with no other
//! library and no SDK. See `toron::host::openradioss`.
//!
//! A library of its own, since the symbols' names are the solver's choice and clash with those of a library that the
//! SDK makes, and since it reads and writes the starter's scratch files and ends the run where the model is wrong.

// The solver's routines are looked up as Unix has it.
#![cfg(unix)]

use toron::host::openradioss::MyReal;

/// The solver's `my_real`.
#[cfg(not(feature = "single"))]
type Real = f64;
#[cfg(feature = "single")]
type Real = f32;

toron_solvers::openradioss_symbols! { Real; Real::TORON }
