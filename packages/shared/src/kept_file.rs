//! Files that are written in one go. Of one that a user may have changed by hand, a command that writes it again keeps
//! the old one beside it.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use super::console::print_error;
use super::error::Error;
use super::run_directory::{file_error, is_file};

/// Large enough for decks of many elements.
const BUFFER: usize = 1 << 20;

/// Writes a file in one go. If one is there with other contents, it gets another name first, and that is said. What is
/// written until an error is removed.
///
/// # Errors
/// The file cannot be written, or what is there is no regular file, or something is called as the one that is being
/// written.
pub fn write(place: &Path, contents: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), Error> {
    put(place, contents, true)
}

/// The same for a file that is not edited by hand, such as a mesh: no copy is kept.
///
/// # Errors
/// As for [`write()`].
pub fn overwrite(place: &Path, contents: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), Error> {
    put(place, contents, false)
}

fn put(
    place: &Path,
    contents: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    is_kept: bool,
) -> Result<(), Error> {
    let is_there = is_file(place)?;
    let new = with_ending(place, "-new");
    let file = File::create_new(&new).map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => file_error(&new, &"is there already; allowed: no such file"),
        _ => file_error(place, &error),
    })?;
    let written = write_new(file, contents).and_then(|()| Ok(is_kept && is_there && !are_equal(&new, place)?));
    let put = written.map_err(|error| file_error(place, &error)).and_then(|differs| {
        if differs {
            set_aside_if_there(place)?;
        }
        std::fs::rename(&new, place).map_err(|error| file_error(place, &error))
    });
    if put.is_err() {
        let _ = std::fs::remove_file(&new); // the error before it is the one to say
    }
    put
}

fn write_new(file: File, contents: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    let mut file = BufWriter::with_capacity(BUFFER, file);
    contents(&mut file)?;
    file.flush()
}

/// Gives a file another name, if it is there, and says so.
///
/// # Errors
/// It cannot be renamed, or is no regular file.
pub fn set_aside_if_there(place: &Path) -> Result<(), Error> {
    if is_file(place)? {
        let old = set_aside(place)?;
        print_error(&format!("{}, as it was before, is now {}\n", place.display(), old.display()));
    }
    Ok(())
}

/// Gives a file another name, which none has that was set aside before, but for one of the same contents; returns that.
///
/// # Errors
/// It cannot be read or renamed.
pub fn set_aside(place: &Path) -> Result<PathBuf, Error> {
    let mut endings = std::iter::once("-old".to_string()).chain((2..).map(|number| format!("-old-{number}")));
    let is_free = |old: &PathBuf| !old.exists() || are_equal(old, place).unwrap_or(false);
    let old = endings.find_map(|ending| Some(with_ending(place, &ending)).filter(is_free)).unwrap_or_default();
    std::fs::rename(place, &old).map_err(|error| file_error(&old, &error))?;
    Ok(old)
}

fn with_ending(place: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(place);
    name.push(ending);
    name.into()
}

fn are_equal(one: &Path, other: &Path) -> io::Result<bool> {
    let [one, other] = [File::open(one)?, File::open(other)?];
    if one.metadata()?.len() != other.metadata()?.len() {
        return Ok(false);
    }
    let [mut one, mut other] = [one, other].map(|file| BufReader::with_capacity(BUFFER, file).bytes());
    loop {
        match (one.next().transpose()?, other.next().transpose()?) {
            (None, None) => return Ok(true),
            (a, b) if a == b => {}
            _ => return Ok(false),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_there_is_kept_unless_it_is_the_same() {
        let folder = std::env::temp_dir().join(format!("toron-kept-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let place = folder.join("my-yarn.toml");
        for text in ["one", "one", "two", "six", "six", "two", "six"] {
            write(&place, |file| file.write_all(text.as_bytes())).expect("it is written");
        }
        let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("it is there");
        let names = ["my-yarn.toml-old", "my-yarn.toml-old-2", "my-yarn.toml-old-3", "my-yarn.toml"];
        assert_eq!(names.map(read), ["one", "two", "six", "six"]);
        assert_eq!(std::fs::read_dir(&folder).expect("a folder").count(), names.len());
        assert!(write(&folder, |_| Ok(())).expect_err("a directory").to_string().contains("is a directory"));
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }

    #[test]
    fn a_mesh_takes_the_place_of_another() {
        let folder = std::env::temp_dir().join(format!("toron-mesh-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let place = folder.join("one-mesh.k");
        for text in ["one", "two", "two"] {
            overwrite(&place, |file| file.write_all(text.as_bytes())).expect("it is written");
        }
        assert_eq!(std::fs::read_to_string(&place).expect("it is there"), "two");
        assert_eq!(std::fs::read_dir(&folder).expect("a folder").count(), 1);
        assert!(overwrite(&folder, |_| Ok(())).expect_err("a directory").to_string().contains("is a directory"));
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }

    #[test]
    fn what_could_not_be_written_leaves_nothing() {
        let folder = std::env::temp_dir().join(format!("toron-kept-new-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let [place, new] = ["scene.inp", "scene.inp-new"].map(|name| folder.join(name));
        let read = |file: &Path| std::fs::read_to_string(file).expect("it is there");
        write(&place, |file| file.write_all(b"one")).expect("it is written");
        let error = write(&place, |file| file.write_all(b"two").and(Err(io::Error::other("no room"))));
        assert!(error.expect_err("no room").to_string().ends_with("scene.inp: no room"));
        assert!(read(&place) == "one" && !new.exists());
        // What someone else has called so stays.
        std::fs::write(&new, "mine").expect("a file");
        let error = write(&place, |file| file.write_all(b"two")).expect_err("it is there").to_string();
        assert!(error.ends_with("scene.inp-new: is there already; allowed: no such file"), "{error}");
        assert_eq!([read(&place), read(&new)], ["one", "mine"]);
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }
}
