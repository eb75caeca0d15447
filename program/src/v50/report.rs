//! The report of a series, its table of figures, and those of simulated experiments.

use std::path::Path;

use super::curve::{Curve, Estimate, Interval, Mix};
use super::scene::Scene;
use super::series::Series;
use super::simulation::Coverage;
use super::test_houses::Mean;
use crate::common::error::Error;
use crate::common::text_table::{Column, NONE, files, folded, grouped, or_dash, table, write_csv};
use crate::common::units::{SPEED, TIME, number, unit};
use crate::strength::scatter;
use crate::struck::history::title;

/// Columns of a terminal.
const WIDTH: usize = 129;
const UNBOUNDED: &str = "unbounded";
/// The names of the speeds, in their order.
const SPEEDS: [&str; 3] = ["V5", "V50", "V95"];
pub const FIGURES: &str = "v50.csv";

/// An end of an interval, as it is printed.
fn end(end: Option<f64>) -> String {
    end.map_or(UNBOUNDED.to_string(), number)
}

fn interval(Interval { low, high }: &Interval) -> String {
    match (low, high) {
        (None, None) => UNBOUNDED.to_string(),
        _ => format!("{} to {}", end(*low), end(*high)),
    }
}

fn name(curve: &Curve) -> String {
    format!("{}{}", curve.link.name(), if curve.firth { ", Firth" } else { "" })
}

/// What came of the series; `missing` is how many of its shots have not been fired, and `beside` how many others stand in the table.
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
        folded(&counts, WIDTH) + "\n" + &strength(scene) + &of_undecided(scene, undecided),
        curves(scene, series),
        said(scene, series),
        means(scene, series),
        residual(scene, series),
        unsound(series),
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
    let value = |estimate: &Estimate| or_dash(estimate.value, number);
    let mut columns = vec![column("curve", "", &name)];
    for (place, of) in SPEEDS.into_iter().enumerate() {
        columns.push(column(of, &speed, &|curve| value(&curve.speeds[place])));
        columns.push(column("95 %", &speed, &|curve| interval(&curve.speeds[place].interval)));
    }
    columns.push(column("slope at V50", &format!("1/({speed})"), &|curve| value(&curve.slope)));
    columns.push(column("95 %", &format!("1/({speed})"), &|curve| interval(&curve.slope.interval)));
    table(columns, WIDTH)
}

/// What there is to say of the curves.
fn said(scene: &Scene, series: &Series) -> String {
    let speed = unit(&scene.units, SPEED);
    let text = match series.mix {
        Mix::Separated([stop, through]) => format!(
            "No zone of mixed results: the fastest stop is at {} {speed}, the slowest perforation at {} {speed}. The curve may be a step \
             anywhere between, and the likelihood has no one largest place; the intervals are what the shots do not refuse. More shots \
             between these two speeds would help, or --firth.",
            number(stop),
            number(through)
        ),
        Mix::Level => "No curve that rises with the speed suits the shots better than a level one: a wider range of speeds, or more \
                       shots, would help."
            .to_string(),
        Mix::Mixed if series.curves.iter().any(|curve| !curve.v50().interval.is_bounded()) => {
            "The shots do not refuse a level curve, so that an interval is without bound: more shots, or a wider range of speeds, \
             would help."
                .to_string()
        }
        Mix::Mixed | Mix::AllThrough | Mix::AllStopped => return String::new(),
    };
    folded(&text, WIDTH) + "\n"
}

/// Why there is no curve.
pub fn no_curve(scene: &Scene, series: &Series) -> Option<Error> {
    let speed = unit(&scene.units, SPEED);
    let speeds = series.fates.iter().map(|fate| fate.speed);
    let (least, most) =
        speeds.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), speed| (low.min(speed), high.max(speed)));
    let [low, high] = scene.shots.speeds;
    let message = match series.mix {
        _ if series.fates.len() < 2 => {
            format!("{} shots have a known fate; allowed: two or more, or a later end", series.fates.len())
        }
        Mix::AllThrough => format!(
            "all shots went through, the slowest at {} {speed}, with speeds = [{low}, {high}]; allowed: a range that begins slower",
            number(least)
        ),
        Mix::AllStopped => format!(
            "all shots were stopped, the fastest at {} {speed}, with speeds = [{low}, {high}]; allowed: a range that ends faster",
            number(most)
        ),
        _ if series.curves.is_empty() => {
            format!(
                "all shots have one speed, {} {speed}; allowed: a range of speeds, or another design",
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
    let Some(curve) = series.residual else { return String::new() };
    let (speed, [_, through, ..]) = (unit(&scene.units, SPEED), series.counts());
    let [ratio, exponent, limit, deviation] = [curve.ratio, curve.exponent, curve.limit, curve.deviation].map(number);
    let text = format!(
        "Residual speed of {through} perforations (Lambert and Jonas): v_r = {ratio} (v_s^{exponent} - {limit}^{exponent})^(1/{exponent}), \
         {deviation} {speed} off."
    );
    folded(&text, WIDTH) + "\n"
}

/// The shots whose runs are not sound.
fn unsound(series: &Series) -> String {
    let named: Vec<(String, &str)> =
        series.unsound().map(|ended| (ended.shot.number.to_string(), ended.verdict.as_str())).collect();
    let groups = grouped(named.iter().map(|(number, verdict)| (number.as_str(), *verdict)));
    let group = |(verdict, numbers): (&str, Vec<&str>)| {
        let shots = if numbers.len() == 1 { "shot" } else { "shots" };
        let text =
            format!("warning: {shots} {}: {verdict} (docs/guides/fabric.md says what to do)", numbers.join(", "));
        folded(&text, WIDTH) + "\n"
    };
    groups.into_iter().map(group).collect()
}

fn list_files(series: &Series, output: &Path) -> String {
    let written = [
        (true, "shots.csv", "a line for every shot"),
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
        columns.push(column(&format!("{of} in"), "interval", &|(.., found)| share(found.speeds[place])));
    }
    columns.extend([
        column(UNBOUNDED, "V50", &|(.., found)| share(found.unbounded)),
        column("separated", "share", &|(.., found)| share(found.separated)),
        column("level", "share", &|(.., found)| share(found.level)),
        column("one fate", "share", &|(.., found)| share(found.one_fate)),
        column("V50 off", "σ", &|(.., found)| format!("{:+.3}", found.bias)),
        column("scatter", "σ", &|(.., found)| share(found.error)),
        column("width", "σ", &|(.., found)| or_dash(found.width, |width| format!("{width:.2}"))),
    ]);
    table(columns, WIDTH)
}

/// The report on a limit.
pub fn limit(scene: &Scene, found: &super::limit::Limit) -> String {
    let (speed, [low, high]) = (unit(&scene.units, SPEED), found.bracket.map(number));
    let mut text = format!(
        "{}\n\nWithout scatter: stopped at {low} {speed}, through at {high} {speed}, {} shots up to {} {}\n",
        scene.title,
        found.shots,
        number(scene.last()),
        unit(&scene.units, TIME)
    );
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
    use crate::v50::scene::YARN;
    use crate::v50::shot::{Ended, Ending};

    fn said_of(keys: &str, ending: Ending) -> String {
        let scene = Scene::parse("yarn.toml", &format!("{YARN}{keys}"), None).expect("a scene");
        let shot = scene.shot(1, 100.0);
        let ended = Ended { shot, ending, speed_at_end: 1.0, time: 0.4, verdict: "sound".to_string(), seconds: 1.0 };
        let text = report(&scene, &Series::of(vec![ended], false, None), [5, 2], Path::new("there"));
        // It is folded to the terminal's width.
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// A series says what its strengths are of, what it leaves out, and what that means.
    #[test]
    fn what_a_curve_is_of_is_said() {
        let strength =
            "[scene.strength]\ncell = 0.8\nreference-length = 50.0\nweibull-modulus = 10.0\nstrain = 0.0458\n";
        let text = said_of(strength, Ending::Undecided);
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
