//! The yarn law inside felupe, a finite-element package in Python: a clamped yarn segment under a rigid plate,
//! `ffi-tests/felupe/yarn.py`.

use crate::newton::{assert_quadratic, numbers};
use toron_test_support::python;

#[test]
fn residuals_fall_quadratically_under_a_rigid_plate() {
    let text = python::program("felupe/yarn.py", &[]);
    print!("{text}");
    // The depth, then residuals.
    text.lines().for_each(|line| assert_quadratic(&numbers(line)[1..]));
    assert_eq!(text.lines().count(), 6);
}
