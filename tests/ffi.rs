//! The library as its hosts call it: the C and Fortran programs of `ffi-tests`, linked with the library as it is shipped,
//! against the truth's numbers.

#[path = "common/library.rs"]
mod library;

use std::ffi::OsStr;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use library::{BUILD, LIBRARY, ROOT, SYSTEM, folder, run};
use serde_json::Value;

/// The truth's cases, a line each, in the order that `ffi-tests/c/check.h` reads.
static CASES: LazyLock<PathBuf> = LazyLock::new(|| {
    let table = std::fs::read_to_string(Path::new(ROOT).join("tests/truth/points.jsonl")).expect("points.jsonl");
    let lines: String = table.lines().map(|line| case(&serde_json::from_str(line).expect("JSON"))).collect();
    let path = Path::new(BUILD).join("cases.txt");
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
/// precision, invariants and theirs, S by mode, three flags, and DDSDDE, 0 at rest where there is none, with what its error may
/// be. A scale is |truth| plus what rounding F does to it.
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
    // What rounding F does to the stiffness at the kinks of `distortion` is measured in `tests/tangent.rs`.
    let allowed = match t["category"].as_str() {
        Some("compaction" | "exponent") => 1e-8,
        Some("distortion" | "rest") => f64::INFINITY,
        _ => 1e-12,
    };
    writeln!(line, " {:e}", (allowed * square.sqrt()).min(1e300)).expect("a string");
    line
}

/// Compiles and runs a program of `ffi-tests/c`.
fn c_program<S: AsRef<OsStr>>(name: &str, options: &[&str], libraries: &[S], reads_cases: bool) {
    let program = folder(&format!("c-{name}{}{}", options.concat(), libraries.len())).join("program");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1"]).args(options);
    gcc.arg(concat!("-DEXPECTED_VERSION=\"", env!("CARGO_PKG_VERSION"), "\""));
    gcc.arg(format!("-I{ROOT}/include")).arg(format!("{ROOT}/ffi-tests/c/{name}.c"));
    run(gcc.args(libraries).args(SYSTEM).arg("-o").arg(&program), "gcc");
    let mut program = Command::new(program);
    if reads_cases {
        program.arg(&*CASES);
    }
    run(&mut program, "");
}

#[test]
fn c_programs() {
    let library = [LIBRARY.join("libtoron.a")];
    for precision in [&[][..], &["-DSINGLE"]] {
        c_program("about", precision, &library, false);
        for name in ["points", "hosts", "threads", "levels"] {
            c_program(name, precision, &library, true);
        }
    }
    c_program("linear_elastic", &[], &library, false);
}

#[test]
fn c_programs_with_the_shared_library() {
    let folder = LIBRARY.display();
    let library = [format!("-L{folder}"), "-ltoron".into(), format!("-Wl,-rpath,{folder}")];
    c_program("points", &[], &library, true);
    c_program("hosts", &[], &library, true);
}

/// The shims' own flags: they name all arguments that the solver passes, and use few.
const SHIM_WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-Wno-unused-dummy-argument", "-Werror"];

/// Kinds of a solver's build.
const INTEGERS_64: &str = "-fdefault-integer-8";
const REALS_64: &str = "-fdefault-real-8";

/// Hosts that stop at the first floating-point exception: none may leave the library.
const TRAPS: &str = "-ffpe-trap=invalid,zero,overflow";

fn shim(name: &str) -> PathBuf {
    Path::new(ROOT).join("fortran-shim").join(name)
}

/// Compiles and runs a program of `ffi-tests/fortran` with these sources.
fn fortran_program(name: &str, options: &[&str], sources: &[PathBuf]) {
    let folder = folder(&format!("fortran-{name}{}", options.concat()));
    let program = folder.join("program");
    let fortran = Path::new(ROOT).join("ffi-tests/fortran");
    let mut gfortran = Command::new("gfortran");
    gfortran.args(["-std=f2018", "-O1", "-fcheck=bounds", "-Wno-compare-reals"]).args(SHIM_WARNINGS).args(options);
    gfortran.arg("-J").arg(&folder).args(sources).arg(fortran.join("cases.f90")).arg(fortran.join(name));
    run(gfortran.arg(LIBRARY.join("libtoron.a")).args(SYSTEM).arg("-o").arg(&program), "gfortran");
    run(Command::new(program).arg(&*CASES), "");
}

#[test]
fn fortran_module() {
    for traps in [&[][..], &[TRAPS]] {
        fortran_program("module.f90", traps, &[Path::new(ROOT).join("include/toron.f90")]);
    }
}

#[test]
fn shims_of_abaqus() {
    for kinds in [&[][..], &[INTEGERS_64], &[INTEGERS_64, REALS_64], &[TRAPS]] {
        fortran_program("umat.f90", kinds, &[shim("abaqus_umat.f")]);
        fortran_program("vumat.F90", kinds, &[shim("abaqus_vumat_dp.f")]);
        fortran_program("vumat.F90", &[kinds, &["-DSINGLE"]].concat(), &[shim("abaqus_vumat_sp.f")]);
    }
}

#[test]
fn shims_of_lsdyna() {
    let sources = ["lsdyna_umat41.f", "lsdyna_umat41v.f", "lsdyna_utan41.f", "lsdyna_utan41v.f"].map(shim);
    let kinds: [&[&str]; 4] = [&[], &[INTEGERS_64], &[REALS_64], &[INTEGERS_64, REALS_64]];
    for kinds in kinds.into_iter().chain([&[TRAPS][..], &[INTEGERS_64, REALS_64, TRAPS]]) {
        fortran_program("lsdyna.f90", kinds, &sources);
    }
}

/// All seven.
fn shims() -> Vec<PathBuf> {
    let folder = std::fs::read_dir(Path::new(ROOT).join("fortran-shim")).expect("fortran-shim");
    let files = folder.map(|entry| entry.expect("a file").path());
    let shims: Vec<_> = files.filter(|path| path.extension() == Some("f".as_ref())).collect();
    assert_eq!(shims.len(), 7);
    shims
}

/// Abaqus compiles fixed form with 132 columns (`-extend_source`), other builds with 72: both must read the same text, so that
/// no statement may be continued by what stands beyond column 72.
const LINE_LENGTHS: [u32; 2] = [72, 132];

#[test]
fn shims_are_plain_fixed_form() {
    for path in shims() {
        let text = std::fs::read_to_string(&path).expect("a shim");
        for (number, line) in (1..).zip(text.lines()) {
            let place = format!("{}, line {number}", path.display());
            assert!(line.chars().all(|c| c == ' ' || c.is_ascii_graphic()), "{place}: a tab, or not ASCII");
            assert!(line.len() <= 72, "{place}: beyond column 72");
            if line.is_empty() || line.starts_with(['!', 'C']) {
                continue;
            }
            let (label, statement) = line.split_at(6);
            assert!(label == "      " || label == "     &", "{place}: columns 1 to 6");
            assert!(!statement.ends_with(['&', ' ']), "{place}: ends with an ampersand or a blank");
        }
    }
}

#[test]
fn shims_compile_at_both_line_lengths_with_all_kinds() {
    for length in LINE_LENGTHS {
        for kinds in [&[][..], &[INTEGERS_64], &[INTEGERS_64, REALS_64]] {
            let mut gfortran = Command::new("gfortran");
            gfortran.args(["-std=f2008", "-fsyntax-only"]).arg(format!("-ffixed-line-length-{length}"));
            run(gfortran.args(SHIM_WARNINGS).args(kinds).args(shims()), "gfortran");
        }
    }
}

/// LLVM's Fortran compiler by one of the names that distributions give it.
fn flang() -> Option<String> {
    let versions = (16..=22).rev().flat_map(|version| [format!("flang-{version}"), format!("flang-new-{version}")]);
    let mut names = ["flang".into(), "flang-new".into()].into_iter().chain(versions);
    names.find(|name| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success()))
}

#[test]
fn shims_compile_with_flang() {
    let Some(flang) = flang() else {
        // Past the capture of a passing test's output.
        let message = "skipped: no flang here; on Debian or Ubuntu: apt-get install flang-16";
        writeln!(std::io::stderr(), "{message}").expect("stderr");
        return;
    };
    let folder = folder("fortran-flang");
    for length in LINE_LENGTHS {
        for kinds in [&[][..], &[INTEGERS_64], &[INTEGERS_64, REALS_64]] {
            for shim in shims() {
                let mut command = Command::new(&flang);
                command.args(["-c", "-pedantic"]).arg(format!("-ffixed-line-length={length}")).args(kinds);
                let output = run(command.arg(&shim).arg("-o").arg(folder.join("shim.o")), "flang-16");
                let warnings = String::from_utf8_lossy(&output.stderr);
                assert!(warnings.is_empty(), "{}: {warnings}", shim.display());
            }
        }
    }
}
