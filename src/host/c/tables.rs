//! The tables of properties and state variables, and the presets.

use libc::{c_char, size_t};

use crate::host::environment::in_default_environment;
use crate::host::units::UnitSystem;
use crate::law::parameters::{self, Dimension, Property};
use crate::law::state::{self, StateVariable};
use crate::law::status;

use super::constants::{TORON_HYPERELASTIC, TORON_HYPERELASTIC_PROPERTIES, TORON_LINEAR_ELASTIC};
use crate::host::border::name;
use crate::host::border::store;

/// A row of the tables of properties and state variables. Texts are null-terminated UTF-8.
#[repr(C)]
pub struct TableRow {
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
    pub meaning: [c_char; 96],
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

fn property_table(law: i32) -> Option<&'static [Property]> {
    match law {
        TORON_HYPERELASTIC => Some(&parameters::HYPERELASTIC),
        TORON_LINEAR_ELASTIC => Some(&parameters::LINEAR_ELASTIC),
        _ => None,
    }
}

fn state_table(law: i32) -> Option<&'static [StateVariable]> {
    match law {
        TORON_HYPERELASTIC => Some(&state::HYPERELASTIC),
        TORON_LINEAR_ELASTIC => Some(&state::LINEAR_ELASTIC),
        _ => None,
    }
}

/// Writes the row of an index, for either table.
///
/// # Safety
/// `row` is null or writable.
unsafe fn write_row<R>(table: Option<&'static [R]>, index: i32, row: *mut TableRow) -> i32
where
    TableRow: From<&'static R>,
{
    let Some(found) = table.and_then(|table| table.get(usize::try_from(index).ok()?)) else {
        return status::UNKNOWN_NAME;
    };
    if row.is_null() {
        return status::NULL_ARGUMENT;
    }
    // SAFETY: not null, and the caller's promise.
    unsafe { row.write(TableRow::from(found)) };
    status::OK
}

/// A count or an index, or the status code of an unknown law or name.
fn count_or(count: Option<usize>) -> i32 {
    count.map_or(status::UNKNOWN_NAME, |count| count as i32)
}

/// `toron_property_count` of the C interface.
#[inline(never)]
pub extern "C" fn property_count(law: i32) -> i32 {
    count_or(property_table(law).map(<[_]>::len))
}

/// `toron_property` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn property(law: i32, index: i32, row: *mut TableRow) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { write_row(property_table(law), index, row) }
}

/// `toron_property_index` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn property_index(law: i32, property: *const c_char) -> i32 {
    // SAFETY: the caller's promise.
    let wanted = unsafe { name(property) };
    count_or(property_table(law).and_then(|table| table.iter().position(|row| Some(row.name) == wanted)))
}

/// `toron_state_count` of the C interface.
#[inline(never)]
pub extern "C" fn state_count(law: i32) -> i32 {
    count_or(state_table(law).map(<[_]>::len))
}

/// `toron_state_variable` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn state_variable(law: i32, index: i32, row: *mut TableRow) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { write_row(state_table(law), index, row) }
}

/// `toron_state_index` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn state_index(law: i32, variable: *const c_char) -> i32 {
    // SAFETY: the caller's promise.
    let wanted = unsafe { name(variable) };
    count_or(state_table(law).and_then(|table| table.iter().position(|row| Some(row.name) == wanted)))
}

/// `toron_preset_f64` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn preset_f64(
    preset: *const c_char,
    units: *const c_char,
    values: *mut f64,
    count: size_t,
    density: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    in_default_environment(move || unsafe { self::preset(preset, units, values, count, density) })
}

/// # Safety
/// As for `toron_preset_f64`.
unsafe fn preset(
    preset: *const c_char,
    units: *const c_char,
    values: *mut f64,
    count: size_t,
    density: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    let (found, units) =
        unsafe { (name(preset).and_then(parameters::preset), name(units).and_then(UnitSystem::parse)) };
    let (Some(preset), Some(units)) = (found, units) else {
        return status::UNKNOWN_NAME;
    };
    if values.is_null() {
        return status::NULL_ARGUMENT;
    }
    if count != preset.table.len() {
        return status::PROPERTY_COUNT;
    }
    for (i, (&value, property)) in preset.values.iter().zip(preset.table).enumerate() {
        // SAFETY: i < count.
        unsafe { *values.add(i) = units.from_si(value, property.dimension) };
    }
    // SAFETY: the caller's promise.
    unsafe { store(&[units.from_si(preset.density, parameters::DENSITY)], density) };
    status::OK
}

/// `toron_preset_f32` of the C interface; package `toron-c` documents its arguments.
///
/// # Safety
/// As documented there.
#[inline(never)]
pub unsafe extern "C" fn preset_f32(
    preset: *const c_char,
    units: *const c_char,
    values: *mut f32,
    count: size_t,
    density: *mut f32,
) -> i32 {
    const MOST: usize = TORON_HYPERELASTIC_PROPERTIES;
    if values.is_null() {
        return status::NULL_ARGUMENT;
    }
    let (mut wide, mut wide_density) = ([0.0; MOST], 0.0);
    if count > MOST {
        return status::PROPERTY_COUNT;
    }
    // SAFETY: as the caller promises; `wide` has room for MOST values.
    in_default_environment(move || unsafe {
        let code = self::preset(preset, units, wide.as_mut_ptr(), count, &mut wide_density);
        if code == status::OK {
            for (i, &value) in wide.iter().take(count).enumerate() {
                *values.add(i) = value as f32;
            }
            store(&[wide_density as f32], density);
        }
        code
    })
}
