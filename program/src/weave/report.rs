//! The figures of a panel for the terminal.

use std::fmt::Write;
use std::ops::RangeInclusive;

use super::cloth::Cloth;
use super::crimp;
use super::figures::Figures;
use super::foreign::reader::Foreign;
use super::layup::Ply;
use super::model::Model;
use super::reader::Scene;
use crate::common::units::number;
use crate::material::fibre_wave::FibreWave;
use toron::host::units::UnitSystem;
use toron::law::parameters::Dimension;

const AREAL_DENSITY: Dimension = Dimension { mass: 1, length: -2, time: 0, name: "areal density" };

/// What woven fabrics weigh, in kg/m², with a margin on both sides: sailcloth and parachutes from 0.03, heavy rovings 2.
const KNOWN: RangeInclusive<f64> = 0.01..=10.0;

const AREA: Dimension = Dimension { mass: 0, length: 2, time: 0, name: "area" };

/// The sections of yarns that are woven, in mm², with a margin on both sides: silk of 20 dtex has 0.002, a roving of 9600 tex 6.
const SECTIONS: RangeInclusive<f64> = 0.001..=10.0;

/// What to say where no yarn has such a section: the unit of length is likely another one.
pub fn section_warning(figures: &Figures, pitch: [f64; 2], units: &UnitSystem) -> Option<String> {
    let sections = figures.sections(pitch).map(|area| 1e6 * area / units.from_si(1.0, AREA));
    sections.iter().any(|area| !SECTIONS.contains(area)).then(|| {
        format!(
            "the yarns of warp and weft have sections of {} mm², and yarns that are woven {} to {}:\n\
             the mesh or a length of the weave is most likely not in {}, the unit of the file",
            sections.map(number).join(" and "),
            SECTIONS.start(),
            SECTIONS.end(),
            units.names()[0]
        )
    })
}

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

/// The figures of each ply, those of all where there are several, and what looks wrong.
pub fn report(scene: &Scene, model: &Model) -> String {
    let length = scene.units.names()[0];
    let density = scene.material.as_ref().and_then(|material| material.density);
    let areal_density = |volume_by_area: f64| {
        density.map_or("no material that has a density".to_string(), |density| {
            format!("{} kg/m²", number(areal_density(volume_by_area, density, &scene.units)))
        })
    };
    let figures = scene.cloth.figures(model);
    let plies = scene.cloth.plies();
    let mut text = format!("{}\n\n", scene.title);
    let mut add = |rows: &[(&str, String)]| {
        for (name, value) in rows {
            let _ = writeln!(text, "  {name:<30}  {value}");
        }
    };
    for (place, (ply, figures)) in plies.iter().zip(&figures).enumerate() {
        if plies.len() > 1 {
            let turned = format!("{}°, in the middle at {} {length}", number(ply.angle), number(ply.height));
            add(&[(&format!("ply {}", place + 1), turned)]);
        }
        add(&of_ply(ply, figures, length, areal_density(figures.volume_by_area())));
        if plies.len() > 1 {
            add(&[("", String::new())]);
        }
    }
    let mut of_mesh = Vec::new();
    if let Cloth::Foreign(foreign) = &scene.cloth {
        add(&of_mesh_file(foreign, length, areal_density(foreign.figures.volume_by_area())));
        of_mesh = foreign.checks.warnings();
    }
    if plies.len() > 1 {
        let [lowest, highest] = model.heights();
        let volume: f64 = figures.iter().map(Figures::volume_by_area).sum();
        add(&[
            ("all plies", plies.len().to_string()),
            ("elements, nodes", format!("{}, {}", model.elements.len(), model.nodes.len())),
            ("least distance of yarns", format!("{} {length}", number(scene.cloth.clearance()))),
            ("thickness", format!("{} {length}", number(highest - lowest))),
            ("areal density", areal_density(volume)),
        ]);
    }
    let wave = scene.material.as_ref().and_then(|material| FibreWave::of(material, &scene.units));
    let of_wave = wave.and_then(|wave| wave.unit_warning(&scene.units));
    let of_area =
        figures.iter().filter_map(|figures| areal_density_warning(figures.volume_by_area(), density?, &scene.units));
    let pitches = scene.cloth.pitches();
    let of_sections =
        figures.iter().zip(pitches).filter_map(|(figures, pitch)| section_warning(figures, pitch, &scene.units));
    let mut of_crimp: Vec<String> = plies.iter().filter_map(|ply| crimp::warning(&ply.woven.geometry)).collect();
    of_crimp.dedup();
    let warnings = of_mesh.into_iter().chain(of_crimp).chain(of_wave);
    let warnings: Vec<String> = warnings.chain(of_sections.take(1)).chain(of_area.take(1)).collect();
    for (number, warning) in warnings.iter().enumerate() {
        let before = if number == 0 { "\n" } else { "" };
        let _ = writeln!(text, "{before}warning: {}", warning.replace('\n', "\n  "));
    }
    text
}

fn of_ply(ply: &Ply, figures: &Figures, length: &str, areal_density: String) -> Vec<(&'static str, String)> {
    let geometry = &ply.woven.geometry;
    let amplitude = ("amplitude of the centre lines", format!("{} {length}", number(geometry.amplitude)));
    rows(figures, Some(amplitude), geometry.weave.clearance, length, areal_density)
}

fn of_mesh_file(foreign: &Foreign, length: &str, areal_density: String) -> Vec<(&'static str, String)> {
    let mut rows = rows(&foreign.figures, None, foreign.clearance, length, areal_density);
    rows.extend(foreign.rows(length));
    rows
}

fn rows(
    figures: &Figures,
    amplitude: Option<(&'static str, String)>,
    clearance: f64,
    length: &str,
    areal_density: String,
) -> Vec<(&'static str, String)> {
    let percent = figures.crimp.map(|crimp| number(100.0 * crimp));
    let [warps, wefts] = figures.yarns;
    let mut rows = vec![
        ("yarns", format!("{warps} warp, {wefts} weft")),
        ("elements, nodes", format!("{}, {}", figures.elements, figures.nodes)),
        ("crimp of warp and weft", format!("{} %, {} %", percent[0], percent[1])),
    ];
    rows.extend(amplitude);
    rows.extend([
        ("least distance of yarns", format!("{} {length}", number(clearance))),
        ("thickness", format!("{} {length}", number(figures.thickness))),
        ("volume over area", format!("{} {length}", number(figures.volume_by_area()))),
        ("areal density", areal_density),
        (
            "least Jacobian",
            format!("{} {length}³, scaled {}", number(figures.least_jacobian), number(figures.least_scaled_jacobian)),
        ),
        ("shortest edge", format!("{} {length}", number(figures.shortest_edge))),
    ]);
    rows
}
