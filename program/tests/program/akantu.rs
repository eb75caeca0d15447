//! The yarn under impact in Akantu, a finite-element program with eight integration points in a hexahedron that calls
//! the law as a material in Python (`ffi-tests/akantu/impact.py`), against `toron impact` on the same mesh and against
//! theory.

use std::path::Path;

use toron_strikes::impact::run;
use toron_strikes::impact::scene::Scene;
use toron_test_support::library::ROOT;
use toron_test_support::python;

/// Layers, rows, columns and the step.
const COARSE: [&str; 4] = ["50", "2", "4", "6e-6"];

/// What the program prints after `name`, a line each.
fn numbers(text: &str, name: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter_map(|line| line.strip_prefix(name));
    lines.map(|line| line.split_whitespace().map(|number| number.parse().expect("a number")).collect()).collect()
}

fn impact(failure: &str) -> String {
    let text = python::program("akantu/impact.py", &[&[failure], &COARSE[..]].concat());
    print!("{text}");
    text
}

#[test]
fn without_failure_speeds_and_wave_are_those_of_the_host() {
    let scene = Scene::read(&Path::new(ROOT).join("ffi-tests/akantu/yarn.toml")).expect("the scene is valid");
    let case = scene.cases.iter().find(|case| case.name == "coarse").expect("the case exists");
    let expected = run::run(case, &mut ()).expect("the case runs");
    let text = impact("none");
    let speeds = numbers(&text, "speed");
    assert_eq!(speeds.len(), 3);
    for row in speeds {
        let [time, speed] = row[..] else { panic!("{row:?}") };
        // The scene's history is finer than what is measured on the way.
        let sample = expected.history.iter().find(|sample| sample.time >= time * (1.0 - 1e-9)).expect("a sample");
        println!("at {time} ms: Akantu {speed:.2} m/s, toron impact {:.2} m/s", sample.speed);
        assert!((sample.time - time).abs() < 2e-5 && (speed - sample.speed).abs() < 1.0);
    }
    let [speed, theory] = numbers(&text, "wave")[0][..] else { panic!("{text}") };
    assert!((speed / theory - 1.0).abs() < 0.02, "{speed} m/s along the fibre, {theory} in theory");
}

#[test]
fn elements_that_have_failed_carry_nothing() {
    let text = impact("multiaxial");
    let [count, stress, nodes, force] = numbers(&text, "failed")[0][..] else { panic!("{text}") };
    assert!(count >= 4.0 && nodes >= 4.0, "the yarn breaks: {text}");
    assert!(stress == 0.0 && force == 0.0, "{text}");
    let [_, stress, force] = numbers(&text, "intact")[0][..] else { panic!("{text}") };
    assert!(stress > 100.0 && force > 0.1, "{text}");
}
