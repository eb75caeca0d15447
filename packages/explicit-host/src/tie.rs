//! Nodes that move with the corners of a face, where a fine mesh meets a coarse one.
//!
//! What acts on a tied node acts on the corners, by its place on the face, and so does what it weighs: momentum is kept
//! to rounding, and the work of every force is the same on both sides. On each corner rests the sum over a row of the
//! masses that the tie gives it, which with shares that are not negative is no less than those themselves: no frequency
//! rises.

/// A node in the middle of a face of four corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tie {
    pub node: u32,
    pub corners: [u32; 4],
    /// The corners' shares: none below 0, together 1.
    pub shares: [f64; 4],
}

impl Tie {
    /// The corners and their shares.
    #[inline(always)]
    pub fn parts(&self) -> impl Iterator<Item = (usize, f64)> {
        self.corners.into_iter().map(|corner| corner as usize).zip(self.shares)
    }

    /// The corners on which the node rests.
    pub fn rests_on(&self) -> impl Iterator<Item = u32> {
        self.corners.into_iter().zip(self.shares).filter(|(_, share)| *share > 0.0).map(|(corner, _)| corner)
    }
}

/// Gives the corners what a number of the tied nodes is on them, and takes it from these.
pub fn hand_over(ties: &[Tie], numbers: &mut [f64]) {
    for tie in ties {
        let number = std::mem::take(&mut numbers[tie.node as usize]);
        for (corner, share) in tie.parts() {
            numbers[corner] += share * number;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_handed_over_is_kept() {
        let ties = [
            Tie { node: 4, corners: [0, 1, 2, 3], shares: [0.25; 4] },
            Tie { node: 5, corners: [0, 1, 2, 3], shares: [0.0, 0.5, 0.0, 0.5] },
        ];
        let mut masses = [1.0, 2.0, 3.0, 4.0, 0.4, 0.8];
        hand_over(&ties, &mut masses);
        assert_eq!(masses, [1.1, 2.5, 3.1, 4.5, 0.0, 0.0]);
        assert_eq!(ties[1].rests_on().collect::<Vec<_>>(), [1, 3]);
    }
}
