//! Where the components and points of an array are, and whether its entries are all at different places.

use core::ptr::null;

use super::points::PARTS;
use crate::law::error::Error;
use crate::law::status;

/// The names of an array's leading dimension and stride, for messages.
macro_rules! distances {
    ($array:literal) => {
        [concat!("leading dimension of ", $array), concat!("stride of ", $array)]
    };
}
pub(crate) use distances;

/// The pointers to the components of a component-major array; all null if `array` is.
#[inline(always)]
pub fn components<T, const N: usize>(array: *const T, leading_dimension: usize) -> [*const T; N] {
    let (mut pointers, mut c) = ([array; N], 1);
    while c < N && !array.is_null() {
        pointers[c] = array.wrapping_add(c.wrapping_mul(leading_dimension));
        c += 1;
    }
    pointers
}

/// The same for an array to be written.
#[inline(always)]
pub fn components_mut<T, const N: usize>(array: *mut T, leading_dimension: usize) -> [*mut T; N] {
    let (mut pointers, mut c) = ([array; N], 1);
    while c < N && !array.is_null() {
        pointers[c] = array.wrapping_add(c.wrapping_mul(leading_dimension));
        c += 1;
    }
    pointers
}

/// The pointers to the parts of a state whose rows follow one another; all null if `state` is.
#[inline(always)]
pub(crate) fn parts<T>(state: *const T, leading_dimension: usize, counts: [usize; PARTS]) -> [*const T; PARTS] {
    let (mut pointers, mut part, mut row) = ([null(); PARTS], 0, 0_usize);
    while part < PARTS {
        if counts[part] > 0 && !state.is_null() {
            pointers[part] = state.wrapping_add(row.wrapping_mul(leading_dimension));
        }
        row += counts[part];
        part += 1;
    }
    pointers
}

/// More points, and more numbers between two components, than any memory holds: a greater number is a negative one,
/// converted. An array of 81 components with such distances is still shorter than half the address space.
pub(crate) const MOST: usize = isize::MAX as usize >> 10;

/// Checks that the entries of an array with so many components and points are all at different places, component by
/// component or point by point, and none before its start.
///
/// # Errors
/// Entries may overlap, or are nowhere; `names` are those of the leading dimension and of the stride.
#[inline(always)]
pub(crate) fn check_layout(
    n: usize,
    components: usize,
    leading_dimension: usize,
    stride: usize,
    names: [&'static str; 2],
) -> Result<(), Error> {
    if stride == 1 && leading_dimension >= n && leading_dimension <= MOST {
        return Ok(()); // the usual layout
    }
    check_other_layout(n, components, leading_dimension, stride, names)
}

/// # Errors
/// As for [`check_layout`].
#[cold]
#[inline(never)]
fn check_other_layout(
    n: usize,
    components: usize,
    leading_dimension: usize,
    stride: usize,
    [name, of_stride]: [&'static str; 2],
) -> Result<(), Error> {
    let (code, greatest) = (status::BAD_LEADING_DIMENSION, MOST / n.max(1));
    for (name, value, greatest) in [(of_stride, stride, greatest), (name, leading_dimension, MOST)] {
        if value > greatest {
            // As the caller wrote it, if it is negative.
            return Err(Error::Range { code, name, value: value as i64, least: 1, greatest: greatest as i64 });
        }
    }
    let needed = n.saturating_sub(1).saturating_mul(stride).saturating_add(1);
    let in_rows = leading_dimension > 0 && stride > (components - 1).saturating_mul(leading_dimension);
    if n == 0 || (stride > 0 || n == 1) && (leading_dimension >= needed || in_rows) {
        return Ok(());
    }
    let whole = |x: usize| i64::try_from(x).unwrap_or(i64::MAX);
    // Points in rows: it is the row that is too short.
    let (what, found, wanted) = if leading_dimension == 1 && stride > 1 {
        (of_stride, stride, components)
    } else {
        (name, leading_dimension, needed)
    };
    Err(Error::Count { code, what, found: whole(found), wanted: whole(wanted) })
}
