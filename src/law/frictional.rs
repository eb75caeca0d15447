//! The yarn law with friction between the fibres of a section: the hyperelastic law, whose distortion holds only as far
//! as fibres that are pressed together hold it.
//!
//! Seen along the fibres, a section is a granular medium in two dimensions: discs that keep no shape unless they are
//! pressed together. Compaction gives their pressure p_t, distortion the deviator q = ½ k_td I_te, half the difference
//! of the section's principal Kirchhoff stresses. The fibres slide over one another where q would exceed what friction
//! holds (Mohr and Coulomb, in the plane):
//!
//! ```text
//! q ≤ µ p_t + c        µ = sin φ of the bundle, c a cohesion, p_t = (p/2) k_tc ⟨−I_tc⟩^(p−1)
//! ```
//!
//! Sliding changes the shape of the section at constant area, and its work is lost. What has slid is Γ, a symmetric
//! tensor of the reference section with determinant 1, kept as two state variables d1 and d2:
//!
//! ```text
//! Γ = [d0 + d1, d2; d2, d0 − d1],  d0 = √(1 + d1² + d2²);      Γ = V Vᵀ,  det V = 1,  (w1, w2) = (a, b) V
//! ```
//!
//! with the images a and b of `kinematics`. All that the hyperelastic law says about the distortion holds of w1 and w2
//! in their place, with I_te in place of I_td. Where q exceeds the limit it returns to it in closed form, along the
//! geodesic of Γ to the inverse of the shape that the section has: with s = sinh 2 I_te and I_max = 2 (µ p_t + c)/k_td
//!
//! ```text
//! (d1, d2) ← [sinh(2 I_max) (d1, d2) − sinh(2 (I_te − I_max)) (½(a·a − b·b), a·b)/J_t]/s,      I_te ← I_max
//! w_fr ← w_fr + ½ k_td (I_max + max(I_max, min(I_te, I_te,old))) (I_te − I_max)
//! ```
//!
//! Left out: dilatancy (so that µ is what the fibres lose, not q/p_t at the peak), friction of fibres along each other,
//! and the rate.

use super::block::{Has, PARTS, Points, Precision, evaluate_points};
use super::bounds::{checked, limits};
use super::description::{self, Description};
use super::error::Error;
use super::hyperelastic::{Hyperelastic, Kirchhoff};
use super::interface::Law;
use super::kinematics::{Section, Strain, Unimodular};
use super::number::elementary::sinh_and_exp_of_minus;
use super::number::real::Real;
use super::parameters::{self, HYPERELASTIC_PROPERTIES};
use super::resistance::{Resistance, ShearLimit};
use super::state::{FRICTIONAL_PARTS, FRICTIONAL_STATE};

/// The law, prepared from its thirteen properties: the hyperelastic law, and the friction. Points are evaluated by
/// [`Law::step`]; their state is the fifteen variables of [`state::FRICTIONAL`](super::state::FRICTIONAL), all 0 at the
/// start.
#[derive(Clone, Copy, Debug)]
pub struct Frictional<R = f64> {
    pub(super) elastic: Hyperelastic<R>,
    pub(super) friction: Friction<R>,
}

impl<T: Precision> Frictional<T> {
    /// Checks the properties, in the order of [`parameters::FRICTIONAL`], and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    pub fn new(properties: &[T]) -> Result<Self, Error> {
        let table = &parameters::FRICTIONAL;
        let properties = checked(table, const { &limits(&parameters::FRICTIONAL) }, properties)?;
        let &[k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3, mu, cohesion] = properties;
        let elastic: [T; HYPERELASTIC_PROPERTIES] = [k_el, k_tc, p, k_td, k_ld, eps_lim, alpha, beta, m_1, m_2, m_3];
        Ok(Frictional { elastic: Hyperelastic::new(&elastic)?, friction: Friction::new(k_td, mu, cohesion) })
    }
}

// SAFETY: the state is that of the description, and the block's kernels access what `Points` says.
unsafe impl<T: Precision> Law<T> for Frictional<T> {
    const DESCRIPTION: Description = description::FRICTIONAL;
    const HAS: Has = Has::YARN;
    const PARTS: [usize; PARTS] = FRICTIONAL_PARTS;
    type State = [T; FRICTIONAL_STATE];

    fn fresh() -> Self::State {
        [T::splat(0.0); FRICTIONAL_STATE]
    }

    fn new(properties: &[T]) -> Result<Self, Error> {
        Frictional::new(properties)
    }

    fn axes(&self) -> [[f64; 3]; 3] {
        Law::axes(&self.elastic)
    }

    fn bulk_and_shear(&self) -> [T; 2] {
        Hyperelastic::bulk_and_shear(&self.elastic)
    }

    /// Fibres that slide hold less.
    fn resistance(&self) -> Resistance {
        Hyperelastic::resistance(&self.elastic)
    }

    /// What the fibres hold themselves.
    fn shear_limit(&self) -> Option<ShearLimit> {
        Some(ShearLimit::new([self.elastic.p, self.friction.mu, self.friction.cohesion]))
    }

    #[inline(always)]
    unsafe fn step(&self, points: &Points<T>) -> Result<i32, Error> {
        // SAFETY: the points are valid.
        unsafe { evaluate_points(self, points) }
    }
}

/// What holds the fibres of a section.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Friction<R> {
    /// µ, and c, a Kirchhoff stress.
    mu: R,
    cohesion: R,
    /// 2/k_td; 0 if k_td is 0, where nothing slides, or too small for its reciprocal.
    per_stiffness: R,
}

/// What a section remembers besides I_te: the components d1 and d2 of its slip, and the energy lost.
#[derive(Clone, Copy)]
pub(crate) struct Slip<R> {
    pub d: [R; 2],
    pub lost: R,
}

/// How far the distortion holds.
#[derive(Clone, Copy)]
pub(crate) struct Hold<R: Real> {
    pub slides: R::Mask,
    /// I_te before the return.
    pub trial: R,
    /// The factor of D̂ in the Kirchhoff stress.
    pub distortion: R,
    /// 1/ŝ, of a section that is distorted.
    over_distorted: R,
}

impl<R: Real> Slip<R> {
    /// Where there is one, or one that is NaN.
    #[inline(always)]
    pub fn is_any(&self) -> R::Mask {
        let zero = R::splat(0.0);
        !(self.d[0].abs().le(zero) & self.d[1].abs().le(zero))
    }

    /// V, the axes that the section's distortion is referred to.
    #[inline(always)]
    pub fn axes(&self) -> Unimodular<R> {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let [d1, d2] = self.d;
        let (size, square) = (d1.abs(), d1.mul_add(d1, d2 * d2));
        let near_one = square.lt(R::splat(0.25));
        let g = (one + square).sqrt();
        // r ≥ 1, and r − 1 and 1/r − 1 without cancellation.
        let r = (g + size).sqrt();
        // One division for both quotients.
        let sums = (one + g) * (one + r);
        let over_both = one / (r * sums);
        let over_r = sums * over_both;
        let beyond = size.mul_add(one + g, square) * (r * over_both);
        let [long, short] = [R::select(near_one, beyond, r), R::select(near_one, -(beyond * over_r), over_r)];
        let (first, off) = (zero.le(d1), d2 * over_r);
        Unimodular {
            times: [
                [R::select(first, long, short), R::select(first, zero, off)],
                [R::select(first, off, zero), R::select(first, short, long)],
            ],
            near_one,
        }
    }
}

impl<R: Real> Friction<R> {
    /// Friction that a law without it has, whose kernels do not read it.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = R::splat(0.0);
        Friction { mu: zero, cohesion: zero, per_stiffness: zero }
    }

    /// From properties that have been checked.
    pub(super) fn new(k_td: R, mu: R, cohesion: R) -> Self {
        let zero = R::splat(0.0);
        // A stiffness too small for its reciprocal counts as none.
        let stiff = R::splat(R::MIN_POSITIVE).le(k_td);
        let per_stiffness = R::select(stiff, R::splat(2.0) / R::select(stiff, k_td, R::splat(1.0)), zero);
        Friction { mu, cohesion, per_stiffness }
    }

    /// Its numbers, from which [`from_numbers`](Self::from_numbers) makes it again.
    pub fn numbers(&self) -> [R; 3] {
        [self.mu, self.cohesion, self.per_stiffness]
    }

    #[inline(always)]
    pub fn from_numbers([mu, cohesion, per_stiffness]: [R; 3]) -> Self {
        Friction { mu, cohesion, per_stiffness }
    }

    /// The same friction in another number type.
    #[inline(always)]
    pub fn lanes<L: Real>(&self) -> Friction<L>
    where
        R: Into<f64>,
    {
        let lane = |x: R| L::splat(x.into());
        Friction { mu: lane(self.mu), cohesion: lane(self.cohesion), per_stiffness: lane(self.per_stiffness) }
    }

    /// µ, of a law that slides.
    #[inline(always)]
    pub fn mu(&self) -> R {
        self.mu
    }

    /// What holds of the distortion of the section `elastic`, given the factors of its stress before the return. Puts
    /// the strain after the return in the place of that before: I_te in place of I_td.
    #[inline(always)]
    pub fn hold(
        &self,
        law: &Hyperelastic<R>,
        elastic: &Section<R>,
        strain: &mut Strain<R>,
        k: &Kirchhoff<R>,
    ) -> Hold<R> {
        let trial = strain.i_td;
        let limit = self.mu.mul_add(k.pressure, self.cohesion);
        let slides = limit.lt(R::splat(0.5) * law.k_td * trial);
        let most = (limit * self.per_stiffness).min(trial);
        let one = R::splat(1.0);
        // The division does not wait for the limit, which takes long to compute.
        let distorted = R::splat(R::MIN_POSITIVE).le(elastic.distortion);
        let over_distorted = one / R::select(distorted, elastic.distortion, one);
        let distortion = R::select(slides, limit * over_distorted, k.distortion);
        strain.i_td = R::select(slides, most, trial);
        strain.distortion_ratio = R::select(slides, distortion * self.per_stiffness, strain.distortion_ratio);
        Hold { slides, trial, distortion, over_distorted }
    }

    /// The slip after the return to `i_te`, where the fibres slide, from the old one and the old I_te; `section` is the
    /// whole one, `elastic` that of which the distortion is held.
    #[inline(always)]
    pub fn slid(
        &self,
        law: &Hyperelastic<R>,
        (old, old_i_te): (&Slip<R>, R),
        section: &Section<R>,
        elastic: &Section<R>,
        i_te: R,
        hold: &Hold<R>,
    ) -> Slip<R> {
        let (one, two, half) = (R::splat(1.0), R::splat(2.0), R::splat(0.5));
        let &Hold { slides, trial, over_distorted, .. } = hold;
        let [area, over_area] = section.area_ratio();
        // One point comes here only if it slides.
        let sliding = |x: R, other: R| if R::PAIRS { x } else { R::select(slides, x, other) };
        // The smaller of the two parts of 2 I_te, u, and the shares of both ends of the geodesic: sinh u/s, and
        // sinh(2 I_te − u)/s = e^−u − e^(−2 I_te) sinh u/s, a difference of which at least half is left.
        let (held, lost) = (two * i_te, two * (trial - i_te));
        let (sinh, decay) = sinh_and_exp_of_minus(held.min(lost));
        let smaller = sinh * area * over_distorted;
        let shape = sliding(elastic.distortion + elastic.half_trace, one);
        let larger = decay - smaller * (area / shape);
        let less_is_held = held.lt(lost);
        let of_old = R::select(less_is_held, smaller, larger);
        let of_shape = R::select(less_is_held, larger, smaller) * over_area;
        let next = |d: R, shape: R| sliding(of_old.mul_add(d, -(of_shape * shape)), d);
        let from = i_te.max(trial.min(old_i_te));
        let work = half * law.k_td * (i_te + from) * (trial - i_te);
        Slip {
            d: [next(old.d[0], section.delta), next(old.d[1], section.x23)],
            lost: sliding(old.lost + work, old.lost),
        }
    }
}

/// 0 for −0. Which of them comes out depends on whether fibres in the same register have slid before, and the bits of a
/// point must not.
#[inline(always)]
pub(super) fn unsigned_zero<R: Real>(x: R) -> R {
    x + R::splat(0.0)
}
