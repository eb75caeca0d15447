//! The commands that have `--restart`, killed at random times: the results of the run that goes on are those of one
//! that nothing has disturbed, to the bit. `.ci/long kills` builds the program and runs this.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use fastrand::Rng;
use toron_fuzz::{seed, setting};
use toron_test_support::library::{ROOT, folder};

/// Kills in one run before it may end.
const KILLS_A_RUN: u64 = 2;

/// A command, the scene of `toron init` that it takes, and what is changed in it to be short.
struct Scene {
    command: &'static str,
    init: &'static str,
    changes: &'static [(&'static str, &'static str)],
}

const SCENES: [Scene; 4] = [
    Scene {
        command: "impact",
        init: "yarn",
        changes: &[
            ("layers = 100", "layers = 40"),
            ("columns = 4", "columns = 2"),
            ("end = 0.06", "end = 0.03\ncheckpoints = 30"),
        ],
    },
    Scene {
        command: "fabric",
        init: "fabric",
        changes: &[
            ("along = 6", "along = 4"),
            ("columns = 6", "columns = 4"),
            ("end = 0.05", "end = 0.04\ncheckpoints = 40"),
            ("[0.02]", "[0.005]"),
        ],
    },
    Scene { command: "v50", init: "v50", changes: &[("end = 0.05", "end = 0.02")] },
    Scene {
        command: "cell",
        init: "cell",
        changes: &[
            ("packing = \"hexagonal\"", "host = \"explicit\"\npacking = \"hexagonal\""),
            ("elements = 4", "elements = 2"),
            ("largest = 0.12", "largest = 0.02"),
            ("largest_distortion = 0.06", "largest_distortion = 0.02"),
            ("increments = 24", "increments = 6"),
        ],
    },
];

/// The program beside this test: `cargo build -p toron-program` makes it.
fn program() -> PathBuf {
    let test = std::env::current_exe().expect("a test has a file");
    test.ancestors().nth(2).expect("Cargo's folder for what it builds").join("toron")
}

impl Scene {
    /// A new folder with the scene.
    fn place(&self, name: &str) -> PathBuf {
        let place = folder(&format!("kills-{}-{name}", self.command));
        fs::remove_dir_all(&place).expect("it is removed");
        fs::create_dir_all(&place).expect("a folder");
        let made = Command::new(program()).args(["init", self.init]).current_dir(&place).output().expect("it starts");
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
        let file = place.join(format!("{}.toml", self.init));
        let mut text = fs::read_to_string(&file).expect("a scene");
        for (from, to) in self.changes {
            assert!(text.contains(from), "{}: {from}", self.command);
            text = text.replacen(from, to, 1);
        }
        fs::write(file, text).expect("a scene");
        place
    }

    fn start(&self, place: &Path, restart: bool) -> Child {
        let mut run = Command::new(program());
        run.arg(self.command).arg(format!("{}.toml", self.init)).args(["-o", "out"]).current_dir(place);
        if restart {
            run.arg("--restart");
        }
        let log = fs::File::create(place.join("log")).expect("a file");
        run.env("RAYON_NUM_THREADS", "1").stdout(Stdio::null()).stderr(log).spawn().expect("it starts")
    }

    /// Whether there is something to go on from.
    fn can_restart(&self, place: &Path) -> bool {
        let files = fs::read_dir(place.join("out")).into_iter().flatten().flatten();
        files.map(|file| file.file_name()).any(|name| {
            let name = name.to_string_lossy();
            name.ends_with(".checkpoint") || (self.command == "v50" && name == "shots.csv")
        })
    }

    /// The end of a run, which must be a good one.
    fn ends(&self, place: &Path, mut run: Child) {
        let ended = run.wait().expect("it ends");
        let log = fs::read_to_string(place.join("log")).unwrap_or_default();
        assert!(ended.success(), "{} in {}: {ended}\n{log}", self.command, place.display());
    }
}

/// The results: all files but checkpoints, the lock and what is set aside, tables without what they say of time.
fn results(place: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut results = BTreeMap::new();
    for file in fs::read_dir(place.join("out")).expect("results").flatten() {
        let (name, bytes) = (file.file_name().to_string_lossy().into_owned(), fs::read(file.path()));
        if name.contains(".checkpoint") || name == "toron.lock" || name.ends_with("-old") {
            continue;
        }
        let bytes = bytes.expect("a file");
        results.insert(name.clone(), if name.ends_with(".csv") { timeless(&bytes) } else { bytes });
    }
    results
}

/// A table without its columns of times, and of what is computed of these.
fn timeless(table: &[u8]) -> Vec<u8> {
    const OF_TIME: [&str; 3] = ["seconds", "ns_per_zone_cycle", "time_share"];
    let text = String::from_utf8_lossy(table);
    let head = cells(text.lines().next().unwrap_or_default());
    let of_time = |column: usize| head.get(column).is_some_and(|name| OF_TIME.iter().any(|of| name.contains(of)));
    let kept = |line| {
        let cells = cells(line).into_iter().enumerate().filter(|(column, _)| !of_time(*column)).map(|(_, cell)| cell);
        cells.collect::<Vec<_>>().join(",") + "\n"
    };
    text.lines().map(kept).collect::<String>().into_bytes()
}

/// The cells of a line; a comma in quotes parts none.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for letter in line.chars() {
        quoted ^= letter == '"';
        match (letter, quoted) {
            (',', false) => cells.push(String::new()),
            _ => cells.last_mut().expect("a cell").push(letter),
        }
    }
    cells
}

/// A run that is killed, again and again, and goes on to its end; returns how often, and how often there was something
/// to go on from.
fn killed(scene: &Scene, name: &str, lasts: Duration, rng: &mut Rng) -> ([u64; 2], PathBuf) {
    let (place, mut kills, mut restarts) = (scene.place(name), 0, 0);
    let mut run = scene.start(&place, false);
    while kills < KILLS_A_RUN {
        sleep(lasts.mul_f64(rng.f64() * 0.7));
        if run.try_wait().expect("a state").is_some() {
            break;
        }
        run.kill().expect("it is killed");
        run.wait().expect("it ends");
        kills += 1;
        let restart = scene.can_restart(&place);
        restarts += u64::from(restart);
        run = scene.start(&place, restart);
    }
    scene.ends(&place, run);
    ([kills, restarts], place)
}

#[test]
#[ignore = "minutes: run by .ci/long kills"]
fn killed_runs_go_on_to_the_same_bytes() {
    let rng = &mut Rng::with_seed(seed());
    let wanted = setting("TORON_KILLS", 40).div_ceil(SCENES.len() as u64);
    println!("program {}, repository {ROOT}", program().display());
    for scene in &SCENES {
        let place = scene.place("undisturbed");
        let start = Instant::now();
        scene.ends(&place, scene.start(&place, false));
        let (lasts, expected) = (start.elapsed(), results(&place));
        let (mut kills, mut restarts, mut runs) = (0, 0, 0);
        assert!(expected.len() > 1, "{}: {} results", scene.command, expected.len());
        while kills < wanted {
            let ([more, again], place) = killed(scene, &format!("{runs}"), lasts, rng);
            (kills, restarts, runs) = (kills + more, restarts + again, runs + 1);
            let found = results(&place);
            let names = |results: &BTreeMap<String, Vec<u8>>| results.keys().cloned().collect::<Vec<_>>();
            assert_eq!(names(&found), names(&expected), "{} in {}", scene.command, place.display());
            for (name, bytes) in &expected {
                assert!(found[name] == *bytes, "{}: {name} in {} differs", scene.command, place.display());
            }
        }
        assert!(restarts >= kills / 4, "{}: {restarts} restarts after {kills} kills", scene.command);
        println!(
            "{}: {kills} kills in {runs} runs of {lasts:?}, {restarts} with something to go on from, {} files the same",
            scene.command,
            expected.len()
        );
    }
}
