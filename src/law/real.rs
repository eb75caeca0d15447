//! The number that the law is written in: one precision, one lane or many.
//!
//! Every formula of the law is generic over [`Real`], so that a scalar call and a block of points run the same
//! mathematics, operation by operation. Decisions are masks and selects, never branches on a point's value.

use super::elementary::{EXP_F32, EXP_F64, HALF_ARTANH_F32, HALF_ARTANH_F64, LN_F32, LN_F64};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A real number, or several of them side by side.
///
/// `mul_add` may be fused where the processor does so; every other operation is the correctly rounded one of IEEE 754.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The answer to a comparison, lane by lane.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;

    /// Smallest positive normal number.
    const MIN_POSITIVE: f64;
    /// The distance from 1 to the next number.
    const EPSILON: f64;
    /// Exponents of two that leave room for a factor of some thousands on either side of the range.
    const EXPONENTS: (f64, f64);
    /// Squares of stretches and of area ratios within which the law is evaluated: no intermediate result leaves the range.
    const SQUARES: (f64, f64);
    /// Whether this range is so wide that no stress, but for the longitudinal shear's, can leave it.
    const HEADROOM: bool;
    /// Whether what costs is the chain of operations, each of which waits for the one before, and not their number. Such a number
    /// has room for a second one, see [`pair`](Self::pair).
    const WAITS: bool = false;
    /// Coefficients of artanh, the logarithm and the exponential, see [`elementary`](super::elementary).
    const HALF_ARTANH: &'static [f64];
    const LN: &'static [f64];
    const EXP: &'static [f64];

    /// The same value in every lane, rounded to this precision.
    fn splat(x: f64) -> Self;
    /// `self · a + b`.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// `a b − c d` to within 1.5 ulp, however much of it cancels.
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// The larger one; `other` where `self` is NaN.
    fn max(self, other: Self) -> Self;
    /// The smaller one; `other` where `self` is NaN.
    fn min(self, other: Self) -> Self;
    fn lt(self, other: Self) -> Self::Mask;
    fn le(self, other: Self) -> Self::Mask;
    /// `a` where the mask holds, `b` elsewhere; what stands in the other one, NaN included, has no influence.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;
    /// `(z, k)` with `self = z · 2^k`, z in [¾, 1½). For positive normal numbers; anything else gives some number.
    fn split_exponent(self) -> (Self, Self);
    /// The nearest integer, for |self| up to 2^20.
    fn round(self) -> Self;
    /// `self · 2^k` for an integer k and self in [½, 2], both within the range of normal numbers.
    fn times_power_of_two(self, k: Self) -> Self;
    /// `1/self` to within 1 ulp, for normal numbers that are neither very small nor very large; some value or NaN for others.
    #[inline(always)]
    fn reciprocal(self) -> Self {
        Self::splat(1.0) / self
    }
    /// Two numbers side by side, to compute with at the cost of one; the first where there is no room for a second.
    #[inline(always)]
    fn pair(self, _other: Self) -> Self {
        self
    }
    /// The numbers of a pair.
    #[inline(always)]
    fn apart(self) -> [Self; 2] {
        [self; 2]
    }
    /// `self/divisor`, correctly rounded, given the divisor's correctly rounded reciprocal; none of them very small or large.
    #[inline(always)]
    fn quotient(self, divisor: Self, _reciprocal: Self) -> Self {
        self / divisor
    }
}

/// A number that stands for one point, whose own numbers are T.
pub trait Single<T>: Real {
    fn of(x: T) -> Self;
    fn value(self) -> T;
    /// Whether a mask holds for the point.
    fn holds(mask: Self::Mask) -> bool;
}

impl<T: Real<Mask = bool>> Single<T> for T {
    #[inline(always)]
    fn of(x: T) -> Self {
        x
    }
    #[inline(always)]
    fn value(self) -> T {
        self
    }
    #[inline(always)]
    fn holds(mask: bool) -> bool {
        mask
    }
}

/// Scalar product of two vectors.
#[inline(always)]
pub fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// Vector product of two vectors.
#[inline(always)]
pub fn cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[1].mul_add(b[2], -(a[2] * b[1])), a[2].mul_add(b[0], -(a[0] * b[2])), a[0].mul_add(b[1], -(a[1] * b[0]))]
}

/// Vector product of two vectors, each component to within 1.5 ulp.
#[inline(always)]
pub fn accurate_cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [
        R::difference_of_products(a[1], b[2], a[2], b[1]),
        R::difference_of_products(a[2], b[0], a[0], b[2]),
        R::difference_of_products(a[0], b[1], a[1], b[0]),
    ]
}

/// `a + s b`.
#[inline(always)]
pub fn along<R: Real>(a: [R; 3], s: R, b: [R; 3]) -> [R; 3] {
    [s.mul_add(b[0], a[0]), s.mul_add(b[1], a[1]), s.mul_add(b[2], a[2])]
}

/// `s a`.
#[inline(always)]
pub fn scale<R: Real>(s: R, a: [R; 3]) -> [R; 3] {
    [s * a[0], s * a[1], s * a[2]]
}

/// The image of a vector under the matrix of these columns.
#[inline(always)]
pub fn image<R: Real>(columns: &[[R; 3]; 3], v: [R; 3]) -> [R; 3] {
    along(along(scale(v[2], columns[2]), v[1], columns[1]), v[0], columns[0])
}

/// A product and its rounding error, without a fused multiply-add (Dekker, Numer. Math. 18, 1971).
#[inline(always)]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    // Halves of 26 bits, whose products are exact.
    let split = |x: f64| {
        let high = f64::from_bits(x.to_bits() & !0x7ff_ffff);
        (high, x - high)
    };
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let product = a * b;
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

#[cfg(target_arch = "x86_64")]
use super::block::root;
#[cfg(not(target_arch = "x86_64"))]
use libm::sqrt as root;

macro_rules! scalar {
    ($t:ident, $bits:ident, $sqrt:path, $fabs:path, squares: $squares:expr, headroom: $headroom:expr, difference: $difference:expr, series: $artanh:expr, $ln:expr, $exp:expr) => {
        impl Real for $t {
            type Mask = bool;
            const MIN_POSITIVE: f64 = $t::MIN_POSITIVE as f64;
            const EXPONENTS: (f64, f64) = ($t::MIN_EXP as f64 + 20.0, $t::MAX_EXP as f64 - 20.0);
            const EPSILON: f64 = $t::EPSILON as f64;
            const SQUARES: (f64, f64) = $squares;
            const HEADROOM: bool = $headroom;
            const HALF_ARTANH: &'static [f64] = &$artanh;
            const LN: &'static [f64] = &$ln;
            const EXP: &'static [f64] = &$exp;

            #[inline(always)]
            fn splat(x: f64) -> Self {
                x as $t
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                self * a + b
            }
            #[inline(always)]
            fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
                let difference: fn(Self, Self, Self, Self) -> Self = $difference;
                difference(a, b, c, d)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $fabs(self)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn le(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn select(mask: bool, a: Self, b: Self) -> Self {
                if mask { a } else { b }
            }
            #[inline(always)]
            fn split_exponent(self) -> (Self, Self) {
                // Shifting the exponent field so that it steps at ¾ instead of at a power of two.
                const MANTISSA: u32 = $t::MANTISSA_DIGITS - 1;
                const ONE: $bits = (1.0 as $t).to_bits();
                const LEAST: $bits = (0.75 as $t).to_bits();
                let shifted = self.to_bits().wrapping_add(ONE - LEAST);
                let z = $t::from_bits((shifted & ((1 << MANTISSA) - 1)) + LEAST);
                let k = (shifted >> MANTISSA) as i32 - ($t::MAX_EXP - 1);
                (z, k as $t)
            }
            #[inline(always)]
            fn round(self) -> Self {
                // Adding 1.5 · 2^(digits − 1) leaves no room for a fraction.
                let shift = 1.5 * ((1 as $bits) << ($t::MANTISSA_DIGITS - 1)) as $t;
                (self + shift) - shift
            }
            #[inline(always)]
            fn times_power_of_two(self, k: Self) -> Self {
                let exponent = (k as i32 + ($t::MAX_EXP - 1)) as $bits;
                self * $t::from_bits(exponent << ($t::MANTISSA_DIGITS - 1))
            }
        }
    };
}

scalar!(
    f64, u64, root, f64::abs, squares: (1e-100, 1e100), headroom: true,
    difference: |a, b, c, d| {
        let ((p, p_error), (q, q_error)) = (two_product(a, b), two_product(c, d));
        (p - q) + (p_error - q_error)
    },
    series: HALF_ARTANH_F64, LN_F64, EXP_F64
);
scalar!(
    f32, u32, libm::sqrtf, f32::abs, squares: (1e-10, 1e15), headroom: false,
    difference: |a, b, c, d| (f64::from(a) * f64::from(b) - f64::from(c) * f64::from(d)) as f32,
    series: HALF_ARTANH_F32, LN_F32, EXP_F32
);
