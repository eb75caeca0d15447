//! A program for a law of one's own, which reads and writes what `toron` does.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::common::console::{print, print_error};
use crate::eval::own_law::{self, Entry};
use crate::material::laws::Laws;
use crate::material::own_law::OwnLaw;
use crate::{command_line, deck, load_path, params};
use toron::host::Material;
use toron::host::c::AsNumbers;

#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Take one element along a load path; write a table and a plot of it.
    Run {
        /// The load path, a file as toron's guide to load paths describes it.
        path: PathBuf,
        /// Where the table and the plot go.
        #[arg(short, long, default_value = "toron-out")]
        output: PathBuf,
    },
    /// Print the tables of properties and state variables, or one preset's values.
    Params {
        /// Unit system, for instance mm-tonne-s; without it, si, or the units of the preset's file.
        #[arg(long)]
        units: Option<String>,
        /// Print the values of this preset alone: a file NAME.toml.
        #[arg(long)]
        preset: Option<String>,
    },
    /// Print a material's card, ready to be pasted into a solver's deck.
    Deck(deck::command::Arguments),
    /// Print the header of the law's functions in C.
    Header,
    /// Evaluate one JSON object a line of the standard input: {"F": rows, "m": [1, 0, 0], "params": {NAME: value}}; "m", the fibre
    /// direction, may be left out.
    Eval {
        /// How the law is called.
        #[arg(long, value_enum, default_value = "law")]
        via: Entry,
        /// Add "ddsdde", rows of the Jaumann modulus as Abaqus wants it.
        #[arg(long)]
        tangent: bool,
    },
}

/// The `main` of a program for the law `M`: `run`, `params`, `deck` and `eval`, which read and write what `toron`'s do, and `header`. `name` is the law's
/// name in the solvers' libraries, in capitals, and `number` its nn of OpenRadioss's `/MAT/USERnn`; files, and the program itself, call
/// it by the name in small letters.
///
/// ```ignore
/// fn main() -> std::process::ExitCode {
///     toron_program::of_law::<ReinforcedSolid>("REINFORCED", 3)
/// }
/// ```
pub fn of_law<M>(name: &'static str, number: i32) -> ExitCode
where
    M: Material<f64> + Material<f32>,
    <M as Material<f64>>::Law: AsNumbers<f64> + Send + Sync + 'static,
    <M as Material<f32>>::Law: AsNumbers<f32>,
{
    match OwnLaw::new::<M>(name, number) {
        // As long as the program runs, its law is there.
        Ok(law) => program(Box::leak(Box::new(law))),
        Err(reason) => {
            print_error(&format!("{reason}\n"));
            ExitCode::from(2)
        }
    }
}

fn program(law: &'static OwnLaw) -> ExitCode {
    let laws = Laws::Own(law);
    let command = Arguments::command()
        .name(laws.program())
        .version(params::version())
        .about(format!("The {}: load paths on one element, property tables, decks", law.description.title))
        // There is one law.
        .mut_subcommand("deck", |deck| deck.mut_arg("law", |argument| argument.hide(true)));
    command_line::run(command, |arguments: Arguments| match arguments.command {
        Command::Run { path, output } => load_path::command::run(laws, Some(&path), &output),
        Command::Params { units, preset } => params::print_tables(laws, units.as_deref(), preset.as_deref()),
        Command::Deck(arguments) => deck::command::run(laws, &arguments),
        Command::Header => {
            print(&(law.header)(law.symbol));
            Ok(())
        }
        Command::Eval { via, tangent } => own_law::lines(law, via, tangent),
    })
}
