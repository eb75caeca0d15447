//! The data of a call as MGIS lays them out (its `BehaviourDataView`), and what the call requests.

use core::ffi::c_char;

use crate::host::entry_points::{Message, entry};
use crate::law::description::Description;
use crate::law::error::{Error, Value};
use crate::law::status;
use crate::law::wave_speed::check_density;

use super::{INTEGRATED, MESSAGE_CAPACITY, NOT_INTEGRATED};

/// A state of the material: that at the start of the step, which is only read, or that at its end.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StateView {
    /// F: 9 values, or 5 in the plane.
    pub gradients: *const f64,
    /// The stress: 6 values or 9, in the plane 4 or 5.
    pub thermodynamic_forces: *mut f64,
    /// The reference density; read only if the speed of sound is requested.
    pub mass_density: *const f64,
    pub material_properties: *const f64,
    pub internal_state_variables: *mut f64,
    /// The energies may be null; that which is dissipated is written by a law that loses energy, and never read.
    pub stored_energy: *mut f64,
    pub dissipated_energy: *mut f64,
    pub external_state_variables: *const f64,
}

/// The data of a call. MGIS promises that every pointer that is not null points to as many values as its field says,
/// valid for what they are used for: F and stress those of the hypothesis, properties and state variables those that
/// the symbols of the behaviour tell. Only the state at the end may be in the place of that at the start.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BehaviourDataView {
    /// Null, or a buffer of [`MESSAGE_CAPACITY`] bytes for a message.
    pub error_message: *mut c_char,
    pub dt: f64,
    /// In, 2 or 3: the request, the stress measure and, if a tangent is requested, its kind; out: the tangent.
    pub k: *mut f64,
    /// In and out: the factor by which the time step may grow or must shrink.
    pub rdt: *mut f64,
    pub speed_of_sound: *mut f64,
    pub s0: StateView,
    pub s1: StateView,
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<BehaviourDataView>() == 5 * 8 + 2 * 8 * 8);

/// The factor that rdt is lowered to if a point cannot be evaluated.
const CUTBACK: f64 = 0.25;

/// The stress that is returned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StressMeasure {
    Cauchy,
    SecondPiolaKirchhoff,
    FirstPiolaKirchhoff,
}

/// The tangent that is returned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    /// dσ/dF.
    CauchyByGradient,
    /// dS/dE.
    Material,
    /// dP/dF.
    Nominal,
    /// dτ/dΔF, F1 = ΔF F0.
    KirchhoffByIncrement,
}

/// The whole number from 0 to 3 that a value is nearest to: MFront's libraries, too, compare with numbers in between.
#[inline(always)]
fn whole(value: f64) -> Option<i32> {
    (-0.5..3.5).contains(&value).then_some((value + 0.5) as i32)
}

/// What a call requests.
#[derive(Clone, Copy, Debug)]
pub(super) struct Options {
    /// Whether the step is integrated; if not, only the tangent at its start is returned.
    pub integrates: bool,
    pub measure: StressMeasure,
    pub operator: Option<Operator>,
    /// The reference density, if the speed of sound is requested.
    pub density: Option<f64>,
}

impl Options {
    /// Reads the request.
    ///
    /// # Errors
    /// A number that stands for nothing, or a density that is missing or wrong.
    ///
    /// # Safety
    /// The view is what [`BehaviourDataView`] says, and K is not null.
    #[inline(always)]
    unsafe fn read(view: &BehaviourDataView) -> Result<Options, Error> {
        // SAFETY: `integrate` has found K not to be null; its third value is read only if there is an operator.
        let (coded, measure) = unsafe { (*view.k, *view.k.add(1)) };
        let sounds = coded > 50.0;
        let request = if sounds { coded - 100.0 } else { coded };
        let known = -3.5 < request && request < 4.5;
        let integrates = -0.25 <= request;
        let operates = !integrates || 0.5 < request;
        let measure = match whole(measure) {
            Some(0) => StressMeasure::Cauchy,
            Some(1) => StressMeasure::SecondPiolaKirchhoff,
            Some(2) => StressMeasure::FirstPiolaKirchhoff,
            _ => {
                let wanted = "0 (Cauchy), 1 (PK2) or 2 (PK1)";
                return Err(Error::Argument { name: "K[1]", value: Value::of(measure), wanted });
            }
        };
        if !known {
            let wanted = "-3 to 4, or 100 more for the speed of sound";
            return Err(Error::Argument { name: "K[0]", value: Value::of(coded), wanted });
        }
        // SAFETY: K has a third value where there is an operator; the densities are null or a value.
        let (operator, density) = unsafe {
            let operator = if operates { Some(Operator::read(*view.k.add(2))?) } else { None };
            (operator, if sounds { Some(view.density(integrates)?) } else { None })
        };
        Ok(Options { integrates, measure, operator, density })
    }
}

impl Operator {
    /// The operator that a number stands for.
    ///
    /// # Errors
    /// It stands for none.
    #[inline(always)]
    fn read(value: f64) -> Result<Operator, Error> {
        match whole(value) {
            Some(0) => Ok(Operator::CauchyByGradient),
            Some(1) => Ok(Operator::Material),
            Some(2) => Ok(Operator::Nominal),
            Some(3) => Ok(Operator::KirchhoffByIncrement),
            _ => {
                let wanted = "0 (dsig/dF), 1 (dPK2/dE), 2 (dPK1/dF) or 3 (dtau/ddF)";
                Err(Error::Argument { name: "K[2]", value: Value::of(value), wanted })
            }
        }
    }
}

impl BehaviourDataView {
    /// The reference density for the speed of sound.
    ///
    /// # Errors
    /// It is missing or no density, or there is nowhere to write the speed.
    ///
    /// # Safety
    /// The view is what [`BehaviourDataView`] says.
    #[cold]
    unsafe fn density(&self, integrates: bool) -> Result<f64, Error> {
        let state = if integrates { &self.s1 } else { &self.s0 };
        if state.mass_density.is_null() {
            return Err(Error::Null { name: "mass_density" });
        }
        if self.speed_of_sound.is_null() {
            return Err(Error::Null { name: "speed_of_sound" });
        }
        // SAFETY: not null, as just checked: one value.
        let density = unsafe { *state.mass_density };
        match check_density(density) {
            Err(Error::Argument { value, wanted, .. }) => Err(Error::Argument { name: "mass_density", value, wanted }),
            other => other.map(|()| density),
        }
    }

    /// The first of the pointers that is null and must not be.
    #[cold]
    #[inline(never)]
    fn missing(&self) -> Option<Error> {
        let pointers = [
            (self.k.cast_const(), "K"),
            (self.s0.gradients, "s0.gradients"),
            (self.s0.internal_state_variables.cast_const(), "s0.internal_state_variables"),
            (self.s1.gradients, "s1.gradients"),
            (self.s1.thermodynamic_forces.cast_const(), "s1.thermodynamic_forces"),
            (self.s1.material_properties, "s1.material_properties"),
            (self.s1.internal_state_variables.cast_const(), "s1.internal_state_variables"),
        ];
        pointers.iter().find(|(pointer, _)| pointer.is_null()).map(|&(_, name)| Error::Null { name })
    }

    #[inline(always)]
    fn complete(&self) -> bool {
        !self.k.is_null()
            & !self.s0.gradients.is_null()
            & !self.s0.internal_state_variables.is_null()
            & !self.s1.gradients.is_null()
            & !self.s1.thermodynamic_forces.is_null()
            & !self.s1.material_properties.is_null()
            & !self.s1.internal_state_variables.is_null()
    }
}

/// Runs an entry of a law: reads the request, passes it to `evaluate`, which returns the status of the point, and
/// answers MGIS.
///
/// # Safety
/// `view` is null or points to what [`BehaviourDataView`] says.
#[inline(always)]
pub(super) unsafe fn integrate(
    law: &'static Description,
    view: *const BehaviourDataView,
    evaluate: impl FnOnce(&BehaviourDataView, Options) -> Result<i32, Error>,
) -> i32 {
    if view.is_null() {
        return NOT_INTEGRATED;
    }
    // SAFETY: not null, as just checked, and then MGIS's.
    let view = unsafe { &*view };
    let message = Message { text: view.error_message, capacity: MESSAGE_CAPACITY };
    let body = move || {
        if !view.complete()
            && let Some(error) = view.missing()
        {
            return Err(error);
        }
        // SAFETY: K and the other arrays that are needed are not null.
        let options = unsafe { Options::read(view) }?;
        let code = evaluate(view, options)?;
        if code != status::OK && !view.rdt.is_null() {
            // SAFETY: not null, as just checked: one value.
            unsafe { *view.rdt = (*view.rdt).min(CUTBACK) };
        }
        law.told(code)
    };
    // SAFETY: the message is null or has MESSAGE_CAPACITY bytes.
    match unsafe { entry(message, body) } {
        status::OK => INTEGRATED,
        _ => NOT_INTEGRATED,
    }
}

/// The columns of the deformation gradient.
///
/// # Safety
/// `gradients` points to 9 values, or to 5 in the plane.
#[inline(always)]
pub(super) unsafe fn columns(gradients: *const f64, plane: bool) -> [[f64; 3]; 3] {
    // SAFETY: five values in the plane, else nine.
    unsafe {
        if plane {
            let [f11, f22, f33, f12, f21] = *gradients.cast();
            return [[f11, f21, 0.0], [f12, f22, 0.0], [0.0, 0.0, f33]];
        }
        let [f11, f22, f33, f12, f21, f13, f31, f23, f32] = *gradients.cast();
        [[f11, f21, f31], [f12, f22, f32], [f13, f23, f33]]
    }
}
