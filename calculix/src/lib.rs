//! libtoron_calculix: both laws as CalculiX loads them, `*MATERIAL, NAME=@TORON_HYPERELASTIC` and `NAME=@TORON_LINEARELASTIC`. See
//! `toron::host::calculix`.
//!
//! A library of its own, since the symbols' names are CalculiX's choice, and since it prints and ends the job where properties are wrong.

use core::ffi::c_char;

use toron::host::calculix::Behaviour;

/// A symbol that CalculiX looks for, which evaluates a law of [`toron::host::calculix`].
macro_rules! behaviour {
    ($(#[$text:meta])* $symbol:ident, $law:ident) => {
        $(#[$text])*
        ///
        /// Arguments as CalculiX passes them, see its `umat_user.f`.
        ///
        /// # Safety
        /// CalculiX's promise: every pointer has as many values as its `umat_user.f` says.
        #[unsafe(no_mangle)]
        #[allow(clippy::too_many_arguments)]
        #[allow(non_snake_case)] // CalculiX looks for capitals.
        pub unsafe extern "C" fn $symbol(
            amat: *const c_char,
            iel: *const i32,
            iint: *const i32,
            kode: *const i32,
            elconloc: *const f64,
            emec: *const f64,
            _emec0: *const f64,
            beta: *const f64,
            _xokl: *const f64,
            _voj: *const f64,
            xkl: *const f64,
            _vj: *const f64,
            _ithermal: *const i32,
            _t1l: *const f64,
            _dtime: *const f64,
            _time: *const f64,
            _ttime: *const f64,
            _icmd: *const i32,
            _ielas: *const i32,
            mi: *const i32,
            nstate_: *const i32,
            xstateini: *const f64,
            xstate: *mut f64,
            stre: *mut f64,
            stiff: *mut f64,
            iorien: *const i32,
            pgauss: *const f64,
            orab: *const f64,
            pnewdt: *mut f64,
            _ipkon: *const i32,
            _amat_length: i32,
        ) {
            let call = Behaviour {
                amat,
                iel,
                iint,
                kode,
                elconloc,
                emec,
                beta,
                xkl,
                mi,
                nstate_,
                xstateini,
                xstate,
                stre,
                stiff,
                iorien,
                pgauss,
                orab,
                pnewdt,
            };
            // SAFETY: CalculiX's promise.
            unsafe { toron::host::calculix::$law(&call) }
        }
    };
}

behaviour! {
    /// The hyperelastic law.
    HYPERELASTIC, hyperelastic
}

behaviour! {
    /// The linear elastic law.
    LINEARELASTIC, linear_elastic
}
