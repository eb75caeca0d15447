//! The behaviours of MFront's generic interface as MGIS calls them, of the library's laws and of laws of one's own:
//! every stress and every tangent against the library's own entries and against differences of the stress, prediction
//! operators, the speed of sound, plane hypotheses.

use std::f64::consts::SQRT_2;
use std::ffi::c_char;
use std::ptr::null_mut;

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use toron::host::mgis::{BehaviourDataView, INTEGRATED, MESSAGE_CAPACITY, MgisLaw, NOT_INTEGRATED, StateView};
use toron::law::description::Description;
use toron::law::interface::{Law, Points};
use toron::law::stress::{first_piola_kirchhoff, matrix};
use toron::law::user::User;
use toron::state::{HYPERELASTIC_STATE, LINEAR_WORK};
use toron::user::parameters::{Property, STRESS, positive};
use toron::user::state::{ALIVE, ENERGY_DENSITY, FAILED, StateVariable, variable};
use toron::user::vector::{dot, transposed};
use toron::user::{Reads, Real, Response, UserMaterial};
use toron::{Criterion, Hyperelastic, LinearElastic, Measure, Request, Rotation};

use reinforced_solid::ReinforcedSolid;

/// Rows and columns of the components, of tensors and of symmetric ones; in the plane the first five and the first
/// four.
const TENSOR: [(usize, usize); 9] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)];
const SYMMETRIC: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

const CAUCHY: usize = 0;
const PK2: usize = 1;
const PK1: usize = 2;
/// dσ/dF, dS/dE, dP/dF, dτ/dΔF.
const KINDS: [usize; 4] = [0, 1, 2, 3];
const CONSISTENT: f64 = 4.0;

/// A compressible neo-Hookean solid, W = ½ μ (I1 − 3) − μ ln J + ½ μ (ln J)²: a law without a fibre.
#[derive(Clone, Copy, Debug, Default)]
struct NeoHooke;

static PROPERTIES: [Property; 1] = [positive("mu", "μ", STRESS, None, "shear modulus")];
static STATE: [StateVariable; 3] =
    [variable("energy", "W", ENERGY_DENSITY, "energy per reference volume"), FAILED, ALIVE];

impl UserMaterial for NeoHooke {
    const DESCRIPTION: Description = Description {
        title: "neo-Hookean solid",
        properties: &PROPERTIES,
        state: &STATE,
        directions: &[],
        failed: 1,
        alive: 2,
        energies: 0..1,
        reads: Reads::NOTHING,
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 1];
    type State<R: Real> = [R; 1];
    type Constants<R: Real> = R;

    #[inline(always)]
    fn constants<R: Real>(&[mu]: &[R; 1]) -> R {
        mu
    }

    #[inline(always)]
    fn respond<R: Real>(&mu: &R, step: &toron::user::Step<R, [R; 1]>) -> Response<R, [R; 1]> {
        let ([x, y, z], one, half) = (transposed(&step.f), R::splat(1.0), R::splat(0.5));
        let (over, logarithm) = (mu * step.jacobian.reciprocal(), step.jacobian.ln());
        let normal = |b: R| over * (b - one + logarithm);
        let (b_11, b_22, b_33) = (dot(x, x), dot(y, y), dot(z, z));
        let stress = [normal(b_11), normal(b_22), normal(b_33), over * dot(x, y), over * dot(y, z), over * dot(z, x)];
        let trace = (b_11 - one) + (b_22 - one) + (b_33 - one);
        let energy = mu * (half * trace - logarithm + half * logarithm * logarithm);
        Response::new(stress, [energy])
    }
}

/// The laws: those of the library, and two of one's own.
#[derive(Clone, Copy, Debug, PartialEq)]
enum LawOf {
    Hyperelastic,
    LinearElastic,
    Reinforced,
    NeoHooke,
}
use LawOf::{LinearElastic as Linear, NeoHooke as Isotropic, Reinforced};

const LAWS: [LawOf; 4] = [LawOf::Hyperelastic, Linear, Reinforced, Isotropic];

impl LawOf {
    fn description(self) -> Description {
        match self {
            LawOf::Hyperelastic => Hyperelastic::<f64>::DESCRIPTION,
            Linear => LinearElastic::<f64>::DESCRIPTION,
            Reinforced => ReinforcedSolid::DESCRIPTION,
            Isotropic => NeoHooke::DESCRIPTION,
        }
    }

    fn is_of_ones_own(self) -> bool {
        matches!(self, Reinforced | Isotropic)
    }

    /// Calls the function of a hypothesis.
    ///
    /// # Safety
    /// The arrays have the sizes that the symbols of the behaviour tell.
    unsafe fn integrate(self, plane: bool, view: &mut BehaviourDataView) -> i32 {
        unsafe fn call<L: MgisLaw>(plane: bool, view: &mut BehaviourDataView) -> i32 {
            // SAFETY: the caller's promise.
            unsafe { if plane { L::integrate_in_plane(view) } else { L::integrate(view) } }
        }
        // SAFETY: the caller's promise.
        unsafe {
            match self {
                LawOf::Hyperelastic => call::<Hyperelastic>(plane, view),
                Linear => call::<LinearElastic>(plane, view),
                Reinforced => call::<User<ReinforcedSolid, f64>>(plane, view),
                Isotropic => call::<User<NeoHooke, f64>>(plane, view),
            }
        }
    }
}

/// A law in a hypothesis, with its properties.
#[derive(Clone, Debug)]
struct Behaviour {
    law: LawOf,
    plane: bool,
    properties: Vec<f64>,
}

/// What a call answers; what it has not written is NaN.
#[derive(Debug, Default)]
struct Answer {
    result: i32,
    stress: Vec<f64>,
    state: Vec<f64>,
    k: Vec<f64>,
    energy: f64,
    speed: f64,
    rdt: f64,
    text: String,
}

impl Behaviour {
    /// A law without a fibre takes no notice of `fibre`.
    fn new(law: LawOf, plane: bool, fibre: [f64; 3]) -> Self {
        let properties = match law {
            LawOf::Hyperelastic => [&[82.341, 1.055, 2.2, 0.64974, 0.1, 0.0, 1.8, 0.3], &fibre[..]].concat(),
            Linear => [&[79.414, 0.794, 0.126, 0.0], &fibre[..], &[0.0; 3]].concat(),
            Reinforced => [&[0.8, 1.2, 18.0, 0.0], &fibre[..]].concat(),
            Isotropic => vec![0.8],
        };
        Behaviour { law, plane, properties }
    }

    /// The laws in three dimensions, and in the plane with the fibre along an axis, in the plane and normal to it.
    fn all() -> Vec<Behaviour> {
        let mut all = Vec::new();
        for law in LAWS {
            all.extend([[1.0, 0.0, 0.0], [0.3, -0.5, 0.8]].map(|fibre| Behaviour::new(law, false, fibre)));
            let in_plane = [[1.0, 0.0, 0.0], [0.6, -0.3, 0.0], [0.0, 0.0, 2.0]];
            all.extend(in_plane.map(|fibre| Behaviour::new(law, true, fibre)));
        }
        all
    }

    fn state_count(&self) -> usize {
        self.law.description().state.len()
    }

    fn fresh(&self) -> Vec<f64> {
        vec![0.0; self.state_count()]
    }

    fn tensor(&self) -> &'static [(usize, usize)] {
        &TENSOR[..if self.plane { 5 } else { 9 }]
    }

    fn symmetric(&self) -> &'static [(usize, usize)] {
        &SYMMETRIC[..if self.plane { 4 } else { 6 }]
    }

    /// Numbers of rows and columns of an operator.
    fn size(&self, kind: usize) -> (usize, usize) {
        let (t, s) = (self.tensor().len(), self.symmetric().len());
        [(s, t), (s, s), (t, t), (s, t)][kind]
    }

    fn components(&self, f: &Matrix3<f64>) -> Vec<f64> {
        self.tensor().iter().map(|&place| f[place]).collect()
    }

    /// A call in arrays of the exact sizes; a `None` is NaN in all components.
    fn call(
        &self,
        f: [Option<&Matrix3<f64>>; 2],
        state: &[f64],
        [request, measure, kind]: [f64; 3],
        densities: [f64; 2],
    ) -> Answer {
        let nan = |count: usize| vec![f64::NAN; count];
        let gradients = f.map(|f| f.map_or_else(|| nan(self.tensor().len()), |f| self.components(f)));
        let (rows, columns) = self.size(kind as usize);
        let count = if measure == PK1 as f64 { self.tensor().len() } else { self.symmetric().len() };
        let mut answer = Answer {
            stress: nan(count),
            state: nan(self.state_count()),
            k: nan(if request.rem_euclid(100.0) == 0.0 { 3 } else { rows * columns }),
            energy: f64::NAN,
            speed: f64::NAN,
            rdt: 1.0,
            ..Answer::default()
        };
        answer.k[..3].copy_from_slice(&[request, measure, kind]);
        let (mut old, mut unread, mut text) = (state.to_vec(), nan(9), vec![0x5a_u8; MESSAGE_CAPACITY]);
        let nothing = unread.as_mut_ptr();
        let s0 = StateView {
            gradients: gradients[0].as_ptr(),
            thermodynamic_forces: nothing,
            mass_density: &densities[0],
            material_properties: nothing,
            internal_state_variables: old.as_mut_ptr(),
            stored_energy: nothing,
            dissipated_energy: nothing,
            external_state_variables: nothing,
        };
        let s1 = StateView {
            gradients: gradients[1].as_ptr(),
            thermodynamic_forces: answer.stress.as_mut_ptr(),
            mass_density: &densities[1],
            material_properties: self.properties.as_ptr(),
            internal_state_variables: answer.state.as_mut_ptr(),
            stored_energy: &mut answer.energy,
            dissipated_energy: null_mut(),
            external_state_variables: nothing,
        };
        let mut view = BehaviourDataView {
            error_message: text.as_mut_ptr().cast::<c_char>(),
            dt: f64::NAN,
            k: answer.k.as_mut_ptr(),
            rdt: &mut answer.rdt,
            speed_of_sound: &mut answer.speed,
            s0,
            s1,
        };
        // SAFETY: the arrays have the sizes that the symbols of the behaviour tell.
        answer.result = unsafe { self.law.integrate(self.plane, &mut view) };
        let text = text.split(|&byte| byte == 0).next().expect("a text");
        answer.text = String::from_utf8_lossy(text).into_owned();
        answer
    }

    /// A step that must be integrated.
    fn step(
        &self,
        f0: &Matrix3<f64>,
        f1: &Matrix3<f64>,
        state: &[f64],
        measure: usize,
        operator: Option<usize>,
    ) -> Answer {
        let request = if operator.is_some() { CONSISTENT } else { 0.0 };
        let coded = [request, measure as f64, operator.unwrap_or(0) as f64];
        let answer = self.call([Some(f0), Some(f1)], state, coded, [f64::NAN; 2]);
        assert_eq!(answer.result, INTEGRATED, "{}", answer.text);
        answer
    }

    /// Deformations at both ends of a step, away from the kinks of the laws, and the state at its start.
    fn steps(&self) -> Vec<(Matrix3<f64>, Matrix3<f64>, Vec<f64>)> {
        let mut ends = vec![
            // In tension and compacted, sheared; slack and expanded.
            (
                Matrix3::new(1.01, 0.02, 0.01, -0.01, 0.98, 0.03, 0.02, 0.01, 0.97),
                Matrix3::new(1.03, -0.05, 0.02, 0.04, 0.9, 0.06, 0.01, -0.03, 0.85),
            ),
            (
                Matrix3::new(0.99, 0.01, 0.0, 0.02, 1.05, 0.01, -0.03, 0.02, 1.02),
                Matrix3::new(0.95, 0.07, -0.04, 0.1, 1.1, 0.05, -0.06, 0.04, 1.2),
            ),
        ];
        for (f0, f1) in &mut ends {
            for f in [f0, f1] {
                if self.plane {
                    [f.m13, f.m31, f.m23, f.m32] = [0.0; 4];
                }
            }
        }
        let history = |f0: &Matrix3<f64>| self.step(&Matrix3::identity(), f0, &self.fresh(), CAUCHY, None).state;
        ends.into_iter().map(|(f0, f1)| (f0, f1, history(&f0))).collect()
    }

    /// An operator by central differences of the stress that a step returns.
    fn differences(&self, f0: &Matrix3<f64>, f1: &Matrix3<f64>, state: &[f64], kind: usize) -> Vec<f64> {
        const H: f64 = 1e-5;
        let (rows, columns) = self.size(kind);
        let measure = [CAUCHY, PK2, PK1, CAUCHY][kind];
        let mut operator = vec![0.0; rows * columns];
        for column in 0..columns {
            let mut one = Matrix3::zeros();
            let direction = if kind == 1 {
                let (i, j) = SYMMETRIC[column];
                one[(i, j)] = if i == j { 1.0 } else { 1.0 / SQRT_2 };
                one[(j, i)] = one[(i, j)];
                f1.try_inverse().expect("an inverse").transpose() * one
            } else {
                one[TENSOR[column]] = 1.0;
                if kind == 3 { one * f0 } else { one }
            };
            let stress = |h: f64| {
                let f = f1 + direction * h;
                let factor = if kind == 3 { f.determinant() } else { 1.0 };
                self.step(f0, &f, state, measure, None).stress.into_iter().map(|s| factor * s).collect::<Vec<_>>()
            };
            // Of fourth order.
            let [far, near] = [2.0, 1.0].map(|n| (stress(n * H), stress(-n * H)));
            for row in 0..rows {
                let difference = 8.0 * (near.0[row] - near.1[row]) - (far.0[row] - far.1[row]);
                operator[row * columns + column] = difference / (12.0 * H);
            }
        }
        operator
    }
}

/// The largest difference of two arrays, relative to the largest value of the second.
fn deviation(found: &[f64], wanted: &[f64]) -> f64 {
    assert_eq!(found.len(), wanted.len());
    let largest = wanted.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    found.iter().zip(wanted).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs())) / largest
}

/// The components of a tensor of rows and columns `order`, the symmetric ones with their factors.
fn by_components(s: &Matrix3<f64>, order: &[(usize, usize)], symmetric: bool) -> Vec<f64> {
    order.iter().map(|&(i, j)| if symmetric && i != j { SQRT_2 * s[(i, j)] } else { s[(i, j)] }).collect()
}

#[test]
fn tangents_are_the_derivatives_of_the_stress() {
    let mut worst = 0.0_f64;
    for behaviour in Behaviour::all() {
        for (f0, f1, state) in behaviour.steps() {
            for kind in KINDS {
                let found = behaviour.step(&f0, &f1, &state, CAUCHY, Some(kind)).k;
                let error = deviation(&found, &behaviour.differences(&f0, &f1, &state, kind));
                worst = worst.max(error);
                assert!(error < 1e-8, "kind {kind}, {behaviour:?}: {error:e}");
            }
        }
    }
    println!("differences: {worst:.1e}");
}

/// A symmetric 6×6 tangent of the library, 11 22 33 12 23 31, in MFront's components.
fn material(rows: &[[f64; 6]; 6], order: &[(usize, usize)]) -> Vec<f64> {
    let place = |(i, j): (usize, usize)| [[0, 3, 5], [3, 1, 4], [5, 4, 2]][i][j];
    let factor = |(i, j): (usize, usize)| if i == j { 1.0 } else { SQRT_2 };
    order.iter().flat_map(|&a| order.iter().map(move |&b| factor(a) * factor(b) * rows[place(a)][place(b)])).collect()
}

/// dP/dF of the library, both by columns, in MFront's components.
fn nominal(entries: &[f64; 81], order: &[(usize, usize)]) -> Vec<f64> {
    let place = |(i, j): (usize, usize)| i + 3 * j;
    order.iter().flat_map(|&a| order.iter().map(move |&b| entries[place(a) + 9 * place(b)])).collect()
}

/// A law's own answer: stress, dS/dE by rows, dP/dF by columns, and the wave speed at a density of 1.
struct OwnAnswer {
    stress: [f64; 6],
    rows: [[f64; 6]; 6],
    nominal: [f64; 81],
    speed: f64,
}

fn answer_of<L: Law<f64>>(properties: &[f64], f0: &Matrix3<f64>, f1: &Matrix3<f64>, state: &[f64]) -> OwnAnswer {
    let law = L::new(properties).expect("valid properties");
    let (mut stress, mut new, mut speed) = ([0.0; 6], L::fresh(), 0.0);
    let (mut rows, mut entries) = ([[0.0; 6]; 6], [0.0; 81]);
    let components = |f: &Matrix3<f64>| std::array::from_fn(|c| f.as_ptr().wrapping_add(c));
    let point = Points {
        f_old: components(f0),
        f_new: components(f1),
        state_old: L::parts(state.as_ptr(), 1),
        state_new: L::parts_mut(new.as_mut().as_mut_ptr(), 1),
        stress: std::array::from_fn(|c| stress.as_mut_ptr().wrapping_add(c)),
        ..Points::without_arrays(1, 1)
    };
    let calls = [
        Points { measure: Measure::Material, tangent: rows.as_mut_ptr().cast(), ..point },
        Points { measure: Measure::Nominal, tangent: entries.as_mut_ptr(), ..point },
        Points { density: 1.0, wave_speed: &mut speed, ..point },
    ];
    for call in &calls {
        // SAFETY: the arrays have the sizes of one point.
        assert_eq!(unsafe { law.step(call) }.expect("arrays"), 0);
    }
    OwnAnswer { stress, rows, nominal: std::array::from_fn(|k| entries[9 * (k % 9) + k / 9]), speed }
}

#[test]
fn stresses_and_tangents_are_those_of_the_library() {
    for behaviour in Behaviour::all() {
        for (f0, f1, state) in behaviour.steps() {
            let (stress, rows, by_columns) = match behaviour.law {
                Linear => {
                    let law = LinearElastic::new(&behaviour.properties).expect("valid properties");
                    let (old, mut axes) = (state.as_slice().try_into().expect("a state"), Matrix3::identity());
                    let (frame, criterion) = (Rotation::Fibre, Criterion::LargestPrincipal);
                    let (point, tangent) = law.step_with_tangent(&f0, &f1, old, frame, criterion, &mut axes);
                    let rows = tangent.matrix(Measure::Material, &f1, &point.stress).expect("an inverse");
                    (point.stress, rows, tangent.nominal(&f1, &point.stress))
                }
                LawOf::Hyperelastic => {
                    let law = Hyperelastic::new(&behaviour.properties).expect("valid properties");
                    let old = state.as_slice().try_into().expect("a state");
                    let f: [[f64; 3]; 3] = f1.into();
                    let (point, moduli) = law.point_with_moduli(&f, None, old, Request::ALL, Measure::Material);
                    (point.stress, moduli.matrix(), law.point_with_nominal(&f, None, old, Request::ALL).1)
                }
                Reinforced | Isotropic => {
                    let properties = &behaviour.properties;
                    let OwnAnswer { stress, rows, nominal, .. } = match behaviour.law {
                        Reinforced => answer_of::<User<ReinforcedSolid, f64>>(properties, &f0, &f1, &state),
                        _ => answer_of::<User<NeoHooke, f64>>(properties, &f0, &f1, &state),
                    };
                    (stress, rows, nominal)
                }
            };
            let (symmetric, tensor) = (behaviour.symmetric(), behaviour.tensor());
            let p = first_piola_kirchhoff(&stress, &f1);
            let s = f1.try_inverse().expect("an inverse") * p;
            let wanted = [
                (CAUCHY, by_components(&matrix(&stress), symmetric, true)),
                (PK2, by_components(&s, symmetric, true)),
                (PK1, by_components(&p, tensor, false)),
            ];
            for (measure, wanted) in wanted {
                let found = behaviour.step(&f0, &f1, &state, measure, None).stress;
                assert!(deviation(&found, &wanted) < 1e-14, "measure {measure}: {found:?}, {wanted:?}");
            }
            for (kind, wanted) in [(1, material(&rows, symmetric)), (2, nominal(&by_columns, tensor))] {
                let found = behaviour.step(&f0, &f1, &state, CAUCHY, Some(kind)).k;
                assert!(deviation(&found, &wanted) < 1e-14, "kind {kind}: {found:?}, {wanted:?}");
            }
        }
    }
}

/// The stress is the same with every operator, and the elastic, secant, tangent and consistent operators are the same.
#[test]
fn requests_differ_in_the_operator_alone() {
    for behaviour in Behaviour::all() {
        for (f0, f1, state) in behaviour.steps() {
            let alone = behaviour.step(&f0, &f1, &state, CAUCHY, None);
            for kind in KINDS {
                let consistent = behaviour.step(&f0, &f1, &state, CAUCHY, Some(kind));
                assert!(deviation(&consistent.stress, &alone.stress) < 1e-14);
                assert!(deviation(&consistent.state, &alone.state) < 1e-12);
                for request in [1.0, 2.0, 3.0, 104.0] {
                    let coded = [request, 0.0, kind as f64];
                    let other = behaviour.call([Some(&f0), Some(&f1)], &state, coded, [f64::NAN, 3.0]);
                    assert_eq!(other.result, INTEGRATED, "{}", other.text);
                    assert!(deviation(&other.k, &consistent.k) < 1e-14, "{request}, kind {kind}");
                }
            }
        }
    }
}

/// A prediction operator is that of the state at the start of the step. Nothing else is written, and F at its end is
/// not read.
#[test]
fn prediction_operators() {
    for behaviour in Behaviour::all() {
        for (f0, _, state) in behaviour.steps() {
            for kind in KINDS {
                let wanted = behaviour.step(&f0, &f0, &state, CAUCHY, Some(kind)).k;
                for request in [-1.0, -2.0, -3.0, 97.0] {
                    let coded = [request, CAUCHY as f64, kind as f64];
                    let found = behaviour.call([Some(&f0), None], &state, coded, [3.0, f64::NAN]);
                    assert_eq!(found.result, INTEGRATED, "{}", found.text);
                    assert!(deviation(&found.k, &wanted) < 1e-14, "{request}, kind {kind}");
                    assert!(found.stress.iter().chain(&found.state).all(|x| x.is_nan()) && found.energy.is_nan());
                    assert_eq!(found.speed.is_nan(), request < 50.0);
                }
            }
        }
    }
}

#[test]
fn speed_of_sound_and_stored_energy() {
    const DENSITY: f64 = 1.3514;
    for behaviour in Behaviour::all() {
        for (f0, f1, state) in behaviour.steps() {
            let coded = [100.0, CAUCHY as f64, f64::NAN];
            let Behaviour { properties, law, .. } = &behaviour;
            // Without an operator its kind is not read: the size of K is that of kind 0.
            let answer = behaviour.call([Some(&f0), Some(&f1)], &state, coded, [f64::NAN, DENSITY]);
            assert_eq!(answer.result, INTEGRATED, "{}", answer.text);
            let at_rest = (properties[0] / DENSITY).sqrt();
            // A bound, which of the library's laws is not far off at these deformations.
            let ratio = answer.speed / at_rest;
            assert!(law.is_of_ones_own() || (1.0 - 1e-15..1.5).contains(&ratio), "{behaviour:?}: {ratio}");
            let energy = match law {
                Linear => answer.state[LINEAR_WORK],
                Reinforced | Isotropic => {
                    let speed = match law {
                        Reinforced => answer_of::<User<ReinforcedSolid, f64>>(properties, &f0, &f1, &state).speed,
                        _ => answer_of::<User<NeoHooke, f64>>(properties, &f0, &f1, &state).speed,
                    } / DENSITY.sqrt();
                    assert!((answer.speed - speed).abs() <= 1e-12 * speed, "{} {speed}", answer.speed);
                    answer.state[0]
                }
                LawOf::Hyperelastic => {
                    let law = Hyperelastic::new(properties).expect("valid properties");
                    let point = law.point(&f1, &[0.0; HYPERELASTIC_STATE], Request::ALL);
                    let speed = (point.wave_modulus / DENSITY).sqrt();
                    assert!((answer.speed - speed).abs() <= 1e-12 * speed, "{} {speed}", answer.speed);
                    point.state[..4].iter().sum()
                }
            };
            assert!((answer.energy - energy).abs() <= 1e-12 * energy.abs(), "{} {energy}", answer.energy);
        }
    }
}

/// In the plane a material axis that is neither in it nor normal to it is refused, and so is a second one.
#[test]
fn oblique_axes_are_refused_in_the_plane() {
    let rest = Matrix3::identity();
    let refused = |behaviour: &Behaviour| {
        let answer = behaviour.call([Some(&rest), Some(&rest)], &behaviour.fresh(), [0.0; 3], [f64::NAN; 2]);
        assert_eq!(answer.rdt, 1.0);
        (answer.result == NOT_INTEGRATED).then_some(answer.text)
    };
    for law in [LawOf::Hyperelastic, Linear, Reinforced] {
        for (fibre, oblique) in [
            (Vector3::new(1.0, 2.0, 0.0), false),
            (Vector3::new(0.0, 0.0, -1e-3), false),
            (Vector3::new(1.0, 0.0, 1e-12), false),
            (Vector3::new(1.0, 0.0, 1e-6), true),
            (Vector3::new(1e-6, 0.0, 1.0), true),
        ] {
            let text = refused(&Behaviour::new(law, true, fibre.into()));
            assert_eq!(text.is_some(), oblique, "{fibre}: {text:?}");
            assert!(text.is_none_or(|text| text.contains("(fibre direction) are ")));
            assert!(refused(&Behaviour::new(law, false, fibre.into())).is_none());
        }
    }
    for (second, oblique) in [([0.0, 0.0, 3.0], false), ([0.2, 1.0, 0.0], false), ([0.0, 1.0, 1.0], true)] {
        let mut behaviour = Behaviour::new(Linear, true, [1.0, 0.0, 0.0]);
        behaviour.properties[7..].copy_from_slice(&second);
        let text = refused(&behaviour);
        assert_eq!(text.is_some(), oblique, "{second:?}: {text:?}");
        assert!(text.is_none_or(|text| text.contains("(second axis) are 0.0, 1.0, 1.0; allowed: ")));
    }
}

/// A wrong property is refused by its name, as the law's own table has it, in every hypothesis; a point that has failed
/// carries nothing.
#[test]
fn properties_and_failure_of_a_law_of_ones_own() {
    let (rest, pulled) = (Matrix3::identity(), Matrix3::from_diagonal(&Vector3::new(1.05, 1.0, 1.0)));
    for plane in [false, true] {
        let mut behaviour = Behaviour::new(Reinforced, plane, [1.0, 0.0, 0.0]);
        for (index, value, message) in [
            (0, 0.0, "property 1 (mu, shear modulus of the solid) is 0.0; allowed: a number > 0, at most 1e25"),
            (2, -3.0, "property 3 (k, stiffness of the fibres) is -3.0; allowed: a number from 0 to 1e25"),
            (3, f64::NAN, "property 4 (stretch_lim, fibre stretch at failure, 0: no failure) is NaN"),
            (4, 0.0, "properties 5 to 7 (fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero"),
        ] {
            let mut wrong = behaviour.clone();
            wrong.properties[index] = value;
            let answer = wrong.call([Some(&rest), Some(&rest)], &wrong.fresh(), [0.0; 3], [f64::NAN; 2]);
            assert_eq!((answer.result, answer.rdt), (NOT_INTEGRATED, 1.0));
            assert!(answer.text.contains(message), "{}", answer.text);
            assert!(answer.stress.iter().chain(&answer.state).all(|x| x.is_nan()));
        }
        behaviour.properties[3] = 1.04;
        let failing = behaviour.step(&rest, &pulled, &behaviour.fresh(), CAUCHY, Some(0));
        assert!(failing.stress[0] > 1.0 && failing.k[0] > 1.0, "the step that fails carries");
        assert_eq!(failing.state[1..], [1.05, 1.0, 0.0]);
        for kind in KINDS {
            let failed = behaviour.step(&pulled, &rest, &failing.state, CAUCHY, Some(kind));
            assert!(failed.stress.iter().chain(&failed.k).all(|&x| x == 0.0));
            assert_eq!((failed.state, failed.energy), (failing.state.clone(), failing.energy));
        }
        // Inverted: nothing is written, and the time step must shrink.
        let inverted = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
        let answer = behaviour.call([Some(&rest), Some(&inverted)], &behaviour.fresh(), [4.0, 0.0, 0.0], [f64::NAN; 2]);
        assert_eq!((answer.result, answer.rdt), (NOT_INTEGRATED, 0.25));
        assert!(answer.text.contains("determinant <= 0") && answer.stress.iter().all(|x| x.is_nan()));
    }
}

/// The strength is a material property, which a code may give by point, as MGIS passes an array of them: each point
/// fails at its own, whatever others have, and one that changes counts from then on.
#[test]
fn strengths_by_point() {
    let (rest, pulled) = (Matrix3::identity(), Matrix3::from_diagonal(&Vector3::new(1.05, 1.0, 1.0)));
    for (law, place, strengths) in
        [(LawOf::Hyperelastic, 5, [0.04, 0.0, 0.06, 0.03]), (Linear, 3, [3.5, 0.0, 4.5, 2.0])]
    {
        let mut points: Vec<_> = [(); 4].map(|()| Behaviour::new(law, false, [1.0, 0.0, 0.0])).to_vec();
        points.iter_mut().zip(strengths).for_each(|(point, strength)| point.properties[place] = strength);
        let failed = law.description().failed;
        let mut states: Vec<_> = points.iter().map(Behaviour::fresh).collect();
        for (point, state) in points.iter().zip(&mut states) {
            *state = point.step(&rest, &pulled, state, CAUCHY, Some(0)).state;
        }
        assert_eq!(states.iter().map(|state| state[failed]).collect::<Vec<_>>(), [1.0, 0.0, 0.0, 1.0]);
        points[2].properties[place] = strengths[0];
        let later = points[2].step(&pulled, &pulled, &states[2], CAUCHY, Some(0));
        assert_eq!(later.state[failed], 1.0);
    }
}

/// Newton's method to a given uniaxial stress by dσ/dF, F without rotation: the stress that is missing is squared from
/// one iteration to the next.
#[test]
fn a_given_stress_is_found_quadratically() {
    /// The entries of F on and above the diagonal.
    const UNKNOWN: [usize; 6] = [0, 1, 2, 3, 5, 7];
    for (law, largest) in [(Reinforced, 4.0), (Isotropic, 0.8)] {
        let behaviour = Behaviour::new(law, false, [0.3, -0.5, 0.8]);
        let (rest, state) = (Matrix3::identity(), behaviour.fresh());
        let (mut f, mut residuals) = (rest, Vec::new());
        for _ in 0..12 {
            let answer = behaviour.step(&rest, &f, &state, CAUCHY, Some(0));
            let mut missing = Vector6::from_column_slice(&answer.stress);
            missing[0] -= largest;
            residuals.push(missing.norm() / largest);
            if residuals.last().is_some_and(|&r| r < 1e-13) {
                break;
            }
            let by_unknown = Matrix6::from_fn(|row, column| answer.k[9 * row + UNKNOWN[column]]);
            let change = by_unknown.lu().solve(&missing).expect("a regular tangent");
            for (place, change) in UNKNOWN.into_iter().zip(change.iter()) {
                f[TENSOR[place]] -= change;
            }
        }
        println!("{law:?}: {residuals:?}");
        assert!(residuals.last().is_some_and(|&r| r < 1e-13), "{law:?}: {residuals:?}");
        let near: Vec<_> = residuals.windows(2).filter(|pair| (1e-7..0.1).contains(&pair[0])).collect();
        assert!(near.len() >= 2, "{law:?}: {residuals:?}");
        for pair in near {
            assert!(pair[1] <= 20.0 * pair[0] * pair[0], "{law:?}: {residuals:?}");
        }
    }
}
