//! The UMAT of Abaqus/Standard.

use std::ffi::c_char;

use toron::host::abaqus::{linear_umat_f64, umat_tangent_f64};

use crate::solver::refuse;
use crate::{CAPACITY, LINEAR_ELASTIC};

/// Arguments as Abaqus passes them, and the hidden length of CMNAME, which is not read.
///
/// # Safety
/// Abaqus's promise: the arrays have the sizes that its documentation of UMAT says.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn umat_(
    stress: *mut f64,
    statev: *mut f64,
    ddsdde: *mut f64,
    sse: *mut f64,
    _spd: *mut f64,
    _scd: *mut f64,
    _rpl: *mut f64,
    _ddsddt: *mut f64,
    _drplde: *mut f64,
    _drpldt: *mut f64,
    _stran: *const f64,
    _dstran: *const f64,
    _time: *const f64,
    _dtime: *const f64,
    _temp: *const f64,
    _dtemp: *const f64,
    _predef: *const f64,
    _dpred: *const f64,
    cmname: *const c_char,
    ndi: *const i32,
    nshr: *const i32,
    _ntens: *const i32,
    nstatv: *const i32,
    props: *const f64,
    nprops: *const i32,
    _coords: *const f64,
    _drot: *const f64,
    pnewdt: *mut f64,
    _celent: *const f64,
    dfgrd0: *const f64,
    dfgrd1: *const f64,
    _noel: *const i32,
    _npt: *const i32,
    _layer: *const i32,
    _kspt: *const i32,
    jstep: *const i32,
    _kinc: *const i32,
) {
    let mut message = [0; CAPACITY];
    let text = message.as_mut_ptr();
    // SAFETY: Abaqus's promise. JSTEP(3) is 1 with NLGEOM=YES.
    unsafe {
        let (nprops, nstatv, ndi, nshr, nlgeom) = (*nprops, *nstatv, *ndi, *nshr, *jstep.add(2));
        let status = if [nprops, nstatv] == LINEAR_ELASTIC {
            linear_umat_f64(
                stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, text,
                CAPACITY,
            )
        } else {
            umat_tangent_f64(
                stress, statev, ddsdde, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, text, CAPACITY,
            )
        };
        refuse(status, &message, cmname, c"xit_");
    }
}
