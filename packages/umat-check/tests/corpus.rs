//! `umat-check` on the laws of `ffi-tests/check`: those that are right are called right with any properties, and each
//! fault is found and called by its name.

mod support;

use std::path::Path;

use fastrand::Rng;
use serde::Deserialize;
use serde_json::Value;
use support::{ROOT, changed, check, corpus, parse};
use toron_test_support::update::is_asked;

/// The lines that depend on the properties, and take little time.
const OF_PROPERTIES: &str = "--only=rest,tangent,objectivity,isotropy,steps,energy,cycles,dissipation";
const DOCUMENT: &str = "docs/results/check.md";
/// The lines of the report that are not right: name, verdict, kinds, text.
struct Complaint {
    line: String,
    verdict: String,
    kinds: Vec<String>,
    text: String,
}

fn complaints(report: &Value) -> Vec<Complaint> {
    let lines = report["materials"].as_array().expect("materials").iter().flat_map(|material| {
        let lines = material["lines"].as_array().expect("lines");
        assert!(!lines.is_empty());
        lines
    });
    let text = |value: &Value| value.as_str().expect("text").to_string();
    let is_one = |line: &&Value| ["wrong", "ended", "warning"].iter().any(|verdict| line["verdict"] == *verdict);
    let complaints = lines.filter(is_one).map(|line| Complaint {
        line: text(&line["line"]),
        verdict: text(&line["verdict"]),
        kinds: line["kinds"].as_array().expect("kinds").iter().map(text).collect(),
        text: text(&line["text"]),
    });
    complaints.collect()
}

fn listed(complaints: &[Complaint]) -> String {
    complaints.iter().map(|c| format!("\n  {} {}: {:?} {}", c.verdict, c.line, c.kinds, c.text)).collect()
}

// ---- the laws that are right

type Ranges = std::collections::BTreeMap<String, Vec<[f64; 2]>>;

/// One value of each range: uniform, or uniform in the logarithm where the ends have a ratio above 10.
fn draw(ranges: &[[f64; 2]], random: &mut Rng) -> Vec<f64> {
    let value = |&[low, high]: &[f64; 2]| match low > 0.0 && high > 10.0 * low {
        true => low * (high / low).powf(random.f64()),
        false => low + (high - low) * random.f64(),
    };
    ranges.iter().map(value).collect()
}

/// What is called wrong, or warned of, in a law that is right.
fn alarm(law: &str, arguments: &[String]) -> String {
    let (code, report) = check(&corpus("laws").join(law), arguments);
    let found = complaints(&report);
    if code == 0 && found.is_empty() {
        return String::new();
    }
    format!("{law} {}: exit {code}{}\n", arguments.join(" "), listed(&found))
}

fn laws() -> Ranges {
    let laws: Ranges = parse("properties.toml");
    assert_eq!(laws.len(), 12);
    laws
}

/// The alarms of random sets of properties.
fn alarms_of_sets(sets: usize, lines: &[&str]) -> String {
    let mut alarms = String::new();
    for (law, ranges) in &laws() {
        let mut random = Rng::with_seed(36);
        for set in 1..=sets {
            let values: Vec<String> = draw(ranges, &mut random).iter().map(f64::to_string).collect();
            let mut arguments = vec![format!("--seed={set}"), format!("--props={}", values.join(","))];
            arguments.extend(lines.iter().map(ToString::to_string));
            alarms += &alarm(law, &arguments);
        }
    }
    alarms
}

/// Lines that every law has to be right in: a check that is sure of nothing raises no alarm either.
const REQUIRED: [&str; 8] = ["memory", "rest", "tangent", "objectivity", "repeat", "threads", "histories", "steps"];

/// What is not right of a law that is right: of those lines all but right, of others what is neither right nor left
/// out.
fn shortcomings(law: &str) -> String {
    let (code, report) = check(&corpus("laws").join(law), &[]);
    let lines = report["materials"][0]["lines"].as_array().expect("lines");
    let verdict = |name: &str| {
        let line = lines.iter().find(|line| line["line"] == name);
        line.unwrap_or_else(|| panic!("{law}: no line {name}"))["verdict"].as_str().expect("text")
    };
    let required = REQUIRED.iter().filter(|name| verdict(name) != "right");
    let missing: String = required.map(|name| format!("\n  {name}: {}", verdict(name))).collect();
    let allowed = ["right", "not asked", "not reported"];
    let others = lines.iter().filter(|line| !allowed.iter().any(|allowed| line["verdict"] == *allowed));
    let others: String = others.map(|line| format!("\n  {line}")).collect();
    match code == 0 && missing.is_empty() && others.is_empty() {
        true => String::new(),
        false => format!("{law}: exit {code}{missing}{others}\n"),
    }
}

#[test]
fn right_laws_are_right() {
    let found: String = laws().keys().map(|law| shortcomings(law)).collect();
    assert!(found.is_empty(), "not right:\n{found}");
}

#[test]
fn right_laws_with_other_properties_raise_no_alarm() {
    let alarms = alarms_of_sets(2, &[OF_PROPERTIES]);
    assert!(alarms.is_empty(), "false alarms:\n{alarms}");
}

#[test]
#[ignore = "takes minutes"]
fn right_laws_with_twenty_sets_of_properties_raise_no_alarm() {
    let alarms = alarms_of_sets(20, &[]);
    assert!(alarms.is_empty(), "false alarms:\n{alarms}");
}

// ---- the faults

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Faults {
    fault: Vec<Fault>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fault {
    /// The file of the right law.
    law: String,
    /// What the fault has to be called.
    kind: String,
    /// The line that has to find it; any, where a process ends.
    line: Option<String>,
    /// In words, for the document.
    what: String,
    #[serde(default)]
    arguments: Vec<String>,
    /// What is replaced by what; occurs once.
    change: Vec<[String; 2]>,
}

impl Fault {
    /// The row of the document's table, or what was found in its place.
    fn row(&self, number: usize) -> Result<[String; 4], String> {
        let only = self.line.iter().map(|line| format!("--only={line}"));
        let arguments: Vec<String> = self.arguments.iter().cloned().chain(only).collect();
        let (code, report) =
            check(&changed(&corpus("laws").join(&self.law), &self.change, &format!("check-{number}")), &arguments);
        let found = complaints(&report);
        let named = found.iter().find(|complaint| {
            complaint.kinds.contains(&self.kind) && self.line.as_ref().is_none_or(|line| *line == complaint.line)
        });
        // A warning does not fail the check.
        let named = named.filter(|complaint| complaint.verdict == "warning" || code == 1);
        named
            .map(|complaint| [&self.law, &self.what, &complaint.line, &complaint.kinds.join(", ")].map(String::clone))
            .ok_or_else(|| {
                format!("{number}: {} in {} ({}): exit {code}{}\n", self.kind, self.law, self.what, listed(&found))
            })
    }
}

/// Every fault is found by its line under its name; the document's table behind this mark says the same.
fn found_and_named(path: &str, first: usize, mark: &str) {
    let Faults { fault: faults } = parse(path);
    let mut table = String::from("| law | fault | line | called |\n|---|---|---|---|\n");
    let mut missed = String::new();
    for (number, fault) in faults.iter().enumerate() {
        match fault.row(first + number) {
            Ok([law, what, line, kinds]) => table += &format!("| `{law}` | {what} | {line} | {kinds} |\n"),
            Err(found) => missed += &found,
        }
    }
    assert!(missed.is_empty(), "missed or called otherwise:\n{missed}");

    let document = Path::new(ROOT).join(DOCUMENT);
    let text = std::fs::read_to_string(&document).expect("the document");
    let marks = [mark, "<!-- end -->"];
    let (before, rest) = text.split_once(marks[0]).expect("the table begins");
    let (_, after) = rest.split_once(marks[1]).expect("the table ends");
    let current = [before, marks[0], &table, marks[1], after].concat();
    if is_asked("documents") {
        std::fs::write(&document, &current).expect("docs are writable");
    } else {
        assert!(text == current, "{DOCUMENT} is not current: cargo xtask update documents");
    }
}

#[test]
fn faults_are_found_and_named() {
    found_and_named("faults.toml", 0, "<!-- faults -->\n");
}

/// Ten kinds of fault in three laws each, besides those that end the process.
#[test]
fn there_are_thirty_faults_of_ten_kinds() {
    let Faults { fault: faults } = parse("faults.toml");
    let lines = ["tangent", "objectivity", "cycles"];
    let mut kinds = std::collections::BTreeMap::<&str, std::collections::BTreeSet<&str>>::new();
    for fault in faults.iter().filter(|fault| fault.line.as_deref().is_some_and(|line| lines.contains(&line))) {
        kinds.entry(&fault.kind).or_default().insert(&fault.law);
    }
    assert_eq!(kinds.values().map(|laws| laws.len()).collect::<Vec<_>>(), [3; 10], "{kinds:?}");
}

// ---- VUMAT

/// With the properties beside them and others.
#[test]
fn right_vumats_raise_no_alarm() {
    let others = ["--props=2,300,1.4".to_string(), "--seed=2".to_string()];
    let hyperelastic = "vumat_neo_hooke.f";
    let alarms = alarm(hyperelastic, &[]) + &alarm(hyperelastic, &others) + &alarm("vumat_j2.f", &[]);
    assert!(alarms.is_empty(), "false alarms:\n{alarms}");
    // Every line has an answer, but that this law dissipates nothing.
    let (_, report) = check(&corpus("laws").join(hyperelastic), &[]);
    let lines = report["materials"][0]["lines"].as_array().expect("lines");
    let others = lines.iter().filter(|line| line["verdict"] != "right");
    assert_eq!(others.map(|line| &line["line"]).collect::<Vec<_>>(), ["dissipation"]);
}

#[test]
fn faults_of_a_vumat_are_found_and_named() {
    // Folders beyond those of the UMATs' faults.
    found_and_named("vumat_faults.toml", 1000, "<!-- faults of a VUMAT -->\n");
}
