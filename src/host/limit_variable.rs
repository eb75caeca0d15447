//! A failure limit of each point in one of the host's state variables, not of the law's: a constant of the card behind
//! the properties, [`NAME`], is that variable's number from 1, or 0 where there is none.

use core::ptr::null;

use crate::law::block::Precision;
use crate::law::error::{Error, Value};
use crate::law::failure::Failure;
use crate::law::interface::Law;
use crate::law::parameters::Property;

/// The constant's name.
pub const NAME: &str = "limit_variable";

const WANTED: &str = "0, or the number of a state variable behind those of the law, within *DEPVAR";

/// How many of the `count` constants of a card are properties: all, or all but the last.
#[inline(always)]
pub(super) fn properties_of<T: Precision, L: Law<T>>(count: usize) -> usize {
    count - usize::from(has_constant::<T, L>(count))
}

fn has_constant<T: Precision, L: Law<T>>(count: usize) -> bool {
    let properties: &[Property] = L::DESCRIPTION.properties;
    L::HAS_LIMIT && count == properties.len() + 1
}

/// The place, from 0, of the variable that holds the limit, if the card names one. Variables from `kept` on are not the
/// law's.
///
/// # Errors
/// A number that is none of these variables'.
///
/// # Safety
/// `constants` points to `count` values.
pub(super) unsafe fn place<T: Precision, L: Law<T>>(
    constants: *const T,
    count: usize,
    kept: usize,
    variables: usize,
) -> Result<Option<usize>, Error> {
    if !has_constant::<T, L>(count) {
        return Ok(None);
    }
    // SAFETY: there are `count` constants, one more than properties.
    let constant = unsafe { *constants.add(count - 1) };
    let value: f64 = constant.into();
    let number = value as usize;
    if number as f64 != value || (number != 0 && !(kept + 1..=variables).contains(&number)) {
        return Err(Error::Argument { name: NAME, value: Value::of(constant), wanted: WANTED });
    }
    Ok(number.checked_sub(1))
}

/// The limit in this place of a point's variables, or null.
pub(super) fn at<T>(variables: *const T, place: Option<usize>) -> *const T {
    place.map_or(null(), |place| variables.wrapping_add(place))
}

/// The limit of a point as its law takes it: null where points of the law have none, or where it is 0, that of the
/// properties: the kernels for points without limits take less time.
pub(super) fn of<T: Precision, L: Law<T>>(limit: &T) -> *const T {
    let given: f64 = (*limit).into();
    if L::HAS_LIMIT && given != 0.0 { limit } else { null() }
}

/// The limit, or 0 where there is none or the point has failed before, by its `latch`. Refuses one that means nothing,
/// since no smaller step would help.
///
/// # Errors
/// It is negative, NaN or infinite.
///
/// # Safety
/// `limit` is null or points to a value; `latch` points to one.
pub(super) unsafe fn check<T: Precision>(limit: *const T, latch: *const T) -> Result<T, Error> {
    // SAFETY: as the caller promises.
    let (limit, latch) = unsafe { (limit.as_ref(), *latch) };
    let Some(&limit) = limit.filter(|_| Failure::intact(latch)) else { return Ok(T::splat(0.0)) };
    if Failure::is_limit(limit) {
        return Ok(limit);
    }
    let name = "failure limit of a point (state variable limit_variable)";
    Err(Error::Argument {
        name,
        value: Value::of(limit),
        wanted: "a finite number, not negative; 0 for that of the properties",
    })
}
