//! What tells builds apart: sources and options, and neither the folder nor the file of the program.

use std::path::Path;

#[allow(dead_code)] // its main is Cargo's
#[path = "../../build.rs"]
mod script;

use crate::library::folder;

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
        script::checksum(root, &options.iter().map(|option| option.to_string()).collect::<Vec<_>>())
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
