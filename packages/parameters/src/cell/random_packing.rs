//! Discs at random in a box: they grow from points, push each other away, and grow until they are stuck.

use fastrand::Rng;

/// The fraction at which the discs begin to grow; by how much they grow at once, at first and at last, as a part.
const LOOSE: f64 = 0.4;
const GROWTH: [f64; 2] = [5e-3, 1e-7];
/// Discs are stuck when those that overlap do by more than about this, as a part of their diameter.
const TOUCH: f64 = 1e-7;
/// The most steps in which discs move to where they overlap least.
const MOST_STEPS: usize = 20_000;
/// After so many steps, which discs are near each other is found anew, within so many diameters.
const STEPS_NEARBY: usize = 50;
const NEARBY: f64 = 1.3;

/// So many discs of diameter 1 between the walls of a box.
pub struct Packing {
    pub centres: Vec<[f64; 2]>,
    /// Width and height of the box.
    pub size: [f64; 2],
}

/// Packs the discs in a box of this width over its height.
pub fn pack(discs: usize, aspect: f64, seed: u64) -> Packing {
    let size = [aspect.sqrt(), 1.0 / aspect.sqrt()];
    let mut random = Rng::with_seed(seed);
    let mut centres: Vec<[f64; 2]> = (0..discs).map(|_| size.map(|side| side * random.f64())).collect();
    let mut diameter = (LOOSE / (std::f64::consts::FRAC_PI_4 * discs as f64)).sqrt();
    let [mut growth, least] = GROWTH;
    let mut was_stuck = false;
    while growth > least {
        let stuck = !relax(&mut centres, size, diameter);
        if stuck != was_stuck {
            growth *= 0.5;
        }
        was_stuck = stuck;
        diameter *= if stuck { 1.0 - growth } else { 1.0 + growth };
    }
    let scaled = |lengths: &[f64; 2]| lengths.map(|x| x / diameter);
    Packing { centres: centres.iter().map(scaled).collect(), size: scaled(&size) }
}

/// Moves discs in a box of area 1 to where they overlap least, by the method FIRE (Bitzek and others, 2006): they roll
/// down the energy of their overlaps and are stopped when they roll up. Returns whether none overlaps.
fn relax(centres: &mut [[f64; 2]], size: [f64; 2], diameter: f64) -> bool {
    let zero = vec![[0.0; 2]; centres.len()];
    let mut velocities = zero.clone();
    let (mut time, mut steering, mut downhill) = (0.1, 0.1, 0);
    let mut near = Vec::new();
    for step in 0..MOST_STEPS {
        if step % STEPS_NEARBY == 0 {
            near = pairs(centres, NEARBY * diameter);
        }
        let mut forces = zero.clone();
        let energy = push(centres, &near, size, diameter, &mut forces);
        let scale = diameter * diameter * centres.len() as f64;
        if energy < TOUCH * TOUCH * scale {
            return true;
        }
        let [force, speed] = [&forces, &velocities].map(|all| dot(all, all).sqrt());
        if force * force < 1e-24 * scale {
            return false;
        }
        if dot(&forces, &velocities) >= 0.0 {
            for (velocity, pull) in velocities.iter_mut().flatten().zip(forces.iter().flatten()) {
                *velocity = (1.0 - steering) * *velocity + steering * speed * pull / force;
            }
            downhill += 1;
            if downhill > 5 {
                time = f64::min(1.1 * time, 0.7);
                steering *= 0.99;
            }
        } else {
            velocities.clone_from(&zero);
            (time, steering, downhill) = (0.5 * time, 0.1, 0);
        }
        for ((x, velocity), force) in
            centres.iter_mut().flatten().zip(velocities.iter_mut().flatten()).zip(forces.iter().flatten())
        {
            *velocity += time * force;
            *x += time * *velocity;
        }
    }
    false
}

fn dot(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| a * b).sum()
}

fn pairs(centres: &[[f64; 2]], reach: f64) -> Vec<[usize; 2]> {
    let all = (0..centres.len()).flat_map(|i| (0..i).map(move |j| [i, j]));
    all.filter(|&[i, j]| distance(centres[i], centres[j]) < reach).collect()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Adds the forces of overlapping discs and walls, which are the overlaps; returns their energy.
fn push(centres: &[[f64; 2]], near: &[[usize; 2]], size: [f64; 2], diameter: f64, forces: &mut [[f64; 2]]) -> f64 {
    let mut energy = 0.0;
    for &[i, j] in near {
        let apart = distance(centres[i], centres[j]);
        let overlap = diameter - apart;
        if overlap > 0.0 && apart > 0.0 {
            energy += 0.5 * overlap * overlap;
            for axis in 0..2 {
                let force = overlap * (centres[i][axis] - centres[j][axis]) / apart;
                forces[i][axis] += force;
                forces[j][axis] -= force;
            }
        }
    }
    for (centre, force) in centres.iter().zip(forces.iter_mut()) {
        for axis in 0..2 {
            let inwards = centre[axis].clamp(0.5 * diameter, size[axis] - 0.5 * diameter) - centre[axis];
            energy += 0.5 * inwards * inwards;
            force[axis] += inwards;
        }
    }
    energy
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No disc overlaps another or a wall, and nearly all are held by three neighbours or walls at least.
    #[test]
    fn discs_are_stuck() {
        for (discs, aspect, seed) in
            [(25, 1.0, 1), (25, 1.0, 2), (40, 1.0, 1), (60, 1.0, 1), (100, 1.0, 1), (60, 3.0, 1)]
        {
            let Packing { centres, size } = pack(discs, aspect, seed);
            assert!((size[0] / size[1] / aspect - 1.0).abs() < 1e-12, "{size:?}");
            let mut contacts = vec![0; discs];
            let mut gap = |gap: f64, disc: usize| {
                assert!(gap > -1e-5, "{discs} discs, seed {seed}: {gap}");
                contacts[disc] += usize::from(gap < 1e-4);
            };
            for [i, j] in pairs(&centres, 1.1) {
                let apart = distance(centres[i], centres[j]) - 1.0;
                gap(apart, i);
                gap(apart, j);
            }
            for (i, centre) in centres.iter().enumerate() {
                for (x, side) in centre.iter().zip(size) {
                    [x - 0.5, side - 0.5 - x].into_iter().for_each(|apart| gap(apart, i));
                }
            }
            let loose = contacts.iter().filter(|&&count| count < 3).count();
            assert!(loose * 8 < discs, "{discs} discs, seed {seed}: {loose} are loose");
            assert_eq!(pack(discs, aspect, seed).centres, centres);
        }
    }
}
