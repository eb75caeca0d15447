//! Many points at once: the same law over component-major arrays.
//!
//! Component c of point i stands at `c * leading_dimension + i`, as LS-DYNA (nlq), Abaqus (nblock) and OpenRadioss (nel)
//! lay their arrays out. What a caller leaves out is neither read, computed nor written.
//!
//! | array | components |
//! |---|---|
//! | `deformation_gradient` | F11 F21 F31 F12 F22 F32 F13 F23 F33 (columns of F) |
//! | `fibre` | m1 m2 m3, any length |
//! | `stress` | σ11 σ22 σ33 σ12 σ23 σ31 (Cauchy) |
//! | `energies` | W_el W_tc W_td W_ld |
//! | `invariants` | I_el I_tc I_td I_ld |
//! | `failure` | failure index, failed, alive |
//! | `modes` | S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31 (second Piola–Kirchhoff) |
//! | `wave_speed` | a bound of the wave speed, at the reference density `density` |
//! | `tangent` | of the `measure`: 6×6 or 9×9, entry (row, column) at 6 row + column or 9 row + column; all of it, symmetric |

pub mod linear;
#[cfg(test)]
mod tests;
#[cfg(target_arch = "x86_64")]
mod x86;
#[cfg(target_arch = "x86_64")]
pub(super) use x86::root;

use core::marker::PhantomData;
use core::mem::MaybeUninit;
use core::ops::Range;

use super::elementary::{Power, Reduced};
use super::hyperelastic::{Hyperelastic, Kirchhoff, Request};
use super::kinematics::{Axes, FibreFrame, FirstAxis, Kinematics, Logarithms, Section, Strain, Stretch};
use super::point::{self, Alone, Call, Derivative, InGeneralAxes, Point, Sink, Source, StressAndState, cells};
use super::real::{Real, Single};
use super::state::{self, HYPERELASTIC_STATE};
use super::status::{self, Error};
use super::tangent::{Measure, Moduli, Nine, Six, overflows, unrepresentable};
use super::wave_speed;

/// A block as a host passes it: null is left out.
///
/// The deformation gradient, the fibre direction and the stress come as one pointer a component, since some hosts keep
/// them in arrays of their own; the other arrays are component-major with the leading dimension. `energies_old`,
/// `invariants_old` and `failure_old` are the old state, null a fresh one; they may be the same arrays as the new ones.
#[derive(Clone, Copy, Debug)]
pub struct Pointers<T> {
    pub n: usize,
    pub leading_dimension: usize,
    pub deformation_gradient: [*const T; 9],
    pub fibre: [*const T; 3],
    pub energies_old: *const T,
    pub invariants_old: *const T,
    pub failure_old: *const T,
    pub density: T,
    pub stress: [*mut T; 6],
    pub energies: *mut T,
    pub invariants: *mut T,
    pub failure: *mut T,
    pub modes: *mut T,
    pub wave_speed: *mut T,
    pub tangent: *mut T,
    pub measure: Measure,
    pub status: *mut i32,
    /// The instructions to use, no better than the processor has; `None`: the best.
    pub level: Option<Level>,
}

/// The pointers to the components of a component-major array; all null where the array is.
#[inline(always)]
pub fn components<T, const N: usize>(array: *const T, leading_dimension: usize) -> [*const T; N] {
    let (mut pointers, mut c) = ([array; N], 1);
    while c < N && !array.is_null() {
        pointers[c] = array.wrapping_add(c.wrapping_mul(leading_dimension));
        c += 1;
    }
    pointers
}

/// Likewise, for writing.
#[inline(always)]
pub fn components_mut<T, const N: usize>(array: *mut T, leading_dimension: usize) -> [*mut T; N] {
    let (mut pointers, mut c) = ([array; N], 1);
    while c < N && !array.is_null() {
        pointers[c] = array.wrapping_add(c.wrapping_mul(leading_dimension));
        c += 1;
    }
    pointers
}

/// A block as Rust passes it: the state in place, old on entry and new on return.
#[derive(Debug, Default)]
pub struct Arrays<'a, T> {
    pub n: usize,
    pub leading_dimension: usize,
    pub deformation_gradient: &'a [T],
    pub fibre: Option<&'a [T]>,
    pub density: T,
    pub stress: Option<&'a mut [T]>,
    pub energies: Option<&'a mut [T]>,
    pub invariants: Option<&'a mut [T]>,
    pub failure: Option<&'a mut [T]>,
    pub modes: Option<&'a mut [T]>,
    pub wave_speed: Option<&'a mut [T]>,
    pub tangent: Option<&'a mut [T]>,
    pub measure: Measure,
    pub status: Option<&'a mut [i32]>,
    pub level: Option<Level>,
}

/// A block whose arrays have been checked. It can be cut into parts, which share no point and may go to other threads.
#[derive(Debug)]
pub struct Block<'a, T> {
    pointers: Pointers<T>,
    arrays: PhantomData<&'a mut T>,
}

// SAFETY: a block holds the arrays that it writes exclusively. Its parts hold different points, and with the leading
// dimension no less than n different points stand at different places.
unsafe impl<T: Send + Sync> Send for Block<'_, T> {}

impl<'a, T: Precision> Block<'a, T> {
    /// Checks that the arrays hold the points.
    ///
    /// # Errors
    /// An array that is too short, a leading dimension below n.
    pub fn new(arrays: Arrays<'a, T>) -> Result<Self, Error> {
        let Arrays { n, leading_dimension, .. } = arrays;
        let needed = |components: usize| match components {
            0 => 0,
            _ if n == 0 => 0,
            _ => (components - 1).saturating_mul(leading_dimension).saturating_add(n),
        };
        let check = |name: &'static str, length: usize, components: usize| {
            if length >= needed(components) {
                return Ok(());
            }
            let wanted = i64::try_from(needed(components)).unwrap_or(i64::MAX);
            Err(Error::Count { code: status::BAD_COUNT, what: name, found: length as i64, wanted })
        };
        check("entries of deformation_gradient", arrays.deformation_gradient.len(), 9)?;
        let input = |name, array: Option<&[T]>, components| match array {
            Some(array) => check(name, array.len(), components).map(|()| array.as_ptr()),
            None => Ok(core::ptr::null()),
        };
        let output = |name, array: Option<&mut [T]>, components| match array {
            Some(array) => check(name, array.len(), components).map(|()| array.as_mut_ptr()),
            None => Ok(core::ptr::null_mut()),
        };
        let energies = output("entries of energies", arrays.energies, 4)?;
        let invariants = output("entries of invariants", arrays.invariants, 4)?;
        let failure = output("entries of failure", arrays.failure, 3)?;
        let pointers = Pointers {
            n,
            leading_dimension,
            deformation_gradient: components(arrays.deformation_gradient.as_ptr(), leading_dimension),
            fibre: components(input("entries of fibre", arrays.fibre, 3)?, leading_dimension),
            energies_old: energies,
            invariants_old: invariants,
            failure_old: failure,
            density: arrays.density,
            stress: components_mut(output("entries of stress", arrays.stress, 6)?, leading_dimension),
            energies,
            invariants,
            failure,
            modes: output("entries of modes", arrays.modes, 24)?,
            wave_speed: output("entries of wave_speed", arrays.wave_speed, 1)?,
            tangent: output("entries of tangent", arrays.tangent, arrays.measure.components())?,
            measure: arrays.measure,
            status: match arrays.status {
                Some(array) => check("entries of status", array.len(), 1).map(|()| array.as_mut_ptr())?,
                None => core::ptr::null_mut(),
            },
            level: arrays.level,
        };
        // Parts of columns that overlap would not be disjoint.
        if leading_dimension < n {
            return Err(leading_dimension_below(n, leading_dimension));
        }
        Ok(Block { pointers, arrays: PhantomData })
    }

    /// How many points.
    pub fn points(&self) -> usize {
        self.pointers.n
    }

    /// The first `count` points, all where there are no more, and the rest.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let count = count.min(self.pointers.n);
        let first = Pointers { n: count, ..self.pointers };
        let rest = self.pointers.from(count);
        [first, rest].map(|pointers| Block { pointers, arrays: PhantomData }).into()
    }
}

impl<T> Pointers<T> {
    /// The points from `first` ≤ n on.
    fn from(self, first: usize) -> Self {
        let input = |p: *const T| if p.is_null() { p } else { p.wrapping_add(first) };
        let output = |p: *mut T| if p.is_null() { p } else { p.wrapping_add(first) };
        Pointers {
            n: self.n - first,
            deformation_gradient: self.deformation_gradient.map(input),
            fibre: self.fibre.map(input),
            energies_old: input(self.energies_old),
            invariants_old: input(self.invariants_old),
            failure_old: input(self.failure_old),
            stress: self.stress.map(output),
            energies: output(self.energies),
            invariants: output(self.invariants),
            failure: output(self.failure),
            modes: output(self.modes),
            wave_speed: output(self.wave_speed),
            tangent: output(self.tangent),
            status: if self.status.is_null() { self.status } else { self.status.wrapping_add(first) },
            ..self
        }
    }
}

fn leading_dimension_below(n: usize, leading_dimension: usize) -> Error {
    Error::Count {
        code: status::BAD_LEADING_DIMENSION,
        what: "leading dimension",
        found: leading_dimension as i64,
        wanted: n as i64,
    }
}

impl<T: Precision> Hyperelastic<T> {
    /// The law at every point of a block; returns the worst (most negative) of their status codes.
    ///
    /// # Errors
    /// An array that is too short, a leading dimension below n, a density that is not positive where the wave speed is
    /// wanted.
    pub fn block(&self, arrays: Arrays<'_, T>) -> Result<i32, Error> {
        self.checked_block(Block::new(arrays)?)
    }

    /// Likewise, for a block or a part of one.
    ///
    /// # Errors
    /// A density that is not positive where the wave speed is wanted.
    pub fn checked_block(&self, block: Block<'_, T>) -> Result<i32, Error> {
        // SAFETY: every array is as long as the block needs; the state alone is read and written, through one pointer.
        unsafe { self.raw_block(&block.pointers) }
    }

    /// The law at every point of a block of raw arrays; returns the worst (most negative) of their status codes.
    ///
    /// # Errors
    /// A null deformation gradient, a leading dimension below n, a density that is not positive where the wave speed is
    /// wanted.
    ///
    /// # Safety
    /// Every pointer that is not null points to as many values as the block's size and the table above say, valid for
    /// reading or writing; `stress` and `fibre` are null in all their components or in none; outputs overlap nothing but,
    /// exactly, the old state they replace.
    pub unsafe fn raw_block(&self, block: &Pointers<T>) -> Result<i32, Error> {
        let request = block.check()?;
        if block.n == 0 {
            return Ok(status::OK);
        }
        let level = block.level();
        if block.in_place() {
            // SAFETY: the caller answers for the arrays, and the processor has the level's instructions.
            return Ok(unsafe { T::dispatch(level, self, block, request) });
        }
        // An old state elsewhere is brought over part by part: what has been copied is then still in the nearest cache.
        let mut worst = status::OK;
        for first in (0..block.n).step_by(TAKEN_OVER) {
            let mut points = block.from(first);
            points.n = points.n.min(TAKEN_OVER);
            // SAFETY: as above.
            unsafe {
                points.take_over();
                worst = worst.min(T::dispatch(level, self, &points, request));
            }
        }
        Ok(worst)
    }
}

/// The law of these properties at every point of a block, for a host that hands them over with it; otherwise as
/// [`Hyperelastic::raw_block`].
///
/// # Errors
/// The first property that is wrong, or what `raw_block` says; nothing is written.
///
/// # Safety
/// As for [`Hyperelastic::raw_block`].
pub unsafe fn raw_block_of<T: Precision>(properties: &[T], block: &Pointers<T>) -> Result<i32, Error> {
    // Up to so many points it takes less time to prepare the law with each of them than once and to set up the block.
    const FEW: usize = 3;
    // SAFETY: the caller answers for the arrays.
    unsafe {
        let few = (1..=FEW).contains(&block.n) && block.tangent.is_null() && block.level() > Level::Baseline;
        match block.check() {
            Ok(request) if few => T::few(properties, block, request),
            _ => Hyperelastic::new(properties)?.raw_block(block), // with what is wrong about the properties first
        }
    }
}

/// How many points' old state is brought over at a time: whole groups of registers in either precision.
const TAKEN_OVER: usize = 2 * STAGED * WIDEST;

impl<T: Precision> Pointers<T> {
    /// What the block asks for, if it can be evaluated.
    ///
    /// # Errors
    /// As for [`Hyperelastic::raw_block`].
    #[inline(always)]
    fn check(&self) -> Result<Request, Error> {
        if self.n > 0 && self.deformation_gradient.iter().any(|pointer| pointer.is_null()) {
            return Err(Error::Plain(status::NULL_ARGUMENT));
        }
        if self.leading_dimension < self.n {
            return Err(leading_dimension_below(self.n, self.leading_dimension));
        }
        if self.n > 0 && !self.wave_speed.is_null() {
            wave_speed::check_density(self.density)?;
        }
        Ok(Request {
            stress: !self.stress[0].is_null(),
            energies: !self.energies.is_null(),
            invariants: !self.invariants.is_null(),
            failure: !self.failure.is_null(),
            modes: !self.modes.is_null(),
            wave_modulus: !self.wave_speed.is_null(),
        })
    }

    /// The instructions to use.
    #[inline(always)]
    fn level(&self) -> Level {
        self.level.unwrap_or(Level::Avx512).min(Level::best())
    }

    /// Whether the old state, as far as it is wanted, is where the new one goes.
    fn in_place(&self) -> bool {
        let pairs = [
            (self.energies_old, self.energies),
            (self.invariants_old, self.invariants),
            (self.failure_old, self.failure),
        ];
        pairs.iter().all(|&(old, new)| new.is_null() || old == new.cast_const())
    }

    /// Brings the old state, or zeros where there is none, to the arrays of the new one: the loops work in place.
    ///
    /// # Safety
    /// As for [`Hyperelastic::raw_block`].
    unsafe fn take_over(&mut self) {
        let (n, stride) = (self.n, self.leading_dimension);
        let groups = [
            (&mut self.energies_old, self.energies, 4),
            (&mut self.invariants_old, self.invariants, 4),
            (&mut self.failure_old, self.failure, 3),
        ];
        for (old, new, components) in groups {
            if new.is_null() || old.cast_mut() == new {
                continue;
            }
            for c in 0..components {
                // SAFETY: the caller's promise: arrays that are not the same do not overlap. A number whose bytes are all 0 is 0.
                unsafe {
                    match old.is_null() {
                        true => new.add(c * stride).write_bytes(0, n),
                        false => new.add(c * stride).copy_from_nonoverlapping(old.add(c * stride), n),
                    }
                }
            }
            *old = new;
        }
    }
}

/// A set of instructions to run the lanes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// What every processor of the architecture has.
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

    /// The best one that this processor has.
    pub fn best() -> Level {
        #[cfg(target_arch = "x86_64")]
        {
            // This and `fused` are the only global state of the library: what the processor can do, found out once.
            cpufeatures::new!(has_avx512, "avx512f", "avx512dq", "avx512vl", "avx2", "fma");
            if has_avx512::get() {
                return Level::Avx512;
            }
            if fused() {
                return Level::Avx2;
            }
        }
        Level::Baseline
    }
}

/// Whether the processor has AVX2 and fused multiply-add.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn fused() -> bool {
    cpufeatures::new!(has_avx2, "avx2", "fma");
    has_avx2::get()
}

/// Points side by side in lanes that are loaded from and stored to arrays of T.
pub trait Lanes<T>: Real {
    /// How many points.
    const COUNT: usize;
    /// # Safety
    /// `from` points to `COUNT` values.
    unsafe fn load(from: *const T) -> Self;
    /// # Safety
    /// `to` has room for `COUNT` values.
    unsafe fn store(self, to: *mut T);
    /// Stores the points for which a mask holds.
    ///
    /// # Safety
    /// `to` points to `COUNT` values.
    #[inline(always)]
    unsafe fn store_where(self, mask: Self::Mask, to: *mut T) {
        // SAFETY: the caller's promise.
        unsafe { Self::select(mask, self, Self::load(to)).store(to) }
    }
    /// Stores small integers.
    ///
    /// # Safety
    /// `to` has room for `COUNT` values.
    unsafe fn store_integers(self, to: *mut i32);
    /// Has the processor fetch what is at an address, if there is anything.
    fn prefetch(place: *const T);
    /// Whether a mask holds for any of the points.
    fn any(mask: Self::Mask) -> bool;
}

/// The kernel relies on what a precision is (bytes all 0 are the number 0), so that there are no others.
mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A precision that the block kernel is built for.
pub trait Precision: Real<Mask = bool> + Into<f64> + PartialEq + sealed::Sealed {
    /// Runs the kernel at a level.
    ///
    /// # Safety
    /// As for [`Hyperelastic::raw_block`]; the processor has the level's instructions.
    unsafe fn dispatch(level: Level, law: &Hyperelastic<Self>, block: &Pointers<Self>, request: Request) -> i32;

    /// The law of these properties at the points of a block one by one, in the operations of the lanes with fused multiply-add; no
    /// tangent.
    ///
    /// # Errors
    /// The first property that is wrong; nothing is written.
    ///
    /// # Safety
    /// As for `dispatch`, on a processor with AVX2 and FMA.
    unsafe fn few(properties: &[Self], block: &Pointers<Self>, request: Request) -> Result<i32, Error>;

    /// The law at one point for a host that hands over the properties with it, by the best instructions: within four roundings
    /// of the input's sensitivity of what [`Hyperelastic::point_along`] gives, with the same status.
    ///
    /// # Errors
    /// The first property that is wrong; nothing is handed to the sink.
    #[inline(always)]
    fn once<D: Derivative<N>, S: Sink<Self, N>, const N: usize>(call: Call<'_, Self, D, S, N>) -> Result<(), Error> {
        call.evaluate_plainly()
    }
}

/// A kernel for some lanes, with the instructions that they need.
macro_rules! kernel {
    ($(#[$features:meta])? $name:ident, $t:ty, $lanes:ty) => {
        $(#[$features])?
        unsafe fn $name<const WANT: u8>(law: &Hyperelastic<$t>, block: &Pointers<$t>, points: Range<usize>) -> i32 {
            // SAFETY: the caller's promise.
            unsafe { sweep::<$t, $lanes, WANT>(law, block, points) }
        }
    };
}

macro_rules! precision {
    ($t:ident: $baseline:ty, $avx2:ty, $avx512:ty, $one:ty, $point:ty) => {
        impl Lanes<$t> for $t {
            const COUNT: usize = 1;
            #[inline(always)]
            unsafe fn load(from: *const $t) -> Self {
                // SAFETY: the caller's promise.
                unsafe { *from }
            }
            #[inline(always)]
            unsafe fn store(self, to: *mut $t) {
                // SAFETY: the caller's promise.
                unsafe { *to = self }
            }
            #[inline(always)]
            unsafe fn store_integers(self, to: *mut i32) {
                // SAFETY: the caller's promise.
                unsafe { *to = self as i32 }
            }
            #[inline(always)]
            fn prefetch(_: *const $t) {}
            #[inline(always)]
            fn any(mask: bool) -> bool {
                mask
            }
        }

        impl Precision for $t {
            #[cfg(target_arch = "x86_64")]
            #[inline(always)]
            fn once<D: Derivative<N>, S: Sink<$t, N>, const N: usize>(
                call: Call<'_, $t, D, S, N>,
            ) -> Result<(), Error> {
                #[target_feature(enable = "avx2,fma")]
                fn evaluate<D: Derivative<N>, S: Sink<$t, N>, const N: usize>(
                    call: Call<'_, $t, D, S, N>,
                ) -> Result<(), Error> {
                    call.evaluate::<$point>()
                }
                if !fused() {
                    return call.evaluate_plainly();
                }
                // SAFETY: the processor has the instructions.
                unsafe { evaluate(call) }
            }

            unsafe fn few(properties: &[$t], block: &Pointers<$t>, request: Request) -> Result<i32, Error> {
                #[cfg_attr(target_arch = "x86_64", target_feature(enable = "avx2,fma"))]
                unsafe fn fused(properties: &[$t], block: &Pointers<$t>, request: Request) -> Result<i32, Error> {
                    // SAFETY: the caller's promise.
                    unsafe {
                        match request {
                            Request::STRESS_AND_STATE => {
                                without_tangent::<$t, $one, _, _>(properties, block, StressAndState, 0..block.n)
                            }
                            _ => without_tangent::<$t, $one, _, _>(properties, block, Alone(request), 0..block.n),
                        }
                    }
                }
                // SAFETY: the caller's promise.
                unsafe { fused(properties, block, request) }
            }

            unsafe fn dispatch(level: Level, law: &Hyperelastic<$t>, block: &Pointers<$t>, request: Request) -> i32 {
                #[cfg(target_arch = "x86_64")]
                {
                    kernel!(
                        #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
                        avx512,
                        $t,
                        $avx512
                    );
                    kernel!(
                        #[target_feature(enable = "avx2,fma")]
                        avx2,
                        $t,
                        $avx2
                    );
                    kernel!(baseline, $t, $baseline);
                    #[target_feature(enable = "avx2,fma")]
                    unsafe fn fused_singly(
                        law: &Hyperelastic<$t>,
                        block: &Pointers<$t>,
                        request: Request,
                        points: Range<usize>,
                    ) -> i32 {
                        // SAFETY: the caller's promise.
                        unsafe { singly::<$t, $one>(law, block, request, points) }
                    }
                    #[inline(never)]
                    unsafe fn plain_singly(
                        law: &Hyperelastic<$t>,
                        block: &Pointers<$t>,
                        request: Request,
                        points: Range<usize>,
                    ) -> i32 {
                        // SAFETY: the caller's promise.
                        unsafe { singly::<$t, $t>(law, block, request, points) }
                    }
                    // What fills no register goes to narrower ones, at last point by point: the same operations, the same bits.
                    let (n, mut worst) = (block.n, status::OK);
                    let whole = |lanes: usize| n - n % lanes;
                    // SAFETY: the caller has found the instructions, and answers for the arrays.
                    unsafe {
                        if level == Level::Baseline {
                            let part = 0..whole(<$baseline as Lanes<$t>>::COUNT);
                            if !part.is_empty() {
                                worst = as_asked!(baseline, law, block, part);
                            }
                            let rest = part.end..n;
                            return worst.min(plain_singly(law, block, request, rest));
                        }
                        let mut part = 0..0;
                        if level == Level::Avx512 {
                            part.end = whole(<$avx512 as Lanes<$t>>::COUNT);
                            if !part.is_empty() {
                                worst = specialised!(avx512, law, block, request, part);
                            }
                        }
                        part = part.end..whole(<$avx2 as Lanes<$t>>::COUNT);
                        if !part.is_empty() {
                            worst = worst.min(specialised!(avx2, law, block, request, part));
                        }
                        part = part.end..n;
                        if !part.is_empty() {
                            worst = worst.min(fused_singly(law, block, request, part));
                        }
                    }
                    worst
                }
                #[cfg(not(target_arch = "x86_64"))]
                {
                    let (_, all) = ((level, request), 0..block.n);
                    kernel!(scalar, $t, $t);
                    // SAFETY: the caller's promise.
                    unsafe { as_asked!(scalar, law, block, all) }
                }
            }
        }
    };
}

// What a kernel is built for, so that a loop holds no decision about it.
const STRESS: u8 = 0;
const STATE: u8 = 1; // with energies, invariants, failure and the latch
const SHEAR: u8 = 4;
const FIBRES: u8 = 8; // a fibre direction for each point
const ALIGNED: u8 = 16; // the property's fibre lies along the first axis
/// The kernel that asks the block at every turn, but for the shear and the property's fibre.
const AS_ASKED: u8 = 128;

/// Calls the kernel built for exactly what is asked, or the one that asks at every turn.
#[cfg(target_arch = "x86_64")]
macro_rules! specialised {
    ($kernel:ident, $law:ident, $block:ident, $request:ident, $points:ident) => {{
        let Request { stress, energies, invariants, failure, modes, wave_modulus } = $request;
        let usual = stress && !modes && !wave_modulus && $block.tangent.is_null();
        let latch = !$block.failure_old.is_null();
        match (usual, energies, invariants && failure, invariants || latch) {
            (true, false, false, false) => wanting!(STRESS, $kernel, $law, $block, $points),
            (true, true, true, true) => wanting!(STATE, $kernel, $law, $block, $points),
            _ => as_asked!($kernel, $law, $block, $points),
        }
    }};
}

/// Calls the kernel built for what is wanted, for the shear and for the fibre.
#[cfg(target_arch = "x86_64")]
macro_rules! wanting {
    ($want:expr, $kernel:ident, $law:ident, $block:ident, $points:ident) => {
        match ($law.shears(), !$block.fibre[0].is_null(), $law.aligned) {
            (false, true, _) => $kernel::<{ $want + FIBRES }>($law, $block, $points.clone()),
            (true, true, _) => $kernel::<{ $want + SHEAR + FIBRES }>($law, $block, $points.clone()),
            (false, false, true) => $kernel::<{ $want + ALIGNED }>($law, $block, $points.clone()),
            (true, false, true) => $kernel::<{ $want + SHEAR + ALIGNED }>($law, $block, $points.clone()),
            (false, false, false) => $kernel::<{ $want }>($law, $block, $points.clone()),
            (true, false, false) => $kernel::<{ $want + SHEAR }>($law, $block, $points.clone()),
        }
    };
}

/// Calls the kernel that asks at every turn.
macro_rules! as_asked {
    ($kernel:ident, $law:ident, $block:ident, $points:ident) => {
        // Beside the tangent the products with the frame that an aligned fibre saves weigh little.
        match ($law.shears(), $law.aligned && $block.fibre[0].is_null() && $block.tangent.is_null()) {
            (false, true) => $kernel::<{ AS_ASKED + ALIGNED }>($law, $block, $points.clone()),
            (true, true) => $kernel::<{ AS_ASKED + SHEAR + ALIGNED }>($law, $block, $points.clone()),
            (false, false) => $kernel::<AS_ASKED>($law, $block, $points.clone()),
            (true, false) => $kernel::<{ AS_ASKED + SHEAR }>($law, $block, $points.clone()),
        }
    };
}
#[cfg(target_arch = "x86_64")]
precision!(f64: x86::F64x2, x86::F64x4, x86::F64x8, x86::F64x1, x86::F64Point);
#[cfg(target_arch = "x86_64")]
precision!(f32: x86::F32x4, x86::F32x8, x86::F32x16, x86::F32x1, x86::F32Point);
#[cfg(not(target_arch = "x86_64"))]
precision!(f64: f64, f64, f64, f64, f64);
#[cfg(not(target_arch = "x86_64"))]
precision!(f32: f32, f32, f32, f32, f32);

/// The kernel, for points that fill whole registers.
///
/// # Safety
/// As for [`Hyperelastic::raw_block`], on a processor that has the lanes' instructions, for points of the block whose number is
/// a multiple of COUNT; `WANT` asks for nothing that the block leaves out.
#[inline(always)]
unsafe fn sweep<T: Precision, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<T>,
    block: &Pointers<T>,
    points: Range<usize>,
) -> i32 {
    let lanes = law.lanes::<R>();
    let mut worst = R::splat(0.0);
    let mut i = points.start;
    while i < points.end {
        let count = STAGED.min((points.end - i) / R::COUNT);
        // SAFETY: i + count COUNT ≤ the end, and the caller's promise.
        unsafe { evaluate::<T, R, WANT>(&lanes, block, i, count, &mut worst) };
        i += count * R::COUNT;
    }
    least_code(worst)
}

/// The law at points one by one, in R. Returns the worst status.
///
/// # Errors
/// The first property that is wrong, if the law has not been prepared.
///
/// # Safety
/// As for [`Hyperelastic::raw_block`], on a processor that has the instructions of R, for points of a block without a tangent.
#[inline(always)]
unsafe fn without_tangent<T: Precision, R: Single<T>, L: Source<T>, D: Derivative<0>>(
    source: L,
    block: &Pointers<T>,
    request: D,
    points: Range<usize>,
) -> Result<i32, Error> {
    let mut worst = status::OK;
    for i in points {
        // SAFETY: the caller's promise.
        let (f, fibre, state) = unsafe { (block.columns(i), block.direction(i), cells(block.old_state(i))) };
        let mut code = status::OK;
        let sink = OnePoint { block, i, code: &mut code };
        point::evaluate::<T, R, L, D, _, 0>(source, &f, fibre, &state, request, sink)?;
        worst = worst.min(code);
    }
    Ok(worst)
}

/// Likewise with a tangent.
///
/// # Errors
/// As for [`without_tangent`].
///
/// # Safety
/// As for [`without_tangent`], for points of a block with a tangent.
#[inline(always)]
unsafe fn with_tangent<T: Precision, R: Single<T>, L: Source<T>>(
    source: L,
    block: &Pointers<T>,
    request: Request,
    points: Range<usize>,
) -> Result<i32, Error> {
    let source = InGeneralAxes(source);
    let mut worst = status::OK;
    for i in points {
        // SAFETY: the caller's promise.
        let (f, fibre, state) = unsafe { (block.columns(i), block.direction(i), cells(block.old_state(i))) };
        let mut code = status::OK;
        let sink = OnePoint { block, i, code: &mut code };
        if block.measure == Measure::Nominal {
            point::evaluate::<T, R, _, _, _, 81>(source, &f, fibre, &state, Nine(request), sink)?;
        } else {
            let tangent = Six(request, block.measure);
            point::evaluate::<T, R, _, _, _, 21>(source, &f, fibre, &state, tangent, sink)?;
        }
        worst = worst.min(code);
    }
    Ok(worst)
}

/// The points of a block that fill no register, one by one, in R. Returns the worst status.
///
/// # Safety
/// As for [`Hyperelastic::raw_block`], on a processor that has the instructions of R, for points of the block.
#[inline(always)]
unsafe fn singly<T: Precision, R: Single<T>>(
    law: &Hyperelastic<T>,
    block: &Pointers<T>,
    request: Request,
    points: Range<usize>,
) -> i32 {
    // SAFETY: the caller's promise.
    let worst = unsafe {
        match block.tangent.is_null() {
            true => without_tangent::<T, R, _, _>(law, block, Alone(request), points),
            false => with_tangent::<T, R, _>(law, block, request, points),
        }
    };
    worst.unwrap_or(status::OK) // the law has been prepared
}

impl<T: Precision> Pointers<T> {
    /// The columns of F at a point.
    ///
    /// # Safety
    /// As for [`Hyperelastic::raw_block`], with i < n; so for the others.
    #[inline(always)]
    unsafe fn columns(&self, i: usize) -> [[T; 3]; 3] {
        // SAFETY: the caller's promise.
        let entry = |c: usize| unsafe { *self.deformation_gradient[c].add(i) };
        [[entry(0), entry(1), entry(2)], [entry(3), entry(4), entry(5)], [entry(6), entry(7), entry(8)]]
    }

    /// Its fibre direction, if it has one of its own.
    #[inline(always)]
    unsafe fn direction(&self, i: usize) -> Option<[T; 3]> {
        let [m_1, m_2, m_3] = self.fibre;
        // SAFETY: the caller's promise.
        if m_1.is_null() { None } else { Some(unsafe { [*m_1.add(i), *m_2.add(i), *m_3.add(i)] }) }
    }

    /// Its old state as far as it is wanted and there is one, else zeros; the latch stands even where no failure is wanted.
    #[inline(always)]
    unsafe fn old_state(&self, i: usize) -> [T; HYPERELASTIC_STATE] {
        let mut state = [T::splat(0.0); HYPERELASTIC_STATE];
        // SAFETY: the caller's promise.
        let old = |array: *const T, c: usize| unsafe { *array.add(c * self.leading_dimension + i) };
        if !self.energies.is_null() && !self.energies_old.is_null() {
            for (c, value) in state.iter_mut().skip(state::ENERGIES).take(4).enumerate() {
                *value = old(self.energies_old, c);
            }
        }
        if !self.invariants.is_null() && !self.invariants_old.is_null() {
            for (c, value) in state.iter_mut().skip(state::INVARIANTS).take(4).enumerate() {
                *value = old(self.invariants_old, c);
            }
        }
        if !self.failure.is_null() && !self.failure_old.is_null() {
            state[state::FAILURE_INDEX] = old(self.failure_old, 0);
        }
        if !self.failure_old.is_null() {
            state[state::FAILED] = old(self.failure_old, 1);
        }
        state
    }
}

/// Where the answer for one point of a block goes.
struct OnePoint<'a, T> {
    block: &'a Pointers<T>,
    i: usize,
    code: &'a mut i32,
}

impl<T: Precision> OnePoint<'_, T> {
    #[inline(always)]
    fn put(self, point: &Point<T>, tangent: &[T]) {
        let OnePoint { block, i, code } = self;
        *code = point.status;
        // SAFETY: whoever makes this has a block that can be evaluated, with i < n.
        let store = |values: &[T], array: *mut T| unsafe {
            if !array.is_null() {
                for (c, &value) in values.iter().enumerate() {
                    *array.add(c * block.leading_dimension + i) = value;
                }
            }
        };
        let [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, index, failed, alive] = point.state;
        store(&[w_el, w_tc, w_td, w_ld], block.energies);
        store(&[i_el, i_tc, i_td, i_ld], block.invariants);
        store(&[index, failed, alive], block.failure);
        store(point.modes.as_flattened(), block.modes);
        store(tangent, block.tangent);
        // SAFETY: as above.
        unsafe {
            if !block.stress[0].is_null() {
                for (column, value) in block.stress.into_iter().zip(point.stress) {
                    *column.add(i) = value;
                }
            }
            if !block.wave_speed.is_null() {
                *block.wave_speed.add(i) = wave_speed::wave_speed(point.wave_modulus, block.density);
            }
            if !block.status.is_null() {
                *block.status.add(i) = point.status;
            }
        }
    }
}

impl<T: Precision> Sink<T, 0> for OnePoint<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, _: [T; 0]) {
        self.put(&point, &[]);
    }
}

impl<T: Precision> Sink<T, 21> for OnePoint<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, moduli: [T; 21]) {
        self.put(&point, Moduli(moduli).matrix().as_flattened());
    }
}

impl<T: Precision> Sink<T, 81> for OnePoint<'_, T> {
    #[inline(always)]
    fn take(self, point: Point<T>, nominal: [T; 81]) {
        self.put(&point, &nominal);
    }
}

/// The least of the codes in the lanes, or 0.
#[inline(always)]
fn least_code<T, R: Lanes<T>>(codes: R) -> i32 {
    let mut stored = [0; WIDEST];
    // SAFETY: there is room for the widest lanes.
    unsafe { codes.store_integers(stored.as_mut_ptr()) };
    let mut code = status::OK;
    for &one in stored.iter().take(R::COUNT) {
        code = code.min(one);
    }
    code
}

/// The most lanes that there are.
const WIDEST: usize = 16;

/// How many registers of points go through a stage before the next one: a point's own operations wait for one another, so
/// that the processor needs several points in flight, and a whole evaluation is too long for it to look ahead.
const STAGED: usize = 6;

/// What a stage leaves for the next ones.
struct Stage<X>([MaybeUninit<X>; STAGED]);

impl<X> Stage<X> {
    #[inline(always)]
    fn new() -> Self {
        Stage([const { MaybeUninit::uninit() }; STAGED])
    }

    /// # Safety
    /// k < STAGED: without bounds a stage's loop has one way out.
    #[inline(always)]
    unsafe fn put(&mut self, k: usize, x: X) {
        // SAFETY: the caller's promise.
        unsafe { self.0.get_unchecked_mut(k) }.write(x);
    }

    /// # Safety
    /// What stands at k has been put there.
    #[inline(always)]
    unsafe fn get(&self, k: usize) -> &X {
        // SAFETY: the caller's promise.
        unsafe { self.0.get_unchecked(k).assume_init_ref() }
    }
}

/// What a stage hands to the next one and nobody else, in one place: what stages leave must stay in the nearest cache, with
/// the points' own numbers.
#[derive(Clone, Copy)]
union Step<R: Real> {
    logarithms: Logarithms<R>,
    power: Power<R>,
    reduced: Reduced<R>,
    powered: R,
}

/// Evaluates `count` registers of points from `i` on, in the axes that the kernel is built for.
///
/// # Safety
/// As for [`sweep`], with i + count COUNT ≤ n and count ≤ STAGED.
#[inline(always)]
unsafe fn evaluate<T: Precision, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Pointers<T>,
    i: usize,
    count: usize,
    worst: &mut R,
) {
    let mut frames = Stage::new();
    // SAFETY: the caller's promise; each stage reads what the one before has put.
    unsafe {
        if WANT & ALIGNED != 0 {
            staged::<T, R, FirstAxis, WANT>(law, block, i, count, |_| (FirstAxis, None), worst);
        } else if WANT & (FIBRES | AS_ASKED) != 0 {
            for k in 0..count {
                frames.put(k, frame::<T, R, WANT>(law, block, i + k * R::COUNT));
            }
            let fibre = |k: usize| {
                let (frame, usable) = *frames.get(k);
                (frame, Some(usable))
            };
            staged::<T, R, FibreFrame<R>, WANT>(law, block, i, count, fibre, worst);
        } else {
            staged::<T, R, FibreFrame<R>, WANT>(law, block, i, count, |_| (law.frame, None), worst);
        }
    }
}

/// Evaluates `count` registers of points from `i` on, stage by stage. `axes` are those of a register, with where they are
/// usable if that is not everywhere.
///
/// # Safety
/// As for [`evaluate`].
#[inline(always)]
unsafe fn staged<T: Precision, R: Lanes<T>, A: Axes<R>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Pointers<T>,
    i: usize,
    count: usize,
    axes: impl Fn(usize) -> (A, Option<R::Mask>),
    worst: &mut R,
) {
    let (mut stretches, mut sections, mut kept, mut images) = (Stage::new(), Stage::new(), Stage::new(), Stage::new());
    let (mut steps, mut strains, mut outcomes) = (Stage::new(), Stage::new(), Stage::new());
    let zero = R::splat(0.0);
    let mut trouble = zero;
    let at = |k: usize| i + k * R::COUNT;
    // Codes that nobody wants go where nobody looks: a test in the stage would cost more.
    let mut nowhere = [MaybeUninit::<i32>::uninit(); STAGED * WIDEST];
    let status = if block.status.is_null() { nowhere.as_mut_ptr().cast::<i32>().wrapping_sub(i) } else { block.status };
    // SAFETY: the pointers that the block has are valid for the lanes from i on; k < count ≤ STAGED, and each stage reads
    // what the ones before have put.
    unsafe {
        for k in 0..count {
            let n = axes(k).0;
            let (stretch, vectors) = Stretch::new(&gradient(block, at(k)), &n);
            stretches.put(k, stretch);
            kept.put(k, n.keep(vectors));
        }
        for k in 0..count {
            let (n, d) = (axes(k).0, stretches.get(k));
            let (section, vectors) = Section::new(d, n.recall(kept.get(k), &gradient(block, at(k)), d), &n);
            sections.put(k, section);
            images.put(k, vectors);
        }
        for k in 0..count {
            steps.put(k, Step { logarithms: Logarithms::new(stretches.get(k), sections.get(k)) });
        }
        for k in 0..count {
            strains.put(k, Strain::new(stretches.get(k), sections.get(k), &steps.get(k).logarithms));
            for column in block.stress {
                R::prefetch(column.wrapping_add(at(k)));
            }
        }
        for k in 0..count {
            steps.put(k, Step { power: law.compaction(strains.get(k)) });
            announce::<T, R, 4>(WANT & (STATE | AS_ASKED) != 0, block.energies, block.leading_dimension, at(k));
        }
        for k in 0..count {
            steps.put(k, Step { reduced: steps.get(k).power.reduce(&law.exponent) });
            announce::<T, R, 4>(WANT & (STATE | AS_ASKED) != 0, block.invariants, block.leading_dimension, at(k));
        }
        for k in 0..count {
            steps.put(k, Step { powered: steps.get(k).reduced.finish() });
            announce::<T, R, 3>(WANT & (STATE | AS_ASKED) != 0, block.failure, block.leading_dimension, at(k));
        }
        for k in 0..count {
            let doubt = match axes(k).1 {
                Some(usable) => R::select(usable, strains.get(k).doubt, R::splat(f64::NAN)),
                None => strains.get(k).doubt,
            };
            let d = stretches.get(k);
            let [fibre, ..] = axes(k).0.recall(kept.get(k), &gradient(block, at(k)), d);
            let &[a, b] = images.get(k);
            let kinematics =
                Kinematics { stretch: d, section: sections.get(k), images: [fibre, a, b], strain: strains.get(k) };
            let outcome = finish::<T, R, WANT>(law, block, at(k), kinematics, steps.get(k).powered, doubt);
            zero.store_integers(status.wrapping_add(at(k)));
            outcomes.put(k, outcome);
        }
        for k in 0..count {
            trouble = probe::<T, R, WANT>(block, at(k), outcomes.get(k).standing, trouble);
        }
        // What is strange is rare. A number less itself is 0, unless it is NaN or infinite.
        #[allow(clippy::eq_op)]
        let ordinary = (trouble - trouble).le(zero);
        if R::any(!ordinary) {
            for k in 0..count {
                let usable = axes(k).1.unwrap_or(zero.le(zero));
                let code = settle::<T, R, WANT>(law, block, at(k), stretches.get(k), usable, outcomes.get(k));
                code.store_integers(status.wrapping_add(at(k)));
                *worst = R::select(code.lt(*worst), code, *worst);
            }
        }
        if WANT & (STATE | AS_ASKED) != 0 {
            for k in 0..count {
                let (d, strain) = (stretches.get(k), strains.get(k));
                remember::<T, R, WANT>(law, block, at(k), d, strain, steps.get(k).powered, outcomes.get(k));
            }
        }
        if wants_tangent::<T, WANT>(block) {
            for k in 0..count {
                drop_tangent(block, at(k), outcomes.get(k));
            }
        }
    }
}

/// The columns of F.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
unsafe fn gradient<T, R: Lanes<T>>(block: &Pointers<T>, i: usize) -> [[R; 3]; 3] {
    let f = &block.deformation_gradient;
    // SAFETY: the caller's promise.
    unsafe {
        [
            [R::load(f[0].add(i)), R::load(f[1].add(i)), R::load(f[2].add(i))],
            [R::load(f[3].add(i)), R::load(f[4].add(i)), R::load(f[5].add(i))],
            [R::load(f[6].add(i)), R::load(f[7].add(i)), R::load(f[8].add(i))],
        ]
    }
}

/// The material frame, of the property or of the points, and where it is usable.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
unsafe fn frame<T, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Pointers<T>,
    i: usize,
) -> (FibreFrame<R>, R::Mask) {
    let m = &block.fibre;
    if WANT & AS_ASKED != 0 && m[0].is_null() {
        let zero = R::splat(0.0);
        return (law.frame, zero.le(zero));
    }
    // SAFETY: the caller's promise.
    let direction = unsafe { [R::load(m[0].add(i)), R::load(m[1].add(i)), R::load(m[2].add(i))] };
    FibreFrame::new(direction)
}

/// What a kernel is asked for.
#[inline(always)]
fn request<T, const WANT: u8>(block: &Pointers<T>) -> Request {
    let asked = WANT & AS_ASKED != 0;
    Request {
        stress: !asked || !block.stress[0].is_null(),
        energies: if asked { !block.energies.is_null() } else { WANT & STATE != 0 },
        invariants: if asked { !block.invariants.is_null() } else { WANT & STATE != 0 },
        failure: if asked { !block.failure.is_null() } else { WANT & STATE != 0 },
        modes: asked && !block.modes.is_null(),
        wave_modulus: asked && !block.wave_speed.is_null(),
    }
}

/// Where points have a new state, and how they stand: the latch of the old state, NaN where they are flawed.
struct Outcome<R: Real> {
    new: R::Mask,
    standing: R,
}

/// The stress, stored; flawed points still want theirs. The state is stored apart from it: a processor keeps at hand the places
/// of few pages to store to, and each component lies in another one.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
unsafe fn finish<T: Precision, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Pointers<T>,
    i: usize,
    kinematics: Kinematics<'_, R>,
    power: R,
    doubt: R,
) -> Outcome<R> {
    let Kinematics { stretch: d, strain, .. } = kinematics;
    let request = request::<T, WANT>(block);
    let stride = block.leading_dimension;

    // SAFETY: the pointers and components that the block has are valid for the lanes from i on.
    unsafe {
        let latch = latch::<T, R, WANT>(block, i);
        // The modes and the tangent alone want the frame again.
        let tangent = wants_tangent::<T, WANT>(block);
        let frame = if request.modes || tangent { frame::<T, R, WANT>(law, block, i).0 } else { law.frame };
        let k = law.kirchhoff(d, strain, power);
        let shear = WANT & SHEAR != 0;
        let doubt = if tangent { doubt + store_tangent(law, block, i, kinematics, &k, &frame, shear) } else { doubt };
        let r = law.respond(kinematics, &k, &frame, doubt, latch, request, shear);

        if request.stress {
            for c in 0..6 {
                r.stress[c].store(block.stress[c].add(i));
            }
        }
        if request.modes {
            for (mode, s) in r.modes.iter().enumerate() {
                for (c, &value) in s.iter().enumerate() {
                    value.store(block.modes.add((6 * mode + c) * stride + i));
                }
            }
        }
        if request.wave_modulus {
            let density = R::splat(block.density.into());
            // The ratio of two numbers may leave the range; that of their roots does not.
            wave_speed::wave_speed(r.wave_modulus, density).store(block.wave_speed.add(i));
        }
        Outcome { new: r.new, standing: r.standing }
    }
}

/// The latch of the old state.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on.
#[inline(always)]
unsafe fn latch<T, R: Lanes<T>, const WANT: u8>(block: &Pointers<T>, i: usize) -> R {
    let absent = if WANT & AS_ASKED != 0 { block.failure_old.is_null() } else { WANT & STATE == 0 };
    if absent {
        return R::splat(0.0);
    }
    // SAFETY: the caller's promise.
    unsafe { R::load(block.failure_old.add(block.leading_dimension + i)) }
}

/// Whether a kernel is asked for the tangent: only those that ask, and are not built for an aligned fibre, ever are.
#[inline(always)]
fn wants_tangent<T, const WANT: u8>(block: &Pointers<T>) -> bool {
    WANT & AS_ASKED != 0 && WANT & ALIGNED == 0 && !block.tangent.is_null()
}

/// Stores the tangent of the intact material. Returns 0 where all of it are finite numbers, else NaN.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on of a block that wants the tangent.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
unsafe fn store_tangent<T: Precision, R: Lanes<T>>(
    law: &Hyperelastic<R>,
    block: &Pointers<T>,
    i: usize,
    kinematics: Kinematics<'_, R>,
    k: &Kirchhoff<R>,
    frame: &FibreFrame<R>,
    shear: bool,
) -> R {
    let store = |entries: &[R]| {
        for (c, entry) in entries.iter().enumerate() {
            // SAFETY: the array has a component for each entry of the measure, and the lanes from i on.
            unsafe { entry.store(block.tangent.add(c * block.leading_dimension + i)) };
        }
    };
    if block.measure == Measure::Nominal {
        let zero = R::splat(0.0);
        let stress = law.cauchy(kinematics, k, zero.le(zero), shear);
        let nominal = law.nominal_tangent(kinematics, k, frame, &stress, shear);
        store(&nominal);
        unrepresentable(&nominal)
    } else {
        let moduli = law.moduli(kinematics, k, frame, false, block.measure, shear);
        store(moduli.matrix().as_flattened());
        if overflows::<R>(block.measure, shear) { unrepresentable(&moduli.0) } else { R::splat(0.0) }
    }
}

/// Takes the tangent of points away that have failed before or are flawed.
///
/// # Safety
/// As for [`store_tangent`], after it.
#[inline(always)]
unsafe fn drop_tangent<T: Precision, R: Lanes<T>>(block: &Pointers<T>, i: usize, outcome: &Outcome<R>) {
    let zero = R::splat(0.0);
    if !R::any(!outcome.new) {
        return;
    }
    for c in 0..block.measure.components() {
        // SAFETY: the array has the component, and the lanes from i on.
        unsafe {
            let place = block.tangent.add(c * block.leading_dimension + i);
            R::select(outcome.new, R::load(place), zero).store(place);
        }
    }
}

/// `trouble` and what a register adds to it: a number that is not finite where one of its points needs [`settle`], that is, where
/// a point is flawed or what it might keep is not finite.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on, after [`finish`].
#[inline(always)]
unsafe fn probe<T: Precision, R: Lanes<T>, const WANT: u8>(
    block: &Pointers<T>,
    i: usize,
    standing: R,
    trouble: R,
) -> R {
    let request = request::<T, WANT>(block);
    // SAFETY: the arrays have the component, and the lanes from i on.
    let old = |array: *mut T, c: usize| unsafe { R::load(array.add(c * block.leading_dimension + i)) };
    let mut sum = if request.failure { standing + old(block.failure, 0) } else { standing };
    for c in 0..4 {
        sum = match (request.energies, request.invariants) {
            (true, true) => old(block.energies, c).mul_add(old(block.invariants, c), sum),
            (true, false) => sum + old(block.energies, c),
            (false, true) => sum + old(block.invariants, c),
            (false, false) => sum,
        };
    }
    trouble + sum
}

/// Stores what the points remember that have a new state, and whether they have failed.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on, after [`finish`].
#[inline(always)]
unsafe fn remember<T: Precision, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Pointers<T>,
    i: usize,
    d: &Stretch<R>,
    strain: &Strain<R>,
    power: R,
    outcome: &Outcome<R>,
) {
    let request = request::<T, WANT>(block);
    let stride = block.leading_dimension;
    // SAFETY: the arrays have the components, and the lanes from i on.
    unsafe {
        let latch = latch::<T, R, WANT>(block, i);
        let k = law.kirchhoff(d, strain, power);
        let r = law.history(strain, d.shear_invariant(), &k, outcome.new, latch, request, WANT & SHEAR != 0);
        if request.energies {
            for (c, energy) in r.energies.into_iter().enumerate() {
                energy.store_where(outcome.new, block.energies.add(c * stride + i));
            }
        }
        if request.invariants {
            for (c, invariant) in r.invariants.into_iter().enumerate() {
                invariant.store_where(outcome.new, block.invariants.add(c * stride + i));
            }
        }
        if request.failure {
            r.failure_index.store_where(outcome.new, block.failure.add(i));
            r.failed.store(block.failure.add(stride + i));
            (R::splat(1.0) - r.failed).store(block.failure.add(2 * stride + i));
        }
    }
}

/// Has the processor fetch what [`remember`] will store to.
#[inline(always)]
fn announce<T, R: Lanes<T>, const COMPONENTS: usize>(wanted: bool, array: *mut T, leading_dimension: usize, i: usize) {
    if wanted {
        for c in 0..COMPONENTS {
            R::prefetch(array.wrapping_add(c * leading_dimension + i));
        }
    }
}

/// Puts 0 in place of what is not finite in an old state that would be kept. Returns where it has.
///
/// # Safety
/// `place` has the lanes.
#[inline(always)]
unsafe fn clean<T: Precision, R: Lanes<T>>(place: *mut T, new: R::Mask) -> R::Mask {
    let zero = R::splat(0.0);
    // SAFETY: the caller's promise.
    unsafe {
        let wrong = !new & !(R::load(place) * zero).le(zero);
        zero.store_where(wrong, place);
        wrong
    }
}

/// Drops what is not finite in the old state of points that keep it, and takes the stress of flawed ones away. Returns the codes that
/// say why.
///
/// # Safety
/// As for [`sweep`], for the lanes from i on, after [`finish`] and before [`remember`].
#[inline(always)]
unsafe fn settle<T: Precision, R: Lanes<T>, const WANT: u8>(
    law: &Hyperelastic<R>,
    block: &Pointers<T>,
    i: usize,
    d: &Stretch<R>,
    usable: R::Mask,
    outcome: &Outcome<R>,
) -> R {
    let (zero, stride) = (R::splat(0.0), block.leading_dimension);
    let request = request::<T, WANT>(block);
    // SAFETY: the caller's promise.
    let latch = unsafe { latch::<T, R, WANT>(block, i) };
    let mut dropped = zero.lt(zero);
    // SAFETY: the caller's promise: the arrays have the components, and the lanes from i on.
    unsafe {
        if request.energies {
            for c in 0..4 {
                dropped = dropped | clean::<T, R>(block.energies.add(c * stride + i), outcome.new);
            }
        }
        if request.invariants {
            for c in 0..4 {
                dropped = dropped | clean::<T, R>(block.invariants.add(c * stride + i), outcome.new);
            }
        }
        if request.failure {
            dropped = dropped | clean::<T, R>(block.failure.add(i), outcome.new);
        }
        if request.stress {
            for place in block.stress {
                zero.store_where(!outcome.new, place.add(i));
            }
        }
        let code = law.verdict(&gradient(block, i), d, usable, latch);
        let code = R::select(dropped & zero.le(code), R::splat(f64::from(status::STATE_NOT_FINITE)), code);
        R::select(outcome.new, zero, code)
    }
}
