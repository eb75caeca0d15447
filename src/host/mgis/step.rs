//! A law as a behaviour by its step at one point, and the linear elastic law as `ToronLinearElastic`.

use core::slice;

use crate::host::ByStep;
use crate::host::entry_points::check_plane;
use crate::law::block::{Circumstances, components, components_mut};
use crate::law::error::Error;
use crate::law::failure::Failure;
use crate::law::interface::{Law, Points};
use crate::law::linear_elastic::LinearElastic;
use crate::law::response::nan_unless_finite;
use crate::law::status;
use crate::law::stress::second_piola_kirchhoff;
use crate::law::tangent::Measure;

use super::operator::{cauchy_by_gradient, kirchhoff_by_increment, material, nominal};
use super::results::{Results, Stress};
use super::view::{BehaviourDataView, Operator, Options, columns, integrate};

/// A law as a behaviour of MFront's generic interface.
pub trait MgisLaw: Law<f64> {
    /// The function of the hypothesis `Tridimensional`.
    ///
    /// # Safety
    /// `view` is null or points to what [`BehaviourDataView`] says.
    #[inline(never)]
    unsafe fn integrate(view: *mut BehaviourDataView) -> i32 {
        // SAFETY: `view` is null or MGIS's.
        unsafe { of_law::<Self>(view, false) }
    }

    /// That of the hypotheses `PlaneStrain` and `Axisymmetrical`.
    ///
    /// # Safety
    /// As for [`integrate`](Self::integrate).
    #[inline(never)]
    unsafe fn integrate_in_plane(view: *mut BehaviourDataView) -> i32 {
        // SAFETY: `view` is null or MGIS's.
        unsafe { of_law::<Self>(view, true) }
    }
}

impl<L: ByStep + Law<f64>> MgisLaw for L {}

impl MgisLaw for LinearElastic<f64> {
    #[inline(always)]
    unsafe fn integrate(view: *mut BehaviourDataView) -> i32 {
        // SAFETY: `view` is null or MGIS's.
        unsafe { linear_elastic(view) }
    }

    #[inline(always)]
    unsafe fn integrate_in_plane(view: *mut BehaviourDataView) -> i32 {
        // SAFETY: `view` is null or MGIS's.
        unsafe { linear_elastic_in_plane(view) }
    }
}

/// `ToronLinearElastic_Tridimensional`.
///
/// # Safety
/// As for [`MgisLaw::integrate`].
#[inline(never)]
pub unsafe extern "C" fn linear_elastic(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: `view` is null or MGIS's.
    unsafe { of_law::<LinearElastic>(view, false) }
}

/// `ToronLinearElastic_PlaneStrain` and `ToronLinearElastic_Axisymmetrical`.
///
/// # Safety
/// As for [`MgisLaw::integrate`].
#[inline(never)]
pub unsafe extern "C" fn linear_elastic_in_plane(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: `view` is null or MGIS's.
    unsafe { of_law::<LinearElastic>(view, true) }
}

/// A call of a law, in the plane or in three dimensions.
///
/// # Safety
/// As for [`MgisLaw::integrate`].
#[inline(always)]
unsafe fn of_law<L: Law<f64>>(view: *mut BehaviourDataView, plane: bool) -> i32 {
    // SAFETY: `view` is null or MGIS's, and `integrate` evaluates only if no pointer that is needed is null.
    unsafe { integrate(const { &L::DESCRIPTION }, view, |view, options| integrate_step::<L>(view, options, plane)) }
}

/// Evaluates the law and writes what is requested. Returns the status of the point.
///
/// # Errors
/// The first property that is wrong.
///
/// # Safety
/// As for [`MgisLaw::integrate`]; no pointer that is needed is null.
#[inline(never)]
unsafe fn integrate_step<L: Law<f64>>(view: &BehaviourDataView, options: Options, plane: bool) -> Result<i32, Error> {
    // SAFETY: `integrate` has found these arrays not to be null; they have the values of the tables. The state is
    // copied, since the new one may replace it.
    let (properties, old, f0) = unsafe {
        (
            slice::from_raw_parts(view.s1.material_properties, L::DESCRIPTION.properties.len()),
            *view.s0.internal_state_variables.cast::<L::State>(),
            columns(view.s0.gradients, plane),
        )
    };
    // SAFETY: as above. A step that is not integrated ends where it starts.
    let f1 = if options.integrates { unsafe { columns(view.s1.gradients, plane) } } else { f0 };
    let law = L::new(properties)?;
    if plane {
        check_plane(&law, properties)?;
    }
    // A step that is not integrated takes no time; the temperature is the first of the external state variables.
    let circumstances = Circumstances {
        time_increment: if options.integrates { view.dt } else { 0.0 },
        time: f64::NAN,
        temperature: if options.integrates { view.s1 } else { view.s0 }.external_state_variables,
    };
    let step = Step { law: &law, f0: &f0, f1: &f1, old: &old, options, circumstances };
    let Outcome { stress: cauchy, state, speed, tangent, code } = step.outcome()?;
    if code == status::OVERFLOW {
        law.told(code)?;
    }
    if code != status::OK {
        return Ok(code);
    }
    let stress = Stress::new(options.measure, &cauchy, &f1, || second_piola_kirchhoff(&cauchy, &f1));
    let rows = step.operator(&tangent, &cauchy);
    if !stress.is_finite() || !rows.is_finite() {
        return Ok(status::OVERFLOW);
    }
    let results = Results { view, options, plane };
    // SAFETY: `integrate` has found the arrays not to be null, and there is a density only where the speed has a place;
    // the results have the request's and the hypothesis's sizes.
    unsafe {
        match &rows {
            Rows::None => (),
            Rows::Six(rows) => results.store_operator(rows),
            Rows::SixByNine(rows) => results.store_operator(rows),
            Rows::Nine(rows) => results.store_operator(rows),
        }
        if options.density.is_some() {
            *view.speed_of_sound = speed;
        }
        if options.integrates {
            results.store_step(&stress, &state, L::DESCRIPTION.energy(state.as_ref()));
            if L::DESCRIPTION.lost.is_some() && !view.s1.dissipated_energy.is_null() {
                *view.s1.dissipated_energy = L::DESCRIPTION.lost_energy(state.as_ref());
            }
        }
    }
    Ok(status::OK)
}

/// A step of the law.
struct Step<'a, L: Law<f64>> {
    law: &'a L,
    f0: &'a [[f64; 3]; 3],
    f1: &'a [[f64; 3]; 3],
    old: &'a L::State,
    options: Options,
    circumstances: Circumstances<f64>,
}

/// Its results: stress 11 22 33 12 23 31, and a tangent of the measure that [`Step::measure`] says, row by row.
struct Outcome<S> {
    stress: [f64; 6],
    state: S,
    speed: f64,
    tangent: [f64; 81],
    code: i32,
}

/// A tangent as it is written.
#[allow(clippy::large_enum_variant)] // it stays on the stack, and nothing may be allocated
enum Rows {
    None,
    Six([[f64; 6]; 6]),
    SixByNine([[f64; 9]; 6]),
    Nine([[f64; 9]; 9]),
}

impl Rows {
    fn is_finite(&self) -> bool {
        let sum = match self {
            Rows::None => 0.0,
            Rows::Six(rows) => nan_unless_finite(rows.as_flattened()),
            Rows::SixByNine(rows) => nan_unless_finite(rows.as_flattened()),
            Rows::Nine(rows) => nan_unless_finite(rows.as_flattened()),
        };
        sum == 0.0
    }
}

impl<L: Law<f64>> Step<'_, L> {
    /// The measure from which the operator is computed.
    fn measure(&self) -> Measure {
        match self.options.operator {
            Some(Operator::Material) => Measure::Material,
            Some(Operator::Nominal) => Measure::Nominal,
            _ => Measure::Jaumann,
        }
    }

    /// Evaluates the law.
    ///
    /// # Errors
    /// None: the density has been checked.
    fn outcome(&self) -> Result<Outcome<L::State>, Error> {
        let Step { law, f0, f1, old, options, circumstances } = self;
        let (mut stress, mut state, mut speed, mut tangent) = ([0.0; 6], **old, 0.0, [0.0; 81]);
        let mut point = Points {
            f_old: components(f0.as_flattened().as_ptr(), 1),
            f_new: components(f1.as_flattened().as_ptr(), 1),
            circumstances: *circumstances,
            state_old: L::parts(old.as_ref().as_ptr(), 1),
            state_new: L::parts_mut(state.as_mut().as_mut_ptr(), 1),
            stress: components_mut(stress.as_mut_ptr(), 1),
            measure: self.measure(),
            ..Points::without_arrays(1, 1)
        };
        if let Some(density) = options.density {
            (point.density, point.wave_speed) = (density, &mut speed);
        }
        if options.operator.is_some() {
            point.tangent = tangent.as_mut_ptr();
        }
        // SAFETY: the arrays have the sizes of one point, and outputs overlap nothing.
        let code = unsafe { law.step(&point) }?;
        Ok(Outcome { stress, state, speed, tangent, code })
    }

    /// The operator, if there is one.
    fn operator(&self, tangent: &[f64; 81], cauchy: &[f64; 6]) -> Rows {
        let Some(operator) = self.options.operator else { return Rows::None };
        let entry = |place: usize| tangent.get(place).copied().unwrap_or_default();
        let rows: [[f64; 6]; 6] = core::array::from_fn(|row| core::array::from_fn(|column| entry(6 * row + column)));
        let columns: [[f64; 6]; 6] = core::array::from_fn(|column| core::array::from_fn(|row| entry(6 * row + column)));
        let latch = self.old.as_ref().get(L::DESCRIPTION.failed).copied().unwrap_or_default();
        let latched = !Failure::intact(latch);
        match operator {
            Operator::Material => Rows::Six(material(rows)),
            Operator::Nominal => Rows::Nine(nominal(|row, column| entry(9 * row + column))),
            // A point that has failed before may have any F.
            _ if latched => Rows::SixByNine([[0.0; 9]; 6]),
            Operator::CauchyByGradient => Rows::SixByNine(cauchy_by_gradient(&columns, cauchy, self.f1)),
            Operator::KirchhoffByIncrement => {
                Rows::SixByNine(kirchhoff_by_increment(&columns, cauchy, self.f0, self.f1))
            }
        }
    }
}
