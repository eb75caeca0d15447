//! Buffers that components of points are copied to, next to each other, and from which results are copied back.

use core::marker::PhantomData;
use core::ops::Range;
use core::ptr::null_mut;

use super::layout::components;
use crate::law::number::real::{Lanes, Scalar};

/// Where the components of an array begin: at pointers of their own, or at equal distances from a first one.
pub(super) trait Columns<P>: Copy {
    fn column(self, c: usize) -> P;
}

impl<P: Copy, const N: usize> Columns<P> for &[P; N] {
    #[inline(always)]
    fn column(self, c: usize) -> P {
        self[c]
    }
}

impl<T> Columns<*const T> for (*const T, usize) {
    #[inline(always)]
    fn column(self, c: usize) -> *const T {
        self.0.wrapping_add(c * self.1)
    }
}

impl<T> Columns<*mut T> for (*mut T, usize) {
    #[inline(always)]
    fn column(self, c: usize) -> *mut T {
        self.0.wrapping_add(c * self.1)
    }
}

/// Copies of points, component-major and next to each other, in a buffer from which each array takes its room.
pub(super) trait Copies<T: Scalar> {
    /// The number of copies.
    const COUNT: usize;

    /// Room for so many components of every copy.
    fn room(&mut self, components: usize) -> *mut T;

    /// Copies `components` components of points that are `stride` apart to `to`.
    ///
    /// # Safety
    /// The points have these components, and there is room for them behind `to`.
    unsafe fn read(&self, from: impl Columns<*const T>, stride: usize, components: usize, to: *mut T);

    /// Copies components back to the points.
    ///
    /// # Safety
    /// As for [`read`](Self::read), in the other direction.
    unsafe fn write(&self, from: *const T, to: impl Columns<*mut T>, stride: usize, components: usize);

    /// The copy of an input; null if there is none.
    ///
    /// # Safety
    /// As for [`read`](Self::read).
    #[inline(always)]
    unsafe fn input(&mut self, from: impl Columns<*const T>, stride: usize, components: usize) -> *mut T {
        if from.column(0).is_null() {
            return null_mut();
        }
        let copy = self.room(components);
        // SAFETY: the caller's array, and room for as many components.
        unsafe { self.read(from, stride, components, copy) };
        copy
    }

    /// As [`input`](Self::input), for an array with a pointer for each component.
    ///
    /// # Safety
    /// As for [`read`](Self::read).
    #[inline(always)]
    unsafe fn columns<const N: usize>(&mut self, from: &[*const T; N], stride: usize) -> [*const T; N] {
        // SAFETY: the same array, with N components.
        components(unsafe { self.input(from, stride, N) }.cast_const(), Self::COUNT)
    }

    /// Room for an output; null if it is not requested.
    #[inline(always)]
    fn room_for(&mut self, output: *mut T, components: usize) -> *mut T {
        if output.is_null() { output } else { self.room(components) }
    }

    /// Copies an output to the points; nothing if it is not requested.
    ///
    /// # Safety
    /// As for [`write`](Self::write).
    #[inline(always)]
    unsafe fn output(&self, from: *const T, to: impl Columns<*mut T>, stride: usize, components: usize) {
        if !to.column(0).is_null() {
            // SAFETY: the caller's array, and a copy of it.
            unsafe { self.write(from, to, stride, components) };
        }
    }
}

/// Copies of points that may be anywhere: the index of each of `COUNT` copies; the last ones repeat if there are fewer
/// points.
pub(super) struct Apart<T, const COUNT: usize> {
    next: *mut T,
    pub indices: [usize; COUNT],
}

impl<T, const COUNT: usize> Apart<T, COUNT> {
    pub fn new(memory: *mut T, points: Range<usize>) -> Self {
        let mut indices = [points.end - 1; COUNT];
        for (index, point) in indices.iter_mut().zip(points) {
            *index = point;
        }
        Apart { next: memory, indices }
    }

    /// Where each of the points is in an array.
    #[inline(always)]
    fn offsets(&self, stride: usize) -> [usize; COUNT] {
        self.indices.map(|point| point * stride)
    }
}

impl<T: Scalar, const COUNT: usize> Copies<T> for Apart<T, COUNT> {
    const COUNT: usize = COUNT;

    #[inline(always)]
    fn room(&mut self, components: usize) -> *mut T {
        let room = self.next;
        self.next = room.wrapping_add(components * COUNT);
        room
    }

    #[inline(always)]
    unsafe fn read(&self, from: impl Columns<*const T>, stride: usize, components: usize, to: *mut T) {
        let offsets = self.offsets(stride);
        for c in 0..components {
            for (lane, &offset) in offsets.iter().enumerate() {
                // SAFETY: c < `components` and lane < COUNT by the loops.
                unsafe { *to.add(c * COUNT + lane) = *from.column(c).add(offset) };
            }
        }
    }

    /// Lanes without a point of their own store the last point's value again.
    #[inline(always)]
    unsafe fn write(&self, from: *const T, to: impl Columns<*mut T>, stride: usize, components: usize) {
        let offsets = self.offsets(stride);
        for c in 0..components {
            for (lane, &offset) in offsets.iter().enumerate() {
                // SAFETY: c < `components` and lane < COUNT by the loops.
                unsafe { *to.column(c).add(offset) = *from.add(c * COUNT + lane) };
            }
        }
    }
}

/// Copies of fewer points than a register holds, which are next to each other: a register for each component, whose
/// other lanes repeat the last point.
pub(super) struct Padded<T, R> {
    next: *mut T,
    points: usize,
    register: PhantomData<R>,
}

impl<T, R> Padded<T, R> {
    #[inline(always)]
    pub fn new(memory: *mut T, points: usize) -> Self {
        Padded { next: memory, points, register: PhantomData }
    }
}

impl<T: Scalar, R: Lanes<T>> Copies<T> for Padded<T, R> {
    const COUNT: usize = R::COUNT;

    #[inline(always)]
    fn room(&mut self, components: usize) -> *mut T {
        let room = self.next;
        self.next = room.wrapping_add(components * R::COUNT);
        room
    }

    #[inline(always)]
    unsafe fn read(&self, from: impl Columns<*const T>, _: usize, components: usize, to: *mut T) {
        for c in 0..components {
            // SAFETY: `points` values of each component, one at least, and a register for it.
            unsafe { filled::<T, R>(from.column(c), self.points).store(to.add(c * R::COUNT)) };
        }
    }

    #[inline(always)]
    unsafe fn write(&self, from: *const T, to: impl Columns<*mut T>, _: usize, components: usize) {
        // The binary digits of the number of points: a loop over so few values would be compiled to a call.
        let mut lane = 0;
        for digit in [4, 2, 1] {
            if digit < R::COUNT && self.points & digit != 0 {
                for c in 0..components {
                    let (from, to) = (from.wrapping_add(c * R::COUNT + lane), to.column(c).wrapping_add(lane));
                    // SAFETY: the digits add up to `points`, so that lane + digit ≤ points; c < `components`.
                    unsafe { to.copy_from_nonoverlapping(from, digit) };
                }
                lane += digit;
            }
        }
    }
}

/// The first `count` values of an array, the last one of them in the other lanes too.
///
/// # Safety
/// There are as many, one at least and fewer than COUNT.
#[inline(always)]
unsafe fn filled<T: Scalar, R: Lanes<T>>(array: *const T, count: usize) -> R {
    // SAFETY: `count` values, one at least.
    unsafe { R::load_first(array, count, R::splat((*array.add(count - 1)).into())) }
}
