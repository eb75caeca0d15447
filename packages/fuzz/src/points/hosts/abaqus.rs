//! A UMAT and a VUMAT.

use std::ptr::null_mut;

use toron::host::abaqus::Vumat;
use toron_c::{toron_abaqus_frictional_umat_f64, toron_abaqus_linear_umat_f64, toron_abaqus_umat_tangent_f64};

use super::{NOBODYS, OTHERS, back, card, doubles, put};
use crate::points::arrays::{Array, guard};
use crate::points::case::{Case, Law, with};
use crate::points::entries::{Inputs, Outcome};
use crate::points::functions::{Functions, Message};

/// Where Abaqus has the law's components 11 22 33 12 23 31.
const IN_ABAQUS: [usize; 6] = [0, 1, 2, 3, 5, 4];

/// The components of U, 11 22 33 12 23 31, among F by columns.
const OF_STRETCH: [usize; 6] = [0, 4, 8, 3, 7, 6];

pub fn umat<T: Functions>(case: &Case, inputs: &mut Inputs<T>, outcome: &mut Outcome<T>, message: &mut Message) -> i32 {
    let (point, states) = (&case.points[0], case.law.state());
    let properties = doubles(card(case, inputs));
    let (mut stress, mut ddsdde) = ([guard::<f64>(); 6], [guard::<f64>(); 36]);
    let mut statev = [&point.state[..], &[point.limit, NOBODYS]].concat();
    let [mut sse, mut spd, mut pnewdt] = [guard::<f64>(), guard(), 1.0];
    let tangent = if case.asks(with::TANGENT) { ddsdde.as_mut_ptr() } else { null_mut() };
    let (count, nstatv) = (properties.len() as i32, statev.len() as i32);
    let (s, v, f0, f1) = (stress.as_mut_ptr(), statev.as_mut_ptr(), point.f_old.as_ptr(), point.f.as_ptr());
    let (props, text, capacity) = (properties.as_ptr(), message.as_mut_ptr(), message.len());
    // SAFETY: the arrays have the sizes that the counts say.
    let code = unsafe {
        match case.law {
            Law::Hyperelastic => toron_abaqus_umat_tangent_f64(
                s,
                v,
                tangent,
                &mut sse,
                &mut pnewdt,
                f1,
                props,
                count,
                nstatv,
                3,
                3,
                1,
                text,
                capacity,
            ),
            Law::Frictional => toron_abaqus_frictional_umat_f64(
                s,
                v,
                tangent,
                &mut sse,
                &mut spd,
                &mut pnewdt,
                f1,
                props,
                count,
                nstatv,
                3,
                3,
                1,
                text,
                capacity,
            ),
            Law::Linear => toron_abaqus_linear_umat_f64(
                s,
                v,
                tangent,
                &mut sse,
                &mut pnewdt,
                f0,
                f1,
                props,
                count,
                nstatv,
                3,
                3,
                1,
                text,
                capacity,
            ),
        }
    };
    put(&mut outcome.stress, &IN_ABAQUS.map(|c| stress[c]));
    put(&mut outcome.state, &statev[..states]);
    for (c, value) in ddsdde.iter().enumerate() {
        let [row, column] = [IN_ABAQUS[c % 6], IN_ABAQUS[c / 6]];
        outcome.tangent.set(6 * row + column, 0, back(*value));
    }
    outcome.beside = vec![sse, pnewdt, spd];
    outcome.input_written = statev[states].to_bits() != point.limit.to_bits() || statev[states + 1] != NOBODYS;
    code
}

pub fn vumat<T: Functions>(
    case: &Case,
    inputs: &mut Inputs<T>,
    outcome: &mut Outcome<T>,
    message: &mut Message,
) -> i32 {
    let (n, states) = (case.points.len(), case.law.state());
    let properties = card(case, inputs);
    let mut stretch = [Array::<T>::plain(6, n), Array::plain(6, n)];
    let mut old = Array::<T>::plain(states + OTHERS, n);
    for (i, point) in case.points.iter().enumerate() {
        for (c, place) in OF_STRETCH.into_iter().enumerate() {
            stretch[0].set(c, i, T::splat(point.f_old[place]));
            stretch[1].set(c, i, T::splat(point.f[place]));
        }
        for (c, &value) in point.state.iter().chain(&[point.limit, NOBODYS]).enumerate() {
            old.set(c, i, T::splat(value));
        }
    }
    let zeros = vec![T::splat(0.0); 6 * n];
    let density = vec![T::splat(case.density); n];
    let mut new = Array::<T>::plain(states + OTHERS, n);
    let [mut intern, mut inelas] = [Array::<T>::plain(1, n), Array::plain(1, n)];
    let block = Vumat {
        nblock: n as i32,
        ndir: 3,
        nshr: 3,
        nstatev: (states + OTHERS) as i32,
        nprops: properties.len() as i32,
        level: case.level,
        step_time: 1.0,
        total_time: 1.0,
        props: properties.as_ptr(),
        density: density.as_ptr(),
        strain_inc: zeros.as_ptr(),
        stretch_old: stretch[0].pointer(0),
        stretch_new: stretch[1].pointer(0),
        stress_old: zeros.as_ptr(),
        state_old: old.pointer(0),
        ener_intern_old: zeros.as_ptr(),
        ener_inelas_old: zeros.as_ptr(),
        stress_new: outcome.stress.pointer(0),
        state_new: new.pointer(0),
        ener_intern_new: intern.pointer(0),
        ener_inelas_new: inelas.pointer(0),
        ..Vumat::empty()
    };
    // SAFETY: the arrays have the components of as many points.
    let code = unsafe { T::vumat(case.law, &block, message) };
    let mut strange = new.written_padding().or(intern.written_padding()).or(inelas.written_padding()).is_some();
    for i in 0..n {
        for c in 0..states {
            outcome.state.set(c, i, new.get(c, i));
        }
        let copied = (states..states + OTHERS).all(|c| new.get(c, i).bits() == old.get(c, i).bits());
        let untouched = (states..states + OTHERS).all(|c| new.get(c, i).bits() == guard::<T>().bits());
        strange |= !copied && !untouched;
        outcome.beside.extend([intern.get(0, i), inelas.get(0, i)].map(Into::<f64>::into));
    }
    outcome.input_written = strange;
    code
}
