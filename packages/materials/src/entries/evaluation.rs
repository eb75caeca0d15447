//! One point through a C entry as its host would call it, from a fresh state to an answer in the library's order: for
//! `eval`.

use std::f64::consts::SQRT_2;
use std::ptr::null_mut;

use super::blocks::{message_in, prepared};
use super::hosts::{
    CalculixPoint, Given, MgisPoint, MgisTangent, OnePoint, OpenradiossGroup, PointOutputs, Umat, call_point,
};
use super::precision::{BlockPrecision, VumatEntry};
use toron::Hyperelastic;
use toron::host::lsdyna::{UmatVector, UserRoutines, Utan, UtanVector};
use toron::host::openradioss::card;
use toron::host::{abaqus, lsdyna, mgis};
use toron::law::parameters::{FIBRE, HYPERELASTIC_PROPERTIES};
use toron::law::state::{ENERGIES, FAILED, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use toron::law::status;
use toron::law::stress::truesdell_of_jaumann;
use toron_c::{Block, Point};

/// The outputs of an entry: stress in the library's order, state, modes where it has them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Answer {
    pub status: i32,
    pub stress: [f64; 6],
    pub state: [f64; HYPERELASTIC_STATE],
    pub modes: Option<[[f64; 6]; 4]>,
    /// The Jaumann modulus of the Kirchhoff stress over J, in the library's order, where it is wanted and the entry has
    /// it.
    pub ddsdde: Option<[[f64; 6]; 6]>,
}

/// What a status means; for properties, which one is wrong.
pub fn message(code: i32, properties: &[f64; HYPERELASTIC_PROPERTIES]) -> String {
    let Err(message) = prepared(properties) else {
        let mut text = [0_u8; toron_c::TORON_MESSAGE_CAPACITY];
        // SAFETY: the text has the size passed.
        unsafe { toron_c::toron_status_message(code, text.as_mut_ptr().cast(), text.len()) };
        return message_in(&text);
    };
    message
}

/// One point in either precision, from its properties: stress and state as a solver asks for them, the modes by a call
/// of their own, DDSDDE by a third.
pub fn point<T: BlockPrecision>(properties: &[T; HYPERELASTIC_PROPERTIES], f: &[T; 9], tangent: bool) -> Answer {
    evaluate_point(Given::Properties(properties), f, tangent)
}

/// The same with a law that has been prepared.
pub fn prepared_point<T: BlockPrecision>(
    properties: &[T; HYPERELASTIC_PROPERTIES],
    f: &[T; 9],
    tangent: bool,
) -> Answer {
    match prepared(properties) {
        Ok(law) => evaluate_point(Given::Prepared(&law), f, tangent),
        Err(_) => point(properties, f, tangent),
    }
}

fn evaluate_point<T: BlockPrecision>(law: Given<'_, T>, f: &[T; 9], tangent: bool) -> Answer {
    let mut single = OnePoint::new(*f);
    OnePoint::call_each(std::slice::from_mut(&mut single), law, PointOutputs::State, &mut Default::default());
    let mut modes = [[T::default(); 6]; 4];
    let point = Point { deformation_gradient: f.as_ptr(), ..Point::empty() };
    // SAFETY: the arrays have the sizes that the entry asks for.
    unsafe { call_point(law, &Point { modes: modes.as_mut_ptr().cast(), ..point }) };
    let mut answer = Answer {
        status: single.status,
        stress: single.stress.map(Into::into),
        state: single.state.map(Into::into),
        modes: Some(modes.map(|mode| mode.map(Into::into))),
        ddsdde: None,
    };
    if tangent {
        let mut rows = [[T::default(); 6]; 6];
        let point = Point { measure: toron_c::TORON_TANGENT_JAUMANN, tangent: rows.as_mut_ptr().cast(), ..point };
        // SAFETY: as above.
        let status = unsafe { call_point(law, &point) };
        // This call asks for no stress, which alone may not fit the number format.
        if answer.status == status::OK {
            answer.status = status;
        } else {
            rows = [[T::default(); 6]; 6];
        }
        answer.ddsdde = Some(rows.map(|row| row.map(Into::into)));
    }
    answer
}

/// The deformations that stand beside the point in a block: rest, a stretched, a compacted and sheared one, and two
/// that cannot be evaluated, none of which may disturb it.
pub const NEIGHBOURS: [[f64; 9]; 5] = [
    [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [1.2, 0.0, 0.0, 0.1, 0.9, 0.0, 0.0, 0.2, 1.1],
    [0.9, 0.3, 0.0, 0.0, 0.6, 0.1, 0.5, 0.0, 0.8],
    [-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    [f64::NAN, 0.0, 0.0, 0.0, f64::INFINITY, 0.0, 0.0, 0.0, 1.0],
];

/// Where a line's point stands: the number of points of its block, its place in it, and the leading dimension.
pub fn place(line: usize) -> (usize, usize, usize) {
    let n = 1 + line * 7 % 23;
    (n, line * 5 % n, n + line % 4)
}

pub fn block<T: BlockPrecision>(
    properties: &[T; HYPERELASTIC_PROPERTIES],
    f: &[T; 9],
    line: usize,
    tangent: bool,
) -> Answer {
    let (n, at, stride) = place(line);
    let array = |components: usize| vec![T::default(); components * stride];
    let (mut gradient, mut fibre) = (array(9), array(3));
    for i in 0..n {
        for c in 0..9 {
            gradient[c * stride + i] = if i == at { f[c] } else { T::from_f64(NEIGHBOURS[(line + i) % 5][c]) };
        }
        for c in 0..3 {
            fibre[c * stride + i] = properties[FIBRE + c];
        }
    }
    let (mut stress, mut modes, mut state) = (array(6), array(24), array(HYPERELASTIC_STATE));
    let mut codes = vec![0; n];
    let part = |state: &mut Vec<T>, row: usize| state[row * stride..].as_mut_ptr();
    let mut rows = array(36);
    let mut block = Block {
        n,
        leading_dimension: stride,
        measure: toron_c::TORON_TANGENT_JAUMANN,
        energies: part(&mut state, ENERGIES),
        invariants: part(&mut state, INVARIANTS),
        failure: part(&mut state, FAILURE_INDEX),
        modes: modes.as_mut_ptr(),
        tangent: if tangent { rows.as_mut_ptr() } else { null_mut() },
        status: codes.as_mut_ptr(),
        ..Block::empty()
    };
    block.deformation_gradient[0] = gradient.as_ptr();
    block.stress[0] = stress.as_mut_ptr();
    // Every other line gives the direction point by point.
    if line.is_multiple_of(2) {
        block.fibre[0] = fibre.as_ptr();
    }
    let worst = match prepared(properties) {
        // SAFETY: the arrays have the sizes that the structure tells.
        Ok(law) => unsafe { T::BLOCK(&law, &block, null_mut(), 0) },
        // The code of wrong properties.
        Err(_) => point(properties, f, tangent).status,
    };
    let value = |array: &[T], c: usize| array[c * stride + at].into();
    let mut answer = Answer { status: codes[at], ..Answer::default() };
    if worst > status::INVERTED && worst != status::OK {
        answer.status = worst; // the call itself was refused, and no point has a code
    }
    answer.stress = std::array::from_fn(|c| value(&stress, c));
    answer.state = std::array::from_fn(|c| value(&state, c));
    answer.modes = Some(std::array::from_fn(|mode| std::array::from_fn(|c| value(&modes, 6 * mode + c))));
    answer.ddsdde = tangent.then(|| std::array::from_fn(|i| std::array::from_fn(|j| value(&rows, 6 * i + j))));
    answer
}

pub fn umat(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], tangent: bool) -> Answer {
    let (mut point, mut ddsdde) = (Umat::FRESH, [[0.0; 6]; 6]);
    let status = point.call(properties, f, tangent.then_some(&mut ddsdde));
    let Umat { stress: [s11, s22, s33, s12, s13, s23], statev, .. } = point;
    let order = [0, 1, 2, 3, 5, 4];
    Answer {
        status,
        stress: [s11, s22, s33, s12, s23, s13],
        state: statev,
        modes: None,
        ddsdde: tangent.then(|| order.map(|i| order.map(|j| ddsdde[i][j]))),
    }
}

/// The Cauchy stress through MGIS; with `tangent` dS/dE too, tensor components 11 22 33 12 13 23.
pub fn mgis(
    properties: &[f64; HYPERELASTIC_PROPERTIES],
    f: &[f64; 9],
    tangent: bool,
) -> (Answer, Option<[[f64; 6]; 6]>) {
    let mut host = MgisPoint::new(f);
    let request = if tangent { MgisTangent::Material } else { MgisTangent::None };
    if host.call(properties, request) != mgis::INTEGRATED {
        // MGIS gets a text and no code: it is the point entry's.
        let code = point(properties, f, tangent).status;
        let status = if code == status::OK { status::BAD_ARGUMENT } else { code };
        return (Answer { status, ..Answer::default() }, None);
    }
    let [s11, s22, s33, s12, s13, s23] = host.stress;
    let stress = [s11, s22, s33, s12 / SQRT_2, s23 / SQRT_2, s13 / SQRT_2];
    // MGIS gets √2 times the components 12, 13 and 23, on both sides. The quotient, rounded, is mostly the number that
    // has been multiplied.
    let without_factors = |i: usize, j: usize| {
        let entry = host.k[6 * i + j];
        match (i < 3, j < 3) {
            (true, true) => entry,
            (false, false) => entry / 2.0,
            _ => entry / SQRT_2,
        }
    };
    let material = tangent.then(|| std::array::from_fn(|i| std::array::from_fn(|j| without_factors(i, j))));
    (Answer { stress, state: host.state, ..Answer::default() }, material)
}

/// The second Piola–Kirchhoff stress through CalculiX, in place of the Cauchy stress, and dS/dE, tensor components;
/// both 11 22 33 12 13 23.
pub fn calculix(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9]) -> (Answer, [[f64; 6]; 6]) {
    // CalculiX gets a smaller increment and no code: it is the point entry's. For wrong properties the entry would end
    // the process.
    let status = point(properties, f, true).status;
    let mut host = CalculixPoint::new(*f);
    if status == status::OK || status <= status::INVERTED {
        host.call(properties);
    }
    let entry = |i: usize, j: usize| host.stiffness[if i <= j { i + j * (j + 1) / 2 } else { j + i * (i + 1) / 2 }];
    let material = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
    (Answer { status, stress: host.stress, state: host.state, ..Answer::default() }, material)
}

/// A VUMAT of one point at the stretch U, 11 22 33 12 23 31; the stress is the corotational one.
pub fn vumat<T: BlockPrecision>(
    properties: &[f64; HYPERELASTIC_PROPERTIES],
    stretch: [f64; 6],
    round: impl Fn(f64) -> T,
    entry: VumatEntry<T>,
) -> Answer {
    let stretch = stretch.map(&round);
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
        step_time: 1.0,
        total_time: 1.0,
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
        ..abaqus::Vumat::empty()
    };
    // SAFETY: the arrays have the sizes that the structure tells, for one point.
    let status = unsafe { entry(&block, null_mut(), 0) };
    Answer { status, stress: stress.map(Into::into), state: state.map(Into::into), ..Answer::default() }
}

/// LS-DYNA's material constants: 48 of them, the moduli for its time step at 12 and 13.
fn lsdyna_constants(properties: &[f64; HYPERELASTIC_PROPERTIES]) -> [f64; 48] {
    let mut cm = [0.0; 48];
    cm[..HYPERELASTIC_PROPERTIES].copy_from_slice(properties);
    let [bulk, shear] = [11, 12].map(|i| &raw mut cm[i]);
    // SAFETY: the arrays have the sizes that the entry asks for. Bad properties are the material routine's to report.
    unsafe { Hyperelastic::card_moduli(properties.as_ptr(), properties.len(), bulk, shear, null_mut(), 0) };
    cm
}

/// DDSDDE of a Truesdell modulus.
pub fn jaumann(truesdell: &[[f64; 6]; 6], stress: &[f64; 6]) -> [[f64; 6]; 6] {
    truesdell_of_jaumann(truesdell, &stress.map(|s| -s))
}

pub fn lsdyna(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], tangent: bool) -> Answer {
    let mut answer = Answer::default();
    let cm = lsdyna_constants(properties);
    let mut history = [0.0; HYPERELASTIC_STATE + 9];
    history[HYPERELASTIC_STATE..].copy_from_slice(f);
    let mut failed = 0;
    let element = lsdyna::Umat {
        cm: cm.as_ptr(),
        sig: answer.stress.as_mut_ptr(),
        hsv: history.as_mut_ptr(),
        nhv: HYPERELASTIC_STATE as i32,
        failel: &mut failed,
    };
    // SAFETY: the arrays have the sizes that the structure tells.
    answer.status = unsafe { Hyperelastic::umat(&element, null_mut(), 0) };
    answer.state.copy_from_slice(&history[..HYPERELASTIC_STATE]);
    answer.state[FAILED] = f64::from(failed);
    if tangent {
        let mut es = [[0.0; 6]; 6];
        // The element fails by its flag: the tangent of the intact one is wanted.
        history[FAILED] = 0.0;
        let (nhv, to) = (HYPERELASTIC_STATE as i32, es.as_mut_ptr().cast());
        let element = Utan { cm: cm.as_ptr(), hsv: history.as_ptr(), nhv, es: to };
        // SAFETY: as above.
        unsafe { Hyperelastic::utan(&element, null_mut(), 0) };
        answer.ddsdde = Some(jaumann(&es, &answer.stress));
    }
    answer
}

pub fn lsdyna_vector(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], line: usize, tangent: bool) -> Answer {
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
    let (lft, llt) = (first as i32 + 1, (first + n) as i32);
    let elements = UmatVector {
        cm: cm.as_ptr(),
        sig: [0, 1, 2, 3, 4, 5].map(|c| stress[c * nlq..].as_mut_ptr()),
        hsvs: history.as_mut_ptr(),
        nhv: HYPERELASTIC_STATE as i32,
        lft,
        llt,
        nlq: nlq as i32,
        failels: failed.as_mut_ptr(),
    };
    // SAFETY: the arrays have the sizes that the structure tells.
    let worst = unsafe { Hyperelastic::umat_vector(&elements, null_mut(), 0) };
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
        (_, true) => point(properties, f, false).status,
        _ => status::OK,
    };
    if tangent {
        let mut dsave = vec![0.0; 36 * nlq];
        history[FAILED * nlq..(FAILED + 1) * nlq].fill(0.0);
        let elements = UtanVector {
            cm: cm.as_ptr(),
            hsvs: history.as_ptr(),
            nhv: HYPERELASTIC_STATE as i32,
            lft,
            llt,
            nlq: nlq as i32,
            dsave: dsave.as_mut_ptr(),
        };
        // SAFETY: as above.
        unsafe { Hyperelastic::utan_vector(&elements, null_mut(), 0) };
        let truesdell = std::array::from_fn(|i| std::array::from_fn(|j| dsave[(6 * i + j) * nlq + at]));
        answer.ddsdde = Some(jaumann(&truesdell, &answer.stress));
    }
    answer
}

/// The point as an element amid others of a group.
pub fn openradioss(properties: &[f64; HYPERELASTIC_PROPERTIES], f: &[f64; 9], line: usize) -> Answer {
    let refused = |status| Answer { status, ..Answer::default() };
    let (n, at, _) = place(line);
    // Every other line has the direction in UVAR. That of the properties is checked first.
    let mut group = match OpenradiossGroup::new(n, properties, false) {
        Ok(group) => group,
        Err(status) => return refused(status),
    };
    if line.is_multiple_of(2) {
        group = OpenradiossGroup::new(n, properties, true).unwrap_or(group);
        for c in 0..3 {
            group.uvar[(card::HYPERELASTIC.fibre() + c) * n..][..n].fill(properties[FIBRE + c]);
        }
    }
    for i in 0..n {
        for c in 0..9 {
            group.gradient[c * OpenradiossGroup::<f64>::LENGTH + i] =
                if i == at { f[c] } else { NEIGHBOURS[(line + i) % 5][c] };
        }
    }
    let status = group.call();
    if status != status::OK {
        return refused(status);
    }
    let variable = |number: usize| group.uvar[number * n + at];
    Answer {
        status: variable(card::HYPERELASTIC.deleted()).min(0.0) as i32,
        stress: std::array::from_fn(|c| group.stress[c * OpenradiossGroup::<f64>::LENGTH + at]),
        state: std::array::from_fn(variable),
        ..Answer::default()
    }
}
