//! The yarn law inside felupe, a finite-element package in Python that calls the shared library through ctypes: a clamped
//! yarn segment under a rigid plate, `ffi-tests/felupe/yarn.py`.

use std::path::Path;
use std::process::Command;

use crate::library::{LIBRARY, ROOT, run};

/// What rounding leaves of a residual.
const ROUNDING: f64 = 1e-12;

/// r' ≤ C r² for residuals over the reaction forces. A tangent that is off by 1 % leaves r' = 0.01 r, a thousand times more
/// at the smallest residual before the last.
const CONSTANT: f64 = 50.0;

#[test]
fn residuals_fall_quadratically_under_a_rigid_plate() {
    let folder = Path::new(ROOT).join("ffi-tests/felupe");
    let python = run(Command::new("sh").arg(folder.join("environment.sh")), "dash").stdout;
    let python = String::from_utf8(python).expect("a path");
    let mut program = Command::new(python.trim());
    let output = run(program.arg(folder.join("yarn.py")).arg(LIBRARY.join("libtoron.so")), "python3");
    let text = String::from_utf8(output.stdout).expect("numbers");
    print!("{text}");
    let mut increments = 0;
    for line in text.lines() {
        let residuals: Vec<f64> = line.split(' ').skip(1).map(|norm| norm.parse().expect("a norm")).collect();
        let [a, b, c] = residuals.last_chunk().expect("three iterations at least");
        for (before, after) in [(a, b), (b, c)] {
            assert!(*after <= (CONSTANT * before * before).max(ROUNDING), "{before:e} is followed by {after:e}");
        }
        assert!(*b > ROUNDING, "the last step but one says something: {line}");
        increments += 1;
    }
    assert_eq!(increments, 6);
}
