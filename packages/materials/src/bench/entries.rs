//! What is measured of the library itself: the law point by point and by blocks, beside a copy of the same numbers.

use std::hint::black_box;

use nalgebra::{Matrix3, Scalar};

use super::parallel::parallel_block;
use super::scene::Scene;
use toron::Level;
use toron::Real;
use toron::law::block::Precision;
use toron::law::state::HYPERELASTIC_STATE;
use toron::{Hyperelastic, Request};

/// A way to evaluate a scene, or what to compare it with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// Point by point, with a law that has been prepared once.
    Point,
    /// A block: stress, energies, invariants, failure, status.
    Block(Level),
    /// A block: stress and status.
    StressOnly(Level),
    /// A block over the threads of rayon's pool.
    Threads(Level),
    /// No law: the same numbers read and written.
    Copy,
}

impl Entry {
    /// All that this processor can run, in either precision.
    pub fn all() -> Vec<Entry> {
        let best = Level::best();
        let levels = Level::ALL.into_iter().filter(|&level| level <= best).map(Entry::Block);
        let others = [Entry::StressOnly(best), Entry::Threads(best), Entry::Copy];
        [Entry::Point].into_iter().chain(levels).chain(others).collect()
    }

    /// The name in tables.
    pub fn name(self) -> String {
        match self {
            Entry::Point => "point by point".to_string(),
            Entry::Block(level) => format!("block, {}", level.name()),
            Entry::StressOnly(level) => format!("block, {}, stress only", level.name()),
            Entry::Threads(level) => format!("block, {}, {} threads", level.name(), rayon::current_num_threads()),
            Entry::Copy => "copy limit".to_string(),
        }
    }

    /// Evaluates the scene; its state goes on from where it was.
    ///
    /// # Errors
    /// The arrays do not have the sizes that the law needs.
    pub fn run<T: Precision + Scalar + Send + Sync>(
        self,
        law: &Hyperelastic<T>,
        scene: &mut Scene<T>,
    ) -> Result<(), toron::Error> {
        match self {
            Entry::Point => points(law, scene),
            Entry::Block(level) => drop(law.block(scene.arrays(level))?),
            Entry::StressOnly(level) => drop(law.block(scene.stress_only(level))?),
            Entry::Threads(level) => drop(parallel_block(law, scene.arrays(level))?),
            Entry::Copy => copy(scene),
        }
        Ok(())
    }
}

/// What a law answers for a point: stress, state and status.
pub type Answer<T> = ([T; 6], [T; HYPERELASTIC_STATE], i32);

/// Point by point, as a solver calls a scalar law: from the deformation gradient and the old state to the answer.
/// Inlined, so that the law is too: a call of a closure, and copies of what it takes and gives, would cost as much as
/// half of a law.
#[inline(always)]
pub fn each_point<T: Real + Scalar>(
    scene: &mut Scene<T>,
    mut law: impl FnMut(&Matrix3<T>, &[T; HYPERELASTIC_STATE]) -> Answer<T>,
) {
    for point in &mut scene.points {
        let [f11, f21, f31, f12, f22, f32, f13, f23, f33] = point.deformation_gradient;
        let f = Matrix3::new(f11, f12, f13, f21, f22, f23, f31, f32, f33);
        (point.stress, point.state, point.status) = law(&f, &point.state);
    }
}

fn points<T: Precision + Scalar>(law: &Hyperelastic<T>, scene: &mut Scene<T>) {
    let wanted = Request { modes: false, wave_modulus: false, ..Request::ALL };
    each_point(scene, |f, state| {
        let point = law.point(f, state, wanted);
        (point.stress, point.state, point.status)
    });
}

/// Reads the deformation gradient and the old state and writes stress, state and status, a few lines of every column at
/// a time like a block: what any law must at least do. The state stays what it was.
fn copy<T: Real>(scene: &mut Scene<T>) {
    /// Points of a column at a time.
    const TILE: usize = 64;
    let stride = scene.leading_dimension;
    // Numbers that the compiler does not know, so that it keeps what reads and writes.
    let least = black_box(T::splat(f64::MIN));
    for first in (0..scene.n).step_by(TILE) {
        let count = TILE.min(scene.n - first);
        let tile = |c: usize| c * stride + first..c * stride + first + count;
        let f = &scene.deformation_gradient;
        for c in 0..6 {
            let (one, other) = (&f[tile(c)], &f[tile(6 + c / 2)]);
            for ((stress, &one), &other) in scene.stress[tile(c)].iter_mut().zip(one).zip(other) {
                *stress = one + other;
            }
        }
        for (array, components) in [(&mut scene.energies, 4), (&mut scene.invariants, 4), (&mut scene.failure, 3)] {
            for c in 0..components {
                for value in &mut array[tile(c)] {
                    *value = value.max(least);
                }
            }
        }
        scene.status[tile(0)].fill(0);
    }
}
