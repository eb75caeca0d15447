//! The sources of a law: which other files have the modules that it uses, and in which order they are compiled.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use toron_shared::error::Error;

/// Modules that every compiler has.
const INTRINSIC: [&str; 7] =
    ["iso_c_binding", "iso_fortran_env", "ieee_arithmetic", "ieee_exceptions", "ieee_features", "omp_lib", "mpi"];
/// Folders and files that are looked into, and how deep.
const FOLDERS: usize = 40;
const FILES: usize = 400;
const DEPTH: usize = 3;

/// The modules that a source has and those that it uses, in small letters.
#[derive(Clone, Debug, Default)]
struct Modules {
    has: Vec<String>,
    uses: Vec<String>,
    /// Of which its submodules are.
    extends: Vec<String>,
    /// Files that are part of it.
    includes: Vec<String>,
}

impl Modules {
    fn of(text: &str) -> Modules {
        let mut found = Modules::default();
        for line in text.lines() {
            let written = line.split('!').next().unwrap_or_default().trim();
            let line = written.to_lowercase();
            if let Some((_, rest)) = line.split_once('(').filter(|(word, _)| word.trim() == "submodule") {
                found.extends.extend(rest.split([':', ')']).next().map(|name| name.trim().to_string()));
            }
            let mut words = line.split([' ', ',', '\t', ':']).filter(|word| !word.is_empty());
            match (words.next(), words.next(), words.next()) {
                (Some("module"), Some(name), None) => found.has.push(name.to_string()),
                (Some("include"), Some(_), _) => {
                    found.includes.extend(written.split(['"', '\'']).nth(1).map(str::to_string));
                }
                (Some("use"), Some("intrinsic"), _) => {}
                (Some("use"), Some("non_intrinsic"), Some(name)) | (Some("use"), Some(name), _) => {
                    found.uses.push(name.to_string());
                }
                _ => {}
            }
        }
        found.uses.retain(|name| !INTRINSIC.contains(&name.as_str()) && !found.has.contains(name));
        found
    }

    /// Those of a file, and of what it includes from beside it.
    fn read(path: &Path) -> Modules {
        let of = |path: &Path| Modules::of(&String::from_utf8_lossy(&std::fs::read(path).unwrap_or_default()));
        let mut all = of(path);
        let mut next = 0;
        while let Some(name) = all.includes.get(next).filter(|_| next < FILES) {
            let inner = of(&path.with_file_name(name));
            next += 1;
            all.has.extend(inner.has);
            all.uses.extend(inner.uses);
            all.includes.extend(inner.includes);
        }
        all.uses.retain(|name| !all.has.contains(name));
        all
    }
}

/// The sources that are compiled before this one, in their order: those that are named, and the files near it that have
/// the modules it uses.
///
/// # Errors
/// A file that is named cannot be read.
pub fn others(main: &Path, named: &[PathBuf]) -> Result<Vec<PathBuf>, Error> {
    if let Some(missing) = named.iter().find(|path| !path.is_file()) {
        return Err(Error::Input(format!("{}: no such file", missing.display())));
    }
    let mut known: BTreeMap<PathBuf, Modules> = named.iter().map(|path| (path.clone(), Modules::read(path))).collect();
    let of_main = Modules::read(main);
    // Near it: beside it and below, and then beside its folder.
    let near = [main.parent(), main.parent().and_then(Path::parent)];
    for folder in near.into_iter().flatten() {
        if missing(&of_main, &known).is_empty() {
            break;
        }
        for path in fortran_files(folder) {
            if path != main {
                known.entry(path.clone()).or_insert_with(|| Modules::read(&path));
            }
        }
    }
    let mut order = Vec::new();
    for name in &of_main.uses {
        visit(name, &known, &of_main, &mut order);
    }
    for path in named {
        for name in known[path].uses.clone() {
            visit(&name, &known, &of_main, &mut order);
        }
        if !order.contains(path) {
            order.push(path.clone());
        }
    }
    with_submodules(&known, &of_main, &mut order);
    Ok(order)
}

/// Puts the files with submodules of what is compiled behind all, with what these use.
fn with_submodules(known: &BTreeMap<PathBuf, Modules>, of_main: &Modules, order: &mut Vec<PathBuf>) {
    for (path, modules) in known {
        let is_of = |name: &String| order.iter().any(|path| known[path].has.contains(name));
        if order.contains(path) || !modules.extends.iter().any(is_of) {
            continue;
        }
        for name in &modules.uses {
            visit(name, known, of_main, order);
        }
        order.push(path.clone());
    }
}

/// The modules that are used, directly or not, and that no known file has.
fn missing(of_main: &Modules, known: &BTreeMap<PathBuf, Modules>) -> Vec<String> {
    let mut asked: Vec<String> = of_main.uses.clone();
    asked.extend(known.values().flat_map(|modules| modules.uses.clone()));
    asked.retain(|name| !of_main.has.contains(name) && !known.values().any(|modules| modules.has.contains(name)));
    asked
}

/// Puts the file of a module behind those of the modules that it uses.
fn visit(name: &str, known: &BTreeMap<PathBuf, Modules>, of_main: &Modules, order: &mut Vec<PathBuf>) {
    let of_it = known.iter().find(|(_, modules)| modules.has.iter().any(|has| has == name));
    let Some((path, modules)) = of_it.filter(|_| !of_main.has.iter().any(|has| has == name)) else { return };
    if order.contains(path) {
        return;
    }
    for used in &modules.uses {
        if used != name {
            visit(used, known, of_main, order);
        }
    }
    if !order.contains(path) {
        order.push(path.clone());
    }
}

/// A folder and those in it.
pub fn folders(top: &Path) -> Vec<PathBuf> {
    let mut all = vec![(top.to_path_buf(), 0)];
    let mut next = 0;
    while next < all.len() && all.len() < FOLDERS {
        let (folder, depth) = all[next].clone();
        next += 1;
        if depth == DEPTH {
            continue;
        }
        let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
        let mut inner: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(|path| path.is_dir()).collect();
        inner.retain(|path| path.file_name().is_some_and(|name| !name.to_string_lossy().starts_with('.')));
        inner.sort();
        all.extend(inner.into_iter().map(|path| (path, depth + 1)));
    }
    all.into_iter().map(|(path, _)| path).take(FOLDERS).collect()
}

fn fortran_files(top: &Path) -> Vec<PathBuf> {
    let is_fortran = |path: &PathBuf| {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
        path.is_file() && ["f", "for", "f77", "f90", "f95", "f03", "f08"].contains(&ending.as_str())
    };
    let all = folders(top).into_iter().flat_map(|folder| {
        let mut files: Vec<PathBuf> =
            std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
        files.sort();
        files
    });
    all.filter(is_fortran).take(FILES).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modules_are_told_from_their_procedures() {
        let text = "      MODULE Yield\n  use, intrinsic :: iso_c_binding\n use tensors, only: dot ! a comment\n\
                    module procedure f\n      use yield\n";
        let modules = Modules::of(text);
        assert_eq!(Modules::of("submodule (yield) impl\n").extends, ["yield"]);
        assert_eq!(Modules::of("      INCLUDE 'Sub/Yield.f'\n").includes, ["Sub/Yield.f"]);
        assert_eq!((modules.has, modules.uses), (vec!["yield".to_string()], vec!["tensors".to_string()]));
    }
}
