//! The yarn law: energies and stress from the four deformation modes (thesis, Eq. 4.6–4.15).
//!
//! ```text
//! W = ½ k_el ⟨I_el⟩²  +  k_tc ⟨−I_tc⟩^p  +  ½ k_td I_td²  +  ½ k_ld I_ld²        per reference volume
//!
//! τ = k_el ⟨I_el⟩ e⊗e  −  (p/2) k_tc ⟨−I_tc⟩^(p−1) Π  +  (k_td/4)(2 I_td/ŝ) D̂  +  (k_ld/λ³)(h⊗c1 + c1⊗h)
//! ```
//!
//! with e = c1/λ, Π = 1 − e⊗e, D̂ = a⊗a + b⊗b − t̂ Π the deviator of the section, λ h = h2 a + h3 b, and the other
//! quantities as in `kinematics`. It is the law that [`thesis`](super::thesis) states, with its Eq. 4.14 pushed
//! forward, without its quotient 0/0: 2 I_td/ŝ is smooth through ŝ = 0.
//!
//! `Kirchhoff` holds the four factors of τ. They are multiplied out twice: `cauchy` sums the modes in the axes of
//! space, which is what a solver needs of every point, and `modes` keeps them apart and pulls them back to the
//! reference placement, with the decomposition of F that `cauchy` does without. The tangents take D̂ and h from the
//! same two functions of `kinematics` as `cauchy`.

use super::axes::FibreFrame;
use super::failure::Failure;
use super::kinematics::{Decomposition, Kinematics, Strain, Stretch};
use super::number::elementary::{Exponent, Power};
use super::number::real::Real;
use super::number::vector::scale;
use super::voigt::{square, sum, symmetric_product as product};

/// The properties by name, in any one consistent system of units. Hosts pass the same numbers as an array, in the order
/// of [`parameters::HYPERELASTIC`](super::parameters::HYPERELASTIC), which also gives their bounds.
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
    /// For a compaction of at most `limited_below`, W″ is replaced by `limited_curvature`: its formula would give
    /// infinity or 0/0.
    pub(super) limited_below: R,
    pub(super) limited_curvature: R,
    pub(super) failure: Failure<R>,
    pub(super) frame: FibreFrame<R>,
    /// Whether the fibre lies along the first axis: most products with the frame then need not be computed.
    pub(super) aligned: bool,
    /// Whether there is a longitudinal-shear stiffness; without one its terms are not computed.
    pub(super) shears: bool,
}

/// The factors of the four modes in the Kirchhoff stress τ of the intact material, see the formula of this module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kirchhoff<R> {
    /// k_el⟨I_el⟩, the factor of e⊗e.
    pub tension: R,
    /// (p/2) k_tc⟨−I_tc⟩^(p−1), the factor of −Π.
    pub pressure: R,
    /// (k_td/2)(I_td/ŝ), the factor of D̂.
    pub distortion: R,
    /// k_ld/λ², the factor of (h⊗c1 + c1⊗h)/λ.
    pub shear: R,
    /// The energy k_tc⟨−I_tc⟩^p, computed from the same power as the pressure.
    pub compaction_energy: R,
}

/// A deformed point of the intact material: what its stress and tangents are computed from.
#[derive(Clone, Copy)]
pub(crate) struct Deformed<'a, R: Real> {
    pub law: &'a Hyperelastic<R>,
    pub kinematics: Kinematics<'a, R>,
    pub k: &'a Kirchhoff<R>,
    /// Whether k_ld is above 0, so that the terms of the longitudinal shear have to be computed.
    pub shear: bool,
}

impl<R: Real> Hyperelastic<R> {
    /// W_el, W_tc, W_td, W_ld (Eq. 4.10, 4.11, 4.13).
    #[inline(always)]
    pub(crate) fn energies(&self, strain: &Strain<R>, i_ld: R, k: &Kirchhoff<R>, shear: bool) -> [R; 4] {
        let (zero, half) = (R::splat(0.0), R::splat(0.5));
        let elongation = strain.i_el.max(zero);
        [
            half * self.k_el * elongation * elongation,
            k.compaction_energy,
            half * self.k_td * strain.i_td * strain.i_td,
            // Half of the smallest stiffness is 0, and the slip may be large.
            if shear { self.k_ld * i_ld * (half * i_ld) } else { zero },
        ]
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

    /// Cauchy stress σ = τ/J, 11 22 33 12 23 31, of the intact points; 0 at points that have failed, undefined at
    /// points that cannot be evaluated.
    ///
    /// The modes are summed before they are multiplied out: with the tension t, the pressure p, the factor f of the
    /// deviator, d = f η and v' = (f/(a·a)) D̂a, see [`Section`](super::kinematics::Section),
    ///
    /// ```text
    /// J σ = −(p + d) 1 + (t + p + d) e⊗e + a⊗v' + v'⊗a + (k_ld/λ³)(h⊗c1 + c1⊗h)
    /// ```
    ///
    /// `across` is −(p + d)/J, `along` (t + p + d)/(J λ²), `v` v'/J.
    #[inline(always)]
    pub(crate) fn cauchy(
        &self,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        intact: R::Mask,
        shear: bool,
    ) -> [R; 6] {
        let Kinematics { stretch, section, images: [c, a, b], strain, .. } = kinematics;
        let zero = R::splat(0.0);
        // If all factors are zero, so is the stress.
        let factor = |x: R| R::select(intact, x, zero);
        let distortion = k.distortion * stretch.inverse_jacobian;
        let deviator = section.deviator(strain.inverse_a_square);
        let across = (-k.pressure).mul_add(stretch.inverse_jacobian, -(distortion * deviator));
        let along = k.tension.mul_add(stretch.inverse_jacobian, -across) * stretch.inverse_square;
        let (across, w) = (factor(across), scale(factor(along), c));
        let v = section.beside_a(factor(distortion * strain.inverse_a_square), [a, b]);
        // Adding +0 makes a −0 positive.
        let mut stress = [
            a[0].mul_add(v[0], a[0].mul_add(v[0], w[0].mul_add(c[0], across))),
            a[1].mul_add(v[1], a[1].mul_add(v[1], w[1].mul_add(c[1], across))),
            a[2].mul_add(v[2], a[2].mul_add(v[2], w[2].mul_add(c[2], across))),
            a[0].mul_add(v[1], a[1].mul_add(v[0], w[0].mul_add(c[1], zero))),
            a[1].mul_add(v[2], a[2].mul_add(v[1], w[1].mul_add(c[2], zero))),
            a[2].mul_add(v[0], a[0].mul_add(v[2], w[2].mul_add(c[0], zero))),
        ];
        if shear {
            let u = kinematics.slip(factor(k.shear * stretch.inverse_square * stretch.inverse_jacobian));
            for (i, j, x) in [(0, 0, 0), (1, 1, 1), (2, 2, 2), (0, 1, 3), (1, 2, 4), (2, 0, 5)] {
                stress[x] = u[i].mul_add(c[j], u[j].mul_add(c[i], stress[x]));
            }
        }
        stress
    }

    /// S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31: the parts of τ by mode, pulled back by the triangle R.
    #[inline(always)]
    pub(crate) fn modes(
        &self,
        kinematics: Kinematics<'_, R>,
        d: &Decomposition<R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
    ) -> [[R; 6]; 4] {
        let [w1, w2, w3] = d.pulled_back(&kinematics.axes(n));
        let two = R::splat(2.0);
        let distortion = k.distortion * d.area_ratio;
        let (d1, d2) = (distortion * d.d1, distortion * d.d2);
        let longitudinal = match kinematics.slid {
            Some(_) => {
                let whole = Decomposition::new(kinematics.whole());
                shear_mode(&whole, whole.pulled_back(n), k.shear)
            }
            None => shear_mode(d, [w1, w2, w3], k.shear),
        };
        [
            square(k.tension, w1),
            sum(square(-k.pressure, w2), square(-k.pressure, w3)),
            sum(sum(square(d1, w2), square(-d1, w3)), product(two * d2, w2, w3)),
            longitudinal,
        ]
    }

    /// |W′| and W″ of the compaction energy; at I_tc = 0 those of compaction, and near it W″ is limited.
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
}

/// S_ld from the pulled-back frame.
#[inline(always)]
fn shear_mode<R: Real>(d: &Decomposition<R>, [w1, w2, w3]: [[R; 3]; 3], factor: R) -> [R; 6] {
    let two = R::splat(2.0);
    let [t12, t13] = shear_components(d, factor);
    sum(product(two * t12, w1, w2), product(two * t13, w1, w3))
}

/// The components of the longitudinal-shear stress on (e, q1) and (e, q2): `factor` · h.
#[inline(always)]
pub(super) fn shear_components<R: Real>(d: &Decomposition<R>, factor: R) -> [R; 2] {
    [factor * d.f_a.mul_add(d.r11, d.f_b * d.r12), factor * d.f_b * d.r22]
}
