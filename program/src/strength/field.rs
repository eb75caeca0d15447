//! The strength along a yarn.
//!
//! A yarn is a chain of cells of one length, counted from where it passes the origin's plane; those at its ends are as long as the yarn
//! lets them be. Each has a strength of its own, by Weibull's law at its own length. A cell's strength follows from the seed, the yarn and
//! the cell's number alone: the mesh has no part in it, and another modulus takes the same chance.

use super::weibull::Weibull;
use crate::common::chance::uniform;

/// Which yarn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Yarn {
    pub ply: usize,
    /// 0 of the warp, 1 of the weft.
    pub family: u64,
    pub number: i64,
}

/// Strength by cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    pub seed: u64,
    /// The length of a cell.
    pub cell: f64,
}

impl Field {
    /// The strength of the cell with this number, of so much length: one of the yarn's chance.
    pub fn strength(&self, law: &Weibull, yarn: Yarn, cell: i64, length: f64) -> f64 {
        law.quantile(length, chance(self.seed, yarn, cell))
    }

    /// The least strength of the cells that each piece of a yarn meets. The pieces lie between neighbouring `places`, rising arc lengths
    /// from the origin's plane; the first and the last one are the yarn's ends.
    pub fn pieces(&self, law: &Weibull, yarn: Yarn, places: &[f64]) -> Vec<f64> {
        let (Some(&start), Some(&end)) = (places.first(), places.last()) else { return Vec::new() };
        let strength = |cell: i64| {
            let [from, to] = [cell, cell + 1].map(|edge| self.cell * edge as f64);
            self.strength(law, yarn, cell, to.min(end) - from.max(start))
        };
        let least = |piece: &[f64]| {
            let first = (piece[0] / self.cell).floor() as i64;
            // A cell that begins where the piece ends is not met.
            let last = ((piece[1] / self.cell).ceil() as i64 - 1).max(first);
            (first..=last).map(strength).fold(f64::INFINITY, f64::min)
        };
        places.windows(2).map(least).collect()
    }
}

/// A number between 0 and 1, neither of them.
fn chance(seed: u64, Yarn { ply, family, number }: Yarn, cell: i64) -> f64 {
    uniform(seed, [ply as u64, family, number as u64, cell as u64])
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
        for (cell, span) in [(1.0, [-13.7, 11.2]), (0.3, [0.0, 5.0]), (20.0, [-13.7, 11.2])] {
            let field = Field { seed: 7, cell };
            let places: Vec<f64> = (0..=40).map(|i| span[0] + (span[1] - span[0]) * f64::from(i) / 40.0).collect();
            let share = |number: i64| {
                let least = field.pieces(&LAW, yarn(number), &places).into_iter().fold(f64::INFINITY, f64::min);
                LAW.probability(span[1] - span[0], least)
            };
            let found = kolmogorov_smirnov((-5000..5000).map(share).collect());
            assert!(found < critical, "{cell}: {found}");
            // A wrong length would be seen.
            let wrong = |number: i64| {
                let least = field.pieces(&LAW, yarn(number), &places).into_iter().fold(f64::INFINITY, f64::min);
                LAW.probability(1.15 * (span[1] - span[0]), least)
            };
            assert!(kolmogorov_smirnov((-5000..5000).map(wrong).collect()) > critical);
        }
    }

    /// Whatever the mesh, a cell has its strength; an element that meets two has the lesser one.
    #[test]
    fn a_mesh_does_not_change_the_cells() {
        let field = Field { seed: 1, cell: 1.0 };
        let places = |pieces: u32| -> Vec<f64> {
            (0..=pieces).map(|i| -6.0 + 12.0 * f64::from(i) / f64::from(pieces)).collect()
        };
        let by_cells = field.pieces(&LAW, yarn(3), &places(12));
        let cell = |number: i64| field.strength(&LAW, yarn(3), number, 1.0);
        assert_eq!(by_cells, (-6..6).map(cell).collect::<Vec<_>>());
        let fine = field.pieces(&LAW, yarn(3), &places(48));
        assert!(fine.chunks(4).zip(&by_cells).all(|(pieces, whole)| pieces.iter().all(|piece| piece == whole)));
        let coarse = field.pieces(&LAW, yarn(3), &places(8));
        for (i, piece) in coarse.iter().enumerate() {
            let met: Vec<i64> = (-6..6)
                .filter(|&k| (k as f64) < -4.5 + 1.5 * i as f64 && k as f64 + 1.0 > -6.0 + 1.5 * i as f64)
                .collect();
            assert_eq!(*piece, met.into_iter().map(cell).fold(f64::INFINITY, f64::min));
        }
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
        for cell in -20..20 {
            let shares = [LAW, wide].map(|law| law.probability(0.5, field.strength(&law, yarn(2), cell, 0.5)));
            assert!((shares[0] - shares[1]).abs() < 1e-12);
        }
    }
}
