//! The yarn law at one point: the stages one after the other, then what failure and errors make of the answer.

use nalgebra::Matrix3;

use super::hyperelastic::{Hyperelastic, Kirchhoff, Request};
use super::kinematics::{Axes, FibreFrame, FirstAxis, Kinematics, Logarithms, Section, Strain, Stretch};
use super::real::{Real, Single};
use super::state::{ALIVE, FAILED, HYPERELASTIC_STATE};
use super::status::{self, Error};
use super::tangent::unrepresentable;

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

/// What is to be made of a point beside its answer: so many numbers.
///
/// A trait and no closure: the compiler need not inline a closure, which then lacks the instructions of the function that
/// calls it.
pub trait Derivative<const N: usize>: Copy {
    /// What the tangent needs and can be had before the invariants.
    type Early<R: Real>;

    fn early<R: Real>(self, d: &Stretch<R>, section: &Section<R>, images: &[[R; 3]; 3]) -> Self::Early<R>;

    /// What is wanted of the law itself.
    fn request(self) -> Request;

    fn of<R: Real>(
        self,
        law: &Hyperelastic<R>,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        early: &Self::Early<R>,
        shear: bool,
    ) -> [R; N];
}

/// Where the answer goes. Handed over while it stands in registers: a copy by way of memory would make the processor wait.
pub trait Sink<T, const N: usize> {
    fn take(self, point: Point<T>, entries: [T; N]);
}

impl<T, const N: usize> Sink<T, N> for (&mut Point<T>, &mut [T; N]) {
    #[inline(always)]
    fn take(self, point: Point<T>, entries: [T; N]) {
        (*self.0, *self.1) = (point, entries);
    }
}

/// The law alone.
#[derive(Clone, Copy)]
pub struct Alone(pub Request);

/// Stress and state alone, known to the compiler to be all that is wanted.
#[derive(Clone, Copy)]
pub struct StressAndState;

impl Derivative<0> for Alone {
    type Early<R: Real> = ();

    #[inline(always)]
    fn early<R: Real>(self, _: &Stretch<R>, _: &Section<R>, _: &[[R; 3]; 3]) {}

    #[inline(always)]
    fn request(self) -> Request {
        self.0
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        _: &Hyperelastic<R>,
        _: Kinematics<'_, R>,
        _: &Kirchhoff<R>,
        _: &FibreFrame<R>,
        (): &(),
        _: bool,
    ) -> [R; 0] {
        []
    }
}

impl Derivative<0> for StressAndState {
    type Early<R: Real> = ();

    #[inline(always)]
    fn early<R: Real>(self, _: &Stretch<R>, _: &Section<R>, _: &[[R; 3]; 3]) {}

    #[inline(always)]
    fn request(self) -> Request {
        Request::STRESS_AND_STATE
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        _: &Hyperelastic<R>,
        _: Kinematics<'_, R>,
        _: &Kirchhoff<R>,
        _: &FibreFrame<R>,
        (): &(),
        _: bool,
    ) -> [R; 0] {
        []
    }
}

impl<T: Real<Mask = bool> + Into<f64>> Hyperelastic<T> {
    /// Whether there is a longitudinal-shear stiffness; without one its terms need not be computed.
    pub fn shears(&self) -> bool {
        T::splat(0.0).lt(self.k_ld)
    }

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
        self.point_with(f, fibre, state, Alone(request)).0
    }

    /// The law at one point, with what `tangent` makes of it: intact in the call that detects failure, zeros afterwards
    /// and where the point cannot be evaluated, which it cannot where the tangent is not finite.
    #[inline(always)]
    pub(super) fn point_with<D: Derivative<N>, const N: usize>(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        tangent: D,
    ) -> (Point<T>, [T; N]) {
        let (mut point, mut entries) = (Point::nothing(), [T::splat(0.0); N]);
        evaluate::<T, T, D, _, N>(self, f, fibre, state, tangent, (&mut point, &mut entries));
        (point, entries)
    }
}

/// As [`Hyperelastic::point_with`], computed in R.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub(super) fn evaluate<
    T: Real<Mask = bool> + Into<f64>,
    R: Single<T>,
    D: Derivative<N>,
    S: Sink<T, N>,
    const N: usize,
>(
    law: &Hyperelastic<T>,
    f: &[[T; 3]; 3],
    fibre: Option<[T; 3]>,
    state: &[T; HYPERELASTIC_STATE],
    tangent: D,
    sink: S,
) {
    let (shear, law) = (law.shears(), law.lanes::<R>());
    let vector = |v: [T; 3]| [R::of(v[0]), R::of(v[1]), R::of(v[2])];
    let f = [vector(f[0]), vector(f[1]), vector(f[2])];
    let everywhere = R::splat(0.0).le(R::splat(0.0));
    match fibre {
        Some(direction) => {
            let (frame, usable) = FibreFrame::new(vector(direction));
            law.point_in(&f, &frame, &frame, usable, state, shear, tangent, sink);
        }
        None if law.aligned => {
            law.point_in(&f, &FirstAxis, &law.frame, everywhere, state, shear, tangent, sink);
        }
        None => law.point_in(&f, &law.frame, &law.frame, everywhere, state, shear, tangent, sink),
    }
}

/// A call from a host that hands over the properties with every point.
#[derive(Debug)]
pub struct Call<'a, T, D, S, const N: usize> {
    pub properties: &'a [T],
    /// Columns of F.
    pub f: &'a [[T; 3]; 3],
    /// A fibre direction of any length, or that of the properties.
    pub fibre: Option<[T; 3]>,
    pub state: &'a [T; HYPERELASTIC_STATE],
    pub tangent: D,
    pub sink: S,
}

impl<T: Real<Mask = bool> + Into<f64>, D: Derivative<N>, S: Sink<T, N>, const N: usize> Call<'_, T, D, S, N> {
    /// Prepares the law and evaluates it, in R.
    ///
    /// # Errors
    /// The first property that is wrong; nothing is written.
    #[inline(always)]
    pub(super) fn evaluate<R: Single<T>>(self) -> Result<(), Error> {
        let law = Hyperelastic::new(self.properties)?;
        evaluate::<T, R, D, S, N>(&law, self.f, self.fibre, self.state, self.tangent, self.sink);
        Ok(())
    }
}

/// So many numbers of one point.
#[inline(always)]
fn values<T: Real, R: Single<T>, const N: usize>(numbers: &[R; N]) -> [T; N] {
    let mut values = [T::splat(0.0); N];
    for (value, &number) in values.iter_mut().zip(numbers) {
        *value = number.value();
    }
    values
}

impl<R: Real> Hyperelastic<R> {
    /// The law at one point, in these axes; `frame` the same ones as vectors.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn point_in<T: Real<Mask = bool> + Into<f64>, A: Axes<R>, D: Derivative<N>, S: Sink<T, N>, const N: usize>(
        &self,
        f: &[[R; 3]; 3],
        axes: &A,
        frame: &FibreFrame<R>,
        usable: R::Mask,
        state: &[T; HYPERELASTIC_STATE],
        shear: bool,
        tangent: D,
        sink: S,
    ) where
        R: Single<T>,
    {
        let (stretch, images) = Stretch::new(f, axes);
        let (section, [a, b]) = Section::new(&stretch, images, axes);
        let images = [images[0], a, b];
        let early = tangent.early(&stretch, &section, &images);
        let strain = Strain::new(&stretch, &section, &Logarithms::new(&stretch, &section));
        let kinematics = Kinematics { stretch: &stretch, section: &section, images, strain: &strain };
        let k = self.kirchhoff_of(kinematics);
        let request = tangent.request();
        let tangent = tangent.of(self, kinematics, &k, frame, &early, shear);
        let latch = R::of(state[FAILED]);
        let doubt = R::select(usable, strain.doubt, R::splat(f64::NAN)) + unrepresentable(&tangent);
        let r = self.respond(kinematics, &k, frame, doubt, latch, request, shear);
        let h = self.history(&strain, stretch.shear_invariant(), &k, r.new, latch, request, shear);
        let failed = h.failed.value();
        if !R::holds(r.new) {
            let verdict: f64 = self.verdict(f, &stretch, usable, latch).value().into();
            let point = Point::kept(state, failed, r.wave_modulus.value(), verdict as i32);
            return sink.take(point, [T::splat(0.0); N]);
        }
        let ([w_el, w_tc, w_td, w_ld], [i_el, i_tc, i_td, i_ld]) = (values(&h.energies), values(&h.invariants));
        let (index, alive) = (h.failure_index.value(), T::splat(1.0) - failed);
        let point = Point {
            stress: values(&r.stress),
            state: [w_el, w_tc, w_td, w_ld, i_el, i_tc, i_td, i_ld, index, failed, alive],
            modes: [values(&r.modes[0]), values(&r.modes[1]), values(&r.modes[2]), values(&r.modes[3])],
            wave_modulus: r.wave_modulus.value(),
            status: status::OK,
        };
        sink.take(point, values(&tangent));
    }
}

impl<T: Real<Mask = bool>> Point<T> {
    /// All zero.
    #[inline(always)]
    pub fn nothing() -> Self {
        let zero = T::splat(0.0);
        Point {
            stress: [zero; 6],
            state: [zero; HYPERELASTIC_STATE],
            modes: [[zero; 6]; 4],
            wave_modulus: zero,
            status: status::OK,
        }
    }

    /// A point that carries nothing and keeps its state but for the latch, for the reason `verdict`.
    #[inline(never)]
    fn kept(state: &[T; HYPERELASTIC_STATE], failed: T, wave_modulus: T, verdict: i32) -> Self {
        let zero = T::splat(0.0);
        let mut point = Point { wave_modulus, status: verdict, ..Point::nothing() };
        // The latch has been looked at, and alive is never read.
        for (x, &old) in point.state.iter_mut().zip(state).take(FAILED) {
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
