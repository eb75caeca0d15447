//! The package toron as it is published, under the functions that libtoron and the libraries of CalculiX and MGIS export,
//! without the standard library: a dependency that brought it in would clash with the panic handler below.
//!
//! That handler calls a function which does not exist. The linker drops code that nothing reaches before it looks, so that this
//! library links if, and only if, no function here can panic.

#![no_std]

// The libraries of CalculiX and MGIS are uses of macros of `toron-solvers`, whose other modules need the standard library.
extern crate self as toron_solvers;
pub use toron;
#[path = "../../../solvers/src/calculix.rs"]
pub mod calculix;
#[path = "../../../solvers/src/mgis.rs"]
pub mod mgis;

#[path = "../../../c/src/abaqus.rs"]
pub mod abaqus;
#[path = "../../../c/src/about.rs"]
pub mod about;
#[path = "../../../calculix/src/lib.rs"]
pub mod calculix_library;
#[path = "../../../c/src/hyperelastic.rs"]
pub mod hyperelastic;
#[path = "../../../c/src/linear_elastic.rs"]
pub mod linear_elastic;
#[path = "../../../c/src/lsdyna.rs"]
pub mod lsdyna;
#[path = "../../../mgis/src/lib.rs"]
pub mod mgis_library;
#[path = "../../../c/src/openradioss.rs"]
pub mod openradioss;
#[path = "../../../c/src/tables.rs"]
pub mod tables;

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
