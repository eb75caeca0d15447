//! Exact numbers.

use std::str::FromStr;

use dashu_float::round::mode::HalfEven;
use dashu_float::{DBig, FBig};

/// A number of [`DIGITS`] binary digits, correctly rounded by every operation and elementary function.
pub type Exact = FBig<HalfEven, 2>;
pub const DIGITS: usize = 320;

/// The value of a double, exactly.
pub fn exact(x: f64) -> Exact {
    Exact::try_from(x).expect("a finite number").with_precision(DIGITS).value()
}

/// The value of a decimal string.
pub fn decimal(text: &str) -> Exact {
    let decimal = DBig::from_str(text).expect("a decimal number");
    decimal.with_base_and_precision::<2>(DIGITS).value().with_rounding()
}

/// The nearest double.
pub fn rounded(x: &Exact) -> f64 {
    x.to_f64().value()
}
