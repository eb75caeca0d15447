//! Instructions a point, counted by valgrind: the same on every run, unlike times.
//!
//! `instruction_counts.txt` holds what they were; growth by more than 5 % fails. A change that is meant to cost, or
//! that gains, is recorded by `TORON_RECORD_COUNTS=1 cargo test -p toron-c instruction`, and the file committed with it.
//! Counts belong to a compiler too: record them anew with a new one. Valgrind knows no AVX-512, so that the block runs at
//! AVX2.
//!
//! `umat` and `point` are one point a call, in fused arithmetic; both prepare the law at every call, `point-prepared` and
//! `point-tangent` do not. Here the change of the floating-point environment is counted too.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::library::{BUILD, LIBRARY, ROOT, SYSTEM, run};

/// How many points the program evaluates.
const POINTS: f64 = 1024.0;
/// The program's names of what it runs, and the function whose instructions count.
const ENTRIES: [(&str, &str); 11] = [
    ("umat-f64", "toron_abaqus_umat_f64"),
    ("umat-tangent-f64", "toron_abaqus_umat_tangent_f64"),
    ("point-f64", "toron_hyperelastic_point_with_properties_f64"),
    ("point-prepared-f64", "toron_hyperelastic_point_f64"),
    ("point-tangent-f64", "toron_hyperelastic_point_f64"),
    ("block-stress-f64", "toron_hyperelastic_block_f64"),
    ("block-state-f64", "toron_hyperelastic_block_f64"),
    ("block-tangent-f64", "toron_hyperelastic_block_f64"),
    ("block-stress-f32", "toron_hyperelastic_block_f32"),
    ("block-state-f32", "toron_hyperelastic_block_f32"),
    ("linear-block-f64", "toron_linear_elastic_block_f64"),
];
const GROWTH: f64 = 1.05;

/// `instruction_counts.c` with the library.
fn program() -> PathBuf {
    let program = Path::new(BUILD).join("instruction_counts");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1"]).arg(format!("-I{ROOT}/include"));
    gcc.arg(format!("{ROOT}/c/tests/c/instruction_counts.c")).arg(LIBRARY.join("libtoron.a"));
    run(gcc.args(SYSTEM).arg("-o").arg(&program), "gcc");
    program
}

/// Instructions a point within `function`.
fn count(program: &Path, entry: &str, function: &str) -> f64 {
    let profile = Path::new(BUILD).join(format!("callgrind.{entry}"));
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", &format!("--toggle-collect={function}")]);
    valgrind.arg(format!("--callgrind-out-file={}", profile.display())).arg(program).arg(entry);
    let report = String::from_utf8(run(&mut valgrind, "valgrind").stderr).expect("valgrind writes UTF-8");
    let collected = report.lines().find_map(|line| line.split_once("Collected : ")).expect("a total").1;
    let profile = std::fs::read_to_string(profile).expect("a profile");
    // The names of the kernels' types, demangled or not.
    let runs =
        |level: &str| ["block::avx2::", "block4avx2"].iter().any(|part| profile.contains(&part.replace("avx2", level)));
    assert_eq!(runs("avx2"), entry.contains("block"), "{entry} did not run at AVX2");
    assert!(!runs("avx512") && !profile.contains("block6avx512"), "{entry} did not run at AVX2");
    collected.trim().parse::<f64>().expect("a number") / POINTS
}

#[test]
fn instructions_do_not_grow() {
    let program = program();
    let file = Path::new(ROOT).join("c/tests/c/instruction_counts.txt");
    let recorded = std::fs::read_to_string(&file).expect("instruction_counts.txt");
    let bound = |entry: &str| -> f64 {
        let line = recorded.lines().find_map(|line| line.strip_prefix(entry)).unwrap_or_else(|| panic!("no {entry}"));
        line.trim().parse().expect("a number")
    };
    let (mut counts, mut grown) = (String::new(), Vec::new());
    for (entry, function) in ENTRIES {
        let count = count(&program, entry, function);
        writeln!(counts, "{entry:<20}{count:>8.1}").expect("a string");
        // A loop over so few instructions would not be the law.
        assert!(count > 50.0, "{entry}: {count} instructions a point");
        if std::env::var_os("TORON_RECORD_COUNTS").is_none() && count > GROWTH * bound(entry) {
            grown.push(format!("{entry}: {count:.1} instructions a point, recorded {}", bound(entry)));
        }
    }
    print!("{counts}");
    if std::env::var_os("TORON_RECORD_COUNTS").is_some() {
        std::fs::write(&file, counts).expect("instruction_counts.txt is writable");
    }
    assert!(grown.is_empty(), "{}", grown.join("\n"));
}
