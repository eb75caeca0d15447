//! `umat-check` on small inputs that are each of one kind (`ffi-tests/check/cases.toml`): what each line says of them.
//! And in CI: what fails, what is written, and the JSON that the schema describes.

mod support;

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;
use support::{changed, check, corpus, parse};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cases {
    case: Vec<Case>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    file: String,
    #[serde(default)]
    arguments: Vec<String>,
    /// What is replaced by what in the file, each once: the fault.
    #[serde(default)]
    change: Vec<[String; 2]>,
    exit: i32,
    /// Of a line its verdict, and behind a colon a part of its text or one of its kinds.
    lines: BTreeMap<String, String>,
    /// What no line's text may have.
    #[serde(default)]
    without: Vec<String>,
}

impl Case {
    /// What is otherwise than it should be.
    fn differences(&self, number: usize) -> String {
        let original = corpus("cases").join(&self.file);
        let law = match self.change.is_empty() {
            true => original,
            false => changed(&original, &self.change, &format!("case-{number}")),
        };
        let (code, report) = check(&law, &self.arguments);
        let lines = report["materials"][0]["lines"].as_array().expect("lines");
        let mut differences = String::new();
        if code != self.exit {
            differences += &format!("\n  exit {code} instead of {}", self.exit);
        }
        for (name, wanted) in &self.lines {
            let line = lines.iter().find(|line| line["line"] == name.as_str());
            let found = line.map_or("no such line".to_string(), shown);
            let (verdict, text) = wanted.split_once(": ").unwrap_or((wanted, ""));
            if !found.starts_with(&format!("{verdict}:")) || !found.contains(text) {
                differences += &format!("\n  {name} is \"{found}\" instead of \"{wanted}\"");
            }
        }
        for unwanted in &self.without {
            for line in lines.iter().filter(|line| shown(line).contains(unwanted)) {
                differences += &format!("\n  {} has \"{unwanted}\": {}", line["line"], shown(line));
            }
        }
        match differences.is_empty() {
            true => differences,
            false => format!("{} {} {:?}:{differences}\n", self.file, self.arguments.join(" "), self.change),
        }
    }
}

fn shown(line: &Value) -> String {
    let kinds = line["kinds"].as_array().expect("kinds").iter().filter_map(Value::as_str).collect::<Vec<_>>();
    let [verdict, text] = ["verdict", "text"].map(|key| line[key].as_str().expect("text"));
    format!("{verdict}: {text} [{}]", kinds.join(", "))
}

#[test]
fn each_case_is_told_as_what_it_is() {
    let Cases { case: cases } = parse("cases.toml");
    assert!(cases.len() > 10);
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let differences_of = &|first: usize| {
        let own = (first..cases.len()).step_by(threads);
        own.map(|number| cases[number].differences(number)).collect::<String>()
    };
    let differences: String = std::thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|first| scope.spawn(move || differences_of(first))).collect();
        running.into_iter().map(|thread| thread.join().expect("no case panics")).collect()
    });
    assert!(differences.is_empty(), "{differences}");
}

/// With steel's density a dissipation per volume is next to nothing per mass.
#[test]
fn a_dissipation_per_volume_is_warned_of() {
    let change = ["DISSIPATED/DENSITY(I)", "DISSIPATED"].map(str::to_string);
    let law = changed(&corpus("laws/vumat_j2.f"), &[change], "per-volume");
    let scene = law.with_extension("toml");
    let text = std::fs::read_to_string(&scene).expect("the law's file");
    std::fs::write(&scene, text + "density = 7.8e-9\n").expect("it is written");
    let (code, report) = check(&law, &["--only=dissipation".to_string()]);
    let lines = report["materials"][0]["lines"].as_array().expect("lines");
    let line = lines.iter().find(|line| line["line"] == "dissipation").map_or_else(String::new, shown);
    assert!(code == 0 && line.starts_with("warning:") && line.contains("is it per volume?"), "{code}: {line}");
}

// ---- in CI

fn written(name: &str) -> String {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name).display().to_string()
}

/// What the schema says of a value that a value is not.
fn breaches(schema: &Value, root: &Value, value: &Value, place: &str) -> Vec<String> {
    if let Some(name) = schema["$ref"].as_str() {
        return breaches(&root["$defs"][name.trim_start_matches("#/$defs/")], root, value, place);
    }
    let mut found = Vec::new();
    let is_of = |kind: &str| match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        _ => value.is_null(),
    };
    let kinds = schema["type"].as_array().cloned().unwrap_or_else(|| vec![schema["type"].clone()]);
    let known = schema["type"].is_null() || kinds.iter().filter_map(Value::as_str).any(is_of);
    let listed = schema["enum"].as_array().is_none_or(|values| values.contains(value));
    if !known || !listed || (!schema["const"].is_null() && schema["const"] != *value) {
        found.push(format!("{place} is {value}"));
    }
    for (key, entry) in value.as_object().into_iter().flatten() {
        match schema["properties"].get(key) {
            Some(schema) => found.extend(breaches(schema, root, entry, &format!("{place}.{key}"))),
            None => found.push(format!("{place} has {key}")),
        }
    }
    for name in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        if value.get(name).is_none() {
            found.push(format!("{place} lacks {name}"));
        }
    }
    for entry in value.as_array().into_iter().flatten() {
        found.extend(breaches(&schema["items"], root, entry, place));
    }
    found
}

#[test]
fn the_json_is_what_its_schema_says() {
    let schema = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/report.schema.json")).expect("a schema");
    let schema: Value = serde_json::from_str(&schema).expect("JSON");
    let (_, report) = check(&corpus("cases/inputs_written.f"), &["--props=1000,.3".to_string()]);
    assert_eq!(breaches(&schema, &schema, &report, "report"), Vec::<String>::new());
    let mut other = report;
    other["materials"][0]["lines"][0]["verdict"] = "fine".into();
    assert_eq!(breaches(&schema, &schema, &other, "report").len(), 1);
}

/// STRAN is written to, a warning: it fails a strict check, unless it is known.
#[test]
fn warnings_fail_a_strict_check_but_for_those_of_the_baseline() {
    let law = corpus("cases/strain_written.f");
    let run = |arguments: &[&str]| {
        let all = ["--props=1000,.3", "--only=outputs"].iter().chain(arguments);
        check(&law, &all.map(ToString::to_string).collect::<Vec<_>>())
    };
    let (code, report) = run(&[]);
    assert_eq!((code, report["verdict"].as_str()), (0, Some("right")));
    let baseline = written("baseline.json");
    std::fs::write(&baseline, report.to_string()).expect("a file");
    assert_eq!(run(&["--strict"]).0, 1);
    let (code, report) = run(&["--strict", "--baseline", &baseline]);
    let lines = report["materials"][0]["lines"].as_array().expect("lines");
    assert_eq!((code, &lines[1]["known"]), (0, &Value::Bool(true)));
}

#[test]
fn junit_and_sarif_are_written() {
    let (junit, sarif) = (written("check.xml"), written("check.sarif"));
    let law = corpus("cases/unset_local.f");
    let arguments = ["--props=1000,.3", "--only=runtime", "--junit", &junit, "--sarif", &sarif].map(str::to_string);
    assert_eq!(check(&law, &arguments).0, 1);
    let xml = std::fs::read_to_string(junit).expect("JUnit");
    assert!(xml.contains("<testcase name=\"runtime\"") && xml.contains("<failure message="), "{xml}");
    let log: Value = serde_json::from_str(&std::fs::read_to_string(sarif).expect("SARIF")).expect("JSON");
    assert_eq!(log["version"], "2.1.0");
    assert_eq!(log["runs"][0]["results"][0]["ruleId"], "runtime");
}

#[test]
fn a_file_that_does_not_compile_has_a_report_too() {
    let law = changed(&corpus("cases/j2_modes.f"), &[["NINT(PROPS(5))".into(), "NINT(PROPS(5)".into()]], "not-built");
    let (junit, sarif) = (written("not-built.xml"), written("not-built.sarif"));
    let arguments = ["--junit", &junit, "--sarif", &sarif].map(str::to_string);
    let (code, report) = check(&law, &arguments);
    let line = &report["materials"][0]["lines"][0];
    assert_eq!(
        (code, &report["verdict"], &line["line"], &line["verdict"]),
        (2, &"wrong".into(), &"build".into(), &"wrong".into())
    );
    assert!(line["text"].as_str().is_some_and(|text| text.contains("does not compile")), "{line}");
    assert!(std::fs::read_to_string(junit).expect("JUnit").contains("does not compile"));
    assert!(std::fs::read_to_string(sarif).expect("SARIF").contains("does not compile"));
}

#[test]
fn a_quick_check_asks_less() {
    let law = corpus("cases/yeoh.f");
    let (code, report) = check(&law, &["--props=.8,.1,20".to_string(), "--quick".to_string()]);
    let names: Vec<&str> = report["materials"][0]["lines"]
        .as_array()
        .expect("lines")
        .iter()
        .filter_map(|line| line["line"].as_str())
        .collect();
    let expected = ["build", "memory", "rest", "stress", "expect", "tangent", "objectivity", "repeat", "outputs"];
    assert_eq!((code, names), (0, expected.to_vec()));
    let (code, report) = check(&law, &["--props=.8,.1,20".to_string(), "--only=build".to_string()]);
    assert_eq!((code, report["materials"][0]["lines"].as_array().map(Vec::len)), (0, Some(1)));
}

// ---- libraries

/// A plugin of CalculiX has a UMAT under another name.
#[test]
fn a_library_is_asked_under_the_name_of_its_subroutine() {
    let library = written("libplugin.so");
    let built = std::process::Command::new("gcc")
        .args(["-shared", "-fPIC", "-w", "-Dumat_=plugin", "-o", &library])
        .arg(corpus("laws/ogden.c"))
        .status();
    assert!(built.expect("gcc").success());
    let scene = corpus("laws/ogden.toml").display().to_string();
    let run = |symbol: &str| {
        let arguments = ["--scene", &scene, "--only=tangent", &format!("--symbol={symbol}")].map(str::to_string);
        std::process::Command::new(env!("CARGO_BIN_EXE_umat-check"))
            .arg(&library)
            .args(arguments)
            .output()
            .expect("runs")
    };
    assert!(run("PLUGIN").status.success());
    let missing = run("OTHER");
    assert_eq!(missing.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&missing.stderr).contains("there is no subroutine OTHER"));
}

/// The call as a program compiles beside the law, and shows the entry that is wrong.
#[test]
fn a_wrong_tangent_is_reproduced_by_a_program() {
    let (folder, program) = (written("reproduced"), written("reproduced-one"));
    let law = corpus("cases/volume.f");
    let arguments =
        ["--json", "--props=1,10,.5,.5,0", "--only=tangent", "--reproduce", "--output", &folder].map(str::to_string);
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_umat-check")).arg(&law).args(arguments).output();
    let output = output.expect("runs");
    assert_eq!(output.status.code(), Some(1));
    let report: Value = serde_json::from_slice(&output.stdout).expect("a report");
    // "worst at (22, 22) loading, 1.33298e1 instead of 1.49308e1"
    let said = report["materials"][0]["lines"][1]["text"].as_str().expect("text");
    let (_, said) = said.split_once("worst at (22, 22) ").expect("the entry that is worst");
    let said: Vec<f64> = said.split([' ', ',', ';']).filter_map(|word| word.parse().ok()).collect();
    let source = std::fs::read_to_string(Path::new(&folder).join("volume-tangent.f90")).expect("the program");
    let include = source.lines().find_map(|line| line.strip_prefix("! echo")).expect("how the include is made");
    let made = std::process::Command::new("sh").current_dir(&folder).args(["-c", &format!("echo{include}")]).status();
    assert!(made.expect("sh").success());
    let compiled = std::process::Command::new("gfortran")
        .current_dir(&folder)
        .args(["-std=legacy", "-ffixed-line-length-132", "-I.", "-w"])
        .arg(&law)
        .args(["volume-tangent.f90", "-o", &program])
        .status();
    assert!(compiled.expect("gfortran").success());
    let output = std::process::Command::new(&program).output().expect("it runs");
    let text = String::from_utf8_lossy(&output.stdout);
    let entry = |kind: &str| -> f64 {
        let line = text.lines().find(|line| line.starts_with(&format!("2 {kind}"))).expect("a column");
        line.split_whitespace().nth(3).and_then(|number| number.parse().ok()).expect("a number")
    };
    assert!(said.len() >= 2, "{said:?}");
    for (printed, said) in [entry("DDSDDE"), entry("Kirchhoff")].iter().zip(&said) {
        assert!((printed - said).abs() < 1e-5 * said, "{printed} and {said}: {text}");
    }
}

/// Routines that Abaqus has: the program of a call brings them along, and a library finds them too.
#[test]
fn routines_of_abaqus_are_there_for_a_program_and_for_a_library() {
    let law = changed(
        &corpus("laws/j2_kinematic.f90"),
        &[["  sse = pressure**2", "  ddsdde = 2*ddsdde\n  sse = pressure**2"].map(str::to_string)],
        "with-rotsig",
    );
    let folder = written("rotsig-call");
    let only = ["--only=tangent", "--reproduce", "--output", &folder];
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_umat-check")).arg(&law).args(only).output();
    assert_eq!(output.expect("runs").status.code(), Some(1));
    let program = std::fs::read_to_string(Path::new(&folder).join("j2_kinematic-tangent.f90")).expect("a program");
    let command = program.lines().find(|line| line.starts_with("! gfortran")).expect("a command");
    let command = command.trim_start_matches("! ").replace("THIS", "j2_kinematic-tangent");
    let built = std::process::Command::new("sh").current_dir(&folder).args(["-c", &command]).output().expect("sh");
    assert!(built.status.success(), "{command}: {}", String::from_utf8_lossy(&built.stderr));

    let library = written("librotsig.so");
    let built =
        std::process::Command::new("gfortran").args(["-shared", "-fPIC", "-w", "-o", &library]).arg(&law).status();
    assert!(built.expect("gfortran").success());
    let scene = law.with_extension("toml").display().to_string();
    let (_, report) = check(Path::new(&library), &["--scene", &scene, "--only=stress"].map(str::to_string));
    assert_eq!(report["materials"][0]["lines"][1]["verdict"], "right", "{report:#}");
}

/// Laws of both forms, of the deformation and of strain increments, with tangents of their own that are wrong: the
/// wrapper's is right.
#[test]
fn a_wrapper_has_a_right_tangent() {
    let properties = "--props=200000,0.3,300,1000,1";
    let scene = format!("--scene={}", corpus("cases/j2_modes.toml").display());
    for (law, arguments) in [
        ("volume.f", vec!["--props=1,10,.5,.5,0".to_string()]),
        ("j2_modes.f", vec![scene, properties.to_string()]),
        ("plane_stress_wrong.f90", vec!["--props=1000,.3".to_string(), "--ntens=3".to_string()]),
    ] {
        let folder = written(&format!("wrapper-{law}"));
        let only = "--only=tangent,outputs,repeat".to_string();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_umat-check"))
            .arg(corpus("cases").join(law))
            .args(["--wrapper", "--output", &folder, "--json"])
            .args(arguments.iter().chain([&only]))
            .output()
            .expect("runs");
        let report: Value = serde_json::from_slice(&output.stdout).expect("a report");
        assert_eq!(report["materials"][0]["lines"][1]["verdict"], "wrong", "{report:#}");
        let (stem, ending) = law.split_once('.').expect("an ending");
        let wrapper = Path::new(&folder).join(format!("{stem}-wrapper.{ending}"));
        let (code, report) = check(&wrapper, &arguments.iter().chain([&only]).cloned().collect::<Vec<_>>());
        assert_eq!((code, &report["verdict"]), (0, &"right".into()), "{report:#}");
        assert_eq!(report["materials"][0]["lines"][1]["verdict"], "right", "{report:#}");
    }
}
