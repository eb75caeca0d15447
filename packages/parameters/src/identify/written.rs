//! The file that `toron fit` reads, as commands write it that compute the energies of a section.

use std::fmt::Write;

use toron::host::units::UnitSystem;

/// The energies' standard deviation, over the largest of a load: computed, they have no noise that could be estimated,
/// and where the law follows one load better than another this one would count for nothing.
pub const DEVIATION: f64 = 0.01;
/// Few fibres at random are one sample of many, and energy falls where some of them snap to another place.
pub const RANDOM_DEVIATION: f64 = 0.05;

/// What is in the file, in its units.
pub struct Written<'a> {
    pub title: &'a str,
    pub units: &'a UnitSystem,
    pub name: &'a str,
    pub source: &'a str,
    /// Of the yarn.
    pub density: Option<f64>,
    pub fibre: Option<Fibre>,
    pub sets: Vec<Set>,
}

/// A fibre's modulus and strain at failure, and the fibres' part of the yarn.
pub struct Fibre {
    pub modulus: f64,
    pub volume_fraction: f64,
    pub strain_at_failure: f64,
}

/// The energies of a load, in the file NAME.csv.
pub struct Set {
    pub name: String,
    pub loading: &'static str,
    /// The abscissa, if it is not the first known one, and the columns of quantities that are called otherwise.
    pub abscissa: Option<&'static str>,
    pub columns: Vec<[&'static str; 2]>,
    /// Of the abscissa, where the curve goes on beyond what is elastic.
    pub range: Option<[f64; 2]>,
    /// The largest energy, and the energies' standard deviation as a part of it.
    pub deviation: Option<[f64; 2]>,
}

impl Written<'_> {
    /// As TOML.
    pub fn text(&self) -> String {
        let [length, mass, time] = self.units.names();
        let mut text = format!(
            "title = {}\nunits = \"{length}-{mass}-{time}\"\n\n[yarn]\nname = {}\nsource = {}\n",
            quoted(self.title),
            quoted(self.name),
            quoted(self.source)
        );
        if let Some(density) = self.density {
            let _ = writeln!(text, "density = {}", rounded(density));
        }
        if let Some(fibre) = &self.fibre {
            let _ = write!(
                text,
                "\n[fibre]\nmodulus = {}\nvolume_fraction = {}\nstrain_at_failure = {:?}\n",
                rounded(fibre.modulus),
                rounded(fibre.volume_fraction),
                fibre.strain_at_failure
            );
        }
        for Set { name, loading, abscissa, columns, range, deviation } in &self.sets {
            let _ = write!(text, "\n[[data]]\nname = \"{name}\"\nfile = \"{name}.csv\"\nloading = \"{loading}\"\n");
            if let Some(abscissa) = abscissa {
                let _ = writeln!(text, "abscissa = \"{abscissa}\"");
            }
            if !columns.is_empty() {
                let columns: Vec<String> = columns.iter().map(|[key, name]| format!("{key} = \"{name}\"")).collect();
                let _ = writeln!(text, "columns = {{ {} }}", columns.join(", "));
            }
            if let Some([from, to]) = range {
                let _ = writeln!(text, "range = [{from:?}, {to:?}]");
            }
            if let Some([largest, deviation]) = deviation {
                let _ = writeln!(
                    text,
                    "deviation = {} # {:.0} % of the largest energy",
                    rounded(deviation * largest),
                    100.0 * deviation
                );
            }
        }
        text
    }
}

/// A number of seven digits, as TOML has it.
fn rounded(value: f64) -> String {
    let digits = format!("{value:.6e}").parse::<f64>().unwrap_or(value);
    format!("{digits:?}")
}

/// A text of one line in quotes, as TOML has it.
fn quoted(text: &str) -> String {
    let escaped = text.chars().map(|c| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
        c => c.to_string(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}
