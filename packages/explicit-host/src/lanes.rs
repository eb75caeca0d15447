//! Neighbouring elements worked on together: their numbers, and the algebra of vectors made of them.

#![expect(clippy::needless_range_loop, clippy::manual_memcpy, reason = "what is inlined for certain: see Lanes")]

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::kernels::Kernels;
use toron_materials::entries::precision::BlockPrecision;

/// Elements side by side in an inner loop.
pub const LANES: usize = 8;

/// The number that a run is computed in: f64 or f32.
pub trait Number:
    BlockPrecision
    + Kernels
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Serialize
    + DeserializeOwned
{
    fn square_root(self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn square_root(self) -> Self {
        self.sqrt()
    }
}

impl Number for f32 {
    #[inline(always)]
    fn square_root(self) -> Self {
        self.sqrt()
    }
}

/// Numbers of neighbouring elements, worked on together: one register where the processor's are wide enough. Plain
/// arrays, which the compiler vectorises: registers as the law has them could only be made where their instructions are
/// known to be there, by unsafe code.
///
/// The loops that run under [`run_widest`](super::instructions::run_widest) use its instructions only where they are
/// inlined there. Therefore whatever they call is `#[inline(always)]`, down to the operators here, and they loop over
/// indices: no closures, adaptors of iterators or `copy_from_slice`, which remain calls where the compiler does not
/// choose to inline them.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Lanes<T>(pub [T; LANES]);

impl<T: Number> Lanes<T> {
    #[inline(always)]
    pub fn splat(value: T) -> Self {
        Lanes([value; LANES])
    }

    /// The same number in all lanes.
    #[inline(always)]
    pub fn constant(value: f64) -> Self {
        Lanes::splat(T::from_f64(value))
    }

    #[inline(always)]
    pub fn zero() -> Self {
        Lanes::splat(T::default())
    }

    #[inline(always)]
    pub fn at(array: &[T], first: usize) -> Self {
        let source = &array[first..first + LANES];
        let mut lanes = Lanes::zero();
        for l in 0..LANES {
            lanes.0[l] = source[l];
        }
        lanes
    }

    #[inline(always)]
    pub fn store(self, array: &mut [T], first: usize) {
        let target = &mut array[first..first + LANES];
        for l in 0..LANES {
            target[l] = self.0[l];
        }
    }

    /// These where the others are above 0, elsewhere 0.
    #[inline(always)]
    pub fn only_where(mut self, others: Self) -> Self {
        for l in 0..LANES {
            self.0[l] = if others.0[l] > T::default() { self.0[l] } else { T::default() };
        }
        self
    }

    /// The larger ones; the others' where one is NaN.
    #[inline(always)]
    pub fn max(mut self, other: Self) -> Self {
        for l in 0..LANES {
            self.0[l] = if self.0[l] > other.0[l] { self.0[l] } else { other.0[l] };
        }
        self
    }

    /// The smaller ones; the others' where one is NaN.
    #[inline(always)]
    pub fn min(mut self, other: Self) -> Self {
        for l in 0..LANES {
            self.0[l] = if self.0[l] < other.0[l] { self.0[l] } else { other.0[l] };
        }
        self
    }

    #[inline(always)]
    pub fn sqrt(mut self) -> Self {
        for l in 0..LANES {
            self.0[l] = self.0[l].square_root();
        }
        self
    }

    /// The sum over the lanes.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        let mut sum = 0.0;
        for l in 0..LANES {
            sum += self.0[l].into();
        }
        sum
    }

    /// The largest of the lanes, or 0; a NaN is seen.
    #[inline(always)]
    pub fn largest(self) -> f64 {
        let mut result = 0.0;
        for l in 0..LANES {
            result = largest(result, self.0[l].into());
        }
        result
    }
}

/// The larger of two numbers; a NaN is seen, where `f64::max` drops it.
#[inline(always)]
pub fn largest(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

/// The smaller one; NaN where one is.
#[inline(always)]
pub fn smallest(a: f64, b: f64) -> f64 {
    -largest(-a, -b)
}

/// An operator, lane by lane.
macro_rules! lanewise {
    ($operator:ident, $method:ident, $symbol:tt) => {
        impl<T: Number> $operator for Lanes<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let mut result = self;
                for l in 0..LANES {
                    result.0[l] = self.0[l] $symbol other.0[l];
                }
                result
            }
        }
    };
}

lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

/// Components that begin at `first`, of an array with this leading dimension.
#[inline(always)]
pub fn load<T: Number, const N: usize>(array: &[T], stride: usize, first: usize) -> [Lanes<T>; N] {
    let mut components = [Lanes::zero(); N];
    for c in 0..N {
        components[c] = Lanes::at(array, c * stride + first);
    }
    components
}

/// A symmetric matrix times a vector.
#[inline(always)]
pub fn times<T: Number>(matrix: &[Lanes<T>; 6], [x, y, z]: [Lanes<T>; 3]) -> [Lanes<T>; 3] {
    let [s11, s22, s33, s12, s23, s31] = *matrix;
    [s11 * x + s12 * y + s31 * z, s12 * x + s22 * y + s23 * z, s31 * x + s23 * y + s33 * z]
}

#[inline(always)]
pub fn add<T: Number>(a: [Lanes<T>; 3], b: [Lanes<T>; 3]) -> [Lanes<T>; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub fn sub<T: Number>(a: [Lanes<T>; 3], b: [Lanes<T>; 3]) -> [Lanes<T>; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a − k b.
#[inline(always)]
pub fn less<T: Number>(a: [Lanes<T>; 3], k: Lanes<T>, b: [Lanes<T>; 3]) -> [Lanes<T>; 3] {
    [a[0] - k * b[0], a[1] - k * b[1], a[2] - k * b[2]]
}

/// k a + l b.
#[inline(always)]
pub fn combine<T: Number>(k: Lanes<T>, a: [Lanes<T>; 3], l: Lanes<T>, b: [Lanes<T>; 3]) -> [Lanes<T>; 3] {
    [k * a[0] + l * b[0], k * a[1] + l * b[1], k * a[2] + l * b[2]]
}

#[inline(always)]
pub fn cross<T: Number>(a: [Lanes<T>; 3], b: [Lanes<T>; 3]) -> [Lanes<T>; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub fn dot<T: Number>(a: [Lanes<T>; 3], b: [Lanes<T>; 3]) -> Lanes<T> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
