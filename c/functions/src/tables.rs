//! The tables of properties and state variables, and the presets.

use libc::{c_char, size_t};
use toron::Error;
use toron::host::entry_points::{Message, look_up, name};
use toron::host::environment::in_default_environment;
use toron::host::laws::LAWS;
use toron::host::tables::{TableRow, write_row};
use toron::host::units::UnitSystem;
use toron::law::block::Precision;
use toron::law::bounds::wrong_number;
use toron::law::description::Description;
use toron::law::{parameters, status};

/// The law of a number.
///
/// # Errors
/// There is no such law.
fn description(law: i32) -> Result<&'static Description, Error> {
    let found = usize::try_from(law).ok().and_then(|place| LAWS.get(place));
    found.map(|law| law.description).ok_or(Error::Range {
        code: status::UNKNOWN_NAME,
        name: "law",
        value: i64::from(law),
        least: 0,
        greatest: LAWS.len() as i64 - 1,
    })
}

/// The index of a name among those of a table, or a status code.
///
/// # Safety
/// What [a caller promises](toron::host#what-a-caller-promises).
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

/// # Safety
/// What [a caller promises](toron::host#what-a-caller-promises).
unsafe fn preset<T: Precision>(
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

/// The number of properties of a law (`TORON_HYPERELASTIC`, `TORON_LINEAR_ELASTIC`, `TORON_FRICTIONAL`), or
/// `TORON_UNKNOWN_NAME`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_property_count(law: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { look_up(Message { text: message, capacity }, || Ok(description(law)?.properties.len() as i32)) }
}

/// Writes the table row of property `index`, counted from 0, to `row`, whose `size` is set.
///
/// Returns 0, `TORON_UNKNOWN_NAME`, `TORON_NULL_ARGUMENT` or `TORON_BAD_SIZE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_property(
    law: i32,
    index: i32,
    row: *mut TableRow,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { look_up(Message { text: message, capacity }, || write_row(description(law)?.properties, index, row)) }
}

/// The index, counted from 0, of the property with this name, or `TORON_UNKNOWN_NAME` or `TORON_NULL_ARGUMENT`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_property_index(
    law: i32,
    property: *const c_char,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let message = Message { text: message, capacity };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        look_up(message, || {
            let names = description(law)?.properties.iter().map(|row| row.name);
            Ok(index_of(property, "property", "property", names, message))
        })
    }
}

/// The number of state variables of a law, or `TORON_UNKNOWN_NAME`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_state_count(law: i32, message: *mut c_char, capacity: size_t) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { look_up(Message { text: message, capacity }, || Ok(description(law)?.state.len() as i32)) }
}

/// Writes the state variable of this index, from 0, to `row`; as `toron_property`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_state_variable(
    law: i32,
    index: i32,
    row: *mut TableRow,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe { look_up(Message { text: message, capacity }, || write_row(description(law)?.state, index, row)) }
}

/// The index, from 0, of the state variable of this name; as `toron_property_index`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_state_index(
    law: i32,
    variable: *const c_char,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let message = Message { text: message, capacity };
    // SAFETY: the caller's arguments, as lib.rs says.
    unsafe {
        look_up(message, || {
            let names = description(law)?.state.iter().map(|row| row.name);
            Ok(index_of(variable, "state variable", "variable", names, message))
        })
    }
}

/// The properties and the reference density of a preset, in the units of the user's model.
///
/// - `preset`: "kevlar-km2-600" or "kevlar-km2-600-linear"; `units`: a unit of length, one of mass and one of time,
///   joined by "-", such as "m-kg-s" (or "si"), "mm-tonne-s", "mm-kg-ms", "cm-g-us".
/// - `properties`: array for the properties; `count` must equal the law's number of properties. `density`: one value,
///   out, or null.
///
/// Returns 0, `TORON_UNKNOWN_NAME`, `TORON_NULL_ARGUMENT` or `TORON_PROPERTY_COUNT`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_preset_f64(
    preset: *const c_char,
    units: *const c_char,
    properties: *mut f64,
    count: size_t,
    density: *mut f64,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let message = Message { text: message, capacity };
    // SAFETY: the caller's arguments, as lib.rs says.
    in_default_environment(move || unsafe { self::preset(preset, units, properties, count, density, message) })
}

/// As `toron_preset_f64`, rounded to single precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_preset_f32(
    preset: *const c_char,
    units: *const c_char,
    properties: *mut f32,
    count: size_t,
    density: *mut f32,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let message = Message { text: message, capacity };
    // SAFETY: the caller's arguments, as lib.rs says.
    in_default_environment(move || unsafe { self::preset(preset, units, properties, count, density, message) })
}
