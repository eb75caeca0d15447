//! Differences of products that lose no digits, quotients and reciprocals that are correctly rounded, in registers of
//! x86-64.

use core::arch::x86_64::*;

use super::super::real::Real;
use super::{F32x4, F64x2};

/// a b − c d with a fused multiply-add: the rounding error of one product is known exactly (Kahan).
#[inline(always)]
pub(super) fn fused_difference<R: Real>(a: R, b: R, c: R, d: R) -> R {
    let product = c * d;
    let error = (-c).mul_add(d, product);
    a.mul_add(b, -product) + error
}

/// x/d, correctly rounded, given the correctly rounded reciprocal of d: the remainder of a product is exact with a
/// fused multiply-add (Markstein, IBM J. Res. Dev. 34(1), 1990).
#[inline(always)]
pub(super) fn corrected_quotient<R: Real>(x: R, divisor: R, reciprocal: R) -> R {
    let quotient = x * reciprocal;
    (-quotient).mul_add(divisor, x).mul_add(reciprocal, quotient)
}

// 1/x in AVX-512, correctly rounded as by a division, from an approximation y of 14 bits. With r = 1 − x y the
// reciprocal is y (1 + r + r² + r³ …). Three terms of the series (one in f32) leave an error of r⁴ ≤ 2^−56 (f32: r² ≤
// 2^−28), less than an eighth of a unit in the last place, before the last sum, whose magnitude is rounded upwards.
// Then follows a Newton step, which is exact but for δ², δ being the relative error of the value that it starts from
// (after Markstein, IBM J. Res. Dev. 34(1), 1990). If 1/x is very close to halfway between two numbers, the sum is the
// larger one, and δ² is too small to carry the step across the middle; from the smaller one it would do so for a
// mantissa of all ones. Elsewhere no middle is near enough to be crossed. The sum takes the magnitudes of its terms,
// because upwards is towards zero for a negative number.

/// The first `TERMS` terms of r + r² + …, with r = 1 − x y.
#[inline(always)]
pub(crate) fn reciprocal_series<R: Real, const TERMS: u8>(x: R, y: R) -> R {
    let r = (-x).mul_add(y, R::splat(1.0));
    let mut series = r;
    for _ in 1..TERMS {
        series = series.mul_add(r, r);
    }
    series
}

/// A Newton step for 1/x from y.
#[inline(always)]
pub(crate) fn newton_reciprocal<R: Real>(x: R, y: R) -> R {
    (-x).mul_add(y, R::splat(1.0)).mul_add(y, y)
}

/// The 26 leading bits of each number.
#[inline(always)]
pub(super) fn leading_half(x: F64x2) -> F64x2 {
    // SAFETY: as in `register!`: the processor has the instructions.
    F64x2(unsafe { _mm_and_pd(x.0, _mm_castsi128_pd(_mm_set1_epi64x(!0x7ff_ffff))) })
}

/// A product and its rounding error, by the same operations as the scalar.
#[inline(always)]
pub(super) fn two_product(a: F64x2, b: F64x2) -> (F64x2, F64x2) {
    let (a_high, b_high) = (leading_half(a), leading_half(b));
    let (a_low, b_low) = (a - a_high, b - b_high);
    let product = a * b;
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

/// a b − c d without a fused multiply-add, by the same operations as the scalar.
#[inline(always)]
pub(super) fn split_difference(a: F64x2, b: F64x2, c: F64x2, d: F64x2) -> F64x2 {
    let ((p, p_error), (q, q_error)) = (two_product(a, b), two_product(c, d));
    (p - q) + (p_error - q_error)
}

/// a b − c d of two numbers in single precision, through double precision.
#[inline(always)]
pub(super) fn widened_half(a: __m128, b: __m128, c: __m128, d: __m128) -> __m128 {
    // SAFETY: as in `register!`: the processor has the instructions.
    unsafe {
        let (a, b, c, d) = (_mm_cvtps_pd(a), _mm_cvtps_pd(b), _mm_cvtps_pd(c), _mm_cvtps_pd(d));
        _mm_cvtpd_ps(_mm_sub_pd(_mm_mul_pd(a, b), _mm_mul_pd(c, d)))
    }
}

/// a b − c d in single precision, through double precision as for the scalar.
#[inline(always)]
pub(super) fn widened_difference(a: F32x4, b: F32x4, c: F32x4, d: F32x4) -> F32x4 {
    let (F32x4(a), F32x4(b), F32x4(c), F32x4(d)) = (a, b, c, d);
    // SAFETY: as in `register!`: the processor has the instructions.
    F32x4(unsafe {
        let high = widened_half(_mm_movehl_ps(a, a), _mm_movehl_ps(b, b), _mm_movehl_ps(c, c), _mm_movehl_ps(d, d));
        _mm_movelh_ps(widened_half(a, b, c, d), high)
    })
}
