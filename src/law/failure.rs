//! The failure criterion of the yarn: uniaxial (UF) and multiaxial (MF) failure, and the latch (thesis, section 4.4.2).

use super::kinematics::Strain;
use super::number::elementary::ln_1p;
use super::number::real::Real;

/// The least limit that is used: for a smaller one any tension fails as well, but the failure index might overflow.
const LEAST_LIMIT: f64 = 1e-30;

/// The failure criterion, prepared once.
#[derive(Clone, Copy, Debug)]
pub struct Failure<R> {
    /// I_lim = ln(1 + ε_lim), and its reciprocal.
    limit: R,
    inverse_limit: R,
    /// The index is 0 unless the elongation invariant is above this: 0, or infinity for a law without failure.
    threshold: R,
    /// The weights of compaction and distortion, α and β; both 0 is uniaxial failure.
    alpha: R,
    beta: R,
}

impl<R: Real> Failure<R> {
    /// No point fails.
    #[inline(always)]
    pub fn none() -> Self {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let threshold = R::splat(f64::INFINITY);
        Failure { limit: one, inverse_limit: one, threshold, alpha: zero, beta: zero }
    }

    /// From the properties ε_lim (0: no failure), α and β.
    #[inline(always)]
    pub fn new(eps_lim: R, alpha: R, beta: R) -> Self {
        Failure::with_limit(eps_lim, ln_1p(eps_lim), alpha, beta)
    }

    /// As [`new`](Self::new), given `limit` = ln(1 + ε_lim).
    #[inline(always)]
    pub fn with_limit(eps_lim: R, limit: R, alpha: R, beta: R) -> Self {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let fails = zero.lt(eps_lim);
        let limit = R::select(fails, limit.max(R::splat(LEAST_LIMIT)), one);
        let threshold = R::select(fails, zero, R::splat(f64::INFINITY));
        Failure { limit, inverse_limit: one / limit, threshold, alpha, beta }
    }

    /// The same criterion with `limit` = ln(1 + ε_lim) for a point that has a limit of its own; where that is 0, the
    /// criterion itself.
    #[inline(always)]
    pub fn at(self, limit: R) -> Self {
        let zero = R::splat(0.0);
        let own = zero.lt(limit);
        let limit = R::select(own, limit.max(R::splat(LEAST_LIMIT)), self.limit);
        // That of a division, for all limits that a point can reach: `reciprocals_are_those_of_a_division`.
        Failure { limit, inverse_limit: limit.reciprocal(), threshold: R::select(own, zero, self.threshold), ..self }
    }

    /// Whether a point may have this limit of its own: a finite number, not negative.
    #[inline(always)]
    pub fn is_limit(limit: R) -> R::Mask {
        R::splat(0.0).le(limit) & limit.lt(R::splat(f64::INFINITY))
    }

    /// Its numbers, from which [`from_numbers`](Self::from_numbers) makes it again.
    pub fn numbers(&self) -> [R; 5] {
        [self.limit, self.inverse_limit, self.threshold, self.alpha, self.beta]
    }

    #[inline(always)]
    pub fn from_numbers([limit, inverse_limit, threshold, alpha, beta]: [R; 5]) -> Self {
        Failure { limit, inverse_limit, threshold, alpha, beta }
    }

    /// The same criterion with its numbers converted by `lane`.
    #[inline(always)]
    pub fn map<L>(self, lane: impl Fn(R) -> L) -> Failure<L> {
        Failure {
            limit: lane(self.limit),
            inverse_limit: lane(self.inverse_limit),
            threshold: lane(self.threshold),
            alpha: lane(self.alpha),
            beta: lane(self.beta),
        }
    }

    /// I_el/I_lim + α⟨−I_tc⟩ + β I_td where the fibre is in tension, else 0: 1 exactly at the limit.
    #[inline(always)]
    pub fn index(&self, strain: &Strain<R>) -> R {
        let zero = R::splat(0.0);
        // A quotient, not a product with 1/I_lim: it is exactly 1 where I_el = I_lim.
        let quotient = strain.i_el.quotient(self.limit, self.inverse_limit);
        let index = quotient + (-self.alpha).mul_add(strain.i_tc.min(zero), self.beta * strain.i_td);
        R::select(self.threshold.lt(strain.i_el), index, zero)
    }

    /// Whether a failure index means failure; an index of exactly 1 does.
    #[inline(always)]
    pub fn reached(index: R) -> R::Mask {
        R::splat(1.0).le(index)
    }

    /// Whether a latch means that the point has not failed before: it is below ½. A latch that is NaN counts as failed.
    #[inline(always)]
    pub fn intact(latch: R) -> R::Mask {
        latch.lt(R::splat(0.5))
    }
}
