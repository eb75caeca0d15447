//! The hyperelastic law at one point, with or without a tangent, and its least stable wave.

use core::cell::Cell;
use core::mem::MaybeUninit;

use super::arguments::{check_density, level, measure};
use super::constants::TORON_LEVEL_BEST;
use super::entry_points::store;
use super::point_and_block::Point;
use super::structures::read;
use crate::law::derivative::{NineByNine, NoTangent, SixBySix, Stress};
use crate::law::error::Error;
use crate::law::number::level::Level;
use crate::law::number::real::Real;
use crate::law::number::registers::Registers;
use crate::law::own::Own;
use crate::law::point::{Call, Sink, Source, cells, evaluate_call};
use crate::law::prepared::PreparedHyperelastic;
use crate::law::response;
use crate::law::state::HYPERELASTIC_STATE;
use crate::law::status;
use crate::law::tangent::Measure;

/// The sink for the stress alone, or with the new state.
struct StressAnswer<'a, T, const STATE: bool> {
    stress: *mut T,
    state: *mut T,
    status: &'a mut i32,
}

impl<T: Real, const STATE: bool> Sink<T, 0> for StressAnswer<'_, T, STATE> {
    #[inline(always)]
    fn take(self, point: response::Point<T>, _: Option<T>, _: [T; 0]) {
        *self.status = point.status;
        // SAFETY: `hyperelastic_point` has found the arrays that are written not to be null; they have the values of one
        // point.
        unsafe {
            *self.stress.cast() = point.stress;
            if STATE {
                *self.state.cast() = point.state;
            }
        }
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
pub unsafe fn hyperelastic_point<T: Registers, L: Source<T>>(law: L, point: *const Point<T>) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null, and `motion` an F that is; how long the arrays are the C caller promises.
    let (point, (f, fibre)) = unsafe {
        let point = read(point, &mut buffer)?;
        (point, point.motion()?)
    };
    let level = match point.level {
        TORON_LEVEL_BEST => Level::Avx512,
        other => level(other)?.unwrap_or(Level::Avx512),
    };
    let Point { state_old, state_new, stress, wave_speed, tangent, .. } = *point;
    let mut fresh = MaybeUninit::uninit();
    // SAFETY: null or the values of one point; in cells, since the new state may replace them.
    let state = match unsafe { state_old.cast::<[Cell<T>; HYPERELASTIC_STATE]>().as_ref() } {
        Some(state) => state,
        None => fresh.write(cells([T::splat(0.0); HYPERELASTIC_STATE])),
    };
    let mut status = status::OK;
    if point.is_usual() {
        // What most callers want is compiled for them.
        if state_new.is_null() {
            let sink = StressAnswer::<T, false> { stress, state: state_new, status: &mut status };
            evaluate_call(
                Call { source: law, f, own: Own::along(fibre), state, tangent: Stress::<false>, sink },
                level,
            )?;
        } else {
            // SAFETY: the caller's point.
            let own = unsafe { point.own(fibre) };
            let sink = StressAnswer::<T, true> { stress, state: state_new, status: &mut status };
            evaluate_call(Call { source: law, f, own, state, tangent: Stress::<true>, sink }, level)?;
        }
        return Ok(status);
    }
    check_density::<T>(point.density, !wave_speed.is_null())?;
    let request = point.request();
    // SAFETY: as above.
    let own = unsafe { point.own(fibre) };
    let sink = point.answer(&mut status);
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
        let (f, fibre) = read(point, &mut buffer)?.motion()?;
        if least.is_null() {
            return Err(Error::Null { name: "least" });
        }
        let wave = law.law().acoustic(f, fibre).map_err(Error::Plain)?.least();
        store(&[wave.modulus], least);
        store(&wave.direction, direction);
    }
    Ok(status::OK)
}
