//! The report as other tools read it: JUnit's XML and SARIF, beside the JSON of [`super::report`].

use serde_json::{Value, json};

use super::finding::{Finding, Verdict};
use super::report::{Report, finding_text};

/// JUnit's XML: a suite a material, a case a line.
pub fn junit(report: &Report, strict: bool) -> String {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"umat-check\">\n");
    for material in &report.materials {
        let count = |is: &dyn Fn(&Finding) -> bool| material.lines.iter().filter(|line| is(line)).count();
        let failures = count(&|line| line.fails(strict));
        let skipped = count(&|line| is_skipped(line) && !line.fails(strict));
        text += &format!(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{failures}\" errors=\"0\" skipped=\"{skipped}\">\n",
            escaped(&format!("{}: {}", report.file, material.name)),
            material.lines.len()
        );
        for line in &material.lines {
            let (name, message) = (escaped(&line.check), escaped(&finding_text(line)));
            let class = escaped(&format!("{}.{}", report.file, material.name));
            text += &format!("    <testcase name=\"{name}\" classname=\"{class}\"");
            let kinds = escaped(&line.kinds.join(", "));
            text += &match (line.fails(strict), is_skipped(line)) {
                (true, _) => format!(
                    ">\n      <failure message=\"{message}\" type=\"{kinds}\">{}: {message}</failure>\n    </testcase>\n",
                    line.verdict.name()
                ),
                (false, true) => format!(">\n      <skipped message=\"{message}\"/>\n    </testcase>\n"),
                (false, false) => {
                    format!(">\n      <system-out>{}: {message}</system-out>\n    </testcase>\n", line.verdict.name())
                }
            };
        }
        text += "  </testsuite>\n";
    }
    text + "</testsuites>\n"
}

fn is_skipped(line: &Finding) -> bool {
    matches!(line.verdict, Verdict::NotAsked | Verdict::NotReported | Verdict::NotSure)
}

/// As XML has it, without what it must not have.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for letter in text.chars() {
        match letter {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\n' | '\t' => escaped.push(' '),
            letter if letter.is_control() => {}
            letter => escaped.push(letter),
        }
    }
    escaped
}

/// SARIF 2.1.0: what is wrong or warned of, at its line of the source where that is known.
pub fn sarif(report: &Report, strict: bool) -> Value {
    let mut rules: Vec<&str> = Vec::new();
    let mut results = Vec::new();
    for material in &report.materials {
        let told = |line: &&Finding| line.verdict == Verdict::Warning || line.verdict.fails() || line.fails(strict);
        for line in material.lines.iter().filter(told) {
            if !rules.contains(&line.check.as_str()) {
                rules.push(&line.check);
            }
            let level = if line.fails(strict) {
                "error"
            } else if line.known {
                "note"
            } else {
                "warning"
            };
            let number = line.source_line(&report.file);
            results.push(json!({
                "ruleId": line.check,
                "level": level,
                "message": { "text": format!("{}: {}", material.name, finding_text(line)) },
                "locations": [{
                    "physicalLocation": {
                        "artifactLocation": { "uri": report.file },
                        "region": { "startLine": number.unwrap_or(1) },
                    }
                }],
                "properties": { "kinds": line.kinds },
            }));
        }
    }
    let rules: Vec<Value> = rules.into_iter().map(|rule| json!({ "id": rule })).collect();
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": { "name": "umat-check", "version": env!("CARGO_PKG_VERSION"), "rules": rules } },
            "results": results,
        }],
    })
}

#[cfg(test)]
mod tests {
    use super::super::finding::Question;
    use super::super::report::MaterialReport;
    use super::*;

    fn report() -> Report {
        let lines = vec![
            Finding::new(Question::Rest, Verdict::Right, Some(0.0), "no stress"),
            Finding::new(Question::Runtime, Verdict::Wrong, None, "umat.f:17: Index '5' < 4 & \"above\"")
                .with("runtime check"),
            Finding::new(Question::Outputs, Verdict::Warning, None, "STRAN"),
            Finding::new(Question::Cycles, Verdict::NotAsked, None, "not declared"),
        ];
        let materials = vec![MaterialReport { name: "A".to_string(), law: None, lines }];
        Report::new("src/umat.f", materials)
    }

    #[test]
    fn junit_has_a_case_for_each_line_and_escapes_texts() {
        let text = junit(&report(), false);
        assert!(text.contains("tests=\"4\" failures=\"1\" errors=\"0\" skipped=\"1\""), "{text}");
        assert!(text.contains("Index '5' &lt; 4 &amp; &quot;above&quot;"), "{text}");
        assert!(junit(&report(), true).contains("failures=\"2\""));
    }

    #[test]
    fn sarif_has_the_lines_of_the_source() {
        let log = sarif(&report(), false);
        let results = log["runs"][0]["results"].as_array().expect("results");
        assert_eq!(results.len(), 2);
        assert_eq!(results[0]["level"], "error");
        assert_eq!(results[0]["locations"][0]["physicalLocation"]["region"]["startLine"], 17);
        assert_eq!(results[1]["level"], "warning");
    }
}
