//! The kernel: each stage of the law is computed for several registers of points before the next stage.

use core::mem::MaybeUninit;

use super::outputs::{
    Evaluated, Outcome, Remembered, add_to_check, clear_tangent, gradient, own_frame, prefetch, remembered,
    reset_invalid, respond, status_code, store_state,
};
use super::points::Points;
use super::request::{ALIGNED, ANY, EXPLICIT, FRICTION, SHEAR, STATE, has_tangent, parts};
use crate::law::axes::{Axes, FibreFrame, FirstAxis};
use crate::law::frictional::{Friction, Hold, Slip};
use crate::law::hyperelastic::{Hyperelastic, Kirchhoff};
use crate::law::kinematics::{Kinematics, Logarithms, Section, Slid, Strain, Stretch, Unimodular};
use crate::law::number::elementary::{AsinhAlone, Power, Reduced};
use crate::law::number::real::{Lanes, Real, Scalar, WIDEST};
use crate::law::state::part::{ENERGIES, FAILURE, INVARIANTS};
use crate::law::status;

/// The kernel. Returns the worst status code.
///
/// If the points do not fill the last register, it holds the last COUNT points of the block, some of which the register
/// before it holds too: both are in the same group, in which every old state is read before a new one is stored, so
/// that both compute and store the same.
///
/// # Safety
/// The block is valid, see [`Points`], with at least COUNT points next to each other, one alone for lanes that are
/// [`ALONE`](Lanes::ALONE); its old state is in the arrays of the new one, or copied there, or, for lanes that are
/// ALONE, read from its own; `WANT` requests nothing that the block has no array for; the processor has the lanes'
/// instructions. The other functions of this file are called for such a block, and for the lanes from a point i on with
/// i + COUNT ≤ n, as [`place`] gives them: the components of every array that is not null, and of every one that WANT
/// requests, have COUNT values from i on.
#[inline(always)]
pub(super) unsafe fn sweep<T: Scalar, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<T>,
    friction: &Friction<T>,
    block: &Points<T>,
) -> i32 {
    let (lanes, friction) = (law.lanes::<R>(), friction.lanes::<R>());
    let law = Yarn { elastic: &lanes, friction: &friction };
    let mut worst = R::splat(0.0);
    // Of one point alone the compiler then knows that there is no loop.
    let (registers, mut first) = (if R::ALONE { 1 } else { block.n.div_ceil(R::COUNT) }, 0);
    // Without a way out before the first turn: it would be taken before the stack frame is made, and LLVM's probes of a
    // frame of more than eight pages overwrite r11, which may hold n by then.
    loop {
        let left = registers - first;
        let count = match left {
            _ if R::ALONE => 1, // and that it needs no arrays
            0..=STAGED => left,
            // Two groups of the same size take less time than a large and a small one.
            _ if left <= 2 * STAGED => left.div_ceil(2),
            _ => STAGED,
        };
        // SAFETY: count ≤ STAGED, and (first + count − 1) COUNT < n, `registers` being n/COUNT rounded up; a group has
        // two registers at least, unless it is the whole block.
        unsafe { evaluate_group::<T, R, WANT>(law, block, first * R::COUNT, count, &mut worst) };
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

/// The number of registers of points that go through a stage before the next one. The operations of one point wait for
/// one another, so that the processor needs several points to work on, and a whole evaluation is too long for it to
/// look ahead to the next point.
pub(super) const STAGED: usize = 6;

/// The law, and the friction of one with [`FRICTION`].
#[derive(Clone, Copy)]
struct Yarn<'a, R> {
    elastic: &'a Hyperelastic<R>,
    friction: &'a Friction<R>,
}

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
    /// As for [`get`](Self::get).
    #[inline(always)]
    unsafe fn get_mut(&mut self, k: usize) -> &mut X {
        // SAFETY: see `get`.
        unsafe { self.0.get_unchecked_mut(k).assume_init_mut() }
    }

    /// # Safety
    /// [`put`](Self::put) has been called for k.
    #[inline(always)]
    unsafe fn get(&self, k: usize) -> &X {
        // SAFETY: `put` has written entry k, which is below STAGED for it.
        unsafe { self.0.get_unchecked(k).assume_init_ref() }
    }
}

/// The results that only the next stage reads. They share one place, since the results of all stages have to stay in
/// the first-level cache together with the data of the points.
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
/// As for [`sweep`], with count ≤ STAGED; i + (count − 1) COUNT < n, and if the last register is not full, there are
/// two.
#[inline(always)]
unsafe fn evaluate_group<T: Scalar, R: Lanes<T>, const WANT: u8>(
    law: Yarn<'_, R>,
    block: &Points<T>,
    i: usize,
    count: usize,
    worst: &mut R,
) {
    let places = &mut Stage::new();
    // SAFETY: `staged` has the same requirements; a place and a frame are put for each of the registers.
    unsafe {
        for k in 0..count {
            places.put(k, place::<T, R>(block, i, k));
        }
        // `const`, so that each kernel is compiled in its own axes alone.
        if const { WANT & ALIGNED != 0 } {
            staged::<T, R, FirstAxis, WANT>(&Group { law, block, i, count, places, axes: FirstAxis }, worst);
        } else {
            let mut axes = Stage::new();
            let own = !block.fibre[0].is_null();
            if own {
                for k in 0..count {
                    axes.put(k, own_frame::<T, R>(block, *places.get(k)));
                }
            } else {
                axes.put(0, (law.elastic.frame, R::splat(0.0).le(R::splat(0.0))));
            }
            let axes = Frames { axes: &axes, own };
            staged::<T, R, _, WANT>(&Group { law, block, i, count, places, axes }, worst);
        }
    }
}

/// The first point of register `k` of the group that begins at point `i`: of the last one, a point of the register
/// before it if fewer than COUNT points are left.
#[inline(always)]
fn place<T, R: Lanes<T>>(block: &Points<T>, i: usize, k: usize) -> usize {
    if R::ALONE { 0 } else { (i + k * R::COUNT).min(block.n - R::COUNT) }
}

/// The axes of each register of a group, and where they are usable: `None` for everywhere.
trait GroupAxes<R: Real> {
    type Axes: Axes<R>;

    /// # Safety
    /// k is below the number of registers in the group.
    unsafe fn get(&self, k: usize) -> (Self::Axes, Option<R::Mask>);
}

/// The coordinate axes.
impl<R: Real> GroupAxes<R> for FirstAxis {
    type Axes = FirstAxis;
    #[inline(always)]
    unsafe fn get(&self, _: usize) -> (FirstAxis, Option<R::Mask>) {
        (FirstAxis, None)
    }
}

/// Frames of the registers, or, if no point has a direction of its own, one for all.
#[derive(Clone, Copy)]
struct Frames<'a, R: Real> {
    axes: &'a Stage<(FibreFrame<R>, R::Mask)>,
    own: bool,
}

impl<R: Real> GroupAxes<R> for Frames<'_, R> {
    type Axes = FibreFrame<R>;
    #[inline(always)]
    unsafe fn get(&self, k: usize) -> (FibreFrame<R>, Option<R::Mask>) {
        // SAFETY: a frame has been put for every register of the group, or for the first one.
        let (frame, usable) = *unsafe { self.axes.get(if self.own { k } else { 0 }) };
        (frame, Some(usable))
    }
}

/// `count` registers of points, the first of which is point `i`.
struct Group<'a, T, R, A> {
    law: Yarn<'a, R>,
    block: &'a Points<T>,
    i: usize,
    count: usize,
    /// The first point of each register.
    places: &'a Stage<usize>,
    axes: A,
}

/// The results of the stages of a group. Each is an array of its own: in one, a store to a stage would stand in the way
/// of loads from the others.
struct Stages<'a, R: Real, K> {
    stretches: &'a mut Stage<Stretch<R>>,
    /// Images of the axes, as [`Axes::keep`] stores them.
    kept: &'a mut Stage<K>,
    /// The section as the deformation makes it, a and b of the one whose distortion has energy, and the strain.
    sections: &'a mut Stage<Section<R>>,
    images: &'a mut Stage<[[R; 3]; 2]>,
    steps: &'a mut Stage<Step<R>>,
    strains: &'a mut Stage<Strain<R>>,
    outcomes: &'a mut Stage<Outcome<R>>,
    slides: &'a mut Slides<R>,
}

impl<R: Real, K> Stages<'_, R, K> {
    /// Whether any of the fibres have slid before.
    #[inline(always)]
    fn have_slid<const SLID: u8>(&self) -> bool {
        match SLID {
            NEVER => false,
            BEFORE => true,
            _ => self.slides.any_before,
        }
    }

    /// The sections whose distortion has energy.
    #[inline(always)]
    fn elastic<const SLID: u8>(&self) -> &Stage<Section<R>> {
        if self.have_slid::<SLID>() { &self.slides.sections } else { self.sections }
    }

    /// a and b of the sections as the deformation makes them; in kernels that need them, see [`needs_whole`].
    #[inline(always)]
    fn whole_images<const WANT: u8, const SLID: u8>(&self) -> &Stage<[[R; 3]; 2]> {
        if needs_whole::<WANT>() && self.have_slid::<SLID>() { &self.slides.images } else { self.images }
    }
}

/// Whether fibres have slid before: a group goes one of two ways through all stages, or looks it up in each.
const NEVER: u8 = 0;
const BEFORE: u8 = 1;
const LOOKED_UP: u8 = 2;

/// Whether a and b of a section as the deformation makes it are needed besides those of its axes that have slid: for
/// the stress by mode, the wave speed, the longitudinal shear and the tangent.
const fn needs_whole<const WANT: u8>() -> bool {
    WANT & (ANY | EXPLICIT | SHEAR) != 0
}

/// What a law with friction keeps besides.
struct Slides<R: Real> {
    /// Of one point alone, whose numbers are in the processor's registers: F m, (F − χ1) t1 and (F − χ1) t2, δ2 and δ3,
    /// and what it has remembered.
    vectors: Stage<[[R; 3]; 3]>,
    rests: Stage<[[R; 3]; 2]>,
    old: Stage<(Slip<R>, R)>,
    /// And the distortion of its whole section where it has slid before.
    i_td: Stage<R>,
    /// Where any of the fibres have slid before: the axes that the distortion is referred to, the section whose
    /// distortion has energy, and a and b and the distortion of the section as the deformation makes it.
    axes: Stage<Unimodular<R>>,
    sections: Stage<Section<R>>,
    images: Stage<[[R; 3]; 2]>,
    distortions: Stage<AsinhAlone<R>>,
    holds: Stage<Hold<R>>,
    slips: Stage<Slip<R>>,
    /// Whether any of the fibres slide.
    any: bool,
    /// Whether any of them have slid before. If none have, the whole section is the one whose distortion has energy.
    any_before: bool,
}

/// Evaluates a group, stage by stage.
///
/// # Safety
/// As for [`evaluate_group`].
#[inline(always)]
unsafe fn staged<T: Scalar, R: Lanes<T>, A: GroupAxes<R>, const WANT: u8>(group: &Group<'_, T, R, A>, worst: &mut R) {
    let mut slides = Slides {
        vectors: Stage::new(),
        rests: Stage::new(),
        old: Stage::new(),
        i_td: Stage::new(),
        sections: Stage::new(),
        images: Stage::new(),
        distortions: Stage::new(),
        holds: Stage::new(),
        slips: Stage::new(),
        axes: Stage::new(),
        any: false,
        any_before: false,
    };
    let mut stages = Stages {
        stretches: &mut Stage::new(),
        kept: &mut Stage::new(),
        sections: &mut Stage::new(),
        images: &mut Stage::new(),
        steps: &mut Stage::new(),
        strains: &mut Stage::new(),
        outcomes: &mut Stage::new(),
        slides: &mut slides,
    };
    // SAFETY: as the caller promises.
    unsafe {
        if const { WANT & FRICTION == 0 } {
            return evaluate::<T, R, A, WANT, NEVER>(group, &mut stages, worst);
        }
        group.recall_slip(&mut stages);
        // The kernel for any request is large, and compiled once for both ways.
        if const { !R::ALONE && WANT & ANY != 0 } {
            return evaluate::<T, R, A, WANT, LOOKED_UP>(group, &mut stages, worst);
        }
        match stages.slides.any_before {
            true => evaluate::<T, R, A, WANT, BEFORE>(group, &mut stages, worst),
            false => evaluate::<T, R, A, WANT, NEVER>(group, &mut stages, worst),
        }
    }
}

/// The stages of a group whose slip has been recalled.
///
/// # Safety
/// As for [`evaluate_group`].
#[inline(always)]
unsafe fn evaluate<T: Scalar, R: Lanes<T>, A: GroupAxes<R>, const WANT: u8, const SLID: u8>(
    group: &Group<'_, T, R, A>,
    stages: &mut Stages<'_, R, Kept<R, A>>,
    worst: &mut R,
) {
    let Group { block, i, count, .. } = *group;
    // If the block has no array for the status codes or the active points, these are stored to a scratch array, which
    // costs less than a test at every store. They have WIDEST ≥ COUNT values for each k, and i ≤ at(k) ≤ i + k COUNT,
    // so that i may be subtracted from their addresses.
    let mut no_status = [MaybeUninit::<i32>::uninit(); STAGED * WIDEST];
    let status =
        if block.status.is_null() { no_status.as_mut_ptr().cast::<i32>().wrapping_sub(i) } else { block.status };
    let mut no_active = [const { MaybeUninit::<T>::uninit() }; STAGED * WIDEST];
    let active = if block.active.is_null() { no_active.as_mut_ptr().cast::<T>().wrapping_sub(i) } else { block.active };
    // SAFETY: as the caller promises; each function reads what the ones before have put.
    unsafe {
        group.kinematics::<WANT, SLID>(stages);
        group.strains::<WANT, SLID>(stages);
        if const { WANT & FRICTION != 0 } {
            group.hold::<SLID>(stages);
        }
        group.respond::<WANT, SLID>(stages, status);
        if group.any_invalid::<WANT>(stages) {
            if R::ALONE {
                block.keep_old_state_of_one(parts::<WANT>());
            }
            group.report::<WANT>(stages, status, worst);
        }
        if WANT & (STATE | ANY) != 0 {
            group.store::<WANT, SLID>(stages, active);
        }
        if const { has_tangent::<WANT>() } && !block.tangent.is_null() {
            for k in 0..count {
                clear_tangent(block, group.at(k), stages.outcomes.get(k));
            }
        }
    }
}

/// The stages. For all of them:
///
/// # Safety
/// As for [`evaluate_group`], after those that stand before it; k < count ≤ STAGED in every loop, and at(k) + COUNT ≤
/// n.
impl<T: Scalar, R: Lanes<T>, A: GroupAxes<R>> Group<'_, T, R, A> {
    /// The first point of register k.
    #[inline(always)]
    unsafe fn at(&self, k: usize) -> usize {
        // SAFETY: see above; `evaluate_group` has put all places.
        unsafe { *self.places.get(k) }
    }

    /// F m, (F − χ1) t1 and (F − χ1) t2 of register k.
    #[inline(always)]
    unsafe fn images(&self, stages: &Stages<'_, R, Kept<R, A>>, k: usize) -> [[R; 3]; 3] {
        // SAFETY: see above.
        unsafe {
            if R::ALONE {
                return *stages.slides.vectors.get(k);
            }
            let (n, d) = (self.axes.get(k).0, stages.stretches.get(k));
            n.recall(stages.kept.get(k), &gradient(self.block, self.at(k)), d)
        }
    }

    /// Fibre stretch and section.
    #[inline(always)]
    unsafe fn kinematics<const WANT: u8, const SLID: u8>(&self, stages: &mut Stages<'_, R, Kept<R, A>>) {
        let mut slipped = R::never();
        // SAFETY: see above.
        unsafe {
            for k in 0..self.count {
                let n = self.axes.get(k).0;
                let (stretch, vectors) = Stretch::new(&gradient(self.block, self.at(k)), &n);
                stages.stretches.put(k, stretch);
                match R::ALONE {
                    true => stages.slides.vectors.put(k, vectors),
                    false => stages.kept.put(k, n.keep(vectors)),
                }
            }
            for k in 0..self.count {
                let d = stages.stretches.get(k);
                let rests = Section::rests(d, self.images(stages, k));
                self.put_section::<WANT, SLID>(stages, k, rests);
                slipped = slipped | stages.sections.get(k).slipped_far(stages.stretches.get(k));
            }
            // Far slips are seldom, so that there is one test for all.
            if R::any(slipped) {
                for k in 0..self.count {
                    let (n, d) = (self.axes.get(k).0, stages.stretches.get(k));
                    let far = stages.sections.get(k).slipped_far(d);
                    let rests = Section::orthogonal_rests(d, self.images(stages, k), &n, far);
                    self.put_section::<WANT, SLID>(stages, k, rests);
                }
            }
            // The axes of one point take long, and fewer operations wait for them if all that need none come before.
            if R::ALONE && SLID == BEFORE {
                let (whole, rests) = (*stages.sections.get(0), *stages.slides.rests.get(0));
                self.put_slid(stages, 0, &whole, rests);
            }
        }
    }

    /// The section of register k, from δ2 and δ3, which one point alone keeps for [`put_slid`](Self::put_slid).
    #[inline(always)]
    unsafe fn put_section<const WANT: u8, const SLID: u8>(
        &self,
        stages: &mut Stages<'_, R, Kept<R, A>>,
        k: usize,
        rests: [[R; 3]; 2],
    ) {
        // SAFETY: see above.
        unsafe {
            let (n, d) = (self.axes.get(k).0, stages.stretches.get(k));
            let (section, vectors) = Section::from_rests(d, rests, &n);
            stages.sections.put(k, section);
            if !(WANT & FRICTION != 0 && stages.have_slid::<SLID>()) {
                stages.images.put(k, vectors);
                return;
            }
            if needs_whole::<WANT>() {
                stages.slides.images.put(k, vectors);
            }
            match R::ALONE {
                true => stages.slides.rests.put(k, rests),
                false => self.put_slid(stages, k, &section, rests),
            }
        }
    }

    /// What is left of a section whose fibres have slid.
    #[inline(always)]
    unsafe fn put_slid(
        &self,
        stages: &mut Stages<'_, R, Kept<R, A>>,
        k: usize,
        whole: &Section<R>,
        rests: [[R; 3]; 2],
    ) {
        // SAFETY: see above.
        unsafe {
            let (n, d) = (self.axes.get(k).0, stages.stretches.get(k));
            let (section, vectors) = whole.referred_to(stages.slides.axes.get(k), d, rests, &n);
            stages.slides.sections.put(k, section);
            stages.images.put(k, vectors);
        }
    }

    /// Whether any of the fibres have slid before, and their axes, whose roots then come beside those of the
    /// kinematics.
    #[inline(always)]
    unsafe fn recall_slip(&self, stages: &mut Stages<'_, R, Kept<R, A>>) {
        let mut slid = R::never();
        // SAFETY: see above.
        unsafe {
            for k in 0..self.count {
                let old = remembered::<T, R>(self.block, self.at(k));
                if R::ALONE {
                    stages.slides.old.put(k, old);
                }
                slid = slid | old.0.is_any();
            }
            stages.slides.any_before = R::any(slid);
            if stages.slides.any_before {
                for k in 0..self.count {
                    stages.slides.axes.put(k, self.old(stages, k).0.axes());
                }
            }
        }
    }

    /// What register k has remembered.
    #[inline(always)]
    unsafe fn old(&self, stages: &Stages<'_, R, Kept<R, A>>, k: usize) -> (Slip<R>, R) {
        // SAFETY: see above.
        unsafe { if R::ALONE { *stages.slides.old.get(k) } else { remembered::<T, R>(self.block, self.at(k)) } }
    }

    /// The invariants, and the power of the compaction.
    #[inline(always)]
    unsafe fn strains<const WANT: u8, const SLID: u8>(&self, stages: &mut Stages<'_, R, Kept<R, A>>) {
        let (law, block) = (self.law.elastic, self.block);
        let (state, stride) = (WANT & (STATE | ANY) != 0, block.leading_dimension);
        // SAFETY: see above.
        unsafe {
            for k in 0..self.count {
                let (d, section) = (stages.stretches.get(k), stages.elastic::<SLID>().get(k));
                if R::ALONE && SLID == BEFORE {
                    // Both distortions side by side.
                    let logarithms = Logarithms::of_both(d, section, stages.sections.get(k));
                    let (strain, whole) = Strain::of_both(d, section, &logarithms);
                    stages.strains.put(k, strain);
                    stages.slides.i_td.put(k, whole);
                    continue;
                }
                let mut logarithms = Logarithms::new(d, section);
                if WANT & FRICTION != 0 && stages.have_slid::<SLID>() {
                    let distortion = logarithms.beside(stages.sections.get(k));
                    stages.slides.distortions.put(k, distortion.alone());
                }
                stages.steps.put(k, Step { logarithms });
            }
            for k in 0..self.count {
                if !(R::ALONE && SLID == BEFORE) {
                    let (d, section) = (stages.stretches.get(k), stages.elastic::<SLID>().get(k));
                    stages.strains.put(k, Strain::new(d, section, &stages.steps.get(k).logarithms));
                }
                if !R::ALONE {
                    for column in block.stress {
                        R::prefetch(column.wrapping_add(self.at(k)));
                    }
                }
            }
            for k in 0..self.count {
                stages.steps.put(k, Step { power: law.compaction(stages.strains.get(k)) });
                prefetch::<T, R, 4>(state, block.state_new[ENERGIES], stride, self.at(k));
            }
            for k in 0..self.count {
                stages.steps.put(k, Step { reduced: stages.steps.get(k).power.reduce(&law.exponent) });
                prefetch::<T, R, 4>(state, block.state_new[INVARIANTS], stride, self.at(k));
            }
            for k in 0..self.count {
                stages.steps.put(k, Step { powered: stages.steps.get(k).reduced.finish() });
                prefetch::<T, R, 3>(state, block.state_new[FAILURE], stride, self.at(k));
            }
        }
    }

    /// What friction holds of the distortion, and the slip where it holds less.
    #[inline(always)]
    unsafe fn hold<const SLID: u8>(&self, stages: &mut Stages<'_, R, Kept<R, A>>) {
        let Yarn { elastic: law, friction } = self.law;
        let mut sliding = R::never();
        // SAFETY: see above.
        unsafe {
            for k in 0..self.count {
                let (d, powered) = (stages.stretches.get(k), stages.steps.get(k).powered);
                let section = *stages.elastic::<SLID>().get(k);
                let factors = law.kirchhoff(d, stages.strains.get(k), powered);
                let hold = friction.hold(law, &section, stages.strains.get_mut(k), &factors);
                sliding = sliding | hold.slides;
                stages.slides.holds.put(k, hold);
            }
            stages.slides.any = R::any(sliding);
            if stages.slides.any {
                for k in 0..self.count {
                    let (old, old_i_te) = self.old(stages, k);
                    let (whole, section) = (stages.sections.get(k), stages.elastic::<SLID>().get(k));
                    let (i_te, hold) = (stages.strains.get(k).i_td, stages.slides.holds.get(k));
                    let slip = friction.slid(law, (&old, old_i_te), whole, section, i_te, hold);
                    stages.slides.slips.put(k, slip);
                }
            } else if R::ALONE {
                stages.slides.slips.put(0, self.old(stages, 0).0);
            }
        }
    }

    /// The factors of the stress of register k.
    #[inline(always)]
    unsafe fn factors<const WANT: u8>(&self, stages: &Stages<'_, R, Kept<R, A>>, k: usize) -> Kirchhoff<R> {
        // SAFETY: see above.
        unsafe {
            let powered = stages.steps.get(k).powered;
            let factors = self.law.elastic.kirchhoff(stages.stretches.get(k), stages.strains.get(k), powered);
            if WANT & FRICTION == 0 {
                return factors;
            }
            Kirchhoff { distortion: stages.slides.holds.get(k).distortion, ..factors }
        }
    }

    /// Stress, modes, wave speed and tangent, and a status of 0.
    #[inline(always)]
    unsafe fn respond<const WANT: u8, const SLID: u8>(&self, stages: &mut Stages<'_, R, Kept<R, A>>, status: *mut i32) {
        let zero = R::splat(0.0);
        // SAFETY: see above.
        unsafe {
            for k in 0..self.count {
                let strain = stages.strains.get(k);
                let mut nan_if_invalid = match self.axes.get(k).1 {
                    Some(usable) => R::select(usable, strain.nan_if_invalid, R::splat(f64::NAN)),
                    None => strain.nan_if_invalid,
                };
                let [fibre, ..] = self.images(stages, k);
                let &[a, b] = stages.images.get(k);
                let mut kinematics = Kinematics {
                    stretch: stages.stretches.get(k),
                    section: stages.elastic::<SLID>().get(k),
                    images: [fibre, a, b],
                    strain,
                    slid: None,
                };
                let slid;
                if WANT & FRICTION != 0 {
                    let (old, old_i_te) = self.old(stages, k);
                    nan_if_invalid = (old_i_te + old.lost).mul_add(zero, nan_if_invalid);
                    slid = Slid {
                        whole: stages.sections.get(k),
                        images: *stages.whole_images::<WANT, SLID>().get(k),
                        axes: old.axes(),
                        slides: stages.slides.holds.get(k).slides,
                        mu: self.law.friction.mu(),
                    };
                    kinematics.slid = Some(&slid);
                }
                let factors = self.factors::<WANT>(stages, k);
                let law = self.law.elastic;
                let outcome = respond::<T, R, WANT>(law, self.block, self.at(k), kinematics, &factors, nan_if_invalid);
                zero.store_integers(status.wrapping_add(self.at(k)));
                stages.outcomes.put(k, outcome);
            }
        }
    }

    /// Whether any point has failed before or cannot be evaluated. These are rare, so that there is one test for all.
    #[inline(always)]
    #[allow(clippy::eq_op)] // A number minus itself is 0, unless it is NaN or infinite.
    unsafe fn any_invalid<const WANT: u8>(&self, stages: &Stages<'_, R, Kept<R, A>>) -> bool {
        if R::ALONE {
            // What it has remembered is not needed but where it is kept.
            // SAFETY: see above.
            return unsafe { stages.outcomes.get(0).is_kept() };
        }
        let mut check = R::splat(0.0);
        for k in 0..self.count {
            // SAFETY: see above.
            unsafe {
                let latch_or_nan = stages.outcomes.get(k).latch_or_nan;
                check = add_to_check::<T, R, WANT>(self.block, self.at(k), latch_or_nan, check);
            }
        }
        R::any(!(check - check).le(R::splat(0.0)))
    }

    /// The status codes of points that cannot be evaluated, and what becomes of them.
    #[inline(always)]
    unsafe fn report<const WANT: u8>(&self, stages: &Stages<'_, R, Kept<R, A>>, status: *mut i32, worst: &mut R) {
        let (block, zero) = (self.block, R::splat(0.0));
        // All codes before the first reset, which changes the old state that the codes depend on.
        let mut codes = Stage::new();
        // SAFETY: see above.
        unsafe {
            for k in 0..self.count {
                let usable = self.axes.get(k).1.unwrap_or(zero.le(zero));
                let (law, outcome) = (self.law.elastic, stages.outcomes.get(k));
                let d = stages.stretches.get(k);
                codes.put(k, status_code::<T, R, WANT>(law, block, self.at(k), d, usable, outcome));
            }
            for k in 0..self.count {
                let code: R = *codes.get(k);
                reset_invalid::<T, R, WANT>(block, self.at(k), stages.outcomes.get(k));
                code.store_integers(status.wrapping_add(self.at(k)));
                *worst = R::select(code.lt(*worst), code, *worst);
            }
        }
    }

    /// The new state, and which points are active.
    #[inline(always)]
    unsafe fn store<const WANT: u8, const SLID: u8>(&self, stages: &Stages<'_, R, Kept<R, A>>, active: *mut T) {
        // SAFETY: see above.
        unsafe {
            for k in 0..self.count {
                let mut point = Evaluated {
                    stretch: stages.stretches.get(k),
                    strain: stages.strains.get(k),
                    factors: self.factors::<WANT>(stages, k),
                    friction: None,
                };
                if WANT & FRICTION != 0 {
                    let slides = &*stages.slides;
                    let slip = if slides.any || R::ALONE { Some(slides.slips.get(k)) } else { None };
                    let i_td = match stages.have_slid::<SLID>() {
                        true if R::ALONE => *slides.i_td.get(k),
                        true => slides.distortions.get(k).finish(),
                        false => slides.holds.get(k).trial,
                    };
                    point.friction = Some(Remembered { i_td, slip });
                }
                let outcome = stages.outcomes.get(k);
                let is_active = store_state::<T, R, WANT>(self.law.elastic, self.block, self.at(k), &point, outcome);
                is_active.store(active.wrapping_add(self.at(k)));
            }
        }
    }
}

/// What the axes of a group keep of the images.
type Kept<R, A> = <<A as GroupAxes<R>>::Axes as Axes<R>>::Kept;
