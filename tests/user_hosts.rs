//! Laws of one's own through every host but MGIS (`mgis.rs`), along a path in steps, against their own steps in Rust:
//! one without anything but a stress, one that reads F at the start of a step and stores no energy, one with a fibre of
//! each point, and one with two families of fibres.

use std::array;
use std::ffi::c_char;
use std::ptr::{null, null_mut};

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};
use toron::Measure;
use toron::host::abaqus::{self, ExplicitLaw, StandardLaw, Vumat};
use toron::host::calculix::{Behaviour, CalculixLaw};
use toron::host::listed::{self, ListedPoints, Named, PreparedOf};
use toron::host::lsdyna::{self, UmatVector, UserRoutines, UtanVector};
use toron::host::openradioss::{Group, Laws, Material, evaluate_material, read};
use toron::law::block::Circumstances;
use toron::law::interface::{Law, Points};
use toron::law::status;
use toron::law::stress::{components, matrix};
use toron::user::parameters::{NUMBER, Property, STRESS, component, positive};
use toron::user::state::{ALIVE, FAILED, StateVariable, variable};
use toron::user::vector::{dot, image, scale, transposed};
use toron::user::{Description, Direction, Reads, Real, Response, Step, User, UserMaterial};

use reinforced_solid::ReinforcedSolid;
use toron_test_support::block::levels;

/// A compressible neo-Hookean solid: σ = μ (b − 1)/J + μ ln J/J. No fibre, no state of its own, no energy, no failure.
#[derive(Clone, Copy, Debug, Default)]
struct Bare;

/// The same with a viscous stress, 2 η (E − E at the start) as a second Piola–Kirchhoff stress, and the sum of the
/// steps of tr E by their size; it fails where that reaches a limit.
#[derive(Clone, Copy, Debug, Default)]
struct Viscous;

/// A neo-Hookean solid with two families of fibres, k (I4 − 1) a⊗a/J each; the second one may be left out.
#[derive(Clone, Copy, Debug, Default)]
struct Families;

static FAMILIES: [Property; 8] = [
    positive("mu", "μ", STRESS, None, "shear modulus"),
    positive("k", "k", STRESS, None, "stiffness of the fibres"),
    component("m_1", "m1", 1.0, "first family, any length"),
    component("m_2", "m2", 0.0, "first family, any length"),
    component("m_3", "m3", 0.0, "first family, any length"),
    component("n_1", "n1", 0.0, "second family, any length"),
    component("n_2", "n2", 1.0, "second family, any length"),
    component("n_3", "n3", 0.0, "second family, any length"),
];

/// The bare solid, whose iteration is said not to converge beyond F11 = 1.2, and which wants a smaller step beyond 1.5.
#[derive(Clone, Copy, Debug, Default)]
struct Stubborn;

const REFUSAL: &str = "the iteration of the stubborn solid does not converge";

impl UserMaterial for Stubborn {
    const DESCRIPTION: Description = Description { refusal: Some(REFUSAL), ..Bare::DESCRIPTION };
    type Properties<R: Real> = [R; 1];
    type State<R: Real> = [R; 0];
    type Constants<R: Real> = R;

    #[inline(always)]
    fn constants<R: Real>(&[mu]: &[R; 1]) -> R {
        mu
    }

    #[inline(always)]
    fn respond<R: Real>(&mu: &R, step: &Step<R, [R; 0]>) -> Response<R, [R; 0]> {
        let beyond = |limit: f64, code: i32, else_: R| {
            R::select(R::splat(limit).lt(step.f[0][0]), R::splat(f64::from(code)), else_)
        };
        let status = beyond(1.2, status::LAW, R::splat(0.0));
        Response { status: beyond(1.5, status::SMALLER_STEP, status), ..Response::new(neo_hooke(mu, step), []) }
    }
}

static MODULUS: [Property; 1] = [positive("mu", "μ", STRESS, None, "shear modulus")];
static VISCOUS: [Property; 3] = [
    positive("mu", "μ", STRESS, None, "shear modulus"),
    positive("eta", "η", STRESS, None, "viscosity over the time of a step"),
    positive("way_lim", "s_lim", NUMBER, None, "way at failure"),
];
static FLAGS: [StateVariable; 2] = [FAILED, ALIVE];
static WAY: [StateVariable; 3] =
    [variable("way", "s", NUMBER, "sum of the steps of tr E by their size"), FAILED, ALIVE];

/// The Cauchy stress of the neo-Hookean solid.
#[inline(always)]
fn neo_hooke<R: Real, S>(mu: R, step: &Step<R, S>) -> [R; 6] {
    let ([x, y, z], one) = (transposed(&step.f), R::splat(1.0));
    let (over, volume) = (mu * step.jacobian.reciprocal(), step.log_jacobian() - one);
    let (xx, yy, zz) = (dot(x, x) + volume, dot(y, y) + volume, dot(z, z) + volume);
    [over * xx, over * yy, over * zz, over * dot(x, y), over * dot(y, z), over * dot(z, x)]
}

impl UserMaterial for Bare {
    const DESCRIPTION: Description = Description {
        title: "bare solid",
        properties: &MODULUS,
        state: &FLAGS,
        directions: &[],
        failed: 0,
        alive: 1,
        energies: 0..0,
        reads: Reads::NOTHING,
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 1];
    type State<R: Real> = [R; 0];
    type Constants<R: Real> = R;

    #[inline(always)]
    fn constants<R: Real>(&[mu]: &[R; 1]) -> R {
        mu
    }

    #[inline(always)]
    fn respond<R: Real>(&mu: &R, step: &Step<R, [R; 0]>) -> Response<R, [R; 0]> {
        Response::new(neo_hooke(mu, step), [])
    }
}

impl UserMaterial for Families {
    const DESCRIPTION: Description = Description {
        title: "two families",
        properties: &FAMILIES,
        state: &FLAGS,
        directions: &[Direction::fibre(2), Direction::new("second family", 5)],
        failed: 0,
        alive: 1,
        energies: 0..0,
        reads: Reads::NOTHING,
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 8];
    type State<R: Real> = [R; 0];
    type Constants<R: Real> = [R; 2];

    #[inline(always)]
    fn constants<R: Real>(&[mu, k, ..]: &[R; 8]) -> [R; 2] {
        [mu, k]
    }

    #[inline(always)]
    fn respond<R: Real>(&[mu, k]: &[R; 2], step: &Step<R, [R; 0]>) -> Response<R, [R; 0]> {
        let mut stress = neo_hooke(mu, step);
        let (one, over) = (R::splat(1.0), k * step.jacobian.reciprocal());
        for m in [step.fibre, step.other_directions[0]] {
            let a = image(&step.f, m);
            let [x, y, z] = scale(over * (dot(a, a) - one), a);
            let pairs = [x * a[0], y * a[1], z * a[2], x * a[1], y * a[2], z * a[0]];
            stress.iter_mut().zip(pairs).for_each(|(stress, of_fibres)| *stress += of_fibres);
        }
        Response::new(stress, [])
    }
}

impl UserMaterial for Viscous {
    const DESCRIPTION: Description = Description {
        title: "viscous solid",
        properties: &VISCOUS,
        state: &WAY,
        directions: &[],
        failed: 1,
        alive: 2,
        energies: 0..0,
        reads: Reads { old_gradient: true, ..Reads::NOTHING },
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 3];
    type State<R: Real> = [R; 1];
    type Constants<R: Real> = [R; 3];

    #[inline(always)]
    fn constants<R: Real>(properties: &[R; 3]) -> [R; 3] {
        *properties
    }

    #[inline(always)]
    fn respond<R: Real>(&[mu, eta, limit]: &[R; 3], step: &Step<R, [R; 1]>) -> Response<R, [R; 1]> {
        let (new, old) = (&step.f, &step.f_old);
        let rate = |i: usize, j: usize| eta * (dot(new[i], new[j]) - dot(old[i], old[j]));
        let (s_11, s_22, s_33) = (rate(0, 0), rate(1, 1), rate(2, 2));
        let (s_12, s_23, s_31) = (rate(0, 1), rate(1, 2), rate(2, 0));
        // F S Fᵀ/J, from the rows of F.
        let over = step.jacobian.reciprocal();
        let rows = transposed(new);
        let along = |[x, y, z]: [R; 3]| {
            [s_11 * x + s_12 * y + s_31 * z, s_12 * x + s_22 * y + s_23 * z, s_31 * x + s_23 * y + s_33 * z]
        };
        let (a, b, c) = (along(rows[0]), along(rows[1]), along(rows[2]));
        let elastic = neo_hooke(mu, step);
        let stress = [
            elastic[0] + over * dot(a, rows[0]),
            elastic[1] + over * dot(b, rows[1]),
            elastic[2] + over * dot(c, rows[2]),
            elastic[3] + over * dot(a, rows[1]),
            elastic[4] + over * dot(b, rows[2]),
            elastic[5] + over * dot(c, rows[0]),
        ];
        let way = step.state[0] + (s_11 + s_22 + s_33).abs() / eta;
        Response { failed: limit.le(way), ..Response::new(stress, [way]) }
    }
}

/// A law with its properties, which of them fails on the path, and its list for OpenRadioss.
trait Tried: UserMaterial {
    const VALUES: &'static [f64];
    /// The step, from 1, in which it fails; 0: in none.
    const FAILS: usize;
    const LAWS: Laws<f64> = Laws::new(&[Material::of::<User<Self, f64>>(7)], "7");
}

impl Tried for Bare {
    const VALUES: &'static [f64] = &[3.0];
    const FAILS: usize = 0;
}
impl Tried for Viscous {
    const VALUES: &'static [f64] = &[3.0, 2.0, 0.14];
    const FAILS: usize = 4;
}
impl Tried for Families {
    const VALUES: &'static [f64] = &[3.0, 40.0, 2.0, -1.0, 0.0, 1.0, 1.5, 0.0];
    const FAILS: usize = 0;
}
impl Tried for ReinforcedSolid {
    const VALUES: &'static [f64] = &[3.0, 17.0, 230.0, 1.022, 2.0, -1.0, 0.0];
    const FAILS: usize = 5;
}

/// What is called `NAME` in C.
#[derive(Clone, Copy)]
struct Listed<M>(std::marker::PhantomData<M>);

impl<M: UserMaterial> Named<f64> for Listed<M> {
    type Law = User<M, f64>;
    const PREPARED: &'static str = "law_f64";
    const PREPARE: &'static str = "law_prepare_f64";
    const POINTS: &'static str = "law_points_f64";
}

const STEPS: usize = 6;

/// F along the path: stretched and sheared; turned where the host passes F itself.
fn path(turns: bool) -> Vec<Matrix3<f64>> {
    let f = |step: usize| {
        let t = step as f64 / STEPS as f64;
        let stretch =
            Matrix3::new(1.0 + 0.15 * t, 0.1 * t, 0.0, 0.1 * t, 1.0 - 0.1 * t, 0.03 * t, 0.0, 0.03 * t, 1.0 + 0.05 * t);
        let turn = Rotation3::new(Vector3::new(0.6, 1.2, -0.3) * if turns { t } else { 0.0 });
        turn.into_inner() * stretch
    };
    (0..=STEPS).map(f).collect()
}

/// The reference density.
const DENSITY: f64 = 2.0;

/// A step in Rust: its stress, new state, tangent, bound of the wave speed and status.
#[derive(Clone, Debug)]
struct Truth {
    stress: [f64; 6],
    state: Vec<f64>,
    tangent: [[f64; 6]; 6],
    speed: f64,
    code: i32,
}

fn step<M: Tried>(f_old: &Matrix3<f64>, f: &Matrix3<f64>, state: &[f64], measure: Measure) -> Truth {
    let law = User::<M, f64>::new(M::VALUES).expect("properties that are right");
    let (mut stress, mut new, mut tangent, mut speed) = ([0.0; 6], vec![0.0; state.len()], [[0.0; 6]; 6], 0.0);
    let [old, now] = [f_old, f].map(|f| array::from_fn(|c| &raw const f.as_slice()[c]));
    let stress_ = stress.as_mut_ptr();
    let points = Points {
        f_old: old,
        f_new: now,
        state_old: User::<M, f64>::parts(state.as_ptr(), 1),
        state_new: User::<M, f64>::parts_mut(new.as_mut_ptr(), 1),
        stress: array::from_fn(|c| stress_.wrapping_add(c)),
        tangent: tangent.as_mut_ptr().cast(),
        density: DENSITY,
        wave_speed: &mut speed,
        measure,
        ..Points::without_arrays(1, 1)
    };
    // SAFETY: the arrays are those of one point.
    let code = unsafe { law.step(&points) }.expect("a point");
    Truth { stress, state: new, tangent, speed, code }
}

/// All steps of a path, each from what the one before has left.
fn truth<M: Tried>(path: &[Matrix3<f64>], measure: Measure) -> Vec<Truth> {
    let mut state = vec![0.0; M::DESCRIPTION.state.len()];
    let steps = path.windows(2).map(|pair| {
        let truth = step::<M>(&pair[0], &pair[1], &state, measure);
        state.clone_from(&truth.state);
        truth
    });
    let steps: Vec<_> = steps.collect();
    let failed = steps.iter().position(|truth| truth.state[M::DESCRIPTION.failed] == 1.0);
    assert_eq!(failed.map_or(0, |step| step + 1), M::FAILS, "{}: the step in which it fails", M::DESCRIPTION.title);
    steps
}

#[track_caller]
fn assert_near<M: Tried>(found: &[f64], wanted: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), wanted.len());
    let largest = wanted.iter().fold(1.0_f64, |largest, x| largest.max(x.abs()));
    for (i, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        let error = (found - wanted).abs();
        assert!(error <= tolerance * largest, "{}, {what}, {i}: {found}, not {wanted}", M::DESCRIPTION.title);
    }
}

/// 11 22 33 12 13 23.
fn exchanged([s11, s22, s33, s12, s23, s31]: [f64; 6]) -> [f64; 6] {
    [s11, s22, s33, s12, s31, s23]
}

fn energy<M: Tried>(state: &[f64]) -> f64 {
    state[M::DESCRIPTION.energies].iter().sum()
}

fn umat<M: Tried>() {
    let path = path(true);
    let rows = M::DESCRIPTION.state.len();
    let (mut statev, mut pnewdt) = (vec![0.0; rows + 1], 1.0);
    statev[rows] = 7.0;
    for (pair, truth) in path.windows(2).zip(truth::<M>(&path, Measure::Jaumann)) {
        let (mut stress, mut ddsdde, mut sse) = ([f64::NAN; 6], [f64::NAN; 36], f64::NAN);
        let call = abaqus::Umat {
            stress: stress.as_mut_ptr(),
            statev: statev.as_mut_ptr(),
            ddsdde: ddsdde.as_mut_ptr(),
            sse: &mut sse,
            pnewdt: &mut pnewdt,
            dfgrd0: if M::DESCRIPTION.reads.old_gradient { pair[0].as_ptr() } else { null() },
            dfgrd1: pair[1].as_ptr(),
            props: M::VALUES.as_ptr(),
            nprops: M::VALUES.len() as i32,
            nstatv: rows as i32 + 1,
            ndi: 3,
            nshr: 3,
            nlgeom: 1,
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        assert_eq!(unsafe { <User<M, f64> as StandardLaw>::umat(&call, null_mut(), 0) }, truth.code);
        let order = [0, 1, 2, 3, 5, 4];
        let tangent: Vec<f64> = order.into_iter().flat_map(|j| order.map(|i| truth.tangent[i][j])).collect();
        assert_near::<M>(&stress, &exchanged(truth.stress), 0.0, "STRESS");
        assert_near::<M>(&ddsdde, &tangent, 0.0, "DDSDDE");
        assert_near::<M>(&statev, &[&truth.state[..], &[7.0]].concat(), 0.0, "STATEV");
        assert_near::<M>(&[sse], &[energy::<M>(&truth.state) / pair[1].determinant()], 1e-15, "SSE");
        assert_eq!(pnewdt, 1.0);
    }
}

fn vumat<M: Tried>() {
    const N: usize = 70;
    let path = path(false);
    let rows = M::DESCRIPTION.state.len();
    let (mut state, mut energies, ones, zeros) = (vec![0.0; rows * N], vec![0.0; N], [1.0; N], [0.0; 6 * N]);
    for (pair, truth) in path.windows(2).zip(truth::<M>(&path, Measure::Jaumann)) {
        let stretches: [Vec<f64>; 2] = array::from_fn(|end| {
            let u = components(&pair[end]);
            u.into_iter().flat_map(|u| [u; N]).collect()
        });
        let (mut stress, mut new, mut internal) = (vec![f64::NAN; 6 * N], vec![f64::NAN; rows * N], vec![f64::NAN; N]);
        let mut inelastic = [f64::NAN; N];
        let block = Vumat {
            nblock: N as i32,
            ndir: 3,
            nshr: 3,
            nstatev: rows as i32,
            nprops: M::VALUES.len() as i32,
            step_time: 1.0,
            total_time: 1.0,
            props: M::VALUES.as_ptr(),
            density: ones.as_ptr(),
            strain_inc: zeros.as_ptr(),
            stretch_old: stretches[0].as_ptr(),
            stretch_new: stretches[1].as_ptr(),
            stress_old: zeros.as_ptr(),
            state_old: state.as_ptr(),
            ener_intern_old: energies.as_ptr(),
            ener_inelas_old: zeros.as_ptr(),
            stress_new: stress.as_mut_ptr(),
            state_new: new.as_mut_ptr(),
            ener_intern_new: internal.as_mut_ptr(),
            ener_inelas_new: inelastic.as_mut_ptr(),
            ..Vumat::empty()
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        assert_eq!(unsafe { <User<M, f64> as ExplicitLaw<f64>>::vumat(&block, null_mut(), 0) }, truth.code);
        let middle = (0.5 * (pair[0] + pair[1])).determinant();
        for point in [0, 63, 64, N - 1] {
            let of = |array: &[f64]| -> Vec<f64> { array.iter().skip(point).step_by(N).copied().collect() };
            assert_near::<M>(&of(&stress), &truth.stress, 1e-14, "stressNew");
            assert_near::<M>(&of(&new), &truth.state, 1e-14, "stateNew");
            assert_near::<M>(&[internal[point]], &[energy::<M>(&truth.state) / middle], 1e-14, "enerInternNew");
        }
        (state, energies) = (new, internal);
    }
}

fn ls_dyna<M: Tried>() {
    const NLQ: usize = 70;
    let path = path(true);
    let (nhv, f) = (M::DESCRIPTION.history() as i32, M::DESCRIPTION.history());
    let rows = M::DESCRIPTION.state.len();
    let (mut hsv, mut hsvs) = (vec![0.0; f + 9], vec![0.0; (f + 9) * NLQ]);
    for (pair, truth) in path.windows(2).zip(truth::<M>(&path, Measure::Truesdell)) {
        hsv[f..].copy_from_slice(pair[1].as_slice());
        for (c, &value) in pair[1].as_slice().iter().enumerate() {
            hsvs[(f + c) * NLQ..][..NLQ].fill(value);
        }
        // The tangent is that of a step from the state that is written, to the F that is kept.
        let next = step::<M>(&pair[1], &pair[1], &truth.state, Measure::Truesdell);
        let (cm, mut sig, mut failel) = (M::VALUES.as_ptr(), [f64::NAN; 6], 7);
        let (mut sigs, mut failels, mut es) = (vec![f64::NAN; 6 * NLQ], [7; NLQ], [f64::NAN; 36]);
        let (mut dsave, nlq, sigs_) = (vec![f64::NAN; 36 * NLQ], NLQ as i32, sigs.as_mut_ptr());
        let element = lsdyna::Umat { cm, sig: sig.as_mut_ptr(), hsv: hsv.as_mut_ptr(), nhv, failel: &mut failel };
        let elements = UmatVector {
            cm,
            sig: array::from_fn(|c| sigs_.wrapping_add(c * NLQ)),
            hsvs: hsvs.as_mut_ptr(),
            nhv,
            lft: 1,
            llt: nlq,
            nlq,
            failels: failels.as_mut_ptr(),
        };
        // SAFETY: the arrays have the sizes that the structures tell.
        unsafe {
            assert_eq!(<User<M, f64> as UserRoutines<f64>>::umat(&element, null_mut(), 0), truth.code);
            assert_eq!(User::<M, f64>::umat_vector(&elements, null_mut(), 0), truth.code);
        }
        let tangent = lsdyna::Utan { cm, hsv: hsv.as_ptr(), nhv, es: es.as_mut_ptr() };
        let (hsvs_, dsave_) = (hsvs.as_ptr(), dsave.as_mut_ptr());
        let tangents = UtanVector { cm, hsvs: hsvs_, nhv, lft: 1, llt: nlq, nlq, dsave: dsave_ };
        // SAFETY: as above.
        unsafe {
            assert_eq!(User::<M, f64>::utan(&tangent, null_mut(), 0), next.code);
            assert_eq!(User::<M, f64>::utan_vector(&tangents, null_mut(), 0), next.code);
        }
        let symmetric = Matrix6::from(next.tangent);
        let symmetric = 0.5 * (symmetric + symmetric.transpose());
        let failed = truth.state[M::DESCRIPTION.failed];
        for element in [0, 63, 64, NLQ - 1] {
            let of = |array: &[f64]| -> Vec<f64> { array.iter().skip(element).step_by(NLQ).copied().collect() };
            for (sig, history, es) in [(&sig[..], &hsv[..], &es[..]), (&of(&sigs), &of(&hsvs), &of(&dsave))] {
                assert_near::<M>(sig, &truth.stress, 1e-14, "sig");
                assert_near::<M>(&history[..rows], &truth.state, 1e-14, "hsv");
                assert_near::<M>(es, symmetric.as_slice(), 1e-13, "es");
                let kept = &history[rows..f];
                assert_near::<M>(kept, &pair[1].as_slice()[..kept.len()], 0.0, "F that is kept");
            }
            assert_eq!([failel, failels[element]].map(f64::from), [failed; 2]);
        }
    }
}

/// `oriented`: the directions are given in the axes of an `*ORIENTATION`.
fn calculix<M: Tried>(oriented: bool) {
    let path = path(true);
    let axes = Rotation3::new(Vector3::new(-0.4, 0.9, 2.0)).into_inner();
    let [a, b] = [axes.column(0), axes.column(1)];
    let orientation = [a[0], a[1], a[2], b[0], b[1], b[2], 1.0];
    let mut values = M::VALUES.to_vec();
    for direction in M::DESCRIPTION.directions.iter().filter(|_| oriented) {
        let local = axes.tr_mul(&Vector3::from(direction.of(M::VALUES)));
        values[direction.first..][..3].copy_from_slice(local.as_slice());
    }
    let rows = M::DESCRIPTION.history();
    let (mut old, mut new) = (vec![0.0; rows], vec![f64::NAN; rows]);
    for (pair, truth) in path.windows(2).zip(truth::<M>(&path, Measure::Material)) {
        let (name, kode, zeros) = ([b' ' as c_char; 80], -100 - M::VALUES.len() as i32, [0.0; 9]);
        let (one, number, count) = (1, i32::from(oriented), rows as i32);
        let f = pair[1];
        let strain = 0.5 * (f.tr_mul(&f) - Matrix3::identity());
        let strain = exchanged(components(&strain));
        let (mut stress, mut stiffness, mut pnewdt) = ([f64::NAN; 6], [f64::NAN; 21], 1.0);
        let call = Behaviour {
            amat: name.as_ptr(),
            iel: &one,
            iint: &one,
            kode: &kode,
            elconloc: values.as_ptr(),
            emec: strain.as_ptr(),
            beta: zeros.as_ptr(),
            xkl: f.as_ptr(),
            mi: &one,
            nstate_: &count,
            xstateini: old.as_ptr(),
            xstate: new.as_mut_ptr(),
            stre: stress.as_mut_ptr(),
            stiff: stiffness.as_mut_ptr(),
            iorien: &number,
            pgauss: zeros.as_ptr(),
            orab: orientation.as_ptr(),
            pnewdt: &mut pnewdt,
            circumstances: Circumstances::UNKNOWN,
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        unsafe { <User<M, f64> as CalculixLaw>::behaviour(&call) };
        let inverse = f.try_inverse().expect("a deformation");
        let second = inverse * matrix(&truth.stress) * inverse.transpose() * f.determinant();
        // Turned directions are off by roundings, which the stiffness of the fibres multiplies.
        let turned = if oriented { 1e-13 } else { 1e-14 };
        assert_near::<M>(&stress, &exchanged(components(&second)), turned, "stre");
        let order = [0, 1, 2, 3, 5, 4];
        let half = |i: usize, j: usize| 0.5 * (truth.tangent[order[i]][order[j]] + truth.tangent[order[j]][order[i]]);
        let upper: Vec<f64> = (0..6).flat_map(|j| (0..=j).map(move |i| half(i, j))).collect();
        // A point that has failed keeps a millionth of a stiffness.
        let tolerance = if truth.tangent == [[0.0; 6]; 6] { 1e-3 } else { 10.0 * turned };
        assert_near::<M>(&stiffness, &upper, tolerance, "stiff");
        let state = M::DESCRIPTION.state.len();
        assert_near::<M>(&new[..state], &truth.state, turned, "xstate");
        assert_near::<M>(&new[state..], &f.as_slice()[..rows - state], 0.0, "F that is kept");
        assert_eq!(pnewdt, 1.0);
        old.clone_from(&new);
    }
}

fn openradioss<M: Tried>() {
    const N: usize = 5;
    let path = path(true);
    let layout = M::LAWS.materials[0].layout;
    let mut uparam = vec![0.0; layout.parameters()];
    let material = read(&M::LAWS, 7, M::VALUES, &mut uparam).expect("a card that is right");
    assert_eq!(material.parameters, uparam.len());
    let modulus = User::<M, f64>::new(M::VALUES).expect("properties that are right").bulk_and_shear();
    assert_near::<M>(&[material.modulus], &[modulus[0] + 4.0 / 3.0 * modulus[1]], 1e-15, "PARMAT");
    let (mut uvar, mut off) = (vec![0.0; layout.variables() * N], [1.0; N]);
    for (step, (pair, truth)) in path.windows(2).zip(truth::<M>(&path, Measure::Truesdell)).enumerate() {
        let f = pair[1];
        let gradients: Vec<f64> = f.as_slice().iter().flat_map(|&f| [f; N]).collect();
        let column = |i: usize, j: usize| gradients.as_ptr().wrapping_add((3 * j + i) * N);
        let (mut stress, mut speed) = (vec![f64::NAN; 6 * N], [f64::NAN; N]);
        let stress_ = stress.as_mut_ptr();
        let group = Group {
            elements: N as i32,
            parameters: uparam.len() as i32,
            variables: layout.variables() as i32,
            time: step as f64,
            time_step: 1.0,
            uparam: uparam.as_ptr(),
            numbers: null(),
            density: &DENSITY,
            deformation_gradient: [
                column(0, 0),
                column(1, 1),
                column(2, 2),
                column(0, 1),
                column(1, 2),
                column(2, 0),
                column(1, 0),
                column(2, 1),
                column(0, 2),
            ],
            stress: array::from_fn(|c| stress_.wrapping_add(c * N)),
            viscous: [null_mut(); 6],
            sound_speed: speed.as_mut_ptr(),
            viscosity: null_mut(),
            uvar: uvar.as_mut_ptr(),
            off: off.as_mut_ptr(),
            nodes: null(),
            volume: null(),
        };
        // SAFETY: the arrays have the sizes that the structure tells.
        unsafe { evaluate_material(&M::LAWS, &group) }.expect("a group that is right");
        for element in [0, N - 1] {
            let of = |array: &[f64]| -> Vec<f64> { array.iter().skip(element).step_by(N).copied().collect() };
            let variables = of(&uvar);
            assert_near::<M>(&of(&stress), &truth.stress, 1e-14, "SIGN");
            assert_near::<M>(&variables[..truth.state.len()], &truth.state, 1e-14, "UVAR");
            assert_near::<M>(&[off[element]], &[1.0 - truth.state[M::DESCRIPTION.failed]], 0.0, "OFF");
            let kept = &variables[layout.f_old()..layout.limit()];
            assert_near::<M>(kept, &f.as_slice()[..kept.len()], 0.0, "F that is kept");
            assert!(truth.speed > 0.0, "a speed");
            assert_near::<M>(&[speed[element]], &[truth.speed], 1e-14, "SOUNDSP");
        }
        if truth.state[M::DESCRIPTION.failed] == 1.0 {
            break; // from then on the solver passes no deformation
        }
    }
}

fn c_block<M: Tried>() {
    const N: usize = 9;
    let path = path(true);
    let rows = M::DESCRIPTION.state.len();
    // SAFETY: numbers, which may be 0.
    let mut law: PreparedOf<Listed<M>, f64> = unsafe { std::mem::zeroed() };
    let (values, count) = (M::VALUES.as_ptr(), M::VALUES.len());
    // SAFETY: the arrays have the sizes that are passed with them.
    let code = unsafe { listed::prepare::<Listed<M>, f64>(&mut law, size_of_val(&law), values, count, null_mut(), 0) };
    assert_eq!(code, status::OK);
    let (mut state, ones) = (vec![0.0; rows * N], vec![1.0; 3 * N]);
    for (pair, truth) in path.windows(2).zip(truth::<M>(&path, Measure::Material)) {
        let by_component = |f: &Matrix3<f64>| -> Vec<f64> { f.as_slice().iter().flat_map(|&f| [f; N]).collect() };
        let (old, new) = (by_component(&pair[0]), by_component(&pair[1]));
        let (mut stress, mut codes, mut active) = (vec![f64::NAN; 6 * N], [7; N], [f64::NAN; N]);
        // SAFETY: numbers and pointers, which may be 0.
        let mut points: ListedPoints<Listed<M>, f64> = unsafe { std::mem::zeroed() };
        points.size = size_of_val(&points);
        points.n = N;
        points.f_new[0] = new.as_ptr();
        if M::DESCRIPTION.reads.old_gradient {
            points.f_old[0] = old.as_ptr();
        }
        (points.state_old, points.state_new) = (state.as_ptr(), state.as_mut_ptr());
        points.stress[0] = stress.as_mut_ptr();
        (points.status, points.active) = (codes.as_mut_ptr(), active.as_mut_ptr());
        // SAFETY: the arrays have the sizes that the header asks for.
        let code = unsafe { listed::block::<Listed<M>, f64>(&law, &points, null_mut(), 0) };
        assert_eq!(code, truth.code);
        for point in [0, N - 1] {
            let of = |array: &[f64]| -> Vec<f64> { array.iter().skip(point).step_by(N).copied().collect() };
            assert_near::<M>(&of(&stress), &truth.stress, 1e-14, "stress");
            assert_near::<M>(&of(&state), &truth.state, 1e-14, "state");
            assert_eq!(active[point], 1.0 - truth.state[M::DESCRIPTION.failed]);
        }
        // What the law has not is refused, not ignored.
        if !M::DESCRIPTION.has_fibre() {
            points.fibre[0] = ones.as_ptr();
            // SAFETY: as above.
            let code = unsafe { listed::block::<Listed<M>, f64>(&law, &points, null_mut(), 0) };
            assert_eq!(code, status::BAD_ARGUMENT);
        }
        if M::DESCRIPTION.reads.old_gradient {
            (points.fibre[0], points.f_old[0]) = (null(), null());
            // SAFETY: as above.
            let code = unsafe { listed::block::<Listed<M>, f64>(&law, &points, null_mut(), 0) };
            assert_eq!(code, status::NULL_ARGUMENT);
        }
    }
}

macro_rules! tests {
    ($($name:ident: $law:ty;)+) => {$(
        mod $name {
            use super::*;

            #[test]
            fn in_abaqus_standard() {
                umat::<$law>();
            }

            #[test]
            fn in_abaqus_explicit() {
                vumat::<$law>();
            }

            #[test]
            fn in_ls_dyna() {
                ls_dyna::<$law>();
            }

            #[test]
            fn in_calculix() {
                calculix::<$law>(false);
            }

            #[test]
            fn in_calculix_with_an_orientation() {
                calculix::<$law>(true);
            }

            #[test]
            fn in_openradioss() {
                openradioss::<$law>();
            }

            #[test]
            fn in_c() {
                c_block::<$law>();
            }
        }
    )+};
}

tests! {
    bare: Bare;
    viscous: Viscous;
    reinforced: ReinforcedSolid;
    families: Families;
}

/// A direction of length zero, and one that a plane element does not allow, is refused by the name that the law gives
/// it.
#[test]
fn every_direction_is_checked() {
    let with = |second: [f64; 3]| [&Families::VALUES[..5], &second].concat();
    let error = User::<Families, f64>::new(&with([0.0; 3])).expect_err("no direction");
    assert_eq!(error.to_string(), "properties 6 to 8 (second family) are 0.0, 0.0, 0.0; allowed: any vector but zero");
    assert_eq!(error.code(), status::PROPERTY_DIRECTION);
    let (mut statev, mut stress, mut sse, mut pnewdt) = ([0.0; 2], [0.0; 4], 0.0, 1.0);
    let (f, props) = (Matrix3::<f64>::identity(), with([1.0, 0.0, 1.0]));
    let mut message = [0_u8; 512];
    let call = abaqus::Umat {
        stress: stress.as_mut_ptr(),
        statev: statev.as_mut_ptr(),
        ddsdde: null_mut(),
        sse: &mut sse,
        pnewdt: &mut pnewdt,
        dfgrd0: null(),
        dfgrd1: f.as_ptr(),
        props: props.as_ptr(),
        nprops: 8,
        nstatv: 2,
        ndi: 3,
        nshr: 1,
        nlgeom: 1,
        circumstances: Circumstances::UNKNOWN,
    };
    // SAFETY: the arrays have the sizes that the structure tells, the message its capacity.
    let code = unsafe { <User<Families, f64> as StandardLaw>::umat(&call, message.as_mut_ptr().cast(), 512) };
    let text = std::ffi::CStr::from_bytes_until_nul(&message).expect("a text").to_str().expect("a text");
    assert_eq!(code, status::FIBRE_OUT_OF_PLANE);
    assert!(text.starts_with("properties 6 to 8 (second family) are 1.0, 0.0, 1.0; allowed: a direction in"), "{text}");
}

/// A law's own refusal: by point and as the worst of a block, with and without tangents.
#[test]
fn a_law_may_refuse_a_point() {
    let law = User::<Stubborn, f64>::new(&[2.0]).expect("a property that is right");
    let stretches: Vec<f64> = (0..41).map(|i| 1.0 + 0.02 * f64::from(i)).collect();
    let n = stretches.len();
    let f: Vec<f64> =
        (0..9).flat_map(|c| stretches.iter().map(move |&x| if c == 0 { x } else { f64::from(c % 4 == 0) })).collect();
    for (tangents, level) in [false, true].into_iter().flat_map(|t| levels().map(move |level| (t, level))) {
        let (mut stress, mut codes, mut active, mut tangent) =
            (vec![f64::NAN; 6 * n], vec![1; n], vec![7.0; n], vec![f64::NAN; 36 * n]);
        let stress_ = stress.as_mut_ptr();
        let points = Points {
            f_new: array::from_fn(|c| f[c * n..].as_ptr()),
            stress: array::from_fn(|c| stress_.wrapping_add(c * n)),
            status: codes.as_mut_ptr(),
            active: active.as_mut_ptr(),
            tangent: if tangents { tangent.as_mut_ptr() } else { null_mut() },
            level: Some(level),
            ..Points::without_arrays(n, n)
        };
        // SAFETY: the arrays are those of n points.
        let worst = unsafe { law.step(&points) }.expect("points that are right");
        assert_eq!(worst, status::SMALLER_STEP);
        for (i, &stretch) in stretches.iter().enumerate() {
            let wanted = match stretch {
                ..=1.2 => status::OK,
                ..=1.5 => status::LAW,
                _ => status::SMALLER_STEP,
            };
            assert_eq!(codes[i], wanted, "{stretch}");
            assert_eq!(active[i], f64::from(wanted == status::OK), "{stretch}");
            assert!(wanted == status::OK || (0..6).all(|c| stress[c * n + i] == 0.0), "{stretch}");
            assert!(!tangents || (0..36).all(|c| (tangent[c * n + i] == 0.0) >= (wanted != status::OK)), "{stretch}");
        }
    }
}

/// In hosts the law's own words are the message; PNEWDT asks for a smaller step.
#[test]
fn messages_of_a_refusal_are_the_law_s() {
    let (mut message, mu) = ([0_u8; 512], 2.0);
    let text = |message: &[u8]| {
        std::ffi::CStr::from_bytes_until_nul(message).expect("a text").to_str().expect("a text").to_string()
    };
    let f = Matrix3::from_diagonal(&[1.3, 1.0, 1.0].into());
    let (mut statev, mut stress, mut sse, mut pnewdt) = ([0.0; 2], [0.0; 6], 0.0, 1.0);
    let call = abaqus::Umat {
        stress: stress.as_mut_ptr(),
        statev: statev.as_mut_ptr(),
        ddsdde: null_mut(),
        sse: &mut sse,
        pnewdt: &mut pnewdt,
        dfgrd0: null(),
        dfgrd1: f.as_ptr(),
        props: &mu,
        nprops: 1,
        nstatv: 2,
        ndi: 3,
        nshr: 3,
        nlgeom: 1,
        circumstances: Circumstances::UNKNOWN,
    };
    // SAFETY: the arrays have the sizes that the structure tells, the message its capacity.
    let code = unsafe { <User<Stubborn, f64> as StandardLaw>::umat(&call, message.as_mut_ptr().cast(), 512) };
    assert_eq!((code, text(&message).as_str(), pnewdt), (status::LAW, REFUSAL, 0.25));

    // SAFETY: numbers, which may be 0.
    let mut law: PreparedOf<Listed<Stubborn>, f64> = unsafe { std::mem::zeroed() };
    let size = size_of_val(&law);
    // SAFETY: one property, and a law of its size.
    assert_eq!(unsafe { listed::prepare::<Listed<Stubborn>, f64>(&mut law, size, &mu, 1, null_mut(), 0) }, status::OK);
    let (two, mut codes) = ([1.0, 1.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0], [7; 2]);
    let zero = &raw const two[2];
    // SAFETY: numbers and pointers, which may be 0.
    let mut points: ListedPoints<Listed<Stubborn>, f64> = unsafe { std::mem::zeroed() };
    points.size = size_of_val(&points);
    points.n = 2;
    points.f_new = array::from_fn(|c| {
        if c == 0 {
            two.as_ptr()
        } else if c % 4 == 0 {
            &raw const two[8]
        } else {
            zero
        }
    });
    points.status = codes.as_mut_ptr();
    // SAFETY: each component has two values.
    let code = unsafe { listed::block::<Listed<Stubborn>, f64>(&law, &points, message.as_mut_ptr().cast(), 512) };
    assert_eq!((code, codes), (status::LAW, [status::OK, status::LAW]));
    assert_eq!(text(&message), format!("point 1, counted from 0: {REFUSAL}"));
}
