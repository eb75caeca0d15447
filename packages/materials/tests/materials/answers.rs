//! What `toron eval` answers to the truth's cases through every entry, bit for bit: `answers/sums.txt` has a number for
//! each entry and category, `answers/samples.jsonl` some answers as they are written. `cargo xtask update
//! answers` writes both anew. What every exported entry answers to much else is recorded by `c/tests/c/answers.rs`.
//!
//! Numbers of AVX2 and AVX-512, which give the same bits; a processor with neither has nothing to compare.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::io::Cursor;
use std::path::Path;

use clap::ValueEnum;
use serde_json::Value;
use toron::Level;
use toron_materials::eval::command::{Entry, evaluate};
use toron_test_support::update::is_asked;

const TRUTH: [&str; 2] =
    [include_str!("../../../../tests/truth/points.jsonl"), include_str!("../../../../tests/truth/far.jsonl")];
/// Of each entry these cases are samples: a moderate one, one that fails, a fibre that has slipped far.
const SAMPLES: [&str; 3] = ["moderate", "failure", "slip"];

/// FNV-1a.
fn sum(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

/// The answers of an entry, a line for each case, with DDSDDE where it has one.
fn answers(entry: Entry, cases: &str) -> Vec<String> {
    let mut output = Vec::new();
    evaluate(entry, true, Cursor::new(cases), &mut output).expect("it reads and writes memory");
    String::from_utf8(output).expect("UTF-8").lines().map(str::to_owned).collect()
}

/// The text of both files.
fn recorded_today() -> [String; 2] {
    let cases = TRUTH.concat();
    let categories: Vec<String> = cases
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).expect("JSON")["category"].as_str().expect("a text").to_owned())
        .collect();
    let (mut sums, mut samples) = (String::new(), String::new());
    for entry in Entry::value_variants() {
        let name = entry.to_possible_value().expect("a name").get_name().to_owned();
        let lines = answers(*entry, &cases);
        assert_eq!(lines.len(), categories.len(), "{name}");
        let mut texts = BTreeMap::<&str, String>::new();
        for (category, line) in categories.iter().zip(&lines) {
            let text = texts.entry(category).or_default();
            if text.is_empty() && SAMPLES.contains(&category.as_str()) {
                writeln!(samples, "{{\"via\": \"{name}\", \"category\": \"{category}\", \"answer\": {line}}}")
                    .expect("a string");
            }
            text.push_str(line);
            text.push('\n');
        }
        for (category, text) in texts {
            writeln!(sums, "{name:<24} {category:<20} {:016x}", sum(&text)).expect("a string");
        }
    }
    [sums, samples]
}

#[test]
fn every_entry_answers_as_recorded() {
    if Level::best() == Level::Baseline {
        println!("skipped: the processor has no AVX2");
        return;
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/materials/answers");
    let mut wrong = Vec::new();
    for (name, found) in ["sums.txt", "samples.jsonl"].into_iter().zip(recorded_today()) {
        let path = folder.join(name);
        if is_asked("answers") {
            std::fs::write(&path, &found).expect("the file is writable");
        }
        let recorded = std::fs::read_to_string(&path).expect(name);
        assert_eq!(found.lines().count(), recorded.lines().count(), "lines of {name}");
        let pairs = found.lines().zip(recorded.lines());
        wrong.extend(pairs.filter(|(found, recorded)| found != recorded).map(|(a, b)| format!("{a}\nrecorded:\n{b}")));
    }
    let write = "where that is meant: cargo xtask update answers";
    assert!(wrong.is_empty(), "{}\n{write}", wrong.join("\n"));
}
