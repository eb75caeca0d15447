//! A program's arguments, and its end.

use std::process::ExitCode;

use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches};

use crate::console::{self, Format, keep, lost, print_error};
use crate::error::Error;

const JSON: &str = "json";
const QUIET: &str = "quiet";

/// The command with the options of those of its commands whose output is `tables`, which they can print as JSON too.
pub fn with_options(command: Command, tables: &[&str]) -> Command {
    let flag = |name: &'static str, help: &'static str| Arg::new(name).long(name).action(ArgAction::SetTrue).help(help);
    command.mut_subcommands(|command| {
        if !tables.contains(&command.get_name()) {
            return command;
        }
        let json = flag(JSON, "Print one JSON object in place of text: the tables, complete, and the other lines");
        let quiet = flag(QUIET, "No progress and no notes on the standard error; warnings and errors stay");
        command.arg(json).arg(quiet)
    })
}

/// The name of the command that is given, and how its output is to look.
fn format<'a>(matches: &'a ArgMatches, tables: &[&str]) -> (&'a str, Format) {
    let Some((name, matches)) = matches.subcommand() else { return ("", Format::default()) };
    let [json, quiet] = [JSON, QUIET].map(|flag| tables.contains(&name) && matches.get_flag(flag));
    (name, Format { json, quiet })
}

/// Runs a program: its arguments, read as `command` says, go to `run`. Errors, and what is lost of the standard output,
/// end on the standard error behind the program's name.
pub fn run<A: FromArgMatches>(command: Command, tables: &[&str], run: impl FnOnce(A) -> Result<(), Error>) -> ExitCode {
    let program = command.get_name().to_string();
    let version = command.get_version().unwrap_or_default().to_string();
    let arguments = with_options(command, tables).try_get_matches().and_then(|matches| {
        let (name, format) = format(&matches, tables);
        console::set(format);
        Ok((name.to_string(), A::from_arg_matches(&matches)?))
    });
    let answer = match arguments {
        Ok((name, arguments)) => {
            let answer = run(arguments);
            console::finish(&name, &version);
            answer
        }
        Err(error) if error.use_stderr() => error.exit(),
        // `--help` and `--version` are errors for clap.
        Err(text) => {
            keep(text.print());
            Ok(())
        }
    };
    let lost = lost().map(|reason| Error::Input(format!("standard output: {reason}")));
    let errors: Vec<Error> = answer.err().into_iter().chain(lost).collect();
    for error in &errors {
        print_error(&format!("{program}: {error}\n"));
    }
    errors.first().map_or(ExitCode::SUCCESS, |error| ExitCode::from(error.exit_code()))
}
