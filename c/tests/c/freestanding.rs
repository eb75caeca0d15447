//! The law needs no standard library and no allocator, and no C entry can panic: `ffi-tests/freestanding` links, and
//! stops linking as soon as one can.

use std::path::Path;
use std::process::{Command, Output};

/// Builds the package with these options, with the versions of the crates that the library itself has.
fn build(options: &[&str]) -> Output {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let package = root.join("ffi-tests/freestanding");
    std::fs::copy(root.join("Cargo.lock"), package.join("Cargo.lock")).expect("Cargo.lock can be copied");
    Command::new(env!("CARGO"))
        .args(["rustc", "--release", "--offline", "--manifest-path"])
        .arg(package.join("Cargo.toml"))
        .args(["--target-dir", concat!(env!("CARGO_TARGET_TMPDIR"), "/freestanding")])
        .args(options)
        .args(["--", "-C", "link-arg=-Wl,--no-undefined"])
        // Flags for the tests, such as coverage, need a standard library.
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .output()
        .expect("cargo runs")
}

#[test]
fn the_law_needs_no_standard_library_and_no_entry_can_panic() {
    for options in [&["--no-default-features"][..], &[]] {
        let output = build(options);
        assert!(output.status.success(), "{options:?}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    // The check can fail: an entry that does panic is refused, and for that reason.
    let output = build(&["--features", "control"]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "an entry that panics has been linked");
    assert!(message.contains("toron_an_entry_can_panic"), "{message}");
}
