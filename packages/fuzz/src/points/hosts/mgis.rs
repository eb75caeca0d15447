//! MGIS.

use std::ptr::{null, null_mut};

use toron::host::mgis::{BehaviourDataView, MgisLaw, StateView};
use toron::{Frictional, Hyperelastic, LinearElastic};

use super::{back, doubles, put};
use crate::points::arrays::guard;
use crate::points::case::{Case, Law, with};
use crate::points::entries::{Inputs, Outcome};
use crate::points::functions::{Functions, Message};

/// Where MFront has F and the law's symmetric components; shears there are √2 times as large.
const GRADIENT_IN_MFRONT: [usize; 9] = [0, 4, 8, 3, 1, 6, 2, 7, 5];
const IN_MFRONT: [usize; 6] = [0, 1, 2, 3, 5, 4];

pub fn mgis<T: Functions>(case: &Case, inputs: &mut Inputs<T>, outcome: &mut Outcome<T>, message: &mut Message) -> i32 {
    let point = &case.points[0];
    let properties = doubles(inputs.properties.iter().copied());
    let gradients = [point.f_old, point.f].map(|f| GRADIENT_IN_MFRONT.map(|place| f[place]));
    let (mut old, mut new) = (point.state.clone(), vec![guard::<f64>(); case.law.state()]);
    let (mut stress, mut k) = ([guard::<f64>(); 6], [guard::<f64>(); 36]);
    (k[0], k[1], k[2]) = (if case.asks(with::TANGENT) { 4.0 } else { 0.0 }, 0.0, 1.0);
    let request = k.map(f64::to_bits);
    let [mut stored, mut dissipated, mut rdt] = [guard::<f64>(), guard(), 1.0];
    let nothing = null_mut::<f64>();
    let state = |gradients: &[f64; 9], forces, variables, stored, dissipated| StateView {
        gradients: gradients.as_ptr(),
        thermodynamic_forces: forces,
        mass_density: null(),
        material_properties: properties.as_ptr(),
        internal_state_variables: variables,
        stored_energy: stored,
        dissipated_energy: dissipated,
        external_state_variables: null(),
    };
    let (sigma, isv): (*mut f64, *mut f64) = (stress.as_mut_ptr(), new.as_mut_ptr());
    let mut view = BehaviourDataView {
        error_message: message.as_mut_ptr(),
        dt: 0.0,
        k: k.as_mut_ptr(),
        rdt: &mut rdt,
        speed_of_sound: nothing,
        s0: state(&gradients[0], nothing, old.as_mut_ptr(), nothing, nothing),
        s1: state(&gradients[1], sigma, isv, &mut stored, &mut dissipated),
    };
    // SAFETY: the arrays have the sizes of the hypothesis and of the tables.
    let answer = unsafe {
        match case.law {
            Law::Hyperelastic => <Hyperelastic>::integrate(&mut view),
            Law::Frictional => <Frictional>::integrate(&mut view),
            Law::Linear => <LinearElastic>::integrate(&mut view),
        }
    };
    let root = |c: usize| if c < 3 { 1.0 } else { std::f64::consts::SQRT_2 };
    let integrated = answer == 1;
    if k.map(f64::to_bits) == request {
        k = [guard(); 36];
    }
    for (c, place) in IN_MFRONT.into_iter().enumerate() {
        let value = if integrated { stress[place] / root(c) } else { stress[place] };
        outcome.stress.set(c, 0, back(value));
        for (d, other) in IN_MFRONT.into_iter().enumerate() {
            let value = k[6 * place + other];
            let value = if value.is_nan() { value } else { value / (root(c) * root(d)) };
            outcome.tangent.set(6 * c + d, 0, back(value));
        }
    }
    put(&mut outcome.state, &new);
    outcome.beside = vec![stored, rdt, dissipated];
    outcome.input_written = old.iter().zip(&point.state).any(|(a, b)| a.to_bits() != b.to_bits());
    // The status is not told: any refusal is a −1.
    if integrated { 0 } else { -1 }
}
