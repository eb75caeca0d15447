//! `toron cell`: from the file of a section to its energies, pictures and the file for the identification.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use indicatif::ProgressDrawTarget;
use rayon::prelude::*;

use super::explicit_run::OfSection;
use super::model::Model;
use super::run::{self, Outcome};
use super::scene::{Arrangement, Load, Scene};
use super::solver::{self, Job};
use super::{arrangement, explicit_run, output, picture, report};
use toron_explicit_host::struck::command::Checkpoint;
use toron_explicit_host::struck::run::{End, Observer};
use toron_explicit_host::struck::sample::Sample;
use toron_explicit_host::struck::{self, checkpoint};
use toron_shared::console::{print, print_note};
use toron_shared::error::Error;
use toron_shared::folder;
use toron_shared::interrupt::Interrupt;
use toron_shared::kept_file;
use toron_shared::progress;
use toron_shared::run_directory::{RunDirectory, Writes, file_error};
use toron_shared::shell;

/// The file for the identification.
const FIT: &str = "fit.toml";
/// Ticks of the progress bar for each load.
const TICKS: f64 = 1000.0;
/// Lines for each load where there is no terminal for the bar.
const LINES: f64 = 10.0;

/// Runs the loads of a section and writes what came of them to the directory `output`; returns the path of the file
/// that the identification reads.
///
/// A load that does not get to its end keeps its increments, and no other from having its own; there is no file for the
/// identification then. With `restart`, loads in the explicit host go on from their checkpoints.
///
/// # Errors
/// The input, no CalculiX, a file that cannot be written, or the loads that did not get to their end.
pub fn run(path: &Path, output: &Path, ccx: Option<&Path>, restart: bool) -> Result<PathBuf, Error> {
    let scene = Scene::read(path)?;
    if restart && !scene.explicit {
        let message = "--restart with CalculiX, which has no checkpoints; allowed: with host = \"explicit\"";
        return Err(Error::Input(message.to_string()));
    }
    let model = arrangement::model(&scene.arrangement, scene.elements)
        .map_err(|message| Error::Input(format!("{}: {message}", path.display())))?;
    let program = if scene.explicit { None } else { Some(solver::find(ccx)?) };
    folder::check(output)?;
    let folder = |path: &Path| std::fs::canonicalize(path).ok();
    if folder(output).is_some()
        && folder(output) == folder(path).as_deref().and_then(Path::parent).map(Path::to_path_buf)
    {
        let message =
            "output is the folder of the scene, whose files could be overwritten; allowed: another one, -o DIR";
        return Err(Error::Input(message.to_string()));
    }
    if restart {
        check_checkpoints(&scene, &model, output)?;
    }
    let own = ["fit", "parameters"].into_iter().chain(scene.loads.iter().map(|load| load.name()));
    let names = own.map(String::from).collect();
    let writes = Writes { command: "cell", files: vec![path], names, restart, hands_over: FIT };
    let _directory = RunDirectory::lock(output, writes)?.claim()?;
    let fit = output.join(FIT);
    // One of an earlier run would stand beside other tables.
    kept_file::set_aside_if_there(&fit)?;
    let interrupt = scene.explicit.then(Interrupt::listen).transpose()?;
    let run = Run { program: program.as_deref(), scene: &scene, model: &model, output, restart, interrupt };
    let runs = run.loads();
    let (mut outcomes, mut failures) = (Vec::new(), Vec::new());
    for run in runs {
        match run {
            Ok(outcome) => outcomes.push(outcome),
            Err(error) => failures.push(error),
        }
    }
    failures.extend(outcomes.iter().filter_map(|outcome| outcome.failure.clone().map(Error::Evaluation)));
    if !outcomes.is_empty() {
        print(&report::report(&scene, &model, &outcomes, output));
    }
    if run.is_interrupted() {
        failures
            .push(Error::Evaluation(format!("the run goes on with\n  {}", shell::again("cell", path, output, &[]))));
    }
    if let Some(first) = failures.first() {
        let text = failures.iter().map(Error::to_string).collect::<Vec<_>>().join("\n");
        return Err(if matches!(first, Error::Input(_)) { Error::Input(text) } else { Error::Evaluation(text) });
    }
    let text = output::fit_file(&scene, &model, &outcomes);
    kept_file::write(&fit, |file| file.write_all(text.as_bytes()))?;
    Ok(fit)
}

/// That a restart can go on from the checkpoints that are there.
fn check_checkpoints(scene: &Scene, model: &Model, output: &Path) -> Result<(), Error> {
    for &load in &scene.loads {
        if let Some(bytes) = Checkpoint::of(load.name(), output).read()? {
            checkpoint::check(&explicit_run::Section::new(scene, model, load), &bytes)?;
        }
    }
    Ok(())
}

/// What the loads have in common.
struct Run<'a> {
    program: Option<&'a Path>,
    scene: &'a Scene,
    model: &'a Model,
    output: &'a Path,
    restart: bool,
    /// Whether somebody has asked the program to end; where it cannot go on, it ends at once.
    interrupt: Option<Interrupt>,
}

impl Run<'_> {
    fn is_interrupted(&self) -> bool {
        self.interrupt.as_ref().is_some_and(Interrupt::is_asked)
    }

    /// The loads side by side where that is faster: CalculiX spends most of a small cell's time on what no second
    /// thread shortens.
    fn loads(&self) -> Vec<Result<Outcome, Error>> {
        let scene = self.scene;
        let length = (TICKS * scene.loads.len() as f64) as u64;
        let bar = progress::bar(length, "{wide_bar} {percent} %, {eta} left", ProgressDrawTarget::stderr());
        let done = Mutex::new(vec![0.0; scene.loads.len()]);
        let start = Instant::now();
        let one = |(number, &load): (usize, &Load)| {
            let mut lines: u32 = 0;
            let mut progress = |part: f64| {
                // Where there is no terminal for the bar, there are lines. A load that is taken again begins anew.
                lines = lines.min((part * LINES) as u32);
                if bar.is_hidden() && part >= f64::from(lines + 1) / LINES {
                    lines = (part * LINES) as u32;
                    let seconds = start.elapsed().as_secs();
                    print_note(&format!("{}: {:.0} % of the load, {seconds} s\n", load.name(), 100.0 * part));
                }
                if let Ok(mut done) = done.lock() {
                    done[number] = part;
                    bar.set_position((TICKS * done.iter().sum::<f64>()) as u64);
                }
            };
            self.load(load, &mut progress)
        };
        let runs = match scene.arrangement {
            // A box of CalculiX takes the memory and the threads of the machine for itself.
            Arrangement::Box(_) if !scene.explicit => scene.loads.iter().enumerate().map(one).collect(),
            _ => scene.loads.par_iter().enumerate().map(one).collect(),
        };
        bar.finish_and_clear();
        runs
    }

    /// Runs a load and writes its files.
    fn load(&self, load: Load, progress: &mut (dyn FnMut(f64) + Send)) -> Result<Outcome, Error> {
        let Run { program, scene, model, output, .. } = *self;
        let file = |ending: &str| output.join(format!("{}.{ending}", load.name()));
        let outcome = match program {
            None => self.explicit_load(load, progress)?,
            Some(program) => {
                let threads = match scene.arrangement {
                    Arrangement::Cell(_) => 1,
                    Arrangement::Box(_) => std::thread::available_parallelism().map_or(1, usize::from),
                };
                let job = Job { program, output, name: load.name(), threads };
                run::run(&job, run::task(scene, model, load), progress)?
            }
        };
        output::write(&file("csv"), &output::table(scene, &outcome))?;
        picture::write(&file("svg"), &file("png"), scene, model, &outcome)?;
        Ok(outcome)
    }

    /// Runs a load in the explicit host, from its checkpoint on if it has one and goes on at all. One that has come to
    /// its end leaves its outcome, so that a restart of others takes it as it is.
    fn explicit_load(&self, load: Load, progress: &mut (dyn FnMut(f64) + Send)) -> Result<Outcome, Error> {
        let place = Checkpoint::of(load.name(), self.output);
        let found = place.read()?;
        if let (false, Some(_)) = (self.restart, &found) {
            std::fs::remove_file(&place.place).map_err(|error| file_error(&place.place, &error))?;
        }
        let section = explicit_run::Section::new(self.scene, self.model, load);
        let mut observer = LoadObserver { checkpoint: &place, interrupt: self.interrupt.as_ref(), progress };
        let mut outcome = struck::run::run(&section, found.as_deref().filter(|_| self.restart), &mut observer)?;
        if outcome.end != End::Interrupted {
            place.write(&checkpoint::of_outcome(&section, &mut outcome)?)?;
        }
        section.outcome(outcome)
    }
}

/// Tells how far a load is, and keeps its checkpoints.
struct LoadObserver<'a> {
    checkpoint: &'a Checkpoint,
    interrupt: Option<&'a Interrupt>,
    progress: &'a mut (dyn FnMut(f64) + Send),
}

impl Observer<OfSection> for LoadObserver<'_> {
    fn progress(&mut self, fraction: f64, _: &Sample<OfSection>, _: f64) {
        (self.progress)(fraction);
    }

    fn checkpoint(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.checkpoint.write(bytes)
    }

    fn interrupts(&self) -> bool {
        self.interrupt.is_some_and(Interrupt::is_asked)
    }
}
