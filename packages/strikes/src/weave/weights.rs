//! What a ply weighs: its areal density, and the linear densities of its yarns.

use std::ops::RangeInclusive;

use super::figures::Figures;
use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;
use toron_materials::material::linear_density::LinearDensity;
use toron_shared::numbers::number;

const AREAL_DENSITY: Dimension = Dimension { mass: 1, length: -2, time: 0, name: "areal density" };
/// What woven fabrics weigh, in kg/m², with a margin on both sides: sailcloth and parachutes from 0.03, heavy rovings
/// 2.
const KNOWN: RangeInclusive<f64> = 0.01..=10.0;

/// Areal density in kg/m², and the yarns of warp and weft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlyWeight {
    pub areal_density: f64,
    pub yarns: [LinearDensity; 2],
}

impl PlyWeight {
    /// Of a ply whose yarns of warp and weft lie this far apart and have these densities.
    pub fn of(figures: &Figures, pitches: [f64; 2], densities: [f64; 2], units: &UnitSystem) -> PlyWeight {
        let sections = figures.sections(pitches);
        let mass: f64 = figures.volumes_by_area.iter().zip(densities).map(|(volume, density)| volume * density).sum();
        PlyWeight {
            areal_density: mass / units.from_si(1.0, AREAL_DENSITY),
            yarns: [0, 1].map(|family| LinearDensity::of(sections[family], densities[family], units)),
        }
    }

    /// The yarns, as `warp and weft 651.4 dtex of 1351 kg/m³`.
    pub fn yarns(&self) -> String {
        match self.yarns.map(|yarn| yarn.text()) {
            [warp, weft] if warp == weft => format!("warp and weft {warp}"),
            [warp, weft] => format!("warp {warp}, weft {weft}"),
        }
    }

    /// Of plies, as `panel 0.1769 kg/m²; warp and weft 651.4 dtex of 1351 kg/m³`, told apart where they differ.
    pub fn text(plies: &[PlyWeight]) -> String {
        let all: f64 = plies.iter().map(|ply| ply.areal_density).sum();
        let mut yarns: Vec<String> = plies.iter().map(PlyWeight::yarns).collect();
        if yarns.windows(2).all(|pair| pair[0] == pair[1]) {
            yarns.truncate(1);
        } else {
            yarns = yarns.into_iter().zip(1..).map(|(text, ply)| format!("ply {ply} {text}")).collect();
        }
        format!("panel {} kg/m²; {}", number(all), yarns.join("; "))
    }

    /// What to say where no fabric or yarn weighs that: the units are likely wrong.
    pub fn warnings(&self, units: &UnitSystem) -> Vec<String> {
        let areal = (!KNOWN.contains(&self.areal_density)).then(|| {
            format!(
                "the panel weighs {} kg/m², and woven fabrics {} to {}:\n\
                 density or a length of the weave is most likely not in the units of the file, {}",
                number(self.areal_density),
                KNOWN.start(),
                KNOWN.end(),
                units.names().join("-")
            )
        });
        areal.into_iter().chain(self.yarns.iter().filter_map(|yarn| yarn.warning(units))).collect()
    }
}
