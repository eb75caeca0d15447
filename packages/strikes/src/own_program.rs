//! A program for a law of one's own that strikes yarns and panels of it.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::{fabric, impact};
use toron::host::Material;
use toron::host::prepared::AsNumbers;
use toron_materials::material::laws::Laws;
use toron_materials::material::own_law::OwnLaw;
use toron_materials::own_program::{self, adapted, with_law};
use toron_shared::error::Error;
use toron_shared::{build, command_line};

/// The commands here whose output is tables, which they can print as JSON too.
const WITH_TABLES: [&str; 2] = ["impact", "fabric"];

#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    #[command(flatten)]
    OfMaterial(own_program::Command),
    /// Strike a yarn: run the cases of a scene; write histories, plots, pictures and a table of them.
    Impact {
        /// The scene, a TOML file as toron's guide to impact describes it; - is the standard input.
        scene: PathBuf,
        /// Where the files go.
        #[arg(short, long, default_value = "toron-out/impact")]
        output: PathBuf,
        /// Go on from the checkpoints in that directory.
        #[arg(long)]
        restart: bool,
    },
    /// Strike a woven panel by a sphere or a cylinder.
    Fabric {
        /// The scene, a TOML file as toron's guide to fabrics describes it; - is the standard input.
        scene: PathBuf,
        /// Where the histories and pictures go.
        #[arg(short, long, default_value = "toron-out/fabric")]
        output: PathBuf,
        /// Go on from the checkpoints in that directory.
        #[arg(long)]
        restart: bool,
    },
}

/// The `main` of a program for the law `M`: what [`toron_materials::of_law`] does, and `impact` and `fabric`, which
/// strike a yarn or a panel of it in the explicit host. The arguments are those of that function.
///
/// ```ignore
/// fn main() -> std::process::ExitCode {
///     toron_strikes::of_law::<ReinforcedSolid>("REINFORCED", 3)
/// }
/// ```
pub fn of_law<M>(name: &'static str, number: i32) -> ExitCode
where
    M: Material<f64> + Material<f32>,
    <M as Material<f64>>::Law: AsNumbers<f64> + Send + Sync + 'static,
    <M as Material<f32>>::Law: AsNumbers<f32> + Send + Sync + 'static,
{
    build::declare::<Arguments>(env!("TORON_SOURCES"));
    with_law::<M>(name, number, |law| {
        let about = "load paths on one element, struck yarns and panels, property tables, decks";
        let with_tables = [&own_program::WITH_TABLES[..], &WITH_TABLES].concat();
        command_line::run(adapted(Arguments::command(), law, about), &with_tables, |arguments| run(law, arguments))
    })
}

fn run(law: &'static OwnLaw, Arguments { command }: Arguments) -> Result<(), Error> {
    match command {
        Command::OfMaterial(command) => command.run(law),
        Command::Impact { scene, output, restart } => impact::command::run(Laws::Own(law), &scene, &output, restart),
        Command::Fabric { scene, output, restart } => fabric::command::run(Laws::Own(law), &scene, &output, restart),
    }
}
