//! Where the fibres lie: the cells that symmetry leaves of hexagonal and square packings, and boxes of whole fibres.

use std::f64::consts::{FRAC_PI_4, PI};

use super::disc::Disc;
use super::model::{Model, Side};
use super::random_packing;
use super::scene::{Arrangement, BoxOf, Packing};

/// Height of a row of hexagonal packing: √3/2.
const ROW: f64 = 0.866_025_403_784_438_6;
/// How far from the direction of its neighbour a fibre of a regular packing can touch it.
const REGULAR: f64 = FRAC_PI_4;
/// Neighbours of a regular packing are this far apart at most; the next ones are at √2 and √3.
const REGULAR_REACH: f64 = 1.1;
/// Fibres whose centre is nearer than this to a wall, in diameters, feel it: the middle is without them.
const EDGE: f64 = 2.0;
const SIDES: [Side; 4] = [Side::Left, Side::Right, Side::Bottom, Side::Top];

/// Builds the model.
///
/// # Errors
/// The middle of a box of rows has no fibre.
pub fn model(arrangement: &Arrangement, elements: usize) -> Result<Model, String> {
    match arrangement {
        Arrangement::Cell(Packing::Hexagonal) => Ok(hexagonal_cell(elements)),
        Arrangement::Cell(Packing::Square) => Ok(square_cell(elements)),
        Arrangement::Box(contents) => walled_box(contents, elements),
    }
}

/// Quarters of two fibres at opposite corners; the neighbours in their rows are rigid planes.
fn hexagonal_cell(elements: usize) -> Model {
    let size = [0.5, ROW];
    let mut model = Model { size, mirrored: true, ..Model::default() };
    let lower = model.add_fibre(&Disc::quarter(elements, 0), [0.0, 0.0]);
    let upper = model.add_fibre(&Disc::quarter(elements, 2), size);
    let [left, right] = [Side::Left, Side::Right].map(|side| model.add_wall(side));
    model.add_symmetry(&[lower], 0, 0.0);
    model.add_symmetry(&[lower], 1, 0.0);
    model.add_symmetry(&[upper], 0, size[0]);
    model.add_symmetry(&[upper], 1, size[1]);
    model.add_contact(lower, upper, REGULAR);
    model.add_wall_contact(lower, right, Side::Right, REGULAR);
    model.add_wall_contact(upper, left, Side::Left, REGULAR);
    read_from_all(&mut model, PI / 8.0);
    model
}

/// A quarter of a fibre against two rigid planes.
fn square_cell(elements: usize) -> Model {
    let mut model = Model { size: [0.5, 0.5], mirrored: true, ..Model::default() };
    let fibre = model.add_fibre(&Disc::quarter(elements, 0), [0.0, 0.0]);
    for side in [Side::Right, Side::Top] {
        let wall = model.add_wall(side);
        model.add_wall_contact(fibre, wall, side, REGULAR);
    }
    model.add_symmetry(&[fibre], 0, 0.0);
    model.add_symmetry(&[fibre], 1, 0.0);
    read_from_all(&mut model, PI / 16.0);
    model
}

fn read_from_all(model: &mut Model, fibre_area: f64) {
    model.area = model.size[0] * model.size[1];
    model.middle = (0..model.fibres).collect();
    model.middle_area = model.area;
    model.fraction = fibre_area / model.area;
}

/// Whole fibres between four walls.
fn walled_box(contents: &BoxOf, elements: usize) -> Result<Model, String> {
    let Places { centres, size, area_of_fibre } = places(contents);
    let mut model = Model { size, area: size[0] * size[1], ..Model::default() };
    let disc = Disc::whole(elements);
    if matches!(contents, BoxOf::Random { .. }) {
        for &centre in &centres {
            model.add_fibre(&disc, centre);
        }
        for side in SIDES {
            model.add_wall(side);
        }
        read_from_all(&mut model, FRAC_PI_4 * centres.len() as f64);
        return Ok(model);
    }
    for &centre in &centres {
        let first = model.nodes.len();
        model.add_fibre(&disc, centre);
        model.sprung.extend(disc.corners.iter().map(|corner| first + corner));
    }
    for (slave, a) in centres.iter().enumerate() {
        for (master, b) in centres.iter().enumerate().skip(slave + 1) {
            if (a[0] - b[0]).hypot(a[1] - b[1]) < REGULAR_REACH {
                model.add_contact(slave, master, REGULAR);
            }
        }
    }
    for side in SIDES {
        let wall = model.add_wall(side);
        for (fibre, centre) in centres.iter().enumerate() {
            if distance(*centre, side, size) < REGULAR_REACH - 0.5 {
                model.add_wall_contact(fibre, wall, side, REGULAR);
            }
        }
    }
    model.middle =
        (0..centres.len()).filter(|&i| SIDES.iter().all(|&side| distance(centres[i], side, size) >= EDGE)).collect();
    if model.middle.is_empty() {
        return Err(format!("no fibre of the box is {EDGE} diameters away from all walls; allowed: more fibres"));
    }
    model.middle_area = area_of_fibre * model.middle.len() as f64;
    model.fraction = FRAC_PI_4 / area_of_fibre;
    Ok(model)
}

fn distance(centre: [f64; 2], side: Side, size: [f64; 2]) -> f64 {
    match side {
        Side::Left => centre[0],
        Side::Right => size[0] - centre[0],
        Side::Bottom => centre[1],
        Side::Top => size[1] - centre[1],
    }
}

/// Where the fibres of a box lie.
struct Places {
    centres: Vec<[f64; 2]>,
    /// The box's.
    size: [f64; 2],
    /// What belongs to a fibre inside, voids included.
    area_of_fibre: f64,
}

fn places(contents: &BoxOf) -> Places {
    match *contents {
        BoxOf::Rows { packing, rows, fibres_in_row } => {
            let hexagonal = packing == Packing::Hexagonal;
            let height = if hexagonal { ROW } else { 1.0 };
            let row = |row: usize| {
                let shifted = hexagonal && row % 2 == 1;
                let (count, start) = if shifted { (fibres_in_row - 1, 1.0) } else { (fibres_in_row, 0.5) };
                (0..count).map(move |i| [start + i as f64, 0.5 + height * row as f64])
            };
            let size = [fibres_in_row as f64, 1.0 + height * (rows - 1) as f64];
            Places { centres: (0..rows).flat_map(row).collect(), size, area_of_fibre: height }
        }
        BoxOf::Random { fibres, seed } => {
            let random_packing::Packing { centres, size } = random_packing::pack(fibres, 1.0, seed);
            Places { centres, size, area_of_fibre: size[0] * size[1] / fibres as f64 }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_of_the_thesis() {
        let rows = BoxOf::Rows { packing: Packing::Hexagonal, rows: 10, fibres_in_row: 12 };
        let model = walled_box(&rows, 3).expect("a box");
        assert_eq!(model.fibres, 115);
        assert_eq!(model.bodies[0].quads.len(), 108);
        // Neighbours in the rows, and between them.
        let between = model.contacts.iter().filter(|contact| contact.friction).count();
        assert_eq!(between, 5 * 11 + 5 * 10 + 9 * 22);
        assert!((model.fraction - 0.9069).abs() < 1e-4);
    }

    #[test]
    fn random_fibres_do_not_overlap() {
        let random = BoxOf::Random { fibres: 40, seed: 1 };
        let Places { centres, size, .. } = places(&random);
        for (i, a) in centres.iter().enumerate() {
            assert!(SIDES.iter().all(|&side| distance(*a, side, size) > 0.5 - 1e-4));
            assert!(centres[..i].iter().all(|b| (a[0] - b[0]).hypot(a[1] - b[1]) > 1.0 - 1e-4));
        }
        let model = walled_box(&random, 3).expect("a box");
        assert_eq!((model.fibres, model.middle.len(), model.bodies.len()), (40, 40, 44));
    }
}
