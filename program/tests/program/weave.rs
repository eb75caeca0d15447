//! `toron weave` on its example.

use std::path::Path;
use std::process::Command;

use crate::library::{ROOT, folder};

#[test]
fn the_example_is_meshed_and_drawn() {
    let output = folder("weave");
    let arguments = ["weave", "examples/fabric_impact/weave.toml", "-o"];
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    let answer = program.args(arguments).arg(&output).current_dir(ROOT).output().expect("it starts");
    let text = String::from_utf8(answer.stdout).expect("UTF-8");
    assert!(answer.status.success(), "{}", String::from_utf8_lossy(&answer.stderr));
    let document =
        std::fs::read_to_string(Path::new(ROOT).join("docs/guides/fabric.md")).expect("docs/guides/fabric.md");
    let (figures, _) = text.split_once("\nFiles in ").expect("the files are named last");
    assert!(document.contains(figures), "docs/guides/fabric.md shows other figures than\n{figures}");
    let mesh = std::fs::read_to_string(output.join("weave.vtu")).expect("a mesh");
    assert!(mesh.contains("NumberOfPoints=\"173424\" NumberOfCells=\"98136\""));
    for picture in ["weave.svg", "weave.png"] {
        assert!(output.join(picture).metadata().expect("a picture").len() > 10_000);
    }
    if std::env::var_os("TORON_WRITE_PICTURES").is_some() {
        std::fs::copy(output.join("weave.png"), Path::new(ROOT).join("docs/images/weave.png")).expect("a copy");
    }
}
