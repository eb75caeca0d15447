//! Discs at random in a square box: they grow from points, and push each other away until none overlaps.

use fastrand::Rng;

/// Steps in which the discs grow to diameter 1, and rounds of pushing in each.
const GROWTH: usize = 200;
const ROUNDS: usize = 200;
/// Where discs of full size are stuck they are shaken, by less each time, and pushed again.
const SHAKES: usize = 300;
const SHAKE: f64 = 1.0;
const SHAKEN_ROUNDS: usize = 1500;
/// An overlap that counts as touching.
const TOUCH: f64 = 1e-5;

/// The centres of so many discs of diameter 1 in a box of this side, or none where they find no room.
pub fn centres(discs: usize, side: f64, seed: u64) -> Option<Vec<[f64; 2]>> {
    if side < 1.0 {
        return None;
    }
    let mut random = Rng::with_seed(seed);
    let mut centres: Vec<[f64; 2]> = (0..discs).map(|_| [side * random.f64(), side * random.f64()]).collect();
    for step in 1..=GROWTH {
        let diameter = (step as f64 / GROWTH as f64).sqrt();
        let free = (0..ROUNDS).any(|_| push(&mut centres, diameter, side) < TOUCH);
        if step == GROWTH && free {
            return Some(centres);
        }
    }
    for shake in 0..SHAKES {
        let most = SHAKE * (1.0 - shake as f64 / SHAKES as f64);
        for centre in &mut centres {
            *centre = centre.map(|x| x + most * (random.f64() - 0.5));
        }
        if (0..SHAKEN_ROUNDS).any(|_| push(&mut centres, 1.0, side) < TOUCH) {
            return Some(centres);
        }
    }
    None
}

/// Moves overlapping discs apart, by half of the overlap each, and all into the box; returns the largest overlap there was.
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
        for x in centre {
            let inside = x.clamp(0.5 * diameter, side - 0.5 * diameter);
            largest = largest.max((*x - inside).abs());
            *x = inside;
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The most that a scene may ask for; and more than there can be.
    #[test]
    fn discs_find_room_where_there_is_some() {
        let side = |discs: usize, fraction: f64| (0.25 * std::f64::consts::PI * discs as f64 / fraction).sqrt();
        for discs in [25, 40, 60] {
            for seed in 1..=3 {
                assert!(centres(discs, side(discs, 0.75), seed).is_some(), "{discs} discs, seed {seed}");
            }
        }
        assert!(centres(20, side(20, 0.95), 1).is_none());
    }
}
