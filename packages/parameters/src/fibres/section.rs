//! Where the fibres of a section lie. Lengths are in diameters of a fibre; the first axis is across the yarn, the
//! second along the blow.

use std::f64::consts::FRAC_PI_4;

use super::scene::{Outline, Packing};
use crate::cell::random_packing;

/// Height of a row of hexagonal packing: √3/2.
pub const ROW: f64 = 0.866_025_403_784_438_6;
/// A random packing is cut out of a box of so many times the fibres and 30 more, beside whose walls fibres lie in rows.
const MARGIN: f64 = 1.4;
const HALVINGS: usize = 60;

/// The section of a yarn.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// In a box, those furthest from its walls come first.
    pub centres: Vec<[f64; 2]>,
    /// Width and height of the ellipse or the box that they lie in.
    pub size: [f64; 2],
    /// Of that.
    pub area: f64,
}

impl Section {
    /// Packs the fibres.
    ///
    /// # Errors
    /// They do not go into the ellipse.
    pub fn pack(fibres: usize, outline: Outline, packing: Packing, diameter: f64) -> Result<Section, String> {
        let aspect = match outline {
            Outline::Box(aspect) => return Ok(boxed(fibres, aspect, packing)),
            Outline::Aspect(aspect) => aspect,
            Outline::Size([width, height]) => width / height,
        };
        let mut places: Vec<(f64, [f64; 2])> = candidates(fibres, aspect, packing)
            .into_iter()
            .map(|centre| (width_around(centre, aspect), centre))
            .collect();
        // Equal widths keep their order: the same section wherever it is packed.
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let count = match outline {
            Outline::Aspect(_) | Outline::Box(_) => fibres,
            Outline::Size([width, _]) => places.iter().take_while(|(need, _)| need * diameter <= width).count(),
        };
        if count < fibres {
            let Outline::Size([width, height]) = outline else { unreachable!("it grows until they fit") };
            return Err(format!(
                "{fibres} fibres of {diameter} do not go into {width} × {height}, into which {count} do; allowed: fewer, a larger \
                 section, or one that grows until they fit, by aspect"
            ));
        }
        places.truncate(fibres);
        let width = match outline {
            Outline::Aspect(_) | Outline::Box(_) => places.last().map_or(0.0, |place| place.0),
            Outline::Size([width, _]) => width / diameter,
        };
        let size = [width, width / aspect];
        let area = FRAC_PI_4 * size[0] * size[1];
        Ok(Section { centres: places.into_iter().map(|place| place.1).collect(), size, area })
    }

    /// How far a place in a box is from the nearest wall.
    pub fn depth(&self, place: [f64; 2]) -> f64 {
        let [x, y] = [0, 1].map(|axis| 0.5 * self.size[axis] - place[axis].abs());
        x.min(y)
    }

    /// The fibres' part of the area.
    pub fn fraction(&self) -> f64 {
        FRAC_PI_4 * self.centres.len() as f64 / self.area
    }
}

/// A box whose walls the fibres touch. In hexagonal packing it has whole rows, each half a diameter beside the next,
/// and of their possible numbers that which comes nearest to the aspect.
fn boxed(fibres: usize, aspect: f64, packing: Packing) -> Section {
    let (centres, size) = match packing {
        Packing::Hexagonal => {
            let size = |rows: usize| {
                [(fibres / rows) as f64 + if rows > 1 { 0.5 } else { 0.0 }, 1.0 + ROW * (rows - 1) as f64]
            };
            let off = |rows: usize| (size(rows)[0] / size(rows)[1] / aspect).ln().abs();
            let whole = (1..=fibres).filter(|&rows| fibres.is_multiple_of(rows));
            let rows = whole.min_by(|&a, &b| off(a).total_cmp(&off(b))).unwrap_or(1);
            let place = |fibre: usize| {
                let (row, column) = (fibre / (fibres / rows), fibre % (fibres / rows));
                [0.5 + column as f64 + if row % 2 == 1 { 0.5 } else { 0.0 }, 0.5 + ROW * row as f64]
            };
            ((0..fibres).map(place).collect(), size(rows))
        }
        Packing::Random { seed } => {
            let random_packing::Packing { centres, size } = random_packing::pack(fibres, aspect, seed);
            (centres, size)
        }
    };
    let mut centres: Vec<[f64; 2]> = centres;
    centres.iter_mut().for_each(|centre| *centre = [0, 1].map(|axis| centre[axis] - 0.5 * size[axis]));
    let mut section = Section { centres: Vec::new(), size, area: size[0] * size[1] };
    centres.sort_by(|&a, &b| section.depth(b).total_cmp(&section.depth(a)));
    section.centres = centres;
    section
}

/// The width of the least ellipse that holds a fibre there: one whose half axes are longer by a radius than those of
/// the ellipse on which its centre lies.
fn width_around([x, y]: [f64; 2], aspect: f64) -> f64 {
    let least = f64::max(1.0, aspect);
    let inside = |width: f64| {
        let [a, b] = [0.5 * (width - 1.0), 0.5 * (width / aspect - 1.0)];
        let part = |x: f64, half: f64| if x == 0.0 { 0.0 } else { (x / half).powi(2) };
        part(x, a) + part(y, b) <= 1.0
    };
    if inside(least) {
        return least;
    }
    let (mut low, mut high) = (least, least + 2.0 * (x.abs() + aspect * y.abs()) + 1.0);
    while !inside(high) {
        high *= 2.0;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if inside(middle) { high = middle } else { low = middle }
    }
    high
}

/// Centres around the origin, among which those of the section are.
fn candidates(fibres: usize, aspect: f64, packing: Packing) -> Vec<[f64; 2]> {
    // A square around the ellipse of a packing that is half void.
    let side = (2.0 * fibres as f64 * f64::max(aspect, 1.0 / aspect)).sqrt() + 4.0;
    match packing {
        Packing::Hexagonal => {
            let rows = (0.5 * side / ROW).ceil() as i64;
            let columns = (0.5 * side).ceil() as i64 + 1;
            let row = |row: i64| {
                let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
                (-columns..=columns).map(move |column| [column as f64 + shift, ROW * row as f64])
            };
            (-rows..=rows).flat_map(row).collect()
        }
        Packing::Random { seed } => {
            // In widths of the area that a fibre takes; an ellipse has the same margin on all sides as a circle.
            let fibres = fibres as f64;
            let across = (fibres / FRAC_PI_4).sqrt();
            let margin = ((MARGIN * fibres).floor() + 30.0).sqrt() - across;
            let [width, height] = [aspect.sqrt(), 1.0 / aspect.sqrt()].map(|part| part * across + margin);
            let discs = (width * height).round() as usize;
            let random_packing::Packing { centres, size } = random_packing::pack(discs, width / height, seed);
            centres.into_iter().map(|[x, y]| [x - 0.5 * size[0], y - 0.5 * size[1]]).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pack(fibres: usize, outline: Outline, packing: Packing) -> Section {
        Section::pack(fibres, outline, packing, 0.012).expect("they fit")
    }

    #[test]
    fn fibres_do_not_overlap_and_lie_in_the_ellipse() {
        for (fibres, outline, packing) in [
            (1, Outline::Aspect(1.0), Packing::Hexagonal),
            (19, Outline::Aspect(1.0), Packing::Hexagonal),
            (400, Outline::Aspect(4.64), Packing::Hexagonal),
            (50, Outline::Aspect(1.0), Packing::Random { seed: 1 }),
            (60, Outline::Aspect(2.0), Packing::Random { seed: 3 }),
            (300, Outline::Size([0.5337, 0.115]), Packing::Hexagonal),
        ] {
            let section = pack(fibres, outline, packing);
            assert_eq!(section.centres.len(), fibres);
            let [a, b] = section.size.map(|size| 0.5 * (size - 1.0) + 1e-9);
            for (i, [x, y]) in section.centres.iter().enumerate() {
                assert!(fibres == 1 || (x / a).powi(2) + (y / b).powi(2) <= 1.0 + 1e-6, "{x} {y}");
                let apart = |other: &[f64; 2]| (x - other[0]).hypot(y - other[1]);
                assert!(section.centres[..i].iter().all(|other| apart(other) > 1.0 - 1e-4));
            }
            // One circle fills a circle.
            assert!(fibres == 1 || section.fraction() < 0.9069);
        }
    }

    /// 19 fibres are a hexagon of three rings.
    #[test]
    fn a_circle_of_19_is_a_hexagon() {
        let section = pack(19, Outline::Aspect(1.0), Packing::Hexagonal);
        assert!((section.size[0] - 5.0).abs() < 1e-9, "{:?}", section.size);
    }

    /// The yarn's own section would be filled to 0.9385.
    #[test]
    fn what_is_too_many_is_said() {
        let error =
            Section::pack(400, Outline::Size([0.5337, 0.115]), Packing::Hexagonal, 0.012).expect_err("too many");
        assert!(error.starts_with("400 fibres of 0.012 do not go into 0.5337 × 0.115, into which "), "{error}");
        let larger = pack(400, Outline::Aspect(0.5337 / 0.115), Packing::Hexagonal);
        println!("{:?} mm, {:.3}", larger.size.map(|size| 0.012 * size), larger.fraction());
        assert!((0.75..0.9).contains(&larger.fraction()), "{}", larger.fraction());
    }
}
