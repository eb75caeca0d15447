//! The linear elastic orthotropic law in common use (thesis, section 4.1), with which the yarn law is compared.
//!
//! An objective rate of the Cauchy stress is ℂ : ε̇, with ℂ = diag(E1, E2, E2, G, G, G) on (ε̇11, ε̇22, ε̇33, 2ε̇12,
//! 2ε̇23, 2ε̇31) in a material frame and zero Poisson ratios. The choice of the frame has a large effect, since the
//! shear stiffness is 1/630 of that of the fibre: see [`Rotation`]. In the frame the stress is the sum of ℂ times the
//! strain increments; an increment is the symmetric part of ln(Q1ᵀ F1 F0⁻¹ Q0), so that a stretch along the fibre gives
//! E1 ln λ in any number of steps.
//!
//! A small increment keeps its digits: Q1ᵀ F1 F0⁻¹ Q0 − 1 is computed as the sum of Q1ᵀ (F1 − F0) F0⁻¹ Q0 and Q1ᵀ Q0 −
//! 1, the rotation of the axes, whose symmetric part is −½ (Q1 − Q0)ᵀ(Q1 − Q0). So the rounding of F and Q relative to
//! 1 does not enter the strain.

use nalgebra::Matrix3;

use super::axes::FibreFrame;
use super::error::Error;
use super::failure::Failure;
use super::number::real::Real;
use super::number::vector::{
    Matrix, along, cofactors, cross, difference, dot, image, is_finite, product, scale, scaled, select, selected,
    square_norm, sum, transposed, unit,
};
use super::resistance::Resistance;
use super::state::{LINEAR_ALIVE, LINEAR_ELASTIC_STATE, LINEAR_FAILED, LINEAR_LARGEST, LINEAR_STRESS, LINEAR_WORK};
use super::status;
use super::stress::{largest_principal, turned};

/// The material frame in which the stress is accumulated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rotation {
    /// The first axis follows the fibre, the second one is F n made orthogonal to it: the frame of a yarn.
    #[default]
    Fibre,
    /// The rotation R of F = R U: in shear the stiff direction deviates from the fibre.
    Polar,
    /// The spin, integrated step by step (Jaumann rate, midpoint rule of Hughes and Winget): the caller stores the
    /// axes.
    Spin,
}

/// The stress that is compared with σ_lim.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Criterion {
    /// The largest signed principal Cauchy stress, shears included.
    #[default]
    LargestPrincipal,
    /// The Cauchy stress along the material's first axis.
    FibreStress,
}

/// The properties by name, in any one consistent system of units. Hosts pass the same numbers as an array, in the order
/// of [`parameters::LINEAR_ELASTIC`](super::parameters::LINEAR_ELASTIC), which also gives their bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties<T> {
    /// Young's moduli along and across the fibre, stresses.
    pub e_1: T,
    pub e_2: T,
    /// Shear modulus, a stress.
    pub g: T,
    /// Stress at failure; 0: the yarn does not fail.
    pub sigma_lim: T,
    /// Fibre direction in the reference placement, of any length.
    pub fibre: [T; 3],
    /// Second axis, made orthogonal to the fibre, of any length; 0: any axis across the fibre.
    pub second_axis: [T; 3],
}

/// The linear elastic law: its properties, checked, and its axes.
#[derive(Clone, Copy, Debug)]
pub struct LinearElastic<R = f64> {
    pub(super) stiffness: [R; 6],
    pub(super) limit: R,
    /// Columns: fibre, second axis, third axis in the reference placement.
    pub(super) axes: Matrix<R>,
    /// The second axis of the properties as a unit vector; 0 if any will do.
    pub(super) second_axis: [R; 3],
}

/// The results of the law at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearPoint {
    /// Cauchy stress 11 22 33 12 23 31: in global axes from [`step`](LinearElastic::step), in the material frame from
    /// [`increment`](LinearElastic::increment).
    pub stress: [f64; 6],
    /// The new state, in the order of [`state::LINEAR_ELASTIC`](super::state::LINEAR_ELASTIC).
    pub state: [f64; LINEAR_ELASTIC_STATE],
    /// 0, or the [`status`] code of the reason why the point could not be evaluated; then the stress is 0 and
    /// the state is the old one.
    pub status: i32,
}

/// The results that a caller requests besides the status.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    pub stress: bool,
    pub state: bool,
    pub wave_modulus: bool,
}

impl Wanted {
    pub const STRESS_AND_STATE: Wanted = Wanted { stress: true, state: true, wave_modulus: false };
}

/// The results of the law for the points in the lanes of `R`.
pub(super) struct Answer<R: Real> {
    pub stress: [R; 6],
    pub state: [R; LINEAR_ELASTIC_STATE],
    /// ρ0 c² for an upper bound c of the wave speed at the end of the step.
    pub wave_modulus: R,
    /// The material axes that the caller has passed, and those at both ends of the step, as columns.
    pub axes: Matrix<R>,
    pub q0: Matrix<R>,
    pub q1: Matrix<R>,
    pub status: R,
    /// Where the step has been taken: the point has not failed before and can be evaluated.
    pub taken: R::Mask,
}

impl LinearElastic {
    /// The material axes in the reference placement, as columns; the initial axes for [`Rotation::Spin`].
    pub fn reference_axes(&self) -> Matrix3<f64> {
        self.axes.into()
    }

    /// The same law with other material axes, for a point of a crimped yarn: its fibre direction, and its second axis,
    /// or `None` for that of the properties; both of any length, the second axis 0 if any will do.
    ///
    /// # Errors
    /// A direction that has no length or is not finite, or a second axis along the fibre.
    pub fn along(&self, fibre: [f64; 3], second_axis: Option<[f64; 3]>) -> Result<Self, Error> {
        let (axes, usable) = self.axes_along(fibre, second_axis);
        if !usable {
            return Err(Error::Plain(status::FIBRE_DIRECTION));
        }
        Ok(LinearElastic { axes, ..*self })
    }

    /// One step, from the deformation gradient `f0` and the old state to the deformation gradient `f1`.
    ///
    /// `axes`, the material axes in space as columns, is read and updated for [`Rotation::Spin`] only (start with
    /// [`reference_axes`](Self::reference_axes); axes that are not orthonormal are refused); the other frames follow
    /// from F.
    pub fn step(
        &self,
        f0: &Matrix3<f64>,
        f1: &Matrix3<f64>,
        state: &[f64; LINEAR_ELASTIC_STATE],
        rotation: Rotation,
        criterion: Criterion,
        axes: &mut Matrix3<f64>,
    ) -> LinearPoint {
        let columns = (*axes).into();
        let step = Step { f0: &(*f0).into(), f1: &(*f1).into(), axes: &columns, limit: None, rotation, criterion };
        let answer = self.respond(step, &self.axes, true, state, Wanted::STRESS_AND_STATE);
        if rotation == Rotation::Spin {
            *axes = answer.q1.into();
        }
        answer.point()
    }

    /// One step, from a strain increment in a material frame that the host keeps: `strain` holds its tensor components
    /// 11 22 33 12 23 31 (half the engineering shears), `jacobian` is the volume ratio, by which the work is multiplied
    /// (1 if it is not known).
    ///
    /// The stress is returned in that frame. Its accuracy depends on the frame: if the axes follow the host's polar
    /// rotation or spin, the stiff direction deviates from a sheared fibre.
    pub fn increment(
        &self,
        strain: &[f64; 6],
        jacobian: f64,
        state: &[f64; LINEAR_ELASTIC_STATE],
        criterion: Criterion,
    ) -> LinearPoint {
        let (stress, new) = self.advance(strain, jacobian, state, (criterion, self.limit), Wanted::STRESS_AND_STATE);
        let nowhere = [[0.0; 3]; 3];
        let wave_modulus = self.wave_modulus();
        let mut answer = Answer {
            stress,
            state: new,
            wave_modulus,
            axes: nowhere,
            q0: nowhere,
            q1: nowhere,
            status: 0.0,
            taken: true,
        };
        let finite = strain.iter().all(|x| x.is_finite()) && jacobian.is_finite();
        answer.taken = finite & answer.sound(state);
        if !answer.taken {
            answer.keep(state, if finite { 0.0 } else { f64::from(status::NOT_FINITE) });
        }
        answer.point()
    }

    /// The results at a point that keeps its old state, with the status of the reason.
    pub(crate) fn kept(&self, state: &[f64; LINEAR_ELASTIC_STATE], why: i32) -> LinearPoint {
        let nowhere = [[0.0; 3]; 3];
        let (wave_modulus, stress) = (self.wave_modulus(), [0.0; 6]);
        let mut answer = Answer {
            stress,
            state: *state,
            wave_modulus,
            axes: nowhere,
            q0: nowhere,
            q1: nowhere,
            status: 0.0,
            taken: false,
        };
        answer.keep(state, f64::from(why));
        answer.point()
    }

    /// ρ0 c² for an upper bound c of the wave speed in the unstressed material.
    pub fn wave_modulus(&self) -> f64 {
        self.modulus_at_rest()
    }
}

/// What a step does to the material axes, and the strain increment in them.
struct Motion<R: Real> {
    /// The material axes at both ends, as columns.
    q0: Matrix<R>,
    q1: Matrix<R>,
    strain: [R; 6],
    /// The mean of det F at both ends.
    jacobian: R,
    /// Where the logarithm has been computed.
    converged: R::Mask,
}

/// The arguments of a step.
#[derive(Clone, Copy)]
pub(super) struct Step<'a, R> {
    /// Columns of F at both ends.
    pub f0: &'a Matrix<R>,
    pub f1: &'a Matrix<R>,
    /// The material axes in space at the start, orthonormal; read for [`Rotation::Spin`] only.
    pub axes: &'a Matrix<R>,
    /// The strength of a point that has one of its own; `None` or 0 for that of the properties.
    pub limit: Option<R>,
    pub rotation: Rotation,
    pub criterion: Criterion,
}

impl<R: Real> LinearElastic<R> {
    /// Bulk and shear modulus of an isotropic solid whose longitudinal wave speed is the greatest one at rest: K + 4G/3
    /// is the largest of E1, E2 and 2G. For hosts that compute their time step and contact stiffness from two elastic
    /// constants.
    pub fn bulk_and_shear(&self) -> [R; 2] {
        let modulus = self.modulus_at_rest();
        [R::splat(0.5) * modulus, R::splat(0.375) * modulus]
    }

    /// What resists the motions of an element.
    pub(crate) fn resistance(&self) -> Resistance
    where
        R: Into<f64>,
    {
        let [_, e_2, _, g, ..] = self.stiffness;
        let (e_2, g): (f64, f64) = (e_2.into(), g.into());
        Resistance { along: self.modulus_at_rest().into(), across: e_2, shape: g, hourglass: e_2 }
    }

    /// With Q = G(1 + n⊗n) + diag((E_i − 2G) n_i²) no eigenvalue exceeds the largest of E_i and 2G.
    #[inline(always)]
    fn modulus_at_rest(&self) -> R {
        let [e_1, e_2, _, g, ..] = self.stiffness;
        e_1.max(e_2).max(g + g)
    }

    /// ρ0 c² for an upper bound c of the wave speed, given J and the Cauchy stress.
    ///
    /// For a wave of direction ξ and polarisation u, unit vectors, the rate of the stress is ℂ : ε̇ + Ωσ − σΩ with the
    /// spin Ω of the material frame, and the terms of the change of area and volume cancel, so that ρ c² = u·(ℂ : ε̇ +
    /// Ωσ − σΩ)ξ. Ω has an axial vector of at most unit length in every one of the frames, so that its terms are at
    /// most twice the largest principal stress by its size.
    #[inline(always)]
    fn wave_modulus_at(&self, jacobian: R, stress: &[R; 6]) -> R {
        let [s_11, s_22, s_33, s_12, s_23, s_31] = *stress;
        // The largest sum of a row: no square, which might overflow, and exact for a stress along an axis.
        let row = |a: R, b: R, c: R| a.abs() + b.abs() + c.abs();
        let size = row(s_11, s_12, s_31).max(row(s_12, s_22, s_23)).max(row(s_31, s_23, s_33));
        let at_rest = self.modulus_at_rest();
        (jacobian * (at_rest + (size + size))).max(at_rest)
    }

    /// The material axes for a fibre direction, and for a second axis, or that of the properties; and where they are
    /// usable.
    #[inline(always)]
    pub(super) fn axes_along(&self, fibre: [R; 3], second_axis: Option<[R; 3]>) -> (Matrix<R>, R::Mask) {
        let (frame, usable) = FibreFrame::new(fibre);
        let (axes, apart) = axes_of(&frame, second_axis.unwrap_or(self.second_axis));
        (axes, usable & apart)
    }

    /// The motion of a step, of the points in `able`, given det F0 and its cofactors, and det F1. `reference` holds
    /// their material axes in the reference placement.
    #[inline(always)]
    fn motion(
        step: &Step<'_, R>,
        reference: &Matrix<R>,
        able: R::Mask,
        (j0, minors): &(R, Matrix<R>),
        j1: R,
    ) -> Motion<R> {
        let (half, Step { f0, f1, axes, .. }) = (R::splat(0.5), step);
        // F1 F0⁻¹ − 1.
        let inverse = j0.reciprocal();
        let change = product(&difference(f1, f0), &transposed(minors));
        let change = scaled(inverse, &change);
        let (q0, q1) = match step.rotation {
            Rotation::Fibre => (fibre_axes(f0, reference), fibre_axes(f1, reference)),
            Rotation::Polar => {
                let (r0, r1) = (polar_rotation(f0, able), polar_rotation(f1, able));
                (product(&r0, reference), product(&r1, reference))
            }
            Rotation::Spin => (**axes, rotated_by_spin(axes, &change)),
        };
        let turn = difference(&q1, &q0);
        let back = transposed(&q1);
        let [skew, square] = [product(&back, &turn), product(&transposed(&turn), &turn)];
        let local = sum(&product(&back, &product(&change, &q0)), -half, &square);
        let local = sum(&local, half, &difference(&transposed(&skew), &skew));
        let (rate, converged) = logarithm(&local, able);
        let strain = [
            rate[0][0],
            rate[1][1],
            rate[2][2],
            half * (rate[0][1] + rate[1][0]),
            half * (rate[1][2] + rate[2][1]),
            half * (rate[2][0] + rate[0][2]),
        ];
        Motion { q0, q1, strain, jacobian: half * (*j0 + j1), converged }
    }

    /// The Cauchy stress, in global axes, at the end of a step of a point that takes it.
    #[inline(always)]
    pub(super) fn stress(&self, step: &Step<'_, R>, reference: &Matrix<R>, old: &[R; LINEAR_ELASTIC_STATE]) -> [R; 6] {
        let wanted = Wanted { stress: true, state: false, wave_modulus: false };
        let (everywhere, (j1, _)) = (R::splat(0.0).le(R::splat(0.0)), cofactors(step.f1));
        let motion = Self::motion(step, reference, everywhere, &cofactors(step.f0), j1);
        let (stress, _) = self.advance(&motion.strain, motion.jacobian, old, (step.criterion, self.limit), wanted);
        turned(&motion.q1, &stress)
    }

    /// One step for the points in the lanes. `reference` holds their material axes in the reference placement, `usable`
    /// says where there are such axes.
    #[inline(always)]
    pub(super) fn respond(
        &self,
        step: Step<'_, R>,
        reference: &Matrix<R>,
        usable: R::Mask,
        old: &[R; LINEAR_ELASTIC_STATE],
        wanted: Wanted,
    ) -> Answer<R> {
        let Step { f0, f1, axes, limit, rotation, criterion } = step;
        let zero = R::splat(0.0);
        let ((j0, minors), (j1, _)) = (cofactors(f0), cofactors(f1));
        let upright = zero.lt(j0) & zero.lt(j1);
        let (start, usable, unusable) = match rotation {
            Rotation::Spin => {
                let (start, near) = orthonormal(axes);
                (start, near, status::MATERIAL_AXES)
            }
            Rotation::Fibre | Rotation::Polar => (*axes, usable, status::FIBRE_DIRECTION),
        };
        let (strength, may_have) = match limit {
            Some(limit) => (R::select(zero.lt(limit), limit, self.limit), Failure::is_limit(limit)),
            None => (self.limit, zero.le(zero)),
        };
        let able = upright & usable & may_have & Failure::intact(old[LINEAR_FAILED]);
        let Motion { q0, q1, strain, jacobian, converged } =
            Self::motion(&Step { axes: &start, ..step }, reference, able, &(j0, minors), j1);
        let (stress, state) = self.advance(&strain, jacobian, old, (criterion, strength), wanted);
        // Its size is the same in the material axes.
        let wave_modulus = if wanted.wave_modulus { self.wave_modulus_at(j1, &stress) } else { zero };
        let stress = if wanted.stress { turned(&q1, &stress) } else { stress };
        let mut answer = Answer { stress, state, wave_modulus, axes: *axes, q0, q1, status: zero, taken: able };
        // If squares of lengths overflow, there are no axes; if a determinant does, its reciprocal is not the same in
        // all lanes.
        let in_range = (square_norm(f0) + square_norm(f1) + (j0.abs() + j1.abs())).lt(R::splat(f64::INFINITY));
        answer.taken = upright & usable & may_have & converged & in_range & answer.sound(old);
        answer.taken = answer.taken & wave_modulus.lt(R::splat(f64::INFINITY));
        if R::any(!answer.taken) {
            let code = |code: i32| R::splat(f64::from(code));
            let why = R::select(converged, zero, code(status::INCREMENT_TOO_LARGE));
            let why = R::select(in_range, why, code(status::OVERFLOW));
            let why = R::select(upright, why, code(status::INVERTED));
            let why = R::select(may_have, why, code(status::LIMIT));
            let why = R::select(usable, why, code(unusable));
            let finite = is_finite(f0) & is_finite(f1);
            answer.keep(old, R::select(finite, why, code(status::NOT_FINITE)));
            answer.wave_modulus = R::select(answer.taken, answer.wave_modulus, self.modulus_at_rest());
        }
        answer
    }

    /// The stress in the material axes and the new state, given the strain increment (tensor components) in these axes.
    #[inline(always)]
    fn advance(
        &self,
        strain: &[R; 6],
        jacobian: R,
        old: &[R; LINEAR_ELASTIC_STATE],
        (criterion, limit): (Criterion, R),
        wanted: Wanted,
    ) -> ([R; 6], [R; LINEAR_ELASTIC_STATE]) {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let (mut stress, mut twice_work) = ([zero; 6], zero);
        for i in 0..6 {
            let engineering = if i < 3 { strain[i] } else { strain[i] + strain[i] };
            stress[i] = self.stiffness[i].mul_add(engineering, old[LINEAR_STRESS + i]);
            twice_work = (old[LINEAR_STRESS + i] + stress[i]).mul_add(engineering, twice_work);
        }
        let [s_11, s_22, s_33, s_12, s_23, s_31] = stress;
        let largest = if wanted.state { largest_principal(&stress) } else { zero };
        let measure = match criterion {
            Criterion::LargestPrincipal => largest,
            Criterion::FibreStress => s_11,
        };
        let work = (R::splat(0.5) * jacobian).mul_add(twice_work, old[LINEAR_WORK]);
        // Without a new state no point fails.
        let reached = zero.lt(limit) & limit.le(measure);
        let failed = if wanted.state { R::select(reached, one, zero) } else { zero };
        (stress, [s_11, s_22, s_33, s_12, s_23, s_31, largest, work, failed, one - failed])
    }
}

impl<R: Real> Answer<R> {
    /// Where a point has not failed before and all its results are finite.
    #[inline(always)]
    fn sound(&self, old: &[R; LINEAR_ELASTIC_STATE]) -> R::Mask {
        let zero = R::splat(0.0);
        let mut probe = old[LINEAR_LARGEST] * zero;
        for &x in &self.state[..LINEAR_FAILED] {
            probe = x.mul_add(zero, probe);
        }
        Failure::intact(old[LINEAR_FAILED]) & probe.le(zero)
    }

    /// For the points that have not taken the step: sets the stress to 0, restores the old state with 0 in place of
    /// what is not finite, and sets the status. That is `why`, unless it is 0 or the point has failed before; then the
    /// code of an old state that is not finite; then 0 for a point that has failed before, and else that of an
    /// overflow.
    #[inline(always)]
    pub fn keep(&mut self, old: &[R; LINEAR_ELASTIC_STATE], why: R) {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let (taken, intact) = (self.taken, Failure::intact(old[LINEAR_FAILED]));
        let mut lost = zero.lt(zero);
        for (c, &old) in old.iter().enumerate().take(LINEAR_ALIVE) {
            let finite = (old * zero).le(zero);
            lost = lost | !finite;
            let carried = if c < LINEAR_LARGEST { finite & intact } else { finite };
            self.state[c] = R::select(taken, self.state[c], R::select(carried, old, zero));
        }
        let latch = R::select(intact, zero, one);
        self.state[LINEAR_FAILED] = R::select(taken, self.state[LINEAR_FAILED], latch);
        self.state[LINEAR_ALIVE] = one - self.state[LINEAR_FAILED];
        for stress in &mut self.stress {
            *stress = R::select(taken, *stress, zero);
        }
        self.q1 = selected(taken, &self.q1, &self.axes);
        let overflow = R::select(intact, R::splat(f64::from(status::OVERFLOW)), zero);
        let of_state = R::select(lost, R::splat(f64::from(status::STATE_NOT_FINITE)), overflow);
        let code = R::select(intact & why.lt(zero), why, of_state);
        self.status = R::select(taken, zero, code);
    }
}

impl Answer<f64> {
    pub fn point(&self) -> LinearPoint {
        LinearPoint { stress: self.stress, state: self.state, status: self.status as i32 }
    }
}

/// The material axes from the frame of the fibre direction and a second axis of any length, made orthogonal to the
/// fibre, or 0 if any will do; and where that axis is usable.
#[inline(always)]
pub(super) fn axes_of<R: Real>(frame: &FibreFrame<R>, second: [R; 3]) -> (Matrix<R>, R::Mask) {
    let zero = R::splat(0.0);
    // A sum, so that a NaN does not count as 0.
    let any = (second[0].abs() + second[1].abs() + second[2].abs()).le(zero);
    let (n, usable) = FibreFrame::new(second);
    let across = along(n.m, -dot(frame.m, n.m), frame.m);
    let (n, apart) = FibreFrame::new(across);
    let square = dot(across, across);
    let usable = usable & apart & R::splat(1e-6).lt(square);
    // Of an axis near the fibre the difference has few digits, so that it is made orthogonal once more.
    let once_more = along(n.m, -dot(frame.m, n.m), frame.m);
    let second = select(square.lt(R::splat(1.0 / 16.0)), once_more, n.m);
    let chosen = [frame.m, second, cross(frame.m, second)];
    (selected(any, &[frame.m, frame.t1, frame.t2], &chosen), any | usable)
}

/// The axes that a caller keeps, made orthonormal, Q (3 − QᵀQ)/2, and where they are nearly so before. The roundings of
/// a step may lengthen the axes by as much in every step (in single precision by 7e-8), which without the correction
/// would add up.
#[inline(always)]
fn orthonormal<R: Real>([a, b, c]: &Matrix<R>) -> (Matrix<R>, R::Mask) {
    /// The most that the norm of QᵀQ − 1 may be: more than what roundings do to corrected axes, or three digits to
    /// those of a text file. The correction leaves less than its square.
    const DRIFT: f64 = 0.01;
    let (one, half) = (R::splat(1.0), R::splat(-0.5));
    let lengths = [dot(*a, *a) - one, dot(*b, *b) - one, dot(*c, *c) - one];
    let angles = [dot(*a, *b), dot(*b, *c), dot(*c, *a)];
    let once = dot(angles, angles);
    let near = (dot(lengths, lengths) + (once + once)).lt(R::splat(DRIFT * DRIFT));
    let ([aa, bb, cc], [ab, bc, ca]) = (scale(half, lengths), scale(half, angles));
    let corrected = |v: [R; 3], by_a: R, by_b: R, by_c: R| along(along(along(v, by_a, *a), by_b, *b), by_c, *c);
    ([corrected(*a, aa, ab, ca), corrected(*b, ab, bb, bc), corrected(*c, ca, bc, cc)], near)
}

/// The axes that follow the fibre: F m and F n made orthonormal in this order, and their vector product.
#[inline(always)]
fn fibre_axes<R: Real>(f: &Matrix<R>, axes: &Matrix<R>) -> Matrix<R> {
    let (e1, second) = (unit(image(f, axes[0])), image(f, axes[1]));
    let e2 = unit(along(second, -dot(e1, second), e1));
    [e1, e2, cross(e1, e2)]
}

/// The axes rotated by the spin of the increment 1 + X, by the midpoint rule: with w the skew part of X (2 + X)⁻¹ the
/// rotation is (1 − w)⁻¹(1 + w) = 1 + 2 (w + w²)/(1 + |w|²), |w| the length of its axial vector, which is exact for a
/// rigid step.
#[inline(always)]
fn rotated_by_spin<R: Real>(axes: &Matrix<R>, increment: &Matrix<R>) -> Matrix<R> {
    let g = half_gradient(increment);
    let w = scale(R::splat(0.5), [g[1][2] - g[2][1], g[2][0] - g[0][2], g[0][1] - g[1][0]]);
    let factor = R::splat(2.0) / (R::splat(1.0) + dot(w, w));
    let once = [cross(w, axes[0]), cross(w, axes[1]), cross(w, axes[2])];
    let twice = [cross(w, once[0]), cross(w, once[1]), cross(w, once[2])];
    sum(&sum(axes, factor, &once), factor, &twice)
}

/// The rotation R of F = R U of the points in `able`, where det F > 0, by Newton's iteration X ← ½(γX + X⁻ᵀ/γ). γ² is
/// the ratio of the norms, or 1 once X is near R, where scaling would only add a rounding (Higham, SIAM J. Sci. Stat.
/// Comput. 7, 1986).
#[inline(always)]
fn polar_rotation<R: Real>(f: &Matrix<R>, able: R::Mask) -> Matrix<R> {
    /// With the scaling a few steps suffice for any stretch.
    const STEPS: usize = 20;
    const NEAR: f64 = 0.01;
    let (half, one) = (R::splat(0.5), R::splat(1.0));
    let (mut x, mut active) = (*f, able);
    for _ in 0..STEPS {
        if !R::any(active) {
            break;
        }
        let (determinant, minors) = cofactors(&x);
        let dual = scaled(determinant.reciprocal(), &minors);
        let gap = square_norm(&difference(&x, &dual));
        let ratio = (square_norm(&dual) / square_norm(&x)).sqrt().sqrt();
        let ratio = R::select(gap.lt(R::splat(NEAR)), one, ratio);
        let next = sum(&scaled(half * ratio, &x), half / ratio, &dual);
        x = selected(active, &next, &x);
        // Convergence is quadratic: the error that is left is below the square of the gap.
        active = active & R::splat(R::EPSILON).lt(gap);
    }
    x
}

/// Half the gradient of the increment 1 + X at the middle of the step: X (2 + X)⁻¹.
#[inline(always)]
fn half_gradient<R: Real>(x: &Matrix<R>) -> Matrix<R> {
    let two = R::splat(2.0);
    let [a, b, c] = *x;
    let (determinant, minors) =
        cofactors(&[[a[0] + two, a[1], a[2]], [b[0], b[1] + two, b[2]], [c[0], c[1], c[2] + two]]);
    let g = product(x, &transposed(&minors));
    scaled(determinant.reciprocal(), &g)
}

/// ln(1 + X) as 2 artanh(X (2 + X)⁻¹), and where the series has converged. Only the points in `able` determine the
/// number of terms.
#[inline(always)]
fn logarithm<R: Real>(x: &Matrix<R>, able: R::Mask) -> (Matrix<R>, R::Mask) {
    const TERMS: i32 = 120;
    /// A squared norm of X far above that of any step that converges; beyond, (2 + X)⁻¹ has too few correct digits.
    const LARGEST: f64 = 1e6;
    let y = half_gradient(x);
    let square = product(&y, &y);
    let growth = square_norm(&square);
    let size = square_norm(&y);
    // Squares of norms. The series ends, at each point separately, with the first term that cannot change the sum by a
    // sixteenth of a rounding.
    let negligible = R::splat(R::EPSILON * R::EPSILON / 256.0) * size;
    let (mut power, mut series) = (y, y);
    let mut next = size * growth;
    let mut active = able & negligible.lt(next);
    for k in 1..TERMS {
        if !R::any(active) {
            break;
        }
        let factor = R::splat(1.0 / f64::from(2 * k + 1));
        power = product(&power, &square);
        series = sum(&series, R::select(active, factor, R::splat(0.0)), &power);
        next = R::select(active, factor * factor * square_norm(&power) * growth, next);
        active = active & negligible.lt(next);
    }
    let converged = next.le(negligible) & next.lt(R::splat(f64::INFINITY)) & square_norm(x).lt(R::splat(LARGEST));
    (scaled(R::splat(2.0), &series), converged)
}
