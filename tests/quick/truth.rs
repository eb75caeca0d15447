//! The law against points computed in 140-digit and 70-digit arithmetic, in double and in single precision.
//!
//! The measures and their units stand in `common/truth.rs`; `--nocapture` prints the worst of each category.

use nalgebra::Matrix3;

use toron::law::state::{HYPERELASTIC_STATE, INVARIANTS};
use toron::law::status;
use toron::{Hyperelastic, Request};
use toron_test_support::exact::{exact, rounded};
use toron_test_support::truth::{Answer, DOUBLE, FAR_DOUBLE, FAR_SINGLE, SINGLE, Score, cases, far_cases};

#[test]
fn double_precision() {
    let mut score = Score::new(f64::EPSILON / 2.0, 0.0);
    for case in cases() {
        let law = Hyperelastic::<f64>::new(&case.properties()).expect("valid properties");
        let point = law.point(&case.deformation_gradient(), &[0.0; HYPERELASTIC_STATE], Request::ALL);
        assert_eq!(point.status, status::OK, "case {}", case.id);
        score.add(&case, &Answer::from(&point));
    }
    println!("double precision\n{score}");
    assert_eq!(score.worst.values().map(|worst| worst.cases).sum::<usize>(), 320);
    score.assert_within(&DOUBLE, "the law");
    // Near the reference nothing may cancel: the relative error is bounded, however small the strain.
    for category in ["small", "degenerate"] {
        let forward = score.worst[category].forward;
        assert!(forward <= 2e-15, "{category}: relative error {forward}");
    }
    // The pulled-back modes lose what F⁻¹ magnifies; they are held where it is moderate.
    for category in ["small", "degenerate", "moderate", "failure", "units", "fibre_direction"] {
        let modes = score.worst[category].modes;
        assert!(modes <= 1e-12, "{category}: modes {modes}");
    }
}

/// Where sums over F cancel, no more digits are lost than F's own rounding costs.
#[test]
fn far_from_the_reference() {
    let mut score = Score::new(f64::EPSILON / 2.0, 0.0);
    for case in far_cases() {
        let law = Hyperelastic::<f64>::new(&case.properties()).expect("valid properties");
        let point = law.point(&case.deformation_gradient(), &[0.0; HYPERELASTIC_STATE], Request::ALL);
        assert_eq!(point.status, status::OK, "case {}", case.id);
        score.add(&case, &Answer::from(&point));
    }
    println!("double precision, far from the reference\n{score}");
    assert_eq!(score.worst.values().map(|worst| worst.cases).sum::<usize>(), 176);
    score.assert_within(&FAR_DOUBLE, "the law");
}

#[test]
fn single_precision() {
    let far = far_cases().into_iter().filter(|case| case.fits_single_precision());
    for (cases, bounds) in [(cases(), SINGLE), (far.collect(), FAR_SINGLE)] {
        let mut score = Score::new(6e-8, 1e-6);
        for case in cases {
            let law = Hyperelastic::<f32>::new(&case.properties().map(|x| x as f32)).expect("valid properties");
            let f = case.deformation_gradient().map(|x| x as f32);
            let point = law.point(&f, &[0.0; HYPERELASTIC_STATE], Request::ALL);
            assert_eq!(point.status, status::OK, "case {}", case.id);
            score.add(&case, &Answer::from(&point));
        }
        println!("single precision\n{score}");
        score.assert_within(&bounds, "the law");
    }
}

/// A fibre pressed to almost nothing in a section at rest, F = 1 − (1 − λ) m⊗m, along a diagonal of the axes: λ² is
/// lost in 1 + (λ² − 1), and J/λ has the rounding of both. Exact values come from F's own entries, which are all known:
/// with d on the diagonal and −o beside it F m = (d − 2o) m.
#[test]
fn a_fibre_pressed_flat_along_a_diagonal() {
    for power in 1..=26 {
        let lambda = 0.5_f64.powi(power);
        let (diagonal, beside) = (1.0 - (1.0 - lambda) / 3.0, (1.0 - lambda) / 3.0);
        let f = Matrix3::from_fn(|i, j| if i == j { diagonal } else { -beside });
        let stretch = rounded(&(exact(diagonal) - exact(beside) - exact(beside)));
        let properties = [82.341e9, 1.055e9, 2.2, 0.64974e9, 0.0, 0.0458, 1.8, 0.0, 1.0, 1.0, 1.0];
        let law = Hyperelastic::<f64>::new(&properties).expect("valid properties");
        let point = law.point(&f, &[0.0; HYPERELASTIC_STATE], Request::ALL);
        assert_eq!(point.status, status::OK, "λ = {lambda:e}");
        let [i_el, i_tc, i_td, ..] = point.state[INVARIANTS..] else { unreachable!() };
        // What rounding each entry of F does to ln λ: (3 d + 6 o)/(3 λ).
        let sensitivity = (diagonal + 2.0 * beside) / stretch;
        let rounding = f64::EPSILON / 2.0;
        let error = (i_el - stretch.ln()).abs() / (rounding * (stretch.ln().abs() + sensitivity));
        // 1.32 is found.
        assert!(error <= 1.6, "λ = {lambda:e}: I_el is wrong by {error} roundings");
        // The section keeps its area and its shape to three roundings.
        assert!(i_tc.abs().max(i_td.abs()) <= 3.6 * rounding, "λ = {lambda:e}: I_tc {i_tc:e}, I_td {i_td:e}");
    }
}
