//! The libraries that Abaqus loads without a compiler, in a program that calls them as Standard and Explicit do. Abaqus is not run.

use std::path::Path;
use std::process::Command;

use crate::c_programs::PRECISIONS;
use crate::library::{LIBRARY, ROOT, folder, run};

/// The library of each precision.
const SHARED: [&str; 2] = ["libtoron_abaqus.so", "libtoron_abaqus_sp.so"];

/// Both laws; a deck that is wrong ends the job by the solver's own routine, with a message.
#[test]
fn libraries_for_abaqus() {
    for (options, library) in PRECISIONS.into_iter().zip(SHARED) {
        let program = folder(&format!("abaqus{}", options.concat())).join("program");
        let mut gcc = Command::new("gcc");
        gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1", "-rdynamic"]).args(options);
        gcc.arg(Path::new(ROOT).join("ffi-tests/abaqus/standard_and_explicit.c"));
        run(gcc.args(["-ldl", "-lm", "-o"]).arg(&program), "gcc");
        let output = run(Command::new(&program).env("LD_BIND_NOW", "1").arg(LIBRARY.join(library)), "");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let message = " toron, material YARN: number of properties: 10 given, 11 needed\n";
        assert_eq!(text, message.repeat(if options.is_empty() { 2 } else { 1 }));
    }
}

/// Nothing but Abaqus's own names.
#[test]
fn nothing_else_is_exported() {
    for (library, names) in SHARED.into_iter().zip([&["umat_", "vumat_"][..], &["vumat_"]]) {
        let output = run(Command::new("nm").args(["-D", "--defined-only"]).arg(LIBRARY.join(library)), "binutils");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let found: Vec<&str> = text.lines().filter_map(|line| Some(line.split_once(" T ")?.1)).collect();
        assert_eq!(found, names, "{library}");
    }
}
