//! Abaqus: the symbols `umat_` and `vumat_` that its programs look for, and the end of a job whose deck is wrong, by
//! the routines of the running program.

use std::ffi::{CStr, c_char};
use std::io::Write;

/// The size of a buffer for any message of the library, with the terminating null.
pub const CAPACITY: usize = toron::host::constants::TORON_MESSAGE_CAPACITY;

/// The exit code where Abaqus's own routine is not found.
const ERROR: i32 = 1;

/// The codes below are those of a deck that is wrong; those above, of a point that cannot be evaluated, for which the
/// job goes on.
const WORST_OF_A_DECK: i32 = -300;

/// Of plane elements whose material does not say that they are no plane-stress ones, which have the same numbers of
/// components.
const PLANE_STRESS: &str = "NSHR = 1, as of plane stress, which the laws do not have; for plane strain and axisymmetric solids let \
    the name of the material end in _PSTRAIN or _AXIS";

/// CMNAME, without the blanks behind it.
///
/// # Safety
/// Abaqus's promise: `cmname` has 80 characters.
#[inline(always)]
unsafe fn material_name<'a>(cmname: *const c_char) -> &'a [u8] {
    // SAFETY: `cmname` has 80 characters.
    unsafe { std::slice::from_raw_parts(cmname.cast::<u8>(), 80) }.trim_ascii_end()
}

/// The longest of these names with which that of the material begins, in capitals or not.
///
/// # Safety
/// As for [`refuse`].
pub unsafe fn named(cmname: *const c_char, names: &'static [&'static str]) -> Option<&'static str> {
    // SAFETY: `cmname` is Abaqus's.
    let material = unsafe { material_name(cmname) };
    let begins =
        |name: &&str| material.get(..name.len()).is_some_and(|start| start.eq_ignore_ascii_case(name.as_bytes()));
    names.iter().copied().filter(begins).max_by_key(|name| name.len())
}

/// Ends the job where the status is that of a deck that is wrong, with the library's message, by this routine of
/// Abaqus.
///
/// # Safety
/// Abaqus's promise: `cmname` has 80 characters; and the library's: a message with such a status ends in a null.
pub unsafe fn refuse(status: i32, message: &[c_char; CAPACITY], cmname: *const c_char, routine: &CStr) {
    if status >= 0 || status <= WORST_OF_A_DECK {
        return;
    }
    // SAFETY: a message with such a status ends in a null, and `cmname` is Abaqus's.
    unsafe { end_job(cmname, &CStr::from_ptr(message.as_ptr()).to_string_lossy(), routine) };
}

/// Ends the job since the material's name begins with that of no law.
///
/// # Safety
/// As for [`refuse`].
pub unsafe fn refuse_name(cmname: *const c_char, names: &[&str], routine: &CStr) {
    let text = format!("the name of a material begins with that of its law: {}", names.join(", "));
    // SAFETY: `cmname` is Abaqus's.
    unsafe { end_job(cmname, &text, routine) };
}

/// Whether a VUMAT is called for plane elements that may be those of plane stress; then the job ends.
///
/// # Safety
/// As for [`refuse`].
pub unsafe fn refuses_plane_stress(nshr: i32, cmname: *const c_char, routine: &CStr) -> bool {
    if nshr != 1 {
        return false;
    }
    // SAFETY: `cmname` is Abaqus's.
    let name = unsafe { material_name(cmname) };
    if name.ends_with(b"_PSTRAIN") || name.ends_with(b"_AXIS") {
        return false;
    }
    // SAFETY: as above.
    unsafe { end_job(cmname, PLANE_STRESS, routine) };
    true
}

/// Ends the job, with a message and the material's name in the standard output.
///
/// # Safety
/// As for [`refuse`].
unsafe fn end_job(cmname: *const c_char, text: &str, routine: &CStr) {
    // SAFETY: `cmname` is Abaqus's.
    let name = String::from_utf8_lossy(unsafe { material_name(cmname) });
    // An output that is closed must not keep the job from ending.
    let _ = writeln!(std::io::stdout(), " toron, material {name}: {text}");
    #[cfg(unix)]
    // SAFETY: a null-terminated name; what has it takes no arguments.
    unsafe {
        let found = libc::dlsym(libc::RTLD_DEFAULT, routine.as_ptr());
        if !found.is_null() {
            let end: unsafe extern "C" fn() = std::mem::transmute(found);
            return end();
        }
    }
    #[cfg(not(unix))]
    let _ = routine; // where the running program's routines cannot be asked for
    std::process::exit(ERROR);
}

/// The symbols that Abaqus looks for, of laws told apart by the material's name, and for each law the functions
/// `NAME_abaqus_umat_f64` and `NAME_abaqus_vumat_f64`, or `NAME_abaqus_vumat_f32`, with the arguments of
/// `toron_abaqus_linear_umat_f64` and `toron_abaqus_vumat_f64`.
#[doc(hidden)]
#[macro_export]
macro_rules! abaqus {
    (f64; $($law:ty as $name:literal, user $number:literal;)+) => {
        $crate::abaqus_umat! {
            |cmname, _numbers| $crate::abaqus::named(cmname, &[$($name),+]), [$($name),+];
            $(Some($name) => $law;)+
        }
        $(const _: () = {
            #[unsafe(export_name = concat!($name, "_abaqus_umat_f64"))]
            #[allow(clippy::too_many_arguments)]
            unsafe extern "C" fn umat(
                stress: *mut f64,
                statev: *mut f64,
                ddsdde: *mut f64,
                sse: *mut f64,
                pnewdt: *mut f64,
                dfgrd0: *const f64,
                dfgrd1: *const f64,
                props: *const f64,
                nprops: i32,
                nstatv: i32,
                ndi: i32,
                nshr: i32,
                nlgeom: i32,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                let call = $crate::toron::host::abaqus::Umat {
                    stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom,
                    circumstances: $crate::toron::law::block::Circumstances::UNKNOWN,
                };
                // SAFETY: the arrays are as long as `Umat` says, and the message is the caller's.
                unsafe {
                    <<$law as $crate::toron::host::Material<f64>>::Law as $crate::toron::host::abaqus::StandardLaw>::umat(
                        &call, message, capacity,
                    )
                }
            }
        };)+
        $crate::abaqus! { "_abaqus_vumat_f64", f64; $($law as $name;)+ }
    };
    (f32; $($law:ty as $name:literal, user $number:literal;)+) => {
        $crate::abaqus! { "_abaqus_vumat_f32", f32; $($law as $name;)+ }
    };
    ($suffix:literal, $t:ident; $($law:ty as $name:literal;)+) => {
        $crate::abaqus_vumat! {
            $t: |cmname, _numbers| $crate::abaqus::named(cmname, &[$($name),+]), [$($name),+];
            $(Some($name) => $law;)+
        }
        $(const _: () = {
            #[unsafe(export_name = concat!($name, $suffix))]
            unsafe extern "C" fn vumat(
                block: *const $crate::toron::host::abaqus::Vumat<$t>,
                message: *mut ::core::ffi::c_char,
                capacity: usize,
            ) -> i32 {
                // SAFETY: the structure is the caller's, with arrays as long as its fields say, and so is the message.
                unsafe {
                    <<$law as $crate::toron::host::Material<$t>>::Law as $crate::toron::host::abaqus::ExplicitLaw<$t>>::vumat(
                        block, message, capacity,
                    )
                }
            }
        };)+
    };
}

/// The symbol `umat_` of Abaqus/Standard. The law is the first whose pattern is that of `choice`, computed from CMNAME
/// and the numbers of properties and state variables; without one the job ends with these names of laws.
#[doc(hidden)]
#[macro_export]
macro_rules! abaqus_umat {
    (|$cmname:ident, $numbers:ident| $choice:expr, $names:expr; $($pattern:pat => $law:ty;)+) => {
        /// Arguments as Abaqus passes them, and the hidden length of CMNAME, which is not read.
        ///
        /// # Safety
        /// Abaqus's promise: the arrays have the sizes that its documentation of UMAT says.
        #[cfg(unix)]
        #[unsafe(no_mangle)]
        #[allow(clippy::too_many_arguments)]
        pub unsafe extern "C" fn umat_(
            stress: *mut f64,
            statev: *mut f64,
            ddsdde: *mut f64,
            sse: *mut f64,
            spd: *mut f64,
            _scd: *mut f64,
            _rpl: *mut f64,
            _ddsddt: *mut f64,
            _drplde: *mut f64,
            _drpldt: *mut f64,
            _stran: *const f64,
            _dstran: *const f64,
            time: *const f64,
            dtime: *const f64,
            temp: *const f64,
            dtemp: *const f64,
            _predef: *const f64,
            _dpred: *const f64,
            $cmname: *const ::core::ffi::c_char,
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
            const CAPACITY: usize = $crate::abaqus::CAPACITY;
            let mut message = [0; CAPACITY];
            let (text, mut temperature) = (message.as_mut_ptr(), 0.0);
            // SAFETY: Abaqus's arrays, as long as `Umat` says, its numbers, and JSTEP(4), whose third is 1 with
            // NLGEOM=YES.
            unsafe {
                let call = $crate::toron::host::abaqus::Umat {
                    stress,
                    statev,
                    ddsdde,
                    sse,
                    pnewdt,
                    dfgrd0,
                    dfgrd1,
                    props,
                    nprops: *nprops,
                    nstatv: *nstatv,
                    ndi: *ndi,
                    nshr: *nshr,
                    nlgeom: *jstep.add(2),
                    circumstances: $crate::toron::host::abaqus::circumstances(time, dtime, temp, dtemp, &mut temperature),
                };
                let $numbers = [call.nprops, call.nstatv];
                #[allow(unreachable_patterns)] // where every material has a law
                let status = match $choice {
                    $($pattern => {
                        <<$law as $crate::toron::host::Material<f64>>::Law as $crate::toron::host::abaqus::StandardLaw>::umat_with_losses(
                            &call, spd, text, CAPACITY,
                        )
                    })+
                    _ => return $crate::abaqus::refuse_name($cmname, &$names, c"xit_"),
                };
                $crate::abaqus::refuse(status, &message, $cmname, c"xit_");
            }
        }
    };
}

/// The symbol `vumat_` of Abaqus/Explicit, for jobs whose real numbers are of type `$t`. The law is chosen as in
/// `abaqus_umat!`.
#[doc(hidden)]
#[macro_export]
macro_rules! abaqus_vumat {
    ($t:ident: |$cmname:ident, $numbers:ident| $choice:expr, $names:expr; $($pattern:pat => $law:ty;)+) => {
        /// Arguments as Abaqus passes them, and the hidden length of CMNAME, which is not read.
        ///
        /// # Safety
        /// Abaqus's promise: the arrays have the sizes that its documentation of VUMAT says.
        #[cfg(unix)]
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
            step_time: *const $t,
            total_time: *const $t,
            dt: *const $t,
            $cmname: *const ::core::ffi::c_char,
            _coord_mp: *const $t,
            _char_length: *const $t,
            props: *const $t,
            density: *const $t,
            strain_inc: *const $t,
            _rel_spin_inc: *const $t,
            _temp_old: *const $t,
            stretch_old: *const $t,
            _defgrad_old: *const $t,
            _field_old: *const $t,
            stress_old: *const $t,
            state_old: *const $t,
            ener_intern_old: *const $t,
            ener_inelas_old: *const $t,
            temp_new: *const $t,
            stretch_new: *const $t,
            _defgrad_new: *const $t,
            _field_new: *const $t,
            stress_new: *mut $t,
            state_new: *mut $t,
            ener_intern_new: *mut $t,
            ener_inelas_new: *mut $t,
        ) {
            const CAPACITY: usize = $crate::abaqus::CAPACITY;
            let mut message = [0; CAPACITY];
            let text = message.as_mut_ptr();
            // SAFETY: Abaqus's arrays, as long as `Vumat` says, and its numbers.
            unsafe {
                if $crate::abaqus::refuses_plane_stress(*nshr, $cmname, c"xplb_exit_") {
                    return;
                }
                let block = $crate::toron::host::abaqus::Vumat::<$t> {
                    size: size_of::<$crate::toron::host::abaqus::Vumat<$t>>(),
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
                let circumstances = $crate::toron::law::block::Circumstances::<$t> {
                    time_increment: if dt.is_null() { f64::NAN } else { (*dt).into() },
                    time: block.total_time,
                    temperature: temp_new,
                };
                let $numbers = [*nprops, *nstatev];
                #[allow(unreachable_patterns)] // where every material has a law
                let status = match $choice {
                    $($pattern => {
                        <<$law as $crate::toron::host::Material<$t>>::Law as $crate::toron::host::abaqus::ExplicitLaw<$t>>::vumat_at(
                            &block, circumstances, text, CAPACITY,
                        )
                    })+
                    _ => return $crate::abaqus::refuse_name($cmname, &$names, c"xplb_exit_"),
                };
                $crate::abaqus::refuse(status, &message, $cmname, c"xplb_exit_");
            }
        }
    };
}
