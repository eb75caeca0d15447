//! A law of your own, in safe Rust: its tables, and its stress as a function of F and of the old state. The hosts take
//! it as they take the library's laws.
//!
//! The formulas are written once, over [`Real`]: a call evaluates them in both precisions, several points at a time in
//! the processor's registers, and with derivatives for the tangent. What every law needs is done here: the properties
//! are checked by their table, an F that is inverted or not finite and a result that does not fit the number format are
//! reported by a status, and a point that has failed stays failed and has no stress.
//!
//! # Speed
//!
//! The formulas must be inlined into the kernels: `#[inline(always)]` on [`constants`](UserMaterial::constants),
//! [`respond`](UserMaterial::respond), [`wave_modulus`](UserMaterial::wave_modulus) and every function that they call,
//! operators, and the functions of [`vector`] on vectors and matrices. A closure, and `map` or `from_fn` on an array,
//! is a function of its own, which may be called for each lane: such a law is right, but several times slower.
//! `docs/guides/own-law.md` has a test for it.

mod kernel;
mod tangent;

pub use super::description::{Description, Direction, MOST_DIRECTIONS, Reads};
pub use super::number::dual::Dual;
pub use super::number::real::Real;
pub use super::number::{tensor, vector};
pub use super::resistance::Resistance;

/// What the table of properties is made of.
pub mod parameters {
    pub use crate::law::parameters::{
        DENSITY, Dimension, ENERGY_DENSITY, NUMBER, Property, STRESS, component, positive, positive_or_zero,
    };
}

/// What the table of state variables is made of.
pub mod state {
    pub use crate::law::parameters::{ENERGY_DENSITY, NUMBER, STRESS};
    pub use crate::law::state::{ALIVE_ROW as ALIVE, FAILED_ROW as FAILED, StateVariable, row as variable};
}

use super::axes::FibreFrame;
use super::block::{Precision, evaluate_points};
use super::bounds::check;
use super::error::{Error, Value};
use super::interface::{Law, Points};
use super::number::vector::Matrix;
use super::parameters::{Property, same};
use super::status;

/// A law in formulas: implemented by a type without content, which stands for the law.
///
/// The stress must be that of an objective law: F → QF with a rotation Q turns it to QσQᵀ. Conversions between tangents
/// rely on it, and Abaqus/Explicit, which passes the right stretches in place of F. So directions and tensors in the
/// state are those of the reference placement, and a law that reads F at the start must not depend on a rotation of
/// that F alone.
pub trait UserMaterial: Copy + Default + Send + Sync + 'static {
    /// The law's tables, and what hosts have to know of them.
    const DESCRIPTION: Description;
    /// `[R; N]`, N the number of properties.
    type Properties<R: Real>: Array<R>;
    /// `[R; N]`, N the number of state variables without the last two, `failed` and `alive`, which are kept for the
    /// law.
    type State<R: Real>: Array<R>;
    /// What is computed from the properties once for all points of a call.
    type Constants<R: Real>: Copy;

    /// Checks what the table of properties does not: relations between properties. They are within their bounds, and no
    /// direction is zero that may not be.
    ///
    /// # Errors
    /// [`Error::Argument`] names the property, its value and what is allowed.
    fn check(_properties: &Self::Properties<f64>) -> Result<(), Error> {
        Ok(())
    }

    /// The properties as the formulas use them, in plain arithmetic, once where the law is prepared: an angle may
    /// become its cosine. By default they are those that have been checked, as they are; the directions are always
    /// those of the properties themselves.
    fn prepare(properties: &Self::Properties<f64>) -> Self::Properties<f64> {
        *properties
    }

    /// The constants of the formulas, from properties that have been checked and [prepared](Self::prepare).
    fn constants<R: Real>(properties: &Self::Properties<R>) -> Self::Constants<R>;

    /// The law: stress and new state at the end of a step. Written without branches on a point's value: a choice is
    /// [`Real::select`].
    fn respond<R: Real>(constants: &Self::Constants<R>, step: &Step<R, Self::State<R>>) -> Response<R, Self::State<R>>;

    /// ρ0 c² for an upper bound c of the speed of every wave at the end of a step, from which explicit solvers compute
    /// their time step. `None`: the bound is computed from the tangent of every point, without vector registers, and
    /// the speed may be √3 times that of the fastest wave.
    fn wave_modulus<R: Real>(
        _constants: &Self::Constants<R>,
        _step: &Step<R, Self::State<R>>,
        _response: &Response<R, Self::State<R>>,
    ) -> Option<R> {
        None
    }

    /// What resists the motions of an element at rest, from the [prepared](Self::prepare) properties: `impact` takes
    /// artificial viscosity and hourglass control of it. `None`: that of an isotropic solid in which no wave is slower
    /// than the law's fastest one, which holds a section too stiff if the fibres are much stiffer than it.
    fn resistance(_properties: &Self::Properties<f64>) -> Option<Resistance> {
        None
    }
}

/// An array of numbers `[R; N]`, as a type without its length. Sealed: the hosts copy a state as the numbers that it is
/// made of.
pub trait Array<R>: Copy + AsRef<[R]> + AsMut<[R]> + sealed::Sealed {
    /// N.
    const LENGTH: usize;
    /// The same number N times.
    fn filled(value: R) -> Self;
}

mod sealed {
    pub trait Sealed {}
    impl<R, const N: usize> Sealed for [R; N] {}
}

impl<R: Copy, const N: usize> Array<R> for [R; N] {
    const LENGTH: usize = N;
    #[inline(always)]
    fn filled(value: R) -> Self {
        [value; N]
    }
}

/// What a law is evaluated from.
#[derive(Clone, Copy, Debug)]
pub struct Step<R, S> {
    /// F at the start of the step, by columns; that at its end where the description says that the law does not read
    /// it.
    pub f_old: Matrix<R>,
    /// F at its end, by columns, and det F, accurate to a few roundings. At points where it is not positive, or F not
    /// finite, the results do not count.
    pub f: Matrix<R>,
    pub jacobian: R,
    /// The unit vector of the fibre direction in the reference placement; of a law without fibre the first axis.
    pub fibre: [R; 3],
    /// The unit vectors of the description's other directions in the reference placement, in its order; 0 for one that
    /// is 0, and behind the last one.
    pub other_directions: [[R; 3]; MOST_DIRECTIONS - 1],
    /// The length of the step, not negative, and the time at its end, in the units of the host; the temperature at its
    /// end. Each is 0 where the description does not say that the law reads it.
    pub time_increment: R,
    pub time: R,
    pub temperature: R,
    /// The old state variables, without `failed` and `alive`; all 0 at the start.
    pub state: S,
}

impl<R: Real, S> Response<R, S> {
    /// The response of a point that neither fails nor is refused.
    #[inline(always)]
    pub fn new(stress: [R; 6], state: S) -> Self {
        Response { stress, state, failed: R::never(), status: R::splat(0.0) }
    }
}

impl<R: Real, S> Step<R, S> {
    /// ln det F, faster than `jacobian.ln()`: without meaning at points whose results do not count.
    #[inline(always)]
    pub fn log_jacobian(&self) -> R {
        self.jacobian.ln_of_normal()
    }
}

/// What a law answers.
#[derive(Clone, Copy, Debug)]
pub struct Response<R: Real, S> {
    /// Cauchy stress 11 22 33 12 23 31, in global axes. It is that of the intact material where `failed` holds for the
    /// first time; it is set to 0 in later calls.
    pub stress: [R; 6],
    /// The new state variables, without `failed` and `alive`.
    pub state: S,
    /// Where the point has failed in this step; [`Real::never`] for a law without failure.
    pub failed: R::Mask,
    /// 0, or why the point cannot be evaluated, a code of [`status`]: [`status::LAW`], which means
    /// what the description's `refusal` says, [`status::SMALLER_STEP`], or another one. Such a point
    /// keeps its old state. Read only of a law whose description has a refusal.
    pub status: R,
}

/// A law in formulas, prepared from its properties: numbers only, without padding.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct User<M: UserMaterial, T: Real> {
    properties: M::Properties<T>,
    /// Unit vectors: the fibre, or the first axis of a law without one, and the other directions.
    directions: [[T; 3]; MOST_DIRECTIONS],
}

/// The state of a point: the law's own variables, then `failed` and `alive`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct UserState<S, T> {
    pub own: S,
    pub failed: T,
    pub alive: T,
}

impl<S: Array<T>, T> UserState<S, T> {
    const LENGTH: usize = S::LENGTH + 2;
}

impl<S: Array<T>, T> AsRef<[T]> for UserState<S, T> {
    #[inline(always)]
    fn as_ref(&self) -> &[T] {
        const { assert!(size_of::<Self>() == Self::LENGTH * size_of::<T>(), "`State` must be an array of numbers") };
        // SAFETY: `repr(C)`, an array of numbers and two numbers of the same type, of this size together: no padding.
        unsafe { core::slice::from_raw_parts(core::ptr::from_ref(self).cast(), Self::LENGTH) }
    }
}

impl<S: Array<T>, T> AsMut<[T]> for UserState<S, T> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [T] {
        const { assert!(size_of::<Self>() == Self::LENGTH * size_of::<T>(), "`State` must be an array of numbers") };
        // SAFETY: as above.
        unsafe { core::slice::from_raw_parts_mut(core::ptr::from_mut(self).cast(), Self::LENGTH) }
    }
}

/// Checks at compile time that a law's tables fit its types.
pub(crate) const fn check_tables<M: UserMaterial>() {
    let Description { properties, state, directions, failed, alive, energies, .. } = M::DESCRIPTION;
    let own = <M::State<f64> as Array<f64>>::LENGTH;
    assert!(properties.len() == <M::Properties<f64> as Array<f64>>::LENGTH, "a row of the table for each property");
    assert!(state.len() == own + 2, "a row of the table for each state variable, and for `failed` and `alive`");
    assert!(failed == own && same(state[own].name, "failed"), "`failed` is the last row but one of the state");
    assert!(alive == own + 1 && same(state[own + 1].name, "alive"), "`alive` is the last row of the state");
    assert!(
        energies.start <= energies.end && energies.end <= own,
        "the energies are among the law's own state variables"
    );
    if let Some(lost) = M::DESCRIPTION.lost {
        assert!(lost < own, "the energy lost is among the law's own state variables");
    }
    assert!(directions.len() <= MOST_DIRECTIONS, "a law has at most three directions");
    let mut i = 0;
    while i < directions.len() {
        let Direction { name, first, may_be_zero } = directions[i];
        assert!(first + 3 <= properties.len(), "the three components of a direction are properties");
        assert!(!name.is_empty() && name.len() < 60, "a direction has a name of fewer than 60 bytes");
        assert!(i > 0 || !may_be_zero, "the first direction, that of the fibre, may not be zero");
        i += 1;
    }
    assert!(!properties.is_empty(), "a law has properties");
    let mut i = 0;
    while i < properties.len() {
        let Property { name, symbol, allowed, meaning, .. } = &properties[i];
        check_row(name, symbol, meaning);
        assert!(allowed.len() < 80, "what is allowed for a property has fewer than 80 bytes");
        let mut k = 0;
        while k < i {
            assert!(!same(name, properties[k].name), "two properties have the same name");
            k += 1;
        }
        i += 1;
    }
    let mut i = 0;
    while i < state.len() {
        check_row(state[i].name, state[i].symbol, state[i].meaning);
        let mut k = 0;
        while k < i {
            assert!(!same(state[i].name, state[k].name), "two state variables have the same name");
            k += 1;
        }
        i += 1;
    }
}

/// Checks that a row of a table can be told in C: its name is an identifier, and the texts are not cut.
const fn check_row(name: &str, symbol: &str, meaning: &str) {
    let (bytes, mut i) = (name.as_bytes(), 0);
    assert!(!bytes.is_empty() && !bytes[0].is_ascii_digit(), "a name in a table begins with a letter");
    while i < bytes.len() {
        assert!(bytes[i].is_ascii_alphanumeric() || bytes[i] == b'_', "a name in a table is a C identifier");
        i += 1;
    }
    assert!(name.len() < 24 && symbol.len() < 24, "names and symbols in a table have fewer than 24 bytes");
    assert!(meaning.len() < 100, "a meaning in a table has fewer than 100 bytes");
}

impl<M: UserMaterial, T: Precision> User<M, T> {
    /// Checks the properties, in the order of the description, and prepares the law.
    ///
    /// # Errors
    /// The first property that is wrong, with its value and what is allowed.
    pub fn new(properties: &[T]) -> Result<Self, Error> {
        const { check_tables::<M>() };
        check(M::DESCRIPTION.properties, properties)?;
        let zero = T::splat(0.0);
        let mut own = M::Properties::<T>::filled(zero);
        let mut doubled = M::Properties::<f64>::filled(0.0);
        for (double, &from) in doubled.as_mut().iter_mut().zip(properties) {
            *double = from.into();
        }
        let directions = Self::directions(properties)?;
        M::check(&doubled).map_err(Error::for_caller_of::<T>)?;
        for (to, &from) in own.as_mut().iter_mut().zip(M::prepare(&doubled).as_ref()) {
            *to = T::splat(from);
        }
        Ok(User { properties: own, directions })
    }

    /// The unit vectors of the directions.
    ///
    /// # Errors
    /// The first one that is zero and may not be, or has no length in this precision.
    fn directions(properties: &[T]) -> Result<[[T; 3]; MOST_DIRECTIONS], Error> {
        let zero = [T::splat(0.0); 3];
        let mut units = [FibreFrame::first_axis().m, zero, zero];
        for (unit, direction) in units.iter_mut().zip(M::DESCRIPTION.directions) {
            let vector = properties.get(direction.first..).and_then(<[T]>::first_chunk).copied().unwrap_or(zero);
            let (frame, usable) = FibreFrame::new(vector);
            *unit = match (usable, direction.may_be_zero && vector == zero) {
                (true, _) => frame.m,
                (false, true) => zero,
                (false, false) => {
                    let Direction { name, first: index, .. } = *direction;
                    let (code, value) = (status::PROPERTY_DIRECTION, vector.map(Value::of));
                    return Err(Error::Direction { code, index, name, value, wanted: "any vector but zero" });
                }
            };
        }
        Ok(units)
    }

    /// The same law in double precision.
    fn doubled(&self) -> User<M, f64> {
        let mut properties = M::Properties::<f64>::filled(0.0);
        for (to, &from) in properties.as_mut().iter_mut().zip(self.properties.as_ref()) {
            *to = from.into();
        }
        User { properties, directions: self.directions.map(|direction| direction.map(Into::into)) }
    }

    /// The constants of the formulas in the lanes of `R`, or with derivatives.
    #[inline(always)]
    fn constants<R: Real>(&self) -> M::Constants<R> {
        let mut properties = M::Properties::<R>::filled(R::splat(0.0));
        let mut values = self.properties.as_ref().iter();
        for to in properties.as_mut() {
            let Some(&from) = values.next() else { break };
            *to = R::splat(from.into());
        }
        M::constants(&properties)
    }
}

// SAFETY: the state has a number for each row of the table, which `new` checks at compile time, and the kernels access
// what `Points` says.
unsafe impl<M: UserMaterial, T: Precision> Law<T> for User<M, T> {
    const DESCRIPTION: Description = M::DESCRIPTION;
    type State = UserState<M::State<T>, T>;

    fn fresh() -> Self::State {
        let zero = T::splat(0.0);
        UserState { own: M::State::<T>::filled(zero), failed: zero, alive: zero }
    }

    fn new(properties: &[T]) -> Result<Self, Error> {
        User::new(properties)
    }

    fn axes(&self) -> [[f64; 3]; 3] {
        let [fibre, ..] = self.directions;
        let (FibreFrame { t1, t2, .. }, _) = FibreFrame::new(fibre);
        [fibre, t1, t2].map(|axis| axis.map(Into::into))
    }

    fn bulk_and_shear(&self) -> [T; 2] {
        let modulus = self.doubled().wave_modulus_at_rest();
        [T::splat(0.5 * modulus), T::splat(0.375 * modulus)]
    }

    fn resistance(&self) -> Resistance {
        M::resistance(&self.doubled().properties)
            .unwrap_or_else(|| Resistance::isotropic(Law::bulk_and_shear(&self.doubled())))
    }

    fn told(&self, code: i32) -> Result<i32, Error> {
        // A temperature of 0 need not mean anything.
        if code == status::OVERFLOW
            && !M::DESCRIPTION.reads.temperature
            && let Some(text) = self.doubled().fault_at_rest()
        {
            return Err(Error::Setting { code: status::PROPERTY_OUT_OF_BOUNDS, text });
        }
        M::DESCRIPTION.told(code)
    }

    unsafe fn step(&self, points: &Points<T>) -> Result<i32, Error> {
        // SAFETY: the points are valid.
        unsafe { evaluate_points(self, points) }
    }
}
