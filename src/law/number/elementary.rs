//! Logarithm, inverse hyperbolic sine and power, written over [`Real`]: the same functions in every build.
//!
//! The `log` of a C library differs between machines and has no lanes; these functions give the same bits wherever the
//! arithmetic does. Errors in units in the last place (ulp), the worst found by the tests against a correctly rounded
//! reference at every level of instructions (`law/tests/elementary.rs`):
//!
//! | function | f64 | f32 | where |
//! |---|---|---|---|
//! | `ln_sum(y, c)` = ln(y + c) | 3.0 | 3.0 | 0 < y < 2^1023 (f64), 2^127 (f32), normal, \|c\| ≤ ulp(y)/2 |
//! | `ln_1p(x)` = ln(1 + x) | 3.0 | 3.0 | x > −1 |
//! | `asinh(s)` | 4.5 | 4.5 | 0 ≤ s ≤ 1e150 (f64), 1e18 (f32) |
//! | (asinh s)/s | 6.5 | 6.5 | as above |
//! | `ln(x)` | 3.0 | 3.0 | normal x |
//! | `exp(x)` | 1.5 | 1.5 | results that are normal numbers |
//! | `sinh_and_exp_of_minus(u)` = sinh u, e^−u | 2.5 | 2.5 | u ≥ 0, eᵘ a normal number |
//! | `powf(x, q)` = x^q | 1.5 + 2 \|q\| | 1.5 + 2 \|q\| | normal x, \|q\| ≤ 1000; as for `power`, but above the range infinite |
//! | `power(i, q)` = i^q | 1.2 + 1.5 q | 1.2 + 1.8 q | normal i ≥ 0, 0 < q ≤ 39; results below about 2^−1001 (f64), 2^−105 (f32) are 0; above 2^1004 (f64) unspecified, above 2^127 (f32) infinite |

use core::f64::consts::{LN_2, LOG2_E};

use super::real::Real;

/// A polynomial of up to twelve coefficients, given from the constant one on. Fours of terms are summed side by side,
/// and their sums by Horner's scheme: the chain of dependent operations is less than half as long as Horner's, at one
/// or two operations more.
#[inline(always)]
fn polynomial<R: Real>(coefficients: &[f64], x: R) -> R {
    let square = x * x;
    let low = four(coefficients, 0, x, square);
    if coefficients.len() <= 4 {
        return low;
    }
    let (fourth, middle) = (square * square, four(coefficients, 4, x, square));
    if coefficients.len() <= 8 {
        return middle.mul_add(fourth, low);
    }
    four(coefficients, 8, x, square).mul_add(fourth, middle).mul_add(fourth, low)
}

/// The sum of up to four terms from the k-th on, divided by x^k.
#[inline(always)]
fn four<R: Real>(coefficients: &[f64], k: usize, x: R, square: R) -> R {
    let low = pair(coefficients, k, x);
    if coefficients.len() <= k + 2 { low } else { pair(coefficients, k + 2, x).mul_add(square, low) }
}

/// The sum of one or two terms from the k-th on, divided by x^k.
#[inline(always)]
fn pair<R: Real>(coefficients: &[f64], k: usize, x: R) -> R {
    match coefficients.get(k..) {
        Some(&[c0, c1, ..]) => R::splat(c1).mul_add(x, R::splat(c0)),
        Some(&[c0]) => R::splat(c0),
        _ => R::splat(0.0),
    }
}

/// A logarithm up to its last step: y = (1 + f) 2^k with 1 + f in [¾, 1½), and s = f/(1 + f/2).
#[derive(Clone, Copy, Debug)]
pub struct Logarithm<R> {
    s: R,
    k: R,
}

impl<R: Real> Logarithm<R> {
    /// For positive normal y.
    #[inline(always)]
    pub fn new(y: R) -> Self {
        let (z, k) = y.split_exponent();
        let f = z - R::splat(1.0);
        Logarithm { s: f / R::splat(0.5).mul_add(f, R::splat(1.0)), k }
    }

    /// Two logarithms side by side, see [`Real::pair`].
    #[inline(always)]
    pub fn pair(&self, other: &Self) -> Self {
        Logarithm { s: self.s.pair(other.s), k: self.k.pair(other.k) }
    }

    /// ln(1 + f) = 2 artanh(s/2).
    #[inline(always)]
    fn of_mantissa(&self) -> R {
        let square = self.s * self.s;
        self.s.mul_add(square * polynomial(R::LN, square), self.s)
    }

    /// ln(y + c) for a correction c much smaller than y, given 1/y.
    #[inline(always)]
    pub fn finish(&self, c: R, over_y: R) -> R {
        self.k.mul_add(R::splat(LN_2), c.mul_add(over_y, self.of_mantissa()))
    }
}

/// ln(y + c) for positive normal y and a correction c much smaller than y.
#[inline(always)]
pub fn ln_sum<R: Real>(y: R, c: R) -> R {
    Logarithm::new(y).finish(c, y.reciprocal())
}

/// ln x of a positive normal number.
#[inline(always)]
pub fn ln_of_normal<R: Real>(x: R) -> R {
    let logarithm = Logarithm::new(x);
    logarithm.k.mul_add(R::splat(LN_2), logarithm.of_mantissa())
}

/// ln x: −∞ at 0 and for subnormal numbers, NaN below.
#[inline(always)]
pub fn ln<R: Real>(x: R) -> R {
    let (zero, least, infinity) = (R::splat(0.0), R::splat(R::MIN_POSITIVE), R::splat(f64::INFINITY));
    let normal = ln_of_normal(x);
    let value = R::select(x.lt(infinity), normal, x);
    R::select(x.lt(least), R::select(x.lt(zero), R::splat(f64::NAN), -infinity), value)
}

/// ln(1 + x), x > −1.
#[inline(always)]
pub fn ln_1p<R: Real>(x: R) -> R {
    let one = R::splat(1.0);
    let y = one + x;
    ln_sum(y, x - (y - one))
}

/// a = asinh(s/j) for s ≥ 0 and j > 0 up to its last step.
///
/// With z = e^2a = (s + t)²/j², t = √(s² + j²), and the nearest power of two 2^k, a = ½ k ln 2 + artanh w, w = (z −
/// 2^k)/(z + 2^k). For k = 0 that is w = s/t, which keeps its digits down to s = 0, and a/s follows without a quotient
/// 0/0.
#[derive(Clone, Copy)]
pub struct Asinh<R: Real> {
    k: R,
    w: R,
    /// t where k = 0, else s: what a/s is divided by.
    divisor: R,
    small: R::Mask,
}

impl<R: Real> Asinh<R> {
    /// From s, t = √(s² + j²) and 1/j²; t² and 1/j² must be normal numbers. Also returns e^2a.
    #[inline(always)]
    pub fn new(s: R, t: R, over_j_square: R) -> (Self, R) {
        let one = R::splat(1.0);
        let sum = s + t;
        let growth = sum * sum * over_j_square;
        let (z, k) = growth.split_exponent();
        // w < 1/5, that is z < 1½ with room for rounding: there k = 0.
        let small = (R::splat(5.01) * s).lt(t);
        // For k = 1, w = (3s − t)/(3t − s), which contains the error of s and t but not that of j.
        let three = R::splat(3.0);
        let middle = k.lt(R::splat(1.5));
        let numerator = R::select(small, s, R::select(middle, three.mul_add(s, -t), z - one));
        let denominator = R::select(small, t, R::select(middle, three.mul_add(t, -s), z + one));
        let k = R::select(small, R::splat(0.0), k.max(one));
        (Asinh { k, w: numerator / denominator, divisor: R::select(small, t, s), small }, growth)
    }

    /// ½a and ½a/s.
    #[inline(always)]
    pub fn finish(&self) -> (R, R) {
        let (a, series) = self.alone().with_series();
        // ½ artanh w = w · series, and w/s = 1/t where k = 0.
        (a, R::select(self.small, series, a) / self.divisor)
    }

    /// What a needs, and a/s does not.
    #[inline(always)]
    pub fn alone(&self) -> AsinhAlone<R> {
        AsinhAlone { k: self.k, w: self.w }
    }
}

/// What is left of [`Asinh`] if a/s is not asked for.
#[derive(Clone, Copy)]
pub struct AsinhAlone<R> {
    k: R,
    w: R,
}

impl<R: Real> AsinhAlone<R> {
    /// ½a.
    #[inline(always)]
    pub fn finish(&self) -> R {
        self.with_series().0
    }

    /// ½a, and ½ (artanh w)/w.
    #[inline(always)]
    fn with_series(&self) -> (R, R) {
        let square = self.w * self.w;
        let series = square.mul_add(polynomial(R::HALF_ARTANH, square), R::splat(0.5));
        (self.k.mul_add(R::splat(0.25 * LN_2), self.w * series), series)
    }
}

/// The exponent of a power, prepared once: q = high + low, where the product of `high` and an integer up to 2^11 is
/// exact.
#[derive(Clone, Copy, Debug)]
pub struct Exponent<R> {
    value: R,
    high: R,
    /// low · ln 2.
    low_ln_2: R,
    over_ln_2: R,
}

impl<R: Real> Exponent<R> {
    /// For q > 0.
    #[inline(always)]
    pub fn new(q: R) -> Self {
        // Veltkamp's split at 2^13 leaves 40 bits of 53; in single precision 11 of 24.
        let factor = R::splat(8193.0);
        let big = factor * q;
        let high = big - (big - q);
        Exponent { value: q, high, low_ln_2: (q - high) * R::splat(LN_2), over_ln_2: q * R::splat(LOG2_E) }
    }

    /// Its numbers, from which [`from_numbers`](Self::from_numbers) makes it again.
    pub fn numbers(&self) -> [R; 4] {
        [self.value, self.high, self.low_ln_2, self.over_ln_2]
    }

    #[inline(always)]
    pub fn from_numbers([value, high, low_ln_2, over_ln_2]: [R; 4]) -> Self {
        Exponent { value, high, low_ln_2, over_ln_2 }
    }

    /// The same exponent with its numbers converted by `lane`.
    #[inline(always)]
    pub fn map<L>(self, lane: impl Fn(R) -> L) -> Exponent<L> {
        Exponent {
            value: lane(self.value),
            high: lane(self.high),
            low_ln_2: lane(self.low_ln_2),
            over_ln_2: lane(self.over_ln_2),
        }
    }
}

/// i^q in three steps, each a chain of dependent operations short enough for the processor to overlap several points.
///
/// The exponent of i is kept apart from ln of its mantissa, since one number cannot hold their sum to enough digits.
#[derive(Clone, Copy)]
pub struct Power<R: Real> {
    logarithm: Logarithm<R>,
    nonzero: R::Mask,
}

impl<R: Real> Power<R> {
    /// The first step; an i that is negative or below the normal numbers counts as 0.
    #[inline(always)]
    pub fn new(i: R) -> Self {
        let least = R::splat(R::MIN_POSITIVE);
        Power { logarithm: Logarithm::new(i.max(least)), nonzero: least.le(i) }
    }

    /// The second step: i^q = 2^n e^r, |r| ≤ ½ ln 2.
    #[inline(always)]
    pub fn reduce(&self, q: &Exponent<R>) -> Reduced<R> {
        self.reduced(q, self.logarithm.k, self.logarithm.of_mantissa())
    }

    /// The first two steps and ln(1 + x), with both logarithms in one number, which must have room for two.
    #[inline(always)]
    pub fn reduce_beside(i: R, q: &Exponent<R>, x: R) -> (Reduced<R>, R) {
        let one = R::splat(1.0);
        let least = R::splat(R::MIN_POSITIVE);
        let y = one + x;
        let logarithm = Logarithm::new(i.max(least).pair(y));
        let ([k, other_k], [ln_z, other]) = (logarithm.k.apart(), logarithm.of_mantissa().apart());
        let power = Power { logarithm, nonzero: least.le(i) };
        let lost = (x - (y - one)).mul_add(y.reciprocal(), other);
        (power.reduced(q, k, ln_z), other_k.mul_add(R::splat(LN_2), lost))
    }

    /// The second step, with ln i = k ln 2 + ln z.
    #[inline(always)]
    fn reduced(&self, q: &Exponent<R>, k: R, ln_z: R) -> Reduced<R> {
        let n = q.over_ln_2.mul_add(ln_z, q.value * k).round();
        let d = q.high.mul_add(k, -n);
        let r = d.mul_add(R::splat(LN_2), q.low_ln_2.mul_add(k, q.value * ln_z));
        Reduced { n, r, nonzero: self.nonzero & R::splat(R::EXPONENTS.0).le(n) }
    }
}

/// A power after the second step.
#[derive(Clone, Copy)]
pub struct Reduced<R: Real> {
    n: R,
    r: R,
    nonzero: R::Mask,
}

impl<R: Real> Reduced<R> {
    /// The third step: 2^n e^r, or 0 if the power underflows.
    #[inline(always)]
    pub fn finish(&self) -> R {
        let Reduced { n, r, nonzero } = *self;
        let exponential = (r * r).mul_add(polynomial(R::EXP, r), r) + R::splat(1.0);
        let power = R::select(nonzero, exponential.times_power_of_two(n), R::splat(0.0));
        if R::WIDE_RANGE {
            return power; // no compaction makes the power overflow
        }
        // 2^n by itself overflows.
        R::select(R::splat(R::EXPONENTS.1 + 19.0).lt(n), R::splat(f64::INFINITY), power)
    }
}

/// i^q for i ≥ 0 and q > 0.
#[inline(always)]
pub fn power<R: Real>(i: R, q: &Exponent<R>) -> R {
    Power::new(i).reduce(q).finish()
}

/// The greatest exponent of two of a finite number, and that of the least normal one.
#[inline(always)]
fn exponents<R: Real>() -> (R, R) {
    (R::splat(R::EXPONENTS.1 + 19.0), R::splat(R::EXPONENTS.0 - 21.0))
}

/// 2^n e^r for |r| ≤ ½ ln 2 and any integer n: ∞ and 0 where it is beyond the normal numbers.
#[inline(always)]
fn scaled_exponential<R: Real>(n: R, r: R) -> R {
    let (most, least) = exponents::<R>();
    let exponential = (r * r).mul_add(polynomial(R::EXP, r), r) + R::splat(1.0);
    // Twice, since 2^n may be too large where the product is not.
    let first = R::select(most.lt(n), R::splat(1.0), R::splat(0.0));
    let value = exponential.times_power_of_two((n - first).max(least).min(most)).times_power_of_two(first);
    let value = R::select((most + R::splat(1.0)).lt(n), R::splat(f64::INFINITY), value);
    R::select(n.lt(least), R::splat(0.0), value)
}

/// ln 2 = high + low, where the product of `high` and the exponent of any number is exact (32 bits of 53; 15 of 24).
#[inline(always)]
fn ln_2_in_parts<R: Real>() -> (f64, f64) {
    if R::EPSILON < 1e-10 {
        return (f64::from_bits(0x3fe6_2e42_fee0_0000), 1.908_214_929_270_587_7e-10);
    }
    (0.693_145_751_953_125, LN_2 - 0.693_145_751_953_125)
}

/// eˣ: ∞ and 0 where it is beyond the normal numbers.
#[inline(always)]
pub fn exp<R: Real>(x: R) -> R {
    let (high, low) = ln_2_in_parts::<R>();
    let double = R::EPSILON < 1e-10;
    let bound = R::splat(if double { 750.0 } else { 110.0 });
    let inside = (-bound).lt(x) & x.lt(bound);
    let within = R::select(inside, x, R::splat(0.0));
    let n = (within * R::splat(LOG2_E)).round();
    let r = n.mul_add(R::splat(-low), n.mul_add(R::splat(-high), within));
    let beyond = R::select(x.lt(R::splat(0.0)), R::splat(0.0), R::select(bound.le(x), R::splat(f64::INFINITY), x));
    R::select(inside, scaled_exponential(n, r), beyond)
}

/// sinh u and e^−u for 0 ≤ u, where eᵘ is a normal number.
#[inline(always)]
pub fn sinh_and_exp_of_minus<R: Real>(u: R) -> (R, R) {
    let one = R::splat(1.0);
    let (high, low) = ln_2_in_parts::<R>();
    let n = (u * R::splat(LOG2_E)).round();
    let r = n.mul_add(R::splat(-low), n.mul_add(R::splat(-high), u));
    // eᵘ and e^−u by one series: their powers of two do not wait for r, and neither needs a division by the other.
    let half = R::splat(0.5);
    let (power, inverse) = (half.times_power_of_two(n), half.times_power_of_two(-n));
    let (sum, difference) = (power + inverse, power - inverse);
    // cosh r − 1 and sinh r, by the even and the odd terms of eʳ.
    let square = r * r;
    let [even, odd] = R::EXP_BY_PARITY;
    let (cosh_less_one, sinh) = (square * polynomial(even, square), (r * square).mul_add(polynomial(odd, square), r));
    // The large term last: where it and sinh r cancel, their difference is exact.
    let of_both = difference + sum.mul_add(sinh, difference * cosh_less_one);
    (of_both, (inverse + inverse) * (one + (cosh_less_one - sinh)))
}

/// x^q for |q| up to 1000: ∞ and 0 where it is beyond the numbers that [`power`] has; 0^q is 0, 1 or ∞; NaN for x < 0.
#[inline(always)]
pub fn powf<R: Real>(x: R, q: R) -> R {
    let (zero, one, infinity) = (R::splat(0.0), R::splat(1.0), R::splat(f64::INFINITY));
    let Reduced { n, r, .. } = Power::new(x).reduce(&Exponent::new(q));
    let (most, least) = (exponents::<R>().0, R::splat(R::EXPONENTS.0));
    let value = scaled_exponential(n.max(least).min(most + R::splat(2.0)), r);
    let value = R::select(n.lt(least), zero, value);
    let of_zero = R::select(zero.lt(q), zero, R::select(q.lt(zero), infinity, one));
    let value = R::select(R::splat(R::MIN_POSITIVE).le(x), value, of_zero);
    // A negative or infinite x, and what is no number.
    let finite = zero.le(x) & x.lt(infinity) & (q * zero).le(zero);
    R::select(finite, value, R::splat(f64::NAN) * x)
}
