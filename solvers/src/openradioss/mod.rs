//! Laws as OpenRadioss loads them, `/MAT/USERnn`, with no other library and no SDK. See `toron::host::openradioss`.
//!
//! The symbols' names are the solver's choice and clash with those of a library that the SDK makes. The library reads
//! and writes the starter's scratch files, and ends the run where the model is wrong.
//!
//! The engine passes a group of elements in five calls on one thread: two with what is input, one with the arrays of
//! the group, and two that collect what is output. The first three are remembered in a thread-local variable, and the
//! fourth evaluates the law.
//!
//! Routines of the solver are looked up when they are needed: not all of them are in the starter, so that a library
//! which demanded them could not be loaded there.

pub mod engine;
mod solver;
pub mod starter;
mod symbols;

use toron::host::openradioss::{Laws, MyReal};

/// The version of the interface: from 1301501260 on the engine passes the deformation gradient, from 2102011230 on
/// there are optional routines for the start and the end of a run, of which these libraries have none.
pub const INTERFACE: i32 = 2_102_011_230;

/// Ends the run: the model has what no library of these laws has.
pub fn stop_refused<T: MyReal>(what: &str, laws: &Laws<T>) {
    let name = |material: &toron::host::openradioss::Material<T>| format!("/MAT/USER{:02}", material.layout.number);
    let names: Vec<_> = laws.materials.iter().map(name).collect();
    let names = names.join(" and ");
    solver::stop(&format!("the model has {what}; this library has materials of solids alone: {names}"));
}

#[doc(hidden)]
#[macro_export]
macro_rules! openradioss {
    ($t:ident; $first:ty as $first_name:literal, user $first_number:literal;
     $($law:ty as $name:literal, user $number:literal;)*) => {
        $crate::openradioss_symbols! {
            $t;
            $crate::toron::host::openradioss::Laws::new(
                &[
                    $crate::openradioss_material!($t, $first, $first_number),
                    $($crate::openradioss_material!($t, $law, $number)),*
                ],
                concat!($first_number, " (", $first_name, ")" $(, ", ", $number, " (", $name, ")")*),
            )
        }
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! openradioss_material {
    ($t:ident, $law:ty, $number:literal) => {
        $crate::toron::host::openradioss::Material::of::<<$law as $crate::toron::host::Material<$t>>::Law>($number)
    };
}
