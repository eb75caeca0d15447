//! One answer a line, in the order of the lines.

use std::io::{self, BufRead, BufWriter, StdinLock, StdoutLock, Write};

use serde::Serialize;

use toron_shared::error::Error;

/// From the standard input to the standard output.
///
/// # Errors
/// Reading or writing fails.
pub fn standard(
    evaluate: impl FnOnce(StdinLock<'static>, BufWriter<StdoutLock<'static>>) -> io::Result<()>,
) -> Result<(), Error> {
    match evaluate(io::stdin().lock(), BufWriter::new(io::stdout().lock())) {
        // A reader that has gone is no error.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Error::Input(error.to_string())),
        _ => Ok(()),
    }
}

/// Answers every line of `input` that is not blank; the answer gets its text and its number, from 1.
///
/// # Errors
/// Reading or writing fails.
pub fn answer<A: Serialize>(
    input: impl BufRead,
    mut output: impl Write,
    answer: impl Fn(&[u8], usize) -> A,
) -> io::Result<()> {
    let of_output = |error: io::Error| io::Error::new(error.kind(), format!("standard output: {error}"));
    for (line, number) in input.split(b'\n').zip(1..) {
        let line = line.map_err(|error| io::Error::new(error.kind(), format!("standard input: {error}")))?;
        if line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        serde_json::to_writer(&mut output, &answer(&line, number)).map_err(|error| of_output(error.into()))?;
        output.write_all(b"\n").map_err(of_output)?;
    }
    output.flush().map_err(of_output)
}

/// 11 22 33 12 23 31 to 11 22 33 12 13 23.
pub fn order<X: Copy>(s: [X; 6]) -> [X; 6] {
    [s[0], s[1], s[2], s[3], s[5], s[4]]
}
