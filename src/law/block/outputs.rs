//! What the kernel reads of a register's points besides F, and what it stores: results, new states, status codes.

use super::points::Points;
use super::request::{
    ANY, EXPLICIT, FRICTION, I_TE, LOST, SHEAR, SLIP, STATE, has_tangent, index_row, request, shears,
};
use crate::law::axes::FibreFrame;
use crate::law::frictional::Slip;
use crate::law::hyperelastic::{Deformed, Hyperelastic, Kirchhoff};
use crate::law::kinematics::{Kinematics, Strain, Stretch};
use crate::law::number::real::{Lanes, Real, Scalar};
use crate::law::own::OwnNumbers;
use crate::law::response::nan_unless_finite;
use crate::law::state::part::{ENERGIES, FAILURE, INVARIANTS};
use crate::law::status;
use crate::law::tangent::{Measure, may_overflow};
use crate::law::wave_speed;

/// What a point with friction has remembered, and its I_te; 0 without an old state.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on.
#[inline(always)]
pub(super) unsafe fn remembered<T: Scalar, R: Lanes<T>>(block: &Points<T>, i: usize) -> (Slip<R>, R) {
    let old = block.state_old[FAILURE];
    if old.is_null() {
        let zero = R::splat(0.0);
        return (Slip { d: [zero; 2], lost: zero }, zero);
    }
    // SAFETY: the old state of friction is not null; its components have n ≥ i + COUNT values.
    unsafe {
        let row = |row: usize| R::load(old.add(row * block.leading_dimension + i));
        (Slip { d: [row(SLIP), row(SLIP + 1)], lost: row(LOST) }, row(I_TE))
    }
}

/// The columns of F.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on.
#[inline(always)]
pub(super) unsafe fn gradient<T, R: Lanes<T>>(block: &Points<T>, i: usize) -> [[R; 3]; 3] {
    let f = &block.f_new;
    // SAFETY: F is never null, and has n ≥ i + COUNT values for each component.
    unsafe {
        [
            [R::load(f[0].add(i)), R::load(f[1].add(i)), R::load(f[2].add(i))],
            [R::load(f[3].add(i)), R::load(f[4].add(i)), R::load(f[5].add(i))],
            [R::load(f[6].add(i)), R::load(f[7].add(i)), R::load(f[8].add(i))],
        ]
    }
}

/// The material frame, that of the properties or those of the points, and where it is usable.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on.
#[inline(always)]
pub(super) unsafe fn frame<T, R: Lanes<T>>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
) -> (FibreFrame<R>, R::Mask) {
    if block.fibre[0].is_null() {
        let zero = R::splat(0.0);
        return (law.frame, zero.le(zero));
    }
    // SAFETY: there are fibre directions.
    unsafe { own_frame(block, i) }
}

/// The material frame of points that have fibre directions of their own, and where it is usable.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on.
#[inline(always)]
pub(super) unsafe fn own_frame<T, R: Lanes<T>>(block: &Points<T>, i: usize) -> (FibreFrame<R>, R::Mask) {
    let m = &block.fibre;
    // SAFETY: the pointers are not null: n ≥ i + COUNT values for each component.
    let direction = unsafe { [R::load(m[0].add(i)), R::load(m[1].add(i)), R::load(m[2].add(i))] };
    FibreFrame::new(direction)
}

/// The results of [`respond`] that later stages need.
pub(super) struct Outcome<R: Real> {
    /// Whether it has a new state: it had not failed before and can be evaluated.
    updated: R::Mask,
    /// The old latch, and the same but NaN where the point cannot be evaluated.
    latch: R,
    pub latch_or_nan: R,
}

impl<R: Real> Outcome<R> {
    /// Whether a point keeps its old state.
    #[inline(always)]
    pub fn is_kept(&self) -> bool {
        R::any(!self.updated)
    }
}

/// Computes and stores the stress, modes, wave speed and tangent; those of invalid points are reset later. The state is
/// stored in a stage of its own: each component is in a different memory page, and a processor can store to only a few
/// pages at a time without waiting.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on.
#[inline(always)]
pub(super) unsafe fn respond<T: Scalar, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
    kinematics: Kinematics<'_, R>,
    k: &Kirchhoff<R>,
    nan_if_invalid: R,
) -> Outcome<R> {
    let request = request::<T, WANT>(block);
    let stride = block.modes_leading_dimension;

    // SAFETY: what is requested has an array, whose components have n ≥ i + COUNT values.
    unsafe {
        let latch = latch::<T, R, WANT>(block, i);
        // `const`: a kernel without modes, or without the tangent, then has no code of them to be compiled.
        let tangent = const { has_tangent::<WANT>() } && !block.tangent.is_null();
        // Only the modes and the tangent need the frame again.
        let frame = match const { WANT & ANY != 0 } {
            true if request.modes || tangent => frame::<T, R>(law, block, i).0,
            _ => law.frame,
        };
        let point = Deformed { law, kinematics, k, shear: shears::<R, WANT>(law) };
        let mut nan_if_invalid = match own::<T, R, WANT>(block, i).are_allowed() {
            Some(allowed) => R::select(allowed, nan_if_invalid, R::splat(f64::NAN)),
            None => nan_if_invalid,
        };
        if const { has_tangent::<WANT>() } && tangent {
            nan_if_invalid += store_tangent::<T, R, WANT>(point, block, i, &frame);
        }
        let r = match const { WANT & (ANY | EXPLICIT) != 0 } {
            true => point.respond::<true>(&frame, nan_if_invalid, latch, request),
            false => point.respond::<false>(&frame, nan_if_invalid, latch, request),
        };

        if request.stress {
            for c in 0..6 {
                r.stress[c].store(block.stress[c].add(i));
            }
        }
        if const { WANT & ANY != 0 } && request.modes {
            for (mode, s) in r.modes.iter().enumerate() {
                for (c, &value) in s.iter().enumerate() {
                    value.store(block.modes.add((6 * mode + c) * stride + i));
                }
            }
        }
        if request.wave_modulus {
            let density = R::splat(block.density.into());
            wave_speed::wave_speed(r.wave_modulus, density).store(block.wave_speed.add(i));
        }
        Outcome { updated: r.updated, latch, latch_or_nan: r.latch_or_nan }
    }
}

/// The latch of the old state.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on.
#[inline(always)]
pub(super) unsafe fn latch<T, R: Lanes<T>, const WANT: u8>(block: &Points<T>, i: usize) -> R {
    let absent = if WANT & ANY != 0 { block.state_old[FAILURE].is_null() } else { WANT & STATE == 0 };
    if absent {
        return R::splat(0.0);
    }
    // SAFETY: the old failure is not null; its latch has n ≥ i + COUNT values.
    unsafe { R::load(block.state_old[FAILURE].add((index_row::<WANT>() + 1) * block.leading_dimension + i)) }
}

/// What the points have of their own.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on.
#[inline(always)]
pub(super) unsafe fn own<T, R: Lanes<T>, const WANT: u8>(block: &Points<T>, i: usize) -> OwnNumbers<R> {
    if WANT & (EXPLICIT | SHEAR | ANY) == 0 {
        return OwnNumbers::NONE;
    }
    // SAFETY: the same points, and i + COUNT ≤ n.
    unsafe { OwnNumbers::of_lanes(block, i) }
}

/// Stores the tangent of the intact material. Returns 0 where all its entries are finite, else NaN.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on of a block that requests the tangent.
#[inline(always)]
pub(super) unsafe fn store_tangent<T: Scalar, R: Lanes<T>, const WANT: u8>(
    point: Deformed<'_, R>,
    block: &Points<T>,
    i: usize,
    frame: &FibreFrame<R>,
) -> R {
    let store = |entries: &[R]| {
        for (c, entry) in entries.iter().enumerate() {
            // SAFETY: the tangent has a component for each entry of the measure, with n ≥ i + COUNT values.
            unsafe { entry.store(block.tangent.add(c * block.tangent_leading_dimension + i)) };
        }
    };
    if const { WANT & FRICTION != 0 } {
        if block.measure == Measure::Nominal {
            let nominal = point.sliding_nominal_tangent(frame);
            store(&nominal);
            return nan_unless_finite(&nominal);
        }
        let moduli = point.sliding_moduli(frame, block.measure);
        store(moduli.as_flattened());
        return nan_unless_finite(moduli.as_flattened());
    }
    if block.measure == Measure::Nominal {
        let nominal = point.nominal_tangent(frame);
        store(&nominal);
        nan_unless_finite(&nominal)
    } else {
        let moduli = point.moduli(frame, false, block.measure, None);
        store(moduli.matrix().as_flattened());
        if may_overflow::<R>(block.measure, point.shear) { nan_unless_finite(&moduli.0) } else { R::splat(0.0) }
    }
}

/// Sets the tangent to 0 at points that have failed before or cannot be evaluated.
///
/// # Safety
/// As for [`store_tangent`], after it.
#[inline(always)]
pub(super) unsafe fn clear_tangent<T: Scalar, R: Lanes<T>>(block: &Points<T>, i: usize, outcome: &Outcome<R>) {
    let zero = R::splat(0.0);
    if !R::any(!outcome.updated) {
        return;
    }
    for c in 0..block.measure.components() {
        // SAFETY: the tangent has the component c, with n ≥ i + COUNT values.
        unsafe {
            let place = block.tangent.add(c * block.tangent_leading_dimension + i);
            R::select(outcome.updated, R::load(place), zero).store(place);
        }
    }
}

/// Returns `check` plus the contribution of a register. The sum is not finite if one of the points needs
/// [`reset_invalid`]: it cannot be evaluated, or its old state is not finite.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on, after [`respond`].
#[inline(always)]
pub(super) unsafe fn add_to_check<T: Scalar, R: Lanes<T>, const WANT: u8>(
    block: &Points<T>,
    i: usize,
    latch_or_nan: R,
    check: R,
) -> R {
    let request = request::<T, WANT>(block);
    // SAFETY: it is called for arrays that are requested and components that they have, with n ≥ i + COUNT values.
    let old = |array: *mut T, c: usize| unsafe { R::load(array.add(c * block.leading_dimension + i)) };
    let mut sum = latch_or_nan;
    if request.failure {
        for row in 0..=index_row::<WANT>() {
            sum += old(block.state_new[FAILURE], row);
        }
    }
    for c in 0..4 {
        sum = match (request.energies, request.invariants) {
            (true, true) => old(block.state_new[ENERGIES], c).mul_add(old(block.state_new[INVARIANTS], c), sum),
            (true, false) => sum + old(block.state_new[ENERGIES], c),
            (false, true) => sum + old(block.state_new[INVARIANTS], c),
            (false, false) => sum,
        };
    }
    check + sum
}

/// A point whose new state is to be stored.
pub(super) struct Evaluated<'a, R: Real> {
    pub stretch: &'a Stretch<R>,
    pub strain: &'a Strain<R>,
    pub factors: Kirchhoff<R>,
    pub friction: Option<Remembered<'a, R>>,
}

/// Stores the new state of the points that have one and the latch of all. Returns 1 for the points that are active,
/// else 0.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on, after [`respond`].
#[inline(always)]
pub(super) unsafe fn store_state<T: Scalar, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
    point: &Evaluated<'_, R>,
    outcome: &Outcome<R>,
) -> R {
    let &Evaluated { stretch, strain, factors: ref k, ref friction } = point;
    let request = request::<T, WANT>(block);
    let stride = block.leading_dimension;
    // SAFETY: what is requested has an array, whose components have n ≥ i + COUNT values.
    unsafe {
        let shear = shears::<R, WANT>(law);
        let own = own::<T, R, WANT>(block, i);
        let index = if request.failure { own.failure_index(law.failure, strain) } else { R::splat(0.0) };
        let mut r =
            law.history(index, strain, stretch.shear_invariant(), k, outcome.updated, outcome.latch, request, shear);
        if let Some(Remembered { i_td, .. }) = friction {
            r.invariants[2] = *i_td;
        }
        if request.energies {
            for (c, energy) in r.energies.into_iter().enumerate() {
                energy.store_where(outcome.updated, block.state_new[ENERGIES].add(c * stride + i));
            }
        }
        if request.invariants {
            for (c, invariant) in r.invariants.into_iter().enumerate() {
                invariant.store_where(outcome.updated, block.state_new[INVARIANTS].add(c * stride + i));
            }
        }
        if request.failure {
            let row = |row: usize| block.state_new[FAILURE].add(row * stride + i);
            if let Some(Remembered { slip, .. }) = friction {
                strain.i_td.store_where(outcome.updated, row(I_TE));
                if let &Some(slip) = slip {
                    slip.lost.store_where(outcome.updated, row(LOST));
                    slip.d[0].store_where(outcome.updated, row(SLIP));
                    slip.d[1].store_where(outcome.updated, row(SLIP + 1));
                }
            }
            r.failure_index.store_where(outcome.updated, row(index_row::<WANT>()));
            r.failed.store(row(index_row::<WANT>() + 1));
            (R::splat(1.0) - r.failed).store(row(index_row::<WANT>() + 2));
        }
        R::select(outcome.updated, R::splat(1.0) - r.failed, R::splat(0.0))
    }
}

/// What a point with friction remembers.
pub(super) struct Remembered<'a, R> {
    /// The distortion of the whole section.
    pub i_td: R,
    /// Where any of the fibres slide.
    pub slip: Option<&'a Slip<R>>,
}

/// Prefetches the components that [`store_state`] will store to; of one point they are few, and near.
#[inline(always)]
pub(super) fn prefetch<T, R: Lanes<T>, const COMPONENTS: usize>(
    wanted: bool,
    array: *mut T,
    leading_dimension: usize,
    i: usize,
) {
    if wanted && !R::ALONE {
        for c in 0..COMPONENTS {
            R::prefetch(array.wrapping_add(c * leading_dimension + i));
        }
    }
}

/// Where the old energies, invariants, friction and failure index of the lanes from i on are, each with whether it is
/// requested.
#[inline(always)]
pub(super) fn old_entries<T, const WANT: u8>(block: &Points<T>, i: usize) -> [(bool, *mut T); 13] {
    let (request, stride) = (request::<T, WANT>(block), block.leading_dimension);
    let energy = |c: usize| (request.energies, block.state_new[ENERGIES].wrapping_add(c * stride + i));
    let invariant = |c: usize| (request.invariants, block.state_new[INVARIANTS].wrapping_add(c * stride + i));
    let last = |row: usize| {
        let kept = request.failure && row <= index_row::<WANT>();
        (kept, block.state_new[FAILURE].wrapping_add(row * stride + i))
    };
    [
        energy(0),
        energy(1),
        energy(2),
        energy(3),
        invariant(0),
        invariant(1),
        invariant(2),
        invariant(3),
        last(0),
        last(1),
        last(2),
        last(3),
        last(4),
    ]
}

/// The status codes of the points that have failed before or cannot be evaluated; 0 for the others.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on, after [`respond`] and before [`reset_invalid`].
#[inline(always)]
pub(super) unsafe fn status_code<T: Scalar, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
    d: &Stretch<R>,
    usable: R::Mask,
    outcome: &Outcome<R>,
) -> R {
    let zero = R::splat(0.0);
    let mut finite = zero.le(zero);
    for (requested, entry) in old_entries::<T, WANT>(block, i) {
        if requested {
            // SAFETY: an entry that is requested has n ≥ i + COUNT values in its component, from `entry` on those of
            // the lanes.
            finite = finite & unsafe { (R::load(entry) * zero).le(zero) };
        }
    }
    if WANT & FRICTION != 0 {
        // Read although no new state may be wanted.
        // SAFETY: an old state has the lanes from i on.
        let (Slip { d: [d1, d2], lost }, i_te) = unsafe { remembered::<T, R>(block, i) };
        finite = finite & (((d1 + d2) + (i_te + lost)) * zero).le(zero);
    }
    // SAFETY: F has the lanes from i on, and so has what the points have of their own.
    let (own, gradient) = unsafe { (own::<T, R, WANT>(block, i), gradient(block, i)) };
    let code = law.status_code(&gradient, d, usable, own.are_allowed(), outcome.latch);
    // A slip that is not finite leaves the section without a size.
    let overflow = code.le(R::splat(f64::from(status::OVERFLOW))) & R::splat(f64::from(status::OVERFLOW)).le(code);
    let unexplained = if WANT & FRICTION != 0 { zero.le(code) | overflow } else { zero.le(code) };
    let code = R::select(!finite & unexplained, R::splat(f64::from(status::STATE_NOT_FINITE)), code);
    R::select(outcome.updated, zero, code)
}

/// For points that have failed before or cannot be evaluated: sets the stress to 0, and what is not finite in the old
/// state that they keep.
///
/// # Safety
/// As for [`sweep`](super::kernel::sweep), for the lanes from i on, after [`status_code`] and before [`store_state`].
#[inline(always)]
pub(super) unsafe fn reset_invalid<T: Scalar, R: Lanes<T>, const WANT: u8>(
    block: &Points<T>,
    i: usize,
    outcome: &Outcome<R>,
) {
    let zero = R::splat(0.0);
    // SAFETY: what is requested has an array, whose components have n ≥ i + COUNT values.
    unsafe {
        for (requested, entry) in old_entries::<T, WANT>(block, i) {
            if requested {
                zero.store_where(!outcome.updated & !(R::load(entry) * zero).le(zero), entry);
            }
        }
        if request::<T, WANT>(block).stress {
            for place in block.stress {
                zero.store_where(!outcome.updated, place.add(i));
            }
        }
    }
}
