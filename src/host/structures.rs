//! Structures of the C interface that grow: each begins with its size, and what is 0 is left out.
//!
//! A caller compiled against an older header passes a shorter structure, and what it lacks is 0. One compiled against a
//! newer header passes a longer one; if it is not 0 beyond what this library knows, the call is refused, since a
//! request would be ignored.

use core::mem::MaybeUninit;

use libc::size_t;

use crate::law::error::Error;

/// A structure whose first field is its size.
///
/// # Safety
/// The type is `repr(C)`, without padding; its first field is `size: size_t`; it is valid with any other fields 0.
pub(super) unsafe trait Structure: Copy {
    /// Its name in C, and that of the argument.
    const NAME: &'static str;
    const ARGUMENT: &'static str;
}

/// More than any version of a structure has: a larger size has not been set.
const LARGEST: size_t = 1 << 16;

/// The size that a caller gives to a structure of this version.
///
/// # Errors
/// It is no size of such a structure.
fn check_size<S: Structure>(size: size_t) -> Result<(), Error> {
    let word = size_of::<size_t>();
    if (2 * word..=LARGEST).contains(&size) && size.is_multiple_of(word) {
        return Ok(());
    }
    Err(Error::Size { structure: S::NAME, size, known: size_of::<S>() })
}

/// The structure that a caller passes; one of another size is completed in `buffer`.
///
/// # Errors
/// It is null, has no valid size, or requests what this version does not know.
///
/// # Safety
/// `structure` is null or points to as many bytes as its size says.
#[inline(always)]
pub(super) unsafe fn read<S: Structure>(structure: *const S, buffer: &mut MaybeUninit<S>) -> Result<&S, Error> {
    if structure.is_null() {
        return Err(Error::Null { name: S::ARGUMENT });
    }
    // SAFETY: not null, as just checked: its first field is its size, and so many bytes are there. One of this
    // version's size is one whose fields, pointers and numbers, may have any value.
    unsafe {
        let size = *structure.cast::<size_t>();
        if size == size_of::<S>() {
            return Ok(&*structure);
        }
        read_other(structure, size, buffer)
    }
}

/// # Errors
/// As for [`read`].
///
/// # Safety
/// As for [`read`], with this size.
#[cold]
unsafe fn read_other<S: Structure>(
    structure: *const S,
    size: size_t,
    buffer: &mut MaybeUninit<S>,
) -> Result<&S, Error> {
    check_size::<S>(size)?;
    let known = size_of::<S>();
    *buffer = MaybeUninit::zeroed();
    // SAFETY: of the `size` bytes that are there no more are copied than both versions have, and none behind them is
    // read. What is not copied is 0, which the trait allows.
    unsafe {
        let bytes = structure.cast::<u8>();
        buffer.as_mut_ptr().cast::<u8>().copy_from_nonoverlapping(bytes, size.min(known));
        match (known..size).find(|&i| *bytes.add(i) != 0) {
            Some(offset) => Err(Error::UnknownField { structure: S::NAME, offset, known }),
            None => Ok(buffer.assume_init_ref()),
        }
    }
}

/// Writes a structure to a caller's, as far as that goes; its size stays what the caller set.
///
/// # Errors
/// The caller's is null or has no valid size.
///
/// # Safety
/// `structure` is null or points to as many writable bytes as its size says.
pub(super) unsafe fn write<S: Structure>(value: &S, structure: *mut S) -> Result<(), Error> {
    if structure.is_null() {
        return Err(Error::Null { name: S::ARGUMENT });
    }
    let (head, known) = (size_of::<size_t>(), size_of::<S>());
    // SAFETY: not null, as just checked: `size` bytes may be written, of which `common` is no more, and no less than
    // `head`, since a size is two words at least.
    unsafe {
        let size = *structure.cast::<size_t>();
        check_size::<S>(size)?;
        let (from, to) = (core::ptr::from_ref(value).cast::<u8>(), structure.cast::<u8>());
        let common = size.min(known);
        to.add(head).copy_from_nonoverlapping(from.add(head), common - head);
        to.add(common).write_bytes(0, size - common);
    }
    Ok(())
}

/// Names structures in both precisions, and the argument that each is.
macro_rules! structures {
    ($($structure:ident, $double:literal, $single:literal, $argument:literal;)*) => {$(
        // SAFETY: of the fields one is the size, and the others are pointers and numbers, which may be 0; that there is
        // no padding is asserted where the structure is defined.
        unsafe impl<T: $crate::law::number::real::Scalar> $crate::host::structures::Structure for $structure<T> {
            const NAME: &'static str = if T::WIDE_RANGE { $double } else { $single };
            const ARGUMENT: &'static str = $argument;
        }

        impl<T: $crate::law::number::real::Scalar> $structure<T> {
            /// With its size set, and everything else left out.
            pub fn empty() -> Self {
                // SAFETY: as the trait says, all fields may be 0.
                let zeroed = unsafe { core::mem::MaybeUninit::<Self>::zeroed().assume_init() };
                $structure { size: size_of::<Self>(), ..zeroed }
            }
        }
    )*};
}
pub(super) use structures;
