//! The crimp of a mesh of others, and of smooth lines through its yarns' own sections.
//!
//! Chords cut the waves of a yarn short where there are few of them. That is all that the mesh alone can tell: what its
//! yarns were before they were meshed, with which sections and where they touched, only who meshed them knows.

use nalgebra::Vector3;

use crate::weave::crimp::{Crimp, LARGEST, differ, percent};
use crate::weave::geometry::Family;
use crate::weave::model::{END, Model, START, Yarn};
use crate::weave::torn::Groups;

/// Straight pieces that stand for a smooth line from a section to the next.
const PIECES: usize = 16;

type Point = Vector3<f64>;

/// The crimp of lines through the middles of the sections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paths {
    /// Straight from section to section: as the yarns are meshed.
    pub meshed: Crimp,
    /// Of cubic splines.
    pub smooth: Crimp,
}

impl Paths {
    /// None where the elements of some yarn do not stand in one section after another.
    pub fn of(model: &Model) -> Option<Paths> {
        let mut paths = Paths { meshed: [0.0; 2], smooth: [0.0; 2] };
        for family in Family::BOTH {
            // Over the panel, along chords, and along the smooth lines.
            let mut lengths = [0.0; 3];
            for yarn in model.yarns.iter().filter(|yarn| yarn.family == family) {
                let middles = middles(model, yarn)?;
                lengths[0] += along(&middles, family);
                lengths[1] += length(&middles);
                lengths[2] += length(&smooth(&middles));
            }
            let [crossed, meshed, smooth] = lengths;
            (paths.meshed[family as usize], paths.smooth[family as usize]) =
                (meshed / crossed - 1.0, smooth / crossed - 1.0);
        }
        Some(paths)
    }

    /// What to say of a mesh whose chords are too short.
    pub fn warning(&self) -> Option<String> {
        differ(self.meshed, self.smooth).then(|| {
            format!(
                "from section to section the yarns of warp and weft have a crimp of {}, and along smooth lines through\n\
                 the same sections {}, more than {} % apart: take more elements along the yarns' waves",
                percent(self.meshed),
                percent(self.smooth),
                100.0 * LARGEST
            )
        })
    }
}

fn along(line: &[Point], family: Family) -> f64 {
    line.windows(2).map(|pair| (pair[1] - pair[0])[family as usize].abs()).sum()
}

fn length(line: &[Point]) -> f64 {
    line.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// The middles of a yarn's sections from its start on: means of the nodes that the ends of elements join.
fn middles(model: &Model, yarn: &Yarn) -> Option<Vec<Point>> {
    let elements =
        || model.elements[yarn.elements.clone()].iter().map(|nodes| nodes.map(|node| node - yarn.nodes.start as u32));
    let mut groups = Groups::new(yarn.nodes.len());
    for nodes in elements() {
        for end in [START, END] {
            end.iter().for_each(|&corner| groups.join(nodes[end[0]], nodes[corner]));
        }
    }
    let section: Vec<usize> = (0..yarn.nodes.len() as u32).map(|node| groups.representative(node) as usize).collect();
    let mut next: Vec<Option<usize>> = vec![None; section.len()];
    let mut is_behind = vec![false; section.len()];
    for nodes in elements() {
        let [from, to] = [START, END].map(|end| section[nodes[end[0]] as usize]);
        if from == to || next[from].replace(to).is_some_and(|other| other != to) {
            return None;
        }
        is_behind[to] = true;
    }
    let mut sums = vec![(Point::zeros(), 0.0); section.len()];
    for (&section, &node) in section.iter().zip(&model.nodes[yarn.nodes.clone()]) {
        sums[section] = (sums[section].0 + Point::from(node), sums[section].1 + 1.0);
    }
    let sections = || (0..section.len()).filter(|&number| section[number] == number);
    let mut starts = sections().filter(|&number| !is_behind[number]);
    let (first, None) = (starts.next()?, starts.next()) else { return None };
    let chain = std::iter::successors(Some(first), |&section| next[section]).take(section.len());
    let middles: Vec<Point> = chain.map(|section| sums[section].0 / sums[section].1).collect();
    (middles.len() == sections().count()).then_some(middles)
}

/// Points on the natural cubic spline through these, by the length of its chords.
fn smooth(knots: &[Point]) -> Vec<Point> {
    let chords: Vec<f64> = knots.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    let bends = bends(knots, &chords);
    let mut line: Vec<Point> = knots.first().copied().into_iter().collect();
    for (piece, &chord) in chords.iter().enumerate() {
        let ([from, to], [bend, next]) = ([knots[piece], knots[piece + 1]], [bends[piece], bends[piece + 1]]);
        line.extend((1..=PIECES).map(|place| {
            let b = place as f64 / PIECES as f64;
            let a = 1.0 - b;
            a * from + b * to + chord * chord / 6.0 * ((a * a * a - a) * bend + (b * b * b - b) * next)
        }));
    }
    line
}

/// The spline's second derivatives at its knots, 0 at the first and the last: three neighbours each, by elimination.
fn bends(knots: &[Point], chords: &[f64]) -> Vec<Point> {
    let slope = |piece: usize| (knots[piece + 1] - knots[piece]) / chords[piece];
    let mut bends = vec![Point::zeros(); knots.len()];
    let mut factors = vec![0.0; knots.len()];
    for knot in 1..knots.len().saturating_sub(1) {
        let [before, behind] = [chords[knot - 1], chords[knot]];
        let pivot = 2.0 * (before + behind) - before * factors[knot - 1];
        factors[knot] = behind / pivot;
        bends[knot] = (6.0 * (slope(knot) - slope(knot - 1)) - before * bends[knot - 1]) / pivot;
    }
    for knot in (1..knots.len().saturating_sub(1)).rev() {
        bends[knot] = bends[knot] - factors[knot] * bends[knot + 1];
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::weave::reader::Scene;

    /// The preset's weave with so many elements from a crossing to the next.
    fn woven(along: usize) -> Model {
        let text = format!(
            "units = \"mm-tonne-s\"\n[weave]\npreset = \"kevlar-s706\"\nalong = {along}\ncolumns = 4\n\
             [weave.panel]\nshape = \"rectangle\"\nhalf = [2.3, 2.3]\n"
        );
        Scene::parse("weave.toml", &text).expect("a weave").cloth.model()
    }

    /// A sine of 1 % of crimp: the spline has 97 % of that at least, where chords lose up to a fifth.
    #[test]
    fn a_spline_is_as_long_as_the_wave_and_chords_are_shorter() {
        let amplitude = 0.2 / std::f64::consts::TAU;
        let wave = |elements: usize| -> Vec<Point> {
            let place = |k: usize| k as f64 / elements as f64;
            (0..=4 * elements)
                .map(|k| Point::new(place(k), 0.0, amplitude * (std::f64::consts::TAU * place(k)).sin()))
                .collect()
        };
        let crimp = |line: &[Point]| length(line) / along(line, Family::Warp) - 1.0;
        let exact = crimp(&wave(4096));
        assert!((exact - 0.01).abs() < 2e-4, "{exact}");
        for (elements, chords) in [(4, 0.81), (8, 0.95), (16, 0.987)] {
            let knots = wave(elements);
            assert!((crimp(&knots) / exact - chords).abs() < 5e-3, "{elements}: {}", crimp(&knots) / exact);
            let found = crimp(&smooth(&knots)) / exact;
            assert!((found - 1.0).abs() < 0.03, "{elements}: {found}");
        }
        assert_eq!((smooth(&[]).len(), smooth(&[Point::zeros()]).len()), (0, 1));
    }

    /// Two elements from a crossing to the next are too few, four will do: through the nodes, whatever their order.
    #[test]
    fn chords_are_held_against_the_smooth_line() {
        for (along, is_warned) in [(2, true), (4, false), (8, false)] {
            let mut model = woven(along);
            let paths = Paths::of(&model).expect("sections");
            assert_eq!(paths.warning().is_some(), is_warned, "{along}: {paths:?}");
            assert!((0.01..0.03).contains(&paths.meshed[0]) && paths.smooth[0] > paths.meshed[0], "{paths:?}");
            // Elements that stand in no order are the same yarns.
            for yarn in &model.yarns {
                model.elements[yarn.elements.clone()].reverse();
            }
            let reversed = Paths::of(&model).expect("sections");
            assert!((reversed.smooth[1] - paths.smooth[1]).abs() < 1e-12, "{reversed:?}");
        }
    }

    /// Where an element turns aside there is no way from section to section.
    #[test]
    fn of_yarns_without_sections_nothing_is_said() {
        let mut model = woven(4);
        let element = model.yarns[0].elements.start + 1;
        let [a, b, c, d, e, f, g, h] = model.elements[element];
        model.elements[element] = [a, c, e, g, b, d, f, h];
        assert_eq!(Paths::of(&model), None);
    }
}
