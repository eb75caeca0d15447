//! Arrays in any layout, with guards between, before and behind what belongs to points.

use toron_c::Layout;
use toron_test_support::block::Number;

use super::case::{Form, Placing};

/// Fills what no point owns, and outputs beforehand: a NaN of its own, so that reading it shows too.
const GUARD: u64 = 0x7ff8_0000_7fc0_5a5a;
/// How many guards stand behind the last entry.
const BEHIND: usize = 3;

/// A guard in this precision.
pub fn guard<T: Number>() -> T {
    T::from_bits(GUARD)
}

/// An array of a number of components of a number of points.
#[derive(Clone, Debug)]
pub struct Array<T> {
    pub values: Vec<T>,
    pub components: usize,
    pub points: usize,
    offset: usize,
    leading: usize,
    stride: usize,
    form: Form,
}

impl<T: Number> Array<T> {
    /// An array of guards. `leading` is the leading dimension of the block.
    pub fn new(components: usize, points: usize, placing: Placing, leading: usize) -> Self {
        let Placing { form, gap, offset } = placing;
        let (leading, stride) = match form {
            Form::Plain => (leading, 1),
            Form::Leading | Form::Pointers => (points + gap, 1),
            Form::Rows => (1, (components + gap).max(2)),
            Form::Strided => ((points.max(1) - 1) * (2 + gap % 3) + 1 + gap, 2 + gap % 3),
        };
        let length = offset + components * leading + points * stride + BEHIND;
        Array { values: vec![guard(); length], components, points, offset, leading, stride, form }
    }

    /// An array of one leading dimension, the number of points.
    pub fn plain(components: usize, points: usize) -> Self {
        Array::new(components, points, Placing::default(), points)
    }

    /// With the numbers of each point.
    pub fn filled<'a>(mut self, rows: impl Iterator<Item = &'a [f64]>) -> Self {
        for (i, row) in rows.enumerate() {
            for (c, &value) in row.iter().enumerate() {
                self.set(c, i, T::splat(value));
            }
        }
        self
    }

    fn at(&self, component: usize, point: usize) -> usize {
        self.offset + component * self.leading + point * self.stride
    }

    pub fn get(&self, component: usize, point: usize) -> T {
        self.values[self.at(component, point)]
    }

    pub fn set(&mut self, component: usize, point: usize, value: T) {
        let at = self.at(component, point);
        self.values[at] = value;
    }

    /// The components of a point.
    pub fn row(&self, point: usize) -> Vec<f64> {
        (0..self.components).map(|c| self.get(c, point).into()).collect()
    }

    /// The bits of a point.
    pub fn bits(&self, point: usize) -> impl Iterator<Item = u64> {
        (0..self.components).map(move |c| self.get(c, point).bits())
    }

    /// The layout as a caller says it.
    pub fn layout(&self) -> Layout {
        match self.form {
            Form::Plain => Layout::default(),
            Form::Leading => Layout { leading_dimension: self.leading, stride: self.points % 2 },
            // Left out, a leading dimension is 1 beside a stride.
            Form::Rows => Layout { leading_dimension: self.points % 2, stride: self.stride },
            Form::Strided => Layout { leading_dimension: self.leading, stride: self.stride },
            Form::Pointers => Layout::default(),
        }
    }

    /// From this component on.
    pub fn pointer(&mut self, component: usize) -> *mut T {
        let at = self.at(component, 0);
        self.values.as_mut_ptr().wrapping_add(at)
    }

    /// That of the first component, and of the others where each has its own; null unless it is wanted.
    pub fn pointers<const N: usize>(&mut self, wanted: bool) -> [*mut T; N] {
        let each = self.form == Form::Pointers;
        std::array::from_fn(|c| if wanted && (c == 0 || each) { self.pointer(c) } else { std::ptr::null_mut() })
    }

    /// Which entries belong to points.
    fn owned(&self) -> Vec<bool> {
        let mut owned = vec![false; self.values.len()];
        for c in 0..self.components {
            for i in 0..self.points {
                owned[self.at(c, i)] = true;
            }
        }
        owned
    }

    /// The last entry before the end that no point owns.
    pub fn padding(&self) -> usize {
        self.owned().iter().rposition(|&owned| !owned).expect("guards stand behind the last entry")
    }

    /// The first entry that no point owns and that is no guard any more.
    pub fn written_padding(&self) -> Option<usize> {
        let guard = guard::<T>().bits();
        let written = self.values.iter().filter(|x| x.bits() != guard).count();
        let of_points = (0..self.components)
            .map(|c| (0..self.points).filter(|&i| self.get(c, i).bits() != guard).count())
            .sum::<usize>();
        if written == of_points {
            return None;
        }
        let owned = self.owned();
        (0..self.values.len()).find(|&at| !owned[at] && self.values[at].bits() != guard)
    }

    /// Whether nothing has been written.
    pub fn is_untouched(&self) -> bool {
        let guard = guard::<T>().bits();
        self.values.iter().all(|x| x.bits() == guard)
    }

    /// Whether it has the same bits everywhere.
    pub fn is_as(&self, other: &Array<T>) -> bool {
        self.values.len() == other.values.len()
            && self.values.iter().zip(&other.values).all(|(a, b)| a.bits() == b.bits())
    }
}
