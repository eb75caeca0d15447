//! What every exported entry gives back, bit for bit: `ffi-tests/c/environment.c` calls each on points of every kind,
//! at every level, from every old state, with and without each output, with what is refused, and prints one number for
//! all that it returned. `answers.txt` holds these numbers; `cargo xtask update answers` writes them
//! anew. `toron eval` has such a file of the truth's cases, with samples that can be read:
//! `packages/materials/tests/materials/answers.rs`.
//!
//! To find the calls that differ, build the program with either library and compare what `--sums --trace ENTRY` prints.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::collections::BTreeMap;
use std::path::Path;

use crate::environment::{PROGRAMS, exported, run_with};
use toron_test_support::library::{LIBRARY, ROOT, run};
use toron_test_support::update::is_asked;

/// By entry and level: how many calls, and the sum.
fn sums(text: &str) -> BTreeMap<(String, String), (u32, String)> {
    let line = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [entry, level, calls, sum] = words[..] else { panic!("not entry, level, calls, sum: {line}") };
        ((entry.to_owned(), level.to_owned()), (calls.parse().expect("a number"), sum.to_owned()))
    };
    text.lines().map(line).collect()
}

#[test]
fn every_entry_answers_as_recorded() {
    let outputs = PROGRAMS.each_ref().map(|program| run(run_with(program, &LIBRARY).arg("--sums"), "").stdout);
    let mut found = String::from_utf8(outputs.concat()).expect("UTF-8");
    // The same in both precisions: what a text or a table answers.
    found =
        found.lines().collect::<std::collections::BTreeSet<_>>().into_iter().map(|line| format!("{line}\n")).collect();
    let path = Path::new(ROOT).join("c/tests/c/answers.txt");
    if is_asked("answers") {
        std::fs::write(&path, &found).expect("answers.txt is writable");
    }
    let recorded = sums(&std::fs::read_to_string(&path).expect("answers.txt"));
    let found = sums(&found);
    let names = |sums: &BTreeMap<(String, String), _>| sums.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&found), names(&recorded), "entries of answers.txt");
    assert!(exported().iter().all(|entry| found.keys().any(|(name, _)| name == entry)));
    // AVX2 and AVX-512 give the same bits; the best that there is below is the baseline.
    let has_best = std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma");
    let compared = recorded.iter().filter(|((_, level), _)| has_best || level == "baseline");
    let wrong: Vec<String> = compared
        .filter(|(key, recorded)| found[*key] != **recorded)
        .map(|((entry, level), recorded)| {
            let found = &found[&(entry.clone(), level.clone())];
            format!(
                "{entry}, {level}: {} calls, sum {}; recorded {} calls, {}",
                found.0, found.1, recorded.0, recorded.1
            )
        })
        .collect();
    let write = "where that is meant: cargo xtask update answers";
    assert!(wrong.is_empty(), "{}\n{write}", wrong.join("\n"));
}
