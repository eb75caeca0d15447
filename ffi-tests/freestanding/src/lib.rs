//! The packages toron and toron-c-functions as they are published, and what the libraries of CalculiX and MGIS export,
//! without the standard library: a dependency that brought it in would clash with the panic handler below.
//!
//! That handler calls a function which does not exist. The linker drops code that nothing reaches before it looks, so
//! that this library links if, and only if, no function here can panic.

#![no_std]

extern crate toron_c;

// The libraries of CalculiX and MGIS are uses of macros of `toron-solvers`, whose other modules need the standard
// library.
extern crate self as toron_solvers;
pub use toron;
#[path = "../../../solvers/src/calculix.rs"]
pub mod calculix;
#[path = "../../../solvers/src/mgis.rs"]
pub mod mgis;

#[path = "../../../calculix/src/lib.rs"]
pub mod calculix_library;
#[path = "../../../mgis/src/lib.rs"]
pub mod mgis_library;

unsafe extern "C" {
    fn toron_an_entry_can_panic() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: never called: there is no such function to link with.
    unsafe { toron_an_entry_can_panic() }
}

/// The control: an index that may be out of bounds.
#[cfg(feature = "control")]
#[unsafe(no_mangle)]
pub extern "C" fn toron_control(index: usize) -> i32 {
    toron::law::status::TABLE[index].0
}
