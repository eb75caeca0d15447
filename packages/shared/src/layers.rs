//! Tables of a TOML file in layers: one laid over another as data, in which every value keeps its place in the file.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// What a key of a table's own drops of the table beneath.
#[derive(Clone, Copy)]
pub struct Drops {
    /// The names of the tables that have this key.
    pub tables: &'static [&'static str],
    pub key: &'static str,
    /// The value with which it does; none stands for any.
    pub value: Option<&'static str>,
    /// The keys that go; none stands for all.
    pub keys: &'static [&'static str],
}

impl Drops {
    /// Whether this key goes beneath a table of this name.
    fn takes(&self, name: &str, own: &DeTable, key: &str) -> bool {
        let does = |value: &Spanned<DeValue>| self.value.is_none_or(|wanted| value.get_ref().as_str() == Some(wanted));
        let applies = self.tables.contains(&name) && own.get(self.key).is_some_and(does);
        applies && (self.keys.is_empty() || self.keys.contains(&key))
    }
}

/// The tables of this name in one, the uppermost first: what a table does not have is that of the next one beneath,
/// but for what its own keys drop. Its place is the uppermost one's.
pub fn layered<'a, 't: 'a>(
    name: &str,
    tables: impl IntoIterator<Item = Option<&'a Spanned<DeValue<'t>>>>,
    drops: &[Drops],
) -> Option<Spanned<DeValue<'t>>> {
    tables.into_iter().flatten().cloned().reduce(|mut upper, lower| {
        lay(name, upper.get_mut(), lower.get_ref(), drops);
        upper
    })
}

/// Lays a table over a lower one. Of two values that are not both tables the upper one stays.
fn lay<'t>(name: &str, upper: &mut DeValue<'t>, lower: &DeValue<'t>, drops: &[Drops]) {
    let (DeValue::Table(upper), DeValue::Table(lower)) = (upper, lower) else { return };
    let dropped = |key: &str| drops.iter().any(|drops| drops.takes(name, upper, key));
    let kept: Vec<_> = lower.iter().filter(|(key, _)| !dropped(key.get_ref())).collect();
    for (key, beneath) in kept {
        match upper.get_mut(&**key.get_ref()) {
            Some(own) => lay(key.get_ref(), own.get_mut(), beneath.get_ref(), drops),
            None => {
                upper.insert(key.clone(), beneath.clone());
            }
        }
    }
}

/// The entries of a list; none where there is no list.
pub fn entries<'a, 't>(list: Option<&'a Spanned<DeValue<'t>>>) -> &'a [Spanned<DeValue<'t>>] {
    list.and_then(|list| list.get_ref().as_array()).map_or(&[], |list| list)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toml_file::Source;

    const DROPS: [Drops; 2] = [
        Drops { tables: &["material"], key: "preset", value: None, keys: &[] },
        Drops { tables: &["panel"], key: "shape", value: Some("circle"), keys: &["half"] },
    ];

    /// The keys of `[own]` over `[base]`, each with the line that it stands in.
    fn lines(text: &str) -> Vec<String> {
        let source = Source { name: "both.toml", text };
        let tables = source.tables().expect("tables");
        let both = layered("case", ["own", "base"].map(|table| tables.get_ref().get(table)), &DROPS).expect("a table");
        assert_eq!(both.span(), tables.get_ref()["own"].span());
        let mut lines = Vec::new();
        add(&source, "", &both, &mut lines);
        lines
    }

    fn add(source: &Source, path: &str, value: &Spanned<DeValue>, lines: &mut Vec<String>) {
        match value.get_ref() {
            DeValue::Table(table) => {
                table.iter().for_each(|(key, value)| add(source, &format!("{path}.{}", key.get_ref()), value, lines));
            }
            _ => lines.push(format!("{path}:{}", source.line(value.span()))),
        }
    }

    #[test]
    fn values_keep_their_lines_and_keys_drop_what_does_not_go_with_them() {
        let base = "[base]\nspeed = 1\nend = 2\nmaterial = { preset = \"a\", properties.k = 1, properties.l = 2 }\n\
                    panel = { shape = \"rectangle\", half = 3, part = 4 }\n[own]\nspeed = 7\n";
        let of_base = [".material.preset:4", ".material.properties.k:4", ".material.properties.l:4"];
        let of_panel = [".panel.half:5", ".panel.part:5", ".panel.shape:5", ".speed:7"];
        let expected = |parts: &[&[&'static str]]| [&[".end:3"], &parts.concat()[..]].concat();
        assert_eq!(lines(base), expected(&[&of_base, &of_panel]));
        // A key alone, in a table that the other has too.
        let one = [of_base[0], ".material.properties.k:8", of_base[2]];
        assert_eq!(lines(&format!("{base}material.properties.k = 9\n")), expected(&[&one, &of_panel]));
        let afresh = lines(&format!("{base}material.preset = \"a\"\n"));
        assert_eq!(afresh, expected(&[&[".material.preset:8"], &of_panel]));
        let circle = [".panel.part:5", ".panel.shape:8", ".speed:7"];
        assert_eq!(lines(&format!("{base}panel.shape = \"circle\"\n")), expected(&[&of_base, &circle]));
        let same = [of_panel[0], of_panel[1], ".panel.shape:8", ".speed:7"];
        assert_eq!(lines(&format!("{base}panel.shape = \"rectangle\"\n")), expected(&[&of_base, &same]));
        assert_eq!(lines(&format!("{base}material = 3\n"))[1], ".material:8");
    }
}
