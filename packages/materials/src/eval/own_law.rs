//! `eval` of a law of one's own: points as JSON, with the names of the law's tables.

use std::collections::BTreeMap;
use std::io::{self, BufRead, Write};

use clap::ValueEnum;
use nalgebra::Matrix3;
use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};

use super::lines::{self, order};
use crate::entries::step::{NEIGHBOURS, place};
use crate::material::own_law::{Own, OwnLaw, PointArrays};
use toron::Measure;
use toron::law::status;
use toron_shared::error::Error;
use toron_shared::toml_error::shortened;

/// How the law is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Entry {
    /// The point alone.
    Law,
    /// The point amid others.
    Block,
}

/// A line of input.
#[derive(Deserialize)]
struct Input {
    /// Rows of the deformation gradient.
    #[serde(rename = "F")]
    f: [[f64; 3]; 3],
    /// The fibre direction instead of that of `params`.
    m: Option<[f64; 3]>,
    /// Of a law that reads them: the length of the step, the time at its end, the temperature there.
    time_increment: Option<f64>,
    time: Option<f64>,
    temperature: Option<f64>,
    params: BTreeMap<String, f64>,
}

/// A line of output: the state by the names of its table, without the flag for element deletion. Stresses are 11 22 33
/// 12 13 23.
struct Output {
    law: &'static OwnLaw,
    sigma: [f64; 6],
    state: Vec<f64>,
    status: i32,
    message: Option<String>,
    ddsdde: Option<[[f64; 6]; 6]>,
}

impl Serialize for Output {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let description = &self.law.description;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("sigma", &self.sigma)?;
        for (i, (variable, value)) in description.state.iter().zip(&self.state).enumerate() {
            if i == description.failed {
                map.serialize_entry(variable.name, &(*value == 1.0))?;
            } else if i != description.alive {
                map.serialize_entry(variable.name, value)?;
            }
        }
        map.serialize_entry("status", &self.status)?;
        if let Some(message) = &self.message {
            map.serialize_entry("message", message)?;
        }
        if let Some(ddsdde) = &self.ddsdde {
            map.serialize_entry("ddsdde", ddsdde)?;
        }
        map.end()
    }
}

/// `eval`: from the standard input to the standard output.
///
/// # Errors
/// Reading or writing fails.
pub fn lines(law: &'static OwnLaw, entry: Entry, tangent: bool) -> Result<(), Error> {
    lines::standard(|input, output| evaluate(law, entry, tangent, input, output))
}

/// Evaluates every line of `input`, from a fresh state each; with `tangent` DDSDDE too.
///
/// # Errors
/// Reading or writing fails. A line that cannot be read or evaluated is answered by a line with its status.
pub fn evaluate(
    law: &'static OwnLaw,
    entry: Entry,
    tangent: bool,
    input: impl BufRead,
    output: impl Write,
) -> io::Result<()> {
    lines::answer(input, output, |line, number| {
        let refused = |status: i32, message: String| Output {
            law,
            sigma: [0.0; 6],
            state: vec![0.0; law.description.state.len()],
            status,
            message: Some(message),
            ddsdde: None,
        };
        let names: Vec<&str> = law.description.properties.iter().map(|property| property.name).collect();
        let point: Input = match serde_json::from_slice(line) {
            Ok(point) => point,
            Err(error) => {
                let expected = format!("{{\"F\": 3×3 rows, \"m\": [3], \"params\": {{{}}}}}", names.join(", "));
                return refused(status::BAD_ARGUMENT, format!("line {number}: {error}; expected {expected}"));
            }
        };
        let values = match properties(law, &point) {
            Ok(values) => values,
            Err(reason) => return refused(status::BAD_ARGUMENT, format!("line {number}: {reason}")),
        };
        match law.prepared(&values) {
            Ok(own) => evaluate_point(&own, entry, tangent, &point, number)
                .unwrap_or_else(|error| refused(error.code(), error.to_string())),
            Err(error) => refused(error.code(), error.to_string()),
        }
    })
}

/// The properties of a line, in the order of the law's table, with defaults for those that it leaves out.
fn properties(law: &OwnLaw, point: &Input) -> Result<Vec<f64>, String> {
    let table = law.description.properties;
    if let Some(unknown) = point.params.keys().find(|key| table.iter().all(|property| property.name != key.as_str())) {
        let names: Vec<&str> = table.iter().map(|property| property.name).collect();
        return Err(format!("\"params\" has the key \"{}\"; allowed: {}", shortened(unknown), names.join(", ")));
    }
    let mut values = Vec::new();
    for property in table {
        let given = point.params.get(property.name).copied().or(property.default);
        values.push(given.ok_or_else(|| {
            format!("\"params\" lacks {} ({}); allowed: {}", property.name, property.meaning, property.allowed)
        })?);
    }
    if let Some(m) = point.m {
        let fibre = law.description.fibre_components();
        if fibre.is_empty() {
            return Err("\"m\" is the fibre direction of a law that has none".to_string());
        }
        values[fibre].copy_from_slice(&m);
    }
    Ok(values)
}

/// # Errors
/// The law reads what the line does not give.
fn evaluate_point(own: &Own, entry: Entry, tangent: bool, input: &Input, line: usize) -> Result<Output, toron::Error> {
    let f = Matrix3::from(input.f).transpose();
    let (n, at, stride) = if entry == Entry::Law { (1, 0, 1) } else { place(line) };
    let mut points = own.at_rest(n, stride, tangent.then_some(Measure::Jaumann));
    for i in 0..n {
        let gradient = if i == at { f.as_slice() } else { &NEIGHBOURS[(line + i) % NEIGHBOURS.len()] };
        for (c, &entry) in gradient.iter().enumerate() {
            points.f[c * stride + i] = entry;
        }
    }
    let (time, increment) = (input.time.unwrap_or(f64::NAN), input.time_increment.unwrap_or(f64::NAN));
    (points.time, points.time_increment) = (time, increment);
    points.temperature = input.temperature.map_or(Vec::new(), |temperature| vec![temperature; stride]);
    own.try_step(&mut points)?;
    let PointArrays { stress, state, tangent, status, .. } = &points;
    let value = |array: &[f64], c: usize| array[c * stride + at];
    let rows = || std::array::from_fn(|i| std::array::from_fn(|j| value(tangent, 6 * i + j)));
    let status = status[at];
    Ok(Output {
        law: own.law,
        sigma: order(std::array::from_fn(|c| value(stress, c))),
        state: (0..own.law.description.state.len()).map(|c| value(state, c)).collect(),
        status,
        message: status::meaning(status).filter(|_| status != status::OK).map(str::to_string),
        ddsdde: points.measure.map(|_| order(rows().map(order))),
    })
}
