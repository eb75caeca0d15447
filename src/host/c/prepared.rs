//! Laws prepared once, in the caller's memory.

use libc::{c_char, size_t};

use crate::host::entry_points::{Message, entry, properties};
use crate::law::block::Precision;
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::prepared::{PreparedHyperelastic, PreparedLinearElastic};
use crate::law::status;
use crate::law::user::{User, UserMaterial};

/// The hyperelastic law, prepared by `toron_hyperelastic_prepare_f64` or `_f32`: numbers only, without a pointer. It may be
/// copied, shared by threads and sent to other processes of the same byte order, and needs no release. Its content is the
/// library's own; its size is the same in all versions of this interface.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct HyperelasticLaw<T> {
    /// Tells law, precision and layout; the size of the structure; the library's own numbers.
    pub tag: u64,
    pub size: u64,
    pub values: [T; 62],
}

/// The linear elastic law, prepared by `toron_linear_elastic_prepare_f64` or `_f32`; as `toron_hyperelastic_f64` else.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct LinearElasticLaw<T> {
    /// Tells law, precision and layout; the size of the structure; the library's own numbers.
    pub tag: u64,
    pub size: u64,
    pub values: [T; 30],
}

/// A prepared law as plain numbers, without padding: they may be copied byte by byte.
pub trait AsNumbers<T: Precision>: Law<T> {
    type Numbers: Copy;
    fn numbers(&self) -> Self::Numbers;
    /// The law that these numbers came from.
    fn of(numbers: &Self::Numbers) -> Self;
}

impl<T: Precision> AsNumbers<T> for Hyperelastic<T> {
    type Numbers = PreparedHyperelastic<T>;

    fn numbers(&self) -> Self::Numbers {
        self.into()
    }

    #[inline(always)]
    fn of(numbers: &Self::Numbers) -> Self {
        numbers.law()
    }
}

impl<T: Precision> AsNumbers<T> for LinearElastic<T> {
    type Numbers = PreparedLinearElastic<T>;

    fn numbers(&self) -> Self::Numbers {
        self.into()
    }

    #[inline(always)]
    fn of(numbers: &Self::Numbers) -> Self {
        numbers.law()
    }
}

impl<M: UserMaterial, T: Precision> AsNumbers<T> for User<M, T> {
    type Numbers = User<M, T>;

    fn numbers(&self) -> Self::Numbers {
        *self
    }

    #[inline(always)]
    fn of(numbers: &Self::Numbers) -> Self {
        *numbers
    }
}

/// A prepared law of the C interface.
///
/// # Safety
/// The type is `repr(C)`: tag, size, the law's numbers, and a last word behind them.
pub(super) unsafe trait PreparedLaw<T: Precision>: Copy {
    type Law: AsNumbers<T>;
    /// Eight letters: the law, the precision, the version of the numbers' order and meaning.
    const TAG: u64;
    /// Its name in C, and the function that prepares it.
    const NAME: &'static str;
    const PREPARED_BY: &'static str;
}

macro_rules! prepared_laws {
    ($($structure:ident, $t:ty, $numbers:ident, $law:path, $tag:literal, $name:literal, $by:literal;)*) => {$(
        const _: () = assert!(size_of::<$structure<$t>>() >= 16 + size_of::<$numbers<$t>>() + 8);
        const _: () = assert!(size_of::<$structure<$t>>().is_multiple_of(8));
        // SAFETY: its values are more than the numbers, which are as many values.
        unsafe impl PreparedLaw<$t> for $structure<$t> {
            type Law = $law;
            const TAG: u64 = u64::from_le_bytes(*$tag);
            const NAME: &'static str = $name;
            const PREPARED_BY: &'static str = $by;
        }
    )*};
}

prepared_laws! {
    HyperelasticLaw, f64, PreparedHyperelastic, Hyperelastic<f64>, b"HE-f64-1", "toron_hyperelastic_f64",
        "toron_hyperelastic_prepare_f64";
    HyperelasticLaw, f32, PreparedHyperelastic, Hyperelastic<f32>, b"HE-f32-1", "toron_hyperelastic_f32",
        "toron_hyperelastic_prepare_f32";
    LinearElasticLaw, f64, PreparedLinearElastic, LinearElastic<f64>, b"LE-f64-1", "toron_linear_elastic_f64",
        "toron_linear_elastic_prepare_f64";
    LinearElasticLaw, f32, PreparedLinearElastic, LinearElastic<f32>, b"LE-f32-1", "toron_linear_elastic_f32",
        "toron_linear_elastic_prepare_f32";
}

type NumbersOf<T, L> = <<L as PreparedLaw<T>>::Law as AsNumbers<T>>::Numbers;

/// The numbers of a caller's prepared law.
///
/// # Errors
/// It is null, or has not been prepared as this law.
///
/// # Safety
/// `law` is null or points to a structure of this type.
#[inline(always)]
pub(super) unsafe fn numbers<'a, T: Precision, L: PreparedLaw<T>>(law: *const L) -> Result<&'a NumbersOf<T, L>, Error> {
    if law.is_null() {
        return Err(Error::Null { name: "law" });
    }
    // SAFETY: not null, as just checked, and of the form that the trait says: tag, size, the numbers, a last word. Numbers may have any
    // bytes.
    unsafe {
        let words = law.cast::<u64>();
        let (size, last) = (size_of::<L>() as u64, size_of::<L>() / 8 - 1);
        if *words != L::TAG || *words.add(1) != size || *words.add(last) != L::TAG {
            return Err(Error::NotPrepared { by: L::PREPARED_BY });
        }
        Ok(&*words.add(2).cast())
    }
}

/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub(super) unsafe fn prepare<T: Precision, L: PreparedLaw<T>>(
    law: *mut L,
    size: size_t,
    values: *const T,
    count: size_t,
    message: Message,
) -> i32 {
    let body = move || {
        if law.is_null() {
            return Err(Error::Null { name: "law" });
        }
        if size != size_of::<L>() {
            return Err(Error::Size { structure: L::NAME, size, known: size_of::<L>() });
        }
        // SAFETY: `properties` refuses null, and there are `count` values.
        let values = unsafe { properties(values, count, L::Law::DESCRIPTION.properties) }?;
        let numbers = L::Law::new(values)?.numbers();
        // SAFETY: not null and of this size, as just checked; a number whose bytes are all 0 is 0. The trait says where the numbers
        // are.
        unsafe {
            law.write_bytes(0, 1);
            let words = law.cast::<u64>();
            *words = L::TAG;
            *words.add(1) = size_of::<L>() as u64;
            *words.add(2).cast() = numbers;
            // Again at the end, which shows a copy that is cut off.
            *words.add(size_of::<L>() / 8 - 1) = L::TAG;
        }
        Ok(status::OK)
    };
    // SAFETY: the message is the C caller's, and so are the arguments, which `body` checks.
    unsafe { entry(message, body) }
}

macro_rules! entries {
    ($t:ty: $hyperelastic:ident, $linear_elastic:ident) => {
        /// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// What [a caller promises](super#what-a-caller-promises).
        #[inline(never)]
        pub unsafe extern "C" fn $hyperelastic(
            law: *mut HyperelasticLaw<$t>,
            size: size_t,
            properties: *const $t,
            count: size_t,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            // SAFETY: the arguments are the C caller's; `prepare` refuses null.
            unsafe { prepare(law, size, properties, count, Message { text: message, capacity }) }
        }

        /// The entry of the C interface with `toron_` before its name; package `toron-c` documents its arguments.
        ///
        /// # Safety
        /// What [a caller promises](super#what-a-caller-promises).
        #[inline(never)]
        pub unsafe extern "C" fn $linear_elastic(
            law: *mut LinearElasticLaw<$t>,
            size: size_t,
            properties: *const $t,
            count: size_t,
            message: *mut c_char,
            capacity: size_t,
        ) -> i32 {
            // SAFETY: the arguments are the C caller's; `prepare` refuses null.
            unsafe { prepare(law, size, properties, count, Message { text: message, capacity }) }
        }
    };
}

entries!(f64: hyperelastic_prepare_f64, linear_elastic_prepare_f64);
entries!(f32: hyperelastic_prepare_f32, linear_elastic_prepare_f32);
