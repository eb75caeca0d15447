use super::*;
use crate::v50::curve::Interval;
use crate::v50::curves_report::{figure, interval};
use crate::v50::designs::Design;
use crate::v50::limit::Limit;
use crate::v50::link::Link;
use crate::v50::scene::{Shot, YARN};
use crate::v50::shot::Ended;
use crate::v50::simulation::{Experiment, Truth};

fn said_of(keys: &str, ending: Ending) -> String {
    let scene = Scene::parse("yarn.toml", &format!("{YARN}{keys}"), None).expect("a scene");
    let shot = scene.shot(1, 100.0);
    let ended =
        Ended { ending, speed_at_end: 1.0, time: 0.4, verdict: "sound".to_string(), seconds: 1.0, ..Ended::of(shot) };
    let text = report(&scene, &Series::of(vec![ended], false, None), [5, 2], Path::new("there"));
    // It is folded to the terminal's width.
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

const STRENGTH: &str =
    "[scene.strength]\ncell = 0.8\nreference-length = 50.0\nweibull-modulus = 10.0\nstrain = 0.0458\nseed = 5\n";

fn yarn() -> Scene {
    Scene::parse("yarn.toml", YARN, None).expect("a scene")
}

/// Shots that were stopped at these speeds, and then some that went through at those, with what was left, and
/// errors with those messages.
fn series(stops: &[f64], perforations: &[[f64; 2]], errors: &[&str]) -> Series {
    let stopped = stops.iter().map(|&speed| (speed, Ending::Stopped, 0.0));
    let through = perforations.iter().map(|&[speed, left]| (speed, Ending::Through, left));
    let failed = errors.iter().map(|message| (100.0, Ending::Error(message.to_string()), 0.0));
    let shots = (1..).zip(stopped.chain(through).chain(failed)).map(|(number, (speed, ending, speed_at_end))| {
        let shot = Shot { number, nominal: speed, speed, aim: [0.0; 2], seed: None };
        Ended { ending, speed_at_end, time: 0.4, verdict: "sound".to_string(), seconds: 1.0, ..Ended::of(shot) }
    });
    Series::of(shots.collect(), false, None)
}

fn through(speeds: &[f64]) -> Vec<[f64; 2]> {
    speeds.iter().map(|&speed| [speed, 20.0]).collect()
}

fn printed(series: &Series) -> String {
    report(&yarn(), series, [0, 0], Path::new("there"))
}

/// Without values the columns of the intervals stand by themselves, and say what they are of.
#[test]
fn intervals_of_separated_shots_are_named() {
    let separated = series(&[100.0, 104.0, 108.0, 112.0], &through(&[116.0, 120.0, 124.0, 128.0]), &[]);
    let text = printed(&separated);
    let lines: Vec<&str> = text.lines().skip_while(|line| !line.starts_with("curve")).take(4).collect();
    let columns = |line: &str| {
        line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(str::to_string).collect::<Vec<_>>()
    };
    assert_eq!(columns(lines[0]), ["curve", "V5, 95 %", "V50, 95 %", "V95, 95 %", "slope, 95 %"]);
    let logit = columns(lines[3]);
    assert!(logit.len() == 5 && logit[4].ends_with("to unbounded"), "{logit:?}");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let wanted = "the fastest stop is at 112.0 mm/ms, the slowest perforation at 116.0 mm/ms. The curve may be a step anywhere between, \
                  whose slope is unbounded";
    assert!(text.contains(wanted), "{text}");
    // With values they stand beside them.
    let mixed = printed(&series(&[100.0, 104.0, 108.0, 118.0], &through(&[110.0, 120.0, 124.0, 128.0]), &[]));
    let heads = mixed.lines().find(|line| line.starts_with("curve")).map(columns).expect("a table");
    assert_eq!(heads[..4], ["curve", "V5", "V5, 95 %", "V50"]);
}

/// An interval without end is printed so, whichever speed's it is, and what that means.
#[test]
fn unbounded_intervals_are_explained() {
    let text = printed(&series(&[100.0, 120.0], &through(&[110.0, 130.0]), &[]));
    assert!(text.lines().any(|line| line.starts_with("logit") && line.contains("unbounded")), "{text}");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        text.contains("Intervals of V5, V50 and V95 are unbounded: the shots do not refuse curves so level"),
        "{text}"
    );
    assert_eq!(listed(&["V5"]), "V5");
    assert_eq!(listed(&["V5", "V95"]), "V5 and V95");
}

/// No speed below 0 is printed.
#[test]
fn speeds_below_zero_are_no_figures() {
    assert_eq!((figure(-345.6), figure(34.56)), ("below 0".to_string(), "34.56".to_string()));
    let of = |low, high| interval(&Interval { low, high });
    assert_eq!(of(Some(-3.0), Some(4.0)), "below 0 to 4.000");
    assert_eq!(of(Some(-3.0), Some(-1.0)), "below 0");
    assert_eq!((of(None, Some(4.0)), of(None, None)), ("unbounded to 4.000".to_string(), "unbounded".to_string()));
}

/// What errors say is in the report, once for the shots that share it; where there is no curve they come first.
#[test]
fn errors_are_told_with_their_shots() {
    let some = series(&[100.0, 104.0], &[], &["no memory", "no\nfile", "no memory"]);
    let text = printed(&some);
    assert!(text.contains("error of shots 3, 5: no memory\nerror of shot 4: no file\n"), "{text}");
    let error = no_curve(&yarn(), &some).expect("no curve").to_string();
    let wanted = "no curve: 0 shots are undecided, 3 ended with an error, and all others were stopped, the fastest at 104.0 mm/ms";
    assert!(error.starts_with(wanted), "{error}");
    let error = no_curve(&yarn(), &series(&[100.0], &[], &["no memory"])).expect("no curve").to_string();
    assert!(
        error.starts_with("no curve: 1 shots have a known fate, 0 are undecided, 1 ended with an error"),
        "{error}"
    );
}

/// What would help depends on how far the shots have come in the range, 20 to 300.
#[test]
fn one_fate_is_answered_by_what_would_help() {
    let of = |series: &Series| no_curve(&yarn(), series).expect("no curve").to_string();
    let error = of(&series(&[], &through(&[160.0, 120.0]), &[]));
    assert!(error.ends_with("allowed: more shots between 20 and 120.0, or a range that begins slower"), "{error}");
    let error = of(&series(&[], &through(&[160.0, 25.0]), &[]));
    assert!(error.ends_with("speeds = [20, 300]; allowed: a range that begins slower"), "{error}");
    let error = of(&series(&[120.0, 130.0], &[], &[]));
    let wanted = "allowed: more shots between 130.0 and 300, or a range that ends faster. Speeds are in mm/ms, of which one is 1 m/s";
    assert!(error.ends_with(wanted), "{error}");
}

/// Speeds at a decision are told from residual ones, and the cost up to it from that of the shots.
#[test]
fn speeds_at_the_decision_are_told() {
    let scene = Scene::parse("yarn.toml", YARN, None).expect("a scene");
    let shot = |number: usize, is: SpeedIs, decision: Option<[f64; 2]>| {
        let (ending, speed_is) = (Ending::Through, Some(is));
        Ended { ending, speed_at_end: 9.0, speed_is, decision, seconds: 3.0, ..Ended::of(scene.shot(number, 150.0)) }
    };
    let shots = vec![
        shot(1, SpeedIs::AtDecision, Some([9.0, 3.0])),
        shot(2, SpeedIs::Residual, Some([9.5, 2.0])),
        shot(3, SpeedIs::Residual, None),
    ];
    let text = speeds_and_costs(&Series::of(shots.clone(), false, None));
    let expected = "Speeds of the perforations: 2 residual, 1 at the decision. Processor time 9.0 s in all; the 2 decided \
                    shots took 5.0 s to their decisions.";
    assert_eq!(text.split_whitespace().collect::<Vec<_>>().join(" "), expected);
    assert_eq!(speeds_and_costs(&Series::of(shots[2..].to_vec(), false, None)), "");
}

/// A curve of residual speeds that is none is told with its reason.
#[test]
fn a_degenerate_curve_of_residual_speeds_is_not_told() {
    let jump = [[59.9924, 34.99], [59.9971, 40.62], [60.0, 38.23], [60.0047, 44.05], [60.0094, 41.13]];
    let text = printed(&series(&[50.0], &jump, &[]));
    assert!(
        text.contains("No curve of the residual speed of 5 perforations (Lambert and Jonas): the exponent"),
        "{text}"
    );
    assert!(!text.contains("v_r"), "{text}");
}

/// Where there are no curves there are no shares of them, and that is said.
#[test]
fn experiments_of_one_fate_have_no_shares() {
    let of = |v50: f64| {
        let experiment = Experiment { design: Design::Even, shots: 10, range: [60.0, 140.0], scatter: 1.0 };
        experiment.coverage(&Truth { link: Link::Logit, v50, deviation: 15.0 }, false, 20, 7)
    };
    let line = |design: &str, found: Coverage| (design.to_string(), "logit".to_string(), found);
    let text = simulated(&[line("even", of(400.0)), line("langlie", of(100.0))]);
    let cells: Vec<&str> = text.lines().nth(3).expect("a line").split_whitespace().collect();
    assert_eq!(cells, ["even", "logit", "-", "-", "-", "0.000", "0.000", "0.000", "1.000", "-", "-", "-"]);
    assert!(text.contains("All shots of an experiment often have one fate by even, so that"), "{text}");
    assert!(!simulated(&[line("even", of(100.0))]).contains("one fate by"));
}

/// A limit of yarns that scatter is that of one panel, and is not said to be without scatter.
#[test]
fn a_limit_says_of_which_strengths_it_is() {
    let found = Limit { bracket: [84.0, 100.0], not_monotone: None, shots: 9 };
    let of = |keys: &str| limit(&Scene::parse("yarn.toml", &format!("{YARN}{keys}"), None).expect("a scene"), &found);
    let text = of(STRENGTH);
    assert!(text.contains("With the strengths of seed 5: stopped at 84.00 mm/ms"), "{text}");
    assert!(text.contains("weibull-modulus = inf is without scatter") && !text.contains("Without scatter"), "{text}");
    for keys in [String::new(), STRENGTH.replace("= 10.0", "= inf")] {
        let text = of(&keys);
        assert!(text.contains("Without scatter: stopped at") && !text.contains("seed"), "{text}");
    }
}

/// A series says what its strengths are of, what it leaves out, and what that means.
#[test]
fn what_a_curve_is_of_is_said() {
    let text = said_of(STRENGTH, Ending::Undecided);
    for wanted in [
        "m = 10, cells of 0.8 mm, each shot with a seed of its own. Of the other half of a yarn, which symmetry leaves out",
        "Undecided shots are not missing at random",
        "a larger extension than 2 decides them",
        "5 of 6 have not been fired",
        "2 more in the table are not of this series",
    ] {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    let text = said_of("", Ending::Stopped);
    assert!(!text.contains("Strength") && !text.contains("at random"), "{text}");
}
