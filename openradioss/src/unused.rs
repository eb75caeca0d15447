//! Routines that the solver wants to find and this library has no use for: the solver takes no library that lacks one. A model that
//! calls one stops, with what it asks for.
//!
//! They declare no arguments, since they use none: see [`engine`](crate::engine).

use crate::solver::stop;

/// Routines by their names in the solver, with what calls them.
macro_rules! refused {
    ($($name:ident: $what:literal;)*) => {$(
        #[doc = concat!("Called for ", $what, ", which is refused.")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name() {
            stop(concat!(
                "the model has ", $what,
                "; this library has materials of solids alone: /MAT/USER01 and /MAT/USER02"
            ));
        }
    )*};
}

refused! {
    st_lecg_: "the property /PROP/USER29 to 31";
    st_lecguser_: "a user property";
    st_lecm_: "a material /MAT/USER1 to 3 (law 29 to 31)";
    st_lecr_: "a user failure model";
    st_lecsen_: "a user sensor";
    st_riniuser_: "a user spring";
    st_siniusr_: "a user solid element";
    st_userwis_: "a user window";
    st_userwis_ini_: "a user window";
    eng_ruser_: "a user spring";
    eng_sigeps_: "a material /MAT/USER1 to 3 (law 29 to 31)";
    eng_sigepsc_: "a material /MAT/USER1 to 3 (law 29 to 31) of shells";
    eng_flaw_: "a user failure model";
    eng_flawc_: "a user failure model of shells";
    eng_suser_: "a user solid element";
    eng_userint_: "a user interface";
    eng_get_uintbuf_var_: "a user interface";
    eng_userwi_: "a user window";
    eng_user_sens_: "a user sensor";
    eng_get_lawc_user_var_: "a material of shells";
    eng_get_lawc_user_var_2_: "a material of shells";
    eng_sigeps99c_: "a material of shells";
    eng_set_lawc_user_var_: "a material of shells";
    eng_set_lawc_user_var_2_: "a material of shells";
}
