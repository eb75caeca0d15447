//! The tangents of the yarn law, in closed form.
//!
//! In the current frame (e, q1, q2) most entries of the Truesdell modulus of τ vanish. With E = e⊗e, P = 1 − E, the
//! deviator D of the section, A⊙B = A_ik B_jl + A_il B_jk + A_jk B_il + A_jl B_ik, and the factors of `Factors`, it is
//! (derivation in `docs/theory.md`)
//!
//! ```text
//! c = A E⊗E + (W − K) P⊗P + W2 D⊗D + P⊙H + E⊙G  −  2 (E⊗τ_ld + τ_ld⊗E)
//! H = ½ (π + K) P − ½ W1 D,      G = (π + κ J_t x) P − (W1 − κ J_t) D
//! ```
//!
//! In space P⊙H = 1⊙H − E⊙H, where the product with 1 is sparse, and the Jaumann modulus, c + ½ 1⊙τ, differs in H alone:
//! ½ K P + ½ τ_el + ½ τ_ld stands there. Pulled back, E, P and D are those of F⁻¹e, F⁻¹q1, F⁻¹q2, and the same sum is dS/dE.
//! No quotient 0/0 anywhere, and symmetric by construction: only the upper triangle is computed.

use nalgebra::Matrix3;

use super::hyperelastic::{Hyperelastic, Kirchhoff, Request, shear_components};
use super::kinematics::{Decomposition, FibreFrame, Kinematics, Section, Strain, Stretch};
use super::point::{Derivative, Point};
use super::real::{Real, along, dot, image, scale};
use super::state::HYPERELASTIC_STATE;
use super::stress::{VOIGT, paired, paired_with_one, square, symmetric_product, upper_triangle};

/// Which derivative of which stress. Rows and columns of the 6×6 are 11 22 33 12 23 31, its columns engineering shears.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Measure {
    /// dS/dE, 6×6: second Piola–Kirchhoff stress by Green–Lagrange strain, in reference axes.
    Material,
    /// The Truesdell modulus of σ, 6×6: dS/dE pushed forward over J. LS-DYNA's `utan`.
    Truesdell,
    /// The modulus of the Jaumann rate of τ over J, 6×6: Abaqus's DDSDDE.
    #[default]
    Jaumann,
    /// dP/dF, 9×9: first Piola–Kirchhoff stress by deformation gradient, both by columns 11 21 31 12 22 32 13 23 33.
    Nominal,
}

impl Measure {
    /// Rows and columns.
    pub const fn size(self) -> usize {
        match self {
            Measure::Nominal => 9,
            _ => 6,
        }
    }

    /// Entries of the full matrix.
    pub const fn components(self) -> usize {
        self.size() * self.size()
    }
}

/// A symmetric 6×6 matrix: its upper triangle, row by row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli<R>(pub [R; 21]);

impl<R: Copy> Moduli<R> {
    /// Where an entry stands in the upper triangle.
    pub const fn place(row: usize, column: usize) -> usize {
        let (a, b) = if row < column { (row, column) } else { (column, row) };
        a * (11 - a) / 2 + b
    }

    /// The full matrix.
    #[inline(always)]
    pub fn matrix(&self) -> [[R; 6]; 6] {
        let c = &self.0;
        [
            [c[0], c[1], c[2], c[3], c[4], c[5]],
            [c[1], c[6], c[7], c[8], c[9], c[10]],
            [c[2], c[7], c[11], c[12], c[13], c[14]],
            [c[3], c[8], c[12], c[15], c[16], c[17]],
            [c[4], c[9], c[13], c[16], c[18], c[19]],
            [c[5], c[10], c[14], c[17], c[19], c[20]],
        ]
    }
}

impl<R> AsMut<[R]> for Moduli<R> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [R] {
        &mut self.0
    }
}

/// The factors of the modulus, all over the same number: J for a modulus of σ, 1 for one of τ or S.
struct Factors<R> {
    /// A = k_el (1 − 2 I_el) in tension, I_el = 0 included.
    elongation: R,
    /// W = ¼ W″, the compaction's curvature; π = ½ |W′|.
    compaction: R,
    pressure: R,
    /// W1 = (k_td/4) a/s; K = W1 x; W2 = (k_td/4)(1 − x a/s)/s².
    distortion: R,
    stiffness: R,
    curvature: R,
    /// Tension k_el⟨I_el⟩.
    tension: R,
    /// κ = k_ld/λ² times J_t.
    shear: R,
}

/// The tensors that a modulus is made of, 11 22 33 12 23 31.
#[derive(Clone, Copy)]
pub struct Bases<R> {
    e: [R; 6],
    p: [R; 6],
    d: [R; 6],
}

impl<R: Real> Bases<R> {
    /// In space: e⊗e, P and D.
    #[inline(always)]
    fn new(d: &Decomposition<R>) -> Self {
        let one = R::splat(1.0);
        let e = square(one, d.e);
        let p = [one - e[0], one - e[1], one - e[2], -e[3], -e[4], -e[5]];
        Bases { e, p, d: deviator(d, d.q1, d.q2()) }
    }
}

/// The sum of three dyads and a product ⊙; entry by entry.
struct Terms<R> {
    bases: Bases<R>,
    /// What E, P and D are multiplied with as dyads.
    with_e: [R; 6],
    with_p: [R; 6],
    with_d: [R; 6],
    /// What E is multiplied with by ⊙.
    paired: [R; 6],
    /// The two factors of the other product; none: 1, and the second one.
    first: Option<[R; 6]>,
    second: [R; 6],
}

#[inline(always)]
fn entry<R: Real, const ROW: usize, const COLUMN: usize>(t: &Terms<R>) -> R {
    let Bases { e, p, d } = &t.bases;
    let dyads = e[ROW].mul_add(t.with_e[COLUMN], p[ROW].mul_add(t.with_p[COLUMN], d[ROW] * t.with_d[COLUMN]));
    let sum = dyads + paired::<R, ROW, COLUMN>(e, &t.paired);
    match &t.first {
        Some(first) => sum + paired::<R, ROW, COLUMN>(first, &t.second),
        None => match paired_with_one::<R, ROW, COLUMN>(&t.second) {
            Some(one) => sum + one,
            None => sum,
        },
    }
}

/// An entry of a⊗b + b⊗a.
#[inline(always)]
fn coupled<R: Real, const ROW: usize, const COLUMN: usize>(a: &[R; 6], b: &[R; 6]) -> R {
    a[ROW].mul_add(b[COLUMN], a[COLUMN] * b[ROW])
}

/// a A.
#[inline(always)]
fn multiple<R: Real>(a: R, x: &[R; 6]) -> [R; 6] {
    [a * x[0], a * x[1], a * x[2], a * x[3], a * x[4], a * x[5]]
}

/// a A + b B.
#[inline(always)]
fn combination<R: Real>(a: R, x: &[R; 6], b: R, y: &[R; 6]) -> [R; 6] {
    let mut sum = [a; 6];
    for ((s, &x), &y) in sum.iter_mut().zip(x).zip(y) {
        *s = a.mul_add(x, b * y);
    }
    sum
}

impl<R: Real> Hyperelastic<R> {
    /// |W′| and W″ of the compaction: its loading side at I_tc = 0, and with p < 2 held where W″ is infinite.
    #[inline(always)]
    pub(super) fn compaction_slopes(&self, strain: &Strain<R>, k: &Kirchhoff<R>) -> (R, R) {
        let zero = R::splat(0.0);
        let compaction = -strain.i_tc;
        let slope = R::splat(2.0) * k.pressure;
        let held = compaction.le(self.held_below);
        // Divided before the slope is known, which takes long to compute.
        let factor = (self.p - R::splat(1.0)) / R::select(held, R::splat(1.0), compaction);
        let curvature = R::select(held, self.greatest_curvature, factor * slope);
        (slope, R::select(zero.le(compaction), curvature, zero))
    }

    #[inline(always)]
    fn factors(&self, d: &Decomposition<R>, strain: &Strain<R>, k: &Kirchhoff<R>, over: R) -> Factors<R> {
        let (zero, one, quarter) = (R::splat(0.0), R::splat(1.0), R::splat(0.25));
        let (_, curvature) = self.compaction_slopes(strain, k);
        // D⊗D W2 = (D/s)⊗(D/s)(k_td/4)(1 − x a/s): the bracket has an error of some roundings of 1 and D/s is a direction, so
        // that no series is needed near s = 0, only something to divide by. Where s² is below a rounding of 1, so is the
        // term beside W1.
        let square = (d.s * d.s).max(R::splat(R::EPSILON));
        // a/s and x a/s.
        let ratio = R::splat(2.0) * strain.distortion_ratio * d.area_ratio;
        let stiffness = d.cosh * ratio;
        let distortion = quarter * self.k_td * over;
        let elongation = self.k_el * (one - R::splat(2.0) * strain.i_el);
        Factors {
            elongation: R::select(zero.le(strain.i_el), elongation, zero) * over,
            compaction: quarter * curvature * over,
            pressure: k.pressure * over,
            distortion: distortion * ratio,
            stiffness: distortion * stiffness,
            curvature: distortion * ((one - stiffness) / square),
            tension: k.tension * over,
            shear: k.shear * d.area_ratio * over,
        }
    }

    /// The sum for given bases, with `first` as the metric (none: the spatial one), less the longitudinal shear's coupling.
    #[inline(always)]
    fn terms(&self, bases: Bases<R>, f: &Factors<R>, x: R, measure: Measure, pulled: bool) -> Terms<R> {
        let half = R::splat(0.5);
        let Bases { e, p, d } = &bases;
        // G, and in space G − H.
        let (on_p, on_d) = (f.pressure, -f.distortion);
        let (h_p, h_d) = (half * (f.pressure + f.stiffness), half * on_d);
        let (g_p, g_d) = if pulled { (on_p, on_d) } else { (on_p - h_p, on_d - h_d) };
        let second = if measure == Measure::Jaumann {
            combination(half * f.stiffness, p, half * f.tension, e)
        } else {
            combination(h_p, p, h_d, d)
        };
        Terms {
            with_e: multiple(f.elongation, e),
            with_p: multiple(f.compaction - f.stiffness, p),
            with_d: multiple(f.curvature, d),
            paired: combination(f.shear.mul_add(x, g_p), p, g_d + f.shear, d),
            first: if pulled { Some(*p) } else { None },
            second,
            bases,
        }
    }

    /// The Truesdell modulus of σ or the Jaumann modulus of τ over J.
    #[inline(always)]
    pub fn spatial_tangent(
        &self,
        d: &Decomposition<R>,
        strain: &Strain<R>,
        k: &Kirchhoff<R>,
        measure: Measure,
        shear: bool,
    ) -> Moduli<R> {
        self.spatial_tangent_of(d, Bases::new(d), strain, k, measure, shear)
    }

    /// Likewise, given the tensors that it is made of.
    #[inline(always)]
    fn spatial_tangent_of(
        &self,
        d: &Decomposition<R>,
        bases: Bases<R>,
        strain: &Strain<R>,
        k: &Kirchhoff<R>,
        measure: Measure,
        shear: bool,
    ) -> Moduli<R> {
        let one = R::splat(1.0);
        let over = d.inverse_jacobian;
        let (q1, q2, e) = (d.q1, d.q2(), bases.e);
        let f = self.factors(d, strain, k, over);
        let mut terms = self.terms(bases, &f, d.cosh, measure, false);
        if !shear {
            return Moduli(upper_triangle!(entry(&terms)));
        }
        let slip = slip(d, k.shear * over, d.e, q1, q2);
        if measure == Measure::Jaumann {
            terms.second = combination(one, &terms.second, R::splat(0.5), &slip);
        }
        let slip = slip.map(|x| R::splat(-2.0) * x);
        Moduli(add(upper_triangle!(entry(&terms)), upper_triangle!(coupled(&e, &slip))))
    }

    /// dS/dE in reference axes.
    #[inline(always)]
    pub fn material_tangent(
        &self,
        d: &Decomposition<R>,
        strain: &Strain<R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        shear: bool,
    ) -> Moduli<R> {
        let one = R::splat(1.0);
        let [w1, w2, w3] = d.pulled_back(n);
        let e = square(one, w1);
        let p = add(square(one, w2), square(one, w3));
        let bases = Bases { e, p, d: deviator(d, w2, w3) };
        let terms = self.terms(bases, &self.factors(d, strain, k, one), d.cosh, Measure::Material, true);
        let moduli = upper_triangle!(entry(&terms));
        if !shear {
            return Moduli(moduli);
        }
        let slip = slip(d, R::splat(-2.0) * k.shear, w1, w2, w3);
        Moduli(add(moduli, upper_triangle!(coupled(&e, &slip))))
    }

    /// The tangent of a 6×6 measure; [`Measure::Nominal`] has nine columns and [`nominal_tangent`](Self::nominal_tangent).
    #[inline(always)]
    pub fn moduli(
        &self,
        d: &Decomposition<R>,
        strain: &Strain<R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        measure: Measure,
        shear: bool,
    ) -> Moduli<R> {
        match measure {
            Measure::Material | Measure::Nominal => self.material_tangent(d, strain, k, n, shear),
            Measure::Truesdell | Measure::Jaumann => self.spatial_tangent(d, strain, k, measure, shear),
        }
    }

    /// dP/dF by columns of P and F: ∂P_iJ/∂F_kL = J F⁻¹_Jj (c_ijkl + δ_ik σ_jl) F⁻¹_Ll with the Truesdell modulus of σ, given
    /// σ as well.
    #[inline(always)]
    pub fn nominal_tangent(
        &self,
        d: &Decomposition<R>,
        strain: &Strain<R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        stress: &[R; 6],
        shear: bool,
    ) -> [R; 81] {
        let c = self.spatial_tangent(d, strain, k, Measure::Truesdell, shear).matrix();
        let [w1, w2, w3] = d.pulled_back(n);
        let (e, q1, q2) = (d.e, d.q1, d.q2());
        // Rows of F⁻¹; a closure would be compiled without the lanes' instructions.
        let axes = [e, q1, q2];
        let inverse = [
            image(&axes, [w1[0], w2[0], w3[0]]),
            image(&axes, [w1[1], w2[1], w3[1]]),
            image(&axes, [w1[2], w2[2], w3[2]]),
        ];
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
                    let half = scale(d.jacobian, [dot(rows[0], *last), dot(rows[1], *last), dot(rows[2], *last)]);
                    // With i = k the block is symmetric of itself.
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

/// D of two axes across the fibre.
#[inline(always)]
fn deviator<R: Real>(d: &Decomposition<R>, a: [R; 3], b: [R; 3]) -> [R; 6] {
    let u = along(scale(d.d1, a), d.d2, b);
    let v = along(scale(d.d2, a), -d.d1, b);
    let component = |i: usize, j: usize| a[i].mul_add(u[j], b[i] * v[j]);
    [component(0, 0), component(1, 1), component(2, 2), component(0, 1), component(1, 2), component(2, 0)]
}

/// `factor` (P b e ⊗ e + e ⊗ P b e).
#[inline(always)]
fn slip<R: Real>(d: &Decomposition<R>, factor: R, e: [R; 3], a: [R; 3], b: [R; 3]) -> [R; 6] {
    let [on_a, on_b] = shear_components(d, factor);
    symmetric_product(R::splat(2.0), e, along(scale(on_a, a), on_b, b))
}

#[inline(always)]
fn add<R: Real, const N: usize>(mut a: [R; N], b: [R; N]) -> [R; N] {
    for (x, &y) in a.iter_mut().zip(&b) {
        *x = *x + y;
    }
    a
}

/// Whether an entry of a tangent may leave the range of R at a point whose strains are within it.
///
/// In double precision none in space does without a longitudinal-shear stiffness. With the bounds of the properties (10²⁵, p ≤ 40)
/// and of a point's strains (λ², 1/J below 10¹⁰⁰, |I_tc| ≤ 173, x and s below 10⁵⁰) the largest factor is the pressure's,
/// 20 · 10²⁵ · 173³⁹ · 10¹⁰⁰ < 10²¹⁴, and what it is multiplied with is no larger than 1; those of D carry 1/s for each D. No
/// factor is a product of 0 and infinity: where the compaction is so small that its reciprocal is large, its curvature is held.
#[inline(always)]
pub(super) fn overflows<R: Real>(measure: Measure, shear: bool) -> bool {
    shear || !R::HEADROOM || !matches!(measure, Measure::Truesdell | Measure::Jaumann)
}

/// 0 where all are finite numbers, else NaN.
#[inline(always)]
pub(super) fn unrepresentable<R: Real>(values: &[R]) -> R {
    let zero = R::splat(0.0);
    // Four sums, which need not wait for one another.
    let [mut a, mut b, mut c, mut d] = [zero; 4];
    let mut fours = values.chunks_exact(4);
    for four in &mut fours {
        if let &[x, y, z, w] = four {
            (a, b) = (x.mul_add(zero, a), y.mul_add(zero, b));
            (c, d) = (z.mul_add(zero, c), w.mul_add(zero, d));
        }
    }
    for &x in fours.remainder() {
        a = x.mul_add(zero, a);
    }
    (a + b) + (c + d)
}

/// A tangent of six rows.
#[derive(Clone, Copy)]
pub struct Six(pub Request, pub Measure);

impl Derivative<21> for Six {
    type Early<R: Real> = Decomposition<R>;
    type General = Self;

    fn general(self) -> Self {
        self
    }

    #[inline(always)]
    fn early<R: Real>(self, d: &Stretch<R>, section: &Section<R>, images: &[[R; 3]; 3]) -> Decomposition<R> {
        Decomposition::of(d, section, images)
    }

    #[inline(always)]
    fn request(self) -> Request {
        self.0
    }

    #[inline(always)]
    fn overflows<R: Real>(self, shear: bool) -> bool {
        overflows::<R>(self.1, shear)
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        law: &Hyperelastic<R>,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        d: &Decomposition<R>,
        shear: bool,
    ) -> [R; 21] {
        law.moduli(d, kinematics.strain, k, n, self.1, shear).0
    }
}

/// DDSDDE beside stress and state, known to the compiler to be all that is wanted.
#[derive(Clone, Copy)]
pub struct Jaumann;

impl Derivative<21> for Jaumann {
    type Early<R: Real> = (Decomposition<R>, Bases<R>);
    type General = Six;

    fn general(self) -> Six {
        Six(Request::STRESS_AND_STATE, Measure::Jaumann)
    }

    #[inline(always)]
    fn early<R: Real>(
        self,
        d: &Stretch<R>,
        section: &Section<R>,
        images: &[[R; 3]; 3],
    ) -> (Decomposition<R>, Bases<R>) {
        let d = Decomposition::of(d, section, images);
        (d, Bases::new(&d))
    }

    #[inline(always)]
    fn request(self) -> Request {
        Request::STRESS_AND_STATE
    }

    #[inline(always)]
    fn overflows<R: Real>(self, shear: bool) -> bool {
        overflows::<R>(Measure::Jaumann, shear)
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        law: &Hyperelastic<R>,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        _: &FibreFrame<R>,
        (d, bases): &(Decomposition<R>, Bases<R>),
        shear: bool,
    ) -> [R; 21] {
        law.spatial_tangent_of(d, *bases, kinematics.strain, k, Measure::Jaumann, shear).0
    }
}

/// dP/dF.
#[derive(Clone, Copy)]
pub struct Nine(pub Request);

impl Derivative<81> for Nine {
    type Early<R: Real> = Decomposition<R>;
    type General = Self;

    fn general(self) -> Self {
        self
    }

    #[inline(always)]
    fn early<R: Real>(self, d: &Stretch<R>, section: &Section<R>, images: &[[R; 3]; 3]) -> Decomposition<R> {
        Decomposition::of(d, section, images)
    }

    #[inline(always)]
    fn request(self) -> Request {
        self.0
    }

    #[inline(always)]
    fn overflows<R: Real>(self, shear: bool) -> bool {
        overflows::<R>(Measure::Nominal, shear)
    }

    #[inline(always)]
    fn of<R: Real>(
        self,
        law: &Hyperelastic<R>,
        kinematics: Kinematics<'_, R>,
        k: &Kirchhoff<R>,
        n: &FibreFrame<R>,
        d: &Decomposition<R>,
        shear: bool,
    ) -> [R; 81] {
        let zero = R::splat(0.0);
        let stress = law.cauchy(kinematics, k, zero.le(zero), shear);
        law.nominal_tangent(d, kinematics.strain, k, n, &stress, shear)
    }
}

impl<T: Real<Mask = bool> + Into<f64>> Hyperelastic<T> {
    /// The law at one point with a tangent of six rows; [`Measure::Nominal`] is taken for dS/dE.
    ///
    /// The call that detects failure gives the intact tangent; a point that has failed before, or cannot be evaluated, has
    /// none: zeros. A tangent that does not fit the number format makes the point one that cannot be evaluated.
    pub fn point_with_moduli(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        request: Request,
        measure: Measure,
    ) -> (Point<T>, Moduli<T>) {
        let (point, moduli) = self.point_with(f, fibre, state, Six(request, measure));
        (point, Moduli(moduli))
    }

    /// The law at one point with dP/dF, both by columns: entry `(i + 3 J) + 9 (k + 3 L)` is ∂P_iJ/∂F_kL; otherwise as
    /// [`point_with_moduli`](Self::point_with_moduli).
    pub fn point_with_nominal(
        &self,
        f: &[[T; 3]; 3],
        fibre: Option<[T; 3]>,
        state: &[T; HYPERELASTIC_STATE],
        request: Request,
    ) -> (Point<T>, [T; 81]) {
        self.point_with(f, fibre, state, Nine(request))
    }

    /// The law at one point with the fibre direction of the properties, and the full matrix of a measure with six rows.
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
