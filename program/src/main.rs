//! The program `toron`: arguments only.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use toron_materials::eval::command::{Entry, Law};
use toron_materials::material::laws::Laws;
use toron_materials::{bench, deck, eval, load_path, params};
use toron_parameters::{cell, fibres, identify};
use toron_program::init;
use toron_shared::console::print;
use toron_shared::error::Error;
use toron_shared::{build, command_line};
use toron_strikes::{compare, fabric, impact, scene_deck, v50};

/// A user-material library for yarns and dry fabrics: load paths on one element, struck yarns and panels, property
/// tables, decks.
#[derive(Parser)]
#[command(name = "toron", version = params::version())]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// In the order in which a user comes to them: from data to results, then what solvers need.
#[derive(Subcommand)]
enum Command {
    /// Write a scene to start from, with its yarn; without a name, list those that there are.
    Init(init::Arguments),
    /// Find the properties of a yarn from measured data, and how sure they are; write a preset of them.
    Fit {
        /// The data and what is known besides, a TOML file (`toron init data-sheet` writes one); - is the standard
        /// input.
        data: PathBuf,
        /// Where the preset, the tables and the plot go.
        #[arg(short, long, default_value = "toron-out")]
        output: PathBuf,
        /// Run this scene of `toron impact` with the parameters, and with each at the ends of its interval.
        #[arg(long)]
        scene: Option<PathBuf>,
    },
    /// Take one element along a load path; write a table and a plot of it.
    Run(load_path::command::Arguments),
    /// Mesh a woven panel with hexahedra; write it for ParaView, with figures and a picture.
    Weave {
        /// The weave, a TOML file (`toron init weave` writes one); - is the standard input.
        scene: PathBuf,
        /// Where the files go.
        #[arg(short, long, default_value = "toron-out")]
        output: PathBuf,
        #[command(flatten)]
        deck: scene_deck::command::Arguments,
    },
    /// Strike a woven panel by a sphere or a cylinder.
    Fabric {
        /// The scene, a TOML file (`toron init fabric` writes one); - is the standard input.
        scene: PathBuf,
        /// Where the histories and pictures go.
        #[arg(short, long, default_value = "toron-out/fabric")]
        output: PathBuf,
        /// Go on from the checkpoints in that directory.
        #[arg(long, conflicts_with = "host")]
        restart: bool,
        #[command(flatten)]
        deck: scene_deck::command::Arguments,
    },
    /// Strike a yarn: run the cases of a scene; write histories, plots, pictures and a table of them.
    Impact {
        /// The scene, a TOML file (`toron init yarn` writes one); - is the standard input.
        scene: PathBuf,
        /// Where the files go.
        #[arg(short, long, default_value = "toron-out/impact")]
        output: PathBuf,
        #[command(flatten)]
        deck: scene_deck::command::Arguments,
        /// Go on from the checkpoints in that directory.
        #[arg(long, conflicts_with = "host")]
        restart: bool,
    },
    /// Fire a series of shots at a scene: V50, V5, V95 and slope with their intervals, and how sure the answer is.
    V50(Box<v50::command::Arguments>),
    /// Strike a yarn whose fibres are rows of beads, in LAMMPS; write histories, plots, pictures and a table of them.
    Fibres(fibres::command::Arguments),
    /// Press a yarn's section, fibre by fibre, in CalculiX; write energies, pictures and the file that the fit reads.
    Cell {
        /// The section, a TOML file (`toron init cell` writes one); - is the standard input.
        scene: PathBuf,
        /// Where the files go.
        #[arg(short, long, default_value = "toron-out/cell")]
        output: PathBuf,
        /// The program ccx of CalculiX; without it, that of the variable TORON_CCX, or the one in PATH.
        #[arg(long)]
        ccx: Option<PathBuf>,
        /// Go on from the checkpoints of the explicit host in that directory.
        #[arg(long)]
        restart: bool,
    },
    /// Print a material's card, ready to be pasted into a solver's deck.
    Deck(deck::command::Arguments),
    /// Print the tables of properties and state variables, the presets, or one preset's values.
    Params(params::Arguments),
    /// Check a UMAT or VUMAT of Abaqus, yours or anybody's: tangent, objectivity, energy, memory, threads.
    #[cfg(target_os = "linux")]
    Check(Box<umat_check::command::Arguments>),
    /// The process in which a law is asked.
    #[cfg(target_os = "linux")]
    #[command(hide = true)]
    CheckChild { request: PathBuf },
    /// Compare histories of a strike from several hosts; write a table and a figure of them.
    Compare(compare::command::Arguments),
    /// Evaluate one JSON object a line of the standard input: {"F": rows, "m": [3], "params": {kel, ktc, p, ktd, kld,
    /// eps_lim, alpha, beta}}.
    Eval {
        /// Whose points the lines are.
        #[arg(long, value_enum, default_value = "hyperelastic")]
        law: Law,
        /// The C entry to go through, as its host would call it.
        #[arg(long, value_enum, default_value = "law")]
        via: Entry,
        /// Add "ddsdde", rows of the Jaumann modulus as Abaqus wants it, of a path's last step; refused for entries
        /// that have none.
        #[arg(long)]
        tangent: bool,
    },
    /// Measure what a point costs on this machine; takes about half a minute.
    Bench {
        /// Where to write the figures as bench.json.
        #[arg(short, long)]
        output: Option<PathBuf>,
    },
    /// Print the completions of this program's arguments for a shell.
    Completions {
        /// As in: toron completions bash > ~/.local/share/bash-completion/completions/toron
        shell: Shell,
    },
}

/// The commands whose output is tables, which they can print as JSON too.
const WITH_TABLES: [&str; 12] =
    ["init", "fit", "run", "weave", "fabric", "impact", "v50", "fibres", "cell", "params", "compare", "bench"];

/// Made in memory first: the generator panics where it cannot write, and a reader that has gone is no error.
fn completions(shell: Shell) {
    let mut script = Vec::new();
    clap_complete::generate(
        shell,
        &mut command_line::with_options(Arguments::command(), &WITH_TABLES),
        "toron",
        &mut script,
    );
    print(&String::from_utf8_lossy(&script));
}

fn main() -> ExitCode {
    build::declare::<Arguments>(env!("TORON_SOURCES"));
    command_line::run(Arguments::command(), &WITH_TABLES, |arguments: Arguments| run(arguments.command))
}

fn run(command: Command) -> Result<(), Error> {
    match command {
        Command::Init(arguments) => init::run(&arguments),
        Command::Fit { data, output, scene } => identify::command::run(&data, &output, scene.as_deref()),
        Command::Run(arguments) => load_path::command::run(Laws::Toron, &arguments),
        Command::Weave { scene, output, deck } => match deck.host {
            Some(host) => scene_deck::command::weave(&scene, &output, host, &deck),
            None => fabric::command::weave(&scene, &output),
        },
        Command::Fabric { scene, output, restart, deck } => match deck.host {
            Some(host) => scene_deck::command::fabric(&scene, &output, host, &deck),
            None => fabric::command::run(Laws::Toron, &scene, &output, restart),
        },
        Command::Impact { scene, output, restart, deck } => match deck.host {
            Some(host) => scene_deck::command::impact(&scene, &output, host, &deck),
            None => impact::command::run(Laws::Toron, &scene, &output, restart),
        },
        Command::V50(arguments) => v50::command::run(&arguments),
        Command::Fibres(arguments) => fibres::command::run(&arguments)
            .and_then(|fit| fit.map_or(Ok(()), |fit| identify::command::run(&fit, &arguments.output, None))),
        Command::Cell { scene, output, ccx, restart } => cell::command::run(&scene, &output, ccx.as_deref(), restart)
            .and_then(|fit| identify::command::run(&fit, &output, None)),
        Command::Deck(arguments) => deck::command::run(Laws::Toron, &arguments),
        Command::Params(arguments) => params::print_tables(Laws::Toron, &arguments),
        #[cfg(target_os = "linux")]
        Command::Check(arguments) => umat_check::command::run("toron check", &arguments),
        #[cfg(target_os = "linux")]
        Command::CheckChild { request } => umat_check::child::run(&request),
        Command::Compare(arguments) => compare::command::run(&arguments),
        Command::Eval { law, via, tangent } => eval::command::lines(law, via, tangent),
        Command::Bench { output } => bench::command::run(output.as_deref()),
        Command::Completions { shell } => {
            completions(shell);
            Ok(())
        }
    }
}
