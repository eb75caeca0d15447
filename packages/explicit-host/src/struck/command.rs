//! The command that runs the cases of a scene: it writes what comes of them as it comes, and goes on from checkpoints.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use indicatif::{ProgressBar, ProgressDrawTarget};
use rayon::prelude::*;

use super::checkpoint;
use super::history::{self, Column};
use super::pace::Estimate;
use super::run::{self, End, Observer, Outcome, Struck};
use super::sample::Sample;
use super::summary::Cells;
use crate::judgement::{Finding, warnings};
use crate::vtk::Frames;
use toron::host::units::UnitSystem;
use toron_materials::units::{SPEED, TIME, unit};
use toron_shared::console::{print, print_error, print_note};
use toron_shared::error::Error;
use toron_shared::folder;
use toron_shared::interrupt::Interrupt;
use toron_shared::kept_file;
use toron_shared::numbers::{number, one_digit};
use toron_shared::progress::{self, Lines};
use toron_shared::run_directory::{RunDirectory, Writes, file_error, is_file};
use toron_shared::shell;
use toron_shared::text_table::write_csv;

/// Ticks of the progress bar for each case.
const TICKS: u64 = 1000;
pub const SUMMARY: &str = "summary.csv";

/// The cases of a file that are run by a command of their own.
pub trait Scene: Sync {
    /// What the command is called.
    const COMMAND: &'static str;
    /// The files besides the summary that cases have in common.
    const COMMON: &'static [&'static str] = &[];
    /// Whether cases are run side by side, since one by itself keeps no more than one processor busy.
    const PARALLEL: bool;

    /// As of [`Struck`].
    type Own: Copy + Default + Send + Sync + 'static;
    type Course;
    type Struck<'a>: Struck<Own = Self::Own, Course = Self::Course>
    where
        Self: 'a;
    /// What is kept of a case for the report.
    type Result<'a>: Send
    where
        Self: 'a;

    fn units(&self) -> &UnitSystem;

    /// How many cases there are.
    fn cases(&self) -> usize;

    /// A case, ready to be run.
    ///
    /// # Errors
    /// It cannot be run.
    fn case(&self, number: usize) -> Result<Self::Struck<'_>, Error>;

    /// Columns of the history that other scenes do not have.
    fn columns() -> Vec<Column<Self::Own>>;

    /// What is wrong before the first step.
    fn before(&self, case: &Self::Struck<'_>) -> Vec<Finding>;

    /// Writes the plots and pictures of a case.
    ///
    /// # Errors
    /// A file cannot be written.
    fn finish<'a>(
        &'a self,
        case: Self::Struck<'a>,
        outcome: Outcome<Self::Own, Self::Course>,
        output: &Path,
    ) -> Result<Self::Result<'a>, Error>;

    /// A line of the summary.
    fn line(&self, result: &Self::Result<'_>) -> Cells;

    /// Writes what the cases have in common besides the summary, and returns the report.
    ///
    /// # Errors
    /// A file cannot be written.
    fn report(&self, results: &[Self::Result<'_>], output: &Path) -> Result<String, Error>;
}

/// Runs the cases of a scene, which was read from `path`, and writes what came of them to the directory `output`. With
/// `restart`, cases go on from their checkpoints there.
///
/// A case that has no result keeps no other from having one.
///
/// # Errors
/// The input, a file that cannot be written, cases that have no result, or somebody has asked the program to end.
pub fn run<S: Scene>(scene: &S, path: &Path, output: &Path, restart: bool) -> Result<(), Error> {
    folder::check(output)?;
    // Before hours are spent on the first one.
    let mut found = false;
    let mut names = Vec::new();
    for number in 0..scene.cases() {
        let case = scene.case(number)?;
        let checkpoint = Checkpoint::of(case.name(), output);
        for file in checkpoint.files() {
            is_file(file)?;
        }
        if let Some(bytes) = if restart { checkpoint.read()? } else { None } {
            checkpoint::check(&case, &bytes)?;
            found = true;
        }
        names.push(case.name().to_string());
    }
    if restart && !found {
        let allowed = "allowed: the directory of the run that was stopped";
        return Err(Error::Input(format!("no case has a checkpoint in {}; {allowed}", output.display())));
    }
    let stem = |name: &&str| name.rsplit_once('.').map_or(*name, |(stem, _)| stem).to_string();
    let common = [SUMMARY].iter().chain(S::COMMON).map(stem);
    let files = names.iter().cloned().chain(common).collect();
    let writes = Writes { command: S::COMMAND, files: vec![path], names: files, restart, ..Writes::default() };
    let directory = RunDirectory::lock(output, writes)?.claim()?;
    print_error(&clear(scene, &names, output, &directory, restart)?);
    let interrupt = Interrupt::listen()?;
    print_note("Ctrl-C ends the run with a checkpoint, from which --restart goes on\n");
    let bar = progress::bar(
        TICKS * names.len() as u64,
        "{msg} {wide_bar} {percent} %, {eta} left",
        ProgressDrawTarget::stderr(),
    );
    let columns = history::columns(S::columns());
    let cases =
        Cases { scene, output, directory: &directory, restart, interrupt: &interrupt, bar: &bar, columns: &columns };
    let results: Mutex<Vec<Option<S::Result<'_>>>> = Mutex::new(names.iter().map(|_| None).collect());
    let run = |number: usize| cases.run(number, &results);
    let ends: Vec<Result<Option<String>, Error>> = if S::PARALLEL {
        (0..names.len()).into_par_iter().map(run).collect()
    } else {
        (0..names.len()).map(run).collect()
    };
    bar.finish_and_clear();
    let results: Vec<S::Result<'_>> = results.into_inner().unwrap_or_default().into_iter().flatten().collect();
    if !results.is_empty() {
        print(&scene.report(&results, output)?);
    }
    let mut errors: Vec<Error> = Vec::new();
    for end in ends {
        match end {
            Ok(failure) => errors.extend(failure.map(Error::Evaluation)),
            Err(error) => errors.push(error),
        }
    }
    if interrupt.is_asked() && !errors.is_empty() {
        let again = shell::again(S::COMMAND, path, output, &[]);
        errors.push(Error::Evaluation(format!("the run goes on with\n  {again}")));
    }
    combine(&errors)
}

/// Errors as one.
fn combine(errors: &[Error]) -> Result<(), Error> {
    let messages: Vec<String> = errors.iter().map(Error::to_string).collect();
    match errors.first() {
        None => Ok(()),
        Some(Error::Input(_)) => Err(Error::Input(messages.join("\n"))),
        Some(Error::Evaluation(_)) => Err(Error::Evaluation(messages.join("\n"))),
    }
}

/// Removes what an earlier run has left of the cases that begin, before the first of them does; returns what there is
/// to say of it. Their checkpoints get another name: who has forgotten `--restart` has them still.
fn clear<S: Scene>(
    scene: &S,
    names: &[String],
    output: &Path,
    directory: &RunDirectory,
    restart: bool,
) -> Result<String, Error> {
    let mut removed = 0;
    for name in [SUMMARY].iter().chain(S::COMMON) {
        // A restart writes it again.
        removed += usize::from(directory.remove(name)? && !restart);
    }
    let mut said = String::new();
    for (number, name) in names.iter().enumerate() {
        let checkpoint = Checkpoint::of(name, output);
        let found = checkpoint.read()?;
        if restart && found.is_some() {
            continue;
        }
        removed += directory.remove_files_of(name, 0)?;
        let Some(bytes) = found else { continue };
        // One of a case that has ended is nothing without the files that go.
        if checkpoint::check(&scene.case(number)?, &bytes).is_ok_and(|(head, _)| head.ended.is_some()) {
            std::fs::remove_file(&checkpoint.place).map_err(|error| file_error(&checkpoint.place, &error))?;
            removed += 1;
        } else {
            let old = kept_file::set_aside(&checkpoint.place)?;
            said += &format!("the checkpoint of an earlier run of case {name} is now {}\n", old.display());
        }
    }
    Ok(directory.removal(removed) + &said)
}

/// What the runs of all cases have in common.
struct Cases<'a, S: Scene> {
    scene: &'a S,
    output: &'a Path,
    directory: &'a RunDirectory,
    restart: bool,
    interrupt: &'a Interrupt,
    bar: &'a ProgressBar,
    columns: &'a [Column<S::Own>],
}

impl<'a, S: Scene> Cases<'a, S> {
    /// Runs a case, unless the run has been interrupted before it began; returns why it has not come to its end.
    fn run(&self, number: usize, results: &Mutex<Vec<Option<S::Result<'a>>>>) -> Result<Option<String>, Error> {
        if self.interrupt.is_asked() {
            return Ok(None);
        }
        let case = self.scene.case(number)?;
        let (name, checkpoint) = (case.name().to_string(), Checkpoint::of(case.name(), self.output));
        let mut outcome = self.strike(&case, &checkpoint)?;
        // Who goes on after an interruption of a later case finds that this one has ended.
        if case.plan().checkpoints == 0 && outcome.end != End::Interrupted {
            checkpoint.write(&checkpoint::of_outcome(&case, &mut outcome)?)?;
        }
        let time = self::number(outcome.last_time());
        let interrupted =
            (outcome.end == End::Interrupted).then(|| format!("case {name} was interrupted after time {time}"));
        let failure = outcome.failure.clone().or(interrupted);
        let result = self.scene.finish(case, outcome, self.output)?;
        if let Ok(mut results) = results.lock() {
            results[number] = Some(result);
            // After each, for who stops the program in a later one.
            let lines: Vec<Cells> = results.iter().flatten().map(|result| self.scene.line(result)).collect();
            write_csv(&self.output.join(SUMMARY), &lines)?;
        }
        Ok(failure)
    }

    /// A case from its checkpoint on, if it has one and goes on at all.
    fn strike(&self, case: &S::Struck<'a>, checkpoint: &Checkpoint) -> Result<Outcome<S::Own, S::Course>, Error> {
        let bytes = if self.restart { checkpoint.read()? } else { None };
        let history = self.output.join(format!("{}.csv", case.name()));
        let grows = format!("its history grows in {}", history.display());
        let head = bytes.as_deref().map(|bytes| checkpoint::check(case, bytes)).transpose()?;
        let how = match head {
            None if self.restart => format!("has no checkpoint, from the beginning; {grows}"),
            None => grows,
            Some((head, _)) if head.ended.is_some() => "has ended, its files stay".to_string(),
            Some(_) => format!("goes on from its checkpoint; {grows}"),
        };
        print_note(&format!("case {}: {how}\n", case.name()));
        print_error(&warnings([(case.name(), &self.scene.before(case)[..])]));
        let mut observer = CaseObserver {
            name: case.name(),
            units: self.scene.units(),
            columns: self.columns,
            directory: self.directory,
            bar: self.bar,
            ticks: 0,
            lines: Lines::from(0.0),
            history: History { place: history, file: None },
            frames: Frames::new(self.output, case.name()),
            checkpoint,
            interrupt: self.interrupt,
        };
        if bytes.is_none() {
            observer.begin(&[])?;
        }
        let outcome = run::run(case, bytes.as_deref(), &mut observer);
        // A case that ends early has not used its ticks.
        observer.tick(1.0);
        outcome
    }
}

/// Where a case's checkpoint stands, and where the next one is written before it takes its place.
pub struct Checkpoint {
    pub place: PathBuf,
    new: PathBuf,
}

impl Checkpoint {
    pub fn of(case: &str, output: &Path) -> Checkpoint {
        let [place, new] = ["checkpoint", "checkpoint-new"].map(|ending| output.join(format!("{case}.{ending}")));
        Checkpoint { place, new }
    }

    pub fn files(&self) -> [&Path; 2] {
        [&self.place, &self.new]
    }

    /// Its bytes, if there is one.
    pub fn read(&self) -> Result<Option<Vec<u8>>, Error> {
        if !is_file(&self.place)? {
            return Ok(None);
        }
        std::fs::read(&self.place).map(Some).map_err(|error| file_error(&self.place, &error))
    }

    /// In one go: who stops the program while it writes has the last checkpoint still.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Error> {
        let written = std::fs::write(&self.new, bytes).and_then(|()| std::fs::rename(&self.new, &self.place));
        written.map_err(|error| file_error(&self.place, &error))
    }
}

/// The history's file, which grows by a line with each sample.
struct History {
    place: PathBuf,
    file: Option<File>,
}

impl History {
    /// The file has no buffer: what is added is there for who looks, and when the program is killed.
    fn add(&mut self, text: &str) -> Result<(), Error> {
        let Some(file) = &mut self.file else { return Ok(()) };
        file.write_all(text.as_bytes()).map_err(|error| file_error(&self.place, &error))
    }
}

/// Moves the bar, and writes the history, ParaView's files and the checkpoints as they come.
struct CaseObserver<'a, E> {
    name: &'a str,
    units: &'a UnitSystem,
    columns: &'a [Column<E>],
    directory: &'a RunDirectory,
    bar: &'a ProgressBar,
    ticks: u64,
    /// Where there is no terminal for a bar.
    lines: Lines,
    history: History,
    frames: Frames,
    checkpoint: &'a Checkpoint,
    interrupt: &'a Interrupt,
}

impl<E> CaseObserver<'_, E> {
    /// Begins the history with these samples.
    fn begin(&mut self, samples: &[Sample<E>]) -> Result<(), Error> {
        let place = &self.history.place;
        self.history.file = Some(File::create(place).map_err(|error| file_error(place, &error))?);
        let lines: String = samples.iter().map(|sample| history::line(self.columns, sample)).collect();
        self.history.add(&(history::titles(self.columns, self.units) + &lines))
    }

    fn tick(&mut self, fraction: f64) {
        let ticks = (fraction.clamp(0.0, 1.0) * TICKS as f64) as u64;
        self.bar.inc(ticks.saturating_sub(self.ticks));
        self.ticks = ticks;
    }
}

impl<E> Observer<E> for CaseObserver<'_, E> {
    fn progress(&mut self, fraction: f64, sample: &Sample<E>, imbalance: f64) {
        let (name, speed, imbalance) = (self.name, number(sample.speed), one_digit(imbalance));
        self.tick(fraction);
        self.bar.set_message(format!("{name}: speed {speed}, energy off by {imbalance}"));
        if self.bar.is_hidden() && self.lines.are_due(fraction) {
            let (percent, time) = (100.0 * fraction, number(sample.time));
            let [of_time, of_speed] = [TIME, SPEED].map(|dimension| unit(self.units, dimension));
            let speed = format!("speed {speed} {of_speed}, energy off by {imbalance}");
            print_note(&format!("case {name}: {percent:.0} %, time {time} {of_time}, {speed}\n"));
        }
    }

    fn estimate(&mut self, estimate: &Estimate) {
        let name = self.name;
        self.bar.suspend(|| print_note(&format!("case {name}: {estimate}\n")));
    }

    fn sample(&mut self, sample: &Sample<E>) -> Result<(), Error> {
        self.history.add(&history::line(self.columns, sample))
    }

    fn frame(&mut self, time: f64, text: &str) -> Result<(), Error> {
        self.frames.write(time, text)
    }

    fn checkpoint(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.checkpoint.write(bytes)
    }

    fn resumed(&mut self, fraction: f64, samples: &[Sample<E>], frames: &[f64]) -> Result<(), Error> {
        self.lines = Lines::from(fraction);
        self.tick(fraction);
        // What the run has written after the checkpoint.
        self.directory.remove_files_of(self.name, frames.len())?;
        self.begin(samples)?;
        self.frames.resume(frames)
    }

    fn interrupts(&self) -> bool {
        self.interrupt.is_asked()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_checkpoint_takes_the_place_of_one_that_was_set_aside() {
        let folder = std::env::temp_dir().join(format!("toron-set-aside-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let checkpoint = Checkpoint::of("one", &folder);
        for (contents, name) in
            [("a", "one.checkpoint-old"), ("b", "one.checkpoint-old-2"), ("c", "one.checkpoint-old-3")]
        {
            checkpoint.write(contents.as_bytes()).expect("it is written");
            assert_eq!(kept_file::set_aside(&checkpoint.place).expect("it is set aside"), folder.join(name));
        }
        assert_eq!(std::fs::read_to_string(folder.join("one.checkpoint-old")).expect("a file"), "a");
        std::fs::remove_dir_all(&folder).expect("it is removed");
    }
}
