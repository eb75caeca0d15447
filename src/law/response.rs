//! The results of the law at a point: what a caller requests, and what becomes of it if the point fails or cannot be
//! evaluated.

use super::axes::FibreFrame;
use super::failure::Failure;
use super::frictional::unsigned_zero;
use super::hyperelastic::{Deformed, Hyperelastic, Kirchhoff};
use super::kinematics::{Decomposition, Kinematics, Strain, Stretch};
use super::number::real::{Real, Single};
use super::state::{ALIVE, FAILED, HYPERELASTIC_STATE};
use super::status;

/// The results that a caller requests. Values that are not requested have no meaning in the result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// Cauchy stress.
    pub stress: bool,
    /// Energies by mode, per reference volume.
    pub energies: bool,
    /// Strain invariants of the four modes.
    pub invariants: bool,
    /// Failure index and latch. If they are not requested, no point fails; a point that has failed before stays failed.
    pub failure: bool,
    /// Second Piola–Kirchhoff stress by mode.
    pub modes: bool,
    /// ρ0 c² for an upper bound c of the wave speed.
    pub wave_modulus: bool,
}

impl Request {
    /// All results.
    pub const ALL: Request =
        Request { stress: true, energies: true, invariants: true, failure: true, modes: true, wave_modulus: true };
    /// None.
    pub(crate) const NOTHING: Request = Request {
        stress: false,
        energies: false,
        invariants: false,
        failure: false,
        modes: false,
        wave_modulus: false,
    };
    /// Stress and state: what a solver needs at every step.
    pub const STRESS_AND_STATE: Request = Request { modes: false, wave_modulus: false, ..Request::ALL };
}

/// The results of the law except the new state, for one point or for one in each lane of `R`.
#[derive(Clone, Copy)]
pub(crate) struct Response<R: Real> {
    /// Cauchy stress 11 22 33 12 23 31: that of the intact material in the call that detects failure, 0 in later calls;
    /// undefined where `latch_or_nan` is NaN.
    pub stress: [R; 6],
    /// S_el, S_tc, S_td, S_ld: second Piola–Kirchhoff stress by mode, each 11 22 33 12 23 31; 0 where `updated` does
    /// not hold.
    pub modes: [[R; 6]; 4],
    /// ρ0 c² for an upper bound c of the wave speed, at least k_el.
    pub wave_modulus: R,
    /// The old latch, or NaN where the point cannot be evaluated; [`status_code`](Hyperelastic::status_code) gives the
    /// reason.
    pub latch_or_nan: R,
    /// Where the point gets a new state: it has not failed before and can be evaluated.
    pub updated: R::Mask,
}

/// The new state of a point. Where [`Response::updated`] does not hold, energies, invariants and index are undefined,
/// and the caller keeps the old ones.
#[derive(Clone, Copy)]
pub(crate) struct History<R> {
    /// W_el, W_tc, W_td, W_ld; I_el, I_tc, I_td, I_ld; failure index.
    pub energies: [R; 4],
    pub invariants: [R; 4],
    pub failure_index: R,
    /// The new latch, 0 or 1.
    pub failed: R,
}

impl<R: Real> Deformed<'_, R> {
    /// The results at a point except its new state. `nan_if_invalid` is 0 where the kinematics are valid, else NaN;
    /// `latch` is that of the old state. `BY_MODE` says whether modes or wave modulus may be requested: kernels that
    /// never compute them have no code of them to be compiled.
    ///
    /// The wave modulus is finite at every point, the other results wherever the point can be evaluated.
    #[inline(always)]
    pub fn respond<const BY_MODE: bool>(
        self,
        frame: &FibreFrame<R>,
        nan_if_invalid: R,
        latch: R,
        request: Request,
    ) -> Response<R> {
        let Deformed { law, kinematics, k, shear } = self;
        let Kinematics { stretch: d, strain, .. } = kinematics;
        let zero = R::splat(0.0);
        // A latch that is NaN counts as failed.
        let mut latch_or_nan = latch + nan_if_invalid;
        let intact = Failure::intact(latch_or_nan);
        let mut stress = if request.stress { law.cauchy(kinematics, k, intact, shear) } else { [zero; 6] };
        if kinematics.slid.is_some() {
            for x in &mut stress {
                *x = unsigned_zero(*x);
            }
        }

        // A product with zero is NaN for a result that is not finite. With the bounds of the properties the invariants,
        // the index and the energies are finite wherever the kinematics are valid, except the energy of the
        // longitudinal shear. If the compaction energy overflows, so does the stress, so that it is checked only if the
        // stress is not requested.
        if !R::WIDE_RANGE || shear {
            let sum = (stress[0] + stress[1]) + (stress[2] + stress[3]) + (stress[4] + stress[5]);
            latch_or_nan = sum.mul_add(zero, latch_or_nan);
            if request.energies && !request.stress {
                latch_or_nan = k.compaction_energy.mul_add(zero, latch_or_nan);
            }
        }
        if request.energies && shear {
            latch_or_nan = law.energies(strain, d.shear_invariant(), k, shear)[3].mul_add(zero, latch_or_nan);
        }
        let mut modes = [[zero; 6]; 4];
        let mut wave = law.k_el;
        if const { BY_MODE } && (request.modes || request.wave_modulus) {
            let decomposition = Decomposition::new(kinematics);
            if request.modes {
                modes = law.modes(kinematics, &decomposition, k, frame);
                for x in modes.iter_mut().flatten() {
                    if kinematics.slid.is_some() {
                        *x = unsigned_zero(*x);
                    }
                    latch_or_nan = x.mul_add(zero, latch_or_nan);
                }
            }
            if request.wave_modulus {
                wave = law.wave_modulus(kinematics, &decomposition, k);
                latch_or_nan = wave.mul_add(zero, latch_or_nan);
            }
        }
        let updated = Failure::intact(latch_or_nan);
        if const { BY_MODE } && request.modes {
            for x in modes.iter_mut().flatten() {
                *x = R::select(updated, *x, zero);
            }
        }
        Response { stress, modes, wave_modulus: R::select(updated, wave, law.k_el), latch_or_nan, updated }
    }
}

impl<R: Real> Hyperelastic<R> {
    /// The new state with this failure index, given [`Response::updated`]. The latch is finite at every point.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)] // results of several stages, which have no more in common than this call
    pub(crate) fn history(
        &self,
        failure_index: R,
        strain: &Strain<R>,
        i_ld: R,
        k: &Kirchhoff<R>,
        updated: R::Mask,
        latch: R,
        request: Request,
        shear: bool,
    ) -> History<R> {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        History {
            energies: if request.energies { self.energies(strain, i_ld, k, shear) } else { [zero; 4] },
            invariants: [strain.i_el, strain.i_tc, strain.i_td, i_ld],
            failure_index,
            failed: R::select(!Failure::intact(latch) | (updated & Failure::reached(failure_index)), one, zero),
        }
    }

    /// The status code, as a number, of a point whose state is not updated: the reason why it cannot be evaluated, or 0
    /// if it has failed before. `usable` says whether its fibre direction is finite and not zero, `limit` whether a
    /// limit of its own is allowed, if it has one.
    #[inline(always)]
    pub(crate) fn status_code(
        &self,
        f: &[[R; 3]; 3],
        d: &Stretch<R>,
        usable: R::Mask,
        limit: Option<R::Mask>,
        latch: R,
    ) -> R {
        let zero = R::splat(0.0);
        let code = |status: i32| R::splat(f64::from(status));
        // A number times zero is zero unless it is NaN or infinite. If F is too large, its determinant is meaningless.
        let (mut finite, mut size) = (zero, zero);
        for column in f {
            for &entry in column {
                finite = entry.mul_add(zero, finite);
                size = entry.mul_add(entry, size);
            }
        }
        let inverted = (d.jacobian.le(zero) | d.square.le(zero)) & size.lt(R::splat(R::SQUARES.1));
        // Later lines take precedence. In this order: latch set, F not finite, fibre direction or limit not usable, F
        // inverted, else overflow.
        let error = R::select(inverted, code(status::INVERTED), code(status::OVERFLOW));
        let error = match limit {
            Some(allowed) => R::select(allowed, error, code(status::LIMIT)),
            None => error,
        };
        let error = R::select(usable, error, code(status::FIBRE_DIRECTION));
        let error = R::select(finite.le(zero), error, code(status::NOT_FINITE));
        let failed = R::select((latch * zero).le(zero), zero, code(status::STATE_NOT_FINITE));
        R::select(Failure::intact(latch), error, failed)
    }
}

/// 0 where all values are finite, else NaN.
#[inline(always)]
pub(crate) fn nan_unless_finite<R: Real>(values: &[R]) -> R {
    let zero = R::splat(0.0);
    // Four independent sums, to shorten the chain of dependent operations.
    let [mut a, mut b, mut c, mut d] = [zero; 4];
    let mut fours = values.chunks_exact(4);
    for four in &mut fours {
        if let &[x, y, z, w] = four {
            (a, b) = (x.mul_add(zero, a), y.mul_add(zero, b));
            (c, d) = (z.mul_add(zero, c), w.mul_add(zero, d));
        }
    }
    for &x in fours.remainder() {
        a = x.mul_add(zero, a);
    }
    (a + b) + (c + d)
}

/// The results of the law at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<T> {
    /// Cauchy stress 11 22 33 12 23 31.
    pub stress: [T; 6],
    /// The new state, in the order of [`state::HYPERELASTIC`](super::state::HYPERELASTIC).
    pub state: [T; HYPERELASTIC_STATE],
    /// Second Piola–Kirchhoff stress by mode, S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31.
    pub modes: [[T; 6]; 4],
    /// ρ0 c² for an upper bound c of the wave speed.
    pub wave_modulus: T,
    /// 0, or the [`status`] code of the reason why the point could not be evaluated.
    pub status: i32,
}

/// The old state of a point, wherever its entries are. Only the latch is read at every point, and nothing once the sink
/// has taken the new state, which may be in the same place.
pub(crate) trait OldState<T> {
    /// An entry, in the order of [`state::HYPERELASTIC`](super::state::HYPERELASTIC).
    fn entry(&self, c: usize) -> T;
}

impl<T: Real<Mask = bool>> Point<T> {
    /// All zeros.
    #[inline(always)]
    pub(crate) fn nothing() -> Self {
        let zero = T::splat(0.0);
        Point {
            stress: [zero; 6],
            state: [zero; HYPERELASTIC_STATE],
            modes: [[zero; 6]; 4],
            wave_modulus: zero,
            status: status::OK,
        }
    }

    /// A point with a new state.
    #[inline(always)]
    pub(super) fn updated<R: Single<T>>(r: &Response<R>, h: &History<R>) -> Self {
        let failed = h.failed.value();
        let ([w_el, w_tc, w_td, w_ld], [i_el, i_tc, i_td, i_ld]) = (values(&h.energies), values(&h.invariants));
        let (index, alive) = (h.failure_index.value(), T::splat(1.0) - failed);
        Point {
            stress: values(&r.stress),
            state: [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, index, failed, alive],
            modes: [values(&r.modes[0]), values(&r.modes[1]), values(&r.modes[2]), values(&r.modes[3])],
            wave_modulus: r.wave_modulus.value(),
            status: status::OK,
        }
    }

    /// A point without stress that keeps its old state. The latch is set to `failed`; entries that are not finite
    /// become 0.
    #[inline(never)]
    pub(super) fn unchanged(state: &impl OldState<T>, failed: T, wave_modulus: T, status: i32) -> Self {
        let zero = T::splat(0.0);
        let mut point = Point { wave_modulus, status, ..Point::nothing() };
        // The caller has checked the latch, and `alive` is never read.
        for (c, x) in point.state.iter_mut().enumerate().take(FAILED) {
            let old = state.entry(c);
            let finite = (old * zero).le(zero);
            *x = T::select(finite, old, zero);
            if !finite && point.status == status::OK {
                point.status = status::STATE_NOT_FINITE;
            }
        }
        point.state[FAILED] = failed;
        point.state[ALIVE] = T::splat(1.0) - failed;
        point
    }
}

/// The values of N numbers, each of which holds one point.
#[inline(always)]
pub(super) fn values<T: Real, R: Single<T>, const N: usize>(numbers: &[R; N]) -> [T; N] {
    let (mut values, mut k) = ([T::splat(0.0); N], 0);
    while k < N {
        values[k] = numbers[k].value();
        k += 1;
    }
    values
}
