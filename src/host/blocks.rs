//! Blocks of points of the hyperelastic law.

use core::mem::MaybeUninit;

use super::arguments::{leading_dimension, measure};
use super::entry_points::of_points;
use super::point_and_block::Block;
use super::structures::read;
use crate::law::block::{Points, Precision, at_fault};
use crate::law::derivative::{NoTangent, SixBySix, Stress};
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::number::level::Level;
use crate::law::number::real::Scalar;
use crate::law::number::registers::Registers;
use crate::law::point::{Call, Columns, Sink, evaluate_call};
use crate::law::prepared::PreparedHyperelastic;
use crate::law::response::{self, OldState, Request};
use crate::law::state::{ENERGIES, FAILURE_INDEX, INVARIANTS};
use crate::law::status;
use crate::law::voigt::Moduli;
use crate::law::wave_speed;

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
pub unsafe fn hyperelastic_block<T: Precision + Registers>(
    law: Given<'_, T>,
    block: *const Block<T>,
) -> Result<i32, Error> {
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
/// As for [`hyperelastic_block`], for a law and a block that have been checked.
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
/// As for [`hyperelastic_block`], for a block that [is plain](Block::is_plain) and [a usual point](Block::is_usual_point).
#[inline(always)]
unsafe fn evaluate_point<T: Registers>(law: &PreparedHyperelastic<T>, block: &Block<T>) -> Result<i32, Error> {
    let (source, f, old) = (law, OnlyPoint(block), OnlyPoint(block));
    // SAFETY: the block is plain, with one point.
    let own = unsafe { block.own() };
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
    fn put(self, point: &response::Point<T>) {
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
    fn take(self, point: response::Point<T>, _: Option<T>, _: [T; 0]) {
        self.put(&point);
    }
}

impl<T: Scalar> Sink<T, 21> for PointOfBlock<'_, T> {
    #[inline(always)]
    fn take(self, point: response::Point<T>, _: Option<T>, moduli: [T; 21]) {
        let next = leading_dimension(self.block.leading_dimension, 1);
        for (c, &entry) in Moduli(moduli).matrix().as_flattened().iter().enumerate() {
            // SAFETY: this sink is for a block with a tangent, of 36 components.
            unsafe { *self.block.tangent.add(c * next) = entry };
        }
        self.put(&point);
    }
}

/// # Safety
/// As for [`hyperelastic_block`].
#[inline(never)]
unsafe fn evaluate_in_layouts<T: Precision>(law: Given<'_, T>, block: &Block<T>) -> Result<i32, Error> {
    block.check_layouts()?;
    // SAFETY: the layouts have just been checked; how long the arrays are the C caller promises.
    unsafe { law.step(&block.points()) }
}
