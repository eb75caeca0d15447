//! The report: a line a question, aligned, in colours on a terminal; or as JSON.

use serde::{Deserialize, Serialize};

use super::finding::{Finding, Verdict};
use super::steps::NO_CONVERGENCE;
use toron_shared::text_table::folded;

/// The version of the JSON, which `report.schema.json` describes: it grows where a key goes or changes.
const VERSION: u32 = 2;

/// All that was found of a file.
#[derive(Serialize, Deserialize)]
pub struct Report {
    pub version: u32,
    pub file: String,
    pub verdict: Verdict,
    pub materials: Vec<MaterialReport>,
}

#[derive(Serialize, Deserialize)]
pub struct MaterialReport {
    pub name: String,
    /// What it reads: total, rate, mixed; none where it ended the process before that was known.
    pub law: Option<String>,
    pub lines: Vec<Finding>,
}

impl Report {
    pub fn new(file: &str, materials: Vec<MaterialReport>) -> Report {
        Report { version: VERSION, file: file.to_string(), verdict: Verdict::Right, materials }
    }

    /// The names of the lines that fail, which make the verdict.
    pub fn judge(&mut self, strict: bool) -> Vec<String> {
        let lines = self.materials.iter().flat_map(|material| &material.lines);
        let mut names: Vec<String> = Vec::new();
        for line in lines.filter(|line| line.fails(strict)) {
            if !names.contains(&line.check) {
                names.push(line.check.clone());
            }
        }
        self.verdict = if names.is_empty() { Verdict::Right } else { Verdict::Wrong };
        names
    }

    /// What fails, for the error: lines that are wrong, and those that fail a strict check alone.
    pub fn failures(&self, strict: bool) -> String {
        let lines = || self.materials.iter().flat_map(|material| &material.lines);
        let names = |is: &dyn Fn(&Finding) -> bool| {
            let mut names: Vec<&str> = lines().filter(|line| is(line)).map(|line| line.check.as_str()).collect();
            let mut seen = Vec::new();
            names.retain(|name| {
                !seen.contains(name) && {
                    seen.push(*name);
                    true
                }
            });
            names.join(", ")
        };
        let wrong = names(&|line| line.fails(false));
        let strictly = names(&|line| line.fails(strict) && !line.fails(false));
        let said = [("wrong", wrong), ("not allowed with --strict", strictly)];
        let said = said.into_iter().filter(|(_, names)| !names.is_empty());
        said.map(|(what, names)| format!("{what}: {names}")).collect::<Vec<_>>().join("; ")
    }

    /// Marks what an earlier report has too: the same line of the same material, verdict and kinds, and no much larger
    /// figure.
    pub fn mark_known(&mut self, earlier: &Report) {
        for material in &mut self.materials {
            let same = earlier.materials.iter().filter(|other| other.name == material.name);
            let known: Vec<&Finding> = same.flat_map(|other| &other.lines).collect();
            for line in &mut material.lines {
                let is_it = |other: &&&Finding| {
                    other.check == line.check && other.verdict == line.verdict && other.kinds == line.kinds
                };
                (line.known, line.known_figure) = (false, None);
                let Some(other) = known.iter().find(is_it).filter(|_| line.fails(true)) else { continue };
                line.known_figure = other.figure.filter(|figure| has_grown(line, *figure));
                line.known = line.known_figure.is_none();
            }
        }
    }

    /// For the terminal; `program` is the command that repeats a call.
    pub fn as_text(&self, program: &str, colours: bool) -> String {
        self.materials.iter().map(|material| self.material_as_text(material, program, colours)).collect()
    }

    fn material_as_text(&self, material: &MaterialReport, program: &str, colours: bool) -> String {
        let law = material.law.as_ref().map_or(String::new(), |law| format!(", a {law} law"));
        let mut text = format!("{}: {}{law}\n\n", self.file, material.name);
        let shown = gathered(&material.lines);
        for line in &shown {
            text.push_str(&line_as_text(line, program, colours));
        }
        let count =
            |verdict: Verdict| material.lines.iter().filter(|line| line.verdict == verdict && !line.known).count();
        let known = material.lines.iter().filter(|line| line.known).count();
        let counts =
            [Verdict::Right, Verdict::Wrong, Verdict::Ended, Verdict::Warning, Verdict::NotSure, Verdict::NotReported];
        let counts: Vec<String> = counts
            .into_iter()
            .filter(|&verdict| count(verdict) > 0)
            .map(|verdict| format!("{} {}", count(verdict), verdict.name()))
            .chain((known > 0).then(|| format!("{known} known")))
            .collect();
        text.push_str(&format!("\n{}\n", counts.join(", ")));
        text
    }
}

/// By what factor a figure may grow that is known.
const GROWN: f64 = 2.0;

/// Whether the figure is much larger than this one. That of steps, an order, is the worse the smaller it is.
fn has_grown(line: &Finding, known: f64) -> bool {
    let is_order = line.kinds.iter().any(|kind| kind == NO_CONVERGENCE);
    line.figure.is_some_and(|figure| !is_order && figure.abs() > GROWN * known.abs())
}

/// So many lines that are not sure for the same reason are one.
const SAME: usize = 3;

/// The lines as they are shown: what several are not sure of for one reason is said once, at the end.
fn gathered(lines: &[Finding]) -> Vec<Finding> {
    let same = |line: &Finding| {
        let of_one_reason = |other: &&Finding| other.verdict == Verdict::NotSure && other.text == line.text;
        lines.iter().filter(of_one_reason).collect::<Vec<_>>()
    };
    let is_one_of_many = |line: &Finding| line.verdict == Verdict::NotSure && same(line).len() >= SAME;
    let mut shown: Vec<Finding> = lines.iter().filter(|line| !is_one_of_many(line)).cloned().collect();
    let mut reasons: Vec<&str> = Vec::new();
    for line in lines.iter().filter(|line| is_one_of_many(line)) {
        if reasons.contains(&line.text.as_str()) {
            continue;
        }
        reasons.push(&line.text);
        let same = same(line);
        let names = same.iter().map(|line| line.check.as_str()).collect::<Vec<_>>().join(", ");
        shown.push(Finding {
            check: format!("{} others", same.len()),
            text: format!("{}: {names}", line.text),
            call: None,
            ..line.clone()
        });
    }
    shown
}

/// Columns: name, figure, verdict, words.
const NAME: usize = 12;
const FIGURE: usize = 8;
const VERDICT: usize = 13;
const WORDS: usize = 78;

/// A line of the report.
fn line_as_text(line: &Finding, program: &str, colours: bool) -> String {
    let figure = line.figure.map_or(String::new(), short);
    let verdict = format!("{:<VERDICT$}", line.verdict.name());
    let verdict = match (colours, line.verdict) {
        (false, _) => verdict,
        (true, Verdict::Right) => format!("\x1b[32m{verdict}\x1b[0m"),
        (true, Verdict::Wrong | Verdict::Ended) => format!("\x1b[1;31m{verdict}\x1b[0m"),
        (true, Verdict::Warning) => format!("\x1b[33m{verdict}\x1b[0m"),
        (true, _) => format!("\x1b[2m{verdict}\x1b[0m"),
    };
    let mut words = finding_text(line);
    if let Some(call) = &line.call {
        words.push_str(&format!("; {program} --again {call}"));
    }
    let indent = " ".repeat(NAME + FIGURE + 2 + VERDICT);
    let words = folded(&words, WORDS).replace("\n  ", &format!("\n{indent}"));
    let map: String = line.map.iter().map(|row| format!("{indent}{row}\n")).collect();
    format!("{:<NAME$}{figure:>FIGURE$}  {verdict}{words}\n{map}", line.check)
}

/// The text, and what the baseline says of the line.
pub fn finding_text(line: &Finding) -> String {
    match line.known_figure {
        Some(figure) => format!("(known, but worse: it was {}) {}", short(figure), line.text),
        None if line.known => format!("(known) {}", line.text),
        None => line.text.clone(),
    }
}

/// Three digits.
fn short(figure: f64) -> String {
    if figure == 0.0 {
        "0".to_string()
    } else if (0.01..100.0).contains(&figure.abs()) {
        format!("{figure:.3}")
    } else {
        format!("{figure:.1e}")
    }
}

#[cfg(test)]
mod tests {
    use super::super::finding::Question;
    use super::*;

    #[test]
    fn what_a_baseline_has_does_not_fail() {
        let warned = |text: &str| {
            let line = Finding::new(Question::Outputs, Verdict::Warning, None, text).with("unset");
            Report::new("umat.f", vec![MaterialReport { name: "A".to_string(), law: None, lines: vec![line] }])
        };
        let (mut report, earlier) = (warned("one"), warned("another text"));
        assert!(report.judge(false).is_empty());
        assert_eq!((report.judge(true), report.verdict), (vec!["outputs".to_string()], Verdict::Wrong));
        assert_eq!(report.failures(true), "not allowed with --strict: outputs");
        assert_eq!(report.failures(false), "");
        report.mark_known(&earlier);
        assert!(report.judge(true).is_empty());
        assert!(report.as_text("umat-check", false).ends_with("\n1 known\n"), "the counts have it apart");
        // A further kind is news.
        report.materials[0].lines[0].kinds.push("input overwritten".to_string());
        report.mark_known(&earlier);
        assert_eq!(report.judge(true), ["outputs"]);
    }

    #[test]
    fn a_known_fault_that_is_much_worse_fails() {
        let wrong = |figure: f64| {
            let line = Finding::new(Question::Tangent, Verdict::Wrong, Some(figure), "").with("unknown");
            Report::new("umat.f", vec![MaterialReport { name: "A".to_string(), law: None, lines: vec![line] }])
        };
        for (figure, fails) in [(0.01, false), (0.019, false), (0.021, true)] {
            let mut report = wrong(figure);
            report.mark_known(&wrong(0.01));
            assert_eq!(!report.judge(false).is_empty(), fails, "{figure}");
            assert_eq!(report.as_text("umat-check", false).contains("(known, but worse: it was 0.010)"), fails);
        }
    }

    #[test]
    fn what_is_not_sure_for_one_reason_is_said_once() {
        let unsure = |question: Question| Finding::new(question, Verdict::NotSure, None, "ends as in memory");
        let mut lines = vec![Finding::new(Question::Memory, Verdict::Ended, None, "STOP"), unsure(Question::Rest)];
        lines.push(unsure(Question::Tangent));
        assert_eq!(gathered(&lines).len(), 3);
        lines.push(unsure(Question::Repeat));
        let shown = gathered(&lines);
        assert_eq!(shown.len(), 2);
        assert_eq!(
            (shown[1].check.as_str(), shown[1].text.as_str()),
            ("3 others", "ends as in memory: rest, tangent, repeat")
        );
    }

    #[test]
    fn columns_stand_below_each_other_and_colours_change_no_width() {
        let right = Finding::new(Question::Rest, Verdict::Right, Some(0.0), "no stress at rest");
        let long = "a sentence of many words ".repeat(8);
        let wrong = Finding::new(Question::Tangent, Verdict::Wrong, Some(0.25), long.trim());
        let plain = [line_as_text(&right, "umat-check", false), line_as_text(&wrong, "umat-check", false)].concat();
        let columns: Vec<usize> = plain.lines().map(|line| line.len() - line.trim_start().len()).collect();
        assert_eq!(columns[..2], [0, 0]);
        assert!(columns[2..].iter().all(|&column| column == NAME + FIGURE + 2 + VERDICT));
        let coloured = line_as_text(&right, "umat-check", true);
        assert_eq!(coloured.replace("\x1b[32m", "").replace("\x1b[0m", ""), line_as_text(&right, "umat-check", false));
    }
}
