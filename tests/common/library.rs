//! The library as a user builds it, for the tests that link C and Fortran programs with it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

/// The repository.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
pub const BUILD: &str = env!("CARGO_TARGET_TMPDIR");

/// What the static library needs of the system.
pub const SYSTEM: [&str; 3] = ["-lpthread", "-ldl", "-lm"];

/// The folder of libtoron.a, libtoron.so and libtoron_calculix.so, built from today's source as a user builds them
/// but for the names of functions inside.
pub static LIBRARY: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(BUILD).join("library");
    let mut cargo = Command::new(env!("CARGO"));
    // Names that tell what a kernel is built for.
    cargo.env("RUSTFLAGS", "-Csymbol-mangling-version=v0").env_remove("CARGO_ENCODED_RUSTFLAGS");
    cargo.args(["build", "--release", "--package=toron-c", "--package=toron-calculix", "--offline", "--manifest-path"]);
    run(cargo.arg(Path::new(ROOT).join("Cargo.toml")).arg("--target-dir").arg(&folder), "cargo");
    folder.join("release")
});

/// Runs a command to its end, which must be a good one; `package` is where a user gets it.
pub fn run(command: &mut Command, package: &str) -> Output {
    let output = command.output().unwrap_or_else(|error| {
        panic!("{}: {error}; on Debian or Ubuntu: apt-get install {package}", command.get_program().display())
    });
    let [stdout, stderr] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success(), "{command:?}: {}\n{stdout}\n{stderr}", output.status);
    output
}

/// A new folder, named after the program in it.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(BUILD).join(name);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}
