//! Two registers as one number type: the operations of one need not wait for those of the other.

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::real::{Lanes, Real, assigning};

/// Two registers side by side.
#[derive(Clone, Copy)]
pub struct Twice<X>(X, X);

macro_rules! operators {
    ($($operator:ident $method:ident)*) => {$(
        impl<X: $operator<Output = X>> $operator for Twice<X> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Twice(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}

operators! { Add add Sub sub Mul mul Div div BitAnd bitand BitOr bitor }

assigning! { [R: Real] Twice<R> }

impl<X: Neg<Output = X>> Neg for Twice<X> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Twice(-self.0, -self.1)
    }
}

impl<X: Not<Output = X>> Not for Twice<X> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Twice(!self.0, !self.1)
    }
}

/// Methods of `Real` that take and return numbers.
macro_rules! forwarded {
    ($($method:ident($($argument:ident),*);)*) => {$(
        #[inline(always)]
        fn $method(self $(, $argument: Self)*) -> Self {
            Twice(self.0.$method($($argument.0),*), self.1.$method($($argument.1),*))
        }
    )*};
}

impl<R: Real> Real for Twice<R> {
    type Mask = Twice<R::Mask>;
    const MIN_POSITIVE: f64 = R::MIN_POSITIVE;
    const EXPONENTS: (f64, f64) = R::EXPONENTS;
    const EPSILON: f64 = R::EPSILON;
    const SQUARES: (f64, f64) = R::SQUARES;
    const WIDE_RANGE: bool = R::WIDE_RANGE;
    const HALF_ARTANH: &'static [f64] = R::HALF_ARTANH;
    const LN: &'static [f64] = R::LN;
    const EXP: &'static [f64] = R::EXP;
    const EXP_BY_PARITY: [&'static [f64]; 2] = R::EXP_BY_PARITY;

    forwarded! {
        mul_add(a, b);
        sqrt();
        abs();
        max(other);
        min(other);
        round();
        times_power_of_two(k);
        reciprocal();
        without_slope();
        quotient(divisor, reciprocal);
    }

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Twice(R::splat(x), R::splat(x))
    }
    #[inline(always)]
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        Twice(R::difference_of_products(a.0, b.0, c.0, d.0), R::difference_of_products(a.1, b.1, c.1, d.1))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        Twice(self.0.lt(other.0), self.1.lt(other.1))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::Mask {
        Twice(self.0.le(other.0), self.1.le(other.1))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        Twice(R::select(mask.0, a.0, b.0), R::select(mask.1, a.1, b.1))
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        R::any(mask.0 | mask.1)
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let ((z, k), (other_z, other_k)) = (self.0.split_exponent(), self.1.split_exponent());
        (Twice(z, other_z), Twice(k, other_k))
    }
}

impl<T, R: Lanes<T>> Lanes<T> for Twice<R> {
    const COUNT: usize = 2 * R::COUNT;
    #[inline(always)]
    unsafe fn load(from: *const T) -> Self {
        // SAFETY: COUNT values are two halves of R::COUNT.
        unsafe { Twice(R::load(from), R::load(from.add(R::COUNT))) }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut T) {
        // SAFETY: as for `load`.
        unsafe {
            self.0.store(to);
            self.1.store(to.add(R::COUNT));
        }
    }
    #[inline(always)]
    unsafe fn store_integers(self, to: *mut i32) {
        // SAFETY: as for `load`.
        unsafe {
            self.0.store_integers(to);
            self.1.store_integers(to.add(R::COUNT));
        }
    }
    #[inline(always)]
    fn prefetch(place: *const T) {
        R::prefetch(place);
    }
}
