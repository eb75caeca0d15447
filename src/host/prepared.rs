//! Laws prepared once, in the caller's memory.

use libc::size_t;

use super::entry_points::{Message, entry, properties};
use crate::law::block::Precision;
use crate::law::error::Error;
use crate::law::frictional::Frictional;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::Law;
use crate::law::linear_elastic::LinearElastic;
use crate::law::prepared::{PreparedFrictional, PreparedHyperelastic, PreparedLinearElastic};
use crate::law::status;
use crate::law::user::{User, UserMaterial};

/// A prepared law as plain numbers, without padding: they may be copied byte by byte.
pub trait AsNumbers<T: Precision>: Law<T> {
    /// What the structure of C holds of the law.
    type Numbers: Copy;
    /// The numbers of this law.
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

impl<T: Precision> AsNumbers<T> for Frictional<T> {
    type Numbers = PreparedFrictional<T>;

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
pub unsafe trait PreparedLaw<T: Precision>: Copy {
    /// The law that has been prepared.
    type Law: AsNumbers<T>;
    /// Eight letters: the law, the precision, the version of the numbers' order and meaning.
    const TAG: u64;
    /// Its name in C, and the function that prepares it.
    const NAME: &'static str;
    const PREPARED_BY: &'static str;
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
pub unsafe fn numbers<'a, T: Precision, L: PreparedLaw<T>>(law: *const L) -> Result<&'a NumbersOf<T, L>, Error> {
    if law.is_null() {
        return Err(Error::Null { name: "law" });
    }
    // SAFETY: not null, as just checked, and of the form that the trait says: tag, size, the numbers, a last word.
    // Numbers may have any bytes.
    unsafe {
        let words = law.cast::<u64>();
        let (size, last) = (size_of::<L>() as u64, size_of::<L>() / 8 - 1);
        if *words != L::TAG || *words.add(1) != size || *words.add(last) != L::TAG {
            return Err(Error::NotPrepared { by: L::PREPARED_BY });
        }
        Ok(&*words.add(2).cast())
    }
}

/// Checks the properties and prepares the law: a function `..._prepare_...` of C.
///
/// # Safety
/// What [a caller promises](super#what-a-caller-promises).
pub unsafe fn prepare<T: Precision, L: PreparedLaw<T>>(
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
        // SAFETY: not null and of this size, as just checked; a number whose bytes are all 0 is 0. The trait says where
        // the numbers are.
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
