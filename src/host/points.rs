//! The hyperelastic law at one point, with or without a tangent, and its least stable wave.

use core::cell::Cell;
use core::mem::MaybeUninit;
use core::ptr::null_mut;

use libc::size_t;

use super::arguments::{check_density, level, measure, measure_of};
use super::constants::TORON_LEVEL_BEST;
use super::entry_points::store;
use super::structures::{read, structures};
use crate::law::block::{Points, components, components_mut};
use crate::law::derivative::{NineByNine, NoTangent, SixBySix, Stress};
use crate::law::error::Error;
use crate::law::number::level::Level;
use crate::law::number::real::{Real, Scalar};
use crate::law::number::registers::Registers;
use crate::law::point::{self, Call, Own, Sink, Source, cells, evaluate_call};
use crate::law::prepared::PreparedHyperelastic;
use crate::law::response::Request;
use crate::law::state::HYPERELASTIC_STATE;
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::voigt::Moduli;
use crate::law::wave_speed;

/// A point of the hyperelastic law or of the law with friction. Set `size`, and what is wanted; the rest is 0: an array
/// that is null is left out, and an output that is left out is not computed. The arrays of the old and the new state
/// may be the same.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Point<T> {
    /// The size of this structure.
    pub size: size_t,
    /// In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
    pub measure: i32,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best one below it.
    pub level: i32,
    /// In: reference density; read if `wave_speed` is not null.
    pub density: f64,
    /// In, 9: F by columns. Must not be null.
    pub deformation_gradient: *const T,
    /// In, 3: the fibre direction, of any length; if null, that of the properties.
    pub fibre: *const T,
    /// In, 11 (15 of the law with friction): the old state; if null, all 0.
    pub state_old: *const T,
    /// Out, as many: the new state. If null, the point does not fail, but stays failed if its old state has the flag
    /// set.
    pub state_new: *mut T,
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: *mut T,
    /// Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
    pub modes: *mut T,
    /// Out, 1: an upper bound of the wave speed, to be used with current element lengths; never below the speed along a
    /// fibre at rest. It is meant for the stable time step; a bulk viscosity computed with it damps more than with the
    /// exact speed.
    pub wave_speed: *mut T,
    /// Out, 36 (81 for `TORON_TANGENT_NOMINAL`): the tangent, entry (row, column), counted from 0, at 6 row + column (9
    /// row + column); a symmetric matrix, but where the fibres of the law with friction slide. Rows and columns are in
    /// the order 11 22 33 12 23 31, with derivatives with respect to engineering shears; for `TORON_TANGENT_NOMINAL` 11
    /// 21 31 12 22 32 13 23 33.
    ///
    /// The call that detects failure returns that of the intact material, later calls return zeros. At a kink (I_el = 0
    /// or I_tc = 0) it is that of loading.
    pub tangent: *mut T,
    /// In, 1: the true fibre strain at failure, ln(1 + eps_lim), in place of that of the properties; if null or 0, that
    /// of the properties. Read if `state_new` is not null.
    pub limit: *const T,
}

structures! { Point, "toron_point_f64", "toron_point_f32", "point"; }

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<Point<f64>>() == 3 * 8 + 9 * 8 && size_of::<Point<f32>>() == size_of::<Point<f64>>());

/// The sink for one point: the caller's arrays, those for a tangent included. What is null is not stored, except that
/// `tangent` must not be null if there is a tangent. Who makes one promises that the others have the values of one
/// point: 6, 11, 4 × 6, 1, and those of the tangent's measure, 36 or 81.
pub(in crate::host) struct PointAnswer<'a, T> {
    pub stress: *mut T,
    pub state: *mut T,
    pub modes: *mut T,
    pub density: T,
    pub wave_speed: *mut T,
    pub tangent: *mut T,
    pub status: &'a mut i32,
}

impl<'a, T: Real> PointAnswer<'a, T> {
    /// The status alone.
    #[inline(always)]
    pub fn nothing(status: &'a mut i32) -> Self {
        PointAnswer {
            stress: null_mut(),
            state: null_mut(),
            modes: null_mut(),
            density: T::splat(1.0),
            wave_speed: null_mut(),
            tangent: null_mut(),
            status,
        }
    }

    #[inline(always)]
    fn put(self, point: &point::Point<T>) {
        *self.status = point.status;
        // SAFETY: each array is null or has as many values as `PointAnswer` says.
        unsafe {
            store(&point.state, self.state);
            store(&point.stress, self.stress);
            if !self.modes.is_null() {
                *self.modes.cast() = point.modes;
            }
            if !self.wave_speed.is_null() {
                *self.wave_speed = wave_speed::wave_speed(point.wave_modulus, self.density);
            }
        }
    }
}

impl<T: Real> Sink<T, 0> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: point::Point<T>, _: Option<T>, _: [T; 0]) {
        self.put(&point);
    }
}

impl<T: Real> Sink<T, 21> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: point::Point<T>, _: Option<T>, moduli: [T; 21]) {
        // SAFETY: 36 values, which `PointAnswer` promises for this tangent.
        unsafe { *self.tangent.cast() = Moduli(moduli).matrix() };
        self.put(&point);
    }
}

impl<T: Real> Sink<T, 81> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: point::Point<T>, _: Option<T>, nominal: [T; 81]) {
        // SAFETY: 81 values, which `PointAnswer` promises for this tangent.
        unsafe { *self.tangent.cast() = nominal };
        self.put(&point);
    }
}

/// The columns of F, and the fibre direction or `None` for that of the properties.
type Motion<'a, T> = (&'a [[T; 3]; 3], Option<[T; 3]>);

/// F and the fibre direction of a point.
///
/// # Errors
/// F is null.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(always)]
unsafe fn motion<'a, T: Real>(point: &Point<T>) -> Result<Motion<'a, T>, Error> {
    // SAFETY: F is null or nine values, and so is the fibre with three.
    unsafe {
        let f = point.deformation_gradient.cast::<[[T; 3]; 3]>().as_ref();
        let fibre = if point.fibre.is_null() { None } else { Some(*point.fibre.cast::<[T; 3]>()) };
        Ok((f.ok_or(Error::Null { name: "deformation_gradient" })?, fibre))
    }
}

/// A point's own limit, where it is read: beside a new state. It is looked up where it is passed on: read with the
/// other arrays, it would cost all calls a register.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(always)]
unsafe fn limit<'a, T>(point: &Point<T>) -> Option<&'a T> {
    // SAFETY: null or one number, if there is a new state.
    if point.state_new.is_null() { None } else { unsafe { point.limit.as_ref() } }
}

/// The sink for the stress alone, or with the new state.
struct StressAnswer<'a, T, const STATE: bool> {
    stress: *mut T,
    state: *mut T,
    status: &'a mut i32,
}

impl<T: Real, const STATE: bool> Sink<T, 0> for StressAnswer<'_, T, STATE> {
    #[inline(always)]
    fn take(self, point: point::Point<T>, _: Option<T>, _: [T; 0]) {
        *self.status = point.status;
        // SAFETY: `evaluate` has found the arrays that are written not to be null; they have the values of one point.
        unsafe {
            *self.stress.cast() = point.stress;
            if STATE {
                *self.state.cast() = point.state;
            }
        }
    }
}

impl<T> Point<T> {
    /// The results that have an array.
    #[inline(always)]
    fn request(&self) -> Request {
        let kept = !self.state_new.is_null();
        Request {
            stress: !self.stress.is_null(),
            energies: kept,
            invariants: kept,
            failure: kept,
            modes: !self.modes.is_null(),
            wave_modulus: !self.wave_speed.is_null(),
        }
    }
}

impl<T: Scalar> Point<T> {
    /// Calls `evaluate` with the point as a block of one, without its state: a structure of 500 bytes, which is not
    /// returned, since the processor would wait for each copy of it.
    ///
    /// # Errors
    /// An argument is wrong, or what `evaluate` finds.
    #[inline(always)]
    pub(super) fn as_points(&self, evaluate: impl FnOnce(Points<T>) -> Result<i32, Error>) -> Result<i32, Error> {
        let level = level(self.level)?;
        check_density::<T>(self.density, !self.wave_speed.is_null())?;
        let measure = measure_of(self.tangent, self.measure)?;
        evaluate(Points {
            f_new: components(self.deformation_gradient, 1),
            fibre: components(self.fibre, 1),
            limit: self.limit,
            density: T::splat(self.density),
            stress: components_mut(self.stress, 1),
            modes: self.modes,
            wave_speed: self.wave_speed,
            tangent: self.tangent,
            measure,
            level,
            ..Points::without_arrays(1, 1)
        })
    }
}

/// Evaluates the law, prepared or as its properties, at one point, from and to a caller's arrays. Returns its status.
///
/// # Errors
/// A property or an argument is wrong, and nothing is written.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(always)]
pub unsafe fn evaluate<T: Registers, L: Source<T>>(law: L, point: *const Point<T>) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null, and `motion` an F that is; how long the arrays are the C caller promises.
    let (point, (f, fibre)) = unsafe {
        let point = read(point, &mut buffer)?;
        (point, motion(point)?)
    };
    let level = match point.level {
        TORON_LEVEL_BEST => Level::Avx512,
        other => level(other)?.unwrap_or(Level::Avx512),
    };
    let Point { state_old, state_new, stress, modes, wave_speed, tangent, .. } = *point;
    let mut fresh = MaybeUninit::uninit();
    // SAFETY: null or the values of one point; in cells, since the new state may replace them.
    let state = match unsafe { state_old.cast::<[Cell<T>; HYPERELASTIC_STATE]>().as_ref() } {
        Some(state) => state,
        None => fresh.write(cells([T::splat(0.0); HYPERELASTIC_STATE])),
    };
    let mut status = status::OK;
    let nothing_else = modes.is_null() && wave_speed.is_null() && tangent.is_null();
    if nothing_else && !stress.is_null() {
        // What most callers want is compiled for them.
        if state_new.is_null() {
            let sink = StressAnswer::<T, false> { stress, state: state_new, status: &mut status };
            evaluate_call(
                Call { source: law, f, own: Own::along(fibre), state, tangent: Stress::<false>, sink },
                level,
            )?;
        } else {
            // SAFETY: the caller's point.
            let own = Own { fibre, limit: unsafe { limit(point) } };
            let sink = StressAnswer::<T, true> { stress, state: state_new, status: &mut status };
            evaluate_call(Call { source: law, f, own, state, tangent: Stress::<true>, sink }, level)?;
        }
        return Ok(status);
    }
    check_density::<T>(point.density, !wave_speed.is_null())?;
    let density = T::splat(point.density);
    let request = point.request();
    // SAFETY: as above.
    let own = Own { fibre, limit: unsafe { limit(point) } };
    let sink = PointAnswer { stress, state: state_new, modes, density, wave_speed, tangent, status: &mut status };
    if tangent.is_null() {
        evaluate_call(Call { source: law, f, own, state, tangent: NoTangent(request), sink }, level)?;
        return Ok(status);
    }
    match measure(point.measure)? {
        Measure::Nominal => {
            evaluate_call(Call { source: law, f, own, state, tangent: NineByNine(request), sink }, level)?;
        }
        measure => {
            evaluate_call(Call { source: law, f, own, state, tangent: SixBySix(request, measure), sink }, level)?;
        }
    }
    Ok(status)
}

/// The smallest eigenvalue of the acoustic tensor at a point's F and fibre, to `least`, and the normal of its wave, to
/// `direction`. Returns 0.
///
/// # Errors
/// F cannot be evaluated, or something is null that must not be, and nothing is written.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn least_acoustic_eigenvalue(
    law: &PreparedHyperelastic<f64>,
    point: *const Point<f64>,
    least: *mut f64,
    direction: *mut f64,
) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` and `motion` refuse null, `least` is checked, and `store` passes over a direction that is null.
    unsafe {
        let (f, fibre) = motion(read(point, &mut buffer)?)?;
        if least.is_null() {
            return Err(Error::Null { name: "least" });
        }
        let wave = law.law().acoustic(f, fibre).map_err(Error::Plain)?.least();
        store(&[wave.modulus], least);
        store(&wave.direction, direction);
    }
    Ok(status::OK)
}
