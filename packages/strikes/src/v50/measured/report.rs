//! The report on measured shots, and on two tables of them.

use super::Measured;
use super::compare::{Difference, POWER};
use crate::v50::analysis::Analysis;
use crate::v50::curve::Mix;
use crate::v50::curves_report::{Steepness, WIDTH, curves, figure, interval, means, paragraph, percent, said};
use toron_shared::error::Error;
use toron_shared::numbers::number;
use toron_shared::text_table::{Column, or_dash, table};

/// What a table of shots tells.
pub fn report(measured: &Measured, told: &Analysis) -> String {
    let speed = &measured.unit.text;
    let scale =
        if told.curves.is_empty() { "" } else { "The scale is the σ of the probit, and the s of the logit.\n" };
    let table = curves(told, speed, Steepness::Scale) + scale;
    let parts = [head(measured, told), table, said(told, speed), means(told, speed)];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n")
}

fn head(measured: &Measured, told: &Analysis) -> String {
    let Measured { name, without_fate, left_out, notes, unit, .. } = measured;
    let speed = &unit.text;
    let all = told.fates.len() + without_fate.len() + left_out.len();
    let [stopped, through] = [false, true].map(|through| told.count(through));
    let mut text = paragraph(&format!(
        "{name}: {all} shots: {stopped} stopped, {through} through, {} without a fate, {} left out",
        without_fate.len(),
        left_out.len()
    ));
    notes.iter().for_each(|note| text += &paragraph(note));
    if told.asked.logarithm {
        text += "The curves are over the logarithm of the speed.\n";
    }
    text += &of_lines(without_fate, speed);
    left_out.iter().for_each(|(line, why)| text += &paragraph(&format!("Left out, line {line}: {why}")));
    text
}

/// The lines without a fate.
fn of_lines(without_fate: &[(usize, Option<f64>)], unit: &str) -> String {
    let of = |(line, speed): &(usize, Option<f64>)| match speed {
        Some(speed) => format!("{line} ({} {unit})", number(*speed)),
        None => format!("{line} (no speed)"),
    };
    let listed: Vec<String> = without_fate.iter().map(of).collect();
    match listed.len() {
        0 => String::new(),
        1 => paragraph(&format!("Without a fate, line {}", listed[0])),
        _ => paragraph(&format!("Without a fate, lines {}", listed.join(", "))),
    }
}

/// Why a table has no curve.
pub fn no_curve(measured: &Measured, told: &Analysis) -> Option<Error> {
    let speed = &measured.unit.text;
    let [least, most] = told.range().map(number);
    let message = match (told.fates.len(), told.mix) {
        (0, _) => "no shot is kept that has a fate; allowed: two or more".to_string(),
        (1, _) => "one shot is kept that has a fate; allowed: two or more, a stop and a perforation".to_string(),
        (_, Mix::AllThrough) => {
            format!(
                "all shots went through, the slowest at {least} {speed}; allowed: a stop among them, by slower shots"
            )
        }
        (_, Mix::AllStopped) => {
            format!("all shots were stopped, the fastest at {most} {speed}; allowed: a perforation, by faster shots")
        }
        _ if told.curves.is_empty() => format!("all shots have one speed, {least} {speed}; allowed: several speeds"),
        _ => return None,
    };
    Some(Error::Evaluation(format!("{}: no curve: {message}", measured.name)))
}

/// How far two tables are apart.
pub fn difference(tables: [&Measured; 2], told: [&Analysis; 2], found: &[Difference]) -> String {
    let [first, second] = tables;
    let (asked, speed) = (&told[0].asked, &first.unit.text);
    let unit = if asked.logarithm { "-" } else { speed };
    let what = if asked.logarithm { "ratio of V50" } else { "difference" };
    let level = percent(asked.level);
    let column = |above: &str, below: &str, entry: &dyn Fn(&Difference) -> String| Column {
        heading: [above.to_string(), below.to_string()],
        entries: found.iter().map(entry).collect(),
    };
    let signed = |value: f64| if asked.logarithm { figure(value) } else { number(value) };
    let ends = |found: &Difference| {
        let [low, high] = [found.estimate.interval.low, found.estimate.interval.high];
        if asked.logarithm {
            interval(&found.estimate.interval)
        } else {
            [low, high].map(|end| end.map_or("unbounded".to_string(), number)).join(" to ")
        }
    };
    let columns = vec![
        column("curve", "", &|found| found.link.name().to_string()),
        column(what, unit, &|found| or_dash(found.estimate.value, signed)),
        column(&format!("{what}, {level} %"), unit, &ends),
        column("one V50:", "deviance", &|found| number(found.one_v50[0])),
        column("chance of", "so much", &|found| number(found.one_v50[1])),
        column("one curve:", "deviance", &|found| number(found.one_curve[0])),
        column("chance of", "so much", &|found| number(found.one_curve[1])),
        column("would show", unit, &|found| or_dash(found.least, number)),
    ];
    let head = if asked.logarithm { "V50 of {b} over that of {a}" } else { "V50 of {b} less that of {a}" };
    let head = head.replace("{b}", &second.name).replace("{a}", &first.name);
    format!("{}\n{}\n{}", paragraph(&head), table(columns, WIDTH), meaning(asked.level, asked.logarithm, unit, found))
}

/// What a difference proves, and what its absence does not.
fn meaning(level: f64, logarithm: bool, unit: &str, found: &[Difference]) -> String {
    let Some(last) = found.last() else { return String::new() };
    let refused = last.one_v50[1] < 1.0 - level;
    let would_show = match last.least {
        None => "So many shots would show no difference, however large: its interval has no end.".to_string(),
        Some(least) => {
            let size =
                if logarithm { format!("a ratio of {}", number(least)) } else { format!("{} {unit}", number(least)) };
            format!("So many shots would show {size} or more in {} of 100 such pairs of tests.", percent(POWER))
        }
    };
    let text = if refused {
        format!("The shots refuse one V50 for both (by the {}). {would_show}", last.link.name())
    } else {
        format!(
            "The shots do not refuse one V50 for both (by the {}). That proves none: whatever lies in the interval is not refused either. \
             {would_show}",
            last.link.name()
        )
    };
    paragraph(&text)
}
