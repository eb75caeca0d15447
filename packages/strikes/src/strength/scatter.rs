//! The strength of a scene's yarns.

use super::field::{Cells, Field, Yarn};
use super::weibull::Weibull;
use toron::host::units::UnitSystem;
use toron::law::parameters::STRESS;
use toron_materials::material::model::{Law, Material};
use toron_materials::units::{LENGTH, unit};
use toron_shared::numbers::number;
use toron_shared::text_table::{folded, grouped};

/// Strength that scatters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    pub field: Field,
    /// Of warp and weft, or of the yarn: by the nominal strain at failure, or of the linear elastic law by its stress.
    pub laws: [Weibull; 2],
}

impl Strength {
    /// The cells of a yarn between these arc lengths.
    pub fn cells(&self, yarn: Yarn, ends: [f64; 2]) -> Cells {
        self.field.cells(&self.laws[yarn.family], yarn, ends)
    }

    /// Whether any yarn's cells differ.
    pub fn scatters(&self) -> bool {
        self.laws.iter().any(|law| law.modulus.is_finite())
    }

    /// For the report: `m = 12, seed 1, cells of 5 mm, the weakest 3.9 %`.
    fn text(&self, weakest: &str, units: &UnitSystem) -> String {
        format!("{}, the weakest {weakest}", self.law(units, &format!("seed {}, ", self.field.seed)))
    }

    /// `m = 12, cells of 5 mm`, with what stands between.
    fn law(&self, units: &UnitSystem, between: &str) -> String {
        let [warp, weft] = self.laws.map(|law| law.modulus.to_string());
        let modulus = if warp == weft { warp } else { format!("{warp} and {weft}") };
        format!("m = {modulus}, {between}cells of {} {}", self.field.cell, unit(units, LENGTH))
    }
}

/// A strength of this material's law: a strain in percent, or a stress with its unit.
pub fn text(material: &Material, strength: f64, units: &UnitSystem) -> String {
    match material.law {
        Law::LinearElastic { .. } => format!("{} {}", number(strength), unit(units, STRESS)),
        Law::Hyperelastic { .. } | Law::Own(_) => format!("{} %", number(100.0 * strength)),
    }
}

/// The line of a report on the cases whose strength scatters, each with its weakest element; `mirrored` is what
/// symmetry leaves out.
pub fn report<'a>(
    cases: impl Iterator<Item = (&'a str, Option<&'a Strength>, Option<&'a str>)>,
    mirrored: Option<&str>,
    units: &UnitSystem,
    width: usize,
) -> String {
    let text = |(case, strength, weakest): (&'a str, Option<&Strength>, Option<&str>)| {
        Some((case, strength?.text(weakest?, units)))
    };
    let texts: Vec<(&str, String)> = cases.filter_map(text).collect();
    if texts.is_empty() {
        return String::new();
    }
    let groups = grouped(texts.iter().map(|(case, text)| (*case, text.as_str())));
    let groups: Vec<String> = groups.iter().map(|(text, cases)| format!("{text} ({})", cases.join(", "))).collect();
    sentence(&groups.join("; "), mirrored, width)
}

/// The line of a report on shots of which each has a seed of its own.
pub fn report_of_shots(strength: &Strength, mirrored: Option<&str>, units: &UnitSystem, width: usize) -> String {
    sentence(&format!("{}, each shot with a seed of its own", strength.law(units, "")), mirrored, width)
}

fn sentence(text: &str, mirrored: Option<&str>, width: usize) -> String {
    let mirrored =
        mirrored.map(|what| format!(". Of {what}, which symmetry leaves out, the strengths are mirror images"));
    folded(&format!("Strength by Weibull's law: {text}{}.", mirrored.unwrap_or_default()), width) + "\n"
}
