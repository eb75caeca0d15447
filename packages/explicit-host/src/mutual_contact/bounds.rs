//! Boxes around vectors.

use crate::vector::{Vector, dot, minus};

/// A box that contains vectors.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    pub low: Vector,
    pub high: Vector,
}

impl Bounds {
    pub const EMPTY: Bounds = Bounds { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    #[inline(always)]
    pub fn take(&mut self, vector: Vector) {
        for i in 0..3 {
            self.low[i] = if vector[i] < self.low[i] { vector[i] } else { self.low[i] };
            self.high[i] = if vector[i] > self.high[i] { vector[i] } else { self.high[i] };
        }
    }

    #[inline(always)]
    pub fn with(mut self, other: Bounds) -> Bounds {
        for i in 0..3 {
            self.low[i] = self.low[i].min(other.low[i]);
            self.high[i] = self.high[i].max(other.high[i]);
        }
        self
    }

    /// The largest difference of a vector in one and a vector in the other; negative infinity where one is empty.
    #[inline(always)]
    pub fn largest_difference(&self, other: &Bounds) -> f64 {
        let a = minus(self.high, other.low);
        let b = minus(other.high, self.low);
        let mut farthest = [0.0; 3];
        for i in 0..3 {
            farthest[i] = if a[i] > b[i] { a[i] } else { b[i] };
        }
        if farthest[0] < 0.0 { f64::NEG_INFINITY } else { dot(farthest, farthest).sqrt() }
    }

    /// How far two boxes are from each other.
    pub fn gap(&self, other: &Bounds) -> f64 {
        let mut apart = [0.0; 3];
        for i in 0..3 {
            apart[i] = (other.low[i] - self.high[i]).max(self.low[i] - other.high[i]).max(0.0);
        }
        dot(apart, apart).sqrt()
    }
}
