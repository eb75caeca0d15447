//! What a run is judged by, in both scenes: what is wrong with it, and what to change.
//! `docs/reference/fabric-files.md` has the thresholds.

use toron::host::units::UnitSystem;
use toron_materials::material::fibre_wave::FibreWave;
use toron_materials::material::model::Material;
use toron_shared::text_table::{folded, grouped};

/// Steps from one measurement to the next, whatever the history is asked for: what is said of a run, and whether it
/// goes on, must not depend on that. The fastest vibration has at least π steps a period; what is looked for lasts
/// longer.
pub const MEASURED_EVERY: u64 = 16;
/// The largest part of the internal energy that hourglass modes may hold.
const LARGEST_HOURGLASS: f64 = 0.1;
/// A contact that stores more than this part of the energy is a spring between what strikes and what is struck.
const LARGEST_CONTACT: f64 = 0.05;
/// The total energy may move by this part of itself; a run in which it moves by five times that ends with an error.
const LARGEST_IMBALANCE: f64 = 0.01;
/// Columns for the names of the cases that a warning is of.
const WIDTH: usize = 98;

/// Of the energy that the blow has given away, artificial viscosity may take this part of a panel's, and of what whips
/// about behind a failure.
pub const LARGEST_VISCOSITY: f64 = 0.1;

/// The verdict of a run with which nothing is wrong.
pub const SOUND: &str = "sound";
/// The verdict of a run that somebody has ended before its time.
pub const INTERRUPTED: &str = "interrupted: go on with --restart";
/// Between what a verdict says of the run up to the first failure and what it says of the rest.
const THEN: &str = " to failure; then ";

/// Something that is wrong with a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// A word for tables.
    pub name: &'static str,
    /// What it is, by which bound, and what to change; lines after the first are indented.
    pub text: String,
    /// Whether it was found in what followed the first failure.
    pub after_failure: bool,
}

impl Finding {
    pub fn new(name: &'static str, text: String) -> Finding {
        Finding { name, text: text.replace('\n', "\n  "), after_failure: false }
    }
}

/// Adds what was found in the run after it had failed, `failed` says how and when; a word that stands there already is
/// not said twice.
pub fn add_after_failure(findings: &mut Vec<Finding>, failed: &str, found: impl IntoIterator<Item = Finding>) {
    for finding in found {
        if !findings.iter().any(|known| known.name == finding.name) {
            let text = format!("after {failed}: {}", finding.text);
            findings.push(Finding { text, after_failure: true, ..finding });
        }
    }
}

/// That a run was interrupted, which is no more judged then: what is measured of it is not what it comes to.
pub fn interrupted() -> Finding {
    Finding::new(INTERRUPTED, "it was interrupted, and is judged when it has ended: go on with --restart".to_string())
}

/// That a run could not go on, where it could not: nothing is known of what would have followed.
pub fn error(failure: Option<&str>) -> Option<Finding> {
    failure.map(|failure| Finding::new("error", format!("it ended with an error before its time:\n{failure}")))
}

/// The words of all findings, each once: those of the run up to the first failure, and those of what followed. One that
/// was interrupted has no verdict but that.
pub fn verdict(findings: &[Finding]) -> String {
    if findings.iter().any(|finding| finding.name == INTERRUPTED) {
        return INTERRUPTED.to_string();
    }
    let names = |after: bool| {
        let mut names: Vec<&str> = Vec::new();
        for finding in findings.iter().filter(|finding| finding.after_failure == after) {
            if !names.contains(&finding.name) {
                names.push(finding.name);
            }
        }
        names.join("; ")
    };
    let [before, after] = [false, true].map(names);
    let before = if before.is_empty() { SOUND } else { &before };
    if after.is_empty() { before.to_string() } else { format!("{before}{THEN}{after}") }
}

/// The two parts of a [`verdict`]; none of what followed a failure where there was none, or nothing is wrong with it.
pub fn parts_of_verdict(verdict: &str) -> (&str, Option<&str>) {
    verdict.split_once(THEN).map_or((verdict, None), |(before, after)| (before, Some(after)))
}

/// Warnings of what was found in each case; what is wrong with several in the same way stands there once.
pub fn warnings<'a>(findings: impl IntoIterator<Item = (&'a str, &'a [Finding])>) -> String {
    let named = findings.into_iter().flat_map(|(case, findings)| findings.iter().map(move |f| (case, f.text.as_str())));
    let warning = |(text, cases): (&str, Vec<&str>)| match &cases[..] {
        [case] => format!("warning: case {case}: {text}\n"),
        cases => format!("{}:\n  {text}\n", folded(&format!("warning: cases {}", cases.join(", ")), WIDTH)),
    };
    grouped(named).into_iter().map(warning).collect()
}

/// Where hourglass modes hold too large a part of the largest internal energy; `remedy` says what to take instead.
pub fn hourglass(share: f64, remedy: &str) -> Option<Finding> {
    let exceeds = share.is_nan() || share > LARGEST_HOURGLASS;
    exceeds.then(|| {
        let [share, most] = [share, LARGEST_HOURGLASS].map(|share| 100.0 * share);
        let text = format!(
            "hourglass energy is {share:.1} % of the largest internal energy, more than {most:.0} %:\ntake {remedy}"
        );
        Finding::new("hourglass", text)
    })
}

/// Elements that are deleted while all yarns are whole; `remedy` says what to take instead.
pub fn collapsed(elements: usize, remedy: &str) -> Option<Finding> {
    (elements > 0).then(|| {
        let text = format!("{elements} elements have collapsed before any failed:\ntake {remedy}");
        Finding::new("collapsed", text)
    })
}

/// Where the contact stores too large a part of the energy.
pub fn contact(share: f64, stiffness: f64) -> Option<Finding> {
    let exceeds = share.is_nan() || share > LARGEST_CONTACT;
    exceeds.then(|| {
        let [share, most] = [share, LARGEST_CONTACT].map(|share| 100.0 * share);
        let text = format!(
            "the contact stored {share:.1} % of the energy, more than {most:.0} %:\n\
             take a larger contact-stiffness than {stiffness:e}"
        );
        Finding::new("contact", text)
    })
}

/// Where artificial viscosity has taken a larger part than `most` of the energy that the blow has given away.
pub fn viscosity(share: f64, most: f64, remedy: &str) -> Option<Finding> {
    let exceeds = share.is_nan() || share > most;
    exceeds.then(|| {
        let [share, most] = [share, most].map(|share| 100.0 * share);
        let text = format!(
            "artificial viscosity took {share:.0} % of the energy that the blow gave away, more than {most:.0} %:\ntake {remedy}"
        );
        Finding::new("viscosity", text)
    })
}

/// Where the total energy has moved too far.
pub fn balance(imbalance: f64) -> Option<Finding> {
    let exceeds = imbalance.is_nan() || imbalance > LARGEST_IMBALANCE;
    exceeds.then(|| {
        let [off, most] = [imbalance, LARGEST_IMBALANCE].map(|part| 100.0 * part);
        let text = format!(
            "the total energy is {off:.1} % from what it was, more than {most:.0} %:\n\
             take a finer mesh, or look in the history for what jumps with it: elements deleted, contact"
        );
        Finding::new("balance", text)
    })
}

/// Materials in which the wave along the fibre has a speed that no fibre has.
pub fn units(materials: &[Material], units: &UnitSystem) -> Vec<Finding> {
    let finding = |material: &Material| {
        let warning = FibreWave::of(material, units)?.unit_warning(units)?;
        Some(Finding::new("units", format!("{}: {warning}", material.name())))
    };
    materials.iter().filter_map(finding).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_that_cases_share_is_said_once() {
        let [one, other] = ["one\nand more", "other"].map(|text| Finding::new("word", text.to_string()));
        let (both, single) = ([one, other.clone()], [other]);
        let text = warnings([("a", &both[..]), ("b", &single), ("c", &[])]);
        assert_eq!(text, "warning: case a: one\n  and more\nwarning: cases a, b:\n  other\n");
        assert_eq!((verdict(&both).as_str(), verdict(&[]).as_str()), ("word", "sound"));
    }

    #[test]
    fn a_verdict_says_up_to_where_it_holds() {
        let words = |words: &[&'static str]| -> Vec<Finding> {
            words.iter().map(|name| Finding::new(name, name.to_string())).collect()
        };
        for (before, after, text, parts) in [
            (
                &[][..],
                &["viscosity", "jacobian"][..],
                "sound to failure; then viscosity; jacobian",
                ("sound", Some("viscosity; jacobian")),
            ),
            (&["mesh"], &["viscosity", "mesh"], "mesh to failure; then viscosity", ("mesh", Some("viscosity"))),
            (&["mesh"], &["mesh"], "mesh", ("mesh", None)),
            (&[], &[], "sound", ("sound", None)),
            (&["units", INTERRUPTED], &[], INTERRUPTED, (INTERRUPTED, None)),
        ] {
            let mut findings = words(before);
            add_after_failure(&mut findings, "the break", words(after));
            assert_eq!((verdict(&findings).as_str(), parts_of_verdict(text)), (text, parts));
            let said = findings.iter().filter(|finding| finding.text.starts_with("after the break: "));
            assert_eq!(said.count(), parts.1.map_or(0, |after| after.split("; ").count()));
        }
    }

    #[test]
    fn bounds_and_what_is_no_number_are_found() {
        let found = |of: fn(f64) -> Option<Finding>, most: f64| {
            [0.99 * most, 1.01 * most, f64::NAN].map(|value| of(value).is_some())
        };
        assert_eq!(found(|share| hourglass(share, "less"), 0.1), [false, true, true]);
        assert_eq!(found(|share| contact(share, 1.0), 0.05), [false, true, true]);
        assert_eq!([0, 1].map(|elements| collapsed(elements, "less").is_some()), [false, true]);
        assert_eq!(found(balance, 0.01), [false, true, true]);
        assert_eq!(found(|share| viscosity(share, LARGEST_VISCOSITY, "less"), 0.1), [false, true, true]);
    }
}
