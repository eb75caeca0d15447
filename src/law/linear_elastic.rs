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
use super::stress::{components, matrix};
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
        if !Failure::intact(state[LINEAR_FAILED]) {
            return self.failed(state);
        }
        if f0.iter().chain(f1.iter()).chain(axes.iter()).any(|x| !x.is_finite()) {
            return self.refused(state, status::NOT_FINITE);
        }
        let (j0, j1) = (f0.determinant(), f1.determinant());
        let (Some(inverse), true) = (f0.try_inverse(), j0 > 0.0 && j1 > 0.0) else {
            return self.refused(state, status::INVERTED);
        };
        let relative = f1 * inverse;
        let (q0, q1) = match rotation {
            Rotation::Fibre => (fibre_axes(f0, &self.axes), fibre_axes(f1, &self.axes)),
            Rotation::Polar => (polar_rotation(f0) * self.axes, polar_rotation(f1) * self.axes),
            Rotation::Spin => {
                // Half the gradient of the increment at the middle of the step: its skew part turns a rigid step
                // exactly.
                let Some(inverse) = (relative + Matrix3::identity()).try_inverse() else {
                    return self.refused(state, status::INCREMENT_TOO_LARGE);
                };
                let gradient = (relative - Matrix3::identity()) * inverse;
                let half_spin = (gradient - gradient.transpose()) * 0.5;
                let Some(inverse) = (Matrix3::identity() - half_spin).try_inverse() else {
                    return self.refused(state, status::INCREMENT_TOO_LARGE);
                };
                (*axes, inverse * (Matrix3::identity() + half_spin) * *axes)
            }
        };
        let Some(rate) = logarithm(&(q1.transpose() * relative * q0)) else {
            return self.refused(state, status::INCREMENT_TOO_LARGE);
        };
        let strain = [
            rate.m11,
            rate.m22,
            rate.m33,
            (rate.m12 + rate.m21) / 2.0,
            (rate.m23 + rate.m32) / 2.0,
            (rate.m31 + rate.m13) / 2.0,
        ];
        let mut point = self.increment(&strain, 0.5 * (j0 + j1), state, criterion);
        if point.status == status::OK {
            if rotation == Rotation::Spin {
                *axes = q1;
            }
            point.stress = components(&(q1 * matrix(&point.stress) * q1.transpose()));
        }
        point
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

/// The largest eigenvalue of a symmetric tensor 11 22 33 12 23 31, by Jacobi rotations.
fn largest_principal(s: &[f64; 6]) -> f64 {
    let [mut a, mut b, mut c, mut ab, mut bc, mut ca] = *s;
    // One rotation: annihilates pq, couples p and q to the third axis.
    let rotate = |p: &mut f64, q: &mut f64, pq: &mut f64, pr: &mut f64, qr: &mut f64| {
        if *pq == 0.0 {
            return;
        }
        let theta = (*q - *p) / (2.0 * *pq);
        let root = libm::sqrt(theta * theta + 1.0);
        let t = if theta < 0.0 { -1.0 / (root - theta) } else { 1.0 / (root + theta) };
        let cosine = 1.0 / libm::sqrt(t * t + 1.0);
        let sine = t * cosine;
        *p -= t * *pq;
        *q += t * *pq;
        *pq = 0.0;
        let (x, y) = (*pr, *qr);
        *pr = cosine * x - sine * y;
        *qr = sine * x + cosine * y;
    };
    // Quadratic convergence: six sweeps take any 3×3 matrix to rounding.
    for _ in 0..6 {
        rotate(&mut a, &mut b, &mut ab, &mut ca, &mut bc);
        rotate(&mut b, &mut c, &mut bc, &mut ab, &mut ca);
        rotate(&mut c, &mut a, &mut ca, &mut bc, &mut ab);
    }
    a.max(b).max(c)
}
