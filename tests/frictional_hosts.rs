//! The law with friction in the hosts: what a solver gets along a path is what the law says, and the energy lost has its place.

use std::ptr::null_mut;

use nalgebra::Matrix3;
use toron::Frictional;
use toron::host::abaqus::{self, StandardLaw};
use toron::law::block::{Points, components, components_mut};
use toron::law::interface::Law;
use toron::law::state::{FRICTIONAL_LOST, FRICTIONAL_STATE};

const PROPERTIES: [f64; 13] = [82341.0, 1055.0, 2.2, 649.74, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.25, 0.3];

/// A path that presses the section and draws it out, at step i of 40.
fn path(i: u32) -> Matrix3<f64> {
    let t = f64::from(i) / 40.0;
    Matrix3::new(1.01, 0.02 * t, 0.0, 0.0, 1.0 + 0.1 * t, 0.05 * t, 0.0, 0.0, 1.0 - 0.3 * t)
}

/// The law's own stress and state.
fn step(law: &Frictional<f64>, f: &Matrix3<f64>, state: &mut [f64; FRICTIONAL_STATE]) -> [f64; 6] {
    let mut stress = [0.0; 6];
    let points = Points {
        f_new: components(f.as_ptr(), 1),
        state_old: Frictional::<f64>::parts(state.as_ptr(), 1),
        state_new: Frictional::<f64>::parts_mut(state.as_mut_ptr(), 1),
        stress: components_mut(stress.as_mut_ptr(), 1),
        ..Points::without_arrays(1, 1)
    };
    // SAFETY: arrays of one point.
    assert_eq!(unsafe { law.step(&points) }, Ok(0));
    stress
}

#[test]
fn a_umat_says_what_the_law_says() {
    let law = Frictional::<f64>::new(&PROPERTIES).expect("valid properties");
    let (mut own, mut statev) = ([0.0; FRICTIONAL_STATE], [0.0; FRICTIONAL_STATE]);
    for i in 1..=40 {
        let f = path(i);
        let expected = step(&law, &f, &mut own);
        let (mut stress, mut ddsdde, mut sse, mut pnewdt) = ([0.0; 6], [0.0; 36], 0.0, 1.0);
        let call = abaqus::Umat {
            stress: stress.as_mut_ptr(),
            statev: statev.as_mut_ptr(),
            ddsdde: ddsdde.as_mut_ptr(),
            sse: &mut sse,
            pnewdt: &mut pnewdt,
            dfgrd0: f.as_ptr(),
            dfgrd1: f.as_ptr(),
            props: PROPERTIES.as_ptr(),
            nprops: 13,
            nstatv: 15,
            ndi: 3,
            nshr: 3,
            nlgeom: 1,
        };
        // SAFETY: arrays as long as the call says.
        assert_eq!(unsafe { Frictional::<f64>::umat(&call, null_mut(), 0) }, 0);
        let [s11, s22, s33, s12, s23, s31] = expected;
        // A tangent goes through the general kernel, whose axes are those of any fibre: the last digits differ.
        for (value, expected) in statev.iter().zip(own) {
            assert!((value - expected).abs() <= 1e-11 * (1.0 + expected.abs()), "step {i}: {statev:?} {own:?}");
        }
        for (value, expected) in stress.iter().zip([s11, s22, s33, s12, s31, s23]) {
            assert!((value - expected).abs() <= 1e-11 * s11.abs(), "step {i}: {stress:?} {expected:?}");
        }
        let stored: f64 = own[..4].iter().sum();
        assert!((sse * f.determinant() - stored).abs() <= 1e-14 * stored);
    }
    assert!(own[FRICTIONAL_LOST] > 0.0);
}
