//! `umat-check` on small inputs that are each of one kind (`ffi-tests/check/cases.toml`): what each line says of them.

mod support;

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;
use support::{check, corpus, parse};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Cases {
    case: Vec<Case>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    file: String,
    #[serde(default)]
    arguments: Vec<String>,
    exit: i32,
    /// Of a line its verdict, and behind a colon a part of its text or one of its kinds.
    lines: BTreeMap<String, String>,
    /// What no line's text may have.
    #[serde(default)]
    without: Vec<String>,
}

impl Case {
    /// What is otherwise than it should be.
    fn differences(&self) -> String {
        let (code, report) = check(&corpus("cases").join(&self.file), &self.arguments);
        let lines = report["materials"][0]["lines"].as_array().expect("lines");
        let mut differences = String::new();
        if code != self.exit {
            differences += &format!("\n  exit {code} instead of {}", self.exit);
        }
        for (name, wanted) in &self.lines {
            let line = lines.iter().find(|line| line["line"] == name.as_str());
            let found = line.map_or("no such line".to_string(), shown);
            let (verdict, text) = wanted.split_once(": ").unwrap_or((wanted, ""));
            if !found.starts_with(&format!("{verdict}:")) || !found.contains(text) {
                differences += &format!("\n  {name} is \"{found}\" instead of \"{wanted}\"");
            }
        }
        for unwanted in &self.without {
            for line in lines.iter().filter(|line| shown(line).contains(unwanted)) {
                differences += &format!("\n  {} has \"{unwanted}\": {}", line["line"], shown(line));
            }
        }
        match differences.is_empty() {
            true => differences,
            false => format!("{} {}:{differences}\n", self.file, self.arguments.join(" ")),
        }
    }
}

fn shown(line: &Value) -> String {
    let kinds = line["kinds"].as_array().expect("kinds").iter().filter_map(Value::as_str).collect::<Vec<_>>();
    let [verdict, text] = ["verdict", "text"].map(|key| line[key].as_str().expect("text"));
    format!("{verdict}: {text} [{}]", kinds.join(", "))
}

#[test]
fn each_case_is_told_as_what_it_is() {
    let Cases { case: cases } = parse("cases.toml");
    assert!(cases.len() > 10);
    let differences: String = cases.iter().map(Case::differences).collect();
    assert!(differences.is_empty(), "{differences}");
}
