//! The yarn law: energies and stress from the four deformation modes (thesis, Eq. 4.6–4.15).
//!
//! ```text
//! W = ½ k_el ⟨I_el⟩²  +  k_tc ⟨−I_tc⟩^p  +  ½ k_td I_td²  +  ½ k_ld I_ld²        per reference volume
//!
//! τ = k_el ⟨I_el⟩ e⊗e  −  (p/2) k_tc ⟨−I_tc⟩^(p−1) P  +  (k_td/4)(2 I_td/ŝ) D̂  +  (k_ld/λ⁴)(u⊗c1 + c1⊗u)
//! ```
//!
//! with e = c1/λ, P = 1 − e⊗e, D̂ = a⊗a + b⊗b − t̂ P the deviator of the section, u = h2 a + h3 b, and the other quantities as
//! in `kinematics`. It is Eq. 4.14 of the thesis pushed forward, without its quotient 0/0: 2 I_td/ŝ is
//! smooth through ŝ = 0.

use super::bounds::{check, limits, within};
use super::error::Error;
use super::failure::Failure;
use super::kinematics::{Decomposition, FibreFrame, Kinematics, Strain, Stretch};
use super::number::elementary::{Exponent, Power, power};
use super::number::real::Real;
use super::number::vector::{along, scale};
use super::parameters::{self, FIBRE, HYPERELASTIC_PROPERTIES};
use super::status;
use super::voigt::{square, sum, symmetric_product as product};

/// The properties by name, in any one consistent system of units. Hosts pass the same numbers as an array, in the order of
/// [`parameters::HYPERELASTIC`], which also gives their bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties<T> {
    /// Elongation stiffness, a stress.
    pub k_el: T,
    /// Compaction stiffness, a stress, and exponent.
    pub k_tc: T,
    pub p: T,
    /// Distortion stiffness, a stress.
    pub k_td: T,
    /// Longitudinal shear stiffness, a stress; 0: none.
    pub k_ld: T,
    /// Failure strain of the fibre; 0: the yarn does not fail.
    pub eps_lim: T,
    /// Weights of compaction and distortion in the failure index; both 0: uniaxial failure.
    pub alpha: T,
    pub beta: T,
    /// Fibre direction in the reference placement, of any length.
    pub fibre: [T; 3],
}

impl<T> From<Properties<T>> for [T; HYPERELASTIC_PROPERTIES] {
    fn from(properties: Properties<T>) -> Self {
        let Properties { k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, fibre: [m_1, m_2, m_3] } = properties;
        [k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3]
    }
}

impl<T> From<[T; HYPERELASTIC_PROPERTIES]> for Properties<T> {
    #[inline(always)]
    fn from([k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3]: [T; HYPERELASTIC_PROPERTIES]) -> Self {
        Properties { k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, fibre: [m_1, m_2, m_3] }
    }
}

/// The hyperelastic law: its properties, checked, and what is derived from them once.
#[derive(Clone, Copy, Debug)]
pub struct Hyperelastic<R = f64> {
    pub(super) k_el: R,
    pub(super) k_tc: R,
    pub(super) p: R,
    pub(super) k_td: R,
    pub(super) k_ld: R,
    /// p − 1, the exponent of the compaction stress.
    pub(super) exponent: Exponent<R>,
    /// For a compaction of at most `limited_below`, W″ is replaced by `limited_curvature`: its formula would give infinity or
    /// 0/0.
    pub(super) limited_below: R,
    pub(super) limited_curvature: R,
    pub(super) failure: Failure<R>,
    pub(super) frame: FibreFrame<R>,
    /// Whether the fibre lies along the first axis: most products with the frame then need not be computed.
    pub(super) aligned: bool,
    /// Whether there is a longitudinal-shear stiffness; without one its terms are not computed.
    pub(super) shears: bool,
}

impl<T: Real + Into<f64>> Hyperelastic<T> {
    /// Checks the properties and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    pub fn with(properties: Properties<T>) -> Result<Self, Error> {
        Self::new(&<[T; HYPERELASTIC_PROPERTIES]>::from(properties))
    }

    /// Checks the properties, in the order of [`parameters::HYPERELASTIC`], and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    #[inline(always)]
    pub fn new(properties: &[T]) -> Result<Self, Error> {
        let mut law = Self::prepare(properties, &PropertyFrame::new(properties))?;
        law.failure = Self::prepare_failure(properties);
        Ok(law)
    }

    /// As [`new`](Self::new), given the frame of the fibre direction, but without failure, which
    /// [`prepare_failure`](Self::prepare_failure) prepares.
    ///
    /// # Errors
    /// The first property that is wrong, those of failure included.
    // A call for one point prepares the law every time. Inlined, each number is used as soon as it has been computed; if the
    // law were copied as a whole, all of them would have to be computed first.
    #[inline(always)]
    pub(super) fn prepare(properties: &[T], frame: &PropertyFrame<T>) -> Result<Self, Error> {
        const LIMITS: [[f64; HYPERELASTIC_PROPERTIES]; 2] = limits(&parameters::HYPERELASTIC);
        let Ok(properties) = <&[T; HYPERELASTIC_PROPERTIES]>::try_from(properties) else {
            check(&parameters::HYPERELASTIC, properties)?;
            return Err(Error::Plain(status::PROPERTY_COUNT)); // not reached: `check` has returned the error
        };
        if !within(&LIMITS, properties) {
            check(&parameters::HYPERELASTIC, properties)?;
        }
        let &[k_el, k_tc, p, k_td, k_ld, _, _, _, m_1, m_2, m_3] = properties;
        if !frame.usable {
            return Err(Error::Direction {
                code: status::PROPERTY_DIRECTION,
                index: FIBRE,
                name: "fibre direction",
                value: [m_1.into(), m_2.into(), m_3.into()],
                wanted: "any vector but zero",
            });
        }
        let one = T::splat(1.0);
        let exponent = Exponent::new(p - one);
        let [limited_below, limited_curvature] = curvature_limit(k_tc, p, &exponent);
        Ok(Hyperelastic {
            k_el,
            k_tc,
            p,
            k_td,
            k_ld,
            exponent,
            limited_below,
            limited_curvature,
            failure: Failure::none(),
            frame: frame.frame,
            aligned: frame.aligned,
            shears: T::splat(0.0).into() < k_ld.into(),
        })
    }

    /// ε_lim, α and β of properties that have been checked.
    #[inline(always)]
    pub(super) fn failure_properties(properties: &[T]) -> [T; 3] {
        match properties {
            &[_, _, _, _, _, eps_lim, alpha, beta, ..] => [eps_lim, alpha, beta],
            _ => [T::splat(0.0); 3], // not reached: their number has been checked
        }
    }

    /// The failure criterion from properties that have been checked.
    #[inline(always)]
    pub(super) fn prepare_failure(properties: &[T]) -> Failure<T> {
        let [eps_lim, alpha, beta] = Self::failure_properties(properties);
        Failure::new(eps_lim, alpha, beta)
    }
}

/// The frame of the fibre direction among the properties.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PropertyFrame<T> {
    pub frame: FibreFrame<T>,
    /// Whether the fibre lies along the first axis.
    pub aligned: bool,
    /// Whether the direction is finite and not zero.
    pub usable: bool,
}

impl<T: Real + Into<f64>> PropertyFrame<T> {
    #[inline(always)]
    pub fn new(properties: &[T]) -> Self {
        let direction = match properties {
            &[.., m_1, m_2, m_3] if properties.len() == HYPERELASTIC_PROPERTIES => [m_1, m_2, m_3],
            _ => [T::splat(0.0); 3], // a wrong number of properties, which `prepare` refuses
        };
        let [m_1, m_2, m_3]: [f64; 3] = [direction[0].into(), direction[1].into(), direction[2].into()];
        if m_2 == 0.0 && m_3 == 0.0 && m_1 >= T::MIN_POSITIVE {
            return PropertyFrame { frame: FibreFrame::first_axis(), aligned: true, usable: true };
        }
        let (frame, usable) = FibreFrame::new(direction);
        let usable = T::select(usable, T::splat(1.0), T::splat(0.0)).into() == 1.0;
        PropertyFrame { frame, aligned: false, usable }
    }
}

/// Below this compaction W″ is limited if p ≤ 2: for p < 2 it is infinite at 0.
const COMPACTION_FLOOR: f64 = 1e-8;

/// The compaction up to which W″ = p(p − 1) k_tc i^(p−2) is replaced by a constant, and that constant. For p > 2 it is 0, and
/// replaces W″ only where i^(p−1) underflows to 0 too, so that no quotient overflows.
#[inline(always)]
fn curvature_limit<T: Real + Into<f64>>(k_tc: T, p: T, exponent: &Exponent<T>) -> [T; 2] {
    if p.into() > 2.0 {
        return [T::splat(T::MIN_POSITIVE * f64::from(1 << 20)), T::splat(0.0)];
    }
    let floor = T::splat(COMPACTION_FLOOR);
    [floor, p * (p - T::splat(1.0)) * k_tc * power(floor, exponent) / floor]
}

/// The factors of the four modes in the Kirchhoff stress τ of the intact material, see the formula of this module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kirchhoff<R> {
    /// k_el⟨I_el⟩, the factor of e⊗e.
    pub tension: R,
    /// (p/2) k_tc⟨−I_tc⟩^(p−1), the factor of −P.
    pub pressure: R,
    /// (k_td/2)(I_td/ŝ), the factor of D̂.
    pub distortion: R,
    /// k_ld/λ², the factor of (u⊗c1 + c1⊗u)/λ².
    pub shear: R,
    /// The energy k_tc⟨−I_tc⟩^p, computed from the same power as the pressure.
    pub compaction_energy: R,
}

impl<R: Real> Hyperelastic<R> {
    /// Bulk and shear modulus of an isotropic solid whose longitudinal wave speed is that of the fibre: K + 4G/3 = k_el. For
    /// hosts that compute their time step and contact stiffness from two elastic constants.
    pub fn bulk_and_shear(&self) -> [R; 2] {
        [R::splat(0.5) * self.k_el, R::splat(0.375) * self.k_el]
    }

    /// The same law in another number type: each of its numbers in all lanes of `L`.
    #[inline(always)]
    pub(crate) fn lanes<L: Real>(&self) -> Hyperelastic<L>
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
            limited_below: lane(self.limited_below),
            limited_curvature: lane(self.limited_curvature),
            failure: self.failure.map(lane),
            frame: FibreFrame { m: vector(self.frame.m), t1: vector(self.frame.t1), t2: vector(self.frame.t2) },
            aligned: self.aligned,
            shears: self.shears,
        }
    }

    /// The first step of the power ⟨−I_tc⟩^(p−1).
    #[inline(always)]
    pub(crate) fn compaction(&self, strain: &Strain<R>) -> Power<R> {
        Power::new(-strain.i_tc)
    }

    /// The factors of the four modes in the Kirchhoff stress, given ⟨−I_tc⟩^(p−1).
    #[inline(always)]
    pub(crate) fn kirchhoff(&self, d: &Stretch<R>, strain: &Strain<R>, power: R) -> Kirchhoff<R> {
        let zero = R::splat(0.0);
        Kirchhoff {
            tension: self.k_el * strain.i_el.max(zero),
            pressure: R::splat(0.5) * self.p * self.k_tc * power,
            distortion: R::splat(0.5) * self.k_td * strain.distortion_ratio,
            shear: self.k_ld * d.inverse_square,
            // The power is 0 where there is no compaction; adding +0 makes a −0 positive.
            compaction_energy: (-(self.k_tc * power)).mul_add(strain.i_tc, zero),
        }
    }

    /// |W′| and W″ of the compaction energy; at I_tc = 0 those of compaction, and near it W″ is limited, see
    /// [`curvature_limit`].
    #[inline(always)]
    pub(crate) fn compaction_slopes(&self, strain: &Strain<R>, k: &Kirchhoff<R>) -> (R, R) {
        let zero = R::splat(0.0);
        let compaction = -strain.i_tc;
        let slope = R::splat(2.0) * k.pressure;
        let limited = compaction.le(self.limited_below);
        // This division need not wait for the slope, which takes long to compute.
        let factor = (self.p - R::splat(1.0)) / R::select(limited, R::splat(1.0), compaction);
        let curvature = R::select(limited, self.limited_curvature, factor * slope);
        (slope, R::select(zero.le(compaction), curvature, zero))
    }

    /// W_el, W_tc, W_td, W_ld (Eq. 4.10, 4.11, 4.13).
    #[inline(always)]
    pub(crate) fn energies(&self, strain: &Strain<R>, i_ld: R, k: &Kirchhoff<R>, shear: bool) -> [R; 4] {
        let (zero, half) = (R::splat(0.0), R::splat(0.5));
        let elongation = strain.i_el.max(zero);
        [
            half * self.k_el * elongation * elongation,
            k.compaction_energy,
            half * self.k_td * strain.i_td * strain.i_td,
            if shear { half * self.k_ld * i_ld * i_ld } else { zero },
        ]
    }

    /// Cauchy stress 11 22 33 12 23 31 of the intact points; 0 at points that have failed, undefined at points that cannot be
    /// evaluated.
    ///
    /// With A = a·a, x = a·b and v = ½(A − b·b) a + x b the section's deviator is D̂ = (a⊗v + v⊗a)/A − d̂ P, d̂ = ½(A − b·b) +
    /// x²/A, which keeps its digits if the section is hardly distorted. With the tension t, the pressure p, the factor f of D̂,
    /// d = f d̂ and v' = (f/A) v, the stress is σ = −(p + d) 1 + (t + p + d) e⊗e + a⊗v' + v'⊗a, all divided by J.
    #[inline(always)]
    pub(crate) fn cauchy(
        &self,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        intact: R::Mask,
        shear: bool,
    ) -> [R; 6] {
        let Kinematics { stretch: d, section, images: [c, a, b], strain } = kinematics;
        let zero = R::splat(0.0);
        let distortion = k.distortion * d.inverse_jacobian;
        let deviator = section.x23_square.mul_add(strain.inverse_a_square, section.delta);
        // −(p + d)/J.
        let across = (-k.pressure).mul_add(d.inverse_jacobian, -(distortion * deviator));
        let along_fibre = k.tension.mul_add(d.inverse_jacobian, -across) * d.inverse_square;
        // If all three factors are zero, so is the stress: adding +0 makes a −0 positive.
        let factor = |x: R| R::select(intact, x, zero);
        let (across, along_fibre) = (factor(across), factor(along_fibre));
        let w = scale(along_fibre, c);
        let share = factor(distortion * strain.inverse_a_square);
        let v = along(scale(share * section.delta, a), share * section.x23, b);
        let mut stress = [
            a[0].mul_add(v[0], a[0].mul_add(v[0], w[0].mul_add(c[0], across))),
            a[1].mul_add(v[1], a[1].mul_add(v[1], w[1].mul_add(c[1], across))),
            a[2].mul_add(v[2], a[2].mul_add(v[2], w[2].mul_add(c[2], across))),
            a[0].mul_add(v[1], a[1].mul_add(v[0], w[0].mul_add(c[1], zero))),
            a[1].mul_add(v[2], a[2].mul_add(v[1], w[1].mul_add(c[2], zero))),
            a[2].mul_add(v[0], a[0].mul_add(v[2], w[2].mul_add(c[0], zero))),
        ];
        if shear {
            let factor = factor(k.shear * d.inverse_square * d.inverse_jacobian);
            let u = along(scale(factor * d.h[0], a), factor * d.h[1], b);
            for (i, j, x) in [(0, 0, 0), (1, 1, 1), (2, 2, 2), (0, 1, 3), (1, 2, 4), (2, 0, 5)] {
                stress[x] = u[i].mul_add(c[j], u[j].mul_add(c[i], stress[x]));
            }
        }
        stress
    }

    /// S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31: the parts of τ by mode, pulled back by the triangle R.
    #[inline(always)]
    pub(crate) fn modes(&self, d: &Decomposition<R>, k: &Kirchhoff<R>, n: &FibreFrame<R>) -> [[R; 6]; 4] {
        let [w1, w2, w3] = d.pulled_back(n);
        let two = R::splat(2.0);
        let distortion = k.distortion * d.area_ratio;
        let (d1, d2) = (distortion * d.d1, distortion * d.d2);
        let [t12, t13] = shear_components(d, k.shear);
        [
            square(k.tension, w1),
            sum(square(-k.pressure, w2), square(-k.pressure, w3)),
            sum(sum(square(d1, w2), square(-d1, w3)), product(two * d2, w2, w3)),
            sum(product(two * t12, w1, w2), product(two * t13, w1, w3)),
        ]
    }
}

/// The components of the longitudinal-shear stress on (e, q1) and (e, q2): `factor` · P b e.
#[inline(always)]
pub(super) fn shear_components<R: Real>(d: &Decomposition<R>, factor: R) -> [R; 2] {
    [factor * d.f_a.mul_add(d.r11, d.f_b * d.r12), factor * d.f_b * d.r22]
}
