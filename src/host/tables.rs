//! Rows of the tables of properties and state variables, for C.

use libc::{c_char, size_t};

use super::structures::{Structure, write};
use crate::law::error::Error;
use crate::law::parameters::{Dimension, Property};
use crate::law::state::StateVariable;
use crate::law::status;

/// A row of the tables of properties and state variables. Set `size`; the rest is written. Texts are null-terminated
/// UTF-8.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct TableRow {
    /// The size of this structure.
    pub size: size_t,
    /// The name used in decks and messages, and the symbol used in the documentation.
    pub name: [c_char; 24],
    pub symbol: [c_char; 24],
    /// The physical dimension in words ("stress", "energy/volume", "-"), and as exponents of mass, length and time.
    pub unit: [c_char; 24],
    pub mass: i32,
    pub length: i32,
    pub time: i32,
    /// 1 if there is a default, else 0; and the default. For state variables the initial value, 0.
    pub has_default: i32,
    pub default_value: f64,
    /// The least and the greatest allowed value (infinite if there is no bound); minimum_excluded is 1 if the least
    /// value itself is not allowed.
    pub minimum: f64,
    pub maximum: f64,
    pub minimum_excluded: i32,
    /// The allowed values in words, and the meaning of the quantity.
    pub allowed: [c_char; 80],
    pub meaning: [c_char; 100],
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<TableRow>() == size_of::<size_t>() + 3 * 24 + 4 * 4 + 3 * 8 + 4 + 80 + 100);

// SAFETY: numbers and characters without padding, as has just been seen, and the size is the first.
unsafe impl Structure for TableRow {
    const NAME: &'static str = "toron_table_row";
    const ARGUMENT: &'static str = "row";
}

/// A text as a null-terminated array, cut off if it is too long.
fn text<const N: usize>(text: &str) -> [c_char; N] {
    let mut array = [0; N];
    // The last element stays 0, the terminator.
    for (to, &from) in array.iter_mut().take(N - 1).zip(text.as_bytes()) {
        *to = from as c_char;
    }
    array
}

impl TableRow {
    fn new(name: &str, symbol: &str, dimension: Dimension, meaning: &str) -> Self {
        TableRow {
            size: size_of::<TableRow>(),
            name: text(name),
            symbol: text(symbol),
            unit: text(dimension.name),
            mass: dimension.mass,
            length: dimension.length,
            time: dimension.time,
            has_default: 1,
            default_value: 0.0,
            minimum: f64::NEG_INFINITY,
            maximum: f64::INFINITY,
            minimum_excluded: 0,
            allowed: text("a finite number"),
            meaning: text(meaning),
        }
    }
}

impl From<&Property> for TableRow {
    fn from(row: &Property) -> Self {
        TableRow {
            has_default: i32::from(row.default.is_some()),
            default_value: row.default.unwrap_or(0.0),
            minimum: row.minimum,
            maximum: row.maximum,
            minimum_excluded: i32::from(row.minimum_excluded),
            allowed: text(row.allowed),
            ..TableRow::new(row.name, row.symbol, row.dimension, row.meaning)
        }
    }
}

impl From<&StateVariable> for TableRow {
    fn from(row: &StateVariable) -> Self {
        TableRow::new(row.name, row.symbol, row.dimension, row.meaning)
    }
}

/// Writes the row of an index.
///
/// # Errors
/// There is no such index, or no row to write to.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn write_row<R>(table: &'static [R], index: i32, row: *mut TableRow) -> Result<i32, Error>
where
    TableRow: From<&'static R>,
{
    let Some(found) = usize::try_from(index).ok().and_then(|index| table.get(index)) else {
        let (code, value) = (status::UNKNOWN_NAME, i64::from(index));
        return Err(Error::Range { code, name: "index", value, least: 0, greatest: table.len() as i64 - 1 });
    };
    // SAFETY: `write` refuses null; the row has as many bytes as its size says.
    unsafe { write(&TableRow::from(found), row) }?;
    Ok(status::OK)
}
