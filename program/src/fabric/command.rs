//! `toron fabric`: from the file of a scene to its histories and table.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressDrawTarget};

use super::judgement::before;
use super::measure::Sample;
use super::run::{self, End, Observer, Outcome};
use super::scene::{Case, Scene};
use super::summary::{self, Figures};
use super::{model, output, panel_picture, plot, report};
use crate::common::console::{print, print_error};
use crate::common::error::Error;
use crate::common::folder;
use crate::common::interrupt::Interrupt;
use crate::common::progress::{self, Lines};
use crate::common::run_directory::{RunDirectory, file_error, is_file};
use crate::common::units::{SPEED, TIME, number, unit};
use crate::common::vtk::Frames;
use crate::explicit::judgement::warnings;
use crate::weave::model::Model;
use toron::host::units::UnitSystem;

const TICKS: u64 = 1000;
const SUMMARY: &str = "summary.csv";
/// Between a case's name and the number of a picture.
const PICTURES: &str = "-panel-";

/// Runs the cases of a scene, one after another, and writes what came of them to the directory `output`. With `restart`, cases
/// go on from their checkpoints there.
///
/// # Errors
/// The input, a file that cannot be written, a case that has no result, or somebody has asked the program to end.
pub fn run(path: &Path, output: &Path, restart: bool) -> Result<(), Error> {
    let build = run::build();
    let scene = Scene::read(path)?;
    if restart || scene.cases.iter().any(|case| case.checkpoints > 0) {
        build?;
    }
    folder::check(output)?;
    // Before hours are spent on the first one.
    let mut found = false;
    for case in &scene.cases {
        model::check(case)?;
        for file in Checkpoint::of(case, output).files() {
            is_file(file)?;
        }
        if let Some(bytes) = if restart { Checkpoint::of(case, output).read()? } else { None } {
            run::check(case, &bytes)?;
            found = true;
        }
    }
    if restart && !found {
        let allowed = "allowed: the directory of the run that was stopped";
        return Err(Error::Input(format!("no case has a checkpoint in {}; {allowed}", output.display())));
    }
    let directory = RunDirectory::open(output)?;
    print_error(&clear(&scene, output, &directory, restart)?);
    let interrupt = Interrupt::listen()?;
    print_error("Ctrl-C ends the run with a checkpoint, from which --restart goes on\n");
    let (mut results, mut failures) = (Vec::new(), Vec::new());
    for case in &scene.cases {
        let panel = case.woven.model();
        let mut outcome = run_case(&scene, case, &panel, output, &directory, restart, &interrupt)?;
        write_case(&scene, case, &panel, &outcome, output)?;
        // Who goes on after an interruption of a later case finds that this one has ended.
        if case.checkpoints == 0 && outcome.end != End::Interrupted && run::build().is_ok() {
            Checkpoint::of(case, output).write(&run::checkpoint_of_end(case, &mut outcome)?)?;
        }
        failures.extend(outcome.failure.take().map(|error| error.to_string()));
        let interrupted = outcome.end == End::Interrupted;
        let figures = Figures::of(&scene.units, case, &panel, &outcome);
        if interrupted {
            let (time, scene, output) = (number(figures.last.time), path.display(), output.display());
            let again = format!("toron fabric {scene} -o {output} --restart");
            failures.push(format!("case {} was interrupted after time {time}; it goes on with\n  {again}", case.name));
        }
        results.push((case, outcome, figures));
        // After each, for who stops the program in a later one.
        summary::write(&output.join(SUMMARY), &results)?;
        if interrupted {
            break;
        }
    }
    print(&report::report(&scene, &results, output));
    if failures.is_empty() { Ok(()) } else { Err(Error::Evaluation(failures.join("\n"))) }
}

/// Removes what an earlier run has left of the cases that begin, before the first of them does; returns what there is to say of it.
/// Their checkpoints get another name: who has forgotten `--restart` has them still.
fn clear(scene: &Scene, output: &Path, directory: &RunDirectory, restart: bool) -> Result<String, Error> {
    // A restart writes it again.
    let mut removed = usize::from(directory.remove(SUMMARY)? && !restart);
    let mut said = String::new();
    for case in &scene.cases {
        let checkpoint = Checkpoint::of(case, output);
        let found = checkpoint.read()?;
        if restart && found.is_some() {
            continue;
        }
        removed += directory.remove_files_of(&case.name, PICTURES, 0)?;
        let Some(bytes) = found else { continue };
        // One of a case that has ended is nothing without the files that go.
        if run::check(case, &bytes).is_ok_and(|(head, _)| head.ended.is_some()) {
            std::fs::remove_file(&checkpoint.place).map_err(|error| file_error(&checkpoint.place, &error))?;
            removed += 1;
        } else {
            let old = checkpoint.set_aside()?;
            said += &format!("the checkpoint of an earlier run of case {} is now {}\n", case.name, old.display());
        }
    }
    Ok(directory.removal(removed) + &said)
}

/// Runs a case, from its checkpoint on if it has one and goes on at all.
fn run_case(
    scene: &Scene,
    case: &Case,
    panel: &Model,
    output: &Path,
    directory: &RunDirectory,
    restart: bool,
    interrupt: &Interrupt,
) -> Result<Outcome, Error> {
    let checkpoint = Checkpoint::of(case, output);
    let bytes = if restart { checkpoint.read()? } else { None };
    let history = output.join(format!("{}.csv", case.name));
    let grows = format!("{} elements, its history grows in {}", panel.elements.len(), history.display());
    let head = bytes.as_deref().map(|bytes| run::check(case, bytes)).transpose()?;
    let how = match head {
        None if restart => format!("has no checkpoint, from the beginning; {grows}"),
        None => grows,
        Some((head, _)) if head.ended.is_some() => "has ended, its files stay".to_string(),
        Some(_) => format!("goes on from its checkpoint; {grows}"),
    };
    print_error(&format!("case {}: {how}\n", case.name));
    print_error(&warnings([(case.name.as_str(), &before(&scene.units, case, panel)[..])]));
    let bar = progress::bar(TICKS, "{msg} {wide_bar} {percent} %, {eta} left", ProgressDrawTarget::stderr());
    let mut observer = CaseObserver {
        name: &case.name,
        units: &scene.units,
        directory,
        bar: &bar,
        lines: Lines::from(0.0),
        history: History { place: history, file: None },
        frames: Frames::new(output, &case.name),
        checkpoint,
        interrupt,
    };
    if bytes.is_none() {
        observer.history.begin(&[])?;
    }
    let result = run::run(case, panel, bytes.as_deref(), &mut observer);
    bar.finish_and_clear();
    result
}

/// Where a case's checkpoint stands, and where the next one is written before it takes its place.
struct Checkpoint {
    place: PathBuf,
    new: PathBuf,
}

impl Checkpoint {
    fn of(case: &Case, output: &Path) -> Checkpoint {
        let [place, new] =
            ["checkpoint", "checkpoint-new"].map(|ending| output.join(format!("{}.{ending}", case.name)));
        Checkpoint { place, new }
    }

    /// Gives it another name; returns that.
    fn set_aside(&self) -> Result<PathBuf, Error> {
        let old = self.place.with_extension("checkpoint-old");
        std::fs::rename(&self.place, &old).map_err(|error| file_error(&old, &error))?;
        Ok(old)
    }

    fn files(&self) -> [&Path; 2] {
        [&self.place, &self.new]
    }

    /// Its bytes, if there is one.
    fn read(&self) -> Result<Option<Vec<u8>>, Error> {
        if !is_file(&self.place)? {
            return Ok(None);
        }
        std::fs::read(&self.place).map(Some).map_err(|error| file_error(&self.place, &error))
    }

    /// In one go: who stops the program while it writes has the last checkpoint still.
    fn write(&self, bytes: &[u8]) -> Result<(), Error> {
        let written = std::fs::write(&self.new, bytes).and_then(|()| std::fs::rename(&self.new, &self.place));
        written.map_err(|error| file_error(&self.place, &error))
    }
}

fn write_case(scene: &Scene, case: &Case, panel: &Model, outcome: &Outcome, output: &Path) -> Result<(), Error> {
    let file = |ending: &str| output.join(format!("{}{ending}", case.name));
    plot::write(&file(".svg"), &file(".png"), scene, case, outcome)?;
    for (number, snapshot) in outcome.snapshots.iter().enumerate() {
        let [svg, png] = ["svg", "png"].map(|ending| file(&format!("{PICTURES}{}.{ending}", number + 1)));
        panel_picture::write(&svg, &png, scene, case, panel, snapshot)?;
    }
    Ok(())
}

/// The history's file, which grows by a line with each sample.
struct History {
    place: PathBuf,
    file: Option<File>,
}

impl History {
    /// Begins it with these samples.
    fn begin(&mut self, samples: &[Sample]) -> Result<(), Error> {
        let file = File::create(&self.place).map_err(|error| file_error(&self.place, &error))?;
        self.file = Some(file);
        let lines: String = samples.iter().map(output::line).collect();
        self.add(&(output::titles() + &lines))
    }

    /// The file has no buffer: what is added is there for who looks, and when the program is killed.
    fn add(&mut self, text: &str) -> Result<(), Error> {
        let Some(file) = &mut self.file else { return Ok(()) };
        file.write_all(text.as_bytes()).map_err(|error| file_error(&self.place, &error))
    }
}

/// Moves the bar, and writes the history, ParaView's files and the checkpoints as they come.
struct CaseObserver<'a> {
    name: &'a str,
    units: &'a UnitSystem,
    directory: &'a RunDirectory,
    bar: &'a ProgressBar,
    /// Where there is no terminal for a bar.
    lines: Lines,
    history: History,
    frames: Frames,
    checkpoint: Checkpoint,
    interrupt: &'a Interrupt,
}

impl Observer for CaseObserver<'_> {
    fn progress(&mut self, fraction: f64, sample: &Sample, imbalance: f64) {
        let (name, speed) = (self.name, number(sample.speed));
        self.bar.set_position((fraction * TICKS as f64) as u64);
        self.bar.set_message(format!("{name}: speed {speed}, energy off by {imbalance:.0e}"));
        if self.bar.is_hidden() && self.lines.are_due(fraction) {
            let (percent, time) = (100.0 * fraction, number(sample.time));
            let [of_time, of_speed] = [TIME, SPEED].map(|dimension| unit(self.units, dimension));
            let speed = format!("speed {speed} {of_speed}, energy off by {imbalance:.0e}");
            print_error(&format!("case {name}: {percent:.0} %, time {time} {of_time}, {speed}\n"));
        }
    }

    fn sample(&mut self, sample: &Sample) -> Result<(), Error> {
        self.history.add(&output::line(sample))
    }

    fn frame(&mut self, time: f64, text: &str) -> Result<(), Error> {
        self.frames.write(time, text)
    }

    fn checkpoint(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.checkpoint.write(bytes)
    }

    fn resumed(&mut self, fraction: f64, samples: &[Sample], frames: &[f64]) -> Result<(), Error> {
        self.lines = Lines::from(fraction);
        // What the run has written after the checkpoint.
        self.directory.remove_files_of(self.name, PICTURES, frames.len())?;
        self.history.begin(samples)?;
        self.frames.resume(frames)
    }

    fn interrupts(&self) -> bool {
        self.interrupt.is_asked()
    }
}
