//! The hyperelastic law: its properties, and one point.

use core::cell::Cell;

use libc::{c_char, size_t};

use crate::host::environment::in_default_environment;
use crate::law::derivative::{NoTangent, StressAndState};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::number::real::Real;
use crate::law::number::registers::Registers;
use crate::law::parameters;
use crate::law::point::{Call, Point, Sink, cells, evaluate_call};
use crate::law::response::Request;
use crate::law::state;
use crate::law::status;
use crate::law::voigt::Moduli;
use crate::law::wave_speed;

use crate::host::border::write_text;
use crate::host::border::{entry, properties, store};

/// # Safety
/// As for `toron_hyperelastic_validate_f64`.
unsafe fn validate<T: Real + Into<f64>>(
    values: *const T,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    let values = unsafe { properties(values, count, &parameters::HYPERELASTIC) };
    let error = values.and_then(Hyperelastic::new).err();
    // SAFETY: the caller's promise.
    unsafe {
        store(&[error.map_or(status::OK, |error| error.code())], status);
        write_text(message, capacity, |sink| {
            if let Some(error) = error {
                error.describe(sink);
            }
        })
    }
}

/// `toron_hyperelastic_validate_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_validate_f64(
    values: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    in_default_environment(move || unsafe { validate(values, count, message, capacity, status) })
}

/// `toron_hyperelastic_validate_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_validate_f32(
    values: *const f32,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    in_default_environment(move || unsafe { validate(values, count, message, capacity, status) })
}

/// The arguments of a call for one point besides its properties: F by columns, the fibre direction unless it is that of the
/// properties, and the old state, which the new one may overwrite.
pub(super) struct PointArguments<'a, T> {
    pub f: &'a [[T; 3]; 3],
    pub fibre: Option<[T; 3]>,
    pub state: &'a [Cell<T>; state::HYPERELASTIC_STATE],
}

impl<'a, T: Real> PointArguments<'a, T> {
    /// From the caller's pointers, with `fresh` in place of an old state that is null.
    ///
    /// # Safety
    /// The pointers are null or point to 9, 3 and 11 values.
    #[inline(always)]
    pub unsafe fn new(
        deformation_gradient: *const T,
        fibre: *const T,
        state_old: *const T,
        fresh: &'a [Cell<T>; state::HYPERELASTIC_STATE],
    ) -> Result<Self, Error> {
        // SAFETY: the caller's promise.
        unsafe {
            let f = deformation_gradient.cast::<[[T; 3]; 3]>().as_ref().ok_or(Error::Plain(status::NULL_ARGUMENT))?;
            let fibre = if fibre.is_null() { None } else { Some(*fibre.cast::<[T; 3]>()) };
            Ok(PointArguments { f, fibre, state: state_old.cast::<[Cell<T>; _]>().as_ref().unwrap_or(fresh) })
        }
    }
}

/// The sink for one point: the caller's arrays, those for a tangent included. What is null is not stored, except that `tangent`
/// must not be null if there is a tangent.
pub(in crate::host) struct PointAnswer<'a, T> {
    pub stress: *mut T,
    pub state: *mut T,
    pub modes: *mut T,
    pub density: T,
    pub wave_speed: *mut T,
    pub tangent: *mut T,
    pub status: &'a mut i32,
}

impl<T: Real> PointAnswer<'_, T> {
    #[inline(always)]
    fn put(self, point: &Point<T>) {
        *self.status = point.status;
        // SAFETY: the function that makes this has arrays of these sizes, or null.
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
    fn take(self, point: Point<T>, _: [T; 0]) {
        self.put(&point);
    }
}

impl<T: Real> Sink<T, 21> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, moduli: [T; 21]) {
        // SAFETY: the function that makes this has room for the matrix.
        unsafe { *self.tangent.cast() = Moduli(moduli).matrix() };
        self.put(&point);
    }
}

impl<T: Real> Sink<T, 81> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, nominal: [T; 81]) {
        // SAFETY: the function that makes this has room for the matrix.
        unsafe { *self.tangent.cast() = nominal };
        self.put(&point);
    }
}

/// Evaluates the law at one point, from and to a caller's arrays.
///
/// # Safety
/// As for `toron_hyperelastic_point_f64`.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
unsafe fn point<T: Registers>(
    values: *const T,
    count: size_t,
    deformation_gradient: *const T,
    fibre: *const T,
    state_old: *const T,
    state_new: *mut T,
    stress: *mut T,
    modes: *mut T,
    density: T,
    wave_speed: *mut T,
) -> Result<i32, Error> {
    let fresh = cells([T::splat(0.0); state::HYPERELASTIC_STATE]);
    // SAFETY: the caller's promise.
    let (properties, PointArguments { f, fibre, state }) = unsafe {
        (
            properties(values, count, &parameters::HYPERELASTIC)?,
            PointArguments::new(deformation_gradient, fibre, state_old, &fresh)?,
        )
    };
    if !wave_speed.is_null() {
        wave_speed::check_density(density)?;
    }
    let kept = !state_new.is_null();
    let request = Request {
        stress: !stress.is_null(),
        energies: kept,
        invariants: kept,
        failure: kept,
        modes: !modes.is_null(),
        wave_modulus: !wave_speed.is_null(),
    };
    let mut status = status::OK;
    let sink = PointAnswer {
        stress,
        state: state_new,
        modes,
        density,
        wave_speed,
        tangent: core::ptr::null_mut(),
        status: &mut status,
    };
    if request == Request::STRESS_AND_STATE {
        evaluate_call(Call { properties, f, fibre, state, tangent: StressAndState, sink })?;
    } else {
        evaluate_call(Call { properties, f, fibre, state, tangent: NoTangent(request), sink })?;
    }
    Ok(status)
}

/// `toron_hyperelastic_point_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_point_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    modes: *mut f64,
    density: f64,
    wave_speed: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        point(values, count, deformation_gradient, fibre, state_old, state_new, stress, modes, density, wave_speed)
    })
}

/// `toron_hyperelastic_point_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[allow(clippy::too_many_arguments)]
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_point_f32(
    values: *const f32,
    count: size_t,
    deformation_gradient: *const f32,
    fibre: *const f32,
    state_old: *const f32,
    state_new: *mut f32,
    stress: *mut f32,
    modes: *mut f32,
    density: f32,
    wave_speed: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        point(values, count, deformation_gradient, fibre, state_old, state_new, stress, modes, density, wave_speed)
    })
}
