//! THIRD-PARTY.md lists what is linked into the libraries and the program today, with the licences; `cargo xtask update
//! licences` writes it anew. Every package, and the installed library, has the licence texts.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use toron_test_support::library::{INSTALLED, ROOT, run};
use toron_test_support::update::is_asked;

const LIBRARIES: [&str; 8] = [
    "toron-abaqus",
    "toron-abaqus-sp",
    "toron-c",
    "toron-c-functions",
    "toron-calculix",
    "toron-mgis",
    "toron-openradioss",
    "toron-openradioss-sp",
];
/// What the program is made of besides.
const PACKAGES: [&str; 8] = [
    "toron-build-number",
    "toron-explicit-host",
    "toron-materials",
    "toron-parameters",
    "toron-pictures",
    "toron-shared",
    "toron-strikes",
    "umat-check",
];
const TARGET: &str = "x86_64-unknown-linux-gnu";
const PROGRAM: [&str; 1] = ["toron-program"];
/// Licences with an Apache-2.0 among them need no text of their own: it is this repository's.
const COMMON: &str = "Apache-2.0";
/// But for what stands behind an AND.
const BOTH: &str = " AND ";
const BESIDE: [&str; 1] = ["LICENSE-WHATWG"];
const TEXTS: [&str; 5] = ["LICENSE-MIT", "LICENSE", "LICENSE.md", "LICENSE.txt", "UNLICENSE"];

fn cargo(arguments: &[&str]) -> String {
    let mut cargo = Command::new(env!("CARGO"));
    let output = run(cargo.current_dir(ROOT).args(arguments).args(["--offline", "--locked"]), "cargo");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The crates that are linked into the packages, each with its version and licence; not this repository's own.
fn linked(packages: &[&str]) -> BTreeSet<(String, String, String)> {
    let target = ["--target", TARGET, "--edges", "normal,no-proc-macro"];
    let mut arguments = vec!["tree", "--prefix", "none", "--format", "{p}|{l}"];
    arguments.extend(target.iter().chain(packages.iter().flat_map(|package| [&"-p", package])));
    let tree = cargo(&arguments);
    let crates = tree.lines().filter_map(|line| {
        let (package, licence) = line.trim_end_matches(" (*)").split_once('|')?;
        let [name, version] = package.split(' ').take(2).collect::<Vec<_>>()[..] else { return None };
        let own = name == "toron" || name.starts_with("toron-") || name == "umat-check";
        (!own).then(|| (name.to_string(), version.trim_start_matches('v').to_string(), licence.replace('/', " OR ")))
    });
    crates.collect()
}

/// Where the source of each crate is, by name and version.
fn sources() -> BTreeMap<(String, String), PathBuf> {
    let metadata: Value =
        serde_json::from_str(&cargo(&["metadata", "--format-version", "1", "--filter-platform", TARGET]))
            .expect("JSON");
    let text = |package: &Value, key: &str| package[key].as_str().expect("a string").to_string();
    let packages = metadata["packages"].as_array().expect("packages").iter();
    packages
        .map(|package| {
            let manifest = PathBuf::from(text(package, "manifest_path"));
            ((text(package, "name"), text(package, "version")), manifest.parent().expect("a folder").to_path_buf())
        })
        .collect()
}

/// A text file as lines without trailing blanks.
fn lines(file: &Path) -> String {
    let text = std::fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    text.lines().map(|line| line.trim_end().to_string() + "\n").collect::<String>().trim_matches('\n').to_string()
}

fn generated() -> String {
    let (libraries, program) = (linked(&LIBRARIES), linked(&PROGRAM));
    let sources = sources();
    let mut table = BTreeMap::<(String, String), [bool; 2]>::new();
    let mut texts = BTreeMap::<String, BTreeSet<String>>::new();
    for (name, version, licence) in libraries.union(&program) {
        let found = (name.clone(), version.clone(), licence.clone());
        let places = table.entry((name.clone(), licence.clone())).or_default();
        *places = [places[0] || libraries.contains(&found), places[1] || program.contains(&found)];
        let is_common = licence.contains(COMMON);
        if !is_common || licence.contains(BOTH) {
            let folder = &sources[&(name.clone(), version.clone())];
            let files: &[&str] = if is_common { &BESIDE } else { &TEXTS };
            let file = files.iter().map(|file| folder.join(file)).find(|file| file.exists());
            let file = file.unwrap_or_else(|| panic!("{name} {version}: no licence text"));
            texts.entry(lines(&file)).or_default().insert(name.clone());
        }
    }
    let mut text = String::from(
        "# What others have written\n\n\
         These crates are linked into toron's libraries (all of them together) or into the program `toron`, besides Rust's\n\
         standard library (MIT OR Apache-2.0). Where a licence offers Apache-2.0, it is used under that one, whose text is in\n\
         [LICENSE-APACHE](LICENSE-APACHE); the other texts, and that of the program's font, follow.\n\n\
         | crate | licence | libraries | program |\n|---|---|---|---|\n",
    );
    let mark = |there: bool| if there { "yes" } else { "" };
    for ((name, licence), [in_libraries, in_program]) in &table {
        text += &format!("| {name} | {licence} | {} | {} |\n", mark(*in_libraries), mark(*in_program));
    }
    let mut sections: Vec<_> =
        texts.into_iter().map(|(text, names)| (names.into_iter().collect::<Vec<_>>().join(", "), text)).collect();
    sections.sort();
    sections.push((
        "DejaVu Sans, the program's font".to_string(),
        lines(&Path::new(ROOT).join("packages/pictures/assets/DejaVuSans-LICENSE.txt")),
    ));
    for (names, licence) in sections {
        text += &format!("\n## {names}\n\n```text\n{licence}\n```\n");
    }
    text
}

#[test]
fn the_list_of_what_is_linked_is_current() {
    let (path, generated) = (Path::new(ROOT).join("THIRD-PARTY.md"), generated());
    if is_asked("licences") {
        std::fs::write(&path, &generated).expect("THIRD-PARTY.md is writable");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    let hint = "THIRD-PARTY.md is not current: cargo xtask update licences";
    assert!(committed == generated, "{hint}");
}

#[test]
fn every_package_has_the_licences() {
    for package in ["toron"].iter().chain(&LIBRARIES).chain(&PROGRAM).chain(&PACKAGES) {
        let files = cargo(&["package", "--list", "--allow-dirty", "-p", package]);
        for file in ["LICENSE-MIT", "LICENSE-APACHE"] {
            assert!(files.lines().any(|line| line == file), "{package}: {file}");
        }
    }
    let installed = INSTALLED.join("share/doc/toron");
    for file in ["LICENSE-MIT", "LICENSE-APACHE", "THIRD-PARTY.md"] {
        assert_eq!(lines(&installed.join(file)), lines(&Path::new(ROOT).join(file)), "{file}");
    }
}
