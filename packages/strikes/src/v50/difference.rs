//! By which key the scene of shots that stand in a table is another one than that of a run.

use std::collections::BTreeMap;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use toron_shared::toml_error::shortened;

/// Keys of a scene on which no shot's outcome depends.
pub const MAY_DIFFER: [&str; 8] =
    ["number", "extension", "tolerance", "spread", "sample", "pictures", "frames", "checkpoints"];
const TITLE: &str = "title";

/// The first key that differs, with the values of this scene and of that; none where no key does, but what a file says
/// that they name.
pub fn first(this: &str, that: &str) -> Option<String> {
    let [this, that] = [keys(this)?, keys(that)?];
    let names: BTreeMap<&String, ()> = this.keys().chain(that.keys()).map(|name| (name, ())).collect();
    let may_differ = |name: &str| {
        let key = name.rsplit('.').next().unwrap_or(name);
        name == TITLE || MAY_DIFFER.contains(&key)
    };
    let mut names = names.into_keys().filter(|name| !may_differ(name));
    names.find_map(|name| match (this.get(name), that.get(name)) {
        (Some(own), Some(other)) if is_same(own, other) => None,
        (own, other) => {
            let [own, other] =
                [own, other].map(|value| value.map_or("not given".to_string(), |value| shortened(value)));
            Some(format!("{name} is {own}, and {other} there"))
        }
    })
}

/// Numbers that are written otherwise are the same.
fn is_same(one: &str, other: &str) -> bool {
    let number = |text: &str| text.parse::<f64>().ok();
    one == other || number(one).is_some_and(|value| Some(value) == number(other))
}

/// The values of a file as they are written, by the paths of their keys.
fn keys(text: &str) -> Option<BTreeMap<String, String>> {
    let mut keys = BTreeMap::new();
    add_table(text, "", DeTable::parse(text).ok()?.get_ref(), &mut keys);
    Some(keys)
}

fn add_table(text: &str, path: &str, table: &DeTable, keys: &mut BTreeMap<String, String>) {
    for (key, value) in table {
        let key = key.get_ref();
        let path = if path.is_empty() { key.to_string() } else { format!("{path}.{key}") };
        add(text, path, value, keys);
    }
}

fn add(text: &str, path: String, value: &Spanned<DeValue>, keys: &mut BTreeMap<String, String>) {
    match value.get_ref() {
        DeValue::Table(table) => add_table(text, &path, table, keys),
        DeValue::Array(entries) if entries.iter().any(|entry| entry.get_ref().is_table()) => {
            for (place, entry) in entries.iter().enumerate() {
                add(text, format!("{path}[{}]", place + 1), entry, keys);
            }
        }
        _ => {
            keys.insert(path, text.get(value.span()).unwrap_or_default().to_string());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_key_that_matters_is_named() {
        let scene = "title = \"one\"\n[scene]\nmass = 0.01\nend = 0.2\nyarn.height = 0.1 # mm\n[[case]]\nname = \"a\"\n[shots]\nnumber = 6\n";
        let of = |from: &str, to: &str| first(scene, &scene.replace(from, to));
        for (from, to) in [
            ("number = 6", "number = 9"),
            ("one", "two"),
            ("0.01", "10e-3"),
            ("# mm", "# of the yarn"),
            ("mass = 0.01\nend = 0.2", "end = 0.2\nmass = 0.01"),
        ] {
            assert_eq!(of(from, to), None, "{to}");
        }
        for (from, to, message) in [
            ("0.01", "0.02", "scene.mass is 0.01, and 0.02 there"),
            ("0.1 #", "0.3 #", "scene.yarn.height is 0.1, and 0.3 there"),
            ("\"a\"", "\"b\"", "case[1].name is \"a\", and \"b\" there"),
            ("number = 6", "seed = 2", "shots.seed is not given, and 2 there"),
        ] {
            assert_eq!(of(from, to).as_deref(), Some(message));
        }
    }
}
