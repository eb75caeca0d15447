//! The yarn law at one point: the stages one after the other, then what failure and errors make of the answer.

use core::cell::Cell;

use nalgebra::Matrix3;

use super::derivative::{Derivative, NineByNine, NoTangent, SixBySix};
use super::error::Error;
use super::failure::Failure;
use super::hyperelastic::{Hyperelastic, PropertyFrame};
use super::kinematics::{Axes, FibreFrame, FirstAxis, Kinematics, Logarithms, Section, Strain, Stretch};
use super::number::elementary::Power;
#[cfg(target_arch = "x86_64")]
use super::number::level::has_fma;
use super::number::real::{Real, Single};
use super::number::registers::Registers;
use super::response::{Request, nan_unless_finite};
use super::state::{ALIVE, FAILED, HYPERELASTIC_STATE};
use super::status;
use super::tangent::Measure;
use super::voigt::Moduli;

/// What the law answers for one point, ready to store.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<T> {
    /// Cauchy stress 11 22 33 12 23 31.
    pub stress: [T; 6],
    /// The new state, in the order of [`state::HYPERELASTIC`](super::state::HYPERELASTIC).
    pub state: [T; HYPERELASTIC_STATE],
    /// S_el, S_tc, S_td, S_ld, each 11 22 33 12 23 31.
    pub modes: [[T; 6]; 4],
    /// ρ0 c² for a bound c of the wave speed.
    pub wave_modulus: T,
    /// 0, or why the point could not be evaluated.
    pub status: i32,
}

/// Where the answer goes. Handed over while it stands in registers: a copy by way of memory would make the processor wait.
pub(crate) trait Sink<T, const N: usize> {
    fn take(self, point: Point<T>, entries: [T; N]);
}

impl<T, const N: usize> Sink<T, N> for (&mut Point<T>, &mut [T; N]) {
    #[inline(always)]
    fn take(self, point: Point<T>, entries: [T; N]) {
        (*self.0, *self.1) = (point, entries);
    }
}

impl<T: Real<Mask = bool> + Into<f64>> Hyperelastic<T> {
    /// The law at one point, with the fibre direction of the properties.
    ///
    /// `f` is the deformation gradient, `state` the old state: all 0 at the start. A point that cannot be evaluated (F
    /// inverted, not finite, …) says so in `status`, carries no stress and keeps its state.
    pub fn point(&self, f: &Matrix3<T>, state: &[T; HYPERELASTIC_STATE], request: Request) -> Point<T>
    where
        T: nalgebra::Scalar,
    {
        let columns = [[f.m11, f.m21, f.m31], [f.m12, f.m22, f.m32], [f.m13, f.m23, f.m33]];
        self.point_along(&columns, None, state, request)
    }

    /// The law at one point: columns of F; a fibre direction of any length, or that of the properties.
    pub fn point_along(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        request: Request,
    ) -> Point<T> {
        self.point_with(f, fibre, state, NoTangent(request)).0
    }

    /// The law at one point, with what `tangent` makes of it: intact in the call that detects failure, zeros afterwards
    /// and where the point cannot be evaluated, which it cannot where the tangent is not finite.
    #[inline(never)]
    pub(super) fn point_with<D: Derivative<N>, const N: usize>(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        tangent: D,
    ) -> (Point<T>, [T; N]) {
        let (mut point, mut entries) = (Point::nothing(), [T::splat(0.0); N]);
        let sink = (&mut point, &mut entries);
        let evaluated = evaluate::<T, T, _, D, _, N>(self, f, fibre, &cells(*state), tangent, sink);
        debug_assert!(evaluated.is_ok()); // the law is there
        (point, entries)
    }

    /// The law at one point with a tangent of six rows; [`Measure::Nominal`] is taken for dS/dE.
    ///
    /// The call that detects failure gives the intact tangent; a point that has failed before, or cannot be evaluated, has
    /// none: zeros. A tangent that does not fit the number format makes the point one that cannot be evaluated.
    pub fn point_with_moduli(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        request: Request,
        measure: Measure,
    ) -> (Point<T>, Moduli<T>) {
        let (point, moduli) = self.point_with(f, fibre, state, SixBySix(request, measure));
        (point, Moduli(moduli))
    }

    /// The law at one point with dP/dF, both by columns: entry `(i + 3 J) + 9 (k + 3 L)` is ∂P_iJ/∂F_kL; otherwise as
    /// [`point_with_moduli`](Self::point_with_moduli).
    pub fn point_with_nominal(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        request: Request,
    ) -> (Point<T>, [T; 81]) {
        self.point_with(f, fibre, state, NineByNine(request))
    }

    /// The law at one point with the fibre direction of the properties, and the full matrix of a measure with six rows.
    pub fn tangent(&self, f: &Matrix3<T>, measure: Measure) -> (Point<T>, [[T; 6]; 6])
    where
        T: nalgebra::Scalar,
    {
        let columns = [[f.m11, f.m21, f.m31], [f.m12, f.m22, f.m32], [f.m13, f.m23, f.m33]];
        let fresh = [T::splat(0.0); HYPERELASTIC_STATE];
        let (point, moduli) = self.point_with_moduli(&columns, None, &fresh, Request::ALL, measure);
        (point, moduli.matrix())
    }
}

/// Where the law of a point comes from: it has been prepared, or comes as properties with the call.
pub(super) trait Source<T>: Copy {
    fn frame(&self) -> PropertyFrame<T>;

    /// # Errors
    /// The first property that is wrong.
    fn law(&self, frame: &PropertyFrame<T>) -> Result<Hyperelastic<T>, Error>;

    /// ⟨−I_tc⟩^(p−1) with the exponent of `law`, and the law's failure, which is not wanted earlier.
    fn power_and_failure<R: Single<T>>(&self, law: &Hyperelastic<R>, strain: &Strain<R>) -> (R, Failure<R>);
}

impl<T: Real> Source<T> for &Hyperelastic<T> {
    #[inline(always)]
    fn frame(&self) -> PropertyFrame<T> {
        PropertyFrame { frame: self.frame, aligned: self.aligned, usable: true }
    }

    #[inline(always)]
    fn law(&self, _: &PropertyFrame<T>) -> Result<Hyperelastic<T>, Error> {
        Ok(**self)
    }

    #[inline(always)]
    fn power_and_failure<R: Single<T>>(&self, law: &Hyperelastic<R>, strain: &Strain<R>) -> (R, Failure<R>) {
        (law.compaction(strain).reduce(&law.exponent).finish(), self.failure.map(|x| R::of(x)))
    }
}

impl<T: Real + Into<f64>> Source<T> for &[T] {
    #[inline(always)]
    fn frame(&self) -> PropertyFrame<T> {
        PropertyFrame::new(self)
    }

    #[inline(always)]
    fn law(&self, frame: &PropertyFrame<T>) -> Result<Hyperelastic<T>, Error> {
        Hyperelastic::prepare(self, frame)
    }

    #[inline(always)]
    fn power_and_failure<R: Single<T>>(&self, law: &Hyperelastic<R>, strain: &Strain<R>) -> (R, Failure<R>) {
        if !R::WAITS {
            let failure = Hyperelastic::prepare_failure(self).map(|x| R::of(x));
            return (law.compaction(strain).reduce(&law.exponent).finish(), failure);
        }
        // One pass for both logarithms.
        let [eps_lim, alpha, beta] = Hyperelastic::failure_properties(self);
        let [eps_lim, alpha, beta] = [R::of(eps_lim), R::of(alpha), R::of(beta)];
        let (power, limit) = Power::reduce_beside(-strain.i_tc, &law.exponent, eps_lim);
        (power.finish(), Failure::with_limit(eps_lim, limit, alpha, beta))
    }
}

/// The law at one point, computed in R; see [`Hyperelastic::point_with`].
///
/// # Errors
/// The first property that is wrong; nothing is handed to the sink.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub(super) fn evaluate<
    T: Real<Mask = bool> + Into<f64>,
    R: Single<T>,
    L: Source<T>,
    D: Derivative<N>,
    S: Sink<T, N>,
    const N: usize,
>(
    source: L,
    f: &[[T; 3]; 3],
    fibre: Option<[T; 3]>,
    state: &[Cell<T>; HYPERELASTIC_STATE],
    tangent: D,
    sink: S,
) -> Result<(), Error> {
    let vector = |v: [T; 3]| [R::of(v[0]), R::of(v[1]), R::of(v[2])];
    let f = [vector(f[0]), vector(f[1]), vector(f[2])];
    let everywhere = R::splat(0.0).le(R::splat(0.0));
    let own = source.frame();
    if own.aligned && fibre.is_none() {
        let frame = FibreFrame::first_axis();
        return point_in(source, &own, &f, &FirstAxis, &frame, everywhere, state, tangent, sink);
    }
    let (frame, usable) = match fibre {
        Some(direction) => FibreFrame::new(vector(direction)),
        None => {
            let FibreFrame { m, t1, t2 } = own.frame;
            (FibreFrame { m: vector(m), t1: vector(t1), t2: vector(t2) }, everywhere)
        }
    };
    point_in(source, &own, &f, &frame, &frame, usable, state, tangent, sink)
}

/// A call from a host that hands over the properties with every point.
pub(crate) struct Call<'a, T, D, S, const N: usize> {
    pub properties: &'a [T],
    /// Columns of F.
    pub f: &'a [[T; 3]; 3],
    /// A fibre direction of any length, or that of the properties.
    pub fibre: Option<[T; 3]>,
    /// The old state; the sink may put the new one in its place.
    pub state: &'a [Cell<T>; HYPERELASTIC_STATE],
    pub tangent: D,
    pub sink: S,
}

impl<T: Real<Mask = bool> + Into<f64>, D: Derivative<N>, S: Sink<T, N>, const N: usize> Call<'_, T, D, S, N> {
    /// Prepares the law and evaluates it, in R.
    ///
    /// # Errors
    /// The first property that is wrong; nothing is handed to the sink.
    #[inline(always)]
    pub(super) fn evaluate<R: Single<T>>(self) -> Result<(), Error> {
        evaluate::<T, R, &[T], D, S, N>(self.properties, self.f, self.fibre, self.state, self.tangent, self.sink)
    }

    /// Likewise by the law's own function for one point, in the instructions of every processor.
    ///
    /// # Errors
    /// The first property that is wrong; nothing is handed to the sink.
    #[inline(never)]
    pub(super) fn evaluate_plainly(self) -> Result<(), Error> {
        let law = Hyperelastic::new(self.properties)?;
        let state = self.state.each_ref().map(Cell::get);
        let (point, entries) = law.point_with(self.f, self.fibre, &state, self.tangent.general());
        self.sink.take(point, entries);
        Ok(())
    }
}

/// Evaluates a call by the best instructions: within four roundings of the input's sensitivity of what
/// [`Hyperelastic::point_along`] gives, with the same status.
///
/// # Errors
/// The first property that is wrong; nothing is handed to the sink.
#[inline(always)]
pub(crate) fn evaluate_call<T: Registers, D: Derivative<N>, S: Sink<T, N>, const N: usize>(
    call: Call<'_, T, D, S, N>,
) -> Result<(), Error> {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2,fma")]
        fn with_fma<T: Registers, D: Derivative<N>, S: Sink<T, N>, const N: usize>(
            call: Call<'_, T, D, S, N>,
        ) -> Result<(), Error> {
            call.evaluate::<T::Point>()
        }
        if has_fma() {
            // SAFETY: the processor has the instructions.
            return unsafe { with_fma(call) };
        }
    }
    call.evaluate_plainly()
}

/// A state as the law reads it: its place may be that of the new one.
#[inline(always)]
pub(crate) fn cells<T>([a, b, c, d, e, f, g, h, i, j, k]: [T; HYPERELASTIC_STATE]) -> [Cell<T>; HYPERELASTIC_STATE] {
    [
        Cell::new(a),
        Cell::new(b),
        Cell::new(c),
        Cell::new(d),
        Cell::new(e),
        Cell::new(f),
        Cell::new(g),
        Cell::new(h),
        Cell::new(i),
        Cell::new(j),
        Cell::new(k),
    ]
}

/// So many numbers of one point.
#[inline(always)]
fn values<T: Real, R: Single<T>, const N: usize>(numbers: &[R; N]) -> [T; N] {
    let (mut values, mut k) = ([T::splat(0.0); N], 0);
    while k < N {
        values[k] = numbers[k].value();
        k += 1;
    }
    values
}

/// The law at one point, in these axes; `frame` the same ones as vectors.
///
/// The law is prepared when the kinematics are on their way: they are a long chain of operations, each of which waits for the one
/// before, and the processor fills the gaps with what stands near in the program.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn point_in<
    T: Real<Mask = bool> + Into<f64>,
    R: Single<T>,
    L: Source<T>,
    A: Axes<R>,
    D: Derivative<N>,
    S: Sink<T, N>,
    const N: usize,
>(
    source: L,
    own: &PropertyFrame<T>,
    f: &[[R; 3]; 3],
    axes: &A,
    frame: &FibreFrame<R>,
    usable: R::Mask,
    state: &[Cell<T>; HYPERELASTIC_STATE],
    tangent: D,
    sink: S,
) -> Result<(), Error> {
    let (stretch, images) = Stretch::new(f, axes);
    let law = source.law(own)?;
    let (shear, mut law) = (law.shears, law.lanes::<R>());
    let (section, [a, b]) = Section::new(&stretch, images, axes);
    let images = [images[0], a, b];
    let logarithms = Logarithms::new(&stretch, &section);
    let early = tangent.early(&stretch, &section, &images);
    let strain = Strain::new(&stretch, &section, &logarithms);
    let kinematics = Kinematics { stretch: &stretch, section: &section, images, strain: &strain };
    let (power, failure) = source.power_and_failure(&law, &strain);
    law.failure = failure;
    let k = law.kirchhoff(&stretch, &strain, power);
    let (request, may_overflow) = (tangent.request(), tangent.may_overflow::<R>(shear));
    let entries = tangent.of(&law, kinematics, &k, frame, A::ALONG_COORDINATES, &early, shear);
    let latch = R::of(state[FAILED].get());
    let nan_if_invalid = R::select(usable, strain.nan_if_invalid, R::splat(f64::NAN));
    let r = law.respond(kinematics, &k, frame, nan_if_invalid, latch, request, shear);
    let h = law.history(&strain, stretch.shear_invariant(), &k, r.updated, latch, request, shear);
    // The stress need not wait for the tangent's finiteness.
    let zero = R::splat(0.0);
    let representable = if may_overflow { nan_unless_finite(&entries).le(zero) } else { zero.le(zero) };
    if !R::holds(r.updated & representable) {
        let failed = R::select(Failure::intact(latch), zero, R::splat(1.0)).value();
        let code: f64 = law.status_code(f, &stretch, usable, latch).value().into();
        let wave_modulus = R::select(representable, r.wave_modulus, law.k_el).value();
        sink.take(Point::unchanged(state, failed, wave_modulus, code as i32), [T::splat(0.0); N]);
        return Ok(());
    }
    let failed = h.failed.value();
    let ([w_el, w_tc, w_td, w_ld], [i_el, i_tc, i_td, i_ld]) = (values(&h.energies), values(&h.invariants));
    let (index, alive) = (h.failure_index.value(), T::splat(1.0) - failed);
    let point = Point {
        stress: values(&r.stress),
        state: [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, index, failed, alive],
        modes: [values(&r.modes[0]), values(&r.modes[1]), values(&r.modes[2]), values(&r.modes[3])],
        wave_modulus: r.wave_modulus.value(),
        status: status::OK,
    };
    sink.take(point, values(&entries));
    Ok(())
}

impl<T: Real<Mask = bool>> Point<T> {
    /// All zero.
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

    /// A point without stress that keeps its old state but for the latch.
    #[inline(never)]
    fn unchanged(state: &[Cell<T>; HYPERELASTIC_STATE], failed: T, wave_modulus: T, status: i32) -> Self {
        let zero = T::splat(0.0);
        let mut point = Point { wave_modulus, status, ..Point::nothing() };
        // The latch has been checked, and alive is never read.
        for (x, old) in point.state.iter_mut().zip(state).take(FAILED) {
            let old = old.get();
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
