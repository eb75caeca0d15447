//! The figures of a panel for the terminal.

use super::cloth::Cloth;
use super::figures::Figures;
use super::foreign::reader::Foreign;
use super::layup::Ply;
use super::model::Model;
use super::reader::Scene;
use super::weights::PlyWeight;
use toron::host::units::UnitSystem;
use toron::law::parameters::DENSITY;
use toron_materials::material::fibre_wave::FibreWave;
use toron_shared::numbers::number;
use toron_shared::text_table::value_line;

/// What a yarn without a material is taken to have in kg/m³, to see whether its section can be a yarn's.
const ASSUMED_DENSITY: f64 = 1400.0;

/// The width of the names of figures, with a blank.
const NAMES: usize = 31;

/// A figure's name, and its value with the unit.
type Row = (&'static str, String);

/// What to say of a mesh in other units where no material is named: its sections alone show it.
pub fn section_warnings(figures: &Figures, pitches: [f64; 2], units: &UnitSystem) -> Vec<String> {
    let weight = PlyWeight::of(figures, pitches, [units.from_si(ASSUMED_DENSITY, DENSITY); 2], units);
    let warnings = weight.yarns.iter().filter_map(|yarn| yarn.warning(units));
    warnings.map(|text| format!("taken to have {ASSUMED_DENSITY} kg/m³, {text}")).collect()
}

/// The figures of each ply, those of all where there are several, and what looks wrong.
pub fn report(scene: &Scene, model: &Model) -> String {
    let length = scene.units.names()[0];
    let figures = scene.cloth.figures(model);
    let weights = of_plies(scene, &figures);
    let in_kg = |areal: Option<f64>| {
        areal.map_or("no material that has a density".to_string(), |areal| format!("{} kg/m²", number(areal)))
    };
    let of_weight = |weight: Option<PlyWeight>| {
        let yarns = weight.map(|weight| ("linear densities", weight.yarns()));
        [Some(("areal density", in_kg(weight.map(|weight| weight.areal_density)))), yarns]
    };
    let plies = scene.cloth.plies();
    let mut text = format!("{}\n\n", scene.title);
    let mut add = |rows: &[(&str, String)]| {
        for (name, value) in rows {
            text += &if name.is_empty() { "\n".to_string() } else { value_line(name, NAMES, value) };
        }
    };
    for (place, (ply, figures)) in plies.iter().zip(&figures).enumerate() {
        if plies.len() > 1 {
            let turned = format!("{}°, in the middle at {} {length}", number(ply.angle), number(ply.height));
            add(&[(&format!("ply {}", place + 1), turned)]);
        }
        add(&of_ply(ply, figures, length, of_weight(weights[place])));
        if plies.len() > 1 {
            add(&[("", String::new())]);
        }
    }
    if let Cloth::Foreign(foreign) = &scene.cloth {
        add(&of_mesh_file(foreign, length, of_weight(weights[0])));
    }
    if plies.len() > 1 {
        let [lowest, highest] = model.heights();
        let all = weights.iter().map(|weight| weight.map(|weight| weight.areal_density)).sum::<Option<f64>>();
        add(&[
            ("all plies", plies.len().to_string()),
            ("elements, nodes", format!("{}, {}", model.elements.len(), model.nodes.len())),
            ("least distance of yarns", format!("{} {length}", number(scene.cloth.clearance()))),
            ("thickness", format!("{} {length}", number(highest - lowest))),
            ("areal density", in_kg(all)),
        ]);
    }
    match warnings(scene, model) {
        none if none.is_empty() => text,
        warnings => text + "\n" + &warnings,
    }
}

/// Of each ply, where its yarns have a density.
fn of_plies(scene: &Scene, figures: &[Figures]) -> Vec<Option<PlyWeight>> {
    let of_ply = |ply: usize| {
        let [warp, weft] = scene.materials.get(ply)?.each_ref().map(|material| material.density);
        Some(PlyWeight::of(&figures[ply], scene.cloth.pitches()[ply], [warp?, weft?], &scene.units))
    };
    (0..figures.len()).map(of_ply).collect()
}

/// What the panel weighs; nothing where yarns have no density.
pub fn weights(scene: &Scene, model: &Model) -> String {
    let plies: Option<Vec<PlyWeight>> = of_plies(scene, &scene.cloth.figures(model)).into_iter().collect();
    plies.map_or(String::new(), |plies| PlyWeight::text(&plies))
}

/// Warnings of what looks wrong, each once.
pub fn warnings(scene: &Scene, model: &Model) -> String {
    let figures = scene.cloth.figures(model);
    let weights = of_plies(scene, &figures);
    let of_mesh = match &scene.cloth {
        Cloth::Foreign(foreign) => foreign.checks.warnings(),
        Cloth::Woven(_) => Vec::new(),
    };
    let waves = scene.materials.iter().flatten().filter_map(|material| FibreWave::of(material, &scene.units));
    let of_waves = waves.filter_map(|wave| wave.unit_warning(&scene.units));
    let of_weights = weights.iter().enumerate().flat_map(|(ply, weight)| match weight {
        Some(weight) => weight.warnings(&scene.units),
        None => section_warnings(&figures[ply], scene.cloth.pitches()[ply], &scene.units),
    });
    let of_crimp = scene.cloth.crimp().iter().cloned();
    let mut warnings: Vec<String> = Vec::new();
    for warning in of_mesh.into_iter().chain(of_crimp).chain(of_waves).chain(of_weights) {
        if !warnings.contains(&warning) {
            warnings.push(warning);
        }
    }
    warnings.iter().map(|warning| format!("warning: {}\n", warning.replace('\n', "\n  "))).collect()
}

fn of_ply(ply: &Ply, figures: &Figures, length: &str, weight: [Option<Row>; 2]) -> Vec<Row> {
    let geometry = &ply.woven.geometry;
    let amplitude = ("amplitude of the centre lines", format!("{} {length}", number(geometry.amplitude)));
    rows(figures, Some(amplitude), geometry.weave.clearance, length, weight)
}

fn of_mesh_file(foreign: &Foreign, length: &str, weight: [Option<Row>; 2]) -> Vec<Row> {
    let mut rows = rows(&foreign.figures, None, foreign.clearance, length, weight);
    rows.extend(foreign.rows(length));
    rows
}

fn rows(figures: &Figures, amplitude: Option<Row>, clearance: f64, length: &str, weight: [Option<Row>; 2]) -> Vec<Row> {
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
    ]);
    rows.extend(weight.into_iter().flatten());
    rows.extend([
        (
            "least Jacobian",
            format!("{} {length}³, scaled {}", number(figures.least_jacobian), number(figures.least_scaled_jacobian)),
        ),
        ("shortest edge", format!("{} {length}", number(figures.shortest_edge))),
    ]);
    rows
}
