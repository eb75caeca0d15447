//! Tables of measured shots: `toron v50 --analyse`.

use std::path::Path;
use std::process::{Command, Output};

use toron_test_support::library::{ROOT, folder};

/// The command of the guide, but for its directory.
const TABLE: &str = "examples/shots/panel.csv";

fn analyse(table: &str, output: &Path, arguments: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
    program.current_dir(ROOT).args(["v50", "--analyse", table, "-o"]).arg(output).args(arguments);
    program.output().expect("it starts")
}

fn said(answer: &Output) -> String {
    let text = [&answer.stdout[..], &answer.stderr[..]].map(String::from_utf8_lossy).concat();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// From a spreadsheet's export to a report with a picture, whatever its encoding; the figures in the file have all
/// digits.
#[test]
fn a_spreadsheet_is_analysed() {
    let output = folder("shots");
    std::fs::remove_dir_all(&output).and_then(|()| std::fs::create_dir_all(&output)).expect("a folder");
    let out = output.join("first");
    let answer = analyse(TABLE, &out, &[]);
    let text = said(&answer);
    assert!(answer.status.success(), "{text}");
    for wanted in [
        "17 shots: 8 stopped, 8 through, 0 without a fate, 1 left out",
        "\"Velocity [m/s]\". Outcome: column 4, \"Result\": \"pp\" a stop, \"cp\" a perforation.",
        "Left out, line 21: edge, 40 mm",
        "Zone of mixed results: from the slowest perforation at 624.6 m/s to the fastest stop at 631.8 m/s",
        "2 and 2: 627.5 m/s, spread 7.200",
    ] {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    let figures = std::fs::read_to_string(out.join("v50.csv")).expect("figures");
    assert!(figures.lines().next().is_some_and(|titles| titles.contains("V50_low (m/s)")), "{figures}");
    assert!(out.join("v50.svg").is_file() && out.join("v50.png").is_file());

    // The same table as other programs write it has the same figures.
    let text = std::fs::read_to_string(Path::new(ROOT).join(TABLE)).expect("the table");
    let text = text.trim_start_matches('\u{feff}');
    let windows = text.chars().map(|c| if c == '–' { 0x96 } else { c as u8 }).collect();
    let wide = [0xff, 0xfe].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    let encodings: [(&str, Vec<u8>); 2] = [("windows", windows), ("wide", wide)];
    for (name, bytes) in encodings {
        let table = output.join(format!("{name}.csv"));
        std::fs::write(&table, bytes).expect("it is written");
        let out = output.join(name);
        let answer = analyse(table.to_str().expect("a path"), &out, &[]);
        assert!(answer.status.success(), "{}", said(&answer));
        let found = std::fs::read_to_string(out.join("v50.csv")).expect("figures");
        let own = |text: &str| {
            text.lines().map(|line| line.rsplit_once(".csv").map_or(line, |it| it.1).to_string()).collect::<Vec<_>>()
        };
        assert_eq!(own(&found), own(&figures), "{name}");
    }
}

/// Two tables are compared; the options say what is printed, and wrong ones what is allowed.
#[test]
fn tables_are_compared() {
    let output = folder("shots-compared");
    let second = output.join("second.csv");
    std::fs::copy(Path::new(ROOT).join(TABLE), &second).expect("a copy");
    let options = [
        "--with",
        second.to_str().expect("a path"),
        "--link",
        "probit",
        "--percentile",
        "1",
        "90",
        "--level",
        "90",
        "--log",
    ];
    let answer = analyse(TABLE, &output, &options);
    let text = said(&answer);
    assert!(answer.status.success(), "{text}");
    for wanted in [
        "V1, 90 %",
        "V90",
        "ratio of V50, 90 %",
        "The shots do not refuse one V50 for both (by the probit). That proves none",
    ] {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    assert!(!text.contains("logit 6"), "{text}");
    let lines = std::fs::read_to_string(output.join("difference.csv")).expect("a table");
    assert!(lines.lines().nth(1).is_some_and(|line| line.starts_with("probit,1,0.9")), "{lines}");
    let json = said(&analyse(TABLE, &output.join("json"), &["--json"]));
    assert!(json.starts_with('{') && json.contains("\"V50, 95 %\""), "{json}");
    for (options, message) in [
        (vec!["--level", "0.95"], "--level is 0.95; allowed: 1 to 99.99, in percent"),
        (vec!["--percentile", "100"], "--percentile is 100; allowed: 0.01 to 99.99, in percent"),
        (vec!["--link", "cloglog"], "--link is cloglog; allowed: logit, probit"),
        (vec!["--only", "plies"], "--only is plies; allowed: COLUMN=VALUE, as in \"plies=20\""),
        (vec!["--spread", "-1"], "unexpected argument '-1'"),
        (
            vec!["--only", "Panel=A1", "--only", "Result=PP"],
            "no curve: all shots were stopped, the fastest at 627.5 m/s",
        ),
        (vec!["--limit"], "cannot be used with"),
        (
            vec!["--with", "examples/shots/../shots/panel.csv"],
            "panel.csv, the table of --analyse itself; allowed: another table",
        ),
    ] {
        let answer = analyse(TABLE, &output.join("refused"), &options);
        let text = said(&answer);
        assert!(!answer.status.success() && text.contains(message), "{message}: {text}");
        assert!(!output.join("refused").exists(), "{message}");
    }
}

/// Where the files cannot go, the message says which command wants to write them.
#[test]
fn an_output_that_is_none_is_told() {
    let output = folder("shots-output").join("file");
    std::fs::write(&output, "").expect("a file");
    let text = said(&analyse(TABLE, &output, &[]));
    assert!(text.contains("toron v50 --analyse writes its files to -o: output is "), "{text}");
    let text = said(&analyse(TABLE, &output.join("below"), &[]));
    assert!(text.contains("toron v50 --analyse writes its files to -o: "), "{text}");
}

/// An experiment from its first shot on: the table grows by what is asked for, and is read again.
#[test]
fn the_next_shot_is_told() {
    let folder = folder("shots-next");
    let table = folder.join("own.csv");
    let next = |count: &str, options: &[&str]| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_toron"));
        program.current_dir(&folder).args(["v50", "--next", count, "own.csv"]).args(options);
        said(&program.output().expect("it starts"))
    };
    let options = ["--design", "3pod", "--range", "550", "650", "--guess", "12"];
    let mut text = "asked (m/s),speed (m/s),outcome\n".to_string();
    for (shot, wanted, lines) in
        [("1", "575", "575,577,stop\n"), ("2", "625", "625,623,pass\n"), ("3", "600", "600,,\n")]
    {
        std::fs::write(&table, &text).expect("a table");
        let said = next("1", &options);
        assert!(said.contains(&format!(" {shot} {wanted}")), "{said}");
        text += lines;
    }
    std::fs::write(&table, &text).expect("a table");
    let said = next("1", &options);
    assert!(said.contains("1 shot is still to be fired, line 4 at 600.0 m/s") && !said.contains("fire at"), "{said}");
    let said = next("4", &[&options[..], &["--json"]].concat());
    assert!(said.starts_with('{') && said.contains("\"fire at\", \"m/s\"") && said.contains("3 more make 4"), "{said}");
    let said = next("0", &options);
    assert!(said.contains("--next is 0; allowed: 1 to 20 shots"), "{said}");
}

/// Designs are compared without a scene.
#[test]
fn designs_are_compared() {
    let output = Command::new(env!("CARGO_BIN_EXE_toron")).args(["v50", "--compare-designs", "2"]).output();
    let text = said(&output.expect("it starts"));
    let lines = 3 * 3 * 4 * 3;
    for design in ["langlie", "up-and-down", "d-optimal", "3pod"] {
        assert_eq!(text.matches(&format!(" {design} ")).count(), lines, "{design}: {text}");
    }
}
