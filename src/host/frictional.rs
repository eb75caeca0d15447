//! The law with friction at one point and at blocks of points, in the structures of the hyperelastic law.

use core::mem::MaybeUninit;

use super::entry_points::of_points;
use super::point_and_block::{Block, Point};
use super::structures::read;
use crate::law::block::{OnePoint, Points, Precision, at_fault, evaluate_one};
use crate::law::error::Error;
use crate::law::frictional::Frictional;
use crate::law::interface::Law;
use crate::law::prepared::PreparedFrictional;
use crate::law::status;

/// Evaluates the law at a point, as a block of one. Returns its status.
///
/// # Errors
/// An argument is wrong, and nothing is written.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn point<T: Precision>(law: &PreparedFrictional<T>, point: *const Point<T>) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null, and F is checked; how long the arrays of the one point are the C caller promises.
    unsafe {
        let point = read(point, &mut buffer)?;
        if point.deformation_gradient.is_null() {
            return Err(Error::Null { name: "deformation_gradient" });
        }
        let &Point { deformation_gradient: f, fibre, state_old, state_new, stress, .. } = point;
        if point.is_usual_step() && !law.shears() {
            return Ok(T::one_frictional(law, &OnePoint { f, fibre, state_old, state_new, stress }));
        }
        let law = &law.law();
        point.as_points(|points| {
            let (state_old, state_new) =
                (Frictional::<T>::parts(state_old, 1), Frictional::<T>::parts_mut(state_new, 1));
            Ok(evaluate_one(law, &Points { state_old, state_new, ..points }))
        })
    }
}

/// Evaluates the law at the points of a block. Returns 0.
///
/// # Errors
/// An argument is wrong, and nothing is written; or the worst code of the points, with the first that has it.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn block<T: Precision>(law: &Frictional<T>, block: *const Block<T>) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null, and the layouts are checked before an array is read; how long the arrays are the C
    // caller promises.
    unsafe {
        let block = read(block, &mut buffer)?;
        block.check()?;
        block.check_layouts()?;
        let points = block.points();
        if points.n > 0 && points.f_new[0].is_null() {
            return Err(Error::Null { name: "deformation_gradient" });
        }
        let worst = law.step(&points)?;
        if worst == status::OK || !block.status.is_null() {
            return of_points(worst, block.status, block.n);
        }
        Err(at_fault(law, &points, worst).map_or(Error::Plain(worst), |index| Error::Point { code: worst, index }))
    }
}
