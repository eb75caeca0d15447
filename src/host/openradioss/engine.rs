//! The engine: a group of elements in one cycle, evaluated in the solver's own arrays.

use core::{ptr, slice};

use crate::law::block::{Circumstances, Precision, components, components_mut};
use crate::law::error::Error;
use crate::law::failure::Failure;
use crate::law::interface::Points;
use crate::law::number::vector::{Matrix, cross, dot, image};
use crate::law::status;
use crate::law::wave_speed::check_density;

use super::brick::Brick;
use super::card::{BY_FAILURE, BY_SOLVER, Card, FibreFrom, Layout};
use super::laws::{Laws, SolidLaw};
use crate::host::entry_points::{check_pointers, from_entry, start_at_rest};

/// The solver's groups have no more elements; longer ones are evaluated in parts.
const CHUNK: usize = 128;

/// A group of elements as the engine passes it to a material, one integration point of each. Who makes one promises
/// that every pointer is null or has as many values as its field says, those without a number NEL, and that the outputs
/// overlap nothing else.
#[derive(Clone, Copy, Debug)]
pub struct Group<T> {
    /// NEL, NUPARAM, NUVAR.
    pub elements: i32,
    pub parameters: i32,
    pub variables: i32,
    /// TIME; 0 in the first cycle.
    pub time: T,
    /// TIMESTEP: the length of the step that ends at TIME; NaN where it is not known.
    pub time_step: T,
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
    /// (NEL, 8, 3), what `MAT_SOLID_GET_NOD_X` gives, in the cycles of [`needs_nodes`], else null: needed at time 0 if
    /// fibre directions come from the nodes.
    pub nodes: *const T,
    /// VOLUME: of the integration point; null where it is not known, and then nodes are those of time 0 alone.
    pub volume: *const T,
}

/// Whether this cycle needs the nodes: the first one for the fibre's direction, and from it on, often at first and then
/// now and then, for the comparison of F with them.
pub fn needs_nodes(cycle: i32) -> bool {
    cycle % 64 == 0 || (cycle > 0 && cycle & (cycle - 1) == 0)
}

/// Evaluates the material at a group.
///
/// # Errors
/// What stops the run: an argument that is missing, counts or numbers of another material, no deformation gradient, a
/// fibre direction that has no length. A point that fails or cannot be evaluated is no error: its element is taken out.
///
/// # Safety
/// The group is what [`Group`] says.
pub unsafe fn evaluate_material<T: Precision>(laws: &Laws<T>, group: &Group<T>) -> Result<(), Error> {
    // SAFETY: the group's arrays are as `Group` says, and `check` refuses null where it is not allowed.
    unsafe {
        group.check(laws)?;
        let parameters = slice::from_raw_parts(group.uparam, group.parameters as usize);
        let card = Card::of(laws, parameters)?;
        if group.variables != card.variables() as i32 {
            let (found, wanted) = (i64::from(group.variables), card.variables() as i64);
            return Err(Error::Count { code: status::STATE_COUNT, what: "NUVAR", found, wanted });
        }
        if group.elements == 0 {
            return Ok(());
        }
        let at_start = group.time.into() == 0.0;
        if at_start && let Some(text) = group.other_precision() {
            return Err(Error::Setting { code: status::NO_DEFORMATION_GRADIENT, text });
        }
        if group.has_no_gradient() {
            let text = if size_of::<T>() == size_of::<f32>() { NO_GRADIENT_IN_SINGLE } else { NO_GRADIENT };
            return Err(Error::Setting { code: status::NO_DEFORMATION_GRADIENT, text });
        }
        check_density(*group.density)?;
        (card.material.evaluate_group)(group, &card)
    }
}

/// What the run stops with if the engine passes no F, see [`super::card::NEEDS`].
const NO_GRADIENT: &str = "the solver passes no deformation gradient (F = 0): the elements of this material need \
    /PROP/TYPE14 (/PROP/SOLID) with Isolid = 1, Ismstr = 10, Iframe = 1; F is 0 for every other Ismstr";

/// The same in single precision, where a number of double precision may read as 0.
const NO_GRADIENT_IN_SINGLE: &str = "the solver passes no deformation gradient (F = 0): the elements of this material need \
    /PROP/TYPE14 (/PROP/SOLID) with Isolid = 1, Ismstr = 10, Iframe = 1; F is 0 for every other Ismstr, and in a solver of double \
    precision, which needs libtoron_openradioss.so";

/// What the run stops with if F is not in the axes of the nodes' coordinates.
const OTHER_AXES: &str = "F is not in the global axes, as the nodes show; the elements of this material need \
    /PROP/TYPE14 (not TYPE6) with Isolid = 1, Ismstr = 10, Iframe = 1";

/// What the run stops with if fibre_from is 1 and elements are flat in the direction of the fibre: yarns are meshed
/// with long ones.
const NODE_ORDER: &str = "fibre_from = 1, and this group's elements are less than half as long from nodes 1 to 4 to nodes 5 to 8 as across: \
    nodes 1 to 4 must be a section of the yarn; if they are, give the directions as initial values (fibre_from = 2)";

/// The diagonal of F = 1, where the other precision's numbers are read.
const OF_DOUBLE: &str = "the solver's numbers are of double precision, and this is the library for single precision: use \
    libtoron_openradioss.so";
const OF_SINGLE: &str = "the solver's numbers are of single precision, and this is the library for double precision: use \
    libtoron_openradioss_sp.so";

impl<T: Precision> Group<T> {
    /// What the run stops with if the solver's numbers are of the other precision: in the first cycle F is 1. 1 in
    /// double precision is, in single precision, 0 and 1.875, and two numbers 1 in single precision are 0.0078125 and a
    /// bit in double precision.
    unsafe fn other_precision(&self) -> Option<&'static str> {
        let mut diagonal = self.deformation_gradient.iter().take(3);
        // SAFETY: F has NEL values, and the second one is read only if there are two. The solver's arrays have its
        // vector length, so that those of the other precision have these bytes too.
        unsafe {
            if size_of::<T>() == size_of::<f32>() {
                let is_double = |&f: &*const T| (*f).into() == 0.0 && (*f.add(1)).into() == 1.875;
                (self.count() > 1 && diagonal.all(is_double)).then_some(OF_DOUBLE)
            } else {
                let two = (u64::from(1_f32.to_bits()) << 32) | u64::from(1_f32.to_bits());
                diagonal.all(|&f| (*f).into().to_bits() == two).then_some(OF_SINGLE)
            }
        }
    }

    /// Whether the first element's F is 0: the solver passes none. Of one element this is what a library for single
    /// precision reads where the solver's F is 1 in double precision.
    unsafe fn has_no_gradient(&self) -> bool {
        // SAFETY: there is a first element.
        self.deformation_gradient.iter().all(|&f| unsafe { *f }.into() == 0.0)
    }

    /// Time 0: the diagonals of the elements as they are undeformed, (0, 0, 0) where nothing is to be compared.
    unsafe fn keep_diagonals(&self, card: &Card<'_, T>) {
        for i in 0..self.count() {
            // SAFETY: i is below NEL, the rows are of UVAR, and the nodes are not null where they are read.
            unsafe {
                let known = !self.nodes.is_null() && !self.volume.is_null();
                let comparable = |brick: &Brick| brick.has_one_point((*self.volume.add(i)).into()) || brick.is_even();
                let brick = if known { Some(Brick(self.of_nodes(self.nodes, i))).filter(comparable) } else { None };
                let diagonal = brick.and_then(|brick| brick.diagonal());
                // Of a model with a reference geometry, F is not 1.
                let [a, b, c] = self.gradient(i);
                let rows = [cross(b, c), cross(c, a), cross(a, b)];
                let determinant = dot(a, rows[0]);
                let undeformed =
                    diagonal.filter(|_| determinant > 0.0).map(|d| rows.map(|row| dot(row, d) / determinant));
                for (row, x) in self.diagonal(card).into_iter().zip(undeformed.unwrap_or_default()) {
                    *row.add(i) = T::splat(x);
                }
            }
        }
    }

    /// # Errors
    /// F is not in global axes, as an element shows that is intact, strained and turned.
    unsafe fn compare_axes(&self, card: &Card<'_, T>) -> Result<(), Error> {
        if self.nodes.is_null() || self.volume.is_null() {
            return Ok(());
        }
        let rounding = if size_of::<T>() == size_of::<f32>() { f64::from(f32::EPSILON) } else { f64::EPSILON };
        for i in 0..self.count() {
            // SAFETY: i is below NEL, the rows are of UVAR, and what may be null is not, as just checked.
            unsafe {
                let diagonal = self.diagonal(card).map(|row| (*row.add(i)).into());
                // Of an element that is out, the solver scales F − 1.
                if diagonal == [0.0; 3] || !T::splat(1.0).le(*self.off.add(i)) {
                    continue;
                }
                let brick = Brick(self.of_nodes(self.nodes, i));
                let taken = image(&self.gradient(i), diagonal);
                if !brick.has_diagonal(taken, brick.has_one_point((*self.volume.add(i)).into()), rounding) {
                    let code = status::NO_DEFORMATION_GRADIENT;
                    return Err(Error::ElementSetting { code, number: self.number(i), text: OTHER_AXES });
                }
            }
        }
        Ok(())
    }

    /// The rows of the elements' diagonals.
    fn diagonal(&self, card: &Card<'_, T>) -> [*mut T; 3] {
        [0, 1, 2].map(|c| self.row(card.diagonal() + c))
    }

    /// The vectors of the eight nodes of element `i` among those of the group, (NEL, 8, 3).
    unsafe fn of_nodes(&self, group: *const T, i: usize) -> [[f64; 3]; 8] {
        let n = self.count();
        // SAFETY: the group has (NEL, 8, 3) values, and i is below NEL.
        [0, 1, 2, 3, 4, 5, 6, 7].map(|node| [0, 1, 2].map(|c| unsafe { *group.add(i + n * (node + 8 * c)) }.into()))
    }

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

    /// The number of element `i` in the model, or its place in the group from 1 where that is not known.
    unsafe fn number(&self, i: usize) -> i64 {
        // SAFETY: NGL is not null here, and i is below NEL.
        if self.numbers.is_null() { i as i64 + 1 } else { i64::from(unsafe { *self.numbers.add(i) }) }
    }

    unsafe fn error_of(&self, i: usize, code: i32) -> Error {
        // SAFETY: i is below NEL.
        Error::Element { code, number: unsafe { self.number(i) } }
    }

    /// What comes before the law, once nothing is wrong with the card.
    ///
    /// # Errors
    /// As for [`initialise`](Self::initialise) and [`compare_axes`](Self::compare_axes).
    unsafe fn begin(&self, card: &Card<'_, T>) -> Result<(), Error> {
        // SAFETY: the group has been checked.
        unsafe {
            if self.time.into() == 0.0 {
                self.initialise(card)?;
                self.keep_diagonals(card);
            } else {
                self.compare_axes(card)?;
            }
            self.take_out_deleted(card.layout());
            self.clear_viscosity();
        }
        Ok(())
    }

    /// Time 0: why elements are out, and their fibre directions.
    ///
    /// # Errors
    /// A direction that has no length or is not finite; the nodes are needed and missing.
    unsafe fn initialise(&self, card: &Card<'_, T>) -> Result<(), Error> {
        let from_nodes = card.fibre_from == FibreFrom::Nodes;
        if from_nodes && self.nodes.is_null() {
            return Err(Error::Null { name: "coordinates of the nodes (MAT_SOLID_GET_NOD_X)" });
        }
        let (failed, deleted) = (self.row(card.layout().law.failed), self.row(card.layout().deleted()));
        for i in 0..self.count() {
            // SAFETY: i is below NEL, and the rows are of UVAR.
            unsafe {
                // What the model says of an intact element would later be taken for the reason why it is out.
                if T::splat(1.0).le(*self.off.add(i)) && Failure::intact(*failed.add(i)) {
                    *deleted.add(i) = T::splat(0.0);
                }
            }
        }
        if card.fibre_from == FibreFrom::Card {
            return Ok(());
        }
        let rows = [0, 1, 2].map(|c| self.row(card.layout().fibre() + c));
        let mut extents = [0.0; 3];
        for i in 0..self.count() {
            // SAFETY: i is below NEL, the rows are of UVAR, and the nodes are not null where they are read.
            unsafe {
                if from_nodes {
                    let jacobian = Brick(self.of_nodes(self.nodes, i)).jacobian([0.0; 3]);
                    let lengths = jacobian.map(|half| libm::sqrt(dot(half, half)));
                    extents.iter_mut().zip(lengths).for_each(|(sum, length)| *sum += length);
                    let ([_, _, way], [_, _, length]) = (jacobian, lengths);
                    let direction = way.map(|x| x / length);
                    rows.into_iter().zip(direction).for_each(|(row, m)| *row.add(i) = T::splat(m));
                }
                let m = rows.map(|row| (*row.add(i)).into());
                let square = dot(m, m);
                if !(square > 0.0 && square < f64::INFINITY) {
                    return Err(self.error_of(i, status::FIBRE_DIRECTION));
                }
            }
        }
        let [first, second, along] = extents;
        if 2.0 * along < first.min(second) {
            // SAFETY: there is a first element, since a group that has none is not initialised.
            let number = unsafe { self.number(0) };
            return Err(Error::ElementSetting { code: status::FIBRE_DIRECTION, number, text: NODE_ORDER });
        }
        Ok(())
    }

    /// Sets the latch of points that others have taken out, whatever their variables say: their OFF is below 1. The
    /// solver scales F − 1 by OFF, so that what arrives from then on is no deformation, and the state must be kept.
    unsafe fn take_out_deleted(&self, layout: &Layout) {
        let one = T::splat(1.0);
        // SAFETY: OFF has NEL values.
        let off = unsafe { slice::from_raw_parts(self.off, self.count()) };
        if off.iter().filter(|&&off| one.le(off)).count() == off.len() {
            return;
        }
        for (i, &off) in off.iter().enumerate() {
            if !one.le(off) {
                // SAFETY: i is below NEL.
                unsafe { self.latch(layout, i, BY_SOLVER) };
            }
        }
    }

    /// Marks point `i` as failed; the reason is this one if it has none yet.
    unsafe fn latch(&self, layout: &Layout, i: usize, reason: f64) {
        // SAFETY: i is below NEL, and the rows are of UVAR.
        unsafe {
            *self.row(layout.law.failed).add(i) = T::splat(1.0);
            *self.row(layout.law.alive).add(i) = T::splat(0.0);
            let deleted = self.row(layout.deleted()).add(i);
            let known = (*deleted).into();
            if known == 0.0 || known.is_nan() {
                *deleted = T::splat(reason);
            }
        }
    }

    /// There is no viscosity.
    unsafe fn clear_viscosity(&self) {
        let [xx, yy, zz, xy, yz, zx] = self.viscous;
        for array in &[xx, yy, zz, xy, yz, zx, self.viscosity] {
            if !array.is_null() {
                // SAFETY: the array has NEL values. A number whose bytes are all 0 is 0.
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

    /// F of element `i`, by columns.
    unsafe fn gradient(&self, i: usize) -> Matrix<f64> {
        // SAFETY: i is below NEL.
        let [xx, yx, zx, xy, yy, zy, xz, yz, zz] = self.columns(i).map(|component| unsafe { *component }.into());
        [[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]]
    }

    /// Evaluates the law at the group.
    ///
    /// # Errors
    /// A property that is wrong, a fibre direction that has no length.
    ///
    /// # Safety
    /// As for [`evaluate_material`], with a group that has been checked.
    pub(super) unsafe fn step<L: SolidLaw<T>>(&self, card: &Card<'_, T>) -> Result<(), Error> {
        let law = L::new(card.properties)?;
        // SAFETY: the group has been checked.
        unsafe { self.begin(card)? };
        let n = self.count();
        // Of a law that does not depend on F at the start of a step, this is not there.
        let f_old = components_mut(self.row(card.layout().f_old()), n);
        if L::DESCRIPTION.reads.old_gradient {
            // SAFETY: these rows of UVAR have NEL values.
            unsafe { start_at_rest(f_old, n) };
        }
        let part = |first: usize, count: usize, codes: *mut i32| {
            let row = |variable| self.row(variable).wrapping_add(first);
            let points = Points {
                f_old: components(row(card.layout().f_old()).cast_const(), n),
                f_new: self.columns(first),
                fibre: self.fibre(card, first),
                limit: if card.has_limits { row(card.layout().limit()) } else { ptr::null_mut() },
                circumstances: Circumstances {
                    time_increment: self.time_step.into(),
                    time: self.time.into(),
                    temperature: ptr::null(),
                },
                state_old: L::parts(row(0), n),
                state_new: L::parts_mut(row(0), n),
                // SAFETY: RHO0 has a value.
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
            // SAFETY: the arrays from element `first` on have `count` values, NUVAR rows of them in UVAR.
            let worst = unsafe { law.step(&points) }?;
            // Elements that fail are taken out, but not all of them at rest.
            if worst == status::OVERFLOW { law.told(worst) } else { Ok(worst) }
        };
        // SAFETY: the group is the caller's.
        unsafe { self.in_chunks(card.layout(), part)? };
        if L::DESCRIPTION.reads.old_gradient {
            for (row, f) in f_old.into_iter().zip(self.columns(0)) {
                // SAFETY: a row of UVAR and a component of F have NEL values each.
                unsafe { row.copy_from_nonoverlapping(f, n) };
            }
        }
        Ok(())
    }

    /// Evaluates the group in parts and marks the points that are out.
    ///
    /// # Errors
    /// Those of `part`, which gets the first element, the number of elements and room for their status codes; a fibre
    /// direction that has no length.
    unsafe fn in_chunks(
        &self,
        layout: &Layout,
        part: impl Fn(usize, usize, *mut i32) -> Result<i32, Error>,
    ) -> Result<(), Error> {
        for first in (0..self.count()).step_by(CHUNK) {
            let n = CHUNK.min(self.count() - first);
            let mut codes = [status::OK; CHUNK];
            let worst = part(first, n, codes.as_mut_ptr())?;
            // SAFETY: OFF has NEL values, of which these are n.
            let off = unsafe { slice::from_raw_parts(self.off.add(first), n) };
            let active = off.iter().filter(|&&off| T::splat(1.0).le(off)).count();
            if worst != status::OK || active < n {
                // SAFETY: these elements are below NEL.
                unsafe { self.mark(layout, first, codes.get(..n).unwrap_or_default())? };
            }
        }
        Ok(())
    }

    /// Latches the points that have failed or could not be evaluated, from element `first` on; those that were out
    /// before are so already.
    ///
    /// # Errors
    /// A fibre direction that has no length, a limit that means nothing: nothing has deformed them, so that the model
    /// is wrong.
    #[cold]
    unsafe fn mark(&self, layout: &Layout, first: usize, codes: &[i32]) -> Result<(), Error> {
        for (i, &code) in (first..).zip(codes) {
            // SAFETY: i is below NEL, and the rows are of UVAR.
            unsafe {
                if T::splat(1.0).le(*self.off.add(i)) {
                    continue;
                }
                match code {
                    status::FIBRE_DIRECTION | status::LIMIT => return Err(self.error_of(i, code)),
                    status::OK => self.latch(layout, i, BY_FAILURE),
                    _ => self.latch(layout, i, f64::from(code)),
                }
            }
        }
        Ok(())
    }
}
