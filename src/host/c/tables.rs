//! The tables of properties and state variables, and the presets.

use libc::{c_char, size_t};

use super::constants::{TORON_HYPERELASTIC, TORON_LINEAR_ELASTIC};
use crate::host::entry_points::{Message, look_up, name};
use crate::host::environment::in_default_environment;
use crate::host::structures::{Structure, write};
use crate::host::units::UnitSystem;
use crate::law::bounds::wrong_number;
use crate::law::description::{self, Description};
use crate::law::error::Error;
use crate::law::number::real::Scalar;
use crate::law::parameters::{self, Dimension, Property};
use crate::law::state::StateVariable;
use crate::law::status;

/// A row of the tables of properties and state variables. Set `size`; the rest is written. Texts are null-terminated UTF-8.
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
    /// The least and the greatest allowed value (infinite if there is no bound); minimum_excluded is 1 if the least value
    /// itself is not allowed.
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

/// The law of a number.
///
/// # Errors
/// There is no such law.
fn description(law: i32) -> Result<&'static Description, Error> {
    const LAST: i64 = TORON_LINEAR_ELASTIC as i64;
    match law {
        TORON_HYPERELASTIC => Ok(&description::HYPERELASTIC),
        TORON_LINEAR_ELASTIC => Ok(&description::LINEAR_ELASTIC),
        _ => {
            let (code, name, value) = (status::UNKNOWN_NAME, "law", i64::from(law));
            Err(Error::Range { code, name, value, least: 0, greatest: LAST })
        }
    }
}

/// Writes the row of an index.
///
/// # Errors
/// There is no such index, or no row to write to.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub(super) unsafe fn write_row<R>(table: &'static [R], index: i32, row: *mut TableRow) -> Result<i32, Error>
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

/// The index of a name among those of a table, or a status code.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
unsafe fn index_of(
    wanted: *const c_char,
    what: &'static str,
    argument: &'static str,
    names: impl Iterator<Item = &'static str> + Clone,
    message: Message,
) -> i32 {
    // SAFETY: null, or a C string.
    let wanted = unsafe { name(wanted, argument) };
    match names.clone().position(|name| Ok(name) == wanted) {
        Some(index) => index as i32,
        // SAFETY: the message is the C caller's.
        None => unsafe { message.refuse_name(what, wanted, names) },
    }
}

/// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(never)]
pub unsafe extern "C" fn property_count(law: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the message is the C caller's.
    unsafe { look_up(Message { text: message, capacity }, || Ok(description(law)?.properties.len() as i32)) }
}

/// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(never)]
pub unsafe extern "C" fn property(
    law: i32,
    index: i32,
    row: *mut TableRow,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: row and message are the C caller's; `write_row` refuses a row that is null.
    unsafe { look_up(Message { text: message, capacity }, || write_row(description(law)?.properties, index, row)) }
}

/// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(never)]
pub unsafe extern "C" fn property_index(
    law: i32,
    property: *const c_char,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let message = Message { text: message, capacity };
    // SAFETY: the name is null or a C string, and the message is the C caller's.
    unsafe {
        look_up(message, || {
            let names = description(law)?.properties.iter().map(|row| row.name);
            Ok(index_of(property, "property", "property", names, message))
        })
    }
}

/// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(never)]
pub unsafe extern "C" fn state_count(law: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the message is the C caller's.
    unsafe { look_up(Message { text: message, capacity }, || Ok(description(law)?.state.len() as i32)) }
}

/// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(never)]
pub unsafe extern "C" fn state_variable(
    law: i32,
    index: i32,
    row: *mut TableRow,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: row and message are the C caller's; `write_row` refuses a row that is null.
    unsafe { look_up(Message { text: message, capacity }, || write_row(description(law)?.state, index, row)) }
}

/// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
#[inline(never)]
pub unsafe extern "C" fn state_index(law: i32, variable: *const c_char, message: *mut c_char, capacity: size_t) -> i32 {
    let message = Message { text: message, capacity };
    // SAFETY: the name is null or a C string, and the message is the C caller's.
    unsafe {
        look_up(message, || {
            let names = description(law)?.state.iter().map(|row| row.name);
            Ok(index_of(variable, "state variable", "variable", names, message))
        })
    }
}

/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
unsafe fn preset<T: Scalar>(
    preset: *const c_char,
    units: *const c_char,
    properties: *mut T,
    count: size_t,
    density: *mut T,
    message: Message,
) -> i32 {
    // SAFETY: each is null or a C string.
    let (preset, units) = unsafe { (name(preset, "preset"), name(units, "units")) };
    let Some(found) = preset.ok().and_then(parameters::preset) else {
        // SAFETY: the message is the C caller's.
        return unsafe { message.refuse_name("preset", preset, parameters::PRESETS.iter().map(|preset| preset.name)) };
    };
    let Some(system) = units.ok().and_then(UnitSystem::parse) else {
        // SAFETY: the message is the C caller's.
        return unsafe { message.refuse_name("system of units", units, core::iter::once(UnitSystem::ALLOWED)) };
    };
    let write = || {
        if properties.is_null() {
            return Err(Error::Null { name: "properties" });
        }
        if count != found.table().len() {
            return Err(wrong_number(i64::try_from(count).unwrap_or(i64::MAX), found.table()));
        }
        for (i, (&value, property)) in found.values.iter().zip(found.table()).enumerate() {
            // SAFETY: not null, as just checked, and i < `count`, which is the table's length.
            unsafe { *properties.add(i) = T::splat(system.from_si(value, property.dimension)) };
        }
        if !density.is_null() {
            // SAFETY: not null, as just checked: one value.
            unsafe { *density = T::splat(system.from_si(found.density, parameters::DENSITY)) };
        }
        Ok(status::OK)
    };
    // SAFETY: the message is the C caller's.
    unsafe { look_up(message, write) }
}

macro_rules! entries {
    ($t:ty: $preset:ident) => {
        /// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// What [a caller promises](super#what-a-caller-promises).
        #[inline(never)]
        pub unsafe extern "C" fn $preset(
            preset: *const c_char,
            units: *const c_char,
            properties: *mut $t,
            count: size_t,
            density: *mut $t,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            let message = Message { text: message, capacity };
            // SAFETY: the arguments are the C caller's; `preset` refuses null where it is not allowed.
            in_default_environment(move || unsafe { self::preset(preset, units, properties, count, density, message) })
        }
    };
}

entries!(f64: preset_f64);
entries!(f32: preset_f32);
