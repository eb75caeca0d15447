//! `toron fabric` on a coarse patch.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::thread::sleep;
use std::time::Duration;

use crate::weave::Picture;
use toron_test_support::library::{ROOT, folder};

/// A quarter of a disc of five by five yarns, struck for this many microseconds; further keys go into the scene's
/// table.
fn scene(end: f64, keys: &str) -> String {
    format!(
        "title = \"a patch\"\nunits = \"mm-g-ms\"\n\
         [weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n\
         [weave.panel]\nshape = \"circle\"\nradius = 3.0\npart = \"quarter\"\n\
         [scene]\nspeed = 142.0\nmass = 0.692\nradius = 2.778\ncontact-stiffness = 1e5\nend = {}\nsample = 0.0005\n{keys}\n",
        1e-3 * end
    )
}

fn strike(name: &str, text: &str, threads: usize) -> (Output, PathBuf) {
    let output = folder(&format!("fabric-{name}-{threads}"));
    (program(&output, text, threads).output().expect("it starts"), output)
}

/// The program, about to run a scene in this folder.
fn program(output: &Path, text: &str, threads: usize) -> Command {
    program_of(Path::new(env!("CARGO_BIN_EXE_toron")), output, text, threads)
}

fn program_of(executable: &Path, output: &Path, text: &str, threads: usize) -> Command {
    let file = output.join("scene.toml");
    std::fs::write(&file, text).expect("the scene is written");
    let mut program = Command::new(executable);
    program.env("RAYON_NUM_THREADS", threads.to_string()).current_dir(ROOT);
    program.arg("fabric").arg(&file).arg("-o").arg(output);
    program
}

/// A column of the history, whose title is followed by its unit.
fn column(history: &str, name: &str) -> Vec<f64> {
    let named = |title: &str| title.split(" (").next() == Some(name);
    let place = history.lines().next().and_then(|line| line.split(',').position(named));
    let place = place.expect("the column is there");
    let value = |line: &str| line.split(',').nth(place).and_then(|cell| cell.parse().ok()).expect("a number");
    history.lines().skip(1).map(value).collect()
}

/// The history of a run that succeeds.
fn history(name: &str, text: &str, threads: usize) -> String {
    let (answer, output) = strike(name, text, threads);
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    std::fs::read_to_string(output.join("scene.csv")).expect("a history")
}

#[test]
fn a_patch_keeps_its_energy_and_is_the_same_on_any_number_of_threads() {
    let text = scene(12.0, "hyperelastic.properties = { k_ld = 126.0 }");
    let [one, two] = [1, 2].map(|threads| history("threads", &text, threads));
    assert!(one == two, "the histories differ");
    let total = column(&one, "total_energy");
    assert!(total.iter().all(|energy| (energy / total[0] - 1.0).abs() < 1e-3), "{total:?}");
    for (name, at_rest) in [("tilt", 0.0), ("slip", 0.0), ("least_volume_ratio", 1.0)] {
        let values = column(&one, name);
        let later = values[1..].iter().fold(0.0_f64, |most, value| most.max((value - at_rest).abs()));
        assert!(values[0] == at_rest && later > 1e-4, "{name}: {values:?}");
    }
    let (speed, deflection) = (column(&one, "speed"), column(&one, "deflection"));
    let last = speed.len() - 1;
    assert!(speed[last] < 0.99 * speed[0] && speed.windows(2).all(|pair| pair[1] <= pair[0]), "{speed:?}");
    // The panel moves with the sphere, but for what contact gives way.
    let travel = column(&one, "travel");
    assert!((deflection[last] / travel[last] - 1.0).abs() < 0.02, "{} {}", deflection[last], travel[last]);
    assert!(column(&one, "friction_energy")[last] > 0.0 && column(&one, "contact_energy")[last] > 0.0);
}

#[test]
fn yarns_that_fail_are_torn_and_let_the_sphere_through() {
    let text = scene(60.0, "failure = \"uniaxial\"\nhyperelastic.properties = { k_ld = 126.0, eps_lim = 0.02 }");
    let history = history("torn", &text, 2);
    let (torn, speed) = (column(&history, "torn_yarns"), column(&history, "speed"));
    let (total, last) = (column(&history, "total_energy"), speed.len() - 1);
    assert!(torn[last] >= 2.0, "{torn:?}");
    assert!(speed[last] > 0.5 * speed[0] && speed[last] < 0.99 * speed[0], "{}", speed[last]);
    assert!(total.iter().all(|energy| (energy / total[0] - 1.0).abs() < 0.01), "{total:?}");
}

#[test]
fn a_coarse_panel_that_is_torn_is_the_same_on_any_number_of_threads() {
    let keys = "failure = \"uniaxial\"\nhyperelastic.properties = { k_ld = 126.0 }\n\
                [scene.strength]\nweibull-modulus = 8.0\nstrain = 0.02\nreference-length = 5.0\ncell = 1.0";
    let text = scene(24.0, keys).replace("radius = 3.0\n", "radius = 3.5\ncoarse-radius = 2.0\n");
    let text = text.replace("mass = 0.692\nradius = 2.778", "mass = 0.05\nradius = 1.2");
    let [one, two] = [1, 2].map(|threads| history("coarse", &text, threads));
    assert!(one == two, "the histories differ");
    let (deleted, total) = (column(&one, "deleted"), column(&one, "total_energy"));
    assert!(deleted[deleted.len() - 1] > 10.0, "{deleted:?}");
    assert!(total.iter().all(|energy| (energy / total[0] - 1.0).abs() < 0.01), "{total:?}");
}

#[test]
fn a_scene_that_cannot_be_run_is_refused_by_its_line() {
    // The line of each; the keys begin on line 18.
    let cases = [
        (18, "yarn-friction = -0.1", "yarn-friction is -0.1; allowed: a finite number >= 0"),
        (18, "hyperelastic-radius = 1.0", "hyperelastic-radius is 1; allowed: with law = \"hybrid\""),
        (11, "law = \"hybrid\"", "hyperelastic-radius is missing; allowed: a finite number > 0"),
        (
            18,
            "linear-elastic.preset = \"kevlar-km2-600-linear\"",
            "linear-elastic is not used; allowed: the material of",
        ),
        (
            13,
            "[[case]]\nname = \"one\"\nradius = 2778.0",
            "mass is 0.692, of a sphere with radius 2778: 7.706e-6 kg/m³; allowed: 8.980e6 to 2.065e9, of 100 to 23000 kg/m³",
        ),
        (18, "length = 3.0", "length is 3; allowed: with shape = \"flat\" or \"hemisphere\""),
        (19, "shape = \"hemisphere\"\nlength = 1.0", "length is 1; allowed: the radius of its end, 2.778, or more"),
        (18, "frames = 10000", "frames is 10000; allowed: a whole number from 0 to 9999"),
        (18, "weave.clearance = 0.01", "weave in [scene]; allowed: [weave], or in a [[case]]"),
        (18, "hyperelastic-radius = 1.0\nCASE", "hyperelastic-radius is 1; allowed: with law = \"hybrid\""),
        (20, "CASE\nhyperelastic-radius = 1.0", "hyperelastic-radius is 1; allowed: with law = \"hybrid\""),
        (
            18,
            "linear-elastic.preset = \"x\"\nCASE",
            "linear-elastic is not used; allowed: the material of a case's law",
        ),
        (
            20,
            "CASE\nlinear-elastic.preset = \"x\"",
            "linear-elastic is not used; allowed: the material of a case's law",
        ),
        (20, "CASE\nspeed = 142000.0", "speed is 142000; allowed: up to 4480, which stretches the yarn by 0.5"),
        (20, "CASE\nweave.panel.half = [3.0, 3.0]", "panel has half, of a rectangle; allowed: radius"),
        (20, "CASE\nweave.panel.shape = \"rectangle\"", "panel.half is missing; allowed: half sizes along x and y"),
        // What goes with the scene's other keys, but not with the case's, is the case's mistake.
        (20, "CASE\nweave.columns = 5", "halve the yarns on them, but columns is 5; allowed: an even number"),
        (20, "CASE\nweave.pattern = [\"oouu\", \"uoou\", \"uuoo\", \"ouuo\"]", "part is quarter, but the plane"),
        (20, "CASE\nweave.panel.radius = 1e9", "elements; allowed: up to 1e7"),
        (
            21,
            "CASE\nfriction = 0.1\nweave.warp.pitch = 0.5",
            "allowed: up to 0.4980, its pitch less twice the clearance",
        ),
    ];
    for (line, keys, message) in cases {
        let keys = keys.replace("CASE", "[[case]]\nname = \"one\"");
        let (answer, _) = strike("refused", &scene(1.0, &keys), 1);
        let found = String::from_utf8_lossy(&answer.stderr).into_owned();
        assert!(!answer.status.success() && found.contains(message), "{keys}: {found}");
        assert!(found.contains(&format!("scene.toml:{line}: ")), "{keys}: {found}");
    }
}

/// What only the meshed panel shows is found before the first case is run.
#[test]
fn no_case_is_run_if_one_cannot_begin() {
    let cases = [
        (
            "weave.panel.centre = \"gap\"\nweave.panel.part = \"whole\"\nradius = 0.05\nmass = 4e-6",
            "the sphere's radius is 0.05000 in case two",
        ),
        ("law = \"hybrid\"\nhyperelastic-radius = 50.0", "in case two, so that all elements are hyperelastic; allowed"),
        (
            "law = \"hybrid\"\nhyperelastic-radius = 1e-3",
            "in case two, so that all elements are linear elastic; allowed",
        ),
    ];
    for (keys, message) in cases {
        let keys = format!("[[case]]\nname = \"one\"\n[[case]]\nname = \"two\"\n{keys}");
        let (answer, output) = strike("not-begun", &scene(1.0, &keys), 1);
        let found = String::from_utf8_lossy(&answer.stderr).into_owned();
        assert!(!answer.status.success() && found.contains(message), "{found}");
        assert!(!output.join("one.csv").exists());
    }
}

/// A case has the keys of the weave that it does not give itself from the scene's.
#[test]
fn cases_have_panels_of_their_own() {
    let keys = "[[case]]\nname = \"base\"\n[[case]]\nname = \"loose\"\nweave.clearance = 0.01\n\
                [[case]]\nname = \"small\"\nweave.panel.radius = 2.0\n\
                [[case]]\nname = \"square\"\nweave.panel = { shape = \"rectangle\", half = [2.0, 2.0] }";
    let (answer, output) = strike("panels", &scene(0.5, keys), 2);
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let summary = std::fs::read_to_string(output.join("summary.csv")).expect("a file");
    let elements = column(&summary, "elements");
    // A smaller disc has fewer yarns, and shorter ones; a square has more in its corners.
    assert!(elements[0] == elements[1] && elements[2] < elements[3] && elements[3] < elements[0], "{elements:?}");
    // Alone they are the same, to the bit.
    let alone = scene(0.5, "").replace("along = 4", "clearance = 0.01\nalong = 4");
    let [one, other] =
        [history("panel-alone", &alone, 2), std::fs::read_to_string(output.join("loose.csv")).expect("a file")];
    assert!(one == other && one != std::fs::read_to_string(output.join("base.csv")).expect("a file"));
}

/// Yarns of warp and weft may have materials of their own, of the case's law.
#[test]
fn warp_and_weft_have_materials_of_their_own() {
    let keys = "[[case]]\nname = \"alike\"\n[[case]]\nname = \"named\"\nweave.weft.material.preset = \"kevlar-km2-600\"\n\
                [[case]]\nname = \"heavy\"\nweave.weft.material.density = 2.7028e-3\n";
    let (answer, output) = strike("families", &scene(3.0, keys), 2);
    let report = String::from_utf8_lossy(&answer.stdout).into_owned();
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let read = |name: &str| std::fs::read_to_string(output.join(name)).expect("a history");
    assert!(read("alike.csv") == read("named.csv"), "the same material twice");
    // Twice the mass of the weft is slower to be taken along, and takes more of the sphere's speed.
    let last = |name: &str| column(&read(name), "speed").last().copied().expect("a speed");
    assert!(last("heavy.csv") < last("alike.csv") - 0.05, "{} {}", last("heavy.csv"), last("alike.csv"));
    let wanted = "warp kevlar-km2-600; weft kevlar-km2-600 (density = 0.0027028 g/mm³)";
    assert!(report.contains(wanted), "{report}");
    let hybrid = scene(
        1.0,
        "law = \"hybrid\"\nhyperelastic-radius = 1.0\n[[case]]\nname = \"one\"\nweave.warp.material.density = 1e-3",
    );
    let error = String::from_utf8_lossy(&strike("family-hybrid", &hybrid, 1).0.stderr).into_owned();
    assert!(
        error.contains("scene.toml:22: material of a family of yarns, or of a ply, with law = \"hybrid\"; allowed: "),
        "{error}"
    );
}

/// A sphere and a cylinder with a hemispherical end meet the panel alike, one with a flat end with more of it at once.
#[test]
fn cylinders_strike_by_their_end() {
    let keys = "hyperelastic.properties = { k_ld = 126.0 }\n[[case]]\nname = \"sphere\"\n[[case]]\nname = \"round\"\n\
                shape = \"hemisphere\"\nlength = 4.6\n[[case]]\nname = \"flat\"\nshape = \"flat\"\nlength = 3.7\n";
    let (answer, output) = strike("shapes", &scene(4.0, keys), 2);
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let read = |name: &str| std::fs::read_to_string(output.join(name)).expect("a history");
    assert!(read("sphere.csv") == read("round.csv"), "nothing has come up to the wall");
    let (sphere, flat) = (read("sphere.csv"), read("flat.csv"));
    let last = |history: &str, name: &str| column(history, name).last().copied().expect("a value");
    assert!(last(&flat, "speed") < last(&sphere, "speed") - 1.0, "{flat}");
    assert!(column(&flat, "total_energy").windows(2).all(|pair| (pair[1] / pair[0] - 1.0).abs() < 1e-3), "{flat}");
}

#[test]
fn a_run_that_was_killed_goes_on_with_the_same_bits() {
    let keys = "failure = \"uniaxial\"\nframes = 6\npictures = [0.001, 0.009]\n\
                hyperelastic.properties = { k_ld = 126.0, eps_lim = 0.02 }";
    let whole = folder("fabric-whole");
    let text = scene(12.0, keys);
    assert!(program(&whole, &text, 2).output().expect("it starts").status.success());
    // On a light ground yarns that carry are yellow to red, the others grey; the four scales cover less than 0.5 %.
    let picture = Picture::read(&whole.join("scene-panel-2.png"));
    let light = picture.share(|[red, green, blue]| red.min(green).min(blue) > 250);
    let carrying = picture.share(|[red, _, blue]| red > blue + 60);
    let grey =
        picture.share(|[red, green, blue]| red.max(green).max(blue) < red.min(green).min(blue) + 16 && red < 235);
    assert!(light > 0.3 && carrying > 0.01 && grey > 0.1, "{light} {carrying} {grey}");
    let stopped = folder("fabric-stopped");
    let text = text + "checkpoints = 5\n";
    let checkpoint = stopped.join("scene.checkpoint");
    let _ = std::fs::remove_file(&checkpoint);
    let _ = std::fs::remove_file(stopped.join("summary.csv"));
    let mut child = program(&stopped, &text, 2).spawn().expect("it starts");
    while !checkpoint.exists() {
        sleep(Duration::from_millis(2));
        assert!(checkpoint.exists() || child.try_wait().expect("a process").is_none(), "it ended without a checkpoint");
    }
    let _ = child.kill(); // or it has ended
    child.wait().expect("it ends");
    // The history has grown with the run; where the machine was faster than the kill, all of it is there.
    let [history, complete] =
        [&stopped, &whole].map(|from| std::fs::read_to_string(from.join("scene.csv")).expect("a file"));
    assert!(history.lines().count() > 3 && complete.starts_with(&history), "{history}");
    // The same build in another file, as after another installation: with a byte at its end.
    let other = stopped.join("toron");
    let mut bytes = std::fs::read(env!("CARGO_BIN_EXE_toron")).expect("the program");
    bytes.push(0);
    std::fs::copy(env!("CARGO_BIN_EXE_toron"), &other).expect("it is copied");
    std::fs::write(&other, bytes).expect("it is written");
    let answer = loop {
        match program_of(&other, &stopped, &text, 1).arg("--restart").output() {
            // A process that another test starts at this moment may still hold the program that was written.
            Err(error) if error.kind() == std::io::ErrorKind::ExecutableFileBusy => sleep(Duration::from_millis(10)),
            answer => break answer.expect("it starts"),
        }
    };
    std::fs::remove_file(&other).expect("it is removed");
    let said = String::from_utf8_lossy(&answer.stderr).to_string();
    assert!(answer.status.success() && said.contains("case scene: goes on from its checkpoint"), "{said}");
    let mut names = ["scene.csv", "scene.pvd", "scene-panel-1.svg", "scene-panel-2.svg"].map(str::to_string).to_vec();
    names.extend((0..=6).map(|frame| format!("scene-{frame:04}.vtu")));
    for name in names {
        let [one, other] = [&whole, &stopped].map(|from| std::fs::read(from.join(&name)).expect("a file"));
        assert!(one == other, "{name} differs");
    }
    let nowhere = folder("fabric-nowhere");
    let (file, new) = (nowhere.join("scene.toml"), nowhere.join("new"));
    std::fs::write(&file, &text).expect("a file");
    let mut restart = Command::new(env!("CARGO_BIN_EXE_toron"));
    let answer = restart.arg("fabric").arg(&file).arg("-o").arg(&new).arg("--restart").output().expect("it starts");
    let error = String::from_utf8_lossy(&answer.stderr).to_string();
    assert!(!answer.status.success() && error.contains("no case has a checkpoint in "), "{error}");
    assert!(!new.exists(), "a directory without a run");
    // A checkpoint of something else is refused: of another scene, and of another build.
    let refused = |text: &str, of: &str| {
        let answer = program(&stopped, text, 1).arg("--restart").output().expect("it starts");
        let error = String::from_utf8_lossy(&answer.stderr).to_string();
        let wanted =
            format!("the checkpoint of case scene is of another {of}; allowed: one of the same build and scene, ");
        assert!(!answer.status.success() && error.contains(&wanted), "{error}");
    };
    refused(&text.replace("0.02 }", "0.03 }"), "scene");
    let own = String::from_utf8(
        Command::new(env!("CARGO_BIN_EXE_toron")).arg("--version").output().expect("it starts").stdout,
    );
    let own = own.expect("UTF-8").split("build ").nth(1).expect("a build")[..8].to_string();
    let bytes = std::fs::read(&checkpoint).expect("a file");
    let place = bytes.windows(8).position(|window| window == own.as_bytes()).expect("the build is in it");
    let mut of_other = bytes.clone();
    of_other[place..place + 8].copy_from_slice(b"0badb111");
    let contents = of_other.len() - 4;
    let sum = crc32fast::hash(&of_other[..contents]);
    of_other[contents..].copy_from_slice(&sum.to_le_bytes());
    std::fs::write(&checkpoint, of_other).expect("it is written");
    let version = env!("CARGO_PKG_VERSION");
    refused(&text, &format!("build of the program (toron {version} build 0badb111, not toron {version} build {own})"));
    std::fs::write(&checkpoint, &bytes).expect("it is written");
    // So is one in which a single bit has changed, and what is none at all.
    let mut bytes = bytes;
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    for damaged in [&bytes[..], b"not one", b""] {
        std::fs::write(&checkpoint, damaged).expect("it is written");
        let answer = program(&stopped, &text, 1).arg("--restart").output().expect("it starts");
        let error = String::from_utf8_lossy(&answer.stderr).to_string();
        assert!(!answer.status.success() && error.contains("the checkpoint of case scene is damaged"), "{error}");
    }
}

#[test]
fn what_nothing_holds_against_sliding_is_said() {
    let report = |name: &str, keys: &str| {
        let (answer, _) = strike(name, &scene(1.0, keys), 2);
        assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
        String::from_utf8_lossy(&answer.stdout).to_string()
    };
    let said =
        "warning: case scene: k_ld is 0 MPa in kevlar-km2-600, less than 1 MPa: the middle of a section slides along";
    let sliding = report("sliding", "");
    assert!(sliding.contains(said) && sliding.contains("  sliding"), "{sliding}");
    let stiff = |end: f64| {
        let text = scene(end, "hourglass = 1e3").replace("radius = 3.0", "radius = 4.0");
        String::from_utf8_lossy(&strike("stiff", &text, 2).0.stdout)
            .contains("warning: case scene: hourglass energy is")
    };
    let ends = [1.0, 16.0].map(stiff);
    assert_eq!(ends, [false, true], "not before a wave has come to the rim");
    let early = report("early", "hourglass = 1e3");
    assert!(early.contains("warning: case scene: it ended, or an element failed, after 0.1"), "{early}");
    assert!(!report("held", "hyperelastic.properties = { k_ld = 10.0 }").contains("k_ld is"));
    assert!(!report("linear", "law = \"linear-elastic\"").contains("k_ld is"));
}

#[test]
fn a_sphere_that_turns_back_is_followed_to_the_end() {
    let text = scene(60.0, "until = \"end\"\nhyperelastic.properties = { k_ld = 126.0 }")
        .replace("speed = 142.0", "speed = 20.0")
        .replace("mass = 0.692", "mass = 0.2");
    let history = history("rebound", &text, 2);
    let (time, speed) = (column(&history, "time"), column(&history, "speed"));
    assert!(time.last().is_some_and(|&time| (time - 0.06).abs() < 1e-6), "{time:?}");
    assert!(speed.last().is_some_and(|&speed| speed < 0.0), "{speed:?}");
}

#[test]
fn a_panel_whose_rim_is_free_is_taken_along() {
    let keys = "hyperelastic.properties = { k_ld = 126.0 }";
    let speed = |name: &str, rim: &str| {
        let text = scene(20.0, &format!("rim = \"{rim}\"\n{keys}")).replace("speed = 142.0", "speed = 40.0");
        let history = history(name, &text, 2);
        let total = column(&history, "total_energy");
        assert!(total.iter().all(|energy| (energy / total[0] - 1.0).abs() < 1e-3), "{total:?}");
        column(&history, "speed").last().copied().expect("a speed")
    };
    let (fixed, free) = (speed("rim-fixed", "fixed"), speed("rim-free", "free"));
    assert!(fixed < free - 1.0 && free < 40.0, "{fixed} {free}");
}

/// A scene that is wrong without an error is called so, in the terminal and in the summary.
#[test]
fn a_wrong_scene_does_not_look_right() {
    let sound = "hyperelastic.properties = { k_ld = 126.0 }";
    let keys = format!(
        "{sound}\n[[case]]\nname = \"sound\"\n[[case]]\nname = \"heavy\"\nspeed = 4.0\nhyperelastic.density = 1.3514\n\
         [[case]]\nname = \"needle\"\nradius = 0.05\nshape = \"hemisphere\"\n"
    );
    let (answer, output) = strike("wrong", &scene(6.0, &keys), 2);
    assert!(answer.status.success());
    let [report, log] = [&answer.stdout, &answer.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    let wave = "warning: case heavy: kevlar-km2-600 (density = 1.3514 g/mm³; k_ld = 126 MPa): the wave along the fibre has 0.2468 km/s";
    let mesh = "warning: case needle: the striker's radius of 0.05000 mm is less than 4 edges of the elements' faces";
    for warning in [wave, "warning: case heavy: the panel weighs 177.", mesh] {
        // Before hours are spent, and at the end.
        assert!(report.contains(warning) && log.contains(warning), "{report}\n{log}");
    }
    assert!(
        report.contains("warning: case needle: hourglass energy is ") && !report.contains("case sound:"),
        "{report}"
    );
    let summary = std::fs::read_to_string(output.join("summary.csv")).expect("a file");
    let verdicts = [",sound,", ",units; transient,", ",mesh; hourglass; jacobian,"];
    assert!(summary.lines().skip(1).zip(verdicts).all(|(line, verdict)| line.contains(verdict)), "{summary}");
}

/// What is said of a run, and when it ends, does not depend on how often its history is written.
#[test]
fn a_verdict_does_not_depend_on_the_history() {
    let keys = "failure = \"uniaxial\"\nhyperelastic.properties = { k_ld = 126.0, eps_lim = 0.02 }\n\
                [[case]]\nname = \"torn\"\n[[case]]\nname = \"needle\"\nradius = 0.05\nshape = \"hemisphere\"\nend = 0.006\n";
    let of = |name: &str, sample: &str| {
        let (answer, output) = strike(name, &scene(20.0, keys).replace("sample = 0.0005", sample), 2);
        assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
        let read = |name: &str| std::fs::read_to_string(output.join(name)).expect("a file");
        // But for the computing times.
        let said = |line: &str| line.split_once(",ns_per_zone_cycle").map_or(line, |(before, _)| before).to_string();
        let summary: Vec<String> = read("summary.csv").lines().map(said).collect();
        let columns = summary[0].split(',').count();
        let summary: Vec<String> =
            summary.iter().map(|line| line.split(',').take(columns).collect::<Vec<_>>().join(",")).collect();
        let warnings = String::from_utf8_lossy(&answer.stdout).matches("warning: case needle").count();
        let last = read("torn.csv").lines().last().expect("a line").to_string();
        (summary, warnings, last, read("torn.csv").lines().count())
    };
    let (often, seldom) = (of("often", "sample = 0.0001"), of("seldom", "sample = 0.006"));
    assert_eq!((&often.0, often.1, &often.2), (&seldom.0, seldom.1, &seldom.2));
    assert!(often.0[2].contains(",mesh; ") && often.1 > 2 && often.3 > 10 * seldom.3, "{often:?} {seldom:?}");
}

/// The default yarn of the other law beside one's own is most likely an oversight.
#[test]
fn a_default_yarn_beside_one_s_own_is_refused() {
    let own = "hyperelastic = { law = \"hyperelastic\", density = 1.44e-3, \
               properties = { k_el = 9e4, k_tc = 1e3, p = 2.2, k_td = 650.0, k_ld = 20.0 } }";
    let cases = "[[case]]\nname = \"own\"\n[[case]]\nname = \"other\"\nlaw = \"linear-elastic\"";
    let (answer, output) = strike("default-yarn", &scene(0.5, &format!("{own}\n{cases}")), 1);
    let error = String::from_utf8_lossy(&answer.stderr).into_owned();
    let wanted =
        "scene.toml:21: linear-elastic names no yarn, and the scene has one of its own, hyperelastic; allowed: ";
    assert!(!answer.status.success() && error.contains(wanted) && !output.join("own.csv").exists(), "{error}");
    let named = format!("{own}\n{cases}\nlinear-elastic.preset = \"kevlar-km2-600-linear\"");
    let (answer, _) = strike("own-yarn", &scene(0.5, &named), 1);
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
}

/// Waits until a file has so many lines.
fn wait_for_lines(child: &mut std::process::Child, file: &Path, lines: usize) {
    while std::fs::read_to_string(file).map_or(0, |text| text.lines().count()) < lines {
        sleep(Duration::from_millis(2));
        assert!(child.try_wait().expect("a process").is_none(), "it ended too early");
    }
}

/// Runs until the history has so many lines, then ends the run by Ctrl-C; returns its outputs. The scene must not end
/// by itself.
fn interrupted_after(lines: usize, mut program: Command, history: &Path, meanwhile: impl FnOnce()) -> [String; 2] {
    program.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
    let mut child = program.spawn().expect("it starts");
    wait_for_lines(&mut child, history, lines);
    meanwhile();
    let signal = || {
        let mut kill = Command::new("kill");
        kill.arg("-INT").arg(child.id().to_string()).stderr(std::process::Stdio::null());
        kill.status().expect("there is kill").success()
    };
    assert!(signal());
    // As of `timeout`, which sends one to the program and one to its group; the run may have ended between them.
    signal();
    let answer = child.wait_with_output().expect("it ends");
    let outputs = [&answer.stdout, &answer.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    assert!(answer.status.code() == Some(1) && outputs[0].contains("  interrupted"), "{outputs:?}");
    outputs
}

/// The runs end when they are told to, so that no machine is too fast or too slow for this.
#[test]
fn a_run_that_is_interrupted_says_how_it_goes_on_and_does_so_with_the_same_bits() {
    let text = scene(1e4, "hyperelastic.properties = { k_ld = 126.0 }\nframes = 9999");
    let text = text.replace("radius = 2.778", "radius = 2.778\nuntil = \"end\"");
    let new = |name: &str| {
        let output = folder(name);
        let _ = std::fs::remove_file(output.join("scene.csv"));
        output
    };
    let (output, whole) = (new("fabric-interrupted"), new("fabric-interrupted-whole"));
    let history = output.join("scene.csv");
    let second = || {
        // A second run in the same directory would write the same files.
        let answer = program(&output, &text, 1).output().expect("it starts");
        let error = String::from_utf8_lossy(&answer.stderr).into_owned();
        let wanted =
            format!("output is {}, to which another run writes (toron.lock is locked); allowed: ", output.display());
        assert!(answer.status.code() == Some(2) && error.contains(&wanted), "{error}");
    };
    let [report, log] = interrupted_after(4, program(&output, &text, 2), &history, second);
    let verdict = "interrupted: go on with --restart";
    let summary = std::fs::read_to_string(output.join("summary.csv")).expect("a summary");
    assert!(summary.contains(&format!(",{verdict},")), "{summary}");
    assert!(report.contains(&format!("  {verdict}  ")) && !report.contains("too early to judge"), "{report}");
    assert!(log.contains("case scene was interrupted after time 0.0") && log.contains(" --restart\n"), "{log}");
    let read = |from: &Path| std::fs::read_to_string(from.join("scene.csv")).expect("a history");
    let first = read(&output);
    let mut restart = program(&output, &text, 1);
    restart.arg("--restart");
    // The file is written anew with what it had.
    let [_, log] = interrupted_after(first.lines().count() + 8, restart, &history, || ());
    assert!(log.contains("case scene: goes on from its checkpoint"), "{log}");
    let restarted = read(&output);
    let lines = restarted.lines().count();
    interrupted_after(lines, program(&whole, &text, 2), &whole.join("scene.csv"), || ());
    assert!(restarted.starts_with(&first) && read(&whole).starts_with(&restarted), "{restarted}");
    let frame = |from: &Path, number: usize| std::fs::read(from.join(format!("scene-{number:04}.vtu"))).ok();
    assert!((0..2).all(|number| frame(&whole, number).is_some() && frame(&whole, number) == frame(&output, number)));
}

/// A case that has ended stays as it is when a later one was interrupted; and all files of an earlier run go before the
/// first case.
#[test]
fn cases_that_have_ended_are_not_begun_again() {
    let keys = "hyperelastic.properties = { k_ld = 126.0 }\n[[case]]\nname = \"first\"\nend = 0.001\n\
                [[case]]\nname = \"second\"\nuntil = \"end\"\n";
    let text = scene(1e5, keys);
    let output = folder("fabric-ended");
    for entry in std::fs::read_dir(&output).expect("a folder").flatten() {
        std::fs::remove_file(entry.path()).expect("it is removed");
    }
    for stale in ["first-panel-7.png", "second-panel-7.png", "second.checkpoint"] {
        std::fs::write(output.join(stale), "").expect("a file");
    }
    // Without a run that has written there, they would be a user's own.
    let owner = r#"{"command":"weave","scene":"weave.toml","names":["weave"]}"#;
    std::fs::write(output.join("toron.lock"), format!("{owner}\n")).expect("a file");
    let second = output.join("second.csv");
    let [report, log] = interrupted_after(4, program(&output, &text, 2), &second, || ());
    let of = |report: &str| report.lines().find(|line| line.starts_with("first ")).expect("a case").to_string();
    assert!(log.contains("2 files of an earlier run are removed from "), "{log}");
    let aside = "the checkpoint of an earlier run of case second is now ";
    assert!(log.contains(aside) && output.join("second.checkpoint-old").exists(), "{log}");
    assert!(!output.join("second-panel-7.png").exists());
    let state = || {
        let file = output.join("first.csv");
        let written = std::fs::metadata(&file).and_then(|data| data.modified()).expect("a time");
        (std::fs::read(&file).expect("a history"), written)
    };
    let (before, lines) = (state(), std::fs::read_to_string(&second).expect("a history").lines().count());
    let mut restart = program(&output, &text, 2);
    restart.arg("--restart");
    let [again, log] = interrupted_after(lines + 2, restart, &second, || ());
    assert!(log.contains("case first: has ended, its files stay") && !log.contains("removed"), "{log}");
    assert!(state() == before && of(&again) == of(&report), "{again}\n{report}");
    // What has ended has nothing from which it could go on.
    let later = program(&output, &text.replace("end = 0.001", "end = 0.002"), 1).arg("--restart").output();
    let error = String::from_utf8_lossy(&later.expect("it starts").stderr).into_owned();
    let wanted = "the checkpoint of case first is of its end at 0.001000, from which it cannot go on; allowed: end and";
    assert!(error.contains(wanted) && state() == before, "{error}");
}

/// What only the future depends on may be other than it was.
#[test]
fn a_restart_goes_on_to_a_later_end() {
    let keys = "hyperelastic.properties = { k_ld = 126.0 }\ncheckpoints = 2\nframes = 2";
    let base = scene(3.0, keys).replace("sample = 0.0005\n", "");
    let (answer, output) = strike("later", &base, 2);
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    // Without a terminal progress is told in lines.
    let log = String::from_utf8_lossy(&answer.stderr).into_owned();
    assert!(log.matches(" %, time ").count() >= 8 && log.contains("case scene: 100 %, "), "{log}");
    let read = || std::fs::read_to_string(output.join("scene.csv")).expect("a history");
    let first = read();
    let later =
        base.replace("end = 0.003", "end = 0.006").replace("frames = 2", "frames = 3\npictures = [0.001, 0.005]");
    let restart = |text: &str| program(&output, text, 2).arg("--restart").output().expect("it starts");
    let answer = restart(&later.replace("checkpoints = 2", "checkpoints = 3"));
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let second = read();
    // Samples go on at the first run's distance, a 400th of its end, but for its last one, which was at the end itself.
    let (times, before) = (column(&second, "time"), column(&first, "time"));
    assert_eq!(times[..before.len() - 1], before[..before.len() - 1]);
    let last = times[times.len() - 1];
    assert!(
        (last - 0.006).abs() < 1e-9 && times.len() > 3 * before.len() / 2,
        "{last} {} {}",
        times.len(),
        before.len()
    );
    // A frame at 0 and 0.0015, two more at a third each of the new end; a picture of what is to come.
    let frames = std::fs::read_to_string(output.join("scene.pvd")).expect("a series");
    assert!(frames.matches("<DataSet ").count() >= 4, "{frames}");
    assert!(output.join("scene-panel-1.png").exists() && !output.join("scene-panel-2.png").exists());
    let answer = restart(&base.replace("end = 0.003", "end = 0.004"));
    let error = String::from_utf8_lossy(&answer.stderr).into_owned();
    let wanted = "end is 0.004000 in case scene, whose checkpoint is of 0.006000; allowed: 0.006000 or later";
    assert!(!answer.status.success() && error.contains(wanted), "{error}");
    let answer = restart(&later.replace("speed = 142.0", "speed = 141.0"));
    assert!(!answer.status.success() && String::from_utf8_lossy(&answer.stderr).contains("of another scene"));
}

#[test]
fn a_checkpoint_that_is_no_file_is_not_waited_for() {
    let output = folder("fabric-pipe");
    let pipe = output.join("scene.checkpoint");
    let _ = std::fs::remove_file(&pipe);
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("there is mkfifo").success());
    let refused = |restart: bool| {
        let mut program = program(&output, &scene(0.5, "checkpoints = 1"), 1);
        if restart {
            program.arg("--restart");
        }
        let answer = program.output().expect("it starts");
        let error = String::from_utf8_lossy(&answer.stderr).into_owned();
        let wanted = format!("{} is a pipe or a device; allowed: a regular file, or none", pipe.display());
        assert!(!answer.status.success() && error.contains(&wanted), "{error}");
    };
    refused(true);
    refused(false);
    std::fs::remove_file(&pipe).expect("it is removed");
}
