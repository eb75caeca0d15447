//! Arrays that start on a cache line.

use std::ops::{Deref, DerefMut};

/// Numbers in a cache line, of single precision.
pub const LINE: usize = 16;

/// An array whose first element stands on a cache line.
#[derive(Clone, Debug)]
pub struct Aligned<T> {
    values: Vec<T>,
    start: usize,
    length: usize,
}

impl<T: Copy> Aligned<T> {
    /// So many times this value.
    pub fn new(value: T, length: usize) -> Self {
        let values = vec![value; length + LINE];
        let start = values.as_ptr().align_offset(LINE * size_of::<f32>()).min(LINE);
        Aligned { values, start, length }
    }
}

impl<T> Deref for Aligned<T> {
    type Target = [T];
    #[inline]
    fn deref(&self) -> &[T] {
        &self.values[self.start..self.start + self.length]
    }
}

impl<T> DerefMut for Aligned<T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.values[self.start..self.start + self.length]
    }
}
