//! The C programs of `ffi-tests/c`, and the truth's cases as they and the Fortran programs read them.

use std::ffi::OsStr;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use serde_json::Value;

use toron_test_support::library::{BUILD, LIBRARY, ROOT, SYSTEM, folder, run};

/// Options for double and for single precision.
pub const PRECISIONS: [&[&str]; 2] = [&[], &["-DSINGLE"]];

/// The truth's cases, a line each, in the order that `ffi-tests/c/check.h` reads. Those pressed flat are left to `toron
/// eval`, which calls the same entries: the bounds of the programs for tangents and for S by mode are relative to the
/// values, some of which are 0 there.
pub static CASES: LazyLock<PathBuf> = LazyLock::new(|| {
    let table = std::fs::read_to_string(Path::new(ROOT).join("tests/truth/points.jsonl")).expect("points.jsonl");
    let cases = table.lines().map(|line| serde_json::from_str(line).expect("JSON"));
    let lines: String = cases.filter(|line: &Value| line["category"] != "flattened").map(|line| case(&line)).collect();
    let path = BUILD.join("cases.txt");
    std::fs::write(&path, lines).expect("cases.txt is writable");
    path
});

/// A number of the table, which writes true values as strings of some twenty digits.
fn number(value: &Value) -> f64 {
    value.as_f64().or_else(|| value.as_str()?.parse().ok()).expect("a number")
}

fn numbers<const N: usize>(case: &Value, keys: [&str; N]) -> [f64; N] {
    keys.map(|key| number(&case[key]))
}

/// 11 22 33 12 23 31 of a tensor, which the table writes as 11 22 33 12 13 23.
fn tensor(value: &Value) -> [f64; 6] {
    [0, 1, 2, 3, 5, 4].map(|c| number(&value[c]))
}

/// One case as a line: id, properties, columns of F, stress and its scale, energies and theirs in double and in single
/// precision, invariants and theirs, S by mode, three flags, and DDSDDE, 0 at rest where there is none, with what its
/// error may be. A scale is |truth| plus what rounding F does to it.
fn case(t: &Value) -> String {
    const SINGLE: f64 = 6e-8;
    const MODERATE: [&str; 6] = ["small", "degenerate", "moderate", "failure", "units", "fibre_direction"];
    let p = numbers(&t["params"], ["kel", "ktc", "p", "ktd", "kld", "eps_lim", "alpha", "beta"]);
    let f: [f64; 9] = std::array::from_fn(|i| number(&t["F"][i % 3][i / 3]));
    let stress = tensor(&t["sigma"]);
    let size = (stress.iter().enumerate().map(|(c, s)| if c < 3 { s * s } else { 2.0 * s * s }).sum::<f64>()).sqrt();
    let energies = numbers(t, ["wel", "wtc", "wtd", "wld"]);
    let invariants = numbers(t, ["iel", "itc", "itd", "ild"]);
    let sensitivity: [f64; 4] = std::array::from_fn(|k| number(&t["sensitivity_invariants"][k]));
    let energy_scales = [f64::EPSILON / 2.0, SINGLE].map(|epsilon| {
        // dW/dI where the invariant may be, since a kink within rounding counts.
        let near: [f64; 4] = std::array::from_fn(|k| invariants[k].abs() + 4.0 * epsilon * sensitivity[k]);
        let slopes = [p[0] * near[0], p[2] * p[1] * near[1].powf(p[2] - 1.0), p[3] * near[2], p[4] * near[3]];
        std::array::from_fn::<f64, 4, _>(|k| energies[k].abs() + slopes[k] * sensitivity[k])
    });
    let invariant_scales: [f64; 4] = std::array::from_fn(|k| invariants[k].abs() + sensitivity[k]);
    let modes = ["Sel", "Stc", "Std", "Sld"].map(|key| tensor(&t[key]));
    let flags = [
        MODERATE.contains(&t["category"].as_str().expect("a category")),
        t["failed"].as_bool().expect("a flag"),
        number(&t["fail_margin"]).abs() > 1e-6 * p[5].ln_1p(),
    ];

    let mut line = t["id"].to_string();
    let fibre: [f64; 3] = std::array::from_fn(|i| number(&t["m"][i]));
    let state = [energies, energy_scales[0], energy_scales[1], invariants, invariant_scales];
    let groups = [&p[..], &fibre, &f, &stress, &[size + number(&t["sensitivity"])], state.as_flattened()];
    for x in groups.into_iter().flatten().chain(modes.as_flattened()) {
        write!(line, " {x:e}").expect("a string");
    }
    for flag in flags {
        write!(line, " {}", i32::from(flag)).expect("a string");
    }
    let tangent = |i: usize, j: usize| t.get("ddsdde").map_or(0.0, |rows| number(&rows[i][j]));
    let mut square = 0.0;
    for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
        square += tangent(i, j).powi(2);
        write!(line, " {:e}", tangent(i, j)).expect("a string");
    }
    // What rounding F does to the stiffness at the kinks of `distortion` is measured in `tests/law/tangent.rs`.
    let allowed = match t["category"].as_str() {
        Some("compaction" | "exponent") => 1e-8,
        Some("distortion" | "rest") => f64::INFINITY,
        _ => 1e-12,
    };
    writeln!(line, " {:e}", (allowed * square.sqrt()).min(1e300)).expect("a string");
    line
}

/// Compiles a program of `ffi-tests/c` with these options and libraries; returns its path.
pub fn compile<S: AsRef<OsStr>>(name: &str, options: &[&str], libraries: &[S]) -> PathBuf {
    let program = folder(&format!("c-{name}{}{}", options.concat(), libraries.len())).join("program");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1"]).args(options);
    gcc.arg(concat!("-DEXPECTED_VERSION=\"", env!("CARGO_PKG_VERSION"), "\""));
    gcc.arg(format!("-I{ROOT}/include")).arg(format!("{ROOT}/ffi-tests/c/{name}.c"));
    gcc.args(libraries);
    if name == "environment" {
        // It calls the entries of CalculiX and MGIS too.
        let folder = LIBRARY.display();
        gcc.args([format!("-L{folder}"), format!("-Wl,--enable-new-dtags,-rpath,{folder}"), "-ltoron_calculix".into()])
            .arg("-ltoron_mgis");
    }
    run(gcc.args(SYSTEM).arg("-o").arg(&program), "gcc");
    program
}
