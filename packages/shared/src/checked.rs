//! Values that their types check: a key of such a type is refused where it is read, with its value and what is allowed.

use std::marker::PhantomData;
use std::ops::Bound::{Excluded, Included};
use std::ops::{self, RangeBounds};

use super::spanned::Spanned;
use serde::de::{Deserialize, Deserializer, Error, Unexpected};

/// A value that a type has checked.
pub trait Checked {
    type Value;

    /// What is allowed, in words.
    fn allowed() -> String;

    fn value(&self) -> Self::Value;
}

/// The value of a key, if it is given.
pub fn value<T: Checked>(given: &Option<T>) -> Option<T::Value> {
    given.as_ref().map(Checked::value)
}

impl<T: Checked> Checked for Spanned<T> {
    type Value = T::Value;

    fn allowed() -> String {
        T::allowed()
    }

    fn value(&self) -> T::Value {
        self.get_ref().value()
    }
}

/// From where to where numbers are allowed.
pub type Limits = (ops::Bound<f64>, ops::Bound<f64>);

/// Which numbers are allowed.
pub trait Bound {
    const ALLOWED: &'static str;
    /// An infinite end is excluded, since files may have `inf`.
    const LIMITS: Limits;

    fn allows(number: f64) -> bool {
        Self::LIMITS.contains(&number)
    }
}

/// A number within a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number<B>(f64, PhantomData<B>);

pub type Positive = Number<AboveZero>;
pub type NotNegative = Number<FromZero>;
pub type Fraction = Number<UpToOne>;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AboveZero {}

impl Bound for AboveZero {
    const ALLOWED: &'static str = "a finite number > 0";
    const LIMITS: Limits = (Excluded(0.0), Excluded(f64::INFINITY));
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FromZero {}

impl Bound for FromZero {
    const ALLOWED: &'static str = "a finite number >= 0";
    const LIMITS: Limits = (Included(0.0), Excluded(f64::INFINITY));
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UpToOne {}

impl Bound for UpToOne {
    const ALLOWED: &'static str = "a number > 0, up to 1";
    const LIMITS: Limits = (Excluded(0.0), Included(1.0));
}

impl<B: Bound> Checked for Number<B> {
    type Value = f64;

    fn allowed() -> String {
        B::ALLOWED.to_string()
    }

    fn value(&self) -> f64 {
        self.0
    }
}

impl<'de, B: Bound> Deserialize<'de> for Number<B> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let number = f64::deserialize(deserializer)?;
        if B::allows(number) {
            return Ok(Number(number, PhantomData));
        }
        Err(D::Error::invalid_value(Unexpected::Float(number), &B::ALLOWED))
    }
}

/// A whole number in this range, its ends included.
#[derive(Clone, Copy, Debug)]
pub struct Whole<const LEAST: usize, const MOST: usize>(usize);

impl<const LEAST: usize, const MOST: usize> Checked for Whole<LEAST, MOST> {
    type Value = usize;

    fn allowed() -> String {
        format!("a whole number from {LEAST} to {MOST}")
    }

    fn value(&self) -> usize {
        self.0
    }
}

impl<'de, const LEAST: usize, const MOST: usize> Deserialize<'de> for Whole<LEAST, MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let number = i64::deserialize(deserializer)?;
        match usize::try_from(number) {
            Ok(number) if (LEAST..=MOST).contains(&number) => Ok(Whole(number)),
            _ => Err(D::Error::invalid_value(Unexpected::Signed(number), &Self::allowed().as_str())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toml_file::{Numbers, Source};

    #[derive(serde::Deserialize)]
    #[serde(rename_all = "kebab-case")]
    struct Keys {
        half_length: Option<Spanned<Positive>>,
        friction: Option<NotNegative>,
        part: Option<Fraction>,
        half: Option<Numbers<2, Positive>>,
        rows: Option<Whole<2, 40>>,
        seed: Option<u64>,
    }

    fn read(text: &str) -> Result<Keys, String> {
        Source { name: "x.toml", text }.parse().map_err(|error| error.to_string())
    }

    #[test]
    fn what_is_allowed_is_read() {
        let keys = read("half-length = 3\nfriction = 0.0\npart = 1\nrows = 40\nseed = 0x8000000000000000")
            .expect("all are allowed");
        assert_eq!((value(&keys.half_length), value(&keys.friction)), (Some(3.0), Some(0.0)));
        assert_eq!((value(&keys.part), value(&keys.rows), keys.seed), (Some(1.0), Some(40), Some(1 << 63)));
        let none = read("").expect("no key");
        assert!(value(&none.rows).is_none() && none.half.is_none());
    }

    #[test]
    fn what_is_not_allowed_is_refused_by_key_value_and_line() {
        for (text, message) in [
            ("half-length = 0.0", "half-length is 0.0; allowed: a finite number > 0"),
            ("half-length = inf", "half-length is inf; allowed: a finite number > 0"),
            ("half-length = nan", "half-length is nan; allowed: a finite number > 0"),
            ("half-length = \"3\"", "half-length is \"3\"; allowed: a number"),
            ("friction = -0.1", "friction is -0.1; allowed: a finite number >= 0"),
            ("part = 1.5", "part is 1.5; allowed: a number > 0, up to 1"),
            ("half = [1, 0]", "half is [1, 0]; allowed: each a finite number > 0"),
            ("half = [1]", "half is [1]; allowed: a list of 2 numbers"),
            ("rows = 1", "rows is 1; allowed: a whole number from 2 to 40"),
            ("rows = 41", "rows is 41; allowed: a whole number from 2 to 40"),
            ("rows = 2.5", "rows is 2.5; allowed: a whole number"),
            ("seed = -1", "seed is -1; allowed: a whole number >= 0"),
            ("seed = 99999999999999999999", "seed is 99999999999999999999; allowed: a whole number >= 0"),
            ("friction = 1e400", "friction is 1e400; allowed: a number"),
        ] {
            let error = read(&format!("\n{text}\n")).map(|_| ()).expect_err(text);
            assert_eq!(error, format!("x.toml:2: {message}"));
        }
    }
}
