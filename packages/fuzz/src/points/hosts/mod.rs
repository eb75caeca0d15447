//! The entries of hosts: a UMAT, CalculiX and MGIS for one point, a VUMAT and OpenRadioss for a block, LS-DYNA for
//! both. Their results come back in the order of the law.

mod abaqus;
mod calculix;
mod lsdyna;
mod mgis;
mod openradioss;

pub use calculix::goes_on;
pub use lsdyna::is_scalar;
pub use openradioss::is_first_cycle;

use super::arrays::Array;
use super::case::{Case, Form, Host, Placing, with};
use super::entries::{Inputs, Outcome};
use super::functions::{Functions, Message};

/// State variables behind those of the law: the limit, and one that is nobody's.
const OTHERS: usize = 2;
const NOBODYS: f64 = 7.25;

/// The card: the properties, and the number of the variable with the limit.
fn card<T: Functions>(case: &Case, inputs: &Inputs<T>) -> Vec<T> {
    let mut card = inputs.properties.clone();
    if case.asks(with::LIMIT) {
        card.push(T::splat((case.law.state() + 1) as f64));
    }
    card
}

/// As double precision, bit by bit: the entries for one point are of that.
fn doubles<T: Functions>(values: impl IntoIterator<Item = T>) -> Vec<f64> {
    values.into_iter().map(|x| f64::from_bits(x.bits())).collect()
}

fn back<T: Functions>(x: f64) -> T {
    T::from_bits(x.to_bits())
}

/// Writes the components of the only point.
fn put<T: Functions>(array: &mut Array<T>, values: &[f64]) {
    for (c, &x) in values.iter().enumerate() {
        array.set(c, 0, back(x));
    }
}

/// A message in the place of one that a host does not have: it says by other means that a point is refused.
const REFUSED: &[u8; 8] = b"refused\0";

fn say_refused(message: &mut Message) {
    for (to, &from) in message.iter_mut().zip(REFUSED) {
        *to = from as std::ffi::c_char;
    }
}

/// How the arrays of a block of elements stand, with elements beside them that are not the call's.
fn among_others(case: &Case, group: usize) -> Placing {
    let Placing { gap, offset, .. } = case.placings[group];
    Placing { form: Form::Leading, gap: gap + offset, offset }
}

/// Calls the case's host.
pub fn call<T: Functions>(case: &Case, inputs: &mut Inputs<T>, outcome: &mut Outcome<T>, message: &mut Message) -> i32 {
    match case.host {
        Host::None => 0,
        Host::Umat => abaqus::umat(case, inputs, outcome, message),
        Host::Vumat => abaqus::vumat(case, inputs, outcome, message),
        Host::Mgis => mgis::mgis(case, inputs, outcome, message),
        Host::LsDyna => lsdyna::elements(case, inputs, outcome, message),
        Host::OpenRadioss => openradioss::group_of_elements(case, inputs, outcome, message),
        Host::CalculiX => calculix::behaviour(case, inputs, outcome, message),
    }
}
