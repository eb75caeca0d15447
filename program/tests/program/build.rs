//! What tells builds apart: sources and options, and neither the folder nor the file of the program.

use std::path::Path;
use std::process::Command;

use toron_build_number::{OF_MATERIALS, OF_PROGRAM, OF_STRIKES, checksum};

use toron_test_support::library::{ROOT, folder, run};

#[test]
fn a_checksum_is_of_the_sources_and_not_of_their_place() {
    let [one, other] = ["build-one", "build-other"].map(folder);
    let write = |root: &Path, name: &str, text: &str| {
        let file = root.join(name);
        std::fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        std::fs::write(file, text).expect("a file");
    };
    for root in [&one, &other] {
        std::fs::remove_dir_all(root).expect("what an earlier run has left");
        for name in ["src/lib.rs", "src/law/a.rs", "solvers/src/lib.rs", "program/src/main.rs", "program/assets/font"] {
            write(root, name, name);
        }
    }
    let sum = |root: &Path, options: &[&str]| {
        checksum(root, &of_program(), &options.iter().map(|option| option.to_string()).collect::<Vec<_>>())
    };
    let first = sum(&one, &["", ""]);
    write(&other, "docs/page.md", "no source");
    assert_eq!(first, sum(&other, &["", ""]));
    assert_ne!(first, sum(&one, &["-Ctarget-cpu=native", ""]));
    assert_ne!(sum(&one, &["a", ""]), sum(&one, &["", "a"]));
    write(&other, "src/law/a.rs", "src/law/b.rs");
    assert_ne!(first, sum(&other, &["", ""]));
    write(&other, "src/law/a.rs", "src/law/a.rs");
    std::fs::rename(other.join("src/law/a.rs"), other.join("src/law/b.rs")).expect("it has another name");
    assert_ne!(first, sum(&other, &["", ""]));
}

/// The folders of sources of this repository that a package is linked from.
fn folders_of(package: &str) -> Vec<String> {
    let mut cargo = Command::new(env!("CARGO"));
    let tree = ["tree", "-p", package, "--edges", "normal", "--prefix", "none", "--format", "{p}"];
    let output = run(cargo.current_dir(ROOT).args(tree).args(["--offline", "--locked"]), "cargo tree");
    let root = Path::new(ROOT).canonicalize().expect("the repository");
    let tree = String::from_utf8(output.stdout).expect("UTF-8");
    // `name v0.1.0 (/folder)` is one of ours.
    let ours = tree.lines().filter_map(|line| line.split_once('(')?.1.split_once(')').map(|(folder, _)| folder));
    let mut found: Vec<String> = ours
        .filter_map(|folder| Some(Path::new(folder).strip_prefix(&root).ok()?.to_path_buf()))
        .flat_map(|package| ["src", "assets"].map(|folder| package.join(folder)))
        .filter(|folder| root.join(folder).is_dir())
        .map(|folder| folder.display().to_string())
        .collect();
    found.sort();
    found.dedup();
    found
}

fn of_program() -> Vec<&'static str> {
    [&OF_MATERIALS[..], &OF_PROGRAM].concat()
}

#[test]
fn the_checksum_is_of_every_package_of_a_program() {
    assert_eq!(folders_of("toron-materials"), OF_MATERIALS);
    let mut of_strikes = [&OF_MATERIALS[..], &OF_STRIKES].concat();
    of_strikes.sort_unstable();
    assert_eq!(folders_of("toron-strikes"), of_strikes);
    let mut of_program = of_program();
    of_program.sort_unstable();
    assert_eq!(folders_of("toron-program"), of_program);
}
