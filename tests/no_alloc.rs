//! Laws do not allocate: not when they are prepared, not at a point, not when they say what is wrong; the law with
//! friction is in `c/tests/no_alloc.rs`. A binary of its own, since it counts in the allocator.

use allocation_counter::measure;
use nalgebra::{Matrix3, Vector3};
use toron::law::linear_elastic::{Criterion, LinearElastic, Rotation};
use toron::law::parameters::PRESETS;
use toron::law::state::{HYPERELASTIC_STATE, LINEAR_ELASTIC_STATE};
use toron::law::status;
use toron::{Hyperelastic, Request};

/// Runs `work`, which must leave the allocator alone, and returns what it made.
fn without_allocation<T>(work: impl FnOnce() -> T) -> T {
    let mut result = None;
    let allocations = measure(|| result = Some(work()));
    assert_eq!(allocations.count_total, 0);
    result.expect("the work was done")
}

/// Good, failing, inverted and meaningless gradients.
fn gradients() -> [Matrix3<f64>; 5] {
    let diagonal = |a, b, c| Matrix3::from_diagonal(&Vector3::new(a, b, c));
    let sheared = Matrix3::new(1.01, 0.1, 0.0, 0.2, 0.8, 0.1, 0.0, -0.1, 0.9);
    [
        sheared,
        diagonal(1.1, 0.9, 0.9),
        diagonal(-1.0, 1.0, 1.0),
        diagonal(f64::NAN, 1.0, 1.0),
        diagonal(1e300, 1e300, 1.0),
    ]
}

#[test]
fn the_counter_counts() {
    assert_eq!(measure(|| drop(std::hint::black_box(vec![0u8; 8]))).count_total, 1);
}

#[test]
fn hyperelastic() {
    without_allocation(|| {
        let law = Hyperelastic::<f64>::new(PRESETS[0].values).expect("valid properties");
        let mut state = [0.0; HYPERELASTIC_STATE];
        for f in gradients() {
            state = law.point(&f, &state, Request::ALL).state;
        }
        assert_eq!(state[toron::law::state::FAILED], 1.0, "the second gradient fails the point");
        state[0] = f64::NAN;
        assert_eq!(law.point(&gradients()[0], &state, Request::ALL).status, status::STATE_NOT_FINITE);
    });
}

#[test]
fn linear_elastic() {
    without_allocation(|| {
        let law = LinearElastic::new(PRESETS[1].values).expect("valid properties");
        for rotation in [Rotation::Fibre, Rotation::Polar, Rotation::Spin] {
            let mut state = [0.0; LINEAR_ELASTIC_STATE];
            let mut axes = law.reference_axes();
            for f in gradients() {
                let identity = Matrix3::identity();
                state = law.step(&identity, &f, &state, rotation, Criterion::LargestPrincipal, &mut axes).state;
            }
            assert_eq!(state[toron::law::state::LINEAR_FAILED], 1.0);
            law.increment(&[0.1; 6], 1.0, &state, Criterion::FibreStress);
        }
    });
}

/// Every kind of refusal, described into a buffer of fixed size.
#[test]
fn messages() {
    let mut written = 0;
    let describe = |error: toron::Error, written: &mut usize| error.describe(&mut |piece| *written += piece.len());
    without_allocation(|| {
        let mut properties = [0.0; 11];
        properties.copy_from_slice(PRESETS[0].values);
        describe(Hyperelastic::<f64>::new(&properties[..3]).expect_err("a wrong count"), &mut written);
        for (index, value) in [(0, -1.0e300 / 3.0), (2, 1.0), (8, f64::NAN), (8, f64::NEG_INFINITY), (8, 0.0)] {
            let mut wrong = properties;
            wrong[index] = value;
            describe(Hyperelastic::<f64>::new(&wrong).expect_err("a wrong property"), &mut written);
        }
        let argument = toron::Error::Argument {
            name: "density",
            value: toron::Value::Double(1.0 / 3.0),
            wanted: "a finite number > 0",
        };
        describe(argument, &mut written);
        for (code, ..) in status::TABLE {
            describe(toron::Error::Plain(code), &mut written);
        }
        describe(toron::Error::Plain(1), &mut written);
    });
    assert!(written > 1000, "{written} bytes");
}
