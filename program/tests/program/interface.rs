//! What commands have in common: scenes to start from, JSON, quiet, the standard input, misspelt keys, the order of the
//! commands.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::Value;

use toron_test_support::library::ROOT;

/// A directory of this test's own, empty.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("interface-{name}"));
    if folder.exists() {
        std::fs::remove_dir_all(&folder).expect("an old folder can be removed");
    }
    std::fs::create_dir_all(&folder).expect("a folder can be made");
    folder
}

fn toron(folder: &Path, arguments: &[&str]) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    program.args(arguments).current_dir(folder);
    program
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("output is UTF-8")
}

/// What the program prints to both outputs, when it succeeds.
fn said(folder: &Path, arguments: &[&str]) -> [String; 2] {
    let output = toron(folder, arguments).output().expect("the program starts");
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    [output.stdout, output.stderr].map(|bytes| text(&bytes))
}

fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = toron(folder, arguments).output().expect("the program starts");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    text(&output.stderr)
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let [out, _] = said(folder, &[arguments, &["--json"]].concat());
    serde_json::from_str(&out).unwrap_or_else(|error| panic!("{arguments:?}: {error}\n{out}"))
}

/// A table's column below a heading.
fn column<'a>(table: &'a Value, heading: &str) -> Vec<&'a Value> {
    let columns = table["columns"].as_array().expect("columns");
    let place = columns.iter().position(|column| column[0] == heading).unwrap_or_else(|| panic!("{heading}: {table}"));
    table["rows"].as_array().expect("rows").iter().map(|row| &row[place]).collect()
}

/// Writes a scene to start from, which may be changed before it runs; returns the folder, and the command that it says.
fn started(name: &str, changes: &[(&str, &str)]) -> (PathBuf, Vec<String>) {
    // Tests that run side by side have folders of their own.
    static NUMBER: AtomicUsize = AtomicUsize::new(0);
    let folder = folder(&format!("init-{name}-{}", NUMBER.fetch_add(1, Ordering::Relaxed)));
    let [out, _] = said(&folder, &["init", name]);
    let command = out.lines().last().and_then(|line| line.trim().strip_prefix("toron ")).expect("a command");
    let file = folder.join(format!("{name}.toml"));
    let mut scene = std::fs::read_to_string(&file).expect("the scene");
    for (from, to) in changes {
        assert!(scene.contains(from), "{from} is not in {scene}");
        scene = scene.replace(from, to);
    }
    std::fs::write(&file, scene).expect("the scene can be changed");
    (folder, command.split(' ').map(str::to_string).collect())
}

fn run_of(command: &[String]) -> Vec<&str> {
    command.iter().map(String::as_str).collect()
}

/// Every scene that is listed runs as it is written, by the command that is said, or reads to its end where another
/// program is needed.
#[test]
fn scenes_to_start_from_run() {
    let listed = json(&folder("init"), &["init"]);
    let names: Vec<&str> = column(&listed["tables"][0], "name").iter().filter_map(|name| name.as_str()).collect();
    assert_eq!(names, ["data-sheet", "path", "weave", "fabric", "yarn", "v50", "fibres", "cell"]);
    for name in ["data-sheet", "path", "weave"] {
        let (folder, command) = started(name, &[]);
        said(&folder, &run_of(&command));
    }
    // The first steps of longer ones.
    for (name, end) in [("fabric", ("end = 0.05", "end = 0.0005")), ("yarn", ("end = 0.06", "end = 0.0002"))] {
        let (folder, command) = started(name, &[end, ("pictures = [", "pictures = [] #")]);
        let [out, _] = said(&folder, &run_of(&command));
        assert!(out.contains("my-yarn"), "{out}");
    }
    let shorter = [("number = 12", "number = 4"), ("layers = 40", "layers = 10"), ("end = 0.05", "end = 0.02")];
    let (folder, command) = started("v50", &shorter);
    said(&folder, &run_of(&command));
    let (folder, command) = started("fibres", &[]);
    said(&folder, &[&run_of(&command)[..], &["--write-only"]].concat());
    // Read to its end before CalculiX is sought.
    let (folder, command) = started("cell", &[]);
    let error = refused(&folder, &[&run_of(&command)[..], &["--ccx", "./nowhere"]].concat());
    assert!(error.contains("nowhere"), "{error}");
}

/// The yarn of a scene is a copy of a built-in one that says so; one that is there already stays.
#[test]
fn a_scene_comes_with_its_yarn() {
    let (folder, _) = started("path", &[]);
    let [values, _] = said(&folder, &["params", "--preset", "my-yarn.toml"]);
    assert!(values.contains("k_el     82341.0 MPa") && values.contains("Guesses: k_el, "), "{values}");
    std::fs::write(folder.join("my-yarn.toml"), "units = \"si\"\n").expect("a yarn");
    let [out, error] = said(&folder, &["init", "weave"]);
    assert!(out.starts_with("weave.toml, my-yarn.toml\n") && error.is_empty(), "{out}{error}");
    assert_eq!(std::fs::read_to_string(folder.join("my-yarn.toml")).expect("it stays"), "units = \"si\"\n");
    let unknown = refused(&folder, &["init", "fabrik"]);
    assert!(unknown.contains("init fabrik, did you mean fabric?; allowed: data-sheet, path, "), "{unknown}");
}

/// An editor finds the schema by the scene's first line, without a network; toron takes the line for a comment.
#[test]
fn a_scene_comes_with_its_schema_if_that_is_asked_for() {
    let folder = folder("schema");
    let [out, _] = said(&folder, &["init", "weave", "--schema"]);
    assert!(out.starts_with("weave.toml, weave.schema.json, my-yarn.toml\n"), "{out}");
    let scene = std::fs::read_to_string(folder.join("weave.toml")).expect("the scene");
    assert_eq!(scene.lines().next(), Some("#:schema ./weave.schema.json"));
    let schema = std::fs::read_to_string(folder.join("weave.schema.json")).expect("the schema");
    let schema: Value = serde_json::from_str(&schema).expect("JSON");
    assert!(schema["properties"]["weave"].is_object() && schema["additionalProperties"] == false, "{schema}");
    said(&folder, &["weave", "weave.toml", "-o", "out"]);
    assert!(refused(&folder, &["init", "--schema"]).contains("<NAME>"));
}

/// One structure for all commands: tables of headings and rows, and the other lines.
#[test]
fn tables_are_printed_as_json() {
    let (folder, _) = started("yarn", &[("end = 0.06", "end = 0.0002"), ("pictures = [", "pictures = [] #")]);
    let long = "a-name-that-is-longer-than-what-a-terminal-shows";
    let scene = std::fs::read_to_string(folder.join("yarn.toml"))
        .expect("the scene")
        .replace("\"fast\"", &format!("\"{long}\""));
    std::fs::write(folder.join("yarn.toml"), scene).expect("the scene can be changed");
    let run = json(&folder, &["impact", "yarn.toml", "-o", "out"]);
    assert_eq!((&run["command"], &run["text"][0]), (&Value::from("impact"), &Value::from("My yarn struck at 120 m/s")));
    assert!(run["version"].as_str().is_some_and(|version| version.starts_with(env!("CARGO_PKG_VERSION"))), "{run}");
    let table = &run["tables"][0];
    assert_eq!(column(table, "case"), ["slow", long]);
    assert!(
        column(table, "at end")
            .iter()
            .zip([60.0, 120.0])
            .all(|(speed, least)| { speed.as_f64().is_some_and(|speed| speed > 0.9 * least && speed < least) }),
        "{table}"
    );
    assert!(
        table["columns"].as_array().is_some_and(|columns| columns.contains(&serde_json::json!(["at end", "mm/ms"])))
    );

    said(&folder, &["init", "path"]);
    let run = json(&folder, &["run", "path.toml", "-o", "path"]);
    let values = &run["tables"][0];
    assert_eq!(values["columns"], serde_json::json!([["name", ""], ["value", ""]]));
    assert!(column(values, "name").contains(&&Value::from("failure index")), "{values}");

    said(&folder, &["init", "data-sheet"]);
    let fit = json(&folder, &["fit", "data-sheet.toml", "-o", "fit"]);
    let parameters = &fit["tables"][0];
    assert_eq!(
        (column(parameters, "parameter")[0], column(parameters, "unit")[0]),
        (&Value::from("k_el"), &Value::from("MPa"))
    );
    assert!(column(parameters, "value")[0].as_f64().is_some_and(|k_el| (7e4..8e4).contains(&k_el)), "{parameters}");

    let params = json(&folder, &["params", "--units", "mm-tonne-s"]);
    assert!(params["tables"].as_array().is_some_and(|tables| tables.len() >= 6), "{params}");
    said(&folder, &["init", "weave"]);
    let weave = json(&folder, &["weave", "weave.toml"]);
    assert!(column(&weave["tables"][0], "name").contains(&&Value::from("areal density")), "{weave}");
    let v50 = json(&folder, &["v50", example("fabric_impact/v50.toml").as_str(), "--simulate", "2"]);
    assert!(column(&v50["tables"][0], "design").contains(&&Value::from("langlie")), "{v50}");
    // Where there is no table there is no such option.
    assert!(refused(&folder, &["deck", "--host", "abaqus", "--units", "si", "--json"]).contains("--json"));
}

fn example(name: &str) -> String {
    Path::new(ROOT).join("examples").join(name).display().to_string()
}

/// Warnings stay, notes go.
#[test]
fn a_quiet_run_says_what_is_wrong_and_nothing_else() {
    let (folder, _) = started("yarn", &[("end = 0.06", "end = 0.0002"), ("pictures = [", "pictures = [] #")]);
    let [_, notes] = said(&folder, &["impact", "yarn.toml"]);
    assert!(notes.contains("Ctrl-C") && notes.contains("case slow: "), "{notes}");
    let [out, notes] = said(&folder, &["impact", "yarn.toml", "--quiet", "-o", "quiet"]);
    assert!(notes.is_empty() && out.contains("how it ended"), "{notes}{out}");
    let scene = std::fs::read_to_string(folder.join("yarn.toml")).expect("the scene");
    std::fs::write(
        folder.join("yarn.toml"),
        scene.replace("preset = \"my-yarn.toml\"", "preset = \"my-yarn.toml\", density = 1.35"),
    )
    .expect("a scene");
    let output =
        toron(&folder, &["impact", "yarn.toml", "--quiet", "-o", "heavy"]).output().expect("the program starts");
    assert!(text(&output.stderr).starts_with("warning: "), "{}", text(&output.stderr));
}

fn from_standard_input(folder: &Path, arguments: &[&str], input: &str) -> Output {
    let mut program = toron(folder, arguments);
    let mut child =
        program.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
    child.stdin.take().expect("a pipe").write_all(input.as_bytes()).expect("it reads");
    child.wait_with_output().expect("it ends")
}

/// In every command that reads a TOML file; what the file names is relative to the current folder, and errors have
/// their lines.
#[test]
fn a_minus_is_the_standard_input() {
    let (folder, _) = started("path", &[]);
    for name in ["data-sheet", "weave", "yarn", "v50", "fabric"] {
        said(&folder, &["init", name]);
    }
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("a file");
    for (arguments, file) in [
        (&["run", "-"][..], "path.toml"),
        (&["fit", "-"], "data-sheet.toml"),
        (&["weave", "-"], "weave.toml"),
        (&["impact", "-", "--deck", "ls-dyna"], "yarn.toml"),
        (&["fabric", "-", "--deck", "ls-dyna"], "fabric.toml"),
        (&["v50", "-", "--simulate", "1"], "v50.toml"),
        (&["deck", "--host", "abaqus", "--properties", "-"], "my-yarn.toml"),
    ] {
        let output = from_standard_input(&folder, arguments, &read(file));
        assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    }
    let wrong = from_standard_input(
        &folder,
        &["run", "-"],
        &read("path.toml").replace("increments = 50", "increments = \"many\""),
    );
    let error = text(&wrong.stderr);
    assert!(
        wrong.status.code() == Some(2) && error.starts_with("toron: standard input:10: increments is \"many\""),
        "{error}"
    );
}

/// A key, a property, a preset, an option and a command.
#[test]
fn what_is_misspelt_is_told_what_it_may_mean() {
    let (folder, _) = started("yarn", &[("half-length", "halflength")]);
    let said = refused(&folder, &["impact", "yarn.toml"]);
    assert!(
        said.contains("yarn.toml:8: unknown field `halflength`, did you mean half-length? expected one of `"),
        "{said}"
    );
    let (folder, _) =
        started("path", &[("preset = \"my-yarn.toml\"", "preset = \"my-yarn.toml\"\nproperties = { ktd = 1 }")]);
    let said = refused(&folder, &["run", "path.toml"]);
    assert!(said.contains("property \"ktd\", did you mean k_td?; allowed: k_el k_tc p k_td"), "{said}");
    let said = refused(&folder, &["params", "--preset", "kevlar-km2"]);
    assert!(said.contains("preset \"kevlar-km2\", did you mean kevlar-km2-600?; allowed: "), "{said}");
    let said = refused(&folder, &["deck", "--host", "abaqus", "--units", "si", "--set", "desity=1"]);
    assert!(said.contains("no property desity, did you mean density?; allowed: "), "{said}");
    assert!(refused(&folder, &["deck", "--hots", "abaqus"]).contains("'--host'"));
    assert!(refused(&folder, &["fabrik"]).contains("'fabric'"));
}

/// As the README has them: from data to results, then what solvers need.
#[test]
fn commands_stand_in_the_order_in_which_they_are_used() {
    let [help, _] = said(Path::new("."), &["--help"]);
    let names: Vec<&str> = help
        .lines()
        .filter_map(|line| line.strip_prefix("  ")?.split_once("  "))
        .map(|(name, _)| name.trim())
        .collect();
    let wanted = [
        "init", "fit", "run", "weave", "fabric", "impact", "v50", "fibres", "cell", "deck", "params", "check",
        "compare", "eval", "bench",
    ];
    assert_eq!(names[..wanted.len()], wanted, "{help}");
    let readme = std::fs::read_to_string(Path::new(ROOT).join("README.md")).expect("the README");
    let (_, table) = readme.split_once("| command | |").expect("a table of commands");
    let places: Vec<usize> =
        wanted.iter().map(|name| table.find(&format!("`toron {name}`")).unwrap_or_else(|| panic!("{name}"))).collect();
    assert!(places.is_sorted(), "{places:?}");
}

/// What is installed has neither docs nor examples beside it.
#[test]
fn help_names_no_file_that_is_not_installed() {
    let [help, _] = said(Path::new("."), &["--help"]);
    let commands =
        help.lines().filter_map(|line| line.strip_prefix("  ")?.split_once("  ")).map(|(name, _)| name.trim());
    for command in commands.filter(|name| !name.is_empty() && !name.starts_with('-') && *name != "help") {
        let [help, _] = said(Path::new("."), &[command, "--help"]);
        for absent in ["docs/", "examples/", ".md"] {
            assert!(!help.contains(absent), "{command}: {absent}\n{help}");
        }
    }
}

/// A run that lasts longer than a second says how long it will take, and what that rests on.
#[test]
fn a_longer_run_says_how_long_it_takes() {
    let (folder, _) =
        started("yarn", &[("layers = 100", "layers = 300"), ("rows = 1", "rows = 2"), ("columns = 4", "columns = 6")]);
    let mut child = toron(&folder, &["impact", "yarn.toml"])
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("it starts");
    let error = child.stderr.take().expect("a pipe");
    let lines = std::io::BufRead::lines(std::io::BufReader::new(error)).map_while(Result::ok);
    let estimate = lines.into_iter().find(|line| line.contains(" up to end: "));
    let _ = child.kill(); // or it has ended
    child.wait().expect("it ends");
    let estimate = estimate.expect("an estimate");
    assert!(
        estimate.starts_with("case ") && estimate.contains(": about ") && estimate.contains(" elements × "),
        "{estimate}"
    );
    assert!(estimate.contains(" steps × ") && estimate.contains(" ns, as in the first "), "{estimate}");
}
