//! The readers of the programs, each with the files of the repository that it is for.

use std::fs;
use std::path::{Path, PathBuf};

use toron_materials::data_table::DataTable;
use toron_materials::data_table::sheet::Sheet;
use toron_materials::load_path::path::LoadPath;
use toron_materials::material::laws::Laws;
use toron_materials::material::preset::Preset;
use toron_parameters::identify::blow::file::BlowJob;
use toron_parameters::identify::file::Job;
use toron_parameters::identify::strength::file::StrengthJob;
use toron_parameters::{cell, fibres};
use toron_shared::error::Error;
use toron_strikes::v50::measured::{Choice, Measured};
use toron_strikes::weave::foreign;
use toron_strikes::{fabric, impact, v50, weave};
use toron_test_support::library::ROOT;

use super::checkpoints;

/// A reader, and where its files are.
pub struct Target {
    pub name: &'static str,
    /// Folders or files below the repository; of checkpoints none, since runs write them.
    pub places: &'static [&'static str],
    /// How the names of the files end.
    pub end: &'static str,
    /// Reads a file to its end.
    pub read: fn(&Path) -> Result<(), Error>,
}

/// Calls a reader of text, as the commands do: what is not UTF-8 is theirs to refuse.
fn of_text<T>(path: &Path, read: impl FnOnce(&str, &str) -> Result<T, Error>) -> Result<(), Error> {
    let bytes = fs::read(path).unwrap_or_default();
    read(&path.display().to_string(), &String::from_utf8_lossy(&bytes)).map(drop)
}

pub const TARGETS: &[Target] = &[
    Target {
        name: "scene of toron fabric",
        places: &["examples/fabric_impact", "program/assets/init/fabric.toml"],
        end: ".toml",
        read: |path| fabric::scene::Scene::read(path).map(drop),
    },
    Target {
        name: "scene of toron impact",
        places: &["examples/yarn_impact", "program/assets/init/yarn.toml"],
        end: ".toml",
        read: |path| impact::scene::Scene::read(path).map(drop),
    },
    Target {
        name: "scene of toron v50",
        places: &["examples/fabric_impact/v50.toml", "program/assets/init/v50.toml"],
        end: ".toml",
        read: |path| v50::scene::Scene::read(path, None).map(drop),
    },
    Target {
        name: "scene of toron weave",
        places: &["examples/fabric_impact/weave.toml", "program/assets/init/weave.toml"],
        end: ".toml",
        read: |path| weave::reader::Scene::read(path).map(drop),
    },
    Target {
        name: "scene of toron fibres",
        places: &["examples/fibre_scale", "program/assets/init/fibres.toml"],
        end: ".toml",
        read: |path| fibres::scene::Scene::read(path).map(drop),
    },
    Target {
        name: "scene of toron cell",
        places: &["examples/identification", "program/assets/init/cell.toml"],
        end: ".toml",
        read: |path| cell::scene::Scene::read(path).map(drop),
    },
    Target {
        name: "load path",
        places: &["examples", "program/assets/init/path.toml", "examples/identification"],
        end: ".toml",
        read: |path| LoadPath::read(Laws::Toron, path).map(drop),
    },
    Target {
        name: "data of toron fit",
        places: &["examples/identification", "program/assets/init/data-sheet.toml"],
        end: ".toml",
        read: |path| Job::read(path).map(drop),
    },
    Target {
        name: "strengths of toron fit",
        places: &["examples/identification"],
        end: ".toml",
        read: |path| StrengthJob::read(path).map(drop),
    },
    Target {
        name: "blow of toron fit",
        places: &["examples/fibre_scale"],
        end: ".toml",
        read: |path| BlowJob::read(path).map(drop),
    },
    Target {
        name: "material",
        places: &["examples/identification/yarns", "packages/fuzz/corpus/files"],
        end: ".toml",
        read: |path| of_text(path, |name, text| Preset::parse(Laws::Toron, name, text)),
    },
    Target {
        name: "curve",
        places: &["examples/identification"],
        end: ".csv",
        read: |path| DataTable::read(path).map(drop),
    },
    Target {
        name: "tests of a material",
        places: &["examples/identification"],
        end: ".csv",
        read: |path| DataTable::read_tests(path).map(drop),
    },
    Target {
        name: "sheet",
        places: &["examples/identification", "examples/shots"],
        end: ".csv",
        read: |path| Sheet::read(path).map(drop),
    },
    Target {
        name: "shots",
        places: &["examples/shots"],
        end: ".csv",
        read: |path| Measured::read(path, &Choice::default()).map(drop),
    },
    Target {
        name: "mesh of Abaqus",
        places: &["examples/fabric_impact/patch", "examples/one-element"],
        end: ".inp",
        read: |path| of_text(path, foreign::abaqus::read),
    },
    Target {
        name: "mesh of LS-DYNA",
        places: &["examples/fabric_impact/patch", "examples/one-element"],
        end: ".k",
        read: |path| of_text(path, foreign::ls_dyna::read),
    },
    Target {
        name: "mesh as VTU",
        places: &["packages/fuzz/corpus/files"],
        end: ".vtu",
        read: |path| {
            let bytes = fs::read(path).unwrap_or_default();
            foreign::vtu::read(&path.display().to_string(), &bytes).map(drop)
        },
    },
    Target {
        name: "checkpoint of toron impact",
        places: &[],
        end: checkpoints::ENDING,
        read: checkpoints::read_impact,
    },
    Target {
        name: "checkpoint of toron fabric",
        places: &[],
        end: checkpoints::ENDING,
        read: checkpoints::read_fabric,
    },
    #[cfg(target_os = "linux")]
    Target {
        name: "material of toron check",
        places: &["ffi-tests/check"],
        end: ".toml",
        read: |path| umat_check::input::input(Path::new("law.f"), Some(path), &Default::default()).map(drop),
    },
    #[cfg(target_os = "linux")]
    Target {
        name: "input of Abaqus for toron check",
        places: &["ffi-tests/check", "examples/one-element/abaqus-standard"],
        end: ".inp",
        read: |path| {
            let deck = Some(path.to_path_buf());
            let overrides = umat_check::input::Overrides { deck, ..Default::default() };
            umat_check::input::input(Path::new("law.f"), None, &overrides).map(drop)
        },
    },
    #[cfg(target_os = "linux")]
    Target {
        name: "source of toron check",
        places: &["ffi-tests/check"],
        end: "",
        read: |path| umat_check::sources::others(path, &[]).map(drop),
    },
];

/// The files of a target, in the order of their names.
pub fn files(target: &Target) -> Vec<PathBuf> {
    if target.end == checkpoints::ENDING {
        return checkpoints::files();
    }
    let mut files = Vec::new();
    for place in target.places {
        let place = Path::new(ROOT).join(place);
        if place.is_dir() { below(&place, target.end, &mut files) } else { files.push(place) }
    }
    files.sort();
    files
}

fn below(folder: &Path, end: &str, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() && !path.ends_with("target") {
            below(&path, end, files);
        } else if path.is_file() && path.to_string_lossy().ends_with(end) {
            files.push(path);
        }
    }
}
