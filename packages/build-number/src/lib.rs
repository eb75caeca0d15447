//! For build scripts of programs: the checksum of the sources that one is made of, and of the compiler's options that
//! Cargo does not count to a package. `toron_shared::build` makes the build's number of it.

use std::path::{Path, PathBuf};

/// The workspace's folders that the program of a law of one's own is compiled from.
pub const OF_MATERIALS: [&str; 8] = [
    "c/functions/src",
    "packages/materials/assets",
    "packages/materials/src",
    "packages/pictures/assets",
    "packages/pictures/src",
    "packages/shared/src",
    "solvers/src",
    "src",
];
/// Those that it has besides where it strikes yarns and panels.
pub const OF_STRIKES: [&str; 3] = ["packages/explicit-host/src", "packages/strikes/assets", "packages/strikes/src"];
/// Those that the program toron has besides the first ones.
pub const OF_PROGRAM: [&str; 7] = [
    "packages/explicit-host/src",
    "packages/parameters/src",
    "packages/strikes/assets",
    "packages/strikes/src",
    "packages/umat-check/src",
    "program/assets",
    "program/src",
];
/// What else the compiler is told.
const OPTIONS: [&str; 2] = ["CARGO_ENCODED_RUSTFLAGS", "CARGO_CFG_TARGET_FEATURE"];

/// Sets TORON_SOURCES for the package whose build script calls this: the checksum of these folders of the repository
/// at `root`, a path from the package's own folder.
pub fn set_sources(root: &str, folders: &[&str]) {
    let root = Path::new(root);
    for folder in folders.iter().map(|folder| root.join(folder)).filter(|folder| folder.is_dir()) {
        println!("cargo::rerun-if-changed={}", folder.display());
    }
    println!("cargo::rerun-if-env-changed=RUSTFLAGS");
    let options: Vec<String> = OPTIONS.iter().map(|option| std::env::var(option).unwrap_or_default()).collect();
    println!("cargo::rustc-env=TORON_SOURCES={:08x}", checksum(root, folders, &options));
}

/// Of the sources in these folders below `root`, wherever that is, by their names and contents.
pub fn checksum(root: &Path, folders: &[&str], options: &[String]) -> u32 {
    let mut files: Vec<PathBuf> = folders.iter().flat_map(|folder| files(&root.join(folder))).collect();
    // A folder has no order of its own.
    files.sort();
    let mut sum = crc32fast::Hasher::new();
    let mut add = |bytes: &[u8]| {
        sum.update(&bytes.len().to_le_bytes());
        sum.update(bytes);
    };
    for file in files {
        let name = file.strip_prefix(root).unwrap_or(&file);
        add(name.to_string_lossy().as_bytes());
        add(&std::fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display())));
    }
    options.iter().for_each(|option| add(option.as_bytes()));
    sum.finalize()
}

/// The files of a folder and of those in it; none of one that is not there, as where packages were taken apart from
/// each other.
fn files(folder: &Path) -> Vec<PathBuf> {
    if !folder.is_dir() {
        return Vec::new();
    }
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let paths = entries.map(|entry| entry.unwrap_or_else(|error| panic!("{}: {error}", folder.display())).path());
    paths.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}
