//! Points copied to a small block of their own, evaluated there, and their results copied back: those that do not fill a register,
//! and those that are not next to each other in memory. They go through the same operations as all others, so that the result of a
//! point does not depend on where it is.

use core::mem::MaybeUninit;
use core::ops::Range;
use core::ptr::{null, null_mut};

use super::linear::{LinearPointers, LinearStrides};
use super::pointers::{Pointers, Strides, components, components_mut};
use crate::law::number::real::{Lanes, Scalar, WIDEST};
use crate::law::state::LINEAR_ELASTIC_STATE;
use crate::law::status;

// The first components of F, fibre, energies, invariants, failure, stress, wave speed, active, limit, modes and tangent
// among those of the copies.
const F: usize = 0;
const FIBRE: usize = F + 9;
const ENERGIES: usize = FIBRE + 3;
const INVARIANTS: usize = ENERGIES + 4;
const FAILURE: usize = INVARIANTS + 4;
const STRESS: usize = FAILURE + 3;
const WAVE_SPEED: usize = STRESS + 6;
const ACTIVE: usize = WAVE_SPEED + 1;
const LIMIT: usize = ACTIVE + 1;
const MODES: usize = LIMIT + 1;
const TANGENT: usize = MODES + 24;
/// With the largest tangent, and without modes and a tangent.
const COMPONENTS: usize = TANGENT + 81;
const FEW_COMPONENTS: usize = MODES;
/// F at both ends, fibre, second axis, limit, axes, state at both ends, stress, wave speed and active of the linear elastic law.
const LINEAR_COMPONENTS: usize = 9 + 9 + 3 + 3 + 1 + 9 + 2 * LINEAR_ELASTIC_STATE + 6 + 1 + 1;

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
    /// `from` is null or an array with these components at every offset, `to` an array of COUNT points with these components.
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

    /// Copies `components` components back to the block. Lanes without a point of their own store the last point's value again.
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

/// A block of `count` points in memory for all components, with the arrays that the block `like` has.
#[inline(always)]
fn block_in<T: Scalar>(memory: *mut T, count: usize, codes: *mut i32, like: &Pointers<T>) -> Pointers<T> {
    let array = |present: bool, first: usize| if present { memory.wrapping_add(first * count) } else { null_mut() };
    let energies = array(!like.energies.is_null(), ENERGIES);
    let invariants = array(!like.invariants.is_null(), INVARIANTS);
    // The latch is read even if failure is not requested.
    let failure = array(!like.failure_old.is_null() || !like.failure.is_null(), FAILURE);
    Pointers {
        n: count,
        leading_dimension: count,
        modes_leading_dimension: count,
        tangent_leading_dimension: count,
        strides: Strides::UNIT,
        deformation_gradient: components(memory.wrapping_add(F * count), count),
        fibre: components(array(!like.fibre[0].is_null(), FIBRE), count),
        limit: array(!like.limits().is_null(), LIMIT),
        energies_old: energies,
        invariants_old: invariants,
        failure_old: failure,
        density: like.density,
        stress: components_mut(array(!like.stress[0].is_null(), STRESS), count),
        energies,
        invariants,
        failure: if like.failure.is_null() { null_mut() } else { failure },
        modes: array(!like.modes.is_null(), MODES),
        wave_speed: array(!like.wave_speed.is_null(), WAVE_SPEED),
        tangent: array(!like.tangent.is_null(), TANGENT),
        measure: like.measure,
        status: codes,
        active: array(!like.active.is_null(), ACTIVE),
        level: like.level,
    }
}

/// How many points that are not next to each other are copied at a time; in double precision with modes or a tangent,
/// which take four times the room; and to how many copies if there are no more than these: all copies are evaluated.
const APART: usize = 32;
const LARGE_APART: usize = 16;
const FEW_APART: usize = 8;

/// Runs a kernel on copies of the points of a block, part by part, and copies the results back. Returns the worst of
/// the kernel's results.
///
/// # Safety
/// The block is valid, see [`Pointers`].
pub(super) unsafe fn in_copies<T: Scalar>(block: &Pointers<T>, run: impl Fn(&Pointers<T>) -> i32) -> i32 {
    let few = block.modes.is_null() && block.tangent.is_null();
    let large = !few && size_of::<T>() > size_of::<f32>();
    let (mut worst, apart) = (status::OK, if large { LARGE_APART } else { APART });
    for first in (0..block.n).step_by(apart) {
        let points = first..block.n.min(first + apart);
        // SAFETY: the block is valid and has `points`, one at least and no more than there are copies.
        worst = worst.min(unsafe {
            match (points.len(), few) {
                (0..=FEW_APART, true) => copied::<T, FEW_APART, FEW_COMPONENTS>(block, points, &run),
                (0..=FEW_APART, false) => copied::<T, FEW_APART, COMPONENTS>(block, points, &run),
                (_, true) => copied::<T, APART, FEW_COMPONENTS>(block, points, &run),
                (_, false) if large => copied::<T, LARGE_APART, COMPONENTS>(block, points, &run),
                (_, false) => copied::<T, APART, COMPONENTS>(block, points, &run),
            }
        });
    }
    worst
}

/// Copies `points`, at least one and at most `COUNT`, of a block that has no arrays but those of the first `ROWS`
/// components, runs a kernel on the copies and copies the results back. Returns the kernel's result. Not inlined, so
/// that the stack has copies of one size alone.
///
/// # Safety
/// The block is valid, see [`Pointers`], and has these points.
#[inline(never)]
unsafe fn copied<T: Scalar, const COUNT: usize, const ROWS: usize>(
    block: &Pointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&Pointers<T>) -> i32,
) -> i32 {
    let mut memory = [[const { MaybeUninit::<T>::uninit() }; COUNT]; ROWS];
    let mut codes = [status::OK; COUNT];
    let copies = Copies::<COUNT>::new(points);
    let of_copies = block_in(memory.as_mut_ptr().cast(), COUNT, codes.as_mut_ptr(), block);
    let (energies, invariants) = (of_copies.energies, of_copies.invariants);
    let (failure, latch) = (of_copies.failure_old.cast_mut(), !block.failure_old.is_null());
    let Strides { deformation_gradient, fibre: of_fibre, limit, state, stress: of_stress, modes, tangent } =
        block.strides;
    let state = copies.group(state, block.leading_dimension);
    let single = copies.group(1, 0);
    // SAFETY: each array of `of_copies` begins in `memory` at its first component, with space for COUNT points of all its components;
    // it is there if the block has an array that takes its results; the offsets are those of points of the block. A number whose bytes
    // are all 0 is 0.
    unsafe {
        let of_f = copies.group(deformation_gradient, 0);
        for (from, to) in block.deformation_gradient.into_iter().zip(of_copies.deformation_gradient) {
            of_f.copy_in(from, to.cast_mut(), 1);
        }
        if !of_copies.fibre[0].is_null() {
            let of_fibre = copies.group(of_fibre, 0);
            for (from, to) in block.fibre.into_iter().zip(of_copies.fibre) {
                of_fibre.copy_in(from, to.cast_mut(), 1);
            }
        }
        // The stride of an array that is not read may be any number.
        let limit = if block.limits().is_null() { 1 } else { limit };
        copies.group(limit, 0).copy_in(block.limits(), of_copies.limit.cast_mut(), 1);
        let groups = [
            (block.energies_old, energies, 4),
            (block.invariants_old, invariants, 4),
            (if block.failure.is_null() { null() } else { block.failure_old }, failure, 3),
        ];
        for (from, to, components) in groups {
            if from.is_null() && !to.is_null() {
                to.write_bytes(0, components * COUNT);
            } else if !to.is_null() {
                state.copy_in(from, to, components);
            }
        }
        if block.failure.is_null() && latch {
            state.copy_in(block.failure_old.add(block.leading_dimension), failure.add(COUNT), 1);
        }
        let worst = run(&of_copies);
        if !of_copies.stress[0].is_null() {
            let of_stress = copies.group(of_stress, 0);
            for (from, to) in of_copies.stress.into_iter().zip(block.stress) {
                of_stress.copy_out(from, to, 1);
            }
        }
        state.copy_out(energies, block.energies, 4);
        state.copy_out(invariants, block.invariants, 4);
        state.copy_out(failure, block.failure, 3);
        copies.group(modes, block.modes_leading_dimension).copy_out(of_copies.modes, block.modes, 24);
        let tangent = copies.group(tangent, block.tangent_leading_dimension);
        tangent.copy_out(of_copies.tangent, block.tangent, block.measure.components());
        single.copy_out(of_copies.wave_speed, block.wave_speed, 1);
        single.copy_out(of_copies.active, block.active, 1);
        single.copy_out(codes.as_ptr(), block.status, 1);
        worst
    }
}

/// Runs a kernel on copies of all points of a block, at least one and fewer than a register `R` holds; the other lanes get points at
/// rest. Returns the kernel's result.
///
/// # Safety
/// The block is valid, see [`Pointers`], with points next to each other and its state in place; the processor has the instructions of
/// `R`.
#[inline(always)]
pub(super) unsafe fn padded<T: Scalar, R: Lanes<T>>(block: &Pointers<T>, run: impl FnOnce(&Pointers<T>) -> i32) -> i32 {
    let mut memory = [const { MaybeUninit::<R>::uninit() }; COMPONENTS];
    let mut codes = [status::OK; WIDEST];
    let copies = block_in(memory.as_mut_ptr().cast(), R::COUNT, codes.as_mut_ptr(), block);
    let (zero, one, state, count) = (R::splat(0.0), R::splat(1.0), block.leading_dimension, block.n);
    // Loops and no closures, which would be called, without the processor's instructions.
    // SAFETY: `memory` has a register for each component, at which the arrays of `copies` begin; `count` values of each component of
    // the valid block are read and written, of the arrays that are not null.
    unsafe {
        for c in 0..9 {
            let fill = if c % 4 == 0 { one } else { zero };
            R::load_first(block.deformation_gradient[c], count, fill).store(copies.deformation_gradient[c].cast_mut());
        }
        if !block.fibre[0].is_null() {
            for c in 0..3 {
                let fill = if c == 0 { one } else { zero };
                R::load_first(block.fibre[c], count, fill).store(copies.fibre[c].cast_mut());
            }
        }
        if !block.limits().is_null() {
            R::load_first(block.limits(), count, zero).store(copies.limit.cast_mut());
        }
        for (old, to) in [(block.energies, copies.energies), (block.invariants, copies.invariants)] {
            if !old.is_null() {
                for c in 0..4 {
                    R::load_first(old.add(c * state), count, zero).store(to.add(c * R::COUNT));
                }
            }
        }
        // The old flag of activity is not read, and the index only beside a new one.
        if !block.failure.is_null() {
            R::load_first(block.failure_old, count, zero).store(copies.failure);
        }
        if !block.failure_old.is_null() {
            let (latch, to) = (block.failure_old.add(state), copies.failure_old.cast_mut().add(R::COUNT));
            R::load_first(latch, count, zero).store(to);
        }
        let worst = run(&copies);
        if !block.stress[0].is_null() {
            for c in 0..6 {
                columns_out::<T, R>(copies.stress[c], block.stress[c], 0, 1, count);
            }
        }
        let arrays = [
            (copies.energies, block.energies, state, 4),
            (copies.invariants, block.invariants, state, 4),
            (copies.failure, block.failure, state, 3),
            (copies.wave_speed, block.wave_speed, 0, 1),
            (copies.active, block.active, 0, 1),
            (copies.modes, block.modes, block.modes_leading_dimension, 24),
            (copies.tangent, block.tangent, block.tangent_leading_dimension, block.measure.components()),
        ];
        for (from, to, next, columns) in arrays {
            if !to.is_null() {
                columns_out::<T, R>(from, to, next, columns, count);
            }
        }
        if !block.status.is_null() {
            block.status.copy_from_nonoverlapping(codes.as_ptr(), count);
        }
        worst
    }
}

/// Copies the first `count` lanes of `columns` registers, one after the other from `from` on, to columns that are `next` apart.
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

/// Runs a kernel of the linear elastic law on `points`, fewer than a register `R` holds; returns its result.
///
/// # Safety
/// The block is valid, see [`LinearPointers`], and has these points.
pub(super) unsafe fn padded_linear<T: Scalar, R: Lanes<T>>(
    block: &LinearPointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&LinearPointers<T>) -> i32,
) -> i32 {
    if points.is_empty() {
        return status::OK;
    }
    // SAFETY: there are fewer points than COUNT, which is the number of copies, and one at least.
    unsafe {
        match R::COUNT {
            2 => copied_linear::<T, 2>(block, points, run),
            4 => copied_linear::<T, 4>(block, points, run),
            _ => copied_linear::<T, 8>(block, points, run),
        }
    }
}

/// As [`in_copies`], for the linear elastic law without a tangent.
///
/// # Safety
/// The block is valid, see [`LinearPointers`].
pub(super) unsafe fn linear_in_copies<T: Scalar>(
    block: &LinearPointers<T>,
    run: impl Fn(&LinearPointers<T>) -> i32,
) -> i32 {
    let mut worst = status::OK;
    for first in (0..block.n).step_by(APART) {
        let points = first..block.n.min(first + APART);
        // SAFETY: the block is valid and has `points`, one at least and no more than there are copies.
        worst = worst.min(unsafe {
            match points.len() {
                0..=FEW_APART => copied_linear::<T, FEW_APART>(block, points, &run),
                _ => copied_linear::<T, APART>(block, points, &run),
            }
        });
    }
    worst
}

/// As [`copied`], for the linear elastic law without a tangent.
///
/// # Safety
/// As for [`padded_linear`].
#[inline(never)]
unsafe fn copied_linear<T: Scalar, const COUNT: usize>(
    block: &LinearPointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&LinearPointers<T>) -> i32,
) -> i32 {
    let mut memory = [[const { MaybeUninit::<T>::uninit() }; COUNT]; LINEAR_COMPONENTS];
    let mut codes = [status::OK; COUNT];
    let copies = Copies::<COUNT>::new(points);
    let mut buffer = Buffer { next: memory.as_mut_ptr().cast(), count: COUNT };
    let (f_old, f_new) = (buffer.array(true, 9), buffer.array(true, 9));
    let fibre = buffer.array(!block.fibre[0].is_null(), 3);
    let second_axis = buffer.array(!block.second_axis[0].is_null(), 3);
    let stress = buffer.array(!block.stress[0].is_null(), 6);
    let of_copies = LinearPointers {
        n: COUNT,
        leading_dimension: COUNT,
        axes_leading_dimension: COUNT,
        tangent_leading_dimension: COUNT,
        strides: LinearStrides::UNIT,
        f_old: components(f_old, COUNT),
        f_new: components(f_new, COUNT),
        fibre: components(fibre, COUNT),
        second_axis: components(second_axis, COUNT),
        limit: buffer.array(!block.limit.is_null(), 1),
        axes: buffer.array(!block.axes.is_null(), 9),
        state_old: buffer.array(!block.state_old.is_null(), LINEAR_ELASTIC_STATE),
        state_new: buffer.array(!block.state_new.is_null(), LINEAR_ELASTIC_STATE),
        density: block.density,
        stress: components_mut(stress, COUNT),
        wave_speed: buffer.array(!block.wave_speed.is_null(), 1),
        tangent: null_mut(),
        measure: block.measure,
        status: codes.as_mut_ptr(),
        active: buffer.array(!block.active.is_null(), 1),
        rotation: block.rotation,
        criterion: block.criterion,
        level: block.level,
    };
    let LinearStrides { deformation_gradient, fibre: of_fibre, limit, axes, state, stress: of_stress, .. } =
        block.strides;
    let (of_f, of_fibre) = (copies.group(deformation_gradient, 0), copies.group(of_fibre, 0));
    let (of_stress, single) = (copies.group(of_stress, 0), copies.group(1, 0));
    let of_axes = copies.group(axes, block.axes_leading_dimension);
    let of_state = copies.group(state, block.leading_dimension);
    // SAFETY: each array of `of_copies` has been taken from `memory`, with space for COUNT points of all its components; it is there if
    // the block has that array; the offsets are those of points of the block.
    unsafe {
        for c in 0..9 {
            of_f.copy_in(block.f_old[c], of_copies.f_old[c].cast_mut(), 1);
            of_f.copy_in(block.f_new[c], of_copies.f_new[c].cast_mut(), 1);
        }
        for c in 0..3 {
            of_fibre.copy_in(block.fibre[c], of_copies.fibre[c].cast_mut(), 1);
            of_fibre.copy_in(block.second_axis[c], of_copies.second_axis[c].cast_mut(), 1);
        }
        let limit = if block.limit.is_null() { 1 } else { limit };
        copies.group(limit, 0).copy_in(block.limit, of_copies.limit.cast_mut(), 1);
        of_axes.copy_in(block.axes, of_copies.axes, 9);
        of_state.copy_in(block.state_old, of_copies.state_old.cast_mut(), LINEAR_ELASTIC_STATE);
        let worst = run(&of_copies);
        of_axes.copy_out(of_copies.axes, block.axes, 9);
        of_state.copy_out(of_copies.state_new, block.state_new, LINEAR_ELASTIC_STATE);
        for (from, to) in of_copies.stress.into_iter().zip(block.stress) {
            of_stress.copy_out(from, to, 1);
        }
        single.copy_out(of_copies.wave_speed, block.wave_speed, 1);
        single.copy_out(of_copies.active, block.active, 1);
        single.copy_out(codes.as_ptr(), block.status, 1);
        worst
    }
}
