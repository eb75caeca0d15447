//! The VUMAT of Abaqus/Explicit, of any law.

use core::mem::MaybeUninit;
use core::ops::Range;

use libc::{c_char, size_t};

use super::{VUMAT_COUNTS, check_counts, property_count};
use crate::host::ByStep;
use crate::host::arguments::level;
use crate::host::card_variables::{CardVariables, properties_of};
use crate::host::entry_points::{Message, check_plane, check_pointers, entry, properties, stiffness_at_rest};
use crate::host::structures::{read, structures};
use crate::law::block::{Circumstances, Precision, components, components_mut};
use crate::law::description::Reads;
use crate::law::error::Error;
use crate::law::hyperelastic::Hyperelastic;
use crate::law::interface::{Law, Points};
use crate::law::linear_elastic::LinearElastic;
use crate::law::number::level::Level;
use crate::law::status;

/// The arguments of a VUMAT that the laws use, stored as in Abaqus: arrays are (nblock, components), column-major.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Vumat<T> {
    /// The size of this structure.
    pub size: size_t,
    /// Numbers of points, of direct components (3), of shear components (3; 1 for plane strain and axisymmetric solids,
    /// which the caller has to tell from plane stress: Abaqus passes the same numbers), of state variables (the law's,
    /// or more) and of properties (the law's, or one more).
    pub nblock: i32,
    pub ndir: i32,
    pub nshr: i32,
    pub nstatev: i32,
    pub nprops: i32,
    /// In: the instruction set to use, one of `TORON_LEVEL_...`; 0: the best.
    pub level: i32,
    /// If both are 0, this is Abaqus's data check, and an elastic stress for `strain_inc` is returned.
    pub step_time: f64,
    pub total_time: f64,
    /// In: properties, nprops; behind them may stand the number of the state variable with each point's failure limit.
    pub props: *const T,
    /// In, 1: current density at the middle of the step.
    pub density: *const T,
    /// In, 6 (or 4, as all tensors of plane elements): increment of strain, tensor components; read in the data check
    /// only.
    pub strain_inc: *const T,
    /// In, 6 components each: the right stretch U at the start and at the end of the increment, 11 22 33 12 23 31.
    pub stretch_old: *const T,
    pub stretch_new: *const T,
    /// In, with 6, nstatev, 1 and 1 components.
    pub stress_old: *const T,
    pub state_old: *const T,
    pub ener_intern_old: *const T,
    pub ener_inelas_old: *const T,
    /// Out, with 6, nstatev, 1 and 1 components.
    pub stress_new: *mut T,
    pub state_new: *mut T,
    pub ener_intern_new: *mut T,
    pub ener_inelas_new: *mut T,
}

structures! { Vumat, "toron_vumat_f64", "toron_vumat_f32", "block"; }

#[cfg(target_pointer_width = "64")]
const _: () = assert!(size_of::<Vumat<f64>>() == 6 * 8 + 13 * 8 && size_of::<Vumat<f32>>() == size_of::<Vumat<f64>>());

/// Component `c` of point `i` in an array of a VUMAT.
macro_rules! at {
    ($array:expr, $block:expr, $c:expr, $i:expr) => {
        *$array.add($c * $block.nblock as usize + $i)
    };
}

/// # Safety
/// As for [`ExplicitLaw::vumat`].
unsafe fn vumat<L: Law<T>, T: Precision>(
    block: *const Vumat<T>,
    circumstances: Circumstances<T>,
) -> Result<i32, Error> {
    let mut buffer = MaybeUninit::uninit();
    // SAFETY: `read` refuses null; the structure has as many bytes as its size says.
    let block = unsafe { read(block, &mut buffer) }?;
    check_pointers(&[
        (block.props, "props"),
        (block.density, "density"),
        (block.strain_inc, "strain_inc"),
        (block.stretch_old, "stretch_old"),
        (block.stretch_new, "stretch_new"),
        (block.stress_old, "stress_old"),
        (block.state_old, "state_old"),
        (block.ener_intern_old, "ener_intern_old"),
        (block.ener_inelas_old, "ener_inelas_old"),
        (block.stress_new, "stress_new"),
        (block.state_new, "state_new"),
        (block.ener_intern_new, "ener_intern_new"),
        (block.ener_inelas_new, "ener_inelas_new"),
    ])?;
    check_counts(block.ndir, block.nshr, VUMAT_COUNTS, block.nstatev, L::DESCRIPTION.state.len())?;
    let Ok(n) = usize::try_from(block.nblock) else {
        let (code, value) = (status::BAD_COUNT, i64::from(block.nblock));
        return Err(Error::Range { code, name: "nblock", value, least: 0, greatest: i64::MAX });
    };
    let level = level(block.level)?;
    let table = L::DESCRIPTION.properties;
    let (count, kept) = (property_count(block.nprops, table)?, L::DESCRIPTION.state.len());
    // SAFETY: `props` is not null, as just checked, and has `nprops` values.
    let (values, variables) = unsafe {
        let values = properties(block.props, properties_of::<T, L>(count), table)?;
        (values, CardVariables::from_card::<T, L>(block.props, count, kept, block.nstatev as usize)?)
    };
    let law = L::new(values)?;
    if block.nshr == 1 {
        check_plane(&law, values)?;
    }
    let checks = block.step_time == 0.0 && block.total_time == 0.0;
    let mut moduli = [T::splat(0.0); 2];
    if checks {
        moduli = stiffness_at_rest(&law)?;
        // SAFETY: arrays of `nblock` points, which are not null, with the components that `Vumat` says.
        unsafe { variables.check::<T, L>(block.state_old, n) }?;
    }
    // SAFETY: arrays of `nblock` points, which are not null, with the components that `Vumat` says; here and in the
    // functions below.
    unsafe {
        for i in 0..n {
            // State variables beyond those of the law are copied as they are, and the inelastic energy is kept, or 0
            // where it is not finite.
            for c in L::DESCRIPTION.state.len()..block.nstatev as usize {
                at!(block.state_new, block, c, i) = at!(block.state_old, block, c, i);
            }
            *block.ener_inelas_new.add(i) = finite(*block.ener_inelas_old.add(i));
        }
        if checks {
            return Ok(elastic_check::<L, T>(moduli, block, n));
        }
        stretched(&law, block, circumstances, variables, n, level)
    }
}

/// An energy of the solver's that stays as it is; 0 in place of one that is not finite.
fn finite<T: Precision>(energy: T) -> T {
    let zero = T::splat(0.0);
    if (energy * zero).le(zero) { energy } else { zero }
}

/// The data check: before there is any deformation, Abaqus determines the elastic wave speed from the stress due to
/// fictitious strains. It gets that of an isotropic solid with the law's [`bulk_and_shear`](Law::bulk_and_shear), whose
/// longitudinal wave is the law's fastest at rest: the yarn law itself has no transverse stiffness there. A point whose
/// numbers are not finite is deleted, as in a step. Returns the worst status.
///
/// # Safety
/// As for [`vumat`], with `n` points.
unsafe fn elastic_check<L: Law<T>, T: Precision>([bulk, shear]: [T; 2], block: &Vumat<T>, n: usize) -> i32 {
    let (zero, mut worst) = (T::splat(0.0), status::OK);
    let is_finite = |x: T| (x * zero).le(zero);
    let components = 3 + block.nshr as usize;
    let two_g = T::splat(2.0) * shear;
    let lame = bulk - two_g * T::splat(1.0 / 3.0);
    // SAFETY: i < nblock, and c below the array's number of components.
    unsafe {
        for i in 0..n {
            let strain = |c: usize| at!(block.strain_inc, block, c, i);
            let volumetric = lame * (strain(0) + strain(1) + strain(2));
            let mut code = status::OK;
            for c in 0..components {
                let isotropic = if c < 3 { volumetric } else { zero };
                let stress = at!(block.stress_old, block, c, i) + two_g.mul_add(strain(c), isotropic);
                code = if is_finite(stress) { code } else { status::OVERFLOW };
                at!(block.stress_new, block, c, i) = stress;
            }
            for c in 0..L::DESCRIPTION.state.len() {
                let old = at!(block.state_old, block, c, i);
                code = if is_finite(old) { code } else { status::STATE_NOT_FINITE };
                at!(block.state_new, block, c, i) = if is_finite(old) { old } else { zero };
            }
            at!(block.state_new, block, L::DESCRIPTION.alive, i) =
                T::splat(1.0) - at!(block.state_new, block, L::DESCRIPTION.failed, i);
            let energy = *block.ener_intern_old.add(i);
            code = if is_finite(energy) { code } else { status::STATE_NOT_FINITE };
            *block.ener_intern_new.add(i) = finite(energy);
            if code != status::OK {
                code = if (0..components).all(|c| is_finite(strain(c))) { code } else { status::NOT_FINITE };
                for c in 0..components {
                    at!(block.stress_new, block, c, i) = zero;
                }
                at!(block.state_new, block, L::DESCRIPTION.failed, i) = T::splat(1.0);
                at!(block.state_new, block, L::DESCRIPTION.alive, i) = zero;
            }
            worst = worst.min(code);
        }
    }
    worst
}

/// The points of a block that are evaluated at once.
const CHUNK: usize = 64;

/// Evaluates the law at F = U, whose stress is RᵀσR.
///
/// # Safety
/// As for [`vumat`], with `n` points.
unsafe fn stretched<L: Law<T>, T: Precision>(
    law: &L,
    block: &Vumat<T>,
    circumstances: Circumstances<T>,
    variables: CardVariables,
    n: usize,
    level: Option<Level>,
) -> Result<i32, Error> {
    let mut worst = status::OK;
    let mut start = 0;
    // The components 23 and 31, which plane elements do not have.
    let (zeros, mut unused) = ([T::splat(0.0); CHUNK], [[T::splat(0.0); CHUNK]; 2]);
    while start < n {
        let mut codes = [status::OK; CHUNK];
        let plane = block.nshr == 1;
        let columns = |stretch: *const T| {
            let [u11, u22, u33, u12, u23, u31] = components(stretch.wrapping_add(start), n);
            let [u23, u31] = if plane { [zeros.as_ptr(); 2] } else { [u23, u31] };
            [u11, u12, u31, u12, u22, u23, u31, u23, u33]
        };
        let mut stress = components_mut(block.stress_new.wrapping_add(start), n);
        if plane {
            let [a, b] = unused.each_mut().map(|row| row.as_mut_ptr());
            [stress[4], stress[5]] = [a, b];
        }
        let points = Points {
            f_old: columns(block.stretch_old),
            f_new: columns(block.stretch_new),
            circumstances: circumstances.from(start),
            state_old: L::parts(block.state_old.wrapping_add(start), n),
            state_new: L::parts_mut(block.state_new.wrapping_add(start), n),
            stress,
            status: codes.as_mut_ptr(),
            level,
            ..variables.points(block.state_old.wrapping_add(start), CHUNK.min(n - start), n)
        };
        // SAFETY: the rows have the points from `start` on, of which no more than CHUNK are evaluated; the new state
        // may replace the old one exactly.
        worst = worst.min(unsafe { law.step(&points) }?);
        // SAFETY: the points have codes, and `step` has written their new state.
        unsafe { finish::<L, T>(block, start..n.min(start + CHUNK), &codes) };
        start += CHUNK;
    }
    law.told(worst)
}

/// Deletes the points that could not be evaluated, and writes their energies. It is not inlined, so that the loop has the
/// registers to itself.
///
/// # Safety
/// As for [`finish_point`], for the points of the range, each with a code.
#[inline(never)]
unsafe fn finish<L: Law<T>, T: Precision>(block: &Vumat<T>, points: Range<usize>, codes: &[i32; CHUNK]) {
    for (i, &code) in points.zip(codes) {
        // SAFETY: as the caller promises.
        unsafe { finish_point::<L, T>(block, i, code) };
    }
}

/// Deletes a point that could not be evaluated, and writes its energy per mass, W/ρ0. The density that Abaqus passes is
/// the current one at the middle of the step.
///
/// # Safety
/// As for [`vumat`], for a point i < nblock whose new state is written.
#[inline(always)]
unsafe fn finish_point<L: Law<T>, T: Precision>(block: &Vumat<T>, i: usize, code: i32) {
    let (zero, half, one) = (T::splat(0.0), T::splat(0.5), T::splat(1.0));
    // SAFETY: i < nblock, and c below the array's number of components.
    unsafe {
        if code != status::OK {
            at!(block.state_new, block, L::DESCRIPTION.failed, i) = one;
            at!(block.state_new, block, L::DESCRIPTION.alive, i) = zero;
        }
        let middle = |c: usize| half * (at!(block.stretch_old, block, c, i) + at!(block.stretch_new, block, c, i));
        let u = |c: usize| if c < 3 + block.nshr as usize { middle(c) } else { zero };
        let volume = u(0) * (u(1) * u(2) - u(4) * u(4)) - u(3) * (u(3) * u(2) - u(4) * u(5))
            + u(5) * (u(3) * u(4) - u(1) * u(5));
        let mut energies = L::DESCRIPTION.energies;
        // A law need not have any.
        let mut energy = match energies.next() {
            Some(first) => at!(block.state_new, block, first, i),
            None => zero,
        };
        for c in energies {
            energy += at!(block.state_new, block, c, i);
        }
        let mass = *block.density.add(i) * volume;
        // If the deformation or the density is invalid, an energy keeps its old value.
        let per_mass = |energy: T, old: T| {
            let specific = energy / mass;
            let known = zero.lt(volume) && (specific * zero).le(zero);
            if known { specific } else { finite(old) }
        };
        *block.ener_intern_new.add(i) = per_mass(energy, *block.ener_intern_old.add(i));
        if let Some(lost) = L::DESCRIPTION.lost {
            *block.ener_inelas_new.add(i) =
                per_mass(at!(block.state_new, block, lost, i), *block.ener_inelas_old.add(i));
        }
    }
}

/// A law as a VUMAT of Abaqus/Explicit, for jobs in the precision of `T`.
pub trait ExplicitLaw<T: Precision>: Law<T> {
    /// The VUMAT. Returns the worst status code, with a message of at most `capacity` bytes unless `message` is null.
    ///
    /// # Safety
    /// `block` is null or points to as many bytes as its size says, its arrays that are not null have the sizes that
    /// its fields say, and `message` is null or has `capacity` bytes.
    #[inline(never)]
    unsafe fn vumat(block: *const Vumat<T>, message: *mut c_char, capacity: size_t) -> i32 {
        // SAFETY: null or a structure of its size, with arrays as long as its fields say; the message is the caller's.
        unsafe { entry(Message { text: message, capacity }, move || vumat::<Self, T>(block, Circumstances::UNKNOWN)) }
    }

    /// The VUMAT of a solver that tells when the increment is, and how warm: dt, totalTime, and `tempNew`, nblock.
    ///
    /// # Safety
    /// As for [`vumat`](Self::vumat).
    #[inline(never)]
    unsafe fn vumat_at(
        block: *const Vumat<T>,
        circumstances: Circumstances<T>,
        message: *mut c_char,
        capacity: size_t,
    ) -> i32 {
        if Self::DESCRIPTION.reads == Reads::NOTHING {
            // SAFETY: as in `vumat`.
            return unsafe { Self::vumat(block, message, capacity) };
        }
        // SAFETY: as in `vumat`.
        unsafe { entry(Message { text: message, capacity }, move || vumat::<Self, T>(block, circumstances)) }
    }
}

impl<L: ByStep + Law<T>, T: Precision> ExplicitLaw<T> for L {}

/// The VUMAT of a law, compiled here in one precision, once for whatever package uses it.
macro_rules! compiled {
    ($law:ident, $t:ty) => {
        impl ExplicitLaw<$t> for $law<$t> {
            #[inline(never)]
            unsafe fn vumat(block: *const Vumat<$t>, message: *mut c_char, capacity: size_t) -> i32 {
                // SAFETY: as in the trait.
                unsafe {
                    entry(Message { text: message, capacity }, move || vumat::<Self, $t>(block, Circumstances::UNKNOWN))
                }
            }
        }
    };
}

compiled!(Hyperelastic, f64);
compiled!(Hyperelastic, f32);
compiled!(LinearElastic, f64);
compiled!(LinearElastic, f32);
