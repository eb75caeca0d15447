use super::*;
use clap::Parser;
use toron_materials::data_table::sheet::Sheet;

#[derive(Parser)]
struct Line {
    #[command(flatten)]
    arguments: crate::v50::command::Arguments,
}

/// The answer to a table, on one line, or the error.
fn answer(text: &str, words: &str) -> Result<String, String> {
    let words: Vec<&str> = ["v50", "shots.csv"].into_iter().chain(words.split_whitespace()).collect();
    let Line { arguments } = Line::try_parse_from(words).map_err(|error| error.to_string())?;
    let (measured, next) = (&arguments.measured, &arguments.next);
    let asked = next.checked(&measured.percentile).map_err(|error| error.to_string())?;
    let sheet = Sheet::parse_like("shots.csv", text, "").map_err(|error| error.to_string())?;
    let choice = measured.choice().map_err(|error| error.to_string())?;
    let planned = Planned::of(&sheet, &choice, next.asked.as_deref()).map_err(|error| error.to_string())?;
    of_the_range(&planned, asked.range).map_err(|error| error.to_string())?;
    Ok(said(&planned, &asked).split_whitespace().collect::<Vec<_>>().join(" "))
}

const POD: &str = "--next 1 --design 3pod --range 0.5 22.5 --guess 3";

#[track_caller]
fn assert_said(text: &str, words: &str, wanted: &[&str]) {
    let said = answer(text, words).unwrap_or_else(|message| panic!("{message}"));
    for wanted in wanted {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
}

/// A heading alone gives the first shot, and the table of an experiment the state that it has come to.
#[test]
fn a_table_has_its_next_shot() {
    let head = "asked (m/s),speed (m/s),outcome\n";
    assert_said(
        head,
        POD,
        &["0 shots fired", "quarter and three quarters of the range", "shot fire at number m/s ------ ------- 1 6"],
    );
    let shots = format!("{head}6,6.1,stop\n17,17,pass\n");
    assert_said(
        &shots,
        POD,
        &[
            "2 shots fired: 1 stopped, 1 through; 0 still to be fired",
            "Asked speed: column 1, \"asked (m/s)\".",
            "phase I, search for a mixed zone: The results do not mix: between the fastest stop at 6.100 m/s and the slowest \
             perforation at 17.00 m/s there is a gap",
            "3 11.55",
        ],
    );
    assert_said(&shots, &POD.replace("3pod", "langlie"), &["halfway between the last shot and that one", "3 11.55"]);
    // By the asked speed, not by the measured one.
    let stepped = format!("{head}6,6.1,stop\n");
    assert_said(
        &stepped,
        &POD.replace("3pod", "up-and-down"),
        &["After a stop of a shot for 6.000 m/s a step up", "2 9"],
    );
    assert_said(&stepped.replace("asked", "x"), &POD.replace("3pod", "up-and-down"), &["(--asked COLUMN)", "2 9.1"]);
    let named = format!("{} --asked x", POD.replace("3pod", "up-and-down"));
    assert_said(&stepped.replace("asked (m/s)", "x (km/s)").replace("6,6.1", "0.006,6.1"), &named, &["2 9"]);
}

/// What was asked for and is not fired is the first of the batch; what has no fate is told.
#[test]
fn shots_still_to_be_fired_are_told() {
    let table = "asked (m/s),speed (m/s),outcome\n6,6,stop\n17,17,pass\n11.5,11.7,void\n11.5,,\n";
    let none =
        "1 shot is still to be fired, line 5 at 11.50 m/s: they count as the first of the batch, and no further one";
    assert_said(table, POD, &["1 still to be fired, 1 without a fate", "Without a fate, line 4", none]);
    let three = POD.replace("--next 1", "--next 3");
    assert_said(
        table,
        &three,
        &["and 2 more make 3", "No result of the batch is known yet", "shot fire at number m/s"],
    );
    let one = "speed (m/s),outcome\n6,stop\n17,pass\n11.5,\n";
    assert_said(one, POD, &["1 shot is still to be fired, line 4 at 11.50 m/s"]);
}

/// Batches say by which rule they are chosen, before results mix and after.
#[test]
fn batches_say_what_they_do() {
    let two = POD.replace("--next 1", "--next 2");
    let gap = "speed (m/s),outcome\n6,stop\n17,pass\n";
    assert_said(gap, &two, &["No two are nearer than a twentieth of σ.", "as if V50 were 11.50 m/s and σ 3.000 m/s"]);
    assert_said(gap, &two.replace("3pod", "up-and-down"), &["2 series go on side by side"]);
    let mixed = "speed (m/s),outcome\n6,stop\n17,pass\n11,pass\n13,stop\n12,pass\n14,pass\n";
    assert_said(
        mixed,
        &two.replace("3pod", "d-optimal"),
        &["The results mix: a shot tells most", "counts as fired for the next"],
    );
    let third = format!("{two} --percentile 90 --first-phases 6");
    let pod = mixed.replace("12,pass\n14,pass", "13.5,pass\n10.5,stop");
    assert_said(&pod, &third, &["phase III: The speed at which 90.00 of 100 shots go through", "about one speed"]);
    let coarse = format!("{} --resolution 4", two.replace("--next 2", "--next 5"));
    let said = answer(gap, &coarse).expect("speeds");
    assert!(said.contains("by the resolution they are 4 m/s or more apart"), "{said}");
    let mut speeds: Vec<f64> = said.rsplit(' ').step_by(2).take(5).map(|word| word.parse().expect("a speed")).collect();
    speeds.sort_by(f64::total_cmp);
    assert!(speeds.windows(2).all(|pair| pair[1] - pair[0] >= 4.0 && pair[0] % 4.0 == 0.0), "{said}");
}

/// Shots of which nothing follows end in a sentence, not in a number that is none.
#[test]
fn degenerate_tables_have_an_answer() {
    for lines in [
        "10,stop\n10,pass\n",
        "10,stop\n10,stop\n10,pass\n10,pass\n",
        "12,pass\n10,pass\n14,stop\n16,stop\n",
        "10,pass\n14,stop\n10,pass\n14,stop\n10,pass\n14,stop\n10,pass\n14,stop\n",
        "11,through\n0.01,through\n0.01,through\n0.01,through\n",
        "11,stop\n1e6,stop\n1e6,stop\n",
    ] {
        for design in ["langlie", "up-and-down", "d-optimal", "3pod"] {
            for size in ["1", "3"] {
                let words = format!("--next {size} --design {design} --range 0.5 22.5 --guess 3");
                let said = answer(&format!("speed (m/s),outcome\n{lines}"), &words).expect("speeds");
                assert!(!said.contains("NaN") && !said.contains("inf"), "{design} {lines}: {said}");
                let speed: f64 = said.rsplit(' ').next().and_then(|word| word.parse().ok()).expect("a speed");
                assert!(speed >= 0.05, "{said}");
            }
        }
    }
    let flat = "speed (m/s),outcome\n12,pass\n10,pass\n14,stop\n16,stop\n17,stop\n";
    assert_said(
        flat,
        &POD.replace("3pod", "d-optimal"),
        &["by the estimate, level curve", "no curve that rises suits them", "V50 at 17.00 m/s and a σ of 7.000 m/s"],
    );
}

/// Wrong options are told with what is allowed.
#[test]
fn wrong_options_are_refused() {
    let rest = "--design 3pod --range 10 70 --guess 3";
    for (words, wanted) in [
        (format!("--next 0 {rest}"), "--next is 0; allowed: 1 to 20 shots"),
        (format!("--next 21 {rest}"), "--next is 21; allowed: 1 to 20 shots"),
        ("--next 1 --range 1 2".to_string(), "--next without --design; allowed: --design and one of langlie,"),
        ("--next 1 --design neyer --range 1 2".to_string(), "--design is neyer; allowed: langlie, up-and-down,"),
        ("--next 1 --design langlie".to_string(), "--next without --range; allowed: --range LOW HIGH"),
        ("--next 1 --design langlie --range 7 5".to_string(), "--range is 7 5; allowed: the slow and then the fast"),
        ("--next 1 --design langlie --range -7 5".to_string(), "--range is -7 5; allowed: the slow and then"),
        (format!("--next 1 {rest}").replace("guess 3", "guess 11"), "--guess is 11; allowed: up to 10, a sixth of"),
        (format!("--next 1 {rest}").replace("guess 3", "guess 0"), "--guess is 0; allowed: above 0, up to 60, the"),
        (format!("--next 1 {rest} --resolution -1"), "--resolution is -1; allowed: above 0, up to 60"),
        (format!("--next 1 {rest} --percentile 99.9"), "--percentile is 99.9; allowed: one, from 1 to 99"),
        (format!("--next 1 {rest} --percentile 5 95"), "--percentile is 5 95; allowed: one, from 1 to 99"),
        (format!("--next 1 {rest} --first-phases 9"), "--first-phases is 9; allowed: with --design 3pod and"),
        (
            "--next 1 --design langlie --range 1 2 --percentile 90".to_string(),
            "--percentile is 90; allowed: with --design 3pod",
        ),
        (format!("--next 1 --analyse x {rest}"), "cannot be used with"),
        ("--design 3pod".to_string(), "required"),
    ] {
        let message = answer("speed (m/s),outcome\n", &words).expect_err(wanted);
        assert!(message.contains(wanted), "{words}: {message}");
    }
    let message = answer("speed (m/s),outcome\n", &format!("{POD} --asked v")).expect_err("no column");
    assert_eq!(message, "shots.csv:1: --asked: no column \"v\"; there are: speed (m/s), outcome");
}

/// A range in another unit, or of other shots, would be passed over once there is an estimate.
#[test]
fn a_range_without_a_shot_is_refused() {
    let shots = "v (m/s),outcome\n610,stop\n625,pass\n640,stop\n650,pass\n";
    let words = |range: &str| format!("--next 1 --design d-optimal --range {range} --guess 10");
    let message = answer(shots, &words("100 400")).expect_err("a range of other shots");
    let wanted = "--range is 100 400, and the shots of shots.csv are from 610 to 650 m/s; allowed: a range in m/s with one of them at least";
    assert_eq!(message, wanted);
    assert!(answer(shots, &words("650 750")).is_ok());
    for lines in ["0.01,through\n0.01,through\n0.01,through\n", "1e6,stop\n1e6,stop\n"] {
        let message = answer(&format!("speed (m/s),outcome\n{lines}"), POD).expect_err("speeds far off");
        assert!(message.starts_with("--range is 0.5 22.5, and the shots of shots.csv are from"), "{message}");
    }
}
