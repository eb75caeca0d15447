//! Instructions a point, counted by valgrind: the same on every run, unlike times.
//!
//! `instruction_counts.txt` holds what they were; growth by more than 5 % fails. A change that is meant to cost, or
//! that gains, is recorded by `cargo xtask update counts`, and the file committed with it. Counts belong to a compiler
//! too: record them anew with a new one. Valgrind knows no AVX-512, so that the block runs at AVX2.
//!
//! `umat` and `point` are one point a call, in fused arithmetic; both prepare the law at every call, `point-prepared`
//! and `point-tangent` do not. Here the change of the floating-point environment is counted too. `frictional`
//! is the law with friction between the fibres, and `linear` the linear elastic law, whose frame follows the fibre where the name says nothing else.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use toron_test_support::library::{BUILD, LIBRARY, ROOT, SYSTEM, run};
use toron_test_support::update::is_asked;

/// How many points the program evaluates.
const POINTS: f64 = 1024.0;
/// The program's names of what it runs, the function whose instructions count, and whether it evaluates the points in
/// lanes.
const ENTRIES: [(&str, &str, bool); 45] = [
    ("umat-f64", "toron_abaqus_umat_f64", false),
    ("umat-tangent-f64", "toron_abaqus_umat_tangent_f64", false),
    ("point-f64", "toron_hyperelastic_point_with_properties_f64", false),
    ("point-prepared-f64", "toron_hyperelastic_point_f64", false),
    ("point-tangent-f64", "toron_hyperelastic_point_f64", false),
    ("point-prepared-f32", "toron_hyperelastic_point_f32", false),
    ("block-stress-f64", "toron_hyperelastic_block_f64", true),
    ("block-state-f64", "toron_hyperelastic_block_f64", true),
    ("block-tangent-f64", "toron_hyperelastic_block_f64", true),
    ("block-stress-f32", "toron_hyperelastic_block_f32", true),
    ("block-state-f32", "toron_hyperelastic_block_f32", true),
    ("block-tangent-f32", "toron_hyperelastic_block_f32", true),
    ("vumat-f64", "toron_abaqus_vumat_f64", true),
    ("vumat-f32", "toron_abaqus_vumat_f32", true),
    ("ls-dyna-f64", "toron_lsdyna_umat_f64", false),
    ("ls-dyna-tangent-f64", "toron_lsdyna_utan_f64", false),
    ("ls-dyna-vector-f64", "toron_lsdyna_umat_vector_f64", true),
    ("openradioss-f64", "toron_openradioss_luser_f64", true),
    ("mgis-f64", "ToronHyperelastic_Tridimensional", false),
    ("mgis-tangent-f64", "ToronHyperelastic_Tridimensional", false),
    ("calculix-f64", "HYPERELASTIC", false),
    ("frictional-point-f64", "toron_frictional_point_f64", false),
    ("frictional-point-tangent-f64", "toron_frictional_point_f64", false),
    ("frictional-umat-f64", "toron_abaqus_frictional_umat_f64", false),
    ("frictional-block-f64", "toron_frictional_block_f64", true),
    ("linear-point-f64", "toron_linear_elastic_point_f64", true),
    ("linear-point-polar-f64", "toron_linear_elastic_point_f64", true),
    ("linear-point-spin-f64", "toron_linear_elastic_point_f64", true),
    ("linear-point-tangent-f64", "toron_linear_elastic_point_f64", false),
    ("linear-point-spin-tangent-f64", "toron_linear_elastic_point_f64", false),
    ("linear-increment-f64", "toron_linear_elastic_increment_f64", false),
    ("linear-block-f64", "toron_linear_elastic_block_f64", true),
    ("linear-block-polar-f64", "toron_linear_elastic_block_f64", true),
    ("linear-block-spin-f64", "toron_linear_elastic_block_f64", true),
    ("linear-block-tangent-f64", "toron_linear_elastic_block_f64", false),
    ("linear-block-f32", "toron_linear_elastic_block_f32", true),
    ("linear-umat-f64", "toron_abaqus_linear_umat_f64", true),
    ("linear-umat-tangent-f64", "toron_abaqus_linear_umat_f64", false),
    ("linear-vumat-f64", "toron_abaqus_linear_vumat_f64", true),
    ("linear-ls-dyna-f64", "toron_lsdyna_linear_umat_f64", true),
    ("linear-ls-dyna-vector-f64", "toron_lsdyna_linear_umat_vector_f64", true),
    ("linear-openradioss-f64", "toron_openradioss_luser_f64", true),
    ("linear-mgis-f64", "ToronLinearElastic_Tridimensional", true),
    ("linear-mgis-tangent-f64", "ToronLinearElastic_Tridimensional", false),
    ("linear-calculix-f64", "LINEARELASTIC", false),
];
const GROWTH: f64 = 1.05;

/// `instruction_counts.c` with the library.
fn program() -> PathBuf {
    let program = BUILD.join("instruction_counts");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1"]).arg(format!("-I{ROOT}/include"));
    gcc.arg(format!("{ROOT}/c/tests/c/instruction_counts.c")).arg(LIBRARY.join("libtoron.a"));
    let folder = LIBRARY.display();
    gcc.args([format!("-L{folder}"), format!("-Wl,-rpath,{folder}"), "-ltoron_calculix".into(), "-ltoron_mgis".into()]);
    run(gcc.args(SYSTEM).arg("-o").arg(&program), "gcc");
    program
}

/// Instructions a point within `function`.
fn count(program: &Path, entry: &str, function: &str, lanes: bool) -> f64 {
    let profile = BUILD.join(format!("callgrind.{entry}"));
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", &format!("--toggle-collect={function}")]);
    valgrind.arg(format!("--callgrind-out-file={}", profile.display())).arg(program).arg(entry);
    let report = String::from_utf8(run(&mut valgrind, "valgrind").stderr).expect("valgrind writes UTF-8");
    let collected = report.lines().find_map(|line| line.split_once("Collected : ")).expect("a total").1;
    let profile = std::fs::read_to_string(profile).expect("a profile");
    // The names of the kernels' types, demangled or not.
    let runs =
        |level: &str| ["block::avx2::", "block4avx2"].iter().any(|part| profile.contains(&part.replace("avx2", level)));
    assert_eq!(runs("avx2"), lanes, "{entry}: at AVX2 or not");
    assert!(!runs("avx512") && !profile.contains("block6avx512"), "{entry} did not run at AVX2");
    collected.trim().parse::<f64>().expect("a number") / POINTS
}

#[test]
fn instructions_do_not_grow() {
    let program = program();
    let file = Path::new(ROOT).join("c/tests/c/instruction_counts.txt");
    let recorded = std::fs::read_to_string(&file).expect("instruction_counts.txt");
    let bound = |entry: &str| -> f64 {
        let line = recorded.lines().find_map(|line| line.strip_prefix(entry)?.strip_prefix(' '));
        line.unwrap_or_else(|| panic!("no {entry}")).trim().parse().expect("a number")
    };
    let (mut counts, mut grown) = (String::new(), Vec::new());
    for (entry, function, lanes) in ENTRIES {
        let count = count(&program, entry, function, lanes);
        writeln!(counts, "{entry:<30}{count:>8.1}").expect("a string");
        // A loop over so few instructions would not be the law.
        assert!(count > 50.0, "{entry}: {count} instructions a point");
        if !is_asked("counts") && count > GROWTH * bound(entry) {
            grown.push(format!("{entry}: {count:.1} instructions a point, recorded {}", bound(entry)));
        }
    }
    print!("{counts}");
    if is_asked("counts") {
        std::fs::write(&file, counts).expect("instruction_counts.txt is writable");
    }
    assert!(grown.is_empty(), "{}", grown.join("\n"));
}
