//! What a check finds, a line of the report each: a question, a figure, a verdict.

use serde::{Deserialize, Serialize};

/// The kind of what is not finite.
pub const NOT_FINITE: &str = "NaN";

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    #[serde(rename = "right")]
    Right,
    #[serde(rename = "wrong")]
    Wrong,
    /// The law ended the process, or did not return.
    #[serde(rename = "ended")]
    Ended,
    #[serde(rename = "warning")]
    Warning,
    #[serde(rename = "not sure")]
    NotSure,
    #[serde(rename = "not reported")]
    NotReported,
    #[serde(rename = "not asked")]
    NotAsked,
}

impl Verdict {
    /// Whether it fails the check.
    pub fn fails(self) -> bool {
        matches!(self, Verdict::Wrong | Verdict::Ended)
    }

    pub fn name(self) -> &'static str {
        match self {
            Verdict::Right => "right",
            Verdict::Wrong => "wrong",
            Verdict::Ended => "ended",
            Verdict::Warning => "warning",
            Verdict::NotSure => "not sure",
            Verdict::NotReported => "not reported",
            Verdict::NotAsked => "not asked",
        }
    }
}

/// One answer.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Finding {
    /// The question's name.
    #[serde(rename = "line")]
    pub check: String,
    pub verdict: Verdict,
    /// What was measured, a relative error for most.
    pub figure: Option<f64>,
    /// In words.
    pub text: String,
    /// In what way it is wrong; several where they cannot be told apart.
    pub kinds: Vec<String>,
    /// The file of a call that ended the process, or that is the worst of few, for `--again`.
    pub call: Option<String>,
    /// That call as the child says it, as bits: the parent writes the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub call_bits: Option<Vec<u64>>,
    /// A picture, in lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub map: Vec<String>,
    /// Whether an earlier report, the baseline, has it too.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub known: bool,
    /// The baseline's figure, where it has the line and the figure has grown beyond what that one excuses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub known_figure: Option<f64>,
}

impl Finding {
    pub fn new(question: Question, verdict: Verdict, figure: Option<f64>, text: impl Into<String>) -> Self {
        // JSON has no number that is not finite.
        let figure = figure.filter(|figure| figure.is_finite());
        Finding {
            check: question.name().to_string(),
            verdict,
            figure,
            text: text.into(),
            kinds: Vec::new(),
            call: None,
            call_bits: None,
            map: Vec::new(),
            known: false,
            known_figure: None,
        }
    }

    /// Whether it fails the check: what is wrong, and of a strict one warnings and lines that never ran; nothing that
    /// is known.
    pub fn fails(&self, strict: bool) -> bool {
        let doubtful = self.verdict == Verdict::Warning
            || (self.verdict == Verdict::NotSure && self.check == Question::Coverage.name());
        !self.known && (self.verdict.fails() || (strict && doubtful))
    }

    /// The line of this source that the text names first: `umat.f:17`.
    pub fn source_line(&self, file: &str) -> Option<usize> {
        let name = std::path::Path::new(file).file_name()?.to_string_lossy();
        let (_, rest) = self.text.split_once(&format!("{name}:"))?;
        let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
        digits.parse().ok()
    }

    pub fn with(mut self, kind: &str) -> Self {
        if !self.kinds.iter().any(|known| known == kind) {
            self.kinds.push(kind.to_string());
        }
        self
    }
}

/// What is asked; [`Question::ASKED`] and [`Question::OF_VUMAT`] have the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Question {
    Build,
    /// Of an input of Abaqus.
    Deck,
    Memory,
    Rest,
    Stress,
    Properties,
    Place,
    Tangent,
    Objectivity,
    Isotropy,
    Thermal,
    Steps,
    Jumps,
    Job,
    Energy,
    Cycles,
    Dissipation,
    Repeat,
    Threads,
    Outputs,
    Exceptions,
    Invalid,
    Histories,
    Runtime,
    Coverage,
    Expect,
    /// Those of a VUMAT alone.
    DataCheck,
    Blocks,
    Single,
    Deletion,
}

impl Question {
    /// Those that a law answers in a child process.
    pub const ASKED: &[Question] = &[
        Question::Memory,
        Question::Rest,
        Question::Stress,
        Question::Properties,
        Question::Place,
        Question::Expect,
        Question::Tangent,
        Question::Objectivity,
        Question::Isotropy,
        Question::Thermal,
        Question::Steps,
        Question::Jumps,
        Question::Job,
        Question::Energy,
        Question::Cycles,
        Question::Dissipation,
        Question::Repeat,
        Question::Threads,
        Question::Outputs,
        Question::Exceptions,
        Question::Invalid,
        Question::Histories,
        Question::Runtime,
        Question::Coverage,
    ];

    /// Those that a VUMAT answers.
    pub const OF_VUMAT: &[Question] = &[
        Question::Memory,
        Question::Rest,
        Question::Stress,
        Question::Place,
        Question::DataCheck,
        Question::Objectivity,
        Question::Isotropy,
        Question::Steps,
        Question::Energy,
        Question::Dissipation,
        Question::Deletion,
        Question::Blocks,
        Question::Single,
        Question::Repeat,
        Question::Threads,
        Question::Outputs,
        Question::Exceptions,
        Question::Invalid,
        Question::Histories,
        Question::Runtime,
        Question::Coverage,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Question::Build => "build",
            Question::Deck => "deck",
            Question::Memory => "memory",
            Question::Rest => "rest",
            Question::Stress => "stress",
            Question::Properties => "properties",
            Question::Place => "place",
            Question::Tangent => "tangent",
            Question::Objectivity => "objectivity",
            Question::Isotropy => "isotropy",
            Question::Steps => "steps",
            Question::Thermal => "thermal",
            Question::Jumps => "jumps",
            Question::Job => "job",
            Question::Energy => "energy",
            Question::Cycles => "cycles",
            Question::Dissipation => "dissipation",
            Question::Repeat => "repeat",
            Question::Threads => "threads",
            Question::Outputs => "outputs",
            Question::Exceptions => "exceptions",
            Question::Invalid => "invalid",
            Question::Histories => "histories",
            Question::Runtime => "runtime",
            Question::Coverage => "coverage",
            Question::Expect => "expect",
            Question::DataCheck => "datacheck",
            Question::Blocks => "blocks",
            Question::Single => "single",
            Question::Deletion => "deletion",
        }
    }

    /// Whether a law may end the process in it: it is called with what the user did not give.
    pub fn may_end(self) -> bool {
        matches!(self, Question::Coverage | Question::Properties | Question::Place)
    }

    /// Whether it is asked of a quick check.
    pub fn is_quick(self) -> bool {
        use Question::{DataCheck, Expect, Memory, Objectivity, Outputs, Repeat, Rest, Stress, Tangent};
        matches!(self, Memory | Rest | Stress | Expect | Tangent | Objectivity | Repeat | Outputs | DataCheck)
    }

    /// All that may be asked.
    pub fn all() -> impl Iterator<Item = Question> {
        let of_vumat = Question::OF_VUMAT.iter().filter(|question| !Question::ASKED.contains(question));
        Question::ASKED.iter().chain(of_vumat).copied()
    }

    /// All that the report may have: the build and the deck's numbers are nobody's answers.
    fn lines() -> impl Iterator<Item = Question> {
        [Question::Build, Question::Deck].into_iter().chain(Question::all())
    }

    /// Of all lines, with commas.
    pub fn names() -> String {
        Question::lines().map(Question::name).collect::<Vec<_>>().join(", ")
    }

    pub fn parse(name: &str) -> Option<Question> {
        Question::lines().find(|question| question.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_a_report_is_allowed_and_listed() {
        assert!(Question::names().starts_with("build, deck, memory"), "{}", Question::names());
        for name in Question::names().split(", ") {
            assert_eq!(Question::parse(name).map(Question::name), Some(name));
        }
        assert_eq!(Question::parse("bild"), None);
    }
}
