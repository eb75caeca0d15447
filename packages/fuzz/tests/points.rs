//! The fuzzer of the numerical entries.

use toron_fuzz::points::{Case, FAULTS, ONE_IN, replay, run, smallest};
use toron_fuzz::{seed, setting};

/// What was once found, and the case of `TORON_FUZZ_CASE`.
#[test]
fn corpus() {
    let own = std::env::var("TORON_FUZZ_CASE").unwrap_or_default();
    let mut planted = None;
    for line in include_str!("../corpus/points.txt").lines().chain([own.as_str()]) {
        if let Some(name) = line.strip_prefix("# planted: ") {
            planted = Some(FAULTS.into_iter().find(|fault| format!("{fault:?}") == name).expect("a fault"));
            continue;
        }
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let case = Case::of_line(line).expect("a case");
        assert_eq!(Case::of_line(&case.to_string()).expect("a case").to_string(), case.to_string());
        replay(&case, None).unwrap_or_else(|why| panic!("{why}\n{case}"));
        if let Some(fault) = planted.take() {
            assert!(replay(&case, Some(fault)).is_err(), "{fault:?} is not noticed in {case}");
        }
    }
}

#[test]
fn points() {
    let (seed, count) = (seed(), setting("TORON_FUZZ_POINTS", 1_000_000));
    let (totals, found) = run(seed, count, None);
    println!("seed {seed}: {totals:?}");
    // Nothing that is to be checked has dropped out.
    if count >= 100_000 && found.is_none() {
        assert!(totals.literal > count / (1500 * *ONE_IN) && totals.differences > count / 10_000, "{totals:?}");
        assert!(totals.refused < count / 2 && totals.hosts.iter().all(|points| *points > count / 1000), "{totals:?}");
        assert!(totals.tangents > count / 1000, "{totals:?}");
    }
    if let Some(found) = found {
        println!("{}\n{}", found.why, found.case);
        let found = smallest(found, None);
        panic!("{}\nseed {seed}; replay with TORON_FUZZ_CASE='{}'", found.why, found.case);
    }
}
