//! The histories in one figure: a panel for each quantity, a line for each history.

use std::path::Path;

use toron::host::units::UnitSystem;

use super::history::{History, QUANTITIES};
use toron_materials::units::{TIME, unit};
use toron_pictures::history;
use toron_pictures::panel::{Abscissa, Panel, Series};
use toron_pictures::style::COLOURS;
use toron_shared::error::Error;

/// Points of a line.
const POINTS: usize = 1000;

/// # Errors
/// A file cannot be written.
pub fn write(svg: &Path, png: &Path, histories: &[&History], units: &UnitSystem) -> Result<(), Error> {
    let end = histories.iter().map(|history| history.end()).fold(0.0, f64::max);
    let times: Vec<f64> = (0..=POINTS).map(|i| end * i as f64 / POINTS as f64).collect();
    let panels = QUANTITIES.iter().map(|row| {
        let lines = histories.iter().zip(COLOURS.iter().cycle()).filter_map(|(history, &colour)| {
            let curve = history.curve(row.quantity)?;
            // A gap is where the history has nothing.
            let values = times.iter().map(|&time| curve.at(time).unwrap_or(f64::NAN)).collect();
            Some(Series { name: history.name.clone(), colour, values })
        });
        Panel::new(row.title, &unit(units, row.dimension), lines.collect())
    });
    let label = format!("time ({})", unit(units, TIME));
    let abscissa = Abscissa { label, values: times.clone(), failure: None };
    let [title, subtitle] = heading(histories);
    history::write(svg, png, [&title, &subtitle], panels, &abscissa)
}

/// What hosts there are, and the names of the histories: one that says its host says it alone, and so does the title
/// where there is one host.
fn heading(histories: &[&History]) -> [String; 2] {
    let one_host = histories.iter().all(|history| history.host == histories[0].host);
    let of_host = |history: &History| match one_host || history.name.contains(history.host) {
        true => history.name.clone(),
        false => format!("{}: {}", history.name, history.host),
    };
    let title = match histories {
        [first, ..] if one_host => format!("Runs of {}", first.host),
        _ => "The same strike in several hosts".to_string(),
    };
    let names: Vec<String> = histories.iter().copied().map(of_host).collect();
    [title, names.join("; ")]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_host_stands_once_in_the_heading() {
        let of = |histories: [(&'static str, &str); 2]| {
            let [one, other] = histories.map(|(host, name)| History::new(host, name.to_string()));
            heading(&[&one, &other])
        };
        assert_eq!(of([("toron", "soft"), ("toron", "stiff")]), ["Runs of toron", "soft; stiff"]);
        let both = of([("toron", "toron"), ("OpenRadioss", "long steps")]);
        assert_eq!(both, ["The same strike in several hosts", "toron; long steps: OpenRadioss"]);
    }
}
