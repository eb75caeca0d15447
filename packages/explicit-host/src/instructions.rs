//! Loops over elements in the widest instructions of the processor; the yarn takes a quarter longer in those that every
//! processor has.

#[cfg(target_arch = "x86_64")]
use toron::Level;

/// Work whose loops are to be compiled for each set of instructions: `run` and all that it calls must be
/// `#[inline(always)]`.
pub trait Loops {
    fn run(self);
}

/// Runs the loops; no operation is fused, so that the results are the same in all instructions.
pub fn run_widest(loops: impl Loops) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
        fn avx512(loops: impl Loops) {
            loops.run();
        }
        #[target_feature(enable = "avx2,fma")]
        fn avx2(loops: impl Loops) {
            loops.run();
        }
        match Level::best() {
            // SAFETY: the processor has the instructions.
            Level::Avx512 => return unsafe { avx512(loops) },
            // SAFETY: the processor has the instructions.
            Level::Avx2 => return unsafe { avx2(loops) },
            Level::Baseline => {}
        }
    }
    loops.run();
}
