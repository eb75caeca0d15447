//! Routines of the solver, looked up by name in the running program.

use std::ffi::{CStr, c_char, c_void};
use std::io::Write;

use toron::Real;

/// The exit code of the solver's routine that ends a run after an error in the model.
const INPUT_ERROR: i32 = 2;

/// The routine of this name; `None` if the program has none, or where the system is not Unix.
#[cfg(not(unix))]
fn routine(_name: &CStr) -> Option<*mut c_void> {
    None
}

/// The routine of this name; `None` if the program has none.
#[cfg(unix)]
fn routine(name: &CStr) -> Option<*mut c_void> {
    // SAFETY: a null-terminated name.
    let found = unsafe { libc::dlsym(libc::RTLD_DEFAULT, name.as_ptr()) };
    (!found.is_null()).then_some(found)
}

/// Writes a message to the standard output and, in the engine, to its listing, and ends the run as the solver itself
/// does.
pub fn stop(message: &str) {
    // An output that is closed must not keep the run from ending.
    let _ = writeln!(std::io::stdout(), " toron: {message}");
    if let Some(write) = routine(c"write_iout_") {
        // SAFETY: `WRITE_IOUT(LINE, LEN)` of the engine, with the hidden length of its character argument.
        unsafe {
            let write: unsafe extern "C" fn(*const c_char, *const i32, usize) = std::mem::transmute(write);
            let length = message.len().min(200); // the line's length in the solver is limited
            write(message.as_ptr().cast(), &(length as i32), length);
        }
    }
    match routine(c"arret_") {
        // SAFETY: `ARRET(NN)` of starter and engine.
        Some(arret) => unsafe {
            let arret: unsafe extern "C" fn(*const i32) = std::mem::transmute(arret);
            arret(&INPUT_ERROR);
        },
        None => std::process::exit(INPUT_ERROR),
    }
}

/// The coordinates of the nodes of the engine's current group, (`elements`, 8, 3); empty if the engine has no routine
/// for them.
pub fn coordinates_of_nodes<T: Real>(elements: usize) -> Vec<T> {
    let Some(get) = routine(c"mat_solid_get_nod_x_") else { return Vec::new() };
    // Room for numbers of double precision too: a library for the other precision is refused, but not before it has
    // asked.
    let room = elements * 8 * 3;
    let mut coordinates = vec![T::splat(0.0); room * size_of::<f64>() / size_of::<T>()];
    // SAFETY: `MAT_SOLID_GET_NOD_X(USER_X)` of the engine writes 24 numbers for each element of the group that calls
    // it.
    unsafe {
        let get: unsafe extern "C" fn(*mut T) = std::mem::transmute(get);
        get(coordinates.as_mut_ptr());
    }
    coordinates.truncate(room);
    coordinates
}

/// Number and title of what the starter is reading; `None` if it has no such routine.
pub fn current_option() -> Option<(i32, String)> {
    let get = routine(c"cpp_current_option_")?;
    let (mut id, mut unit, mut include, mut key_length, mut title_length) = (0, 0, 0, 0, 0);
    let (mut key, mut title) = ([0_u8; 500], [0_u8; 500]);
    // SAFETY: `cpp_current_option_(ID, UID, includeId, KEY, SKEY, TITR, STITR)` of the starter's reader; it writes at
    // most 100 characters of the keyword and 500 of the title.
    unsafe {
        type Get = unsafe extern "C" fn(*mut i32, *mut i32, *mut i32, *mut u8, *mut i32, *mut u8, *mut i32);
        let get: Get = std::mem::transmute(get);
        get(&mut id, &mut unit, &mut include, key.as_mut_ptr(), &mut key_length, title.as_mut_ptr(), &mut title_length);
    }
    let title = title.get(..usize::try_from(title_length).ok()?)?;
    Some((id, String::from_utf8_lossy(title).trim().to_string()))
}
