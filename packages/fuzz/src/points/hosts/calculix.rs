//! CalculiX. What is wrong with a deck ends the process there, so that such points are not passed to it.

use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::Matrix3;
use toron::host::calculix::{Behaviour, CalculixLaw};
use toron::law::block::Circumstances;
use toron::{Frictional, Hyperelastic, LinearElastic, status};

use super::{NOBODYS, back, doubles, put, say_refused};
use crate::points::arrays::guard;
use crate::points::case::{Case, Law, with};
use crate::points::entries::{Inputs, Outcome};
use crate::points::functions::{Functions, Message};

/// Where CalculiX has the law's components: 11 22 33 12 13 23 there.
const IN_CALCULIX: [usize; 6] = [0, 1, 2, 3, 5, 4];

/// The seed of the case that is called, or 0.
static CALLED: AtomicU64 = AtomicU64::new(0);

extern "C" fn tell_case() {
    let seed = CALLED.load(Ordering::Relaxed);
    if seed != 0 {
        eprintln!("CalculiX would end here, at a point that the block evaluates or refuses, of {}", Case::random(seed));
    }
}

/// Whether CalculiX is to go on at a point of this status.
pub fn goes_on(case: &Case, point: usize, code: i32) -> bool {
    let limit = case.points[point].limit;
    let is_right = !case.asks(with::LIMIT) || (limit >= 0.0 && limit.is_finite());
    is_right && (code == 0 || (code < -300 && ![status::FIBRE_DIRECTION, status::STATE_NOT_FINITE].contains(&code)))
}

/// The Lagrange strain of F, 11 22 33 12 13 23.
fn strain(f: &Matrix3<f64>) -> [f64; 6] {
    let h = f - Matrix3::identity();
    let e = 0.5 * (h + h.transpose()) + 0.5 * h.tr_mul(&h);
    [e.m11, e.m22, e.m33, e.m12, e.m13, e.m23]
}

/// The Cauchy stress of a second Piola–Kirchhoff stress; the latter where it overflows on the way.
fn cauchy(f: &Matrix3<f64>, s: [f64; 6]) -> [f64; 6] {
    let [s11, s22, s33, s12, s13, s23] = s;
    let sigma = f * Matrix3::new(s11, s12, s13, s12, s22, s23, s13, s23, s33) * f.transpose() / f.determinant();
    let sigma = [sigma.m11, sigma.m22, sigma.m33, sigma.m12, sigma.m23, sigma.m31];
    if sigma.iter().all(|x| x.is_finite()) { sigma } else { IN_CALCULIX.map(|place| s[place]) }
}

/// The place of an entry in the upper triangle by columns.
fn in_triangle(row: usize, column: usize) -> usize {
    let (row, column) = (row.min(column), row.max(column));
    column * (column + 1) / 2 + row
}

pub fn behaviour<T: Functions>(
    case: &Case,
    inputs: &mut Inputs<T>,
    outcome: &mut Outcome<T>,
    message: &mut Message,
) -> i32 {
    static ONCE: Once = Once::new();
    // SAFETY: the function reads a number and writes a line.
    ONCE.call_once(|| assert_eq!(unsafe { libc::atexit(tell_case) }, 0, "room for a function"));
    let (point, states) = (&case.points[0], case.law.state());
    let mut constants = doubles(inputs.properties.iter().copied());
    let kept = &point.f_old[..case.law.kept()];
    if case.asks(with::LIMIT) {
        constants.push((states + kept.len() + 1) as f64);
    }
    let old = [&point.state[..], kept, &[point.limit, NOBODYS]].concat();
    let mut new = vec![guard::<f64>(); old.len()];
    let (mut stress, mut stiffness, mut pnewdt) = ([guard::<f64>(); 6], [guard::<f64>(); 21], 1.0);
    let f = Matrix3::from_column_slice(&point.f);
    let (kode, count) = (-100 - constants.len() as i32, old.len() as i32);
    let (name, strain, zeros) = ([b' ' as std::ffi::c_char; 80], strain(&f), [0.0; 7]);
    let call = Behaviour {
        amat: name.as_ptr(),
        iel: &1,
        iint: &1,
        kode: &kode,
        elconloc: constants.as_ptr(),
        emec: strain.as_ptr(),
        beta: zeros.as_ptr(),
        xkl: point.f.as_ptr(),
        mi: &1,
        nstate_: &count,
        xstateini: old.as_ptr(),
        xstate: new.as_mut_ptr(),
        stre: stress.as_mut_ptr(),
        stiff: stiffness.as_mut_ptr(),
        iorien: &0,
        pgauss: zeros.as_ptr(),
        orab: zeros.as_ptr(),
        pnewdt: &mut pnewdt,
        circumstances: Circumstances::UNKNOWN,
    };
    CALLED.store(case.seed, Ordering::Relaxed);
    // SAFETY: the arrays have the values of one point.
    unsafe {
        match case.law {
            Law::Hyperelastic => <Hyperelastic as CalculixLaw>::behaviour(&call),
            Law::Frictional => <Frictional as CalculixLaw>::behaviour(&call),
            Law::Linear => <LinearElastic as CalculixLaw>::behaviour(&call),
        }
    }
    CALLED.store(0, Ordering::Relaxed);
    put(&mut outcome.stress, &cauchy(&f, stress));
    put(&mut outcome.state, &new[..states]);
    // Where there is no stiffness, each node still has a little.
    let is_residual = (0..21).all(|c| {
        let is_diagonal = (0..6).any(|row| in_triangle(row, row) == c);
        stiffness[c] == if is_diagonal { stiffness[0] } else { 0.0 }
    });
    for (c, place) in IN_CALCULIX.into_iter().enumerate() {
        for (d, other) in IN_CALCULIX.into_iter().enumerate() {
            let value = if is_residual { 0.0 } else { stiffness[in_triangle(place, other)] };
            outcome.tangent.set(6 * c + d, 0, back(value));
        }
    }
    let mut strange = stiffness.iter().any(|x| !x.is_finite());
    for (new, old) in new[states + kept.len()..].iter().zip([point.limit, NOBODYS]) {
        strange |= new.to_bits() != old.to_bits();
    }
    for (c, kept) in new[states..states + kept.len()].iter().enumerate() {
        let expected = if pnewdt == 1.0 { point.f[c] } else { point.f_old[c] };
        strange |= kept.to_bits() != expected.to_bits();
    }
    outcome.input_written |= strange;
    outcome.beside = vec![pnewdt];
    if pnewdt == 1.0 {
        return 0;
    }
    say_refused(message);
    status::SMALLER_STEP
}
