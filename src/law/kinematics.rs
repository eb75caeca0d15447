//! The kinematics: from the deformation gradient to the four deformation modes and to the quantities that the stress needs,
//! without cancellation.
//!
//! With N = (m, t1, t2) the fibre and any two transverse axes, c_i = F n_i are the images of the axes. The fibre gives
//!
//! ```text
//! λ² = c1·c1            fibre stretch, I_el = ½ ln λ²
//! h_j = c1·c_j          longitudinal shear, I_ld = √(h2² + h3²)/λ²
//! ```
//!
//! and the parts of the other two images that are orthogonal to it, a = c2 − (h2/λ²) c1 and b = c3 − (h3/λ²) c1, make the
//! section:
//!
//! ```text
//! J_t² = (a·a)(b·b) − (a·b)²    area ratio, I_tc = ¼ ln J_t²
//! ŝ² = ¼(a·a − b·b)² + (a·b)²   distortion, I_td = ½ asinh(ŝ/J_t), with t̂ = ½(a·a + b·b) = √(ŝ² + J_t²)
//! ```
//!
//! The stress needs no inverse, no eigenvector, no quotient 0/0, and no root but that of ŝ².
//!
//! Near the reference the strains are differences of nearly equal numbers. There H = F − 1 is exact in floating point, and
//! C − 1 follows from H without cancellation; elsewhere the sums over F itself round best. One formula covers both,
//! C_ij = χ δ_ij + g_i·g_j + χ (n_i·g_j + n_j·g_i) with g_i = (F − χ1) n_i, for χ = 1 and χ = 0: the choice is a
//! number, not a branch. With δ2 = g2 − (h2/λ²) c1 the section has a = χ t1 + δ2 and x22 = a·a − χ = δ2·(a + χ t1),
//! and b and x33 follow in the same way from δ3.
//!
//! The computation has several stages ([`Stretch`], [`Section`], [`Logarithms`], [`Strain`]). A block evaluates each stage for
//! several points before the next one: within a stage the chain of dependent operations is short enough for the processor to
//! overlap points, and divisions and roots come at its end, where no operation of the stage waits for them.

use super::number::elementary::{Asinh, Logarithm};
use super::number::real::{Real, Single};
use super::number::vector::{accurate_cross, along, cross, dot, image, scale, select};

/// F is near the reference if every entry of its diagonal is above this by more than the sum of the squares of the others. F − 1
/// is exact from ½ on. With d the least entry of the diagonal, |F v| > (d − √(d − 0.6)) |v| ≥ 0.35 |v|: no direction is shortened so
/// far that its strain, computed from F − 1, would cancel with 1.
const NEAR_REFERENCE: f64 = 0.6;

/// Three axes to which a deformation gradient is referred: the fibre direction and two across it, n1 = m, n2 = t1, n3 = t2.
pub trait Axes<R: Real>: Copy {
    /// Whether these are the coordinate axes.
    const ALONG_COORDINATES: bool;
    /// What [`keep`](Self::keep) stores of the images of the axes; nothing if they are easily computed again from F.
    type Kept: Copy;
    /// Stores the images that [`Stretch::new`] has returned, for a later stage.
    fn keep(&self, images: [[R; 3]; 3]) -> Self::Kept;
    /// The images that [`Stretch::new`] has returned, from what was stored or from F.
    fn recall(&self, kept: &Self::Kept, f: &[[R; 3]; 3], d: &Stretch<R>) -> [[R; 3]; 3];
    /// The images of the axes under F.
    fn images(&self, f: &[[R; 3]; 3], chi: R) -> [Image<R>; 3];
    /// `v + s n`, n being the axis with the index `axis`, counted from 0.
    fn shifted(&self, v: [R; 3], s: R, axis: usize) -> [R; 3];
    /// det F, given the images of the axes, 1/λ² and |F|².
    fn determinant(&self, f: &[[R; 3]; 3], images: [[R; 3]; 3], inverse_square: R, norm_square: R) -> R;
    /// The scalar product of the images of two different axes; `y` is that of the axis with the index `axis`.
    fn product(&self, x: &Image<R>, y: &Image<R>, chi: R, axis: usize) -> R;
}

/// The image of an axis n: F n (`whole`) and (F − χ1) n (`rest`). Near the reference the latter has digits that F n has lost.
#[derive(Clone, Copy)]
pub struct Image<R> {
    whole: [R; 3],
    rest: [R; 3],
}

/// The coordinate axes, for a fibre along the first one.
#[derive(Clone, Copy, Debug)]
pub struct FirstAxis;

impl<R: Real> Axes<R> for FirstAxis {
    const ALONG_COORDINATES: bool = true;
    type Kept = ();
    #[inline(always)]
    fn keep(&self, _: [[R; 3]; 3]) {}
    #[inline(always)]
    fn recall(&self, (): &(), f: &[[R; 3]; 3], d: &Stretch<R>) -> [[R; 3]; 3] {
        let [m, t1, t2] = self.images(f, d.chi);
        [m.whole, t1.rest, t2.rest]
    }
    #[inline(always)]
    fn images(&self, f: &[[R; 3]; 3], chi: R) -> [Image<R>; 3] {
        // Near the reference these differences are exact; elsewhere χ is 0.
        let image = |axis: usize, column| Image { whole: column, rest: self.shifted(column, -chi, axis) };
        [image(0, f[0]), image(1, f[1]), image(2, f[2])]
    }
    #[inline(always)]
    fn shifted(&self, v: [R; 3], s: R, axis: usize) -> [R; 3] {
        match axis {
            0 => [v[0] + s, v[1], v[2]],
            1 => [v[0], v[1] + s, v[2]],
            _ => [v[0], v[1], v[2] + s],
        }
    }
    #[inline(always)]
    fn determinant(&self, f: &[[R; 3]; 3], _: [[R; 3]; 3], _: R, _: R) -> R {
        triple_product(*f)
    }
    #[inline(always)]
    fn product(&self, x: &Image<R>, y: &Image<R>, _: R, _: usize) -> R {
        // Each term has an off-diagonal entry as a factor, and so keeps all its digits.
        dot(x.whole, y.whole)
    }
}

/// The material frame: the fibre direction and two axes across it, orthonormal, right-handed.
#[derive(Clone, Copy, Debug)]
pub struct FibreFrame<R> {
    pub m: [R; 3],
    pub t1: [R; 3],
    pub t2: [R; 3],
}

impl<R: Real> FibreFrame<R> {
    /// The coordinate axes.
    #[inline(always)]
    pub fn first_axis() -> Self {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        FibreFrame { m: [one, zero, zero], t1: [zero, one, zero], t2: [zero, zero, one] }
    }

    /// The frame of a fibre direction of any length, and where that direction is usable: finite and not zero.
    #[inline(always)]
    pub fn new(direction: [R; 3]) -> (Self, R::Mask) {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let largest = direction[0].abs().max(direction[1].abs()).max(direction[2].abs());
        // A direction whose squared length would overflow or underflow is scaled to a length near 1.
        let ordinary = R::splat(1e-15).lt(largest) & largest.lt(R::splat(1e15));
        let scaling = R::select(ordinary, one, one / largest);
        let direction = scale(scaling, direction);
        let square = dot(direction, direction);
        let usable = zero.lt(square) & square.lt(R::splat(1e31));
        let length = R::select(usable, square, one).sqrt();
        let m = [direction[0] / length, direction[1] / length, direction[2] / length];
        // Two axes across m, without a branch and without loss of digits for m near −x (Duff et al., J. Comput. Graph. Tech.
        // 6(1), 2017). For m along the first coordinate axis they are the other two coordinate axes.
        // Their second and third component are 1 − m2²/(1 + |m1|) and 1 − m3²/(1 + |m1|). With |m|² = 1 that of the larger of the two
        // squares is a sum of positive numbers, which keeps its digits for m near that axis, where the difference cancels.
        let sign = R::select(m[0].lt(zero), -one, one);
        let size = m[0].abs();
        let a = one / (one + size);
        let b = m[1] * m[2] * a;
        let [square_2, square_3] = [m[1] * m[1], m[2] * m[2]];
        let (second, smaller) = (square_3.lt(square_2), square_2.min(square_3));
        let [difference, sum] = [(-smaller).mul_add(a, one), smaller.mul_add(a, size)];
        let [diagonal_2, diagonal_3] = [R::select(second, sum, difference), R::select(second, difference, sum)];
        let t1 = [-(sign * m[1]), diagonal_2, -b];
        let t2 = [-m[2], -(sign * b), sign * diagonal_3];
        (FibreFrame { m, t1, t2 }, usable)
    }

    #[inline(always)]
    fn axis(&self, axis: usize) -> [R; 3] {
        match axis {
            0 => self.m,
            1 => self.t1,
            _ => self.t2,
        }
    }
}

impl<R: Real> Axes<R> for FibreFrame<R> {
    const ALONG_COORDINATES: bool = false;
    type Kept = [[R; 3]; 3];
    #[inline(always)]
    fn keep(&self, images: [[R; 3]; 3]) -> Self::Kept {
        images
    }
    #[inline(always)]
    fn recall(&self, kept: &Self::Kept, _: &[[R; 3]; 3], _: &Stretch<R>) -> [[R; 3]; 3] {
        *kept
    }
    #[inline(always)]
    fn images(&self, f: &[[R; 3]; 3], chi: R) -> [Image<R>; 3] {
        let columns =
            [[f[0][0] - chi, f[0][1], f[0][2]], [f[1][0], f[1][1] - chi, f[1][2]], [f[2][0], f[2][1], f[2][2] - chi]];
        let image = |axis: usize, n| {
            let rest = image(&columns, n);
            Image { whole: self.shifted(rest, chi, axis), rest }
        };
        [image(0, self.m), image(1, self.t1), image(2, self.t2)]
    }
    #[inline(always)]
    fn shifted(&self, v: [R; 3], s: R, axis: usize) -> [R; 3] {
        along(v, s, self.axis(axis))
    }
    /// From the images where J_t = J/λ keeps more digits so. The image of the fibre has an error of |F|/λ roundings, and so has λ.
    /// In J from the images that error is the same, and cancels in J/λ; there remains that of the other two images, at most
    /// |F|²/J_t. Else, and where the sign is in question, from the columns, which have no error. Of an image that is short beside
    /// F, whether the fibre is pressed or its section blown up, it makes the difference between all digits and none.
    #[inline(always)]
    fn determinant(&self, f: &[[R; 3]; 3], images: [[R; 3]; 3], inverse_square: R, norm_square: R) -> R {
        let (columns, images) = (triple_product(*f), triple_product(images));
        // Negative where the determinant of the images is.
        let area_over_stretch = images * inverse_square;
        let better = norm_square.lt(area_over_stretch * area_over_stretch.abs());
        R::select(better & R::splat(0.0).lt(columns), images, columns)
    }
    #[inline(always)]
    fn product(&self, x: &Image<R>, y: &Image<R>, chi: R, axis: usize) -> R {
        chi.mul_add(dot(self.axis(axis), x.rest), dot(x.whole, y.rest))
    }
}

/// u·(v × w). With accurate minors it is as accurate as the entries allow; with ordinary ones it would lose most of its digits if a
/// section is sheared and compacted.
#[inline(always)]
fn triple_product<R: Real>([u, v, w]: [[R; 3]; 3]) -> R {
    dot(u, accurate_cross(v, w))
}

/// The first stage: determinant, fibre stretch and longitudinal shear.
#[derive(Clone, Copy)]
pub struct Stretch<R: Real> {
    /// 1 near the reference, else 0.
    chi: R,
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
    /// From `f` (columns of F) and the material axes. Also returns F m, (F − χ1) t1 and (F − χ1) t2, from which the section is
    /// computed.
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
/// Its deviator D̂ = a⊗a + b⊗b − t̂ P is computed as (a⊗v + v⊗a)/(a·a) − d̂ P, with [`deviator`](Self::deviator) for d̂ and
/// [`beside_a`](Self::beside_a) for v, whose terms are all as small as ŝ: it keeps its digits if the section is hardly distorted.
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

/// The fibres have slipped far where the square of their slip, (h2² + h3²)/λ², is above this times J_t²/t̂. That is once to twice the
/// square of the section's shorter half axis, and each half axis of slip costs about a rounding.
const FAR_SLIP: f64 = 4.0;

impl<R: Real> Section<R> {
    /// From F m, (F − χ1) t1 and (F − χ1) t2. Also returns a and b, the images of the transverse axes without their components
    /// along the image of the fibre.
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

    /// As [`new`](Self::new), with a and b made orthogonal to the fibre once more where `far` holds: of their components along it
    /// the rounding of (h/λ²) c1 is left, as many roundings of a as the slip is longer than a. The other lanes keep their bits.
    #[inline(always)]
    pub fn orthogonal<A: Axes<R>>(d: &Stretch<R>, images: [[R; 3]; 3], n: &A, far: R::Mask) -> (Self, [[R; 3]; 2]) {
        let c1 = images[0];
        let [delta_2, delta_3] = Self::rests(d, images);
        let left_2 = dot(c1, n.shifted(delta_2, d.chi, 1)) * d.inverse_square;
        let left_3 = dot(c1, n.shifted(delta_3, d.chi, 2)) * d.inverse_square;
        let again_2 = select(far, along(delta_2, -left_2, c1), delta_2);
        let again_3 = select(far, along(delta_3, -left_3, c1), delta_3);
        Self::from_rests(d, [again_2, again_3], n)
    }

    /// δ2 = a − χ t1 and δ3 = b − χ t2.
    #[inline(always)]
    fn rests(d: &Stretch<R>, [c1, g2, g3]: [[R; 3]; 3]) -> [[R; 3]; 2] {
        [along(g2, -(d.h[0] * d.inverse_square), c1), along(g3, -(d.h[1] * d.inverse_square), c1)]
    }

    #[inline(always)]
    fn from_rests<A: Axes<R>>(d: &Stretch<R>, [delta_2, delta_3]: [[R; 3]; 2], n: &A) -> (Self, [[R; 3]; 2]) {
        let (one, half) = (R::splat(1.0), R::splat(0.5));
        let a = Image { whole: n.shifted(delta_2, d.chi, 1), rest: delta_2 };
        let b = Image { whole: n.shifted(delta_3, d.chi, 2), rest: delta_3 };

        // x_ij = a_i·a_j − χ δ_ij for a_2 = a, a_3 = b.
        let x22 = dot(a.rest, n.shifted(a.whole, d.chi, 1));
        let x33 = dot(b.rest, n.shifted(b.whole, d.chi, 2));
        let x23 = n.product(&a, &b, d.chi, 2);
        let (x23_square, sum, delta) = (x23 * x23, x22 + x33, half * (x22 - x33));

        // Where the section is near the reference, J_t² − 1 has more correct digits than J. With χ = 0 `near` never holds.
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

    /// d̂ = ½(a·a − b·b) + (a·b)²/(a·a), given 1/(a·a).
    #[inline(always)]
    pub fn deviator(&self, inverse_a_square: R) -> R {
        self.x23_square.mul_add(inverse_a_square, self.delta)
    }

    /// `factor` v with v = ½(a·a − b·b) a + (a·b) b.
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

/// The third stage: the logarithms up to their last step.
#[derive(Clone, Copy)]
pub struct Logarithms<R: Real> {
    stretch: Logarithm<R>,
    area: Logarithm<R>,
    distortion: Asinh<R>,
    /// 0 where F is finite, has a positive determinant, and is neither too large nor too small for its strains to be computed,
    /// else NaN.
    pub nan_if_invalid: R,
}

impl<R: Real> Logarithms<R> {
    #[inline(always)]
    pub fn new(d: &Stretch<R>, section: &Section<R>) -> Self {
        let (least, most) = (R::splat(R::SQUARES.0), R::splat(R::SQUARES.1));
        let (stretch, area) = (Logarithm::new(d.square), Logarithm::new(section.area_square));
        let (distortion, growth) = Asinh::new(section.distortion, section.half_trace, section.inverse_area_square);
        Logarithms {
            stretch,
            area,
            distortion,
            // A NaN in F makes `growth` NaN, and with it the largest value, in which `growth` comes last. If the three images
            // are almost parallel, a and b may vanish by cancellation although J does not. With a·a and `growth` in range J_t²
            // is a normal number.
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
    /// 0 where F is finite, has a positive determinant, and is neither too large nor too small for its strains to be computed,
    /// else NaN.
    pub nan_if_invalid: R,
}

impl<R: Real> Strain<R> {
    #[inline(always)]
    pub fn new(d: &Stretch<R>, section: &Section<R>, logarithms: &Logarithms<R>) -> Self {
        let l = logarithms;
        let [ln_stretch, ln_area] = if R::PAIRS {
            let over_both = d.inverse_square.pair(section.inverse_area_square);
            l.stretch.pair(&l.area).finish(d.rounding.pair(section.rounding), over_both).apart()
        } else {
            let area = l.area.finish(section.rounding, section.inverse_area_square);
            [l.stretch.finish(d.rounding, d.inverse_square), area]
        };
        let (i_td, distortion_ratio) = l.distortion.finish();
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
}

impl<R: Real> Kinematics<'_, R> {
    /// `factor` u with u = h2 a + h3 b = λ P F Fᵀ e, the direction of the longitudinal shear.
    #[inline(always)]
    pub fn slip(&self, factor: R) -> [R; 3] {
        let [_, a, b] = self.images;
        along(scale(factor * self.stretch.h[0], a), factor * self.stretch.h[1], b)
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
/// The deviator of B = P F Fᵀ P over J_t has the components (d1, d2; d2, −d1) on (q1, q2), with √(d1² + d2²) = s = sinh 2 I_td.
/// The stress by mode and the wave speed need this decomposition; the stress itself does not.
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
        let r12 = section.x23 * inverse_r11;
        Decomposition {
            e: scale(inverse_lambda, c1),
            q1: scale(inverse_r11, a),
            inverse_lambda,
            f_a: d.h[0] * inverse_lambda,
            f_b: d.h[1] * inverse_lambda,
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
