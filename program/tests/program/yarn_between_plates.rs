//! A yarn of elliptical section pressed between rigid plates, in CalculiX with contact:
//! `ffi-tests/calculix/contact.inp`. `cargo xtask update pictures` writes the picture of `docs/images` anew.

use std::fmt::Write;
use std::path::Path;

use crate::calculix_decks::{both_tangents, control, properties, vectors};
use crate::hexahedra::Mesh;
use nalgebra::{Matrix3, Vector3};
use plotters::prelude::*;
use toron::law::state::{ENERGIES, HYPERELASTIC_STATE, INVARIANTS};
use toron::law::stress::first_piola_kirchhoff;
use toron::{Hyperelastic, Request};
use toron_pictures::page::{self, Area, Drawn};
use toron_pictures::style::{COLOURS, GREY, INK, RULE, TEXT, TITLE, fine, stroke, text};
use toron_test_support::update::is_asked;

/// Half axes of the section and thickness of the slice, in µm.
const AXES: [f64; 2] = [266.85, 57.5];
const THICKNESS: f64 = 10.0;
/// Elements along an edge of the mesh's core.
const FINENESS: usize = 5;
/// The plate reaches beyond the section, which widens.
const PLATE: f64 = 1.8 * AXES[0];
const TRAVEL: f64 = 23.0;

/// What an increment shows: the plate's travel, its force, and the section.
struct Increment {
    travel: f64,
    force: f64,
    displacements: Vec<Vector3<f64>>,
    energy: f64,
}

/// Yarn, skin and plate, with all their sets.
fn cards(mesh: &Mesh, skin: &[usize]) -> String {
    let mut plate = Mesh::block([1, 8, 1], [THICKNESS, PLATE, 20.0]);
    for x in &mut plate.nodes {
        x.z += AXES[1];
    }
    let (nodes, elements) = (mesh.nodes.len(), mesh.elements.len());
    let mut text = mesh.cards("NODES", "YARN", [1, 1]) + &plate.cards("PLATE", "PLATE", [nodes + 1, elements + 1]);
    text += "*SURFACE, NAME=SKIN\n";
    for element in skin {
        writeln!(text, "{}, S4", element + 1).expect("a string");
    }
    text += "*SURFACE, NAME=UNDER\n";
    for element in 1..=plate.elements.len() {
        writeln!(text, "{}, S1", elements + element).expect("a string");
    }
    text
}

#[test]
fn a_yarn_between_plates() {
    let (mesh, skin) = Mesh::quarter_ellipse(FINENESS, THICKNESS, AXES);
    let symmetry = |x: &Vector3<f64>| [None, (x.y.abs() < 1e-9).then_some(0.0), (x.z.abs() < 1e-9).then_some(0.0)];
    let includes = [
        ("mesh.inp", cards(&mesh, &skin)),
        ("boundary.inp", mesh.boundary(symmetry)),
        ("control.inp", control(1e-8, 1e-4)),
    ];
    let results = both_tangents("contact.inp", &includes);

    // Weights of the integration points, for the energy.
    let rest = vec![Vector3::zeros(); mesh.nodes.len()];
    let weights: Vec<f64> =
        (0..mesh.elements.len()).flat_map(|e| mesh.gauss_points(e, &rest).map(|point| point.volume)).collect();
    let tables = results.all("total force").into_iter().zip(results.all("displacements")).zip(results.all("internal"));
    let increments: Vec<Increment> = tables
        .map(|((force, displacements), state)| Increment {
            travel: TRAVEL * (force.time - 1.0),
            force: -force.rows[0][2],
            displacements: vectors(displacements),
            energy: state.rows.iter().zip(&weights).map(|(row, w)| w * stored(&row[2..])).sum(),
        })
        .collect();

    // The library's own stress at the printed displacements balances the plate, across the plane of symmetry.
    let law = Hyperelastic::<f64>::new(&properties("contact.inp")).expect("the deck's properties");
    let stress =
        |f: &Matrix3<f64>| first_piola_kirchhoff(&law.point(f, &[0.0; HYPERELASTIC_STATE], Request::ALL).stress, f);
    let last = increments.last().expect("increments");
    let forces = mesh.forces(&last.displacements, stress);
    let held: f64 = forces.iter().zip(&mesh.nodes).filter(|(_, x)| x.z.abs() < 1e-9).map(|(force, _)| force.z).sum();
    println!("  force of the plate {:.6e}, of the plane of symmetry {held:.6e}", last.force);
    assert!((held - last.force).abs() < 1e-5 * last.force);

    // The plate's work is what the yarn stores; the contact's springs keep some of it, and the trapezoidal rule adds
    // some.
    let mut work = 0.5 * increments[0].travel * increments[0].force;
    work += increments.windows(2).map(|i| 0.5 * (i[1].travel - i[0].travel) * (i[1].force + i[0].force)).sum::<f64>();
    println!("  work of the plate {work:.5e}, energy of the yarn {:.5e}", last.energy);
    let lost = (work - last.energy) / last.energy;
    assert!(0.0 < lost && lost < 0.015, "{lost}");
    assert!(increments.windows(2).all(|i| i[0].force < i[1].force), "the yarn gets stiffer");
    let widest = |u: &[Vector3<f64>]| mesh.nodes.iter().zip(u).fold(0.0, |w: f64, (x, u)| w.max(x.y + u.y));
    println!("  half width {} -> {:.1} um", AXES[0], widest(&last.displacements));
    assert!(widest(&last.displacements) > 1.02 * AXES[0]);

    let folder = if is_asked("pictures") {
        Path::new(toron_test_support::library::ROOT).join("docs/images")
    } else {
        toron_test_support::library::folder("pictures")
    };
    let file = |extension: &str| folder.join(format!("yarn-between-plates.{extension}"));
    page::write(&file("svg"), &file("png"), SIZE, |root| draw(root, &mesh, &increments)).expect("a picture");
}

/// The energy of a point's state.
fn stored(state: &[f64]) -> f64 {
    state[ENERGIES..INVARIANTS].iter().sum()
}

/// The grid and the labels of a chart.
macro_rules! mesh_lines {
    ($chart:expr, $abscissa:expr) => {
        $chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(stroke(RULE, 1))
            .axis_style(stroke(GREY, 1))
            .set_all_tick_mark_size(fine(5))
            .label_style(text(TEXT, &INK))
            .axis_desc_style(text(TEXT, &INK))
            .x_label_formatter(&|x| format!("{x:.0}"))
            .y_label_formatter(&|y| format!("{y:.0}"))
            .x_desc($abscissa)
            .draw()?
    };
}

const SIZE: [u32; 2] = [1280, 560];

fn draw(root: &Area, mesh: &Mesh, increments: &[Increment]) -> Drawn<()> {
    root.draw_text("A yarn between rigid plates", &text(TITLE, &INK), (fine(24), fine(16)))?;
    let subtitle =
        "Kevlar KM2 600, section 533.7 × 115 µm, plane strain along the fibre, no friction: CalculiX with contact";
    root.draw_text(subtitle, &text(TEXT, &GREY), (fine(24), fine(50)))?;
    let (_, body) = root.split_vertically(fine(84));
    let (left, right) = body.split_horizontally(fine(600));
    draw_force(&left, increments)?;
    draw_section(&right, mesh, increments)
}

/// Force per length of the whole yarn over the approach of both plates, in per cent of its height.
fn draw_force(area: &Area, increments: &[Increment]) -> Drawn<()> {
    // The quarter's force in µN over a slice in µm is N/m; two quarters side by side.
    let place = |i: &Increment| (100.0 * i.travel / AXES[1], 2.0 * i.force / THICKNESS * 1e-3);
    let curve: Vec<(f64, f64)> = [(0.0, 0.0)].into_iter().chain(increments.iter().map(place)).collect();
    let most = curve.iter().fold(0.0, |most: f64, point| most.max(point.1));
    area.draw_text("N per mm of yarn", &text(TEXT, &INK), (fine(24), 0))?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(fine(30))
        .margin_right(fine(30))
        .margin_bottom(fine(12))
        .x_label_area_size(fine(56))
        .y_label_area_size(fine(60))
        .build_cartesian_2d(0.0..100.0 * TRAVEL / AXES[1], 0.0..1.05 * most)?;
    mesh_lines!(chart, "approach of the plates, % of the yarn's height");
    chart.draw_series(LineSeries::new(curve.iter().copied(), stroke(COLOURS[0], 3)))?;
    let dots = curve.iter().map(|&point| Circle::new(point, fine(4), COLOURS[0].filled()));
    chart.draw_series(dots)?;
    Ok(())
}

/// A quarter of the section before and at the end.
fn draw_section(area: &Area, mesh: &Mesh, increments: &[Increment]) -> Drawn<()> {
    area.draw_text("a quarter of the section, µm", &text(TEXT, &INK), (fine(24), 0))?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(fine(30))
        .margin_right(fine(30))
        .margin_bottom(fine(12))
        .x_label_area_size(fine(56))
        .y_label_area_size(fine(60))
        .build_cartesian_2d(0.0..1.3 * AXES[0], 0.0..1.1 * AXES[1])?;
    mesh_lines!(chart, "across the yarn; grey before, orange at 40 %; heights are drawn larger");
    let rest = vec![Vector3::zeros(); mesh.nodes.len()];
    let last = &increments[increments.len() - 1].displacements;
    for (displacements, colour, width) in [(&rest, GREY, 1), (last, COLOURS[1], 2)] {
        for nodes in &mesh.elements {
            let corner = |k: usize| mesh.nodes[nodes[k % 4]] + displacements[nodes[k % 4]];
            let outline = (0..5).map(|k| (corner(k).y, corner(k).z));
            chart.draw_series(LineSeries::new(outline, stroke(colour, width)))?;
        }
    }
    Ok(())
}
