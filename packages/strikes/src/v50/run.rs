//! Fires the shots of a series: side by side, one a core, or one after another where each needs the fates of those
//! before it.

use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget};
use rayon::ThreadPoolBuilder;

use super::designs::Fired;
use super::records::Records;
use super::scene::{Scene, Shot};
use super::shot::{Ended, Ending, Watch, fire};
use toron_explicit_host::struck::pace::{Estimate, duration};
use toron_materials::units::{SPEED, unit};
use toron_shared::console::print_note;
use toron_shared::error::Error;
use toron_shared::interrupt::Interrupt;
use toron_shared::numbers::number;
use toron_shared::progress;

/// Ticks of the progress bar for each shot.
const TICKS: u64 = 1000;
/// A sequential design that gets no fate from so many shots in a row goes on repeating itself.
const WITHOUT_FATE: usize = 3;
/// Times closer than this part of themselves are the same.
const ROUNDING: f64 = 1e-9;

/// Shots on their way.
pub struct FiringRange<'a> {
    pub scene: &'a Scene,
    pub threads: usize,
    interrupt: Interrupt,
    bar: ProgressBar,
    begun: Instant,
    /// How many shots have ended since, and how many there are.
    ended: AtomicUsize,
    all: usize,
    /// How far each of those under way is, in ticks.
    ticks: Mutex<Vec<(usize, u64)>>,
    /// Whether it has been said how long the shots will take.
    is_estimated: AtomicBool,
}

impl Watch for FiringRange<'_> {
    fn progress(&self, shot: &Shot, fraction: f64) {
        let now = (fraction.clamp(0.0, 1.0) * TICKS as f64) as u64;
        let mut ticks = self.ticks.lock().unwrap_or_else(PoisonError::into_inner);
        match ticks.iter_mut().find(|(number, _)| *number == shot.number) {
            Some((_, before)) => {
                self.bar.inc(now.saturating_sub(*before));
                *before = now.max(*before);
            }
            None => {
                self.bar.inc(now);
                ticks.push((shot.number, now));
            }
        }
    }

    fn interrupts(&self) -> bool {
        self.interrupt.is_asked()
    }

    fn estimate(&self, shot: &Shot, estimate: &Estimate) {
        if !self.is_estimated.swap(true, Ordering::Relaxed) {
            let side_by_side = self.threads / rayon::current_num_threads();
            self.say(&self.estimate_line(shot, estimate, side_by_side));
        }
    }
}

impl<'a> FiringRange<'a> {
    /// For so many shots.
    pub fn new(scene: &'a Scene, threads: usize, all: usize, interrupt: Interrupt) -> FiringRange<'a> {
        let template = "{msg} {wide_bar} {percent} %, {eta} left";
        let bar = progress::bar(TICKS * all as u64, template, ProgressDrawTarget::stderr());
        let (begun, ended, ticks) = (Instant::now(), AtomicUsize::new(0), Mutex::new(Vec::new()));
        let is_estimated = AtomicBool::new(false);
        FiringRange { scene, threads, interrupt, bar, begun, ended, all, ticks, is_estimated }
    }

    pub fn is_interrupted(&self) -> bool {
        self.interrupt.is_asked()
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    /// Fires shots side by side, each in one thread; their records are kept as they end.
    ///
    /// # Errors
    /// A record cannot be written, or no thread be made.
    pub fn fire_all(&self, shots: &[Shot], records: &Mutex<Records>) -> Result<(), Error> {
        let next = AtomicUsize::new(0);
        let work = || -> Result<(), Error> {
            let pool = pool(1)?;
            while let Some(shot) = shots.get(next.fetch_add(1, Ordering::Relaxed))
                && !self.is_interrupted()
            {
                if let Some(ended) = pool.install(|| fire(self.scene, shot, self)) {
                    self.keep(ended, records)?;
                }
            }
            Ok(())
        };
        let workers = self.threads.min(shots.len());
        let ends: Vec<Result<(), Error>> = std::thread::scope(|scope| {
            let handles: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
            let panicked = || Err(Error::Evaluation("a shot's thread has ended by itself".to_string()));
            handles.into_iter().map(|handle| handle.join().unwrap_or_else(|_| panicked())).collect()
        });
        ends.into_iter().collect()
    }

    /// Fires one shot in all threads; none where it was interrupted.
    ///
    /// # Errors
    /// The record cannot be written, or no thread be made.
    pub fn fire_one(&self, shot: &Shot, records: &Mutex<Records>) -> Result<Option<Ended>, Error> {
        let ended = pool(self.threads)?.install(|| fire(self.scene, shot, self));
        if let Some(ended) = ended.clone() {
            self.keep(ended, records)?;
        }
        Ok(ended)
    }

    fn keep(&self, ended: Ended, records: &Mutex<Records>) -> Result<(), Error> {
        self.progress(&ended.shot, 1.0);
        let count = self.ended.fetch_add(1, Ordering::Relaxed) + 1;
        self.say(&self.line(&ended, count, self.begun.elapsed().as_secs_f64()));
        records.lock().unwrap_or_else(PoisonError::into_inner).add(ended)
    }

    /// What is said of a shot with which so many have ended in so many seconds, and how long the others take if they
    /// are like these.
    fn line(&self, ended: &Ended, count: usize, seconds: f64) -> String {
        let seconds = seconds / count as f64 * self.all.saturating_sub(count) as f64;
        let speed = unit(&self.scene.units, SPEED);
        let how = match &ended.ending {
            Ending::Stopped => "stopped".to_string(),
            Ending::Through => format!("through, {} {speed} left", number(ended.speed_at_end)),
            Ending::Undecided => format!("undecided, {} {speed} left", number(ended.speed_at_end)),
            Ending::Error(message) => format!("an error: {message}"),
        };
        let left = match self.all > count {
            true => format!("; {count} of {}, about {:.0} min left", self.all, (seconds / 60.0).ceil()),
            false => String::new(),
        };
        format!("shot {} at {} {speed}: {how}{left}", ended.shot.number, number(ended.shot.speed))
    }

    /// What is said in the first shot: how long it and all others take if none is decided before its end.
    fn estimate_line(&self, shot: &Shot, estimate: &Estimate, side_by_side: usize) -> String {
        let side_by_side = side_by_side.clamp(1, self.all.max(1));
        let most = duration(self.all.div_ceil(side_by_side) as f64 * estimate.seconds);
        let (number, all) = (shot.number, self.all);
        format!(
            "shot {number}: {estimate}; {all} shots, {side_by_side} at a time: {most} at most, less where they are decided before"
        )
    }

    /// Above the bar, if there is one.
    fn say(&self, line: &str) {
        if self.bar.is_hidden() {
            print_note(&format!("{line}\n"));
        } else {
            self.bar.println(line);
        }
    }

    /// The shot of the table, if it is this one and stays; another one of its number is named.
    fn known(&self, shot: &Shot, records: &Mutex<Records>) -> Option<Ended> {
        let records = records.lock().unwrap_or_else(PoisonError::into_inner);
        let ended = records.shots.get(&shot.number)?;
        if let Some(difference) = shot.difference(&ended.shot) {
            self.say(&format!("shot {} {difference} in the table: it is fired anew", shot.number));
            return None;
        }
        stays(self.scene, ended).then(|| ended.clone())
    }
}

fn pool(threads: usize) -> Result<rayon::ThreadPool, Error> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| Error::Evaluation(format!("no threads for a shot: {error}")))
}

/// Whether a shot stays as it ended: it has a fate, or was undecided no earlier than it would be now.
pub fn stays(scene: &Scene, ended: &Ended) -> bool {
    match ended.ending {
        Ending::Stopped | Ending::Through => true,
        Ending::Undecided => ended.time >= scene.last() * (1.0 - ROUNDING),
        // What was missing, memory or a file, may be there now.
        Ending::Error(_) => false,
    }
}

/// Of the shots that are there those of the series: of its numbers, and of a sequential design up to the first that is
/// missing or that the fates before it would have at another speed now.
pub fn confirmed(scene: &Scene, records: &Records) -> Vec<Ended> {
    let design = scene.design();
    let (mut shots, mut before): (Vec<Ended>, Vec<Fired>) = Default::default();
    for number in 1..=scene.shots.number {
        let shot = scene.shot(number, design.speed(number, &before, scene.shots.speeds));
        match records.shots.get(&number).filter(|ended| ended.shot == shot) {
            Some(ended) => {
                if design.is_sequential() {
                    before.extend(ended.fate().map(|fate| Fired { nominal: shot.nominal, fate }));
                }
                shots.push(ended.clone());
            }
            None if design.is_sequential() => break,
            None => {}
        }
    }
    shots
}

/// Fires the shots of these numbers that have to be fired; whether none is left.
///
/// # Errors
/// As for [`FiringRange::fire_all`]; a sequential design gets no fates.
pub fn series(range: &FiringRange, numbers: RangeInclusive<usize>, records: &Mutex<Records>) -> Result<bool, Error> {
    let (scene, design) = (range.scene, range.scene.design());
    let speeds = scene.shots.speeds;
    if design.is_sequential() {
        let (mut before, mut without_fate): (Vec<Fired>, usize) = Default::default();
        for number in numbers {
            let shot = scene.shot(number, design.speed(number, &before, speeds));
            let known = range.known(&shot, records);
            let Some(ended) = known.map_or_else(|| range.fire_one(&shot, records), |known| Ok(Some(known)))? else {
                return Ok(false);
            };
            before.extend(ended.fate().map(|fate| Fired { nominal: shot.nominal, fate }));
            without_fate = if ended.fate().is_some() { 0 } else { without_fate + 1 };
            if without_fate == WITHOUT_FATE {
                return Err(no_fates(scene, &ended));
            }
        }
        return Ok(true);
    }
    let shots = numbers.map(|number| scene.shot(number, design.speed(number, &[], speeds)));
    let due: Vec<Shot> = shots.filter(|shot| range.known(shot, records).is_none()).collect();
    range.fire_all(&due, records)?;
    Ok(!range.is_interrupted())
}

/// Why a sequential design does not go on after this shot.
fn no_fates(scene: &Scene, last: &Ended) -> Error {
    let Shot { number: to, nominal, .. } = last.shot;
    let (from, speed, nominal) = (to + 1 - WITHOUT_FATE, unit(&scene.units, SPEED), number(nominal));
    let (why, allowed) = match &last.ending {
        Ending::Error(message) => {
            (format!("an error: {message}"), "a scene that runs, or another range of speeds".to_string())
        }
        _ => {
            let extension = scene.shots.extension;
            (format!("undecided at {}", number(last.time)), format!("a larger extension than {extension}"))
        }
    };
    Error::Evaluation(format!(
        "shots {from} to {to} have no fate, and design {} goes on at {nominal} {speed} still; the last is {why}; allowed: {allowed}, or design = \"even\"",
        scene.design().name()
    ))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::v50::scene::YARN;

    fn ended(shot: Shot, ending: Ending) -> Ended {
        Ended { ending, speed_at_end: 1.0, time: 0.4, verdict: "sound".to_string(), seconds: 1.0, ..Ended::of(shot) }
    }

    /// A table of the shots of these numbers at these speeds, with their endings.
    fn records(scene: &Scene, shots: &[(usize, f64, Ending)]) -> Records {
        let mut records = Records::new(scene, Path::new("shots.csv"));
        let of = |(number, nominal, ending): &(usize, f64, Ending)| {
            (*number, ended(scene.shot(*number, *nominal), ending.clone()))
        };
        records.shots = shots.iter().map(of).collect();
        records
    }

    fn numbers(scene: &Scene, records: &Records) -> Vec<usize> {
        confirmed(scene, records).iter().map(|ended| ended.shot.number).collect()
    }

    /// Shots behind the first that has another speed by the fates before it are of no series yet.
    #[test]
    fn shots_of_a_sequential_design_are_confirmed_one_by_one() {
        let text = format!("{YARN}scatter = 0.0\ndesign = \"up-and-down\"\nstep = 10.0\n");
        let scene = Scene::parse("yarn.toml", &text, None).expect("a scene");
        let of = |first: Ending| {
            let shots = [
                (1, 160.0, first),
                (2, 170.0, Ending::Undecided),
                (3, 170.0, Ending::Through),
                (4, 160.0, Ending::Stopped),
                (6, 180.0, Ending::Stopped),
            ];
            numbers(&scene, &records(&scene, &shots))
        };
        assert_eq!(of(Ending::Stopped), [1, 2, 3, 4]);
        assert_eq!(of(Ending::Through), [1]);
    }

    /// What stays of a table are the shots that those of the scene equal to the bit; one with an error, or another aim,
    /// is fired anew.
    #[test]
    fn shots_of_the_table_are_known_to_the_bit() {
        let scene = Scene::parse("yarn.toml", &format!("{YARN}design = \"even\"\n"), None).expect("a scene");
        let shot = |number: usize| scene.shot(number, scene.design().speed(number, &[], scene.shots.speeds));
        let endings = [Ending::Through, Ending::Stopped, Ending::Error("no memory".to_string()), Ending::Undecided];
        let shots: Vec<_> = (1..).zip(endings).map(|(number, ending)| (number, shot(number).nominal, ending)).collect();
        let mut records = records(&scene, &shots);
        let speed = &mut records.shots.get_mut(&2).expect("a shot").shot.speed;
        *speed = speed.next_up();
        let records = Mutex::new(records);
        let range = FiringRange::new(&scene, 1, 4, Interrupt::default());
        let known: Vec<bool> = (1..=5).map(|number| range.known(&shot(number), &records).is_some()).collect();
        // It was undecided at the end that it would have again.
        assert_eq!(known, [true, false, false, true, false]);
        assert_eq!(numbers(&scene, &records.into_inner().expect("the table")), [1, 3, 4]);
        let (one, other) = (shot(1), Shot { seed: Some(4), ..shot(1) });
        assert_eq!(one.difference(&other).as_deref(), Some("has no seed here, and seed 4"));
    }

    #[test]
    fn a_shot_that_ends_says_how_long_the_others_take() {
        let scene = Scene::parse("yarn.toml", YARN, None).expect("a scene");
        let range = FiringRange::new(&scene, 1, 6, Interrupt::default());
        let through = ended(scene.shot(3, 100.0), Ending::Through);
        let said = "shot 3 at 100.0 mm/ms: through, 1.000 mm/ms left";
        assert_eq!(range.line(&through, 2, 60.0), format!("{said}; 2 of 6, about 2 min left"));
        assert_eq!(range.line(&through, 5, 300.5), format!("{said}; 5 of 6, about 2 min left"));
        assert_eq!(range.line(&through, 6, 300.0), said);
        let error = ended(scene.shot(4, 100.0), Ending::Error("no memory".to_string()));
        assert_eq!(range.line(&error, 6, 300.0), "shot 4 at 100.0 mm/ms: an error: no memory");
    }

    /// Two at a time: five rounds of nine.
    #[test]
    fn the_first_shot_says_how_long_all_of_them_take_at_most() {
        let scene = Scene::parse("yarn.toml", YARN, None).expect("a scene");
        let estimate = Estimate { elements: 100, steps: 2e4, measured: 500, seconds: 100.0 };
        let range = FiringRange::new(&scene, 2, 9, Interrupt::default());
        let shot = scene.shot(3, 100.0);
        assert_eq!(
            range.estimate_line(&shot, &estimate, 2),
            "shot 3: about 100 s up to end: 100 elements × 20000 steps × 50000 ns, as in the first 500 steps; \
             9 shots, 2 at a time: 8 min at most, less where they are decided before"
        );
        assert!(range.estimate_line(&shot, &estimate, 0).contains("9 shots, 1 at a time: 15 min at most"));
        range.estimate(&shot, &estimate);
        assert!(range.is_estimated.load(Ordering::Relaxed));
    }

    #[test]
    fn shots_beyond_the_number_are_of_no_series() {
        let scene = Scene::parse("yarn.toml", &format!("{YARN}design = \"even\"\n"), None).expect("a scene");
        let speed = |number: usize| scene.design().speed(number, &[], scene.shots.speeds);
        let shots = [1, 4, 6, 7, 10].map(|number| (number, speed(number), Ending::Stopped));
        assert_eq!(numbers(&scene, &records(&scene, &shots)), [1, 4, 6]);
    }
}
