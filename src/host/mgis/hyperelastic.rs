//! The hyperelastic law as the behaviour `ToronHyperelastic`.

use core::cell::Cell;
use core::slice;

use crate::host::entry_points;
use crate::law::derivative::{self, JaumannModulus, NineByNine, NoTangent, SixBySix};
use crate::law::description::HYPERELASTIC;
use crate::law::error::Error;
use crate::law::failure::Failure;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::number::level::Level;
use crate::law::own::Own;
use crate::law::parameters::HYPERELASTIC_PROPERTIES;
use crate::law::point::{Call, Sink, evaluate_call};
use crate::law::response::Point;
use crate::law::response::{Request, nan_unless_finite};
use crate::law::state::{FAILED, HYPERELASTIC_STATE};
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::voigt::{Moduli, sum};

use super::operator::{cauchy_by_gradient, kirchhoff_by_increment, material, nominal};
use super::results::{Results, Stress, status_of};
use super::step::MgisLaw;
use super::view::{BehaviourDataView, Operator, Options, StressMeasure, columns, integrate};

impl MgisLaw for Hyperelastic<f64> {
    #[inline(always)]
    unsafe fn integrate(view: *mut BehaviourDataView) -> i32 {
        // SAFETY: `view` is null or MGIS's.
        unsafe { hyperelastic(view) }
    }

    #[inline(always)]
    unsafe fn integrate_in_plane(view: *mut BehaviourDataView) -> i32 {
        // SAFETY: `view` is null or MGIS's.
        unsafe { hyperelastic_in_plane(view) }
    }
}

/// `ToronHyperelastic_Tridimensional`.
///
/// # Safety
/// As for [`MgisLaw::integrate`].
#[inline(never)]
pub unsafe extern "C" fn hyperelastic(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: `view` is null or MGIS's, and `integrate` evaluates only if no pointer that is needed is null.
    unsafe { integrate(&HYPERELASTIC, view, |view, options| integrate_point(view, options, false)) }
}

/// `ToronHyperelastic_PlaneStrain` and `ToronHyperelastic_Axisymmetrical`.
///
/// # Safety
/// As for [`MgisLaw::integrate`].
#[inline(never)]
pub unsafe extern "C" fn hyperelastic_in_plane(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: as above.
    unsafe { integrate(&HYPERELASTIC, view, |view, options| integrate_point(view, options, true)) }
}

/// Evaluates the law and writes what is requested. Returns the status of the point.
///
/// # Errors
/// The first property that is wrong.
///
/// # Safety
/// As for [`MgisLaw::integrate`]; no pointer that is needed is null.
#[inline(always)]
unsafe fn integrate_point(view: &BehaviourDataView, options: Options, plane: bool) -> Result<i32, Error> {
    // SAFETY: `integrate` has found these arrays not to be null; they have the values of the tables. The state is in
    // cells, since the new one may replace it.
    let (source, state, f) = unsafe {
        (
            slice::from_raw_parts(view.s1.material_properties, HYPERELASTIC_PROPERTIES),
            &*view.s0.internal_state_variables.cast::<[Cell<f64>; HYPERELASTIC_STATE]>(),
            columns(if options.integrates { view.s1.gradients } else { view.s0.gradients }, plane),
        )
    };
    if plane {
        check_plane(source)?;
    }
    let latched = !Failure::intact(state[FAILED].get());
    let mut code = status::OK;
    let to = ToHost { results: Results { view, options, plane }, f: &f, latched, code: &mut code };
    let request = Request {
        modes: options.measure == StressMeasure::SecondPiolaKirchhoff,
        wave_modulus: options.density.is_some(),
        ..Request::STRESS_AND_STATE
    };
    // The request that a solver repeats for all points is known to the compiler.
    let usual = request == Request::STRESS_AND_STATE;
    macro_rules! evaluate_with {
        ($tangent:expr) => {
            evaluate_call(Call { source, f: &f, own: Own::NONE, state, tangent: $tangent, sink: to }, Level::Avx512)
        };
    }
    match options.operator {
        None if usual => evaluate_with!(derivative::Stress::<true>),
        None => evaluate_with!(NoTangent(request)),
        Some(Operator::CauchyByGradient) if usual => evaluate_with!(JaumannModulus),
        Some(Operator::CauchyByGradient | Operator::KirchhoffByIncrement) => {
            evaluate_with!(SixBySix(request, Measure::Jaumann))
        }
        Some(Operator::Material) => evaluate_with!(SixBySix(request, Measure::Material)),
        Some(Operator::Nominal) => evaluate_with!(NineByNine(request)),
    }?;
    Ok(code)
}

/// Checks the properties for a plane hypothesis.
///
/// # Errors
/// The first property that is wrong, or a fibre direction that is neither in the plane nor normal to it.
#[inline(never)]
fn check_plane(properties: &[f64]) -> Result<(), Error> {
    entry_points::check_plane(&Hyperelastic::new(properties)?, properties)
}

/// Writes the results of a point to MGIS's arrays.
struct ToHost<'a> {
    results: Results<'a>,
    f: &'a [[f64; 3]; 3],
    /// Whether the point has failed before.
    latched: bool,
    code: &'a mut i32,
}

impl ToHost<'_> {
    /// Writes the results, given whether the operator is finite, and the operator by `operator`; nothing if there is an
    /// error.
    #[inline(always)]
    fn put(self, point: &Point<f64>, finite: bool, operator: impl FnOnce(&Results<'_>)) {
        let results = self.results;
        let stress = Stress::new(results.options.measure, &point.stress, self.f, || {
            let [el, tc, td, ld] = point.modes;
            sum(sum(el, tc), sum(td, ld))
        });
        let converted = results.options.measure == StressMeasure::Cauchy || stress.is_finite();
        let [w_el, w_tc, w_td, w_ld, ..] = point.state;
        let energy = ((w_el + w_tc) + w_td) + w_ld;
        *self.code = status_of(point.status, finite & converted & energy.is_finite());
        if *self.code != status::OK {
            return;
        }
        operator(&results);
        // SAFETY: the arrays are those of `integrate_point`'s view, whose sizes and pointers are right.
        unsafe {
            results.store_speed(point.wave_modulus);
            if results.options.integrates {
                results.store_step(&stress, &point.state, energy);
            }
        }
    }
}

impl Sink<f64, 0> for ToHost<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, _: Option<f64>, _: [f64; 0]) {
        self.put(&point, true, |_| ());
    }
}

impl Sink<f64, 21> for ToHost<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, _: Option<f64>, moduli: [f64; 21]) {
        let rows = Moduli(moduli).matrix();
        if self.results.options.operator == Some(Operator::Material) {
            // SAFETY: as in `put`; K has the values of dS/dE.
            return self.put(&point, true, |to| unsafe { to.store_operator(&material(rows)) });
        }
        let operator = if self.latched || point.status != status::OK {
            [[0.0; 9]; 6]
        } else if self.results.options.operator == Some(Operator::KirchhoffByIncrement) {
            let Results { view, options, plane } = self.results;
            // SAFETY: not null; the first F is read for this operator, and if the step is not integrated.
            let f0 = if options.integrates { unsafe { columns(view.s0.gradients, plane) } } else { *self.f };
            kirchhoff_by_increment(&rows, &point.stress, &f0, self.f)
        } else {
            cauchy_by_gradient(&rows, &point.stress, self.f)
        };
        let finite = nan_unless_finite(operator.as_flattened()) == 0.0;
        // SAFETY: as in `put`; K has the values of this operator.
        self.put(&point, finite, |to| unsafe { to.store_operator(&operator) });
    }
}

impl Sink<f64, 81> for ToHost<'_> {
    #[inline(always)]
    fn take(self, point: Point<f64>, _: Option<f64>, entries: [f64; 81]) {
        let rows = nominal(|row, column| entries.get(row + 9 * column).copied().unwrap_or_default());
        // SAFETY: as in `put`; K has the values of dP/dF.
        self.put(&point, true, |to| unsafe { to.store_operator(&rows) });
    }
}
