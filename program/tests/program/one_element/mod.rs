//! The decks of `examples/one-element`: read as their hosts read them, field by field, and held against the law.
//!
//! Two parts of each deck are written by this test, with `cargo xtask update documents`: the material's card, which is
//! what the command in its heading prints, and the numbers to expect, which the law gives along the deck's own motion.
//! The decks of CalculiX are run.

mod abaqus;
mod ls_dyna;
mod model;
mod mtest;
mod openradioss;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::calculix_decks::{Job, Tangent};
use crate::eval::evaluated;
use model::{Deck, ROWS, Row};
use toron::law::parameters::FIBRE;
use toron_materials::material::laws::LawName;
use toron_test_support::library::{ROOT, run};
use toron_test_support::update::is_asked;

/// A host: folder, ending of its decks, sign of a comment, how a deck is read, and the deck's time at the end.
struct Host {
    folder: &'static str,
    ending: &'static str,
    comment: &'static str,
    read: fn(&str) -> Deck,
    end: f64,
    /// The C entry that its routine calls, as `toron eval` names it.
    entry: Option<&'static str>,
}

const HOSTS: [Host; 6] = [
    Host { folder: "ls-dyna", ending: ".k", comment: "$", read: ls_dyna::read, end: 60e-6, entry: Some("ls-dyna") },
    Host {
        folder: "abaqus-standard",
        ending: ".inp",
        comment: "**",
        read: abaqus::standard,
        end: 60.0,
        entry: Some("umat"),
    },
    Host {
        folder: "abaqus-explicit",
        ending: ".inp",
        comment: "**",
        read: abaqus::explicit,
        end: 60e-6,
        entry: Some("vumat"),
    },
    Host {
        folder: "openradioss",
        ending: "_0000.rad",
        comment: "#",
        read: openradioss::read,
        end: 60e-6,
        entry: Some("openradioss"),
    },
    Host { folder: "calculix", ending: ".inp", comment: "**", read: abaqus::calculix, end: 60.0, entry: None },
    Host { folder: "mtest", ending: ".mtest", comment: "//", read: mtest::read, end: 60.0, entry: Some("mgis") },
];

/// The decks of the hyperelastic law, and that of the law with friction.
const SCENES: [&str; 3] = ["tension", "compaction", "turn"];
const FRICTION: &str = "friction";

impl Host {
    /// Name and path of every deck: the scenes, the law with friction, then both of the thesis's laws in one model, or
    /// in MTest the linear elastic one alone.
    fn decks(&self) -> Vec<(&'static str, PathBuf)> {
        let last = if self.folder == "mtest" { "linear-tension" } else { "both-laws" };
        let folder = Path::new(ROOT).join("examples/one-element").join(self.folder);
        let path = |name: &'static str| (name, folder.join(format!("{name}{}", self.ending)));
        SCENES.into_iter().chain([FRICTION, last]).map(path).collect()
    }
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What `toron deck` prints, for a command in a deck.
fn card(command: &str) -> String {
    let arguments = command.strip_prefix("toron ").expect("a command").split(' ');
    let output = run(Command::new(env!("CARGO_BIN_EXE_toron")).args(arguments).current_dir(ROOT), "");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The deck with what stands between `[…]` and `[end]` replaced by what `written` gives for the heading.
fn rewritten(text: &str, comment: &str, written: impl Fn(&str) -> Option<String>) -> String {
    let (mut new, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once(&format!("{comment} [")) {
        let (heading, after) = after.split_once("]\n").expect("a heading ends");
        let (old, after) = after.split_once(&format!("{comment} [end]\n")).expect("a part ends");
        let part = written(heading).unwrap_or_else(|| old.to_string());
        new += &format!("{before}{comment} [{heading}]\n{part}{comment} [end]\n");
        rest = after;
    }
    new + rest
}

/// The numbers to expect, as a deck's comment has them.
fn expected(deck: &Deck, comment: &str) -> String {
    let mut lines = vec![
        "Cauchy stress in global axes, whose S23 and S31 are 0, and W, the energy per reference volume, in mJ/mm3:"
            .to_string(),
    ];
    for point in &deck.points {
        let rows = deck.rows(point);
        lines.push(format!("{}, {}:", point.label, point.law.text()));
        lines.push("       time         S11         S22         S33         S12           W   failed".to_string());
        let lost = rows.last().and_then(|row| row.lost);
        for Row { time, stress, energy, failed, .. } in rows {
            assert_eq!(stress[4..], [0.0, 0.0], "S23 and S31");
            let numbers: String = [0, 1, 2, 3].map(|k| format!("{:12.4}", stress[k] + 0.0)).concat();
            // What remains in a failed element is what it had in the increment that failed, which the solver chooses.
            let energy = if failed { "-".to_string() } else { format!("{energy:.4}") };
            lines.push(format!("{:>11}{numbers}{energy:>12}{:>9}", seconds(time), u8::from(failed)));
        }
        if let Some(lost) = lost {
            lines.push(format!("friction has lost {lost:.4} by then, which the state variable w_fr keeps"));
        }
        if let Some((time, energy)) = deck.failure(point) {
            lines.push(format!("fails at {}, with W = {energy:.1}, which the state variables keep", seconds(time)));
        }
    }
    lines.into_iter().map(|line| format!("{comment} {line}\n")).collect()
}

/// A time of some µs, or of some seconds.
fn seconds(time: f64) -> String {
    if time < 1.0 { format!("{:.1}e-6", time * 1e6) } else { format!("{time:.1}") }
}

#[test]
fn cards_and_numbers_are_current() {
    let mut decks = 0;
    for host in &HOSTS {
        for (_, path) in host.decks() {
            let old = text(&path);
            // The numbers follow from the card.
            let with_card =
                rewritten(&old, host.comment, |heading| heading.starts_with("toron ").then(|| card(heading)));
            let deck = (host.read)(&with_card);
            let new = rewritten(&with_card, host.comment, |heading| {
                (heading == "expected").then(|| expected(&deck, host.comment))
            });
            assert_eq!(new.matches("[toron deck --host ").count(), deck.points.len(), "{}", path.display());
            assert!(new.contains("[expected]"), "{}", path.display());
            if is_asked("documents") {
                std::fs::write(&path, &new).expect("examples are writable");
            }
            assert!(text(&path) == new, "{} is not current: cargo xtask update documents", path.display());
            decks += 1;
        }
    }
    assert_eq!(decks, 6 * 5, "a deck has got lost");
}

/// Every solver is given the same motion, up to its unit of time, and so is told to expect the same.
#[test]
fn all_hosts_are_told_the_same() {
    for scene in SCENES.into_iter().chain([FRICTION]) {
        let of = |host: &Host| {
            let (_, path) = host.decks().into_iter().find(|(name, _)| *name == scene).expect("a deck");
            let deck = (host.read)(&text(&path));
            assert_eq!((deck.end, deck.points.len()), (host.end, 1), "{}", host.folder);
            deck.rows(&deck.points[0])
        };
        let first = of(&HOSTS[0]);
        for host in &HOSTS[1..] {
            for (row, expected) in of(host).iter().zip(&first) {
                assert_eq!(row.failed, expected.failed, "{}, {scene}", host.folder);
                for (a, b) in row.stress.iter().zip(expected.stress) {
                    // The tables of the motion have nine decimals.
                    assert!((a - b).abs() < 1e-3, "{}, {scene}: {a}, not {b}", host.folder);
                }
            }
        }
    }
}

/// The deck of a host without a time unit of its own.
fn calculix_deck(scene: &str) -> Deck {
    let (_, path) = HOSTS[4].decks().into_iter().find(|(name, _)| *name == scene).expect("a deck");
    abaqus::calculix(&text(&path))
}

fn near(row: &Row, expected: [f64; 4], energy: f64) {
    for (found, expected) in row.stress.iter().zip(expected) {
        assert!((found - expected).abs() < 2e-4, "{found}, not {expected}, at {}", row.time);
    }
    assert!((row.energy - energy).abs() < 1e-4, "{}, not {energy}, at {}", row.energy, row.time);
}

/// The numbers against closed forms of the thesis, with Tab. 4.3 and 4.4.
#[test]
fn the_numbers_are_those_of_closed_forms() {
    let (k_el, k_tc, p, k_td) = (82341.0, 1055.0, 2.2, 649.74);
    let tension = calculix_deck("tension");
    for row in tension.rows(&tension.points[0]) {
        let stretch: f64 = 1.0 + 0.06 * row.time / 60.0;
        assert_eq!(row.failed, stretch > 1.0458);
        let strain = if row.failed { 0.0 } else { stretch.ln() };
        let energy = if row.failed { row.energy } else { 0.5 * k_el * strain * strain };
        near(&row, [k_el * strain / stretch, 0.0, 0.0, 0.0], energy);
    }
    let compaction = calculix_deck("compaction");
    for row in compaction.rows(&compaction.points[0]) {
        let height: f64 = 1.0 - 0.4 * row.time / 60.0;
        let half = -0.5 * height.ln();
        let (pressure, distortion) = (0.5 * p * k_tc * half.powf(p - 1.0), 0.5 * k_td * half);
        let energy = k_tc * half.powf(p) + 0.5 * k_td * half * half;
        near(&row, [0.0, (distortion - pressure) / height, (-distortion - pressure) / height, 0.0], energy);
    }
    const MU: f64 = 0.15;
    let friction = calculix_deck(FRICTION);
    let rows = friction.rows(&friction.points[0]);
    // All that is held while it is pressed; then the fibres stick, and the release is elastic until they slide back.
    let pressure = |half: f64| 0.5 * p * k_tc * half.powf(p - 1.0);
    let most = |half: f64| 2.0 * MU * pressure(half) / k_td;
    let halves = [0.8, 0.6, 0.7, 0.8].map(|height: f64| -0.5 * height.ln());
    let sticking = |half: f64| most(halves[1]) - (halves[1] - half);
    let held = [most(halves[0]), most(halves[1]), sticking(halves[2]), -most(halves[3])];
    assert!(sticking(halves[2]).abs() < most(halves[2]) && sticking(halves[3]) < held[3], "they slide back in the end");
    for ((row, half), held) in rows.iter().zip(halves).zip(held) {
        let (height, distortion) = ((-2.0 * half).exp(), 0.5 * k_td * held);
        let energy = k_tc * half.powf(p) + 0.5 * k_td * held * held;
        let across = [distortion, -distortion].map(|distortion| (distortion - pressure(half)) / height);
        near(row, [0.0, across[0], across[1], 0.0], energy);
    }
    // Sliding takes 2 µ p_t dI_td, of which the distortion that is held gets its energy; to first order in the step.
    let taken = |half: f64| MU * k_tc * half.powf(p);
    let stored = |half: f64| 0.5 * k_td * most(half).powi(2);
    let [mut more, mut less] = [halves[2], halves[3]];
    for _ in 0..60 {
        let middle = 0.5 * (more + less);
        *(if sticking(middle) > -most(middle) { &mut more } else { &mut less }) = middle;
    }
    let lost = taken(halves[1]) - stored(halves[1]);
    let lost_back = taken(more) - taken(halves[3]) - (stored(halves[3]) - stored(more));
    for (row, lost) in rows[1..].iter().zip([lost, lost, lost + lost_back]) {
        assert!((row.lost.expect("a loss") - lost).abs() < 5e-4 * lost, "{:?}, not {lost}", row.lost);
    }
    assert_eq!(rows[1].lost, rows[2].lost, "the elastic release loses nothing");
    let turn = calculix_deck("turn");
    let rows = turn.rows(&turn.points[0]);
    for (row, angle) in rows.iter().zip([0.0_f64, 30.0, 60.0, 90.0]) {
        let [s11, s22, s33, ..] = rows[0].stress;
        let rotation = Rotation3::from_axis_angle(&Vector3::z_axis(), angle.to_radians());
        let turned = rotation * Matrix3::from_diagonal(&Vector3::new(s11, s22, s33)) * rotation.inverse();
        let stretch: f64 = 1.03;
        assert!((s11 - k_el * stretch.ln() / (stretch * 0.9)).abs() < 2e-4);
        near(row, [turned.m11, turned.m22, turned.m33, turned.m12], rows[0].energy);
    }
    let both = calculix_deck("both-laws");
    assert_eq!(
        both.points.iter().map(|point| point.law).collect::<Vec<_>>(),
        [LawName::Hyperelastic, LawName::LinearElastic]
    );
    let linear = both.rows(&both.points[1]);
    for row in &linear[..3] {
        let strain = (1.0 + 0.06 * row.time / 60.0_f64).ln();
        near(row, [79414.0 * strain, 0.0, 0.0, 0.0], row.energy);
    }
    assert!(!linear[2].failed && linear[3].failed);
}

/// Holds a point's answer against a row of a deck.
fn same_stress(answer: &serde_json::Value, row: &Row, deck: &Path) {
    for (k, expected) in row.stress[..4].iter().enumerate() {
        let found = answer["sigma"][k].as_f64().expect("a number");
        assert!((found - expected).abs() < 1e-3, "{} at {}: {found}", deck.display(), row.time);
    }
}

/// The C entry that each host's routine calls gives the same numbers, before failure; CalculiX's is tested in CalculiX.
#[test]
fn the_hosts_entries_give_the_numbers() {
    for host in &HOSTS {
        let Some(entry) = host.entry else { continue };
        for (_, path) in &host.decks()[..SCENES.len()] {
            let deck = (host.read)(&text(path));
            let point = &deck.points[0];
            let rows: Vec<Row> = deck.rows(point).into_iter().filter(|row| !row.failed).collect();
            let (properties, fibre) = point.values.split_at(FIBRE);
            let names = point.law.table().iter().map(|property| property.name);
            let params: BTreeMap<_, _> = names.zip(properties).collect();
            let lines = rows.iter().map(|row| {
                let f: [[f64; 3]; 3] = (point.path)(row.time).transpose().into();
                serde_json::json!({ "F": f, "m": fibre, "params": params }).to_string() + "\n"
            });
            let answers = evaluated(&["--via", entry], lines.collect::<String>().as_bytes());
            assert!(rows.len() >= 3 && answers.len() == rows.len());
            answers.iter().zip(&rows).for_each(|(answer, row)| same_stress(answer, row, path));
        }
        // The law with friction remembers: its rows are one path. Steps of any length end at the same stress there.
        let (_, path) = &host.decks()[SCENES.len()];
        let deck = (host.read)(&text(path));
        let (point, rows) = (&deck.points[0], deck.rows(&deck.points[0]));
        let names = point.law.table().iter().map(|property| property.name);
        let params: BTreeMap<_, _> = names.zip(&point.values).collect();
        let f = |row: &Row| -> [[f64; 3]; 3] { (point.path)(row.time).transpose().into() };
        let steps: Vec<_> = rows.iter().map(f).collect();
        let line = serde_json::json!({ "path": steps, "params": params }).to_string() + "\n";
        let answers = evaluated(&["--law", "frictional", "--via", entry], line.as_bytes());
        let after = answers[0]["after"].as_array().expect("an answer for each step");
        assert_eq!(after.len(), rows.len());
        after.iter().zip(&rows).for_each(|(answer, row)| same_stress(answer, row, path));
    }
}

/// Between the points of its tables a turned element moves along chords: by how much that is wrong is said in the deck.
#[test]
fn chords_are_as_wrong_as_the_decks_say() {
    let turn = calculix_deck("turn");
    let f = |time: f64| (turn.points[0].path)(time);
    let stretch = |time: f64| (f(time).transpose() * f(time)).m11.sqrt();
    let [at, between] = [30.0, 30.5].map(stretch);
    assert!((at - 1.03).abs() < 1e-8);
    assert!((1.4e-4..1.6e-4).contains(&(1.0 - between / 1.03)), "{between}");
    let stress = |stretch: f64| stretch.ln() / stretch;
    assert!((0.004..0.006).contains(&(1.0 - stress(between) / stress(at))));
    for host in HOSTS.iter().filter(|host| host.folder != "mtest") {
        let (_, path) = &host.decks()[2];
        assert!(text(path).contains("up to 0.015 % too small, and the stress along the fibre up to 0.5 %"));
    }
}

/// CalculiX itself, with the decks as they are; it prints a table for each law.
#[test]
fn calculix_gives_the_numbers() {
    for scene in SCENES.into_iter().chain([FRICTION, "both-laws"]) {
        let deck = calculix_deck(scene);
        let file = format!("../../examples/one-element/calculix/{scene}.inp");
        let results = Job { deck: &file, includes: &[], tangent: Tangent::Analytic }
            .run_edited(&format!("one-{scene}"), |deck| deck);
        assert_eq!(deck.points.len(), if scene == "both-laws" { 2 } else { 1 });
        for (number, point) in deck.points.iter().enumerate() {
            let rows = deck.rows(point);
            assert_eq!(rows.len(), ROWS.len());
            for row in rows {
                let printed = |title: &str| {
                    let tables = results.all(title);
                    let table = tables.iter().filter(|table| (table.time - row.time).abs() < 1e-6).nth(number);
                    table.unwrap_or_else(|| panic!("{title} at {}", row.time)).rows.clone()
                };
                let (stresses, states) = (printed("stresses"), printed("internal state"));
                assert_eq!((stresses.len(), states.len()), (8, 8), "eight integration points");
                for (stress, state) in stresses.iter().zip(&states) {
                    let state = &state[2..];
                    // Seven digits, and nine decimals of the motion times the stiffness of the fibre.
                    for (found, expected) in stress[2..6].iter().zip(row.stress) {
                        assert!((found - expected).abs() < 1e-3, "{scene} at {}: {found}, not {expected}", row.time);
                    }
                    // The work of the linear elastic law is a sum over the increments, of which CalculiX takes fewer.
                    let allowed = if point.law == LawName::LinearElastic { 1e-3 } else { 1e-4 };
                    let description = point.law.description();
                    let (energy, failed) = (description.energy(state), state[description.failed]);
                    assert_eq!(failed, f64::from(u8::from(row.failed)), "{scene} at {}", row.time);
                    assert!(
                        row.failed || (energy - row.energy).abs() < allowed,
                        "{scene}: {energy}, not {}",
                        row.energy
                    );
                }
            }
        }
    }
}
