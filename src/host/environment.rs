//! The change from the caller's floating-point environment, which no entry point computes in or alters, to the default
//! one.
//!
//! Some solvers trap floating-point exceptions, flush subnormal numbers to zero or round in another direction. The
//! compiler assumes none of that: it may compute in unused lanes, speculate a division whose result is dropped, and
//! fold constants as if rounding to nearest. So each entry point computes in the default environment of IEEE 754
//! (nothing trapped, subnormal numbers kept, round to nearest) and restores the caller's when it is done, sticky
//! exception flags included.
//!
//! On x86-64 the environment is the register MXCSR; nothing here uses the x87 registers. On other processors the work
//! runs in the caller's environment.

/// Nothing trapped, no flag raised, subnormal numbers kept, round to nearest: MXCSR as a process starts with it.
#[cfg(target_arch = "x86_64")]
const DEFAULT_MXCSR: u32 = 0x1f80;

/// Runs `work` in the default floating-point environment and restores the caller's.
///
/// `work` must not panic: a panic cannot unwind through the assembly, and the process would abort.
#[inline(always)]
pub fn in_default_environment<R>(work: impl FnOnce() -> R) -> R {
    in_default_environment_then(work, |result| result)
}

/// As [`in_default_environment`], and what `conclude` makes of the result there.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub(super) fn in_default_environment_then<A, R, W: FnOnce() -> A, C: FnOnce(A) -> R>(work: W, conclude: C) -> R {
    use core::mem::{ManuallyDrop, MaybeUninit};

    struct Call<W, C, R> {
        work: ManuallyDrop<W>,
        conclude: ManuallyDrop<C>,
        result: MaybeUninit<R>,
    }

    /// # Safety
    /// `call` is valid and its work has not been done.
    unsafe extern "sysv64" fn run<A, R, W: FnOnce() -> A, C: FnOnce(A) -> R>(call: *mut Call<W, C, R>) {
        // SAFETY: `call` is valid, and both are taken once.
        unsafe {
            let answer = ManuallyDrop::take(&mut (*call).work)();
            (*call).result.write(ManuallyDrop::take(&mut (*call).conclude)(answer));
        }
    }

    let mut call =
        Call { work: ManuallyDrop::new(work), conclude: ManuallyDrop::new(conclude), result: MaybeUninit::uninit() };
    let run: unsafe extern "sysv64" fn(*mut Call<W, C, R>) = run::<A, R, W, C>;
    // The caller's MXCSR, and the one to run in. All arithmetic is in `run`: the compiler may move operations across a
    // change of environments that it does not know of, but not out of a function that only the assembly calls.
    let mut words = [0, DEFAULT_MXCSR];
    // SAFETY: `run` has the calling convention whose registers are given up, keeps r12 as that convention demands, and
    // takes its argument in rdi; the stack is aligned for a call, since the block does not claim to leave it alone.
    // MXCSR is the caller's again at the end of the block.
    unsafe {
        core::arch::asm!(
            "stmxcsr [r12]",
            "ldmxcsr [r12 + 4]",
            "call r13",
            "ldmxcsr [r12]",
            in("r12") words.as_mut_ptr(),
            in("r13") run,
            in("rdi") &raw mut call,
            clobber_abi("sysv64"),
        );
        call.result.assume_init()
    }
}

/// Runs both in the caller's environment, which is not changed on this architecture.
#[cfg(not(target_arch = "x86_64"))]
#[inline(always)]
pub(super) fn in_default_environment_then<A, R>(work: impl FnOnce() -> A, conclude: impl FnOnce(A) -> R) -> R {
    conclude(work())
}
