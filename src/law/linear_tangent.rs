//! The tangent of the linear elastic law, consistent with its finite step (derivation in `docs/reference/theory.md`).

use nalgebra::{Matrix3, Vector3};

use super::linear_elastic::{Answer, Criterion, LinearElastic, LinearPoint, Rotation, Step, Wanted};
use super::number::vector::Matrix;
use super::state::{LINEAR_ELASTIC_STATE, LINEAR_LARGEST, LINEAR_STRESS};
use super::status;
use super::stress::{components, matrix, pulled_back, truesdell_of_jaumann};
use super::tangent::Measure;
use super::voigt::{PAIRS, VOIGT};

impl LinearElastic {
    /// As [`step`](Self::step), with the tangent consistent with the finite step: that of the intact material in the call that
    /// detects failure, 0 in later calls and if the point cannot be evaluated.
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
        let (answer, tangent) = self.respond_with_tangent(step, &self.axes, true, state, Wanted::STRESS_AND_STATE);
        if rotation == Rotation::Spin {
            *axes = answer.q1.into();
        }
        (answer.point(), tangent)
    }

    /// As [`step_with_tangent`](Self::step_with_tangent), with the arguments and the results of a step in lanes.
    pub(super) fn respond_with_tangent(
        &self,
        step: Step<'_, f64>,
        reference: &Matrix<f64>,
        usable: bool,
        state: &[f64; LINEAR_ELASTIC_STATE],
        wanted: Wanted,
    ) -> (Answer<f64>, LinearTangent) {
        let none = LinearTangent::default();
        let mut answer = self.respond(step, reference, usable, state, wanted);
        let tangent = if answer.taken { self.tangent_of(&answer, step, reference) } else { Some(none) };
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

    /// ∂τ/∂L over J for a step to (1 + L) F, column by column: the strain that L adds in the material axes, which L rotates as
    /// well, and the rotation of the stress with these axes. `None` if it cannot be computed or is not finite.
    fn tangent_of(&self, answer: &Answer<f64>, step: Step<'_, f64>, reference: &Matrix<f64>) -> Option<LinearTangent> {
        let (f0, f1) = (&Matrix3::from(*step.f0), &Matrix3::from(*step.f1));
        let motion = Motion::new(answer, f0, f1)?;
        let Motion { q1, local, .. } = &motion;
        let mut stress = [0.0; 6];
        stress.copy_from_slice(&answer.state[LINEAR_STRESS..LINEAR_LARGEST]);
        let stress = matrix(&stress);
        let cauchy = q1 * stress * q1.transpose();
        let turning = Turning::new(&motion, f1, &Matrix3::from(*reference), step.rotation)?;
        let mut tangent = LinearTangent::default();
        for (column, entries) in tangent.0.iter_mut().enumerate() {
            let mut l = Matrix3::zeros();
            l[column] = 1.0;
            let turn = turning.of(&motion, &l);
            let seen = q1.transpose() * l * q1 - turn;
            let rate = logarithm_derivative(local, &(seen * local))?;
            let mut added = Matrix3::zeros();
            for (i, j) in PAIRS {
                let shear = if i == j { 1.0 } else { 2.0 };
                let strain = 0.5 * (rate[(i, j)] + rate[(j, i)]);
                added[(i, j)] = self.stiffness[VOIGT[i][j]] * shear * strain;
                added[(j, i)] = added[(i, j)];
            }
            let turned = q1 * (added + turn * stress - stress * turn) * q1.transpose();
            *entries = components(&(turned + cauchy * l.trace()));
        }
        tangent.0.iter().flatten().all(|x| x.is_finite()).then_some(tangent)
    }
}

/// The kinematics of a step.
struct Motion {
    /// F1 F0⁻¹.
    relative: Matrix3<f64>,
    /// The material axes at its end, as columns.
    q1: Matrix3<f64>,
    /// Q1ᵀ F1 F0⁻¹ Q0.
    local: Matrix3<f64>,
}

impl Motion {
    fn new(answer: &Answer<f64>, f0: &Matrix3<f64>, f1: &Matrix3<f64>) -> Option<Self> {
        let (q0, q1) = (Matrix3::from(answer.q0), Matrix3::from(answer.q1));
        let relative = f1 * f0.try_inverse()?;
        Some(Motion { relative, q1, local: q1.transpose() * relative * q0 })
    }
}

/// The spin of a step by the midpoint rule.
struct HalfSpin {
    /// Half the gradient of the increment at the middle of the step, (f − 1)(f + 1)⁻¹, and its factor (f + 1)⁻¹.
    gradient: Matrix3<f64>,
    middle: Matrix3<f64>,
    /// (1 − w)⁻¹, w the skew part of `gradient`: the rotation (1 − w)⁻¹(1 + w) is exact for a rigid step.
    forward: Matrix3<f64>,
}

impl HalfSpin {
    fn new(relative: &Matrix3<f64>) -> Option<Self> {
        let middle = (relative + Matrix3::identity()).try_inverse()?;
        let gradient = (relative - Matrix3::identity()) * middle;
        let half = (gradient - gradient.transpose()) * 0.5;
        let forward = (Matrix3::identity() - half).try_inverse()?;
        Some(HalfSpin { gradient, middle, forward })
    }
}

/// The rotation of the material axes by a further motion L: dQ1 = Q1 Ω, with Ω linear in L.
enum Turning {
    Fibre,
    /// Reference axes, R, U and (tr U 1 − U)⁻¹.
    Polar(Matrix3<f64>, Matrix3<f64>, Matrix3<f64>, Matrix3<f64>),
    Spin(HalfSpin),
}

impl Turning {
    fn new(motion: &Motion, f: &Matrix3<f64>, axes: &Matrix3<f64>, rotation: Rotation) -> Option<Self> {
        Some(match rotation {
            Rotation::Fibre => Turning::Fibre,
            Rotation::Polar => {
                let r = motion.q1 * axes.transpose();
                let u = r.transpose() * f;
                let u = (u + u.transpose()) * 0.5;
                let inverse = (Matrix3::identity() * u.trace() - u).try_inverse()?;
                Turning::Polar(*axes, r, u, inverse)
            }
            Rotation::Spin => Turning::Spin(HalfSpin::new(&motion.relative)?),
        })
    }

    /// Ω for the motion L.
    fn of(&self, motion: &Motion, l: &Matrix3<f64>) -> Matrix3<f64> {
        let seen = motion.q1.transpose() * l * motion.q1;
        match self {
            // e1 follows L e1, and e3 stays normal to e1 and e2 as L moves them: Ω has the entries of L below the diagonal.
            Turning::Fibre => skew(&Vector3::new(seen.m32, -seen.m31, seen.m21)),
            // Θ U + U Θ is the skew part of RᵀL R U, twice; in axial vectors that is (tr U 1 − U) θ.
            Turning::Polar(axes, r, u, inverse) => {
                let moved = r.transpose() * l * r * u;
                let twice = Vector3::new(moved.m32 - moved.m23, moved.m13 - moved.m31, moved.m21 - moved.m12);
                axes.transpose() * skew(&(inverse * twice)) * axes
            }
            Turning::Spin(HalfSpin { gradient, middle, forward, .. }) => {
                let moved = (Matrix3::identity() - gradient) * l * motion.relative * middle;
                let half = (moved - moved.transpose()) * 0.5;
                let back = forward.transpose(); // (1 + w)⁻¹
                motion.q1.transpose() * forward * half * back * motion.q1 * 2.0
            }
        }
    }
}

/// The skew matrix of an axial vector.
fn skew(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// The derivative of the stress at the end of a step: ∂τ_ij/∂L_kl over J for F moved to (1 + L) F. One row for each kl, 11 21
/// 31 12 22 32 13 23 33, with the components ij, 11 22 33 12 23 31.
///
/// It is not symmetric, and with [`Rotation::Spin`], whose axes depend on the step, it is not that of an objective rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearTangent(pub [[f64; 6]; 9]);

impl LinearTangent {
    /// The matrix of a 6×6 measure, row by row, at the deformation gradient `f` and the Cauchy stress (11 22 33 12 23 31) of
    /// the end of the step; `None` for [`Measure::Nominal`], and for [`Measure::Material`] if F has no inverse.
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

/// The derivative of ln A = 2 artanh((A − 1)(A + 1)⁻¹) along `da`, term by term; `None` if the series does not converge.
fn logarithm_derivative(a: &Matrix3<f64>, da: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    const TERMS: i32 = 200;
    let identity = Matrix3::identity();
    let inverse = (a + identity).try_inverse()?;
    let y = (a - identity) * inverse;
    let dy = (identity - y) * da * inverse;
    let square = y * y;
    let dsquare = dy * y + y * dy;
    let (mut power, mut dpower) = (y, dy);
    let mut sum = dy;
    for k in 1..TERMS {
        dpower = dpower * square + power * dsquare;
        power *= square;
        let term = dpower / f64::from(2 * k + 1);
        sum += term;
        if term.norm_squared() <= 1e-34 * sum.norm_squared() {
            return Some(sum * 2.0);
        }
    }
    None
}
