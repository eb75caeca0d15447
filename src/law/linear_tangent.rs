//! The tangent of the linear elastic law, consistent with its finite step, by forward differentiation; and tangents of
//! any law in all measures.

use nalgebra::Matrix3;

use super::differentiated::{Rates, Stress};
use super::linear_elastic::{Answer, Criterion, LinearElastic, LinearPoint, Rotation, Step, Wanted};
use super::number::dual::Dual;
use super::number::level::Level;
use super::number::real::{Lanes, Real};
use super::number::vector::Matrix;
use super::state::LINEAR_ELASTIC_STATE;
use super::status;
use super::stress::{matrix, pulled_back, truesdell_of_jaumann};
use super::tangent::Measure;
use super::voigt::PAIRS;

impl LinearElastic {
    /// As [`step`](Self::step), with the tangent consistent with the finite step: that of the intact material in the
    /// call that detects failure, 0 in later calls and if the point cannot be evaluated.
    pub fn step_with_tangent(
        &self,
        f0: &Matrix3<f64>,
        f1: &Matrix3<f64>,
        state: &[f64; LINEAR_ELASTIC_STATE],
        rotation: Rotation,
        criterion: Criterion,
        axes: &mut Matrix3<f64>,
    ) -> (LinearPoint, LinearTangent) {
        let columns = (*axes).into();
        let step = Step { f0: &(*f0).into(), f1: &(*f1).into(), axes: &columns, limit: None, rotation, criterion };
        // In the same arithmetic as the step.
        let of_all_motions = (Measure::Nominal, Level::Baseline);
        let (answer, tangent) =
            self.respond_with_tangent(step, &self.axes, true, state, Wanted::STRESS_AND_STATE, of_all_motions);
        if rotation == Rotation::Spin {
            *axes = answer.q1.into();
        }
        (answer.point(), tangent)
    }

    /// As [`step_with_tangent`](Self::step_with_tangent), with the arguments and the results of a step in lanes. The
    /// tangent is that of all motions for [`Measure::Nominal`], else that of strains, without spin.
    pub(super) fn respond_with_tangent(
        &self,
        step: Step<'_, f64>,
        reference: &Matrix<f64>,
        usable: bool,
        state: &[f64; LINEAR_ELASTIC_STATE],
        wanted: Wanted,
        kind: (Measure, Level),
    ) -> (Answer<f64>, LinearTangent) {
        let none = LinearTangent::default();
        let mut answer = self.respond(step, reference, usable, state, wanted);
        let tangent = if answer.taken { self.tangent_of(&answer, step, reference, state, kind) } else { Some(none) };
        if tangent.is_none() {
            self.overflow(&mut answer, state);
        }
        (answer, tangent.unwrap_or(none))
    }

    /// Takes the step back: a result does not fit the number format.
    pub(super) fn overflow(&self, answer: &mut Answer<f64>, state: &[f64; LINEAR_ELASTIC_STATE]) {
        answer.taken = false;
        answer.keep(state, f64::from(status::OVERFLOW));
        answer.wave_modulus = self.wave_modulus();
    }

    /// The tangent of a step that is taken; `None` if it is not finite.
    fn tangent_of(
        &self,
        answer: &Answer<f64>,
        step: Step<'_, f64>,
        reference: &Matrix<f64>,
        state: &[f64; LINEAR_ELASTIC_STATE],
        (measure, level): (Measure, Level),
    ) -> Option<LinearTangent> {
        // The axes that a caller keeps are those that the step has started with.
        let mut law = AtPoint { law: self, step: Step { axes: &answer.q0, ..step }, reference, state };
        let tangent = Rates::of(&mut law, step.f1, measure, level).tangent(&answer.stress);
        tangent.0.iter().flatten().all(|x| x.is_finite()).then_some(tangent)
    }
}

/// The law at a point, in the step that it takes.
struct AtPoint<'a> {
    law: &'a LinearElastic,
    step: Step<'a, f64>,
    reference: &'a Matrix<f64>,
    state: &'a [f64; LINEAR_ELASTIC_STATE],
}

/// The same with derivatives, which are 0 but for F at the end.
struct Differentiated<R> {
    law: LinearElastic<Dual<R>>,
    f0: Matrix<Dual<R>>,
    axes: Matrix<Dual<R>>,
    reference: Matrix<Dual<R>>,
    state: [Dual<R>; LINEAR_ELASTIC_STATE],
}

impl Stress for AtPoint<'_> {
    type Prepared<R: Lanes<f64>> = Differentiated<R>;

    #[inline(always)]
    fn prepared<R: Lanes<f64>>(&self) -> Differentiated<R> {
        let zero = Dual::splat(0.0);
        let mut state = [zero; LINEAR_ELASTIC_STATE];
        state.iter_mut().zip(self.state).for_each(|(to, &x)| *to = Dual::splat(x));
        Differentiated {
            law: self.law.lanes(),
            f0: constant(self.step.f0),
            axes: constant(self.step.axes),
            reference: constant(self.reference),
            state,
        }
    }

    #[inline(always)]
    fn stress<R: Lanes<f64>>(&mut self, same: &mut Differentiated<R>, f: &Matrix<Dual<R>>) -> [Dual<R>; 6] {
        let Step { rotation, criterion, .. } = self.step;
        let step = Step { f0: &same.f0, f1: f, axes: &same.axes, limit: None, rotation, criterion };
        same.law.stress(&step, &same.reference, &same.state)
    }
}

/// A matrix without derivatives.
#[inline(always)]
fn constant<R: Real>(a: &Matrix<f64>) -> Matrix<Dual<R>> {
    let mut to = [[Dual::splat(0.0); 3]; 3];
    to.as_flattened_mut().iter_mut().zip(a.as_flattened()).for_each(|(to, &x)| *to = Dual::splat(x));
    to
}

/// The derivative of the stress at the end of a step: ∂τ_ij/∂L_kl over J for F moved to (1 + L) F. One row for each kl,
/// 11 21 31 12 22 32 13 23 33, with the components ij, 11 22 33 12 23 31.
///
/// It is not symmetric, and with [`Rotation::Spin`], whose axes depend on the step, it is not that of an objective
/// rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearTangent(pub [[f64; 6]; 9]);

impl LinearTangent {
    /// The matrix of a 6×6 measure, row by row, at the deformation gradient `f` and the Cauchy stress (11 22 33 12
    /// 23 31) of the end of the step; `None` for [`Measure::Nominal`], and for [`Measure::Material`] if F has no inverse.
    ///
    /// [`Measure::Jaumann`] is DDSDDE: the motions L are symmetric, without spin.
    pub fn matrix(&self, measure: Measure, f: &Matrix3<f64>, cauchy: &[f64; 6]) -> Option<[[f64; 6]; 6]> {
        let mut jaumann = [[0.0; 6]; 6];
        for (column, (k, l)) in PAIRS.into_iter().enumerate() {
            for (row, entries) in jaumann.iter_mut().enumerate() {
                // A unit engineering shear is L_kl = L_lk = ½.
                entries[column] = 0.5 * (self.0[k + 3 * l][row] + self.0[l + 3 * k][row]);
            }
        }
        match measure {
            Measure::Jaumann => Some(jaumann),
            Measure::Truesdell => Some(truesdell_of_jaumann(&jaumann, cauchy)),
            Measure::Material => pulled_back(&truesdell_of_jaumann(&jaumann, cauchy), f),
            Measure::Nominal => None,
        }
    }

    /// dP/dF, both by columns: entry `(i + 3 J) + 9 (k + 3 L)` is ∂P_iJ/∂F_kL; 0 where F has no inverse.
    ///
    /// With L = dF F⁻¹, dP = (dτ − τ Lᵀ) F⁻ᵀ.
    pub fn nominal(&self, f: &Matrix3<f64>, cauchy: &[f64; 6]) -> [f64; 81] {
        let mut nominal = [0.0; 81];
        let Some(inverse) = f.try_inverse() else { return nominal };
        let (jacobian, cauchy) = (f.determinant(), matrix(cauchy));
        for (column, entries) in nominal.chunks_exact_mut(9).enumerate() {
            let (k, big_l) = (column % 3, column / 3);
            let mut rate = Matrix3::zeros();
            let mut l = Matrix3::zeros();
            for (j, along) in inverse.row(big_l).iter().enumerate() {
                rate += matrix(&self.0[k + 3 * j]) * *along;
                l[(k, j)] = *along;
            }
            let p = (rate - cauchy * l.transpose()) * inverse.transpose() * jacobian;
            entries.copy_from_slice(p.as_slice());
        }
        nominal
    }
}

/// The entries of a tangent row by row, and the number of rows.
pub(super) fn by_rows(
    tangent: &LinearTangent,
    measure: Measure,
    f: &Matrix3<f64>,
    cauchy: &[f64; 6],
) -> ([f64; 81], usize) {
    let mut entries = [0.0; 81];
    if measure == Measure::Nominal {
        let nominal = tangent.nominal(f, cauchy);
        for (row, to) in entries.chunks_exact_mut(9).enumerate() {
            for (x, from) in to.iter_mut().zip(nominal.iter().skip(row).step_by(9)) {
                *x = *from;
            }
        }
        return (entries, 9);
    }
    let rows = tangent.matrix(measure, f, cauchy).unwrap_or_default();
    for (x, from) in entries.iter_mut().zip(rows.as_flattened()) {
        *x = *from;
    }
    (entries, 6)
}
