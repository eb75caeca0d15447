//! The lanes of x86-64: SSE2, which every such processor has, AVX2 with FMA, and AVX-512.
//!
//! Each type is a register of numbers and every operation one or a few instructions, as [`Real`] documents. They may
//! only run after the dispatch of a block or a call, or a test, has checked that the processor has the instructions.
// The intrinsics of SSE2 are safe functions on x86-64, so that the `unsafe` of the macros is unused for them.
#![allow(unused_unsafe)]

pub(crate) mod products;

use core::arch::x86_64::*;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::real::{Lanes, Real, Single, assigning};
use super::series::{EXP_F32, EXP_F64, HALF_ARTANH_F32, HALF_ARTANH_F64, LN_F32, LN_F64};
use products::{
    corrected_quotient, fused_difference, newton_reciprocal, reciprocal_series, split_difference, widened_difference,
};

/// A register type with its arithmetic. `$f` is the register of numbers, `$i` the one of their bits.
macro_rules! register {
    (
        $(#[$doc:meta])*
        $name:ident: $t:ident as $bits:ident x $count:literal in $f:ident / $i:ident;
        mask $mask:ident;
        arithmetic $set1:ident $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $max:ident $min:ident;
        bits $to:ident $from:ident $iset1:ident $iadd:ident $iand:ident $ior:ident $srl:ident $sll:ident;
        memory $load:ident $store:ident;
        integers ($x:ident, $to_int:ident) $store_integers:expr;
        compare ($l:ident, $r:ident) $lt:expr, $le:expr;
        any ($any_mask:ident) $any:expr;
        select ($m:ident, $yes:ident, $no:ident) $select:expr;
        mul_add ($fa:ident, $fb:ident, $fc:ident) $mul_add:expr;
        difference ($da:ident, $db:ident, $dc:ident, $dd:ident) $difference:expr;
        split ($sx:ident) $split:expr;
        scale ($px:ident, $pk:ident) $scale:expr;
        reciprocal ($rx:ident) $reciprocal:expr;
        quotient ($qx:ident, $qd:ident, $qr:ident) $quotient:expr;
        series $artanh:ident $ln:ident $exp:ident
        $(; store_where ($wm:ident, $wx:ident, $wto:ident) $store_where:expr)?
        $(; load_first ($ffrom:ident, $fcount:ident, $fill:ident) $load_first:expr)?
        $(; pair ($pa:ident, $pb:ident) $pair:expr, apart ($pxy:ident) [$pfirst:expr, $psecond:expr])?
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub struct $name($f);

        // SAFETY (all of the impls below): these types are used only after the processor's instructions have been
        // checked.
        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $add(self.0, other.0) })
            }
        }
        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $sub(self.0, other.0) })
            }
        }
        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $mul(self.0, other.0) })
            }
        }
        impl Div for $name {
            type Output = Self;
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $div(self.0, other.0) })
            }
        }
        assigning! { [] $name }
        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // A change of sign, zeros included, as for a scalar.
                const SIGN: $bits = 1 << ($bits::BITS - 1);
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe {
                    let bits = $to(self.0);
                    let sign = $iset1(SIGN as _);
                    // x ^ sign = x + sign, modulo the register's width.
                    $from($iadd(bits, sign))
                })
            }
        }

        impl $name {
            /// self, which is not negative, with the sign of x.
            #[inline(always)]
            #[allow(dead_code)] // only the reciprocal of AVX-512 needs it
            fn with_sign_of(self, x: Self) -> Self {
                const SIGN: $bits = 1 << ($bits::BITS - 1);
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $from($ior($to(self.0), $iand($to(x.0), $iset1(SIGN as _)))) })
            }
        }

        impl Real for $name {
            type Mask = $mask;
            const MIN_POSITIVE: f64 = $t::MIN_POSITIVE as f64;
            const EXPONENTS: (f64, f64) = <$t as Real>::EXPONENTS;
            const EPSILON: f64 = <$t as Real>::EPSILON;
            const SQUARES: (f64, f64) = <$t as Real>::SQUARES;
            const WIDE_RANGE: bool = <$t as Real>::WIDE_RANGE;
            const HALF_ARTANH: &'static [f64] = &$artanh;
            const LN: &'static [f64] = &$ln;
            const EXP: &'static [f64] = &$exp;
            const EXP_BY_PARITY: [&'static [f64]; 2] = <$t as Real>::EXP_BY_PARITY;

            #[inline(always)]
            fn splat(x: f64) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $set1(x as $t) })
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                let ($fa, $fb, $fc) = (self.0, a.0, b.0);
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $mul_add })
            }
            #[inline(always)]
            fn difference_of_products($da: Self, $db: Self, $dc: Self, $dd: Self) -> Self {
                $difference
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn abs(self) -> Self {
                const MAGNITUDE: $bits = $bits::MAX >> 1;
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $from($iand($to(self.0), $iset1(MAGNITUDE as _))) })
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $max(self.0, other.0) })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $min(self.0, other.0) })
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                let ($l, $r) = (self.0, other.0);
                // SAFETY: the dispatch has checked that the processor has the instructions.
                unsafe { $lt }
            }
            #[inline(always)]
            fn le(self, other: Self) -> $mask {
                let ($l, $r) = (self.0, other.0);
                // SAFETY: the dispatch has checked that the processor has the instructions.
                unsafe { $le }
            }
            #[inline(always)]
            fn select($m: $mask, a: Self, b: Self) -> Self {
                let ($yes, $no) = (a.0, b.0);
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $name(unsafe { $select })
            }
            #[inline(always)]
            fn any($any_mask: $mask) -> bool {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                #[allow(unused_unsafe)]
                unsafe { $any }
            }
            #[inline(always)]
            fn split_exponent(self) -> (Self, Self) {
                let $sx = self;
                $split
            }
            #[inline(always)]
            fn round(self) -> Self {
                let shift = Self::splat(1.5 * ((1 as $bits) << ($t::MANTISSA_DIGITS - 1)) as f64);
                (self + shift) - shift
            }
            #[inline(always)]
            fn times_power_of_two(self, $pk: Self) -> Self {
                let $px = self;
                $scale
            }
            #[inline(always)]
            fn reciprocal(self) -> Self {
                let $rx = self;
                $reciprocal
            }
            #[inline(always)]
            fn quotient(self, $qd: Self, $qr: Self) -> Self {
                let $qx = self;
                $quotient
            }
            $(
                const PAIRS: bool = true;
                #[inline(always)]
                fn pair(self, other: Self) -> Self {
                    let ($pa, $pb) = (self.0, other.0);
                    // SAFETY: the dispatch has checked that the processor has the instructions.
                    $name(unsafe { $pair })
                }
                #[inline(always)]
                fn apart(self) -> [Self; 2] {
                    let $pxy = self.0;
                    // SAFETY: the dispatch has checked that the processor has the instructions.
                    unsafe { [$name($pfirst), $name($psecond)] }
                }
            )?
        }

        impl $name {
            /// [`Real::split_exponent`] by integer arithmetic on the bits: shifted, the exponent field changes at ¾
            /// instead of at a power of two.
            #[inline(always)]
            #[allow(dead_code)]
            fn split_bits(self) -> (Self, Self) {
                const MANTISSA: i32 = $t::MANTISSA_DIGITS as i32 - 1;
                const ONE: $bits = (1.0 as $t).to_bits();
                const LEAST: $bits = (0.75 as $t).to_bits();
                // Added to this power of two, an integer below 2^MANTISSA is the mantissa of the sum.
                const INTEGER: $t = ((1 as $bits) << MANTISSA) as $t;
                // SAFETY: the dispatch has checked that the processor has the instructions.
                unsafe {
                    let shifted = $iadd($to(self.0), $iset1((ONE - LEAST) as _));
                    let mantissa = $iand(shifted, $iset1((((1 as $bits) << MANTISSA) - 1) as _));
                    let z = $from($iadd(mantissa, $iset1(LEAST as _)));
                    let exponent = $ior($srl::<{ MANTISSA as _ }>(shifted), $iset1(INTEGER.to_bits() as _));
                    let bias = $set1(INTEGER + ($t::MAX_EXP - 1) as $t);
                    ($name(z), $name($sub($from(exponent), bias)))
                }
            }

            /// [`Real::times_power_of_two`] by making 2^k from its bits.
            #[inline(always)]
            #[allow(dead_code)]
            fn scale_bits(self, k: Self) -> Self {
                const MANTISSA: i32 = $t::MANTISSA_DIGITS as i32 - 1;
                const INTEGER: $t = ((1 as $bits) << MANTISSA) as $t;
                // SAFETY: the dispatch has checked that the processor has the instructions.
                unsafe {
                    let biased = $add(k.0, $set1(INTEGER + ($t::MAX_EXP - 1) as $t));
                    $name($mul(self.0, $from($sll::<{ MANTISSA as _ }>($to(biased)))))
                }
            }
        }

        impl Lanes<$t> for $name {
            const COUNT: usize = $count;
            #[inline(always)]
            unsafe fn load(from: *const $t) -> Self {
                // SAFETY: the dispatch has checked for the instructions; `from` points to COUNT values, which this
                // instruction loads.
                $name(unsafe { $load(from) })
            }
            #[inline(always)]
            unsafe fn store(self, to: *mut $t) {
                // SAFETY: the dispatch has checked for the instructions; `to` has space for COUNT values, which this
                // instruction stores.
                unsafe { $store(to, self.0) }
            }
            $(
                #[inline(always)]
                unsafe fn store_where(self, $wm: $mask, $wto: *mut $t) {
                    let $wx = self.0;
                    // SAFETY: the dispatch has checked for the instructions; `to` points to COUNT values, and no others
                    // are stored.
                    unsafe { $store_where }
                }
            )?
            $(
                #[inline(always)]
                unsafe fn load_first($ffrom: *const $t, $fcount: usize, fill: Self) -> Self {
                    let $fill = fill.0;
                    // SAFETY: the dispatch has checked for the instructions; `from` points to `count` values, and no
                    // others are loaded.
                    $name(unsafe { $load_first })
                }
            )?
            #[inline(always)]
            unsafe fn store_integers(self, $to_int: *mut i32) {
                let $x = self.0;
                // SAFETY: the dispatch has checked for the instructions; `to` has space for COUNT integers, and no more
                // are stored.
                unsafe { $store_integers }
            }
            #[inline(always)]
            fn prefetch(place: *const $t) {
                // SAFETY: a prefetch never faults.
                unsafe { _mm_prefetch::<_MM_HINT_T0>(place.cast()) }
            }
        }
    };
}

/// A mask of full-width lanes, all ones or all zeros.
macro_rules! wide_mask {
    ($mask:ident($f:ident), $and:ident $or:ident $xor:ident, $ones:expr) => {
        #[derive(Clone, Copy)]
        pub struct $mask($f);
        impl BitAnd for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $mask(unsafe { $and(self.0, other.0) })
            }
        }
        impl BitOr for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, other: Self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $mask(unsafe { $or(self.0, other.0) })
            }
        }
        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                // SAFETY: the dispatch has checked that the processor has the instructions.
                $mask(unsafe { $xor(self.0, $ones) })
            }
        }
    };
}

wide_mask!(Mask64x2(__m128d), _mm_and_pd _mm_or_pd _mm_xor_pd, _mm_castsi128_pd(_mm_set1_epi64x(-1)));
wide_mask!(Mask32x4(__m128), _mm_and_ps _mm_or_ps _mm_xor_ps, _mm_castsi128_ps(_mm_set1_epi32(-1)));
wide_mask!(Mask64x4(__m256d), _mm256_and_pd _mm256_or_pd _mm256_xor_pd, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)));
wide_mask!(Mask32x8(__m256), _mm256_and_ps _mm256_or_ps _mm256_xor_ps, _mm256_castsi256_ps(_mm256_set1_epi32(-1)));

/// The exponent of x times this is the k for which x/2^k is in [¾, 1½); the rounding of the product is such that this
/// holds at the limits of the interval too.
const FOUR_THIRDS: f64 = 4.0 / 3.0;

register! {
    /// 2 numbers of double precision, SSE2.
    F64x2: f64 as u64 x 2 in __m128d / __m128i;
    mask Mask64x2;
    arithmetic _mm_set1_pd _mm_add_pd _mm_sub_pd _mm_mul_pd _mm_div_pd _mm_sqrt_pd _mm_max_pd _mm_min_pd;
    bits _mm_castpd_si128 _mm_castsi128_pd _mm_set1_epi64x _mm_add_epi64 _mm_and_si128 _mm_or_si128 _mm_srli_epi64 _mm_slli_epi64;
    memory _mm_loadu_pd _mm_storeu_pd;
    integers (x, to) _mm_storel_epi64(to.cast(), _mm_cvttpd_epi32(x));
    compare (a, b) Mask64x2(_mm_cmplt_pd(a, b)), Mask64x2(_mm_cmple_pd(a, b));
    any (mask) _mm_movemask_pd(mask.0) != 0;
    select (mask, a, b) _mm_or_pd(_mm_and_pd(mask.0, a), _mm_andnot_pd(mask.0, b));
    mul_add (a, b, c) _mm_add_pd(_mm_mul_pd(a, b), c);
    difference (a, b, c, d) split_difference(a, b, c, d);
    split (x) x.split_bits();
    scale (x, k) x.scale_bits(k);
    reciprocal (x) Self::splat(1.0) / x;
    quotient (x, divisor, _r) x / divisor;
    series HALF_ARTANH_F64 LN_F64 EXP_F64
}

register! {
    /// 4 numbers of single precision, SSE2.
    F32x4: f32 as u32 x 4 in __m128 / __m128i;
    mask Mask32x4;
    arithmetic _mm_set1_ps _mm_add_ps _mm_sub_ps _mm_mul_ps _mm_div_ps _mm_sqrt_ps _mm_max_ps _mm_min_ps;
    bits _mm_castps_si128 _mm_castsi128_ps _mm_set1_epi32 _mm_add_epi32 _mm_and_si128 _mm_or_si128 _mm_srli_epi32 _mm_slli_epi32;
    memory _mm_loadu_ps _mm_storeu_ps;
    integers (x, to) _mm_storeu_si128(to.cast(), _mm_cvttps_epi32(x));
    compare (a, b) Mask32x4(_mm_cmplt_ps(a, b)), Mask32x4(_mm_cmple_ps(a, b));
    any (mask) _mm_movemask_ps(mask.0) != 0;
    select (mask, a, b) _mm_or_ps(_mm_and_ps(mask.0, a), _mm_andnot_ps(mask.0, b));
    mul_add (a, b, c) _mm_add_ps(_mm_mul_ps(a, b), c);
    difference (a, b, c, d) widened_difference(a, b, c, d);
    split (x) x.split_bits();
    scale (x, k) x.scale_bits(k);
    reciprocal (x) Self::splat(1.0) / x;
    quotient (x, divisor, _r) x / divisor;
    series HALF_ARTANH_F32 LN_F32 EXP_F32
}

register! {
    /// 4 numbers of double precision, AVX2 with FMA.
    F64x4: f64 as u64 x 4 in __m256d / __m256i;
    mask Mask64x4;
    arithmetic _mm256_set1_pd _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd _mm256_max_pd _mm256_min_pd;
    bits _mm256_castpd_si256 _mm256_castsi256_pd _mm256_set1_epi64x _mm256_add_epi64 _mm256_and_si256 _mm256_or_si256 _mm256_srli_epi64 _mm256_slli_epi64;
    memory _mm256_loadu_pd _mm256_storeu_pd;
    integers (x, to) _mm_storeu_si128(to.cast(), _mm256_cvttpd_epi32(x));
    compare (a, b) Mask64x4(_mm256_cmp_pd::<_CMP_LT_OQ>(a, b)), Mask64x4(_mm256_cmp_pd::<_CMP_LE_OQ>(a, b));
    any (mask) _mm256_movemask_pd(mask.0) != 0;
    select (mask, a, b) _mm256_blendv_pd(b, a, mask.0);
    mul_add (a, b, c) _mm256_fmadd_pd(a, b, c);
    difference (a, b, c, d) fused_difference(a, b, c, d);
    split (x) x.split_bits();
    scale (x, k) x.scale_bits(k);
    reciprocal (x) Self::splat(1.0) / x;
    quotient (x, divisor, r) corrected_quotient(x, divisor, r);
    series HALF_ARTANH_F64 LN_F64 EXP_F64;
    // A blend of bytes: a select would be compiled to a masked store, which AMD's processors before Zen 4 execute in
    // microcode.
    store_where (mask, x, to) {
        let old = _mm256_castpd_si256(_mm256_loadu_pd(to));
        let new = _mm256_blendv_epi8(old, _mm256_castpd_si256(x), _mm256_castpd_si256(mask.0));
        _mm256_storeu_pd(to, _mm256_castsi256_pd(new))
    };
    load_first (from, count, fill) {
        let mask = _mm256_cmpgt_epi64(_mm256_set1_epi64x(count as i64), _mm256_setr_epi64x(0, 1, 2, 3));
        _mm256_blendv_pd(fill, _mm256_maskload_pd(from, mask), _mm256_castsi256_pd(mask))
    }
}

register! {
    /// 8 numbers of single precision, AVX2 with FMA.
    F32x8: f32 as u32 x 8 in __m256 / __m256i;
    mask Mask32x8;
    arithmetic _mm256_set1_ps _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps _mm256_sqrt_ps _mm256_max_ps _mm256_min_ps;
    bits _mm256_castps_si256 _mm256_castsi256_ps _mm256_set1_epi32 _mm256_add_epi32 _mm256_and_si256 _mm256_or_si256 _mm256_srli_epi32 _mm256_slli_epi32;
    memory _mm256_loadu_ps _mm256_storeu_ps;
    integers (x, to) _mm256_storeu_si256(to.cast(), _mm256_cvttps_epi32(x));
    compare (a, b) Mask32x8(_mm256_cmp_ps::<_CMP_LT_OQ>(a, b)), Mask32x8(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b));
    any (mask) _mm256_movemask_ps(mask.0) != 0;
    select (mask, a, b) _mm256_blendv_ps(b, a, mask.0);
    mul_add (a, b, c) _mm256_fmadd_ps(a, b, c);
    difference (a, b, c, d) fused_difference(a, b, c, d);
    split (x) x.split_bits();
    scale (x, k) x.scale_bits(k);
    reciprocal (x) Self::splat(1.0) / x;
    quotient (x, divisor, r) corrected_quotient(x, divisor, r);
    series HALF_ARTANH_F32 LN_F32 EXP_F32;
    store_where (mask, x, to) {
        let old = _mm256_castps_si256(_mm256_loadu_ps(to));
        let new = _mm256_blendv_epi8(old, _mm256_castps_si256(x), _mm256_castps_si256(mask.0));
        _mm256_storeu_ps(to, _mm256_castsi256_ps(new))
    };
    load_first (from, count, fill) {
        let mask = _mm256_cmpgt_epi32(_mm256_set1_epi32(count as i32), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
        _mm256_blendv_ps(fill, _mm256_maskload_ps(from, mask), _mm256_castsi256_ps(mask))
    }
}

register! {
    /// 8 numbers of double precision, AVX-512.
    F64x8: f64 as u64 x 8 in __m512d / __m512i;
    mask __mmask8;
    arithmetic _mm512_set1_pd _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd _mm512_sqrt_pd _mm512_max_pd _mm512_min_pd;
    bits _mm512_castpd_si512 _mm512_castsi512_pd _mm512_set1_epi64 _mm512_add_epi64 _mm512_and_si512 _mm512_or_si512 _mm512_srli_epi64 _mm512_slli_epi64;
    memory _mm512_loadu_pd _mm512_storeu_pd;
    integers (x, to) _mm256_storeu_si256(to.cast(), _mm512_cvttpd_epi32(x));
    compare (a, b) _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b), _mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b);
    any (mask) mask != 0;
    select (mask, a, b) _mm512_mask_blend_pd(mask, b, a);
    mul_add (a, b, c) _mm512_fmadd_pd(a, b, c);
    difference (a, b, c, d) fused_difference(a, b, c, d);
    split (x) (
        // SAFETY: as in `register!`: the processor has the instructions.
        F64x8(unsafe { _mm512_getmant_pd::<_MM_MANT_NORM_P75_1P5, _MM_MANT_SIGN_ZERO>(x.0) }),
        // SAFETY: as above.
        F64x8(unsafe { _mm512_getexp_pd(_mm512_mul_pd(x.0, _mm512_set1_pd(FOUR_THIRDS))) })
    );
    // SAFETY: as in `register!`: the processor has the instructions.
    scale (x, k) F64x8(unsafe { _mm512_scalef_pd(x.0, k.0) });
    reciprocal (x) {
        // SAFETY: as in `register!`: the processor has the instructions.
        let y = F64x8(unsafe { _mm512_rcp14_pd(x.0) });
        let series = reciprocal_series::<_, 3>(x, y);
        const UPWARDS: i32 = _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC;
        // SAFETY: as in `register!`: the processor has the instructions.
        let size = F64x8(unsafe { _mm512_fmadd_round_pd::<UPWARDS>(series.0, y.abs().0, y.abs().0) });
        newton_reciprocal(x, size.with_sign_of(x))
    };
    quotient (x, divisor, r) corrected_quotient(x, divisor, r);
    series HALF_ARTANH_F64 LN_F64 EXP_F64;
    store_where (mask, x, to) _mm512_mask_storeu_pd(to, mask, x)
}

register! {
    /// 16 numbers of single precision, AVX-512.
    F32x16: f32 as u32 x 16 in __m512 / __m512i;
    mask __mmask16;
    arithmetic _mm512_set1_ps _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps _mm512_sqrt_ps _mm512_max_ps _mm512_min_ps;
    bits _mm512_castps_si512 _mm512_castsi512_ps _mm512_set1_epi32 _mm512_add_epi32 _mm512_and_si512 _mm512_or_si512 _mm512_srli_epi32 _mm512_slli_epi32;
    memory _mm512_loadu_ps _mm512_storeu_ps;
    integers (x, to) _mm512_storeu_si512(to.cast(), _mm512_cvttps_epi32(x));
    compare (a, b) _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b), _mm512_cmp_ps_mask::<_CMP_LE_OQ>(a, b);
    any (mask) mask != 0;
    select (mask, a, b) _mm512_mask_blend_ps(mask, b, a);
    mul_add (a, b, c) _mm512_fmadd_ps(a, b, c);
    difference (a, b, c, d) fused_difference(a, b, c, d);
    split (x) (
        // SAFETY: as in `register!`: the processor has the instructions.
        F32x16(unsafe { _mm512_getmant_ps::<_MM_MANT_NORM_P75_1P5, _MM_MANT_SIGN_ZERO>(x.0) }),
        // SAFETY: as above.
        F32x16(unsafe { _mm512_getexp_ps(_mm512_mul_ps(x.0, _mm512_set1_ps(FOUR_THIRDS as f32))) })
    );
    // SAFETY: as in `register!`: the processor has the instructions.
    scale (x, k) F32x16(unsafe { _mm512_scalef_ps(x.0, k.0) });
    reciprocal (x) {
        // SAFETY: as in `register!`: the processor has the instructions.
        let y = F32x16(unsafe { _mm512_rcp14_ps(x.0) });
        let series = reciprocal_series::<_, 1>(x, y);
        const UPWARDS: i32 = _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC;
        // SAFETY: as in `register!`: the processor has the instructions.
        let size = F32x16(unsafe { _mm512_fmadd_round_ps::<UPWARDS>(series.0, y.abs().0, y.abs().0) });
        newton_reciprocal(x, size.with_sign_of(x))
    };
    quotient (x, divisor, r) corrected_quotient(x, divisor, r);
    series HALF_ARTANH_F32 LN_F32 EXP_F32;
    store_where (mask, x, to) _mm512_mask_storeu_ps(to, mask, x)
}

register! {
    /// One point of double precision, AVX2 with FMA, by the same operations as [`F64x4`]. Unlike with `f64`, a select
    /// is never compiled to a branch, and the compiler does not rearrange the operations.
    F64Point: f64 as u64 x 1 in __m128d / __m128i;
    mask Mask64x2;
    arithmetic _mm_set1_pd _mm_add_pd _mm_sub_pd _mm_mul_pd _mm_div_pd _mm_sqrt_pd _mm_max_pd _mm_min_pd;
    bits _mm_castpd_si128 _mm_castsi128_pd _mm_set1_epi64x _mm_add_epi64 _mm_and_si128 _mm_or_si128 _mm_srli_epi64 _mm_slli_epi64;
    memory _mm_load1_pd _mm_store_sd;
    integers (x, to) *to = _mm_cvttsd_si32(x);
    compare (a, b) Mask64x2(_mm_cmp_pd::<_CMP_LT_OQ>(a, b)), Mask64x2(_mm_cmp_pd::<_CMP_LE_OQ>(a, b));
    any (mask) _mm_movemask_pd(mask.0) != 0;
    select (mask, a, b) _mm_or_pd(_mm_and_pd(mask.0, a), _mm_andnot_pd(mask.0, b));
    mul_add (a, b, c) _mm_fmadd_pd(a, b, c);
    difference (a, b, c, d) fused_difference(a, b, c, d);
    split (x) x.split_bits();
    scale (x, k) x.scale_bits(k);
    reciprocal (x) Self::splat(1.0) / x;
    quotient (x, divisor, r) corrected_quotient(x, divisor, r);
    series HALF_ARTANH_F64 LN_F64 EXP_F64;
    // One decision for all numbers of a point, which hardly ever is the other.
    store_where (mask, x, to) if Self::any(mask) { _mm_store_sd(to, x) };
    pair (a, b) _mm_unpacklo_pd(a, b), apart (x) [_mm_unpacklo_pd(x, x), _mm_unpackhi_pd(x, x)]
}

register! {
    /// One point of single precision, as [`F64Point`].
    F32Point: f32 as u32 x 1 in __m128 / __m128i;
    mask Mask32x4;
    arithmetic _mm_set1_ps _mm_add_ps _mm_sub_ps _mm_mul_ps _mm_div_ps _mm_sqrt_ps _mm_max_ps _mm_min_ps;
    bits _mm_castps_si128 _mm_castsi128_ps _mm_set1_epi32 _mm_add_epi32 _mm_and_si128 _mm_or_si128 _mm_srli_epi32 _mm_slli_epi32;
    memory _mm_load1_ps _mm_store_ss;
    integers (x, to) *to = _mm_cvttss_si32(x);
    compare (a, b) Mask32x4(_mm_cmp_ps::<_CMP_LT_OQ>(a, b)), Mask32x4(_mm_cmp_ps::<_CMP_LE_OQ>(a, b));
    any (mask) _mm_movemask_ps(mask.0) != 0;
    select (mask, a, b) _mm_or_ps(_mm_and_ps(mask.0, a), _mm_andnot_ps(mask.0, b));
    mul_add (a, b, c) _mm_fmadd_ps(a, b, c);
    difference (a, b, c, d) fused_difference(a, b, c, d);
    split (x) x.split_bits();
    scale (x, k) x.scale_bits(k);
    reciprocal (x) Self::splat(1.0) / x;
    quotient (x, divisor, r) corrected_quotient(x, divisor, r);
    series HALF_ARTANH_F32 LN_F32 EXP_F32;
    store_where (mask, x, to) if Self::any(mask) { _mm_store_ss(to, x) };
    pair (a, b) _mm_unpacklo_ps(a, b), apart (x) [_mm_shuffle_ps::<0x00>(x, x), _mm_shuffle_ps::<0x55>(x, x)]
}

macro_rules! single {
    ($name:ident of $t:ident, $first:ident) => {
        impl Single<$t> for $name {
            #[inline(always)]
            fn of(x: $t) -> Self {
                // SAFETY: as in `register!`: the processor has the instructions.
                unsafe { Self::load(&x) }
            }
            #[inline(always)]
            fn value(self) -> $t {
                // SAFETY: as in `register!`: the processor has the instructions.
                unsafe { $first(self.0) }
            }
            #[inline(always)]
            fn holds(mask: Self::Mask) -> bool {
                Self::any(mask)
            }
        }
    };
}

single!(F64Point of f64, _mm_cvtsd_f64);
single!(F32Point of f32, _mm_cvtss_f32);
