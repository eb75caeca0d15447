//! Numbers of a block's elements that go through memory in every step: those of [`LANES`] neighbours together, row by
//! row, so that a loop over the elements reads one stream, which the processor fetches ahead. With a stream for each
//! row a panel of 30 000 elements, whose numbers do not stay in the caches, waited for memory two fifths of its time.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use serde::{Deserialize, Serialize};

use super::lanes::{LANES, Lanes, Number};

/// So many numbers for each element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rows<T> {
    rows: usize,
    pub values: Vec<T>,
}

impl<T: Number> Rows<T> {
    /// All 0; `elements` in whole lanes.
    pub fn new(rows: usize, elements: usize) -> Self {
        Rows { rows, values: vec![T::default(); rows * elements.next_multiple_of(LANES)] }
    }

    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    #[inline(always)]
    fn place(&self, row: usize, element: usize) -> usize {
        (element / LANES * self.rows + row) * LANES + element % LANES
    }

    #[inline]
    pub fn number(&self, row: usize, element: usize) -> T {
        self.values[self.place(row, element)]
    }

    pub fn set(&mut self, row: usize, element: usize, value: T) {
        let place = self.place(row, element);
        self.values[place] = value;
    }

    /// N rows of the elements from `first` on, which is a multiple of [`LANES`].
    #[inline(always)]
    pub fn at<const N: usize>(&self, row: usize, first: usize) -> [Lanes<T>; N] {
        let place = self.place(row, first);
        let source = &self.values[place..place + N * LANES];
        let mut rows = [Lanes::zero(); N];
        for i in 0..N {
            rows[i] = Lanes::at(source, i * LANES);
        }
        rows
    }

    /// Puts N rows there.
    #[inline(always)]
    pub fn store<const N: usize>(&mut self, row: usize, first: usize, rows: [Lanes<T>; N]) {
        let place = self.place(row, first);
        let target = &mut self.values[place..place + N * LANES];
        for i in 0..N {
            rows[i].store(target, i * LANES);
        }
    }
}
