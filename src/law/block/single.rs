//! One point with the processor's own instructions.
//!
//! A point alone is a long chain of operations, each of which waits for the last. Fused multiply-adds make it half as long;
//! a library for every processor cannot assume them, but it can look. The point stands in a register of the smallest size.

#[cfg(target_arch = "x86_64")]
use super::x86;
use super::{Lanes, Level, Precision};
use crate::law::hyperelastic::{Hyperelastic, Point, Request, Response};
use crate::law::kinematics::{Decomposition, FibreFrame, Strain};
use crate::law::state::{FAILED, HYPERELASTIC_STATE};
use crate::law::status;
use crate::law::tangent::{Measure, Moduli, unrepresentable};

/// What a point brings.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a, T> {
    /// Columns of F.
    pub f: &'a [[T; 3]; 3],
    /// Fibre direction of any length; `None`: that of the properties.
    pub fibre: Option<[T; 3]>,
    pub state: &'a [T; HYPERELASTIC_STATE],
    pub request: Request,
    /// A tangent of six rows, or none.
    pub measure: Option<Measure>,
}

/// A precision in which a point can be evaluated with fused multiply-adds.
pub trait Single: Precision {
    /// # Safety
    /// The processor has AVX2 and FMA.
    unsafe fn fused(law: &Hyperelastic<Self>, input: &Input<Self>) -> (Point<Self>, Moduli<Self>);
}

macro_rules! single {
    ($t:ident: $register:ident) => {
        impl Single for $t {
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2,fma")]
            unsafe fn fused(law: &Hyperelastic<$t>, input: &Input<$t>) -> (Point<$t>, Moduli<$t>) {
                evaluate::<$t, x86::$register>(law, input)
            }
            #[cfg(not(target_arch = "x86_64"))]
            unsafe fn fused(law: &Hyperelastic<$t>, input: &Input<$t>) -> (Point<$t>, Moduli<$t>) {
                evaluate::<$t, $t>(law, input)
            }
        }
    };
}
single!(f64: F64x2Fused);
single!(f32: F32x4Fused);

impl<T: Single> Hyperelastic<T> {
    /// The law at one point by the best instructions that there are: what [`point_along`](Self::point_along) and
    /// [`point_with_moduli`](Self::point_with_moduli) answer, to rounding. Without a measure the moduli are 0.
    pub fn evaluate(&self, input: &Input<T>) -> (Point<T>, Moduli<T>) {
        if Level::best() >= Level::Avx2 {
            // SAFETY: the level has both.
            unsafe { T::fused(self, input) }
        } else {
            let Input { f, fibre, state, request, measure } = *input;
            match measure {
                Some(measure) => self.point_with_moduli(f, fibre, state, request, measure),
                None => (self.point_along(f, fibre, state, request), Moduli([T::splat(0.0); 21])),
            }
        }
    }
}

/// The point in every lane of a register; the first one is taken.
#[inline(always)]
fn evaluate<T: Precision, R: Lanes<T>>(law: &Hyperelastic<T>, input: &Input<T>) -> (Point<T>, Moduli<T>) {
    let lane = |x: T| R::splat(x.into());
    let vector = |v: [T; 3]| [lane(v[0]), lane(v[1]), lane(v[2])];
    let zero = R::splat(0.0);
    let (lanes, shear) = (law.lanes::<R>(), law.shears());
    let (frame, usable) = match input.fibre {
        Some(fibre) => FibreFrame::new(vector(fibre)),
        None => (lanes.frame(), zero.le(zero)),
    };
    let d = Decomposition::new(&[vector(input.f[0]), vector(input.f[1]), vector(input.f[2])], &frame);
    let strain = Strain::new(&d);
    let k = lanes.kirchhoff(&d, &strain);
    let mut flaw = lanes.flaw(&d, usable);
    let mut moduli = [zero; 21];
    if let Some(measure) = input.measure {
        moduli = lanes.moduli(&d, &strain, &k, &frame, measure, shear).0;
        let sound = flaw.lt(zero) | unrepresentable(&moduli).le(zero);
        flaw = R::select(sound, flaw, R::splat(status::OVERFLOW as f64));
    }
    let r = lanes.respond(&d, &strain, &k, &frame, flaw, lane(input.state[FAILED]), input.request, shear);
    if input.measure.is_some() {
        for x in &mut moduli {
            *x = R::select(r.kept, zero, *x);
        }
    }
    let response = Response {
        stress: firsts(r.stress),
        energies: firsts(r.energies),
        invariants: firsts(r.invariants),
        failure_index: first(r.failure_index),
        failed: first(r.failed),
        modes: [firsts(r.modes[0]), firsts(r.modes[1]), firsts(r.modes[2]), firsts(r.modes[3])],
        wave_modulus: first(r.wave_modulus),
        status: first(r.status),
        kept: first(R::select(r.kept, R::splat(1.0), zero)) != T::splat(0.0),
    };
    (Point::new(&response, input.state), Moduli(firsts(moduli)))
}

/// The first lane.
#[inline(always)]
fn first<T: Precision, R: Lanes<T>>(x: R) -> T {
    let mut lanes = [T::splat(0.0); super::WIDEST];
    // SAFETY: there is room for the widest lanes.
    unsafe { x.store(lanes.as_mut_ptr()) };
    lanes[0]
}

#[inline(always)]
fn firsts<T: Precision, R: Lanes<T>, const N: usize>(x: [R; N]) -> [T; N] {
    let mut lanes = [T::splat(0.0); N];
    for (lane, &x) in lanes.iter_mut().zip(&x) {
        *lane = first(x);
    }
    lanes
}
