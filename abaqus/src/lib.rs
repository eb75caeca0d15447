//! libtoron_abaqus: both laws as Abaqus loads them from `usub_lib_dir`, with no Fortran and no compiler. Linked to as `libstandardU.so`
//! it has the UMAT of Abaqus/Standard, as `libexplicitU-D.so` the VUMAT of jobs in double precision; libtoron_abaqus_sp, linked to as
//! `libexplicitU.so`, has that of jobs in single precision. See `toron::host::abaqus`.
//!
//! A library of its own, since the symbols' names are Abaqus's choice, and since it ends the job where the deck is wrong: package
//! `toron-solvers` has both.

// Abaqus's routines are looked up as Unix has it, and its symbols have other names on Windows.
#![cfg(unix)]

use toron::law::parameters::LINEAR_ELASTIC_PROPERTIES;
use toron::law::state::LINEAR_ELASTIC_STATE;
use toron::{Hyperelastic, LinearElastic};

/// The numbers of properties and of state variables of a material with the linear elastic law; every other one has the hyperelastic
/// law. Ten properties and eleven state variables are a card of the hyperelastic law that lacks a property.
const LINEAR_ELASTIC: [i32; 2] = [LINEAR_ELASTIC_PROPERTIES as i32, LINEAR_ELASTIC_STATE as i32];

#[cfg(not(feature = "single"))]
toron_solvers::abaqus_umat! {
    |cmname, numbers| numbers == LINEAR_ELASTIC, [];
    true => LinearElastic;
    false => Hyperelastic;
}

#[cfg(not(feature = "single"))]
toron_solvers::abaqus_vumat! {
    f64: |cmname, numbers| numbers == LINEAR_ELASTIC, [];
    true => LinearElastic;
    false => Hyperelastic;
}

#[cfg(feature = "single")]
toron_solvers::abaqus_vumat! {
    f32: |cmname, numbers| numbers == LINEAR_ELASTIC, [];
    true => LinearElastic;
    false => Hyperelastic;
}
