//! The figures of a panel for the terminal.

use std::fmt::Write;
use std::ops::RangeInclusive;

use super::cloth::Cloth;
use super::figures::Figures;
use super::reader::Scene;
use crate::common::units::number;
use crate::material::fibre_wave::FibreWave;
use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;

const AREAL_DENSITY: Dimension = Dimension { mass: 1, length: -2, time: 0, name: "areal density" };

/// What woven fabrics weigh, in kg/m², with a margin on both sides: sailcloth and parachutes from 0.03, heavy rovings 2.
const KNOWN: RangeInclusive<f64> = 0.01..=10.0;

/// In kg/m².
fn areal_density(volume_by_area: f64, density: f64, units: &UnitSystem) -> f64 {
    volume_by_area * density / units.from_si(1.0, AREAL_DENSITY)
}

/// What to say where no fabric weighs that: the units are likely wrong.
pub fn areal_density_warning(volume_by_area: f64, density: f64, units: &UnitSystem) -> Option<String> {
    let found = areal_density(volume_by_area, density, units);
    (!KNOWN.contains(&found)).then(|| {
        format!(
            "the panel weighs {} kg/m², and woven fabrics {} to {}:\n\
             density or a length of the weave is most likely not in the units of the file, {}",
            number(found),
            KNOWN.start(),
            KNOWN.end(),
            units.names().join("-")
        )
    })
}

pub fn report(scene: &Scene, figures: &Figures) -> String {
    let length = scene.units.names()[0];
    let percent = figures.crimp.map(|crimp| number(100.0 * crimp));
    let [warps, wefts] = figures.yarns;
    let density = scene.material.as_ref().and_then(|material| material.density);
    let areal_density = density.map_or("no material that has a density".to_string(), |density| {
        format!("{} kg/m²", number(areal_density(figures.volume_by_area(), density, &scene.units)))
    });
    let mut rows = vec![
        ("yarns", format!("{warps} warp, {wefts} weft")),
        ("elements, nodes", format!("{}, {}", figures.elements, figures.nodes)),
        ("crimp of warp and weft", format!("{} %, {} %", percent[0], percent[1])),
    ];
    if let Cloth::Woven(woven) = &scene.cloth {
        rows.push(("amplitude of the centre lines", format!("{} {length}", number(woven.geometry.amplitude))));
    }
    rows.extend([
        ("least distance of yarns", format!("{} {length}", number(scene.cloth.clearance()))),
        ("thickness", format!("{} {length}", number(figures.thickness))),
        ("volume over area", format!("{} {length}", number(figures.volume_by_area()))),
        ("areal density", areal_density),
        (
            "least Jacobian",
            format!("{} {length}³, scaled {}", number(figures.least_jacobian), number(figures.least_scaled_jacobian)),
        ),
        ("shortest edge", format!("{} {length}", number(figures.shortest_edge))),
    ]);
    let mut of_mesh = Vec::new();
    if let Cloth::Foreign(foreign) = &scene.cloth {
        rows.extend(foreign.rows(length));
        of_mesh = foreign.checks.warnings();
    }
    let mut text = format!("{}\n\n", scene.title);
    for (name, value) in rows {
        let _ = writeln!(text, "  {name:<30}  {value}");
    }
    let wave = scene.material.as_ref().and_then(|material| FibreWave::of(material, &scene.units));
    let of_wave = wave.and_then(|wave| wave.unit_warning(&scene.units));
    let of_area = density.and_then(|density| areal_density_warning(figures.volume_by_area(), density, &scene.units));
    let warnings: Vec<String> = of_mesh.into_iter().chain(of_wave).chain(of_area).collect();
    for (number, warning) in warnings.iter().enumerate() {
        let before = if number == 0 { "\n" } else { "" };
        let _ = writeln!(text, "{before}warning: {}", warning.replace('\n', "\n  "));
    }
    text
}
