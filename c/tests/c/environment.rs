//! No entry sees or changes its caller's floating-point environment: `ffi-tests/c/environment.c` with the library as it
//! is shipped, and with copies of it that lack the instructions which change environments, where the program must fail.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use crate::c_programs::{PRECISIONS, compile};
use crate::symbols::functions;
use toron_test_support::library::{LIBRARY, folder, run};

/// The program in double and in single precision, with the shared library, wherever the system finds it.
pub static PROGRAMS: LazyLock<[PathBuf; 2]> = LazyLock::new(|| {
    let library = [format!("-L{}", LIBRARY.display()), "-ltoron".into()];
    PRECISIONS.map(|options| compile("environment", options, &library))
});

/// Runs a program with the shared library of a folder.
pub fn run_with(program: &Path, library: &Path) -> Command {
    let mut command = Command::new(program);
    command.env("LD_LIBRARY_PATH", library);
    command
}

fn lines(output: &Output) -> Vec<String> {
    String::from_utf8_lossy(&output.stdout).lines().map(Into::into).collect()
}

/// The shared libraries.
const SHARED: [&str; 3] = ["libtoron.so", "libtoron_calculix.so", "libtoron_mgis.so"];

/// The functions that they give to the outside, but for those of behaviours that take a policy, which is without
/// effect.
pub fn exported() -> BTreeSet<String> {
    let symbols = SHARED.iter().flat_map(|name| functions(&LIBRARY.join(name)));
    symbols.filter(|name| !name.ends_with("_setOutOfBoundsPolicy")).collect()
}

/// Entries that compute nothing: they need no environment of their own.
fn computes(entry: &str) -> bool {
    let about = ["toron_version", "toron_abi_version", "toron_status_message"];
    let tables = ["toron_property", "toron_state"];
    !about.contains(&entry) && !tables.iter().any(|start| entry.starts_with(start))
}

/// Every entry that the library exports is run, and all is well.
fn check_all(run_program: impl Fn(usize) -> Command) {
    let mut called = BTreeSet::new();
    for precision in 0..PRECISIONS.len() {
        called.extend(lines(&run(run_program(precision).arg("--list"), "")));
    }
    assert_eq!(called, exported());
}

#[test]
fn shared_library() {
    check_all(|precision| run_with(&PROGRAMS[precision], &LIBRARY));
}

#[test]
fn static_library() {
    let library = [LIBRARY.join("libtoron.a")];
    check_all(|precision| run_with(&compile("environment", PRECISIONS[precision], &library), &LIBRARY));
}

/// Copies of the shared libraries with nothing done in place of each of these instructions; returns their folder.
fn without(what: &str, instruction: &[u8]) -> PathBuf {
    const NO_OPERATION: u8 = 0x90;
    let folder = folder(&format!("library-{what}"));
    let mut count = 0;
    for shared in SHARED {
        let mut library = std::fs::read(LIBRARY.join(shared)).expect(shared);
        // The name by which a program finds it: that of the file to which this one may be a link.
        let name = std::fs::read_link(LIBRARY.join(shared)).unwrap_or_else(|_| shared.into());
        let at: Vec<_> = (0..library.len()).filter(|&i| library[i..].starts_with(instruction)).collect();
        assert!(!at.is_empty(), "{what}: {shared}");
        for &start in &at {
            library[start..start + instruction.len()].fill(NO_OPERATION);
        }
        count += at.len();
        std::fs::write(folder.join(name), library).expect("a library");
    }
    assert!(count >= 10, "{what}: {count} instructions");
    folder
}

/// The entries that the program accuses of this in this environment, with a broken library.
fn accused(reports: &[String], environment: &str, fault: &str) -> BTreeSet<String> {
    let accusation = format!(": {environment}: {fault} in ");
    reports.iter().filter_map(|line| Some(line.split_once(&accusation)?.0.to_string())).collect()
}

/// What the program says of a broken library, in both precisions.
fn reports(library: &Path) -> Vec<String> {
    let run_program = |program: &PathBuf| {
        let output = run_with(program, library).arg("--sample").output().expect("the program runs");
        assert_eq!(output.status.code(), Some(1), "{}: {output:?}", program.display());
        lines(&output)
    };
    PROGRAMS.iter().flat_map(run_program).collect()
}

/// `ldmxcsr [r12 + 4]`, see `src/host/environment.rs`.
const ENTER: [u8; 6] = [0x41, 0x0f, 0xae, 0x54, 0x24, 0x04];
/// `ldmxcsr [r12]`.
const LEAVE: [u8; 5] = [0x41, 0x0f, 0xae, 0x14, 0x24];

#[test]
fn a_library_that_stays_in_the_callers_environment_is_found_out() {
    let reports = reports(&without("entering-nothing", &ENTER));
    let computing: BTreeSet<_> = exported().into_iter().filter(|entry| computes(entry)).collect();
    assert_eq!(accused(&reports, "all exceptions trapped", "SIGFPE"), computing);
    // What a solver traps: points at fault, and lanes that are computed for nobody.
    let trapped = accused(&reports, "invalid, division by zero, overflow trapped", "SIGFPE");
    for law in ["point", "point_with_properties", "block", "block_with_properties"] {
        for precision in ["f64", "f32"] {
            let entry = format!("toron_hyperelastic_{law}_{precision}");
            assert!(trapped.contains(&entry), "{entry}: {trapped:?}");
        }
    }
    for entry in [
        "toron_abaqus_umat_f64",
        "toron_abaqus_vumat_f32",
        "toron_lsdyna_umat_vector_f64",
        "HYPERELASTIC",
        "ToronHyperelastic_Tridimensional",
        "ToronLinearElastic_PlaneStrain",
    ] {
        assert!(trapped.contains(entry), "{entry}: {trapped:?}");
    }
    for environment in ["subnormal numbers flushed", "round down", "round up", "round to zero"] {
        let different = accused(&reports, environment, "different bits");
        assert!(different.contains("toron_hyperelastic_block_f64"), "{environment}: {different:?}");
    }
}

#[test]
fn a_library_that_leaves_its_own_environment_behind_is_found_out() {
    let reports = reports(&without("leaving-nothing", &LEAVE));
    let computing: BTreeSet<_> = exported().into_iter().filter(|entry| computes(entry)).collect();
    for environment in
        ["default", "all flags raised", "all exceptions trapped", "round up", "subnormal numbers flushed"]
    {
        assert_eq!(accused(&reports, environment, "flags changed"), computing, "{environment}");
    }
}
