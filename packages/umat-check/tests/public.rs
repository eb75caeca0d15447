//! `umat-check` on public sources (`ffi-tests/check/public.toml`), which a folder of checkouts has: what is wrong in
//! each is what was judged by hand.

mod support;

use std::path::Path;

use serde::Deserialize;
use support::{check, parse};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sources {
    source: Vec<Source>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Source {
    repository: String,
    /// The one that was judged.
    commit: String,
    file: String,
    inp: Option<String>,
    /// The input file, as text.
    scene: Option<String>,
    #[serde(default)]
    arguments: Vec<String>,
    wrong: Vec<String>,
    why: String,
}

impl Source {
    /// Whether it is there, and what is found otherwise than judged.
    fn difference(&self, number: usize, checkouts: &Path) -> Option<String> {
        let repository = checkouts.join(&self.repository);
        let law = repository.join(&self.file);
        if !law.is_file() {
            return None;
        }
        let mut arguments = self.arguments.clone();
        arguments.extend(self.inp.iter().map(|inp| format!("--inp={}", repository.join(inp).display())));
        if let Some(scene) = &self.scene {
            let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("public-{number}.toml"));
            std::fs::write(&path, scene).expect("a scene");
            arguments.push(format!("--scene={}", path.display()));
        }
        let (_, report) = check(&law, &arguments);
        let lines =
            report["materials"].as_array().into_iter().flatten().flat_map(|material| material["lines"].as_array());
        let fails = |verdict: &serde_json::Value| verdict == "wrong" || verdict == "ended";
        let wrong = lines.flatten().filter(|line| fails(&line["verdict"]));
        let wrong: Vec<&str> = wrong.filter_map(|line| line["line"].as_str()).collect();
        let same = wrong == self.wrong;
        let of = format!("{} {} of {}", self.file, self.arguments.join(" "), &self.commit[..8]);
        println!("{}: {wrong:?} ({})", of, self.why);
        Some(if same { String::new() } else { format!("{of}: {wrong:?} instead of {:?}\n", self.wrong) })
    }
}

#[test]
#[ignore = "needs checkouts of the repositories, and minutes"]
fn public_sources_are_told_as_they_were_judged() {
    let checkouts = std::env::var_os("UMAT_CHECKOUTS").expect("UMAT_CHECKOUTS is a folder of checkouts, OWNER/NAME");
    let Sources { source: sources } = parse("public.toml");
    let all = sources.iter().enumerate();
    let found: Vec<String> =
        all.filter_map(|(number, source)| source.difference(number, Path::new(&checkouts))).collect();
    assert!(!found.is_empty(), "none of the sources is there");
    assert!(found.iter().all(String::is_empty), "\n{}", found.concat());
    println!("{} of {} sources", found.len(), sources.len());
}
