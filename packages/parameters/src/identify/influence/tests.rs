use super::*;
use crate::identify::data::{Axis, DataSet, Loading};
use crate::identify::parameter::{PARAMETERS, Parameter};
use toron::host::units::UnitSystem;

/// Failure points of yarns that fail at 4 %, with a scatter of 0.1 %.
fn points(name: &str, count: usize, seed: u64) -> DataSet {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut normal = || (0..12).map(|_| random.f64() - 0.5).sum::<f64>();
    let failed = (0..count).map(|_| 0.04_f64.ln_1p() + 1e-3 * normal()).collect();
    let axis = |name: &str, values| Axis { name: name.to_string(), unit: "-".to_string(), values };
    DataSet {
        name: name.to_string(),
        place: String::new(),
        declared: String::new(),
        loading: Loading::Failure { compaction: vec![0.0; count], distortion: vec![0.0; count] },
        abscissa: axis("-I_tc", (0..count).map(|i| i as f64).collect()),
        ordinate: axis("I_el at failure", failed),
        rest: 0.0,
        deviations: None,
        weight: 1.0,
        fits: vec![Parameter::EpsLim],
        toe: None,
    }
}

fn notes_of(sets: Vec<DataSet>) -> Vec<String> {
    let problem = Problem {
        sets,
        units: UnitSystem::SI,
        density: None,
        known: [None; PARAMETERS],
        fallback: [None; PARAMETERS],
        known_deviations: Vec::new(),
        start: [1.0, 1.0, 2.0, 1.0, 0.0, 0.05, 0.0, 0.0],
    };
    super::notes(&problem, &problem.fit().expect("a fit"))
}

#[test]
fn a_point_that_decides_is_named() {
    let mut set = points("pull", 20, 1);
    set.ordinate.values[7] = 0.02;
    let notes = notes_of(vec![set]);
    let begin = "eps_lim is decided by one point of pull, at -I_tc 7.000: without it eps_lim is 0.039";
    assert!(notes.len() == 1 && notes[0].starts_with(begin), "{notes:?}");
}

#[test]
fn a_set_that_decides_is_named() {
    let mut sets: Vec<DataSet> = (1..=3).map(|seed| points(&format!("pull-{seed}"), 20, seed)).collect();
    // With a noise that is known: one that is not makes such a set count for little.
    sets.iter_mut().for_each(|set| set.deviations = Some(vec![1e-3; 20]));
    sets[1].ordinate.values.iter_mut().for_each(|value| *value += 0.01);
    let notes = notes_of(sets);
    assert!(notes.iter().any(|note| note.starts_with("eps_lim is decided by data set pull-2: without")), "{notes:?}");
}

/// Of tests that are alike one is hardly ever named: where there are five, in less than one of twenty cases.
#[test]
fn noise_decides_nothing() {
    for (count, most) in [(5, 10), (20, 0)] {
        let named = (0..200).filter(|&seed| !notes_of(vec![points("pull", count, seed)]).is_empty()).count();
        assert!(named <= most, "{named} of 200 with {count} points");
    }
}
