//! The coefficients of the polynomials of the elementary functions: minimax, found by Remez exchange in 300-bit
//! arithmetic.

/// ½ (artanh w − w)/w³ in powers of w², |w| ≤ 1/5; relative error of artanh 2^−55.9, 2^−28.4.
pub(super) const HALF_ARTANH_F64: [f64; 7] = quartered([
    0.6666666666667272,
    0.39999999996156954,
    0.28571429396138265,
    0.22222138432215943,
    0.1818635891183978,
    0.15250131648093396,
    0.153686343008258,
]);
pub(super) const HALF_ARTANH_F32: [f64; 3] = quartered([0.6666694752001328, 0.39957808364879166, 0.3036093709608493]);

/// The same for ln((1 + s/2)/(1 − s/2)) = 2 artanh(s/2): (… − s)/s³ in powers of s², |s| ≤ 2/5.
pub(super) const LN_F64: [f64; 7] = of_twice(HALF_ARTANH_F64);
pub(super) const LN_F32: [f64; 3] = of_twice(HALF_ARTANH_F32);

/// A quarter of each coefficient.
const fn quartered<const N: usize>(mut c: [f64; N]) -> [f64; N] {
    let mut j = 0;
    while j < N {
        c[j] *= 0.25;
        j += 1;
    }
    c
}

/// The coefficients in powers of s² for 2 artanh(s/2), from those in powers of w² for ½ artanh w.
const fn of_twice<const N: usize>(mut c: [f64; N]) -> [f64; N] {
    let (mut j, mut factor) = (0, 0.5);
    while j < N {
        c[j] *= factor;
        factor *= 0.25;
        j += 1;
    }
    c
}

/// (e^r − 1 − r)/r² in powers of r, |r| ≤ ½ ln 2; error of the exponential 2^−58, 2^−28.2.
pub(super) const EXP_F64: [f64; 10] = [
    0.5000000000000012,
    0.166666666666667,
    0.04166666666651542,
    0.008333333333307205,
    0.0013888888947016604,
    0.00019841269917383284,
    2.4801489941623132e-05,
    2.7557216301455982e-06,
    2.763128051606888e-07,
    2.5117860795509996e-08,
];
pub(super) const EXP_F32: [f64; 5] =
    [0.5000000095185461, 0.1666651883965976, 0.04166620580112459, 0.008368889354403867, 0.0013950491223541559];

/// Their coefficients of even and of odd powers, each in powers of r²: (cosh r − 1)/r² and (sinh r − r)/r³.
pub(super) const EXP_BY_PARITY_F64: ([f64; 5], [f64; 5]) = (every_other(EXP_F64, 0), every_other(EXP_F64, 1));
pub(super) const EXP_BY_PARITY_F32: ([f64; 3], [f64; 2]) = (every_other(EXP_F32, 0), every_other(EXP_F32, 1));

/// Every other coefficient, from the first on.
const fn every_other<const N: usize, const M: usize>(c: [f64; N], first: usize) -> [f64; M] {
    let (mut chosen, mut j) = ([0.0; M], 0);
    while j < M {
        chosen[j] = c[first + 2 * j];
        j += 1;
    }
    chosen
}
