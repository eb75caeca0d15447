//! What a misspelt name was most likely meant to be.

/// Names that are less alike are no misspelling (Jaro and Winkler's measure, which is 1 of the same name).
const ALIKE: f64 = 0.85;

/// The known name that is most like this one, if one is alike.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let alike = known.into_iter().map(|known| (strsim::jaro_winkler(name, known), known));
    let best = alike.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(likeness, _)| *likeness >= ALIKE);
    best.map(|(_, known)| known)
}

/// `, did you mean NAME?`, or nothing where no known name is alike.
pub fn hint<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, known).map_or(String::new(), |known| format!(", did you mean {known}?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelling_is_told_from_another_word() {
        let known = ["speed", "radius", "contact-stiffness", "half-length", "k_el", "k_tc", "k_td", "eps_lim"];
        for (name, meant) in [
            ("sped", Some("speed")),
            ("radus", Some("radius")),
            ("contact_stiffness", Some("contact-stiffness")),
            ("halflength", Some("half-length")),
            ("kel", Some("k_el")),
            ("eps", Some("eps_lim")),
            ("colour", None),
            ("x", None),
            ("", None),
        ] {
            assert_eq!(nearest(name, known), meant, "{name}");
        }
        assert_eq!(hint("sped", known), ", did you mean speed?");
    }
}
