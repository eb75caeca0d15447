//! libtoron_calculix: the hyperelastic law as CalculiX loads it, `*MATERIAL, NAME=@TORON_HYPERELASTIC`. See `toron::host::calculix`.
//!
//! A library of its own, since the symbol's name is CalculiX's choice, and since it prints and ends the job where properties are wrong.

use core::ffi::c_char;

/// Arguments as CalculiX passes them, see its `umat_user.f`.
///
/// # Safety
/// CalculiX's promise: every pointer has as many values as said there.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
#[allow(non_snake_case)] // CalculiX looks for capitals.
pub unsafe extern "C" fn HYPERELASTIC(
    amat: *const c_char,
    iel: *const i32,
    iint: *const i32,
    kode: *const i32,
    elconloc: *const f64,
    emec: *const f64,
    emec0: *const f64,
    beta: *const f64,
    xokl: *const f64,
    voj: *const f64,
    xkl: *const f64,
    vj: *const f64,
    ithermal: *const i32,
    t1l: *const f64,
    dtime: *const f64,
    time: *const f64,
    ttime: *const f64,
    icmd: *const i32,
    ielas: *const i32,
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
    ipkon: *const i32,
    amat_length: i32,
) {
    // SAFETY: CalculiX's promise.
    unsafe {
        toron::host::calculix::hyperelastic(
            amat,
            iel,
            iint,
            kode,
            elconloc,
            emec,
            emec0,
            beta,
            xokl,
            voj,
            xkl,
            vj,
            ithermal,
            t1l,
            dtime,
            time,
            ttime,
            icmd,
            ielas,
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
            ipkon,
            amat_length,
        )
    }
}
