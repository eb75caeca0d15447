//! Changed files, each for its reader, in bounded time and memory: both are measured, and the system bounds the memory.

use std::fs;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use fastrand::Rng;
use toron_shared::error::Error;
use toron_shared::processor_time::thread_time;
use toron_test_support::library::{ROOT, folder};

use super::checkpoints;
use super::mutate::mutated;
use super::targets::{Target, files};

/// The most that a reader may take for a changed file: processor time, whatever else runs, and bytes.
const TIME: Duration = Duration::from_secs(10);
const MEMORY: u64 = 1 << 30;
/// The address space of the process that reads changed files: what a reader may take, and as much for the rest.
#[cfg(target_os = "linux")]
const ADDRESS_SPACE: u64 = 2 * MEMORY;
/// After so long nothing is waited for.
const HANGS: Duration = Duration::from_secs(300);

/// What a run has done.
#[derive(Clone, Copy, Debug, Default)]
pub struct Totals {
    pub files: u64,
    pub refused: u64,
    /// The longest time, and the most memory of one file.
    pub longest: Duration,
    pub most: u64,
}

/// What is said of a file while it is read, for the one that is never read to its end.
static CURRENT: Mutex<String> = Mutex::new(String::new());

/// Ends the process where no file is finished in time: a thread that does not come back cannot be ended alone.
fn watch() -> Sender<()> {
    let (alive, heard) = channel();
    thread::spawn(move || {
        loop {
            match heard.recv_timeout(HANGS) {
                Ok(()) => (),
                Err(RecvTimeoutError::Disconnected) => return,
                Err(RecvTimeoutError::Timeout) => {
                    let current = CURRENT.lock().map(|text| text.clone()).unwrap_or_default();
                    eprintln!("not read in {HANGS:?}: {current}");
                    std::process::abort();
                }
            }
        }
    });
    alive
}

/// Bounds the memory of this process: what asks for more ends it.
#[cfg(target_os = "linux")]
fn bound_memory() {
    let bound = libc::rlimit { rlim_cur: ADDRESS_SPACE, rlim_max: ADDRESS_SPACE };
    // SAFETY: a structure of the type that the function reads.
    assert_eq!(unsafe { libc::setrlimit(libc::RLIMIT_AS, &bound) }, 0, "the bound of the address space");
}

#[cfg(not(target_os = "linux"))]
fn bound_memory() {}

/// Where the name of the file that is read stands, for the one whose reader ends the process.
pub fn current() -> PathBuf {
    folder("fuzzed-files").join("current")
}

/// Copies the folders that readers look into, so that a changed file has its neighbours.
fn copies() -> PathBuf {
    let copies = folder("fuzzed-files");
    for place in ["examples", "ffi-tests/check", "program/assets", "packages/fuzz/corpus/files"] {
        copy(&Path::new(ROOT).join(place), &copies.join(place));
    }
    copies
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder of the repository").flatten() {
        let (path, target) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() && !path.ends_with("target") {
            copy(&path, &target);
        } else if path.is_file() {
            fs::copy(&path, &target).expect("a copy");
        }
    }
}

/// Reads so many changed files of these targets from this seed on. The memory of the process is bounded from then on.
///
/// # Errors
/// What a reader did wrong; the changed file is kept, and named.
pub fn run(targets: &[Target], seed: u64, count: u64) -> Result<Totals, String> {
    let (copies, alive) = (copies(), watch());
    let all: Vec<Vec<PathBuf>> = targets.iter().map(files).collect();
    bound_memory();
    let (mut totals, mut seeds) = (Totals::default(), Rng::with_seed(seed));
    for k in 0..count {
        let rng = &mut Rng::with_seed(seeds.u64(..));
        let (target, files) = (&targets[k as usize % targets.len()], &all[k as usize % targets.len()]);
        assert!(!files.is_empty(), "{}: no files", target.name);
        let [file, other] = [0; 2].map(|_| &files[rng.usize(..files.len())]);
        let [original, other] = [file, other].map(|file| fs::read(file).expect("a file of the repository"));
        let is_checkpoint = target.end == checkpoints::ENDING;
        let name = if is_checkpoint { file.file_name().map(Path::new) } else { file.strip_prefix(ROOT).ok() };
        let changed = copies.join(name.expect("a file of the repository"));
        let bytes = match is_checkpoint && rng.bool() {
            true => checkpoints::of_another(&original, |identity| mutated(rng, identity, &other)),
            false => mutated(rng, &original, &other),
        };
        let is_same = bytes == original;
        fs::write(&changed, bytes).expect("a changed file");
        fs::write(current(), format!("{} of {}", changed.display(), target.name)).expect("a file");
        let (start, refused) = (thread_time(), totals.refused);
        let mut read = one(target, &changed, &mut totals);
        // Any change of another file may have a meaning; of a checkpoint none has.
        if is_checkpoint && !is_same && read.is_ok() && totals.refused == refused {
            read = Err("a changed checkpoint is taken for a good one".into());
        }
        let time = thread_time().saturating_sub(start);
        if time > TIME / 5 {
            println!("file {k} took {time:?}, of {}: {}", target.name, changed.display());
        }
        if read.is_err() {
            let kept = copies.join(format!("found-{seed}-{k}")).with_extension(changed.extension().unwrap_or_default());
            fs::copy(&changed, &kept).expect("a copy");
            return read
                .map(|()| totals)
                .map_err(|why| format!("{why}\nof {}, kept as {}", target.name, kept.display()));
        }
        fs::write(&changed, original).expect("the file as it was");
        alive.send(()).expect("the watch listens");
    }
    Ok(totals)
}

/// Reads a file.
///
/// # Errors
/// A panic, too much time or memory, or a refusal that does not name the file.
pub fn one(target: &Target, file: &Path, totals: &mut Totals) -> Result<(), String> {
    if let Ok(mut current) = CURRENT.lock() {
        *current = format!("{} of {}", file.display(), target.name);
    }
    let start = thread_time();
    let mut read = Ok(Ok(()));
    let used = allocation_counter::measure(|| {
        read = panic::catch_unwind(AssertUnwindSafe(|| (target.read)(file)));
    });
    let time = thread_time().saturating_sub(start);
    totals.files += 1;
    (totals.longest, totals.most) = (totals.longest.max(time), totals.most.max(used.bytes_max));
    if time > TIME {
        return Err(format!("took {time:?}"));
    }
    if used.bytes_max > MEMORY {
        return Err(format!("took {} bytes", used.bytes_max));
    }
    match read {
        Err(_) => Err("a panic".into()),
        Ok(Ok(())) => Ok(()),
        Ok(Err(error)) => {
            totals.refused += 1;
            names(&error, file)
        }
    }
}

/// A refusal names the file, or another one that it refers to, and says what is wrong with it.
fn names(error: &Error, file: &Path) -> Result<(), String> {
    let message = error.to_string();
    let own = file.file_name().unwrap_or_default().to_string_lossy();
    let beside = file.parent().unwrap_or(file).to_string_lossy();
    let behind = |name: &str| message.find(name).map(|at| at + name.len());
    match behind(&own).or(behind(&beside)) {
        Some(named) if message.len() > named + 4 => Ok(()),
        _ => Err(format!("a refusal that does not name the file: {message}")),
    }
}
