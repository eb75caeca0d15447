//! The law with friction in the hosts: what a solver gets along a path is what the law says, and the energy lost has
//! its place.

use std::ptr::null_mut;

use nalgebra::{Matrix3, Vector3};
use toron::Frictional;
use toron::host::abaqus::{self, ExplicitLaw, StandardLaw, Vumat};
use toron::host::mgis::{BehaviourDataView, INTEGRATED, MESSAGE_CAPACITY, MgisLaw, StateView};
use toron::law::block::{Circumstances, Points, components, components_mut};
use toron::law::interface::Law;
use toron::law::state::{FRICTIONAL_LOST, FRICTIONAL_STATE};
use toron::law::stress::components as six;

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
        let (mut stress, mut ddsdde, mut sse, mut spd, mut pnewdt) = ([0.0; 6], [0.0; 36], 0.0, f64::NAN, 1.0);
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
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: arrays as long as the call says.
        assert_eq!(unsafe { Frictional::<f64>::umat_with_losses(&call, &mut spd, null_mut(), 0) }, 0);
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
        let lost = own[FRICTIONAL_LOST];
        assert!((spd * f.determinant() - lost).abs() <= 1e-11 * (1.0 + lost), "step {i}: {spd}");
    }
    assert!(own[FRICTIONAL_LOST] > 0.0);
}

#[test]
fn a_vumat_tells_the_energy_lost_per_mass() {
    const DENSITY: f64 = 1.35e-9;
    let law = Frictional::<f64>::new(&PROPERTIES).expect("valid properties");
    let stretch =
        |i: u32| Matrix3::from_diagonal(&Vector3::new(1.01, 1.0 + 0.0025 * f64::from(i), 1.0 - 0.0075 * f64::from(i)));
    let (mut own, mut state) = ([0.0; FRICTIONAL_STATE], [0.0; FRICTIONAL_STATE]);
    let (mut intern, mut inelastic) = (0.0, 0.0);
    for i in 1..=40 {
        step(&law, &stretch(i), &mut own);
        let [old, new] = [i - 1, i].map(|i| six(&stretch(i)));
        // Abaqus passes the density of the middle of the step.
        let density = DENSITY / (0.5 * (stretch(i - 1) + stretch(i))).determinant();
        let (mut stress, mut kept, nothing) = ([0.0; 6], [0.0; FRICTIONAL_STATE], [0.0; 6]);
        let (old_intern, old_inelastic) = (intern, inelastic);
        let block = Vumat {
            nblock: 1,
            ndir: 3,
            nshr: 3,
            nstatev: FRICTIONAL_STATE as i32,
            nprops: 13,
            step_time: 1.0,
            total_time: 1.0,
            props: PROPERTIES.as_ptr(),
            density: &density,
            strain_inc: nothing.as_ptr(),
            stretch_old: old.as_ptr(),
            stretch_new: new.as_ptr(),
            stress_old: nothing.as_ptr(),
            state_old: state.as_ptr(),
            ener_intern_old: &old_intern,
            ener_inelas_old: &old_inelastic,
            stress_new: stress.as_mut_ptr(),
            state_new: kept.as_mut_ptr(),
            ener_intern_new: &mut intern,
            ener_inelas_new: &mut inelastic,
            ..Vumat::empty()
        };
        // SAFETY: arrays of one point.
        assert_eq!(unsafe { <Frictional<f64> as ExplicitLaw<f64>>::vumat(&block, null_mut(), 0) }, 0);
        state = kept;
        assert!((inelastic * DENSITY - own[FRICTIONAL_LOST]).abs() <= 1e-13 * own[FRICTIONAL_LOST], "step {i}");
        let stored: f64 = own[..4].iter().sum();
        assert!((intern * DENSITY - stored).abs() <= 1e-13 * stored, "step {i}");
    }
    assert!(inelastic > 0.0);
}

#[test]
fn mgis_gets_the_dissipated_energy() {
    let law = Frictional::<f64>::new(&PROPERTIES).expect("valid properties");
    let (mut own, mut state) = ([0.0; FRICTIONAL_STATE], [0.0; FRICTIONAL_STATE]);
    let mut unread = [f64::NAN; 9];
    for i in 1..=40 {
        let [f0, f1] = [i - 1, i].map(|i| by_mgis(&path(i)));
        step(&law, &path(i), &mut own);
        let (mut stress, mut k, mut new) = ([f64::NAN; 6], [0.0; 36], [0.0; FRICTIONAL_STATE]);
        let (mut energies, mut speed, mut rdt, mut text) = ([f64::NAN; 2], 0.0, 1.0, [0; MESSAGE_CAPACITY]);
        let nothing = unread.as_mut_ptr();
        let s0 = StateView {
            gradients: f0.as_ptr(),
            thermodynamic_forces: nothing,
            mass_density: nothing,
            material_properties: nothing,
            internal_state_variables: state.as_mut_ptr(),
            stored_energy: nothing,
            dissipated_energy: nothing,
            external_state_variables: nothing,
        };
        let [stored, dissipated] = energies.each_mut().map(std::ptr::from_mut);
        let s1 = StateView {
            gradients: f1.as_ptr(),
            thermodynamic_forces: stress.as_mut_ptr(),
            material_properties: PROPERTIES.as_ptr(),
            internal_state_variables: new.as_mut_ptr(),
            stored_energy: stored,
            dissipated_energy: dissipated,
            ..s0
        };
        let (error_message, k) = (text.as_mut_ptr(), k.as_mut_ptr());
        let mut view =
            BehaviourDataView { error_message, dt: 1.0, k, rdt: &mut rdt, speed_of_sound: &mut speed, s0, s1 };
        // SAFETY: the arrays have the sizes of a law in three dimensions.
        assert_eq!(unsafe { <Frictional<f64> as MgisLaw>::integrate(&mut view) }, INTEGRATED);
        state = new;
        let expected: f64 = own[..4].iter().sum();
        assert!((energies[0] - expected).abs() <= 1e-12 * expected, "step {i}: {energies:?}");
        assert!((energies[1] - own[FRICTIONAL_LOST]).abs() <= 1e-12 * own[FRICTIONAL_LOST], "step {i}: {energies:?}");
    }
    assert!(own[FRICTIONAL_LOST] > 0.0);
}

/// F as MGIS has it: 11 22 33 12 21 13 31 23 32.
fn by_mgis(f: &Matrix3<f64>) -> [f64; 9] {
    [f.m11, f.m22, f.m33, f.m12, f.m21, f.m13, f.m31, f.m23, f.m32]
}

/// A law that loses nothing leaves SPD as it is, and so does a call that is refused.
#[test]
fn spd_is_written_by_a_law_that_loses_energy_alone() {
    let f = path(40);
    let (mut stress, mut statev, mut sse, mut pnewdt) = ([0.0; 6], [0.0; FRICTIONAL_STATE], 0.0, 1.0);
    for nprops in [11, 10] {
        let mut spd = 7.0;
        let call = abaqus::Umat {
            stress: stress.as_mut_ptr(),
            statev: statev.as_mut_ptr(),
            ddsdde: null_mut(),
            sse: &mut sse,
            pnewdt: &mut pnewdt,
            dfgrd0: f.as_ptr(),
            dfgrd1: f.as_ptr(),
            props: PROPERTIES.as_ptr(),
            nprops,
            nstatv: 15,
            ndi: 3,
            nshr: 3,
            nlgeom: 1,
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: arrays as long as the call says.
        unsafe { toron::Hyperelastic::<f64>::umat_with_losses(&call, &mut spd, null_mut(), 0) };
        assert_eq!(spd, 7.0);
    }
}

#[test]
fn a_material_of_abaqus_has_the_law_of_its_counts() {
    use toron::host::laws::by_counts;
    for (counts, number) in [
        ([11, 11], 1),
        ([12, 12], 1),
        ([11, 20], 1),
        ([10, 10], 2),
        // Cards that lack a property or a variable.
        ([10, 11], 1),
        ([13, 15], 3),
        ([13, 11], 3),
        // With a limit variable, and with variables of the user's own.
        ([14, 16], 3),
        ([13, 20], 3),
        ([15, 15], 1),
    ] {
        assert_eq!(by_counts(counts), number, "{counts:?}");
    }
}
