//! The symbols that the solver looks up.
//!
//! The routines of the engine declare the leading arguments, up to the last one that they use: on the solver's
//! platforms the caller removes the arguments of a C routine, so that it may take fewer than it is given. The refused
//! ones declare none, since they use none: the solver takes no library that lacks one of them, and a model that calls
//! one stops, with what it asks for.
//!
//! What the solver passes is said of each routine under "Safety"; the blocks refer to that.

/// The symbols of a library with the laws of a list, a constant of type [`Laws`](toron::host::openradioss::Laws), for
/// the solver's real numbers of this type.
#[doc(hidden)]
#[macro_export]
macro_rules! openradioss_symbols {
    ($t:ty; $laws:expr) => {
        const _: () = {
            static LAWS: $crate::toron::host::openradioss::Laws<$t> = $laws;

            /// # Safety
            /// `version` is an integer.
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn userlib_id(version: *mut i32) {
                // SAFETY: as just said.
                unsafe { *version = $crate::openradioss::INTERFACE };
            }

            /// `LECMUSERnn`: `ilaw` is the number in the names of the scratch files, `rootn` the first `rootlen`
            /// characters of the run's name, `number` is nn.
            ///
            /// # Safety
            /// `rootn` has `rootlen` characters, `uparam` `maxuparam` values, `parmat` at least three.
            #[unsafe(no_mangle)]
            #[allow(clippy::too_many_arguments)]
            pub unsafe extern "C" fn st_lecm99_(
                ilaw: *const i32,
                rootn: *const ::core::ffi::c_char,
                rootlen: *const i32,
                number: *const i32,
                uparam: *mut $t,
                maxuparam: *const i32,
                nuparam: *mut i32,
                nuvar: *mut i32,
                _ifunc: *mut i32,
                _maxfunc: *const i32,
                nfunc: *mut i32,
                parmat: *mut $t,
            ) {
                // SAFETY: as just said.
                unsafe {
                    let root = std::slice::from_raw_parts(rootn.cast::<u8>(), usize::try_from(*rootlen).unwrap_or(0));
                    let Some(material) =
                        $crate::openradioss::starter::material(&LAWS, *ilaw, root, *number, *maxuparam)
                    else {
                        return;
                    };
                    uparam.copy_from_nonoverlapping(material.uparam.as_ptr(), material.uparam.len());
                    (*nuparam, *nuvar, *nfunc) = (material.uparam.len() as i32, material.variables as i32, 0);
                    *parmat = material.modulus;
                }
            }

            /// The first call: the cycle, the material's number in the model and the density.
            ///
            /// # Safety
            /// `cycle` and `material` are integers, and the arrays are valid until the fourth call.
            #[unsafe(no_mangle)]
            #[allow(clippy::too_many_arguments)]
            pub unsafe extern "C" fn eng_get_law_user_var_(
                cycle: *const i32,
                material: *const i32,
                _iptr: *const i32,
                _ipts: *const i32,
                _iptt: *const i32,
                _r11: *const $t,
                _r12: *const $t,
                _r13: *const $t,
                _r21: *const $t,
                _r22: *const $t,
                _r23: *const $t,
                _r31: *const $t,
                _r32: *const $t,
                _r33: *const $t,
                _old_stress_xx: *const $t,
                _old_stress_yy: *const $t,
                _old_stress_zz: *const $t,
                _old_stress_xy: *const $t,
                _old_stress_yz: *const $t,
                _old_stress_zx: *const $t,
                _strain_rate_xx: *const $t,
                _strain_rate_yy: *const $t,
                _strain_rate_zz: *const $t,
                _strain_rate_xy: *const $t,
                _strain_rate_yz: *const $t,
                _strain_rate_zx: *const $t,
                _strain_xx: *const $t,
                _strain_yy: *const $t,
                _strain_zz: *const $t,
                _strain_xy: *const $t,
                _strain_yz: *const $t,
                _strain_zx: *const $t,
                _strain_increment_xx: *const $t,
                _strain_increment_yy: *const $t,
                _strain_increment_zz: *const $t,
                _strain_increment_xy: *const $t,
                _strain_increment_yz: *const $t,
                _strain_increment_zx: *const $t,
                density: *const $t,
            ) {
                // SAFETY: as just said.
                let (cycle, material) = unsafe { (*cycle, *material) };
                $crate::openradioss::engine::begin::<$t>(cycle, material, density);
            }

            /// The second call: the deformation gradient. Each array is followed by its length, which is the solver's
            /// vector length.
            ///
            /// # Safety
            /// The arrays are valid until the fourth call.
            #[unsafe(no_mangle)]
            #[allow(clippy::too_many_arguments)]
            pub unsafe extern "C" fn eng_get_law_user_var_2_(
                fpsxx: *const $t,
                _size_fpsxx: *const i32,
                fpsyy: *const $t,
                _size_fpsyy: *const i32,
                fpszz: *const $t,
                _size_fpszz: *const i32,
                fpsxy: *const $t,
                _size_fpsxy: *const i32,
                fpsyz: *const $t,
                _size_fpsyz: *const i32,
                fpszx: *const $t,
                _size_fpszx: *const i32,
                fpsyx: *const $t,
                _size_fpsyx: *const i32,
                fpszy: *const $t,
                _size_fpszy: *const i32,
                fpsxz: *const $t,
                _size_fpsxz: *const i32,
            ) {
                $crate::openradioss::engine::deform::<$t>([
                    fpsxx, fpsyy, fpszz, fpsxy, fpsyz, fpszx, fpsyx, fpszy, fpsxz,
                ]);
            }

            /// The third call: counts and arrays of the group. The law is not evaluated yet, since the arrays for its
            /// stress come with the fourth call.
            ///
            /// # Safety
            /// Counts and times are numbers, and the arrays are valid until the fourth call.
            #[unsafe(no_mangle)]
            #[allow(clippy::too_many_arguments)]
            pub unsafe extern "C" fn eng_sigeps99_(
                nel: *const i32,
                nuparam: *const i32,
                nuvar: *const i32,
                number: *const i32,
                _nfunc: *const i32,
                _ifunc: *const i32,
                _npf: *const i32,
                _tf: *const $t,
                time: *const $t,
                time_step: *const $t,
                uparam: *const $t,
                _rho: *const $t,
                volume: *const $t,
                _eint: *const $t,
                ngl: *const i32,
                soundsp: *mut $t,
                _viscmax: *mut $t,
                uvar: *mut $t,
                off: *mut $t,
            ) {
                // SAFETY: as just said.
                let (nel, nuparam, nuvar, number) = unsafe { (*nel, *nuparam, *nuvar, *number) };
                // SAFETY: the same.
                let (time, time_step) = unsafe { (*time, *time_step) };
                $crate::openradioss::engine::group::<$t>(number, |group| {
                    (group.elements, group.parameters, group.variables) = (nel, nuparam, nuvar);
                    (group.time, group.time_step) = (time, time_step);
                    (group.uparam, group.numbers, group.sound_speed) = (uparam, ngl, soundsp);
                    (group.uvar, group.off) = (uvar, off);
                    group.volume = volume;
                });
            }

            /// The fourth call: the arrays for the stress. Evaluates the law. The viscous stress comes behind it; the
            /// solver has set that and VISCMAX to 0, as they are to be.
            ///
            /// # Safety
            /// The arrays have the solver's vector length, and those of the calls before are still valid.
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn eng_set_law_user_var_(
                signxx: *mut $t,
                signyy: *mut $t,
                signzz: *mut $t,
                signxy: *mut $t,
                signyz: *mut $t,
                signzx: *mut $t,
            ) {
                // SAFETY: as just said.
                unsafe {
                    $crate::openradioss::engine::evaluate::<$t>(&LAWS, [signxx, signyy, signzz, signxy, signyz, signzx])
                };
            }

            /// The fifth call: nothing else is output.
            #[unsafe(no_mangle)]
            pub extern "C" fn eng_set_law_user_var_2_() {}

            $crate::openradioss_refused! {
                LAWS;
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
        };
    };
}

/// Routines by their names in the solver, with what calls them.
#[doc(hidden)]
#[macro_export]
macro_rules! openradioss_refused {
    ($laws:ident; $($name:ident: $what:literal;)*) => {$(
        #[doc = concat!("Called for ", $what, ", which is refused.")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name() {
            $crate::openradioss::stop_refused($what, &$laws);
        }
    )*};
}
