//! CalculiX as a process: where it is, a run in a folder of its own, and what it says when it fails.

use std::ffi::OsStr;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use super::printed::{self, Table};
use toron_shared::bound_child;
use toron_shared::error::Error;

/// The variable that names the program where no option does.
pub const VARIABLE: &str = "TORON_CCX";
/// The program's name in the folders of PATH.
const PROGRAM: &str = "ccx";
/// The job's name: the deck is job.inp.
const JOB: &str = "job";
/// How often a run is looked at.
const LOOK: Duration = Duration::from_millis(50);
/// How much of a run's own output its error has.
const LAST_LINES: usize = 6;

/// The program: the one given, that of the variable, or the one in PATH.
///
/// # Errors
/// There is none, or the one that is named is no file.
pub fn find(given: Option<&Path>) -> Result<PathBuf, Error> {
    let named = |what: &str, path: &Path| {
        if path.is_file() {
            // The run has a folder of its own, in which a relative path would lead nowhere.
            return std::path::absolute(path).map_err(|error| Error::Input(format!("{}: {error}", path.display())));
        }
        Err(Error::Input(format!("{what} is {}; allowed: the program ccx of CalculiX", path.display())))
    };
    if let Some(path) = given {
        return named("--ccx", path);
    }
    if let Some(path) = std::env::var_os(VARIABLE) {
        return named(VARIABLE, Path::new(&path));
    }
    in_path(std::env::var_os("PATH").as_deref()).ok_or_else(|| {
        Error::Input(format!(
            "there is no CalculiX: no program {PROGRAM} in PATH; allowed: install it (Debian: calculix-ccx), or name it \
             by --ccx PATH or by the variable {VARIABLE}"
        ))
    })
}

fn in_path(path: Option<&OsStr>) -> Option<PathBuf> {
    std::env::split_paths(path?).map(|folder| folder.join(PROGRAM)).find(|program| program.is_file())
}

/// What a run leaves.
#[derive(Debug)]
pub struct Printed {
    pub tables: Vec<Table>,
    /// Displacements and Cauchy stresses (xx, yy, zz, xy, yz, zx) at the front's nodes, at the end.
    pub displacements: Vec<(usize, [f64; 3])>,
    pub stresses: Vec<(usize, [f64; 6])>,
    /// Why it ended before its time.
    pub failure: Option<String>,
    pub elapsed: Duration,
}

/// A folder that is removed with what is in it.
struct Scratch(PathBuf);

impl Scratch {
    /// Empty: that of a run that was killed may still be there.
    fn new(folder: PathBuf) -> std::io::Result<Self> {
        if folder.exists() {
            std::fs::remove_dir_all(&folder)?;
        }
        std::fs::create_dir_all(&folder)?;
        Ok(Scratch(folder))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A run of CalculiX: the program, the directory and the name of its files there, and how many threads it may use.
pub struct Job<'a> {
    pub program: &'a Path,
    pub output: &'a Path,
    pub name: &'a str,
    pub threads: usize,
}

impl Job<'_> {
    /// Runs a deck, which it leaves as `NAME.inp`, to whatever end it comes, in the folder `NAME.ccx`, which is then
    /// removed. What CalculiX says goes to `NAME.log`, which stays where the run fails. `progress` is told the part of
    /// the load that has been taken.
    ///
    /// # Errors
    /// The program cannot be started, or its files cannot be written or read.
    pub fn run(&self, deck: &str, progress: &mut dyn FnMut(f64)) -> Result<Printed, Error> {
        let [folder, log, kept] =
            ["ccx", "log", "inp"].map(|ending| self.output.join(format!("{}.{ending}", self.name)));
        let file_error = |error: std::io::Error| Error::Input(format!("{}: {error}", folder.display()));
        let scratch = Scratch::new(folder.clone()).map_err(file_error)?;
        let file = |ending: &str| scratch.0.join(format!("{JOB}.{ending}"));
        for copy in [&file("inp"), &kept] {
            std::fs::write(copy, deck).map_err(|error| Error::Input(format!("{}: {error}", copy.display())))?;
        }
        let said = File::create(&log).map_err(file_error)?;
        let mut command = Command::new(self.program);
        command.arg(JOB).current_dir(&scratch.0).env("OMP_NUM_THREADS", self.threads.to_string()).stdin(Stdio::null());
        command.stderr(said.try_clone().map_err(file_error)?).stdout(said);
        bound_child::bind(&mut command);
        let start = Instant::now();
        let child = command.spawn().map_err(|error| Error::Input(format!("{}: {error}", self.program.display())))?;
        let status = wait(child, &file("sta"), progress).map_err(file_error)?;
        let read = |path: &Path| std::fs::read(path).map(|text| String::from_utf8_lossy(&text).into_owned());
        let fields = read(&file("frd")).unwrap_or_default();
        let failure = failure(status, &read(&log).unwrap_or_default());
        if failure.is_none() {
            std::fs::remove_file(&log).map_err(file_error)?;
        }
        Ok(Printed {
            tables: printed::tables(&read(&file("dat")).unwrap_or_default()),
            displacements: printed::last_field(&fields, "DISP"),
            stresses: printed::last_field(&fields, "STRESS"),
            failure: failure.map(|why| format!("{why}; all it said is in {}", log.display())),
            elapsed: start.elapsed(),
        })
    }
}

/// Waits for the end, looking into the file where each increment has its line.
fn wait(mut child: Child, increments: &Path, progress: &mut dyn FnMut(f64)) -> std::io::Result<ExitStatus> {
    loop {
        let status = child.try_wait()?;
        progress(reached(&std::fs::read_to_string(increments).unwrap_or_default()));
        if let Some(status) = status {
            return Ok(status);
        }
        std::thread::sleep(LOOK);
    }
}

/// The time in the last whole line: step, increment, attempt, iterations, time.
fn reached(increments: &str) -> f64 {
    let time = increments.lines().last().and_then(|line| line.split_whitespace().nth(4)?.parse().ok());
    time.unwrap_or(0.0)
}

/// What CalculiX said at the end where it was no good one: its errors, or its last lines.
fn failure(status: ExitStatus, log: &str) -> Option<String> {
    let lines: Vec<&str> = log.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let is_error = |line: &&str| line.starts_with("*ERROR") || line.contains("best solution and residuals");
    let errors: Vec<&str> = lines.iter().copied().filter(is_error).take(LAST_LINES).collect();
    if status.success() && errors.is_empty() {
        return None;
    }
    let said = if errors.is_empty() { lines[lines.len().saturating_sub(LAST_LINES)..].to_vec() } else { errors };
    Some(format!("CalculiX ended with {status}: {}", said.join("; ")))
}
