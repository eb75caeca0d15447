//! What the entry points have in common: they read their arguments, compute in the default floating-point environment and store
//! the requested results.

use core::slice;

use libc::{c_char, size_t};

use super::environment::in_default_environment;
use crate::law::error::Error;
use crate::law::parameters::Property;
use crate::law::status;

/// The properties that a caller passes, read only if their number is right.
///
/// # Safety
/// `properties` is null or points to `count` values.
pub(super) unsafe fn properties<'a, T>(
    properties: *const T,
    count: size_t,
    table: &'static [Property],
) -> Result<&'a [T], Error> {
    if properties.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    if count != table.len() {
        let (found, wanted) = (i64::try_from(count).unwrap_or(i64::MAX), table.len() as i64);
        return Err(Error::Count { code: status::PROPERTY_COUNT, what: "number of properties", found, wanted });
    }
    // SAFETY: the caller's promise.
    Ok(unsafe { slice::from_raw_parts(properties, count) })
}

/// Runs the body of an entry point in the default floating-point environment. Returns its status, or that of its error.
#[inline(always)]
pub(super) fn entry(body: impl FnOnce() -> Result<i32, Error>) -> i32 {
    in_default_environment(|| body().unwrap_or_else(|error| error.code()))
}

/// Copies results to the caller, unless `to` is null.
///
/// # Safety
/// `to` is null or has room for as many values.
#[inline(always)]
pub(super) unsafe fn store<T: Copy>(values: &[T], to: *mut T) {
    if !to.is_null() {
        for (i, &value) in values.iter().enumerate() {
            // SAFETY: the caller's promise.
            unsafe { *to.add(i) = value };
        }
    }
}

/// Writes a text with `snprintf`'s semantics: at most `capacity` bytes, always terminated; returns the length needed
/// without the terminator.
///
/// # Safety
/// `buffer` is null or points to `capacity` writable bytes.
pub(super) unsafe fn write_text(
    buffer: *mut c_char,
    capacity: size_t,
    text: impl FnOnce(&mut dyn FnMut(&str)),
) -> size_t {
    let mut length = 0;
    let room = if buffer.is_null() { 0 } else { capacity.saturating_sub(1) };
    text(&mut |piece| {
        for &byte in piece.as_bytes() {
            if length < room {
                // SAFETY: length < capacity.
                unsafe { *buffer.add(length) = byte as c_char };
            }
            length += 1;
        }
    });
    if !buffer.is_null() && capacity > 0 {
        // SAFETY: at most capacity − 1.
        unsafe { *buffer.add(length.min(room)) = 0 };
    }
    length
}

/// The text of a C string; `None` if it is null, longer than any name, or not UTF-8.
///
/// # Safety
/// `text` is null or a null-terminated string.
pub(super) unsafe fn name<'a>(text: *const c_char) -> Option<&'a str> {
    const LONGEST: usize = 64;
    if text.is_null() {
        return None;
    }
    // SAFETY: no byte behind the terminator is read.
    let length = (0..LONGEST).find(|&i| unsafe { *text.add(i) } == 0)?;
    // SAFETY: these bytes have just been read.
    core::str::from_utf8(unsafe { slice::from_raw_parts(text.cast(), length) }).ok()
}
