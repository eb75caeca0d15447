//! The fuzzer of the readers.

use std::path::Path;

use toron_fuzz::readers::{TARGETS, Totals, files, one, run};
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

#[test]
fn changed_files() {
    let seed = seed();
    let totals = run(seed, setting("TORON_FUZZ_FILES", 3_000)).unwrap_or_else(|why| panic!("seed {seed}: {why}"));
    println!("seed {seed}: {totals:?}");
    assert!(totals.refused * 2 > totals.files, "most changes are to be noticed");
}
