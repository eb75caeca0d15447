//! The library as a user builds it, for the tests that link C and Fortran programs with it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

/// The repository.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// Where tests may write: CARGO_TARGET_TMPDIR, which Cargo tells tests and no package that they are built on.
pub static BUILD: LazyLock<PathBuf> = LazyLock::new(|| {
    // A test runs as TARGET/PROFILE/deps/NAME.
    let test = std::env::current_exe().expect("a test has a file");
    test.ancestors().nth(3).expect("Cargo's folder for what it builds").join("tmp")
});

/// What the static library needs of the system.
pub const SYSTEM: [&str; 3] = ["-lpthread", "-ldl", "-lm"];

/// Has cargo build in one folder with the same flags: what several libraries are built on is then compiled once. The flags
/// are those of this run of the tests, and names that tell what a kernel is built for.
pub fn share_build(command: &mut Command) {
    let flags = std::env::var("RUSTFLAGS").unwrap_or_default() + " -Csymbol-mangling-version=v0";
    command.env("RUSTFLAGS", flags).env_remove("CARGO_ENCODED_RUSTFLAGS");
    command.env("CARGO_TARGET_DIR", &*BUILD).env("CARGO_NET_OFFLINE", "true");
}

/// The library as a user installs it, from today's source, but for the names of functions inside; the libraries that
/// solvers load by themselves are with it.
pub static INSTALLED: LazyLock<PathBuf> = LazyLock::new(|| {
    let installed = BUILD.join("installed");
    let mut install = Command::new(Path::new(ROOT).join("install.sh"));
    share_build(&mut install);
    run(install.arg(format!("--prefix={}", installed.display())), "cargo");
    let mut cargo = Command::new(env!("CARGO"));
    share_build(&mut cargo);
    cargo.args(["build", "--release", "--locked", "--manifest-path"]).arg(Path::new(ROOT).join("Cargo.toml"));
    let packages = [
        "toron-abaqus",
        "toron-abaqus-sp",
        "toron-calculix",
        "toron-mgis",
        "toron-openradioss",
        "toron-openradioss-sp",
    ];
    run(cargo.args(packages.map(|package| format!("--package={package}"))), "cargo");
    for package in packages {
        let library = format!("lib{}.so", package.replace('-', "_"));
        std::fs::copy(BUILD.join("release").join(&library), installed.join("lib").join(&library)).expect("a copy");
    }
    installed
});

/// Its folder of libraries.
pub static LIBRARY: LazyLock<PathBuf> = LazyLock::new(|| INSTALLED.join("lib"));

/// The law of `examples/own_law` as solvers load it: `own_law_double` and `own_law_single`, shared and static.
pub static OWN_LAW: LazyLock<PathBuf> = LazyLock::new(|| {
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .args(["build", "--release", "--locked", "--manifest-path"])
        .arg(Path::new(ROOT).join("examples/own_law/Cargo.toml"));
    share_build(&mut cargo);
    run(&mut cargo, "cargo");
    BUILD.join("release")
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
    let folder = BUILD.join(name);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}
