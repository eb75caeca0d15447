//! `toron v50` at a tiny panel and at a yarn: a shot takes a tenth of a second.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::thread::sleep;
use std::time::Duration;

use toron_test_support::library::{ROOT, folder};

/// A whole panel of a few yarns; further lines go into `[shots]`.
fn panel(design: &str, number: usize, lines: &str) -> String {
    format!(
        "title = \"a tiny panel\"\nunits = \"mm-g-ms\"\n\
         [weave]\npreset = \"kevlar-s706\"\nalong = 2\ncolumns = 2\n\
         [weave.panel]\nshape = \"circle\"\nradius = 1.2\n\
         [scene]\nspeed = 100.0\nmass = 0.01\nradius = 0.8\ncontact-stiffness = 1e5\nend = 0.02\nfailure = \"uniaxial\"\n\
         hyperelastic.properties = {{ k_ld = 126.0 }}\n\
         [scene.strength]\nweibull-modulus = 10.0\nstrain = 0.0458\nreference-length = 50.0\ncell = 1.0\n\
         [shots]\nnumber = {number}\nspeeds = [60.0, 200.0]\ndesign = \"{design}\"\nscatter = 1.0\naim = \"cell\"\n{lines}\n"
    )
}

fn program(scene: &Path, output: &Path, arguments: &[&str]) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    program.current_dir(ROOT).arg("v50").arg(scene).arg("-o").arg(output).args(arguments);
    program
}

/// A folder for a test, with the scene in it.
fn place(name: &str, text: &str) -> (PathBuf, PathBuf) {
    let folder = folder(&format!("v50-{name}"));
    // What an earlier run has left would be refused.
    std::fs::remove_dir_all(&folder).and_then(|()| std::fs::create_dir_all(&folder)).expect("a folder");
    let scene = folder.join("scene.toml");
    std::fs::write(&scene, text).expect("the scene is written");
    (folder, scene)
}

fn run(scene: &Path, output: &Path, arguments: &[&str]) -> Output {
    program(scene, output, arguments).output().expect("it starts")
}

#[track_caller]
fn succeeds(answer: &Output) -> String {
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    String::from_utf8_lossy(&answer.stdout).into_owned()
}

#[track_caller]
fn fails(answer: &Output, message: &str) {
    let text = String::from_utf8_lossy(&answer.stderr);
    assert!(!answer.status.success() && text.contains(message), "{message}: {text}");
}

/// The table's lines by number, without the columns of seconds that shots took.
fn shots(output: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(output.join("shots.csv")).expect("a table");
    let titles: Vec<&str> = text.lines().next().expect("a heading").split(',').collect();
    let without_seconds = |line: &str| {
        let cells = line.split(',').zip(&titles).filter(|(_, title)| !title.contains("seconds"));
        cells.map(|(cell, _)| cell).collect::<Vec<_>>().join(",")
    };
    let mut lines: Vec<String> = text.lines().skip(1).map(without_seconds).collect();
    lines.sort_by_key(|line| line.split(',').next().and_then(|number| number.parse::<usize>().ok()));
    lines
}

/// One run, the parts of a job array that are joined, and a run that was killed and went on have the same shots to the
/// bit; and so have one and two threads.
#[test]
fn shots_are_the_same_however_they_are_split() {
    let (folder, scene) = place("split", &panel("even", 10, "spread = 500.0"));
    let [whole, one, two, joined, killed] = ["whole", "one", "two", "joined", "killed"].map(|name| folder.join(name));
    let report = succeeds(&run(&scene, &whole, &["--threads", "2"]));
    assert!(report.contains("10 shots by design even") && report.contains("V50"), "{report}");
    for name in ["v50.csv", "v50.svg", "v50.png"] {
        assert!(whole.join(name).is_file(), "{name}");
    }
    let figures = std::fs::read_to_string(whole.join("v50.csv")).expect("figures");
    assert!(figures.lines().last().is_some_and(|line| line.contains(" within 500,")), "{figures}");
    let expected = shots(&whole);
    assert_eq!(expected.len(), 10);

    let report = succeeds(&run(&scene, &one, &["--shots", "1-4", "--threads", "1"]));
    assert!(report.contains("6 of 10 have not been fired"), "{report}");
    succeeds(&run(&scene, &two, &["--shots", "5-10"]));
    let [one, two] = [&one, &two].map(|path| path.to_str().expect("a path"));
    succeeds(&run(&scene, &joined, &["--collect", one, two]));
    assert_eq!(shots(&joined), expected);
    assert_eq!(std::fs::read_to_string(joined.join("v50.csv")).expect("figures"), figures);
    // What is joined already stays.
    succeeds(&run(&scene, &joined, &["--collect", one]));
    assert_eq!(shots(&joined), expected);

    let mut child = program(&scene, &killed, &["--threads", "1"]).spawn().expect("it starts");
    while std::fs::read_to_string(killed.join("shots.csv")).map_or(0, |text| text.lines().count()) < 4 {
        sleep(Duration::from_millis(5));
    }
    child.kill().expect("it is killed");
    child.wait().expect("it ends");
    // As if it had been killed as it wrote.
    let text = std::fs::read_to_string(killed.join("shots.csv")).expect("a table");
    std::fs::write(killed.join("shots.csv"), format!("{text}9,120.0,1")).expect("it is written");
    fails(&run(&scene, &killed, &[]), "is there, of an earlier run; allowed: --restart");
    succeeds(&run(&scene, &killed, &["--restart"]));
    assert_eq!(shots(&killed), expected);
    // With nothing left to do the report comes again, of more shots those that are missing.
    succeeds(&run(&scene, &killed, &["--restart", "--firth"]));
    assert_eq!(shots(&killed), expected);
    std::fs::write(&scene, panel("even", 12, "")).expect("the scene is written");
    succeeds(&run(&scene, &killed, &["--restart"]));
    assert_eq!((shots(&killed).len(), &shots(&killed)[..10]), (12, &expected[..]));

    // Those beyond a smaller number are left out.
    std::fs::write(&scene, panel("even", 10, "")).expect("the scene is written");
    let report = succeeds(&run(&scene, &killed, &["--restart"]));
    assert!(report.contains("10 shots by design even") && report.contains("2 more in the table are not"), "{report}");

    std::fs::write(&scene, panel("even", 10, "seed = 2")).expect("the scene is written");
    let other = folder.join("other");
    run(&scene, &other, &["--shots", "1-2"]);
    let other = other.to_str().expect("a path");
    for parts in [one, other] {
        fails(&run(&scene, &joined, &["--collect", parts]), "a shot of another scene");
    }
    assert_eq!(shots(&joined), expected);
    fails(
        &run(&scene, &killed, &["--restart"]),
        ": shots.seed is 2, and not given there; allowed: shots of this scene",
    );
    std::fs::write(&scene, panel("even", 10, "")).expect("the scene is written");
    let table = whole.join("shots.csv");
    let text = std::fs::read_to_string(&table).expect("a table");
    let place = text.split('\n').next().and_then(|titles| titles.split(',').position(|title| title == "build"));
    let first = text.lines().nth(1).expect("a shot");
    let build = place.and_then(|place| first.split(',').nth(place)).expect("a build").to_string();
    std::fs::write(&table, text.replace(&build, "00000000")).expect("it is written");
    fails(&run(&scene, &whole, &["--restart"]), "a shot of another build of the program");
}

/// What is refused leaves nothing, and says what is allowed.
#[test]
fn a_run_that_is_refused_leaves_no_directory() {
    let (folder, scene) = place("refused", &panel("even", 10, ""));
    let output = folder.join("new");
    let empty = folder.to_str().expect("a path");
    for (arguments, message) in [
        (
            vec!["--collect", "nowhere"],
            "--collect is nowhere, without a table shots.csv; allowed: directories of toron v50".to_string(),
        ),
        (vec!["--collect", empty], format!("--collect is {empty}, without a table shots.csv")),
        (
            vec!["--restart"],
            format!("--restart without {}; allowed: the directory", output.join("shots.csv").display()),
        ),
        (vec!["--shots", "-3"], "--shots is -3; allowed: FROM-TO".to_string()),
        (
            vec!["--simulate", "9", "--truth", "45", "-1"],
            "--truth is 45 -1; allowed: a speed, and a finite deviation".to_string(),
        ),
    ] {
        fails(&run(&scene, &output, &arguments), &message);
        assert!(!output.exists(), "{message}");
    }
}

/// With until = "decided" a shot that goes through ends as soon as that is certain, earlier than by the rules of
/// others, and counts.
#[test]
fn a_decided_shot_is_through() {
    let text = panel("even", 2, "").replace("[60.0, 200.0]", "[240.0, 260.0]").replace("aim = \"cell\"\n", "");
    let fast = |until: &str| text.replace("end = 0.02\n", &format!("end = 0.02\n{until}"));
    let [decided, whole] = [("decided", "until = \"decided\"\n"), ("whole", "")].map(|(name, until)| {
        let (folder, scene) = place(name, &fast(until));
        let answer = run(&scene, &folder.join("shots"), &[]);
        fails(&answer, "no curve: all shots went through");
        assert!(String::from_utf8_lossy(&answer.stdout).contains("2 through, 0 undecided"));
        let end = |line: &String| line.split(',').nth(9).and_then(|time| time.parse::<f64>().ok()).expect("a time");
        shots(&folder.join("shots")).iter().map(end).collect::<Vec<f64>>()
    });
    assert!(decided.iter().zip(&whole).all(|(early, late)| early < late), "{decided:?} {whole:?}");
}

/// A sequential design goes on where it stopped, and has no part that could be fired alone.
#[test]
fn a_sequential_design_goes_on() {
    let (folder, scene) = place("sequential", &panel("langlie", 5, ""));
    let [whole, parts] = ["whole", "parts"].map(|name| folder.join(name));
    fails(&run(&scene, &parts, &["--shots", "1-2"]), "design langlie needs the fates of the shots before");
    run(&scene, &parts, &[]);
    std::fs::write(&scene, panel("langlie", 9, "")).expect("the scene is written");
    run(&scene, &parts, &["--restart", "--threads", "1"]);
    run(&scene, &whole, &["--threads", "2"]);
    assert_eq!(shots(&parts).len(), 9);
    assert_eq!(shots(&parts), shots(&whole));
}

/// A shot that is undecided is counted, and fired anew when it may take longer.
#[test]
fn undecided_shots_are_counted_and_extended() {
    let short =
        |extension: f64| panel("even", 4, &format!("extension = {extension}")).replace("end = 0.02", "end = 0.0004");
    let (folder, scene) = place("undecided", &short(1.0));
    let output = folder.join("shots");
    let answer = run(&scene, &output, &[]);
    fails(&answer, "no curve: 0 shots have a known fate");
    let report = String::from_utf8_lossy(&answer.stdout);
    assert!(report.contains("4 undecided") && report.contains("Undecided shots are not missing at random"), "{report}");
    assert!(shots(&output).iter().all(|line| line.contains("undecided")));
    std::fs::write(&scene, short(100.0)).expect("the scene is written");
    run(&scene, &output, &["--restart"]);
    let lines = shots(&output);
    // A sequential design has nothing to go on by.
    std::fs::write(&scene, short(1.0).replace("\"even\"", "\"langlie\"")).expect("the scene is written");
    let sequential = folder.join("sequential");
    fails(&run(&scene, &sequential, &[]), "shots 1 to 3 have no fate, and design langlie goes on at 130.0 mm/ms still");
    assert_eq!(shots(&sequential).len(), 3);
    assert!(lines.len() == 4 && lines.iter().filter(|line| line.contains("undecided")).count() < 4, "{lines:?}");
}

/// A yarn is shot at as a panel is; its limit without scatter lies between a stop and a perforation.
#[test]
fn a_yarn_has_a_limit() {
    let text = "units = \"mm-g-ms\"\n\
         [scene]\nspeed = 100.0\nhalf-length = 2.0\nheight = 0.115\nwidth = 0.5337\nlayers = 20\nrows = 2\ncolumns = 4\n\
         mass = 0.01\nradius = 1.0\ncontact-stiffness = 1e5\nend = 0.2\nfailure = \"uniaxial\"\n\
         [shots]\nscatter = 1.0\nnumber = 6\nspeeds = [20.0, 300.0]\ntolerance = 20.0\n";
    let (folder, scene) = place("yarn", &text.replace("scatter = 1.0\n", ""));
    let output = folder.join("limit");
    let report = succeeds(&run(&scene, &output, &["--limit"]));
    assert!(report.contains("Without scatter: stopped at"), "{report}");
    let lines = std::fs::read_to_string(output.join("limit.csv")).expect("a table").lines().count();
    assert!(lines > 6, "{lines}");
    // Known shots are not fired again.
    assert_eq!(succeeds(&run(&scene, &output, &["--limit", "--restart"])), report);
    assert_eq!(std::fs::read_to_string(output.join("limit.csv")).expect("a table").lines().count(), lines);
    // A series needs chance, which a limit does not.
    fails(&run(&scene, &folder.join("shots"), &[]), "nothing scatters: scatter is 0, aim is fixed");
    std::fs::write(&scene, text).expect("the scene is written");
    run(&scene, &folder.join("shots"), &[]);
    assert_eq!(shots(&folder.join("shots")).len(), 6);
    for (line, with, message) in [
        ("number = 6", "number = 1", "number is 1; allowed: 2 to 1000000; 20 or more"),
        (
            "speeds = [20.0, 300.0]",
            "speeds = [300.0, 20.0]",
            "speeds is [300, 20]; allowed: the slowest and then the fastest",
        ),
        ("speeds = [20.0, 300.0]", "speeds = [20.0, 3e6]", "the fastest of speeds is 3000000; allowed: up to"),
        ("number = 6", "number = 6\nstep = 3.0", "step is 3; allowed: with design = \"up-and-down\""),
        ("number = 6", "number = 6\naim = \"cell\"", "aim is \"cell\" of a yarn; allowed: fixed"),
        ("radius = 1.0", "radius = 1.0\nheld = true", "nothing stops it; allowed: a cylinder that is free"),
        ("failure = \"uniaxial\"\n", "", "failure is none: nothing breaks, and every shot is stopped"),
        ("tolerance = 20.0", "tolerance = 1e-9", "tolerance is 0.000000001; allowed: 3.000e-7 or more"),
        (
            "[shots]\nscatter = 1.0\nnumber = 6\nspeeds = [20.0, 300.0]\ntolerance = 20.0\n",
            "",
            "no shots; allowed: a table [shots]",
        ),
    ] {
        std::fs::write(&scene, text.replacen(line, with, 1)).expect("the scene is written");
        fails(&run(&scene, &folder.join("refused"), &[]), message);
    }
    // All through, or all stopped.
    for (speeds, message) in [
        ("[20.0, 25.0]", "all shots were stopped, the fastest at"),
        ("[290.0, 300.0]", "all shots went through, the slowest at"),
    ] {
        std::fs::write(&scene, text.replacen("[20.0, 300.0]\ntolerance = 20.0", speeds, 1))
            .expect("the scene is written");
        let output = folder.join(format!("one-fate-{}", speeds.len()));
        fails(&run(&scene, &output, &[]), message);
        fails(&run(&scene, &output.join("limit"), &["--limit"]), "at both of which shots");
    }
}

/// A test is planned by experiments that are simulated: every design, every curve.
#[test]
fn experiments_are_simulated() {
    let (folder, scene) = place("simulated", &panel("even", 10, ""));
    // The same file is that of a panel, which is meshed without its shots.
    let weave = Command::new(env!("CARGO_BIN_EXE_toron")).arg("weave").arg(&scene).arg("-o").arg(&folder).output();
    succeeds(&weave.expect("it starts"));
    let report = succeeds(&run(&scene, &folder, &["--simulate", "20", "--firth", "--truth", "130", "10"]));
    assert!(
        report.contains("20 simulated experiments of 10 shots") && report.contains("V50 130, deviation 10"),
        "{report}"
    );
    let (all, separated) = report.split_once("Of the experiments that are separated").expect("two tables");
    let lines = |table: &str, design: &str| table.lines().filter(|line| line.starts_with(design)).count();
    for design in ["even", "langlie", "up-and-down", "d-optimal", "3pod"] {
        assert_eq!(lines(all, design), 4, "{report}");
    }
    // Ten shots over fourteen deviations: nearly always.
    assert_eq!(lines(separated, "even"), 4, "{report}");
}
