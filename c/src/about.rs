//! The library about itself.

use libc::{c_char, size_t};

/// The version of the library as a null-terminated static string; do not free it.
#[unsafe(no_mangle)]
pub extern "C" fn toron_version() -> *const c_char {
    toron::host::c::version()
}

/// The version of the binary interface with which the library was built. It must equal `TORON_ABI_VERSION`.
#[unsafe(no_mangle)]
pub extern "C" fn toron_abi_version() -> i32 {
    toron::host::c::abi_version()
}

/// Writes the meaning of a status code as a sentence.
///
/// Writes at most `capacity` bytes to `buffer`, always null-terminated; returns the full length without the terminating
/// null. `buffer` may be null and `capacity` 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_status_message(status: i32, buffer: *mut c_char, capacity: size_t) -> size_t {
    // SAFETY: the caller's promise.
    unsafe { toron::host::c::status_message(status, buffer, capacity) }
}
