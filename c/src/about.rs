//! The library about itself.

use libc::{c_char, size_t};

/// The version of the library, terminated, static: do not free.
#[unsafe(no_mangle)]
pub extern "C" fn toron_version() -> *const c_char {
    toron::host::c::version()
}

/// The number of the interface the library was built with: compare it with `TORON_ABI_VERSION` of the header.
#[unsafe(no_mangle)]
pub extern "C" fn toron_abi_version() -> i32 {
    toron::host::c::abi_version()
}

/// What a status code means, as a sentence.
///
/// Writes at most `capacity` bytes to `buffer`, always terminated; returns the length needed without the terminator.
/// `buffer` may be null and `capacity` 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_status_message(status: i32, buffer: *mut c_char, capacity: size_t) -> size_t {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::status_message(status, buffer, capacity) }
}
