//! Properties of a yarn from the history of a blow: those that made the history come back, a fit that is begun again
//! makes no run twice, and wrong files are named.

use std::path::{Path, PathBuf};

use toron_explicit_host::struck::history;
use toron_parameters::identify::blow::file::{BlowJob, columns};
use toron_parameters::identify::blow::runs::Runs;
use toron_parameters::identify::blow::search::minimise;
use toron_strikes::impact::run;
use toron_strikes::impact::scene::Scene;
use toron_test_support::library::folder;

/// A short yarn under a heavy cylinder, to 4.5 µs. Elements of half a millimetre would be too long: where their sections
/// slide, the answer to a property would be rough.
const SCENE: &str = r#"
units = "mm-g-ms"
[scene]
law = "frictional"
half-length = 4.0
height = 0.115
width = 0.5337
layers = 40
rows = 2
columns = 4
mass = 9.91e-3
radius = 1.1
friction = 0.18
contact-stiffness = 1e5
speed = 120.0
end = 0.0045
sample = 1e-4
[[case]]
name = "blow"
"#;

const BLOW: &str = r#"
title = "A made blow"
units = "mm-g-ms"
[yarn]
name = "found"
[blow]
scene = "scene.toml"
history = "history.csv"
range = [2e-4, 0.0044]
follows = { speed = 0.02, width_1 = 1e-3, compaction_energy = 1e-3 }
fits = ["k_tc", "k_td", "mu"]
"#;

/// The properties of the yarn that was struck.
const TRUE: [&str; 3] = ["k_tc = 700.0", "k_td = 400.0", "mu = 0.3"];

fn scene(properties: &[&str]) -> String {
    let own = format!("frictional.properties = {{ {} }}\n", properties.join(", "));
    SCENE.replace("law = \"frictional\"\n", &format!("law = \"frictional\"\n{own}"))
}

/// A folder with the scene as it is guessed, and the history of another one.
fn written(name: &str, blow: &str) -> PathBuf {
    let place = folder(name);
    std::fs::remove_dir_all(&place).expect("it can be removed");
    let place = folder(name);
    let write = |file: &str, text: &str| std::fs::write(place.join(file), text).expect("a file can be written");
    write("scene.toml", &scene(&[]));
    let struck = Scene::parse("struck.toml", &scene(&TRUE)).expect("a scene");
    let outcome = run::run(&struck.cases[0], &mut ()).expect("it runs");
    let columns = columns();
    let lines: String = outcome.history.iter().map(|sample| history::line(&columns, sample)).collect();
    write("history.csv", &(history::titles(&columns, &struck.units) + &lines));
    write("blow.toml", blow);
    place.join("blow.toml")
}

fn read(path: &Path) -> BlowJob {
    BlowJob::read(path).expect("a fit").expect("of a blow")
}

#[test]
fn properties_that_made_the_history_come_back() {
    let path = written("blow-found", BLOW);
    let job = read(&path);
    let file = path.with_file_name("runs.csv");
    let runs = Runs::open(&job, &file).expect("runs");
    let solution = minimise(&runs).expect("a solution");
    for ((found, [low, high]), wanted) in solution.values.iter().zip(&solution.intervals).zip([700.0, 400.0, 0.3]) {
        assert!((found / wanted - 1.0).abs() < 0.01, "{found} for {wanted}");
        assert!(*low < wanted && wanted < *high, "{wanted} is not in {low} to {high}");
    }
    // A run at each end says what the linearised interval is worth. These are narrow against the differences that the
    // derivatives are of, and a run's roughness adds to the squares: they rise by 0.8 to 2.4 times the linearised rise.
    let rises: Vec<f64> = solution.rises.iter().flatten().map(|rise| rise.expect("a run")).collect();
    assert!(rises.len() == 6 && rises.iter().all(|rise| (0.5..4.0).contains(rise)), "{rises:?}");
    assert!(job.misfit(&solution.followed) < 0.01 * job.misfit(&solution.before));
    let count = runs.count();
    assert!(count.found == 0 && count.all > 8, "{count:?}");

    // Killed while a line was being written, and begun again.
    let text = std::fs::read_to_string(&file).expect("the runs");
    let kept: Vec<&str> = text.lines().take(6).collect();
    std::fs::write(&file, kept.join("\n") + "\n700.0,400").expect("a file can be written");
    let again = Runs::open(&job, &file).expect("runs");
    assert_eq!(again.count().found, 5);
    assert_eq!(minimise(&again).expect("a solution").values, solution.values);
    let third = Runs::open(&job, &file).expect("runs");
    minimise(&third).expect("a solution");
    assert_eq!((third.count().all, third.count().found), (count.all, count.all));

    // Of another scene they are not taken.
    std::fs::write(path.with_file_name("scene.toml"), scene(&["k_ld = 10.0"])).expect("a file can be written");
    let message = Runs::open(&read(&path), &file).err().expect("other runs").to_string();
    assert!(message.contains("runs.csv: its runs are of another build, scene"), "{message}");
}

#[test]
fn what_the_history_does_not_tell_is_named() {
    let path = written("blow-untold", &BLOW.replace("[\"k_tc\", \"k_td\", \"mu\"]", "[\"alpha\"]"));
    let job = read(&path);
    let message = minimise(&Runs::open(&job, &path.with_file_name("runs.csv")).expect("runs")).err().expect("untold");
    assert!(message.to_string().contains("the history does not tell alpha"), "{message}");
}

#[test]
fn a_run_that_is_over_before_the_history_is_no_answer() {
    let path = written("blow-short", BLOW);
    std::fs::write(path.with_file_name("scene.toml"), scene(&[]).replace("9.91e-3", "9.91e-6")).expect("a scene");
    let job = read(&path);
    let message =
        minimise(&Runs::open(&job, &path.with_file_name("runs.csv")).expect("runs")).err().expect("a short run");
    assert!(message.to_string().contains("the run is over at 0.00"), "{message}");
}

#[test]
fn wrong_files_are_named() {
    let message = |from: &str, to: &str| {
        let text = BLOW.replace(from, to);
        assert_ne!(text, BLOW, "{from}");
        let path = written("blow-wrong", &text);
        BlowJob::read(&path).expect_err("an error").to_string()
    };
    for (from, to, wanted) in [
        ("\"mu\"]", "\"ktd\"]", "toml:11: fits \"ktd\", did you mean k_td?; allowed: k_el, "),
        ("\"mu\"]", "\"k_td\"]", "toml:11: fits \"k_td\""),
        ("width_1 =", "width_9 =", "toml:10: follows \"width_9\""),
        ("[2e-4, 0.0044]", "[1.0, 2.0]", "toml:9: the history has no time above 0 in this range"),
        ("mm-g-ms", "mm-tonne-s", "toml:3: units is \"mm-tonne-s\", and the scene's are \"mm-g-ms\""),
        ("history.csv\"", "history.csv\"\ncase = \"none\"", "case \"none\""),
        ("fits =", "columns = { width_2 = \"b\" }\nfits =", "toml:11: columns names \"width_2\""),
        ("fits =", "columns = { width_1 = \"b\" }\nfits =", "no column \"b\""),
        ("history.csv", "nothing.csv", "nothing.csv"),
        ("speed = 0.02", "speed = -0.02", "toml:10: "),
    ] {
        let found = message(from, to);
        assert!(found.contains(wanted), "{found} instead of {wanted}");
    }
}
