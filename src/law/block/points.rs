//! Points as hosts hold them: a pointer for each array, or each component.

use core::ptr::{null, null_mut};

use super::dispatch::Precision;
use crate::law::description::Reads;
use crate::law::error::{Error, Value};
use crate::law::failure::Failure;
use crate::law::interface::Law;
use crate::law::linear_elastic::{Criterion, Rotation};
use crate::law::number::level::Level;
use crate::law::number::real::{Real, Scalar};
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

/// When a step is, and how warm its points are. Each is read only by a law whose description says so.
#[derive(Clone, Copy, Debug)]
pub struct Circumstances<T> {
    /// The length of the step, and the time at its end; NaN if the host does not know.
    pub time_increment: f64,
    pub time: f64,
    /// The temperature of each point at the end of the step; null if the host does not know.
    pub temperature: *const T,
}

impl<T> Circumstances<T> {
    /// Those of a host that knows none.
    pub const UNKNOWN: Self = Circumstances { time_increment: f64::NAN, time: f64::NAN, temperature: null() };

    /// Those of the points from `first` on.
    pub(crate) fn from(self, first: usize) -> Self {
        let temperature = self.temperature;
        Circumstances {
            temperature: if temperature.is_null() { temperature } else { temperature.wrapping_add(first) },
            ..self
        }
    }

    /// Checks that the host knows what the law reads.
    ///
    /// # Errors
    /// A number that is needed and not finite, a step of negative length, no temperatures.
    #[inline(always)]
    fn check(&self, reads: &Reads, n: usize) -> Result<(), Error> {
        let Reads { time_increment, time, temperature, .. } = *reads;
        if time_increment || time || temperature { self.check_those_read(reads, n) } else { Ok(()) }
    }

    /// # Errors
    /// As for [`check`](Self::check).
    #[inline(never)]
    fn check_those_read(&self, reads: &Reads, n: usize) -> Result<(), Error> {
        let wrong = |name, value: f64, wanted| Err(Error::Argument { name, value: Value::of(value), wanted });
        let unknown = |text| Err(Error::Setting { code: status::BAD_ARGUMENT, text });
        if reads.time_increment && self.time_increment.is_nan() {
            return unknown("argument time_increment is not known here, and this law reads it");
        }
        if reads.time && self.time.is_nan() {
            return unknown("argument time is not known here, and this law reads it");
        }
        if reads.time_increment && !(0.0 <= self.time_increment && self.time_increment < f64::INFINITY) {
            return wrong("time_increment", self.time_increment, "a finite number, not negative");
        }
        if reads.time && !self.time.is_finite() {
            return wrong("time", self.time, "a finite number");
        }
        if reads.temperature && n > 0 && self.temperature.is_null() {
            return unknown("argument temperature is not known here, and this law reads it");
        }
        Ok(())
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

/// The names of an array's leading dimension and stride, for messages.
macro_rules! distances {
    ($array:literal) => {
        [concat!("leading dimension of ", $array), concat!("stride of ", $array)]
    };
}
pub(crate) use distances;

/// The pointers to the components of a component-major array; all null if `array` is.
#[inline(always)]
pub fn components<T, const N: usize>(array: *const T, leading_dimension: usize) -> [*const T; N] {
    let (mut pointers, mut c) = ([array; N], 1);
    while c < N && !array.is_null() {
        pointers[c] = array.wrapping_add(c.wrapping_mul(leading_dimension));
        c += 1;
    }
    pointers
}

/// The same for an array to be written.
#[inline(always)]
pub fn components_mut<T, const N: usize>(array: *mut T, leading_dimension: usize) -> [*mut T; N] {
    let (mut pointers, mut c) = ([array; N], 1);
    while c < N && !array.is_null() {
        pointers[c] = array.wrapping_add(c.wrapping_mul(leading_dimension));
        c += 1;
    }
    pointers
}

/// The pointers to the parts of a state whose rows follow one another; all null if `state` is.
#[inline(always)]
pub(crate) fn parts<T>(state: *const T, leading_dimension: usize, counts: [usize; PARTS]) -> [*const T; PARTS] {
    let (mut pointers, mut part, mut row) = ([null(); PARTS], 0, 0_usize);
    while part < PARTS {
        if counts[part] > 0 && !state.is_null() {
            pointers[part] = state.wrapping_add(row.wrapping_mul(leading_dimension));
        }
        row += counts[part];
        part += 1;
    }
    pointers
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
        self.tangent.is_null()
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

/// More points, and more numbers between two components, than any memory holds: a greater number is a negative one,
/// converted. An array of 81 components with such distances is still shorter than half the address space.
pub(crate) const MOST: usize = isize::MAX as usize >> 10;

/// Checks that the entries of an array with so many components and points are all at different places, component by
/// component or point by point, and none before its start.
///
/// # Errors
/// Entries may overlap, or are nowhere; `names` are those of the leading dimension and of the stride.
#[inline(always)]
pub(crate) fn check_layout(
    n: usize,
    components: usize,
    leading_dimension: usize,
    stride: usize,
    names: [&'static str; 2],
) -> Result<(), Error> {
    if stride == 1 && leading_dimension >= n && leading_dimension <= MOST {
        return Ok(()); // the usual layout
    }
    check_other_layout(n, components, leading_dimension, stride, names)
}

/// # Errors
/// As for [`check_layout`].
#[cold]
#[inline(never)]
fn check_other_layout(
    n: usize,
    components: usize,
    leading_dimension: usize,
    stride: usize,
    [name, of_stride]: [&'static str; 2],
) -> Result<(), Error> {
    let (code, greatest) = (status::BAD_LEADING_DIMENSION, MOST / n.max(1));
    for (name, value, greatest) in [(of_stride, stride, greatest), (name, leading_dimension, MOST)] {
        if value > greatest {
            // As the caller wrote it, if it is negative.
            return Err(Error::Range { code, name, value: value as i64, least: 1, greatest: greatest as i64 });
        }
    }
    let needed = n.saturating_sub(1).saturating_mul(stride).saturating_add(1);
    let in_rows = leading_dimension > 0 && stride > (components - 1).saturating_mul(leading_dimension);
    if n == 0 || (stride > 0 || n == 1) && (leading_dimension >= needed || in_rows) {
        return Ok(());
    }
    let whole = |x: usize| i64::try_from(x).unwrap_or(i64::MAX);
    // Points in rows: it is the row that is too short.
    let (what, found, wanted) = if leading_dimension == 1 && stride > 1 {
        (of_stride, stride, components)
    } else {
        (name, leading_dimension, needed)
    };
    Err(Error::Count { code, what, found: whole(found), wanted: whole(wanted) })
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
    /// Whether points may have limits, second axes and axes of their own, and modes.
    pub limit: bool,
    pub axes: bool,
    pub modes: bool,
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
        Needs { parts, last, latch, reads, limit: L::HAS_LIMIT, axes: L::HAS_AXES, modes: L::HAS_MODES }
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
        if !needs.limit && !self.limit.is_null() {
            return refused(
                "argument limit is not null; allowed: null, since points of this law have no limits of their own",
            );
        }
        let has_axes = !self.second_axis[0].is_null() || !self.axes.is_null();
        if !needs.axes && has_axes {
            return refused(
                "second_axis or axes is not null; allowed: null, since points of this law have no axes of their own",
            );
        }
        if !needs.modes && !self.modes.is_null() {
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

    /// Whether the old state is in the arrays of the new one, as far as these are requested.
    #[inline(always)]
    pub(super) fn in_place(&self) -> bool {
        let (mut in_place, mut part) = (true, 0);
        while part < PARTS {
            let (old, new) = (self.state_old[part], self.state_new[part].cast_const());
            in_place &= new.is_null() || old == new;
            part += 1;
        }
        in_place
    }

    /// Whether there is an old state wherever a new one is requested.
    #[inline(always)]
    pub(super) fn has_old_state(&self) -> bool {
        let (mut has, mut part) = (true, 0);
        while part < PARTS {
            has &= self.state_new[part].is_null() || !self.state_old[part].is_null();
            part += 1;
        }
        has
    }

    /// Copies the old state of one point to the arrays of the new one. The old one stays where it is: kernels that work
    /// in place may read it from either.
    ///
    /// # Safety
    /// The points are valid, there is one, and it has an old state, see [`has_old_state`](Self::has_old_state).
    #[inline(always)]
    pub(super) unsafe fn keep_old_state_of_one(&self, parts: &[usize; PARTS]) {
        let mut part = 0;
        while part < PARTS {
            let (old, new, mut c) = (self.state_old[part], self.state_new[part], 0);
            while c < parts[part] && !new.is_null() {
                // SAFETY: of a valid point both arrays have the component c.
                unsafe { *new.add(c * self.leading_dimension) = *old.add(c * self.leading_dimension) };
                c += 1;
            }
            part += 1;
        }
    }

    /// Copies the old state, or zeros where there is none, to the arrays of the new one: for kernels that work in
    /// place.
    ///
    /// # Safety
    /// The points are valid and next to each other.
    pub(super) unsafe fn copy_old_state(&mut self, parts: &[usize; PARTS]) {
        let (n, stride) = (self.n, self.leading_dimension);
        for ((old, &new), &components) in self.state_old.iter_mut().zip(&self.state_new).zip(parts) {
            if new.is_null() || old.cast_mut() == new {
                continue;
            }
            for c in 0..components {
                // SAFETY: of valid points both arrays have the component c, n values from `c * stride` on, and do not
                // overlap if they are not the same. A number whose bytes are all 0 is 0.
                unsafe {
                    match old.is_null() {
                        true => new.add(c * stride).write_bytes(0, n),
                        false => new.add(c * stride).copy_from_nonoverlapping(old.add(c * stride), n),
                    }
                }
            }
            *old = new;
        }
    }
}
