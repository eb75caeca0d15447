//! The programs of `ffi-tests` in C, C++ and Fortran under what looks for faults that show in no result: reads and writes where nothing
//! is, values that nobody has written, leaks, undefined behaviour, races.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::c_programs::{CASES, PRECISIONS, compile};
use crate::ffi::{LSDYNA, MODULES_OF_OPENRADIOSS, fortran_program, shim};
use toron_test_support::library::{LIBRARY, ROOT, SYSTEM, folder, run};

/// A program of `ffi-tests/c`, for one precision, and its arguments.
struct Program {
    name: &'static str,
    precision: &'static [&'static str],
    arguments: Vec<&'static str>,
}

/// All of them but `threads`; of `environment` a sample.
fn programs() -> Vec<Program> {
    let in_both = |precision| {
        let cases = vec![CASES.to_str().expect("UTF-8")];
        let sample = vec!["--sample", "--default"];
        let alone = ["about", "linear_elastic", "structures", "layouts"].map(|name| (name, vec![]));
        let others = [("points", cases.clone()), ("hosts", cases), ("environment", sample)];
        let programs = alone.into_iter().chain(others);
        programs.map(move |(name, arguments)| Program { name, precision, arguments })
    };
    PRECISIONS.into_iter().flat_map(in_both).collect()
}

fn build(name: &str, precision: &[&str], options: &[&str]) -> PathBuf {
    compile(name, &[precision, &["-g"], options].concat(), &[LIBRARY.join("libtoron.a")])
}

/// Checks that a fault of `ffi-tests/c/faults.c` is found: the command ends in words that name it.
fn check_found(command: &mut Command, fault: &str, words: &str) {
    let output = command.arg(fault).output().expect("the program runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && message.contains(words), "{fault}: {}\n{message}", output.status);
}

/// AddressSanitizer and UndefinedBehaviorSanitizer: of the library itself they see what its calls of the C library do.
const SANITIZERS: [&str; 2] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

#[test]
fn sanitizers() {
    for Program { name, precision, arguments } in programs() {
        run(Command::new(build(name, precision, &SANITIZERS)).args(arguments), "");
    }
    for precision in PRECISIONS {
        run(Command::new(build("threads", precision, &SANITIZERS)).arg(&*CASES), "");
    }
    let faults = build("faults", &[], &SANITIZERS);
    for (fault, words) in
        [("beyond", "heap-buffer-overflow"), ("leak", "detected memory leaks"), ("overflow", "signed integer overflow")]
    {
        check_found(&mut Command::new(&faults), fault, words);
    }
}

/// The module and the shims, as far as they are compiled by the user: what they pass to the library and take from it.
#[test]
fn sanitizers_in_fortran() {
    let sanitized = |name: &str, options: &[&str], sources: &[PathBuf]| {
        fortran_program(name, &[&SANITIZERS, options].concat(), sources);
    };
    sanitized("module.f90", &[], &[Path::new(ROOT).join("include/toron.f90")]);
    sanitized("umat.f90", &[], &[shim("abaqus_umat.f")]);
    sanitized("vumat.F90", &[], &[shim("abaqus_vumat_dp.f")]);
    sanitized("vumat.F90", &["-DSINGLE"], &[shim("abaqus_vumat_sp.f")]);
    sanitized("lsdyna.f90", &[], &LSDYNA.map(shim));
    sanitized("lsdyna_frictional.f90", &["-DTORON_FRICTIONAL", "-DTORON_MT=44"], &LSDYNA.map(shim));
    let sources = [MODULES_OF_OPENRADIOSS.into(), shim("openradioss_lecmuser.f"), shim("openradioss_luser.f")];
    for precision in PRECISIONS {
        sanitized("openradioss.F90", precision, &sources);
    }
}

/// The classes of `toron.hpp`, which are compiled by the user.
#[test]
fn sanitizers_in_cpp() {
    let program = folder("cpp-sanitizers").join("program");
    let mut gpp = Command::new("g++");
    gpp.args(["-std=c++20", "-Wall", "-Wextra", "-Werror", "-O1", "-g", "-I"]).arg(Path::new(ROOT).join("include"));
    gpp.args(SANITIZERS).arg(Path::new(ROOT).join("ffi-tests/installed/cpp/block.cpp"));
    run(gpp.arg(LIBRARY.join("libtoron.a")).args(SYSTEM).arg("-o").arg(&program), "g++");
    run(&mut Command::new(program), "");
}

/// Valgrind with a tool; its exit code tells that the tool has found something. It knows no AVX-512: the library runs
/// AVX2.
fn valgrind(tool: &str, program: &Path) -> Command {
    let mut valgrind = Command::new("valgrind");
    valgrind.arg(format!("--tool={tool}")).args(["--quiet", "--error-exitcode=9"]);
    if tool == "memcheck" {
        valgrind.args(["--leak-check=full", "--track-origins=no"]);
    }
    valgrind.arg(program);
    valgrind
}

/// Makes the programs tell valgrind what is written and what is nobody's.
const MEMCHECK: [&str; 1] = ["-DMEMCHECK"];

fn memcheck(precision: &[&str]) {
    for program in programs().into_iter().filter(|program| program.precision == precision) {
        run(valgrind("memcheck", &build(program.name, precision, &MEMCHECK)).args(program.arguments), "valgrind");
    }
}

#[test]
fn memcheck_in_double_precision() {
    memcheck(PRECISIONS[0]);
}

#[test]
fn memcheck_in_single_precision() {
    memcheck(PRECISIONS[1]);
}

#[test]
fn memcheck_finds_faults() {
    let faults = build("faults", &[], &MEMCHECK);
    for (fault, words) in [
        ("beyond", "Invalid write"),
        ("guard", "Invalid read"),
        ("unwritten", "uninitialised value"),
        ("leak", "definitely lost"),
    ] {
        check_found(&mut valgrind("memcheck", &faults), fault, words);
    }
}

/// Addresses in a program of what the library remembers of the processor, a byte for each question: relaxed atomics,
/// which drd takes for ordinary memory.
fn processor_features(program: &Path) -> Vec<String> {
    let symbols = run(Command::new("nm").arg(program), "binutils").stdout;
    let lines = String::from_utf8_lossy(&symbols);
    let of_features = lines.lines().filter(|line| line.contains("has_avx") && line.contains("STORAGE"));
    of_features.filter_map(|line| Some(line.split_whitespace().next()?.to_string())).collect()
}

/// Nothing else is shared between threads: the library's first use, and everything after it.
#[test]
fn threads_do_not_race() {
    const ROUNDS: &str = "1";
    for precision in PRECISIONS {
        let program = build("threads", precision, &["-DDRD", "-no-pie"]);
        let features = processor_features(&program);
        assert_eq!(features.len(), 2, "AVX2 and AVX-512: {features:?}");
        run(valgrind("drd", &program).arg(&*CASES).arg(ROUNDS).args(features), "valgrind");
        // Races are found: these, where drd is told of none.
        let output = valgrind("drd", &program).arg(&*CASES).arg(ROUNDS).output().expect("valgrind runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(9) && message.contains("Conflicting"), "{}\n{message}", output.status);
    }
}
