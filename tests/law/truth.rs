//! The law against 256 points computed in 140-digit arithmetic, in double and in single precision.
//!
//! The measures and their units stand in `common/truth.rs`; `--nocapture` prints the worst of each category.

use crate::common::truth::{Answer, Score, cases};
use toron::law::state::HYPERELASTIC_STATE;
use toron::law::status;
use toron::{Hyperelastic, Request};

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
    assert_eq!(score.worst.values().map(|worst| worst.cases).sum::<usize>(), 256);
    for (category, worst) in &score.worst {
        assert!(worst.back <= 5.0, "{category}: stress {}", worst.back);
        assert!(worst.invariants <= 5.0, "{category}: invariants {}", worst.invariants);
        assert!(worst.energies <= 5.0, "{category}: energies {}", worst.energies);
        assert_eq!(worst.wrong, 0, "{category}: failure flags");
    }
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

#[test]
fn single_precision() {
    let mut score = Score::new(6e-8, 1e-6);
    for case in cases() {
        let law = Hyperelastic::<f32>::new(&case.properties().map(|x| x as f32)).expect("valid properties");
        let f = case.deformation_gradient().map(|x| x as f32);
        let point = law.point(&f, &[0.0; HYPERELASTIC_STATE], Request::ALL);
        assert_eq!(point.status, status::OK, "case {}", case.id);
        score.add(&case, &Answer::from(&point));
    }
    println!("single precision\n{score}");
    for (category, worst) in &score.worst {
        assert!(worst.back <= 8.0, "{category}: stress {}", worst.back);
        assert!(worst.invariants <= 8.0, "{category}: invariants {}", worst.invariants);
        assert!(worst.energies <= 8.0, "{category}: energies {}", worst.energies);
        assert_eq!(worst.wrong, 0, "{category}: failure flags");
    }
}
