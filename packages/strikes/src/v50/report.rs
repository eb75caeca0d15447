//! The report of a series, its table of figures, and those of simulated experiments.

use std::path::Path;

use super::curve::Mix;
use super::curves_report::{Steepness, UNBOUNDED, WIDTH, curves, figures, listed, means, said};
use super::lambert_jonas::{Degenerate, MOST_EXPONENT};
use super::scene::Scene;
use super::series::Series;
use super::shot::{self, Ending};
use super::simulation::Coverage;
use crate::residual::SpeedIs;
use crate::strength::scatter::{self, Strength};
use toron_explicit_host::judgement::SOUND;
use toron_materials::units::{SPEED, TIME, unit};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::text_table::{Column, files, folded, grouped, or_dash, table, write_csv};

/// A range whose end is further than this part of it from all shots has not been looked at there.
const NEAR_END: f64 = 0.1;
/// Where more of the experiments than this have no curve, or are separated, it is said.
const OFTEN: f64 = 0.05;
/// The names of the speeds, in their order.
const SPEEDS: [&str; 3] = ["V5", "V50", "V95"];
pub const FIGURES: &str = "v50.csv";

/// What came of the series; `missing` is how many of its shots have not been fired, and `beside` how many others stand
/// in the table.
pub fn report(scene: &Scene, series: &Series, [missing, beside]: [usize; 2], output: &Path) -> String {
    let (speed, [stopped, through, undecided, errors]) = (unit(&scene.units, SPEED), series.counts());
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
        curves(&series.told, &speed, Steepness::Slope),
        said(&series.told, &speed),
        means(&series.told, &speed),
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

/// Why there is no curve.
pub fn no_curve(scene: &Scene, series: &Series) -> Option<Error> {
    let speed = unit(&scene.units, SPEED);
    let [least, most] = series.told.range();
    let [low, high] = scene.shots.speeds;
    let [.., undecided, errors] = series.counts();
    let of_others = match undecided + errors {
        0 => "all shots".to_string(),
        _ => format!("{undecided} shots are undecided, {errors} ended with an error, and all others"),
    };
    let far = NEAR_END * (high - low);
    let message = match series.told.mix {
        _ if series.told.fates.len() < 2 => format!(
            "{} shots have a known fate, {undecided} are undecided, {errors} ended with an error; allowed: two or more, by a larger extension or \
             what the errors say",
            series.told.fates.len()
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
        _ if series.told.curves.is_empty() => {
            format!(
                "{of_others} have one speed, {} {speed}; allowed: a range of speeds, or another design",
                number(least)
            )
        }
        _ => return None,
    };
    Some(Error::Evaluation(format!("no curve: {message}")))
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
        (!series.told.curves.is_empty(), FIGURES, "a line for every curve, and the means"),
        (!series.told.curves.is_empty(), "v50.svg, .png", "the curves with every shot, and the residual speeds"),
    ];
    files(output, &written)
}

/// Writes the figures.
///
/// # Errors
/// The file cannot be written.
pub fn write_figures(file: &Path, scene: &Scene, series: &Series) -> Result<(), Error> {
    let counts = ["stopped", "through", "undecided", "errors"].into_iter().zip(series.counts());
    let counts: Vec<(String, String)> = counts.map(|(name, count)| (name.to_string(), count.to_string())).collect();
    write_csv(file, &figures(&series.told, &unit(&scene.units, SPEED), &counts))
}

/// A line of a table of simulated experiments: design, curve, and what came of them.
pub type Simulated = (String, String, Coverage);

/// The table of simulated experiments, and of the separated ones among them where these are many.
pub fn simulated(lines: &[Simulated]) -> String {
    let all: Vec<&Simulated> = lines.iter().collect();
    let mut columns = shares_of_speeds(&all, |found| found.speeds);
    let column = |above: &str, below: &str, entry: &dyn Fn(&Coverage) -> String| column_of(&all, above, below, entry);
    columns.extend([
        column(UNBOUNDED, "V50", &|found| three_digits(found.unbounded)),
        column("separated", "share", &|found| three_digits(found.separated)),
        column("level", "share", &|found| three_digits(found.level)),
        column("one fate", "share", &|found| three_digits(found.one_fate)),
        column("V50 off", "σ", &|found| or_dash(found.bias, |bias| format!("{bias:+.3}"))),
        column("scatter", "σ", &|found| or_dash(found.error, three_digits)),
        column("width", "σ", &|found| or_dash(found.width, |width| format!("{width:.2}"))),
    ]);
    let mut text = table(columns, WIDTH);
    let separated: Vec<&Simulated> = lines.iter().filter(|(.., found)| found.separated > OFTEN).collect();
    if !separated.is_empty() {
        let shares = table(shares_of_speeds(&separated, |found| found.speeds_where_separated), WIDTH);
        text +=
            &format!("\nOf the experiments that are separated (without a zone of mixed results) alone:\n\n{shares}");
    }
    text + &of_one_fate(lines)
}

/// Designs, curves, and how often the intervals of the speeds hold.
fn shares_of_speeds(lines: &[&Simulated], speeds: impl Fn(&Coverage) -> [Option<f64>; 3]) -> Vec<Column> {
    let name = |heading: &str, entry: &dyn Fn(&Simulated) -> String| Column {
        heading: [heading.to_string(), String::new()],
        entries: lines.iter().map(|line| entry(line)).collect(),
    };
    let mut columns =
        vec![name("design", &|(design, ..)| design.clone()), name("curve", &|(_, curve, _)| curve.clone())];
    for (place, of) in SPEEDS.into_iter().enumerate() {
        let entry = |found: &Coverage| or_dash(speeds(found)[place], three_digits);
        columns.push(column_of(lines, &format!("{of} in"), "interval", &entry));
    }
    columns
}

fn column_of(lines: &[&Simulated], above: &str, below: &str, entry: &dyn Fn(&Coverage) -> String) -> Column {
    Column {
        heading: [above.to_string(), below.to_string()],
        entries: lines.iter().map(|(.., found)| entry(found)).collect(),
    }
}

fn three_digits(share: f64) -> String {
    format!("{share:.3}")
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
mod tests;
