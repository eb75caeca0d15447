//! What takes too long for every run, or wants a machine without other work: `.ci/long` runs these.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use serde_json::Value;

use toron_materials::bench::scene::Scene;
use toron_strikes::fabric::scene::Scene as Panel;
use toron_test_support::library::{BUILD, LIBRARY, ROOT, SYSTEM, folder, run};

/// The program as users build it: with the tests' dependencies some of its code would be another.
static PROGRAM: LazyLock<PathBuf> = LazyLock::new(|| {
    let build = BUILD.join("program");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.env("CARGO_TARGET_DIR", &build).env("CARGO_NET_OFFLINE", "true").env_remove("CARGO_ENCODED_RUSTFLAGS");
    cargo.args(["build", "--release", "--locked", "--package=toron-program", "--manifest-path"]);
    run(cargo.arg(Path::new(ROOT).join("Cargo.toml")), "cargo");
    build.join("release/toron")
});

fn program() -> Command {
    let mut program = Command::new(&*PROGRAM);
    program.current_dir(ROOT);
    program
}

/// The points a call at which both are compared.
const SIZES: [usize; 5] = [1, 8, 64, 192, 4096];
/// How often both measure, in turn: the least times count, since whatever disturbs a measurement makes it longer.
const TURNS: usize = 6;
/// How far the bench may be from a C program.
const TOLERANCE: f64 = 0.1;

/// Least nanoseconds a point, by the row's name and the points a call.
type Times = BTreeMap<(String, usize), f64>;

fn keep_least(times: &mut Times, name: &str, n: usize, time: f64) {
    let least = times.entry((name.to_string(), n)).or_insert(time);
    *least = least.min(time);
}

/// `ffi-tests/speed/loops.c`, compiled as a user compiles, and the scene that it reads.
fn loops() -> (PathBuf, PathBuf) {
    let folder = folder("speed-loops");
    let (executable, scene) = (folder.join("loops"), folder.join("scene"));
    let mut gcc = Command::new("gcc");
    gcc.args(["-std=c11", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]).arg(format!("-I{ROOT}/include"));
    gcc.arg(format!("{ROOT}/ffi-tests/speed/loops.c")).arg(format!("-L{}", LIBRARY.display())).arg("-ltoron");
    run(gcc.args(SYSTEM).arg(format!("-Wl,-rpath,{}", LIBRARY.display())).arg("-o").arg(&executable), "gcc");
    let points = Scene::<f64>::impact(SIZES[SIZES.len() - 1]).points;
    let numbers: Vec<u8> =
        points.iter().flat_map(|point| point.deformation_gradient).flat_map(f64::to_ne_bytes).collect();
    std::fs::write(&scene, numbers).expect("the scene is written");
    (executable, scene)
}

/// Each entry of `toron bench` takes as long as in a C program that does nothing but call it.
#[test]
#[ignore = "takes six minutes, and a machine without other work"]
fn the_bench_times_every_entry_as_a_c_program_does() {
    let (executable, scene) = loops();
    let (mut in_c, mut in_bench) = (Times::new(), Times::new());
    let output = folder("speed-bench");
    for _ in 0..TURNS {
        for n in SIZES {
            let mut program = Command::new(&executable);
            program.arg(&scene).arg(n.to_string());
            program.args(["mgis", "calculix"].map(|host| LIBRARY.join(format!("libtoron_{host}.so"))));
            for line in String::from_utf8_lossy(&run(&mut program, "").stdout).lines() {
                let row: Value = serde_json::from_str(line).expect("JSON");
                let name = row["name"].as_str().expect("a name");
                keep_least(&mut in_c, name, n, row["nanoseconds"].as_f64().expect("a time"));
            }
        }
        run(program().arg("bench").arg("-o").arg(&output), "");
        let report = std::fs::read_to_string(output.join("bench.json")).expect("the report");
        let report: Value = serde_json::from_str(&report).expect("JSON");
        for row in report["rows"].as_array().expect("rows") {
            let times =
                report["sizes"].as_array().expect("sizes").iter().zip(row["nanoseconds"].as_array().expect("times"));
            for (n, time) in times.filter_map(|(n, time)| Some((n.as_u64()? as usize, time.as_f64()?))) {
                keep_least(&mut in_bench, row["name"].as_str().expect("a name"), n, time);
            }
        }
    }
    // What is no entry of the C interface.
    let of_the_law =
        |name: &str| ["point by point", "block, ", "copy limit"].iter().any(|row| name[4..].starts_with(row));
    let mut wrong = Vec::new();
    println!("{:<34}{:>8}{:>10}{:>10}", "ns a point", "points", "C", "bench");
    for ((name, n), bench) in in_bench.iter().filter(|((name, n), _)| !of_the_law(name) && SIZES.contains(n)) {
        let c = in_c.remove(&(name.clone(), *n)).unwrap_or_else(|| panic!("the C program has no row {name}"));
        let line = format!("{name:<34}{n:>8}{c:>10.2}{bench:>10.2}  {:+.1} %", 100.0 * (bench / c - 1.0));
        println!("{line}");
        if (bench / c - 1.0).abs() > TOLERANCE {
            wrong.push(line);
        }
    }
    assert!(in_c.is_empty(), "the bench has no rows {:?}", in_c.keys());
    assert!(wrong.is_empty(), "beyond {TOLERANCE}:\n{}", wrong.join("\n"));
}

/// The struck panel that gives way as the thesis's does, at both speeds, on the fine mesh; what is other in it by
/// pairs.
fn panel(changes: &[[&str; 2]]) -> String {
    let example = Path::new(ROOT).join("examples/fabric_impact/non_penetrating.toml");
    let text = std::fs::read_to_string(example).expect("the example");
    let (scene, _) = text.split_once("[[case]]").expect("cases");
    let kept = |line: &&str| !["pictures", "checkpoints", "until"].iter().any(|key| line.starts_with(key));
    let scene: Vec<&str> = scene.lines().filter(kept).collect();
    let cases = "\n[[case]]\nname = \"stopped\"\n\n[[case]]\nname = \"pierced\"\nspeed = 142.0\nfailure = \"uniaxial\"\n\
                 end = 0.1\n";
    changes.iter().fold(scene.join("\n") + cases, |text, [from, to]| {
        assert!(text.contains(from), "the example has no {from}");
        text.replace(from, to)
    })
}

/// The README's: of the size and the weave of the results' other tables, to 60 µs at 142 m/s.
const OF_THE_README: [[&str; 2]; 3] =
    [["clearance = 0.01", "clearance = 0.001"], ["radius = 25.4", "radius = 19.05"], ["end = 0.1\n", "end = 0.06\n"]];

/// Runs a panel: its largest deflection at 63 m/s, and the speed that is left of 142 m/s.
fn strike(name: &str, scene: &str) -> [f64; 2] {
    let output = folder(name);
    let file = output.join("panel.toml");
    std::fs::write(&file, scene).expect("the scene is written");
    run(program().arg("fabric").arg(&file).arg("-o").arg(&output), "");
    let summary = std::fs::read_to_string(output.join("summary.csv")).expect("the summary");
    let lines: Vec<Vec<&str>> = summary.lines().map(|line| line.split(',').collect()).collect();
    let value = |case: usize, column: &str| -> Option<f64> {
        let place = lines[0].iter().position(|title| title.split(" (").next() == Some(column))?;
        lines[1 + case][place].parse().ok()
    };
    let deflection = value(0, "deflection_max").expect("a deflection");
    // Shreds may touch the sphere up to the end; its speed no longer changes.
    let speed = value(1, "residual_speed").or_else(|| value(1, "speed_at_end")).expect("a speed");
    println!("{summary}\n63 m/s: {deflection:.3} mm; 142 m/s: {speed:.1} m/s are left");
    [deflection, speed]
}

/// The results of the fabrics, wherever they stand among the documents.
fn results() -> String {
    let places = ["docs/results/fabric-results.md", "docs/results/fabric.md", "docs/fabric-results.md"];
    let text = places.iter().find_map(|place| std::fs::read_to_string(Path::new(ROOT).join(place)).ok());
    text.expect("the fabrics' results")
}

/// The number in a table: of the row that begins so, in the column whose title contains this text.
fn figure(text: &str, row: &str, column: &str) -> Option<f64> {
    let cells =
        |line: &str| -> Vec<String> { line.trim_matches('|').split('|').map(|cell| cell.trim().into()).collect() };
    let mut titles = Vec::new();
    for (line, next) in text.lines().zip(text.lines().skip(1)) {
        if next.starts_with("|--") {
            titles = cells(line);
        }
        if line.starts_with('|') && cells(line)[0] == row {
            let place = titles.iter().position(|title| title.contains(column))?;
            return cells(line)[place].parse().ok();
        }
    }
    None
}

/// What the results call that panel.
const PANEL: &str = "R = 25.4 mm, clearance 10 µm";

/// The documents' figures of the panel of R = 25.4 mm and clearance 10 µm on the fine mesh: deflection at 63 m/s, speed
/// left of 142 m/s.
#[test]
#[ignore = "takes an hour"]
fn the_fine_panel_gives_the_figures_of_the_documents() {
    let [deflection, speed] = strike("fine-panel", &panel(&[]));
    let text = results();
    let documented = figure(&text, "largest deflection, mm", PANEL).expect("the deflection in the results");
    assert!((deflection - documented).abs() < 0.0051, "{deflection} mm at 63 m/s, not {documented}");
    let row = format!("uniaxial, fine, {PANEL}");
    let documented = figure(&text, &row, "speed").unwrap_or_else(|| panic!("no row {row:?} in the results"));
    assert!((speed - documented).abs() < 0.51, "{speed} m/s are left of 142, not {documented}");
}

/// The README's figures of the panel of R = 19.05 mm; `documents.rs` holds the README against the same rows.
#[test]
#[ignore = "takes half an hour"]
fn the_fine_panel_of_the_readme_gives_its_figures() {
    let [deflection, speed] = strike("fine-panel-of-the-readme", &panel(&OF_THE_README));
    let text = results();
    let documented = figure(&text, "largest deflection, mm", "R = 19.05 mm").expect("the deflection in the results");
    assert!((deflection - documented).abs() < 0.0051, "{deflection} mm at 63 m/s, not {documented}");
    let documented = figure(&text, "uniaxial, fine", "speed").expect("the speed in the results");
    assert!((speed - documented).abs() < 0.51, "{speed} m/s are left of 142, not {documented}");
}

/// The figures are found, so that the hours are not for nothing.
#[test]
fn the_figures_of_the_panels_are_in_the_documents() {
    let text = results();
    assert_eq!(figure(&text, "largest deflection, mm", PANEL), Some(6.577));
    assert_eq!(figure(&text, "largest deflection, mm", "R = 19.05 mm"), Some(5.267));
    assert_eq!(figure(&text, "uniaxial, fine", "speed"), Some(114.2));
    for changes in [&[][..], &OF_THE_README] {
        let scene = Panel::parse("panel.toml", &panel(changes)).expect("a scene");
        assert_eq!(scene.cases.len(), 2);
    }
}
