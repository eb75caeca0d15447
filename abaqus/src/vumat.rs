//! The VUMAT of Abaqus/Explicit.

use std::ffi::{CStr, c_char};

use toron::host::abaqus::Vumat;
#[cfg(feature = "single")]
use toron::host::abaqus::{linear_vumat_f32 as linear_vumat, vumat_f32 as vumat};
#[cfg(not(feature = "single"))]
use toron::host::abaqus::{linear_vumat_f64 as linear_vumat, vumat_f64 as vumat};

use crate::solver::refuse;
use crate::{CAPACITY, LINEAR_ELASTIC};

/// The real numbers of the job.
#[cfg(not(feature = "single"))]
type Real = f64;
#[cfg(feature = "single")]
type Real = f32;

/// Of plane elements whose material does not say that they are no plane-stress ones, which have the same numbers of components.
const PLANE_STRESS: &CStr =
    c"NSHR = 1, as of plane stress, which the laws do not have; for plane strain and axisymmetric solids let \
    the name of the material end in _PSTRAIN or _AXIS";

/// Whether the material's name says that its elements are of plane strain or axisymmetric.
///
/// # Safety
/// Abaqus's promise: `material` has 80 characters.
unsafe fn is_announced(material: *const c_char) -> bool {
    // SAFETY: the caller's promise.
    let name = unsafe { std::slice::from_raw_parts(material.cast::<u8>(), 80) }.trim_ascii_end();
    name.ends_with(b"_PSTRAIN") || name.ends_with(b"_AXIS")
}

/// Arguments as Abaqus passes them, and the hidden length of CMNAME, which is not read.
///
/// # Safety
/// Abaqus's promise: the arrays have the sizes that its documentation of VUMAT says.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
#[allow(clippy::useless_conversion)] // times of a job in single precision
pub unsafe extern "C" fn vumat_(
    nblock: *const i32,
    ndir: *const i32,
    nshr: *const i32,
    nstatev: *const i32,
    _nfieldv: *const i32,
    nprops: *const i32,
    _lanneal: *const i32,
    step_time: *const Real,
    total_time: *const Real,
    _dt: *const Real,
    cmname: *const c_char,
    _coord_mp: *const Real,
    _char_length: *const Real,
    props: *const Real,
    density: *const Real,
    strain_inc: *const Real,
    _rel_spin_inc: *const Real,
    _temp_old: *const Real,
    stretch_old: *const Real,
    _defgrad_old: *const Real,
    _field_old: *const Real,
    stress_old: *const Real,
    state_old: *const Real,
    ener_intern_old: *const Real,
    ener_inelas_old: *const Real,
    _temp_new: *const Real,
    stretch_new: *const Real,
    _defgrad_new: *const Real,
    _field_new: *const Real,
    stress_new: *mut Real,
    state_new: *mut Real,
    ener_intern_new: *mut Real,
    ener_inelas_new: *mut Real,
) {
    let mut message = [0; CAPACITY];
    // SAFETY: Abaqus's promise.
    unsafe {
        if *nshr == 1 && !is_announced(cmname) {
            message.iter_mut().zip(PLANE_STRESS.to_bytes_with_nul()).for_each(|(to, &from)| *to = from as c_char);
            return refuse(toron::law::status::BAD_COUNT, &message, cmname, c"xplb_exit_");
        }
        let block = Vumat {
            size: size_of::<Vumat<Real>>(),
            nblock: *nblock,
            ndir: *ndir,
            nshr: *nshr,
            nstatev: *nstatev,
            nprops: *nprops,
            level: 0,
            step_time: (*step_time).into(),
            total_time: (*total_time).into(),
            props,
            density,
            strain_inc,
            stretch_old,
            stretch_new,
            stress_old,
            state_old,
            ener_intern_old,
            ener_inelas_old,
            stress_new,
            state_new,
            ener_intern_new,
            ener_inelas_new,
        };
        let entry = if [*nprops, *nstatev] == LINEAR_ELASTIC { linear_vumat } else { vumat };
        let status = entry(&block, message.as_mut_ptr(), CAPACITY);
        refuse(status, &message, cmname, c"xplb_exit_");
    }
}
