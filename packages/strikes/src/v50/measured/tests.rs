use super::*;
use crate::v50::analysis::Analysis;
use crate::v50::curve::Asked;
use crate::v50::curves_report::{curves, said};

fn read(text: &str, choice: &Choice) -> Result<Measured, String> {
    let sheet = Sheet::parse("shots.csv", text).map_err(|error| error.to_string())?;
    Measured::of(&sheet, choice).map_err(|error| error.to_string())
}

#[track_caller]
fn shots(text: &str) -> Vec<(f64, bool)> {
    let measured = read(text, &Choice::default()).unwrap_or_else(|message| panic!("{text}: {message}"));
    measured.fates.iter().map(|fate| (fate.speed, fate.through)).collect()
}

/// One table in the forms that spreadsheets and machines give it.
#[test]
fn tables_of_any_form_are_the_same_shots() {
    let wanted = [(645.2, true), (612.0, false)];
    for text in [
        "speed (m/s),outcome\n645.2,pass\n612,stop\n",
        "Shot,Velocity [m/s],Result (P/C),Remark\n1,645.2,C,\n2,612,P,\"edge, fair\"\n",
        "sep=;\nShot;v / m/s;CP/PP\n1;645,2;CP\n2;612;PP\n",
        "Laboratory;A\nDate;2026-11-20\n\nNo.;Impact velocity;Outcome;\n;m/s;;\n1;645,2;complete;\n2;612;partial;\n",
        "striking speed m/s\tperforated?\n645.2\tyes\n612\tno\n",
        "shot,nominal_speed (m/s),speed (m/s),ending,residual_speed (m/s)\n1,640,645.2,through,3\n2,610,612,stopped,-\n",
        "Sample;speed (m/s);response\nA;645,2;1\nB;612;0\n;;\n",
    ] {
        assert_eq!(shots(text), wanted, "{text}");
    }
    let feet = read("v (ft/s),result\n1000,C\n900,P\n", &Choice::default()).expect("feet");
    let metres = feet.in_unit(&Unit::parse("m/s").expect("a unit"));
    assert!((metres.fates[0].speed - 304.8).abs() < 1e-12 && metres.unit.text == "m/s", "{metres:?}");
}

/// A shot that is left out stays in the table with its reason; one without a fate is counted.
#[test]
fn shots_are_left_out_with_a_reason() {
    let table = "speed (m/s),outcome,kept,reason\n645,pass,yes,\n,pass,no,no speed\n612,stop,1,\n600,undecided,y,\n";
    let measured = read(table, &Choice::default()).expect("shots");
    assert_eq!((measured.fates.len(), &measured.without_fate[..]), (2, &[(5, Some(600.0))][..]));
    assert_eq!(measured.left_out, [(3, "no speed".to_string())]);
    let measured = read("v (m/s),result,excluded\n645,C,\n650,C,yaw 7°\n612,P,-\n", &Choice::default()).expect("shots");
    assert_eq!((measured.fates.len(), &measured.left_out[..]), (2, &[(3, "yaw 7°".to_string())][..]));
    // By the word of the heading, and kept by its contrary.
    let table = "v (m/s),result,excluded\n645,C,excluded\n612,P,\n650,C,fair\n640,C,Unfair\n";
    let measured = read(table, &Choice::default()).expect("shots");
    assert_eq!((measured.fates.len(), measured.left_out.len()), (2, 2), "{measured:?}");
    // A column in which nobody has marked anything leaves nothing out; else a blank is neither yes nor no.
    assert_eq!(shots("v (m/s),result,fair\n645,C,\n612,P,\n").len(), 2);
    let message = read("v (m/s),result,fair\n645,C,x\n612,P,\n", &Choice::default()).expect_err("a blank");
    assert_eq!(message, "shots.csv:3:3: column \"fair\": the cell is \"\"; allowed: yes or no");
}

/// Rows without an outcome are listed with their lines, those without a speed too.
#[test]
fn rows_without_an_outcome_are_listed() {
    let table = "shot,speed (m/s),outcome\n1,645,pass\n2,630,\n3,612,stop\n4,,\n5,601,void\n";
    let measured = read(table, &Choice::default()).expect("shots");
    let told = Analysis::of(measured.fates.clone(), &Asked::default());
    let said = report::report(&measured, &told);
    assert!(said.contains("3 without a fate"), "{said}");
    assert!(said.contains("Without a fate, lines 3 (630.0 m/s), 5 (no speed), 6 (601.0 m/s)"), "{said}");
}

/// Yes and no of other languages, headings over several lines, and seconds by another name.
#[test]
fn tables_of_other_places_are_read() {
    let table = "Nr;\"Geschwindigkeit\n(m/sec)\";Ergebnis;gültig;Bemerkung\n1;645,5;durchschuss;ja;\n2;612;gestoppt;Nein;Rand\n\
                 3;620;gestoppt;ja;\"zwei\nZeilen\"\n4;621;gestoppt;ja;\n";
    let measured = read(table, &Choice::default()).expect("shots");
    assert_eq!((measured.fates.len(), &measured.left_out[..]), (3, &[(4, "Rand".to_string())][..]));
    assert_eq!(measured.unit.text, "m/sec");
    let metres = measured.in_unit(&Unit::parse("m/s").expect("a unit"));
    assert_eq!(metres.fates[0].speed, 645.5);
    // A line break in quotes takes its line.
    let message = read(&table.replace("621", "x"), &Choice::default()).expect_err("no number");
    assert!(message.starts_with("shots.csv:7:2: "), "{message}");
}

/// A table without shots says what one looks like.
#[test]
fn an_empty_table_is_shown_an_example() {
    let message = Measured::of(
        &Sheet::parse_like("shots.csv", "speed (m/s),outcome\n", EXAMPLE[0]).expect("a header"),
        &Choice::default(),
    );
    let message = message.expect_err("no shots").to_string();
    let wanted = "allowed: lines as \"645.2,pass\" below a header as \"speed (m/s),outcome\"";
    assert!(message.starts_with("shots.csv:1:1: ") && message.ends_with(wanted), "{message}");
    let message = Sheet::parse_like("shots.csv", " \n", EXAMPLE[0]).expect_err("nothing").to_string();
    assert_eq!(message, "shots.csv:1:1: no header; allowed: columns as in \"speed (m/s),outcome\"");
}

/// What rounding leaves of two equal tables is no deviance.
#[test]
fn equal_shots_have_no_deviance() {
    let shots = [(600.0, false), (612.5, true), (610.0, false), (618.0, true), (622.3, false), (630.0, true)];
    let told = told(&shots, false);
    for link in crate::v50::link::Link::BOTH {
        let found = compare::Difference::of(&told, &told, link).expect("curves");
        assert_eq!((found.one_v50, found.one_curve), ([0.0, 1.0], [0.0, 1.0]));
    }
}

/// Of many kinds a few are named.
#[test]
fn many_kinds_are_counted() {
    let rows: String =
        (0..2_000).map(|i| format!("{i},{}.{:02},{}\n", 500 + i / 100, i % 100, ["P", "C"][i % 2])).collect();
    let measured = read(&format!("projectile,v (m/s),result\n{rows}"), &Choice::default()).expect("shots");
    assert_eq!(measured.fates.len(), 2_000);
    assert!(measured.notes[1].contains("(0, 1, 2, 3, 4, 5 and 1994 more)"), "{}", measured.notes[1]);
}

/// Shots of several plies are told apart, and one kind of them can be chosen.
#[test]
fn kinds_of_shots_are_chosen() {
    let table = "speed (m/s),outcome,plies\n645,pass,20\n612,stop,20\n700,pass,24\n660,stop,24\n";
    let all = read(table, &Choice::default()).expect("shots");
    let warning = "warning: \"plies\" differs among the shots (20, 24); one V50 is of one of them: --only \"plies=20\"";
    assert_eq!(all.notes[1], warning);
    let only = |value: &str| Choice { only: vec![("Plies".to_string(), value.to_string())], ..Choice::default() };
    let some = read(table, &only("24")).expect("shots");
    assert_eq!((some.fates.len(), some.notes.len()), (2, 1));
    let message = read(table, &only("30")).expect_err("none");
    assert_eq!(message, "shots.csv: --only: no line has Plies=30; allowed: what stands in the table");
}

/// What could be read in two ways is refused, at its place.
#[test]
fn what_is_ambiguous_is_refused_at_its_place() {
    let choice = |speed: Option<&str>, outcome: Option<&str>| Choice {
        speed: speed.map(String::from),
        outcome: outcome.map(String::from),
        ..Choice::default()
    };
    let none = choice(None, None);
    for (text, wanted) in [
        (
            "speed (m/s),outcome\n645,P\n612,P\n",
            "2:2: column \"outcome\": the cell is \"p\", which is partial for some",
        ),
        (
            "speed (m/s),outcome\n645,pass\n612,fail\n",
            "3:2: column \"outcome\": the cell is \"fail\", of the armour, or",
        ),
        ("speed,outcome\n645,pass\n612,stop\n", "1:1: the heading \"speed\" has no unit; allowed: \"speed (m/s)\", or"),
        ("speed (mm),outcome\n645,pass\n", "1:1: the heading \"speed (mm)\" is no unit of speed; allowed:"),
        (
            "v (m/s),velocity (m/s),outcome\n645,645,pass\n",
            "1:2: v (m/s), velocity (m/s) could each be the speed; allowed:",
        ),
        ("v (m/s),left\n645,pass\n", "1:1: no column is the outcome; there are: v (m/s), left; allowed: a heading as"),
        ("v (m/s),result\n645,C\n#WERT!,P\n612,P\n", "3:1: column \"v\": the line begins with #: a comment, a number"),
        ("v (m/s),result\n-5,C\n", "2:1: column \"v\": the cell is \"-5\"; allowed: a speed above 0"),
        (
            "v (m/s);result\n645,2;C\n1.645,2;P\n",
            "3:1: column \"v\": the cell is \"1.645,2\"; allowed: a finite number with",
        ),
        (
            "v (ft/s);result\n985;P\n1,012;P\n2,145;C\n",
            "3:1: column \"v\": the cell is \"1,012\", a fraction or thousands; allowed: speeds without",
        ),
        ("v (ft/s),result\n1.985,P\n2.145,C\n", "2:1: column \"v\": the cell is \"1.985\", a fraction or thousands;"),
        ("V0;Result;residual velocity (m/s)\n645;C;120\n", "1:1: no column is the speed; there are: V0, Result,"),
        ("v (m/s),pass/stop\n645,1\n612,0\n", "2:2: column \"pass/stop\": the cell is \"1\", under \"pass/stop\";"),
        (
            "v (m/s),result\n645 m/s,C\n645,P\n",
            "2:1: column \"v\": the cell is \"645 m/s\"; a unit in a cell; units belong",
        ),
    ] {
        let message = read(text, &none).expect_err(text);
        assert!(message.trim_start_matches("shots.csv:").starts_with(wanted), "{message}");
    }
    assert_eq!(shots("v (km/s),result\n1.012,P\n1.145,C\n"), [(1.012, false), (1.145, true)]);
    assert_eq!(shots("v (m/s),result\n645.125,P\n712.250,C\n"), [(645.125, false), (712.25, true)]);
    let two = "v1 (m/s),v2 (m/s),a\n645,650,pass\n612,613,stop\n";
    assert_eq!(read(two, &choice(Some("v2"), Some("a"))).expect("chosen").fates[0].speed, 650.0);
    let message = read(two, &choice(Some("v3"), Some("a"))).expect_err("none");
    assert_eq!(message, "shots.csv:1: --speed: no column \"v3\"; there are: v1 (m/s), v2 (m/s), a");
}

/// A curve that falls is no answer without a word.
#[test]
fn words_the_wrong_way_round_are_noticed() {
    let lines = "v (m/s),result\n600,C\n610,C\n605,P\n640,P\n650,P\n";
    let notes = read(lines, &Choice::default()).expect("shots").notes;
    assert!(notes[1].starts_with("warning: the perforations were slower than the stops"), "{notes:?}");
    let other = Choice { through: Some("P".to_string()), ..Choice::default() };
    assert_eq!(read(lines, &other).expect("shots").notes.len(), 1);
}

/// Shots of which no curve can be made end in a sentence.
#[test]
fn degenerate_tables_end_in_sentences() {
    let of = |lines: &str| {
        let measured = read(&format!("v (m/s),result,kept\n{lines}"), &Choice::default()).expect("a table");
        let told = Analysis::of(measured.fates.clone(), &Asked::default());
        report::no_curve(&measured, &told).map(|error| error.to_string())
    };
    for (lines, wanted) in [
        (
            "600,stop,yes\n610,stop,yes\n",
            "all shots were stopped, the fastest at 610.0 m/s; allowed: a perforation, by",
        ),
        (
            "600,through,yes\n610,through,yes\n",
            "all shots went through, the slowest at 600.0 m/s; allowed: a stop among",
        ),
        ("600,stop,yes\n", "one shot is kept that has a fate; allowed: two or more, a stop and a perforation"),
        ("600,stop,no\n610,pass,no\n", "no shot is kept that has a fate; allowed: two or more"),
        ("600,stop,yes\n600,pass,yes\n", "all shots have one speed, 600.0 m/s; allowed: several speeds"),
    ] {
        let message = of(lines).expect("no curve");
        assert!(message.starts_with(&format!("shots.csv: no curve: {wanted}")), "{message}");
    }
    assert_eq!(of("600,stop,yes\n610,pass,yes\n"), None);
}

fn told(shots: &[(f64, bool)], firth: bool) -> Analysis {
    let fates = shots.iter().map(|&(speed, through)| Fate { speed, through }).collect();
    Analysis::of(fates, &Asked { firth, ..Asked::default() })
}

/// Separated shots are told their gap and no value; Firth's curve comes on request, and is marked.
#[test]
fn a_penalty_is_told_from_the_shots() {
    let shots = [(600.0, false), (605.0, false), (610.0, false), (618.0, true), (622.0, true), (630.0, true)];
    let text = |firth: bool| {
        let told = told(&shots, firth);
        let text = curves(&told, "m/s", crate::v50::curves_report::Steepness::Scale) + &said(&told, "m/s");
        (text.split_whitespace().collect::<Vec<_>>().join(" "), told)
    };
    let (plain, _) = text(false);
    assert!(plain.contains("the fastest stop is at 610.0 m/s, the slowest perforation at 618.0 m/s"), "{plain}");
    assert!(!plain.to_lowercase().contains("firth"), "{plain}");
    let (penalised, told) = text(true);
    assert!(
        penalised.contains("probit, Firth (penalised)") && penalised.contains("by their penalty, not by the shots")
    );
    assert!(told.curves.len() == 4 && told.drawn(crate::v50::link::Link::Probit).is_some_and(|curve| !curve.firth));
    // A stop and a perforation at one speed, and nothing else that mixes.
    let tie = said(&self::told(&[(600.0, false), (610.0, false), (610.0, true), (620.0, true)], false), "m/s");
    assert!(tie.starts_with("The fastest stop and the slowest perforation have one speed, 610.0 m/s"), "{tie}");
    let level = said(&self::told(&[(600.0, true), (610.0, true), (620.0, false), (630.0, false)], false), "m/s");
    assert!(level.starts_with("No curve that rises with the speed suits the shots"), "{level}");
}
