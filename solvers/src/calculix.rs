//! CalculiX: for each law the function that it looks for, by the name behind `@LIBRARY_`. A call with wrong properties
//! prints what is wrong and ends the job.

#[doc(hidden)]
#[macro_export]
macro_rules! calculix {
    (f64; $($law:ty as $name:literal, user $number:literal;)+) => {
        $(
            const _: () = {
                /// Arguments as CalculiX passes them, see its `umat_user.f`.
                ///
                /// # Safety
                /// CalculiX's promise: every pointer has as many values as its `umat_user.f` says.
                #[unsafe(export_name = $name)]
                #[allow(clippy::too_many_arguments)]
                pub unsafe extern "C" fn behaviour(
                    amat: *const ::core::ffi::c_char,
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
                    t1l: *const f64,
                    dtime: *const f64,
                    time: *const f64,
                    ttime: *const f64,
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
                    let circumstances = $crate::toron::law::block::Circumstances {
                        // SAFETY: one value each.
                        time_increment: unsafe { *dtime },
                        // SAFETY: the same.
                        time: $crate::toron::host::calculix::sum(unsafe { [*ttime, *time] }),
                        temperature: t1l,
                    };
                    let call = $crate::toron::host::calculix::Behaviour {
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
                        circumstances,
                    };
                    // SAFETY: CalculiX's arguments are those that `Behaviour` promises.
                    unsafe {
                        <<$law as $crate::toron::host::Material<f64>>::Law as $crate::toron::host::calculix::CalculixLaw>::behaviour(&call)
                    }
                }
            };
        )+
    };
    // CalculiX computes in double precision.
    (f32; $($list:tt)+) => {};
}
