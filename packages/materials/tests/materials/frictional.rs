//! The law with friction against its truth through every C entry, as `toron eval --law frictional` calls them.

use std::io::Cursor;

use clap::ValueEnum;
use serde::Deserialize;
use toron::law::status;
use toron_materials::eval::command::Entry;
use toron_materials::eval::frictional::{evaluate, has_tangent};
use toron_test_support::truth::Truth;

const TABLE: &str = include_str!("../../../../tests/truth/friction.jsonl");
/// Errors are this many roundings at most, of the value and of what roundings of the input do to it.
const BOUND: f64 = 4.0;

#[derive(Deserialize)]
struct Case {
    id: usize,
    family: String,
    properties: Stiffness,
    /// d1, d2, I_te and w_fr before the first step.
    before: [f64; 4],
    path: Vec<[[f64; 3]; 3]>,
    after: Vec<After>,
}

#[derive(Deserialize)]
struct Stiffness {
    k_el: f64,
}

#[derive(Deserialize)]
struct After {
    sigma: [Truth; 6],
    i_tc: Truth,
    i_te: Truth,
    w_fr: Truth,
    slip: Option<[Truth; 2]>,
    slips: bool,
    margin: Truth,
    #[serde(rename = "K")]
    sensitivity: Sensitivity,
    ddsdde: Option<[[Truth; 6]; 6]>,
}

/// What a rounding of F, of the old slip and of the old I_te does, over a rounding.
#[derive(Deserialize)]
struct Sensitivity {
    sigma: Truth,
    slip: Option<Truth>,
    i_te: Truth,
    w_fr: Truth,
}

#[derive(Deserialize)]
struct Answer {
    after: Vec<Found>,
    status: i32,
    ddsdde: Option<[[f64; 6]; 6]>,
}

#[derive(Deserialize)]
struct Found {
    sigma: [f64; 6],
    i_te: f64,
    w_fr: f64,
    slip: [f64; 2],
}

fn answers(entry: Entry, tangent: bool) -> Vec<Answer> {
    let mut output = Vec::new();
    evaluate(entry, tangent, Cursor::new(TABLE), &mut output).expect("it reads and writes memory");
    let text = String::from_utf8(output).expect("UTF-8");
    text.lines().map(|line| serde_json::from_str(line).expect("an answer")).collect()
}

fn cases() -> Vec<Case> {
    TABLE.lines().map(|line| serde_json::from_str(line).expect("a case")).collect()
}

/// Components 4 to 6 of a stress count twice.
fn norm<const N: usize>(at: impl Fn(usize) -> f64) -> f64 {
    (0..N).map(|c| if N == 6 && c >= 3 { 2.0 } else { 1.0 } * at(c).powi(2)).sum::<f64>().sqrt()
}

impl Case {
    /// The worst error along the path, in roundings, and the number of flags that are wrong although the limit is not
    /// near.
    fn score(&self, answer: &Answer, rounding: f64, margin: f64, stress: bool) -> (f64, usize) {
        let (mut worst, mut wrong, mut sums) = (0.0_f64, 0, [0.0; 4]);
        // As the entry gets it.
        let before = self.before.map(|x| if rounding > 1e-12 { f64::from(x as f32) } else { x });
        let (mut old, mut lost) = ([before[0], before[1]], before[3]);
        assert_eq!(answer.after.len(), self.after.len(), "case {}", self.id);
        for (truth, found) in self.after.iter().zip(&answer.after) {
            let mut measure = |k: usize, sensitivity: &Truth, size: f64, error: f64| {
                sums[k] += sensitivity.value();
                worst = worst.max(if error == 0.0 { 0.0 } else { error / (rounding * (size + sums[k])) });
            };
            let After { sigma, i_te, w_fr, slip, sensitivity, .. } = truth;
            if stress {
                let error = norm::<6>(|c| sigma[c].error(found.sigma[c]));
                measure(0, &sensitivity.sigma, norm::<6>(|c| sigma[c].value()), error);
            }
            measure(1, &sensitivity.i_te, i_te.value().abs(), i_te.error(found.i_te));
            measure(2, &sensitivity.w_fr, w_fr.value().abs(), w_fr.error(found.w_fr));
            if let Some((slip, of_slip)) = slip.as_ref().zip(sensitivity.slip.as_ref()) {
                let error = norm::<2>(|c| slip[c].error(found.slip[c]));
                measure(3, of_slip, norm::<2>(|c| slip[c].value()), error);
            }
            let slid = found.slip != old || found.w_fr != lost;
            wrong += usize::from(truth.margin.value().abs() > margin && slid != truth.slips);
            (old, lost) = (found.slip, found.w_fr);
        }
        (worst, wrong)
    }

    /// How large F is where it is largest: a push-forward in the host magnifies the rounding of S by its square, and of
    /// dS/dE by its fourth power.
    fn size(&self) -> f64 {
        self.path.iter().flatten().flatten().fold(0.0, |largest, entry| entry.abs().max(largest))
    }
}

fn is_single(entry: Entry) -> bool {
    matches!(entry, Entry::LawF32 | Entry::LawWithPropertiesF32 | Entry::BlockF32 | Entry::VumatSp)
}

#[test]
fn every_entry_says_what_the_truth_says() {
    let cases = cases();
    for &entry in Entry::value_variants() {
        let single = is_single(entry);
        let (rounding, margin) = if single { (2.0_f64.powi(-24), 3e-4) } else { (2.0_f64.powi(-53), 1e-12) };
        let mut compared = 0;
        for (case, answer) in cases.iter().zip(answers(entry, false)) {
            // OpenRadioss computes its time step from the modulus at rest, which must not be 0.
            if entry == Entry::OpenRadioss && case.properties.k_el == 0.0 {
                assert_eq!(answer.status, status::BAD_ARGUMENT, "case {}", case.id);
                continue;
            }
            // Where single precision leaves a point on its side of the limit and of the kink at I_tc = 0.
            if single
                && (["small", "limit"].contains(&case.family.as_str()) || case.before[0].hypot(case.before[1]) > 500.0)
            {
                continue;
            }
            assert_eq!(answer.status, status::OK, "{entry:?}, case {}", case.id);
            // CalculiX gets S, which is pushed forward here.
            let stress = entry != Entry::CalculiX || case.size() < 3.0;
            let (worst, wrong) = case.score(&answer, rounding, margin, stress);
            assert!(worst <= BOUND && wrong == 0, "{entry:?}, {} {}: {worst}, {wrong}", case.family, case.id);
            compared += 1;
        }
        assert!(compared >= 60, "{entry:?}: {compared}");
    }
}

#[test]
fn every_tangent_is_that_of_the_truth() {
    let cases = cases();
    let entries = Entry::value_variants().iter().copied().filter(|&entry| has_tangent(entry) && !is_single(entry));
    for entry in entries {
        let pushed_forward = matches!(entry, Entry::CalculiX | Entry::Mgis);
        let mut compared = 0;
        for (case, answer) in cases.iter().zip(answers(entry, true)) {
            let Some(After { ddsdde: Some(truth), margin, i_tc, .. }) = case.after.last() else { continue };
            // At rest, at the limit and at the onset of compaction the tangent is what the kinks make of it.
            let near = |x: &Truth| x.value().abs() <= 1e-12;
            let kink = ["rest", "limit"].contains(&case.family.as_str()) || near(margin) || near(i_tc);
            if kink || (pushed_forward && case.size() >= 3.0) {
                continue;
            }
            let found = answer.ddsdde.expect("a tangent");
            // CalculiX takes the symmetric part.
            let value = |i: usize, j: usize| match entry {
                Entry::CalculiX => 0.5 * (truth[i][j].value() + truth[j][i].value()),
                _ => truth[i][j].value(),
            };
            let norm = |at: &dyn Fn(usize, usize) -> f64| norm::<36>(|k| at(k / 6, k % 6));
            let (size, error) = (norm(&value), norm(&|i, j| found[i][j] - value(i, j)));
            // What has no stiffness keeps CalculiX's system of equations solvable by one that is not the law's.
            if entry == Entry::CalculiX && size == 0.0 {
                continue;
            }
            // A loose section without cohesion has none, and 1e-40 of the stiffness in the truth.
            assert!(error <= 1e-12 * size + 1e-30, "{entry:?}, {} {}: {error:e} of {size:e}", case.family, case.id);
            compared += 1;
        }
        assert!(compared >= 48, "{entry:?}: {compared}");
    }
}

#[test]
fn lines_that_cannot_be_read_say_what_is_allowed() {
    for (line, said) in [
        ("{\"m\": [1, 0, 0], \"params\": {}}", "line 1: \"params\" lacks k_el"),
        ("{\"F\": [[1,0,0],[0,1,0],[0,0,1]], \"params\": {\"nu\": 1}}", "has the key \"nu\"; allowed: k_el, k_tc"),
        (
            "{\"F\": [[1,0,0],[0,1,0],[0,0,1]], \"cohesion\": 1, \"params\": {}}",
            "the key \"cohesion\" stands beside \"params\"; allowed: within it",
        ),
        (
            "{\"params\": {\"k_el\": 1, \"k_tc\": 1, \"p\": 2.2, \"k_td\": 1, \"mu\": 0.2}}",
            "\"F\" or \"path\" is missing, or both are there; allowed: one of them",
        ),
        (
            "{\"F\": [[1,0,0],[0,1,0],[0,0,1]], \"params\": {\"k_el\": 1, \"k_tc\": 1, \"p\": 2.2, \"k_td\": 1, \"mu\": 1}}",
            "(mu, friction of the section: sine of its angle of friction) is 1.0; allowed: a number from 0 to below 1",
        ),
    ] {
        let mut output = Vec::new();
        evaluate(Entry::Law, false, Cursor::new(line), &mut output).expect("it reads and writes memory");
        let text = String::from_utf8(output).expect("UTF-8").replace("\\\"", "\"");
        assert!(text.contains(said), "{text}");
    }
}
