//! The linear elastic law in Abaqus, LS-DYNA and CalculiX, each called as the solver does along a path of large
//! rotations, shears and stretches: stress, state, energy and tangent against the law's own steps; failure, points that
//! cannot be evaluated, plane elements, and what is refused.

use std::ffi::c_char;
use std::ptr::null_mut;

use nalgebra::{Matrix3, Rotation3, Vector3};
use toron::host::abaqus::{self, ExplicitLaw, StandardLaw, Vumat};
use toron::host::calculix::{self, Behaviour};
use toron::host::lsdyna::{self, UmatVector, UserRoutines, UtanVector};
use toron::law::block::Circumstances;
use toron::law::status;
use toron::law::stress::{components, matrix};
use toron::state::{LINEAR_ALIVE, LINEAR_ELASTIC_STATE, LINEAR_FAILED, LINEAR_WORK};
use toron::{Criterion, Hyperelastic, LinearElastic, Measure, Request, Rotation};

const S: usize = LINEAR_ELASTIC_STATE;
/// A yarn in GPa whose fibre and second axis are oblique; it does not fail.
const OBLIQUE: [f64; 10] = [79.414, 0.794, 0.126, 0.0, 0.3, -0.5, 0.8, 0.2, 0.9, 0.1];
const ALONG_X: [f64; 10] = [79.414, 0.794, 0.126, 3.637, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
const ROOM: usize = 512;

/// A message, as text.
fn text(message: &[c_char; ROOM]) -> String {
    message.iter().take_while(|&&c| c != 0).map(|&c| char::from(c as u8)).collect()
}

/// F along a path in `steps` steps from rest: turned by 79°, stretched, sheared.
fn path(steps: usize) -> Vec<Matrix3<f64>> {
    (0..=steps)
        .map(|step| {
            let t = step as f64 / steps as f64;
            let turn = Rotation3::new(Vector3::new(0.6, 1.2, -0.3) * t);
            let stretch = Matrix3::new(
                1.0 + 0.03 * t,
                0.1 * t,
                0.0,
                -0.05 * t,
                1.0 - 0.1 * t,
                0.07 * t,
                0.0,
                0.02 * t,
                1.0 + 0.2 * t * t,
            );
            turn.into_inner() * stretch
        })
        .collect()
}

/// What the law itself gives at the ends of the steps of a path, with the Jaumann modulus.
struct Truth {
    stress: [f64; 6],
    state: [f64; S],
    jaumann: [[f64; 6]; 6],
    material: [[f64; 6]; 6],
    /// The Truesdell modulus of a further, infinitesimal step.
    next: [[f64; 6]; 6],
}

fn truth(law: &LinearElastic, path: &[Matrix3<f64>]) -> Vec<Truth> {
    let (mut state, mut axes) = ([0.0; S], Matrix3::identity());
    let step = |f0: &Matrix3<f64>, f1: &Matrix3<f64>, state: &[f64; S], axes: &mut Matrix3<f64>| {
        law.step_with_tangent(f0, f1, state, Rotation::Fibre, Criterion::LargestPrincipal, axes)
    };
    path.windows(2)
        .map(|ends| {
            let (point, tangent) = step(&ends[0], &ends[1], &state, &mut axes);
            assert_eq!(point.status, status::OK);
            state = point.state;
            let of = |measure| tangent.matrix(measure, &ends[1], &point.stress).expect("F has an inverse");
            let (jaumann, material) = (of(Measure::Jaumann), of(Measure::Material));
            let (_, next) = step(&ends[1], &ends[1], &state, &mut axes);
            let next = next.matrix(Measure::Truesdell, &ends[1], &point.stress).expect("F has an inverse");
            Truth { stress: point.stress, state, jaumann, material, next }
        })
        .collect()
}

/// Whether two lists of numbers agree, relative to the largest.
fn assert_near(found: &[f64], wanted: &[f64], tolerance: f64, what: &str) {
    let size = wanted.iter().fold(1e-300_f64, |size, x| size.max(x.abs()));
    assert_eq!(found.len(), wanted.len(), "{what}");
    for (a, b) in found.iter().zip(wanted) {
        assert!((a - b).abs() <= tolerance * size, "{what}: {found:?} instead of {wanted:?}");
    }
}

/// 11 22 33 12 23 31 from 11 22 33 12 13 23, and the reverse.
fn order<X: Copy>(s: [X; 6]) -> [X; 6] {
    [s[0], s[1], s[2], s[3], s[5], s[4]]
}

fn symmetric_part(rows: &[[f64; 6]; 6]) -> [[f64; 6]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (rows[i][j] + rows[j][i])))
}

/// A UMAT's point; NTENS = 6, or 4 for a plane element.
struct Umat {
    stress: Vec<f64>,
    statev: Vec<f64>,
    ddsdde: Vec<f64>,
    sse: f64,
    pnewdt: f64,
    message: String,
}

impl Umat {
    fn new(ntens: usize) -> Self {
        let nan = |count| vec![f64::NAN; count];
        Umat {
            stress: nan(ntens),
            statev: vec![0.0; S],
            ddsdde: nan(ntens * ntens),
            sse: f64::NAN,
            pnewdt: 1.0,
            message: String::new(),
        }
    }

    fn call(&mut self, properties: &[f64], f: [&Matrix3<f64>; 2], [ndi, nshr, nlgeom]: [i32; 3]) -> i32 {
        let mut message = [0; ROOM];
        let call = abaqus::Umat {
            stress: self.stress.as_mut_ptr(),
            statev: self.statev.as_mut_ptr(),
            ddsdde: self.ddsdde.as_mut_ptr(),
            sse: &mut self.sse,
            pnewdt: &mut self.pnewdt,
            dfgrd0: f[0].as_ptr(),
            dfgrd1: f[1].as_ptr(),
            props: properties.as_ptr(),
            nprops: properties.len() as i32,
            nstatv: self.statev.len() as i32,
            ndi,
            nshr,
            nlgeom,
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        let code = unsafe { <LinearElastic as StandardLaw>::umat(&call, message.as_mut_ptr(), ROOM) };
        self.message = text(&message);
        code
    }
}

#[test]
fn umat() {
    let law = LinearElastic::new(&OBLIQUE).expect("valid properties");
    let path = path(7);
    let mut point = Umat::new(6);
    for (ends, truth) in path.windows(2).zip(truth(&law, &path)) {
        assert_eq!(point.call(&OBLIQUE, [&ends[0], &ends[1]], [3, 3, 1]), status::OK);
        assert_near(&point.stress, &order(truth.stress), 1e-14, "stress");
        assert_near(&point.statev, &truth.state, 1e-14, "state");
        let by_columns: Vec<f64> = (0..36).map(|k| order(truth.jaumann.map(order))[k % 6][k / 6]).collect();
        assert_near(&point.ddsdde, &by_columns, 1e-13, "DDSDDE");
        assert_near(&[point.sse], &[truth.state[LINEAR_WORK] / ends[1].determinant()], 1e-14, "SSE");
    }
    assert_eq!(point.pnewdt, 1.0);
    assert!(point.stress.iter().any(|s| s.abs() > 0.1) && point.sse > 0.0);
}

#[test]
fn a_umat_fails_and_is_cut_back() {
    let (rest, stretched) = (Matrix3::identity(), Matrix3::from_diagonal(&Vector3::new(1.05, 1.0, 1.0)));
    let mut point = Umat::new(6);
    assert_eq!(point.call(&ALONG_X, [&rest, &stretched], [3, 3, 1]), status::OK);
    assert_eq!([point.statev[LINEAR_FAILED], point.statev[LINEAR_ALIVE]], [1.0, 0.0]);
    assert!(point.stress[0] > 3.637, "the call that detects failure returns the intact stress");
    assert_eq!(point.call(&ALONG_X, [&stretched, &rest], [3, 3, 1]), status::OK);
    assert!(point.stress.iter().chain(&point.ddsdde).all(|&x| x == 0.0));
    let inverted = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
    for (bad, code) in [(inverted, status::INVERTED), (stretched * f64::NAN, status::NOT_FINITE)] {
        let mut point = Umat::new(6);
        point.statev[0] = 0.5;
        assert_eq!(point.call(&ALONG_X, [&rest, &bad], [3, 3, 1]), code);
        assert_eq!((point.pnewdt, point.statev[0]), (0.25, 0.5));
        assert!(point.stress.iter().chain(&point.ddsdde).all(|&x| x == 0.0));
        assert!(point.message.len() > 20, "{}", point.message);
    }
}

#[test]
fn what_a_umat_refuses() {
    let rest = Matrix3::identity();
    let refused = |properties: &[f64], counts: [i32; 3], state: usize| {
        let mut point = Umat::new(6);
        point.statev.truncate(state);
        let code = point.call(properties, [&rest, &rest], counts);
        assert!(point.stress.iter().all(|s| s.is_nan()) && point.sse.is_nan(), "nothing is written");
        (code, point.message)
    };
    let (code, message) = refused(&ALONG_X, [2, 1, 1], S);
    assert_eq!((code, message.as_str()), (-102, "direct stress components, NDI (solids only): 2 given, 3 needed"));
    let (code, message) = refused(&ALONG_X, [3, 3, 1], 9);
    assert_eq!((code, message.as_str()), (-211, "number of state variables (*DEPVAR): 9 given, 10 needed"));
    let (code, message) = refused(&ALONG_X[..7], [3, 3, 1], S);
    assert_eq!((code, message.as_str()), (-201, "number of properties: 7 given, 10 needed"));
    assert_eq!(refused(&ALONG_X, [3, 3, 0], S).0, -106);
    let mut wrong = ALONG_X;
    wrong[1] = -1.0;
    let (code, message) = refused(&wrong, [3, 3, 1], S);
    assert_eq!(code, -203);
    assert!(message.starts_with("property 2 (e_2, "), "{message}");
    let (code, message) = refused(&OBLIQUE, [3, 1, 1], S);
    assert_eq!(code, status::FIBRE_OUT_OF_PLANE);
    assert!(message.starts_with("properties 5 to 7 (fibre direction) are 0.3, -0.5, 0.8; allowed: "), "{message}");
}

/// F in the plane, in so many steps.
fn plane_path(steps: usize) -> Vec<Matrix3<f64>> {
    (0..=steps)
        .map(|step| {
            let t = step as f64 / steps as f64;
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 1.2 * t).into_inner();
            turn * Matrix3::new(1.0 + 0.02 * t, 0.15 * t, 0.0, 0.0, 1.0 - 0.08 * t, 0.0, 0.0, 0.0, 1.0 + 0.05 * t)
        })
        .collect()
}

#[test]
fn a_umat_in_plane_strain() {
    for fibre in [[0.6, -0.3, 0.0], [0.0, 0.0, 1.0]] {
        let mut properties = ALONG_X;
        properties[3] = 0.0;
        properties[4..7].copy_from_slice(&fibre);
        let law = LinearElastic::new(&properties).expect("valid properties");
        let path = plane_path(5);
        let mut point = Umat::new(4);
        for (ends, truth) in path.windows(2).zip(truth(&law, &path)) {
            assert_eq!(point.call(&properties, [&ends[0], &ends[1]], [3, 1, 1]), status::OK);
            assert_near(&point.stress, &truth.stress[..4], 1e-14, "stress");
            assert!(truth.stress[4..].iter().all(|s| s.abs() < 1e-13));
            let by_columns: Vec<f64> = (0..16).map(|k| truth.jaumann[k % 4][k / 4]).collect();
            assert_near(&point.ddsdde, &by_columns, 1e-13, "DDSDDE");
        }
    }
}

/// The arrays of a VUMAT of some points, all at the same F, and how many shear components there are.
struct Job {
    n: usize,
    shear: usize,
    properties: Vec<f64>,
    state: Vec<f64>,
    stress: Vec<f64>,
    energy: Vec<f64>,
    message: String,
}

type Entry = unsafe fn(*const Vumat<f64>, *mut c_char, usize) -> i32;

impl Job {
    fn new(n: usize, shear: usize, properties: &[f64], state: usize) -> Self {
        Job {
            n,
            shear,
            properties: properties.to_vec(),
            state: vec![0.0; n * state],
            stress: vec![0.0; n * (3 + shear)],
            energy: vec![0.0; n],
            message: String::new(),
        }
    }

    /// A step between two stretches at a reference density of 2; time 0 is the data check, which strains by `strain`.
    fn step(&mut self, entry: Entry, [old, new]: [&Matrix3<f64>; 2], time: f64, strain: &[f64; 6]) -> i32 {
        let (n, tensor) = (self.n, 3 + self.shear);
        let of_all = |values: [f64; 6]| -> Vec<f64> { (0..n * tensor).map(|k| values[k / n]).collect() };
        let (old, new, strain) = (of_all(components(old)), of_all(components(new)), of_all(*strain));
        let middle = Matrix3::from_iterator((0..9).map(|k| {
            let place = [[0, 3, 5], [3, 1, 4], [5, 4, 2]][k / 3][k % 3];
            if place < tensor { 0.5 * (old[place * n] + new[place * n]) } else { 0.0 }
        }));
        let density = vec![2.0 / middle.determinant(); n];
        let (state, stress, energy) = (self.state.clone(), self.stress.clone(), self.energy.clone());
        let (zeros, mut inelastic) = (vec![0.0; n], vec![f64::NAN; n]);
        let mut message = [0; ROOM];
        let job = Vumat {
            nblock: n as i32,
            ndir: 3,
            nshr: self.shear as i32,
            nstatev: (state.len() / n) as i32,
            nprops: self.properties.len() as i32,
            step_time: time,
            total_time: time,
            props: self.properties.as_ptr(),
            density: density.as_ptr(),
            strain_inc: strain.as_ptr(),
            stretch_old: old.as_ptr(),
            stretch_new: new.as_ptr(),
            stress_old: stress.as_ptr(),
            state_old: state.as_ptr(),
            ener_intern_old: energy.as_ptr(),
            ener_inelas_old: zeros.as_ptr(),
            stress_new: self.stress.as_mut_ptr(),
            state_new: self.state.as_mut_ptr(),
            ener_intern_new: self.energy.as_mut_ptr(),
            ener_inelas_new: inelastic.as_mut_ptr(),
            ..Vumat::empty()
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        let code = unsafe { entry(&job, message.as_mut_ptr(), ROOM) };
        self.message = text(&message);
        code
    }

    fn of(&self, array: &[f64], point: usize) -> Vec<f64> {
        array.iter().skip(point).step_by(self.n).copied().collect()
    }
}

/// R and U of F.
fn polar(f: &Matrix3<f64>) -> (Matrix3<f64>, Matrix3<f64>) {
    let svd = f.svd(true, true);
    let (u, v) = (svd.u.expect("asked for"), svd.v_t.expect("asked for"));
    (u * v, v.transpose() * Matrix3::from_diagonal(&svd.singular_values) * v)
}

#[test]
fn vumat() {
    let law = LinearElastic::new(&OBLIQUE).expect("valid properties");
    let path = path(7);
    let mut job = Job::new(70, 3, &OBLIQUE, S + 2);
    job.state[70 * S..].fill(7.0);
    for (ends, truth) in path.windows(2).zip(truth(&law, &path)) {
        let [(_, old), (r, new)] = [polar(&ends[0]), polar(&ends[1])];
        assert_eq!(job.step(LinearElastic::vumat, [&old, &new], 1.0, &[0.0; 6]), status::OK);
        let corotational = components(&(r.transpose() * matrix(&truth.stress) * r));
        for point in [0, 63, 64, 69] {
            assert_near(&job.of(&job.stress, point), &corotational, 1e-12, "stress");
            let state = job.of(&job.state, point);
            assert_near(&state[..S], &truth.state, 1e-12, "state");
            assert_eq!(state[S..], [7.0, 7.0]);
            assert_near(&[job.energy[point]], &[truth.state[LINEAR_WORK] / 2.0], 1e-12, "energy");
        }
    }
}

#[test]
fn the_data_check_of_a_vumat() {
    let rest = Matrix3::identity();
    let mut job = Job::new(3, 3, &ALONG_X, S);
    let strain = [1e-3, 2e-3, -1e-3, 5e-4, 0.0, 1e-4];
    assert_eq!(job.step(LinearElastic::vumat, [&rest, &rest], 0.0, &strain), status::OK);
    let (bulk, shear) = (0.5 * 79.414, 0.375 * 79.414);
    let (volumetric, two_g) = ((bulk - 2.0 / 3.0 * shear) * 2e-3, 2.0 * shear);
    let wanted: [f64; 6] = std::array::from_fn(|c| two_g * strain[c] + if c < 3 { volumetric } else { 0.0 });
    assert_near(&job.of(&job.stress, 1), &wanted, 1e-14, "stress");
    let state = job.of(&job.state, 1);
    assert!(state[..LINEAR_ALIVE].iter().all(|&x| x == 0.0) && state[LINEAR_ALIVE] == 1.0);
    // An old energy that is no number deletes its point.
    job.energy[1] = f64::NAN;
    assert_eq!(job.step(LinearElastic::vumat, [&rest, &rest], 0.0, &strain), status::STATE_NOT_FINITE);
    assert_eq!((job.of(&job.state, 1)[LINEAR_FAILED..].to_vec(), job.energy[1]), (vec![1.0, 0.0], 0.0));
    assert_eq!(job.of(&job.state, 0)[LINEAR_FAILED..], [0.0, 1.0]);
}

/// Plane-strain and axisymmetric elements have four components; both laws.
#[test]
fn vumats_in_the_plane() {
    let path = plane_path(5);
    let linear = [79.414, 0.794, 0.126, 0.0, 0.6, -0.3, 0.0, 0.0, 0.0, 0.0];
    let yarn = [82.341, 1.055, 2.2, 0.64974, 0.1, 0.0, 1.8, 0.3, 0.6, -0.3, 0.0];
    let law = LinearElastic::new(&linear).expect("valid properties");
    let hyperelastic = Hyperelastic::new(&yarn).expect("valid properties");
    let mut jobs = [Job::new(67, 1, &linear, 10), Job::new(67, 1, &yarn, 11)];
    for (ends, truth) in path.windows(2).zip(truth(&law, &path)) {
        let [(_, old), (r, new)] = [polar(&ends[0]), polar(&ends[1])];
        let stresses = [truth.stress, hyperelastic.point(&ends[1], &[0.0; 11], Request::ALL).stress];
        for ((job, entry), stress) in
            jobs.iter_mut().zip([LinearElastic::vumat as Entry, Hyperelastic::vumat]).zip(stresses)
        {
            assert_eq!(job.step(entry, [&old, &new], 1.0, &[0.0; 6]), status::OK, "{}", job.message);
            let corotational = components(&(r.transpose() * matrix(&stress) * r));
            for point in [0, 66] {
                assert_near(&job.of(&job.stress, point), &corotational[..4], 1e-12, "stress");
            }
        }
    }
    assert!(jobs[0].energy[0] > 0.0 && jobs[1].energy[0] > 0.0);
}

#[test]
fn what_a_vumat_refuses() {
    let rest = Matrix3::identity();
    let mut oblique = Job::new(1, 1, &OBLIQUE, S);
    assert_eq!(oblique.step(LinearElastic::vumat, [&rest, &rest], 1.0, &[0.0; 6]), status::FIBRE_OUT_OF_PLANE);
    assert!(
        oblique.message.starts_with("properties 5 to 7 (fibre direction) are 0.3, -0.5, 0.8"),
        "{}",
        oblique.message
    );
    let yarn = [82.341, 1.055, 2.2, 0.64974, 0.1, 0.0, 1.8, 0.3, 0.6, -0.3, 0.5];
    let mut oblique = Job::new(1, 1, &yarn, 11);
    assert_eq!(oblique.step(Hyperelastic::vumat, [&rest, &rest], 1.0, &[0.0; 6]), status::FIBRE_OUT_OF_PLANE);
    let mut few = Job::new(1, 3, &ALONG_X, S - 1);
    assert_eq!(few.step(LinearElastic::vumat, [&rest, &rest], 1.0, &[0.0; 6]), -211);
    assert_eq!(few.message, "number of state variables (*DEPVAR): 9 given, 10 needed");
    let inverted = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
    let mut bad = Job::new(2, 3, &ALONG_X, S);
    assert_eq!(bad.step(LinearElastic::vumat, [&rest, &inverted], 1.0, &[0.0; 6]), status::INVERTED);
    assert_eq!(bad.of(&bad.state, 0)[LINEAR_FAILED..], [1.0, 0.0]);
    assert!(bad.stress.iter().all(|&s| s == 0.0));
}

/// Single precision agrees with double precision to its digits.
#[test]
fn a_vumat_in_single_precision() {
    let single = |values: &[f64]| -> Vec<f32> { values.iter().map(|&x| x as f32).collect() };
    let path = path(7);
    let (properties, mut old_state, mut double) = (single(&OBLIQUE), vec![0.0_f32; S], Job::new(1, 3, &OBLIQUE, S));
    for ends in path.windows(2) {
        let [(_, old), (_, new)] = [polar(&ends[0]), polar(&ends[1])];
        let [old_u, new_u] = [&old, &new].map(|u| single(&components(u)));
        let (zeros, density, mut energies) = ([0.0_f32; 6], [1.0_f32], [0.0_f32; 2]);
        let (mut stress, mut state) = ([0.0_f32; 6], vec![0.0_f32; S]);
        let [internal, inelastic] = &mut energies;
        let job = Vumat::<f32> {
            nblock: 1,
            ndir: 3,
            nshr: 3,
            nstatev: S as i32,
            nprops: 10,
            step_time: 1.0,
            total_time: 1.0,
            props: properties.as_ptr(),
            density: density.as_ptr(),
            strain_inc: zeros.as_ptr(),
            stretch_old: old_u.as_ptr(),
            stretch_new: new_u.as_ptr(),
            stress_old: zeros.as_ptr(),
            state_old: old_state.as_ptr(),
            ener_intern_old: zeros.as_ptr(),
            ener_inelas_old: zeros.as_ptr(),
            stress_new: stress.as_mut_ptr(),
            state_new: state.as_mut_ptr(),
            ener_intern_new: internal,
            ener_inelas_new: inelastic,
            ..Vumat::empty()
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        assert_eq!(unsafe { <LinearElastic<f32>>::vumat(&job, null_mut(), 0) }, status::OK);
        assert_eq!(double.step(LinearElastic::vumat, [&old, &new], 1.0, &[0.0; 6]), status::OK);
        assert_near(&stress.map(f64::from), &double.of(&double.stress, 0), 2e-5, "stress");
        old_state = state;
    }
}

/// LS-DYNA's scalar routine: its status and message.
fn element(cm: &[f64; 10], sig: &mut [f64; 6], hsv: &mut [f64], nhv: i32, failel: &mut i32) -> (i32, String) {
    assert!(hsv.len() == nhv as usize + 9);
    let (cm, sig, hsv, mut message) = (cm.as_ptr(), sig.as_mut_ptr(), hsv.as_mut_ptr(), [0; ROOM]);
    let call = lsdyna::Umat { cm, sig, hsv, nhv, failel };
    // SAFETY: the arrays have the sizes that the structure tells.
    let code = unsafe { <LinearElastic as UserRoutines<f64>>::umat(&call, message.as_mut_ptr(), ROOM) };
    (code, text(&message))
}

/// An element of LS-DYNA in both of its routines, and its tangents.
#[test]
fn lsdyna_routines() {
    let law = LinearElastic::new(&OBLIQUE).expect("valid properties");
    let path = path(7);
    const NLQ: usize = 70;
    const NHV: i32 = 19;
    let (mut hsv, mut hsvs) = ([0.0; 28], vec![0.0; 28 * NLQ]);
    for (f, truth) in path[1..].iter().zip(truth(&law, &path)) {
        hsv[19..].copy_from_slice(f.as_slice());
        for (c, &value) in f.as_slice().iter().enumerate() {
            hsvs[(19 + c) * NLQ + 1..(20 + c) * NLQ].fill(value);
        }
        let (mut sig, mut failed, mut es) = ([f64::NAN; 6], 7, [f64::NAN; 36]);
        let (mut sigs, mut failels, mut dsave) = (vec![f64::NAN; 6 * NLQ], [7; NLQ], vec![f64::NAN; 36 * NLQ]);
        let (cm, nlq) = (OBLIQUE.as_ptr(), NLQ as i32);
        let sig1 = sigs.as_mut_ptr();
        let rows = [0, 1, 2, 3, 4, 5].map(|c| sig1.wrapping_add(c * NLQ));
        let (hsv_, hsvs_, dsave_) = (hsv.as_mut_ptr(), hsvs.as_mut_ptr(), dsave.as_mut_ptr());
        let element = lsdyna::Umat { cm, sig: sig.as_mut_ptr(), hsv: hsv_, nhv: NHV, failel: &mut failed };
        let tangent = lsdyna::Utan { cm, hsv: hsv_, nhv: NHV, es: es.as_mut_ptr() };
        let failels_ = failels.as_mut_ptr();
        let (lft, llt) = (2, nlq);
        let elements = UmatVector { cm, sig: rows, hsvs: hsvs_, nhv: NHV, lft, llt, nlq, failels: failels_ };
        let tangents = UtanVector { cm, hsvs: hsvs_, nhv: NHV, lft, llt, nlq, dsave: dsave_ };
        // SAFETY: the arrays have the sizes that the structures tell; elements 2 to nlq.
        let codes = unsafe {
            [
                <LinearElastic as UserRoutines<f64>>::umat(&element, null_mut(), 0),
                LinearElastic::utan(&tangent, null_mut(), 0),
                LinearElastic::umat_vector(&elements, null_mut(), 0),
                LinearElastic::utan_vector(&tangents, null_mut(), 0),
            ]
        };
        assert_eq!((codes, failed), ([status::OK; 4], 0));
        assert_near(&sig, &truth.stress, 1e-14, "stress");
        assert_near(&hsv[..S], &truth.state, 1e-14, "state");
        assert_eq!(hsv[S..19], hsv[19..], "F of the last step");
        assert_near(&es, symmetric_part(&truth.next).as_flattened(), 1e-13, "es");
        assert!(sigs[0].is_nan() && dsave[0].is_nan() && failels[0] == 7, "element 1 is not touched");
        for element in [1, 64, 65, NLQ - 1] {
            let of = |array: &[f64]| -> Vec<f64> { array.iter().skip(element).step_by(NLQ).copied().collect() };
            assert_near(&of(&sigs), &truth.stress, 1e-13, "stress of a vector");
            assert_near(&of(&hsvs)[..S], &truth.state, 1e-13, "state of a vector");
            assert_near(&of(&dsave), symmetric_part(&truth.next).as_flattened(), 1e-13, "dsave");
            assert_eq!(failels[element], 0);
        }
    }
}

/// With material axes (IHYPER = −1, IORTHO = 1) LS-DYNA hands over F Z0ᵀ: the stress must be that of the fibre along
/// the first axis.
#[test]
fn lsdyna_with_material_axes() {
    let axes = Rotation3::from_euler_angles(0.4, -0.7, 1.1).into_inner(); // columns
    let fibre = axes.column(0);
    let mut global = ALONG_X;
    global[3] = 0.0;
    let local = global;
    global[4..7].copy_from_slice(fibre.as_slice());
    global[7..10].copy_from_slice(axes.column(1).as_slice());
    let mut along_axes = local;
    along_axes[7..10].copy_from_slice(&[0.0, 1.0, 0.0]);
    let law = LinearElastic::new(&global).expect("valid properties");
    let path = path(6);
    let (mut hsv, mut failed) = ([0.0; 28], 0);
    for (f, truth) in path[1..].iter().zip(truth(&law, &path)) {
        let mut sig = [f64::NAN; 6];
        hsv[19..].copy_from_slice((f * axes).as_slice());
        let code = element(&along_axes, &mut sig, &mut hsv, 19, &mut failed).0;
        assert_eq!(code, status::OK);
        assert_near(&sig, &truth.stress, 1e-13, "stress");
    }
}

#[test]
fn what_lsdyna_is_refused() {
    let rest = Matrix3::identity();
    let call = |properties: &[f64; 10], nhv: usize, f: &Matrix3<f64>| {
        let (mut sig, mut failed) = ([f64::NAN; 6], 7);
        let hsv = [vec![0.0; nhv], f.as_slice().to_vec()].concat();
        let mut new = hsv.clone();
        let answer = element(properties, &mut sig, &mut new, nhv as i32, &mut failed);
        assert!(sig[0].is_nan() && new == hsv && failed == 7, "nothing is written");
        answer
    };
    let (code, message) = call(&ALONG_X, 11, &rest);
    assert_eq!(code, status::STATE_COUNT);
    assert_eq!(message, "number of history variables, NHV, of the linear elastic law: 11 given, 19 needed");
    assert_eq!(call(&ALONG_X, 19, &Matrix3::zeros()).0, status::NO_DEFORMATION_GRADIENT);
    let mut wrong = ALONG_X;
    wrong[0] = f64::NAN;
    assert_eq!(call(&wrong, 19, &rest).0, status::PROPERTY_NOT_FINITE);
}

#[test]
fn lsdyna_elements_that_fail() {
    let stretched = Matrix3::from_diagonal(&Vector3::new(1.05, 1.0, 1.0));
    let inverted = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
    for (f, code) in [(stretched, status::OK), (inverted, status::INVERTED)] {
        let (mut hsv, mut sig, mut failed, mut es) = ([0.0; 28], [f64::NAN; 6], 7, [f64::NAN; 36]);
        hsv[19..].copy_from_slice(f.as_slice());
        for call in 0..2 {
            let found = element(&ALONG_X, &mut sig, &mut hsv, 19, &mut failed).0;
            // A point that has failed is not evaluated again.
            assert_eq!((found, failed), (if call == 0 { code } else { status::OK }, 1));
            assert_eq!(sig.iter().all(|&s| s == 0.0), call > 0 || code != status::OK);
            assert_eq!(hsv[LINEAR_FAILED..=LINEAR_ALIVE], [1.0, 0.0]);
        }
        let call = lsdyna::Utan { cm: ALONG_X.as_ptr(), hsv: hsv.as_ptr(), nhv: 19, es: es.as_mut_ptr() };
        // SAFETY: the arrays have the sizes that the structure tells.
        let tangent = unsafe { LinearElastic::utan(&call, null_mut(), 0) };
        assert_eq!((tangent, es), (status::OK, [0.0; 36]));
    }
}

/// A collapsed element whose history is this law's is deleted; it does not stop the job, as one without any F does.
#[test]
fn lsdyna_elements_that_collapse() {
    let mut hsv = [0.0; 28];
    hsv[19..].copy_from_slice(Matrix3::from_diagonal(&Vector3::new(1.01, 1.0, 1.0)).as_slice());
    let (mut sig, mut failed) = ([f64::NAN; 6], 7);
    let (flat, none) = (Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, 1.0)), Matrix3::zeros());
    let missing = status::NO_DEFORMATION_GRADIENT;
    // The last one is refused, and what the one before it has written stays.
    for (f, code, failel) in [(None, status::OK, 0), (Some(flat), status::INVERTED, 1), (Some(none), missing, 1)] {
        if let Some(f) = f {
            hsv[19..].copy_from_slice(f.as_slice());
        }
        let found = element(&ALONG_X, &mut sig, &mut hsv, 19, &mut failed).0;
        assert_eq!((found, failed), (code, failel));
    }
    assert_eq!((sig, &hsv[LINEAR_FAILED..=LINEAR_ALIVE]), ([0.0; 6], &[1.0, 0.0][..]));
}

/// The same in the step after the first one, in which nothing happens: state, F of that step and flat F then hold a
/// turned F too.
#[test]
fn lsdyna_elements_that_collapse_from_rest() {
    for flat in [[0.0, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.9, 1.1, 0.0], [0.0, 0.0, 1.0]] {
        let (mut hsv, mut sig, mut failed) = ([0.0; 28], [f64::NAN; 6], 7);
        for (f, code) in [([1.0; 3], status::OK), (flat, status::INVERTED)] {
            hsv[19..].copy_from_slice(Matrix3::from_diagonal(&Vector3::from(f)).as_slice());
            assert_eq!(element(&ALONG_X, &mut sig, &mut hsv, 19, &mut failed).0, code, "{flat:?}");
        }
        assert_eq!((failed, sig, &hsv[LINEAR_FAILED..=LINEAR_ALIVE]), (1, [0.0; 6], &[1.0, 0.0][..]), "{flat:?}");
    }
}

#[test]
fn lsdyna_bulk_and_shear() {
    let (mut bulk, mut shear) = (0.0, 0.0);
    // SAFETY: the arrays have the sizes that the entry asks for.
    let code = unsafe { LinearElastic::card_moduli(ALONG_X.as_ptr(), 10, &mut bulk, &mut shear, null_mut(), 0) };
    assert_eq!(code, status::OK);
    assert_near(&[bulk + 4.0 / 3.0 * shear], &[79.414], 1e-15, "K + 4G/3");
}

/// A point of CalculiX; `axes` are those of *ORIENTATION, two vectors.
struct Ccx {
    old: [f64; 19],
    new: [f64; 19],
    stress: [f64; 6],
    stiffness: [f64; 21],
    pnewdt: f64,
}

impl Ccx {
    const FRESH: Ccx =
        Ccx { old: [0.0; 19], new: [f64::NAN; 19], stress: [f64::NAN; 6], stiffness: [f64::NAN; 21], pnewdt: -1.0 };

    fn call(&mut self, properties: &[f64; 10], f: &Matrix3<f64>, axes: Option<[f64; 6]>) {
        let strain = 0.5 * (f.tr_mul(f) - Matrix3::identity());
        let strain = order(components(&strain));
        let [a, b, c, d, e, g] = axes.unwrap_or_default();
        let orab = [a, b, c, d, e, g, 1.0];
        let (name, zeros, iorien) = ([b' ' as c_char; 80], [0.0; 6], i32::from(axes.is_some()));
        let call = Behaviour {
            amat: name.as_ptr(),
            iel: &1,
            iint: &1,
            kode: &-110,
            elconloc: properties.as_ptr(),
            emec: strain.as_ptr(),
            beta: zeros.as_ptr(),
            xkl: f.as_ptr(),
            mi: &1,
            nstate_: &19,
            xstateini: self.old.as_ptr(),
            xstate: self.new.as_mut_ptr(),
            stre: self.stress.as_mut_ptr(),
            stiff: self.stiffness.as_mut_ptr(),
            iorien: &iorien,
            pgauss: zeros.as_ptr(),
            orab: orab.as_ptr(),
            pnewdt: &mut self.pnewdt,
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: the arrays have the sizes that CalculiX promises.
        unsafe { calculix::linear_elastic(&call) }
    }
}

#[test]
fn calculix_behaviour() {
    let path = path(7);
    let axes = Rotation3::from_euler_angles(0.4, -0.7, 1.1).into_inner();
    let orientation: [f64; 6] = std::array::from_fn(|k| axes[(k % 3, k / 3)]);
    for oriented in [false, true] {
        let mut global = OBLIQUE;
        if oriented {
            for at in [4, 7] {
                let turned = axes * Vector3::from_column_slice(&OBLIQUE[at..at + 3]);
                global[at..at + 3].copy_from_slice(turned.as_slice());
            }
        }
        let law = LinearElastic::new(&global).expect("valid properties");
        let mut point = Ccx::FRESH;
        for (f, truth) in path[1..].iter().zip(truth(&law, &path)) {
            point.call(&OBLIQUE, f, oriented.then_some(orientation));
            let cauchy = f * matrix(&order(point.stress)) * f.transpose() / f.determinant();
            assert_near(&components(&cauchy), &truth.stress, 1e-12, "stress");
            assert_near(&point.new[..S], &truth.state, 1e-12, "state");
            assert_eq!(point.new[S..], *f.as_slice());
            let material = order(symmetric_part(&truth.material).map(order));
            let by_columns: Vec<f64> = (0..6).flat_map(|j| (0..=j).map(move |i| material[i][j])).collect();
            assert_near(&point.stiffness, &by_columns, 1e-11, "stiff");
            assert_eq!(point.pnewdt, -1.0);
            point.old = point.new;
        }
    }
}

#[test]
fn calculix_points_that_fail() {
    let stretched = Matrix3::from_diagonal(&Vector3::new(1.05, 1.0, 1.0));
    let inverted = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
    let mut point = Ccx::FRESH;
    point.call(&ALONG_X, &stretched, None);
    assert_eq!(point.new[LINEAR_FAILED..=LINEAR_ALIVE], [1.0, 0.0]);
    point.old = point.new;
    point.call(&ALONG_X, &stretched, None);
    assert_eq!(point.stress, [0.0; 6]);
    let diagonal = [0, 2, 5, 9, 14, 20];
    for (k, &c) in point.stiffness.iter().enumerate() {
        assert_eq!(c, if diagonal.contains(&k) { 1e-6 * 0.5 * 79.414 } else { 0.0 });
    }
    let mut point = Ccx::FRESH;
    point.old[0] = 0.5;
    point.call(&ALONG_X, &inverted, None);
    assert_eq!((point.pnewdt, point.new[0], point.stress), (0.25, 0.5, [0.0; 6]));
    assert_eq!(point.new[S..], *Matrix3::identity().as_slice(), "F of the last step that was taken");
}
