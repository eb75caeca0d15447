//! The entries of the C interface, for the shims of the solver's SDK. The order of the solver's arguments stands where
//! the symbols are exported; here they are structures.

use core::slice;

use libc::{c_char, size_t};

use crate::host::entry_points::{Message, check_pointers, entry};
use crate::law::block::MOST;
use crate::law::error::Error;
use crate::law::status;

use super::engine::{Group, evaluate_material};
use super::laws::{Laws, MyReal};
use super::starter::{listing, read};

/// The arguments of the starter's routine, `LECMUSERnn`. Who makes one promises that each pointer is null or valid for
/// what is said.
#[derive(Clone, Copy, Debug)]
pub struct MaterialCard<T> {
    /// nn.
    pub number: i32,
    /// `count` numbers of the card behind the density.
    pub values: *const T,
    pub count: size_t,
    /// UPARAM, out: MAXUPARAM values.
    pub uparam: *mut T,
    pub maxuparam: i32,
    /// NUPARAM, NUVAR and PARMAT(1), out: 1 value each.
    pub nuparam: *mut i32,
    pub nuvar: *mut i32,
    pub parmat: *mut T,
}

/// A line of the starter's listing. Who makes one promises that each pointer is null or valid for what is said.
#[derive(Clone, Copy, Debug)]
pub struct ListingLine<T> {
    /// `nuparam` values, as the starter's routine has written them.
    pub uparam: *const T,
    pub nuparam: i32,
    /// Counted from 0.
    pub line: i32,
    /// Out: at most `capacity` bytes.
    pub text: *mut c_char,
    pub capacity: size_t,
}

/// NUPARAM of toron's laws at most.
const MOST_PARAMETERS: usize = <f64 as MyReal>::TORON.most_parameters;

/// # Safety
/// As [`MaterialCard`] says.
unsafe fn read_card<T: MyReal>(card: &MaterialCard<T>) -> Result<i32, Error> {
    check_pointers(&[(card.values, "values"), (card.uparam, "UPARAM"), (card.parmat, "PARMAT")])?;
    check_pointers(&[(card.nuparam.cast_const(), "NUPARAM"), (card.nuvar.cast_const(), "NUVAR")])?;
    if card.count > MOST {
        let (value, greatest) = (card.count as i64, MOST as i64); // as the caller wrote it, if it is negative
        return Err(Error::Range { code: status::BAD_COUNT, name: "count", value, least: 0, greatest });
    }
    let mut own = [T::splat(0.0); MOST_PARAMETERS];
    let room = usize::try_from(card.maxuparam).unwrap_or(0).min(MOST_PARAMETERS);
    // SAFETY: `values` is not null, as just checked: `count` values.
    let values = unsafe { slice::from_raw_parts(card.values, card.count) };
    let material = read(&T::TORON, card.number, values, own.get_mut(..room).unwrap_or_default())?;
    // SAFETY: none is null, as checked above, and UPARAM has `room` values, which `read` does not exceed.
    unsafe {
        card.uparam.copy_from_nonoverlapping(own.as_ptr(), material.parameters);
        *card.nuparam = material.parameters as i32;
        *card.nuvar = material.variables as i32;
        *card.parmat = material.modulus;
    }
    Ok(status::OK)
}

/// # Safety
/// As [`ListingLine`] says.
unsafe fn write_line<T: MyReal>(wanted: &ListingLine<T>) -> Result<i32, Error> {
    let text = Message { text: wanted.text, capacity: wanted.capacity };
    // SAFETY: the text is as `ListingLine` says. Where there is no line, it is empty.
    unsafe { text.write(|_| ()) };
    check_pointers(&[(wanted.uparam, "UPARAM")])?;
    let Ok(count) = usize::try_from(wanted.nuparam) else {
        let (code, value) = (status::BAD_COUNT, i64::from(wanted.nuparam));
        return Err(Error::Range { code, name: "NUPARAM", value, least: 0, greatest: i64::MAX });
    };
    // SAFETY: UPARAM is not null, as just checked: `nuparam` values.
    let uparam = unsafe { slice::from_raw_parts(wanted.uparam, count) };
    let line = usize::try_from(wanted.line).unwrap_or(usize::MAX);
    let mut found = Ok(false);
    // SAFETY: as above.
    unsafe { text.write(|sink| found = listing(&T::TORON, uparam, line, sink)) };
    if found? { Ok(status::OK) } else { Err(Error::Plain(status::UNKNOWN_NAME)) }
}

/// The entries in one precision, compiled here and not in the packages that export them.
macro_rules! entries {
    ($t:ty: $read_card:ident, $write_line:ident, $group:ident, $group_of:ident) => {
        /// The starter's routine.
        ///
        /// # Safety
        /// As [`MaterialCard`] says; `message` is null or has `capacity` bytes.
        #[inline(never)]
        pub unsafe fn $read_card(card: &MaterialCard<$t>, message: *mut c_char, capacity: size_t) -> i32 {
            // SAFETY: the card and the message are as just said.
            unsafe { entry(Message { text: message, capacity }, || read_card(card)) }
        }

        /// A line of the starter's listing, or no text and `TORON_UNKNOWN_NAME` behind the last one.
        ///
        /// # Safety
        /// As [`ListingLine`] says.
        #[inline(never)]
        pub unsafe fn $write_line(wanted: &ListingLine<$t>) -> i32 {
            let no_message = Message { text: core::ptr::null_mut(), capacity: 0 };
            // SAFETY: the line is as just said; no message is wanted.
            unsafe { entry(no_message, || write_line(wanted)) }
        }

        /// The engine's routine, `LUSERnn`.
        ///
        /// # Safety
        /// As for [`evaluate_material`]; `message` is null or has `capacity` bytes.
        pub unsafe fn $group(group: &Group<$t>, message: *mut c_char, capacity: size_t) -> i32 {
            // SAFETY: group and message are as just said.
            unsafe { $group_of(&<$t as MyReal>::TORON, group, message, capacity) }
        }

        /// The same with the laws of another list.
        ///
        /// # Safety
        /// As for [`evaluate_material`]; `message` is null or has `capacity` bytes.
        pub unsafe fn $group_of(laws: &Laws<$t>, group: &Group<$t>, message: *mut c_char, capacity: size_t) -> i32 {
            // SAFETY: group and message are as just said.
            unsafe {
                entry(Message { text: message, capacity }, || evaluate_material(laws, group).map(|()| status::OK))
            }
        }
    };
}

entries!(f64: read_card_f64, write_line_f64, group_f64, group_of_f64);
entries!(f32: read_card_f32, write_line_f32, group_f32, group_of_f32);
