//! What each library that solvers and programs load gives to the outside, symbol by symbol, as `symbols/` lists it: a
//! symbol that goes or comes changes what loads. `cargo xtask update symbols` writes the lists anew.
//!
//! Each shared library is bound when it is loaded: it needs nothing but versioned symbols of the C library and of the
//! compiler's.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use toron_test_support::library::{LIBRARY, OWN_LAW, ROOT, run};
use toron_test_support::update::is_asked;

/// The shared libraries: of the installation, of solvers, of a law of one's own. The static ones beside some of them
/// have the same symbols.
fn libraries() -> [(PathBuf, bool); 9] {
    let ours = [
        "toron_abaqus",
        "toron_abaqus_sp",
        "toron_calculix",
        "toron_mgis",
        "toron_openradioss",
        "toron_openradioss_sp",
    ];
    let [a, b, c, d, e, f] = ours.map(|name| (LIBRARY.join(format!("lib{name}.so")), false));
    let own = |name: &str| (OWN_LAW.join(name), true);
    [(LIBRARY.join("libtoron.so"), true), a, b, c, d, e, f, own("libown_law_double.so"), own("libown_law_single.so")]
}

/// Names of a library's symbols, each with `nm`'s letter for its kind.
fn listed(library: &Path, options: &[&str]) -> BTreeSet<(String, char)> {
    let output = run(Command::new("nm").args(options).arg(library), "binutils");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let symbol = |line: &str| {
        let mut words = line.split_whitespace().rev();
        let (name, kind) = (words.next()?, words.next()?);
        Some((name.to_owned(), kind.chars().next().filter(|_| kind.len() == 1)?))
    };
    text.lines().filter_map(symbol).collect()
}

/// The names of what a library defines.
pub fn defined(library: &Path, options: &[&str]) -> BTreeSet<String> {
    listed(library, &[options, &["--defined-only"]].concat()).into_iter().map(|(name, _)| name).collect()
}

/// The functions that a shared library gives to the outside.
pub fn functions(library: &Path) -> BTreeSet<String> {
    let symbols = listed(library, &["-D", "--defined-only"]);
    symbols.into_iter().filter(|&(_, kind)| kind == 'T').map(|(name, _)| name).collect()
}

/// A line for each symbol: function or data, and its name.
fn list(library: &Path) -> String {
    let mut text = String::new();
    for (name, kind) in listed(library, &["-D", "--defined-only"]) {
        let kind = if kind == 'T' { "function" } else { "data" };
        writeln!(text, "{kind:<8} {name}").expect("a string");
    }
    text
}

#[test]
fn symbols_are_those_of_the_lists() {
    let mut wrong = Vec::new();
    for (library, _) in libraries() {
        let name = library.file_stem().expect("a file").to_string_lossy().into_owned();
        let committed = Path::new(ROOT).join(format!("c/tests/c/symbols/{name}.txt"));
        let found = list(&library);
        if is_asked("symbols") {
            std::fs::write(&committed, &found).expect("the list is writable");
        }
        let wanted = std::fs::read_to_string(&committed).unwrap_or_else(|error| panic!("{name}.txt: {error}"));
        let [found, wanted] = [&found, &wanted].map(|text| text.lines().collect::<BTreeSet<_>>());
        assert!(!wanted.is_empty(), "{name}.txt is empty");
        wrong.extend(found.difference(&wanted).map(|line| format!("{name} has {line}, which its list lacks")));
        wrong.extend(wanted.difference(&found).map(|line| format!("{name} lacks {line}, which its list has")));
    }
    let write = "where that is meant: cargo xtask update symbols";
    assert!(wrong.is_empty(), "{}\n{write}", wrong.join("\n"));
}

/// What a program can be linked with it can be linked with statically.
#[test]
fn static_libraries_have_the_symbols_of_the_shared_ones() {
    for (library, has_static) in libraries() {
        if has_static {
            let missing = &defined(&library, &["-D"]) - &defined(&library.with_extension("a"), &["--extern-only"]);
            assert!(missing.is_empty(), "{}: {missing:?}", library.with_extension("a").display());
        }
    }
}

/// A symbol that a library wants of its solver would keep it from being loaded anywhere else, even to be asked for its
/// names.
#[test]
fn libraries_need_the_system_alone() {
    for (library, _) in libraries() {
        let wanted = listed(&library, &["-D", "--undefined-only"]);
        assert!(wanted.len() > 3, "{}: {wanted:?}", library.display());
        let of_the_system = |name: &str| name.contains("@GLIBC_") || name.contains("@GCC_");
        let others: Vec<_> = wanted.iter().filter(|(name, kind)| *kind != 'w' && !of_the_system(name)).collect();
        assert!(others.is_empty(), "{}: {others:?}", library.display());
    }
}
