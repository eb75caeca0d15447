//! Blocks of a few points whose law comes with the call, as its properties or prepared: the points are evaluated one by one, which
//! takes less time than preparing the law for lanes and filling a register.

use super::interface::Law;
use super::pointers::Pointers;
use crate::law::derivative::{Derivative, NoTangent, Stress};
use crate::law::error::Error;
use crate::law::number::real::Scalar;
use crate::law::number::registers::Registers;
use crate::law::point::{self, Point, Sink, Source, cells};
use crate::law::response::Request;
use crate::law::state::{self, HYPERELASTIC_STATE};
use crate::law::status;
use crate::law::wave_speed;

/// Blocks of up to this number of points are evaluated one by one.
pub(super) const FEW: usize = 1;

/// Evaluates the law at every point of a block, one by one, by the same operations as in lanes: the
/// results at a point do not depend on how many points there are. Returns the worst status.
///
/// # Errors
/// The first property that is wrong; nothing is written.
///
/// # Safety
/// As for [`raw_block`](crate::law::hyperelastic::Hyperelastic::raw_block), on a processor with AVX2 and FMA, for a block without a
/// tangent.
#[target_feature(enable = "avx2,fma")]
pub(super) unsafe fn one_by_one<T: Registers>(
    law: Law<'_, T>,
    block: &Pointers<T>,
    request: Request,
) -> Result<i32, Error> {
    // SAFETY: the caller's promise.
    unsafe {
        match (law, request) {
            (Law::Properties(properties), Request::STRESS_AND_STATE) => {
                evaluate_each(properties, block, Stress::<true>)
            }
            (Law::Properties(properties), _) => evaluate_each(properties, block, NoTangent(request)),
            (Law::Prepared(law), Request::STRESS_AND_STATE) => evaluate_each(law, block, Stress::<true>),
            (Law::Prepared(law), _) => evaluate_each(law, block, NoTangent(request)),
        }
    }
}

/// # Errors
/// As for [`one_by_one`].
///
/// # Safety
/// As for [`one_by_one`].
#[inline(always)]
unsafe fn evaluate_each<T: Registers, L: Source<T>, D: Derivative<0>>(
    law: L,
    block: &Pointers<T>,
    request: D,
) -> Result<i32, Error> {
    let mut worst = status::OK;
    for i in 0..block.n {
        // SAFETY: the caller's promise.
        let (f, fibre, state) = unsafe { (block.columns(i), block.direction(i), cells(block.old_state(i))) };
        let mut code = status::OK;
        let sink = OnePoint { block, i, code: &mut code };
        point::evaluate::<T, T::One, _, _, _, 0>(law, &f, fibre, &state, request, sink)?;
        worst = worst.min(code);
    }
    Ok(worst)
}

impl<T: Scalar> Pointers<T> {
    /// The columns of F at a point.
    ///
    /// # Safety
    /// As for [`raw_block`](crate::law::hyperelastic::Hyperelastic::raw_block), with i < n.
    #[inline(always)]
    unsafe fn columns(&self, i: usize) -> [[T; 3]; 3] {
        // SAFETY: the caller's promise.
        let entry = |c: usize| unsafe { *self.deformation_gradient[c].add(i) };
        [[entry(0), entry(1), entry(2)], [entry(3), entry(4), entry(5)], [entry(6), entry(7), entry(8)]]
    }

    /// The fibre direction of a point; `None` for that of the properties.
    ///
    /// # Safety
    /// As for [`raw_block`](crate::law::hyperelastic::Hyperelastic::raw_block), with i < n.
    #[inline(always)]
    unsafe fn direction(&self, i: usize) -> Option<[T; 3]> {
        let [m_1, m_2, m_3] = self.fibre;
        // SAFETY: the caller's promise.
        if m_1.is_null() { None } else { Some(unsafe { [*m_1.add(i), *m_2.add(i), *m_3.add(i)] }) }
    }

    /// The old state of a point, with 0 for what is not requested or not in the block. The latch is read even if failure is not
    /// requested.
    ///
    /// # Safety
    /// As for [`raw_block`](crate::law::hyperelastic::Hyperelastic::raw_block), with i < n.
    #[inline(always)]
    unsafe fn old_state(&self, i: usize) -> [T; HYPERELASTIC_STATE] {
        let mut state = [T::splat(0.0); HYPERELASTIC_STATE];
        // SAFETY: the caller's promise.
        let old = |array: *const T, c: usize| unsafe { *array.add(c * self.leading_dimension + i) };
        if !self.energies.is_null() && !self.energies_old.is_null() {
            for (c, value) in state.iter_mut().skip(state::ENERGIES).take(4).enumerate() {
                *value = old(self.energies_old, c);
            }
        }
        if !self.invariants.is_null() && !self.invariants_old.is_null() {
            for (c, value) in state.iter_mut().skip(state::INVARIANTS).take(4).enumerate() {
                *value = old(self.invariants_old, c);
            }
        }
        if !self.failure.is_null() && !self.failure_old.is_null() {
            state[state::FAILURE_INDEX] = old(self.failure_old, 0);
        }
        if !self.failure_old.is_null() {
            state[state::FAILED] = old(self.failure_old, 1);
        }
        state
    }
}

/// The sink for one point of a block.
struct OnePoint<'a, T> {
    block: &'a Pointers<T>,
    i: usize,
    code: &'a mut i32,
}

impl<T: Scalar> OnePoint<'_, T> {
    #[inline(always)]
    fn put(self, point: &Point<T>) {
        let OnePoint { block, i, code } = self;
        *code = point.status;
        // SAFETY: `evaluate_each` makes this for a block that can be evaluated, with i < n.
        let store = |values: &[T], array: *mut T, leading_dimension: usize| unsafe {
            if !array.is_null() {
                for (c, &value) in values.iter().enumerate() {
                    *array.add(c * leading_dimension + i) = value;
                }
            }
        };
        let [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, index, failed, alive] = point.state;
        store(&[w_el, w_tc, w_td, w_ld], block.energies, block.leading_dimension);
        store(&[i_el, i_tc, i_td, i_ld], block.invariants, block.leading_dimension);
        store(&[index, failed, alive], block.failure, block.leading_dimension);
        store(point.modes.as_flattened(), block.modes, block.modes_leading_dimension);
        // SAFETY: as above.
        unsafe {
            if !block.stress[0].is_null() {
                for (column, value) in block.stress.into_iter().zip(point.stress) {
                    *column.add(i) = value;
                }
            }
            if !block.wave_speed.is_null() {
                *block.wave_speed.add(i) = wave_speed::wave_speed(point.wave_modulus, block.density);
            }
            if !block.status.is_null() {
                *block.status.add(i) = point.status;
            }
            if !block.active.is_null() {
                *block.active.add(i) = if point.status == status::OK { alive } else { T::splat(0.0) };
            }
        }
    }
}

impl<T: Scalar> Sink<T, 0> for OnePoint<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, _: [T; 0]) {
        self.put(&point);
    }
}
