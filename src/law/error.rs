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
        let number = |index: usize| Integer(index as i64);
        let allowed = Text("; allowed: ");
        let mut say = |pieces: &[Piece]| pieces.iter().for_each(|piece| piece.describe(sink));
        match *self {
            Error::Count { what, found, wanted, .. } => {
                say(&[Text(what), Text(": "), Integer(found), Text(" given, "), Integer(wanted), Text(" needed")]);
            }
            Error::Property { index, property, value, .. } => {
                say(&[Text("property "), number(index + 1), Text(" ("), Text(property.name), Text(", ")]);
                say(&[Text(property.meaning), Text(") is "), Number(value), allowed, Text(property.allowed)]);
            }
            Error::Direction { index, name, value: [x, y, z], wanted, .. } => {
                say(&[Text("properties "), number(index + 1), Text(" to "), number(index + 3), Text(" ("), Text(name)]);
                say(&[Text(") are "), Number(x), Text(", "), Number(y), Text(", "), Number(z), allowed, Text(wanted)]);
            }
            Error::Argument { name, value, wanted } => {
                say(&[Text("argument "), Text(name), Text(" is "), Number(value), allowed, Text(wanted)]);
            }
            Error::Choice { name, value, wanted } => {
                say(&[Text("argument "), Text(name), Text(" is "), Integer(value), allowed, Text(wanted)]);
            }
            Error::Range { name, value, least, greatest, .. } => {
                say(&[Text("argument "), Text(name), Text(" is "), Integer(value), allowed, Integer(least)]);
                if greatest == i64::MAX {
                    say(&[Text(" or more")]);
                } else if greatest > least {
                    say(&[Text(" to "), Integer(greatest)]);
                }
            }
            Error::Null { name } => say(&[Text("argument "), Text(name), Text(" is null")]),
            Error::NotPrepared { by } => say(&[Text("the law has not been prepared by "), Text(by)]),
            Error::Size { structure, size, known } => {
                let size = Integer(i64::try_from(size).unwrap_or(i64::MAX));
                say(&[Text("the size of "), Text(structure), Text(" is given as "), size, Text("; it is ")]);
                say(&[number(known), Text(" in this version of the library")]);
            }
            Error::Point { code, index } => {
                say(&[Text("point "), number(index), Text(", counted from 0: "), Code(code)]);
            }
            Error::PointOfLaw { index, text, .. } => {
                say(&[Text("point "), number(index), Text(", counted from 0: "), Text(text)]);
            }
            Error::Element { code, number } => {
                say(&[Text("element "), Integer(number), Text(": "), Code(code)]);
            }
            Error::Setting { text, .. } => say(&[Text(text)]),
            Error::ElementSetting { number, text, .. } => {
                say(&[Text("element "), Integer(number), Text(": "), Text(text)]);
            }
            Error::UnknownField { structure, offset, known } => {
                say(&[Text("byte "), number(offset), Text(" of "), Text(structure)]);
                say(&[Text(" is not 0; this version of the library knows "), number(known), Text(" bytes of it")]);
            }
            Error::Plain(code) => say(&[Code(code)]),
        }
    }
}

/// A piece of a message.
#[derive(Clone, Copy)]
enum Piece {
    Text(&'static str),
    Integer(i64),
    Number(Value),
    /// What a status code means.
    Code(i32),
}
use Piece::{Code, Integer, Number, Text};

impl Piece {
    fn describe(self, sink: &mut dyn FnMut(&str)) {
        match self {
            Text(text) => sink(text),
            Integer(value) => describe_integer(value, sink),
            Number(value) => value.describe(sink),
            Code(code) => match meaning(code) {
                Some(text) => sink(text),
                None => {
                    sink("no such status code: ");
                    describe_integer(i64::from(code), sink);
                }
            },
        }
    }
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
