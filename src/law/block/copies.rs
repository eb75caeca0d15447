//! Points copied to a small block of their own, evaluated there, and their results copied back: those that do not fill
//! a register, and those that are not next to each other in memory. They go through the same operations as all others,
//! so that the result of a point does not depend on where it is.

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

/// The index in the block of each of `COUNT` copies; the last ones repeat if there are fewer points.
struct Copies<const COUNT: usize>([usize; COUNT]);

/// Where the points are in a group of arrays: the offset of each, and the distance between components.
#[derive(Clone, Copy)]
struct Group<const COUNT: usize> {
    offsets: [usize; COUNT],
    leading_dimension: usize,
}

impl<const COUNT: usize> Copies<COUNT> {
    fn new(points: Range<usize>) -> Self {
        let mut indices = [points.end - 1; COUNT];
        for (index, point) in indices.iter_mut().zip(points) {
            *index = point;
        }
        Copies(indices)
    }

    #[inline(always)]
    fn group(&self, stride: usize, leading_dimension: usize) -> Group<COUNT> {
        Group { offsets: self.0.map(|point| point * stride), leading_dimension }
    }
}

impl<const COUNT: usize> Group<COUNT> {
    /// Copies `components` components from the block; nothing if it has none.
    ///
    /// # Safety
    /// `from` is null or an array with these components at every offset, `to` an array of COUNT points with these
    /// components.
    #[inline(always)]
    unsafe fn copy_in<T: Copy>(&self, from: *const T, to: *mut T, components: usize) {
        if from.is_null() {
            return;
        }
        for c in 0..components {
            for (lane, &offset) in self.offsets.iter().enumerate() {
                // SAFETY: c < `components` and lane < COUNT by the loops.
                unsafe { *to.add(c * COUNT + lane) = *from.add(c * self.leading_dimension + offset) };
            }
        }
    }

    /// Copies arrays that each have a pointer; nothing if they are null.
    ///
    /// # Safety
    /// As for [`copy_in`](Self::copy_in), for each of them.
    #[inline(always)]
    unsafe fn all_in<T: Copy, const N: usize>(&self, from: &[*const T; N], to: &[*const T; N]) {
        for (&from, to) in from.iter().zip(to) {
            // SAFETY: as the caller promises; there are copies of arrays that the points have.
            unsafe { self.copy_in(from, to.cast_mut(), 1) };
        }
    }

    /// Copies `components` components back to the block. Lanes without a point of their own store the last point's
    /// value again.
    ///
    /// # Safety
    /// As for [`copy_in`](Self::copy_in), in the other direction.
    #[inline(always)]
    unsafe fn copy_out<T: Copy>(&self, from: *const T, to: *mut T, components: usize) {
        if to.is_null() {
            return;
        }
        for c in 0..components {
            for (lane, &offset) in self.offsets.iter().enumerate() {
                // SAFETY: c < `components` and lane < COUNT by the loops.
                unsafe { *to.add(c * self.leading_dimension + offset) = *from.add(c * COUNT + lane) };
            }
        }
    }
}

/// Component-major arrays of `count` points, taken one after the other from a buffer.
struct Buffer<T> {
    next: *mut T,
    count: usize,
}

impl<T: Scalar> Buffer<T> {
    /// An array of `components` components; null if the block has none.
    #[inline(always)]
    fn array(&mut self, present: bool, components: usize) -> *mut T {
        if !present {
            return null_mut();
        }
        let array = self.next;
        self.next = array.wrapping_add(components * self.count);
        array
    }
}

impl<T: Scalar> Points<T> {
    /// `count` points in memory for the arrays that these points have, the old state in the place of the new one.
    #[inline(always)]
    fn in_memory(&self, memory: *mut T, count: usize, codes: *mut i32, needs: &Needs) -> Points<T> {
        let mut buffer = Buffer { next: memory, count };
        let f_old = buffer.array(needs.reads.old_gradient, 9);
        let f_new = buffer.array(true, 9);
        let fibre = buffer.array(!self.fibre[0].is_null(), 3);
        let second_axis = buffer.array(!self.second_axis[0].is_null(), 3);
        let stress = buffer.array(!self.stress[0].is_null(), 6);
        let (mut state_old, mut state_new, mut part) = ([null(); PARTS], [null_mut(); PARTS], 0);
        while part < PARTS {
            let (new, latch) = (!self.state_new[part].is_null(), part == needs.last && !self.state_old[part].is_null());
            let array = buffer.array(new || latch, needs.parts[part]);
            state_old[part] = array.cast_const();
            state_new[part] = if new { array } else { null_mut() };
            part += 1;
        }
        Points {
            n: count,
            leading_dimension: count,
            modes_leading_dimension: count,
            axes_leading_dimension: count,
            tangent_leading_dimension: count,
            strides: Strides::UNIT,
            f_old: components(f_old, count),
            f_new: components(f_new, count),
            fibre: components(fibre, count),
            second_axis: components(second_axis, count),
            limit: buffer.array(!self.limits(needs.last).is_null(), 1),
            circumstances: Circumstances {
                temperature: buffer.array(needs.reads.temperature, 1),
                ..self.circumstances
            },
            axes: buffer.array(!self.axes.is_null(), 9),
            state_old,
            state_new,
            stress: components_mut(stress, count),
            wave_speed: buffer.array(!self.wave_speed.is_null(), 1),
            active: buffer.array(!self.active.is_null(), 1),
            modes: buffer.array(!self.modes.is_null(), 24),
            tangent: buffer.array(!self.tangent.is_null(), self.measure.components()),
            status: codes,
            ..*self
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
    let copies = Copies::<COUNT>::new(range);
    let of_copies = points.in_memory(memory.as_mut_ptr().cast(), COUNT, codes.as_mut_ptr(), needs);
    let Strides { deformation_gradient, fibre, limit, axes, state, stress, modes, tangent } = points.strides;
    let state = copies.group(state, points.leading_dimension);
    let axes = copies.group(axes, points.axes_leading_dimension);
    // SAFETY: each array of `of_copies` has been taken from `memory`, with space for COUNT points of all its
    // components; it is there if the points have that array; the offsets are those of points of the range. A number
    // whose bytes are all 0 is 0.
    unsafe {
        let of_f = copies.group(deformation_gradient, 0);
        if needs.reads.old_gradient {
            of_f.all_in(&points.f_old, &of_copies.f_old);
        }
        of_f.all_in(&points.f_new, &of_copies.f_new);
        copies.group(fibre, 0).all_in(&points.fibre, &of_copies.fibre);
        copies.group(fibre, 0).all_in(&points.second_axis, &of_copies.second_axis);
        if needs.reads.temperature {
            let from = points.circumstances.temperature;
            copies.group(1, 0).copy_in(from, of_copies.circumstances.temperature.cast_mut(), 1);
        }
        if !of_copies.limit.is_null() {
            copies.group(limit, 0).copy_in(points.limit, of_copies.limit.cast_mut(), 1);
        }
        axes.copy_in(points.axes, of_copies.axes, 9);
        for part in 0..PARTS {
            let (from, to) = (points.state_old[part], of_copies.state_old[part].cast_mut());
            let components = needs.parts[part];
            match (to.is_null(), from.is_null()) {
                (true, _) => {}
                (false, true) => to.write_bytes(0, components * COUNT),
                (false, false) => state.copy_in(from, to, needs.read(part, components)),
            }
        }
        let worst = law.run(&of_copies);
        for (from, to) in of_copies.stress.into_iter().zip(points.stress) {
            copies.group(stress, 0).copy_out(from, to, 1);
        }
        for part in 0..PARTS {
            state.copy_out(of_copies.state_new[part], points.state_new[part], needs.parts[part]);
        }
        axes.copy_out(of_copies.axes, points.axes, 9);
        copies.group(modes, points.modes_leading_dimension).copy_out(of_copies.modes, points.modes, 24);
        let tangent = copies.group(tangent, points.tangent_leading_dimension);
        tangent.copy_out(of_copies.tangent, points.tangent, points.measure.components());
        let single = copies.group(1, 0);
        single.copy_out(of_copies.wave_speed, points.wave_speed, 1);
        single.copy_out(of_copies.active, points.active, 1);
        single.copy_out(codes.as_ptr(), points.status, 1);
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
    let copies = points.in_memory(memory.as_mut_ptr().cast(), R::COUNT, codes.as_mut_ptr(), needs);
    let (state, count) = (points.leading_dimension, points.n);
    // Loops and no closures, which would be called, without the processor's instructions. SAFETY: `memory` has a
    // register for each component, at which the arrays of `copies` begin; `count` values of each component of the valid
    // points are read and written, of the arrays that are not null.
    unsafe {
        if needs.reads.old_gradient {
            columns_in::<T, R, 9>(&points.f_old, &copies.f_old, count);
        }
        columns_in::<T, R, 9>(&points.f_new, &copies.f_new, count);
        columns_in::<T, R, 3>(&points.fibre, &copies.fibre, count);
        columns_in::<T, R, 3>(&points.second_axis, &copies.second_axis, count);
        if needs.reads.temperature {
            let from = points.circumstances.temperature;
            filled::<T, R>(from, count).store(copies.circumstances.temperature.cast_mut());
        }
        if !copies.limit.is_null() {
            filled::<T, R>(points.limit, count).store(copies.limit.cast_mut());
        }
        if !points.axes.is_null() {
            columns_in::<T, R, 9>(
                &components(points.axes, points.axes_leading_dimension),
                &components(copies.axes, R::COUNT),
                count,
            );
        }
        let mut part = 0;
        while part < PARTS {
            let (old, to) = (points.state_old[part], copies.state_old[part].cast_mut());
            if !to.is_null() {
                for c in 0..needs.read(part, needs.parts[part]) {
                    let value = match old.is_null() {
                        true => R::splat(0.0),
                        false => filled::<T, R>(old.add(c * state), count),
                    };
                    value.store(to.add(c * R::COUNT));
                }
            }
            part += 1;
        }
        let worst = run(&copies);
        if !points.stress[0].is_null() {
            for c in 0..6 {
                columns_out::<T, R>(copies.stress[c], points.stress[c], 0, 1, count);
            }
        }
        let mut part = 0;
        while part < PARTS {
            let (from, to) = (copies.state_new[part], points.state_new[part]);
            if !to.is_null() {
                columns_out::<T, R>(from, to, state, needs.parts[part], count);
            }
            part += 1;
        }
        let arrays = [
            (copies.axes, points.axes, points.axes_leading_dimension, 9),
            (copies.wave_speed, points.wave_speed, 0, 1),
            (copies.active, points.active, 0, 1),
            (copies.modes, points.modes, points.modes_leading_dimension, 24),
            (copies.tangent, points.tangent, points.tangent_leading_dimension, points.measure.components()),
        ];
        for (from, to, next, columns) in arrays {
            if !to.is_null() {
                columns_out::<T, R>(from, to, next, columns, count);
            }
        }
        if !points.status.is_null() {
            points.status.copy_from_nonoverlapping(codes.as_ptr(), count);
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

/// Copies `count` values of the columns of a matrix or a vector to registers; nothing if there is no such array.
///
/// # Safety
/// The columns are null, or have `count` values each, one at least and fewer than COUNT, and a register of their own to
/// go to.
#[inline(always)]
unsafe fn columns_in<T: Scalar, R: Lanes<T>, const N: usize>(from: &[*const T; N], to: &[*const T; N], count: usize) {
    if from[0].is_null() {
        return;
    }
    for c in 0..N {
        // SAFETY: as the caller promises.
        unsafe { filled::<T, R>(from[c], count).store(to[c].cast_mut()) };
    }
}

/// Copies the first `count` lanes of `columns` registers, one after the other from `from` on, to columns that are
/// `next` apart.
///
/// # Safety
/// There are as many registers, and each column has space for `count` values, fewer than COUNT.
#[inline(always)]
unsafe fn columns_out<T, R: Lanes<T>>(from: *const T, to: *mut T, next: usize, columns: usize, count: usize) {
    // The binary digits of the count: a loop over so few values would be compiled to a call.
    let mut lane = 0;
    for digit in [4, 2, 1] {
        if digit < R::COUNT && count & digit != 0 {
            for c in 0..columns {
                // SAFETY: the digits add up to `count`, so that lane + digit ≤ count; c < `columns`.
                unsafe { to.add(c * next + lane).copy_from_nonoverlapping(from.add(c * R::COUNT + lane), digit) };
            }
            lane += digit;
        }
    }
}
