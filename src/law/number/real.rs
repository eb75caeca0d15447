//! The number type that the laws are written in: single or double precision, one lane or several.
//!
//! Every formula of the law is generic over [`Real`], so that a scalar call and a block of points run the same
//! mathematics, operation by operation. Decisions are masks and selects, never branches on a point's value.

use core::mem::MaybeUninit;
use core::ops::{Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign};

use super::elementary;

/// The operators that assign, of a number type that has the others: `assigning! { [R: Real] Dual<R> }`.
macro_rules! assigning {
    ([$($parameters:tt)*] $number:ty) => {
        impl<$($parameters)*> core::ops::AddAssign for $number {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }
        impl<$($parameters)*> core::ops::SubAssign for $number {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
        impl<$($parameters)*> core::ops::MulAssign for $number {
            #[inline(always)]
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }
        impl<$($parameters)*> core::ops::DivAssign for $number {
            #[inline(always)]
            fn div_assign(&mut self, other: Self) {
                *self = *self / other;
            }
        }
    };
}
pub(super) use assigning;

/// A real number, or several of them side by side; what a law's formulas are written over. Documented is what formulas
/// need; the rest is what the library's own are made of.
///
/// `mul_add` may be fused where the processor does so; every other operation is the correctly rounded one of IEEE 754.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// The result of a comparison, for each lane.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask> + Not<Output = Self::Mask>;

    /// Smallest positive normal number.
    const MIN_POSITIVE: f64;
    /// The distance from 1 to the next number.
    const EPSILON: f64;
    #[doc(hidden)]
    /// The least and the greatest exponent of two, with a margin of 20 to the ends of the range.
    const EXPONENTS: (f64, f64);
    #[doc(hidden)]
    /// The least and the greatest square of a stretch or of an area ratio for which the law is evaluated: no
    /// intermediate result overflows or underflows.
    const SQUARES: (f64, f64);
    #[doc(hidden)]
    /// Whether the range is so wide that no stress except that of the longitudinal shear can overflow.
    const WIDE_RANGE: bool;
    #[doc(hidden)]
    /// Whether there is room for a second number, see [`pair`](Self::pair).
    const PAIRS: bool = false;
    #[doc(hidden)]
    /// Coefficients of the polynomials for ½ artanh, the logarithm and the exponential.
    const HALF_ARTANH: &'static [f64];
    #[doc(hidden)]
    const LN: &'static [f64];
    #[doc(hidden)]
    const EXP: &'static [f64];
    #[doc(hidden)]
    /// Those of the exponential, of even and of odd powers.
    const EXP_BY_PARITY: [&'static [f64]; 2];

    /// A mask that holds nowhere.
    #[inline(always)]
    fn never() -> Self::Mask {
        let zero = Self::splat(0.0);
        zero.lt(zero)
    }
    /// The same value in every lane, rounded to this precision.
    fn splat(x: f64) -> Self;
    /// `self · a + b`.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// `a b − c d` to within 1.5 ulp, however much of it cancels.
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self;
    /// The square root, correctly rounded; NaN of negative numbers.
    fn sqrt(self) -> Self;
    /// The absolute value.
    fn abs(self) -> Self;
    /// The larger one; `other` where `self` is NaN.
    fn max(self, other: Self) -> Self;
    /// The smaller one; `other` where `self` is NaN.
    fn min(self, other: Self) -> Self;
    /// Where `self` is less than `other`; nowhere with a NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// Where `self` is less than `other` or equal to it; nowhere with a NaN.
    fn le(self, other: Self) -> Self::Mask;
    /// `a` where the mask holds, `b` elsewhere; the value that is not selected has no influence, even if it is NaN.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;
    #[doc(hidden)]
    /// Whether a mask holds for any of the points.
    fn any(mask: Self::Mask) -> bool;
    #[doc(hidden)]
    /// `(z, k)` with `self = z · 2^k`, z in [¾, 1½), for positive normal numbers; unspecified for others.
    fn split_exponent(self) -> (Self, Self);
    #[doc(hidden)]
    /// The nearest integer, for |self| up to 2^20.
    fn round(self) -> Self;
    #[doc(hidden)]
    /// `self · 2^k` for an integer k and self in [½, 2], both within the range of normal numbers.
    fn times_power_of_two(self, k: Self) -> Self;
    /// `1/self` to within 1 ulp, for normal numbers that are neither very small nor very large; unspecified for others.
    #[inline(always)]
    fn reciprocal(self) -> Self {
        Self::splat(1.0) / self
    }
    /// The same value, as a number that does not change: without its derivative in a number that has one.
    #[inline(always)]
    fn without_slope(self) -> Self {
        self
    }
    #[doc(hidden)]
    /// Two numbers in one, to compute with at the cost of one; `self` in a type without room for a second (`PAIRS` is
    /// false).
    #[inline(always)]
    fn pair(self, _other: Self) -> Self {
        self
    }
    #[doc(hidden)]
    /// The two numbers of a [`pair`](Self::pair).
    #[inline(always)]
    fn apart(self) -> [Self; 2] {
        [self; 2]
    }
    #[doc(hidden)]
    /// `self/divisor`, correctly rounded, given the divisor's correctly rounded reciprocal; none of them very small or
    /// large.
    #[inline(always)]
    fn quotient(self, divisor: Self, _reciprocal: Self) -> Self {
        self / divisor
    }
    /// ln x to within 3 ulp; −∞ at 0, NaN below. A subnormal number counts as 0.
    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }
    /// ln x of a positive normal number; unspecified for others.
    #[doc(hidden)]
    #[inline(always)]
    fn ln_of_normal(self) -> Self {
        elementary::ln_of_normal(self)
    }
    /// eˣ to within 1.5 ulp; 0 where it is below the normal numbers, ∞ above them.
    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    /// x^q to within 1.5 + 2 |q| ulp, for |q| up to 1000; 0 where it is nearly as small as the least normal number
    /// (below 2^−1001, in single precision 2^−105), ∞ above them. NaN for x < 0 and for infinite x; a subnormal x
    /// counts as 0.
    #[inline(always)]
    fn powf(self, exponent: Self) -> Self {
        elementary::powf(self, exponent)
    }
}

/// The number type of a caller's arrays: f32 or f64. Sealed, since the block kernel relies on their representation: all
/// bytes 0 is the number 0.
pub trait Scalar: Real<Mask = bool> + Into<f64> + PartialEq + sealed::Sealed {}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

impl Scalar for f32 {}
impl Scalar for f64 {}

/// A number type that holds one point, whose own numbers are of type T.
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

/// The number of lanes of the widest register.
pub(crate) const WIDEST: usize = 16;

/// A number type with one point in each lane, loaded from and stored to arrays of T.
pub trait Lanes<T>: Real {
    /// The number of lanes.
    const COUNT: usize;
    /// Whether it holds a single point that is evaluated alone, as a type with room for a second number does.
    const ALONE: bool = Self::PAIRS;
    /// Loads the lanes from consecutive values.
    ///
    /// # Safety
    /// `from` points to `COUNT` values.
    unsafe fn load(from: *const T) -> Self;
    /// Stores the lanes to consecutive values.
    ///
    /// # Safety
    /// `to` has room for `COUNT` values.
    unsafe fn store(self, to: *mut T);
    /// Loads the first lanes from consecutive values; the others are those of `fill`.
    ///
    /// # Safety
    /// `from` points to `count` values, fewer than `COUNT`.
    #[inline(always)]
    unsafe fn load_first(from: *const T, count: usize, fill: Self) -> Self {
        let mut values = [const { MaybeUninit::<T>::uninit() }; WIDEST];
        let values = values.as_mut_ptr().cast();
        // SAFETY: no register has more than WIDEST lanes, and `count`, no more, are copied.
        unsafe {
            fill.store(values);
            values.copy_from_nonoverlapping(from, count);
            Self::load(values)
        }
    }
    /// Stores the lanes for which a mask holds.
    ///
    /// # Safety
    /// `to` points to `COUNT` values.
    #[inline(always)]
    unsafe fn store_where(self, mask: Self::Mask, to: *mut T) {
        // SAFETY: `to` has COUNT values.
        unsafe { Self::select(mask, self, Self::load(to)).store(to) }
    }
    /// Stores the lanes, which are small integers, to consecutive values.
    ///
    /// # Safety
    /// `to` has room for `COUNT` values.
    unsafe fn store_integers(self, to: *mut i32);
    /// Prefetches the cache line of an address, which need not be valid.
    fn prefetch(place: *const T);
}
