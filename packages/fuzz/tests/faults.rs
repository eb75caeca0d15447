//! What the fuzzer would find: sixteen faults planted in the answers that it sees.

use toron_fuzz::points::{FAULTS, Fault, replay, run, smallest};
use toron_fuzz::seed;

/// Points within which a fault has to be found: a tenth of a default run.
const POINTS: u64 = 100_000;

#[test]
fn planted_faults_are_found() {
    for fault in FAULTS {
        let (totals, Some(case)) = run(seed(), POINTS, Some(fault)) else {
            panic!("{fault:?} is not found in {POINTS} points");
        };
        assert_eq!(replay(&case.case, None), Ok(()), "{fault:?}: the case fails without the fault as well");
        println!("{fault:?}: found after {} points: {}", totals.points, case.why);
        // One is made small, which takes longer than to find it.
        if fault == Fault::LossesFall {
            let small = smallest(case, Some(fault));
            println!("{}", small.case);
            assert_eq!(small.case.points.len(), 1, "a case of more points is not small");
        }
    }
}
