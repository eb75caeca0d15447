//! The known answers of an input file, `[[expect]]`.

use serde::Deserialize;
use toron_shared::spanned::Spanned;

use super::expect::Expected;
use toron_shared::checked::{Positive, value};
use toron_shared::error::Error;
use toron_shared::toml_file::Source;

/// The keys of a known answer.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(transform = toron_shared::schema::order::<Self>))]
#[serde(deny_unknown_fields)]
pub struct Expect {
    /// The material that it is of, by name. Default: all.
    pub material: Option<String>,
    /// Where the numbers are from. Required.
    #[cfg_attr(feature = "schema", schemars(required))]
    source: Option<Spanned<String>>,
    /// The end of a path of logarithmic strain, shears twice the tensor's, or a list of its corners; `"free"` where
    /// there is no stress.
    strain: Spanned<Path>,
    /// Cauchy's at the end of the path; `"any"` where it is not known.
    stress: Spanned<Vec<Entry>>,
    /// How far the stress may be from it, as a part of the largest component. Default: 1e-3.
    tolerance: Option<Positive>,
    /// How many increments lead from corner to corner, up to 100000. Default: 20.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 100_000)))]
    increments: Option<Spanned<usize>>,
    /// The time from corner to corner. Default: 1.
    time: Option<Positive>,
}

/// A number, "free" (a strain whose stress is zero) or "any" (a stress that is not known).
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "expected a number, \"free\" or \"any\"")]
enum Entry {
    Number(f64),
    Word(Word),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
enum Word {
    Free,
    Any,
}

/// The end of a path from the undeformed state, or its corners.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "expected numbers, \"free\" where there is no stress, or a list of such corners")]
enum Path {
    End(Vec<Entry>),
    Corners(Vec<Vec<Entry>>),
}

const MOST_INCREMENTS: usize = 100_000;

/// # Errors
/// A key says what is not allowed.
pub fn expected(source: &Source, given: &Expect, components: usize) -> Result<Expected, Error> {
    let corners = match given.strain.get_ref() {
        Path::End(end) => std::slice::from_ref(end),
        Path::Corners(corners) => corners,
    };
    let wrong_strain = || {
        let allowed = format!("{components} numbers, or \"free\" where there is no stress, or a list of such corners");
        source.error(given.strain.span(), &format!("strain is no path; allowed: {allowed}"))
    };
    let path = corners.iter().map(|corner| numbers(corner, Word::Free, components));
    let path: Vec<[Option<f64>; 6]> =
        path.collect::<Option<Vec<_>>>().filter(|path| !path.is_empty()).ok_or_else(wrong_strain)?;
    let stress =
        numbers(given.stress.get_ref(), Word::Any, components).filter(|stress| stress.iter().any(Option::is_some));
    let stress = stress.ok_or_else(|| {
        let allowed = format!("{components} numbers, or \"any\" where it is not known, at least one of them a number");
        source.error(given.stress.span(), &format!("stress is no answer; allowed: {allowed}"))
    })?;
    let Some(of) = &given.source else {
        let message = "a known answer without source; allowed: source = \"where the numbers are from\"";
        return Err(source.error(given.stress.span(), message));
    };
    let increments = match &given.increments {
        None => 20,
        Some(count) if (1..=MOST_INCREMENTS).contains(count.get_ref()) => *count.get_ref(),
        Some(count) => {
            let message = format!("increments is {}; allowed: 1 to {MOST_INCREMENTS}", count.get_ref());
            return Err(source.error(count.span(), &message));
        }
    };
    Ok(Expected {
        source: of.get_ref().clone(),
        path,
        stress,
        tolerance: value(&given.tolerance).unwrap_or(1e-3),
        increments,
        time: value(&given.time).unwrap_or(1.0),
    })
}

/// Of so many entries the numbers, where the word does not stand; none where there is anything else.
fn numbers(entries: &[Entry], word: Word, components: usize) -> Option<[Option<f64>; 6]> {
    let mut numbers = [Some(0.0); 6];
    for (number, entry) in numbers.iter_mut().zip(entries) {
        *number = match entry {
            Entry::Number(value) if value.is_finite() => Some(*value),
            Entry::Word(known) if *known == word => None,
            Entry::Number(_) | Entry::Word(_) => return None,
        };
    }
    for number in &mut numbers[components..] {
        *number = if word == Word::Any { None } else { Some(0.0) };
    }
    (entries.len() == components).then_some(numbers)
}
