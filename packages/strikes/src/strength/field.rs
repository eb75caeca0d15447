//! The strength along a yarn.
//!
//! A yarn is a chain of cells of one length, by arc length at rest; those at its ends are as long as the yarn lets them
//! be. Each has a strength of its own, by Weibull's law at its own length. A cell's strength follows from the seed, the
//! yarn and the cell's number alone: the mesh has no part in it, and another modulus takes the same chance. Where the
//! first border lies is chance as well: else all yarns would have one in the middle, under the blow.

use super::weibull::Weibull;
use crate::chance::uniform;

/// Which yarn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Yarn {
    pub ply: usize,
    /// 0 of the warp, 1 of the weft.
    pub family: usize,
    pub number: i64,
}

/// Strength by cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    pub seed: u64,
    /// The length of a cell.
    pub cell: f64,
}

/// The number that no cell has: its chance says where a yarn's borders lie.
const BORDERS: i64 = i64::MIN;
/// What meets a cell by less than this part of it does not meet it.
const ROUNDING: f64 = 1e-9;

impl Field {
    /// The cells of a yarn that lies between these arc lengths from the origin's plane.
    pub fn cells(&self, law: &Weibull, yarn: Yarn, ends: [f64; 2]) -> Cells {
        let shift = chance(self.seed, yarn, BORDERS);
        let [start, end] = ends.map(|place| place / self.cell + shift);
        let first = start.floor() as i64;
        let last = (end.ceil() as i64 - 1).max(first);
        let strength = |cell: i64| {
            let length = self.cell * (((cell + 1) as f64).min(end) - (cell as f64).max(start));
            law.quantile(length, chance(self.seed, yarn, cell))
        };
        Cells { length: self.cell, shift, first, strengths: (first..=last).map(strength).collect() }
    }
}

/// The cells of a yarn.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    length: f64,
    /// From a border to the origin's plane, in cells.
    shift: f64,
    /// The number of the first one: number 0 has that border.
    first: i64,
    /// At least one.
    strengths: Vec<f64>,
}

impl Cells {
    /// The least strength of the cells that a piece meets, which lies between these arc lengths. Beyond its ends the
    /// yarn goes on as it ends: a mesh does not meet them.
    pub fn least(&self, piece: [f64; 2]) -> f64 {
        let [from, to] = piece.map(|place| place / self.length + self.shift - self.first as f64);
        let last = self.strengths.len() - 1;
        let first = ((from + ROUNDING).floor().max(0.0) as usize).min(last);
        let until = ((to - ROUNDING).ceil() as usize).clamp(first + 1, last + 1);
        self.strengths[first..until].iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// A number between 0 and 1, neither of them.
fn chance(seed: u64, Yarn { ply, family, number }: Yarn, cell: i64) -> f64 {
    uniform(seed, [ply as u64, family as u64, number as u64, cell as u64])
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: Weibull = Weibull { modulus: 12.0, scale: 0.0458, reference_length: 50.0 };

    fn yarn(number: i64) -> Yarn {
        Yarn { ply: 0, family: 0, number }
    }

    /// The largest distance of the sample's distribution from a uniform one.
    fn kolmogorov_smirnov(mut shares: Vec<f64>) -> f64 {
        shares.sort_by(f64::total_cmp);
        let n = shares.len() as f64;
        let apart = |(i, share): (usize, &f64)| (share - i as f64 / n).max((i + 1) as f64 / n - share);
        shares.iter().enumerate().map(apart).fold(0.0, f64::max)
    }

    /// Of 10⁴ yarns, with ends within cells: the closed form is met at a level of 0.001.
    #[test]
    fn the_least_of_a_yarn_is_as_weibull_s_law_has_it() {
        let critical = 1.949 / 100.0; // of 10⁴, at 0.001
        for (cell, ends) in [(1.0, [-13.7, 11.2]), (0.3, [0.0, 5.0]), (20.0, [-13.7, 11.2])] {
            let field = Field { seed: 7, cell };
            let shares = |length: f64| {
                let least = |number: i64| field.cells(&LAW, yarn(number), ends).least(ends);
                (-5000..5000).map(|number| LAW.probability(length, least(number))).collect()
            };
            let length = ends[1] - ends[0];
            let found = kolmogorov_smirnov(shares(length));
            assert!(found < critical, "{cell}: {found}");
            // A wrong length would be seen.
            assert!(kolmogorov_smirnov(shares(1.15 * length)) > critical);
        }
    }

    /// Whatever the mesh, a cell has its strength; an element that meets several has the least.
    #[test]
    fn a_mesh_does_not_change_the_cells() {
        let field = Field { seed: 1, cell: 1.0 };
        let ends = [-6.0, 6.0];
        let cells = field.cells(&LAW, yarn(3), ends);
        assert_eq!(cells.strengths.len(), 13);
        // Where the cells lie.
        let border = |number: i64| number as f64 - cells.shift;
        for pieces in [12, 30, 77, 480, 5000] {
            let place = |i: u32| ends[0] + 12.0 * f64::from(i) / f64::from(pieces);
            for i in 0..pieces {
                let piece = [place(i), place(i + 1)];
                let met = (0..13).filter(|&k| {
                    let number = cells.first + k as i64;
                    border(number) < piece[1] && border(number + 1) > piece[0]
                });
                let wanted = met.map(|k: usize| cells.strengths[k]).fold(f64::INFINITY, f64::min);
                assert_eq!(cells.least(piece), wanted, "{pieces} {i}");
            }
            // A mesh that ends before the yarn does, or beyond.
            assert_eq!(cells.least([-6.4, -6.2]), cells.strengths[0]);
            assert_eq!(cells.least([6.2, 6.4]), cells.strengths[12]);
        }
        // On a border rounding does not count.
        for rounding in [-1e-13, 0.0, 1e-13] {
            let piece = [border(2) + rounding, border(3) - rounding];
            assert_eq!(cells.least(piece), cells.strengths[(2 - cells.first) as usize]);
        }
        // What of a yarn is there besides does not change what there is.
        let longer = field.cells(&LAW, yarn(3), [-9.0, 7.3]);
        assert_eq!(longer.least([border(-3), border(2)]), cells.least([border(-3), border(2)]));
    }

    /// No place is on a border more often than another.
    #[test]
    fn borders_lie_anywhere() {
        let field = Field { seed: 4, cell: 1.0 };
        let shifts = (0..4000).map(|number| field.cells(&LAW, yarn(number), [0.0, 1.0]).shift).collect();
        assert!(kolmogorov_smirnov(shifts) < 1.949 / 4000.0_f64.sqrt());
    }

    /// Another yarn, ply, family, cell or seed is another chance, unlike the first; another modulus takes the same.
    #[test]
    fn chances_are_independent_and_shared_by_all_moduli() {
        let chances =
            |seed: u64, yarn: Yarn| -> Vec<f64> { (-2000..2000).map(|cell| chance(seed, yarn, cell)).collect() };
        let first = chances(1, yarn(0));
        let others = [
            chances(2, yarn(0)),
            chances(1, yarn(1)),
            chances(1, yarn(-1)),
            chances(1, Yarn { ply: 1, ..yarn(0) }),
            chances(1, Yarn { family: 1, ..yarn(0) }),
            first[1..].iter().copied().chain([0.5]).collect(),
        ];
        for other in others {
            let product: f64 = first.iter().zip(&other).map(|(a, b)| (a - 0.5) * (b - 0.5)).sum();
            // Its deviation is 1/12 of the root of the number.
            assert!((product / 4000.0_f64.sqrt() * 12.0).abs() < 4.0, "{product}");
        }
        assert!(kolmogorov_smirnov(first) < 1.949 / 4000.0_f64.sqrt());
        let field = Field { seed: 5, cell: 0.5 };
        let wide = Weibull { modulus: 5.0, ..LAW };
        let [narrow, wide] = [LAW, wide].map(|law| {
            let cells = field.cells(&law, yarn(2), [-10.0, 10.0]);
            // Without those at the ends.
            cells.strengths[1..40].iter().map(|&strength| law.probability(0.5, strength)).collect::<Vec<_>>()
        });
        assert!(narrow.iter().zip(&wide).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
