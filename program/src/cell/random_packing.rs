//! Discs at random in a square box: they grow from points, and push each other away until none overlaps.

use fastrand::Rng;

/// Steps in which the discs grow to diameter 1.
const GROWTH: usize = 200;
/// Rounds of pushing in a step, and in the last.
const ROUNDS: usize = 200;
const LAST_ROUNDS: usize = 200_000;
/// An overlap that counts as touching.
const TOUCH: f64 = 1e-5;

/// The centres of so many discs of diameter 1 in a box of this side, or none where they find no room.
pub fn centres(discs: usize, side: f64, seed: u64) -> Option<Vec<[f64; 2]>> {
    let mut random = Rng::with_seed(seed);
    let mut centres: Vec<[f64; 2]> = (0..discs).map(|_| [side * random.f64(), side * random.f64()]).collect();
    for step in 1..=GROWTH {
        let diameter = (step as f64 / GROWTH as f64).sqrt();
        let rounds = if step == GROWTH { LAST_ROUNDS } else { ROUNDS };
        let free = (0..rounds).any(|_| push(&mut centres, diameter, side) < TOUCH);
        if step == GROWTH && !free {
            return None;
        }
    }
    Some(centres)
}

/// Moves overlapping discs apart, by half of the overlap each; returns the largest overlap there was.
fn push(centres: &mut [[f64; 2]], diameter: f64, side: f64) -> f64 {
    let mut largest: f64 = 0.0;
    for i in 0..centres.len() {
        for j in 0..i {
            let apart = [0, 1].map(|axis| centres[i][axis] - centres[j][axis]);
            let distance = apart[0].hypot(apart[1]);
            let overlap = diameter - distance;
            if overlap > 0.0 && distance > 0.0 {
                largest = largest.max(overlap);
                // Half a touch further than needed, or the last of it would take for ever.
                let move_by = 0.5 * (overlap + 0.5 * TOUCH) / distance;
                for axis in 0..2 {
                    centres[i][axis] += move_by * apart[axis];
                    centres[j][axis] -= move_by * apart[axis];
                }
            }
        }
    }
    for centre in centres {
        *centre = centre.map(|x| x.clamp(0.5 * diameter, side - 0.5 * diameter));
    }
    largest
}
