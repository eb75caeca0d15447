//! The library about itself.

use libc::{c_char, size_t};
use toron::host::entry_points::status_message;

use crate::constants::TORON_ABI_VERSION;

/// The version of the library as a null-terminated static string; do not free it.
#[unsafe(no_mangle)]
pub extern "C" fn toron_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// The version of the binary interface with which the library was built. It must equal `TORON_ABI_VERSION`.
#[unsafe(no_mangle)]
pub extern "C" fn toron_abi_version() -> i32 {
    TORON_ABI_VERSION
}

/// Writes the meaning of a status code as a sentence to `message`.
///
/// Returns 0, or `TORON_UNKNOWN_NAME` if there is no such code, which the text then says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_status_message(status: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { status_message(status, message, capacity) }
}
