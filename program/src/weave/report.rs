//! The figures of a panel for the terminal.

use std::fmt::Write;

use super::figures::Figures;
use super::reader::Scene;
use crate::common::units::number;
use toron::law::parameters::Dimension;

const AREAL_DENSITY: Dimension = Dimension { mass: 1, length: -2, time: 0, name: "areal density" };

pub fn report(scene: &Scene, figures: &Figures) -> String {
    let length = scene.units.names()[0];
    let geometry = &scene.woven.geometry;
    let percent = figures.crimp.map(|crimp| number(100.0 * crimp));
    let [warps, wefts] = figures.yarns;
    let areal_density = scene.density.map_or("no material that has a density".to_string(), |density| {
        let si = figures.volume_by_area * density / scene.units.from_si(1.0, AREAL_DENSITY);
        format!("{} kg/m²", number(si))
    });
    let rows = [
        ("yarns", format!("{warps} warp, {wefts} weft")),
        ("elements, nodes", format!("{}, {}", figures.elements, figures.nodes)),
        ("crimp of warp and weft", format!("{} %, {} %", percent[0], percent[1])),
        ("amplitude of the centre lines", format!("{} {length}", number(geometry.amplitude))),
        ("least distance of yarns", format!("{} {length}", number(geometry.weave.clearance))),
        ("thickness", format!("{} {length}", number(figures.thickness))),
        ("volume over area", format!("{} {length}", number(figures.volume_by_area))),
        ("areal density", areal_density),
        (
            "least Jacobian",
            format!("{} {length}³, scaled {}", number(figures.least_jacobian), number(figures.least_scaled_jacobian)),
        ),
        ("shortest edge", format!("{} {length}", number(figures.shortest_edge))),
    ];
    let mut text = format!("{}\n\n", scene.title);
    for (name, value) in rows {
        let _ = writeln!(text, "  {name:<30}  {value}");
    }
    text
}
