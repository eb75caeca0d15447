//! A TOML file that is read: its text, and errors that name file, line and what is allowed there.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::spanned::Spanned;
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer};
use toml::de::{DeTable, DeValue};

use super::checked::{Checked, value};
use super::error::Error;
use super::field_names::field_names;
use super::file_names::collide;
use super::toml_error;
use super::toml_value::{Value, Wrong};

/// The text and its name, for messages.
pub struct Source<'a> {
    pub name: &'a str,
    pub text: &'a str,
}

/// A table's key that no case reads: its place, and the message.
pub type Unused = Option<(Range<usize>, String)>;

impl<'t> Source<'t> {
    /// The file's tables as data, in which every value keeps its place.
    pub fn tables(&self) -> Result<toml::Spanned<DeValue<'t>>, Error> {
        let tables = DeTable::parse(self.text).map_err(|error| {
            self.parse_error(&Wrong { place: error.span(), message: error.message().trim_end().to_string() })
        })?;
        Ok(toml::Spanned::new(tables.span(), DeValue::Table(tables.into_inner())))
    }
}

impl Source<'_> {
    /// # Errors
    /// There is a key that no case reads.
    pub fn refuse_unused(&self, unused: Unused) -> Result<(), Error> {
        unused.map_or(Ok(()), |(span, message)| Err(self.error(span, &message)))
    }

    /// The file's tables.
    pub fn parse<F: DeserializeOwned>(&self) -> Result<F, Error> {
        self.read(&self.tables()?)
    }

    /// A table of the file's data.
    pub fn read<F: DeserializeOwned>(&self, table: &toml::Spanned<DeValue>) -> Result<F, Error> {
        F::deserialize(Value(table)).map_err(|wrong| self.parse_error(&wrong))
    }

    /// A table whose keys are those of two structs, neither of which refuses the other's.
    pub fn read_both<F: DeserializeOwned, G: DeserializeOwned>(
        &self,
        table: &toml::Spanned<DeValue>,
    ) -> Result<(F, G), Error> {
        let known = [field_names::<F>(), field_names::<G>()].concat();
        let keys = table.get_ref().as_table().into_iter().flat_map(DeTable::keys);
        match keys.into_iter().find(|key| !known.contains(&&**key.get_ref())) {
            None => Ok((self.read(table)?, self.read(table)?)),
            Some(key) => Err(self.error(key.span(), &toml_error::unknown_key(key.get_ref(), &known))),
        }
    }

    fn parse_error(&self, wrong: &Wrong) -> Error {
        self.error(wrong.place.clone().unwrap_or(0..0), &toml_error::message(self.text, wrong))
    }

    /// The name of a case, or of another of several `what`, out of which its files' names are made; `taken` are the
    /// names that are there already.
    ///
    /// # Errors
    /// There is none, files cannot be named by it, or they would be called as those of one that is taken.
    pub fn name_of<'n>(
        &self,
        what: &str,
        name: Option<&Spanned<String>>,
        place: Range<usize>,
        mut taken: impl Iterator<Item = &'n str>,
    ) -> Result<String, Error> {
        let wanted = "a name of its own out of letters, digits and - _ ., since files are named by it";
        let Some(name) = name else {
            return Err(self.error(place, &format!("a {what} has no name; allowed: {wanted}")));
        };
        let text = name.get_ref();
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        let pointed = text.starts_with('.') || text.ends_with('.');
        if text.is_empty() || pointed || is_device(text) || !text.chars().all(plain) {
            return Err(self.error(name.span(), &format!("{what} \"{text}\"; allowed: {wanted}")));
        }
        match taken.find(|taken| collide(taken, text)) {
            None => Ok(text.clone()),
            Some(other) => {
                let message = format!("{what} \"{text}\", with files that would be called as some of \"{other}\"");
                Err(self.error(name.span(), &format!("{message}; allowed: {wanted}")))
            }
        }
    }

    /// Where the value of a table's key stands; the file's beginning where it is not there.
    pub fn place(&self, table: &str, key: &str) -> Range<usize> {
        let tables = self.tables().ok();
        let value = tables.as_ref().and_then(|tables| tables.get_ref().get(table)?.get_ref().get(key));
        value.map_or(0..0, toml::Spanned::span)
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

    /// The file that a key names.
    ///
    /// # Errors
    /// It is not there, or called as the standard input, which is the command's.
    pub fn file(&self, key: &str, name: &Spanned<String>) -> Result<PathBuf, Error> {
        let path = self.folder().join(name.get_ref());
        let message = if is_standard_input(Path::new(name.get_ref())) {
            format!(
                "{key} is \"{STANDARD_INPUT}\"; allowed: a file's name: an argument alone may be the standard input"
            )
        } else if !path.is_file() {
            format!("{key} {}: there is no such file", path.display())
        } else {
            return Ok(path);
        };
        Err(self.error(name.span(), &message))
    }

    /// The value of a key that must be there; `table` is the place that the error names.
    ///
    /// # Errors
    /// It is missing.
    pub fn needed<T: Checked>(&self, key: &str, given: &Option<T>, table: Range<usize>) -> Result<T::Value, Error> {
        value(given).ok_or_else(|| self.error(table, &format!("{key} is missing; allowed: {}", T::allowed())))
    }

    /// Times at which pictures are drawn. The case is named: the times may be the scene's, the end its own.
    pub fn pictures(&self, times: &Option<Spanned<Vec<f64>>>, case: &str, end: f64) -> Result<Vec<f64>, Error> {
        let Some(times) = times else { return Ok(Vec::new()) };
        for &time in times.get_ref() {
            if !(time > 0.0 && time <= end) {
                let message = format!(
                    "a time of pictures is {time}; allowed: a number > 0, up to end = {end} of case \"{case}\""
                );
                return Err(self.error(times.span(), &message));
            }
        }
        Ok(times.get_ref().clone())
    }

    pub fn finite(&self, what: &str, value: f64, span: Range<usize>) -> Result<f64, Error> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.error(span, &format!("{what} is {value}; allowed: a finite number")))
    }
}

/// Whether Windows takes files of that name for a device.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().to_lowercase();
    let numbered = |begin| stem.strip_prefix(begin).is_some_and(|rest| matches!(rest.as_bytes(), [b'1'..=b'9']));
    ["con", "prn", "aux", "nul"].contains(&stem.as_str()) || numbered("com") || numbered("lpt")
}

/// Where a file is named by this, the standard input is read.
const STANDARD_INPUT: &str = "-";

pub fn is_standard_input(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// The name of a file for messages, and its text.
///
/// # Errors
/// It cannot be read.
pub fn read(path: &Path) -> Result<(String, String), Error> {
    if is_standard_input(path) {
        // Once, for who reads a file twice.
        static TEXT: OnceLock<Result<String, String>> = OnceLock::new();
        let text = TEXT.get_or_init(|| std::io::read_to_string(std::io::stdin()).map_err(|error| error.to_string()));
        let name = "standard input".to_string();
        return text.clone().map_err(|error| Error::Input(format!("{name}: {error}"))).map(|text| (name, text));
    }
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| Error::Input(format!("{name}: {error}")))?;
    Ok((name, text))
}

/// A list of so many numbers. The parser would pass over what comes after them.
#[derive(Clone, Copy)]
pub struct Numbers<const N: usize, T = f64>(pub [T; N]);

impl<'de, const N: usize, T: Deserialize<'de>> Deserialize<'de> for Numbers<N, T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list = Vec::<T>::deserialize(deserializer)?;
        let wanted = format!("an array of length {N}");
        let wrong = |list: Vec<T>| D::Error::invalid_length(list.len(), &wanted.as_str());
        list.try_into().map(Numbers).map_err(wrong)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_of_files_is_none_of_a_folder_or_a_device() {
        let name = |text: &str| {
            let source = Source { name: "x.toml", text: "" };
            source.name_of("case", Some(&Spanned::new(0..0, text.to_string())), 0..0, std::iter::empty())
        };
        for wrong in ["", ".", "..", ".hidden", "a.", "a/b", "nul", "COM1", "con.a", "ä"] {
            let error = name(wrong).expect_err("no name").to_string();
            assert!(error.starts_with(&format!("x.toml:1: case \"{wrong}\"; allowed: a name")), "{error}");
        }
        for right in ["a", "a.b", "-", "console", "com10", "80-m_s"] {
            assert_eq!(name(right).as_deref(), Ok(right));
        }
    }
}
