//! How the files of cases are called: the one rule by which the cases of a scene, and the commands that write to one
//! directory, are kept apart.

/// What stands between a case's name and the number of a picture, by what is drawn.
pub const PANEL: &str = "-panel-";
pub const YARN: &str = "-yarn-";
pub const FIBRES: &str = "-fibres-";
/// Between a case's name and the number of a table of strains along the yarn; without the last letter, behind the name
/// of the plot of all of them.
pub const STRAINS: &str = "-strain-";
pub const STRAIN: &str = "-strain";
/// Behind a case's name, that of the table of what steps its elements have.
pub const STEPS: &str = "-steps";
const NUMBERED: [&str; 4] = [PANEL, YARN, FIBRES, STRAINS];
/// A case of `toron fibres` has a folder of its name beside the files of all cases.
const ENDINGS: [&str; 3] = [".csv", ".svg", ".png"];

/// Whether two names of cases, or of other files without their endings, would give files of one name. File systems that
/// take `A` for `a` count.
pub fn collide(one: &str, other: &str) -> bool {
    let [one, other] = [one, other].map(str::to_ascii_lowercase);
    let extends = |name: &str, by: &str| {
        name.strip_prefix(by).is_some_and(|rest| {
            let numbered = NUMBERED.iter().any(|between| number_behind(rest, between).is_some());
            numbered || rest == STRAIN || rest == STEPS || ENDINGS.contains(&rest)
        })
    };
    one == other || extends(&one, &other) || extends(&other, &one)
}

/// Whether a file of this name is of a case: a history, a plot, a picture, a table of strains, or a file for ParaView
/// whose number is `frames` or more. Checkpoints are not counted.
pub fn is_of(name: &str, case: &str, frames: usize) -> bool {
    let Some((stem, ending)) = name.strip_prefix(case).and_then(|rest| rest.rsplit_once('.')) else { return false };
    let picture = || [PANEL, YARN, FIBRES].iter().any(|between| number_behind(stem, between).is_some());
    match ending {
        "csv" => stem.is_empty() || stem == STEPS || number_behind(stem, STRAINS).is_some(),
        "pvd" => stem.is_empty() && frames == 0,
        "svg" | "png" => stem.is_empty() || stem == STRAIN || picture(),
        "vtu" => number_behind(stem, "-").is_some_and(|number| number >= frames),
        _ => false,
    }
}

/// The number of which a text consists behind this beginning.
fn number_behind(text: &str, beginning: &str) -> Option<usize> {
    let digits = text.strip_prefix(beginning)?;
    digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| digits.parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_files_of_a_case_are_told_from_others() {
        let of = |name: &str| is_of(name, "one", 2);
        for name in [
            "one.csv",
            "one-steps.csv",
            "one.svg",
            "one.png",
            "one-panel-3.png",
            "one-yarn-12.svg",
            "one-fibres-1.png",
            "one-strain-2.csv",
            "one-strain.svg",
            "one-0002.vtu",
        ] {
            assert!(of(name), "{name}");
        }
        for name in [
            "one.checkpoint",
            "one.toml",
            "one-0001.vtu",
            "one.pvd",
            "one-2.csv",
            "one-panel-x.png",
            "one-panel-.png",
            "one-more-0003.vtu",
            "two.csv",
            "one",
        ] {
            assert!(!of(name), "{name}");
        }
        assert!(is_of("one.pvd", "one", 0));
    }

    /// Whatever a command may write for one case, the other's history, plots and pictures are not called so.
    #[test]
    fn names_that_would_give_one_file_collide() {
        for (one, other) in [
            ("a", "a"),
            ("a", "A"),
            ("a", "a-strain-1"),
            ("a", "A-yarn-1"),
            ("a-panel-12", "a"),
            ("a", "a-fibres-3"),
            ("a", "a-strain"),
            ("a", "a.csv"),
        ] {
            assert!(collide(one, other) && collide(other, one), "{one} {other}");
        }
        for (one, other) in [("a", "b"), ("a", "a-1"), ("a", "a-yarn"), ("a", "a-yarn-1-more"), ("a", "a-0001")] {
            assert!(!collide(one, other), "{one} {other}");
        }
    }
}
