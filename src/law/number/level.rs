//! Levels of instructions that the processor may have.

/// A set of instructions that the kernels are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Instructions that every processor of the architecture has.
    Baseline,
    /// AVX2 and FMA: x86-64-v3.
    Avx2,
    /// AVX-512 F, DQ and VL.
    Avx512,
}

impl Level {
    /// All levels, from the lowest.
    pub const ALL: [Level; 3] = [Level::Baseline, Level::Avx2, Level::Avx512];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Level::Baseline => "baseline",
            Level::Avx2 => "avx2",
            Level::Avx512 => "avx512",
        }
    }

    /// The best level that this processor has. Compiled with `--cfg toron_without_avx512` the library takes every
    /// processor for one that lacks AVX-512: for tests of what happens on those.
    #[inline(always)]
    pub fn best() -> Level {
        #[cfg(target_arch = "x86_64")]
        {
            // This and `has_fma` hold the only global state of the library: what the processor can do, determined once.
            cpufeatures::new!(has_avx512, "avx512f", "avx512dq", "avx512vl", "avx2", "fma");
            if !cfg!(toron_without_avx512) && has_avx512::get() {
                return Level::Avx512;
            }
            if has_fma() {
                return Level::Avx2;
            }
        }
        Level::Baseline
    }
}

/// Whether the processor has AVX2 and fused multiply-add.
#[inline(always)]
pub(crate) fn has_fma() -> bool {
    #[cfg(target_arch = "x86_64")]
    {
        cpufeatures::new!(has_avx2, "avx2", "fma");
        has_avx2::get()
    }
    #[cfg(not(target_arch = "x86_64"))]
    false
}
