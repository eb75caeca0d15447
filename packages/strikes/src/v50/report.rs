//! The report of a series, its table of figures, and those of simulated experiments.

use std::path::Path;

use super::curve::{Curve, Estimate, Interval, Mix};
use super::lambert_jonas::{Degenerate, MOST_EXPONENT};
use super::scene::Scene;
use super::series::Series;
use super::shot::{self, Ending};
use super::simulation::Coverage;
use super::test_houses::Mean;
use crate::residual::SpeedIs;
use crate::strength::scatter::{self, Strength};
use toron_explicit_host::judgement::SOUND;
use toron_explicit_host::struck::history::title;
use toron_materials::units::{SPEED, TIME, unit};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::text_table::{Column, NONE, files, folded, grouped, or_dash, table, write_csv};

/// Columns of a terminal.
const WIDTH: usize = 129;
const UNBOUNDED: &str = "unbounded";
/// What is printed for a speed that the curve has there.
const BELOW_ZERO: &str = "below 0";
/// A range whose end is further than this part of it from all shots has not been looked at there.
const NEAR_END: f64 = 0.1;
/// Where more of the experiments than this have no curve, it is said.
const OFTEN: f64 = 0.05;
/// The names of the speeds, in their order.
const SPEEDS: [&str; 3] = ["V5", "V50", "V95"];
pub const FIGURES: &str = "v50.csv";

/// A value or an end of an interval, as it is printed.
fn figure(value: f64) -> String {
    if value < 0.0 { BELOW_ZERO.to_string() } else { number(value) }
}

fn interval(Interval { low, high }: &Interval) -> String {
    let [low, high] = [low, high].map(|end| end.map_or(UNBOUNDED.to_string(), figure));
    if low == high { low } else { format!("{low} to {high}") }
}

/// `one`, `one and two`, `one, two and three`.
fn listed(words: &[&str]) -> String {
    match words {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => words.concat(),
    }
}

fn name(curve: &Curve) -> String {
    format!("{}{}", curve.link.name(), if curve.firth { ", Firth" } else { "" })
}

/// What came of the series; `missing` is how many of its shots have not been fired, and `beside` how many others stand
/// in the table.
pub fn report(scene: &Scene, series: &Series, [missing, beside]: [usize; 2], output: &Path) -> String {
    let [stopped, through, undecided, errors] = series.counts();
    let of_errors = if errors + undecided > 0 { ", which the curves leave out" } else { "" };
    let mut counts = format!(
        "{} shots by design {}: {stopped} stopped, {through} through, {undecided} undecided, {errors} errors{of_errors}",
        series.shots.len(),
        scene.design().name()
    );
    if missing > 0 {
        counts += &format!("; {missing} of {} have not been fired", scene.shots.number);
    }
    if beside > 0 {
        counts += &format!("; {beside} more in the table are not of this series, and left out");
    }
    let parts = [
        folded(&counts, WIDTH) + "\n" + &weights(scene) + &strength(scene) + &of_undecided(scene, undecided),
        curves(scene, series),
        said(scene, series),
        means(scene, series),
        residual(scene, series),
        speeds_and_costs(series),
        unsound(series),
        errors_of_shots(series),
        list_files(series, output),
    ];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    format!("{}\n\n{}", scene.title, parts.join("\n"))
}

fn strength(scene: &Scene) -> String {
    let report = |strength| scatter::report_of_shots(strength, scene.target.left_out(), &scene.units, WIDTH);
    scene.target.strength().map_or(String::new(), report)
}

/// What it means that shots are left out.
fn of_undecided(scene: &Scene, undecided: usize) -> String {
    if undecided == 0 {
        return String::new();
    }
    let text = format!(
        "Undecided shots are not missing at random: slow perforations and late stops, near V50, take longest. Without them the curve is \
         too steep, and V50 may be off; a larger extension than {} decides them.",
        scene.shots.extension
    );
    folded(&text, WIDTH) + "\n"
}

fn curves(scene: &Scene, series: &Series) -> String {
    let speed = unit(&scene.units, SPEED);
    let column = |above: &str, below: &str, entry: &dyn Fn(&Curve) -> String| Column {
        heading: [above.to_string(), below.to_string()],
        entries: series.curves.iter().map(entry).collect(),
    };
    let value = |estimate: &Estimate| or_dash(estimate.value, figure);
    let mut columns = vec![column("curve", "", &name)];
    for (place, of) in SPEEDS.into_iter().enumerate() {
        columns.push(column(of, &speed, &|curve| value(&curve.speeds[place])));
        columns.push(column(&format!("{of}, 95 %"), &speed, &|curve| interval(&curve.speeds[place].interval)));
    }
    columns.push(column("slope at V50", &format!("1/({speed})"), &|curve| value(&curve.slope)));
    columns.push(column("slope, 95 %", &format!("1/({speed})"), &|curve| interval(&curve.slope.interval)));
    table(columns, WIDTH)
}

/// What there is to say of the curves.
fn said(scene: &Scene, series: &Series) -> String {
    let speed = unit(&scene.units, SPEED);
    let of_mix = match series.mix {
        Mix::Separated([stop, through]) => Some(format!(
            "No zone of mixed results: the fastest stop is at {} {speed}, the slowest perforation at {} {speed}. The curve may be a step \
             anywhere between, whose slope is unbounded, and the likelihood has no one largest place; the intervals are what the shots \
             do not refuse. More shots between these two speeds would help, or --firth.",
            number(stop),
            number(through)
        )),
        Mix::Level => Some(
            "No curve that rises with the speed suits the shots better than a level one: a wider range of speeds, or more \
             shots, would help."
                .to_string(),
        ),
        Mix::Mixed | Mix::AllThrough | Mix::AllStopped => None,
    };
    let is_unbounded = |place: usize| series.curves.iter().any(|curve| !curve.speeds[place].interval.is_bounded());
    let unbounded: Vec<&str> = (0..SPEEDS.len()).filter(|&place| is_unbounded(place)).map(|at| SPEEDS[at]).collect();
    let of_ends = (!unbounded.is_empty()).then(|| {
        format!(
            "Intervals of {} are unbounded: the shots do not refuse curves so level that these speeds lie as far away as one likes. More \
             shots, or a wider range of speeds, would help.",
            listed(&unbounded)
        )
    });
    [of_mix, of_ends].into_iter().flatten().map(|text| folded(&text, WIDTH) + "\n").collect()
}

/// Why there is no curve.
pub fn no_curve(scene: &Scene, series: &Series) -> Option<Error> {
    let speed = unit(&scene.units, SPEED);
    let speeds = series.fates.iter().map(|fate| fate.speed);
    let (least, most) =
        speeds.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), speed| (low.min(speed), high.max(speed)));
    let [low, high] = scene.shots.speeds;
    let [.., undecided, errors] = series.counts();
    let of_others = match undecided + errors {
        0 => "all shots".to_string(),
        _ => format!("{undecided} shots are undecided, {errors} ended with an error, and all others"),
    };
    let far = NEAR_END * (high - low);
    let message = match series.mix {
        _ if series.fates.len() < 2 => format!(
            "{} shots have a known fate, {undecided} are undecided, {errors} ended with an error; allowed: two or more, by a larger extension or \
             what the errors say",
            series.fates.len()
        ),
        Mix::AllThrough => {
            let more = if least - low > far {
                format!("more shots between {low} and {}, or ", number(least))
            } else {
                String::new()
            };
            format!(
                "{of_others} went through, the slowest at {} {speed}, with speeds = [{low}, {high}]; allowed: {more}a range that begins slower",
                number(least)
            )
        }
        Mix::AllStopped => {
            let more = if high - most > far {
                format!("more shots between {} and {high}, or ", number(most))
            } else {
                String::new()
            };
            format!(
                "{of_others} were stopped, the fastest at {} {speed}, with speeds = [{low}, {high}]; allowed: {more}a range that ends faster. \
                 Speeds are in {speed}, of which one is {} m/s",
                number(most),
                1.0 / scene.units.from_si(1.0, SPEED)
            )
        }
        _ if series.curves.is_empty() => {
            format!(
                "{of_others} have one speed, {} {speed}; allowed: a range of speeds, or another design",
                number(least)
            )
        }
        _ => return None,
    };
    Some(Error::Evaluation(format!("no curve: {message}")))
}

fn mean(mean: &Mean, speed: &str) -> String {
    let Mean { each, speed: value, spread } = mean;
    format!("{each} and {each}: {} {speed}, spread {}", number(*value), number(*spread))
}

/// What test houses print.
fn means(scene: &Scene, series: &Series) -> String {
    let speed = unit(&scene.units, SPEED);
    let mut texts: Vec<String> = series.means.iter().map(|found| mean(found, &speed)).collect();
    if let Some((spread, found)) = &series.within {
        let found = found.as_ref().map_or("none".to_string(), |found| mean(found, &speed));
        texts.push(format!("the most within a spread of {} {speed}: {found}", number(*spread)));
    }
    if texts.is_empty() {
        return String::new();
    }
    folded(&format!("Mean of the fastest stops and the slowest perforations, {}.", texts.join("; ")), WIDTH) + "\n"
}

fn residual(scene: &Scene, series: &Series) -> String {
    let Some(fitted) = &series.residual else { return String::new() };
    let (speed, [_, through, ..]) = (unit(&scene.units, SPEED), series.counts());
    let text = match fitted {
        Ok(curve) => {
            let [ratio, exponent, limit, deviation] =
                [curve.ratio, curve.exponent, curve.limit, curve.deviation].map(number);
            format!(
                "Residual speed of {through} perforations (Lambert and Jonas): v_r = {ratio} (v_s^{exponent} - \
                 {limit}^{exponent})^(1/{exponent}), {deviation} {speed} off."
            )
        }
        Err(why) => {
            format!(
                "No curve of the residual speed of {through} perforations (Lambert and Jonas): {}.",
                reason(why, &speed)
            )
        }
    };
    folded(&text, WIDTH) + "\n"
}

/// Which speeds the residual ones are, and what the shots have cost, where some were decided.
fn speeds_and_costs(series: &Series) -> String {
    let decided = series.shots.iter().filter_map(|ended| ended.decision);
    let (count, to_decisions) = decided.fold((0, 0.0), |(count, sum), [_, seconds]| (count + 1, sum + seconds));
    if count == 0 {
        return String::new();
    }
    let of = |is: SpeedIs| {
        let shots =
            series.shots.iter().filter(|ended| ended.residual().is_some() && ended.speed_is == Some(is)).count();
        (shots > 0).then(|| format!("{shots} {}", is.name()))
    };
    let speeds: Vec<String> = SpeedIs::ALL.into_iter().filter_map(of).collect();
    let all: f64 = series.shots.iter().map(|ended| ended.seconds).sum();
    let text = format!(
        "Speeds of the perforations: {}. Processor time {all:.1} s in all; the {count} decided shots took {to_decisions:.1} s to their decisions.",
        speeds.join(", ")
    );
    folded(&text, WIDTH) + "\n"
}

/// Why a curve of residual speeds is none.
fn reason(why: &Degenerate, speed: &str) -> String {
    match why {
        Degenerate::Jump(exponent) => {
            format!("the exponent of the best one is {}, beyond {MOST_EXPONENT}, a jump", number(*exponent))
        }
        Degenerate::Line => "the exponent of the best one goes to 1, a straight line".to_string(),
        Degenerate::OwnSpeed(left) => format!(
            "the limit of the best one is the speed of the slowest perforation, at which {} {speed} were left",
            number(*left)
        ),
        Degenerate::Left(part) => {
            format!("the best one leaves {:.0} % of the variance of the residual speeds", 100.0 * part)
        }
    }
}

/// What target and striker weigh.
fn weights(scene: &Scene) -> String {
    let weights = shot::weights(scene).unwrap_or_default();
    if weights.is_empty() { weights } else { folded(&format!("Weights: {weights}"), WIDTH) + "\n" }
}

/// The shots whose runs are not sound, and those that are so up to their first failure only.
fn unsound(series: &Series) -> String {
    let behind = " (toron fabric or impact, of such a shot by its line in shots.csv, says what to change)";
    let before = series.verdicts().filter(|(_, before, _)| *before != SOUND);
    let after = series.verdicts().filter_map(|(ended, _, after)| Some((ended.shot.number, after?.to_string())));
    of_shots("warning: ", before.map(|(ended, before, _)| (ended.shot.number, before.to_string())), behind)
        + &of_shots("after the first failure of ", after, behind)
}

/// What the errors of shots say.
fn errors_of_shots(series: &Series) -> String {
    let errors = series.shots.iter().filter_map(|ended| match &ended.ending {
        Ending::Error(message) => Some((ended.shot.number, message.replace('\n', " "))),
        _ => None,
    });
    of_shots("error of ", errors, "")
}

/// Warnings or errors of shots: each text once, with the numbers of the shots that share it.
fn of_shots(before: &str, said: impl Iterator<Item = (usize, String)>, behind: &str) -> String {
    let named: Vec<(String, String)> = said.map(|(number, text)| (number.to_string(), text)).collect();
    let groups = grouped(named.iter().map(|(number, text)| (number.as_str(), text.as_str())));
    let group = |(text, numbers): (&str, Vec<&str>)| {
        let shots = if numbers.len() == 1 { "shot" } else { "shots" };
        folded(&format!("{before}{shots} {}: {text}{behind}", numbers.join(", ")), WIDTH) + "\n"
    };
    groups.into_iter().map(group).collect()
}

fn list_files(series: &Series, output: &Path) -> String {
    let written = [
        (true, "shots.csv", "a line for every shot"),
        (true, "shots.scene.toml", "the scene that they are of"),
        (!series.curves.is_empty(), FIGURES, "a line for every curve, and the means"),
        (!series.curves.is_empty(), "v50.svg, .png", "the curves with every shot, and the residual speeds"),
    ];
    files(output, &written)
}

/// Writes the figures.
///
/// # Errors
/// The file cannot be written.
pub fn write_figures(file: &Path, scene: &Scene, series: &Series) -> Result<(), Error> {
    let counts: Vec<(String, String)> = ["stopped", "through", "undecided", "errors"]
        .into_iter()
        .zip(series.counts())
        .map(|(name, count)| (name.to_string(), count.to_string()))
        .collect();
    let exact = |value: Option<f64>, none: &str| value.map_or(none.to_string(), |value| value.to_string());
    let of_curve = |curve: &Curve| {
        let mut line = vec![("curve".to_string(), name(curve))];
        line.extend(counts.clone());
        let mix = match curve.mix {
            Mix::Separated(_) => "separated",
            Mix::Level => "level",
            _ => "mixed",
        };
        line.push(("results".to_string(), mix.to_string()));
        let slope = format!("slope (1/({}))", unit(&scene.units, SPEED));
        let speeds =
            SPEEDS.iter().zip(&curve.speeds).map(|(name, estimate)| (title(name, SPEED, &scene.units), estimate));
        for (name, estimate) in speeds.chain([(slope, &curve.slope)]) {
            let (quantity, unit) = name.split_once(' ').unwrap_or((&name, ""));
            line.push((name.clone(), exact(estimate.value, NONE)));
            line.push((format!("{quantity}_low {unit}"), exact(estimate.interval.low, UNBOUNDED)));
            line.push((format!("{quantity}_high {unit}"), exact(estimate.interval.high, UNBOUNDED)));
        }
        line.push(("log_likelihood".to_string(), curve.log_likelihood().to_string()));
        line
    };
    let of_mean = |mean: &Mean, within: &str| {
        let mut line = vec![("curve".to_string(), format!("mean of {} and {}{within}", mean.each, mean.each))];
        line.extend(counts.clone());
        line.push((title("V50", SPEED, &scene.units), mean.speed.to_string()));
        line.push((title("spread", SPEED, &scene.units), mean.spread.to_string()));
        line
    };
    let means = series.means.iter().map(|mean| of_mean(mean, ""));
    let within = series.within.as_ref().and_then(|(spread, mean)| Some((spread, mean.as_ref()?)));
    let within = within.map(|(spread, mean)| of_mean(mean, &format!(" within {spread}")));
    let lines: Vec<_> = series.curves.iter().map(of_curve).chain(means).chain(within).collect();
    write_csv(file, &lines)
}

/// A line of a table of simulated experiments: design, curve, and what came of them.
pub type Simulated = (String, String, Coverage);

/// The table of simulated experiments.
pub fn simulated(lines: &[Simulated]) -> String {
    let column = |above: &str, below: &str, entry: &dyn Fn(&Simulated) -> String| Column {
        heading: [above.to_string(), below.to_string()],
        entries: lines.iter().map(entry).collect(),
    };
    let share = |share: f64| format!("{share:.3}");
    let mut columns =
        vec![column("design", "", &|(design, ..)| design.clone()), column("curve", "", &|(_, curve, _)| curve.clone())];
    for (place, of) in SPEEDS.into_iter().enumerate() {
        columns.push(column(&format!("{of} in"), "interval", &|(.., found)| or_dash(found.speeds[place], share)));
    }
    columns.extend([
        column(UNBOUNDED, "V50", &|(.., found)| share(found.unbounded)),
        column("separated", "share", &|(.., found)| share(found.separated)),
        column("level", "share", &|(.., found)| share(found.level)),
        column("one fate", "share", &|(.., found)| share(found.one_fate)),
        column("V50 off", "σ", &|(.., found)| or_dash(found.bias, |bias| format!("{bias:+.3}"))),
        column("scatter", "σ", &|(.., found)| or_dash(found.error, share)),
        column("width", "σ", &|(.., found)| or_dash(found.width, |width| format!("{width:.2}"))),
    ]);
    table(columns, WIDTH) + &of_one_fate(lines)
}

/// Where the shots of many experiments have one fate.
fn of_one_fate(lines: &[Simulated]) -> String {
    let often = lines.iter().filter(|(.., found)| found.one_fate > OFTEN);
    let mut designs: Vec<&str> = often.map(|(design, ..)| design.as_str()).collect();
    designs.dedup();
    if designs.is_empty() {
        return String::new();
    }
    let text = format!(
        "All shots of an experiment often have one fate by {}, so that there is no curve, and the shares of the speeds are of the other \
         experiments: speeds nearer to V50, or more shots, would help.",
        listed(&designs)
    );
    format!("\n{}\n", folded(&text, WIDTH))
}

/// Of what a limit is: of nothing that scatters, or of one panel.
fn of_limit(scene: &Scene) -> String {
    match scene.target.strength().filter(|strength| strength.scatters()) {
        None => "Without scatter".to_string(),
        Some(strength) => {
            let at = scene.target.aim().map(|aim| format!(", aimed at {}", aim.map(number).join(", ")));
            format!("With the strengths of seed {}{}", strength.field.seed, at.unwrap_or_default())
        }
    }
}

/// The report on a limit.
pub fn limit(scene: &Scene, found: &super::limit::Limit) -> String {
    let (speed, [low, high]) = (unit(&scene.units, SPEED), found.bracket.map(number));
    let mut text = format!(
        "{}\n\n{}: stopped at {low} {speed}, through at {high} {speed}, {} shots up to {} {}\n",
        scene.title,
        of_limit(scene),
        found.shots,
        number(scene.last()),
        unit(&scene.units, TIME)
    );
    if scene.target.strength().is_some_and(Strength::scatters) {
        let said = "Another seed has another limit: weibull-modulus = inf is without scatter, and shots without --limit are of many seeds.";
        text += &(folded(said, WIDTH) + "\n");
    }
    if let Some([stop, through]) = found.not_monotone.map(|ends| ends.map(number)) {
        let said = format!(
            "The answer is not monotone: a shot at {through} {speed} goes through, and one at {stop} {speed} is stopped. There is no one \
             limit: this is one of the speeds at which the fate changes."
        );
        text += &(folded(&said, WIDTH) + "\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::v50::designs::Design;
    use crate::v50::limit::Limit;
    use crate::v50::link::Link;
    use crate::v50::scene::{Shot, YARN};
    use crate::v50::shot::Ended;
    use crate::v50::simulation::{Experiment, Truth};

    fn said_of(keys: &str, ending: Ending) -> String {
        let scene = Scene::parse("yarn.toml", &format!("{YARN}{keys}"), None).expect("a scene");
        let shot = scene.shot(1, 100.0);
        let ended = Ended {
            ending,
            speed_at_end: 1.0,
            time: 0.4,
            verdict: "sound".to_string(),
            seconds: 1.0,
            ..Ended::of(shot)
        };
        let text = report(&scene, &Series::of(vec![ended], false, None), [5, 2], Path::new("there"));
        // It is folded to the terminal's width.
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    const STRENGTH: &str =
        "[scene.strength]\ncell = 0.8\nreference-length = 50.0\nweibull-modulus = 10.0\nstrain = 0.0458\nseed = 5\n";

    fn yarn() -> Scene {
        Scene::parse("yarn.toml", YARN, None).expect("a scene")
    }

    /// Shots that were stopped at these speeds, and then some that went through at those, with what was left, and
    /// errors with those messages.
    fn series(stops: &[f64], perforations: &[[f64; 2]], errors: &[&str]) -> Series {
        let stopped = stops.iter().map(|&speed| (speed, Ending::Stopped, 0.0));
        let through = perforations.iter().map(|&[speed, left]| (speed, Ending::Through, left));
        let failed = errors.iter().map(|message| (100.0, Ending::Error(message.to_string()), 0.0));
        let shots = (1..).zip(stopped.chain(through).chain(failed)).map(|(number, (speed, ending, speed_at_end))| {
            let shot = Shot { number, nominal: speed, speed, aim: [0.0; 2], seed: None };
            Ended { ending, speed_at_end, time: 0.4, verdict: "sound".to_string(), seconds: 1.0, ..Ended::of(shot) }
        });
        Series::of(shots.collect(), false, None)
    }

    fn through(speeds: &[f64]) -> Vec<[f64; 2]> {
        speeds.iter().map(|&speed| [speed, 20.0]).collect()
    }

    fn printed(series: &Series) -> String {
        report(&yarn(), series, [0, 0], Path::new("there"))
    }

    /// Without values the columns of the intervals stand by themselves, and say what they are of.
    #[test]
    fn intervals_of_separated_shots_are_named() {
        let separated = series(&[100.0, 104.0, 108.0, 112.0], &through(&[116.0, 120.0, 124.0, 128.0]), &[]);
        let text = printed(&separated);
        let lines: Vec<&str> = text.lines().skip_while(|line| !line.starts_with("curve")).take(4).collect();
        let columns = |line: &str| {
            line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(str::to_string).collect::<Vec<_>>()
        };
        assert_eq!(columns(lines[0]), ["curve", "V5, 95 %", "V50, 95 %", "V95, 95 %", "slope, 95 %"]);
        let logit = columns(lines[3]);
        assert!(logit.len() == 5 && logit[4].ends_with("to unbounded"), "{logit:?}");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let wanted = "the fastest stop is at 112.0 mm/ms, the slowest perforation at 116.0 mm/ms. The curve may be a step anywhere between, \
                      whose slope is unbounded";
        assert!(text.contains(wanted), "{text}");
        // With values they stand beside them.
        let mixed = printed(&series(&[100.0, 104.0, 108.0, 118.0], &through(&[110.0, 120.0, 124.0, 128.0]), &[]));
        let heads = mixed.lines().find(|line| line.starts_with("curve")).map(columns).expect("a table");
        assert_eq!(heads[..4], ["curve", "V5", "V5, 95 %", "V50"]);
    }

    /// An interval without end is printed so, whichever speed's it is, and what that means.
    #[test]
    fn unbounded_intervals_are_explained() {
        let text = printed(&series(&[100.0, 120.0], &through(&[110.0, 130.0]), &[]));
        assert!(text.lines().any(|line| line.starts_with("logit") && line.contains("unbounded")), "{text}");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            text.contains("Intervals of V5, V50 and V95 are unbounded: the shots do not refuse curves so level"),
            "{text}"
        );
        assert_eq!(listed(&["V5"]), "V5");
        assert_eq!(listed(&["V5", "V95"]), "V5 and V95");
    }

    /// No speed below 0 is printed.
    #[test]
    fn speeds_below_zero_are_no_figures() {
        assert_eq!((figure(-345.6), figure(34.56)), ("below 0".to_string(), "34.56".to_string()));
        let of = |low, high| interval(&Interval { low, high });
        assert_eq!(of(Some(-3.0), Some(4.0)), "below 0 to 4.000");
        assert_eq!(of(Some(-3.0), Some(-1.0)), "below 0");
        assert_eq!((of(None, Some(4.0)), of(None, None)), ("unbounded to 4.000".to_string(), "unbounded".to_string()));
    }

    /// What errors say is in the report, once for the shots that share it; where there is no curve they come first.
    #[test]
    fn errors_are_told_with_their_shots() {
        let some = series(&[100.0, 104.0], &[], &["no memory", "no\nfile", "no memory"]);
        let text = printed(&some);
        assert!(text.contains("error of shots 3, 5: no memory\nerror of shot 4: no file\n"), "{text}");
        let error = no_curve(&yarn(), &some).expect("no curve").to_string();
        let wanted = "no curve: 0 shots are undecided, 3 ended with an error, and all others were stopped, the fastest at 104.0 mm/ms";
        assert!(error.starts_with(wanted), "{error}");
        let error = no_curve(&yarn(), &series(&[100.0], &[], &["no memory"])).expect("no curve").to_string();
        assert!(
            error.starts_with("no curve: 1 shots have a known fate, 0 are undecided, 1 ended with an error"),
            "{error}"
        );
    }

    /// What would help depends on how far the shots have come in the range, 20 to 300.
    #[test]
    fn one_fate_is_answered_by_what_would_help() {
        let of = |series: &Series| no_curve(&yarn(), series).expect("no curve").to_string();
        let error = of(&series(&[], &through(&[160.0, 120.0]), &[]));
        assert!(error.ends_with("allowed: more shots between 20 and 120.0, or a range that begins slower"), "{error}");
        let error = of(&series(&[], &through(&[160.0, 25.0]), &[]));
        assert!(error.ends_with("speeds = [20, 300]; allowed: a range that begins slower"), "{error}");
        let error = of(&series(&[120.0, 130.0], &[], &[]));
        let wanted = "allowed: more shots between 130.0 and 300, or a range that ends faster. Speeds are in mm/ms, of which one is 1 m/s";
        assert!(error.ends_with(wanted), "{error}");
    }

    /// Speeds at a decision are told from residual ones, and the cost up to it from that of the shots.
    #[test]
    fn speeds_at_the_decision_are_told() {
        let scene = Scene::parse("yarn.toml", YARN, None).expect("a scene");
        let shot = |number: usize, is: SpeedIs, decision: Option<[f64; 2]>| {
            let (ending, speed_is) = (Ending::Through, Some(is));
            Ended {
                ending,
                speed_at_end: 9.0,
                speed_is,
                decision,
                seconds: 3.0,
                ..Ended::of(scene.shot(number, 150.0))
            }
        };
        let shots = vec![
            shot(1, SpeedIs::AtDecision, Some([9.0, 3.0])),
            shot(2, SpeedIs::Residual, Some([9.5, 2.0])),
            shot(3, SpeedIs::Residual, None),
        ];
        let text = speeds_and_costs(&Series::of(shots.clone(), false, None));
        let expected = "Speeds of the perforations: 2 residual, 1 at the decision. Processor time 9.0 s in all; the 2 decided \
                        shots took 5.0 s to their decisions.";
        assert_eq!(text.split_whitespace().collect::<Vec<_>>().join(" "), expected);
        assert_eq!(speeds_and_costs(&Series::of(shots[2..].to_vec(), false, None)), "");
    }

    /// A curve of residual speeds that is none is told with its reason.
    #[test]
    fn a_degenerate_curve_of_residual_speeds_is_not_told() {
        let jump = [[59.9924, 34.99], [59.9971, 40.62], [60.0, 38.23], [60.0047, 44.05], [60.0094, 41.13]];
        let text = printed(&series(&[50.0], &jump, &[]));
        assert!(
            text.contains("No curve of the residual speed of 5 perforations (Lambert and Jonas): the exponent"),
            "{text}"
        );
        assert!(!text.contains("v_r"), "{text}");
    }

    /// Where there are no curves there are no shares of them, and that is said.
    #[test]
    fn experiments_of_one_fate_have_no_shares() {
        let of = |v50: f64| {
            let experiment = Experiment { design: Design::Even, shots: 10, range: [60.0, 140.0], scatter: 1.0 };
            experiment.coverage(&Truth { link: Link::Logit, v50, deviation: 15.0 }, false, 20, 7)
        };
        let line = |design: &str, found: Coverage| (design.to_string(), "logit".to_string(), found);
        let text = simulated(&[line("even", of(400.0)), line("langlie", of(100.0))]);
        let cells: Vec<&str> = text.lines().nth(3).expect("a line").split_whitespace().collect();
        assert_eq!(cells, ["even", "logit", "-", "-", "-", "0.000", "0.000", "0.000", "1.000", "-", "-", "-"]);
        assert!(text.contains("All shots of an experiment often have one fate by even, so that"), "{text}");
        assert!(!simulated(&[line("even", of(100.0))]).contains("one fate by"));
    }

    /// A limit of yarns that scatter is that of one panel, and is not said to be without scatter.
    #[test]
    fn a_limit_says_of_which_strengths_it_is() {
        let found = Limit { bracket: [84.0, 100.0], not_monotone: None, shots: 9 };
        let of =
            |keys: &str| limit(&Scene::parse("yarn.toml", &format!("{YARN}{keys}"), None).expect("a scene"), &found);
        let text = of(STRENGTH);
        assert!(text.contains("With the strengths of seed 5: stopped at 84.00 mm/ms"), "{text}");
        assert!(
            text.contains("weibull-modulus = inf is without scatter") && !text.contains("Without scatter"),
            "{text}"
        );
        for keys in [String::new(), STRENGTH.replace("= 10.0", "= inf")] {
            let text = of(&keys);
            assert!(text.contains("Without scatter: stopped at") && !text.contains("seed"), "{text}");
        }
    }

    /// A series says what its strengths are of, what it leaves out, and what that means.
    #[test]
    fn what_a_curve_is_of_is_said() {
        let text = said_of(STRENGTH, Ending::Undecided);
        for wanted in [
            "m = 10, cells of 0.8 mm, each shot with a seed of its own. Of the other half of a yarn, which symmetry leaves out",
            "Undecided shots are not missing at random",
            "a larger extension than 2 decides them",
            "5 of 6 have not been fired",
            "2 more in the table are not of this series",
        ] {
            assert!(text.contains(wanted), "{wanted}: {text}");
        }
        let text = said_of("", Ending::Stopped);
        assert!(!text.contains("Strength") && !text.contains("at random"), "{text}");
    }
}
