//! What the tokens of small decks are.

use super::abaqus;
use super::files::text;
use super::ls_dyna::{self, Transform};
use crate::error::Error;

/// Writes down what it is given; keywords that begin with `SKIP` want no lines.
#[derive(Default)]
struct Tokens(Vec<String>);

impl abaqus::Reader for Tokens {
    fn keyword(&mut self, keyword: &abaqus::Keyword<'_>) -> Result<bool, Error> {
        let parameters: Vec<String> =
            keyword.parameters.iter().map(|parameter| format!("{}={}", parameter.name, parameter.value)).collect();
        self.0.push(format!("{}: {} {}", keyword.line.number, keyword.name, parameters.join(" | ")));
        Ok(!keyword.name.starts_with("SKIP"))
    }

    fn data(&mut self, line: &super::line::Line<'_>) -> Result<(), Error> {
        let fields: Vec<&str> = abaqus::fields(line.text).collect();
        self.0.push(format!("{}: {}", line.number, fields.join(" | ")));
        Ok(())
    }
}

impl ls_dyna::Reader for Tokens {
    fn keyword(&mut self, keyword: &ls_dyna::Keyword<'_>) -> Result<bool, Error> {
        self.0.push(format!("{}: {}{}", keyword.line.number, keyword.name, if keyword.long { " long" } else { "" }));
        Ok(!keyword.name.starts_with("*SKIP"))
    }

    fn card(&mut self, card: &ls_dyna::Card<'_>) -> Result<(), Error> {
        let fields: [&str; 3] = card.fields([4, 8, 4])?;
        self.0.push(format!("{}: {}", card.line.number, fields.join("|")));
        Ok(())
    }

    fn begin_file(&mut self, transform: &Transform) -> Result<(), Error> {
        let Transform { place, offsets, factors, transformation } = transform;
        self.0.push(format!("{}: file {offsets:?} {factors:?} {transformation}", place.line));
        Ok(())
    }

    fn end_file(&mut self) {
        self.0.push("end".to_string());
    }
}

#[track_caller]
fn abaqus(deck: &str, tokens: &[&str]) {
    let mut found = Tokens::default();
    abaqus::read("deck.inp", &text(deck.as_bytes()), &mut found).expect("a deck");
    assert_eq!(found.0, tokens);
}

#[track_caller]
fn ls_dyna(deck: &str, tokens: &[&str]) {
    let mut found = Tokens::default();
    ls_dyna::read("deck.k", &text(deck.as_bytes()), &mut found).expect("a deck");
    assert_eq!(found.0, tokens);
}

#[test]
fn keywords_of_abaqus_and_their_lines() {
    abaqus(
        "\u{feff}** first\r\n*User Material, Constants = 3 ,unsymm\r\n1., , 3.,\r\n\r\n*skip this\nnothing\n *EL SET,\n** on\n elset=\"a, = b\",\n  Generate\n\"x, y\" , 2",
        &[
            "2: USERMATERIAL CONSTANTS=3 | UNSYMM=",
            "3: 1. |  | 3. | ",
            "4: ",
            "5: SKIPTHIS ",
            "7: ELSET ELSET=a, = b | GENERATE=",
            "11: \"x, y\" | 2",
        ],
    );
    let refused = |deck: &str| abaqus::read("deck.inp", deck, &mut Tokens::default()).expect_err(deck).to_string();
    assert_eq!(refused("\n1, 2\n"), "deck.inp:2: a line before the first keyword; allowed: comments, from ** on");
    assert!(refused("*a,\n*b\n").starts_with("deck.inp:1: a keyword line ends with a comma"));
    assert!(refused("*a, b=1,").starts_with("deck.inp:1: a keyword line ends with a comma"));
}

#[test]
fn keywords_of_ls_dyna_and_their_cards() {
    ls_dyna(
        "$ first\n*KEYWORD\n*one\n   1     2.5 abc more\n1, 2\n\n$ on\n*SKIP\nnothing\n*two +\n                   1                   2   3\n*three\n123456789012abcd\n*END\nrest\n",
        &[
            "3: *ONE",
            "4: 1|2.5|abc",
            "5: 1|2|",
            "6: ||",
            "8: *SKIP",
            "10: *TWO long",
            "11: 1|2|3",
            "12: *THREE",
            "13: 1234|56789012|abcd",
        ],
    );
    ls_dyna(
        "*KEYWORD MEMORY=2 LONG  = y\n*one\n                   1                   2\n*two -\n   1       2\n*KEYWORD LONG=N\n*three\n   1\n",
        &["2: *ONE long", "3: 1|2|", "4: *TWO", "5: 1|2|", "7: *THREE", "8: 1||"],
    );
}

/// As Fortran reads them; blank is 0.
#[test]
fn numbers_of_decks() {
    let file = "deck".into();
    let line = super::line::Line { file: &file, number: 3, text: "" };
    for (field, value) in [
        ("1", 1.0),
        (" -2.5 ", -2.5),
        (".5", 0.5),
        ("1.d3", 1e3),
        ("1D-3", 1e-3),
        ("1.5-3", 1.5e-3),
        ("-2.+2", -200.0),
        ("+1e+2", 100.0),
        ("", 0.0),
    ] {
        assert_eq!(line.real("x", field), Ok(value), "{field}");
    }
    for field in ["x", "1 2", "nan", "inf", "1e999", "--1", "1-2-3", "&r", "<r>", "1,2"] {
        let error = line.real("x", field).expect_err(field).to_string();
        assert_eq!(error, format!("deck:3: x is \"{field}\"; allowed: a finite number"));
    }
}
