//! The derivative that a call for one point computes besides stress and state: none, or one of the tangents.

use super::hyperelastic::{Hyperelastic, Kirchhoff};
use super::kinematics::{FibreFrame, Kinematics, Section, Stretch};
use super::number::real::Real;
use super::response::Request;
use super::tangent::{Bases, Measure, may_overflow};

/// A derivative of N numbers, computed at a point besides its stress and state.
///
/// This is a trait and not a closure: a closure that the compiler does not inline is compiled without the instructions (AVX2,
/// FMA) of the function that calls it.
pub(crate) trait Derivative<const N: usize>: Copy {
    /// The part of the tangent that can be computed before the invariants are known.
    type Early<R: Real>;
    /// The same derivative with its request as a value at run time. The functions of [`Hyperelastic`] are compiled for these
    /// types only.
    type General: Derivative<N>;

    /// This derivative as the general type.
    fn general(self) -> Self::General;

    /// Computes the early part.
    fn early<R: Real>(self, d: &Stretch<R>, section: &Section<R>, images: &[[R; 3]; 3]) -> Self::Early<R>;

    /// The results of the law that are requested.
    fn request(self) -> Request;

    /// Whether an entry may overflow in `R` at a point whose strains are valid.
    fn may_overflow<R: Real>(self, shear: bool) -> bool;

    /// The N numbers. `n` are the axes of the fibre; `along_coordinates` says whether these are the coordinate axes, and `shear`
    /// whether k_ld is above 0.
    #[allow(clippy::too_many_arguments)]
    fn of<R: Real>(
        self,
        law: &Hyperelastic<R>,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        along_coordinates: bool,
        early: &Self::Early<R>,
        shear: bool,
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
        Request { stress: true, energies: STATE, invariants: STATE, failure: STATE, modes: false, wave_modulus: false };
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
    type Early<R: Real> = ();
    type General = NoTangent;

    fn general(self) -> NoTangent {
        NoTangent(self.results())
    }

    #[inline(always)]
    fn early<R: Real>(self, _: &Stretch<R>, _: &Section<R>, _: &[[R; 3]; 3]) {}

    #[inline(always)]
    fn request(self) -> Request {
        self.results()
    }

    #[inline(always)]
    fn may_overflow<R: Real>(self, _: bool) -> bool {
        false
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        _: &Hyperelastic<R>,
        _: Kinematics<'_, R>,
        _: &Kirchhoff<R>,
        _: &FibreFrame<R>,
        _: bool,
        (): &(),
        _: bool,
    ) -> [R; 0] {
        []
    }
}

/// A 6×6 tangent, as its upper triangle.
#[derive(Clone, Copy)]
pub(crate) struct SixBySix(pub Request, pub Measure);

impl Derivative<21> for SixBySix {
    type Early<R: Real> = ();
    type General = Self;

    fn general(self) -> Self {
        self
    }

    #[inline(always)]
    fn early<R: Real>(self, _: &Stretch<R>, _: &Section<R>, _: &[[R; 3]; 3]) {}

    #[inline(always)]
    fn request(self) -> Request {
        self.0
    }

    #[inline(always)]
    fn may_overflow<R: Real>(self, shear: bool) -> bool {
        may_overflow::<R>(self.1, shear)
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        law: &Hyperelastic<R>,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        along_coordinates: bool,
        (): &(),
        shear: bool,
    ) -> [R; 21] {
        law.moduli(kinematics, k, n, along_coordinates, self.1, shear).0
    }
}

/// The modulus of the Jaumann rate; stress and state are requested, which the compiler knows.
#[derive(Clone, Copy)]
pub(crate) struct JaumannModulus;

impl Derivative<21> for JaumannModulus {
    type Early<R: Real> = Bases<R>;
    type General = SixBySix;

    fn general(self) -> SixBySix {
        SixBySix(Request::STRESS_AND_STATE, Measure::Jaumann)
    }

    #[inline(always)]
    fn early<R: Real>(self, d: &Stretch<R>, section: &Section<R>, images: &[[R; 3]; 3]) -> Bases<R> {
        Bases::new(d, section, images)
    }

    #[inline(always)]
    fn request(self) -> Request {
        Request::STRESS_AND_STATE
    }

    #[inline(always)]
    fn may_overflow<R: Real>(self, shear: bool) -> bool {
        may_overflow::<R>(Measure::Jaumann, shear)
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        law: &Hyperelastic<R>,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        _: &FibreFrame<R>,
        _: bool,
        bases: &Bases<R>,
        shear: bool,
    ) -> [R; 21] {
        law.spatial_tangent(kinematics, bases, k, Measure::Jaumann, shear).0
    }
}

/// dP/dF, 9×9.
#[derive(Clone, Copy)]
pub(crate) struct NineByNine(pub Request);

impl Derivative<81> for NineByNine {
    type Early<R: Real> = ();
    type General = Self;

    fn general(self) -> Self {
        self
    }

    #[inline(always)]
    fn early<R: Real>(self, _: &Stretch<R>, _: &Section<R>, _: &[[R; 3]; 3]) {}

    #[inline(always)]
    fn request(self) -> Request {
        self.0
    }

    #[inline(always)]
    fn may_overflow<R: Real>(self, shear: bool) -> bool {
        may_overflow::<R>(Measure::Nominal, shear)
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        law: &Hyperelastic<R>,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        _: bool,
        (): &(),
        shear: bool,
    ) -> [R; 81] {
        let zero = R::splat(0.0);
        let stress = law.cauchy(kinematics, k, zero.le(zero), shear);
        law.nominal_tangent(kinematics, k, n, &stress, shear)
    }
}
