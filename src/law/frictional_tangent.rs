//! The tangents of the law with friction: those of the hyperelastic law in the axes that the slip has left, and what
//! makes them unsymmetric where the fibres slide (`docs/reference/theory.md`).

use super::axes::FibreFrame;
use super::frictional::unsigned_zero;
use super::hyperelastic::{Deformed, Hyperelastic, Kirchhoff};
use super::kinematics::{Kinematics, Section};
use super::number::real::Real;
use super::number::vector::dot;
use super::tangent::{Bases, Measure, Orthogonal, Shape, sum};
use super::voigt::{VOIGT, combination, square, symmetric_product};

impl<R: Real> Deformed<'_, R> {
    /// The tangent of a 6×6 measure of a section that may slide. It is not symmetric where the fibres slide: what
    /// friction holds grows with the pressure, so that D̂ follows the area, but the pressure does not follow the shape.
    #[inline(always)]
    pub fn sliding_moduli(self, n: &FibreFrame<R>, measure: Measure) -> [[R; 6]; 6] {
        let (k, alone) = (self.k.without_shear(), ShearAlone::new(self));
        let mut moduli = Deformed { k: &k, shear: false, ..self }.moduli(n, false, measure, None).matrix();
        if self.shear {
            add_to(&mut moduli, &alone.of(self).moduli(n, false, measure, None).matrix());
        }
        let Kinematics { stretch, section, images, .. } = self.kinematics;
        let (one, shape) = (R::splat(1.0), Shape::new(section));
        let over = if measure == Measure::Material { one } else { stretch.inverse_jacobian };
        let factor = self.sliding_factor(&shape, over);
        let (d, p) = if measure == Measure::Material {
            self.pulled_back_deviator(n, &shape)
        } else {
            let Bases { d, e, .. } = Bases::new(stretch, section, &images);
            (d, [one - e[0], one - e[1], one - e[2], -e[3], -e[4], -e[5]])
        };
        add_dyad(&mut moduli, factor, &d, &p);
        moduli
    }

    /// dP/dF of a section that may slide, entry (row, column) at 9 row + column: it is not symmetric.
    #[inline(always)]
    pub fn sliding_nominal_tangent(self, n: &FibreFrame<R>) -> [R; 81] {
        let (k, alone) = (self.k.without_shear(), ShearAlone::new(self));
        let mut tangent = Deformed { k: &k, shear: false, ..self }.nominal_tangent(n);
        if self.shear {
            for (entry, &more) in tangent.iter_mut().zip(&alone.of(self).nominal_tangent(n)) {
                *entry += more;
            }
        }
        let Kinematics { stretch, section, images, .. } = self.kinematics;
        let (one, shape) = (R::splat(1.0), Shape::new(section));
        let Bases { d, e, .. } = Bases::new(stretch, section, &images);
        let factor = self.sliding_factor(&shape, one);
        let p = [one - e[0], one - e[1], one - e[2], -e[3], -e[4], -e[5]];
        let inverse = self.inverse(n);
        let (d, p) = (by_columns(&inverse, &d), by_columns(&inverse, &p));
        for (row, &x) in d.iter().enumerate() {
            for (column, &y) in p.iter().enumerate() {
                tangent[9 * row + column] = unsigned_zero((factor * x).mul_add(y, tangent[9 * row + column]));
            }
        }
        tangent
    }

    /// D and Π, pulled back to the reference placement.
    #[inline(always)]
    fn pulled_back_deviator(self, n: &FibreFrame<R>, shape: &Shape<R>) -> ([R; 6], [R; 6]) {
        let kinematics = self.kinematics;
        let basis = Orthogonal::new(kinematics);
        let Orthogonal { shift, over_a, over_b, .. } = basis;
        let Section { x23, delta, .. } = *kinematics.section;
        let (one, over_area) = (R::splat(1.0), shape.inverse_area_ratio);
        let (d1, d2) = (x23.mul_add(shift, delta) * over_area, shift);
        let [_, alpha, beta] = basis.pulled_back(&kinematics.axes(n));
        let dyads = [square(one, alpha), square(one, beta), symmetric_product(R::splat(2.0), alpha, beta)];
        let [a, b, _] = &dyads;
        (sum([d1 * over_a, -(d1 * over_b), d2 * over_area], &dyads), combination(over_a, a, over_b, b))
    }

    /// −µ W″/(4 s), the factor of D⊗Π where the fibres slide, else 0.
    #[inline(always)]
    fn sliding_factor(self, shape: &Shape<R>, over: R) -> R {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let Some(slid) = self.kinematics.slid else { return zero };
        let (_, curvature) = self.law.compaction_slopes(self.kinematics.strain, self.k);
        let growth = R::splat(0.25) * slid.mu * curvature * over;
        R::select(slid.slides, -growth / R::select(slid.slides, shape.s, one), zero)
    }
}

impl<R: Real> Kirchhoff<R> {
    /// The same stress without longitudinal shear.
    #[inline(always)]
    fn without_shear(&self) -> Self {
        Kirchhoff { shear: R::splat(0.0), ..*self }
    }
}

/// A law of longitudinal shear and nothing else, and the factors of its stress.
struct ShearAlone<R> {
    law: Hyperelastic<R>,
    k: Kirchhoff<R>,
}

impl<R: Real> ShearAlone<R> {
    #[inline(always)]
    fn new(point: Deformed<'_, R>) -> Self {
        let zero = R::splat(0.0);
        let law = Hyperelastic { k_el: zero, k_td: zero, limited_curvature: zero, ..*point.law };
        let k = Kirchhoff { tension: zero, pressure: zero, distortion: zero, compaction_energy: zero, ..*point.k };
        ShearAlone { law, k }
    }

    /// The shear at a point, that of its whole section.
    #[inline(always)]
    fn of<'a>(&'a self, point: Deformed<'a, R>) -> Deformed<'a, R> {
        Deformed { law: &self.law, kinematics: point.kinematics.whole(), k: &self.k, shear: true }
    }
}

/// S F⁻ᵀ by columns, from the rows of F⁻¹.
#[inline(always)]
fn by_columns<R: Real>(inverse: &[[R; 3]; 3], s: &[R; 6]) -> [R; 9] {
    let mut columns = [R::splat(0.0); 9];
    for (big, row) in inverse.iter().enumerate() {
        for i in 0..3 {
            columns[i + 3 * big] = dot([s[VOIGT[i][0]], s[VOIGT[i][1]], s[VOIGT[i][2]]], *row);
        }
    }
    columns
}

/// A + B.
#[inline(always)]
fn add_to<R: Real>(a: &mut [[R; 6]; 6], b: &[[R; 6]; 6]) {
    for (row, more) in a.iter_mut().zip(b) {
        for (entry, &more) in row.iter_mut().zip(more) {
            *entry += more;
        }
    }
}

/// A + s d⊗p.
#[inline(always)]
fn add_dyad<R: Real>(a: &mut [[R; 6]; 6], s: R, d: &[R; 6], p: &[R; 6]) {
    for (row, &x) in a.iter_mut().zip(d) {
        for (entry, &y) in row.iter_mut().zip(p) {
            *entry = unsigned_zero((s * x).mul_add(y, *entry));
        }
    }
}
