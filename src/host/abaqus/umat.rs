//! The UMAT of Abaqus/Standard: of any law, and that of the hyperelastic law by its kernels of one point.

use core::cell::Cell;
use core::slice;

use libc::{c_char, size_t};

use super::{UMAT_COUNTS, check_counts, property_count};
use crate::host::border::{Message, check_plane, check_pointers, entry, properties};
use crate::law::block::{components, components_mut};
use crate::law::derivative::{Derivative, JaumannModulus, Stress};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::{Law, Points};
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::level::Level;
use crate::law::number::vector::{cross, dot};
use crate::law::parameters;
use crate::law::point::{Call, Point, Sink, evaluate_call};
use crate::law::state::HYPERELASTIC_STATE;
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::user::{User, UserMaterial};
use crate::law::voigt::Moduli;

/// The value that PNEWDT is lowered to if a point cannot be evaluated.
const CUTBACK: f64 = 0.25;

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
    for<'a> &'a Umat<'a>: Sink<f64, N>,
{
    let usual = (ndi ^ 3) | (nshr ^ 3) | (nprops ^ parameters::HYPERELASTIC_PROPERTIES as i32) == 0;
    let usual = usual && nstatv >= HYPERELASTIC_STATE as i32 && nlgeom != 0;
    let missing = stress.is_null() || statev.is_null() || sse.is_null() || pnewdt.is_null();
    if !usual || missing || dfgrd1.is_null() || props.is_null() {
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
                check_umat(nstatv, ndi, nshr, nlgeom, HYPERELASTIC_STATE)?;
                let properties =
                    properties(props, property_count(nprops, &parameters::HYPERELASTIC)?, &parameters::HYPERELASTIC)?;
                if nshr == 1 {
                    check_plane(&Hyperelastic::new(properties)?, properties)?;
                }
                Ok(status::OK)
            })
        };
        if code != status::OK {
            return code;
        }
    }
    let status = Cell::new(status::OK);
    let arguments = Umat { stress, statev, ddsdde, sse, pnewdt, dfgrd1, shear: nshr, status: &status };
    let sink = &arguments;
    let body = move || {
        // SAFETY: not null, and the caller's promise.
        let (source, f, state) = unsafe {
            (
                slice::from_raw_parts(props, parameters::HYPERELASTIC_PROPERTIES),
                &*sink.dfgrd1.cast::<[[f64; 3]; 3]>(),
                &*sink.statev.cast::<[Cell<f64>; HYPERELASTIC_STATE]>(),
            )
        };
        evaluate_call(Call { source, f, fibre: None, state, tangent, sink }, Level::Avx512)?;
        Ok(sink.status.get())
    };
    // SAFETY: the caller's promise.
    unsafe { entry(message, body) }
}

/// Checks the numbers of a UMAT.
///
/// # Errors
/// The first that is wrong.
#[cold]
fn check_umat(nstatv: i32, ndi: i32, nshr: i32, nlgeom: i32, state: usize) -> Result<(), Error> {
    if nlgeom == 0 {
        let text = "there is no deformation gradient: the step is geometrically linear, give *STEP, NLGEOM=YES";
        return Err(Error::Setting { code: status::NO_DEFORMATION_GRADIENT, text });
    }
    check_counts(ndi, nshr, UMAT_COUNTS, nstatv, state)
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
    let tangent = Stress::<true>;
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

/// The arrays of a UMAT, for which the caller answers, as a sink: by reference, so that only its address is passed down.
struct Umat<'a> {
    stress: *mut f64,
    statev: *mut f64,
    ddsdde: *mut f64,
    sse: *mut f64,
    pnewdt: *mut f64,
    dfgrd1: *const f64,
    shear: i32,
    status: &'a Cell<i32>,
}

impl Umat<'_> {
    /// Stores all results except DDSDDE.
    #[inline(always)]
    fn put(&self, point: &Point<f64>, inverse_jacobian: Option<f64>) {
        let [s11, s22, s33, s12, s23, s31] = point.stress;
        // SAFETY: ntens entries, for ntens = 6 or 4, and as many state variables as the law has.
        unsafe {
            *self.stress.cast() = [s11, s22, s33, s12];
            if self.shear == 3 {
                *self.stress.add(4).cast() = [s31, s23];
            }
            let Some(inverse_jacobian) = inverse_jacobian else { return self.keep(point) };
            // The sum of the energies of a point that can be evaluated fits the number format; a check here took 6 % of the call.
            let energy = sum_of_energies(point);
            let current = energy * inverse_jacobian;
            *self.statev.cast() = point.state;
            *self.sse = if current < f64::INFINITY { current } else { energy };
        }
    }

    /// Stores the state and the energy of a point that may have failed before, with an F and old energies that mean nothing, and the
    /// status of one that cannot be evaluated.
    #[cold]
    #[inline(never)]
    fn keep(&self, point: &Point<f64>) {
        let energy = sum_of_energies(point);
        let fits = point.status != status::OK || energy.is_finite();
        self.status.set(if fits { point.status } else { status::OVERFLOW });
        // SAFETY: as many state variables as the law has; nine entries of F.
        unsafe {
            if self.status.get() == status::OK {
                *self.statev.cast() = point.state;
                *self.sse = current_density(energy, determinant(&*self.dfgrd1.cast()));
            } else {
                *self.pnewdt = (*self.pnewdt).min(CUTBACK);
            }
        }
    }
}

/// The energy per reference volume.
#[inline(always)]
fn sum_of_energies(point: &Point<f64>) -> f64 {
    let [w_el, w_tc, w_td, w_ld, ..] = point.state;
    ((w_el + w_tc) + w_td) + w_ld
}

impl Sink<f64, 0> for &Umat<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, inverse_jacobian: Option<f64>, _: [f64; 0]) {
        self.put(&point, inverse_jacobian);
    }
}

impl Sink<f64, 21> for &Umat<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, inverse_jacobian: Option<f64>, moduli: [f64; 21]) {
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
        self.put(&point, inverse_jacobian);
    }
}

/// 11 22 33 12 13 23 of 11 22 33 12 23 31.
#[inline(always)]
fn abaqus_order([c11, c22, c33, c12, c23, c31]: [f64; 6]) -> [f64; 6] {
    [c11, c22, c33, c12, c31, c23]
}

/// The determinant of F, given by columns.
#[inline(always)]
fn determinant(f: &[[f64; 3]; 3]) -> f64 {
    dot(f[0], cross(f[1], f[2]))
}

/// An energy per reference volume as one per current volume, W/J. A point that has failed before may have any F.
#[inline(always)]
fn current_density(energy: f64, jacobian: f64) -> f64 {
    let current = energy / jacobian;
    if jacobian > 0.0 && current.is_finite() { current } else { energy }
}

/// The UMAT of a law by its step at one point, with DDSDDE unless that is null. Returns the status code.
///
/// # Errors
/// The first argument that is wrong.
///
/// # Safety
/// As documented for `toron_abaqus_linear_umat_f64` in package `toron-c`.
#[allow(clippy::too_many_arguments)]
unsafe fn step<L: Law<f64>>(
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
) -> Result<i32, Error> {
    check_pointers(&[
        (stress.cast_const(), "stress"),
        (statev, "statev"),
        (sse, "sse"),
        (pnewdt, "pnewdt"),
        (dfgrd0, "dfgrd0"),
        (dfgrd1, "dfgrd1"),
        (props, "props"),
    ])?;
    let table = L::DESCRIPTION.properties;
    check_umat(nstatv, ndi, nshr, nlgeom, L::DESCRIPTION.state.len())?;
    // SAFETY: the caller's promise, here and below.
    let values = unsafe { properties(props, property_count(nprops, table)?, table) }?;
    let law = L::new(values)?;
    if nshr == 1 {
        check_plane(&law, values)?;
    }
    let (mut sigma, mut state, mut tangent) = ([0.0; 6], L::fresh(), [[0.0; 6]; 6]);
    let wanted = !ddsdde.is_null();
    let point = Points {
        f_old: components(dfgrd0, 1),
        f_new: components(dfgrd1, 1),
        state_old: statev.cast_const(),
        state_new: state.as_mut().as_mut_ptr(),
        stress: components_mut(sigma.as_mut_ptr(), 1),
        tangent: if wanted { tangent.as_mut_ptr().cast() } else { core::ptr::null_mut() },
        measure: Measure::Jaumann,
        ..Points::without_arrays(1, 1)
    };
    let code = unsafe { law.step(&point) }?;
    let components = if nshr == 3 { 6 } else { 4 };
    unsafe {
        for (to, from) in (0..components).zip(IN_ABAQUS) {
            *stress.add(to) = component(&sigma, from);
        }
        if wanted {
            for (column, from) in (0..components).zip(IN_ABAQUS) {
                for (row, entries) in (0..components).zip(IN_ABAQUS.map(|row| tangent.get(row))) {
                    *ddsdde.add(components * column + row) = entries.map_or(0.0, |row| component(row, from));
                }
            }
        }
        if code == status::OK {
            *statev.cast() = state;
            *sse = current_density(L::DESCRIPTION.energy(state.as_ref()), determinant(&*dfgrd1.cast()));
        } else {
            *pnewdt = (*pnewdt).min(CUTBACK);
        }
    }
    Ok(code)
}

/// The UMAT of a law by its step.
///
/// # Safety
/// As documented for `toron_abaqus_linear_umat_f64` in package `toron-c`.
#[allow(clippy::too_many_arguments)]
#[inline(always)]
unsafe fn of_law<L: Law<f64>>(
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
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        entry(Message { text: message, capacity }, move || {
            step::<L>(stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom)
        })
    }
}

/// A law as a UMAT of Abaqus/Standard.
pub trait StandardLaw: Law<f64> {
    /// The UMAT, with the arguments of `toron_abaqus_linear_umat_f64` in package `toron-c`, of which `dfgrd0` is read where the law's
    /// description says so, and `ddsdde` may be null. Returns the status code.
    ///
    /// # Safety
    /// As documented there, with as many properties and state variables as the law has.
    #[allow(clippy::too_many_arguments)]
    #[inline(never)]
    unsafe fn umat(
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
        message: *mut c_char,
        capacity: size_t,
    ) -> i32 {
        // SAFETY: the caller's promise.
        unsafe {
            of_law::<Self>(
                stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, message,
                capacity,
            )
        }
    }
}

impl<M: UserMaterial> StandardLaw for User<M, f64> {}

impl StandardLaw for Hyperelastic<f64> {
    #[inline(always)]
    unsafe fn umat(
        stress: *mut f64,
        statev: *mut f64,
        ddsdde: *mut f64,
        sse: *mut f64,
        pnewdt: *mut f64,
        _dfgrd0: *const f64,
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
            umat_tangent_f64(
                stress, statev, ddsdde, sse, pnewdt, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, message,
                capacity,
            )
        }
    }
}

impl StandardLaw for LinearElastic<f64> {
    #[inline(always)]
    unsafe fn umat(
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
        message: *mut c_char,
        capacity: size_t,
    ) -> i32 {
        // SAFETY: the caller's promise.
        unsafe {
            linear_umat_f64(
                stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, message,
                capacity,
            )
        }
    }
}

/// `toron_abaqus_linear_umat_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn linear_umat_f64(
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
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        of_law::<LinearElastic>(
            stress, statev, ddsdde, sse, pnewdt, dfgrd0, dfgrd1, props, nprops, nstatv, ndi, nshr, nlgeom, message,
            capacity,
        )
    }
}

/// The law's components 11 22 33 12 23 31 in Abaqus's order.
const IN_ABAQUS: [usize; 6] = [0, 1, 2, 3, 5, 4];

fn component(values: &[f64; 6], place: usize) -> f64 {
    values.get(place).copied().unwrap_or_default()
}
