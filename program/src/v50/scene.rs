//! A scene whose shots are fired: one case of `toron fabric` or of `toron impact`, and its `[shots]`.

use std::path::Path;

use statrs::distribution::{ContinuousCDF, Normal};

use super::designs::Design;
use crate::common::chance::uniform;
use crate::common::error::Error;
use crate::common::toml_file::{self, Source};
use crate::impact::scene::Striker;
use crate::struck::shots::{AimName, DesignName, Shots};
use crate::weave::panel::Part;
use crate::{fabric, impact};
use toron::host::units::UnitSystem;

/// Tables that a scene of a panel has, one at least.
const OF_PANELS: [&str; 2] = ["weave", "mesh"];
/// The seeds of strengths are below this: a file in TOML and a table hold them as they are.
const SEEDS: f64 = 1e12;

/// The scene.
pub struct Scene {
    pub title: String,
    pub units: UnitSystem,
    pub shots: Shots,
    pub target: Target,
}

/// What is struck, and by what.
#[derive(Clone)]
pub enum Target {
    Panel(Box<fabric::scene::Case>),
    Yarn(Box<impact::scene::Case>),
}

/// What is different in each shot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// From 1.
    pub number: usize,
    /// The speed that it was to have, and has.
    pub aimed: f64,
    pub speed: f64,
    /// Where it meets the panel.
    pub aim: [f64; 2],
    /// Of the strength, where that scatters.
    pub seed: Option<u64>,
}

/// What a number of chance is for.
#[derive(Clone, Copy)]
enum Chance {
    Speed,
    AlongWarp,
    AlongWeft,
    Strength,
}

impl Scene {
    /// Reads the file; of several cases the one of this name.
    ///
    /// # Errors
    /// As for the readers of the two scenes; no `[shots]`; a case that cannot be shot at.
    pub fn read(path: &Path, case: Option<&str>) -> Result<Scene, Error> {
        let (name, text) = toml_file::read(path)?;
        Scene::parse(&name, &text, case)
    }

    /// The scene that `text` describes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn parse(name: &str, text: &str, case: Option<&str>) -> Result<Scene, Error> {
        let tables: toml::Table = Source { name, text }.parse()?;
        let wanted = "allowed: a table [shots] with number and speeds at least";
        let shots = |shots: Option<Shots>| {
            shots.ok_or_else(|| Error::Input(format!("{name}: no shots; {wanted} (see docs/guides/v50.md)")))
        };
        let scene = if OF_PANELS.iter().any(|table| tables.contains_key(*table)) {
            let scene = fabric::scene::Scene::parse(name, text)?;
            let case = one(name, scene.cases, case, |case| &case.name)?;
            let (title, units) = (scene.title, scene.units);
            Scene { title, units, shots: shots(scene.shots)?, target: Target::Panel(Box::new(case)) }
        } else {
            let scene = impact::scene::Scene::parse(name, text)?;
            let case = one(name, scene.cases, case, |case| &case.name)?;
            let (title, units) = (scene.title, scene.units);
            Scene { title, units, shots: shots(scene.shots)?, target: Target::Yarn(Box::new(case)) }
        };
        scene.check(name)?;
        Ok(scene)
    }

    fn check(&self, name: &str) -> Result<(), Error> {
        let in_cell = self.shots.aim == AimName::Cell;
        let refused = match &self.target {
            Target::Yarn(case) => match case.striker {
                Striker::Driven | Striker::Cylinder { held: true, .. } => {
                    "striker is driven, or held at its speed: nothing stops it; allowed: a cylinder that is free"
                }
                Striker::Cylinder { .. } if in_cell => "aim is \"cell\" of a yarn; allowed: fixed",
                Striker::Cylinder { .. } => return Ok(()),
            },
            Target::Panel(case) if in_cell && case.cloth.part() == Part::Quarter => {
                "aim is \"cell\" of a quarter, which is struck in the middle; allowed: fixed, or part = \"whole\""
            }
            Target::Panel(_) => return Ok(()),
        };
        Err(Error::Input(format!("{name}: {refused}")))
    }

    pub fn design(&self) -> Design {
        let Shots { design, step, deviation, .. } = self.shots;
        match design {
            DesignName::Even => Design::Even,
            DesignName::Langlie => Design::Langlie,
            DesignName::UpAndDown => Design::UpAndDown { step },
            DesignName::DOptimal => Design::DOptimal { deviation },
        }
    }

    /// The shot of this number that is to have this speed. What is chance in it follows from the seed and the number alone.
    pub fn shot(&self, number: usize, aimed: f64) -> Shot {
        let chance = |what: Chance| uniform(self.shots.seed, [number as u64, what as u64]);
        let mut aim = self.target.aim();
        if let (Target::Panel(case), AimName::Cell) = (&self.target, self.shots.aim) {
            let parts = [Chance::AlongWarp, Chance::AlongWeft].map(|what| chance(what) - 0.5);
            for (edge, part) in case.cloth.cell().iter().zip(parts) {
                aim = [aim[0] + part * edge[0], aim[1] + part * edge[1]];
            }
        }
        // No speed is below 0, however wide the scatter.
        let speed = aimed + self.shots.scatter * Normal::standard().inverse_cdf(chance(Chance::Speed));
        let seed = self.target.seed().map(|_| (SEEDS * chance(Chance::Strength)) as u64);
        Shot { number, aimed, speed: speed.max(0.1 * aimed), aim, seed }
    }

    /// The scene's own shot at this speed, in which nothing is chance.
    pub fn plain_shot(&self, number: usize, speed: f64) -> Shot {
        Shot { number, aimed: speed, speed, aim: self.target.aim(), seed: self.target.seed() }
    }

    /// How long a shot may take.
    pub fn last(&self) -> f64 {
        self.shots.extension * self.target.end()
    }

    /// All that the outcome of a shot depends on besides what the shot itself says.
    pub fn identity(&self) -> u32 {
        let mut target = self.target.at(&self.plain_shot(0, 1.0), 1.0);
        let shots = Shots { number: 0, extension: 0.0, tolerance: 0.0, spread: None, ..self.shots };
        let case = match &mut target {
            Target::Panel(case) => {
                (case.plan, case.name) = Default::default();
                format!("{case:?}")
            }
            Target::Yarn(case) => {
                (case.plan, case.name) = Default::default();
                format!("{case:?}")
            }
        };
        crc32fast::hash(format!("{:?} {case} {shots:?}", self.units.names()).as_bytes())
    }
}

/// The only case, or the one of this name.
fn one<C>(file: &str, mut cases: Vec<C>, wanted: Option<&str>, name: impl Fn(&C) -> &String) -> Result<C, Error> {
    let names: Vec<String> = cases.iter().map(|case| name(case).clone()).collect();
    let place = match wanted {
        None if cases.len() == 1 => Some(0),
        None => None,
        Some(wanted) => names.iter().position(|name| name == wanted),
    };
    let allowed = names.join(", ");
    match (place, wanted) {
        (Some(place), _) => Ok(cases.swap_remove(place)),
        (None, None) => Err(Error::Input(format!("{file}: several cases; allowed: --case with one of {allowed}"))),
        (None, Some(wanted)) => Err(Error::Input(format!("--case is {wanted}; allowed: one of {allowed}"))),
    }
}

impl Target {
    /// What a shot strikes, with so much time.
    pub fn at(&self, shot: &Shot, end: f64) -> Target {
        let mut target = self.clone();
        let (plan, strength) = match &mut target {
            Target::Panel(case) => {
                (case.speed, case.sphere.aim) = (shot.speed, shot.aim);
                (&mut case.plan, &mut case.strength)
            }
            Target::Yarn(case) => {
                case.speed = shot.speed;
                (&mut case.plan, &mut case.strength)
            }
        };
        // It ends when its fate is decided; nothing is drawn, and nothing kept to go on from.
        (plan.end, plan.rebounds, plan.frames, plan.checkpoints) = (end, false, 0, 0);
        plan.pictures.clear();
        if let (Some(strength), Some(seed)) = (strength, shot.seed) {
            strength.field.seed = seed;
        }
        target
    }

    /// The case's.
    pub fn name(&self) -> &str {
        match self {
            Target::Panel(case) => &case.name,
            Target::Yarn(case) => &case.name,
        }
    }

    fn aim(&self) -> [f64; 2] {
        match self {
            Target::Panel(case) => case.sphere.aim,
            Target::Yarn(_) => [0.0; 2],
        }
    }

    /// Of the strength, where that scatters.
    fn seed(&self) -> Option<u64> {
        match self {
            Target::Panel(case) => case.strength,
            Target::Yarn(case) => case.strength,
        }
        .map(|strength| strength.field.seed)
    }

    fn end(&self) -> f64 {
        match self {
            Target::Panel(case) => case.plan.end,
            Target::Yarn(case) => case.plan.end,
        }
    }
}
