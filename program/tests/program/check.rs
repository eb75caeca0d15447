//! `toron check` on this library, as Abaqus loads it; `umat-check` has the tests of the checks.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use toron_test_support::library::{LIBRARY, OWN_LAW, ROOT};

/// Checks a library with a scene of `ffi-tests/check`, which must be right: the names of the lines that are right, and
/// of those that are neither right nor left out.
fn check(library: &str, scene: &str, arguments: &[String]) -> [Vec<String>; 2] {
    let output = Command::new(env!("CARGO_BIN_EXE_toron"))
        .current_dir(LIBRARY.as_path())
        .args(["check", library, "--json"])
        .arg(format!("--scene={}", Path::new(ROOT).join("ffi-tests/check").join(scene).display()))
        .args(arguments)
        .output()
        .expect("the program starts");
    let [stdout, stderr] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    let report: Value =
        serde_json::from_str(&stdout).unwrap_or_else(|error| panic!("{scene}: {error}\n{stdout}\n{stderr}"));
    assert!(output.status.success(), "{scene}: {}\n{report:#}", output.status);
    let lines = report["materials"][0]["lines"].as_array().expect("lines");
    let named = |wanted: &dyn Fn(&Value) -> bool| {
        let lines = lines.iter().filter(|line| wanted(&line["verdict"]));
        lines.map(|line| line["line"].as_str().expect("a name").to_string()).collect()
    };
    let left_out = ["not asked", "not reported"];
    [
        named(&|verdict| verdict == "right"),
        named(&|verdict| verdict != "right" && !left_out.iter().any(|x| verdict == x)),
    ]
}

#[test]
fn the_own_umat_is_right() {
    for (law, further) in [
        ("hyperelastic", &["isotropy", "steps", "energy", "cycles"][..]),
        ("linear_elastic", &["isotropy", "steps", "energy"][..]),
    ] {
        let [right, others] = check("libtoron_abaqus.so", &format!("libtoron_{law}.toml"), &[]);
        assert!(others.is_empty(), "{law}: {others:?}");
        let required = ["memory", "rest", "tangent", "objectivity", "repeat", "threads", "histories"];
        for line in required.iter().chain(further) {
            assert!(right.iter().any(|name| name == line), "{law}: {line} is not among {right:?}");
        }
    }
}

/// A metal that hardens, with its dissipation: SPD is per current volume, and falls where the metal swells elastically.
#[test]
fn a_law_of_ones_own_with_a_history_is_right() {
    let library = OWN_LAW.join("libown_law_double.so");
    let [right, others] = check(library.to_str().expect("a path"), "own_law_plastic.toml", &[]);
    assert!(others.is_empty(), "{others:?}");
    for line in ["rest", "tangent", "objectivity", "isotropy", "steps", "energy", "cycles", "dissipation", "histories"]
    {
        assert!(right.iter().any(|name| name == line), "{line} is not among {right:?}");
    }
}

/// In both precisions.
#[test]
fn the_own_vumat_raises_no_alarm() {
    for (scene, right) in [("vumat_yarn.toml", 18), ("vumat_linear.toml", 17)] {
        let single = format!("--single={}", LIBRARY.join("libtoron_abaqus_sp.so").display());
        let [lines, _] = check("libtoron_abaqus.so", scene, &["--vumat".to_string(), single]);
        assert_eq!(lines.len(), right, "{scene}: {lines:?}");
    }
}
