//! The yarn law at one point: kinematics, stress, state and tangent, and what becomes of them after failure and errors.

use core::cell::Cell;

use nalgebra::Matrix3;

use super::axes::{Axes, FibreFrame, FirstAxis};
use super::derivative::{Derivative, NineByNine, NoTangent, SixBySix};
use super::error::{Error, Value};
use super::failure::Failure;
use super::hyperelastic::{Deformed, Hyperelastic};
use super::kinematics::{Kinematics, Logarithms, Section, Strain, Stretch};
use super::number::elementary::Power;
use super::number::level::Level;
#[cfg(target_arch = "x86_64")]
use super::number::level::has_fma;
use super::number::real::{Real, Single};
use super::number::registers::Registers;
use super::own::Own;
use super::preparation::PropertyFrame;
use super::response::{OldState, Point, Request, nan_unless_finite, values};
use super::state::{FAILED, HYPERELASTIC_STATE};
use super::tangent::{Bases, Measure, may_overflow};
use super::voigt::Moduli;

/// Takes the results of a point while they are still in registers: writing them to memory and copying them from there
/// would make the processor wait.
pub(crate) trait Sink<T, const N: usize> {
    /// `inverse_jacobian` is 1/det F if the point has been evaluated with it at hand, `None` at any that keeps its old
    /// state.
    fn take(self, point: Point<T>, inverse_jacobian: Option<T>, entries: [T; N]);
}

impl<T, const N: usize> Sink<T, N> for (&mut Point<T>, &mut [T; N]) {
    #[inline(always)]
    fn take(self, point: Point<T>, _: Option<T>, entries: [T; N]) {
        (*self.0, *self.1) = (point, entries);
    }
}

impl<T: Real<Mask = bool> + Into<f64>> Hyperelastic<T> {
    /// The law at one point, with the fibre direction of the properties.
    ///
    /// `f` is the deformation gradient, `state` the old state: all 0 at the start. A point that cannot be evaluated (F
    /// inverted, not finite, …) has a nonzero `status`, no stress, and its old state.
    pub fn point(&self, f: &Matrix3<T>, state: &[T; HYPERELASTIC_STATE], request: Request) -> Point<T>
    where
        T: nalgebra::Scalar,
    {
        let columns = [[f.m11, f.m21, f.m31], [f.m12, f.m22, f.m32], [f.m13, f.m23, f.m33]];
        self.point_along(&columns, None, state, request)
    }

    /// The law at one point. `f` holds the columns of F; `fibre` is a fibre direction of any length, or `None` for that
    /// of the properties.
    pub fn point_along(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        request: Request,
    ) -> Point<T> {
        self.point_with(f, fibre, state, NoTangent(request)).0
    }

    /// The law at one point and the derivative `tangent`: that of the intact material in the call that detects failure,
    /// 0 in later calls and if the point cannot be evaluated. A point whose derivative is not finite cannot be
    /// evaluated.
    pub(super) fn point_with<D: Derivative<N>, const N: usize>(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        tangent: D,
    ) -> (Point<T>, [T; N]) {
        self.point_with_own(f, Own::along(fibre), state, tangent)
    }

    /// As [`point_with`](Self::point_with), for a point with numbers of its own.
    #[inline(never)]
    pub(super) fn point_with_own<D: Derivative<N>, const N: usize>(
        &self,
        f: &[[T; 3]; 3],
        own: Own<'_, T>,
        state: &[T; HYPERELASTIC_STATE],
        tangent: D,
    ) -> (Point<T>, [T; N]) {
        let (mut point, mut entries) = (Point::nothing(), [T::splat(0.0); N]);
        let sink = (&mut point, &mut entries);
        let evaluated = choose_axes::<T, T, _, _, _, D, _, N>(self, f, own, &cells(*state), tangent, sink);
        debug_assert!(evaluated.is_ok()); // only wrong properties are an error, and those of a law are right
        (point, entries)
    }

    /// The law at one point and its 6×6 tangent; [`Measure::Nominal`], which is 9×9, gives dS/dE.
    ///
    /// The call that detects failure gives the tangent of the intact material. The tangent of a point that has failed
    /// before or cannot be evaluated is 0. If the tangent does not fit the number format, the point cannot be
    /// evaluated.
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

    /// The law at one point and dP/dF, both by columns: entry `(i + 3 J) + 9 (k + 3 L)` is ∂P_iJ/∂F_kL; otherwise as
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

    /// The law with another failure limit, `limit` = ln(1 + ε_lim), as a point has it that is given one of its own; 0
    /// gives the law itself.
    ///
    /// # Errors
    /// A limit that is negative, NaN or infinite.
    pub fn with_limit(&self, limit: T) -> Result<Self, Error> {
        if Failure::is_limit(limit) {
            return Ok(Hyperelastic { failure: self.failure.at(limit), ..*self });
        }
        Err(Error::Argument { name: "limit", value: Value::of(limit), wanted: "a finite number, not negative" })
    }

    /// All results at one point without history, and its full 6×6 tangent; the fibre direction is that of the
    /// properties.
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

/// The source of the law for a point: a law that has been prepared, or the properties, which are passed with the call.
pub trait Source<T>: Copy {
    /// The frame of the properties' fibre direction.
    fn frame(&self) -> PropertyFrame<T>;

    /// The law; its failure criterion comes from [`power_and_failure`](Self::power_and_failure).
    ///
    /// # Errors
    /// The first property that is wrong.
    fn law(&self, frame: &PropertyFrame<T>) -> Result<Hyperelastic<T>, Error>;

    /// The law as a whole.
    ///
    /// # Errors
    /// The first property that is wrong.
    fn whole(&self) -> Result<Hyperelastic<T>, Error>;

    /// ⟨−I_tc⟩^(p−1) with the exponent of `law`, and the failure criterion, which is not needed earlier.
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

    fn whole(&self) -> Result<Hyperelastic<T>, Error> {
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

    fn whole(&self) -> Result<Hyperelastic<T>, Error> {
        Hyperelastic::new(self)
    }

    #[inline(always)]
    fn power_and_failure<R: Single<T>>(&self, law: &Hyperelastic<R>, strain: &Strain<R>) -> (R, Failure<R>) {
        if !R::PAIRS {
            let failure = Hyperelastic::prepare_failure(self).map(|x| R::of(x));
            return (law.compaction(strain).reduce(&law.exponent).finish(), failure);
        }
        // Both logarithms are computed side by side in one register.
        let [eps_lim, alpha, beta] = Hyperelastic::failure_properties(self);
        let [eps_lim, alpha, beta] = [R::of(eps_lim), R::of(alpha), R::of(beta)];
        let (power, limit) = Power::reduce_beside(-strain.i_tc, &law.exponent, eps_lim);
        (power.finish(), Failure::with_limit(eps_lim, limit, alpha, beta))
    }
}

/// The deformation gradient of a point, wherever its entries are.
pub(crate) trait Columns<T> {
    fn columns(&self) -> [[T; 3]; 3];
}

impl<T: Copy> Columns<T> for &[[T; 3]; 3] {
    #[inline(always)]
    fn columns(&self) -> [[T; 3]; 3] {
        **self
    }
}

impl<T: Copy> OldState<T> for &[Cell<T>; HYPERELASTIC_STATE] {
    #[inline(always)]
    fn entry(&self, c: usize) -> T {
        self[c].get()
    }
}

/// Makes the material axes, the point's own fibre's or the properties', and runs [`point_in_axes`] with them in the
/// number type `R`; see [`Hyperelastic::point_with`].
///
/// # Errors
/// The first property that is wrong; the sink is not called.
#[inline(always)]
fn choose_axes<
    T: Real<Mask = bool> + Into<f64>,
    R: Single<T>,
    L: Source<T>,
    F: Columns<T>,
    O: OldState<T>,
    D: Derivative<N>,
    S: Sink<T, N>,
    const N: usize,
>(
    source: L,
    f: F,
    own: Own<'_, T>,
    state: O,
    tangent: D,
    sink: S,
) -> Result<(), Error> {
    let vector = |v: [T; 3]| [R::of(v[0]), R::of(v[1]), R::of(v[2])];
    let [c1, c2, c3] = f.columns();
    let f = [vector(c1), vector(c2), vector(c3)];
    let everywhere = R::splat(0.0).le(R::splat(0.0));
    let given = source.frame();
    if given.aligned && own.fibre.is_none() {
        let axes = MaterialAxes { axes: FirstAxis, frame: FibreFrame::first_axis(), usable: everywhere };
        return point_in_axes(source, &given, Inputs { f: &f, own, state: &state }, &axes, tangent, sink);
    }
    let (frame, usable) = match own.fibre {
        Some(direction) => FibreFrame::new(vector(direction)),
        None => {
            let FibreFrame { m, t1, t2 } = given.frame;
            (FibreFrame { m: vector(m), t1: vector(t1), t2: vector(t2) }, everywhere)
        }
    };
    let axes = MaterialAxes { axes: frame, frame, usable };
    point_in_axes(source, &given, Inputs { f: &f, own, state: &state }, &axes, tangent, sink)
}

/// A call from a host: the properties or a law prepared from them, a point, and what becomes of the results.
pub(crate) struct Call<'a, T, L, F, O, D, S, const N: usize> {
    pub source: L,
    pub f: F,
    pub own: Own<'a, T>,
    /// If it is an array, in cells, since the sink may overwrite it with the new one.
    pub state: O,
    pub tangent: D,
    pub sink: S,
}

impl<
    T: Real<Mask = bool> + Into<f64>,
    L: Source<T>,
    F: Columns<T>,
    O: OldState<T>,
    D: Derivative<N>,
    S: Sink<T, N>,
    const N: usize,
> Call<'_, T, L, F, O, D, S, N>
{
    /// Prepares the law and evaluates it with the instructions that every processor of the architecture has.
    ///
    /// # Errors
    /// The first property that is wrong; the sink is not called.
    #[inline(never)]
    pub(super) fn evaluate_baseline(self) -> Result<(), Error> {
        let law = self.source.whole()?;
        let state = core::array::from_fn(|c| self.state.entry(c));
        let (point, entries) = law.point_with_own(&self.f.columns(), self.own, &state, self.tangent.general());
        self.sink.take(point, None, entries);
        Ok(())
    }
}

/// Evaluates a call with the best instructions that the processor has and `level` allows. The status is that of
/// [`Hyperelastic::point_along`]; the other results differ from its results by no more than four roundings of the input
/// would change them.
///
/// # Errors
/// The first property that is wrong; the sink is not called.
#[inline(always)]
#[cfg_attr(not(target_arch = "x86_64"), allow(unused_variables))] // there is only one level
pub(crate) fn evaluate_call<
    T: Registers,
    L: Source<T>,
    F: Columns<T>,
    O: OldState<T>,
    D: Derivative<N>,
    S: Sink<T, N>,
    const N: usize,
>(
    call: Call<'_, T, L, F, O, D, S, N>,
    level: Level,
) -> Result<(), Error> {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2,fma")]
        fn with_fma<
            T: Registers,
            L: Source<T>,
            F: Columns<T>,
            O: OldState<T>,
            D: Derivative<N>,
            S: Sink<T, N>,
            const N: usize,
        >(
            call: Call<'_, T, L, F, O, D, S, N>,
        ) -> Result<(), Error> {
            let Call { source, f, own, state, tangent, sink } = call;
            choose_axes::<T, T::Point, L, F, O, D, S, N>(source, f, own, state, tangent, sink)
        }
        if level > Level::Baseline && has_fma() {
            // SAFETY: the processor has AVX2 and FMA, as `has_fma` has found.
            return unsafe { with_fma(call) };
        }
    }
    call.evaluate_baseline()
}

/// A state in cells, as [`Call`] takes it.
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

/// The material axes of a point.
struct MaterialAxes<A, R: Real> {
    /// As the kinematics use them, and as vectors.
    axes: A,
    frame: FibreFrame<R>,
    /// Whether they exist: the fibre direction is finite and not zero.
    usable: R::Mask,
}

/// What a point has besides its axes: F, by columns, numbers of its own, and the old state.
struct Inputs<'a, T, R, O> {
    f: &'a [[R; 3]; 3],
    own: Own<'a, T>,
    state: &'a O,
}

/// The stages of the law at one point, in these axes.
///
/// The law is prepared after the kinematics have begun: these are a long chain of dependent operations, and while the
/// processor waits for them, it executes independent operations that are near in the program.
#[inline(always)]
fn point_in_axes<
    T: Real<Mask = bool> + Into<f64>,
    R: Single<T>,
    L: Source<T>,
    A: Axes<R>,
    O: OldState<T>,
    D: Derivative<N>,
    S: Sink<T, N>,
    const N: usize,
>(
    source: L,
    given: &PropertyFrame<T>,
    Inputs { f, own, state }: Inputs<'_, T, R, O>,
    &MaterialAxes { ref axes, ref frame, usable }: &MaterialAxes<A, R>,
    tangent: D,
    sink: S,
) -> Result<(), Error> {
    let (stretch, images) = Stretch::new(f, axes);
    let law = source.law(given)?;
    let (shear, law) = (law.shears, law.lanes::<R>());
    let (section, [a, b]) = Section::of_point(&stretch, images, axes);
    let images = [images[0], a, b];
    let logarithms = Logarithms::new(&stretch, &section);
    let early = if D::EARLY { Some(Bases::new(&stretch, &section, &images)) } else { None };
    let strain = Strain::new(&stretch, &section, &logarithms);
    let kinematics = Kinematics { stretch: &stretch, section: &section, images, strain: &strain, slid: None };
    let (power, failure) = source.power_and_failure(&law, &strain);
    let k = law.kirchhoff(&stretch, &strain, power);
    let deformed = Deformed { law: &law, kinematics, k: &k, shear };
    let request = tangent.request();
    let may_overflow = match tangent.measure() {
        Some(measure) => may_overflow::<R>(measure, shear),
        None => false,
    };
    let entries = tangent.of(deformed, frame, A::ALONG_COORDINATES, early);
    let latch = R::of(state.entry(FAILED));
    let nan_if_invalid = R::select(usable, strain.nan_if_invalid, R::splat(f64::NAN));
    let r = deformed.respond::<true>(frame, nan_if_invalid, latch, request);
    let zero = R::splat(0.0);
    // As late as can be, since the compiler moves nothing across what is decided here.
    let own = own.numbers(request);
    let index = if request.failure { own.failure_index(failure, &strain) } else { zero };
    let updated = own.allowed(r.updated);
    let h = law.history(index, &strain, stretch.shear_invariant(), &k, updated, latch, request, shear);
    // This check comes after the stress, so that the stress need not wait for the tangent.
    let representable = if may_overflow { nan_unless_finite(&entries).le(zero) } else { zero.le(zero) };
    if !R::holds(updated & representable) {
        let failed = R::select(Failure::intact(latch), zero, R::splat(1.0)).value();
        let code: f64 = law.status_code(f, &stretch, usable, own.are_allowed(), latch).value().into();
        sink.take(Point::unchanged(state, failed, law.k_el.value(), code as i32), None, [T::splat(0.0); N]);
        return Ok(());
    }
    let point = Point::updated(&r, &h);
    sink.take(point, Some(stretch.inverse_jacobian.value()), values(&entries));
    Ok(())
}
