//! Points copied to a small block of their own, evaluated there, and their results copied back: those that do not fill a register,
//! and those that are not next to each other in memory. They go through the same operations as all others, so that the result of a
//! point does not depend on where it is.

use core::mem::MaybeUninit;
use core::ops::Range;
use core::ptr::{null, null_mut};

use super::linear::{LinearPointers, LinearStrides};
use super::pointers::{Pointers, Strides, components, components_mut};
use crate::law::number::real::{Lanes, Scalar};
use crate::law::state::LINEAR_ELASTIC_STATE;
use crate::law::status;

/// F, fibre, energies, invariants, failure, stress, modes, wave speed, active and the largest tangent.
const COMPONENTS: usize = 9 + 3 + 4 + 4 + 3 + 6 + 24 + 1 + 1 + 81;
/// F at both ends, fibre, second axis, axes, state at both ends, stress, wave speed and active of the linear elastic law.
const LINEAR_COMPONENTS: usize = 9 + 9 + 3 + 3 + 9 + 2 * LINEAR_ELASTIC_STATE + 6 + 1 + 1;

/// Component-major arrays of `COUNT` points, taken one after the other from a buffer.
struct Copies<T, const COUNT: usize> {
    /// The rest of the buffer.
    next: *mut T,
    /// The index of each point in the block; the last ones repeat if there are fewer points.
    points: [usize; COUNT],
}

/// Where the points are in a group of arrays: the offset of each, and the distance between components.
#[derive(Clone, Copy)]
struct Group<const COUNT: usize> {
    offsets: [usize; COUNT],
    leading_dimension: usize,
}

impl<T: Scalar, const COUNT: usize> Copies<T, COUNT> {
    fn new(next: *mut T, points: Range<usize>) -> Self {
        let mut indices = [points.end - 1; COUNT];
        for (index, point) in indices.iter_mut().zip(points) {
            *index = point;
        }
        Copies { next, points: indices }
    }

    /// An array of `components` components; null if the block has none.
    fn array(&mut self, present: bool, components: usize) -> *mut T {
        if !present {
            return null_mut();
        }
        let array = self.next;
        self.next = array.wrapping_add(components * COUNT);
        array
    }

    #[inline(always)]
    fn group(&self, stride: usize, leading_dimension: usize) -> Group<COUNT> {
        Group { offsets: self.points.map(|point| point * stride), leading_dimension }
    }
}

impl<const COUNT: usize> Group<COUNT> {
    /// Copies `components` components from the block; nothing if it has none.
    ///
    /// # Safety
    /// `from` is null or an array of the block with these components, `to` one of [`Copies::array`].
    #[inline(always)]
    unsafe fn copy_in<T: Copy>(&self, from: *const T, to: *mut T, components: usize) {
        if from.is_null() {
            return;
        }
        for c in 0..components {
            for (lane, &offset) in self.offsets.iter().enumerate() {
                // SAFETY: the caller's promise.
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
                // SAFETY: the caller's promise.
                unsafe { *to.add(c * self.leading_dimension + offset) = *from.add(c * COUNT + lane) };
            }
        }
    }
}

/// Runs a kernel on `points`, fewer than a register `R` holds; returns its result.
///
/// # Safety
/// As for [`copied`].
pub(super) unsafe fn padded<T: Scalar, R: Lanes<T>>(
    block: &Pointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&Pointers<T>) -> i32,
) -> i32 {
    if points.is_empty() {
        return status::OK;
    }
    // SAFETY: the caller's promise.
    unsafe {
        match R::COUNT {
            2 => copied::<T, 2>(block, points, run),
            4 => copied::<T, 4>(block, points, run),
            _ => copied::<T, 8>(block, points, run),
        }
    }
}

/// Copies `points`, at least one and at most `COUNT`, of a block, runs a kernel on the copies and copies the results back.
/// Returns the kernel's result.
///
/// # Safety
/// As for [`raw_block`](crate::law::hyperelastic::Hyperelastic::raw_block), for these points of the block.
pub(super) unsafe fn copied<T: Scalar, const COUNT: usize>(
    block: &Pointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&Pointers<T>) -> i32,
) -> i32 {
    let mut room = [[const { MaybeUninit::<T>::uninit() }; COUNT]; COMPONENTS];
    let mut codes = [status::OK; COUNT];
    let mut copies = Copies::<T, COUNT>::new(room.as_mut_ptr().cast(), points);
    let f = copies.array(true, 9);
    let fibre = copies.array(!block.fibre[0].is_null(), 3);
    let energies = copies.array(!block.energies.is_null(), 4);
    let invariants = copies.array(!block.invariants.is_null(), 4);
    // The latch is read even if failure is not requested.
    let latch = !block.failure_old.is_null();
    let failure = copies.array(latch || !block.failure.is_null(), 3);
    let stress = copies.array(!block.stress[0].is_null(), 6);
    let of_copies = Pointers {
        n: COUNT,
        leading_dimension: COUNT,
        modes_leading_dimension: COUNT,
        tangent_leading_dimension: COUNT,
        strides: Strides::UNIT,
        deformation_gradient: components(f, COUNT),
        fibre: components(fibre, COUNT),
        energies_old: energies,
        invariants_old: invariants,
        failure_old: failure,
        density: block.density,
        stress: components_mut(stress, COUNT),
        energies,
        invariants,
        failure: if block.failure.is_null() { null_mut() } else { failure },
        modes: copies.array(!block.modes.is_null(), 24),
        wave_speed: copies.array(!block.wave_speed.is_null(), 1),
        tangent: copies.array(!block.tangent.is_null(), block.measure.components()),
        measure: block.measure,
        status: codes.as_mut_ptr(),
        active: copies.array(!block.active.is_null(), 1),
        level: block.level,
    };
    let Strides { deformation_gradient, fibre: of_fibre, state, stress: of_stress, modes, tangent } = block.strides;
    let state = copies.group(state, block.leading_dimension);
    let single = copies.group(1, 0);
    // SAFETY: the arrays here have room for COUNT points, those of the block are the caller's promise. A number whose bytes are all 0
    // is 0.
    unsafe {
        let of_f = copies.group(deformation_gradient, 0);
        for (from, to) in block.deformation_gradient.into_iter().zip(of_copies.deformation_gradient) {
            of_f.copy_in(from, to.cast_mut(), 1);
        }
        if !fibre.is_null() {
            let of_fibre = copies.group(of_fibre, 0);
            for (from, to) in block.fibre.into_iter().zip(of_copies.fibre) {
                of_fibre.copy_in(from, to.cast_mut(), 1);
            }
        }
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
        if !stress.is_null() {
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

/// As [`padded`], for the linear elastic law, whose old state may be in another array than the new one.
///
/// # Safety
/// As for [`LinearElastic::raw_block`](crate::law::linear_elastic::LinearElastic::raw_block), for these points of the block.
pub(super) unsafe fn padded_linear<T: Scalar, R: Lanes<T>>(
    block: &LinearPointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&LinearPointers<T>) -> i32,
) -> i32 {
    if points.is_empty() {
        return status::OK;
    }
    // SAFETY: the caller's promise.
    unsafe {
        match R::COUNT {
            2 => copied_linear::<T, 2>(block, points, run),
            4 => copied_linear::<T, 4>(block, points, run),
            _ => copied_linear::<T, 8>(block, points, run),
        }
    }
}

/// As [`copied`], for the linear elastic law without a tangent.
///
/// # Safety
/// As for [`padded_linear`].
pub(super) unsafe fn copied_linear<T: Scalar, const COUNT: usize>(
    block: &LinearPointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&LinearPointers<T>) -> i32,
) -> i32 {
    let mut room = [[const { MaybeUninit::<T>::uninit() }; COUNT]; LINEAR_COMPONENTS];
    let mut codes = [status::OK; COUNT];
    let mut copies = Copies::<T, COUNT>::new(room.as_mut_ptr().cast(), points);
    let (f_old, f_new) = (copies.array(true, 9), copies.array(true, 9));
    let fibre = copies.array(!block.fibre[0].is_null(), 3);
    let second_axis = copies.array(!block.second_axis[0].is_null(), 3);
    let stress = copies.array(!block.stress[0].is_null(), 6);
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
        axes: copies.array(!block.axes.is_null(), 9),
        state_old: copies.array(!block.state_old.is_null(), LINEAR_ELASTIC_STATE),
        state_new: copies.array(!block.state_new.is_null(), LINEAR_ELASTIC_STATE),
        density: block.density,
        stress: components_mut(stress, COUNT),
        wave_speed: copies.array(!block.wave_speed.is_null(), 1),
        tangent: null_mut(),
        measure: block.measure,
        status: codes.as_mut_ptr(),
        active: copies.array(!block.active.is_null(), 1),
        rotation: block.rotation,
        criterion: block.criterion,
        level: block.level,
    };
    let LinearStrides { deformation_gradient, fibre: of_fibre, axes, state, stress: of_stress, .. } = block.strides;
    let (of_f, of_fibre) = (copies.group(deformation_gradient, 0), copies.group(of_fibre, 0));
    let (of_stress, single) = (copies.group(of_stress, 0), copies.group(1, 0));
    let of_axes = copies.group(axes, block.axes_leading_dimension);
    let of_state = copies.group(state, block.leading_dimension);
    // SAFETY: the arrays here have room for COUNT points, those of the block are the caller's promise.
    unsafe {
        for c in 0..9 {
            of_f.copy_in(block.f_old[c], of_copies.f_old[c].cast_mut(), 1);
            of_f.copy_in(block.f_new[c], of_copies.f_new[c].cast_mut(), 1);
        }
        for c in 0..3 {
            of_fibre.copy_in(block.fibre[c], of_copies.fibre[c].cast_mut(), 1);
            of_fibre.copy_in(block.second_axis[c], of_copies.second_axis[c].cast_mut(), 1);
        }
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
