//! The driver: mixed control, work, rotation, parallel points, and what its errors say.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use toron_materials::load_path::element::Hexahedron;
use toron_materials::load_path::path::LoadPath;
use toron_materials::load_path::report;
use toron_materials::load_path::run::{self, End, History};
use toron_materials::material::laws::Laws;
use toron_shared::error::Error;

const HEAD: &str = "units = \"mm-tonne-s\"\n[material]\npreset = \"kevlar-km2-600\"\n";

fn parse(text: &str) -> LoadPath {
    LoadPath::parse(Laws::Toron, "path.toml", text).expect("the path is valid")
}

fn first(path: &LoadPath) -> History<'_> {
    run::run(path, &|| {}).remove(0)
}

/// The message of the error that the path is rejected with.
fn rejected(text: &str) -> String {
    match LoadPath::parse(Laws::Toron, "path.toml", text) {
        Err(Error::Input(message)) => message,
        other => panic!("an input error was expected, not {other:?}"),
    }
}

/// The reason why the only point of the path was not completed.
fn failed(text: &str) -> String {
    match first(&parse(text)).end {
        End::Failed(reason) => reason,
        other => panic!("a failed evaluation was expected, not {other:?}"),
    }
}

#[test]
fn nine_free_components_find_the_uniaxial_stretch() {
    // All stresses prescribed: the rigid spin and the lateral directions have no stiffness and must stay at rest.
    let path = parse(&format!(
        "{HEAD}[[step]]\nincrements = 10\nP = {{ 11 = 1000, 12 = 0, 13 = 0, 21 = 0, 22 = 0, 23 = 0, 31 = 0, 32 = 0, 33 = 0 }}"
    ));
    let history = first(&path);
    assert_eq!(history.end, End::Completed);
    let last = history.increments.last().expect("there are increments");
    assert!((last.p - Matrix3::from_diagonal(&Vector3::new(1000.0, 0.0, 0.0))).amax() < 1e-6);
    // k_el ln λ/λ = 1000
    let stretch = last.f.m11;
    assert!((82341.0 * stretch.ln() / stretch - 1000.0).abs() < 1e-6);
    assert!((last.f - Matrix3::from_diagonal(&Vector3::new(stretch, 1.0, 1.0))).amax() < 1e-12);
}

#[test]
fn a_free_side_stays_free_in_the_steps_that_follow() {
    let path = parse(&format!(
        "{HEAD}[[step]]\nincrements = 5\nF = {{ 33 = 0.9 }}\nP = {{ 22 = 0 }}\n[[step]]\nincrements = 5\nF = {{ 11 = 1.02 }}"
    ));
    let history = first(&path);
    assert_eq!(history.end, End::Completed);
    for increment in &history.increments {
        assert!(increment.p.m22.abs() < 1e-6);
    }
    assert!(history.increments[5].f.m22 > 1.01);
    assert!(history.increments[10].p.m33 < -1.0);
}

#[test]
fn a_held_component_stays_and_carries_stress() {
    let path = parse(&format!(
        "{HEAD}[[step]]\nF = {{ 33 = 0.9 }}\nP = {{ 22 = 0 }}\n[[step]]\nF = {{ 22 = \"hold\", 33 = 0.8 }}"
    ));
    let history = first(&path);
    assert_eq!(history.increments[1].f.m22, history.increments[2].f.m22);
    assert!(history.increments[2].p.m22 < -1.0);
}

/// Out along a path that moves all nine components, with a rotation if any, and straight back.
fn there_and_back(increments: usize, rotation: &str) -> LoadPath {
    let there = "11 = 1.02, 12 = 0.1, 13 = -0.05, 21 = 0.02, 22 = 0.85, 23 = 0.1, 31 = -0.03, 32 = 0.04, 33 = 0.9";
    let back = "11 = 1, 12 = 0, 13 = 0, 21 = 0, 22 = 1, 23 = 0, 31 = 0, 32 = 0, 33 = 1";
    parse(&format!(
        "element = [2, 3, 0.5]\n{HEAD}properties = {{ k_ld = 300, eps_lim = 0 }}\nfibre = [1, 0.2, -0.1]\n\
         [[step]]\nincrements = {increments}\nF = {{ {there} }}\n{rotation}\n\
         [[step]]\nincrements = {increments}\nF = {{ {back} }}\n{rotation}"
    ))
}

fn stored(history: &History) -> Vec<f64> {
    let volume = 2.0 * 3.0 * 0.5;
    history.increments.iter().map(|i| history.point.material.energy(&i.answer.memory) * volume).collect()
}

#[test]
fn work_is_stored_and_a_closed_path_does_none() {
    // The trapezoidal rule is of second order: four times fewer errors at half the step.
    let error = |increments: usize| {
        let path = there_and_back(increments, "");
        let history = first(&path);
        let (stored, n) = (stored(&history), increments);
        assert!(stored[n] > 10.0, "the path stores energy");
        assert!(history.increments[2 * n].work.abs() < 1e-9 * stored[n], "the way back is the way there");
        assert!(stored[2 * n] < 1e-20 * stored[n]);
        (history.increments[n].work - stored[n]).abs() / stored[n]
    };
    let errors = [50, 100, 200].map(error);
    assert!(errors[0] < 1e-3, "{errors:?}");
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.5..4.5).contains(&ratio), "order: {errors:?}");
    }
}

#[test]
fn a_rotation_on_top_changes_neither_work_nor_energies() {
    let still = there_and_back(40, "");
    let turning = there_and_back(40, "rotation = { axis = [1, 2, -0.5], angle = 130 }");
    let (still, turning) = (first(&still), first(&turning));
    let scale = stored(&still)[40];
    for (a, b) in still.increments.iter().zip(&turning.increments) {
        assert_eq!(a.f, b.f);
        assert!((a.work - b.work).abs() < 1e-12 * scale);
        assert!((a.p - b.p).amax() < 1e-12 * 82341.0);
        for (x, y) in a.answer.memory.state.iter().zip(&b.answer.memory.state) {
            assert!((x - y).abs() < 1e-12 * (1.0 + x.abs()));
        }
    }
    // Two steps of 130 degrees about the same axis, and F back at the identity.
    let axis = Unit::new_normalize(Vector3::new(1.0, 2.0, -0.5));
    let turned = Rotation3::from_axis_angle(&axis, 260f64.to_radians()).into_inner();
    let last = turning.increments.last().expect("there are increments");
    assert!((last.rotated_gradient() - turned).amax() < 1e-14);
}

#[test]
fn prescribed_stresses_hold_under_a_rotation() {
    let path = parse(&format!(
        "{HEAD}[[step]]\nincrements = 10\nP = {{ 11 = 1000 }}\n\
         [[step]]\nincrements = 10\nP = {{ 11 = 2000 }}\nrotation = {{ axis = [0, 0, 1], angle = 90 }}"
    ));
    let history = first(&path);
    let last = history.increments.last().expect("there are increments");
    assert!((last.p.m11 - 2000.0).abs() < 1e-6);
    assert!((last.rotated_stress().m21 - 2000.0).abs() < 1e-6);
}

#[test]
fn every_frame_of_the_linear_law_turns_with_a_rotation() {
    for frame in ["fibre", "polar", "spin"] {
        let path = parse(&format!(
            "units = \"mm-tonne-s\"\n[material]\npreset = \"kevlar-km2-600-linear\"\nframe = \"{frame}\"\n\
             [[step]]\nincrements = 5\nF = {{ 11 = 1.02 }}\n\
             [[step]]\nincrements = 10\nrotation = {{ axis = [0, 0, 1], angle = 90 }}\n\
             [[step]]\nincrements = 5\nF = {{ 11 = 1.03 }}"
        ));
        let history = first(&path);
        for (index, stretch) in [(15, 1.02f64), (20, 1.03)] {
            let [s11, s22, ..] = history.increments[index].answer.cauchy;
            assert!((s22 - 79414.0 * stretch.ln()).abs() < 1e-8 && s11.abs() < 1e-8, "{frame}: {s11} {s22}");
        }
    }
}

#[test]
fn forces_on_faces_are_stress_times_reference_area() {
    let element = Hexahedron { size: Vector3::new(2.0, 3.0, 5.0) };
    let p = Matrix3::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
    assert_eq!(element.volume(), 30.0);
    assert_eq!(element.face_forces(&p), Matrix3::new(15.0, 20.0, 18.0, 60.0, 50.0, 36.0, 105.0, 80.0, 54.0));
}

#[test]
fn parallel_points_are_those_of_a_single_run() {
    let points: String = (1..=24)
        .map(|n| format!("[[point]]\nname = \"{n}\"\nmaterial = {{ fibre = [1, {}, 0.1] }}\n", 0.05 * f64::from(n)))
        .collect();
    let path = parse(&format!(
        "{HEAD}{points}[[step]]\nincrements = 12\nF = {{ 11 = 1.03, 12 = 0.1 }}\nP = {{ 33 = -20 }}\n\
         [[step]]\nincrements = 12\nF = {{ 11 = 1.1 }}\nP = {{ 33 = 0 }}"
    ));
    let parallel = run::run(&path, &|| {});
    assert_eq!(parallel.len(), 24);
    for (point, history) in path.points.iter().zip(&parallel) {
        let alone = run::run_point(&path, point, &|| {});
        assert_eq!(alone.increments, history.increments);
        assert_eq!((alone.end, alone.failure), (history.end.clone(), history.failure));
    }
    assert!(parallel[0].increments != parallel[1].increments);
}

#[test]
fn a_stress_prescribed_beyond_failure_stops_the_path() {
    let path = parse(&format!("{HEAD}[[step]]\nincrements = 10\nP = {{ 11 = 5000 }}"));
    let history = first(&path);
    // P11 = k_el ln λ/λ meets ln λ = ln 1.0458 at 3525.9 MPa, between increments 7 and 8.
    assert_eq!(history.failure, Some(8));
    assert_eq!(history.increments.len(), 9);
    assert!(matches!(&history.end, End::Stopped(place) if place == "step 1, increment 9"));
}

#[test]
fn free_sides_do_not_stop_a_failed_point() {
    let path = parse(&format!("{HEAD}[[step]]\nincrements = 10\nF = {{ 11 = 1.06 }}\nP = {{ 22 = 0, 33 = 0 }}"));
    let history = first(&path);
    assert_eq!((history.end, history.increments.len()), (End::Completed, 11));
}

#[test]
fn evaluation_errors_name_place_and_reason() {
    let inverted = failed(&format!("{HEAD}[[step]]\nname = \"crush\"\nincrements = 4\nF = {{ 33 = -1 }}"));
    assert!(inverted.starts_with("step 1 (crush), increment 2: ") && inverted.contains("determinant"), "{inverted}");
    let slip = failed(&format!("{HEAD}[[step]]\nP = {{ 12 = 10 }}"));
    assert!(slip.contains("P12") && slip.contains("F12 has no stiffness"), "{slip}");
    let expansion = failed(&format!("{HEAD}[[step]]\nP = {{ 22 = 100, 33 = 100 }}"));
    assert!(expansion.contains("no transverse expansion"), "{expansion}");
}

#[test]
fn input_errors_name_file_line_and_what_was_expected() {
    let step = "[[step]]\nF = { 11 = 1.01 }\n";
    let cases = [
        (
            format!("{HEAD}properties = {{ k_el = -3 }}\n{step}"),
            4,
            "(k_el, longitudinal elongation stiffness) is -3.0; allowed: a number from 0 to 1e25",
        ),
        (format!("{HEAD}properties = {{ p = 1 }}\n{step}"), 4, "allowed: a number > 1, at most 40"),
        (
            format!("{HEAD}properties = {{ k_e = 3 }}\n{step}"),
            4,
            "property \"k_e\", did you mean k_el?; allowed: k_el k_tc p",
        ),
        (
            format!("{HEAD}fibre = [0, 0, 0]\n{step}"),
            4,
            "(fibre direction) are 0.0, 0.0, 0.0; allowed: any vector but zero",
        ),
        (format!("{HEAD}fibre = [1, 0, 0, 0]\n{step}"), 4, "fibre is [1, 0, 0, 0]; allowed: a list of 3 numbers"),
        (format!("{HEAD}density = 0\n{step}"), 4, "density is 0; allowed: a finite number > 0"),
        (format!("{HEAD}frame = \"polar\"\n{step}"), 4, "options of the linear elastic law"),
        (format!("{HEAD}frame = \"pole\"\n{step}"), 4, "frame is \"pole\"; allowed: fibre, polar, spin"),
        (format!("{HEAD}[plot]\nabscissa = \"F14\"\n{step}"), 5, "allowed: a column of the table: time F11"),
        (format!("{HEAD}{step}F33 = 2\n"), 6, "unknown field `F33`"),
        (format!("{HEAD}[[step]]\nF = {{ 14 = 1.01 }}\n"), 5, "component F.14; allowed: 11 12 13"),
        (format!("{HEAD}[[step]]\nF = {{ 11 = \"free\" }}\n"), 5, "11 is \"free\"; allowed: a number or \"hold\""),
        (format!("{HEAD}[[step]]\nF = {{ 11 = nan }}\n"), 5, "F.11 is NaN; allowed: a finite number"),
        (format!("{HEAD}{step}P = {{ 11 = 0 }}\n"), 6, "prescribed both in F and in P"),
        (format!("{HEAD}{step}increments = 0\n"), 6, "increments is 0; allowed: 1 or more"),
        (format!("{HEAD}{step}increments = -1\n"), 6, "increments is -1; allowed: a whole number >= 0"),
        (format!("{HEAD}{step}duration = -1\n"), 6, "duration is -1; allowed: a finite number > 0"),
        (format!("{HEAD}{step}rotation = {{ axis = [0, 0, 0], angle = 1 }}\n"), 6, "any vector but zero"),
        (format!("{HEAD}{step}rotation = {{ axis = [0, 1], angle = 1 }}\n"), 6, "axis is [0, 1]; allowed: a list of 3"),
        (format!("{HEAD}{step}[[step]]\nname = \"idle\"\n"), 6, "the step does nothing"),
        (format!("{HEAD}{step}[[step]]\ncycles = 3\n"), 7, "a group of steps is not complete"),
        (
            format!("{HEAD}[[step]]\ncycles = 100000000\n[[step.step]]\nF = {{ 11 = 1 }}\n"),
            4,
            "more than 1000000 increments",
        ),
        (HEAD.to_string(), 1, "no [[step]]"),
        (format!("{HEAD}[[point]]\nname = \"a b\"\n{step}"), 5, "point \"a b\"; allowed: a name of its own"),
        (format!("{HEAD}[[point]]\nname = \"a\"\n[[point]]\nname = \"a\"\n{step}"), 7, "a name of its own"),
        (format!("units = \"mm-kg\"\n{step}"), 1, "unit system \"mm-kg\"; allowed: length-mass-time"),
        (
            format!("units = \"si\"\n[material]\npreset = \"kevlar\"\n{step}"),
            3,
            "preset \"kevlar\", did you mean kevlar-km2-600?; allowed: kevlar-km2-600",
        ),
        (format!("units = \"si\"\n{step}"), 1, "needs a preset, or a law"),
        (
            format!("units = \"si\"\n[material]\nlaw = \"hyperelastic\"\n{step}"),
            2,
            "property k_el (longitudinal elongation stiffness) is missing",
        ),
        (
            format!("units = \"si\"\n[material]\nlaw = \"linear-elastic\"\npreset = \"kevlar-km2-600\"\n{step}"),
            3,
            "preset \"kevlar-km2-600\" is of the law hyperelastic; allowed: hyperelastic",
        ),
        (format!("element = [1, 0, 1]\n{HEAD}{step}"), 1, "element is [1, 0, 1]; allowed: each a finite number > 0"),
        ("units = \"si\"\nsteps = [\n".to_string(), 2, ""),
    ];
    for (text, line, wanted) in cases {
        let message = rejected(&text);
        assert!(message.starts_with(&format!("path.toml:{line}: ")), "line {line} expected: {message}\n{text}");
        assert!(message.contains(wanted), "\"{wanted}\" expected: {message}\n{text}");
    }
}

#[test]
fn the_documentations_example_runs() {
    let document = include_str!("../../../../docs/guides/load-paths.md");
    let example = document.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("an example");
    let path = parse(example);
    assert_eq!(path.points.len(), 3);
    for history in run::run(&path, &|| {}) {
        assert_eq!(history.end, End::Completed);
        assert_eq!(history.increments.len(), 1 + 40 + 20 + 3 * 40);
        assert!(history.increments.iter().all(|increment| increment.answer.cauchy.iter().all(|s| s.is_finite())));
    }
}

/// Nothing resists a section that grows: where its sides are free, what Newton's method finds is one of many
/// equilibria, and that is said.
#[test]
fn a_section_that_grows_is_said() {
    let summary = |fibre: &str, sides: &str| {
        let text = format!(
            "units = \"mm-tonne-s\"\n[material]\npreset = \"kevlar-km2-600\"\n{fibre}properties = {{ k_ld = 10 }}\n\
             [[step]]\nincrements = 20\nF = {{ 11 = 1.02 }}\n{sides}"
        );
        let path = LoadPath::parse(Laws::Toron, "path.toml", &text).expect("a path");
        let histories = run::run(&path, &|| {});
        let area = histories[0].increments.last().map(|last| last.f.determinant() / last.f.column(0).norm());
        (report::summary(&path, &histories[0]), area.expect("an increment"))
    };
    let (off_axis, free) = ("fibre = [1, 0.1, 0]\n", "P = { 22 = 0, 33 = 0, 12 = 0, 13 = 0, 23 = 0 }\n");
    let (said, area) = summary(off_axis, free);
    assert!(area > 1.5 && said.contains("  section                has "), "{area} {said}");
    assert!(said.contains("the law does not resist a section that grows"), "{said}");
    for (fibre, sides) in [("", free), (off_axis, ""), (off_axis, "P = { 12 = 0 }\n")] {
        let (said, area) = summary(fibre, sides);
        assert!(area < 1.01 && !said.contains("section "), "{area} {said}");
    }
}
