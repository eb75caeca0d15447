//! libtoron_calculix: the library's laws as CalculiX loads them, `*MATERIAL, NAME=@TORON_HYPERELASTIC` and
//! `NAME=@TORON_LINEARELASTIC`. See `toron::host::calculix`.
//!
//! A library of its own, since the symbols' names are CalculiX's choice, and since it prints and ends the job where
//! properties are wrong.

macro_rules! behaviours {
    ($($law:ident {
        $name:literal, $title:literal, $symbol:literal, $behaviour:literal, user $user:literal, umat $umat:literal
    })+) => {
        toron_solvers::calculix! { f64; $(toron::$law as $symbol, user $user;)+ }
    };
}

toron::library_laws! { behaviours {} }
