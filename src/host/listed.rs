//! The C interface of a law in a library's list: its tables, the prepared law, blocks. `toron_solvers::c_header` writes
//! its header.

use core::marker::PhantomData;
use core::mem::MaybeUninit;
use core::ptr::{null, null_mut};

use libc::{c_char, size_t};

use super::arguments::{Layout, check_density, check_points, leading_dimension, level, measure_of};
use super::entry_points::{Message, entry, look_up, of_points};
use super::prepared::{AsNumbers, PreparedLaw, numbers};
use super::structures::{Structure, read};
use super::tables::{TableRow, write_row};
use crate::law::block::{Circumstances, Precision, distances};
use crate::law::description::Description;
use crate::law::error::Error;
use crate::law::interface::{Law, Points};
use crate::law::status;

/// What a law of a list, in one precision, is called in C: implemented by a type without content.
pub trait Named<T: Precision>: Copy {
    /// The law itself.
    type Law: AsNumbers<T>;
    /// The structure of the prepared law, the function that prepares it, and the structure of points.
    const PREPARED: &'static str;
    const PREPARE: &'static str;
    const POINTS: &'static str;
}

/// The prepared law: numbers only, without a pointer. `Numbers` are those of the law.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Prepared<N, Numbers> {
    tag: u64,
    size: u64,
    numbers: Numbers,
    end: u64,
    name: PhantomData<N>,
}

/// The prepared law of a name.
pub type PreparedOf<N, T> = Prepared<N, <<N as Named<T>>::Law as AsNumbers<T>>::Numbers>;

/// The size of a law's prepared structure.
pub const fn prepared_size<T: Precision, L: AsNumbers<T>>() -> usize {
    size_of::<Prepared<(), L::Numbers>>()
}

/// A number for each text (FNV-1a), continued from that of the text before.
const fn hash(mut number: u64, text: &str) -> u64 {
    let (bytes, mut i) = (text.as_bytes(), 0);
    while i < bytes.len() {
        number = (number ^ bytes[i] as u64).wrapping_mul(0x0000_0100_0000_01b3);
        i += 1;
    }
    number
}

/// Tells law and precision: from the structure's name and the names of the properties, in their order.
const fn tag<N: Named<T>, T: Precision>() -> u64 {
    let Description { properties, .. } = N::Law::DESCRIPTION;
    let (mut number, mut i) = (hash(0xcbf2_9ce4_8422_2325, N::PREPARED), 0);
    while i < properties.len() {
        number = hash(hash(number, " "), properties[i].name);
        i += 1;
    }
    number
}

// SAFETY: `repr(C)`, and a whole number of words since the tag is one: tag, size, the law's numbers, the last word.
unsafe impl<N: Named<T>, T: Precision> PreparedLaw<T> for PreparedOf<N, T> {
    type Law = N::Law;
    const TAG: u64 = tag::<N, T>();
    const NAME: &'static str = N::PREPARED;
    const PREPARED_BY: &'static str = N::PREPARE;
}

/// Points; the header that `toron_solvers::c_header` writes documents the fields.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ListedPoints<N, T> {
    pub size: size_t,
    pub n: size_t,
    pub leading_dimension: size_t,
    pub measure: i32,
    pub level: i32,
    pub density: f64,
    pub f_old: [*const T; 9],
    pub f_new: [*const T; 9],
    pub fibre: [*const T; 3],
    pub state_old: *const T,
    pub state_new: *mut T,
    pub stress: [*mut T; 6],
    pub tangent: *mut T,
    pub wave_speed: *mut T,
    pub active: *mut T,
    pub status: *mut i32,
    pub time_increment: f64,
    pub time: f64,
    pub temperature: *const T,
    name: PhantomData<N>,
}

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<ListedPoints<(), f64>>() == 5 * 8 + 36 * 8);

// SAFETY: of the fields one is the size, and the others are pointers and numbers, which may be 0; no padding, as has
// just been seen.
unsafe impl<N: Named<T>, T: Precision> Structure for ListedPoints<N, T> {
    const NAME: &'static str = N::POINTS;
    const ARGUMENT: &'static str = "points";
}

impl<N: Named<T>, T: Precision> ListedPoints<N, T> {
    /// The points as the law takes them.
    ///
    /// # Errors
    /// Components of an array of which some have a pointer and others not; a count, a density, a measure or a level
    /// that is not allowed; fibre directions for a law that has no fibre.
    fn checked(&self) -> Result<Points<T>, Error> {
        let (n, leading_dimension) = (self.n, leading_dimension(self.leading_dimension, self.n));
        let layout = Layout::default().or(leading_dimension);
        check_points(n)?;
        check_density::<T>(self.density, !self.wave_speed.is_null() && n > 0)?;
        layout.check(&self.f_old, null(), n, "f_old, one of its components,", distances!("f_old"))?;
        layout.check(&self.f_new, null(), n, "f_new, one of its components,", distances!("f_new"))?;
        layout.check(&self.fibre, null(), n, "fibre, one of its components,", distances!("fibre"))?;
        layout.check(&self.stress, null_mut(), n, "stress, one of its components,", distances!("stress"))?;
        if !N::Law::DESCRIPTION.has_fibre() && !self.fibre[0].is_null() {
            let text = "argument fibre is not null; allowed: null, since this law has no fibre";
            return Err(Error::Setting { code: status::BAD_ARGUMENT, text });
        }
        Ok(Points {
            f_old: layout.components(&self.f_old),
            f_new: layout.components(&self.f_new),
            fibre: layout.components(&self.fibre),
            state_old: N::Law::parts(self.state_old, leading_dimension),
            state_new: N::Law::parts_mut(self.state_new, leading_dimension),
            circumstances: Circumstances {
                time_increment: self.time_increment,
                time: self.time,
                temperature: self.temperature,
            },
            density: T::splat(self.density),
            stress: layout.components_mut(&self.stress),
            wave_speed: self.wave_speed,
            status: self.status,
            active: self.active,
            tangent: self.tangent,
            measure: measure_of(self.tangent, self.measure)?,
            level: level(self.level)?,
            ..Points::without_arrays(n, leading_dimension)
        })
    }
}

/// `NAME_prepare_f64` or `_f32`: checks the properties and prepares the law.
///
/// # Safety
/// `law` is null or points to `size` writable bytes, `values` to `count` values, `message` to `capacity` bytes.
pub unsafe fn prepare<N: Named<T>, T: Precision>(
    law: *mut PreparedOf<N, T>,
    size: size_t,
    values: *const T,
    count: size_t,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: the arguments are the C caller's; `prepare` refuses null.
    unsafe { super::prepared::prepare(law, size, values, count, Message { text: message, capacity }) }
}

/// `NAME_block_f64` or `_f32`: evaluates the law at a block of points.
///
/// # Safety
/// `law` is null or points to a prepared law, `points` to a structure with as many bytes as its size says; the arrays
/// have as many values as the header says, and outputs overlap nothing but, exactly, the old state; `message` is null
/// or has `capacity` bytes.
pub unsafe fn block<N: Named<T>, T: Precision>(
    law: *const PreparedOf<N, T>,
    points: *const ListedPoints<N, T>,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    let body = move || {
        let mut buffer = MaybeUninit::uninit();
        // SAFETY: `numbers` and `read` refuse null, and `checked` and `step` what the law needs and is null; how long
        // the arrays are the C caller promises.
        unsafe {
            let law = N::Law::of(numbers::<T, _>(law)?);
            let points = read(points, &mut buffer)?;
            let told = of_points(law.step(&points.checked()?)?, points.status, points.n);
            law.told(told.map_err(|error| N::Law::DESCRIPTION.named(error))?)
        }
    };
    // SAFETY: the message is the C caller's, and so are the arguments, which `body` checks.
    unsafe { entry(Message { text: message, capacity }, body) }
}

/// `NAME_property`: writes a row of the table of properties.
///
/// # Safety
/// `row` is null or points to a structure with as many bytes as its size says, `message` to `capacity` bytes.
pub unsafe fn property(
    law: &'static Description,
    index: i32,
    row: *mut TableRow,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: row and message are the C caller's; `write_row` refuses a row that is null.
    unsafe { look_up(Message { text: message, capacity }, || write_row(law.properties, index, row)) }
}

/// `NAME_state_variable`: writes a row of the table of state variables.
///
/// # Safety
/// As for [`property`].
pub unsafe fn state_variable(
    law: &'static Description,
    index: i32,
    row: *mut TableRow,
    message: *mut c_char,
    capacity: size_t,
) -> i32 {
    // SAFETY: row and message are the C caller's; `write_row` refuses a row that is null.
    unsafe { look_up(Message { text: message, capacity }, || write_row(law.state, index, row)) }
}
