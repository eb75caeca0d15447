//! The check of properties against the bounds of their table.

use super::error::{Error, Value};
use super::number::real::Real;
use super::parameters::Property;
use super::status::{PROPERTY_COUNT, PROPERTY_NOT_FINITE, PROPERTY_OUT_OF_BOUNDS};

/// The least and the greatest allowed value of each property of a table.
pub(crate) const fn limits<const N: usize>(table: &[Property; N]) -> [[f64; N]; 2] {
    let mut limits = [[f64::MIN; N], [f64::MAX; N]];
    let mut k = 0;
    while k < N {
        let Property { minimum, minimum_excluded, maximum, .. } = table[k];
        limits[0][k] = (if minimum_excluded { minimum.next_up() } else { minimum }).max(f64::MIN);
        limits[1][k] = maximum.min(f64::MAX);
        k += 1;
    }
    limits
}

/// The values as an array, checked as by [`check`]; `limits` are those of the table.
///
/// # Errors
/// As for [`check`].
#[inline(always)]
pub(crate) fn checked<'a, T: Real + Into<f64>, const N: usize>(
    table: &'static [Property; N],
    limits: &[[f64; N]; 2],
    values: &'a [T],
) -> Result<&'a [T; N], Error> {
    let Ok(values) = <&[T; N]>::try_from(values) else { return Err(wrong_number(values.len() as i64, table)) };
    if !within(limits, values) {
        check(table, values)?;
    }
    Ok(values)
}

/// Whether all values are within their limits, as [`check`] finds, but without a branch for each value.
#[inline(always)]
fn within<T: Real + Into<f64>, const N: usize>([least, greatest]: &[[f64; N]; 2], values: &[T; N]) -> bool {
    // Two loops of one comparison each, which the compiler vectorises.
    let (mut enough, mut too_much) = (true, false);
    let mut k = 0;
    while k < N {
        enough &= least[k] <= values[k].into();
        k += 1;
    }
    k = 0;
    while k < N {
        too_much |= greatest[k] < values[k].into();
        k += 1;
    }
    enough & !too_much
}

/// The error of another number of properties than the table's.
pub fn wrong_number(found: i64, table: &[Property]) -> Error {
    Error::Count { code: PROPERTY_COUNT, what: "number of properties", found, wanted: table.len() as i64 }
}

/// Checks number, finiteness and bounds of `values` against a table; the laws check their directions themselves.
///
/// # Errors
/// The first property that is wrong, its value and the allowed values.
pub fn check<T: Real + Into<f64>>(table: &'static [Property], values: &[T]) -> Result<(), Error> {
    if values.len() != table.len() {
        return Err(wrong_number(values.len() as i64, table));
    }
    for (index, (property, &value)) in table.iter().zip(values).enumerate() {
        let (given, value): (_, f64) = (Value::of(value), value.into());
        if !value.is_finite() {
            return Err(Error::Property { code: PROPERTY_NOT_FINITE, index, property, value: given });
        }
        if value < property.minimum
            || value > property.maximum
            || (property.minimum_excluded && value == property.minimum)
        {
            return Err(Error::Property { code: PROPERTY_OUT_OF_BOUNDS, index, property, value: given });
        }
    }
    Ok(())
}
