//! The yarn law: energies, stress mode by mode, from the four deformation modes (thesis, Eq. 4.6–4.15).
//!
//! ```text
//! W = ½ k_el ⟨I_el⟩²  +  k_tc ⟨−I_tc⟩^p  +  ½ k_td I_td²  +  ½ k_ld I_ld²        per reference volume
//!
//! τ = k_el ⟨I_el⟩ e⊗e  −  (p/2) k_tc ⟨−I_tc⟩^(p−1) P  +  (k_td/4)(asinh s/s) D  +  (k_ld/λ²)(P b e⊗e + e⊗P b e)
//! ```
//!
//! with P = 1 − e⊗e, b = F Fᵀ, and D, s and the invariants as [`kinematics`](super::kinematics) gives them. It is the
//! thesis's Eq. 4.14 pushed forward, without its quotient 0/0: asinh s/s is smooth through s = 0.

use nalgebra::Matrix3;

use super::elementary::{Exponent, ln_1p, power};
use super::failure::Failure;
use super::kinematics::{Decomposition, FibreFrame, Strain};
use super::parameters::{self, FIBRE};
use super::real::{Real, along, scale};
use super::state::{ALIVE, ENERGIES, FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use super::status::{self, Error};
use super::stress::{square, symmetric_product as product};
use super::tangent::unrepresentable;
use super::wave_speed::COMPACTION_FLOOR;

/// A limit below this is as good as none at all: any tension fails. It keeps the failure index in range.
const LEAST_LIMIT: f64 = 1e-30;

/// The law's properties, checked and prepared once.
#[derive(Clone, Copy, Debug)]
pub struct Hyperelastic<R> {
    pub(super) k_el: R,
    pub(super) k_tc: R,
    pub(super) p: R,
    pub(super) k_td: R,
    pub(super) k_ld: R,
    /// p − 1, the exponent of the compaction stress.
    exponent: Exponent<R>,
    /// W″ of a compaction of at most `held_below`, where an exponent p ≤ 2 would make it infinite or 0/0.
    pub(super) held_below: R,
    pub(super) held_curvature: R,
    failure: Failure<R>,
    pub(super) frame: FibreFrame<R>,
}

/// What a caller wants beside the stress; what is left out is not computed and stays 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Request {
    pub stress: bool,
    pub energies: bool,
    pub invariants: bool,
    /// Failure index and latch. Left out, no point fails; a point that has failed before stays failed all the same.
    pub failure: bool,
    pub modes: bool,
    pub wave_modulus: bool,
}

impl Request {
    /// Everything there is.
    pub const ALL: Request =
        Request { stress: true, energies: true, invariants: true, failure: true, modes: true, wave_modulus: true };
}

/// What the law answers for one point, or for several side by side.
#[derive(Clone, Copy, Debug)]
pub struct Response<R: Real> {
    /// Cauchy stress 11 22 33 12 23 31: intact in the call that detects failure, zero afterwards and on errors.
    pub stress: [R; 6],
    /// W_el, W_tc, W_td, W_ld; I_el, I_tc, I_td, I_ld; failure index. Where `kept` holds they mean nothing: the old
    /// ones stand.
    pub energies: [R; 4],
    pub invariants: [R; 4],
    pub failure_index: R,
    /// The new latch, 0 or 1.
    pub failed: R,
    /// S_el, S_tc, S_td, S_ld: second Piola–Kirchhoff stress mode by mode, each 11 22 33 12 23 31; like the stress.
    pub modes: [[R; 6]; 4],
    /// ρ0 c² for a bound c of the wave speed, at least k_el.
    pub wave_modulus: R,
    /// The point's status code, as a number.
    pub status: R,
    /// Where the point had failed before or cannot be evaluated, so that energies, invariants and index stay.
    pub kept: R::Mask,
}

impl<T: Real + Into<f64>> Hyperelastic<T> {
    /// Checks the properties, in the order of [`parameters::HYPERELASTIC`], and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    pub fn new(properties: &[T]) -> Result<Self, Error> {
        parameters::check(&parameters::HYPERELASTIC, properties)?;
        let &[k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3] = properties else {
            return Err(Error::Plain(status::PROPERTY_COUNT)); // not reached: the count is checked
        };
        let (frame, usable) = FibreFrame::new([m_1, m_2, m_3]);
        if T::select(usable, T::splat(0.0), T::splat(1.0)).into() != 0.0 {
            return Err(Error::Direction {
                index: FIBRE,
                name: "fibre direction",
                value: [m_1.into(), m_2.into(), m_3.into()],
                wanted: "any vector but zero",
            });
        }
        let zero = T::splat(0.0);
        let one = T::splat(1.0);
        let fails = zero.lt(eps_lim);
        let weight = |x: T| T::select(fails, x, zero);
        let [held_below, held_curvature] = held_stiffness(k_tc, p);
        Ok(Hyperelastic {
            k_el,
            k_tc,
            p,
            k_td,
            k_ld,
            exponent: Exponent::new(p - one),
            held_below,
            held_curvature,
            failure: Failure {
                limit: T::select(fails, ln_1p(eps_lim).max(T::splat(LEAST_LIMIT)), T::splat(f64::INFINITY)),
                alpha: weight(alpha),
                beta: weight(beta),
            },
            frame,
        })
    }
}

/// The compaction below which W″ = p(p − 1) k_tc i^(p−2) is held, and its value there: none of it for p > 2, where W″ = 0 at 0.
fn held_stiffness<T: Real + Into<f64>>(k_tc: T, p: T) -> [T; 2] {
    if p.into() > 2.0 {
        return [T::splat(0.0); 2];
    }
    let floor = T::splat(COMPACTION_FLOOR);
    let exponent = p - T::splat(1.0);
    [floor, exponent * p * k_tc * (power(floor, Exponent::new(exponent)) / floor)]
}

/// Where the point stands and what it carries: the intact answer of the law before failure and errors have their say.
#[derive(Clone, Copy, Debug)]
pub struct Kirchhoff<R> {
    /// k_el⟨I_el⟩, (p/2) k_tc⟨−I_tc⟩^(p−1), (k_td/4) asinh s/s, k_ld/λ²: the factors of the four modes in τ.
    pub tension: R,
    pub pressure: R,
    pub distortion: R,
    pub shear: R,
    /// k_tc⟨−I_tc⟩^p, which shares its power with the pressure.
    pub compaction_energy: R,
}

impl<R: Real> Hyperelastic<R> {
    /// The fibre direction of the properties with two axes across it.
    pub fn frame(&self) -> FibreFrame<R> {
        self.frame
    }

    /// Bulk and shear modulus of an isotropic solid whose longitudinal wave is the fibre's: K + 4G/3 = k_el. For hosts that
    /// take their time step and contact stiffness from two constants.
    pub fn bulk_and_shear(&self) -> [R; 2] {
        [R::splat(0.5) * self.k_el, R::splat(0.375) * self.k_el]
    }

    /// The same properties in another number: many lanes instead of one.
    #[inline(always)]
    pub fn lanes<L: Real>(&self) -> Hyperelastic<L>
    where
        R: Into<f64>,
    {
        let lane = |x: R| L::splat(x.into());
        let vector = |v: [R; 3]| [lane(v[0]), lane(v[1]), lane(v[2])];
        Hyperelastic {
            k_el: lane(self.k_el),
            k_tc: lane(self.k_tc),
            p: lane(self.p),
            k_td: lane(self.k_td),
            k_ld: lane(self.k_ld),
            exponent: self.exponent.map(lane),
            held_below: lane(self.held_below),
            held_curvature: lane(self.held_curvature),
            failure: Failure {
                limit: lane(self.failure.limit),
                alpha: lane(self.failure.alpha),
                beta: lane(self.failure.beta),
            },
            frame: FibreFrame { m: vector(self.frame.m), t1: vector(self.frame.t1), t2: vector(self.frame.t2) },
        }
    }

    /// The factors of the four modes in the Kirchhoff stress.
    #[inline(always)]
    pub fn kirchhoff(&self, d: &Decomposition<R>, strain: &Strain<R>) -> Kirchhoff<R> {
        let zero = R::splat(0.0);
        let compaction = (-strain.i_tc).max(zero);
        let powered = self.k_tc * power(compaction, self.exponent);
        Kirchhoff {
            tension: self.k_el * strain.i_el.max(zero),
            pressure: R::splat(0.5) * self.p * powered,
            distortion: R::splat(0.25) * self.k_td * strain.asinh_ratio,
            shear: self.k_ld * d.inverse_lambda * d.inverse_lambda,
            compaction_energy: powered * compaction,
        }
    }

    /// W_el, W_tc, W_td, W_ld (Eq. 4.10, 4.11, 4.13).
    #[inline(always)]
    pub fn energies(&self, invariants: &[R; 4], k: &Kirchhoff<R>, shear: bool) -> [R; 4] {
        let (zero, half) = (R::splat(0.0), R::splat(0.5));
        let [i_el, _, i_td, i_ld] = *invariants;
        [
            half * k.tension * i_el.max(zero),
            k.compaction_energy,
            half * self.k_td * i_td * i_td,
            if shear { half * self.k_ld * i_ld * i_ld } else { zero },
        ]
    }

    /// Cauchy stress 11 22 33 12 23 31.
    ///
    /// With q2⊗q2 = 1 − e⊗e − q1⊗q1 the stress is −(p + d1) 1 + (t + p + d1) e⊗e + q1⊗v + v⊗q1, v = d1 q1 + d2 q2.
    #[inline(always)]
    pub fn cauchy(&self, d: &Decomposition<R>, k: &Kirchhoff<R>, shear: bool) -> [R; 6] {
        let inverse_j = d.inverse_jacobian;
        let distortion = k.distortion * inverse_j;
        let (d1, d2) = (distortion * d.d1, distortion * d.d2);
        let across = k.pressure.mul_add(inverse_j, d1);
        let (e, q1, q2) = (d.e, d.q1, d.q2());
        let mut v = along(scale(d1, q1), d2, q2);
        // e⊗w + w⊗e, w = ½ (t + p + d1) e.
        let mut w = scale(R::splat(0.5) * k.tension.mul_add(inverse_j, across), e);
        if shear {
            let [t12, t13] = shear_components(d, k.shear * inverse_j);
            v = along(v, t12, e);
            w = along(w, t13, q2);
        }
        let two = R::splat(2.0);
        [
            two.mul_add(e[0].mul_add(w[0], q1[0] * v[0]), -across),
            two.mul_add(e[1].mul_add(w[1], q1[1] * v[1]), -across),
            two.mul_add(e[2].mul_add(w[2], q1[2] * v[2]), -across),
            e[0].mul_add(w[1], e[1].mul_add(w[0], q1[0].mul_add(v[1], q1[1] * v[0]))),
            e[1].mul_add(w[2], e[2].mul_add(w[1], q1[1].mul_add(v[2], q1[2] * v[1]))),
            e[2].mul_add(w[0], e[0].mul_add(w[2], q1[2].mul_add(v[0], q1[0] * v[2]))),
        ]
    }

    /// S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31: the modes of τ pulled back through R⁻¹, which is triangular.
    #[inline(always)]
    pub fn modes(&self, d: &Decomposition<R>, k: &Kirchhoff<R>, n: &FibreFrame<R>) -> [[R; 6]; 4] {
        let [w1, w2, w3] = d.pulled_back(n);
        let two = R::splat(2.0);
        let (d1, d2) = (k.distortion * d.d1, k.distortion * d.d2);
        let [t12, t13] = shear_components(d, k.shear);
        [
            square(k.tension, w1),
            sum(square(-k.pressure, w2), square(-k.pressure, w3)),
            sum(sum(square(d1, w2), square(-d1, w3)), product(two * d2, w2, w3)),
            sum(product(two * t12, w1, w2), product(two * t13, w1, w3)),
        ]
    }
}

impl<R: Real> Hyperelastic<R> {
    /// Why a point cannot be evaluated, as a status code, or 0; `usable` says whether its fibre direction is.
    #[inline(always)]
    pub fn flaw(&self, d: &Decomposition<R>, usable: R::Mask) -> R {
        let zero = R::splat(0.0);
        let upright = zero.lt(d.jacobian) & zero.lt(d.lambda);
        let inverted = d.jacobian.le(zero) | d.lambda.le(zero);
        // The first reason that applies, from the last to the first. A determinant that overflows on its way is NaN:
        // neither upright nor inverted.
        let flaw = R::select(upright, zero, R::splat(status::OVERFLOW as f64));
        let flaw = R::select(inverted, R::splat(status::INVERTED as f64), flaw);
        let flaw = R::select(usable, flaw, R::splat(status::FIBRE_DIRECTION as f64));
        R::select(d.finite.le(zero), flaw, R::splat(status::NOT_FINITE as f64))
    }

    /// The answer for a point, given its kinematics, its flaw and the latch of the old state; `shear` says whether there is
    /// a longitudinal-shear stiffness whose terms are to be computed.
    ///
    /// No NaN or infinity leaves in the stress, the modes, the latch, the wave modulus or the status; energies,
    /// invariants and index are to be replaced by the old ones where `kept` says so.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    pub fn respond(
        &self,
        d: &Decomposition<R>,
        strain: &Strain<R>,
        k: &Kirchhoff<R>,
        frame: &FibreFrame<R>,
        flaw: R,
        latch: R,
        request: Request,
        shear: bool,
    ) -> Response<R> {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let invariants = [strain.i_el, strain.i_tc, strain.i_td, d.shear_invariant()];
        let mut stress = if request.stress { self.cauchy(d, k, shear) } else { [zero; 6] };
        let energies = if request.energies { self.energies(&invariants, k, shear) } else { [zero; 4] };
        let mut modes = if request.modes { self.modes(d, k, frame) } else { [[zero; 6]; 4] };
        let wave = if request.wave_modulus { self.wave_modulus(d, strain, k) } else { self.k_el };
        let index = if request.failure { self.failure.index(&invariants) } else { zero };

        // Whether all that was asked for is a finite number: their sum times zero is zero.
        let mut probe = (stress[0] + stress[1]) + (stress[2] + stress[3]) + (stress[4] + stress[5]);
        if request.energies {
            probe = probe + (energies[0] + energies[1]) + energies[2];
            if shear {
                probe = probe + energies[3];
            }
        }
        if request.invariants {
            probe = probe + (invariants[0] + invariants[1]) + (invariants[2] + invariants[3]);
        }
        if request.failure {
            probe = probe + index;
        }
        if request.wave_modulus {
            probe = probe + wave;
        }
        if request.modes {
            for mode in &modes {
                for &x in mode {
                    probe = x.mul_add(zero, probe);
                }
            }
        }
        let representable = (probe * zero).le(zero);

        let latched = Failure::latched(latch);
        let status = R::select(flaw.lt(zero) | representable, flaw, R::splat(status::OVERFLOW as f64));
        let unknown = R::select((latch * zero).le(zero), zero, R::splat(status::STATE_NOT_FINITE as f64));
        let status = R::select(latched, unknown, status);
        let kept = latched | status.lt(zero);
        let fails = Failure::reached(index) & !kept;
        for x in &mut stress {
            *x = R::select(kept, zero, *x);
        }
        if request.modes {
            for x in modes.iter_mut().flatten() {
                *x = R::select(kept, zero, *x);
            }
        }
        Response {
            stress,
            energies,
            invariants,
            failure_index: index,
            failed: R::select(latched | fails, one, zero),
            modes,
            wave_modulus: R::select(kept, self.k_el, wave),
            status,
            kept,
        }
    }
}

/// The sum of two tensors of six components.
#[inline(always)]
fn sum<R: Real>(a: [R; 6], b: [R; 6]) -> [R; 6] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]]
}

/// The components of the longitudinal-shear stress on (e, q1) and (e, q2): `factor` · P b e.
#[inline(always)]
pub(super) fn shear_components<R: Real>(d: &Decomposition<R>, factor: R) -> [R; 2] {
    [factor * d.f_a.mul_add(d.r11, d.f_b * d.r12), factor * d.f_b * d.r22]
}

/// What the law answers for one point, ready to store.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<T> {
    /// Cauchy stress 11 22 33 12 23 31.
    pub stress: [T; 6],
    /// The new state, in the order of [`state::HYPERELASTIC`](super::state::HYPERELASTIC).
    pub state: [T; HYPERELASTIC_STATE],
    /// S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31.
    pub modes: [[T; 6]; 4],
    /// ρ0 c² for a bound c of the wave speed.
    pub wave_modulus: T,
    /// 0, or why the point could not be evaluated.
    pub status: i32,
}

impl<T: Real<Mask = bool> + Into<f64>> Hyperelastic<T> {
    /// Whether there is a longitudinal-shear stiffness; without one its terms need not be computed.
    pub fn shears(&self) -> bool {
        T::splat(0.0).lt(self.k_ld)
    }

    /// The law at one point, with the fibre direction of the properties.
    ///
    /// `f` is the deformation gradient, `state` the old state: all 0 at the start. A point that cannot be evaluated (F
    /// inverted, not finite, …) says so in `status`, carries no stress and keeps its state.
    pub fn point(&self, f: &Matrix3<T>, state: &[T; HYPERELASTIC_STATE], request: Request) -> Point<T>
    where
        T: nalgebra::Scalar,
    {
        let columns = [[f.m11, f.m21, f.m31], [f.m12, f.m22, f.m32], [f.m13, f.m23, f.m33]];
        self.point_along(&columns, None, state, request)
    }

    /// The law at one point: columns of F; a fibre direction of any length, or that of the properties.
    #[inline(always)]
    pub fn point_along(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        request: Request,
    ) -> Point<T> {
        self.point_with::<[T; 0]>(f, fibre, state, request, |_, _, _, _| []).0
    }

    /// The law at one point, with what `tangent` makes of it: intact in the call that detects failure, zeros afterwards
    /// and where the point cannot be evaluated, which it cannot where the tangent is not finite.
    #[inline(always)]
    pub(super) fn point_with<X: AsMut<[T]>>(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        request: Request,
        tangent: impl FnOnce(&Decomposition<T>, &Strain<T>, &Kirchhoff<T>, &FibreFrame<T>) -> X,
    ) -> (Point<T>, X) {
        let zero = T::splat(0.0);
        let (frame, usable) = fibre.map_or((self.frame, true), FibreFrame::new);
        let d = Decomposition::new(f, &frame);
        let strain = Strain::new(&d);
        let k = self.kirchhoff(&d, &strain);
        let mut flaw = self.flaw(&d, usable);
        let mut tangent = tangent(&d, &strain, &k, &frame);
        if !(flaw.lt(zero) | unrepresentable(tangent.as_mut()).le(zero)) {
            flaw = T::splat(status::OVERFLOW as f64);
        }
        let r = self.respond(&d, &strain, &k, &frame, flaw, state[FAILED], request, self.shears());
        if r.kept {
            tangent.as_mut().fill(zero);
        }
        (Point::new(&r, state), tangent)
    }
}

impl<T: Real<Mask = bool> + Into<f64>> Point<T> {
    /// The answer with the new state, given the old one.
    #[inline(always)]
    fn new(r: &Response<T>, state: &[T; HYPERELASTIC_STATE]) -> Self {
        let zero = T::splat(0.0);
        let mut status = Into::<f64>::into(r.status) as i32;
        let mut new = [zero; HYPERELASTIC_STATE];
        new[ENERGIES..INVARIANTS].copy_from_slice(&r.energies);
        new[INVARIANTS..FAILURE_INDEX].copy_from_slice(&r.invariants);
        new[FAILURE_INDEX] = r.failure_index;
        if r.kept {
            // The latch has been looked at, and alive is never read.
            for (x, &old) in new.iter_mut().zip(state).take(FAILED) {
                let finite = (old * zero).le(zero);
                *x = T::select(finite, old, zero);
                if !finite && status == status::OK {
                    status = status::STATE_NOT_FINITE;
                }
            }
        }
        new[FAILED] = r.failed;
        new[ALIVE] = T::splat(1.0) - r.failed;
        Point { stress: r.stress, state: new, modes: r.modes, wave_modulus: r.wave_modulus, status }
    }
}
