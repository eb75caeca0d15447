//! LS-DYNA: the material and its tangent, vectorised, and of one element the scalar ones in every other case.

use toron::host::lsdyna::{Umat, UmatVector, Utan, UtanVector};
use toron_c::TORON_MESSAGE_CAPACITY;

use super::among_others;
use crate::points::arrays::Array;
use crate::points::case::{Case, Placing, group};
use crate::points::checks::{POINT_CODES, has_failed};
use crate::points::entries::{Inputs, NO_STATUS, Outcome};
use crate::points::functions::{Functions, Message};

const IDENTITY: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Whether a case goes through the routines of one element.
pub fn is_scalar(case: &Case) -> bool {
    case.points.len() == 1 && case.seed.is_multiple_of(2)
}

pub fn elements<T: Functions>(
    case: &Case,
    inputs: &mut Inputs<T>,
    outcome: &mut Outcome<T>,
    message: &mut Message,
) -> i32 {
    let (n, states) = (case.points.len(), case.law.state());
    let nhv = states + case.law.kept();
    let placing = if is_scalar(case) { Placing::default() } else { among_others(case, group::STATE) };
    let (lft, llt) = (placing.offset as i32 + 1, (placing.offset + n) as i32);
    let nlq = (n + placing.gap) as i32;
    let mut history = Array::<T>::new(nhv + 9, n, placing, n);
    for (i, point) in case.points.iter().enumerate() {
        // Before its first step an element has zeros.
        let is_new = point.state.iter().all(|&x| x == 0.0) && point.f_old == IDENTITY;
        let kept = if is_new { &[0.0; 9] } else { &point.f_old };
        let kept = &kept[..case.law.kept()];
        for (c, &value) in point.state.iter().chain(kept).chain(&point.f).enumerate() {
            history.set(c, i, T::splat(value));
        }
    }
    let before = history.clone();
    let mut stress = Array::<T>::new(6, n, placing, n);
    let mut failed = vec![NO_STATUS; placing.offset + n + placing.gap];
    let nhv = nhv as i32;
    let (cm, hsvs, failels) = (inputs.properties.as_ptr(), history.values.as_mut_ptr(), failed.as_mut_ptr());
    let code = if is_scalar(case) {
        let call = Umat { cm, sig: stress.values.as_mut_ptr(), hsv: hsvs, nhv, failel: failels };
        // SAFETY: the arrays have the values of one element.
        unsafe { T::umat(case.law, &call, message) }
    } else {
        let leading = nlq as usize;
        let sig = std::array::from_fn(|c| stress.values.as_mut_ptr().wrapping_add(c * leading));
        let call = UmatVector { cm, sig, hsvs, nhv, lft, llt, nlq, failels };
        // SAFETY: the arrays have the values of `nlq` elements.
        unsafe { T::umat_vector(case.law, &call, message) }
    };
    let evaluated = code == 0 || POINT_CODES.contains(&code);
    if evaluated && case.seed & 2 != 0 {
        let (written, mut tangent) = (history.clone(), Array::<T>::new(36, n, placing, n));
        let mut own: Message = [0; TORON_MESSAGE_CAPACITY];
        let (hsvs, dsave) = (history.values.as_ptr(), tangent.values.as_mut_ptr());
        let code = if is_scalar(case) {
            // SAFETY: as above.
            unsafe { T::utan(case.law, &Utan { cm, hsv: hsvs, nhv, es: dsave }, &mut own) }
        } else {
            let call = UtanVector { cm, hsvs, nhv, lft, llt, nlq, dsave };
            // SAFETY: as above.
            unsafe { T::utan_vector(case.law, &call, &mut own) }
        };
        outcome.input_written |= !history.is_as(&written) || (code == 0) != (own[0] == 0);
        outcome.input_written |= tangent.written_padding().is_some();
        outcome.further = Some((code, tangent));
    }
    let mut strange = [&history, &stress].into_iter().any(|array| array.written_padding().is_some());
    for i in 0..n {
        for c in 0..states {
            outcome.state.set(c, i, history.get(c, i));
        }
        for c in 0..6 {
            outcome.stress.set(c, i, stress.get(c, i));
        }
        for c in 0..9 {
            let new = before.get(nhv as usize + c, i).bits();
            strange |= history.get(nhv as usize + c, i).bits() != new;
            if case.law.kept() > 0 {
                let kept = history.get(states + c, i).bits();
                let old = [before.get(states + c, i), T::splat(case.points[i].f_old[c])];
                strange |= kept != new && old.iter().all(|old| old.bits() != kept);
            }
        }
        let flag = failed[placing.offset + i];
        let expected = if evaluated { has_failed(history.get(case.law.failed(), i).into()).into() } else { NO_STATUS };
        strange |= flag != expected;
    }
    strange |= failed[..placing.offset].iter().chain(&failed[placing.offset + n..]).any(|&flag| flag != NO_STATUS);
    outcome.input_written |= strange;
    code
}
