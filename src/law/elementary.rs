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
//! | `asinh(s)` | 4.5 | 4.5 | 0 ≤ s ≤ 1e150 (f64), 1e18 (f32) |
//! | its (asinh s)/s | 6.5 | 6.5 | as above |
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
    let mut rest = coefficients.iter().rev();
    let mut sum = R::splat(rest.next().copied().unwrap_or(0.0));
    for &c in rest {
        sum = sum.mul_add(x, R::splat(c));
    }
    sum
}

/// The reciprocals of several numbers by one division, each to within 1 + N/2 ulp; their product must be in range.
#[inline(always)]
pub fn reciprocals<R: Real, const N: usize>(x: [R; N]) -> [R; N] {
    let one = R::splat(1.0);
    // Products of all that stand before; then, from behind, of all that stand after, times the inverse of everything.
    let mut inverses = [one; N];
    let mut product = one;
    for (inverse, &factor) in inverses.iter_mut().zip(&x) {
        *inverse = product;
        product = product * factor;
    }
    let mut rest = one / product;
    for (inverse, &factor) in inverses.iter_mut().zip(&x).rev() {
        *inverse = *inverse * rest;
        rest = rest * factor;
    }
    inverses
}

/// A logarithm half done: y = (1 + f) 2^k with 1 + f in [√½, √2). What is missing is a reciprocal, which several may share.
#[derive(Clone, Copy, Debug)]
pub struct Logarithm<R> {
    f: R,
    k: R,
}

impl<R: Real> Logarithm<R> {
    /// For positive normal y.
    #[inline(always)]
    pub fn new(y: R) -> Self {
        let (z, k) = y.split_exponent();
        Logarithm { f: z - R::splat(1.0), k }
    }

    /// What the reciprocal is wanted of: 2 + f.
    #[inline(always)]
    pub fn denominator(&self) -> R {
        R::splat(2.0) + self.f
    }

    /// ln(1 + f) = f − (f²/2 − rest): f is exact, so that an error of the reciprocal weighs little.
    #[inline(always)]
    fn parts(&self, reciprocal: R) -> (R, R) {
        let s = self.f * reciprocal;
        let half_square = R::splat(0.5) * self.f * self.f;
        let w = s * s;
        (half_square, s * (half_square + w * polynomial(R::LN, w)))
    }

    /// ln y + correction, for a correction far below one.
    #[inline(always)]
    pub fn finish(&self, reciprocal: R, correction: R) -> R {
        let (half_square, rest) = self.parts(reciprocal);
        let (high, low) = ln_2::<R>();
        let small = rest + self.k.mul_add(low, correction);
        self.k.mul_add(high, self.f - (half_square - small))
    }
}

/// ln(y + c) for positive normal y and a correction c far below y.
#[inline(always)]
pub fn ln_sum<R: Real>(y: R, c: R) -> R {
    let logarithm = Logarithm::new(y);
    logarithm.finish(R::splat(1.0) / logarithm.denominator(), c / y)
}

/// ln(1 + x), x > −1.
#[inline(always)]
pub fn ln_1p<R: Real>(x: R) -> R {
    let one = R::splat(1.0);
    let y = one + x;
    ln_sum(y, x - (y - one))
}

/// asinh s half done, for s ≥ 0: what is missing are two reciprocals.
///
/// With y = e^a = s + √(1 + s²) and the nearest power of two 2^k, a = k ln 2 + 2 artanh w, w = (y − 2^k)/(y + 2^k). For
/// k = 0 that is w = s/(1 + √(1 + s²)), which holds its digits down to s = 0, and a/s follows without a quotient 0/0.
#[derive(Clone, Copy, Debug)]
pub struct Asinh<R: Real> {
    s: R,
    root: R,
    k: R,
    numerator: R,
    denominator: R,
    /// What rounding took from y, over y.
    correction: R,
    small: R::Mask,
}

impl<R: Real> Asinh<R> {
    /// For s ≥ 0 whose square is in range.
    #[inline(always)]
    pub fn new(s: R) -> Self {
        let one = R::splat(1.0);
        let root = s.mul_add(s, one).sqrt();
        let y = root + s;
        let (_, k) = y.split_exponent();
        let small = k.le(R::splat(0.0));
        let power = k.power_of_two();
        Asinh {
            s,
            root,
            k,
            numerator: R::select(small, s, y - power),
            denominator: R::select(small, one + root, y + power),
            correction: (s - (y - root)) * (root - s),
            small,
        }
    }

    /// What the reciprocals are wanted of.
    #[inline(always)]
    pub fn denominators(&self) -> [R; 2] {
        [self.denominator, R::select(self.small, R::splat(1.0), self.s)]
    }

    /// √(1 + s²) = cosh a.
    #[inline(always)]
    pub fn cosh(&self) -> R {
        self.root
    }

    /// a = asinh s, and a/s.
    #[inline(always)]
    pub fn finish(&self, [reciprocal, over_s]: [R; 2]) -> (R, R) {
        let w = self.numerator * reciprocal;
        let square = w * w;
        // artanh w = w (1 + series/2), exact where w is small.
        let series = square * polynomial(R::LN, square);
        let near = reciprocal * (R::splat(2.0) + series);
        let (high, low) = ln_2::<R>();
        let far = self.k.mul_add(high, w.mul_add(series, self.k.mul_add(low, self.correction)) + (w + w));
        (R::select(self.small, self.s * near, far), R::select(self.small, near, far * over_s))
    }
}

/// asinh s, (asinh s)/s and √(1 + s²) for s ≥ 0.
#[inline(always)]
pub fn asinh<R: Real>(s: R) -> (R, R, R) {
    let asinh = Asinh::new(s);
    let (value, ratio) = asinh.finish(reciprocals(asinh.denominators()));
    (value, ratio, asinh.cosh())
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

    /// The same exponent in another number.
    #[inline(always)]
    pub fn map<L>(self, lane: impl Fn(R) -> L) -> Exponent<L> {
        Exponent {
            value: lane(self.value),
            high: lane(self.high),
            low: lane(self.low),
            over_ln_2: lane(self.over_ln_2),
        }
    }
}

/// i^q for i ≥ 0 and q > 0; 0 for subnormal i.
///
/// The exponent of i is kept apart from ln of its mantissa, since one double cannot hold their sum to enough digits.
#[inline(always)]
pub fn power<R: Real>(i: R, q: Exponent<R>) -> R {
    let zero = R::splat(0.0);
    let logarithm = Logarithm::new(i);
    let (half_square, rest) = logarithm.parts(R::splat(1.0) / logarithm.denominator());
    let (k, ln_z) = (logarithm.k, logarithm.f - (half_square - rest));
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
