//! The baseline law: linear elastic, orthotropic, as the field uses it (thesis, section 4.1).
//!
//! An objective rate of the Cauchy stress is C : D, with C = diag(E1, E2, E2, G, G, G) on (D11, D22, D33, 2D12, 2D23,
//! 2D31) in a material frame and zero Poisson ratios. Which frame turns with the material decides everything, since the
//! shear stiffness is 1/630 of the fibre's: see [`Rotation`]. In the frame the stress is the sum of C times the strain
//! increments; an increment is the symmetric part of ln(Q1ᵀ F1 F0⁻¹ Q0), so that a stretch along the fibre gives
//! E1 ln λ in any number of steps.

use nalgebra::{Matrix3, Vector3};

use super::parameters::{self, LINEAR_FIBRE, LINEAR_SECOND_AXIS};
use super::state::{LINEAR_ALIVE, LINEAR_ELASTIC_STATE, LINEAR_FAILED, LINEAR_LARGEST, LINEAR_STRESS, LINEAR_WORK};
use super::status::{self, Error};
use super::stress::{PAIRS, VOIGT, components, matrix, principal_axes, pulled_back, truesdell_of_jaumann};
use super::tangent::Measure;
use super::{failure::Failure, kinematics::FibreFrame};

/// The frame that turns with the material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rotation {
    /// The first axis follows the fibre, the second one F n made orthogonal to it: the frame of a yarn.
    #[default]
    Fibre,
    /// The rotation of F = R U: the stiff direction drifts off a sheared fibre.
    Polar,
    /// The spin integrated step by step (Jaumann rate, midpoint rule of Hughes and Winget): the caller keeps the axes.
    Spin,
}

/// What is held against σ_lim.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Criterion {
    /// The largest signed principal Cauchy stress, shears included.
    #[default]
    LargestPrincipal,
    /// The Cauchy stress along the material's first axis.
    FibreStress,
}

/// The law's properties, checked and prepared once.
#[derive(Clone, Copy, Debug)]
pub struct LinearElastic {
    stiffness: [f64; 6],
    limit: f64,
    /// Columns: fibre, second axis, third axis in the reference placement.
    axes: Matrix3<f64>,
}

/// What the law answers for one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearPoint {
    /// Cauchy stress 11 22 33 12 23 31: in space from [`step`](LinearElastic::step), in the frame from
    /// [`increment`](LinearElastic::increment).
    pub stress: [f64; 6],
    /// The new state, in the order of [`state::LINEAR_ELASTIC`](super::state::LINEAR_ELASTIC).
    pub state: [f64; LINEAR_ELASTIC_STATE],
    /// 0, or why the point could not be evaluated; then there is no stress and the state is the old one.
    pub status: i32,
}

impl LinearElastic {
    /// Checks the properties, in the order of [`parameters::LINEAR_ELASTIC`], and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    pub fn new(properties: &[f64]) -> Result<Self, Error> {
        parameters::check(&parameters::LINEAR_ELASTIC, properties)?;
        let &[e_1, e_2, g, limit, m_1, m_2, m_3, n_1, n_2, n_3] = properties else {
            return Err(Error::Plain(status::PROPERTY_COUNT)); // not reached: the count is checked
        };
        let direction = |index, name, value: [f64; 3], wanted| Error::Direction { index, name, value, wanted };
        let (frame, usable) = FibreFrame::new([m_1, m_2, m_3]);
        if !usable {
            let wanted = "any vector but zero";
            return Err(direction(LINEAR_FIBRE, "fibre direction", [m_1, m_2, m_3], wanted));
        }
        let m = Vector3::from(frame.m);
        let axes = if n_1 == 0.0 && n_2 == 0.0 && n_3 == 0.0 {
            Matrix3::from_columns(&[m, Vector3::from(frame.t1), Vector3::from(frame.t2)])
        } else {
            let (second, usable) = FibreFrame::new([n_1, n_2, n_3]);
            let n = Vector3::from(second.m);
            let across = n - m * m.dot(&n);
            let (second, apart) = FibreFrame::new([across.x, across.y, across.z]);
            if !(usable && apart && 1e-6 < across.norm_squared()) {
                let wanted = "any vector that is not along the fibre, or zero";
                return Err(direction(LINEAR_SECOND_AXIS, "second axis", [n_1, n_2, n_3], wanted));
            }
            let n = Vector3::from(second.m);
            Matrix3::from_columns(&[m, n, m.cross(&n)])
        };
        Ok(LinearElastic { stiffness: [e_1, e_2, e_2, g, g, g], limit, axes })
    }

    /// The material axes in the reference placement, as columns: where a spin frame starts.
    pub fn reference_axes(&self) -> Matrix3<f64> {
        self.axes
    }

    /// From the deformation gradients at both ends of a step.
    ///
    /// `axes`, the material axes in space as columns, is read and advanced for [`Rotation::Spin`] only (start with
    /// [`reference_axes`](Self::reference_axes)); the other frames follow from F.
    pub fn step(
        &self,
        f0: &Matrix3<f64>,
        f1: &Matrix3<f64>,
        state: &[f64; LINEAR_ELASTIC_STATE],
        rotation: Rotation,
        criterion: Criterion,
        axes: &mut Matrix3<f64>,
    ) -> LinearPoint {
        self.stepped(f0, f1, state, rotation, criterion, axes).0
    }

    /// As [`step`](Self::step), with the tangent consistent with what the step does: that of the intact material in the
    /// call that detects failure, 0 afterwards and where the point cannot be evaluated.
    pub fn step_with_tangent(
        &self,
        f0: &Matrix3<f64>,
        f1: &Matrix3<f64>,
        state: &[f64; LINEAR_ELASTIC_STATE],
        rotation: Rotation,
        criterion: Criterion,
        axes: &mut Matrix3<f64>,
    ) -> (LinearPoint, LinearTangent) {
        let none = LinearTangent::default();
        let (mut point, step) = self.stepped(f0, f1, state, rotation, criterion, axes);
        let Some(step) = step else { return (point, none) };
        let mut stress = [0.0; 6];
        stress.copy_from_slice(&point.state[LINEAR_STRESS..LINEAR_LARGEST]);
        match self.step_tangent(&step, f1, &stress, rotation) {
            Some(tangent) => (point, tangent),
            None => {
                if rotation == Rotation::Spin {
                    *axes = step.q0;
                }
                point = self.refused(state, status::OVERFLOW);
                (point, none)
            }
        }
    }

    /// A step, and its kinematics where it could be taken.
    fn stepped(
        &self,
        f0: &Matrix3<f64>,
        f1: &Matrix3<f64>,
        state: &[f64; LINEAR_ELASTIC_STATE],
        rotation: Rotation,
        criterion: Criterion,
        axes: &mut Matrix3<f64>,
    ) -> (LinearPoint, Option<Step>) {
        if !Failure::intact(state[LINEAR_FAILED]) {
            return (self.failed(state), None);
        }
        let step = match self.kinematics(f0, f1, rotation, axes) {
            Ok(step) => step,
            Err(status) => return (self.refused(state, status), None),
        };
        let rate = &step.rate;
        let strain = [
            rate.m11,
            rate.m22,
            rate.m33,
            (rate.m12 + rate.m21) / 2.0,
            (rate.m23 + rate.m32) / 2.0,
            (rate.m31 + rate.m13) / 2.0,
        ];
        let mut point = self.increment(&strain, step.jacobian, state, criterion);
        if point.status != status::OK {
            return (point, None);
        }
        if rotation == Rotation::Spin {
            *axes = step.q1;
        }
        point.stress = components(&(step.q1 * matrix(&point.stress) * step.q1.transpose()));
        (point, Some(step))
    }

    /// How the material axes turn in a step, and the strain that is left.
    fn kinematics(
        &self,
        f0: &Matrix3<f64>,
        f1: &Matrix3<f64>,
        rotation: Rotation,
        axes: &Matrix3<f64>,
    ) -> Result<Step, i32> {
        if f0.iter().chain(f1.iter()).chain(axes.iter()).any(|x| !x.is_finite()) {
            return Err(status::NOT_FINITE);
        }
        let (j0, j1) = (f0.determinant(), f1.determinant());
        let (Some(inverse), true) = (f0.try_inverse(), j0 > 0.0 && j1 > 0.0) else {
            return Err(status::INVERTED);
        };
        let relative = f1 * inverse;
        let (q0, q1) = match rotation {
            Rotation::Fibre => (fibre_axes(f0, &self.axes), fibre_axes(f1, &self.axes)),
            Rotation::Polar => (polar_rotation(f0) * self.axes, polar_rotation(f1) * self.axes),
            Rotation::Spin => {
                let spin = HalfSpin::new(&relative).ok_or(status::INCREMENT_TOO_LARGE)?;
                (*axes, spin.forward * (Matrix3::identity() + spin.half) * *axes)
            }
        };
        let local = q1.transpose() * relative * q0;
        let rate = logarithm(&local).ok_or(status::INCREMENT_TOO_LARGE)?;
        Ok(Step { relative, q0, q1, local, rate, jacobian: 0.5 * (j0 + j1) })
    }

    /// ∂τ/∂L over J for a step to (1 + L) F, column by column: the strain that L adds in the axes, which turn with L as
    /// well, and the turning of the stress that is there. `None` where it does not fit the number format.
    fn step_tangent(
        &self,
        step: &Step,
        f: &Matrix3<f64>,
        stress: &[f64; 6],
        rotation: Rotation,
    ) -> Option<LinearTangent> {
        let Step { q1, local, .. } = step;
        let stress = matrix(stress);
        let cauchy = q1 * stress * q1.transpose();
        let turning = Turning::new(step, f, &self.axes, rotation)?;
        let mut tangent = LinearTangent::default();
        for (column, entries) in tangent.0.iter_mut().enumerate() {
            let mut l = Matrix3::zeros();
            l[column] = 1.0;
            let turn = turning.of(step, &l);
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

    /// From an increment of strain in a frame that the host keeps: `strain` holds the tensor components 11 22 33 12 23
    /// 31 (half the engineering shears) of the increment in the material axes, `jacobian` the volume ratio, which
    /// weighs the work (1 where it is not known).
    ///
    /// The stress comes out in that frame. The law is as good as the frame: axes that follow the host's polar rotation
    /// or spin let the stiff direction drift off the fibre.
    pub fn increment(
        &self,
        strain: &[f64; 6],
        jacobian: f64,
        state: &[f64; LINEAR_ELASTIC_STATE],
        criterion: Criterion,
    ) -> LinearPoint {
        if !Failure::intact(state[LINEAR_FAILED]) {
            return self.failed(state);
        }
        if !strain.iter().all(|x| x.is_finite()) || !jacobian.is_finite() {
            return self.refused(state, status::NOT_FINITE);
        }
        if !state[..LINEAR_ALIVE].iter().all(|x| x.is_finite()) {
            return self.refused(state, status::STATE_NOT_FINITE);
        }
        let mut new = *state;
        let mut work = 0.0;
        for i in 0..6 {
            let engineering = if i < 3 { strain[i] } else { 2.0 * strain[i] };
            let old = state[LINEAR_STRESS + i];
            let stress = old + self.stiffness[i] * engineering;
            work += 0.5 * (old + stress) * engineering;
            new[LINEAR_STRESS + i] = stress;
        }
        let stress = [new[0], new[1], new[2], new[3], new[4], new[5]];
        let largest = largest_principal(&stress);
        new[LINEAR_LARGEST] = largest;
        new[LINEAR_WORK] += work * jacobian;
        let measure = match criterion {
            Criterion::LargestPrincipal => largest,
            Criterion::FibreStress => stress[0],
        };
        let fails = self.limit > 0.0 && measure >= self.limit;
        new[LINEAR_FAILED] = if fails { 1.0 } else { 0.0 };
        new[LINEAR_ALIVE] = 1.0 - new[LINEAR_FAILED];
        if !new.iter().all(|x| x.is_finite()) {
            return self.refused(state, status::OVERFLOW);
        }
        LinearPoint { stress, state: new, status: status::OK }
    }

    /// ρ0 c² for a bound c of the wave speed where the material is not stressed: with Q = G(1 + n⊗n) + diag((E_i − 2G) n_i²)
    /// no eigenvalue exceeds the largest of E_i and 2G.
    pub fn wave_modulus(&self) -> f64 {
        self.stiffness[0].max(self.stiffness[1]).max(2.0 * self.stiffness[3])
    }

    /// A point that failed in an earlier call: no stress, the rest as it was.
    fn failed(&self, state: &[f64; LINEAR_ELASTIC_STATE]) -> LinearPoint {
        let mut point = self.refused(state, status::OK);
        for x in &mut point.state[LINEAR_STRESS..LINEAR_LARGEST] {
            *x = 0.0;
        }
        point
    }

    /// A point that cannot be evaluated: no stress, the old state, less what is not finite in it; the latch is 0 or 1.
    fn refused(&self, state: &[f64; LINEAR_ELASTIC_STATE], status: i32) -> LinearPoint {
        let finite = state[..LINEAR_ALIVE].iter().all(|x| x.is_finite());
        let mut new = state.map(|x| if x.is_finite() { x } else { 0.0 });
        new[LINEAR_FAILED] = if !Failure::intact(state[LINEAR_FAILED]) { 1.0 } else { 0.0 };
        new[LINEAR_ALIVE] = 1.0 - new[LINEAR_FAILED];
        let status = if !finite && status == status::OK { status::STATE_NOT_FINITE } else { status };
        LinearPoint { stress: [0.0; 6], state: new, status }
    }
}

/// The kinematics of a step.
struct Step {
    /// F1 F0⁻¹.
    relative: Matrix3<f64>,
    /// The material axes at both ends, as columns.
    q0: Matrix3<f64>,
    q1: Matrix3<f64>,
    /// Q1ᵀ F1 F0⁻¹ Q0 and its logarithm.
    local: Matrix3<f64>,
    rate: Matrix3<f64>,
    /// J in the middle.
    jacobian: f64,
}

/// The spin of a step by the midpoint rule.
struct HalfSpin {
    /// Half the gradient of the increment at the middle of the step, (f − 1)(f + 1)⁻¹, and what of it is (f + 1)⁻¹.
    gradient: Matrix3<f64>,
    middle: Matrix3<f64>,
    /// Its skew part w, which turns a rigid step exactly by (1 − w)⁻¹(1 + w), and (1 − w)⁻¹.
    half: Matrix3<f64>,
    forward: Matrix3<f64>,
}

impl HalfSpin {
    fn new(relative: &Matrix3<f64>) -> Option<Self> {
        let middle = (relative + Matrix3::identity()).try_inverse()?;
        let gradient = (relative - Matrix3::identity()) * middle;
        let half = (gradient - gradient.transpose()) * 0.5;
        let forward = (Matrix3::identity() - half).try_inverse()?;
        Some(HalfSpin { gradient, middle, half, forward })
    }
}

/// What the turning of the material axes by a motion needs: dQ1 = Q1 Ω, with Ω linear in L.
enum Turning {
    Fibre,
    /// Reference axes, R, U and (tr U 1 − U)⁻¹.
    Polar(Matrix3<f64>, Matrix3<f64>, Matrix3<f64>, Matrix3<f64>),
    Spin(HalfSpin),
}

impl Turning {
    fn new(step: &Step, f: &Matrix3<f64>, axes: &Matrix3<f64>, rotation: Rotation) -> Option<Self> {
        Some(match rotation {
            Rotation::Fibre => Turning::Fibre,
            Rotation::Polar => {
                let r = step.q1 * axes.transpose();
                let u = r.transpose() * f;
                let u = (u + u.transpose()) * 0.5;
                let inverse = (Matrix3::identity() * u.trace() - u).try_inverse()?;
                Turning::Polar(*axes, r, u, inverse)
            }
            Rotation::Spin => Turning::Spin(HalfSpin::new(&step.relative)?),
        })
    }

    /// Ω of the motion L.
    fn of(&self, step: &Step, l: &Matrix3<f64>) -> Matrix3<f64> {
        let seen = step.q1.transpose() * l * step.q1;
        match self {
            // e1 follows L e1; e3 is normal to L e1 and L e2: what is below the diagonal turns the axes.
            Turning::Fibre => skew(&Vector3::new(seen.m32, -seen.m31, seen.m21)),
            // Θ U + U Θ is the skew part of RᵀL R U, twice; in axial vectors that is (tr U 1 − U) θ.
            Turning::Polar(axes, r, u, inverse) => {
                let moved = r.transpose() * l * r * u;
                let twice = Vector3::new(moved.m32 - moved.m23, moved.m13 - moved.m31, moved.m21 - moved.m12);
                axes.transpose() * skew(&(inverse * twice)) * axes
            }
            Turning::Spin(HalfSpin { gradient, middle, forward, .. }) => {
                let moved = (Matrix3::identity() - gradient) * l * step.relative * middle;
                let half = (moved - moved.transpose()) * 0.5;
                let back = forward.transpose(); // (1 + w)⁻¹
                step.q1.transpose() * forward * half * back * step.q1 * 2.0
            }
        }
    }
}

/// The skew matrix of an axial vector.
fn skew(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// How the stress at the end of a step answers to a further motion: ∂τ_ij/∂L_kl over J for F moved to (1 + L) F. Columns of L
/// 11 21 31 12 22 32 13 23 33, each with the stress 11 22 33 12 23 31.
///
/// It is not symmetric, and with [`Rotation::Spin`], whose axes depend on the step, not that of an objective rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearTangent(pub [[f64; 6]; 9]);

impl LinearTangent {
    /// The matrix of a 6×6 measure, row by row, at the deformation gradient `f` and the Cauchy stress of the step's end;
    /// `None` for [`Measure::Nominal`], and where F has no inverse.
    ///
    /// [`Measure::Jaumann`] is DDSDDE: a motion of symmetric L and no spin.
    pub fn matrix(&self, measure: Measure, f: &Matrix3<f64>, cauchy: &[f64; 6]) -> Option<[[f64; 6]; 6]> {
        let mut jaumann = [[0.0; 6]; 6];
        for (column, (k, l)) in PAIRS.into_iter().enumerate() {
            for (row, entries) in jaumann.iter_mut().enumerate() {
                // An engineering shear is half a motion each way.
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

/// The axes that follow the fibre: F m, and F n less its part along it.
fn fibre_axes(f: &Matrix3<f64>, axes: &Matrix3<f64>) -> Matrix3<f64> {
    let first = f * axes.column(0);
    let e1 = first / first.norm();
    let second = f * axes.column(1);
    let across = second - e1 * e1.dot(&second);
    let e2 = across / across.norm();
    Matrix3::from_columns(&[e1, e2, e1.cross(&e2)])
}

/// The rotation R of F = R U, det F > 0, by Newton's iteration X ← ½(X + X⁻ᵀ) with the determinant as its scale.
fn polar_rotation(f: &Matrix3<f64>) -> Matrix3<f64> {
    let mut x = *f;
    // Quadratic once near; the scale brings any stretch near within a few steps.
    for _ in 0..20 {
        let Some(inverse) = x.try_inverse() else { break };
        let dual = inverse.transpose();
        let ratio = libm::sqrt(libm::sqrt(dual.norm_squared() / x.norm_squared()));
        let next = (x * ratio + dual / ratio) * 0.5;
        let change = (next - x).norm_squared();
        x = next;
        if change <= 1e-33 {
            break;
        }
    }
    x
}

/// ln A of a matrix near enough to the identity, as 2 artanh((A − 1)(A + 1)⁻¹); `None` where the series does not settle.
fn logarithm(a: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    const TERMS: i32 = 120;
    let identity = Matrix3::identity();
    let y = (a - identity) * (a + identity).try_inverse()?;
    let square = y * y;
    let mut power = y;
    let mut sum = y;
    for k in 1..TERMS {
        power *= square;
        let term = power / f64::from(2 * k + 1);
        sum += term;
        if term.norm_squared() <= 1e-34 * sum.norm_squared() {
            return Some(sum * 2.0);
        }
    }
    None
}

/// The derivative of [`logarithm`] at A along `da`, term by term.
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

/// The largest eigenvalue of a symmetric tensor 11 22 33 12 23 31.
fn largest_principal(s: &[f64; 6]) -> f64 {
    let [a, b, c] = principal_axes(s).0;
    a.max(b).max(c)
}
