//! What it takes to go on with a case: of which case it is, where it stands, its state or its outcome, and a checksum.

use serde::{Deserialize, Serialize};

use super::plan::Plan;
use super::run::{End, OutcomeOf, ROUNDING, Struck};
use crate::archive::Archive;
use toron_shared::build;
use toron_shared::error::Error;
use toron_shared::numbers::number;

/// The build in which a checkpoint begins: one of another build is not to be taken.
fn build() -> String {
    format!("toron {} build {:08x}", env!("CARGO_PKG_VERSION"), build::number())
}

/// What a checkpoint begins with: its build, and the scene but for what only the future depends on.
fn identity(struck: &impl Struck) -> String {
    format!("{} {}", build(), struck.identity())
}

/// Where a checkpoint stands in time, and the plan of the run that wrote it.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Head {
    time: f64,
    pub plan: Plan,
    /// How the case has ended, where its outcome follows and nothing from which it could go on.
    pub ended: Option<End>,
}

impl Head {
    /// Whether a case that has ended would go on now.
    fn is_too_early(&self, plan: &Plan) -> bool {
        match self.ended {
            None | Some(End::Left | End::Failed | End::Interrupted) => false,
            Some(End::Stopped) => plan.rebounds,
            Some(End::Decided) => !plan.decides || plan.settles,
            Some(End::Settled) => !plan.decides,
            Some(End::Time | End::Rebounded) => plan.end > self.plan.end * (1.0 + ROUNDING),
        }
    }
}

fn refused(struck: &impl Struck, reason: &str) -> Error {
    let allowed = "allowed: one of the same build and scene, but for end, until, pictures, frames and checkpoints";
    Error::Input(format!("the checkpoint of case {} is {reason}; {allowed}", struck.name()))
}

pub fn damaged(struck: &impl Struck) -> Error {
    refused(struck, "damaged")
}

/// Checks a checkpoint; returns its head and what follows.
///
/// # Errors
/// It is not this case's, later than its end, or damaged.
pub fn check<'a>(struck: &impl Struck, checkpoint: &'a [u8]) -> Result<(Head, &'a [u8]), Error> {
    let damaged = || damaged(struck);
    let (contents, sum) = checkpoint.split_last_chunk::<4>().ok_or_else(damaged)?;
    if crc32fast::hash(contents) != u32::from_le_bytes(*sum) {
        return Err(damaged());
    }
    let (found, rest) = postcard::take_from_bytes::<String>(contents).map_err(|_| damaged())?;
    if found != identity(struck) {
        let own = build();
        let is_of_build = found.strip_prefix(&own).is_some_and(|rest| rest.starts_with(' '));
        let other = found.split(' ').take(4).collect::<Vec<_>>().join(" ");
        let of_build = format!("of another build of the program ({other}, not {own})");
        return Err(refused(struck, if is_of_build { "of another scene" } else { &of_build }));
    }
    let (head, rest) = postcard::take_from_bytes::<Head>(rest).map_err(|_| damaged())?;
    let (name, plan) = (struck.name(), struck.plan());
    if head.is_too_early(plan) {
        let allowed = "allowed: end and until as they were, or another directory";
        let reason = format!("of its end at {}, from which it cannot go on", number(head.time));
        return Err(Error::Input(format!("the checkpoint of case {name} is {reason}; {allowed}")));
    }
    if head.time > plan.end * (1.0 + ROUNDING) {
        let [end, time] = [plan.end, head.time].map(number);
        let message = format!("end is {end} in case {name}, whose checkpoint is of {time}; allowed: {time} or later");
        return Err(Error::Input(message));
    }
    Ok((head, rest))
}

/// The outcome of a case that has ended, if its checkpoint is one of its end.
///
/// # Errors
/// As for [`check`].
pub fn outcome<S: Struck>(struck: &S, checkpoint: &[u8]) -> Result<Option<OutcomeOf<S>>, Error> {
    let (head, rest) = check(struck, checkpoint)?;
    head.ended.map(|_| postcard::from_bytes(rest).map_err(|_| damaged(struck))).transpose()
}

/// The checkpoint of a case that has ended: small, since it has the outcome and no state.
///
/// # Errors
/// It cannot be put into bytes.
pub fn of_outcome<S: Struck>(struck: &S, outcome: &mut OutcomeOf<S>) -> Result<Vec<u8>, Error> {
    let head = Head { time: outcome.last().time, plan: struck.plan().clone(), ended: Some(outcome.end) };
    write(struck, head, |archive| archive.keep(outcome))
}

/// The checkpoint of a case that can go on from the state that `contents` writes.
///
/// # Errors
/// It cannot be put into bytes.
pub fn of_state(
    struck: &impl Struck,
    plan: Plan,
    time: f64,
    contents: impl FnOnce(&mut Archive<'_>) -> Result<(), postcard::Error>,
) -> Result<Vec<u8>, Error> {
    write(struck, Head { time, plan, ended: None }, contents)
}

fn write(
    struck: &impl Struck,
    mut head: Head,
    contents: impl FnOnce(&mut Archive<'_>) -> Result<(), postcard::Error>,
) -> Result<Vec<u8>, Error> {
    let mut archive = Archive::Writes(Vec::new());
    let mut identity = identity(struck);
    let written =
        archive.keep(&mut identity).and_then(|()| archive.keep(&mut head)).and_then(|()| contents(&mut archive));
    written.map_err(|error| Error::Evaluation(format!("case {}: {error}", struck.name())))?;
    match archive {
        Archive::Writes(mut bytes) => {
            bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
            Ok(bytes)
        }
        Archive::Reads(_) => Ok(Vec::new()), // not reached
    }
}
