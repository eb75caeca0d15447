//! `toron eval`: one point a line, JSON in and JSON out, through any of the C entries as its host would call it.

use std::collections::BTreeMap;
use std::io::{self, BufRead, Write};
use std::marker::PhantomData;

use clap::ValueEnum;
use nalgebra::Matrix3;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use super::frictional;
use super::lines::{self, order};
use super::through::through;
use crate::entries::step::{Step, message};
use toron::Hyperelastic;
use toron::law::state::{ENERGIES, FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use toron::law::status;
use toron_shared::error::Error;
use toron_shared::toml_error::shortened;

/// The law of the lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Law {
    /// One step from rest: F, m and params with kel, ktc, p, ktd, kld, eps_lim, alpha, beta.
    Hyperelastic,
    /// Steps one after the other: "path", several F, or F, one; m; params by the names of the law's table; "before",
    /// slip_1, slip_2, i_te and w_fr at the start, 0 if left out. The answer has "after", what each step leaves.
    Frictional,
}

/// The C entry that evaluates a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Entry {
    /// `toron_hyperelastic_point_f64`, with the law prepared. Of another law each is the function of that name there.
    Law,
    /// `toron_hyperelastic_point_f32`, inputs rounded to single precision.
    LawF32,
    /// `toron_hyperelastic_point_with_properties_f64`.
    LawWithProperties,
    /// `toron_hyperelastic_point_with_properties_f32`, inputs rounded to single precision.
    LawWithPropertiesF32,
    /// `toron_hyperelastic_block_f64`, the point amid others.
    Block,
    /// `toron_hyperelastic_block_f32`, inputs rounded to single precision.
    BlockF32,
    /// `toron_abaqus_umat_f64`.
    Umat,
    /// `toron_abaqus_vumat_f64`; the driver forms U and R and turns the stress back.
    Vumat,
    /// `toron_abaqus_vumat_f32`; properties, U and outputs rounded to single precision.
    VumatSp,
    /// `toron_lsdyna_umat_f64`.
    LsDyna,
    /// `toron_lsdyna_umat_vector_f64`, the element amid others.
    LsDynaVector,
    /// `ToronHyperelastic_Tridimensional`, as MGIS calls it; the tangent is pushed forward from dS/dE.
    Mgis,
    /// `HYPERELASTIC`, as CalculiX calls it; stress and tangent are pushed forward from S and dS/dE.
    #[value(name = "calculix")]
    CalculiX,
    /// `toron_openradioss_luser_f64`, the element amid others.
    #[value(name = "openradioss")]
    OpenRadioss,
}

impl Entry {
    /// Whether the entry can answer with DDSDDE.
    pub(super) fn has_tangent(self) -> bool {
        !matches!(self, Entry::Vumat | Entry::VumatSp | Entry::OpenRadioss)
    }

    /// # Errors
    /// A tangent is wanted of an entry that has none.
    pub(super) fn check_tangent(self, wanted: bool, has_tangent: impl Fn(Entry) -> bool) -> Result<(), Error> {
        if !wanted || has_tangent(self) {
            return Ok(());
        }
        let others = Entry::value_variants().iter().filter(|entry| has_tangent(**entry)).map(|entry| entry.name());
        let others = others.collect::<Vec<_>>().join(", ");
        let name = self.name();
        Err(Error::Input(format!("--tangent with --via {name}, which has no DDSDDE; allowed with {others}")))
    }

    /// The name on the command line.
    fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_string())
    }
}

/// The keys of "params", each with its other spelling where it has one.
const PARAMS: [(&str, Option<&str>); 8] = [
    ("kel", Some("k_el")),
    ("ktc", Some("k_tc")),
    ("p", None),
    ("ktd", Some("k_td")),
    ("kld", Some("k_ld")),
    ("eps_lim", None),
    ("alpha", None),
    ("beta", None),
];
/// Those that may be left out: one that stands beside "params" would be missing in it without a word.
const OPTIONAL_PARAMS: [&str; 5] = ["kld", "k_ld", "eps_lim", "alpha", "beta"];

/// A line of input.
#[derive(Debug, Deserialize)]
struct Input {
    /// Rows of the deformation gradient.
    #[serde(rename = "F")]
    f: [[f64; 3]; 3],
    m: [f64; 3],
    params: Params,
}

#[derive(Debug, Deserialize)]
struct Params {
    #[serde(alias = "k_el")]
    kel: f64,
    #[serde(alias = "k_tc")]
    ktc: f64,
    p: f64,
    #[serde(alias = "k_td")]
    ktd: f64,
    #[serde(alias = "k_ld", default)]
    kld: f64,
    #[serde(default)]
    eps_lim: f64,
    #[serde(default)]
    alpha: f64,
    #[serde(default)]
    beta: f64,
}

/// A line of output. Stresses are 11 22 33 12 13 23.
#[derive(Debug, Default, Serialize)]
struct Output {
    iel: f64,
    itc: f64,
    itd: f64,
    ild: f64,
    wel: f64,
    wtc: f64,
    wtd: f64,
    wld: f64,
    sigma: [f64; 6],
    failed: bool,
    failure_index: f64,
    status: i32,
    #[serde(skip_serializing_if = "Option::is_none")]
    message: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ddsdde: Option<[[f64; 6]; 6]>,
    #[serde(rename = "Sel", skip_serializing_if = "Option::is_none")]
    s_el: Option<[f64; 6]>,
    #[serde(rename = "Stc", skip_serializing_if = "Option::is_none")]
    s_tc: Option<[f64; 6]>,
    #[serde(rename = "Std", skip_serializing_if = "Option::is_none")]
    s_td: Option<[f64; 6]>,
    #[serde(rename = "Sld", skip_serializing_if = "Option::is_none")]
    s_ld: Option<[f64; 6]>,
}

/// A key that a line has in the wrong place or that nothing reads, in words.
///
/// A record may have keys of its own beside F, m and params, but no parameter there; "params" has only what the law
/// knows.
fn wrong_key(line: &[u8]) -> Option<String> {
    let object: BTreeMap<String, IgnoredAny> = serde_json::from_slice(line).ok()?;
    if let Some(key) = OPTIONAL_PARAMS.into_iter().find(|&key| object.contains_key(key)) {
        return Some(format!("the key \"{key}\" stands beside \"params\"; allowed: within it"));
    }
    #[derive(Deserialize)]
    struct Keys {
        params: BTreeMap<String, IgnoredAny>,
    }
    let Keys { params } = serde_json::from_slice(line).ok()?;
    let known = |key: &str| PARAMS.iter().any(|&(name, other)| name == key || other == Some(key));
    let unknown = params.into_keys().find(|key| !known(key))?;
    let names = PARAMS.map(|(name, other)| other.map_or(name.to_string(), |other| format!("{name} ({other})")));
    Some(format!("\"params\" has the key \"{}\"; allowed: {}", shortened(&unknown), names.join(", ")))
}

/// `toron eval`: from the standard input to the standard output.
///
/// # Errors
/// Reading or writing fails; a tangent of an entry that has none.
pub fn lines(law: Law, entry: Entry, tangent: bool) -> Result<(), Error> {
    if law == Law::Frictional {
        return frictional::lines(entry, tangent);
    }
    entry.check_tangent(tangent, Entry::has_tangent)?;
    lines::standard(|input, output| evaluate(entry, tangent, input, output))
}

/// Evaluates every line of `input`, from a fresh state each; with `tangent` DDSDDE too, where the entry has a tangent.
///
/// # Errors
/// Reading or writing fails. A line that cannot be read or evaluated is answered by a line with its status.
pub fn evaluate(entry: Entry, tangent: bool, input: impl BufRead, output: impl Write) -> io::Result<()> {
    lines::answer(input, output, |line, number| {
        let expected =
            "expected {\"F\": 3×3 rows, \"m\": [3], \"params\": {kel, ktc, p, ktd, kld, eps_lim, alpha, beta}}";
        match (wrong_key(line), serde_json::from_slice::<Input>(line)) {
            (Some(reason), _) => refused(format!("line {number}: {reason}")),
            (None, Err(error)) => refused(format!("line {number}: {error}; {expected}")),
            (None, Ok(point)) => evaluate_point(entry, tangent, &point, number),
        }
    })
}

/// The answer to a line that is no point.
fn refused(message: String) -> Output {
    Output { status: status::BAD_ARGUMENT, message: Some(message), ..Output::default() }
}

fn evaluate_point(entry: Entry, tangent: bool, point: &Input, line: usize) -> Output {
    let p = &point.params;
    let [m1, m2, m3] = point.m;
    let properties = [p.kel, p.ktc, p.p, p.ktd, p.kld, p.eps_lim, p.alpha, p.beta, m1, m2, m3];
    let f = Matrix3::from(point.f).transpose();
    let columns: [f64; 9] = std::array::from_fn(|c| f[c]);
    let state = [0.0; HYPERELASTIC_STATE];
    let step =
        Step { properties: &properties, f: &columns, state: &state, tangent, line, law: PhantomData::<Hyperelastic> };
    let answer = through(entry, &step, &f);
    let mode = |i: usize| answer.modes.map(|modes| order(modes[i]));
    let state = answer.state;
    Output {
        wel: state[ENERGIES],
        wtc: state[ENERGIES + 1],
        wtd: state[ENERGIES + 2],
        wld: state[ENERGIES + 3],
        iel: state[INVARIANTS],
        itc: state[INVARIANTS + 1],
        itd: state[INVARIANTS + 2],
        ild: state[INVARIANTS + 3],
        failure_index: state[FAILURE_INDEX],
        failed: state[FAILED] == 1.0,
        sigma: order(answer.stress),
        status: answer.status,
        message: (answer.status != status::OK).then(|| message::<Hyperelastic, _>(answer.status, &properties)),
        ddsdde: answer.ddsdde.map(|rows| order(rows.map(order))),
        s_el: mode(0),
        s_tc: mode(1),
        s_td: mode(2),
        s_ld: mode(3),
    }
}
