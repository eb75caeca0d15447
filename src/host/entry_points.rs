//! What the entry points have in common: they read their arguments, compute in the default floating-point environment
//! and store the requested results.

use core::slice;

use libc::{c_char, size_t};

use super::environment::in_default_environment_then;
use crate::law::block::Precision;
use crate::law::bounds::wrong_number;
use crate::law::description::Description;
use crate::law::error::{Error, Value};
use crate::law::interface::Law;
use crate::law::parameters::Property;
use crate::law::status;

/// The properties that a caller passes, read only if their number is right.
///
/// # Safety
/// `properties` is null or points to `count` values.
pub unsafe fn properties<'a, T>(
    properties: *const T,
    count: size_t,
    table: &'static [Property],
) -> Result<&'a [T], Error> {
    if properties.is_null() {
        return Err(Error::Null { name: "properties" });
    }
    if count != table.len() {
        return Err(wrong_number(i64::try_from(count).unwrap_or(i64::MAX), table));
    }
    // SAFETY: `properties` is not null, as just checked: `count` values.
    Ok(unsafe { slice::from_raw_parts(properties, count) })
}

/// Refuses the first of these arguments that is null.
#[cold]
#[inline(never)]
pub(super) fn check_pointers<T>(pointers: &[(*const T, &'static str)]) -> Result<(), Error> {
    match pointers.iter().find(|(pointer, _)| pointer.is_null()) {
        Some(&(_, name)) => Err(Error::Null { name }),
        None => Ok(()),
    }
}

/// Whether a direction is neither in the plane of a plane-strain or axisymmetric element nor normal to it: the stress
/// along it would have components that such an element does not have. False for a direction that is zero or not finite,
/// which is refused elsewhere.
fn out_of_plane([m_1, m_2, m_3]: [f64; 3]) -> bool {
    /// A direction typed or computed to this many digits counts as in the plane.
    const TOLERANCE: f64 = 1e-9;
    let (across, along) = (m_1.abs().max(m_2.abs()), m_3.abs());
    along > TOLERANCE * across && across > TOLERANCE * along
}

/// The error of a direction among the properties that a plane-strain or axisymmetric element does not allow: the stress
/// would have components that such an element does not have. `index` is that of its first component, from 0.
#[cold]
fn oblique(index: usize, name: &'static str, value: [f64; 3]) -> Error {
    let (value, wanted) = (value.map(Value::of), "a direction in the plane (third component 0) or normal to it");
    Error::Direction { code: status::FIBRE_OUT_OF_PLANE, index, name, value, wanted }
}

/// Checks that the directions of a law lie in the plane of a plane-strain or axisymmetric element, or normal to it.
///
/// # Errors
/// The direction among the properties that does not.
#[inline(never)]
pub(super) fn check_plane<T: Precision, L: Law<T>>(law: &L, properties: &[T]) -> Result<(), Error> {
    let Description { directions, .. } = L::DESCRIPTION;
    // An axis that is made orthogonal to the fibre may be oblique only because of the second direction.
    let axes_are_oblique = L::HAS.axes && law.axes().into_iter().any(out_of_plane);
    for (i, direction) in directions.iter().enumerate() {
        let vector = direction.of(properties);
        let is_oblique = if L::HAS.axes && i > 0 { axes_are_oblique } else { out_of_plane(vector) };
        if is_oblique {
            return Err(oblique(direction.first, direction.name, vector).for_caller_of::<T>());
        }
    }
    Ok(())
}

/// Bulk and shear modulus of a law, for a time step.
///
/// # Errors
/// A law of one's own whose fastest wave at rest has a speed that is no positive number.
pub(super) fn stiffness_at_rest<T: Precision, L: Law<T>>(law: &L) -> Result<[T; 2], Error> {
    let [bulk, shear] = law.bulk_and_shear();
    if bulk.into() > 0.0 && bulk.into() < f64::INFINITY {
        return Ok([bulk, shear]);
    }
    let text = "the law has no stiffness at F = 1 from which a time step can be computed: wave_modulus there, or without it the \
        tangent, must be a positive number";
    Err(Error::Setting { code: status::BAD_ARGUMENT, text })
}

/// For hosts that do not pass the F of the last step: sets it to 1 where it is 0, as the host initialises the place
/// where it is kept, since points start unstressed. No F has a column of zeros.
///
/// # Safety
/// The rows have n values.
pub(super) unsafe fn start_at_rest<T: Precision>(f_old: [*mut T; 9], n: usize) {
    for i in 0..n {
        // SAFETY: i < n by the loop, and each row has n values.
        unsafe {
            if f_old.iter().take(3).all(|row| (*row.add(i)).into() == 0.0) {
                for (c, row) in f_old.into_iter().enumerate() {
                    *row.add(i) = T::splat(if c % 4 == 0 { 1.0 } else { 0.0 });
                }
            }
        }
    }
}

/// These arrays from entry `first` on. Spelled out: a closure passed to `map` would be called for each of them.
#[inline(always)]
pub(super) fn from_entry<T, const N: usize>(mut arrays: [*mut T; N], first: usize) -> [*mut T; N] {
    for array in &mut arrays {
        *array = array.wrapping_add(first);
    }
    arrays
}

/// Where a caller wants the message of an error: a buffer, or nowhere if it is null. It is written only if there is an
/// error. Who makes one promises that `text` is null or points to `capacity` writable bytes.
#[derive(Clone, Copy)]
pub struct Message {
    pub text: *mut c_char,
    pub capacity: size_t,
}

impl Message {
    /// Writes the pieces of a text, at most `capacity` bytes with the terminating null.
    ///
    /// # Safety
    /// The buffer is what [`Message`] says.
    pub unsafe fn write(self, pieces: impl FnOnce(&mut dyn FnMut(&str))) {
        if self.text.is_null() || self.capacity == 0 {
            return;
        }
        let (longest, mut length) = (self.capacity - 1, 0);
        pieces(&mut |piece| {
            for &byte in piece.as_bytes() {
                if length < longest {
                    // SAFETY: not null, and length < capacity.
                    unsafe { *self.text.add(length) = byte as c_char };
                    length += 1;
                }
            }
        });
        // SAFETY: not null, and length < capacity.
        unsafe { *self.text.add(length) = 0 };
    }

    /// Writes what is wrong; returns the status code.
    ///
    /// # Safety
    /// As for [`write`](Self::write), in the default floating-point environment.
    #[cold]
    #[inline(never)]
    pub unsafe fn refuse(self, error: &Error) -> i32 {
        // SAFETY: the message is that of `write`.
        unsafe { self.write(|sink| error.describe(sink)) };
        error.code()
    }

    /// Writes that there is nothing of this name, and what is allowed; returns the status code.
    ///
    /// # Safety
    /// As for [`write`](Self::write).
    #[cold]
    pub unsafe fn refuse_name<'a>(
        self,
        what: &str,
        name: Result<&str, Error>,
        allowed: impl Iterator<Item = &'a str>,
    ) -> i32 {
        let name = match name {
            Ok(name) => name,
            // SAFETY: as above; the error has no number to format.
            Err(error) => return unsafe { self.refuse(&error) },
        };
        // SAFETY: as above.
        unsafe {
            self.write(|sink| {
                sink("there is no ");
                sink(what);
                sink(" \"");
                sink(name);
                sink("\"; allowed: ");
                for (i, name) in allowed.enumerate() {
                    sink(if i == 0 { "" } else { ", " });
                    sink(name);
                }
            });
        }
        status::UNKNOWN_NAME
    }
}

/// Writes the meaning of a status code as a sentence. Returns 0, or the code for a name that is unknown if there is no
/// such code, which the text then says.
///
/// # Safety
/// The buffer is what [`Message`] says.
pub unsafe fn status_message(status: i32, text: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the buffer is the caller's.
    unsafe { Message { text, capacity }.write(|sink| Error::Plain(status).describe(sink)) };
    if status::meaning(status).is_some() { status::OK } else { status::UNKNOWN_NAME }
}

/// Runs the body of an entry point in the default floating-point environment. Returns its status, or that of its error,
/// with a message.
///
/// # Safety
/// As for [`Message::write`].
#[inline(always)]
pub unsafe fn entry(message: Message, body: impl FnOnce() -> Result<i32, Error>) -> i32 {
    in_default_environment_then(body, |result| match result {
        Ok(status::OK) => status::OK,
        // SAFETY: the message is the caller's, and `body` has run in the default environment, as this does.
        Ok(code) => unsafe { message.refuse(&Error::Plain(code)) },
        // SAFETY: as above.
        Err(error) => unsafe { message.refuse(&error) },
    })
}

/// As [`entry`], in the caller's environment, for what computes nothing and whose errors have no number but whole ones.
///
/// # Safety
/// As for [`Message::write`].
pub unsafe fn look_up(message: Message, body: impl FnOnce() -> Result<i32, Error>) -> i32 {
    // SAFETY: the message is the caller's; the error has no number that needs the default environment.
    body().unwrap_or_else(|error| unsafe { message.refuse(&error) })
}

/// The worst code of a block as a result of [`entry`]: an error that names the first point at fault, if each point's
/// code is known.
///
/// # Errors
/// The code is not 0, and `codes` is not null.
///
/// # Safety
/// `codes` is null or points to `n` codes.
pub(super) unsafe fn of_points(worst: i32, codes: *const i32, n: size_t) -> Result<i32, Error> {
    if worst == status::OK || codes.is_null() {
        return Ok(worst);
    }
    // SAFETY: `codes` is not null, as just checked, and i < n by the range.
    match (0..n).find(|&i| unsafe { *codes.add(i) } == worst) {
        Some(index) => Err(Error::Point { code: worst, index }),
        None => Ok(worst),
    }
}

/// Copies results to the caller, unless `to` is null.
///
/// # Safety
/// `to` is null or has space for as many values.
#[inline(always)]
pub(super) unsafe fn store<T: Copy>(values: &[T], to: *mut T) {
    if !to.is_null() {
        for (i, &value) in values.iter().enumerate() {
            // SAFETY: `to` is not null, as just checked, and i counts the values that it has space for.
            unsafe { *to.add(i) = value };
        }
    }
}

/// The text of a C string.
///
/// # Errors
/// It is null. A text that is not UTF-8, or longer than any name, is no name at all: "?".
///
/// # Safety
/// `text` is null or a null-terminated string.
pub unsafe fn name<'a>(text: *const c_char, argument: &'static str) -> Result<&'a str, Error> {
    const LONGEST: usize = 64;
    if text.is_null() {
        return Err(Error::Null { name: argument });
    }
    // SAFETY: no byte behind the terminator is read.
    let Some(length) = (0..LONGEST).find(|&i| unsafe { *text.add(i) } == 0) else {
        return Ok("?");
    };
    // SAFETY: these bytes have just been read.
    Ok(core::str::from_utf8(unsafe { slice::from_raw_parts(text.cast(), length) }).unwrap_or("?"))
}
