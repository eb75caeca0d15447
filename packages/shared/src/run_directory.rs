//! The directory that a command writes to: one program writes there at a time, it says whose its files are, so that no
//! other command or scene overwrites them, and nothing of an earlier run stays that a reader would take for this one's.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Seek, Write};
use std::path::{Component, Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::error::Error;
use super::file_names::{collide, is_of};
use super::kept_file::set_aside_if_there;
use super::{folder, shell, toml_file};

/// The file whose lock says that a run writes to its directory, and in which stands whose the files there are. The
/// system releases the lock however the run ends; the file stays.
const LOCK: &str = "toron.lock";

/// The directory, for as long as its lock is held.
#[derive(Debug)]
pub struct RunDirectory {
    path: PathBuf,
    _lock: File,
}

/// A directory whose lock is held for a run that would overwrite nobody's files there; they are not its own yet. A run
/// that ends before it writes leaves the directory to whom it belongs.
#[derive(Debug)]
pub struct Locked {
    path: PathBuf,
    lock: File,
    /// What stands in [`LOCK`], and what is to stand there.
    text: [String; 2],
    /// The names of the run's files, where none that is there can be an earlier run's: nothing says so.
    foreign: Vec<String>,
}

/// What a command is about to write to a directory.
#[derive(Clone, Debug, Default)]
pub struct Writes<'a> {
    pub command: &'a str,
    /// The files that the command was given: a scene, histories, or none.
    pub files: Vec<&'a Path>,
    /// What its files are called, without endings and what is behind the names of cases.
    pub names: Vec<String>,
    /// Whether it goes on from checkpoints there, which it knows for its own: the scene may have been moved since.
    pub restart: bool,
    /// The file there that another command reads next, which goes on with this one's work and may write its files anew.
    pub hands_over: &'a str,
}

/// Who has written files to a directory: a line of [`LOCK`].
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct Owner {
    command: String,
    /// The files that it was given, as [`known_as`]; empty where there were none.
    scene: String,
    names: Vec<String>,
    /// As of [`Writes`].
    #[serde(default, skip_serializing_if = "String::is_empty")]
    hands_over: String,
}

impl Owner {
    fn is_same_run(&self, other: &Owner) -> bool {
        self.command == other.command && self.scene == other.scene
    }

    /// Whether a run must not overwrite this one's files: those out of no file are nobody's data, and one of two goes
    /// on with the other's work where it was handed over.
    fn keeps_from(&self, new: &Owner) -> bool {
        let goes_on = |after: &Owner, before: &Owner| !after.scene.is_empty() && after.scene == before.hands_over;
        !self.scene.is_empty() && !goes_on(self, new) && !goes_on(new, self)
    }

    /// A name of the other's files that would be called as some of this one's.
    fn shared<'a>(&self, other: &'a Owner) -> Option<&'a str> {
        let shared = |name: &&String| self.names.iter().any(|own| collide(own, name));
        other.names.iter().find(shared).map(String::as_str)
    }

    fn described(&self) -> String {
        format!("toron {} {}", self.command, self.scene).trim_end().to_string()
    }
}

/// What a file is called in a directory: its path from there, as they may be moved together; the standard input by what
/// it says.
///
/// # Errors
/// The standard input cannot be read.
fn known_as(directory: &Path, file: &Path) -> Result<String, Error> {
    if !toml_file::is_standard_input(file) {
        return Ok(seen_from(directory, file));
    }
    toml_file::read(file).map(|(_, text)| of_standard_input(&text))
}

fn of_standard_input(text: &str) -> String {
    format!("- ({:08x})", crc32fast::hash(text.as_bytes()))
}

/// A file's path from a directory on, both real ones where they exist.
fn seen_from(directory: &Path, file: &Path) -> String {
    let real = |path: &Path| std::fs::canonicalize(path).or_else(|_| std::path::absolute(path)).unwrap_or_default();
    let [directory, file] = [directory, file].map(real);
    let [from, to]: [Vec<Component>; 2] = [&directory, &file].map(|path| path.components().collect());
    let common = from.iter().zip(&to).take_while(|(from, to)| from == to).count();
    let up = from[common..].iter().map(|_| Component::ParentDir);
    up.chain(to[common..].iter().copied()).collect::<PathBuf>().display().to_string()
}

impl Locked {
    /// Writes down whose the files are, before the first of them is written. In a directory that no run has written to,
    /// files of the same names are a user's own, and get other names.
    ///
    /// # Errors
    /// It cannot be written, or a file not be renamed.
    pub fn claim(self) -> Result<RunDirectory, Error> {
        let Locked { path, mut lock, text: [old, new], foreign } = self;
        for entry in std::fs::read_dir(&path).map_err(|error| file_error(&path, &error))? {
            let entry = entry.map_err(|error| file_error(&path, &error))?;
            let is_own = entry.file_name().to_str().is_some_and(|name| foreign.iter().any(|own| is_of(name, own, 0)));
            // What is no regular file cannot be written to, and is named then.
            if is_own && entry.file_type().is_ok_and(|kind| kind.is_file()) {
                set_aside_if_there(&entry.path())?;
            }
        }
        if new != old {
            let written = lock.rewind().and_then(|()| lock.set_len(0)).and_then(|()| lock.write_all(new.as_bytes()));
            written.map_err(|error| file_error(&path.join(LOCK), &error))?;
        }
        Ok(RunDirectory { path, _lock: lock })
    }
}

impl RunDirectory {
    /// Makes the directory, if it is new, and takes its lock.
    ///
    /// # Errors
    /// It is a file, it cannot be made, another run writes there, or files of another command or scene would be
    /// overwritten.
    pub fn lock(path: &Path, writes: Writes<'_>) -> Result<Locked, Error> {
        folder::create(path)?;
        let file = path.join(LOCK);
        is_file(&file)?;
        let lock = OpenOptions::new().create(true).truncate(false).read(true).write(true).open(&file);
        let mut lock = lock.map_err(|error| file_error(&file, &error))?;
        // Where a file system has no locks, the run goes on without.
        if let Err(TryLockError::WouldBlock) = lock.try_lock() {
            let (path, allowed) =
                (path.display(), "allowed: a directory of its own, or this one when that run has ended");
            return Err(Error::Input(format!(
                "output is {path}, to which another run writes ({LOCK} is locked); {allowed}"
            )));
        }
        let mut text = String::new();
        lock.read_to_string(&mut text).map_err(|error| file_error(&file, &error))?;
        let lines = allowed(path, &text, &writes)?.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>();
        let lines = lines.map_err(|error| file_error(&file, &error))?.iter().map(|line| format!("{line}\n")).collect();
        let foreign = if text.is_empty() && !writes.restart { writes.names } else { Vec::new() };
        Ok(Locked { path: path.to_path_buf(), lock, text: [text, lines], foreign })
    }

    /// That a run would overwrite nobody's files in a directory, which need not be there, without its lock: for one
    /// that writes at the end if at all.
    ///
    /// # Errors
    /// It is a file, its lock's file cannot be read, or files of another command or scene would be overwritten.
    pub fn check(path: &Path, writes: &Writes<'_>) -> Result<(), Error> {
        folder::check(path)?;
        let file = path.join(LOCK);
        let text = if is_file(&file)? { std::fs::read_to_string(&file) } else { Ok(String::new()) };
        let text = text.map_err(|error| file_error(&file, &error))?;
        allowed(path, &text, writes).map(drop)
    }

    /// Removes a file that is of an earlier run, if it is there; whether it was.
    ///
    /// # Errors
    /// It cannot be removed.
    pub fn remove(&self, name: &str) -> Result<bool, Error> {
        let file = self.path.join(name);
        match std::fs::remove_file(&file) {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
            Err(error) => Err(file_error(&file, &error)),
        }
    }

    /// Removes what an earlier run has written for this case: histories, plots, pictures, tables of strains, and the
    /// files for ParaView from the number `frames` on. Its checkpoint stays. Returns how many there were.
    ///
    /// # Errors
    /// The directory cannot be read, or a file not be removed.
    pub fn remove_files_of(&self, case: &str, frames: usize) -> Result<usize, Error> {
        let mut removed = 0;
        let entries = std::fs::read_dir(&self.path).map_err(|error| file_error(&self.path, &error))?;
        for entry in entries {
            let name = entry.map_err(|error| file_error(&self.path, &error))?.file_name();
            if let Some(name) = name.to_str().filter(|name| is_of(name, case, frames)) {
                removed += usize::from(self.remove(name)?);
            }
        }
        Ok(removed)
    }

    /// What to say of files that were removed; nothing of none.
    pub fn removal(&self, files: usize) -> String {
        match files {
            0 => String::new(),
            1 => format!("1 file of an earlier run is removed from {}\n", self.path.display()),
            _ => format!("{files} files of an earlier run are removed from {}\n", self.path.display()),
        }
    }
}

/// Who has files in a directory once a run has written to it; `text` is what stands in [`LOCK`].
///
/// # Errors
/// Files would be overwritten; the message names a directory where none would be.
fn allowed(path: &Path, text: &str, writes: &Writes<'_>) -> Result<Vec<Owner>, Error> {
    let Writes { command, files, names, restart, hands_over } = writes;
    let scene = files.iter().map(|file| known_as(path, file)).collect::<Result<Vec<_>, _>>()?.join(" ");
    let [command, hands_over] = [command, hands_over].map(|text| text.to_string());
    let owner = Owner { command, scene, names: names.clone(), hands_over };
    with(owners(&path.join(LOCK), text)?, owner.clone(), *restart).map_err(|taken| {
        let other = way_out(path, files.first().copied(), &owner).display().to_string();
        let option = shell::command(&["-o".to_string(), other]);
        let allowed =
            format!("allowed: another directory, as {option}, or this one without {LOCK}: then they are overwritten");
        Error::Input(format!("output is {}, where {taken}; {allowed}", path.display()))
    })
}

/// A directory beside this one in which a run overwrites nothing, called after the first file that the run is given.
fn way_out(path: &Path, file: Option<&Path>, owner: &Owner) -> PathBuf {
    let stem = file.filter(|file| !toml_file::is_standard_input(file)).and_then(Path::file_stem);
    let stem = stem.map(|stem| stem.to_string_lossy().into_owned());
    let beside = |ending: String| match path.file_name() {
        Some(name) => path.with_file_name(format!("{}-{ending}", name.to_string_lossy())),
        None => path.join(ending),
    };
    let would_do = |place: &PathBuf| match std::fs::read_to_string(place.join(LOCK)) {
        Ok(text) => owners(place, &text).is_ok_and(|owners| with(owners, owner.clone(), false).is_ok()),
        Err(_) => !place.exists(),
    };
    let mut places = stem.into_iter().chain((2..).map(|number: u32| number.to_string())).map(beside);
    places.find(would_do).unwrap_or_default()
}

/// The lines of [`LOCK`]; an earlier version wrote none.
///
/// # Errors
/// One cannot be read.
fn owners(file: &Path, text: &str) -> Result<Vec<Owner>, Error> {
    let line = |(number, line)| {
        serde_json::from_str(line).map_err(|error| {
            let allowed = "allowed: what toron wrote there, or no such file";
            Error::Input(format!("{}:{}: {error}; {allowed}", file.display(), number + 1))
        })
    };
    text.lines().enumerate().map(line).collect()
}

/// The owners of a directory with one more, which takes the place of the same run's before; the names of that one stay
/// its own, since its files may be there still.
///
/// # Errors
/// Whose files would be overwritten.
fn with(owners: Vec<Owner>, mut new: Owner, restart: bool) -> Result<Vec<Owner>, String> {
    let is_own = |owner: &Owner| owner.is_same_run(&new) || restart && owner.command == new.command;
    let (before, mut others): (Vec<Owner>, Vec<Owner>) = owners.into_iter().partition(is_own);
    for other in others.iter().filter(|other| other.keeps_from(&new)) {
        if let Some(name) = new.shared(other) {
            let [other, new] = [other, &new].map(Owner::described);
            return Err(format!("files called {name} are of {other}, and {new} would overwrite them"));
        }
    }
    // What was of nobody is this run's now.
    others.retain(|other| !other.scene.is_empty() || new.shared(other).is_none());
    new.names.extend(before.into_iter().flat_map(|owner| owner.names));
    new.names.sort();
    new.names.dedup();
    others.push(new);
    Ok(others)
}

/// Whether there is a file; what is none, a pipe or a device, would be waited for without end.
///
/// # Errors
/// There is something else.
pub fn is_file(file: &Path) -> Result<bool, Error> {
    match std::fs::metadata(file) {
        Ok(found) if found.is_file() => Ok(true),
        Ok(found) => {
            let what = if found.is_dir() { "a directory" } else { "a pipe or a device" };
            Err(Error::Input(format!("{} is {what}; allowed: a regular file, or none", file.display())))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(file_error(file, &error)),
    }
}

/// What went wrong with a file.
pub fn file_error(file: &Path, error: &dyn std::fmt::Display) -> Error {
    Error::Input(format!("{}: {error}", file.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn owner(command: &str, scene: &str, names: &[&str]) -> Owner {
        Owner {
            command: command.into(),
            scene: scene.into(),
            names: names.iter().map(|name| name.to_string()).collect(),
            hands_over: String::new(),
        }
    }

    #[test]
    fn files_of_another_command_or_scene_are_not_overwritten() {
        let impact = owner("impact", "../a.toml", &["one", "summary"]);
        let there = || vec![impact.clone()];
        for (new, name) in [
            (owner("fabric", "../a.toml", &["summary", "scene"]), "summary"),
            (owner("impact", "../b.toml", &["two", "summary"]), "summary"),
            (owner("fabric", "../b.toml", &["ONE-strain-2"]), "one"),
        ] {
            let refused = with(there(), new.clone(), false).expect_err("it is refused");
            let said = format!("files called {name} are of toron impact ../a.toml, and toron {}", new.command);
            assert!(refused.starts_with(&said), "{refused}");
        }
        // What overwrites nothing is welcome, and the same scene may have other cases.
        let weave = owner("weave", "../a.toml", &["weave"]);
        let both = with(there(), weave.clone(), false).expect("two owners");
        assert_eq!(both, [impact.clone(), weave.clone()]);
        let other = with(both, owner("impact", "../a.toml", &["summary", "two"]), false).expect("the same run");
        assert_eq!(other, [weave, owner("impact", "../a.toml", &["one", "summary", "two"])]);
        // A run that goes on is known by its checkpoint, wherever its scene lies now.
        let moved = owner("impact", "../../b.toml", &["one", "summary"]);
        assert_eq!(with(there(), moved.clone(), true), Ok(vec![moved]));
        assert!(with(there(), owner("fabric", "", &["one"]), true).is_err());
    }

    #[test]
    fn files_out_of_no_file_are_nobody_s() {
        let [demonstration, path] = [owner("run", "", &["plot"]), owner("run", "../a.toml", &["plot"])];
        assert_eq!(with(vec![demonstration.clone()], path.clone(), false), Ok(vec![path.clone()]));
        // They take no place of somebody's, and what is not overwritten stays in the list.
        assert!(with(vec![path.clone()], demonstration.clone(), false).is_err());
        let bench = owner("bench", "", &["bench"]);
        assert_eq!(with(vec![bench.clone()], path.clone(), false), Ok(vec![bench, path]));
    }

    #[test]
    fn what_is_handed_over_may_be_gone_on_with() {
        let cell = Owner { hands_over: "fit.toml".into(), ..owner("cell", "../a.toml", &["fit", "parameters"]) };
        let fit = owner("fit", "fit.toml", &["fit", "parameters", "yarn"]);
        // One after the other, and both again.
        let both = vec![cell.clone(), fit.clone()];
        assert_eq!(with(vec![cell.clone()], fit.clone(), false), Ok(both.clone()));
        assert_eq!(with(both.clone(), cell.clone(), false), Ok(vec![fit.clone(), cell.clone()]));
        for other in [owner("fit", "../fit.toml", &["parameters"]), owner("cell", "../b.toml", &["fit"])] {
            assert!(with(both.clone(), other, false).expect_err("another one").contains("are of toron cell ../a.toml"));
        }
    }

    #[test]
    fn a_refused_run_owns_nothing_and_is_told_where_to_go() {
        let place = std::env::temp_dir().join(format!("toron-way-out-{}", std::process::id()));
        let out = place.join("out");
        let lock = |file: &str| {
            let names = vec!["plot".to_string()];
            let writes = Writes { command: "run", files: vec![Path::new(file)], names, ..Writes::default() };
            RunDirectory::lock(&out, writes)
        };
        let text = || std::fs::read_to_string(out.join(LOCK)).expect("a file");
        drop(lock("/x/a.toml").expect("nobody's"));
        assert_eq!(text(), "");
        drop(lock("/x/b.toml").and_then(Locked::claim).expect("nobody's still"));
        let refused = || lock("/x/my path.toml").expect_err("another one's").to_string();
        let told = |ending: &str| format!("another directory, as -o '{}-{ending}', or", out.display());
        assert!(refused().contains(&told("my path")), "{}", refused());
        std::fs::create_dir(place.join("out-my path")).expect("a folder");
        assert!(refused().contains(&told("2").replace('\'', "")), "{}", refused());
        assert_eq!(text().lines().count(), 1);
        std::fs::remove_dir_all(&place).expect("it is removed");
    }

    #[test]
    fn a_users_own_files_get_other_names() {
        let path = std::env::temp_dir().join(format!("toron-own-files-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a directory");
        let there = |name: &str| std::fs::read_to_string(path.join(name)).ok();
        for name in ["fast.csv", "notes.csv"] {
            std::fs::write(path.join(name), name).expect("a file");
        }
        let open = || {
            let names = vec!["fast".to_string()];
            RunDirectory::lock(
                &path,
                Writes { command: "impact", files: vec![Path::new("/x.toml")], names, ..Writes::default() },
            )
            .and_then(Locked::claim)
        };
        drop(open().expect("a directory"));
        assert_eq!(
            [there("fast.csv"), there("fast.csv-old"), there("notes.csv")].map(|text| text.is_some()),
            [false, true, true]
        );
        // From now on a file of that name is the run's.
        std::fs::write(path.join("fast.csv"), "history").expect("a file");
        drop(open().expect("a directory"));
        assert_eq!(there("fast.csv").as_deref(), Some("history"));
        std::fs::remove_dir_all(&path).expect("it is removed");
    }

    #[test]
    fn a_scene_is_known_from_the_directory_on() {
        assert_eq!(seen_from(Path::new("/x/out"), Path::new("/x/a b.toml")), "../a b.toml");
        assert_eq!(seen_from(Path::new("/x"), Path::new("/x/y/a.toml")), "y/a.toml");
    }

    #[test]
    fn what_the_standard_input_says_is_a_scene_of_its_own() {
        let [one, two] =
            ["speed = 1.0", "speed = 2.0"].map(|text| owner("impact", &of_standard_input(text), &["summary"]));
        assert_eq!(with(vec![one.clone()], one.clone(), false), Ok(vec![one.clone()]));
        let refused = with(vec![one.clone()], two.clone(), false).expect_err("another one");
        assert!(
            refused.contains(&format!("are of toron impact {}, and toron impact {}", one.scene, two.scene)),
            "{refused}"
        );
        assert!(
            one.scene.starts_with("- (") && known_as(Path::new("/x"), Path::new("/x/-")).is_ok_and(|name| name == "-")
        );
    }

    #[test]
    fn other_files_of_a_command_are_another_run() {
        let path = std::env::temp_dir().join(format!("toron-run-directory-{}", std::process::id()));
        let open = |files: &[&str]| {
            let (files, names) = (files.iter().map(Path::new).collect(), vec!["compare".to_string()]);
            let writes = Writes { command: "compare", files, names, ..Writes::default() };
            RunDirectory::lock(&path, writes).and_then(Locked::claim).map(drop)
        };
        assert!(open(&["/x/a.csv", "/x/b.csv"]).is_ok() && open(&["/x/a.csv", "/x/b.csv"]).is_ok());
        let refused = open(&["/x/a.csv", "/x/c.csv"]).expect_err("another one").to_string();
        assert!(refused.contains("files called compare are of toron compare "), "{refused}");
        std::fs::remove_dir_all(&path).expect("it is removed");
    }

    #[test]
    fn what_stands_in_the_file_is_read_or_refused() {
        let one = owner("run", "a.toml", &["plot"]);
        let text = serde_json::to_string(&one).expect("JSON") + "\n";
        assert_eq!(owners(Path::new("toron.lock"), &text).expect("a line"), [one]);
        let error = owners(Path::new("toron.lock"), &format!("{text}x\n")).expect_err("no line").to_string();
        assert!(error.starts_with("toron.lock:2: "), "{error}");
    }
}
