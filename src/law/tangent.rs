//! The tangents of the yarn law, in closed form.
//!
//! In the current frame (e, q1, q2) most entries of the Truesdell modulus of τ vanish. With Λ = e⊗e, Π = 1 − Λ, the
//! deviator D of the section, X⊙Z = X_ik Z_jl + X_il Z_jk + X_jk Z_il + X_jl Z_ik, and the factors of `Factors`, it is
//! (derivation in `docs/reference/theory.md`)
//!
//! ```text
//! 𝕔 = A_el Λ⊗Λ + (¼ W″ − x W1) Π⊗Π + W2 D⊗D + Π⊙Y + Λ⊙(Y_e − τ_ld)
//! Y = ½ (p_t + x W1) Π − ½ W1 D,      Y_e = (p_t + κ J_t x) Π − (W1 − κ J_t) D
//! ```
//!
//! For the spatial moduli Π is replaced by 1 − Λ, since products with 1 are sparse; Λ⊗Λ = ¼ Λ⊙Λ, and a product Λ⊙Z
//! needs only e_k Z_jl + e_l Z_jk. The Jaumann modulus, 𝕔 + ½ 1⊙τ, differs only in Y, which becomes ½ x W1 Π + ½ τ_el +
//! ½ τ_ld.
//!
//! dS/dE has the same few components in the basis F⁻¹c = m, F⁻¹a, F⁻¹b', each divided by the length of c, a or b',
//! where c, a and b' are orthogonal (`Orthogonal`). There is no quotient 0/0, and the moduli are symmetric by
//! construction: only the upper triangle is computed.

use super::axes::FibreFrame;
use super::hyperelastic::Deformed;
use super::kinematics::{Kinematics, Section, Slid, Stretch};
use super::number::real::Real;
use super::number::vector::{along, cross, dot, image, scale};
use super::voigt::{
    Moduli, PAIRS, VOIGT, added, combination, multiple, paired_with_one, square, symmetric_product, upper_triangle,
};

/// Which tangent: the stress that is differentiated, and the strain or rate. Rows and columns of the 6×6 are 11 22 33
/// 12 23 31, its columns engineering shears.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// dS/dE, 6×6: derivative of the second Piola–Kirchhoff stress with respect to the Green–Lagrange strain, in
    /// reference axes.
    Material,
    /// The Truesdell modulus of σ, 6×6: dS/dE pushed forward and divided by J. LS-DYNA's `utan`.
    Truesdell,
    /// The modulus of the Jaumann rate of τ, divided by J, 6×6: Abaqus's DDSDDE.
    #[default]
    Jaumann,
    /// dP/dF, 9×9: derivative of the first Piola–Kirchhoff stress with respect to the deformation gradient, both by
    /// columns 11 21 31 12 22 32 13 23 33.
    Nominal,
}

impl Measure {
    /// The number of rows, which is that of columns.
    pub(crate) const fn size(self) -> usize {
        match self {
            Measure::Nominal => 9,
            _ => 6,
        }
    }

    /// The number of entries of the full matrix.
    pub const fn components(self) -> usize {
        self.size() * self.size()
    }
}

/// The factors of the modulus, all divided by J for a modulus of σ, by 1 for one of τ or S.
struct Factors<R> {
    /// A_el = k_el (1 − 2 I_el) in tension, I_el = 0 included.
    elongation: R,
    /// ¼ W″, with the compaction's curvature; p_t.
    compaction: R,
    pressure: R,
    /// W1 = (k_td/4) θ/s with θ = 2 I_td; x W1; W2 = (k_td/4)(1 − x θ/s)/s².
    distortion: R,
    stiffness: R,
    curvature: R,
    /// Tension k_el⟨I_el⟩.
    tension: R,
    /// κ J_t with κ = k_ld/λ².
    shear: R,
}

/// The section's shape: J_t and its reciprocal, x = cosh 2 I_td, s = sinh 2 I_td.
#[derive(Clone, Copy)]
pub(crate) struct Shape<R> {
    area_ratio: R,
    pub(super) inverse_area_ratio: R,
    cosh: R,
    pub(super) s: R,
}

impl<R: Real> Shape<R> {
    #[inline(always)]
    pub(super) fn new(section: &Section<R>) -> Self {
        let [area_ratio, inverse_area_ratio] = section.area_ratio();
        Shape {
            area_ratio,
            inverse_area_ratio,
            cosh: section.half_trace * inverse_area_ratio,
            s: section.distortion * inverse_area_ratio,
        }
    }
}

/// The quantities from which spatial moduli are computed; tensors as 11 22 33 12 23 31.
#[derive(Clone, Copy)]
pub(crate) struct Bases<R> {
    shape: Shape<R>,
    inverse_lambda: R,
    /// e, Λ = e⊗e and D.
    fibre: [R; 3],
    pub(super) e: [R; 6],
    pub(super) d: [R; 6],
}

impl<R: Real> Bases<R> {
    #[inline(always)]
    pub(super) fn new(d: &Stretch<R>, section: &Section<R>, [c, a, b]: &[[R; 3]; 3]) -> Self {
        let shape = Shape::new(section);
        // With a division e is a coordinate axis, up to the rounding of λ², if c is along one.
        let inverse_lambda = R::splat(1.0) / d.square.sqrt();
        let fibre = scale(inverse_lambda, *c);
        let e = square(R::splat(1.0), fibre);
        // D = a⊗v + v⊗a − d1 Π.
        let inverse_a_square = R::splat(1.0) / section.a_square;
        let share = inverse_a_square * shape.inverse_area_ratio;
        let d1 = section.deviator(inverse_a_square) * shape.inverse_area_ratio;
        let v = section.beside_a(share, [*a, *b]);
        let d = [
            a[0].mul_add(v[0], a[0].mul_add(v[0], d1.mul_add(e[0], -d1))),
            a[1].mul_add(v[1], a[1].mul_add(v[1], d1.mul_add(e[1], -d1))),
            a[2].mul_add(v[2], a[2].mul_add(v[2], d1.mul_add(e[2], -d1))),
            a[0].mul_add(v[1], a[1].mul_add(v[0], d1 * e[3])),
            a[1].mul_add(v[2], a[2].mul_add(v[1], d1 * e[4])),
            a[2].mul_add(v[0], a[0].mul_add(v[2], d1 * e[5])),
        ];
        Bases { shape, inverse_lambda, fibre, e, d }
    }
}

/// The terms of the spatial moduli, Π⊗(w Π) + D⊗(W2 D) + Λ⊙Z + 1⊙S.
struct Terms<'a, R> {
    bases: &'a Bases<R>,
    /// The diagonals of Π and of w Π.
    p: [R; 3],
    with_p: [R; 3],
    /// −w Λ, which is w Π off the diagonal.
    sheared: [R; 6],
    /// W2 D.
    with_d: [R; 6],
    /// [`along_fibre`] of Z.
    with_fibre: [[R; 6]; 3],
    /// S.
    with_one: [R; 6],
}

/// An entry of the spatial moduli.
#[inline(always)]
fn entry<R: Real, const ROW: usize, const COLUMN: usize>(t: &Terms<R>) -> R {
    let Bases { fibre, e, d, .. } = t.bases;
    // Π⊗(w Π); off the diagonal Π is −Λ.
    let (factor, other) = if COLUMN < 3 {
        (t.with_p[ROW], t.p[COLUMN])
    } else if ROW < 3 {
        (t.p[ROW], t.sheared[COLUMN])
    } else {
        (-t.sheared[ROW], e[COLUMN])
    };
    let across = match paired_with_one::<R, ROW, COLUMN>(&t.with_one) {
        Some(one) => factor.mul_add(other, one),
        None => factor * other,
    };
    let sum = d[ROW].mul_add(t.with_d[COLUMN], across);
    paired_along::<R, ROW, COLUMN>(*fibre, &t.with_fibre, sum)
}

impl<R: Real> Deformed<'_, R> {
    /// The factors of the modulus, each multiplied by `over`: 1/J for a modulus of σ, 1 for one of τ or S.
    #[inline(always)]
    fn factors(self, shape: &Shape<R>, over: R) -> Factors<R> {
        let Deformed { law, kinematics, k, .. } = self;
        let strain = kinematics.strain;
        let (zero, one, quarter) = (R::splat(0.0), R::splat(1.0), R::splat(0.25));
        let (_, curvature) = law.compaction_slopes(strain, k);
        // W2 D⊗D = (D/s)⊗(D/s)(k_td/4)(1 − x θ/s). The bracket has an error of a few roundings of 1, and D/s has unit
        // size: no series is needed near s = 0, only a divisor that is not 0. Where s² is below a rounding of 1, this
        // term is below a rounding of that with W1.
        let square = (shape.s * shape.s).max(R::splat(R::EPSILON));
        // θ/s and x θ/s.
        let ratio = R::splat(2.0) * strain.distortion_ratio * shape.area_ratio;
        let stiffness = shape.cosh * ratio;
        // Where the fibres slide, q is what friction holds, and does not grow with the distortion.
        let held = match kinematics.slid {
            Some(&Slid { slides, .. }) => R::select(slides, zero, one),
            None => one,
        };
        let distortion = quarter * law.k_td * over;
        let elongation = law.k_el * (one - R::splat(2.0) * strain.i_el);
        Factors {
            elongation: R::select(zero.le(strain.i_el), elongation, zero) * over,
            compaction: quarter * curvature * over,
            pressure: k.pressure * over,
            distortion: distortion * ratio,
            stiffness: distortion * stiffness,
            curvature: distortion * ((held - stiffness) / square),
            tension: k.tension * over,
            shear: k.shear * shape.area_ratio * over,
        }
    }

    /// The Truesdell modulus of σ or the Jaumann modulus of τ over J.
    #[inline(always)]
    fn spatial_tangent(self, bases: &Bases<R>, measure: Measure) -> Moduli<R> {
        let Deformed { kinematics, k, shear, .. } = self;
        let (half, quarter) = (R::splat(0.5), R::splat(0.25));
        let over = kinematics.stretch.inverse_jacobian;
        let f = self.factors(&bases.shape, over);
        // Y = y_p Π − y_d D, Y_e − Y = g_p Π + g_d D. No term is a difference of larger ones, so that the stiffness of
        // a slack fibre is 0 but for roundings of the other terms.
        let (y_p, y_d) = (half * (f.pressure + f.stiffness), half * f.distortion);
        let g_p = f.shear.mul_add(bases.shape.cosh, f.pressure - y_p);
        let g_d = f.shear + y_d - f.distortion;
        let Bases { e, d, .. } = &bases;
        let one = R::splat(1.0);
        let p = [one - e[0], one - e[1], one - e[2]];
        let along = combination(quarter * f.elongation, e, g_d, d);
        let mut with_fibre = [
            g_p.mul_add(p[0], along[0]),
            g_p.mul_add(p[1], along[1]),
            g_p.mul_add(p[2], along[2]),
            (-g_p).mul_add(e[3], along[3]),
            (-g_p).mul_add(e[4], along[4]),
            (-g_p).mul_add(e[5], along[5]),
        ];
        let on_p = if measure == Measure::Jaumann { half * f.stiffness } else { y_p };
        let on_e = if measure == Measure::Jaumann { half.mul_add(f.tension, -on_p) } else { -on_p };
        let mut with_one = multiple(on_e, e);
        for diagonal in with_one.iter_mut().take(3) {
            *diagonal += on_p;
        }
        if measure != Measure::Jaumann {
            with_one = added(&with_one, -y_d, d);
        }
        if shear {
            // τ_ld/J.
            let slip = kinematics.slip(k.shear * over * bases.inverse_lambda);
            let slip = symmetric_product(R::splat(2.0), bases.fibre, slip);
            with_fibre = added(&with_fibre, R::splat(-1.0), &slip);
            if measure == Measure::Jaumann {
                with_one = added(&with_one, half, &slip);
            }
        }
        let w = f.compaction - f.stiffness;
        let terms = Terms {
            bases,
            p,
            with_p: [w * p[0], w * p[1], w * p[2]],
            sheared: multiple(-w, e),
            with_d: multiple(f.curvature, d),
            with_fibre: along_fibre(bases.fibre, &with_fibre),
            with_one,
        };
        Moduli(upper_triangle!(entry(&terms)))
    }

    /// The tangent of a 6×6 measure, dS/dE for [`Measure::Nominal`], whose 9×9 tangent is
    /// [`nominal_tangent`](Self::nominal_tangent). `n` are the axes of the fibre; `along_coordinates` says whether
    /// these are the coordinate axes. `bases` may have been computed before.
    #[inline(always)]
    pub fn moduli(
        self,
        n: &FibreFrame<R>,
        along_coordinates: bool,
        measure: Measure,
        bases: Option<Bases<R>>,
    ) -> Moduli<R> {
        let Deformed { kinematics, shear, .. } = self;
        let Kinematics { stretch, section, images, .. } = kinematics;
        match measure {
            Measure::Material | Measure::Nominal => {
                let components = FibreComponents::new(self, &Shape::new(section));
                match along_coordinates {
                    true => components.in_fibre_axes(shear),
                    false => components.in_reference_axes(&kinematics.axes(n), shear),
                }
            }
            Measure::Truesdell | Measure::Jaumann => {
                let bases = match bases {
                    Some(bases) => bases,
                    None => Bases::new(stretch, section, &images),
                };
                self.spatial_tangent(&bases, measure)
            }
        }
    }

    /// The rows of F⁻¹. It takes c to m, a to α and b' to β, so that they follow from these and the dual vectors of c,
    /// a and b'.
    #[inline(always)]
    pub(super) fn inverse(self, n: &FibreFrame<R>) -> [[R; 3]; 3] {
        let Kinematics { stretch, images, .. } = self.kinematics;
        let basis = Orthogonal::new(self.kinematics);
        let [m, alpha, beta] = basis.pulled_back(&self.kinematics.axes(n));
        let [c1, a, _] = images;
        // The third dual vector, b'/(b'·b'), is c × a over J, which involves no cancellation.
        let duals =
            [scale(stretch.inverse_square, c1), scale(basis.over_a, a), scale(stretch.inverse_jacobian, cross(c1, a))];
        [
            image(&duals, [m[0], alpha[0], beta[0]]),
            image(&duals, [m[1], alpha[1], beta[1]]),
            image(&duals, [m[2], alpha[2], beta[2]]),
        ]
    }

    /// dP/dF by columns of P and F: ∂P_iJ/∂F_kL = J F⁻¹_Jj (c_ijkl + δ_ik σ_jl) F⁻¹_Ll with the Truesdell modulus c of
    /// σ.
    #[inline(always)]
    pub fn nominal_tangent(self, n: &FibreFrame<R>) -> [R; 81] {
        let Deformed { law, kinematics, k, shear } = self;
        let Kinematics { stretch, section, images, .. } = kinematics;
        let zero = R::splat(0.0);
        let stress = law.cauchy(kinematics, k, zero.le(zero), shear);
        let bases = Bases::new(stretch, section, &images);
        let c = self.spatial_tangent(&bases, Measure::Truesdell).matrix();
        let inverse = self.inverse(n);
        let mut a = [R::splat(0.0); 81];
        for i in 0..3 {
            for k in i..3 {
                let row = |j: usize| {
                    let moduli = &c[VOIGT[i][j]];
                    let row = [moduli[VOIGT[k][0]], moduli[VOIGT[k][1]], moduli[VOIGT[k][2]]];
                    let stress = [stress[VOIGT[j][0]], stress[VOIGT[j][1]], stress[VOIGT[j][2]]];
                    if i == k { add(row, stress) } else { row }
                };
                let rows = [row(0), row(1), row(2)];
                for (big_l, last) in inverse.iter().enumerate() {
                    let half = scale(stretch.jacobian, [dot(rows[0], *last), dot(rows[1], *last), dot(rows[2], *last)]);
                    // For i = k the 3×3 block is symmetric, and half of it is computed.
                    for (big_j, first) in inverse.iter().enumerate().take(if i == k { big_l + 1 } else { 3 }) {
                        let entry = dot(*first, half);
                        a[(i + 3 * big_j) + 9 * (k + 3 * big_l)] = entry;
                        a[(k + 3 * big_l) + 9 * (i + 3 * big_j)] = entry;
                    }
                }
            }
        }
        a
    }
}

/// The orthogonal basis c, a and b' = b − (a·b)/(a·a) a made of the images of the axes, and its pull-back F⁻¹c, F⁻¹a,
/// F⁻¹b'.
pub(super) struct Orthogonal<R> {
    /// (a·b)/(a·a); h2/λ² and h3/λ²; 1/(a·a); 1/(b'·b').
    pub(super) shift: R,
    slip: [R; 2],
    pub(super) over_a: R,
    pub(super) over_b: R,
}

impl<R: Real> Orthogonal<R> {
    #[inline(always)]
    pub(super) fn new(kinematics: Kinematics<'_, R>) -> Self {
        let Kinematics { stretch: d, section, .. } = kinematics;
        let over_a = R::splat(1.0) / section.a_square;
        let [_, inverse_area_ratio] = section.area_ratio();
        let [h2, h3] = kinematics.h();
        Orthogonal {
            shift: section.x23 * over_a,
            slip: [h2 * d.inverse_square, h3 * d.inverse_square],
            over_a,
            over_b: section.a_square * inverse_area_ratio * inverse_area_ratio,
        }
    }

    /// m = F⁻¹c, α = F⁻¹a and β = F⁻¹b'.
    #[inline(always)]
    pub(super) fn pulled_back(&self, n: &FibreFrame<R>) -> [[R; 3]; 3] {
        let alpha = along(n.t1, -self.slip[0], n.m);
        let beta = along(along(n.t2, -self.slip[1], n.m), -self.shift, alpha);
        [n.m, alpha, beta]
    }
}

/// The nonzero components of dS/dE in the basis m, α, β that [`Orthogonal::pulled_back`] gives; index 1 is the fibre.
struct FibreComponents<R> {
    basis: Orthogonal<R>,
    c_1111: R,
    /// 12 12, 31 31 and 12 31.
    along: [R; 3],
    /// 11 12 and 11 31.
    slip: [R; 2],
    /// 22 22, 22 33, 22 23, 33 33, 33 23 and 23 23.
    across: [R; 6],
}

impl<R: Real> FibreComponents<R> {
    #[inline(always)]
    fn new(point: Deformed<'_, R>, shape: &Shape<R>) -> Self {
        let Deformed { kinematics, k, shear, .. } = point;
        let (zero, two) = (R::splat(0.0), R::splat(2.0));
        let Kinematics { stretch, section, .. } = kinematics;
        let f = point.factors(shape, R::splat(1.0));
        let basis = Orthogonal::new(kinematics);
        let Orthogonal { shift, over_a, over_b, .. } = basis;
        let over_area = shape.inverse_area_ratio;
        // D = d1 (q1⊗q1 − q2⊗q2) + d2 (q1⊗q2 + q2⊗q1).
        let (d1, d2) = (section.x23.mul_add(shift, section.delta) * over_area, shift);
        let over_square = stretch.inverse_square;
        let on_p = f.shear.mul_add(shape.cosh, f.pressure);
        let on_d = f.shear - f.distortion;
        let direct = two.mul_add(f.pressure, f.compaction + f.stiffness);
        let (twice, curved) = (two * f.distortion * d1, f.curvature * d1);
        let (second, third) = (over_a * over_area, over_b * over_area);
        let slip = if shear {
            let factor = R::splat(-2.0) * k.shear * over_square * over_square;
            [factor * stretch.h[1].mul_add(shift, stretch.h[0]), factor * stretch.h[1]]
        } else {
            [zero; 2]
        };
        FibreComponents {
            c_1111: f.elongation * over_square * over_square,
            along: [
                on_d.mul_add(d1, on_p) * over_square * over_a,
                (-on_d).mul_add(d1, on_p) * over_square * over_b,
                on_d * d2 * over_square * over_area,
            ],
            slip,
            across: [
                curved.mul_add(d1, direct - twice) * (over_a * over_a),
                (-curved).mul_add(d1, f.compaction - f.stiffness) * (over_area * over_area),
                (curved - f.distortion) * d2 * second,
                curved.mul_add(d1, direct + twice) * (over_b * over_b),
                (-curved - f.distortion) * d2 * third,
                (f.curvature * d2).mul_add(d2, f.pressure + f.stiffness) * (over_area * over_area),
            ],
            basis,
        }
    }

    /// The moduli in the axes of the fibre, m, t1 and t2, by two shears of the basis: F⁻¹a = t1 − y m,
    /// F⁻¹b' = t2 − z m − u F⁻¹a.
    #[inline(always)]
    fn in_fibre_axes(&self, shear: bool) -> Moduli<R> {
        let zero = R::splat(0.0);
        let Orthogonal { shift, slip, .. } = self.basis;
        let [y, z] = slip;
        // From the basis with F⁻¹b' to the one with F⁻¹b = t2 − z m: the columns, then the rows.
        let [c_2222, c_2233, c_2223, c_3333, c_3323, c_2323] = self.across;
        let (r22, r33, r23) = (
            apply_shift([c_2222, c_2233, c_2223], shift),
            apply_shift([c_2233, c_3333, c_3323], shift),
            apply_shift([c_2223, c_3323, c_2323], shift),
        );
        let [c_2222, _, _] = apply_shift([r22[0], r33[0], r23[0]], shift);
        let [c_2233, c_3333, c_3323] = apply_shift([r22[1], r33[1], r23[1]], shift);
        let [c_2223, _, c_2323] = apply_shift([r22[2], r33[2], r23[2]], shift);
        let [c_1212, c_3131, c_1231] = self.along;
        let shifted = fnmadd(shift, c_3131, c_1231);
        let (c_1212, c_1231) = (fnmadd(shift, c_1231 + shifted, c_1212), shifted);
        // The rows 22, 33 and 23: their columns 11, 12 and 31 in m, t1 and t2.
        let (c_2211, c_2212, c_2231) = apply_slip([c_2222, c_2233, c_2223], slip);
        let (c_3311, c_3312, c_3331) = apply_slip([c_2233, c_3333, c_3323], slip);
        let (c_2311, c_2312, c_2331) = apply_slip([c_2223, c_3323, c_2323], slip);
        let (mut from_12, mut from_31, mut c_1111) = (zero, zero, self.c_1111);
        if shear {
            let [c_1112, c_1131] = self.slip;
            (from_12, from_31) = (fnmadd(shift, c_1131, c_1112), c_1131);
            c_1111 = fnmadd(y + y, from_12, fnmadd(z + z, from_31, c_1111));
        }
        let from_12 = fnmadd(y + y, c_1212, fnmadd(z + z, c_1231, from_12));
        let from_31 = fnmadd(y + y, c_1231, fnmadd(z + z, c_3131, from_31));
        // The rows 12, 31 and 11: their columns 12, 31 and 11 in m, t1 and t2.
        let (n_1212, n_1231) =
            (fnmadd(y, c_2212, fnmadd(z, c_2312, c_1212)), fnmadd(y, c_2231, fnmadd(z, c_2331, c_1231)));
        let n_3131 = fnmadd(y, c_2331, fnmadd(z, c_3331, c_3131));
        let (n_1112, n_1131) =
            (fnmadd(y, c_2211, fnmadd(z, c_2311, from_12)), fnmadd(y, c_2311, fnmadd(z, c_3311, from_31)));
        let n_1111 = fnmadd(y, from_12 + n_1112, fnmadd(z, from_31 + n_1131, c_1111));
        Moduli([
            n_1111, c_2211, c_3311, n_1112, c_2311, n_1131, c_2222, c_2233, c_2212, c_2223, c_2231, c_3333, c_3312,
            c_3323, c_3331, n_1212, c_2312, n_1231, c_2323, c_2331, n_3131,
        ])
    }

    /// The moduli in the reference axes: dyads of tensors made of F⁻¹a and F⁻¹b', and a product ⊙ of m⊗m.
    #[inline(always)]
    fn in_reference_axes(&self, n: &FibreFrame<R>, shear: bool) -> Moduli<R> {
        let one = R::splat(1.0);
        let [m, alpha, beta] = self.basis.pulled_back(n);
        let (a, b, mixed) = (square(one, alpha), square(one, beta), symmetric_product(R::splat(2.0), alpha, beta));
        let [c_2222, c_2233, c_2223, c_3333, c_3323, c_2323] = self.across;
        let [c_1212, c_3131, c_1231] = self.along;
        let dyads = [a, b, mixed];
        let mut with_fibre =
            added(&sum([c_1212, c_3131, c_1231], &dyads), R::splat(0.25) * self.c_1111, &square(one, m));
        if shear {
            // c_1112 is twice the component 12 of the tensor that m⊗m is multiplied with.
            let half = R::splat(0.5);
            let across = along(scale(half * self.slip[0], alpha), half * self.slip[1], beta);
            with_fibre = added(&with_fibre, one, &symmetric_product(R::splat(2.0), m, across));
        }
        let with = [
            sum([c_2222, c_2233, c_2223], &dyads),
            sum([c_2233, c_3333, c_3323], &dyads),
            sum([c_2223, c_3323, c_2323], &dyads),
        ];
        let with_fibre = along_fibre(m, &with_fibre);
        Moduli(upper_triangle!(material_entry(&dyads, &with, m, &with_fibre)))
    }
}

/// x A + y B + z C.
#[inline(always)]
pub(super) fn sum<R: Real>([x, y, z]: [R; 3], [a, b, c]: &[[R; 6]; 3]) -> [R; 6] {
    added(&combination(x, a, y, b), z, c)
}

/// t − s x.
#[inline(always)]
fn fnmadd<R: Real>(s: R, x: R, t: R) -> R {
    (-s).mul_add(x, t)
}

/// The components 22, 33, 23 of a tensor in the basis α, β, from those in the basis α, β − u α.
#[inline(always)]
fn apply_shift<R: Real>([c22, c33, c23]: [R; 3], u: R) -> [R; 3] {
    let shifted = fnmadd(u, c33, c23);
    [fnmadd(u, c23 + shifted, c22), c33, shifted]
}

/// The components 11, 12, 31 in the basis m, α, β of a tensor whose only components in the basis m, α − y m, β − z m
/// are 22, 33 and 23.
#[inline(always)]
fn apply_slip<R: Real>([c22, c33, c23]: [R; 3], [y, z]: [R; 2]) -> (R, R, R) {
    let zero = R::splat(0.0);
    let (c12, c31) = (fnmadd(y, c22, fnmadd(z, c23, zero)), fnmadd(y, c23, fnmadd(z, c33, zero)));
    (fnmadd(y, c12, fnmadd(z, c31, zero)), c12, c31)
}

/// An entry of A⊗A' + B⊗B' + C⊗C' + (m⊗m)⊙Z.
#[inline(always)]
fn material_entry<R: Real, const ROW: usize, const COLUMN: usize>(
    [a, b, c]: &[[R; 6]; 3],
    [with_a, with_b, with_c]: &[[R; 6]; 3],
    m: [R; 3],
    along: &[[R; 6]; 3],
) -> R {
    let sum = a[ROW].mul_add(with_a[COLUMN], b[ROW].mul_add(with_b[COLUMN], c[ROW] * with_c[COLUMN]));
    paired_along::<R, ROW, COLUMN>(m, along, sum)
}

/// `rest` plus an entry of (m⊗m)⊙Z; `along` is [`along_fibre`] of Z.
#[inline(always)]
fn paired_along<R: Real, const ROW: usize, const COLUMN: usize>(m: [R; 3], along: &[[R; 6]; 3], rest: R) -> R {
    let (i, j) = PAIRS[ROW];
    if ROW < 3 {
        return (m[i] + m[i]).mul_add(along[i][COLUMN], rest);
    }
    m[i].mul_add(along[j][COLUMN], m[j].mul_add(along[i][COLUMN], rest))
}

/// m_k Z_jl + m_l Z_jk for each j and the pairs kl.
#[inline(always)]
fn along_fibre<R: Real>(m: [R; 3], g: &[R; 6]) -> [[R; 6]; 3] {
    [along_row(m, [g[0], g[3], g[5]]), along_row(m, [g[3], g[1], g[4]]), along_row(m, [g[5], g[4], g[2]])]
}

/// m_k Z_jl + m_l Z_jk for the pairs kl and one j, given row j of Z.
#[inline(always)]
fn along_row<R: Real>([x, y, z]: [R; 3], [a, b, c]: [R; 3]) -> [R; 6] {
    [(x + x) * a, (y + y) * b, (z + z) * c, x.mul_add(b, y * a), y.mul_add(c, z * b), z.mul_add(a, x * c)]
}

/// a + b.
#[inline(always)]
fn add<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Whether an entry of a tangent may overflow in `R` at a point whose strains are valid.
///
/// In double precision those of the spatial moduli do not if k_ld is 0. With the bounds of the properties (10²⁵, p ≤
/// 40) and of the strains (λ², 1/J below 10¹⁰⁰, |I_tc| ≤ 173, x and s below 10⁵⁰) the largest factor is that of the
/// pressure, 20 · 10²⁵ · 173³⁹ · 10¹⁰⁰ < 10²¹⁴, and the entries of the tensors that it multiplies are at most 1; the
/// factors of D contain 1/s for each D. No factor is a product of 0 and infinity: where the reciprocal of the
/// compaction would be large, the curvature is limited.
#[inline(always)]
pub(crate) fn may_overflow<R: Real>(measure: Measure, shear: bool) -> bool {
    shear || !R::WIDE_RANGE || !matches!(measure, Measure::Truesdell | Measure::Jaumann)
}
