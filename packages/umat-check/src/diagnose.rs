//! What gfortran warns of in a source that it compiles: lines that it cuts, numbers that it shortens, divisions of
//! whole numbers.

use std::path::Path;

use super::finding::{Finding, Question, Verdict};
use super::material::Material;

/// A line of a source that a warning is of.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    pub file: String,
    pub line: usize,
    /// What stands there, without the white space around it.
    pub text: String,
}

impl Place {
    /// As `umat.f:12`.
    pub fn named(&self) -> String {
        format!("{}:{}", self.file, self.line)
    }
}

/// What is warned of.
#[derive(Clone, Debug, Default)]
pub struct Warnings {
    /// Lines whose end is cut off, and what is left of the statement.
    cut: Vec<(Place, String)>,
    /// Numbers of double precision that go to a variable of single precision.
    pub single: Vec<Place>,
    /// Numbers that go to a whole one.
    whole: Vec<Place>,
    /// Divisions of constant whole numbers, which leave a rest.
    divided: Vec<Place>,
    /// Names that are declared as whole numbers.
    declared: Vec<String>,
}

/// The flags by which gfortran says all this.
pub const FLAGS: [&str; 4] = ["-Wline-truncation", "-Wconversion", "-Winteger-division", "-fdiagnostics-plain-output"];

impl Warnings {
    /// From gfortran's messages; `columns` are those of the form that it read.
    pub fn read(file: &Path, messages: &str, columns: Option<usize>) -> Warnings {
        let mut found = Warnings { declared: declared_whole(file), ..Warnings::default() };
        for message in messages.lines() {
            let Some((place, warning)) = message.split_once(": Warning: ") else { continue };
            let Some((path, line, raw)) = place_of(place) else { continue };
            let file = path.file_name().map_or(String::new(), |name| name.to_string_lossy().to_string());
            let place = Place { file, line, text: raw.trim().to_string() };
            if warning.contains("-Wline-truncation") {
                if let Some((left, rest)) = columns.and_then(|columns| cut(&raw, columns)) {
                    found.cut.push((place, format!("{} | {}", end_of(&left), start_of(&rest))));
                }
            } else if warning.contains("to REAL(4)") {
                found.single.push(place);
            } else if warning.contains("to INTEGER(") {
                found.whole.push(place);
            } else if warning.contains("-Winteger-division") {
                found.divided.push(place);
            }
        }
        found
    }

    /// The line of the build: by which compiler, and what follows from the warnings.
    pub fn line(&self, by: &str, material: &Material) -> Finding {
        let mut wrong = Vec::new();
        let mut doubtful = Vec::new();
        let mut kinds = Vec::new();
        for (place, shown) in &self.cut {
            wrong.push(format!("{} is cut (-Wline-truncation): {shown}", place.named()));
            kinds.push("line cut");
        }
        for place in &self.whole {
            match self.shortened(place, material) {
                Some((text, true)) => wrong.push(text),
                Some((text, false)) => doubtful.push(text),
                None => continue,
            }
            kinds.push("whole number");
        }
        for place in self.divided.iter().filter(|place| !is_declaration(&place.text)) {
            doubtful.push(format!("{}: a division of whole numbers drops its rest: {}", place.named(), place.text));
            kinds.push("integer division");
        }
        let verdict = match (wrong.is_empty(), doubtful.is_empty()) {
            (false, _) => Verdict::Wrong,
            (true, false) => Verdict::Warning,
            (true, true) => Verdict::Right,
        };
        let mut said = vec![by.to_string()];
        said.extend(wrong.into_iter().chain(doubtful));
        let more = said.len().saturating_sub(1 + SHOWN);
        said.truncate(1 + SHOWN);
        if more > 0 {
            said.push(format!("{more} more"));
        }
        kinds.iter().fold(Finding::new(Question::Build, verdict, None, said.join("; ")), |line, kind| line.with(kind))
    }

    /// What a whole number keeps of a property, or may lose of an expression; and whether it is sure.
    fn shortened(&self, place: &Place, material: &Material) -> Option<(String, bool)> {
        let (name, value) = place.text.split_once('=')?;
        let (name, value) = (name.trim().to_uppercase(), value.trim().to_uppercase());
        if let Some(index) = property(&value) {
            let given = *material.properties.get(index.checked_sub(1)?)?;
            let kept = given.trunc();
            let text =
                format!("{}: {} keeps {kept} of {given}, since {name} is a whole number", place.named(), place.text);
            return (given != kept).then_some((text, true));
        }
        let implicit =
            !self.declared.contains(&name) && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        let computed = value.contains(['*', '/']);
        let text = format!("{}: {name} is a whole number by its first letter: {}", place.named(), place.text);
        (implicit && computed).then_some((text, false))
    }
}

/// So many warnings are told.
const SHOWN: usize = 4;

/// The number n of `PROPS(n)`, if it is all there is.
fn property(value: &str) -> Option<usize> {
    value.strip_prefix("PROPS")?.trim().strip_prefix('(')?.strip_suffix(')')?.trim().parse().ok()
}

fn is_declaration(text: &str) -> bool {
    let text = text.to_uppercase();
    ["INTEGER", "DIMENSION", "PARAMETER"].iter().any(|word| text.starts_with(word))
}

/// Path, number and text of `path:line:column`.
fn place_of(place: &str) -> Option<(&Path, usize, String)> {
    let (rest, _) = place.rsplit_once(':')?;
    let (path, line) = rest.rsplit_once(':')?;
    let line: usize = line.parse().ok()?;
    let text = std::fs::read(path).ok()?;
    let text = String::from_utf8_lossy(&text);
    Some((Path::new(path), line, text.lines().nth(line.checked_sub(1)?)?.to_string()))
}

/// The two parts of a line that is cut at this column, where code is cut off: neither a comment nor, in lines of 72
/// columns, the numbers of punched cards up to column 80.
fn cut(line: &str, columns: usize) -> Option<(String, String)> {
    // A tab in the columns of labels goes to the seventh column; any other one is a character.
    let mut expanded = String::new();
    for letter in line.chars() {
        match letter {
            '\t' if expanded.len() < 6 => expanded.push_str(&" ".repeat(6 - expanded.len())),
            _ => expanded.push(letter),
        }
    }
    let left: String = expanded.chars().take(columns).collect();
    let rest: String = expanded.chars().skip(columns).collect();
    let cards = columns == 72 && expanded.trim_end().chars().count() <= 80;
    let is_code = !rest.trim().is_empty() && !rest.trim_start().starts_with('!') && !has_comment(&left) && !cards;
    is_code.then_some((left, rest))
}

/// Whether a comment begins in a line of code.
fn has_comment(line: &str) -> bool {
    let mut quote = None;
    line.chars().any(|letter| {
        match (quote, letter) {
            (None, '\'' | '"') => quote = Some(letter),
            (Some(open), _) if open == letter => quote = None,
            _ => {}
        }
        quote.is_none() && letter == '!'
    })
}

/// So many letters of either part of a line are shown.
const LETTERS: usize = 24;

fn end_of(text: &str) -> String {
    let skipped = text.chars().count().saturating_sub(LETTERS);
    format!("…{}", text.chars().skip(skipped).collect::<String>().trim_start())
}

fn start_of(text: &str) -> String {
    text.trim_end().chars().take(LETTERS).collect()
}

/// The names in declarations of whole numbers.
fn declared_whole(file: &Path) -> Vec<String> {
    let text = String::from_utf8_lossy(&std::fs::read(file).unwrap_or_default()).to_uppercase();
    let declarations = text.lines().filter(|line| line.trim_start().starts_with("INTEGER"));
    let words =
        declarations.flat_map(|line| line.split(|letter: char| !letter.is_ascii_alphanumeric() && letter != '_'));
    words.filter(|word| !word.is_empty()).map(str::to_string).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_cut_is_code_or_not() {
        let code = format!("      A = {}B + C", " ".repeat(60));
        assert_eq!(cut(&code, 72), Some((code[..72].to_string(), code[72..].to_string())).filter(|_| code.len() > 80));
        let long = format!("      A = {}B + C", "1 + ".repeat(40));
        assert!(cut(&long, 132).is_some_and(|(_, rest)| rest.ends_with("B + C")));
        let commented = format!("      A = 1 ! {}", "words ".repeat(40));
        assert_eq!(cut(&commented, 132), None);
        let card = format!("{:<72}CARD0010", "      A = 1");
        assert_eq!(cut(&card, 72), None);
        assert!(cut(&format!("      A = '!{}' // B", "x".repeat(130)), 132).is_some());
    }

    #[test]
    fn a_property_is_told_from_an_expression() {
        assert_eq!(property("PROPS(12)"), Some(12));
        assert_eq!(property("PROPS(1)*2"), None);
    }
}
