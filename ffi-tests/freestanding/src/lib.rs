//! `src/law` and `src/host` as they stand, without the standard library: a dependency that brought it in would clash
//! with the panic handler below.
//!
//! That handler calls a function which does not exist. Code that no entry reaches is dropped before the linker looks,
//! so that this library links if, and only if, no C entry can panic.

#![no_std]

#[cfg(feature = "host")]
#[path = "../../../src/host/mod.rs"]
pub mod host;
#[path = "../../../src/law/mod.rs"]
pub mod law;

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
    law::status::TABLE[index].0
}
