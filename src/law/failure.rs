//! When the yarn breaks: uniaxial (UF) and multiaxial (MF) failure, and the latch (thesis, section 4.4.2).

use super::real::Real;

/// The limit, prepared once. A law without failure has an infinite limit and no weights.
#[derive(Clone, Copy, Debug)]
pub struct Failure<R> {
    /// I_lim = ln(1 + ε_lim), or infinity.
    pub limit: R,
    /// The weights of compaction and distortion, α and β; both 0 is uniaxial failure.
    pub alpha: R,
    pub beta: R,
}

impl<R: Real> Failure<R> {
    /// I_el/I_lim + α⟨−I_tc⟩ + β I_td where the fibre is in tension, else 0: 1 exactly at the limit.
    #[inline(always)]
    pub fn index(&self, invariants: &[R; 4]) -> R {
        let zero = R::splat(0.0);
        let [i_el, i_tc, i_td, _] = *invariants;
        // A quotient, not a product with 1/I_lim: it is exactly 1 where I_el = I_lim.
        let index = i_el / self.limit + self.alpha.mul_add((-i_tc).max(zero), self.beta * i_td);
        R::select(zero.lt(i_el), index, zero)
    }

    /// Failed, given the index: equality fails.
    #[inline(always)]
    pub fn reached(index: R) -> R::Mask {
        R::splat(1.0).le(index)
    }

    /// Failed before, given the latch: anything but a number below ½, so that a state full of NaN does not pass as
    /// intact.
    #[inline(always)]
    pub fn latched(latch: R) -> R::Mask {
        !latch.lt(R::splat(0.5))
    }
}
