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

use super::hyperelastic::{Hyperelastic, Request};
use super::kinematics::FibreFrame;
use super::real::Real;
use super::status::{self, Error};

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
    pub status: *mut i32,
}

/// The pointers to the components of a component-major array; all null where the array is.
pub fn components<T, const N: usize>(array: *const T, leading_dimension: usize) -> [*const T; N] {
    let mut pointers = [core::ptr::null(); N];
    if !array.is_null() {
        for (c, pointer) in pointers.iter_mut().enumerate() {
            *pointer = array.wrapping_add(c.wrapping_mul(leading_dimension));
        }
    }
    pointers
}

/// Likewise, for writing.
pub fn components_mut<T, const N: usize>(array: *mut T, leading_dimension: usize) -> [*mut T; N] {
    components(array.cast_const(), leading_dimension).map(<*const T>::cast_mut)
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
    pub status: Option<&'a mut [i32]>,
}

impl<T: Real<Mask = bool> + Into<f64>> Hyperelastic<T> {
    /// The law at every point of a block; returns the worst (most negative) of their status codes.
    ///
    /// # Errors
    /// An array that is too short, a leading dimension below n, a density that is not positive where the wave speed is
    /// wanted.
    pub fn block(&self, arrays: Arrays<'_, T>) -> Result<i32, Error> {
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
        let block = Pointers {
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
            status: match arrays.status {
                Some(array) => check("entries of status", array.len(), 1).map(|()| array.as_mut_ptr())?,
                None => core::ptr::null_mut(),
            },
        };
        // SAFETY: every array is as long as the block needs; the state alone is read and written, through one pointer.
        unsafe { self.raw_block(&block) }
    }

    /// The law at every point of a block of raw arrays; returns the worst (most negative) of their status codes.
    ///
    /// # Errors
    /// A null deformation gradient, a leading dimension below n, a density that is not positive where the wave speed is
    /// wanted.
    ///
    /// # Safety
    /// Every pointer that is not null points to as many values as the block's size and the table above say, valid for
    /// reading or writing; outputs overlap nothing but, exactly, the old state they replace.
    pub unsafe fn raw_block(&self, block: &Pointers<T>) -> Result<i32, Error> {
        if block.n == 0 {
            return Ok(status::OK);
        }
        if block.deformation_gradient.iter().any(|pointer| pointer.is_null()) {
            return Err(Error::Plain(status::NULL_ARGUMENT));
        }
        if block.leading_dimension < block.n {
            return Err(Error::Count {
                code: status::BAD_LEADING_DIMENSION,
                what: "leading dimension",
                found: block.leading_dimension as i64,
                wanted: block.n as i64,
            });
        }
        let density = block.density.into();
        let has_mass = density > 0.0 && density < f64::INFINITY;
        if !block.wave_speed.is_null() && !has_mass {
            return Err(Error::Argument { name: "density", value: density, wanted: "a finite number > 0" });
        }
        let mut worst = status::OK;
        for i in 0..block.n {
            // SAFETY: i < n, and the caller answers for the arrays.
            let code = unsafe { evaluate_at(self, block, i) };
            worst = worst.min(code);
        }
        Ok(worst)
    }
}

/// Evaluates the point `i`.
///
/// # Safety
/// As for [`Hyperelastic::raw_block`], with i < n.
#[inline(always)]
unsafe fn evaluate_at<T: Real<Mask = bool> + Into<f64>>(law: &Hyperelastic<T>, block: &Pointers<T>, i: usize) -> i32 {
    let (zero, one) = (T::splat(0.0), T::splat(1.0));
    let stride = block.leading_dimension;
    // SAFETY: called with pointers that are not null.
    let read = |component: *const T| unsafe { *component.add(i) };
    // SAFETY: called with arrays that are not null and components that they have.
    let load = |array: *const T, component: usize| unsafe { *array.add(component * stride + i) };
    // SAFETY: likewise.
    let store = |array: *mut T, component: usize, value: T| unsafe { *array.add(component * stride + i) = value };

    let f = block.deformation_gradient.map(read);
    let f = [[f[0], f[1], f[2]], [f[3], f[4], f[5]], [f[6], f[7], f[8]]];
    let (frame, usable) =
        if block.fibre[0].is_null() { (law.frame, true) } else { FibreFrame::new(block.fibre.map(read)) };
    let latch = if block.failure_old.is_null() { zero } else { load(block.failure_old, 1) };
    let request = Request {
        stress: !block.stress[0].is_null(),
        energies: !block.energies.is_null(),
        invariants: !block.invariants.is_null(),
        failure: !block.failure.is_null(),
        modes: !block.modes.is_null(),
        wave_modulus: !block.wave_speed.is_null(),
    };
    let r = law.evaluate(&f, &frame, usable, latch, request);

    // The new value, or the old one where the point keeps it; what is not finite there is reported and dropped.
    let mut code = Into::<f64>::into(r.status) as i32;
    let mut kept = |old: *const T, component: usize, new: T| {
        if !r.kept {
            return new;
        }
        let old = if old.is_null() { zero } else { load(old, component) };
        if (old * zero).le(zero) {
            return old;
        }
        if code == status::OK {
            code = status::STATE_NOT_FINITE;
        }
        zero
    };
    if request.stress {
        for (&component, &value) in block.stress.iter().zip(&r.stress) {
            store(component, 0, value);
        }
    }
    if request.energies {
        for (component, &value) in r.energies.iter().enumerate() {
            store(block.energies, component, kept(block.energies_old, component, value));
        }
    }
    if request.invariants {
        for (component, &value) in r.invariants.iter().enumerate() {
            store(block.invariants, component, kept(block.invariants_old, component, value));
        }
    }
    if request.failure {
        store(block.failure, 0, kept(block.failure_old, 0, r.failure_index));
        store(block.failure, 1, r.failed);
        store(block.failure, 2, one - r.failed);
    }
    if request.modes {
        for (component, &value) in r.modes.iter().flatten().enumerate() {
            store(block.modes, component, value);
        }
    }
    if request.wave_modulus {
        store(block.wave_speed, 0, (r.wave_modulus / block.density).sqrt());
    }
    if !block.status.is_null() {
        // SAFETY: the caller answers for n entries.
        unsafe { *block.status.add(i) = code };
    }
    code
}
