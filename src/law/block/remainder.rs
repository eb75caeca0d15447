//! The points of a block that do not fill a register. They are copied to a small block of their own that does, with the last
//! point repeated in the unused lanes, and evaluated by the same operations as all others, so that the results at a point do
//! not depend on its place in the block.

use core::marker::PhantomData;
use core::mem::MaybeUninit;
use core::ops::Range;

use super::linear::LinearPointers;
use super::pointers::{Pointers, components, components_mut};
use crate::law::number::real::{Lanes, Scalar};
use crate::law::state::LINEAR_ELASTIC_STATE;
use crate::law::status;

/// The number of lanes of the widest register for a remainder: AVX2 in single precision.
const WIDEST: usize = 8;
/// The number of components: F, fibre, energies, invariants, failure, stress, modes, wave speed and the largest tangent.
const COMPONENTS: usize = 9 + 3 + 4 + 4 + 3 + 6 + 24 + 1 + 81;
/// The number of components for the linear elastic law: F at both ends, axes, state at both ends and stress.
const LINEAR_COMPONENTS: usize = 9 + 9 + 9 + 2 * LINEAR_ELASTIC_STATE + 6;

/// Component-major arrays for the points of one register, taken one after the other from a buffer.
struct Padding<T, R> {
    /// The rest of the buffer.
    next: *mut T,
    /// The index in the block of the point in each lane.
    point: [usize; WIDEST],
    register: PhantomData<R>,
    leading_dimension: usize,
}

impl<T: Scalar, R: Lanes<T>> Padding<T, R> {
    fn new(next: *mut T, points: Range<usize>, leading_dimension: usize) -> Self {
        let mut point = [points.end - 1; WIDEST];
        for (lane, number) in point.iter_mut().zip(points.clone()) {
            *lane = number;
        }
        Padding { next, point, register: PhantomData, leading_dimension }
    }

    /// An array of `components` components; null if the block's array is.
    fn array(&mut self, of_block: *const T, components: usize) -> *mut T {
        if of_block.is_null() {
            return core::ptr::null_mut();
        }
        let array = self.next;
        self.next = array.wrapping_add(components * R::COUNT);
        array
    }

    /// Copies a component of the points from the block.
    ///
    /// # Safety
    /// `from` is a component of the block, `to` one of an [`array`](Self::array).
    #[inline(always)]
    unsafe fn copy_in(&self, from: *const T, to: *mut T) {
        for lane in 0..R::COUNT {
            // SAFETY: the caller's promise.
            unsafe { *to.add(lane) = *from.add(self.point[lane]) };
        }
    }

    /// Copies a component of the points back to the block.
    ///
    /// # Safety
    /// As for [`copy_in`](Self::copy_in), with `from` and `to` exchanged.
    #[inline(always)]
    unsafe fn copy_out<X: Copy>(&self, from: *const X, to: *mut X) {
        // The unused lanes store the value of the last point again.
        for lane in 0..R::COUNT {
            // SAFETY: the caller's promise.
            unsafe { *to.add(self.point[lane]) = *from.add(lane) };
        }
    }

    /// Copies all components of an array that is not null from the block.
    ///
    /// # Safety
    /// As for [`copy_in`](Self::copy_in), for `components` components of both.
    #[inline(always)]
    unsafe fn copy_all_in(&self, from: *const T, to: *mut T, components: usize) {
        if !from.is_null() {
            for c in 0..components {
                // SAFETY: the caller's promise.
                unsafe { self.copy_in(from.add(c * self.leading_dimension), to.add(c * R::COUNT)) };
            }
        }
    }

    /// Copies all components of an array that is not null back to the block.
    ///
    /// # Safety
    /// As for [`copy_out`](Self::copy_out), for `components` components of both.
    #[inline(always)]
    unsafe fn copy_all_out(&self, from: *const T, to: *mut T, components: usize) {
        if !to.is_null() {
            for c in 0..components {
                // SAFETY: the caller's promise.
                unsafe { self.copy_out(from.add(c * R::COUNT), to.add(c * self.leading_dimension)) };
            }
        }
    }
}

/// Runs a kernel on `points`, fewer than `R` holds, of a block whose state is in place. Returns the kernel's result.
///
/// # Safety
/// As for [`Hyperelastic::raw_block`](crate::law::hyperelastic::Hyperelastic::raw_block), for these points of the block;
/// `R` holds at most [`WIDEST`] points.
pub(super) unsafe fn padded<T: Scalar, R: Lanes<T>>(
    block: &Pointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&Pointers<T>) -> i32,
) -> i32 {
    if points.is_empty() {
        return status::OK;
    }
    let mut room = [MaybeUninit::<T>::uninit(); COMPONENTS * WIDEST];
    let mut codes = [status::OK; WIDEST];
    let count = R::COUNT;
    let next = room.as_mut_ptr().cast::<T>();
    let mut padding = Padding::<T, R>::new(next, points, block.leading_dimension);
    let f = padding.array(block.deformation_gradient[0], 9);
    let fibre = padding.array(block.fibre[0], 3);
    let energies = padding.array(block.energies, 4);
    let invariants = padding.array(block.invariants, 4);
    // The latch is read even if failure is not requested.
    let failure = padding.array(if block.failure.is_null() { block.failure_old } else { block.failure }, 3);
    let stress = padding.array(block.stress[0], 6);
    let of_register = Pointers {
        n: count,
        leading_dimension: count,
        deformation_gradient: components(f, count),
        fibre: components(fibre, count),
        energies_old: energies,
        invariants_old: invariants,
        failure_old: if block.failure_old.is_null() { core::ptr::null() } else { failure },
        density: block.density,
        stress: components_mut(stress, count),
        energies,
        invariants,
        failure: if block.failure.is_null() { core::ptr::null_mut() } else { failure },
        modes: padding.array(block.modes, 24),
        wave_speed: padding.array(block.wave_speed, 1),
        tangent: padding.array(block.tangent, block.measure.components()),
        measure: block.measure,
        status: codes.as_mut_ptr(),
        level: block.level,
    };
    // SAFETY: the arrays here have room for the components of a register, those of the block are the caller's promise.
    unsafe {
        for (from, to) in block.deformation_gradient.into_iter().zip(of_register.deformation_gradient) {
            padding.copy_in(from, to.cast_mut());
        }
        if !fibre.is_null() {
            for (from, to) in block.fibre.into_iter().zip(of_register.fibre) {
                padding.copy_in(from, to.cast_mut());
            }
        }
        padding.copy_all_in(block.energies, energies, 4);
        padding.copy_all_in(block.invariants, invariants, 4);
        padding.copy_all_in(block.failure, failure, 3);
        if block.failure.is_null() && !block.failure_old.is_null() {
            padding.copy_in(block.failure_old.add(block.leading_dimension), failure.add(count));
        }
        let worst = run(&of_register);
        if !stress.is_null() {
            for (from, to) in of_register.stress.into_iter().zip(block.stress) {
                padding.copy_out(from, to);
            }
        }
        padding.copy_all_out(energies, block.energies, 4);
        padding.copy_all_out(invariants, block.invariants, 4);
        padding.copy_all_out(failure, block.failure, 3);
        padding.copy_all_out(of_register.modes, block.modes, 24);
        padding.copy_all_out(of_register.wave_speed, block.wave_speed, 1);
        padding.copy_all_out(of_register.tangent, block.tangent, block.measure.components());
        if !block.status.is_null() {
            padding.copy_out(codes.as_ptr(), block.status);
        }
        worst
    }
}

/// As [`padded`], for the linear elastic law, whose old state may be in another array than the new one.
///
/// # Safety
/// As for [`LinearElastic::raw_block`](crate::law::linear_elastic::LinearElastic::raw_block), for these points of the block;
/// `R` holds at most [`WIDEST`] points.
pub(super) unsafe fn padded_linear<T: Scalar, R: Lanes<T>>(
    block: &LinearPointers<T>,
    points: Range<usize>,
    run: impl FnOnce(&LinearPointers<T>) -> i32,
) -> i32 {
    if points.is_empty() {
        return status::OK;
    }
    let mut room = [MaybeUninit::<T>::uninit(); LINEAR_COMPONENTS * WIDEST];
    let mut codes = [status::OK; WIDEST];
    let count = R::COUNT;
    let next = room.as_mut_ptr().cast::<T>();
    let mut padding = Padding::<T, R>::new(next, points, block.leading_dimension);
    let of_register = LinearPointers {
        n: count,
        leading_dimension: count,
        f_old: padding.array(block.f_old, 9),
        f_new: padding.array(block.f_new, 9),
        axes: padding.array(block.axes, 9),
        state_old: padding.array(block.state_old, LINEAR_ELASTIC_STATE),
        state_new: padding.array(block.state_new, LINEAR_ELASTIC_STATE),
        stress: padding.array(block.stress, 6),
        status: codes.as_mut_ptr(),
        ..*block
    };
    // SAFETY: the arrays here have room for the components of a register, those of the block are the caller's promise.
    unsafe {
        padding.copy_all_in(block.f_old, of_register.f_old.cast_mut(), 9);
        padding.copy_all_in(block.f_new, of_register.f_new.cast_mut(), 9);
        padding.copy_all_in(block.axes, of_register.axes, 9);
        padding.copy_all_in(block.state_old, of_register.state_old.cast_mut(), LINEAR_ELASTIC_STATE);
        let worst = run(&of_register);
        padding.copy_all_out(of_register.axes, block.axes, 9);
        padding.copy_all_out(of_register.state_new, block.state_new, LINEAR_ELASTIC_STATE);
        padding.copy_all_out(of_register.stress, block.stress, 6);
        if !block.status.is_null() {
            padding.copy_out(codes.as_ptr(), block.status);
        }
        worst
    }
}
