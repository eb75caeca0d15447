//! The starter: the numbers of a material's card are checked and become UPARAM.

use crate::law::block::Precision;
use crate::law::error::{Error, Value, describe_integer};
use crate::law::status;

use super::card::{Card, FibreFrom, Layout, NEEDS};
use super::laws::Laws;

/// What the starter needs to know of a material besides UPARAM.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Read<T> {
    /// NUPARAM and NUVAR.
    pub parameters: usize,
    pub variables: usize,
    /// PARMAT(1): the modulus of the fastest wave at rest, from which the first time step and contact stiffnesses are
    /// computed.
    pub modulus: T,
}

/// Writes UPARAM from the values of a card: the properties, then the options, of which the last ones may be left out.
///
/// Where each element has a fibre direction of its own, that of the card may be 0 0 0.
///
/// # Errors
/// The list has no such law, too few or too many values, a wrong property or option, too little room in UPARAM.
pub fn read<T: Precision>(laws: &Laws<T>, number: i32, values: &[T], uparam: &mut [T]) -> Result<Read<T>, Error> {
    let material = laws.material(number)?;
    let layout = &material.layout;
    let (needed, wanted) = (layout.law.properties.len(), layout.parameters());
    let count = |what, found: usize, wanted: usize| {
        Err(Error::Count { code: status::PROPERTY_COUNT, what, found: found as i64, wanted: wanted as i64 })
    };
    if values.len() < needed {
        return count("number of values on the card, five a line", values.len(), needed);
    }
    // The rest of the last line is blank, which reads as 0.
    let most = wanted - 1;
    if let Some(&value) = values.iter().skip(most).find(|&&value| value.into() != 0.0) {
        return Err(Error::Argument {
            name: "behind the last value of the card",
            value: Value::of(value),
            wanted: "nothing",
        });
    }
    let Some(own) = uparam.get_mut(..wanted) else { return count("MAXUPARAM", uparam.len(), wanted) };
    own.fill(T::splat(0.0));
    if let Some((first, rest)) = own.split_first_mut() {
        *first = T::splat(f64::from(layout.number));
        rest.iter_mut().zip(values).for_each(|(to, &value)| *to = value);
    }
    let card = Card::of(laws, own)?;
    let variables = card.variables();
    if card.fibre_from != FibreFrom::Card {
        give_a_direction(layout, own);
    }
    let modulus = (material.modulus_at_rest)(Card::of(laws, own)?.properties)?;
    Ok(Read { parameters: wanted, variables, modulus })
}

/// Sets a fibre direction that is 0 0 0 to an axis that is not along the second axis: elements have their own.
fn give_a_direction<T: Precision>(layout: &Layout, uparam: &mut [T]) {
    let read = |first: usize| uparam.get(1 + first..).and_then(<[_]>::first_chunk).map(|v: &[T; 3]| v.map(Into::into));
    let [fibre, others @ ..] = layout.law.directions else { return };
    if read(fibre.first) != Some([0.0; 3]) {
        return;
    }
    let second: [f64; 3] = others.first().and_then(|other| read(other.first)).unwrap_or_default();
    let along_x = second[0].abs() > second[1].abs() + second[2].abs();
    if let Some(axis) = uparam.get_mut(1 + fibre.first + usize::from(along_x)) {
        *axis = T::splat(1.0);
    }
}

/// A line, from 0, of what the starter's listing says of a material: passed to `sink` piece by piece. False behind the
/// last line.
///
/// # Errors
/// UPARAM is not what [`read`] has written.
pub fn listing<T: Precision>(
    laws: &Laws<T>,
    uparam: &[T],
    line: usize,
    sink: &mut dyn FnMut(&str),
) -> Result<bool, Error> {
    let card = Card::of(laws, uparam)?;
    let (layout, variables) = (card.layout(), card.variables());
    let values = layout.parameters() - 1;
    const HEAD: usize = 3;
    if line < HEAD {
        match line {
            0 => {
                sink("     toron: ");
                sink(layout.law.title);
            }
            1 => {
                sink("     the elements need ");
                sink(NEEDS);
            }
            _ => sink("     values of the card:"),
        }
    } else if let Some(i) = line.checked_sub(HEAD).filter(|&i| i < values) {
        value_line(layout, uparam, i, sink);
    } else if line == HEAD + values {
        sink("     user variables:");
    } else if let Some(i) = line.checked_sub(HEAD + values + 1).filter(|&i| i < variables) {
        sink("       ");
        describe_integer(i as i64 + 1, sink);
        sink(" ");
        sink(card.variable(i));
    } else {
        return Ok(false);
    }
    Ok(true)
}

/// The line of value `i` of the card.
fn value_line<T: Precision>(layout: &Layout, uparam: &[T], i: usize, sink: &mut dyn FnMut(&str)) {
    sink("       ");
    match layout.law.properties.get(i) {
        Some(property) => {
            sink(property.name);
            sink(" (");
            sink(property.meaning);
            sink(")");
        }
        None => sink(layout.options().nth(i - layout.law.properties.len()).map_or("", |option| option.name)),
    }
    sink(" = ");
    Value::of(uparam.get(i + 1).copied().unwrap_or(T::splat(0.0))).describe(sink);
}
