//! Inputs of Abaqus, which CalculiX reads too.
//!
//! Capitals make no difference, nor do blanks in a keyword and around its parameters. A keyword line that ends with a
//! comma goes on in the next one; a name in quotes may have commas; lines that begin with two stars are comments.

use std::sync::Arc;

use super::files::Files;
use super::line::{Line, lines};
use crate::error::Error;

/// What takes the tokens.
pub trait Reader {
    /// A keyword; says whether the lines behind it are wanted, and the file that its INPUT names.
    ///
    /// # Errors
    /// What is wrong with it.
    fn keyword(&mut self, keyword: &Keyword<'_>) -> Result<bool, Error>;

    /// A line behind the last keyword, which may be blank.
    ///
    /// # Errors
    /// What is wrong with it.
    fn data(&mut self, line: &Line<'_>) -> Result<(), Error>;
}

/// A keyword line, or several that are one.
#[derive(Clone, Debug)]
pub struct Keyword<'a> {
    /// The first one.
    pub line: Line<'a>,
    /// In capitals, without blanks or stars.
    pub name: String,
    pub parameters: Vec<Parameter>,
}

#[derive(Clone, Debug)]
pub struct Parameter {
    /// In capitals, without blanks.
    pub name: String,
    /// As it stands in the file, without quotes; empty where there is none.
    pub value: String,
}

impl<'a> Keyword<'a> {
    fn new(line: Line<'a>, text: &str) -> Keyword<'a> {
        let mut parts = fields(text.trim_start_matches('*'));
        let parameter = |part: &str| {
            let (name, value) = part.split_once('=').unwrap_or((part, ""));
            Parameter { name: capitals(name), value: unquoted(value).to_string() }
        };
        let name = capitals(parts.next().unwrap_or_default());
        Keyword { line, name, parameters: parts.filter(|part| !part.is_empty()).map(parameter).collect() }
    }

    /// The keyword for messages, with its star and the blanks between its words.
    pub fn title(&self) -> String {
        let words: Vec<&str> = fields(self.line.text).next().unwrap_or_default().split_whitespace().collect();
        words.join(" ").to_uppercase()
    }

    pub fn value(&self, name: &str) -> Option<&str> {
        self.parameters.iter().find(|parameter| parameter.name == name).map(|parameter| parameter.value.as_str())
    }

    /// The value of a parameter that is a name.
    pub fn label(&self, name: &str) -> Option<String> {
        self.value(name).map(label)
    }

    /// A name that must be there.
    ///
    /// # Errors
    /// It is not.
    pub fn needed(&self, name: &str) -> Result<String, Error> {
        let wanted = || self.line.error(&format!("{} without {name}; allowed: {name}=NAME", self.title()));
        self.label(name).filter(|name| !name.is_empty()).ok_or_else(wanted)
    }

    /// That the keyword has no parameters but these.
    ///
    /// # Errors
    /// Which other one it has.
    pub fn allow(&self, names: &[&str]) -> Result<(), Error> {
        match self.parameters.iter().find(|parameter| !names.contains(&parameter.name.as_str())) {
            Some(Parameter { name, .. }) => {
                let names = names.join(", ");
                Err(self.line.error(&format!("{} has the parameter {name}; allowed: {names}", self.title())))
            }
            None => Ok(()),
        }
    }
}

fn capitals(text: &str) -> String {
    text.split_whitespace().collect::<String>().to_uppercase()
}

fn unquoted(text: &str) -> &str {
    let text = text.trim();
    text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text)
}

/// A name as names are compared.
pub fn label(text: &str) -> String {
    unquoted(text).to_uppercase()
}

/// What stands between the commas of a line that are in no quotes, without blanks around it.
pub fn fields(text: &str) -> impl Iterator<Item = &str> {
    let mut quoted = false;
    text.split(move |c| {
        quoted ^= c == '"';
        c == ',' && !quoted
    })
    .map(str::trim)
}

/// Reads a file and those that it includes.
///
/// # Errors
/// A file that cannot be read, and what the reader refuses.
pub fn read(file: &str, text: &str, reader: &mut impl Reader) -> Result<(), Error> {
    let mut deck = Deck { files: Files::new(file), reader, wanted: None };
    deck.read(&file.into(), text)
}

struct Deck<'a, R> {
    files: Files,
    reader: &'a mut R,
    /// Whether the lines behind the last keyword are; none before the first one.
    wanted: Option<bool>,
}

impl<R: Reader> Deck<'_, R> {
    fn read(&mut self, file: &Arc<str>, text: &str) -> Result<(), Error> {
        let mut lines = lines(file, text).filter(|line| !line.text.trim_start().starts_with("**"));
        while let Some(line) = lines.next() {
            let text = line.text.trim();
            if text.starts_with('*') {
                let mut whole = text.to_string();
                while whole.ends_with(',') {
                    let more = lines.next().filter(|line| !line.text.trim_start().starts_with('*'));
                    let more = more.ok_or_else(|| {
                        line.error("a keyword line ends with a comma, and none goes on with it; allowed: a parameter")
                    })?;
                    whole += more.text.trim();
                }
                self.keyword(&Keyword::new(line, &whole))?;
            } else {
                match self.wanted {
                    Some(true) => self.reader.data(&line)?,
                    None if !text.is_empty() => {
                        return Err(line.error("a line before the first keyword; allowed: comments, from ** on"));
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// Lines that a file begins with belong to the last keyword before it, as if they stood in its place.
    fn keyword(&mut self, keyword: &Keyword<'_>) -> Result<(), Error> {
        let included = if keyword.name == "INCLUDE" {
            if keyword.value("FILE").is_some() {
                let message = "*INCLUDE has FILE=; allowed: INPUT=, as Abaqus's manual has it";
                return Err(keyword.line.error(message));
            }
            keyword.allow(&["INPUT"])?;
            Some(keyword.value("INPUT").unwrap_or_default())
        } else {
            let wanted = self.reader.keyword(keyword)?;
            self.wanted = Some(wanted);
            keyword.value("INPUT").filter(|_| wanted)
        };
        if let Some(name) = included {
            let (file, text) = self.files.open(&keyword.line, name)?;
            self.read(&file, &text)?;
            self.files.close();
        }
        Ok(())
    }
}
