//! The fuzzer of the readers.

use std::path::Path;
use std::process::Command;

use toron_fuzz::readers::{TARGETS, Target, Totals, current, files, one, run};
use toron_fuzz::{seed, setting};

/// Every reader takes some of its files as they are, so that changes of them come far.
#[test]
fn every_reader_has_files_of_its_own() {
    for target in TARGETS {
        let mut totals = Totals::default();
        let files = files(target);
        for file in &files {
            one(target, file, &mut totals).unwrap_or_else(|why| panic!("{}: {why}", file.display()));
        }
        // The histories that a blow is fitted to are made by a run of toron fibres.
        let takes_some = totals.refused < totals.files || target.name == "blow of toron fit";
        assert!(takes_some, "{}: all of {} files are refused", target.name, files.len());
    }
}

/// What was once found: `corpus/found/N-READER'S NUMBER.end`, and whatever else lies there, for every reader.
#[test]
fn corpus() {
    let found = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus/found");
    for file in std::fs::read_dir(found).into_iter().flatten().flatten() {
        for target in TARGETS {
            let read = one(target, &file.path(), &mut Totals::default());
            read.unwrap_or_else(|why| panic!("{} of {}: {why}", file.path().display(), target.name));
        }
    }
}

/// What this test does in a process of its own, whose memory the system bounds: with a name, the reader that asks for
/// too much.
const PLANTED: &str = "TORON_FUZZ_PLANTED_READER";

/// A reader that asks for as much memory as a file says.
const GREEDY: Target = Target {
    name: "greedy reader",
    places: &["examples/shots"],
    end: ".csv",
    read: |_| {
        std::hint::black_box(Vec::<u8>::with_capacity(1_000_000_000_000));
        Ok(())
    },
};

#[test]
#[ignore = "run by changed_files, in a process of its own"]
fn bounded() {
    let (seed, planted) = (seed(), std::env::var(PLANTED).is_ok());
    let targets = if planted { &[GREEDY] } else { TARGETS };
    let totals =
        run(targets, seed, setting("TORON_FUZZ_FILES", 3_000)).unwrap_or_else(|why| panic!("seed {seed}: {why}"));
    println!("seed {seed}: {totals:?}");
    assert!(totals.refused * 2 > totals.files, "most changes are to be noticed");
}

/// The test above; what it prints, and whether it ends well.
fn in_a_process(planted: bool) -> (String, bool) {
    let mut test = Command::new(std::env::current_exe().expect("a test has a file"));
    test.args(["--exact", "bounded", "--ignored", "--nocapture"]);
    if planted {
        test.env(PLANTED, "1");
    }
    let output = test.output().expect("the test runs");
    let [stdout, stderr] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    let current = std::fs::read_to_string(current()).unwrap_or_default();
    (format!("{stdout}{stderr}{}, the last file: {current}", output.status), output.status.success())
}

#[test]
fn changed_files() {
    if cfg!(target_os = "linux") {
        let (text, ends_well) = in_a_process(true);
        let is_named =
            text.contains("memory allocation of 1000000000000 bytes failed") && text.contains("greedy reader");
        assert!(!ends_well && is_named, "a reader that asks for too much is not found: {text}");
    }
    let (text, ends_well) = in_a_process(false);
    assert!(ends_well, "{text}");
    println!("{text}");
}
