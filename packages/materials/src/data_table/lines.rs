//! The lines of a table, those whose cells have line breaks in quotes as one.

use std::borrow::Cow;

/// A quote that is not closed within so many lines is a letter, as for inches.
const MOST: usize = 8;

/// Lines with the numbers of their first ones, from 1. A line break in quotes is a blank.
pub fn whole(text: &str) -> Vec<(usize, Cow<'_, str>)> {
    let lines: Vec<&str> = text.lines().collect();
    let (mut found, mut place) = (Vec::new(), 0);
    while let Some(&line) = lines.get(place) {
        let count = if is_open(line) { closed_after(&lines[place..]) } else { 1 };
        let joined = if count == 1 { Cow::Borrowed(line) } else { Cow::Owned(lines[place..place + count].join(" ")) };
        found.push((place + 1, joined));
        place += count;
    }
    found
}

/// After how many lines the quotes of the first are closed; one where they are not.
fn closed_after(lines: &[&str]) -> usize {
    (2..=MOST.min(lines.len())).find(|&count| !is_open(&lines[..count].join("\n"))).unwrap_or(1)
}

/// Whether a cell that begins with a quote has no end.
fn is_open(line: &str) -> bool {
    let (mut in_quotes, mut at_start) = (false, true);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            // Two quotes are one of the text.
            '"' if in_quotes && letters.peek() == Some(&'"') => drop(letters.next()),
            '"' if in_quotes => in_quotes = false,
            '"' if at_start => in_quotes = true,
            _ => {}
        }
        at_start = !in_quotes && (matches!(letter, ',' | ';' | '\t') || at_start && letter.is_whitespace());
    }
    in_quotes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_breaks_in_quotes_are_blanks() {
        let text = "a\n\"v\n(m/s)\";\"b \"\"c\"\"\nd\"\n5\" plate,1\n\"open,2\n3,4\n";
        let found = whole(text);
        let wanted = [(1, "a"), (2, "\"v (m/s)\";\"b \"\"c\"\" d\""), (5, "5\" plate,1"), (6, "\"open,2"), (7, "3,4")];
        assert_eq!(found.iter().map(|(number, line)| (*number, line.as_ref())).collect::<Vec<_>>(), wanted);
    }
}
