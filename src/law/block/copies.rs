//! Points copied to a small block of their own, evaluated there, and their results copied back: those that do not fill
//! a register, and those that are not next to each other in memory. They go through the same operations as all others,
//! so that the result of a point does not depend on where it is.

use core::marker::PhantomData;
use core::mem::MaybeUninit;
use core::ops::Range;
use core::ptr::{null, null_mut};

use super::dispatch::Precision;
use super::points::{Circumstances, Needs, PARTS, Points, Strides, components, components_mut};
use super::run::Kernels;
use crate::law::number::real::{Lanes, Scalar, WIDEST};
use crate::law::status;

/// How many numbers a point of every law takes in copies: F, fibre, limit, temperature, stress, wave speed and
/// `active`; and with modes and the largest tangent. A law's state is added to them, and what else its points have, see
/// [`Kernels::Else`].
const FEW: usize = 9 + 3 + 1 + 1 + 6 + 1 + 1;
const ALL: usize = FEW + 24 + 81;

/// All numbers of a point of a law with so many variables, and so many numbers of [`Kernels::Else`].
pub(super) const fn rows(state: usize, other: usize) -> usize {
    ALL + state + other
}

/// Memory for the numbers of `COUNT` points of a law: `ROWS` of every law's.
#[repr(C)]
struct Memory<T: Precision, L: Kernels<T>, const COUNT: usize, const ROWS: usize> {
    rows: [[MaybeUninit<T>; COUNT]; ROWS],
    others: [MaybeUninit<L::Else>; COUNT],
    state: [MaybeUninit<L::State>; COUNT],
}

/// Where the components of an array begin: at pointers of their own, or at equal distances from a first one.
trait Columns<P>: Copy {
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
trait Copies<T: Scalar> {
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

impl<T: Scalar> Points<T> {
    /// These points in `copies`, with the arrays that they have; the old state is in the place of the new one. An input
    /// has a line here, an output one here and one in [`take_results`](Self::take_results).
    ///
    /// # Safety
    /// The points are valid, see [`Points`], and checked; there is room for all numbers of each copy.
    #[inline(always)]
    unsafe fn read_into<C: Copies<T>>(&self, copies: &mut C, codes: *mut i32, needs: &Needs) -> Points<T> {
        let stride = &self.strides;
        let temperature = if needs.reads.temperature { self.circumstances.temperature } else { null() };
        let f_old = if needs.reads.old_gradient { self.f_old } else { [null(); 9] };
        // SAFETY: arrays of valid points have as many components as stand here.
        unsafe {
            let (state_old, state_new) = self.read_state_into(copies, needs);
            Points {
                n: C::COUNT,
                leading_dimension: C::COUNT,
                modes_leading_dimension: C::COUNT,
                axes_leading_dimension: C::COUNT,
                tangent_leading_dimension: C::COUNT,
                strides: Strides::UNIT,
                f_old: copies.columns(&f_old, stride.deformation_gradient),
                f_new: copies.columns(&self.f_new, stride.deformation_gradient),
                fibre: copies.columns(&self.fibre, stride.fibre),
                second_axis: copies.columns(&self.second_axis, stride.fibre),
                limit: copies.input((self.limits(needs.last), 0), stride.limit, 1),
                circumstances: Circumstances {
                    temperature: copies.input((temperature, 0), 1, 1),
                    ..self.circumstances
                },
                axes: copies.input((self.axes.cast_const(), self.axes_leading_dimension), stride.axes, 9),
                state_old,
                state_new,
                stress: components_mut(copies.room_for(self.stress[0], 6), C::COUNT),
                modes: copies.room_for(self.modes, 24),
                wave_speed: copies.room_for(self.wave_speed, 1),
                tangent: copies.room_for(self.tangent, self.measure.components()),
                active: copies.room_for(self.active, 1),
                status: codes,
                ..*self
            }
        }
    }

    /// Copies the results of copies to these points.
    ///
    /// # Safety
    /// The copies come from [`read_into`](Self::read_into), and have been evaluated.
    #[inline(always)]
    unsafe fn take_results<C: Copies<T>>(&self, of: &Points<T>, copies: &C, needs: &Needs) {
        let stride = &self.strides;
        // SAFETY: arrays of valid points have as many components as stand here, and so have their copies.
        unsafe {
            copies.output(of.stress[0], &self.stress, stride.stress, 6);
            let mut part = 0;
            while part < PARTS {
                let new = (self.state_new[part], self.leading_dimension);
                copies.output(of.state_new[part], new, stride.state, needs.parts[part]);
                part += 1;
            }
            copies.output(of.axes, (self.axes, self.axes_leading_dimension), stride.axes, 9);
            copies.output(of.modes, (self.modes, self.modes_leading_dimension), stride.modes, 24);
            copies.output(of.wave_speed, (self.wave_speed, 0), 1, 1);
            let tangent = (self.tangent, self.tangent_leading_dimension);
            copies.output(of.tangent, tangent, stride.tangent, self.measure.components());
            copies.output(of.active, (self.active, 0), 1, 1);
        }
    }

    /// The old state, where it is read, in the place of the new one, and where the new one goes if it is requested.
    ///
    /// # Safety
    /// As for [`read_into`](Self::read_into).
    #[inline(always)]
    unsafe fn read_state_into<C: Copies<T>>(
        &self,
        copies: &mut C,
        needs: &Needs,
    ) -> ([*const T; PARTS], [*mut T; PARTS]) {
        let (mut state_old, mut state_new, mut part) = ([null(); PARTS], [null_mut(); PARTS], 0);
        while part < PARTS {
            let (old, components) = (self.state_old[part], needs.parts[part]);
            let (new, latch) = (!self.state_new[part].is_null(), part == needs.last && !old.is_null());
            if new || latch {
                let (copy, read) = (copies.room(components), needs.read(part, components));
                // SAFETY: the old state of valid points has these components, and so has the room. A number whose bytes
                // are all 0 is 0.
                unsafe {
                    match old.is_null() {
                        true => copy.write_bytes(0, components * C::COUNT),
                        false => copies.read((old, self.leading_dimension), self.strides.state, read, copy),
                    }
                }
                state_old[part] = copy.cast_const();
                state_new[part] = if new { copy } else { null_mut() };
            }
            part += 1;
        }
        (state_old, state_new)
    }
}

/// Copies of points that may be anywhere: the index of each of `COUNT` copies; the last ones repeat if there are fewer
/// points.
struct Apart<T, const COUNT: usize> {
    next: *mut T,
    indices: [usize; COUNT],
}

impl<T, const COUNT: usize> Apart<T, COUNT> {
    fn new(memory: *mut T, points: Range<usize>) -> Self {
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
struct Padded<T, R> {
    next: *mut T,
    points: usize,
    register: PhantomData<R>,
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

/// How many points that are not next to each other are copied at a time; in double precision with modes or a tangent,
/// which take four times the room; and to how many copies if there are no more than these: all copies are evaluated.
const APART: usize = 32;
const LARGE_APART: usize = 16;
const FEW_APART: usize = 8;

/// Runs the kernels of a law on copies of the points, part by part, and copies the results back. Returns the worst of
/// the status codes.
///
/// # Safety
/// The points are valid, see [`Points`], and checked.
#[inline(never)]
pub(super) unsafe fn in_copies<T: Precision, L: Kernels<T>>(law: &L, points: &Points<T>) -> i32 {
    let few = points.modes.is_null() && points.tangent.is_null();
    let large = !few && size_of::<T>() > size_of::<f32>();
    let (mut worst, apart) = (status::OK, if large { LARGE_APART } else { APART });
    for first in (0..points.n).step_by(apart) {
        let range = first..points.n.min(first + apart);
        // SAFETY: the points are valid, those of the range are one at least and no more than there are copies.
        worst = worst.min(unsafe {
            match (range.len(), few) {
                (0..=FEW_APART, true) => copied::<T, L, FEW_APART, FEW>(law, points, range),
                (0..=FEW_APART, false) => copied::<T, L, FEW_APART, ALL>(law, points, range),
                (_, true) => copied::<T, L, APART, FEW>(law, points, range),
                (_, false) if large => copied::<T, L, LARGE_APART, ALL>(law, points, range),
                (_, false) => copied::<T, L, APART, ALL>(law, points, range),
            }
        });
    }
    worst
}

/// Copies the points of a range, at least one and at most `COUNT`, that have no modes and no tangent if `ROWS` is
/// [`FEW`], runs the law's kernels on the copies and copies the results back. Returns the worst of the status codes.
/// Not inlined, so that the stack has copies of one size alone.
///
/// # Safety
/// The points are valid, see [`Points`], and checked, and those of the range are some of them.
#[inline(never)]
unsafe fn copied<T: Precision, L: Kernels<T>, const COUNT: usize, const ROWS: usize>(
    law: &L,
    points: &Points<T>,
    range: Range<usize>,
) -> i32 {
    let needs = const { &Needs::of::<T, L>() };
    let mut memory = MaybeUninit::<Memory<T, L, COUNT, ROWS>>::uninit();
    let mut codes = [status::OK; COUNT];
    let mut apart = Apart::<T, COUNT>::new(memory.as_mut_ptr().cast(), range);
    // SAFETY: the memory has room for COUNT points of the law with all their numbers, and the indices are those of
    // points of the range.
    unsafe {
        let copies = points.read_into(&mut apart, codes.as_mut_ptr(), needs);
        let worst = law.run(&copies);
        points.take_results(&copies, &apart, needs);
        if !points.status.is_null() {
            for (code, &point) in codes.iter().zip(&apart.indices) {
                *points.status.add(point) = *code;
            }
        }
        worst
    }
}

/// Runs a kernel on copies of all points, at least one and fewer than a register `R` holds; the other lanes repeat the
/// last one. `ROWS` is the number of [`rows`] of the law. Returns the kernel's result.
///
/// # Safety
/// The points are valid, see [`Points`], and next to each other; the processor has the instructions of `R`.
#[inline(always)]
pub(super) unsafe fn padded<T: Scalar, R: Lanes<T>, const ROWS: usize>(
    points: &Points<T>,
    needs: &Needs,
    run: impl FnOnce(&Points<T>) -> i32,
) -> i32 {
    let mut memory = [const { MaybeUninit::<R>::uninit() }; ROWS];
    let mut codes = [status::OK; WIDEST];
    let mut padded = Padded::<T, R> { next: memory.as_mut_ptr().cast(), points: points.n, register: PhantomData };
    // Loops and no closures, which would be called, without the processor's instructions. SAFETY: `memory` has a
    // register for each component of a point, and the valid points are one at least and fewer than a register holds.
    unsafe {
        let copies = points.read_into(&mut padded, codes.as_mut_ptr(), needs);
        let worst = run(&copies);
        points.take_results(&copies, &padded, needs);
        if !points.status.is_null() {
            points.status.copy_from_nonoverlapping(codes.as_ptr(), points.n);
        }
        worst
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
