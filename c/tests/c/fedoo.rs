//! The yarn law inside fedoo, a finite-element package in Python: a block of yarn under a rigid cylinder, with contact,
//! `ffi-tests/fedoo/press.py`.

use crate::newton::{assert_quadratic, numbers};
use toron_test_support::python;

#[test]
fn residuals_fall_quadratically_under_a_rigid_cylinder() {
    let text = python::program("fedoo/press.py", &[]);
    print!("{text}");
    let increments: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("residuals")).collect();
    assert_eq!(increments.len(), 20);
    increments.into_iter().for_each(|line| assert_quadratic(&numbers(line)));
    let forces = text.lines().find_map(|line| line.strip_prefix("forces")).map(numbers).expect("forces");
    assert!(
        forces[1] > 100.0 && (forces[0] + forces[1]).abs() < 1e-9 * forces[1],
        "the cylinder presses on the ground"
    );
}
