//! Points as hosts hold them: a pointer for each array, or each component. Every list of the arrays that points may have
//! stands here: what checks them, copies them, passes over some of them, and tells which results they ask for.

use core::ptr::{null, null_mut};

use super::buffers::Copies;
use super::circumstances::Circumstances;
use super::dispatch::Precision;
use super::layout::{check_layout, components_mut, distances};
use crate::law::description::Reads;
use crate::law::error::Error;
use crate::law::failure::Failure;
use crate::law::interface::Law;
use crate::law::linear_elastic::{Criterion, Rotation};
use crate::law::number::level::Level;
use crate::law::number::real::{Real, Scalar};
use crate::law::response::Request;
use crate::law::state::FRICTIONAL_PARTS;
use crate::law::state::part::{ENERGIES, FAILURE, INVARIANTS};
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::wave_speed;

/// The parts that a state may be kept in, each an array of its own: those that a law does not have are null.
pub const PARTS: usize = 3;

/// Points as a host passes them: a pointer for each array, or each component. An array that is null is absent: an old
/// state is 0 then, and an output is not computed. F at the end must be there, and F at the start for a law that reads
/// it.
///
/// F, the directions and the stress have one pointer for each component, since some hosts keep components in separate
/// arrays; the other arrays are component-major with the leading dimension of their group. The old state may be in the
/// arrays of the new one. The components of each array are listed in [`block`](super).
///
/// # Safety
/// Points are **valid** if every pointer that is not null points to as many values as `n`, the leading dimensions, the
/// strides and the table of [`block`](super) say, valid for reading or writing; if with these, different entries are at
/// different places; if arrays with a pointer for each component are null in all of them or in none; and if outputs
/// overlap nothing but, exactly, the old state that they replace. [`Law::step`] is unsafe, since only its caller can
/// know this.
#[derive(Clone, Copy, Debug)]
pub struct Points<T> {
    /// The number of points.
    pub n: usize,
    /// The distance from one component to the next in the state, the modes, the axes and the tangent.
    pub leading_dimension: usize,
    pub modes_leading_dimension: usize,
    pub axes_leading_dimension: usize,
    pub tangent_leading_dimension: usize,
    /// The distance from one point to the next.
    pub strides: Strides,
    /// F at the start of the step, by columns; read only by a law whose description says so.
    pub f_old: [*const T; 9],
    /// F at its end, by columns.
    pub f_new: [*const T; 9],
    /// The fibre direction and a second axis of each point, of any length; null for those of the properties.
    pub fibre: [*const T; 3],
    pub second_axis: [*const T; 3],
    /// A failure limit of each point: the true fibre strain, ln(1 + ε_lim), of the hyperelastic law, or the strength of
    /// the linear elastic one; null or 0 for that of the properties. Read where the failure is computed.
    pub limit: *const T,
    /// When the step is, and how warm.
    pub circumstances: Circumstances<T>,
    /// The three material axes in space, one after the other, in and out; only for [`Rotation::Spin`].
    pub axes: *mut T,
    /// The law's state variables, old and new, by the parts of [`Law::PARTS`].
    pub state_old: [*const T; PARTS],
    pub state_new: [*mut T; PARTS],
    /// The reference density; read only for the wave speed.
    pub density: T,
    /// Cauchy stress 11 22 33 12 23 31.
    pub stress: [*mut T; 6],
    /// Second Piola–Kirchhoff stress by mode, of a law that has modes.
    pub modes: *mut T,
    /// A bound of the wave speed.
    pub wave_speed: *mut T,
    /// The tangent of `measure`: entry (row, column) is component 6 row + column, or 9 row + column where the measure
    /// is 9×9.
    pub tangent: *mut T,
    pub measure: Measure,
    /// A status code for each point.
    pub status: *mut i32,
    /// For each point 1, or 0 if it has failed or cannot be evaluated.
    pub active: *mut T,
    /// Choices of a law that has them.
    pub rotation: Rotation,
    pub criterion: Criterion,
    /// The instructions to use, or the best that the processor has if those are lower; `None` for the best.
    pub level: Option<Level>,
}

/// A point of the law with friction as most callers have it: each array is its own numbers next to each other, and all
/// but `fibre` are there.
///
/// # Safety
/// As for [`Points`].
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct OnePoint<T> {
    pub f: *const T,
    /// Null for that of the properties.
    pub fibre: *const T,
    pub state_old: *const T,
    pub state_new: *mut T,
    pub stress: *mut T,
}

impl<T: Scalar> OnePoint<T> {
    /// The point as a block of one.
    #[inline(always)]
    pub(super) fn points(&self) -> Points<T> {
        let &OnePoint { f, fibre, state_old, state_new, stress } = self;
        let mut points = Points::without_arrays(1, 1);
        // Loops and no closures, which would be called.
        for (c, place) in points.f_new.iter_mut().enumerate() {
            *place = f.wrapping_add(c);
        }
        for (c, place) in points.stress.iter_mut().enumerate() {
            *place = stress.wrapping_add(c);
        }
        if !fibre.is_null() {
            points.fibre = [fibre, fibre.wrapping_add(1), fibre.wrapping_add(2)];
        }
        let (second, third) = const { (FRICTIONAL_PARTS[0], FRICTIONAL_PARTS[0] + FRICTIONAL_PARTS[1]) };
        points.state_old = [state_old, state_old.wrapping_add(second), state_old.wrapping_add(third)];
        // SAFETY: part of an array that is there.
        unsafe { core::hint::assert_unchecked(!points.state_old[2].is_null()) };
        points.state_new = [state_new, state_new.wrapping_add(second), state_new.wrapping_add(third)];
        points
    }
}

/// The distance from one point to the next in each group of arrays; what has one number for a point (wave speed,
/// status, active, temperature) is contiguous.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strides {
    /// Of F at both ends.
    pub deformation_gradient: usize,
    /// Of fibre and second axis.
    pub fibre: usize,
    /// Of the failure limits.
    pub limit: usize,
    pub axes: usize,
    /// Of all parts of the state, old and new.
    pub state: usize,
    /// Of each output.
    pub stress: usize,
    pub modes: usize,
    pub tangent: usize,
}

impl Strides {
    /// Points next to each other: component-major arrays.
    pub(crate) const UNIT: Strides =
        Strides { deformation_gradient: 1, fibre: 1, limit: 1, axes: 1, state: 1, stress: 1, modes: 1, tangent: 1 };
}

impl<T> Points<T> {
    /// The limits of points that have their own, where they are read: beside a failure that is computed, which is in
    /// the part `last` of the state.
    #[inline(always)]
    pub(crate) fn limits(&self, last: usize) -> *const T {
        match self.state_new.get(last) {
            Some(new) if !new.is_null() => self.limit,
            _ => null(),
        }
    }

    /// Whether kernels that are compiled for a usual request know all arrays of these points; else they take the general
    /// kernel.
    #[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
    #[inline(always)]
    pub(super) fn are_usual(&self) -> bool {
        self.tangent.is_null() && self.modes.is_null()
    }

    /// The results that have an array.
    #[inline(always)]
    pub(super) fn request(&self) -> Request {
        Request {
            stress: !self.stress[0].is_null(),
            energies: !self.state_new[ENERGIES].is_null(),
            invariants: !self.state_new[INVARIANTS].is_null(),
            failure: !self.state_new[FAILURE].is_null(),
            modes: !self.modes.is_null(),
            wave_modulus: !self.wave_speed.is_null(),
        }
    }

    /// The points from `first` ≤ n on.
    pub(super) fn from(self, first: usize) -> Self {
        if first == 0 {
            return self;
        }
        let input = |p: *const T, stride: usize| if p.is_null() { p } else { p.wrapping_add(first * stride) };
        let output = |p: *mut T, stride: usize| if p.is_null() { p } else { p.wrapping_add(first * stride) };
        let Strides { deformation_gradient, fibre, limit, axes, state, stress, modes, tangent } = self.strides;
        Points {
            n: self.n - first,
            f_old: self.f_old.map(|p| input(p, deformation_gradient)),
            f_new: self.f_new.map(|p| input(p, deformation_gradient)),
            fibre: self.fibre.map(|p| input(p, fibre)),
            second_axis: self.second_axis.map(|p| input(p, fibre)),
            limit: input(self.limit, limit),
            circumstances: self.circumstances.from(first),
            axes: output(self.axes, axes),
            state_old: self.state_old.map(|p| input(p, state)),
            state_new: self.state_new.map(|p| output(p, state)),
            stress: self.stress.map(|p| output(p, stress)),
            modes: output(self.modes, modes),
            wave_speed: output(self.wave_speed, 1),
            tangent: output(self.tangent, tangent),
            status: if self.status.is_null() { self.status } else { self.status.wrapping_add(first) },
            active: output(self.active, 1),
            ..self
        }
    }
}

/// Which arrays points of a law may have besides those of every law.
#[derive(Clone, Copy, Debug)]
pub struct Has {
    /// Failure limits of their own, [`Points::limit`].
    pub limit: bool,
    /// A second axis, or axes that are kept, of their own: [`Points::second_axis`], [`Points::axes`].
    pub axes: bool,
    /// The stress by mode, [`Points::modes`].
    pub modes: bool,
}

impl Has {
    pub const NOTHING_ELSE: Has = Has { limit: false, axes: false, modes: false };
    /// Of both yarn laws.
    pub const YARN: Has = Has { limit: true, modes: true, ..Has::NOTHING_ELSE };
    pub const LINEAR_ELASTIC: Has = Has { limit: true, axes: true, ..Has::NOTHING_ELSE };
}

/// What a law wants of its points.
#[derive(Clone, Copy)]
pub(crate) struct Needs {
    /// The number of variables in each part of the state, and the last part that there is, which has the latch; of it
    /// an old one is read although no new one is wanted.
    pub parts: [usize; PARTS],
    pub last: usize,
    /// The place of the latch in the last part.
    pub latch: usize,
    /// What is read besides F at the end of the step and the old state.
    pub reads: Reads,
    /// What points may have.
    pub has: Has,
}

impl Needs {
    pub const fn of<T: Precision, L: Law<T>>() -> Self {
        let (description, parts) = (L::DESCRIPTION, L::PARTS);
        let (mut latch, mut last) = (description.failed, 0);
        while last + 1 < PARTS && parts[last + 1] > 0 {
            latch -= parts[last];
            last += 1;
        }
        let reads = description.reads;
        Needs { parts, last, latch, reads, has: L::HAS }
    }

    /// How many variables of a part's old state are read: in the last one those up to the latch, behind which is the
    /// flag for element deletion.
    #[inline(always)]
    pub const fn read(&self, part: usize, components: usize) -> usize {
        if part == self.last { self.latch + 1 } else { components }
    }
}

impl<T: Scalar> Points<T> {
    /// `n` points next to each other, with one leading dimension for all groups and no arrays yet: for the fields that
    /// a host does not name.
    #[inline(always)]
    pub fn without_arrays(n: usize, leading_dimension: usize) -> Self {
        Points {
            n,
            leading_dimension,
            modes_leading_dimension: leading_dimension,
            axes_leading_dimension: leading_dimension,
            tangent_leading_dimension: leading_dimension,
            strides: Strides::UNIT,
            f_old: [null(); 9],
            f_new: [null(); 9],
            fibre: [null(); 3],
            second_axis: [null(); 3],
            limit: null(),
            circumstances: Circumstances::UNKNOWN,
            axes: null_mut(),
            state_old: [null(); PARTS],
            state_new: [null_mut(); PARTS],
            density: T::splat(0.0),
            stress: [null_mut(); 6],
            modes: null_mut(),
            wave_speed: null_mut(),
            tangent: null_mut(),
            measure: Measure::Jaumann,
            status: null_mut(),
            active: null_mut(),
            rotation: Rotation::Fibre,
            criterion: Criterion::LargestPrincipal,
            level: None,
        }
    }

    /// The points from `first` on, `count` at most, without their outputs: what their status depends on.
    pub(super) fn inputs(&self, first: usize, count: usize, needs: &Needs) -> Self {
        let from = self.from(first);
        let mut state_old = [null(); PARTS];
        state_old[needs.last] = from.state_old[needs.last];
        Points {
            n: from.n.min(count),
            axes: null_mut(),
            state_old,
            state_new: [null_mut(); PARTS],
            stress: [null_mut(); 6],
            modes: null_mut(),
            wave_speed: null_mut(),
            tangent: null_mut(),
            status: null_mut(),
            active: null_mut(),
            ..from
        }
    }

    /// Whether point `i` is intact and has a limit that means nothing.
    ///
    /// # Safety
    /// The points are valid and i < n.
    pub(super) unsafe fn has_wrong_limit(&self, i: usize, needs: &Needs) -> bool
    where
        T: Real<Mask = bool>,
    {
        let old = self.state_old.get(needs.last).copied().unwrap_or(null());
        // SAFETY: of valid points an array that is not null has an entry for each point, the old state's latch too.
        unsafe {
            let latch = old.wrapping_add(needs.latch * self.leading_dimension + i * self.strides.state);
            let (limits, intact) = (self.limits(needs.last), old.is_null() || Failure::intact(*latch));
            intact && !limits.is_null() && !Failure::is_limit(*limits.add(i * self.strides.limit))
        }
    }

    /// Checks that what a law needs is there, nothing that it does not have, and that no entries of an array overlap.
    ///
    /// # Errors
    /// As for [`Law::step`].
    #[inline(always)]
    pub(crate) fn check(&self, needs: &Needs) -> Result<(), Error> {
        let missing = |array: &[*const T]| self.n > 0 && array.iter().any(|pointer| pointer.is_null());
        if needs.reads.old_gradient && missing(&self.f_old) {
            return Err(Error::Null { name: "f_old" });
        }
        if missing(&self.f_new) {
            return Err(Error::Null { name: "f_new" });
        }
        let refused = |text| Err(Error::Setting { code: status::BAD_ARGUMENT, text });
        if !needs.has.limit && !self.limit.is_null() {
            return refused(
                "argument limit is not null; allowed: null, since points of this law have no limits of their own",
            );
        }
        let has_axes = !self.second_axis[0].is_null() || !self.axes.is_null();
        if !needs.has.axes && has_axes {
            return refused(
                "second_axis or axes is not null; allowed: null, since points of this law have no axes of their own",
            );
        }
        if !needs.has.modes && !self.modes.is_null() {
            return refused("argument modes is not null; allowed: null, since this law has no stress by mode");
        }
        self.circumstances.check(&needs.reads, self.n)?;
        let Strides { limit, axes, state, modes, tangent, .. } = self.strides;
        if !self.limits(needs.last).is_null() {
            check_layout(self.n, 1, self.n, limit, distances!("limit"))?;
        }
        let (mut components, mut part) = (0, 0);
        while part < PARTS {
            if !self.state_old[part].is_null() || !self.state_new[part].is_null() {
                components = needs.parts[part].max(components);
            }
            part += 1;
        }
        if components > 0 {
            check_layout(self.n, components, self.leading_dimension, state, distances!("the state"))?;
        }
        if !self.axes.is_null() {
            check_layout(self.n, 9, self.axes_leading_dimension, axes, distances!("axes"))?;
        }
        if !self.modes.is_null() {
            check_layout(self.n, 24, self.modes_leading_dimension, modes, distances!("modes"))?;
        }
        if !self.tangent.is_null() {
            let components = self.measure.components();
            check_layout(self.n, components, self.tangent_leading_dimension, tangent, distances!("tangent"))?;
        }
        if self.n > 0 && !self.wave_speed.is_null() {
            wave_speed::check_density(self.density)?;
        }
        Ok(())
    }

    /// The instructions to use.
    #[inline(always)]
    pub(crate) fn level(&self) -> Level {
        self.level.unwrap_or(Level::Avx512).min(Level::best())
    }
}

/// How many numbers a point of every law takes in copies: F, fibre, limit, temperature, stress, wave speed and
/// `active`; and with modes and the largest tangent. A law's state is added to them, and what else its points have, see
/// [`Kernels::Else`](super::run::Kernels::Else).
pub(super) const FEW: usize = 9 + 3 + 1 + 1 + 6 + 1 + 1;
pub(super) const ALL: usize = FEW + 24 + 81;

/// All numbers of a point of a law with so many variables, and so many numbers of [`Kernels::Else`](super::run::Kernels::Else).
pub(super) const fn rows(state: usize, other: usize) -> usize {
    ALL + state + other
}

impl<T: Scalar> Points<T> {
    /// These points in `copies`, with the arrays that they have; the old state is in the place of the new one. An input
    /// has a line here, an output one here and one in [`take_results`](Self::take_results).
    ///
    /// # Safety
    /// The points are valid, see [`Points`], and checked; there is room for all numbers of each copy.
    #[inline(always)]
    pub(super) unsafe fn read_into<C: Copies<T>>(&self, copies: &mut C, codes: *mut i32, needs: &Needs) -> Points<T> {
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
    pub(super) unsafe fn take_results<C: Copies<T>>(&self, of: &Points<T>, copies: &C, needs: &Needs) {
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
