//! A block of points as hosts hold it: a pointer for each array, or each component.

use core::ptr::{null, null_mut};

use crate::law::error::Error;
use crate::law::failure::Failure;
use crate::law::number::level::Level;
use crate::law::number::real::{Real, Scalar};
use crate::law::response::Request;
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::wave_speed;

/// A block as a host passes it; an array is absent if its pointer is null.
///
/// The deformation gradient, the fibre direction and the stress have one pointer for each component, since some hosts keep
/// components in separate arrays; the other arrays are component-major with the leading dimension. `energies_old`,
/// `invariants_old` and `failure_old` are the old state, which is fresh (all 0) if they are null; they may be the same arrays
/// as the new ones. The components of each array are listed in [`block`](super).
///
/// # Safety
/// A block is **valid** if every pointer that is not null points to as many values as `n`, the leading dimensions, the strides and
/// the table of [`block`](super) say, valid for reading or writing; if with these, different entries are at different places; if
/// `stress` and `fibre` are null in all their components or in none; and if outputs overlap nothing but, exactly, the old state that
/// they replace. The functions that evaluate a block are unsafe, since only its caller can know this.
#[derive(Clone, Copy, Debug)]
pub struct Pointers<T> {
    /// The number of points.
    pub n: usize,
    /// The distance from one component to the next in the energies, invariants and failure, in the modes and in the tangent.
    pub leading_dimension: usize,
    pub modes_leading_dimension: usize,
    pub tangent_leading_dimension: usize,
    /// The distance from one point to the next.
    pub strides: Strides,
    pub deformation_gradient: [*const T; 9],
    pub fibre: [*const T; 3],
    /// ln(1 + ε_lim) of each point, 0 for that of the properties; read where the failure is computed.
    pub limit: *const T,
    pub energies_old: *const T,
    pub invariants_old: *const T,
    pub failure_old: *const T,
    pub density: T,
    pub stress: [*mut T; 6],
    pub energies: *mut T,
    pub invariants: *mut T,
    pub failure: *mut T,
    pub modes: *mut T,
    pub wave_speed: *mut T,
    pub tangent: *mut T,
    pub measure: Measure,
    /// A status code for each point.
    pub status: *mut i32,
    /// For each point 1, or 0 if it has failed or cannot be evaluated.
    pub active: *mut T,
    /// The instructions to use, or the best that the processor has if those are lower; `None` for the best.
    pub level: Option<Level>,
}

/// The distance from one point to the next in each group of arrays; what has one number for a point (wave speed, status, active) is
/// contiguous.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strides {
    pub deformation_gradient: usize,
    pub fibre: usize,
    pub limit: usize,
    /// Of energies, invariants and failure, old and new.
    pub state: usize,
    pub stress: usize,
    pub modes: usize,
    pub tangent: usize,
}

impl Strides {
    /// Points next to each other: component-major arrays.
    pub(crate) const UNIT: Strides =
        Strides { deformation_gradient: 1, fibre: 1, limit: 1, state: 1, stress: 1, modes: 1, tangent: 1 };
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

impl<T> Pointers<T> {
    /// The limits of points that have their own, where they are read: beside a failure that is computed.
    #[inline(always)]
    pub(super) fn limits(&self) -> *const T {
        if self.failure.is_null() { null() } else { self.limit }
    }

    /// The points from `first` ≤ n on.
    pub(super) fn from(self, first: usize) -> Self {
        let input = |p: *const T, stride: usize| if p.is_null() { p } else { p.wrapping_add(first * stride) };
        let output = |p: *mut T, stride: usize| if p.is_null() { p } else { p.wrapping_add(first * stride) };
        let Strides { deformation_gradient, fibre, limit, state, stress, modes, tangent } = self.strides;
        let mut rest = Pointers {
            n: self.n - first,
            limit: input(self.limit, limit),
            energies_old: input(self.energies_old, state),
            invariants_old: input(self.invariants_old, state),
            failure_old: input(self.failure_old, state),
            energies: output(self.energies, state),
            invariants: output(self.invariants, state),
            failure: output(self.failure, state),
            modes: output(self.modes, modes),
            wave_speed: output(self.wave_speed, 1),
            tangent: output(self.tangent, tangent),
            status: if self.status.is_null() { self.status } else { self.status.wrapping_add(first) },
            active: output(self.active, 1),
            ..self
        };
        for component in &mut rest.deformation_gradient {
            *component = input(*component, deformation_gradient);
        }
        for component in &mut rest.fibre {
            *component = input(*component, fibre);
        }
        for component in &mut rest.stress {
            *component = output(*component, stress);
        }
        rest
    }
}

/// More points, and more numbers between two components, than any memory holds: a greater number is a negative one, converted. An
/// array of 81 components with such distances is still shorter than half the address space.
pub(crate) const MOST: usize = isize::MAX as usize >> 10;

/// Checks that the entries of an array with so many components and points are all at different places, component by component or
/// point by point, and none before its start.
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

impl<T: Scalar> Pointers<T> {
    /// A block of `n` points next to each other, with one leading dimension for all groups and no arrays yet: for the fields that a
    /// host does not name.
    #[inline(always)]
    pub fn without_arrays(n: usize, leading_dimension: usize) -> Self {
        Pointers {
            n,
            leading_dimension,
            modes_leading_dimension: leading_dimension,
            tangent_leading_dimension: leading_dimension,
            strides: Strides::UNIT,
            deformation_gradient: [null(); 9],
            fibre: [null(); 3],
            limit: null(),
            energies_old: null(),
            invariants_old: null(),
            failure_old: null(),
            density: T::splat(0.0),
            stress: [null_mut(); 6],
            energies: null_mut(),
            invariants: null_mut(),
            failure: null_mut(),
            modes: null_mut(),
            wave_speed: null_mut(),
            tangent: null_mut(),
            measure: Measure::Jaumann,
            status: null_mut(),
            active: null_mut(),
            level: None,
        }
    }

    /// Whether point `i` is intact and has a limit that means nothing.
    ///
    /// # Safety
    /// The block is valid and i < n.
    pub(super) unsafe fn has_wrong_limit(&self, i: usize) -> bool
    where
        T: Real<Mask = bool>,
    {
        // SAFETY: in a valid block an array that is not null has an entry for each point, the old failure's second component too.
        unsafe {
            let latch = self.failure_old.wrapping_add(self.leading_dimension + i * self.strides.state);
            let (limits, intact) = (self.limits(), self.failure_old.is_null() || Failure::intact(*latch));
            intact && !limits.is_null() && !Failure::is_limit(*limits.add(i * self.strides.limit))
        }
    }

    /// Checks the block. Returns the results that it requests.
    ///
    /// # Errors
    /// As for [`raw_block`](crate::law::hyperelastic::Hyperelastic::raw_block).
    #[inline(always)]
    pub(super) fn check(&self) -> Result<Request, Error> {
        if self.n > 0 && self.deformation_gradient.iter().any(|pointer| pointer.is_null()) {
            return Err(Error::Null { name: "deformation_gradient" });
        }
        let Strides { limit, state, modes, tangent, .. } = self.strides;
        if !self.limits().is_null() {
            check_layout(self.n, 1, self.n, limit, distances!("limit"))?;
        }
        let old = [self.energies_old, self.invariants_old];
        let of_modes =
            old.iter().any(|array| !array.is_null()) || !self.energies.is_null() || !self.invariants.is_null();
        if of_modes || !self.failure_old.is_null() || !self.failure.is_null() {
            let components = if of_modes { 4 } else { 3 };
            check_layout(self.n, components, self.leading_dimension, state, distances!("the state"))?;
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
        Ok(Request {
            stress: !self.stress[0].is_null(),
            energies: !self.energies.is_null(),
            invariants: !self.invariants.is_null(),
            failure: !self.failure.is_null(),
            modes: !self.modes.is_null(),
            wave_modulus: !self.wave_speed.is_null(),
        })
    }

    /// The instructions to use.
    #[inline(always)]
    pub(super) fn level(&self) -> Level {
        self.level.unwrap_or(Level::Avx512).min(Level::best())
    }

    /// Whether the old state is in the arrays of the new one, as far as these are requested.
    pub(super) fn in_place(&self) -> bool {
        let pairs = [
            (self.energies_old, self.energies),
            (self.invariants_old, self.invariants),
            (self.failure_old, self.failure),
        ];
        pairs.iter().all(|&(old, new)| new.is_null() || old == new.cast_const())
    }

    /// Copies the old state, or zeros where there is none, to the arrays of the new one: the kernel works in place.
    ///
    /// # Safety
    /// The block is valid, see [`Pointers`], with points next to each other.
    pub(super) unsafe fn copy_old_state(&mut self) {
        let (n, stride) = (self.n, self.leading_dimension);
        let groups = [
            (&mut self.energies_old, self.energies, 4),
            (&mut self.invariants_old, self.invariants, 4),
            (&mut self.failure_old, self.failure, 3),
        ];
        for (old, new, components) in groups {
            if new.is_null() || old.cast_mut() == new {
                continue;
            }
            for c in 0..components {
                // SAFETY: in a valid block both arrays have the component c, n values from `c * stride` on, and do not overlap if
                // they are not the same. A number whose bytes are all 0 is 0.
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
