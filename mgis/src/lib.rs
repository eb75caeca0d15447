//! libtoron_mgis: the library's laws as MGIS, MTest and whatever else loads MFront's libraries find them. See
//! `toron::host::mgis`.
//!
//! A library of its own, since the names of the symbols are MFront's choice.

macro_rules! behaviours {
    ($($law:ident {
        $name:literal, $title:literal, $symbol:literal, $behaviour:literal, user $user:literal, umat $umat:literal
    })+) => {
        toron_solvers::mgis! { f64; $(toron::$law as $behaviour, user $user;)+ }
    };
}

toron::library_laws! { behaviours {} }

/// The bounds of a law's properties, each under both of MFront's names: outside them the property is refused. The
/// properties that have bounds are listed, since a name of a symbol cannot be computed; the list is checked against the
/// table.
#[cfg(target_arch = "x86_64")]
macro_rules! bounds {
    ($behaviour:literal, $law:path: $($property:literal),*) => {
        const _: () = assert!(
            toron::host::mgis::symbols::have_bounds($law.properties, &[$($property),*]),
            "the list of properties with bounds"
        );
        $(
            bounds!($behaviour, $law, $property, "Lower", 0);
            bounds!($behaviour, $law, $property, "Upper", 1);
        )*
    };
    ($behaviour:literal, $law:path, $property:literal, $side:literal, $index:literal) => {
        const _: () = {
            use toron::host::mgis::symbols::{LongDouble, bounds};

            #[unsafe(export_name = concat!($behaviour, "_", $property, "_", $side, "Bound"))]
            pub static STANDARD: LongDouble = bounds($law.properties, $property)[$index];
            #[unsafe(export_name = concat!($behaviour, "_", $property, "_", $side, "PhysicalBound"))]
            pub static PHYSICAL: LongDouble = bounds($law.properties, $property)[$index];
        };
    };
}

#[cfg(target_arch = "x86_64")]
bounds! {
    "ToronHyperelastic", toron::law::description::HYPERELASTIC:
    "k_el", "k_tc", "p", "k_td", "k_ld", "eps_lim", "alpha", "beta"
}

#[cfg(target_arch = "x86_64")]
bounds! {
    "ToronLinearElastic", toron::law::description::LINEAR_ELASTIC:
    "e_1", "e_2", "g", "sigma_lim"
}

#[cfg(target_arch = "x86_64")]
bounds! {
    "ToronFrictional", toron::law::description::FRICTIONAL:
    "k_el", "k_tc", "p", "k_td", "k_ld", "eps_lim", "alpha", "beta", "mu", "cohesion"
}
