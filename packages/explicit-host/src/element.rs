//! The one-point hexahedron, many side by side: deformation gradient, nodal forces, hourglass control.
//!
//! Everything refers to the reference placement, so that nothing is computed anew in a step but what depends on the
//! displacement. At an element's centre the gradient of a field is the sum of its nodal values, with the signs of ξ, η
//! and ζ, times the inverse Jacobian. For the prisms that yarns are meshed with that is the mean over the element,
//! which is what Flanagan and Belytschko take (Int. J. Numer. Meth. Eng. 17, 1981). Their four hourglass modes are the
//! sums with the signs of ξη, ηζ, ζξ and ξηζ, less what a linear field has in them; the elastic force against them is
//! theirs, with reference shapes: it vanishes in every rigid motion and uniform deformation, and has an energy.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use std::ops::{Add, Sub};

use super::lanes::{LANES, Lanes, Number, cross, dot, load};
use super::rows::Rows;
use super::sliding::SLIP;

/// The modes that are sums with the signs of one coordinate.
const LINEAR: [usize; 3] = [1, 2, 4];
/// Those with the signs of a product: ξη, ηζ, ζξ, ξηζ.
const HOURGLASS: [usize; 4] = [3, 6, 5, 7];
/// The lower corners of the four edges along each coordinate.
const EDGES: [(usize, [usize; 4]); 3] = [(1, [0, 2, 4, 6]), (2, [0, 1, 4, 5]), (4, [0, 1, 2, 3])];

/// Sums over the corners: entry k has the product of the signs of the coordinates that are the bits of k.
#[inline(always)]
fn modes<V: Copy + Add<Output = V> + Sub<Output = V>>(mut values: [V; 8]) -> [V; 8] {
    for axis in 0..3 {
        let (bit, lower) = EDGES[axis];
        for edge in 0..4 {
            let corner = lower[edge];
            let (low, high) = (values[corner], values[corner | bit]);
            values[corner] = low + high;
            values[corner | bit] = high - low;
        }
    }
    values
}

/// The transpose of [`modes`]: what every corner gets.
#[inline(always)]
fn corners<V: Copy + Add<Output = V> + Sub<Output = V>>(mut values: [V; 8]) -> [V; 8] {
    for axis in 0..3 {
        let (bit, lower) = EDGES[axis];
        for edge in 0..4 {
            let corner = lower[edge];
            let (even, odd) = (values[corner], values[corner | bit]);
            values[corner] = even - odd;
            values[corner | bit] = even + odd;
        }
    }
    values
}

/// A component of the displacement at the corners of neighbouring elements.
#[inline(always)]
fn gather<T: Number>(nodes: &[[u32; 8]], displacement: &[[T; 3]], component: usize) -> [Lanes<T>; 8] {
    let mut values = [Lanes::zero(); 8];
    for corner in 0..8 {
        for l in 0..LANES {
            values[corner].0[l] = displacement[nodes[l][corner] as usize][component];
        }
    }
    values
}

/// Rows of a block's constant data: ⅛ ∂ξ_k/∂X_j, entry k + 3j; mode α of X_j, entry α + 4j; reference volume; stiffness
/// against the hourglass modes; 8 Σ over corners of ∂N/∂X_i ∂N/∂X_j, 11 22 33 12 23 31: what the stable step needs.
const INVERSE: usize = 0;
const HOURGLASS_OF_X: usize = INVERSE + 9;
const VOLUME: usize = HOURGLASS_OF_X + 12;
const STIFFNESS: usize = VOLUME + 1;
const GRADIENTS: usize = STIFFNESS + 1;
const ROWS: usize = GRADIENTS + 6;

/// The components of what has six of them.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// The constant data of a block of elements: nodes and reference shapes.
#[derive(Clone, Debug)]
pub struct Shapes<T> {
    /// Elements, and the same rounded up to whole lanes; the surplus has no volume.
    pub n: usize,
    pub stride: usize,
    pub nodes: Vec<[u32; 8]>,
    constants: Rows<T>,
    /// 9 components by columns, or none where they are those of the unit matrix in all elements: the axes that X refers
    /// to, the fibre's first.
    axes: Rows<T>,
    /// The largest square of a frequency of the hourglass modes, times the density: by themselves, and what they add to
    /// others, since in a skewed element they resist a part of linear fields.
    pub hourglass_frequency: [f64; 2],
    /// How much lighter than by their volume corners are at most, where masses are shared otherwise.
    pub lightest: Option<f64>,
    /// No corner of an element has more than this part of the sum of what all of them resist alone: an eighth in a
    /// cuboid.
    pub corner_part: f64,
}

/// Unit vectors at right angles, the fibre's direction first and then, as nearly as that allows, the third axis.
fn axes_of(fibre: [f64; 3]) -> [[f64; 3]; 3] {
    let m = nalgebra::Vector3::from(fibre).normalize();
    // A fibre along the third axis has the second one beside it.
    let up = nalgebra::Vector3::ith(if m.z.abs() < 0.9 { 2 } else { 1 }, 1.0);
    let n = (up - up.dot(&m) * m).normalize();
    [m.into(), n.into(), m.cross(&n).into()]
}

/// The reference shape of one element.
struct Shape {
    inverse: [[f64; 3]; 3],
    hourglass: [[f64; 4]; 3],
    volume: f64,
    /// Σ over corners of ∂N/∂X_i ∂N/∂X_j.
    gradients: [f64; 6],
}

impl Shape {
    fn new(corners: [[f64; 3]; 8]) -> Shape {
        let sums: [[f64; 8]; 3] = [0, 1, 2].map(|j| modes(corners.map(|corner| corner[j])));
        let jacobian = nalgebra::Matrix3::from_fn(|j, k| sums[j][LINEAR[k]] / 8.0);
        let inverse = jacobian.try_inverse().unwrap_or_default();
        // Σ_a ξ_ka ξ_la = 8 δ_kl, and each gradient has a factor ⅛.
        let product = inverse.transpose() * inverse / 8.0;
        Shape {
            inverse: std::array::from_fn(|j| std::array::from_fn(|k| inverse[(k, j)] / 8.0)),
            hourglass: sums.map(|sum| HOURGLASS.map(|mode| sum[mode])),
            volume: 8.0 * jacobian.determinant(),
            gradients: PAIRS.map(|pair| product[pair]),
        }
    }

    /// ∂N/∂X of a corner.
    fn gradient(&self, corner: usize) -> [f64; 3] {
        let sign = |k: usize| if corner >> k & 1 == 1 { 1.0 } else { -1.0 };
        [0, 1, 2].map(|j| (0..3).map(|k| sign(k) * self.inverse[j][k]).sum())
    }

    /// Σ over the corners of the squares of what the hourglass modes shed of linear fields.
    fn shed_square(&self) -> f64 {
        let shed =
            |mode: usize, k: usize| -> f64 { (0..3).map(|j| self.hourglass[j][mode] * self.inverse[j][k]).sum() };
        8.0 * (0..4).flat_map(|mode| (0..3).map(move |k| shed(mode, k).powi(2))).sum::<f64>()
    }
}

impl<T: Number> Shapes<T> {
    /// A block of elements. `fibre` is its unit direction in each, or empty where that is axis 0 in all; `coordinates`
    /// are the nodes in the reference placement, `modulus` is what hourglass modes are held by.
    ///
    /// X is taken in axes of each element, of which the first is the fibre's: F then has the fibre's image as its first
    /// column, which is what the laws take for it, and differs from the usual one by a rotation of the reference
    /// placement, which they do not see otherwise.
    pub fn new(elements: &[[u32; 8]], fibre: &[[f64; 3]], coordinates: &[[f64; 3]], modulus: f64) -> Self {
        let (n, stride) = (elements.len(), elements.len().next_multiple_of(LANES));
        let mut block = Shapes {
            n,
            stride,
            nodes: elements.to_vec(),
            constants: Rows::new(ROWS, n),
            axes: Rows::new(9, fibre.len()),
            hourglass_frequency: [0.0; 2],
            lightest: None,
            corner_part: 0.125,
        };
        block.nodes.resize(stride, elements.first().copied().unwrap_or_default());
        for surplus in fibre.len()..block.axes.values.len() / 9 {
            [0, 4, 8].into_iter().for_each(|diagonal| block.axes.set(diagonal, surplus, T::from_f64(1.0)));
        }
        for (i, element) in elements.iter().enumerate() {
            let corners = element.map(|node| coordinates[node as usize]);
            let shape = match fibre.get(i) {
                Some(&fibre) => {
                    let axes = axes_of(fibre);
                    for (c, entry) in axes.as_flattened().iter().enumerate() {
                        block.axes.set(c, i, T::from_f64(*entry));
                    }
                    let along = |x: [f64; 3], axis: [f64; 3]| x[0] * axis[0] + x[1] * axis[1] + x[2] * axis[2];
                    Shape::new(corners.map(|x| axes.map(|axis| along(x, axis))))
                }
                None => Shape::new(corners),
            };
            for j in 0..3 {
                for k in 0..3 {
                    block.constants.set(INVERSE + k + 3 * j, i, T::from_f64(shape.inverse[j][k]));
                }
                for mode in 0..4 {
                    block.constants.set(HOURGLASS_OF_X + mode + 4 * j, i, T::from_f64(shape.hourglass[j][mode]));
                }
            }
            let trace: f64 = shape.gradients[..3].iter().sum();
            let parts = (0..8).map(|corner| shape.gradient(corner).iter().map(|part| part * part).sum::<f64>());
            block.corner_part = parts.map(|square| square / trace).fold(block.corner_part, f64::max);
            block.constants.set(VOLUME, i, T::from_f64(shape.volume));
            // Half the modulus times Σ|∇N|², as theirs; the modes are not normalised, hence the eighth.
            let stiffness = 0.5 * modulus * trace * shape.volume / 8.0;
            block.constants.set(STIFFNESS, i, T::from_f64(stiffness));
            // The modes are at right angles to linear fields but for what they shed; of two parts of a matrix that is
            // not negative, the largest eigenvalue is no larger than the larger one of theirs and what couples them.
            let (per_corner, shed) = (stiffness / (shape.volume / 8.0), shape.shed_square());
            let [own, shared] = [8.0 * per_corner, (shed + (8.0 * shed).sqrt()) * per_corner];
            let [most_own, most_shared] = block.hourglass_frequency;
            block.hourglass_frequency = [most_own.max(own), most_shared.max(shared)];
            for (c, sum) in shape.gradients.into_iter().enumerate() {
                block.constants.set(GRADIENTS + c, i, T::from_f64(8.0 * sum));
            }
        }
        block
    }

    /// F by columns before anything has moved, component-major.
    pub fn at_rest(&self) -> Vec<T> {
        let mut f = vec![T::default(); 9 * self.stride];
        for i in 0..self.stride {
            for c in 0..9 {
                let unit = T::from_f64(if c % 4 == 0 { 1.0 } else { 0.0 });
                f[c * self.stride + i] = if self.axes.is_empty() { unit } else { self.axes.number(c, i) };
            }
        }
        f
    }

    /// Reference volume.
    #[inline]
    pub fn volume(&self, element: usize) -> f64 {
        self.constants.number(VOLUME, element).into()
    }

    #[inline(always)]
    pub fn volumes(&self, first: usize) -> Lanes<T> {
        let [volume] = self.constants.at(VOLUME, first);
        volume
    }

    /// Length of an element along axis 0: for a prism of this axis, 8 Σ(∂N/∂X)² is 4 over its square.
    pub fn length(&self, element: usize) -> f64 {
        2.0 / self.constants.number(GRADIENTS, element).into().sqrt()
    }

    /// An eighth of the element's mass rests on each corner.
    pub fn corner_volume(&self, element: usize) -> f64 {
        self.volume(element) / 8.0
    }

    /// F by columns and the hourglass modes of the displacement, all elements. `slid` is the history of
    /// [sliding](super::sliding), or empty.
    #[inline(always)]
    pub fn deform(&self, displacement: &[[T; 3]], slid: &Rows<T>, f: &mut [T], modal: &mut [T]) {
        self.add_gradient(1.0, displacement, slid, f, modal);
    }

    /// The same of a motion: its gradient by X instead of F.
    #[inline(always)]
    pub fn gradient_of(&self, motion: &[[T; 3]], slid: &Rows<T>, gradient: &mut [T], modal: &mut [T]) {
        self.add_gradient(0.0, motion, slid, gradient, modal);
    }

    /// The gradient on top of this many times F at rest.
    #[inline(always)]
    fn add_gradient(&self, at_rest: f64, displacement: &[[T; 3]], slid: &Rows<T>, f: &mut [T], modal: &mut [T]) {
        let stride = self.stride;
        let (zero, unit) = (Lanes::zero(), Lanes::constant(at_rest));
        for group in 0..stride / LANES {
            let first = group * LANES;
            let nodes = &self.nodes[first..first + LANES];
            let b: [Lanes<T>; 9] = self.constants.at(INVERSE, first);
            let r: [Lanes<T>; 12] = self.constants.at(HOURGLASS_OF_X, first);
            let slip = self.slip(slid, first);
            let mut axes = [zero, zero, zero, zero, zero, zero, zero, zero, zero];
            if self.axes.is_empty() {
                (axes[0], axes[4], axes[8]) = (unit, unit, unit);
            } else if at_rest > 0.0 {
                axes = self.axes.at(0, first);
            }
            for i in 0..3 {
                let m = modes(gather(nodes, displacement, i));
                // The displacement's gradient, row i.
                let mut h = [Lanes::zero(); 3];
                for j in 0..3 {
                    h[j] = m[LINEAR[0]] * b[3 * j] + m[LINEAR[1]] * b[3 * j + 1] + m[LINEAR[2]] * b[3 * j + 2];
                    (axes[i + 3 * j] + h[j]).store(f, (i + 3 * j) * stride + first);
                }
                for mode in 0..4 {
                    let linear = h[0] * r[mode] + h[1] * r[mode + 4] + h[2] * r[mode + 8];
                    let mut amplitude = m[HOURGLASS[mode]] - linear;
                    if !slid.is_empty() {
                        for j in 0..3 {
                            amplitude = amplitude - (axes[i + 3 * j] + h[j]) * slip[mode + 4 * j];
                        }
                    }
                    amplitude.store(modal, (mode + 4 * i) * stride + first);
                }
            }
        }
    }

    /// Adds the elements' forces to the nodes', from P and the amplitudes of the hourglass modes, which only intact
    /// elements (1, others 0) hold.
    #[inline(always)]
    pub fn forces(&self, nominal: &[T], modal: &[T], intact: &[T], slid: &Rows<T>, forces: &mut [[T; 3]]) {
        let stride = self.stride;
        for group in 0..stride / LANES {
            let first = group * LANES;
            let p: [Lanes<T>; 9] = load(nominal, stride, first);
            let b: [Lanes<T>; 9] = self.constants.at(INVERSE, first);
            let mut r: [Lanes<T>; 12] = self.constants.at(HOURGLASS_OF_X, first);
            if !slid.is_empty() {
                let slip = self.slip(slid, first);
                for c in 0..12 {
                    r[c] = r[c] + slip[c];
                }
            }
            let [volume, stiffness] = self.constants.at(VOLUME, first);
            let [intact] = load(intact, stride, first);
            let k = stiffness * intact;
            let zero = Lanes::zero();
            let mut nodal = [[zero; 8]; 3];
            for i in 0..3 {
                let mut hourglass = [zero; 4];
                for mode in 0..4 {
                    hourglass[mode] = k * Lanes::at(modal, (mode + 4 * i) * stride + first);
                }
                let mut force = [zero; 3];
                for j in 0..3 {
                    // Less the forces on the linear part of the hourglass modes, which they must not resist.
                    let [xy, yz, zx, xyz] = hourglass;
                    let linear = xy * r[4 * j] + yz * r[4 * j + 1] + zx * r[4 * j + 2] + xyz * r[4 * j + 3];
                    let nominal = volume * p[i + 3 * j] - linear;
                    for m in 0..3 {
                        force[m] = force[m] + nominal * b[3 * j + m];
                    }
                }
                let ([xy, yz, zx, xyz], [x, y, z]) = (hourglass, force);
                nodal[i] = corners([zero, x, y, xy, z, zx, yz, xyz]);
            }
            self.scatter(&nodal, first, forces);
        }
    }

    /// What the hourglass modes of the reference placement have slid by; 0 where nothing slides.
    #[inline(always)]
    fn slip(&self, slid: &Rows<T>, first: usize) -> [Lanes<T>; 12] {
        if slid.is_empty() { [Lanes::zero(); 12] } else { slid.at(SLIP, first) }
    }

    /// What hourglass modes resist of linear fields once they have slid: the second of `hourglass_frequency`, over
    /// the stiffness by volume.
    #[inline(always)]
    pub fn shed(&self, slip: &[Lanes<T>; 12], first: usize) -> Lanes<T> {
        let b: [Lanes<T>; 9] = self.constants.at(INVERSE, first);
        let r: [Lanes<T>; 12] = self.constants.at(HOURGLASS_OF_X, first);
        let (eight, mut sum) = (Lanes::constant(8.0), Lanes::zero());
        for mode in 0..4 {
            for k in 0..3 {
                let mut shed = Lanes::zero();
                for j in 0..3 {
                    shed = shed + (r[mode + 4 * j] + slip[mode + 4 * j]) * b[3 * j + k];
                }
                sum = sum + shed * shed;
            }
        }
        let shed = eight * sum;
        eight * (shed + (eight * shed).sqrt())
    }

    /// The stiffness against the hourglass modes over the volume.
    #[inline(always)]
    pub fn stiffness_by_volume(&self, first: usize) -> Lanes<T> {
        let [volume, stiffness] = self.constants.at(VOLUME, first);
        stiffness / volume.max(Lanes::splat(T::from_f64(f64::from(f32::MIN_POSITIVE))))
    }

    /// In the order of the elements, so that a run repeats bit by bit.
    #[inline(always)]
    fn scatter(&self, nodal: &[[Lanes<T>; 8]; 3], first: usize, forces: &mut [[T; 3]]) {
        let last = if first + LANES < self.n { first + LANES } else { self.n };
        let nodes = &self.nodes[first..last];
        for l in 0..nodes.len() {
            for corner in 0..8 {
                let force = &mut forces[nodes[l][corner] as usize];
                for i in 0..3 {
                    force[i] -= nodal[i][corner].0[l];
                }
            }
        }
    }

    /// The measures of F that the stable step and viscosity need, all elements.
    #[inline(always)]
    pub fn measure(&self, f: &[T], to: &mut Measures<T>) {
        for group in 0..self.stride / LANES {
            let first = group * LANES;
            let [f0, f1, f2, f3, f4, f5, f6, f7, f8] = load(f, self.stride, first);
            let [u, v, w] = [[f0, f1, f2], [f3, f4, f5], [f6, f7, f8]];
            let [a, b, c] = [cross(v, w), cross(w, u), cross(u, v)];
            let (ratio, square) = (dot(u, a), dot(u, u));
            let [aa, bb, cc, ab, bc, ca] = self.constants.at(GRADIENTS, first);
            let [second, third, both] = [dot(c, c), dot(b, b), dot(b, c)];
            let (one, zero) = (Lanes::constant(1.0), Lanes::zero());
            let per_square = one / square;
            // Across the fibre: of the gradients of N that belong to the axes, a alone has a part along it.
            let (own, with_b, with_c) = ((dot(a, a) - ratio * ratio * per_square).max(zero), dot(a, b), dot(c, a));
            let p = [
                aa * own + ab * with_b + ca * with_c,
                aa * with_b + ab * third + ca * both,
                aa * with_c + ab * both + ca * second,
            ];
            let q = [
                ab * own + bb * with_b + bc * with_c,
                ab * with_b + bb * third + bc * both,
                ab * with_c + bb * both + bc * second,
            ];
            let r = [
                ca * own + bc * with_b + cc * with_c,
                ca * with_b + bc * third + cc * both,
                ca * with_c + bc * both + cc * second,
            ];
            let per_ratio = one / (ratio * ratio);
            let trace = (p[0] + q[1] + r[2]) * per_ratio;
            let mixed = p[1] * q[0] + q[2] * r[1] + r[0] * p[2];
            let squares = (p[0] * p[0] + q[1] * q[1] + r[2] * r[2] + mixed + mixed) * (per_ratio * per_ratio);
            let half = Lanes::constant(0.5);
            let area = half * (trace * trace - squares);
            ratio.store(&mut to.volume_ratio, first);
            square.store(&mut to.stretch_square, first);
            trace.store(&mut to.trace_across, first);
            area.max(zero).store(&mut to.area_across, first);
            (half * (trace + (squares + squares - trace * trace).max(zero).sqrt())).store(&mut to.spread_across, first);
            (aa * per_square).store(&mut to.spread_along, first);
            ((p[0] * aa + p[1] * ab + p[2] * ca) * per_square * per_ratio).max(zero).store(&mut to.slanting, first);
            let metric = [second, third, Lanes::zero() - both];
            for component in 0..3 {
                (metric[component] * per_square).store(&mut to.metric, component * self.stride + first);
            }
        }
    }

    /// Takes over how many times the corners of an element are heavier than by what they have of it.
    pub fn weigh(&mut self, element: usize, heavier: [f64; 8]) {
        let inverse = |j: usize, k: usize| -> f64 { self.constants.number(INVERSE + k + 3 * j, element).into() };
        let (mut sums, mut most): ([f64; 6], f64) = ([0.0; 6], 0.0);
        for (corner, heavier) in heavier.into_iter().enumerate() {
            let sign = |k: usize| if corner >> k & 1 == 1 { 1.0 } else { -1.0 };
            let gradient = [0, 1, 2].map(|j| (0..3).map(|k| sign(k) * inverse(j, k)).sum::<f64>());
            for (sum, (i, j)) in sums.iter_mut().zip(PAIRS) {
                *sum += gradient[i] * gradient[j] / heavier;
            }
            most = most.max(gradient.iter().map(|part| part * part).sum::<f64>() / heavier);
        }
        for (c, sum) in sums.into_iter().enumerate() {
            self.constants.set(GRADIENTS + c, element, T::from_f64(8.0 * sum));
        }
        self.corner_part = self.corner_part.max(most / (sums[0] + sums[1] + sums[2]));
        self.lightest = Some(heavier.into_iter().fold(self.lightest.unwrap_or(1.0), f64::min));
    }

    /// The energy in the hourglass modes of an element.
    pub fn hourglass_energy(&self, element: usize, modal: &[T]) -> f64 {
        let square = |c: usize| modal[c * self.stride + element].into().powi(2);
        0.5 * self.constants.number(STIFFNESS, element).into() * (0..12).map(square).sum::<f64>()
    }
}

/// Measures of F, one number per element unless stated otherwise.
#[derive(Clone, Debug)]
pub struct Measures<T> {
    /// J, and the square of the stretch along axis 0, where the fibres are.
    pub volume_ratio: Vec<T>,
    pub stretch_square: Vec<T>,
    /// Of S = 8 Σ ∇N ⊗ ∇N in the current placement, with ∇N = cof F ∂N/∂X / J and m·∇N = ∂N/∂X over the stretch: the
    /// square of the highest frequency over that of the wave speed is its largest eigenvalue. Its part along the fibre
    /// m·S m; the largest eigenvalue, trace and determinant of that across; and the square of what couples the two.
    pub spread_along: Vec<T>,
    pub spread_across: Vec<T>,
    pub trace_across: Vec<T>,
    pub area_across: Vec<T>,
    pub slanting: Vec<T>,
    /// 3: the section's metric, 22 33 23, the products of F's second and third column without their parts along the
    /// first. The cofactors of C have them, times the square of the stretch.
    pub metric: Vec<T>,
    /// The largest rates at which viscosity damps motions along the fibre and across it.
    pub damping_along: Vec<T>,
    pub damping_across: Vec<T>,
    /// The sum over the corners of that across, each alone.
    pub damping_at_corners: Vec<T>,
    /// 3: the kinematic viscosities along the fibre, and of the section in area and in shape.
    pub viscosities: Vec<T>,
}

impl<T: Number> Measures<T> {
    /// Of as many elements.
    pub fn new(stride: usize) -> Self {
        let array = |components: usize| vec![T::default(); components * stride];
        Measures {
            volume_ratio: array(1),
            stretch_square: array(1),
            spread_along: array(1),
            spread_across: array(1),
            trace_across: array(1),
            area_across: array(1),
            slanting: array(1),
            metric: array(3),
            damping_along: array(1),
            damping_across: array(1),
            damping_at_corners: array(1),
            viscosities: array(3),
        }
    }

    /// J of the active elements, those intact and not inverted, 0 for the others.
    #[inline(always)]
    pub fn active(&self, intact: &[T], first: usize) -> Lanes<T> {
        Lanes::at(&self.volume_ratio, first).max(Lanes::zero()).only_where(Lanes::at(intact, first))
    }
}

#[cfg(test)]
pub(super) mod tests;
