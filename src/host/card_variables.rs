//! What points have of their own in the host's state variables, behind the law's: each constant of a card behind the
//! properties is the number, from 1, of the variable that holds one of these numbers, or 0 where there is none.

use core::ptr::null;

use crate::law::block::{Points, Precision};
use crate::law::error::{Error, Value};
use crate::law::failure::Failure;
use crate::law::interface::Law;
use crate::law::own::Own;
use crate::law::parameters::Property;

/// The name of the constant for each point's failure limit.
pub const NAME: &str = "limit_variable";

const WANTED: &str = "0, or the number of a state variable behind those of the law, within *DEPVAR";

/// How many of the `count` constants of a card are properties: all, or all but the last.
#[inline(always)]
pub(super) fn properties_of<T: Precision, L: Law<T>>(count: usize) -> usize {
    count - usize::from(has_constant::<T, L>(count))
}

#[inline(always)]
fn has_constant<T: Precision, L: Law<T>>(count: usize) -> bool {
    let properties: &[Property] = L::DESCRIPTION.properties;
    L::HAS.limit && count == properties.len() + 1
}

/// The places, from 0, of the variables that a card names.
#[derive(Clone, Copy)]
pub(super) struct CardVariables {
    limit: Option<usize>,
}

impl CardVariables {
    /// Those of a card with `count` constants. Variables from `kept` on are not the law's.
    ///
    /// # Errors
    /// A number that is none of these variables'.
    ///
    /// # Safety
    /// `constants` points to `count` values.
    #[inline(always)]
    pub unsafe fn from_card<T: Precision, L: Law<T>>(
        constants: *const T,
        count: usize,
        kept: usize,
        variables: usize,
    ) -> Result<Self, Error> {
        if !has_constant::<T, L>(count) {
            return Ok(CardVariables { limit: None });
        }
        // SAFETY: there are `count` constants, one more than properties.
        let constant = unsafe { *constants.add(count - 1) };
        Ok(CardVariables { limit: place(NAME, constant, kept, variables)? })
    }

    /// What one point has of its own in its variables.
    ///
    /// # Errors
    /// It means nothing, and no smaller step would help.
    ///
    /// # Safety
    /// `variables` points to the variables of a point of this law, with those that the card names.
    #[inline(always)]
    pub unsafe fn numbers<T: Precision, L: Law<T>>(&self, variables: *const T) -> Result<CardNumbers<T>, Error> {
        // SAFETY: the card's variable, and the law's latch.
        unsafe { Ok(CardNumbers { limit: check(at(variables, self.limit, 1), variables.add(L::DESCRIPTION.failed))? }) }
    }

    /// Checks what `n` points have of their own, whose variables are rows of as many values.
    ///
    /// # Errors
    /// The first point with a number that means nothing.
    ///
    /// # Safety
    /// `variables` points to these rows: those of the law, and those that the card names.
    pub unsafe fn check<T: Precision, L: Law<T>>(&self, variables: *const T, n: usize) -> Result<(), Error> {
        let limits = at(variables, self.limit, n);
        if limits.is_null() {
            return Ok(());
        }
        for index in 0..n {
            let latch = variables.wrapping_add(L::DESCRIPTION.failed * n + index);
            // SAFETY: both are rows of the variables, of `n` points.
            unsafe { check(limits.wrapping_add(index), latch) }?;
        }
        Ok(())
    }

    /// `n` points with what they have of their own, and no other arrays yet; their variables are rows, one `next`
    /// values after the other.
    #[inline(always)]
    pub fn points<T: Precision>(&self, variables: *const T, n: usize, next: usize) -> Points<T> {
        Points { limit: at(variables, self.limit, next), ..Points::without_arrays(n, next) }
    }
}

/// What a point has of its own in its variables; 0 where there is nothing.
#[derive(Clone, Copy)]
pub(super) struct CardNumbers<T> {
    limit: T,
}

impl<T: Precision> CardNumbers<T> {
    /// For the kernels of one point.
    #[inline(always)]
    pub fn own(&self, fibre: Option<[T; 3]>) -> Own<'_, T> {
        Own { limit: Some(&self.limit), ..Own::along(fibre) }
    }

    /// The point with them, and no other arrays yet: null where points of the law have none, or where it is 0, that of
    /// the properties, since the kernels for points without them take less time.
    #[inline(always)]
    pub fn point<L: Law<T>>(&self) -> Points<T> {
        let given: f64 = self.limit.into();
        let limit = if L::HAS.limit && given != 0.0 { &raw const self.limit } else { null() };
        Points { limit, ..Points::without_arrays(1, 1) }
    }
}

/// The place, from 0, of the variable whose number is the constant of this name; `None` for 0.
///
/// # Errors
/// A number that is none of the variables from `kept` on.
fn place<T: Precision>(name: &'static str, constant: T, kept: usize, variables: usize) -> Result<Option<usize>, Error> {
    let value: f64 = constant.into();
    let number = value as usize;
    if number as f64 != value || (number != 0 && !(kept + 1..=variables).contains(&number)) {
        return Err(Error::Argument { name, value: Value::of(constant), wanted: WANTED });
    }
    Ok(number.checked_sub(1))
}

/// The variable in this place, whose rows are one `next` values after the other, or null.
#[inline(always)]
fn at<T>(variables: *const T, place: Option<usize>, next: usize) -> *const T {
    place.map_or(null(), |place| variables.wrapping_add(place * next))
}

/// The limit, or 0 where there is none or the point has failed before, by its `latch`.
///
/// # Errors
/// It is negative, NaN or infinite.
///
/// # Safety
/// `limit` is null or points to a value; `latch` points to one.
unsafe fn check<T: Precision>(limit: *const T, latch: *const T) -> Result<T, Error> {
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
