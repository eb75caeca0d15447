//! The derivative that a call for one point computes besides stress and state: none, or one of the tangents.

use super::axes::FibreFrame;
use super::hyperelastic::Deformed;
use super::number::real::Real;
use super::response::Request;
use super::tangent::{Bases, Measure};

/// A derivative of N numbers, computed at a point besides its stress and state.
///
/// This is a trait and not a closure: a closure that the compiler does not inline is compiled without the instructions
/// (AVX2, FMA) of the function that calls it.
pub(crate) trait Derivative<const N: usize>: Copy {
    /// Whether the tensors of the spatial moduli are computed before the invariants, for which the processor waits
    /// long.
    const EARLY: bool = false;
    /// The same derivative with its request as a value at run time. The functions of `Hyperelastic` are
    /// compiled for these types only.
    type General: Derivative<N>;

    /// This derivative as the general type.
    fn general(self) -> Self::General;

    /// The results of the law that are requested.
    fn request(self) -> Request;

    /// Which tangent, if any.
    fn measure(self) -> Option<Measure>;

    /// The N numbers. `n` are the axes of the fibre; `along_coordinates` says whether these are the coordinate axes.
    /// `early` is there if [`EARLY`](Self::EARLY) is set.
    fn of<R: Real>(
        self,
        point: Deformed<'_, R>,
        n: &FibreFrame<R>,
        along_coordinates: bool,
        early: Option<Bases<R>>,
    ) -> [R; N];
}

/// No tangent.
#[derive(Clone, Copy)]
pub(crate) struct NoTangent(pub Request);

/// No tangent; the stress is requested, and the state if `STATE`, which the compiler knows.
#[derive(Clone, Copy)]
pub(crate) struct Stress<const STATE: bool>;

impl<const STATE: bool> Stress<STATE> {
    pub const REQUEST: Request =
        Request { stress: true, energies: STATE, invariants: STATE, failure: STATE, ..Request::NOTHING };
}

/// What requests no tangent.
pub(crate) trait WithoutTangent: Copy {
    fn results(self) -> Request;
}

impl WithoutTangent for NoTangent {
    #[inline(always)]
    fn results(self) -> Request {
        self.0
    }
}

impl<const STATE: bool> WithoutTangent for Stress<STATE> {
    #[inline(always)]
    fn results(self) -> Request {
        Self::REQUEST
    }
}

impl<Q: WithoutTangent> Derivative<0> for Q {
    type General = NoTangent;

    fn general(self) -> NoTangent {
        NoTangent(self.results())
    }

    #[inline(always)]
    fn request(self) -> Request {
        self.results()
    }

    #[inline(always)]
    fn measure(self) -> Option<Measure> {
        None
    }

    #[inline(always)]
    fn of<R: Real>(self, _: Deformed<'_, R>, _: &FibreFrame<R>, _: bool, _: Option<Bases<R>>) -> [R; 0] {
        []
    }
}

/// A 6×6 tangent, as its upper triangle.
#[derive(Clone, Copy)]
pub(crate) struct SixBySix(pub Request, pub Measure);

/// The modulus of the Jaumann rate; stress and state are requested, which the compiler knows.
#[derive(Clone, Copy)]
pub(crate) struct JaumannModulus;

/// What requests a 6×6 tangent.
pub(crate) trait WithModuli: Copy {
    const EARLY: bool;
    fn moduli(self) -> SixBySix;
}

impl WithModuli for SixBySix {
    const EARLY: bool = false;
    #[inline(always)]
    fn moduli(self) -> SixBySix {
        self
    }
}

impl WithModuli for JaumannModulus {
    const EARLY: bool = true;
    #[inline(always)]
    fn moduli(self) -> SixBySix {
        SixBySix(Request::STRESS_AND_STATE, Measure::Jaumann)
    }
}

impl<Q: WithModuli> Derivative<21> for Q {
    const EARLY: bool = Q::EARLY;
    type General = SixBySix;

    fn general(self) -> SixBySix {
        self.moduli()
    }

    #[inline(always)]
    fn request(self) -> Request {
        self.moduli().0
    }

    #[inline(always)]
    fn measure(self) -> Option<Measure> {
        Some(self.moduli().1)
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        point: Deformed<'_, R>,
        n: &FibreFrame<R>,
        along_coordinates: bool,
        early: Option<Bases<R>>,
    ) -> [R; 21] {
        point.moduli(n, along_coordinates, self.moduli().1, early).0
    }
}

/// dP/dF, 9×9.
#[derive(Clone, Copy)]
pub(crate) struct NineByNine(pub Request);

impl Derivative<81> for NineByNine {
    type General = Self;

    fn general(self) -> Self {
        self
    }

    #[inline(always)]
    fn request(self) -> Request {
        self.0
    }

    #[inline(always)]
    fn measure(self) -> Option<Measure> {
        Some(Measure::Nominal)
    }

    #[inline(always)]
    fn of<R: Real>(self, point: Deformed<'_, R>, n: &FibreFrame<R>, _: bool, _: Option<Bases<R>>) -> [R; 81] {
        point.nominal_tangent(n)
    }
}
