//! A block over threads and in parts: the same bits as in one piece, at every level.

use std::fmt::Debug;

use proptest::prelude::*;
use toron::Error;
use toron::Hyperelastic;
use toron::Level;
use toron::law::block::{Arrays, Block, Precision};
use toron::law::status::{BAD_LEADING_DIMENSION, INVERTED, OK};
use toron_materials::bench::command::properties;
use toron_materials::bench::parallel::parallel_block;
use toron_materials::bench::scene::Scene;

/// Enough for every thread to get a part, and no multiple of any lanes.
const POINTS: usize = 40_003;

fn law<T: Precision>() -> Hyperelastic<T> {
    let properties: Vec<T> = properties().iter().map(|&value| T::splat(value)).collect();
    Hyperelastic::new(&properties).expect("valid properties")
}

/// Random points, among them one that is inverted.
fn scene<T: Precision>(n: usize) -> Scene<T> {
    let mut scene = Scene::impact(n);
    let middle = n / 2;
    scene.deformation_gradient[middle] = T::splat(-1.0);
    scene
}

/// The bits of everything that the law has written.
fn answer<T: Precision + Debug>(scene: &Scene<T>) -> Vec<u64> {
    let arrays = [&scene.stress, &scene.energies, &scene.invariants, &scene.failure];
    let numbers = arrays.into_iter().flat_map(|array| array.iter()).map(|&value| Into::<f64>::into(value).to_bits());
    numbers.chain(scene.status.iter().map(|&code| code as u64)).collect()
}

fn levels() -> impl Iterator<Item = Level> {
    Level::ALL.into_iter().filter(|&level| level <= Level::best())
}

fn any_number_of_threads<T: Precision + Debug + Send + Sync>() {
    let law = law::<T>();
    for level in levels() {
        let mut whole = scene::<T>(POINTS);
        assert_eq!(law.block(whole.arrays(level)), Ok(INVERTED));
        let latch = &whole.failure[whole.leading_dimension..][..POINTS];
        let failed = latch.iter().filter(|&&latch| latch.into() == 1.0).count();
        assert!((1..POINTS / 10).contains(&failed), "{failed} of {POINTS} points have failed");
        for threads in [1, 2, 3, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let mut split = scene::<T>(POINTS);
            let worst = pool.install(|| parallel_block(&law, split.arrays(level)));
            assert_eq!(worst, Ok(INVERTED));
            assert!(answer(&split) == answer(&whole), "{threads} threads, {}", level.name());
        }
    }
}

#[test]
fn any_number_of_threads_in_double_precision() {
    any_number_of_threads::<f64>();
}

#[test]
fn any_number_of_threads_in_single_precision() {
    any_number_of_threads::<f32>();
}

fn any_split<T: Precision + Debug>(n: usize, cuts: &[usize]) {
    let law = law::<T>();
    for level in levels() {
        let (mut whole, mut split) = (scene::<T>(n), scene::<T>(n));
        assert_eq!(law.block(whole.arrays(level)), Ok(INVERTED));
        let mut rest = Block::new(split.arrays(level)).expect("a valid block");
        let mut worst = OK;
        for &cut in cuts {
            let (part, remainder) = rest.split_at(cut);
            worst = worst.min(law.checked_block(part).expect("a part"));
            rest = remainder;
        }
        worst = worst.min(law.checked_block(rest).expect("a part"));
        assert_eq!(worst, INVERTED);
        assert!(answer(&split) == answer(&whole), "{n} points cut at {cuts:?}, {}", level.name());
    }
}

proptest! {
    /// Parts of any length, empty ones included.
    #[test]
    fn any_parts(n in 1..200usize, cuts in prop::collection::vec(0..70usize, 0..6)) {
        any_split::<f64>(n, &cuts);
        any_split::<f32>(n, &cuts);
    }
}

#[test]
fn parts_would_overlap() {
    let f = [0.0; 90];
    let arrays = Arrays { n: 10, leading_dimension: 9, deformation_gradient: &f, ..Arrays::default() };
    let error = Block::new(arrays).expect_err("columns that overlap");
    assert!(matches!(error, Error::Count { code: BAD_LEADING_DIMENSION, found: 9, wanted: 10, .. }));
}
