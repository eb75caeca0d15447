//! The program `umat-check`, run on a law of `ffi-tests/check`.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;
use serde_json::Value;

/// The repository.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

pub fn corpus(path: &str) -> PathBuf {
    Path::new(ROOT).join("ffi-tests/check").join(path)
}

pub fn parse<T: for<'a> Deserialize<'a>>(path: &str) -> T {
    let text = std::fs::read_to_string(corpus(path)).expect("a file of the corpus");
    toml::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Runs the program on a law; its exit code and report.
pub fn check(law: &Path, arguments: &[String]) -> (i32, Value) {
    let beside = law.parent().expect("a folder");
    let [folder, file] = [beside, law].map(|path| path.file_name().expect("a name").to_string_lossy());
    let output = Command::new(env!("CARGO_BIN_EXE_umat-check"))
        .current_dir(beside)
        .arg("--json")
        .arg("--output")
        .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("calls-{folder}-{file}")))
        .arg(law)
        .args(arguments)
        .output()
        .expect("the program starts");
    let [stdout, stderr] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    let report = serde_json::from_str(&stdout)
        .unwrap_or_else(|error| panic!("{} {arguments:?}: {error}\n{stdout}\n{stderr}", law.display()));
    (output.status.code().expect("the program survives"), report)
}

/// A law with changes, each of what occurs once, and its TOML beside it, in a folder of this name.
#[allow(dead_code, reason = "not every test has changes")]
pub fn changed(law: &Path, changes: &[[String; 2]], folder: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut text = std::fs::read_to_string(law).expect("a law");
    for [from, to] in changes {
        assert_eq!(text.matches(from).count(), 1, "{}: {from:?}", law.display());
        text = text.replace(from, to);
    }
    let written = folder.join(law.file_name().expect("a name"));
    let scene = law.with_extension("toml");
    if scene.is_file() {
        std::fs::copy(&scene, written.with_extension("toml")).expect("a copy");
    }
    std::fs::write(&written, text).expect("the law is written");
    written
}
