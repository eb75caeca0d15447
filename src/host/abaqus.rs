//! Abaqus: UMAT (Standard) and VUMAT (Explicit).
//!
//! | | UMAT | VUMAT |
//! |---|---|---|
//! | deformation | DFGRD1(3,3), F by columns | stretchNew, U: 11 22 33 12 23 31 |
//! | frame of the stress | global; no `*ORIENTATION` | corotational: RᵀσR |
//! | order of the stress | 11 22 33 **12 13 23** | 11 22 33 **12 23 31** |
//! | arrays | one point | (nblock, components), component-major |
//! | precision | double | that of the job |
//! | energy | SSE = W/J per current volume | enerInternNew = W/ρ0 per mass |
//! | failure | stress 0, STATEV "alive" 0 | state variable 11, "alive", 0: `*DEPVAR, DELETE=11` |
//! | F inverted or not finite | state kept, PNEWDT ≤ ¼ | point failed and deleted |
//! | tangent | DDSDDE(ntens, ntens): the Jaumann rate of τ, over J | none |
//!
//! Solids: three-dimensional ones (NDI = 3, NSHR = 3) and, for a UMAT, plane strain and axisymmetric ones (3, 1). The symbols
//! `umat_` and `vumat_` that Abaqus looks for are in `fortran-shim/`.

use core::cell::Cell;
use core::mem::MaybeUninit;
use core::slice;

use libc::{c_char, size_t};

use crate::law::block::{Pointers, Precision, components, components_mut};
use crate::law::bounds::wrong_number;
use crate::law::derivative::{Derivative, JaumannModulus, StressAndState};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::number::level::Level;
use crate::law::number::real::Real;
use crate::law::number::vector::{cross, dot};
use crate::law::parameters;
use crate::law::point::{Call, Point, Sink, evaluate_call};
use crate::law::state::{ALIVE, ENERGIES, FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use crate::law::status;
use crate::law::voigt::Moduli;

use super::border::{Message, check_pointers, entry, fibre_of, out_of_plane, properties};
use super::c::level;
use super::structures::{read, structures};

/// The value that PNEWDT is lowered to if a point cannot be evaluated.
const CUTBACK: f64 = 0.25;

/// Checks the numbers of components and state variables, of which `allowed` are the numbers of shear components. `texts` says what
/// direct and shear components are.
///
/// # Errors
/// The first number that is wrong.
fn check_counts(direct: i32, shear: i32, allowed: &[i32], state: i32, texts: [&'static str; 2]) -> Result<(), Error> {
    let wrong = |code: i32, what: &'static str, found: i32, wanted: usize| {
        Err(Error::Count { code, what, found: i64::from(found), wanted: wanted as i64 })
    };
    if direct != 3 {
        return wrong(status::BAD_COUNT, texts[0], direct, 3);
    }
    if !allowed.contains(&shear) {
        return wrong(status::BAD_COUNT, texts[1], shear, 3);
    }
    if state < HYPERELASTIC_STATE as i32 {
        return wrong(status::STATE_COUNT, "number of state variables (*DEPVAR)", state, HYPERELASTIC_STATE);
    }
    Ok(())
}

/// The number of properties, which Abaqus passes with a sign.
fn property_count(nprops: i32) -> Result<usize, Error> {
    usize::try_from(nprops).map_err(|_| wrong_number(i64::from(nprops), &parameters::HYPERELASTIC))
}

/// Checks the arguments of a UMAT, evaluates its point with or without DDSDDE and stores the results. Returns the status code.
///
/// # Safety
/// As documented for `toron_abaqus_umat_tangent_f64` in package `toron-c`; `ddsdde` is not null if `tangent` is DDSDDE.
#[allow(clippy::too_many_arguments)]
#[inline(always)]
unsafe fn umat<D: Derivative<N>, const N: usize>(
    stress: *mut f64,
    statev: *mut f64,
    ddsdde: *mut f64,
    sse: *mut f64,
    pnewdt: *mut f64,
    dfgrd1: *const f64,
    props: *const f64,
    nprops: i32,
    nstatv: i32,
    ndi: i32,
    nshr: i32,
    nlgeom: i32,
    message: Message,
    tangent: D,
) -> i32
where
    for<'a> Umat<'a>: Sink<f64, N>,
{
    let solid = ndi == 3 && (nshr == 3 || nshr == 1) && nstatv >= HYPERELASTIC_STATE as i32 && nlgeom != 0;
    let given = !stress.is_null() & !statev.is_null() & !sse.is_null() & !pnewdt.is_null() & !dfgrd1.is_null();
    if !solid || !given || props.is_null() || nprops != parameters::HYPERELASTIC_PROPERTIES as i32 || nshr == 1 {
        // Every argument is looked at only if one of them is wrong, or if the element is two-dimensional.
        let pointers = [
            (stress.cast_const(), "stress"),
            (statev, "statev"),
            (sse, "sse"),
            (pnewdt, "pnewdt"),
            (dfgrd1, "dfgrd1"),
            (props, "props"),
        ];
        // SAFETY: the caller's promise.
        let code = unsafe {
            entry(message, || {
                check_pointers(&pointers)?;
                check_umat(nstatv, ndi, nshr, nlgeom)?;
                let properties = properties(props, property_count(nprops)?, &parameters::HYPERELASTIC)?;
                if nshr == 1 {
                    Hyperelastic::new(properties)?;
                    if fibre_of(properties).is_some_and(out_of_plane) {
                        return Err(Error::Plain(status::FIBRE_OUT_OF_PLANE));
                    }
                }
                Ok(status::OK)
            })
        };
        if code != status::OK {
            return code;
        }
    }
    // The structures are built inside the closure, so that their fields need not be copied as a whole.
    let body = move || {
        // SAFETY: not null, and the caller's promise.
        let (source, f, state) = unsafe {
            (
                slice::from_raw_parts(props, parameters::HYPERELASTIC_PROPERTIES),
                &*dfgrd1.cast::<[[f64; 3]; 3]>(),
                &*statev.cast::<[Cell<f64>; HYPERELASTIC_STATE]>(),
            )
        };
        let mut status = status::OK;
        let sink = Umat { stress, statev, ddsdde, sse, pnewdt, f, shear: nshr, status: &mut status };
        evaluate_call(Call { source, f, fibre: None, state, tangent, sink }, Level::Avx512)?;
        Ok(status)
    };
    // SAFETY: the caller's promise.
    unsafe { entry(message, body) }
}

/// Checks the numbers of a UMAT.
///
/// # Errors
/// The first that is wrong.
#[cold]
fn check_umat(nstatv: i32, ndi: i32, nshr: i32, nlgeom: i32) -> Result<(), Error> {
    if nlgeom == 0 {
        return Err(Error::Plain(status::NO_DEFORMATION_GRADIENT));
    }
    let texts = [
        "direct stress components, NDI (solids only)",
        "shear stress components, NSHR (1 for plane strain and axisymmetric solids)",
    ];
    check_counts(ndi, nshr, &[1, 3], nstatv, texts)
}

/// `toron_abaqus_umat_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn umat_f64(
    stress: *mut f64,
    statev: *mut f64,
    sse: *mut f64,
    pnewdt: *mut f64,
    dfgrd1: *const f64,
    props: *const f64,
    nprops: i32,
    nstatv: i32,
    ndi: i32,
    nshr: i32,
    nlgeom: i32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let (ddsdde, message) = (core::ptr::null_mut(), Message { text: message, capacity });
    let tangent = StressAndState;
    // SAFETY: the caller's promise.
    unsafe {
        umat(stress, statev, ddsdde, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, message, tangent)
    }
}

/// `toron_abaqus_umat_tangent_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn umat_tangent_f64(
    stress: *mut f64,
    statev: *mut f64,
    ddsdde: *mut f64,
    sse: *mut f64,
    pnewdt: *mut f64,
    dfgrd1: *const f64,
    props: *const f64,
    nprops: i32,
    nstatv: i32,
    ndi: i32,
    nshr: i32,
    nlgeom: i32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        if ddsdde.is_null() {
            return umat_f64(
                stress, statev, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, message, capacity,
            );
        }
        let (message, tangent) = (Message { text: message, capacity }, JaumannModulus);
        umat(stress, statev, ddsdde, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, message, tangent)
    }
}

/// The sink of a UMAT: Abaqus's arrays, for which the caller answers.
struct Umat<'a> {
    stress: *mut f64,
    statev: *mut f64,
    ddsdde: *mut f64,
    sse: *mut f64,
    pnewdt: *mut f64,
    f: &'a [[f64; 3]; 3],
    shear: i32,
    status: &'a mut i32,
}

impl Umat<'_> {
    /// Stores all results except DDSDDE.
    #[inline(always)]
    fn put(self, point: &Point<f64>) {
        let [s11, s22, s33, s12, s23, s31] = point.stress;
        *self.status = point.status;
        // SAFETY: ntens entries, for ntens = 6 or 4, and as many state variables as the law has.
        unsafe {
            *self.stress.cast() = [s11, s22, s33, s12];
            if self.shear == 3 {
                *self.stress.add(4).cast() = [s31, s23];
            }
            if point.status == status::OK {
                for (c, &variable) in point.state.iter().enumerate() {
                    *self.statev.add(c) = variable;
                }
                let [w_el, w_tc, w_td, w_ld, ..] = point.state;
                let energy = ((w_el + w_tc) + w_td) + w_ld;
                let jacobian = dot(self.f[0], cross(self.f[1], self.f[2]));
                // A point that has failed before may have any F.
                let current = energy / jacobian;
                *self.sse = if jacobian > 0.0 && current.is_finite() { current } else { energy };
            } else {
                *self.pnewdt = (*self.pnewdt).min(CUTBACK);
            }
        }
    }
}

impl Sink<f64, 0> for Umat<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, _: [f64; 0]) {
        self.put(&point);
    }
}

impl Sink<f64, 21> for Umat<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, moduli: [f64; 21]) {
        let [r1, r2, r3, r4, r5, r6] = Moduli(moduli).matrix();
        let [r1, r2, r3, r4] = [abaqus_order(r1), abaqus_order(r2), abaqus_order(r3), abaqus_order(r4)];
        let [r5, r6] = [abaqus_order(r5), abaqus_order(r6)];
        // SAFETY: ntens² entries, for ntens = 6 or 4.
        unsafe {
            if self.shear == 3 {
                *self.ddsdde.cast() = [r1, r2, r3, r4, r6, r5];
            } else {
                for (k, [c1, c2, c3, c4, ..]) in [r1, r2, r3, r4].into_iter().enumerate() {
                    *self.ddsdde.cast::<[f64; 4]>().add(k) = [c1, c2, c3, c4];
                }
            }
        }
        self.put(&point);
    }
}

/// 11 22 33 12 13 23 of 11 22 33 12 23 31.
#[inline(always)]
fn abaqus_order([c11, c22, c33, c12, c23, c31]: [f64; 6]) -> [f64; 6] {
    [c11, c22, c33, c12, c31, c23]
}

/// The arguments of a VUMAT that the law uses, stored as in Abaqus: arrays are (nblock, components), column-major.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Vumat<T> {
    /// The size of this structure.
    pub size: size_t,
    /// Numbers of points, of direct components (3), of shear components (3), of state variables (≥ 11) and of properties
    /// (11).
    pub nblock: i32,
    pub ndir: i32,
    pub nshr: i32,
    pub nstatev: i32,
    pub nprops: i32,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`; 0: the best.
    pub level: i32,
    /// If both are 0, this is Abaqus's data check, and an elastic stress for `strain_inc` is returned.
    pub step_time: f64,
    pub total_time: f64,
    /// In: properties, nprops.
    pub props: *const T,
    /// In, 1: current density at the middle of the step.
    pub density: *const T,
    /// In, 6: increment of strain, tensor components; read in the data check only.
    pub strain_inc: *const T,
    /// In, 6 components each: the right stretch U at the start and at the end of the increment, 11 22 33 12 23 31.
    pub stretch_old: *const T,
    pub stretch_new: *const T,
    /// In, with 6, nstatev, 1 and 1 components.
    pub stress_old: *const T,
    pub state_old: *const T,
    pub ener_intern_old: *const T,
    pub ener_inelas_old: *const T,
    /// Out, with 6, nstatev, 1 and 1 components.
    pub stress_new: *mut T,
    pub state_new: *mut T,
    pub ener_intern_new: *mut T,
    pub ener_inelas_new: *mut T,
}

structures! { Vumat, "toron_vumat_f64", "toron_vumat_f32", "block"; }

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<Vumat<f64>>() == 6 * 8 + 13 * 8 && size_of::<Vumat<f32>>() == size_of::<Vumat<f64>>());

/// Component `c` of point `i` in an array of a VUMAT.
macro_rules! at {
    ($array:expr, $block:expr, $c:expr, $i:expr) => {
        *$array.add($c * $block.nblock as usize + $i)
    };
}

/// # Safety
/// As for `toron_abaqus_vumat_f64`.
unsafe fn vumat<T: Precision>(block: *const Vumat<T>) -> Result<i32, Error> {
    let mut room = MaybeUninit::uninit();
    // SAFETY: the caller's promise.
    let block = unsafe { read(block, &mut room) }?;
    check_pointers(&[
        (block.props, "props"),
        (block.density, "density"),
        (block.strain_inc, "strain_inc"),
        (block.stretch_old, "stretch_old"),
        (block.stretch_new, "stretch_new"),
        (block.stress_old, "stress_old"),
        (block.state_old, "state_old"),
        (block.ener_intern_old, "ener_intern_old"),
        (block.ener_inelas_old, "ener_inelas_old"),
        (block.stress_new, "stress_new"),
        (block.state_new, "state_new"),
        (block.ener_intern_new, "ener_intern_new"),
        (block.ener_inelas_new, "ener_inelas_new"),
    ])?;
    let texts = ["direct stress components, NDIR (solids only)", "shear stress components, NSHR (solids only)"];
    check_counts(block.ndir, block.nshr, &[3], block.nstatev, texts)?;
    let Ok(n) = usize::try_from(block.nblock) else {
        let (code, value) = (status::BAD_COUNT, i64::from(block.nblock));
        return Err(Error::Range { code, name: "nblock", value, least: 0, greatest: i64::MAX });
    };
    let level = level(block.level)?;
    let count = property_count(block.nprops)?;
    // SAFETY: not null, and the caller's promise.
    let law = Hyperelastic::new(unsafe { properties(block.props, count, &parameters::HYPERELASTIC) }?)?;
    // SAFETY: the caller's promise, from here on.
    unsafe {
        for i in 0..n {
            // State variables beyond those of the law are copied, and so is the inelastic energy, to which the law adds
            // nothing.
            for c in HYPERELASTIC_STATE..block.nstatev as usize {
                at!(block.state_new, block, c, i) = at!(block.state_old, block, c, i);
            }
            *block.ener_inelas_new.add(i) = *block.ener_inelas_old.add(i);
        }
        if block.step_time == 0.0 && block.total_time == 0.0 {
            elastic_check(&law, block, n);
            return Ok(status::OK);
        }
        stretched(&law, block, n, level)
    }
}

/// The data check: before there is any deformation, Abaqus determines the elastic wave speed from the stress due to fictitious
/// strains. It gets that of an isotropic solid whose longitudinal wave speed is that of the fibre, since the law itself has no
/// transverse stiffness at rest.
///
/// # Safety
/// As for [`vumat`], with `n` points.
unsafe fn elastic_check<T: Precision>(law: &Hyperelastic<T>, block: &Vumat<T>, n: usize) {
    let [bulk, shear] = law.bulk_and_shear();
    let two_g = T::splat(2.0) * shear;
    let lame = bulk - two_g * T::splat(1.0 / 3.0);
    // SAFETY: the caller's promise.
    unsafe {
        for i in 0..n {
            let strain = |c: usize| at!(block.strain_inc, block, c, i);
            let volumetric = lame * (strain(0) + strain(1) + strain(2));
            for c in 0..6 {
                let isotropic = if c < 3 { volumetric } else { T::splat(0.0) };
                at!(block.stress_new, block, c, i) =
                    at!(block.stress_old, block, c, i) + two_g.mul_add(strain(c), isotropic);
            }
            for c in 0..ALIVE {
                at!(block.state_new, block, c, i) = at!(block.state_old, block, c, i);
            }
            at!(block.state_new, block, ALIVE, i) = T::splat(1.0) - at!(block.state_old, block, FAILED, i);
            *block.ener_intern_new.add(i) = *block.ener_intern_old.add(i);
        }
    }
}

/// Evaluates the law at F = U, whose stress is RᵀσR.
///
/// # Safety
/// As for [`vumat`], with `n` points.
unsafe fn stretched<T: Precision>(
    law: &Hyperelastic<T>,
    block: &Vumat<T>,
    n: usize,
    level: Option<Level>,
) -> Result<i32, Error> {
    const CHUNK: usize = 64;
    let mut worst = status::OK;
    let mut start = 0;
    while start < n {
        let mut codes = [status::OK; CHUNK];
        let row = |c: usize| c.wrapping_mul(n).wrapping_add(start);
        let [u11, u22, u33, u12, u23, u31] = components(block.stretch_new.wrapping_add(start), n);
        let pointers = Pointers {
            deformation_gradient: [u11, u12, u31, u12, u22, u23, u31, u23, u33],
            energies_old: block.state_old.wrapping_add(row(ENERGIES)),
            invariants_old: block.state_old.wrapping_add(row(INVARIANTS)),
            failure_old: block.state_old.wrapping_add(row(FAILURE_INDEX)),
            stress: components_mut(block.stress_new.wrapping_add(start), n),
            energies: block.state_new.wrapping_add(row(ENERGIES)),
            invariants: block.state_new.wrapping_add(row(INVARIANTS)),
            failure: block.state_new.wrapping_add(row(FAILURE_INDEX)),
            status: codes.as_mut_ptr(),
            level,
            ..Pointers::without_arrays(CHUNK.min(n - start), n)
        };
        // SAFETY: the caller's promise; the arrays are those of n points from `start` on.
        worst = worst.min(unsafe { law.raw_block(&pointers) }?);
        for (i, &code) in (start..n).zip(&codes) {
            // SAFETY: i < n.
            unsafe { finish(block, i, code) };
        }
        start += CHUNK;
    }
    Ok(worst)
}

/// Deletes a point that could not be evaluated, and writes its energy per mass, W/ρ0. The density that Abaqus passes is
/// the current one at the middle of the step.
///
/// # Safety
/// As for [`vumat`], for a point i < nblock whose new state is written.
unsafe fn finish<T: Real<Mask = bool>>(block: &Vumat<T>, i: usize, code: i32) {
    let (zero, half, one) = (T::splat(0.0), T::splat(0.5), T::splat(1.0));
    // SAFETY: the caller's promise.
    unsafe {
        if code != status::OK {
            at!(block.state_new, block, FAILED, i) = one;
            at!(block.state_new, block, ALIVE, i) = zero;
        }
        let u = |c: usize| half * (at!(block.stretch_old, block, c, i) + at!(block.stretch_new, block, c, i));
        let volume = u(0) * (u(1) * u(2) - u(4) * u(4)) - u(3) * (u(3) * u(2) - u(4) * u(5))
            + u(5) * (u(3) * u(4) - u(1) * u(5));
        let w = |c: usize| at!(block.state_new, block, c, i);
        let energy = (w(0) + w(1) + w(2) + w(3)) / (*block.density.add(i) * volume);
        // If the deformation or the density is invalid, the energy keeps its old value.
        let known = zero.lt(volume) && (energy * zero).le(zero);
        *block.ener_intern_new.add(i) = if known { energy } else { *block.ener_intern_old.add(i) };
    }
}

/// `toron_abaqus_vumat_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn vumat_f64(block: *const Vumat<f64>, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || vumat(block)) }
}

/// `toron_abaqus_vumat_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn vumat_f32(block: *const Vumat<f32>, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { entry(Message { text: message, capacity }, move || vumat(block)) }
}
