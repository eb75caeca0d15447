//! The library about itself, and texts across the boundary.

use core::slice;

use libc::{c_char, size_t};

use crate::law::status::Error;

use super::TORON_ABI_VERSION;

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

/// The text of a C string; `None` where it is null, longer than any name, or no UTF-8.
///
/// # Safety
/// `text` is null or terminated.
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

/// `toron_version` of the C interface.
pub extern "C" fn version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// `toron_abi_version` of the C interface.
pub extern "C" fn abi_version() -> i32 {
    TORON_ABI_VERSION
}

/// `toron_status_message` of the C interface, which says what its arguments are.
///
/// # Safety
/// As said there.
pub unsafe extern "C" fn status_message(status: i32, buffer: *mut c_char, capacity: size_t) -> size_t {
    // SAFETY: the caller's promise.
    unsafe { write_text(buffer, capacity, |sink| Error::Plain(status).describe(sink)) }
}
