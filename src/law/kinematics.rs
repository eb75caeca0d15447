//! The kinematics: from the deformation gradient to the four deformation modes and to the quantities that the stress
//! needs, without cancellation.
//!
//! With N = (m, t1, t2) the fibre and any two transverse axes, c_i = F N_i are the images of the axes. The fibre gives
//!
//! ```text
//! λ² = c1·c1            fibre stretch, I_el = ½ ln λ²
//! h_j = c1·c_j          longitudinal shear, I_ld = √(h2² + h3²)/λ²
//! ```
//!
//! and the parts of the other two images that are orthogonal to it, a = c2 − (h2/λ²) c1 and b = c3 − (h3/λ²) c1, make
//! the section:
//!
//! ```text
//! J_t² = (a·a)(b·b) − (a·b)²    area ratio, I_tc = ¼ ln J_t²
//! ŝ² = ¼(a·a − b·b)² + (a·b)²   distortion, I_td = ½ asinh(ŝ/J_t), with t̂ = ½(a·a + b·b) = √(ŝ² + J_t²)
//! ```
//!
//! The stress needs no inverse, no eigenvector, no quotient 0/0, and no root but that of ŝ².
//!
//! Near the reference the strains are differences of nearly equal numbers. There H = F − 1 is exact in floating point,
//! and C − 1 follows from H without cancellation; elsewhere the sums over F itself round best. One formula covers both,
//! C_ij = χ δ_ij + g_i·g_j + χ (n_i·g_j + n_j·g_i) with g_i = (F − χ1) n_i, for χ = 1 and χ = 0: the choice is a
//! number, not a branch. With δ2 = g2 − (h2/λ²) c1 the section has a = χ t1 + δ2 and x22 = a·a − χ = δ2·(a + χ t1), and
//! b and x33 follow in the same way from δ3.
//!
//! The computation has several stages ([`Stretch`], [`Section`], [`Logarithms`], [`Strain`]). A block evaluates each
//! stage for several points before the next one: within a stage the chain of dependent operations is short enough for
//! the processor to overlap points, and divisions and roots come at its end, where no operation of the stage waits for
//! them.

use super::axes::{Axes, FibreFrame, Image};
use super::number::elementary::{Asinh, Logarithm};
use super::number::real::{Real, Single};
use super::number::vector::{along, along_both, cross, dot, scale, select};

/// F is near the reference if every entry of its diagonal is above this by more than the sum of the squares of the
/// others. F − 1 is exact from ½ on. With d the least entry of the diagonal, |F v| > (d − √(d − 0.6)) |v| ≥ 0.35 |v|:
/// no direction is shortened so far that its strain, computed from F − 1, would cancel with 1.
const NEAR_REFERENCE: f64 = 0.6;

/// The first stage: determinant, fibre stretch and longitudinal shear.
#[derive(Clone, Copy)]
pub struct Stretch<R: Real> {
    /// 1 near the reference, else 0.
    pub(super) chi: R,
    /// det F and its reciprocal.
    pub jacobian: R,
    pub inverse_jacobian: R,
    /// λ², its reciprocal, and the rounding error of λ²: the exact value minus the computed one.
    pub square: R,
    pub inverse_square: R,
    rounding: R,
    /// h2 and h3, the products of the fibre's image with those of the transverse axes; (h2² + h3²)/λ².
    pub h: [R; 2],
    slip_square: R,
}

impl<R: Real> Stretch<R> {
    /// From `f` (columns of F) and the material axes. Also returns F m, (F − χ1) t1 and (F − χ1) t2, from which the
    /// section is computed.
    ///
    /// Valid where [`Strain::nan_if_invalid`] is 0; the caller masks out the other points.
    #[inline(always)]
    pub fn new<A: Axes<R>>(f: &[[R; 3]; 3], n: &A) -> (Self, [[R; 3]; 3]) {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));

        // All that follows waits for this choice: sums side by side.
        let [c1, c2, c3] = f;
        let apart = c1[1].mul_add(c1[1], c1[2] * c1[2])
            + c2[0].mul_add(c2[0], c2[2] * c2[2])
            + c3[0].mul_add(c3[0], c3[1] * c3[1]);
        let least = c1[0].min(c2[1]).min(c3[2]);
        let chi = R::select(apart.lt(least - R::splat(NEAR_REFERENCE)), one, zero);
        let norm_square = c1[0].mul_add(c1[0], c2[1].mul_add(c2[1], c3[2].mul_add(c3[2], apart)));

        let [m, t1, t2] = n.images(f, chi);
        let u11 = dot(m.rest, n.shifted(m.whole, chi, 0));
        let square = chi + u11;
        let h = [n.product(&m, &t1, chi, 1), n.product(&m, &t2, chi, 2)];
        let inverse_square = one / square;
        let jacobian = n.determinant(f, [m.whole, t1.whole, t2.whole], inverse_square, norm_square);
        let stretch = Stretch {
            chi,
            jacobian,
            inverse_jacobian: jacobian.reciprocal(),
            square,
            inverse_square,
            rounding: u11 - (square - chi),
            h,
            slip_square: h[0].mul_add(h[0], h[1] * h[1]) * inverse_square,
        };
        (stretch, [m.whole, t1.rest, t2.rest])
    }
}

impl<R: Real> Stretch<R> {
    /// The longitudinal-shear invariant I_ld, the only one that needs no logarithm.
    #[inline(always)]
    pub fn shear_invariant(&self) -> R {
        (self.slip_square * self.inverse_square).sqrt()
    }
}

/// The second stage: the section across the fibre.
///
/// Its deviator D̂ = a⊗a + b⊗b − t̂ Π, with Π = 1 − e⊗e, is computed as (a⊗D̂a + D̂a⊗a)/(a·a) − η Π, with
/// [`deviator`](Self::deviator) for η and [`beside_a`](Self::beside_a) for D̂a, whose terms are all as small as ŝ: it
/// keeps its digits if the section is hardly distorted.
#[derive(Clone, Copy, Debug)]
pub struct Section<R: Real> {
    /// ½(a·a − b·b), a·b and its square, a·a.
    pub delta: R,
    pub x23: R,
    pub x23_square: R,
    pub a_square: R,
    /// t̂ = ½(a·a + b·b) and ŝ.
    pub half_trace: R,
    pub distortion: R,
    /// J_t², its reciprocal, and the rounding error of J_t²: the exact value minus the computed one.
    area_square: R,
    inverse_area_square: R,
    rounding: R,
}

/// The fibres have slipped far where the square of their slip, (h2² + h3²)/λ², is above this times J_t²/t̂. That is
/// once to twice the square of the section's shorter half axis, and each half axis of slip costs about a rounding.
const FAR_SLIP: f64 = 4.0;

impl<R: Real> Section<R> {
    /// From F m, (F − χ1) t1 and (F − χ1) t2. Also returns a and b, the images of the transverse axes without their
    /// components along the image of the fibre.
    #[inline(always)]
    pub fn new<A: Axes<R>>(d: &Stretch<R>, images: [[R; 3]; 3], n: &A) -> (Self, [[R; 3]; 2]) {
        Self::from_rests(d, Self::rests(d, images), n)
    }

    /// As [`new`](Self::new), for one point, and right after a far slip as well.
    #[inline(always)]
    pub fn of_point<T, A: Axes<R>>(d: &Stretch<R>, images: [[R; 3]; 3], n: &A) -> (Self, [[R; 3]; 2])
    where
        R: Single<T>,
    {
        let (section, vectors) = Self::new(d, images, n);
        let far = section.slipped_far(d);
        if R::holds(far) { Self::orthogonal(d, images, n, far) } else { (section, vectors) }
    }

    /// Where the fibres have slipped so far that [`orthogonal`](Self::orthogonal) is needed: seldom.
    #[inline(always)]
    pub fn slipped_far(&self, d: &Stretch<R>) -> R::Mask {
        (R::splat(FAR_SLIP) * self.area_square).lt(d.slip_square * self.half_trace)
    }

    /// As [`new`](Self::new), with a and b made orthogonal to the fibre once more where `far` holds: of their
    /// components along it the rounding of (h/λ²) c1 is left, as many roundings of a as the slip is longer than a. The
    /// other lanes keep their bits.
    #[inline(always)]
    pub fn orthogonal<A: Axes<R>>(d: &Stretch<R>, images: [[R; 3]; 3], n: &A, far: R::Mask) -> (Self, [[R; 3]; 2]) {
        Self::from_rests(d, Self::orthogonal_rests(d, images, n, far), n)
    }

    /// δ2 and δ3 of [`orthogonal`](Self::orthogonal).
    #[inline(always)]
    pub fn orthogonal_rests<A: Axes<R>>(d: &Stretch<R>, images: [[R; 3]; 3], n: &A, far: R::Mask) -> [[R; 3]; 2] {
        let c1 = images[0];
        let [delta_2, delta_3] = Self::rests(d, images);
        let left_2 = dot(c1, n.shifted(delta_2, d.chi, 1)) * d.inverse_square;
        let left_3 = dot(c1, n.shifted(delta_3, d.chi, 2)) * d.inverse_square;
        let again_2 = select(far, along(delta_2, -left_2, c1), delta_2);
        let again_3 = select(far, along(delta_3, -left_3, c1), delta_3);
        [again_2, again_3]
    }

    /// δ2 = a − χ t1 and δ3 = b − χ t2.
    #[inline(always)]
    pub fn rests(d: &Stretch<R>, [c1, g2, g3]: [[R; 3]; 3]) -> [[R; 3]; 2] {
        [along(g2, -(d.h[0] * d.inverse_square), c1), along(g3, -(d.h[1] * d.inverse_square), c1)]
    }

    /// From δ2 and δ3, as [`new`](Self::new).
    #[inline(always)]
    pub fn from_rests<A: Axes<R>>(d: &Stretch<R>, [delta_2, delta_3]: [[R; 3]; 2], n: &A) -> (Self, [[R; 3]; 2]) {
        let (one, half) = (R::splat(1.0), R::splat(0.5));
        let a = Image { whole: n.shifted(delta_2, d.chi, 1), rest: delta_2 };
        let b = Image { whole: n.shifted(delta_3, d.chi, 2), rest: delta_3 };
        let Products { x22, x33, x23, x23_square, sum, delta } = Products::new(&a, &b, d.chi, n);

        // Where the section is near the reference, J_t² − 1 has more correct digits than J. With χ = 0 `near` never
        // holds.
        let growth = sum + x22.mul_add(x33, -x23_square);
        let ratio = d.jacobian * d.inverse_square * d.jacobian;
        let near = sum.lt(d.chi) & (-half).lt(growth);
        let area_square = R::select(near, one + growth, ratio);

        let section = Section {
            delta,
            x23,
            x23_square,
            a_square: d.chi + x22,
            half_trace: half.mul_add(sum, d.chi),
            distortion: delta.mul_add(delta, x23_square).sqrt(),
            area_square,
            inverse_area_square: d.square * d.inverse_jacobian * d.inverse_jacobian,
            rounding: R::select(near, growth - (area_square - one), R::splat(0.0)),
        };
        (section, [a.whole, b.whole])
    }

    /// The section of this area that is made of the images w1 and w2 of other axes: (w1, w2) = (a, b) V, det V = 1.
    /// `rests` are δ2 and δ3. Also returns w1 and w2.
    #[inline(always)]
    pub fn referred_to<A: Axes<R>>(
        &self,
        v: &Unimodular<R>,
        d: &Stretch<R>,
        [delta_2, delta_3]: [[R; 3]; 2],
        n: &A,
    ) -> (Self, [[R; 3]; 2]) {
        let (zero, half) = (R::splat(0.0), R::splat(0.5));
        let (a, b) = (n.shifted(delta_2, d.chi, 1), n.shifted(delta_3, d.chi, 2));
        // Near 1, V − 1 has digits that V has lost, and w_i − χ t_i = δ_i + (V − 1) a_i. Elsewhere V and a are
        // multiplied out.
        let chi = R::select(v.near_one, d.chi, zero);
        let kept = R::select(v.near_one, R::splat(1.0), zero);
        let [[v11, v12], [v21, v22]] = v.times;
        // After a far slip the two terms cancel.
        let rest_1 = along_both(scale(kept, delta_2), (v11, a), (v21, b));
        let rest_2 = along_both(scale(kept, delta_3), (v22, b), (v12, a));
        let w1 = Image { whole: n.shifted(rest_1, chi, 1), rest: rest_1 };
        let w2 = Image { whole: n.shifted(rest_2, chi, 2), rest: rest_2 };
        let Products { x22, x23, x23_square, sum, delta, .. } = Products::new(&w1, &w2, chi, n);
        let section = Section {
            delta,
            x23,
            x23_square,
            a_square: chi + x22,
            half_trace: half.mul_add(sum, chi),
            distortion: delta.mul_add(delta, x23_square).sqrt(),
            ..*self
        };
        (section, [w1.whole, w2.whole])
    }

    /// η = ½(a·a − b·b) + (a·b)²/(a·a), given 1/(a·a).
    #[inline(always)]
    pub fn deviator(&self, inverse_a_square: R) -> R {
        self.x23_square.mul_add(inverse_a_square, self.delta)
    }

    /// `factor` D̂a with D̂a = ½(a·a − b·b) a + (a·b) b.
    #[inline(always)]
    pub fn beside_a(&self, factor: R, [a, b]: [[R; 3]; 2]) -> [R; 3] {
        along(scale(factor * self.delta, a), factor * self.x23, b)
    }

    /// J_t and its reciprocal.
    #[inline(always)]
    pub fn area_ratio(&self) -> [R; 2] {
        let inverse = self.inverse_area_square.sqrt();
        [self.area_square * inverse, inverse]
    }
}

/// x_ij = a_i·a_j − χ δ_ij of the images a_2 and a_3 of two axes, and what follows from these: x23², x22 + x33 and
/// ½(x22 − x33).
struct Products<R> {
    x22: R,
    x33: R,
    x23: R,
    x23_square: R,
    sum: R,
    delta: R,
}

impl<R: Real> Products<R> {
    #[inline(always)]
    fn new<A: Axes<R>>(a: &Image<R>, b: &Image<R>, chi: R, n: &A) -> Self {
        let x22 = dot(a.rest, n.shifted(a.whole, chi, 1));
        let x33 = dot(b.rest, n.shifted(b.whole, chi, 2));
        let x23 = n.product(a, b, chi, 2);
        Products { x22, x33, x23, x23_square: x23 * x23, sum: x22 + x33, delta: R::splat(0.5) * (x22 - x33) }
    }
}

/// A 2×2 matrix V of determinant 1, one of whose entries off the diagonal is 0.
#[derive(Clone, Copy)]
pub struct Unimodular<R: Real> {
    /// Where V is near 1, V − 1; else V: by rows.
    pub times: [[R; 2]; 2],
    pub near_one: R::Mask,
}

impl<R: Real> Unimodular<R> {
    /// V.
    #[inline(always)]
    fn matrix(&self) -> [[R; 2]; 2] {
        let added = R::select(self.near_one, R::splat(1.0), R::splat(0.0));
        let [[v11, v12], [v21, v22]] = self.times;
        [[added + v11, v12], [v21, added + v22]]
    }
}

/// The third stage: the logarithms up to their last step.
#[derive(Clone, Copy)]
pub struct Logarithms<R: Real> {
    stretch: Logarithm<R>,
    area: Logarithm<R>,
    distortion: Asinh<R>,
    /// 0 where F is finite, has a positive determinant, and is neither too large nor too small for its strains to be
    /// computed, else NaN.
    pub nan_if_invalid: R,
}

impl<R: Real> Logarithms<R> {
    /// The distortion of the section as the deformation makes it, beside the logarithms of one that has slid; these are
    /// valid only where that is.
    #[inline(always)]
    pub fn beside(&mut self, whole: &Section<R>) -> Asinh<R> {
        let (distortion, growth) = Asinh::new(whole.distortion, whole.half_trace, whole.inverse_area_square);
        self.check_whole(whole, growth);
        distortion
    }

    #[inline(always)]
    fn check_whole(&mut self, whole: &Section<R>, growth: R) {
        let (least, most) = (R::splat(R::SQUARES.0), R::splat(R::SQUARES.1));
        let valid = least.lt(whole.a_square) & whole.half_trace.max(growth).lt(most);
        self.nan_if_invalid = R::select(valid, self.nan_if_invalid, R::splat(f64::NAN));
    }

    #[inline(always)]
    pub fn new(d: &Stretch<R>, section: &Section<R>) -> Self {
        let distortion = Asinh::new(section.distortion, section.half_trace, section.inverse_area_square);
        Self::with_distortion(d, section, distortion)
    }

    /// Of a section that has slid and, side by side with it, the distortion of the whole one, of the same area, in a
    /// number that has room for both: [`Strain::of_both`].
    #[inline(always)]
    pub fn of_both(d: &Stretch<R>, section: &Section<R>, whole: &Section<R>) -> Self {
        let s = section.distortion.pair(whole.distortion);
        let t = section.half_trace.pair(whole.half_trace);
        let (both, growth) = Asinh::new(s, t, section.inverse_area_square);
        let [growth, growth_of_whole] = growth.apart();
        let mut logarithms = Self::with_distortion(d, section, (both, growth));
        logarithms.check_whole(whole, growth_of_whole);
        logarithms
    }

    /// Given the distortion and its e^2a.
    #[inline(always)]
    fn with_distortion(d: &Stretch<R>, section: &Section<R>, (distortion, growth): (Asinh<R>, R)) -> Self {
        let (least, most) = (R::splat(R::SQUARES.0), R::splat(R::SQUARES.1));
        let (stretch, area) = (Logarithm::new(d.square), Logarithm::new(section.area_square));
        Logarithms {
            stretch,
            area,
            distortion,
            // A NaN in F makes `growth` NaN, and with it the largest value, in which `growth` comes last. If the three
            // images are almost parallel, a and b may vanish by cancellation although J does not. With a·a and `growth`
            // in range J_t² is a normal number.
            nan_if_invalid: R::select(
                least.lt(d.jacobian.min(d.square).min(section.a_square))
                    & d.square.max(section.half_trace).max(d.slip_square).max(growth).lt(most),
                R::splat(0.0),
                R::splat(f64::NAN),
            ),
        }
    }
}

/// The fourth stage: the invariants.
#[derive(Clone, Copy, Debug)]
pub struct Strain<R> {
    /// Elongation, compaction and distortion invariant (Eq. 4.9).
    pub i_el: R,
    pub i_tc: R,
    pub i_td: R,
    /// I_td/ŝ.
    pub distortion_ratio: R,
    /// 1/(a·a), for the stress.
    pub inverse_a_square: R,
    /// 0 where F is finite, has a positive determinant, and is neither too large nor too small for its strains to be
    /// computed, else NaN.
    pub nan_if_invalid: R,
}

impl<R: Real> Strain<R> {
    #[inline(always)]
    pub fn new(d: &Stretch<R>, section: &Section<R>, logarithms: &Logarithms<R>) -> Self {
        Self::with_distortion(d, section, logarithms, logarithms.distortion.finish())
    }

    /// From [`Logarithms::of_both`]. Also returns I_td of the whole section.
    #[inline(always)]
    pub fn of_both(d: &Stretch<R>, section: &Section<R>, logarithms: &Logarithms<R>) -> (Self, R) {
        let (both, ratios) = logarithms.distortion.finish();
        let ([i_td, whole], [ratio, _]) = (both.apart(), ratios.apart());
        (Self::with_distortion(d, section, logarithms, (i_td, ratio)), whole)
    }

    /// Given I_td and I_td/ŝ.
    #[inline(always)]
    fn with_distortion(
        d: &Stretch<R>,
        section: &Section<R>,
        l: &Logarithms<R>,
        (i_td, distortion_ratio): (R, R),
    ) -> Self {
        let [ln_stretch, ln_area] = if R::PAIRS {
            let over_both = d.inverse_square.pair(section.inverse_area_square);
            l.stretch.pair(&l.area).finish(d.rounding.pair(section.rounding), over_both).apart()
        } else {
            let area = l.area.finish(section.rounding, section.inverse_area_square);
            [l.stretch.finish(d.rounding, d.inverse_square), area]
        };
        Strain {
            i_el: R::splat(0.5) * ln_stretch,
            i_tc: R::splat(0.25) * ln_area,
            i_td,
            distortion_ratio,
            inverse_a_square: R::splat(1.0) / section.a_square,
            nan_if_invalid: l.nan_if_invalid,
        }
    }
}

/// The results of all stages for a point.
#[derive(Clone, Copy)]
pub struct Kinematics<'a, R: Real> {
    pub stretch: &'a Stretch<R>,
    pub section: &'a Section<R>,
    /// F m, a and b.
    pub images: [[R; 3]; 3],
    pub strain: &'a Strain<R>,
    /// Of a section whose fibres may have slid; section, a and b are then those of other axes, from which its
    /// distortion is computed.
    pub slid: Option<&'a Slid<'a, R>>,
}

/// What becomes of a section whose fibres have slid over one another.
#[derive(Clone, Copy)]
pub struct Slid<'a, R: Real> {
    /// The section as the deformation makes it, and its a and b.
    pub whole: &'a Section<R>,
    pub images: [[R; 3]; 2],
    /// V: the axes of which the images are w1 and w2 are (t1, t2) V.
    pub axes: Unimodular<R>,
    /// Where the fibres slide now, and µ.
    pub slides: R::Mask,
    pub mu: R,
}

impl<R: Real> Kinematics<'_, R> {
    /// `factor` λ h with λ h = h2 a + h3 b = λ Π F Fᵀ e, the direction of the longitudinal shear.
    #[inline(always)]
    pub fn slip(&self, factor: R) -> [R; 3] {
        let [_, a, b] = self.whole().images;
        along(scale(factor * self.stretch.h[0], a), factor * self.stretch.h[1], b)
    }
}

impl<'a, R: Real> Kinematics<'a, R> {
    /// The same with the section as the deformation makes it; its strain is not that of its distortion.
    #[inline(always)]
    pub fn whole(&self) -> Kinematics<'a, R> {
        match self.slid {
            Some(&Slid { whole, images: [a, b], .. }) => {
                Kinematics { section: whole, images: [self.images[0], a, b], slid: None, ..*self }
            }
            None => *self,
        }
    }

    /// The products of the fibre's image with those of the axes of which a and b are the images.
    #[inline(always)]
    pub(super) fn h(&self) -> [R; 2] {
        let [h2, h3] = self.stretch.h;
        match self.slid {
            Some(slid) => {
                let [[v11, v12], [v21, v22]] = slid.axes.matrix();
                [v11.mul_add(h2, v21 * h3), v12.mul_add(h2, v22 * h3)]
            }
            None => [h2, h3],
        }
    }

    /// The fibre and the axes of which a and b are the images, from the fibre's own.
    #[inline(always)]
    pub fn axes(&self, n: &FibreFrame<R>) -> FibreFrame<R> {
        match self.slid {
            Some(slid) => {
                let [[v11, v12], [v21, v22]] = slid.axes.matrix();
                FibreFrame { m: n.m, t1: along(scale(v11, n.t1), v21, n.t2), t2: along(scale(v22, n.t2), v12, n.t1) }
            }
            None => *n,
        }
    }
}

/// F N = Q R (thesis, Eq. 4.7): Q = (e, q1, q2) holds the current fibre direction and two axes across it, and
///
/// ```text
///     ⎡ λ  f_a  f_b ⎤
/// R = ⎢ 0  r11  r12 ⎥    J_t = r11 r22
///     ⎣ 0   0   r22 ⎦
/// ```
///
/// The deviator D of Π F Fᵀ Π over J_t has the components (D22, D23; D23, −D22) on (q1, q2), with √(D22² + D23²) = s =
/// sinh 2 I_td. The stress by mode and the wave speed need this decomposition; the stress itself does not.
#[derive(Clone, Copy, Debug)]
pub struct Decomposition<R> {
    pub e: [R; 3],
    pub q1: [R; 3],
    pub inverse_lambda: R,
    pub f_a: R,
    pub f_b: R,
    pub r11: R,
    pub r12: R,
    pub r22: R,
    /// det F.
    pub jacobian: R,
    pub area_ratio: R,
    pub d1: R,
    pub d2: R,
    /// sinh and cosh of 2 I_td.
    pub s: R,
    pub cosh: R,
}

impl<R: Real> Decomposition<R> {
    #[inline(always)]
    pub fn new(kinematics: Kinematics<'_, R>) -> Self {
        let Kinematics { stretch: d, section, images: [c1, a, _], .. } = kinematics;
        let one = R::splat(1.0);
        let lambda = d.square.sqrt();
        let r11 = section.a_square.sqrt();
        let (inverse_lambda, inverse_r11) = (one / lambda, one / r11);
        let [area_ratio, inverse_area] = section.area_ratio();
        let [h2, h3] = kinematics.h();
        let r12 = section.x23 * inverse_r11;
        Decomposition {
            e: scale(inverse_lambda, c1),
            q1: scale(inverse_r11, a),
            inverse_lambda,
            f_a: h2 * inverse_lambda,
            f_b: h3 * inverse_lambda,
            r11,
            r12,
            r22: area_ratio * inverse_r11,
            jacobian: d.jacobian,
            area_ratio,
            d1: r12.mul_add(r12, section.delta) * inverse_area,
            d2: r12 * inverse_r11,
            s: section.distortion * inverse_area,
            cosh: section.half_trace * inverse_area,
        }
    }

    /// The second axis across the fibre.
    #[inline(always)]
    pub fn q2(&self) -> [R; 3] {
        cross(self.e, self.q1)
    }

    /// F⁻¹e, F⁻¹q1, F⁻¹q2, by back substitution in the triangle R, without the inverse of F.
    #[inline(always)]
    pub fn pulled_back(&self, n: &FibreFrame<R>) -> [[R; 3]; 3] {
        let one = R::splat(1.0);
        let (inverse_11, inverse_22) = (one / self.r11, one / self.r22);
        let w1 = scale(self.inverse_lambda, n.m);
        let w2 = scale(inverse_11, along(n.t1, -(self.f_a * self.inverse_lambda), n.m));
        let w3 = scale(inverse_22, along(along(n.t2, -(self.f_b * self.inverse_lambda), n.m), -self.r12, w2));
        [w1, w2, w3]
    }
}
