//! libtoron_abaqus: both laws as Abaqus loads them from `usub_lib_dir`, with no Fortran and no compiler. Linked to as `libstandardU.so`
//! it has the UMAT of Abaqus/Standard, as `libexplicitU-D.so` the VUMAT of jobs in double precision; libtoron_abaqus_sp, linked to as
//! `libexplicitU.so`, has that of jobs in single precision. See `toron::host::abaqus`.
//!
//! A library of its own, since the symbols' names are Abaqus's choice, and since it ends the job where the deck is wrong. Abaqus's
//! routines for that are looked up when they are needed: each of its programs has its own.

// Abaqus's routines are looked up as Unix has it, and its symbols have other names on Windows.
#![cfg(unix)]

mod solver;
#[cfg(not(feature = "single"))]
mod umat;
mod vumat;

/// The room for a message of the library, with the terminating null.
const CAPACITY: usize = toron::host::c::TORON_MESSAGE_CAPACITY;

/// The numbers of properties and of state variables of a material with the linear elastic law; every other one has the hyperelastic
/// law. Ten properties and eleven state variables are a card of the hyperelastic law that lacks a property.
const LINEAR_ELASTIC: [i32; 2] =
    [toron::host::c::TORON_LINEAR_ELASTIC_PROPERTIES as i32, toron::host::c::TORON_LINEAR_ELASTIC_STATE as i32];
