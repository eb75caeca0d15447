//! Checkpoints: each build has its own, so that short runs write them before they are changed.

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use toron_explicit_host::struck::command::Scene;
use toron_explicit_host::struck::run::{Observer, Struck, run};
use toron_explicit_host::struck::sample::Sample;
use toron_shared::error::Error;
use toron_strikes::{fabric, impact};
use toron_test_support::library::folder;

/// How the names of checkpoints end.
pub const ENDING: &str = ".checkpoint";

/// Steps of the run that writes one.
const STEPS: u32 = 40;

const YARN: &str = r#"
title = "A yarn struck by a cylinder"
units = "mm-g-ms"
[scene]
failure = "multiaxial"
half-length = 12.7
height = 0.115
width = 0.5337
layers = 10
rows = 1
columns = 2
mass = 9.91e-3
radius = 1.1
friction = 0.18
contact-stiffness = 1e6
speed = 120.0
end = 0.06
pictures = [0.01]
[[case]]
name = "yarn"
"#;

const PANEL: &str = r#"
title = "A panel struck by a sphere"
units = "mm-g-ms"
[weave]
pattern = "plain"
along = 4
columns = 4
[weave.warp]
pitch = 1.18
section = "ellipse"
width = 0.95
height = 0.128
[weave.panel]
shape = "circle"
radius = 3.0
part = "quarter"
[scene]
speed = 25.0
mass = 0.692
radius = 2.778
contact-stiffness = 1e5
failure = "multiaxial"
end = 0.05
pictures = [0.02]
[[case]]
name = "panel"
"#;

fn place(name: &str, text: &str) -> PathBuf {
    let place = folder("fuzzed-checkpoints").join(name);
    fs::write(&place, text).expect("a scene");
    place
}

static IMPACT: LazyLock<impact::scene::Scene> =
    LazyLock::new(|| impact::scene::Scene::read(&place("yarn.toml", YARN)).expect("a scene"));
static FABRIC: LazyLock<fabric::scene::Scene> =
    LazyLock::new(|| fabric::scene::Scene::read(&place("panel.toml", PANEL)).expect("a scene"));

/// Ends a run after some steps with its checkpoint, and one that goes on where it has read one.
#[derive(Default)]
struct Ends {
    steps: Cell<u32>,
    checkpoint: Vec<u8>,
    resumed: bool,
}

impl<E> Observer<E> for Ends {
    fn checkpoint(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.checkpoint = bytes.to_vec();
        Ok(())
    }

    fn resumed(&mut self, _: f64, _: &[Sample<E>], _: &[f64]) -> Result<(), Error> {
        self.resumed = true;
        Err(Error::Input(String::new()))
    }

    fn interrupts(&self) -> bool {
        self.steps.set(self.steps.get() + 1);
        self.steps.get() > STEPS
    }
}

/// A checkpoint of the first case of a scene.
fn write<S: Scene>(scene: &S, name: &str) -> PathBuf {
    let (case, mut ends) = (scene.case(0).expect("a case"), Ends::default());
    run(&case, None, &mut ends).expect("a run");
    assert!(!ends.checkpoint.is_empty(), "{name}: no checkpoint");
    let file = folder("fuzzed-checkpoints").join(name).with_extension(ENDING.trim_start_matches('.'));
    fs::write(&file, ends.checkpoint).expect("a checkpoint");
    file
}

static FILES: LazyLock<[PathBuf; 2]> = LazyLock::new(|| [write(&*IMPACT, "yarn"), write(&*FABRIC, "panel")]);

/// A checkpoint of each of the two scenes: what is of the other one is to be refused.
pub fn files() -> Vec<PathBuf> {
    FILES.to_vec()
}

/// Reads a checkpoint for a scene, up to where the run goes on. A refusal names the case, which is that of the file.
fn read<S: Scene>(scene: &S, path: &Path) -> Result<(), Error> {
    let (case, mut ends) = (scene.case(0)?, Ends::default());
    let bytes = fs::read(path).unwrap_or_default();
    match run(&case, Some(&bytes), &mut ends) {
        Err(error) if !ends.resumed => {
            let message = error.to_string();
            let is_named = message.contains("checkpoint") && message.contains(&format!("case {}", case.name()));
            Err(if is_named { Error::Input(format!("{}: {message}", path.display())) } else { error })
        }
        _ => Ok(()),
    }
}

pub fn read_impact(path: &Path) -> Result<(), Error> {
    read(&*IMPACT, path)
}

pub fn read_fabric(path: &Path) -> Result<(), Error> {
    read(&*FABRIC, path)
}

/// A checkpoint of another build or scene, with a sum that is right. What is behind is
/// believed by its sum, and not changed here.
pub fn of_another(bytes: &[u8], change: impl FnOnce(&[u8]) -> Vec<u8>) -> Vec<u8> {
    /// Within the words that a checkpoint begins with.
    const IDENTITY: usize = 64;
    let (identity, rest) = bytes[..bytes.len() - 4].split_at(IDENTITY);
    let mut bytes = [&change(identity), rest].concat();
    bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
    bytes
}
