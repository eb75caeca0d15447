//! A large block over all threads.

use rayon::prelude::*;

use toron::Hyperelastic;
use toron::law::block::{Arrays, Block, Precision};
use toron::{Error, status};

/// Fewer points than this are not worth another thread.
const FEWEST: usize = 4096;
/// Parts begin at multiples of this, so that they fill lanes and cache lines. The results do not depend on it.
const GRAIN: usize = 64;

/// The law at every point of a block, by the threads of rayon's current pool; returns the worst (most negative) of the
/// status codes. The results are those of [`Hyperelastic::block`], bit by bit, however many threads there are.
///
/// # Errors
/// As for [`Hyperelastic::block`].
pub fn parallel_block<T: Precision + Send + Sync>(law: &Hyperelastic<T>, arrays: Arrays<'_, T>) -> Result<i32, Error> {
    rayon::iter::split(Block::new(arrays)?, halves)
        .map(|part| law.checked_block(part))
        .try_reduce(|| status::OK, |a, b| Ok(a.min(b)))
}

/// Two halves of a block, where it is large enough for two.
fn halves<T: Precision>(block: Block<'_, T>) -> (Block<'_, T>, Option<Block<'_, T>>) {
    if block.points() < 2 * FEWEST {
        return (block, None);
    }
    let half = block.points() / 2 / GRAIN * GRAIN;
    let (first, rest) = block.split_at(half);
    (first, Some(rest))
}
