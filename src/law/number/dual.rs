//! A number with its derivative, for the tangents of laws that have none of their own: forward differentiation, in any
//! number type of the library.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary;
use super::real::{Real, assigning};

/// x + x′ ε with ε² = 0.
///
/// The elementary functions differentiate by their rules and not through their polynomials, whose derivatives have
/// fewer correct digits. A comparison compares the values; at a kink the derivative is that of the branch which the
/// value takes.
#[derive(Clone, Copy, Debug)]
pub struct Dual<R> {
    /// x.
    pub value: R,
    /// x′, the derivative.
    pub slope: R,
}

impl<R: Real> Dual<R> {
    /// A value with its derivative.
    #[inline(always)]
    pub fn new(value: R, slope: R) -> Self {
        Dual { value, slope }
    }

    /// f(x), given the value of f and of its derivative.
    #[inline(always)]
    fn by(self, value: R, derivative: R) -> Self {
        Dual::new(value, derivative * self.slope)
    }
}

impl<R: Real> Add for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Dual::new(self.value + b.value, self.slope + b.slope)
    }
}

impl<R: Real> Sub for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Dual::new(self.value - b.value, self.slope - b.slope)
    }
}

impl<R: Real> Mul for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Dual::new(self.value * b.value, self.slope.mul_add(b.value, self.value * b.slope))
    }
}

impl<R: Real> Div for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        Dual::new(value, (self.slope - value * b.slope) / b.value)
    }
}

assigning! { [R: Real] Dual<R> }

impl<R: Real> Neg for Dual<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Dual::new(-self.value, -self.slope)
    }
}

impl<R: Real + Into<f64>> From<Dual<R>> for f64 {
    fn from(x: Dual<R>) -> f64 {
        x.value.into()
    }
}

impl<R: Real> Real for Dual<R> {
    type Mask = R::Mask;
    const MIN_POSITIVE: f64 = R::MIN_POSITIVE;
    const EXPONENTS: (f64, f64) = R::EXPONENTS;
    const EPSILON: f64 = R::EPSILON;
    const SQUARES: (f64, f64) = R::SQUARES;
    const WIDE_RANGE: bool = R::WIDE_RANGE;
    const HALF_ARTANH: &'static [f64] = R::HALF_ARTANH;
    const LN: &'static [f64] = R::LN;
    const EXP: &'static [f64] = R::EXP;
    const EXP_BY_PARITY: [&'static [f64]; 2] = R::EXP_BY_PARITY;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Dual::new(R::splat(x), R::splat(0.0))
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        let slope = self.slope.mul_add(a.value, self.value.mul_add(a.slope, b.slope));
        Dual::new(self.value.mul_add(a.value, b.value), slope)
    }
    #[inline(always)]
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        let value = R::difference_of_products(a.value, b.value, c.value, d.value);
        let first = a.slope.mul_add(b.value, a.value * b.slope);
        Dual::new(value, first - c.slope.mul_add(d.value, c.value * d.slope))
    }
    /// The slope at 0 is 0: that of what is even in the root, as a function of a length is.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let (zero, root) = (R::splat(0.0), self.value.sqrt());
        let at_zero = root.le(zero);
        let twice = R::select(at_zero, R::splat(1.0), root + root);
        // At 0 the slope is infinite, but that of a number which does not change, or whose square root is |x|, is 0.
        let constant = self.slope.abs().le(zero);
        let steep = R::select(constant, zero, self.slope * R::splat(f64::INFINITY));
        Dual::new(root, R::select(at_zero, steep, self.slope / twice))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::select(self.value.lt(R::splat(0.0)), -self, self)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Dual::new(self.value.max(other.value), R::select(other.value.lt(self.value), self.slope, other.slope))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Dual::new(self.value.min(other.value), R::select(self.value.lt(other.value), self.slope, other.slope))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> R::Mask {
        self.value.lt(other.value)
    }
    #[inline(always)]
    fn le(self, other: Self) -> R::Mask {
        self.value.le(other.value)
    }
    #[inline(always)]
    fn select(mask: R::Mask, a: Self, b: Self) -> Self {
        Dual::new(R::select(mask, a.value, b.value), R::select(mask, a.slope, b.slope))
    }
    #[inline(always)]
    fn any(mask: R::Mask) -> bool {
        R::any(mask)
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let (z, k) = self.value.split_exponent();
        let scale = R::splat(1.0).times_power_of_two(-k);
        (self.by(z, scale), Dual::new(k, R::splat(0.0)))
    }
    #[inline(always)]
    fn round(self) -> Self {
        Dual::new(self.value.round(), R::splat(0.0))
    }
    #[inline(always)]
    fn times_power_of_two(self, k: Self) -> Self {
        self.by(self.value.times_power_of_two(k.value), R::splat(1.0).times_power_of_two(k.value))
    }
    #[inline(always)]
    fn without_slope(self) -> Self {
        Dual::new(self.value, R::splat(0.0))
    }
    #[inline(always)]
    fn reciprocal(self) -> Self {
        let inverse = self.value.reciprocal();
        self.by(inverse, -(inverse * inverse))
    }
    #[inline(always)]
    fn quotient(self, divisor: Self, reciprocal: Self) -> Self {
        let value = self.value.quotient(divisor.value, reciprocal.value);
        Dual::new(value, (self.slope - value * divisor.slope) * reciprocal.value)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        Dual::new(elementary::ln(self.value), self.slope / self.value)
    }
    #[inline(always)]
    fn ln_of_normal(self) -> Self {
        Dual::new(elementary::ln_of_normal(self.value), self.slope / self.value)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let value = elementary::exp(self.value);
        self.by(value, value)
    }
    #[inline(always)]
    fn powf(self, exponent: Self) -> Self {
        let (zero, one, x, q) = (R::splat(0.0), R::splat(1.0), self.value, exponent.value);
        let value = elementary::powf(x, q);
        // At 0 it is 1 for q = 1, 0 for q > 1 and for q = 0, and between these as for the root.
        let steep = zero.lt(q) & q.lt(one) & !self.slope.abs().le(zero);
        let below_one = R::select(steep, R::splat(f64::INFINITY), zero);
        let at_zero = R::select(one.le(q) & q.le(one), one, below_one);
        let derivative = R::select(zero.lt(x), q * value / x, at_zero);
        let constant = exponent.slope.le(zero) & zero.le(exponent.slope);
        let by_exponent = R::select(constant, zero, value * elementary::ln(x) * exponent.slope);
        Dual::new(value, derivative.mul_add(self.slope, by_exponent))
    }
}
