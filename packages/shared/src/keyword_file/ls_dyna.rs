//! Keyword decks of LS-DYNA.
//!
//! A card has its fields between commas, or in columns: of the widths that its keyword has, of 20 each with `*KEYWORD
//! LONG=Y` or a `+` behind the keyword. A line that begins with `$` is a comment; a blank one is a card of zeros.
//! `*END` ends its file.

use std::sync::Arc;

use super::files::Files;
use super::line::{Line, Place, lines};
use crate::error::Error;

/// What takes the tokens.
pub trait Reader {
    /// A keyword; says whether its cards are wanted.
    ///
    /// # Errors
    /// What is wrong with it.
    fn keyword(&mut self, keyword: &Keyword<'_>) -> Result<bool, Error>;

    /// A card of the last keyword.
    ///
    /// # Errors
    /// What is wrong with it.
    fn card(&mut self, card: &Card<'_>) -> Result<(), Error>;

    /// A file is included, with what becomes of its numbers and lengths.
    ///
    /// # Errors
    /// What is wrong with it.
    fn begin_file(&mut self, transform: &Transform) -> Result<(), Error>;

    /// The file that was begun last has ended.
    fn end_file(&mut self);
}

#[derive(Clone, Debug)]
pub struct Keyword<'a> {
    pub line: Line<'a>,
    /// In capitals, with its star.
    pub name: String,
    /// What stands behind it on its line.
    pub rest: String,
    pub long: bool,
}

impl<'a> Keyword<'a> {
    /// `long` is the format of the file.
    ///
    /// # Errors
    /// It asks for a format that nothing here reads.
    fn new(line: Line<'a>, long: bool) -> Result<Keyword<'a>, Error> {
        let text = line.text.trim().to_uppercase();
        let (name, rest) = text.split_once(char::is_whitespace).unwrap_or((&text, ""));
        let rest = rest.trim();
        // The mark of a format stands behind the keyword, or is its last letter.
        let end = name.len() - name.ends_with(['+', '-', '%']) as usize;
        let mark = if end < name.len() { &name[end..] } else { rest };
        let long = match mark {
            "+" => true,
            "-" => false,
            "%" => {
                let message = format!("{name} %, numbers in ten columns; allowed: the standard or the long format");
                return Err(line.error(&message));
            }
            _ => long,
        };
        Ok(Keyword { line, name: name[..end].to_string(), rest: rest.to_string(), long })
    }
}

/// A card of a keyword.
#[derive(Clone, Copy, Debug)]
pub struct Card<'a> {
    pub line: Line<'a>,
    pub long: bool,
}

/// Columns of every field in the long format.
const LONG: usize = 20;

impl<'a> Card<'a> {
    /// The fields, in columns of these widths in the standard format; empty ones where the card ends.
    ///
    /// # Errors
    /// Columns cannot be told.
    pub fn fields<const N: usize>(&self, widths: [usize; N]) -> Result<[&'a str; N], Error> {
        let text = self.line.text;
        let mut found = [""; N];
        if text.contains(',') {
            found.iter_mut().zip(text.split(',')).for_each(|(field, part)| *field = part.trim());
            return Ok(found);
        }
        if text.contains('\t') || !text.is_ascii() {
            return Err(self.line.error("a tab, or a letter beyond ASCII, in columns; allowed: blanks, or commas"));
        }
        let mut start = 0;
        for (field, width) in found.iter_mut().zip(widths) {
            let end = start + if self.long { LONG } else { width };
            *field = text.get(start..end.min(text.len())).unwrap_or_default().trim();
            start = end;
        }
        Ok(found)
    }

    pub fn is_blank(&self) -> bool {
        self.line.text.trim().is_empty()
    }
}

/// What `*INCLUDE_TRANSFORM` says of the file that it includes.
#[derive(Clone, Debug)]
pub struct Transform {
    pub place: Place,
    /// What is added to the numbers of nodes, elements, parts, materials, sets, functions, other definitions, and all
    /// else.
    pub offsets: [i64; 8],
    /// What masses, times and lengths are multiplied by.
    pub factors: [f64; 3],
    /// The number of a `*DEFINE_TRANSFORMATION`; 0 for none.
    pub transformation: i64,
}

/// Reads a file and those that it includes.
///
/// # Errors
/// A file that cannot be read, a format that is not known, and what the reader refuses.
pub fn read(file: &str, text: &str, reader: &mut impl Reader) -> Result<(), Error> {
    let mut deck = Deck { files: Files::new(file), reader };
    deck.read(&file.into(), text, false)
}

/// What the next card is.
enum Next {
    /// Before the first keyword of a file.
    Nothing,
    /// A keyword's cards: whether the reader takes them, or they are skipped.
    Data(bool),
    /// A name of a file: what stands before a sign that it goes on, and whether cards of a transformation follow.
    File {
        before: String,
        transformed: bool,
    },
    /// A card of a transformation, from 2 on.
    Transform {
        name: String,
        transform: Transform,
        card: usize,
    },
    Folder,
}

const FILE: fn(bool) -> Next = |transformed| Next::File { before: String::new(), transformed };

struct Deck<'a, R> {
    files: Files,
    reader: &'a mut R,
}

impl<R: Reader> Deck<'_, R> {
    fn read(&mut self, file: &Arc<str>, text: &str, mut long: bool) -> Result<(), Error> {
        let (mut next, mut of_keyword) = (Next::Nothing, long);
        for line in lines(file, text).filter(|line| !line.text.starts_with('$')) {
            if line.text.starts_with("-----BEGIN") {
                return Err(line.error("an encrypted part; allowed: plain text"));
            }
            if !line.text.starts_with('*') {
                next = self.card(&Card { line, long: of_keyword }, next, long)?;
                continue;
            }
            self.end(next, long)?;
            let keyword = Keyword::new(line, long)?;
            of_keyword = keyword.long;
            next = match keyword.name.as_str() {
                "*KEYWORD" => {
                    long = format(&keyword)?;
                    Next::Data(false)
                }
                "*END" => return Ok(()),
                "*INCLUDE" => FILE(false),
                "*INCLUDE_TRANSFORM" => FILE(true),
                "*INCLUDE_PATH" | "*INCLUDE_PATH_RELATIVE" => Next::Folder,
                _ => Next::Data(self.reader.keyword(&keyword)?),
            };
        }
        self.end(next, long)
    }

    fn card(&mut self, card: &Card<'_>, next: Next, long: bool) -> Result<Next, Error> {
        Ok(match next {
            Next::Nothing if card.is_blank() => Next::Nothing,
            Next::Nothing => {
                return Err(card.line.error("a line before the first keyword; allowed: comments, from $ on"));
            }
            Next::Data(wanted) => {
                if wanted {
                    self.reader.card(card)?;
                }
                Next::Data(wanted)
            }
            Next::Folder => {
                self.files.look_in(card.line.text.trim());
                Next::Folder
            }
            Next::File { before, transformed } if card.is_blank() => Next::File { before, transformed },
            Next::File { before, transformed } => {
                let text = card.line.text.trim();
                match text.strip_suffix('+').filter(|text| text.ends_with(' ')) {
                    Some(text) => Next::File { before: before + text.trim(), transformed },
                    None => {
                        let name = before + text;
                        let place = card.line.place();
                        let transform = Transform { place, offsets: [0; 8], factors: [1.0; 3], transformation: 0 };
                        if transformed {
                            Next::Transform { name, transform, card: 2 }
                        } else {
                            self.include(&name, &transform, long)?;
                            FILE(false)
                        }
                    }
                }
            }
            Next::Transform { name, mut transform, card: number } => {
                transform.read(card, number)?;
                let next = Next::Transform { name, transform, card: number + 1 };
                if number < 5 {
                    next
                } else {
                    self.end(next, long)?;
                    FILE(true)
                }
            }
        })
    }

    /// A keyword's cards are over: those of a transformation that are not there are zeros.
    fn end(&mut self, next: Next, long: bool) -> Result<(), Error> {
        match next {
            Next::Transform { name, transform, .. } => self.include(&name, &transform, long),
            _ => Ok(()),
        }
    }

    fn include(&mut self, name: &str, transform: &Transform, long: bool) -> Result<(), Error> {
        let line = Line { file: &transform.place.file, number: transform.place.line, text: "" };
        let (file, text) = self.files.open(&line, name)?;
        self.reader.begin_file(transform)?;
        self.read(&file, &text, long)?;
        self.reader.end_file();
        self.files.close();
        Ok(())
    }
}

impl Transform {
    fn read(&mut self, card: &Card<'_>, number: usize) -> Result<(), Error> {
        let fields: [&str; 7] = card.fields([10; 7])?;
        let whole =
            |what: &str, field: &str| if field.is_empty() { Ok(0) } else { card.line.number::<i64>(what, field) };
        match number {
            2 => {
                for (offset, field) in self.offsets.iter_mut().zip(fields) {
                    *offset = whole("an offset", field)?;
                }
            }
            3 => self.offsets[7] = whole("an offset", fields[0])?,
            4 => {
                for (factor, field) in self.factors.iter_mut().zip(fields) {
                    let value = card.line.real("a factor", field)?;
                    *factor = if value == 0.0 { 1.0 } else { value };
                }
            }
            _ => self.transformation = whole("a transformation's number", fields[0])?,
        }
        Ok(())
    }
}

/// Whether the cards of a file are in the long format: that of the file which includes it, where its `*KEYWORD` says
/// nothing.
fn format(keyword: &Keyword<'_>) -> Result<bool, Error> {
    let mut long = keyword.long;
    let options: Vec<&str> = keyword.rest.split('=').map(str::trim).collect();
    for option in options.join("=").split([' ', ',']) {
        long = match option.split_once('=') {
            // K and S are of what the solver writes.
            Some(("LONG", "Y" | "K")) => true,
            Some(("LONG", "N" | "S")) => false,
            Some((name @ ("LONG" | "I10"), value)) if (name, value) != ("I10", "N") => {
                return Err(keyword.line.error(&format!("{name}={value}; allowed: LONG=Y, LONG=N or neither")));
            }
            _ => long,
        };
    }
    Ok(long)
}
