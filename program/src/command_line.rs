//! A program's arguments, and its end.

use std::process::ExitCode;

use clap::{Command, FromArgMatches};

use crate::common::console::{keep, lost, print_error};
use crate::common::error::Error;

/// Runs a program: its arguments, read as `command` says, go to `run`. Errors, and what is lost of the standard output, end on the
/// standard error behind the program's name.
pub fn run<A: FromArgMatches>(command: Command, run: impl FnOnce(A) -> Result<(), Error>) -> ExitCode {
    let program = command.get_name().to_string();
    let answer = match command.try_get_matches().and_then(|matches| A::from_arg_matches(&matches)) {
        Ok(arguments) => run(arguments),
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
