//! Shots that somebody has measured, out of a table as machines and spreadsheets export it: which columns are the
//! speed and the outcome, and which shots are left out.

pub mod command;
mod compare;
pub mod next;
mod planned;
mod report;
pub mod words;

use std::collections::HashSet;
use std::path::Path;

use self::words::{Meaning, Words, plain};
use super::curve::Fate;
use toron_materials::data_table::sheet::{Row, Sheet};
use toron_materials::unit_expression::Unit;
use toron_materials::units::SPEED;
use toron_shared::error::Error;
use toron_shared::toml_error::shortened;

const SPEEDS: [&str; 16] = [
    "speed",
    "velocity",
    "v",
    "impact velocity",
    "impact speed",
    "striking velocity",
    "striking speed",
    "strike velocity",
    "measured velocity",
    "measured speed",
    "shot velocity",
    "projectile velocity",
    "vi",
    "vs",
    "geschwindigkeit",
    "vitesse",
];
const OUTCOMES: [&str; 20] = [
    "outcome",
    "result",
    "results",
    "ending",
    "response",
    "fate",
    "penetration",
    "perforation",
    "perforated",
    "penetrated",
    "through",
    "complete penetration",
    "p/c",
    "pp/cp",
    "cp/pp",
    "stop/pass",
    "pass/stop",
    "ergebnis",
    "resultat",
    "résultat",
];
const KEPT: [&str; 11] =
    ["kept", "keep", "valid", "fair", "fair hit", "fair impact", "used", "use", "include", "included", "gültig"];
const LEFT_OUT: [&str; 6] = ["excluded", "exclude", "left out", "rejected", "invalid", "unfair"];
const REASONS: [&str; 9] =
    ["reason", "remark", "remarks", "comment", "comments", "note", "notes", "bemerkung", "remarque"];
/// Of one V50 are shots of one kind of these.
const KINDS: [&str; 9] =
    ["ply", "plies", "layers", "number of plies", "obliquity", "angle", "areal density", "projectile", "threat"];
const YES: [&str; 13] = ["yes", "y", "1", "true", "x", "kept", "valid", "fair", "ok", "ja", "j", "oui", "gültig"];
const NO: [&str; 11] =
    ["no", "n", "0", "false", "unfair", "invalid", "excluded", "left out", "nein", "non", "ungültig"];
/// What keeps a shot in a column of those that are left out.
const NOT_LEFT_OUT: [&str; 13] =
    ["", "-", "no", "n", "0", "false", "kept", "valid", "fair", "ok", "nein", "non", "gültig"];
/// What a table of shots has at least.
const EXAMPLE: [&str; 2] = ["speed (m/s),outcome", "645.2,pass"];
/// So many kinds of shots are named, and no more.
const NAMED: usize = 6;
/// Speeds of a shot that are not the one it struck with.
const OTHER_SPEEDS: [&str; 8] = ["residual", "exit", "rest", "muzzle", "vr", "v r", "nominal", "asked"];
/// In m/s; what is slower as a point and three digits have it may be thousands.
const SLOW: f64 = 10.0;

/// What a user says of a table.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    pub speed: Option<String>,
    pub outcome: Option<String>,
    /// The word of perforations.
    pub through: Option<String>,
    /// Columns and what has to stand there.
    pub only: Vec<(String, String)>,
}

/// A table of shots.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The file, as messages have it.
    pub name: String,
    /// Of the speeds.
    pub unit: Unit,
    pub fates: Vec<Fate>,
    /// The lines of shots without a fate, and their speeds, where they have one.
    pub without_fate: Vec<(usize, Option<f64>)>,
    /// The lines of shots that are left out, and why.
    pub left_out: Vec<(usize, String)>,
    /// How the table was read, and what is to be thought of.
    pub notes: Vec<String>,
}

impl Measured {
    /// Reads the file.
    ///
    /// # Errors
    /// An input error that names file, line and column, what is there and what is allowed.
    pub fn read(path: &Path, choice: &Choice) -> Result<Measured, Error> {
        Measured::of(&read(path)?, choice)
    }

    fn of(sheet: &Sheet, choice: &Choice) -> Result<Measured, Error> {
        let [header, example] = EXAMPLE;
        if sheet.rows.is_empty() {
            let message = format!(
                "no line of data follows the header; allowed: lines as \"{example}\" below a header as \"{header}\""
            );
            return Err(sheet.error(sheet.header, 1, &message));
        }
        let shots = Shots::of(sheet, choice)?;
        let (mut fates, mut without_fate) = (Vec::new(), Vec::new());
        for row in &shots.kept {
            let has_speed = !row.cells[shots.speed].is_empty();
            match shots.words.meaning(&row.cells[shots.outcome]) {
                Meaning::None => {
                    without_fate.push((row.line, has_speed.then(|| shots.speed_of(sheet, row)).transpose()?));
                }
                of => fates.push(Fate { speed: shots.speed_of(sheet, row)?, through: of == Meaning::Perforation }),
            }
        }
        let mut notes = shots.notes(sheet);
        notes.extend(of_contrary(&fates));
        let Shots { unit, left_out, .. } = shots;
        Ok(Measured { name: sheet.name.clone(), unit, fates, without_fate, left_out, notes })
    }

    /// The same shots with their speeds in another unit.
    pub fn in_unit(mut self, unit: &Unit) -> Measured {
        let convert = |speed: &mut f64| *speed = self.unit.scale.convert(*speed, &unit.scale);
        self.fates.iter_mut().for_each(|fate| convert(&mut fate.speed));
        self.without_fate.iter_mut().filter_map(|(_, speed)| speed.as_mut()).for_each(convert);
        self.unit = unit.clone();
        self
    }
}

/// The sheet of a file.
///
/// # Errors
/// It cannot be read, or has no header.
fn read(path: &Path) -> Result<Sheet, Error> {
    Sheet::read_like(path, EXAMPLE[0])
}

/// What the rows of a table are, before their numbers are read.
struct Shots<'a> {
    speed: usize,
    unit: Unit,
    outcome: usize,
    words: Words,
    kept: Vec<&'a Row>,
    left_out: Vec<(usize, String)>,
}

impl Shots<'_> {
    fn of<'a>(sheet: &'a Sheet, choice: &Choice) -> Result<Shots<'a>, Error> {
        if let Some(&line) = sheet.comments.first() {
            let message = "the line begins with #: a comment, a number or a fault of the spreadsheet? allowed: comments before the heading";
            return Err(sheet.error(line, 1, message));
        }
        let only: Result<Vec<(usize, String)>, Error> =
            choice.only.iter().map(|(name, value)| Ok((named(sheet, "--only", name)?, plain(value)))).collect();
        let only = only?;
        let is_asked = |row: &&Row| only.iter().all(|(place, value)| plain(&row.cells[*place]) == *value);
        let rows: Vec<&Row> = sheet.rows.iter().filter(is_asked).collect();
        if rows.is_empty() && !sheet.rows.is_empty() {
            let asked: Vec<String> = choice.only.iter().map(|(name, value)| format!("{name}={value}")).collect();
            let message = format!("no line has {}; allowed: what stands in the table", asked.join(" and "));
            return Err(Error::Input(format!("{}: --only: {message}", sheet.name)));
        }
        let speed = speed_column(sheet, choice.speed.as_deref())?;
        let unit = unit_of(sheet, speed)?;
        let outcome = outcome_column(sheet, choice.outcome.as_deref(), speed)?;
        let left = LeftOut::of(sheet, &rows)?;
        let (mut kept, mut left_out) = (Vec::new(), Vec::new());
        for row in &rows {
            match left.why(row) {
                Some(why) => left_out.push((row.line, why)),
                None => kept.push(*row),
            }
        }
        let words = words_of(sheet, &kept, outcome, choice.through.as_deref())?;
        check_thousands(sheet, &kept, speed, &unit)?;
        Ok(Shots { speed, unit, outcome, words, kept, left_out })
    }

    fn speed_of(&self, sheet: &Sheet, row: &Row) -> Result<f64, Error> {
        speed_in(sheet, row, self.speed)
    }

    fn notes(&self, sheet: &Sheet) -> Vec<String> {
        let mut notes = vec![how_read(sheet, self.speed, self.outcome, &self.words)];
        notes.extend(of_kinds(sheet, &self.kept));
        notes
    }
}

/// The speed in a cell.
fn speed_in(sheet: &Sheet, row: &Row, place: usize) -> Result<f64, Error> {
    let value = sheet.number(row, place)?;
    if value > 0.0 {
        return Ok(value);
    }
    let message = format!("the cell is \"{}\"; allowed: a speed above 0", shortened(&row.cells[place]));
    Err(sheet.error(row.line, place + 1, &message))
}

/// The column that a user names.
fn named(sheet: &Sheet, option: &str, name: &str) -> Result<usize, Error> {
    let wanted = plain(name);
    let mut found = sheet
        .headings
        .iter()
        .enumerate()
        .filter(|(_, heading)| [&heading.text, &heading.name].into_iter().any(|text| plain(text) == wanted));
    match (found.next(), found.next()) {
        (Some((place, _)), None) => Ok(place),
        (None, _) => {
            let message = format!("{option}: no column \"{name}\"; there are: {}", all(sheet));
            Err(Error::Input(format!("{}:{}: {message}", sheet.name, sheet.header)))
        }
        (Some((one, _)), Some((other, _))) => {
            let message = format!("{option}: columns {} and {} are called \"{name}\"", one + 1, other + 1);
            Err(Error::Input(format!("{}:{}: {message}; allowed: one", sheet.name, sheet.header)))
        }
    }
}

fn all(sheet: &Sheet) -> String {
    let texts: Vec<&str> = sheet.headings.iter().map(|heading| heading.text.as_str()).collect();
    texts.join(", ")
}

/// The columns of these names.
fn columns(sheet: &Sheet, names: &[&str]) -> Vec<usize> {
    let is_one = |place: &usize| {
        let heading = &sheet.headings[*place];
        let name = plain(&heading.name);
        names.contains(&name.trim_end_matches('?').trim_end()) || names.contains(&plain(&heading.text).as_str())
    };
    (0..sheet.headings.len()).filter(is_one).collect()
}

/// One column of some, or an error that names them.
fn only_one(sheet: &Sheet, found: &[usize], what: &str, option: &str, allowed: &str) -> Result<usize, Error> {
    let message = match found {
        [one] => return Ok(*one),
        [] => format!("no column is {what}; there are: {}; allowed: {allowed}, or {option} COLUMN", all(sheet)),
        [_, other, ..] => {
            let texts: Vec<&str> = found.iter().map(|&place| sheet.headings[place].text.as_str()).collect();
            let message = format!("{} could each be {what}; allowed: {option} COLUMN", texts.join(", "));
            return Err(Error::Input(format!("{}:{}:{}: {message}", sheet.name, sheet.header, other + 1)));
        }
    };
    Err(Error::Input(format!("{}:{}:1: {message}", sheet.name, sheet.header)))
}

/// By its name, or else the one whose unit is of a speed.
fn speed_column(sheet: &Sheet, choice: Option<&str>) -> Result<usize, Error> {
    if let Some(name) = choice {
        return named(sheet, "--speed", name);
    }
    let mut found = columns(sheet, &SPEEDS);
    if found.is_empty() {
        let is_speed = |place: &usize| {
            let heading = &sheet.headings[*place];
            let name = plain(&heading.name);
            let is_other =
                OTHER_SPEEDS.iter().any(|other| name == *other || name.split(' ').any(|word| word == *other));
            !is_other && matches!(&heading.unit, Some(Ok(unit)) if unit.measures(SPEED))
        };
        found = (0..sheet.headings.len()).filter(is_speed).collect();
    }
    only_one(sheet, &found, "the speed", "--speed", "a heading as \"speed (m/s)\"")
}

fn unit_of(sheet: &Sheet, speed: usize) -> Result<Unit, Error> {
    let heading = &sheet.headings[speed];
    let what = match &heading.unit {
        Some(Ok(unit)) if unit.measures(SPEED) => return Ok(unit.clone()),
        Some(_) => "is no unit of speed",
        None => "has no unit",
    };
    let message = format!(
        "the heading \"{}\" {what}; allowed: \"{} (m/s)\", or ft/s, km/s",
        shortened(&heading.text),
        heading.name
    );
    Err(Error::Input(format!("{}:{}:{}: {message}", sheet.name, sheet.header, speed + 1)))
}

/// A point or comma before three digits is a decimal sign, unless all that have one are so and others have none, or all
/// would be slower than any shot: then it may stand for thousands.
fn check_thousands(sheet: &Sheet, rows: &[&Row], speed: usize, unit: &Unit) -> Result<(), Error> {
    let looks_so = |cell: &str| {
        cell.split_once(['.', ',']).is_some_and(|(whole, part)| {
            let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
            digits(whole) && whole.len() <= 3 && !whole.starts_with('0') && digits(part) && part.len() == 3
        })
    };
    let filled = rows.iter().filter(|row| !row.cells[speed].is_empty());
    let (signed, bare): (Vec<&&Row>, Vec<&&Row>) = filled.partition(|row| row.cells[speed].contains(['.', ',']));
    let Some(first) = signed.first().filter(|_| signed.iter().all(|row| looks_so(&row.cells[speed]))) else {
        return Ok(());
    };
    let metres = Unit::parse("m/s").map_err(|message| Error::Input(message.to_string()))?;
    let is_slow =
        |row: &&&Row| sheet.number(row, speed).is_ok_and(|value| unit.scale.convert(value, &metres.scale) < SLOW);
    if bare.is_empty() && !signed.iter().all(is_slow) {
        return Ok(());
    }
    let cell = shortened(&first.cells[speed]);
    let message =
        format!("the cell is \"{cell}\", a fraction or thousands; allowed: speeds without a sign for thousands");
    Err(sheet.error(first.line, speed + 1, &message))
}

fn outcome_column(sheet: &Sheet, choice: Option<&str>, speed: usize) -> Result<usize, Error> {
    if let Some(name) = choice {
        return named(sheet, "--outcome", name);
    }
    let mut found = columns(sheet, &OUTCOMES);
    found.retain(|&place| place != speed);
    only_one(sheet, &found, "the outcome", "--outcome", "a heading as \"outcome\" or \"result\"")
}

fn words_of(sheet: &Sheet, rows: &[&Row], outcome: usize, through: Option<&str>) -> Result<Words, Error> {
    let cells: Vec<&str> = rows.iter().map(|row| row.cells[outcome].as_str()).collect();
    // What stands in parentheses is no unit here.
    Words::of(&sheet.headings[outcome].text, &cells, through).map_err(|(word, message)| {
        let line = rows.iter().find(|row| plain(&row.cells[outcome]) == word).map_or(sheet.header, |row| row.line);
        sheet.error(line, outcome + 1, &format!("the cell is \"{}\", {message}", shortened(&word)))
    })
}

/// The columns that say which shots are left out.
struct LeftOut {
    /// The column, and whether yes in it keeps a shot.
    column: Option<(usize, bool)>,
    reasons: Vec<usize>,
}

impl LeftOut {
    /// # Errors
    /// A cell says neither yes nor no, or two columns say which shots are kept.
    fn of(sheet: &Sheet, rows: &[&Row]) -> Result<LeftOut, Error> {
        let (kept, left) = (columns(sheet, &KEPT), columns(sheet, &LEFT_OUT));
        let found: Vec<(usize, bool)> =
            kept.iter().map(|&place| (place, true)).chain(left.iter().map(|&place| (place, false))).collect();
        if let [(one, _), (other, _), ..] = found[..] {
            let message = format!("columns {} and {} both say which shots are kept; allowed: one", one + 1, other + 1);
            return Err(Error::Input(format!("{}:{}:{}: {message}", sheet.name, sheet.header, other + 1)));
        }
        let column = found.first().copied();
        if let Some((place, true)) = column {
            let is_yes = |cell: &str| YES.contains(&plain(cell).as_str());
            let marked = rows.iter().any(|row| is_yes(&row.cells[place]));
            for row in rows {
                let cell = plain(&row.cells[place]);
                let blank = cell.is_empty() && !marked;
                if !blank && !is_yes(&cell) && !NO.contains(&cell.as_str()) {
                    let message = format!("the cell is \"{}\"; allowed: yes or no", shortened(&row.cells[place]));
                    return Err(sheet.error(row.line, place + 1, &message));
                }
            }
        }
        Ok(LeftOut { column, reasons: columns(sheet, &REASONS) })
    }

    /// Why a shot is left out; nothing where it is kept.
    fn why(&self, row: &Row) -> Option<String> {
        let (place, keeps) = self.column?;
        let cell = plain(&row.cells[place]);
        let is_kept = if keeps { !NO.contains(&cell.as_str()) } else { NOT_LEFT_OUT.contains(&cell.as_str()) };
        if is_kept {
            return None;
        }
        let is_bare = YES.contains(&cell.as_str()) || NO.contains(&cell.as_str());
        let own = (!keeps && !is_bare).then(|| row.cells[place].clone());
        let said = self.reasons.iter().map(|&place| row.cells[place].clone()).filter(|text| !text.is_empty());
        let reasons: Vec<String> = own.into_iter().chain(said).collect();
        Some(if reasons.is_empty() { "no reason given".to_string() } else { reasons.join("; ") })
    }
}

/// Which columns were taken, and what their words were taken for.
fn how_read(sheet: &Sheet, speed: usize, outcome: usize, words: &Words) -> String {
    let of = |meaning: Meaning, what: &str| {
        let words = words.listed(meaning);
        (!words.is_empty()).then(|| format!("\"{}\" {what}", words.join("\", \"")))
    };
    let said = [(Meaning::Stop, "a stop"), (Meaning::Perforation, "a perforation"), (Meaning::None, "neither")];
    let said: Vec<String> = said.into_iter().filter_map(|(meaning, what)| of(meaning, what)).collect();
    let said = if said.is_empty() { String::new() } else { format!(": {}", said.join(", ")) };
    format!(
        "Speed: column {}, \"{}\". Outcome: column {}, \"{}\"{said}.",
        speed + 1,
        sheet.headings[speed].text,
        outcome + 1,
        sheet.headings[outcome].text,
    )
}

/// Words that were taken the wrong way round make a curve that falls.
fn of_contrary(fates: &[Fate]) -> Option<String> {
    let mean = |through: bool| {
        let speeds: Vec<f64> = fates.iter().filter(|fate| fate.through == through).map(|fate| fate.speed).collect();
        (!speeds.is_empty()).then(|| speeds.iter().sum::<f64>() / speeds.len() as f64)
    };
    let warning = "warning: the perforations were slower than the stops, in the mean; are the words the other way round? \
                   --through WORD is the word of the perforations";
    (mean(true)? < mean(false)?).then(|| warning.to_string())
}

/// Shots of several kinds have no one V50.
fn of_kinds(sheet: &Sheet, rows: &[&Row]) -> Vec<String> {
    let note = |place: usize| {
        let mut known = HashSet::new();
        let values: Vec<&str> =
            rows.iter().map(|row| row.cells[place].as_str()).filter(|&it| known.insert(it)).collect();
        let text = &sheet.headings[place].text;
        (values.len() > 1).then(|| {
            let more = values.len().saturating_sub(NAMED);
            let more = if more == 0 { String::new() } else { format!(" and {more} more") };
            format!(
                "warning: \"{text}\" differs among the shots ({}{more}); one V50 is of one of them: --only \"{}={}\"",
                values.iter().take(NAMED).copied().collect::<Vec<_>>().join(", "),
                sheet.headings[place].name,
                values[0]
            )
        })
    };
    columns(sheet, &KINDS).into_iter().filter_map(note).collect()
}

#[cfg(test)]
mod tests;
