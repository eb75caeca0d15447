//! The version of the library, and messages of status codes.

use libc::{c_char, size_t};

use super::constants::TORON_ABI_VERSION;
use crate::host::entry_points::Message;
use crate::law::error::Error;
use crate::law::status;

/// `toron_version` of the C interface.
#[inline(never)]
pub extern "C" fn version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// `toron_abi_version` of the C interface.
#[inline(never)]
pub extern "C" fn abi_version() -> i32 {
    TORON_ABI_VERSION
}

/// `toron_status_message` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(never)]
pub unsafe extern "C" fn status_message(status: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the message is the C caller's: null, or `capacity` bytes.
    unsafe { Message { text: message, capacity }.write(|sink| Error::Plain(status).describe(sink)) };
    if status::meaning(status).is_some() { status::OK } else { status::UNKNOWN_NAME }
}
