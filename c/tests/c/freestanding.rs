//! The package `toron` as another crate gets it: without a standard library, without an allocator, in an empty project;
//! and no function of libtoron can panic: `ffi-tests/freestanding` links, and stops linking as soon as one can.

use std::path::Path;
use std::process::{Command, Output};

use toron_test_support::library::{BUILD, ROOT, folder, run, share_build};

/// Builds the package with these options, with the versions of the crates that the library itself has.
fn build(options: &[&str]) -> Output {
    let root = Path::new(ROOT);
    let package = root.join("ffi-tests/freestanding");
    std::fs::copy(root.join("Cargo.lock"), package.join("Cargo.lock")).expect("Cargo.lock can be copied");
    let mut cargo = Command::new(env!("CARGO"));
    share_build(&mut cargo);
    cargo
        .args(["rustc", "--release", "--crate-type=cdylib", "--manifest-path"])
        .arg(package.join("Cargo.toml"))
        .args(options)
        // The standard library's part of unwinding, which is never called.
        .args(["--", "-C", "link-arg=-Wl,--no-undefined", "-C", "link-arg=-Wl,--defsym=rust_eh_personality=0"])
        .output()
        .expect("cargo runs")
}

#[test]
fn the_package_needs_no_standard_library_and_no_function_can_panic() {
    let output = build(&[]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    has_every_function(&BUILD.join("release/libfreestanding.so"));
    // The check can fail: a function that does panic is refused, and for that reason.
    let output = build(&["--features", "control"]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "a function that panics has been linked");
    assert!(message.contains("toron_an_entry_can_panic"), "{message}");
}

/// What the linker has looked at is all that libtoron exports.
fn has_every_function(linked: &Path) {
    #[cfg(all(target_arch = "x86_64", target_os = "linux"))]
    {
        use crate::symbols::functions;
        use toron_test_support::library::LIBRARY;
        let missing = &functions(&LIBRARY.join("libtoron.so")) - &functions(linked);
        assert!(missing.is_empty(), "{missing:?}");
    }
}

/// `cargo add toron` in an empty project.
#[test]
fn an_empty_project_can_use_the_package() {
    let project = folder("empty-project");
    let cargo = |arguments: &[&str]| {
        let mut cargo = Command::new(env!("CARGO"));
        run(cargo.args(arguments).current_dir(&project).env_remove("CARGO_TARGET_DIR"), "cargo");
    };
    // Below this workspace's folder, but not a member of it.
    let manifest = "[package]\nname = \"empty-project\"\nedition = \"2024\"\n\n[workspace]\n";
    std::fs::write(project.join("Cargo.toml"), manifest).expect("the manifest is writable");
    std::fs::create_dir_all(project.join("src")).expect("a folder");
    std::fs::write(project.join("src/lib.rs"), "").expect("the source is writable");
    cargo(&["add", "--offline", "toron", "--path", ROOT]);
    std::fs::write(project.join("src/lib.rs"), USE).expect("the source is writable");
    cargo(&["check", "--offline"]);
}

const USE: &str = "#![no_std]
pub fn stress(properties: &[f64], f: &[[f64; 3]; 3]) -> Result<[f64; 6], toron::Error> {
    use toron::{Hyperelastic, Request};
    let law = Hyperelastic::new(properties)?;
    Ok(law.point_along(f, None, &[0.0; 11], Request::STRESS_AND_STATE).stress)
}
";

/// What a Rust user gets beside the package itself.
#[test]
fn the_package_brings_little_along() {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["tree", "--offline", "-p", "toron", "-e", "normal", "--prefix", "none", "--no-dedupe"]);
    let output = run(cargo.current_dir(ROOT), "cargo");
    let tree = String::from_utf8(output.stdout).expect("UTF-8");
    let packages: std::collections::BTreeSet<_> = tree.lines().collect();
    assert!((2..=13).contains(&packages.len()), "{packages:?}");
}
