//! `cargo xtask update KIND`: writes committed files anew that are made from the sources, and measured ones. The tests
//! that hold them against what is made today write them where the variable TORON_UPDATE names their kind.
//! `cargo xtask site`: the documents as a site.

mod site;

use std::path::Path;
use std::process::{Command, ExitCode};

/// Tests of a package: its name, the test program's, and how the tests' names begin.
type Tests = (&'static str, &'static str, &'static str);

/// What the files are, which ones, and the tests that write them, each after those that it reads from.
const KINDS: [(&str, &str, &[Tests]); 9] = [
    (
        "answers",
        "what every entry answers, bit for bit: c/tests/c/answers.txt, packages/materials/tests/materials/answers/",
        &[("toron-c", "c", "answers::"), ("toron-materials", "materials", "answers::")],
    ),
    (
        "counts",
        "instructions a point: c/tests/c/instruction_counts.txt; of one compiler",
        &[("toron-c", "c", "instruction_counts::")],
    ),
    ("decks", "a scene's decks: examples/fabric_impact/patch/", &[("toron-program", "program", "scene_decks::")]),
    (
        "documents",
        "tables and printed answers in docs/, cards and expected numbers in examples/one-element/",
        &[
            ("toron-program", "program", "documents::"),
            ("toron-program", "program", "one_element::"),
            ("umat-check", "corpus", "faults"),
        ],
    ),
    (
        "headers",
        "include/toron.h, include/toron.f90, examples/own_law/reinforced.h",
        &[("toron-c", "c", "header::"), ("toron-c", "c", "fortran_module::"), ("toron-c", "c", "own_law::")],
    ),
    (
        "keys",
        "schemas of files, program/assets/schema/, and tables of keys in docs/",
        &[("toron-keys", "keys", "_are_current")],
    ),
    ("licences", "THIRD-PARTY.md", &[("toron-program", "program", "licences::")]),
    (
        "pictures",
        "docs/images/, benches/results/speed.svg and .png",
        &[
            ("toron-benches", "picture", "the_speed_report"),
            ("toron-program", "program", "documents::"),
            ("toron-program", "program", "weave::"),
            ("toron-program", "program", "yarn_between_plates::"),
        ],
    ),
    ("symbols", "what libraries export: c/tests/c/symbols/", &[("toron-c", "c", "symbols::")]),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    if words[..] == ["site"] {
        return match site::make() {
            Ok(()) => ExitCode::SUCCESS,
            Err(message) => {
                eprintln!("{message}");
                ExitCode::FAILURE
            }
        };
    }
    let tests = match words[..] {
        ["update", kind] => KINDS.iter().find(|(name, ..)| *name == kind).map(|(_, _, tests)| (kind, tests)),
        _ => None,
    };
    let Some((kind, tests)) = tests else {
        eprintln!("cargo xtask update KIND writes anew:");
        KINDS.iter().for_each(|(name, files, _)| eprintln!("  {name:<10} {files}"));
        eprintln!("cargo xtask site makes target/site of docs/, and follows its links");
        return ExitCode::from(2);
    };
    let written = tests.iter().all(|tests| update(kind, *tests));
    if written { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Whether these tests have written their files. One after the other: some write into the same file.
fn update(kind: &str, (package, test, names): Tests) -> bool {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["test", "--locked", "-p", package, "--test", test, "--", "--test-threads=1", names]);
    match cargo.env("TORON_UPDATE", kind).current_dir(root).status() {
        Ok(status) => status.success(),
        Err(error) => {
            eprintln!("{}: {error}", cargo.get_program().display());
            false
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::PathBuf;

    use super::*;

    /// The text of every source below a folder.
    fn sources(folder: &Path, texts: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path: PathBuf = entry.expect("an entry").path();
            if path.is_dir() {
                sources(&path, texts);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                texts.push(std::fs::read_to_string(path).expect("a source"));
            }
        }
    }

    #[test]
    fn every_kind_that_tests_ask_for_is_listed() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mut texts = Vec::new();
        ["benches", "c/tests", "packages", "program/tests", "tests"]
            .iter()
            .for_each(|folder| sources(&root.join(folder), &mut texts));
        let mut asked = BTreeSet::new();
        for text in &texts {
            let kinds = text.split("is_asked(\"").skip(1).filter_map(|rest| Some(rest.split_once("\")")?.0));
            asked.extend(kinds.filter(|kind| kind.chars().all(char::is_alphabetic)));
        }
        assert_eq!(asked, KINDS.iter().map(|(name, ..)| *name).collect());
    }
}
