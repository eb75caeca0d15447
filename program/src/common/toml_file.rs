//! A TOML file that is read: its text, and errors that name file, line and what is allowed there.

use std::ops::Range;
use std::path::Path;

use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use super::error::Error;
use super::toml_error;
use toron::host::units::UnitSystem;

/// The text and its name, for messages.
pub struct Source<'a> {
    pub name: &'a str,
    pub text: &'a str,
}

impl Source<'_> {
    /// The file's tables.
    pub fn parse<F: DeserializeOwned>(&self) -> Result<F, Error> {
        let parse_error =
            |error: toml::de::Error| self.error(error.span().unwrap_or(0..0), &toml_error::message(self.text, &error));
        toml::from_str(self.text).map_err(parse_error)
    }

    pub fn units(&self, name: &Spanned<String>) -> Result<UnitSystem, Error> {
        UnitSystem::parse(name.get_ref()).ok_or_else(|| {
            let message = format!("unit system \"{}\"; allowed: {}", name.get_ref(), UnitSystem::ALLOWED);
            self.error(name.span(), &message)
        })
    }

    pub fn error(&self, span: Range<usize>, message: &str) -> Error {
        Error::Input(format!("{}:{}: {message}", self.name, self.line(span)))
    }

    /// The line of a place, from 1.
    pub fn line(&self, span: Range<usize>) -> usize {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        1 + before.iter().filter(|&&byte| byte == b'\n').count()
    }

    /// The folder of the file, which the names of other files in it are relative to.
    pub fn folder(&self) -> &Path {
        Path::new(self.name).parent().unwrap_or(Path::new(""))
    }

    /// The number, where it is finite and above 0.
    pub fn positive(&self, what: &str, value: f64, span: Range<usize>) -> Result<f64, Error> {
        if value.is_finite() && value > 0.0 {
            return Ok(value);
        }
        Err(self.error(span, &format!("{what} is {value}; allowed: a finite number > 0")))
    }

    pub fn finite(&self, what: &str, value: f64, span: Range<usize>) -> Result<f64, Error> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.error(span, &format!("{what} is {value}; allowed: a finite number")))
    }
}

/// A list of so many numbers. The parser would pass over what comes after them.
#[derive(Clone, Copy)]
pub struct Numbers<const N: usize>(pub [f64; N]);

impl<'de, const N: usize> Deserialize<'de> for Numbers<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list = Vec::<f64>::deserialize(deserializer)?;
        let wanted = format!("an array of length {N}");
        let numbers = list.as_slice().try_into().map_err(|_| D::Error::invalid_length(list.len(), &wanted.as_str()))?;
        Ok(Numbers(numbers))
    }
}
