//! A number with its derivative, which the law's generic code takes as any other.

use std::ops::{Add, Div, Mul, Neg, Sub};

use toron::Real;

/// x + x′ ε with ε² = 0.
#[derive(Clone, Copy, Debug)]
pub struct Dual {
    pub value: f64,
    pub slope: f64,
}

impl Dual {
    pub fn new(value: f64, slope: f64) -> Self {
        Dual { value, slope }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Dual::new(self.value + b.value, self.slope + b.slope)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Dual::new(self.value - b.value, self.slope - b.slope)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Dual::new(self.value * b.value, self.slope * b.value + self.value * b.slope)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        Dual::new(value, (self.slope - value * b.slope) / b.value)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Dual::new(-self.value, -self.slope)
    }
}

impl From<Dual> for f64 {
    fn from(x: Dual) -> f64 {
        x.value
    }
}

impl Real for Dual {
    type Mask = bool;
    const MIN_POSITIVE: f64 = f64::MIN_POSITIVE;
    const EXPONENTS: (f64, f64) = <f64 as Real>::EXPONENTS;
    const EPSILON: f64 = <f64 as Real>::EPSILON;
    const SQUARES: (f64, f64) = <f64 as Real>::SQUARES;
    const HEADROOM: bool = <f64 as Real>::HEADROOM;
    const HALF_ARTANH: &'static [f64] = <f64 as Real>::HALF_ARTANH;
    const LN: &'static [f64] = <f64 as Real>::LN;
    const EXP: &'static [f64] = <f64 as Real>::EXP;

    fn splat(x: f64) -> Self {
        Dual::new(x, 0.0)
    }
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        let value = f64::difference_of_products(a.value, b.value, c.value, d.value);
        Dual::new(value, (a.slope * b.value + a.value * b.slope) - (c.slope * d.value + c.value * d.slope))
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        // s = √(d1² + d2²) at 0: everything that is made of s is even in it.
        Dual::new(root, if root == 0.0 { 0.0 } else { 0.5 * self.slope / root })
    }
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    fn max(self, other: Self) -> Self {
        if self.value > other.value { self } else { other }
    }
    fn min(self, other: Self) -> Self {
        if self.value < other.value { self } else { other }
    }
    fn lt(self, other: Self) -> bool {
        self.value < other.value
    }
    fn le(self, other: Self) -> bool {
        self.value <= other.value
    }
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    fn split_exponent(self) -> (Self, Self) {
        let (z, k) = self.value.split_exponent();
        (Dual::new(z, self.slope * Real::times_power_of_two(1.0, -k)), Dual::splat(k))
    }
    fn round(self) -> Self {
        Dual::splat(Real::round(self.value))
    }
    fn times_power_of_two(self, k: Self) -> Self {
        let scaling = Real::times_power_of_two(1.0, k.value);
        Dual::new(self.value.times_power_of_two(k.value), self.slope * scaling)
    }
}
