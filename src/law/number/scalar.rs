//! f32 and f64 as number types, without a fused multiply-add: every processor gives the same results.

use super::real::{Lanes, Real};
use super::series::{
    EXP_BY_PARITY_F32, EXP_BY_PARITY_F64, EXP_F32, EXP_F64, HALF_ARTANH_F32, HALF_ARTANH_F64, LN_F32, LN_F64,
};

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

/// The square root by the processor's instruction. That of libm is written for SSE2 and, called among AVX instructions,
/// waits for the upper halves of the registers.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn root(x: f64) -> f64 {
    use core::arch::x86_64::{_mm_cvtsd_f64, _mm_set_sd, _mm_setzero_pd, _mm_sqrt_sd};
    // SAFETY: every x86-64 has SSE2.
    unsafe { _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(x))) }
}

#[cfg(not(target_arch = "x86_64"))]
use libm::sqrt as root;

macro_rules! scalar {
    ($t:ident, $bits:ident, $sqrt:path, $fabs:path, squares: $squares:expr, wide_range: $wide_range:expr, difference: $difference:expr, series: $artanh:expr, $ln:expr, $exp:expr, $parity:expr) => {
        impl Real for $t {
            type Mask = bool;
            const MIN_POSITIVE: f64 = $t::MIN_POSITIVE as f64;
            const EXPONENTS: (f64, f64) = ($t::MIN_EXP as f64 + 20.0, $t::MAX_EXP as f64 - 20.0);
            const EPSILON: f64 = $t::EPSILON as f64;
            const SQUARES: (f64, f64) = $squares;
            const WIDE_RANGE: bool = $wide_range;
            const HALF_ARTANH: &'static [f64] = &$artanh;
            const LN: &'static [f64] = &$ln;
            const EXP: &'static [f64] = &$exp;
            const EXP_BY_PARITY: [&'static [f64]; 2] = [&$parity.0, &$parity.1];

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
            fn any(mask: bool) -> bool {
                mask
            }
            #[inline(always)]
            fn split_exponent(self) -> (Self, Self) {
                // Shifted, the exponent field changes at ¾ instead of at a power of two.
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
                // Adding 1.5 · 2^(digits − 1) leaves no bits for a fraction.
                let shift = 1.5 * ((1 as $bits) << ($t::MANTISSA_DIGITS - 1)) as $t;
                (self + shift) - shift
            }
            #[inline(always)]
            fn times_power_of_two(self, k: Self) -> Self {
                let exponent = (k as i32 + ($t::MAX_EXP - 1)) as $bits;
                self * $t::from_bits(exponent << ($t::MANTISSA_DIGITS - 1))
            }
        }

        impl Lanes<$t> for $t {
            const COUNT: usize = 1;
            #[inline(always)]
            unsafe fn load(from: *const $t) -> Self {
                // SAFETY: `from` points to COUNT = 1 values.
                unsafe { *from }
            }
            #[inline(always)]
            unsafe fn store(self, to: *mut $t) {
                // SAFETY: `to` has space for COUNT = 1 values.
                unsafe { *to = self }
            }
            #[inline(always)]
            unsafe fn store_integers(self, to: *mut i32) {
                // SAFETY: `to` has space for COUNT = 1 values.
                unsafe { *to = self as i32 }
            }
            #[inline(always)]
            fn prefetch(_: *const $t) {}
        }
    };
}

scalar!(
    f64, u64, root, f64::abs, squares: (1e-90, 1e90), wide_range: true,
    difference: |a, b, c, d| {
        let ((p, p_error), (q, q_error)) = (two_product(a, b), two_product(c, d));
        (p - q) + (p_error - q_error)
    },
    series: HALF_ARTANH_F64, LN_F64, EXP_F64, EXP_BY_PARITY_F64
);
scalar!(
    f32, u32, libm::sqrtf, f32::abs, squares: (1e-10, 1e15), wide_range: false,
    difference: |a, b, c, d| (f64::from(a) * f64::from(b) - f64::from(c) * f64::from(d)) as f32,
    series: HALF_ARTANH_F32, LN_F32, EXP_F32, EXP_BY_PARITY_F32
);
