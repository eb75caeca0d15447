//! `toron eval --law frictional`: paths of points as JSON, step by step, through any of the C entries.

use std::collections::BTreeMap;
use std::io::{self, BufRead, Write};
use std::marker::PhantomData;

use nalgebra::Matrix3;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use super::command::Entry;
use super::lines::{self, order};
use super::through::through;
use crate::entries::step::{Answer, Step, message};
use toron::Frictional;
use toron::law::parameters::{FIBRE, FRICTIONAL, FRICTIONAL_PROPERTIES as PROPERTIES, Property};
use toron::law::state::{self, FRICTIONAL_STATE as STATE};
use toron::law::status;
use toron_shared::error::Error;
use toron_shared::toml_error::shortened;

/// A line of input.
#[derive(Deserialize)]
struct Input {
    /// Rows of the deformation gradient at the end of the only step, or of each.
    #[serde(rename = "F")]
    f: Option<[[f64; 3]; 3]>,
    path: Option<Vec<[[f64; 3]; 3]>>,
    m: Option<[f64; 3]>,
    #[serde(alias = "properties")]
    params: BTreeMap<String, f64>,
    /// Both components of the slip, I_te and the energy lost before the first step; all 0 where it is left out.
    before: Option<[f64; 4]>,
    /// Keys of the record's own.
    #[serde(flatten)]
    others: BTreeMap<String, IgnoredAny>,
}

/// What a step leaves. Stresses are 11 22 33 12 13 23.
#[derive(Serialize)]
struct After {
    sigma: [f64; 6],
    #[serde(flatten)]
    state: BTreeMap<&'static str, f64>,
    slip: [f64; 2],
    failed: bool,
    status: i32,
    #[serde(skip_serializing_if = "Option::is_none")]
    message: Option<String>,
}

/// A line of output: of each step what it leaves, and DDSDDE of the last one.
#[derive(Default, Serialize)]
struct Output {
    after: Vec<After>,
    status: i32,
    #[serde(skip_serializing_if = "Option::is_none")]
    message: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ddsdde: Option<[[f64; 6]; 6]>,
}

/// The places of the slip and of I_te in the state.
const I_TE: usize = state::FRICTIONAL_LOST + 1;
const SLIP: usize = I_TE + 1;

/// Whether the entry can answer with DDSDDE: LS-DYNA's tangent is that of a further step, whose fibres hold.
pub fn has_tangent(entry: Entry) -> bool {
    entry.has_tangent() && !matches!(entry, Entry::LsDyna | Entry::LsDynaVector)
}

/// From the standard input to the standard output.
///
/// # Errors
/// Reading or writing fails; a tangent of an entry that has none.
pub fn lines(entry: Entry, tangent: bool) -> Result<(), Error> {
    entry.check_tangent(tangent, has_tangent)?;
    lines::standard(|input, output| evaluate(entry, tangent, input, output))
}

/// Evaluates the path of every line of `input`; with `tangent` DDSDDE of its last step too, where the entry has a
/// tangent.
///
/// # Errors
/// Reading or writing fails. A line that cannot be read is answered by a line with its status.
pub fn evaluate(entry: Entry, tangent: bool, input: impl BufRead, output: impl Write) -> io::Result<()> {
    lines::answer(input, output, |line, number| {
        let expected =
            "expected {\"F\": 3×3 rows, or \"path\": several, \"m\": [3], \"params\": {k_el, k_tc, …, mu, cohesion}}";
        let read = serde_json::from_slice::<Input>(line).map_err(|error| format!("{error}; {expected}"));
        let found = read.and_then(|input| Ok((properties(&input)?, path(&input)?, input.before.unwrap_or_default())));
        match found {
            Ok((properties, path, before)) => evaluate_path(entry, tangent, &properties, &path, before, number),
            Err(reason) => {
                let message = Some(format!("line {number}: {reason}"));
                Output { status: status::BAD_ARGUMENT, message, ..Output::default() }
            }
        }
    })
}

/// The properties of a line, in the order of the table, with defaults for those that it leaves out.
fn properties(input: &Input) -> Result<[f64; PROPERTIES], String> {
    let names = || FRICTIONAL.iter().map(|property| property.name).collect::<Vec<_>>().join(", ");
    let known = |key: &str| FRICTIONAL.iter().any(|property| property.name == key);
    if let Some(unknown) = input.params.keys().find(|key| !known(key)) {
        return Err(format!("\"params\" has the key \"{}\"; allowed: {}", shortened(unknown), names()));
    }
    if let Some(key) = input.others.keys().find(|key| known(key)) {
        return Err(format!("the key \"{key}\" stands beside \"params\"; allowed: within it"));
    }
    let mut values = [0.0; PROPERTIES];
    for (to, Property { name, meaning, allowed, default, .. }) in values.iter_mut().zip(&FRICTIONAL) {
        let given = input.params.get(*name).copied().or(*default);
        *to = given.ok_or_else(|| format!("\"params\" lacks {name} ({meaning}); allowed: {allowed}"))?;
    }
    if let Some(m) = input.m {
        values[FIBRE..FIBRE + 3].copy_from_slice(&m);
    }
    Ok(values)
}

/// The deformation gradients at the ends of the steps.
fn path(input: &Input) -> Result<Vec<Matrix3<f64>>, String> {
    let rows = match (&input.f, &input.path) {
        (Some(f), None) => std::slice::from_ref(f),
        (None, Some(path)) if !path.is_empty() => path,
        _ => return Err("\"F\" or \"path\" is missing, or both are there; allowed: one of them".to_string()),
    };
    Ok(rows.iter().map(|&rows| Matrix3::from(rows).transpose()).collect())
}

fn evaluate_path(
    entry: Entry,
    tangent: bool,
    properties: &[f64; PROPERTIES],
    path: &[Matrix3<f64>],
    [slip_1, slip_2, i_te, lost]: [f64; 4],
    line: usize,
) -> Output {
    let mut old = [0.0; STATE];
    old[state::FRICTIONAL_LOST..SLIP + 2].copy_from_slice(&[lost, i_te, slip_1, slip_2]);
    let mut output = Output::default();
    for (i, f) in path.iter().enumerate() {
        let columns: [f64; 9] = std::array::from_fn(|c| f[c]);
        let tangent = tangent && i + 1 == path.len();
        let step = Step { properties, f: &columns, state: &old, tangent, line, law: PhantomData::<Frictional> };
        let answer = through(entry, &step, f);
        old = answer.state;
        output.ddsdde = answer.ddsdde.map(|rows| order(rows.map(order)));
        output.status = output.status.min(answer.status);
        output.after.push(after(&answer, properties));
    }
    output
}

fn after(answer: &Answer<STATE>, properties: &[f64; PROPERTIES]) -> After {
    let numbers = state::FRICTIONAL.iter().zip(answer.state).take(state::FRICTIONAL_FAILED);
    After {
        sigma: order(answer.stress),
        state: numbers.map(|(variable, value)| (variable.name, value)).collect(),
        slip: [answer.state[SLIP], answer.state[SLIP + 1]],
        failed: answer.state[state::FRICTIONAL_FAILED] == 1.0,
        status: answer.status,
        message: (answer.status != status::OK).then(|| message::<Frictional, _>(answer.status, properties)),
    }
}
