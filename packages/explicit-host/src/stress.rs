//! From the law's stress and viscosity's to the first Piola–Kirchhoff stress, which nodal forces follow from.

#![expect(clippy::needless_range_loop, reason = "what is inlined for certain: see Lanes")]

use super::lanes::{LANES, Lanes, Number, add, combine, cross, dot, less, load, sub, times};
use super::viscosity::Viscosity;

/// The deformation gradient and the stresses that P follows from, component-major.
pub struct Points<'a, T> {
    pub deformation_gradient: &'a [T],
    /// Cauchy stress.
    pub stress: &'a [T],
    pub viscosity: &'a Viscosity<T>,
}

/// The columns of P = σ cof F less viscosity's part: t f1 in the first column, and R̄ times the second and third column
/// without their parts along the first, which has minus as much of theirs as they slant.
#[inline(always)]
pub fn first_piola_kirchhoff<T: Number>(
    f: &[Lanes<T>; 9],
    stress: &[Lanes<T>; 6],
    along: Lanes<T>,
    section: &[Lanes<T>; 3],
) -> [[Lanes<T>; 3]; 3] {
    let (a, b, c) = ([f[0], f[1], f[2]], [f[3], f[4], f[5]], [f[6], f[7], f[8]]);
    let [r22, r33, r23] = *section;
    let per_square = Lanes::constant(1.0) / dot(a, a);
    let (slant_b, slant_c) = (dot(a, b) * per_square, dot(a, c) * per_square);
    let (across_b, across_c) = (less(b, slant_b, a), less(c, slant_c, a));
    let (second, third) = (combine(r22, across_b, r23, across_c), combine(r23, across_b, r33, across_c));
    let [p1, p2, p3] = [times(stress, cross(b, c)), times(stress, cross(c, a)), times(stress, cross(a, b))];
    let slanting = combine(slant_b, second, slant_c, third);
    [add(less(p1, along, a), slanting), sub(p2, second), sub(p3, third)]
}

/// P by columns, all elements.
#[inline(always)]
pub fn nominal_stress<T: Number>(stride: usize, point: &Points<'_, T>, nominal: &mut [T]) {
    for group in 0..stride / LANES {
        let first = group * LANES;
        let f = load(point.deformation_gradient, stride, first);
        let stress = load(point.stress, stride, first);
        let [along, section @ ..] = point.viscosity.stress(first);
        let p = first_piola_kirchhoff(&f, &stress, along, &section);
        for j in 0..3 {
            for i in 0..3 {
                p[j][i].store(nominal, (i + 3 * j) * stride + first);
            }
        }
    }
}
