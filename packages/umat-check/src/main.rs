//! The program `umat-check`: arguments only.

#[cfg(target_os = "linux")]
fn main() -> std::process::ExitCode {
    use clap::{CommandFactory, Parser, Subcommand};
    use umat_check::{child, command};

    /// Check a UMAT or VUMAT of Abaqus, yours or anybody's: tangent, objectivity, energy, memory, threads.
    #[derive(Parser)]
    #[command(name = "umat-check", version, args_conflicts_with_subcommands = true)]
    struct CommandLine {
        #[command(subcommand)]
        child: Option<Child>,
        #[command(flatten)]
        check: command::Arguments,
    }

    #[derive(Subcommand)]
    enum Child {
        /// The process in which a law is asked.
        #[command(hide = true)]
        CheckChild { request: std::path::PathBuf },
    }

    let command = CommandLine::command().mut_arg("output", |output| output.default_value("umat-check-out"));
    toron_shared::command_line::run(command, &[], |arguments: CommandLine| match arguments.child {
        Some(Child::CheckChild { request }) => child::run(&request),
        None => command::run("umat-check", &arguments.check),
    })
}

#[cfg(not(target_os = "linux"))]
fn main() {
    eprintln!("umat-check runs on Linux alone");
    std::process::exit(2);
}
