//! What became of a shot, in the words that tables have for it.

use std::collections::HashSet;

/// What a word says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    Stop,
    Perforation,
    /// Neither: the shot is counted, and left out.
    None,
}

/// Words for a stop and for a perforation that stand together in a table.
type Family = [&'static [&'static str]; 2];

const FAMILIES: [Family; 4] = [
    [
        &["stop", "stopped", "s", "stops", "held", "caught", "gestoppt", "stopp", "arrêt", "arrêté"],
        &["through", "pass", "passed", "passed through", "p", "perforation", "perforated", "durchschuss"],
    ],
    [
        &["partial", "partial penetration", "pp", "p", "partial perforation", "part"],
        &["complete", "complete penetration", "cp", "c", "complete perforation", "comp"],
    ],
    [
        &["np", "no perforation", "non-perforation", "non perforation", "not perforated", "no penetration"],
        &["p", "perforation", "perforated", "penetration"],
    ],
    [&["0", "no", "n", "false", "nein", "non"], &["1", "yes", "y", "true", "ja", "j", "oui"]],
];
const NO_FATE: [&str; 8] = ["", "-", "–", "undecided", "error", "n/a", "na", "void"];
/// What a column has in its name of which 1 may be a stop.
const OF_STOPS: [&str; 8] = ["stop", "pass", "held", "caught", "partial", "pp", "gestoppt", "valid"];
/// What a column may be called that yes and no answer.
const OF_PERFORATIONS: [&str; 12] = [
    "perforation",
    "perforated",
    "through",
    "complete",
    "complete penetration",
    "complete perforation",
    "cp",
    "penetration",
    "penetrated",
    "durchschuss",
    "went through",
    "perforates",
];

/// What may stand in a column.
pub const ALLOWED: &str = "stop and pass, stopped and through, partial and complete, PP and CP, P and C, 0 and 1, no and yes under \
                           \"perforated\"; or --through WORD, the word of the perforations";

/// What the words of a column say, each by its own.
pub struct Words {
    meanings: Vec<(String, Meaning)>,
}

/// Small letters, without blanks around and twice.
pub fn plain(text: &str) -> String {
    text.to_lowercase().replace(['_', '\u{a0}'], " ").split_whitespace().collect::<Vec<_>>().join(" ")
}

impl Words {
    /// The meaning of each word of a column, whose heading is `heading`; `through` is the word of the perforations,
    /// where a user has said it.
    ///
    /// # Errors
    /// A word, and what is wrong with it.
    pub fn of(heading: &str, cells: &[&str], through: Option<&str>) -> Result<Words, (String, String)> {
        let mut known = HashSet::new();
        let words: Vec<String> =
            cells.iter().map(|cell| plain(cell)).filter(|word| known.insert(word.clone())).collect();
        let (none, told): (Vec<String>, Vec<String>) =
            words.into_iter().partition(|word| NO_FATE.contains(&word.as_str()) && through != Some(word));
        let meanings = match through {
            Some(through) => by_choice(told, &plain(through))?,
            None => by_families(&plain(heading), told)?,
        };
        let meanings = none.into_iter().map(|word| (word, Meaning::None)).chain(meanings).collect();
        Ok(Words { meanings })
    }

    pub fn meaning(&self, cell: &str) -> Meaning {
        let word = plain(cell);
        self.meanings.iter().find(|(known, _)| *known == word).map_or(Meaning::None, |found| found.1)
    }

    /// The words of stops, of perforations, and of neither.
    pub fn listed(&self, meaning: Meaning) -> Vec<&str> {
        self.meanings.iter().filter(|found| found.1 == meaning).map(|found| found.0.as_str()).collect()
    }
}

/// One word is that of the perforations, the other one that of the stops.
fn by_choice(words: Vec<String>, through: &str) -> Result<Vec<(String, Meaning)>, (String, String)> {
    let others: Vec<&String> = words.iter().filter(|word| *word != through).collect();
    if let [_, other, ..] = others[..] {
        let message = format!("two other words than that of --through, {through}; allowed: one, that of the stops");
        return Err((other.clone(), message));
    }
    let meaning = |word: &String| if word == through { Meaning::Perforation } else { Meaning::Stop };
    Ok(words.into_iter().map(|word| (word.clone(), meaning(&word))).collect())
}

/// A word has the meaning that all families know it by, or the one that it has in those that have all of the words.
fn by_families(heading: &str, words: Vec<String>) -> Result<Vec<(String, Meaning)>, (String, String)> {
    if let Some(word) = words.iter().find(|word| word.starts_with("fail")) {
        let message = "of the armour, or of the shot? allowed: --through WORD, the word of the perforations";
        return Err((word.clone(), message.to_string()));
    }
    let in_family = |family: &Family, word: &str| {
        let found = family.iter().position(|words| words.contains(&word))?;
        Some(if found == 0 { Meaning::Stop } else { Meaning::Perforation })
    };
    let whole: Vec<&Family> =
        FAMILIES.iter().filter(|family| words.iter().all(|word| in_family(family, word).is_some())).collect();
    let mut meanings = Vec::new();
    for word in &words {
        let all: Vec<Meaning> = FAMILIES.iter().filter_map(|family| in_family(family, word)).collect();
        let among: Vec<Meaning> = whole.iter().filter_map(|family| in_family(family, word)).collect();
        let found = [all, among].into_iter().find(|found| found.windows(2).all(|pair| pair[0] == pair[1]));
        let Some(meaning) = found.as_ref().map(|found| found.first()) else {
            let message = "which is partial for some and perforation for others; allowed: --through WORD, the word of the perforations";
            return Err((word.clone(), message.to_string()));
        };
        let Some(&meaning) = meaning else { return Err((word.clone(), format!("allowed: {ALLOWED}"))) };
        meanings.push((word.clone(), meaning));
    }
    if words.iter().all(|word| word == "pass" || word == "passed") && !words.is_empty() {
        let message = "the armour, or the shot through it? allowed: --through WORD, the word of the perforations";
        return Err((words[0].clone(), message.to_string()));
    }
    check_answers(heading, &words)?;
    Ok(meanings)
}

/// Yes and no, 1 and 0 need a question.
fn check_answers(heading: &str, words: &[String]) -> Result<(), (String, String)> {
    let [no, yes] = FAMILIES[3];
    let Some(word) = words.iter().find(|word| no.contains(&word.as_str()) || yes.contains(&word.as_str())) else {
        return Ok(());
    };
    let question = heading.split(['(', '[']).next().unwrap_or(heading).trim_end().trim_end_matches('?').trim_end();
    let is_digit = word == "0" || word == "1";
    let is_clear = if is_digit {
        !OF_STOPS.iter().any(|stop| heading.contains(stop))
    } else {
        OF_PERFORATIONS.contains(&question)
    };
    if is_clear {
        return Ok(());
    }
    let message = format!("under \"{heading}\"; allowed: --through {}, the word of the perforations", yes_of(word));
    Err((word.clone(), message))
}

/// The word that goes with one, as it is written where it means a perforation.
fn yes_of(word: &str) -> &'static str {
    match word {
        "0" | "1" => "0 or --through 1",
        "ja" | "j" | "nein" => "ja or --through nein",
        "oui" | "non" => "oui or --through non",
        _ => "yes or --through no",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(heading: &str, cells: &[&str], through: Option<&str>) -> Result<Vec<Meaning>, String> {
        let words = Words::of(heading, cells, through).map_err(|(word, message)| format!("{word}: {message}"))?;
        Ok(cells.iter().map(|cell| words.meaning(cell)).collect())
    }

    /// Stop and perforation, whatever a table calls them.
    #[test]
    fn words_are_known() {
        let both = Ok(vec![Meaning::Stop, Meaning::Perforation]);
        for [stop, pass] in [
            ["stop", "pass"],
            ["Stopped", "through"],
            ["PP", "CP"],
            ["P", "C"],
            ["NP", "P"],
            ["S", "P"],
            ["Partial Penetration", "complete  penetration"],
            ["partial", "CP"],
            ["stopped", "complete"],
            ["no perforation", "perforation"],
            ["0", "1"],
        ] {
            assert_eq!(of("Result", &[stop, pass], None), both, "{stop} {pass}");
        }
        assert_eq!(of("Perforated?", &["no", "Yes"], None), both);
        assert_eq!(of("Durchschuss", &["nein", "Ja"], None), both);
        assert_eq!(of("Perforated? (y/n)", &["n", "y"], None), both);
        assert_eq!(of("Result", &["pass", "fail"], Some("Fail")), both);
        assert_eq!(of("Stopped", &["1", "0"], Some("0")), both);
        let three = of("ending", &["stopped", "undecided", "through", ""], None);
        assert_eq!(three, Ok(vec![Meaning::Stop, Meaning::None, Meaning::Perforation, Meaning::None]));
        assert_eq!(of("Result", &["CP"], None), Ok(vec![Meaning::Perforation]));
    }

    /// What could be either is refused.
    #[test]
    fn words_of_two_meanings_are_refused() {
        for (heading, cells, wanted) in [
            ("Result", &["P", "P"][..], "p: which is partial for some and perforation for others; allowed: --through"),
            ("Result", &["pass", "fail"], "fail: of the armour, or of the shot? allowed: --through WORD"),
            ("Result", &["pass", "pass"], "pass: the armour, or the shot through it? allowed: --through WORD"),
            ("Result (1 = stopped)", &["1", "0"], "1: under \"result (1 = stopped)\"; allowed: --through"),
            ("Result", &["yes", "no"], "yes: under \"result\"; allowed: --through yes or --through no"),
            ("Stopped", &["0", "1"], "0: under \"stopped\"; allowed: --through 0 or --through 1"),
            ("Result", &["stop", "maybe"], "maybe: allowed: stop and pass,"),
        ] {
            let message = of(heading, cells, None).expect_err(wanted);
            assert!(message.starts_with(wanted), "{message}");
        }
        let message = of("Result", &["a", "b", "c"], Some("a")).expect_err("three words");
        assert!(message.starts_with("c: two other words than that of --through, a"), "{message}");
    }
}
