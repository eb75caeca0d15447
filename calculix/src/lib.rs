//! libtoron_calculix: both laws as CalculiX loads them, `*MATERIAL, NAME=@TORON_HYPERELASTIC` and `NAME=@TORON_LINEARELASTIC`. See
//! `toron::host::calculix`.
//!
//! A library of its own, since the symbols' names are CalculiX's choice, and since it prints and ends the job where properties are wrong.

toron_solvers::calculix! {
    f64;
    toron::Hyperelastic as "HYPERELASTIC", user 1;
    toron::LinearElastic as "LINEARELASTIC", user 2;
}
