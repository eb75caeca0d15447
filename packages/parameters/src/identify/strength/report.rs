//! What a fit of strengths says on the terminal, and its files.

use super::file::{Found, Set, StrengthJob};
use crate::identify::data_sheet::{STRAINS, STRENGTHS};
use crate::identify::report::{digits, line};
use rayon::prelude::*;
use toron::host::units::UnitSystem;
use toron::law::parameters::NUMBER;
use toron_materials::units::{LENGTH, unit};
use toron_strikes::strength::fit::{self, Estimate, Fit, Test, probability_of_one_law};
use toron_strikes::strength::scales::{ScaleFit, contradiction};

/// So many lines of strengths that no fibre has are named one by one.
const MOST_NAMED: usize = 3;
/// A law that tests contradict by chance in fewer cases is in doubt.
const DOUBT: f64 = 0.05;

/// The sets, one after another.
pub fn report(job: &StrengthJob) -> String {
    let sets: String = job.sets.iter().map(|set| of_set(set, &job.units)).collect();
    format!("{}\n{sets}", job.title)
}

fn of_set(set: &Set, units: &UnitSystem) -> String {
    let (modulus, scale, reference) = set.law();
    let length = unit(units, LENGTH);
    let mut text = match &set.found {
        Found::Tests { tests, .. } => line(&set.name, &tested(tests)),
        Found::Scales { lengths, .. } => line(&set.name, &format!("scales at {} lengths", lengths.len())),
    };
    text += &line("m", &interval(&modulus, ""));
    let place = format!(" at {} {length}", digits(reference));
    text += &line("scale", &interval(&scale, &(strength_unit(set, units) + &place)));
    let notes = [set.said.clone(), beyond_fibres(set, units), notes(set, units)].concat();
    text + &notes.iter().map(|note| line("note", note)).collect::<String>()
}

/// Strengths that no fibre has.
fn beyond_fibres(set: &Set, units: &UnitSystem) -> Vec<String> {
    let (known, scale, unit) = match set.dimension == NUMBER {
        true => (STRAINS, 1.0, String::new()),
        false => (STRENGTHS, 1.0 / units.from_si(1.0, set.dimension), strength_unit(set, units)),
    };
    let is_beyond = |value: f64| !(known.range[0]..=known.range[1]).contains(&(value * scale));
    let slip = "it is most likely in another unit than it is said to be, or none of the yarn";
    let of_test = |(test, line): (&Test, &usize)| {
        // A yarn that has slipped at once is only known to be stronger.
        let wrong = test.broken && is_beyond(test.strength);
        wrong.then(|| format!("line {line} has {}{unit}; {}: {slip}", digits(test.strength), known.text))
    };
    match &set.found {
        Found::Tests { tests, lines, .. } => {
            let all: Vec<String> = tests.iter().zip(lines).filter_map(of_test).collect();
            let more = all.len().saturating_sub(MOST_NAMED);
            let more = (more > 0).then(|| format!("{more} further lines have such strengths"));
            all.into_iter().take(MOST_NAMED).chain(more).collect()
        }
        Found::Scales { fit, .. } if is_beyond(fit.scale.value) => {
            vec![format!("the scale is {}{unit}; {}: {slip}", digits(fit.scale.value), known.text)]
        }
        Found::Scales { .. } => Vec::new(),
    }
}

/// The test without which the others' interval does not hold what all have together, nor that of all what the others
/// have.
fn decisive(tests: &[Test], lines: &[usize], fit: &Fit, unit: &str) -> Option<String> {
    let without = |place: usize| {
        let rest: Vec<Test> = [&tests[..place], &tests[place + 1..]].concat();
        let rest = fit::fit(&rest, fit.reference_length).ok()?;
        let of = |name: &'static str, with: Estimate, rest: Estimate| {
            let holds = |of: &Estimate, value: f64| of.low <= value && value <= of.high;
            let is_out = !holds(&rest, with.value) && !holds(&with, rest.value);
            is_out.then(|| (name, with, rest, (with.value / rest.value).ln().abs()))
        };
        let m = of("m", fit.modulus, rest.modulus);
        m.or_else(|| of("scale", fit.scale, rest.scale)).map(|found| (place, found))
    };
    let all = (0..tests.len()).into_par_iter().filter_map(without).collect::<Vec<_>>();
    let (place, (name, with, rest, _)) = all.into_iter().max_by(|a, b| a.1.3.total_cmp(&b.1.3))?;
    Some(format!(
        "{name} is decided by one test, {}{unit} of line {}: without it {name} is {} (95 %: {}), and {} with it. Nothing is left \
         out by itself; a reason in a column excluded does that",
        digits(tests[place].strength),
        lines[place],
        digits(rest.value),
        ends(&rest),
        digits(with.value)
    ))
}

/// How many tests there were.
fn tested(tests: &[Test]) -> String {
    let broken = tests.iter().filter(|test| test.broken).count();
    let mut lengths: Vec<f64> = tests.iter().map(|test| test.length).collect();
    lengths.sort_by(f64::total_cmp);
    lengths.dedup();
    let lengths = if lengths.len() == 1 { "one length".to_string() } else { format!("{} lengths", lengths.len()) };
    let slipped = if broken == tests.len() { String::new() } else { format!(", {broken} of which have broken") };
    format!("{} tests at {lengths}{slipped}", tests.len())
}

fn strength_unit(set: &Set, units: &UnitSystem) -> String {
    if set.dimension == NUMBER { String::new() } else { format!(" {}", unit(units, set.dimension)) }
}

/// A value and its interval; a bound that there is not is called so.
fn interval(estimate: &Estimate, unit: &str) -> String {
    format!("{}{unit}, 95 %: {}", digits(estimate.value), ends(estimate))
}

fn ends(Estimate { low, high, .. }: &Estimate) -> String {
    match (*low > 0.0, high.is_finite()) {
        (true, true) => format!("{} to {}", digits(*low), digits(*high)),
        (true, false) => format!("{} and more, without limit", digits(*low)),
        (false, true) => format!("up to {}, without a lower limit", digits(*high)),
        (false, false) => "anything".to_string(),
    }
}

fn notes(set: &Set, units: &UnitSystem) -> Vec<String> {
    match &set.found {
        Found::Tests { tests, lines, fit } => {
            let decisive = decisive(tests, lines, fit, &strength_unit(set, units));
            decisive.into_iter().chain(of_tests(tests, fit)).collect()
        }
        Found::Scales { fit, longer, moduli, .. } => of_scales(fit, longer.as_ref(), moduli, &unit(units, LENGTH)),
    }
}

fn of_tests(tests: &[Test], fit: &Fit) -> Vec<String> {
    let mut notes = Vec::new();
    if let Some(probability) = probability_of_one_law(tests, fit) {
        let verdict = if probability < DOUBT {
            "these lengths contradict one law of Weibull: m and scale are of no one yarn"
        } else {
            "nothing speaks against one law of Weibull for all lengths"
        };
        notes.push(format!("{verdict} (likelihood ratio to a law for each, p = {})", digits(probability)));
    }
    if fit.modulus.value <= 1.0 {
        notes.push("m is not above 1, which no scene takes: some tests are of another kind than the rest".to_string());
    }
    notes.push("the correlation length is not told: cells of any length give these strengths".to_string());
    notes
}

fn of_scales(fit: &ScaleFit, longer: Option<&(f64, ScaleFit)>, moduli: &[f64], length: &str) -> Vec<String> {
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let mut notes = vec![format!("the law is within {} of the scales", percent(fit.farthest()))];
    if let Some(tests) = contradiction(moduli) {
        let [least, most] =
            [moduli.iter().copied().fold(f64::INFINITY, f64::min), moduli.iter().copied().fold(0.0, f64::max)];
        notes.push(format!(
            "the moduli found at each length, {} to {}, contradict one law of Weibull if {tests} tests or more were made at each: its \
             moduli would differ by less in 95 of 100 cases",
            digits(least),
            digits(most)
        ));
    }
    if let Some((cell, longer)) = longer {
        notes.push(format!(
            "the correlation length is not told: if yarns had whole cells at their ends, so that L + cell counts in place of L, one of {} {length} \
             would fit too, within {}, with m = {}",
            digits(*cell),
            percent(longer.farthest()),
            digits(longer.modulus.value)
        ));
    }
    notes
}

/// The table that a scene takes.
pub fn table(job: &StrengthJob, set: &Set) -> String {
    let (modulus, scale, reference) = set.law();
    let length = unit(&job.units, LENGTH);
    let (key, strength, beside) = if set.dimension == NUMBER {
        ("strain", String::new(), "")
    } else {
        ("stress", unit(&job.units, set.dimension) + ", ", "; with the hyperelastic law beside elastic-modulus")
    };
    let said: String = set.said.iter().map(|said| format!("# {}\n", said.replace('\n', " "))).collect();
    format!(
        "# {}: {}, in {}.\n{said}[scene.strength]\n# cell, the correlation length, is not told by these strengths.\n\
         reference-length = {reference:?} # {length}\nweibull-modulus = {:?} # 95 %: {}\n{key} = {:?} # {strength}95 %: {}{beside}\n",
        job.title,
        set.name,
        job.units.names().join("-"),
        modulus.value,
        ends(&modulus),
        scale.value,
        ends(&scale),
    )
}

/// Lines of a table: set, quantity, value, unit, ends of the interval.
pub fn lines(job: &StrengthJob) -> Vec<Vec<(&'static str, String)>> {
    let of_set = |set: &Set| {
        let (modulus, scale, reference) = set.law();
        let name = set.name.clone();
        [("weibull_modulus", modulus, "-".to_string()), ("scale", scale, unit(&job.units, set.dimension))].map(
            |(quantity, estimate, unit)| {
                vec![
                    ("set", name.clone()),
                    ("quantity", quantity.to_string()),
                    ("value", estimate.value.to_string()),
                    ("unit", unit),
                    ("low_95", estimate.low.to_string()),
                    ("high_95", estimate.high.to_string()),
                    ("reference_length", reference.to_string()),
                ]
            },
        )
    };
    job.sets.iter().flat_map(of_set).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use toron_strikes::strength::weibull::Weibull;

    /// Of tests of one yarn one is hardly ever named.
    #[test]
    fn scatter_decides_nothing() {
        let law = Weibull { modulus: 10.0, scale: 2000.0, reference_length: 50.0 };
        for (count, most) in [(5, 20), (10, 8), (20, 1)] {
            let named = |seed| {
                let mut random = fastrand::Rng::with_seed(seed);
                let mut test = || Test { strength: law.quantile(50.0, 1.0 - random.f64()), length: 50.0, broken: true };
                let tests: Vec<Test> = (0..count).map(|_| test()).collect();
                let fit = fit::fit(&tests, 50.0).expect("a fit");
                decisive(&tests, &vec![1; count], &fit, "").is_some()
            };
            let named = (0..200).filter(|&seed| named(seed)).count();
            println!("{named} of 200 with {count} tests");
            assert!(named <= most, "{named} of 200 with {count} tests");
        }
    }
}
