//! Findings that follow from others.

use super::finding::{Finding, NOT_FINITE, Question, Verdict};

/// Findings that follow from others: one cause is reported once.
pub fn relate(findings: &mut [Finding]) {
    not_finite_once(findings);
    stress_before_tangent(findings);
    build_before_tangent(findings);
    crash_of_unset_variable(findings);
}

/// Where the stress itself is wrong, the tangent's kind may follow from it.
fn stress_before_tangent(findings: &mut [Finding]) {
    let is_wrong = |question: Question| {
        findings.iter().any(|finding| finding.check == question.name() && finding.verdict == Verdict::Wrong)
    };
    let of_stress = [Question::Objectivity, Question::Isotropy].into_iter().find(|&question| is_wrong(question));
    let Some(of_stress) = of_stress.map(Question::name) else { return };
    for finding in findings.iter_mut().filter(|finding| finding.check == Question::Tangent.name()) {
        if finding.verdict == Verdict::Wrong && !finding.kinds.is_empty() {
            let kind = finding.text.strip_prefix("none of the usual mistakes; ");
            let text = kind.map_or_else(|| format!("perhaps {}", finding.text), str::to_string);
            finding.text = format!("the stress itself is wrong (see {of_stress}): mend it first; {text}");
        }
    }
}

/// A tangent that no usual mistake explains may follow from what the compiler warns of.
fn build_before_tangent(findings: &mut [Finding]) {
    let of = |question: Question| move |finding: &&Finding| finding.check == question.name();
    let Some(build) = findings.iter().find(of(Question::Build)).filter(|build| !build.kinds.is_empty()).cloned() else {
        return;
    };
    for finding in findings.iter_mut().filter(|finding| finding.check == Question::Tangent.name()) {
        if finding.verdict == Verdict::Wrong && finding.kinds.first().is_some_and(|kind| kind == "unknown") {
            finding.text = format!("perhaps what build says ({}); {}", build.kinds.join(", "), finding.text);
            finding.kinds.extend(build.kinds.iter().cloned());
        }
    }
}

/// What is not finite in one line is so in others.
fn not_finite_once(findings: &mut [Finding]) {
    let mut first: Option<String> = None;
    for finding in findings.iter_mut() {
        if finding.verdict != Verdict::Wrong || !finding.kinds.iter().any(|kind| kind == NOT_FINITE) {
            continue;
        }
        match &first {
            Some(first) => {
                finding.verdict = Verdict::NotSure;
                finding.text = format!("not finite, as in {first}");
            }
            None => first = Some(finding.check.clone()),
        }
    }
}

/// A crash where the build with checks has found the cause.
fn crash_of_unset_variable(findings: &mut [Finding]) {
    let runtime = Question::Runtime.name();
    if !findings.iter().any(|finding| finding.check == runtime && finding.verdict == Verdict::Wrong) {
        return;
    }
    for finding in findings.iter_mut() {
        if finding.verdict.fails() && finding.kinds.iter().any(|kind| kind == "crash") {
            finding.verdict = Verdict::NotSure;
            finding.text.push_str("; see runtime");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_stress_comes_before_the_tangent() {
        let tangent = Finding::new(Question::Tangent, Verdict::Wrong, None, "symmetrised").with("symmetrised");
        let mut alone = [tangent.clone(), Finding::new(Question::Objectivity, Verdict::Right, None, "")];
        relate(&mut alone);
        assert_eq!(alone[0].text, "symmetrised");
        let mut both = [tangent, Finding::new(Question::Objectivity, Verdict::Wrong, None, "")];
        relate(&mut both);
        assert!(both[0].text.starts_with("the stress itself is wrong (see objectivity)"));
        // What is not sure of objectivity says nothing of the tangent.
        let not_finite = |question| Finding::new(question, Verdict::Wrong, None, "").with(NOT_FINITE);
        let mut both = [not_finite(Question::Rest), not_finite(Question::Tangent)];
        relate(&mut both);
        assert_eq!([both[0].verdict, both[1].verdict], [Verdict::Wrong, Verdict::NotSure]);
        assert_eq!(both[1].text, "not finite, as in rest");
    }

    #[test]
    fn a_tangent_does_not_follow_from_what_is_not_sure() {
        let tangent = Finding::new(Question::Tangent, Verdict::Wrong, None, "scale").with("scale");
        let not_finite = |question| Finding::new(question, Verdict::Wrong, None, "").with(NOT_FINITE);
        let mut all = [not_finite(Question::Rest), not_finite(Question::Objectivity), tangent];
        relate(&mut all);
        assert_eq!((all[1].verdict, all[2].text.as_str()), (Verdict::NotSure, "scale"));
    }
}
