//! `toron v50`: from a scene with `[shots]` to the curve of perforation.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::designs::Design;
use super::link::Link;
use super::records::Records;
use super::run::{self, FiringRange};
use super::scene::Scene;
use super::series::Series;
use super::shot::Ended;
use super::simulation::{Experiment, Truth};
use super::{comparison, limit, measured, plot, report, shot};
use crate::scene_keys::shots::Shots;
use toron_explicit_host::judgement::warnings;
use toron_shared::console::{print, print_error, print_note};
use toron_shared::error::Error;
use toron_shared::interrupt::Interrupt;
use toron_shared::run_directory::{Locked, RunDirectory, Writes, is_file};
use toron_shared::shell;

/// The tables of a series' shots, and of those of a limit.
const SHOTS: &str = "shots.csv";
const LIMIT: &str = "limit.csv";
/// Where the true V50 is among the speeds of simulated experiments, and the true deviation over their range, if they
/// are not given.
const TRUTH: [f64; 2] = [0.5, 0.125];

/// What a user asks for.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene of `toron fabric` or `toron impact`, with a table `[shots]` (`toron init v50` writes one); - is the
    /// standard input. With --next, the table of shots.
    #[arg(required_unless_present_any = ["analyse", "compare_designs"])]
    scene: Option<PathBuf>,
    /// Where the tables and the picture go.
    #[arg(short, long, default_value = "toron-out/v50")]
    output: PathBuf,
    /// The case to be shot at, where the scene has several.
    #[arg(long)]
    case: Option<String>,
    /// Go on with the shots in that directory.
    #[arg(long)]
    restart: bool,
    /// Fire these shots only, as in 1-40: the task of a job array, with a design that is not sequential.
    #[arg(long, value_name = "FROM-TO", allow_hyphen_values = true, conflicts_with_all = ["collect", "limit", "simulate"])]
    shots: Option<String>,
    /// Fire none: join the shots of these directories.
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with_all = ["restart", "limit", "simulate"])]
    collect: Vec<PathBuf>,
    /// Find the limit of the scene's own shot, with its aim and its strength, by bisection, and whether the answer
    /// around it is monotone.
    #[arg(long, conflicts_with = "simulate")]
    limit: bool,
    /// Strike nothing: simulate so many experiments of each design, and print how often the intervals hold the truth.
    #[arg(long, value_name = "EXPERIMENTS")]
    simulate: Option<u64>,
    /// The true V50 and deviation of simulated experiments; the middle of the speeds and an eighth of their range if
    /// not given.
    #[arg(long, num_args = 2, value_names = ["V50", "DEVIATION"], allow_negative_numbers = true, requires = "simulate")]
    truth: Option<Vec<f64>>,
    /// Add the curves with Firth's correction, which penalises the likelihood.
    #[arg(long)]
    firth: bool,
    /// Threads: as many shots are fired side by side, or one in all of them; all processors if not given.
    #[arg(long)]
    threads: Option<usize>,
    /// Strike nothing: simulate so many experiments by each design of --next, with one and with several shots at a
    /// time, and print how far V50 is off and what its intervals are worth.
    #[arg(long, value_name = "EXPERIMENTS", conflicts_with_all = ["scene", "analyse", "next", "simulate", "limit", "shots"])]
    compare_designs: Option<u64>,
    #[command(flatten)]
    pub(in crate::v50) measured: measured::command::Measurements,
    #[command(flatten)]
    pub(in crate::v50) next: measured::next::NextShots,
}

impl Arguments {
    /// The scene, without which there is `--analyse`.
    fn scene(&self) -> &Path {
        self.scene.as_deref().unwrap_or(Path::new(""))
    }
}

/// Fires the shots of a scene and writes the results, or the other output that the arguments choose.
///
/// # Errors
/// The input, a file that cannot be written, shots without a curve, or somebody has asked the program to end.
pub fn run(arguments: &Arguments) -> Result<(), Error> {
    if let Some(table) = &arguments.measured.analyse {
        return measured::command::run(table, &arguments.measured, arguments.firth, &arguments.output);
    }
    match arguments.compare_designs {
        Some(0) => {
            return Err(Error::Input("--compare-designs is 0; allowed: 1 or more, 1000 for two digits".to_string()));
        }
        Some(experiments) => {
            print(&comparison::report(experiments));
            return Ok(());
        }
        None => {}
    }
    if arguments.next.next.is_some() {
        let Arguments { next, measured, .. } = arguments;
        return measured::next::run(arguments.scene(), next, &measured.choice()?, &measured.percentile);
    }
    let scene = Scene::read(arguments.scene(), arguments.case.as_deref())?;
    if arguments.threads == Some(0) {
        return Err(Error::Input("--threads is 0; allowed: 1 or more".to_string()));
    }
    if let Some(experiments) = arguments.simulate {
        return simulate(&scene, experiments, arguments);
    }
    if !arguments.limit {
        scene.check_chance(&arguments.scene().display().to_string())?;
    }
    if !arguments.collect.is_empty() {
        return collect(&scene, arguments);
    }
    let numbers = numbers(&scene, arguments.shots.as_deref())?;
    let findings = shot::before(&scene)?;
    let place = arguments.output.join(if arguments.limit { LIMIT } else { SHOTS });
    let writes = writes(arguments, arguments.restart);
    // Another scene's directory is told before what this one's lacks, and what is refused leaves none.
    RunDirectory::check(&arguments.output, &writes)?;
    check_restart(&place, arguments.restart)?;
    let locked = RunDirectory::lock(&arguments.output, writes)?;
    print_error(&warnings([(scene.target.name(), &findings[..])]));
    let (records, directory) = open(Records::new(&scene, &place), &place, locked)?;
    print_note("Ctrl-C ends the run: shots under way are lost, and --restart goes on with the others\n");
    let threads = arguments.threads.unwrap_or_else(rayon::current_num_threads);
    if arguments.limit {
        return find_limit(&scene, threads, records, arguments);
    }
    let stays = |(number, ended): &(&usize, &Ended)| numbers.contains(number) && run::stays(&scene, ended);
    let ended = records.shots.iter().filter(stays).count();
    let left = numbers.clone().count().saturating_sub(ended);
    let range = FiringRange::new(&scene, threads, left, Interrupt::listen()?);
    let records = Mutex::new(records);
    let done = run::series(&range, numbers, &records);
    range.finish();
    let records = records.into_inner().unwrap_or_else(PoisonError::into_inner);
    evaluate(&scene, &records, &directory, arguments)?;
    if done? { Ok(()) } else { Err(interrupted(arguments)) }
}

fn interrupted(arguments: &Arguments) -> Error {
    Error::Evaluation(format!("interrupted; the run goes on with\n  {}", again(arguments)))
}

/// The command by which an interrupted run goes on, with the options that it had.
fn again(arguments: &Arguments) -> String {
    let Arguments { output, case, shots, limit, firth, threads, .. } = arguments;
    let mut options = Vec::new();
    for (flag, is_given) in [("--limit", limit), ("--firth", firth)] {
        options.extend(is_given.then(|| flag.to_string()));
    }
    let threads = threads.map(|threads| threads.to_string());
    for (option, value) in [("--case", case), ("--shots", shots), ("--threads", &threads)] {
        options.extend(value.iter().flat_map(|value| [option.to_string(), value.clone()]));
    }
    shell::again("v50", arguments.scene(), output, &options)
}

/// The shots that are to be fired.
fn numbers(scene: &Scene, part: Option<&str>) -> Result<RangeInclusive<usize>, Error> {
    let last = scene.shots.number;
    let Some(part) = part else { return Ok(1..=last) };
    if scene.design().is_sequential() {
        let message = format!(
            "--shots is {part}, and design {} needs the fates of the shots before; allowed: design = \"even\", or no --shots",
            scene.design().name()
        );
        return Err(Error::Input(message));
    }
    let ends = part.split_once('-').unwrap_or((part, part));
    let [from, to] = [ends.0, ends.1].map(|end| end.trim().parse::<usize>().ok());
    match (from, to) {
        (Some(from), Some(to)) if 1 <= from && from <= to && to <= last => Ok(from..=to),
        _ => Err(Error::Input(format!(
            "--shots is {part}; allowed: FROM-TO, two whole numbers from 1 to number = {last}"
        ))),
    }
}

/// Checks that a run that restarts finds its table, and that one that begins finds none.
///
/// # Errors
/// The table is there and `restart` is not set, or the reverse.
fn check_restart(place: &Path, restart: bool) -> Result<(), Error> {
    let is_there = is_file(place)?;
    let place = place.display();
    match (is_there, restart) {
        (true, false) => {
            let message = format!("{place} is there, of an earlier run; allowed: --restart, or another directory");
            Err(Error::Input(message))
        }
        (false, true) => {
            let message = format!("--restart without {place}; allowed: the directory of the run that was stopped");
            Err(Error::Input(message))
        }
        _ => Ok(()),
    }
}

/// The tables and the picture of a scene's shots.
fn writes(arguments: &Arguments, restart: bool) -> Writes<'_> {
    let names = ["shots", "limit", "v50"].map(String::from).to_vec();
    Writes { command: "v50", files: vec![arguments.scene()], names, restart, ..Writes::default() }
}

/// The table that the shots go to, with those that are there, and its directory, which is this run's once they have
/// been read.
fn open(mut records: Records, place: &Path, locked: Locked) -> Result<(Records, RunDirectory), Error> {
    if is_file(place)? {
        let count = records.read(place)?;
        print_note(&format!("{count} shots stand in {}\n", place.display()));
    }
    let directory = locked.claim()?;
    records.open()?;
    Ok((records, directory))
}

/// Writes the figures and the picture, and prints the report.
fn evaluate(scene: &Scene, records: &Records, directory: &RunDirectory, arguments: &Arguments) -> Result<(), Error> {
    let output = &arguments.output;
    let series = Series::of(run::confirmed(scene, records), arguments.firth, scene.shots.spread);
    let beside = records.shots.len() - series.shots.len();
    for name in [report::FIGURES, "v50.svg", "v50.png"] {
        directory.remove(name)?;
    }
    if !series.told.curves.is_empty() {
        report::write_figures(&output.join(report::FIGURES), scene, &series)?;
        plot::write(&output.join("v50.svg"), &output.join("v50.png"), scene, &series)?;
    }
    let missing = scene.shots.number - series.shots.len();
    print(&report::report(scene, &series, [missing, beside], output));
    report::no_curve(scene, &series).filter(|_| missing == 0).map_or(Ok(()), Err)
}

fn collect(scene: &Scene, arguments: &Arguments) -> Result<(), Error> {
    let place = arguments.output.join(SHOTS);
    let mut records = Records::new(scene, &place);
    // Before there is a directory for them.
    for part in &arguments.collect {
        let table = part.join(SHOTS);
        if !part.is_dir() || !is_file(&table)? {
            let part = part.display();
            let message = format!("--collect is {part}, without a table {SHOTS}; allowed: directories of toron v50");
            return Err(Error::Input(message));
        }
        records.read(&table)?;
    }
    let (records, directory) = open(records, &place, RunDirectory::lock(&arguments.output, writes(arguments, false))?)?;
    evaluate(scene, &records, &directory, arguments)
}

fn find_limit(scene: &Scene, threads: usize, records: Records, arguments: &Arguments) -> Result<(), Error> {
    let Shots { speeds: [low, high], tolerance, .. } = scene.shots;
    let shots = limit::shots(high - low, tolerance);
    let left = shots.saturating_sub(records.shots.len());
    let range = FiringRange::new(scene, threads, left, Interrupt::listen()?);
    let found = limit::find(&range, &Mutex::new(records));
    range.finish();
    let Some(found) = found? else { return Err(interrupted(arguments)) };
    print(&report::limit(scene, &found));
    print(&format!("The shots are in {}\n", arguments.output.join(LIMIT).display()));
    Ok(())
}

/// Simulates experiments with the number, the range and the scatter of the scene's shots, by each design.
fn simulate(scene: &Scene, experiments: u64, arguments: &Arguments) -> Result<(), Error> {
    let Shots { speeds: [low, high], number, scatter, step, deviation, seed, .. } = scene.shots;
    if experiments == 0 {
        return Err(Error::Input("--simulate is 0; allowed: 1 or more, 1000 for two digits".to_string()));
    }
    let of_range = [low + TRUTH[0] * (high - low), TRUTH[1] * (high - low)];
    let [v50, true_deviation] = match arguments.truth.as_deref() {
        Some(&[v50, deviation]) => [v50, deviation],
        _ => of_range,
    };
    if !(v50.is_finite() && true_deviation > 0.0 && true_deviation.is_finite()) {
        let message = format!("--truth is {v50} {true_deviation}; allowed: a speed, and a finite deviation > 0");
        return Err(Error::Input(message));
    }
    let designs = [
        Design::Even,
        Design::Langlie,
        Design::UpAndDown { step },
        Design::DOptimal { deviation },
        Design::ThreePod { deviation, approach: None },
    ];
    let corrections: &[bool] = if arguments.firth { &[false, true] } else { &[false] };
    let mut lines = Vec::new();
    for design in designs {
        for link in Link::BOTH {
            for &firth in corrections {
                let experiment = Experiment { design, shots: number, range: [low, high], scatter };
                let truth = Truth { link, v50, deviation: true_deviation };
                let found = experiment.coverage(&truth, firth, experiments, seed);
                let curve = format!("{}{}", link.name(), if firth { ", Firth" } else { "" });
                lines.push((design.name().to_string(), curve, found));
            }
        }
    }
    print(&format!(
        "{experiments} simulated experiments of {number} shots, speeds {low} to {high}, scatter {scatter}, V50 {v50}, deviation {true_deviation}\n\n{}",
        report::simulated(&lines)
    ));
    Ok(())
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    fn arguments(words: &[&str]) -> Arguments {
        let line = Line::try_parse_from([&["v50"], words].concat());
        line.map(|line| line.arguments).expect("arguments")
    }

    /// What goes on is the same run, whatever its directory is called.
    #[test]
    fn a_run_goes_on_with_the_options_that_it_had() {
        let given = arguments(&["a b.toml", "-o", "it's/there", "--case", "one", "--firth", "--threads", "2"]);
        let wanted = r"toron v50 'a b.toml' -o 'it'\''s/there' --restart --firth --case one --threads 2";
        assert_eq!(again(&given), wanted);
        let given = arguments(&["a.toml", "--shots", "1-40"]);
        assert_eq!(again(&given), "toron v50 a.toml -o toron-out/v50 --restart --shots 1-40");
        assert_eq!(again(&arguments(&["a.toml", "--limit"])), "toron v50 a.toml -o toron-out/v50 --restart --limit");
    }
}
