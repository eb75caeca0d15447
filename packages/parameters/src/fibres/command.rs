//! `toron fibres`: from the file of a scene to what LAMMPS reads, to its runs, and to what they have come to.

use std::io::Write;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressDrawTarget};

use super::beside::Beside;
use super::lammps::Lammps;
use super::model::Model;
use super::outcome::Outcome;
use super::pressed::outcome::Pressed;
use super::reader::COMMON;
use super::run::Folder;
use super::scene::{Case, Scene};
use super::{picture, plot, pressed, report, summary};
use toron_shared::console::{print, print_error, print_note};
use toron_shared::error::Error;
use toron_shared::file_names::{FIBRES, STRAIN, STRAINS};
use toron_shared::kept_file;
use toron_shared::progress::{self, Lines};
use toron_shared::run_directory::{RunDirectory, Writes};
use toron_strikes::impact::summary::write_strains;

const SUMMARY: &str = "summary.csv";
/// The same of sections that are pressed.
const PRESSED: &str = "pressed.csv";
/// Biaxial tests over the friction between their fibres.
const FRICTION: [&str; 2] = ["pressed.svg", "pressed.png"];
/// The file for the identification.
const FIT: &str = "fit.toml";
/// Ticks of the progress bar for each case.
const TICKS: f64 = 1000.0;

/// How the cases are run.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene, a TOML file (`toron init fibres` writes one); - is the standard input.
    scene: PathBuf,
    /// Where the files go.
    #[arg(short, long, default_value = "toron-out/fibres")]
    pub output: PathBuf,
    /// Write what LAMMPS reads, and do not run it.
    #[arg(long)]
    write_only: bool,
    /// Begin cases anew that an earlier run has left files of with another scene: those are removed.
    #[arg(long)]
    anew: bool,
    /// Processes of LAMMPS.
    #[arg(long, default_value = "1", value_parser = clap::value_parser!(u16).range(1..))]
    ranks: u16,
    /// The program lmp of LAMMPS; without it, that of the variable TORON_LMP, or the one in PATH.
    #[arg(long)]
    lmp: Option<PathBuf>,
}

/// Runs the cases of a scene and writes what came of them.
///
/// A case that has no result keeps no other from having one. Returns the path of the file that the identification
/// reads, if sections were pressed that tell its parameters.
///
/// # Errors
/// The input, no LAMMPS, a file that cannot be written, or the cases that have no result.
pub fn run(arguments: &Arguments) -> Result<Option<PathBuf>, Error> {
    let scene = Scene::read(&arguments.scene)?;
    let models: Result<Vec<Model>, Error> = scene.cases.iter().map(|case| Model::new(&scene.units, case)).collect();
    let models = models?;
    // One that cannot be read is said before hours of computation.
    scene
        .cases
        .iter()
        .filter_map(|case| case.law.as_deref())
        .try_for_each(|file| Beside::read(file, &scene.units).map(drop))?;
    let output = &arguments.output;
    let names = COMMON.into_iter().chain(scene.cases.iter().map(|case| case.name.as_str())).map(String::from).collect();
    let files = vec![arguments.scene.as_path()];
    let writes = Writes { command: "fibres", files, names, hands_over: FIT, ..Writes::default() };
    let folders: Vec<Folder> =
        scene.cases.iter().zip(&models).map(|(case, model)| Folder::new(output.join(&case.name), model)).collect();
    // Those that are there already need no LAMMPS. Where it is missing, nothing is removed.
    let there = folders.iter().all(|folder| folder.is_written() && folder.is_done());
    let lammps = if there || arguments.write_only { None } else { Some(Lammps::find(arguments.lmp.as_deref())?) };
    let locked = RunDirectory::lock(output, writes)?;
    if !arguments.anew {
        check_scene(&scene, &folders, output)?;
    }
    let directory = locked.claim()?;
    let mut gone = 0;
    for folder in &folders {
        gone += folder.write()?;
    }
    print_error(&directory.removal(gone));
    if arguments.write_only {
        print(&written(&scene, output));
        return Ok(None);
    }
    directory.remove(SUMMARY)?;
    [PRESSED].into_iter().chain(FRICTION).try_for_each(|name| directory.remove(name).map(drop))?;
    let fit = output.join(FIT);
    kept_file::set_aside_if_there(&fit)?;
    for case in &scene.cases {
        directory.remove_files_of(&case.name, 0)?;
    }
    let Results { outcomes: results, pressed, errors } = run_cases(
        &scene,
        &models,
        &folders,
        |folder, progress| match &lammps {
            Some(lammps) if !folder.is_done() => Ok(Some(folder.run(lammps, arguments.ranks.into(), progress)?)),
            _ => Ok(None),
        },
        output,
    );
    if !results.is_empty() {
        summary::write(&output.join(SUMMARY), &scene, &results)?;
    }
    if !pressed.is_empty() {
        pressed::summary::write(&output.join(PRESSED), &scene, &pressed)?;
        let [svg, png] = FRICTION.map(|name| output.join(name));
        pressed::friction_plot::write(&svg, &png, &scene, &pressed)?;
    }
    if !(results.is_empty() && pressed.is_empty()) {
        print(&report::report(&scene, &results, &pressed, output));
    }
    combine(&errors)?;
    let Some(text) = pressed::output::fit_file(&scene, &pressed) else { return Ok(None) };
    kept_file::write(&fit, |file| file.write_all(text.as_bytes()))?;
    Ok(Some(fit))
}

/// What came of the cases: of those that are struck, of those that are pressed, and of those without a result.
#[derive(Default)]
struct Results<'a> {
    outcomes: Vec<(&'a Case, Outcome)>,
    pressed: Vec<(&'a Case, Pressed)>,
    errors: Vec<(&'a Case, Error)>,
}

/// Runs the cases, by a function that returns the seconds that a run took, or none where its results are there already;
/// and writes the files of each.
fn run_cases<'a>(
    scene: &'a Scene,
    models: &[Model],
    folders: &[Folder],
    compute: impl Fn(&Folder, &mut dyn FnMut(f64)) -> Result<Option<f64>, Error>,
    output: &Path,
) -> Results<'a> {
    let bar = progress::bar(
        TICKS as u64 * scene.cases.len() as u64,
        "{wide_bar} {percent} %, {eta} left",
        ProgressDrawTarget::stderr(),
    );
    let mut results = Results::default();
    for (number, ((case, model), folder)) in scene.cases.iter().zip(models).zip(folders).enumerate() {
        let mut observer = Observer { bar: &bar, number, case, lines: Lines::from(0.0) };
        let mut run = || -> Result<(), Error> {
            let seconds = compute(folder, &mut |part| observer.progress(part))?;
            let raw = folder.read(seconds)?;
            if let Some(result) = Pressed::new(&scene.units, model.clone(), &raw) {
                write_pressed(scene, case, &result, output)?;
                results.pressed.push((case, result));
            } else {
                let result = Outcome::new(&scene.units, case, model.clone(), raw);
                write_case(scene, case, &result, output)?;
                results.outcomes.push((case, result));
            }
            Ok(())
        };
        if let Err(error) = run() {
            results.errors.push((case, error));
        }
    }
    bar.finish_and_clear();
    results
}

/// That no case has results of another scene, or of an input that was changed by hand, which would go.
fn check_scene(scene: &Scene, folders: &[Folder], output: &Path) -> Result<(), Error> {
    for (case, folder) in scene.cases.iter().zip(folders) {
        if folder.is_of_another()? {
            let (name, place) = (&case.name, output.join(&case.name));
            return Err(Error::Input(format!(
                "what an earlier run of case {name} has left in {} is of another scene; allowed: the scene as it was, \
                 --anew, or another directory",
                place.display()
            )));
        }
    }
    Ok(())
}

/// What there is to run by hand, and how.
fn written(scene: &Scene, output: &Path) -> String {
    let folders: Vec<String> =
        scene.cases.iter().map(|case| format!("  {}\n", output.join(&case.name).display())).collect();
    format!(
        "What LAMMPS reads is in\n{}Run it in each of them, for instance: mpirun -n 64 lmp -in in.lmp, and to go on from a restart \
         file, lmp -in in.lmp -var restart restart-1.lmp. Then give this command again without --write-only: it reads what is there.\n",
        folders.concat()
    )
}

/// The errors of the cases that have no result as one.
fn combine(errors: &[(&Case, Error)]) -> Result<(), Error> {
    let messages: Vec<String> = errors.iter().map(|(case, error)| format!("case {}: {error}", case.name)).collect();
    match errors.first() {
        None => Ok(()),
        Some((_, Error::Input(_))) => Err(Error::Input(messages.join("\n"))),
        Some((_, Error::Evaluation(_))) => Err(Error::Evaluation(messages.join("\n"))),
    }
}

/// Moves the bar; where there is none, writes lines.
struct Observer<'a> {
    bar: &'a ProgressBar,
    number: usize,
    case: &'a Case,
    lines: Lines,
}

impl Observer<'_> {
    fn progress(&mut self, part: f64) {
        self.bar.set_position((TICKS * (self.number as f64 + part)) as u64);
        if self.bar.is_hidden() && self.lines.are_due(part) {
            print_note(&format!("{}: {:.0} %\n", self.case.name, 100.0 * part));
        }
    }
}

fn write_pressed(scene: &Scene, case: &Case, result: &Pressed, output: &Path) -> Result<(), Error> {
    let file = |ending: &str| output.join(format!("{}{ending}", case.name));
    pressed::output::write_history(&file(".csv"), scene, result)?;
    pressed::plot::write(&file(".svg"), &file(".png"), scene, case, result)?;
    for (number, frame) in (1..).zip(&result.frames) {
        let [svg, png] = ["svg", "png"].map(|ending| file(&format!("{FIBRES}{number}.{ending}")));
        pressed::picture::write(&svg, &png, scene, case, result, frame)?;
    }
    Ok(())
}

fn write_case(scene: &Scene, case: &Case, result: &Outcome, output: &Path) -> Result<(), Error> {
    let file = |ending: &str| output.join(format!("{}{ending}", case.name));
    summary::write_history(&file(".csv"), &scene.units, result)?;
    let law = case.law.as_deref().map(|file| Beside::read(file, &scene.units)).transpose()?;
    plot::write_history(&file(".svg"), &file(".png"), scene, case, result, law.as_ref())?;
    for (number, frame) in (1..).zip(&result.frames) {
        let [svg, png] = ["svg", "png"].map(|ending| file(&format!("{FIBRES}{number}.{ending}")));
        picture::write(&svg, &png, scene, case, result, frame)?;
        write_strains(&file(&format!("{STRAINS}{number}.csv")), result.strains(&scene.units, frame))?;
    }
    let [svg, png] = ["svg", "png"].map(|ending| file(&format!("{STRAIN}.{ending}")));
    plot::write_strains(&svg, &png, scene, case, result)?;
    Ok(())
}
