//! The kernel: each stage of the law is computed for several registers of points before the next stage.

use core::mem::MaybeUninit;

use super::points::Points;
use crate::law::failure::Failure;
use crate::law::hyperelastic::{Deformed, Hyperelastic};
use crate::law::kinematics::{Axes, FibreFrame, FirstAxis, Kinematics, Logarithms, Section, Strain, Stretch};
use crate::law::number::elementary::{Power, Reduced};
use crate::law::number::real::{Lanes, Real, Scalar, WIDEST};
use crate::law::response::{Request, nan_unless_finite};
use crate::law::state::part::{ENERGIES, FAILURE, INVARIANTS};
use crate::law::status;
use crate::law::tangent::{Measure, may_overflow};
use crate::law::wave_speed;

// The requests that a kernel is compiled for, so that its loops contain no branches about them.

/// The stress alone, with the fibre direction of the properties; the other flags are added to this.
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
pub(super) const STRESS: u8 = 0;
/// Energies, invariants, failure and the latch as well.
pub(super) const STATE: u8 = 1;
/// A fibre direction for each point.
pub(super) const FIBRES: u8 = 2;
/// The fibre direction of the properties is the first axis.
pub(super) const ALIGNED: u8 = 4;
/// All that the block has arrays for and, if the law has one, longitudinal shear: the kernel looks these up at run time for each
/// group of registers.
pub(super) const ANY: u8 = 8;
/// Longitudinal shear, compiled with the state alone: it is rarely used.
pub(super) const SHEAR: u8 = 16;
/// The wave speed, compiled with the state alone: what explicit solvers request in every step.
pub(super) const WAVE: u8 = 32;
/// Points with failure limits of their own, beside the state.
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
pub(super) const LIMITS: u8 = 64;

/// The kernel. Returns the worst status code.
///
/// If the points do not fill the last register, it holds the last COUNT points of the block, some of which the register before it
/// holds too: both are in the same group, in which every old state is read before a new one is stored, so that both compute and
/// store the same.
///
/// # Safety
/// The block is valid, see [`Points`], with at least COUNT points next to each other and its state in place; `WANT` requests nothing
/// that the block has no array for; the processor has the lanes' instructions. The other functions of this file are called for such a
/// block, and for the lanes from a point i on with i + COUNT ≤ n, as [`place`] gives them: the components of every array that is not
/// null, and of every one that WANT requests, have COUNT values from i on.
#[inline(always)]
pub(super) unsafe fn sweep<T: Scalar, R: Lanes<T>, const WANT: u8>(law: &Hyperelastic<T>, block: &Points<T>) -> i32 {
    let lanes = law.lanes::<R>();
    let mut worst = R::splat(0.0);
    let (registers, mut first) = (block.n.div_ceil(R::COUNT), 0);
    // Without a way out before the first turn: it would be taken before the stack frame is made, and LLVM's probes of a
    // frame of more than eight pages overwrite r11, which may hold n by then.
    loop {
        let left = registers - first;
        let count = match left {
            0..=STAGED => left,
            // Two groups of the same size take less time than a large and a small one.
            _ if left <= 2 * STAGED => left.div_ceil(2),
            _ => STAGED,
        };
        // SAFETY: count ≤ STAGED, and (first + count − 1) COUNT < n, `registers` being n/COUNT rounded up; a group has two registers at
        // least, unless it is the whole block.
        unsafe { evaluate::<T, R, WANT>(&lanes, block, first * R::COUNT, count, &mut worst) };
        first += count;
        if first >= registers {
            return least_code(worst);
        }
    }
}

/// The least (worst) of the status codes in the lanes, or 0.
#[inline(always)]
pub(crate) fn least_code<T, R: Lanes<T>>(codes: R) -> i32 {
    let mut stored = [0; WIDEST];
    // SAFETY: no register has more than WIDEST lanes.
    unsafe { codes.store_integers(stored.as_mut_ptr()) };
    let mut code = status::OK;
    for &one in stored.iter().take(R::COUNT) {
        code = code.min(one);
    }
    code
}

/// The number of registers of points that go through a stage before the next one. The operations of one point wait for one
/// another, so that the processor needs several points to work on, and a whole evaluation is too long for it to look ahead to
/// the next point.
pub(super) const STAGED: usize = 6;

/// The results of a stage, one for each register.
struct Stage<X>([MaybeUninit<X>; STAGED]);

impl<X> Stage<X> {
    #[inline(always)]
    fn new() -> Self {
        Stage([const { MaybeUninit::uninit() }; STAGED])
    }

    /// # Safety
    /// k < STAGED. This is not checked, so that the loop of a stage has a single exit.
    #[inline(always)]
    unsafe fn put(&mut self, k: usize, x: X) {
        // SAFETY: k < STAGED, the length of the array.
        unsafe { self.0.get_unchecked_mut(k) }.write(x);
    }

    /// # Safety
    /// [`put`](Self::put) has been called for k.
    #[inline(always)]
    unsafe fn get(&self, k: usize) -> &X {
        // SAFETY: `put` has written entry k, which is below STAGED for it.
        unsafe { self.0.get_unchecked(k).assume_init_ref() }
    }
}

/// The results that only the next stage reads. They share one place, since the results of all stages have to stay in the
/// first-level cache together with the data of the points.
#[derive(Clone, Copy)]
union Step<R: Real> {
    logarithms: Logarithms<R>,
    power: Power<R>,
    reduced: Reduced<R>,
    powered: R,
}

/// Evaluates `count` registers of points from `i` on, in the axes that the kernel is built for.
///
/// # Safety
/// As for [`sweep`], with count ≤ STAGED; i + (count − 1) COUNT < n, and if the last register is not full, there are two.
#[inline(always)]
unsafe fn evaluate<T: Scalar, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
    count: usize,
    worst: &mut R,
) {
    let mut frames = Stage::new();
    // SAFETY: `staged` has the same requirements, and calls `fibre` with k < count ≤ STAGED, for which a frame has been put.
    unsafe {
        if WANT & ALIGNED != 0 {
            staged::<T, R, FirstAxis, WANT>(law, block, i, count, |_| (FirstAxis, None), worst);
        } else if WANT & (FIBRES | ANY) != 0 {
            for k in 0..count {
                frames.put(k, frame::<T, R, WANT>(law, block, place::<T, R>(block, i, k)));
            }
            let fibre = |k: usize| {
                let (frame, usable) = *frames.get(k);
                (frame, Some(usable))
            };
            staged::<T, R, FibreFrame<R>, WANT>(law, block, i, count, fibre, worst);
        } else {
            staged::<T, R, FibreFrame<R>, WANT>(law, block, i, count, |_| (law.frame, None), worst);
        }
    }
}

/// The first point of register `k` of the group that begins at point `i`: of the last one, a point of the register before it if fewer
/// than COUNT points are left.
#[inline(always)]
fn place<T, R: Lanes<T>>(block: &Points<T>, i: usize, k: usize) -> usize {
    (i + k * R::COUNT).min(block.n - R::COUNT)
}

/// Evaluates `count` registers of points from `i` on, stage by stage. `axes` gives the axes of a register, and where they are
/// usable, `None` for everywhere.
///
/// # Safety
/// As for [`evaluate`]; `axes` may be called with k < count.
#[inline(always)]
unsafe fn staged<T: Scalar, R: Lanes<T>, A: Axes<R>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
    count: usize,
    axes: impl Fn(usize) -> (A, Option<R::Mask>),
    worst: &mut R,
) {
    let (mut stretches, mut sections, mut kept, mut images) =
        (Stage::new(), Stage::<Section<R>>::new(), Stage::new(), Stage::new());
    let (mut steps, mut strains, mut outcomes) = (Stage::new(), Stage::new(), Stage::new());
    let zero = R::splat(0.0);
    let (mut check, mut slipped) = (zero, R::never());
    let mut places = Stage::new();
    for k in 0..count {
        // SAFETY: k < count ≤ STAGED.
        unsafe { places.put(k, place::<T, R>(block, i, k)) };
    }
    // SAFETY: it is called with k < count, for which a place has been put.
    let at = |k: usize| unsafe { *places.get(k) };
    // If the block has no array for the status codes or the active points, these are stored to a scratch array, which costs less
    // than a test at every store.
    let mut no_status = [MaybeUninit::<i32>::uninit(); STAGED * WIDEST];
    let status =
        if block.status.is_null() { no_status.as_mut_ptr().cast::<i32>().wrapping_sub(i) } else { block.status };
    let mut no_active = [const { MaybeUninit::<T>::uninit() }; STAGED * WIDEST];
    let active = if block.active.is_null() { no_active.as_mut_ptr().cast::<T>().wrapping_sub(i) } else { block.active };
    // SAFETY: k < count ≤ STAGED in every loop, each stage reads what the ones before have put, and at(k) + COUNT ≤ n. The scratch
    // arrays have WIDEST ≥ COUNT values for each k, and i ≤ at(k) ≤ i + k COUNT, so that i may be subtracted from their addresses.
    unsafe {
        for k in 0..count {
            let n = axes(k).0;
            let (stretch, vectors) = Stretch::new(&gradient(block, at(k)), &n);
            stretches.put(k, stretch);
            kept.put(k, n.keep(vectors));
        }
        for k in 0..count {
            let (n, d) = (axes(k).0, stretches.get(k));
            let (section, vectors) = Section::new(d, n.recall(kept.get(k), &gradient(block, at(k)), d), &n);
            slipped = slipped | section.slipped_far(d);
            sections.put(k, section);
            images.put(k, vectors);
        }
        // Far slips are seldom, so that there is one test for all.
        if R::any(slipped) {
            for k in 0..count {
                let (n, d) = (axes(k).0, stretches.get(k));
                let far = sections.get(k).slipped_far(d);
                let (section, vectors) =
                    Section::orthogonal(d, n.recall(kept.get(k), &gradient(block, at(k)), d), &n, far);
                sections.put(k, section);
                images.put(k, vectors);
            }
        }
        for k in 0..count {
            steps.put(k, Step { logarithms: Logarithms::new(stretches.get(k), sections.get(k)) });
        }
        for k in 0..count {
            strains.put(k, Strain::new(stretches.get(k), sections.get(k), &steps.get(k).logarithms));
            for column in block.stress {
                R::prefetch(column.wrapping_add(at(k)));
            }
        }
        for k in 0..count {
            steps.put(k, Step { power: law.compaction(strains.get(k)) });
            prefetch::<T, R, 4>(WANT & (STATE | ANY) != 0, block.state_new[ENERGIES], block.leading_dimension, at(k));
        }
        for k in 0..count {
            steps.put(k, Step { reduced: steps.get(k).power.reduce(&law.exponent) });
            prefetch::<T, R, 4>(WANT & (STATE | ANY) != 0, block.state_new[INVARIANTS], block.leading_dimension, at(k));
        }
        for k in 0..count {
            steps.put(k, Step { powered: steps.get(k).reduced.finish() });
            prefetch::<T, R, 3>(WANT & (STATE | ANY) != 0, block.state_new[FAILURE], block.leading_dimension, at(k));
        }
        for k in 0..count {
            let nan_if_invalid = match axes(k).1 {
                Some(usable) => R::select(usable, strains.get(k).nan_if_invalid, R::splat(f64::NAN)),
                None => strains.get(k).nan_if_invalid,
            };
            let d = stretches.get(k);
            let [fibre, ..] = axes(k).0.recall(kept.get(k), &gradient(block, at(k)), d);
            let &[a, b] = images.get(k);
            let kinematics =
                Kinematics { stretch: d, section: sections.get(k), images: [fibre, a, b], strain: strains.get(k) };
            let outcome = respond::<T, R, WANT>(law, block, at(k), kinematics, steps.get(k).powered, nan_if_invalid);
            zero.store_integers(status.wrapping_add(at(k)));
            outcomes.put(k, outcome);
        }
        for k in 0..count {
            check = add_to_check::<T, R, WANT>(block, at(k), outcomes.get(k).latch_or_nan, check);
        }
        // Invalid points are rare, so that there is one test for all. A number minus itself is 0, unless it is NaN or infinite.
        #[allow(clippy::eq_op)]
        let all_finite = (check - check).le(zero);
        if R::any(!all_finite) {
            // All codes before the first reset, which changes the old state that the codes depend on.
            let mut codes = Stage::new();
            for k in 0..count {
                let usable = axes(k).1.unwrap_or(zero.le(zero));
                let code = status_code::<T, R, WANT>(law, block, at(k), stretches.get(k), usable, outcomes.get(k));
                codes.put(k, code);
            }
            for k in 0..count {
                let code: R = *codes.get(k);
                reset_invalid::<T, R, WANT>(block, at(k), outcomes.get(k));
                code.store_integers(status.wrapping_add(at(k)));
                *worst = R::select(code.lt(*worst), code, *worst);
            }
        }
        if WANT & (STATE | ANY) != 0 {
            for k in 0..count {
                let (d, strain) = (stretches.get(k), strains.get(k));
                let power = steps.get(k).powered;
                let is_active = store_state::<T, R, WANT>(law, block, at(k), d, strain, power, outcomes.get(k));
                is_active.store(active.wrapping_add(at(k)));
            }
        }
        if wants_tangent::<T, WANT>(block) {
            for k in 0..count {
                clear_tangent(block, at(k), outcomes.get(k));
            }
        }
    }
}

/// The columns of F.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
unsafe fn gradient<T, R: Lanes<T>>(block: &Points<T>, i: usize) -> [[R; 3]; 3] {
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
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
unsafe fn frame<T, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
) -> (FibreFrame<R>, R::Mask) {
    let m = &block.fibre;
    if WANT & ANY != 0 && m[0].is_null() {
        let zero = R::splat(0.0);
        return (law.frame, zero.le(zero));
    }
    // SAFETY: the kernel is built for fibres, or the pointers are not null: n ≥ i + COUNT values for each component.
    let direction = unsafe { [R::load(m[0].add(i)), R::load(m[1].add(i)), R::load(m[2].add(i))] };
    FibreFrame::new(direction)
}

/// Whether the law has a longitudinal shear stiffness and the kernel is compiled for it.
#[inline(always)]
fn shears<R: Real, const WANT: u8>(law: &Hyperelastic<R>) -> bool {
    WANT & SHEAR != 0 || (WANT & ANY != 0 && law.shears)
}

/// The results that are requested of a kernel.
#[inline(always)]
pub(super) fn request<T, const WANT: u8>(block: &Points<T>) -> Request {
    let asked = WANT & ANY != 0;
    Request {
        stress: !asked || !block.stress[0].is_null(),
        energies: if asked { !block.state_new[ENERGIES].is_null() } else { WANT & STATE != 0 },
        invariants: if asked { !block.state_new[INVARIANTS].is_null() } else { WANT & STATE != 0 },
        failure: if asked { !block.state_new[FAILURE].is_null() } else { WANT & STATE != 0 },
        modes: asked && !block.modes.is_null(),
        wave_modulus: if asked { !block.wave_speed.is_null() } else { WANT & WAVE != 0 },
    }
}

/// Whether kernels that are compiled for a request know all arrays of the block; else it takes the general one.
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
#[inline(always)]
pub(super) fn is_usual<T>(block: &Points<T>) -> bool {
    block.tangent.is_null()
}

/// The results of [`respond`] that later stages need.
struct Outcome<R: Real> {
    /// Whether it has a new state: it had not failed before and can be evaluated.
    updated: R::Mask,
    /// The old latch, and the same but NaN where the point cannot be evaluated.
    latch: R,
    latch_or_nan: R,
}

/// Computes and stores the stress, modes, wave speed and tangent; those of invalid points are reset later. The state is stored
/// in a stage of its own: each component is in a different memory page, and a processor can store to only a few pages at a time
/// without waiting.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
unsafe fn respond<T: Scalar, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
    kinematics: Kinematics<'_, R>,
    power: R,
    nan_if_invalid: R,
) -> Outcome<R> {
    let Kinematics { stretch: d, strain, .. } = kinematics;
    let request = request::<T, WANT>(block);
    let stride = block.modes_leading_dimension;

    // SAFETY: what is requested has an array, whose components have n ≥ i + COUNT values.
    unsafe {
        let latch = latch::<T, R, WANT>(block, i);
        // Only the modes and the tangent need the frame again.
        let tangent = wants_tangent::<T, WANT>(block);
        let frame = if request.modes || tangent { frame::<T, R, WANT>(law, block, i).0 } else { law.frame };
        let k = law.kirchhoff(d, strain, power);
        let point = Deformed { law, kinematics, k: &k, shear: shears::<R, WANT>(law) };
        let nan_if_invalid = match limit::<T, R, WANT>(block, i) {
            Some(limit) => R::select(Failure::is_limit(limit), nan_if_invalid, R::splat(f64::NAN)),
            None => nan_if_invalid,
        };
        let nan_if_invalid =
            if tangent { nan_if_invalid + store_tangent(point, block, i, &frame) } else { nan_if_invalid };
        let r = point.respond(&frame, nan_if_invalid, latch, request);

        if request.stress {
            for c in 0..6 {
                r.stress[c].store(block.stress[c].add(i));
            }
        }
        if request.modes {
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
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
unsafe fn latch<T, R: Lanes<T>, const WANT: u8>(block: &Points<T>, i: usize) -> R {
    let absent = if WANT & ANY != 0 { block.state_old[FAILURE].is_null() } else { WANT & STATE == 0 };
    if absent {
        return R::splat(0.0);
    }
    // SAFETY: `failure_old` is not null; its second component has n ≥ i + COUNT values.
    unsafe { R::load(block.state_old[FAILURE].add(block.leading_dimension + i)) }
}

/// The limits of points that have their own, where the failure is computed.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
unsafe fn limit<T, R: Lanes<T>, const WANT: u8>(block: &Points<T>, i: usize) -> Option<R> {
    let limited = if WANT & ANY != 0 { !block.limits(FAILURE).is_null() } else { WANT & LIMITS != 0 };
    if !limited {
        return None;
    }
    // SAFETY: `limit` is not null; it has n ≥ i + COUNT values.
    Some(unsafe { R::load(block.limit.add(i)) })
}

/// Whether the tangent is requested, which only the general kernel without an aligned fibre computes.
#[inline(always)]
fn wants_tangent<T, const WANT: u8>(block: &Points<T>) -> bool {
    WANT & ANY != 0 && WANT & ALIGNED == 0 && !block.tangent.is_null()
}

/// Stores the tangent of the intact material. Returns 0 where all its entries are finite, else NaN.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on of a block that requests the tangent.
#[inline(always)]
unsafe fn store_tangent<T: Scalar, R: Lanes<T>>(
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
unsafe fn clear_tangent<T: Scalar, R: Lanes<T>>(block: &Points<T>, i: usize, outcome: &Outcome<R>) {
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

/// Returns `check` plus the contribution of a register. The sum is not finite if one of the points needs [`reset_invalid`]: it
/// cannot be evaluated, or its old state is not finite.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on, after [`respond`].
#[inline(always)]
unsafe fn add_to_check<T: Scalar, R: Lanes<T>, const WANT: u8>(
    block: &Points<T>,
    i: usize,
    latch_or_nan: R,
    check: R,
) -> R {
    let request = request::<T, WANT>(block);
    // SAFETY: it is called for arrays that are requested and components that they have, with n ≥ i + COUNT values.
    let old = |array: *mut T, c: usize| unsafe { R::load(array.add(c * block.leading_dimension + i)) };
    let mut sum = if request.failure { latch_or_nan + old(block.state_new[FAILURE], 0) } else { latch_or_nan };
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

/// Stores the new state of the points that have one and the latch of all. Returns 1 for the points that are active, else 0.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on, after [`respond`].
#[inline(always)]
unsafe fn store_state<T: Scalar, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Points<T>,
    i: usize,
    d: &Stretch<R>,
    strain: &Strain<R>,
    power: R,
    outcome: &Outcome<R>,
) -> R {
    let request = request::<T, WANT>(block);
    let stride = block.leading_dimension;
    // SAFETY: what is requested has an array, whose components have n ≥ i + COUNT values.
    unsafe {
        let (k, shear) = (law.kirchhoff(d, strain, power), shears::<R, WANT>(law));
        let failure = limit::<T, R, WANT>(block, i).map_or(law.failure, |limit| law.failure.at(limit));
        let index = if request.failure { failure.index(strain) } else { R::splat(0.0) };
        let r = law.history(index, strain, d.shear_invariant(), &k, outcome.updated, outcome.latch, request, shear);
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
            r.failure_index.store_where(outcome.updated, block.state_new[FAILURE].add(i));
            r.failed.store(block.state_new[FAILURE].add(stride + i));
            (R::splat(1.0) - r.failed).store(block.state_new[FAILURE].add(2 * stride + i));
        }
        R::select(outcome.updated, R::splat(1.0) - r.failed, R::splat(0.0))
    }
}

/// Prefetches the components that [`store_state`] will store to.
#[inline(always)]
fn prefetch<T, R: Lanes<T>, const COMPONENTS: usize>(wanted: bool, array: *mut T, leading_dimension: usize, i: usize) {
    if wanted {
        for c in 0..COMPONENTS {
            R::prefetch(array.wrapping_add(c * leading_dimension + i));
        }
    }
}

/// Where the old energies, invariants and failure index of the lanes from i on are, each with whether it is requested.
#[inline(always)]
fn old_entries<T, const WANT: u8>(block: &Points<T>, i: usize) -> [(bool, *mut T); 9] {
    let (request, stride) = (request::<T, WANT>(block), block.leading_dimension);
    let energy = |c: usize| (request.energies, block.state_new[ENERGIES].wrapping_add(c * stride + i));
    let invariant = |c: usize| (request.invariants, block.state_new[INVARIANTS].wrapping_add(c * stride + i));
    let index = (request.failure, block.state_new[FAILURE].wrapping_add(i));
    [energy(0), energy(1), energy(2), energy(3), invariant(0), invariant(1), invariant(2), invariant(3), index]
}

/// The status codes of the points that have failed before or cannot be evaluated; 0 for the others.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on, after [`respond`] and before [`reset_invalid`].
#[inline(always)]
unsafe fn status_code<T: Scalar, R: Lanes<T>, const WANT: u8>(
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
            // SAFETY: an entry that is requested has n ≥ i + COUNT values in its component, from `entry` on those of the lanes.
            finite = finite & unsafe { (R::load(entry) * zero).le(zero) };
        }
    }
    // SAFETY: F has the lanes from i on, and so has a limit.
    let (limit, gradient) = unsafe { (limit::<T, R, WANT>(block, i), gradient(block, i)) };
    let code = law.status_code(&gradient, d, usable, limit.map(Failure::is_limit), outcome.latch);
    let code = R::select(!finite & zero.le(code), R::splat(f64::from(status::STATE_NOT_FINITE)), code);
    R::select(outcome.updated, zero, code)
}

/// For points that have failed before or cannot be evaluated: sets the stress to 0, and what is not finite in the old state
/// that they keep.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on, after [`status_code`] and before [`store_state`].
#[inline(always)]
unsafe fn reset_invalid<T: Scalar, R: Lanes<T>, const WANT: u8>(block: &Points<T>, i: usize, outcome: &Outcome<R>) {
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
