//! What holds of the laws, through the entries of every host: a table of properties and hosts. A property that a host
//! cannot have, as a rotation of a VUMAT's stretches, is left out where the table says so.

use nalgebra::{Matrix3, Rotation3, SMatrix, SVector, Unit, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseError, TestRunner};
use toron_fuzz::points::{Case, Entry, Host, Input, LAWS, Law, Old, call, with};
use toron_test_support::deformations::{Ranges, Sample, deformation, rotation};

/// How points are evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Via {
    Point,
    Block,
    Of(Host),
}

const VIAS: [Via; 8] = [
    Via::Point,
    Via::Block,
    Via::Of(Host::Umat),
    Via::Of(Host::Vumat),
    Via::Of(Host::LsDyna),
    Via::Of(Host::OpenRadioss),
    Via::Of(Host::CalculiX),
    Via::Of(Host::Mgis),
];

/// Which derivative of the stress a tangent is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Measure {
    Material,
    Truesdell,
    Jaumann,
}

impl Via {
    fn host(self) -> Host {
        if let Via::Of(host) = self { host } else { Host::None }
    }

    fn has_blocks(self) -> bool {
        self == Via::Block || self.host().has_blocks()
    }

    /// It passes stretches, and has the stress in axes that turn with the body.
    fn has_stretches(self) -> bool {
        self == Via::Of(Host::Vumat)
    }

    /// That of its tangents; `None` if it has none.
    fn measure(self) -> Option<Measure> {
        match self {
            Via::Point | Via::Block | Via::Of(Host::Umat) => Some(Measure::Jaumann),
            Via::Of(Host::CalculiX | Host::Mgis) => Some(Measure::Material),
            Via::Of(Host::LsDyna) => Some(Measure::Truesdell),
            Via::Of(_) => None,
        }
    }

    /// Whether its tangents are the symmetric parts of the derivatives.
    fn has_symmetric_parts(self) -> bool {
        matches!(self, Via::Of(Host::CalculiX | Host::LsDyna))
    }
}

/// A material and its points; the first one's fibre is that of the material.
#[derive(Clone, Debug)]
struct Model {
    law: Law,
    /// Without the directions.
    values: Vec<f64>,
    /// Of the law with friction: the coefficient and the cohesion.
    friction: [f64; 2],
    m: Vector3<f64>,
    second: Vector3<f64>,
    /// F at the start of the step, and at its end.
    old: Matrix3<f64>,
    f: Vec<Matrix3<f64>>,
}

/// The answer at a point: Cauchy stress, state variables, tangent by rows with engineering shears.
#[derive(Clone, Debug, PartialEq)]
struct Answer {
    stress: Matrix3<f64>,
    state: Vec<f64>,
    tangent: Vec<f64>,
}

fn by_columns(f: &Matrix3<f64>) -> [f64; 9] {
    f.as_slice().try_into().expect("nine")
}

/// The right stretch of F.
fn stretch(f: &Matrix3<f64>) -> Matrix3<f64> {
    let eigen = (f.transpose() * f).symmetric_eigen();
    let roots = Matrix3::from_diagonal(&eigen.eigenvalues.map(f64::sqrt));
    eigen.eigenvectors * roots * eigen.eigenvectors.transpose()
}

impl Model {
    fn properties(&self) -> Vec<f64> {
        let m = self.m.as_slice();
        match self.law {
            Law::Hyperelastic => [&self.values, m].concat(),
            Law::Frictional => [&self.values, m, &self.friction].concat(),
            Law::Linear => [&self.values, m, self.second.as_slice()].concat(),
        }
    }

    /// The same points, as this host has them.
    fn seen(&self, via: Via) -> Model {
        let seen = |f: &Matrix3<f64>| if via.has_stretches() { stretch(f) } else { *f };
        Model { f: self.f.iter().map(seen).collect(), old: seen(&self.old), ..self.clone() }
    }

    fn with_points(&self, f: Vec<Matrix3<f64>>) -> Model {
        Model { f, ..self.clone() }
    }

    fn case(&self, via: Via) -> Case {
        let host = via.host();
        // Of a point that lives: LS-DYNA takes zeros for one before its first step, from rest.
        let (mut state, old) = (vec![0.0; self.law.state()], by_columns(&self.old));
        state[self.law.failed() + 1] = 1.0;
        let point = |f: &Matrix3<f64>| Input {
            f: by_columns(f),
            f_old: old,
            fibre: self.m.into(),
            second_axis: self.second.into(),
            limit: 0.0,
            axes: [0.0; 9],
            state: state.clone(),
        };
        let has_tangent = via.measure().is_some_and(|measure| measure != Measure::Truesdell);
        Case {
            law: self.law,
            single: false,
            host,
            old: if host.is_in_place() { Old::InPlace } else { Old::Apart },
            with: with::STRESS | with::STATE | with::STATUS | if has_tangent { with::TANGENT } else { 0 },
            level: 0,
            measure: if via.measure() == Some(Measure::Material) { 0 } else { 2 },
            rotation: 0,
            criterion: 0,
            gap: 0,
            density: 1351.4,
            properties: self.properties(),
            placings: Default::default(),
            points: self.f.iter().map(point).collect(),
            // With the tangent of LS-DYNA.
            seed: 2,
        }
    }

    /// The answers at all points.
    fn evaluate(&self, via: Via) -> Vec<Answer> {
        let case = self.case(via);
        let entry = match via {
            Via::Point => Entry::Point,
            Via::Block => Entry::Block,
            Via::Of(_) => Entry::Host,
        };
        let one_by_one = || (0..self.f.len()).map(|i| case.of_point(i)).collect();
        let cases: Vec<Case> = if via.has_blocks() { vec![case.clone()] } else { one_by_one() };
        let answers = cases.iter().flat_map(|case| {
            let outcome = call::<f64>(entry, case, None);
            assert!(outcome.code == 0 && !outcome.input_written, "{via:?}: {} {}", outcome.code, outcome.message);
            (0..case.points.len()).map(move |i| {
                let tangent = outcome.further.as_ref().map_or(&outcome.tangent, |(_, further)| further);
                let [s11, s22, s33, s12, s23, s31] = outcome.stress.row(i).try_into().expect("six");
                Answer {
                    stress: Matrix3::new(s11, s12, s31, s12, s22, s23, s31, s23, s33),
                    state: outcome.state.row(i),
                    tangent: if via.measure().is_some() { tangent.row(i) } else { Vec::new() },
                }
            })
        });
        answers.collect()
    }

    fn first(&self, via: Via) -> Answer {
        self.with_points(vec![self.f[0]]).evaluate(via).swap_remove(0)
    }

    /// The largest stiffness, of which errors of the stress are a part.
    fn stiffness(&self) -> f64 {
        self.values[..2].iter().fold(0.0, |most: f64, k| most.max(*k))
    }

    fn without_failure(&self) -> Model {
        let mut model = self.clone();
        model.values[if self.law == Law::Linear { 3 } else { 5 }] = 0.0;
        model
    }
}

/// Any property of any law, from half to twice of a yarn's or further.
fn models() -> impl Strategy<Value = Model> {
    let yarn = (
        (10.0..200.0, prop_oneof![Just(0.0), 0.1..5.0], prop::sample::select(vec![1.2, 1.5, 2.0, 2.2, 3.0, 5.0])),
        (prop_oneof![Just(0.0), 0.1..5.0], prop_oneof![Just(0.0), 0.01..2.0]),
        (prop_oneof![Just(0.0), 0.02..0.2], 0.0..2.0, 0.0..1.0),
    );
    let yarn = yarn.prop_map(|((a, b, c), (d, e), (f, g, h))| vec![a, b, c, d, e, f, g, h]);
    let linear = (40.0..160.0, 0.2..2.0, 0.05..0.5, prop_oneof![Just(0.0), 1.0..8.0]);
    let linear = linear.prop_map(|(a, b, c, d)| vec![a, b, c, d]);
    let modes = |i_el, i_tc| deformation(Ranges { i_el, i_tc, i_td: 0.02..0.6, i_ld: 0.01..0.3 });
    let points =
        prop_oneof![modes(0.005..0.06, -0.4..-0.02), modes(-0.1..-0.01, -0.4..-0.02), modes(0.005..0.06, 0.02..0.2)];
    let friction = [0.0..0.9, 0.0..0.05];
    let points = prop::collection::vec(points, 1..20);
    (prop::sample::select(LAWS.to_vec()), yarn, linear, friction, points).prop_map(
        |(law, yarn, linear, friction, points)| {
            let m = points[0].m;
            // The others' fibres are turned to the first one's.
            let turned = |Sample { f, m: own, .. }: &Sample| {
                f * Rotation3::rotation_between(&m, own).unwrap_or_else(Rotation3::identity).into_inner()
            };
            let beside = if m.x.abs() < 0.5 { Vector3::x() } else { Vector3::y() };
            Model {
                law,
                values: if law == Law::Linear { linear } else { yarn },
                friction,
                m,
                second: m.cross(&beside).normalize(),
                old: Matrix3::identity(),
                f: points.iter().map(turned).collect(),
            }
        },
    )
}

/// Tries a property on models and rotations, through all hosts that have it.
fn try_all(
    name: &str,
    has: impl Fn(Via, Law) -> bool,
    holds: impl Fn(Via, &Model, &Matrix3<f64>) -> Result<(), String>,
) {
    const CASES: u32 = 200;
    let mut runner = TestRunner::new_with_rng(
        Config { cases: CASES, failure_persistence: None, ..Config::default() },
        proptest::test_runner::TestRng::deterministic_rng(Default::default()),
    );
    let tried = std::cell::RefCell::new([[0; VIAS.len()]; 3]);
    let result = runner.run(&(models(), rotation()), |(model, q)| {
        for (place, via) in VIAS.into_iter().enumerate().filter(|(_, via)| has(*via, model.law)) {
            holds(via, &model.seen(via), &q).map_err(|why| TestCaseError::fail(format!("{name}, {via:?}: {why}")))?;
            tried.borrow_mut()[model.law as usize][place] += 1;
        }
        Ok(())
    });
    result.unwrap_or_else(|error| panic!("{error}"));
    println!("{name:24} {:?}", tried.borrow());
    for law in LAWS {
        for (place, via) in VIAS.into_iter().enumerate() {
            let times = tried.borrow()[law as usize][place];
            assert_eq!(times > 0, has(via, law), "{name}, {via:?}, {law:?}: tried {times} times");
        }
    }
}

/// Two answers agree to these parts of the stiffness, but for the components of a slip, which depend on the axes.
fn agree(a: &Answer, b: &Answer, model: &Model, part: f64) -> Result<(), String> {
    let error = (a.stress - b.stress).norm();
    if error.is_nan() || error > part * (model.stiffness() + a.stress.norm()) {
        return Err(format!("stress {} and {}", a.stress, b.stress));
    }
    let slips = |c: usize| model.law == Law::Frictional && (c == 10 || c == 11);
    let size = model.stiffness();
    for (c, (x, y)) in a.state.iter().zip(&b.state).enumerate().filter(|(c, _)| !slips(*c)) {
        // A rounding may decide whether a point fails.
        let at_limit = c + 2 >= a.state.len();
        let difference = (x - y).abs();
        if difference.is_nan() || (difference > part * (1.0 + x.abs()).max(size) && !at_limit) {
            return Err(format!("state variable {c}: {x} and {y}"));
        }
    }
    Ok(())
}

/// What is lost to roundings, and to the stress measure of CalculiX.
const ROUNDINGS: f64 = 1e-12;

#[test]
fn the_stress_turns_with_the_body() {
    try_all(
        "objectivity",
        |via, _| !via.has_stretches(),
        |via, model, q| {
            let turned = Model { old: q * model.old, ..model.with_points(vec![q * model.f[0]]) };
            let (a, mut b) = (model.first(via), turned.first(via));
            b.stress = q.transpose() * b.stress * q;
            agree(&a, &b, model, ROUNDINGS)
        },
    );
}

#[test]
fn space_has_no_directions() {
    try_all(
        "turned models",
        |_, _| true,
        |via, model, q| {
            let turn = |f: &Matrix3<f64>| q * f * q.transpose();
            let (old, f) = (turn(&model.old), vec![turn(&model.f[0])]);
            let turned = Model { m: q * model.m, second: q * model.second, old, f, ..model.clone() };
            let (a, mut b) = (model.first(via), turned.first(via));
            b.stress = q.transpose() * b.stress * q;
            agree(&a, &b, model, ROUNDINGS)
        },
    );
}

/// The section of a yarn has no directions; the linear elastic law has a second axis.
#[test]
fn a_yarn_may_be_turned_about_its_fibre() {
    try_all(
        "symmetry about the fibre",
        |_, law| law != Law::Linear,
        |via, model, q| {
            let about = Rotation3::from_axis_angle(&Unit::new_normalize(model.m), 6.0 * q[0]).into_inner();
            let back = if via.has_stretches() { about.transpose() } else { Matrix3::identity() };
            let turned = model.with_points(vec![back * model.f[0] * about]);
            let (a, mut b) = (model.first(via), turned.first(via));
            b.stress = back.transpose() * b.stress * back;
            agree(&a, &b, model, ROUNDINGS)
        },
    );
}

/// The step of differences.
const STEP: f64 = 1e-6;

/// Small changes of the first point either way, F ± h dF, and dF: a stretch stays one.
fn moved(via: Via, model: &Model, q: &Matrix3<f64>) -> ([Model; 2], Matrix3<f64>) {
    let d = q + q.transpose();
    let change = if via.has_stretches() { d } else { d * model.f[0] };
    ([STEP, -STEP].map(|h| model.with_points(vec![model.f[0] + change * h])), change)
}

#[test]
fn the_stress_is_the_slope_of_the_energy() {
    try_all(
        "stress from the energy",
        |_, law| law == Law::Hyperelastic,
        |via, model, q| {
            let f = model.f[0];
            let ([ahead, behind], change) = moved(via, model, q);
            let energy = |model: &Model| model.first(via).state[..4].iter().sum::<f64>();
            let slope = (energy(&ahead) - energy(&behind)) / (2.0 * STEP);
            let nominal = f.determinant() * model.first(via).stress * f.try_inverse().expect("a body").transpose();
            let power = nominal.dot(&change);
            let error = (slope - power).abs();
            if error <= 1e-7 * model.stiffness() { Ok(()) } else { Err(format!("slope {slope}, power {power}")) }
        },
    );
}

fn second_piola_kirchhoff(f: &Matrix3<f64>, sigma: &Matrix3<f64>) -> Matrix3<f64> {
    let inverse = f.try_inverse().expect("a body");
    f.determinant() * inverse * sigma * inverse.transpose()
}

fn components(a: &Matrix3<f64>, shear: f64) -> SVector<f64, 6> {
    SVector::from([a.m11, a.m22, a.m33, shear * a.m12, shear * a.m23, shear * a.m31])
}

/// Along a symmetric velocity gradient. At a kink, where the slopes either way differ, there is none.
#[test]
fn the_tangent_is_the_slope_of_the_stress() {
    try_all(
        "tangent from the stress",
        |via, law| via.measure().is_some() && (law == Law::Hyperelastic || !via.has_symmetric_parts()),
        |via, model, q| {
            let model = &model.without_failure();
            let (f, d) = (model.f[0], q + q.transpose());
            let ([ahead, behind], _) = moved(via, model, q);
            let here = model.first(via);
            let measure = via.measure().expect("one that has tangents");
            let taken = |model: &Model| {
                let sigma = model.first(via).stress;
                match measure {
                    Measure::Material => second_piola_kirchhoff(&model.f[0], &sigma),
                    Measure::Truesdell => sigma,
                    Measure::Jaumann => sigma * model.f[0].determinant() / f.determinant(),
                }
            };
            let [ahead, middle, behind] = [&ahead, model, &behind].map(taken);
            let mut slope = (ahead - behind) / (2.0 * STEP);
            let kink = (ahead - 2.0 * middle + behind).norm() / STEP;
            let rate = if measure == Measure::Material { f.transpose() * d * f } else { d };
            if measure == Measure::Truesdell {
                slope += d.trace() * here.stress - d * here.stress - here.stress * d;
            }
            let tangent = SMatrix::<f64, 6, 6>::from_row_slice(&here.tangent[..36]);
            let expected = tangent * components(&rate, 2.0);
            let (error, size) = ((components(&slope, 1.0) - expected).norm(), tangent.norm() + model.stiffness());
            let is_right = error <= 1e-7 * size + kink;
            if is_right { Ok(()) } else { Err(format!("{error:e} of {size}, kink {kink:e}")) }
        },
    );
}

/// Further stretched along its fibre, a yarn is nearer to failure: its index, or the largest principal stress.
#[test]
fn the_failure_index_grows_with_the_stretch() {
    try_all(
        "failure index grows",
        |_, _| true,
        |via, model, q| {
            let along = model.m * model.m.transpose();
            // The linear elastic law from rest along its fibre, since its stresses elsewhere may be larger.
            let start = if model.law == Law::Linear { q * (Matrix3::identity() + 0.01 * along) } else { model.f[0] };
            let start = if via.has_stretches() { stretch(&start) } else { start };
            let index = |k: f64| {
                let f = start * (Matrix3::identity() + k * along);
                let f = if via.has_stretches() { stretch(&f) } else { f };
                let state = model.with_points(vec![f]).first(via).state;
                if model.law == Law::Linear { state[6] } else { state[state.len() - 3] }
            };
            // Of the yarn laws a fibre in tension has one, if the properties have a strain at failure.
            let has_index = model.law == Law::Linear || (model.values[5] > 0.0 && (start * model.m).norm() > 1.0);
            let indices = [0.001, 0.004, 0.01, 0.03].map(index);
            let grows = indices.windows(2).all(|pair| pair[0] < pair[1]);
            if grows || !has_index { Ok(()) } else { Err(format!("{indices:?}")) }
        },
    );
}

#[test]
fn a_block_is_its_parts_in_any_order() {
    try_all(
        "blocks in parts, turned",
        |via, _| via.has_blocks(),
        |via, model, q| {
            let whole = model.evaluate(via);
            let n = model.f.len();
            let (left, right) = model.f.split_at(((q[0].abs() * n as f64) as usize).min(n));
            let parts = [left, right].map(|part| model.with_points(part.to_vec()).evaluate(via)).concat();
            let mut reversed = model.with_points(model.f.iter().rev().copied().collect()).evaluate(via);
            reversed.reverse();
            for (i, (part, whole)) in parts.iter().zip(&whole).enumerate() {
                let alone = if i < left.len() { left.len() } else { right.len() } == 1;
                // A point alone may go through the scalar routine of LS-DYNA, which has other roundings.
                match alone && via == Via::Of(Host::LsDyna) {
                    true => agree(part, whole, model, ROUNDINGS)?,
                    false if part != whole => return Err(format!("point {i} of {n}")),
                    false => {}
                }
            }
            if reversed == whole { Ok(()) } else { Err(format!("{n} points, turned round")) }
        },
    );
}

#[test]
fn units_of_stress_are_as_good_as_others() {
    try_all(
        "units",
        |_, _| true,
        |via, model, q| {
            let factor = 10f64.powf(6.0 * q[0]);
            let (stresses, energies): (&[usize], Vec<usize>) = match model.law {
                Law::Linear => (&[0, 1, 2, 3], (0..8).collect()),
                Law::Hyperelastic => (&[0, 1, 3, 4], (0..4).collect()),
                Law::Frictional => (&[0, 1, 3, 4], (0..4).chain([8]).collect()),
            };
            let mut other = model.clone();
            stresses.iter().for_each(|&place| other.values[place] *= factor);
            other.friction[1] *= factor;
            let (a, mut b) = (model.first(via), other.first(via));
            b.stress /= factor;
            energies.iter().for_each(|&place| b.state[place] /= factor);
            agree(&a, &b, model, ROUNDINGS)
        },
    );
}
