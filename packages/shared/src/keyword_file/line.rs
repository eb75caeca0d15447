//! Lines of a text file and their places.

use std::str::FromStr;
use std::sync::Arc;

use crate::error::Error;

/// Where something stands in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    pub file: Arc<str>,
    /// From 1.
    pub line: usize,
}

impl Place {
    pub fn error(&self, message: &str) -> Error {
        Error::Input(format!("{}:{}: {message}", self.file, self.line))
    }
}

/// A line of a text file.
#[derive(Clone, Copy, Debug)]
pub struct Line<'a> {
    pub file: &'a Arc<str>,
    /// From 1.
    pub number: usize,
    pub text: &'a str,
}

impl Line<'_> {
    pub fn place(&self) -> Place {
        Place { file: self.file.clone(), line: self.number }
    }

    pub fn error(&self, message: &str) -> Error {
        self.place().error(message)
    }

    /// A field as a number.
    ///
    /// # Errors
    /// It is none.
    pub fn number<T: FromStr>(&self, what: &str, field: &str) -> Result<T, Error> {
        field.trim().parse().map_err(|_| self.error(&format!("{what} is \"{}\"; allowed: a number", field.trim())))
    }

    /// A field as a coordinate or a component, 0 where it is blank.
    ///
    /// # Errors
    /// It is no finite number.
    pub fn real(&self, what: &str, field: &str) -> Result<f64, Error> {
        let text = field.trim();
        let wanted = || self.error(&format!("{what} is \"{text}\"; allowed: a finite number"));
        if text.is_empty() { Ok(0.0) } else { real(text).filter(|value| value.is_finite()).ok_or_else(wanted) }
    }
}

/// A number as Fortran reads it: with an exponent behind `e` or `d`, or behind its sign alone.
fn real(text: &str) -> Option<f64> {
    let text = text.replace(['d', 'D'], "e");
    let sign = text.rfind(['+', '-']).filter(|&sign| text[..sign].ends_with(|c: char| c.is_ascii_digit() || c == '.'));
    match sign {
        Some(sign) => format!("{}e{}", &text[..sign], &text[sign..]).parse().ok(),
        None => text.parse().ok(),
    }
}

/// The lines of a text, numbered.
pub fn lines<'a>(file: &'a Arc<str>, text: &'a str) -> impl Iterator<Item = Line<'a>> {
    text.lines().enumerate().map(move |(i, text)| Line { file, number: i + 1, text })
}
