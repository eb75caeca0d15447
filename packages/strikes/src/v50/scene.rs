//! A scene whose shots are fired: one case of `toron fabric` or of `toron impact`, and its `[shots]`.

use std::path::Path;

use super::designs::{Design, scattered};
use crate::chance::uniform;
use crate::impact::scene::Striker;
use crate::scene_keys::shots::{AimName, DesignName, Shots};
use crate::strength::scatter::Strength;
use crate::weave::panel::Part;
use crate::{fabric, impact};
use toron::host::units::UnitSystem;
use toron_explicit_host::struck::plan::Plan;
use toron_materials::material::model::Material;
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::toml_file::{self, Source};

/// Tables that a scene of a panel has, one at least.
const OF_PANELS: [&str; 2] = ["weave", "mesh"];
/// The seeds of strengths are below this: a file in TOML and a table hold them as they are.
const SEEDS: f64 = 1e12;

/// The scene.
pub struct Scene {
    /// The file's.
    pub text: String,
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
    pub nominal: f64,
    pub speed: f64,
    /// Where it meets the panel.
    pub aim: [f64; 2],
    /// Of the strength, where that scatters.
    pub seed: Option<u64>,
}

impl Shot {
    /// In what it is another shot than one of its number: `has speed 45.1 here, and speed 45.2`.
    pub fn difference(&self, other: &Shot) -> Option<String> {
        if self == other {
            return None;
        }
        let figures = |shot: &Shot| {
            let seed = shot.seed.map_or("no seed".to_string(), |seed| format!("seed {seed}"));
            let [x, y] = shot.aim;
            let (nominal, speed) = (shot.nominal, shot.speed);
            [format!("nominal speed {nominal}"), format!("speed {speed}"), format!("aim [{x}, {y}]"), seed]
        };
        let mut pairs = figures(self).into_iter().zip(figures(other));
        pairs.find(|(own, other)| own != other).map(|(own, other)| format!("has {own} here, and {other}"))
    }
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
        let source = Source { name, text };
        let tables = source.tables()?;
        let wanted = "allowed: a table [shots] with number and speeds at least";
        let shots = |shots: Option<Shots>| {
            shots.ok_or_else(|| {
                Error::Input(format!("{name}: no shots; {wanted} (`toron init v50` writes a scene with them)"))
            })
        };
        let scene = if OF_PANELS.iter().any(|table| tables.get_ref().get(*table).is_some()) {
            let scene = fabric::scene::Scene::parse(name, text)?;
            let case = one(name, scene.cases, case, |case| &case.name)?;
            let (title, units) = (scene.title, scene.units);
            let (text, target) = (text.to_string(), Target::Panel(Box::new(case)));
            Scene { text, title, units, shots: shots(scene.shots)?, target }
        } else {
            let scene = impact::scene::Scene::parse(name, text)?;
            let case = one(name, scene.cases, case, |case| &case.name)?;
            let (title, units) = (scene.title, scene.units);
            let (text, target) = (text.to_string(), Target::Yarn(Box::new(case)));
            Scene { text, title, units, shots: shots(scene.shots)?, target }
        };
        scene.check(&source)?;
        Ok(scene)
    }

    fn check(&self, source: &Source) -> Result<(), Error> {
        let refused = |message: &str| Err(Error::Input(format!("{}: {message}", source.name)));
        if !self.target.can_fail() {
            return refused(
                "failure is none: nothing breaks, and every shot is stopped; allowed: failure = \"uniaxial\" or \"multiaxial\"",
            );
        }
        if let Target::Yarn(case) = &self.target
            && matches!(case.striker, Striker::Driven | Striker::Cylinder { held: true, .. })
        {
            return refused(
                "striker is driven, or held at its speed: nothing stops it; allowed: a cylinder that is free",
            );
        }
        if self.shots.aim == AimName::Cell {
            let has_cell = self.target.has_cell();
            has_cell.map_err(|message| source.error(source.place("shots", "aim"), &message))?;
        }
        Ok(())
    }

    /// That something is chance in the shots of a series: else their fates are a step, whose place is found without
    /// statistics.
    ///
    /// # Errors
    /// Nothing is.
    pub fn check_chance(&self, name: &str) -> Result<(), Error> {
        let Shots { scatter, aim, .. } = self.shots;
        if scatter > 0.0 || aim == AimName::Cell || self.target.strength().is_some_and(Strength::scatters) {
            return Ok(());
        }
        let message = "nothing scatters: scatter is 0, aim is fixed, and no strength has a finite weibull-modulus; allowed: a scatter > 0, \
                       aim = \"cell\", [scene.strength], or --limit, which needs no chance";
        Err(Error::Input(format!("{name}: {message}")))
    }

    pub fn design(&self) -> Design {
        let Shots { design, step, deviation, .. } = self.shots;
        match design {
            DesignName::Even => Design::Even,
            DesignName::Langlie => Design::Langlie,
            DesignName::UpAndDown => Design::UpAndDown { step },
            DesignName::DOptimal => Design::DOptimal { deviation },
            DesignName::ThreePod => Design::ThreePod { deviation, approach: None },
        }
    }

    /// The shot of this number that is to have this speed. What is chance in it follows from the seed and the number
    /// alone.
    pub fn shot(&self, number: usize, nominal: f64) -> Shot {
        let chance = |what: Chance| uniform(self.shots.seed, [number as u64, what as u64]);
        let mut aim = self.target.aim().unwrap_or_default();
        if let (Target::Panel(case), AimName::Cell) = (&self.target, self.shots.aim) {
            let parts = [Chance::AlongWarp, Chance::AlongWeft].map(|what| chance(what) - 0.5);
            aim = in_cell(aim, case.cloth.cell(), parts);
        }
        let speed = scattered(nominal, self.shots.scatter, chance(Chance::Speed));
        let seed = self.target.seed().map(|_| (SEEDS * chance(Chance::Strength)) as u64);
        Shot { number, nominal, speed, aim, seed }
    }

    /// The scene's own shot at this speed, in which nothing is chance.
    pub fn plain_shot(&self, number: usize, speed: f64) -> Shot {
        Shot { number, nominal: speed, speed, aim: self.target.aim().unwrap_or_default(), seed: self.target.seed() }
    }

    /// How long a shot may take.
    pub fn last(&self) -> f64 {
        self.shots.extension * self.target.plan().end
    }

    /// All that the outcome of a shot depends on besides what the shot itself says.
    pub fn identity(&self) -> u32 {
        let mut target = self.target.at(&self.plain_shot(0, 1.0), 1.0);
        let &Plan { end, decides, settles, .. } = self.target.plan();
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
        crc32fast::hash(format!("{:?} {case} {end} {decides} {settles} {shots:?}", self.units.names()).as_bytes())
    }
}

/// The place in a cell about a middle, so many edges away from it.
fn in_cell(middle: [f64; 2], edges: [[f64; 2]; 2], parts: [f64; 2]) -> [f64; 2] {
    let along = |place: [f64; 2], (edge, part): ([f64; 2], f64)| [place[0] + part * edge[0], place[1] + part * edge[1]];
    edges.into_iter().zip(parts).fold(middle, along)
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
                (case.speed, case.striker.aim) = (shot.speed, shot.aim);
                (&mut case.plan, &mut case.strength)
            }
            Target::Yarn(case) => {
                case.speed = shot.speed;
                (&mut case.plan, &mut case.strength)
            }
        };
        // It ends when its fate is decided, by the steps of the scene's own run; nothing is drawn, and nothing kept to
        // go on from.
        plan.steps_to = Some(plan.end);
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

    /// Where a panel is struck; a yarn is struck in its middle.
    pub fn aim(&self) -> Option<[f64; 2]> {
        match self {
            Target::Panel(case) => Some(case.striker.aim),
            Target::Yarn(_) => None,
        }
    }

    /// That it has a cell of a weave about where it is struck, and all of that cell.
    ///
    /// # Errors
    /// What is allowed for `aim`.
    fn has_cell(&self) -> Result<(), String> {
        let Target::Panel(case) = self else { return Err("aim is \"cell\" of a yarn; allowed: fixed".to_string()) };
        if case.cloth.part() == Part::Quarter {
            let message =
                "aim is \"cell\" of a quarter, which is struck in the middle; allowed: fixed, or part = \"whole\"";
            return Err(message.to_string());
        }
        let (middle, edges) = (case.striker.aim, case.cloth.cell());
        for parts in [[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]] {
            let corner = in_cell(middle, edges, parts);
            case.cloth.covers(corner).map_err(|allowed| {
                let [[x, y], [at_x, at_y]] = [middle, corner].map(|place| place.map(number));
                format!(
                    "aim is \"cell\" about [{x}, {y}], a corner of which lies at [{at_x}, {at_y}]; allowed: corners {allowed}, or aim = \"fixed\""
                )
            })?;
        }
        Ok(())
    }

    /// Of the strength, where that scatters.
    fn seed(&self) -> Option<u64> {
        self.strength().map(|strength| strength.field.seed)
    }

    /// Where it scatters.
    pub fn strength(&self) -> Option<&Strength> {
        match self {
            Target::Panel(case) => case.strength.as_ref(),
            Target::Yarn(case) => case.strength.as_ref(),
        }
    }

    /// What symmetry leaves out.
    pub fn left_out(&self) -> Option<&'static str> {
        match self {
            Target::Panel(case) => case.left_out(),
            Target::Yarn(_) => Some(impact::scene::LEFT_OUT),
        }
    }

    /// The material under the blow.
    pub fn inner(&self) -> &Material {
        match self {
            Target::Panel(case) => case.zones.inner(),
            Target::Yarn(case) => case.zones.inner(),
        }
    }

    /// Whether anything may break.
    fn can_fail(&self) -> bool {
        match self {
            Target::Panel(case) => case.materials().any(Material::can_fail),
            Target::Yarn(case) => case.zones.materials().iter().any(Material::can_fail),
        }
    }

    fn plan(&self) -> &Plan {
        match self {
            Target::Panel(case) => &case.plan,
            Target::Yarn(case) => &case.plan,
        }
    }
}

/// A yarn that is shot at.
#[cfg(test)]
pub const YARN: &str = "units = \"mm-g-ms\"\n[scene]\nspeed = 100.0\nhalf-length = 2.0\nheight = 0.115\nwidth = 0.5337\n\
    layers = 20\nrows = 2\ncolumns = 4\nmass = 0.01\nradius = 1.0\ncontact-stiffness = 1e5\nend = 0.2\nfailure = \"uniaxial\"\n\
    [shots]\nnumber = 6\nspeeds = [20.0, 300.0]\n";

#[cfg(test)]
mod tests {
    use super::*;

    /// A panel with these keys in [weave.panel] and in [shots], and this Weibull modulus.
    fn panel(part: &str, shots: &str, modulus: f64) -> Result<Scene, String> {
        let text = format!(
            "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n\
             [weave.panel]\nshape = \"rectangle\"\nhalf = [3.0, 3.0]\npart = \"{part}\"\n\
             [scene]\nspeed = 100.0\nmass = 0.02\nradius = 1.0\ncontact-stiffness = 1e5\nend = 1.0\nfailure = \"uniaxial\"\n\
             [scene.strength]\nweibull-modulus = {modulus}\nstrain = 0.0458\nreference-length = 50.0\ncell = 1.0\n\
             [shots]\nnumber = 10\nspeeds = [80.0, 120.0]\n{shots}\n"
        );
        Scene::parse("shots.toml", &text, None).map_err(|error| error.to_string())
    }

    /// A shot's chances follow from the seed and its number, whatever scatters otherwise; they fill the cell, and have
    /// the deviation.
    #[test]
    fn a_shot_is_what_its_number_says() {
        let scene = panel("whole", "scatter = 2.0\naim = \"cell\"", 10.0).expect("a scene");
        let shots: Vec<Shot> = (1..=2000).map(|number| scene.shot(number, 100.0)).collect();
        assert_eq!(shots[6], scene.shot(7, 100.0));
        let other = panel("whole", "scatter = 2.0\naim = \"cell\"", 20.0).expect("a scene");
        assert_eq!(other.shot(7, 100.0), shots[6]);
        assert_ne!(other.identity(), scene.identity());
        let seeded = panel("whole", "scatter = 2.0\naim = \"cell\"\nseed = 2", 10.0).expect("a scene");
        assert!(seeded.shot(7, 100.0).seed != shots[6].seed && seeded.shot(7, 100.0).aim != shots[6].aim);

        // The repeat of the plain weave: two pitches each way.
        let half = 25.4 / 34.0;
        for axis in 0..2 {
            let places = || shots.iter().map(|shot| shot.aim[axis] / half);
            assert!(places().all(|place| place.abs() < 1.0));
            let mean: f64 = places().sum::<f64>() / 2000.0;
            let square: f64 = places().map(|place| place * place).sum::<f64>() / 2000.0;
            assert!(mean.abs() < 0.05 && (square - 1.0 / 3.0).abs() < 0.03, "{mean} {square}");
        }
        let off = |shot: &Shot| shot.speed - 100.0;
        let variance: f64 = shots.iter().map(|shot| off(shot).powi(2)).sum::<f64>() / 2000.0;
        assert!((variance.sqrt() - 2.0).abs() < 0.15 && shots.iter().map(off).sum::<f64>().abs() < 400.0, "{variance}");
        let mut seeds: Vec<_> = shots.iter().map(|shot| shot.seed).collect();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), 2000);

        // What is struck is that, and one cloth for all: its weave is solved once, and held against finer ones once.
        let (Target::Panel(case), Target::Panel(own)) = (scene.target.at(&shots[6], 3.0), &scene.target) else {
            panic!("a panel")
        };
        assert!(std::sync::Arc::ptr_eq(&case.cloth, &own.cloth));
        let seed = case.strength.map(|strength| strength.field.seed);
        assert_eq!(
            (case.speed, case.striker.aim, seed, case.plan.end),
            (shots[6].speed, shots[6].aim, shots[6].seed, 3.0)
        );
        // Without scatter it is the scene's own.
        let plain = panel("quarter", "", 10.0).expect("a scene");
        assert_eq!((plain.shot(3, 90.0).speed, plain.shot(3, 90.0).aim), (90.0, [0.0; 2]));
        assert_eq!(plain.plain_shot(1, 90.0).seed, Some(1));
        assert_eq!(plain.target.left_out(), Some("three quarters of a panel"));
        assert_eq!(scene.target.left_out(), None);
    }

    /// Where nothing is chance a series is refused, whatever the table of strength says; `--limit` is not.
    #[test]
    fn a_series_needs_chance() {
        let refused = |scene: &Scene| scene.check_chance("shots.toml").err().map(|error| error.to_string());
        let even = panel("whole", "", f64::INFINITY).expect("a scene");
        assert!(refused(&even).is_some_and(|message| message.contains("nothing scatters: scatter is 0")));
        assert!(refused(&Scene::parse("yarn.toml", YARN, None).expect("a scene")).is_some());
        for (shots, modulus) in [("", 10.0), ("scatter = 0.1", f64::INFINITY), ("aim = \"cell\"", f64::INFINITY)] {
            assert_eq!(refused(&panel("whole", shots, modulus).expect("a scene")), None, "{shots}");
        }
    }

    /// A scene is another one where a shot may end otherwise, and the same whatever else is planned.
    #[test]
    fn a_scene_is_known_by_what_its_shots_depend_on() {
        let of = |from: &str, to: &str| {
            Scene::parse("yarn.toml", &YARN.replace(from, to), None).expect("a scene").identity()
        };
        let whole = panel("whole", "", 10.0).expect("a scene");
        let mut decided = panel("whole", "", 10.0).expect("a scene");
        let Target::Panel(case) = &mut decided.target else { panic!("a panel") };
        case.plan.decides = true;
        assert_ne!(whole.identity(), decided.identity());
        let mut settled = Scene { target: decided.target.clone(), ..panel("whole", "", 10.0).expect("a scene") };
        let Target::Panel(case) = &mut settled.target else { panic!("a panel") };
        case.plan.settles = true;
        assert_ne!(settled.identity(), decided.identity());
        let own = of("", "");
        for (from, to) in
            [("end = 0.2", "end = 0.2\nsample = 0.01\nframes = 3"), ("number = 6", "number = 9\nspread = 3.0")]
        {
            assert_eq!(of(from, to), own, "{to}");
        }
        for (from, to) in [("layers = 20", "layers = 40"), ("end = 0.2", "end = 0.3")] {
            assert_ne!(of(from, to), own, "{to}");
        }
    }

    /// A cell about the aim has to be panel altogether.
    #[test]
    fn no_shot_misses_the_panel() {
        let about = |aim: &str| {
            let text = panel("whole", "aim = \"cell\"", 10.0).expect("a scene").text;
            let text = text.replace("[scene]\n", &format!("[scene]\naim = {aim}\n"));
            Scene::parse("shots.toml", &text, None).map(|_| ()).map_err(|error| error.to_string())
        };
        assert_eq!(about("[2.2, -2.2]"), Ok(()));
        let error = about("[2.3, 0.0]").expect_err("its corners are at 3.05");
        let wanted = "aim is \"cell\" about [2.300, 0], a corner of which lies at [3.047, -0.7471]; allowed: corners within the panel's outline, x from -3.000 to 3.000";
        assert!(error.contains(wanted), "{error}");
    }

    #[test]
    fn scenes_that_cannot_be_shot_at_are_refused() {
        let error = Scene::parse("yarn.toml", &YARN.replace("failure = \"uniaxial\"\n", ""), None).map(|_| ());
        assert!(error.is_err_and(|error| error.to_string().contains("failure is none: nothing breaks")));
        for (part, shots, message) in [
            ("quarter", "aim = \"cell\"", "shots.toml:25: aim is \"cell\" of a quarter"),
            ("whole", "scatter = 21.0", "scatter is 21; allowed: up to 20, half of the range of speeds"),
            (
                "whole",
                "tolerance = 40.0",
                "tolerance is 40; allowed: 1.200e-7 or more, and less than the range of speeds, 40",
            ),
            ("whole", "design = \"up-and-down\"\nstep = 41.0", "step is 41; allowed: up to 40, the range of speeds"),
            ("whole", "extension = 0.5", "extension is 0.5; allowed: 1 to 100"),
            ("whole", "seed = -1", "seed is -1; allowed: a whole number >= 0"),
            ("whole", "tolerance = 1e-9", "tolerance is 0.000000001; allowed: 1.2"),
            ("whole", "scatter = -1.0", "scatter is -1.0; allowed: a finite number >= 0"),
            ("whole", "deviation = 3.0", "deviation is 3; allowed: with design = \"d-optimal\" or design = \"3pod\""),
            ("whole", "design = \"3pod\"\ndeviation = 7.0", "deviation is 7; allowed: up to 6.66"),
            ("whole", "design = \"up-and-down\"\nstep = 0.0", "step is 0.0; allowed: a finite number > 0"),
            ("whole", "[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\nspeed = 90.0", "--case with one of a, b"),
        ] {
            let error = panel(part, shots, 10.0).map(|_| ()).expect_err(message);
            assert!(error.contains(message), "{message}: {error}");
        }
    }
}
