//! The library as its hosts call it: the C and Fortran programs of `ffi-tests`, linked with the library as it is
//! shipped, against the truth's numbers.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::c_programs::{CASES, PRECISIONS, compile};
use toron_test_support::library::{INSTALLED, LIBRARY, OWN_LAW, ROOT, SYSTEM, folder, run};

/// Compiles and runs a program of `ffi-tests/c`.
fn c_program<S: AsRef<OsStr>>(name: &str, options: &[&str], libraries: &[S], reads_cases: bool) {
    let mut program = Command::new(compile(name, options, libraries));
    if reads_cases {
        program.arg(&*CASES);
    }
    run(&mut program, "");
}

#[test]
fn c_programs() {
    let library = [LIBRARY.join("libtoron.a")];
    for precision in PRECISIONS {
        for name in ["about", "linear_elastic", "structures", "layouts", "pages"] {
            c_program(name, precision, &library, false);
        }
        for name in ["points", "hosts", "threads", "levels"] {
            c_program(name, precision, &library, true);
        }
    }
}

#[test]
fn c_programs_with_the_shared_library() {
    let folder = LIBRARY.display();
    let library = [format!("-L{folder}"), "-ltoron".into(), format!("-Wl,-rpath,{folder}")];
    c_program("points", &[], &library, true);
    c_program("hosts", &[], &library, true);
}

/// What a user has compiled against the frozen header of ABI 2 runs with today's library, and compiles with today's
/// header.
#[test]
fn a_program_compiled_against_the_frozen_abi() {
    let (source, library) = (Path::new(ROOT).join("ffi-tests/abi"), LIBRARY.display());
    for (name, header) in [("frozen", source.clone()), ("today", INSTALLED.join("include"))] {
        for precision in PRECISIONS {
            let program = folder(&format!("abi-{name}{}", precision.concat())).join("program");
            let mut gcc = Command::new("gcc");
            gcc.args(["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I"]).arg(&header).args(precision);
            gcc.arg(source.join("program.c"));
            gcc.args([format!("-L{library}"), "-ltoron".into(), format!("-Wl,-rpath,{library}")]);
            run(gcc.args(SYSTEM).arg("-o").arg(&program), "gcc");
            run(&mut Command::new(program), "");
        }
    }
}

/// A program compiled when a structure still ended earlier, before some of its outputs, runs with today's library.
#[test]
fn a_program_compiled_against_a_shorter_structure() {
    let header = std::fs::read_to_string(INSTALLED.join("include/toron.h")).expect("toron.h");
    let (before, after) = header.split_once("typedef struct toron_point_f64 {").expect("the structure");
    let end = after.find("} toron_point_f64;").expect("its end");
    let cut =
        after.find("double *modes;").and_then(|modes| after[..modes].rfind("/*")).expect("a member with its comment");
    assert!(cut < end && after[cut..end].contains("double *tangent;"), "what is cut off is of this structure");
    let shorter = format!("{before}typedef struct toron_point_f64 {{{}{}", &after[..cut], &after[end..]);
    let folder = folder("shorter-structure");
    std::fs::write(folder.join("toron.h"), shorter).expect("a header");
    let program = folder.join("program");
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-I"]).arg(&folder);
    gcc.arg(Path::new(ROOT).join("ffi-tests/installed/c/point.c")).arg(LIBRARY.join("libtoron.a"));
    run(gcc.args(SYSTEM).arg("-o").arg(&program), "gcc");
    assert_eq!(String::from_utf8_lossy(&run(&mut Command::new(program), "").stdout), "1598.596 MPa\n");
}

/// The shims' own flags: they name all arguments that the solver passes, and use few.
const SHIM_WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-Wno-unused-dummy-argument", "-Werror"];

/// Kinds of a solver's build.
const INTEGERS_64: &str = "-fdefault-integer-8";
const REALS_64: &str = "-fdefault-real-8";

/// Hosts that stop at the first floating-point exception: none may leave the library.
const TRAPS: &str = "-ffpe-trap=invalid,zero,overflow";

pub fn shim(name: &str) -> PathBuf {
    Path::new(ROOT).join("fortran-shim").join(name)
}

/// Compiles and runs a program of `ffi-tests/fortran` with these sources.
pub fn fortran_program(name: &str, options: &[&str], sources: &[PathBuf]) {
    fortran_program_with(&LIBRARY.join("libtoron.a"), name, options, sources);
}

/// The same with another library.
fn fortran_program_with(library: &Path, name: &str, options: &[&str], sources: &[PathBuf]) {
    let folder = folder(&format!("fortran-{name}{}", options.concat()));
    let program = folder.join("program");
    let fortran = Path::new(ROOT).join("ffi-tests/fortran");
    let mut gfortran = Command::new("gfortran");
    gfortran.args(["-std=f2018", "-O1", "-fcheck=bounds", "-Wno-compare-reals"]).args(SHIM_WARNINGS).args(options);
    gfortran.arg("-J").arg(&folder).args(sources).arg(fortran.join("cases.f90")).arg(fortran.join(name));
    run(gfortran.arg(library).args(SYSTEM).arg("-o").arg(&program), "gfortran");
    // What a main program has allocated is kept to its end, which AddressSanitizer takes for a leak.
    run(Command::new(program).arg(&*CASES).env("ASAN_OPTIONS", "detect_leaks=0"), "");
}

#[test]
fn fortran_module() {
    for traps in [&[][..], &[TRAPS]] {
        fortran_program("module.f90", traps, &[Path::new(ROOT).join("include/toron.f90")]);
    }
}

/// Without `target` at the structures among the module's arguments, gfortran does not see at `-O3` that an element has
/// failed.
#[test]
fn fortran_example() {
    let folder = folder("fortran-example");
    let program = folder.join("program");
    let mut gfortran = Command::new("gfortran");
    gfortran.args(["-std=f2018", "-O3", "-Wall", "-Wextra", "-Werror", "-J"]).arg(&folder);
    gfortran.args(["include/toron.f90", "examples/fortran/yarn.f90"].map(|source| Path::new(ROOT).join(source)));
    run(gfortran.arg(LIBRARY.join("libtoron.a")).args(SYSTEM).arg("-o").arg(&program), "gfortran");
    let output = run(Command::new("timeout").arg("60").arg(program), "coreutils").stdout;
    let output = String::from_utf8(output).expect("UTF-8");
    let lines = output.lines().collect::<Vec<_>>();
    assert!(lines[0].starts_with("there is no system of units \"mm-tonne-hours\"; allowed: "), "{output}");
    assert_eq!(lines[1], "stress 11 22 33: 1998.25 -57.91 -146.75 MPa");
    assert_eq!(lines[2], "broken after 42.79 microseconds in element 1");
}

#[test]
fn shims_of_abaqus() {
    for kinds in [&[][..], &[INTEGERS_64], &[INTEGERS_64, REALS_64], &[TRAPS]] {
        fortran_program("umat.f90", kinds, &[shim("abaqus_umat.f")]);
        fortran_program("vumat.F90", kinds, &[shim("abaqus_vumat_dp.f")]);
        fortran_program("vumat.F90", &[kinds, &["-DSINGLE"]].concat(), &[shim("abaqus_vumat_sp.f")]);
    }
}

/// The routines of LS-DYNA.
pub const LSDYNA: [&str; 4] = ["lsdyna_umat.F", "lsdyna_umatv.F", "lsdyna_utan.F", "lsdyna_utanv.F"];

#[test]
fn shims_of_lsdyna() {
    let sources = LSDYNA.map(shim);
    let kinds: [&[&str]; 4] = [&[], &[INTEGERS_64], &[REALS_64], &[INTEGERS_64, REALS_64]];
    for kinds in kinds.into_iter().chain([&[TRAPS][..], &[INTEGERS_64, REALS_64, TRAPS]]) {
        fortran_program("lsdyna.f90", kinds, &sources);
    }
}

/// Both argument lists, every material number, both laws in one program.
#[test]
fn shims_of_lsdyna_in_other_releases_and_under_other_numbers() {
    for number in [43, 44, 45, 47, 48, 49, 50] {
        for release in [&[][..], &["-DTORON_SHORT_LIST"]] {
            // Each number with one set of kinds, all of them with some number.
            let kinds: &[&str] = [&[][..], &[INTEGERS_64, REALS_64], &[REALS_64], &[INTEGERS_64], &[TRAPS]][number % 5];
            let options = [release, kinds].concat();
            let other = folder(&format!("fortran-lsdyna-{number}{}", options.concat()));
            let mut sources: Vec<PathBuf> = LSDYNA.map(shim).into();
            for name in LSDYNA {
                let object = other.join(name).with_extension("o");
                let mut gfortran = Command::new("gfortran");
                gfortran.args(["-std=f2018", "-O1", "-c", "-DTORON_LINEAR_ELASTIC"]).args(SHIM_WARNINGS).args(&options);
                gfortran.arg(format!("-DTORON_MT={number}")).arg(shim(name)).arg("-o").arg(&object);
                run(&mut gfortran, "gfortran");
                sources.push(object);
            }
            let names = ["UMAT_OTHER=umat#", "UMATV_OTHER=umat#v", "UTAN_OTHER=utan#", "UTANV_OTHER=utan#v"];
            let names = names.map(|name| format!("-D{}", name.replace('#', &number.to_string())));
            let names = names.each_ref().map(String::as_str);
            fortran_program("lsdyna_variants.F90", &[&options[..], &names].concat(), &sources);
        }
    }
}

/// The law with friction, as another material.
#[test]
fn shims_of_lsdyna_with_friction() {
    let law = ["-DTORON_FRICTIONAL", "-DTORON_MT=44"];
    for kinds in [&[][..], &[INTEGERS_64, REALS_64], &[INTEGERS_64, REALS_64, TRAPS]] {
        fortran_program("lsdyna_frictional.f90", &[kinds, &law].concat(), &LSDYNA.map(shim));
    }
}

/// A law of one's own, which the shims take by its name.
#[test]
fn shims_of_lsdyna_with_a_law_of_ones_own() {
    let law = ["-DTORON_NAME='REINFORCED'", "-DTORON_NHV=4", "-DTORON_FIBRE=5"];
    for (kinds, library) in [
        (&[REALS_64][..], "libown_law_double.a"),
        (&[INTEGERS_64, REALS_64, TRAPS], "libown_law_double.a"),
        (&[], "libown_law_single.a"),
    ] {
        fortran_program_with(&OWN_LAW.join(library), "own_law.f90", &[kinds, &law].concat(), &LSDYNA.map(shim));
    }
}

/// The entries of that law that the shims call.
#[test]
fn lsdyna_with_a_law_of_ones_own() {
    for (precision, library) in PRECISIONS.into_iter().zip(["libown_law_double.a", "libown_law_single.a"]) {
        c_program("own_law", precision, &[OWN_LAW.join(library)], false);
    }
}

/// In the solver's own kinds of reals; integers have 4 bytes.
#[test]
fn shims_of_openradioss() {
    let sources = [MODULES_OF_OPENRADIOSS.into(), shim("openradioss_lecmuser.f"), shim("openradioss_luser.f")];
    for kinds in [&[][..], &["-DSINGLE"], &[TRAPS], &["-DSINGLE", TRAPS]] {
        fortran_program("openradioss.F90", kinds, &sources);
    }
}

/// The modules of its SDK, as far as the shims see them.
pub const MODULES_OF_OPENRADIOSS: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../ffi-tests/fortran/openradioss_sdk.F90");

/// Those that use modules of a solver, which has to be compiled first, with its kinds of integers.
fn needs_modules(shim: &Path) -> bool {
    shim.file_name().is_some_and(|name| name.to_string_lossy().starts_with("openradioss"))
}

/// All nine.
fn shims() -> Vec<PathBuf> {
    let folder = std::fs::read_dir(Path::new(ROOT).join("fortran-shim")).expect("fortran-shim");
    let files = folder.map(|entry| entry.expect("a file").path());
    let fixed_form = |path: &PathBuf| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("f"));
    let shims: Vec<_> = files.filter(fixed_form).collect();
    assert_eq!(shims.len(), 9);
    shims
}

/// Abaqus compiles fixed form with 132 columns (`-extend_source`), other builds with 72: both must read the same text,
/// so that no statement may be continued by what stands beyond column 72.
const LINE_LENGTHS: [u32; 2] = [72, 132];

#[test]
fn shims_are_plain_fixed_form() {
    for path in shims() {
        let text = std::fs::read_to_string(&path).expect("a shim");
        for (number, line) in (1..).zip(text.lines()) {
            let place = format!("{}, line {number}", path.display());
            assert!(line.chars().all(|c| c == ' ' || c.is_ascii_graphic()), "{place}: a tab, or not ASCII");
            assert!(line.len() <= 72, "{place}: beyond column 72");
            if line.is_empty() || line.starts_with(['!', 'C', '#']) {
                continue;
            }
            let (label, statement) = line.split_at(6);
            assert!(label == "      " || label == "     &", "{place}: columns 1 to 6");
            assert!(!statement.ends_with(['&', ' ']), "{place}: ends with an ampersand or a blank");
        }
    }
}

/// Each shim has a copy of its solver's `refuse`, since a solver takes one file: the copies must not drift apart.
#[test]
fn copies_of_refuse_are_the_same() {
    let mut copies = std::collections::BTreeMap::<_, std::collections::BTreeSet<String>>::new();
    for path in shims() {
        let text = std::fs::read_to_string(&path).expect("a shim");
        let start = text.find("      subroutine refuse\n").unwrap_or_else(|| panic!("{}: no refuse", path.display()));
        let length = text[start..].find("      end subroutine\n").expect("an end");
        // What Abaqus/Standard and Explicit differ in: the names of the output files, the routine that ends the job.
        let lines = text[start..start + length].lines().filter(|line| !line.starts_with('!'));
        let copy = lines.collect::<Vec<_>>().join("\n").replace("xplb_exit", "xit");
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let solver = name.split_once('_').expect("solver_routine").0.to_string();
        copies.entry(solver).or_default().insert(copy);
    }
    assert_eq!(copies.len(), 3, "{:?}", copies.keys());
    for (solver, copies) in copies {
        assert_eq!(copies.len(), 1, "{solver}: {copies:#?}");
    }
}

#[test]
fn shims_compile_at_both_line_lengths_with_all_kinds() {
    for length in LINE_LENGTHS {
        for kinds in [&[][..], &[INTEGERS_64], &[INTEGERS_64, REALS_64]] {
            let mut gfortran = Command::new("gfortran");
            gfortran.args(["-std=f2008", "-fsyntax-only"]).arg(format!("-ffixed-line-length-{length}"));
            let shims = shims().into_iter().filter(|shim| !needs_modules(shim));
            run(gfortran.args(SHIM_WARNINGS).args(kinds).args(shims), "gfortran");
        }
        for kinds in ["-DDOUBLE", "-DSINGLE"] {
            let mut gfortran = Command::new("gfortran");
            gfortran.args(["-std=f2008", "-fsyntax-only", "-J"]).arg(folder("fortran-openradioss"));
            gfortran.arg(format!("-ffixed-line-length-{length}")).arg(kinds).arg(MODULES_OF_OPENRADIOSS);
            run(gfortran.args(SHIM_WARNINGS).args(shims().into_iter().filter(|shim| needs_modules(shim))), "gfortran");
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
    // Said by whoever has none: a test that is green has run.
    if std::env::var_os("TORON_WITHOUT_FLANG").is_some() {
        return;
    }
    let flang = flang().expect("flang; on Debian or Ubuntu: apt-get install flang-16; or TORON_WITHOUT_FLANG=1");
    let folder = folder("fortran-flang");
    for length in LINE_LENGTHS {
        for kinds in [&[][..], &[INTEGERS_64], &[INTEGERS_64, REALS_64]] {
            for shim in shims().into_iter().filter(|shim| !needs_modules(shim)) {
                let mut command = Command::new(&flang);
                command.args(["-c", "-pedantic"]).arg(format!("-ffixed-line-length={length}")).args(kinds);
                let output = run(command.arg(&shim).arg("-o").arg(folder.join("shim.o")), "flang-16");
                let warnings = String::from_utf8_lossy(&output.stderr);
                assert!(warnings.is_empty(), "{}: {warnings}", shim.display());
            }
        }
    }
}
