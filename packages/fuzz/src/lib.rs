//! Random points and files for toron: what `cargo test -p toron-fuzz` and `.ci/long fuzz` run.
//!
//! - [`points`]: hostile calls of the numerical entries. The answers are held against what the header promises, against
//!   the other entries, and one point in a thousand against the formulas in 320 binary digits.
//! - [`readers`]: files of the repository, changed at random, for every reader of the programs: an answer or a message
//!   that names the file, no panic, in bounded time and memory.
//!
//! A run is told by its seed and repeats itself. A case that fails is made small and printed as a line, which
//! `TORON_FUZZ_CASE` replays, and belongs into `corpus/` after the mend: every test run replays what is there.

pub mod points;
pub mod readers;

/// A whole number from the environment, or this default.
///
/// # Panics
/// The variable is there and is no such number.
pub fn setting(name: &str, default: u64) -> u64 {
    match std::env::var(name) {
        Ok(text) => match text.parse::<f64>() {
            // 1e9 is easier to count than its zeros.
            Ok(number) if number >= 0.0 => text.parse().unwrap_or(number as u64),
            _ => panic!("{name} is {text}; allowed: a whole number"),
        },
        Err(_) => default,
    }
}

/// The seed of a run.
pub fn seed() -> u64 {
    setting("TORON_FUZZ_SEED", 1)
}
