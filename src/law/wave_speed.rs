//! An upper bound of the wave speed, for the time step of an explicit solver.
//!
//! For a direction ξ and a polarisation u the acoustic tensor times the reference density is
//! u·ρ0 Q(ξ)u = 𝕔:(ξ⊗u)(ξ⊗u) + ξ·τξ, with 𝕔 the Truesdell modulus and τ the Kirchhoff stress. With y = (e·ξ)(e·u), mode
//! by mode (derivation in `docs/design/law.md`):
//!
//! - elongation:       ≤ k_el ⟨I_el⟩ + k_el (1 − 2 I_el) y², only in tension;
//! - compaction:       ≤ (¼ W″ + 2 p_t)(1 − y²);
//! - distortion:       ≤ ¼ k_td ((θ/s) exp θ + θ)(1 − y²), θ = 2 I_td, s = sinh θ;
//! - longitudinal shear: ≤ κ (2 J_t exp θ (1 − y²) + 4 |h|), κ = k_ld/λ².
//!
//! The sum is linear in y², so that its maximum is at y² = 0 or y² = 1:
//!
//! ρ0 v² ≤ max(k_el, k_el ⟨I_el⟩ + M_t) + M_ld, where M_t gathers the factors of 1 − y² and M_ld is the shear's last
//! term.
//!
//! At rest and along a stretched fibre v is √(k_el/ρ0). k_el is kept for a slack fibre, since tension may return within
//! a step.

use super::error::{Error, Value};
use super::hyperelastic::{Hyperelastic, Kirchhoff, shear_components};
use super::kinematics::{Decomposition, Kinematics};
use super::number::real::Real;
use super::resistance::Resistance;

/// Checks a reference density that a wave speed is to be computed with.
///
/// # Errors
/// The density is not a positive, normal, finite number.
pub(crate) fn check_density<T: Real + Into<f64>>(density: T) -> Result<(), Error> {
    let given = Value::of(density);
    let density = density.into();
    if density >= T::MIN_POSITIVE && density < f64::INFINITY {
        return Ok(());
    }
    Err(Error::Argument { name: "density", value: given, wanted: "a finite number > 0, not subnormal" })
}

/// √(modulus/density), as a quotient of roots: it does not overflow if modulus and density are normal numbers.
#[inline(always)]
pub fn wave_speed<R: Real>(modulus: R, density: R) -> R {
    modulus.sqrt() / density.sqrt()
}

impl<R: Real> Hyperelastic<R> {
    /// Bulk and shear modulus of an isotropic solid whose longitudinal wave speed is that of the fibre: K + 4G/3 =
    /// k_el. For hosts that compute their time step and contact stiffness from two elastic constants.
    pub fn bulk_and_shear(&self) -> [R; 2] {
        [R::splat(0.5) * self.k_el, R::splat(0.375) * self.k_el]
    }

    /// What resists the motions of an element. W = k_tc |I_tc|^p + ½ k_td I_td² by one transverse logarithmic strain,
    /// of which I_tc and I_td are half: with p ≥ 2 its stiffness at |I_tc| = 1 is that across, and less before. I_td is
    /// half of a shear, too.
    pub(crate) fn resistance(&self) -> Resistance
    where
        R: Into<f64>,
    {
        let (k_el, k_tc, p, k_td): (f64, f64, f64, f64) =
            (self.k_el.into(), self.k_tc.into(), self.p.into(), self.k_td.into());
        Resistance { along: k_el, across: (p * (p - 1.0) * k_tc + k_td) / 4.0, shape: k_td / 4.0, hourglass: k_td }
    }

    /// ρ0 c² for an upper bound c of the speed of every wave in this state; at least k_el.
    #[inline(always)]
    pub(crate) fn wave_modulus(&self, kinematics: Kinematics<'_, R>, d: &Decomposition<R>, k: &Kirchhoff<R>) -> R {
        let strain = kinematics.strain;
        let (zero, quarter) = (R::splat(0.0), R::splat(0.25));
        let (slope, curvature) = self.compaction_slopes(strain, k);
        let active = zero.le(-strain.i_tc);
        // Sliding adds µ W″/4 at most.
        let share = match kinematics.slid {
            Some(slid) => quarter.mul_add(slid.mu, quarter),
            None => quarter,
        };
        let compacting = R::select(active, share.mul_add(curvature, slope), zero);

        let grown = d.s + d.cosh; // e^θ
        let distorting = k.distortion * d.area_ratio * grown + R::splat(0.5) * self.k_td * strain.i_td;
        // The longitudinal shear is that of the whole section.
        let whole = match kinematics.slid {
            Some(_) => &Decomposition::new(kinematics.whole()),
            None => d,
        };
        let shearing = R::splat(2.0) * k.shear * d.area_ratio * (whole.s + whole.cosh);
        // The stiffness is multiplied last: its square might overflow.
        let [on_q1, on_q2] = shear_components(whole, R::splat(1.0));
        let coupling = R::splat(4.0) * k.shear * on_q1.mul_add(on_q1, on_q2 * on_q2).sqrt();

        let across = self.k_el.mul_add(strain.i_el.max(zero), compacting + distorting + shearing);
        across.max(self.k_el) + coupling
    }
}
