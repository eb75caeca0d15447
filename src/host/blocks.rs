//! Blocks of points of the hyperelastic law.

use core::mem::MaybeUninit;
use core::ptr::{null, null_mut};

use libc::size_t;

use super::arguments::{Layout, check_density, check_points, leading_dimension, level, measure};
use super::constants::{TORON_LEVEL_BASELINE, TORON_TANGENT_NOMINAL};
use super::entry_points::of_points;
use super::structures::{read, structures};
use crate::law::block::{MOST, Points, Precision, Strides, at_fault, components, components_mut, distances};
use crate::law::derivative::{NoTangent, SixBySix, Stress};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::number::level::{Level, has_fma};
use crate::law::number::real::Scalar;
use crate::law::number::registers::Registers;
use crate::law::point::{self, Call, Columns, OldState, Own, Sink, evaluate_call};
use crate::law::prepared::PreparedHyperelastic;
use crate::law::response::Request;
use crate::law::state::{ENERGIES, FAILURE_INDEX, INVARIANTS};
use crate::law::status;
use crate::law::tangent::Measure;
use crate::law::voigt::Moduli;
use crate::law::wave_speed;

/// A block of points of the hyperelastic law or of the law with friction. Set `size`, `n`, and what is wanted; the rest
/// is 0: an array that is null is left out, and an output that is left out is not computed.
///
/// Component c of point i is at `c * leading_dimension + i`, unless the layout of the array says otherwise. F, fibre
/// and stress have a pointer for each component, so that they may be in separate arrays; if only the first is set, the
/// others follow it by the layout. The arrays of the old and the new state may be the same; otherwise arrays must not
/// overlap. Energies, invariants and failure may be parts of one array of 11 components (15 of the law with friction),
/// starting at components 0, 4 and 8.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Block<T> {
    /// The size of this structure.
    pub size: size_t,
    /// The number of points.
    pub n: size_t,
    /// In numbers, from one component to the next; 0: n.
    pub leading_dimension: size_t,
    /// In: which tangent, one of `TORON_TANGENT_...`; read if `tangent` is not null.
    pub measure: i32,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`; if the processor lacks it, the best one below it. AVX2
    /// and AVX-512 give identical bits; the baseline differs in the last digits.
    pub level: i32,
    /// In: reference density; read if `wave_speed` is not null.
    pub density: f64,
    /// In, 9 components: F by columns. The first must not be null.
    pub deformation_gradient: [*const T; 9],
    /// In, 3 components: the fibre direction of each point, of any length; if null, that of the properties.
    pub fibre: [*const T; 3],
    /// In, 4, 4 and 3 components: the old state; if null, all 0. The failure has 7 of the law with friction.
    pub energies_old: *const T,
    pub invariants_old: *const T,
    pub failure_old: *const T,
    /// Out, 6 components: Cauchy stress 11 22 33 12 23 31.
    pub stress: [*mut T; 6],
    /// Out, 4: W_el W_tc W_td W_ld.
    pub energies: *mut T,
    /// Out, 4: I_el I_tc I_td I_ld.
    pub invariants: *mut T,
    /// Out, 3: failure index, failed, alive; of the law with friction 7, before these the energy lost, I_te and the two
    /// components of the slip. If null, no point fails, but a point whose old failure flag is set stays failed.
    pub failure: *mut T,
    /// Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
    pub modes: *mut T,
    /// Out, 36 components (81 for `TORON_TANGENT_NOMINAL`): entry (row, column), counted from 0, is component 6 row +
    /// column (9 row + column); else as in `toron_point_f64`.
    pub tangent: *mut T,
    /// Out, a number for each point: an upper bound of the wave speed, as in `toron_point_f64`.
    pub wave_speed: *mut T,
    /// Out, a number for each point: 1, or 0 if it has failed or cannot be evaluated: what a solver deletes elements
    /// by.
    pub active: *mut T,
    /// Out, a number for each point: its status code.
    pub status: *mut i32,
    /// Where the entries of these arrays are. That of the state holds for energies, invariants and failure, old and
    /// new.
    pub deformation_gradient_layout: Layout,
    pub fibre_layout: Layout,
    pub state_layout: Layout,
    pub stress_layout: Layout,
    pub modes_layout: Layout,
    pub tangent_layout: Layout,
    /// In, a number for each point: the true fibre strain at failure, ln(1 + eps_lim), in place of that of the
    /// properties; 0: that of the properties. If null, that of the properties. Read if `failure` is not null.
    pub limit: *const T,
    pub limit_layout: Layout,
}

structures! { Block, "toron_block_f64", "toron_block_f32", "block"; }

#[cfg(target_pointer_width = "64")]
const _: () =
    assert!(size_of::<Block<f64>>() == 5 * 8 + 30 * 8 + 14 * 8 && size_of::<Block<f32>>() == size_of::<Block<f64>>());

impl<T: Scalar> Block<T> {
    /// The layouts of all arrays.
    #[inline(always)]
    fn layouts(&self) -> [&Layout; 7] {
        [
            &self.deformation_gradient_layout,
            &self.fibre_layout,
            &self.state_layout,
            &self.stress_layout,
            &self.modes_layout,
            &self.tangent_layout,
            &self.limit_layout,
        ]
    }

    /// Whether all arrays are placed in the usual way: one pointer each, and one leading dimension for all. Most blocks
    /// are, and most calls have so few points that to look at every layout would take time.
    #[inline(always)]
    fn is_plain(&self) -> bool {
        let (mut others, mut c) = (0, 0);
        let layouts = self.layouts();
        while c < layouts.len() {
            others |= layouts[c].leading_dimension | layouts[c].stride;
            c += 1;
        }
        others |= behind_first(&self.deformation_gradient) | behind_first(&self.fibre);
        let [_, s1, s2, s3, s4, s5] = self.stress;
        others |= s1.addr() | s2.addr() | s3.addr() | s4.addr() | s5.addr();
        others == 0 && self.leading_dimension <= MOST && self.n <= leading_dimension(self.leading_dimension, self.n)
    }

    /// Whether it is a single point, and requests what most callers do, the stress with or without the state, the wave
    /// speed and a tangent of 6×6, at a level whose lanes compute as a point on its own does.
    #[inline(always)]
    fn is_usual_point(&self) -> bool {
        let no_state = self.energies.addr() | self.invariants.addr() | self.failure.addr() == 0;
        let state = !(self.energies.is_null() | self.invariants.is_null() | self.failure.is_null());
        let stress_alone = no_state & (self.failure_old.addr() | self.active.addr() | self.wave_speed.addr() == 0);
        let nominal = !self.tangent.is_null() && self.measure == TORON_TANGENT_NOMINAL;
        self.n == 1
            && !(self.deformation_gradient[0].is_null() | self.stress[0].is_null())
            && self.modes.is_null()
            && !nominal
            && state | stress_alone
            && self.level != TORON_LEVEL_BASELINE
            && has_fma()
    }

    /// Checks what the law itself does not check, but for the layouts.
    #[inline(always)]
    pub(super) fn check(&self) -> Result<(), Error> {
        check_points(self.n)?;
        check_density::<T>(self.density, !self.wave_speed.is_null() && self.n > 0)?;
        level(self.level)?;
        if !self.tangent.is_null() {
            measure(self.measure)?;
        }
        Ok(())
    }

    /// Checks where the entries of the arrays are that have a pointer for each component; the law checks the others.
    pub(super) fn check_layouts(&self) -> Result<(), Error> {
        let (n, leading_dimension) = (self.n, leading_dimension(self.leading_dimension, self.n));
        let [f, fibre, stress] = [self.deformation_gradient_layout, self.fibre_layout, self.stress_layout];
        f.or(leading_dimension).check(
            &self.deformation_gradient,
            null(),
            n,
            "deformation_gradient, one of its components,",
            distances!("deformation_gradient"),
        )?;
        let component = "fibre, one of its components,";
        fibre.or(leading_dimension).check(&self.fibre, null(), n, component, distances!("fibre"))?;
        let component = "stress, one of its components,";
        stress.or(leading_dimension).check(&self.stress, null_mut(), n, component, distances!("stress"))
    }

    /// The block as the law takes it, if it [is plain](Self::is_plain).
    #[inline(always)]
    fn plain_points(&self) -> Points<T> {
        let leading_dimension = leading_dimension(self.leading_dimension, self.n);
        Points {
            f_new: components(self.deformation_gradient[0], leading_dimension),
            fibre: components(self.fibre[0], leading_dimension),
            limit: self.limit,
            state_old: [self.energies_old, self.invariants_old, self.failure_old],
            state_new: [self.energies, self.invariants, self.failure],
            density: T::splat(self.density),
            stress: components_mut(self.stress[0], leading_dimension),
            modes: self.modes,
            wave_speed: self.wave_speed,
            tangent: self.tangent,
            measure: measure(self.measure).unwrap_or(Measure::Jaumann),
            status: self.status,
            active: self.active,
            level: level(self.level).unwrap_or(None),
            ..Points::without_arrays(self.n, leading_dimension)
        }
    }

    /// The block as the law takes it, whose layouts [have been checked](Self::check_layouts).
    pub(super) fn points(&self) -> Points<T> {
        let leading_dimension = leading_dimension(self.leading_dimension, self.n);
        let [f, fibre] = [self.deformation_gradient_layout, self.fibre_layout].map(|x| x.or(leading_dimension));
        let [state, stress] = [self.state_layout, self.stress_layout].map(|x| x.or(leading_dimension));
        let [modes, tangent] = [self.modes_layout, self.tangent_layout].map(|x| x.or(leading_dimension));
        Points {
            leading_dimension: state.leading_dimension,
            modes_leading_dimension: modes.leading_dimension,
            tangent_leading_dimension: tangent.leading_dimension,
            strides: Strides {
                deformation_gradient: f.stride,
                fibre: fibre.stride,
                limit: self.limit_layout.stride.max(1),
                state: state.stride,
                stress: stress.stride,
                modes: modes.stride,
                tangent: tangent.stride,
                ..Strides::UNIT
            },
            f_new: f.components(&self.deformation_gradient),
            fibre: fibre.components(&self.fibre),
            stress: stress.components_mut(&self.stress),
            ..self.plain_points()
        }
    }
}

/// 0 if no pointer behind the first one is set.
#[inline(always)]
fn behind_first<T, const N: usize>(components: &[*const T; N]) -> usize {
    let (mut others, mut c) = (0, 1);
    while c < N {
        others |= components[c].addr();
        c += 1;
    }
    others
}

/// The hyperelastic law as a caller passes it: its properties, which are checked in every call, or prepared.
#[derive(Clone, Copy, Debug)]
pub enum Given<'a, T> {
    /// In the order of the table.
    Properties(&'a [T]),
    /// By its function of C.
    Prepared(&'a PreparedHyperelastic<T>),
}

impl<T: Precision> Given<'_, T> {
    /// # Errors
    /// The first property that is wrong.
    #[inline(always)]
    fn law(self) -> Result<Hyperelastic<T>, Error> {
        match self {
            Given::Properties(properties) => Hyperelastic::new(properties),
            Given::Prepared(prepared) => Ok(prepared.law()),
        }
    }

    /// # Errors
    /// The first property that is wrong, before what [`Law::step`] refuses, which calls F by another name.
    ///
    /// # Safety
    /// As for [`Law::step`].
    #[inline(always)]
    unsafe fn step(self, points: &Points<T>) -> Result<i32, Error> {
        let law = self.law()?;
        if points.n > 0 && points.f_new[0].is_null() {
            return Err(Error::Null { name: "deformation_gradient" });
        }
        // SAFETY: the points are valid.
        unsafe { law.step(points) }
    }
}

/// Evaluates the law at the points of a block. Returns 0.
///
/// # Errors
/// A property or an argument is wrong, and nothing is written; or the worst code of the points, with the first that has
/// it.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(always)]
pub unsafe fn evaluate<T: Precision + Registers>(law: Given<'_, T>, block: *const Block<T>) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null, and the layouts are plain, or checked before an array is read; how long the arrays
    // are the C caller promises, and of `status` that it has n codes.
    unsafe {
        let block = read(block, &mut buffer)?;
        block.check()?;
        let worst = match (block.is_plain(), law) {
            (false, _) => evaluate_in_layouts(law, block)?,
            (true, Given::Prepared(law)) if block.is_usual_point() => evaluate_point(law, block)?,
            (true, Given::Properties(properties)) if block.is_usual_point() => {
                // Prepared for one point, the law may differ in the last digits.
                evaluate_point(&PreparedHyperelastic::from(&Hyperelastic::new(properties)?), block)?
            }
            (true, _) => law.step(&block.plain_points())?,
        };
        if worst == status::OK {
            return Ok(worst);
        }
        if !block.status.is_null() {
            return of_points(worst, block.status, block.n);
        }
        named(law, block, worst)
    }
}

/// The error of a block without status codes, after the call: of the first point at fault, if that can be told from F
/// and fibre.
///
/// # Errors
/// Always.
///
/// # Safety
/// As for [`evaluate`], for a law and a block that have been checked.
#[cold]
#[inline(never)]
unsafe fn named<T: Precision>(law: Given<'_, T>, block: &Block<T>, worst: i32) -> Result<i32, Error> {
    let law = law.law()?;
    // SAFETY: the block has been evaluated, so that its layouts are right.
    let index = unsafe { at_fault(&law, &block.points(), worst) };
    Err(index.map_or(Error::Plain(worst), |index| Error::Point { code: worst, index }))
}

/// Evaluates a block of one point, which takes less time on its own than in a register, by the same operations. Returns
/// its status.
///
/// # Errors
/// None: the block and the law have been checked.
///
/// # Safety
/// As for [`evaluate`], for a block that [is plain](Block::is_plain) and [a usual point](Block::is_usual_point).
#[inline(always)]
unsafe fn evaluate_point<T: Registers>(law: &PreparedHyperelastic<T>, block: &Block<T>) -> Result<i32, Error> {
    let (source, f, old, m) = (law, OnlyPoint(block), OnlyPoint(block), block.fibre[0]);
    // SAFETY: the block is plain: its fibre, which is not null, is one array of three components.
    let fibre = if m.is_null() { None } else { Some(unsafe { [f.read(m, 0), f.read(m, 1), f.read(m, 2)] }) };
    // SAFETY: the block is plain: null, or the number of the only point, if its failure is computed.
    let limit = if block.failure.is_null() { None } else { unsafe { block.limit.as_ref() } };
    let own = Own { fibre, limit };
    let mut code = status::OK;
    let sink = PointOfBlock { block, code: &mut code };
    let level = Level::Avx512;
    // What most callers want is compiled for them.
    if !block.tangent.is_null() {
        let state = !block.energies.is_null();
        let wave_modulus = !block.wave_speed.is_null();
        let request =
            Request { energies: state, invariants: state, failure: state, wave_modulus, ..Request::STRESS_AND_STATE };
        let tangent = SixBySix(request, measure(block.measure)?);
        // As the lanes, which have no kernel of their own for the tangent of a fibre along the first axis.
        let source = &law.with_axes_of_any_fibre();
        evaluate_call(Call { source, f, own, state: old, tangent, sink }, level)?;
    } else if !block.wave_speed.is_null() {
        let tangent = NoTangent(Request { wave_modulus: true, ..Request::STRESS_AND_STATE });
        evaluate_call(Call { source, f, own, state: old, tangent, sink }, level)?;
    } else if block.energies.is_null() {
        evaluate_call(Call { source, f, own, state: old, tangent: Stress::<false>, sink }, level)?;
    } else {
        evaluate_call(Call { source, f, own, state: old, tangent: Stress::<true>, sink }, level)?;
    }
    Ok(code)
}

/// The only point of a block, for its F and its old state.
struct OnlyPoint<'a, T>(&'a Block<T>);

impl<T: Scalar> OnlyPoint<'_, T> {
    /// # Safety
    /// `array` is one of the block's, with this component.
    #[inline(always)]
    unsafe fn read(&self, array: *const T, component: usize) -> T {
        // SAFETY: the array has this component, at the block's leading dimension, and the point is the only one.
        unsafe { *array.add(component * leading_dimension(self.0.leading_dimension, 1)) }
    }
}

impl<T: Scalar> Columns<T> for OnlyPoint<'_, T> {
    #[inline(always)]
    fn columns(&self) -> [[T; 3]; 3] {
        // SAFETY: a usual point has an F, of nine components.
        let entry = |c: usize| unsafe { self.read(self.0.deformation_gradient[0], c) };
        [[entry(0), entry(1), entry(2)], [entry(3), entry(4), entry(5)], [entry(6), entry(7), entry(8)]]
    }
}

impl<T: Scalar> OldState<T> for OnlyPoint<'_, T> {
    #[inline(always)]
    fn entry(&self, c: usize) -> T {
        let (array, first) = match c {
            INVARIANTS.. if c < FAILURE_INDEX => (self.0.invariants_old, INVARIANTS),
            FAILURE_INDEX.. => (self.0.failure_old, FAILURE_INDEX),
            _ => (self.0.energies_old, ENERGIES),
        };
        // SAFETY: not null, and c − `first` is below the number of components of this part of the state.
        if array.is_null() { T::splat(0.0) } else { unsafe { self.read(array, c - first) } }
    }
}

/// The sink for a block's only point.
struct PointOfBlock<'a, T> {
    block: &'a Block<T>,
    code: &'a mut i32,
}

impl<T: Scalar> PointOfBlock<'_, T> {
    #[inline(always)]
    fn put(self, point: &point::Point<T>) {
        let PointOfBlock { block, code } = self;
        *code = point.status;
        let next = leading_dimension(block.leading_dimension, 1);
        // SAFETY: a usual point has a stress, and all parts of the state or none; what may be null has been checked. As
        // many values as components.
        let store = |values: &[T], array: *mut T| unsafe {
            for (c, &value) in values.iter().enumerate() {
                *array.add(c * next) = value;
            }
        };
        store(&point.stress, block.stress[0]);
        let [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, index, failed, alive] = point.state;
        if !block.energies.is_null() {
            store(&[w_el, w_tc, w_td, w_ld], block.energies);
            store(&[i_el, i_tc, i_td, i_ld], block.invariants);
            store(&[index, failed, alive], block.failure);
            if !block.wave_speed.is_null() {
                store(&[wave_speed::wave_speed(point.wave_modulus, T::splat(block.density))], block.wave_speed);
            }
            if !block.active.is_null() {
                store(&[if point.status == status::OK { alive } else { T::splat(0.0) }], block.active);
            }
        }
        if !block.status.is_null() {
            // SAFETY: not null: one code.
            unsafe { *block.status = point.status };
        }
    }
}

impl<T: Scalar> Sink<T, 0> for PointOfBlock<'_, T> {
    #[inline(always)]
    fn take(self, point: point::Point<T>, _: Option<T>, _: [T; 0]) {
        self.put(&point);
    }
}

impl<T: Scalar> Sink<T, 21> for PointOfBlock<'_, T> {
    #[inline(always)]
    fn take(self, point: point::Point<T>, _: Option<T>, moduli: [T; 21]) {
        let next = leading_dimension(self.block.leading_dimension, 1);
        for (c, &entry) in Moduli(moduli).matrix().as_flattened().iter().enumerate() {
            // SAFETY: this sink is for a block with a tangent, of 36 components.
            unsafe { *self.block.tangent.add(c * next) = entry };
        }
        self.put(&point);
    }
}

/// # Safety
/// As for [`evaluate`].
#[inline(never)]
unsafe fn evaluate_in_layouts<T: Precision>(law: Given<'_, T>, block: &Block<T>) -> Result<i32, Error> {
    block.check_layouts()?;
    // SAFETY: the layouts have just been checked; how long the arrays are the C caller promises.
    unsafe { law.step(&block.points()) }
}
