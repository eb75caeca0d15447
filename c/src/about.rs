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

/// Writes the meaning of a status code as a sentence to `message`.
///
/// Returns 0, or `TORON_UNKNOWN_NAME` if there is no such code, which the text then says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_status_message(status: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { toron::host::c::status_message(status, message, capacity) }
}
