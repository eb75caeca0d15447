//! The libraries that Abaqus loads without a compiler, in a program that calls them as Standard and Explicit do. Abaqus
//! is not run.

use std::path::Path;
use std::process::Command;

use crate::c_programs::PRECISIONS;
use toron_test_support::library::{LIBRARY, OWN_LAW, ROOT, folder, run};

/// The library of each precision.
const SHARED: [&str; 2] = ["libtoron_abaqus.so", "libtoron_abaqus_sp.so"];

/// What the program that is compiled with these options writes when it has called a library.
fn written(options: &[&str], library: &Path) -> String {
    let program = folder(&format!("abaqus{}", options.concat())).join("program");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1", "-rdynamic"]).args(options);
    gcc.arg(Path::new(ROOT).join("ffi-tests/abaqus/standard_and_explicit.c"));
    run(gcc.args(["-ldl", "-lm", "-o"]).arg(&program), "gcc");
    let output = run(Command::new(&program).env("LD_BIND_NOW", "1").arg(library), "");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Both laws; a deck that is wrong ends the job by the solver's own routine, with a message.
#[test]
fn libraries_for_abaqus() {
    for (options, library) in PRECISIONS.into_iter().zip(SHARED) {
        let message = " toron, material YARN: number of properties: 10 given, 11 needed\n";
        let text = written(options, &LIBRARY.join(library));
        assert_eq!(text, message.repeat(if options.is_empty() { 2 } else { 1 }));
    }
}

/// A law of one's own, chosen by the material's name; one that begins with no law's ends the job.
#[test]
fn libraries_of_a_law_of_ones_own() {
    let standard = " toron, material REINFORCED_YARN-2: property 3 (k, stiffness of the fibres) is -1.0; allowed: a number from 0 to 1e25\n \
        toron, material REINFORCED_YARN-2: number of state variables (*DEPVAR): 3 given, 4 needed\n \
        toron, material YARN: the name of a material begins with that of its law: REINFORCED, VISCOELASTIC, PLASTIC\n";
    let explicit = " toron, material REINFORCED-1: properties 5 to 7 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero\n \
        toron, material REINFORCED-1: number of state variables (*DEPVAR): 3 given, 4 needed\n \
        toron, material REINFORCE: the name of a material begins with that of its law: REINFORCED, VISCOELASTIC, PLASTIC\n";
    for (options, library) in PRECISIONS.into_iter().zip(["libown_law_double.so", "libown_law_single.so"]) {
        let text = written(&[options, &["-DREINFORCED"]].concat(), &OWN_LAW.join(library));
        assert_eq!(text, if options.is_empty() { format!("{standard}{explicit}") } else { explicit.to_owned() });
    }
}
