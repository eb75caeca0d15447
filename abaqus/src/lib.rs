//! libtoron_abaqus: the library's laws as Abaqus loads them from `usub_lib_dir`, with no Fortran and no compiler.
//! Linked to as `libstandardU.so` it has the UMAT of Abaqus/Standard, as `libexplicitU-D.so` the VUMAT of jobs in
//! double precision; libtoron_abaqus_sp, linked to as `libexplicitU.so`, has that of jobs in single precision. See
//! `toron::host::abaqus`.
//!
//! A library of its own, since the symbols' names are Abaqus's choice, and since it ends the job where the deck is
//! wrong: package `toron-solvers` has both.

// Abaqus's routines are looked up as Unix has it, and its symbols have other names on Windows.
#![cfg(unix)]

use toron::host::laws::by_counts;

// The numbers of properties and of state variables tell the laws apart, and every other material has the hyperelastic
// law. Ten properties and eleven state variables are a card of the hyperelastic law that lacks a property.
macro_rules! routines {
    ($($law:ident {
        $name:literal, $title:literal, $symbol:literal, $behaviour:literal, user $user:literal, umat $umat:literal
    })+) => {
        #[cfg(not(feature = "single"))]
        toron_solvers::abaqus_umat! {
            |cmname, numbers| by_counts(numbers), [];
            $($user => toron::$law;)+
        }

        #[cfg(not(feature = "single"))]
        toron_solvers::abaqus_vumat! {
            f64: |cmname, numbers| by_counts(numbers), [];
            $($user => toron::$law;)+
        }

        #[cfg(feature = "single")]
        toron_solvers::abaqus_vumat! {
            f32: |cmname, numbers| by_counts(numbers), [];
            $($user => toron::$law;)+
        }
    };
}

toron::library_laws! { routines {} }
