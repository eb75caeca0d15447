//! Time, time step and temperature: each host passes what it has to a law that reads it, and a law is not evaluated
//! without what it reads.

use std::ffi::{CStr, c_char};
use std::ptr::null_mut;

use nalgebra::Matrix3;
use reinforced_solid::viscoelastic::ViscoelasticSolid;
use toron::host::abaqus::{self, ExplicitLaw, StandardLaw, Vumat};
use toron::host::calculix::{Behaviour, CalculixLaw};
use toron::host::lsdyna::{self, UmatVector, UserRoutines, UtanVector, When};
use toron::host::mgis::{BehaviourDataView, INTEGRATED, MESSAGE_CAPACITY, MgisLaw, StateView};
use toron::law::block::{Circumstances, Points, Strides, components, components_mut};
use toron::law::interface::Law;
use toron::law::status;
use toron::user::parameters::{Property, STRESS, positive, positive_or_zero};
use toron::user::state::{ALIVE, FAILED, StateVariable, variable};
use toron::user::vector::dot;
use toron::user::{Description, Reads, Real, Response, Step, User, UserMaterial};

type Viscoelastic<T> = User<ViscoelasticSolid, T>;

const MU: f64 = 3.0;
const LAMBDA: f64 = 7.0;
const MU_1: f64 = 11.0;
const TAU: f64 = 2.5;
const VALUES: [f64; 4] = [MU, LAMBDA, MU_1, TAU];
const STATE: usize = 14;
const STRETCHES: [f64; 3] = [1.3, 0.9, 1.05];
/// The length of the step in which the stretch comes, and of those in which it is held.
const SUDDEN: f64 = 0.01;
const HELD: f64 = 0.2;

/// F at the ends of the steps, and their lengths.
fn relaxation() -> (Matrix3<f64>, Vec<f64>) {
    let [a, b, c] = STRETCHES;
    (Matrix3::new(a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, c), [vec![SUDDEN], vec![HELD; 20]].concat())
}

/// σ_kk at a time after the stretch, whose step counts half.
fn exact(time: f64) -> [f64; 3] {
    let j: f64 = STRETCHES.iter().product();
    STRETCHES.map(|stretch| {
        let square = stretch * stretch;
        let branch = MU_1 * (square - 1.0) * (-(time + 0.5 * SUDDEN) / TAU).exp();
        (MU * (square - 1.0) + LAMBDA * j.ln() + branch) / j
    })
}

fn assert_exact(stress: [f64; 3], time: f64, host: &str) {
    for (x, y) in stress.into_iter().zip(exact(time)) {
        assert!((x - y).abs() <= 1e-14 * (MU + LAMBDA + MU_1), "{host} at {time}: {stress:?}, {:?}", exact(time));
    }
}

#[test]
fn the_stress_of_a_sudden_stretch_relaxes_in_a_umat() {
    let (f, steps) = relaxation();
    let (mut statev, mut time) = ([0.0; STATE], [0.0, 0.0]);
    for dtime in steps {
        let (mut stress, mut ddsdde, mut sse, mut pnewdt, mut temperature) = ([0.0; 6], [0.0; 36], 0.0, 1.0, 0.0);
        let (temp, dtemp) = (293.0, 0.0);
        let call = abaqus::Umat {
            stress: stress.as_mut_ptr(),
            statev: statev.as_mut_ptr(),
            ddsdde: ddsdde.as_mut_ptr(),
            sse: &mut sse,
            pnewdt: &mut pnewdt,
            dfgrd0: f.as_ptr(),
            dfgrd1: f.as_ptr(),
            props: VALUES.as_ptr(),
            nprops: 4,
            nstatv: STATE as i32,
            ndi: 3,
            nshr: 3,
            nlgeom: 1,
            // SAFETY: as many values as Abaqus passes.
            circumstances: unsafe { abaqus::circumstances(time.as_ptr(), &dtime, &temp, &dtemp, &mut temperature) },
        };
        // SAFETY: arrays as long as the call says.
        assert_eq!(unsafe { <Viscoelastic<f64> as StandardLaw>::umat(&call, null_mut(), 0) }, 0);
        time = time.map(|t| t + dtime);
        assert_exact([stress[0], stress[1], stress[2]], time[1] - SUDDEN, "UMAT");
        // The tangent against a step with another F from the same old state is a test of the law's, in `law/user`.
        assert!(ddsdde.iter().all(|x| x.is_finite()) && ddsdde[0] > MU);
    }
}

#[test]
fn the_stress_of_a_sudden_stretch_relaxes_in_a_vumat() {
    const N: usize = 5;
    let [a, b, c] = STRETCHES;
    let rows = |values: [f64; 6]| values.map(|x| [x; N]).concat();
    let (rest, stretched) = (rows([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]), rows([a, b, c, 0.0, 0.0, 0.0]));
    let (mut state, mut new, mut time) = (vec![0.0; STATE * N], vec![0.0; STATE * N], 0.0);
    let (density, zeros, energies) = ([1.0; N], vec![0.0; 6 * N], [0.0; N]);
    for (i, dt) in relaxation().1.into_iter().enumerate() {
        time += dt;
        let (mut stress, mut energy, mut lost) = (vec![0.0; 6 * N], [0.0; N], [0.0; N]);
        let block = Vumat {
            size: size_of::<Vumat<f64>>(),
            nblock: N as i32,
            ndir: 3,
            nshr: 3,
            nstatev: STATE as i32,
            nprops: 4,
            level: 0,
            step_time: time,
            total_time: time,
            props: VALUES.as_ptr(),
            density: density.as_ptr(),
            strain_inc: zeros.as_ptr(),
            stretch_old: if i == 0 { rest.as_ptr() } else { stretched.as_ptr() },
            stretch_new: stretched.as_ptr(),
            stress_old: zeros.as_ptr(),
            state_old: state.as_ptr(),
            ener_intern_old: energies.as_ptr(),
            ener_inelas_old: energies.as_ptr(),
            stress_new: stress.as_mut_ptr(),
            state_new: new.as_mut_ptr(),
            ener_intern_new: energy.as_mut_ptr(),
            ener_inelas_new: lost.as_mut_ptr(),
        };
        let circumstances = Circumstances { time_increment: dt, time, temperature: density.as_ptr() };
        // SAFETY: arrays as long as the block says.
        assert_eq!(unsafe { Viscoelastic::<f64>::vumat_at(&block, circumstances, null_mut(), 0) }, 0);
        for point in 0..N {
            assert_exact([stress[point], stress[N + point], stress[2 * N + point]], time - SUDDEN, "VUMAT");
        }
        std::mem::swap(&mut state, &mut new);
    }
}

#[test]
fn the_stress_of_a_sudden_stretch_relaxes_in_mgis() {
    let (f, steps) = relaxation();
    let gradient = [f.m11, f.m22, f.m33, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let (mut state, mut time) = ([0.0; STATE], 0.0);
    for dt in steps {
        time += dt;
        let (mut k, mut rdt, mut speed, mut text) = ([0.0; 3], 1.0, 0.0, [0; MESSAGE_CAPACITY]);
        let (mut new, mut stress, mut energies, density) = (state, [0.0; 6], [0.0; 2], 1.0);
        let s0 = StateView {
            gradients: gradient.as_ptr(),
            thermodynamic_forces: null_mut(),
            mass_density: &density,
            material_properties: VALUES.as_ptr(),
            internal_state_variables: state.as_mut_ptr(),
            stored_energy: &mut energies[0],
            dissipated_energy: &mut energies[1],
            external_state_variables: &density,
        };
        let s1 =
            StateView { thermodynamic_forces: stress.as_mut_ptr(), internal_state_variables: new.as_mut_ptr(), ..s0 };
        let error_message = text.as_mut_ptr();
        let mut view = BehaviourDataView {
            error_message,
            dt,
            k: k.as_mut_ptr(),
            rdt: &mut rdt,
            speed_of_sound: &mut speed,
            s0,
            s1,
        };
        // SAFETY: the arrays have the sizes of a law in three dimensions.
        assert_eq!(unsafe { Viscoelastic::<f64>::integrate(&mut view) }, INTEGRATED);
        state = new;
        assert_exact([stress[0], stress[1], stress[2]], time - SUDDEN, "MGIS");
    }
}

#[test]
fn the_stress_of_a_sudden_stretch_relaxes_in_calculix() {
    let (f, steps) = relaxation();
    let (strain, zeros, name) = ([1e3; 6], [0.0; 9], [b' ' as c_char; 80]);
    let (mut state, mut time) = ([0.0; STATE], 0.0);
    for dt in steps {
        time += dt;
        let (mut new, mut s, mut stiff, mut pnewdt) = ([0.0; STATE], [0.0; 6], [0.0; 21], -1.0);
        let call = Behaviour {
            amat: name.as_ptr(),
            iel: &1,
            iint: &1,
            kode: &-104,
            elconloc: VALUES.as_ptr(),
            emec: strain.as_ptr(),
            beta: zeros.as_ptr(),
            xkl: f.as_ptr(),
            mi: &1,
            nstate_: &(STATE as i32),
            xstateini: state.as_ptr(),
            xstate: new.as_mut_ptr(),
            stre: s.as_mut_ptr(),
            stiff: stiff.as_mut_ptr(),
            iorien: &0,
            pgauss: zeros.as_ptr(),
            orab: zeros.as_ptr(),
            pnewdt: &mut pnewdt,
            circumstances: Circumstances { time_increment: dt, time, temperature: zeros.as_ptr() },
        };
        // SAFETY: arrays as long as CalculiX's.
        unsafe { Viscoelastic::<f64>::behaviour(&call) };
        state = new;
        let j: f64 = STRETCHES.iter().product();
        let cauchy = [0, 1, 2].map(|k| s[k] * STRETCHES[k] * STRETCHES[k] / j);
        assert_exact(cauchy, time - SUDDEN, "CalculiX");
    }
}

/// An element of LS-DYNA, with F behind its history.
#[test]
fn the_stress_of_a_sudden_stretch_relaxes_in_ls_dyna() {
    let (f, steps) = relaxation();
    let (mut hsv, mut time) = ([0.0; STATE + 9], 0.0);
    hsv[STATE..].copy_from_slice(f.as_slice());
    for dt in steps {
        time += dt;
        let (mut sig, mut failel, mut es) = ([f64::NAN; 6], 7, [f64::NAN; 36]);
        let call = lsdyna::Umat {
            cm: VALUES.as_ptr(),
            sig: sig.as_mut_ptr(),
            hsv: hsv.as_mut_ptr(),
            nhv: STATE as i32,
            failel: &mut failel,
        };
        let when = When { time_increment: &raw const dt, ..When::UNKNOWN };
        // SAFETY: arrays as long as the call says.
        assert_eq!(unsafe { Viscoelastic::<f64>::umat_at(&call, &when, null_mut(), 0) }, 0);
        assert_eq!(failel, 0);
        assert_exact([sig[0], sig[1], sig[2]], time - SUDDEN, "LS-DYNA");
        let tangent = lsdyna::Utan { cm: VALUES.as_ptr(), hsv: hsv.as_ptr(), nhv: STATE as i32, es: es.as_mut_ptr() };
        // SAFETY: as above.
        unsafe {
            assert_eq!(Viscoelastic::<f64>::utan_at(&tangent, &when, null_mut(), 0), 0);
            assert!(es.iter().all(|x| x.is_finite()) && es[0] > MU);
            // Without its length the step is refused.
            assert_eq!(<Viscoelastic<f64> as UserRoutines<f64>>::umat(&call, null_mut(), 0), status::BAD_ARGUMENT);
            assert_eq!(Viscoelastic::<f64>::utan(&tangent, null_mut(), 0), status::BAD_ARGUMENT);
        }
    }
}

/// A law whose stress is made of what it reads: σ11 = time, σ22 = time increment, σ33 = k times the temperature.
#[derive(Clone, Copy, Debug, Default)]
struct Told;

static TOLD_PROPERTIES: [Property; 1] = [positive("k", "k", STRESS, None, "stress by temperature")];
static TOLD_STATE: [StateVariable; 3] = [variable("sum", "sum", STRESS, "all temperatures so far"), FAILED, ALIVE];

impl UserMaterial for Told {
    const DESCRIPTION: Description = Description {
        title: "law that tells what it reads",
        properties: &TOLD_PROPERTIES,
        state: &TOLD_STATE,
        directions: &[],
        energies: 0..0,
        failed: 1,
        alive: 2,
        reads: Reads { old_gradient: false, time_increment: true, time: true, temperature: true },
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 1];
    type State<R: Real> = [R; 1];
    type Constants<R: Real> = R;

    #[inline(always)]
    fn constants<R: Real>(&[k]: &[R; 1]) -> R {
        k
    }

    #[inline(always)]
    fn respond<R: Real>(k: &R, step: &Step<R, [R; 1]>) -> Response<R, [R; 1]> {
        let zero = R::splat(0.0);
        let stress = [step.time, step.time_increment, *k * step.temperature, zero, zero, zero];
        Response::new(stress, [step.state[0] + step.temperature])
    }
}

/// Evaluates `n` points at rest, each with its own temperature; those of a strided block are rows of nine numbers.
fn told(n: usize, in_rows: bool, tangent: bool) {
    let law = User::<Told, f64>::new(&[2.0]).expect("valid properties");
    let identity = Matrix3::<f64>::identity();
    let f: Vec<f64> = match in_rows {
        true => identity.as_slice().repeat(n),
        false => identity.iter().flat_map(|&x| vec![x; n]).collect(),
    };
    let temperature: Vec<f64> = (0..n).map(|i| 300.0 + i as f64).collect();
    let (mut state, mut stress, mut moduli) = (vec![1.0; 3 * n], vec![0.0; 6 * n], vec![0.0; 36 * n]);
    state[n..].fill(0.0);
    let mut points = Points {
        f_new: components(f.as_ptr(), if in_rows { 1 } else { n }),
        circumstances: Circumstances { time_increment: 0.25, time: 4.0, temperature: temperature.as_ptr() },
        state_old: User::<Told, f64>::parts(state.as_ptr(), n),
        state_new: User::<Told, f64>::parts_mut(state.as_mut_ptr(), n),
        stress: components_mut(stress.as_mut_ptr(), n),
        ..Points::without_arrays(n, n)
    };
    if in_rows {
        points.strides = Strides { deformation_gradient: 9, ..points.strides };
    }
    if tangent {
        points.tangent = moduli.as_mut_ptr();
    }
    // SAFETY: arrays of n points.
    assert_eq!(unsafe { law.step(&points) }, Ok(0));
    for i in 0..n {
        let told = [stress[i], stress[n + i], stress[2 * n + i], state[i]];
        assert_eq!(
            told,
            [4.0, 0.25, 2.0 * temperature[i], 1.0 + temperature[i]],
            "point {i} of {n}, in rows {in_rows}"
        );
    }
}

#[test]
fn every_point_has_its_own_temperature() {
    for n in [1, 2, 3, 5, 8, 17, 33, 70, 200] {
        for in_rows in [false, true] {
            told(n, in_rows, false);
            told(n, in_rows, true);
        }
    }
}

#[test]
fn a_law_is_not_evaluated_without_what_it_reads() {
    let law = User::<Told, f64>::new(&[2.0]).expect("valid properties");
    let (f, temperature, mut stress) = (Matrix3::<f64>::identity(), 300.0, [7.0; 6]);
    let known = Circumstances { time_increment: 0.25, time: 4.0, temperature: &raw const temperature };
    for (circumstances, message) in [
        (Circumstances { time_increment: f64::NAN, ..known }, "argument time_increment is not known here"),
        (Circumstances { time_increment: -1.0, ..known }, "argument time_increment is -1"),
        (Circumstances { time_increment: f64::INFINITY, ..known }, "argument time_increment is inf"),
        (Circumstances { time: f64::NAN, ..known }, "argument time is not known here"),
        (Circumstances { time: f64::NEG_INFINITY, ..known }, "argument time is -inf"),
        (Circumstances { temperature: std::ptr::null(), ..known }, "argument temperature is not known here"),
    ] {
        let points = Points {
            f_new: components(f.as_ptr(), 1),
            circumstances,
            stress: components_mut(stress.as_mut_ptr(), 1),
            ..Points::without_arrays(1, 1)
        };
        // SAFETY: arrays of one point.
        let error = unsafe { law.step(&points) }.expect_err(message);
        assert!(error.to_string().contains(message), "{error}");
        assert_eq!(stress, [7.0; 6]);
    }
}

/// A block of LS-DYNA, more elements than are evaluated at once, not from the first one on.
#[test]
fn ls_dyna_tells_each_element_its_temperature() {
    const NLQ: usize = 150;
    let (nhv, first, last) = (3, 4, 147);
    let mut hsvs = vec![0.0; (nhv + 9) * NLQ];
    for (c, x) in Matrix3::<f64>::identity().iter().enumerate() {
        hsvs[(nhv + c) * NLQ..][..NLQ].fill(*x);
    }
    let (mut sig, mut failels, mut dsave) = (vec![-7.0; 6 * NLQ], [7; NLQ], vec![0.0; 36 * NLQ]);
    let temps: Vec<f64> = (0..NLQ).map(|i| 300.0 + i as f64).collect();
    let (mut steps, tt, k, sigs) = ([0.25; NLQ], 4.0, 2.0, sig.as_mut_ptr());
    // Those of elements that are not evaluated do not count.
    (steps[first - 1], steps[last]) = (f64::NAN, 7.0);
    let call = UmatVector {
        cm: &raw const k,
        sig: std::array::from_fn(|c| sigs.wrapping_add(c * NLQ)),
        hsvs: hsvs.as_mut_ptr(),
        nhv: nhv as i32,
        lft: first as i32 + 1,
        llt: last as i32,
        nlq: NLQ as i32,
        failels: failels.as_mut_ptr(),
    };
    let (hsvs_, dsave_) = (hsvs.as_ptr(), dsave.as_mut_ptr());
    let UmatVector { cm, nhv, lft, llt, nlq, .. } = call;
    let tangents = UtanVector { cm, hsvs: hsvs_, nhv, lft, llt, nlq, dsave: dsave_ };
    let when = When { time_increment: steps.as_ptr(), time: &raw const tt, temperature: temps.as_ptr() };
    // SAFETY: arrays as long as the calls say.
    unsafe {
        assert_eq!(User::<Told, f64>::umat_vector_at(&call, &when, null_mut(), 0), 0);
        assert_eq!(User::<Told, f64>::utan_vector_at(&tangents, &when, null_mut(), 0), 0);
    }
    for i in 0..NLQ {
        let told = [0, 1, 2].map(|c| sig[c * NLQ + i]);
        let expected = if (first..last).contains(&i) { [4.0, 0.25, 2.0 * temps[i]] } else { [-7.0; 3] };
        assert_eq!(told, expected, "element {i}");
    }
    let other = [vec![0.25; 100], vec![0.125; 50]].concat();
    let when = When { time_increment: other.as_ptr(), ..when };
    let mut text = [0 as c_char; 300];
    // SAFETY: as above, and the message ends in a null.
    let (code, text) = unsafe {
        let code = User::<Told, f64>::umat_vector_at(&call, &when, text.as_mut_ptr(), text.len());
        (code, CStr::from_ptr(text.as_ptr()).to_string_lossy().into_owned())
    };
    assert_eq!(code, status::BAD_ARGUMENT);
    assert!(text.contains("dt1siz differs"), "{text}");
}

/// A law with a root in its stress, that of the first invariant less 3: 0 at rest, where its slope is infinite; or,
/// with a property of 0, a quotient of 0 and 0.
#[derive(Clone, Copy, Debug, Default)]
struct Rooted;

static ROOTED_PROPERTIES: [Property; 1] = [positive_or_zero("k", "k", STRESS, None, "stiffness")];
static ROOTED_STATE: [StateVariable; 2] = [FAILED, ALIVE];

impl UserMaterial for Rooted {
    const DESCRIPTION: Description = Description {
        title: "law that has no tangent at rest",
        properties: &ROOTED_PROPERTIES,
        state: &ROOTED_STATE,
        directions: &[],
        energies: 0..0,
        failed: 0,
        alive: 1,
        reads: Reads::NOTHING,
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 1];
    type State<R: Real> = [R; 0];
    type Constants<R: Real> = R;

    #[inline(always)]
    fn constants<R: Real>(&[k]: &[R; 1]) -> R {
        k
    }

    #[inline(always)]
    fn respond<R: Real>(k: &R, step: &Step<R, [R; 0]>) -> Response<R, [R; 0]> {
        let zero = R::splat(0.0);
        let [x, y, z] = step.f;
        let growth = dot(x, x) + dot(y, y) + dot(z, z) - R::splat(3.0);
        let quotient = growth / (growth + *k);
        Response::new([(*k * growth).sqrt() + quotient * zero, zero, zero, zero, zero, zero], [])
    }
}

/// The first increment of an implicit analysis, where F is 1.
#[test]
fn a_law_that_gives_no_numbers_at_rest_is_told_so() {
    let f = Matrix3::<f64>::identity();
    for (k, message) in [(0.0, "is there 0/0?"), (1.0, "is there the root of 0?")] {
        let (mut stress, mut ddsdde, mut statev) = ([0.0; 6], [0.0; 36], [0.0; 2]);
        let (mut sse, mut pnewdt, mut text) = (0.0, 1.0, [0 as c_char; 300]);
        let call = abaqus::Umat {
            stress: stress.as_mut_ptr(),
            statev: statev.as_mut_ptr(),
            ddsdde: ddsdde.as_mut_ptr(),
            sse: &mut sse,
            pnewdt: &mut pnewdt,
            dfgrd0: f.as_ptr(),
            dfgrd1: f.as_ptr(),
            props: &k,
            nprops: 1,
            nstatv: 2,
            ndi: 3,
            nshr: 3,
            nlgeom: 1,
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: arrays as long as the call says.
        let code = unsafe { <User<Rooted, f64> as StandardLaw>::umat(&call, text.as_mut_ptr(), text.len()) };
        // SAFETY: the message ends in a null.
        let text = unsafe { CStr::from_ptr(text.as_ptr()) }.to_string_lossy();
        assert_eq!(code, status::PROPERTY_OUT_OF_BOUNDS, "{text}");
        assert!(text.contains(message), "{text}");
    }
}
