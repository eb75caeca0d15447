//! Every call of a law is made in a child process, which the law may end: how it ends is an answer too.
//!
//! The parent writes a [`Request`] to a file and starts this program again as `check-child` ([`run_task`]); the child
//! loads the library, runs the [`Task`], and writes a [`ChildReply`] to a file ([`run`]). Memory that both map
//! ([`Shared`]) has the last call's arguments and where a fault was, if there is no reply.

use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::call::{Answer, Call, Law, Session, open_utilities};
use super::compile::LIBRARY_OF_UTILITIES;
use super::finding::{Finding, Question, Verdict};
use super::guarded::Guard;
use super::material::{Material, Reads};
use super::shared_memory::{self, SIGNALLED, Seen, Shared};
use super::{
    coverage, energy, expect, job, jumps, objectivity, place, process, properties, rest, steps, stress, tangent,
    thermal, unset, vumat, work_dir,
};
use toron_shared::bound_child;
use toron_shared::error::Error;

/// A call that takes longer counts as one that never returns.
pub const LONGEST_CALL: Duration = Duration::from_secs(5);
/// A question that takes longer is given up.
const LONGEST_QUESTION: Duration = Duration::from_secs(60);
const POLL_INTERVAL: Duration = Duration::from_millis(4);
/// How many bytes of the standard error's end are kept.
const STDERR_KEPT: usize = 1 << 14;

/// Exit codes of `utilities.c`.
const BY_XIT: i32 = 71;
const BY_MESSAGE: i32 = 72;
/// The child's own exit codes: for a library that cannot be loaded, and for what is not the law's.
const NOT_LOADED: i32 = 73;
const FAILED: i32 = 75;
/// The loader's, where a symbol is nowhere.
const UNRESOLVED: i32 = 127;
/// Rust's, after a panic.
const PANICKED: i32 = 101;

#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Task {
    /// Whether there is a VUMAT and no UMAT.
    OnlyVumat,
    /// What the law reads.
    Reads,
    Question {
        question: Question,
        reads: Reads,
        allowed: Option<f64>,
    },
    /// Objectivity where turns are larger than solvers have them.
    LargeTurns,
    /// Another material of the same library: its stresses, after those of the first material, or alone.
    Other {
        material: Box<Material>,
        after: bool,
    },
    /// The bits of answers along a few histories, as of [`unset`].
    Answers,
    /// One call, as the bits of its numbers: they need not be finite.
    Call(Vec<u64>),
}

#[derive(Debug, Serialize, Deserialize)]
pub struct Request {
    pub library: PathBuf,
    pub material: Material,
    pub task: Task,
    pub guard: Guard,
    pub shared: PathBuf,
    pub result: PathBuf,
}

/// What a child writes if the law has not ended it.
#[derive(Debug, Serialize, Deserialize)]
pub enum ChildReply {
    OnlyVumat(bool),
    /// What it reads, and whether a strain 33 changes the stress.
    Reads(Reads, bool),
    Finding(Finding),
    /// Numbers as bits.
    Bits(Vec<u64>),
    /// Stress, state, DDSDDE by rows, PNEWDT, as text: they need not be finite.
    Answer(Vec<(String, String)>),
}

/// How a child ended.
pub struct Ending {
    /// Its kind, as the report has it.
    pub kind: String,
    pub text: String,
    /// The last call.
    pub call: Option<Call>,
}

/// The child process, `check-child`: reads a request, runs its task, writes the reply, and ends.
///
/// # Errors
/// None that come back: its exit code tells its own failures from the law's ends.
pub fn run(request: &Path) -> Result<(), Error> {
    if let Err(error) = reply_to(request) {
        toron_shared::console::print_error(&error.to_string());
        std::process::exit(FAILED);
    }
    Ok(())
}

fn reply_to(request: &Path) -> Result<(), Error> {
    let io_error = |error: io::Error| Error::Input(format!("{}: {error}", request.display()));
    let text = std::fs::read(request).map_err(io_error)?;
    let Request { library, material, task, guard, shared, result } =
        serde_json::from_slice(&text).map_err(|error| Error::Input(format!("{}: {error}", request.display())))?;
    let shared = Shared::open(&shared).map_err(io_error)?;
    let utilities = request.with_file_name(LIBRARY_OF_UTILITIES);
    let _utilities = utilities.exists().then(|| loaded(open_utilities(&utilities)));
    if matches!(task, Task::OnlyVumat) {
        Shared::catch_signals();
        return write_reply(&result, &ChildReply::OnlyVumat(loaded(vumat::call::only_vumat(&library))));
    }
    if material.explicit.called {
        let law = loaded(vumat::call::Law::load(&library));
        Shared::catch_signals();
        let reply = vumat::child::reply_to(&law, &material, &task, guard, shared).map_err(io_error)?;
        let reply = reply.ok_or_else(|| Error::Input("this is asked of a UMAT alone".to_string()))?;
        return write_reply(&result, &reply);
    }
    let law = loaded(Law::load(&library, material.symbol.as_deref()));
    Shared::catch_signals();
    law.begin();
    let mut session = Session::new(&law, &material, guard, Some(shared)).map_err(io_error)?;
    let reply = match task {
        Task::OnlyVumat => ChildReply::OnlyVumat(false),
        Task::Reads => {
            let (reads, across) = process::reads(&mut session);
            ChildReply::Reads(reads, across)
        }
        Task::Question { question, reads, allowed } => {
            ChildReply::Finding(answer_question(question, &law, &material, &mut session, reads, allowed))
        }
        Task::LargeTurns => ChildReply::Finding(objectivity::at_large_turns(&mut session)),
        Task::Answers => ChildReply::Bits(unset::answers(&mut session)),
        Task::Other { material: other, after } => {
            if after {
                process::stresses(&mut session);
            }
            let mut session = Session::new(&law, &other, guard, Some(shared)).map_err(io_error)?;
            ChildReply::Bits(process::stresses(&mut session))
        }
        Task::Call(bits) => {
            let call = Call::from_bits(&bits).ok_or_else(|| Error::Input("a call is not whole".to_string()))?;
            let separated = material.separation.map(|_| call.with_separations(material.unit_of_strain()));
            ChildReply::Answer(answer_table(&session.call_as_it_is(separated.as_ref().unwrap_or(&call)), &material))
        }
    };
    write_reply(&result, &reply)
}

/// What is loaded; where it cannot be, this process has nothing to do.
fn loaded<T>(law: Result<T, String>) -> T {
    law.unwrap_or_else(|reason| {
        toron_shared::console::print_error(&reason);
        std::process::exit(NOT_LOADED)
    })
}

fn write_reply(result: &Path, reply: &ChildReply) -> Result<(), Error> {
    let text = serde_json::to_vec(reply).map_err(|error| Error::Input(error.to_string()))?;
    std::fs::write(result, text).map_err(|error| Error::Input(format!("{}: {error}", result.display())))?;
    // SAFETY: it takes a number and does not return. What the library would do at the process's end is not asked about.
    unsafe { libc::_exit(0) }
}

/// Which function answers which question of a UMAT; a VUMAT's are in `vumat/child.rs`.
fn answer_question(
    question: Question,
    law: &Law,
    material: &Material,
    session: &mut Session,
    reads: Reads,
    allowed: Option<f64>,
) -> Finding {
    match question {
        Question::Memory => process::touch_beyond_arrays(session),
        Question::Rest => rest::rest(session),
        Question::Stress => stress::stress(session),
        Question::Properties => properties::properties(session),
        Question::Place => place::place(session),
        Question::Expect => expect::expect(session),
        Question::Tangent => tangent::tangent(session, reads, allowed),
        Question::Objectivity => objectivity::objectivity(session, reads),
        Question::Isotropy => objectivity::isotropy(session),
        Question::Thermal => thermal::thermal(session),
        Question::Steps => steps::steps(session),
        Question::Jumps => jumps::jumps(session),
        Question::Job => job::job(session),
        Question::Energy => energy::energy(session),
        Question::Cycles => energy::cycles(session, reads),
        Question::Dissipation => energy::dissipation(session),
        Question::Repeat => process::repeat(session),
        Question::Threads => process::threads(law, material, session),
        Question::Outputs => process::outputs(session),
        Question::Exceptions => process::exceptions(session),
        Question::Invalid => process::invalid(session, reads),
        Question::Histories => process::histories(session, reads),
        Question::Runtime => process::runtime(session),
        Question::Coverage => coverage::cover_lines(law, session),
        Question::DataCheck | Question::Blocks | Question::Single | Question::Deletion => {
            Finding::new(question, Verdict::NotAsked, None, "asked of a VUMAT alone")
        }
        Question::Build | Question::Deck => {
            Finding::new(question, Verdict::NotAsked, None, "answered before the law is called")
        }
    }
}

fn answer_table(answer: &Answer, material: &Material) -> Vec<(String, String)> {
    let row = |values: &[f64]| values.iter().map(|value| format!("{value:.9e}")).collect::<Vec<_>>().join("  ");
    let components = material.components;
    let mut words = vec![
        ("STRESS".to_string(), row(&answer.stress[..components])),
        ("STATEV".to_string(), row(&answer.state)),
        ("SSE SPD SCD".to_string(), row(&answer.energies)),
        ("PNEWDT".to_string(), row(&[answer.next_step])),
    ];
    words.extend((0..components).map(|i| (format!("DDSDDE({},:)", i + 1), row(&answer.modulus[i][..components]))));
    words
}

/// The parent: runs a task in a child process, in this folder, and returns the child's reply, or how it ended without
/// one.
///
/// # Errors
/// The child cannot be started, its files cannot be written, or the library cannot be loaded or has no UMAT.
pub fn run_task(
    folder: &Path,
    library: &Path,
    material: &Material,
    task: Task,
    guard: Guard,
    longest_call: Duration,
) -> Result<Result<ChildReply, Ending>, Error> {
    let io_error = |error: io::Error| Error::Input(format!("{}: {error}", folder.display()));
    let (request, shared, result) = (folder.join("request.json"), folder.join("shared"), folder.join("result.json"));
    let content = Request {
        library: library.to_path_buf(),
        material: material.clone(),
        task,
        guard,
        shared: shared.clone(),
        result: result.clone(),
    };
    std::fs::write(&request, serde_json::to_vec(&content).map_err(|error| Error::Input(error.to_string()))?)
        .map_err(io_error)?;
    shared_memory::create(&shared).map_err(io_error)?;
    if let Err(error) = std::fs::remove_file(&result)
        && error.kind() != io::ErrorKind::NotFound
    {
        return Err(io_error(error));
    }
    let program = std::env::current_exe().map_err(io_error)?;
    let mut command = Command::new(program);
    command.arg("check-child").arg(&request).current_dir(work_dir::running(folder));
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    // What a law writes before it ends must not stay in a buffer.
    command.env("GFORTRAN_UNBUFFERED_PRECONNECTED", "1");
    bound_child::bind(&mut command);
    let mut child = command.spawn().map_err(io_error)?;
    let (errors, said) = (child.stderr.take(), child.stdout.take());
    let reader = std::thread::spawn(move || errors.map_or(String::new(), last_bytes));
    let listener = std::thread::spawn(move || said.map_or(String::new(), last_bytes));
    let status = watch(&mut child, &shared, longest_call).map_err(io_error)?;
    let messages = reader.join().unwrap_or_default();
    let said = last_lines(&listener.join().unwrap_or_default());
    let reply = std::fs::read(&result).ok().and_then(|text| serde_json::from_slice::<ChildReply>(&text).ok());
    if let (Some(reply), Watched::Ended(status)) = (reply, &status)
        && status.success()
    {
        return Ok(Ok(reply));
    }
    if let Watched::Ended(status) = &status {
        match status.code() {
            Some(NOT_LOADED) => return Err(Error::Input(last_line(&messages).to_string())),
            Some(FAILED) => return Err(Error::Input(format!("the check itself fails: {}", last_line(&messages)))),
            _ => {}
        }
    }
    let seen = Seen::read(&shared).map_err(io_error)?;
    let mut ending = ending(&status, &messages, &seen);
    if matches!(ending.kind.as_str(), "XIT" | "stop") && !said.is_empty() {
        ending.text.push_str(&format!("; its last words: {said}"));
    }
    Ok(Err(ending))
}

enum Watched {
    Ended(ExitStatus),
    Hangs(Duration),
    TakesTooLong,
}

/// Waits for the child's end, unless a call has none.
fn watch(child: &mut Child, shared: &Path, longest_call: Duration) -> io::Result<Watched> {
    let started = Instant::now();
    let (mut calls, mut since) = (0, Instant::now());
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Watched::Ended(status));
        }
        let now = Seen::calls(shared);
        if now != calls {
            (calls, since) = (now, Instant::now());
        }
        let hangs = since.elapsed() > longest_call;
        if hangs || started.elapsed() > LONGEST_QUESTION {
            child.kill()?;
            child.wait()?;
            return Ok(if hangs { Watched::Hangs(longest_call) } else { Watched::TakesTooLong });
        }
        std::thread::sleep(POLL_INTERVAL);
    }
}

/// Reads a stream to its end, and keeps its last bytes.
fn last_bytes(mut stream: impl Read) -> String {
    let mut kept = Vec::new();
    let mut buffer = [0; 4096];
    while let Ok(count) = stream.read(&mut buffer) {
        if count == 0 {
            break;
        }
        kept.extend_from_slice(&buffer[..count]);
        if kept.len() > 2 * STDERR_KEPT {
            kept.drain(..kept.len() - STDERR_KEPT);
        }
    }
    String::from_utf8_lossy(&kept).to_string()
}

fn ending(status: &Watched, messages: &str, seen: &Seen) -> Ending {
    use std::os::unix::process::ExitStatusExt;
    let call = Call::from_numbers(&seen.arguments);
    let end = |kind: &str, text: String| Ending { kind: kind.to_string(), text, call: call.clone() };
    let after = format!("in call {}", seen.calls);
    let status = match status {
        Watched::Hangs(longest) => {
            return end("hang", format!("the law does not return within {} s {after}", longest.as_secs()));
        }
        Watched::TakesTooLong => {
            return end("slow", format!("no answer within {} s, {} calls", LONGEST_QUESTION.as_secs(), seen.calls));
        }
        Watched::Ended(status) => status,
    };
    if let Some(symbol) = unresolved(messages) {
        return end("missing routine", format!("{symbol} is called and is nowhere, {after}"));
    }
    if let Some(message) = runtime_error(messages) {
        return end("runtime check", message);
    }
    match (status.code(), status.signal()) {
        (Some(SIGNALLED), _) => at_signal(seen, &after, call),
        (Some(BY_XIT), _) => end("XIT", format!("the law calls XIT {after}")),
        (Some(BY_MESSAGE), _) => end("XIT", format!("the law ends the analysis {after}: {}", last_line(messages))),
        (Some(UNRESOLVED), _) => {
            end("missing routine", format!("a routine is nowhere, {after}: {}", last_line(messages)))
        }
        (Some(PANICKED), _) => end("slow", format!("this check itself fails: {}", last_line(messages))),
        (Some(code), _) => {
            let message = last_line(messages);
            let message = if message.is_empty() { String::new() } else { format!(": {message}") };
            end("stop", format!("the law ends the process (STOP, exit code {code}) {after}{message}"))
        }
        (None, signal) => {
            let signal = signal.unwrap_or(0);
            let name = if signal == libc::SIGABRT { "abort: the heap is damaged, or it is called" } else { "a signal" };
            end("crash", format!("{name} ({signal}) {after} {}", last_line(messages)))
        }
    }
}

fn at_signal(seen: &Seen, after: &str, call: Option<Call>) -> Ending {
    let (kind, text) = match (seen.beside(), seen.signal as i32) {
        (Some(beside), _) => {
            let side = if beside.behind { "behind" } else { "before" };
            let text = format!("the law touches {}({}), {side} its end, {after}", beside.array, beside.entry);
            let text = if beside.behind { text } else { text.replace("its end", "its beginning") };
            (format!("{side} {}", beside.array), text)
        }
        (None, libc::SIGFPE) => {
            ("crash".to_string(), format!("a floating-point or whole-number exception ends it {after}"))
        }
        (None, libc::SIGILL) => ("crash".to_string(), format!("an illegal instruction (a trap) {after}")),
        (None, _) => ("crash".to_string(), format!("a segmentation fault {after}")),
    };
    Ending { kind, text, call }
}

/// The last lines that a law has written, in one.
fn last_lines(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    lines[lines.len().saturating_sub(LAST_WORDS)..].join(" / ")
}

/// So many of them.
const LAST_WORDS: usize = 3;

fn last_line(messages: &str) -> &str {
    messages.lines().rev().map(str::trim).find(|line| !line.is_empty()).unwrap_or_default()
}

/// The name of a routine that the loader does not find.
fn unresolved(messages: &str) -> Option<String> {
    let (_, rest) = messages.rsplit_once("undefined symbol: ")?;
    let symbol = rest.split([' ', '\n', ',']).next()?;
    Some(symbol.trim_end_matches('_').to_uppercase())
}

/// What gfortran's checks say: `At line 12 of file umat.f`, `Fortran runtime error: ...`.
fn runtime_error(messages: &str) -> Option<String> {
    let (before, error) = messages.rsplit_once("Fortran runtime error: ")?;
    let error = error.lines().next().unwrap_or_default();
    let place = before.lines().rev().find_map(|line| line.trim().strip_prefix("At line "));
    let named = place.map(|place| match place.split_once(" of file ") {
        Some((line, file)) => {
            // Errors of files have the unit and its file behind.
            let (file, unit) =
                file.split_once(" (").map_or((file, String::new()), |(file, unit)| (file, format!(" ({unit}")));
            let file = Path::new(file.trim()).file_name().map_or(file.into(), |name| name.to_string_lossy());
            format!("{file}:{line}: {error}{unit}")
        }
        None => error.to_string(),
    });
    Some(named.unwrap_or_else(|| error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_messages_of_loader_and_fortran_are_read() {
        let loader = "toron: symbol lookup error: /x/law.so: undefined symbol: kmatinv_\n";
        assert_eq!(unresolved(loader).as_deref(), Some("KMATINV"));
        let fortran = "At line 12 of file /x/umat.f\nFortran runtime error: Index '4' of dimension 1 of array 'statev' \
                       above upper bound of 3\n";
        let expected = "umat.f:12: Index '4' of dimension 1 of array 'statev' above upper bound of 3";
        assert_eq!(runtime_error(fortran).as_deref(), Some(expected));
        let unit = "At line 7 of file /x/a.f (unit = 16, file = 'fibres.inp')\nFortran runtime error: End of file\n";
        assert_eq!(runtime_error(unit).as_deref(), Some("a.f:7: End of file (unit = 16, file = 'fibres.inp')"));
        assert_eq!(runtime_error("STOP 1"), None);
    }
}
