//! Dependencies between this repository's packages point down: each package stands in the table below those that need
//! it, and has the arrows that are listed there and no others. A library of a solver that needed `toron-c-functions`
//! would export its symbols.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// A package, what it is made of, and what its tests need beside.
type Arrows = (&'static str, &'static [&'static str], &'static [&'static str]);

/// From the ground up.
const ARROWS: [Arrows; 28] = [
    ("toron", &[], &["reinforced-solid", "toron-test-support"]),
    ("toron-test-support", &["toron"], &[]),
    ("toron-shared", &[], &[]),
    ("toron-build-number", &[], &[]),
    ("toron-pictures", &["toron-shared"], &[]),
    ("umat-check", &["toron-shared"], &["toron-test-support"]),
    ("toron-solvers", &["toron"], &[]),
    ("toron-abaqus", &["toron", "toron-solvers"], &[]),
    ("toron-abaqus-sp", &["toron", "toron-solvers"], &[]),
    ("toron-calculix", &["toron", "toron-solvers"], &[]),
    ("toron-mgis", &["toron", "toron-solvers"], &[]),
    ("toron-openradioss", &["toron", "toron-solvers"], &[]),
    ("toron-openradioss-sp", &["toron", "toron-solvers"], &[]),
    ("toron-c-functions", &["toron"], &[]),
    ("toron-c", &["toron-c-functions"], &["reinforced-solid", "toron", "toron-solvers", "toron-test-support"]),
    (
        "toron-materials",
        &["toron", "toron-build-number", "toron-c-functions", "toron-pictures", "toron-shared", "toron-solvers"],
        &["reinforced-solid", "toron-test-support"],
    ),
    ("toron-explicit-host", &["toron", "toron-c-functions", "toron-materials", "toron-shared"], &[]),
    (
        "toron-strikes",
        &["toron", "toron-build-number", "toron-explicit-host", "toron-materials", "toron-pictures", "toron-shared"],
        &["reinforced-solid"],
    ),
    (
        "toron-parameters",
        &["toron", "toron-explicit-host", "toron-materials", "toron-pictures", "toron-shared", "toron-strikes"],
        &[],
    ),
    (
        "toron-program",
        &[
            "toron",
            "toron-build-number",
            "toron-materials",
            "toron-parameters",
            "toron-shared",
            "toron-strikes",
            "umat-check",
        ],
        &["toron-build-number", "toron-explicit-host", "toron-pictures", "toron-test-support"],
    ),
    (
        "toron-fuzz",
        &[
            "toron",
            "toron-c-functions",
            "toron-explicit-host",
            "toron-materials",
            "toron-parameters",
            "toron-shared",
            "toron-strikes",
            "toron-test-support",
            "umat-check",
        ],
        &[],
    ),
    (
        "toron-keys",
        &["toron-materials", "toron-parameters", "toron-shared", "toron-strikes", "umat-check"],
        &["toron-test-support"],
    ),
    ("toron-benches", &[], &["toron", "toron-materials", "toron-pictures", "toron-test-support"]),
    ("xtask", &[], &[]),
    // `examples/own_law`.
    ("reinforced-solid", &["toron"], &[]),
    ("own-law-double", &["reinforced-solid", "toron-solvers"], &[]),
    ("own-law-single", &["reinforced-solid", "toron-solvers"], &[]),
    ("own-law-program", &["reinforced-solid", "toron-strikes"], &[]),
];

/// What Cargo knows of a workspace.
fn metadata(manifest: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(manifest);
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["metadata", "--format-version", "1", "--no-deps", "--offline", "--manifest-path"]).arg(path);
    let output = cargo.output().expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The packages of a workspace, each with what it needs of this repository: to be built, and for its tests.
fn found(manifest: &str) -> BTreeMap<String, [Vec<String>; 2]> {
    let metadata = metadata(manifest);
    let text = |value: &Value| value.as_str().expect("a name").to_owned();
    let packages = metadata["packages"].as_array().expect("packages");
    let arrows = |package: &Value| {
        let dependencies = package["dependencies"].as_array().expect("dependencies");
        let ours = dependencies.iter().filter(|dependency| dependency["path"].is_string());
        let [mut built, mut tested] = [Vec::new(), Vec::new()];
        for dependency in ours {
            let to = if dependency["kind"] == "dev" { &mut tested } else { &mut built };
            to.push(text(&dependency["name"]));
        }
        built.sort();
        built.dedup(); // its build script may need it, too
        tested.sort();
        (text(&package["name"]), [built, tested])
    };
    packages.iter().map(arrows).collect()
}

#[test]
fn arrows_are_those_of_the_table() {
    let mut packages = found("Cargo.toml");
    packages.extend(found("examples/own_law/Cargo.toml"));
    let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
    let table: BTreeMap<_, _> =
        ARROWS.iter().map(|&(name, built, tested)| (name.to_owned(), [names(built), names(tested)])).collect();
    assert_eq!(packages, table, "found on the left; the table of this test on the right");
}

#[test]
fn arrows_of_the_table_point_down() {
    for (place, (name, built, _)) in ARROWS.iter().enumerate() {
        let below = |needed: &&str| ARROWS[..place].iter().any(|(other, ..)| other == needed);
        assert!(built.iter().all(below), "{name} needs a package that does not stand below it: {built:?}");
    }
}

/// `cargo run` runs `toron`, as the README has it, although other packages have programs too.
#[test]
fn one_program_is_run_without_a_name() {
    let metadata = metadata("Cargo.toml");
    let packages = metadata["packages"].as_array().expect("packages");
    let named: Vec<_> = packages.iter().filter_map(|package| package["default_run"].as_str()).collect();
    assert_eq!(named, ["toron"]);
}
