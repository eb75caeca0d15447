//! One logarithm, inverse hyperbolic sine, power and exponential for every build, written over [`Real`].
//!
//! A library's `log` differs from machine to machine and cannot run in lanes; these give the same bits everywhere that
//! the arithmetic does. Errors in units in the last place (ulp), worst found by the tests against a correctly rounded
//! reference (`tests/elementary.rs`):
//!
//! | function | f64 | f32 | where |
//! |---|---|---|---|
//! | `ln_sum(y, c)` = ln(y + c) | 0.9 | 0.9 | y > 0 normal, \|c\| ≤ ulp(y)/2 |
//! | `ln_1p(x)` = ln(1 + x) | 0.9 | 0.9 | x > −1 |
//! | `asinh(s)` | 1.7 | 1.7 | 0 ≤ s ≤ 1e150 (f64), 1e18 (f32) |
//! | its √(1 + s²) | 1.1 | 1.1 | as above |
//! | `power(i, q)` = i^q | 1.2 + q | 1.2 + q | normal i ≥ 0, 0 < q ≤ 8; smaller results than normal ones are 0, larger ones than 2^1023 (f64), 2^127 (f32) infinite |
//!
//! The coefficients are minimax polynomials found by Remez exchange in 300-bit arithmetic.

use super::real::Real;

/// (ln((1+s)/(1−s)) − 2s)/s³ in powers of s², |s| ≤ (√2−1)/(√2+1); relative error of the logarithm 2^−59.5, 2^−30.2.
pub(super) const LN_F64: [f64; 7] = [
    0.6666666666666734,
    0.3999999999941432,
    0.2857142874247479,
    0.22222198563493892,
    0.18183564866252683,
    0.15314035845644636,
    0.1479610534032223,
];
pub(super) const LN_F32: [f64; 3] = [0.6666677641510833, 0.39977536980536554, 0.29871862251881137];

/// (e^r − 1 − r)/r² in powers of r, |r| ≤ ½ ln 2; error of the exponential 2^−58, 2^−28.2.
pub(super) const EXP_F64: [f64; 10] = [
    0.5000000000000012,
    0.166666666666667,
    0.04166666666651542,
    0.008333333333307205,
    0.0013888888947016604,
    0.00019841269917383284,
    2.4801489941623132e-05,
    2.7557216301455982e-06,
    2.763128051606888e-07,
    2.5117860795509996e-08,
];
pub(super) const EXP_F32: [f64; 5] =
    [0.5000000095185461, 0.1666651883965976, 0.04166620580112459, 0.008368889354403867, 0.0013950491223541559];

/// ln 2 in two parts; the high one has 32 significant bits (12 for f32), so that an exponent times it is exact.
#[inline(always)]
fn ln_2<R: Real>() -> (R, R) {
    let high = if R::LN.len() > LN_F32.len() {
        f64::from_bits(core::f64::consts::LN_2.to_bits() & !0x1f_ffff)
    } else {
        0.693115234375
    };
    // ln 2 − high: the second word of ln 2 matters in double precision only.
    (R::splat(high), R::splat((core::f64::consts::LN_2 - high) + 2.319_046_813_846_3e-17))
}

#[inline(always)]
fn polynomial<R: Real>(coefficients: &[f64], x: R) -> R {
    let mut sum = R::splat(0.0);
    for &c in coefficients.iter().rev() {
        sum = sum.mul_add(x, R::splat(c));
    }
    sum
}

/// f²/2 and ln(1 + f) + f²/2 − f for z = 1 + f in [√½, √2): what is left of the logarithm is exact in f.
#[inline(always)]
fn ln_parts<R: Real>(f: R) -> (R, R) {
    let s = f / (R::splat(2.0) + f);
    let half_square = R::splat(0.5) * f * f;
    let w = s * s;
    (half_square, s * (half_square + w * polynomial(R::LN, w)))
}

/// ln(y + c) for positive normal y and a correction c far below y.
#[inline(always)]
pub fn ln_sum<R: Real>(y: R, c: R) -> R {
    let (z, k) = y.split_exponent();
    let f = z - R::splat(1.0);
    let (half_square, rest) = ln_parts(f);
    let (high, low) = ln_2::<R>();
    k * high + (f - (half_square - (rest + k.mul_add(low, c / y))))
}

/// ln(1 + x), x > −1.
#[inline(always)]
pub fn ln_1p<R: Real>(x: R) -> R {
    let one = R::splat(1.0);
    let y = one + x;
    ln_sum(y, x - (y - one))
}

/// asinh s, and √(1 + s²), for s ≥ 0.
#[inline(always)]
pub fn asinh<R: Real>(s: R) -> (R, R) {
    let one = R::splat(1.0);
    let square = s * s;
    let root = (one + square).sqrt();
    (ln_1p(s + square / (one + root)), root)
}

/// The exponent of a power, prepared once: q = high + low, where an integer up to 2^11 times `high` is exact.
#[derive(Clone, Copy, Debug)]
pub struct Exponent<R> {
    value: R,
    high: R,
    low: R,
    over_ln_2: R,
}

impl<R: Real> Exponent<R> {
    pub fn new(q: R) -> Self {
        // Veltkamp's split at 2^13 leaves 40 bits of 53; in single precision 11 of 24.
        let factor = R::splat(8193.0);
        let big = factor * q;
        let high = big - (big - q);
        Exponent { value: q, high, low: q - high, over_ln_2: q * R::splat(core::f64::consts::LOG2_E) }
    }
}

/// i^q for i ≥ 0 and q > 0; 0 for subnormal i.
///
/// The exponent of i is kept apart from ln of its mantissa, since one double cannot hold their sum to enough digits.
#[inline(always)]
pub fn power<R: Real>(i: R, q: Exponent<R>) -> R {
    let zero = R::splat(0.0);
    let (z, k) = i.split_exponent();
    let f = z - R::splat(1.0);
    let (half_square, rest) = ln_parts(f);
    let ln_z = f - (half_square - rest);
    // n = nearest integer to log2 of the result, held within the exponents that there are.
    let (lowest, highest) = (R::splat(R::EXPONENTS.0), R::splat(R::EXPONENTS.1));
    let estimate = q.over_ln_2.mul_add(ln_z, q.value * k);
    let too_small = estimate.lt(lowest);
    let too_large = highest.lt(estimate);
    let n = R::select(too_small | too_large, zero, estimate).round();
    let (ln_2_high, ln_2_low) = ln_2::<R>();
    let d = q.high * k - n;
    let r = d * ln_2_high + (d * ln_2_low + (q.low * k * R::splat(core::f64::consts::LN_2) + q.value * ln_z));
    let exponential = (r * r).mul_add(polynomial(R::EXP, r), r) + R::splat(1.0);
    let result = R::select(too_large, R::splat(f64::INFINITY), exponential * n.power_of_two());
    R::select(too_small | i.lt(R::splat(R::MIN_POSITIVE)), zero, result)
}
