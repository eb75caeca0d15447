//! Numbers of chance that follow from a seed and some words alone: the same on every machine, in any order.

/// A number between 0 and 1, neither of them.
pub fn uniform(seed: u64, words: impl IntoIterator<Item = u64>) -> f64 {
    let mixed = words.into_iter().fold(mix(seed), |state, word| mix(state ^ word));
    ((mixed >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
}

/// One step of SplitMix64 (Steele, Lea and Flood 2014): every bit of the state moves every bit of the result.
pub fn mix(state: u64) -> u64 {
    let state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let state = (state ^ state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let state = (state ^ state >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    state ^ state >> 31
}
