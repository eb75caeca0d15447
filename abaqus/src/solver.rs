//! Abaqus's routines, looked up by name in the running program.

use std::ffi::{CStr, c_char};
use std::io::Write;

use crate::CAPACITY;

/// The exit code where Abaqus's own routine is not found.
const ERROR: i32 = 1;

/// The codes below are those of a deck that is wrong; those above, of a point that cannot be evaluated, for which the job goes on.
const WORST_OF_A_DECK: i32 = -300;

/// Ends the job where the deck is wrong, with the library's message and the material's name in the standard output, by this routine
/// of Abaqus.
///
/// # Safety
/// Abaqus's promise: `material` has 80 characters.
pub unsafe fn refuse(status: i32, message: &[c_char; CAPACITY], material: *const c_char, routine: &CStr) {
    if status >= 0 || status <= WORST_OF_A_DECK {
        return;
    }
    // SAFETY: the caller's promise, and the library's: it has written a null.
    let (name, text) =
        unsafe { (std::slice::from_raw_parts(material.cast::<u8>(), 80), CStr::from_ptr(message.as_ptr())) };
    let name = String::from_utf8_lossy(name);
    // An output that is closed must not keep the job from ending.
    let _ = writeln!(std::io::stdout(), " toron, material {}: {}", name.trim_end(), text.to_string_lossy());
    // SAFETY: a null-terminated name; what has it takes no arguments.
    unsafe {
        let found = libc::dlsym(libc::RTLD_DEFAULT, routine.as_ptr());
        if found.is_null() {
            std::process::exit(ERROR);
        }
        let end: unsafe extern "C" fn() = std::mem::transmute(found);
        end();
    }
}
