//! What a deck says of itself in a comment, for who compares its histories with others: its units, and what part of the
//! whole it is.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use toron::host::units::UnitSystem;

use toron_shared::error::Error;

/// What the comment begins with.
const MARK: &str = "toron compare: units ";
const PART: &str = ", part of the whole: ";
/// Lines of a deck in which it is looked for.
const HEADER: usize = 60;

/// Units of a deck's histories, and what part of the scene it has: 0.25 is a quarter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    pub units: UnitSystem,
    pub part: f64,
}

impl Origin {
    /// The comment, without the sign that begins one.
    pub fn comment(&self) -> String {
        format!("{MARK}{}{PART}{}", self.units.names().join("-"), self.part)
    }

    /// What a deck says; nothing where it does not or where there is none.
    ///
    /// # Errors
    /// It says what cannot be.
    pub fn of_deck(deck: &Path) -> Result<Option<Origin>, Error> {
        let Ok(file) = File::open(deck) else { return Ok(None) };
        let lines = BufReader::new(file).split(b'\n').map_while(Result::ok).take(HEADER);
        let said = (1..).zip(lines).find_map(|(number, line)| {
            let line = String::from_utf8_lossy(&line);
            line.split_once(MARK).map(|(_, said)| (number, said.trim_end().to_string()))
        });
        let Some((line, said)) = said else { return Ok(None) };
        let read = said.split_once(PART).and_then(|(units, part)| {
            let part = part.parse().ok().filter(|part| *part > 0.0 && *part <= 1.0)?;
            Some(Origin { units: UnitSystem::parse(units)?, part })
        });
        let allowed = format!("allowed: {MARK}mm-tonne-s{PART}0.25");
        let error = format!("{}:{line}: the deck says \"{MARK}{said}\"; {allowed}", deck.display());
        read.ok_or(Error::Input(error)).map(Some)
    }
}
