//! The C ABI of the laws themselves, for drivers and solvers of any language.
//!
//! | convention | |
//! |---|---|
//! | deformation gradient | 9 values by columns: F11 F21 F31 F12 F22 F32 F13 F23 F33 |
//! | stress | Cauchy, 11 22 33 12 23 31 |
//! | energies | per reference volume |
//! | status | 0 is success, negative an error; outputs are untouched where the call itself is wrong (−1xx, −2xx) |
//! | arrays | the caller's; read and written during the call only, never kept |
//!
//! Every function may be called from any thread at any time.

use core::cell::Cell;
use core::slice;

use libc::{c_char, size_t};
use nalgebra::Matrix3;

use crate::law::block::linear::{LinearPointers, LinearPrecision};
use crate::law::block::{Level, Pointers, Precision, components, components_mut, raw_block_of};
use crate::law::hyperelastic::{Hyperelastic, Request};
use crate::law::linear_elastic::{Criterion, LinearElastic, LinearPoint, Rotation};
use crate::law::parameters::{self, Dimension, Property};
use crate::law::point::{Alone, Call, Point, Sink, StressAndState};
use crate::law::real::Real;
use crate::law::state::{self, StateVariable};
use crate::law::status::{self, Error};
use crate::law::tangent::{Measure, Moduli, Nine, Six};
use crate::law::wave_speed;

use super::environment::in_default_environment;
use super::units::UnitSystem;

/// Number of the interface. It changes when a caller compiled against an older header could no longer run.
pub const TORON_ABI_VERSION: i32 = 1;

/// The hyperelastic yarn law, where a table or a preset is asked for.
pub const TORON_HYPERELASTIC: i32 = 0;
/// The linear elastic orthotropic law.
pub const TORON_LINEAR_ELASTIC: i32 = 1;

/// Number of properties and of state variables of the hyperelastic law.
pub const TORON_HYPERELASTIC_PROPERTIES: usize = 11;
pub const TORON_HYPERELASTIC_STATE: usize = 11;
/// Number of properties and of state variables of the linear elastic law.
pub const TORON_LINEAR_ELASTIC_PROPERTIES: usize = 10;
pub const TORON_LINEAR_ELASTIC_STATE: usize = 10;

/// The frame of the linear elastic law follows the fibre.
pub const TORON_ROTATION_FIBRE: i32 = 0;
/// It follows the polar rotation of F.
pub const TORON_ROTATION_POLAR: i32 = 1;
/// It follows the spin.
pub const TORON_ROTATION_SPIN: i32 = 2;

/// The linear elastic law fails by its largest principal stress.
pub const TORON_CRITERION_PRINCIPAL: i32 = 0;
/// It fails by the stress along the fibre.
pub const TORON_CRITERION_FIBRE: i32 = 1;

/// Tangent: dS/dE, second Piola-Kirchhoff stress by Green-Lagrange strain, reference axes; 6 x 6.
pub const TORON_TANGENT_MATERIAL: i32 = 0;
/// The Truesdell modulus of the Cauchy stress: dS/dE pushed forward, over J; 6 x 6.
pub const TORON_TANGENT_TRUESDELL: i32 = 1;
/// The modulus of the Jaumann rate of the Kirchhoff stress, over J; 6 x 6.
pub const TORON_TANGENT_JAUMANN: i32 = 2;
/// dP/dF, first Piola-Kirchhoff stress by deformation gradient, both 11 21 31 12 22 32 13 23 33; 9 x 9.
pub const TORON_TANGENT_NOMINAL: i32 = 3;

/// Instructions of a block: the best that the processor has.
pub const TORON_LEVEL_BEST: i32 = 0;
/// None that only some processors of the architecture have.
pub const TORON_LEVEL_BASELINE: i32 = 1;
/// At most AVX2 with fused multiply-add.
pub const TORON_LEVEL_AVX2: i32 = 2;
/// At most AVX-512.
pub const TORON_LEVEL_AVX512: i32 = 3;

const _: () = {
    assert!(TORON_HYPERELASTIC_PROPERTIES == parameters::HYPERELASTIC_PROPERTIES);
    assert!(TORON_HYPERELASTIC_STATE == state::HYPERELASTIC_STATE);
    assert!(TORON_LINEAR_ELASTIC_PROPERTIES == parameters::LINEAR_ELASTIC_PROPERTIES);
    assert!(TORON_LINEAR_ELASTIC_STATE == state::LINEAR_ELASTIC_STATE);
};

// ---------------------------------------------------------------------------------------------------------------------
// Strings and slices across the boundary

/// Writes a text with `snprintf`'s semantics: at most `capacity` bytes, always terminated; returns the length needed
/// without the terminator.
///
/// # Safety
/// `buffer` is null or points to `capacity` writable bytes.
unsafe fn write_text(buffer: *mut c_char, capacity: size_t, text: impl FnOnce(&mut dyn FnMut(&str))) -> size_t {
    let mut length = 0;
    let room = if buffer.is_null() { 0 } else { capacity.saturating_sub(1) };
    text(&mut |piece| {
        for &byte in piece.as_bytes() {
            if length < room {
                // SAFETY: length < capacity.
                unsafe { *buffer.add(length) = byte as c_char };
            }
            length += 1;
        }
    });
    if !buffer.is_null() && capacity > 0 {
        // SAFETY: at most capacity − 1.
        unsafe { *buffer.add(length.min(room)) = 0 };
    }
    length
}

/// The text of a C string; `None` where it is null, longer than any name, or no UTF-8.
///
/// # Safety
/// `text` is null or terminated.
unsafe fn name<'a>(text: *const c_char) -> Option<&'a str> {
    const LONGEST: usize = 64;
    if text.is_null() {
        return None;
    }
    // SAFETY: no byte behind the terminator is read.
    let length = (0..LONGEST).find(|&i| unsafe { *text.add(i) } == 0)?;
    // SAFETY: these bytes have just been read.
    core::str::from_utf8(unsafe { slice::from_raw_parts(text.cast(), length) }).ok()
}

/// The properties that a caller passes, read only if their number is right.
///
/// # Safety
/// `properties` is null or points to `count` values.
pub(super) unsafe fn properties<'a, T>(
    properties: *const T,
    count: size_t,
    table: &'static [Property],
) -> Result<&'a [T], Error> {
    if properties.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    if count != table.len() {
        let (found, wanted) = (i64::try_from(count).unwrap_or(i64::MAX), table.len() as i64);
        return Err(Error::Count { code: status::PROPERTY_COUNT, what: "number of properties", found, wanted });
    }
    // SAFETY: the caller's promise.
    Ok(unsafe { slice::from_raw_parts(properties, count) })
}

/// The body of an entry, in the default floating-point environment; its error as a code.
#[inline(always)]
pub(super) fn entry(body: impl FnOnce() -> Result<i32, Error>) -> i32 {
    in_default_environment(|| body().unwrap_or_else(|error| error.code()))
}

/// Copies results out, if the caller wants them.
///
/// # Safety
/// `to` is null or has room for as many values.
pub(super) unsafe fn store<T: Copy>(values: &[T], to: *mut T) {
    if !to.is_null() {
        for (i, &value) in values.iter().enumerate() {
            // SAFETY: the caller's promise.
            unsafe { *to.add(i) = value };
        }
    }
}

/// An array of a fixed size, or zeros for null.
///
/// # Safety
/// `from` is null or points to N values.
unsafe fn load<const N: usize>(from: *const f64) -> [f64; N] {
    // SAFETY: the caller's promise.
    if from.is_null() { [0.0; N] } else { unsafe { *from.cast() } }
}

// ---------------------------------------------------------------------------------------------------------------------
// The library about itself

/// The version of the library, terminated, static: do not free.
#[unsafe(no_mangle)]
pub extern "C" fn toron_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// The number of the interface the library was built with: compare it with `TORON_ABI_VERSION` of the header.
#[unsafe(no_mangle)]
pub extern "C" fn toron_abi_version() -> i32 {
    TORON_ABI_VERSION
}

/// What a status code means, as a sentence.
///
/// Writes at most `capacity` bytes to `buffer`, always terminated; returns the length needed without the terminator.
/// `buffer` may be null and `capacity` 0.
///
/// # Safety
/// `buffer` is null or has room for `capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_status_message(status: i32, buffer: *mut c_char, capacity: size_t) -> size_t {
    // SAFETY: the caller's promise.
    unsafe { write_text(buffer, capacity, |sink| Error::Plain(status).describe(sink)) }
}

/// A row of the tables of properties and state variables. Texts are terminated UTF-8.
#[repr(C)]
pub struct TableRow {
    /// The name in decks and messages, and the thesis's symbol.
    pub name: [c_char; 24],
    pub symbol: [c_char; 24],
    /// The unit's dimension in words ("stress", "energy/volume", "-"), and as powers of mass, length and time.
    pub unit: [c_char; 24],
    pub mass: i32,
    pub length: i32,
    pub time: i32,
    /// Whether there is a default, and its value; for state variables the value at the start, 0.
    pub has_default: i32,
    pub default_value: f64,
    /// The least value allowed, and whether it is itself excluded, and the greatest one; infinite where there is no bound.
    pub minimum: f64,
    pub maximum: f64,
    pub minimum_excluded: i32,
    /// The bounds in words, and what the quantity is.
    pub allowed: [c_char; 80],
    pub meaning: [c_char; 96],
}

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

/// The row of an index, for either table.
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

fn count_or(count: Option<usize>) -> i32 {
    count.map_or(status::UNKNOWN_NAME, |count| count as i32)
}

/// The number of properties of a law (`TORON_HYPERELASTIC`, `TORON_LINEAR_ELASTIC`), or `TORON_UNKNOWN_NAME`.
#[unsafe(no_mangle)]
pub extern "C" fn toron_property_count(law: i32) -> i32 {
    count_or(property_table(law).map(<[_]>::len))
}

/// Writes the property of this index, from 0, to `row`. Returns 0, `TORON_UNKNOWN_NAME` or `TORON_NULL_ARGUMENT`.
///
/// # Safety
/// `row` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_property(law: i32, index: i32, row: *mut TableRow) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { write_row(property_table(law), index, row) }
}

/// The index, from 0, of the property of this name, or `TORON_UNKNOWN_NAME`.
///
/// # Safety
/// `property` is null or terminated.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_property_index(law: i32, property: *const c_char) -> i32 {
    // SAFETY: the caller's promise.
    let wanted = unsafe { name(property) };
    count_or(property_table(law).and_then(|table| table.iter().position(|row| Some(row.name) == wanted)))
}

/// The number of state variables of a law, or `TORON_UNKNOWN_NAME`.
#[unsafe(no_mangle)]
pub extern "C" fn toron_state_count(law: i32) -> i32 {
    count_or(state_table(law).map(<[_]>::len))
}

/// Writes the state variable of this index, from 0, to `row`. Returns 0, `TORON_UNKNOWN_NAME` or `TORON_NULL_ARGUMENT`.
///
/// # Safety
/// `row` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_state_variable(law: i32, index: i32, row: *mut TableRow) -> i32 {
    // SAFETY: the caller's promise.
    unsafe { write_row(state_table(law), index, row) }
}

/// The index, from 0, of the state variable of this name, or `TORON_UNKNOWN_NAME`.
///
/// # Safety
/// `variable` is null or terminated.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_state_index(law: i32, variable: *const c_char) -> i32 {
    // SAFETY: the caller's promise.
    let wanted = unsafe { name(variable) };
    count_or(state_table(law).and_then(|table| table.iter().position(|row| Some(row.name) == wanted)))
}

/// The properties and the reference density of a preset, in the units of the user's model.
///
/// - `preset`: "kevlar-km2-600" or "kevlar-km2-600-linear"; `units`: three units of length, mass and time joined by
///   "-", such as "m-kg-s" (or "si"), "mm-tonne-s", "mm-kg-ms", "cm-g-us".
/// - `values`: room for `count` values, the law's number of properties; `density`: one value, or null.
///
/// Returns 0, `TORON_UNKNOWN_NAME`, `TORON_NULL_ARGUMENT` or `TORON_PROPERTY_COUNT`.
///
/// # Safety
/// Strings are terminated; `values` has room for `count` values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_preset_f64(
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

/// As `toron_preset_f64`, rounded to single precision.
///
/// # Safety
/// As for `toron_preset_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_preset_f32(
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

// ---------------------------------------------------------------------------------------------------------------------
// The hyperelastic yarn law

/// A block of points: component-major arrays, component c of point i at `c * leading_dimension + i`.
///
/// Null pointers are left out: an output that is null is not computed. The old state may be the same arrays as the new
/// one. Energies, invariants and failure may be parts of one state array: rows 0, 4 and 8.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Block<T> {
    /// Number of points, and the distance from one component to the next, at least as many.
    pub n: size_t,
    pub leading_dimension: size_t,
    /// In, 9 components: F by columns. Must not be null.
    pub deformation_gradient: *const T,
    /// In, 3: the fibre direction of each point, any length; null: the property.
    pub fibre: *const T,
    /// In, 4, 4 and 3: the old state; null: all 0.
    pub energies_old: *const T,
    pub invariants_old: *const T,
    pub failure_old: *const T,
    /// In: reference density; read for the wave speed only.
    pub density: T,
    /// Out, 6: Cauchy stress 11 22 33 12 23 31.
    pub stress: *mut T,
    /// Out, 4: W_el W_tc W_td W_ld.
    pub energies: *mut T,
    /// Out, 4: I_el I_tc I_td I_ld.
    pub invariants: *mut T,
    /// Out, 3: failure index, failed, alive. Null: no point fails; one whose old latch is set stays failed.
    pub failure: *mut T,
    /// Out, 24: S_el, S_tc, S_td, S_ld, second Piola-Kirchhoff, each 11 22 33 12 23 31.
    pub modes: *mut T,
    /// Out, 1: an upper bound of the wave speed for current lengths, never below that along a fibre at rest. A solver's time
    /// step and bulk viscosity may take it as it is.
    pub wave_speed: *mut T,
    /// Out: a status code for each point.
    pub status: *mut i32,
    /// In: the instructions to use, one of `TORON_LEVEL_...`; what the processor lacks is not used. AVX2 and AVX-512 give the
    /// same bits, the baseline others.
    pub level: i32,
}

fn level(level: i32) -> Result<Option<Level>, Error> {
    match level {
        TORON_LEVEL_BEST => Ok(None),
        TORON_LEVEL_BASELINE => Ok(Some(Level::Baseline)),
        TORON_LEVEL_AVX2 => Ok(Some(Level::Avx2)),
        TORON_LEVEL_AVX512 => Ok(Some(Level::Avx512)),
        _ => Err(Error::Argument {
            name: "level",
            value: f64::from(level),
            wanted: "0 (the best), 1 (baseline), 2 (AVX2) or 3 (AVX-512)",
        }),
    }
}

impl<T> Block<T> {
    fn pointers(&self) -> Result<Pointers<T>, Error>
    where
        T: Copy,
    {
        let stride = self.leading_dimension;
        Ok(Pointers {
            n: self.n,
            leading_dimension: stride,
            deformation_gradient: components(self.deformation_gradient, stride),
            fibre: components(self.fibre, stride),
            energies_old: self.energies_old,
            invariants_old: self.invariants_old,
            failure_old: self.failure_old,
            density: self.density,
            stress: components_mut(self.stress, stride),
            energies: self.energies,
            invariants: self.invariants,
            failure: self.failure,
            modes: self.modes,
            wave_speed: self.wave_speed,
            tangent: core::ptr::null_mut(),
            measure: Measure::Material,
            status: self.status,
            level: level(self.level)?,
        })
    }
}

/// # Safety
/// As for `toron_hyperelastic_validate_f64`.
unsafe fn validate<T: Real + Into<f64>>(
    values: *const T,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    let values = unsafe { properties(values, count, &parameters::HYPERELASTIC) };
    let error = values.and_then(Hyperelastic::new).err();
    // SAFETY: the caller's promise.
    unsafe {
        store(&[error.map_or(status::OK, |error| error.code())], status);
        write_text(message, capacity, |sink| {
            if let Some(error) = error {
                error.describe(sink);
            }
        })
    }
}

/// Checks the properties of the hyperelastic law.
///
/// - `values`, `count`: the properties in the table's order.
/// - `message`, `capacity`: where to write which property is wrong, its value and what is allowed: at most `capacity`
///   bytes, always terminated, empty where all is well. `message` may be null and `capacity` 0.
/// - `status`: 0, `TORON_NULL_ARGUMENT` or a −2xx code; may be null.
///
/// Returns the length of the whole message without the terminator, 0 where all is well.
///
/// # Safety
/// `values` is null or points to `count` values; `message` is null or has room for `capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_validate_f64(
    values: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    in_default_environment(move || unsafe { validate(values, count, message, capacity, status) })
}

/// As `toron_hyperelastic_validate_f64`, in single precision.
///
/// # Safety
/// As for `toron_hyperelastic_validate_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_validate_f32(
    values: *const f32,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    in_default_environment(move || unsafe { validate(values, count, message, capacity, status) })
}

/// What one call about one point gets beside its properties: F by columns, the fibre direction if it is not the properties', and
/// the old state, whose place the new one may take.
struct PointArguments<'a, T> {
    f: &'a [[T; 3]; 3],
    fibre: Option<[T; 3]>,
    state: &'a [Cell<T>; state::HYPERELASTIC_STATE],
}

impl<'a, T: Real> PointArguments<'a, T> {
    /// With `fresh` in place of an old state that is null.
    ///
    /// # Safety
    /// Every pointer is null or has as many values: 9, 3, 11.
    #[inline(always)]
    unsafe fn new(
        deformation_gradient: *const T,
        fibre: *const T,
        state_old: *const T,
        fresh: &'a [Cell<T>; state::HYPERELASTIC_STATE],
    ) -> Result<Self, Error> {
        // SAFETY: the caller's promise.
        unsafe {
            let f = deformation_gradient.cast::<[[T; 3]; 3]>().as_ref().ok_or(Error::Plain(status::NULL_ARGUMENT))?;
            let fibre = if fibre.is_null() { None } else { Some(*fibre.cast::<[T; 3]>()) };
            Ok(PointArguments { f, fibre, state: state_old.cast::<[Cell<T>; _]>().as_ref().unwrap_or(fresh) })
        }
    }
}

/// Where the answer for one point goes: the caller's arrays. Null is left out.
pub(super) struct PointAnswer<'a, T> {
    pub stress: *mut T,
    pub state: *mut T,
    pub modes: *mut T,
    pub density: T,
    pub wave_speed: *mut T,
    pub tangent: *mut T,
    pub status: &'a mut i32,
}

impl<T: Real> PointAnswer<'_, T> {
    #[inline(always)]
    fn put(self, point: &Point<T>) {
        *self.status = point.status;
        // SAFETY: whoever makes the answer has arrays of these sizes, or null.
        unsafe {
            store(&point.state, self.state);
            store(&point.stress, self.stress);
            store(point.modes.as_flattened(), self.modes);
            if !self.wave_speed.is_null() {
                *self.wave_speed = wave_speed::wave_speed(point.wave_modulus, self.density);
            }
        }
    }
}

impl<T: Real> Sink<T, 0> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, _: [T; 0]) {
        self.put(&point);
    }
}

impl<T: Real> Sink<T, 21> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, moduli: [T; 21]) {
        // SAFETY: whoever makes the answer has room for the matrix.
        unsafe { *self.tangent.cast() = Moduli(moduli).matrix() };
        self.put(&point);
    }
}

impl<T: Real> Sink<T, 81> for PointAnswer<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, nominal: [T; 81]) {
        // SAFETY: whoever makes the answer has room for the matrix.
        unsafe { *self.tangent.cast() = nominal };
        self.put(&point);
    }
}

/// The law between a caller's arrays.
///
/// # Safety
/// As for `toron_hyperelastic_point_f64`.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
unsafe fn point<T: Precision>(
    values: *const T,
    count: size_t,
    deformation_gradient: *const T,
    fibre: *const T,
    state_old: *const T,
    state_new: *mut T,
    stress: *mut T,
    modes: *mut T,
    density: T,
    wave_speed: *mut T,
) -> Result<i32, Error> {
    let fresh = [T::splat(0.0); state::HYPERELASTIC_STATE].map(Cell::new);
    // SAFETY: the caller's promise.
    let (properties, PointArguments { f, fibre, state }) = unsafe {
        (
            properties(values, count, &parameters::HYPERELASTIC)?,
            PointArguments::new(deformation_gradient, fibre, state_old, &fresh)?,
        )
    };
    if !wave_speed.is_null() {
        wave_speed::check_density(density)?;
    }
    let kept = !state_new.is_null();
    let request = Request {
        stress: !stress.is_null(),
        energies: kept,
        invariants: kept,
        failure: kept,
        modes: !modes.is_null(),
        wave_modulus: !wave_speed.is_null(),
    };
    let mut status = status::OK;
    let sink = PointAnswer {
        stress,
        state: state_new,
        modes,
        density,
        wave_speed,
        tangent: core::ptr::null_mut(),
        status: &mut status,
    };
    if request == Request::STRESS_AND_STATE {
        T::once(Call { properties, f, fibre, state, tangent: StressAndState, sink })?;
    } else {
        T::once(Call { properties, f, fibre, state, tangent: Alone(request), sink })?;
    }
    Ok(status)
}

/// The hyperelastic law at one point.
///
/// - `values`, `count`: the properties in the table's order.
/// - `deformation_gradient`: 9 values by columns. Must not be null.
/// - `fibre`: 3 values, the fibre direction, any length; null: the property.
/// - `state_old`: 11 values; null: all 0. `state_new`: room for 11; null: not wanted, and the point cannot fail. They may
///   be the same array.
/// - `stress`: room for 6, Cauchy 11 22 33 12 23 31; `modes`: room for 24, S_el, S_tc, S_td, S_ld (second
///   Piola-Kirchhoff); `wave_speed`: room for 1, an upper bound at the reference density `density`, for current lengths: a
///   solver's time step and bulk viscosity may take it as it is; each may be null.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (no stress, the state as it was).
///
/// # Safety
/// Every pointer is null or has as many values as said; outputs overlap nothing but, exactly, the old state.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_hyperelastic_point_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    modes: *mut f64,
    density: f64,
    wave_speed: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        point(values, count, deformation_gradient, fibre, state_old, state_new, stress, modes, density, wave_speed)
    })
}

/// As `toron_hyperelastic_point_f64`, in single precision.
///
/// # Safety
/// As for `toron_hyperelastic_point_f64`.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_hyperelastic_point_f32(
    values: *const f32,
    count: size_t,
    deformation_gradient: *const f32,
    fibre: *const f32,
    state_old: *const f32,
    state_new: *mut f32,
    stress: *mut f32,
    modes: *mut f32,
    density: f32,
    wave_speed: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        point(values, count, deformation_gradient, fibre, state_old, state_new, stress, modes, density, wave_speed)
    })
}

fn measure(measure: i32) -> Result<Measure, Error> {
    match measure {
        TORON_TANGENT_MATERIAL => Ok(Measure::Material),
        TORON_TANGENT_TRUESDELL => Ok(Measure::Truesdell),
        TORON_TANGENT_JAUMANN => Ok(Measure::Jaumann),
        TORON_TANGENT_NOMINAL => Ok(Measure::Nominal),
        _ => Err(Error::Argument {
            name: "measure",
            value: f64::from(measure),
            wanted: "0 (material), 1 (Truesdell), 2 (Jaumann) or 3 (nominal)",
        }),
    }
}

/// # Safety
/// As for `toron_hyperelastic_point_tangent_f64`.
#[allow(clippy::too_many_arguments)]
unsafe fn point_tangent<T: Precision>(
    values: *const T,
    count: size_t,
    deformation_gradient: *const T,
    fibre: *const T,
    state_old: *const T,
    state_new: *mut T,
    stress: *mut T,
    measure: i32,
    tangent: *mut T,
) -> Result<i32, Error> {
    let fresh = [T::splat(0.0); state::HYPERELASTIC_STATE].map(Cell::new);
    // SAFETY: the caller's promise.
    let (properties, PointArguments { f, fibre, state }) = unsafe {
        (
            properties(values, count, &parameters::HYPERELASTIC)?,
            PointArguments::new(deformation_gradient, fibre, state_old, &fresh)?,
        )
    };
    let measure = self::measure(measure)?;
    if tangent.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    let kept = !state_new.is_null();
    let request =
        Request { stress: true, energies: kept, invariants: kept, failure: kept, modes: false, wave_modulus: false };
    let mut status = status::OK;
    let sink = PointAnswer {
        stress,
        state: state_new,
        modes: core::ptr::null_mut(),
        density: T::splat(1.0),
        wave_speed: core::ptr::null_mut(),
        tangent,
        status: &mut status,
    };
    if measure == Measure::Nominal {
        T::once(Call { properties, f, fibre, state, tangent: Nine(request), sink })?;
    } else {
        T::once(Call { properties, f, fibre, state, tangent: Six(request, measure), sink })?;
    }
    Ok(status)
}

/// The hyperelastic law at one point, with a tangent.
///
/// - `values`, `count`, `deformation_gradient`, `fibre`, `state_old`, `state_new`, `stress`: as for
///   `toron_hyperelastic_point_f64`.
/// - `measure`: which tangent, `TORON_TANGENT_MATERIAL`, `_TRUESDELL`, `_JAUMANN` or `_NOMINAL`.
/// - `tangent`: room for 36 values (81 for `_NOMINAL`), a symmetric matrix; must not be null. The order of rows and columns
///   is 11 22 33 12 23 31, columns of engineering shears; for `_NOMINAL` 11 21 31 12 22 32 13 23 33.
///
/// The call that detects failure gives the intact tangent, later ones zeros. At a kink (I_el = 0, I_tc = 0) it is the one of
/// loading.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (no stress, no stiffness, the state as it was).
///
/// # Safety
/// Every pointer is null or has as many values as said; outputs overlap nothing but, exactly, the old state.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_hyperelastic_point_tangent_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        point_tangent(values, count, deformation_gradient, fibre, state_old, state_new, stress, measure, tangent)
    })
}

/// As `toron_hyperelastic_point_tangent_f64`, in single precision.
///
/// # Safety
/// As for `toron_hyperelastic_point_tangent_f64`.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_hyperelastic_point_tangent_f32(
    values: *const f32,
    count: size_t,
    deformation_gradient: *const f32,
    fibre: *const f32,
    state_old: *const f32,
    state_new: *mut f32,
    stress: *mut f32,
    measure: i32,
    tangent: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        point_tangent(values, count, deformation_gradient, fibre, state_old, state_new, stress, measure, tangent)
    })
}

/// The least stable wave: the smallest eigenvalue of the acoustic tensor times the reference density, over all directions.
///
/// Below 0 the material is not elliptic: waves of imaginary speed, results that depend on the mesh.
///
/// - `values`, `count`, `deformation_gradient`, `fibre`: as for `toron_hyperelastic_point_f64`.
/// - `least`: one value, out, a stress; `direction`: 3 values, out, the wave's normal in space, or null.
///
/// Returns 0; a −1xx, −2xx or −3xx code, and nothing is written.
///
/// # Safety
/// Every pointer is null or has as many values as said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_least_acoustic_eigenvalue_f64(
    values: *const f64,
    count: size_t,
    deformation_gradient: *const f64,
    fibre: *const f64,
    least: *mut f64,
    direction: *mut f64,
) -> i32 {
    entry(move || {
        // SAFETY: the caller's promise.
        let law = Hyperelastic::new(unsafe { properties(values, count, &parameters::HYPERELASTIC) }?)?;
        if deformation_gradient.is_null() || least.is_null() {
            return Err(Error::Plain(status::NULL_ARGUMENT));
        }
        // SAFETY: the caller's promise.
        unsafe {
            let fibre = if fibre.is_null() { None } else { Some(*fibre.cast::<[f64; 3]>()) };
            let wave = law.acoustic(&*deformation_gradient.cast(), fibre).map_err(Error::Plain)?.least();
            store(&[wave.modulus], least);
            store(&wave.direction, direction);
        }
        Ok(status::OK)
    })
}

/// # Safety
/// As for `toron_hyperelastic_block_f64`.
unsafe fn block<T: Precision>(values: *const T, count: size_t, block: *const Block<T>) -> Result<i32, Error> {
    if block.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    // SAFETY: the caller's promise.
    unsafe {
        let properties = properties(values, count, &parameters::HYPERELASTIC)?;
        raw_block_of(properties, &(*block).pointers()?)
    }
}

/// The hyperelastic law at a block of points.
///
/// - `values`, `count`: the properties in the table's order, the same for all points.
/// - `block`: the arrays, see the structure; all theirs stay the caller's.
///
/// Returns the worst status code of the points: 0, or the most negative −3xx code (that point carries no stress and keeps
/// its state; the others are not affected); or a −1xx or −2xx code, and nothing is written.
///
/// # Safety
/// Every array has as many values as the structure says; outputs overlap nothing but, exactly, the old state they
/// replace.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_f64(
    values: *const f64,
    count: size_t,
    block: *const Block<f64>,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { self::block(values, count, block) })
}

/// As `toron_hyperelastic_block_f64`, in single precision.
///
/// # Safety
/// As for `toron_hyperelastic_block_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_f32(
    values: *const f32,
    count: size_t,
    block: *const Block<f32>,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { self::block(values, count, block) })
}

/// # Safety
/// As for `toron_hyperelastic_block_tangent_f64`.
unsafe fn block_tangent<T: Precision>(
    values: *const T,
    count: size_t,
    block: *const Block<T>,
    measure: i32,
    tangent: *mut T,
) -> Result<i32, Error> {
    if block.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    // SAFETY: the caller's promise.
    unsafe {
        let properties = properties(values, count, &parameters::HYPERELASTIC)?;
        let measure = self::measure(measure)?;
        raw_block_of(properties, &Pointers { tangent, measure, ..(*block).pointers()? })
    }
}

/// The hyperelastic law at a block of points, with a tangent.
///
/// - `values`, `count`, `block`: as for `toron_hyperelastic_block_f64`.
/// - `measure`: which tangent, as for `toron_hyperelastic_point_tangent_f64`.
/// - `tangent`: 36 components (81 for `TORON_TANGENT_NOMINAL`), component-major with the block's leading dimension: entry
///   (row, column), counted from 0, is component 6 row + column (9 row + column). The whole symmetric matrix. Null: none.
///
/// Returns as `toron_hyperelastic_block_f64` does; a point at fault, or failed before, has a tangent of zeros.
///
/// # Safety
/// As for `toron_hyperelastic_block_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_tangent_f64(
    values: *const f64,
    count: size_t,
    block: *const Block<f64>,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { block_tangent(values, count, block, measure, tangent) })
}

/// As `toron_hyperelastic_block_tangent_f64`, in single precision.
///
/// # Safety
/// As for `toron_hyperelastic_block_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_hyperelastic_block_tangent_f32(
    values: *const f32,
    count: size_t,
    block: *const Block<f32>,
    measure: i32,
    tangent: *mut f32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { block_tangent(values, count, block, measure, tangent) })
}

// ---------------------------------------------------------------------------------------------------------------------
// The linear elastic law

/// # Safety
/// As for `toron_linear_elastic_step_f64`.
unsafe fn linear_elastic<T: Precision>(values: *const T, count: size_t) -> Result<LinearElastic<T>, Error> {
    // SAFETY: the caller's promise.
    LinearElastic::new(unsafe { properties(values, count, &parameters::LINEAR_ELASTIC) }?)
}

fn rotation(rotation: i32) -> Result<Rotation, Error> {
    match rotation {
        TORON_ROTATION_FIBRE => Ok(Rotation::Fibre),
        TORON_ROTATION_POLAR => Ok(Rotation::Polar),
        TORON_ROTATION_SPIN => Ok(Rotation::Spin),
        _ => Err(Error::Argument {
            name: "rotation",
            value: f64::from(rotation),
            wanted: "0 (fibre), 1 (polar) or 2 (spin)",
        }),
    }
}

fn criterion(criterion: i32) -> Result<Criterion, Error> {
    match criterion {
        TORON_CRITERION_PRINCIPAL => Ok(Criterion::LargestPrincipal),
        TORON_CRITERION_FIBRE => Ok(Criterion::FibreStress),
        _ => Err(Error::Argument {
            name: "criterion",
            value: f64::from(criterion),
            wanted: "0 (largest principal stress) or 1 (fibre stress)",
        }),
    }
}

/// # Safety
/// As for `toron_linear_elastic_step_f64`.
unsafe fn store_linear(point: &LinearPoint, state_new: *mut f64, stress: *mut f64) -> i32 {
    // SAFETY: the caller's promise.
    unsafe {
        store(&point.state, state_new);
        store(&point.stress, stress);
    }
    point.status
}

/// Checks the properties of the linear elastic law; as `toron_hyperelastic_validate_f64`.
///
/// # Safety
/// As for `toron_hyperelastic_validate_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_validate_f64(
    values: *const f64,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
    status: *mut i32,
) -> size_t {
    // SAFETY: the caller's promise.
    in_default_environment(move || unsafe {
        let error = linear_elastic(values, count).err();
        store(&[error.map_or(status::OK, |error| error.code())], status);
        write_text(message, capacity, |sink| {
            if let Some(error) = error {
                error.describe(sink);
            }
        })
    })
}

/// The material axes of the linear elastic law in the reference placement: where the axes of
/// `TORON_ROTATION_SPIN` start.
///
/// `axes`: room for 9 values, the three axes one after the other. Returns 0, `TORON_NULL_ARGUMENT` or a −2xx code.
///
/// # Safety
/// `values` points to `count` values; `axes` has room for 9.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_axes_f64(values: *const f64, count: size_t, axes: *mut f64) -> i32 {
    if axes.is_null() {
        return status::NULL_ARGUMENT;
    }
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        store(linear_elastic(values, count)?.reference_axes().as_slice(), axes);
        Ok(status::OK)
    })
}

/// # Safety
/// As for `toron_linear_elastic_step_f64`.
#[allow(clippy::too_many_arguments)]
unsafe fn linear_step(
    values: *const f64,
    count: size_t,
    f_old: *const f64,
    f_new: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    rotation: i32,
    criterion: i32,
    axes: *mut f64,
    tangent: Option<(i32, *mut f64)>,
) -> Result<i32, Error> {
    // SAFETY: the caller's promise.
    let law = unsafe { linear_elastic(values, count) }?;
    let criterion = self::criterion(criterion)?;
    let rotation = self::rotation(rotation)?;
    let wanted = tangent.map(|(measure, to)| self::measure(measure).map(|measure| (measure, to))).transpose()?;
    let spin = rotation == Rotation::Spin;
    if wanted.is_some_and(|(_, to)| to.is_null()) {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    if f_old.is_null() || f_new.is_null() || (spin && axes.is_null()) {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    // SAFETY: the caller's promise; axes are read for the spin frame only.
    unsafe {
        let mut turning = if spin { Matrix3::from_column_slice(&load::<9>(axes)) } else { law.reference_axes() };
        let [f0, f1] = [f_old, f_new].map(|f| Matrix3::from_column_slice(&load::<9>(f)));
        let old = load(state_old);
        let point = match wanted {
            None => law.step(&f0, &f1, &old, rotation, criterion, &mut turning),
            Some((measure, to)) => {
                let (point, tangent) = law.step_with_tangent(&f0, &f1, &old, rotation, criterion, &mut turning);
                match tangent.matrix(measure, &f1, &point.stress) {
                    Some(rows) => store(rows.as_flattened(), to),
                    None if measure == Measure::Nominal => store(&tangent.nominal(&f1, &point.stress), to),
                    None => store(&[0.0; 36], to),
                }
                point
            }
        };
        if spin {
            store(turning.as_slice(), axes);
        }
        Ok(store_linear(&point, state_new, stress))
    }
}

/// The linear elastic law over a step, from the deformation gradients at both ends.
///
/// - `values`, `count`: the properties in the table's order.
/// - `f_old`, `f_new`: 9 values each, by columns. Must not be null.
/// - `state_old`: 10 values; null: all 0. `state_new`: room for 10, or null. They may be the same array.
/// - `stress`: room for 6, Cauchy stress in space 11 22 33 12 23 31, or null.
/// - `rotation`: the frame that turns with the material, `TORON_ROTATION_FIBRE` (what a yarn needs), `_POLAR` or `_SPIN`.
/// - `criterion`: `TORON_CRITERION_PRINCIPAL` or `_FIBRE`.
/// - `axes`: 9 values, read and advanced for `TORON_ROTATION_SPIN`, which has to be told where the material axes are:
///   start with `toron_linear_elastic_axes_f64`. May be null for the other frames.
///
/// Returns 0, a −1xx or −2xx code (nothing is written), or a −3xx code (no stress, the state as it was).
///
/// # Safety
/// Every pointer is null or has as many values as said.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_linear_elastic_step_f64(
    values: *const f64,
    count: size_t,
    f_old: *const f64,
    f_new: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    rotation: i32,
    criterion: i32,
    axes: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        linear_step(values, count, f_old, f_new, state_old, state_new, stress, rotation, criterion, axes, None)
    })
}

/// As `toron_linear_elastic_step_f64`, with the tangent consistent with the step.
///
/// - `measure`, `tangent`: as for `toron_hyperelastic_point_tangent_f64`, but the matrix is not symmetric: entry (row, column)
///   is at `6 row + column`, for `TORON_TANGENT_NOMINAL` at `row + 9 column`. `TORON_TANGENT_JAUMANN` has DDSDDE's
///   entries, in the order of the stress here.
///
/// # Safety
/// Every pointer is null or has as many values as said.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_linear_elastic_step_tangent_f64(
    values: *const f64,
    count: size_t,
    f_old: *const f64,
    f_new: *const f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    rotation: i32,
    criterion: i32,
    axes: *mut f64,
    measure: i32,
    tangent: *mut f64,
) -> i32 {
    let tangent = Some((measure, tangent));
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        linear_step(values, count, f_old, f_new, state_old, state_new, stress, rotation, criterion, axes, tangent)
    })
}

/// The linear elastic law for an increment of strain in a frame that the host keeps.
///
/// - `strain`: 6 tensor components 11 22 33 12 23 31 (half the engineering shears) in the material axes. Must not be
///   null.
/// - `jacobian`: the volume ratio J, which weighs the work; 1 where it is not known.
/// - `state_old`, `state_new`, `criterion`: as for `toron_linear_elastic_step_f64`; `stress`: in that frame.
///
/// The law is as good as the frame: axes that follow the host's polar rotation or spin let the stiff direction drift off
/// a sheared fibre. Returns as `toron_linear_elastic_step_f64` does.
///
/// # Safety
/// Every pointer is null or has as many values as said.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)]
pub unsafe extern "C" fn toron_linear_elastic_increment_f64(
    values: *const f64,
    count: size_t,
    strain: *const f64,
    jacobian: f64,
    state_old: *const f64,
    state_new: *mut f64,
    stress: *mut f64,
    criterion: i32,
) -> i32 {
    if strain.is_null() {
        return status::NULL_ARGUMENT;
    }
    // SAFETY: the caller's promise.
    entry(move || unsafe {
        let law = linear_elastic(values, count)?;
        let point = law.increment(&load(strain), jacobian, &load(state_old), self::criterion(criterion)?);
        Ok(store_linear(&point, state_new, stress))
    })
}

/// A block of points of the linear elastic law: component-major arrays, component c of point i at
/// `c * leading_dimension + i`.
///
/// Null pointers are left out: an output that is null is not computed. The old state may be the same array as the new one.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct LinearBlock<T> {
    /// Number of points, and the distance from one component to the next, at least as many.
    pub n: size_t,
    pub leading_dimension: size_t,
    /// In, 9 components each: F by columns at both ends of the step. Must not be null.
    pub f_old: *const T,
    pub f_new: *const T,
    /// In and out, 9: the material axes in space, one after the other. Must not be null for `TORON_ROTATION_SPIN`; neither read
    /// nor written for the other frames.
    pub axes: *mut T,
    /// In, 10: the old state; null: all 0.
    pub state_old: *const T,
    /// Out, 10: the new state. Null: no point fails; one whose old latch is set stays failed.
    pub state_new: *mut T,
    /// Out, 6: Cauchy stress in space 11 22 33 12 23 31.
    pub stress: *mut T,
    /// Out: a status code for each point.
    pub status: *mut i32,
    /// In: the instructions to use, one of `TORON_LEVEL_...`; what the processor lacks is not used. AVX2 and AVX-512 give the
    /// same bits, the baseline others.
    pub level: i32,
}

/// # Safety
/// As for `toron_linear_elastic_block_f64`.
unsafe fn linear_block<T: LinearPrecision>(
    values: *const T,
    count: size_t,
    block: *const LinearBlock<T>,
    rotation: i32,
    criterion: i32,
) -> Result<i32, Error> {
    if block.is_null() {
        return Err(Error::Plain(status::NULL_ARGUMENT));
    }
    // SAFETY: the caller's promise.
    unsafe {
        let law = linear_elastic(values, count)?;
        let LinearBlock { n, leading_dimension, f_old, f_new, axes, state_old, state_new, stress, status, level } =
            *block;
        law.raw_block(&LinearPointers {
            n,
            leading_dimension,
            f_old,
            f_new,
            axes,
            state_old,
            state_new,
            stress,
            status,
            rotation: self::rotation(rotation)?,
            criterion: self::criterion(criterion)?,
            level: self::level(level)?,
        })
    }
}

/// The linear elastic law over a step at a block of points.
///
/// - `values`, `count`: the properties in the table's order, the same for all points.
/// - `block`: the arrays, see the structure; all theirs stay the caller's.
/// - `rotation`, `criterion`: as for `toron_linear_elastic_step_f64`.
///
/// Returns the worst status code of the points: 0, or the most negative −3xx code (that point carries no stress and keeps
/// its state and axes; the others are not affected); or a −1xx or −2xx code, and nothing is written.
///
/// # Safety
/// Every array has as many values as the structure says; outputs overlap nothing but, exactly, the old state they
/// replace.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_block_f64(
    values: *const f64,
    count: size_t,
    block: *const LinearBlock<f64>,
    rotation: i32,
    criterion: i32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { linear_block(values, count, block, rotation, criterion) })
}

/// As `toron_linear_elastic_block_f64`, in single precision.
///
/// # Safety
/// As for `toron_linear_elastic_block_f64`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn toron_linear_elastic_block_f32(
    values: *const f32,
    count: size_t,
    block: *const LinearBlock<f32>,
    rotation: i32,
    criterion: i32,
) -> i32 {
    // SAFETY: the caller's promise.
    entry(move || unsafe { linear_block(values, count, block, rotation, criterion) })
}
