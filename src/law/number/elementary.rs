//! One logarithm, inverse hyperbolic sine, power and exponential for every build, written over [`Real`].
//!
//! A library's `log` differs from machine to machine and cannot run in lanes; these give the same bits everywhere that
//! the arithmetic does. Errors in units in the last place (ulp), worst found by the tests against a correctly rounded
//! reference at every level of instructions (`law/tests/elementary.rs`):
//!
//! | function | f64 | f32 | where |
//! |---|---|---|---|
//! | `ln_sum(y, c)` = ln(y + c) | 3.0 | 3.0 | 0 < y < 2^1023 (f64), 2^127 (f32), normal, \|c\| ≤ ulp(y)/2 |
//! | `ln_1p(x)` = ln(1 + x) | 3.0 | 3.0 | x > −1 |
//! | `asinh(s)` | 4.5 | 4.5 | 0 ≤ s ≤ 1e150 (f64), 1e18 (f32) |
//! | its (asinh s)/s | 6.5 | 6.5 | as above |
//! | `power(i, q)` = i^q | 1.2 + 1.5 q | 1.2 + 1.8 q | normal i ≥ 0, 0 < q ≤ 39; results below about 2^−1001 (f64), 2^−105 (f32) are 0; those above 2^1004 not promised, above 2^127 (f32) infinite |

use core::f64::consts::{LN_2, LOG2_E};

use super::real::Real;

#[inline(always)]
fn polynomial<R: Real>(coefficients: &[f64], x: R) -> R {
    if R::WAITS {
        return halved_polynomial(coefficients, x);
    }
    let mut rest = coefficients.iter().rev();
    let mut sum = R::splat(rest.next().copied().unwrap_or(0.0));
    for &c in rest {
        sum = sum.mul_add(x, R::splat(c));
    }
    sum
}

/// The same in a chain of logarithmic length (Estrin): neighbours are joined, then neighbours of those. For up to twelve
/// coefficients.
#[inline(always)]
fn halved_polynomial<R: Real>(coefficients: &[f64], x: R) -> R {
    let square = x * x;
    let low = four(coefficients, 0, x, square);
    if coefficients.len() <= 4 {
        return low;
    }
    let fourth = square * square;
    let middle = four(coefficients, 4, x, square);
    if coefficients.len() <= 8 {
        return middle.mul_add(fourth, low);
    }
    four(coefficients, 8, x, square).mul_add(fourth * fourth, middle.mul_add(fourth, low))
}

/// Up to four terms from the k-th on, over x^k.
#[inline(always)]
fn four<R: Real>(coefficients: &[f64], k: usize, x: R, square: R) -> R {
    let low = pair(coefficients, k, x);
    if coefficients.len() <= k + 2 { low } else { pair(coefficients, k + 2, x).mul_add(square, low) }
}

/// One or two terms from the k-th on, over x^k.
#[inline(always)]
fn pair<R: Real>(coefficients: &[f64], k: usize, x: R) -> R {
    match coefficients.get(k..) {
        Some(&[c0, c1, ..]) => R::splat(c1).mul_add(x, R::splat(c0)),
        Some(&[c0]) => R::splat(c0),
        _ => R::splat(0.0),
    }
}

/// A logarithm half done: y = (1 + f) 2^k with 1 + f in [¾, 1½). What is missing is a reciprocal, which several may share.
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

    /// Two logarithms side by side, see [`Real::pair`].
    #[inline(always)]
    pub fn pair(&self, other: &Self) -> Self {
        Logarithm { f: self.f.pair(other.f), k: self.k.pair(other.k) }
    }

    /// What the reciprocal is wanted of: 1 + f/2.
    #[inline(always)]
    pub fn denominator(&self) -> R {
        R::splat(0.5).mul_add(self.f, R::splat(1.0))
    }

    /// ln(1 + f) = 2 artanh(f/(2 + f)).
    #[inline(always)]
    fn of_mantissa(&self, reciprocal: R) -> R {
        // Where the chain of operations is what costs, a division that need not wait for the reciprocal.
        let s = if R::WAITS { self.f / self.denominator() } else { self.f * reciprocal };
        let square = s * s;
        s.mul_add(square * polynomial(R::LN, square), s)
    }

    /// ln(y + c), given c and 1/y, for a correction c far below y.
    #[inline(always)]
    pub fn finish(&self, reciprocal: R, c: R, over_y: R) -> R {
        self.k.mul_add(R::splat(LN_2), c.mul_add(over_y, self.of_mantissa(reciprocal)))
    }
}

/// ln(y + c) for positive normal y and a correction c far below y.
#[inline(always)]
pub fn ln_sum<R: Real>(y: R, c: R) -> R {
    let logarithm = Logarithm::new(y);
    logarithm.finish(logarithm.denominator().reciprocal(), c, y.reciprocal())
}

/// ln(1 + x), x > −1.
#[inline(always)]
pub fn ln_1p<R: Real>(x: R) -> R {
    let one = R::splat(1.0);
    let y = one + x;
    ln_sum(y, x - (y - one))
}

/// a = asinh(s/j) half done, for s ≥ 0 and j > 0, given t = √(s² + j²): what is missing are two reciprocals.
///
/// With z = e^2a = (s + t)²/j² and the nearest power of two 2^k, a = ½ k ln 2 + artanh w, w = (z − 2^k)/(z + 2^k). For
/// k = 0 that is w = s/t, which holds its digits down to s = 0, and a/s follows without a quotient 0/0.
#[derive(Clone, Copy)]
pub struct Asinh<R: Real> {
    k: R,
    numerator: R,
    denominator: R,
    divisor: R,
    small: R::Mask,
}

impl<R: Real> Asinh<R> {
    /// Given s, t = √(s² + j²) and 1/j², all within the range of the number with their squares. Returns e^2a as well.
    #[inline(always)]
    pub fn new(s: R, t: R, over_j_square: R) -> (Self, R) {
        let one = R::splat(1.0);
        let sum = s + t;
        let growth = sum * sum * over_j_square;
        let (z, k) = growth.split_exponent();
        // w < 1/5, that is z < 1½ with room for rounding: there k = 0.
        let small = (R::splat(5.01) * s).lt(t);
        // For k = 1, w = (3s − t)/(3t − s), which has the error of s and t without that of j.
        let three = R::splat(3.0);
        let middle = k.lt(R::splat(1.5));
        let asinh = Asinh {
            k: R::select(small, R::splat(0.0), k.max(one)),
            numerator: R::select(small, s, R::select(middle, three.mul_add(s, -t), z - one)),
            denominator: R::select(small, t, R::select(middle, three.mul_add(t, -s), z + one)),
            divisor: R::select(small, one, s),
            small,
        };
        (asinh, growth)
    }

    /// What the reciprocals are wanted of.
    #[inline(always)]
    pub fn denominators(&self) -> [R; 2] {
        [self.denominator, self.divisor]
    }

    /// ½a, and ½a/s.
    #[inline(always)]
    pub fn finish(&self, [reciprocal, over_s]: [R; 2]) -> (R, R) {
        let w = self.numerator * reciprocal;
        let square = w * w;
        // ½ artanh w = w series.
        let series = square.mul_add(polynomial(R::HALF_ARTANH, square), R::splat(0.5));
        let a = self.k.mul_add(R::splat(0.25 * LN_2), w * series);
        (a, R::select(self.small, reciprocal * series, a * over_s))
    }
}

/// The exponent of a power, prepared once: q = high + low, where an integer up to 2^11 times `high` is exact.
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

    /// The same exponent in another number.
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

/// i^q in three steps, each with a chain of operations short enough for a processor to overlap several.
///
/// The exponent of i is kept apart from ln of its mantissa, since one number cannot hold their sum to enough digits.
#[derive(Clone, Copy)]
pub struct Power<R: Real> {
    logarithm: Logarithm<R>,
    reciprocal: R,
    remains: R::Mask,
}

impl<R: Real> Power<R> {
    /// The first step, for i ≥ 0; what is negative or below the normal numbers counts as 0.
    #[inline(always)]
    pub fn new(i: R) -> Self {
        let least = R::splat(R::MIN_POSITIVE);
        let logarithm = Logarithm::new(i.max(least));
        Power { logarithm, reciprocal: logarithm.denominator().reciprocal(), remains: least.le(i) }
    }

    /// The second: i^q = 2^n e^r, |r| ≤ ½ ln 2.
    #[inline(always)]
    pub fn reduce(&self, q: &Exponent<R>) -> Reduced<R> {
        self.reduced(q, self.logarithm.k, self.logarithm.of_mantissa(self.reciprocal))
    }

    /// The first two steps, and ln(1 + x) beside them, for a number with room for two.
    #[inline(always)]
    pub fn reduce_beside(i: R, q: &Exponent<R>, x: R) -> (Reduced<R>, R) {
        let one = R::splat(1.0);
        let least = R::splat(R::MIN_POSITIVE);
        let y = one + x;
        let logarithm = Logarithm::new(i.max(least).pair(y));
        let reciprocal = logarithm.denominator().reciprocal();
        let ([k, other_k], [ln_z, other]) = (logarithm.k.apart(), logarithm.of_mantissa(reciprocal).apart());
        let power = Power { logarithm, reciprocal, remains: least.le(i) };
        let lost = (x - (y - one)).mul_add(y.reciprocal(), other);
        (power.reduced(q, k, ln_z), other_k.mul_add(R::splat(LN_2), lost))
    }

    /// With ln i = k ln 2 + ln z.
    #[inline(always)]
    fn reduced(&self, q: &Exponent<R>, k: R, ln_z: R) -> Reduced<R> {
        let n = q.over_ln_2.mul_add(ln_z, q.value * k).round();
        let d = q.high.mul_add(k, -n);
        let r = d.mul_add(R::splat(LN_2), q.low_ln_2.mul_add(k, q.value * ln_z));
        Reduced { n, r, remains: self.remains & R::splat(R::EXPONENTS.0).le(n) }
    }
}

/// A power two steps on its way.
#[derive(Clone, Copy)]
pub struct Reduced<R: Real> {
    n: R,
    r: R,
    remains: R::Mask,
}

impl<R: Real> Reduced<R> {
    /// The third: 2^n e^r, or 0 for a base so small that the power is.
    #[inline(always)]
    pub fn finish(&self) -> R {
        let Reduced { n, r, remains } = *self;
        let exponential = (r * r).mul_add(polynomial(R::EXP, r), r) + R::splat(1.0);
        let power = R::select(remains, exponential.times_power_of_two(n), R::splat(0.0));
        if R::HEADROOM {
            return power; // no compaction is so large
        }
        // 2^n alone does not fit.
        R::select(R::splat(R::EXPONENTS.1 + 19.0).lt(n), R::splat(f64::INFINITY), power)
    }
}

/// i^q for i ≥ 0 and q > 0.
#[inline(always)]
pub fn power<R: Real>(i: R, q: &Exponent<R>) -> R {
    Power::new(i).reduce(q).finish()
}
