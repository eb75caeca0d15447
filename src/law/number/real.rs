//! The number that the laws are written in: one precision, one lane or many.
//!
//! Every formula of the law is generic over [`Real`], so that a scalar call and a block of points run the same
//! mathematics, operation by operation. Decisions are masks and selects, never branches on a point's value.

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
    /// Coefficients of the series of artanh, the logarithm and the exponential.
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

/// The number of a caller's arrays: f32 or f64. The block kernel relies on what these are (bytes all 0 are the number 0), so that
/// there are no others.
pub trait Scalar: Real<Mask = bool> + Into<f64> + PartialEq + sealed::Sealed {}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

impl Scalar for f32 {}
impl Scalar for f64 {}

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

/// Points side by side in lanes that are loaded from and stored to arrays of T.
pub trait Lanes<T>: Real {
    /// How many points.
    const COUNT: usize;
    /// # Safety
    /// `from` points to `COUNT` values.
    unsafe fn load(from: *const T) -> Self;
    /// # Safety
    /// `to` has room for `COUNT` values.
    unsafe fn store(self, to: *mut T);
    /// Stores the points for which a mask holds.
    ///
    /// # Safety
    /// `to` points to `COUNT` values.
    #[inline(always)]
    unsafe fn store_where(self, mask: Self::Mask, to: *mut T) {
        // SAFETY: the caller's promise.
        unsafe { Self::select(mask, self, Self::load(to)).store(to) }
    }
    /// Stores small integers.
    ///
    /// # Safety
    /// `to` has room for `COUNT` values.
    unsafe fn store_integers(self, to: *mut i32);
    /// Has the processor fetch what is at an address, if there is anything.
    fn prefetch(place: *const T);
    /// Whether a mask holds for any of the points.
    fn any(mask: Self::Mask) -> bool;
}
