//! The errors of a call, with the values that their messages contain. Nothing is allocated.

use core::fmt;

use super::parameters::Property;
use super::status::{BAD_ARGUMENT, BAD_SIZE, NOT_PREPARED, NULL_ARGUMENT, UNKNOWN_FIELD, meaning};

/// A number of a message in the precision in which the caller has it, since in the other one it would have other
/// digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// In single precision.
    Single(f32),
    /// In double precision.
    Double(f64),
}

impl Value {
    /// A caller's number.
    pub fn of<T: Into<f64>>(value: T) -> Self {
        Value::Double(value.into()).for_caller_of::<T>()
    }

    /// The same number, which a caller of this type has passed, where it has been converted to double precision since.
    fn for_caller_of<T>(self) -> Self {
        match self {
            Value::Double(value) if size_of::<T>() == size_of::<f32>() => Value::Single(value as f32),
            value => value,
        }
    }

    /// Passes the shortest decimal number to `sink` that is read back as this one.
    pub(crate) fn describe(self, sink: &mut dyn FnMut(&str)) {
        let value: f64 = match self {
            Value::Single(value) => value.into(),
            Value::Double(value) => value,
        };
        let mut digits = ryu::Buffer::new();
        sink(match self {
            _ if value.is_nan() => "NaN",
            _ if value == f64::INFINITY => "infinity",
            _ if value == f64::NEG_INFINITY => "-infinity",
            Value::Single(value) => digits.format_finite(value),
            Value::Double(value) => digits.format_finite(value),
        });
    }
}

/// An error, with the values that its message contains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Error {
    /// A count is wrong: of properties, of state variables or of entries of an array, or a leading dimension.
    Count { code: i32, what: &'static str, found: i64, wanted: i64 },
    /// A property is not finite or out of bounds. `index` counts from 0.
    Property { code: i32, index: usize, property: &'static Property, value: Value },
    /// A direction among the properties is zero, parallel to another one or out of a plane; `index`, from 0, is that of
    /// its first component.
    Direction { code: i32, index: usize, name: &'static str, value: [Value; 3], wanted: &'static str },
    /// A whole number among the arguments is outside its range.
    Range { code: i32, name: &'static str, value: i64, least: i64, greatest: i64 },
    /// A whole number among the arguments is none of those that have a meaning.
    Choice { name: &'static str, value: i64, wanted: &'static str },
    /// A scalar argument does not have an allowed value.
    Argument { name: &'static str, value: Value, wanted: &'static str },
    /// An argument or an array that must not be null is null.
    Null { name: &'static str },
    /// A prepared law that this function has not written.
    NotPrepared { by: &'static str },
    /// A structure whose size is not set, or wrong.
    Size { structure: &'static str, size: usize, known: usize },
    /// What is wrong at a point of a block, counted from 0.
    Point { code: i32, index: usize },
    /// The same, for a reason of the law's own.
    PointOfLaw { code: i32, index: usize, text: &'static str },
    /// What is wrong at an element, by its number in the host's model.
    Element { code: i32, number: i64 },
    /// A setting of the host's model is wrong; the text says what is to be set.
    Setting { code: i32, text: &'static str },
    /// The same, as an element shows it: by its number in the host's model.
    ElementSetting { code: i32, number: i64, text: &'static str },
    /// A structure that is longer than this version of the library knows, and not 0 there.
    UnknownField { structure: &'static str, offset: usize, known: usize },
    /// An error that its status code describes completely.
    Plain(i32),
}

impl Error {
    /// The status code, one of [`status`](super::status).
    pub fn code(&self) -> i32 {
        match *self {
            Error::Count { code, .. }
            | Error::Property { code, .. }
            | Error::Point { code, .. }
            | Error::PointOfLaw { code, .. }
            | Error::Element { code, .. }
            | Error::Setting { code, .. }
            | Error::ElementSetting { code, .. }
            | Error::Range { code, .. }
            | Error::Direction { code, .. }
            | Error::Plain(code) => code,
            Error::Size { .. } => BAD_SIZE,
            Error::Argument { .. } | Error::Choice { .. } => BAD_ARGUMENT,
            Error::Null { .. } => NULL_ARGUMENT,
            Error::NotPrepared { .. } => NOT_PREPARED,
            Error::UnknownField { .. } => UNKNOWN_FIELD,
        }
    }

    /// The same error for a caller whose numbers are of type T, where it comes from a check in double precision.
    pub(crate) fn for_caller_of<T>(self) -> Self {
        let converted = |value: Value| value.for_caller_of::<T>();
        match self {
            Error::Property { code, index, property, value } => {
                Error::Property { code, index, property, value: converted(value) }
            }
            Error::Direction { code, index, name, value, wanted } => {
                Error::Direction { code, index, name, value: value.map(converted), wanted }
            }
            Error::Argument { name, value, wanted } => Error::Argument { name, value: converted(value), wanted },
            other => other,
        }
    }

    /// Passes the message to `sink`, piece by piece. `core::fmt` is not used, since its code can panic.
    pub fn describe(&self, sink: &mut dyn FnMut(&str)) {
        match *self {
            Error::Count { what, found, wanted, .. } => {
                sink(what);
                sink(": ");
                describe_integer(found, sink);
                sink(" given, ");
                describe_integer(wanted, sink);
                sink(" needed");
            }
            Error::Property { index, property, value, .. } => {
                sink("property ");
                describe_integer(index as i64 + 1, sink);
                sink(" (");
                sink(property.name);
                sink(", ");
                sink(property.meaning);
                sink(") is ");
                value.describe(sink);
                sink("; allowed: ");
                sink(property.allowed);
            }
            Error::Direction { index, name, value, wanted, .. } => {
                sink("properties ");
                describe_integer(index as i64 + 1, sink);
                sink(" to ");
                describe_integer(index as i64 + 3, sink);
                sink(" (");
                sink(name);
                sink(") are ");
                value[0].describe(sink);
                sink(", ");
                value[1].describe(sink);
                sink(", ");
                value[2].describe(sink);
                sink("; allowed: ");
                sink(wanted);
            }
            Error::Argument { name, value, wanted } => {
                sink("argument ");
                sink(name);
                sink(" is ");
                value.describe(sink);
                sink("; allowed: ");
                sink(wanted);
            }
            Error::Choice { name, value, wanted } => {
                sink("argument ");
                sink(name);
                sink(" is ");
                describe_integer(value, sink);
                sink("; allowed: ");
                sink(wanted);
            }
            Error::Range { name, value, least, greatest, .. } => {
                sink("argument ");
                sink(name);
                sink(" is ");
                describe_integer(value, sink);
                sink("; allowed: ");
                describe_integer(least, sink);
                if greatest == i64::MAX {
                    sink(" or more");
                } else if greatest > least {
                    sink(" to ");
                    describe_integer(greatest, sink);
                }
            }
            Error::Null { name } => {
                sink("argument ");
                sink(name);
                sink(" is null");
            }
            Error::NotPrepared { by } => {
                sink("the law has not been prepared by ");
                sink(by);
            }
            Error::Size { structure, size, known } => {
                sink("the size of ");
                sink(structure);
                sink(" is given as ");
                describe_integer(i64::try_from(size).unwrap_or(i64::MAX), sink);
                sink("; it is ");
                describe_integer(known as i64, sink);
                sink(" in this version of the library");
            }
            Error::Point { code, index } => {
                describe_point(index, sink);
                Error::Plain(code).describe(sink);
            }
            Error::PointOfLaw { index, text, .. } => {
                describe_point(index, sink);
                sink(text);
            }
            Error::Element { code, number } => {
                sink("element ");
                describe_integer(number, sink);
                sink(": ");
                Error::Plain(code).describe(sink);
            }
            Error::Setting { text, .. } => sink(text),
            Error::ElementSetting { number, text, .. } => {
                sink("element ");
                describe_integer(number, sink);
                sink(": ");
                sink(text);
            }
            Error::UnknownField { structure, offset, known } => {
                sink("byte ");
                describe_integer(offset as i64, sink);
                sink(" of ");
                sink(structure);
                sink(" is not 0; this version of the library knows ");
                describe_integer(known as i64, sink);
                sink(" bytes of it");
            }
            Error::Plain(code) => match meaning(code) {
                Some(text) => sink(text),
                None => {
                    sink("no such status code: ");
                    describe_integer(i64::from(code), sink);
                }
            },
        }
    }
}

fn describe_point(index: usize, sink: &mut dyn FnMut(&str)) {
    sink("point ");
    describe_integer(index as i64, sink);
    sink(", counted from 0: ");
}

/// Passes the digits to `sink` one by one. The crate `itoa` is not used: its bounds checks would leave a panic in the
/// program.
pub(crate) fn describe_integer(value: i64, sink: &mut dyn FnMut(&str)) {
    const DIGITS: [&str; 10] = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
    if value < 0 {
        sink("-");
    }
    let magnitude = value.unsigned_abs();
    let mut place = 10_u64.pow(19);
    while place > 0 {
        if place == 1 || place <= magnitude {
            sink(DIGITS[(magnitude / place % 10) as usize]);
        }
        place /= 10;
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut result = Ok(());
        self.describe(&mut |piece| {
            if result.is_ok() {
                result = f.write_str(piece);
            }
        });
        result
    }
}

impl core::error::Error for Error {}
