//! `toron compare`: from the files of several hosts to a table and a figure.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::Args;
use toron::host::units::UnitSystem;

use super::figures::Figures;
use super::history::History;
use super::{of_abaqus, of_ls_dyna, of_openradioss, of_toron, plot, report};
use crate::scene_deck::origin::Origin;
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::run_directory::{RunDirectory, Writes, file_error};
use toron_shared::text_table::{files, shortened, write_csv};
use toron_shared::{folder, toml_file};

/// Letters of a line that a message repeats.
const LONGEST: usize = 40;
const TABLE: &str = "compare.csv";
const FIGURE: [&str; 2] = ["compare.svg", "compare.png"];

#[derive(Args, Debug)]
pub struct Arguments {
    /// NAME.csv of toron, or - for the standard input; NAMET01.csv, which th_to_csv of OpenRadioss/Tools makes; the
    /// folder of a run of LS-DYNA; the table that the script beside an Abaqus deck makes. The first one is what the
    /// others are compared with.
    #[arg(required = true)]
    histories: Vec<PathBuf>,
    /// What the histories are called, in their order: A,B,…; without it, as their files, with as much of their folders
    /// as tells them apart.
    #[arg(long, value_delimiter = ',')]
    names: Vec<String>,
    /// The units of table and figure.
    #[arg(long, default_value = "mm-g-ms")]
    units: String,
    /// The units of histories of other hosts whose deck does not lie beside them.
    #[arg(long)]
    deck_units: Option<String>,
    /// What part of the whole those have: 0.25 of a quarter.
    #[arg(long)]
    part: Option<f64>,
    /// Where the table and the figure go.
    #[arg(short, long, default_value = "toron-out/compare")]
    output: PathBuf,
}

/// # Errors
/// An argument, a file that is no history, or one that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Error> {
    let (units, given) = (system("--units", &arguments.units)?, arguments.given()?);
    let count = arguments.histories.len();
    if !arguments.names.is_empty() && arguments.names.len() != count {
        let names = arguments.names.len();
        return Err(Error::Input(format!("--names has {names} for {count} histories; allowed: a name for each")));
    }
    folder::check(&arguments.output)?;
    let mut histories = Vec::new();
    let names = if arguments.names.is_empty() { names(&arguments.histories) } else { arguments.names.clone() };
    for (path, name) in arguments.histories.iter().zip(names) {
        histories.push(read(path, name, &units, given)?);
    }
    let judged = histories.iter().map(|history| Figures::of(history, &histories[0])).collect::<Vec<_>>();
    let judged: Vec<(&History, Figures)> = histories.iter().zip(judged).collect();
    let paths = arguments.histories.iter().map(PathBuf::as_path).collect();
    let names = vec!["compare".to_string()];
    let writes = Writes { command: "compare", files: paths, names, ..Writes::default() };
    let _directory = RunDirectory::lock(&arguments.output, writes)?.claim()?;
    let [svg, png] = FIGURE.map(|name| arguments.output.join(name));
    plot::write(&svg, &png, &histories.iter().collect::<Vec<_>>(), &units)?;
    let lines: Vec<_> = judged.iter().map(|(history, figures)| report::line(history, figures, &units)).collect();
    write_csv(&arguments.output.join(TABLE), &lines)?;
    let missing: String = histories.iter().filter_map(report::missing).collect();
    let written = [(true, TABLE, "the table"), (true, "compare.svg, .png", "all histories over time")];
    print(&format!("{}\n{missing}\n{}", report::report(&judged, &units), files(&arguments.output, &written)));
    Ok(())
}

impl Arguments {
    /// What the options say of histories whose deck is not there.
    fn given(&self) -> Result<Option<Origin>, Error> {
        let part = self.part.unwrap_or(1.0);
        if !(part > 0.0 && part <= 1.0) {
            return Err(Error::Input(format!("--part {part}; allowed: a number > 0, up to 1")));
        }
        let units = self.deck_units.as_deref().map(|name| system("--deck-units", name)).transpose()?;
        match units {
            None if self.part.is_some() => Err(Error::Input("--part is given; allowed: with --deck-units".to_string())),
            units => Ok(units.map(|units| Origin { units, part })),
        }
    }
}

fn system(option: &str, name: &str) -> Result<UnitSystem, Error> {
    UnitSystem::parse(name).ok_or_else(|| Error::Input(format!("{option} {name}; allowed: {}", UnitSystem::ALLOWED)))
}

/// A file without its ending, or a folder.
fn name_of(path: &Path) -> String {
    let name = if path.is_dir() { path.file_name() } else { path.file_stem() };
    name.map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
}

/// The names of all, each with as many of its folders before it as it takes to be no other's.
fn names(paths: &[PathBuf]) -> Vec<String> {
    let with_folders = |path: &Path, folders: usize| {
        let above = path.parent().map(|parent| parent.components().collect::<Vec<_>>()).unwrap_or_default();
        let above = above.iter().skip(above.len().saturating_sub(folders)).collect::<PathBuf>();
        above.join(name_of(path)).display().to_string()
    };
    let deepest = paths.iter().map(|path| path.components().count()).max().unwrap_or_default();
    let name = |path: &PathBuf| {
        let alone = |folders: &usize| {
            let own = with_folders(path, *folders);
            paths.iter().filter(|other| with_folders(other, *folders) == own).count() == 1
        };
        with_folders(path, (0..deepest).find(alone).unwrap_or_default())
    };
    paths.iter().map(name).collect()
}

/// A history, whatever host's it is, in these units.
///
/// # Errors
/// It is none, or its units are not told.
fn read(path: &Path, name: String, units: &UnitSystem, given: Option<Origin>) -> Result<History, Error> {
    if path.is_dir() {
        let history = of_ls_dyna::read(path, name)?;
        return Ok(history.converted(&origin(path, &decks_in(path)?, given)?, units));
    }
    let (shown, text) = if toml_file::is_standard_input(path) {
        toml_file::read(path)?
    } else {
        let bytes = std::fs::read(path).map_err(|error| file_error(path, &error))?;
        (path.display().to_string(), String::from_utf8_lossy(&bytes).into_owned())
    };
    let path = Path::new(&shown);
    let stem = name_of(path);
    let beside = |name: String| [path.with_file_name(name)];
    let first = text.lines().find(|line| !line.starts_with('#')).unwrap_or_default();
    if first.starts_with(of_toron::START) {
        of_toron::read(path, &text, units, name)
    } else if first.starts_with(of_openradioss::START) {
        let history = of_openradioss::read(path, &text, name)?;
        let case = stem.rsplit_once('T').map_or(stem.as_str(), |(case, _)| case);
        Ok(history.converted(&origin(path, &beside(format!("{case}_0000.rad")), given)?, units))
    } else if first.contains(of_abaqus::MARK) {
        let history = of_abaqus::read(path, &text, name)?;
        let case = stem.strip_suffix("-history").unwrap_or(&stem);
        Ok(history.converted(&origin(path, &beside(format!("{case}.inp")), given)?, units))
    } else {
        let allowed =
            "the first line of toron's history, of th_to_csv's table or of abaqus_history.py's; a folder of LS-DYNA";
        let begins = shortened(first, LONGEST);
        Err(Error::Input(format!("{}:1: begins with \"{begins}\"; allowed: {allowed}", path.display())))
    }
}

/// What the decks say of themselves, or else the options of the command.
fn origin(history: &Path, decks: &[PathBuf], given: Option<Origin>) -> Result<Origin, Error> {
    let mut found: Option<Origin> = None;
    for deck in decks {
        match (Origin::of_deck(deck)?, found) {
            (Some(origin), Some(other)) if origin != other => {
                let (history, deck) = (history.display(), deck.display());
                return Err(Error::Input(format!(
                    "{history}: {deck} has other units than another deck there; allowed: one"
                )));
            }
            (origin, _) => found = origin.or(found),
        }
    }
    found.or(given).ok_or_else(|| {
        let decks = decks.first().map_or("*.k".to_string(), |deck| deck.display().to_string());
        let reason = format!("its units are not told, for no deck of toron is there as {decks}");
        Error::Input(format!(
            "{}: {reason}; allowed: the deck beside it, or --deck-units and --part",
            history.display()
        ))
    })
}

fn decks_in(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = std::fs::read_dir(folder).map_err(|error| file_error(folder, &error))?;
    let mut decks: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    decks.retain(|file| file.extension() == Some(OsStr::new("k")));
    decks.sort();
    Ok(decks)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn histories_of_one_name_are_told_by_their_folders() {
        let of = |paths: &[&str]| names(&paths.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(of(&["a/scene.csv", "b/sceneT01.csv"]), ["scene", "sceneT01"]);
        assert_eq!(of(&["a/scene.csv", "b/scene.csv", "b/one.csv"]), ["a/scene", "b/scene", "one"]);
        assert_eq!(of(&["a/x/scene.csv", "b/x/scene.csv"]), ["a/x/scene", "b/x/scene"]);
        assert_eq!(of(&["scene.csv", "b/scene.csv"]), ["scene", "b/scene"]);
        assert_eq!(of(&["scene.csv", "scene.csv"]), ["scene", "scene"]);
    }
}
