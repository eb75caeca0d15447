//! One shot from its first step to its fate.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::curve::Fate;
use super::scene::{Scene, Shot, Target};
use crate::fabric::run::StruckPanel;
use crate::fabric::summary::Figures;
use crate::impact::run::StruckYarn;
use crate::residual::SpeedIs;
use crate::{fabric, impact};
use toron_explicit_host::judgement::{Finding, verdict};
use toron_explicit_host::struck::pace::Estimate;
use toron_explicit_host::struck::run::{self, End, Observer};
use toron_explicit_host::struck::sample::Sample;
use toron_shared::error::Error;
use toron_shared::text_table::NONE;

/// How a shot ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    Stopped,
    Through,
    /// Neither when its time was over.
    Undecided,
    /// The run could not go on, for this reason.
    Error(String),
}

/// A shot that has ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ended {
    pub shot: Shot,
    pub ending: Ending,
    /// Of what struck, at the end: its residual speed where it went through.
    pub speed_at_end: f64,
    pub time: f64,
    /// The run's verdict: that it is sound, or what is wrong with it.
    pub verdict: String,
    /// Which speed that is, where there is a residual one.
    pub speed_is: Option<SpeedIs>,
    /// The speed when it was certain that it goes through, and the processor time up to then.
    pub decision: Option<[f64; 2]>,
    /// The processor time of its threads, and how long it took.
    pub seconds: f64,
    pub wall_seconds: f64,
}

impl Ended {
    /// A shot of which nothing is known.
    pub fn of(shot: Shot) -> Ended {
        Ended {
            shot,
            ending: Ending::Undecided,
            speed_at_end: 0.0,
            time: 0.0,
            verdict: String::new(),
            speed_is: None,
            decision: None,
            seconds: 0.0,
            wall_seconds: 0.0,
        }
    }

    /// The fate, if it is known.
    pub fn fate(&self) -> Option<Fate> {
        let through = match self.ending {
            Ending::Stopped => false,
            Ending::Through => true,
            Ending::Undecided | Ending::Error(_) => return None,
        };
        Some(Fate { speed: self.shot.speed, through })
    }

    pub fn residual(&self) -> Option<f64> {
        (self.ending == Ending::Through).then_some(self.speed_at_end.max(0.0))
    }
}

/// Watches a shot: how far it is, and whether it is to end at once.
pub trait Watch: Sync {
    fn progress(&self, shot: &Shot, fraction: f64);
    fn interrupts(&self) -> bool;

    /// How long the shot will take, once; told in a thread of the pool that it has.
    fn estimate(&self, _shot: &Shot, _estimate: &Estimate) {}
}

struct Watcher<'a> {
    watch: &'a dyn Watch,
    shot: &'a Shot,
}

impl<E> Observer<E> for Watcher<'_> {
    fn progress(&mut self, fraction: f64, _: &Sample<E>, _: f64) {
        self.watch.progress(self.shot, fraction);
    }

    fn estimate(&mut self, estimate: &Estimate) {
        self.watch.estimate(self.shot, estimate);
    }

    fn interrupts(&self) -> bool {
        self.watch.interrupts()
    }
}

/// What is wrong with a scene before its first shot.
///
/// # Errors
/// It cannot be shot at.
pub fn before(scene: &Scene) -> Result<Vec<Finding>, Error> {
    let middle = 0.5 * (scene.shots.speeds[0] + scene.shots.speeds[1]);
    match scene.target.at(&scene.plain_shot(1, middle), scene.last()) {
        Target::Panel(case) => {
            let struck = StruckPanel::new(&case)?;
            Ok(fabric::judgement::before(&scene.units, &case, &struck.panel))
        }
        Target::Yarn(case) => {
            StruckYarn::new(&case)?;
            Ok(impact::judgement::before(&scene.units, &case))
        }
    }
}

/// What target and striker weigh, in words; nothing of a yarn without a density.
///
/// # Errors
/// It cannot be shot at.
pub fn weights(scene: &Scene) -> Result<String, Error> {
    match scene.target.at(&scene.plain_shot(1, scene.shots.speeds[0]), scene.last()) {
        Target::Panel(case) => Ok(fabric::weights::text(&scene.units, &case, &StruckPanel::new(&case)?.panel)),
        Target::Yarn(case) => Ok(impact::weights::text(&scene.units, &case)),
    }
}

/// Fires a shot, in the threads of the pool that this is called in; none where it was interrupted. A shot that ends
/// with an error, or in which the program fails, has ended too.
pub fn fire(scene: &Scene, shot: &Shot, watch: &dyn Watch) -> Option<Ended> {
    // Of a shot that fails nothing is used again.
    let struck = catch_unwind(AssertUnwindSafe(|| strike(scene, shot, &mut Watcher { watch, shot })));
    let message = match struck {
        Ok(Ok(ended)) => return ended,
        Ok(Err(error)) => error.to_string(),
        Err(panic) => format!("the program fails in this shot: {}", said(&*panic)),
    };
    let (verdict, ending) = (NONE.to_string(), Ending::Error(message));
    Some(Ended { ending, speed_at_end: shot.speed, verdict, ..Ended::of(*shot) })
}

/// What a panic says.
fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or(panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("without a message")
}

fn strike(scene: &Scene, shot: &Shot, watcher: &mut Watcher) -> Result<Option<Ended>, Error> {
    // Scatter, and some designs, leave the range that the scene's reader has looked at.
    scene.target.inner().bears_strike("speed", shot.speed, &scene.units).map_err(Error::Input)?;
    match scene.target.at(shot, scene.last()) {
        Target::Panel(case) => {
            let struck = StruckPanel::new(&case)?;
            let outcome = run::run(&struck, None, watcher)?;
            let figures = Figures::of(&scene.units, &case, &struck.panel, &outcome);
            Ok(ended(shot, &outcome, case.plan.settles, &figures.findings))
        }
        Target::Yarn(case) => {
            let struck = StruckYarn::new(&case)?;
            let outcome = struck.outcome(run::run(&struck, None, watcher)?);
            Ok(ended(shot, &outcome, false, &impact::judgement::judge(&scene.units, &case, &outcome)))
        }
    }
}

fn ended<E: Copy + Default, C>(
    shot: &Shot,
    outcome: &run::Outcome<E, C>,
    settles: bool,
    findings: &[Finding],
) -> Option<Ended> {
    let ending = match outcome.end {
        End::Interrupted => return None,
        End::Stopped | End::Rebounded => Ending::Stopped,
        End::Left | End::Decided | End::Settled => Ending::Through,
        End::Time => Ending::Undecided,
        End::Failed => Ending::Error(outcome.failure.clone().unwrap_or_default()),
    };
    Some(Ended {
        shot: *shot,
        ending,
        speed_at_end: outcome.last().speed,
        time: outcome.last_time(),
        verdict: verdict(findings),
        speed_is: SpeedIs::of(outcome.end, settles),
        decision: outcome.decision.map(|decision| [decision.speed, decision.processor.as_secs_f64()]),
        seconds: outcome.cost.processor.as_secs_f64(),
        wall_seconds: outcome.wall.as_secs_f64(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::v50::scene::YARN;

    struct Unwatched;

    impl Watch for Unwatched {
        fn progress(&self, _: &Shot, _: f64) {}

        fn interrupts(&self) -> bool {
            false
        }
    }

    /// It fails as soon as it is told of anything.
    struct Failing;

    impl Watch for Failing {
        fn progress(&self, shot: &Shot, _: f64) {
            panic!("of shot {}", shot.number);
        }

        fn interrupts(&self) -> bool {
            false
        }
    }

    /// A shot in which the program fails is an error, by which the other shots of the series are not lost.
    #[test]
    fn a_shot_in_which_the_program_fails_is_an_error() {
        let scene = Scene::parse("yarn.toml", YARN, None).expect("a scene");
        let ended = fire(&scene, &scene.plain_shot(3, 100.0), &Failing).expect("it ends");
        assert_eq!(ended.ending, Ending::Error("the program fails in this shot: of shot 3".to_string()));
    }

    /// A shot that has left the range for speeds that no yarn bears is an error with what is allowed, not a run.
    #[test]
    fn a_shot_faster_than_any_yarn_bears_is_an_error() {
        let scene = Scene::parse("yarn.toml", YARN, None).expect("a scene");
        let ended = fire(&scene, &scene.plain_shot(3, 3e6), &Unwatched).expect("it ends");
        let Ending::Error(message) = &ended.ending else { panic!("{ended:?}") };
        assert!(message.contains("speed is 3000000; allowed: up to"), "{message}");
        assert_eq!((ended.shot.number, ended.fate(), ended.time), (3, None, 0.0));
    }
}
