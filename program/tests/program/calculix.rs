//! The decks of `ffi-tests/calculix` in CalculiX, an unmodified solver that loads the shared library: against closed
//! forms, the library's own answer and equilibrium recomputed here; with the library's tangent and with one
//! differentiated numerically.
//!
//! CalculiX prints seven digits, hence the tolerances: 1e-6 of the largest value where one printed number stands
//! against a closed form, 5e-6 where printed displacements go through differences over an element and the fibre's
//! stiffness.

use crate::calculix_decks::{
    Job, Results, Tangent, assert_quadratic, both_tangents as run, control, properties, vectors,
};
use crate::hexahedra::Mesh;
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use toron::law::state::{FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use toron::law::stress::{first_piola_kirchhoff, matrix};
use toron::{Hyperelastic, Point, Request};
use toron_materials::load_path::newton::{self, Prescribed};
use toron_materials::material::model::NominalTangent;

const PRINTED: f64 = 1e-6;
const DIFFERENCED: f64 = 5e-6;

/// The edge of the blocks: large, since CalculiX takes residual forces below 1e-6 for 0.
const EDGE: f64 = 100.0;

fn law(deck: &str) -> Hyperelastic<f64> {
    Hyperelastic::new(&properties(deck)).expect("the deck's properties")
}

fn point(law: &Hyperelastic<f64>, f: &Matrix3<f64>) -> Point<f64> {
    law.point(f, &[0.0; HYPERELASTIC_STATE], Request::ALL)
}

/// The largest difference of two rows, over the largest value expected.
fn deviation(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    found.iter().zip(expected).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs())) / size
}

/// A symmetric tensor in CalculiX's order of printing: xx yy zz xy xz yz.
fn printed_order([s11, s22, s33, s12, s23, s31]: [f64; 6]) -> [f64; 6] {
    [s11, s22, s33, s12, s31, s23]
}

/// Every integration point's Cauchy stress and invariants against one answer of the library.
#[track_caller]
fn assert_uniform(results: &Results, expected: &Point<f64>) {
    let stress = printed_order(expected.stress);
    let (mut worst, mut worst_state) = (0.0_f64, 0.0_f64);
    let stresses = &results.last("stresses").rows;
    assert!(!stresses.is_empty());
    for row in stresses {
        worst = worst.max(deviation(&row[2..], &stress));
    }
    for row in &results.last("internal state").rows {
        worst_state = worst_state
            .max(deviation(&row[2 + INVARIANTS..2 + FAILURE_INDEX], &expected.state[INVARIANTS..FAILURE_INDEX]));
    }
    println!("  deviation of the stress {worst:.1e}, of the invariants {worst_state:.1e}");
    assert!(worst < PRINTED && worst_state < PRINTED, "{worst:e}, {worst_state:e}");
}

/// Every integration point's Cauchy stress, and equilibrium, against a law's Cauchy stress at the printed
/// displacements.
fn assert_equilibrium(mesh: &Mesh, results: &Results, cauchy: impl Fn(&Matrix3<f64>) -> [f64; 6]) {
    let displacements = vectors(results.last("displacements"));
    // Stress, point by point.
    let stresses = &results.last("stresses").rows;
    let size = stresses.iter().flat_map(|row| &row[2..]).fold(0.0, |size: f64, s| size.max(s.abs()));
    let points = (0..mesh.elements.len()).flat_map(|element| mesh.gauss_points(element, &displacements));
    let mut worst = 0.0_f64;
    for (row, gauss) in stresses.iter().zip(points) {
        let expected = printed_order(cauchy(&gauss.f));
        worst = row[2..].iter().zip(expected).fold(worst, |worst, (a, b)| worst.max((a - b).abs() / size));
    }
    // Equilibrium: no force at a free node, the printed reaction at a held one.
    let own = mesh.forces(&displacements, |f| first_piola_kirchhoff(&cauchy(f), f));
    let reactions = vectors(results.last("forces"));
    let largest = reactions.iter().fold(0.0, |size: f64, force| size.max(force.norm()));
    let off = own.iter().zip(&reactions).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).norm())) / largest;
    println!("  deviation of the stress {worst:.1e}, of the forces {off:.1e}");
    assert_eq!(stresses.len(), 8 * mesh.elements.len());
    assert!(worst < DIFFERENCED && off < DIFFERENCED, "{worst:e}, {off:e}");
}

fn edges(x: &Vector3<f64>) -> bool {
    x.iter().any(|&x| x == 0.0 || x == EDGE)
}

#[test]
fn patch_test_with_a_rotation() {
    let mut mesh = Mesh::block([2; 3], [EDGE; 3]);
    let inner = mesh.nodes.iter().position(|x| !edges(x)).expect("a node inside");
    mesh.nodes[inner] += Vector3::new(13.0, -9.0, 7.0);
    let rotation = Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::new(1.0, 2.0, 3.0)), 60_f64.to_radians());
    let stretch = Matrix3::new(1.04, 0.03, 0.02, 0.03, 0.95, 0.06, 0.02, 0.06, 0.97);
    let f = rotation.matrix() * stretch;
    let moved = |x: &Vector3<f64>| f * x - x;
    let boundary = mesh.boundary(|x| if edges(x) { moved(x).map(Some).into() } else { [None; 3] });
    let includes = [
        ("mesh.inp", mesh.cards("NODES", "YARN", [1, 1])),
        ("boundary.inp", boundary),
        ("control.inp", control(1e-9, 1e-7)),
    ];
    let results = run("patch.inp", &includes);

    let law = law("patch.inp");
    let expected = point(&law, &f);
    let [i_el, i_tc, _, i_ld] = std::array::from_fn(|k| expected.state[INVARIANTS + k]);
    assert!(i_el > 0.01 && i_tc < -0.01 && i_ld > 0.01, "every mode is at work: {:?}", expected.state);
    // Turned with the material: what a host that confuses frames gets wrong.
    let turned = rotation.matrix() * matrix(&point(&law, &stretch).stress) * rotation.matrix().transpose();
    assert!((turned - matrix(&expected.stress)).norm() < 1e-12 * turned.norm());
    assert_uniform(&results, &expected);
    let displacement = vectors(results.last("displacements"))[inner];
    assert!((displacement - moved(&mesh.nodes[inner])).norm() < PRINTED * displacement.norm());

    // The same fibre as the first of rectangular axes, and as the third of cylindrical ones.
    let job = Job { deck: "patch.inp", includes: &includes, tangent: Tangent::Analytic };
    let axes = [
        ("1.0, 0.0, 0.0", "SYSTEM=RECTANGULAR\n0.6, 0.48, 0.64, 1.0, 0.0, 0.0"),
        ("0.0, 0.0, 1.0", "SYSTEM=CYLINDRICAL\n-7.0, 0.0, 0.0, -6.4, 0.48, 0.64"),
    ];
    for (i, (fibre, system)) in axes.into_iter().enumerate() {
        let results = job.run_edited(&format!("axes-{i}"), |deck| {
            let orientation = format!("*ORIENTATION, NAME=AXES, {system}\n*SOLID SECTION, ORIENTATION=AXES,");
            deck.replace("0.6, 0.48, 0.64\n", &format!("{fibre}\n"))
                .replace("*SOLID SECTION,", &orientation)
                .replace("*EL PRINT,", "*EL PRINT, GLOBAL=YES,")
        });
        assert_uniform(&results, &expected);
    }
}

/// The free width under a given height, at F11 = 1: P22 = 0.
fn spread(law: &Hyperelastic<f64>, height: f64) -> Matrix3<f64> {
    let start = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, height));
    let mut prescribed = [Prescribed::Gradient(0.0); 9];
    prescribed[0] = Prescribed::Gradient(1.0);
    prescribed[4] = Prescribed::Stress(0.0);
    prescribed[8] = Prescribed::Gradient(height);
    let stress = |f: &Matrix3<f64>| {
        let (point, tangent) = law.point_with_nominal(&f.data.0, None, &[0.0; HYPERELASTIC_STATE], Request::ALL);
        Ok((first_piola_kirchhoff(&point.stress, f), NominalTangent::from_column_slice(&tangent)))
    };
    newton::solve(&stress, &start, &prescribed, 82341.0).expect("a solution").f
}

#[test]
fn transverse_compression_of_a_block() {
    let mesh = Mesh::block([1, 4, 4], [EDGE; 3]);
    let height = |x: &Vector3<f64>| match x.z {
        0.0 => Some(0.0),
        EDGE => Some(-0.2 * EDGE),
        _ => None,
    };
    let boundary = mesh.boundary(|x| [None, (x.y == 0.0).then_some(0.0), height(x)]);
    let includes = [
        ("mesh.inp", mesh.cards("NODES", "YARN", [1, 1])),
        ("boundary.inp", boundary),
        ("control.inp", control(1e-9, 1e-7)),
    ];
    let results = run("compression.inp", &includes);

    let law = law("compression.inp");
    let f = spread(&law, 0.8);
    assert!((f.m22 - 1.0829).abs() < 5e-5, "the example `spreading` widens by 8.29 %, {}", f.m22);
    // The closed form: no force across means pressure = distortion, (p/2) k_tc i^(p−1) = (k_td/4) a, with a = 2 I_td.
    let (i, a) = (-0.5 * (0.8 * f.m22).ln(), (f.m22 / 0.8).ln());
    assert!((1.1 * 1055.0 * i.powf(1.2) - 0.25 * 649.74 * a).abs() < 1e-6);
    assert_uniform(&results, &point(&law, &f));
    for (x, u) in mesh.nodes.iter().zip(vectors(results.last("displacements"))) {
        assert!((f * x - x - u).norm() < PRINTED * EDGE, "{x} moves by {u}");
    }
}

/// CalculiX asks for a smaller increment where the first guess turns elements inside out, and comes to the same end.
#[test]
fn an_inverted_point_cuts_the_increment() {
    let mesh = Mesh::block([1, 4, 4], [EDGE; 3]);
    let lowered = |x: &Vector3<f64>| if x.z == 0.0 { Some(0.0) } else { (x.z == EDGE).then_some(-0.4 * EDGE) };
    let includes = [
        ("mesh.inp", mesh.cards("NODES", "YARN", [1, 1])),
        ("boundary.inp", mesh.boundary(|x| [None, (x.y == 0.0).then_some(0.0), lowered(x)])),
        ("control.inp", control(1e-9, 1e-7)),
    ];
    let job = Job { deck: "compression.inp", includes: &includes, tangent: Tangent::Analytic };
    let (output, _) = job.attempt("cutback", |deck| {
        // What stands behind a second @ is the user's.
        deck.replace("0.2, 1.0\n", "1.0, 1.0\n").replace("@TORON_HYPERELASTIC", "@TORON_HYPERELASTIC@WARP")
    });
    let log = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{log}");
    assert!(log.contains("requested by a material user routine (through pnewdt)"), "{log}");
}

/// The files of `twist.inp`, for a cube of so many elements along each axis.
fn twist(elements: usize) -> (Mesh, [(&'static str, String); 3]) {
    let mesh = Mesh::block([elements; 3], [EDGE; 3]);
    let axis = Vector3::new(0.5 * EDGE, 0.5 * EDGE, 0.0);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 30_f64.to_radians());
    let lifted = Vector3::new(0.0, 0.0, 0.02 * EDGE);
    let boundary = mesh.boundary(|x| match x.z {
        0.0 => [Some(0.0); 3],
        EDGE => (turn * (x - axis) + axis - x + lifted).map(Some).into(),
        _ => [None; 3],
    });
    let includes = [
        ("mesh.inp", mesh.cards("NODES", "YARN", [1, 1])),
        ("boundary.inp", boundary),
        ("control.inp", control(1e-9, 1e-7)),
    ];
    (mesh, includes)
}

#[test]
fn twist_and_stretch() {
    let (mesh, includes) = twist(4);
    let results = run("twist.inp", &includes);
    let law = law("twist.inp");
    assert_equilibrium(&mesh, &results, |f| point(&law, f).stress);
}

/// The files of `pull.inp`: a bar of irregular elements and of section EDGE².
fn bar(length: f64, pull: f64) -> (Mesh, [(&'static str, String); 3]) {
    let mut mesh = Mesh::block([3, 1, 1], [length, EDGE, EDGE]);
    for x in &mut mesh.nodes {
        if x.x != 0.0 && x.x != length {
            x.x += 0.1 * (x.y - x.z) + 0.05 * x.x;
        }
    }
    let pulled = |x: &Vector3<f64>| if x.x == 0.0 { Some(0.0) } else { (x.x == length).then_some(pull * length) };
    let ends: Vec<_> =
        (0..mesh.nodes.len()).filter(|&i| mesh.nodes[i].x == length).map(|i| (i + 1).to_string()).collect();
    let set = format!("*NSET, NSET=PULLED\n{}\n", ends.join(", "));
    let includes = [
        ("mesh.inp", mesh.cards("NODES", "YARN", [1, 1]) + &set),
        ("boundary.inp", mesh.boundary(|x| [pulled(x), None, None])),
        ("control.inp", control(1e-9, 1e-7)),
    ];
    (mesh, includes)
}

/// The reaction of a bar that is drawn along its fibre is this stress until it has come to this stretch, beyond it
/// nothing; the increment that breaks still carries. The latch is the state variable `failed`.
fn assert_breaks(results: &Results, pull: f64, stress: impl Fn(f64) -> f64, stretch: f64, failed: usize) {
    let limit = stress(stretch) * EDGE * EDGE;
    let reactions = results.all("total force");
    let states = results.all("internal state");
    let mut broken = false;
    let mut worst = 0.0_f64;
    for (reaction, state) in reactions.iter().zip(&states) {
        let lambda = 1.0 + pull * reaction.time;
        let expected = if broken { 0.0 } else { stress(lambda) * EDGE * EDGE };
        worst = worst.max((reaction.rows[0][0] - expected).abs() / limit);
        broken |= lambda.ln() >= stretch.ln();
        for row in &state.rows {
            assert_eq!(row[2 + failed], f64::from(u8::from(broken)), "at {lambda}");
        }
    }
    println!("  deviation of the force {worst:.1e}, of {} increments", reactions.len());
    assert!(broken && reactions.len() >= 20);
    assert!(worst < PRINTED, "{worst:e}");
}

/// Below the limit k_el ln λ/λ.
#[test]
fn fibre_pull_to_failure() {
    const LENGTH: f64 = 3.0 * EDGE;
    const PULL: f64 = 0.06;
    let (mesh, includes) = bar(LENGTH, PULL);
    let results = run("pull.inp", &includes);

    let props = properties("pull.inp");
    let (k_el, eps_lim) = (props[0], props[5]);
    assert_breaks(&results, PULL, |lambda| k_el * lambda.ln() / lambda, 1.0 + eps_lim, FAILED);
    // Nothing holds the broken bar but the remaining stiffness, which keeps its nodes in line.
    for (x, u) in mesh.nodes.iter().zip(vectors(results.last("displacements"))) {
        assert!(u.x.abs() <= 1.001 * PULL * LENGTH && u.x >= -1e-3, "{x} moves by {u}");
    }
}

/// With a state variable for limits of points, which CalculiX leaves 0, the bar breaks as without; a variable of the
/// law's is none.
#[test]
fn a_variable_for_limits_that_is_0_is_that_of_the_card() {
    const PULL: f64 = 0.06;
    let (_, includes) = bar(3.0 * EDGE, PULL);
    let limited = |number: &str| {
        let card = PULLED_YARN.replace("0.0\n1.0, 0.0, 0.0\n", &format!("0.0\n1.0, 0.0, 0.0, {number}\n"));
        move |deck: String| {
            let deck = deck.replace(PULLED_YARN, &card).replace("CONSTANTS=11", "CONSTANTS=12");
            deck.replace("*DEPVAR\n11", "*DEPVAR\n12")
        }
    };
    let job = Job { deck: "pull.inp", includes: &includes, tangent: Tangent::Analytic };
    let props = properties("pull.inp");
    let results = job.run_edited("limited-pull", limited("12.0"));
    assert_breaks(&results, PULL, |lambda| props[0] * lambda.ln() / lambda, 1.0 + props[5], FAILED);
    let (output, _) = job.attempt("wrong-variable", limited("11.0"));
    let log = String::from_utf8_lossy(&output.stdout).into_owned();
    let allowed = "limit_variable is 11.0; allowed: 0, or the number of a state variable behind those of the law";
    assert!(log.contains(allowed), "{log}");
}

/// A law of one's own in place of the library's, in the same decks: `examples/own_law` from its own library.
fn with_own_law(deck: &str, from: &str, properties: &str) -> String {
    let own = deck.replace("@TORON_HYPERELASTIC", "@OWN_REINFORCED").replace("*DEPVAR\n11", "*DEPVAR\n4");
    let own = own.replace("CONSTANTS=11", "CONSTANTS=7").replace(from, properties);
    assert!(own.contains(properties), "{own}");
    own
}

const PULLED_YARN: &str = "82341.0, 1055.0, 2.2, 649.74, 0.0, 0.0458, 1.8, 0.0\n1.0, 0.0, 0.0\n";

/// With the fibre along the first of rectangular axes: the residuals are squared, and the stress is that of the law
/// with the fibre in global axes.
#[test]
fn a_law_of_ones_own_converges_quadratically() {
    let (mesh, includes) = twist(3);
    let job = Job { deck: "twist.inp", includes: &includes, tangent: Tangent::Analytic };
    let results = job.run_edited("own-twist", |deck| {
        let yarn = "82341.0, 1055.0, 2.2, 649.74, 1000.0, 0.0, 0.0, 0.0\n0.0, 0.0, 1.0\n";
        let axes = "*ORIENTATION, NAME=AXES, SYSTEM=RECTANGULAR\n0.6, 0.48, 0.64, 1.0, 0.0, 0.0\n";
        with_own_law(&deck, yarn, "800.0, 1200.0, 5000.0, 0.0, 1.0, 0.0, 0.0\n")
            .replace("*SOLID SECTION,", &format!("{axes}*SOLID SECTION, ORIENTATION=AXES,"))
            .replace("*EL PRINT,", "*EL PRINT, GLOBAL=YES,")
    });
    assert_quadratic("own-twist", &results);
    assert_equilibrium(&mesh, &results, |f| reinforced(f, [800.0, 1200.0, 5000.0], Vector3::new(0.6, 0.48, 0.64)));
}

/// σ = (μ (b − 1) + Λ ln J 1 + 2k (I4 − 1) a⊗a)/J, 11 22 33 12 23 31.
fn reinforced(f: &Matrix3<f64>, [mu, lambda, k]: [f64; 3], fibre: Vector3<f64>) -> [f64; 6] {
    let (j, a, one) = (f.determinant(), f * fibre, Matrix3::identity());
    let solid = mu * (f * f.transpose() - one) + lambda * j.ln() * one;
    let s = (solid + 2.0 * k * (a.norm_squared() - 1.0) * a * a.transpose()) / j;
    [s.m11, s.m22, s.m33, s.m12, s.m23, s.m31]
}

#[test]
fn a_law_of_ones_own_breaks() {
    const PULL: f64 = 0.06;
    let (_, includes) = bar(3.0 * EDGE, PULL);
    let job = Job { deck: "pull.inp", includes: &includes, tangent: Tangent::Analytic };
    let own = |deck: String| with_own_law(&deck, PULLED_YARN, "800.0, 1200.0, 20000.0, 1.0458, 1.0, 0.0, 0.0\n");
    let results = job.run_edited("own-pull", own);
    let stress = |stretch: f64| {
        let f = Matrix3::from_diagonal(&Vector3::new(stretch, 1.0, 1.0));
        reinforced(&f, [800.0, 1200.0, 20000.0], Vector3::x())[0]
    };
    assert_breaks(&results, PULL, stress, 1.0458, 2);
    // A wrong constant is refused by its name in the law's own table.
    let wrong = [
        (
            "800.0, 1200.0",
            "-800.0, 1200.0",
            "property 1 (mu, shear modulus of the solid) is -800.0; allowed: a number > 0",
        ),
        ("1.0, 0.0, 0.0\n*DEPVAR", "0.0, 0.0, 0.0\n*DEPVAR", "properties 5 to 7 (fibre direction) are 0.0, 0.0, 0.0"),
        ("*DEPVAR\n4", "*DEPVAR\n3", "number of state variables (*DEPVAR): 3 given, 4 needed"),
    ];
    for (i, (from, to, message)) in wrong.into_iter().enumerate() {
        let (output, _) = job.attempt(&format!("own-wrong-{i}"), |deck| own(deck).replace(from, to));
        let log = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(201), "{to}: {log}");
        assert!(log.contains("*ERROR: toron, material @OWN_REINFORCED: "), "{to}: {log}");
        assert!(log.contains(message), "{to}: {log}");
    }
}

/// What is wrong with a deck stands in CalculiX's output, and the job ends.
#[test]
fn wrong_decks_are_refused() {
    let mesh = Mesh::block([1; 3], [EDGE; 3]);
    let includes = [
        ("mesh.inp", mesh.cards("NODES", "YARN", [1, 1])),
        ("boundary.inp", mesh.boundary(|x| [None, None, Some(0.1 * x.z)])),
        ("control.inp", String::new()),
    ];
    let wrong = [
        ("CONSTANTS=11", "CONSTANTS=10", "number of properties: 10 given, 11 needed"),
        ("2.2,", "1.0,", "property 3 (p, transverse compaction exponent) is 1.0; allowed: a number > 1, at most 40"),
        ("*DEPVAR\n11", "*DEPVAR\n10", "number of state variables (*DEPVAR): 10 given, 11 needed"),
        (", NLGEOM", "", "the step is geometrically linear, give *STEP, NLGEOM"),
        ("*STEP,", "*INITIAL CONDITIONS, TYPE=STRESS\n1, 1, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0\n*STEP,", "initial stress is"),
    ];
    for (i, (from, to, message)) in wrong.into_iter().enumerate() {
        let job = Job { deck: "compression.inp", includes: &includes, tangent: Tangent::Analytic };
        let (output, _) = job.attempt(&format!("wrong-{i}"), |deck| deck.replace(from, to));
        let log = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(201), "{to}: {log}");
        assert!(log.contains("*ERROR: toron, material @TORON_HYPERELASTIC: "), "{to}: {log}");
        assert!(log.contains(message), "{to}: {log}");
    }
}
