//! The program `toron`: arguments only.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use toron::driver::{Error, command, params};

/// A user-material library for yarns and dry fabrics: load paths on one element, property tables, decks.
#[derive(Parser)]
#[command(version = params::VERSION)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Take one element along a load path; write a table and a plot of it.
    Run {
        /// The load path (see docs/load-paths.md); without it, a demonstration: compaction, then tension to failure.
        path: Option<PathBuf>,
        /// Where the table and the plot go.
        #[arg(short, long, default_value = "toron-out")]
        output: PathBuf,
    },
    /// Print the tables of properties and state variables, the presets, or a preset as a deck.
    Params {
        /// Unit system, for instance mm-tonne-s; without it, si.
        #[arg(long)]
        units: Option<String>,
        /// Print this preset, ready for LS-DYNA and Abaqus decks.
        #[arg(long)]
        preset: Option<String>,
    },
}

fn main() -> ExitCode {
    let answer: Result<(), Error> = match Arguments::parse().command {
        Command::Run { path, output } => command::run(path.as_deref(), &output),
        Command::Params { units, preset } => params::print_tables(units.as_deref(), preset.as_deref()),
    };
    match answer {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("toron: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}
