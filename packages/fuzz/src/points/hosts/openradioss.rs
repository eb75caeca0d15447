//! OpenRadioss: the starter's routine with the card, then the engine's with a group.

use std::ptr::{null, null_mut};

use toron::host::openradioss::{Group, MaterialCard};

use super::{among_others, say_refused};
use crate::points::arrays::Array;
use crate::points::case::{Case, Law, group, with};
use crate::points::checks::has_failed;
use crate::points::entries::{Inputs, Outcome};
use crate::points::functions::{Functions, Message};

/// nn of `/MAT/USERnn`.
fn number(law: Law) -> i32 {
    match law {
        Law::Hyperelastic => 1,
        Law::Linear => 2,
        Law::Frictional => 3,
    }
}

/// The places of the components of a gradient by columns: XX YY ZZ XY YZ ZX YX ZY XZ.
const GRADIENT: [usize; 9] = [0, 4, 8, 3, 7, 2, 1, 5, 6];

/// Of the user variables behind the state: the fibre, and `deleted`.
const FIBRE: usize = 3;

/// Whether a case is of the first cycle.
pub fn is_first_cycle(case: &Case) -> bool {
    case.seed & 2 != 0
}

/// The values of the card: properties, and options.
fn card<T: Functions>(case: &Case, inputs: &Inputs<T>) -> Vec<T> {
    let at = case.law.fibre();
    let given = inputs.properties[at..at + 3].iter().any(|&x| x.into() != 0.0);
    // A direction 0 0 0 of the card is allowed beside others, and refused by the block.
    let fibre_from = if case.asks(with::FIBRE) && given { 2 } else { 0 };
    let own: &[i32] = if case.law.is_linear() { &[case.rotation, case.criterion] } else { &[] };
    let options = [&[fibre_from], own, &[case.asks(with::LIMIT).into()]].concat();
    inputs.properties.iter().copied().chain(options.into_iter().map(|x| T::splat(x.into()))).collect()
}

pub fn group_of_elements<T: Functions>(
    case: &Case,
    inputs: &mut Inputs<T>,
    outcome: &mut Outcome<T>,
    message: &mut Message,
) -> i32 {
    let (n, states) = (case.points.len(), case.law.state());
    let (values, mut uparam, mut parmat) = (card(case, inputs), [T::splat(0.0); 32], T::splat(0.0));
    let [mut nuparam, mut nuvar] = [0; 2];
    let read = MaterialCard {
        number: number(case.law),
        values: values.as_ptr(),
        count: values.len(),
        uparam: uparam.as_mut_ptr(),
        maxuparam: uparam.len() as i32,
        nuparam: &mut nuparam,
        nuvar: &mut nuvar,
        parmat: &mut parmat,
    };
    // SAFETY: the arrays have the sizes that the structure says.
    let code = unsafe { T::lecm(&read, message) };
    if code != 0 {
        return code;
    }
    let deleted = states + FIBRE;
    let mut uvar = Array::<T>::plain(nuvar as usize, n);
    for (i, point) in case.points.iter().enumerate() {
        let kept = &point.f_old[..case.law.kept()];
        let limit: &[f64] = if case.asks(with::LIMIT) { &[point.limit] } else { &[] };
        let row = [&point.state[..], &point.fibre, &[0.0], kept, limit, &[0.0; 3]].concat();
        for (c, &value) in row.iter().enumerate() {
            uvar.set(c, i, T::splat(value));
        }
    }
    let before = uvar.clone();
    let mut f = Array::<T>::new(9, n, among_others(case, group::GRADIENT), n);
    let mut stress = Array::<T>::new(6, n, among_others(case, group::STRESS), n);
    let mut off = Array::<T>::plain(1, n);
    for (i, point) in case.points.iter().enumerate() {
        for c in 0..9 {
            f.set(c, i, T::splat(point.f[c]));
        }
        // Of an element that has failed the solver may know, or not yet; then it is out for its reasons.
        let is_state = point.state.iter().all(|&x| (x as f32).is_finite());
        let out = is_state && has_failed(T::splat(point.state[case.law.failed()]).into()) && case.seed & 4 != 0;
        off.set(0, i, T::splat(f64::from(u8::from(!out))));
    }
    let f_before = f.clone();
    let density = T::splat(case.density);
    let call = Group {
        elements: n as i32,
        parameters: nuparam,
        variables: nuvar,
        time: T::splat(f64::from(u8::from(!is_first_cycle(case)))),
        time_step: T::splat(1.0),
        uparam: uparam.as_ptr(),
        numbers: null(),
        density: &density,
        deformation_gradient: GRADIENT.map(|place| f.pointer(place).cast_const()),
        stress: std::array::from_fn(|c| stress.pointer(c)),
        viscous: [null_mut(); 6],
        sound_speed: outcome.wave_speed.pointer(0),
        viscosity: null_mut(),
        uvar: uvar.pointer(0),
        off: off.pointer(0),
        nodes: null(),
        volume: null(),
    };
    // SAFETY: the arrays have the values of as many elements.
    let code = unsafe { T::luser(&call, message) };
    outcome.beside.push(code.into());
    let mut strange = !f.is_as(&f_before);
    strange |= [&uvar, &stress, &off].into_iter().any(|array| array.written_padding().is_some());
    let mut worst = 0;
    for i in 0..n {
        for c in 0..states {
            outcome.state.set(c, i, uvar.get(c, i));
        }
        for c in 0..6 {
            outcome.stress.set(c, i, stress.get(c, i));
        }
        let reason: f64 = uvar.get(deleted, i).into();
        worst = worst.min(reason as i32);
        let failed = has_failed(uvar.get(case.law.failed(), i).into());
        let off: f64 = off.get(0, i).into();
        strange |= code == 0 && (off != f64::from(u8::from(!failed)) || (reason == 0.0) == failed || reason > 2.0);
        // The fibre, the limit and the diagonal are the model's.
        for c in (states..deleted).chain(deleted + 1 + case.law.kept()..nuvar as usize) {
            strange |= uvar.get(c, i).bits() != before.get(c, i).bits();
        }
    }
    outcome.input_written |= strange;
    if code == 0 && worst < 0 {
        say_refused(message);
    }
    code.min(worst)
}
