//! The axes that a deformation gradient is referred to: the coordinate axes, or a fibre direction and two axes across
//! it.

use super::kinematics::Stretch;
use super::number::real::Real;
use super::number::vector::{accurate_cross, along, dot, image, scale};

/// Three axes to which a deformation gradient is referred: the fibre direction and two across it, n1 = m, n2 = t1, n3 =
/// t2.
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

/// The image of an axis n: F n (`whole`) and (F − χ1) n (`rest`). Near the reference the latter has digits that F n has
/// lost.
#[derive(Clone, Copy)]
pub struct Image<R> {
    pub(super) whole: [R; 3],
    pub(super) rest: [R; 3],
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
        // Two axes across m, without a branch and without loss of digits for m near −x (Duff et al., J. Comput. Graph.
        // Tech. 6(1), 2017). For m along the first coordinate axis they are the other two coordinate axes. Their second
        // and third component are 1 − m2²/(1 + |m1|) and 1 − m3²/(1 + |m1|). With |m|² = 1 that of the larger of the
        // two squares is a sum of positive numbers, which keeps its digits for m near that axis, where the difference
        // cancels.
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
    /// From the images where J_t = J/λ keeps more digits so. The image of the fibre has an error of |F|/λ roundings,
    /// and so has λ. In J from the images that error is the same, and cancels in J/λ; there remains that of the other
    /// two images, at most |F|²/J_t. Else, and where the sign is in question, from the columns, which have no error. Of
    /// an image that is short beside F, whether the fibre is pressed or its section blown up, it makes the difference
    /// between all digits and none.
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

/// u·(v × w). With accurate minors it is as accurate as the entries allow; with ordinary ones it would lose most of its
/// digits if a section is sheared and compacted.
#[inline(always)]
fn triple_product<R: Real>([u, v, w]: [[R; 3]; 3]) -> R {
    dot(u, accurate_cross(v, w))
}
