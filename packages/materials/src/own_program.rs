//! A program for a law of one's own, which reads and writes what `toron` does.

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::eval::own_law::{self, Entry};
use crate::material::laws::Laws;
use crate::material::own_law::OwnLaw;
use crate::{bench, deck, load_path, params};
use toron::host::Material;
use toron::host::prepared::AsNumbers;
use toron_shared::build;
use toron_shared::command_line;
use toron_shared::console::{print, print_error};
use toron_shared::error::Error;

/// The commands whose output is tables, which they can print as JSON too.
pub const WITH_TABLES: [&str; 3] = ["run", "params", "bench"];

/// The number of the sources of the commands here.
pub const SOURCES: &str = env!("TORON_SOURCES");

#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// What a program for a law of one's own does with the material alone.
#[derive(Subcommand)]
pub enum Command {
    /// Take one element along a load path; write a table and a plot of it.
    Run(load_path::command::Arguments),
    /// Print the tables of properties and state variables, or one preset's values.
    Params(params::Arguments),
    /// Print a material's card, ready to be pasted into a solver's deck.
    Deck(deck::command::Arguments),
    /// Measure what a point of a block costs on this machine, and warn if the law is not inlined into the kernels.
    Bench(bench::own_law::Arguments),
    /// Print the header of the law's functions in C.
    Header,
    /// Evaluate one JSON object a line of the standard input: {"F": rows, "m": [1, 0, 0], "params": {NAME: value}};
    /// "m", the fibre direction, may be left out.
    Eval {
        /// How the law is called.
        #[arg(long, value_enum, default_value = "law")]
        via: Entry,
        /// Add "ddsdde", rows of the Jaumann modulus as Abaqus wants it.
        #[arg(long)]
        tangent: bool,
    },
}

/// The `main` of a program for the law `M`: `run`, `params`, `deck` and `eval`, which read and write what `toron`'s do,
/// `header` and `bench`. `name` is the law's name in the solvers' libraries, in capitals, and `number` its nn of
/// OpenRadioss's `/MAT/USERnn`; files, and the program itself, call it by the name in small letters.
///
/// ```ignore
/// fn main() -> std::process::ExitCode {
///     toron_materials::of_law::<ReinforcedSolid>("REINFORCED", 3)
/// }
/// ```
pub fn of_law<M>(name: &'static str, number: i32) -> ExitCode
where
    M: Material<f64> + Material<f32>,
    <M as Material<f64>>::Law: AsNumbers<f64> + Send + Sync + 'static,
    <M as Material<f32>>::Law: AsNumbers<f32> + Send + Sync + 'static,
{
    build::declare::<Arguments>(SOURCES);
    with_law::<M>(name, number, |law| {
        let command = adapted(Arguments::command(), law, "load paths on one element, property tables, decks");
        command_line::run(command, &WITH_TABLES, |arguments: Arguments| arguments.command.run(law))
    })
}

/// Calls a program with the law, which is there as long as the program runs.
pub fn with_law<M>(name: &'static str, number: i32, program: impl FnOnce(&'static OwnLaw) -> ExitCode) -> ExitCode
where
    M: Material<f64> + Material<f32>,
    <M as Material<f64>>::Law: AsNumbers<f64> + Send + Sync + 'static,
    <M as Material<f32>>::Law: AsNumbers<f32> + Send + Sync + 'static,
{
    match OwnLaw::new::<M>(name, number) {
        Ok(law) => program(Box::leak(Box::new(law))),
        Err(reason) => {
            print_error(&format!("{reason}\n"));
            ExitCode::from(2)
        }
    }
}

/// The arguments of a program for this law, which does what `about` says.
pub fn adapted(command: clap::Command, law: &'static OwnLaw, about: &str) -> clap::Command {
    command
        .name(Laws::Own(law).program())
        .version(params::version())
        .about(format!("The {}: {about}", law.description.title))
        // There is one law, which has no demonstration and no built-in presets.
        .mut_subcommand("run", |run| {
            let help = "The load path, a file as toron's guide to load paths describes it";
            run.mut_arg("path", |path| path.required(true).help(help))
        })
        .mut_subcommand("params", |params| {
            params.mut_arg("preset", |preset| preset.help("Print the values of this preset alone: a file NAME.toml"))
        })
        .mut_subcommand("deck", |deck| {
            let preset = "The material: a file NAME.toml";
            deck.mut_arg("law", |law| law.hide(true)).mut_arg("preset", |argument| argument.help(preset))
        })
}

impl Command {
    /// # Errors
    /// Those of the command.
    pub fn run(self, law: &'static OwnLaw) -> Result<(), Error> {
        let laws = Laws::Own(law);
        match self {
            Command::Run(arguments) => load_path::command::run(laws, &arguments),
            Command::Params(arguments) => params::print_tables(laws, &arguments),
            Command::Deck(arguments) => deck::command::run(laws, &arguments),
            Command::Bench(arguments) => bench::own_law::run(law, &arguments),
            Command::Header => {
                print(&(law.header)(law.symbol));
                Ok(())
            }
            Command::Eval { via, tangent } => own_law::lines(law, via, tangent),
        }
    }
}
