//! `toron eval`: one point a line, JSON in and JSON out, through any of the C entries as its host would call it.

use std::io::{self, BufRead, Write};
use std::ptr::{null, null_mut};

use serde::{Deserialize, Serialize};

use super::polar::polar_decomposition;
use crate::host::c_api::{self, Block};
use crate::host::{abaqus, lsdyna};
use crate::law::parameters::HYPERELASTIC_PROPERTIES;
use crate::law::state::{ENERGIES, FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use crate::law::status;

/// The C entry that evaluates a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// `toron_hyperelastic_point_f64`.
    Law,
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
}

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
    kel: f64,
    ktc: f64,
    p: f64,
    ktd: f64,
    #[serde(default)]
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
    #[serde(rename = "Sel", skip_serializing_if = "Option::is_none")]
    s_el: Option<[f64; 6]>,
    #[serde(rename = "Stc", skip_serializing_if = "Option::is_none")]
    s_tc: Option<[f64; 6]>,
    #[serde(rename = "Std", skip_serializing_if = "Option::is_none")]
    s_td: Option<[f64; 6]>,
    #[serde(rename = "Sld", skip_serializing_if = "Option::is_none")]
    s_ld: Option<[f64; 6]>,
}

/// What an entry gives back: stress in the library's order, state, modes where it has them.
#[derive(Clone, Copy, Default)]
struct Answer {
    status: i32,
    stress: [f64; 6],
    state: [f64; HYPERELASTIC_STATE],
    modes: Option<[[f64; 6]; 4]>,
}

/// Evaluates every line of `input`, from a fresh state each.
///
/// # Errors
/// Reading or writing fails. A line that cannot be read or evaluated is answered by a line with its status.
pub fn evaluate(entry: Entry, input: impl BufRead, mut output: impl Write) -> io::Result<()> {
    let mut number = 0;
    for line in input.split(b'\n') {
        let line = line?;
        number += 1;
        if line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        let answer = match serde_json::from_slice::<Input>(&line) {
            Ok(point) => evaluate_point(entry, &point, number),
            Err(error) => Output {
                status: status::BAD_ARGUMENT,
                message: Some(format!(
                    "line {number}: {error}; expected {{\"F\": 3×3 rows, \"m\": [3], \"params\": {{kel, ktc, p, ktd, \
                     kld, eps_lim, alpha, beta}}}}"
                )),
                ..Output::default()
            },
        };
        serde_json::to_writer(&mut output, &answer)?;
        output.write_all(b"\n")?;
    }
    output.flush()
}

fn evaluate_point(entry: Entry, point: &Input, line: usize) -> Output {
    let p = &point.params;
    let [m1, m2, m3] = point.m;
    let properties = [p.kel, p.ktc, p.p, p.ktd, p.kld, p.eps_lim, p.alpha, p.beta, m1, m2, m3];
    let f = point.f;
    let columns = [f[0][0], f[1][0], f[2][0], f[0][1], f[1][1], f[2][1], f[0][2], f[1][2], f[2][2]];
    let answer = match entry {
        Entry::Law => via_point(&properties, &columns),
        Entry::Block => via_block(&properties, &columns, line, c_api::toron_hyperelastic_block_f64),
        Entry::BlockF32 => {
            let single = |x: f64| x as f32;
            via_block(&properties.map(single), &columns.map(single), line, c_api::toron_hyperelastic_block_f32)
        }
        Entry::Umat => via_umat(&properties, &columns),
        Entry::Vumat => via_vumat(&properties, &f, |x| x, abaqus::toron_abaqus_vumat_f64),
        Entry::VumatSp => via_vumat(&properties, &f, |x| x as f32, abaqus::toron_abaqus_vumat_f32),
        Entry::LsDyna => via_lsdyna(&properties, &columns),
        Entry::LsDynaVector => via_lsdyna_vector(&properties, &columns, line),
    };
    // 11 22 33 12 23 31 to 11 22 33 12 13 23.
    let order = |s: [f64; 6]| [s[0], s[1], s[2], s[3], s[5], s[4]];
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
        message: (answer.status != status::OK).then(|| message(answer.status, &properties)),
        s_el: mode(0),
        s_tc: mode(1),
        s_td: mode(2),
        s_ld: mode(3),
    }
}

/// What a status means; for properties, which one is wrong.
fn message(code: i32, properties: &[f64; HYPERELASTIC_PROPERTIES]) -> String {
    let mut text = [0_u8; 512];
    let room = text.as_mut_ptr().cast();
    // SAFETY: the arrays have the sizes passed.
    let length = unsafe {
        match c_api::toron_hyperelastic_validate_f64(properties.as_ptr(), properties.len(), room, 512, null_mut()) {
            0 => c_api::toron_status_message(code, room, 512),
            length => length,
        }
    };
    String::from_utf8_lossy(&text[..length.min(511)]).into_owned()
}

fn via_point(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9]) -> Answer {
    let mut answer = Answer::default();
    let mut modes = [[0.0; 6]; 4];
    // SAFETY: the arrays have the sizes that the entry asks for.
    answer.status = unsafe {
        c_api::toron_hyperelastic_point_f64(
            properties.as_ptr(),
            properties.len(),
            f.as_ptr(),
            null(),
            null(),
            answer.state.as_mut_ptr(),
            answer.stress.as_mut_ptr(),
            modes.as_mut_ptr().cast(),
            1.0,
            null_mut(),
        )
    };
    answer.modes = Some(modes);
    answer
}

/// The deformations that stand beside the point in a block: rest, a stretched, a compacted and sheared one, and two that
/// cannot be evaluated, none of which may disturb it.
const NEIGHBOURS: [[f64; 9]; 5] = [
    [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [1.2, 0.0, 0.0, 0.1, 0.9, 0.0, 0.0, 0.2, 1.1],
    [0.9, 0.3, 0.0, 0.0, 0.6, 0.1, 0.5, 0.0, 0.8],
    [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [f64::NAN, 0.0, 0.0, 0.0, f64::INFINITY, 0.0, 0.0, 0.0, 1.0],
];

/// Where a line's point stands: the number of points of its block, its place in it, and the leading dimension.
fn place(line: usize) -> (usize, usize, usize) {
    let n = 1 + line * 7 % 23;
    (n, line * 5 % n, n + line % 4)
}

type BlockEntry<T> = unsafe extern "C" fn(*const T, usize, *const Block<T>) -> i32;

fn via_block<T: Copy + Default + Into<f64> + FromF64>(
    properties: &[T; HYPERELASTIC_PROPERTIES],
    f: &[T; 9],
    line: usize,
    entry: BlockEntry<T>,
) -> Answer {
    let (n, at, stride) = place(line);
    let array = |components: usize| vec![T::default(); components * stride];
    let (mut gradient, mut fibre) = (array(9), array(3));
    for i in 0..n {
        for c in 0..9 {
            gradient[c * stride + i] = if i == at { f[c] } else { T::from_f64(NEIGHBOURS[(line + i) % 5][c]) };
        }
        for c in 0..3 {
            fibre[c * stride + i] = properties[8 + c];
        }
    }
    let (mut stress, mut modes, mut state) = (array(6), array(24), array(HYPERELASTIC_STATE));
    let mut codes = vec![0; n];
    let part = |state: &mut Vec<T>, row: usize| state[row * stride..].as_mut_ptr();
    let block = Block {
        n,
        leading_dimension: stride,
        deformation_gradient: gradient.as_ptr(),
        // Every other line gives the direction point by point.
        fibre: if line.is_multiple_of(2) { fibre.as_ptr() } else { null() },
        energies_old: null(),
        invariants_old: null(),
        failure_old: null(),
        density: T::default(),
        stress: stress.as_mut_ptr(),
        energies: part(&mut state, ENERGIES),
        invariants: part(&mut state, INVARIANTS),
        failure: part(&mut state, FAILURE_INDEX),
        modes: modes.as_mut_ptr(),
        wave_speed: null_mut(),
        status: codes.as_mut_ptr(),
    };
    // SAFETY: the arrays have the sizes that the structure tells.
    let worst = unsafe { entry(properties.as_ptr(), properties.len(), &block) };
    let value = |array: &[T], c: usize| array[c * stride + at].into();
    let mut answer = Answer { status: codes[at], ..Answer::default() };
    if worst > status::INVERTED && worst != status::OK {
        answer.status = worst; // the call itself was refused, and no point has a code
    }
    answer.stress = std::array::from_fn(|c| value(&stress, c));
    answer.state = std::array::from_fn(|c| value(&state, c));
    answer.modes = Some(std::array::from_fn(|mode| std::array::from_fn(|c| value(&modes, 6 * mode + c))));
    answer
}

fn via_umat(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9]) -> Answer {
    let mut answer = Answer::default();
    let (mut sse, mut pnewdt, strain) = (0.0, 1.0, [0.0; 6]);
    let mut stress = [0.0; 6];
    // SAFETY: the arrays have the sizes that the entry asks for.
    answer.status = unsafe {
        abaqus::toron_abaqus_umat_f64(
            stress.as_mut_ptr(),
            answer.state.as_mut_ptr(),
            &mut sse,
            &mut pnewdt,
            strain.as_ptr(),
            strain.as_ptr(),
            f.as_ptr(),
            properties.as_ptr(),
            HYPERELASTIC_PROPERTIES as i32,
            HYPERELASTIC_STATE as i32,
            3,
            3,
        )
    };
    let [s11, s22, s33, s12, s13, s23] = stress;
    answer.stress = [s11, s22, s33, s12, s23, s13];
    answer
}

/// Plays Abaqus/Explicit: U goes in, the corotational stress comes out and is turned by R.
fn via_vumat<T: Copy + Default + Into<f64>>(
    properties: &[f64; HYPERELASTIC_PROPERTIES],
    f: &[[f64; 3]; 3],
    round: impl Fn(f64) -> T,
    entry: unsafe extern "C" fn(*const abaqus::Vumat<T>) -> i32,
) -> Answer {
    let (r, u) = polar_decomposition(f);
    let stretch = [u[0][0], u[1][1], u[2][2], u[0][1], u[1][2], u[2][0]].map(&round);
    let properties = properties.map(&round);
    let zeros = [T::default(); HYPERELASTIC_STATE];
    let one = [round(1.0)];
    let (mut stress, mut state, mut energy, mut inelastic) = ([T::default(); 6], zeros, [T::default()], [T::default()]);
    let block = abaqus::Vumat {
        nblock: 1,
        ndir: 3,
        nshr: 3,
        nstatev: HYPERELASTIC_STATE as i32,
        nprops: HYPERELASTIC_PROPERTIES as i32,
        step_time: one[0],
        total_time: one[0],
        props: properties.as_ptr(),
        density: one.as_ptr(),
        strain_inc: zeros.as_ptr(),
        stretch_old: stretch.as_ptr(),
        stretch_new: stretch.as_ptr(),
        stress_old: zeros.as_ptr(),
        state_old: zeros.as_ptr(),
        ener_intern_old: zeros.as_ptr(),
        ener_inelas_old: zeros.as_ptr(),
        stress_new: stress.as_mut_ptr(),
        state_new: state.as_mut_ptr(),
        ener_intern_new: energy.as_mut_ptr(),
        ener_inelas_new: inelastic.as_mut_ptr(),
    };
    // SAFETY: the arrays have the sizes that the structure tells, for one point.
    let status = unsafe { entry(&block) };
    let [s11, s22, s33, s12, s23, s31] = stress.map(Into::into);
    let corotational = [[s11, s12, s31], [s12, s22, s23], [s31, s23, s33]];
    let turned = |i: usize, j: usize| -> f64 {
        (0..3).map(|k| r[i][k] * (0..3).map(|l| corotational[k][l] * r[j][l]).sum::<f64>()).sum()
    };
    let stress = [turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(1, 2), turned(2, 0)];
    Answer {
        status,
        stress: if status == status::OK { stress } else { [0.0; 6] },
        state: state.map(Into::into),
        modes: None,
    }
}

/// LS-DYNA's material constants: 48 of them, the moduli for its time step at 12 and 13.
fn lsdyna_constants(properties: &[f64; HYPERELASTIC_PROPERTIES]) -> [f64; 48] {
    let mut cm = [0.0; 48];
    cm[..HYPERELASTIC_PROPERTIES].copy_from_slice(properties);
    let [bulk, shear] = [11, 12].map(|i| &raw mut cm[i]);
    // SAFETY: the arrays have the sizes that the entry asks for. Bad properties are the material routine's to report.
    unsafe { lsdyna::toron_lsdyna_bulk_and_shear_f64(properties.as_ptr(), properties.len(), bulk, shear) };
    cm
}

fn via_lsdyna(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9]) -> Answer {
    let mut answer = Answer::default();
    let cm = lsdyna_constants(properties);
    let mut history = [0.0; HYPERELASTIC_STATE + 9];
    history[HYPERELASTIC_STATE..].copy_from_slice(f);
    let mut failed = 0;
    // SAFETY: the arrays have the sizes that the entry asks for.
    answer.status = unsafe {
        lsdyna::toron_lsdyna_umat_f64(
            cm.as_ptr(),
            answer.stress.as_mut_ptr(),
            history.as_mut_ptr(),
            HYPERELASTIC_STATE as i32,
            &mut failed,
        )
    };
    answer.state.copy_from_slice(&history[..HYPERELASTIC_STATE]);
    answer.state[FAILED] = f64::from(failed);
    answer
}

fn via_lsdyna_vector(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], line: usize) -> Answer {
    let (n, at, stride) = place(line);
    // Elements lft to llt of nlq; what stands before them is not the block's.
    let (first, nlq) = (line % 3, stride + line % 3);
    let cm = lsdyna_constants(properties);
    let mut history = vec![0.0; (HYPERELASTIC_STATE + 9) * nlq];
    for i in 0..n {
        for c in 0..9 {
            history[(HYPERELASTIC_STATE + c) * nlq + first + i] =
                if i == at { f[c] } else { NEIGHBOURS[(line + i) % 5][c] };
        }
    }
    let mut stress = vec![0.0; 6 * nlq];
    let mut failed = vec![0; nlq];
    let [sig1, sig2, sig3, sig4, sig5, sig6] = [0, 1, 2, 3, 4, 5].map(|c| stress[c * nlq..].as_mut_ptr());
    // SAFETY: the arrays have the sizes that the entry asks for.
    let worst = unsafe {
        lsdyna::toron_lsdyna_umat_vector_f64(
            cm.as_ptr(),
            sig1,
            sig2,
            sig3,
            sig4,
            sig5,
            sig6,
            history.as_mut_ptr(),
            HYPERELASTIC_STATE as i32,
            first as i32 + 1,
            (first + n) as i32,
            nlq as i32,
            failed.as_mut_ptr(),
        )
    };
    let at = first + at;
    let mut answer = Answer {
        stress: std::array::from_fn(|c| stress[c * nlq + at]),
        state: std::array::from_fn(|c| history[c * nlq + at]),
        ..Answer::default()
    };
    answer.state[FAILED] = f64::from(failed[at]);
    // LS-DYNA sees no code an element, only that it failed; the point entry tells why where it was not the limit.
    let refused = worst > status::INVERTED && worst != status::OK;
    let unexplained = failed[at] != 0 && answer.state[FAILURE_INDEX] < 1.0;
    answer.status = match (refused, unexplained) {
        (true, _) => worst,
        (_, true) => via_point(properties, f).status,
        _ => status::OK,
    };
    answer
}

/// Rounding to the precision of an entry.
trait FromF64 {
    fn from_f64(x: f64) -> Self;
}

impl FromF64 for f64 {
    fn from_f64(x: f64) -> Self {
        x
    }
}

impl FromF64 for f32 {
    fn from_f64(x: f64) -> Self {
        x as f32
    }
}
