//! The kernel of the linear elastic law at many points at once.

use core::ops::Range;

use super::kernel::least_code;
use super::points::Points;
use crate::law::linear_elastic::{Answer, LinearElastic, Rotation, Step, Wanted};
use crate::law::linear_tangent::by_rows;
use crate::law::number::real::{Lanes, Scalar};
use crate::law::number::vector::Matrix;
use crate::law::state::{LINEAR_ALIVE, LINEAR_ELASTIC_STATE, LINEAR_FAILED};
use crate::law::status;
use crate::law::wave_speed;

/// The kernel, for points that fill whole registers. Returns the worst status code.
///
/// # Safety
/// The block is valid, see [`Points`], and its points are next to each other; `points` are points of it, their number a
/// multiple of COUNT; the processor has the lanes' instructions.
#[inline(always)]
pub(super) unsafe fn sweep_linear<T: Scalar, R: Lanes<T>>(
    law: &LinearElastic<T>,
    block: &Points<T>,
    points: Range<usize>,
) -> i32 {
    let lanes = law.lanes::<R>();
    let mut worst = R::splat(0.0);
    let mut i = points.start;
    while i < points.end {
        // SAFETY: `points` has a multiple of COUNT points, so that i + COUNT ≤ its end ≤ n.
        worst = worst.min(unsafe { evaluate_register(&lanes, block, i) });
        i += R::COUNT;
    }
    least_code(worst)
}

/// Evaluates the points of one register from `i` on. Returns their status codes.
///
/// # Safety
/// As for [`sweep_linear`], with i + COUNT ≤ n.
#[inline(always)]
unsafe fn evaluate_register<T: Scalar, R: Lanes<T>>(law: &LinearElastic<R>, block: &Points<T>, i: usize) -> R {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    let state = block.leading_dimension;
    let wanted = Wanted {
        stress: !block.stress[0].is_null(),
        state: !block.state_new[0].is_null(),
        wave_modulus: !block.wave_speed.is_null(),
    };
    // SAFETY: i + COUNT ≤ n, and every pointer that is read or written here has been found not to be null, F apart,
    // which `check` requires: in a valid block each of its components has n values.
    unsafe {
        let (f0, f1) = (gradient(&block.f_old, i), gradient(&block.f_new, i));
        let axes = if block.axes.is_null() { f0 } else { columns(block.axes, block.axes_leading_dimension, i) };
        let (reference, usable) = if block.fibre[0].is_null() && block.second_axis[0].is_null() {
            (law.axes, zero.le(zero))
        } else {
            let fibre = if block.fibre[0].is_null() { law.axes[0] } else { vector(&block.fibre, i) };
            let second = if block.second_axis[0].is_null() { None } else { Some(vector(&block.second_axis, i)) };
            law.axes_along(fibre, second)
        };
        let mut old = [zero; LINEAR_ELASTIC_STATE];
        if !block.state_old[0].is_null() {
            for (c, value) in old.iter_mut().enumerate() {
                *value = R::load(block.state_old[0].add(c * state + i));
            }
        }
        let limit = if block.limits(0).is_null() { None } else { Some(R::load(block.limit.add(i))) };
        let step = Step { f0: &f0, f1: &f1, axes: &axes, limit, rotation: block.rotation, criterion: block.criterion };
        let answer = law.respond(step, &reference, usable, &old, wanted);
        if wanted.stress {
            let mut c = 0;
            while c < 6 {
                answer.stress[c].store(block.stress[c].add(i));
                c += 1;
            }
        }
        store(&answer.state, block.state_new[0], state, i);
        store(answer.q1.as_flattened(), block.axes, block.axes_leading_dimension, i);
        if wanted.wave_modulus {
            let density = R::splat(block.density.into());
            wave_speed::wave_speed(answer.wave_modulus, density).store(block.wave_speed.add(i));
        }
        if !block.active.is_null() {
            R::select(answer.taken, one - answer.state[LINEAR_FAILED], zero).store(block.active.add(i));
        }
        if !block.status.is_null() {
            answer.status.store_integers(block.status.add(i));
        }
        answer.status
    }
}

/// Loads a vector, or the columns of F, from the pointers to their components.
///
/// # Safety
/// Each pointer points to i + COUNT values.
#[inline(always)]
unsafe fn vector<T, R: Lanes<T>>(v: &[*const T; 3], i: usize) -> [R; 3] {
    // SAFETY: COUNT of the values behind each pointer are from i on.
    unsafe { [R::load(v[0].add(i)), R::load(v[1].add(i)), R::load(v[2].add(i))] }
}

/// # Safety
/// As for [`vector`].
#[inline(always)]
unsafe fn gradient<T, R: Lanes<T>>(&[a, b, c, d, e, f, g, h, k]: &[*const T; 9], i: usize) -> Matrix<R> {
    // SAFETY: the nine pointers are those of three vectors.
    unsafe { [vector(&[a, b, c], i), vector(&[d, e, f], i), vector(&[g, h, k], i)] }
}

/// Loads a matrix by columns.
///
/// # Safety
/// `array` has nine components, each of i + COUNT values.
#[inline(always)]
unsafe fn columns<T, R: Lanes<T>>(array: *const T, stride: usize, i: usize) -> Matrix<R> {
    // SAFETY: it is called with c < 9.
    let entry = |c: usize| unsafe { R::load(array.add(c * stride + i)) };
    [[entry(0), entry(1), entry(2)], [entry(3), entry(4), entry(5)], [entry(6), entry(7), entry(8)]]
}

/// Stores the components of an array that is requested.
///
/// # Safety
/// `array` is null, or has a component for each value, each of i + COUNT values.
#[inline(always)]
unsafe fn store<T, R: Lanes<T>>(values: &[R], array: *mut T, stride: usize, i: usize) {
    if !array.is_null() {
        for (c, value) in values.iter().enumerate() {
            // SAFETY: `array` is not null, and c counts the values.
            unsafe { value.store(array.add(c * stride + i)) };
        }
    }
}

/// The block of a law with tangents, point by point: their iterations and inverses are not written in lanes. Returns
/// the worst status code.
///
/// Everything is computed in double precision. Results that do not fit T are an overflow.
///
/// # Safety
/// The block is valid, see [`Points`], and has a tangent.
pub(super) unsafe fn with_tangents<T: Scalar>(law: &LinearElastic<T>, block: &Points<T>) -> i32 {
    let law = law.lanes::<f64>();
    let mut worst = status::OK;
    for i in 0..block.n {
        // SAFETY: i < n by the loop.
        worst = worst.min(unsafe { point_with_tangent(&law, block, i) });
    }
    worst
}

/// # Safety
/// As for [`with_tangents`], with i < n.
unsafe fn point_with_tangent<T: Scalar>(law: &LinearElastic, block: &Points<T>, i: usize) -> i32 {
    // SAFETY: it is called with arrays of the block that are not null, and with the place of a component that they have
    // at point i.
    let load = |array: *const T, at: usize| -> f64 { unsafe { *array.add(at) }.into() };
    let all = |[a, b, c, d, e, f, g, h, k]: [*const T; 9]| -> Matrix<f64> {
        [[a, b, c], [d, e, f], [g, h, k]].map(|column| column.map(|component| load(component, i)))
    };
    let three = |[x, y, z]: [*const T; 3]| [x, y, z].map(|component| load(component, i));
    let (f0, f1) = (all(block.f_old), all(block.f_new));
    let mut state = [0.0; LINEAR_ELASTIC_STATE];
    if !block.state_old[0].is_null() {
        for (c, value) in state.iter_mut().enumerate() {
            *value = load(block.state_old[0], c * block.leading_dimension + i);
        }
    }
    let spin = block.rotation == Rotation::Spin;
    let axis = |c: usize| c * block.axes_leading_dimension + i;
    let mut axes = f0;
    if spin {
        for (c, value) in axes.as_flattened_mut().iter_mut().enumerate() {
            *value = load(block.axes, axis(c));
        }
    }
    let (reference, usable) = if block.fibre[0].is_null() && block.second_axis[0].is_null() {
        (law.axes, true)
    } else {
        let fibre = if block.fibre[0].is_null() { law.axes[0] } else { three(block.fibre) };
        let second = if block.second_axis[0].is_null() { None } else { Some(three(block.second_axis)) };
        law.axes_along(fibre, second)
    };
    let state_wanted = !block.state_new[0].is_null();
    let wanted = Wanted { stress: true, state: state_wanted, wave_modulus: !block.wave_speed.is_null() };
    let limit = if block.limits(0).is_null() { None } else { Some(load(block.limit, i)) };
    let step = Step { f0: &f0, f1: &f1, axes: &axes, limit, rotation: block.rotation, criterion: block.criterion };
    let (mut answer, tangent) =
        law.respond_with_tangent(step, &reference, usable, &state, wanted, (block.measure, block.level()));
    let (mut entries, size) = by_rows(&tangent, block.measure, &f1.into(), &answer.stress);
    let speed = |answer: &Answer<f64>| wave_speed::wave_speed(answer.wave_modulus, block.density.into());
    // Rounded to T, a number that does not fit is not finite.
    let fits = |x: f64| (T::splat(x).into() * 0.0) == 0.0;
    let results = answer.stress.iter().chain(&answer.state).chain(&entries);
    if answer.taken && !(results.into_iter().all(|&x| fits(x)) && (!wanted.wave_modulus || fits(speed(&answer)))) {
        law.overflow(&mut answer, &state);
    }
    if !answer.taken {
        entries = [0.0; 81]; // a tangent of 0 that is converted with an F which is not finite is not 0
    }
    // SAFETY: as for `load`.
    let store = |x: f64, array: *mut T, at: usize| unsafe { *array.add(at) = T::splat(x) };
    if !block.stress[0].is_null() {
        for (x, component) in answer.stress.into_iter().zip(block.stress) {
            store(x, component, i);
        }
    }
    if !block.state_new[0].is_null() {
        for (c, x) in answer.state.into_iter().enumerate() {
            store(x, block.state_new[0], c * block.leading_dimension + i);
        }
    }
    if spin {
        for (c, &x) in answer.q1.as_flattened().iter().enumerate() {
            store(x, block.axes, axis(c));
        }
    }
    for (c, &x) in entries.iter().take(size * size).enumerate() {
        store(x, block.tangent, c * block.tangent_leading_dimension + i);
    }
    if wanted.wave_modulus {
        store(speed(&answer), block.wave_speed, i);
    }
    if !block.active.is_null() {
        store(if answer.taken { answer.state[LINEAR_ALIVE] } else { 0.0 }, block.active, i);
    }
    let code = answer.status as i32;
    if !block.status.is_null() {
        // SAFETY: `status` is not null and has n values, i < n.
        unsafe { *block.status.add(i) = code };
    }
    code
}
