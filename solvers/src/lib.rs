//! What makes a library of a material law for every solver: the symbols that each of them looks for, and the routines
//! of the solver by which a job with a wrong deck ends.
//!
//! A library for all of them, of a law of your own and of whatever laws are to be beside it, is a package of crate type
//! `cdylib` (`staticlib` too, for LS-DYNA's shims) with this as its only content:
//!
//! ```ignore
//! toron_solvers::export! { f64; ReinforcedSolid as "REINFORCED", user 3; }
//! ```
//!
//! The name is that of the law in every solver; see `docs/guides/own-law.md`. The libraries of toron's own laws are
//! made by the same macros, one for each solver.

#[doc(hidden)]
pub mod abaqus;
#[doc(hidden)]
pub mod c;
#[doc(hidden)]
pub mod calculix;
#[doc(hidden)]
pub mod lsdyna;
#[doc(hidden)]
pub mod mgis;
#[doc(hidden)]
pub mod openradioss;

pub use c::{c_header, write_header};

// What the macros name, in whatever package they are used.
#[doc(hidden)]
pub use {libc, toron};

/// Exports laws to every solver, in the precision of the solver's real numbers, `f64` or `f32`. CalculiX and MFront's
/// loaders have double precision alone.
///
/// For each law its type ([`UserMaterial`](toron::user::UserMaterial), or toron's own
/// [`Hyperelastic`](toron::Hyperelastic) and [`LinearElastic`](toron::LinearElastic)), its name, a C identifier in
/// capitals, and its number in OpenRadioss, `/MAT/USERnn`. Two laws of one name or number do not compile:
///
/// ```no_run
/// toron_solvers::export! { f64; toron::Hyperelastic as "YARN", user 1; toron::LinearElastic as "LINEAR", user 2; }
/// # fn main() {}
/// ```
/// ```compile_fail
/// toron_solvers::export! { f64; toron::Hyperelastic as "YARN", user 1; toron::LinearElastic as "YARN", user 2; }
/// # fn main() {}
/// ```
/// ```compile_fail
/// toron_solvers::export! { f64; toron::Hyperelastic as "YARN", user 1; toron::LinearElastic as "LINEAR", user 1; }
/// # fn main() {}
/// ```
/// ```compile_fail
/// toron_solvers::export! { f64; toron::Hyperelastic as "yarn", user 1; }
/// # fn main() {}
/// ```
/// A law may be called as one likes:
/// ```no_run
/// mod engine {
///     pub use toron::{Hyperelastic as Law, LinearElastic as Material};
/// }
/// use engine::Material;
/// toron_solvers::export! { f64; engine::Law as "LAW", user 1; Material as "MATERIAL", user 2; }
/// # fn main() {}
/// ```
#[macro_export]
macro_rules! export {
    ($t:ident; $($law:ty as $name:literal, user $number:literal);+ $(;)?) => {
        const _: () = $crate::assert_distinct(&[$($name),+], &[$($number),+]);
        $(const _: () = <$law as $crate::toron::host::Material<$t>>::TABLES_FIT;)+
        $crate::abaqus! { $t; $($law as $name, user $number;)+ }
        $crate::c! { $t; $($law as $name, user $number;)+ }
        $crate::calculix! { $t; $($law as $name, user $number;)+ }
        $crate::lsdyna! { $t; $($law as $name, user $number;)+ }
        $crate::mgis! { $t; $($law as $name, user $number;)+ }
        $crate::openradioss! { $t; $($law as $name, user $number;)+ }
    };
}

/// Checks names and numbers of a list of laws at compile time.
#[doc(hidden)]
pub const fn assert_distinct(names: &[&str], numbers: &[i32]) {
    let mut i = 0;
    while i < names.len() {
        assert!(
            toron::host::is_name(names[i]),
            "a law's name is made of capitals, digits and underscores, and begins with a capital"
        );
        assert!(toron::host::is_number(numbers[i]), "a law's number in OpenRadioss is from 1 to 99");
        let mut k = 0;
        while k < i {
            assert!(!toron::law::parameters::same(names[i], names[k]), "two laws have the same name");
            assert!(numbers[i] != numbers[k], "two laws have the same number");
            k += 1;
        }
        i += 1;
    }
}
