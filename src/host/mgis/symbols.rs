//! The values of a behaviour's data symbols, from the law's tables at compile time. The package `toron-solvers` gives
//! them their names.

use core::ffi::{CStr, c_char};

use crate::law::parameters::{Property, place, same};
use crate::law::state::StateVariable;

/// A C string as the value of a symbol.
#[repr(transparent)]
#[derive(Clone, Copy, Debug)]
pub struct Text(*const c_char);

// SAFETY: it points to constant bytes, which are only read.
unsafe impl Sync for Text {}

impl Text {
    /// The end of a list that has no entries.
    pub const NONE: Text = Text(core::ptr::null());

    /// A constant text.
    pub const fn new(text: &'static CStr) -> Self {
        Text(text.as_ptr())
    }
}

/// The bytes of a name, with the terminating null.
pub const NAME: usize = 64;

const fn terminated(name: &str) -> [u8; NAME] {
    let (mut text, mut i) = ([0; NAME], 0);
    assert!(name.len() < NAME, "the name is too long");
    while i < name.len() {
        text[i] = name.as_bytes()[i];
        i += 1;
    }
    text
}

/// The names of a table of properties, each with its terminating null.
pub const fn property_names<const N: usize>(table: &[Property]) -> [[u8; NAME]; N] {
    assert!(table.len() == N, "a name for each row");
    let (mut names, mut i) = ([[0; NAME]; N], 0);
    while i < N {
        names[i] = terminated(table[i].name);
        i += 1;
    }
    names
}

/// The names of a table of state variables, each with its terminating null.
pub const fn state_names<const N: usize>(table: &[StateVariable]) -> [[u8; NAME]; N] {
    assert!(table.len() == N, "a name for each row");
    let (mut names, mut i) = ([[0; NAME]; N], 0);
    while i < N {
        names[i] = terminated(table[i].name);
        i += 1;
    }
    names
}

/// Names as C strings.
pub const fn texts<const N: usize>(names: &'static [[u8; NAME]; N]) -> [Text; N] {
    let (mut texts, mut i) = ([Text::NONE; N], 0);
    while i < N {
        texts[i] = Text(names[i].as_ptr().cast());
        i += 1;
    }
    texts
}

/// C's `long double` on x86-64: the x87 registers' ten bytes (a sign, 15 bits of exponent, 64 of significand with its
/// leading one), and six of padding.
#[repr(C, align(16))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LongDouble([u8; 16]);

impl LongDouble {
    /// The same number as a `long double`; at compile time, an error for a number that is subnormal or not finite.
    pub const fn new(x: f64) -> Self {
        const BIAS: u64 = 16383 - 1023;
        let bits = x.to_bits();
        let (sign, exponent, fraction) = (bits >> 63, bits >> 52 & 0x7ff, bits << 12 >> 1);
        let zero = exponent == 0 && fraction == 0;
        assert!(zero || (0 < exponent && exponent < 0x7ff), "a bound is 0 or a normal number");
        let high = sign << 15 | if zero { 0 } else { exponent + BIAS };
        let low = if zero { 0 } else { 1 << 63 | fraction };
        let value = ((high as u128) << 64 | low as u128).to_le_bytes();
        LongDouble(value)
    }
}

/// The least and the greatest allowed value of a property. The least one itself is excluded where the table says so,
/// for which the symbols have no word.
pub const fn bounds(table: &[Property], name: &str) -> [LongDouble; 2] {
    let Property { minimum, maximum, .. } = table[place(table, name)];
    [LongDouble::new(minimum), LongDouble::new(maximum)]
}

/// Whether these are the properties of a table that have bounds, in its order: not the components of directions.
pub const fn have_bounds(table: &[Property], names: &[&str]) -> bool {
    let (mut i, mut next) = (0, 0);
    while i < table.len() {
        if table[i].minimum > f64::NEG_INFINITY || table[i].maximum < f64::INFINITY {
            if next == names.len() || !same(table[i].name, names[next]) {
                return false;
            }
            next += 1;
        }
        i += 1;
    }
    next == names.len()
}
