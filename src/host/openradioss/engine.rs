//! The engine: a group of elements in one cycle, evaluated in the solver's own arrays.

use core::{ptr, slice};

use crate::law::block::{Precision, components, components_mut};
use crate::law::error::Error;
use crate::law::interface::{Law, Points};
use crate::law::number::vector::dot;
use crate::law::status;

use super::card::{BY_FAILURE, BY_SOLVER, Card, FibreFrom, Layout};
use super::laws::Laws;
use crate::host::entry_points::{check_pointers, from_entry, start_at_rest};
use crate::host::environment::in_default_environment;

/// The solver's groups have no more elements; longer ones are evaluated in parts.
const CHUNK: usize = 128;

/// A group of elements as the engine passes it to a material, one integration point of each.
#[derive(Clone, Copy, Debug)]
pub struct Group<T> {
    /// NEL, NUPARAM, NUVAR.
    pub elements: i32,
    pub parameters: i32,
    pub variables: i32,
    /// TIME; 0 in the first cycle.
    pub time: T,
    /// NUPARAM values.
    pub uparam: *const T,
    /// NGL: the elements' numbers in the model, for messages; null if they are not known.
    pub numbers: *const i32,
    /// RHO0: the reference density, of which the first value is read.
    pub density: *const T,
    /// F: XX YY ZZ XY YZ ZX YX ZY XZ.
    pub deformation_gradient: [*const T; 9],
    /// SIGN, out: XX YY ZZ XY YZ ZX.
    pub stress: [*mut T; 6],
    /// SIGV, out, set to 0; null in all its components if the solver has done so.
    pub viscous: [*mut T; 6],
    /// SOUNDSP, out.
    pub sound_speed: *mut T,
    /// VISCMAX, out, set to 0; null if the solver has done so.
    pub viscosity: *mut T,
    /// UVAR, in and out: (NEL, NUVAR).
    pub uvar: *mut T,
    /// OFF, in and out.
    pub off: *mut T,
    /// (NEL, 8, 3), what `MAT_SOLID_GET_NOD_X` gives; read at time 0 if fibre directions come from the nodes, else null is allowed.
    pub nodes: *const T,
}

/// Evaluates the material at a group.
///
/// # Errors
/// What stops the run: an argument that is missing, counts or numbers of another material, no deformation gradient, a fibre
/// direction that has no length. A point that fails or cannot be evaluated is no error: its element is taken out.
///
/// # Safety
/// Every pointer that is not null has as many values as its field says, those without a number NEL; the outputs overlap nothing
/// else.
pub unsafe fn evaluate<T: Precision>(laws: &Laws<T>, group: &Group<T>) -> Result<(), Error> {
    // SAFETY: the caller's promise, here and below.
    unsafe {
        group.check(laws)?;
        let parameters = slice::from_raw_parts(group.uparam, group.parameters as usize);
        let card = Card::of(laws, parameters)?;
        if group.variables != card.layout().variables() as i32 {
            let (found, wanted) = (i64::from(group.variables), card.layout().variables() as i64);
            return Err(Error::Count { code: status::STATE_COUNT, what: "NUVAR", found, wanted });
        }
        if group.elements == 0 {
            return Ok(());
        }
        if group.deformation_gradient.iter().all(|&f| (*f).into() == 0.0) {
            return Err(Error::Setting { code: status::NO_DEFORMATION_GRADIENT, text: NO_GRADIENT });
        }
        if group.time.into() == 0.0 {
            group.initialise(&card)?;
        }
        group.take_out_deleted(card.layout());
        group.clear_viscosity();
        (card.material.evaluate_group)(group, &card)
    }
}

/// Whether this call needs the coordinates of the nodes. A group that cannot be evaluated does not.
///
/// # Safety
/// As for [`evaluate`].
pub unsafe fn needs_nodes<T: Precision>(laws: &Laws<T>, group: &Group<T>) -> bool {
    in_default_environment(|| {
        if group.time.into() != 0.0 || group.uparam.is_null() {
            return false;
        }
        let Ok(count) = usize::try_from(group.parameters) else { return false };
        // SAFETY: the caller's promise.
        let parameters = unsafe { slice::from_raw_parts(group.uparam, count.min(laws.most_parameters)) };
        Card::of(laws, parameters).is_ok_and(|card| card.fibre_from == FibreFrom::Nodes)
    })
}

/// What the run stops with if the engine passes no F, see [`super::card::NEEDS`].
const NO_GRADIENT: &str = "the solver passes no deformation gradient (F = 0): the elements of this material need \
    /PROP/TYPE14 (/PROP/SOLID) with Isolid = 1, Ismstr = 10, Iframe = 1; F is 0 for every other Ismstr";

impl<T: Precision> Group<T> {
    /// NEL.
    fn count(&self) -> usize {
        self.elements as usize // checked not to be negative
    }

    /// Variable `variable`, from 0, of all elements.
    fn row(&self, variable: usize) -> *mut T {
        self.uvar.wrapping_add(variable * self.count())
    }

    /// # Errors
    /// A count that is negative or too large, a null pointer.
    fn check(&self, laws: &Laws<T>) -> Result<(), Error> {
        let counts =
            [("NEL", self.elements, i64::from(i32::MAX)), ("NUPARAM", self.parameters, laws.most_parameters as i64)];
        for (name, value, greatest) in counts {
            if value < 0 || i64::from(value) > greatest {
                let value = i64::from(value);
                return Err(Error::Range { code: status::BAD_COUNT, name, value, least: 0, greatest });
            }
        }
        let mut missing = self.uparam.is_null() | self.density.is_null() | self.sound_speed.is_null();
        missing |= self.uvar.is_null() | self.off.is_null();
        for component in &self.deformation_gradient {
            missing |= component.is_null();
        }
        for component in &self.stress {
            missing |= component.is_null();
        }
        if missing { self.missing() } else { Ok(()) }
    }

    /// # Errors
    /// The first of the pointers that is null and must not be.
    #[cold]
    fn missing(&self) -> Result<(), Error> {
        check_pointers(&[
            (self.uparam, "UPARAM"),
            (self.density, "RHO0"),
            (self.uvar.cast_const(), "UVAR"),
            (self.off.cast_const(), "OFF"),
            (self.sound_speed.cast_const(), "SOUNDSP"),
        ])?;
        check_pointers(&self.deformation_gradient.map(|f| (f, "FPSXX, FPSYY, ... of the deformation gradient")))?;
        check_pointers(&self.stress.map(|s| (s.cast_const(), "SIGNXX, SIGNYY, ... of the stress")))
    }

    /// The error of element `i`: its number, or its place in the group from 1 where that is not known.
    unsafe fn error_of(&self, i: usize, code: i32) -> Error {
        // SAFETY: the caller's promise.
        let number = if self.numbers.is_null() { i as i64 + 1 } else { i64::from(unsafe { *self.numbers.add(i) }) };
        Error::Element { code, number }
    }

    /// Time 0: the fibre directions of the elements.
    ///
    /// # Errors
    /// A direction that has no length or is not finite; the nodes are needed and missing.
    unsafe fn initialise(&self, card: &Card<'_, T>) -> Result<(), Error> {
        if card.fibre_from == FibreFrom::Card {
            return Ok(());
        }
        let from_nodes = card.fibre_from == FibreFrom::Nodes;
        if from_nodes && self.nodes.is_null() {
            return Err(Error::Null { name: "coordinates of the nodes (MAT_SOLID_GET_NOD_X)" });
        }
        let rows = [0, 1, 2].map(|c| self.row(card.layout().fibre() + c));
        for i in 0..self.count() {
            // SAFETY: the caller's promise, i below NEL.
            unsafe {
                if from_nodes {
                    let direction = self.along_the_yarn(i);
                    rows.into_iter().zip(direction).for_each(|(row, m)| *row.add(i) = T::splat(m));
                }
                let m = rows.map(|row| (*row.add(i)).into());
                let square = dot(m, m);
                if !(square > 0.0 && square < f64::INFINITY) {
                    return Err(self.error_of(i, status::FIBRE_DIRECTION));
                }
            }
        }
        Ok(())
    }

    /// The unit vector from the centre of nodes 1 to 4 of element `i` to that of nodes 5 to 8; no number if the two coincide.
    unsafe fn along_the_yarn(&self, i: usize) -> [f64; 3] {
        let n = self.count();
        // SAFETY: the caller's promise: (NEL, 8, 3).
        let place = |node: usize, c: usize| -> f64 { unsafe { *self.nodes.add(i + n * (node + 8 * c)) }.into() };
        let way = [0, 1, 2].map(|c| (0..4).map(|node| place(node + 4, c) - place(node, c)).sum::<f64>());
        let length = libm::sqrt(dot(way, way));
        way.map(|x| x / length)
    }

    /// Sets the latch of points that others have taken out: their OFF is below 1. The solver scales F − 1 by OFF, so that what
    /// arrives from then on is no deformation, and the state must be kept.
    unsafe fn take_out_deleted(&self, layout: &Layout) {
        let one = T::splat(1.0);
        // SAFETY: the caller's promise.
        let off = unsafe { slice::from_raw_parts(self.off, self.count()) };
        if off.iter().filter(|&&off| one.le(off)).count() == off.len() {
            return;
        }
        for (i, &off) in off.iter().enumerate() {
            // SAFETY: i is below NEL.
            unsafe {
                let deleted = self.row(layout.deleted()).add(i);
                if !one.le(off) && (*deleted).into() == 0.0 {
                    self.latch(layout, i, BY_SOLVER);
                }
            }
        }
    }

    /// Marks point `i` as failed, with this reason.
    unsafe fn latch(&self, layout: &Layout, i: usize, deleted: f64) {
        // SAFETY: the caller's promise.
        unsafe {
            *self.row(layout.law.failed).add(i) = T::splat(1.0);
            *self.row(layout.law.alive).add(i) = T::splat(0.0);
            *self.row(layout.deleted()).add(i) = T::splat(deleted);
        }
    }

    /// There is no viscosity.
    unsafe fn clear_viscosity(&self) {
        let [xx, yy, zz, xy, yz, zx] = self.viscous;
        for array in &[xx, yy, zz, xy, yz, zx, self.viscosity] {
            if !array.is_null() {
                // SAFETY: the caller's promise. A number whose bytes are all 0 is 0.
                unsafe { array.write_bytes(0, self.count()) };
            }
        }
    }

    /// The fibre's rows, from element `first` on; null for the direction of the card.
    fn fibre(&self, card: &Card<'_, T>, first: usize) -> [*const T; 3] {
        match card.fibre_from {
            FibreFrom::Card => [ptr::null(); 3],
            _ => {
                let row = |c| self.row(card.layout().fibre() + c).wrapping_add(first).cast_const();
                [row(0), row(1), row(2)]
            }
        }
    }

    /// The columns of F, from element `first` on.
    #[inline(always)]
    fn columns(&self, first: usize) -> [*const T; 9] {
        let [xx, yy, zz, xy, yz, zx, yx, zy, xz] = self.deformation_gradient;
        let mut columns = [xx, yx, zx, xy, yy, zy, xz, yz, zz];
        for component in &mut columns {
            *component = component.wrapping_add(first);
        }
        columns
    }

    /// Evaluates the law at the group.
    ///
    /// # Errors
    /// A property that is wrong, a fibre direction that has no length.
    ///
    /// # Safety
    /// As for [`evaluate`], with a group that has been checked.
    pub(super) unsafe fn step<L: Law<T>>(&self, card: &Card<'_, T>) -> Result<(), Error> {
        let law = L::new(card.properties)?;
        let n = self.count();
        // Of a law that does not depend on F at the start of a step, this is not there.
        let f_old = components_mut(self.row(card.layout().f_old()), n);
        if L::DESCRIPTION.reads_old_gradient {
            // SAFETY: the caller's promise, here and below.
            unsafe { start_at_rest(f_old, n) };
        }
        let part = |first: usize, count: usize, codes: *mut i32| {
            let row = |variable| self.row(variable).wrapping_add(first);
            let points = Points {
                f_old: components(row(card.layout().f_old()).cast_const(), n),
                f_new: self.columns(first),
                fibre: self.fibre(card, first),
                state_old: row(0),
                state_new: row(0),
                density: unsafe { *self.density },
                stress: from_entry(self.stress, first),
                wave_speed: self.sound_speed.wrapping_add(first),
                status: codes,
                // 1 where OFF is to stay 1, 0 where it is to be 0.
                active: self.off.wrapping_add(first),
                rotation: card.rotation,
                criterion: card.criterion,
                ..Points::without_arrays(count, n)
            };
            unsafe { law.step(&points) }
        };
        unsafe { self.in_chunks(card.layout(), part)? };
        if L::DESCRIPTION.reads_old_gradient {
            for (row, f) in f_old.into_iter().zip(self.columns(0)) {
                unsafe { row.copy_from_nonoverlapping(f, n) };
            }
        }
        Ok(())
    }

    /// Evaluates the group in parts and marks the points that are out.
    ///
    /// # Errors
    /// Those of `part`, which gets the first element, the number of elements and room for their status codes; a fibre direction
    /// that has no length.
    unsafe fn in_chunks(
        &self,
        layout: &Layout,
        part: impl Fn(usize, usize, *mut i32) -> Result<i32, Error>,
    ) -> Result<(), Error> {
        for first in (0..self.count()).step_by(CHUNK) {
            let n = CHUNK.min(self.count() - first);
            let mut codes = [status::OK; CHUNK];
            let worst = part(first, n, codes.as_mut_ptr())?;
            // SAFETY: the caller's promise.
            let off = unsafe { slice::from_raw_parts(self.off.add(first), n) };
            let active = off.iter().filter(|&&off| T::splat(1.0).le(off)).count();
            if worst != status::OK || active < n {
                // SAFETY: as above.
                unsafe { self.mark(layout, first, codes.get(..n).unwrap_or_default())? };
            }
        }
        Ok(())
    }

    /// Latches the points that have failed or could not be evaluated in this cycle, from element `first` on.
    ///
    /// # Errors
    /// A fibre direction that has no length: nothing has deformed it, so that the model is wrong.
    #[cold]
    unsafe fn mark(&self, layout: &Layout, first: usize, codes: &[i32]) -> Result<(), Error> {
        for (i, &code) in (first..).zip(codes) {
            // SAFETY: the caller's promise; i is below NEL.
            unsafe {
                let known = (*self.row(layout.deleted()).add(i)).into() != 0.0;
                if known || T::splat(1.0).le(*self.off.add(i)) {
                    continue;
                }
                match code {
                    status::FIBRE_DIRECTION => return Err(self.error_of(i, code)),
                    status::OK => *self.row(layout.deleted()).add(i) = T::splat(BY_FAILURE),
                    _ => self.latch(layout, i, f64::from(code)),
                }
            }
        }
        Ok(())
    }
}
